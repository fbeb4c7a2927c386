# SPDX-License-Identifier: BSD-3-Clause
"""Each check of trial_checks.py passes a history made by hand, and finds one number of it that is wrong.

The line has two elements of 1 m and 6 N/m, and hangs as a V between two ends held at the height 0 about a post: EA = 100 N, T = 10 N. In the
second step end B goes 0.1 m away, in the third nothing happens. Numbers of the second step are such that the ledger closes."""
import copy
import json
import math
import sys

import trial_checks as checks
import trial_scenes

STEPS = 3


class Written:
    """A result.nc in memory."""

    def __init__(self, values, attributes):
        self.values, self.attributes, self.steps = values, attributes, STEPS
        self.variables = {name: ([0, len(of[0])], 6, 0, 0) for name, of in values.items() if len(of) == STEPS}

    def get(self, name, step=0):
        of = self.values[name]
        return of[step] if len(of) == STEPS else of[0]


def history():
    half = [0.9, 0.95, 0.95]  # where the node in the middle and end B are: x, and twice x
    sag = [-math.sqrt(1.1**2 - x*x) for x in half]
    place = [[0, 0, 0, x, 0, z, 2*x, 0, 0] for x, z in zip(half, sag)]
    fall = 6*(sag[1] - sag[0])
    values = {"element_length": [[1, 1]], "position": place, "reference": [place[0], place[0], place[1]],
              "tension": [[10, 10]]*STEPS, "segment_force": [[10, 0, 0]*2]*STEPS, "end_kind": [[0, 0]]*STEPS,
              "end_held_position": [[0, 0, 0, 2*x, 0, 0] for x in half], "tension_bound": [[math.nan]]*STEPS}
    single = {"outcome": [0]*STEPS, "substeps": [1]*STEPS, "jumps": [0]*STEPS, "places_not_unique": [0]*STEPS, "unaccounted": [0]*STEPS,
              "gap": [0]*STEPS, "largest_force": [10]*STEPS, "dissipated": [0]*STEPS, "primal": [0]*STEPS, "dual": [0]*STEPS,
              "ledger_ends": [0, fall, 0], "ledger_gravity": [0, fall, 0], "ledger_elastic": [0]*STEPS, "ledger_obstacles": [0]*STEPS,
              "ledger_imbalance": [0]*STEPS}
    values.update({name: [[x] for x in of] for name, of in single.items()})
    scene = {"gravity": [0, 0, -9.81], "obstacles": {"post": {"cylinder": {"point": [0.9, 0, -0.3], "axis": [0, 1, 0], "radius": 0.05}}},
             "lines": {"a": {"weight": 6, "stiffness": 100, "start": {"straight": {}}}}}
    results = Written({f"a_{k}": v for k, v in values.items()}, {"friction_policy": "consistent", "contact_policy": "reached"})
    return checks.Line(scene, results, "a")


def faults(line):
    """of all checks, step by step; the last step is one in which nothing happens"""
    found = []
    for step in range(STEPS):
        found += checks.insane(line, step) or checks.energy_faults(line, step) + checks.winding_faults(line, step)
    return found + (["wanders"] if checks.wanders(line, STEPS - 1) else [])


def turned(line):
    other = history()
    for name in ("a_position", "a_reference"):
        other.results.values[name] = [[c for j in (2, 1, 0) for c in checks.point(x, j)] for x in line.results.values[name]]
    return other


# what is put in: variable, step, index, value; and a word of what must be found
WRONG = (("primal", 1, 0, math.nan, "no number"), ("position", 2, 4, 1e5, "lengths away"), ("tension", 2, 1, 1e9, "tension"),
         ("ledger_ends", 1, 0, 1e20, " J, of"), ("position", 2, 4, 1e-8, "wanders"), ("ledger_gravity", 1, 0, 0.1, "gravity"),
         ("ledger_ends", 1, 0, 0.5, "its sum"), ("tension", 1, 0, 11, "by the tensions"), ("position", 1, 5, 0.55, "goes through post"))

wrong = []
if faults(history()):
    wrong.append(f"a sound history: {faults(history())}")
for name, step, index, value, word in WRONG:
    line = history()
    line.results.values[f"a_{name}"][step] = list(line.results.values[f"a_{name}"][step])
    line.results.values[f"a_{name}"][step][index] = value
    if not any(word in fault for fault in faults(line)):
        wrong.append(f"{name} {value}, step {step}: '{word}' is not in {faults(line)}")

# energy made: the ledger closes, and says nothing of it
line = history()
line.results.values["a_ledger_imbalance"][1] = [-0.5]
line.results.values["a_ledger_ends"][1] = [line.one("ledger_gravity", 1) - 0.5]
if not any("are made" in fault for fault in faults(line)):
    wrong.append(f"energy made: {faults(line)}")

# ends exchanged: the same places pass, others do not but where one says so
for moved, said in ((0, False), (1e-3, False), (1e-3, True)):
    one, other = history(), turned(history())
    other.results.values["a_position"][1][4] += moved
    other.results.values["a_unaccounted"][1] = [1.0 if said else 0.0]
    tally = {"compared": 0, "said": 0}
    silent = checks.parted(({"a": one}, {"a": other}), tally)
    if (len(silent), tally["said"]) != (moved > 0 and not said, moved > 0 and said):
        wrong.append(f"exchanged ends {moved}, {said}: {silent}, {tally}")

# exchanged twice, a scene is itself
for make in trial_scenes.CLASSES:
    scene = trial_scenes.scene(make, 3)
    checks.by_nodes(scene)
    twice = copy.deepcopy(scene)
    checks.exchange(twice)
    once = json.dumps(twice, sort_keys=True)
    checks.exchange(twice)

    def near(a, b):
        if isinstance(a, dict):
            return a.keys() == b.keys() and all(near(a[k], b[k]) for k in a)
        if isinstance(a, list):
            return len(a) == len(b) and all(near(x, y) for x, y in zip(a, b))
        return abs(a - b) <= 1e-12*(abs(a) + scene["lines"][next(iter(scene["lines"]))]["length"]) if isinstance(a, float) else a == b
    if once == json.dumps(scene, sort_keys=True) or not near(scene, twice):
        wrong.append(f"{make.__name__}: exchanged twice it is another scene")

print("\n".join(wrong) or f"trial checks: {len(WRONG) + 2} wrong histories found, a sound one passes")
sys.exit(1 if wrong else 0)
