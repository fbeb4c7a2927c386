# SPDX-License-Identifier: BSD-3-Clause
"""A run that is killed goes on with --resume and ends with the same bits; SIGINT finishes its step and keeps the results.

usage: resume.py CAPSTAN SCENE"""
import csv
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

CAPSTAN, SCENE = sys.argv[1:3]


def steps_in(directory):
    """Lines of history.csv below its two heads."""
    with open(os.path.join(directory, "history.csv")) as table:
        return len(table.readlines()) - 2


def history(directory):
    with open(os.path.join(directory, "history.csv"), newline="") as table:
        return [{key: value for key, value in row.items() if key != "wall"} for row in csv.DictReader(table)]


def begin(directory):
    return subprocess.Popen([CAPSTAN, "run", SCENE, "-q", "-o", directory], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def wait_for_journal(process, directory, size):
    """Until the journal holds some steps; False if the run was over before."""
    journal = os.path.join(directory, ".journal")
    while process.poll() is None:
        if os.path.exists(journal) and os.path.getsize(journal) > size:
            return True
        time.sleep(0.001)
    return False


def resume(directory, code=0, scene=SCENE):
    done = subprocess.run([CAPSTAN, "run", scene, "-q", "--resume", "-o", directory], capture_output=True, text=True)
    assert done.returncode == code, (done.returncode, done.stderr)
    return done.stderr


def same(directory, whole):
    """Every field of every step, and the history, but for times."""
    names = sorted(name for name in os.listdir(whole) if name.endswith(".vtp"))
    assert len(names) > 10
    for name in names:
        with open(os.path.join(whole, name), "rb") as a, open(os.path.join(directory, name), "rb") as b:
            assert a.read() == b.read(), name + " differs"
    assert history(directory) == history(whole)


def main():
    work = tempfile.mkdtemp()
    whole = os.path.join(work, "whole")
    assert begin(whole).wait() == 0
    assert not os.path.exists(os.path.join(whole, ".journal")), "a finished run leaves no journal"
    steps = steps_in(whole)

    # killed twice, the second time while going on
    killed = os.path.join(work, "killed")
    process = begin(killed)
    assert wait_for_journal(process, killed, 300000), "the run was over before it could be killed"
    process.kill()
    process.wait()
    said = resume(killed)
    assert "steps were done before" in said and not said.startswith("capstan: 0 of"), said
    assert steps_in(killed) == steps
    same(killed, whole)

    # a record cut short by the kill is dropped
    process = begin(killed)
    assert wait_for_journal(process, killed, 300000)
    process.kill()
    process.wait()
    journal = os.path.join(killed, ".journal")
    os.truncate(journal, os.path.getsize(journal) - 7)
    with open(journal, "r+b") as file:
        file.seek(-20000, os.SEEK_END)
        file.write(b"spoilt")
    resume(killed)
    same(killed, whole)

    # SIGINT: the step ends, the results so far are there, and the rest can follow
    stopped = os.path.join(work, "stopped")
    process = begin(stopped)
    assert wait_for_journal(process, stopped, 300000)
    process.send_signal(signal.SIGINT)
    assert process.wait() == 130
    assert 0 < steps_in(stopped) < steps
    resume(stopped)
    same(stopped, whole)

    # the journal of another scene is refused, and stays
    process = begin(stopped)
    assert wait_for_journal(process, stopped, 300000)
    process.kill()
    process.wait()
    with open(SCENE) as file:
        text = file.read()
    other = os.path.join(work, "other.yaml")
    assert "friction: 0.5" in text
    with open(other, "w") as file:
        file.write(text.replace("friction: 0.5", "friction: 0.4"))
    assert "another scene" in resume(stopped, code=3, scene=other)
    shutil.rmtree(work)


main()
