#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run with free points in sets: the checker finds nothing, copies with a number changed are refused, a run that is stopped and resumed
has the same numbers, sets are drawn once, and mistakes are told with their place.

usage: point_sets.py CAPSTAN CHECKER
"""
import csv
import json
import os
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is left in the source folder
import runs  # noqa: E402
from runs import command, falsify, falsify_attribute, resumed, write  # noqa: E402

CAPSTAN, CHECKER = (os.path.abspath(path) for path in sys.argv[1:3])

# a trolley on a rail and a ring within a hull, lines between them and to anchors; a third point in no set
NET = """
capstan: 1
points:
  trolley: {free: [0, 0, 0], weight: 40, force: [0, 5, -10], on: {rail: {from: [-3, 0, 0], to: [3, 0, 0]}}}
  ring: {free: [6, 0, -1], weight: 20, on: {set: {hull: [{translate: {by: [6, 0, -1], of: {ball: {radius: 0.5, dimension: 3}}}}, {polytope: [[7, 1, -1], [7, -1, -2], [7, 0, 0]]}]}}}
  knot: {free: [3, 3, -1], weight: 30}
lines:
  left: {length: 5, elements: 12, mass: 0.5, stiffness: STIFFNESS, start: static, ends: {A: {held: [-4, -1, 2]}, B: {point: trolley}}}
  between: {length: 9.5, elements: 16, mass: 0.5, stiffness: STIFFNESS, start: static, ends: {A: {point: trolley}, B: {point: ring}}}
  right: {length: 5, elements: 12, mass: 0.5, stiffness: STIFFNESS, start: static, ends: {A: {point: ring}, B: {held: [9, 1, 2]}}}
  high: {length: 6, elements: 12, mass: 0.5, stiffness: STIFFNESS, start: static, ends: {A: {point: knot}, B: {held: [3, 5, 3]}}}
  low: {length: 6, elements: 12, mass: 0.5, stiffness: STIFFNESS, start: static, ends: {A: {point: knot}, B: {point: trolley}}}
history:
  - {name: draw, trolley.point: {force: [90, 5, -10]}, ring.point: {force: [0, 80, 10]}, steps: 6}
  - {name: back, trolley.point: {force: [-200, 0, 0]}, left.A: {position: [-6, -1, 2]}, steps: 4}
"""
# (variable, step, index, change): the points are numbered as they are written
FALSIFIED = (("set_reaction_of_point", 2, 1, 1e-2), ("set_reaction_of_point", 5, 3, 1e-2), ("set_reaction_of_point", 7, 0, -1e-1), ("set_reaction_of_point", 4, 6, 1e-3),
             ("position_of_point", 3, 1, 1e-6), ("position_of_point", 6, 4, 1e-4), ("residual_of_point", 3, 2, 1e-2), ("state_of_point", 3, 0, 1))
STATIC_FALSIFIED = (("set_point_of_point", 0, 1e-6), ("set_axis_of_point", 1, 0.1), ("set_length_of_point", 0, -0.5), ("set_kind_of_point", 0, 1),
                    ("set_kind_of_point", 2, 3), ("set_radius_of_point", 1, 1), ("set_size_of_point", 0, 1), ("set_rotation_of_point", 0, 1))
FORM_FALSIFIED = (("origin", 0, 1e-3), ("map", 1, 1e-3), ("offset", 3, 1e-3), ("rows", 2, 1e-3), ("cone", 0, 1))
ON = "{rail: {from: [-3, 0, 0], to: [3, 0, 0]}}"
FREE = "trolley: {free: [0, 0, 0], weight: 40, force: [0, 5, -10], on: " + ON + "}"
DRAW = "trolley.point: {force: [90, 5, -10]}"
LEFT = "mass: 0.5, stiffness: 20000, start: static, ends: {A: {held: [-4, -1, 2]}, B: {point: trolley}}"
BAD = (  # (what is replaced, by what, what is said)
    (ON, "{}", "4:62: 'on': nothing given, expected exactly one of 'rail', 'half_space', 'ball', 'disc', 'box', 'set'"),
    (ON, "rail", "4:62: 'on': found 'rail', expected a mapping"),
    (ON, "{rod: {}}", "4:67: 'on': unknown key 'rod'"),
    (ON, "{rail: {from: [-3, 0, 0], to: [3, 0, 0]}, force: [1, 0, 0]}", "4:108: 'on': unknown key 'force'"),
    (ON, "{rail: {from: [-3, 0, 0], to: [3, 0, 0]}, ball: {centre: [0, 0, 0], radius: 1}}", "4:62: 'on': too much given"),
    (ON, "{rail: {from: [-3, 0, 0]}}", "4:67: 'rail': nothing given, expected exactly one of 'to', 'along'"),
    (ON, "{rail: {from: [-3, 0, 0], to: [-3, 0, 0]}}", "4:62: rail: it goes from (-3, 0, 0) m to the same place"),
    (ON, "{rail: {from: [-3, 0, 0], along: [0, 0, 0]}}", "4:62: point 'trolley': its set has an axis without a direction"),
    (ON, "{rail: {from: [-3, 0, .nan], to: [3, 0, 0]}}", "4:88: 'from': found '.nan', expected a number"),
    (ON, "{half_space: {point: [0, 0, 0]}}", "4:67: 'half_space': 'normal' is missing"),
    (ON, "{ball: {centre: [0, 0, 0], radius: 0}}", "4:93: 'radius': found '0', expected a number in m, greater than 0"),
    (ON, "{ball: {centre: [0, 0, 0], radius: .inf}}", "4:93: 'radius': found '.inf', expected a number in m"),
    (ON, "{disc: {centre: [0, 0, 0], radius: 1, normal: [0, 0, 0]}}", "4:62: point 'trolley': its set has an axis without a direction"),
    (ON, "{box: {centre: [0, 0, 0], size: [1, 0, 1]}}", "4:102: 'size': found '0', expected a number in m, greater than 0"),
    (ON, "{set: {disc: 1}}", "4:67: point 'trolley': its set lies in R^2, expected R^3"),
    (ON, "{set: {half_space: {normal: [0, 0, 1], offset: 1}}}", "4:67: point 'trolley': its set is unbounded: intersect it with a box that the line does not leave"),
    (ON, "{set: {intersection: [{ball: {radius: 1, dimension: 3}}, {point: [3, 0, 0]}]}}", "4:67: point 'trolley': its set has no answer: the set is empty"),
    (FREE, FREE.replace("free:", "held:").replace(", force: [0, 5, -10]", ""), "4:42: 'on': it goes with 'free', which is not given"),
    (LEFT, LEFT.replace("start: static", "start: {straight: {from: [-4, -1, 2], to: [0, 0, 1]}}"), "8:64: line 'left': start is"),
    (DRAW, "trolley.point: {position: [1, 0, 0]}", "14:18: stage 1: point 'trolley' is moved, but it is held to a set, which stays where it is: give it a force"),
    ("steps: 6}", "duration: 2, time_step: 0.1}", "14:90"),
)
START = """
capstan: 1
points: {k: {free: [0, 0, 1], on: {rail: {from: [-3, 0, 0], to: [3, 0, 0]}}}}
lines: {rope: {length: 5, elements: 4, mass: 1, stiffness: 1e4, start: {straight: {from: [-5, 0, 1], to: [0, 0, 1]}}, ends: {A: held, B: {point: k}}}}
history: [{steps: 1}]
"""


def net(folder, stiffness):
    scene, out, results = runs.solve(CAPSTAN, CHECKER, folder, NET.replace("STIFFNESS", stiffness))
    assert results.steps == 11
    for step in range(11):
        x, force = results.get("position_of_point", step), results.get("set_reaction_of_point", step)
        assert abs(x[1]) < 1e-12 and abs(x[2]) < 1e-12 and -3 - 1e-12 < x[0] < 3 + 1e-12, (step, x)
        # between the ends of the rail there is no reaction along it; of no set there is none at all
        assert abs(abs(x[0]) - 3) < 1e-9 or force[0] == 0, (step, x, force)
        assert tuple(force[6:]) == (0, 0, 0), (step, force)
    assert results.get("set_reaction_of_point", 10)[0] > 1, "the end of the rail bears"
    with open(os.path.join(out, "summary.json")) as file:
        said = json.load(file)["steps"][10]["points"]
    with open(os.path.join(out, "points.csv"), newline="") as file:
        row = list(csv.DictReader(file))[-3]
    wanted = list(results.get("set_reaction_of_point", 10)[:3])
    assert said["trolley"]["set_reaction_N"] == wanted and "set_reaction_N" not in said["knot"], said
    assert row["point"] == "trolley" and [float(row["set_reaction_" + axis]) for axis in "xyz"] == wanted, row
    with open(os.path.join(out, "sets.vtp")) as file:
        assert 'NumberOfLines="0"' not in file.read()
    if stiffness == ".inf":  # the checker takes longer over tensions that have a range
        return 0
    for variable, step, index, change in FALSIFIED:
        falsify(results, out, variable, step, index, change)
        code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
        assert code != 0, (variable, step, index, said)
    for variable, index, change in STATIC_FALSIFIED:
        falsify(results, out, variable, None, index, change)
        code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
        assert code != 0, (variable, said)
    for what, index, change in FORM_FALSIFIED:
        falsify_attribute(out, "ring_set_" + what, index, change)
        code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
        assert code != 0, (what, said)
    return len(FALSIFIED) + len(STATIC_FALSIFIED) + len(FORM_FALSIFIED)


def mistakes(folder):
    text = NET.replace("STIFFNESS", "20000")
    for good, wrong, words in BAD:
        assert good in text, good
        scene = write(folder, "bad.yaml", text.replace(good, wrong))
        code, said = command(CAPSTAN, "check", scene)
        assert code == 3 and said.startswith(f"capstan: {scene}:{words}"), (wrong, said)
    code, said = command(CAPSTAN, "check", write(folder, "bad.yaml", START))
    assert code == 3 and "its set is 1 m away from where the start puts the point, (0, 0, 1) m: let it begin in the set, as at (0, 0, 0) m" in said, said
    water = text.replace("capstan: 1", "capstan: 1\nwater_density: 1000\nwater_surface: 5").replace("weight: 40,", "mass: 40, volume: 0.01,")
    code, said = command(CAPSTAN, "check", write(folder, "bad.yaml", water))
    assert code == 3 and "does not go together with a point that may leave the water" in said, said
    # the method of 1990 has no points
    scene = write(folder, "scene.yaml", text)
    code, said = command(CAPSTAN, "run", scene, "--method", "regularized", "-o", os.path.join(folder, "no"))
    assert code != 0 and not os.path.exists(os.path.join(folder, "no", "summary.json")), said
    return len(BAD) + 2


def main():
    with tempfile.TemporaryDirectory() as folder:
        wrong = mistakes(folder)
        copies = sum(net(folder, stiffness) for stiffness in ("20000", ".inf"))
        resumed(CAPSTAN, folder, NET.replace("STIFFNESS", "20000").replace("steps: 6", "steps: 60"), 240000, 65, range(65),
                ("left_position", "between_tension", "position_of_point", "set_reaction_of_point", "residual_of_point"))
    print(f"{copies} falsified copies and {wrong} mistakes refused")
    return 0


if __name__ == "__main__":
    sys.exit(main())
