#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random histories on measured ground, each checked by the independent checker.

usage: random_grounds.py CAPSTAN CHECKER [--count N] [--seed S] [--keep FOLDER]

A scene has a line on random ground: waves of random length, height and direction on a slope, given in one of the forms of files (some with
another spacing along y, far from the origin, as depths, with factors of friction, or beside a boulder); friction of one coefficient, of two,
or with a grain; an elastic or an inextensible line that is laid by statics and drawn about in 16 steps. At least 99 of 100 steps must be
certified, and the checker must refute none.
"""
import argparse
import math
import os
import random
import re
import subprocess
import sys
import tempfile

STEPS = 16
CERTIFIED = 0.99
SECONDS = 120


def waves(dice, size):
    """A height function, steep at most as 1 in 1, and bent at most over its shortest wave."""
    parts = []
    for _ in range(dice.randint(1, 3)):
        length = dice.uniform(0.3, 2) * size
        steep = dice.uniform(0, 0.25)
        angle, phase = dice.uniform(0, 2 * math.pi), dice.uniform(0, 2 * math.pi)
        k = 2 * math.pi / length
        parts.append((steep / k, k * math.cos(angle), k * math.sin(angle), phase))
    slope = dice.uniform(-0.15, 0.15), dice.uniform(-0.15, 0.15)
    return lambda x, y: slope[0] * x + slope[1] * y + sum(a * math.sin(p * x + q * y + f) for a, p, q, f in parts)


def write_grid(dice, folder, name, form, axes, value, down):
    """Write values on the points of two axes in a form; returns the file's name."""
    x, y = axes
    sign = -1 if down else 1
    file = f"{name}.{form}"
    lines = []
    if form == "esri":
        lines += [f"ncols {len(x)}", f"nrows {len(y)}", f"xllcenter {x[0]!r}", f"yllcenter {y[0]!r}", f"cellsize {x[1] - x[0]!r}"]
        lines += [" ".join(repr(sign * value(a, b)) for a in x) for b in reversed(y)]
    elif form == "xyz":
        rows = [f"{a!r} {b!r} {sign * value(a, b)!r}" for b in y for a in x]
        dice.shuffle(rows)
        lines += ["# x y z"] + rows
    elif form == "moordyn_c":
        lines += [f"{len(x)} {len(y)}", " ".join(map(repr, x)), " ".join(map(repr, y))]
        lines += [f"{a!r} {b!r} {sign * value(a, b)!r}" for a in x for b in y]
    else:
        lines += ["--- MoorDyn Bathymetry Input File ---", f"nGridX {len(x)}", f"nGridY {len(y)}", " ".join(map(repr, x))]
        lines += [" ".join([repr(b)] + [repr(-value(a, b)) for a in x]) for b in y]
    with open(os.path.join(folder, file), "w", encoding="ascii") as out:
        out.write("\n".join(lines) + "\n")
    return file


def write_scene(dice, folder):
    size = 10 ** dice.uniform(0, 3)  # [m] of the line
    form = dice.choice(["esri", "xyz", "moordyn_c", "moordyn_f"])
    down = form != "moordyn_f" and dice.random() < 0.3
    far = dice.random() < 0.2
    corner = [dice.uniform(-1, 1) * 1e4 * size * far for _ in range(2)]
    count = dice.randint(20, 60)
    cell = 2.4 * size / (count - 1)
    wide = cell if form == "esri" else cell * dice.uniform(0.7, 1.4)
    x = [corner[0] - 1.2 * size + cell * i for i in range(count)]
    y = [corner[1] - 1.2 * size + wide * j for j in range(int(2.4 * size / wide) + 2)]
    rough = waves(dice, size)
    height = lambda a, b: round(rough(a - corner[0], b - corner[1]), 9)  # noqa: E731
    grid = write_grid(dice, folder, "bed", form, (x, y), height, down)
    ground = f"file: {grid}, form: {form}, depths: {str(down).lower()}"
    if dice.random() < 0.3:
        factor = lambda a, b: round(1 + 0.5 * math.sin(3 * a / size) * math.cos(2 * b / size), 9)  # noqa: E731
        values = {(a, b): factor(a, b) for a in x for b in y}
        down_factor = form == "moordyn_f"
        ground += f", friction_factor: {write_grid(dice, folder, 'factor', form, (x, y), (lambda a, b: -values[a, b]) if down_factor else (lambda a, b: values[a, b]), False)}"
    mu = dice.uniform(0, 1)
    friction = f"{mu!r}"
    if dice.random() < 0.4:
        friction = f"{{axial: {mu!r}, lateral: {dice.uniform(0, 1)!r}, shape: {dice.choice(['ellipse', 'box'])}"
        friction += f", grain: [{dice.uniform(-1, 1)!r}, {dice.uniform(-1, 1)!r}, 0.1]}}" if dice.random() < 0.3 else "}"
    boulder = ""
    if dice.random() < 0.2:
        at = [corner[k] + dice.uniform(-0.2, 0.2) * size for k in range(2)]
        boulder = f"  boulder: {{sphere: {{centre: [{at[0]!r}, {at[1]!r}, {height(*at)!r}], radius: {dice.uniform(0.03, 0.1) * size!r}}}, friction: 0.3}}\n"
    elements = dice.randint(20, 120)
    weight = 10 ** dice.uniform(0, 3)
    stiffness = ".inf" if dice.random() < 0.3 else repr(weight * size * 10 ** dice.uniform(2, 5))
    spread = dice.uniform(0.7, 0.95)
    turn = dice.uniform(0, 2 * math.pi)

    def place(out, angle, lift):
        a, b = corner[0] + out * size * math.cos(angle), corner[1] + out * size * math.sin(angle)
        return [a, b, height(a, b) + lift * size]

    # ends well above all waves between them, so that no path leads through the ground
    ends = [place(-spread / 2, turn, 0.02 + dice.uniform(0, 0.05)), place(spread / 2, turn, 0.15)]
    entries = []
    for k in range(STEPS // 4):
        wanted = place(dice.uniform(0.3, 0.5), turn + dice.uniform(-0.4, 0.4), 0.15)
        entries.append(f"  - {{name: stage{k}, steps: 4, line.B: {{position: [{', '.join(map(repr, wanted))}]}}}}\n")
    text = f"capstan: 1\nobstacles:\n  bed:\n    ground: {{{ground}}}\n    friction: {friction}\n{boulder}"
    text += f"lines:\n  line:\n    length: {size!r}\n    elements: {elements}\n    weight: {weight!r}\n    stiffness: {stiffness}\n    start: static\n"
    text += f"    ends: {{A: {{held: [{', '.join(map(repr, ends[0]))}]}}, B: {{held: [{', '.join(map(repr, ends[1]))}]}}}}\nhistory:\n{''.join(entries)}"
    if dice.random() < 0.2:
        text += "friction_policy: frozen\n"
    path = os.path.join(folder, "scene.yaml")
    with open(path, "w", encoding="ascii") as out:
        out.write(text)
    return path


def run(command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=SECONDS, check=False)


def main():
    options = argparse.ArgumentParser()
    options.add_argument("capstan")
    options.add_argument("checker")
    options.add_argument("--count", type=int, default=10)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--keep", help="folder for scenes that fail")
    given = options.parse_args()
    steps = certified = refuted = refused = through = 0
    for seed in range(given.seed, given.seed + given.count):
        folder = os.path.join(given.keep, str(seed)) if given.keep else tempfile.mkdtemp()
        os.makedirs(folder, exist_ok=True)
        scene = write_scene(random.Random(seed), folder)
        out = os.path.join(folder, "out")
        found = run([given.capstan, "run", scene, "-o", out, "--force"])
        if not os.path.exists(os.path.join(out, "result.nc")):
            if "through obstacle" in found.stderr:  # the way of an end leads through a wave or the boulder
                through += 1
                continue
            refused += 1
            print(f"seed {seed}: {found.stderr.strip()}")
            continue
        told = run([given.checker, os.path.join(out, "result.nc"), scene, "-v"])
        counts = re.match(r"records (\d+), certified (\d+), not certified (\d+), refuted (\d+), not finite (\d+)", told.stdout)
        scene_ok = "against the scene: 0 findings" in told.stdout
        numbers = [int(n) for n in counts.groups()] if counts else [0, 0, 0, 1, 0]
        steps += numbers[0]
        certified += numbers[1]
        refuted += numbers[3] + numbers[4] + (not scene_ok)
        if numbers[1] < numbers[0] or numbers[3] or not scene_ok or not counts:
            print(f"seed {seed}: {told.stdout.strip().splitlines()[0] if told.stdout else ''} {told.stderr.strip()[:400]}")
    print(f"random ground: {given.count} scenes from seed {given.seed}, {through} with ways through an obstacle, {steps} steps, "
          f"{certified} certified, {refuted} refuted, {refused} refused")
    good = steps > 0 and certified >= CERTIFIED * steps and refuted == 0 and refused == 0 and through <= 0.3 * given.count
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
