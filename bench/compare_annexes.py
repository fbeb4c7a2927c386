#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Solve random steps of S90's annexes, with a potential U beside the weight, by capstan and by Clarabel, and compare their energies.

    compare_annexes.py [--capstan CAPSTAN] [--count 50] [--seed 1] [--keep FOLDER]

A step is the minimum of J** + j + U (S90 P4.2 with H1 to H4 of its annexes): a line starts straight, with frozen friction of the reaction that
its start has, and is pulled or moved once. Five kinds take turns: a rough bed with springs from a piece of the line to where it started; a
quadratic field of space with general axes beside uniform loads, without an obstacle; a smooth bed that gives; an inextensible line in such a
field, above a bed; and a rough slope with springs, a field and loads together. As many steps follow that have, beside a field, an end in a convex set
C2 (remark 2.3): a ball, a box, a cylinder, a ball cut by a plane, or a polytope. Both are given the scene; nothing of capstan's answer enters
the conic program, which is assembled here:

    min  sum l EA d^2/2 + sum A_j t_j + sum (x_j - a)'K_j (x_j - a)/2 + sum k_j v_j^2/2 - sum b_j.x_j
    s.t. (1 + d_i, (x_i - x_(i-1))/l_i) in Q4,  (t_j, T (x_j - x_R,j)) in Q3,  n.(x_j - p) + v_j >= 0,  d, v >= 0,  held ends,  x_n in C2

(d = 0 where EA is infinite, v = 0 where the bed is rigid). Energies have to agree to 1e-8 of the sum of the absolute values of their terms.
The solvers are installed as by compare.py."""
import argparse
import copy
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import compare

HERE = os.path.dirname(os.path.abspath(__file__))
ACCURACY = 1e-8
TIGHT = 1e-11  # of Clarabel, which then gives what it can
KINDS = ["springs on a rough bed", "a quadratic field", "a bed that gives", "inextensible in a field", "all on a rough slope", "an end in a convex set"]

if __name__ == "__main__":
    compare.enter_environment()
    os.environ["OMP_NUM_THREADS"] = "1"
    import numpy as np
    from scipy import sparse
    sys.path.insert(0, os.path.join(HERE, "..", "test", "property"))
    from result_file import Results


class Case:
    """A scene, and the same numbers as arrays."""

    def __init__(self, kind, dice):
        self.kind, self.dice = kind, dice
        self.n = dice.randint(8, 60)
        self.length = dice.uniform(5, 20)
        self.weight = dice.uniform(5, 50)
        self.stiffness = math.inf if kind == 3 else self.weight*self.length*10**dice.uniform(1, 4)
        self.bed = kind not in (1, 5)
        slope = [dice.uniform(-0.15, 0.15), dice.uniform(-0.15, 0.15), 1.0] if kind == 4 else [0.0, 0.0, 1.0]
        self.normal = np.array(slope)/math.sqrt(sum(s*s for s in slope))
        self.friction = dice.uniform(0.1, 0.8) if kind in (0, 4) else 0.0
        self.gives = self.weight/(self.length*10**dice.uniform(-3, -1)) if kind == 2 else 0.0  # [N/m2], width 1
        along = np.array([1.0, 0, 0])
        along -= (along @ self.normal)*self.normal
        along /= np.linalg.norm(along)
        self.lift = 0.2*self.length if kind == 3 else 0.0
        self.start = [np.array([0, 0, self.lift]) + along*self.length*j/self.n for j in range(self.n + 1)]
        self.springs, self.loads = [], []
        if kind in (0, 4):
            a, b = sorted(dice.uniform(0, self.length) for _ in range(2))
            self.springs.append({"from": a, "to": b, "stiffness": [self.weight*dice.uniform(0, 2)/self.length for _ in range(3)]})
        if kind in (1, 3, 4, 5):
            self.springs.append(self.field())
        if kind == 2 and dice.random() < 0.5:
            self.springs.append({"at": dice.uniform(0, self.length), "stiffness": [0, self.weight, 0], "place": [self.length/2, 1.0, 0.0]})
        if kind in (1, 4, 5) or dice.random() < 0.3:
            a, b = sorted(dice.uniform(0, self.length) for _ in range(2))
            self.loads.append({"from": a, "to": b, "force": [self.weight*dice.uniform(-0.5, 0.5) for _ in range(3)]})
        moved = self.start[-1] + np.array([dice.uniform(-0.3, -0.02), dice.uniform(-0.2, 0.2), dice.uniform(0.02, 0.2)])*self.length
        self.held = kind != 5 and (dice.random() < 0.5 or kind == 3)
        self.set = self.convex_set() if kind == 5 else None
        self.end = moved if self.held else self.weight*self.length*np.array([dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(0, 0.8)])

    def field(self):
        """A quadratic field about a centre, of rank 1 to 3, with any axes."""
        dice = self.dice
        rank = dice.randint(1, 3)
        k = sum(np.outer(v, v) for v in ([dice.gauss(0, 1) for _ in range(3)] for _ in range(rank)))
        k *= self.weight/self.length*10**dice.uniform(-1, 0.5)
        if rank == 3:
            return {"stiffness": [k[0, 0], k[1, 1], k[2, 2]], "coupling": [k[0, 1], k[0, 2], k[1, 2]],
                    "place": [dice.uniform(0, self.length), dice.uniform(-2, 2), dice.uniform(0, 3)]}
        k += 1e-9*np.trace(k)*np.eye(3)  # rounding must not make it negative
        return {"stiffness": [k[0, 0], k[1, 1], k[2, 2]], "coupling": [k[0, 1], k[0, 2], k[1, 2]],
                "place": [dice.uniform(0, self.length), dice.uniform(-2, 2), dice.uniform(0, 3)]}

    def convex_set(self):
        """A set with the end's start in it: its expression, and rows b - A (x, y) in cones, y >= 0 of sum 1 the weights of a polytope's corners."""
        dice, size, at = self.dice, self.length*self.dice.uniform(0.02, 0.3), self.start[-1]
        kind = dice.choice(["ball", "box", "cylinder", "cut ball", "polytope"])
        off = np.array([dice.uniform(-0.5, 0.5) for _ in range(3)])*size
        centre = [float(c) for c in at + off]
        eye = np.eye(3)
        if kind == "box":
            half = [size*dice.uniform(0.6, 1.5) for _ in range(3)]
            rows = [[(sign*eye[a], sign*centre[a] + half[a])] for a in range(3) for sign in (1, -1)]
            return {"box": {"centre": centre, "size": [2*h for h in half]}}, rows, None
        if kind == "cylinder":
            up = size*dice.uniform(0.6, 2)
            rows = [[(0*eye[0], size)] + [(-eye[a], -centre[a]) for a in range(2)]] + [[(sign*eye[2], sign*centre[2] + up)] for sign in (1, -1)]
            return {"set": {"translate": {"by": centre, "of": {"product": [{"disc": size}, {"interval": up}]}}}}, rows, None
        if kind == "polytope":
            corners = [list(at + size*np.array([dice.gauss(0, 1) for _ in range(3)])) for _ in range(dice.randint(1, 7))]
            corners.append(list(2*at - np.mean(corners, axis=0)))  # the start is halfway to their middle
            return {"set": {"polytope": [[float(c) for c in corner] for corner in corners]}}, [], np.array(corners)
        ball = [[(0*eye[0], size)] + [(-eye[a], -centre[a]) for a in range(3)]]
        if kind == "ball":
            return {"ball": {"centre": centre, "radius": size}}, ball, None
        normal = np.array([dice.gauss(0, 1) for _ in range(3)])
        offset = float(normal @ at + size*dice.uniform(0, 0.3)*np.linalg.norm(normal))
        cut = {"half_space": {"normal": [float(c) for c in normal], "offset": offset}}
        whole = {"translate": {"by": centre, "of": {"ball": {"radius": size, "dimension": 3}}}}
        return {"set": {"intersection": [whole, cut]}}, ball + [[(normal, offset)]], None

    def text(self):
        vector = lambda v: [float(x) for x in v]  # noqa: E731
        line = {"length": self.length, "elements": self.n, "weight": self.weight, "stiffness": ".inf" if self.kind == 3 else self.stiffness,
                "start": {"straight": {"from": vector(self.start[0]), "to": vector(self.start[-1])}},
                "ends": {"A": "held", "B": "held" if self.held else "free"}}
        if self.set:
            line["ends"]["B"] = {"on": self.set[0]}
        if self.springs:
            line["springs"] = self.springs
        if self.loads:
            line["loads"] = self.loads
        scene = {"capstan": 1, "gravity": [0, 0, -9.81], "lines": {"line": line}, "solver": {"path_tolerance": 0},
                 "history": [{"name": "pull", "line.B": {"position" if self.held else "force": vector(self.end)}}]}
        if self.kind != 2:
            scene["friction_policy"] = "frozen"
        del scene["solver"]
        if self.bed:
            scene["obstacles"] = {"bed": {"plane": {"point": [0, 0, 0], "normal": vector(self.normal)}, "friction": self.friction}}
        if self.gives:
            scene["obstacles"]["bed"]["stiffness"] = self.gives
            line["bearing_width"] = 1
        return json.dumps(scene).replace('".inf"', ".inf")

    # the same as arrays, node by node --------------------------------------------------------------------------------

    def share(self, j, a, b):
        """The part of the length of node j between two arc lengths."""
        l = self.length/self.n
        return max(0.0, min(b, min(self.length, (j + 0.5)*l)) - max(a, max(0.0, (j - 0.5)*l)))

    def potential(self, j):
        """K, K a, and a'K a/2 of node j, where all springs together are without force at a; its loads."""
        k, ka, load = np.zeros((3, 3)), np.zeros(3), np.zeros(3)
        alone, acting = 0.0, 0
        for spring in self.springs:
            if "at" in spring:
                nearest = min(range(self.n + 1), key=lambda i: (abs(i*self.length/self.n - spring["at"]), i))
                by = 1.0 if nearest == j else 0.0
            else:
                by = self.share(j, spring.get("from", 0.0), spring.get("to", self.length))
            (x, y, z), (xy, xz, yz) = spring["stiffness"], spring.get("coupling", [0, 0, 0])
            own = by*np.array([[x, xy, xz], [xy, y, yz], [xz, yz, z]])
            a = np.array(spring["place"]) if "place" in spring else self.start[j]
            k += own
            ka += own @ a
            alone += a @ own @ a/2
            acting += by > 0
        for given in self.loads:
            load += self.share(j, given["from"], given["to"])*np.array(given["force"])
        load[2] -= self.weight*self.share(j, 0, self.length)
        if j == self.n and not self.held:
            load += self.end
        # of one spring without the inverse, which has the rounding of K's condition
        return k, ka, alone if acting == 1 else ka @ np.linalg.pinv(k, hermitian=True) @ ka/2, load

    def scaled(self):
        """The same in units of the length and the weight, and the unit of energy."""
        out = copy.deepcopy(self)
        w, l = self.weight, self.length
        out.length = out.weight = 1.0
        out.stiffness, out.gives = self.stiffness/(w*l), self.gives*l/w
        out.start = [x/l for x in self.start]
        out.end = self.end/(l if self.held else w*l)
        if out.set:
            out.set = None, [[(a, b/l) for a, b in cone] for cone in self.set[1]], None if self.set[2] is None else self.set[2]/l
        for spring in out.springs:
            for key in ("stiffness", "coupling"):
                if key in spring:
                    spring[key] = [k*(1/w if "at" in spring else l/w) for k in spring[key]]
            for key in ("at", "from", "to"):
                if key in spring:
                    spring[key] /= l
            if "place" in spring:
                spring["place"] = [a/l for a in spring["place"]]
        for given in out.loads:
            given |= {"from": given["from"]/l, "to": given["to"]/l, "force": [f/w for f in given["force"]]}
        return out, w*l*l


def minimum(case):
    """The energy at the minimum, the sum of the sizes of its terms, and Clarabel's status."""
    import clarabel
    case, unit = case.scaled()
    n, l = case.n, case.length/case.n
    x = lambda j: 3*j  # noqa: E731
    d, t, v = 3*(n + 1), 3*(n + 1) + n, 3*(n + 1) + 2*n + 1
    y = v + n + 1
    corners = case.set[2] if case.set and case.set[2] is not None else np.zeros((0, 3))
    size = y + len(corners)
    held = {0: case.start[0]} | ({n: case.end} if case.held else {})
    P, q, constant = sparse.lil_matrix((size, size)), np.zeros(size), 0.0
    zero, cones = [], []  # rows A x = b; blocks of rows b - A x in a cone
    tangents = np.linalg.svd(case.normal[None, :])[2][1:]
    for j in range(n + 1):
        k, ka, own, load = case.potential(j)
        P[x(j):x(j) + 3, x(j):x(j) + 3] = k
        q[x(j):x(j) + 3] -= ka + load
        constant += own
        if j in held:
            zero += [({x(j) + a: 1.0}, held[j][a]) for a in range(3)]
            zero += [({t + j: 1.0}, 0.0), ({v + j: 1.0}, 0.0)]
            continue
        if case.bed:  # n.x + v >= 0, v >= 0
            cones.append([({x(j) + a: -case.normal[a] for a in range(3)} | {v + j: -1.0}, 0.0)])
        if case.gives:
            P[v + j, v + j] = case.gives*case.share(j, 0, case.length)
            cones.append([({v + j: -1.0}, 0.0)])
        else:
            zero.append(({v + j: 1.0}, 0.0))
        # S90 (78): the reaction of the start, which has no tension, balances the loads there, with no force on the end as yet
        first = load - (case.end if j == n and not case.held else 0) + ka - k @ case.start[j]
        bound = case.friction*max(0.0, -(first @ case.normal))
        if bound > 0:
            q[t + j] += bound
            from_there = tangents @ case.start[j]
            cones.append([({t + j: -1.0}, 0.0)] + [({x(j) + a: -tangents[i][a] for a in range(3)}, -from_there[i]) for i in range(2)])
        else:
            zero.append(({t + j: 1.0}, 0.0))
    for i in range(n):
        if math.isfinite(case.stiffness):
            P[d + i, d + i] = l*case.stiffness
            cones.append([({d + i: -1.0}, 0.0)])
        else:
            zero.append(({d + i: 1.0}, 0.0))
        cones.append([({d + i: -1.0}, 1.0)] + [({x(i + 1) + a: -1/l, x(i) + a: 1/l}, 0.0) for a in range(3)])
    if case.set:
        cones += [[({x(n) + a: row[a] for a in range(3)}, right) for row, right in cone] for cone in case.set[1]]
    if len(corners):
        zero += [({x(n) + a: 1.0} | {y + k: -corners[k][a] for k in range(len(corners))}, 0.0) for a in range(3)]
        zero.append(({y + k: 1.0 for k in range(len(corners))}, 1.0))
        cones += [[({y + k: -1.0}, 0.0)] for k in range(len(corners))]
    rows = zero + [row for cone in cones for row in cone]
    A = sparse.lil_matrix((len(rows), size))
    for r, (entries, _) in enumerate(rows):
        for column, value in entries.items():
            A[r, column] = value
    b = np.array([right for _, right in rows])
    kinds = [clarabel.ZeroConeT(len(zero))]
    kinds += [clarabel.NonnegativeConeT(1) if len(cone) == 1 else clarabel.SecondOrderConeT(len(cone)) for cone in cones]
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_iter = 400
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = TIGHT
    out = clarabel.DefaultSolver(sparse.triu(P.tocsc(), format="csc"), q, A.tocsc(), b, kinds, settings).solve()
    point = np.array(out.x)
    parts = np.abs(q*point).sum() + 0.5*np.abs(point*(P @ point)).sum() + abs(constant)
    return unit*float(out.obj_val + constant), unit*float(parts), str(out.status)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--capstan", default=os.path.join(HERE, "..", "build", "release", "cli", "capstan"))
    options.add_argument("--count", type=int, default=50)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--keep", help="folder for the scenes")
    given = options.parse_args()
    worst, bad = {}, 0
    for kind, i in [(i % 5, i) for i in range(given.count)] + [(5, i) for i in range(given.count)]:
        case = Case(kind, random.Random(f"annexes {given.seed + i}"))
        folder = os.path.join(given.keep, f"{kind}-{given.seed + i}") if given.keep else tempfile.mkdtemp()
        os.makedirs(folder, exist_ok=True)
        path, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
        with open(path, "w", encoding="ascii") as file:
            file.write(case.text())
        done = subprocess.run([given.capstan, "run", "-q", "--force", "--no-paraview", "-o", out, path], capture_output=True, text=True)
        if done.returncode != 0:
            print(f"{given.seed + i}, {KINDS[kind]}: capstan run: {done.returncode}, {done.stderr.strip()[-200:]}")
            bad += 1
            continue
        primal, = Results(os.path.join(out, "result.nc")).get("line_primal", 0)
        energy, parts, status = minimum(case)
        off = abs(primal - energy)/parts
        worst[kind] = max(worst.get(kind, 0.0), off)
        if not off <= ACCURACY:
            bad += 1
            print(f"{given.seed + i}, {KINDS[kind]}: capstan {primal!r} J, Clarabel {energy!r} J ({status}), off by {off:.1e}")
    for kind, off in sorted(worst.items()):
        print(f"{KINDS[kind]}: energies off by at most {off:.1e}")
    print(f"{2*given.count} cases, {bad} not agreed")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
