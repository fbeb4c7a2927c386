#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Free points and free ends that lie on what turns, each history checked independently.

usage: random_turns.py CAPSTAN CHECKER [--count N] [--seed S] [--only CLASS] [--keep FOLDER]

Of each class N scenes: `points`, a clump on a drum, which one line to four hold from anchors beside it; `ends`, a line over a drum, of which one
end hangs free, or is pulled, or lies on it. The drum is a cylinder, sphere or capsule, rough or not; it turns about its own axis by up to two
turns in an entry of one step to four, to and fro, or moves and turns about any axis, or does both at once, and a line's held end moves or not. At least 99
of 100 steps of each class must be certified, and the checker must refute none.
"""
import math
import random
import sys

sys.dont_write_bytecode = True  # nothing is left in the source folder
import checked  # noqa: E402

CERTIFIED = 0.99  # share of the steps of a class
CLASSES = ["points", "ends"]


def numbers(values):
    return "[" + ", ".join(repr(float(v)) for v in values) + "]"


class Scene:
    """Lengths are in units of `size`, places relative to `origin`, where the drum of radius 1 has its centre."""

    def __init__(self, dice):
        self.dice = dice
        self.size, self.weight = 10 ** dice.uniform(-1, 2), 10 ** dice.uniform(0, 3)
        far = 1e4 * self.size if dice.random() < 0.15 else self.size
        self.origin = [dice.uniform(-1, 1) * far for _ in range(3)]
        self.stiffness = self.weight * self.size * 10 ** dice.uniform(2.5, 5)

    def place(self, x):
        return numbers(self.origin[k] + self.size * x[k] for k in range(3))

    def some(self, size):
        return [self.dice.uniform(-size, size) for _ in range(3)]

    def drum(self):
        kind, axis = self.dice.choice(["cylinder", "sphere", "capsule"]), numbers([self.dice.uniform(-0.1, 0.1), 1, self.dice.uniform(-0.1, 0.1)])
        self.tilts = 2 if kind == "cylinder" else 25  # degrees; it has no ends, which would come to the anchors
        at = {"cylinder": f"point: {self.place([0, 0, 0])}", "sphere": f"centre: {self.place([0, 0, 0])}"}.get(kind)
        at = at or f"length: {self.size * 2!r}, centre: {self.place([0, 0, 0])}"
        friction = self.dice.choice([0, self.dice.uniform(0.05, 0.3), self.dice.uniform(0.3, 1)])
        return f"obstacles:\n  drum: {{{kind}: {{{at}, axis: {axis}, radius: {self.size!r}}}, friction: {friction!r}}}\n"

    def turns(self):
        """What the drum does in an entry."""
        dice, said = self.dice, []
        if dice.random() < 0.75:
            said.append(f"drum.turn: {dice.choice([dice.uniform(-40, 40), dice.uniform(-720, 720)])!r}")
        if dice.random() < 0.35:
            angle, axis = dice.uniform(-self.tilts, self.tilts), self.some(1)
            said.append(f"drum.obstacle: {{move: {numbers(self.size * x for x in self.some(0.15))}, turn: {angle!r}, axis: {numbers(axis)}, about: {self.place([0, 0, 0])}}}")
        return said

    def line(self, name, length, elements, ends):
        return (f"  {name}: {{length: {length * self.size!r}, elements: {elements}, weight: {self.weight!r}, stiffness: {self.stiffness!r}, "
                f"start: static, ends: {{A: {ends[0]}, B: {ends[1]}}}}}\n")

    def history(self, moved, pulled):
        """Three entries of one step to four; `moved`: an end and where it is held; `pulled`: an end that is free."""
        text = "history:\n"
        for k in range(3):
            said = self.turns()
            if moved and self.dice.random() < 0.5:
                way = self.some(0.1)
                said.append(f"{moved[0]}: {{position: {self.place([a + b for a, b in zip(moved[1], way)])}}}")
            if pulled and self.dice.random() < 0.5:
                force = [self.weight * self.size * self.dice.uniform(-0.5, 0.5) for _ in range(2)] + [0.0]
                said.append(f"{pulled}: {{force: {numbers(force)}}}")
            text += f"  - {{name: entry {k}, steps: {self.dice.choice([1, 2, 4])}, {', '.join(said or ['drum.turn: 10'])}}}\n"
        return text


def clump(scene):
    """A clump near the top of the drum."""
    dice, lines, anchors = scene.dice, "", []
    at = [dice.uniform(-0.4, 0.4), dice.uniform(-0.4, 0.4), 1.05]
    for k in range(dice.randint(1, 4)):
        angle, far = dice.uniform(0, 2 * math.pi), dice.uniform(2.8, 4)
        over = abs(far * math.cos(angle)) < 2
        anchors.append([far * math.cos(angle), far * math.sin(angle), dice.uniform(2, 3) if over else dice.uniform(-0.5, 2.5)])
        length = math.dist(at, anchors[-1]) * dice.choice([dice.uniform(1.005, 1.05), dice.uniform(1.05, 1.5)])
        lines += scene.line(f"line{k}", length, dice.randint(4, 20), ("{point: clump}", f"{{held: {scene.place(anchors[-1])}}}"))
    weight = scene.weight * scene.size * 10 ** dice.uniform(-1, 1.5)
    return (f"points:\n  clump: {{free: {scene.place(at)}, weight: {weight!r}}}\nlines:\n{lines}" + scene.history(("line0.B", anchors[0]), None))


def hanging(scene):
    """A line from a held end over the drum, whose other end is free."""
    dice = scene.dice
    held, length = [dice.uniform(-3, -1.6), 0.0, 1.03], dice.choice([dice.uniform(0.3, 1.5), dice.uniform(1.5, 4)])
    length -= held[0]
    way, left = [held], length
    for x in [[0.0, 0.0, 1.03]] + [[1.03 * math.sin(a), 0.0, 1.03 * math.cos(a)] for a in (math.pi * k / 48 for k in range(1, 25))] + [[1.03, 0.0, -9.0]]:
        far = math.dist(way[-1], x)
        way.append([a + min(1, left / far) * (b - a) for a, b in zip(way[-1], x)])
        left -= far
        if left <= 0:
            break
    line = (f"  line0:\n    length: {length * scene.size!r}\n    elements: {dice.randint(20, 60)}\n    weight: {scene.weight!r}\n    stiffness: {scene.stiffness!r}\n"
            f"    start: {{polyline: [{', '.join(scene.place(x) for x in way)}]}}\n    ends: {{A: {{held: {scene.place(held)}}}, B: {{force: [0, 0, 0]}}}}\n")
    return f"lines:\n{line}" + scene.history(("line0.A", held), "line0.B")


def text_of(kind, seed):
    scene = Scene(random.Random(f"{kind} {seed}"))
    return "capstan: 1\n" + scene.drum() + (clump if kind == "points" else hanging)(scene)


def one_class(given, kind):
    tally = checked.Tally(kind)
    for seed in checked.seeds(given, kind):
        code, found, words = checked.solve_named(given, text_of(kind, seed), checked.folder_of(given, kind, seed), "scene")
        tally.add(seed, code, found, words)
    tally.told(given)
    return tally.is_good(CERTIFIED)


if __name__ == "__main__":
    checked.main(CLASSES, one_class, 3)
