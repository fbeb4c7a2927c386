# SPDX-License-Identifier: BSD-3-Clause
"""Where libnetcdf is. A wheel for any Linux carries libfyaml, and takes libnetcdf from the package netCDF4, which carries that.

The library opens what the environment variable CAPSTAN_NETCDF says, or else the system's."""
from __future__ import annotations

import importlib
import importlib.util
import os
import pathlib

_HERE = pathlib.Path(__file__).resolve().parent


def found() -> str:
    """The libnetcdf that netCDF4 carries; an empty text where there is none."""
    spec = importlib.util.find_spec("netCDF4")
    if spec is None or spec.origin is None:
        return ""
    site = pathlib.Path(spec.origin).resolve().parents[1]
    files = [path for folder in site.glob("net[cC][dD][fF]4.libs") for path in folder.glob("libnetcdf-*.so*")]
    return str(files[0]) if files else ""


def point_to_it() -> None:
    """Of a wheel that was made for any Linux: tell the library, and commands that are started from here."""
    if (_HERE.parent / "capstan_ropes.libs").is_dir() and "CAPSTAN_NETCDF" not in os.environ:
        path = found()
        if path:
            os.environ["CAPSTAN_NETCDF"] = path


def load_with_its_own() -> None:
    """Before it is opened by its path: what it needs lies beside it, where the package netCDF4 finds it."""
    if os.environ.get("CAPSTAN_NETCDF", "") and os.environ["CAPSTAN_NETCDF"] == found():
        importlib.import_module("netCDF4")


def for_a_command() -> None:
    """The same for a program that takes over this process."""
    point_to_it()
    path = os.environ.get("CAPSTAN_NETCDF", "")
    if path and path == found():
        before = os.environ.get("LD_LIBRARY_PATH", "")
        os.environ["LD_LIBRARY_PATH"] = os.path.dirname(path) + (os.pathsep + before if before else "")
