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


TWO = """
capstan: 1
obstacles: {bed: {plane: {}, friction: 0.4}}
points: {knot: {free: [40, 0, 0], mass: 500}, anchor: {held: [0, 0, 0]}, top: {held: [88, 0, 40]}}
lines:
  chain: {length: 45, elements: 20, weight: 200, stiffness: 1e6, start: static, ends: {A: {point: anchor}, B: {point: knot}}}
  rope: {length: 62, elements: 20, weight: 30, stiffness: 1e6, start: static, ends: {A: {point: knot}, B: {point: top}}}
history:
  - {name: out, steps: 2, top.point: {position: [91, 2, 40]}}
"""


def of_points():
    """point-stiffness.csv is the sum of stiffness.csv over the ends at the point."""
    at = {"knot": [("chain", "B"), ("rope", "A")], "anchor": [("chain", "A")], "top": [("rope", "B")]}
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scene.yaml"), "w", encoding="utf-8") as file:
            file.write(TWO)
        done = run(folder, "--stiffness", "-o", "out")
        check("said", "point-stiffness.csv" in done.stdout, done.stdout[-400:])
        units, points = table(os.path.join(folder, "out", "point-stiffness.csv"))
        _, lines = table(os.path.join(folder, "out", "stiffness.csv"))
        ends = {(row["step"], row["line"], row["end"], row["kind"]): row for row in lines}
        check("units of points", units["xx"] == "N/m" and units["smooth_zz"] == "N/m" and units["step"] == "1", units)
        check("rows of points", len(points) == 3 * 2 * 3, len(points))
        for row in points:
            check("found", row["outcome"] == "found", row)
            for column in (smooth + i + j for smooth in ("", "smooth_") for i in "xyz" for j in "xyz"):
                terms = [ends[row["step"], line, end, row["kind"]][column] for line, end in at[row["point"]]]
                check(column, (row[column] == "") == ("" in terms), (row, terms))
                if row[column]:
                    values = [float(t) for t in terms]
                    check(column, abs(float(row[column]) - sum(values)) <= 1e-12 * sum(map(abs, values)) + 1e-9, (row["point"], row[column], values))
        check("another run has none", "point-stiffness.csv" not in os.listdir(os.path.join(folder, "out")) or run(folder, "-o", "out") and
              "point-stiffness.csv" not in os.listdir(os.path.join(folder, "out")), "it is still there")


def main():
    of_points()
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
