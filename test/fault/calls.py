# SPDX-License-Identifier: BSD-3-Clause
"""Every system call that writes fails once, and from then on, at every place of a run, a resume and the other verbs that write.

After each: the exit code is one of the documented ones and a message says why; in the directory is the old set of results, the new set, or a
mixture that capstan itself recognises; and the next run ends with the new set and clears all that was left.

usage: calls.py REFUSE_CALLS CAPSTAN EXAMPLES [STRIDE]"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import zlib

REFUSE, CAPSTAN, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:4])
STRIDE = int(sys.argv[4]) if len(sys.argv) > 4 else 1
EIO, ENOSPC = 5, 28
SCENE = """capstan: 1
title: TITLE
obstacles:
  bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.5}
lines:
  rope: {length: 1, elements: 4, weight: 1, stiffness: 100, start: {straight: {from: [0, 0, 0], to: [1, 0, 0]}}, ends: {A: fixed, B: fixed}}
history:
  - {name: out, rope.B: {position: [1.1, 0, 0]}, steps: STEPS}
"""
faults, tried = [], 0


def write(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


def read(name):
    with open(name, "rb") as file:
        return file.read()


def capstan(*command):
    return subprocess.run([CAPSTAN, *command], capture_output=True, text=True, timeout=60)


def refused(k, mode, code, command):
    done = subprocess.run([REFUSE, str(k), mode, str(code), "count", CAPSTAN, *command], capture_output=True, text=True, timeout=60)
    return done, int(read("count")) if os.path.exists("count") else -1


def title_of(folder):
    """The title of the set of results that is whole in the folder: the summary is there, and every file that it lists."""
    try:
        summary = json.loads(read(f"{folder}/summary.json"))
        for entry in summary["files"]:
            data = read(f"{folder}/{entry['name']}")
            if len(data) != entry["bytes"] or f"{zlib.crc32(data):08x}" != entry["crc32"]:
                return None
    except (OSError, ValueError, KeyError):
        return None
    return summary["title"]


def results_in(folder):
    return [name for name in os.listdir(folder) if not name.startswith(".")] if os.path.isdir(folder) else []


def is_told(folder):
    """Does .capstan say that files were being put in place, with the last one missing?"""
    lines = read(f"{folder}/.capstan").decode().splitlines() if os.path.exists(f"{folder}/.capstan") else []
    last = [line[2:] for line in lines if line.startswith("x ")]
    return bool(last) and not os.path.exists(f"{folder}/{last[0]}")


def judge(what, done, earlier, out):
    """The state of the directory after a run that a refused call went through."""
    if done.returncode not in (0, 4, 6) or (done.returncode != 0 and not done.stderr.strip()):
        faults.append(f"{what}: exit code {done.returncode}: {done.stderr[-200:]!r}")
    title = title_of(out)
    if done.returncode == 0 and title != "new":
        faults.append(f"{what}: exit code 0, and the results there are {title}")
    if title is None and results_in(out) and not is_told(out):
        faults.append(f"{what}: a mixture that is not recognised: {sorted(os.listdir(out))[:6]}")
    if "earlier results are kept" in done.stderr and earlier and title != earlier:
        faults.append(f"{what}: says 'earlier results are kept', and there is {title}")
    return title


def mend(what, title, out):
    """The next run, with nothing refused, ends with the new set and leaves nothing of what was there."""
    journal = os.path.exists(f"{out}/.journal")
    told = is_told(out)
    done = capstan("run", "new.yaml", "-q", "-o", out, *(["--resume"] if journal else []))
    if done.returncode != 0 or title_of(out) != "new":
        faults.append(f"{what}: the next run: exit code {done.returncode}: {done.stderr[-200:]!r}")
        return
    if told and "not all of one run" not in done.stderr:
        faults.append(f"{what}: the next run does not say what it has found: {done.stderr!r}")
    left = set(os.listdir(out)) - WHOLE
    if left:
        faults.append(f"{what}: left after the next run: {sorted(left)}")


def sweep(name, template, command, earlier, judged=judge, mended=mend):
    """One command with each of its calls refused, into copies of a directory."""
    global tried
    for mode, code in (("once", EIO), ("on", ENOSPC)):
        k = 1
        while True:
            shutil.rmtree("out", ignore_errors=True)
            if template:
                shutil.copytree(template, "out")
            done, count = refused(k, mode, code, command)
            if done.returncode == 77:
                print("calls: programs cannot be traced here: skipped")
                sys.exit(77)
            if count < k:
                break
            what = f"{name}: call {k} of {count}, {mode}"
            title = judged(what, done, earlier, "out")
            if mended:
                mended(what, title, "out")
            tried += 1
            k += STRIDE
    print(f"{name}: {count} calls, {len(faults)} faults", flush=True)


def judge_other(what, done, earlier, out):
    """Verbs that write one file or a set without a summary."""
    if done.returncode not in (0, 4, 6) or (done.returncode != 0 and not done.stderr.strip()):
        faults.append(f"{what}: exit code {done.returncode}: {done.stderr[-200:]!r}")
    if os.path.exists("out.svg") and not read("out.svg").rstrip().endswith(b"</svg>"):
        faults.append(f"{what}: half a picture")


def main():
    global WHOLE
    write("old.yaml", SCENE.replace("TITLE", "old").replace("STEPS", "3"))
    write("new.yaml", SCENE.replace("TITLE", "new").replace("STEPS", "2"))
    assert capstan("run", "old.yaml", "-q", "-o", "old").returncode == 0
    assert capstan("run", "new.yaml", "-q", "-o", "whole").returncode == 0
    WHOLE = set(os.listdir("whole"))
    run = ["run", "new.yaml", "-q", "-o", "out"]
    sweep("a first run", None, run, None)
    sweep("a run over an earlier one", "old", run, "old")
    # a run that could not put its files in place has left its journal
    shutil.copytree("old", "stopped")
    os.unlink("stopped/plan.svg")
    os.mkdir("stopped/plan.svg")
    assert capstan("run", "new.yaml", "-q", "-o", "stopped").returncode == 4 and os.path.exists("stopped/.journal")
    os.rmdir("stopped/plan.svg")
    shutil.copy("old/plan.svg", "stopped/plan.svg")
    sweep("a run that goes on", "stopped", run + ["--resume"], "old")
    write("frozen.yaml", SCENE.replace("TITLE", "new").replace("STEPS", "1") + "friction: frozen\n")
    sweep("study", None, ["study", "frozen.yaml", "-q", "-o", "out", "--complete", "straight"], None, judge_other, None)
    sweep("run --method regularized", None, ["run", "frozen.yaml", "-q", "-o", "out", "--method", "regularized"], None, judge_other, None)
    write("law.yaml", "capstan: 1\nlaw: {disc: 1}\n")
    for verb, file in (("law", "law.yaml"), ("drive", f"{EXAMPLES}/drive/disc.yaml")):
        sweep(f"{verb} --plot", None, [verb, file, "--plot", "out.svg"], None, judge_other, None)
    for verb in ("check", "schema"):
        sweep(verb, None, [verb] + (["new.yaml"] if verb == "check" else []), None, judge_other, None)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
    os.chdir("/")
print("\n".join(faults[:40]) or f"calls: {tried} refused, every one recognised")
sys.exit(1 if faults else 0)
