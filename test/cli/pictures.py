# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of what is long, many, without a bound or without a direction: each is well formed, and says what it leaves out.

usage: pictures.py CAPSTAN"""
import csv
import json
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

sys.dont_write_bytecode = True
from checks import expect, faults, write

CAPSTAN = os.path.abspath(sys.argv[1])
LONG = "A title that does not fit into the width of any picture, "*8
LINES = f"""title: {LONG!r}
gravity: [0, 0, 0]
lines:
""" + "".join(f"  l{i}: {{length: 1, elements: 4, weight: 0, stiffness: 100, start: {{straight: {{from: [0, {i}, 0], to: [1, {i}, 0]}}}}, "
              "ends: {A: held, B: held}}\n" for i in range(8)) + "history: [{name: out, steps: 2, l0.B: {move: [0.1, 0, 0]}}]\n"
ROPE = "rope: {length: 10, elements: 20, weight: 5, stiffness: 1e4, start: %s}\n"
LOOPS = "obstacles: {bed: {plane: {}, friction: 0.5}}\nlines:\n  " + \
        ROPE % "{straight: {from: [0, 0, 0], to: [10, 0, 0]}}, ends: {A: held, B: held}" + "history:\n" + \
        "".join(f"  - {{name: {name}, steps: 2, rope.B: {{move: [{x}, 0, 0]}}}}\n"
                for name, x in 2*(("out", 0.02), ("'home / again?'", -0.02))) + "  - {name: aside, rope.B: {move: [0, 0.1, 0]}}\n"
SIDEWAYS = "gravity: [-9.81, 0, 0]\nlines:\n  " + ROPE % "static, ends: {A: {held: [0, 0, 0]}, B: {held: [0, 8, 0]}}"
# five steps with contact; the last has no equilibrium; the second line touches nothing
STEPS = """obstacles: {bed: {plane: {}, friction: 0.5}}
lines:
  rope: {length: 10, elements: 20, weight: 5, stiffness: 1e4, start: {straight: {from: [0, 0, 0], to: [10, 0, 0]}}, ends: {A: held, B: held}}
  wire: {length: 4, elements: 8, weight: 2, stiffness: 1e4, start: static, ends: {A: {held: [0, 5, 3]}, B: {held: [3, 5, 4]}}}
history:
  - {name: up, steps: 3, rope.B: {move: [-1, 0, 2]}}
  - {name: off, steps: 1, rope.A: {force: [0, 0, 9]}, rope.B: {force: [5, 0, 80]}}
"""
# a body is moved aside and turned on through half a turn, a second one stands still
BODIES = """bodies:
  barge: {held: [3, 1, 0], rotation: {roll_pitch_yaw: [0, 0, 120]}}
  quay: {held: [-20, 1, 2]}
points: {fairlead: {body: barge, at: [1, 0, 0]}, ring: {body: quay, at: [0, 0, -2]}}
lines:
  rope: {length: 24, elements: 6, weight: 9, stiffness: 1e4, start: static, ends: {A: {point: ring}, B: {point: fairlead}}}
history:
  - {name: aside, steps: 1, barge.body: {move: [-0.5, 0, 0]}}
  - {name: turn, steps: 4, barge.body: {move: [0, 0.25, 0], rotation: {roll_pitch_yaw: [0, 0, 220]}}}
"""
CURVES = (("A.tension", "B.tension"), ("A.uplift", "B.uplift"), ("grounded", "slipping"))
TWO = """system:
  parameters: [a, b]
  laws: [{name: x, on: [a], law: {interval: 1}}, {name: y, on: [b], law: {interval: [0, .inf]}}]
  drive: [a, b]
  velocity: [[1, 1]]
"""


def run(verb, text, *arguments, code=0):
    write("file.yaml", "capstan: 1\n" + text)
    done = subprocess.run([CAPSTAN, verb, "file.yaml", "-q", *arguments], capture_output=True, text=True, timeout=300, check=False)
    expect(f"{verb} {arguments}: exit code", done.returncode == code, (done.returncode, done.stderr[-300:]))
    return done


def read(name):
    """The text in a picture. No number in it is none."""
    with open(name, encoding="utf-8") as file:
        content = file.read()
    words = "\n".join(part for element in xml.fromstring(content).iter() for part in (element.text, element.tail) if part)
    for attribute in (value for element in xml.fromstring(content).iter() for value in element.attrib.values()):
        expect(f"{name}: a number that is none", "nan" not in attribute.lower() and "inf" not in attribute.lower(), attribute[:100])
    return words


def check_over_steps(directory, lines):
    """The curves of history.svg against history.csv: places on the sheet are linear in the step and in the value."""
    with open(directory + "/history.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))[1:]
    with open(directory + "/summary.json", encoding="utf-8") as file:
        steps = json.load(file)["steps"]
    solved = {line: [step["lines"][line]["outcome"] == "solved" for step in steps] for line in lines}
    found = [[tuple(map(float, point.split(","))) for point in element.get("points").split()]
             for element in xml.parse(directory + "/history.svg").iter() if element.tag.endswith("polyline")]
    wanted = [[float(row[f"{line}.{curve}"]) for row, counts in zip(rows, solved[line]) if counts]
              for pair in CURVES for line in lines for curve in pair]
    expect("history.svg: number of curves", len(found) == len(wanted), (len(found), len(wanted)))
    scale = []  # of each frame: the values that its curves have farthest apart, and their places
    for number, (curve, values) in enumerate(zip(found, wanted)):
        if number % (2*len(lines)) == 0:
            both = [pair for c, v in list(zip(found, wanted))[number:number + 2*len(lines)] for pair in zip(v, (y for _, y in c))]
            scale = [min(both), max(both)]
        (low, bottom), (high, top) = scale
        expect("history.svg: steps at equal distances", len(curve) == len(values) and all(
            abs((x - curve[0][0])*(len(values) - 1) - i*(curve[-1][0] - curve[0][0])) < 0.2*len(values) for i, (x, _) in enumerate(curve)), curve)
        for (_, y), value in zip(curve, values):  # places are rounded to a tenth
            expect("history.svg: a value", abs(bottom + (value - low)/(high - low)*(top - bottom) - y) < 0.11, (number, value, y))


def check_bodies(directory):
    """The frames of bodies: those in which one moves, with the values of bodies.csv less the place where it begins."""
    with open(directory + "/bodies.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))[1:]
    found = [[tuple(map(float, point.split(","))) for point in element.get("points").split()]
             for element in xml.parse(directory + "/history.svg").iter() if element.tag.endswith("polyline")]
    wanted = []
    for key, first in (("x", (3, -20)), ("y", (1, 1)), ("yaw", (0, 0))):
        for body, begin in zip(("barge", "quay"), first):
            curve = [float(row[key]) - begin for row in rows if row["body"] == body]
            cuts = [0] + [i for i in range(1, len(curve)) if abs(curve[i] - curve[i - 1]) > 180] + [len(curve)]
            wanted += [(key, curve[a:b]) for a, b in zip(cuts, cuts[1:])]
    expect("history.svg: curves of bodies", [len(values) for _, values in wanted] == [6, 6, 6, 6, 4, 2, 6] and len(found) >= len(wanted), wanted)
    for key in ("x", "y", "yaw"):
        both = [(value, y) for (of, values), curve in zip(wanted, found) if of == key for value, (_, y) in zip(values, curve)]
        (low, bottom), (high, top) = min(both), max(both)
        expect(f"history.svg: {key} of bodies", bottom - top > 100 and all(
            abs(bottom + (value - low)/(high - low)*(top - bottom) - y) < 0.11 for value, y in both), both)
    words = read(directory + "/history.svg")
    expect("history.svg: what bodies do", all(word in words for word in ("surge x (m)", "sway y (m)", "yaw (degrees)", "barge", "quay"))
           and not any(word in words for word in ("heave", "roll", "pitch")), words)


def main():
    run("run", BODIES, "-o", "bodies", "--no-paraview")
    check_bodies("bodies")
    run("run", STEPS, "-o", "steps", "--no-paraview", code=5)
    check_over_steps("steps", ("rope", "wire"))
    words = read("steps/history.svg")
    expect("history.svg: what the curves are", all(word in words for word in ("tension (N)", "uplift (N)", "length (m)", "end A", "slipping", "rope", "wire")), words)
    run("run", LOOPS, "-o", "flat", "--no-paraview")
    expect("history.svg: no uplift along a bed", "uplift" not in read("flat/history.svg"), "uplift is drawn")
    run("run", SIDEWAYS, "-o", "one", "--no-paraview")
    expect("one step has no history", not os.path.exists("one/history.svg"), os.listdir("one"))
    run("run", LINES, "-o", "lines")
    words = read("lines/plan.svg")
    expect("a long title is cut", "\u2026" in words and LONG.strip() not in words.replace("\n", ""), words[:300])
    for name in ("lines/tension.svg", "lines/history.svg"):
        expect("many lines", "the first 6 lines" in read(name), read(name)[:300])
    run("run", LOOPS, "-o", "loops")
    names = sorted(name for name in os.listdir("loops") if name.startswith("loop-"))
    # each way out and home is a loop that begins and ends at the same place
    expect("loops", names and all(set(name) <= set("abcdefghijklmnopqrstuvwxyz0123456789-._") for name in names), names)
    for name in names:
        read("loops/" + name)
    run("run", SIDEWAYS, "-o", "sideways")
    read("sideways/elevation.svg")
    read("sideways/plan.svg")
    run("drive", TWO, "-p", "two.svg")
    words = read("two.svg")
    expect("a system without a title", "driven system" in words, words[:300])
    n = 501
    many = f"system:\n  parameters: [{', '.join(f'p{i}' for i in range(n))}]\n  laws:\n" + \
           "".join(f"    - {{name: l{i}, on: [p{i}], law: {{interval: 1}}}}\n" for i in range(n)) + "  drive: [p0, p1]\n  velocity: [[1, 1]]\n"
    done = run("drive", many, "-p", "many.svg", code=6)
    expect("too many parameters", "maps are drawn of systems of up to 500 parameters; found 501" in done.stderr, done.stderr)
    expect("too many parameters: no picture", not os.path.exists("many.svg"))


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
    os.chdir("/")
print("\n".join(faults[:20]) or "pictures: long titles, many lines, loops, no gravity and gravity along x, systems")
sys.exit(1 if faults else 0)
