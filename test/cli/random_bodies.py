#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random scenes with bodies, from their file to the checker: what capstan says of poses, forces and moments is what the checker finds from
result.nc and the scene.                                                            usage: random_bodies.py CAPSTAN CHECKER [SCENES [SEED]]

Drawn are: one or two bodies, held or free; size (1e-3 to 1e3) and forces; the place of the scene (up to 1e4 lengths away); rotations beyond one
turn, as angles or as quaternions of any length; directions that are fixed; weight, buoyancy, coupled hydrostatics; gravity that is tilted and
changes; lines from and to bodies, on a bed with friction or above it; loads with arms, moves, turns, releases and grabs, one after the other.
"""
import os
import random
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER = map(os.path.abspath, sys.argv[1:3])
SCENES, SEED = (int(a) for a in (sys.argv[3:] + ["25", "1"][len(sys.argv) - 3:]))
DIRECTIONS = ["x", "y", "z", "rx", "ry", "rz"]
LEGS = 3


def vector(*x):
    return "[" + ", ".join(f"{float(v):.9g}" for v in x) + "]"


def rotation(r, most):
    if r.random() < 0.5:
        return f"{{roll_pitch_yaw: {vector(*(r.uniform(-most, most) + 360*r.randint(-2, 2) for _ in range(3)))}}}"
    w = [1] + [r.uniform(-most, most)/115 for _ in range(3)]
    scale = r.choice([1, -1, 7.5, 0.01])
    return f"{{quaternion: {vector(*(scale*x for x in w))}}}"


class Scene:
    def __init__(self, r):
        self.r, self.length, self.unit = r, 10**r.uniform(-3, 3), 10**r.uniform(-1, 4)
        self.at = [self.length*r.choice([0, 0, 1e3, -1e4])*r.random() for _ in range(3)]
        self.free = {}
        self.bodies, self.points, self.lines = [], [], []
        for k in range(r.randint(1, 2)):
            self.body(k)

    def place(self, *x):
        return vector(*(self.at[i] + self.length*v for i, v in enumerate(x)))

    def water(self):
        """A positive matrix, in forces per length."""
        a = [[self.r.uniform(-1, 1) for _ in range(6)] for _ in range(6)]
        unit = [1, 1, 1, self.length, self.length, self.length]
        return [[self.unit/self.length*unit[i]*unit[j]*(sum(a[k][i]*a[k][j] for k in range(6)) + 2*(i == j)) for j in range(6)] for i in range(6)]

    def body(self, k):
        r, name, x = self.r, f"body{k}", 6*k
        self.free[name] = r.random() < 0.7
        fixed = [d for d in DIRECTIONS if r.random() < 0.15]
        rows = ", ".join(vector(*row) for row in self.water())
        self.bodies.append(f"  {name}: {{{'free' if self.free[name] else 'held'}: {self.place(x, 0, 0)}, rotation: {rotation(r, 15)}, "
                           f"fixed: [{', '.join(fixed)}], weight: {self.unit*r.random():.9g}, "
                           f"centre_of_gravity: {vector(*(self.length*r.uniform(-0.3, 0.3) for _ in range(3)))}, buoyancy: {2*self.unit*r.random():.9g}, "
                           f"centre_of_buoyancy: {vector(*(self.length*r.uniform(-0.3, 0.3) for _ in range(3)))}, hydrostatics: [{rows}]}}")
        for leg in range(LEGS):
            on = f"eye{k}{leg}"
            self.points.append(f"  {on}: {{body: {name}, at: {vector(*(self.length*r.uniform(-0.4, 0.4) for _ in range(3)))}}}")
            other = f"{{held: {self.place(x + r.uniform(-4, 4), r.uniform(-4, 4), -3)}}}"
            if k == 1 and leg == 0:
                other = "{point: eye00}"
            ends = [f"{{point: {on}}}", other]
            r.shuffle(ends)
            self.lines.append(f"  line{k}{leg}: {{length: {self.length*r.uniform(6.5, 8):.9g}, elements: {r.randint(4, 24)}, "
                              f"weight: {self.unit/self.length*10**r.uniform(-3, -1):.9g}, stiffness: {self.unit*10**r.uniform(2, 4):.9g}, start: static, "
                              f"ends: {{A: {ends[0]}, B: {ends[1]}}}}}")

    def change(self, name):
        r = self.r
        if self.free[name] and r.random() < 0.7 or not self.free[name] and r.random() < 0.3:
            self.free[name] = True
            force = [self.unit*r.uniform(-0.3, 0.3) for _ in range(3)]
            return f"{{force: {vector(*force)}, arm: {vector(*(self.length*r.uniform(-1, 1) for _ in range(3)))}}}"
        where = "" if self.free[name] or r.random() < 0.5 else f"move: {vector(*(self.length*r.uniform(-0.2, 0.2) for _ in range(3)))}"
        if self.free[name]:
            where = f"position: {self.place(6*int(name[-1]), 0.1, 0.1)}"
        turn = f"rotation: {rotation(r, 15)}" if self.free[name] or not where or r.random() < 0.5 else ""
        self.free[name] = False
        return "{" + ", ".join(part for part in (where, turn) if part) + "}"

    def text(self):
        r = self.r
        g = [r.uniform(-1, 1), r.uniform(-1, 1), -9]
        history = []
        for _ in range(r.randint(1, 4)):
            changes = [f"{name}.body: {self.change(name)}" for name in self.free if r.random() < 0.8]
            if r.random() < 0.3:
                changes.append(f"gravity: {vector(r.uniform(-1, 1), r.uniform(-1, 1), -9)}")
            history.append(f"  - {{steps: {r.randint(1, 3)}{''.join(', ' + c for c in changes)}}}")
        bed = "" if r.random() < 0.3 else f"obstacles: {{bed: {{plane: {{point: {self.place(0, 0, -3)}}}, friction: {r.choice([0, 0.3, 1])}}}}}\n"
        return (f"capstan: 1\ngravity: {vector(*g)}\n{bed}bodies:\n" + "\n".join(self.bodies) + "\npoints:\n" + "\n".join(self.points)
                + "\nlines:\n" + "\n".join(self.lines) + "\nhistory:\n" + "\n".join(history) + "\n")


def main():
    refuted, certified, refused = [], 0, 0
    with tempfile.TemporaryDirectory() as folder:
        path, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
        for k in range(SCENES):
            seed = 1000*SEED + k
            text = Scene(random.Random(seed)).text()
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            done = subprocess.run([CAPSTAN, "run", path, "-q", "--no-paraview", "-o", out], capture_output=True, text=True, timeout=300, check=False)
            if done.returncode not in (0, 1):
                refused += 1
                print(f"seed {seed}: exit {done.returncode}: {done.stderr[:300]}")
                continue
            found = subprocess.run([CHECKER, os.path.join(out, "result.nc"), path], capture_output=True, text=True, timeout=120, check=False)
            said = [line for line in (found.stdout + found.stderr).splitlines() if " body " in line or " point " in line or "not the scene's" in line]
            if said or found.returncode > 1 or (done.returncode == 0 and found.returncode != 0):
                refuted.append(seed)
                print(f"seed {seed}: exit {done.returncode}, checker {found.returncode}: {said[:2] or found.stdout[-300:]}")
            certified += done.returncode == 0 and found.returncode == 0
    print(f"{SCENES} scenes: {certified} certified, {SCENES - certified - len(refuted) - refused} not, {refused} refused, {len(refuted)} refuted")
    # of 200 scenes of seed 2, 199 are certified, and of one no pose is found
    return 1 if refuted or refused or certified < 0.95*SCENES - 1 else 0


sys.exit(main())
