# SPDX-License-Identifier: BSD-3-Clause
"""The comparison of warm steps with cold ones in docs/validation.md, and the spar under thrust."""
import glob
import os
import subprocess

import spar


def warm_steps(program):
    """What the test prints of the two cases of sway and of the examples, but for those without a history or with points."""
    bench = [os.path.join(program.root, "bench", name) for name in ("oc3-sway.yaml", "oc3-sway-set.yaml")]
    scenes = [*bench, *sorted(glob.glob(os.path.join(program.root, "examples", "*.yaml")))]
    command = [os.path.join(program.build, "test", "property", "warm_steps"), "--table", *scenes]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()


FIGURES = {"warm-steps": warm_steps, "spar-thrust": spar.thrust}
PICTURES = {"spar-thrust": spar.loops}
