#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run on obstacles that move: known answers, the checker finds nothing, copies with a number changed are refused, a run that is
stopped and resumed has the same numbers, and mistakes are told with their place.                      usage: shifts.py CAPSTAN CHECKER

Written by nothing but the layout of classic netCDF files (../property/result_file.py).
"""
import csv
import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is left in the source folder
import runs  # noqa: E402
from runs import command, falsify, resumed, write  # noqa: E402

CAPSTAN, CHECKER = (os.path.abspath(path) for path in sys.argv[1:3])

ROPE = """
    length: 6
    elements: 60
    mass: 2
    stiffness: STIFFNESS
    start: {straight: {from: [0, 0, 0], to: [6, 0, 0]}}
    ends: ENDS
"""
TABLE = """
capstan: 1
obstacles:
  table: {plane: {}, friction: 0.4}
lines:
  rope:""" + ROPE.replace("ENDS", "{A: free, B: free}") + """
history:
  - {name: tilt, table.obstacle: {turn: ANGLE, axis: [0, 2, 0], about: [2, 0, 0]}, steps: 5}
  - {name: too far, table.obstacle: {turn: 0.04, axis: [0, 1, 0], about: [2, 0, 0]}}
"""
BOLLARD = """
capstan: 1
obstacles:
  ground: {plane: {}, friction: 0.4}
  bollard: {cylinder: {point: [3, -0.4, 0], axis: [0, 0, 1], radius: 0.3}, friction: 0.2}
lines:
  rope:""" + ROPE.replace("ENDS", "{A: free, B: {held: [6, 0, 0]}}") + """
history:
  - {name: push, bollard.obstacle: {move: [0, 0.9, 0]}, steps: 6}
  - {name: turn, bollard.turn: 90, steps: 2}
  - {name: on, bollard.obstacle: {move: [0.3, 0.2, 0], turn: 20, axis: [0.1, 0, 1], about: [3, 0.8, 0]}, bollard.turn: 30, steps: 8}
  - {name: belt, ground.obstacle: {move: [0.2, 0, 0], turn: 10, axis: [0, 0, 1], about: [6, 0, 0]}, steps: 6}
"""
# the first rope goes with the bed from point to point, the second is pushed by a ball that swings, for which its step is taken in parts
BESIDE = """
capstan: 1
obstacles:
  bed: {plane: {}, friction: 0.5}
  ball: {sphere: {centre: [5, 10, 0.5], radius: 0.5}, friction: 0.5}
points:
  P: {held: [0, 0, 0]}
  Q: {held: [6, 0, 0]}
lines:
  first:""" + ROPE.replace("ENDS", "{A: {point: P}, B: {point: Q}}") + """
  second:""" + ROPE.replace("[0, 0, 0]", "[0, 9.2, 0]").replace("[6, 0, 0]", "[6, 9.2, 0]").replace("ENDS", "{A: {held: [0, 9.2, 0]}, B: free}") + """
history:
  - {name: go, bed.obstacle: {move: [0.1, 0, 0]}, P.point: {move: [0.1, 0, 0]}, Q.point: {move: [0.1, 0, 0]}, second.A: {move: [0.1, 0, 0]},
     ball.obstacle: {turn: 10, axis: [0, 0, 1], about: [0, 10, 0.5]}}
"""
# (variable, step, index, change)
FALSIFIED = (("obstacle_shift", 0, 4, 1e-6), ("obstacle_shift", 4, 0, 1e-6), ("obstacle_shift_turn", 9, 5, 1e-6), ("obstacle_shift_about", 9, 3, 1e-4),
             ("obstacle_shift_turn", 18, 2, 1e-6), ("obstacle_shift_about", 18, 1, 1e-5), ("obstacle_place", 3, 4, 1e-6), ("obstacle_place", 20, 0, 1e-6),
             ("obstacle_direction", 12, 3, 1e-6), ("obstacle_direction", 21, 2, 1e-6), ("obstacle_turn", 6, 1, 1e-3),
             ("rope_ledger_obstacles", 18, 0, 1e-3), ("rope_position", 5, 3*30 + 1, 1e-6), ("rope_slip", 19, 3*20, 1e-5))
GOOD = "bollard.obstacle: {move: [0, 0.9, 0]}"
BAD = (
    ("bollard.obstacle: {}", "16:18: 'bollard.obstacle': nothing given, expected 'move', or 'turn' with its 'axis'"),
    ("bollard.obstacle: [0, 1, 0]", "16:18: 'bollard.obstacle': found a list of 3, expected a mapping with move, turn, axis, about"),
    ("bollard.obstacle: {move: [0, 1]}", "16:37: 'move': found a list of 2, expected three numbers in m, as in [x, y, z]"),
    ("bollard.obstacle: {move: [0, 1, .inf]}", "16:50: 'move': found '.inf', expected a number in m, finite"),
    ("bollard.obstacle: {moves: [0, 1, 0]}", "16:37: 'bollard.obstacle': unknown key 'moves'; did you mean 'move'?"),
    ("bollard.obstacle: {turn: 5}", "16:37: 'turn': it goes with 'axis', which is not given"),
    ("bollard.obstacle: {axis: [0, 0, 1]}", "16:37: 'axis': it goes with 'turn', which is not given"),
    ("bollard.obstacle: {move: [1, 0, 0], about: [0, 0, 1]}", "16:54: 'about': it goes with 'turn', which is not given"),
    ("bollard.obstacle: {turn: 5, axis: [0, 0, 0]}", "16:46: 'axis': found a vector of no length, expected a direction"),
    ("bollard.obstacle: {turn: half, axis: [0, 0, 1]}", "16:37: 'turn': found 'half', expected a number in degrees"),
    ("bollard.obstacle: {turn: 4e6, axis: [0, 0, 1]}", "16:18: stage 1: obstacle 'bollard' is shifted with a turn of 4e+06 degrees"),
    ("bollard.obstacle: {move: [0, 4000, 0]}", "16:18: stage 1: obstacle 'bollard' is shifted by 4000 m, the limit is 10000 radii"),
    ("post.obstacle: {move: [0, 1, 0]}", "16:18: 'post.obstacle': there is no such obstacle"),
    ("rope.obstacle: {move: [0, 1, 0]}", "16:18: 'rope.obstacle': there is no such obstacle"),
    ("bollard.move: [0, 1, 0]", "16:18: entry: unknown key 'bollard.move'"),
    (GOOD + ", " + GOOD, "16:57: key 'bollard.obstacle' is given twice"),
    ("ground.turn: 20", "16:18: stage 1: obstacle 'ground' is a plane: only a round obstacle turns about its own axis; ground.obstacle has turns"),
)


def solve(folder, text, stiffness, wanted):
    return runs.solve(CAPSTAN, CHECKER, folder, text.replace("STIFFNESS", stiffness), (wanted,))


def tilt(folder, stiffness):
    """Up to 0.02 degrees below atan(0.4) the rope goes with the table, about (2, 0, 0); 0.02 degrees above it slides without end."""
    angle = math.degrees(math.atan(0.4)) - 0.02
    _, _, results = solve(folder, TABLE.replace("ANGLE", repr(angle)), stiffness, 5)
    assert results.steps == 6
    position, c, s = results.get("rope_position", 4), math.cos(math.radians(angle)), math.sin(math.radians(angle))
    for node in range(61):
        along = 0.1*node - 2
        for found, expected in zip(position[3*node:3*node + 3], (2 + c*along, 0, -s*along)):
            assert abs(found - expected) < 1e-8, (node, found, expected)
    place = results.get("obstacle_direction", 4)
    assert abs(place[0] - s) < 1e-12 and abs(place[2] - c) < 1e-12
    assert results.get("outcome", 5)[0] != results.get("outcome", 4)[0]


def bollard(folder, stiffness):
    scene, out, results = solve(folder, BOLLARD, stiffness, 0)
    place = results.get("obstacle_place", 5)
    assert all(abs(x - y) < 1e-12 for x, y in zip(place, (0, 0, 0, 3, 0.5, 0))), place
    for variable, step, index, change in FALSIFIED:
        falsify(results, out, variable, step, index, change)
        code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
        assert code != 0, (variable, step, said)
    # a scene in which it goes elsewhere is another one
    other = write(folder, "other.yaml", BOLLARD.replace("[0, 0.9, 0]", "[0, 0.9, 0.001]").replace("STIFFNESS", stiffness))
    code, said = command(CHECKER, os.path.join(out, "result.nc"), other)
    assert code != 0 and "shift of obstacle bollard" in said, said
    for name in ("step-00003-obstacles.vtp", "step-00021-obstacles.vtp", "plan.svg"):
        assert os.path.exists(os.path.join(out, name)), name
    return len(FALSIFIED)


def goes_along(folder, stiffness):
    """What goes with the bed does not slip on it, nor do its ends at points, whatever another line does in the step."""
    _, out, results = solve(folder, BESIDE, stiffness, 0)
    assert results.get("first_substeps", 0)[0] == 1 < results.get("second_substeps", 0)[0]
    with open(os.path.join(out, "history.csv"), encoding="utf-8") as file:
        row = list(csv.DictReader(file))[-1]
    assert abs(float(row["first.grounded"]) - 6) < 1e-12 and float(row["first.slipping"]) == 0, (row["first.grounded"], row["first.slipping"])


def mistakes(folder):
    text = BOLLARD.replace("STIFFNESS", "20000")
    for wrong, words in BAD:
        scene = write(folder, "bad.yaml", text.replace(GOOD, wrong))
        code, said = command(CAPSTAN, "check", scene)
        assert code in (3, 6) and said.startswith(f"capstan: {scene}:{words}"), (wrong, said)
    frozen = write(folder, "bad.yaml", "friction_policy: frozen\n" + text)
    code, said = command(CAPSTAN, "check", frozen)
    assert code == 3 and "moves: this needs consistent friction" in said, said
    # the held end is in the way, at the third entry
    way = write(folder, "way.yaml", text.replace("move: [0.3, 0.2, 0], turn: 20", "move: [3, -0.6, 0], turn: 20"))
    code, said = command(CAPSTAN, "run", way, "-o", os.path.join(folder, "way"))
    assert code == 3 and "node 60 of line 'rope' is held in the way of obstacle 'bollard'" in said, said
    return len(BAD) + 2


def main():
    with tempfile.TemporaryDirectory() as folder:
        for stiffness in ("20000", ".inf"):
            tilt(folder, stiffness)
            goes_along(folder, stiffness)
        copies = sum(bollard(folder, stiffness) for stiffness in ("20000", ".inf"))
        resumed(CAPSTAN, folder, BOLLARD.replace("STIFFNESS", "20000").replace("steps: 8", "steps: 200"),
            300000, 214, (10, 30, 100, 213),
            ("rope_position", "rope_tension", "obstacle_place", "obstacle_direction", "obstacle_shift_about"))
        wrong = mistakes(folder)
    print(f"{copies} falsified copies and {wrong} mistakes refused")
    return 0


if __name__ == "__main__":
    sys.exit(main())
