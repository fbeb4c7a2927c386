# SPDX-License-Identifier: BSD-3-Clause
"""Results in memory, in files and as objects of other packages; all equal to those of the command, bit for bit."""
import csv
import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest

import capstan
from conftest import ROOT

# the time a step takes is the one thing in which two runs may differ: in the summary, and in the size and checksum that
# it lists of the two other files that contain times
WALL = re.compile(rb'"wall_s": [0-9.e+-]+|"name": "(result.nc|history.csv)", "bytes": \d+, "crc32": "\w+"')
SCENES = sorted(path.stem for path in (ROOT / "examples").glob("*.yaml"))


def without_times(folder):
    """{name: contents} of a directory of results, with the times of the run left out."""
    found = {}
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), "rb") as file:
            data = file.read()
        if name == "history.csv":
            rows = list(csv.reader(data.decode().splitlines()))
            at = rows[0].index("wall")
            data = repr([row[:at] + row[at + 1:] for row in rows]).encode()
        elif name == "result.nc":
            data = netcdf(os.path.join(folder, name))
        else:
            data = WALL.sub(b"", data)
        found[name] = data
    return found


def netcdf(path):
    """What a result.nc contains but for times, read with scipy."""
    from scipy.io import netcdf_file
    with netcdf_file(path, mmap=False) as file:
        found = {name: (v.dimensions, v.data.tobytes(), repr(v._attributes)) for name, v in file.variables.items() if name != "wall"}
        about = {key: value for key, value in file._attributes.items() if key != "history"}
        return repr((dict(file.dimensions), about)).encode() + repr(sorted(found.items())).encode()


@pytest.mark.parametrize("name", SCENES)
def test_results_are_those_of_the_command(name, command):
    scene = str(ROOT / "examples" / f"{name}.yaml")
    subprocess.run([command, "run", scene, "-o", "command", "--sync", "end", "-q"], capture_output=True)
    results = capstan.run(scene, directory="python")
    expected, found = without_times("command"), without_times("python")
    assert list(found) == list(expected)
    assert [key for key in expected if expected[key] != found[key]] == []
    # and what is in memory is what is in the files
    summary = json.load(open("command/summary.json"))
    assert [step["name"] for step in summary["steps"]] == [step.name for step in results]
    assert [step["energy"]["gap_J"] for step in summary["steps"]] == [step.certificate.gap for step in results]
    assert summary["outcome"] == results.outcome


def test_the_comparison_can_fail(rope, command):
    capstan.run(rope, directory="one")
    capstan.run(rope.replace("friction: 0.5", "friction: 0.5000001"), directory="two")
    one, two = without_times("one"), without_times("two")
    assert {"result.nc", "summary.json", "history.csv"} <= {key for key in one if one[key] != two[key]}


def test_steps_lines_and_certificates(rope):
    results = capstan.run(rope)
    assert len(results) == 8 and results.certified and results.complete and results.outcome == "solved"
    for step in results:
        assert step.certified and step.certificate.gap <= 1e-8 * step.certificate.scale
    tension = results["rope"].tension
    assert tension.shape == (8, 20) and results["rope"].position.shape == (8, 21, 3)
    other = capstan.Evolution(rope)
    for k, _ in enumerate(other):
        assert np.array_equal(other["rope"].tension, tension[k])
    assert np.array_equal(results["rope"].end("B", "tension"), [step.lines["rope"].end[1].tension for step in results])
    with pytest.raises(KeyError, match="no line 'cable'"):
        results["cable"]


def test_one_may_go_on_from_any_step(rope):
    results = capstan.run(rope)
    on = results.evolution(4)
    on.step()
    assert np.array_equal(on["rope"].position, results["rope"].position[5])


def test_objects_of_other_packages(rope):
    xarray, pandas = pytest.importorskip("xarray"), pytest.importorskip("pandas")
    results = capstan.run(rope)
    data, table = results.to_xarray(), results.to_pandas()
    assert isinstance(data, xarray.Dataset) and isinstance(table, pandas.DataFrame)
    assert data.rope_tension.attrs["units"] == "N" and data.rope_tension.shape == (8, 20)
    assert np.array_equal(data.rope_tension.values, results["rope"].tension)
    assert np.array_equal(data.rope_position.values, results["rope"].position)
    assert table["rope.B.tension"].tolist() == results["rope"].end("B", "tension").tolist()
    assert table.attrs["units"]["rope.B.tension"] == "N" and list(table.name) == [step.name for step in results]
    assert results.summary["steps"][3]["name"] == results.steps[3].name


def test_a_directory_is_opened(rope, command, tmp_path):
    (tmp_path / "rope.yaml").write_text(rope)
    subprocess.run([command, "run", "rope.yaml", "-o", "out", "-q"], check=True)
    saved = capstan.open("out")
    assert saved.certified and saved.outcome == "solved" and len(saved.to_pandas()) == 8
    assert "8 steps" in repr(saved) and saved.to_xarray().rope_tension.shape == (8, 20)
    saved.save("copy")
    assert capstan.open("copy").summary == saved.summary
    with pytest.raises(capstan.FileError, match="exists already"):
        saved.save("copy")
    for wrong in ("nowhere", "."):
        with pytest.raises(capstan.FileError, match="no summary.json"):
            capstan.open(wrong)
    os.remove("copy/history.csv")
    with pytest.raises(capstan.FileError, match="no history.csv"):
        capstan.open("copy")


def test_directories_of_others_are_refused_before_anything_is_computed(rope, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "diary.txt").write_text("dear diary")
    with pytest.raises(capstan.Error, match="mine"):
        capstan.run(rope, directory="mine", progress=lambda *a: pytest.fail("a step was taken"))
    assert os.listdir("mine") == ["diary.txt"]
    results = capstan.run(rope)
    with pytest.raises(capstan.Error):
        results.save("mine")
    with pytest.raises(capstan.Error, match="nonsense"):
        results.save("fields", fields="nonsense")
    results.save("some", fields="tension", paraview=False, stiffness=True)
    assert "result.pvd" not in os.listdir("some") and "stiffness.csv" in os.listdir("some")
    results.save("some", force=True)


def test_progress_is_told(rope, capsys):
    told = []
    capstan.run(rope, progress=lambda done, total, report: told.append((done, total, report.name)))
    assert told[0] == (1, 8, "pull 1/5") and len(told) == 8
    capstan.run(rope, progress=True)
    assert "8/8" in capsys.readouterr().err


def test_a_run_without_equilibrium_says_so():
    text = """
capstan: 1
lines:
  rope: {length: 2, elements: 4, mass: 1, stiffness: .inf, start: static, ends: {A: {held: [0, 0, 0]}, B: {held: [1, 0, 0]}}}
history: [{name: far, rope.B: {position: [3, 0, 0]}}, {name: never, rope.B: {position: [1, 0, 0]}}]
"""
    results = capstan.run(text)
    assert results.outcome == "infeasible" and not results.certified
    # the proof: along this direction the ends are farther apart than the line is long, by a metre
    line = results.steps[-1].lines["rope"]
    assert line.proof.tolist() == [1, 0, 0] and line.proof_length == pytest.approx(1, rel=1e-12)


def test_the_command_is_a_module(rope, tmp_path):
    (tmp_path / "rope.yaml").write_text(rope)
    done = subprocess.run([sys.executable, "-m", "capstan", "check", "rope.yaml"], capture_output=True, text=True)
    assert done.returncode == 0 and "rope" in done.stdout
    assert subprocess.run([sys.executable, "-m", "capstan", "nonsense"], capture_output=True).returncode == 2
    version = subprocess.run([sys.executable, "-m", "capstan", "--version"], capture_output=True, text=True).stdout
    assert capstan.__version__ in version


def test_the_example_of_the_readme(tmp_path):
    """With the first scene of the README as rope.yaml."""
    readme = (ROOT / "README.md").read_text()
    (scene,) = re.findall(r"```yaml\n(.*?)```", readme, re.S)
    (example,) = re.findall(r"```python\n(.*?)```", readme, re.S)
    (tmp_path / "rope.yaml").write_text(scene)
    done = subprocess.run([sys.executable, "-c", example], capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.startswith("True ["), done.stderr
    assert len(capstan.open("out").summary["steps"]) == 5


def test_libnetcdf_is_the_one_that_the_environment_says(rope, command):
    """A wheel for any Linux takes it from the package netCDF4; here another name stands for the system's."""
    import ctypes.util
    import subprocess

    name = ctypes.util.find_library("netcdf")
    with open("rope.yaml", "w", encoding="utf-8") as file:
        file.write(rope)
    runs = {"plain": {}, "named": {"CAPSTAN_NETCDF": name}, "empty": {"CAPSTAN_NETCDF": ""}, "missing": {"CAPSTAN_NETCDF": "/no/libnetcdf.so"}}
    found = {key: subprocess.run([command, "run", "rope.yaml", "-o", key], env={**os.environ, **more}, capture_output=True, text=True)
             for key, more in runs.items()}
    assert [done.returncode for done in found.values()] == [0, 0, 0, 4]
    assert "cannot write result.nc without /no/libnetcdf.so" in found["missing"].stderr
    # whole files, which differ by the times that the steps took
    assert len({os.path.getsize(f"{key}/result.nc") for key in ("plain", "named", "empty")}) == 1
