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
        self._c = ffi.gc(out[0], lib.cps_system_destroy)
        self._solved = False

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

    def solve(self, driving: Numbers = ()) -> "Motion":
        """A motion of least dissipation for the driving velocity W, with its proof."""
        m = lib.cps_system_drive_space(self._c)
        w = _numbers.array(driving, (m,), "driving")
        out, err = ffi.new("CpsMotion **"), ffi.new("CpsError *")
        self._solved = True
        check(lib.cps_system_solve(self._c, _data(w), ffi.NULL, out, err), err)
        return Motion(self, ffi.gc(out[0], lib.cps_motion_destroy))


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

    def __repr__(self) -> str:
        return f"<Motion: {self.outcome}, gamma {self.value:.6g} W>"
