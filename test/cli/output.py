# SPDX-License-Identifier: BSD-3-Clause
"""capstan run with less output: --no-paraview, --fields, --sync; pictures of a stage named "static".                        usage: output.py CAPSTAN"""
import csv
import os
import signal
import subprocess
import sys
import tempfile
import time

CAPSTAN = os.path.abspath(sys.argv[1])
SCENE = """capstan: 1
obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}, wall: {plane: {point: [0, -1, 0], normal: [0, 1, 0]}, friction: 0.1}}
lines:
  rope: {length: 8, elements: 40, weight: 20, stiffness: 1e5, start: {straight: {from: [0, 0, 0], to: [8, 0, 0]}}, ends: {A: held, B: held}}
history:
  - {name: move, steps: %d, rope.B: {position: [8.2, 0, 0]}}
"""
PER_STEP = ["reference", "position", "load", "normal", "contact_gap", "friction_bound", "friction_force", "reaction", "slip",
            "segment_force", "tension", "state", "obstacle"]
ALWAYS = ["arc_length", "element_length", "end_force", "end_tension", "gap", "dissipated", "outcome"]
faults = []


def check(condition, text):
    if not condition:
        faults.append(text)


def run(folder, scene, out, *more):
    return subprocess.run([CAPSTAN, "run", scene, "-o", out, *more], cwd=folder, capture_output=True, text=True, timeout=120)


def variables(path):
    """Names in the header of a classic netCDF file: a length of 4 bytes, then the name."""
    with open(path, "rb") as file:
        data = file.read()
    names = PER_STEP + [name + "_second" for name in PER_STEP] + ALWAYS
    return {name for name in names if (len("rope_" + name).to_bytes(4, "big") + ("rope_" + name).encode()) in data}


def columns_documented():
    """(name, unit) of each column of history.csv by docs/results.md, for one line called rope, no body and nothing that parts, in any order."""
    page = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs", "results.md")
    with open(page, encoding="utf-8") as file:
        section = file.read().split("\n## history.csv\n")[1].split("\n## ")[0]
    found = []
    for row in section.splitlines():
        cells = [cell.strip() for cell in row.split("|")]
        if len(cells) == 5 and cells[1].startswith("`") and "BODY" not in cells[1] and not cells[3].startswith("only in a scene"):
            for name in cells[1].replace("`", "").replace("LINE", "rope").split(", "):
                found += [(name.replace("END", end), cells[2]) for end in (("A", "B") if "END" in name else ("",))]
    return sorted(found)


def columns(folder, out):
    with open(os.path.join(folder, out, "history.csv"), newline="", encoding="utf-8") as table:
        return sorted(zip(*[row for row, _ in zip(csv.reader(table), range(2))]))


def history(folder, out):
    with open(os.path.join(folder, out, "history.csv"), newline="", encoding="utf-8") as table:
        return [{key: value for key, value in row.items() if key != "wall"} for row in csv.DictReader(table)]


with tempfile.TemporaryDirectory() as folder:
    for name, steps in (("short.yaml", 5), ("long.yaml", 400)):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(SCENE % steps)

    # everything, then less into the same directory: what ParaView would read of the earlier run is gone
    done = run(folder, "short.yaml", "out")
    check(done.returncode == 0 and "result.pvd" in done.stdout, f"whole: {done.stderr}{done.stdout}")
    check(os.path.exists(os.path.join(folder, "out", "result.pvd")), "whole: no result.pvd")
    check(variables(os.path.join(folder, "out", "result.nc")) ==
          set(PER_STEP + ALWAYS) | {name + "_second" for name in PER_STEP[3:9] + ["state", "obstacle"]},
          "whole: variables of result.nc")
    check(columns(folder, "out") == columns_documented(),
          f"history.csv and its table in docs/results.md: {sorted(set(columns(folder, 'out')) ^ set(columns_documented()))}")
    whole = history(folder, "out")
    done = run(folder, "short.yaml", "out", "--no-paraview")
    check(done.returncode == 0 and "result.pvd" not in done.stdout, f"--no-paraview: {done.stderr}{done.stdout}")
    names = os.listdir(os.path.join(folder, "out"))
    check(not any(name.endswith((".vtp", ".pvd")) for name in names), f"--no-paraview: {names}")
    check({"result.nc", "summary.json", "plan.svg"} <= set(names), f"--no-paraview: {names}")
    check(history(folder, "out") == whole, "--no-paraview: other numbers")

    for fields, wanted in (("position,tension", {"position", "tension"}), ("state,obstacle,friction_force", {"state", "obstacle", "friction_force",
                           "state_second", "obstacle_second", "friction_force_second"}), ("none", set())):
        done = run(folder, "short.yaml", "out", "--fields", fields)
        check(done.returncode == 0, f"--fields {fields}: {done.stderr}")
        found = variables(os.path.join(folder, "out", "result.nc"))
        check(found == wanted | set(ALWAYS), f"--fields {fields}: {sorted(found)}")
        check(history(folder, "out") == whole, f"--fields {fields}: other numbers")

    for more, words in ((["--fields", "postion"], ["postion", "position", "tension"]), (["--fields", "position,"], ["expected"]),
                        (["--fields", "arc_length"], ["arc_length"]), (["--sync", "never"], ["never", "step", "end"]),
                        (["--method", "regularized", "--no-paraview"], ["regularized"])):
        done = run(folder, "short.yaml", "bad", *more)
        check(done.returncode == 2, f"{more}: exit code {done.returncode}")
        check(all(word in done.stderr for word in words), f"{more}: {done.stderr}")
        check(not os.path.exists(os.path.join(folder, "bad")), f"{more}: left a directory behind")

    # a stage may be named as the step that places lines statically; its pictures show it moving as others
    sheets = {}
    for stage in ("static", "pull"):
        with open(os.path.join(folder, "one.yaml"), "w", encoding="utf-8") as file:
            file.write((SCENE % 1).replace("name: move", f"name: {stage}").replace("8.2, 0, 0", "8.2, 0.5, 0"))
        done = run(folder, "one.yaml", stage, "--no-paraview")
        check(done.returncode == 0, f"stage named {stage}: {done.stderr}")
        with open(os.path.join(folder, stage, "step-00000-plan.svg"), encoding="utf-8") as file:
            sheets[stage] = file.read().replace(stage, "NAME")
    check(sheets["static"] == sheets["pull"], "stage named static: drawn as a placement")

    # synced at the end: killed in the middle it still goes on, and ends with the same numbers
    done = run(folder, "long.yaml", "whole", "-q", "--no-paraview")
    check(done.returncode == 0, f"long: {done.stderr}")
    process = subprocess.Popen([CAPSTAN, "run", "long.yaml", "-q", "-o", "late", "--sync", "end"], cwd=folder)
    journal = os.path.join(folder, "late", ".journal")
    while process.poll() is None and not (os.path.exists(journal) and os.path.getsize(journal) > 100000):
        time.sleep(0.001)
    check(process.poll() is None, "long: over before it could be killed")
    process.send_signal(signal.SIGKILL)
    process.wait()
    check(not os.path.exists(os.path.join(folder, "late", "summary.json")), "killed: results in place")
    done = run(folder, "long.yaml", "late", "--resume", "--sync", "end", "--no-paraview")
    before = [int(line.split()[1]) for line in done.stderr.splitlines() if "were done before" in line]
    check(done.returncode == 0 and before and 0 < before[0] < 400, f"resume: {done.stderr}")
    check(history(folder, "late") == history(folder, "whole"), "resume: other numbers")
    check(not os.path.exists(journal), "resume: the journal is still there")

print("\n".join(faults) or "less output: files, fields and a run that goes on")
sys.exit(1 if faults else 0)
