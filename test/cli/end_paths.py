# SPDX-License-Identifier: BSD-3-Clause
"""Held ends are moved straight from place to place: a path that leads through an obstacle is refused, with its line and column, the end,
the obstacle and the depth; a path past it, along it or away from it is not.                                  usage: end_paths.py CAPSTAN"""
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile

CAPSTAN = sys.argv[1]
SCENES = 80
INPUT = 3
faults = []


def surface(kind, point, axis, radius):
    if kind == "plane":
        return f"plane: {{point: {point}, normal: {axis}}}"
    if kind == "sphere":
        return f"sphere: {{centre: {point}, radius: {radius!r}, axis: {axis}}}"
    return f"cylinder: {{point: {point}, axis: {axis}, radius: {radius!r}}}"


def gap(kind, point, axis, radius, x):
    """distance of x from the surface"""
    d = [a - b for a, b in zip(x, point)]
    size = math.sqrt(sum(a*a for a in axis))
    along = sum(a*b for a, b in zip(d, axis))/size
    if kind == "plane":
        return along
    if kind == "cylinder":
        d = [a - along*b/size for a, b in zip(d, axis)]
    return math.sqrt(sum(a*a for a in d)) - radius


def deepest(solid, a, b):
    """by walking the way in small steps, then once more around the deepest of them"""
    low, high = 0.0, 1.0
    for _ in range(5):
        ts = [low + (high - low)*i/200 for i in range(201)]
        best = min(ts, key=lambda t: gap(*solid, [p + t*(q - p) for p, q in zip(a, b)]))
        low, high = max(0, best - (high - low)/200), min(1, best + (high - low)/200)
    return -gap(*solid, [p + best*(q - p) for p, q in zip(a, b)])


def scene(solids, start, history, ends="{A: held, B: held}", length=10.0):
    """a line straight down from `start`, its end B; as text"""
    obstacles = "".join(f"  {name}: {{{surface(*solid)}}}\n" for name, solid in solids.items())
    foot = [start[0], start[1], start[2] + length]
    return ("capstan: 1\nobstacles:\n" + obstacles + f"lines:\n  rope: {{length: {length}, elements: 4, mass: 1, stiffness: .inf, "
            f"start: {{straight: {{from: {foot}, to: {start}}}}}, ends: {ends}}}\nhistory:\n"
            + "".join(f"  - {{name: entry, {entry}}}\n" for entry in history))


def check(folder, text):
    path = os.path.join(folder, "scene.yaml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([CAPSTAN, "check", path], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stderr


def expect(folder, what, text, refused):
    """refused: None, or (line of the history from 0, end, obstacle, depth)"""
    code, said = check(folder, text)
    if refused is None:
        if code:
            faults.append(f"{what}: refused: {said}")
        return
    entry, end, obstacle, depth = refused
    lines = text.splitlines()
    row = lines.index("history:") + 1 + entry
    place = f":{row + 1}:{lines[row].index('rope.') + 1}: stage {entry + 1}: rope.{end} "
    found = re.search(rf"through obstacle '{obstacle}', up to (\S+) m deep: add way points", said)
    if code != INPUT or place not in said or not found:
        faults.append(f"{what}: expected a refusal with '{place}' and '{obstacle}', found exit {code}: {said}")
    elif abs(float(found[1]) - depth) > 1e-5*depth + 1e-9:  # six digits are printed; the walk finds 1e-9 of the way
        faults.append(f"{what}: said {found[1]} m, it is {depth} m")


def chance(folder):
    """an end goes from place to place round about a cylinder or ball; the first way through it is what is refused"""
    rng = random.Random(5)
    count = 0
    while count < SCENES:
        kind = rng.choice(["cylinder", "sphere"])
        size = 10**rng.uniform(-2, 2)
        solid = (kind, [size*rng.uniform(-1, 1) for _ in range(3)], [rng.uniform(-1, 1) for _ in range(3)], size*10**rng.uniform(-1, 0))
        places = [[p + size*rng.uniform(-3, 3) for p in solid[1]] for _ in range(rng.randint(2, 5))]
        depth = [deepest(solid, a, b) for a, b in zip(places, places[1:])]
        length = 10*size
        whole = {"post": solid}
        if min(gap(*solid, p) for p in places) < 1e-3*size or any(abs(d) < 1e-4*size for d in depth):
            continue  # the places themselves are clear, and no way is a matter of rounding
        first = [places[0][0], places[0][1], places[0][2]]
        if deepest(solid, first, [first[0], first[1], first[2] + length]) > -1e-6*size:
            continue  # so is the start shape
        moves = [f"rope.B: {{position: {p}}}" for p in places[1:]]
        hit = next((i for i, d in enumerate(depth) if d > 0), None)
        expect(folder, f"random {count}", scene(whole, first, moves, length=length), None if hit is None else (hit, "B", "post", depth[hit]))
        count += 1


def special(folder):
    drum = {"drum": ("cylinder", [0, 0, 0], [0, 1, 0], 1.0)}
    bed = {"bed": ("plane", [0, 0, 0], [0, 0, 1], 0)}
    both = {**bed, **drum}

    def position(x):
        return f"rope.B: {{position: {x}}}"

    expect(folder, "along a plane", scene(bed, [0, 0, 0], [position([5, 0, 0]), position([0, 5, 0])]), None)
    expect(folder, "rests on a drum", scene(drum, [0, 0, 1], [position([0, 0, 1])]), None)
    expect(folder, "along a drum's generator", scene(drum, [0, 0, 1], [position([0, 3, 1])]), None)
    expect(folder, "off a drum along its tangent", scene(drum, [0, 0, 1], [position([2, 0, 1])]), None)
    expect(folder, "over a drum and touches it", scene(drum, [-3, 0, 1], [position([3, 0, 1])]), None)
    expect(folder, "touches it within 1e-9 of the length", scene(drum, [-3, 0, 1 - 9e-9], [position([3, 0, 1 - 9e-9])]), None)
    expect(folder, "goes in by more than 1e-9 of the length", scene(drum, [-3, 0, 1 - 2e-8], [position([3, 0, 1 - 2e-8])]), (0, "B", "drum", 2e-8))
    expect(folder, "by a chord of the drum", scene(drum, [0, 0, 1], [position([1, 0, 0])]), (0, "B", "drum", 1 - math.sqrt(0.5)))
    expect(folder, "in several steps", scene(drum, [-3, 0, 2], ["steps: 50, " + position([3, 0, -2])]), (0, "B", "drum", 1))
    expect(folder, "by a move", scene(drum, [-3, 0, 2], ["rope.B: {move: [6, 0, -4]}"]), (0, "B", "drum", 1))
    expect(folder, "the other end", scene(drum, [3, 0, 2], ["rope.A: {position: [3, 0, 10]}", "rope.A: {position: [-3, 0, -10]}"]),
           (1, "A", "drum", 1))
    expect(folder, "the second of two obstacles", scene(both, [-3, 0, 0.5], [position([3, 0, 0.5])]), (0, "B", "drum", 0.5))
    expect(folder, "by way points", scene(drum, [-3, 0, -2], [position([-3, 0, 3]), position([3, 0, 3]), position([3, 0, -2])]), None)
    expect(folder, "force instead of a way", scene(drum, [-3, 0, 0], ["rope.B: {force: [9, 0, 0]}"]), None)
    expect(folder, "let go and grabbed", scene(drum, [-3, 0, 2], ["rope.B: {force: [0, 0, 0]}", position([3, 0, -2])]), None)
    expect(folder, "grabbed, then moved", scene(drum, [-3, 0, 2], ["rope.B: {force: [0, 0, 0]}", position([3, 0, 2]), position([-3, 0, -2])]),
           (2, "B", "drum", 1))
    expect(folder, "an end that is free at first", scene(drum, [-3, 0, 2], [position([3, 0, -2])], ends="{A: held, B: free}"), None)


def grabbed(folder):
    """where a free end is grabbed is known when the entry begins: the run ends there, and keeps the steps before it"""
    ball = {"ball": ("sphere", [0, 0, 0], [0, 1, 0], 1.0)}
    text = scene(ball, [-3, 0, -0.5], ["rope.B: {force: [0, 0, -1]}", "rope.B: {position: [3, 0, -0.5]}"])
    expect(folder, "not known before", text, None)
    out = os.path.join(folder, "out")
    done = subprocess.run([CAPSTAN, "run", os.path.join(folder, "scene.yaml"), "-o", out], capture_output=True, text=True, timeout=60)
    wanted = "rope.B is grabbed at (-3, 0, -0.5) m and goes straight to (3, 0, -0.5) m, through obstacle 'ball', up to 0.5 m deep: add way points"
    if done.returncode != INPUT or wanted not in done.stderr:
        faults.append(f"grabbed: expected exit {INPUT} and '{wanted}', found {done.returncode}: {done.stderr}")
    elif len(json.load(open(os.path.join(out, "summary.json"), encoding="utf-8"))["steps"]) != 1:
        faults.append("grabbed: the step before is not in the results")
    again = scene(ball, [-3, 0, -0.5], ["rope.B: {force: [0, 0, -1]}", "rope.B: {position: [-3, 0, 2]}", "rope.B: {position: [3, 0, 2]}"])
    expect(folder, "round it", again, None)
    done = subprocess.run([CAPSTAN, "run", os.path.join(folder, "scene.yaml"), "-o", out], capture_output=True, text=True, timeout=60)
    if done.returncode == INPUT:
        faults.append(f"grabbed and led round it: {done.stderr}")


with tempfile.TemporaryDirectory() as directory:
    chance(directory)
    special(directory)
    grabbed(directory)
print("\n".join(faults) or f"ways: {SCENES} at random and the special ones, refused only where they lead through an obstacle")
sys.exit(1 if faults else 0)
