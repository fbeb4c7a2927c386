#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Build a source distribution and of it the wheel, install that into an empty virtual environment, and run the example of its README there.

                                                                        usage: wheel.py SOURCE BUILD CMAKE

The wheel's library is that of the build, which is installed into a folder first; so only the Python module is compiled.
What the wheel needs comes from the package index, once for a build; without the index the exit code is 77."""
import glob
import os
import re
import shutil
import subprocess
import sys
import tarfile

NEEDS = ["scikit-build-core>=0.10", "cffi>=1.15", "setuptools>=61", "numpy>=1.21", "PyYAML>=5.4"]


def run(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode:
        sys.exit(f"wheel: {' '.join(command)}\n{done.stdout}")
    return done.stdout


def fetch(python, folder):
    """The wheels of what is needed, in a folder; whether they are all there."""
    if os.path.exists(os.path.join(folder, "complete")):
        return True
    done = subprocess.run([python, "-m", "pip", "download", "-q", "--only-binary=:all:", "--disable-pip-version-check", "-d", folder] + NEEDS,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode == 0:
        open(os.path.join(folder, "complete"), "w").close()
    else:
        print(done.stdout)
    return done.returncode == 0


def environment(place):
    """The interpreter of a new virtual environment."""
    shutil.rmtree(place, ignore_errors=True)
    run(sys.executable, "-m", "venv", place)
    return os.path.join(place, "bin", "python")


def main():
    source, build, cmake = sys.argv[1:]
    work = os.path.join(build, "python-wheel")
    wheels = os.path.join(work, "wheels")
    os.makedirs(wheels, exist_ok=True)
    python = environment(os.path.join(work, "make"))
    if not fetch(python, wheels):
        print("wheel: skipped: the package index cannot be reached")
        sys.exit(77)
    offline = ["-q", "--no-index", "--find-links", wheels]

    # the library of this build, as it would be installed
    prefix = os.path.join(work, "prefix")
    run(cmake, "--install", build, "--prefix", prefix)
    shutil.rmtree(os.path.join(work, "dist"), ignore_errors=True)
    os.mkdir(os.path.join(work, "dist"))
    # a source distribution, made where the library lies around the package as in a checkout
    tree = os.path.join(work, "tree")
    shutil.rmtree(tree, ignore_errors=True)
    package = shutil.copytree(os.path.join(source, "python"), os.path.join(tree, "python"),
                              ignore=shutil.ignore_patterns("build", "dist", "library", "__pycache__"))
    for name in ("CMakeLists.txt", "LICENSE", "include", "src", "cli", "packaging"):
        os.symlink(os.path.join(source, name), os.path.join(tree, name))
    run(python, "-m", "pip", "install", *offline, *NEEDS[:3])
    run(python, "-c", f"import build_package; build_package.build_sdist({os.path.join(work, 'dist')!r})", cwd=package)
    (sdist,) = glob.glob(os.path.join(work, "dist", "*.tar.gz"))
    with tarfile.open(sdist) as file:
        inside = {name.split("/", 2)[2] for name in file.getnames() if name.split("/")[1] == "library" and name.count("/") > 1}
    for folder in ("include", "src", "cli"):
        there = {os.path.relpath(os.path.join(place, name), source) for place, _, names in os.walk(os.path.join(source, folder)) for name in names}
        assert there <= inside, f"not in the source distribution: {sorted(there - inside)[:5]}"

    # the wheel is made of it
    run(python, "-m", "pip", "wheel", *offline, "--no-deps", "-w", os.path.join(work, "dist"),
        "--config-settings=cmake.define.CAPSTAN_INSTALLED=ON", f"--config-settings=cmake.define.CMAKE_PREFIX_PATH={prefix}", sdist)
    (wheel,) = glob.glob(os.path.join(work, "dist", "*.whl"))
    assert re.fullmatch(r"capstan_ropes-[0-9.]+-cp39-abi3-\w+\.whl", os.path.basename(wheel)), wheel

    python = environment(os.path.join(work, "empty"))
    run(python, "-m", "pip", "install", *offline, wheel)
    clean = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    with open(os.path.join(source, "python", "README.md"), encoding="utf-8") as file:
        (example,) = re.findall(r"```python\n(.*?)```", file.read(), re.S)
    said = run(python, "-c", example, cwd=work, env=clean)
    rows = said.splitlines()
    assert len(rows) == 8 and all(" solved " in row for row in rows[:5]), said
    # Coulomb: when the rope has been let go, end A keeps no more than friction holds, mu w L
    assert abs(float(rows[4].split()[-1])) <= 0.0255 * 9.81 * 6.28 * (1 + 1e-6), said

    # the command came along, under its own name and as a module
    version = run(os.path.join(work, "empty", "bin", "capstan"), "--version", env=clean)
    assert version == run(python, "-m", "capstan", "--version", env=clean) and version.startswith("capstan "), version
    print(f"wheel: {os.path.basename(wheel)}, {os.path.getsize(wheel)} bytes; the example ran in an empty environment")


main()
