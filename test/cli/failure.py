#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lines that part and ends that are let go: what the table, history.csv, summary.json, result.nc and the checker say of the example; a run that is
killed and goes on; a line missing from the start against one that is let go; and one that parts against one let go at the same time.
                                                                                                usage: failure.py CAPSTAN CHECKER ROOT"""
import csv
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time

CAPSTAN, CHECKER, ROOT = sys.argv[1:]
sys.path.insert(0, os.path.join(ROOT, "test", "property"))
import result_file  # noqa: E402

EXAMPLE = os.path.join(ROOT, "examples", "parting-lines.yaml")
NAMES = ["bow_p", "bow_s", "stern_p", "stern_s"]
faults = []


def check(what, holds, found=""):
    if not holds:
        faults.append(f"{what}: {found}")


def run(*more, code=0):
    done = subprocess.run([CAPSTAN, *more], capture_output=True, text=True, timeout=300)
    check(f"capstan {more}", done.returncode == code, f"exit {done.returncode}: {done.stderr}")
    return done.stdout


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))[1:]


def the_files_agree(folder):
    """Which lines part, at which ends, in which steps, at which tensions; and from which step on they are free."""
    out = os.path.join(folder, "example")
    table = run("run", EXAMPLE, "-o", out)
    rows, results = rows_of(os.path.join(out, "history.csv")), result_file.Results(os.path.join(out, "result.nc"))
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        steps = json.load(file)["steps"]
    done = subprocess.run([CHECKER, os.path.join(out, "result.nc"), EXAMPLE], capture_output=True, text=True)
    check("checker", done.returncode == 0, done.stdout + done.stderr)
    check("as many rows as steps", len(rows) == len(steps), (len(rows), len(steps)))
    breaks = [i for i in range(len(steps)) if "break" in steps[i]]
    check("two break", len(breaks) == 2 and breaks[1] == breaks[0] + 1, breaks)
    let_go = {}  # (line, end): step
    for i, (row, step) in enumerate(zip(rows, steps)):
        line, end = results.get("break_line", i)[0], results.get("break_end", i)[0]
        check(f"result.nc, step {i}", (line >= 0) == (i in breaks), line)
        if i in breaks:
            entry = step["break"]
            check(f"line of step {i}", NAMES[line] == entry["line"] and "AB"[end] == entry["end"], (line, end, entry))
            check(f"name of step {i}", row["name"] == f"{entry['line']}.{entry['end']} parts", row["name"])
            tension = float(rows[i - 1][f"{entry['line']}.{entry['end']}.tension"])  # the largest of this chain is at its upper end
            check(f"tension of step {i}", entry["tension_N"] == tension == results.get("break_tension", i)[0] > entry["break_at_N"] == 2.2e5, entry)
            shares = {name: float(rows[i - 1][name + ".break_share"]) for name in NAMES[:2]}
            check(f"share before step {i}", shares[entry["line"]] == max(shares.values()) == tension / 2.2e5, shares)
            said = f"line {entry['line']} parts at end {entry['end']}: {tension:.6g} N at 130 m, above its break_at of 220000 N (step {i})"
            check(f"table, step {i}", said in table, table)
            let_go[entry["line"], entry["end"]] = i
    let_go["stern_s", "B"] = len(steps) - 1
    for i, (row, step) in enumerate(zip(rows, steps)):
        for k, name in enumerate(NAMES):
            check("break_share", bool(row[name + ".break_share"]) == (k < 2) == ("break_share" in step["lines"][name]), (i, name))
            for e, end in enumerate("AB"):
                since = let_go.get((name, end), len(steps))
                word = "none" if i < since else "released" if name == "stern_s" else "parted"
                found = [row[f"{name}.{end}.release"], step["lines"][name]["release"][end],
                         ["none", "released", "parted", "taken"][results.get(name + "_end_release", i)[e]]]
                check(f"release of {name}.{end} in step {i}", found == [word] * 3, (word, found))
                if word != "none":
                    check("nothing pulls there", float(row[f"{name}.{end}.tension"]) == 0, row[f"{name}.{end}.tension"])
    pictures = [name for name in os.listdir(out) if name.endswith("-plan.svg")]
    for name in pictures:
        with open(os.path.join(out, name), encoding="utf-8") as file:
            crosses = "parted" in file.read().split("of 16: ")[1].split("</svg>")[0].replace(" parts", "")
        check(f"crosses in {name}", crosses == (int(name[5:10]) >= breaks[0]), name)


def killed_and_resumed(folder):
    """A run killed beside its breaks ends with the same bytes as a whole one but for the time it took."""
    whole, scene = os.path.join(folder, "whole"), os.path.join(folder, "long.yaml")
    with open(EXAMPLE, encoding="utf-8") as file:
        text = file.read().replace("elements: 60", "elements: 120")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(text)
    run("run", scene, "-o", whole, "-q")
    for i in range(2):
        out = os.path.join(folder, f"killed{i}")
        process = subprocess.Popen([CAPSTAN, "run", scene, "-q", "-o", out], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        journal, size = os.path.join(out, ".journal"), (4 + 3*i) * 4 * 120 * 300  # about a few steps, and some more
        while process.poll() is None and not (os.path.exists(journal) and os.path.getsize(journal) > size):
            time.sleep(0.001)
        process.send_signal(signal.SIGKILL)
        process.wait()
        if os.path.exists(journal):
            run("run", scene, "-q", "--resume", "-o", out)
        for name in sorted(os.listdir(whole)):
            if name.endswith(".vtp"):
                with open(os.path.join(whole, name), "rb") as a, open(os.path.join(out, name), "rb") as b:
                    check(f"{name} after a kill", a.read() == b.read())
        a, b = rows_of(os.path.join(whole, "history.csv")), rows_of(os.path.join(out, "history.csv"))
        check("history after a kill", [{**row, "wall": ""} for row in a] == [{**row, "wall": ""} for row in b])


def mooring(friction, history, worn=""):
    """A buoy on three equal legs; the first leads along x."""
    text = f"capstan: 1\nobstacles: {{bed: {{plane: {{point: [0, 0, -30]}}, friction: {friction}}}}}\n"
    text += "bodies:\n  buoy: {free: [0, 0, 0], weight: 4e4, buoyancy: 1.2e5, hydrostatics: {z: 3e4, rx: 1e6, ry: 1e6, rz: 1e6}}\n"
    points, ropes = "points:\n", "lines:\n"
    for k in range(3):
        x, y = math.cos(2 * math.pi * k / 3), math.sin(2 * math.pi * k / 3)
        points += f"  anchor{k}: {{held: [{80 * x}, {80 * y}, -30]}}\n  eye{k}: {{body: buoy, at: [{2 * x}, {2 * y}, 0]}}\n"
        ropes += f"  leg{k}: {{length: 92, elements: 60, weight: 200, stiffness: 1e6, start: static{worn if k == 1 else ''},\n"
        ropes += f"    ends: {{A: {{point: anchor{k}}}, B: {{point: eye{k}}}}}}}\n"
    return text + points + ropes + history


def missing_and_let_go(folder):
    """Without friction the mooring without a leg is the same whether the leg was never there (`capstan offset --broken`), is let go by the
    history, or parts: places to 1e-6 m, of what a balance to 1e-8 of the largest force leaves on a stiffness of about 1e4 N/m."""
    scene = os.path.join(folder, "scene.yaml")

    def write(text):
        with open(scene, "w", encoding="utf-8") as file:
            file.write(text)
    write(mooring(0, ""))
    run("offset", scene, "-o", os.path.join(folder, "offset"), "--headings", "0", "--to", "0.1", "--steps", "1", "--broken", "-q")
    missing = rows_of(os.path.join(folder, "offset", "broken.csv"))[2]
    check("missing", missing["missing"] == "leg1", missing)
    share = ", break_at: 1"
    for name, text in (("released", mooring(0, "history:\n  - {name: go, leg1.B: {release: true}}\n")), ("parted", mooring(0, "", share))):
        write(text)
        out = os.path.join(folder, name)
        # with a break_at of next to nothing the leg parts at its other end too, and lies on the bed
        run("run", scene, "-o", out, "-q")
        body = rows_of(os.path.join(out, "bodies.csv"))[-1]
        for axis in "xyz":
            check(f"{name}, {axis}", abs(float(body[axis]) - float(missing[axis])) < 1e-6, (body[axis], missing[axis]))
        last = rows_of(os.path.join(out, "history.csv"))[-1]
        most = max(float(last[f"leg{k}.{end}.tension"]) for k in (0, 2) for end in "AB")
        check(f"{name}, tension", abs(most - float(missing["tension"])) < 1e-6 * most, (most, missing["tension"]))
        done = subprocess.run([CHECKER, os.path.join(out, "result.nc"), scene], capture_output=True, text=True)
        check(f"checker, {name}", done.returncode == 0, done.stdout + done.stderr)


def falls_in_a_heap(folder):
    """A leg below a clump parts and falls with it straight onto the bed, where all its nodes are at one place: it has neither tension nor
    moments, and rounding of the gaps of its contacts is all that is left of its energies."""
    scene, out = os.path.join(folder, "heap.yaml"), os.path.join(folder, "heap")
    with open(scene, "w", encoding="utf-8") as file:
        file.write("""capstan: 1
obstacles: {bed: {plane: {point: [0, 0, -20]}, friction: 0.4}}
points: {ring: {free: [0, 0, -2], weight: 98.1}, clump: {free: [0, 0, -4], weight: 29.43}}
lines:
  upper: {length: 2, mass: 1, stiffness: 1e5, elements: 4, start: static, ends: {A: {held: [0, 0, 0]}, B: {point: ring}}}
  lower: {length: 2, mass: 1, stiffness: 1e5, elements: 4, break_at: 60, start: static, ends: {A: {point: ring}, B: {point: clump}}}
history: [{name: pull, clump.point: {force: [0, 0, -40]}, steps: 4}]
""")
    run("run", scene, "-o", out, "-q")
    check("heap", rows_of(os.path.join(out, "points.csv"))[-1]["z"] == "-20", rows_of(os.path.join(out, "points.csv"))[-1]["z"])
    done = subprocess.run([CHECKER, os.path.join(out, "result.nc"), scene], capture_output=True, text=True)
    check("checker, heap", done.returncode == 0, done.stdout + done.stderr)


with tempfile.TemporaryDirectory() as directory:
    falls_in_a_heap(directory)
    the_files_agree(directory)
    killed_and_resumed(directory)
    missing_and_let_go(directory)
print("\n".join(faults[:20]) or "failure: table, history.csv, summary.json, result.nc, pictures and checker agree; kills and missing lines too")
sys.exit(1 if faults else 0)
