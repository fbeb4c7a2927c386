# SPDX-License-Identifier: BSD-3-Clause
"""What lies on the ground at points. A mooring line is run in one piece between two held ends, and in two that meet at a free point, between
held points: grounded, slipping and suspended length, touchdown, sweep, uplift and angle are the same. The point may lie on the bed, hang, or
be where the line lifts off; the bed may slope, and rub or not.                                    usage: ground_at_points.py CAPSTAN [SEEDS]"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

CAPSTAN, SEEDS = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 24
ELEMENTS, WEIGHT, STIFFNESS = 40, 700.0, 3e8
faults = []


def scene(lines, points, history, slope, friction, depth):
    bed = {"plane": {"point": [0, 0, -depth], "normal": [-math.sin(slope), 0, math.cos(slope)]}, "friction": friction}
    keys = {"capstan": 1, "gravity": [0, 0, -9.81], "obstacles": {"bed": bed}, "lines": lines, "history": history, "solver": {"tolerance": 1e-10}}
    return json.dumps({**keys, "points": points} if points else keys)


def line(length, elements, a, b):
    return {"length": length, "elements": elements, "weight": WEIGHT, "stiffness": STIFFNESS, "start": "static", "ends": {"A": a, "B": b}}


def run(folder, name, text):
    path, out = os.path.join(folder, name + ".yaml"), os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([CAPSTAN, "run", path, "-o", out, "--no-paraview", "-q"], capture_output=True, text=True, timeout=300)
    if done.returncode not in (0, 1):
        faults.append(f"{name}: exit {done.returncode}: {done.stderr[-300:]}")
        return None
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def near(name, what, found, expected, size):
    if (found is None) != (expected is None) or (found is not None and not abs(found - expected) <= size):
        faults.append(f"{name}: {what} {found}, in one piece {expected}")


def compare(name, one, two, length, cut, rubs):
    """The steps that both have certified; returns how many of them have the point on the bed, at the edge of what lies there, and hanging, and
    how many are not compared."""
    kinds = [0, 0, 0, 0]
    for s, (step, other) in enumerate(zip(one["steps"], two["steps"])):
        if kinds[3] or step["substeps"] != other["substeps"]:
            kinds[3] += 1  # in other substeps friction has another way, also in all that follows
            continue
        if step["outcome"] != "solved" or other["outcome"] != "solved":
            continue
        whole, near_a, near_b = step["lines"]["line"], other["lines"]["low"], other["lines"]["high"]
        if whole["slack_m"] > 0 or whole["places_not_unique"]:
            continue  # the places of slack are not determined
        at, small = f"{name}, step {s}", 2e-6 * length
        near(at, "grounded", near_a["grounded_m"] + near_b["grounded_m"], whole["grounded_m"], small)
        near(at, "sweep", max(near_a["sweep_m"], near_b["sweep_m"]), whole["sweep_m"], small)
        if None not in (near_a["slipping_m"], near_b["slipping_m"], whole["slipping_m"]):
            near(at, "slipping", near_a["slipping_m"] + near_b["slipping_m"], whole["slipping_m"], small)
        on_bed = near_b["B"]["touchdown_m"] is not None
        suspended = near_b["B"]["suspended_m"] if on_bed else length - cut + near_a["B"]["suspended_m"]
        touchdown = near_b["B"]["touchdown_m"] if on_bed else near_a["B"]["touchdown_m"]
        # a line whose end touches begins there, also where it is not all of the half element that lies
        ends_there = not on_bed and near_a["B"]["suspended_m"] == 0
        half = 0.5 * length / ELEMENTS if ends_there else 0
        near(at, "suspended from B", suspended + 0.5 * half, whole["B"]["suspended_m"], small + 0.5 * half)
        for c in range(3):
            if not ends_there:
                near(at, f"touchdown {'xyz'[c]}", touchdown and touchdown[c], whole["B"]["touchdown_m"] and whole["B"]["touchdown_m"][c], small)
        near(at, "suspended from A", near_a["A"]["suspended_m"] if near_a["A"]["touchdown_m"] else length, whole["A"]["suspended_m"], small)
        force = 1e-6 * whole["B"]["tension_N"]
        near(at, "tension at B", near_b["B"]["tension_N"], whole["B"]["tension_N"], force)
        near(at, "uplift at A", near_a["A"]["uplift_N"], whole["A"]["uplift_N"], force + rubs)
        near(at, "uplift at B", near_b["B"]["uplift_N"], whole["B"]["uplift_N"], force)
        near(at, "angle at A", near_a["A"]["angle_rad"], whole["A"]["angle_rad"], 2e-3)
        state = other["points"]["knot"]["state"]
        kinds[2 if state == "free" else 0 if near_b["grounded_m"] > 0.6 * length / ELEMENTS else 1] += 1
    return kinds


def moored(seed, folder):
    r = random.Random(seed)
    length = 10 ** r.uniform(1.5, 3)
    depth = length * r.uniform(0.1, 0.3)
    slope, friction = r.choice([0, 0, r.uniform(-0.05, 0.05)]), r.choice([0, r.uniform(0.1, 0.8)])
    far = math.sqrt(length ** 2 - depth ** 2) - r.uniform(0.02, 0.1) * depth
    anchor, fairlead = [0, 0, -depth], [far, 0, 0]
    stages = [("nearer", [far - 0.05 * depth, 0, 0]), ("aside", [far - 0.05 * depth, 0.04 * length, 0]), ("back", fairlead)]
    one = run(folder, f"one-{seed}", scene({"line": line(length, ELEMENTS, {"held": anchor}, {"held": fairlead})}, None,
                                           [{"name": n, "steps": 2, "line.B": {"position": p}} for n, p in stages], slope, friction, depth))
    # the point anywhere, or at the node where the line lifts off in some step
    lift = length - r.choice(one["steps"])["lines"]["line"]["B"]["suspended_m"]
    k = min(ELEMENTS - 2, max(2, r.choice([r.randint(2, ELEMENTS - 2), round(lift / length * ELEMENTS)])))
    cut, at = length * k / ELEMENTS, far * k / ELEMENTS
    points = {"anchor": {"held": anchor}, "knot": {"free": [at, 0, at * math.tan(slope) - depth + 0.01 * length]}, "fairlead": {"held": fairlead}}
    two = run(folder, f"two-{seed}", scene({"low": line(cut, k, {"point": "anchor"}, {"point": "knot"}),
                                            "high": line(length - cut, ELEMENTS - k, {"point": "knot"}, {"point": "fairlead"})}, points,
                                           [{"name": n, "steps": 2, "fairlead.point": {"position": p}} for n, p in stages], slope, friction, depth))
    # on a slope the friction of the half element beside a held end has a part upwards
    rubs = abs(math.sin(slope)) * friction * 0.5 * WEIGHT * length / ELEMENTS
    return compare(f"seed {seed}", one, two, length, cut, rubs) if one and two else [0, 0, 0, 0]


with tempfile.TemporaryDirectory() as folder:
    counts = [sum(k) for k in zip(*(moored(seed, folder) for seed in range(1, SEEDS + 1)))]
print(f"{SEEDS} moorings, {sum(counts)} steps certified in both: the point lies on the bed in {counts[0]}, "
      f"where the line lifts off in {counts[1]}, hangs in {counts[2]}; "
      f"{counts[3]} came there in other substeps")
if min(counts[:3]) == 0:
    faults.append("a kind of place was not met")
if counts[3] > 0.3 * sum(counts):
    faults.append("too few can be compared")
for fault in faults[:30]:
    print(fault)
sys.exit(1 if faults else 0)
