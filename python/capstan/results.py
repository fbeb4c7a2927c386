# SPDX-License-Identifier: BSD-3-Clause
"""Whole runs, and what they have found: in memory, in the files of the command, and as xarray and pandas objects."""
from __future__ import annotations

import csv
import json
import math
import os
import shutil
import sys
import tempfile
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _netcdf
from ._errors import ArgumentError, Error, FileError, Place, check, text
from ._native import ffi, lib
from ._record import Record, enum_word
from .evolution import ARRAYS, Evolution
from .scene import SceneLike

if TYPE_CHECKING:
    import pandas
    import xarray

Directory = Union[str, "os.PathLike[str]"]
# called after every step with the number of steps done, that of all, and the report on the step
Progress = Callable[[int, int, Record], Any]


def _column(words: Sequence[str]) -> List[Any]:
    """Numbers to the last bit, whole ones as integers; an empty cell among them is NaN. Else the words."""
    for kind in (int, float):
        try:
            return [kind(word) if word or kind is int else math.nan for word in words]
        except ValueError:
            pass
    return list(words)


class _Files:
    """What can be had from a directory of results of the command; `_directory` says where it is."""

    def _directory(self) -> str:
        raise NotImplementedError

    @property
    def summary(self) -> Dict[str, Any]:
        """summary.json as a dictionary (docs/results.md)."""
        path = os.path.join(self._directory(), "summary.json")
        try:
            with open(path, encoding="utf-8") as file:
                return json.load(file)
        except OSError as error:
            raise FileError(f"cannot read: {error.strerror}", Place(path, 0, 0)) from None

    def to_xarray(self) -> "xarray.Dataset":
        """result.nc as an xarray Dataset, with its dimensions, units and descriptions (docs/results.md)."""
        import xarray

        with xarray.open_dataset(os.path.join(self._directory(), "result.nc")) as dataset:
            return dataset.load()

    def to_pandas(self) -> "pandas.DataFrame":
        """history.csv as a DataFrame: a row per step, the units of the columns in `.attrs["units"]`."""
        import pandas

        path = os.path.join(self._directory(), "history.csv")
        with open(path, encoding="utf-8", newline="") as file:
            names, units, *rows = csv.reader(file)
        table = pandas.DataFrame({name: _column(column) for name, column in zip(names, zip(*rows))}, columns=names)
        table.attrs["units"] = dict(zip(names, units))
        return table.set_index("step")


class SavedResults(_Files):
    """A directory of results, as `capstan run` and `Results.save` write it."""

    def __init__(self, directory: Directory) -> None:
        self.directory = os.fspath(directory)
        missing, err = ffi.new("char[256]"), ffi.new("CpsError *")
        check(lib.cps_results_missing(os.fsencode(self.directory), missing, err), err)
        if text(missing):
            raise FileError("its files belong to two runs, because their replacement was interrupted: run it again",
                            Place(self.directory, 0, 0))
        for name in ("summary.json", "history.csv", "result.nc"):
            if not os.path.isfile(os.path.join(self.directory, name)):
                raise FileError(f"there is no {name}: expected a directory of results of 'capstan run'",
                                Place(self.directory, 0, 0))

    def _directory(self) -> str:
        return self.directory

    @property
    def outcome(self) -> str:
        """The worst outcome of the steps."""
        return self.summary["outcome"]

    @property
    def certified(self) -> bool:
        """Whether every step has a certified answer."""
        return all(step["outcome"] in ("solved", "taut") for step in self.summary["steps"])

    def save(self, directory: Directory) -> None:
        """Copy the directory to a place where there is nothing yet."""
        if os.path.exists(directory):
            raise FileError("exists already", Place(os.fspath(directory), 0, 0))
        shutil.copytree(self.directory, directory)

    def __repr__(self) -> str:
        return f"<results in {self.directory}: {self.outcome}, {len(self.summary['steps'])} steps>"


def open_results(directory: Directory) -> SavedResults:
    """The results in a directory of `capstan run`; `capstan.open`."""
    return SavedResults(directory)


class Step:
    """A step of a run: `report` (CpsStepReport of step.h), and reports on `lines`, `points` and `bodies` by name."""

    def __init__(self, evolution: Evolution) -> None:
        handle, names = evolution._open(), evolution._names
        self.report = Record(lib.cps_evolution_report(handle))
        self.lines = {name: Record(lib.cps_evolution_line_report(handle, i)) for i, name in enumerate(names["lines"])}
        self.points = {name: Record(lib.cps_evolution_point_report(handle, i)) for i, name in enumerate(names["points"])}
        self.bodies = {name: Record(lib.cps_evolution_body_report(handle, i)) for i, name in enumerate(names["bodies"])}

    @property
    def name(self) -> str:
        return self.report.name

    @property
    def outcome(self) -> str:
        return self.report.outcome

    @property
    def certificate(self) -> Record:
        """The certificate of the step (CpsCertificate of step.h)."""
        return self.report.certificate

    @property
    def certified(self) -> bool:
        return bool(lib.cps_outcome_is_certified(self.report._c.outcome))

    def __repr__(self) -> str:
        return f"<step {self.name!r}: {self.outcome}, gap {self.certificate.gap:.1e} J>"


class LineHistory:
    """A line in all steps of a run: each array of `capstan.ARRAYS` with one more, first dimension for the steps.

    >>> results = run({"lines": {"rope": {"length": 2, "mass": 1, "stiffness": 1e4, "elements": 4,
    ...     "start": "static", "ends": {"A": {"held": [0, 0, 0]}, "B": {"held": [1, 0, 0]}}}}})
    >>> results["rope"].tension.shape
    (1, 4)
    """

    def __init__(self, results: "Results", name: str) -> None:
        self._results, self.name = results, name

    def __getattr__(self, name: str) -> np.ndarray:
        if name not in ARRAYS:
            raise AttributeError(f"a line has no {name!r}")
        return np.array([getattr(line, name).copy() for line in self._results._visit(self.name)])

    def end(self, end: str, quantity: str) -> np.ndarray:
        """A quantity of an end (CpsEndReport of step.h), as ``end("B", "tension")``: a row per step."""
        if end not in ("A", "B"):
            raise ArgumentError(f"end: found {end!r}, expected 'A' or 'B'")
        return np.array([getattr(step.lines[self.name].end["AB".index(end)], quantity) for step in self._results.steps])

    def __dir__(self) -> List[str]:
        return sorted(set(super().__dir__()) | set(ARRAYS))

    def __repr__(self) -> str:
        return f"<line {self.name!r} in {len(self._results)} steps>"


class Results(_Files):
    """What a run has found, step by step: `steps`, a list, and `results["rope"]`, arrays over all steps.

    `save` writes the files of the command. `summary`, `to_xarray` and `to_pandas` are those files read back, with the
    names and units of docs/results.md."""

    def __init__(self, evolution: Evolution) -> None:
        self.scene = evolution.scene
        self.steps: List[Step] = []
        self.complete = False
        self._states: List[bytes] = []
        self._replay = evolution.fresh()
        self._temporary: Optional[tempfile.TemporaryDirectory] = None
        self._wall = 0.0

    def _add(self, evolution: Evolution) -> None:
        with evolution._lock:
            self.steps.append(Step(evolution))
        self._states.append(evolution.save())
        self._wall += self.steps[-1].report.wall
        self._temporary = None

    @property
    def outcome(self) -> str:
        """The worst outcome of the steps."""
        worst = lib.CPS_OUTCOME_SOLVED
        for step in self.steps:
            worst = lib.cps_outcome_worse(worst, step.report._c.outcome)
        return enum_word("CpsOutcome", worst)

    @property
    def certified(self) -> bool:
        """Whether every step of the history was taken and has a certified answer."""
        return self.complete and all(step.certified for step in self.steps)

    def __len__(self) -> int:
        return len(self.steps)

    def __iter__(self) -> Iterator[Step]:
        return iter(self.steps)

    def __getitem__(self, name: str) -> LineHistory:
        """A line by its name."""
        if name not in self._replay.lines:
            raise KeyError(f"no line {name!r}: there are {', '.join(self._replay.lines)}")
        return LineHistory(self, name)

    def evolution(self, step: int = -1) -> Evolution:
        """An evolution that has just taken this step, from which one may go on."""
        made = self._replay.fresh()
        made.load(self._states[step])
        return made

    def _visit(self, name: str) -> Iterator[Any]:
        for state in self._states:
            self._replay.load(state)
            yield self._replay[name]

    def save(self, directory: Directory, *, force: bool = False, paraview: bool = True, stiffness: bool = False,
             out_table: bool = False, fields: Optional[str] = None) -> SavedResults:
        """Write the files of `capstan run` into a directory, which is made if missing (one level).

        force:     files in it that have names of results may be replaced
        paraview:  write files for ParaView
        stiffness: write stiffness.csv
        out_table: write history.out, of a history in time
        fields:    arrays of result.nc, as for `capstan run --fields`; None: all
        """
        _netcdf.load_with_its_own()
        path, err = os.fsencode(directory), ffi.new("CpsError *")
        options = ffi.new("CpsResultsOptions *", lib.cps_results_options_default())
        named = ffi.new("char[]", fields.encode()) if fields is not None else ffi.NULL
        options.no_paraview, options.stiffness, options.fields = not paraview, stiffness, named
        options.out_table, options.sync_at_end = out_table, True
        lines = len(self._replay.lines)
        check(lib.cps_results_check_options(options, err), err)
        check(lib.cps_results_prepare(path, lib.CPS_RESULTS_KIND_RUN, lines, force, err), err)
        out = ffi.new("CpsResults **")
        fresh = self._replay.fresh()
        check(lib.cps_results_open(path, fresh._c_scene, fresh._handle, options, out, err), err)
        results = ffi.gc(out[0], lib.cps_results_destroy)
        for state in self._states:
            fresh.load(state)
            check(lib.cps_results_append(results, fresh._handle, err), err)
        check(lib.cps_results_finish(results, self._wall, err), err)
        ffi.release(results)
        return SavedResults(directory)

    def _directory(self) -> str:
        if self._temporary is None:
            made = tempfile.TemporaryDirectory(prefix="capstan-")
            self.save(os.path.join(made.name, "results"), paraview=False)
            self._temporary = made
        return os.path.join(self._temporary.name, "results")

    def __repr__(self) -> str:
        return f"<Results: {self.outcome}, {len(self)} steps{'' if self.complete else ', not complete'}>"


def run(scene: SceneLike, *, directory: Optional[Directory] = None, force: bool = False,
        progress: Union[bool, Progress, None] = None, threads: Optional[int] = None,
        path_tolerance: Optional[float] = None) -> Results:
    """Solve a scene step by step.

    directory: the files of `capstan run` are written there, as by `Results.save`
    progress:  True shows a bar (by tqdm, if that is installed); or a function, called as ``f(done, all, report)``
    threads, path_tolerance: as of `Evolution`

    Ctrl-C ends the run between two steps or within one, and raises KeyboardInterrupt. Its attribute `results` has the
    steps done so far, which are also written to `directory`, if given. A step that could not begin raises an Error
    with the same attribute.

    >>> results = run({"lines": {"rope": {"length": 2, "mass": 1, "stiffness": 1e4, "elements": 4,
    ...     "start": "static", "ends": {"A": {"held": [0, 0, 0]}, "B": {"held": [1, 0, 0]}}}}})
    >>> results.certified, results.steps[0].certificate.gap < 1e-9
    (True, True)
    """
    evolution = Evolution(scene, threads=threads, path_tolerance=path_tolerance)
    if directory is not None:
        err = ffi.new("CpsError *")
        check(lib.cps_results_prepare(os.fsencode(directory), lib.CPS_RESULTS_KIND_RUN, len(evolution.lines), force, err), err)
    results = Results(evolution)
    show, done = _shown(progress, evolution.step_count)
    try:
        for report in evolution:
            results._add(evolution)
            show(len(results), evolution.step_count, report)
        results.complete = True
    except (KeyboardInterrupt, Error) as stop:
        stop.results = results  # type: ignore[union-attr]
        raise
    finally:
        done()
        if directory is not None and results.steps:
            results.save(directory, force=True)
    return results


def _shown(progress: Union[bool, Progress, None], steps: int) -> Tuple[Progress, Callable[[], None]]:
    """What shows the progress of a run, and what ends it."""
    if callable(progress):
        return progress, lambda: None
    if not progress:
        return (lambda done, steps, report: None), (lambda: None)
    try:
        from tqdm.auto import tqdm
    except ImportError:
        def line(done: int, steps: int, report: Record) -> None:
            print(f"\r{done}/{steps}  {report.name:40.40}", end="", file=sys.stderr, flush=True)
        return line, lambda: print(file=sys.stderr)
    bar = tqdm(total=steps, unit="step")

    def advance(done: int, steps: int, report: Record) -> None:
        bar.set_postfix_str(report.name, refresh=False)
        bar.update()
    return advance, bar.close
