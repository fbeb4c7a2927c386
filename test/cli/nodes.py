# SPDX-License-Identifier: BSD-3-Clause
"""Starts from given nodes: a history that is broken off and continued from its data, slack that is laid out and gone on from, bounds of
friction of one's own, and what is refused.

usage: nodes.py CAPSTAN CHECKER EXAMPLES ROOT"""
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER, EXAMPLES, ROOT = sys.argv[1:]
sys.path.insert(0, os.path.join(ROOT, "test", "property"))
sys.dont_write_bytecode = True
from checks import expect, faults, write  # noqa: E402
from result_file import Results  # noqa: E402


def capstan(*arguments):
    return subprocess.run([CAPSTAN, *arguments], capture_output=True, text=True, timeout=120)


def written(scene):
    return json.dumps(scene, indent=1).replace('".inf"', ".inf")


def run(scene, name):
    """The results of a scene that has to be certified, and that the checker has to accept."""
    write(name + ".yaml", written(scene))
    done = capstan("run", name + ".yaml", "-o", name, "--no-paraview")
    expect(f"{name}: certified", done.returncode == 0, done.stdout + done.stderr)
    if done.returncode > 1:
        sys.exit("\n".join(faults))
    seen = subprocess.run([CHECKER, os.path.join(name, "result.nc"), name + ".yaml"], capture_output=True, text=True, timeout=120)
    expect(f"{name}: accepted by the checker", seen.returncode == 0, seen.stdout + seen.stderr)
    return Results(os.path.join(name, "result.nc"))


def vectors(numbers):
    return list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))


def table(columns):
    """CSV of columns given as {name: values}; what belongs to elements begins at the second row."""
    rows = len(columns["x"])
    cells = {name: ([""] if len(values) < rows else []) + [repr(v) for v in values] for name, values in columns.items()}
    return "\n".join([",".join(cells)] + [",".join(cells[name][j] for name in cells) for j in range(rows)]) + "\n"


def nodes_of(results, line, step, *more):
    x = vectors(results.get(line + "_position", step))
    columns = {"x": [p[0] for p in x], "y": [p[1] for p in x], "z": [p[2] for p in x]}
    for name in more:
        values = results.get(f"{line}_{name}", 0 if name == "arc_length" else step)
        columns[name] = list(values)[:len(x)]
    return columns


def rope(start, ends, **more):
    line = {"length": 2, "weight": 5, "stiffness": 50, "start": start, "ends": ends}
    line.update(more)
    return line


BED = {"plane": {"normal": [0, 0, 1]}, "friction": 0.4}
STRAIGHT = {"straight": {"from": [0, 0, 0], "to": [2, 0, 0]}}


# ---- a history broken off: data and memory are the same ----

def end_after(scene, results, entry, end):
    """What is imposed on the end once an entry of the history is through."""
    now = scene["lines"]["rope"]["ends"][end]
    for stage in scene["history"][:entry + 1]:
        now = stage.get("rope." + end, now)
    if "force" in now:
        return now
    x = vectors(results.get("rope_position", entry))
    return {"held": list(x[0 if end == "A" else -1])}


def go_on(name, scene, entry, columns=("tension", "reaction", "arc_length")):
    whole = run(scene, name)
    write(name + ".csv", table(nodes_of(whole, "rope", entry, *columns)))
    rest = json.loads(json.dumps(scene))
    line = rest["lines"]["rope"]
    line["start"] = {"nodes": name + ".csv"}
    line["ends"] = {end: end_after(scene, whole, entry, end) for end in "AB"}
    if "arc_length" in columns:
        line.pop("elements", None)
    rest["history"] = scene["history"][entry + 1:]
    second = run(rest, name + "-on")
    force = max(map(abs, whole.get("rope_tension", whole.steps - 1)))
    for k in range(entry + 1, whole.steps):
        here, there = (r.get("rope_position", s) for r, s in ((whole, k), (second, k - entry - 1)))
        # the same problem from the same data, but for the rounding of abscissae. The loop ends at a gap of 1e-13, which is of second order in
        # places and tensions: 3e-7 of each in a step, and this is up to three steps later
        apart = max(map(abs, (a - b for a, b in zip(here, there)))) / line["length"]
        expect(f"{name}: step {k} continues the history", apart < 1e-5, apart)
        here, there = (r.get("rope_tension", s) for r, s in ((whole, k), (second, k - entry - 1)))
        apart = max(map(abs, (a - b for a, b in zip(here, there)))) / max(force, 1)
        expect(f"{name}: tensions of step {k} continue the history", apart < 1e-5, apart)


def broken_off():
    free = {"A": {"held": [0, 0, 0]}, "B": {"force": [0, 0, 0]}}
    history = [{"rope.B": {"force": [2, 3, 1]}}, {"rope.B": {"force": [0, 2, 4]}}, {"rope.B": {"force": [-1, 1, 0]}}, {"rope.B": {"force": [1, -3, 0]}}]
    graded = [0.05] * 4 + [[20, 1.2]] + [0.1] * 6
    for law in ("frozen", "consistent"):
        scene = {"capstan": 1, "friction_policy": law, "obstacles": {"bed": BED}, "lines": {"rope": rope(STRAIGHT, free, elements=graded)}, "history": history}
        for entry in range(3):
            go_on(f"{law}-{entry}", scene, entry)
        scene["lines"]["rope"]["friction_zones"] = [{"from": 0.3, "to": 1.1, "factor": 0}, {"from": 1.2, "to": 1.9, "factor": 3}]
        go_on(law + "-zones", scene, 1)
        scene["lines"]["rope"]["stiffness"] = ".inf"
        go_on(law + "-inextensible", scene, 1)
        # an end that is held on the bed, then let go: its half element has friction from then on
        held = [{"rope.B": {"position": [1.5, 0.8, 0]}}, {"rope.B": {"position": [1.2, 1, 0]}}, {"rope.B": {"force": [0, 1, 0]}}]
        scene = {"capstan": 1, "friction_policy": law, "obstacles": {"bed": BED}, "lines": {"rope": rope(STRAIGHT, free, elements=30)}, "history": held}
        go_on(law + "-held", scene, 0)
        # over a drum, where the reaction is the tension's
        drum = {"drum": {"cylinder": {"point": [1, 0, -0.5], "axis": [0, 1, 0], "radius": 0.5}, "friction": 0.3}}
        line = rope({"arc": {"from": [0.5, 0, -0.5], "centre": [1, 0, -0.5], "axis": [0, 1, 0]}}, {"A": {"held": [0.5, 0, -0.5]}, "B": {"force": [0, 0, -3]}},
                    length=math.pi / 2, elements=40, weight=1)
        scene = {"capstan": 1, "friction_policy": law, "obstacles": drum, "lines": {"rope": line},
                 "history": [{"rope.B": {"force": [0, 0, -4]}}, {"rope.B": {"force": [0, 0.5, -5.4]}}]}
        go_on(law + "-drum", scene, 0)
    # bounds A = mu R in place of R: the zones' factor is in them
    whole = run({**scene, "friction_policy": "frozen"}, "bounds")
    columns = nodes_of(whole, "rope", 0, "reaction")
    columns["friction_bound"] = [0.3 * r for r in columns.pop("reaction")]
    write("bounds.csv", table(columns))
    rest = {**scene, "friction_policy": "frozen", "history": scene["history"][1:]}
    rest["lines"] = {"rope": {**line, "start": {"nodes": "bounds.csv"}, "ends": {"A": "held", "B": {"force": [0, 0, -4]}}}}
    second = run(rest, "bounds-on")
    apart = max(abs(a - b) for a, b in zip(whole.get("rope_position", 1), second.get("rope_position", 0)))
    expect("bounds A_R continue the history as reactions do", apart < 1e-6, apart)


# ---- slack laid out ----

SHIFT = 5e6


def moved(text):
    return re.sub(r"((?:from|to|held): )\[([^,]*),", lambda m: f"{m[1]}[{float(m[2]) + SHIFT!r},", text)


def far_out(text, rest, here):
    write("far.yaml", moved(text))
    done = capstan("study", "far.yaml", "--step", "Y4", "--complete", "straight", "-o", "far-laid")
    expect("far: laid out", done.returncode == 0, done.stderr)
    os.replace(os.path.join("far-laid", "completed.csv"), "far-from.csv")
    done = capstan("study", "far.yaml", "--step", "Y4", "--judge", "far-from.csv")
    expect("far: judged", "inside the obstacle                  0 m" in done.stdout and "a held end" not in done.stdout, done.stdout + done.stderr)
    with open("far-from.csv", encoding="utf-8") as file:
        place = [[float(r[c]) for c in "xyz"] for r in list(csv.DictReader(file))[1:]]
    # coordinates of 5e6 m have 1e-9 m
    apart = max(math.dist((a[0] - SHIFT, a[1], a[2]), b) for a, b in zip(place, here))
    expect("far: in the coordinates of the scene", apart < 1e-5, apart)
    write("far-on.yaml", moved(rest).replace("from-straight.csv", "far-from.csv"))
    done = capstan("run", "far-on.yaml", "-o", "far-on")
    seen = subprocess.run([CHECKER, os.path.join("far-on", "result.nc"), "far-on.yaml"], capture_output=True, text=True, timeout=120)
    expect("far: goes on", done.returncode == 0 and seen.returncode == 0, done.stdout + done.stderr + seen.stdout)


def laid_out():
    with open(os.path.join(EXAMPLES, "souza-de-cursi-1990.yaml"), encoding="utf-8") as file:
        text = file.read()
    head, history = text.split("history:")
    for shape in ("shortest", "straight", "meander"):
        write("paper.yaml", text)
        done = capstan("study", "paper.yaml", "--step", "Y4", "--complete", shape, "-o", "laid-" + shape)
        expect(f"{shape}: laid out", done.returncode == 0, done.stderr)
        name = "from-" + shape
        os.replace(os.path.join("laid-" + shape, "completed.csv"), name + ".csv")
        with open(name + ".csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))[1:]
        done = capstan("study", "paper.yaml", "--step", "Y4", "--judge", name + ".csv")
        expect(f"{shape}: judged from the file of nodes", done.returncode == 0 and "a solution of P3.1" in done.stdout, done.stdout + done.stderr)
        # nothing is slack where it begins: |x'| >= 1 in every element
        place = [[float(r[c]) for c in "xyz"] for r in rows]
        stretch = [math.dist(a, b) / (6.28 / 800) for a, b in zip(place, place[1:])]
        expect(f"{shape}: |x'| >= 1 at the start", min(stretch) > 1 - 1e-9, min(stretch))
        scene = head.replace("{straight: {from: [0, 0, 0], to: [6.28, 0, 0]}}", "{nodes: %s.csv}" % name).replace("B: {force: [0, 0, 0]}", "B: {force: [0, 0, 0.5]}")
        scene += "history:\n  - {name: Y5, cable.B: {force: [0, 0, 0]}}\n  - {name: on, cable.B: {force: [0.5, 0.5, 0.5]}}\n"
        write(name + ".yaml", scene)
        done = capstan("run", name + ".yaml", "-o", name)
        expect(f"{shape}: goes on, certified", done.returncode == 0, done.stdout + done.stderr)
        seen = subprocess.run([CHECKER, os.path.join(name, "result.nc"), name + ".yaml"], capture_output=True, text=True, timeout=120)
        expect(f"{shape}: accepted by the checker", seen.returncode == 0, seen.stdout + seen.stderr)
        results = Results(os.path.join(name, "result.nc"))
        first = vectors(results.get("cable_reference", 0))
        expect(f"{shape}: starts from the nodes given", first == [tuple(p) for p in place])
        bound = results.get("cable_friction_bound", 0)
        wanted = [0.0255 * float(r["reaction"]) for r in rows]
        expect(f"{shape}: A is mu R_R of the step before", all(abs(a - b) <= 1e-12 for a, b in list(zip(bound, wanted))[1:]))
        # far from the origin the file has the coordinates of the scene, and is judged and gone on from there
        if shape == "straight":
            far_out(text, scene, place)
        # the end is let down where it is: the half millimetre of slack beside it apart, the rest of the line stays where it was laid
        tip = math.dist(vectors(results.get("cable_position", 0))[-1][:2], place[-1][:2])
        expect(f"{shape}: the tip comes down where it hangs", tip < 0.06, tip)


# ---- bounds of one's own ----

def own_bounds():
    """A line along x, held at A, is pulled by f: where it slides T = f - sum A to the tip, and the elongation is T/K."""
    n, length, stiffness, f, x = 20, 2.0, 50.0, 3.0, []
    bound = [0.02 + 0.01 * (j % 7) for j in range(n + 1)]
    for j in range(n + 1):
        x.append((length * j / n, 0.0, 0.0))
    columns = {"x": [p[0] for p in x], "y": [p[1] for p in x], "z": [p[2] for p in x], "friction_bound": bound}
    write("own.csv", table(columns))
    scene = {"capstan": 1, "friction_policy": "frozen", "obstacles": {"bed": BED},
             "lines": {"rope": rope({"nodes": "own.csv"}, {"A": {"held": [0, 0, 0]}, "B": {"force": [0, 0, 0]}})}, "history": [{"rope.B": {"force": [f, 0, 0]}}]}
    results = run(scene, "own")
    tension, left = [0.0] * n, f
    for e in range(n - 1, -1, -1):
        left = max(0.0, left - bound[e + 1])
        tension[e] = left
    at = 0.0
    for e in range(n):
        at += length / n * (1 + tension[e] / stiffness)
        found = vectors(results.get("rope_position", 0))[e + 1][0]
        expect(f"own bounds: node {e + 1}", abs(found - at) < 1e-7 * length, (found, at))
    # tensions of one's own: on a drum the reaction is T_R times the turn, and A = mu T_R of it
    m, angle, radius = 12, math.pi / 2, 0.5
    half = angle / m / 2
    x = [(radius * math.sin(-angle / 2 + 2 * half * j), 0.0, radius * math.cos(-angle / 2 + 2 * half * j)) for j in range(m + 1)]
    write("drum.csv", table({"x": [p[0] for p in x], "y": [p[1] for p in x], "z": [p[2] for p in x], "tension": [7.0] * m}))
    pull = [7 * c for c in (math.cos(angle / 2 - half), 0, -math.sin(angle / 2 - half))]
    chord = 2 * radius * math.sin(half)
    scene = {"capstan": 1, "friction_policy": "frozen", "obstacles": {"drum": {"cylinder": {"radius": radius}, "friction": 0.3}},
             "lines": {"rope": rope({"nodes": "drum.csv"}, {"A": {"force": [-pull[0], 0, pull[2]]}, "B": {"force": pull}}, length=m * chord, weight=0, stiffness=".inf")},
             "history": [{"rope.B": {"force": [1.05 * c for c in pull]}}]}
    results = run(scene, "drum")
    bound = list(results.get("rope_friction_bound", 0))[:m + 1]
    # two chords of T_R meet under the angle 2 half at a node; at an end the pull is that of the chord
    expect("T_R on a drum: A = mu T_R 2 sin(half)", all(abs(b - 0.3 * 7 * 2 * math.sin(half)) < 1e-12 for b in bound[1:-1]), bound)
    expect("T_R on a drum: A at the ends", max(bound[0], bound[-1]) < 1e-12, bound)


# ---- what is refused ----

HEAD = "x,y,z\n"
ROWS = "0,0,0\n1,0,0\n2,0,0\n"
BAD = (("the name of a file elsewhere", "../n.csv", HEAD + ROWS, 3, "scene.yaml:6:13: 'nodes': found '../n.csv', expected the name of a file beside this one"),
       ("an absolute path", "/etc/passwd", HEAD + ROWS, 3, "scene.yaml:6:13: 'nodes': found '/etc/passwd'"),
       ("two dots", "..", HEAD + ROWS, 3, "scene.yaml:6:13: 'nodes': found '..'"),
       ("no file", "other.csv", HEAD + ROWS, 4, "other.csv: cannot open"),
       ("no names", "n.csv", ROWS, 3, "n.csv:1:1: found the column '0', expected a line of names: x, y, z, arc_length (optional)"),
       ("a name that there is not", "n.csv", "x,y,z,friction\n", 3, "n.csv:1:7: found the column 'friction'"),
       ("a column twice", "n.csv", "x,y,z,x\n", 3, "n.csv:1:7: the column 'x' is given twice"),
       ("no z", "n.csv", "x,y\n0,0\n1,1\n", 3, "n.csv:1:1: the column 'z' is missing, expected a line of names: x, y, z, arc_length (optional)"),
       ("reactions and bounds", "n.csv", "x,y,z,reaction,friction_bound\n0,0,0,1,1\n2,0,0,1,1\n", 3, "n.csv:1:1: found reaction and friction_bound, expected one of them"),
       ("a text", "n.csv", HEAD + "0,0,0\n1,a,0\n2,0,0\n", 3, "n.csv:3:3: y: found 'a', expected a number in m"),
       ("a cell too few", "n.csv", HEAD + "0,0,0\n1,0\n2,0,0\n", 3, "n.csv:3:1: found 2 cells, expected 3"),
       ("a cell too many", "n.csv", HEAD + "0,0,0\n1,0,0,0\n2,0,0\n", 3, "n.csv:3:1: found more than 3 cells, expected 3"),
       ("not a number", "n.csv", HEAD + "0,0,0\n1,.nan,0\n2,0,0\n", 3, "n.csv:3:3: y: found '.nan'"),
       ("one node", "n.csv", HEAD + "0,0,0\n", 3, "n.csv: found 1 nodes, expected at least 2"),
       ("a tension before the first element", "n.csv", "x,y,z,tension\n0,0,0,1\n2,0,0,1\n", 3, "n.csv:2:7: tension: found '1', expected nothing in the first row"),
       ("a negative tension", "n.csv", "x,y,z,tension\n0,0,0,\n2,0,0,-1\n", 3, "scene.yaml:6:5: line 'rope': start: the tension of element 0 is -1 N"),
       ("an arc length that falls", "n.csv", "arc_length,x,y,z\n0,0,0,0\n1,1,0,0\n1,2,0,0\n", 3, "n.csv:4:1: arc_length of node 2 is 1 m, expected more"),
       ("arc lengths of another line", "n.csv", "arc_length,x,y,z\n0,0,0,0\n1,1,0,0\n3,2,0,0\n", 3, "line 'rope': elements are 3 m long together, but length is 2 m"),
       ("too long an element", "n.csv", HEAD + "0,0,0\n1,0,0\n4,0,0\n", 3, "scene.yaml:6:5: line 'rope': start: nodes 1 and 2 are 3 m apart, the element between them is 1 m long"),
       ("below the bed", "n.csv", HEAD + "0,0,0\n1,0,-0.1\n2,0,0\n", 3, "scene.yaml:6:5: line 'rope': start: node 1 lies 0.1 m below obstacle 'bed'"),
       ("a reaction in the air", "n.csv", "x,y,z,reaction\n0,0,0,1\n1,0,0.1,1\n2,0,0,1\n", 3, "start: the reaction of node 1 is 1 N, but it touches no obstacle"),
       ("a bound in the air", "n.csv", "x,y,z,friction_bound\n0,0,0,1\n1,0,0.1,1\n2,0,0,1\n", 3, "start: the friction bound of node 1 is 1 N, but it touches no obstacle"))


def refused():
    text = ("capstan: 1\nobstacles: {bed: {plane: {}, friction: 0.5}}\nlines:\n  rope:\n    length: 2\n    start: {nodes: %s}\n    weight: 1\n    stiffness: 10\n"
            "    ends: {A: held, B: free}\n")
    for what, name, rows, code, words in BAD:
        write("n.csv", rows)
        write("scene.yaml", text % name)
        done = capstan("check", "scene.yaml")
        expect(what, done.returncode == code and words in done.stderr and done.stderr.count("\n") == 1, (done.returncode, done.stderr))
    write("n.csv", HEAD + ROWS)
    write("scene.yaml", (text % "n.csv").replace("length: 2\n", "length: 2\n    elements: 4\n"))
    done = capstan("check", "scene.yaml")
    expect("elements of another number", "scene.yaml:6:5: 'elements': found 4, expected 2" in done.stderr, done.stderr)
    write("n.csv", "x,y,z,friction_bound\n0,0,0,1\n1,0,0,1\n2,0,0,1\n")
    write("scene.yaml", (text % "n.csv").replace("friction: 0.5", "friction: 0"))
    done = capstan("check", "scene.yaml")
    expect("a bound without friction", "the friction bound of node 0 is 1 N, but obstacle 'bed' has no friction there" in done.stderr, done.stderr)
    os.symlink("n.csv", "link.csv")
    write("scene.yaml", text % "link.csv")
    done = capstan("check", "scene.yaml")
    expect("a link", done.returncode == 4 and "symbolic link" in done.stderr, done.stderr)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    broken_off()
    laid_out()
    own_bounds()
    refused()

print("\n".join(faults) or "nodes: histories go on from data, and what is no data is refused")
sys.exit(1 if faults else 0)
