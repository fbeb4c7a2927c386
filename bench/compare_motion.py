#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A mooring line that moves in time: capstan beside MoorDyn.       usage: compare_motion.py [--bench MOTION_BENCH] [--only surge|hold]

The line is that of bench/oc3-sway.yaml, 100 elements, with drag (1.6 across), the water that goes along (1.0 across) and the internal damping
that MoorDyn makes of its -0.8. In surge, where it is met,
the bed gives by the stiffness 3e6 Pa/m and the damping 3e5 Pa s/m that are MoorDyn's own, over the diameter; in hold it is rigid.
- surge: its fairlead goes to and fro with a period of 12 s, without friction: 5 m over a bed far below, and 3 m and 5 m on the bed of its
  anchor; with 5 m the line goes slack there. The force in x as each program gives it, of the last three of eight periods, its mean subtracted, against MoorDyn at its finest step, by its
  amplitude. MoorDyn takes the fairlead's motion as uniform within a call, so the force is that of calls every 2 ms, the time that of 50 ms.
- hold: its fairlead goes 20 m across in 100 s and stays there, friction coefficient 1, for an hour. The force across and how far the node at
  an eighth of the length from the anchor has crept since the fairlead stopped, for MoorDyn with its default friction and tuned.
Both with seconds of processor time. MoorDyn (package index) is installed into build/bench-venv at the first run. Writes
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
COUPLING, FINE = 0.05, 0.002  # s, of calls of MoorDyn
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
    damping: 1.247e6
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
            file.write(SCENE.format(friction=friction, history=history, bed=bed, gives=gives))
        lines = subprocess.run([bench, scene, str(NODE)], check=True, capture_output=True, text=True).stdout.splitlines()
    rows = [[float(x) for x in line.split(",")] for line in lines[1:-1]]
    told = lines[-1].split()
    return [(t, (-fx, -fy, -fz), y) for t, fx, fy, fz, y in rows], {"processor_s": float(told[1]), "uncertified": int(told[3]), "iterations": int(told[5])}


def moordyn(step, friction, damping, place, duration, every=1, coupling=COUPLING, bed=-320):
    """The same rows from MoorDyn, each `every` calls, its fairlead at place(t) = (x, v)."""
    import moordyn as md

    deck = DECK.format(step=step, damping=damping).replace("1.0 FrictionCoefficient", f"{friction} FrictionCoefficient")
    deck = deck.replace("320 WtrDpth", f"{-bed} WtrDpth")
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "line.txt"), "w", encoding="ascii") as file:
            file.write(deck)
        here = os.getcwd()
        os.chdir(folder)
        system = md.Create("line.txt")
        x, v = place(0.0)
        md.Init(system, x, [0.0] * 3)
        line, rows, begun, time = md.GetLine(system, 1), [], seconds(), 0.0
        for i in range(round(duration / coupling)):
            x, v = place(time + coupling)
            force = md.Step(system, x, v, time, coupling)
            time = (i + 1) * coupling
            if (i + 1) % every == 0:
                rows.append((time, tuple(force), md.GetLineNodePos(line, NODE)[1]))
        spent = seconds() - begun
        md.Close(system)
        os.chdir(here)
    return rows, {"processor_s": spent}


def surge_of(far):
    w = 2 * math.pi / PERIOD
    return lambda t: ([AT[0] + far * math.sin(w * t), AT[1], AT[2]], [far * w * math.cos(w * t), 0.0, 0.0])


def aside(t):
    part = min(t / OUT, 1.0)
    return [AT[0], ACROSS * part, AT[2]], [0.0, ACROSS / OUT if t < OUT else 0.0, 0.0]


def late(rows):
    """Force in x at the times of the last periods that both have, less its mean over whole periods."""
    begin = (PERIODS - LAST) * PERIOD
    found = {round(t, 6): f[0] for t, f, _ in rows if t > begin + 1e-6}
    mean = sum(found.values()) / len(found)
    return {t: f - mean for t, f in found.items()}


def against(rows, truth):
    """Largest difference and that of the root mean square, over the amplitude."""
    a, b = late(rows), truth
    amplitude = (max(b.values()) - min(b.values())) / 2
    off = [a[t] - b[t] for t in a if t in b]
    return {"amplitude_N": (max(a.values()) - min(a.values())) / 2, "most_off": max(abs(x) for x in off) / amplitude,
            "rms_off": math.sqrt(sum(x * x for x in off) / len(off)) / amplitude}


def surge_over(bench, where, bed, far):
    surge = surge_of(far)
    duration, every = PERIODS * PERIOD, round(COUPLING / FINE)
    found, runs = {"MoorDyn": {}, "capstan": {}}, {}
    for step in ("0.00025", "0.0005", "0.001", "0.002"):
        with quiet():
            runs[step], _ = moordyn(step, 0.0, 200, surge, duration, every, FINE, bed)
            _, found["MoorDyn"][step] = moordyn(step, 0.0, 200, surge, duration, 1, COUPLING, bed)
    truth = late(runs["0.00025"])
    for step, rows in runs.items():
        found["MoorDyn"][step] |= against(rows, truth)
    for h in ("0.02", "0.05", "0.1", "0.2", "0.3"):
        history = f"  - {{name: surge, duration: {duration}, time_step: {h}, mooring.B: {{move: [0, 0, 0], sine: [{far}, 0, 0], period: {PERIOD}}}}}\n"
        rows, spent = capstan(bench, 0, history, bed)
        found["capstan"][h] = spent | against(rows, truth)
    for name, runs in found.items():
        for step, run in runs.items():
            run["per_second"] = run.pop("processor_s") / duration
            print(f"| {where} | {name} | {step} s | {100 * run['most_off']:.2f} % | {100 * run['rms_off']:.2f} % | "
                  f"{run['amplitude_N'] / 1e3:.1f} kN | {1e3 * run['per_second']:.1f} ms |"
                  + (f" {run['uncertified']} not certified" if "uncertified" in run else ""), flush=True)
    return found


def compare_surge(bench):
    cases = {"above": (-600, 5.0), "on the bed, 3 m": (-320, 3.0), "on the bed": (-320, 5.0)}
    return {where: surge_over(bench, where, *case) for where, case in cases.items()}


def compare_hold(bench):
    found = {}
    history = (f"  - {{name: out, duration: {OUT}, time_step: 0.5, mooring.B: {{move: [0, {ACROSS}, 0]}}}}\n"
               f"  - {{name: hold, duration: {HOUR - OUT}, time_step: 2}}\n")
    runs = {"capstan": lambda: capstan(bench, 1.0, history)}
    for damping in ("200", "1e6"):
        runs[f"MoorDyn, FricDamp {damping}"] = lambda damping=damping: moordyn("0.001", 1.0, damping, aside, HOUR, 20)
    for name, run in runs.items():
        with quiet():
            rows, spent = run()
        at = {round(t): (f[1], y) for t, f, y in rows if abs(t - round(t)) < 1e-6}
        stopped = at[round(OUT)]
        found[name] = spent | {"across_N": {str(t): at[t][0] for t in (100, 200, 700, 3600)}, "crept_m": {str(t): at[t][1] - stopped[1] for t in (200, 700, 3600)}}
        forces, crept = found[name]["across_N"], found[name]["crept_m"]
        print(f"| {name} | " + " | ".join(f"{f / 1e3:.2f}" for f in forces.values()) + " | " + " | ".join(f"{c:.4f}" for c in crept.values())
              + f" | {found[name]['processor_s']:.1f} s |", flush=True)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--bench", default=os.path.join(ROOT, "build", "release", "bench", "motion_bench"))
    parser.add_argument("--only", choices=["surge", "hold"])
    given = parser.parse_args()
    with_packages()
    path = os.path.join(ROOT, "bench", "results", "motion.json")
    found = {}
    if os.path.exists(path):
        with open(path, encoding="ascii") as file:
            found = json.load(file)
    from importlib.metadata import version
    found["moordyn"] = version("moordyn")
    for name, compare in (("surge", compare_surge), ("hold", compare_hold)):
        if given.only in (None, name):
            found[name] = compare(given.bench)
    with open(path, "w", encoding="ascii") as file:
        json.dump(found, file, indent=1)
        file.write("\n")


main()
