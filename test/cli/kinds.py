#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every command given a file of another kind says what the file is and which command takes it, and that one does.

usage: kinds.py CAPSTAN EXAMPLES
"""
import glob
import os
import re
import subprocess
import sys
import tempfile

INPUT = 3
COMMANDS = {"run": "scene", "check": "scene", "study": "scene", "law": "law", "drive": "driven system"}

# of files that are nobody's, the key decides; keys of both kinds are the reader's own business
MADE = [
    ("check", "capstan: 1\nresistance: []\n", "found a law ('resistance'), which 'capstan law' takes; expected a scene"),
    ("law", "capstan: 1\nbody: 3\n", "found a driven system ('body'), which 'capstan drive' takes; expected a law"),
    ("run", "capstan: 1\nlaw: {}\nlines: {}\n", "unknown key 'law'"),
    ("law", "capstan: 1\nlaw: {disc: 1}\nlines: {}\n", "law file: unknown key 'lines'"),
    ("drive", "capstan: 1\nrope: {}\nlaw: {}\n", "drive file: unknown key 'law'"),
    ("check", "capstan: 1\n", "scene: 'lines' is missing"),
]


def main():
    capstan, examples = sys.argv[1:]
    folder = {"scene": ".", "law": "laws", "driven system": "drive"}
    failed = count = 0

    def run(command, path):
        with tempfile.TemporaryDirectory() as output:
            done = subprocess.run([capstan, command, path], cwd=output, capture_output=True, text=True, timeout=60)
            assert done.returncode != INPUT or not os.listdir(output), "a refused file leaves nothing behind"
        return done

    def expect(name, holds, found):
        nonlocal failed, count
        count += 1
        if not holds:
            failed += 1
            print(f"FAILED {name}: {found}")

    for kind, inside in folder.items():
        paths = sorted(glob.glob(os.path.join(examples, inside, "*.yaml")))
        assert paths, inside
        for path in paths:
            for command, takes in COMMANDS.items():
                if takes == kind:
                    continue
                done = run(command, path)
                wanted = re.escape(f"capstan: {path}:") + rf"\d+:1: found a {kind} \('[a-z]+'\), which 'capstan ([a-z]+)'.* takes?; expected a {takes}\n"
                said = re.fullmatch(wanted, done.stderr)
                expect(f"{command} {path}", done.returncode == INPUT and said and COMMANDS[said[1]] == kind, done.stderr)
    with tempfile.TemporaryDirectory() as made:
        path = os.path.join(made, "case.yaml")
        for command, text, message in MADE:
            with open(path, "w") as out:
                out.write(text)
            done = run(command, path)
            expect(f"{command} of {text!r}", done.returncode == INPUT and message in done.stderr, done.stderr)
    print(f"{count} cases, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
