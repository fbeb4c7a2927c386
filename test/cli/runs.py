# SPDX-License-Identifier: BSD-3-Clause
"""Runs of the command whose results are checked, copies of results with a number changed, and runs that are killed and resumed."""
import math
import os
import struct
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "property"))
from result_file import CODE, Results, SIZE  # noqa: E402


def command(*words):
    done = subprocess.run(words, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def write(folder, name, text):
    path = os.path.join(folder, name)
    with open(path, "w") as file:
        file.write(text)
    return path


def solve(capstan, checker, folder, text, wanted=(0,)):
    """The scene, the directory and the results of a run in which the checker finds nothing."""
    scene, out = write(folder, "scene.yaml", text), os.path.join(folder, "out")
    code, said = command(capstan, "run", scene, "-o", out, "--force")
    assert code in wanted, said
    code, said = command(checker, os.path.join(out, "result.nc"), scene, "-v")
    assert code == 0, said + text
    return scene, out, Results(os.path.join(out, "result.nc"))


def falsify(results, folder, variable, step, index, change):
    """Write copy.nc, in which a number is changed; step: None of a variable without steps."""
    _, kind, _, begin = results.variables[variable]
    data = bytearray(results.data)
    at = begin + (step*results.record if step is not None else 0) + index*SIZE[kind]
    value, = struct.unpack_from(">" + CODE[kind], data, at)
    assert not math.isnan(value), variable
    struct.pack_into(">" + CODE[kind], data, at, value + change)
    with open(os.path.join(folder, "copy.nc"), "wb") as file:
        file.write(data)


def falsify_attribute(folder, name, index, change):
    """Write copy.nc with a number of a global attribute changed: name, padded to 4 bytes, type, count, numbers (the format's specification)."""
    with open(os.path.join(folder, "result.nc"), "rb") as file:
        data = bytearray(file.read())
    head = struct.pack(">I", len(name)) + name.encode() + bytes(-len(name) % 4) + struct.pack(">I", 6)
    assert data.count(head) == 1, name
    at = data.index(head) + len(head) + 4 + 8*index
    value, = struct.unpack_from(">d", data, at)
    struct.pack_into(">d", data, at, value + change)
    with open(os.path.join(folder, "copy.nc"), "wb") as file:
        file.write(data)


def resumed(capstan, folder, text, journal_bytes, count, steps, names):
    """Killed when the journal has so many bytes and resumed, a run has the same numbers as one that was not, in these of `count` steps."""
    scene = write(folder, "long.yaml", text)
    whole, parts = os.path.join(folder, "whole"), os.path.join(folder, "parts")
    code, said = command(capstan, "run", scene, "-o", whole)
    assert code == 0, said
    run = subprocess.Popen([capstan, "run", scene, "-q", "-o", parts], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    journal = os.path.join(parts, ".journal")
    while run.poll() is None and not (os.path.exists(journal) and os.path.getsize(journal) > journal_bytes):
        time.sleep(0.001)
    assert run.poll() is None, "the run was over before it could be killed"
    run.kill()
    run.wait()
    code, said = command(capstan, "run", scene, "-o", parts, "--resume")
    assert code == 0, said
    one, other = Results(os.path.join(whole, "result.nc")), Results(os.path.join(parts, "result.nc"))
    assert one.steps == other.steps == count
    for step in steps:
        for name in names:
            assert one.get(name, step) == other.get(name, step), (name, step)
