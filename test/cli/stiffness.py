#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run --stiffness: the matrices of stiffness.csv against the forces of history.csv in small steps, the file after a resumed run, and
what becomes of it in a run without.                                                                                  usage: stiffness.py CAPSTAN
"""

import csv
import os
import subprocess
import sys
import tempfile

CAPSTAN = os.path.abspath(sys.argv[1])

# the moves are so small that no node changes its state between two steps; the anchor lies on the bed
SCENE = """
capstan: 1
obstacles: {bed: {plane: {}, friction: 0.4}}
lines:
  mooring:
    length: 100
    elements: 50
    weight: 200
    stiffness: 1e6
    start: static
    ends: {A: {held: [0, 0, 0]}, B: {held: [85, 0, 30]}}
history:
  - {name: out, steps: 2, mooring.B: {position: [86, 1, 30.5]}}
  - {name: on, steps: 4, mooring.B: {position: [86.0004, 1.0004, 30.5002]}}
"""

failed = 0


def check(name, holds, found=""):
    global failed
    if not holds:
        failed += 1
        print(f"FAILED {name}: {found}")


def run(folder, *more, code=0):
    done = subprocess.run([CAPSTAN, "run", "scene.yaml", "--no-paraview", *more], cwd=folder, capture_output=True, text=True, timeout=120)
    check(f"run {more}", done.returncode == code, f"exit {done.returncode}: {done.stderr}")
    return done


def table(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return rows[0], rows[1:]


def against_history(folder, out):
    """K of one step times the way to the next is the change of the force: what slides goes on."""
    units, rows = table(os.path.join(folder, out, "stiffness.csv"))
    _, history = table(os.path.join(folder, out, "history.csv"))
    check("units", units["xx"] == "N/m" and units["zz"] == "N/m" and units["step"] == "1", units)
    check("rows", len(rows) == 4 * len(history), f"{len(rows)} of {len(history)} steps")
    compared = 0
    for row in rows:
        if row["end"] == "A":
            check("anchor on the bed", row["outcome"] == "touches" and row["xx"] == "", row)
            continue
        check("fairlead", row["outcome"] == "found", row)
        step = int(row["step"])
        if row["kind"] != "step" or step < 3 or step + 1 >= len(history):
            continue
        now, after = history[step], history[step + 1]
        way = [float(after["mooring.B." + x]) - float(now["mooring.B." + x]) for x in "xyz"]
        for x in "xyz":
            wanted = float(after["mooring.B.f" + x]) - float(now["mooring.B.f" + x])
            got = sum(float(row[x + y]) * d for y, d in zip("xyz", way))
            # the second derivative over 1e-4 m: 3e-5 to 8e-5 of the change; forces are known to 1e-6 N
            check(f"step {step}, {x}", abs(got - wanted) <= 2e-4 * abs(wanted) + 1e-6, f"{got} N, expected {wanted} N")
            compared += 1
    check("compared", compared >= 6, compared)


def main():
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scene.yaml"), "w", encoding="utf-8") as file:
            file.write(SCENE)
        said = run(folder, "-o", "out", "--stiffness").stdout
        check("said", "stiffness.csv" in said, said)
        against_history(folder, "out")
        with open(os.path.join(folder, "out", "stiffness.csv"), "rb") as file:
            whole = file.read()
        run(folder, "-q", "-o", "out", "--stiffness", "--threads=2")
        with open(os.path.join(folder, "out", "stiffness.csv"), "rb") as file:
            check("the same bytes", file.read() == whole)
        check("not said", "stiffness.csv" not in run(folder, "-o", "out").stdout)
        check("removed by a run without", not os.path.exists(os.path.join(folder, "out", "stiffness.csv")))
        os.mkdir(os.path.join(folder, "mine"))
        with open(os.path.join(folder, "mine", "stiffness.csv"), "w", encoding="utf-8") as file:
            file.write("mine")
        run(folder, "-q", "-o", "mine", "--stiffness", code=4)
        with open(os.path.join(folder, "mine", "stiffness.csv"), encoding="utf-8") as file:
            check("a file of somebody else", file.read() == "mine")
    print(f"{failed} failed")
    return failed > 0


sys.exit(main())
