# SPDX-License-Identifier: BSD-3-Clause
"""Random steps by the methods of S90: study, --judge, --complete and the regularised history against a minimisation of their own
energies (cable_minimum.py), which has no code in common with the library.    usage: random_steps.py CAPSTAN [--scenes N] [--seed S] [--only K]

A line starts straight on a plane, level or not, and one to three steps pull its end B aside, lift it, or hold it nearer or farther. The
reference and the bounds A_R of the first step are known from its weight, (78); those of the next are the ones that the minimisation has
found. One scene in six starts from nodes instead: any x_R, slack, bent, stretched or partly in the air, with any R_R or A_R. All numbers are scaled at random; the comparison is in units of the line's length and weight.
"""
import argparse
import csv
import math
import os
import random
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from cable_minimum import Step, dot, least_energy, minimise, norm, sub  # noqa: E402

VERBS = ("study", "judge", "complete", "history")
FEATURES = ("zones", "graded", "lifted", "slope", "inextensible", "ellipse", "strict", "smooth", "default_friction", "held")
NODES = 10000  # scenes from this number on start from nodes


class Wrong(Exception):
    pass


def need(condition, text):
    if not condition:
        raise Wrong(text)


class Scene:
    """A scene in units of length L and weight w L, and its text in metres and newtons."""

    def __init__(self, draw, verb, nodes=False):
        self.verb, self.draw, self.nodes = verb, draw, None
        take = lambda p: draw.random() < p
        solutions = verb in ("judge", "complete")
        self.features = {f for f, p in zip(FEATURES, (0.4, 0.4, 0.45, 0.3, 0.3 if solutions else 0.05, 0.1, 0.25 if verb != "history" else 0.0,
                                                      0.5 if verb == "complete" else 0.1 if verb == "judge" else 0.0, 0.4, 0.4)) if take(p)}
        if verb == "complete" and "smooth" in self.features:
            self.features |= {"held"}
            self.features -= {"slope"}
        has = self.features.__contains__
        self.count = draw.randint(5, 9)
        raw = [math.exp(draw.uniform(0, math.log(20))) if has("graded") else 1.0 for _ in range(self.count)]
        self.lengths = [r / sum(raw) for r in raw]
        self.arc = [0.0]
        for l in self.lengths:
            self.arc.append(self.arc[-1] + l)
        self.stiffness = 10 ** draw.uniform(0.3, 2.5)
        self.mu = 0.0 if has("smooth") else draw.uniform(0.1, 0.9)
        self.zones = self.draw_zones() if has("zones") else []
        tilt = draw.uniform(-0.4, 0.4) * min(1.0, self.mu) if has("slope") else 0.0
        turn = draw.uniform(0, 2 * math.pi)
        self.normal = (math.sin(tilt) * math.cos(turn), math.sin(tilt) * math.sin(turn), math.cos(tilt))
        heading = draw.uniform(0, 2 * math.pi)
        flat = (math.cos(heading), math.sin(heading), 0.0)
        along = tuple(c - dot(flat, self.normal) * n for c, n in zip(flat, self.normal))
        self.along = tuple(c / norm(along) for c in along)
        n, a = self.normal, self.along
        self.across = (n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0])
        self.origin = tuple(draw.uniform(-1, 1) for _ in range(3))
        if nodes:
            self.features |= {"nodes"}
            self.draw_nodes()
        # units
        self.length, self.weight = 10 ** draw.uniform(-1, 2), 10 ** draw.uniform(-1, 2)
        # of steps from a slack start that is nowhere held the places are not unique, and so the reference of the next: one step, but by the
        # regularised method, whose places are
        more = draw.random() < 0.3 and not has("smooth") and not nodes
        self.steps = [self.draw_step(k) for k in range(draw.randint(2, 3) if verb == "history" else 1 + more)]

    def draw_nodes(self):
        """x_R and the push on each node: a line that bends in the plane, its elements at their length, shorter or stretched, perhaps up in the
        air at the end."""
        u, take = self.draw.uniform, lambda p: self.draw.random() < p
        angle, x = u(-0.5, 0.5), [(0.0, 0.0, 0.0)]
        up = self.draw.randint(1, 3) if "lifted" in self.features and take(0.5) else 0
        for e, l in enumerate(self.lengths):
            angle += u(-0.6, 0.6)
            size = l * (1.0 if take(0.4) else u(0.6, 1.0) if take(0.5) or "inextensible" in self.features else 1 + u(0, 0.5) / self.stiffness)
            rise = size * u(0.1, 0.6) if e >= self.count - up else 0.0
            flat = math.sqrt(size * size - rise * rise)
            x.append((x[-1][0] + flat * math.cos(angle), x[-1][1] + flat * math.sin(angle), x[-1][2] + rise))
        self.nodes = [self.place(*p) for p in x]
        self.push = [0.0 if p[2] > 0 or take(0.2) else self.normal[2] * self.share(j) * u(0, 2) for j, p in enumerate(x)]
        self.gives_bound, self.gives_arc = self.mu > 0 and "ellipse" not in self.features and take(0.5), take(0.3)

    def table(self):
        """The nodes as the file that the scene names. A tension of the reference is of no account beside R_R or A_R."""
        L, force = self.length, self.length * self.weight
        rows = []
        for j, p in enumerate(self.nodes):
            row = [repr(self.arc[j] * L)] if self.gives_arc else []
            row += [repr(c * L) for c in p] + ["" if j == 0 else repr(self.draw.uniform(0, 3) * force)]
            rows.append(row + [repr((self.mu * self.factor(j) if self.gives_bound else 1.0) * self.push[j] * force)])
        names = (["arc_length"] if self.gives_arc else []) + ["x", "y", "z", "tension", "friction_bound" if self.gives_bound else "reaction"]
        return "\n".join(",".join(row) for row in [names, *rows]) + "\n"

    def draw_zones(self):
        cuts = sorted(self.draw.uniform(0, 1) for _ in range(4))
        low = 0.3 if self.verb in ("history", "study") else 0.0
        factor = lambda: 0.0 if low == 0 and self.draw.random() < 0.4 else self.draw.uniform(max(low, 0.2), 3)
        return [(a, b, factor()) for a, b in (cuts[:2], cuts[2:])][:self.draw.randint(1, 2)]

    def place(self, x, y, z):
        return tuple(o + x * a + y * c + z * n for o, a, c, n in zip(self.origin, self.along, self.across, self.normal))

    def draw_step(self, k):
        """('force', f) or ('place', x) of end B."""
        u = self.draw.uniform
        lift = "lifted" in self.features
        if "held" in self.features:
            stretch = 1.0 if "inextensible" in self.features else 1 + 0.5 / self.stiffness
            far = u(0.3, 0.97) if self.draw.random() < 0.75 or self.verb == "complete" else u(0.97, stretch)
            if self.verb == "history":
                far = u(0.99, stretch)
            z = 0.0 if not lift else u(0, 0.9) * self.lengths[-1] if self.draw.random() < 0.5 else u(0.05, 0.35) * far
            angle = u(-0.4, 0.4)
            flat = math.sqrt(max(0.0, far * far - z * z))
            return "place", self.place(flat * math.cos(angle), flat * math.sin(angle), z)
        size = self.mu * 10 ** u(-0.7, 0.5) if self.mu > 0 else 10 ** u(-0.7, 0.5)
        angle = u(-2.5, 2.5)
        up = (u(0.0, 0.6) * (1 + k) / 3) if lift else 0.0
        f = (size * math.cos(angle), size * math.sin(angle), up)
        return "force", tuple(f[0] * a + f[1] * c + f[2] * n for a, c, n in zip(self.along, self.across, self.normal))

    def factor(self, j):
        low = self.arc[j] - (self.lengths[j - 1] / 2 if j > 0 else 0)
        high = self.arc[j] + (self.lengths[j] / 2 if j < self.count else 0)
        total = high - low
        for a, b, f in self.zones:
            total += (f - 1) * max(0.0, min(b, high) - max(a, low))
        return max(0.0, total / (high - low))

    def share(self, j):
        return (self.lengths[j - 1] / 2 if j > 0 else 0) + (self.lengths[j] / 2 if j < self.count else 0)

    def text(self):
        L, w = self.length, self.weight
        vector = lambda v, unit: "[" + ", ".join(repr(c * unit) for c in v) + "]"
        end = self.nodes[-1] if self.nodes else self.place(1, 0, 0)
        friction = f"friction: {{axial: {self.mu!r}, lateral: {self.mu / 2!r}}}" if "ellipse" in self.features else f"friction: {self.mu!r}"
        lines = ["capstan: 1"]
        if "default_friction" not in self.features or self.verb in ("judge", "complete"):
            lines.append("friction_policy: frozen")
        if "strict" in self.features:
            lines.append("contact_policy: reference")
        if "default_friction" in self.features and self.draw.random() < 0.5:
            lines.append("solver: {path_tolerance: 0.01}")
        if self.verb in ("judge", "complete"):
            lines = [l for l in lines if not l.startswith("solver")]
        lines += [f"obstacles: {{bed: {{plane: {{point: {vector(self.origin, L)}, normal: {vector(self.normal, 1)}}}, {friction}}}}}",
                  "lines:", "  rope:", f"    length: {L!r}",
                  "" if self.nodes and self.gives_arc else f"    elements: [{', '.join(repr(l * L) for l in self.lengths)}]",
                  f"    weight: {w!r}", f"    stiffness: {'.inf' if 'inextensible' in self.features else repr(self.stiffness * w * L)}"]
        if self.zones:
            lines.append("    friction_zones: [" + ", ".join(f"{{from: {a * L!r}, to: {b * L!r}, factor: {f!r}}}" for a, b, f in self.zones) + "]")
        first = f"held: {vector(end, L)}" if self.steps[0][0] == "place" else "force: [0, 0, 0]"
        shape = "nodes: nodes.csv" if self.nodes else f"straight: {{from: {vector(self.origin, L)}, to: {vector(end, L)}}}"
        lines += [f"    start: {{{shape}}}",
                  f"    ends: {{A: {{held: {vector(self.origin, L)}}}, B: {{{first}}}}}", "history:"]
        for k, (kind, value) in enumerate(self.steps):
            lines.append(f"  - {{name: s{k}, rope.B: {{{'position' if kind == 'place' else 'force'}: {vector(value, L if kind == 'place' else w * L)}}}}}")
        return "\n".join(lines) + "\n"

    # ---- the problem of a step ----

    def first(self):
        """x_R, the push on each node and its height, at the start."""
        if self.nodes:
            return self.nodes, self.push, self.heights(self.nodes)
        x = [tuple(o + a * s for o, a in zip(self.origin, self.along)) for s in self.arc]
        push = [self.normal[2] * self.share(j) for j in range(self.count + 1)]
        return x, push, [0.0] * (self.count + 1)

    def problem(self, k, reference, push, height):
        kind, value = self.steps[k]
        load = [(0.0, 0.0, -self.share(j)) for j in range(self.count + 1)]
        held = {0: self.origin}
        if kind == "place":
            held[self.count] = value
        else:
            load[-1] = tuple(a + b for a, b in zip(load[-1], value))
        bound = [0.0 if j in held else self.mu * self.factor(j) * max(0.0, push[j]) for j in range(self.count + 1)]
        strict = "strict" in self.features
        heights = [None if j in held or (strict and h > 1e-6) else h for j, h in enumerate(height)]
        stiffness = 1e6 if "inextensible" in self.features else self.stiffness
        return Step(self.lengths, stiffness, load, reference, self.normal, heights, bound, held)

    def heights(self, x):
        return [dot(self.normal, sub(p, self.origin)) for p in x]

    def solved(self):
        """The last step's problem, with its places, and bounds of its least energy."""
        x, push, height = self.first()
        for k in range(len(self.steps)):
            step = self.problem(k, x, push, height)
            x, push, bounds = least_energy(step, "inextensible" in self.features)
            push = self.end_push(step, x, push)
            height = self.heights(x)
        return step, x, bounds

    def end_push(self, step, x, push):
        """What the plane pushes on the half element beside a held end that lies on it."""
        if self.count not in step.held:
            return push
        u, t = step.slopes(x)[-1], step.tensions(x)[-1]
        up = -dot(self.normal, step.load[-1]) + t * dot(self.normal, u) / norm(u)
        return push[:-1] + [max(0.0, up) if abs(self.heights(x)[-1]) < 1e-9 else 0.0]

    def read_places(self, path):
        rows = table(path)
        return [tuple(float(r[c]) / self.length for c in "xyz") for r in rows]


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))[1:]


def call(capstan, folder, *arguments):
    return subprocess.run([capstan, *arguments], cwd=folder, capture_output=True, text=True, timeout=120)


def scale_of(step, x, tolerance):
    """S of docs/theory.md (5)."""
    total = work = moment = loads = most = 0.0
    for l, t in zip(step.lengths, step.tensions(x)):
        total += l * (t + t * t / step.stiffness)
        most = max(most, t)
    for j, b in enumerate(step.load):
        total += step.bound[j] * norm(step.slip(x, j)[0])
        work += abs(dot(b, sub(x[j], step.reference[j])))
        loads += norm(b)
        moment += norm(b) * norm(sub(x[j], x[0]))
    return total + min(work + 1e-12 * max(loads, most) / tolerance, moment)


def refused(scene):
    """Words of which a refusal has one, or None: what the paper's step does not have, and what its method does not."""
    words = ["directions"] if "ellipse" in scene.features and scene.mu > 0 else []
    if "inextensible" in scene.features and scene.verb in ("study", "history"):
        words.append("inextensible")
    return words or None


# ---- P10.1: the conditions of its minimum, at the displacements and forces of the file ----

FIRST_ORDER = (("a solution of P10.1", "solved"), ("on this mesh only", "mesh"), ("shortens a slack part", "shortens"),
               ("a force across the line", "unbalanced"), ("not decided", "undecided"))


def vectors(rows, name, unit):
    return [tuple(float(r[f"{name}.{c}"]) / unit for c in "xyz") for r in rows]


def first_order_forces(step, reference, u):
    """(84) with T_R, per element; e, t and t.u'."""
    result = []
    for a, b, p, q, l in zip(reference, reference[1:], u, u[1:], step.lengths):
        slope, du = tuple((y - x) / l for x, y in zip(a, b)), tuple((y - x) / l for x, y in zip(p, q))
        s = norm(slope)
        t = tuple(c / s for c in slope)
        e = s - 1 if s - 1 > 1e-9 else 0.0
        s = s if e > 0 else 1.0
        strain = dot(t, du)
        result.append((tuple(step.stiffness * (e * tk + (e * dk + strain * tk) / s) for tk, dk in zip(t, du)), e, t, strain))
    return result


def check_first_order(scene, step, folder, said):
    """Balance, (80)-(82), (79) with C of (77), (86) and (87); where nothing balances, a displacement that lowers the energy for ever."""
    rows = table(os.path.join(folder, "out", "first-order.csv"))
    force = scene.length * scene.weight
    reference, u = vectors(rows, "reference", scene.length), vectors(rows, "u", scene.length)
    friction_force, push = vectors(rows, "friction_force", force), [float(r["reaction"]) / force for r in rows]
    line = said.split("C of (77)")[1].split("\n")[0]
    result = next((v for words, v in FIRST_ORDER if words in line), line)
    elements = first_order_forces(step, reference, u)
    free = [j for j in range(len(u)) if j not in step.held]
    unit = max([norm(b) for b in step.load] + [sum(norm(b) for b in step.load)])
    along = [dot(p, step.normal) for p in u]
    slid = [tuple(c - a * n for c, n in zip(p, step.normal)) for p, a in zip(u, along)]
    touches = [h is not None and h <= 1e-9 for h in step.height]
    need(result != "undecided", f"P10.1 not decided: {said}")
    if result == "unbalanced":
        far = max(norm(p) for p in u)
        quadratic = sum(l * step.stiffness / 2 * (e * dot(d, d) + w * w) for l, (_, e, _, w), d in
                        ((l, q, tuple((b - a) / l for a, b in zip(p1, p2))) for l, q, p1, p2 in zip(step.lengths, elements, u, u[1:]))) / far ** 2
        pull = sum(dot(step.load[j], u[j]) - step.bound[j] * norm(slid[j]) for j in free)
        pull -= sum(dot(tuple(step.stiffness * e * c for c in t), sub(q, p)) for (_, e, t, _), p, q in zip(elements, u, u[1:]))
        need(min([0.0] + [along[j] / far for j in free if touches[j]]) >= -1e-3, "P10.1: the ray leads into the bed")
        need(pull / far > 0 and quadratic <= 0.02 * pull / far, f"P10.1 said to have no minimum: a ray with power {pull / far}, stiffness {quadratic}")
        return
    for j in free:
        rest = [b + push[j] * n + f for b, n, f in zip(step.load[j], step.normal, friction_force[j])]
        for side in (-1, 1):
            i = j - (side < 0)
            if 0 <= i < len(elements):
                rest = [a + side * c for a, c in zip(rest, elements[i][0])]
        need(norm(rest) <= 2e-6 * unit, f"P10.1: {rest} left at node {j}")
        need(norm(friction_force[j]) <= step.bound[j] * (1 + 1e-6) + 1e-9 * unit, f"P10.1: friction beyond its bound at node {j}")
        need(step.bound[j] * norm(slid[j]) + dot(friction_force[j], slid[j]) <= 1e-6 * unit * max(norm(slid[j]), 1e-3), f"P10.1: (81), (82) at node {j}")
        need(push[j] >= -1e-9 * unit and (touches[j] or push[j] == 0), f"P10.1: reaction {push[j]} at node {j}")
        need(not touches[j] or (along[j] >= -1e-6 and push[j] * along[j] <= 1e-6 * unit), f"P10.1: (77), (79) at node {j}: {along[j]}")
    least = min([math.inf] + [w for _, e, _, w in elements if e == 0])
    limit = 1e-6 * unit / step.stiffness
    if least < -2 * limit or least > -0.5 * limit:
        need((least < -limit) == (result == "shortens"), f"P10.1: least strain {least} of slack elements, said {result}")
    if result != "shortens":
        _, e, t, _ = elements[-1]
        over = [0.0, 0.0, 0.0]
        if scene.count not in step.held and e == 0:
            f = scene.steps[-1][1]
            over = [c - max(0.0, dot(f, t)) * tk for c, tk in zip(f, t)]
            if touches[-1] and dot(over, step.normal) < 0:
                over = [c - dot(over, step.normal) * n for c, n in zip(over, step.normal)]
        if not 1e-10 < norm(over) / unit < 1e-8:
            need((norm(over) > 1e-9 * unit) == (result == "mesh"), f"P10.1: {over} across the slack end, said {result}")


# ---- the four verbs ----

def check_study(scene, capstan, folder):
    done = call(capstan, folder, "study", "scene.yaml", "--step", f"s{len(scene.steps) - 1}", "-o", "out")
    need(done.returncode in (0, 1), f"exit code {done.returncode}: {done.stderr}")
    unit, force = scene.length ** 2 * scene.weight, scene.length * scene.weight
    step, x, bounds = scene.solved()
    row = table(os.path.join(folder, "out", "study.csv"))[-1]
    exact = (float(row["total"]) - float(row["energy_error"])) / unit
    size = scale_of(step, x, 1e-8)
    # what the certificate lets pass, and of earlier steps what their places leave
    margin = 2e-8 * size * (1 if len(scene.steps) == 1 else 50)
    need(bounds[0] - margin <= exact and exact <= bounds[1] + margin,
         f"J** + j of P4.2: {exact}, expected {bounds} (S = {size})")
    if row["converged"] == "1":
        p = [float(row["lambda"]) * scene.length / scene.weight, float(row["1/n"]) / (force * scene.length ** 2), float(row["delta"]) / scene.length]
        y, left = minimise(step, *p)
        own, found = step.functional(y, *p), float(row["total"]) / unit
        need(abs(own - found) <= margin + 1e-9 * size + 1e-13 / step.lengths[0], f"P5.5 at {p}: {found}, expected {own}")
    check_first_order(scene, step, folder, done.stdout)


def check_history(scene, capstan, folder):
    done = call(capstan, folder, "run", "scene.yaml", "--method", "regularized", "-o", "out")
    need(done.returncode in (0, 1), f"exit code {done.returncode}: {done.stderr}")
    unit, force = scene.length ** 2 * scene.weight, scene.length * scene.weight
    x, push, height = scene.first()
    for k, row in enumerate(table(os.path.join(folder, "out", "history.csv"))):
        step = scene.problem(k, x, push, height)
        p = [float(row["lambda"]) * scene.length / scene.weight, float(row["1/n"]) / (force * scene.length ** 2), float(row["delta"]) / scene.length]
        x, left = minimise(step, *p)
        size = scale_of(step, x, 1e-8)
        own, found = step.functional(x, *p), float(row["total"]) / unit
        need(abs(own - found) <= 1e-8 * size * (1 + 20 * k), f"step {k}: total {found}, expected {own} (S = {size})")
        tip = [float(row["B." + c]) / scene.length for c in "xyz"]
        apart = max(abs(a - b) for a, b in zip(tip, x[-1]))
        # places are as well known as rounding of forces over the least stiffness; later steps add what those before have left
        need(apart <= 1e-6 * 10 ** min(k, 1), f"step {k}: end B {tip}, expected {x[-1]}, {apart} off")
        push = [p[0] * step.share[j] * max(0.0, -h) for j, h in enumerate(scene.heights(x))]
        push = scene.end_push(step, x, push)
        height = scene.heights(x)


def result_of(step, x, y, bounds, tolerance, inextensible):
    """'no', 'relaxed' or 'solution', None where it is too near to call; and J** + j above the minimum."""
    gap = tolerance * scale_of(step, x, tolerance)
    excess = step.relaxed(y) - bounds[0]
    spread = bounds[1] - bounds[0]
    stretch = [norm(u) for u in step.slopes(y)]
    sunk = max([0.0] + [-h for h in (step.slip(y, j)[1] for j in range(len(y))) if h is not None])
    off = max(norm(sub(y[j], p)) for j, p in step.held.items())
    tests = [(off, tolerance, "no"), (sunk, tolerance, "no")]
    if inextensible:
        tests.append((max(0.0, max(stretch) - 1), math.sqrt(tolerance), "no"))
        capped = Step(step.lengths, 0.0, step.load, step.reference, step.normal, step.height, step.bound, step.held)
        excess = capped.relaxed(y) - bounds[0] if max(stretch) <= 1 + 1e-9 else None
    if excess is None:
        return None if max(stretch) - 1 < 3 * math.sqrt(tolerance) else "no", None
    tests.append((max(0.0, excess), gap, "no"))
    tests.append((max(0.0, 1 - min(stretch)), math.sqrt(tolerance), "relaxed"))
    for value, limit, result in tests:
        margin = spread if limit == gap else 1e-9
        if value - margin > 3 * limit:
            return result, excess
        if value + margin > limit / 3:
            return None, excess
    return "solution", excess


def write_places(scene, folder, y):
    with open(os.path.join(folder, "places.csv"), "w", encoding="utf-8") as file:
        for p in y:
            file.write(",".join(repr(c * scene.length) for c in p) + "\n")


def said_result(text):
    return "no" if ": no solution" in text else "relaxed" if "but not of P3.1" in text else "solution" if "a solution of P3.1" in text else "?"


def perturbed(scene, step, x, draw):
    kind, y = draw.randrange(4), list(x)
    size = 10 ** draw.uniform(-5, -0.5)
    direction = [draw.gauss(0, 1) for _ in range(3)]
    if kind == 0:
        return y
    if kind == 1:  # a node anywhere, an end too
        j = draw.randrange(len(y))
        y[j] = tuple(a + size * b for a, b in zip(y[j], direction))
    elif kind == 2:  # a node within the plane
        j = draw.randrange(1, len(y))
        across = dot(direction, scene.normal)
        y[j] = tuple(a + size * (b - across * n) for a, b, n in zip(y[j], direction, scene.normal))
    else:  # all of it, less and less to the ends
        for j in range(1, len(y)):
            bump = size * math.sin(math.pi * scene.arc[j] * (0.5 if scene.count not in step.held else 1))
            y[j] = tuple(a + bump * b for a, b in zip(y[j], direction))
    for j in range(1, len(y)):  # most of the time out of the bed
        h = dot(scene.normal, sub(y[j], scene.origin))
        if h < 0 and draw.random() < 0.9 and j not in step.held:
            y[j] = tuple(a - h * n for a, n in zip(y[j], scene.normal))
    return y


def check_judge(scene, capstan, folder):
    step, x, bounds = scene.solved()
    unit = scene.length ** 2 * scene.weight
    inextensible = "inextensible" in scene.features
    for _ in range(4):
        tolerance = 10 ** scene.draw.uniform(-5 if inextensible or len(scene.steps) > 1 else -6.5, -3)
        y = perturbed(scene, step, x, scene.draw)
        expected, excess = result_of(step, x, y, bounds, tolerance, inextensible)
        write_places(scene, folder, y)
        done = call(capstan, folder, "study", "scene.yaml", "--step", f"s{len(scene.steps) - 1}", "--judge", "places.csv", "--tolerance", repr(tolerance))
        need(done.returncode in (0, 1), f"exit code {done.returncode}: {done.stderr}")
        said = said_result(done.stdout)
        need((done.returncode == 0) == (said == "solution"), f"exit code {done.returncode} with: {done.stdout}")
        need(expected is None or said == expected, f"tolerance {tolerance}, {excess} above {bounds}: expected {expected}, said {done.stdout}")
        size = scale_of(step, x, tolerance)
        # a held end that is off within the tolerance: its own half element's weight is the support's, and no part of the energy judged
        at_ends = all(norm(sub(y[j], p)) == 0 for j, p in step.held.items())
        if excess is not None and at_ends and "outside C" not in done.stdout and "held end is elsewhere" not in done.stdout and min(
                h for h in scene.heights(y)) >= -1e-12:
            found = float(done.stdout.split("energy above the minimum")[1].split()[0]) / unit
            need(abs(found - excess) <= 1e-4 * excess + (bounds[1] - bounds[0]) + 2e-7 * size * (1 if len(scene.steps) == 1 else 20),
                 f"energy above the minimum {found}, expected {excess} (S = {size})")


def closes(scene, step, x):
    """May all slack of a smooth bed be laid out at its length? No element of a slack piece is longer than the rest of it and the chord."""
    tension, n = step.tensions(x), scene.count
    i = 0
    while i < n:
        last = i
        if tension[i] < 1e-4:
            while last + 1 < n and tension[last + 1] < 1e-4:
                last += 1
            h = [scene.heights(x)[i], scene.heights(x)[last + 1]]
            r = list(scene.lengths[i:last + 1])
            if len(r) == 1:
                if norm(step.slopes(x)[i]) < 1 - 1e-3 and (last + 1 < n or n in step.held):
                    return False
            else:
                r[0] = math.sqrt(max(0.0, r[0] ** 2 - h[0] ** 2))
                r[-1] = math.sqrt(max(0.0, r[-1] ** 2 - h[1] ** 2))
                feet = [tuple(a - k * m for a, m in zip(x[j], scene.normal)) for j, k in ((i, h[0]), (last + 1, h[1]))]
                if last + 1 < n or n in step.held:
                    sides = sorted(r + [norm(sub(*feet))])
                    if not sides[-1] < sum(sides[:-1]) - 1e-4:
                        return None if sides[-1] < sum(sides[:-1]) + 1e-4 else False
        i = last + 1
    return True


def check_complete(scene, capstan, folder):
    step, x, bounds = scene.solved()
    shape = scene.draw.choice(("shortest", "straight", "meander"))
    done = call(capstan, folder, "study", "scene.yaml", "--step", f"s{len(scene.steps) - 1}", "--complete", shape, "-o", "out")
    need(done.returncode in (0, 1), f"exit code {done.returncode}: {done.stderr}")
    y = scene.read_places(os.path.join(folder, "out", "completed.csv"))
    size = scale_of(step, x, 1e-8)
    inextensible = "inextensible" in scene.features
    cost = Step(step.lengths, 0.0 if inextensible else step.stiffness, step.load, step.reference, step.normal, step.height, step.bound, step.held)
    excess = cost.relaxed(y) - bounds[0]
    # 1e-6 S: far below what a slack node off the bed or a tension elsewhere costs; later steps add what the one before leaves
    need(excess <= 1e-6 * size * (1 if len(scene.steps) == 1 else 20) + (bounds[1] - bounds[0]), f"{shape}: {excess} above the minimum, S = {size}")
    need(all(norm(sub(y[j], p)) <= 1e-9 for j, p in step.held.items()), f"{shape}: a held end is elsewhere")
    sunk = [h for h in (step.slip(y, j)[1] for j in range(len(y))) if h is not None]
    need(min(sunk) >= (-1e-8 if len(scene.steps) == 1 else -1e-6), f"{shape}: {min(sunk)} inside the bed")
    shortest = min(norm(u) for u in step.slopes(y))
    need(not inextensible or max(norm(u) for u in step.slopes(y)) <= 1 + 1e-7, f"{shape}: longer than it is")
    need((done.returncode == 0) == (shortest >= 1 - 1e-4), f"{shape}: exit code {done.returncode}, |x'| down to {shortest}: {done.stdout}")
    if scene.mu == 0:
        all_laid = closes(scene, step, x)
        need(all_laid is None or all_laid == (shortest >= 1 - 1e-8), f"{shape}: |x'| down to {shortest}, slack that closes: {all_laid}")


CHECK = {"study": check_study, "judge": check_judge, "complete": check_complete, "history": check_history}


def run_scene(capstan, seed, number):
    verb = VERBS[number % len(VERBS)]
    scene = Scene(random.Random(seed * 1000003 + number), verb, number >= NODES)
    with tempfile.TemporaryDirectory() as folder:
        if scene.nodes:
            with open(os.path.join(folder, "nodes.csv"), "w", encoding="utf-8") as file:
                file.write(scene.table())
        with open(os.path.join(folder, "scene.yaml"), "w", encoding="utf-8") as file:
            file.write(scene.text())
        text = open(os.path.join(folder, "scene.yaml"), encoding="utf-8").read()
        try:
            words = refused(scene)
            if words is None:
                CHECK[verb](scene, capstan, folder)
            else:
                arguments = {"history": ["run", "scene.yaml", "--method", "regularized"], "study": ["study", "scene.yaml"],
                             "complete": ["study", "scene.yaml", "--complete", "meander"]}.get(verb)
                if verb == "judge":
                    write_places(scene, folder, scene.first()[0])
                    arguments = ["study", "scene.yaml", "--judge", "places.csv"]
                done = call(capstan, folder, *arguments, "-o", "out")
                need(done.returncode == 3 and any(w in done.stderr for w in words), f"expected a refusal ({words}): {done.returncode} {done.stderr}")
        except Wrong as wrong:
            return scene, f"scene {number} ({verb}; {', '.join(sorted(scene.features))}): {wrong}\n{text}"
    return scene, None


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("capstan")
    arguments.add_argument("--scenes", type=int, default=720)
    arguments.add_argument("--seed", type=int, default=1990)
    arguments.add_argument("--only", type=int)
    given = arguments.parse_args()
    numbers = [given.only] if given.only is not None else [*range(given.scenes * 5 // 6), *range(NODES, NODES + given.scenes - given.scenes * 5 // 6)]
    faults, counted = [], {}
    for number in numbers:
        scene, fault = run_scene(os.path.abspath(given.capstan), given.seed, number)
        for key in [scene.verb, *scene.features]:
            counted[key] = counted.get(key, 0) + 1
        if fault:
            faults.append(fault)
    print("\n".join(faults))
    print(f"random_steps: seed {given.seed}, {len(numbers)} scenes, {len(faults)} wrong;",
          ", ".join(f"{key} {count}" for key, count in sorted(counted.items())))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
