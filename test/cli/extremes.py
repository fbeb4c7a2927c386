# SPDX-License-Identifier: BSD-3-Clause
"""Uplift, angles and extremes of a run: history.csv and summary.json say the same, the extremes are those of the rows, the table
prints them, a resumed run gives the same, and steps that are not certified do not count.    usage: extremes.py CAPSTAN ROOT"""
import csv
import json
import math
import os
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
                # the line's force on what holds it is the opposite of the force on the line
                force = [-f for f in entry[end]["force_N"]]
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


def summary_size(summary):
    return max(abs(entry[end]["tension_N"]["greatest"]) for entry in summary["extremes"].values() for end in "AB")


with tempfile.TemporaryDirectory() as folder:
    for name in ("chain-wire-chain", "oc3-hywind-line", "lay-curve", "bollard"):
        out = os.path.join(folder, name)
        done = run(os.path.join(ROOT, "examples", name + ".yaml"), out)
        if done.returncode != 0:
            faults.append(f"{name}: exit {done.returncode}: {done.stderr[-200:]}")
            continue
        check_table(name, done.stdout, *compare(name, out, (0, 0, 1)))

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
