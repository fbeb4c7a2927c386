#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Buoys within a line that float: a line with floats has the places and tensions of the same line written as lines that meet at free points,
to 1e-9 of its size, and of the largest tension and EA, in random histories in which the upper end, or the body there,
is moved and nodes are grasped, up to a step in which either reports that places are not unique; the
checker finds nothing. What a line with floats cannot have is refused with its place.    usage: floats.py CAPSTAN CHECKER [--seeds N] [--first M]
"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "property"))
sys.dont_write_bytecode = True  # nothing is left in the source folder
from result_file import Results  # noqa: E402

CAPSTAN, CHECKER = (os.path.abspath(path) for path in sys.argv[1:3])
SEEDS, FIRST = (int(sys.argv[sys.argv.index(key) + 1]) if key in sys.argv else value for key, value in (("--seeds", 12), ("--first", 0)))
# All masses, volumes, gravity and the lengths of elements are numbers of few bits, so that their sums and products are exact, and both
# scenes have the same elements and weights. With others each scene rounds them in its own way: then two solutions are compared, which agree
# as closely as each balances, in stiff lines, and as the places of slack elements are known, to 1e-8 (property.random_joined).
SAME, BITS, GRAVITY = 1e-9, 20, 9.8125
LEAST = 0.8  # of the steps come before one in which either scene reports that its forces leave a choice of places: from there slack parts differ
SUBMERGED, FLOATING, ABOVE = 1, 2, 3


def few_bits(x):
    mantissa, exponent = math.frexp(x)
    return math.ldexp(round(mantissa*2**BITS), exponent - BITS)


class Mooring:
    """A random leg from the bed to the surface, as one line with floats and as lines that meet at points."""

    def __init__(self, seed):
        r = random.Random(seed)
        self.size = 10**r.uniform(0, 3)
        far = r.choice([0, 0, 1e4])*self.size
        self.origin = [far, -far, r.uniform(-1, 1)*self.size]
        self.level = self.origin[2]
        self.depth = r.uniform(0.2, 0.8)*self.size
        self.end = [r.uniform(0.75, 1.0)*self.size, 0, r.uniform(-0.1, 0.1)*self.depth]
        self.sections, self.straight = r.random() < 0.5, r.random() < 0.3
        self.length = length = math.dist(self.end, [0, 0, -self.depth])*(r.uniform(0.97, 1) if self.straight else r.uniform(1, 1.4))
        counts = [r.randint(4, 12), r.randint(4, 12)]
        shares = [r.uniform(0.3, 0.7)]
        shares.append(1 - shares[0])
        if not self.sections:
            shares, counts = [1], [sum(counts)]
        unit = 2.0**(math.floor(math.log2(length)) - BITS - 10)
        lengths = [count*unit*round(share*length/(count*unit)) for share, count in zip(shares, counts)]
        self.length = length = sum(lengths)
        self.elements = [size/count for size, count in zip(lengths, counts) for _ in range(count)]
        self.kinds = [kind for kind, count in zip(("chain", "rope"), counts) for _ in range(count)]
        self.mass = {"chain": few_bits(10**r.uniform(0, 2)), "rope": few_bits(10**r.uniform(-1, 1))}
        weight = GRAVITY*self.mass["chain"]*length
        self.stiffness = {"chain": weight*10**r.uniform(2, 4), "rope": weight*10**r.uniform(1.5, 3)}
        nodes = sorted(r.sample(range(1, len(self.elements)), r.randint(1, 3)))
        self.weights = []
        for node in nodes:
            floats = not self.weights or r.random() < 0.7
            volume = few_bits(weight/(1000*GRAVITY)*10**r.uniform(-1.5, 1.5))
            self.weights.append((node, few_bits(1000*volume*r.uniform(0, 1.2)), volume, floats))
            if r.random() < 0.2:
                self.weights.append((node, 500*volume, volume, r.random() < 0.5))
        self.friction = r.choice([0, r.uniform(0.1, 1)])
        self.at_body = not self.straight and r.random() < 0.4
        self.moves = []
        for _ in range(3):
            to = [r.uniform(0.6, 1.1)*self.size, r.uniform(-0.2, 0.2)*self.size, r.uniform(-0.3, 0.8)*self.depth]
            self.moves.append((r.randint(1, 3), to))
        free = [node for node in range(1, len(self.elements)) if node not in [w[0] for w in self.weights]]
        self.grasped = r.choice(free) if r.random() < 0.4 else None

    def place(self, x):
        return [a + b for a, b in zip(self.origin, x)]

    def arc(self, node):
        return sum(self.elements[:node]) if self.sections else self.length*node/len(self.elements)

    def held(self, end):
        return self.place([0, 0, -self.depth] if end == "A" else self.end)

    def barge(self):
        return self.place([self.end[0], self.end[1], self.end[2] + 0.1*self.depth])

    def begins(self, end):
        """Where an end begins, of one on the barge as its pose and the eye give it: floats are first guessed to be between the ends."""
        if end == "B" and self.at_body:
            return [x + y for x, y in zip(self.barge(), [0, 0, -0.1*self.depth])]
        return self.held(end)

    def line(self, first, last, point_weights, ends):
        made = {"ends": ends, "start": "static"}
        if point_weights:
            made["point_weights"] = point_weights
        if self.straight:
            a, b, whole = self.held("A"), self.held("B"), self.arc(len(self.elements))
            ways = [[x + (y - x)*self.arc(node)/whole for x, y in zip(a, b)] for node in (first, last)]
            made["start"] = {"straight": {"from": ways[0], "to": ways[1]}}
        if not self.sections:
            made.update(length=self.arc(last) - self.arc(first), elements=last - first, mass=self.mass["chain"],
                        stiffness=self.stiffness["chain"])
            return made
        made["sections"] = []
        for kind in ("chain", "rope"):
            mine = [length for length, of in list(zip(self.elements, self.kinds))[first:last] if of == kind]
            if mine:
                made["sections"].append({"type": kind, "length": sum(mine), "elements": len(mine)})
        return made

    def scene(self, whole):
        """and the names of the parts of the line"""
        bed = {"plane": {"point": self.place([0, 0, -self.depth])}, "friction": self.friction}
        scene = {"capstan": 1, "gravity": [0, 0, -GRAVITY], "water_density": 1000, "water_surface": self.level, "obstacles": {"bed": bed}, "points": {}, "lines": {}}
        if self.sections:
            scene["types"] = {kind: {"mass": self.mass[kind], "stiffness": self.stiffness[kind]} for kind in ("chain", "rope")}
        ends = {"A": {"held": self.held("A")}, "B": {"held": self.held("B")}}
        if self.straight:
            ends = {"A": "held", "B": "held"}
        if self.at_body:
            scene["bodies"] = {"barge": {"held": self.barge()}}
            scene["points"]["eye"] = {"body": "barge", "at": [0, 0, -0.1*self.depth]}
            ends["B"] = {"point": "eye"}
        cuts = sorted({node for node, _, _, floats in self.weights if floats})
        bounds = [0] + cuts + [len(self.elements)]
        names = [f"leg-{k + 1}" for k in range(len(cuts) + 1)] if whole else [f"part{k}" for k in range(len(cuts) + 1)]
        if whole:
            weights = [dict({"at": self.arc(node), "mass": mass, "volume": volume}, **({"floats": True} if floats else {}))
                       for node, mass, volume, floats in self.weights]
            scene["lines"]["leg"] = self.line(0, len(self.elements), weights, ends)
        else:
            for k, (first, last) in enumerate(zip(bounds, bounds[1:])):
                own = [{"at": self.arc(node) - self.arc(first), "mass": mass, "volume": volume}
                       for node, mass, volume, _ in self.weights if first < node < last]
                own_ends = {"A": ends["A"] if k == 0 else {"point": f"float{k}"},
                            "B": ends["B"] if k == len(cuts) else {"point": f"float{k + 1}"}}
                scene["lines"][names[k]] = self.line(first, last, own, own_ends)
            for k, node in enumerate(cuts):
                share = self.arc(node)/self.arc(len(self.elements))
                at = [a + share*(b - a) for a, b in zip(self.begins("A"), self.begins("B"))]
                if not self.straight:
                    at[2] = self.level
                # what floats displaces the water of its volume; what does not, at the same node, is weight only
                mass = sum(w[1] - (0 if w[3] else 1000*w[2]) for w in self.weights if w[0] == node)
                volume = sum(w[2] for w in self.weights if w[0] == node and w[3])
                scene["points"][f"float{k + 1}"] = {"free": at, "mass": max(mass, 0), "volume": volume, "lifted": mass < 0}
        top = "barge.body" if self.at_body else "leg.B" if whole else f"{names[-1]}.B"
        up = [0, 0, 0.1*self.depth] if self.at_body else [0, 0, 0]
        history = [{"name": f"move {k}", "steps": steps, top: {"position": self.place([a + b for a, b in zip(to, up)])}}
                   for k, (steps, to) in enumerate(self.moves)]
        if self.grasped is not None:
            k = sum(node < self.grasped for node in cuts)
            name, at = ("leg", self.arc(self.grasped)) if whole else (names[k], self.arc(self.grasped) - self.arc(bounds[k]))
            history[1:1] = [{"name": "grasp", f"{name}.node": {"at": at, "hold": True}}]
            history.append({"name": "let go", f"{name}.node": {"at": at, "release": True}})
        scene["history"] = history
        if not scene["points"]:
            del scene["points"]
        return scene, names


def run(folder, name, scene):
    path, out = os.path.join(folder, f"{name}.yaml"), os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        json.dump(scene, file)
    done = subprocess.run([CAPSTAN, "run", path, "-o", out], capture_output=True, text=True, timeout=300, check=False)
    result = os.path.join(out, "result.nc")
    if not os.path.exists(result):
        return done.returncode, done.stderr, None
    check = subprocess.run([CHECKER, result, path], capture_output=True, text=True, timeout=300, check=False)
    return done.returncode, check.stdout + check.stderr if check.returncode != 0 else "", Results(result)


def compare(seed, folder):
    """The largest differences of places per size, and of tensions per largest one and stiffness, to which places of that accuracy tell them;
    the states of the floats seen, and what is wrong."""
    mooring = Mooring(seed)
    (one, ones), (parts, names) = mooring.scene(True), mooring.scene(False)
    for point in parts.get("points", {}).values():
        if point.pop("lifted", False):
            return None  # a point with volume has a mass: this float cannot be written so
    found = [run(folder, f"{seed}-{name}", scene) for name, scene in (("one", one), ("parts", parts))]
    wrong = [f"exit {code}: {said.strip()[:300]}" for code, said, results in found if results is None or said or code not in (0, 1)]
    if wrong or found[0][0] != found[1][0]:
        return 0, 0, set(), wrong or [f"exit {found[0][0]} and {found[1][0]}"], (0, 0)
    a, b = found[0][2], found[1][2]
    place, force, largest, steps = 0, 0, 0, 0
    for step in range(a.steps):
        if any(results.get(f"{name}_places_not_unique", step)[0] != 0 for results, own in ((a, ones), (b, names)) for name in own):
            break
        steps += 1
        for mine, other in zip(ones, names):
            place = max([place] + [abs(p - q) for p, q in zip(a.get(f"{mine}_position", step), b.get(f"{other}_position", step))])
            tension = a.get(f"{mine}_tension", step)
            largest = max([largest] + list(tension))
            force = max([force] + [abs(p - q) for p, q in zip(tension, b.get(f"{other}_tension", step))])
    water = {int(w) for step in range(a.steps) for w in a.get("water_of_point", step)}
    return place/mooring.size, force/(largest + max(mooring.stiffness.values())), water, [], (steps, a.steps)


REFUSED = """
capstan: 1
water_density: 1000
water_surface: 0
lines:
  leg:
    length: 10
    elements: 10
    mass: 1
    stiffness: 1e5
    point_weights: [{at: 5, mass: 1, volume: 0.01, floats: true}]
    start: static
    ends: {A: {held: [0, 0, -5]}, B: {held: [6, 0, 0]}}
history:
  - {leg.B: {move: [1, 0, 0]}}
"""
CANNOT = ": write it as lines that end at a free point with 'mass' and 'volume'"
# what is replaced, by what, and the message with its place
CHANGES = (
    ("    start: static\n", "    start: static\n    pretension: {end: B, tension: 100}\n", "13:5: 'pretension': found a length to be found, which a line with floats cannot have" + CANNOT),
    ("B: {held: [6, 0, 0]}", "B: {held: [6, 0, 0], stored: 3}", "13:35: 'B': found a winch, which a line with floats cannot have" + CANNOT),
    ("B: {held: [6, 0, 0]}}\nhistory:\n  - {leg.B: {move: [1, 0, 0]}}", "B: {force: [1, 0, 0]}}", "13:35: 'B': found a free end of a static start, which a line with floats cannot have" + CANNOT),
    ("start: static", "start: {polyline: [[0, 0, -5], [2, 0, 3], [6, 0, 0]]}", "12:5: 'start': found neither 'static' nor 'straight', which a line with floats cannot have" + CANNOT),
    ("leg.B: {move: [1, 0, 0]}", "leg.node: {at: 5, hold: true}", "15:6: 'leg.node': a float is there: write the line as lines that end at a free point, and change that"),
    ("history:\n", "  leg-2: {length: 10, mass: 1, stiffness: 1e5, start: static, ends: {A: {held: [0, 0, -5]}, B: {held: [6, 0, 0]}}}\nhistory:\n",
     "14:3: "),
)


def refuse(folder):
    failed = 0
    path = os.path.join(folder, "bad.yaml")
    for old, new, message in CHANGES:
        with open(path, "w", encoding="utf-8") as file:
            file.write(REFUSED.replace(old, new))
        done = subprocess.run([CAPSTAN, "check", path], capture_output=True, text=True, timeout=60, check=False)
        if done.returncode != 3 or not done.stderr.startswith(f"capstan: {path}:{message}") or done.stderr.count("\n") != 1:
            failed += 1
            print(f"FAILED {new.strip()}\n  expected {message}\n  found exit {done.returncode}: {done.stderr}")
    return failed


WARNED = """capstan: 1
water_density: 1000
water_surface: 0
lines:
  leg:
    length: 60
    elements: 12
    weight: 20
    stiffness: 1e6
    breaking_load: 100
    start: static
    point_weights: [{at: 30, mass: 5, volume: 0.3, floats: true}, {at: 50, mass: 1, volume: 0.05}]
    ends: {A: {held: [0, 0, -20]}, B: {held: [20, 0, 35]}}
"""


def warnings_name_the_line(folder):
    """Warnings, that of a buoy above the surface too, are about a place on the line that the file has."""
    scene = os.path.join(folder, "warned.yaml")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(WARNED)
    done = subprocess.run([CAPSTAN, "run", scene, "-o", os.path.join(folder, "warned"), "--force"], capture_output=True, text=True, timeout=60, check=False)
    warned = [line for line in done.stderr.splitlines() if "warning" in line]
    if "line leg: the buoy at 50 m is " in done.stderr and any("at 47.5 m" in line for line in warned) and "leg-" not in "".join(warned):
        return 0
    print(f"warnings about a line with floats: {done.stderr[-600:]}")
    return 1


def main():
    failed, place, force, water, pairs, compared, steps = 0, 0, 0, set(), 0, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        failed += refuse(folder) + warnings_name_the_line(folder)
        for seed in range(FIRST, FIRST + SEEDS):
            found = compare(seed, folder)
            if found is None:
                continue
            pairs += 1
            place, force, water = max(place, found[0]), max(force, found[1]), water | found[2]
            compared, steps = compared + found[4][0], steps + found[4][1]
            if found[3] or found[0] > SAME or found[1] > SAME:
                failed += 1
                print(f"seed {seed}: places {found[0]:.2g}, tensions {found[1]:.2g}, {'; '.join(found[3])}")
    if SEEDS >= 12 and not {SUBMERGED, FLOATING, ABOVE} <= water:
        failed += 1
        print(f"floats are never in one of the states: {water}")
    if compared < LEAST*steps:
        failed += 1
        print(f"only {compared} of {steps} steps can be compared")
    print(f"{pairs} pairs, {compared} of {steps} steps: places apart by up to {place:.2g} of the size, tensions by up to {force:.2g} of the largest and EA; {len(CHANGES)} "
          f"combinations refused; {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
