# SPDX-License-Identifier: BSD-3-Clause
"""Weightless lines that are pulled straight carry the same tension everywhere, so their utilisation is known: in the table,
the warning, history.csv, summary.json, result.nc and by the checker.                usage: utilisation.py CAPSTAN CHECKER ROOT"""
import csv
import json
import os
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER, ROOT = sys.argv[1:]
sys.path.insert(0, os.path.join(ROOT, "test", "property"))
import result_file  # noqa: E402

SCENE = """capstan: 1
types:
  chain: {weight: 0, stiffness: 1e+6, breaking_load: 400}
  wire: {weight: 0, stiffness: 1e+6, breaking_load: 100}
  rope: {weight: 0, stiffness: 1e+6}
lines:
  plain: {length: 8, elements: 4, weight: 0, stiffness: 1e+5, breaking_load: 250, start: {straight: {from: [0, 0, 0], to: [8, 0, 0]}},
    ends: {A: held, B: free}}
  made: {sections: [{type: rope, length: 2, elements: 2}, {type: chain, length: 2, elements: 2}, {type: wire, length: 4, elements: 1}],
    start: {straight: {from: [0, 5, 0], to: [8, 5, 0]}}, ends: {A: held, B: free}}
  strong: {length: 8, elements: 4, weight: 0, stiffness: 1e+5, start: {straight: {from: [0, 9, 0], to: [8, 9, 0]}}, ends: {A: held, B: free}}
history:
  - {name: pull, steps: 2, plain.B: {force: [100, 0, 0]}, made.B: {force: [130, 0, 0]}, strong.B: {force: [1e+5, 0, 0]}}
  - {name: ease, plain.B: {force: [10, 0, 0]}, made.B: {force: [10, 0, 0]}}
"""
FORCE = {"plain": (50, 100, 10), "made": (65, 130, 10)}  # [N] after each step
WEAKEST = {"plain": 250, "made": 100}
FROM = {"plain": 0, "made": 4}  # [m] where the weakest stretch begins
faults = []


def near(what, found, expected):
    if abs(found - expected) > 1e-9*abs(expected):  # steps are certified to 1e-8 of the energy, and here exact
        faults.append(f"{what}: {found}, expected {expected}")


def numbers(folder):
    """utilisation and its place by each file: {(line, step): [(file, utilisation, place)]}"""
    out = {}
    with open(os.path.join(folder, "history.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))[1:]
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        steps = json.load(file)["steps"]
    results = result_file.Results(os.path.join(folder, "result.nc"))
    for step in range(3):
        for line in FORCE:
            entry = steps[step]["lines"][line]
            out[line, step] = [
                ("history.csv", float(rows[step][line + ".utilisation"]), float(rows[step][line + ".utilisation_at"])),
                ("summary.json", entry["utilisation"], entry["utilisation_at_m"]),
                ("result.nc", results.get(line + "_utilisation", step)[0], results.get(line + "_utilisation_at", step)[0])]
        if rows[step]["strong.utilisation"] or rows[step]["strong.utilisation_at"] or "utilisation" in steps[step]["lines"]["strong"]:
            faults.append("a utilisation of a line without breaking load")
        value = results.get("strong_utilisation", step)[0]
        if value == value:
            faults.append("a utilisation of a line without breaking load in result.nc")
    if "strong_breaking_load" in results.variables or list(results.get("made_breaking_load")) != [float("inf")]*2 + [400]*2 + [100]:
        faults.append("breaking loads in result.nc")
    return out


with tempfile.TemporaryDirectory() as folder:
    scene, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(SCENE)
    done = subprocess.run([CAPSTAN, "run", scene, "-o", out], capture_output=True, text=True, timeout=60)
    if done.returncode:
        faults.append(f"exit code {done.returncode}: {done.stderr}")
    else:
        for (line, step), values in numbers(out).items():
            for name, utilisation, place in values:
                near(f"{line}, step {step}, {name}", utilisation, FORCE[line][step]/WEAKEST[line])
                if not FROM[line] <= place <= 8:
                    faults.append(f"{line}, step {step}, {name}: at {place} m")
        if "utilisation  1.3 of the breaking load at most: step pull 2/2, line made, at " not in done.stdout:
            faults.append("the line below the table: " + done.stdout[-900:])
        said = [row for row in done.stderr.splitlines() if "breaking load" in row]
        if len(said) != 1 or "step pull 2/2, line made: the tension is 1.3 times the breaking load, at " not in said[0]:
            faults.append(f"the warning: {said}")
        checked = subprocess.run([CHECKER, os.path.join(out, "result.nc"), scene], capture_output=True, text=True, timeout=60)
        if checked.returncode:
            faults.append(f"the checker: {checked.stdout}{checked.stderr}")
    told = subprocess.run([CAPSTAN, "check", scene], capture_output=True, text=True, timeout=60).stdout
    for part in ("stiffness 100000 N, breaks at 250 N, start", "wire from 4 m to 8 m: 1 element of 4 m, weight 0 N/m, stiffness 1e+06 N, breaks at 100 N\n"):
        if part not in told:
            faults.append(f"check: no '{part}' in {told}")
print("\n".join(faults) or "utilisation: table, warning, history.csv, summary.json, result.nc and checker agree with the forces")
sys.exit(1 if faults else 0)
