#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run with springs, given loads and ground that gives: the energy balance of history.csv closes with the work of the loads, which a
scene without them does not have, and a run that is stopped and resumed has the same numbers.

usage: loads.py CAPSTAN
"""
import csv
import os
import signal
import subprocess
import sys
import tempfile
import time

CAPSTAN = os.path.abspath(sys.argv[1])
SCENE = """
capstan: 1
obstacles: {clay: {plane: {point: [0, 0, 0]}, friction: 0.4, stiffness: 3000}}
lines:
  rope:
    length: 30
    elements: ELEMENTS
    weight: 40
    bearing_width: 0.2
    stiffness: 2e5
    LOADS
    start: static
    ends: {A: {held: [0, 0, 0]}, B: {held: [24, 0, 9]}}
history:
  - {name: draw, rope.B: {position: [26, 2, 9]}, steps: STEPS}
"""
LOADS = """springs: [{from: 3, to: 9, stiffness: [2, 30, 4], coupling: [1, 0, 2], place: [6, 1, 0]}]
    loads: [{force: [0, 6, 2], from: 12}]"""
BALANCE = ("ends", "obstacles", "elastic", "gravity", "dissipated", "imbalance")


def write(folder, name, loads, elements, steps):
    path = os.path.join(folder, name)
    with open(path, "w", encoding="ascii") as out:
        out.write(SCENE.replace("LOADS", loads).replace("ELEMENTS", str(elements)).replace("STEPS", str(steps)))
    return path


def rows_of(out):
    with open(os.path.join(out, "history.csv"), newline="") as file:
        return list(csv.reader(file))


def balance_closes(folder):
    for name, loads in (("with.yaml", LOADS), ("without.yaml", "")):
        out = os.path.join(folder, name + "-out")
        subprocess.run([CAPSTAN, "run", "-q", "--no-paraview", write(folder, name, loads, 60, 8), "-o", out], check=True)
        names, units, *rows = rows_of(out)
        assert ("loads" in names) == bool(loads), names
        if loads:
            assert units[names.index("loads")] == "J"
        worked = 0
        for row in rows[1:]:  # but for the static start, which has no balance
            of = {key: float(row[names.index(key)]) for key in BALANCE + (("loads",) if loads else ())}
            left = of["ends"] + of["obstacles"] + of.get("loads", 0) - sum(of[key] for key in BALANCE[2:])
            assert abs(left) <= 1e-9*sum(abs(value) for value in of.values()), (name, of)
            worked += abs(of.get("loads", 0))
        assert (worked > 1) == bool(loads), worked


def resumed_is_the_same(folder):
    """Stopped once the journal has some steps, wherever that is."""
    scene = write(folder, "long.yaml", LOADS, 400, 60)
    whole, parts = os.path.join(folder, "whole"), os.path.join(folder, "parts")
    subprocess.run([CAPSTAN, "run", "-q", "--no-paraview", scene, "-o", whole], check=True)
    run = subprocess.Popen([CAPSTAN, "run", "-q", "--no-paraview", scene, "-o", parts])
    time.sleep(0.3)
    run.send_signal(signal.SIGINT)
    run.wait()
    subprocess.run([CAPSTAN, "run", "-q", "--no-paraview", scene, "-o", parts, *(["--resume"] if run.returncode else ["--force"])], check=True)
    kept = [[[value for name, value in zip(rows[0], row) if name != "wall"] for row in rows] for rows in (rows_of(whole), rows_of(parts))]
    assert kept[0] == kept[1]


def main():
    with tempfile.TemporaryDirectory() as folder:
        balance_closes(folder)
        resumed_is_the_same(folder)
    print("the balance closes with the work of the loads; a resumed run has the same numbers")


if __name__ == "__main__":
    main()
