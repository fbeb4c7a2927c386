#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tables of a history in time: the energy balance of each step in summary.json and its sum, which `capstan run` prints with what it leaves
over; the forces on points and bodies, inertia and damping with them, which add up to the residuals; and what a resumed run says of the time
that remains.                                                                                                 usage: time_tables.py CAPSTAN"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile

# A body on a line with inertia and one without, a clump between two lines, a drag; and quasi-static entries before, between and after.
SCENE = """capstan: 1
water_density: 1025
obstacles: {bed: {plane: {point: [0, 0, -20]}, friction: 0.5}}
bodies:
  buoy: {free: [0, 0, 0], mass: 2000, buoyancy: 25000, centre_of_gravity: [0.1, 0, -1], moments_of_inertia: [600, 650, 400],
         hydrostatics: {z: 15000, rx: 9000, ry: 9000}, added_mass: {x: 900, z: 700}, damping: {x: 100, z: 300}}
points:
  eye: {body: buoy, at: [0.5, 0, -1]}
  heel: {body: buoy, at: [-0.5, 0.1, -1]}
  clump: {free: [9, 0, -12], mass: 60}
lines:
  upper: {length: 14, elements: 7, mass: 8, diameter: 0.03, stiffness: 2e6, start: static, drag: {diameter: 0.05, normal: 1.2}, ends: {A: {point: clump}, B: {point: eye}}}
  lower: {length: 14, elements: 7, mass: 8, stiffness: 2e6, start: static, ends: {A: {held: [18, 0, -20]}, B: {point: clump}}}
  stern: {length: 28, elements: 7, weight: 80, stiffness: 2e6, start: static, quasi_static: true, ends: {A: {held: [-17, 0, -20]}, B: {point: heel}}}
history:
  - {name: aside, buoy.body: {force: [1500, 0, 0]}, steps: 2}
  - {name: go, duration: 2, time_step: 0.1, buoy.body: {force: [0, 0, 0]}}
  - {name: rest, buoy.body: {force: [200, 0, 0]}, steps: 2}
  - {name: on, duration: 1, time_step: 0.2, error: 0.01, clump.point: {force: [0, 30, 0]}}
"""
# What is led has its inertia in what holds it.
LED = """capstan: 1
lines:
  rope: {length: 2, elements: 10, mass: 1, stiffness: 1e4, start: static, ends: {A: {held: [0, 0, 0]}, B: {held: [1, 0, 0]}}}
history: [{name: swing, duration: 40, time_step: 0.01, rope.B: {move: [0, 0, 0], sine: [0.3, 0, 0.2], period: 2}}]
"""
TOP = """capstan: 1
bodies: {top: {free: [0, 0, 0], mass: 5, buoyancy: 49.05, moments_of_inertia: [2, 3, 4], turn_rate: [0, 0, 10]}}
points: {eye: {body: top}}
lines: {rope: {length: 50, elements: 1, weight: 0, stiffness: 1, quasi_static: true, start: {straight: {from: [50, 0, 0], to: [0, 0, 0]}}, ends: {A: free, B: {point: eye}}}}
history: [{duration: 2, time_step: STEP}]
"""
# A slack line high above a bed falls on it in one step.
TAUT = """capstan: 1
obstacles: {bed: {plane: {}, friction: 0.1}}
lines:
  a: {length: 10, elements: 20, weight: 5, stiffness: 1e6, quasi_static: true, start: {straight: {from: [0, 0, 8], to: [10, 0, 8]}}, ends: {A: held, B: free}}
history: [{name: fall, ENTRYsteps: 1}]
"""
IN, OUT = ("ends", "obstacles", "loads", "winches", "waves"), ("elastic", "gravity", "dissipated", "kinetic", "impact", "scheme", "settling",
                                                               "damping", "drag", "added", "imbalance")
# Of the sizes of what is added up.
ROUNDING = 1e-12


def run(capstan, scene, out, *more):
    done = subprocess.run([capstan, "run", scene, "-o", out, "--no-paraview", *more], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done


def balance(ledger, what):
    terms = [ledger.get(key, 0) for key in IN] + [-ledger[key] for key in OUT]
    assert abs(sum(terms)) <= ROUNDING*sum(map(abs, terms)), f"{what}: {ledger}"
    return sum(map(abs, terms)) - abs(ledger["imbalance"])


def rows(out, name):
    with open(os.path.join(out, name), encoding="ascii") as file:
        return list(csv.DictReader(file))[1:]


def energies(out, said):
    """Balances of the steps, their sum, and what is printed of it."""
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    table = rows(out, "history.csv")
    for step, row in zip(summary["steps"], table):
        ledger = step["ledger_J"]
        balance(ledger, step["name"])
        for key in OUT:
            assert ledger[key] == float(row["kinetic_growth" if key == "kinetic" else key]), (step["name"], key)
        for key, column in (("time_s", "time"), ("time_step_s", "time_step"), ("step_error_m", "step_error"), ("kinetic_J", "kinetic"),
                            ("steps_rejected", "steps_rejected")):
            assert step[key] == float(row[column]), (step["name"], key)
        # what the imbalance is compared with has all of it, of lines without inertia and steps without duration too
        assert ledger["turnover"] >= abs(ledger["imbalance"]) and (ledger["turnover"] > 0) == (step["name"] != "static"), step["name"]
    whole = summary["ledger_J"]
    balance(whole, "in all")
    for key in OUT + ("turnover",):
        total = sum(step["ledger_J"][key] for step in summary["steps"])
        assert abs(whole[key] - total) <= ROUNDING*(abs(total) + whole["turnover"]), key
    told = re.search(r"energy over all steps \[J\]\n +work of +(.*)\n +goes to +(.*)\n +remainder +(\S+), (\S+) of", said)
    assert told, said[-800:]
    printed = dict(re.findall(r"(\w+) (\S+)", told.group(1) + told.group(2)))
    for key, value in printed.items():
        value, exact = float(value), whole["dissipated" if key == "friction" else key]
        assert abs(value - exact) <= 1e-5*abs(exact), (key, value, exact)
    assert set(printed) >= {"ends", "elastic", "gravity", "kinetic", "scheme", "settling", "drag"}, printed
    assert abs(float(told.group(3)) - whole["imbalance"]) <= 6e-3*abs(whole["imbalance"]), told.group(3)
    assert abs(float(told.group(4)) - abs(whole["imbalance"])/whole["turnover"]) <= 0.06*float(told.group(4)), told.group(4)
    return summary


def spins(capstan, folder):
    """A body that would turn by more than half a turn in a step has no certified one: what helps is a shorter step."""
    scene = os.path.join(folder, "top.yaml")
    for h, good in ((0.5, False), (0.1, True)):
        with open(scene, "w", encoding="utf-8") as file:
            file.write(TOP.replace("STEP", str(h)))
        done = subprocess.run([capstan, "run", scene, "-o", os.path.join(folder, "top"), "--force", "--no-paraview"], capture_output=True, text=True,
                              timeout=100)
        assert (done.returncode == 0) == good and ("take shorter steps" in done.stderr) != good and "'fixed'" not in done.stderr, done.stderr


def advice(capstan, folder):
    """A line without inertia that falls in a step in time: what tells more is a shorter step, not a 'path_tolerance'."""
    scene = os.path.join(folder, "taut.yaml")
    for entry, cure in (("duration: 1, ", "shorter steps in time tell"), ("", "a 'path_tolerance' tell")):
        with open(scene, "w", encoding="utf-8") as file:
            file.write(TAUT.replace("ENTRY", entry))
        said = run(capstan, scene, os.path.join(folder, "taut"), "--force").stderr
        assert "J are set free" in said and cure in said and said.count(" tell which") == 1, said


def forces(out, summary):
    """What is written of points and bodies adds up to their residuals, and velocities are there."""
    moved = 0.0
    for row in rows(out, "points.csv"):
        if row["point"] != "clump":
            continue
        for a in "xyz":
            sum_, size = 0.0, 0.0
            for key in ("lines", "load", "support", "friction", "inertia"):
                sum_ += float(row[f"{key}_{a}"])
                size += abs(float(row[f"{key}_{a}"]))
            reaction = float(row["reaction"])*float(row[f"normal_{a}"]) if float(row["reaction"]) != 0 else 0
            assert abs(sum_ + reaction - float(row[f"residual_{a}"])) <= ROUNDING*(size + abs(reaction) + 1), row
        moved = max(moved, abs(float(row["velocity_x"])))
        assert float(row["kinetic"]) >= 0
    assert moved > 0.01, moved
    for step in summary["steps"]:
        body, point = step["bodies"]["buoy"], step["points"]["clump"]
        for unit in ("N", "Nm"):
            parts = [body[f"{key}_{unit}"] for key in ("lines", "load", "support", "inertia", "damping")]
            left = sum(sum(part[k] for part in parts)**2 for k in range(3))**0.5
            assert abs(left - body[f"residual_{unit}"]) <= 1e-9*sum(abs(x) for part in parts for x in part), step["name"]
        assert len(body["velocity_m_s"]) == len(body["turn_rate_rad_s"]) == len(point["velocity_m_s"]) == len(point["inertia_N"]) == 3
        assert (step["time_step_s"] > 0) == any(point["velocity_m_s"]), step["name"]


def remains(capstan, folder):
    """Steps that are read from the journal are not computed: no time that remains follows from them."""
    scene, out = os.path.join(folder, "led.yaml"), os.path.join(folder, "led")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(LED)
    started = subprocess.Popen([capstan, "run", scene, "-o", out, "--no-paraview"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    for line in started.stderr:
        if line.startswith("step ") and int(line.split()[1]) >= 1600:
            break
    started.kill()
    started.communicate()
    said = run(capstan, scene, out, "--resume").stderr
    before, _, after = said.partition("steps were done before")
    assert "step 1200 of 4001" in before or "step 1201 of 4001" in before, before
    assert "remain" not in before and "remain" in after, said


def main():
    capstan, = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        scene, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
        with open(scene, "w", encoding="utf-8") as file:
            file.write(SCENE)
        summary = energies(out, run(capstan, scene, out).stdout)
        forces(out, summary)
        remains(capstan, folder)
        advice(capstan, folder)
        spins(capstan, folder)


main()
