# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the installed package share: the programs of README.md and examples/, built in both ways and run."""
import os
import re
import subprocess
import sys

SOURCE, BUILD, CMAKE, COMPILER = sys.argv[1:5]
VERSION = re.search(r"VERSION (\d+\.\d+\.\d+)", open(os.path.join(SOURCE, "CMakeLists.txt"), encoding="utf-8").read().split("project(")[1])[1]


def run(*command, env=None, cwd=None):
    """Standard output of a command; its failure ends the test."""
    done = subprocess.run(command, capture_output=True, text=True, cwd=cwd, env={**os.environ, **(env or {})})
    if done.returncode:
        sys.exit(f"{' '.join(command)}: exit status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def readme_block(kind):
    """The one block of this kind in README.md."""
    with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as file:
        found = re.findall(rf"^```{kind}\n(.*?)^```", file.read(), re.M | re.S)
    assert len(found) == 1, f"README.md has {len(found)} blocks of {kind}"
    return found[0]


def check_steps(printed):
    """The README's scene: a pull, and four steps of letting go, all certified."""
    lines = printed.splitlines()
    assert len(lines) == 5 and all(": solved, gap " in line for line in lines), printed


def use(prefix, folder):
    """Build programs against what is installed under prefix, and run them."""
    libraries = os.path.dirname(next(os.path.join(place, name) for place, _, names in os.walk(prefix)
                                     for name in names if name.startswith("libcapstan-io.")))
    write(folder, "rope.c", readme_block("c"))
    write(folder, "rope.yaml", readme_block("yaml"))
    write(folder, "CMakeLists.txt", readme_block("cmake"))
    with open(os.path.join(SOURCE, "examples", "pull_a_rope.c"), encoding="utf-8") as file:
        write(folder, "pull.c", file.read())

    # by find_package: README's program, and one that needs no files
    core = "add_executable(pull pull.c)\ntarget_link_libraries(pull capstan::capstan)\n"
    write(folder, "CMakeLists.txt", readme_block("cmake") + core)
    run(CMAKE, "-G", "Ninja", "-S", folder, "-B", os.path.join(folder, "build"), f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_C_COMPILER={COMPILER}")
    run(CMAKE, "--build", os.path.join(folder, "build"))
    check_steps(run(os.path.join(folder, "build", "rope"), cwd=folder))
    assert "solved: the tip moved 0.05000 m" in run(os.path.join(folder, "build", "pull"))

    # by pkg-config, with the README's line
    paths = {"PKG_CONFIG_PATH": os.path.join(libraries, "pkgconfig"), "LD_LIBRARY_PATH": libraries}
    assert run("pkg-config", "--modversion", "capstan-io", env=paths).strip() == VERSION
    line = readme_block("sh").strip()
    assert line.startswith("cc ")
    run("sh", "-c", COMPILER + line[2:], env=paths, cwd=folder)
    check_steps(run(os.path.join(folder, "rope"), env=paths, cwd=folder))
    run("sh", "-c", f"{COMPILER} pull.c $(pkg-config --cflags --libs capstan) -o pull", env=paths, cwd=folder)
    assert "solved: the tip moved 0.05000 m" in run(os.path.join(folder, "pull"), env=paths)

    # another minor version is not taken for this one
    other = "cmake_minimum_required(VERSION 3.23)\nproject(other C)\nfind_package(capstan 0.2 QUIET)\nif(capstan_FOUND)\n  message(FATAL_ERROR \"0.2 was found\")\nendif()\n"
    os.mkdir(os.path.join(folder, "other"))
    write(os.path.join(folder, "other"), "CMakeLists.txt", other)
    run(CMAKE, "-G", "Ninja", "-S", os.path.join(folder, "other"), "-B", os.path.join(folder, "other", "build"), f"-DCMAKE_PREFIX_PATH={prefix}")

    # the command, without any help to find its libraries
    said = run(os.path.join(prefix, "bin", "capstan"), "--version", env={"LD_LIBRARY_PATH": ""})
    assert VERSION in said, said
    return libraries
