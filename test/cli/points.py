#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run on a Y-shaped bridle: points.csv, summary.json and result.nc say the same, and the forces on every point balance, computed
from the ends of the lines, the scene and the friction law. A killed run that goes on ends with the same bytes; points without a place are
told; a run without points removes what one with points has written.                                            usage: points.py CAPSTAN

Written by nothing but the layout of classic netCDF files (../property/result_file.py).
"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import time

from checks import expect, faults, read, write

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "property"))
sys.dont_write_bytecode = True  # nothing is left in the source folder
from result_file import Results  # noqa: E402

CAPSTAN = os.path.abspath(sys.argv[1])
FRICTION, TOLERANCE = 0.6, 1e-8
WEIGHT = {"knot": 9000, "float": -2000}
PULL = [20e3, 5e3, 30e3]

# two chains from their anchors to a knot on the bed, which is pulled by a pendant under a float and up by a force, and let go
SCENE = f"""
capstan: 1
obstacles: {{bed: {{plane: {{normal: [0, 0, 1]}}, friction: {FRICTION}}}}}
points:
  west: {{held: [0, 30, 0]}}
  knot: {{free: [80, 0, 0], weight: {WEIGHT["knot"]}}}
  south: {{held: [0, -30, 0]}}
  float: {{free: [95, 0, 20], weight: {WEIGHT["float"]}, force: [8e3, 0, 1e3]}}
lines:
  left: {{length: 86, elements: 30, weight: 300, stiffness: 1e8, start: static, ends: {{A: {{point: west}}, B: {{point: knot}}}}}}
  right: {{length: 86, elements: 30, weight: 300, stiffness: 1e8, start: static, ends: {{A: {{point: knot}}, B: {{point: south}}}}}}
  pendant: {{length: 26, elements: 10, weight: 30, stiffness: 1e7, start: static, ends: {{A: {{point: knot}}, B: {{point: float}}}}}}
  stray: {{length: 12, elements: 4, weight: 30, stiffness: 1e7, start: static, ends: {{A: {{held: [0, 0, 9]}}, B: {{held: [8, 0, 9]}}}}}}
history:
  - {{name: pull, steps: 12, float.point: {{force: {PULL}}}}}
  - {{name: back, steps: 12, float.point: {{force: [8e3, 0, 1e3]}}, west.point: {{move: [0, 2, 0]}}}}
"""
POINTS, LINES = ["west", "knot", "south", "float"], ["left", "right", "pendant", "stray"]
TIES = {"left": [0, 1], "right": [1, 2], "pendant": [1, 3], "stray": [-1, -1]}
STATES = ["held", "free", "stick", "slip"]
VECTORS = {"lines": "N", "load": "N", "support": "N", "normal": "1", "friction": "N", "slip": "m", "residual": "N"}

PLAIN = """
capstan: 1
lines:
  stray: {length: 12, elements: 4, weight: 30, stiffness: 1e7, start: static, ends: {A: {held: [0, 0, 9]}, B: {held: [8, 0, 9]}}}
"""
# the line hangs on nothing but the knot, which falls with it by its own 5 N, the force of 1 N and the line's 10 N
FALLING = """
capstan: 1
points: {knot: {free: [0, 0, 0], weight: 5}}
lines:
  tail: {length: 10, elements: 4, weight: 1, stiffness: 1e6, start: {straight: {from: [0, 0, 0], to: [10, 0, 0]}}, ends: {A: {point: knot}, B: free}}
history: [{name: fall, knot.point: {force: [1, 0, 0]}}]
"""
# two planes would have to hold the clump in the groove between them
GROOVE = """
capstan: 1
obstacles:
  left: {plane: {normal: [1, 0, 1]}, friction: 0.1}
  right: {plane: {normal: [-1, 0, 1]}, friction: 0.1}
points: {knot: {free: [0, 0, 0.5], weight: 15}}
lines:
  tail: {length: 12, elements: 4, weight: 1, stiffness: 1e6, start: static, ends: {A: {held: [0, 0, 10]}, B: {point: knot}}}
"""
# an equilateral triangle of anchors at the radius 1 from a knot, by lines of 0.9: every pair of them reaches (3^0.5 < 1.8), all three do not
SHORT = """
capstan: 1
points:
  east: {held: [1, 0, 0]}
  north: {held: [-0.5, 0.86602540378443865, 0]}
  south: {held: [-0.5, -0.86602540378443865, 0]}
  knot: {free: [0, 0, 0]}
lines:
  one: {length: 0.9, elements: 4, weight: 1, stiffness: .inf, start: static, ends: {A: {point: east}, B: {point: knot}}}
  two: {length: 0.9, elements: 4, weight: 1, stiffness: .inf, start: static, ends: {A: {point: knot}, B: {point: north}}}
  three: {length: 0.9, elements: 4, weight: 1, stiffness: .inf, start: static, ends: {A: {point: south}, B: {point: knot}}}
  elastic: {length: 3, elements: 4, weight: 1, stiffness: 1e5, start: static, ends: {A: {held: [0, 0, 1]}, B: {point: knot}}}
"""


def run(*arguments, code=0):
    done = subprocess.run([CAPSTAN, "run", *arguments], capture_output=True, text=True, timeout=120, check=False)
    expect(f"run {arguments}", done.returncode == code, f"exit {done.returncode}: {done.stderr}")
    return done


def table(folder):
    with open(os.path.join(folder, "points.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return rows[0], rows[1:]


def size(a):
    return sum(x*x for x in a)**0.5


def vector(row, name):
    return [float(row[f"{name}_{a}"]) for a in "xyz"]


def csv_is_result(folder, results):
    """Every number of points.csv has the same bits in result.nc."""
    units, rows = table(folder)
    expect("units", all(units[f"{name}_{a}"] == unit for name, unit in VECTORS.items() for a in "xyz"), units)
    expect("units", [units[k] for k in ("step", "name", "x", "reaction", "dissipated", "obstacle", "trials")] == ["1", "", "m", "N", "J", "", "1"], units)
    expect("rows", len(rows) == results.steps*len(POINTS) and results.steps == 25, f"{len(rows)} of {results.steps} steps")
    expect("names", results.attributes["points"] == " ".join(POINTS), results.attributes)
    for line, tie in TIES.items():
        expect("ties", list(results.get(f"{line}_end_point")) == tie, list(results.get(f"{line}_end_point")))
    expect("kinds", list(results.get("kind_of_point")) == [0, 1, 0, 1], results.get("kind_of_point"))
    expect("weights", list(results.get("weight_of_point")) == [WEIGHT.get(name, 0) for name in POINTS], results.get("weight_of_point"))
    for i, row in enumerate(rows):
        step, k = divmod(i, len(POINTS))
        what = f"step {step}, point {POINTS[k]}"
        expect(what, int(row["step"]) == step and row["point"] == POINTS[k], row)
        position = results.get("position_of_point", step)[3*k:3*k + 3]
        expect(f"{what}, position", [float(row[a]) for a in "xyz"] == list(position), position)
        for name in VECTORS:
            expect(f"{what}, {name}", vector(row, name) == list(results.get(f"{name}_of_point", step)[3*k:3*k + 3]), row)
        for name in ("reaction", "dissipated"):
            expect(f"{what}, {name}", float(row[name]) == results.get(f"{name}_of_point", step)[k], row)
        expect(f"{what}, state", STATES.index(row["state"]) == results.get("state_of_point", step)[k], row)
        expect(f"{what}, obstacle", (row["obstacle"] == "bed") == (results.get("obstacle_of_point", step)[k] == 0), row)
        for name in ("trials", "has_place"):
            expect(f"{what}, {name}", int(row[name]) == results.get(f"{name}_of_point", step)[k], row)


def forces_balance(results):
    """What the lines, the load, the support and the bed do to each point, from the lines' ends and the scene."""
    seen = set()
    for step in range(results.steps):
        largest = max(results.get(f"{line}_largest_force", step)[0] for line in LINES)
        part = min(step, 12)/12 if step <= 12 else 1 - (step - 12)/12
        for k, name in enumerate(POINTS):
            what = f"step {step}, point {name}"

            def of(quantity):
                return list(results.get(f"{quantity}_of_point", step)[3*k:3*k + 3])  # pylint: disable=cell-var-from-loop
            lines, place, normal, friction = [0, 0, 0], of("position"), of("normal"), of("friction")
            for line, tie in TIES.items():
                for end in range(2):
                    if tie[end] != k:
                        continue
                    force = results.get(f"{line}_end_force", step)[3*end:3*end + 3]
                    lines = [a - b for a, b in zip(lines, force)]
                    nodes = results.get(f"{line}_position", step)
                    node = nodes[:3] if end == 0 else nodes[-3:]
                    expect(f"{what}, end of {line}", size([a - b for a, b in zip(node, place)]) <= 1e-12*100, (list(node), place))
            expect(f"{what}, lines", size([a - b for a, b in zip(lines, of("lines"))]) <= 1e-12*largest, (lines, of("lines")))
            start, to = ([8e3, 0, 1e3], PULL) if name == "float" else ([0]*3, [0]*3)
            load = [a + part*(b - a) for a, b in zip(start, to)]
            load[2] -= WEIGHT.get(name, 0)
            if name not in WEIGHT:
                load = [0, 0, 0]
            expect(f"{what}, load", size([a - b for a, b in zip(load, of("load"))]) <= 1e-12*largest, (load, of("load")))
            reaction = results.get("reaction_of_point", step)[k]
            left = [a + b + c + d + reaction*n for a, b, c, d, n in zip(lines, load, of("support"), friction, normal)]
            expect(f"{what}, residual", size([a - b for a, b in zip(left, of("residual"))]) <= 1e-12*largest, (left, of("residual")))
            expect(f"{what}, place", results.get("has_place_of_point", step)[k] == 1 and size(left) <= TOLERANCE*largest, size(left))
            state = results.get("state_of_point", step)[k]
            if step > 0:
                seen.add((name, STATES[state]))
            # the start is without friction
            mu = FRICTION if step > 0 else 0
            expect(f"{what}, friction", size(friction) <= mu*reaction*(1 + 1e-9) + 1e-9, (size(friction), reaction))
            touches = results.get("obstacle_of_point", step)[k] == 0
            expect(f"{what}, touches", touches == (state >= 2 or name in ("west", "south")), (touches, state))
            if touches:
                expect(f"{what}, on the bed", reaction > 0 and normal == [0, 0, 1] and abs(place[2]) <= 1e-7, (reaction, normal, place))
            else:
                expect(f"{what}, off the bed", reaction == 0 and size(friction) == 0 and normal == [0, 0, 0], (reaction, friction))
            if state == 0:
                expect(f"{what}, held", size(friction) == 0, friction)
            if state == 3 and step > 0:
                slip = of("slip")
                dissipated = -sum(a*b for a, b in zip(friction, slip))
                # friction is opposite to the slip and at its bound, to the share of the residual in it
                expect(f"{what}, sliding", dissipated >= (1 - 1e-4)*mu*reaction*size(slip), (friction, slip))
                expect(f"{what}, dissipated", abs(dissipated - results.get("dissipated_of_point", step)[k]) <= 1e-9*dissipated, dissipated)
    expect("what the test has seen", seen >= {("west", "held"), ("knot", "free"), ("knot", "stick"), ("knot", "slip"), ("float", "free")}, sorted(seen))


def summary_is_result(folder, results):
    summary = json.loads(read(os.path.join(folder, "summary.json")))
    expect("points of the summary", list(summary["points"]) == POINTS, summary["points"])
    for k, name in enumerate(POINTS):
        residuals = [size(results.get("residual_of_point", step)[3*k:3*k + 3]) for step in range(results.steps)]
        found = summary["points"][name]
        expect(f"largest residual of {name}", abs(found["largest_residual_N"] - max(residuals)) <= 1e-14*max(residuals), found)
        expect(f"step of it, {name}", abs(residuals[found["largest_residual_step"]] - max(residuals)) <= 1e-14*max(residuals), found)
        expect(f"{name}", found["steps_without_place"] == 0 and found["kind"] == ("free" if name in WEIGHT else "held")
              and found["weight_N"] == WEIGHT.get(name, 0), found)
        for step, entry in enumerate(summary["steps"]):
            point = entry["points"][name]
            expect(f"summary, step {step}, {name}", point["position_m"] == list(results.get("position_of_point", step)[3*k:3*k + 3])
                  and point["lines_N"] == list(results.get("lines_of_point", step)[3*k:3*k + 3])
                  and point["state"] == STATES[results.get("state_of_point", step)[k]] and point["has_place"] is True
                  and ("reaction_N" in point) == (results.get("obstacle_of_point", step)[k] == 0), point)


def pictures(folder):
    for name in ("step-00012-plan.svg", "step-00012-elevation.svg", "plan.svg", "elevation.svg"):
        text = read(os.path.join(folder, name)).decode()
        expect(f"{name}, names", all(re.search(f">{point}</text>", text) for point in POINTS), name)
        # an end at a point is not marked once more
        expect(f"{name}, ends", ">stray.A<" in text or name in ("plan.svg", "elevation.svg"), name)
        expect(f"{name}, ends at points", ">left.A<" not in text, name)


def killed_and_resumed(scene, whole):
    process = subprocess.Popen([CAPSTAN, "run", scene, "-q", "-o", "killed"], stderr=subprocess.DEVNULL)
    while process.poll() is None and not (os.path.exists("killed/.journal") and os.path.getsize("killed/.journal") > 100000):
        time.sleep(0.0005)
    expect("killed before its end", process.poll() is None)
    process.kill()
    process.wait()
    said = run(scene, "-q", "--resume", "-o", "killed").stderr
    expect("resumed", "steps were done before" in said and "capstan: 0 of" not in said, said)
    expect("points.csv of the resumed run", read("killed/points.csv") == whole)


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        write("scene.yaml", SCENE)
        write("plain.yaml", PLAIN)
        write("falling.yaml", FALLING)
        write("groove.yaml", GROOVE)
        write("short.yaml", SHORT)
        said = run("scene.yaml", "-o", "out").stdout
        expect("said", "points.csv" in said, said)
        results = Results("out/result.nc")
        csv_is_result("out", results)
        forces_balance(results)
        summary_is_result("out", results)
        pictures("out")
        whole = read("out/points.csv")
        expect("in the list of files", '"name": "points.csv"' in read("out/summary.json").decode())
        run("scene.yaml", "-q", "-o", "threads", "--threads=3")
        expect("the same bytes with three threads", read("threads/points.csv") == whole)
        killed_and_resumed("scene.yaml", whole)

        # a run without points
        said = run("plain.yaml", "-o", "out").stdout
        summary = json.loads(read("out/summary.json"))
        results = Results("out/result.nc")
        expect("not said", "points.csv" not in said, said)
        expect("removed", not os.path.exists("out/points.csv"))
        expect("no points", "points" not in summary and "points" not in summary["steps"][0] and "points" not in results.attributes
              and not [name for name in results.variables if "point" in name and not name.startswith("obstacle_")], sorted(results.variables))

        # a file of somebody else
        os.mkdir("mine")
        write("mine/points.csv", "mine")
        run("scene.yaml", "-q", "-o", "mine", code=4)
        expect("a file of somebody else", read("mine/points.csv") == b"mine")

        # no place
        done = run("groove.yaml", "-o", "groove", code=1)
        told = r"point knot: no place found where the forces on it balance \([0-9.e+]+ N are left after \d+ trials\)\n"
        expect("told in the table", re.search("^ +" + told, done.stdout, re.M), done.stdout)
        expect("told", re.search("^capstan: step static, " + told, done.stderr, re.M), done.stderr)
        _, rows = table("groove")
        expect("without a place", rows[-1]["has_place"] == "0" and float(rows[-1]["residual_z"]) != 0, rows[-1])
        expect("in the summary", json.loads(read("groove/summary.json"))["points"]["knot"]["steps_without_place"] == 1)

        # no equilibrium, with the proof of the group in each of its lines
        done = run("falling.yaml", "-o", "falling", code=5)
        expect("falls", "no place found" not in done.stdout + done.stderr and "(15.0333 N along (0.06652, 0, -0.9978))" in done.stderr, done.stderr)
        proof = json.loads(read("falling/summary.json"))["steps"][-1]["lines"]["tail"]["proof"]
        fall = (1 + 15*15)**0.5
        expect("fall", abs(proof["fall_N"] - fall) <= 1e-12*fall
              and size([a - b/fall for a, b in zip(proof["direction"], (1, 0, -15))]) <= 1e-12, proof)
        done = run("short.yaml", "-o", "short", code=5)
        expect("short", "no place found" not in done.stdout + done.stderr and "too short (by 0.3 m for the self-stress that is " in done.stderr, done.stderr)
        lines = json.loads(read("short/summary.json"))["steps"][-1]["lines"]
        for name, pull in (("one", (-1, 0, 0)), ("two", (-0.5, 3**0.5/2, 0)), ("three", (0.5, 3**0.5/2, 0)), ("elastic", (0, 0, 0))):
            proof = lines[name]["proof"]
            expect(f"self-stress of {name}", lines[name]["outcome"] == "infeasible" and abs(proof["excess_m"] - 0.3) <= 1e-9
                  and size([a - b for a, b in zip(proof["direction"], pull)]) <= 1e-9, proof)

        # the method of 1990
        for arguments in (["run", "scene.yaml", "--method", "regularized"], ["study", "scene.yaml", "--history"]):
            done = subprocess.run([CAPSTAN, *arguments, "-o", "1990"], capture_output=True, text=True, check=False)
            expect(" ".join(arguments), done.returncode == 3 and "points where lines meet" in done.stderr and not os.path.exists("1990"), done.stderr)
        os.chdir("/")
    print("\n".join(faults[:20]) or "points: good")
    return len(faults) > 0


sys.exit(main())
