#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The checker accepts bodies that hardly any force moves, or that turn far in each step.                                usage: free_bodies.py CAPSTAN CHECKER

A string without weight, whose tension is next to nothing, holds a body on which nothing else acts, or hydrostatics in the turn alone:

- spin: turns of 0.5 to 1.5 rad in each step, about axes that are not principal ones;
- over: about z by 2e-4 to 0.01 rad less, or more, than half a turn from where the hydrostatics begin, where the vector of the turn jumps;
- far: the body drifts 1e5 m from the origin, where its acceleration has few digits and no force is large beside its rounding.

The centre of gravity of the body has to go straight on, to the rounding of its place in each step.
"""
import csv
import os
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER = map(os.path.abspath, sys.argv[1:3])
STRING = 1000  # [m] so long that places are not measured from an origin nearby


def scene(at, rate, velocity, step, count, hydrostatics=""):
    return ("capstan: 1\ngravity: [0, 0, 0]\nbodies:\n"
            f"  top: {{free: [{at}, {-at}, 0], mass: 3, moments_of_inertia: [2, 3, 4], products_of_inertia: [0, 0, 0],{hydrostatics} "
            f"velocity: {velocity}, turn_rate: {rate}}}\n"
            "points: {eye: {body: top}}\n"
            f"lines: {{string: {{length: {0.99*STRING}, elements: 1, weight: 0, stiffness: 1e-12, quasi_static: true, start: {{straight: "
            f"{{from: [{at}, {-at}, {-STRING}], to: [{at}, {-at}, 0]}}}}, ends: {{A: held, B: {{point: eye}}}}}}}}\n"
            f"history: [{{name: go, duration: {step*count!r}, steps: {count}}}]\n")


def scenes():
    for turn in (0.5, 1.0, 1.5):
        yield f"spin {turn}", scene(0, [20*turn, 30*turn, 60*turn], [0, 0, 0], 1/70, 12)
    for less in (0.01, 1e-3, 2e-4, -2e-4, -1e-3):
        # 40 steps of one angle; a rate of the stiffness over the inertia that changes it by 1e-6 of itself
        yield f"over {less:g}", scene(0, [0, 0, 3.141592653589793 - less], [0, 0, 0], 1/40, 40, " hydrostatics: {rx: 3e-6, ry: 2e-6, rz: 1e-6},")
    yield "far", scene(1e5, [0.3, 0.5, -0.2], [0.5, 1, 0.2], 0.005, 60)


def run(folder, text):
    path, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
    with open(path, "w", encoding="ascii") as file:
        file.write(text)
    ran = subprocess.run([CAPSTAN, "run", "-q", path, "-o", out, "--force", "--no-paraview"], capture_output=True, text=True, check=False)
    if ran.returncode:
        return f"exit {ran.returncode}: {ran.stderr[-300:]}"
    checked = subprocess.run([CHECKER, os.path.join(out, "result.nc"), path], capture_output=True, text=True, check=False)
    if checked.returncode:
        return f"checker exit {checked.returncode}: {checked.stdout[-300:]}{checked.stderr[-300:]}"
    with open(os.path.join(out, "bodies.csv"), encoding="ascii") as file:
        x = [[float(row[a]) for a in ("x", "y", "z")] for row in csv.DictReader(file) if row["x"] and row["body"] == "top"]
    size = max(1, max(abs(v) for place in x for v in place))
    bent = max(abs(a[i] - 2*b[i] + c[i]) for a, b, c in zip(x, x[1:], x[2:]) for i in range(3))
    return "" if bent <= 1e-13*size*len(x) else f"off a straight line by {bent:.3g} m"


def main():
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, text in scenes():
            said = run(folder, text)
            print(f"{name}: {said or 'accepted'}")
            faults += bool(said)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
