#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random histories on triangle meshes, each checked by the independent checker.

usage: random_meshes.py CAPSTAN CHECKER [--count N] [--seed S] [--keep FOLDER]

A scene has a line on one of four bodies: open ground of shaken triangles, a boulder with dents on a plane, a block with right angles on a
plane, or a sheet with two sides; in one of the forms of files, in other units, turned, far from the origin, with triangles too many, fine or
coarse beside the elements, sharp or well rounded. Friction has one coefficient, two, or a grain; an elastic or an inextensible line is laid
by statics and drawn about in 16 steps, or the body is moved and turned under it. Of each kind at least 99 of 100 steps must be certified,
and the checker must refute none.
"""
import argparse
import math
import os
import random
import re
import struct
import subprocess
import sys
import tempfile

STEPS = 16
CERTIFIED = {"block": 0.99, "boulder": 0.99, "ground": 0.99, "sheet": 0.99}
SECONDS = 300


def waves(dice, steepest):
    """A height function over the unit square about the origin."""
    parts = []
    for _ in range(dice.randint(1, 3)):
        steep, angle, phase = dice.uniform(0, steepest), dice.uniform(0, 2 * math.pi), dice.uniform(0, 2 * math.pi)
        k = 2 * math.pi / dice.uniform(0.4, 2)
        parts.append((steep / k, k * math.cos(angle), k * math.sin(angle), phase))
    return lambda x, y: sum(a * math.sin(p * x + q * y + f) for a, p, q, f in parts)


def ground(dice, steepest=0.3):
    """Open ground of 2.4 lengths each way."""
    n = dice.choice([6, 12, 24, 40])
    height, shake = waves(dice, steepest), dice.uniform(0, 0.3)
    points = []
    for j in range(n + 1):
        for i in range(n + 1):
            inner = 0 < i < n and 0 < j < n
            x, y = (-1.2 + 2.4 * (k + (dice.uniform(-shake, shake) if inner else 0)) / n for k in (i, j))
            points.append((x, y, height(x, y)))
    faces = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            b = a + n + 1
            faces += [(a, a + 1, b + 1), (a, b + 1, b)] if dice.random() < 0.5 else [(a, a + 1, b), (a + 1, b + 1, b)]
    return points, faces, height


def boulder(dice):
    """A closed body over an eight-sided solid, each face divided; its middle is at the origin."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(4, a, b) for a, b in ((0, 2), (2, 1), (1, 3), (3, 0))] + [(5, b, a) for a, b in ((0, 2), (2, 1), (1, 3), (3, 0))]
    for _ in range(dice.randint(1, 3)):
        middle, finer = {}, []

        def between(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:  # noqa: B023
                sums = [points[a][k] + points[b][k] for k in range(3)]
                size = math.sqrt(sum(c * c for c in sums))
                middle[key] = len(points)  # noqa: B023
                points.append(tuple(c / size for c in sums))
            return middle[key]  # noqa: B023

        for a, b, c in faces:
            p, q, r = between(a, b), between(b, c), between(c, a)
            finer += [(a, p, r), (p, b, q), (r, q, c), (p, q, r)]
        faces = finer
    size = [dice.uniform(0.1, 0.3) for _ in range(3)]
    rough = dice.uniform(0, 0.08)
    points = [tuple(c * s * (1 + dice.uniform(-rough, rough)) for c, s in zip(p, size)) for p in points]
    return points, faces, size


def block(dice):
    """A box, its middle at the origin."""
    size = [dice.uniform(0.1, 0.25) for _ in range(3)]
    points = [tuple(s * (1 if k >> a & 1 else -1) for a, s in enumerate(size)) for k in range(8)]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return points, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], size


def write_mesh(dice, folder, points, faces, unit):
    """Write the triangles in a form and in a unit; returns the keys of the file."""
    faces = faces + ([(faces[0][0], faces[0][0], faces[0][1]), faces[-1]] if dice.random() < 0.3 else [])
    points = [tuple(c / unit for c in p) for p in points]
    form = dice.choice(["obj", "text", "binary"])
    name = "mesh." + form
    with open(os.path.join(folder, name), "wb") as out:
        if form == "obj":
            out.write("".join("v %r %r %r\n" % p for p in points).encode())
            out.write("".join("f %d %d %d\n" % tuple(k + 1 for k in f) for f in faces).encode())
        elif form == "text":
            out.write(b"solid\n")
            for f in faces:
                corners = "".join("vertex %r %r %r\n" % points[k] for k in f)
                out.write(f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n".encode())
            out.write(b"endsolid\n")
        else:
            out.write(b"\0" * 80 + struct.pack("<I", len(faces)))
            for f in faces:
                out.write(b"\0" * 12 + b"".join(struct.pack("<3f", *points[k]) for k in f) + b"\0\0")
    return f"file: {name}, form: {'obj' if form == 'obj' else 'stl'}, scale: {unit!r}"


def friction_of(dice):
    mu = dice.uniform(0, 1)
    if dice.random() < 0.6:
        return f"{mu!r}"
    grain = f", grain: [{dice.uniform(-1, 1)!r}, {dice.uniform(-1, 1)!r}, 0.1]" if dice.random() < 0.3 else ""
    return f"{{axial: {mu!r}, lateral: {dice.uniform(0, 1)!r}, shape: {dice.choice(['ellipse', 'box'])}{grain}}}"


def write_scene(dice, folder):
    size = 10 ** dice.uniform(0, 3)  # [m] of the line
    kind = dice.choice(["ground", "boulder", "block", "sheet"])
    corner = [dice.uniform(-1, 1) * 1e3 * size * (dice.random() < 0.2) for _ in range(3)]
    rounding = 10 ** dice.uniform(-2.3, -1)
    if kind in ("ground", "sheet"):
        points, faces, top = ground(dice)
        if kind == "sheet":  # turned at will
            faces = [(a, c, b) if dice.random() < 0.5 else (a, b, c) for a, b, c in faces]
    else:
        points, faces, half = (boulder if kind == "boulder" else block)(dice)
        top = lambda x, y: half[2] * 0.5 if math.hypot(x, y) < 0.35 else -0.3 * half[2]  # noqa: E731
    points = [tuple(size * c for c in p) for p in points]
    turn = "" if kind in ("ground", "sheet") or dice.random() < 0.5 else f", rotation: {{roll_pitch_yaw: [{dice.uniform(-10, 10)!r}, {dice.uniform(-10, 10)!r}, {dice.uniform(0, 360)!r}]}}"
    keys = write_mesh(dice, folder, points, faces, dice.choice([1, 1e-3, 0.3048]))
    mesh = f"{keys}, radius: {rounding * size!r}, point: [{', '.join(map(repr, corner))}]{turn}, two_sided: {str(kind == 'sheet').lower()}"
    bed = ""
    if kind in ("boulder", "block"):
        bed = f"  bed: {{plane: {{point: [0, 0, {corner[2] - 0.3 * half[2] * size!r}]}}, friction: {friction_of(dice)}}}\n"
    elements = dice.randint(20, 100)
    weight = 10 ** dice.uniform(0, 3)
    stiffness = ".inf" if dice.random() < 0.3 else repr(weight * size * 10 ** dice.uniform(2, 5))
    spread, way = dice.uniform(0.7, 0.95), dice.uniform(0, 2 * math.pi)

    def place(out, angle, lift):
        a, b = out * math.cos(angle), out * math.sin(angle)
        return [corner[0] + a * size, corner[1] + b * size, corner[2] + (top(a, b) + rounding + lift) * size]

    ends = [place(-spread / 2, way, 0.05 + dice.uniform(0, 0.05)), place(spread / 2, way, 0.15)]
    entries, moves = [], kind in ("boulder", "block") and dice.random() < 0.3
    for k in range(STEPS // 4):
        if moves:
            by = [dice.uniform(-0.04, 0.04) * size for _ in range(3)]
            about = [dice.uniform(-10, 10) for _ in range(3)]
            entries.append(f"  - {{name: stage{k}, steps: 4, rock.obstacle: {{move: {by!r}, turn: {math.hypot(*about)!r}, axis: {about!r}, about: {corner!r}}}}}\n")
            continue
        wanted = place(dice.uniform(0.36, 0.5), way + dice.uniform(-0.4, 0.4), 0.15)
        entries.append(f"  - {{name: stage{k}, steps: 4, line.B: {{position: {wanted!r}}}}}\n")
    text = f"capstan: 1\nobstacles:\n  rock:\n    mesh: {{{mesh}}}\n    friction: {friction_of(dice)}\n{bed}"
    text += f"lines:\n  line:\n    length: {size!r}\n    elements: {elements}\n    weight: {weight!r}\n    stiffness: {stiffness}\n    start: static\n"
    text += f"    ends: {{A: {{held: {ends[0]!r}}}, B: {{held: {ends[1]!r}}}}}\nhistory:\n{''.join(entries)}"
    if dice.random() < 0.1 and not moves:
        text += "friction_policy: frozen\n"
    path = os.path.join(folder, "scene.yaml")
    with open(path, "w", encoding="ascii") as out:
        out.write(text)
    return path, kind


def run(command):
    """A command that takes longer than SECONDS is ended, and counts as one that failed."""
    try:
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(command, 1, "", f"{command[1]} took longer than {SECONDS} s")


def main():
    options = argparse.ArgumentParser()
    options.add_argument("capstan")
    options.add_argument("checker")
    options.add_argument("--count", type=int, default=10)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--keep", help="folder for scenes that fail")
    given = options.parse_args()
    refuted = refused = through = 0
    steps, certified = dict.fromkeys(CERTIFIED, 0), dict.fromkeys(CERTIFIED, 0)
    for seed in range(given.seed, given.seed + given.count):
        folder = os.path.join(given.keep, str(seed)) if given.keep else tempfile.mkdtemp()
        os.makedirs(folder, exist_ok=True)
        scene, kind = write_scene(random.Random(seed), folder)
        out = os.path.join(folder, "out")
        found = run([given.capstan, "run", scene, "-o", out, "--force"])
        if "took longer than" in found.stderr or not os.path.exists(os.path.join(out, "result.nc")):
            if re.search("(through|in the way of|below) obstacle", found.stderr):  # the way of an end leads into the body
                through += 1
                continue
            refused += 1
            print(f"seed {seed} ({kind}): {found.stderr.strip()}")
            continue
        told = run([given.checker, os.path.join(out, "result.nc"), scene, "-v"])
        counts = re.match(r"records (\d+), certified (\d+), not certified (\d+), refuted (\d+), not finite (\d+)", told.stdout)
        scene_ok = "against the scene: 0 findings" in told.stdout
        numbers = [int(n) for n in counts.groups()] if counts else [0, 0, 0, 1, 0]
        steps[kind] += numbers[0]
        certified[kind] += numbers[1]
        refuted += numbers[3] + numbers[4] + (not scene_ok)
        if numbers[1] < numbers[0] or numbers[3] or not scene_ok or not counts:
            print(f"seed {seed} ({kind}): {told.stdout.strip().splitlines()[0] if told.stdout else ''} {told.stderr.strip()[:400]}")
    for kind, part in CERTIFIED.items():
        print(f"{kind}: {certified[kind]} of {steps[kind]} steps certified, at least {part:.0%} expected")
    print(f"random meshes: {given.count} scenes from seed {given.seed}, {through} with ways through an obstacle, {sum(steps.values())} steps, "
          f"{sum(certified.values())} certified, {refuted} refuted, {refused} refused")
    good = sum(steps.values()) > 0 and all(certified[kind] >= part * steps[kind] for kind, part in CERTIFIED.items())
    good = good and refuted == 0 and refused == 0 and through <= 0.3 * given.count
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
