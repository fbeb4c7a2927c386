#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A post that is pushed through a string in one step in time: the run is not certified and says that the step is too long; in 100 steps, and in
steps by an error, it is.                                                                              usage: long_steps.py CAPSTAN"""
import csv
import os
import subprocess
import sys
import tempfile

SCENE = """capstan: 1
gravity: [0, 0, -9.81]
obstacles:
  post: {cylinder: {point: [1, 0.3, 0], axis: [0, 0, 1], radius: 0.05}, friction: 0.2}
lines:
  s: {length: 2.0, elements: 40, mass: 1, stiffness: 1e3, start: {straight: {from: [0, 0, 0], to: [2, 0, 0]}}, ends: {A: held, B: held}}
history:
  - {name: push, post.obstacle: {move: [0, -0.6, 0]}, duration: 1, PACE}
"""
WORDS = "the step is too long"
faults = []
with tempfile.TemporaryDirectory() as folder:
    for pace, code in (("steps: 1", 1), ("steps: 100", 0), ("time_step: 0.5, error: 1e-2", 0)):
        scene, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
        with open(scene, "w", encoding="ascii") as file:
            file.write(SCENE.replace("PACE", pace))
        done = subprocess.run([sys.argv[1], "run", "-q", "--no-paraview", scene, "-o", out, "--force"], capture_output=True, text=True, timeout=300)
        if done.returncode != code or (WORDS in done.stderr) != (code == 1):
            faults.append(f"{pace}: exit code {done.returncode}: {done.stderr}")
        with open(os.path.join(out, "history.csv"), encoding="ascii") as file:
            steps = len(list(csv.DictReader(file))) - 1  # less the row of units
        print(f"{pace}: {steps} steps, exit code {done.returncode}")
        if code == 0 and steps < 30:
            faults.append(f"{pace}: {steps} steps for 12 radii")
for fault in faults:
    print(fault)
sys.exit(1 if faults else 0)
