# SPDX-License-Identifier: BSD-3-Clause
"""Ropes that cannot stay where they are: those with a held end fall and hang from it, those without fall for ever.  usage: falls.py CAPSTAN

Ropes that lie level across a thin post: each falls off and hangs from its held end.

The rope is held at A, its other end is free, and at least 0.7 of it lie between A and the crest. The sag of a catenary over a span s pulls
with at least 0.754 w s at its supports, and what hangs beyond the crest with w h, so h > 0.6 L would be needed for a rope that stays: it
slides back over the post, however coarse the step, and friction on the post, exp(0.05 pi) at most, does not hold it. On its way nodes go round
the post by more than a quarter of a turn. Then it hangs straight: T_A = w L, and it is longer by w L^2/(2 EA).

Ropes with free ends over a drum, h on one side and H on the other: w H > exp(mu pi) (w h + what the arc can weigh) runs over and is gone. There is no
equilibrium: the line falls with all its weight along gravity, or is said to slide without end before."""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

CAPSTAN = sys.argv[1]
CASES = 24
faults = []


def scene(rng):
    radius, length, weight = rng.uniform(0.03, 0.1), rng.uniform(0.6, 1.2), rng.uniform(1, 4)
    angle, before, friction = rng.uniform(0.1, 0.5), rng.uniform(0.7, 0.95), rng.choice(["consistent", "frozen"])
    mu = rng.uniform(0, 0.05)
    along = [rng.choice([-1, 1])*length*math.sin(angle), rng.choice([-1, 1])*length*math.cos(angle)]
    along[0] = math.copysign(max(abs(along[0]), 1.2*radius/before), along[0])  # A is beside the post, not above it
    along[1] = math.copysign(math.sqrt(length**2 - along[0]**2), along[1])
    a = [-before*along[0], rng.uniform(-1, 1)]
    return {"capstan": 1, "friction_policy": friction, "gravity": [0, 0, -9.81],
            "obstacles": {"post": {"cylinder": {"point": [0, 0, 0], "axis": [0, 1, 0], "radius": radius}, "friction": mu}},
            "lines": {"rope": {"length": length, "elements": rng.choice([20, 40]), "weight": weight, "stiffness": 1e4,
                               "start": {"straight": {"from": [*a, radius], "to": [a[0] + along[0], a[1] + along[1], radius]}},
                               "ends": {"A": "held", "B": "free"}}},
            "history": [{"name": "let go", "steps": 1}]}


def runaway(rng):
    radius, mu, weight, friction = rng.uniform(0.05, 2), rng.uniform(0, 0.4), rng.uniform(0.1, 10), rng.choice(["consistent", "frozen"])
    short = rng.uniform(0.5, 2)*radius
    long = math.exp(mu*math.pi)*(short + 2*radius)*rng.uniform(1.2, 2)
    outside = radius/math.cos(math.pi/24)
    arc = [[outside*math.cos(math.pi*k/12), 0, outside*math.sin(math.pi*k/12)] for k in range(13)]
    points = [[outside, 0, -short], *arc, [-outside, 0, -long]]
    length = short + long + 24*outside*math.sin(math.pi/24)
    elements = int(math.ceil(length/(radius*math.pi/12)))
    return {"capstan": 1, "friction_policy": friction, "gravity": [0, 0, -9.81],
            "obstacles": {"drum": {"cylinder": {"point": [0, 0, 0], "axis": [0, 1, 0], "radius": radius}, "friction": mu}},
            "lines": {"rope": {"length": length, "elements": min(elements, 60), "weight": weight, "stiffness": rng.choice([1e3, 1e6])*weight*length,
                               "start": {"polyline": points}, "ends": {"A": "free", "B": "free"}}},
            "history": [{"name": "let go", "steps": rng.choice([1, 3])}]}


def solve(folder, name, given):
    """the exit code and the rope's last report"""
    path, out = os.path.join(folder, f"{name}.yaml"), os.path.join(folder, f"out-{name}")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(given, file)
    done = subprocess.run([CAPSTAN, "run", path, "-o", out], capture_output=True, text=True, timeout=120)
    if not os.path.exists(os.path.join(out, "summary.json")):
        sys.exit(done.stderr)
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return done.returncode, json.load(file)["steps"][-1]["lines"]["rope"]


def main():
    with tempfile.TemporaryDirectory() as folder:
        for case in range(CASES):
            given = scene(random.Random(case))
            code, line = solve(folder, case, given)
            rope = given["lines"]["rope"]
            load, below = rope["weight"]*rope["length"], rope["start"]["straight"]["from"]
            down = rope["length"]*(1 + load/(2*rope["stiffness"]))
            want = [below[0], below[1], below[2] - down]
            if code != 0:
                faults.append(f"{case}: exit {code}, {line['outcome']}")
                continue
            # places are known to the root of the relative gap of 1e-8, forces as well
            a, b = line["A"], line["B"]
            if not abs(a["tension_N"] - load) <= 1e-4*load:
                faults.append(f"{case}: tension {a['tension_N']!r} for {load!r}")
            if not math.dist(b["position_m"], want) <= 1e-4*rope["length"]:
                faults.append(f"{case}: end at {b['position_m']} for {want}")
        for case in range(CASES):
            given = runaway(random.Random(1000 + case))
            code, line = solve(folder, f"runaway-{case}", given)
            if code != 5 or line["outcome"] not in ("unbounded", "slides"):
                faults.append(f"runaway {case}, {given['friction_policy']}: exit {code}, {line['outcome']}")
            elif line["outcome"] == "unbounded":
                load = given["lines"]["rope"]["weight"]*given["lines"]["rope"]["length"]
                if not (abs(line["proof"]["fall_N"] - load) <= 1e-9*load and math.dist(line["proof"]["direction"], [0, 0, -1]) <= 1e-9):
                    faults.append(f"runaway {case}: falls with {line['proof']} for {load!r}")
    print("\n".join(faults))
    print(f"{2*CASES} ropes, {len(faults)} faults")
    return 1 if faults else 0


sys.exit(main())
