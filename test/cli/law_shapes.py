# SPDX-License-Identifier: BSD-3-Clause
"""Laws with sets of forces of every shape, asked in both directions and drawn: bounded or not, of each dimension, smooth or not.

usage: law_shapes.py CAPSTAN

A force that is told at a velocity V dissipates what is told, -<V, F>, and of the velocities told at that force each dissipates -<v, F> as
well, which no other force exceeds (M77 (5)): so each answer is recomputed from the other direction. Pictures are well formed and hold no
number that is none.
"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as tree

from checks import expect, faults, write

CAPSTAN = os.path.abspath(sys.argv[1])
CORNERS = ", ".join(f"[{math.cos(2 * math.pi * k / 70)!r}, {math.sin(2 * math.pi * k / 70)!r}]" for k in range(70))
LAWS = [
    "law: {interval: 2}", "law: {interval: [0, 3]}", "law: {interval: [-1, .inf]}", "law: {interval: .inf}", "law: {point: [0]}",
    "law: {disc: 1}", "law: {ellipse: [0.5, 2]}", "law: {box: [1, [-0.5, 2]]}", "law: {box: [[-.inf, 1], 1]}", "law: {point: [0, 0]}",
    "law: {segment: [[-1, -0.5], [1, 0.5]]}", "law: {strip: {normal: [1, 2], width: 3}}", "law: {half_space: {normal: [1, 2], offset: 3}}",
    "law: {half_space: {normal: [0, 1], offset: 0}}", "law: {subspace: [[1, 1]]}", "law: {rays: [[1, 0], [1, 1]]}", "law: {rays: [[1, 0]]}",
    "law: {polytope: [[1, 0], [0, 1], [-1, -1]]}", "law: {polytope: [" + CORNERS + "]}",
    "law: {inequalities: {rows: [[1, 0], [0, 1], [-1, -1]], offsets: [1, 1, 1]}}",
    "law: {inequalities: {rows: [[1, 0], [0, 1]], offsets: [1, 2]}}",
    "law: {intersection: [{disc: 1}, {half_space: {normal: [1, 1], offset: 0.3}}]}",
    "law: {sum: [{disc: 1}, {segment: [[-1, 0], [1, 0]]}]}", "law: {hull: [{disc: 1}, {point: [3, 0]}]}",
    "law: {polar: {polytope: [[1, 0], [0, 2], [-1, -1]]}}", "law: {polar: {segment: [[0, -1], [0, 1]]}}",
    "law: {image: {map: [[1, 0.5], [0, 1]], of: {box: [1, 1]}}}", "law: {preimage: {map: [[1, 2]], of: {interval: 1}}}",
    "law: {scale: {by: 0, of: {disc: 1}}}", "law: {translate: {by: [0.5, 0], of: {disc: 1}}}",
    "law: {contacts: [{map: [[1, 0]], of: {interval: 1}}, {map: [[1, 1]], of: {interval: 2}}]}",
    "law: {contacts: [{map: [[1, 0, 0], [0, 1, 1]], of: {disc: 1}}, {map: [[1, 0, 0], [0, 1, -1]], of: {disc: 2}}]}",
    "law: {ball: {radius: 1, dimension: 3}}", "law: {box: [1, 2, [0, .inf]]}", "law: {friction_cone: {friction: 0.5, dimension: 3}}",
    "law: {ellipsoid: [[2, 1, 0], [1, 2, 0], [0, 0, 1]]}", "law: {product: [{disc: 1}, {interval: [0, 1]}]}", "law: {point: [0, 0, 0]}",
    "law: {polytope: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]]}", "law: {subspace: [[1, 0, 0]]}",
    "law: {half_space: {normal: [0, 0, 1], offset: 1}}", "law: {polar: {ball: {radius: 2, dimension: 3}}}",
    "law: {intersection: [{ball: {radius: 1, dimension: 3}}, {half_space: {normal: [0, 0, 1], offset: 0.5}}]}",
    "law: {hull: [{ball: {radius: 1, dimension: 3}}, {point: [0, 0, 3]}]}",
    "law: {box: [1, 1, 1, 1, 1, 1, 1]}", "law: {product: [{disc: 1}, {disc: 2}, {disc: 3}, {interval: 1}]}",
    "law: {interval: 2}\nload: [1]", "law: {disc: 1}\nload: [0.3, 0.4]", "law: {disc: 1}\nload: [3, 4]", "law: {box: [1, 1]}\nload: [1, 0]",
    "resistance: [{dry: {interval: 1}}]", "resistance: [{dry: {interval: [0, 2]}}, {viscous: [[2]]}]", "resistance: [{viscous: [[0]]}]",
    "resistance: [{power: {degree: 3, factor: 2, of: {interval: 1}}}]", "resistance: [{dry: {disc: 1}}, {viscous: [[1, 0], [0, 0]]}]",
    "resistance: [{table: {points: [[0, 1], [1, 2], [2, 2]], of: {disc: 1}}}]", "resistance: [{dry: {ball: {radius: 1, dimension: 3}}}]",
    "resistance: [{dry: {half_space: {normal: [1, 0], offset: 0}}}, {viscous: [[1, 0], [0, 1]]}]",
]
SOLID = "CPS_SET_OUTCOME_UNBOUNDED"


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Law:
    def __init__(self, text):
        self.text = text
        write("law.yaml", "capstan: 1\n" + text + "\n")
        done = subprocess.run([CAPSTAN, "law", "law.yaml", "--json"], capture_output=True, text=True, check=False, timeout=60)
        expect(text, done.returncode == 0, done.stderr)
        told = json.loads(done.stdout or '{"components": 1, "kind": ""}')
        self.n = told["components"]
        self.dry = told["kind"] == "friction law"

    def ask(self, letter, rows, *more, code=(0,)):
        asked = [word for row in rows for word in (f"-{letter}", ",".join(map(repr, row)))]
        done = subprocess.run([CAPSTAN, "law", "law.yaml", *asked, *more], capture_output=True, text=True, timeout=60, check=False)
        expect(f"{self.text} {asked} {more}", done.returncode in code and "nan" not in done.stdout, (done.returncode, done.stderr[-200:]))
        return done.stdout

    def answers(self, letter, rows):
        return json.loads(self.ask(letter, rows, "--json"))["answers"] if rows else []

    def velocities(self):
        unit = [[float(i == k) for k in range(self.n)] for i in range(self.n)]
        return unit + [[-x for x in v] for v in unit] + [[0.0] * self.n, [1.0] * self.n, [(-0.7) ** k for k in range(self.n)]]

    def both_directions(self):
        """of a friction law; returns forces of it"""
        forces = []
        for answer in self.answers("v", self.velocities()):
            v, power = answer["velocity"], answer["dissipation_W"]
            if "centre" not in answer["forces"]:
                expect(f"{self.text}, V {v}", answer["forces"]["outcome"] == SOLID and power is None, answer)
                continue
            force = answer["forces"]["centre"]
            scale = 1e-6 * (1 + math.hypot(*v) * math.hypot(*force))   # answers are told with 1e-7 of the set's size
            expect(f"{self.text}, V {v}", abs(-dot(v, force) - power) <= scale, (force, power))
            forces.append(force)
        for answer in self.answers("f", forces):
            force, found = answer["force"], answer["velocities"]
            rays = found.get("rays", [])
            told = self.answers("v", rays)
            for ray, one in zip(rays, told):
                scale = 1e-6 * (1 + math.hypot(*ray) * math.hypot(*force))
                power = one["dissipation_W"]
                expect(f"{self.text}, F {force}, v {ray}", power is not None and abs(-dot(ray, force) - power) <= scale, one)
        return forces

    def draw(self, forces):
        """with all that was asked, and with nothing, each two components; the rows of one picture are cut"""
        axes = [None] if self.n < 2 else ["1,2", "2,1"] if self.n == 2 else ["1,2", f"{self.n},1"]
        asked = [word for v in self.velocities() for word in ("-v", ",".join(map(repr, v)))]
        asked += [word for f in forces[:4] for word in ("-f", ",".join(map(repr, f)))]
        for pair in axes:
            for more in ([], asked):
                if os.path.exists("law.svg"):
                    os.remove("law.svg")
                self.ask("v", [], "-p", "law.svg", *(["--axes", pair] if pair else []), *more)
                if not os.path.exists("law.svg"):
                    continue   # told by `ask`
                with open("law.svg", encoding="utf-8") as file:
                    text = file.read()
                expect(f"{self.text}: numbers of the picture", not re.search(r"[^a-z](nan|inf)[^a-z]", text), re.findall(r".{20}nan.{20}", text)[:1])
                expect(f"{self.text}: picture", tree.fromstring(text).tag.endswith("svg"))
                if more and self.n > 6:
                    expect(f"{self.text}: six numbers of seven are listed", ", ...) m/s" in text and "and more" in text)

    def words(self, forces):
        """the same in words: one paragraph for each question"""
        said = self.ask("v", self.velocities())
        expect(f"{self.text}: velocities in words", len(re.findall(r"^velocity ", said, re.M)) == len(self.velocities()), said)
        if forces:
            said = self.ask("f", forces)
            expect(f"{self.text}: forces in words", len(re.findall(r"^force ", said, re.M)) == len(forces), said)


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for text in LAWS:
            law = Law(text)
            forces = law.both_directions() if law.dry else [[0.0] * law.n]
            law.draw(forces)
            law.words(forces)
        os.chdir("/")
    print("\n".join(faults))
    print(f"{len(LAWS)} laws, {len(faults)} faults")
    return 1 if faults else 0


sys.exit(main())
