# SPDX-License-Identifier: BSD-3-Clause
"""The comparison of warm steps with cold ones in docs/validation.md."""
import glob
import os
import subprocess


def warm_steps(program):
    """What the test prints of oc3-sway and of the examples, but for those without a history."""
    scenes = [os.path.join(program.root, "bench", "oc3-sway.yaml"), *sorted(glob.glob(os.path.join(program.root, "examples", "*.yaml")))]
    command = [os.path.join(program.build, "test", "property", "warm_steps"), "--table", *scenes]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()


FIGURES = {"warm-steps": warm_steps}
