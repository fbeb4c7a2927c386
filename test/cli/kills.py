# SPDX-License-Identifier: BSD-3-Clause
"""Runs that are killed at random moments, up to three times each, and go on with --resume: every file is as that of a run without a kill.

usage: kills.py CAPSTAN EXAMPLES TRIALS

The histories have warm steps (curved and straight), lines of sections with clumps and buoys, and several lines that are shared by threads, whose
number changes from one part of a run to the next. The moment of a kill is a random time of the run, or a random size of its journal: on a busy
machine most of the time is that of the start. CAPSTAN_SEED names another series."""
import math
import os
import random
import re
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True
from checks import expect, run_in_an_empty_folder, write
from same_files import differences

CAPSTAN, EXAMPLES = (os.path.abspath(a) for a in sys.argv[1:3])
TRIALS = int(sys.argv[3])
SEED = int(os.environ.get("CAPSTAN_SEED", "1"))

LINES = """capstan: 1
water_density: 1025
types:
  chain: {mass: 160, diameter: 0.13, stiffness: 7e8}
  wire: {mass: 42, diameter: 0.09, stiffness: 6e8, friction: 0.5}
obstacles:
  bed: {plane: {point: [0, 0, -100]}, friction: 0.8}
lines:
  east:
    sections: [{type: chain, length: 200, elements: 40}, {type: wire, length: 350, element_length: 5}, {type: chain, length: 60, elements: 12}]
    point_weights: [{at: 200, mass: 8000, volume: 3}, {at: 450, weight: -30e3}]
    start: static
    ends: {A: {held: [0, 0, -100]}, B: {held: [560, 0, -10]}}
  north:
    sections: [{type: chain, length: 150, elements: 30}, {type: wire, length: 250, elements: 60}]
    start: static
    ends: {A: {held: [0, 0, -100]}, B: {held: [0, 360, -20]}}
  west:
    length: 400
    elements: 90
    mass: 100
    stiffness: 5e8
    start: static
    ends: {A: {held: [0, 0, -100]}, B: {held: [-360, 20, -10]}}
history:
  - {name: out, steps: 8, east.B: {move: [12, 0, 0]}, north.B: {move: [12, 0, 0]}, west.B: {move: [12, 0, 0]}}
  - {name: aside, steps: 8, east.B: {move: [0, 20, 0]}, north.B: {move: [0, -20, 0]}, west.B: {move: [0, 20, 0]}}
  - {name: home, steps: 8, east.B: {move: [-12, -20, 0]}, north.B: {move: [-12, 20, 0]}, west.B: {move: [-12, -20, 0]}}
"""
# points, one of which displaces water, and a body in time, then at rest: added mass, damping, a member and a line in waves, oscillating loads, a line without inertia, a clump that lands and slides
IN_TIME = """capstan: 1
gravity: [0, 0, -9.81]
water_density: 1025
water_surface: 2
waves: {depth: 22, ramp: 1, components: [{amplitude: 0.4, period: 3, direction: 20}, {amplitude: 0.3, period: 5, direction: -60, phase: 50}]}
obstacles:
  bed: {plane: {point: [0, 0, -20]}, friction: 0.3}
bodies:
  float: {free: [0, 0, 0], rotation: {roll_pitch_yaw: [5, 12, 20]}, mass: 400, moments_of_inertia: [90, 120, 150], products_of_inertia: [4, -3, 5], centre_of_gravity: [0.2, 0.1, -0.8], buoyancy: 6000, centre_of_buoyancy: [0, 0, 0.3], hydrostatics: [[10, 0, 0, 0, 5, 0], [0, 12, 0, 0, 0, 0], [0, 0, 3000, 0, 0, 0], [0, 0, 0, 900, 0, 0], [5, 0, 0, 0, 910, 0], [0, 0, 0, 0, 0, 40]], added_mass: [[200, 0, 0, 0, -40, 0], [0, 220, 0, 30, 0, 0], [0, 0, 300, 0, 0, 0], [0, 30, 0, 50, 0, 0], [-40, 0, 0, 0, 60, 0], [0, 0, 0, 0, 0, 20]], damping: {x: 20, z: 90, rx: 30, rz: 15}, quadratic_damping: {x: 40, z: 25, ry: 12}, velocity: [0.4, -0.2, 0.3], turn_rate: [0.5, 0.2, -0.3], force: [50, 10, 0], arm: [0, 0, 1], members: [{from: [0, 0, -1], to: [0.4, 0, 3], diameter: 0.6, normal: 1.1, tangential: 0.1, added_normal: 0.9}]}
points:
  left: {body: float, at: [-1, 0.2, -1]}
  right: {body: float, at: [1, 0, -1]}
  knot: {free: [9, 0, -9], mass: 60, volume: 0.02, height: 0.5, velocity: [0.2, 0.5, 0]}
  clump: {free: [14, 3, -19.99], mass: 80, velocity: [0.6, 0.8, -0.4]}
lines:
  a: {length: 22.07, elements: 10, mass: 4, stiffness: 1e5, quasi_static: true, start: {straight: {from: [-12, 1, -20], to: [-1.208334883627139, -0.1350230755365901, -0.7494635268526606]}}, ends: {A: {held: [-12, 1, -20]}, B: {point: left}}}
  b: {length: 11.39, elements: 6, mass: 3, stiffness: 1e5, damping: 500, drag: {diameter: 0.1, normal: 1.2, tangential: 0.2, added_normal: 0.9, added_tangential: 0.2}, start: {straight: {from: [0.6947194347465925, 0.3456063995896875, -1.182337144619938], to: [9, 0, -9]}}, ends: {A: {point: right}, B: {point: knot}}}
  c: {length: 12.4, elements: 6, mass: 3, stiffness: 1e5, start: {straight: {from: [9, 0, -9], to: [14, 3, -19.99]}}, ends: {A: {point: knot}, B: {point: clump}}}
history:
  - {name: swing, duration: 1, steps: 40, float.body: {force: [90, 10, 0], arm: [0, 0, 1]}, knot.point: {force: [0, 40, 0]}}
  - {name: go on, duration: 1, time_step: 0.04, error: 1e-4, float.body: {force: [0, 0, 0], oscillations: [{sine: [0, 30, 0], moment_cosine: [8, 0, 0], period: 1.3}]}, knot.point: {force: [0, 40, 0], sine: [5, 0, 0], period: 0.7}}
  - {name: rest, steps: 2}
"""
WHOLE = {}  # scene: (directory of the run without a kill, seconds it took, largest size of its journal)


def command(scene, directory, more=()):
    return [CAPSTAN, "run", scene, "-q", "-o", directory, *more]


def journal_size(directory):
    try:
        return os.path.getsize(os.path.join(directory, ".journal"))
    except FileNotFoundError:
        return 0


def run_whole(scene):
    directory, largest = "whole-" + os.path.basename(scene), 0
    begun = time.monotonic()
    process = subprocess.Popen(command(scene, directory), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None:
        largest = max(largest, journal_size(directory))
        time.sleep(0.001)
    expect(f"{scene}: exit code {process.returncode}, journal of {largest} bytes", process.returncode == 0 and largest > 0)
    WHOLE[scene] = directory, time.monotonic() - begun, largest


def kill_after(scene, directory, more, seconds, size):
    """Kill a run after so many seconds, or when its journal is larger than `size`; False if it was over before."""
    process = subprocess.Popen(command(scene, directory, more), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    begun = time.monotonic()
    while process.poll() is None:
        if time.monotonic() - begun > seconds or journal_size(directory) > size:
            process.kill()
            process.communicate()
            return True
        time.sleep(0.0005)
    _, said = process.communicate()
    expect(f"{scene}: a run that was not killed, {more}", process.returncode == 0, said)
    return False


def try_one(number, rng, tally):
    scene = rng.choice(sorted(WHOLE))
    whole, seconds, largest = WHOLE[scene]
    shutil.rmtree("killed", ignore_errors=True)
    kills, resumed = 0, []
    while kills < 3:
        moment = (rng.uniform(0, 1.1)*seconds, math.inf) if rng.random() < 0.3 else (math.inf, rng.uniform(0, 1)*largest)
        if not kill_after(scene, "killed", [*resumed, "--threads", str(rng.randint(1, 3))], *moment):
            break
        kills, resumed = kills + 1, ["--resume"]
        if rng.random() < 0.5:
            break
    done = subprocess.run(command(scene, "killed", ["--resume", "--threads", str(rng.randint(1, 3))]), capture_output=True, text=True)
    where = f"trial {number}, seed {SEED}, {os.path.basename(scene)}, {kills} kills"
    expect(f"{where}: exit code {done.returncode}", done.returncode == 0, done.stderr)
    differ = differences("killed", whole)
    expect(f"{where}: files that differ", not differ, differ[:10])
    tally["kills"] += kills
    before = re.search(r"(\d+) of (\d+) steps were done before", done.stderr)
    tally["under way"] += bool(before) and 0 < int(before[1]) < int(before[2])


def main():
    rng = random.Random(SEED)
    write("lines.yaml", LINES)
    write("in-time.yaml", IN_TIME)
    for name in ("oc3-hywind-line", "chain-wire-chain", "drum"):
        shutil.copy(os.path.join(EXAMPLES, name + ".yaml"), ".")
    for scene in ("lines.yaml", "in-time.yaml", "oc3-hywind-line.yaml", "chain-wire-chain.yaml", "drum.yaml"):
        run_whole(scene)
    tally = {"kills": 0, "under way": 0}
    for number in range(TRIALS):
        try_one(number, rng, tally)
    expect("some runs go on", tally["under way"] > 0, tally)
    print(f"{tally['kills']} kills in {TRIALS} runs, of which {tally['under way']} at last went on in the middle of a history")


run_in_an_empty_folder(main, "kills: every file as that of a run without a kill")
