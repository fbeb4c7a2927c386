#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What is let go in the middle of a history falls freely from there, with order 2.                                               usage: let_go.py CAPSTAN

A rope of one element hangs from its end A for a second, which is then released: its middle falls by g t^2/2, whatever the rope does.
"""
import csv
import math
import os
import subprocess
import sys
import tempfile

CAPSTAN, G, FALL = sys.argv[1], 9.81, 1.0
SCENE = """capstan: 1
gravity: [0, 0, -9.81]
lines:
  rope: {{length: 4, elements: 1, mass: 2, stiffness: 1e5, start: static, ends: {{A: {{held: [0, 0, 0]}}, B: free}}}}
history:
  - {{name: hang, duration: 1, time_step: {h}}}
  - {{name: let go, duration: 1, time_step: {h}, rope.A: {{release: true}}}}
"""


def off(folder, h):
    """[m] by which the middle is off after the fall."""
    path, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
    with open(path, "w", encoding="ascii") as file:
        file.write(SCENE.format(h=h))
    subprocess.run([CAPSTAN, "run", "-q", path, "-o", out, "--force", "--no-paraview"], check=True)
    with open(os.path.join(out, "history.csv"), encoding="ascii") as file:
        z = [(float(row["rope.A.z"]) + float(row["rope.B.z"]))/2 for row in list(csv.DictReader(file))[1:]]
    return z[-1] - z[0] + G*FALL*FALL/2


def main():
    with tempfile.TemporaryDirectory() as folder:
        errors = [abs(off(folder, h)) for h in (0.1, 0.05, 0.025)]
    order = math.log2(errors[1]/errors[2])
    print("let go: off by %.3e %.3e %.3e m, order %.2f" % (*errors, order))
    # the step in which it is let go is one of Euler's: its velocity is exact, its place off by g h^2/2, half again as much in all
    return 0 if abs(order - 2) < 0.1 and errors[0] < G*0.1**2 else 1


if __name__ == "__main__":
    sys.exit(main())
