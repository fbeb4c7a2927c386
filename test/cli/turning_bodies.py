#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Free bodies on lines from one point, that a given moment turns in every pose, or not.               usage: turning_bodies.py CAPSTAN CHECKER [SCENES [SEED]]

About the point s of the body the loads balance in a rotation Q where the given moment is M = m(Q) = (Q s) x F + (Q d) x g. For a unit vector v the
largest v.m of any rotation is t(v), the sum of the singular values of (F x v) s' + (g x v) d': the root of

    |F x v|^2 |s|^2 + |g x v|^2 |d|^2 + 2 (F x v).(g x v) s.d + 2 |s x d| |v.(F x g)|.

It is attained where v.m is t, at the place m* = grad t(v) on the boundary of the convex hull of all m. So with M = m* + e v the hull is exactly e away,
and capstan has to refuse the scene with a moment that is less than e by at most a hundredth; with M = m(Q) of any Q no proof
exists, nor with (1 - e) m*, since the hull has 0 within it. In the first scene of each three all forces are along gravity: then v may be gravity itself. The checker recomputes each proof, and has to
refuse it where a number of the file is another.
"""
import json
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER = map(os.path.abspath, sys.argv[1:3])
SCENES, SEED = (int(a) for a in (sys.argv[3:] + ["40", "1"][len(sys.argv) - 3:]))
LEAST = 1e-6  # of the sizes of all moments: what a certified pose may leave


def dot(a, b):
    return sum(x*y for x, y in zip(a, b))


def add(a, b, by=1.0):
    return [x + by*y for x, y in zip(a, b)]


def scaled(by, a):
    return [by*x for x in a]


def norm(a):
    return math.sqrt(dot(a, a))


def cross(a, b):
    return [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]]


def apply(q, v):
    w, u = q[0], q[1:]
    return add(add(v, cross(u, v), 2*w), cross(u, cross(u, v)), 2)


def vector(x):
    return "[" + ", ".join(f"{v:.17g}" for v in x) + "]"


def unit(r, n=3):
    v = [r.gauss(0, 1) for _ in range(n)]
    return scaled(1/norm(v), v)


class Case:
    def __init__(self, r, plain):
        self.r = r
        size, weight = 10**r.uniform(-1, 2), 10**r.uniform(1, 6)
        self.size = size
        self.gravity = [0, 0, -9.81] if r.random() < 0.7 else scaled(9.81, unit(r))
        g = scaled(1/norm(self.gravity), self.gravity)
        self.s, self.centre, self.lift_centre = (scaled(size*r.random(), unit(r)) for _ in range(3))
        if r.random() < 0.2:
            self.s = [0.0, 0.0, 0.0]
        self.weight, self.lift = weight*r.random(), weight*r.choice([0, r.random(), 3])
        self.force = scaled(weight*r.random(), g if plain else unit(r))
        self.d = add(scaled(self.weight, add(self.s, self.centre, -1)), add(self.s, self.lift_centre, -1), -self.lift)
        self.g = g
        self.sizes = (norm(self.s)*norm(self.force) + self.weight*norm(add(self.s, self.centre, -1))
                      + self.lift*norm(add(self.s, self.lift_centre, -1)))

    def moment_in(self, q):
        return add(cross(apply(q, self.s), self.force), cross(apply(q, self.d), self.g))

    def largest(self, v):
        """t and its gradient, for a unit vector v."""
        f, g, x = self.force, self.g, cross(self.force, self.g)
        ss, dd, sd, area = dot(self.s, self.s), dot(self.d, self.d), dot(self.s, self.d), norm(cross(self.s, self.d))
        square = max(0, dot(cross(f, v), cross(f, v))*ss + dot(cross(g, v), cross(g, v))*dd + 2*dot(cross(f, v), cross(g, v))*sd
                     + 2*area*abs(dot(v, x)))
        t = math.sqrt(square)
        half = add(scaled(dot(f, f)*ss, v), f, -dot(f, v)*ss)
        half = add(add(half, v, dot(g, g)*dd), g, -dot(g, v)*dd)
        half = add(add(half, v, 2*dot(f, g)*sd), add(scaled(dot(g, v), f), g, dot(f, v)), -sd)
        half = add(add(half, v, area*abs(dot(v, x))), x, area*math.copysign(1, dot(v, x)))
        return t, scaled(1/t, half) if t > 0 else None

    def scene(self, moment, fixed=()):
        r = self.r
        length, stiff = self.size*r.uniform(1, 5), (self.weight + norm(self.force) + self.lift)*10**r.uniform(2, 4)
        begin = scaled(self.size, [r.uniform(-3, 3) for _ in range(3)])
        lines = r.randint(1, 2)
        ends = "\n".join(f"  line{k}: {{length: {length:.9g}, elements: {r.randint(2, 8)}, weight: {0.01*self.weight/self.size:.9g}, "
                         f"stiffness: {stiff:.9g}, start: static, ends: {{A: {{held: {vector(add(begin, scaled(length, unit(r))))}}}, "
                         f"B: {{point: eye}}}}}}" for k in range(lines))
        return (f"capstan: 1\ngravity: {vector(self.gravity)}\nbodies:\n  body: {{free: {vector(begin)}, rotation: {{quaternion: {vector(unit(r, 4))}}}, "
                f"fixed: [{', '.join(fixed)}], weight: {self.weight:.17g}, buoyancy: {self.lift:.17g}, centre_of_gravity: {vector(self.centre)}, "
                f"centre_of_buoyancy: {vector(self.lift_centre)}, force: {vector(self.force)}, moment: {vector(moment)}}}\n"
                f"points:\n  eye: {{body: body, at: {vector(self.s)}}}\nlines:\n{ends}\n")


def run(folder, text):
    scene, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
    shutil.rmtree(out, ignore_errors=True)
    with open(scene, "w") as file:
        file.write(text)
    done = subprocess.run([CAPSTAN, "run", scene, "-o", out, "--force", "--no-paraview"], capture_output=True, text=True, timeout=300)
    with open(os.path.join(out, "summary.json")) as file:
        step = json.load(file)["steps"][-1]
    checked = subprocess.run([CHECKER, os.path.join(out, "result.nc"), scene], capture_output=True, text=True)
    return done, step, checked


def refused(folder, r, text):
    """Does the checker refuse the file with another number in the scene?"""
    change = r.choice(["weight: ", "moment: ["])
    at = text.index(change) + len(change)
    end = min(text.index(mark, at) for mark in ",]}" if mark in text[at:])
    number = float(text[at:end])
    scene = os.path.join(folder, "other.yaml")
    with open(scene, "w") as file:
        file.write(text[:at] + f"{number*1.01 + 1e-3:.17g}" + text[end:])
    return subprocess.run([CHECKER, os.path.join(folder, "out", "result.nc"), scene], capture_output=True).returncode != 0


def expect(faults, case, what, true, shown=""):
    if not true:
        faults.append(f"scene {case}: {what}: {shown}")


def outside(folder, r, case, faults):
    """A moment that nothing balances, by a known moment e; one time in four about the one axis that is free."""
    of = Case(r, case % 3 == 0)
    fixed, v = [], unit(r)
    if case % 3 == 0 and r.random() < 0.5:
        v = scaled(r.choice([1, -1]), of.g)
        nearest = scaled(r.random(), of.moment_in(unit(r, 4)))
    elif r.random() < 0.25:
        axis = r.randrange(3)
        v = [float(a == axis)*r.choice([1, -1]) for a in range(3)]
        fixed = ["r" + "xyz"[a] for a in range(3) if a != axis]
        t, _ = of.largest(v)
        nearest = scaled(t, v)
    else:
        _, nearest = of.largest(v)
    e = (of.sizes + norm(nearest))*10**r.uniform(-4, 0.5)
    moment = add(nearest, v, e)
    if fixed:
        moment = add(moment, [0.0 if v[a] else of.sizes*r.uniform(-1, 1) for a in range(3)])
    text = of.scene(moment, fixed)
    done, step, checked = run(folder, text)
    expect(faults, case, "refused", done.returncode == 5 and step["outcome"] == "unbounded", step["outcome"])
    proof = step["bodies"]["body"].get("proof")
    expect(faults, case, "the proof", proof, step["bodies"])
    if not proof:
        return
    small = 1e-9*(of.sizes + norm(moment))
    expect(faults, case, "its moment", 0.99*e - small <= proof["moment_Nm"] <= e + small, (proof, e))
    t, _ = of.largest(proof["axis"])
    expect(faults, case, "its axis", abs(dot(proof["axis"], moment) - t - proof["moment_Nm"]) <= 10*small, proof)
    expect(faults, case, "said", "in every pose the loads turn it about the axis" in done.stderr, done.stderr)
    expect(faults, case, "accepted by the checker", checked.returncode == 0, checked.stdout + checked.stderr)
    expect(faults, case, "another scene refused", refused(folder, r, text))


def inside(folder, r, case, faults):
    """A moment within the hull, next to its boundary or of a rotation. Returns whether a pose was found."""
    of = Case(r, case % 3 == 0)
    if r.random() < 0.5:
        moment = of.moment_in(unit(r, 4))
    else:
        _, nearest = of.largest(unit(r))
        moment = scaled(1 - 10**r.uniform(-9, -2), nearest)
    done, step, checked = run(folder, of.scene(moment))
    expect(faults, case, "not refused", step["outcome"] != "unbounded" and "proof" not in step["bodies"]["body"], step["bodies"])
    expect(faults, case, "nothing refuted", checked.returncode == 0 or " refuted 0," in checked.stdout and " 0 findings" in checked.stdout,
           checked.stdout + checked.stderr)
    return done.returncode == 0


def exempt(folder, r, case, faults):
    """What may have moments of its own is not refused: lines at two points, or a stiffness of the water."""
    of = Case(r, True)
    text = of.scene(add([0, 0, 0], of.g, 10*of.sizes))
    if case % 2:
        text = text.replace("weight: ", "hydrostatics: {rz: 1}, weight: ", 1)
    else:
        text = text.replace("points:\n", f"points:\n  ear: {{body: body, at: {vector(add(of.s, [0.1*of.size, 0, 0]))}}}\n")
        text += f"  more: {{length: {of.size:.9g}, elements: 2, weight: 1, stiffness: 1e6, start: static, ends: {{A: {{held: [0, 0, 0]}}, B: {{point: ear}}}}}}\n"
    _, step, _ = run(folder, text)
    expect(faults, case, "no proof", "proof" not in step["bodies"]["body"], step["bodies"])


def main():
    r, faults, found = random.Random(SEED), [], 0
    with tempfile.TemporaryDirectory() as folder:
        for case in range(SCENES):
            outside(folder, r, case, faults)
            found += inside(folder, r, case, faults)
            if case % 4 == 0:
                exempt(folder, r, case//4, faults)
            if len(faults) > 8:
                break
    print(f"seed {SEED}: {SCENES} bodies turned for ever and refused; of {SCENES} with a moment that may balance none refused, {found} found")
    for fault in faults:
        print(fault)
    return bool(faults)


sys.exit(main())
