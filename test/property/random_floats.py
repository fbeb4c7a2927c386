#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random buoys that float in time, in water at rest and in waves, whose steps the independent checker derives anew.

usage: random_floats.py CAPSTAN CHECKER [--count N] [--seed S] [--only CLASS] [--keep FOLDER]

Of each class N scenes of one buoy to three on lines from anchors, in a row: `still`, in water at rest; `wave`, in waves of one component to three.
A buoy begins above the water, in it or at its surface, is let go, and is then pulled about, lifted out and pulled under by forces and by its
anchors, which may let go of it. They differ in size, place, mass, volume (some sink), height (none, small, larger than what moves them), inertia
(of the mass, more, none at the ends of lines with inertia), in the make of the lines, with inertia or without, scheme and length of the steps. Of each class at least 995 of 1000
records must be certified and none refuted, and the remainder of each ledger of lines with inertia is below 1e-10 of its turnover.
"""
import csv
import math
import os
import random
import sys

sys.dont_write_bytecode = True  # nothing is left in the source folder
import checked  # noqa: E402
from random_in_time import REMAINDER, remainder  # noqa: E402
from random_swims import some, vector  # noqa: E402

CERTIFIED, G, WATER = 0.995, 9.81, 1025.0
CLASSES = ["still", "wave"]
STATES = ["submerged", "floating", "above"]


class Scene:
    """The text of a scene about `size` metres deep."""

    def __init__(self, dice, kind):
        self.dice, self.kind = dice, kind
        self.size = 10 ** dice.uniform(-0.5, 2)
        self.time = math.sqrt(self.size / G)
        self.buoys = dice.choice([1, 1, 2, 3])
        self.level = dice.choice([0.0, dice.uniform(-3, 3) * self.size])
        self.origin = [dice.choice([0, 0, 3e3, -1e4]) * self.size for _ in range(2)] + [self.level]
        self.mass = 10 ** dice.uniform(-2, 1) * self.size ** 2  # of lines, kg/m
        self.euler = dice.random() < 0.25

    def at(self, x):
        """A place, in sizes, from a place at the surface at rest."""
        return vector([o + self.size * a for o, a in zip(self.origin, x)])

    def by(self, x):
        return vector([self.size * a for a in x])

    def waves(self):
        dice, components = self.dice, []
        if self.kind != "wave":
            return ""
        depth = dice.choice([math.inf, self.size * dice.uniform(1, 3)])
        for _ in range(dice.choice([1, 1, 2, 3])):
            period = self.time * 10 ** dice.uniform(0, 1)
            k = (2 * math.pi / period) ** 2 / G
            for _ in range(60):
                k = 0.5 * (k + (2 * math.pi / period) ** 2 / G / math.tanh(min(k * depth, 300)))
            breaks = 0.142 * math.pi / k * math.tanh(min(k * depth, 300))
            amplitude = min(breaks * 10 ** dice.uniform(-2, -0.1), 0.3 * self.size)
            components.append(f"{{amplitude: {amplitude!r}, period: {period!r}, direction: {dice.uniform(-180, 360)!r}, phase: {dice.uniform(-360, 360)!r}}}")
        ramp = dice.choice(["", f", ramp: {self.time * dice.uniform(0, 3)!r}"])
        return f"waves: {{depth: {'.inf' if math.isinf(depth) else repr(depth)}{ramp}, components: [{', '.join(components)}]}}\n"

    def buoy(self, i, x):
        """A buoy that is held where it is to be let go."""
        dice = self.dice
        heavy = self.mass * self.size * 10 ** dice.uniform(-0.5, 1)
        volume = heavy / WATER * 10 ** dice.uniform(-0.1, 1)
        height = dice.choice(["", "", f", height: {self.size * 10 ** dice.uniform(-3, 0)!r}"])
        # without a mass of their own or of lines that end there, buoys would jump from place to place
        inertia = dice.choice(["", "", f", inertia: {heavy * dice.uniform(1, 3)!r}", "" if self.quasi else ", inertia: 0"])
        return f"  b{i}: {{held: {self.at(x)}, mass: {heavy!r}, volume: {volume!r}{height}{inertia}}}\n", heavy

    def make(self):
        dice, weight = self.dice, self.mass * G * self.size
        quasi = ", quasi_static: true" if self.quasi else ""
        stiffness = weight * 10 ** dice.uniform(1, 3.5)
        damping = f", damping: {stiffness * self.time * 10 ** dice.uniform(-4, -1)!r}" if not quasi and dice.random() < 0.3 else ""
        return f"elements: {dice.randint(2, 12)}, mass: {self.mass!r}, stiffness: {stiffness!r}{damping}{quasi}"

    def entry(self, name, length, change):
        steps, paced = max(2, int(length * 10 ** self.dice.uniform(1, 2))), self.dice.random() < 0.2
        step = f"time_step: {length * self.time / steps!r}, error: {self.size * 10 ** self.dice.uniform(-4.5, -2.5)!r}" if paced else f"steps: {steps}"
        return f"  - {{name: {name}, {step}, duration: {length * self.time!r}{change}}}\n"

    def text(self):
        dice = self.dice
        self.quasi = dice.random() < 0.3
        out = (f"capstan: 1\ngravity: [0, 0, {-G}]\ntime_scheme: {'euler' if self.euler else 'bdf2'}\nwater_density: {WATER}\n"
               f"water_surface: {self.origin[2]!r}\n{self.waves()}")
        if dice.random() < 0.5:
            out += f"obstacles: {{bed: {{plane: {{point: {self.at([0, 0, -1])}}}, friction: {dice.choice([0, 0.5])}}}}}\n"
        places = [[0.6 * i, 0.0, dice.choice([0.0, dice.uniform(-0.5, 0.3)])] for i in range(self.buoys)]
        points, heavy = "", []
        for i, x in enumerate(places):
            said, mass = self.buoy(i, x)
            points, heavy = points + said, heavy + [mass]
        lines = ""
        for i, x in enumerate(places):
            foot = [x[0] + dice.uniform(-0.3, 0.3), dice.uniform(-0.3, 0.3), -1.0]
            points += f"  f{i}: {{held: {self.at(foot)}}}\n"
            length = math.dist(foot, x) * self.size * dice.choice([dice.uniform(0.97, 1), dice.uniform(1, 1.5)])
            lines += f"  l{i}: {{length: {length!r}, {self.make()}, start: static, ends: {{A: {{point: f{i}}}, B: {{point: b{i}}}}}}}\n"
        for i in range(self.buoys - 1):
            length = math.dist(places[i], places[i + 1]) * self.size * dice.uniform(1, 1.4)
            lines += f"  t{i}: {{length: {length!r}, {self.make()}, start: static, ends: {{A: {{point: b{i}}}, B: {{point: b{i + 1}}}}}}}\n"
        let_go = "".join(f", b{i}.point: {{force: [0, 0, 0]}}" for i in range(self.buoys))
        out += f"points:\n{points}lines:\n{lines}history:\n" + self.entry("let_go", 0.2, let_go)
        for k in range(dice.randint(1, 3)):
            i, period = dice.randrange(self.buoys), self.time * dice.uniform(0.5, 4)
            pull = [heavy[i] * G * a for a in some(dice, dice.choice([0.2, 3]))]
            change = dice.choice(["", f", b{i}.point: {{force: {vector(pull)}}}",
                                  f", b{i}.point: {{force: [0, 0, 0], sine: {vector(pull)}, period: {period!r}}}",
                                  f", f{i}.point: {{move: {self.by([0, 0, 0])}, sine: {self.by(some(dice, 0.1)[:2] + [0])}, period: {period!r}}}",
                                  f", f{i}.point: {{move: {self.by([0, 0, dice.uniform(0, 0.4)])}}}",
                                  "" if "inertia: 0" in points else f", l{i}.B: {{release: true}}"])
            out += self.entry(f"stage{k}", dice.uniform(0.5, 3), change)
        return out + ("  - {name: rest}\n" if dice.random() < 0.2 and "release" not in out else "")


def states_of(out):
    """How often buoys were in the water, at its surface and above it."""
    sums = dict.fromkeys(STATES, 0)
    with open(os.path.join(out, "points.csv"), encoding="ascii") as file:
        for row in csv.DictReader(file):
            if row["water"] in sums:
                sums[row["water"]] += 1
    return sums


def one_class(given, kind):
    steps = certified = refuted = proven = wrong = 0
    sums, worst = dict.fromkeys(STATES, 0), 0.0
    for seed in checked.seeds(given, kind):
        text = Scene(random.Random(f"float {kind} {seed}"), kind).text()
        scene, out, done = checked.solve(given, kind, seed, text, "--no-paraview")
        found, words, own = [0] * 5, done.stderr.strip(), 0.0
        if done.returncode in (0, 1, 5):
            found, words = checked.check(given.checker, out, scene)
            own = 0.0 if "quasi_static" in text or "rest" in text else remainder(out)
            for state, count in states_of(out).items():
                sums[state] += count
        worst = max(worst, own)
        steps, certified, refuted = steps + found[0], certified + found[1], refuted + found[3] + found[4]
        proven += done.returncode == 5
        wrong += done.returncode not in (0, 1, 5)
        if done.returncode not in (0, 5) or found[3] + found[4] or own > REMAINDER:
            print(f"{kind} {seed}: exit {done.returncode}, {found}, remainder {own:.2g} {words}")
    print(f"{kind}: {given.count} scenes from seed {given.seed}, {steps} records, {certified} certified, {refuted} refuted, {proven} refused with a "
          f"proof, {wrong} not run; " + ", ".join(f"{count} {state}" for state, count in sums.items()) + f"; remainder {worst:.2g}", flush=True)
    happens = all(count >= 2 * given.count for count in sums.values())
    return happens and steps > 0 and certified >= CERTIFIED * steps and refuted == 0 and wrong == 0 and worst <= REMAINDER


if __name__ == "__main__":
    checked.main(CLASSES, one_class, 10)
