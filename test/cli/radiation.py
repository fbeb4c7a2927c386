#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Memory of radiation from a file: random bodies on lines, checked independently; falsified results and other
kernels, which are refused; a run that is killed and resumed.

usage: radiation.py CAPSTAN CHECKER [SCENES [SEED]]
"""
import math
import os
import random
import re
import sys
import tempfile

from runs import command, falsify, resumed, solve, write

SIX = 6
CERTIFIED = 0.995  # of the records, those of entries without a duration among them


def kernel(rng, size, spacing, rows):
    """Sums of S S' exp(-a s) cos(b s), forces per displacement of a body of `size` kg, all of whose transforms are >= 0 for b = 0."""
    modes = []
    for _ in range(rng.randint(1, 3)):
        s = [[rng.gauss(0, 1) * (1 if rng.random() < 0.6 else 0) for _ in range(rng.randint(1, 3))] for _ in range(SIX)]
        for _ in range(SIX):
            for row in s:
                row += [0.0] * (3 - len(row))
        modes.append(([[size * sum(a * b for a, b in zip(s[i], s[k])) for k in range(SIX)] for i in range(SIX)],
                      10 ** rng.uniform(-0.7, 0.7), rng.choice([0, 0, 10 ** rng.uniform(-0.5, 0.5)])))
    both = rng.random() < 0.5
    names = [(i, k) for i in range(SIX) for k in range(SIX) if both or k >= i]
    rng.shuffle(names)
    lines = [",".join(["time"] + [f"k{i + 1}{k + 1}" for i, k in names])]
    for r in range(rows):
        t = spacing * r
        lines.append(",".join([repr(t)] + [repr(sum(m[i][k] * math.exp(-a * t) * math.cos(b * t) for m, a, b in modes)) for i, k in names]))
    return "\n".join(lines) + "\n"


SCENE = """capstan: 1
time_scheme: {scheme}
bodies:
  hull: {{free: {at}, rotation: {{roll_pitch_yaw: {turn}}}, mass: 900, centre_of_gravity: {centre}, moments_of_inertia: [900, 1100, 1200], buoyancy: 14000, added_mass: {{x: 300, y: 500, z: 700, rx: 90}}, damping: {{x: 90, y: 90, z: 90, rx: 50, ry: 50, rz: 50}}{fixed}, radiation: kernel.csv, velocity: {velocity}, turn_rate: {rate}}}
points: {{p: {{body: hull, at: [1, 0, -1]}}, q: {{body: hull, at: [-1, 0.4, -1]}}}}
lines:
{lines}history:
{history}"""


def vector(rng, size):
    return [rng.uniform(-size, size) for _ in range(3)]


def random_scene(rng, spacing):
    far = rng.choice([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [5000.0, -3000.0, 40.0]])
    lines = ""
    for k in range(rng.randint(2, 3)):
        angle = 2 * math.pi * (k / 3 + rng.uniform(-0.1, 0.1))
        anchor = [far[0] + 20 * math.cos(angle), far[1] + 20 * math.sin(angle), far[2] - 15]
        calm = rng.choice([", quasi_static: true", ""])
        lines += f"  l{k}: {{length: {rng.uniform(24, 27)!r}, elements: {rng.randint(3, 10)}, mass: 6, stiffness: {10 ** rng.uniform(4, 6)!r}{calm}, " \
                 f"start: static, ends: {{A: {{held: {anchor}}}, B: {{point: {'pqp'[k]}}}}}}}\n"
    history = ""
    for k in range(rng.randint(1, 3)):
        if k > 0 and rng.random() < 0.3:
            history += f"  - {{name: rest{k}}}\n"
        steps = f"steps: {rng.randint(5, 40)}" if rng.random() < 0.7 else f"time_step: {spacing * 2!r}, error: {10 ** rng.uniform(-4, -2.5)!r}"
        change = rng.choice([f"force: {vector(rng, 2000)}, moment: {vector(rng, 500)}", f"force: {vector(rng, 2000)}"])
        if rng.random() < 0.2:
            change = f"position: {[a + b for a, b in zip(far, vector(rng, 0.5))]}, rotation: {{roll_pitch_yaw: {vector(rng, 60)}}}"
        history += f"  - {{name: sea{k}, duration: {rng.uniform(0.5, 12)!r}, {steps}, hull.body: {{{change}}}}}\n"
    return SCENE.format(scheme=rng.choice(["bdf2", "bdf2", "euler"]), at=far, turn=vector(rng, 60), centre=vector(rng, 0.3), lines=lines, history=history,
                        fixed=rng.choice(["", "", ", fixed: [x, rz]"]), velocity=[0.0] * 3, rate=[0.0] * 3)


def random_scenes(capstan, checker, folder, count, seed):
    steps = certified = 0
    for index in range(count):
        rng = random.Random(1000 * seed + index)
        spacing, rows = 10 ** rng.uniform(-2, 0), rng.randint(2, 200)
        write(folder, "kernel.csv", kernel(rng, 10 ** rng.uniform(0, 2.5), spacing, rows))
        text = random_scene(rng, spacing)
        scene, out = write(folder, "scene.yaml", text), os.path.join(folder, "out")
        code, said = command(capstan, "run", scene, "-q", "-o", out, "--force")
        assert code in (0, 1), (seed, index, said)
        _, said = command(checker, os.path.join(out, "result.nc"), scene, "-v")
        told = re.search(r"records (\d+), certified (\d+), not certified (\d+), refuted (\d+), not finite (\d+)", said)
        assert told and told.group(4, 5) == ("0", "0") and "against the scene: 0 findings" in said, (seed, index, said)
        steps, certified = steps + int(told.group(1)), certified + int(told.group(2))
    print(f"radiation: {count} random scenes, {certified} of {steps} records of lines certified, none refuted")
    assert certified >= CERTIFIED * steps


LONG = """  l: {length: 24, elements: 20, mass: 6, stiffness: 1e5, start: static, ends: {A: {held: [15, 0, -15]}, B: {point: p}}}
  m: {length: 24, elements: 20, mass: 6, stiffness: 1e5, start: static, ends: {A: {held: [-15, 0, -15]}, B: {point: q}}}
"""


def one_scene(capstan, checker, folder):
    rng = random.Random(3)
    table = kernel(rng, 60, 0.1, 101)
    write(folder, "kernel.csv", table)
    fill = dict(scheme="bdf2", at=[0, 0, 0], turn=[10, -5, 30], centre=[0, 0, -0.2], fixed="", lines=LONG, velocity=[0] * 3, rate=[0] * 3)
    text = SCENE.format(history="  - {name: pull, duration: 8, steps: 60, hull.body: {force: [900, 400, 0], moment: [50, 90, 0]}}\n"
                                "  - {name: go, duration: 4, steps: 40}\n", **fill)
    scene, out, found = solve(capstan, checker, folder, text)
    code, said = command(capstan, "check", scene)
    assert code == 0 and "  memory of radiation over 10 s in 101 rows\n" in said, said
    for variable, index in (("load_of_body", 1), ("load_moment_of_body", 2), ("ledger_drag_of_body", 0), ("velocity_of_body", 0)):
        falsify(found, folder, variable, 50, index, 1e-3)
        code, _ = command(checker, os.path.join(folder, "copy.nc"), scene)
        assert code != 0, variable
    lines = table.split("\n")
    for row in (1, 40, 100):
        other = lines[:row] + [",".join(repr(float(x) + (k > 0)) for k, x in enumerate(lines[row].split(",")))] + lines[row + 1:]
        write(folder, "kernel.csv", "\n".join(other))
        code, _ = command(checker, os.path.join(out, "result.nc"), scene)
        assert code != 0, row
    write(folder, "kernel.csv", table)
    _, _, plain = solve(capstan, checker, folder, text.replace("radiation: kernel.csv, ", ""))
    moved = max(abs(a - b) for a, b in zip(found.get("position_of_body", 100), plain.get("position_of_body", 100)))
    print(f"radiation: moves the body by {moved:.3f} m")
    assert moved > 0.01
    text = SCENE.format(history="  - {name: pull, duration: 100, steps: 1000, hull.body: {force: [900, 400, 0], moment: [50, 90, 0]}}\n", **fill)
    resumed(capstan, folder, text, 100000, 1001, (300, 700, 1000), ("position_of_body", "load_of_body", "velocity_of_body"))


def main():
    capstan, checker = sys.argv[1:3]
    count, seed = [int(w) for w in sys.argv[3:]] + [20, 1][len(sys.argv) - 3:]
    with tempfile.TemporaryDirectory() as folder:
        one_scene(capstan, checker, folder)
        random_scenes(capstan, checker, folder, count, seed)


if __name__ == "__main__":
    main()
