#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan offset: restoring forces against stiffness and against a run of the same offsets, headings that a symmetric mooring cannot tell
apart, friction there and back, lines that are missing, an offset that cannot be reached, and wrong calls.      usage: offset.py CAPSTAN
"""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile

CAPSTAN = os.path.abspath(sys.argv[1])
REACH, DEPTH, LENGTH = 80.0, 30.0, 92.0

failed = 0


def check(name, holds, found=""):
    global failed
    if not holds:
        failed += 1
        print(f"FAILED {name}: {found}")


def scene(friction=0.0, kind="held", lines=3, stiffness="1e6", history=""):
    """A body on equal lines at equal angles, of which the first leads along x."""
    text = f"capstan: 1\nobstacles: {{bed: {{plane: {{point: [0, 0, {-DEPTH}]}}, friction: {friction}}}}}\n"
    text += f"bodies:\n  buoy: {{{kind}: [0, 0, 0], weight: 4e4, buoyancy: 1.2e5, hydrostatics: {{z: 3e4, rx: 1e6, ry: 1e6, rz: 1e6}}}}\n"
    points, ropes = "points:\n", "lines:\n"
    for k in range(lines):
        x, y = math.cos(2 * math.pi * k / lines), math.sin(2 * math.pi * k / lines)
        points += f"  anchor{k}: {{held: [{REACH * x}, {REACH * y}, {-DEPTH}]}}\n  eye{k}: {{body: buoy, at: [{2 * x}, {2 * y}, 0]}}\n"
        ropes += f"  leg{k}: {{length: {LENGTH}, elements: 60, weight: 200, stiffness: {stiffness}, start: static, breaking_load: 2e5,\n"
        ropes += f"    ends: {{A: {{point: anchor{k}}}, B: {{point: eye{k}}}}}}}\n"
    return text + points + ropes + history


def run(folder, text, *more, code=0, verb="offset"):
    with open(os.path.join(folder, "scene.yaml"), "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([CAPSTAN, verb, "scene.yaml", *more], cwd=folder, capture_output=True, text=True, timeout=300)
    check(f"{verb} {more}", done.returncode == code, f"exit {done.returncode}: {done.stderr}")
    return done


def table(*path):
    with open(os.path.join(*path), encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return rows[0], rows[1:]


def number(row, name):
    return float(row[name]) if row[name] else math.nan


def curves(folder, out):
    """The rows by heading."""
    found = {}
    units, rows = table(folder, out, "offset.csv")
    check("units", units["offset"] == "m" and units["restoring"] == "N" and units["heading"] == "deg", units)
    for row in rows:
        found.setdefault(float(row["heading"]), []).append(row)
    return found


def near(name, found, expected, by):
    check(name, abs(found - expected) <= by, f"{found}, expected {expected} within {by}")


def without_friction(folder):
    """The way back is the way out, equal headings are equal, and the slope is the stiffness of the mooring."""
    run(folder, scene(), "-o", "smooth", "--headings", "0,120,240,60,180", "--to", "0.5", "--steps", "5", "-q")
    found = curves(folder, "smooth")
    check("headings", sorted(found) == [0, 60, 120, 180, 240], sorted(found))
    size = max(number(row, "tension") for row in found[0])
    for heading, rows in found.items():
        check("rows", len(rows) == 11, f"{len(rows)} rows of heading {heading}")
        check("certified", all(row["certified"] == "1" for row in rows), heading)
        for k in range(6):
            near(f"offset {k} of {heading}", number(rows[k], "offset"), 0.1 * k, 1e-12)
            near(f"back {k} of {heading}", number(rows[10 - k], "restoring"), number(rows[k], "restoring"), 1e-8 * size)
        near(f"at rest, {heading}", number(rows[0], "restoring"), 0, 1e-8 * size)
    for a, b in ((0, 120), (0, 240), (60, 180)):
        for k in range(6):
            near(f"{a} as {b} at {k}", number(found[a][k], "restoring"), number(found[b][k], "restoring"), 1e-7 * size)
            near(f"across {b} at {k}", number(found[b][k], "across"), 0, 1e-7 * size)
    check("it is pulled back", number(found[0][5], "restoring") > 10, found[0][5])
    # towards an anchor its line goes slack and those behind come taut, away from it the line itself does
    check("line", found[180][5]["line"] == "leg0" and found[0][5]["line"] != "leg0", found[180][5]["line"])


def as_a_run(folder):
    """The same offsets as entries of a history give the same forces."""
    moves = "".join(f"  - {{name: m{k}, buoy.body: {{position: [{0.3 * k * math.cos(math.radians(30))}, {0.3 * k * math.sin(math.radians(30))}, 0]}}}}\n"
                    for k in (1, 2, 1, 0))
    run(folder, scene(0.6, history="history:\n" + moves), "-o", "run", "-q", "--no-paraview", verb="run")
    run(folder, scene(0.6), "-o", "rough", "--headings", "30", "--to", "0.6", "--steps", "2", "-q")
    _, bodies = table(folder, "run", "bodies.csv")
    rows = curves(folder, "rough")[30]
    check("as many", len(bodies) == len(rows), f"{len(bodies)} steps, {len(rows)} offsets")
    size = max(number(row, "tension") for row in rows)
    for k, (body, row) in enumerate(zip(bodies, rows)):
        for name in ("lines_x", "lines_y", "lines_z"):
            near(f"{name} at {k}", number(row, name), number(body, name), 1e-7 * size)
    check("friction holds on the way back", number(rows[1], "restoring") - number(rows[3], "restoring") > 1, [rows[1], rows[3]])


def missing_lines(folder):
    """With a line missing the body goes away from it, and the same way for each of three equal ones."""
    text = scene(kind="free")
    done = run(folder, text, "-o", "broken", "--headings", "0", "--to", "0.2", "--steps", "1", "--broken")
    check("printed", "missing" in done.stdout and "leg1" in done.stdout, done.stdout)
    units, rows = table(folder, "broken", "broken.csv")
    check("rows", [row["missing"] for row in rows] == ["", "leg0", "leg1", "leg2"], rows)
    check("units", units["heel"] == "deg" and units["tension"] == "N", units)
    check("certified", all(row["certified"] == "1" for row in rows), rows)
    near("intact", math.hypot(number(rows[0], "from_x"), number(rows[0], "from_y")), 0, 0)
    near("upright", number(rows[0], "heel"), 0, 1e-5)
    for k in range(3):
        x, y = number(rows[k + 1], "from_x"), number(rows[k + 1], "from_y")
        near(f"as far, {k}", math.hypot(x, y), math.hypot(number(rows[1], "from_x"), number(rows[1], "from_y")), 1e-4)
        near(f"away from leg {k}", math.degrees(math.atan2(-y, -x)) % 360, 120 * k, 0.01) if k else check("away", x < -1, x)
        check(f"in another line, {k}", rows[k + 1]["line"] != f"leg{k}", rows[k + 1]["line"])
        check("utilisation", abs(number(rows[k + 1], "utilisation") - number(rows[k + 1], "tension") / 2e5) < 1e-6, rows[k + 1])
    with open(os.path.join(folder, "broken", "offset.json"), encoding="utf-8") as file:
        summary = json.load(file)
    check("summary", summary["complete"] is True and summary["body"] == "buoy", summary)


def out_of_reach(folder):
    """Inextensible lines end the way out; what was reached is written, and the exit code says that something is missing."""
    done = run(folder, scene(stiffness=".inf"), "-o", "far", "--headings", "180", "--to", "40", "--steps", "8", code=1)
    check("said", "not certified" in done.stdout, done.stdout)
    rows = curves(folder, "far")[180]
    open_rows = [row for row in rows if row["certified"] == "0"]
    check("one is open", len(open_rows) == 1 and not open_rows[0]["restoring"], rows)
    near("back to where it was", number(rows[-1], "offset"), 0, 0)
    near("without force", number(rows[-1], "restoring"), 0, 1e-6 * max(number(row, "tension") for row in rows if row["tension"]))


def wrong_calls(folder):
    for more, part in ((["--headings", "x"], "--headings"), (["--headings", ""], "--headings"), (["--headings", "1,,2"], "--headings"),
                       (["--headings", ",".join(["1"] * 73)], "1 to 72"), (["--headings", "nan"], "--headings"), (["--to", "-1"], "--to"),
                       (["--to", "0"], "--to"), (["--to", "1m"], "--to"), (["--steps", "0"], "--steps"), (["--steps", "1.5"], "--steps"),
                       (["--steps", "1001"], "--steps"), (["--body", "ship"], "ship"), (["--stiffness"], "unknown option")):
        done = run(folder, scene(), *more, code=2)
        check(f"says {part}", part in done.stderr, done.stderr)
    no_body = "capstan: 1\nlines: {rope: {length: 1, mass: 1, stiffness: 1e3, start: {straight: {from: [0, 0, 0], to: [1, 0, 0]}}, ends: {A: held, B: held}}}\n"
    done = run(folder, no_body, code=3)
    check("says body", "no body" in done.stderr, done.stderr)
    in_time = scene(history="history:\n  - {name: rest}\n  - {name: swing, duration: 1, steps: 10}\n").replace("weight: 200", "mass: 20")
    done = run(folder, in_time, "-o", "in time", code=3)
    check("says duration", done.stderr == "capstan offset: step 'swing' of the history has a duration, and offsets are those of lines at rest: "
          "leave its duration out\n", done.stderr)
    check("writes nothing", not os.path.exists(os.path.join(folder, "in time")), os.listdir(folder))


with tempfile.TemporaryDirectory() as directory:
    without_friction(directory)
    as_a_run(directory)
    missing_lines(directory)
    out_of_reach(directory)
    wrong_calls(directory)
sys.exit(1 if failed else 0)
