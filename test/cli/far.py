# SPDX-License-Identifier: BSD-3-Clause
"""Scenes in large coordinates: what the files carry, what the checker says of them, what is warned of.

usage: far.py CAPSTAN CHECKER EXAMPLES"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER, EXAMPLES = sys.argv[1:]
SHIFT = (498765.25, 5987654.5, 0.0)  # as UTM coordinates are
faults = []


def check(condition, text):
    if not condition:
        faults.append(text)


def moved(text):
    """Every [x, y, z] of a place, shifted; directions stay."""
    def by(match):
        place = [repr(float(x) + s) for x, s in zip(match[2].split(","), SHIFT)]
        return match[1] + "[" + ", ".join(place) + "]"
    return re.sub(r"((?:point|centre|from|to|held|position): *)\[([^]]*)\]", by, text)


def run(folder, scene, out, *more):
    return subprocess.run([CAPSTAN, *more, scene, "-o", out], cwd=folder, capture_output=True, text=True, timeout=120)


def rows(folder, out):
    with open(os.path.join(folder, out, "history.csv"), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))[1:]


with tempfile.TemporaryDirectory() as folder:
    with open(os.path.join(EXAMPLES, "souza-de-cursi-1990-example-11-2.yaml"), encoding="utf-8") as file:
        text = file.read()
    for name, scene in (("here", text), ("there", moved(text))):
        with open(os.path.join(folder, name + ".yaml"), "w", encoding="utf-8") as file:
            file.write(scene)
        done = run(folder, name + ".yaml", name, "run")
        check(done.returncode == 0, f"{name}: exit code {done.returncode}: {done.stderr}")
        check(("origin" in done.stdout) == (name == "there"), f"{name}: said {done.stdout}")
        checked = subprocess.run([CHECKER, os.path.join(folder, name, "result.nc"), os.path.join(folder, name + ".yaml")],
                                 capture_output=True, text=True, timeout=60)
        check(checked.returncode == 0, f"{name}: checker: {checked.stdout}{checked.stderr}")
        for method, said in (("regularized", "history.csv"),):
            done = run(folder, name + ".yaml", name + "-1990", "run", "--method", method)
            check(done.returncode == 0, f"{name}, {method}: exit code {done.returncode}: {done.stderr}")

    # the tables are in the coordinates of the scene: 1e-9 is their last digit
    for out in ("", "-1990"):
        for here, there in zip(rows(folder, "here" + out), rows(folder, "there" + out)):
            for x, s in zip("xyz", SHIFT):
                column = next(c for c in here if c.endswith("B." + x))
                apart = float(there[column]) - s - float(here[column])
                check(abs(apart) < 4e-9, f"history.csv{out}: B.{x} is {apart} m off")
    with open(os.path.join(folder, "here", "summary.json"), encoding="utf-8") as file:
        check("origin_m" not in json.load(file), "here: summary.json has an origin")
    with open(os.path.join(folder, "there", "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    origin = summary.get("origin_m", [0, 0, 0])
    check(all(abs(o - s) < 2 for o, s in zip(origin, SHIFT)), f"there: origin {origin}")

    # places whose last digit is a tension of its own: 1e-9 m of 1 m at 1e9 N, where some newtons are at work
    stiff = moved(text).replace("stiffness: 1 ", "stiffness: 1e7 ")
    check("1e7" in stiff, "no stiffness to change")
    with open(os.path.join(folder, "stiff.yaml"), "w", encoding="utf-8") as file:
        file.write(stiff)
    done = run(folder, "stiff.yaml", "stiff", "run")
    check("coordinates are so large" in done.stderr, f"stiff: said {done.stderr}")

print("\n".join(faults) or "far: the same answers, in the coordinates of the scene")
sys.exit(1 if faults else 0)
