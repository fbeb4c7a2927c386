#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Time series of places and loads, and components of waves, from CSV files: places between the rows by the formula of the cubics, the order in
which a sampled sine is met, the checker with the scene, and files changed after the run.               usage: series.py CAPSTAN CHECKER"""
import csv
import math
import os
import sys
import tempfile

from runs import command, solve, write

TAU = 2*math.pi
HELD = """capstan: 1
bodies:
  barge: {held: [10, -3, 5], rotation: {roll_pitch_yaw: [0, 0, 30]}}
points:
  eye: {body: barge, at: [2, 1, -1]}
  knot: {held: [0, 0, 0]}
lines:
  one: {length: 14, mass: 2, elements: 8, stiffness: 1e5, start: static, ends: {A: {point: knot}, B: {point: eye}}}
  two: {length: 5, mass: 2, elements: 8, stiffness: 1e5, start: static, ends: {A: {point: knot}, B: {held: [0, 4, 0]}}}
history:
  - {name: sea, duration: 3, time_step: 0.05, barge.body: {move: [0, 0, 0], series: barge.csv}, knot.point: {move: [0, 0.3, 0], series: knot.csv}, two.B: {position: [0, 4, 1], series: two.csv, sine: [0.1, 0, 0], period: 2}}
  - {name: stay, duration: 1, time_step: 0.1, barge.body: {move: [0, 0, 0]}, knot.point: {move: [0, 0, 0]}, two.B: {move: [0, 0, 0]}}
"""
BUOY = """capstan: 1
bodies:
  buoy: {free: [0, 0, 0], fixed: [x, y, rx, ry, rz], mass: 2000, buoyancy: 19620, hydrostatics: {z: 15000}}
points: {eye: {body: buoy, at: [0, 0, -1]}}
lines:
  wire: {length: 40, mass: 1e-6, elements: 4, stiffness: 1, quasi_static: true, start: {straight: {from: [40, 0, -1], to: [0, 0, -1]}}, ends: {A: held, B: {point: eye}}}
history:
  - {name: sea, duration: 6, time_step: 0.02, buoy.body: {force: [0, 0, 0], %s}}
"""
IN_WAVES = """capstan: 1
water_density: 1025
water_surface: 2
waves: {depth: 20, %s}
lines:
  rope: {length: 11, elements: 12, mass: 12, stiffness: 1e5, start: static, drag: {diameter: 0.1, normal: 1.2, added_normal: 1}, ends: {A: {held: [0, 0, -8]}, B: {held: [5, 0, 0]}}}
history:
  - {name: sea, duration: 2, steps: 20}
"""
# rows at uneven times, of columns in any order, with units and without, comments and empty lines
TABLES = {
    "barge.csv": "# of a barge\nrx,time,x,z,rz\ndeg,s,m,m,deg\n0,0,0,0,0\n3,0.4,0.1,0.02,-1\n\n5,1,0.15,-0.1,2\n-2,2.2,-0.1,0.3,1\n1,3,0,0,0\n",
    "knot.csv": "time, y\n-1, 0.4\n0, 0\n1.5, -0.2\n1.6, -0.1\n9, 3\n",
    "two.csv": "time,x,y,z\n0,0,0,0\n3,0.3,-0.2,0.1\n"}


def rows_of(text):
    rows = [row for row in csv.reader(text.replace(" ", "").splitlines()) if row and not row[0].startswith("#")]
    return [dict(zip(rows[0], map(float, row))) for row in rows[1:] if row[0] not in ("deg", "s")]


def cubic(rows, name, t):
    """By its slopes at the rows."""
    x, y = [row["time"] for row in rows], [row.get(name, 0) for row in rows]
    k = max(i for i in range(len(x) - 1) if i == 0 or x[i] <= t)

    def slope(i):
        if len(x) == 2:
            return (y[1] - y[0])/(x[1] - x[0])
        m = min(max(i, 1), len(x) - 2)
        a, b, c = x[m - 1:m + 2]
        return sum(y[m - 1 + n]*(2*x[i] - p - q)/d for n, (p, q, d) in enumerate((
            (b, c, (a - b)*(a - c)), (a, c, (b - a)*(b - c)), (a, b, (c - a)*(c - b)))))
    h = x[k + 1] - x[k]
    s = min(1, (t - x[k])/h)
    return y[k]*(1 - s)**2*(1 + 2*s) + y[k + 1]*s*s*(3 - 2*s) + h*s*(1 - s)*((1 - s)*slope(k) - s*slope(k + 1))


def write_all(folder):
    for name, text in TABLES.items():
        write(folder, name, text)


def column(out, name):
    with open(os.path.join(out, "history.csv")) as file:
        rows = list(csv.DictReader(row for row in file if not row.startswith("#")))
    return [float(row[name]) for row in rows if row[name] not in ("", "m", "N", "s")]


def held(capstan, checker, folder):
    write_all(folder)
    scene, out, found = solve(capstan, checker, folder, HELD)
    tables = {name: rows_of(text) for name, text in TABLES.items()}
    along, worst = list(zip(*(column(out, "two.B." + axis) for axis in "xyz"))), 0
    for step in range(found.steps - 70, found.steps):
        t = min(3, 0.05*(step - found.steps + 71))
        barge = [10 + cubic(tables["barge.csv"], "x", t), -3, 5 + cubic(tables["barge.csv"], "z", t)]
        knot = [0, 0.1*t + cubic(tables["knot.csv"], "y", t), 0]
        end = [0.1*t + 0.1*math.sin(TAU*t/2), 4 - 0.2*t/3, t/3 + 0.1*t/3]
        for place, wanted in ((found.get("position_of_body", step)[0:3], barge), (found.get("position_of_point", step)[3:6], knot),
                              (along[step], end)):
            worst = max(worst, *(abs(a - b) for a, b in zip(place, wanted)))
    print("series: places of what is held: %.1e m" % worst)
    assert worst < 1e-12, worst
    for name, old, new in (("barge.csv", "5,1,0.15", "5,1,0.1501"), ("barge.csv", "-2,2.2", "-2.01,2.2"), ("knot.csv", "1.5, -0.2", "1.5, -0.2001"),
                           ("two.csv", "3,0.3", "3,0.3001"), ("two.csv", "time,x", "time,z")):
        text = TABLES[name].replace(old, new) if new != "time,z" else TABLES[name].replace("time,x,y,z", "time,z,y,x")
        write(folder, name, text)
        code, said = command(checker, os.path.join(out, "result.nc"), scene)
        assert code != 0, (name, new)
        write_all(folder)


def sampled(capstan, checker, folder):
    """A load that is a sine, by its formula and by rows: the error of the rows is of the third order in their distance."""
    _, _, exact = solve(capstan, checker, folder, BUOY % "oscillations: [{sine: [0, 0, 900], period: 3}]")
    errors = []
    for count in (30, 60, 120):
        text = "time,fz\ns,N\n" + "".join("%r,%r\n" % (6*i/count, 900*math.sin(TAU*6*i/count/3)) for i in range(count + 1))
        write(folder, "load.csv", text)
        _, _, found = solve(capstan, checker, folder, BUOY % "series: load.csv")
        errors.append(max(abs(found.get("position_of_body", k)[2] - exact.get("position_of_body", k)[2]) for k in range(found.steps)))
    order = math.log2(errors[1]/errors[2])
    print("series: heave under a sampled sine: off by %.2e %.2e %.2e m, order %.2f" % (*errors, order))
    assert order > 2.8, errors


def sea(capstan, checker, folder):
    """Waves of a file are those of the scene, bit by bit."""
    _, _, one = solve(capstan, checker, folder,
                      IN_WAVES % "components: [{amplitude: 0.5, period: 5, direction: 20, phase: 40}, {amplitude: 0.3, period: 4, direction: -100}]")
    for text in ("amplitude,period,direction,phase\n0.5,5,20,40\n0.3,4,-100,0\n",
                 "phase, direction, frequency, amplitude\ndegree, deg, Hz, m\n40,20,0.2,0.5\n0,-100,0.25,0.3\n"):
        write(folder, "sea.csv", text)
        _, _, other = solve(capstan, checker, folder, IN_WAVES % "file: sea.csv")
        for name in ("rope_position", "rope_ledger_waves"):
            assert all(one.get(name, k) == other.get(name, k) for k in range(one.steps)), name


def main():
    capstan, checker = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        held(capstan, checker, folder)
        sampled(capstan, checker, folder)
        sea(capstan, checker, folder)


if __name__ == "__main__":
    main()
