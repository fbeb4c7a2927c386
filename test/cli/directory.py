# SPDX-License-Identifier: BSD-3-Clause
"""Directories of results: which are entered, what is replaced and removed in them, and what an interrupted run leaves there.

usage: directory.py CAPSTAN CHECKER"""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import zlib

from checks import expect, faults, read, write

CAPSTAN, CHECKER = (os.path.abspath(path) for path in sys.argv[1:3])
SCENE = """capstan: 1
obstacles:
  bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.5}
lines:
  rope: {length: 1, elements: 10, weight: 1, stiffness: 100, start: {straight: {from: [0, 0, 0], to: [1, 0, 0]}}, ends: {A: held, B: held}}
history:
  - {name: out, rope.B: {position: [1.1, 0, 0]}, steps: STEPS}
  - {name: back, rope.B: {position: [1, 0, 0]}, steps: STEPS}
"""


def files(folder):
    return {name: read(os.path.join(folder, name)) for name in sorted(os.listdir(folder))}


def run(*more, scene="scene.yaml", code=0, verb="run"):
    done = subprocess.run([CAPSTAN, verb, scene, "-q", *more], capture_output=True, text=True, timeout=120)
    if code is not None:
        expect(f"{verb} {scene} {more}: exit code {done.returncode}, expected {code}", done.returncode == code, done.stderr)
    return done


def foreign():
    """A directory with files of somebody else is refused as it is; with --force what has other names stays."""
    for verb, more, name in (("run", [], "plan.svg"), ("run", ["--method", "regularized"], "line-1.svg"), ("study", [], "study.csv"),
                             ("run", [], "notes.txt"), ("run", [], "loop-mine.svg"), ("run", [], "step-00001-plan.svg")):
        shutil.rmtree("mine", ignore_errors=True)
        os.mkdir("mine")
        for other in (name, "notes.txt", "stepping.svg", "loop.txt"):
            write(f"mine/{other}", "mine")
        before = files("mine")
        done = run(*more, "-o", "mine", verb=verb, scene="frozen.yaml", code=4)
        expect(f"{verb} {more}: why", "--force" in done.stderr and "not empty" in done.stderr, done.stderr)
        expect(f"{verb} {more}: changed", files("mine") == before, sorted(os.listdir("mine")))
        run(*more, "-o", "mine", "--force", verb=verb, scene="frozen.yaml", code=None)
        after = files("mine")
        expect(f"{verb} {more} --force: marker", ".capstan" in after, sorted(after))
        for other in ("notes.txt", "stepping.svg", "loop.txt"):
            expect(f"{verb} {more} --force: {other} is lost", after.get(other) == b"mine")
    for name in (".capstan", ".capstan.run"):  # what is not ours under the marker's own names
        shutil.rmtree("mine", ignore_errors=True)
        os.mkdir("mine")
        write(f"mine/{name}", "mine")
        run("-o", "mine", code=4)
        expect(f"{name}: changed", read(f"mine/{name}") == b"mine")
    os.unlink("mine/.capstan.run")
    os.symlink("../scene.yaml", "mine/.capstan")
    run("-o", "mine", "--force", code=4)
    expect("a link as a marker", read("scene.yaml").startswith(b"capstan: 1"))


def is_refused(what, folder, command, *words):
    """Is the command refused before it computes anything, and the directory left as it was?"""
    before = tree(folder)
    done = subprocess.run([CAPSTAN, *command, "-o", folder], capture_output=True, text=True, timeout=120)
    expect(f"{what}: exit code {done.returncode}, expected 4", done.returncode == 4, done)
    expect(f"{what}: why", all(word in done.stderr for word in words), done.stderr)
    expect(f"{what}: computed before it was refused", not re.search("step [0-9]+ of", done.stderr) and not done.stdout, done)
    expect(f"{what}: changed", tree(folder) == before, sorted(set(tree(folder)) ^ set(before)))


def tree(folder):
    paths = {name: os.path.join(folder, name) for name in os.listdir(folder)}
    return {name: os.readlink(path) if os.path.islink(path) else sorted(os.listdir(path)) if os.path.isdir(path) else read(path)
            for name, path in paths.items()}


def forced():
    """What --force does not take over is refused before anything is written."""
    run = ["run", "short.yaml", "--force"]
    for name in (".capstan", ".capstan.run", ".journal"):
        for make in (lambda path: write(path, "mine"), os.mkdir, lambda path: os.symlink("nowhere", path)):
            fresh("mine")
            write("mine/plan.svg", "mine")
            make(f"mine/{name}")
            is_refused(f"--force, {name}", "mine", run, f"mine/{name}")
    for name in ("plan.svg", "step-00001.vtp", ".result.nc.part"):
        fresh("mine")
        write("mine/tension.svg", "mine")
        os.mkdir(f"mine/{name}")
        is_refused(f"--force, a directory {name}", "mine", run, f"mine/{name}", "directory")
    # a study has no journal, and one that is there is none of its business
    fresh("mine")
    write("mine/.journal", "mine")
    done = subprocess.run([CAPSTAN, "study", "frozen.yaml", "-q", "--force", "-o", "mine"], capture_output=True, text=True, timeout=120)
    expect("study --force beside a file .journal", done.returncode == 0 and read("mine/.journal") == b"mine", done)


def remove(path):
    """True where there was such a file."""
    there = os.path.lexists(path)
    if there:
        os.unlink(path)
    return there


def fresh(folder):
    shutil.rmtree(folder, ignore_errors=True)
    os.mkdir(folder)


def parts():
    """Unfinished files that no run has listed are somebody else's: they are refused, and removed with --force alone."""
    run("-o", "parts", scene="short.yaml")
    for name in (".result.nc.part", ".summary.json.part", ".plan.svg.part", ".step-00099-plan.svg.part", ".loop-mine.svg.part", ".study.csv.part"):
        for make in (lambda path: write(path, "mine"), lambda path: os.symlink("../scene.yaml", path)):
            make(f"parts/{name}")
            for more in ([], ["--resume"]):
                is_refused(f"{name} {more}", "parts", ["run", "short.yaml", *more], f"parts/{name}", "--force")
            is_refused(f"{name}, study", "parts", ["study", "frozen.yaml"], f"parts/{name}", "--force")
            run("-o", "parts", "--force", scene="short.yaml")
            expect(f"{name}: left after --force", not remove(f"parts/{name}"))
    expect("a link as an unfinished file", read("scene.yaml").startswith(b"capstan: 1"))
    for name in (".mine.part", ".plan.svg.12.part", "plan.svg.part", ".capstan.part.part"):
        write(f"parts/{name}", "mine")
    run("-o", "parts", scene="short.yaml")
    run("-o", "parts", "--force", scene="short.yaml")
    for name in (".mine.part", ".plan.svg.12.part", "plan.svg.part", ".capstan.part.part"):
        expect(f"{name} is lost", read(f"parts/{name}") == b"mine")
    # listed ones are those of a run that was killed
    write("parts/.capstan.run", "capstan directory 1\np plan.svg\np result.nc\n")
    for name in (".plan.svg.part", ".result.nc.part", ".tension.svg.part"):
        write(f"parts/{name}", "left")
    is_refused("listed and not listed", "parts", ["run", "short.yaml"], "parts/.tension.svg.part", "--force")
    remove("parts/.tension.svg.part")
    run("-o", "parts", scene="short.yaml")
    expect("listed ones are cleared", not {".plan.svg.part", ".result.nc.part", ".capstan.run"} & set(os.listdir("parts")), os.listdir("parts"))


def taken():
    """The name of a result that is taken by a directory, or by a file that is not listed, is found before anything is computed."""
    for command in (["run", "short.yaml"], ["run", "turn.yaml"], ["run", "frozen.yaml", "--method", "regularized"], ["study", "frozen.yaml"],
                    ["study", "frozen.yaml", "--history"], ["study", "frozen.yaml", "--complete", "straight"]):
        shutil.rmtree("whole", ignore_errors=True)
        done = subprocess.run([CAPSTAN, *command, "-o", "whole"], capture_output=True, text=True, timeout=120)
        names = [name for name in os.listdir("whole") if name != ".capstan" and not name.startswith("loop-")]
        expect(f"{command}: files", done.returncode == 0 and len(names) > 2, (done, names))
        for name in names:
            for make in (lambda path: write(path, "mine"), os.mkdir, lambda path: os.symlink("nowhere", path)):
                fresh("taken")
                write("taken/.capstan", "capstan directory 1\n")
                make(f"taken/{name}")
                is_refused(f"{command}: {name} is taken", "taken", command, f"taken/{name}")
    # what a run does not write may be there
    for command, name in ((["run", "short.yaml"], "step-00002.vtp"), (["run", "short.yaml", "--no-paraview"], "step-00001.vtp"),
                          (["run", "short.yaml"], "step-00001-obstacles.vtp"), (["run", "short.yaml"], "study.csv"), (["run", "short.yaml"], "line-1.svg"),
                          (["run", "frozen.yaml", "--method", "regularized"], "line-2.svg"), (["study", "frozen.yaml"], "methods.csv")):
        for make in (lambda path: write(path, "mine"), os.mkdir):
            fresh("taken")
            write("taken/.capstan", "capstan directory 1\n")
            make(f"taken/{name}")
            before = tree("taken")[name]
            done = subprocess.run([CAPSTAN, *command, "-q", "-o", "taken"], capture_output=True, text=True, timeout=120)
            expect(f"{command}: {name} is there", done.returncode == 0 and tree("taken")[name] == before, done)


def again():
    """Into a directory of capstan's without a word; what it did not write there stays, and is not written over."""
    run("-o", "out")
    listed = {line[2:] for line in read("out/.capstan").decode().splitlines()[1:]}
    expect("marker: list", listed == set(os.listdir("out")) - {".capstan"}, listed)
    for name in ("loop-other.svg", "step-00099-plan.svg", "step-00099.vtp", "obstacles.txt"):
        write(f"out/{name}", "mine")
    run("-o", "out", scene="short.yaml")
    names = set(os.listdir("out"))
    expect("what an earlier run wrote and this one did not", "step-00005.vtp" not in names and "step-00001.vtp" in names, names)
    for name in ("loop-other.svg", "step-00099-plan.svg", "step-00099.vtp", "obstacles.txt"):
        expect(f"{name} is lost", name in names and read(f"out/{name}") == b"mine")
    run("-o", "out", "--no-paraview")
    names = set(os.listdir("out"))
    expect("--no-paraview: what is left", {name for name in names if name.endswith(".vtp")} == {"step-00099.vtp"}, names)
    write("out/step-00003.vtp", "mine")  # where a result of the next run is to go
    before = files("out")
    done = run("-o", "out", code=4)
    expect("my own step: why", "step-00003.vtp was not written by capstan" in done.stderr, done.stderr)
    after = files("out")
    expect("my own step: changed", {name: after[name] for name in before} == before)
    run("-o", "out", "--force")
    expect("my own step: not replaced with --force", read("out/step-00003.vtp") != b"mine")
    expect("my own step: journal", not os.path.exists("out/.journal"))


def listed():
    """summary.json knows each file of its run by size and checksum, and the checker notices one of another run."""
    run("-o", "listed")
    with open("listed/summary.json", encoding="utf-8") as file:
        summary = json.load(file)
    found = {entry["name"]: (entry["bytes"], entry["crc32"]) for entry in summary["files"]}
    expected = {name: (len(data), f"{zlib.crc32(data):08x}") for name, data in files("listed").items() if name not in (".capstan", "summary.json")}
    expect("files of the summary", found == expected, found.keys() ^ expected.keys())
    check = lambda: subprocess.run([CHECKER, "listed/result.nc"], capture_output=True, text=True, timeout=60)
    expect("checker: whole", check().returncode == 0, check())
    run("-o", "other", scene="short.yaml")
    kept = read("listed/result.nc")
    shutil.copy("other/result.nc", "listed/result.nc")
    expect("checker: result.nc of another run", check().returncode == 1 and "not of its run" in check().stderr, check())
    with open("listed/result.nc", "wb") as file:
        file.write(kept)
    # as a rename that failed leaves it
    write("listed/.capstan", read("listed/.capstan").decode() + "x summary.json\n")
    expect("checker: replaced whole", check().returncode == 0, check())
    # names of files, and names in them, cannot control a terminal
    write("listed/escape.json", '{"name": "\x1b[2J", "bytes": 1, "crc32": "0"}\n')
    for more in (["\x1b[2J.json"], ["\x1b[2J.nc"], ["listed/result.nc", "\x1b[2J.yaml"], ["listed/escape.json"], ["listed/\u202e.nc"], ["\udc9b2J.nc"]):
        done = subprocess.run([CHECKER, *more], capture_output=True, timeout=60)
        expect(f"checker {more}: exit code", done.returncode != 0 and done.stderr.endswith(b"\n"), done)
        for bad in (b"\x1b", "\u202e".encode(), b"\x9b"):
            expect(f"checker {more}: characters", bad not in done.stdout + done.stderr, done)
    os.unlink("listed/escape.json")
    os.unlink("listed/summary.json")
    expect("checker: a mixture", check().returncode == 1 and "two runs" in check().stderr, check())
    done = run("-o", "listed")
    expect("run: a mixture", "not all of one run" in done.stderr, done.stderr)
    done = run("-o", "listed")
    expect("run: whole again", done.stderr == "" and check().returncode == 0, done.stderr)


def studies():
    """Each kind of study, and a regularised run, is a set with a list of its own: put in place last, missed where it is missing."""
    check = lambda name: subprocess.run([CHECKER, f"studies/{name}"], capture_output=True, text=True, timeout=60)
    kinds = (([], "study", "study.json", 5), (["--history"], "study", "methods.json", 2),
             (["--complete", "straight"], "study", "completed.json", 2), (["--method", "regularized"], "run", "summary.json", 2))
    for more, verb, summary, count in kinds:
        run(*more, "-o", "studies", verb=verb, scene="frozen.yaml")
        made = json.loads(read(f"studies/{summary}"))
        found = {entry["name"]: (entry["bytes"], entry["crc32"]) for entry in made["files"]}
        data = {name: read(f"studies/{name}") for name in found}
        expect(f"{summary}: files", len(found) == count and found == {name: (len(d), f"{zlib.crc32(d):08x}") for name, d in data.items()}, found)
        expect(f"{summary}: title", made["title"], made)
        expect(f"{summary}: checker", check(summary).returncode == 0, check(summary))
    shown = subprocess.run([CAPSTAN, "run", "frozen.yaml", "-q", "--method", "regularized", "--json", "-o", "studies"], capture_output=True, text=True, timeout=60)
    expect("--json of a regularised run", "files" not in json.loads(shown.stdout) and json.loads(shown.stdout)["steps"], shown.stdout[-80:])
    name = next(iter(json.loads(read("studies/study.json"))["files"]))["name"]
    kept = read(f"studies/{name}")
    write(f"studies/{name}", kept[:-1] + b"?")
    expect("checker: a file of another study", check("study.json").returncode == 1 and "not of its run" in check("study.json").stderr, check("study.json"))
    os.unlink(f"studies/{name}")
    expect("checker: a file is missing", check("study.json").returncode == 1 and "cannot be read" in check("study.json").stderr, check("study.json"))
    write("studies/study.csv", kept)
    expect("checker: no list", check("study.csv").returncode != 0)
    # as renames that failed leave two of the sets: each is told until what wrote it has run again
    write("studies/.capstan", read("studies/.capstan").decode() + "x methods.json\nx study.json\n")
    os.unlink("studies/methods.json")
    os.unlink("studies/study.json")
    expect("checker: a mixture", check("study.json").returncode == 1 and "two runs" in check("study.json").stderr, check("study.json"))
    for left, (more, verb, summary, _) in zip(("methods.json", "methods.json", "study.json", "study.json", ""), (kinds[2], kinds[1], kinds[2], kinds[0], kinds[2])):
        said = run(*more, "-o", "studies", verb=verb, scene="frozen.yaml").stderr
        expect(f"a mixture without {left}, {summary}", (f"and {left} is missing" in said) if left else said == "", said)


def killed():
    """What a killed run has begun is cleared by the next one."""
    process = subprocess.Popen([CAPSTAN, "run", "long.yaml", "-q", "-o", "killed"])
    while process.poll() is None and not (os.path.isdir("killed") and len(os.listdir("killed")) > 20):
        time.sleep(0.001)
    process.send_signal(signal.SIGKILL)
    process.wait()
    left = [name for name in os.listdir("killed") if name.endswith(".part")]
    expect("killed: left", len(left) > 10, left)
    write("killed/.mine.part", "mine")
    run("-o", "killed", "--force", "--no-paraview", scene="short.yaml")
    left = [name for name in os.listdir("killed") if name.endswith((".part", ".run", ".journal", ".vtp"))]
    expect("killed: left after the next run", left == [".mine.part"], left)
    # a run that fails leaves nothing: neither marker nor directory
    done = run("-o", "failed", scene="grab.yaml", code=3)
    expect("failed: why", "grabbed" in done.stderr, done.stderr)


def names():
    """A scene whose name is dots does not write into the working directory."""
    for name in ("...yaml", "..yaml", ".yaml", "....yaml", "a.b.yaml"):
        shutil.copy("short.yaml", name)
        before = set(os.listdir("."))
        run(scene=f"./{name}")
        expect(f"{name}: in the working directory", set(os.listdir(".")) - before <= {"results"}, set(os.listdir(".")) - before)
        expect(f"{name}: in results itself", not os.path.exists("results/result.nc"))
        os.unlink(name)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for name, steps in (("scene.yaml", 4), ("short.yaml", 1), ("long.yaml", 200)):
        write(name, SCENE.replace("STEPS", str(steps)))
    write("frozen.yaml", SCENE.replace("STEPS", "1") + "friction_policy: frozen\n")
    write("grab.yaml", SCENE.replace("STEPS", "1").replace("A: held, B: held", "A: held, B: free").replace("rope.B: {position: [1.1, 0, 0]}",
          "rope.B: {force: [0.1, 0, 0]}").replace("bed:", "post: {cylinder: {point: [1.5, 0, 0], axis: [0, 0, 1], radius: 0.2}, friction: 0.1}\n  bed:")
          .replace("[1, 0, 0]}, steps", "[2, 0, 0]}, steps"))
    write("turn.yaml", SCENE.replace("STEPS", "1").replace("bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.5}",
          "drum: {cylinder: {point: [0, 0, -9], axis: [0, 1, 0], radius: 1}, friction: 0.5}").replace("{name: out,", "{name: out, drum.turn: 20,"))
    for part in (foreign, forced, parts, taken, again, listed, studies, killed, names):
        part()
    os.chdir("/")

print("\n".join(faults) or "directories: entered, replaced, listed, interrupted")
sys.exit(1 if faults else 0)
