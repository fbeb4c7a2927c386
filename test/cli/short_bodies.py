#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Free bodies on inextensible lines that are too short by a known share, or long enough by it.           usage: short_bodies.py CAPSTAN CHECKER [SCENES [SEED]]

A body with eyes at s_k is pulled by p_k = C^-1 (s_k - m), m their mean and C = sum (s_k - m)(s_k - m)': these forces balance, and so do their
moments, and the sum of p_k s_k' is the identity, so that no rotation brings the eyes farther along them. In a pose drawn at random each line goes
from its eye along its force. With lengths longer by a share than these ways that pose is one where the lines reach; with lengths shorter by it
there is none, in whatever pose, and capstan has to prove it; with longer ones it has to find a pose that it certifies. A second body is hung on the first by a line of one force for both; an anchor may be
a free point on three lines; some directions of a body are fixed, at their values in that pose. The scene begins with the bodies elsewhere,
turned by any rotation. The checker recomputes the proof, and has to refuse it where one number of the scene or of the file is another.
"""
import math
import os
import random
import re
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER = map(os.path.abspath, sys.argv[1:3])
SCENES, SEED = (int(a) for a in (sys.argv[3:] + ["25", "1"][len(sys.argv) - 3:]))


def dot(a, b):
    return sum(x*y for x, y in zip(a, b))


def add(a, b, by=1.0):
    return [x + by*y for x, y in zip(a, b)]


def norm(a):
    return math.sqrt(dot(a, a))


def cross(a, b):
    return [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]]


def apply(m, v):
    return [dot(row, v) for row in m]


def solve(m, v):
    """By Cramer's rule."""
    columns = list(zip(*m))
    det = dot(cross(columns[0], columns[1]), columns[2])
    return [dot(cross(columns[1], columns[2]), v)/det, dot(cross(columns[2], columns[0]), v)/det, dot(cross(columns[0], columns[1]), v)/det]


def matrix(q):
    w, x, y, z = (c/math.sqrt(sum(c*c for c in q)) for c in q)
    return [[1 - 2*(y*y + z*z), 2*(x*y - w*z), 2*(x*z + w*y)],
            [2*(x*y + w*z), 1 - 2*(x*x + z*z), 2*(y*z - w*x)],
            [2*(x*z - w*y), 2*(y*z + w*x), 1 - 2*(x*x + y*y)]]


def product(a, b):
    return [a[0]*b[0] - a[1]*b[1] - a[2]*b[2] - a[3]*b[3], a[0]*b[1] + a[1]*b[0] + a[2]*b[3] - a[3]*b[2],
            a[0]*b[2] - a[1]*b[3] + a[2]*b[0] + a[3]*b[1], a[0]*b[3] + a[1]*b[2] - a[2]*b[1] + a[3]*b[0]]


def between(a, b):
    """The rotation of unit vector a into b."""
    q = [1 + dot(a, b)] + cross(a, b)
    return q if q[0] > 1e-6 else [0.0] + cross(a, [1, 0, 0] if abs(a[0]) < 0.6 else [0, 1, 0])


def vector(x):
    return "[" + ", ".join(f"{v:.17g}" for v in x) + "]"


class Scene:
    def __init__(self, r, share):
        self.r, self.share = r, share
        self.size, self.weight = 10**r.uniform(-2, 3), 10**r.uniform(-1, 4)
        self.at = [self.size*r.choice([0, 0, 30, -1e3])*r.random() for _ in range(3)]
        self.bodies, self.points, self.lines = [], [], []
        self.has_two = r.random() < 0.4
        place, pull = self.body(0, list(self.at), [r.gauss(0, 1) for _ in range(4)], None)
        if self.has_two:
            self.body(1, place, None, pull)

    def any(self, size):
        return [size*self.r.uniform(-1, 1) for _ in range(3)]

    def body(self, k, place, q, towed):
        """With `towed`, at the far end of a line that pulls from its first eye by `towed` away from there."""
        r = self.r
        arm, count = self.size*r.uniform(0.05, 1), r.randint(4, 7)
        eyes = [self.any(arm) for _ in range(count)]
        mean = [sum(s[a] for s in eyes)/count for a in range(3)]
        spread = [[sum((s[a] - mean[a])*(s[b] - mean[b]) for s in eyes) for b in range(3)] for a in range(3)]
        forces = [solve(spread, add(s, mean, -1)) for s in eyes]
        if towed:
            by = norm(towed)/norm(forces[0])
            forces = [[by*x for x in p] for p in forces]
            q = between([x/norm(forces[0]) for x in forces[0]], [-x/norm(towed) for x in towed])
        m = matrix(q)
        first = 0
        if towed:  # its first eye is where the line ends
            place, first = add(place, apply(m, eyes[0]), -1), 1
        start = add(place, self.any(2*self.size))
        turn, fixed = [r.gauss(0, 1) for _ in range(4)], []
        if r.random() < 0.3:
            fixed = [a for a in range(3) if r.random() < 0.5]
            for a in fixed:
                start[a] = place[a]
        names = ["xyz"[a] for a in fixed]
        if r.random() < 0.2:  # no rotation, whatever they do not balance
            names, turn = names + ["rx", "ry", "rz"], q
        elif r.random() < 0.3:
            turn = product([1] + self.any(0.3), q)
        self.bodies.append(f"  body{k}: {{free: {vector(start)}, rotation: {{quaternion: {vector(turn)}}}, fixed: [{', '.join(names)}], "
                           f"weight: {self.weight:.9g}}}")
        for e, s in enumerate(eyes):
            self.points.append(f"  eye{k}{e}: {{body: body{k}, at: {vector(s)}}}")
        for e in range(first, count):
            here, pull = add(place, apply(m, eyes[e])), apply(m, forces[e])
            if k > 0 or e > 0 or not self.has_two:
                self.leg(f"{k}{e}", f"{{point: eye{k}{e}}}", here, pull)
                continue
            length = self.size*r.uniform(0.3, 2)
            self.line("00", "{point: eye00}", "{point: eye10}", length)
            beyond = add(here, pull, length/norm(pull)), pull
        return beyond if k == 0 and self.has_two else (None, None)

    def leg(self, name, on, here, pull):
        """A line along the pull to an anchor, or to a free point on three more."""
        r, length = self.r, self.size*self.r.uniform(0.3, 2)
        there = add(here, pull, length/norm(pull))
        if r.random() < 0.8:
            self.line(name, on, f"{{held: {vector(there)}}}", length)
            return
        self.points.append(f"  knot{name}: {{free: {vector(add(there, self.any(0.2*self.size)))}, weight: {0.1*self.weight:.9g}}}")
        self.line(name, on, f"{{point: knot{name}}}", length)
        parts = [add([x/3 for x in pull], self.any(0.3*norm(pull))) for _ in range(2)]
        for i, part in enumerate(parts + [add(add(pull, parts[0], -1), parts[1], -1)]):
            beyond = self.size*r.uniform(0.3, 1)
            self.line(f"{name}{i}", f"{{point: knot{name}}}", f"{{held: {vector(add(there, part, beyond/norm(part)))}}}", beyond)

    def line(self, name, one, other, way):
        ends = [one, other]
        self.r.shuffle(ends)
        self.lines.append(f"  line{name}: {{length: {way*(1 + self.share):.17g}, elements: {self.r.randint(1, 3)}, "
                          f"weight: {0.1*self.weight/self.size:.9g}, stiffness: .inf, start: static, ends: {{A: {ends[0]}, B: {ends[1]}}}}}")

    def text(self):
        return ("capstan: 1\nbodies:\n" + "\n".join(self.bodies) + "\npoints:\n" + "\n".join(self.points) + "\nlines:\n" + "\n".join(self.lines) + "\n")


def checked(path, out):
    return subprocess.run([CHECKER, os.path.join(out, "result.nc"), path], capture_output=True, text=True, timeout=120, check=False)


def main():
    wrong = 0
    tight, loose = {"refused": 0, "open": 0}, {"solved": 0, "open": 0}
    with tempfile.TemporaryDirectory() as folder:
        path, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
        for k in range(SCENES):
            seed = 1000*SEED + k
            share = 10**random.Random(seed + 1).uniform(-7, -0.5)
            for sign in (-1, 1):
                text = Scene(random.Random(seed), sign*share).text()
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
                done = subprocess.run([CAPSTAN, "run", path, "-q", "--no-paraview", "--force", "-o", out], capture_output=True, text=True, timeout=300, check=False)
                found = checked(path, out) if done.returncode in (0, 1, 5) else None
                proof = done.returncode == 5
                if sign > 0 and proof or found is None or (done.returncode != 1 and found.returncode != 0):
                    wrong += 1
                    print(f"seed {seed} share {sign*share:.3g}: exit {done.returncode}: {done.stderr[:200]} {found.stdout[-300:] if found else ''}")
                    continue
                if sign < 0:
                    tight["refused" if proof else "open"] += 1
                    if not proof:
                        print(f"seed {seed} share {-share:.3g}: no proof, exit {done.returncode}")
                    continue
                loose["solved" if done.returncode == 0 else "open"] += 1
                if done.returncode != 0:
                    print(f"seed {seed} share {share:.3g}: no pose found, exit {done.returncode}")
    print(f"{SCENES} scenes: too short: {tight['refused']} refused with a proof, {tight['open']} open; long enough: {loose['solved']} certified, "
          f"{loose['open']} not; {wrong} wrong")
    return 1 if wrong or max(tight["open"], loose["open"]) > 0.005*SCENES else 0


if __name__ == "__main__":
    sys.exit(main())
