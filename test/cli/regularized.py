# SPDX-License-Identifier: BSD-3-Clause
"""capstan run --method regularized: its files, its words and its exit codes.    usage: regularized.py CAPSTAN EXAMPLES"""
import csv
import json
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

CAPSTAN, EXAMPLES = sys.argv[1:]
EXAMPLE = os.path.join(EXAMPLES, "souza-de-cursi-1990.yaml")
THREE_LINES = os.path.join(EXAMPLES, "souza-de-cursi-1990-plane.yaml")
SLACK = os.path.join(EXAMPLES, "souza-de-cursi-1990-slack.yaml")

# The last half has three times the friction; end B is held on the bed in the fourth step and let go in the last.
ZONES = """\
capstan: 1
friction_policy: frozen
gravity: [0, 0, -9.81]
obstacles: {bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.3}}
lines:
  rope:
    length: 1
    elements: 40
    weight: 1
    stiffness: 5
    friction_zones: [{from: 0, to: 0.1, factor: 0.5}, {from: 0.5, to: 1, factor: 3}]
    start: {straight: {from: [0, 0, 0], to: [1, 0, 0]}}
    ends: {A: {held: [0, 0, 0]}, B: {force: [0, 0, 0]}}
history:
  - {name: along, rope.B: {force: [0.3, 0.3, 0]}}
  - {name: aside, rope.B: {force: [0, 0.5, 0]}}
  - {name: back, rope.B: {force: [-0.3, 0.5, 0]}}
  - {name: hold, rope.B: {position: [-0.2, 1.0, 0]}}
  - {name: let go, rope.B: {force: [-0.1, 0.3, 0]}}
"""

faults = []


def check(condition, text):
    if not condition:
        faults.append(text)


def run(folder, *arguments):
    return subprocess.run([CAPSTAN, "run", *arguments], cwd=folder, capture_output=True, text=True, timeout=120)


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))[1:]


with tempfile.TemporaryDirectory() as folder:
    # a directory of its own, never taken for the exact results
    done = run(folder, EXAMPLE, "--method", "regularized")
    check(done.returncode == 0, f"exit code {done.returncode}\n{done.stderr}")
    check("no certificate" in done.stdout, f"said\n{done.stdout}")
    place = os.path.join(folder, "results", "souza-de-cursi-1990-regularized")
    names = sorted(os.listdir(place))
    check(names == [".capstan", "history.csv", "line-1.svg", "summary.json"], f"files: {names}")
    check("nan" not in xml.tostring(xml.parse(os.path.join(place, "line-1.svg")).getroot(), encoding="unicode"), "draws NaN")
    rows = table(os.path.join(place, "history.csv"))
    check([row["step"] for row in rows] == ["Y2", "Y3", "Y4", "Y5"], "history.csv: steps")
    with open(os.path.join(place, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    check(summary["method"] == "regularized" and summary["certificate"].startswith("none"), "summary: says it is certified")
    check(summary["converged"] and summary["complete"], "summary: not converged or not complete")
    left = summary["steps"][0]["lines"]["cable"]["left"]
    # the bed's reaction of 9.81 N/m sinks by w/lambda, with what one node's share at the tip adds
    sunk = 9.81 / summary["steps"][0]["lines"]["cable"]["parameters"]["lambda_N/m2"]
    check(abs(left["penetration_m"] / sunk - 1) < 0.01, f"penetration {left['penetration_m']}, expected {sunk}")

    # the certified run, steps Y2 and Y3 without loose slack: the same places to what the parameters leave
    exact = run(folder, EXAMPLE, "--method", "exact", "-o", "exact")
    check(exact.returncode == 0 and os.path.exists(os.path.join(folder, "exact", "result.nc")), "exact: no result.nc")
    with open(os.path.join(folder, "exact", "summary.json"), encoding="utf-8") as file:
        steps = json.load(file)["steps"]
    # P3.1 or P4.2 alone, unique or not: Y2 and Y3 in Kin, Y4 and Y5 with slack let down that no friction holds
    said = [line.strip() for line in exact.stdout.splitlines() if "a solution of P" in line]
    check(len(said) == 4 and all("P3.1, the only one" in line for line in said[:2]) and
          all("outside Kin" in line and "one of many" in line for line in said[2:]), f"outcomes: {said}")
    for row, step in list(zip(rows, steps))[:2]:
        tip = step["lines"]["cable"]["B"]["position_m"]
        apart = max(abs(float(row[f"B.{x}"]) - value) for x, value in zip("xyz", tip))
        check(apart < 2e-5, f"{row['step']}: tips {apart} m apart")
        # tensions at the ends have one meaning: at B the force applied, at A what friction creeps off in the regularised step
        for end, allowed in (("A", 1e-4), ("B", 1e-12)):
            apart = abs(float(row[f"tension_{end}"]) - step["lines"]["cable"][end]["tension_N"])
            check(apart < allowed, f"{row['step']}: tensions at {end} {apart} N apart")

    # several lines, a picture each; one JSON object on standard output
    done = run(folder, THREE_LINES, "--method=regularized", "--json", "-o", "three")
    check(done.returncode == 0, f"three lines: exit code {done.returncode}\n{done.stderr}")
    check(sorted(json.loads(done.stdout)["steps"][2]["lines"]) == ["around", "aside", "direct"], "three lines: JSON")
    check(os.path.exists(os.path.join(folder, "three", "line-3.svg")), "three lines: no picture of the third")
    check(len(table(os.path.join(folder, "three", "history.csv"))) == 9, "three lines: rows")

    # friction zones: from the second step on friction is that of the zones too. The frozen run has it by other code (src/cable)
    with open(os.path.join(folder, "zones.yaml"), "w", encoding="utf-8") as file:
        file.write(ZONES)
    exact, own = run(folder, "zones.yaml", "-o", "zones-exact"), run(folder, "zones.yaml", "--method", "regularized", "-o", "zones-own")
    check(exact.returncode == 0 and own.returncode == 0, f"zones: {exact.stderr}{own.stderr}")
    with open(os.path.join(folder, "zones-exact", "summary.json"), encoding="utf-8") as file:
        steps = json.load(file)["steps"]
    for row, step in zip(table(os.path.join(folder, "zones-own", "history.csv")), steps):
        tip = step["lines"]["rope"]["B"]["position_m"]
        apart = max(abs(float(row[f"B.{x}"]) - value) for x, value in zip("xyz", tip))
        # what the penalty leaves: it sinks by w/lambda = 7e-8 m, creep is less
        check(apart < 1e-6, f"zones, {row['step']}: tips {apart} m apart")
        apart = abs(float(row["tension_A"]) - step["lines"]["rope"]["A"]["tension_N"])
        # beside a held end, which does not sink, the line hangs by its tension, T w/(lambda l) = 2e-6 N of a bound in the next step
        check(apart < (2e-5 if row["step"] == "let go" else 1e-6), f"zones, {row['step']}: tensions at A {apart} N apart")

    # parameters of one's own in every step: the bed sinks by w/lambda
    done = run(folder, EXAMPLE, "--method", "regularized", "--lambda", "1e5", "--delta=1e-4", "--n", "inf", "-o", "own")
    check(done.returncode == 0, f"own parameters: {done.stderr}")
    for row in table(os.path.join(folder, "own", "history.csv")):
        check(float(row["lambda"]) == 1e5 and float(row["delta"]) == 1e-4 and float(row["1/n"]) == 0, f"own parameters: {row}")
        check(abs(float(row["penetration"]) / (9.81 / 1e5) - 1) < 0.05, f"own lambda: sunk by {row['penetration']}")
    # what is wrong
    check(run(folder, EXAMPLE, "--delta", "1e-3").returncode == 2, "--delta of the exact method")
    for arguments, code, words in (
            ([EXAMPLE, "--method", "newton"], 2, ["newton", "regularized"]),
            ([EXAMPLE, "--method", "regularized", "--resume"], 2, ["--resume"]),
            ([EXAMPLE, "--method", "regularized", "--path-tolerance", "0.1"], 2, ["--path-tolerance"]),
            ([SLACK, "--method", "regularized", "-o", "slack"], 3, ["inextensible"]),
            ([EXAMPLE, "--method", "regularized", "-o", os.path.join("no", "such", "place")], 4, ["no"])):
        done = run(folder, *arguments)
        check(done.returncode == code, f"{arguments}: exit code {done.returncode}, expected {code}")
        for word in words:
            check(word in done.stderr, f"{arguments}: '{word}' not in: {done.stderr}")
    check(not os.path.exists(os.path.join(folder, "slack")), "inextensible: a directory was left behind")

print("\n".join(faults) or "run --method regularized: files, words and exit codes as documented")
sys.exit(1 if faults else 0)
