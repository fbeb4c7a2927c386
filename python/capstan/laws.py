# SPDX-License-Identifier: BSD-3-Clause
"""Friction, loaded and resistance laws: which forces a velocity allows, which velocities a force allows, and the power.

A friction law is a set C of forces that contains 0, with -V in the normal cone of C at F (docs/laws.md)."""
from __future__ import annotations

import os
from typing import Any, Callable, Dict, Optional, Sequence, Tuple, Union

import numpy as np

from . import _numbers
from ._errors import ArgumentError, check
from ._native import ffi, lib
from ._record import Record, enum_word
from .sets import Answer, Numbers, Set, _answered, _data


class Law:
    """A friction law, or a loaded law: its `set` of forces, and what follows from it.

    >>> from capstan.sets import disc
    >>> ground = Law(disc(500))
    >>> float(ground.dissipation([3, 4])), ground.force([0, 2]).tolist()
    (2500.0, [0.0, -500.0])
    """

    _tree: Optional[Dict[str, Any]]
    load: Optional[np.ndarray]

    def __init__(self, forces: Set, load: Optional[Numbers] = None) -> None:
        """The law whose forces are a set that contains 0; with a constant `load`, the loaded law."""
        if not isinstance(forces, Set):
            raise ArgumentError(f"forces: found {type(forces).__name__}, expected a Set")
        out, err = ffi.new("CpsLaw **"), ffi.new("CpsError *")
        check(lib.cps_law_friction(forces._c, out, err), err)
        self._take(out[0], load)
        self._tree = forces._tree

    def _take(self, c: Any, load: Optional[Numbers] = None) -> None:
        self._c = ffi.gc(c, lib.cps_law_release)
        self._tree = None
        self.composition: Optional[str] = None
        self.load = None
        self.set = Set(lib.cps_law_set(self._c), retain=True)
        if load is not None:
            self.load = _numbers.array(load, (self.space,), "load")
            self.set = self.set + self.load

    @classmethod
    def _of(cls, c: Any) -> "Law":
        law = cls.__new__(cls)
        law._take(c)
        return law

    @classmethod
    def unit_load(cls, unit: Set, load: float) -> "Law":
        """N times a set of friction coefficients, N the normal force."""
        out, err = ffi.new("CpsLaw **"), ffi.new("CpsError *")
        check(lib.cps_law_unit_load(unit._c, _numbers.number(load, "load"), out, err), err)
        return cls._of(out[0])

    @classmethod
    def read(cls, path: Union[str, "os.PathLike[str]"]) -> Union["Law", "Resistance"]:
        """The law of a law file (docs/formats.md)."""
        out, err = ffi.new("CpsLawFile **"), ffi.new("CpsError *")
        check(lib.cps_law_read(os.fsencode(os.fspath(path)), ffi.NULL, out, err), err)
        return _from_file(ffi.gc(out[0], lib.cps_law_file_destroy))

    @classmethod
    def from_yaml(cls, yaml: str, name: str = "<law>") -> Union["Law", "Resistance"]:
        """The law of the text of a law file."""
        if not isinstance(yaml, str) or "\0" in yaml:
            raise ArgumentError("yaml: expected a text without zero bytes")
        out, err = ffi.new("CpsLawFile **"), ffi.new("CpsError *")
        check(lib.cps_law_read_text(yaml.encode("utf-8", "surrogatepass"), os.fsencode(name), ffi.NULL, out, err), err)
        return _from_file(ffi.gc(out[0], lib.cps_law_file_destroy))

    def preimage(self, matrix: Numbers) -> "Law":
        """The law of a system whose forces act through L (space, n): C' = L^-1(C). Its `composition` says whether every
        pair of it comes from a motion of the parts: "interior", .., or "not_satisfied"."""
        made = _numbers.array(matrix, (self.space, None), "matrix")
        condition, out, err = ffi.new("CpsComposition *"), ffi.new("CpsLaw **"), ffi.new("CpsError *")
        check(lib.cps_law_preimage(made.shape[1], _data(made), self._friction(), condition, out, err), err)
        law = Law._of(out[0])
        law.composition = enum_word("CpsComposition", condition[0])
        return law

    def __mul__(self, other: "Law") -> "Law":
        """Independent laws side by side."""
        out, err = ffi.new("CpsLaw **"), ffi.new("CpsError *")
        if not isinstance(other, Law):
            raise ArgumentError(f"product: found {type(other).__name__}, expected a Law")
        check(lib.cps_law_product(2, ffi.new("CpsLaw *[]", [self._friction(), other._friction()]), out, err), err)
        return Law._of(out[0])

    def _friction(self) -> Any:
        if self.load is not None:
            raise ArgumentError("a loaded law cannot be composed: compose its friction law, and load the result")
        return self._c

    @property
    def space(self) -> int:
        """The number of components of forces and velocities."""
        return lib.cps_law_space(self._c)

    def dissipation(self, velocity: Numbers) -> Answer:
        """[W] phi(V), the power that any force of the law takes from the motion. Shape (.., n) -> (..)."""
        return self.set._many(lib.capstan_dissipation_many, velocity, "velocity", lib.CPS_SET_OUTCOME_UNBOUNDED,
                              lib.CPS_SET_OUTCOME_NOT_ATTAINED, wanted=False)[0][()]

    def force(self, velocity: Numbers) -> np.ndarray:
        """[N] a force of the law at each velocity. Shape (.., n) -> (.., n)."""
        return self.set._many(lib.capstan_dissipation_many, velocity, "velocity")[1]

    def forces(self, velocity: Numbers, tolerance: float = 0.0) -> Set:
        """All forces of the law at a velocity."""
        return self.set._set_of(lib.cps_set_forces, velocity, "velocity", tolerance)

    def velocities(self, force: Numbers, tolerance: float = 0.0) -> Set:
        """All velocities of the law at a force."""
        return self.set._set_of(lib.cps_set_velocities, force, "force", tolerance)

    def residual(self, force: Numbers, velocity: Numbers) -> Record:
        """How far a pair is from the law, in the equivalent forms of CpsSetResidual (law.h)."""
        f, v = (_numbers.array(x, (self.space,), what) for x, what in ((force, "force"), (velocity, "velocity")))
        residual, err = ffi.new("CpsSetResidual *"), ffi.new("CpsError *")
        check(lib.cps_set_residual(self.set._c, _data(f), _data(v), 0, residual, err), err)
        return Record(residual)

    def to_tree(self) -> Dict[str, Any]:
        if self._tree is None:
            raise ArgumentError("no words of a file for this law")
        return self._tree

    def __repr__(self) -> str:
        return f"<{'loaded law' if self.load is not None else 'Law'} of {self.set}>"


def coulomb(friction: float, load: float) -> Law:
    """Coulomb's law with a given normal force: forces in a disc of radius friction x load."""
    f, n = _numbers.number(friction, "friction"), _numbers.number(load, "load")
    out, err = ffi.new("CpsLaw **"), ffi.new("CpsError *")
    check(lib.cps_law_coulomb(f, n, out, err), err)
    law = Law._of(out[0])
    law._tree = {"coulomb": {"friction": f, "load": n}}
    return law


def contacts(parts: Sequence[Tuple[Numbers, Law]]) -> Law:
    """A rigid body on several contacts, each with its matrix B (space of the contact, n) and its law."""
    if not parts:
        raise ArgumentError("contacts: expected at least one")
    maps = [_numbers.array(matrix, (law.space, None), "matrix") for matrix, law in parts]
    n = maps[0].shape[1]
    maps = [_numbers.array(matrix, (None, n), "matrix") for matrix in maps]
    held = [_data(matrix) for matrix in maps]
    out, err = ffi.new("CpsLaw **"), ffi.new("CpsError *")
    check(lib.cps_law_contacts(n, len(parts), ffi.new("CpsLaw *[]", [law._friction() for _, law in parts]),
                               ffi.new("double *[]", held), out, err), err)
    return Law._of(out[0])


class Resistance:
    """A resistance law -F in dphi(V): terms that are joined by +. The functions of this module make them.

    >>> from capstan.sets import disc
    >>> law = dry(Law(disc(1))) + viscous([[2, 0], [0, 2]])
    >>> law.potential([1, 0]), law.power([1, 0])
    (2.0, 3.0)
    """

    def __init__(self, c: Any, retain: bool = False) -> None:
        self._c = ffi.gc(lib.cps_resistance_retain(c) if retain else c, lib.cps_resistance_release)

    @classmethod
    def _make(cls, function: Callable[..., int], *arguments: Any) -> "Resistance":
        out, err = ffi.new("CpsResistance **"), ffi.new("CpsError *")
        check(function(*arguments, out, err), err)
        return cls(out[0])

    def __add__(self, other: "Resistance") -> "Resistance":
        if not isinstance(other, Resistance):
            return NotImplemented
        return Resistance._make(lib.cps_resistance_sum, 2, ffi.new("CpsResistance *[]", [self._c, other._c]))

    @property
    def space(self) -> int:
        return lib.cps_resistance_space(self._c)

    def _value(self, velocity: Numbers) -> Any:
        v = _numbers.array(velocity, (self.space,), "velocity")
        value, err = ffi.new("CpsResistanceValue *"), ffi.new("CpsError *")
        check(lib.cps_resistance_value(self._c, _data(v), value, ffi.NULL, err), err)
        _answered(value.outcome, lib.CPS_SET_OUTCOME_UNBOUNDED)
        return value

    def potential(self, velocity: Numbers) -> float:
        """[W] phi(V)."""
        return self._value(velocity).potential

    def power(self, velocity: Numbers) -> float:
        """[W] the power dissipated at V."""
        return self._value(velocity).power

    def _set(self, function: Callable[..., int], x: Numbers, what: str, *tolerance: float) -> Set:
        vector, out = _numbers.array(x, (self.space,), what), ffi.new("CpsSet **")
        answer, err = ffi.new("CpsSetAnswer *"), ffi.new("CpsError *")
        check(function(self._c, _data(vector), *tolerance, out, answer, err), err)
        _answered(answer.outcome)
        return Set(out[0])

    def forces(self, velocity: Numbers) -> Set:
        """All forces of the law at a velocity."""
        return self._set(lib.cps_resistance_forces, velocity, "velocity", 0.0)

    def velocities(self, force: Numbers) -> Set:
        """All velocities of the law at a force."""
        return self._set(lib.cps_resistance_velocities, force, "force")

    def __repr__(self) -> str:
        return f"<Resistance of {lib.cps_resistance_term_count(self._c)} terms in {self.space} components>"


def _of_law(law: Any) -> Any:
    if not isinstance(law, Law):
        raise ArgumentError(f"law: found {type(law).__name__}, expected a Law")
    return law._friction()


def dry(law: Law) -> Resistance:
    """Dry friction: phi = g, the dissipation function of the law."""
    return Resistance._make(lib.cps_resistance_dry, _of_law(law))


def viscous(matrix: Numbers) -> Resistance:
    """Linear viscosity: phi = <V, D V>/2, D (n, n) [N s/m] symmetric and positive semidefinite."""
    d = _numbers.array(matrix, (None, None), "matrix")
    if d.shape[0] != d.shape[1]:
        raise ArgumentError(f"matrix: found the shape {d.shape}, expected a square matrix")
    return Resistance._make(lib.cps_resistance_viscous, len(d), _data(d))


def power(law: Law, degree: float, factor: float = 1.0) -> Resistance:
    """phi = factor g^degree / degree, degree > 1."""
    return Resistance._make(lib.cps_resistance_power, _of_law(law), _numbers.number(degree, "degree"), _numbers.number(factor, "factor"))


def table(law: Law, points: Numbers) -> Resistance:
    """Friction times a factor that depends on the speed: rows (speed, factor) from speed 0, neither falling."""
    p = _numbers.array(points, (None, 2), "points")
    speed, factor = np.ascontiguousarray(p[:, 0]), np.ascontiguousarray(p[:, 1])
    return Resistance._make(lib.cps_resistance_table, _of_law(law), len(p), _data(speed), _data(factor))


def _from_file(file: Any) -> Union[Law, Resistance]:
    resistance = lib.cps_law_file_resistance(file)
    if resistance != ffi.NULL:
        return Resistance(resistance, retain=True)
    loaded, whole = lib.cps_law_file_loaded(file), Set(lib.cps_law_file_set(file), retain=True)
    if loaded == ffi.NULL:
        law = Law(whole)
    else:
        load = np.array([lib.cps_loaded_law_load(loaded)[i] for i in range(whole.space)])
        law = Law(whole - load, load)
        law.set = whole
    condition, line = ffi.new("CpsComposition *"), ffi.new("int *")
    if lib.cps_law_file_composition(file, condition, line):
        law.composition = enum_word("CpsComposition", condition[0])
    return law
