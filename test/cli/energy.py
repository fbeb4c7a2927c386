# SPDX-License-Identifier: BSD-3-Clause
"""What a run says of energy: the figures of a loop's picture are the ledger's, iterations are those of all that was solved, and energy
that is not accounted for is told.

    energy.py capstan
"""
import json
import os
import re
import subprocess
import sys
import tempfile

LOOP = """capstan: 1
gravity: [0, 0, -9.81]
obstacles: {bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.6}}
lines:
  chain: {length: 100, elements: 50, weight: 500, stiffness: 5e5, start: static, ends: {A: {held: [0, 0, 0]}, B: {held: [80, 0, 45]}}}
history:
  - {name: surge out, chain.B: {position: [80, 15, 45]}, steps: 2}
  - {name: surge back, chain.B: {position: [80, 0, 45]}, steps: 2}
solver: {path_tolerance: TOLERANCE}
"""

SWING = """capstan: 1
obstacles: {bed: {plane: {}, friction: 0.6}}
lines:
  chain: {length: 10, elements: 20, mass: 5, stiffness: 5e5, start: static, ends: {A: {held: [0, 0, 0]}, B: {held: [8, 0, 4]}}}
history: [{name: swing, duration: 9, time_step: 0.05, chain.B: {move: [0, 0, 0], CHANGE}}]
"""

# A rope over balls, one of which turns: between the equilibria before and after its first step lies a jump.
BRANCH = """capstan: 1
gravity: [0, 0, -9.81]
obstacles:
  b0: {sphere: {centre: [-0.767, 0.139, 0.006], radius: 0.125, axis: [-0.991, -0.672, 1]}, friction: 0}
  b1: {sphere: {centre: [0.679, -0.105, -0.103], radius: 0.166, axis: [0.547, 0.506, 1]}, friction: 0.846}
  b2: {sphere: {centre: [-0.184, 0.422, 0.008], radius: 0.12, axis: [-0.763, -0.334, 1]}, friction: 0.136}
lines:
  a:
    length: 1.099
    elements: 59
    weight: 0.91
    stiffness: 3150.266
    start: {straight: {from: [0, 0, 0], to: [-0.8144328489225996, 0.7196483974872974, 0.16311443404002857]}}
    ends: {A: held, B: free}
history:
  - {name: s0, steps: 3, a.B: {position: [0.11, 0.433, 0.407]}, b0.turn: 20.296, b1.turn: 35.58}
solver: {halvings: HALVINGS}
"""

# A line without stiffness to speak of, high above a bed: it falls.
FALL = """capstan: 1
gravity: [0, 0, -9.81]
obstacles: {bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.1}}
lines:
  a: {length: 10, elements: 20, weight: 5, stiffness: 1e6, start: {straight: {from: [0, 0, 8], to: [10, 0, 8]}}, ends: {A: held, B: free}}
history: [{name: fall, steps: 1}]
"""


def run(capstan, directory, scene):
    """The steps of a scene, and what was said on the way."""
    path = os.path.join(directory, "scene.yaml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(scene)
    out = os.path.join(directory, "out")
    done = subprocess.run([capstan, "run", path, "-o", out], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr  # 1: a step is not certified, which may be where nothing may be cut
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return json.load(file)["steps"], done.stderr, done.stdout


def read_joule(pattern, text):
    number, unit = re.search(pattern + r": ([-0-9.e+]+) (k|M|)J", text).groups()
    return float(number) * {"": 1, "k": 1e3, "M": 1e6}[unit]


def loops(capstan, directory):
    """The figures of the picture against the sums of the ledger, end A being at rest."""
    cuts = 0
    for tolerance in (0, 1e-2):
        steps, _, table = run(capstan, directory, LOOP.replace("TOLERANCE", repr(tolerance)))
        with open(os.path.join(directory, "out", "loop-surge.svg"), encoding="utf-8") as file:
            text = file.read()
        work, lost = (sum(step["ledger_J"][key] for step in steps) for key in ("ends", "dissipated"))
        assert abs(read_joule("at this end", text) - work) <= 6e-4 * abs(work), (tolerance, work, text)  # four digits
        assert abs(read_joule("dissipated by friction", text) - lost) <= 6e-4 * lost, (tolerance, lost)
        cuts += any(step["substeps"] > 1 for step in steps)
        last = [row for row in table.splitlines() if row.startswith("surge back 2/2")][0].split()
        assert int(last[last.index("solved") + 1]) == steps[-1]["substeps"], last
        if tolerance:
            # whole and halves of every part were solved: more than one and a half times what was kept
            assert all(step["iterations"] > 1.2 * 8 * step["substeps"] for step in steps[1:]), steps
    assert cuts == 1


def cycles(capstan, directory):
    """The last cycle of an end that swings in one entry: by sixty steps from the end, or a series as a whole; and none where no cycle ends."""
    for change, first in (("sine: [0.5, 0, 0.1], period: 3", 121), ("cosine: [0.5, 0, 0.1], period: 3", 121), ("series: way.csv", 1),
                          ("sine: [0.5, 0, 0.1], period: 10", None)):
        with open(os.path.join(directory, "way.csv"), "w", encoding="utf-8") as file:
            file.write("time,x\n0,0\n3,0.5\n6,0.1\n9,0\n")
        steps, _, _ = run(capstan, directory, SWING.replace("CHANGE", change))
        drawn = os.path.join(directory, "out", "loop-swing.svg")
        assert os.path.exists(drawn) == (first is not None), change
        if first is None:
            continue
        with open(drawn, encoding="utf-8") as file:
            text = file.read()
        assert f"steps {first} to 181, from" in text and text.count("<circle") == 2*(182 - first), change
        # end A is at rest
        work, lost = (sum(step["ledger_J"][key] for step in steps[first:]) for key in ("ends", "dissipated"))
        assert abs(read_joule("at this end", text) - work) <= 6e-4*abs(work), (change, work)
        assert abs(read_joule("dissipated by friction", text) - lost) <= 6e-4*lost, (change, lost)


def exchanged(ledger):
    """Dissipated plus positive work."""
    return ledger["dissipated"] + sum(max(0, x) for x in (ledger["ends"], ledger["obstacles"], -ledger["elastic"], -ledger["gravity"]))


def branches(capstan, directory):
    """Energy that a step makes is told where it may not be cut, and gone where it may."""
    steps, said, _ = run(capstan, directory, BRANCH.replace("HALVINGS", "1"))
    made = [step for step in steps if step["unaccounted_J"] > 0]
    assert made and "the energy does not close" in said, said
    for step in (step for step in steps if step["substeps"] == 1):
        over = -step["ledger_J"]["imbalance"]
        assert (step["unaccounted_J"] > 0) == (over > 0.05 * exchanged(step["ledger_J"])), step
    steps, said, _ = run(capstan, directory, BRANCH.replace("HALVINGS", "10"))
    assert all(step["outcome"] == "solved" for step in steps)
    assert all(step["unaccounted_J"] == 0 for step in steps) and "does not close" not in said, said
    assert any(step["substeps"] > 1 for step in steps)
    for step in steps:
        assert -step["ledger_J"]["imbalance"] <= 0.05 * exchanged(step["ledger_J"]), step


def other_way_round(scene):
    """The same line from B to A."""
    return (scene.replace("from: [0, 0, 0], to: [-0.8144328489225996, 0.7196483974872974, 0.16311443404002857]",
                          "from: [-0.8144328489225996, 0.7196483974872974, 0.16311443404002857], to: [0, 0, 0]")
            .replace("A: held, B: free", "A: free, B: held").replace("a.B", "a.A"))


def names(capstan, directory):
    """Which end is called A decides nothing."""
    scene = BRANCH.replace("HALVINGS", "10")
    assert other_way_round(scene) != scene
    one, other = run(capstan, directory, scene)[0], run(capstan, directory, other_way_round(scene))[0]
    for step, same in zip(one, other):
        for end, match in ("AB", "BA"):
            here, there = step["lines"]["a"][end]["tension_N"], same["lines"]["a"][match]["tension_N"]
            known = step["tension_estimate_N"] + same["tension_estimate_N"]  # elongation against equilibrium
            assert abs(here - there) <= 1e-6 * step["largest_force_N"] + known, (step["name"], end, here, there)
        assert abs(step["ledger_J"]["imbalance"] - same["ledger_J"]["imbalance"]) <= 0.01 * exchanged(step["ledger_J"])


def falls(capstan, directory):
    """Energy that is set free is told."""
    steps, said, _ = run(capstan, directory, FALL)
    assert steps[0]["ledger_J"]["imbalance"] > 100 and "are set free" in said, said


def main():
    with tempfile.TemporaryDirectory() as directory:
        for check in (loops, cycles, branches, names, falls):
            check(sys.argv[1], directory)
            print(check.__name__, "passed")


main()
