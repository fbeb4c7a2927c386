#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random moorings with winches at points, bodies and held ends, each checked by the independent checker; and against the same moorings
without winches, whose lines are as long as what is off the drums.

usage: random_winches.py CAPSTAN CHECKER [--count N] [--seed S] [--only CLASS] [--keep FOLDER]

Of each class N scenes: two to four lines, elastic or not, with and without weight, hold a point or a body; drums at some of their ends pay
out and haul in, and an anchor moves. At least 995 of 1000 steps must be certified, those refused with a proof counted apart, and the checker
must refute none. Of `whole`, elastic lines with weight without an obstacle,
drums hold whole elements when the history ends: place and forces there are those of the mooring without winches, to 1e-7 of its size and of
its largest force.
"""
import math
import os
import random
import sys

sys.dont_write_bytecode = True  # nothing is left in the source folder
import checked  # noqa: E402
from result_file import Results  # noqa: E402


CERTIFIED = 0.995
EQUAL = 1e-7  # forces at a point balance to 1e-10 of the largest, and sideways a mooring may be a thousand times softer than along its lines
CLASSES = ["point", "body", "whole"]


class Line:
    """A line from an anchor to the middle; what is on its drums at A and B, None where there is none."""

    def __init__(self, dice, kind, size, weight, stiffness, angle):
        far = size * dice.uniform(0.8, 2)
        self.anchor = [far * math.cos(angle), far * math.sin(angle), size * dice.uniform(-0.25, 0.6)]
        paid = math.hypot(*self.anchor) * dice.uniform(1.02, 1.6)
        drums = [dice.random() < 0.45 for _ in range(2)]
        self.stiffness, self.weight = stiffness, weight * (1 if kind == "whole" else dice.choice([0, 1, 1]))
        self.elements = dice.randint(6, 30)
        self.element = paid / self.elements
        if kind == "whole":
            extra = [dice.randint(0, self.elements // 3) if drum else 0 for drum in drums]
            self.stored = [n * self.element if drum else None for n, drum in zip(extra, drums)]
            self.elements += sum(extra)
        else:
            self.stored = [dice.choice([0, paid * dice.uniform(0, 0.4)]) if drum else None for drum in drums]
        self.length = paid + sum(x or 0 for x in self.stored)
        self.left = [x or 0.0 for x in self.stored]

    def pay(self, dice, kind):
        """What its winches do in a stage, as (end, length)."""
        found = []
        for end in range(2):
            if self.stored[end] is None or dice.random() < 0.3:
                continue
            by = dice.uniform(-0.25, 0.25) * self.length
            if kind == "whole":
                by = round(by / self.element) * self.element
            by = min(by, self.left[end])
            if self.length - sum(self.left) + by < 0.35 * self.length:
                by = 0.0
            self.left[end] -= by
            found.append(("AB"[end], by))
        return found

    def text(self, name, at, origin, winches=True):
        ends = [f"held: {place(self.anchor, origin)}", f"point: {at}"]
        length, elements = self.length, self.elements
        for end in range(2):
            if winches and self.stored[end] is not None:
                ends[end] += f", stored: {self.stored[end]!r}"
        if not winches:
            length -= sum(self.left)
            elements = round(length / self.element)
        return (f"  {name}: {{length: {length!r}, elements: {elements}, weight: {self.weight!r}, stiffness: {self.stiffness}, start: static, "
                f"ends: {{A: {{{ends[0]}}}, B: {{{ends[1]}}}}}}}\n")


def place(x, origin):
    return "[" + ", ".join(repr(a + b) for a, b in zip(x, origin)) + "]"


class Mooring:
    def __init__(self, dice, kind):
        self.kind, self.dice = kind, dice
        self.size, weight = 10 ** dice.uniform(-1, 2), 10 ** dice.uniform(0, 2)
        self.origin = [dice.choice([0, 0, 1e3, -1e4]) * self.size for _ in range(2)] + [0.0]
        elastic = [10 ** dice.uniform(2, 5) * weight * self.size]
        stiffness = repr(dice.choice(elastic if kind != "point" else elastic + [math.inf])).replace("inf", ".inf")
        count = dice.randint(2, 4)
        self.lines = [Line(dice, kind, self.size, weight, stiffness, 2 * math.pi * (i + dice.uniform(-0.2, 0.2)) / count) for i in range(count)]
        self.mass = weight * self.size * dice.uniform(0.2, 3) / 9.81
        self.bed = kind == "point" and dice.random() < 0.7
        self.depth, self.friction = -self.size * dice.uniform(0.3, 1), dice.choice([0, 0.3, 1])
        self.arms = [[dice.uniform(-0.2, 0.2) * self.size for _ in range(3)] for _ in self.lines]
        self.stages = []
        for _ in range(dice.randint(1, 4)):
            pays = [f"l{i}.pay_out_{end}: {by!r}" for i, line in enumerate(self.lines) for end, by in line.pay(dice, kind)]
            if kind != "whole" and dice.random() < 0.3:
                pays.append(f"l0.A: {{move: [0, {0.05 * self.size!r}, {0.05 * self.size!r}]}}")
            self.stages.append((dice.randint(1, 4), pays))

    def text(self, winches=True):
        middle = place([0.0, 0, 0], self.origin)
        out = "capstan: 1\ngravity: [0, 0, -9.81]\n"
        if self.bed:
            out += f"obstacles: {{bed: {{plane: {{point: {place([0, 0, self.depth], self.origin)}}}, friction: {self.friction}}}}}\n"
        if self.kind == "body":
            out += f"bodies: {{hull: {{free: {middle}, mass: {self.mass!r}}}}}\npoints:\n"
            out += "".join(f"  p{i}: {{body: hull, at: {place(arm, [0, 0, 0])}}}\n" for i, arm in enumerate(self.arms))
        else:
            out += f"points: {{p: {{free: {middle}, mass: {self.mass!r}}}}}\n"
        out += "lines:\n" + "".join(line.text(f"l{i}", f"p{i}" if self.kind == "body" else "p", self.origin, winches)
                                    for i, line in enumerate(self.lines))
        out += "history:\n"
        for k, (steps, pays) in enumerate(self.stages if winches else [(1, [])]):
            out += f"  - {{{', '.join([f'name: stage{k}', f'steps: {steps}'] + pays)}}}\n"
        return out


def difference(mooring, folder):
    """The largest difference from the mooring without winches, relative to its size and largest force."""
    ours, theirs = Results(os.path.join(folder, "scene", "result.nc")), Results(os.path.join(folder, "without", "result.nc"))
    last, worst, forces = ours.steps - 1, 0.0, []
    apart = [b - a for a, b in zip(*(of.attributes.get("origin", [0.0] * 3) for of in (ours, theirs)))]  # places are measured from there
    for i, line in enumerate(mooring.lines):
        a, b = ours.get(f"l{i}_tension", last), theirs.get(f"l{i}_tension", theirs.steps - 1)
        first = round(line.left[0] / line.element)
        forces += [(x, y) for x, y in zip(a[first:first + len(b)], b)]
        x, y = ours.get(f"l{i}_position", last), theirs.get(f"l{i}_position", theirs.steps - 1)
        worst = max([worst] + [abs(p - q - apart[k % 3]) / mooring.size for k, (p, q) in enumerate(zip(x[3 * first:3 * first + len(y)], y))])
    most = max(y for _, y in forces)
    return max([worst] + [abs(x - y) / most for x, y in forces])


def one_class(given, kind):
    tally, worst = checked.Tally(kind), 0.0
    for seed in checked.seeds(given, kind):
        folder = checked.folder_of(given, kind, seed)
        mooring = Mooring(random.Random(f"{kind} {seed}"), kind)
        code, found, words = checked.solve_named(given, mooring.text(), folder, "scene", (0, 1))
        tally.add(seed, code, found, words)
        if kind == "whole" and code == 0:
            other, alone, words = checked.solve_named(given, mooring.text(False), folder, "without", (0, 1))
            apart = difference(mooring, folder) if other == 0 else math.inf
            worst = max(worst, apart)
            if not apart <= EQUAL:
                print(f"{kind} {seed}: {apart:.1e} from the mooring without winches, {alone} {words}")
    tally.told(given, f", at most {worst:.1e} from those without winches" if kind == "whole" else "")
    return tally.is_good(CERTIFIED) and worst <= EQUAL


if __name__ == "__main__":
    checked.main(CLASSES, one_class, 20)
