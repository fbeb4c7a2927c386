# SPDX-License-Identifier: BSD-3-Clause
"""What `run` says of a line for which there is no configuration, with numbers computed here, and how text that is not the program's
own is printed, against the decoder of Python.                                                        usage: messages.py CAPSTAN"""
import codecs
import json
import math
import os
import random
import re
import signal
import subprocess
import sys
import unicodedata

sys.dont_write_bytecode = True
from checks import expect, run_in_an_empty_folder, write

CAPSTAN = os.path.abspath(sys.argv[1])
SCENE = """capstan: 1
%s
lines:
  rope: {length: %r, elements: %d, weight: 1, stiffness: .inf, start: {straight: {from: [0, 0, %r], to: [%r, 0, %r]}}, ends: {A: held, B: held}}
history: [{name: away, rope.B: {position: %r}}]
"""
NUMBER = r"(-?[0-9][-+.e0-9]*)"


def run(text):
    write("scene.yaml", text)
    done = subprocess.run([CAPSTAN, "run", "scene.yaml", "-q", "--force", "-o", "out"], capture_output=True, text=True, timeout=60, check=False)
    expect("no configuration: exit code", done.returncode == 5, (done.returncode, done.stderr))
    return done.stderr


def near(what, found, expected):
    expect(what, abs(found - expected) <= 1e-3*(1 + abs(expected)), (found, expected))


def too_far():
    """Ends farther apart than the line is long, along each axis and aslant."""
    for to in ([5, 0, 1], [0, 4, 1], [0, 0, 8], [3, -4, 2]):
        message = run(SCENE % ("gravity: [0, 0, -9.81]", 2.0, 10, 1.0, 2.0, 1.0, to))
        found = re.search(rf"by {NUMBER} m along \({NUMBER}, {NUMBER}, {NUMBER}\)", message)
        expect(f"{to}: sentence", found is not None, message)
        if not found:
            continue
        away = [to[0], to[1], to[2] - 1]
        distance = math.hypot(*away)
        near(f"{to}: excess", float(found[1]), distance - 2)
        for k in range(3):
            near(f"{to}: direction", float(found[2 + k]), away[k]/distance)


def too_short_round_a_pipe():
    """The shortest path from one end round a pipe to the other: two tangents and an arc."""
    obstacle = "obstacles: {pipe: {cylinder: {point: [0, 0, 0], axis: [0, 1, 0], radius: 1}, friction: 0.1}}"
    text = SCENE % (obstacle, 4.2, 60, 1.3, 2.0, 1.3, [2, 0, 0.5])
    text = text.replace("from: [0, 0, 1.3], to: [2.0, 0, 1.3]", "from: [-2.1, 0, 1.3], to: [2.1, 0, 1.3]").replace("rope.B: {position: [2, 0, 0.5]}", "rope.A: {position: [-2, 0, -1]}, rope.B: {position: [2, 0, -1]}")
    message = run(text)
    found = re.search(rf"by {NUMBER} m along", message)
    expect("round a pipe: sentence", found is not None and "round obstacle pipe" in message, message)
    far = math.sqrt(5)
    path = 2*math.sqrt(far*far - 1) + 2*(math.pi/2 + math.asin(1/far) - math.acos(1/far))
    if found:
        near("round a pipe: excess", float(found[1]), path - 4.2)


def shown(data):
    """What may be printed of these bytes: a question mark for each that is no UTF-8, and for each character that controls a terminal
    or the order of the text."""
    codecs.register_error("each", lambda error: ("?"*(error.end - error.start), error.end))
    text = data.decode("utf-8", "each")
    controls = "\u061c\u200e\u200f\u2028\u2029\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"
    return "".join("?" if c in controls or unicodedata.category(c) == "Cc" else c for c in text)


def foreign_text():
    dice = random.Random(4)
    pieces = [b"a", b"\xc3\xa9", b"\xe2\x82\xac", b"\xf0\x9f\x98\x80", b"\xc2\x85", b"\xc2\xa0", b"\x1b[31m", b"\x7f", b"\xd8\x9c", b"\xe2\x80\x8e",
              b"\xe2\x80\x90", b"\xe2\x80\xa8", b"\xe2\x80\xae", b"\xe2\x80\xaf", b"\xe2\x81\xa4", b"\xe2\x81\xa6", b"\xe2\x81\xaa", b"\xf4\x8f\xbf\xbd",
              b"\xf4\x90\x80\x80", b"\xf5\x80\x80\x80", b"\xe0\x80\x80", b"\xe0\xa0\x80", b"\xf0\x80\x80\x80", b"\xf0\x90\x80\x80", b"\xed\xa0\x80",
              b"\xed\x9f\xbf", b"\xc0\x80", b"\xc1\xbf", b"\x80", b"\xff", b"\xe2\x80", b"\xf0\x9f"]
    for _ in range(300):
        given = b"".join(dice.choice(pieces) for _ in range(dice.randint(1, 12)))
        if given.startswith(b"-"):
            continue
        done = subprocess.run([CAPSTAN.encode(), given], capture_output=True, timeout=60, check=False)
        found = done.stderr.decode("utf-8")
        expect("text is printed as it may be", "'" + shown(given) + "'" in found, (given, found, shown(given)))


ROPE = """capstan: 1
%s
lines:
  rope: {length: 2, elements: 10, weight: 1, stiffness: 100, start: {straight: {from: %r, to: %r}}, ends: {A: held, B: held}}
history: [{name: pull, steps: %d, rope.B: {move: [0.1, 0, 0]}}]
"""
BALL = "obstacles: {ball: {sphere: {centre: [0, 0, -9], radius: 1}, friction: 0.1}}"


def command(*arguments, **more):
    return subprocess.run([CAPSTAN, *arguments], capture_output=True, text=True, timeout=60, check=False, **more)


def other_sentences():
    done = command()
    expect("no command: usage", done.returncode == 2 and "usage" in done.stderr, done.stderr)
    for far in ([1e5, 0, 0], [0, 1e5, 0], [0, 0, 1e5]):
        write("far.yaml", ROPE % ("", far, [far[0] + 2, far[1], far[2]], 1))
        done = command("run", "far.yaml", "-o", "far", "--force", "--no-paraview")
        found = re.search(rf"measured from \({NUMBER}, {NUMBER}, {NUMBER}\)", done.stdout)
        expect(f"{far}: origin", found and max(abs(float(found[k + 1]) - far[k]) for k in range(3)) < 1e4, done.stdout[-300:])
    done = command("run", "-", "-q", "--no-paraview", input=ROPE % ("", [0, 0, 0], [2, 0, 0], 1))
    expect("from standard input: its own directory", done.returncode == 0 and os.path.exists("results/scene/summary.json"), done.stderr)
    write("ball.yaml", ROPE % (BALL, [0, 0, 0], [2, 0, 0], 1))
    for verb in (("run", "--method", "regularized"), ("study",), ("study", "--history")):
        done = command(verb[0], "ball.yaml", *verb[1:], "-q", "-o", "none")
        expect(f"{verb}: not for a ball", done.returncode == 3 and "curved" in done.stderr and not os.path.exists("none"), (done.returncode, done.stderr))


def two_coefficients():
    """The methods of 1990 have one coefficient of friction."""
    planes = "obstacles: {a: {plane: {}, friction: 0.1}, b: {plane: {point: [0, 0, -5]}, friction: 0.2}}"
    write("planes.yaml", ROPE % (planes, [0, 0, 0], [2, 0, 0], 1))
    for verb in (("run", "--method", "regularized"), ("study", "--history")):
        done = command(verb[0], "planes.yaml", *verb[1:], "-q", "-o", "none")
        expect(f"{verb}: not for two planes", done.returncode == 3 and not os.path.exists("none"), (done.returncode, done.stderr))
    name = "a name that is longer than its column in the table"
    write("named.yaml", (ROPE % ("", [0, 0, 0], [2, 0, 0], 1)).replace("pull", name))
    done = command("run", "named.yaml", "-o", "named", "--no-paraview")
    expect("a long name is cut", name[:18] in done.stdout and name not in done.stdout.split("results")[0], done.stdout[-600:])


def stopped_before_the_disk():
    """A run that waits for the disk only at its end, stopped: its steps are there all the same."""
    write("long.yaml", ROPE % ("", [0, 0, 0], [2, 0, 0], 20000))
    process = subprocess.Popen([CAPSTAN, "run", "long.yaml", "-o", "long", "--no-paraview", "--fields", "none", "--sync", "end"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    journal = "long/.journal"
    while process.poll() is None and not (os.path.exists(journal) and os.path.getsize(journal) > 100000):
        pass
    process.send_signal(signal.SIGTERM)
    said = process.communicate(timeout=60)[1]
    expect("stopped: code and words", process.returncode == 143 and "--resume goes on" in said, (process.returncode, said))
    steps = int((re.search(r"after (\d+) of", said) or "00")[1])
    with open("long/summary.json", encoding="utf-8") as file:
        expect("stopped: as many steps as said", len(json.load(file)["steps"]) == steps > 0, steps)


def main():
    for part in (other_sentences, two_coefficients, stopped_before_the_disk, too_far, too_short_round_a_pipe, foreign_text):
        part()


run_in_an_empty_folder(main, "messages: lines without a configuration, text that is not the program's own")
