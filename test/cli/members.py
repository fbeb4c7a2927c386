#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Morison's loads on members of bodies: a cylinder held in a wave beside the integral of the formula over its depth, falls to the terminal velocity,
decay beside quadratic damping, a body in a current, views of the same scene, random scenes, and the checker with what is falsified.

usage: members.py CAPSTAN CHECKER [SCENES [SEED]]
"""
import csv
import math
import os
import random
import sys
import tempfile

from runs import command, falsify, solve, write

TAU, G, RHO = 2*math.pi, 9.81, 1025.0


def number(period, depth):
    """k by bisection."""
    w, low, high = TAU/period, 0.0, 50.0
    for _ in range(200):
        middle = 0.5*(low + high)
        low, high = (middle, high) if G*middle*math.tanh(middle*depth) < w*w else (low, middle)
    return low


def history(out):
    """The rows of steps, without that of the units."""
    with open(os.path.join(out, "history.csv")) as file:
        return list(csv.DictReader(row for row in file if not row.startswith("#")))[1:]


def load_of(found, step, body=0):
    return found.get("load_of_body", step)[3*body:3*body + 3], found.get("load_moment_of_body", step)[3*body:3*body + 3]


# ---- a vertical cylinder in a wave ----

DEPTH, LIFT, PERIOD, DIAMETER, CD, CA, SURFACE = 30.0, 1.5, 7.0, 3.0, 1.1, 0.9, 2.0
HELD = """capstan: 1
water_density: 1025
water_surface: 2
waves: {{depth: 30, components: [{{amplitude: 1.5, period: 7, direction: {way!r}, phase: 20}}]}}
bodies:
  pile:
    held: [{x!r}, {y!r}, 2]
    rotation: {{roll_pitch_yaw: [0, 0, {way!r}]}}
    members: [{{from: [0, 0, {low}], to: [0, 0, {high}], diameter: 3, normal: 1.1, tangential: 0.2, added_normal: 0.9, strips: {strips}}}]
points: {{eye: {{body: pile, at: [0, 0, 5]}}}}
lines:
  wire: {{length: 30, elements: 4, mass: 1e-3, stiffness: 1e3, quasi_static: true, start: {{straight: {{from: [{x!r}, {y!r}, 37], to: [{x!r}, {y!r}, 7]}}}}, ends: {{A: held, B: {{point: eye}}}}}}
history:
  - {{name: sea, duration: 7, steps: 14}}
"""


def pile_load(t, x):
    """Force along the wave, and its moment about the surface at rest: closed forms of the integrals over cosh, cosh^2 and their products with z."""
    w, k = TAU/PERIOD, number(PERIOD, DEPTH)
    p = k*x - w*t + math.radians(20)
    top = LIFT*math.cos(p)
    s = min(top, 0) + DEPTH  # of the bottom, what moves with z
    above = max(top, 0)
    sinh, cosh = math.sinh(k*DEPTH), math.cosh(k*DEPTH)
    # integrals of f and of (height above the bottom) f, f = cosh, cosh^2
    one = (math.sinh(k*s)/k, s*math.sinh(k*s)/k - (math.cosh(k*s) - 1)/k**2)
    two = (s/2 + math.sinh(2*k*s)/(4*k), s*s/4 + s*math.sinh(2*k*s)/(4*k) - (math.cosh(2*k*s) - 1)/(8*k*k))
    # above the surface at rest the motion is that there
    one = (one[0] + above*cosh, one[1] + (DEPTH*above + above**2/2)*cosh)
    two = (two[0] + above*cosh**2, two[1] + (DEPTH*above + above**2/2)*cosh**2)
    speed = LIFT*w*math.cos(p)/sinh
    inertia = RHO*math.pi/4*DIAMETER**2*(1 + CA)*LIFT*w*w*math.sin(p)/sinh
    drag = 0.5*RHO*DIAMETER*CD*abs(speed)*speed
    force = inertia*one[0] + drag*two[0]
    return force, inertia*one[1] + drag*two[1] - DEPTH*force


def pile(capstan, checker, folder):
    worst, kept = [], {}
    for way, x, y in ((0.0, 11.0, 0.0), (-125.0, 20011.0, -7000.0)):
        d = math.radians(way)
        for strips in (10, 20, 40):
            text = HELD.format(way=way, x=x, y=y, low=-30, high=6, strips=strips)
            scene, out, found = solve(capstan, checker, folder, text)
            off = size = turn = 0
            for step in range(14):
                force, moment = load_of(found, step)
                along, about = pile_load((step + 1)*0.5, x*math.cos(d) + y*math.sin(d))
                off = max(off, abs(force[0]*math.cos(d) + force[1]*math.sin(d) - along))
                size = max(size, abs(along))
                turn = max(turn, abs(moment[1]*math.cos(d) - moment[0]*math.sin(d) - about)/DEPTH)
                kept[way, strips, step] = force
                assert abs(force[1]*math.cos(d) - force[0]*math.sin(d)) < 1e-9*size
            worst.append((off/size, turn/size))
            if strips == 20:
                _, _, back = solve(capstan, checker, folder, HELD.format(way=way, x=x, y=y, low=6, high=-30, strips=strips))
                for step in range(14):
                    other = load_of(back, step)[0]
                    assert math.dist(other, kept[way, 20, step]) < 1e-11*size, (other, kept[way, 20, step])
        rows = worst[-3:]
        print("members: pile in a wave from %g degrees: off by %.2e %.2e %.2e of the force, %.2e %.2e %.2e of the moment with 10, 20 and 40 strips"
              % (way, *[r[0] for r in rows], *[r[1] for r in rows]))
        # of second order in the strips; the one that ends at the surface at rest, where the motion has a corner, moves with them
        assert rows[2][0] < rows[0][0]/8 and rows[2][0] < 2e-3 and rows[2][1] < 2e-3 and rows[1][0] < 5e-3, rows
    for variable, place, change in (("load_of_body", 0, 1.0), ("load_of_body", 2, 1.0), ("load_moment_of_body", 1, 10.0)):
        falsify(found, folder, variable, 9, place, change)
        code, said = command(checker, os.path.join(folder, "copy.nc"), scene)
        assert code != 0, variable
    for old, new in (("diameter: 3,", "diameter: 3.0001,"), ("normal: 1.1", "normal: 1.1001"), ("added_normal: 0.9", "added_normal: 0.90001"),
                     ("to: [0, 0, 6]", "to: [0, 0.001, 6]"), ("from: [0, 0, -30]", "from: [0, 0, -29.999]"), ("strips: 40", "strips: 41"),
                     ("amplitude: 1.5", "amplitude: 1.50001"), ("water_density: 1025", "water_density: 1025.01"), ("members: [", "no_members: [")):
        assert text.count(old) == 1, old
        bad = text.replace(old, new) if new != "no_members: [" else text.replace(text[text.index("    members:"):text.index("points:")], "")
        code, said = command(checker, os.path.join(out, "result.nc"), write(folder, "other.yaml", bad))
        assert code != 0, new


# ---- without waves ----

FALL = """capstan: 1
water_density: 1025
bodies:
  log:
    free: [0, 0, 0]
    rotation: {{roll_pitch_yaw: [0, 0, {yaw!r}]}}
    fixed: [x, y, rx, ry, rz]
    mass: 900
    {more}
    velocity: [0, 0, {speed}]
points: {{eye: {{body: log, at: [0, 0, 0]}}}}
lines:
  wire: {{length: 60, elements: 4, mass: 1e-9, stiffness: 1e-3, quasi_static: true, start: {{straight: {{from: [60, 0, 0], to: [0, 0, 0]}}}}, ends: {{A: held, B: {{point: eye}}}}}}
history:
  - {{name: fall, duration: {duration}, steps: {steps}}}
"""
LOG = "members: [{from: [-2, 0, 0], to: [1, 0, 0], diameter: 0.5, normal: 1.2, tangential: 0.1, added_normal: 0.8}]"
PARTS = "members: [{from: [0.5, 0, 0], to: [1, 0, 0], diameter: 0.5, normal: 1.2, added_normal: 0.8, strips: 3}, " \
        "{to: [-2, 0, 0], from: [0.5, 0, 0], diameter: 0.5, normal: 1.2, added_normal: 0.8, strips: 1}]"
QUADRATIC, ADDED = 0.5*RHO*0.5*3*1.2, 0.8*RHO*math.pi/4*0.25*3


def heights(found):
    return [found.get("position_of_body", step)[2] for step in range(found.steps)]


def fall(capstan, checker, folder):
    """Under its weight from rest, z'(t) = -V tanh(t g'/V); without weight from a velocity, ln(1 + t/T); and quadratic damping in the place of members."""
    weight = 900*G
    top, mass = math.sqrt(weight/QUADRATIC), 900 + ADDED
    errors = []
    for steps in (160, 320, 640):
        text = FALL.format(yaw=25, more=LOG, speed=0, duration=8, steps=steps)
        _, out, found = solve(capstan, checker, folder, text)
        exact = -top**2*mass/weight*math.log(math.cosh(8*weight/mass/top))
        errors.append(abs(heights(found)[-1] - exact))
    order = math.log2(errors[1]/errors[2])
    speed = found.get("velocity_of_body", found.steps - 1)[2]
    print("members: a falling log: off by %.2e %.2e %.2e m, order %.2f; %.6f m/s of %.6f m/s at last" % (*errors, order, -speed, top))
    assert abs(order - 2) < 0.15 and errors[2] < 1e-3 and abs(speed/top + 1) < 1e-5, errors
    rows = history(out)
    # what the weight does is done on the water, or is kinetic energy, or lost by the scheme, but for the wire
    drag, scheme = (sum(float(row[name]) for row in rows) for name in ("drag", "scheme"))
    kinetic = float(rows[-1]["kinetic"])
    given = weight*-heights(found)[-1]
    assert abs(given - drag - kinetic - scheme) < 1e-7*given and abs(scheme) < 1e-3*given, (given, drag, kinetic, scheme)
    for variable in ("ledger_drag_of_body", "ledger_waves_of_body"):
        falsify(found, folder, variable, 50, 0, 1e-2)
        code, _ = command(checker, os.path.join(folder, "copy.nc"), os.path.join(folder, "scene.yaml"))
        assert code != 0, variable
    code, _ = command(checker, os.path.join(out, "result.nc"), write(folder, "other.yaml", text.replace("added_normal: 0.8", "added_normal: 0.801")))
    assert code != 0
    same = "quadratic_damping: {z: %r}\n    added_mass: {z: %r}" % (QUADRATIC, ADDED)
    sides = [LOG, PARTS, same]
    found = [solve(capstan, checker, folder, FALL.format(yaw=yaw, more=more + "\n    buoyancy: %r" % weight, speed=1.5, duration=3, steps=60))[2]
             for more, yaw in zip(sides, (70, -10, 0))]
    decay = [heights(f) for f in found]
    far = max(abs(a - b) for other in decay[1:] for a, b in zip(decay[0], other))
    long = mass/QUADRATIC/1.5
    exact = mass/QUADRATIC*math.log(1 + 3/long)
    print("members: decay: %.2e m from that of quadratic damping and of parts in another order; %.2e m from the closed form" % (far, abs(decay[0][-1] - exact)))
    assert far < 1e-11 and abs(decay[0][-1] - exact) < 2e-3, (far, decay[0][-1], exact)


CURRENT = """capstan: 1
water_density: 1025
water_surface: 0
current: [{{z: -20, velocity: {low}}}, {{z: 0, velocity: {high}}}, {{z: 5, velocity: [9, 9, 9]}}]
bodies:
  spar:
    free: {at}
    rotation: {{roll_pitch_yaw: [0, 0, {yaw!r}]}}
    fixed: [z, rx, ry, rz]
    mass: 5000
    moments_of_inertia: [1e4, 1e4, 1e3]
    members: {members}
points: {{eye: {{body: spar, at: [0, 0, 0]}}}}
lines:
  spring: {{length: 50, elements: 5, mass: 1e-9, stiffness: 1e6, start: {{straight: {{from: {far}, to: {at}}}}}, ends: {{A: held, B: {{point: eye}}}}}}
history:
  - {{name: rest, steps: 2}}
"""


def current(capstan, checker, folder):
    """A spar in a current whose velocity grows from 0.4 to 1.3 m/s over 20 m, of which it is in the upper 16 m, on a spring along it."""
    for yaw, x, y in ((0.0, 0.0, 0.0), (133.0, 3000.0, -900.0)):
        c, s = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))
        vector = lambda size, z: [size*c, size*s, z]  # noqa: E731
        errors = []
        for strips in (10, 20):
            # three quarters of the last strip lie above the surface
            members = "[{from: [0, 0, -16], to: [0, 0, 4], diameter: 2, normal: 0.7, added_normal: 1, strips: %d}]" % strips
            text = CURRENT.format(low=vector(0.4, 0), high=vector(1.3, 0), yaw=yaw, members=members, at=[x, y, 0], far=[x - 50*c, y - 50*s, 0])
            _, _, found = solve(capstan, checker, folder, text)
            force, _ = load_of(found, found.steps - 1)
            place = found.get("position_of_body", found.steps - 1)
            first, last = 0.4 + 0.045*4, 1.3
            exact = 0.5*RHO*2*0.7*(last**3 - first**3)/3/0.045
            errors.append(abs(math.hypot(force[0], force[1]) - exact)/exact)
            # the spring of 50 m began as long as it is
            way = math.dist(place, found.get("start_position_of_body"))
            assert abs(way - 50*math.hypot(force[0], force[1])/1e6) < 1e-8, way
        print("members: drag of a current: off by %.2e and %.2e with 10 and 20 strips" % tuple(errors))
        # the middle rule for the square of a velocity linear in z
        assert errors[1] < 1e-3 and abs(math.log2(errors[0]/errors[1]) - 2) < 0.2, errors


# ---- random scenes ----

def vector(rng, size):
    return [round(rng.uniform(-size, size), 3) for _ in range(3)]


def random_scene(rng):
    far = rng.choice([[0, 0, 0], [0, 0, 0], [4000, -2500, 300]])
    surface = far[2] + round(rng.uniform(-2, 2), 2)
    text = "capstan: 1\nwater_density: 1025\n"
    waves, in_time = rng.random() < 0.6, rng.random() < 0.8
    if waves or rng.random() < 0.7:
        text += "water_surface: %r\n" % surface
    if waves and in_time:
        text += "waves: {depth: %r, ramp: %r, components: [%s]}\n" % (
            rng.choice([25, 60, 200]), rng.choice([0, 1, 5]),
            ", ".join("{amplitude: %r, period: %r, direction: %r, phase: %r}" % (round(rng.uniform(0.1, 0.8), 2), round(rng.uniform(4, 12), 2),
                                                                                rng.uniform(-180, 180), rng.uniform(0, 360)) for _ in range(rng.randint(1, 3))))
    if rng.random() < 0.6 or not in_time:
        text += "current: [{z: %r, velocity: %r}, {z: %r, velocity: %r}]\n" % (far[2] - 20, vector(rng, 0.5), far[2] + 1, vector(rng, 1.2))
    members = []
    for _ in range(rng.randint(1, 4)):
        a, b = vector(rng, 4), vector(rng, 4)
        kind = rng.random()
        if kind < 0.2:
            b = [a[0], a[1], a[2] + 5]
        elif kind < 0.3:
            b = [a[0] + 3, a[1], a[2]]
        members.append("{from: %r, to: %r, diameter: %r, normal: %r, tangential: %r, added_normal: %r%s}" % (
            a, b, round(10**rng.uniform(-1.5, 0), 3), rng.choice([0, 0.7, 1.2]), rng.choice([0, 0.05]), rng.choice([0, 1.0, 0.6]),
            rng.choice(["", ", strips: 1", ", strips: 7"])))
    place = [far[0], far[1], far[2]]
    text += """bodies:
  hull:
    free: %r
    rotation: {roll_pitch_yaw: %r}
    mass: 8000
    moments_of_inertia: [2e4, 3e4, 2.5e4]
    buoyancy: %r
    centre_of_buoyancy: [0, 0, 0.5]
    hydrostatics: {z: 2e4, rx: 6e4, ry: 6e4, rz: 1e4}
    members: [%s]
""" % (place, vector(rng, 40), 8000*G, ", ".join(members))
    text += "points: {p: {body: hull, at: [2, 0, -1]}, q: {body: hull, at: [-1, 1.7, -1]}, r: {body: hull, at: [-1, -1.7, -1]}}\nlines:\n"
    own = in_time and rng.random() < 0.5
    for k, name in enumerate("pqr"):
        c, s = math.cos(TAU*k/3), math.sin(TAU*k/3)
        text += "  %s1: {length: 34, elements: 6, mass: 20, stiffness: 2e6, quasi_static: %s, start: static, ends: {A: {held: %r}, B: {point: %s}}}\n" % (
            name, "true" if in_time and not own else "false", [far[0] + 27*c, far[1] + 27*s, far[2] - 18], name)
    text += "history:\n"
    load = "hull.body: {force: %r, moment: %r}" % (vector(rng, 6000), vector(rng, 9000))
    steps = "steps: 40" if rng.random() < 0.7 else "time_step: 0.1, error: %r" % 10**rng.uniform(-4.5, -2.5)
    text += "  - {name: sea, duration: 2, %s, %s}\n" % (steps, load) if in_time else "  - {name: rest, steps: 2, %s}\n" % load
    return text, own, math.hypot(*far)


def random_scenes(capstan, checker, folder, count, seed):
    steps = certified = moving = 0
    worst = 0
    for index in range(count):
        rng = random.Random(1000*seed + index)
        text, own, far = random_scene(rng)
        try:
            _, out, found = solve(capstan, checker, folder, text, wanted=(0, 4, 5))
        except AssertionError:
            print("seed", seed, "scene", index)
            raise
        rows = history(out)
        steps += len(rows)
        certified += sum(row["outcome"] == "solved" for row in rows)
        moving += own
        for row in rows:
            if own and float(row["turnover"]) > 0:
                # quasi-static lines have ledgers of their own, of first order in h; weight and buoyancy do work on places that are rounded
                left = abs(float(row["imbalance"])) - 2*8000*G*2.2e-16*far
                worst = max(worst, left/float(row["turnover"]))
    print("members: %d random scenes, lines with inertia in %d: %d of %d steps certified, there a remainder %.1e of the turnover" % (count, moving, certified, steps, worst))
    assert certified == steps and worst < 1e-10


def main():
    capstan, checker = sys.argv[1:3]
    count, seed = [int(w) for w in sys.argv[3:]] + [24, 1][len(sys.argv) - 3:]
    with tempfile.TemporaryDirectory() as folder:
        pile(capstan, checker, folder)
        fall(capstan, checker, folder)
        current(capstan, checker, folder)
        random_scenes(capstan, checker, folder, count, seed)


if __name__ == "__main__":
    main()
