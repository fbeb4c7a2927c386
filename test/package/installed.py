# SPDX-License-Identifier: BSD-3-Clause
"""Install this build into an empty prefix and use it from there, moved to another place.
usage: installed.py SOURCE BUILD CMAKE COMPILER"""
import os
import tempfile

import package

with tempfile.TemporaryDirectory() as folder:
    first, prefix, work = (os.path.join(folder, name) for name in ("first", "prefix", "work"))
    os.mkdir(work)
    package.run(package.CMAKE, "--install", package.BUILD, "--prefix", first)
    os.rename(first, prefix)  # nothing in it may know where it was put
    package.use(prefix, work)
    headers = set(os.listdir(os.path.join(prefix, "include", "capstan")))
    assert headers == set(os.listdir(os.path.join(package.SOURCE, "include", "capstan"))), headers
