# SPDX-License-Identifier: BSD-3-Clause
"""Random moorings of lines, points, bodies, clumps and winches, at rest and in time, seen from elsewhere: turned, mirrored and shifted, in other units,
far from the origin, with lines from the other end, in another order, and with features of no effect. The answers must be the same.

Rounding differs between the views; what it leaves is that of steps solved to 1e-13 of their energies, in which places count squared, and of
balances of points found to a hundredth of what they are asked for: 1e-6 of the length and of the largest force; 3e-8 was seen."""
import argparse
import json
import math
import os
import random
import sys
import tempfile

from checked import run
from result_file import Results
from scene_views import MIRROR, View, from_the_other_end, in_another_order, of_quaternion

SAME, FAR = 1e-6, 1e-3  # per length and per largest force; 1e6 m away places have 1e-10 m, 1e-4 of the force in a stiff line
CERTIFIED = (0, 1)


class Maker:
    def __init__(self, seed):
        self.random = random.Random(f"views {seed}")
        self.scene = {"capstan": 1, "gravity": [0, 0, -9.81], "points": {}, "lines": {}, "history": []}
        self.in_time = self.random.random() < 0.4

    def between(self, a, b):
        return self.random.uniform(a, b)

    def chance(self, p):
        return self.random.random() < p

    def vector(self, size):
        return [self.between(-size, size) for _ in range(3)]

    def unit(self, n=3):
        v = [self.random.gauss(0, 1) for _ in range(n)]
        return [x/math.sqrt(sum(c*c for c in v)) for x in v]

    def body(self):
        body = {"free": self.vector(0.2), "mass": self.between(2, 20), "buoyancy": self.between(250, 400), "rotation": {"quaternion": [1] + self.vector(0.3)},
                "centre_of_gravity": self.vector(0.1), "centre_of_buoyancy": [0, 0, self.between(0, 0.5)], "moments_of_inertia": [self.between(1, 2) for _ in range(3)]}
        stiff = [20, 20, self.between(50, 300)] + [self.between(40, 90) for _ in range(3)]  # none may drift: its place would be one of many
        body["hydrostatics"] = [[stiff[i] if i == j else 0 for j in range(6)] for i in range(6)]
        if self.in_time and self.chance(0.5):
            body["added_mass"] = [[self.between(0, 3) if i == j else 0 for j in range(6)] for i in range(6)]
            body["damping"] = [[self.between(0, 5) if i == j else 0 for j in range(6)] for i in range(6)]
        return body

    def line(self, start, end, knot):
        length = math.dist(start, end)*self.between(1.02, 1.3)
        line = {"length": length, "elements": self.random.randint(5, 16), "stiffness": 10**self.between(2, 4), "start": "static",
                "ends": {"A": {"held": start}, "B": {"point": knot}}}
        line["mass" if self.in_time else "weight"] = self.between(0.1, 0.4) if self.in_time else self.between(0.5, 4)
        if self.chance(0.4):
            line["point_weights"] = [{"at": length*self.random.randint(1, line["elements"] - 1)/line["elements"], "weight": self.between(-10, 10)}]
        if self.in_time and self.chance(0.4):
            line["damping"] = self.between(0.1, 20)
        if not self.in_time and self.chance(0.3):
            line["ends"]["A"]["stored"] = self.between(0.2, 0.5)
            line["length"] += line["ends"]["A"]["stored"]
            line.pop("point_weights", None)
        return line

    def entry(self, k, knot):
        out = {"name": f"s{k}", "steps": self.random.randint(1, 3)}
        if self.in_time:
            out["duration"] = self.between(0.1, 0.5)
        if self.chance(0.8):
            out[knot] = {"force": self.vector(15), **({"moment": self.vector(5)} if knot.endswith("body") else {})}
        for name, line in self.scene["lines"].items():
            if "stored" in line["ends"]["A"] and self.chance(0.7):
                out[f"{name}.pay_out_A"] = self.between(-0.1, 0.1)
            elif self.chance(0.3):
                out[f"{name}.A"] = {"move": [self.between(-0.2, 0.2), self.between(-0.2, 0.2), self.between(0, 0.2)]}
        return out

    def make(self):
        scene, depth, knot = self.scene, self.between(3, 8), "knot.point"
        if self.chance(0.7):
            scene["obstacles"] = {"bed": {"plane": {"point": [0, 0, -depth], "normal": [0, 0, 1]}, "friction": self.random.choice((0, 0.3, 0.8))}}
        if self.chance(0.5):
            scene["bodies"], knot = {"buoy": self.body()}, "buoy.body"
        else:
            scene["points"]["knot"] = {"free": self.vector(0.5), "mass" if self.in_time else "weight": self.between(1, 4)}
        for i in range(self.random.randint(2, 3)):
            heading, reach = 2.2*i + self.between(-0.4, 0.4), depth*self.between(0.6, 2)
            start, at = [reach*math.cos(heading), reach*math.sin(heading), self.random.choice((0.0, 0.5)) - depth], "knot"
            if "bodies" in scene:
                at = f"eye{i}"
                scene["points"][at] = {"body": "buoy", "at": [0.3*math.cos(heading), 0.3*math.sin(heading), self.between(-0.2, 0.2)]}
            scene["lines"][f"leg{i}"] = self.line(start, [0, 0, 0], at)
        scene["history"] = [self.entry(k, knot) for k in range(self.random.randint(1, 3))]
        return scene


def with_nothing_more(scene):
    """features that have no effect"""
    lines = {n: dict(line) for n, line in scene["lines"].items()}
    for line in lines.values():
        winch = any("stored" in e for e in line["ends"].values())
        line.setdefault("point_weights", [{"at": line["length"]/line["elements"], "weight": 0}])
        line["friction_zones"] = [{"from": 0, "to": line["length"], "factor": 1}]
        if not winch:
            line["loads"] = [{"force": [0, 0, 0]}]
    return {**scene, "lines": lines}


def views(scene, maker):
    """name, view, scene, lines that run the other way, allowed difference"""
    at = View("turned and shifted", of_quaternion(maker.unit(4)), maker.vector(30))
    yield at.name, at, at.scene(scene), (), SAME
    at = View("mirrored", MIRROR, maker.vector(3))
    yield at.name, at, at.scene(scene), (), SAME
    at = View("in other units", None, (0, 0, 0), 10**maker.between(-3, 5), 10**maker.between(-6, 9), 10**maker.between(-2, 2))
    yield at.name, at, at.scene(scene), (), SAME
    at = View("far away", None, [1e6*x for x in maker.unit()])
    yield at.name, at, at.scene(scene), (), FAR
    names = [n for n in scene["lines"] if maker.chance(0.6)]
    yield "from the other end", View(""), from_the_other_end(scene, names), names, SAME
    yield "in another order", View(""), in_another_order(scene, maker.random), (), SAME
    yield "with nothing more", View(""), with_nothing_more(scene), (), SAME


def solve(capstan, scene, folder, name):
    path, out = os.path.join(folder, name + ".yaml"), os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        json.dump(scene, file)
    told = run(capstan, "run", path, "-o", out, "--quiet", "--no-paraview", "--force", "--sync", "end")
    assert told.returncode in (0, 1, 5), f"{name}: {told.stderr}"
    return Results(os.path.join(out, "result.nc"))


def triples(flat):
    return [list(flat[i:i + 3]) for i in range(0, len(flat), 3)]


def differences(scene, view, one, two, turned):
    """[-] of places per length and of tensions per largest force, up to the first step that is not certified, or whose places are a choice"""
    origins = [r.attributes.get("origin", [0.0, 0.0, 0.0]) for r in (one, two)]
    worst, steps = 0.0, 0
    for step in range(min(one.steps, two.steps)):
        lines = {name: [r.get(f"{name}_outcome", step)[0] for r in (one, two)] for name in scene["lines"]}
        if any(a not in CERTIFIED or b not in CERTIFIED for a, b in lines.values()) or \
                any(r.get(f"{name}_places_not_unique", step)[0] > 0 or r.get(f"{name}_jumps", step)[0] > 0 for r in (one, two) for name in lines):
            return worst, steps, all((a in CERTIFIED) == (b in CERTIFIED) for a, b in lines.values())
        force = max(one.get(f"{name}_largest_force", step)[0] for name in lines)
        for name in lines:
            length = scene["lines"][name]["length"]
            here, there = ([[x + o for x, o in zip(p, origin)] for p in triples(r.get(f"{name}_position", step))] for r, origin in zip((one, two), origins))
            tension, pull = one.get(f"{name}_tension", step), [t/view.force for t in two.get(f"{name}_tension", step)]
            if name in turned:
                there, pull = there[::-1], pull[::-1]
            worst = max([worst] + [math.dist(a, view.back(b))/length for a, b in zip(here, there)] + [abs(a - b)/force for a, b in zip(tension, pull)])
        steps += 1
    return worst, steps, True


def main():
    options = argparse.ArgumentParser()
    options.add_argument("capstan")
    options.add_argument("--scenes", type=int, default=300)
    options.add_argument("--seed", type=int, default=1)
    given = options.parse_args()
    tally, bad = {}, 0
    for seed in range(given.seed, given.seed + given.scenes):
        maker = Maker(seed)
        scene = maker.make()
        with tempfile.TemporaryDirectory() as folder:
            one = solve(given.capstan, scene, folder, "one")
            for name, view, other, turned, allowed in views(scene, maker):
                worst, steps, alike = differences(scene, view, one, solve(given.capstan, other, folder, "other"), turned)
                count = tally.setdefault(name, [0, 0, 0.0])
                tally[name] = [count[0] + 1, count[1] + steps, max(count[2], worst)]
                if not (worst <= allowed and alike):
                    bad += 1
                    print(f"scene {seed}, {name}: {worst:.1e} apart" + ("" if alike else ", and only one of them is certified"))
    for name, (scenes, steps, worst) in tally.items():
        print(f"{name:20} | scenes {scenes:4} | steps {steps:5} | largest difference {worst:.1e}")
    if min(steps for _, steps, _ in tally.values()) < given.scenes:
        print("fewer than one step a scene was compared")
        bad += 1
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
