# SPDX-License-Identifier: BSD-3-Clause
"""The sweep of 2000 cases of bench/sweep.py, killed three times on the way: no case is lost, none is computed twice."""
import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import capstan
from conftest import ROOT

pytest.importorskip("xarray")
sys.path.insert(0, str(ROOT / "bench"))
import sweep as oc3  # noqa: E402

COUNT = int(os.environ.get("CAPSTAN_SWEEP_CASES", "2000"))
CHILD = f"""
import sys
sys.path.insert(0, {str(ROOT / "bench")!r})
import capstan, sweep, test_sweep_oc3
capstan.sweep(sweep.make_scene, test_sweep_oc3.cases(), jobs=2, directory="kept")
"""


def cases():
    """Those of the grid, as a list: the first so many."""
    listed = [{"friction": f, "offset": o, "stiffness": s} for f in oc3.GRID["friction"] for o in oc3.GRID["offset"] for s in oc3.GRID["stiffness"]]
    assert len(listed) == 2000
    return listed[:COUNT]


def whole_lines(path):
    if not os.path.exists(path):
        return []
    with open(path, "rb") as file:
        return file.read().split(b"\n")[1:-1]


def test_a_sweep_of_2000_cases_is_killed_and_goes_on():
    path, before = "kept/cases.jsonl", []
    for part in (1, 2, 3):
        child = subprocess.Popen([sys.executable, "-c", CHILD], start_new_session=True,
                                 env={**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT / "test/python"), os.environ["PYTHONPATH"]])})
        while child.poll() is None and len(whole_lines(path)) < part * COUNT // 4:
            time.sleep(0.02)
        assert child.poll() is None, "the sweep has ended before it was killed"
        os.killpg(child.pid, signal.SIGKILL)
        child.wait()
        lines = whole_lines(path)
        assert lines[:len(before)] == before and part * COUNT // 4 <= len(lines) < COUNT  # what was done stays as it was
        before = lines
    solved = []
    found = capstan.sweep(oc3.make_scene, cases(), jobs=2, directory="kept", progress=lambda done, total: solved.append(done))
    assert solved == list(range(len(before) + 1, COUNT + 1))  # those that were missing, each once
    lines = whole_lines(path)
    assert lines[:len(before)] == before and sorted(json.loads(line)["case"] for line in lines) == list(range(COUNT))
    assert bool(found.certified.all())
    # the same bits as of one process that nobody kills
    assert capstan.sweep(oc3.make_scene, cases()).identical(found)
    # physics: the stiffer the line, the more it resists to the same offset, in every friction
    pulled = found["line.B.tension_largest"].values[:COUNT // 10 * 10].reshape(-1, 10)
    assert (np.diff(pulled, axis=1) > 0).all()
