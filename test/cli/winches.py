#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run with winches: what is off the drums and what the ledger says, the checker finds nothing, copies with a number changed are
refused, a run that is stopped and resumed has the same numbers, random histories, and mistakes are told with their place.

usage: winches.py CAPSTAN CHECKER [FIRST LAST]      with numbers: these seeds of random histories only
"""
import csv
import json
import math
import os
import random
import re
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is left in the source folder
import runs  # noqa: E402
from result_file import Results  # noqa: E402
from runs import command, falsify, resumed, write  # noqa: E402

CAPSTAN, CHECKER = (os.path.abspath(path) for path in sys.argv[1:3])
SEEDS = 24  # of random histories in every run

# a rope over a post, with a winch at B; hauled in, paid out, and moved while it pays out
POST = """
capstan: 1
obstacles:
  post: {cylinder: {point: [0, 0, 0], axis: [0, 1, 0], radius: 0.5}, friction: 0.3}
lines:
  rope:
    length: 12
    elements: 60
    mass: 1
    stiffness: STIFFNESS
    start: {polyline: [[-5, 0, 0.5], [5, 0, 0.5]]}
    ends: {A: {force: [-100, 0, 0]}, B: {held: [5, 0, 0.5], stored: 2}}
history:
  - {name: down, rope.A: {force: [0, 0, -100]}, steps: 6, rope.B: {position: [3, 0, -3]}}
  - {name: haul, rope.pay_out_B: -3, steps: 4}
  - {name: pay, rope.pay_out_B: 4.5, rope.B: {move: [0.1, 0.2, 0]}, steps: 6}
"""
# (variable, step, index, change): what is off the drum, what it says of it, and what is on it; the reference in a step of one part, where it is
# the place after the step before
FALSIFIED = (("rope_stored", 7, 1, 1e-6), ("rope_stored", 0, 1, 1e-3), ("rope_winch_pull", 8, 1, 1e-3), ("rope_winch_pull", 13, 1, 0.1),
             ("rope_ledger_winches", 8, 0, 1e-3), ("rope_ledger_winches", 2, 0, 1e-3), ("rope_ledger_gravity", 9, 0, 1e-2),
             ("rope_ledger_ends", 13, 0, 1e-2), ("rope_length_off_drums", 7, 20, 1e-6), ("rope_length_off_drums", 8, 59, 0.05),
             ("rope_node_weight_length", 9, 10, 1e-5), ("rope_node_weight_length", 9, 59, 0.1), ("rope_position", 8, 3*59, 1e-6),
             ("rope_tension", 8, 58, 1.0), ("rope_reference", 14, 3*55, 1e-6))
GOOD = "rope.pay_out_B: -3"
HELD = "B: {held: [5, 0, 0.5], stored: 2}"
BAD = (  # (what is replaced, by what, what is said)
    (GOOD, "rope.pay_out_B: far", "15:18: 'rope.pay_out_B': found 'far', expected a number in m"),
    (GOOD, "rope.pay_out_B: .inf", "15:18: 'rope.pay_out_B': found '.inf', expected a number in m, finite"),
    (GOOD, "rope.pay_out_B: [1]", "15:18: 'rope.pay_out_B': found a list of 1, expected a number in m"),
    (GOOD, "rope.pay_out_A: -3", "15:18: stage 2: rope.A pays out, but has no winch: give this end of the line 'stored', the length on the drum, which may be 0"),
    (GOOD, "rope.pay_out: -3", "15:18: entry: unknown key 'rope.pay_out'"),
    (GOOD, "rop.pay_out_B: -3", "15:18: 'rop.pay_out_B': there is no such line; did you mean 'rope.pay_out_B'?"),
    (GOOD, GOOD + ", " + GOOD, "15:38: key 'rope.pay_out_B' is given twice"),
    (GOOD, "rope.pay_out_B: 2.001", "15:18: stage 2: rope.B pays out 2.001 m, but only 2 m are on its drum"),
    (GOOD, "rope.pay_out_B: -9.99", "15:18: stage 2: rope.B hauls in 9.99 m, but of 10 m that are off the drum at least 0.02 m stay there, a tenth of an element"),
    (GOOD, "rope.pay_out_B: 1e30", "15:18: stage 2: rope.B pays out 1e+30 m, but only 2 m"),
    ("rope.pay_out_B: 4.5", "rope.pay_out_B: 6", "16:17: stage 3: rope.B pays out 6 m, but only 5 m are on its drum"),
    (GOOD, "rope.B: {force: [0, 0, 1]}", "15:18: stage 2: rope.B is loaded, but a winch holds it: a winch can be moved, not let go"),
    (GOOD, "rope.B: {release: true}", "15:18: stage 2: rope.B is released, but a winch holds it"),
    (GOOD, "rope.node: {at: 3, hold: true}", "15:18: stage 2: a node of line 'rope' is grasped, which has a winch: a node may come to the drum"),
    (HELD, "B: {held: [5, 0, 0.5], stored: -1}", "12:61: 'stored': found '-1', expected a number in m, at least 0"),
    (HELD, "B: {held: [5, 0, 0.5], stored: .nan}", "12:61: 'stored': found '.nan'"),
    (HELD, "B: {held: [5, 0, 0.5], stored: all}", "12:61: 'stored': found 'all', expected a number in m"),
    (HELD, "B: {held: [5, 0, 0.5], store: 2}", "12:61: 'B': unknown key 'store'; did you mean 'stored'?"),
    (HELD, "B: {stored: 2}", "12:38: 'B': nothing given, expected exactly one of 'held', 'force', 'point'"),
    (HELD, "B: {held: [5, 0, 0.5], stored: 11.99}", "12:61: line 'rope': ends: 11.99 m of the line's 12 m are stored, expected at most 11.98 m"),
    (HELD, "B: {held: [5, 0, 0.5], stored: 1.5}", "11:5: line 'rope': start is 10 m long, shorter than the line's length 10.5 m"),
    (HELD, "B: {force: [5, 0, 0.5], stored: 2}", "12:62: line 'rope': ends: a winch is at end B, which is free: a winch holds its end, or is at a point"),
    ("mass: 1", "mass: 1\n    break_at: 1e5", "13:61: line 'rope': ends: a line with a winch has no break_at: give it a breaking_load"),
)


def solve(folder, text, wanted=(0,)):
    return runs.solve(CAPSTAN, CHECKER, folder, text, wanted)


def post(folder, stiffness):
    scene, out, results = solve(folder, POST.replace("STIFFNESS", stiffness))
    assert results.steps == 16
    for step, stored in ((5, 2), (7, 3.5), (9, 5), (15, 0.5)):
        assert abs(results.get("rope_stored", step)[1] - stored) < 1e-12 and math.isnan(results.get("rope_stored", step)[0])
        off = results.get("rope_length_off_drums", step)
        assert abs(sum(off) - (12 - stored)) < 1e-9, (step, sum(off))
        # whole elements of 0.2 m, then what is left of one, then none
        assert all(abs(length - min(0.2, max(0, 12 - stored - 0.2*e))) < 1e-9 for e, length in enumerate(off)), (step, off)
    with open(os.path.join(out, "history.csv"), newline="") as file:
        rows = list(csv.reader(file))
    names, last = rows[0], rows[-1]
    assert rows[1][names.index("rope.B.stored")] == "m" and rows[1][names.index("winches")] == "J"
    assert abs(float(last[names.index("rope.B.stored")]) - 0.5) < 1e-12 and last[names.index("rope.A.stored")] == ""
    assert abs(float(last[names.index("rope.B.paid")]) - 11.5) < 1e-9
    for row in rows[2:]:
        of = {name: float(row[names.index(name)]) for name in ("ends", "obstacles", "winches", "elastic", "gravity", "dissipated", "imbalance")}
        left = of["ends"] + of["obstacles"] + of["winches"] - of["elastic"] - of["gravity"] - of["dissipated"] - of["imbalance"]
        assert abs(left) <= 1e-9*sum(abs(value) for value in of.values()), of
    with open(os.path.join(out, "summary.json")) as file:
        step = json.load(file)["steps"][-1]
    assert abs(step["lines"]["rope"]["B"]["paid_m"] - 11.5) < 1e-9 and "winches" in step["ledger_J"], step
    for variable, step, index, change in FALSIFIED:
        falsify(results, out, variable, step, index, change)
        code, said = command(CHECKER, os.path.join(out, "copy.nc"), scene)
        assert code != 0, (variable, step, said)
    # a scene in which it pays out otherwise is another one
    other = write(folder, "other.yaml", POST.replace("STIFFNESS", stiffness).replace(GOOD, "rope.pay_out_B: -3.001"))
    code, said = command(CHECKER, os.path.join(out, "result.nc"), other)
    assert code != 0 and "stored of rope, end B" in said, said
    return len(FALSIFIED)


def random_scene(rng):
    """One line with a winch at either end or both, on nothing, a bed, a slope or over a post; inextensible or not, near or far from the
    origin, with a clump or a buoy; it pays out and hauls in by any sign and size, to an empty drum and to the least that the ends need,
    while an end moves or gravity changes."""
    elements, length = rng.choice([6, 17, 40]), rng.choice([2.0, 30.0, 400.0])
    winches, far = rng.choice(["B", "A", "AB"]), rng.choice([0, 1e5])
    stored = {end: length*rng.uniform(0, 0.35)*(end in winches)*(rng.random() < 0.8) for end in "AB"}
    paid = length - stored["A"] - stored["B"]
    stiffness = rng.choice([".inf", "%g" % (10**rng.uniform(2, 6)*length)])
    kind = rng.choice(["hang", "bed", "post", "slope"])
    span, rise = paid*rng.uniform(0.3, 0.7), max(paid*rng.uniform(-0.4, 0.4), -0.1*paid)
    obstacle = {"hang": "", "bed": f"bed: {{plane: {{point: [{far}, 0, {-rng.uniform(0.3, 0.6)*paid}]}}, friction: {rng.uniform(0, 1):.3f}}}",
                "slope": f"bed: {{plane: {{point: [{far}, 0, {-0.5*paid}], normal: [0.2, 0.1, 1]}}, friction: {{axial: 0.3, lateral: 0.7}}}}",
                "post": f"post: {{cylinder: {{point: [{far + span/2}, 0, {-0.25*paid}], radius: {0.15*paid}}}, friction: 0.3}}"}[kind]
    is_free = rng.random() < 0.3 and winches != "AB"
    place, ends = {"A": [far, 0, 0], "B": [far + span, 0, rise]}, []
    for end in "AB":
        if end in winches:
            ends.append(f"{end}: {{held: {place[end]}, stored: {stored[end]!r}}}")
        elif is_free:
            pull = [(-1 if end == "A" else 1)*10*paid*rng.uniform(0.2, 1), rng.uniform(0, 0.3)*10*paid]
            ends.append(f"{end}: {{force: [{pull[0]:.4f}, 0, {pull[1]:.4f}]}}")
        else:
            ends.append(f"{end}: {{held: {place[end]}}}")
    hung = f"\n    point_weights: [{{at: {length/elements*(elements//2)!r}, weight: {rng.choice([-30, 60])}}}]" if rng.random() < 0.3 else ""
    history, on = [], dict(stored)
    for _ in range(rng.randint(2, 5)):
        entry = [f"steps: {rng.randint(1, 4)}"]
        for end in winches:
            off = length - on["A"] - on["B"]
            most, least = on[end], -(0.7*off if is_free else off - 1.02*math.hypot(span, rise))
            if rng.random() < 0.2 or least > most:
                continue
            pays = rng.choice([most, rng.uniform(min(least, 0), max(most, 0)), rng.uniform(-0.1, 0.1)*paid])
            pays = max(min(pays, most), least)*(0.999 if rng.random() < 0.5 else 1)
            entry.append(f"rope.pay_out_{end}: {pays!r}")
            on[end] -= pays
        if rng.random() < 0.3:
            entry.append("rope.%s: {move: [%.3f, %.3f, %.3f]}" % (winches[0], *[rng.uniform(-0.03, 0.03)*paid for _ in range(3)]))
        if rng.random() < 0.15:
            entry.append("gravity: [%.2f, 0, -9]" % rng.uniform(-1, 1))
        history.append("  - {" + ", ".join(entry) + "}")
    return (f"capstan: 1\nobstacles: {{{obstacle}}}\nlines:\n  rope:\n    length: {length!r}\n    elements: {elements}\n    weight: 10{hung}\n"
            f"    stiffness: {stiffness}\n    start: static\n    ends: {{{', '.join(ends)}}}\nhistory:\n" + "\n".join(history) + "\n")


def softened(rng, text):
    """Such a scene on an obstacle that gives: a line that lies sinks by a share of 1e-4 to 0.03 of its length."""
    length = float(re.search(r"length: (\S+)", text).group(1))
    stiffness = 10/(0.1*length*10**rng.uniform(-4, -1.5))
    text = re.sub(r"(friction: (?:[\d.]+|{[^}]*}))", rf"\1, stiffness: {stiffness!r}", text, count=1)
    return text.replace("    weight: 10", "    bearing_width: 0.1\n    weight: 10")


def histories(folder, first, last):
    """All of them are solved, and the checker, which has read what is off the drums by itself, finds nothing; so on obstacles that give."""
    for seed in range(first, last):
        rng = random.Random(seed)
        text = random_scene(rng)
        try:
            solve(folder, text)
            if "friction" in text:
                solve(folder, softened(rng, text))
        except AssertionError as error:
            raise AssertionError(f"seed {seed}: {error}")
    return last - first


# a body on two inextensible lines, which winches haul as short as the way between their anchors, where no force holds it, and pay out again
STRAIGHT = """capstan: 1
gravity: [0, 0, -10]
bodies: {hull: {free: [5, 0, -3], mass: 10}}
points: {left: {body: hull, at: [-0.5, 0, 0.3]}, right: {body: hull, at: [0.5, 0, 0.3]}}
lines:
  a: {length: 8, elements: 8, weight: 5, stiffness: .inf, start: static, ends: {A: {held: [0, 0, 0], stored: 1.5}, B: {point: left}}}
  b: {length: 8, elements: 8, weight: 5, stiffness: .inf, start: static, ends: {A: {held: [10, 0, 0], stored: 1.5}, B: {point: right}}}
history:
  - {name: haul, steps: 2, a.pay_out_A: -2, b.pay_out_A: -2}
  - {name: pay, steps: 2, a.pay_out_A: 3, b.pay_out_A: 3}
"""
# the same hauled shorter: there is a proof that no pose is left, with which the run ends
TOO_SHORT = STRAIGHT.replace("steps: 2, a.pay_out_A: -2, b.pay_out_A: -2", "steps: 3, a.pay_out_A: -3, b.pay_out_A: -3")


def stalls(folder):
    """Where no pose is found the winches wind all the same, the lines and the body are where they were, and the checker refutes nothing; the
    history goes on, and its last steps are certified. Where there is none the run ends with its proof."""
    scene, out = write(folder, "straight.yaml", STRAIGHT), os.path.join(folder, "straight")
    code, said = command(CAPSTAN, "run", scene, "-q", "-o", out)
    assert code == 1 and "no pose found" in said, (code, said)
    results = Results(os.path.join(out, "result.nc"))
    stored = [results.get("a_stored", step)[0] for step in range(results.steps)]
    assert all(abs(a - b) < 1e-12 for a, b in zip(stored, [1.5, 2.5, 3.5, 2, 0.5])), stored
    places = [list(results.get("has_place_of_body", step)) == [1] for step in range(results.steps)]
    assert places == [True, True, False, True, True], places
    _, found = command(CHECKER, os.path.join(out, "result.nc"), scene, "-v")
    assert "records 10, certified 8, not certified 2, refuted 0, not finite 0" in found and "against the scene: 0 findings" in found, found
    scene, out = write(folder, "short.yaml", TOO_SHORT), os.path.join(folder, "short")
    code, said = command(CAPSTAN, "run", scene, "-q", "-o", out)
    assert code == 5 and "too short (by 2 m" in said, (code, said)
    _, found = command(CHECKER, os.path.join(out, "result.nc"), scene, "-v")
    assert "refuted 0, not finite 0" in found and "against the scene: 0 findings" in found, found


def mistakes(folder):
    text = POST.replace("STIFFNESS", "20000").replace(", rope.B: {move: [0.1, 0.2, 0]}", "")
    for good, wrong, words in BAD:
        assert good in text, good
        scene = write(folder, "bad.yaml", text.replace(good, wrong))
        code, said = command(CAPSTAN, "check", scene)
        assert code == 3 and said.startswith(f"capstan: {scene}:{words}"), (wrong, said)
    # the method of 1990 knows no drums
    scene = write(folder, "scene.yaml", text)
    code, said = command(CAPSTAN, "run", scene, "--method", "regularized", "-o", os.path.join(folder, "no"))
    assert code != 0 and not os.path.exists(os.path.join(folder, "no", "summary.json")), said
    return len(BAD)


def main():
    numbers = [int(word) for word in sys.argv[3:5]]
    with tempfile.TemporaryDirectory() as folder:
        if numbers:
            print(f"{histories(folder, *numbers)} random histories")
            return 0
        copies = sum(post(folder, stiffness) for stiffness in ("20000", ".inf"))
        resumed(CAPSTAN, folder, POST.replace("STIFFNESS", "20000").replace("-3, steps: 4", "-3, steps: 150"),
            400000, 162, (10, 60, 100, 161),
            ("rope_position", "rope_tension", "rope_length_off_drums", "rope_node_weight_length", "rope_ledger_winches"))
        stalls(folder)
        ran = histories(folder, 0, SEEDS)
        wrong = mistakes(folder)
    print(f"{ran} random histories; {copies} falsified copies and {wrong} mistakes refused")
    return 0


if __name__ == "__main__":
    sys.exit(main())
