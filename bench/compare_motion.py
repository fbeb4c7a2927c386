#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A mooring line that moves in time: capstan beside MoorDyn.       usage: compare_motion.py [--bench FOLDER] [--only surge|laws|hold]

The line is that of bench/oc3-sway.yaml, 100 elements, with drag (1.6 across), the water that goes along (1.0 across) and the internal damping
that MoorDyn makes of its -0.8. In surge and laws, where it is met, the bed gives by the stiffness 3e6 Pa/m and the damping 3e5 Pa s/m that are
MoorDyn's own, over the diameter; in hold it is rigid.
- surge: its fairlead goes to and fro with a period of 12 s, without friction: 5 m over a bed far below, and 3 m on the bed of its anchor. The
  force in x of the last three of eight periods, its mean subtracted, against MoorDyn at 0.5 ms, by its amplitude. MoorDyn returns the force of the
  middle of its last step, without the inertia of the half element at the end, so it is compared with capstan's at that time and without that.
- laws: 5 m on the bed, where the line goes slack. An integration of its own (explicit_line.c), with the laws of MoorDyn and with those of
  capstan, beside both programs: which law makes which difference in the second period.
- hold: its fairlead goes 20 m across in 100 s and stays there, friction coefficient 1, for an hour. The force across and how far the node at
  an eighth of the length from the anchor has crept since the fairlead stopped, for MoorDyn with its default friction and tuned.
All with seconds of processor time. MoorDyn (package index) is installed into build/bench-venv at the first run. Writes
bench/results/motion.json and prints its tables. About ten minutes.
"""
import argparse
import json
import math
import os
import resource
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from compare_moordyn import DECK, ROOT, quiet, with_packages  # noqa: E402

AT, NODE = [848.67, 0.0, -70.0], 13  # the fairlead; the node at an eighth of 100 elements
PERIOD, PERIODS, LAST = 12.0, 8, 3  # s
ACROSS, OUT, HOUR = 20.0, 100.0, 3600.0  # m, s, s
COUPLING, FINE = 0.05, 0.0005  # s, of calls of MoorDyn; of its step and calls where it is the truth
DAMPING = 1.247e6  # N s, of the line
END_MASS = 0.5 * 77.7066 * 902.2 / 100  # kg, of half an element; the added mass acts across
SCENE = """capstan: 1
gravity: [0, 0, -9.80665]
water_density: 1025
obstacles:
  bed: {{plane: {{point: [0, 0, {bed}], normal: [0, 0, 1]}}, friction: {friction}{gives}}}
lines:
  mooring:
    length: 902.2
    elements: 100
    weight: 698.094
    inertia: 77.7066
    stiffness: 384.243e6
    damping: {damping}
    bearing_width: 0.09
    drag: {{diameter: 0.09, normal: 1.6, added_normal: 1.0}}
    start: static
    ends: {{A: {{held: [0, 0, -320]}}, B: {{held: [848.67, 0, -70]}}}}
history:
{history}"""


def seconds():
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def capstan(bench, friction, history, bed=-320):
    """Rows (time, force of the line on what holds B, y of the node) and what was spent."""
    with tempfile.TemporaryDirectory() as folder:
        scene = os.path.join(folder, "scene.yaml")
        with open(scene, "w", encoding="ascii") as file:
            gives = ", stiffness: 3e6, damping: 3e5" if bed == -320 and friction == 0 else ""  # Pa/m, Pa s/m
            file.write(SCENE.format(friction=friction, history=history, bed=bed, gives=gives, damping=DAMPING))
        lines = subprocess.run([bench, scene, str(NODE)], check=True, capture_output=True, text=True).stdout.splitlines()
    rows = [[float(x) for x in line.split(",")] for line in lines[1:-1]]
    told = lines[-1].split()
    return [(t, (-fx, -fy, -fz), y) for t, fx, fy, fz, y in rows], {"processor_s": float(told[1]), "uncertified": int(told[3]), "iterations": int(told[5])}


def moordyn(step, friction, damping, place, duration, every=1, coupling=COUPLING, bed=-320):
    """The same rows from MoorDyn, each `every` calls, its fairlead at place(t). It takes the place at the beginning of a call and a velocity
    that stays; the force that it returns is that of the middle of its last step."""
    import moordyn as md

    deck = DECK.format(step=step, damping=damping).replace("1.0 FrictionCoefficient", f"{friction} FrictionCoefficient")
    deck = deck.replace("320 WtrDpth", f"{-bed} WtrDpth")
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "line.txt"), "w", encoding="ascii") as file:
            file.write(deck)
        here = os.getcwd()
        os.chdir(folder)
        system = md.Create("line.txt")
        md.Init(system, place(0.0), [0.0] * 3)
        line, rows, begun, time = md.GetLine(system, 1), [], seconds(), 0.0
        for i in range(round(duration / coupling)):
            x, to = place(time), place(time + coupling)
            force = md.Step(system, x, [(b - a) / coupling for a, b in zip(x, to)], time, coupling)
            time = (i + 1) * coupling
            if (i + 1) % every == 0:
                rows.append((time - 0.5 * float(step), tuple(force), md.GetLineNodePos(line, NODE)[1]))
        spent = seconds() - begun
        md.Close(system)
        os.chdir(here)
    return rows, {"processor_s": spent}


def surge_of(far):
    w = 2 * math.pi / PERIOD
    return lambda t: [AT[0] + far * math.sin(w * t), AT[1], AT[2]]


def aside(t):
    part = min(t / OUT, 1.0)
    return [AT[0], ACROSS * part, AT[2]]


def between(truth, time):
    """The force of the truth (times, forces), which are even, at a time."""
    at = (time - truth[0][0]) / (truth[0][1] - truth[0][0])
    i = min(max(int(at), 0), len(truth[0]) - 2)
    return truth[1][i] + (at - i) * (truth[1][i + 1] - truth[1][i])


def against(rows, truth, begin, end):
    """Largest difference of forces in x and that of the root mean square, means over the time subtracted, over the amplitude."""
    pairs = [(f, between(truth, t)) for t, f in rows if begin + 1e-6 < t < end + 1e-6]
    means = [sum(pair[k] for pair in pairs) / len(pairs) for k in range(2)]
    other = [b for _, b in pairs]
    amplitude = (max(other) - min(other)) / 2
    off = [a - means[0] - b + means[1] for a, b in pairs]
    return {"most_off": max(abs(x) for x in off) / amplitude, "rms_off": math.sqrt(sum(x * x for x in off) / len(off)) / amplitude,
            "amplitude_N": amplitude}


def truth_of(rows):
    return [row[0] for row in rows], [row[1][0] for row in rows]


def in_x(rows):
    return [(t, f[0]) for t, f, _ in rows]


def capstan_surge(bench, h, bed, far, duration):
    """Times and forces in x of capstan, without the inertia of the half element at the end."""
    history = f"  - {{name: surge, duration: {duration}, time_step: {h}, mooring.B: {{move: [0, 0, 0], sine: [{far}, 0, 0], period: {PERIOD}}}}}\n"
    rows, spent = capstan(os.path.join(bench, "motion_bench"), 0, history, bed)
    w = 2 * math.pi / PERIOD
    return [(t, f - END_MASS * far * w * w * math.sin(w * t)) for t, f in in_x(rows)], spent


def surge_over(bench, where, bed, far):
    surge, duration = surge_of(far), PERIODS * PERIOD
    span = ((PERIODS - LAST) * PERIOD, duration - COUPLING)
    found = {"MoorDyn": {}, "capstan": {}}
    with quiet():
        truth = truth_of(moordyn(str(FINE), 0.0, 200, surge, duration, 1, FINE, bed)[0])
    for step, coupling in ((0.002, 0.002), (0.002, 0.02), (0.002, 0.05), (0.004, 0.02), (0.004, 0.048)):
        with quiet():
            rows, spent = moordyn(str(step), 0.0, 200, surge, duration, 1, coupling, bed)
        found["MoorDyn"][f"{step} s, called every {coupling} s"] = spent | against(in_x(rows), truth, *span)
    for h in ("0.02", "0.05", "0.1", "0.15", "0.2", "0.3"):
        rows, spent = capstan_surge(bench, h, bed, far, duration)
        found["capstan"][f"{h} s"] = spent | against(rows, truth, *span)
    for name, runs in found.items():
        for step, run in runs.items():
            run["per_second"] = run.pop("processor_s") / duration
            print(f"| {where} | {name} | {step} | {100 * run['most_off']:.3f} % | {100 * run['rms_off']:.3f} % | {1e3 * run['per_second']:.2f} ms |"
                  + (f" {run['uncertified']} not certified" if "uncertified" in run else ""), flush=True)
    return found


def compare_surge(bench):
    cases = {"above": (-600, 5.0), "on the bed, 3 m": (-320, 3.0)}
    return {where: surge_over(bench, where, *case) for where, case in cases.items()}


def explicit(bench, nodes, step, pushes, sucks, nodal):
    out = subprocess.run([os.path.join(bench, "explicit_line"), str(step), str(DAMPING), pushes, sucks, nodal, "-320", "5", nodes], check=True,
                         capture_output=True, text=True).stdout
    return [tuple(float(x) for x in line.split(",")) for line in out.split()]


def nodes_at_rest(path):
    """The nodes of MoorDyn's line at rest, as rows of a file."""
    import moordyn as md

    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "line.txt"), "w", encoding="ascii") as file:
            file.write(DECK.format(step=0.001, damping=200).replace("1.0 FrictionCoefficient", "0.0 FrictionCoefficient"))
        here = os.getcwd()
        os.chdir(folder)
        system = md.Create("line.txt")
        md.Init(system, AT, [0.0] * 3)
        rows = [md.GetLineNodePos(md.GetLine(system, 1), j) for j in range(101)]
        md.Close(system)
        os.chdir(here)
    with open(path, "w", encoding="ascii") as file:
        file.writelines(" ".join(repr(float(x)) for x in row) + "\n" for row in rows)


def compare_laws(bench):
    """Differences in the second period of a surge of 5 m on the bed."""
    span, far = (PERIOD, 2 * PERIOD - 0.01), 5.0
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        nodes = os.path.join(folder, "nodes.txt")
        with quiet():
            nodes_at_rest(nodes)
            moor = in_x(moordyn(str(FINE), 0.0, 200, surge_of(far), 2 * PERIOD, 1, FINE, -320)[0])
        own = {name: explicit(bench, nodes, 0.00025, *laws) for name, laws in
               {"laws of MoorDyn": "111", "element does not push": "011", "bed does not pull": "101", "laws of capstan": "000"}.items()}
        coarse = explicit(bench, nodes, 0.0005, *"000")
    truth = {name: tuple(zip(*rows)) for name, rows in own.items()}

    def tell(name, rows, beside):
        found[name] = against(rows, beside, *span)
        print(f"| {name} | {100 * found[name]['most_off']:.3f} % | {100 * found[name]['rms_off']:.3f} % |", flush=True)

    tell("MoorDyn beside own with its laws", moor, truth["laws of MoorDyn"])
    tell("own with capstan's laws, 0.5 ms beside 0.25 ms", coarse, truth["laws of capstan"])
    for name in ("element does not push", "bed does not pull", "laws of capstan"):
        tell(f"own, {name}, beside own with the laws of MoorDyn", own[name], truth["laws of MoorDyn"])
    moor_truth = tuple(zip(*moor))
    for h in ("0.02", "0.01", "0.005"):
        rows, _ = capstan_surge(bench, h, -320, far, 2 * PERIOD)
        tell(f"capstan {h} s beside own with its laws", rows, truth["laws of capstan"])
        tell(f"capstan {h} s beside MoorDyn", rows, moor_truth)
    return found


def compare_hold(bench):
    found = {}
    history = (f"  - {{name: out, duration: {OUT}, time_step: 0.5, mooring.B: {{move: [0, {ACROSS}, 0]}}}}\n"
               f"  - {{name: hold, duration: {OUT}, time_step: 2}}\n  - {{name: rest, duration: {HOUR - 2 * OUT}, time_step: 10}}\n")
    runs = {"capstan": lambda: capstan(os.path.join(bench, "motion_bench"), 1.0, history)}
    for damping in ("200", "1e6"):
        for step in ("0.001", "0.004"):
            runs[f"MoorDyn, FricDamp {damping}, {step} s"] = lambda damping=damping, step=step: moordyn(step, 1.0, damping, aside, HOUR, 20)
    for name, run in runs.items():
        try:
            with quiet():
                rows, spent = run()
        except RuntimeError:
            print(f"| {name} | fails |", flush=True)
            continue
        at = {round(t): (f[1], y) for t, f, y in rows if abs(t - round(t)) < 3e-3}
        stopped = at[round(OUT)]
        found[name] = spent | {"across_N": {str(t): at[t][0] for t in (100, 200, 700, 3600)}, "crept_m": {str(t): at[t][1] - stopped[1] for t in (200, 700, 3600)}}
        forces, crept = found[name]["across_N"], found[name]["crept_m"]
        print(f"| {name} | " + " | ".join(f"{f / 1e3:.2f}" for f in forces.values()) + " | " + " | ".join(f"{c:.4f}" for c in crept.values())
              + f" | {found[name]['processor_s']:.1f} s |", flush=True)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--bench", default=os.path.join(ROOT, "build", "release", "bench"))
    parser.add_argument("--only", choices=["surge", "laws", "hold"])
    given = parser.parse_args()
    with_packages()
    path = os.path.join(ROOT, "bench", "results", "motion.json")
    found = {}
    if os.path.exists(path):
        with open(path, encoding="ascii") as file:
            found = json.load(file)
    from importlib.metadata import version
    found["moordyn"] = version("moordyn")
    for name, compare in (("surge", compare_surge), ("laws", compare_laws), ("hold", compare_hold)):
        if given.only in (None, name):
            found[name] = compare(given.bench)
    with open(path, "w", encoding="ascii") as file:
        json.dump(found, file, indent=1)
        file.write("\n")


main()
