# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps: the same numbers however the cases are shared out, killed and taken up again."""
import json
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import capstan
from conftest import ROOT, ROPE

pytest.importorskip("xarray")


def make_scene(friction, pull=0.3):
    scene = capstan.Scene.from_yaml(ROPE.replace("0.5, 0.3, 0", f"{pull}, 0, 0"))
    scene["obstacles"]["floor"]["friction"] = friction
    return scene


def last_force(results):
    return {"force": results.steps[-1].lines["rope"].end[1].force, "steps": len(results)}


GRID = {"friction": [0.1, 0.4, 0.7], "pull": [0.3, 0.5]}


def test_a_grid_and_its_physics():
    found = capstan.sweep(make_scene, {"friction": np.linspace(0.1, 0.9, 5)})
    assert found["rope.B.tension_largest"].dims == ("friction",) and bool(found.certified.all())
    # the whole rope slides: mu w L, to the accuracy of the certificate
    assert np.allclose(found["rope.B.tension_largest"], found.friction * 9.81 * 2, rtol=1e-7)


def test_the_same_bits_however_the_cases_are_shared_out():
    one = capstan.sweep(make_scene, GRID, measure=last_force)
    assert one.force.shape == (3, 2, 3) and one.force.dims[:2] == ("friction", "pull")
    assert capstan.sweep(make_scene, GRID, measure=last_force, jobs=2).identical(one)
    with ThreadPoolExecutor(3) as executor:
        assert capstan.sweep(make_scene, GRID, measure=last_force, executor=executor).identical(one)
    listed = capstan.sweep(make_scene, [{"friction": f, "pull": p} for f in GRID["friction"] for p in GRID["pull"]], measure=last_force)
    assert listed.sizes["case"] == 6 and np.array_equal(listed.force.values.reshape(3, 2, 3), one.force.values)


def test_cases_that_fail_are_told_apart():
    found = capstan.sweep(make_scene, {"friction": [0.1, -1, 0.3]})
    assert found.outcome.values.tolist() == ["solved", "error", "solved"]
    assert np.isnan(found["rope.B.tension"].values).tolist() == [False, True, False]
    assert "'friction'" in str(found.error.values[1]) and found.certified.values.tolist() == [True, False, True]


CHILD = """
import sys
sys.path.insert(0, {here!r})
import capstan, test_sweeps
capstan.sweep(test_sweeps.make_scene, {{"friction": [0.01 * i for i in range(1, 80)]}}, jobs=2, directory="kept",
              measure=test_sweeps.last_force)
"""


def test_a_killed_sweep_goes_on_without_losing_or_repeating_a_case():
    child = subprocess.Popen([sys.executable, "-c", CHILD.format(here=str(ROOT / "test/python"))], start_new_session=True)
    path, deadline = "kept/cases.jsonl", time.monotonic() + 60
    while time.monotonic() < deadline and (not os.path.exists(path) or open(path, "rb").read().count(b"\n") < 12):
        time.sleep(0.01)
    os.killpg(child.pid, signal.SIGKILL)
    child.wait()
    with open(path, "ab") as file:
        file.write(b'{"case": 3, "certi')  # as a kill within a write leaves it
    kept = [json.loads(line)["case"] for line in open(path, "rb").read().split(b"\n")[1:-1]]
    assert 10 <= len(kept) < 79 and len(set(kept)) == len(kept)
    grid, solved = {"friction": [0.01 * i for i in range(1, 80)]}, []
    found = capstan.sweep(make_scene, grid, directory="kept", measure=last_force, progress=lambda done, total: solved.append(done))
    assert len(solved) == 79 - len(kept)
    lines = [json.loads(line)["case"] for line in open(path, "rb").read().split(b"\n")[1:-1]]
    assert sorted(lines) == list(range(79)) and lines[:len(kept)] == kept
    some = capstan.sweep(make_scene, {"friction": grid["friction"][:3]}, measure=last_force)
    assert np.array_equal(found.force[:3], some.force)
    # whole: nothing is computed, not even once
    assert capstan.sweep(pytest.fail, grid, directory="kept", measure=last_force).identical(found)
    with pytest.raises(capstan.FileError, match="another sweep"):
        capstan.sweep(make_scene, GRID, directory="kept")


@pytest.mark.parametrize("parameters", [{}, [], {"friction": []}, [{"a": 1}, {"b": 2}], {"friction": [[1], [1, 2]]}])
def test_wrong_parameters(parameters):
    with pytest.raises((capstan.ArgumentError, ValueError)):
        capstan.sweep(make_scene, parameters)


def test_wrong_jobs():
    for jobs in (0, -1, 1.5, None, "2"):
        with pytest.raises(capstan.ArgumentError):
            capstan.sweep(make_scene, GRID, jobs=jobs)
