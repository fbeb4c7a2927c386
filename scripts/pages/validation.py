# SPDX-License-Identifier: BSD-3-Clause
"""The comparison of warm steps with cold ones in docs/validation.md, and the spar under thrust."""
import glob
import os
import re
import subprocess

import spar


def warm_steps(program):
    """What the test prints of the cases of sway, a corner, elements round a post and the examples, but for those without a history or
    with points."""
    names = ("bench/oc3-sway.yaml", "bench/oc3-sway-set.yaml", "test/property/sway-on-cut-discs.yaml", "test/property/rope-in-a-groove.yaml",
             "test/property/line-round-a-thin-post.yaml")
    scenes = [*[os.path.join(program.root, *name.split("/")) for name in names], *sorted(glob.glob(os.path.join(program.root, "examples", "*.yaml")))]
    command = [os.path.join(program.build, "test", "property", "warm_steps"), "--table", *scenes]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()


def parting_lines(program):
    """What property.random_failure finds in 1000 scenes."""
    command = [os.path.join(program.build, "test", "property", "random_failure"), "--scenes", "1000"]
    last = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[-1]
    scenes, steps, opened, breaks, fallen, near, off, wrong = re.findall(r"[0-9][0-9.e+-]*", last)
    return ["", "| scenes | steps | breaks | without a line left | open steps | left as doubtful | tensions differ by | wrong |",
            "|---|---|---|---|---|---|---|---|",
            f"| {scenes} | {steps} | {breaks} | {fallen} | {opened} | {near} | {off} | {wrong} |", ""]


FIGURES = {"warm-steps": warm_steps, "parting-lines": parting_lines, "spar-thrust": spar.thrust, "spar-lifts": spar.lifts}
PICTURES = {"spar-thrust": spar.loops}
