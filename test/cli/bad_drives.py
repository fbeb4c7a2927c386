#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan drive: bad files and bad questions are refused with their place and message.             usage: bad_drives.py CAPSTAN EXAMPLES
                                                                      or: bad_drives.py --write FOLDER   (to begin fuzzing with)

Every case is the contents of a file; expected is what follows the file name in the one line on standard error.
"""
import os
import subprocess
import sys
import tempfile

from checks import is_told

OK, USAGE, INPUT, IO, NONE = 0, 2, 3, 4, 5

HEAD = "capstan: 1\n"
SYSTEM = HEAD + "system: {parameters: [a, b], laws: [{on: [a], law: {interval: 1}}], drive: [b], %s}\n"
BODY = HEAD + "body: {patches: [%s]}\n"
DISC = "{disc: {radius: 1, friction: 1, load: 1}}"
PUSHED = HEAD + "body: {patches: [" + DISC + "], push: [%s]}\n"
TOWED = HEAD + "body: {patches: [" + DISC + "], tow: {%s}}\n"
METER = HEAD + "planimeter: {pole: [0, 0], pole_arm: 1, tracer_arm: 1, wheel: 0.5, friction: 0.2, load: 1, curve: %s}\n"
ROPE = HEAD + "rope: {shape: {straight: {from: [0, 0], to: [1, 0]}}, friction: 0.5, weight: 2, ends: {B: [1, 0]}, %s}\n"
SHAPE = HEAD + "rope: {shape: {%s}, friction: 0.5, weight: 2, ends: {B: [1, 0]}}\n"
SWEEP = HEAD + "sweep: {law: %s, stiffness: %s, path: [[1, 0]], steps: 10}\n"

# name, contents, expected after "FILE:", exit code
FILES = [
    ("empty file", "", "1:1: found an empty file", INPUT),
    ("nothing", HEAD, "1:1: drive file: nothing given, expected exactly one of 'system', 'body'", INPUT),
    ("two kinds", BODY % DISC + SWEEP[len(HEAD):] % ("{disc: 1}", 1), "1:1: drive file: too much given", INPUT),
    ("no version", BODY[len(HEAD):] % DISC, "1:1: drive file: 'capstan' is missing", INPUT),
    ("unknown kind", HEAD + "bodi: {}\n", "2:1: drive file: unknown key 'bodi'; did you mean 'body'?", INPUT),
    ("a scene", HEAD + "lines: {}\n", "2:1: found a scene ('lines'), which 'capstan run', 'check' and 'study' take; expected a driven system", INPUT),
    ("a law", HEAD + "law: {disc: 1}\n", "2:1: found a law ('law'), which 'capstan law' takes; expected a driven system", INPUT),
    ("a number for a system", HEAD + "system: 5\n", "2:1: 'system': found '5', expected a mapping with parameters", INPUT),
    ("not YAML", HEAD + "system: {", "3:1: not valid YAML: did not find expected node content", INPUT),
    # systems
    ("no parameters", HEAD + "system: {laws: [{on: [a], law: {interval: 1}}]}\n", "2:1: 'system': 'parameters' is missing", INPUT),
    ("parameter twice", HEAD + "system: {parameters: [a, a], laws: [{on: [a], law: {interval: 1}}]}\n", "2:26: 'parameters': 'a' is given twice", INPUT),
    ("unknown parameter", HEAD + "system: {parameters: [alpha], laws: [{on: [alpa], law: {interval: 1}}]}\n", "2:44: unknown parameter 'alpa'; did you mean 'alpha'?", INPUT),
    ("rows of a law", HEAD + "system: {parameters: [a], laws: [{on: [a], law: {disc: 1}}]}\n", "2:34: law 'law 1': 'on' has 1 row, expected 2", INPUT),
    ("law without law", HEAD + "system: {parameters: [a], laws: [{on: [a]}]}\n", "2:34: law: nothing given, expected exactly one of 'law', 'resistance'", INPUT),
    ("law's own mistake", HEAD + "system: {parameters: [a], laws: [{on: [a], law: {intervall: 1}}]}\n", "2:50: unknown word 'intervall'; did you mean 'interval'?", INPUT),
    ("set without 0", HEAD + "system: {parameters: [a], laws: [{on: [a], law: {interval: [1, 2]}}]}\n", "2:50: 'interval': the set of forces does not contain 0", INPUT),
    ("power of degree 3", HEAD + "system: {parameters: [a], laws: [{on: [a], resistance: [{power: {degree: 3, factor: 1, of: {interval: 1}}}]}]}\n", "2:34: law 1: a power term of degree 3 is no second-order cone program; only degree 2 is: write it as", INPUT),
    ("NaN factor", SYSTEM % "constraints: [{a: .nan}]", "2:96: 'constraints': found '.nan', expected a number, finite and at most 1e100", INPUT),
    ("constraints no list", SYSTEM % "constraints: a", "2:81: 'constraints': found 'a', expected a list of parameters, as in [side, {roll: 1, omega: -0.3}]", INPUT),
    ("load by list", SYSTEM % "load: [1, 2]", "2:81: 'load': found a list of 2, expected forces by parameter, as in {roll: -5}", INPUT),
    ("load on nothing", SYSTEM % "load: {c: 1}", "2:88: unknown parameter 'c'; did you mean 'a'?", INPUT),
    ("velocity of two", SYSTEM % "velocity: [[1, 2]]", "2:92: 'velocity': found a list of 2, expected a list of at least 1 row of 1 number", INPUT),
    ("drive twice the same", HEAD + "system: {parameters: [a], laws: [{on: [a], law: {interval: 1}}], drive: [a, a], velocity: [[1, 2]]}\n", None, NONE),
    ("drive against constraint", HEAD + "system: {parameters: [a], laws: [{on: [a], law: {interval: 1}}], drive: [a], constraints: [a], velocity: [[1]]}\n", None, NONE),
    # bodies
    ("no patch", BODY % "", "2:8: 'patches': found a list of 0, expected a list, as in [{disc: {radius: 1, friction: 0.5, load: 10}}]", INPUT),
    ("unknown patch", BODY % "{disk: {radius: 1}}", "2:19: unknown patch 'disk'; did you mean 'disc'?", INPUT),
    ("negative radius", BODY % "{disc: {radius: -1, friction: 1, load: 1}}", "2:26: 'radius': found '-1', expected a number in m, greater than 0", INPUT),
    ("no load", BODY % "{disc: {radius: 1, friction: 1}}", "2:19: 'disc': 'load' is missing", INPUT),
    ("key of another", BODY % "{disc: {radius: 1, friction: 1, load: 1, brake: 3}}", "2:59: 'disc': unknown key 'brake'", INPUT),
    ("brake in words", BODY % "{wheel: {radius: 1, friction: 1, load: 1, brake: on}}", "2:60: 'brake': found 'on', expected 'locked', or a number in N m, at least 0", INPUT),
    ("two corners", BODY % "{polygon: {corners: [[0, 0], [1, 0]], friction: 1, load: 1}}", "2:29: 'corners': found a list of 2, expected a list of at least 3 rows of 2 numbers", INPUT),
    ("clockwise", BODY % "{polygon: {corners: [[0, 0], [0, 1], [1, 0]], friction: 1, load: 1}}", "2:18: this patch: the polygon turns right", INPUT),
    ("tilted off", BODY % "{disc: {radius: 1, friction: 1, load: 1, tilt: [2, 0]}}", "2:18: this patch: ", INPUT),
    ("law of three", BODY % "{point: {law: {ball: {radius: 1, dimension: 3}}}}", "2:18: this patch has a law in 3 components, expected 2", INPUT),
    ("point without load", BODY % "{point: {friction: 1}}", "2:19: 'point': found a mapping, expected 'friction' and 'load', or 'law' without them", INPUT),
    ("point with both", BODY % "{point: {friction: 1, law: {disc: 1}}}", "2:19: 'point': found a mapping, expected 'friction' and 'load'", INPUT),
    ("push without at", PUSHED % "{velocity: [0, 1]}", "2:69: push: found a mapping, expected {at, velocity}", INPUT),
    ("push both ways", PUSHED % "{at: [0, 1], velocity: [1, 0], twist: [1, 0, 0]}", "2:69: push: found a mapping, expected {at, velocity}, {at, normal, speed} or {twist}", INPUT),
    ("normal 0", PUSHED % "{at: [0, 1], normal: [0, 0], speed: 1}", "2:69: push: found a mapping, expected a 'normal' that is not 0", INPUT),
    ("velocity of three", PUSHED % "{at: [0, 1], velocity: [0, 1, 2]}", "2:82: 'velocity': found a list of 3, expected two numbers in m/s, as in [x, y]", INPUT),
    ("tow without path", TOWED % "steps: 5", "2:62: 'tow': 'path' is missing", INPUT),
    ("rope without end", TOWED % "rope: 1, steps: 5, path: [[1, 0]]", "2:62: 'tow': found a mapping, expected 'rope' (its length) and 'end' (where its far end is) together o", INPUT),
    ("end too far", TOWED % "rope: 1, end: [3, 0], steps: 5, path: [[4, 0]]", "2:62: 'tow': found a mapping, expected an 'end' no farther from the hitch than the rope is long", INPUT),
    ("no steps", TOWED % "steps: 0, path: [[1, 0]]", "2:68: 'steps': found '0', expected a whole number, from 1 to 1000000", INPUT),
    ("arc without angle", TOWED % "steps: 5, path: {arc: {centre: [0, 1]}}", "2:85: 'arc': 'angle' is missing", INPUT),
    ("pulled apart", HEAD + "rope: {shape: {straight: {from: [0, 0], to: [1, 0]}}, friction: 1, weight: 1, ends: {A: held, B: [1, 0]}}\n", None, NONE),
    ("load too heavy", HEAD + "system: {parameters: [a], laws: [{on: [a], law: {interval: 1}}], load: {a: 2}}\n", None, NONE),
    # planimeters
    ("out of reach", METER % "[[1, 0], [9, 0], [1, 1]]", "2:92: 'curve': the tracer cannot reach (9, 0), between points 0 and 1: the arms of 1 m and 1 m are t", INPUT),
    ("two points", METER % "[[1, 0], [1, 1]]", "2:92: 'curve': found a list of 2, expected a list of at least 3 rows of 2 numbers", INPUT),
    ("file that is not there", METER % "{file: nothing.csv}", None, IO),
    ("circle and file", METER % "{circle: {centre: [1, 0], radius: 0.1, points: 9}, file: a.csv}", "2:92: 'curve': too much given, expected exactly one of 'circle', 'file'", INPUT),
    # ropes
    ("no elements", ROPE % "elements: 0", "2:100: 'elements': found '0', expected a whole number, from 1 to 100000", INPUT),
    ("too many elements", ROPE % "elements: 1000000", "2:100: 'elements': found '1000000', expected a whole number, from 1 to 100000", INPUT),
    ("two shapes", SHAPE % "straight: {from: [0, 0], to: [1, 0]}, polyline: [[0, 0], [1, 1]]", "2:8: 'shape': too much given, expected exactly one of 'straight', 'arc', 'polyline'", INPUT),
    ("no length", SHAPE % "straight: {from: [0, 0], to: [0, 0]}", "2:8: 'shape': nodes 0 and 1 are 0 m apart", INPUT),
    ("no end driven", HEAD + "rope: {shape: {straight: {from: [0, 0], to: [1, 0]}}, friction: 1, weight: 1, ends: {A: held}}\n", "2:79: 'ends': 'B' is missing: [m/s] velocity [vx, vy] of the last end", INPUT),
    ("end in words", HEAD + "rope: {shape: {straight: {from: [0, 0], to: [1, 0]}}, friction: 1, weight: 1, ends: {B: pulled}}\n", "2:86: 'B': found 'pulled', expected one of: free held, or two numbers in m/s, as in [x, y]", INPUT),
    ("path of a free end", HEAD + "rope: {shape: {straight: {from: [0, 0], to: [1, 0]}}, friction: 1, weight: 1, ends: {A: [1, 0], B: free}, path: [[2, 0]]}\n", "2:107: 'path': end B is free, expected it held or driven: the path is its path", INPUT),
    # sweeps
    ("three components", SWEEP % ("{ball: {radius: 1, dimension: 3}}", 1), "2:9: 'law': found more than 2 components", INPUT),
    ("no stiffness", SWEEP % ("{disc: 1}", 0), "2:25: 'stiffness': found '0', expected a number in N/m, greater than 0", INPUT),
    ("path of another space", SWEEP % ("{interval: 1}", 1), "2:50: 'path': found a list of 2, expected a list of at least 1 row of 1 number", INPUT),
]

# names of those above that a JSON schema cannot tell: names and values that belong together, the mathematics, other files
BEYOND_A_SCHEMA = {
    "unknown parameter", "rows of a law", "set without 0", "power of degree 3", "NaN factor", "load on nothing", "velocity of two",
    "drive twice the same", "drive against constraint", "clockwise", "tilted off", "law of three", "normal 0", "rope without end",
    "end too far", "pulled apart", "load too heavy", "out of reach", "file that is not there", "no length", "path of a free end",
    "three components", "path of another space",
}

# arguments, exit code, part of the message
QUESTIONS = [
    ([], USAGE, "capstan drive: no file given"),
    (["%s/disc.yaml", "--velocity", "1"], USAGE, "--velocity, --force and --eliminate go with 'system'; found 'body'"),
    (["%s/braked-wheel.yaml", "--velocity", "1"], USAGE, "capstan drive: --velocity: expected 2 numbers separated by commas, at most 1e100: found '1'"),
    (["%s/braked-wheel.yaml", "--force", "1,2"], USAGE, "add --eliminate"),
    (["%s/braked-wheel.yaml", "--axes", "1,2"], USAGE, "--axes goes with --eliminate --plot"),
    (["%s/braked-wheel.yaml", "-e", "--plot", "/dev/null", "--axes", "1,3"], USAGE, "two different components from 1 to 2"),
    (["%s/winch.yaml", "--plot", "/dev/null"], USAGE, "this system has 1"),
    (["%s/winch.yaml", "--eliminate"], INPUT, ""),
    (["%s/disc.yaml", "--plot", "/nowhere/at/all.svg"], IO, "/nowhere/at/all.svg: cannot write"),
    (["%s/nothing.yaml"], IO, "nothing.yaml"),
    (["-", "--velocity", "-"], USAGE, "capstan drive: '-' is given 2 times"),
    (["%s/disc.yaml", "--plott", "x"], USAGE, "did you mean '--plot'?"),
]


def write(folder):
    for i, (_, text, _, _) in enumerate(FILES):
        with open(os.path.join(folder, f"bad-{i}.yaml"), "w") as file:
            file.write(text)


def main():
    if sys.argv[1] == "--write":
        return write(sys.argv[2])
    capstan, examples = sys.argv[1:]
    failed = 0

    def complain(name, done, expected):
        nonlocal failed
        failed += 1
        print(f"FAIL {name}: exit {done.returncode}, {done.stderr!r}, expected {expected!r}")

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "case.yaml")
        for name, text, expected, code in FILES:
            with open(path, "w") as out:
                out.write(text)
            done = subprocess.run([capstan, "drive", path], capture_output=True, text=True, timeout=60)
            good = done.returncode == code and (code in (OK, NONE) or len(done.stderr.splitlines()) == 1)
            if expected is not None and not done.stderr.startswith(f"capstan: {path}:{expected}"):
                good = False
            if not good or "nan" in done.stdout:
                complain(name, done, (code, expected))
        for arguments, code, message in QUESTIONS:
            done = subprocess.run([capstan, "drive", *(a % examples if "%" in a else a for a in arguments)], capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL, timeout=60)
            if done.returncode != code or message not in done.stderr:
                complain(arguments, done, (code, message))
    print(f"{len(FILES) + len(QUESTIONS)} cases, {failed} failed")
    return 0 if is_told(len(FILES) + len(QUESTIONS)) and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
