#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Names of earlier versions are refused at their place, with the name that took their place.

usage: names.py CAPSTAN SOURCE_FOLDER

Each case is an earlier name put into a file that is valid with the new one. Every earlier name in the tables of keys, of
fields and of options has a case, and each appears with its new name in the table of names in CHANGELOG.md.
"""
import glob
import os
import re
import subprocess
import sys
import tempfile

USAGE, INPUT = 2, 3
SCENE = """\
capstan: 1
friction_policy: frozen
contact_policy: reference
obstacles:
  bed: {plane: {point: [0, 0, -3]}}
  ball: {sphere: {centre: [5, 9, 0], radius: 1}}
lines:
  cable: {length: 10, elements: 4, mass: 1, stiffness: 1e6, start: {straight: {from: [0, 0, 0], to: [10, 0, 0]}}, ends: {A: held, B: {held: [10, 0, 0]}}}
  curve: {length: 1, elements: 4, mass: 1, stiffness: 1e6, start: {arc: {from: [0, 0, 9], centre: [0, 5, 9]}}, ends: {A: free, B: held}}
  chain: {length: 5, elements: 4, mass: 1, stiffness: 1e6, start: static, ends: {A: {held: [0, 0, 5]}, B: free}}
"""
CAR = """\
capstan: 1
vehicle:
  wheels:
  - {orientation: 10, radius: 0.3, friction: 0.8, load: 5000}
  tow: {position: [1, 0], orientation: 5, path: {arc: {centre: [2, 15], angle: 90}}, steps: 4}
"""
ARC = """\
capstan: 1
rope:
  shape: {arc: {from: [2, 0], centre: [0, 0], angle: 60}}
  friction: 0.5
  weight: 2
  ends: {B: [1, 0]}
"""
ROPE = """\
capstan: 1
rope:
  shape: {polyline: [[0, 0], [1, 0]]}
  friction: 0.5
  weight: 2
  ends: {B: [1, 0]}
"""
PLANIMETER = """\
capstan: 1
planimeter:
  pole: [0, 0]
  pole_arm: 1
  tracer_arm: 1.3
  wheel: 0.4
  friction: 0.2
  load: 1
  curve: {circle: {centre: [0.1, 0], radius: 1.2, points: 40}}
"""
DEGREES = ", in degrees, not in radians"

# verb, file, what of it is replaced, by what, what the message says behind "FILE:"
FILES = [
    ("check", SCENE, "friction_policy:", "friction:", "2:1: scene: 'friction' is now 'friction_policy'"),
    ("check", SCENE, "contact_policy:", "contact:", "3:1: scene: 'contact' is now 'contact_policy'"),
    ("check", SCENE, "reference", "strict", "3:1: 'contact_policy': 'strict' is now 'reference'"),
    ("check", SCENE, "reference", "gained", "3:1: 'contact_policy': 'gained' is now 'reached'"),
    ("check", SCENE, "{centre: [5", "{center: [5", "6:19: 'sphere': 'center' is now 'centre'"),
    ("check", SCENE, "centre: [0, 5", "center: [0, 5", "9:91: 'arc': 'center' is now 'centre'"),
    ("check", SCENE, "A: held", "A: fixed", "8:122: 'A': 'fixed' is now 'held'"),
    ("check", SCENE, "B: held", "B: fixed", "9:128: 'B': 'fixed' is now 'held'"),
    ("check", SCENE, "{held: [10", "{fixed: [10", "8:135: 'B': 'fixed' is now 'held'"),
    ("check", SCENE, "static", "laid", "10:60: 'start': 'laid' is now 'static'"),
    ("drive", CAR, "{orientation: 10", "{angle: 0.2", "4:6: wheel: 'angle' is now 'orientation'" + DEGREES),
    ("drive", CAR, "position: [1, 0]", "pose: [1, 0, 0.1]", "5:9: 'tow': 'pose' is now 'position', [x, y], and 'orientation', in degrees"),
    ("drive", CAR, "centre:", "center:", "5:56: 'arc': 'center' is now 'centre'"),
    ("drive", CAR, "angle: 90", "turn: 1.5", "5:73: 'arc': 'turn' is now 'angle'" + DEGREES),
    ("drive", ARC, "centre:", "center:", "3:31: 'arc': 'center' is now 'centre'"),
    ("drive", ARC, "from: [2, 0]", "radius: 2, from: 0", "3:17: 'arc': 'radius' is now 'from', the point [x, y] where it begins"),
    ("drive", ARC, "angle: 60", "turn: 1", "3:47: 'arc': 'turn' is now 'angle'" + DEGREES),
    ("drive", ROPE, "polyline:", "points:", "3:11: 'shape': 'points' is now 'polyline'"),
    ("drive", PLANIMETER, "centre:", "center:", "9:20: 'circle': 'center' is now 'centre'"),
]

# options of `capstan run`, and the whole message
OPTIONS = [
    (["--tol", "0.1"], "capstan run: option '--tol' is now '--path-tolerance'"),
    (["--tol=0.1"], "capstan run: option '--tol' is now '--path-tolerance'"),
    (["--fields", "position,friction"], "capstan run: --fields: 'friction' is now 'friction_force'"),
    (["--fields", "element_friction"], "capstan run: --fields: 'element_friction' is now 'element_friction_force'"),
    (["--fields", "slide"], "capstan run: --fields: 'slide' is now 'slip'"),
    (["--fields", "position,element_slide"], "capstan run: --fields: 'element_slide' is now 'element_slip'"),
]


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def former_names(root):
    """all earlier names in the tables, as pairs with the names that they have now"""
    pairs = set()
    for path in glob.glob(os.path.join(root, "src", "io", "schema", "tables", "*_keys.c")):
        for row in re.split(r"\n {4,8}\{(?=\")", read(path)):
            now = re.match(r'"(\w+)"', row)
            for former in " ".join(re.findall(r'\.formerly = "([^"]*)"', row)).split():
                pairs.add((former, now[1]))
            words = re.search(r'\.words = "([^"]*)"', row)
            for former in re.findall(r'\.former_words = "([^"]*)"', row):
                pairs |= {(a, b) for a, b in zip(former.split(), words[1].split()) if a != b}
    for path in (("src", "io", "results", "fields.c"), ("cli", "options.c")):
        table = re.search(r"RENAMED\[\] = \{(.*?)\};", read(root, *path), re.S)
        pairs |= set(re.findall(r'\{"([^"]*)",\s*"([^"]*)"\}', table[1]))
    return pairs


def main():
    capstan, root = sys.argv[1:]
    failed, seen = 0, set()

    def expect(name, holds, found):
        nonlocal failed
        if not holds:
            failed += 1
            print(f"FAILED {name}: {found}")

    def run(*command):
        return subprocess.run([capstan, *command], capture_output=True, text=True, timeout=60, cwd=folder)

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "case.yaml")
        for verb, good, new, old, words in FILES:
            assert good.count(new) == 1, (new, good)
            for text, code in ((good, 0), (good.replace(new, old), INPUT)):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
                done = run(verb, path)
                expect(f"{old}: exit", done.returncode == code, (done.returncode, done.stderr))
            expect(old, done.stderr == f"capstan: {path}:{words}\n" and not done.stdout, done.stderr)
            seen.add(re.search(r"'(\w+)' is now '(\w+)'", words).groups())
        with open(path, "w", encoding="utf-8") as file:
            file.write(SCENE)
        for arguments, words in OPTIONS:
            done = run("run", path, "-o", "out", *arguments)
            expect(arguments, done.returncode in (USAGE, INPUT) and done.stderr.split("\n")[0] == words, (done.returncode, done.stderr))
            seen.add(re.search(r"'-*([\w-]+)' is now '-*([\w-]+)'", words).groups())

    names = former_names(root)
    expect("a case for every earlier name", names == seen, names ^ seen)
    expect("names found", len(names) >= 15, names)
    changes = read(root, "CHANGELOG.md").split("### Names", 1)[1]
    for old, new in names:
        row = [line for line in changes.splitlines() if line.startswith("|") and re.search(rf"\b{old}\b.*\|.*\b{new}\b", line)]
        expect(f"{old} -> {new} in CHANGELOG.md", row, "no row of the table of names")
    print(f"{len(FILES) + len(OPTIONS)} cases, {len(names)} earlier names, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
