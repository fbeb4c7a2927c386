#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Ask random convex sets the same questions with capstan and with general conic solvers, and compare.

    compare_sets.py [--capstan PROGRAM] [--cases 500] [--seed 1] [--solvers clarabel,ecos,scs] [--csv FILE] [--show CASE]

A case is a random expression (n <= 6 components, depth <= 3) of the words of law files, a velocity V and a force F. `capstan
law` answers it: phi(V), which is the support at -V; the distance of F from the set, 0 where it contains F; and, asked of the
set's polar, its gauge at F. The same three numbers come from cone programs written here from the expression by two mutual
recursions, which share nothing with the library:

    member(C, x, t)    x in t C        above(C, w, s)    h_C(w) <= s        (the polar of a set turns one into the other)

    support at w   from below  max <w, x> : member(C, x, 1)                     from above  min s : above(C, w, s)
    distance of F  from below  max <w, F> - s : above(C, w, s), |w| <= 1        from above  min |F - x| : member(C, x, 1)
    gauge at F     from below  max <F, x> : above(C, x, 1)                      from above  min t : member(C, F, t)

Each pair is a program and its dual, so that every answer is bracketed, and where answers differ it is seen who is off. A set
without 0, or empty, is no law: capstan must refuse it, and the solvers must find 0 at a distance, or nothing at all.

Differences are relative to the value or to 1, whichever is larger (data are of size 1). Solvers are asked for 1e-12, and where
they do not get there for tenfold less, down to 1e-8 (SCS, a first-order method, for 1e-10). They are installed as by compare.py."""
import argparse
import csv
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import compare

ROOT = compare.ROOT
LOOSER = [1e-12, 1e-11, 1e-10, 1e-9, 1e-8]  # tolerances asked for one after the other

if __name__ == "__main__":
    compare.enter_environment()
    os.environ["OMP_NUM_THREADS"] = "1"
    import numpy as np
    from scipy import sparse

# cone programs ---------------------------------------------------------------------------------------------------------


class Affine:
    """A number that depends on the unknowns: sum of factors times unknowns, and a constant."""

    def __init__(self, terms=None, constant=0.0):
        self.terms, self.constant = terms or {}, constant

    def __add__(self, other):
        other = other if isinstance(other, Affine) else Affine(constant=other)
        terms = dict(self.terms)
        for k, factor in other.terms.items():
            terms[k] = terms.get(k, 0.0) + factor
        return Affine(terms, self.constant + other.constant)

    def __mul__(self, factor):
        return Affine({k: v*factor for k, v in self.terms.items()}, self.constant*factor)

    def __sub__(self, other):
        return self + (other*-1.0 if isinstance(other, Affine) else -other)

    __radd__, __rmul__ = __add__, __mul__


def apply(matrix, x):
    return [sum((x[j]*row[j] for j in range(len(x)) if row[j]), Affine()) for row in matrix]


def transpose(matrix):
    return [list(column) for column in zip(*matrix)]


class Program:
    """min cost over the unknowns, with rows that are 0, not negative, or in a second-order cone."""

    def __init__(self):
        self.unknowns, self.zero, self.positive, self.cones = 0, [], [], []

    def unknown(self):
        self.unknowns += 1
        return Affine({self.unknowns - 1: 1.0})

    def vector(self, n):
        return [self.unknown() for _ in range(n)]

    def equal(self, x, y):
        self.zero += [a - b for a, b in zip(x, y)]

    def at_least(self, x, y=0.0):
        self.positive.append(x - y if isinstance(x, Affine) else Affine(constant=x) - y)

    def norm(self, x, bound):
        """|x| <= bound"""
        self.cones.append([bound] + x)

    def matrices(self, cost):
        """min q.u, b - A u in K, with the dimensions of K"""
        rows = self.zero + self.positive + [row for cone in self.cones for row in cone]
        entries = [(i, k, -v) for i, row in enumerate(rows) for k, v in row.terms.items() if v]
        i, k, v = zip(*entries) if entries else ((), (), ())
        a = sparse.csc_matrix((v, (i, k)), shape=(len(rows), self.unknowns))
        q = np.zeros(self.unknowns)
        for k, factor in cost.terms.items():
            q[k] = factor
        return q, a, np.array([row.constant for row in rows]), [len(cone) for cone in self.cones]


# sets: member and above -------------------------------------------------------------------------------------------------


def sides(value):
    return [(-s, s) if isinstance(s, (int, float)) else tuple(s) for s in value]


def space(c):
    (word, value), = c.items()
    if word == "ball":
        return value["dimension"]
    if word in ("interval", "disc"):
        return 1 if word == "interval" else 2
    if word in ("ellipsoid", "box"):
        return len(value)
    if word in ("polytope", "segment", "subspace"):
        return len(value[0])
    if word == "strip":
        return len(value["normal"])
    if word == "inequalities":
        return len(value["rows"][0])
    if word == "product":
        return sum(space(part) for part in value)
    if word in ("intersection", "sum", "hull"):
        return space(value[0])
    if word == "preimage":
        return len(value["map"][0])
    if word == "image":
        return len(value["map"])
    return space(value if word == "polar" else value["of"])


def split(c, x):
    parts, at = [], 0
    for part in c["product"]:
        parts.append((part, x[at:at + space(part)]))
        at += space(part)
    return parts


def member(p, c, x, t):
    """x in t C, for t >= 0 given elsewhere"""
    (word, value), = c.items()
    if word in ("ball", "disc"):
        p.norm(x, t*(value if word == "disc" else value["radius"]))
    elif word == "ellipsoid":
        p.norm(apply(np.linalg.inv(np.linalg.cholesky(np.array(value))).tolist(), x), t)
    elif word in ("box", "interval"):
        for xi, (low, high) in zip(x, sides(value if word == "box" else [value])):
            p.at_least(xi - t*low)
            p.at_least(t*high - xi)
    elif word in ("polytope", "segment"):
        weight = p.vector(len(value))
        p.equal(x, apply(transpose(value), weight))
        p.equal([sum(weight, Affine())], [t])
        for w in weight:
            p.at_least(w)
    elif word == "strip":
        along = apply([value["normal"]], x)[0]
        p.at_least(t*(0.5*value["width"]) - along)
        p.at_least(t*(0.5*value["width"]) + along)
    elif word == "inequalities":
        for along, offset in zip(apply(value["rows"], x), value["offsets"]):
            p.at_least(t*offset - along)
    elif word == "subspace":
        p.equal(x, apply(transpose(value), p.vector(len(value))))
    elif word == "product":
        for part, xs in split(c, x):
            member(p, part, xs, t)
    elif word == "intersection":
        for part in value:
            member(p, part, x, t)
    elif word == "sum":
        xs = [p.vector(len(x)) for _ in value]
        p.equal(x, [sum(column, Affine()) for column in zip(*xs)])
        for part, xi in zip(value, xs):
            member(p, part, xi, t)
    elif word == "hull":
        xs, ts = [p.vector(len(x)) for _ in value], p.vector(len(value))
        p.equal(x, [sum(column, Affine()) for column in zip(*xs)])
        p.equal([sum(ts, Affine())], [t])
        for part, xi, ti in zip(value, xs, ts):
            p.at_least(ti)
            member(p, part, xi, ti)
    elif word == "preimage":
        member(p, value["of"], apply(value["map"], x), t)
    elif word == "image":
        y = p.vector(space(value["of"]))
        p.equal(x, apply(value["map"], y))
        member(p, value["of"], y, t)
    elif word == "translate":
        member(p, value["of"], [xi - t*b for xi, b in zip(x, value["by"])], t)
    elif word == "scale":
        member(p, value["of"], x, t*value["by"]) if value["by"] > 0 else member(p, value["of"], [xi*-1.0 for xi in x], t*-value["by"])
    elif word == "polar":
        above(p, value, x, t)
    else:
        raise ValueError(word)


def above(p, c, w, s):
    """h_C(w) <= s"""
    (word, value), = c.items()
    if word in ("ball", "disc"):
        radius = value if word == "disc" else value["radius"]
        p.norm([wi*radius for wi in w], s)
    elif word == "ellipsoid":
        p.norm(apply(np.linalg.cholesky(np.array(value)).T.tolist(), w), s)
    elif word in ("box", "interval"):
        reach = p.vector(len(w))
        for r, wi, (low, high) in zip(reach, w, sides(value if word == "box" else [value])):
            p.at_least(r - wi*low)
            p.at_least(r - wi*high)
        p.at_least(s - sum(reach, Affine()))
    elif word in ("polytope", "segment"):
        for along in apply(value, w):
            p.at_least(s - along)
    elif word == "strip":
        factor = p.unknown()
        p.equal(w, [factor*a for a in value["normal"]])
        p.at_least(s - factor*(0.5*value["width"]))
        p.at_least(s + factor*(0.5*value["width"]))
    elif word == "inequalities":
        factor = p.vector(len(value["rows"]))
        p.equal(w, apply(transpose(value["rows"]), factor))
        p.at_least(s - apply([value["offsets"]], factor)[0])
        for f in factor:
            p.at_least(f)
    elif word == "subspace":
        p.equal(apply(value, w), [Affine()]*len(value))
        p.at_least(s)
    elif word in ("product", "sum"):
        parts = split(c, w) if word == "product" else [(part, w) for part in value]
        share = p.vector(len(parts))
        for (part, wi), si in zip(parts, share):
            above(p, part, wi, si)
        p.at_least(s - sum(share, Affine()))
    elif word == "intersection":
        ws, share = [p.vector(len(w)) for _ in value], p.vector(len(value))
        p.equal(w, [sum(column, Affine()) for column in zip(*ws)])
        for part, wi, si in zip(value, ws, share):
            above(p, part, wi, si)
        p.at_least(s - sum(share, Affine()))
    elif word == "hull":
        for part in value:
            above(p, part, w, s)
    elif word == "preimage":
        v = p.vector(len(value["map"]))
        p.equal(w, apply(transpose(value["map"]), v))
        above(p, value["of"], v, s)
    elif word == "image":
        above(p, value["of"], apply(transpose(value["map"]), w), s)
    elif word == "translate":
        above(p, value["of"], w, s - apply([value["by"]], w)[0])
    elif word == "scale":
        above(p, value["of"], [wi*value["by"] for wi in w], s)
    elif word == "polar":
        # h of the polar is the gauge of the closed hull of C and 0
        inside, rest = p.unknown(), p.unknown()
        p.at_least(inside)
        p.at_least(rest)
        p.at_least(s - inside - rest)
        member(p, value, w, inside)
    else:
        raise ValueError(word)


# questions ---------------------------------------------------------------------------------------------------------------


def constants(x):
    return [Affine(constant=value) for value in x]


def support_from_below(c, w):
    p = Program()
    x = p.vector(len(w))
    member(p, c, x, Affine(constant=1.0))
    return p, apply([w], x)[0]*-1.0, -1.0


def support_from_above(c, w):
    p = Program()
    s = p.unknown()
    above(p, c, constants(w), s)
    return p, s, 1.0


def distance_from_below(c, point):
    p = Program()
    w, s, one = p.vector(len(point)), p.unknown(), Affine(constant=1.0)
    p.norm(w, one)
    above(p, c, w, s)
    return p, s - apply([point], w)[0], -1.0


def distance_from_above(c, point):
    p = Program()
    x, d = p.vector(len(point)), p.unknown()
    member(p, c, x, Affine(constant=1.0))
    p.norm([xi - f for xi, f in zip(x, point)], d)
    return p, d, 1.0


def gauge_from_below(c, point):
    return support_from_below({"polar": c}, point)


def gauge_from_above(c, point):
    p = Program()
    t = p.unknown()
    p.at_least(t)
    member(p, c, constants(point), t)
    return p, t, 1.0


QUESTIONS = {"support, from below": support_from_below, "support, from above": support_from_above,
             "distance, from below": distance_from_below, "distance, from above": distance_from_above,
             "gauge, from below": gauge_from_below, "gauge, from above": gauge_from_above}

# solvers: (value, note); value inf: no feasible point, -inf: unbounded, nan: no answer --------------------------------------


def by_clarabel(q, a, b, zero, positive, cones):
    import clarabel
    kinds = [clarabel.ZeroConeT(zero), clarabel.NonnegativeConeT(positive)] + [clarabel.SecondOrderConeT(n) for n in cones]
    for tolerance in LOOSER:
        settings = clarabel.DefaultSettings()
        settings.verbose, settings.max_iter = False, 500
        settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
        found = clarabel.DefaultSolver(sparse.csc_matrix((len(q), len(q))), q, a, b, kinds, settings).solve()
        status = str(found.status)
        if status == "Solved":
            return float(q @ np.array(found.x)), "" if tolerance == LOOSER[0] else f"to {tolerance:.0e}"
        if status in ("PrimalInfeasible", "DualInfeasible"):
            return math.inf if status == "PrimalInfeasible" else -math.inf, status
    return math.nan, status


def by_ecos(q, a, b, zero, positive, cones):
    import ecos
    for tolerance in LOOSER:
        found = ecos.solve(q, a[zero:], b[zero:], {"l": positive, "q": cones, "e": 0}, a[:zero] if zero else None,
                           b[:zero] if zero else None, verbose=False, abstol=tolerance, reltol=tolerance, feastol=tolerance,
                           max_iters=200)
        flag = found["info"]["exitFlag"]
        if flag == 0:
            return float(q @ found["x"]), "" if tolerance == LOOSER[0] else f"to {tolerance:.0e}"
        if flag in (1, 2):
            return math.inf if flag == 1 else -math.inf, "infeasible" if flag == 1 else "unbounded"
    return math.nan, f"flag {flag}"


def by_scs(q, a, b, zero, positive, cones):
    import scs
    data = {"A": a, "b": b, "c": q}
    found = scs.solve(data, {"z": zero, "l": positive, "q": cones}, verbose=False, eps_abs=1e-10, eps_rel=1e-10,
                      eps_infeas=1e-10, max_iters=20000)
    status = found["info"]["status"]
    if status == "solved":
        return float(q @ found["x"]), ""
    return {"infeasible": math.inf, "unbounded": -math.inf}.get(status, math.nan), status


SOLVERS = {"clarabel": by_clarabel, "ecos": by_ecos, "scs": by_scs}


def solve(solver, question, c, x):
    program, cost, sign = QUESTIONS[question](c, x)
    q, a, b, cones = program.matrices(cost)
    value, note = apart(SOLVERS[solver], q, a, b, len(program.zero), len(program.positive), cones)
    return sign*value, note


def apart(function, *arguments):
    """in a process of its own: a solver that raises or crashes has not answered, and is gone"""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        answer = (math.nan, "gave up")
        try:
            answer = function(*arguments)
        finally:
            os.write(writer, json.dumps(answer).encode())
            os._exit(0)
    os.close(writer)
    with os.fdopen(reader) as stream:
        answer = stream.read()
    status = os.waitpid(child, 0)[1]
    return tuple(json.loads(answer)) if answer else (math.nan, f"crashed by signal {os.WTERMSIG(status)}")


# random expressions --------------------------------------------------------------------------------------------------------


class Draw:
    def __init__(self, seed):
        self.random = random.Random(seed)

    def number(self, low=-1.0, high=1.0):
        return round(self.random.uniform(low, high), 6)

    def vector(self, n):
        return [self.number() for _ in range(n)]

    def matrix(self, rows, columns):
        """often of full rank, sometimes with a row or column of zeros, or two rows alike"""
        m = [self.vector(columns) for _ in range(rows)]
        if self.random.random() < 0.15:
            m[self.random.randrange(rows)] = [0.0]*columns
        if rows > 1 and self.random.random() < 0.15:
            m[0] = list(m[1])
        return m

    def primitive(self, n):
        r = self.random
        kinds = ["ball", "ellipsoid", "box", "polytope", "strip", "inequalities", "segment"]
        kinds += {1: ["interval"], 2: ["disc", "disc"]}.get(n, [])
        word = r.choice(kinds)
        if word == "ball":
            return {"ball": {"radius": self.number(0.2, 2), "dimension": n}}
        if word == "disc":
            return {"disc": self.number(0.2, 2)}
        if word == "interval":
            return {"interval": self.number(0.2, 2) if r.random() < 0.5 else [self.number(-1, 0), self.number(0, 1)]}
        if word == "ellipsoid":
            g = np.array([[self.number() for _ in range(n)] for _ in range(n)])
            return {"ellipsoid": (np.round(g @ g.T, 6) + 0.05*np.eye(n)).tolist()}
        if word == "box":
            return {"box": [self.number(0.1, 2) if r.random() < 0.6 else [self.number(-1, 0), self.number(0, 1)] for _ in range(n)]}
        if word == "polytope":
            points = [self.vector(n) for _ in range(r.randint(2, 2*n + 3))]
            return {"polytope": points + [[-x for x in p] for p in points[:r.randint(1, len(points))]]}
        if word == "segment":
            end = self.vector(n)
            return {"segment": [end, [-self.number(0, 1)*x for x in end]]}
        if word == "strip":
            return {"strip": {"normal": self.vector(n), "width": self.number(0.1, 2)}}
        return {"inequalities": {"rows": [self.vector(n) for _ in range(n + 2)], "offsets": [self.number(0.05, 1) for _ in range(n + 2)]}}

    def expression(self, n, depth):
        r = self.random
        if depth == 0 or r.random() < 0.15:
            return self.primitive(n)
        words = ["intersection", "preimage", "image", "sum", "hull", "polar", "scale", "translate"] + (["product"]*2 if n > 1 else [])
        word = r.choice(words)
        if word == "product":
            first = r.randint(1, n - 1)
            return {"product": [self.expression(first, depth - 1), self.expression(n - first, depth - 1)]}
        if word in ("intersection", "sum", "hull"):
            return {word: [self.expression(n, depth - 1) for _ in range(r.randint(2, 3))]}
        if word == "preimage":
            m = r.randint(1, 6)
            return {"preimage": {"map": self.matrix(m, n), "of": self.expression(m, depth - 1)}}
        if word == "image":
            m = r.randint(1, 6)
            return {"image": {"map": self.matrix(n, m), "of": self.expression(m, depth - 1)}}
        if word == "polar":
            return {"polar": self.expression(n, depth - 1)}
        if word == "scale":
            return {"scale": {"by": self.number(-2, 2) or 1.0, "of": self.expression(n, depth - 1)}}
        return {"translate": {"by": [0.3*x for x in self.vector(n)], "of": self.expression(n, depth - 1)}}


# capstan -----------------------------------------------------------------------------------------------------------------


def text(numbers):
    return ",".join(repr(float(x)) for x in numbers)


def ask(capstan, folder, law, *arguments):
    path = os.path.join(folder, "law.yaml")
    with open(path, "w", encoding="ascii") as file:
        file.write(f"capstan: 1\nlaw: {json.dumps(law)}\n")
    done = subprocess.run([capstan, "law", path, "--json", *arguments], capture_output=True, text=True, timeout=120, check=False)
    if done.returncode not in (0, 1):
        return None, done.stderr.strip().rsplit(": ", 1)[-1]
    return json.loads(done.stdout), ""


def ask_capstan(capstan, folder, c, velocity, force):
    """(value, note) by question: inf where unbounded, nan where left open; None: refused, with the reason"""
    zero = text([0.0]*len(force))
    found, reason = ask(capstan, folder, c, f"--velocity={text(velocity)}", f"--velocity={zero}", f"--force={text(force)}", f"--force={text(force)}")
    if not found:
        return None, reason
    first = found["answers"][0]
    outcome = first["forces"].get("outcome", "CPS_SET_OUTCOME_ANSWERED") if first["dissipation_W"] is None else "CPS_SET_OUTCOME_ANSWERED"
    value = {"CPS_SET_OUTCOME_UNBOUNDED": math.inf}.get(outcome, first["dissipation_W"])
    answers = {"support": (math.nan if value is None else value, "exact" if first["exact"] else outcome if value is None else "")}
    outside = found["pairs"][1]["outside_N"]
    answers["distance"] = (math.nan if outside is None else outside, "")
    found, reason = ask(capstan, folder, {"polar": c}, f"--velocity={text([-x for x in force])}")
    if found:
        first = found["answers"][0]
        unbounded = first["forces"].get("outcome") == "CPS_SET_OUTCOME_UNBOUNDED"
        value = math.inf if unbounded else first["dissipation_W"]
        answers["gauge"] = (math.nan if value is None else value, "exact" if first["exact"] else "")
    else:
        answers["gauge"] = (math.nan, reason)
    return answers, ""


# all together -------------------------------------------------------------------------------------------------------------



def difference(x, y):
    if x == y:
        return 0.0
    if math.isinf(x) or math.isinf(y):
        return math.inf
    return abs(x - y)/max(1.0, abs(x), abs(y))


def compare_case(options, folder, case):
    draw = Draw(1000003*options.seed + case)
    n = draw.random.randint(1, 6)
    c = draw.expression(n, 3)
    velocity, force = draw.vector(n), [2*x for x in draw.vector(n)]
    answers, reason = ask_capstan(options.capstan, folder, c, velocity, force)
    row = {"case": case, "components": n, "expression": json.dumps(c)}
    if answers is None:
        # no law: 0 is not in the set, or nothing is
        empty = "no force goes with any velocity" in reason
        for solver in options.solvers:
            value, note = solve(solver, "distance, from above", c, [0.0]*n)
            agrees = math.isinf(value) if empty else 1e-9 < value < math.inf
            yield row | {"question": "holds 0", "capstan": math.inf if empty else 1.0, "how": "empty" if empty else "without 0",
                         "solver": solver, "value": value, "note": note,
                         "difference": math.nan if math.isnan(value) else 0.0 if agrees else math.inf}
        return
    for question in QUESTIONS:
        mine, how = answers[question.split(",")[0]]
        x = [-v for v in velocity] if question.startswith("support") else force
        for solver in options.solvers:
            value, note = solve(solver, question, c, x)
            yield row | {"question": question, "capstan": mine, "how": how, "solver": solver, "value": value,
                         "difference": math.nan if math.isnan(mine) or math.isnan(value) else difference(mine, value), "note": note}


def report(rows, solvers):
    print(f"\n{'question':22} {'solver':9} {'cases':>6} {'median':>9} {'90 %':>9} {'99 %':>9} {'largest':>9} "
          f"{'solver open':>11} {'capstan open':>12}")
    for question in ["holds 0"] + list(QUESTIONS):
        for solver in solvers:
            own = [r for r in rows if r["question"] == question and r["solver"] == solver]
            found = sorted(r["difference"] for r in own if not math.isnan(r["difference"]))
            if not found:
                continue
            quantile = [found[min(len(found) - 1, int(share*len(found)))] for share in (0.5, 0.9, 0.99, 1.0)]
            print(f"{question:22} {solver:9} {len(own):6} " + " ".join(f"{q:9.1e}" for q in quantile) +
                  f" {sum(math.isnan(r['value']) for r in own):11} {sum(math.isnan(r['capstan']) for r in own):12}")


def brackets(rows):
    """how far capstan's answers are outside the tightest bracket, from below to above, that a solver gives them"""
    print(f"\n{'bracketed':10} {'cases':>6} {'width: median':>14} {'largest':>9} {'capstan outside by: 99 %':>25} {'largest':>9}")
    for quantity in ("support", "distance", "gauge"):
        cases = {}
        for r in rows:
            if r["question"].startswith(quantity) and math.isfinite(r["value"]) and math.isfinite(r["capstan"]):
                cases.setdefault(r["case"], {}).setdefault(r["solver"], {})[r["question"]] = r["value"]
                cases[r["case"]]["capstan"] = r["capstan"]
        width, outside = [], []
        for found in cases.values():
            mine = found.pop("capstan")
            pairs = [sorted(ends.values()) for ends in found.values() if len(ends) == 2]
            if pairs:
                low, high = min(pairs, key=lambda ends: ends[1] - ends[0])
                width.append((high - low)/max(1.0, abs(mine)))
                outside.append(max(0.0, low - mine, mine - high)/max(1.0, abs(mine)))
        width.sort()
        outside.sort()
        if width:
            print(f"{quantity:10} {len(width):6} {width[len(width)//2]:14.1e} {width[-1]:9.1e} "
                  f"{outside[int(0.99*len(outside))]:25.1e} {outside[-1]:9.1e}")


def write_csv(rows, solvers, path):
    """one row per case and question: capstan's answer, and by how much each solver's differs (empty: it has none)"""
    table = {}
    for r in rows:
        line = table.setdefault((r["case"], r["question"]), [r["case"], r["components"], r["question"], f"{r['capstan']:.15g}", r["how"]])
        line.append("" if math.isnan(r["difference"]) else f"{r['difference']:.1e}")
    with open(path, "w", newline="", encoding="ascii") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "components", "question", "capstan", "how"] + solvers)
        writer.writerows(table.values())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    places = [os.path.join(ROOT, "build", preset, "cli", "capstan") for preset in ("release", "dev")]
    parser.add_argument("--capstan", default=next((p for p in places if os.path.exists(p)), places[0]))
    parser.add_argument("--cases", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--solvers", default="clarabel,ecos", help="of " + ", ".join(SOLVERS) + " (default: %(default)s)")
    parser.add_argument("--show", type=int, help="only this case, with its expression")
    parser.add_argument("--csv", help="also write the cases to this file")
    options = parser.parse_args()
    options.solvers = options.solvers.split(",")
    if set(options.solvers) - set(SOLVERS):
        sys.exit(f"compare_sets: unknown solver: expected some of {', '.join(SOLVERS)}")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for case in range(options.cases) if options.show is None else [options.show]:
            rows += compare_case(options, folder, case)
            worst = max((r["difference"] for r in rows if r["case"] == case and not math.isnan(r["difference"])), default=0.0)
            if worst > 1e-6 or options.show is not None:
                for r in rows:
                    if r["case"] == case:
                        print(f"case {case}: {r['question']}: capstan {r['capstan']!r} ({r['how']}), {r['solver']} {r['value']!r} ({r['note']})")
                if options.show is not None:
                    print(rows[-1]["expression"])
    report(rows, options.solvers)
    brackets(rows)
    if options.csv:
        write_csv(rows, options.solvers, options.csv)


if __name__ == "__main__":
    main()
