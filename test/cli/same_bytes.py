# SPDX-License-Identifier: BSD-3-Clause
"""Two runs of a scene write the same bytes, whatever was in the memory that they are given: all files but for the times in them.

usage: same_bytes.py CAPSTAN

The lengths of byte variables in result.nc are odd here, and what fills them up to a word has to be the same as well: it is looked at, and is 0.
"""
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from checks import expect, faults, write
from same_files import Results, differences

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


def run(folder, perturb, elements):
    write("scene.yaml", SCENE.replace("ELEMENTS", str(elements)))
    done = subprocess.run([CAPSTAN, "run", "scene.yaml", "-q", "-o", folder], env=dict(os.environ, MALLOC_PERTURB_=str(perturb)),
                          capture_output=True, text=True, timeout=60)
    expect(f"{elements} elements", done.returncode == 0, done.stderr)


def filling(path):
    """The bytes that fill the byte variables of result.nc up to a word."""
    results, padding = Results(path), b""
    for step in range(results.steps):
        for shape, kind, size, begins in results.variables.values():
            if shape and shape[0] == 0 and kind in (1, 2):
                count = 1
                for extent in shape[1:]:
                    count *= extent
                padding += results.data[begins + step*results.record + count:begins + step*results.record + size]
    return padding


def main():
    for elements in (2, 3, 4, 5, 6, 33):
        run("one", 85, elements)
        run("two", 170, elements)
        differ = differences("one", "two")
        expect(f"{elements} elements: files that differ", not differ, differ)
        padding = filling("one/result.nc")
        expect(f"{elements} elements: what fills byte variables up", padding == bytes(len(padding)), padding[:20])
        filled.append(len(padding))
    expect("some byte variable is filled up", sum(filled) > 0, filled)


filled = []
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
    os.chdir("/")
print("\n".join(faults[:20]) or f"same bytes: {sum(filled)} bytes that fill byte variables up, all 0")
sys.exit(1 if faults else 0)
