# SPDX-License-Identifier: BSD-3-Clause
"""What lies in a directory of results, and its name, is not always what it seems: names that libnetcdf would take for others,
journals that are none or have other names, lists that cannot be read, results of the other method.  usage: edges.py CAPSTAN"""
import os
import resource
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True
from checks import expect, read, run_in_an_empty_folder, write

CAPSTAN = os.path.abspath(sys.argv[1])
SCENE = """capstan: 1
obstacles: {table: {plane: {}, friction: 0.3}}
lines:
  rope: {length: 5, elements: 40, weight: 9, stiffness: 100, start: {straight: {from: [0, 0, 0], to: [5, 0, 0]}}, ends: {A: held, B: {force: [0, 0, 0]}}}
history: [{name: pull, steps: 4, rope.B: {force: [3, 3, 3]}}]
"""
NOBODY = 65534


def run(*arguments, code=0, program=CAPSTAN, **more):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, errors="replace", timeout=120, check=False, **more)
    expect(f"{arguments}: exit code {code}", done.returncode == code, (done.returncode, done.stderr[-300:]))
    return done.stderr


def blanks():
    """More than 1000 blanks in a run take libfyaml quadratic time; what is allowed takes none that matters."""
    for text in ("- " + " "*200000, "a: \"x\"" + " "*200000, "? " + "\t"*200000, "a: !" + " "*200000, SCENE.replace(": {table", ":" + " "*1001 + "{table")):
        write("blanks.yaml", text)
        begun = time.monotonic()
        message = run("check", "blanks.yaml", code=3)
        expect("blanks: named", "1000 blanks" in message, message)
        expect("blanks: at once", time.monotonic() - begun < 1, time.monotonic() - begun)  # took 20 s
    write("blanks.yaml", SCENE.replace(": {table", ":" + " "*1000 + "{table"))
    run("check", "blanks.yaml")


def names():
    """Directories whose names libnetcdf would read as others."""
    os.mkdir("x")
    write("x/.result.nc.part", "precious")
    for name in (" x", "\tx", "http:/", "file:/", "[mode=nczarr]x", "s3://x"):
        if "//" in name:
            os.mkdir(name.split("/")[0])
        run("run", "scene.yaml", "-q", "-o", name)
        expect(f"{name!r}: the results are there", os.path.exists(os.path.join(name, "result.nc")), os.listdir("."))
    expect("another directory is not written to", read("x/.result.nc.part") == b"precious", "changed")


def stop(folder):
    """A run that is killed after its first steps."""
    write("long.yaml", SCENE.replace("steps: 4", "steps: 4000"))
    process = subprocess.Popen([CAPSTAN, "run", "long.yaml", "-q", "-o", folder], stderr=subprocess.DEVNULL)
    journal = os.path.join(folder, ".journal")
    while process.poll() is None and not (os.path.exists(journal) and os.path.getsize(journal) > 50000):
        time.sleep(0.01)
    process.kill()
    process.wait()


def journals():
    for number, content in enumerate(("c", "caps", "capstnJ")):
        folder = f"short{number}"
        run("run", "scene.yaml", "-q", "-o", folder)
        write(folder + "/.journal", content)
        message = run("run", "scene.yaml", "-q", "-o", folder, code=4)
        found = read(folder + "/.journal") if os.path.exists(folder + "/.journal") else None
        expect(f"{content!r} is no journal and stays", found == content.encode() and "no journal" in message, message)
    stop("linked")
    os.link("linked/.journal", "copy")
    before = read("copy")
    for option in ("--resume", "--force"):
        message = run("run", "long.yaml", "-q", "-o", "linked", option, code=4)
        expect(f"{option}: other names", "hard links" in message, message)
    expect("the other name keeps its content", read("copy") == before, len(before))


def other_method():
    """Results of one method take the place of those of the other, whole, and not those of an interrupted run."""
    run("run", "scene.yaml", "-q", "-o", "both")
    run("run", "scene.yaml", "-q", "--method", "regularized", "-o", "both")
    expect("only results of 1990 are left", sorted(os.listdir("both")) == [".capstan", "history.csv", "line-1.svg", "summary.json"], os.listdir("both"))
    run("run", "scene.yaml", "-q", "-o", "both")
    expect("none of those is left", "line-1.svg" not in os.listdir("both") and "result.nc" in os.listdir("both"), os.listdir("both"))
    stop("half")
    message = run("run", "scene.yaml", "-q", "--method", "regularized", "-o", "half", code=4)
    expect("the steps of an interrupted run are kept", "keeps the steps" in message and os.path.exists("half/.journal"), message)
    expect("and nothing is written", "summary.json" not in os.listdir("half"), os.listdir("half"))
    os.mkdir("own")
    write("own/.capstan", "capstan directory 1\n")
    others = (".journal", "line-0.svg", "line-7.svg", "loop-mine.svg")
    for name in others:  # none is in the way of these results
        write("own/" + name, "mine")
    run("run", "scene.yaml", "-q", "--method", "regularized", "-o", "own")
    expect("files of others stay", all(read("own/" + name) == b"mine" for name in others), os.listdir("own"))
    os.remove("own/.journal")
    others = ("step-99999.vtp", "step-00001-obstacles.vtp", "line-7.svg")
    for name in others:  # nor of these: four steps without ParaView
        write("own/" + name, "mine")
    run("run", "scene.yaml", "-q", "--no-paraview", "-o", "own")
    expect("files of others stay beside a run", all(read("own/" + name) == b"mine" for name in others), os.listdir("own"))
    run("run", "scene.yaml", "-q", "--method", "regularized", "-o", "half", "--force")
    expect("unless they are given up", not os.path.exists("half/.journal"), os.listdir("half"))


def lists():
    """A list that cannot be opened is not called someone else's."""
    os.chmod(".", 0o777)
    user = {}
    if os.getuid() == 0:  # who may read everything; another user may not reach the program where it was built
        shutil.copy(CAPSTAN, "program")
        user = {"user": NOBODY, "program": os.path.abspath("program")}
        run("--version", **user)
    run("run", "scene.yaml", "-q", "-o", "closed", **user)
    os.chmod("closed/.capstan", 0)
    message = run("run", "scene.yaml", "-q", "-o", "closed", code=4, **user)
    expect("no permission: said", "Permission denied" in message and "move it away" not in message, message)
    os.chmod("closed/.capstan", 0o644)
    os.chmod("closed", 0o300)
    os.remove("closed/.capstan")
    message = run("run", "scene.yaml", "-q", "-o", "closed", code=4, **user)
    expect("no list of files: said", "cannot" in message and "Permission denied" in message, message)
    os.chmod("closed", 0o700)


def limits():
    """A file over the limit of size is an error of every command, and no signal ends it."""
    def small():
        resource.setrlimit(resource.RLIMIT_FSIZE, (512, 512))
    write("law.yaml", "capstan: 1\nlaw: {disc: 1}\n")
    message = run("law", "law.yaml", "--plot", "p.svg", code=4, preexec_fn=small)
    expect("law --plot: said", "p.svg" in message, message)
    expect("law --plot: nothing is left", not [name for name in os.listdir(".") if "p.svg" in name], os.listdir("."))
    with open("schema", "w", encoding="utf-8") as file:
        done = subprocess.run([CAPSTAN, "schema", "drive"], stdout=file, stderr=subprocess.PIPE, text=True, preexec_fn=small, timeout=60, check=False)
    expect("schema: said", done.returncode == 4 and "standard output" in done.stderr, (done.returncode, done.stderr))


def numbers():
    for number in ("1e999", "-1e400", "1e-400", "0o7777777777777777777777777", "0x" + "f"*400):
        write("number.yaml", SCENE.replace("stiffness: 100", f"stiffness: {number}"))
        message = run("check", "number.yaml", code=3)
        expect(f"{number}: refused where it is", "number.yaml:4:" in message, message)
    write("number.yaml", SCENE.replace("friction: 0.3", "friction: 1e-310"))
    run("check", "number.yaml")


def main():
    write("scene.yaml", SCENE)
    for part in (blanks, names, journals, other_method, lists, limits, numbers):
        part()


run_in_an_empty_folder(main, "edges: blanks, names of directories, journals, both methods, lists, limits of size, numbers")
