#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The first-order force of waves on bodies: heave beside its closed form, six coupled directions on lines beside the linear response, the checker
with the scene, and what is refused.                                                                    usage: excitation.py CAPSTAN CHECKER"""
import cmath
import csv
import math
import os
import re
import sys
import tempfile

from runs import command, falsify, solve, write

TAU, G = 2*math.pi, 9.81
# between 7 and 11 s exp(i lead) amplitude is linear in the frequency; phases of the waves are counted from the origin of the scene
HEAVE = """capstan: 1
gravity: [0, 0, -9.81]
water_density: 1025
water_surface: 4
waves: {{depth: 40, components: [{{amplitude: 0.4, period: 9, direction: 30, phase: 25}}, {{amplitude: 0.2, frequency: 0.2, direction: -150, phase: -80}}]}}
bodies:
  buoy:
    free: [{x}, 7, 4]
    fixed: [x, y, rx, ry, rz]
    mass: 2000
    buoyancy: 19620
    hydrostatics: {{z: 15000}}
    added_mass: {{z: 900}}
    excitation:
      - {{period: 7, direction: 30, amplitude: [0, 0, 9000, 0, 0, 0], phase: [0, 0, 10, 0, 0, 0]}}
      - {{period: 11, direction: 30, amplitude: [0, 0, 13000, 0, 0, 0], phase: [0, 0, 40, 0, 0, 0]}}
      - {{frequency: 0.2, direction: 210, amplitude: [0, 0, 5000, 0, 0, 0], phase: [0, 0, -60, 0, 0, 0]}}
points: {{eye: {{body: buoy, at: [0, 0, -1]}}}}
lines:
  wire: {{length: 40, mass: 1e-6, elements: 4, stiffness: 1, quasi_static: true, start: {{straight: {{from: [{far}, 7, 3], to: [{x}, 7, 3]}}}}, ends: {{A: held, B: {{point: eye}}}}}}
history:
  - {{name: rest, steps: 1}}
  - {{name: sea, duration: 15, time_step: {h}}}
"""


def number(period, depth):
    """k by bisection."""
    w, low, high = TAU/period, 0.0, 10.0
    for _ in range(200):
        middle = 0.5*(low + high)
        low, high = (middle, high) if G*middle*math.tanh(middle*depth) < w*w else (low, middle)
    return low


def heave_at(t, x, y):
    """From rest: the sum over the waves of forces Re F exp(-i w t), on a mass on a spring."""
    mass, stiffness = 2900, 15000
    w0, z = math.sqrt(stiffness/mass), 0
    share = (1/9 - 1/11)/(1/7 - 1/11)
    lead = [math.radians(a) for a in (10, 40, -60)]
    force = [0.4*(share*9000*cmath.exp(-1j*lead[0]) + (1 - share)*13000*cmath.exp(-1j*lead[1])), 0.2*5000*cmath.exp(-1j*lead[2])]
    for f, (period, way, phase) in zip(force, ((9, 30, 25), (5, -150, -80))):
        d, w = math.radians(way), TAU/period
        f *= cmath.exp(1j*(number(period, 40)*(x*math.cos(d) + y*math.sin(d)) + math.radians(phase)))
        a = f/(stiffness - mass*w*w)
        # Re a exp(-i w t), less the free motion that begins with it
        z += (a*cmath.exp(-1j*w*t)).real - a.real*math.cos(w0*t) - (-1j*w*a).real/w0*math.sin(w0*t)
    return z


def heave(capstan, checker, folder):
    for x in (3, 4000):
        errors, size, w0 = [], 0, math.sqrt(15000/2900)
        for h in (0.1, 0.05, 0.025):
            text = HEAVE.format(x=x, far=x + 40, h=h)
            scene, out, found = solve(capstan, checker, folder, text)
            steps, worst = round(15/h), 0
            for i in range(steps):
                exact = heave_at((i + 1)*h, x, 7)
                worst = max(worst, abs(found.get("position_of_body", found.steps - steps + i)[2] - 4 - exact))
                size = max(size, abs(exact))
            errors.append(worst)
        order = math.log2(errors[1]/errors[2])
        print("excitation: heave at x = %g m in two waves: off by %.2e %.2e %.2e m, order %.2f" % (x, *errors, order))
        # the free motion is late by (w h)^2/3 of its phase
        assert abs(order - 2) < 0.1 and errors[2] < size*w0*15*(w0*0.025)**2/3, errors
    at = text.index("    excitation:")
    code, said = command(capstan, "check", write(folder, "none.yaml", text[:at] + text[text.index("points:"):]))
    assert code == 3 and "waves: they act on lines with drag that are not quasi_static, on points with a volume and on bodies with excitation or members, and there is none: give one" in said, said
    for index in (2, 4):
        falsify(found, folder, "load_of_body", found.steps - 9, index, 1e-3)
        code, said = command(checker, os.path.join(folder, "copy.nc"), scene)
        assert code != 0, index
    # rows in another order, as of a table of frequencies that rise, are the same: the file of the run is that of this scene
    lines = text.splitlines(keepends=True)
    first = lines.index("    excitation:\n") + 1
    lines[first:first + 3] = reversed(lines[first:first + 3])
    assert lines != text.splitlines(keepends=True)
    for program, begin in ((capstan, ["check"]), (checker, [os.path.join(out, "result.nc")])):
        code, said = command(program, *begin, write(folder, "order.yaml", "".join(lines)))
        assert code == 0, said
    for old, new in (("amplitude: [0, 0, 9000", "amplitude: [0, 0, 9000.01"), ("phase: [0, 0, 40", "phase: [0, 0, 40.001"), ("period: 11,", "period: 11.001,"),
                     ("amplitude: 0.4", "amplitude: 0.40001"), ("phase: -80", "phase: -80.001"), ("depth: 40", "depth: 40.01"), ("free: [4000", "free: [4000.01")):
        assert text.count(old) == 1, old
        code, said = command(checker, os.path.join(out, "result.nc"), write(folder, "other.yaml", text.replace(old, new)))
        assert code != 0, new


MOORED = """capstan: 1
gravity: [0, 0, -9.81]
water_density: 1025
water_surface: 0
waves: {depth: 60, ramp: 30, components: [{amplitude: 0.02, period: 8, direction: 0}]}
bodies:
  hull:
    free: [0, 0, 0]
    mass: 3.0e5
    buoyancy: %r
    centre_of_gravity: [0, 0, -3]
    centre_of_buoyancy: [0, 0, -2]
    moments_of_inertia: [6e6, 7e6, 5e6]
    hydrostatics: {z: 9e5, rx: 8e6, ry: 9e6}
    added_mass: [[1.5e5, 0, 0, 0, -4e5, 0], [0, 1.5e5, 0, 4e5, 0, 0], [0, 0, 2e5, 0, 0, 0], [0, 4e5, 0, 3e6, 0, 0], [-4e5, 0, 0, 0, 3e6, 0], [0, 0, 0, 0, 0, 1e5]]
    damping: {x: 6e4, y: 6e4, z: 2e5, rx: 2e6, ry: 2e6, rz: 1e6}
    excitation: [{period: 8, direction: 0, amplitude: [2.4e5, 0, 6e5, 0, 9e5, 0], phase: [-90, 0, 0, 0, 80, 0]}]
points:
  bow: {body: hull, at: [4, 0, -2]}
  port: {body: hull, at: [-2, 3.5, -2]}
  star: {body: hull, at: [-2, -3.5, -2]}
lines:
  one: {length: 87, elements: 8, mass: 30, stiffness: 5e6, quasi_static: true, start: static, ends: {A: {held: [70, 0, -60]}, B: {point: bow}}}
  two: {length: 87, elements: 8, mass: 30, stiffness: 5e6, quasi_static: true, start: static, ends: {A: {held: [-36, 60, -60]}, B: {point: port}}}
  three: {length: 87, elements: 8, mass: 30, stiffness: 5e6, quasi_static: true, start: static, ends: {A: {held: [-36, -60, -60]}, B: {point: star}}}
history:
  - {name: sea, duration: %r, time_step: 0.1}
"""


def solve_complex(matrix, right):
    n = len(right)
    rows = [row[:] + [b] for row, b in zip(matrix, right)]
    for i in range(n):
        best = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[best] = rows[best], rows[i]
        for r in range(n):
            if r != i:
                by = rows[r][i]/rows[i][i]
                rows[r] = [x - by*y for x, y in zip(rows[r], rows[i])]
    return [rows[i][n]/rows[i][i] for i in range(n)]


def table(out, name):
    with open(os.path.join(out, name)) as file:
        return list(csv.DictReader(row for row in file if not row.startswith("#")))


def harmonic(values, times, w):
    """a of the mean of 2 x exp(i w t) over whole periods: x = Re a exp(-i w t)."""
    return 2*sum(x*cmath.exp(1j*w*t) for x, t in zip(values, times))/len(values)


def moored(capstan, checker, folder):
    """The response of a small wave, beside that of the mass, damping and stiffness at rest, of lines too."""
    steps, h, w, lift = 1600, 0.1, TAU/8, 3.0e5*G + 2e5
    code, said = command(capstan, "run", write(folder, "rest.yaml", MOORED % (lift, 0.1)), "-q", "--stiffness", "-o", os.path.join(folder, "rest"))
    assert code == 0, said
    rest = next(row for row in table(os.path.join(folder, "rest"), "body-stiffness.csv") if row["step"] == "0" and row["kind"] == "stick")
    directions = ("x", "y", "z", "rx", "ry", "rz")
    K = [[float(rest[f"{i}_{j}"]) for j in directions] for i in directions]
    assert K[0][0] > 3e4
    _, out, found = solve(capstan, checker, folder, MOORED % (lift, 160))
    A = [[1.5e5, 0, 0, 0, -4e5, 0], [0, 1.5e5, 0, 4e5, 0, 0], [0, 0, 2e5, 0, 0, 0], [0, 4e5, 0, 3e6, 0, 0], [-4e5, 0, 0, 0, 3e6, 0],
         [0, 0, 0, 0, 0, 1e5]]
    m, c = 3.0e5, -3
    M = [[m if i == j and i < 3 else 0 for j in range(6)] for i in range(6)]
    for i, j, by in ((0, 4, m*c), (4, 0, m*c), (1, 3, -m*c), (3, 1, -m*c)):
        M[i][j] += by
    for i, j in ((3, 6e6 + m*c*c), (4, 7e6 + m*c*c), (5, 5e6)):
        M[i][i] += j
    D = [6e4, 6e4, 2e5, 2e6, 2e6, 1e6]
    lead = [math.radians(a) for a in (-90, 0, 0, 0, 80, 0)]
    F = [0.02*a*cmath.exp(-1j*b) for a, b in zip((2.4e5, 0, 6e5, 0, 9e5, 0), lead)]
    # x = Re a exp(-i w t)
    a = solve_complex([[K[i][j] - w*w*(M[i][j] + A[i][j]) - 1j*w*(D[i] if i == j else 0) for j in range(6)] for i in range(6)], F)
    last = 320  # four periods
    times = [(steps - last + k + 1)*h for k in range(last)]
    states = [found.get("position_of_body", found.steps - last + k) for k in range(last)]
    turns = [found.get("rotation_of_body", found.steps - last + k) for k in range(last)]
    for name, values, wanted in (("surge", [s[0] for s in states], a[0]), ("heave", [s[2] for s in states], a[2]),
                                 ("pitch", [2*q[2]*q[0] for q in turns], a[4])):
        is_ = harmonic(values, times, w)
        off = abs(is_ - wanted)/abs(wanted)
        print("excitation: %s of a moored hull: %.6g, linear %.6g, off by %.2g" % (name, abs(is_), abs(wanted), off))
        assert off < 0.01, name


def spar(capstan, checker, folder):
    """The OC3 spar of the examples in a small wave, on lines without inertia, beside the linear response of the hull on their stiffness."""
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/oc3-hywind-waves.yaml")) as file:
        text = file.read()
    for old, new in (("amplitude: 3,", "amplitude: 0.03,"), ("friction: 0.5 ", "friction: 0 "), ("duration: 600, time_step: 0.5", "duration: %r, time_step: 0.125")):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    text = re.sub(r"    inertia: .*\n", "    quasi_static: true\n", re.sub(r"    drag: .*\n", "", text))
    h, w = 0.125, TAU/10
    code, said = command(capstan, "run", write(folder, "rest.yaml", text.replace("%r", "0.125")), "-q", "--stiffness", "-o", os.path.join(folder, "spar"))
    assert code == 0, said
    rest = next(row for row in table(os.path.join(folder, "spar"), "body-stiffness.csv") if row["step"] == "0" and row["kind"] == "stick")
    _, _, found = solve(capstan, checker, folder, text.replace("%r", "300"))
    # surge, heave and pitch: the others stay, for the wave goes along x
    names, m, c = ("x", "z", "ry"), 8066048, -78
    K = [[float(rest[f"{i}_{j}"]) for j in names] for i in names]
    M = [[m + 7.99e6, 0, m*c - 4.95e8], [0, m + 2.4e5, 0], [m*c - 4.95e8, 0, 2.0e10 + m*c*c + 3.8e10]]
    F = [0.03*a*cmath.exp(-1j*math.radians(b)) for a, b in ((1.163e6, 90), (2.568e5, 180), (3.172e7, -90))]
    D = [1e5, 1.3e5, 0]
    a = solve_complex([[K[i][j] - w*w*M[i][j] - 1j*w*(D[i] if i == j else 0) for j in range(3)] for i in range(3)], F)
    last = 1600  # twenty periods, with a window that takes the slow free motions out
    times = [300 - (last - 1 - k)*h for k in range(last)]
    window = [1 - math.cos(TAU*(k + 0.5)/last) for k in range(last)]
    states = [found.get("position_of_body", found.steps - last + k) for k in range(last)]
    turns = [found.get("rotation_of_body", found.steps - last + k) for k in range(last)]
    for name, values, wanted in (("surge", [s[0] for s in states], a[0]), ("heave", [s[2] for s in states], a[1]),
                                 ("pitch", [2*q[2]*q[0] for q in turns], a[2])):
        got = harmonic([x*by for x, by in zip(values, window)], times, w)
        off = abs(got - wanted)/abs(wanted)
        print("excitation: %s of the OC3 spar: %.6g, linear %.6g, off by %.2g" % (name, abs(got), abs(wanted), off))
        assert off < 0.01, name


def main():
    capstan, checker = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        heave(capstan, checker, folder)
        moored(capstan, checker, folder)
        spar(capstan, checker, folder)


if __name__ == "__main__":
    main()
