# SPDX-License-Identifier: BSD-3-Clause
"""Random scenes of 27 classes (trial_scenes.py) run as files, and judged by what shares no code with the program:

- the checker, which recomputes every step of result.nc and compares it with the scene: nothing certified is refuted;
- what a history must keep (trial_checks.py): numbers that are numbers, places where nothing happens (every history ends with a stage in
  which nothing changes), the ledger over all parts of a step, the way round posts;
- the same scene with the ends of every line exchanged: where the places of both histories part, one of them says why.

The share of step records that are certified or carry a proof that the checker accepts is printed and bounded in each class.

    usage: trials.py CAPSTAN CHECKER [--seeds N] [--first M] [--class NAME ..]          (default: all 27 classes, 10 seeds)

OPEN, SILENT and LATE hold for the 10 seeds of the whole run and for the first of them, and may only be lowered; the goals are 0.5 % of each
class and none."""
import argparse
import collections
import copy
import json
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile

import trial_checks as checks
import trial_scenes
from result_file import Results

SEEDS = 10
# records without an answer that the seeds of a class may have
OPEN = {"several": 4, "coarse": 1, "rough": 4}
# pairs that part and do not say why
SILENT = {"fine": 1}
# scenes that are stopped after so long [s] of processor time, many times what the others take, for slow machines and instrumented builds
SLOWEST = 60
LATE = {}
NO_SOLUTION, NOT_CERTIFIED, BAD_SCENE = 5, 1, 3
HELD = "hold"


def time_limit():
    resource.setrlimit(resource.RLIMIT_CPU, (SLOWEST, SLOWEST))


def written(scene):
    return json.dumps(scene).replace('".inf"', ".inf")


class Trial:
    """One scene: what the program makes of it, and what is wrong with that."""

    def __init__(self, asked, scene, folder):
        self.asked, self.scene = asked, scene
        self.path, self.out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
        self.faults, self.seconds, self.late, self.lines, self.counts = [], 0.0, False, {}, (0, 0, 0)
        with open(self.path, "w", encoding="utf-8") as file:
            file.write(written(scene))
        self.refused = subprocess.run([asked.capstan, "check", self.path], capture_output=True, timeout=SLOWEST).returncode == BAD_SCENE
        if not self.refused:
            self.run()

    def run(self):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run([self.asked.capstan, "run", "-q", "--no-paraview", "--sync", "end", "-o", self.out, self.path],
                              capture_output=True, text=True, preexec_fn=time_limit)
        self.seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        self.late = -done.returncode in (signal.SIGXCPU, signal.SIGKILL)
        if self.late:
            return
        if done.returncode not in (0, NOT_CERTIFIED, NO_SOLUTION, BAD_SCENE) or not os.path.exists(os.path.join(self.out, "result.nc")):
            self.faults.append(f"capstan run: {done.returncode}, {done.stderr[-300:]}")
            return
        results = Results(os.path.join(self.out, "result.nc"))
        if results.steps > 0:
            self.lines = {name: checks.Line(self.scene, results, name) for name in self.scene["lines"]}

    def judge(self):
        """by the checker"""
        said = subprocess.run([self.asked.checker, os.path.join(self.out, "result.nc"), self.path, "-v"], capture_output=True, text=True,
                              timeout=SLOWEST)
        self.counts = tuple(int(re.search(word + r"[ :]+(\d+)", said.stdout).group(1)) for word in ("records", "not certified", "refuted"))
        if self.counts[2] or not re.search(r"against the scene: 0 findings", said.stdout):
            self.faults.append(f"the checker: {said.stdout} {said.stderr[:400]}")

    def look(self, held):
        """by what the history must keep; steps from `held` on are those in which nothing happens"""
        for name, line in self.lines.items():
            for step in range(line.results.steps):
                found = checks.insane(line, step)
                if not found:
                    found = checks.energy_faults(line, step) + checks.winding_faults(line, step)
                if step >= held and checks.wanders(line, step):
                    found.append(f"nothing happens, and it moves by {checks.wanders(line, step):.1e} of its length")
                self.faults += [f"line {name}, step {step}: {fault}" for fault in found]


def steps_of(scene):
    """in the history, and the statics of lines that are laid before it"""
    return sum(entry.get("steps", 1) for entry in scene["history"]) + any(line["start"] == "static" for line in scene["lines"].values())


def try_scene(asked, scene, tally):
    """faults of a scene and of the same with its ends exchanged; where the two part without a word"""
    checks.by_nodes(scene)
    held = steps_of(scene)
    scene["history"].append({"name": HELD, "steps": 2})
    other = copy.deepcopy(scene)
    checks.exchange(other)
    with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
        one = Trial(asked, scene, first)
        if one.refused:
            tally["refused"] += 1
            return [], []
        if one.lines:
            one.judge()
            one.look(held)
        tally["records"] += one.counts[0]
        tally["open"] += one.counts[1]
        turned = Trial(asked, other, second)
        tally["slowest"] = max(tally["slowest"], one.seconds, turned.seconds)
        tally["late"] += one.late or turned.late
        silent = []
        if turned.refused:
            silent.append("refused with its ends exchanged")
        elif one.lines and turned.lines:
            silent = checks.parted((one.lines, turned.lines), tally)
        tally["silent"] += len(silent)
        return one.faults + turned.faults, silent


def main():
    ask = argparse.ArgumentParser()
    ask.add_argument("capstan")
    ask.add_argument("checker")
    ask.add_argument("--seeds", type=int, default=SEEDS)
    ask.add_argument("--first", type=int, default=0)
    ask.add_argument("--class", dest="only", nargs="*", default=[])
    asked = ask.parse_args()
    bad, known = 0, asked.first == 0 and asked.seeds <= SEEDS
    print(f"{'class':18} records  open   share  refused  compared  said  silent  late  slowest/s")
    for make in trial_scenes.CLASSES:
        name = make.__name__
        if asked.only and name not in asked.only:
            continue
        tally = collections.defaultdict(float)
        for seed in range(asked.first, asked.first + max(asked.seeds, SEEDS)):
            if seed >= asked.first + asked.seeds and (tally["records"] > 0 or name == "into_obstacles"):
                break  # every class has a scene that is not refused, but the one of which all are
            faults, silent = try_scene(asked, trial_scenes.scene(make, seed), tally)
            bad += len(faults)
            for fault in faults + silent:
                print(f"{'WRONG' if fault in faults else 'silent'} {name} {seed}: {fault}", file=sys.stderr, flush=True)
        share = 100*tally["open"]/max(1, tally["records"])
        print(f"{name:18} {tally['records']:7.0f} {tally['open']:5.0f} {share:6.1f}% {tally['refused']:8.0f} {tally['compared']:9.0f} "
              f"{tally['said']:5.0f} {tally['silent']:7.0f} {tally['late']:5.0f} {tally['slowest']:10.2f}", flush=True)
        for what, most in (("open", OPEN), ("silent", SILENT), ("late", LATE)):
            if tally[what] > most.get(name, 0) if known else what != "open" and tally[what] > 0:
                bad += 1
                print(f"{name}: {tally[what]:.0f} {what}, at most {most.get(name, 0)}", file=sys.stderr)
    return bad > 0


if __name__ == "__main__":
    sys.exit(main())
