# SPDX-License-Identifier: BSD-3-Clause
"""Random scenes that the command runs and the independent checker reads: what the suites of them share."""
import argparse
import os
import re
import subprocess
import sys

SECONDS = 300  # that a run or a check may take


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=SECONDS, check=False)


def check(checker, out, scene):
    """Records, certified, not certified, refuted and not finite, with a scene that is not that of the results as refuted; and what is said."""
    told = run(checker, os.path.join(out, "result.nc"), scene, "-v")
    counts = re.match(r"records (\d+), certified (\d+), not certified (\d+), refuted (\d+), not finite (\d+)", told.stdout)
    found = [int(n) for n in counts.groups()] if counts else [0, 0, 0, 1, 0]
    found[3] += bool(counts) and "against the scene: 0 findings" not in told.stdout
    return found, f"{told.stdout.strip().splitlines()[0] if told.stdout else ''} {told.stderr.strip()[:400]}"


def events(checker, out):
    """What the checker counts in steps in time."""
    told = run(checker, os.path.join(out, "result.nc"), "-v")
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
    good = [one_class(given, kind) for kind in ([given.only] if given.only else classes)]
    sys.exit(0 if all(good) else 1)
