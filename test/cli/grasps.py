#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run on lines that are grasped between their ends: the checker finds nothing, the forces in result.nc balance, and copies with a
number changed are refused.                                                                             usage: grasps.py CAPSTAN CHECKER

Written by nothing but the layout of classic netCDF files (../property/result_file.py).
"""
import math
import os
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "property"))
sys.dont_write_bytecode = True  # nothing is left in the source folder
from result_file import CODE, Results, SIZE  # noqa: E402

CAPSTAN, CHECKER = (os.path.abspath(path) for path in sys.argv[1:3])

SCENE = """
capstan: 1
obstacles:
  floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.3}
  pipe: {cylinder: {point: [3, 0, 0.3], axis: [0, 1, 0], radius: 0.3}, friction: 0.5}
lines:
  rope:
    length: 8
    elements: 120
    mass: 1
    stiffness: STIFFNESS
    start: {straight: {from: [0, 0, 2], to: [8, 0, 2]}}
    ends: {A: {held: [0, 0, 2]}, B: {force: [5, 0, 0]}}
history:
  - {name: lower, rope.A: {position: [0, 0, 0]}, steps: 4}
  - {name: grasp, rope.node: {at: 4, hold: true}, rope.node2: {at: 6, force: [0, 1, 0]}}
  - {name: lift, rope.node: {at: 4, position: [3.5, 0.4, 1.5]}, steps: 4}
  - {name: second, rope.node: {at: 6, hold: true}, rope.node2: {at: 4, force: [0, 0, 0]}, steps: 3}
  - {name: let go, rope.node: {at: 6, release: true}}
  - {name: too far, rope.node: {at: 2, position: [0, 0, FAR]}}
"""
MIXED = SCENE[:SCENE.index("  - {name: second")] + """  - {name: both, rope.node: {at: 6, hold: true}}
  - {name: let go, rope.node: {at: 6, release: true}, rope.node2: {at: 4, force: [0, 0, 0]}, steps: 2}
"""
NODES = {5: [60, 90], 9: [60, 90], 10: [60, 90], 12: [60, 90], 13: [90], 14: [30]}  # what is grasped after so many steps
# (variable, step, index, change, words of the finding)
FALSIFIED = (("rope_grasp_node", 8, 0, 1, ""), ("rope_grasp_kind", 8, 0, 1, "a value that cannot be"),
             ("rope_grasp_held_position", 8, 1, 1e-6, "distance of a held end"), ("rope_grasp_force", 8, 2, 1e-4, "grasp_force against"),
             ("rope_grasp_applied_force", 6, 4, 1e-3, ""), ("rope_grasp_node", 6, 1, 1, ""), ("rope_ledger_ends", 7, 0, 1e-3, "ledger_ends"),
             ("rope_grasp_node", 13, 0, -60, ""), ("rope_position", 8, 3*60 + 2, 1e-6, ""))


def check(folder, name, scene):
    done = subprocess.run([CHECKER, os.path.join(folder, name), scene], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def falsify(results, folder, variable, step, index, change):
    shape, kind, _, begin = results.variables[variable]
    data = bytearray(results.data)
    at = begin + step*results.record + index*SIZE[kind]
    value, = struct.unpack_from(">" + CODE[kind], data, at)
    assert not math.isnan(value), variable
    struct.pack_into(">" + CODE[kind], data, at, value + change)
    with open(os.path.join(folder, "copy.nc"), "wb") as file:
        file.write(data)


def balance(results, step):
    """The largest difference of grasp_force from what balances its node off all obstacles."""
    worst, force, load = 0, results.get("rope_segment_force", step), results.get("rope_load", step)
    for k, node in enumerate(results.get("rope_grasp_node", step)):
        if node < 0 or results.get("rope_grasp_kind", step)[k]:
            continue
        for a in range(3):
            rest = force[3*node + a] - force[3*node - 3 + a] + load[3*node + a] + results.get("rope_grasp_force", step)[3*k + a]
            worst = max(worst, abs(rest))
    return worst


def try_line(stiffness, folder):
    scene, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
    inextensible = stiffness == ".inf"
    with open(scene, "w") as file:
        file.write(SCENE.replace("STIFFNESS", stiffness).replace("FAR", "6.5" if inextensible else "1"))
    run = subprocess.run([CAPSTAN, "run", scene, "-o", out, "--force"], capture_output=True, text=True)
    assert run.returncode == (5 if inextensible else 0), run.stderr
    code, said = check(out, "result.nc", scene)
    assert code == 0, said
    results = Results(os.path.join(out, "result.nc"))
    for step, nodes in NODES.items():
        if step < results.steps:
            found = [node for node in results.get("rope_grasp_node", step - 1) if node >= 0]
            assert found == nodes or step == 14, (step, found)
    for step in range(4, 9):
        assert balance(results, step) < 1e-9, (step, balance(results, step))
    for variable, step, index, change, words in FALSIFIED:
        falsify(results, out, variable, step, index, change)
        code, said = check(out, "copy.nc", scene)
        assert code != 0 and words in said, (variable, step, said)
    return len(FALSIFIED)


def try_mixed(folder):
    """One node is let go at once and another from the force that held it, in one stage."""
    scene, out = os.path.join(folder, "mixed.yaml"), os.path.join(folder, "mixed")
    with open(scene, "w") as file:
        file.write(MIXED.replace("STIFFNESS", "2000"))
    run = subprocess.run([CAPSTAN, "run", scene, "-o", out], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    code, said = check(out, "result.nc", scene)
    assert code == 0, said
    steps = Results(os.path.join(out, "result.nc")).steps
    falsify(Results(os.path.join(out, "result.nc")), out, "rope_ledger_ends", steps - 2, 0, 1e-3)
    code, said = check(out, "copy.nc", scene)
    assert code != 0 and "ledger_ends" in said, said


def main():
    with tempfile.TemporaryDirectory() as folder:
        try_mixed(folder)
        count = sum(try_line(stiffness, folder) for stiffness in ("2000", ".inf"))
    print(f"{count} falsified copies refused")
    return 0


if __name__ == "__main__":
    sys.exit(main())
