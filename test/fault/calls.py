# SPDX-License-Identifier: BSD-3-Clause
"""Every system call on files fails once, and from then on, at every place of a run, a resume and every other verb; and what writes a set of files
is killed before each of them.

After each: the exit code is one of the documented ones and a message says why; in the directory is the old set of files, the new set, or a
mixture that capstan itself recognises; and the same command once more ends with the new set and clears all that was left. Where it ends well
all of the standard output is there.

usage: calls.py REFUSE_CALLS CAPSTAN EXAMPLES [STRIDE]"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../cli"))
from checks import faults, read, write

REFUSE, CAPSTAN, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:4])
STRIDE = int(sys.argv[4]) if len(sys.argv) > 4 else 1
EIO, ENOSPC = 5, 28
SCENE = """capstan: 1
title: TITLE
obstacles:
  bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.5}
lines:
  rope: {length: 1, elements: 4, weight: 1, stiffness: 100, start: {straight: {from: [0, 0, 0], to: [1, 0, 0]}}, ends: {A: held, B: held}}
history:
  - {name: out, rope.B: {position: [1.1, 0, 0]}, steps: STEPS}
"""
tried = 0


def capstan(*command, given=""):
    return subprocess.run([CAPSTAN, *command], input=given, capture_output=True, text=True, timeout=60)


def refused(k, mode, code, command, given=""):
    # with the sanitizer of addresses: what it looks for leaks with does not work in a process that is traced
    done = subprocess.run([REFUSE, str(k), mode, str(code), "count", CAPSTAN, *command], input=given, capture_output=True, text=True, timeout=60,
                          env={**os.environ, "ASAN_OPTIONS": "detect_leaks=0"})
    return done, int(read("count")) if os.path.exists("count") else -1


def contents(folder):
    """{name: bytes} of the files that a listing shows."""
    names = os.listdir(folder) if os.path.isdir(folder) else []
    return {name: read(f"{folder}/{name}") for name in names if not name.startswith(".")}


class Set:
    """A command that writes a set of files, with their summary, into the directory `out`: whose title begins with `new` then, and perhaps
    with `old` before it. `earlier`: a copy of that directory as it is before; `given`: the command's standard input."""

    def __init__(self, command, summary="summary.json", earlier=None, given=""):
        self.command, self.summary, self.earlier, self.given = [*command, "-q", "-o", "out"], summary, earlier, given
        self.before = contents(earlier) if earlier else {}
        self.begin()
        assert capstan(*self.command, given=given).returncode == 0 and self.title() == "new", command
        self.whole = set(os.listdir("out"))

    def begin(self):
        shutil.rmtree("out", ignore_errors=True)
        if self.earlier:
            shutil.copytree(self.earlier, "out")

    def title(self):
        """Of the set that is whole: its summary is there, and every file that it lists."""
        try:
            summary = json.loads(read(f"out/{self.summary}"))
            for entry in summary["files"]:
                data = read(f"out/{entry['name']}")
                if len(data) != entry["bytes"] or f"{zlib.crc32(data):08x}" != entry["crc32"]:
                    return None
        except (OSError, ValueError, KeyError):
            return None
        return summary["title"][:3]

    def is_told(self):
        """Does .capstan say that files were being put in place, with the last one missing?"""
        lines = read("out/.capstan").decode().splitlines() if os.path.exists("out/.capstan") else []
        return f"x {self.summary}" in lines and not os.path.exists(f"out/{self.summary}")

    def judge(self, what, done):
        """The directory after a run that a refused call went through."""
        title, found = self.title(), contents("out")
        if done.returncode == 0 and title != "new":
            faults.append(f"{what}: exit code 0, and the results there are {title}")
        if title != "new" and found != self.before and not self.is_told():
            faults.append(f"{what}: a mixture that is not recognised: {sorted(found)[:6]}")
        if "earlier results are kept" in done.stderr and found != self.before:
            faults.append(f"{what}: says 'earlier results are kept', and there is {title}")

    def mend(self, what):
        """The next run, with nothing refused, ends with the new set and leaves nothing of what was there."""
        told = self.is_told()
        goes_on = os.path.exists("out/.journal") and not {"--resume", "--force"} & set(self.command)
        done = capstan(*self.command, *(["--resume"] if goes_on else []), given=self.given)
        if done.returncode != 0 or self.title() != "new":
            faults.append(f"{what}: the next run: exit code {done.returncode}: {done.stderr[-200:]!r}")
            return
        if told and "not all of one run" not in done.stderr:
            faults.append(f"{what}: the next run does not say what it has found: {done.stderr!r}")
        left = set(os.listdir("out")) - self.whole
        if left:
            faults.append(f"{what}: left after the next run: {sorted(left)}")


def sweep(name, command, files=None, given=""):
    """One command with each of its calls refused, into copies of the directory of its Set."""
    global tried
    plain = None if files else capstan(*command, given=given)
    usual = 0 if files else plain.returncode
    for mode, code in (("once", EIO), ("on", ENOSPC), *([("kill", EIO)] if files else [])):
        k = 1
        while True:
            if files:
                files.begin()
            done, count = refused(k, mode, code, command, given)
            if done.returncode == 77:
                print("calls: programs cannot be traced here: skipped")
                sys.exit(77)
            if count < k:
                break
            what = f"{name}: call {k} of {count}, {mode}"
            if mode == "kill":
                if done.returncode != 128 + 9:
                    faults.append(f"{what}: exit code {done.returncode}")
            elif done.returncode not in (usual, 4, 6) or (done.returncode in (4, 6) and not done.stderr.strip()):
                faults.append(f"{what}: exit code {done.returncode}: {done.stderr[-200:]!r}")
            if files and done.returncode == 4 and not re.search(r"\bout\b|libnetcdf|standard output|standard input|new\.yaml|frozen\.yaml", done.stderr):
                faults.append(f"{what}: names no place: {done.stderr!r}")
            if files:
                files.judge(what, done)
                files.mend(what)
            elif done.returncode == usual and done.stdout != plain.stdout:
                faults.append(f"{what}: exit code {usual}, and not all has been said: {done.stdout[-80:]!r}")
            if os.path.exists("out.svg") and not read("out.svg").rstrip().endswith(b"</svg>"):
                faults.append(f"{what}: half a picture")
            tried += 1
            k += STRIDE
    print(f"{name}: {count} calls, {len(faults)} faults", flush=True)


def sweep_foreign():
    """A directory that is somebody else's: refused, or its files are kept but for those that have names of results."""
    os.mkdir("foreign")
    write("foreign/notes.txt", "mine")
    command = ["run", "new.yaml", "-q", "-o", "foreign"]
    sweep("a directory of somebody else's", command)
    if contents("foreign") != {"notes.txt": b"mine"} or set(os.listdir("foreign")) != {"notes.txt"}:
        faults.append(f"a directory of somebody else's: {sorted(os.listdir('foreign'))}")
    write("foreign/history.csv", "mine, too")
    forced = Set(["run", "new.yaml", "--force"], earlier="foreign")
    sweep("run --force in it", forced.command, forced)


def sweep_sets():
    run = ["run", "new.yaml"]
    for words, given in ((run, ""), (["run", "-"], read("new.yaml").decode()), ([*run, "--sync", "end", "--json"], "")):
        first = Set(words, given=given)
        sweep("a first " + " ".join(words), first.command, first, given)
    assert capstan("run", "old.yaml", "-q", "-o", "old").returncode == 0
    again = Set(run, earlier="old")
    sweep("a run over an earlier one", again.command, again)
    # a run that could not put its files in place has left its journal: one of its last calls was refused
    k = refused(0, "once", EIO, [*run, "-q", "-o", "stopped"])[1]
    while contents("stopped") != contents("old") or not os.path.exists("stopped/.journal"):
        shutil.rmtree("stopped")
        shutil.copytree("old", "stopped")
        refused(k, "once", EIO, [*run, "-q", "-o", "stopped"])
        k -= 1
    assert k > 0
    on = Set([*run, "--resume"], earlier="stopped")
    sweep("a run that goes on", on.command, on)
    for words, summary in ((["run", "--method", "regularized"], "summary.json"), (["study"], "study.json"),
                           (["study", "--history"], "methods.json"), (["study", "--complete", "straight"], "completed.json")):
        folder = "old-" + summary + "-" + words[0]
        assert capstan(words[0], "frozen-old.yaml", *words[1:], "-q", "-o", folder).returncode == 0
        files = Set([words[0], "frozen.yaml", *words[1:]], summary, folder)
        sweep(" ".join(words) + " over an earlier one", files.command, files)


def main():
    write("old.yaml", SCENE.replace("TITLE", "old").replace("STEPS", "3"))
    write("new.yaml", SCENE.replace("TITLE", "new").replace("STEPS", "2"))
    for title, name in (("old", "frozen-old.yaml"), ("new", "frozen.yaml")):
        write(name, SCENE.replace("TITLE", title).replace("STEPS", "1") + "friction_policy: frozen\n")
    sweep_sets()
    sweep_foreign()
    write("law.yaml", "capstan: 1\nlaw: {disc: 1}\n")
    write("nodes.csv", "".join(f"{x},0,0\n" for x in (0, 0.275, 0.55, 0.825, 1.1)))
    shutil.copytree(f"{EXAMPLES}/drive", "drive")
    rows = "1,0\n0,1\n"
    for command, given in (("law law.yaml --plot out.svg", ""), ("law law.yaml -v 1,0 --json", ""), ("law law.yaml -v -", rows),
                           ("drive drive/disc.yaml --plot out.svg", ""), ("drive drive/disc.yaml --json", ""),
                           ("drive drive/planimeter.yaml -q", ""), ("drive drive/rope-arc.yaml -q --plot out.svg", ""),
                           ("drive drive/plate.yaml --eliminate", ""),
                           ("study frozen.yaml --judge nodes.csv", ""), ("check new.yaml", ""), ("check -", read("new.yaml").decode()),
                           ("check none.yaml", ""), ("schema", ""), ("schema law", ""), ("schema drive", ""), ("run --help", ""), ("--version", "")):
        sweep(command, command.split(), given=given)


# in memory where there is such a place: every command waits for its disk
with tempfile.TemporaryDirectory(dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None) as folder:
    os.chdir(folder)
    main()
    os.chdir("/")
print("\n".join(faults[:40]) or f"calls: {tried} refused, every one recognised")
sys.exit(1 if faults else 0)
