#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A buoy within a line that floats, deep under water, moves as one that does not.                                      usage: floats_in_lines.py CAPSTAN CHECKER

It has its mass, or the inertia given, and begins with the velocity of its line, which is drawn taut between two hooks, of which one swings. A
clump at the same node is part of it. By Euler's method, which the first steps of a float have anyway, both move alike. A line that starts
static has its float at rest, and is refused with a velocity.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER = sys.argv[1:]
LENGTH, STRETCHED = 6.0, 6.6


def scene(floats, given, start):
    weight = {"at": 3, "mass": 30, "volume": 0.04}
    weight.update({"inertia": 75} if given else {}, **({"floats": True} if floats else {}))
    line = {"length": LENGTH, "elements": 12, "mass": 3, "stiffness": 2e4, "velocity": [0, 0.3, 0.5], "start": start,
            "point_weights": [weight, {"at": 3, "mass": 12, "inertia": 14}],
            "ends": {"A": {"held": [0, 0, 0]}, "B": {"held": [STRETCHED, 0, 0]}}}
    return {"capstan": 1, "time_scheme": "euler", "water_density": 1025, "water_surface": 40, "lines": {"rope": line},
            "history": [{"duration": 0.6, "steps": 60, "rope.A": {"move": [0, 0, 0], "cosine": [0.02, 0, 0.1], "period": 0.9}}]}


def write(folder, *what):
    path = os.path.join(folder, "scene.yaml")
    with open(path, "w", encoding="ascii") as file:
        json.dump(scene(*what), file)
    return path, os.path.join(folder, "out")


def ends(folder, floats, given):
    """The forces on both ends after each step."""
    path, out = write(folder, floats, given, {"straight": {"from": [0, 0, 0], "to": [STRETCHED, 0, 0]}})
    subprocess.run([CAPSTAN, "run", "-q", path, "-o", out, "--force", "--no-paraview"], check=True)
    subprocess.run([CHECKER, os.path.join(out, "result.nc"), path], check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        steps = json.load(file)["steps"]
    a, b = ("rope-1", "rope-2") if floats else ("rope", "rope")
    return [step["lines"][a]["A"]["force_N"] + step["lines"][b]["B"]["force_N"] for step in steps]


def main():
    fine = True
    with tempfile.TemporaryDirectory() as folder:
        for given in (False, True):
            floats, under = ends(folder, True, given), ends(folder, False, given)
            size = max(math.hypot(*force[:3]) for force in under)
            off = max(math.dist(p, q) for p, q in zip(floats, under))
            print("inertia %s: forces at the ends %.1e of %.0f N off" % ("given" if given else "not given", off, size))
            fine = fine and off < 1e-7*size
        path, _ = write(folder, True, False, "static")
        done = subprocess.run([CAPSTAN, "check", path], capture_output=True, text=True, check=False)
    refused = done.returncode == 3 and "point 'rope-float-1': velocity: lines that start static" in done.stderr
    print("static, with a velocity: %s" % ("refused" if refused else "not refused"))
    return 0 if fine and refused else 1


if __name__ == "__main__":
    sys.exit(main())
