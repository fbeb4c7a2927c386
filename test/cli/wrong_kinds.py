# SPDX-License-Identifier: BSD-3-Clause
"""Every value of scenes, laws and driven systems is replaced by values of other kinds: nothing, a word, a list, rows of unequal length, a mapping,
a number of the wrong sign. The file is refused with its name, line and column, or read; never anything else.   usage: wrong_kinds.py CAPSTAN EXAMPLES"""
import copy
import json
import os
import re
import subprocess
import sys

import yaml

sys.dont_write_bytecode = True
from checks import expect, run_in_an_empty_folder, write

CAPSTAN, EXAMPLES = (os.path.abspath(a) for a in sys.argv[1:3])
KINDS = (None, "", "x", True, -1, [], [1]*40, [[1], [2, 3]], [["x", 1], [None]], {}, {"x": 1})
# small ones that have many keys between them
FILES = [("check", "chain-wire-chain.yaml"), ("check", "grooved-slope.yaml"), ("law", "laws/towed-hull.yaml"), ("law", "laws/bipod.yaml"),
         ("drive", "drive/braked-wheel.yaml"), ("drive", "drive/two-feet.yaml"), ("drive", "drive/winch.yaml")]


def paths(value, before=()):
    """The places of all values in a document, but for the version; of the items of a list the first one."""
    for key, item in value.items() if isinstance(value, dict) else enumerate(value[:1]) if isinstance(value, list) else ():
        if key != "capstan":
            yield before + (key,)
            yield from paths(item, before + (key,))


def replaced(document, path, by):
    other = copy.deepcopy(document)
    place = other
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = by
    return other


def try_file(verb, name):
    with open(os.path.join(EXAMPLES, name), encoding="utf-8") as file:
        document = yaml.safe_load(file)
    count = refused = 0
    for path in paths(document):
        for by in KINDS:
            write("file.yaml", json.dumps(replaced(document, path, by), indent=1))  # JSON is YAML
            done = subprocess.run([CAPSTAN, verb, "file.yaml"], capture_output=True, text=True, timeout=100, check=False)
            where = f"{name}: {'.'.join(map(str, path))} = {by!r}"
            expect(f"{where}: exit code", done.returncode in (0, 1, 3, 5, 6), (done.returncode, done.stderr[-200:]))
            if done.returncode == 3:
                expect(f"{where}: message", re.match(r"capstan: file\.yaml:\d+:\d+: .+|capstan: file\.yaml: .+", done.stderr), done.stderr[:200])
                refused += 1
            count += 1
    expect(f"{name}: most are refused", refused > count // 2, (refused, count))
    return count, refused


def main():
    sums = [try_file(verb, name) for verb, name in FILES]
    print(f"{sum(count for count, _ in sums)} files, {sum(refused for _, refused in sums)} refused")


run_in_an_empty_folder(main, "wrong kinds: refused with a place, or read")
