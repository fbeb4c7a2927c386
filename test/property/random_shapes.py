#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random histories on capsules, tori, cones and boxes, and inside of bores and bowls, each checked by the independent checker.

usage: random_shapes.py CAPSTAN CHECKER [--count N] [--seed S] [--only CLASS] [--keep FOLDER]

Of each class N scenes: a line is drawn over the shape, or lies in it, and its ends are moved or pulled about in 16 steps; size, place, axes,
friction (of one coefficient, of two, with a grain), mesh and stiffness are random, and half of the shapes move and turn meanwhile. Of each
class at least 99 of 100 steps must be certified, and the checker must refute none.
"""
import math
import os
import random
import sys

sys.dont_write_bytecode = True  # nothing is left in the source folder
import checked  # noqa: E402

STEPS = 16
CERTIFIED = 0.99
CLASSES = ["capsule", "torus", "cone", "box", "bore", "bowl"]


def numbers(values):
    return "[" + ", ".join(repr(float(v)) for v in values) + "]"


def direction(dice, about, tilt):
    """A direction near one of the scene's."""
    return [a + dice.uniform(-tilt, tilt) for a in about]


class Scene:
    """Lengths are in units of `size`, places relative to `origin`."""

    def __init__(self, dice):
        self.dice = dice
        self.size = 10 ** dice.uniform(-1, 2)
        far = 1e4 * self.size if dice.random() < 0.15 else self.size
        self.origin = [dice.uniform(-1, 1) * far for _ in range(3)]

    def place(self, x):
        return numbers(self.origin[k] + self.size * x[k] for k in range(3))

    def long(self, x):
        return repr(self.size * x)

    def rotation(self):
        return f"rotation: {{quaternion: {numbers([1] + [self.dice.uniform(-0.3, 0.3) for _ in range(3)])}}}"

    def outside(self, kind):
        """The shape about the origin, and its smallest radius."""
        dice = self.dice
        if kind == "capsule":
            radius, axis = dice.uniform(0.3, 0.9), direction(dice, dice.choice([(0, 0, 1), (0, 1, 0), (0.3, 1, 0.3)]), 0.3)
            return (f"capsule: {{centre: {self.place([0, 0, 0])}, axis: {numbers(axis)}, radius: {self.long(radius)}, "
                    f"length: {self.long(dice.choice([0, dice.uniform(0, 1.2)]))}}}"), radius
        if kind == "torus":
            radius, axis = dice.uniform(0.25, 0.5), direction(dice, dice.choice([(0, 0, 1), (1, 0, 0), (0, 1, 0)]), 0.3)
            return (f"torus: {{centre: {self.place([0, 0, 0])}, axis: {numbers(axis)}, radius: {self.long(radius)}, "
                    f"main_radius: {self.long(radius + dice.uniform(0.2, 0.8))}}}"), radius
        if kind == "cone":
            radius = dice.uniform(0.2, 0.6)
            return (f"cone: {{tip: {self.place([0, 0, dice.uniform(0, 0.8)])}, axis: {numbers(direction(dice, (0, 0, -1), 0.2))}, "
                    f"angle: {dice.uniform(10, 35)!r}, radius: {self.long(radius)}}}"), radius
        radius = dice.uniform(0.2, 0.5)
        sizes = [2 * radius + dice.uniform(0.1, 1.2) for _ in range(3)]
        return f"box: {{centre: {self.place([0, 0, 0])}, size: {numbers(self.size * s for s in sizes)}, radius: {self.long(radius)}, {self.rotation()}}}", radius

    def inside(self, kind):
        """The shape, places of two ends in it, and how far from there ends may be."""
        dice = self.dice
        if kind == "bowl":
            form = dice.choice(["sphere", "cone", "box"])
            if form == "sphere":
                return f"sphere: {{centre: {self.place([0, 0, 0])}, radius: {self.long(2)}, inside: true}}", [[-1, 0, -1], [1, 0.2, -1]], 0.4
            if form == "cone":
                return (f"cone: {{tip: {self.place([0, 0, -2])}, axis: {numbers(direction(dice, (0, 0, 1), 0.1))}, angle: {dice.uniform(40, 60)!r}, "
                        f"radius: {self.long(dice.uniform(0.3, 1))}, inside: true}}"), [[-0.8, 0, 0], [0.8, 0.2, 0.1]], 0.3
            return (f"box: {{centre: {self.place([0, 0, 0])}, size: {numbers([4 * self.size] * 3)}, radius: {self.long(dice.uniform(0.2, 0.8))}, "
                    f"{self.rotation().replace('0.3', '0.1')}, inside: true}}"), [[-0.9, 0, -1], [0.9, 0.1, -1]], 0.3
        form = dice.choice(["cylinder", "capsule", "torus"])
        if form == "cylinder":
            return (f"cylinder: {{point: {self.place([0, 0, 0])}, axis: {numbers(direction(dice, (1, 0, 0), 0.15))}, radius: {self.long(1)}, inside: true}}",
                    [[-1.5, 0, -0.3], [1.5, 0, -0.3]], 0.2)
        if form == "capsule":
            return (f"capsule: {{centre: {self.place([0, 0, 0])}, axis: {numbers(direction(dice, (1, 0, 0), 0.1))}, radius: {self.long(1)}, "
                    f"length: {self.long(3)}, inside: true}}"), [[-1.5, 0, -0.3], [1.5, 0, -0.3]], 0.2
        return (f"torus: {{centre: {self.place([0, -3, 0])}, axis: {numbers(direction(dice, (0, 0, 1), 0.05))}, radius: {self.long(1)}, "
                f"main_radius: {self.long(3)}, inside: true}}"), [[-1.2, -0.3, -0.2], [1.2, -0.3, -0.2]], 0.2

    def friction(self):
        dice, mu = self.dice, self.dice.choice([0, self.dice.uniform(0, 0.8), self.dice.uniform(0, 0.8)])
        if dice.random() < 0.7:
            return repr(mu)
        grain = f", grain: {numbers(dice.uniform(-1, 1) for _ in range(3))}" if dice.random() < 0.3 else ""
        return f"{{axial: {mu!r}, lateral: {dice.uniform(0, 0.8)!r}{grain}}}"

    def shift(self, most):
        """The shape moves in a stage."""
        dice = self.dice
        return (f", shape.obstacle: {{move: {numbers(self.size * dice.uniform(-most, most) for _ in range(3))}, "
                f"turn: {dice.uniform(-20, 20)!r}, axis: {numbers(direction(dice, (0, 0, 1), 1))}, about: {self.place([0, 0, 0])}}}")


def write_scene(dice, folder, kind):
    scene = Scene(dice)
    moves = dice.random() < 0.5
    if kind in ("bore", "bowl"):
        shape, ends, freedom = scene.inside(kind)
        radius, most = 1, 0.05
        lengthen = dice.uniform(1.02, 1.3)
        targets = [[[e[k] + dice.uniform(-freedom, freedom) * (1, 1, 0.5)[k] for k in range(3)] for e in ends] for _ in range(4)]
    else:
        shape, radius = scene.outside(kind)
        ends = [[-2.5, dice.uniform(-0.2, 0.2), 2], [2.5, dice.uniform(-0.2, 0.2), 2]]
        most, lengthen = 0.1, dice.uniform(1.02, 1.15)
        targets = [[[s * dice.uniform(2.3, 2.7), dice.uniform(-0.6, 0.6), dice.uniform(-1, 0.8)] for s in (-1, 1)] for _ in range(4)]
    apart = math.dist(*ends)
    length = apart * lengthen
    elements = min(150, max(30, int(length / (dice.uniform(0.15, 0.35) * radius))))
    weight = 10 ** dice.uniform(0, 3)
    stiffness = weight * scene.size * 10 ** dice.uniform(2.5, 5)
    line = f"    length: {scene.long(length)}\n    elements: {elements}\n    weight: {weight!r}\n    stiffness: {stiffness!r}\n    start: static\n"
    pulled = kind in ("bore", "bowl") and dice.random() < 0.5
    entries = []
    for k, target in enumerate(targets):
        ways = f"line.B: {{position: {scene.place(target[1])}}}, line.A: {{position: {scene.place(target[0])}}}"
        if pulled:
            pull = [dice.uniform(0, 2) * weight * scene.size, dice.uniform(-0.5, 0.5) * weight * scene.size, 0]
            ways = f"line.B: {{force: {numbers(pull)}}}"
        entries.append(f"  - {{name: stage{k}, steps: {STEPS // 4}, {ways}{scene.shift(most) if moves else ''}}}\n")
    text = f"capstan: 1\nobstacles:\n  shape:\n    {shape}\n    friction: {scene.friction()}\nlines:\n  line:\n{line}"
    text += f"    ends: {{A: {{held: {scene.place(ends[0])}}}, B: {{held: {scene.place(ends[1])}}}}}\nhistory:\n{''.join(entries)}"
    path = os.path.join(folder, "scene.yaml")
    with open(path, "w", encoding="ascii") as out:
        out.write(text)
    return path


def one_class(given, kind):
    steps = certified = refuted = refused = ended = 0
    for seed in checked.seeds(given, kind):
        folder = checked.folder_of(given, kind, seed)
        scene = write_scene(random.Random(f"{kind} {seed}"), folder, kind)
        out = os.path.join(folder, "out")
        found = checked.run(given.capstan, "run", scene, "-o", out, "--force")
        if not os.path.exists(os.path.join(out, "result.nc")):
            refused += 1
            print(f"{kind} {seed}: {found.stderr.strip()}")
            continue
        if "is held in the way" in found.stderr:  # the shape moves over an end: the rest of the history is refused
            ended += 1
        elif found.returncode not in (0, 1, 5):
            refused += 1
            print(f"{kind} {seed}: {found.stderr.strip()}")
        found, words = checked.check(given.checker, out, scene)
        steps += found[0]
        certified += found[1]
        refuted += found[3] + found[4]
        if found[1] < found[0] or found[3]:
            print(f"{kind} {seed}: {words}")
    print(f"{kind}: {given.count} scenes from seed {given.seed}, {steps} steps, {certified} certified, {refuted} refuted, {refused} refused, {ended} ended by an end in the way", flush=True)
    return steps > 0 and certified >= CERTIFIED * steps and refuted == 0 and refused == 0 and ended <= 0.1 * given.count + 1


if __name__ == "__main__":
    checked.main(CLASSES, one_class, 3)
