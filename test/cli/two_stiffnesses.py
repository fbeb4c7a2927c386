#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run with a static and a dynamic stiffness: a run that is killed in a stage of either and resumed has the same numbers, bit for bit,
among them the rest strains from which the dynamic stiffness counts; and the checker finds nothing in it.
                                                                                   usage: two_stiffnesses.py CAPSTAN CHECKER
"""
import os
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is left in the source folder
from runs import command, resumed, write  # noqa: E402

CAPSTAN, CHECKER = (os.path.abspath(path) for path in sys.argv[1:3])
# a leg of chain and polyester that lies on a bed in part; its upper end goes out slowly, to and fro fast, and so on
SCENE = """capstan: 1
gravity: [0, 0, -9.81]
obstacles: {bed: {plane: {point: [0, 0, 0]}, friction: 0.6}}
types:
  chain: {weight: 900, stiffness: 8e8}
  polyester: {weight: 60, stiffness: {strain: [0, 0.02, 0.06], tension: [0, 4e5, 2e6]}, dynamic_stiffness: 8e7}
lines:
  leg:
    sections: [{type: chain, length: 150, elements: 30}, {type: polyester, length: 300, elements: 40}]
    start: static
    ends: {A: {held: [0, 0, 0]}, B: {held: [420, 0, 120]}}
history:
"""
ROUNDS, STEPS = 12, 4


def history():
    out = ""
    for k in range(ROUNDS):
        x = 425 + 1.5*k
        out += f"  - {{steps: {STEPS}, stiffness: static, leg.B: {{position: [{x}, 0, 120]}}}}\n"
        out += f"  - {{steps: {STEPS}, leg.B: {{position: [{x + 1}, 0.5, 120.5]}}}}\n  - {{steps: {STEPS}, leg.B: {{position: [{x - 1}, 0, 119.5]}}}}\n"
    return out


def main():
    count = 1 + 3*ROUNDS*STEPS
    with tempfile.TemporaryDirectory() as folder:
        text = SCENE + history()
        resumed(CAPSTAN, folder, text, 600000, count, (5, 30, 31, 60, count - 1),
                ("leg_position", "leg_tension", "leg_rest_strain", "leg_stiffness", "leg_ledger_elastic", "leg_ledger_ends"))
        code, said = command(CHECKER, os.path.join(folder, "parts", "result.nc"), write(folder, "scene.yaml", text), "-v")
        assert code == 0 and f"records {count}, certified {count}" in said, said
    print(f"{count} steps of two stiffnesses, the same after a kill")
    return 0


if __name__ == "__main__":
    sys.exit(main())
