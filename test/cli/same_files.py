# SPDX-License-Identifier: BSD-3-Clause
"""Are the results in two directories the same, byte by byte, but for the times of steps and of the beginning?"""
import csv
import os
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../property"))
from checks import read
from result_file import Results

# in a summary, what a run takes, and what follows from it
TIMES = rb'"wall_s": [0-9.e+-]+|"crc32": "[0-9a-f]+"|"bytes": [0-9]+'


def results_without_times(path):
    """The bytes of result.nc, the times of its steps and of its beginning blanked."""
    results, data = Results(path), bytearray(read(path))
    _, _, _, begin = results.variables["wall"]
    for step in range(results.steps):
        at = begin + step*results.record
        data[at:at + 8] = bytes(8)
    return re.sub(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", b"", bytes(data))


def without_times(path):
    """What is compared of a file."""
    if path.endswith("result.nc"):
        return results_without_times(path)
    if not path.endswith("history.csv"):
        return re.sub(TIMES, b"", read(path)) if path.endswith("summary.json") else read(path)
    with open(path, newline="", encoding="utf-8") as file:
        return [[cell for key, cell in row.items() if key != "wall"] for row in csv.DictReader(file)]


def differences(one, two):
    """The names of files that differ between two directories, or are in one of them only."""
    names = sorted(set(os.listdir(one)) | set(os.listdir(two)))
    paths = [[os.path.join(folder, name) for folder in (one, two)] for name in names]
    return [name for name, (a, b) in zip(names, paths)
            if not (os.path.exists(a) and os.path.exists(b)) or without_times(a) != without_times(b)]
