#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A line begins with its velocity also where the first step places other lines.                                         usage: first_velocity.py CAPSTAN CHECKER

A rope hangs from its end A and is thrown aside. It starts straight below A, once alone, once beside a line that starts static: in that
step it stretches under its weight, and after it it moves as a rope that itself starts static, with the kinetic energy of its velocity. An entry
without a duration takes the velocity away.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER = sys.argv[1:]
LENGTH, ELEMENTS, MASS, VELOCITY = 3.0, 6, 2.0, [0.4, -0.7, 0.0]
STRAIGHT = {"straight": {"from": [0, 0, 0], "to": [0, 0, -LENGTH]}}


def scene(start, beside, rests):
    """The rope by its kind of start, with a static line beside it or not, after an entry without a duration or not."""
    rope = {"length": LENGTH, "elements": ELEMENTS, "mass": MASS, "stiffness": 1e4, "velocity": VELOCITY, "start": start,
            "ends": {"A": {"held": [0, 0, 0]}, "B": "free"}}
    other = {"length": 2.5, "elements": 5, "mass": 1, "stiffness": 1e4, "start": "static",
             "ends": {"A": {"held": [0, 9, 0]}, "B": {"held": [2, 9, 0]}}}
    moves = {"name": "swing", "duration": 1, "steps": 50}
    return {"capstan": 1, "lines": {"rope": rope, "other": other} if beside else {"rope": rope},
            "history": [{"name": "rest"}, moves] if rests else [moves]}


def run(folder, *what):
    path, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
    with open(path, "w", encoding="ascii") as file:
        json.dump(scene(*what), file)
    subprocess.run([CAPSTAN, "run", "-q", path, "-o", out, "--force", "--no-paraview"], check=True)
    subprocess.run([CHECKER, os.path.join(out, "result.nc"), path], check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return json.load(file)["steps"]


def largest(a, b):
    """[m] by which the free end of two runs differs at most."""
    return max(math.dist(p["lines"]["rope"]["B"]["position_m"], q["lines"]["rope"]["B"]["position_m"]) for p, q in zip(a, b))


def main():
    with tempfile.TemporaryDirectory() as folder:
        placed, beside = run(folder, "static", True, False), run(folder, STRAIGHT, True, False)
        still, alone = run(folder, STRAIGHT, True, True), run(folder, STRAIGHT, False, False)
    kinetic = MASS*(LENGTH - LENGTH/ELEMENTS/2)*sum(c*c for c in VELOCITY)/2  # the held node has half an element
    off, lost = largest(placed, beside), max(abs(step["ledger_J"]["settling"]) for step in beside)
    error = abs(beside[0]["kinetic_J"] - kinetic)
    swung = math.dist(beside[-1]["lines"]["rope"]["B"]["position_m"], alone[-1]["lines"]["rope"]["B"]["position_m"])
    kept = max(abs(step["kinetic_J"]) for step in still[1:])
    taken = sum(step["ledger_J"]["settling"] for step in still)
    bounce = 2*MASS*9.81*LENGTH**2/2/1e4  # about the stretch under its weight, from none to twice
    print("beside a line that starts static: %.1e m off one that does, %.1e J of kinetic energy off, %.1e J lost" % (off, error, lost))
    print("alone, from the shape without stretch, it ends %.3f m from there; after a step at rest %.1e J, of %.3f J taken" % (swung, kept, taken))
    return 0 if off < 1e-8*LENGTH and error < 1e-12*kinetic and lost == 0 and swung < bounce and kept < 1e-9 and abs(taken - kinetic) < 1e-9 else 1


if __name__ == "__main__":
    sys.exit(main())
