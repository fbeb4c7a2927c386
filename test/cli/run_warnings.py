# SPDX-License-Identifier: BSD-3-Clause
"""What capstan run says by itself of the examples of S90 annex 6.                usage: run_warnings.py CAPSTAN EXAMPLES"""
import json
import math
import os
import subprocess
import sys
import tempfile

CAPSTAN, EXAMPLES = sys.argv[1:]
BOUND, LIFTED, SUNK, SLACK = "differ from mu R", "has left the obstacle", "inside the obstacle", "slack over"

# example, what must be said with its figure, what must not be said
CASES = (
    ("11-1", {BOUND: "of 0.15 N in all", SUNK: "0.625 m"}, [LIFTED]),  # all of the bed's line is carried by the hanging part
    ("11-2", {BOUND: "0.399 N, of 0.399 N", LIFTED: "0.399 N"}, [SUNK]),  # mu w l less half an element at the held end
    ("11-3", {BOUND: "0.399 N, of 0.399 N", LIFTED: "of 0.399 N in all"}, [SUNK]),
)
faults = []


def run(folder, scene, *more):
    done = subprocess.run([CAPSTAN, "run", scene, "-o", os.path.join(folder, "out"), *more], capture_output=True, text=True,
                          timeout=60)
    if done.returncode:
        faults.append(f"{scene}: exit code {done.returncode}: {done.stderr}")
    return [line for line in done.stderr.splitlines() if "warning" in line]


with tempfile.TemporaryDirectory() as folder:
    for name, said, unsaid in CASES:
        path = os.path.join(EXAMPLES, f"souza-de-cursi-1990-example-{name}.yaml")
        lines = run(folder, path)
        for words, figure in said.items():
            if not any(words in line and figure in line for line in lines):
                faults.append(f"{name}: '{words}' with '{figure}' not in {lines}")
        faults += [f"{name}: '{words}' in {lines}" for words in unsaid if any(words in line for line in lines)]
        if run(folder, path, "--quiet"):
            faults.append(f"{name}: warnings in spite of --quiet")

        # the cure that is offered: nothing is left to say
        with open(path, encoding="utf-8") as file:
            text = file.read().replace("friction_policy: frozen", "friction_policy: consistent").replace("contact_policy: reference", "contact_policy: reached")
        cured = os.path.join(folder, "cured.yaml")
        with open(cured, "w", encoding="utf-8") as file:
            file.write(text)
        lines = run(folder, cured)
        if name == "11-1":  # it falls from the edge by its own weight: all of the energy is set free, and told
            if len(lines) != 1 or "0.125 J are set free, beside 0.125 J" not in lines[0]:
                faults.append(f"{name}, consistent: {lines}")
        elif lines:
            faults.append(f"{name}, consistent: {lines}")

    # most of the line is slack and some of it slides; and not most of it. The table says how much, and no rounding for a tension
    for name, said in (("souza-de-cursi-1990-circle", True), ("souza-de-cursi-1990", False), ("souza-de-cursi-1990-slack", True)):
        path, out = os.path.join(EXAMPLES, f"{name}.yaml"), os.path.join(folder, "out")
        if any(SLACK in line and "depend on the mesh" in line for line in run(folder, path)) != said:
            faults.append(f"{name}: a word on slack is {'missing' if said else 'said'}")
        table = subprocess.run([CAPSTAN, "run", path, "-o", out], capture_output=True, text=True, timeout=60).stdout.splitlines()
        with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
            steps = json.load(file)["steps"]
        for row, step in zip(table[2:], steps):
            line, cells = step["lines"]["cable"], row.split()
            wanted = [line[end]["tension_N"] for end in "AB"]
            wanted = [0 if tension < 1e-9*step["largest_force_N"] else tension for tension in wanted] + [line["slack_m"]]
            shown = [float(cell) for cell in (cells[-7], cells[-6], cells[-1])]
            if any(abs(a - b) > 1e-3*abs(b) for a, b in zip(shown, wanted)):
                faults.append(f"{name}, {step['name']}: table {shown}, summary {wanted}")

    # frozen bounds may hold nothing where mu R would: said with its figure, 0.5 (8 x 20 + 80) N, and only where it would
    scene = """capstan: 1
friction_policy: %s
obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}
lines:
  rope: {length: 8, elements: 40, weight: 20, stiffness: 1e5, start: {straight: {from: [0, 0, 0], to: [8, 0, 0]}}, ends: {A: free, B: free}}
history: [{name: press, rope.B: {force: [%s, 0, -80]}}]
"""
    for friction, force, code, said in (("frozen", 100, 5, True), ("consistent", 100, 0, False), ("frozen", 121, 5, False),
                                        ("consistent", 121, 5, False), ("frozen", 79, 0, False)):
        path = os.path.join(folder, "press.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(scene % (friction, force))
        done = subprocess.run([CAPSTAN, "run", path, "-o", os.path.join(folder, "press")], capture_output=True, text=True, timeout=60)
        if done.returncode != code or ("mu R, 120 N in all" in done.stderr) != said:
            faults.append(f"{friction}, {force} N: exit code {done.returncode}, {done.stderr}")
        with open(os.path.join(folder, "press", "summary.json"), encoding="utf-8") as file:
            proof = json.load(file)["steps"][0]["lines"]["rope"].get("proof", {})
        if proof.get("coulomb_N") != (120 if said else None):
            faults.append(f"{friction}, {force} N: proof {proof}")

    # a weight drawn over the crest of a drum with mu = 1/2, as in test_crest: it leaves at atan(mu), and hangs below A then
    theta = math.atan(0.5)
    a = math.sin(theta) + math.sqrt(1 - (1.2 - math.cos(theta))**2)
    jump = math.hypot(a - math.sin(theta), math.cos(theta) - 0.2)
    scene = {"capstan": 1, "gravity": [0, 0, -9.81], "solver": {"path_tolerance": 1e-3},
             "obstacles": {"drum": {"cylinder": {"point": [0, 0, 0], "axis": [0, 1, 0], "radius": 1}, "friction": 0.5}},
             "lines": {"string": {"length": 1, "elements": 1, "weight": 2, "stiffness": ".inf",
                                  "start": {"polyline": [[math.sqrt(0.96), 0, 1.2], [0, 0, 1]]}, "ends": {"A": "held", "B": "free"}}},
             "history": [{"name": "draw", "steps": 10, "string.A": {"position": [2, 0, 1.2]}}]}
    path = os.path.join(folder, "crest.yaml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(json.dumps(scene).replace('".inf"', ".inf"))
    told = [line for line in run(folder, path) if "the line jumps by" in line]
    # the limit lies within a part of 2^-10 of the step
    if len(told) != 1 or abs(float(told[0].split("jumps by ")[1].split()[0]) - jump) > 1.1e-3:
        faults.append(f"crest: {told}, expected a jump of {jump}")

    # a buoy between the ends is drawn out of the water: it lifts on, which is said with its height; without a surface it is not
    scene = """capstan: 1
water_density: 1000
%s
lines:
  rope: {length: 4, elements: 4, weight: 1, stiffness: 1e6, point_weights: [{at: 2, mass: 10, volume: 0.02}], start: static,
         ends: {A: {held: [0, 0, -4]}, B: {held: [0, 0, -0.5]}}}
history: [{name: up, rope.B: {position: [0, 0, 0]}, rope.A: {position: [0, 0, -4]}}]
"""
    for water, said in (("water_surface: -2.5", True), ("water_surface: 1", False), ("", False)):
        path = os.path.join(folder, "buoy.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(scene % water)
        told = [line for line in run(folder, path) if "the buoy at 2 m is" in line]
        height = float(told[0].split("the buoy at 2 m is ")[1].split()[0]) if told else 0
        if bool(told) != said or (said and abs(height - 0.5) > 1e-3):
            faults.append(f"buoy, {water}: {told}")

print("\n".join(faults) or "warnings: said with their figures, and only there")
sys.exit(1 if faults else 0)
