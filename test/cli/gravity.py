# SPDX-License-Identifier: BSD-3-Clause
"""Gravity that changes in the history: closed forms, the ledger, the checker, an interrupted run, what is refused.

usage: gravity.py CAPSTAN CHECKER ROOT"""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import time

CAPSTAN, CHECKER, ROOT = sys.argv[1:]
sys.path.insert(0, os.path.join(ROOT, "test", "property"))
sys.dont_write_bytecode = True
from checks import expect, faults, read, write  # noqa: E402
from result_file import Results  # noqa: E402


def capstan(*arguments):
    return subprocess.run([CAPSTAN, *arguments], capture_output=True, text=True, timeout=120)


def run(name, scene):
    write(name + ".yaml", json.dumps(scene))
    done = capstan("run", name + ".yaml", "-o", name, "--no-paraview")
    expect(f"{name}: certified", done.returncode == 0, done.stdout + done.stderr)
    if done.returncode > 1:
        sys.exit("\n".join(faults))
    seen = subprocess.run([CHECKER, os.path.join(name, "result.nc"), name + ".yaml"], capture_output=True, text=True, timeout=60)
    expect(f"{name}: accepted by the checker", seen.returncode == 0, seen.stdout + seen.stderr)
    return json.loads(read(os.path.join(name, "summary.json")))["steps"], done.stderr


def line(start, ends, **more):
    return {"length": 2, "elements": 20, "weight": 5, "stiffness": 40, "start": start, "ends": ends, **more}


def hanging():
    """Hung from A the tip is l + w l^2/(2 K) of the lumped line below, along gravity; the potential and the elongation change as they should."""
    scene = {"capstan": 1, "gravity": [0, 0, -10], "lines": {"rope": line({"straight": {"from": [0, 0, 0], "to": [0, 0, -2]}}, {"A": "held", "B": "free"})},
             "history": [{"name": "hang"}, {"name": "heavy", "steps": 3, "gravity": [0, 0, -30]}, {"name": "aside", "gravity": [0, -8, -6]}, {"name": "none", "gravity": [0, 0, -1e-3]}]}
    steps, said = run("hanging", scene)
    pulls = [(0, -10), (0, -50 / 3), (0, -70 / 3), (0, -30), (-8, -6), (0, -1e-3)]
    for step, (y, z) in zip(steps, pulls):
        g = math.hypot(y, z)
        tip = 2 + 5 * g / 10 * 4 / (2 * 40)
        found = step["lines"]["rope"]["B"]["position_m"]
        # at a thousandth of the weight the line is held in place by that alone: places to 1e-6 of the length
        expect(f"hanging, {step['name']}: tip", math.dist(found, (0, y / g * tip, z / g * tip)) < 4e-6, found)
    for k, step in enumerate(steps[:4]):
        energy = step["ledger_J"]
        was, now = (5 * abs(p[1]) / 10 for p in (pulls[max(0, k - 1)], pulls[k]))
        # the displacement (l a - a^2/2) (w - w_before)/K times the mean weight, but for the square of an element over the length
        if k > 0:
            expect(f"hanging, {step['name']}: the ledger closes", abs(energy["imbalance"]) < 1e-9 * now * 2, energy)
            expect(f"hanging, {step['name']}: work of the mean weight",
                   abs(energy["gravity"] + (was + now) / 2 * (now - was) * 8 / (3 * 40)) < 0.002 * abs(energy["gravity"]), energy)
    expect("hanging: no energy is missed while it grows heavy", not any("heavy" in l for l in said.splitlines() if "warning" in l), said)


def tilted():
    """A table that tilts: gravity turns by t, the line slides where tan t is above mu, held at A: T(a) = w (sin t - mu cos t)(l - a)."""
    mu, t = 0.3, 0.5
    scene = {"capstan": 1, "gravity": [0, 0, -10], "obstacles": {"table": {"plane": {}, "friction": mu}},
             "lines": {"rope": line({"straight": {"from": [0, 0, 0], "to": [2, 0, 0]}}, {"A": "held", "B": "free"})},
             "history": [{"name": "rest", "gravity": [10 * math.sin(0.2), 0, -10 * math.cos(0.2)]}, {"name": "slide", "steps": 4, "gravity": [10 * math.sin(t), 0, -10 * math.cos(t)]}]}
    steps, _ = run("tilted", scene)
    # below tan t = mu nothing moves: 1e-9 of the length
    expect("tilted: rests below the angle of friction", abs(steps[0]["lines"]["rope"]["B"]["position_m"][0] - 2) < 2e-9, steps[0]["lines"]["rope"]["B"])
    slope = 5 * (math.sin(t) - mu * math.cos(t))
    tip = 2 + slope * 4 / (2 * 40)
    found = steps[-1]["lines"]["rope"]["B"]["position_m"][0]
    expect("tilted: the tip", abs(found - tip) < 1e-6, (found, tip))


def history(name):
    with open(os.path.join(name, "history.csv"), newline="", encoding="utf-8") as file:
        return [{key: value for key, value in row.items() if key != "wall"} for row in csv.DictReader(file)]


def resumed():
    """Killed and gone on with: the same numbers, bit for bit."""
    scene = {"capstan": 1, "obstacles": {"table": {"plane": {}, "friction": 0.3}},
             "lines": {"rope": line({"straight": {"from": [0, 0, 0], "to": [2, 0, 0]}}, {"A": "held", "B": {"force": [1, 1, 0]}}, elements=400)},
             "history": [{"name": "pull", "rope.B": {"force": [2, 2, 0]}}, {"name": "light", "steps": 60, "gravity": [0, 1, -2]}, {"name": "on", "rope.B": {"force": [0, 2, 1]}}]}
    run("whole", scene)
    write("part.yaml", json.dumps(scene))
    process = subprocess.Popen([CAPSTAN, "run", "part.yaml", "-q", "-o", "part", "--no-paraview"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    journal = os.path.join("part", ".journal")
    while process.poll() is None and not (os.path.exists(journal) and os.path.getsize(journal) > 600000):
        time.sleep(0.0005)
    expect("resumed: killed under way", process.poll() is None)
    process.kill()
    process.wait()
    done = capstan("run", "part.yaml", "-q", "-o", "part", "--no-paraview", "--resume")
    expect("resumed", done.returncode == 0 and "steps were done before" in done.stderr, done.stderr)
    expect("resumed: the same history", history("part") == history("whole"))
    for step in range(62):
        here, there = (list(Results(os.path.join(n, "result.nc")).get("rope_weight_before", step)) for n in ("part", "whole"))
        expect(f"resumed: the same weight before step {step}", here == there, (here, there))


def refused():
    text = "capstan: 1\nlines:\n  rope: {length: 1, weight: 1, stiffness: 10, start: {straight: {from: [0, 0, 0], to: [1, 0, 0]}}, ends: {A: held, B: free}}\nhistory:\n  - {gravity: %s}\n"
    for value, words in (("-9.81", "5:6: 'gravity': found '-9.81', expected three numbers in m/s2"), ("[0, 0]", "5:6: 'gravity': found a list of 2"),
                         ("[0, 0, .inf]", "'gravity': found '.inf'"), ("[0, 0, 1e200]", "'gravity': found '1e200'")):
        write("bad.yaml", text % value)
        done = capstan("check", "bad.yaml")
        expect(f"gravity: {value}", done.returncode == 3 and words in done.stderr, done.stderr)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    hanging()
    tilted()
    resumed()
    refused()

print("\n".join(faults) or "gravity: weights that change in the history, as documented")
sys.exit(1 if faults else 0)
