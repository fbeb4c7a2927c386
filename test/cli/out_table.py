#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run --out-table: history.out against history.csv, points.csv and bodies.csv of the same run, of random scenes; refused of a history without
time; and the simulated time that a run in time shows.                                          usage: out_table.py CAPSTAN [SCENES [SEED]]
"""
import csv
import math
import os
import pty
import random
import re
import subprocess
import sys
import time

from checks import expect, has_terminals, read, run_in_an_empty_folder, write

CAPSTAN = os.path.abspath(sys.argv[1])
SCENES, SEED = (int(text) for text in (sys.argv[2:4] + ["12", "1"][len(sys.argv[2:4]):]))
# sines and cosines of angles that are rounded once, products of three of them, and a quaternion of size 1 to rounding
ANGLES_AGREE = 1e-14
MOVING = """\
capstan: 1
gravity: [0, 0, -10]
lines:
  chain: {length: 4, elements: 12, mass: 1.5, stiffness: 5.0e4, start: static, ends: {A: {held: [0, 0, 0]}, B: {held: [3, 0, 0]}}}
history:
  - {name: raise, steps: 3, chain.B: {move: [0, 0, 0.2]}}
  - {name: shake, duration: 2, time_step: %s, chain.B: {move: [0, 0, 0], sine: [0, 0.1, 0.2], period: 0.5}}
"""


def run(*arguments, code=0):
    done = subprocess.run([CAPSTAN, "run", *arguments], capture_output=True, text=True, timeout=300, check=False)
    expect("exit code of run " + " ".join(arguments), done.returncode == code, (done.returncode, done.stderr))
    return done


def table(path):
    """The names, the units, and the rows as numbers."""
    rows = [line.split() for line in read(path).decode("ascii").splitlines()]
    return rows[0], rows[1], [[float(cell) for cell in row] for row in rows[2:]]


def sheet(path, key=None):
    """Of a CSV file, the rows below the units; with the column `key`, the rows of each of its values, in the order of the file."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))[1:]
    if key is None:
        return rows
    return {name: [row for row in rows if row[key] == name] for name in dict.fromkeys(row[key] for row in rows)}


def number(cell):
    return float(cell) if cell else math.nan


def same(a, b):
    return a == b or (math.isnan(a) and math.isnan(b))


def turned(angles):
    """The matrix of turns about x, about y as turned, about z as turned [degree]."""
    product = [[float(i == k) for k in range(3)] for i in range(3)]
    for axis, angle in enumerate(angles):
        c, s, p, q = math.cos(math.radians(angle)), math.sin(math.radians(angle)), (axis + 1) % 3, (axis + 2) % 3
        for row in product:
            row[p], row[q] = row[p] * c + row[q] * s, row[q] * c - row[p] * s
    return product


def of_quaternion(w, x, y, z):
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def compared(what, folder, lines):
    """Every number of history.out against the other tables. Returns how many rows are compared."""
    names, units, rows = table(os.path.join(folder, "history.out"))
    history = sheet(os.path.join(folder, "history.csv"))
    others = {kind: sheet(path, kind) if os.path.exists(path) else {} for kind in ("point", "body")
              for path in [os.path.join(folder, {"point": "points.csv", "body": "bodies.csv"}[kind])]}
    wanted = {"Time": ("(s)", lambda k: number(history[k]["time"]))}

    def column(name, unit, rows, key, sign=1):
        wanted[name] = (unit, lambda k: sign * number(rows[k][key]))

    for i, line in enumerate(lines, 1):
        column(f"FAIRTEN{i}", "(N)", history, line + ".B.tension")
        column(f"ANCHTEN{i}", "(N)", history, line + ".A.tension")
        for end in "AB":
            for axis in "xyz":
                column(f"LINE{i}N{end}P{axis.upper()}", "(m)", history, f"{line}.{end}.{axis}")
                column(f"LINE{i}N{end}F{axis.upper()}", "(N)", history, f"{line}.{end}.f{axis}", -1)
    for i, of in enumerate(others["point"].values(), 1):
        for axis in "xyz":
            column(f"POINT{i}P{axis.upper()}", "(m)", of, axis)
    for i, of in enumerate(others["body"].values(), 1):
        for axis in "xyz":
            column(f"BODY{i}P{axis.upper()}", "(m)", of, axis)
            column(f"BODY{i}V{axis.upper()}", "(m/s)", of, "velocity_" + axis)
            wanted[f"BODY{i}R{axis.upper()}"] = wanted[f"BODY{i}RV{axis.upper()}"] = None
    expect(what + ": columns", sorted(names) == sorted(wanted) and names[0] == "Time", names)
    at = {name: i for i, name in enumerate(names)}
    kept = [k for k in range(len(history)) if k + 1 == len(history) or number(history[k + 1]["time"]) > number(history[k]["time"])]
    expect(what + ": a row per time", len(rows) == len(kept), (len(rows), len(kept)))
    for k, row in zip(kept, rows):
        for name, entry in wanted.items():
            if entry is None:
                continue
            expect(f"{what}, {name}: unit", units[at[name]] == entry[0], units[at[name]])
            expect(f"{what}, {name}, step {k}", same(row[at[name]], entry[1](k)), (row[at[name]], entry[1](k)))
        for i, of in enumerate(others["body"].values(), 1):
            found = turned([row[at[f"BODY{i}R{axis}"]] for axis in "XYZ"])
            true = of_quaternion(*(number(of[k]["q" + part]) for part in "wxyz"))
            apart = max(abs(found[a][b] - true[a][b]) for a in range(3) for b in range(3))
            expect(f"{what}, body {i}, step {k}: angles", apart <= ANGLES_AGREE, apart)
            for axis in "XYZ":
                rate = math.degrees(number(of[k]["turn_rate_" + axis.lower()]))
                expect(f"{what}, body {i}, step {k}: rates", abs(row[at[f"BODY{i}RV{axis}"]] - rate) <= 4e-16 * abs(rate), rate)
    times = [row[0] for row in rows]
    expect(what + ": times increase", all(b > a for a, b in zip(times, times[1:])), times)
    return len(rows)


def entries(rng, line, body):
    """Some entries of a history, at least one of them in time."""
    kinds = [rng.random() < 0.6 for _ in range(rng.randint(1, 4))]
    kinds[rng.randrange(len(kinds))] = True
    for k, in_time in enumerate(kinds):
        length = f"duration: {10 ** rng.uniform(-2, 0.3):.3g}, " if in_time else ""
        move = [round(rng.uniform(-0.1, 0.1), 3) for _ in range(3)]
        change = rng.choice(["", f", {line}.B: {{move: {move}}}"])
        if line and k + 1 == len(kinds) and in_time and rng.random() < 0.3:
            change = f", {line}.B: {{release: true}}"
        if body:
            change = rng.choice(["", f", buoy.body: {{force: {[2000 * x for x in move]}}}", f", barge.body: {{move: {move}}}"])
        yield f"  - {{name: part {k}, {length}steps: {rng.randint(1, 5)}{change}}}\n"


def hanging(rng):
    """Lines that hang between held ends, which may be far from the origin; an end may be moved or let go."""
    x, y, z = (rng.choice([0, 0, 1, -1]) * 10 ** rng.uniform(0, 5) for _ in range(3))
    lines = [rng.choice(["line", "Zug_", "FAIRTEN", "L" * 60]) + str(i) for i in range(rng.randint(1, 4))]
    text = "capstan: 1\ngravity: [0, 0, -10]\nlines:\n"
    for i, name in enumerate(lines):
        text += (f"  {name}: {{length: {rng.uniform(3.2, 5):.6g}, elements: {rng.randint(2, 12)}, mass: 1.5, stiffness: 5.0e4, start: static, "
                 f"ends: {{A: {{held: [{x!r}, {y + i!r}, {z!r}]}}, B: {{held: [{x + 3!r}, {y + i!r}, {z!r}]}}}}}}\n")
    return text + "history:\n" + "".join(entries(rng, rng.choice(lines), False)), lines


def floating(rng):
    """A body that turns, on lines to a held point and a knot, and a held one on a line."""
    rate = [round(rng.uniform(-3, 3), 3) for _ in range(3)]
    angles = [round(rng.uniform(-most, most), 1) for most in (180, 90, 180)]
    return f"""capstan: 1
gravity: [0, 0, -10]
bodies:
  buoy: {{free: [0, 0, 0], mass: 500, centre_of_gravity: [0, 0, -1], volume: 0.5, moments_of_inertia: [100, 100, 50], hydrostatics: {{z: 1e4, rx: 2e4, ry: 2e4}},
    velocity: [1, 0, 0], turn_rate: {rate}}}
  barge: {{held: [20, 0, 0], rotation: {{roll_pitch_yaw: {angles}}}}}
points:
  anchor: {{held: [0, 0, -50]}}
  knot: {{free: [0, 0, -20], mass: 30, velocity: [0, 1, 0]}}
  eye: {{body: buoy, at: [0, 0, -2]}}
  bitt: {{body: barge, at: [0, 0, 0]}}
water_density: 1000
lines:
  leg: {{length: 30, elements: 4, mass: 1, stiffness: 1e6, start: {{straight: {{from: [0, 0, -50], to: [0, 0, -20]}}}}, ends: {{A: {{point: anchor}}, B: {{point: knot}}}}}}
  top: {{length: 18, elements: 4, mass: 1, stiffness: 1e6, start: {{straight: {{from: [0, 0, -20], to: [0, 0, -2]}}}}, ends: {{A: {{point: knot}}, B: {{point: eye}}}}}}
  hawser: {{length: 3, elements: 4, mass: 1, stiffness: 1e6, start: {{straight: {{from: [20, 0, 0], to: [20, 3, 0]}}}}, ends: {{A: {{point: bitt}}, B: {{held: [20, 3, 0]}}}}}}
history:
""" + "".join(entries(rng, None, True)), ["leg", "top", "hawser"]


def random_scenes():
    rows = bodies = 0
    for i in range(SCENES):
        rng = random.Random(f"{SEED}/{i}")
        make = rng.choice([hanging, hanging, floating])
        text, lines = make(rng)
        write(f"{i}.yaml", text)
        done = subprocess.run([CAPSTAN, "run", f"{i}.yaml", "-q", "--no-paraview", "--out-table", "-o", str(i)], capture_output=True, text=True, timeout=300, check=False)
        if done.returncode not in (0, 1, 5):  # steps without an answer are in the tables as well
            expect(f"scene {i}: exit code", False, (done.returncode, done.stderr, text))
            continue
        rows += compared(f"scene {i} of seed {SEED}", str(i), lines)
        bodies += make is floating
    expect("scenes with and without bodies, and rows", 0 < bodies < SCENES and rows > 3 * SCENES, (bodies, rows))
    print(f"{rows} rows of {SCENES} scenes, {bodies} of them with bodies, seed {SEED}")


def on_request():
    write("moving.yaml", MOVING % "0.05")
    said = run("moving.yaml", "-o", "out", "--out-table").stdout
    expect("told", "history.csv, result.nc, history.out," in said, said)
    expect("in the list of the run's files", b'"name": "history.out"' in read("out/summary.json"))
    expect("a row per time", compared("moving", "out", ["chain"]) == 41)
    before = read("out/history.out")
    run("moving.yaml", "-q", "-o", "out", "--out-table", "--threads=2")
    expect("the same bytes again", read("out/history.out") == before)
    said = run("moving.yaml", "-o", "out").stdout
    expect("removed by a run that does not write it", not os.path.exists("out/history.out") and "history.out" not in said, said)
    os.mkdir("mine")
    write("mine/history.out", "mine")
    said = run("moving.yaml", "-o", "mine", "--out-table", code=4).stderr
    expect("a file of somebody else", read("mine/history.out") == b"mine" and os.listdir("mine") == ["history.out"], said)


def refused_without_time():
    write("still.yaml", (MOVING % "0.05").replace("duration: 2, time_step: 0.05", "steps: 2").replace(", sine: [0, 0.1, 0.2], period: 0.5", ""))
    said = run("still.yaml", "-o", "still", "--out-table", code=3).stderr
    expect("no time", said.count("\n") == 1 and "no step of the history has a duration: give an entry of the history one, or take history.csv" in said, said)
    expect("no time: no results", not os.path.exists("still"), os.path.exists("still"))
    said = run("still.yaml", "-o", "still").stderr
    expect("no time is shown of a history without", "step" in said and "t =" not in said and "remain" not in said, said)


def killed_and_resumed():
    write("long.yaml", MOVING % "0.0005")
    run("long.yaml", "-q", "-o", "whole", "--out-table", "--no-paraview", "--sync=end")
    process = subprocess.Popen([CAPSTAN, "run", "long.yaml", "-q", "-o", "killed", "--out-table", "--no-paraview"], stderr=subprocess.DEVNULL)
    while process.poll() is None and not (os.path.exists("killed/.journal") and os.path.getsize("killed/.journal") > 100000):
        time.sleep(0.0005)
    expect("killed before its end", process.poll() is None)
    process.kill()
    process.wait()
    expect("killed: no table", not os.path.exists("killed/history.out"))
    said = run("long.yaml", "--resume", "-o", "killed", "--out-table", "--no-paraview", "--sync=end").stderr
    expect("resumed", "steps were done before" in said and "capstan: 0 of" not in said, said)
    expect("the same bytes resumed", read("killed/history.out") == read("whole/history.out"))
    known = int(re.search(r"(\d+) of \d+ steps were done before", said)[1])
    for done, rest in ((int(m[1]), m[2]) for m in re.finditer(r"step (\d+) of .*?s(, about .* remain)?: ", said)):
        expect(f"time remaining at step {done}, {known} read back", (rest is not None) == (done > known), said)


def shown():
    """The times in the lines of progress: 3 steps, the static one before them, and 40 of 0.05 s."""
    said = run("moving.yaml", "-o", "out").stderr
    lines = [line for line in said.splitlines() if line.startswith("step ")]
    expect("a line per tenth", len(lines) == 10, said)
    for line in lines:
        found = re.fullmatch(r"step (\d+) of 44, [\d.]+ s, t = (\S+) of 2 s(?:, h = (\S+) s)?, about [\d.]+ s remain: .*", line)
        expect("a line of progress", found is not None, line)
        if not found:
            continue
        steps = max(int(found[1]) - 4, 0)
        expect("simulated time", abs(float(found[2]) - 0.05 * steps) <= 1e-6, line)  # six digits are printed
        expect("h where a step in time was taken", found[3] == ("0.05" if steps else None), line)
    expect("nothing remains at the end", "t = 2 of 2 s, h = 0.05 s, about 0.0 s remain" in lines[-1], lines[-1])
    expect("quiet", run("moving.yaml", "-q", "-o", "out").stderr == "")


def shown_on_a_terminal():
    if not has_terminals():
        print("no pseudo-terminals here: progress on one is not looked at")
        return
    ours, theirs = pty.openpty()
    process = subprocess.Popen([CAPSTAN, "run", "moving.yaml", "-o", "out"], stdout=subprocess.DEVNULL, stderr=theirs)
    os.close(theirs)
    said = b""
    try:
        while part := os.read(ours, 4096):
            said += part
    except OSError:  # the other end is closed
        pass
    os.close(ours)
    process.wait()
    drawn = [text for text in said.decode().split("\r") if text.startswith("[")]
    expect("drawn", drawn and "] 44/44" in drawn[-1] and "t = 2 of 2 s, h = 0.05 s, about 0.0 s remain" in drawn[-1], drawn)
    expect("a line of 80 characters holds it", all(len(text.replace("\x1b[K", "")) <= 80 for text in drawn), drawn)


def main():
    for part in (random_scenes, on_request, refused_without_time, killed_and_resumed, shown, shown_on_a_terminal):
        part()


run_in_an_empty_folder(main, "history.out: the numbers of the other tables; and simulated time as progress")
