#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random lines that meet at free points in convex sets, each checked by the independent checker; and an end at such a point against one that
is in the set itself.

usage: random_held_points.py CAPSTAN CHECKER [--count N] [--seed S] [--only CLASS] [--keep FOLDER]

Of each class N scenes, from 1 cm to 1 km in size, at the origin or up to a thousand sizes from it: rails with ends and without, half-spaces, balls, discs,
boxes and sets given as expressions, from a thousandth of the size to as large as all lines; lines that are elastic or not, with and without
weight; points with and without weight and force, which changes as anchors move. `end`: one line, whose other end is held; the same line with
its end in the set and no point has the same places and forces, to 1e-7 of its size and largest force (4.5e-5 where it is rigid and straight). `net`: one to three points, on some of
which are sets, with lines between them and to anchors. `bed`: such a net above a rough plane or a ball on which its lines lie. At least 990 of
1000 steps must be certified, those refused with a proof counted apart, and the checker must refute none.
"""
import math
import os
import random
import sys

sys.dont_write_bytecode = True  # nothing is left in the source folder
import checked  # noqa: E402
from result_file import Results  # noqa: E402

CERTIFIED = 0.99  # nets of rigid weightless lines whose only taut ones end in sets are left with 3e-5 of the force
EQUAL = 1e-7  # as of other pairs of a point and a line in one piece
# of the force in a rigid line that is pulled exactly straight between points: it is that of a line longer by 1e-9, which may be off by the
# angle whose cosine is less than 1 by that
STRAIGHT = 2e-9 ** 0.5
CLASSES = ["end", "net", "bed"]


def add(a, b, by=1.0):
    return [x + by * y for x, y in zip(a, b)]


def some(dice, size):
    return [dice.uniform(-size, size) for _ in range(3)]


def some_set(dice, centre, size):
    """The text of a set near `centre`, and how far it reaches from there, None: without end."""
    small = size * 10 ** dice.uniform(-3, -0.3)
    kind = dice.choice(["rail", "rail", "half_space", "ball", "disc", "box", "hull", "cut"])
    axis = some(dice, 1)
    if kind == "rail" and dice.random() < 0.4:
        return f"rail: {{from: {centre!r}, along: {axis!r}}}", None
    if kind == "rail":
        return f"rail: {{from: {centre!r}, to: {add(centre, axis, small)!r}}}", 2 * small
    if kind == "half_space":
        return f"half_space: {{point: {centre!r}, normal: {axis!r}}}", None
    if kind == "ball":
        return f"ball: {{centre: {centre!r}, radius: {small!r}}}", small
    if kind == "disc":
        return f"disc: {{centre: {centre!r}, radius: {small!r}, normal: {axis!r}}}", small
    if kind == "box":
        sides = [small * dice.uniform(0.1, 1) for _ in range(3)]
        turn = f", rotation: {{roll_pitch_yaw: {some(dice, 180)!r}}}" if dice.random() < 0.6 else ""
        return f"box: {{centre: {centre!r}, size: {sides!r}{turn}}}", small
    if kind == "hull":
        corners = [add(centre, some(dice, small)) for _ in range(dice.randint(4, 7))]
        return f"set: {{polytope: {corners!r}}}", 2 * small
    ball = f"{{translate: {{by: {centre!r}, of: {{ball: {{radius: {small!r}, dimension: 3}}}}}}}}"
    plane = f"{{half_space: {{normal: {axis!r}, offset: {sum(x * y for x, y in zip(axis, centre)) + 0.1 * small!r}}}}}"
    return f"set: {{intersection: [{ball}, {plane}]}}", small


class Net:
    def __init__(self, dice, kind):
        self.kind, self.size = kind, 10 ** dice.uniform(-2, 3)
        size = self.size
        self.origin = some(dice, 1e3 * size) if dice.random() < 0.3 else [0.0, 0.0, 0.0]
        weight = dice.choice([0, 1, 1]) * 10 ** dice.uniform(-1, 3)  # [N/m]
        self.load = 10 ** dice.uniform(-0.5, 1.5) * (weight * size if weight else 10 ** dice.uniform(-1, 3))
        rigid = dice.random() < 0.3
        self.stiffness = ".inf" if rigid else repr(self.load * 10 ** dice.uniform(1, 5))
        self.weight = weight
        count = 1 if kind == "end" else dice.randint(1, 3)
        self.middle = [add(self.origin, [1.2 * size * k, 0.0, 0.0]) for k in range(count)]
        self.sets, self.reach = [], []
        for k in range(count):
            if kind != "end" and k > 0 and dice.random() < 0.4:
                self.sets.append(None)
                self.reach.append(0.3 * size)
                continue
            text, reach = some_set(dice, self.middle[k], size)
            self.sets.append(text)
            self.reach.append(0.5 * size if reach is None else reach)
        self.lines = []  # (from, to): an anchor or the index of a point
        for k in range(count):
            for _ in range(1 if kind == "end" else dice.randint(1, 3)):
                angle = dice.uniform(0, 2 * math.pi)
                far = size * dice.uniform(0.6, 1.5)
                self.lines.append([add(self.middle[k], [far * math.cos(angle), far * math.sin(angle), size * dice.uniform(-0.2, 0.5)]), k])
            if k > 0:
                self.lines.append([k - 1, k])
        self.lengths, self.elements = [], []
        for a, b in self.lines:
            apart = math.dist(self.middle[a] if isinstance(a, int) else a, self.middle[b])
            room = (self.reach[a] if isinstance(a, int) else 0) + self.reach[b]
            self.lengths.append((apart + room) * dice.uniform(1.02, 1.3) if rigid else (apart + room * dice.random()) * dice.uniform(0.9, 1.3))
            self.elements.append(dice.randint(4, 30))
        self.forces = [[some(dice, self.load) for _ in range(count)] for _ in range(3)]
        self.heavy = [dice.choice([0.0, 0.3 * self.load, -0.3 * self.load]) for _ in range(count)]
        self.moves = [add(self.lines[0][0], some(dice, 0.05 * size)) if dice.random() < 0.7 else None for _ in range(2)]
        self.bed = ""
        if kind == "bed":
            mu, down = dice.choice([0, dice.uniform(0, 1)]), 0.62 * size
            centre = self.middle[0][2]
            body = f"plane: {{point: [0, 0, {centre - down!r}]}}" if dice.random() < 0.6 else \
                f"sphere: {{centre: {add(self.middle[0], [0, 0, -down - 2 * size])!r}, radius: {2 * size!r}}}"
            self.bed = f"obstacles: {{bed: {{{body}, friction: {mu!r}}}}}\n"
            self.weight = self.weight or self.load / size
            # sets that reach no lower than the bed
            for k, text in enumerate(self.sets):
                if text and ("half_space: {point" in text or "along" in text):
                    self.sets[k] = f"ball: {{centre: {self.middle[k]!r}, radius: {0.2 * size!r}}}"
        self.order = list(range(len(self.lines)))
        dice.shuffle(self.order)

    def end(self, at, point, force):
        if not isinstance(at, int):
            return f"{{held: {at!r}}}"
        return f"{{point: p{at}}}" if point else f"{{on: {{{self.sets[at]}, force: {force!r}}}}}"

    def text(self, points=True):
        """The scene; without points its only end is in the set, and has the weight of the point as a force."""
        total = [add(f[0], [0, 0, -self.heavy[0]]) for f in self.forces]
        out = "capstan: 1\n" + self.bed
        if points:
            out += "points:\n"
            for k, (at, on) in enumerate(zip(self.middle, self.sets)):
                out += f"  p{k}: {{free: {at!r}, weight: {self.heavy[k]!r}, force: {self.forces[0][k]!r}{f', on: {{{on}}}' if on else ''}}}\n"
        out += "lines:\n"
        for i in self.order:
            a, b = self.lines[i]
            out += f"  l{i}: {{length: {self.lengths[i]!r}, elements: {self.elements[i]}, weight: {self.weight!r}, stiffness: {self.stiffness}, "
            out += f"start: static, ends: {{A: {self.end(a, points, total[0])}, B: {self.end(b, points, total[0])}}}}}\n"
        out += "history:\n"
        for n, (force, move) in enumerate(zip(self.forces[1:], self.moves)):
            keys = [f"name: stage{n}", "steps: 2"]
            keys += [f"p{k}.point: {{force: {f!r}}}" for k, f in enumerate(force)] if points else [f"l0.B: {{force: {total[n + 1]!r}}}"]
            keys += [f"l0.A: {{position: {move!r}}}"] if move else []
            out += f"  - {{{', '.join(keys)}}}\n"
        return out


def difference(net, folder):
    """The largest difference of places and tensions from the line that ends in the set itself, in all steps."""
    ours, theirs = (Results(os.path.join(folder, name, "result.nc")) for name in ("scene", "alone"))
    worst = 0.0
    apart = [b - a for a, b in zip(*(of.attributes.get("origin", [0.0] * 3) for of in (ours, theirs)))]
    for step in range(ours.steps):
        a, b = ours.get("l0_tension", step), theirs.get("l0_tension", step)
        most = max(max(b), 1e-3 * net.load)
        x, y = ours.get("l0_position", step), theirs.get("l0_position", step)
        if max(a) <= 1e-9 * net.load:  # a line without forces lies anywhere
            x, y = x[-3:], y[-3:]
        straight = net.stiffness == ".inf" and math.dist(x[:3], x[-3:]) > net.lengths[0] * (1 - 1e-9)
        most *= STRAIGHT / EQUAL if straight else 1
        worst = max([worst] + [abs(p - q) / most for p, q in zip(a, b)] +
                    [abs(p - q - apart[k % 3]) / net.size for k, (p, q) in enumerate(zip(x, y))])
    return worst


def one_class(given, kind):
    tally, compared, worst = checked.Tally(kind), 0, 0.0
    for seed in checked.seeds(given, kind):
        folder = checked.folder_of(given, kind, seed)
        net = Net(random.Random(f"{kind} {seed}"), kind)
        code, found, words = checked.solve_named(given, net.text(), folder, "scene")
        tally.add(seed, code, found, words)
        if kind == "end" and code == 0:
            other, alone, words = checked.solve_named(given, net.text(False), folder, "alone")
            if other == 1:
                continue  # the line alone has no certified answer: nothing to compare with
            apart = difference(net, folder) if other == 0 else math.inf
            compared += 1
            worst = max(worst, apart)
            if not apart <= EQUAL:
                print(f"{kind} {seed}: {apart:.1e} from the line that ends in the set, {alone} {words}")
    tally.told(given, f", {compared} compared, at most {worst:.1e} from the line that ends in the set" if kind == "end" else "")
    enough = kind != "end" or compared >= 0.9 * given.count
    return tally.is_good(CERTIFIED) and worst <= EQUAL and enough


if __name__ == "__main__":
    checked.main(CLASSES, one_class, 20)
