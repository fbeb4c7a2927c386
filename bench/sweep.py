#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A sweep of 2000 cases of the OC3-Hywind line on one core and on two.   usage: sweep.py [--turns N] [--write] BUILD

20 coefficients of friction, 10 offsets of the fairlead and 10 stiffnesses; each case takes the fairlead out in four steps, and back in
four. Printed are, for one process and for two, in turns: elapsed and processor seconds, the least of the turns, and their ratios. The
elapsed ratio says how much sooner two cores are done, and means something on a quiet machine only; the ratio of processor time, which
is at most 1 where nothing is lost, says what sharing out the cases costs in itself, also on a busy one. The Datasets must be the same,
bit for bit. --write puts the figures into bench/README.md.

Needs a build with -DCAPSTAN_PYTHON=ON, the interpreter that it was built for, and xarray."""
import argparse
import os
import re
import resource
import sys
import tempfile
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), ".."))
GRID = {"friction": [round(0.05 * i, 2) for i in range(1, 21)], "offset": [float(i) for i in range(1, 11)],
        "stiffness": [1e8 * i for i in (1, 1.5, 2, 2.5, 3, 3.5, 3.84243, 4.5, 5, 6)]}


def make_scene(friction, offset, stiffness):
    return {"obstacles": {"bed": {"plane": {"point": [0, 0, -320]}, "friction": friction}},
            "lines": {"line": {"length": 902.2, "elements": 200, "weight": 698.094, "stiffness": stiffness, "start": "static",
                               "ends": {"A": {"held": [0, 0, -320]}, "B": {"held": [848.67, 0, -70]}}}},
            "history": [{"name": "out", "line.B": {"move": [offset, 0, 0]}, "steps": 4},
                        {"name": "back", "line.B": {"move": [-offset, 0, 0]}, "steps": 4}]}


def processor():
    """Seconds of this process and of those that it has waited for."""
    own, others = resource.getrusage(resource.RUSAGE_SELF), resource.getrusage(resource.RUSAGE_CHILDREN)
    return own.ru_utime + own.ru_stime + others.ru_utime + others.ru_stime


def measured(capstan, jobs):
    """The Dataset of a sweep that keeps its journal, and its elapsed and processor seconds."""
    with tempfile.TemporaryDirectory() as folder:
        begun, used = time.perf_counter(), processor()
        found = capstan.sweep(make_scene, GRID, jobs=jobs, directory=folder)
        return found, time.perf_counter() - begun, processor() - used


def write(row):
    path = os.path.join(ROOT, "bench", "README.md")
    with open(path, encoding="utf-8") as file:
        page = file.read()
    made, count = re.subn(r"^\| 2000 \|.*$", row, page, flags=re.M)
    if count != 1:
        sys.exit("sweep: bench/README.md has no row of 2000 cases")
    with open(path, "w", encoding="utf-8") as file:
        file.write(made)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    sys.path.insert(0, os.path.join(os.path.abspath(options.build), "python"))
    import capstan

    first, elapsed, used = None, {1: [], 2: []}, {1: [], 2: []}
    for _ in range(options.turns):
        for jobs in (1, 2):
            found, wall, cpu = measured(capstan, jobs)
            first = found if first is None else first
            assert found.identical(first) and bool(found.certified.all())
            elapsed[jobs].append(wall)
            used[jobs].append(cpu)
            print(f"{found.certified.size} cases, {jobs} process{'es' if jobs > 1 else ''}: {wall:.2f} s elapsed, {cpu:.2f} s of processor; "
                  f"load {os.getloadavg()[0]:.1f}", flush=True)
    one, two = (min(elapsed[jobs]) for jobs in (1, 2))
    alone, shared = (min(used[jobs]) for jobs in (1, 2))
    row = (f"| {first.certified.size} | {one:.1f} s | {two:.1f} s | {one / two:.2f} | {alone:.1f} s | {shared:.1f} s | {alone / shared:.2f} | "
           f"{os.getloadavg()[0]:.1f} |")
    print("| cases | one process | two | times sooner | processor, one | two | ratio | load |")
    print(row)
    if options.write:
        write(row)


if __name__ == "__main__":
    main()
