# SPDX-License-Identifier: BSD-3-Clause
"""The journal of a run: what is found under its name, journals of others, cut, spoilt and crafted ones.

usage: journal.py CAPSTAN"""
import csv
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

from checks import expect, faults, read, write

CAPSTAN = os.path.abspath(sys.argv[1])
HEAD, RECORD = 104, 16  # bytes before the first record, and before its state
SCENE = """capstan: 1
obstacles:
  bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}
  post: {cylinder: {point: [4, 2, 0], axis: [0, 0, 1], radius: 0.5}, friction: 0.1}
lines:
  rope: {length: 8, elements: 24, weight: 20, stiffness: 1e5, start: {straight: {from: [0, 0, 0], to: [8, 0, 0]}}, ends: {A: held, B: held}}
  tail: {length: 2, elements: 6, weight: 20, stiffness: .inf, start: {straight: {from: [0, -3, 0], to: [2, -3, 0]}}, ends: {A: held, B: free}}
history:
  - {name: move, steps: 25, rope.B: {position: [7.5, 2.5, 0]}}
  - {name: pull, steps: 5, tail.B: {force: [1, 0.5, 0]}}
"""


def history(out):
    with open(f"{out}/history.csv", newline="", encoding="utf-8") as table:
        return [{key: value for key, value in row.items() if key != "wall"} for row in csv.DictReader(table)]


def run(out, *more, code=0, scene="scene.yaml"):
    done = subprocess.run([CAPSTAN, "run", scene, "-q", "--sync", "end", "--no-paraview", "--fields", "none", "-o", out, *more], capture_output=True, text=True,
                          timeout=600)  # from a crafted place a step may take its thousand parts, some 10 s
    if code is not None:
        expect(f"run {out} {more}: exit code {done.returncode}, expected {code}", done.returncode == code, done.stderr[-300:])
    return done


def interrupted():
    """The journal of a run that was killed after a few steps."""
    process = subprocess.Popen([CAPSTAN, "run", "scene.yaml", "-q", "-o", "killed"], stderr=subprocess.DEVNULL)
    while process.poll() is None and not (os.path.exists("killed/.journal") and os.path.getsize("killed/.journal") > 100000):
        time.sleep(0.0005)
    process.send_signal(signal.SIGKILL)
    process.wait()
    return read("killed/.journal")


def checksum(data):
    value = 14695981039346656037
    data = data + bytes(-len(data) % 8)
    for (word,) in struct.iter_unpack("<Q", data):
        value = (value ^ word) * 1099511628211 % 2**64
    return value


def record(step, state):
    number = struct.pack("<Q", step)
    return number + struct.pack("<Q", checksum(number + state)) + state


def resume(journal, out="resumed", code=0, scene="scene.yaml"):
    """A folder of its own with this journal."""
    shutil.rmtree(out, ignore_errors=True)
    run(out)
    write(f"{out}/.journal", journal)
    return run(out, "--resume", code=code, scene=scene)


def taken(done):
    return int(done.stderr.split(" of ")[0].split()[-1]) if "were done before" in done.stderr else -1


def foreign():
    """What is no journal stays as it is, and no link is followed."""
    run("foreign")
    for what, content in (("notes", b"my notes\n"), ("zeros", bytes(300)), ("short", b"x")):
        write("foreign/.journal", content)
        for more in ([], ["--resume"], ["--force"]):
            done = run("foreign", *more, code=4)
            expect(f"{what}: why", "no journal of capstan" in done.stderr, done.stderr)
            expect(f"{what} {more}: lost", read("foreign/.journal") == content)
    os.unlink("foreign/.journal")
    write("mine", b"mine")
    for target in ("../mine", "../missing", os.path.abspath("mine")):
        os.symlink(target, "foreign/.journal")
        for more in ([], ["--resume"], ["--force"]):
            done = run("foreign", *more, code=4)
            expect(f"link to {target}: why", "link" in done.stderr, done.stderr)
            expect(f"link to {target}: changed", read("mine") == b"mine" and not os.path.exists("missing")
                   and os.path.islink("foreign/.journal"))
        os.unlink("foreign/.journal")
    os.mkfifo("foreign/.journal")
    run("foreign", code=4)
    expect("pipe: gone", os.path.exists("foreign/.journal"))
    os.unlink("foreign/.journal")
    write("foreign/.journal", b"")  # of a run that was killed in its first moment
    run("foreign")


def kept(journal):
    """A run without --resume does not take the steps of an interrupted one away, unless it is told to."""
    done = run("killed", code=4)
    expect("interrupted: why", "--resume" in done.stderr and "--force" in done.stderr, done.stderr)
    expect("interrupted: lost", read("killed/.journal") == journal)
    run("killed", "--force")
    expect("anew: a journal is left", not os.path.exists("killed/.journal"))


def cut_and_spoilt(journal, size):
    """The journal ends where no whole record follows, whatever lies there, and the run goes on from it to the same numbers."""
    records = (len(journal) - HEAD) // size
    expect("records", records >= 4, records)
    whole = journal[:HEAD + 3 * size]
    run("whole")
    numbers = history("whole")
    for what, tail in (("nothing", b""), ("zeros", bytes(5000)), ("ones", b"\xff" * 5000), ("noise", random.Random(3).randbytes(5000)),
                       ("a zero", b"\0"), ("half a record", journal[HEAD + 3 * size:HEAD + 4 * size - 9]),
                       ("a record of another step", journal[HEAD + size:HEAD + 3 * size]),
                       ("zeros and a record", bytes(size) + journal[HEAD + 3 * size:HEAD + 4 * size])):
        done = resume(whole + tail)
        expect(f"tail of {what}", taken(done) == 3, done.stderr)
        expect(f"tail of {what}: other numbers", history("resumed") == numbers)
    done = resume(journal[:HEAD])
    expect("head alone", taken(done) == 0, done.stderr)
    done = resume(journal[:HEAD - 5])
    expect("head cut short", taken(done) == 0, done.stderr)


def others(journal):
    """Journals of another scene, program or build are refused and stay."""
    write("other.yaml", SCENE.replace("0.5, 0]", "0.4, 0]"))
    done = resume(journal, code=3, scene="other.yaml")
    expect("another scene", "another scene" in done.stderr, done.stderr)
    expect("another scene: lost", read("resumed/.journal") == journal)
    head = bytearray(journal[:HEAD])
    head[72] ^= 1  # the checksum of the build
    head[-8:] = struct.pack("<Q", checksum(bytes(head[:-8])))
    done = resume(bytes(head) + journal[HEAD:], code=3)
    expect("another build", "another program" in done.stderr, done.stderr)
    head[73] ^= 1
    done = resume(bytes(head) + journal[HEAD:], code=3)
    expect("damaged head", "damaged" in done.stderr, done.stderr)


def crafted(journal, size, count):
    """States that no run has written, with checksums that fit: refused or run to the end, but no crash and no endless loop."""
    state = journal[HEAD + RECORD:HEAD + size]
    seed = int(os.environ.get("CAPSTAN_SEED", "7"))
    rng = random.Random(seed)
    values = [struct.pack("<i", v) for v in (-1, -2, 1, 2, 3, 7, 8, 10**6, 2**31 - 1, -2**31)] + \
             [struct.pack("<d", v) for v in (float("nan"), float("inf"), -float("inf"), 1e308, -1.0, 0.0)] + [b"\xff", b"\x03", b"\x00" * 16]
    refused = 0
    for i in range(count):
        bytes_ = bytearray(state)
        # counters, indices and kinds of the history stand first: a large or a negative number in every place there, then anything anywhere
        for _ in range(1 if i < 150 else 1 + i % 3):
            value = struct.pack("<i", rng.choice((10**6, -7))) if i < 150 else rng.choice(values)
            at = 24 + 4 * i if i < 150 else rng.randrange(0, len(state) - len(value))
            bytes_[at:at + len(value)] = value
        shutil.rmtree("crafted", ignore_errors=True)
        os.mkdir("crafted")
        write("crafted/.capstan", "capstan directory 1\n")
        write("crafted/.journal", journal[:HEAD] + record(0, bytes(bytes_)))
        done = run("crafted", "--resume", code=None)
        if done.returncode not in (0, 1, 3, 5) or (done.returncode == 3 and "state" not in done.stderr and "order" not in done.stderr):
            faults.append(f"crafted state {i}, seed {seed}: exit code {done.returncode}: {done.stderr[-300:]!r}")
        refused += done.returncode == 3
    expect("crafted states: refused", refused > count // 10, refused)
    print(f"{count} crafted states, {refused} refused")


def same_bytes(journal):
    """Two runs write the same journal but for times: no address, nothing uninitialised."""
    # the time of the step is the last number of its report
    shutil.rmtree("killed", ignore_errors=True)
    again = interrupted()
    n = min(len(journal), len(again)) - 4000
    differ = [i for i in range(n) if journal[i] != again[i]]
    size = record_size(journal)
    places = {(i - HEAD) % size for i in differ if i >= HEAD}
    expect("two runs: heads", not differ or differ[0] >= HEAD, differ[:3])
    # in a record: its checksum, and the wall time, 8 bytes
    wall = {p // 8 for p in places if p >= RECORD}
    expect("two runs: bytes that differ", len(wall) <= 2 and (not wall or max(wall) - min(wall) <= 1), sorted(wall))


def record_size(journal):
    return RECORD + struct.unpack("<Q", journal[88:96])[0]


def main():
    write("scene.yaml", SCENE)
    journal = interrupted()
    size = record_size(journal)
    same_bytes(journal)
    foreign()
    journal = read("killed/.journal")
    kept(journal)
    cut_and_spoilt(journal, size)
    others(journal)
    crafted(journal, size, int(sys.argv[2]) if len(sys.argv) > 2 else 200)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
    os.chdir("/")
print("\n".join(faults) or "journal: links, files of others, cut, spoilt and crafted ones")
sys.exit(1 if faults else 0)
