#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of capsules, tori, cones and boxes for ParaView: every point that is written is on the surface, by its equation, also after a move,
and they reach round it.

usage: shape_surfaces.py CAPSTAN
"""
import math
import re
import subprocess
import sys

from checks import expect, read, run_in_an_empty_folder, write

SCENE = """\
capstan: 1
obstacles:
  rod: {capsule: {centre: [0, 0, -9], axis: [1, 2, 0.5], length: 3, radius: 1}}
  ring: {torus: {centre: [10, 0, -9], axis: [1, 2, 0.5], main_radius: 3, radius: 1}}
  tip: {cone: {tip: [20, 0, -9], axis: [0.3, 0.2, -1], angle: 30, radius: 1}}
  quay: {box: {centre: [30, 0, -9], size: [2, 3, 4], radius: 0.5, rotation: {quaternion: [1, 0.2, 0.3, -0.4]}}}
lines:
  one: {length: 3, elements: 4, mass: 2, stiffness: 1000, start: {straight: {from: [0, 0, 0], to: [3, 0, 0]}}, ends: {A: held, B: held}}
history:
  - {name: move, rod.obstacle: {move: [0, 0, -1]}, quay.obstacle: {move: [1, 2, -3], turn: 50, axis: [0, 0, 1], about: [30, 0, -9]}}
"""
AXIS, CONE = (1, 2, 0.5), (0.3, 0.2, -1)


def unit(a):
    size = math.sqrt(sum(x * x for x in a))
    return [x / size for x in a]


def parts(x, centre, axis):
    """How far x is from the axis, and along it."""
    arm, axis = [a - b for a, b in zip(x, centre)], unit(axis)
    along = sum(a * b for a, b in zip(arm, axis))
    return math.sqrt(max(0, sum(a * a for a in arm) - along * along)), along


def rotated(q, v):
    w, u = q[0], q[1:]
    t = [2 * (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]) for k in range(3)]
    return [v[k] + w * t[k] + u[(k + 1) % 3] * t[(k + 2) % 3] - u[(k + 2) % 3] * t[(k + 1) % 3] for k in range(3)]


def box_gap(x, centre, turn):
    """x is turned back, first by the move and then by the rotation of the box."""
    arm = [a - b for a, b in zip(x, centre)]
    back = [math.cos(turn / 2), 0, 0, -math.sin(turn / 2)]
    own = unit((1, 0.2, 0.3, -0.4))
    q = rotated([own[0]] + [-k for k in own[1:]], rotated(back, arm))
    return math.sqrt(sum(max(0, abs(a) - h / 2 + 0.5) ** 2 for a, h in zip(q, (2, 3, 4)))) - 0.5


def gaps(moved):
    """The distance of a point from each surface, before the move or after it."""
    turn = math.radians(50) * moved

    def rod(x):
        across, along = parts(x, (0, 0, -9 - moved), AXIS)
        return math.hypot(across, max(0, abs(along) - 1.5)) - 1

    def ring(x):
        across, along = parts(x, (10, 0, -9), AXIS)
        return math.hypot(across - 3, along) - 1

    def tip(x):
        across, along = parts(x, (20, 0, -9), CONE)
        s, c = math.sin(math.radians(30)), math.cos(math.radians(30))
        if across * s + (along - 1) * c < 0:
            return math.hypot(across, along - 1) - 1
        return across * c - (along - 1) * s - 1

    return [rod, ring, tip, lambda x: box_gap(x, (30 + moved, 2 * moved, -9 - 3 * moved), turn)]


def array(text, name):
    found = re.search(rf'Name="{name}"[^>]*>(.*?)</DataArray>', text, re.S)[1]
    return [float(x) for x in found.split()]


def check(file, moved):
    text = read(file).decode()
    points, cells, owner = array(text, "Points"), array(text, "connectivity"), array(text, "obstacle_id")
    points = [points[i:i + 3] for i in range(0, len(points), 3)]
    expect(f"{file}: corners", len(cells) == 4 * len(owner) and max(cells) < len(points), (len(cells), len(owner)))
    for k, gap in enumerate(gaps(moved)):
        mine = {int(cells[4 * c + i]) for c in range(len(owner)) if owner[c] == k for i in range(4)}
        worst = max((abs(gap(points[i])) for i in mine), default=math.inf)
        expect(f"{file}: obstacle {k} off its surface by", worst < 1e-9, worst)
        if k != 2:  # the middle of the points is the centre: they reach round it
            centre = ((0, 0, -9 - moved), (10, 0, -9), None, (30 + moved, 2 * moved, -9 - 3 * moved))[k]
            for a in range(3):
                low, high = min(points[i][a] for i in mine), max(points[i][a] for i in mine)
                expect(f"{file}: obstacle {k}, middle", abs((low + high) / 2 - centre[a]) < 1e-9, (low, high))


def main():
    write("scene.yaml", SCENE)
    found = subprocess.run([sys.argv[1], "run", "scene.yaml", "-o", "out"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    expect("exit status", found.returncode == 0, found.stderr)
    check("out/obstacles.vtp", 0)
    check("out/step-00000-obstacles.vtp", 1)
    for name in ("plan.svg", "elevation.svg"):
        expect(name, "nan" not in read(f"out/{name}").decode() and read(f"out/{name}").count(b"stroke-width=\"2.4\"") >= 4)


if __name__ == "__main__":
    run_in_an_empty_folder(main, "surfaces of shapes are where the shapes are")
