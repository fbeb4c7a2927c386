# SPDX-License-Identifier: BSD-3-Clause
"""Random scenes that the command runs and the independent checker reads: what the suites of them share."""
import argparse
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

SECONDS = 300  # that a run or a check may take
EVERY = 30  # seconds after which a class says how far it is
STOPPED = -9  # exit code of what took longer


def run(*command):
    try:
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(command, STOPPED, "", f"stopped after {SECONDS} s")


def folder_of(given, kind, seed):
    """The folder of a scene: it is kept if that was asked for."""
    folder = os.path.join(given.keep or given.spare, f"{kind}-{seed}")
    os.makedirs(folder, exist_ok=True)
    return folder


def seeds(given, kind):
    """The seeds of a class one after the other. How far they are is said now and then, at the end what they took; no folder stays that is not
    to be kept."""
    said, slowest, total = time.monotonic(), (0.0, given.seed), 0.0
    for seed in range(given.seed, given.seed + given.count):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        yield seed
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        took = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        total += took
        slowest = max(slowest, (took, seed))
        if not given.keep:
            shutil.rmtree(folder_of(given, kind, seed))
        if time.monotonic() - said > EVERY:
            said = time.monotonic()
            print(f"{kind}: {seed - given.seed + 1} of {given.count} scenes, {total:.0f} s of processor, at most {slowest[0]:.1f} s, by seed {slowest[1]}")
    print(f"{kind}: {total:.0f} s of processor, at most {slowest[0]:.1f} s, by seed {slowest[1]}")


def solve(given, kind, seed, text, *options):
    """Run the scene of this text: the file that it was written to, the folder of its results, and the run."""
    folder = folder_of(given, kind, seed)
    scene, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
    with open(scene, "w", encoding="ascii") as file:
        file.write(text)
    return scene, out, run(given.capstan, "run", "-q", scene, "-o", out, "--force", *options)


def told_of(checker, out, scene):
    """The run of the checker."""
    return run(checker, os.path.join(out, "result.nc"), scene, "-v")


def counts_of(told):
    """Records, certified, not certified, refuted and not finite, with a scene that is not that of the results as refuted; and what is said."""
    counts = re.match(r"records (\d+), certified (\d+), not certified (\d+), refuted (\d+), not finite (\d+)", told.stdout)
    found = [int(n) for n in counts.groups()] if counts else [0, 0, 0, 1, 0]
    found[3] += bool(counts) and "against the scene: 0 findings" not in told.stdout
    return found, f"{told.stdout.strip().splitlines()[0] if told.stdout else ''} {told.stderr.strip()[:400]}"


def check(checker, out, scene):
    return counts_of(told_of(checker, out, scene))


def solve_named(given, text, folder, name, checked=(0, 1, 5)):
    """Run a scene and check it, after these exit codes: the exit code, the counts of the checker, and its words or the program's."""
    scene, out = os.path.join(folder, name + ".yaml"), os.path.join(folder, name)
    with open(scene, "w", encoding="ascii") as file:
        file.write(text)
    done = run(given.capstan, "run", "-q", scene, "-o", out, "--force")
    if done.returncode not in checked:
        return done.returncode, [0] * 5, done.stderr.strip()
    return done.returncode, *check(given.checker, out, scene)


class Tally:
    """Steps of the scenes of a class, and scenes that are refused with a proof or are not run."""

    def __init__(self, kind):
        self.kind = kind
        self.steps = self.certified = self.refuted = self.proven = self.wrong = 0

    def add(self, seed, code, found, words):
        self.steps, self.certified, self.refuted = self.steps + found[0], self.certified + found[1], self.refuted + found[3] + found[4]
        self.proven += code == 5
        self.wrong += code not in (0, 1, 5)
        if code not in (0, 5) or found[3]:
            print(f"{self.kind} {seed}: exit {code}, {found} {words}")

    def told(self, given, more=""):
        print(f"{self.kind}: {given.count} scenes from seed {given.seed}, {self.steps} steps, {self.certified} certified, {self.refuted} refuted, "
              f"{self.proven} refused with a proof, {self.wrong} not run{more}", flush=True)

    def is_good(self, share):
        return self.steps > 0 and self.certified >= share * self.steps and self.refuted == 0 and self.wrong == 0


def events_of(told):
    """What the checker counts in steps in time."""
    counts = re.search(r"in time: \d+ steps, landed (\d+), changed (\d+), snatched (\d+)", told.stdout)
    return dict(zip(("landed", "changed", "snatched"), map(int, counts.groups()))) if counts else {}


def main(classes, one_class, count):
    """The arguments that all suites have: each class must be good."""
    options = argparse.ArgumentParser()
    options.add_argument("capstan")
    options.add_argument("checker")
    options.add_argument("--count", type=int, default=count)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--only", choices=classes)
    options.add_argument("--keep", help="folder for the scenes")
    given = options.parse_args()
    sys.stdout.reconfigure(line_buffering=True)  # what is found is said at once
    with tempfile.TemporaryDirectory() as given.spare:
        good = [one_class(given, kind) for kind in ([given.only] if given.only else classes)]
    sys.exit(0 if all(good) else 1)
