#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Oscillations of ends, points and bodies in time, by the command and the checker: forced motion of a body and a point beside its closed
form, the order of the scheme, places of what is held beside the formula, and where an entry begins that follows an oscillation.
                                                                                                          usage: oscillations.py CAPSTAN CHECKER"""
import csv
import math
import os
import sys
import tempfile

from runs import command, falsify, solve, write

TAU = 2*math.pi
# Places of what is held are the sum of a few products: rounding. Of free ones the backward difference formula is late by
# (w h)^2/3 of the phase w t, which is allowed of the largest response.
EXACT = 1e-12

BODY = """capstan: 1
bodies:
  buoy:
    free: [0, 0, 0]
    fixed: [x, y, rx, ry, rz]
    mass: 2000
    buoyancy: {buoyancy}
    hydrostatics: {{z: 15000}}
    added_mass: {{z: 900}}
points: {{eye: {{body: buoy, at: [0, 0, -1]}}}}
lines:
  wire: {{length: 40, mass: 1e-6, elements: 4, stiffness: 1, quasi_static: true, start: {{straight: {{from: [40, 0, -1], to: [0, 0, -1]}}}}, ends: {{A: held, B: {{point: eye}}}}}}
history:
  - {{name: waves, duration: 12, time_step: {h}, buoy.body: {{force: [0, 0, 0], oscillations: [{{sine: [0, 0, 900], period: 5}}, {{cosine: [0, 0, 400], period: 3}}]}}}}
"""


# 7/8 of 2 m with 2 kg/m at 1 m/s: 1.75 J; the halves of the outer elements are held
BEGINS = """capstan: 1
lines:
  rope: {{length: 2, elements: 8, mass: 2, stiffness: 1e5, velocity: [0, 1, 0], start: static, ends: {{A: {{held: [0, 0, 0]}}, B: {{held: [1.5, 0, 0]}}}}}}
history:
{entry}  - {{name: go, duration: 0.2, time_step: 0.02}}
"""

RESTS = """capstan: 1
water_density: 1025
current: [{z: 0, velocity: [0.3, 0.1, 0]}]
bodies:
  float: {free: [0, 0, 0], mass: 58300, centre_of_gravity: [0, 0, -1.5], buoyancy: 6.0e5, centre_of_buoyancy: [0, 0, -2.8], moments_of_inertia: [1.9e6, 1.9e6, 3.6e6],
          hydrostatics: {z: 71080, rx: 2.56e6, ry: 2.56e6}, damping: {x: 4e3, y: 4e3, z: 8000, rx: 2e5, ry: 2e5},
          members: [{from: [6, 6, -4], to: [-6, -5, -3], diameter: 1.5, normal: 1, added_normal: 1}]}
points: {bow: {body: float, at: [7, 0, -3.5]}, port: {body: float, at: [-6, 6, -3.5]}, starboard: {body: float, at: [-6, -6, -3.5]}}
lines:
  first: {length: 97, elements: 8, weight: 300, inertia: 35, stiffness: 6e7, start: static, ends: {A: {held: [95, 0, -30]}, B: {point: bow}}}
  second: {length: 97, elements: 8, weight: 300, inertia: 35, stiffness: 6e7, start: static, ends: {A: {held: [-47.5, 82.27, -30]}, B: {point: port}}}
  third: {length: 97, elements: 8, weight: 300, inertia: 35, stiffness: 6e7, start: static, ends: {A: {held: [-47.5, -82.27, -30]}, B: {point: starboard}}}
history: [{name: calm, duration: 5, time_step: 0.25}]
"""


def forced(t, mass, stiffness, terms):
    """From rest: the response of a mass on a spring to the sum of S sin(w t) and C (1 - cos(w t)), by superposition."""
    w0, z = math.sqrt(stiffness/mass), 0
    for sine, cosine, period in terms:
        w = TAU/period
        z += sine/mass*(math.sin(w*t) - w/w0*math.sin(w0*t))/(w0**2 - w**2)
        z += cosine/stiffness*(1 - math.cos(w0*t)) - cosine/mass*(math.cos(w*t) - math.cos(w0*t))/(w0**2 - w**2)
    return z


def allowed(size, mass, stiffness, h, t):
    w = math.sqrt(stiffness/mass)
    return size*w*t*(w*h)**2/3


def column(out, name, table="history.csv"):
    with open(os.path.join(out, table)) as file:
        rows = list(csv.DictReader(row for row in file if not row.startswith("#")))
    return [float(row[name]) for row in rows if row[name] not in ("", "m", "N", "s", "J")]


def column_of(out, name):
    """Of the one body."""
    with open(os.path.join(out, "bodies.csv"), encoding="ascii") as file:
        return [float(row[name]) for row in list(csv.DictReader(file))[1:]]


def heave(capstan, checker, folder):
    errors, size = [], 0
    for h in (0.08, 0.04, 0.02):
        _, _, found = solve(capstan, checker, folder, BODY.format(buoyancy=2000*9.81, h=h))
        steps, worst = round(12/h), 0
        for i in range(steps):
            exact = forced((i + 1)*h, 2900, 15000, [(900, 0, 5), (0, 400, 3)])
            worst = max(worst, abs(found.get("position_of_body", found.steps - steps + i)[2] - exact))
            size = max(size, abs(exact))
        errors.append(worst)
    order, bound = math.log2(errors[1]/errors[2]), allowed(size, 2900, 15000, 0.02, 12)
    print("oscillations: heave under two harmonics: errors %.2e %.2e %.2e m of %.2g m, order %.2f" % (*errors, size, order))
    assert abs(order - 2) < 0.1 and errors[2] < bound, (errors, bound)


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
  - name: roll
    duration: 2.5
    time_step: 0.05
    barge.body: {move: [0, 0, 1], oscillations: [{sine: [0.3, 0, 0.2], rotation_sine: [12, 0, 0], rotation_cosine: [0, 5, 0], period: 6}, {rotation_sine: [0, 0, -9], period: 1.7}]}
    knot.point: {move: [0, 0, 0], sine: [0, 0.2, 0], period: 4, oscillations: [{cosine: [0.1, 0, 0], period: 1.3}]}
    two.B: {position: [0, 4, 0], oscillations: [{sine: [0, 0, 0.3], period: 2}, {sine: [0, 0, 0.1], cosine: [0.05, 0, 0], period: 0.7}]}
  - {name: stay, duration: 1, time_step: 0.1, barge.body: {move: [0, 0, 0]}, knot.point: {move: [0, 0, 0]}, two.B: {move: [0, 0, 0]}}
"""


def matrix(v):
    """exp of the matrix of v x, by Rodrigues."""
    a = math.hypot(*v)
    k = [[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]]
    square = [[sum(k[i][m]*k[m][j] for m in range(3)) for j in range(3)] for i in range(3)]
    s, c = (math.sin(a)/a, (1 - math.cos(a))/a**2) if a > 0 else (1, 0.5)
    return [[(i == j) + s*k[i][j] + c*square[i][j] for j in range(3)] for i in range(3)]


def turned(m, v):
    return [sum(m[i][j]*v[j] for j in range(3)) for i in range(3)]


def places(t):
    """Where eye, knot and two.B are t seconds after the first entry began."""
    deg = math.pi/180
    turn = [12*deg*math.sin(TAU*t/6), 5*deg*(1 - math.cos(TAU*t/6)), -9*deg*math.sin(TAU*t/1.7)]
    arm = turned(matrix(turn), turned(matrix([0, 0, 30*deg]), [2, 1, -1]))
    at = [10 + 0.3*math.sin(TAU*t/6), -3, 5 + t/2.5 + 0.2*math.sin(TAU*t/6)]
    end = [0.05*(1 - math.cos(TAU*t/0.7)), 4, 0.3*math.sin(TAU*t/2) + 0.1*math.sin(TAU*t/0.7)]
    return [a + b for a, b in zip(at, arm)], [0.1*(1 - math.cos(TAU*t/1.3)), 0.2*math.sin(TAU*t/4), 0], end


def held(capstan, checker, folder):
    scene, out, found = solve(capstan, checker, folder, HELD)
    first = found.steps - 60
    worst, along = 0, list(zip(*(column(out, "two.B." + axis) for axis in "xyz")))
    for step in range(first, found.steps):
        t = min(2.5, 0.05*(step - first + 1))  # in the entry "stay" they are where the first one has left them
        eye, knot, end = places(t)
        position = found.get("position_of_point", step)
        for place, wanted in ((position[0:3], eye), (position[3:6], knot), (along[step], end)):
            worst = max(worst, *(abs(a - b) for a, b in zip(place, wanted)))
    print("oscillations: places of what is held: %.1e m" % worst)
    assert worst < EXACT, worst
    falsify(found, folder, "position_of_body", first + 20, 2, 1e-6)
    code, said = command(checker, os.path.join(folder, "copy.nc"), scene)
    assert code != 0, said


def knot(capstan, checker, folder):
    """A mass on a taut spring, which begins at rest under its force, when that begins to oscillate."""
    mass, k, force, errors = 5, 200, 30, []
    for steps in (400, 800):
        _, _, found = solve(capstan, checker, folder, f"""capstan: 1
gravity: [0, 0, 0]
points: {{top: {{held: [0, 0, 0]}}, knot: {{free: [0, 0, -10.5], inertia: {mass}, force: [0, 0, {-k*0.5}]}}}}
lines:
  rod: {{length: 10, mass: 1, elements: 1, stiffness: {k*10}, quasi_static: true, start: {{straight: {{from: [0, 0, 0], to: [0, 0, -10.5]}}}}, ends: {{A: {{point: top}}, B: {{point: knot}}}}}}
history:
  - {{name: push, duration: 4, steps: {steps}, knot.point: {{force: [0, 0, {-k*0.5}], sine: [0, 0, {force}], period: 2.2}}}}
""")
        first = found.steps - steps
        exact = [forced((i + 1)*4/steps, mass, k, [(force, 0, 2.2)]) for i in range(steps)]
        errors.append(max(abs(found.get("position_of_point", first + i)[5] + 10.5 - z) for i, z in enumerate(exact)))
    order, bound = math.log2(errors[0]/errors[1]), allowed(max(map(abs, exact)), mass, k, 4/800, 4)
    print("oscillations: a mass on a spring under an oscillating force: errors %.1e %.1e m, order %.2f" % (*errors, order))
    assert abs(order - 2) < 0.1 and errors[1] < bound, (errors, bound)


BAD = [
    ("nothing oscillates", "{sine: [0, 0, 0.3], period: 2}", "{period: 2}", "'period': nothing oscillates, expected 'sine' or 'cosine' beside it"),
    ("no period", "{sine: [0, 0, 0.3], period: 2}", "{sine: [0, 0, 0.3]}", "oscillation: 'period' is missing"),
    ("a period of nothing", "period: 1.7", "period: 0", "'period': found '0', expected a number in s, greater than 0"),
    ("a moment of what is held", "rotation_sine: [0, 0, -9]", "moment_sine: [0, 0, -9]", "'moment_sine': the body is held in this entry, expected 'rotation_sine' or 'rotation_cosine'"),
    ("a rotation of what is loaded", "move: [0, 0, 1], ", "force: [0, 0, 1], ", "'rotation_sine': the body is loaded in this entry, expected 'moment_sine' or 'moment_cosine'"),
    ("rotation and moment", "rotation_sine: [0, 0, -9]", "rotation_sine: [0, 0, -9], moment_sine: [0, 0, 1]", "'moment_sine'"),
    ("a rotation of a point", "{cosine: [0.1, 0, 0], period: 1.3}", "{rotation_sine: [1, 0, 0], period: 1.3}", "unknown key 'rotation_sine'"),
    ("no list", "oscillations: [{cosine: [0.1, 0, 0], period: 1.3}]", "oscillations: {cosine: [0.1, 0, 0], period: 1.3}", "'oscillations': found a mapping, expected a list"),
    ("an endless one", "[0.05, 0, 0]", "[.inf, 0, 0]", "'cosine': found '.inf', expected a number"),
    ("two components", "sine: [0, 0, 0.1]", "sine: [0, 0.1]", "'sine': found a list of 2, expected three numbers"),
    ("without a duration", "    duration: 2.5\n    time_step: 0.05\n", "", "oscillates in time, but the stage has no duration"),
    ("of an end let go", "position: [0, 4, 0], oscillations", "release: true, oscillations", "'oscillations': found beside 'release': what is let go does not oscillate"),
]


def bad(capstan, folder):
    for name, before, after, words in BAD:
        assert HELD.count(before) == 1, name
        scene = write(folder, "bad.yaml", HELD.replace(before, after))
        code, said = command(capstan, "check", scene)
        assert code == 3 and words in said, (name, code, said)
    print("oscillations: %d bad files refused" % len(BAD))


def counted(capstan, checker, folder):
    """What `scheme` has of a load that changes in time: half a step times the integral of its rate times the velocity, and `ends` as much more
    than the work along the way. What is left beside falls faster."""
    off, works = [], []
    for h in (0.04, 0.02, 0.01):
        _, out, _ = solve(capstan, checker, folder, BODY.format(buoyancy=2000*9.81, h=h))
        rate = [900*TAU/5*math.cos(TAU*(i + 1)*h/5) + 400*TAU/3*math.sin(TAU*(i + 1)*h/3) for i in range(round(12/h))]
        more = h/2*sum(f*v*h for f, v in zip(rate, column_of(out, "velocity_z")))
        off.append(sum(column(out, "scheme"))/more - 1)
        works.append(sum(column(out, "ends")) - more)
    print("oscillations: scheme beside (h/2) integral of f'.v: off by %.3f, %.3f, %.3f of it" % tuple(off))
    print("oscillations: work less that: %.3f, %.3f, %.3f J" % tuple(works))
    assert abs(off[0]) > 1.8*abs(off[1]) > 3.2*abs(off[2]) and abs(off[2]) < 0.03, off
    assert abs(works[0] - works[1]) > 3*abs(works[1] - works[2]), works


def begins(capstan, checker, folder):
    """A line that starts static has the velocity given as the history begins; a quasi-static entry takes its energy."""
    for entry, kinetic in (("", [0.4375*4]), ("  - {name: hold}\n", [0.4375*4, 0])):
        _, out, _ = solve(capstan, checker, folder, BEGINS.format(entry=entry))
        found, settling = column(out, "kinetic"), column(out, "settling")
        assert all(abs(a - b) <= 1e-12 for a, b in zip(found, kinetic)), found
        assert abs(settling[1] - (kinetic[0] if entry else 0)) <= 1e-12, settling


def rests(capstan, checker, folder):
    """What floats at rest in time moves by rounding alone, and what its damping takes is as small: the checker knows what it cannot know."""
    _, out, _ = solve(capstan, checker, folder, RESTS)
    kinetic = column(out, "kinetic")
    assert max(kinetic) < 1e-9, kinetic


def main():
    capstan, checker = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        heave(capstan, checker, folder)
        held(capstan, checker, folder)
        knot(capstan, checker, folder)
        counted(capstan, checker, folder)
        begins(capstan, checker, folder)
        rests(capstan, checker, folder)
        bad(capstan, folder)


main()
