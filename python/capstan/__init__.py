# SPDX-License-Identifier: BSD-3-Clause
"""Ropes, cables and mooring lines with exact dry friction; every answer carries a certificate.

    import capstan

    results = capstan.run("rope.yaml")
    print(results.steps[-1].lines["rope"].end[0].tension, results.certified)

`Scene` describes what there is, `run` solves its whole history, `Evolution` takes single steps. All quantities are in SI
units; the keys of scenes are described in docs/formats.md, the numbers of reports in docs/results.md and in the
headers of the C library."""
from ._errors import (ArgumentError, Error, FileError, InputError, LimitError, NoAnswer, OutOfMemory, Place, text as _text)
from ._native import lib as _lib
from ._record import Record
from . import _netcdf, laws, planar, plots, sets
from .derivatives import Derivative, derivative
from .evolution import ARRAYS, Evolution, LineState
from .move import Move
from .results import LineHistory, Results, SavedResults, Step, open_results as open, run  # noqa: A004
from .laws import Law, Resistance
from .scene import Body, Friction, Line, Obstacle, Point, Scene
from .sets import Set
from .sweeps import sweep
from .systems import Motion, Solutions, System

_netcdf.point_to_it()

__version__ = _text(_lib.cps_version())

__all__ = ["ARRAYS", "ArgumentError", "Body", "Derivative", "Error", "Evolution", "FileError", "Friction", "InputError", "Law",
           "LimitError", "Line", "LineHistory", "LineState", "Motion", "Move", "NoAnswer", "Obstacle",
           "OutOfMemory", "Place", "Point", "Record", "Resistance", "Results", "SavedResults", "Scene",
           "Set", "Solutions", "Step", "System", "__version__", "derivative", "laws", "open", "planar", "plots", "run", "sets", "sweep"]
