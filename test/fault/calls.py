# SPDX-License-Identifier: BSD-3-Clause
"""Every system call that writes fails once, and from then on, at every place of a run, a resume and the other verbs.

After each: the exit code is one of the documented ones and a message says why; in the directory is the old set of files, the new set, or a
mixture that capstan itself recognises; and the same command once more ends with the new set and clears all that was left. Where it ends well
all of the standard output is there.

usage: calls.py REFUSE_CALLS CAPSTAN EXAMPLES [STRIDE]"""
import json
import os
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


def capstan(*command):
    return subprocess.run([CAPSTAN, *command], capture_output=True, text=True, timeout=60)


def refused(k, mode, code, command):
    done = subprocess.run([REFUSE, str(k), mode, str(code), "count", CAPSTAN, *command], capture_output=True, text=True, timeout=60)
    return done, int(read("count")) if os.path.exists("count") else -1


class Set:
    """A command that writes a set of files, with their summary, into the directory `out`: whose title begins with `new` then, and perhaps
    with `old` before it."""

    def __init__(self, command, summary="summary.json", earlier=None):
        self.command, self.summary, self.earlier = [*command, "-q", "-o", "out"], summary, earlier
        shutil.rmtree("out", ignore_errors=True)
        assert capstan(*self.command).returncode == 0 and self.title() == "new", command
        self.whole = set(os.listdir("out"))

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
        title = self.title()
        results = [name for name in os.listdir("out") if not name.startswith(".")] if os.path.isdir("out") else []
        if done.returncode == 0 and title != "new":
            faults.append(f"{what}: exit code 0, and the results there are {title}")
        if title is None and results and not self.is_told():
            faults.append(f"{what}: a mixture that is not recognised: {sorted(os.listdir('out'))[:6]}")
        if "earlier results are kept" in done.stderr and self.earlier and title != "old":
            faults.append(f"{what}: says 'earlier results are kept', and there is {title}")

    def mend(self, what):
        """The next run, with nothing refused, ends with the new set and leaves nothing of what was there."""
        told = self.is_told()
        done = capstan(*self.command, *(["--resume"] if os.path.exists("out/.journal") and "--resume" not in self.command else []))
        if done.returncode != 0 or self.title() != "new":
            faults.append(f"{what}: the next run: exit code {done.returncode}: {done.stderr[-200:]!r}")
            return
        if told and "not all of one run" not in done.stderr:
            faults.append(f"{what}: the next run does not say what it has found: {done.stderr!r}")
        left = set(os.listdir("out")) - self.whole
        if left:
            faults.append(f"{what}: left after the next run: {sorted(left)}")


def sweep(name, command, files=None):
    """One command with each of its calls refused, into copies of the directory of its Set."""
    global tried
    shutil.rmtree("out", ignore_errors=True)
    plain = None if files else capstan(*command)
    usual = 0 if files else plain.returncode
    for mode, code in (("once", EIO), ("on", ENOSPC)):
        k = 1
        while True:
            shutil.rmtree("out", ignore_errors=True)
            if files and files.earlier:
                shutil.copytree(files.earlier, "out")
            done, count = refused(k, mode, code, command)
            if done.returncode == 77:
                print("calls: programs cannot be traced here: skipped")
                sys.exit(77)
            if count < k:
                break
            what = f"{name}: call {k} of {count}, {mode}"
            if done.returncode not in (usual, 4, 6) or (done.returncode in (4, 6) and not done.stderr.strip()):
                faults.append(f"{what}: exit code {done.returncode}: {done.stderr[-200:]!r}")
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


def sweep_sets():
    run = ["run", "new.yaml"]
    sweep("a first run", [*run, "-q", "-o", "out"], Set(run))
    assert capstan("run", "old.yaml", "-q", "-o", "old").returncode == 0
    again = Set(run, earlier="old")
    sweep("a run over an earlier one", again.command, again)
    # a run that could not put its files in place has left its journal
    shutil.copytree("old", "stopped")
    os.unlink("stopped/plan.svg")
    os.mkdir("stopped/plan.svg")
    assert capstan(*run, "-q", "-o", "stopped").returncode == 4 and os.path.exists("stopped/.journal")
    os.rmdir("stopped/plan.svg")
    shutil.copy("old/plan.svg", "stopped/plan.svg")
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
    write("law.yaml", "capstan: 1\nlaw: {disc: 1}\n")
    write("nodes.csv", "".join(f"{x},0,0\n" for x in (0, 0.275, 0.55, 0.825, 1.1)))
    disc = f"{EXAMPLES}/drive/disc.yaml"
    for command in (["law", "law.yaml", "--plot", "out.svg"], ["law", "law.yaml", "-v", "1,0", "--json"], ["drive", disc, "--plot", "out.svg"], ["drive", disc],
                    ["study", "frozen.yaml", "--judge", "nodes.csv"], ["check", "new.yaml"], ["schema"], ["schema", "drive"], ["run", "--help"], ["--version"]):
        sweep(" ".join(os.path.basename(word) for word in command), command)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
    os.chdir("/")
print("\n".join(faults[:40]) or f"calls: {tried} refused, every one recognised")
sys.exit(1 if faults else 0)
