# SPDX-License-Identifier: BSD-3-Clause
"""Two runs of a scene write the same bytes, whatever was in the memory that they are given: all files but for the times in them.

usage: same_bytes.py CAPSTAN

The lengths of byte variables in result.nc are odd here, and what fills them up to a word has to be the same as well: it is looked at, and is 0.
"""
import csv
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../property"))
from checks import expect, faults, read, write
from result_file import Results

CAPSTAN = os.path.abspath(sys.argv[1])
SCENE = """capstan: 1
obstacles:
  bed: {plane: {}, friction: {axial: 0.5, lateral: 0.8, shape: box}}
  wall: {plane: {point: [0, -1, 0], normal: [0, 1, 0]}, friction: 0.2}
lines:
  rope: {length: 1, elements: ELEMENTS, weight: 1, stiffness: 100, start: {straight: {from: [0, 0, 0], to: [1, 0, 0]}}, ends: {A: held, B: held}}
history:
  - {name: out, rope.B: {position: [1.1, 0, 0]}, steps: 3}
"""
# in a summary, what a run takes, and what follows from it
TIMES = rb'"wall_s": [0-9.e+-]+|"crc32": "[0-9a-f]+"|"bytes": [0-9]+'


def run(folder, perturb, elements):
    write("scene.yaml", SCENE.replace("ELEMENTS", str(elements)))
    done = subprocess.run([CAPSTAN, "run", "scene.yaml", "-q", "-o", folder], env=dict(os.environ, MALLOC_PERTURB_=str(perturb)),
                          capture_output=True, text=True, timeout=60)
    expect(f"{elements} elements", done.returncode == 0, done.stderr)


def without_times(path):
    """The bytes of result.nc, the times of its steps and of its beginning blanked; and what fills its byte variables up."""
    results, data = Results(path), bytearray(read(path))
    _, _, _, begin = results.variables["wall"]
    padding = b""
    for step in range(results.steps):
        at = begin + step*results.record
        data[at:at + 8] = bytes(8)
        for shape, kind, size, begins in results.variables.values():
            if shape and shape[0] == 0 and kind in (1, 2):
                count = 1
                for extent in shape[1:]:
                    count *= extent
                padding += data[begins + step*results.record + count:begins + step*results.record + size]
    return re.sub(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", b"", bytes(data)), padding


def text_without_times(path):
    if not path.endswith("history.csv"):
        return re.sub(TIMES, b"", read(path)) if path.endswith("summary.json") else read(path)
    with open(path, newline="", encoding="utf-8") as file:
        return [[cell for key, cell in row.items() if key != "wall"] for row in csv.DictReader(file)]


def main():
    for elements in (2, 3, 4, 5, 6, 33):
        run("one", 85, elements)
        run("two", 170, elements)
        names = sorted(os.listdir("one"))
        expect(f"{elements} elements: names", names == sorted(os.listdir("two")), names)
        for name in names:
            if name == "result.nc":
                (one, padding), (two, _) = without_times("one/" + name), without_times("two/" + name)
                expect(f"{elements} elements: what fills byte variables up", padding == bytes(len(padding)), padding[:20])
                expect(f"{elements} elements: {name}", one == two, [i for i in range(len(one)) if one[i] != two[i]][:9])
                filled.append(len(padding))
            else:
                one, two = (text_without_times(f"{folder}/{name}") for folder in ("one", "two"))
                expect(f"{elements} elements: {name}", one == two, (one[:200], two[:200]))
    expect("some byte variable is filled up", sum(filled) > 0, filled)


filled = []
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
    os.chdir("/")
print("\n".join(faults[:20]) or f"same bytes: {sum(filled)} bytes that fill byte variables up, all 0")
sys.exit(1 if faults else 0)
