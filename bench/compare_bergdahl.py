#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A chain whose upper end goes round in a circle: computed beside measured.     usage: compare_bergdahl.py [--capstan CAPSTAN] [--only PERIOD]

The experiment is that of Bergdahl, Palm, Eskilsson and Lindahl (2016), J. Mar. Sci. Eng. 4(1), 5: a chain of 33 m in water of 3 m over a concrete
floor, its anchor 32.554 m off, its upper end on a circle of radius R about a point 0.3 m above the water, in the line's plane, with the period T.
Their tables 7 and 8 give the line and the mean of each cycle's largest force at that end, for six periods and five radii.

The coefficients are theirs, as the decks of CableDyn (SMI-Lab-Inha/CableDyn) hand them down, and none is fitted: normal drag 2.5 and tangential drag 0.5, both on the links' wire of 2.2 mm; added mass 3.8
times the water that the steel displaces; friction coefficient 0.3. The floor is rigid and there is no internal damping. The tangential one of a scene is
on the circumference, so it is 0.5/pi, and its added mass is on the circle of 2.2 mm, so it is 3.8 times (0.0818 kg/m / 7800 kg/m3) over the area of that.

100 elements, 200 steps in a period (BDF2), eight periods, of which the last three are read. For the fastest of the large circles, meshes and steps are varied too, and the
added mass is put on the circle of 2.2 mm. Writes bench/results/bergdahl.json and prints its tables. About ten minutes."""
import argparse
import csv
import json
import math
import os
import subprocess
import tempfile

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), ".."))
RADIUS = (0.075, 0.1, 0.125, 0.15, 0.2)  # m
MEASURED = {1.25: (42.5, 46.8, 54.1, 60.4, 70.3), 1.5: (41.0, 45.3, 51.5, 59.0, 68.0), 2.0: (36.0, 39.5, 47.5, 54.1, 62.3),
            2.5: (31.1, 35.4, 42.5, 49.0, 57.3), 3.0: (29.5, 33.1, 39.3, 45.8, 54.0), 3.5: (27.8, 31.5, 37.5, 42.5, 50.1)}  # N, by period in s
PERIODS, LAST = 8, 3
WIRE, MASS, STEEL = 0.0022, 0.0818, 7800.0  # m, kg/m, kg/m3
ADDED = 3.8 * MASS / STEEL / (math.pi / 4 * WIRE**2)
SCENE = """capstan: 1
gravity: [0, 0, -9.80665]
water_density: 1000
obstacles:
  floor: {{plane: {{point: [0, 0, -3], normal: [0, 0, 1]}}, friction: 0.3}}
lines:
  chain:
    length: 33
    elements: {elements}
    weight: 0.699
    inertia: {mass}
    stiffness: 1e4
    drag: {{diameter: {wire}, normal: 2.5, tangential: {tangential}, added_normal: {added}}}
    start: static
    ends: {{A: {{held: [-32.554, 0, -3]}}, B: {{held: [{begin}, 0, 0.3]}}}}
history:
{history}"""


def rows_of(capstan, history, begin, elements, added):
    """Rows of history.csv below its units and the start."""
    with tempfile.TemporaryDirectory() as folder:
        scene, out = (os.path.join(folder, name) for name in ("scene.yaml", "out"))
        with open(scene, "w", encoding="ascii") as file:
            file.write(SCENE.format(elements=elements, mass=MASS, wire=WIRE, tangential=0.5 / math.pi, added=added, begin=begin, history=history))
        subprocess.run([capstan, "run", "--quiet", scene, "-o", out, "--no-paraview"], check=True, capture_output=True)
        with open(os.path.join(out, "history.csv"), encoding="ascii") as file:
            return list(csv.DictReader(file))[2:]


def circle(capstan, period, radius, elements=100, steps=200, added=ADDED):
    """Mean of the largest forces of the last cycles, and the number of steps that are not certified."""
    history = (f"  - {{name: turn, duration: {PERIODS * period!r}, time_step: {period / steps!r}, chain.B: "
               f"{{move: [0, 0, 0], sine: [0, 0, {radius}], cosine: [{radius}, 0, 0], period: {period}}}}}\n")
    rows = rows_of(capstan, history, -radius, elements, added)
    assert len(rows) == PERIODS * steps, len(rows)
    cycle = [max(float(row["chain.B.tension"]) for row in rows[k * steps:(k + 1) * steps]) for k in range(PERIODS - LAST, PERIODS)]
    return sum(cycle) / LAST, sum(row["outcome"] != "solved" for row in rows)


def at_rest(capstan, radius):
    """The force with the end at rest at the point of the circle that is farthest from the anchor."""
    rows = rows_of(capstan, f"  - {{name: out, steps: 20, chain.B: {{move: [{radius}, 0, 0]}}}}\n", 0, 100, ADDED)
    return float(rows[-1]["chain.B.tension"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--capstan", default=os.path.join(ROOT, "build", "release", "cli", "capstan"))
    parser.add_argument("--only", type=float, choices=list(MEASURED))
    given = parser.parse_args()
    found = {"rest_N": [at_rest(given.capstan, radius) for radius in RADIUS], "computed_N": {}, "varied_N": {}, "uncertified": 0}
    print("| period | " + " | ".join(f"R = {radius} m" for radius in RADIUS) + " |")
    off, above = [], 0
    for period in [given.only] if given.only else MEASURED:
        cells = []
        found["computed_N"][str(period)] = []
        for radius, measured in zip(RADIUS, MEASURED[period]):
            force, uncertified = circle(given.capstan, period, radius)
            found["computed_N"][str(period)].append(force)
            found["uncertified"] += uncertified
            off.append(force / measured - 1)
            above += abs(off[-1]) > 0.05
            cells.append(f"{force:.1f}, {measured:.1f}: {round(100 * off[-1], 1) + 0.0:+.1f} %")
        print(f"| {period} s | " + " | ".join(cells) + " |", flush=True)
    print("| at rest | " + " | ".join(f"{force:.1f}" for force in found["rest_N"]) + " |")
    print(f"mean of the differences {100 * sum(off) / len(off):+.1f} %, of their sizes {100 * sum(map(abs, off)) / len(off):.1f} %; above 5 %: {above} of {len(off)}; "
          f"{found['uncertified']} steps not certified", flush=True)
    if not given.only:
        for name, more in {"50 elements": {"elements": 50}, "200 elements": {"elements": 200}, "100 steps": {"steps": 100}, "400 steps": {"steps": 400},
                           "800 steps": {"steps": 800}, "added mass on the circle": {"added": 3.8}}.items():
            found["varied_N"][name] = circle(given.capstan, 1.25, 0.2, **more)[0]
            print(f"T = 1.25 s, R = 0.2 m, {name}: {found['varied_N'][name]:.1f} N", flush=True)
        with open(os.path.join(ROOT, "bench", "results", "bergdahl.json"), "w", encoding="ascii") as file:
            json.dump(found, file, indent=1)
            file.write("\n")


main()
