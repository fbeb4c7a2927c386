# SPDX-License-Identifier: BSD-3-Clause
"""Bends round obstacles at one node: the ratio of tensions that the mesh holds against exp(mu d), what is told of it, and the mesh that is
too coarse.                                                                                                 usage: bends.py CAPSTAN"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

CAPSTAN = sys.argv[1]
CASES = 60
COARSE, BEND = "mesh_too_coarse", "the mesh is coarse for a bend"
faults = []


def unit(v):
    size = math.sqrt(sum(a*a for a in v))
    return [a/size for a in v]


def mix(*terms):
    return [sum(k*v[i] for k, v in terms) for i in range(3)]


def cross(a, b):
    return [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]]


def run(folder, text):
    path, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([CAPSTAN, "run", path, "-o", out], capture_output=True, text=True, timeout=60)
    if done.returncode not in (0, 1):
        faults.append(f"exit {done.returncode}: {done.stderr}\n{text}")
        return done.returncode, "", []
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return done.returncode, done.stderr, json.load(file)["steps"]


def fold(folder, kind, friction, radius, element, half, t, n, axis, entries=2, more=""):
    """A weightless rope of two elements over one node on a post, both `half` below its tangent plane; A is held, B pulled by 10 N.
    Only nodes are kept out of the post, so that nothing but this node's law acts."""
    down, up = mix((math.cos(half), t), (-math.sin(half), n)), mix((math.cos(half), t), (math.sin(half), n))
    node = mix((radius, n))
    a, b = mix((1, node), (-element, up)), mix((1, node), (element, down))
    name = "cylinder: {point: [0, 0, 0]" if kind == "cylinder" else "sphere: {centre: [0, 0, 0]"
    text = (f"capstan: 1\ncontact_policy: reference\n{more}obstacles:\n  post: {{{name}, radius: {radius!r}, axis: {axis}}}, friction: {friction}}}\n"
            f"lines:\n  rope: {{length: {2*element!r}, elements: 2, weight: 0, stiffness: 1e7, start: {{polyline: [{a}, {node}, {b}]}}, "
            "ends: {A: held, B: free}}\nhistory:\n"
            + "".join(f"  - {{name: pull {i}, rope.B: {{force: {mix((10 + i, down))}}}}}\n" for i in range(entries)))
    return run(folder, text)


def told(mu, turn):
    """(k, exp(mu d)) by the triangle of the two forces and the contact's, which leans by the angle of friction"""
    phi = math.atan(mu)
    low = math.cos(turn/2 + phi)
    return (math.cos(turn/2 - phi)/low if low > 0 else math.inf), math.exp(mu*turn)


def axes(rng, kind):
    axis = unit([rng.gauss(0, 1) for _ in range(3)])
    side = unit([rng.gauss(0, 1) for _ in range(3)])
    n = unit(mix((1, side), (-sum(a*b for a, b in zip(side, axis)), axis))) if kind == "cylinder" else side
    t = unit(cross(n, [rng.gauss(0, 1) for _ in range(3)]))
    return t, n, axis


def chance(folder):
    rng = random.Random(11)
    for case in range(CASES):
        kind, mu = rng.choice(["cylinder", "sphere"]), rng.uniform(0.05, 1.2)
        radius, ratio = 10**rng.uniform(-3, 1), 10**rng.uniform(-1, 1)
        element = radius/ratio
        half = math.atan(rng.choice([rng.uniform(0.02, 0.89), rng.uniform(0.91, 0.99), rng.uniform(1.01, 4)])/mu)
        t, n, axis = axes(rng, kind)
        round_axis = 1 - sum(a*b for a, b in zip(t, axis))**2 if kind == "cylinder" else 1
        while math.hypot(radius - element*math.sin(half), element*math.cos(half)*math.sqrt(round_axis)) < (1 + 1e-8)*radius:
            half *= 0.95  # the ends lie outside of the post
        code, said, steps = fold(folder, kind, mu, radius, element, half, t, n, axis)
        k, coulomb = told(mu, 2*half)
        what = f"case {case}: {kind}, mu {mu:.3g}, R/h {ratio:.3g}, turn {2*half:.4g} rad, k {k:.6g}, exp(mu d) {coulomb:.6g}"
        if len(steps) != 2:
            faults.append(f"{what}: {len(steps)} steps")
            continue
        locked = mu*math.tan(half) >= 0.9
        for step in steps:
            rope, bend = step["lines"]["rope"], step["lines"]["rope"].get("bend")
            a, b = rope["A"]["tension_N"], rope["B"]["tension_N"]
            # the node has slid by about 1e-6 of an element, which turns the normal by as much times h/R
            fine = 1e-4*(1 + 1/ratio)
            if rope["outcome"] != (COARSE if locked else "solved"):
                faults.append(f"{what}: {rope['outcome']}")
            # what rests creeps by the square root of the 1e-13 that the loop stops at, 3e-7, times what it takes to pull an element
            if not (a < 1e-4*b if math.isinf(k) else abs(b/a - k) <= fine*k*k):
                faults.append(f"{what}: tensions {b} and {a}")
            if not bend:
                faults.append(f"{what}: no bend is told")
                continue
            ratios = bend["ratio"] is None if math.isinf(k) else abs(bend["ratio"] - k) <= fine*k*k
            if not ratios or abs(bend["coulomb"] - coulomb) > fine*coulomb or abs(bend["turn_rad"] - 2*half) > fine or abs(bend["friction"] - mu) > 1e-12:
                faults.append(f"{what}: {bend}")
        off = math.inf if math.isinf(k) else k/coulomb
        if code != (1 if locked else 0):
            faults.append(f"{what}: exit {code}")
        if ("mesh too coarse" if locked else BEND) not in said and (locked or off > 1.011):
            faults.append(f"{what}: nothing said")
        if not locked and off < 1.009 and BEND in said:
            faults.append(f"{what}: said in vain: {said}")


def directions(folder):
    """the coefficient along the line: ellipse, box, set and zones, along the line or a grain"""
    rng = random.Random(3)
    t, n, axis = axes(rng, "cylinder")
    across = cross(n, t)
    for angle in (0.0, 0.4, 1.1, 2.0):
        grain = mix((math.cos(angle), t), (math.sin(angle), across))
        c, s = abs(math.cos(angle)), abs(math.sin(angle))
        for friction, expected in (
                (f"{{axial: 0.2, lateral: 0.5, grain: {grain}}}", math.hypot(0.2*c, 0.5*s)),
                (f"{{axial: 0.2, lateral: 0.5, shape: box, grain: {grain}}}", 0.2*c + 0.5*s),
                (f"{{set: {{ellipse: [0.2, 0.5]}}, grain: {grain}}}", math.hypot(0.2*c, 0.5*s)),
                # not symmetric: the larger of the two ways
                (f"{{set: {{polytope: [[-0.1, -0.3], [0.6, -0.3], [0.6, 0.2], [-0.1, 0.2]]}}, grain: {grain}}}",
                 max(max(math.cos(angle)*x - math.sin(angle)*y for x in (-0.1, 0.6) for y in (-0.3, 0.2)),
                     max(-math.cos(angle)*x + math.sin(angle)*y for x in (-0.1, 0.6) for y in (-0.3, 0.2)))),
                ("{axial: 0.2, lateral: 0.5}", 0.2)):
            _, _, steps = fold(folder, "cylinder", friction, 0.05, 0.4, 0.3, t, n, axis, entries=1)
            bend = steps[0]["lines"]["rope"].get("bend") if steps else None
            # the line turns in the tangent plane a little while the node slides sideways
            if not bend or abs(bend["friction"] - expected) > 1e-4:
                faults.append(f"grain at {angle}: {friction}: expected {expected}, found {bend}")


def special(folder):
    t, n, axis = [1, 0, 0], [0, 0, 1], [0, 1, 0]
    # half a turn round one node: 1000 N beside 10 N are held, and it is said
    code, said, steps = fold(folder, "cylinder", 0.3, 0.01, 0.1, 0.5*math.pi - 0.05, t, n, axis, entries=3)
    if code != 1 or [s["outcome"] for s in steps] != [COARSE]*3 or "'post'" not in said or "elements no longer than" not in said:
        faults.append(f"half a turn: exit {code}, {[s['outcome'] for s in steps]}: {said}")
    # frozen friction: in the first step it has no bound, and no bend; then the same
    code, said, steps = fold(folder, "cylinder", 0.3, 0.01, 0.1, 0.5*math.pi - 0.05, t, n, axis, entries=3, more="friction_policy: frozen\n")
    if [s["outcome"] for s in steps] != ["solved", COARSE, COARSE]:
        faults.append(f"half a turn, frozen: {[s['outcome'] for s in steps]}")
    code, said, steps = fold(folder, "cylinder", 0, 0.01, 0.1, 1.2, t, n, axis)
    if code or BEND in said or any("bend" in s["lines"]["rope"] for s in steps):
        faults.append(f"without friction: exit {code}: {said}")

    # a rope bent to the side: no friction of a turn, on a plane nor on top of a drum so large that it is nearly one
    for obstacle, most in (("plane: {normal: [0, 0, 1]}", 0), ("cylinder: {point: [0, 0, -100], axis: [1, 0, 0], radius: 100}", 0.02)):
        text = (f"capstan: 1\nobstacles:\n  bed: {{{obstacle}, friction: 1}}\nlines:\n  rope: {{length: 1, elements: 10, weight: 10, stiffness: 1e5, "
                "start: {polyline: [[-0.5, 0, 0.01], [0, 0, 0.01], [0, 0.5, 0.01]]}, ends: {A: free, B: free}}\nhistory:\n"
                "  - {name: lies}\n  - {name: pull, steps: 2, rope.B: {force: [0, 3, 0]}}\n")
        code, said, steps = run(folder, text)
        found = [s["lines"]["rope"]["bend"]["turn_rad"] for s in steps if "bend" in s["lines"]["rope"]]
        if code or BEND in said or any(turn > most for turn in found) or (most == 0 and found):
            faults.append(f"bent to the side on {obstacle}: exit {code}, {found}: {said}")


def advised(folder):
    """a rope round a quarter of a drum in elements as long as is advised, and a little longer"""
    rng = random.Random(2)
    for mu in (0.1, 0.3, rng.uniform(0.05, 1), 1.5):
        def wound(element):
            length = element*max(2, round(1.5/element))
            start, centre = [0, 0, 1], [0, 0, 0]
            angle = round(length/element)*2*math.asin(element/2)
            text = (f"capstan: 1\nobstacles:\n  drum: {{cylinder: {{radius: 1}}, friction: {mu!r}}}\nlines:\n  rope: {{length: {length!r}, "
                    f"elements: {round(length/element)}, weight: 0, stiffness: 1e7, start: {{arc: {{from: {start}, centre: {centre}, axis: [0, 1, 0]}}}}, "
                    f"ends: {{A: held, B: free}}}}\nhistory:\n  - {{name: pull, rope.B: {{force: [{10*math.cos(angle)!r}, 0, {-10*math.sin(angle)!r}]}}}}\n")
            return run(folder, text)
        code, said, steps = wound(0.3)
        bend = steps[0]["lines"]["rope"].get("bend") if steps else None
        if not bend:
            faults.append(f"advised, mu {mu}: exit {code}, no bend: {said}")
            continue
        for factor, expected in ((0.98, False), (1.02, True)):
            code, said, steps = wound(factor*bend["element_m"])
            if code or (BEND in said) != expected:
                faults.append(f"advised, mu {mu}, {factor} of {bend['element_m']} m: exit {code}: {said}")


with tempfile.TemporaryDirectory() as directory:
    chance(directory)
    directions(directory)
    special(directory)
    advised(directory)
print("\n".join(faults) or f"bends: {CASES} at random, coefficients along the line, what is told and what is not")
sys.exit(1 if faults else 0)
