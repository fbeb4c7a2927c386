# SPDX-License-Identifier: BSD-3-Clause
"""Uplift, angles and extremes of a run: history.csv and summary.json say the same, the extremes are those of the rows, the table
prints them, a resumed run gives the same, and steps that are not certified do not count.    usage: extremes.py CAPSTAN ROOT"""
import csv
import json
import math
import os
import re
import signal
import subprocess
import sys
import tempfile

CAPSTAN, ROOT = sys.argv[1:]
END = {"tension": "tension_N", "uplift": "uplift_N", "angle": "angle_rad", "suspended": "suspended_m"}
LINE = {"grounded": "grounded_m", "slipping": "slipping_m", "slack": "slack_m", "sweep": "sweep_m", "utilisation": "utilisation"}
AXES = "xyz"
faults = []


def run(scene, out, *more):
    return subprocess.run([CAPSTAN, "run", scene, "-o", out, "--no-paraview", *more], capture_output=True, text=True, timeout=120)


def read(out):
    with open(os.path.join(out, "history.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))[1:]
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return rows, json.load(file)


def expected(rows, column):
    """The extremes of a column over the certified steps, from the table alone."""
    values = [(float(row[column]), i) for i, row in enumerate(rows) if row["outcome"] in ("solved", "taut") and row[column]]
    if not values:
        return None
    least, greatest = min(v for v, _ in values), max(v for v, _ in values)
    return {"least": least, "least_step": min(i for v, i in values if v == least),
            "greatest": greatest, "greatest_step": min(i for v, i in values if v == greatest)}


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def less_ground(pull, place, step):
    """A pull on a held point that lies on an obstacle: what presses on that is borne there, of several ends in the proportion in which they press."""
    for point in step.get("points", {}).values():
        if point["position_m"] != place or point["state"] != "held" or not point.get("reaction_N"):
            continue
        normal = point["normal"]
        pressed = [max(0, dot(line[end]["force_N"], normal)) for line in step["lines"].values() for end in "AB" if line[end]["position_m"] == place]
        if abs(sum(pressed) - point["reaction_N"]) > 1e-9 * sum(pressed) + 1e-6 and len(pressed) == 1:
            faults.append(f"an anchor's reaction is {point['reaction_N']}, pressed by {pressed}")
        borne = point["reaction_N"] / sum(pressed) * min(0, dot(pull, normal))
        return [p - borne * n for p, n in zip(pull, normal)]
    return pull


def check_ends(name, text, rows, summary):
    """The table of the ends has the numbers of history.csv, and says where a line lies and where it touches nothing."""
    if "touchdown from B" not in text:
        faults.append(f"{name}: no table of the ends")
        return
    step, seen = "", 0
    for row in text[text.index("touchdown from B"):].split("\n\n")[0].splitlines()[2:]:
        step, line = row[:18].strip() or step, row[19:29].strip()
        values = next(r for r in rows if r["name"][:18] == step)
        line = next(full for full in summary["extremes"] if full[:10] == line)
        force = 1e-9 * max(float(values[f"{line}.{end}.tension"]) for end in "AB")
        for k, end in enumerate("AB"):
            angle, uplift = float(row[29 + 23 * k:39 + 23 * k]), float(row[39 + 23 * k:52 + 23 * k])
            if abs(uplift - float(values[f"{line}.{end}.uplift"])) > 1e-5 * abs(uplift) + 10 * force:
                faults.append(f"{name}: {step}, {line}.{end}: uplift {uplift} in the table")
            if uplift and abs(math.radians(angle) - float(values[f"{line}.{end}.angle"])) > 1e-3 * abs(math.radians(angle)):
                faults.append(f"{name}: {step}, {line}.{end}: angle {angle} in the table")
            words = row[93 + 31 * k:124 + 31 * k].strip() if k == 0 else row[124:].strip()
            place = [values[f"{line}.{end}.touchdown_{axis}"] for axis in AXES]
            if place[0] == "":
                expected_words = "-"
            elif float(values[f"{line}.{end}.suspended"]) == 0:
                expected_words = "lies there"
            else:
                expected_words = None
                if any(abs(float(a) - float(b)) > 1e-5 * abs(float(b)) + 1e-8 * max(abs(float(c)) for c in place) for a, b in zip(words.split(","), place)):
                    faults.append(f"{name}: {step}, {line}.{end}: touchdown {words} in the table, {place}")
            if expected_words and words != expected_words:
                faults.append(f"{name}: {step}, {line}.{end}: touchdown '{words}' in the table, expected '{expected_words}'")
        sweep, use = float(row[75:86]), row[86:93].strip()
        if abs(sweep - float(values[f"{line}.sweep"])) > 1e-3 * sweep:
            faults.append(f"{name}: {step}, {line}: sweep {sweep} in the table")
        expected_use = values[f"{line}.utilisation"]
        if (use == "-") != (expected_use == "") or (expected_use and abs(float(use) - float(expected_use)) > 6e-4):
            faults.append(f"{name}: {step}, {line}: utilisation {use} in the table, {expected_use}")
        seen += 1
    if seen < len(summary["extremes"]):
        faults.append(f"{name}: the table of the ends has {seen} rows")


def compare(name, out, up):
    rows, summary = read(out)
    for line, found in summary["extremes"].items():
        for i, row in enumerate(rows):
            entry = summary["steps"][i]["lines"][line]
            for end in "AB":
                for column, key in END.items():
                    if float(row[f"{line}.{end}.{column}"]) != entry[end][key]:
                        faults.append(f"{name}: step {i}, {line}.{end}.{column} is not that of summary.json")
                at = entry[end]["touchdown_m"]
                for axis, column in enumerate(AXES):
                    cell = row[f"{line}.{end}.touchdown_{column}"]
                    if (cell == "") != (at is None) or (at and float(cell) != at[axis]):
                        faults.append(f"{name}: step {i}, {line}.{end}.touchdown_{column} is not that of summary.json")
                if (at is None) != (entry["grounded_m"] == 0):
                    faults.append(f"{name}: step {i}, {line}.{end}: touchdown {at} with {entry['grounded_m']} m on the ground")
                # the line's force on what holds it is the opposite of the force on the line, less what the ground under an anchor bears
                force = less_ground([-f for f in entry[end]["force_N"]], entry[end]["position_m"], summary["steps"][i])
                uplift = sum(f * u for f, u in zip(force, up))
                level = math.sqrt(max(0, sum(f * f for f in force) - uplift * uplift))
                if abs(uplift - entry[end]["uplift_N"]) > 1e-12 * entry[end]["tension_N"]:
                    faults.append(f"{name}: step {i}, {line}.{end}: uplift {entry[end]['uplift_N']}, expected {uplift}")
                if entry[end]["tension_N"] and abs(math.atan2(uplift, level) - entry[end]["angle_rad"]) > 1e-7:
                    faults.append(f"{name}: step {i}, {line}.{end}: angle {entry[end]['angle_rad']}")
        for end in "AB":
            for column, key in END.items():
                if found[end][key] != expected(rows, f"{line}.{end}.{column}"):
                    faults.append(f"{name}: {line}.{end} {key}: {found[end][key]}")
            for axis in AXES:
                if found[end][f"touchdown_{axis}_m"] != expected(rows, f"{line}.{end}.touchdown_{axis}"):
                    faults.append(f"{name}: {line}.{end} touchdown {axis}: {found[end][f'touchdown_{axis}_m']}")
        for column, key in LINE.items():
            if found[key] != expected(rows, f"{line}.{column}"):
                faults.append(f"{name}: {line} {key}: {found[key]}")
    return rows, summary


def check_table(name, text, rows, summary):
    """Each row of the table is the least and the greatest of its column, and no row that matters is missing."""
    unit = {"N": "_N", "m": "_m", "degrees": "_rad"}
    factor = {"N": 1, "m": 1, "degrees": 180 / math.pi}
    block = text[text.index("over all steps"):].split("\n\n")[0].splitlines()[1:]
    printed = set()
    for row in block:
        head, of, rest = row[:18].split("[")[0], row[:18].split("[")[1].split("]")[0], row[19:]
        words = head.split()
        line = next(line for line in summary["extremes"] if rest[:14].strip() == line[:14])
        entry = summary["extremes"][line]
        quantity = f"touchdown_{words[1]}" if words[0] == "touch" else words[0]
        extreme = (entry[words[-1]] if len(words) > 1 else entry)[quantity + unit[of]]
        numbers = [float(x) for x in (rest[14:27], rest[45:58])]
        for value, which in zip(numbers, ("least", "greatest")):
            if abs(value - factor[of] * extreme[which]) > 1e-5 * abs(value) + 1e-9 * summary_size(summary):
                faults.append(f"{name}: the table says {value}, summary.json {extreme[which]}: {row}")
            step = extreme[which + "_step"]
            if rows[step]["name"][:16] not in rest and "throughout" not in rest:
                faults.append(f"{name}: the table lacks the step {rows[step]['name']}: {row}")
        printed.add((line, " ".join(words)))
    for line, entry in summary["extremes"].items():
        for end in "AB":
            if entry[end]["tension_N"]["greatest"] > 0 and (line, "tension " + end) not in printed:
                faults.append(f"{name}: no row for the tension of {line}.{end}")


def check_bodies(name, text, rows, summary):
    """What the table says of bodies: at each step where they are and what the lines do to them, and the extremes of that."""
    bodies = summary.get("bodies", {})
    shown = re.findall(r"^ +body (\S+): at \(([^)]*)\) m, roll (\S+), pitch (\S+), yaw (\S+) degrees, lines pull by \(([^)]*)\) N", text, re.M)
    if len(shown) % max(1, len(bodies)) or (bodies and not shown):
        faults.append(f"{name}: {len(shown)} rows of {len(bodies)} bodies")
    if len(rows) * len(bodies) == len(shown):
        for k, (body, place, roll, pitch, yaw, pull) in enumerate(shown):
            row = rows[k // len(bodies)]
            found = [*place.split(","), roll, pitch, yaw, *pull.split(",")]
            for value, column in zip(found, ("x", "y", "z", "roll", "pitch", "yaw", "fx", "fy", "fz")):
                exact, size = float(row[f"{body}.{column}"]), max(abs(float(row[f"{body}.f{c}"])) for c in AXES) if column[0] == "f" else 1
                if abs(float(value) - exact) > 1e-3 * abs(exact) + 1.1e-9 * size:
                    faults.append(f"{name}: step {k // len(bodies)}, {body}: {column} {value} in the table, {exact}")
    heads = [m.start() for m in re.finditer("over all steps", text)]
    if len(heads) != (2 if bodies else 1):
        faults.append(f"{name}: {len(heads)} tables of extremes")
        return
    printed = set()
    for row in text[heads[1]:].split("\n\n")[0].splitlines()[1:] if bodies else []:
        quantity, unit, body = row[:18].split("[")[0].strip(), row[:18].split("[")[1].split("]")[0], row[19:33].strip()
        key = quantity.replace(" ", "_") + ("_" + unit)
        extreme = bodies[body]["extremes"][key]
        for value, which in zip((float(row[33:46]), float(row[64:77])), ("least", "greatest")):
            if abs(value - extreme[which]) > 1e-5 * abs(value) + 1e-9 * max(1, abs(extreme["least"]), abs(extreme["greatest"])):
                faults.append(f"{name}: the table says {value}, summary.json {extreme[which]}: {row}")
            if rows[extreme[which + "_step"]]["name"][:16] not in row and "throughout" not in row:
                faults.append(f"{name}: the table lacks the step {rows[extreme[which + '_step']]['name']}: {row}")
        printed.add((body, key))
    for body, entry in bodies.items():
        for key, extreme in entry["extremes"].items():
            if max(abs(extreme["least"]), abs(extreme["greatest"])) > (1e-3 if key.startswith("lines") else 1e-8) and (body, key) not in printed:
                faults.append(f"{name}: no row for {body}, {key}")


def summary_size(summary):
    return max(abs(entry[end]["tension_N"]["greatest"]) for entry in summary["extremes"].values() for end in "AB")


with tempfile.TemporaryDirectory() as folder:
    for name in ("chain-wire-chain", "oc3-hywind-line", "lay-curve", "bollard", "oc3-hywind", "barge", "parting-lines", "catenary-moored-buoy"):
        out = os.path.join(folder, name)
        done = run(os.path.join(ROOT, "examples", name + ".yaml"), out)
        if done.returncode != 0:
            faults.append(f"{name}: exit {done.returncode}: {done.stderr[-200:]}")
            continue
        numbers = compare(name, out, (0, 0, 1))
        check_table(name, done.stdout, *numbers)
        check_ends(name, done.stdout, *numbers)
        check_bodies(name, done.stdout, *numbers)

    # gravity to the side; the last step has no equilibrium, so it does not count
    scene = os.path.join(folder, "scene.yaml")
    with open(scene, "w", encoding="utf-8") as file:
        file.write("""capstan: 1
gravity: [6, 0, -8]
lines:
  rope: {length: 10, elements: 20, weight: 3, stiffness: 1e+4, start: {straight: {from: [0, 0, 0], to: [0, 10, 0]}},
    ends: {A: held, B: held}}
history:
  - {name: nearer, steps: 3, rope.B: {position: [0, 8, 0]}}
  - {name: loose, rope.A: {force: [0, 0, 0]}, rope.B: {force: [0, 0, 0]}}
""")
    done = run(scene, os.path.join(folder, "out"))
    if done.returncode != 5:
        faults.append(f"gravity to the side: exit {done.returncode}: {done.stderr}")
    rows, summary = compare("gravity to the side", os.path.join(folder, "out"), (-0.6, 0, 0.8))
    if summary["extremes"]["rope"]["A"]["tension_N"]["least_step"] >= 4:
        faults.append("a step without equilibrium counts")

    # interrupted and resumed: the same extremes as in one go
    slow, again = os.path.join(folder, "slow.yaml"), os.path.join(folder, "again")
    with open(os.path.join(ROOT, "examples", "oc3-hywind-line.yaml"), encoding="utf-8") as file:
        text = file.read()
    with open(slow, "w", encoding="utf-8") as file:
        file.write(text)
    process = subprocess.Popen([CAPSTAN, "run", slow, "-o", again, "--no-paraview", "-q"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    journal = os.path.join(again, ".journal")
    while process.poll() is None and not (os.path.exists(journal) and os.path.getsize(journal) > 200000):
        pass
    process.send_signal(signal.SIGTERM)
    if process.wait(timeout=60) == 143:
        done = run(slow, again, "--resume")
        rows, summary = compare("resumed", again, (0, 0, 1))
        check_table("resumed", done.stdout, rows, summary)
    if summary["extremes"] != read(os.path.join(folder, "oc3-hywind-line"))[1]["extremes"]:
        faults.append("the extremes of a resumed run are others")

for fault in faults[:20]:
    print(fault)
sys.exit(1 if faults else 0)
