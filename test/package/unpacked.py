# SPDX-License-Identifier: BSD-3-Clause
"""Sources unpacked inside a checkout of something else, on a machine without cmocka: they configure, say that there are
no tests, and do not take that checkout's commit for theirs; without capstan-io none of its headers is installed.
usage: unpacked.py SOURCE BUILD CMAKE COMPILER"""
import os
import shutil
import subprocess
import tempfile

import package


def hide_cmocka(folder):
    """A folder for pkg-config with everything that is there but cmocka."""
    os.mkdir(folder)
    for place in package.run("pkg-config", "--variable", "pc_path", "pkg-config").strip().split(":"):
        for name in sorted(os.listdir(place)) if os.path.isdir(place) else []:
            if name != "cmocka.pc" and not os.path.lexists(os.path.join(folder, name)):
                os.symlink(os.path.join(place, name), os.path.join(folder, name))
    return {"PKG_CONFIG_LIBDIR": folder, "PKG_CONFIG_PATH": ""}


with tempfile.TemporaryDirectory() as folder:
    outer, build = os.path.join(folder, "outer"), os.path.join(folder, "build")
    source = os.path.join(outer, "capstan")
    environment = hide_cmocka(os.path.join(folder, "pc"))
    os.mkdir(outer)
    git = ["git", "-C", outer, "-c", "user.name=other", "-c", "user.email=other@example.org"]
    package.run(*git, "init", "-q")
    package.run(*git, "commit", "-q", "--allow-empty", "-m", "something else")
    shutil.copytree(package.SOURCE, source, ignore=shutil.ignore_patterns("build", ".git", "shared"))

    said = package.run(package.CMAKE, "--preset", "release", "-B", build, env=environment, cwd=source)
    assert "No tests: they need cmocka" in said, said
    commit = package.run(*git, "describe", "--always").strip()
    with open(os.path.join(build, "build.ninja"), encoding="utf-8") as file:
        ninja = file.read()
    assert "CAPSTAN_COMMIT=\\\"unknown\\\"" in ninja and commit not in ninja, "the commit of another project is taken"

    asked = subprocess.run([package.CMAKE, "--preset", "release", "-B", build + "-tests", "-DCAPSTAN_TESTS=ON"], cwd=source,
                           env={**os.environ, **environment}, capture_output=True, text=True)
    assert asked.returncode and "CAPSTAN_TESTS=ON needs cmocka" in asked.stderr, asked.stderr

    package.run(package.CMAKE, "--preset", "release", "-B", build + "-core", "-DCAPSTAN_IO=OFF", env=environment, cwd=source)
    package.run(package.CMAKE, "--install", build + "-core", "--component", "headers", "--prefix", os.path.join(folder, "prefix"))
    headers = os.listdir(os.path.join(folder, "prefix", "include", "capstan"))
    assert "evolve.h" in headers and not {"io.h", "results.h"} & set(headers), headers
