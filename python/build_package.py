# SPDX-License-Identifier: BSD-3-Clause
"""The build back end: scikit-build-core, which for a source distribution finds the C library in a folder `library`.

In a checkout the library lies around this folder, where a source distribution cannot reach; so its sources are copied
for as long as the distribution is being made."""
import os
import shutil

from scikit_build_core.build import (build_editable, build_wheel, get_requires_for_build_editable,  # noqa: F401
                                     get_requires_for_build_sdist, get_requires_for_build_wheel)
from scikit_build_core.build import build_sdist as _build_sdist

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCES = ("CMakeLists.txt", "LICENSE", "include", "src", "cli", "packaging")


def build_sdist(sdist_directory, config_settings=None):
    library, around = os.path.join(HERE, "library"), os.path.join(HERE, "..")
    copied = not os.path.exists(library)
    if copied:
        os.mkdir(library)
    try:
        for name in SOURCES if copied else ():
            path = os.path.join(around, name)
            (shutil.copytree if os.path.isdir(path) else shutil.copy)(path, os.path.join(library, name))
        return _build_sdist(sdist_directory, config_settings)
    finally:
        if copied:
            shutil.rmtree(library)
