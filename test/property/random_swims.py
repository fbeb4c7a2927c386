#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random lines that move in time in water that flows, with drag, water that is moved along and internal damping, two of
five in waves, each checked independently.

usage: random_swims.py CAPSTAN CHECKER [--count N] [--seed S] [--only CLASS] [--keep FOLDER]

Of each class N scenes: `free`, ropes with one end or both free in open water; `bed`, lines whose end oscillates, on a rough bed that they
touch and leave; `round`, the same with a pipe or ball beside; `joined`, lines between held ends and a free point or body, some of them
quasi-static and with springs. At least 995 of
1000 steps of each class must be certified, and the checker must refute none.
"""
import math
import random
import re
import sys

sys.dont_write_bytecode = True  # nothing is left in the source folder
import checked  # noqa: E402

CERTIFIED = 0.995  # share of the steps of a class
CLASSES = ["free", "bed", "round", "joined"]


def vector(x):
    return "[" + ", ".join(repr(float(a)) for a in x) + "]"


def some(dice, size):
    return [dice.uniform(-size, size) for _ in range(3)]


class Swim:
    """The text of a scene of lines about `size` metres long, in water that flows up to about as fast as they sink."""

    def __init__(self, dice, sea, calm, kind):
        self.dice, self.sea, self.calm, self.kind = dice, sea, calm, kind
        self.size = 10 ** dice.uniform(-0.5, 2.5)
        self.diameter = self.size * 10 ** dice.uniform(-4, -2)
        self.displaced = 1025 * math.pi / 4 * self.diameter ** 2
        self.mass = self.displaced * 10 ** dice.uniform(0.1, 1)  # kg/m, heavier than water
        # what nothing holds buckles as it falls along itself: its steps are shorter
        self.period = math.sqrt(self.size / 9.81) * 10 ** dice.uniform(-0.5, 0 if kind == "free" else 1)
        self.sinking = math.sqrt(2 * 9.81 * (self.mass - self.displaced) / (1025 * self.diameter))
        self.speed = 10 ** dice.uniform(-1.5, 0) * self.sinking
        self.origin = [0.0 if kind == "joined" else dice.choice([0, 0, 1e3, -1e4]) * self.size for _ in range(2)] + [0.0]
        self.bed = kind != "free" and (kind != "joined" or dice.random() < 0.5)
        self.low = -self.size * dice.uniform(0.05, 0.5)
        self.fewest = 2  # elements

    def water(self):
        rows, z = [], -self.size * self.dice.uniform(0.5, 2)
        for _ in range(self.dice.choice([1, 1, 2, 4])):
            rows.append(f"{{z: {z!r}, velocity: {vector(some(self.dice, self.speed * self.dice.choice([0, 1, 1])))}}}")
            z += self.size * self.dice.uniform(0.1, 1)
        return f"water_density: 1025\ncurrent: [{', '.join(rows)}]\n" if self.dice.random() < 0.8 else "water_density: 1025\n"

    def waves(self):
        """Waves up to nine tenths as high as those that break, in water that may be deep, whose surface may be below the line."""
        sea = self.sea
        if sea.random() > 0.4:
            return ""
        depth = sea.choice([math.inf, self.size * 10 ** sea.uniform(-0.5, 1)])
        components = []
        for _ in range(sea.choice([1, 1, 2, 5])):
            period = self.period * 10 ** sea.uniform(-0.3, 1)
            k = (2 * math.pi / period) ** 2 / 9.81
            for _ in range(60):
                k = 0.5 * (k + (2 * math.pi / period) ** 2 / 9.81 / math.tanh(min(k * depth, 300)))
            breaks = 0.142 * math.pi / k * math.tanh(min(k * depth, 300))
            amplitude = min(0.9 * breaks, self.sinking * 10 ** sea.uniform(-1.5, 0.3) * period / (2 * math.pi))
            components.append(f"{{amplitude: {amplitude!r}, period: {period!r}, direction: {sea.uniform(-180, 360)!r}, phase: {sea.uniform(-360, 360)!r}}}")
        ramp = sea.choice(["", f", ramp: {self.period * sea.uniform(0, 3)!r}"])
        return (f"water_surface: {self.size * sea.uniform(-0.2, 1.5)!r}\n"
                f"waves: {{depth: {'.inf' if math.isinf(depth) else repr(depth)}{ramp}, components: [{', '.join(components)}]}}\n")

    def make(self):
        """What a line is made of."""
        dice, weight = self.dice, (self.mass - self.displaced) * 9.81 * self.size
        stiffness = weight * 10 ** dice.uniform(1.5, 4.5)
        inextensible = self.kind != "joined" and dice.random() < 0.15
        added = dice.choice(["", f", added_normal: {dice.uniform(0, 1.5)!r}", f", added_normal: 1, added_tangential: {dice.uniform(0, 0.5)!r}"])
        along = dice.choice(["", f", tangential: {10 ** dice.uniform(-3, 0)!r}"])
        if dice.random() < 0.4 and not inextensible:
            loads = f", damping: {stiffness * self.period * 10 ** dice.uniform(-4, -1)!r}"
        else:
            loads = ""
        loads += dice.choice(["", "", f", loads: [{{force: {vector(some(dice, 0.2 * weight / self.size))}}}]"])
        return (f"elements: {max(self.fewest, dice.randint(2, 40))}, mass: {self.mass!r}, stiffness: {'.inf' if inextensible else repr(stiffness)}, "
                f"drag: {{diameter: {self.diameter!r}, normal: {10 ** dice.uniform(-0.5, 0.5)!r}{along}{added}}}{loads}")

    def make_calm(self, made):
        """One of three lines is quasi-static, without damping, half of those with springs."""
        if self.calm.random() > 1 / 3:
            return made
        made = re.sub(", damping: [^,]*", "", made) + ", quasi_static: true"
        if self.calm.random() < 0.5:
            return made
        soft = (self.mass - self.displaced) * 9.81 / self.size * 10 ** self.calm.uniform(-2, 0.5)
        place = self.at([0, 0, self.size * self.calm.uniform(-0.3, 0.3)])
        return made + f", springs: [{{stiffness: {vector([soft, soft, self.calm.choice([0, soft])])}, place: {place}}}]"

    def at(self, x):
        return vector([a + b for a, b in zip(x, self.origin)])

    def obstacles(self):
        dice, out = self.dice, ""
        if self.bed:
            out += f"  bed: {{plane: {{point: {self.at([0, 0, self.low])}}}, friction: {dice.choice([0, 0.3, 1])}}}\n"
        if self.kind == "round":
            middle = [self.size * dice.uniform(0.2, 0.6), 0, self.low * dice.uniform(0.5, 1.2)]
            shape = f"sphere: {{centre: {self.at(middle)}" if dice.random() < 0.4 else f"cylinder: {{point: {self.at(middle)}, axis: [0.2, 1, 0]"
            radius = self.size * dice.uniform(0.03, 0.15)
            self.fewest = math.ceil(1.4 * self.size / radius)  # an element is no longer than the radius, or the mesh is too coarse
            out += f"  thing: {{{shape}, radius: {radius!r}}}, friction: {dice.choice([0, 0.4])}}}\n"
        return "obstacles:\n" + out if out else ""

    def rope(self):
        """One line, and the changes of its end B."""
        dice = self.dice
        ends = dice.choice(["A: free, B: free", "A: {held: %s}, B: free"]) if self.kind == "free" else "A: {held: %s}, B: {held: %s}"
        if self.kind == "free":
            way = [dice.gauss(0, 1) for _ in range(3)]
            size = self.size / math.hypot(*way)
            a, b = [0.0, 0, 0], [size * x for x in way]
            length = math.dist(self.origin, [p + q for p, q in zip(b, self.origin)])
            start = f"start: {{straight: {{from: {self.at(a)}, to: {self.at(b)}}}}}"
        else:
            a, b = [0.0, 0, self.low], [self.size * dice.uniform(0.6, 0.9), 0.0, 0.0]
            length, start = math.dist(a, b) * dice.uniform(1.01, 1.4), "start: static"
        ends = ends.replace("%s", self.at(a), 1).replace("%s", self.at(b), 1).replace("free", "{force: [0, 0, 0]}")
        return f"lines:\n  rope: {{length: {length!r}, {self.make()}, {start}, ends: {{{ends}}}}}\n"

    def mooring(self):
        dice, count = self.dice, self.dice.randint(2, 3)
        body = dice.random() < 0.4
        weight = (self.mass - self.displaced) * self.size
        heavy = weight * dice.uniform(0.3, 3)
        if body:
            inertia = vector([heavy * (0.1 * self.size) ** 2 * dice.uniform(0.5, 2)] * 3)
            out = (f"bodies: {{hull: {{free: {self.at([0, 0, 0])}, mass: {heavy!r}, moments_of_inertia: {inertia}, "
                   f"buoyancy: {(heavy + count * weight) * 9.81!r}}}}}\npoints:\n")
            fairleads = [some(dice, 0.1 * self.size) for _ in range(count)]
            low = 0.9 * self.low if self.bed else -math.inf  # none begins in the bed
            out += "".join(f"  p{i}: {{body: hull, at: {vector([x, y, max(z, low)])}}}\n" for i, (x, y, z) in enumerate(fairleads))
        else:
            out = f"points: {{p: {{free: {self.at([0, 0, 0])}, mass: {heavy!r}}}}}\n"
        out += "lines:\n"
        for i in range(count):
            angle = 2 * math.pi * (i + dice.uniform(-0.2, 0.2)) / count
            far = self.size * dice.uniform(0.7, 1)
            anchor = [far * math.cos(angle), far * math.sin(angle), self.low if body else self.size * dice.uniform(0.1, 0.6)]
            out += (f"  l{i}: {{length: {math.hypot(*anchor) * dice.uniform(1.05, 1.3)!r}, {self.make() if i == 0 else self.make_calm(self.make())}, start: static, "
                    f"ends: {{A: {{held: {self.at(anchor)}}}, B: {{point: {f'p{i}' if body else 'p'}}}}}}}\n")
        return out

    def text(self):
        dice = self.dice
        name = "l0.A" if self.kind == "joined" else "rope.B" if self.kind != "free" else None
        out = "capstan: 1\n" + (f"time_scheme: {dice.choice(['bdf2', 'bdf2', 'euler'])}\n") + self.water() + self.waves() + self.obstacles()
        out += self.mooring() if self.kind == "joined" else self.rope()
        out += "history:\n"
        for k in range(dice.randint(1, 3)):
            steps = dice.randint(5, 30)
            h = self.period / dice.uniform(10, 60)
            change = ""
            if name and dice.random() < 0.8:
                sway, move = some(dice, self.size * dice.choice([0.005, 0.03])), some(dice, 0.02 * self.size * dice.choice([0, 1]))
                if self.kind == "joined":
                    sway[2] = move[2] = 0.0  # the anchor may be on the bed
                change = f", {name}: {{move: {vector(move)}, sine: {vector(sway)}, period: {self.period!r}}}"
            timed = k == 0 or self.kind == "free" or dice.random() < 0.9  # what nothing holds is never at rest
            out += f"  - {{name: stage{k}, steps: {steps}" + (f", duration: {steps * h!r}" if timed else "") + (change if timed else "") + "}\n"
        return out


def one_class(given, kind):
    steps = certified = refuted = proven = wrong = 0
    for seed in checked.seeds(given, kind):
        text = Swim(random.Random(f"{kind} {seed}"), random.Random(f"waves {kind} {seed}"), random.Random(f"calm {kind} {seed}"), kind).text()
        scene, out, done = checked.solve(given, kind, seed, text)
        found, words = checked.check(given.checker, out, scene) if done.returncode in (0, 1) else ([0] * 5, done.stderr.strip())
        steps, certified, refuted = steps + found[0], certified + found[1], refuted + found[3] + found[4]
        proven += done.returncode == 5
        wrong += done.returncode not in (0, 1, 5)
        if done.returncode not in (0, 5) or found[3] + found[4]:
            print(f"{kind} {seed}: exit {done.returncode}, {found} {words}")
    print(f"{kind}: {given.count} scenes from seed {given.seed}, {steps} steps, {certified} certified, {refuted} refuted, {proven} refused with a "
          f"proof, {wrong} not run", flush=True)
    return steps > 0 and certified >= CERTIFIED * steps and refuted == 0 and wrong == 0


if __name__ == "__main__":
    checked.main(CLASSES, one_class, 20)
