#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run with ends of lines held to sets: what summary and history say, the checker finds nothing, copies with a number changed are
refused, a run that is stopped and resumed has the same numbers, random histories, and mistakes are told with their place.

usage: end_sets.py CAPSTAN CHECKER [FIRST LAST]      with numbers: these seeds of random histories only
"""
import csv
import json
import math
import os
import random
import struct
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is left in the source folder
import runs  # noqa: E402
from runs import command, falsify, falsify_attribute, resumed, write  # noqa: E402

CAPSTAN, CHECKER = (os.path.abspath(path) for path in sys.argv[1:3])
SEEDS = 12  # of random histories in every run
# further ones, of which 51 was not certified and the others refuted: a segment across a slope, and an image of a sum over a bed, in which
# rounding of the reaction moved the end along the set; a range of tensions that left the reaction of the set as it was; an end outside
# its set by rounding; and what of the set lies above the bed or the slope is out of reach (333 a rail, 594 a ball, 629 a rail without end)
AGAIN = (51, 55, 333, 338, 348, 594, 629)

# a rope over a post to a rail, along which a force draws its end, to the rail's end and back
POST = """
capstan: 1
obstacles:
  post: {cylinder: {point: [0, 0, 0], axis: [0, 1, 0], radius: 0.5}, friction: 0.3}
lines:
  rope:
    length: 10
    elements: 60
    mass: 1
    stiffness: STIFFNESS
    start: {polyline: [[-5, 0, 0.5], [5, 0, 0.5]]}
    ends: {A: {force: [-60, 0, 0]}, B: {on: {rail: {from: [5, -1, 0.5], to: [5, 2, 0.5]}}}}
history:
  - {name: down, rope.A: {force: [0, 0, -60]}, steps: 6}
  - {name: draw, rope.B: {force: [0, 90, 0]}, steps: 6}
  - {name: back, rope.B: {force: [0, -20, 0]}, steps: 4}
"""
# (variable, step, index, change)
FALSIFIED = (("rope_set_reaction", 3, 3, 1e-3), ("rope_set_reaction", 8, 4, 1e-2), ("rope_set_reaction", 12, 5, -1e-2),
             ("rope_position", 7, 3*60, 1e-5), ("rope_position", 9, 3*60 + 2, 1e-5), ("rope_position", 11, 3*60 + 1, 1e-3),
             ("rope_end_force", 8, 3, 1e-2), ("rope_ledger_ends", 9, 0, 1e-2), ("rope_end_applied_force", 10, 4, 1e-3))
STATIC_FALSIFIED = (("rope_set_point", 3, 1e-6), ("rope_set_axis", 4, 0.1), ("rope_set_length", 1, -0.5), ("rope_set_kind", 1, 1),
                    ("rope_set_kind", 0, 3), ("rope_set_radius", 1, 1))
ON = "{rail: {from: [5, -1, 0.5], to: [5, 2, 0.5]}}"
RAIL = "B: {on: " + ON + "}"
DRAW = "rope.B: {force: [0, 90, 0]}"
BAD = (  # (what is replaced, by what, what is said)
    (RAIL, "B: {on: {}}", "12:41: 'on': nothing given, expected exactly one of 'rail', 'half_space', 'ball', 'disc', 'box', 'set'"),
    (RAIL, "B: {on: rail}", "12:41: 'on': found 'rail', expected a mapping"),
    (RAIL, "B: {on: [5, 0, 0]}", "12:41: 'on': found a list of 3, expected a mapping"),
    (RAIL, "B: {on: {rod: {}}}", "12:46: 'on': unknown key 'rod'"),
    (RAIL, "B: {on: {ball: {centre: [5, 0, 0], radius: 1}, disc: {centre: [5, 0, 0], radius: 1}}}", "12:41: 'on': too much given, expected exactly one of 'rail', 'half_space', 'ball', 'disc', 'box', 'set'"),
    (RAIL, "B: {held: [5, 0, 0.5], on: " + ON + "}", "12:37: 'B': too much given, expected exactly one of 'held', 'force', 'point', 'on'"),
    (RAIL, "B: {force: [5, 0, 0.5], on: " + ON + "}", "12:37: 'B': too much given, expected exactly one of 'held', 'force', 'point', 'on'"),
    (ON, "{rail: {}}", "12:46: 'rail': 'from' is missing"),
    (ON, "{rail: {from: [5, -1, 0.5]}}", "12:46: 'rail': nothing given, expected exactly one of 'to', 'along'"),
    (ON, "{rail: {from: [5, -1, 0.5], to: [5, 2, 0.5], along: [0, 1, 0]}}", "12:46: 'rail': too much given, expected exactly one of 'to', 'along'"),
    (ON, "{rail: {from: [5, -1, 0.5], to: [5, -1, 0.5]}}", "12:41: rail: it goes from (5, -1, 0.5) m to the same place: give it two places, or hold what is on it"),
    (ON, "{rail: {from: [5, -1], to: [5, 2, 0.5]}}", "12:53: 'from': found a list of 2, expected three numbers"),
    (ON, "{rail: {from: [5, -1, .nan], to: [5, 2, 0.5]}}", "12:67: 'from': found '.nan', expected a number"),
    (ON, "{rail: {from: [5, -1, .inf], to: [5, 2, 0.5]}}", "12:67: 'from': found '.inf', expected a number"),
    (ON, "{rail: {from: [5, 0, 0.5], along: [0, 0, 0]}}", "12:41: line 'rope': ends: the set of end B has an axis without a direction"),
    (ON, "{rail: {from: [5, 0, 0.5], long: [0, 0, 1]}}", "12:72: 'rail': unknown key 'long'; did you mean 'along'?"),
    (ON, "{rail: {from: [5, 1, 0.5], to: [5, 2, 0.5]}}", "12:41: line 'rope': ends: the set of end B is 1 m away from where the start puts the end, (5, 0, 0.5) m: let it begin in the set, as at (5, 1, 0.5) m"),
    (ON, "{half_space: {point: [5, 0, 0.5]}}", "12:46: 'half_space': 'normal' is missing"),
    (ON, "{half_space: {point: [5, 0, 0.5], normal: [0, 0, 0]}}", "12:41: line 'rope': ends: the set of end B has an axis without a direction"),
    (ON, "{half_space: {point: [5, 0, 1], normal: [0, 0, 2]}}", "12:41: line 'rope': ends: the set of end B is 0.5 m away"),
    (ON, "{ball: {centre: [5, 0, 0]}}", "12:46: 'ball': 'radius' is missing"),
    (ON, "{ball: {centre: [5, 0, 0], radius: 0}}", "12:72: 'radius': found '0', expected a number in m, greater than 0"),
    (ON, "{ball: {centre: [5, 0, 0], radius: -1}}", "12:72: 'radius': found '-1', expected a number in m, greater than 0"),
    (ON, "{ball: {centre: [5, 0, 0], radius: .inf}}", "12:72: 'radius': found '.inf', expected a number in m"),
    (ON, "{ball: {center: [5, 0, 0], radius: 1}}", "12:53: 'ball': unknown key 'center'; did you mean 'centre'?"),
    (ON, "{ball: {centre: [5, 0, 0], radius: 0.4}}", "12:41: line 'rope': ends: the set of end B is 0.1 m away"),
    (ON, "{disc: {centre: [5, 0, 0], radius: 1}}", "12:41: line 'rope': ends: the set of end B is 0.5 m away"),
    (ON, "{disc: {centre: [5, 0, 0.5], radius: 1, normal: [0, 0, 0]}}", "12:41: line 'rope': ends: the set of end B has an axis without a direction"),
    (ON, "{box: {centre: [5, 0, 0.5], size: [1, 0, 1]}}", "12:83: 'size': found '0', expected a number in m, greater than 0"),
    (ON, "{box: {centre: [5, 0, 0.5], size: 1}}", "12:73: 'size': found '1', expected three numbers"),
    (ON, "{box: {centre: [5, 0, 0.5], size: [1, 1, 1], rotation: {quaternion: [0, 0, 0, 0]}}}", "12:"),
    (ON, "{set: {}}", "12:46: 'set': found a mapping, expected one word with its value, as in {disc: 500}"),
    (ON, "{set: ball}", "12:46: 'set': found 'ball', expected one word with its value, as in {disc: 500}"),
    (ON, "{set: {globe: 1}}", "12:52: unknown word 'globe', expected one of: point"),
    (ON, "{set: {disc: 1}}", "12:46: line 'rope': ends: the set of end B lies in R^2, expected R^3"),
    (ON, "{set: {ball: {radius: 1}}}", "12:52: 'ball': 'dimension' is missing: number of components"),
    (ON, "{set: {ball: {radius: -1, dimension: 3}}}", "12:59: 'radius': found '-1', expected a number, at least 0"),
    (ON, "{set: {ball: {radius: 6, dimension: 2}}}", "12:46: line 'rope': ends: the set of end B lies in R^2, expected R^3"),
    (ON, "{set: {ball: {radius: 4.9, dimension: 3}}}", "12:41: line 'rope': ends: the set of end B is 0.124938 m"),
    (ON, "{set: {ball: {radius: .inf, dimension: 3}}}", "12:59: 'radius': found '.inf', expected a number, at least 0, finite and at most 1e100"),
    (ON, "{set: {half_space: {normal: [0, 0, 1], offset: 1}}}", "12:46: line 'rope': ends: the set of end B is unbounded: intersect it with a box that the line does not leave"),
    (ON, "{set: {subspace: [[1, 0, 0], [0, 0, 1]]}}", "12:46: line 'rope': ends: the set of end B is unbounded: intersect it with a box that the line does not leave"),
    (ON, "{set: {box: [.inf, 1, 1]}}", "12:46: line 'rope': ends: the set of end B is unbounded: intersect it with a box that the line does not leave"),
    (ON, "{set: {intersection: [{translate: {by: [9, 0, 0], of: {ball: {radius: 2, dimension: 3}}}}, {ball: {radius: 6, dimension: 3}}]}}", "12:46: line 'rope': ends: the set of end B has no answer: the set is empty"),
    (ON, "{set: {translate: {by: [5, 0], of: {ball: {radius: 2, dimension: 3}}}}}", "12:64: 'by': found 2 numbers, expected 3, as many as its set has components"),
    (ON, "{set: {ball: {radius: 6, dimension: 3}}, ball: {centre: [5, 0, 0], radius: 1}}", "12:41: 'on': too much given, expected exactly one of 'rail', 'half_space', 'ball', 'disc', 'box', 'set'"),
    (ON, "{ball: {centre: [5, 0, 0], radius: 1}, force: [1, 2]}", "12:84: 'force': found a list of 2, expected three numbers"),
    (ON, "{ball: {centre: [5, 0, 0], radius: 1}, friction: 0.2}", "12:84: 'on': unknown key 'friction'"),
    (DRAW, "rope.B: {position: [5, 1, 0.5]}", "15:18: stage 2: rope.B is moved, but it is held to a set, which stays where it is: give it a force"),
    (DRAW, "rope.B: {move: [0, 1, 0]}", "15:27: 'rope.B': found a move, but the end's position before it is not known"),
    (DRAW, "rope.B: {release: true}", "15:18: stage 2: rope.B is released, but it is held to a set"),
    (RAIL, "B: {on: " + ON + ", stored: 1}", "12:"),
    ("mass: 1", "mass: 1\n    break_at: 1e5", "13:41: line 'rope': ends: the set of end B does not go together with break_at"),
)


def solve(folder, text, wanted=(0,)):
    return runs.solve(CAPSTAN, CHECKER, folder, text, wanted)


def post(folder, stiffness):
    scene, out, results = solve(folder, POST.replace("STIFFNESS", stiffness))
    assert results.steps == 16
    for step in range(16):
        end, force = results.get("rope_position", step)[180:183], results.get("rope_set_reaction", step)
        assert abs(end[0] - 5) < 1e-12 and abs(end[2] - 0.5) < 1e-12 and -1 - 1e-12 < end[1] < 2 + 1e-12, (step, end)
        # between the ends of the rail there is no reaction along it
        assert 1 - abs(end[1] - 0.5)/1.5 < 1e-6 or abs(force[4]) < 1e-5, (step, end, force)
        assert force[:3] == [0, 0, 0] or tuple(force[:3]) == (0, 0, 0)
    assert abs(results.get("rope_position", 11)[181] - 2) < 1e-9 and results.get("rope_set_reaction", 11)[4] < -1
    assert results.get("rope_position", 15)[181] < 1.9
    with open(os.path.join(out, "history.csv"), newline="") as file:
        rows = list(csv.reader(file))
    names, last = rows[0], rows[-1]
    for axis, name in enumerate("xyz"):
        column = names.index(f"rope.B.reaction_{name}")
        assert rows[1][column] == "N" and last[names.index(f"rope.A.reaction_{name}")] == ""
        assert float(last[column]) == results.get("rope_set_reaction", 15)[3 + axis]
    with open(os.path.join(out, "summary.json")) as file:
        end = json.load(file)["steps"][-1]["lines"]["rope"]["B"]
    assert end["reaction_N"] == list(results.get("rope_set_reaction", 15)[3:]), end
    for variable, step, index, change in FALSIFIED:
        falsify(results, out, variable, step, index, change)
        code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
        assert code != 0, (variable, step, said)
    for variable, index, change in STATIC_FALSIFIED:
        falsify(results, out, variable, None, index, change)
        code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
        assert code != 0, (variable, said)
    claim_range(results, out, 11)
    code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
    assert code != 0 and "a range of tensions of an elastic line, or of one with an end in a set" in said, said
    return len(FALSIFIED) + len(STATIC_FALSIFIED) + 1


def claim_range(results, folder, step):
    """Write copy.nc, in which the tension of end A has a range."""
    data = bytearray(results.data)
    tension = math.hypot(*results.get("rope_segment_force", step)[:3])
    for name in ("least", "least_bound", "greatest", "greatest_bound"):
        at = results.variables["rope_end_tension_" + name][3] + step*results.record
        assert math.isnan(struct.unpack_from(">d", data, at)[0]), name
        struct.pack_into(">d", data, at, tension)
    with open(os.path.join(folder, "copy.nc"), "wb") as file:
        file.write(data)


# the end within the convex hull of a ball and a triangle, drawn along it
HULL = ("{set: {hull: [{translate: {by: [4.8, 0, 0.4], of: {ball: {radius: 0.5, dimension: 3}}}}, "
        "{polytope: [[5, 2, 0.5], [5.2, 1.5, 1], [4.5, 1.8, 0.2]]}]}}")
HULL_FALSIFIED = (("rope_set_reaction", 3, 3, 1e-2), ("rope_set_reaction", 8, 4, 1e-2), ("rope_set_reaction", 12, 5, -1e-2), ("rope_position", 7, 3*60, 1e-4),
                  ("rope_position", 9, 3*60 + 2, 1e-4), ("rope_end_force", 8, 3, 1e-2), ("rope_ledger_ends", 9, 0, 1e-2))
FORM_FALSIFIED = (("origin", 0, 1e-3), ("origin", 2, -1e-3), ("map", 1, 1e-3), ("offset", 3, 1e-3), ("rows", 2, 1e-3), ("cone", 0, 1), ("cone", 0, -1), ("map", 0, math.inf))


def hull(folder, stiffness):
    """An end in a set that is given by an expression."""
    scene, out, results = solve(folder, POST.replace(ON, HULL).replace("STIFFNESS", stiffness))
    assert results.steps == 16
    assert results.get("rope_position", 11)[181] > 1 and math.hypot(*results.get("rope_set_reaction", 11)[3:]) > 10
    for variable, step, index, change in HULL_FALSIFIED:
        falsify(results, out, variable, step, index, change)
        code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
        assert code != 0, (variable, step, said)
    for what, index, change in FORM_FALSIFIED:
        falsify_attribute(out, "rope_set_B_" + what, index, change)
        code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
        assert code != 0, (what, said)
    return len(HULL_FALSIFIED) + len(FORM_FALSIFIED)


# an end on a rail that comes out of the bed at (10, 0, 0), and goes away from the other end there
OUT_OF_BED = f"""
capstan: 1
obstacles:
  side: {{plane: {{point: [0, 50, 0], normal: [0, -1, 0]}}, friction: 0.3}}
  bed: {{plane: {{}}, friction: 0.3}}
lines:
  rope:
    length: {math.hypot(10.2, 0.1)!r}
    elements: 12
    mass: 1
    stiffness: .inf
    start: {{straight: {{from: [0, 0, 0], to: [10.2, 0, 0.1]}}}}
    ends: {{A: {{held: [0, 0, 0]}}, B: {{on: {{rail: {{from: [8, 0, -1], to: [12, 0, 1]}}}}}}}}
history:
  - {{name: near, rope.A: {{position: [-0.1, 0, 0]}}}}
  - {{name: far, rope.A: {{position: [-0.5, 0, 0]}}}}
"""
OUT_FALSIFIED = (("rope_proof_length", 0, 1e-6), ("rope_proof_plane", 0, -1), ("rope_proof_plane", 0, -2), ("rope_proof", 0, 1e-3), ("rope_proof", 1, 0.1))


def out_of_bed(folder):
    """An end that reaches its rail below the bed only: the line lacks what it is shorter than the way to where the rail comes out."""
    scene, out, results = solve(folder, OUT_OF_BED, (5,))
    lacks = 10.5 - math.hypot(10.2, 0.1)
    assert results.steps == 2 and abs(results.get("rope_proof_length", 1)[0] - lacks) < 1e-13, results.get("rope_proof_length", 1)
    assert max(abs(a - b) for a, b in zip(results.get("rope_proof", 1), (1, 0, 0))) < 1e-13 and results.get("rope_proof_plane", 1)[0] == 1
    for variable, index, change in OUT_FALSIFIED:
        falsify(results, out, variable, 1, index, change)
        code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
        assert code != 0, (variable, said)
    return len(OUT_FALSIFIED)


def vector(numbers):
    return "[" + ", ".join(repr(float(x)) for x in numbers) + "]"


def matrix(rows):
    return "[" + ", ".join(vector(row) for row in rows) + "]"


def random_expression(rng, size, depth=0):
    """A bounded set of space around 0, as an expression: balls, ellipsoids, boxes, segments and polytopes, flat ones among them, and operations on
    them."""
    def some(scale, count=3):
        return [rng.uniform(-1, 1)*scale for _ in range(count)]

    def part():
        return "{" + random_expression(rng, size, depth + 1) + "}"
    plain, made = ["ball", "box", "ellipsoid", "segment", "polytope"], ["hull", "sum", "intersection", "image", "translate", "scale", "product", "polar"]
    kind = rng.choice(plain if depth > 1 else plain + 2*made)
    if kind == "ball":
        return f"ball: {{radius: {rng.uniform(0.05, 0.6)*size!r}, dimension: 3}}"
    if kind == "box":
        return f"box: {matrix([[-rng.uniform(0.05, 0.5)*size, rng.uniform(0.05, 0.5)*size] for _ in range(3)])}"
    if kind == "ellipsoid":
        rows = [some(0.3*size) for _ in range(3)]
        shape = [[sum(a*b for a, b in zip(one, two)) + (0.01*size**2 if one is two else 0) for two in rows] for one in rows]
        return f"ellipsoid: {matrix(shape)}"
    if kind == "segment":
        end, share = some(size), rng.uniform(0.1, 1)
        return f"segment: {matrix([end, [-share*x for x in end]])}"
    if kind == "polytope":
        points = [some(0.7*size) for _ in range(rng.choice([2, 3, 5, 9]))]
        return f"polytope: {matrix(points + [[-0.6*sum(p[a] for p in points)/len(points) for a in range(3)]])}"
    if kind in ("hull", "sum", "intersection"):
        return f"{kind}: [{part()}, {part()}]"
    if kind == "image":
        rows = [some(0.6) for _ in range(3)]
        return f"image: {{map: {matrix(rows)}, of: {part()}}}"
    if kind == "translate":  # a ball, so that 0 stays in it
        off = some(0.2*size)
        return f"translate: {{by: {vector(off)}, of: {{ball: {{radius: {math.hypot(*off)*rng.uniform(1.001, 2)!r}, dimension: 3}}}}}}"
    if kind == "scale":
        return f"scale: {{by: {rng.choice([-1, 0.5, 1.2])}, of: {part()}}}"
    if kind == "polar":  # of a set with 0 well inside
        return f"polar: {{box: {matrix([[-rng.uniform(1, 5)/size, rng.uniform(1, 5)/size] for _ in range(3)])}}}"
    return f"product: [{{disc: {rng.uniform(0.1, 0.5)*size!r}}}, {{interval: {vector([-rng.uniform(0, 0.5)*size, rng.uniform(0.1, 0.5)*size])}}}]"


def random_set(rng, place, size, bounded):
    """A set of any kind that has the place in it, and its keys."""
    def some(scale):
        return [rng.uniform(-1, 1)*scale for _ in range(3)]
    kind, axis = rng.choice(["rail", "ball", "disc", "box", "set"] if bounded else ["rail", "line", "half_space", "ball", "disc", "box", "set", "set"]), some(1)
    length = math.hypot(*axis)
    if kind == "set":
        return f"set: {{translate: {{by: {vector(place)}, of: {{{random_expression(rng, size)}}}}}}}"
    if kind == "line":
        return f"rail: {{from: {vector(place)}, along: {vector(axis)}}}"
    if kind == "rail":
        back, on = rng.uniform(0, 1)*size/length, rng.uniform(0.1, 1)*size/length
        return (f"rail: {{from: [{', '.join(repr(x - back*a) for x, a in zip(place, axis))}], "
                f"to: [{', '.join(repr(x + on*a) for x, a in zip(place, axis))}]}}")
    if kind == "half_space":
        gap = rng.choice([0, rng.uniform(0, 1)*size])/length
        return f"half_space: {{point: [{', '.join(repr(x - gap*a) for x, a in zip(place, axis))}], normal: [{', '.join(map(repr, axis))}]}}"
    if kind == "ball":
        off = some(0.5*size)
        return f"ball: {{centre: {vector(x + d for x, d in zip(place, off))}, radius: {math.hypot(*off)*rng.uniform(1.0001, 2)!r}}}"
    if kind == "disc":
        return f"disc: {{centre: {vector(place)}, radius: {rng.uniform(0.05, 0.6)*size!r}, normal: {vector(axis)}}}"
    off = some(0.2*size)
    return (f"box: {{centre: {vector(x + d for x, d in zip(place, off))}, size: {vector([rng.uniform(0.8, 1.5)*size for _ in range(3)])}"
            + (f", rotation: {{roll_pitch_yaw: {vector(some(90))}}}" if rng.random() < 0.5 else "") + "}")


def random_scene(rng):
    """One line with a set of any kind at either end or at both, of which one has bounds so that there is an equilibrium, the other end held or loaded; on nothing, a bed or a slope, or over a
    post; inextensible or not, far from the origin or not, with a clump or a buoy; with forces on the ends that grow, turn and end, and moves
    of what is held. Of 16 steps in all."""
    elements, length = rng.choice([6, 17, 40]), rng.choice([2.0, 30.0, 400.0])
    far = rng.choice([0, 0, 1e5])
    ends = rng.choice(["A", "B", "B", "AB"])
    stiffness = rng.choice([".inf", "%g" % (10**rng.uniform(2, 6)*length)])
    kind = rng.choice(["hang", "hang", "bed", "post", "slope"])
    span = length*rng.uniform(0.4, 0.8)
    sag = math.sqrt(length**2 - span**2)/2
    start = f"{{polyline: [[{far}, 0, 0], [{far + span/2!r}, 0, {-sag!r}], [{far + span!r}, 0, 0]]}}"
    if kind in ("bed", "slope"):
        start, span = f"{{straight: {{from: [{far}, 0, 0], to: [{far + length!r}, 0, 0]}}}}", length
    if kind == "post":  # where it is inextensible, a set may come to be out of reach round the post, for which there is no proof
        stiffness = "%g" % (10**rng.uniform(2, 4)*length)
        start, span = f"{{straight: {{from: [{far}, 0, 0], to: [{far + length!r}, 0, 0]}}}}", length
    obstacle = {"hang": "", "bed": f"bed: {{plane: {{point: [{far}, 0, 0]}}, friction: {rng.uniform(0, 1):.3f}}}",
                "slope": f"bed: {{plane: {{point: [{far}, 0, 0], normal: [0, 0.2, 1]}}, friction: {{axial: 0.3, lateral: 0.7}}}}",
                "post": f"post: {{cylinder: {{point: [{far + length/2!r}, 0, {-0.1*length!r}], radius: {0.1*length!r}}}, friction: 0.3}}"}[kind]
    place = {"A": [far, 0, 0], "B": [far + span, 0, 0]}
    words = []
    for end in "AB":
        force = [rng.uniform(-1, 1)*4*length for _ in range(3)]
        if kind in ("bed", "slope"):
            force[2] = abs(force[2])
        if end in ends:
            words.append(f"{end}: {{on: {{{random_set(rng, place[end], 0.3*length, end + ends == 'AAB')}, force: {vector(force) if rng.random() < 0.5 else [0, 0, 0]}}}}}")
        else:
            words.append(f"{end}: held")
    hung = f"\n    point_weights: [{{at: {length/elements*(elements//2)!r}, weight: {rng.choice([-3, 6])*length}}}]" if rng.random() < 0.3 else ""
    history = []
    for steps in (5, 4, 7):
        entry = [f"steps: {steps}"]
        for end in "AB":
            if end in ends:
                push = [rng.uniform(-1, 1)*(3 if kind == "post" else 8)*length for _ in range(3)]
                if kind in ("bed", "slope"):
                    push[2] = abs(push[2])
                entry.append(f"rope.{end}: {{force: {vector(push if rng.random() < 0.8 else [0, 0, 0])}}}")
            elif rng.random() < 0.4:
                move = [rng.uniform(-0.05, 0.05)*length for _ in range(3)]
                if kind in ("bed", "slope", "post"):
                    move[2] = abs(move[2]) + (0.3*abs(move[1]) if kind == "slope" else 0)
                entry.append(f"rope.{end}: {{move: {vector(move)}}}")
        history.append("  - {" + ", ".join(entry) + "}")
    return (f"capstan: 1\nobstacles: {{{obstacle}}}\nlines:\n  rope:\n    length: {length!r}\n    elements: {elements}\n    weight: 10{hung}\n"
            f"    stiffness: {stiffness}\n    start: {start}\n    ends: {{{', '.join(words)}}}\nhistory:\n" + "\n".join(history) + "\n")


def histories(folder, first, last):
    """At least 99 % of the steps are certified or proved to have no equilibrium, and the checker finds nothing in any."""
    steps = certified = 0
    refused = []
    for seed in range(first, last):
        text = random_scene(random.Random(seed))
        scene, out = write(folder, "scene.yaml", text), os.path.join(folder, "out")
        code, said = command(CAPSTAN, "run", scene, "-o", out, "--force")
        if code == 3:
            refused.append((seed, said))
            continue
        assert code in (0, 1, 5), f"seed {seed}: {code} {said}"
        code, said = command(CHECKER, os.path.join(out, "result.nc"), scene, "-v")
        assert "refuted 0" in said and "against the scene: 0" in said or code == 0, f"seed {seed}: {said}{text}"
        with open(os.path.join(out, "summary.json")) as file:
            outcomes = [step["outcome"] for step in json.load(file)["steps"]]
        good = sum(outcome in ("solved", "taut", "unbounded", "infeasible", "slides") for outcome in outcomes)
        if good < len(outcomes):
            print(f"seed {seed}: {len(outcomes) - good} of {len(outcomes)} steps not certified", outcomes[-1])
        steps, certified = steps + len(outcomes), certified + good
    assert not refused, refused[0]
    assert certified >= 0.99*steps, (certified, steps)
    return last - first, certified, steps


def mistakes(folder):
    text = POST.replace("STIFFNESS", "20000")
    for good, wrong, words in BAD:
        assert good in text, good
        scene = write(folder, "bad.yaml", text.replace(good, wrong))
        code, said = command(CAPSTAN, "check", scene)
        assert code == 3 and said.startswith(f"capstan: {scene}:{words}"), (wrong, said)
    # a line with a set does not end at a point
    for kind in ("held", "free"):
        knot = text.replace("lines:", f"points: {{k: {{{kind}: [-5, 0, 0.5]}}}}\nlines:").replace("A: {force: [-60, 0, 0]}", "A: {point: k}")
        knot = knot.replace("  - {name: down, rope.A: {force: [0, 0, -60]}, steps: 6}\n", "")
        code, said = command(CAPSTAN, "check", write(folder, "bad.yaml", knot))
        assert code == 3 and "the set of end B does not go together with a point at the other end" in said, said
    # the method of 1990 has no sets
    scene = write(folder, "scene.yaml", text)
    code, said = command(CAPSTAN, "run", scene, "--method", "regularized", "-o", os.path.join(folder, "no"))
    assert code != 0 and not os.path.exists(os.path.join(folder, "no", "summary.json")), said
    return len(BAD) + 2


def main():
    numbers = [int(word) for word in sys.argv[3:5]]
    with tempfile.TemporaryDirectory() as folder:
        if numbers:
            print("%d random histories, %d of %d steps certified or proved to have no equilibrium" % histories(folder, *numbers))
            return 0
        wrong = mistakes(folder)
        copies = sum(post(folder, stiffness) for stiffness in ("20000", ".inf"))
        copies += sum(hull(folder, stiffness) for stiffness in ("20000", ".inf"))
        copies += out_of_bed(folder)
        resumed(CAPSTAN, folder, POST.replace("STIFFNESS", "20000").replace("90, 0]}, steps: 6", "90, 0]}, steps: 150"),
            400000, 160, range(160),
            ("rope_position", "rope_tension", "rope_set_reaction", "rope_ledger_ends"))
    with tempfile.TemporaryDirectory() as folder:
        resumed(CAPSTAN, folder, POST.replace(ON, HULL).replace("STIFFNESS", "20000").replace("90, 0]}, steps: 6", "90, 0]}, steps: 150"),
                400000, 160, range(160),
                ("rope_position", "rope_tension", "rope_set_reaction", "rope_ledger_ends"))
    with tempfile.TemporaryDirectory() as folder:
        ran = histories(folder, 0, SEEDS)
        for seed in AGAIN:
            ran = [a + b for a, b in zip(ran, histories(folder, seed, seed + 1))]
    print(f"{ran[0]} random histories with {ran[1]} of {ran[2]} steps certified; {copies} falsified copies and {wrong} mistakes refused")
    return 0


if __name__ == "__main__":
    sys.exit(main())
