# SPDX-License-Identifier: BSD-3-Clause
"""A rope that a turning pipe draws into the corner between two pipes and the bed.  usage: jams.py CAPSTAN CHECKER

A rope lies over two half-buried pipes that cross. One of them turns while the rope's end is pulled away. On its way the rope is borne by
both pipes and the bed at once, friction on the turning pipe presses it into the corner, and no load step, however small, leads to an
equilibrium near by. What is asked: the step ends with a certificate, it says that the line jumped, and the independent checker confirms
every record; end B is free, so its element carries the force that pulls it, to the weight of half an element."""
import json
import math
import os
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER = sys.argv[1:3]
PULL = [-0.45, -0.36, 0.36]
SCENE = f"""capstan: 1
gravity: [0, 0, -9.81]
obstacles:
  bed: {{plane: {{point: [0, 0, 0], normal: [0, 0, 1]}}, friction: 0.27}}
  smooth: {{cylinder: {{point: [-0.19, 0.02, 0.066], axis: [1.0, 0.2, 0.11], radius: 0.095}}, friction: 0}}
  rough: {{cylinder: {{point: [-0.03, -0.16, 0.007], axis: [-0.8, 0, -0.08], radius: 0.092}}, friction: 0.68}}
lines:
  rope:
    length: 1
    elements: 12
    weight: 1
    stiffness: .inf
    start: {{straight: {{from: [0, 0, 0.3], to: [0.8, 0.0, 0.9]}}}}
    ends: {{A: {{held: [0, 0, 0.3]}}, B: {{held: [0.8, 0.0, 0.9]}}}}
history:
  - {{name: down, rope.B: {{position: [-0.11, -0.08, 0.06]}}, steps: 2}}
  - {{name: turn, rope.B: {{force: {PULL}}}, rough.turn: -25, steps: 1}}
  - {{name: back, rope.B: {{force: [0.08, -0.08, 0]}}, rough.turn: 25, steps: 1}}
"""
# a soft rope on the bed is drawn into the corner of two pipes; one node is borne by both and the bed
CORNER = """capstan: 1
friction_policy: %s
gravity: [0, 0, -9.81]
obstacles:
  bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.25}
  raised: {cylinder: {point: [0.158, -0.358, 0.23], axis: [0.986, -0.125, 0.114], radius: 0.222}, friction: 0.09}
  buried: {cylinder: {point: [-0.188, 0.246, 0.021], axis: [0.262, 0.96, 0.096], radius: 0.174}, friction: 0.19}
lines:
  rope: {length: 1.122, elements: 34, weight: 0.9, stiffness: 3.2, start: {straight: {from: [0, 0, 0], to: [1.122, 0, 0]}}, ends: {A: held, B: free}}
history:
  - {name: pull, rope.B: {force: [-4.716, 0.34, -0.694]}}
"""


def corner(folder, friction):
    """the plane at such a node is no bend, for the checker either"""
    path, out = os.path.join(folder, "corner.yaml"), os.path.join(folder, friction)
    with open(path, "w", encoding="utf-8") as file:
        file.write(CORNER % friction)
    done = subprocess.run([CAPSTAN, "run", path, "--no-paraview", "-o", out], capture_output=True, text=True, check=False)
    check = subprocess.run([CHECKER, os.path.join(out, "result.nc")], capture_output=True, text=True, check=False)
    return [] if done.returncode == 0 and check.returncode == 0 else [f"corner, {friction}: {done.stderr} the checker says: {check.stdout}{check.stderr}"]


def main():
    with tempfile.TemporaryDirectory() as folder:
        path, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
        with open(path, "w", encoding="utf-8") as file:
            file.write(SCENE)
        done = subprocess.run([CAPSTAN, "run", path, "--no-paraview", "-o", out], capture_output=True, text=True, check=False)
        with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
            steps = json.load(file)["steps"]
        faults = [f"step {step['name']} ends as {step['outcome']}" for step in steps if step["outcome"] not in ("solved", "taut")]
        turn = next(step for step in steps if step["name"] == "turn")
        if not faults and not turn["jumps"] > 0:
            faults.append("the step does not say that the line jumped")
        tension = turn["lines"]["rope"]["B"]["tension_N"]
        if abs(tension - math.hypot(*PULL)) > 0.5/12:
            faults.append(f"end B carries {tension} N instead of {math.hypot(*PULL)} N")
        if done.returncode != 0:
            faults.append(f"exit code {done.returncode}: {done.stderr}")
        check = subprocess.run([CHECKER, os.path.join(out, "result.nc")], capture_output=True, text=True, check=False)
        if check.returncode != 0:
            faults.append(f"the checker says: {check.stdout}{check.stderr}")
        faults += corner(folder, "consistent") + corner(folder, "frozen")
    print("\n".join(faults) or "a rope in the corner of two pipes and the bed comes to rest, certified")
    sys.exit(bool(faults))


main()
