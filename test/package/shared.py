# SPDX-License-Identifier: BSD-3-Clause
"""Build shared libraries, install them, and use them: the command starts, and the libraries carry their version.
usage: shared.py SOURCE BUILD CMAKE COMPILER"""
import os
import tempfile

import package

with tempfile.TemporaryDirectory() as folder:
    build, prefix, work = (os.path.join(folder, name) for name in ("build", "prefix", "work"))
    os.mkdir(work)
    package.run(package.CMAKE, "-S", package.SOURCE, "-B", build, "-G", "Ninja", "-DBUILD_SHARED_LIBS=ON", "-DCMAKE_BUILD_TYPE=Debug",
                "-DCMAKE_C_FLAGS_DEBUG=-O0", "-DCAPSTAN_TESTS=OFF", "-DCAPSTAN_BENCH=OFF", f"-DCMAKE_C_COMPILER={package.COMPILER}")
    package.run(package.CMAKE, "--build", build)
    package.run(package.CMAKE, "--install", build, "--prefix", prefix)
    libraries = package.use(prefix, work)
    minor = ".".join(package.VERSION.split(".")[:2])
    for name in ("libcapstan.so", "libcapstan-io.so"):
        path = os.path.join(libraries, name)
        assert os.readlink(path) == f"{name}.{minor}" and os.readlink(f"{path}.{minor}") == f"{name}.{package.VERSION}", name
        assert f"{name}.{minor}" in package.run("objdump", "-p", path).split("SONAME")[1].split("\n")[0]
