# SPDX-License-Identifier: BSD-3-Clause
"""Many cases: a scene for each combination of parameters, solved by several processes.

The cases are independent and each is deterministic, so the result does not depend on how they are shared out. With a
directory every finished case is on the disk at once; a sweep that was killed goes on with the cases that are missing."""
from __future__ import annotations

import itertools
import json
import multiprocessing
import os
from concurrent.futures import FIRST_COMPLETED, Executor, ProcessPoolExecutor, wait
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _numbers
from ._errors import ArgumentError, Error, FileError, Place, text
from ._native import lib
from .results import Results, run
from .scene import SceneLike

if TYPE_CHECKING:
    import xarray

Case = Dict[str, Any]
Measure = Callable[[Results], Mapping[str, Any]]
_JOURNAL = "cases.jsonl"


def end_tensions(results: Results) -> Dict[str, Any]:
    """What a sweep keeps of a case if nothing else is asked for: the tension at the ends of all lines after the last step,
    and the largest in the history [N]."""
    found: Dict[str, Any] = {}
    for name in results.steps[-1].lines:
        for end in "AB":
            tension = results[name].end(end, "tension")
            found[f"{name}.{end}.tension"], found[f"{name}.{end}.tension_largest"] = tension[-1], tension.max()
    return found


def solve_case(make_scene: Callable[..., SceneLike], case: Case, measure: Measure) -> Dict[str, Any]:
    """Solve one case; an Error of the library is a result of its own."""
    try:
        results = run(make_scene(**case))
        found = {str(key): np.asarray(value).tolist() for key, value in measure(results).items()}
        return {"certified": results.certified, "outcome": results.outcome, "error": "", "values": found}
    except Error as error:
        return {"certified": False, "outcome": "error", "error": str(error), "values": {}}


def _cases(parameters: Union[Mapping[str, Sequence[Any]], Sequence[Case]]) -> Tuple[List[Case], Dict[str, List[Any]]]:
    """All cases in order, and the axes of their grid; no axes for a list of cases."""
    if isinstance(parameters, Mapping):
        axes = {str(name): np.asarray(list(values)).tolist() for name, values in parameters.items()}
        if not axes or not all(axes.values()):
            raise ArgumentError("parameters: expected at least one name with at least one value")
        return [dict(zip(axes, values)) for values in itertools.product(*axes.values())], axes
    cases = [{str(key): np.asarray(value).tolist() for key, value in case.items()} for case in parameters]
    if not cases or any(set(case) != set(cases[0]) for case in cases):
        raise ArgumentError("parameters: expected a dictionary of lists, or a list of cases with the same names")
    return cases, {}


class _Journal:
    """One line for each finished case, in a file that says which sweep it is of."""

    def __init__(self, directory: Union[str, "os.PathLike[str]"], cases: List[Case]) -> None:
        os.makedirs(directory, exist_ok=True)
        self.path = os.path.join(directory, _JOURNAL)
        head = json.dumps({"capstan sweep": text(lib.cps_version()), "cases": cases})
        self.done: Dict[int, Dict[str, Any]] = {}
        whole = self._read(head)
        self.file = open(self.path, "ab")
        self.file.truncate(whole)
        if whole == 0:
            self._line(head)

    def _read(self, head: str) -> int:
        """Read what is there; the number of bytes of whole lines."""
        if not os.path.exists(self.path):
            return 0
        with open(self.path, "rb") as file:
            lines = file.read().split(b"\n")
        lines.pop()  # empty, or the line in which the sweep was killed
        if lines and lines[0].decode() != head:
            raise FileError("is the journal of another sweep, or of another version: give another directory", Place(self.path, 0, 0))
        for line in lines[1:]:
            found = json.loads(line)
            self.done[found.pop("case")] = found
        return sum(len(line) + 1 for line in lines)

    def _line(self, line: str) -> None:
        self.file.write(line.encode() + b"\n")
        self.file.flush()
        os.fsync(self.file.fileno())

    def add(self, case: int, found: Dict[str, Any]) -> None:
        self._line(json.dumps({"case": case, **found}))
        self.done[case] = found

    def close(self) -> None:
        self.file.close()


def _solved(executor: Optional[Executor], jobs: int, todo: Iterator[Tuple[int, Case]], make_scene: Callable[..., SceneLike],
            measure: Measure) -> Iterator[Tuple[int, Dict[str, Any]]]:
    """The cases as they are finished; a few more than there are processes are under way at a time."""
    if executor is None:
        for k, case in todo:
            yield k, solve_case(make_scene, case, measure)
        return
    running: Dict[Any, int] = {}
    try:
        while True:
            for k, case in itertools.islice(todo, max(4 * jobs - len(running), 0)):
                running[executor.submit(solve_case, make_scene, case, measure)] = k
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                yield running.pop(future), future.result()
    finally:
        for future in running:
            future.cancel()


def sweep(make_scene: Callable[..., SceneLike], parameters: Union[Mapping[str, Sequence[Any]], Sequence[Case]], *, jobs: int = 1,
          measure: Measure = end_tensions, directory: Union[str, "os.PathLike[str]", None] = None,
          executor: Optional[Executor] = None, progress: Optional[Callable[[int, int], Any]] = None) -> "xarray.Dataset":
    """Solve a scene for every combination of parameters, and return what was found as one xarray Dataset.

    make_scene: called with the parameters as keyword arguments; a function of a module or of the main program, which
                other processes find by its name
    parameters: values by name, of which all combinations are taken, each name being a dimension of the Dataset; or a list
                of cases, along the dimension `case`
    jobs:       processes
    measure:    what to keep of the Results of a case: numbers or arrays by name, of the same shape in every case
    directory:  every finished case is kept there at once, and not computed again by a later call of the same sweep
    executor:   in place of processes here: an executor of concurrent.futures, as of mpi4py.futures or Dask
    progress:   called as f(done, all)

    The Dataset has the measured values, and `certified`, `outcome` and `error` for each case. Where a case failed, its
    values are NaN, and `error` has the library's words."""
    import xarray  # noqa: F401 - not found now rather than after hours

    cases, axes = _cases(parameters)
    count = _numbers.count(jobs, "jobs", 1)
    journal = _Journal(directory, cases) if directory is not None else None
    done = dict(journal.done) if journal else {}
    todo = iter([(k, case) for k, case in enumerate(cases) if k not in done])
    own = executor is None and count > 1 and len(done) < len(cases)
    pool = ProcessPoolExecutor(count, mp_context=multiprocessing.get_context("fork" if os.name == "posix" else None)) if own else executor
    try:
        for k, found in _solved(pool, count, todo, make_scene, measure):
            done[k] = found
            if journal:
                journal.add(k, found)
            if progress:
                progress(len(done), len(cases))
    finally:
        if own and pool is not None:
            pool.shutdown(wait=True, cancel_futures=True)
        if journal:
            journal.close()
    return _dataset(cases, axes, [done[k] for k in range(len(cases))])


def _dataset(cases: List[Case], axes: Dict[str, List[Any]], found: List[Dict[str, Any]]) -> "xarray.Dataset":
    import xarray

    dims = list(axes) or ["case"]
    shape = [len(values) for values in axes.values()] or [len(cases)]
    coords: Dict[str, Any] = dict(axes) if axes else {name: ("case", [case[name] for case in cases]) for name in cases[0]}
    data: Dict[str, Any] = {}
    for name in ("certified", "outcome", "error"):
        data[name] = (dims, np.array([case[name] for case in found]).reshape(shape))
    for name in dict.fromkeys(key for case in found for key in case["values"]):
        first = next(np.asarray(case["values"][name], float) for case in found if name in case["values"])
        rows = [np.asarray(case["values"].get(name, np.full(first.shape, np.nan)), float) for case in found]
        if any(row.shape != first.shape for row in rows):
            raise ArgumentError(f"measure: {name!r} has not the same shape in every case")
        inner = [f"{name}_{i}" for i in range(first.ndim)]
        data[name] = (dims + inner, np.stack(rows).reshape(*shape, *first.shape))
    return xarray.Dataset(data, coords)
