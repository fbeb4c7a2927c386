#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan run on a float and a barge on four lines: bodies.csv, history.csv, summary.json, result.nc, body-stiffness.csv and the ParaView
files say the same, and forces and moments on each body balance, computed from the ends of the lines and the scene. A killed run that goes
on ends with the same bytes; bodies without a pose are told.                                                    usage: bodies.py CAPSTAN CHECKER

Written by nothing but the layout of classic netCDF files (../property/result_file.py).
"""
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as tree

from checks import expect, faults, read, write

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "property"))
sys.dont_write_bytecode = True  # nothing is left in the source folder
from result_file import Results  # noqa: E402

CAPSTAN = os.path.abspath(sys.argv[1])
TOLERANCE = 1e-8
WEIGHT, CENTRE, BUOYANCY, LIFT, WATER = 500, [0.1, 0, -2], 1500, [0, 0, 0.5], [0, 0, 90, 300, 310, 0]
THRUST, ARM = [80, 30, 0], [0, 0, 2]

# a float that heels under a push up high, on two legs with friction on the bed, and a barge that is moved and turned beside it
SCENE = f"""
capstan: 1
gravity: [0, 0, -10]
obstacles: {{bed: {{plane: {{point: [0, 0, -20]}}, friction: 0.5}}}}
bodies:
  spar: {{free: [0, 0, 0], fixed: [rz], weight: {WEIGHT}, centre_of_gravity: {CENTRE}, buoyancy: {BUOYANCY}, centre_of_buoyancy: {LIFT},
         hydrostatics: {{z: {WATER[2]}, rx: {WATER[3]}, ry: {WATER[4]}}}}}
  barge: {{held: [30, 0, 0], rotation: {{roll_pitch_yaw: [0, 0, 10]}}}}
points:
  left: {{body: spar, at: [-1, 0.2, -3]}}
  right: {{body: spar, at: [1, 0, -3]}}
  bow: {{body: barge, at: [-2, 0, 1]}}
lines:
  a: {{length: 25, elements: 30, weight: 10, stiffness: 1e5, start: static, ends: {{A: {{held: [-18, 1, -20]}}, B: {{point: left}}}}}}
  b: {{length: 25, elements: 30, weight: 10, stiffness: 1e5, start: static, ends: {{A: {{point: right}}, B: {{held: [16, 2, -20]}}}}}}
  c: {{length: 29, elements: 20, weight: 2, stiffness: 1e5, start: static, ends: {{A: {{point: right}}, B: {{point: bow}}}}}}
history:
  - {{name: push, steps: 12, spar.body: {{force: {THRUST}, arm: {ARM}}}}}
  - {{name: turn, steps: 12, barge.body: {{move: [0.5, 0.2, 0], rotation: {{roll_pitch_yaw: [5, -10, 30]}}}}}}
"""
STEPS, BODIES, LINES = 25, ["spar", "barge"], {"a": ["", "left"], "b": ["right", ""], "c": ["right", "bow"]}
PLACES = {"left": (0, [-1, 0.2, -3]), "right": (0, [1, 0, -3]), "bow": (1, [-2, 0, 1])}
POINTS = list(PLACES)
SIX = ["x", "y", "z", "mx", "my", "mz"]
DIRECTIONS = ["x", "y", "z", "rx", "ry", "rz"]

# nothing holds it
TWISTED = """
capstan: 1
bodies: {stone: {free: [0, 0, -10], weight: 50}}
points: {hook: {held: [0, 0, 0]}, eye: {body: stone}}
lines:
  string: {length: 10, elements: 4, weight: 1, stiffness: 1e6, start: {straight: {from: [0, 0, 0], to: [0, 0, -10]}}, ends: {A: {point: hook}, B: {point: eye}}}
history: [{name: twist, stone.body: {moment: [0, 0, 3]}}]
"""
# ... by a second string the moment about the vertical through the hook is not one about a point of the stone
TWO_STRINGS = TWISTED.replace("eye: {body: stone}", "eye: {body: stone}, ear: {body: stone, at: [0, 0, -0.1]}").replace("history:", """  other: {length: 10.1, elements: 4, weight: 1, stiffness: 1e6, start: {straight: {from: [0, 0, 0], to: [0, 0, -10.1]}}, ends: {A: {point: hook}, B: {point: ear}}}
history:""")
TWO_GROUPS = """
capstan: 1
bodies: {stone: {held: [9, 9, 9]}}
points:
  eye: {body: stone}
  h: {held: [0, 0, 0]}
  g: {held: [20, 0, 0]}
  f: {free: [5, 0, 0], force: [50, 0, 0]}
  k: {free: [5, 5, 0], weight: 10}
lines:
  l: {length: 9, elements: 1, weight: 0, stiffness: .inf, start: static, ends: {A: {point: h}, B: {point: f}}}
  m: {length: 10, elements: 1, weight: 0, stiffness: .inf, start: static, ends: {A: {point: f}, B: {point: g}}}
  n: {length: 9, elements: 1, weight: 0, stiffness: .inf, start: static, ends: {A: {point: h}, B: {point: k}}}
  o: {length: 20, elements: 2, weight: 1, stiffness: 1e6, start: static, ends: {A: {point: eye}, B: {held: [0, 0, 9]}}}
"""
FALLING = """
capstan: 1
bodies: {stone: {free: [0, 0, 0], weight: 5}}
points: {eye: {body: stone}}
lines:
  tail: {length: 10, elements: 4, weight: 1, stiffness: 1e6, start: {straight: {from: [0, 0, 0], to: [10, 0, 0]}}, ends: {A: {point: eye}, B: free}}
history: [{name: fall, stone.body: {force: [1, 0, 0]}}]
"""
PLAIN = """
capstan: 1
lines:
  stray: {length: 12, elements: 4, weight: 30, stiffness: 1e7, start: static, ends: {A: {held: [0, 0, 9]}, B: {held: [8, 0, 9]}}}
"""


def run(*arguments, code=0):
    done = subprocess.run([CAPSTAN, "run", *arguments], capture_output=True, text=True, timeout=120, check=False)
    expect(f"run {arguments}", done.returncode == code, f"exit {done.returncode}: {done.stderr}")
    return done


def table(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return rows[0], rows[1:]


def size(a):
    return sum(x*x for x in a)**0.5


def cross(a, b):
    return [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]]


def product(a, b):
    return [[sum(a[i][k]*b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def turn(q, v):
    """v turned by a quaternion, by its angle about its axis (Rodrigues)."""
    sine = size(q[1:])
    if sine == 0:
        return list(v)
    axis, angle = [x/sine for x in q[1:]], 2*math.atan2(sine, q[0])
    along = sum(a*b for a, b in zip(axis, v))
    across = cross(axis, v)
    return [math.cos(angle)*v[i] + math.sin(angle)*across[i] + (1 - math.cos(angle))*along*axis[i] for i in range(3)]


def by_angles(roll, pitch, yaw):
    """The matrix of yaw about z, then pitch about the new y, then roll about the new x, in degrees."""
    c, s = zip(*((math.cos(math.radians(a)), math.sin(math.radians(a))) for a in (roll, pitch, yaw)))
    about_x = [[1, 0, 0], [0, c[0], -s[0]], [0, s[0], c[0]]]
    about_y = [[c[1], 0, s[1]], [0, 1, 0], [-s[1], 0, c[1]]]
    about_z = [[c[2], -s[2], 0], [s[2], c[2], 0], [0, 0, 1]]
    return product(about_z, product(about_y, about_x))


def of_body(results, name, step, k, n):
    if n == 6:
        return of_body(results, name, step, k, 3) + of_body(results, f"{name}_moment", step, k, 3)
    if n == 36:
        block = {part: of_body(results, f"{name}_{part}", step, k, 9) for part in ("xx", "xr", "rx", "rr")}
        return [x for i in range(6) for part in ("xr"[i//3] + "x", "xr"[i//3] + "r") for x in block[part][3*(i % 3):3*(i % 3) + 3]]
    return list(results.get(f"{name}_of_body", step)[n*k:n*k + n])


def csv_is_result(folder, results):
    """Every number of bodies.csv has the same bits in result.nc, and in history.csv where that has it."""
    units, rows = table(os.path.join(folder, "bodies.csv"))
    _, history = table(os.path.join(folder, "history.csv"))
    expect("units", [units[k] for k in ("x", "qw", "roll", "heel", "lines_x", "lines_mx", "trials")] == ["m", "1", "degree", "degree", "N", "N m", "1"], units)
    expect("rows", len(rows) == STEPS*len(BODIES) and results.steps == STEPS, len(rows))
    expect("names", results.attributes["bodies"] == " ".join(BODIES), results.attributes)
    for i, row in enumerate(rows):
        step, k = divmod(i, len(BODIES))
        what = f"step {step}, body {BODIES[k]}"
        expect(what, int(row["step"]) == step and row["body"] == BODIES[k] and row["kind"] == ("free", "held")[k], row)
        expect(f"{what}, position", [float(row[a]) for a in "xyz"] == of_body(results, "position", step, k, 3), row)
        q = [float(row[f"q{a}"]) for a in "wxyz"]
        expect(f"{what}, rotation", q == of_body(results, "rotation", step, k, 4), q)
        for name in ("lines", "load", "support", "residual"):
            expect(f"{what}, {name}", [float(row[f"{name}_{a}"]) for a in SIX] == of_body(results, name, step, k, 6), row)
        for name in ("trials", "has_place", "stable"):
            expect(f"{what}, {name}", int(row[name]) == results.get(f"{name}_of_body", step)[k], row)
        angles = [float(row[a]) for a in ("roll", "pitch", "yaw")]
        matrix = by_angles(*angles)
        for axis in range(3):
            turned = turn(q, [float(axis == a) for a in range(3)])
            expect(f"{what}, angles", size([matrix[a][axis] - turned[a] for a in range(3)]) <= 1e-14, (angles, q))
        heel = math.degrees(math.acos(min(1, turn(q, [0, 0, 1])[2])))
        expect(f"{what}, heel", abs(float(row["heel"]) - heel) <= 1e-6, (row["heel"], heel))
        line = history[step]
        for name, column in [("x", "x"), ("roll", "roll"), ("pitch", "pitch"), ("yaw", "yaw"), ("heel", "heel"), ("fx", "lines_x"), ("mz", "lines_mz")]:
            expect(f"{what}, history", line[f"{BODIES[k]}.{name}"] == row[column], (name, line))
    return rows


def forces_balance(results):
    """Places, forces and moments on the bodies, from the poses, the lines' ends and the scene."""
    for step in range(STEPS):
        largest = max(results.get(f"{line}_largest_force", step)[0] for line in LINES)
        part = min(step, 12)/12
        for k, name in enumerate(BODIES):
            what = f"step {step}, body {name}"
            place, q = of_body(results, "position", step, k, 3), of_body(results, "rotation", step, k, 4)
            lines, load = [0]*6, [0]*6
            for line, ties in LINES.items():
                for end, tie in enumerate(ties):
                    if not tie or PLACES[tie][0] != k:
                        continue
                    arm = turn(q, PLACES[tie][1])
                    nodes = results.get(f"{line}_position", step)
                    node = nodes[:3] if end == 0 else nodes[-3:]
                    expect(f"{what}, end of {line}", size([a - b - c for a, b, c in zip(node, place, arm)]) <= 1e-12*50, list(node))
                    pull = [-x for x in results.get(f"{line}_end_force", step)[3*end:3*end + 3]]
                    lines = [a + b for a, b in zip(lines, pull + cross(arm, pull))]
            expect(f"{what}, lines", size([a - b for a, b in zip(lines, of_body(results, "lines", step, k, 6))]) <= 1e-10*largest, lines)
            if k == 0:
                thrust = [part*x for x in THRUST]
                for force, arm in [([0, 0, -WEIGHT], turn(q, CENTRE)), ([0, 0, BUOYANCY], turn(q, LIFT)), (thrust, ARM)]:
                    load = [a + b for a, b in zip(load, force + cross(arm, force))]
                load[2] -= WATER[2]*place[2]
                # the water's moment at the rotation vector v has v.m = -v.(C v): that of the energy v'Cv/2 along v
                sine = size(q[1:])
                angle = 2*math.atan2(sine, q[0])
                v = [x*angle/sine for x in q[1:]] if sine > 0 else [0, 0, 0]
                water = [a - b for a, b in zip(of_body(results, "load", step, k, 6)[3:], load[3:])]
                work = sum(a*b for a, b in zip(v, water)) + sum(c*x*x for c, x in zip(WATER[3:], v))
                expect(f"{what}, moment of the water", abs(work) <= 1e-10*(1 + largest), work)
                expect(f"{what}, load", size([a - b for a, b in zip(load[:3], of_body(results, "load", step, k, 6))]) <= 1e-10*largest, load)
                residual = [a + b for a, b in zip(lines, of_body(results, "load", step, k, 6))]
                expect(f"{what}, balance", size(residual[:3]) <= 100*TOLERANCE*largest and size(residual[3:5]) <= 100*TOLERANCE*largest*3.2, residual)
                expect(f"{what}, stable", results.get("stable_of_body", step)[k] == 1 and results.get("has_place_of_body", step)[k] == 1)
            else:
                share = max(0, step - 12)/12
                expect(f"{what}, place", size([a - b for a, b in zip(place, [30 + 0.5*share, 0.2*share, 0])]) <= 1e-12*30, place)
                support = of_body(results, "support", step, k, 6)
                expect(f"{what}, support", size([a + b for a, b in zip(support, lines)]) <= 1e-10*largest, support)
    heels = [math.degrees(2*math.asin(size(of_body(results, "rotation", step, 0, 4)[1:]))) for step in range(STEPS)]
    expect("what the test has seen", max(heels) > 3, max(heels))


def stiffness_is_result(folder, results):
    """The stiffness of the step is that of the report, with its units; that of a small cycle is no less along x."""
    units, rows = table(os.path.join(folder, "body-stiffness.csv"))
    expect("units of stiffness", (units["x_x"], units["x_rx"], units["rx_x"], units["rz_rz"]) == ("N/m", "N", "N", "N m"), units)
    expect("rows of stiffness", len(rows) == 2*STEPS*len(BODIES), len(rows))
    found = 0
    for i, row in enumerate(rows):
        step, k, kind = i//4, i//2 % 2, i % 2
        expect("row of stiffness", (row["step"], row["body"], row["kind"]) == (str(step), BODIES[k], ("step", "stick")[kind]), row)
        if k == 1 or kind == 1 or row["outcome"] != "found":
            continue
        found += 1
        matrix = [float(row[f"{a}_{b}"]) for a in DIRECTIONS for b in DIRECTIONS]
        known = of_body(results, "stiffness", step, k, 36)
        expect(f"stiffness of step {step}", max(abs(a - b) for a, b in zip(matrix, known)) <= 1e-8*max(map(abs, known)), (matrix, known))
    expect("stiffness that is found", found >= STEPS//2, found)


def summary_is_result(folder, rows):
    summary = json.loads(read(os.path.join(folder, "summary.json")))
    expect("bodies of the summary", list(summary["bodies"]) == BODIES, summary["bodies"])
    keys = {"x_m": "x", "y_m": "y", "z_m": "z", "roll_degrees": "roll", "pitch_degrees": "pitch", "yaw_degrees": "yaw", "heel_degrees": "heel",
            "lines_x_N": "lines_x", "lines_y_N": "lines_y", "lines_z_N": "lines_z"}
    for k, name in enumerate(BODIES):
        own, of = rows[k::len(BODIES)], summary["bodies"][name]
        expect(f"summary of {name}", of["kind"] == ("free", "held")[k] and of["weight_N"] == (WEIGHT, 0)[k] and of["buoyancy_N"] == (BUOYANCY, 0)[k]
              and of["steps_without_place"] == 0 and of["steps_not_stable"] == 0, of)
        expect(f"extremes of {name}", set(of["extremes"]) == set(keys), of["extremes"])
        for key, column in keys.items():
            values = [float(row[column]) for row in own]
            extreme = of["extremes"][key]
            expect(f"{key} of {name}", (extreme["least"], extreme["greatest"]) == (min(values), max(values))
                  and extreme["least_step"] == values.index(min(values)) and extreme["greatest_step"] == values.index(max(values)), extreme)
        worst = max(size([float(row[f"residual_{a}"]) for a in "xyz"]) for row in own)
        expect(f"residual of {name}", abs(of["largest_residual_N"] - worst) <= 1e-14*worst, of)
        for step, row in enumerate(own):
            entry = summary["steps"][step]["bodies"][name]
            expect(f"summary, step {step}, {name}", entry["position_m"] == [float(row[a]) for a in "xyz"]
                  and entry["quaternion"] == [float(row[f"q{a}"]) for a in "wxyz"] and entry["heel_degrees"] == float(row["heel"])
                  and entry["lines_N"] + entry["lines_Nm"] == [float(row[f"lines_{a}"]) for a in SIX]
                  and entry["support_Nm"] == [float(row[f"support_{a}"]) for a in SIX[3:]]
                  and entry["has_place"] is True and entry["stable"] is True and entry["state"] == row["kind"], entry)
        expect("points of bodies", summary["points"]["bow"]["body"] == "barge" and summary["points"]["bow"]["kind"] == "on_body")


def paraview(folder, results):
    """Points, reference points and axes of one step, and the list of steps."""
    step = 12
    piece = tree.fromstring(read(os.path.join(folder, f"step-{step:05d}-points.vtp"))).find("PolyData/Piece")
    arrays = {(part.tag, array.get("Name")): [float(x) for x in array.text.split()] for part in piece for array in part}
    places = arrays["Points", "Points"]
    expect("ParaView, points", places[:9] == list(results.get("position_of_point", step)), places)
    for k, name in enumerate(BODIES):
        at, q = of_body(results, "position", step, k, 3), of_body(results, "rotation", step, k, 4)
        length = 0.5*max(size(place) for body, place in PLACES.values() if body == k)
        first = 9 + 12*k
        expect(f"ParaView, {name}", places[first:first + 3] == at, places)
        for axis in range(3):
            tip = [length*x for x in turn(q, [float(axis == a) for a in range(3)])]
            found = places[first + 3 + 3*axis:first + 6 + 3*axis]
            expect(f"ParaView, axis of {name}", size([a - b - c for a, b, c in zip(found, at, tip)]) <= 1e-13*50, found)
    expect("ParaView, cells", arrays["CellData", "part"] == [0, 0, 0, 1, 1, 2, 3, 4, 5, 5, 2, 3, 4, 5]
          and arrays["CellData", "index"] == [0, 1, 2, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 1], arrays["CellData", "part"])
    expect("ParaView, lines", arrays["Lines", "connectivity"] == [3, 4, 3, 5, 3, 6, 3, 0, 3, 1, 7, 8, 7, 9, 7, 10, 7, 2]
          and arrays["Lines", "offsets"] == [2*i + 2 for i in range(9)], arrays["Lines", "connectivity"])
    expect("ParaView, forces", arrays["PointData", "lines_N"][:9] == list(results.get("lines_of_point", step)))
    expect("ParaView, list", f'part="2" file="step-{step:05d}-points.vtp"' in read(os.path.join(folder, "result.pvd")).decode())


def pictures(folder):
    for name in ("step-00012-plan.svg", "step-00012-elevation.svg", "plan.svg", "elevation.svg"):
        text = read(os.path.join(folder, name)).decode()
        tree.fromstring(text)
        expect(f"{name}, names", all(text.count(f">{point}</text>") == 1 for point in POINTS + BODIES), name)
        polygons = re.findall("<polygon[^>]*points=\"([^\"]*)\"", text)
        expect(f"{name}, bodies", len(polygons) >= len(BODIES) and all(4 > len(p.split()[0]) or "," in p for p in polygons), polygons)
        names = [(float(x), float(y)) for x, y in re.findall(r'<text x="([\d.]+)" y="([\d.]+)"[^>]*paint-order', text)]
        expect(f"{name}, names apart", len(set(names)) == len(names), names)


def killed_and_resumed(scene, whole):
    process = subprocess.Popen([CAPSTAN, "run", scene, "-q", "-o", "killed"], stderr=subprocess.DEVNULL)
    while process.poll() is None and not (os.path.exists("killed/.journal") and os.path.getsize("killed/.journal") > 100000):
        time.sleep(0.0005)
    expect("killed before its end", process.poll() is None)
    process.kill()
    process.wait()
    said = run(scene, "-q", "--resume", "-o", "killed").stderr
    expect("resumed", "steps were done before" in said and "capstan: 0 of" not in said, said)
    expect("bodies.csv of the resumed run", read("killed/bodies.csv") == whole)


# 5e-11 m beside the point, in time
NEAR = """
capstan: 1
bodies: {b: {held: [0, 0, 10]}}
points: {p: {body: b, at: [1, 0, 0]}}
lines:
  a: {length: 10, elements: 10, mass: 1, stiffness: 1e5, start: {straight: {from: [11, 0, 10], to: [1.00000000005, 0, 10]}},
      ends: {A: held, B: {point: p}}}
history:
  - {name: s, duration: 0.5, steps: 5}
"""


def half_turn():
    """Near half a turn from the start, where the rotation vector jumps, load and moment are those of the side on which the body is."""
    write("turned.yaml", """capstan: 1
bodies: {b: {held: [0, 0, 0], weight: 10, hydrostatics: {z: 5, rx: 30, ry: 40, rz: 70}}}
points: {e: {body: b, at: [1, 0, 0]}}
lines: {s: {length: 9, elements: 3, weight: 1, stiffness: 1e4, start: static, ends: {A: {held: [5, 0, 3]}, B: {point: e}}}}
history:
  - {name: on its way, b.body: {rotation: {quaternion: [0.6, 0.48, 0, 0.64]}}}
  - {name: nearly, b.body: {rotation: {quaternion: [4e-5, 0.6, 0, 0.8]}}}
  - {name: beyond, b.body: {rotation: {quaternion: [-4e-5, 0.6, 0, 0.8]}}}
""")
    run("turned.yaml", "-q", "-o", "turned")
    done = subprocess.run([sys.argv[2], "turned/result.nc", "turned.yaml"], capture_output=True, text=True, check=False)
    expect("half a turn", done.returncode == 0, done.stdout)


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        write("scene.yaml", SCENE)
        write("falling.yaml", FALLING)
        write("plain.yaml", PLAIN)
        said = run("scene.yaml", "--stiffness", "-o", "out").stdout
        expect("said", "bodies.csv" in said and "body-stiffness.csv" in said, said)
        expect("told in the table", len(re.findall(r"^ +body spar: at \([^)]*\) m, roll [-0-9.e]+, pitch [-0-9.e]+, yaw [-0-9.e]+ degrees, lines pull by \([^)]*\) N$", said, re.M)) == STEPS, said)
        results = Results("out/result.nc")
        rows = csv_is_result("out", results)
        forces_balance(results)
        stiffness_is_result("out", results)
        summary_is_result("out", rows)
        paraview("out", results)
        pictures("out")
        whole = read("out/bodies.csv")
        for name in ("bodies.csv", "body-stiffness.csv", "step-00003-points.vtp"):
            expect("in the list of files", f'"name": "{name}"' in read("out/summary.json").decode(), name)
        run("scene.yaml", "-q", "-o", "threads", "--threads=3")
        expect("the same bytes with three threads", read("threads/bodies.csv") == whole)
        expect("no stiffness where none is asked for", not os.path.exists("threads/body-stiffness.csv"))
        killed_and_resumed("scene.yaml", whole)

        half_turn()

        # a run without bodies
        run("plain.yaml", "-q", "-o", "out")
        summary, results = json.loads(read("out/summary.json")), Results("out/result.nc")
        expect("removed", not [name for name in os.listdir("out") if "bod" in name or "points" in name], os.listdir("out"))
        expect("no bodies", "bodies" not in summary and "bodies" not in summary["steps"][0]
              and not [name for name in results.variables if "body" in name], sorted(results.variables))

        # files of somebody else
        for name in ("bodies.csv", "body-stiffness.csv"):
            folder = f"mine-{name}"
            os.mkdir(folder)
            write(f"{folder}/{name}", "mine")
            run("scene.yaml", "-q", "--stiffness", "-o", folder, code=4)
            expect("a file of somebody else", read(f"{folder}/{name}") == b"mine")

        # turned in every pose: proved
        write("turned.yaml", TWISTED)
        done = run("turned.yaml", "-o", "turned", code=5)
        expect("said of the body", "capstan: step twist, body stone: no equilibrium: its lines end at one point of it, and in every pose the loads turn it "
               "about the axis (0, 0, 1) there, by at least 3 N m\n" in done.stderr, done.stderr)
        expect("said of the line", "line string: no equilibrium: a rigid motion lowers the energy without bound (a body turns for ever)\n" in done.stderr,
               done.stderr)
        last = json.loads(read("turned/summary.json"))["steps"][-1]
        expect("the proof", last["bodies"]["stone"]["proof"] == {"axis": [0, 0, 1], "moment_Nm": 3}, last["bodies"])
        expect("none of the line", last["lines"]["string"]["proof"] == {"direction": [0, 0, 0], "fall_N": 0}, last["lines"])

        # no pose
        write("twisted.yaml", TWO_STRINGS)
        done = run("twisted.yaml", "-o", "twisted", code=1)
        told = r"body stone: no pose found where the forces and moments on it balance \([0-9.e+-]+ N and [0-9.e+]+ N m are left after \d+ trials\)\n"
        expect("told in the table", re.search("^ +" + told, done.stdout, re.M), done.stdout)
        expect("told", re.search("^capstan: step twist, " + told, done.stderr, re.M), done.stderr)
        expect("what may help", "give that direction as 'fixed'\n" in done.stderr, done.stderr)
        _, rows = table("twisted/bodies.csv")
        expect("without a place", rows[-1]["has_place"] == "0" and float(rows[-1]["residual_mz"]) > 2.9, rows[-1])
        expect("in the summary", json.loads(read("twisted/summary.json"))["bodies"]["stone"]["steps_without_place"] == 1)

        # nothing holds it: proved, with its weight and that of its line
        done = run("falling.yaml", "-o", "falling", code=5)
        expect("proved", "no equilibrium" in done.stderr and "no pose found" not in done.stdout + done.stderr, done.stderr)
        fall = json.loads(read("falling/summary.json"))["steps"][-1]["lines"]["tail"]["proof"]
        expected = math.hypot(15, 1)
        expect("by its power", abs(fall["fall_N"] - expected) < 1e-9, fall)
        checked = subprocess.run([sys.argv[2], "falling/result.nc", "falling.yaml"], capture_output=True, text=True, check=False)
        expect("the checker", checked.returncode == 0, checked.stdout)

        # lines too short beside a group that has its places
        write("groups.yaml", TWO_GROUPS)
        run("groups.yaml", "-o", "groups", code=5)
        checked = subprocess.run([sys.argv[2], "groups/result.nc", "groups.yaml"], capture_output=True, text=True, check=False)
        expect("the checker, two groups", checked.returncode == 0, checked.stdout)

        # a start as near to its point as it may be begins at the point
        write("near.yaml", NEAR)
        run("near.yaml", "-o", "near")
        checked = subprocess.run([sys.argv[2], "near/result.nc", "near.yaml"], capture_output=True, text=True, check=False)
        expect("the checker, a start beside its point", checked.returncode == 0, checked.stdout)

        # the methods of 1990
        for arguments in (["run", "scene.yaml", "--method", "regularized"], ["study", "scene.yaml", "--history"]):
            done = subprocess.run([CAPSTAN, *arguments, "-o", "1990"], capture_output=True, text=True, check=False)
            expect(" ".join(arguments), done.returncode == 3 and "points where lines meet" in done.stderr and not os.path.exists("1990"), done.stderr)
        os.chdir("/")
    print("\n".join(faults[:20]) or "bodies: good")
    return len(faults) > 0


sys.exit(main())
