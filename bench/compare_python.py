#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What calls from Python cost beside the same calls from C, in turns.   usage: compare_python.py BUILD [TURNS]

Needs a build with -DCAPSTAN_PYTHON=ON and -DCAPSTAN_BENCH=ON, and the interpreter that it was built for. Printed are the
medians of processor time per call over the turns, their ratio and their difference:

  move      of a line of a few elements, with a target that is used again; nothing is read but the report that is returned
  support   of a disc and a segment, summed, in a million directions at once
"""
import os
import statistics
import subprocess
import sys
import time

SCENE = """\
capstan: 1
lines:
  rope: {length: 2, elements: %d, mass: 1, stiffness: 1e4, start: static, ends: {A: {held: [0, 0, 0]}, B: {held: [1.5, 0, 0]}}}
"""


def by_c(build, *arguments):
    done = subprocess.run([os.path.join(build, "bench", "call_bench"), *map(str, arguments)], capture_output=True, text=True, check=True)
    return float(done.stdout)


def move(capstan, path, count):
    evolution = capstan.Evolution(path)
    for _ in evolution:
        pass
    target = evolution.target({"rope.B": {"move": [0, 0, 0]}})
    value = target["rope.B"]
    places, move = (value[0] + 1e-3, value[0]), evolution.move
    begun = time.process_time()
    for i in range(count):
        value[0] = places[i % 2]
        move(target)
    return (time.process_time() - begun) / count


def support(numpy, sets, count):
    angle = 0.001 * numpy.arange(count)
    w = numpy.stack([numpy.cos(angle), numpy.sin(angle)], 1)
    s = sets.disc(2) + sets.segment([0, -1], [0.5, 1])
    begun = time.process_time()
    s.support(w)
    return (time.process_time() - begun) / count


def say(name, c, python):
    c, python = statistics.median(c), statistics.median(python)
    print(f"{name:28} C {1e6 * c:9.3f} us  Python {1e6 * python:9.3f} us  ratio {python / c:6.3f}  difference {1e6 * (python - c):8.3f} us")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    build, turns = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 7
    sys.path.insert(0, os.path.join(build, "python"))
    import numpy

    import capstan
    from capstan import sets

    for elements, count in ((2, 4000), (100, 400)):
        path = os.path.join(build, "bench", f"call-{elements}.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(SCENE % elements)
        times = [(by_c(build, path, 0, count), move(capstan, path, count)) for _ in range(turns)]
        say(f"move, {elements} elements", *zip(*times))
    times = [(by_c(build, "--support", 1000000), support(numpy, sets, 1000000)) for _ in range(turns)]
    say("support, 1e6 directions", *zip(*times))


main()
