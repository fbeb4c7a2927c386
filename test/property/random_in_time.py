#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random histories in time with landings, changes between rest and sliding, and snatches, which the independent checker counts.

usage: random_in_time.py CAPSTAN CHECKER [--count N] [--seed S] [--only CLASS] [--keep FOLDER]

Of each class N scenes: `drop`, a line thrown on ground; `clump`, a point on lines let go above it and pulled about; `body`, a body on lines
whose anchors move; `drum`, a line over a drum that turns and moves; `ground`, a line on ground that moves and turns; `belt`, clumps on lines on such ground, also thrown up; `wheel`, clumps or a body on lines
over a drum that turns, also more than once, and moves; `rider`, a clump on such a drum; `snatch`, a slack line
whose end swings until it is taut; `slide`, a line on ground whose end is pulled to and fro; `mud`, points on lines let go above ground
that gives and pulled about, beside a lump or none; `wave`, a line on a bed in waves. Of three in ten,
bodies and what ground carries excepted, the last entry is quasi-static, and brings all to rest where that is possible. They differ in
size, in the place and direction of all (gravity need not be along z), in slope, friction, stiffness, scheme and length of the steps. Of each
class at least 995 of 1000 records must be certified and none refuted, and the remainder of each ledger is below 1e-10 of its turnover, as the
file has it; of all classes together at least five of each event must be there for each scene.
"""
import csv
import math
import os
import random
import sys

sys.dont_write_bytecode = True  # nothing is left in the source folder
import checked  # noqa: E402
from random_swims import Swim, some, vector  # noqa: E402

CERTIFIED, REMAINDER, EACH = 0.995, 1e-10, 5
ROUNDING = 1e-15  # of an energy; a history in which hardly anything moves turns over 1e-8 of what is stored
CLASSES = ["drop", "clump", "body", "drum", "ground", "belt", "wheel", "rider", "snatch", "slide", "mud", "wave"]
EVENTS = ["landed", "changed", "snatched"]
TOTAL = dict.fromkeys(EVENTS + ["scenes"], 0)


def turned(dice):
    """A rotation, none in half of all scenes."""
    q = [1.0, 0, 0, 0] if dice.random() < 0.5 else [dice.gauss(0, 1) for _ in range(4)]
    w, x, y, z = [a / math.hypot(*q) for a in q]
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]


def gap(a, b, middle):
    """Distance of a place from the segment from a to b."""
    way, off = [q - p for p, q in zip(a, b)], [m - p for p, m in zip(a, middle)]
    along = min(1, max(0, sum(p * q for p, q in zip(way, off)) / math.hypot(*way) ** 2))
    return math.dist(off, [along * p for p in way])


class Scene:
    """The text of a scene about `size` metres large; places and directions are in axes of its own, with gravity along -z."""

    def __init__(self, dice, kind):
        self.dice, self.kind = dice, kind
        self.size = 10 ** dice.uniform(-1, 2.5)
        self.mass = 10 ** dice.uniform(-2, 2)  # kg/m
        self.weight = self.mass * 9.81 * self.size
        self.time = math.sqrt(self.size / 9.81)
        self.rotation = turned(dice)
        # places keep their digits beyond 512 lengths, and lose up to three before, which the residuals of points show
        near, far = 1e-3 if kind in ("clump", "body", "belt", "wheel", "rider", "mud") else dice.random(), dice.uniform(600, 1e4)
        self.origin = [dice.choice([0, 0, 300 * near, far, -far]) * self.size for _ in range(3)]
        self.slope = [dice.choice([0, 0, dice.uniform(-0.4, 0.4)]), dice.choice([0, dice.uniform(-0.2, 0.2)]), 1.0]

    def along(self, x):
        return vector([sum(row[k] * x[k] for k in range(3)) for row in self.rotation])

    def at(self, x):
        """A place, in sizes."""
        return vector([o + self.size * sum(row[k] * x[k] for k in range(3)) for o, row in zip(self.origin, self.rotation)])

    def by(self, x):
        """A displacement, in sizes."""
        return self.along([self.size * a for a in x])

    def low(self, x, y):
        """Height of the bed through the origin."""
        return -(self.slope[0] * x + self.slope[1] * y)

    def friction(self):
        return self.dice.choice(["0", "1", repr(self.dice.uniform(0, 1))])

    def bed(self, height=0.0):
        return f"  bed: {{plane: {{point: {self.at([0, 0, height])}, normal: {self.along(self.slope)}}}, friction: {self.friction()}}}\n"

    def make(self, elastic=False, elements=(2, 40), clump=None):
        """What a line is made of; a clump, by its mass and the length of the line, is at the last node between the ends."""
        dice, count = self.dice, self.dice.randint(*elements)
        stiff = not elastic and dice.random() < 0.25
        stiffness = self.weight * 10 ** dice.uniform(1.5, 4.5)
        damping = "" if stiff or dice.random() < 0.7 else f", damping: {stiffness * self.time * 10 ** dice.uniform(-4, -1)!r}"
        weights = f", point_weights: [{{at: {clump[1] * (count - 1) / count!r}, mass: {clump[0]!r}}}]" if clump else ""
        return f"elements: {count}, mass: {self.mass!r}, stiffness: {'.inf' if stiff else repr(stiffness)}{damping}{weights}"

    def entry(self, name, length, change, steps=None):
        """An entry of `length` times, in steps of a tenth to a two hundredth of one, or by an error."""
        steps, paced = steps or max(2, int(length * 10 ** self.dice.uniform(1, 2.3))), self.dice.random() < 0.25
        step = f"time_step: {length * self.time / steps!r}, error: {self.size * 10 ** self.dice.uniform(-4.5, -2.5)!r}" if paced else f"steps: {steps}"
        return f"  - {{name: {name}, {step}, duration: {length * self.time!r}{change}}}\n"

    def head(self):
        return f"capstan: 1\ngravity: {self.along([0, 0, -9.81])}\ntime_scheme: {self.dice.choice(['bdf2', 'bdf2', 'euler'])}\n"

    def text(self):
        return getattr(self, self.kind)() if self.kind in ("wave", "moored") else self.head() + getattr(self, self.kind)()

    # ---- the classes ----

    def drop(self):
        dice = self.dice
        a = [dice.uniform(-0.2, 0.2) for _ in range(2)]
        way = [dice.gauss(0, 1), dice.gauss(0, 1), dice.gauss(0, 0.3)]
        b = [p + q / math.hypot(*way) for p, q in zip(a, way)]
        drop = dice.uniform(0.01, 0.5)
        lift = max(self.low(*a) - 0.0, self.low(*b[:2]) - way[2] / math.hypot(*way)) + drop
        a.append(lift)
        b.append(lift + way[2] / math.hypot(*way))
        out, elements = "obstacles:\n" + self.bed(), (2, 40)
        if dice.random() < 0.4:
            middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
            radius = dice.uniform(0.1, 0.2)  # of two elements at least, or the mesh is too coarse
            under = self.low(*middle) - dice.uniform(0.5, 1) * radius
            if gap(a, b, middle + [under]) < 1.01 * radius:  # it would start in the lump
                a[2], b[2] = a[2] + radius, b[2] + radius
            shape = f"sphere: {{centre: {self.at(middle + [under])}" if dice.random() < 0.5 else f"cylinder: {{point: {self.at(middle + [under])}, axis: {self.along([-way[1], way[0], 0])}"
            elements = (20, 40)
            out += f"  lump: {{{shape}, radius: {self.size * radius!r}}}, friction: {self.friction()}}}\n"
        held = dice.random() < 0.3
        # a velocity for all nodes would tear an inextensible line off a held end
        speed = [0.0, 0, 0] if held else [dice.uniform(-1, 1) * self.size / self.time * dice.choice([0, 0.5]) for _ in range(3)]
        ends = f"A: {'held' if held else '{force: [0, 0, 0]}'}, B: {{force: [0, 0, 0]}}"
        length = math.dist(a, b) * self.size
        out += (f"lines:\n  rope: {{length: {length!r}, {self.make(False, elements)}, velocity: {self.along(speed)}, "
                f"start: {{straight: {{from: {self.at(a)}, to: {self.at(b)}}}}}, ends: {{{ends}}}}}\n")
        return out + "history:\n" + self.entry("fall", dice.uniform(0.5, 3), "")

    def clump(self):
        dice, count = self.dice, self.dice.randint(1, 3)
        out = "obstacles:\n" + self.bed()
        heavy = self.mass * self.size * 10 ** dice.uniform(-1, 1)
        middle = [0.0, 0, dice.uniform(0.1, 0.4)]
        out += f"points: {{clump: {{held: {self.at(middle)}, mass: {heavy!r}}}}}\nlines:\n"
        for i in range(count):
            angle = 2 * math.pi * (i + dice.uniform(-0.2, 0.2)) / count
            far = [0.6 * math.cos(angle), 0.6 * math.sin(angle)]
            far.append(self.low(*far) + dice.uniform(0, 0.6))
            out += (f"  l{i}: {{length: {self.size * math.dist(far, middle) * dice.uniform(1.02, 1.5)!r}, {self.make(True, (2, 20))}, start: static, "
                    f"ends: {{A: {{held: {self.at(far)}}}, B: {{point: clump}}}}}}\n")
        out += "history:\n" + self.entry("let go", 0.1, ", clump.point: {force: [0, 0, 0]}", dice.randint(1, 5)) + self.entry("fall", dice.uniform(0.5, 2), "")
        sway = f", l0.A: {{move: {self.by([0, 0, 0])}, sine: {self.by([0.15 * math.cos(1.0), 0.15 * math.sin(1.0), 0])}, period: {self.time * dice.uniform(1, 5)!r}}}"
        return out + self.entry("pull", dice.uniform(1, 3), sway if abs(self.slope[0]) + abs(self.slope[1]) == 0 else "")

    def body(self):
        dice, count = self.dice, self.dice.randint(2, 3)
        heavy = self.mass * self.size * 10 ** dice.uniform(-0.5, 1)
        bed = dice.random() < 0.5
        out = "obstacles:\n" + self.bed(-0.8) if bed else ""
        inertia = vector([heavy * (0.1 * self.size) ** 2 * dice.uniform(0.5, 2)] * 3)
        lifts = dice.random() < 0.5
        lift = f", buoyancy: {heavy * 9.81 * 2 + count * self.weight!r}" if lifts else ""
        out += f"bodies: {{hull: {{free: {self.at([0, 0, 0])}, mass: {heavy!r}, moments_of_inertia: {inertia}{lift}}}}}\npoints:\n"
        out += "".join(f"  p{i}: {{body: hull, at: {self.by(some(dice, 0.1))}}}\n" for i in range(count)) + "lines:\n"
        quasi = dice.choice(["", "", ", quasi_static: true"])
        for i in range(count):
            angle = 2 * math.pi * (i + dice.uniform(-0.2, 0.2)) / count
            far = [0.6 * math.cos(angle), 0.6 * math.sin(angle), (-1 if lifts else 1) * dice.uniform(0.4, 0.6)]
            made = self.make(True, (2, 20))
            out += (f"  l{i}: {{length: {self.size * math.hypot(*far) * dice.uniform(1.0, 1.3)!r}, {made}{quasi}, start: static, "
                    f"ends: {{A: {{held: {self.at(far)}}}, B: {{point: p{i}}}}}}}\n")
        out += "history:\n"
        for k in range(2):
            pull = [heavy * 9.81 * a for a in some(dice, 0.5)]
            period = self.time * dice.uniform(0.5, 4)
            change = dice.choice([f", hull.body: {{force: {vector(pull)}, oscillations: [{{sine: {vector(some(dice, heavy * 9.81))}, period: {period!r}}}]}}",
                                  f", l0.A: {{move: {self.by(some(dice, 0.05))}, sine: {self.by(some(dice, 0.1))}, period: {period!r}}}"])
            out += self.entry(f"stage{k}", dice.uniform(1, 3), change)
        return out

    def drum(self):
        """Over a drum, from a held end to one that hangs with a weight, or between two that hang."""
        dice, radius = self.dice, self.dice.uniform(0.1, 0.2)
        axis = [dice.choice([0, dice.uniform(-0.2, 0.2)]), 1.0, 0.0]
        shape = dice.choice(["cylinder", "cylinder", "capsule", "sphere"])
        middle = [0.0, 0, 0]
        if shape == "cylinder":
            on = f"cylinder: {{point: {self.at(middle)}, axis: {self.along(axis)}, radius: {self.size * radius!r}}}"
        elif shape == "capsule":
            on = f"capsule: {{centre: {self.at(middle)}, axis: {self.along(axis)}, length: {self.size!r}, radius: {self.size * radius!r}}}"
        else:
            on = f"sphere: {{centre: {self.at(middle)}, axis: {self.along(axis)}, radius: {self.size * radius!r}}}"
        out = f"obstacles:\n  drum: {{{on}, friction: {self.friction()}}}\n"
        if dice.random() < 0.5:
            out += self.bed(-dice.uniform(0.3, 0.6))
        held = [-0.4, 0.0, dice.uniform(-0.1, 0.1)]
        hung = [0.35, dice.choice([0, 0.02]), dice.uniform(0, 0.15)]
        length = dice.uniform(0.95, 1.2)
        heavy = self.mass * self.size * 10 ** dice.uniform(-2, 0.5)
        clump = (heavy, length * self.size) if dice.random() < 0.6 else None
        out += (f"lines:\n  rope: {{length: {length * self.size!r}, {self.make(False, (24, 50), clump)}, start: static, "
                f"ends: {{A: {{held: {self.at(held)}}}, B: {{held: {self.at(hung)}}}}}}}\n")
        out += "history:\n" + self.entry("let go", dice.uniform(1, 2), ", rope.B: {release: true}")
        for k in range(dice.randint(1, 3)):
            turn = f", drum.turn: {dice.uniform(-90, 90)!r}" if dice.random() < 0.7 else ""
            move = f", drum.obstacle: {{move: {self.by(some(dice, 0.1))}}}" if dice.random() < 0.5 else ""
            out += self.entry(f"stage{k}", dice.uniform(0.5, 2), turn + move)
        return out

    def lying(self):
        """A line straight down on the bed."""
        a, b = [0.0, 0.0, 0.0], [1.0, 0.2, self.low(1, 0.2)]
        length = math.dist([0, 0, 0], b) * self.size
        return (f"lines:\n  rope: {{length: {length!r}, {self.make()}, start: {{straight: {{from: {self.at(a)}, to: {self.at(b)}}}}}, "
                f"ends: {{A: {{force: [0, 0, 0]}}, B: {{force: [0, 0, 0]}}}}}}\n")

    def ground(self):
        dice = self.dice
        out = "obstacles:\n" + self.bed() + self.lying() + "history:\n"
        for k in range(dice.randint(2, 4)):
            move, turn = "", ""
            if dice.random() < 0.7:
                move = f"move: {self.by(some(dice, 0.3))}"
            if dice.random() < 0.5 or not move:
                turn = f"turn: {dice.uniform(-40, 40)!r}, axis: {self.along(some(dice, 1)) if dice.random() < 0.5 else self.along(self.slope)}, about: {self.at(some(dice, 0.5))}"
            change = f", bed.obstacle: {{{', '.join(p for p in (move, turn) if p)}}}" if dice.random() < 0.8 else ""
            out += self.entry(f"stage{k}", dice.uniform(0.5, 2), change)
        return out

    def belt(self):
        """Clumps, joined by lines and thrown up or not, on ground that moves and turns, to and fro."""
        dice, count = self.dice, self.dice.randint(1, 3)
        places = [[0.5 * i + dice.uniform(-0.1, 0.1), dice.uniform(-0.2, 0.2)] for i in range(count)]
        above = dice.choice([0.0, 0.0, dice.uniform(0.01, 0.2)])
        for x in places:
            x.append(self.low(*x) + above)
        anchor = [-0.6, dice.uniform(-0.2, 0.2), 1.0]
        throw = [dice.uniform(-0.5, 0.5), dice.uniform(-0.5, 0.5), dice.uniform(0, 0.7)] if dice.random() < 0.4 else [0.0] * 3
        velocity = self.along([a * self.size / self.time for a in throw])
        out = "obstacles:\n" + self.bed() + "points:\n"
        for i, x in enumerate(places):
            out += f"  c{i}: {{free: {self.at(x)}, mass: {self.mass * self.size * 10 ** dice.uniform(-1, 1)!r}, velocity: {velocity}}}\n"
        out += "lines:\n"
        ties = [(places[i], places[i + 1], f"A: {{point: c{i}}}, B: {{point: c{i + 1}}}") for i in range(count - 1)]
        if count == 1 or dice.random() < 0.4:
            ties.append((anchor, places[0], "A: held, B: {point: c0}"))
        for i, (a, b, ends) in enumerate(ties):
            quasi, strain = dice.choice(["", "", "", ", quasi_static: true"]), 10 ** dice.uniform(-4, -2.5)
            out += (f"  l{i}: {{length: {self.size * math.dist(a, b) * (1 - strain)!r}, {self.make(True, (2, 20))}{quasi}, start: {{straight: {{from: {self.at(a)}, to: {self.at(b)}}}}}, "
                    f"ends: {{{ends}}}}}\n")
        out += "history:\n"
        for k in range(dice.randint(2, 4)):
            move = f"move: {self.by([a * b for a, b in zip(some(dice, 1), (0.4, 0.4, 0.15))])}" if dice.random() < 0.7 else ""
            turn = f"turn: {dice.uniform(-200, 200)!r}, axis: {self.along(self.slope)}, about: {self.at(some(dice, 0.5))}" if dice.random() < 0.5 or not move else ""
            if turn and dice.random() < 0.4:
                turn = f"turn: {dice.uniform(-15, 15)!r}, axis: {self.along(some(dice, 1))}, about: {self.at([0, 0, self.low(0, 0)])}"
            change = f", bed.obstacle: {{{', '.join(p for p in (move, turn) if p)}}}" if dice.random() < 0.8 else ""
            out += self.entry(f"stage{k}", dice.uniform(0.5, 2), change)
        return out

    def wheel(self):
        """Clumps or a body on lines over a drum that turns, some of them more than once, and moves. A body has no contact: it hangs below."""
        dice, radius, count, body = self.dice, self.dice.uniform(0.1, 0.2), self.dice.randint(1, 2), self.dice.random() < 0.5
        shape = dice.choice(["cylinder", "cylinder", "capsule", "sphere"]) if count == 1 else "cylinder"
        on = {"cylinder": f"cylinder: {{point: {self.at([0, 0, 0])}, axis: {self.along([0, 1, 0])}",
              "capsule": f"capsule: {{centre: {self.at([0, 0, 0])}, axis: {self.along([0, 1, 0])}, length: {self.size!r}",
              "sphere": f"sphere: {{centre: {self.at([0, 0, 0])}, axis: {self.along([0, 1, 0])}"}[shape]
        out = f"obstacles:\n  drum: {{{on}, radius: {self.size * radius!r}}}, friction: {self.friction()}}}\n"
        if dice.random() < 0.5 and not body:
            out += self.bed(-dice.uniform(0.7, 0.9))
        heavy = self.mass * self.size * 10 ** dice.uniform(-1, 1)
        hung = [radius, 0.0, -dice.uniform(0.35, 0.4)] if body else [0.35, 0.0, -dice.uniform(0, 0.2)]
        let_go, places = [], []
        if body:
            inertia = vector([heavy * (0.1 * self.size) ** 2 * dice.uniform(0.5, 2)] * 3)
            out += f"bodies: {{hull: {{held: {self.at(hung)}, mass: {heavy!r}, moments_of_inertia: {inertia}}}}}\n"
            let_go.append("hull.body: {force: [0, 0, 0]}")
        out += "points:\n"
        for i in range(count):
            y = 0.1 * (i - 0.5 * (count - 1))
            far, near = [-0.45, y, -dice.uniform(0, 0.2)], [hung[0] + dice.uniform(-0.03, 0.03), y, hung[2] + dice.uniform(0, 0.03)]
            out += (f"  p{i}: {{body: hull, at: {self.by([a - b for a, b in zip(near, hung)])}}}\n" if body else
                    f"  p{i}: {{held: {self.at(near)}, mass: {heavy * dice.uniform(0.5, 2)!r}}}\n")
            out += f"  q{i}: {{held: {self.at(far)}, mass: {heavy * dice.uniform(0.5, 2)!r}}}\n"
            away = math.hypot(far[0], far[2])  # round the drum, and down to what hangs
            round_it = radius * (math.atan2(-far[2], -far[0]) + math.pi - math.acos(radius / away))
            places.append(math.sqrt(away ** 2 - radius ** 2) + round_it - near[2])
            freed = not body and dice.random() < 0.6
            let_go += [] if body else [f"p{i}.point: {{force: [0, 0, 0]}}"]
            let_go += [f"q{i}.point: {{force: [0, 0, 0]}}"] if freed else []
            # one that falls with both ends is not quasi-static
            places[i] = (places[i], "" if freed else dice.choice(["", "", "", ", quasi_static: true"]))
        out += "lines:\n"
        for i, (length, quasi) in enumerate(places):
            slack = dice.uniform(1, 1.03) if body else dice.uniform(1.02, 1.3)
            out += (f"  l{i}: {{length: {self.size * length * slack!r}, {self.make(True, (24, 50))}{quasi}, start: static, "
                    f"ends: {{A: {{point: q{i}}}, B: {{point: p{i}}}}}}}\n")
        out += "history:\n" + self.entry("let go", dice.uniform(0.1, 0.5), ", " + ", ".join(let_go))
        for k in range(dice.randint(1, 3)):
            angle = dice.uniform(-15 if body else -90, 90) * dice.choice([1, 1, 1, 8])
            turn = f", drum.turn: {max(angle, -15.0) if body else angle!r}" if dice.random() < 0.7 else ""
            move = f", drum.obstacle: {{move: {self.by(some(dice, 0.1))}}}" if dice.random() < 0.5 else ""
            out += self.entry(f"stage{k}", dice.uniform(0.5, 2), turn + move, dice.randint(math.ceil(abs(angle) / 45) + 8, 200))
        return out

    def rider(self):
        """A clump on a drum that turns, some of them more than once, and moves, on one or two lines."""
        dice, radius, count = self.dice, self.dice.uniform(0.1, 0.3), self.dice.randint(1, 2)
        shape = dice.choice(["cylinder", "cylinder", "capsule", "sphere"])
        begin = "centre" if shape != "cylinder" else "point"
        length = f", length: {self.size!r}" if shape == "capsule" else ""
        out = (f"obstacles:\n  drum: {{{shape}: {{{begin}: {self.at([0, 0, 0])}, axis: {self.along([0, 1, 0])}{length}, "
               f"radius: {self.size * radius!r}}}, friction: {self.friction()}}}\n")
        if dice.random() < 0.3:
            out += self.bed(-dice.uniform(0.5, 0.6))
        top = [dice.uniform(-0.5, 0.5) * radius, dice.uniform(-0.3, 0.3) * radius]
        top.append(math.sqrt(radius ** 2 - top[0] ** 2 - (top[1] ** 2 if shape == "sphere" else 0)) * dice.choice([1.0 + 1e-9, 1.02, 1.3]))
        heavy = self.mass * self.size * 10 ** dice.uniform(-1, 1)
        out += f"points: {{clump: {{held: {self.at(top)}, mass: {heavy!r}}}}}\nlines:\n"
        for i in range(count):
            far = [(0.6, -0.6)[i] + dice.uniform(-0.1, 0.1), dice.uniform(-0.2, 0.2), dice.uniform(0.1, 0.6)]
            quasi = dice.choice(["", "", "", ", quasi_static: true"])
            out += (f"  l{i}: {{length: {self.size * math.dist(far, top) * dice.uniform(1.02, 1.5)!r}, {self.make(True, (8, 30))}{quasi}, start: static, "
                    f"ends: {{A: {{held: {self.at(far)}}}, B: {{point: clump}}}}}}\n")
        out += "history:\n" + self.entry("let go", dice.uniform(0.1, 0.5), ", clump.point: {force: [0, 0, 0]}")
        for k in range(dice.randint(1, 3)):
            angle = dice.uniform(-90, 90) * dice.choice([1, 1, 1, 8])
            turn = f", drum.turn: {angle!r}" if dice.random() < 0.7 else ""
            move = f", drum.obstacle: {{move: {self.by(some(dice, 0.1))}}}" if dice.random() < 0.5 else ""
            out += self.entry(f"stage{k}", dice.uniform(0.5, 2), turn + move, dice.randint(math.ceil(abs(angle) / 45) + 8, 200))
        return out

    def slide(self):
        dice = self.dice
        out = "obstacles:\n" + self.bed() + self.lying()
        out += "history:\n"
        held = dice.random() < 0.5
        for k in range(dice.randint(1, 3)):
            size, period = 10 ** dice.uniform(-2, -0.5), self.time * 10 ** dice.uniform(-0.3, 0.7)
            x, y = some(dice, size)[:2]
            flat = [x, y, self.low(x, y) + dice.choice([0, 0.01])]
            if held:
                way = f"position: {self.at([1.0, 0.2, self.low(1, 0.2)])}" if k == 0 else "move: [0, 0, 0]"
                way, lift = (way, [flat[0], flat[1], self.low(x, y)])
                change = f", rope.B: {{{way}, sine: {self.by(lift)}, period: {period!r}}}"
            else:
                pull = [self.weight * a for a in some(dice, 1)]
                change = f", rope.B: {{force: {vector(pull) if dice.random() < 0.3 else '[0, 0, 0]'}, sine: {vector([self.weight * a for a in some(dice, 2)])}, period: {period!r}}}"
            out += self.entry(f"stage{k}", dice.uniform(0.5, 3), change)
        return out

    def snatch(self):
        """A slack line whose end swings beyond its length, or a weight on one that is thrown up."""
        dice = self.dice
        out = "obstacles:\n" + self.bed(-0.7) if dice.random() < 0.5 else ""
        span = dice.uniform(0.5, 0.9)
        if dice.random() < 0.5:
            out += (f"lines:\n  rope: {{length: {self.size!r}, {self.make(True)}, start: static, "
                    f"ends: {{A: {{held: {self.at([0, 0, 0])}}}, B: {{held: {self.at([span, 0, 0])}}}}}}}\nhistory:\n")
            reach = (1.0 - span) * dice.uniform(0.9, 1.0) + dice.uniform(0, 0.01)
            period = self.time * dice.uniform(1, 5)
            return out + self.entry("swing", dice.uniform(2, 5), f", rope.B: {{move: [0, 0, 0], sine: {self.by([reach, 0.1 * reach, 0.1 * reach])}, period: {period!r}}}")
        heavy = self.mass * self.size * 10 ** dice.uniform(-1, 1)
        speed = [a * self.size / self.time for a in (dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(0, 2))]
        down = [dice.uniform(-0.3, 0.3), 0.0, -0.6]
        length = math.hypot(*down) * self.size
        out += (f"lines:\n  rope: {{length: {length!r}, {self.make(clump=(heavy, length))}, "
                f"velocity: {self.along(speed)}, start: {{straight: {{from: {self.at([0, 0, 0])}, to: {self.at(down)}}}}}, "
                f"ends: {{A: held, B: {{force: [0, 0, 0]}}}}}}\n")
        return out + "history:\n" + self.entry("throw", dice.uniform(2, 5), "")

    def soft(self, height=0.0):
        """A bed in which a line that lies sinks by 1e-4 to 0.03 of its size, damped or not, its pressure over depth, and the lines' width."""
        dice, width = self.dice, self.size * 10 ** self.dice.uniform(-3, -1)
        pressure = self.mass * 9.81 / (width * self.size * 10 ** dice.uniform(-4, -1.5))
        damping = f", damping: {pressure * self.time * 10 ** dice.uniform(-3, 0)!r}" if dice.random() < 0.6 else ""
        return f"{self.bed(height)[:-2]}, stiffness: {pressure!r}{damping}}}\n", pressure, width

    def lump(self, pressure):
        """Rigid or not, above the bed, so that nothing comes between both."""
        dice, radius = self.dice, self.dice.uniform(0.1, 0.2)  # of two elements at least, or the mesh is too coarse
        middle = [dice.uniform(-0.1, 0.1), dice.uniform(-0.1, 0.1), 0.0]
        middle[2] = 2 * radius + self.low(*middle[:2])
        shape = dice.choice([f"sphere: {{centre: {self.at(middle)}", f"cylinder: {{point: {self.at(middle)}, axis: {self.along([0, 1, -self.slope[1]])}"])
        gives = dice.choice(["", f", stiffness: {pressure * 10 ** dice.uniform(0, 2)!r}"])
        return f"  lump: {{{shape}, radius: {self.size * radius!r}}}, friction: {self.friction()}{gives}}}\n", middle[2] + 1.2 * radius

    def mud(self):
        dice, count, knots = self.dice, self.dice.randint(1, 3), self.dice.choice([1, 1, 2])
        self.slope[0] *= dice.choice([1, 2])
        bed, pressure, width = self.soft()
        out, above, elements = "obstacles:\n" + bed, 0.0, (2, 20)
        if dice.random() < 0.3:
            lump, above = self.lump(pressure)
            out, elements = out + lump, (20, 30)
        middle, points = [], "points:\n"
        for k in range(knots):
            x = [0.3 * k, 0.0, 0.0]
            x[2] = max(above, self.low(*x[:2])) + 10 ** dice.uniform(-2, -0.4)
            heavy = self.mass * self.size * 10 ** dice.uniform(-1, 1)
            buoy = dice.random() < 0.15
            made = f"weight: {-0.3 * heavy * 9.81!r}, inertia: {heavy!r}" if buoy else f"mass: {heavy!r}"
            area = f", bearing_area: {heavy * 9.81 / (pressure * self.size * 10 ** dice.uniform(-4, -1.5))!r}" if dice.random() < 0.8 else ""
            points += f"  clump{k}: {{held: {self.at(x)}, {made}{area}}}\n"
            middle.append(x)
        quasi = dice.choice(["", "", "", ", quasi_static: true"])
        lines = "lines:\n"
        for i in range(count):
            angle, k = 2 * math.pi * (i + dice.uniform(-0.2, 0.2)) / count, i % knots
            far = [middle[k][0] + 0.6 * math.cos(angle), 0.6 * math.sin(angle)]
            far.append(self.low(*far) + dice.choice([-0.005, 0.0, dice.uniform(0, 0.6)]))
            lines += (f"  l{i}: {{length: {self.size * math.dist(far, middle[k]) * dice.uniform(1.02, 1.5)!r}, {self.make(True, elements)}, "
                      f"bearing_width: {width!r}{quasi}, start: static, ends: {{A: {{held: {self.at(far)}}}, B: {{point: clump{k}}}}}}}\n")
        if knots == 2:
            lines += (f"  between: {{length: {self.size * math.dist(*middle) * dice.uniform(1.02, 1.5)!r}, {self.make(True, (elements[0] // 2 + 1, 20))}, "
                      f"bearing_width: {width!r}{quasi}, start: static, ends: {{A: {{point: clump0}}, B: {{point: clump1}}}}}}\n")
        free = "".join(f", clump{k}.point: {{force: [0, 0, 0]}}" for k in range(knots))
        out += points + lines + "history:\n" + self.entry("let go", 0.1, free, dice.randint(1, 5)) + self.entry("fall", dice.uniform(0.5, 2), "")
        pull = [self.weight * dice.uniform(0, 2) * a for a in some(dice, 1)]
        out += self.entry("drag", dice.uniform(1, 3), f", clump0.point: {{force: {self.along(pull)}}}" if dice.random() < 0.6 else "")
        sway = f", l0.A: {{move: {self.by([0, 0, 0])}, sine: {self.by([0.1, 0.05, 0])}, period: {self.time * dice.uniform(1, 5)!r}}}"
        return out + self.entry("pull", dice.uniform(1, 3), sway if abs(self.slope[0]) + abs(self.slope[1]) == 0 else "")

    def moored(self):
        """A float with members in waves, on lines that lie on the bottom; sometimes with a clump on one of them (random_soft.py)."""
        dice = self.dice
        self.rotation = [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]]
        self.origin[2] = 0.0
        self.slope = [dice.choice([0, 0, 0.05]), 0.0, 1.0]
        depth, count, rho = 0.35, dice.randint(2, 4), 1025.0
        wide, deep = 0.06 * self.size, 0.1 * self.size
        displaced = rho * math.pi / 4 * wide * wide * deep
        self.mass = displaced / self.size * 10 ** dice.uniform(-2, -1)  # of the lines in water, which the float bears
        self.weight = self.mass * 9.81 * self.size
        bed, pressure, width = self.soft(-depth)
        heavy = displaced - 0.5 * count * self.mass * self.size
        hydro = rho * 9.81 * math.pi / 4 * wide * wide
        period = self.time * 10 ** dice.uniform(0, 0.7)
        high = min(10 ** dice.uniform(-2.5, -1.3), 0.005 * (period / self.time) ** 2)  # below what breaks
        rows = [f"{{amplitude: {self.size * high!r}, period: {period * dice.uniform(0.8, 1.3)!r}, direction: {dice.uniform(0, 360)!r}, "
                f"phase: {dice.uniform(0, 360)!r}}}" for _ in range(dice.choice([1, 1, 3]))]
        out = (f"capstan: 1\ntime_scheme: {dice.choice(['bdf2', 'bdf2', 'euler'])}\nwater_density: {rho!r}\nwater_surface: {self.origin[2]!r}\n"
               f"waves: {{depth: {depth * self.size!r}, ramp: {period!r}, components: [{', '.join(rows)}]}}\nobstacles:\n{bed}")
        spin = vector([heavy * (0.3 * deep) ** 2] * 3)
        out += (f"bodies: {{hull: {{free: {self.at([0, 0, 0])}, mass: {heavy!r}, centre_of_gravity: [0, 0, {-0.7 * deep!r}], moments_of_inertia: {spin}, "
                f"buoyancy: {displaced * 9.81!r}, centre_of_buoyancy: [0, 0, {-0.5 * deep!r}], hydrostatics: {{z: {hydro!r}}}, members: "
                f"[{{from: [0, 0, {-deep!r}], to: [0, 0, {0.5 * deep!r}], diameter: {wide!r}, normal: 1, tangential: 0.1, added_normal: {dice.choice(['0', '0.8'])}}}]}}}}\n")
        points, lines, clump = "points:\n", "lines:\n", dice.random() < 0.4
        quasi = dice.choice(["", "", ", quasi_static: true"])
        made = lambda n: f"{self.make(True, n)}, bearing_width: {width!r}{quasi}" + ("" if quasi else f", drag: {{diameter: {0.01 * self.size!r}, normal: 1, tangential: 0.05, added_normal: {dice.choice(['0', '1'])}}}")  # noqa: E731
        for i in range(count):
            angle = 2 * math.pi * (i + dice.uniform(-0.2, 0.2)) / count
            way = [math.cos(angle), math.sin(angle)]
            eye = [0.5 * wide / self.size * a for a in way] + [-deep / self.size]
            points += f"  eye{i}: {{body: hull, at: {vector([self.size * a for a in eye])}}}\n"
            far = [dice.uniform(0.7, 1) * a for a in way]
            far.append(self.low(*far) - depth + dice.choice([0.0, -0.003]))
            length = math.dist(far, eye) * dice.uniform(1.02, 1.1)
            if clump and i == 0:
                knot = [f + dice.uniform(0.4, 0.6) * (e - f) for f, e in zip(far, eye)]
                knot[2] = self.low(*knot[:2]) - depth + dice.choice([0.0, 0.05])
                sinks = heavy * 10 ** dice.uniform(-2, -0.7)
                points += (f"  clump: {{free: {self.at(knot)}, mass: {sinks!r}, "
                           f"bearing_area: {sinks * 9.81 / (pressure * self.size * 10 ** dice.uniform(-4, -2))!r}}}\n")
                lines += (f"  lower: {{length: {self.size * math.dist(far, knot) * dice.uniform(1.01, 1.1)!r}, {made((6, 14))}, start: static, "
                          f"ends: {{A: {{held: {self.at(far)}}}, B: {{point: clump}}}}}}\n")
                far, length = None, math.dist(knot, eye) * dice.uniform(1.05, 1.2)
            ends = "point: clump" if far is None else f"held: {self.at(far)}"
            lines += (f"  l{i}: {{length: {self.size * length!r}, {made((8, 25))}, start: static, ends: {{A: {{{ends}}}, B: {{point: eye{i}}}}}}}\n")
        pull = [heavy * 9.81 * a for a in some(dice, 0.1)]
        steps = lambda: dice.randint(20, 200)  # noqa: E731
        return out + points + lines + "history:\n" + self.entry("sea", dice.uniform(2, 5), "", steps()) + self.entry(
            "wind", dice.uniform(1, 3), f", hull.body: {{force: {vector(pull)}}}", steps())

    def wave(self):
        while True:
            text = Swim(random.Random(self.dice.random()), random.Random(self.dice.random()), None, "bed").text()
            if "waves:" in text:
                return text


def rest(dice, kind):
    """What moves may come to rest at the end; a body not always finds where from far away, and what no anchor holds may have no such place."""
    return "  - {name: rest}\n" if kind not in ("body", "belt", "wheel", "rider", "moored") and dice.random() < 0.3 else ""


def remainder(out):
    """What the ledgers of the whole history leave over beyond rounding of the stored energies, as a share of what they have turned over."""
    left = over = 0.0
    with open(os.path.join(out, "history.csv"), encoding="ascii") as file:
        for row in csv.DictReader(file):
            if row["outcome"] in ("solved", "taut") and float(row["turnover"]) > 0:  # not the row of units, nor statics
                left += max(0.0, abs(float(row["imbalance"])) - ROUNDING * float(row["scale"]))
                over += float(row["turnover"])
    return left / over if over > 0 else 0.0


def one_class(given, kind):
    sums = dict.fromkeys(["steps", "certified", "refuted", "proven", "wrong"] + EVENTS, 0)
    worst = 0.0
    for seed in checked.seeds(given, kind):
        text = Scene(random.Random(f"in time {kind} {seed}"), kind).text() + rest(random.Random(f"rest {kind} {seed}"), kind)
        scene, out, done = checked.solve(given, kind, seed, text, "--no-paraview")
        found, words, events, own = [0] * 5, done.stderr.strip(), {}, 0.0
        if done.returncode in (0, 1, 5):
            told = checked.told_of(given.checker, out, scene)
            found, words = checked.counts_of(told)
            events = checked.events_of(told)
            own = 0.0 if "quasi_static" in text else remainder(out)
        worst = max(worst, own)
        sums["steps"] += found[0]
        sums["certified"] += found[1]
        sums["refuted"] += found[3] + found[4]
        sums["proven"] += done.returncode == 5
        sums["wrong"] += done.returncode not in (0, 1, 5)
        for name in EVENTS:
            sums[name] += events.get(name, 0)
        if done.returncode not in (0, 5) or found[3] + found[4] or own > REMAINDER:
            print(f"{kind} {seed}: exit {done.returncode}, {found}, remainder {own:.2g} {words}")
    print(f"{kind}: {given.count} scenes from seed {given.seed}, {sums['steps']} records, {sums['certified']} certified, {sums['refuted']} refuted, "
          f"{sums['proven']} refused with a proof, {sums['wrong']} not run; {sums['landed']} landings, {sums['changed']} changes between rest and "
          f"sliding, {sums['snatched']} snatches; remainder {worst:.2g}", flush=True)
    for name in EVENTS:
        TOTAL[name] += sums[name]
    TOTAL["scenes"] += given.count
    if kind == CLASSES[-1] and given.only is None:
        print("all classes: " + ", ".join(f"{count} {name}" for name, count in TOTAL.items()), flush=True)
        happens = all(TOTAL[name] >= EACH * TOTAL["scenes"] for name in EVENTS)
    else:
        happens = True
    return happens and (sums["steps"] > 0 and sums["certified"] >= CERTIFIED * sums["steps"] and sums["refuted"] == 0 and sums["wrong"] == 0
            and worst <= REMAINDER)


if __name__ == "__main__":
    checked.main(CLASSES, one_class, 10)
