# SPDX-License-Identifier: BSD-3-Clause
"""Ropes with free ends that lie straight in the groove between two planes and are pulled along it.  usage: groove.py CAPSTAN CHECKER [SEED [CASES]]

The planes rise by `slope` to both sides, W is the weight of the rope and P the pull along the groove. Friction across the groove may press the rope
into it, so it holds at most what associated flow would: no reactions of any size balance P > W t, t = mu/(cos(slope) sqrt(1 - mu^2 tan^2(slope))),
and none balance any P where the planes do not jam and mu = 0 (docs/theory.md, 2.8). Moved along the groove and up by the angle atan(t), the rope
leaves both planes as steeply as friction on them asks: the proof is this direction, and the fall is P cos - W sin. Below P = mu W/cos(slope), which
friction along the groove holds by itself, the rope is in equilibrium.

Beyond that, frozen bounds do not hold the rope: the proof is a direction too, and the fall what is left of the pull. With frozen friction the bounds of a step are mu times the reactions of the step before, to the last bits but for the product, also where the
reactions hardly change and the forces of a rope with free ends are balanced at last: the checker compares them."""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER = sys.argv[1:3]
SEED, CASES = int(sys.argv[3]) if len(sys.argv) > 3 else 0, int(sys.argv[4]) if len(sys.argv) > 4 else 16
SOLVED, NO_SOLUTION = 0, 5
faults = []


def groove(rng, mu, other):
    """a scene without history, the direction along the groove, and up"""
    slope = rng.uniform(0.2, 0.9)*math.atan(1/mu if mu > 0 else math.inf)
    angle, length = rng.uniform(0, 6.28), rng.choice([0.1, 1, 30])*rng.uniform(0.5, 2)
    along, aside = [-math.sin(angle), math.cos(angle), 0.0], [math.cos(angle), math.sin(angle), 0.0]
    planes = {name: {"plane": {"point": [0, 0, 0], "normal": [sign*math.sin(slope)*x + math.cos(slope)*z for x, z in zip(aside, (0, 0, 1))]}, "friction": rub}
              for name, sign, rub in (("left", 1, mu), ("right", -1, other))}
    rope = {"length": length, "elements": rng.randint(2, 40), "weight": rng.uniform(0.1, 10), "stiffness": 1e4*length,
            "start": {"straight": {"from": [0, 0, 0], "to": [length*x for x in along]}}, "ends": {"A": "free", "B": "free"}}
    return {"capstan": 1, "obstacles": planes, "lines": {"rope": rope}, "history": []}, slope, along


def solve(folder, name, scene, what):
    """the exit code, the reports of the rope, and that the checker agrees"""
    path, out = os.path.join(folder, f"{name}.yaml"), os.path.join(folder, f"out-{name}")
    with open(path, "w", encoding="utf-8") as file:
        file.write(json.dumps(scene).replace("Infinity", ".inf"))
    done = subprocess.run([CAPSTAN, "run", "-q", "--no-paraview", "--sync", "end", path, "-o", out], capture_output=True, text=True, timeout=120)
    if not os.path.exists(os.path.join(out, "summary.json")):
        sys.exit(done.stderr)
    said = subprocess.run([CHECKER, os.path.join(out, "result.nc"), path, "-v"], capture_output=True, text=True, timeout=120)
    if "refuted 0" not in said.stdout or "0 findings" not in said.stdout:
        faults.append(f"{what} {name}: {said.stdout} {said.stderr}")
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return done.returncode, [step["lines"]["rope"] for step in json.load(file)["steps"]]


def pulled(folder, case):
    """beyond what any forces hold, and below what friction along the groove holds"""
    rng = random.Random(f"pulled {SEED} {case}")
    mu = 0 if case % 4 == 0 else rng.uniform(0.05, 1)
    scene, slope, along = groove(rng, mu, mu)
    rope = scene["lines"]["rope"]
    weight = rope["weight"]*rope["length"]
    steep = mu/(math.cos(slope)*math.sqrt(1 - (mu*math.tan(slope))**2))
    over, steps = rng.choice([1.001, 1.1, 3]), rng.randint(1, 4)
    pull = weight*(steep*over if mu > 0 else rng.uniform(0.01, 2))
    scene["history"] = [{"name": "pull", "steps": steps, "rope.B": {"force": [pull*x for x in along]}}]
    code, reports = solve(folder, f"pulled-{case}", scene, "pulled")
    last, fall = reports[-1], (pull - weight*steep)/math.hypot(1, steep)
    if code != NO_SOLUTION or last["outcome"] != "unbounded":
        faults.append(f"pulled {case}: mu {mu:.3g}, {over} of what holds: exit {code}, {last['outcome']}")
    elif steps == 1 and not abs(last["proof"]["fall_N"] - fall) <= 1e-7*(pull + weight):
        faults.append(f"pulled {case}: falls by {last['proof']['fall_N']!r} N/m for {fall!r}")
    if mu > 0:
        scene["history"][0]["rope.B"] = {"force": [0.99*mu*weight/math.cos(slope)*x for x in along]}
        code, reports = solve(folder, f"held-{case}", scene, "held")
        if code != SOLVED:
            faults.append(f"held {case}: mu {mu:.3g}: exit {code}, {reports[-1]['outcome']}")


def frozen(folder, case):
    """pulled to and fro by less than friction holds"""
    rng = random.Random(f"frozen {SEED} {case}")
    scene, slope, along = groove(rng, rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9))
    rope, least = scene["lines"]["rope"], min(o["friction"] for o in scene["obstacles"].values())
    hold = least*rope["weight"]*rope["length"]
    scene["friction_policy"] = "frozen"
    for k in range(4):
        pull = [hold*rng.uniform(-0.5, 0.5)*x + hold*rng.uniform(-0.2, 0.2) for x in along]
        scene["history"].append({"name": f"pull {k}", "steps": 3, "rope.B": {"force": pull}})
    if case % 2:
        rope["stiffness"] = math.inf
    solve(folder, f"frozen-{case}", scene, "frozen")


def outrun(folder, case):
    """pulled along by more than frozen bounds hold, after a step that they hold; reactions, and bounds, may be those that associated flow allows"""
    rng = random.Random(f"outrun {SEED} {case}")
    scene, slope, along = groove(rng, rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9))
    rope, most = scene["lines"]["rope"], max(o["friction"] for o in scene["obstacles"].values())
    if case % 4 == 1:  # zones of more and of less friction; hold is what the greatest of them would
        rope["friction_zones"] = [{"from": 0, "to": 0.3*rope["length"], "factor": 1.4}, {"from": 0.5*rope["length"], "to": rope["length"], "factor": 0.9}]
        most *= 1.4
    if case % 4 == 3:  # the disc round a box
        for plane in scene["obstacles"].values():
            plane["friction"] = {"axial": plane["friction"], "lateral": plane["friction"], "shape": "box"}
        most *= math.sqrt(2)
    hold = most*rope["weight"]*rope["length"]/(math.cos(slope)*math.sqrt(1 - min(0.9, most*math.tan(slope))**2))
    pulls = [rng.uniform(0.05, 0.2)*hold, rng.uniform(1.02, 3)*hold]
    scene["friction_policy"] = "frozen"
    scene["history"] = [{"name": f"pull {k}", "steps": 1, "rope.B": {"force": [pull*x for x in along]}} for k, pull in enumerate(pulls)]
    if case % 2:
        rope["stiffness"] = math.inf
    code, reports = solve(folder, f"outrun-{case}", scene, "outrun")
    if code != NO_SOLUTION or reports[-1]["outcome"] != "unbounded":
        faults.append(f"outrun {case}: {pulls[1]/hold:.3g} of what holds: exit {code}, {reports[-1]['outcome']}")
    elif not pulls[1] - hold <= reports[-1]["proof"]["fall_N"] <= math.hypot(pulls[1], rope["weight"]*rope["length"]):
        faults.append(f"outrun {case}: falls by {reports[-1]['proof']['fall_N']!r} N/m, at least {pulls[1] - hold!r} expected")


def main():
    with tempfile.TemporaryDirectory() as folder:
        for case in range(CASES):
            pulled(folder, case)
            frozen(folder, case)
            outrun(folder, case)
    print("\n".join(faults))
    print(f"{3*CASES} scenes, {len(faults)} faults")
    return 1 if faults else 0


sys.exit(main())
