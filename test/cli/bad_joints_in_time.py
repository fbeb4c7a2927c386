#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Points and bodies with inertia in scene files: good ones, and bad ones, each of which is refused with its place (file:line:column) and its
message, in one line.                                                                             usage: bad_joints_in_time.py CAPSTAN

Every bad one is one change to the good scene.
"""
import sys

from checks import is_told
from one_change import one_change_each

GOOD = """\
capstan: 1
gravity: [0, 0, -10]
obstacles: {bed: {plane: {point: [0, 0, -50]}, friction: 0.5}, drum: {cylinder: {point: [0, 0, 90], radius: 1}}}
bodies:
  buoy:
    free: [0, 0, 0]
    mass: 500
    centre_of_gravity: [0, 0, -1]
    moments_of_inertia: [100, 100, 50]
    products_of_inertia: [1, 0, 0]
    added_mass: {x: 200, z: 100}
    damping: {x: 5}
    quadratic_damping: {z: 3}
    velocity: [1, 0, 0]
    turn_rate: [0, 0, 1]
points:
  anchor: {held: [0, 0, -50]}
  knot: {free: [0, 0, -20], mass: 30, inertia: 40, velocity: [0, 1, 0]}
  eye: {body: buoy, at: [0, 0, -2]}
lines:
  leg: {length: 30, elements: 4, mass: 1, stiffness: 1e6, start: {straight: {from: [0, 0, -50], to: [0, 0, -20]}}, ends: {A: {point: anchor}, B: {point: knot}}, bearing_width: 0.1}
  top: {length: 18, elements: 4, weight: 1, quasi_static: true, stiffness: 1e6, start: {straight: {from: [0, 0, -20], to: [0, 0, -2]}}, ends: {A: {point: knot}, B: {point: eye}}, bearing_width: 0.1}
history:
  - {name: drift, duration: 2, time_step: 0.1}
"""
MOMENTS, PRODUCTS = "[100, 100, 50]", "products_of_inertia: [1, 0, 0]"
ADDED, DAMPING, QUADRATIC = "{x: 200, z: 100}", "{x: 5}", "{z: 3}"


def matrix(**entries):
    rows = [[0] * 6 for _ in range(6)]
    for name, value in entries.items():
        rows[int(name[1])][int(name[2])] = value
    return "[" + ", ".join(str(row) for row in rows) + "]"


ACCEPTED = [
    ([], "history: 1 entry, 20 load steps in all, 2 s in time"),
    ([(ADDED, matrix(e00=200, e22=100, e04=5, e40=5, e44=50))], "history: 1 entry"),
    ([(DAMPING, matrix(e00=5, e01=3, e10=-3))], "history: 1 entry"),
    ([("mass: 500", "weight: 5000")], "history: 1 entry"),
    ([("points:\n  anchor: {held: [0, 0, -50]}\n  knot: {free: [0, 0, -20], mass: 30,", "water_density: 1000\nwater_surface: 0\npoints:\n  anchor: {held: [0, 0, -50]}\n  knot: {free: [0, 0, -20], mass: 30, volume: 0.02, height: 1,")], "history: 1 entry"),
    ([("friction: 0.5}, drum", "friction: 0.5, stiffness: 1e4, damping: 100}, drum")], "history: 1 entry"),
    ([("duration: 2, time_step: 0.1", "steps: 2")], "history: 1 entry, 2 load steps in all\n"),
    ([("time_step: 0.1", "time_step: 0.1, drum.turn: 10, bed.obstacle: {move: [1, 0, 0]}")], "history: 1 entry, 20 load steps in all, 2 s in time"),
    ([("    free: [0, 0, 0]\n", "    held: [0, 0, 0]\n"), ("    velocity: [1, 0, 0]\n    turn_rate: [0, 0, 1]\n", ""), ("    mass: 500\n", "    mass: 0\n")], "history: 1 entry"),
    ([("    free: [0, 0, 0]\n", "    free: [0, 0, 0]\n    fixed: [rx, ry, rz]\n"), ("    turn_rate: [0, 0, 1]\n", ""), (MOMENTS, "[0, 0, 0]"), ("    " + PRODUCTS + "\n", "")], "history: 1 entry"),
]
# name, what is replaced in GOOD, by what, place and message
CHANGES = [
    ("negative moments", MOMENTS, "[-1, 100, 50]", "9:26: 'moments_of_inertia': found '-1', expected a number in kg m2, at least 0"),
    ("two moments", MOMENTS, "[100, 50]", "9:5: 'moments_of_inertia': found a list of 2, expected three numbers in kg m2"),
    ("NaN in the moments", MOMENTS, "[.nan, 1, 1]", "9:26: 'moments_of_inertia': found '.nan', expected a number in kg m2"),
    ("moments of no body", MOMENTS, "[100, 100, 500]", "9:5: body 'buoy': moments_of_inertia: no body has moments of inertia 100, 100 and 500 kg m2"),
    ("products of no body", PRODUCTS, "products_of_inertia: [200, 0, 0]", "9:5: body 'buoy': moments_of_inertia: no body has moments of inertia"),
    ("products alone", "    moments_of_inertia: [100, 100, 50]\n", "", "9:5: 'products_of_inertia': it goes with 'moments_of_inertia', which is not given"),
    ("negative added mass", ADDED, "{x: -1}", "11:18: 'x': found '-1', expected a number in kg, at least 0"),
    ("added mass with a coupling", ADDED, matrix(e00=1, e01=1), "11:5: body 'buoy': added_mass is not a symmetric matrix"),
    ("added mass without energy", ADDED, matrix(e00=1, e01=2, e10=2, e11=1), "11:5: body 'buoy': added_mass is not a symmetric matrix of finite numbers that has no negative energy"),
    ("coupling alone", ADDED, matrix(e04=2, e40=2), "11:5: body 'buoy': added_mass is not a symmetric matrix"),
    ("five rows", ADDED, "[[1, 0, 0, 0, 0, 0]]", "11:5: 'added_mass': found a list of 1, expected 6 rows of 6 numbers"),
    ("damping that drives", DAMPING, matrix(e00=-5), "12:5: body 'buoy': damping is not a matrix of finite numbers that takes energy"),
    ("negative quadratic damping", QUADRATIC, "{z: -3}", "13:25: 'z': found '-3', expected a number in N s2/m2, at least 0"),
    ("quadratic damping that drives", QUADRATIC, matrix(e00=1, e04=5, e44=1), "13:5: body 'buoy': quadratic_damping is not a matrix of finite numbers of which a bound shows that it takes energy, or none, in every motion"),
    ("quadratic coupling alone", QUADRATIC, matrix(e04=1), "13:5: body 'buoy': quadratic_damping is not a matrix"),
    ("four rows of quadratic damping", QUADRATIC, "[[1, 0, 0, 0, 0, 0]]", "13:5: 'quadratic_damping': found a list of 1, expected 6 rows of 6 numbers"),
    ("a word", QUADRATIC, "{zz: 3}", "13:25: 'quadratic_damping': unknown key 'zz'"),
    ("a velocity of what is held", "    free: [0, 0, 0]\n", "    held: [0, 0, 0]\n", "15:5: 'turn_rate': it goes with 'free', which is not given"),
    ("a velocity in a fixed direction", "    free: [0, 0, 0]\n", "    free: [0, 0, 0]\n    fixed: [x]\n", "15:5: body 'buoy': velocity: only a free body begins with one, and in none of its fixed directions"),
    ("a rate about a fixed direction", "    free: [0, 0, 0]\n", "    free: [0, 0, 0]\n    fixed: [rz]\n", "16:5: body 'buoy': turn_rate: only a free body begins with one"),
    ("an endless rate", "turn_rate: [0, 0, 1]", "turn_rate: [0, 0, .inf]", "15:23: 'turn_rate': found '.inf', expected a number in rad/s"),
    ("a body without mass", "mass: 500", "mass: 0", "7:5: body 'buoy': mass: a step of the history has a duration, and in a direction in which the body may move it has no mass"),
    ("a body that turns without inertia", "    moments_of_inertia: [100, 100, 50]\n    products_of_inertia: [1, 0, 0]\n", "", "7:5: body 'buoy': mass: a step of the history has a duration, and in a direction in which the body may move it has no mass"),
    ("negative mass", "mass: 500", "mass: -500", "7:5: 'mass': found '-500', expected a number in kg, at least 0"),
    ("negative inertia of a point", "inertia: 40", "inertia: -40", "18:39: 'inertia': found '-40', expected a number in kg, at least 0"),
    ("a velocity of a held point", "knot: {free:", "knot: {held:", "18:52: 'velocity': it goes with 'free', which is not given"),
    ("two components", "velocity: [0, 1, 0]", "velocity: [0, 1]", "18:52: 'velocity': found a list of 2, expected three numbers in m/s"),
    ("a quasi-static number", "quasi_static: true", "quasi_static: 1", "22:45: 'quasi_static': found '1', expected true or false"),
    ("neither mass nor quasi-static", "quasi_static: true, ", "", "22:3: line 'top': inertia: a step of the history has a duration, but the line has no mass to move: give its mass, or let it be quasi_static"),
    ("an inextensible line", "mass: 1, stiffness: 1e6", "mass: 1, stiffness: .inf", "21:43: line 'leg': stiffness: a step of the history has a duration, and beside free points or bodies lines stretch: give its stiffness"),
    ("an obstacle that is no obstacle", "time_step: 0.1", "time_step: 0.1, reel.turn: 10", "24:48: 'reel.turn': there is no such obstacle under 'obstacles'"),
    ("a static start of what moves", "start: {straight: {from: [0, 0, -50], to: [0, 0, -20]}}", "start: static", "18:52: point 'knot': velocity: lines that start static are at rest after the first step"),
    ("an anchor that drags", "anchor: {held: [0, 0, -50]}", "anchor: {held: [0, 0, -50], holding_capacity: 10, drags: true}", "17:53: point 'anchor': drags: a step of the history has a duration, in which anchors do not drag"),
    ("a height of what displaces nothing", "points:\n  anchor: {held: [0, 0, -50]}\n  knot: {free: [0, 0, -20], mass: 30,", "water_density: 1000\nwater_surface: 0\npoints:\n  anchor: {held: [0, 0, -50]}\n  knot: {free: [0, 0, -20], mass: 30, volume: 0, height: 1,", "20:50: point 'knot': height: it is that of what floats, but the point displaces no water: give its volume, or leave the height out"),
    ("waves that act on nothing", "points:\n", "water_density: 1000\nwater_surface: 0\nwaves: {depth: .inf, components: [{amplitude: 1, period: 9, direction: 0}]}\npoints:\n", "18:1: waves: they act on lines with drag that are not quasi_static, on points with a volume and on bodies with excitation or members, and there is none: give one, or leave the waves out"),
]


def main():
    failed = one_change_each(sys.argv[1], GOOD, ACCEPTED, CHANGES)
    print(f"{len(CHANGES)} cases, {failed} failed")
    return 0 if is_told(len(CHANGES)) and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
