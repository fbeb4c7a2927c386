#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Time of a step in time against the number of elements: a mooring line with friction whose end sways.

usage: scale_in_time.py MOTION_BENCH

Prints a row of the table in README.md for each size. The line is that of the OC3 spar on its bed in air, with mu = 0.5 and 0; its end goes to and fro by 1 m
along and 0.5 m across with a period of 8 s, in 40 steps of 0.05 s after a static start, which is not counted.
"""
import os
import re
import subprocess
import sys
import tempfile

FRICTIONS = [0.5, 0]
SIZES = [100, 1000, 10000, 100000]
STEPS = 40
SCENE = """capstan: 1
gravity: [0, 0, -9.81]
obstacles:
  bed: {{plane: {{point: [0, 0, -320]}}, friction: {friction}}}
lines:
  line: {{length: 902.2, elements: {elements}, mass: 77.7066, stiffness: 384.243e6, start: static,
    ends: {{A: {{held: [853.87, 0, -320]}}, B: {{held: [5.2, 0, -70]}}}}}}
history:
  - {{name: sway, duration: {duration}, steps: {steps}, line.B: {{move: [0, 0, 0], sine: [1, 0.5, 0], period: 8}}}}
"""


def measure(bench, friction, elements):
    """Seconds of processor, steps that were not certified, and iterations."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.yaml")
        with open(path, "w", encoding="ascii") as file:
            file.write(SCENE.format(friction=friction, elements=elements, steps=STEPS, duration=0.05 * STEPS))
        done = subprocess.run([bench, path, "0"], stdout=subprocess.PIPE, text=True, check=True)
    seconds, uncertified, iterations = re.search(r"processor_s (\S+) uncertified (\d+) iterations (\d+)", done.stdout).groups()
    return float(seconds), int(uncertified), int(iterations)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print("| mu | elements | ms a step | iterations a step | microseconds per node and iteration | not certified |\n|---|---|---|---|---|---|")
    for friction in FRICTIONS:
        for elements in SIZES:
            seconds, uncertified, iterations = measure(sys.argv[1], friction, elements)
            each = 1e6 * seconds / iterations / (elements + 1)
            print(f"| {friction} | {elements} | {1e3 * seconds / STEPS:.3g} | {iterations / STEPS:.3g} | {each:.3g} | {uncertified} |", flush=True)


if __name__ == "__main__":
    main()
