#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Install the repaired wheel of python.wheel into an empty virtual environment of every Python at hand from 3.9 on, and run the tests of
the package there.                                                                                    usage: pythons.py SOURCE BUILD

Pythons are python3.N of PATH and of pyenv. What the tests need comes from the package index; without it, or without a wheel, the exit
code is 77."""
import glob
import os
import shutil
import subprocess
import sys

NEEDS = ["pytest", "xarray", "pandas", "scipy", "matplotlib", "PyYAML"]
TESTS = ["scenes", "evolution", "results", "derivatives", "sets", "planar", "sweeps", "plots", "misuse", "completeness"]


def pythons():
    """An interpreter for each version, by version."""
    places = os.environ.get("PATH", "").split(os.pathsep) + glob.glob(os.path.expanduser("~/.pyenv/versions/*/bin"))
    found = {}
    for minor in range(9, 30):
        for place in places:
            program = os.path.join(place, f"python3.{minor}")
            asks = "import sys, venv, ensurepip; print('%d.%d' % sys.version_info[:2])"
            if os.access(program, os.X_OK) and subprocess.run([program, "-c", asks], capture_output=True, text=True).stdout == f"3.{minor}\n":
                found.setdefault(f"3.{minor}", program)
    return found


def main():
    source, build = sys.argv[1:]
    work = os.path.join(build, "python-wheel", "pythons")
    wheels = glob.glob(os.path.join(build, "python-wheel", "repaired", "*.whl"))
    if not wheels:
        print("pythons: skipped: python.wheel has made no wheel")
        sys.exit(77)
    clean = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    failed, tried = [], []
    for version, program in pythons().items():
        place = os.path.join(work, version)
        shutil.rmtree(place, ignore_errors=True)
        subprocess.run([program, "-m", "venv", place], check=True, env=clean)
        python = os.path.join(place, "bin", "python")
        done = subprocess.run([python, "-m", "pip", "install", "-q", "--only-binary=:all:", "--disable-pip-version-check", wheels[0], *NEEDS],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=clean)
        if done.returncode:
            print(f"pythons: {version}: skipped, as the package index does not give what it needs:\n{done.stdout}")
            continue
        run = {**clean, "CAPSTAN_COMMAND": os.path.join(place, "bin", "capstan"), "MPLBACKEND": "Agg", "PYTHONDONTWRITEBYTECODE": "1"}
        done = subprocess.run([python, "-m", "pytest", "-q", "-p", "no:cacheprovider", *(os.path.join(source, "test/python", f"test_{name}.py") for name in TESTS)],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=run, cwd=place)
        print(f"pythons: {version}: {done.stdout.strip().splitlines()[-1]}", flush=True)
        tried.append(version)
        if done.returncode:
            failed.append(version)
            print(done.stdout)
        else:
            shutil.rmtree(place)
    if failed or not tried:
        sys.exit(f"pythons: failed: {', '.join(failed)}" if failed else 77)


main()
