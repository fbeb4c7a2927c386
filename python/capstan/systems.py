# SPDX-License-Identifier: BSD-3-Clause
"""Systems of laws under constraints, driven and eliminated (docs/drive.md)."""
from __future__ import annotations

from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np

from . import _numbers
from ._errors import ArgumentError, check, text
from ._native import ffi, lib
from ._record import Record, enum_word
from .laws import Law, Resistance
from .sets import Numbers, Set, _data


def _entries(matrix: np.ndarray) -> Tuple[int, Any]:
    """A matrix as a list of its entries that are not 0."""
    rows, columns = np.nonzero(matrix)
    made = ffi.new("CpsEntry[]", max(len(rows), 1))
    for entry, i, j in zip(made, rows.tolist(), columns.tolist()):
        entry.row, entry.column, entry.value = i, j, matrix[i, j]
    return len(rows), made


def _options(given: Dict[str, Any]) -> Any:
    made = ffi.new("CpsMotionOptions *", lib.cps_motion_options_default())
    for name, value in given.items():
        if name in ("tolerance", "boundary"):
            setattr(made, name, _numbers.number(value, name))
        elif name == "composition" and isinstance(value, (bool, np.bool_)):
            made.composition = bool(value)
        else:
            raise ArgumentError(f"options: found {name} {value!r:.40}, expected tolerance, boundary, or composition, which is True or False")
    return made


class System:
    """A system of velocity parameters V, on which laws act through matrices, U = B V.

    >>> from capstan.sets import disc, interval
    >>> wheel = System(3)                                  # spin, slip to the side, slip along
    >>> wheel.add(Law(interval(60)), [[1, 0, 0]], "brake")
    >>> wheel.add(Law(disc(500)), [[0, 1, 0], [0, 0, 1]], "ground")
    >>> wheel.drive([[0, 1, 0], [-0.3, 0, 1]])
    >>> motion = wheel.solve([0, 1])
    >>> round(motion.value, 6), motion.outcome, wheel.eliminate().set.measure().outcome
    (200.0, 'solved', 'answered')
    """

    def __init__(self, parameters: int) -> None:
        out, err = ffi.new("CpsSystem **"), ffi.new("CpsError *")
        check(lib.cps_system_create(_numbers.count(parameters, "parameters", 1), out, err), err)
        self._take(out[0])

    def _take(self, c: Any) -> None:
        self._c = ffi.gc(c, lib.cps_system_destroy)
        self._solved = False

    @classmethod
    def _of(cls, c: Any) -> "System":
        system = cls.__new__(cls)
        system._take(c)
        return system

    @property
    def parameters(self) -> int:
        return lib.cps_system_parameter_count(self._c)

    def _change(self) -> Any:
        # a motion refers to its system, which must stay as it was solved
        if self._solved:
            raise ArgumentError("the system has been solved and cannot be changed any more: make another one")
        return ffi.new("CpsError *")

    def _matrix(self, value: Numbers, rows: Optional[int], what: str) -> np.ndarray:
        return _numbers.array(value, (rows, self.parameters), what)

    def add(self, law: Union[Law, Resistance], matrix: Numbers, name: Optional[str] = None) -> None:
        """A law that acts on U = B V, B (space of the law, parameters)."""
        if not isinstance(law, (Law, Resistance)):
            raise ArgumentError(f"law: found {type(law).__name__}, expected a Law or a Resistance")
        if name is not None and (not isinstance(name, str) or "\0" in name):
            raise ArgumentError(f"name: found {name!r}, expected a text")
        count, entries = _entries(self._matrix(matrix, law.space, "matrix"))
        err, named = self._change(), ffi.NULL if name is None else ffi.new("char[]", name.encode())
        if isinstance(law, Law):
            check(lib.cps_system_add_friction(self._c, named, law._friction(), count, entries, err), err)
        else:
            check(lib.cps_system_add_resistance(self._c, named, law._c, count, entries, err), err)

    def constrain(self, matrix: Numbers) -> None:
        """Perfect constraints C V = 0, in addition to those before."""
        made = self._matrix(matrix, None, "matrix")
        err = self._change()
        check(lib.cps_system_add_constraints(self._c, len(made), *_entries(made), err), err)

    def restrict(self, spanning: Numbers) -> None:
        """Perfect constraints: V stays in the space that the rows of a matrix (any, parameters) span."""
        made = self._matrix(spanning, None, "spanning")
        err = self._change()
        check(lib.cps_system_add_subspace(self._c, len(made), _data(made), err), err)

    def drive(self, matrix: Numbers) -> None:
        """The driving device W = D V."""
        made = self._matrix(matrix, None, "matrix")
        err = self._change()
        check(lib.cps_system_set_drive(self._c, len(made), *_entries(made), err), err)

    def load(self, forces: Numbers) -> None:
        """The constant load [N], dual to V."""
        made = _numbers.array(forces, (self.parameters,), "load")
        err = self._change()
        check(lib.cps_system_set_load(self._c, _data(made), err), err)

    @property
    def laws(self) -> List[str]:
        """The names of the laws."""
        return [text(lib.cps_system_law_name(self._c, k)) for k in range(lib.cps_system_law_count(self._c))]

    def eliminate(self) -> Law:
        """The law between driving velocities and the resistance that the device feels (Proposition 1 of Moreau 1977)."""
        law, condition, err = ffi.new("CpsLaw **"), ffi.new("CpsComposition *"), ffi.new("CpsError *")
        check(lib.cps_system_eliminate(self._c, law, ffi.NULL, condition, err), err)
        made = Law._of(law[0])
        made.composition = enum_word("CpsComposition", condition[0])
        return made

    def forces(self) -> Set:
        """The set of the resistances that the laws can balance, also under a load."""
        out, err = ffi.new("CpsSet **"), ffi.new("CpsError *")
        check(lib.cps_system_eliminate(self._c, ffi.NULL, out, ffi.NULL, err), err)
        return Set(out[0])

    def solve(self, driving: Numbers = (), **options: Any) -> "Motion":
        """A motion of least dissipation for the driving velocity W, with its proof.

        options: `tolerance`, `boundary`, `composition` of CpsMotionOptions (drive.h)"""
        m = lib.cps_system_drive_space(self._c)
        w = _numbers.array(driving, (m,), "driving")
        out, err = ffi.new("CpsMotion **"), ffi.new("CpsError *")
        given = _options(options)
        self._solved = True
        check(lib.cps_system_solve(self._c, _data(w), given, out, err), err)
        return Motion(self, ffi.gc(out[0], lib.cps_motion_destroy))

    def drive_path(self, duration: Numbers, driving: Numbers, **options: Any) -> Tuple[List[Record], np.ndarray]:
        """Drive along a path of velocities, each constant over an interval: the ledgers, and the travel at the end of each.

        duration: [s] (count) > 0; driving: (count, rows of the drive); options: as of `solve`

        Returns a list of reports (CpsPathStep of drive.h) and an array (intervals taken, parameters). The path ends after an
        interval that has no motion, which is then the last of the reports."""
        w = _numbers.array(driving, (None, lib.cps_system_drive_space(self._c)), "driving")
        count = len(w)
        h = _numbers.array(duration, (count,), "duration")
        steps, travel = ffi.new("CpsPathStep[]", max(count, 1)), np.zeros((count, self.parameters))
        done, err = ffi.new("int *"), ffi.new("CpsError *")
        check(lib.cps_system_drive_path(self._c, count, _data(h), _data(w), _options(options), steps, _data(travel), done, err), err)
        return [Record(ffi.new("CpsPathStep *", steps[i])) for i in range(done[0])], travel[:done[0]].copy()


class Motion:
    """A motion of a system: `velocity`, `resistance`, and `forces` and `velocities` of the laws by name.

    `report` is its proof (CpsMotionReport of drive.h): gamma lies between `lower` and `upper`."""

    def __init__(self, system: System, c: Any) -> None:
        self.system, self._c = system, c
        self.report = Record(ffi.new("CpsMotionReport *", lib.cps_motion_report(c)))

    @property
    def outcome(self) -> str:
        return self.report.outcome

    @property
    def value(self) -> float:
        """[W] gamma(W), the least dissipation."""
        return self.report.value

    def _array(self, pointer: Any, count: int) -> np.ndarray:
        made = np.frombuffer(ffi.buffer(pointer, 8 * count), np.float64).copy() if count else np.zeros(0)
        made.flags.writeable = False
        return made

    @property
    def velocity(self) -> np.ndarray:
        """V (parameters)."""
        return self._array(lib.cps_motion_velocity(self._c), self.system.parameters)

    @property
    def resistance(self) -> np.ndarray:
        """G: what the driving device feels."""
        return self._array(lib.cps_motion_resistance(self._c), lib.cps_system_drive_space(self.system._c))

    def _laws(self, function: Any) -> Dict[str, np.ndarray]:
        c = self.system._c
        return {name: self._array(function(self._c, k), lib.cps_system_law_space(c, k)) for k, name in enumerate(self.system.laws)}

    @property
    def forces(self) -> Dict[str, np.ndarray]:
        """F of each law."""
        return self._laws(lib.cps_motion_law_force)

    @property
    def velocities(self) -> Dict[str, np.ndarray]:
        """U of each law."""
        return self._laws(lib.cps_motion_law_velocity)

    @property
    def direction(self) -> np.ndarray:
        """(parameters) of a motion that is not attained: along it ever faster velocities dissipate less; else 0."""
        return self._array(lib.cps_motion_direction(self._c), self.system.parameters)

    @property
    def constraint_forces(self) -> np.ndarray:
        """lambda, a force for each row of the constraints."""
        return self._array(lib.cps_motion_constraint_forces(self._c), lib.cps_motion_constraint_count(self._c))

    @property
    def shares(self) -> Dict[str, Record]:
        """The share of each law (CpsMotionShare of drive.h)."""
        return {name: Record(ffi.new("CpsMotionShare *", lib.cps_motion_law_share(self._c, k))) for k, name in enumerate(self.system.laws)}

    @property
    def continuous(self) -> Optional[bool]:
        """Whether the dissipation is finite and continuous at a velocity that agrees with W; None where rounding hides it."""
        known, holds, err = ffi.new("_Bool *"), ffi.new("_Bool *"), ffi.new("CpsError *")
        check(lib.cps_motion_continuous(self._c, known, holds, err), err)
        return bool(holds[0]) if known[0] else None

    def _all(self, function: Any, count: int, tolerance: float) -> "Solutions":
        out, low, high, err = ffi.new("CpsSolutionSet *"), np.zeros(count), np.zeros(count), ffi.new("CpsError *")
        check(function(self._c, _numbers.number(tolerance, "tolerance"), out, _data(low), _data(high), err), err)
        try:
            return Solutions(out, low, high)
        finally:
            lib.cps_solution_set_clear(out)

    def all_velocities(self, tolerance: float = 0.0) -> "Solutions":
        """All V that go with W."""
        return self._all(lib.cps_motion_velocities, self.system.parameters, tolerance)

    def all_forces(self, tolerance: float = 0.0) -> "Solutions":
        """All forces (of all laws, one after the other) that go with W."""
        c = self.system._c
        return self._all(lib.cps_motion_forces, sum(lib.cps_system_law_space(c, k) for k in range(lib.cps_system_law_count(c))), tolerance)

    def all_resistances(self, tolerance: float = 0.0) -> "Solutions":
        """All resistances G that go with W."""
        return self._all(lib.cps_motion_resistances, lib.cps_system_drive_space(self.system._c), tolerance)

    def __repr__(self) -> str:
        return f"<Motion: {self.outcome}, gamma {self.value:.6g} W>"


class Solutions:
    """A set of solutions: `set`, None where it is not known, and of which each component has the extent `low` to `high`.

    `report` has its dimension, whether it is unique and bounded, and how sure that is (CpsSolutionSet of drive.h)."""

    def __init__(self, c: Any, low: np.ndarray, high: np.ndarray) -> None:
        self.set = Set(c.set, retain=True) if c.set != ffi.NULL else None
        kept = ffi.new("CpsSolutionSet *", c[0])
        kept.set = ffi.NULL
        self.report, self.low, self.high = Record(kept), low, high

    def __repr__(self) -> str:
        return f"<Solutions: {self.report.outcome}, dimension {self.report.dimension}>"
