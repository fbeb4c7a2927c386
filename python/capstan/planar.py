# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies that slide on a plane: limit surfaces, pushing, towing, sweeping, planimeters, ropes on a table (docs/planar.md).

A body rests on patches. Its velocity is a twist (vx, vy, w) [m/s, m/s, rad/s] in body axes, friction acts on it by a wrench
(Fx, Fy, M) [N, N, N m] about its origin."""
from __future__ import annotations

import math
from typing import Any, Optional, Sequence, Tuple

import numpy as np

from . import _numbers
from ._errors import ArgumentError, check
from ._native import ffi, lib
from ._record import Record, enum_value
from .laws import Law
from .sets import Answer, Numbers, _answered, _data
from .systems import System


class Patch:
    """What a body stands on: a "point", "wheel", "rod", "ring", "disc" or "polygon" (CpsPatch of planar.h).

    position: [m] (2) contact; middle of rod, ring and disc; origin of the corners
    angle:    [degrees] of its first axis: of the rod, of the wheel's rolling direction, of the law
    friction, load: coefficient [-] and normal force [N] of the whole patch
    size:     [m] half length of a rod; radius of a wheel, ring or disc
    brake:    [N m] of a wheel; infinite: locked
    tilt:     [1/m] (2) of the pressure of areas; a rod has the first only
    corners:  [m] (corners, 2) of a polygon, counterclockwise
    law:      of a point, a bounded Law of two components, in place of friction and load
    """

    def __init__(self, kind: str, *, position: Numbers = (0, 0), angle: float = 0.0, friction: float = 0.0, load: float = 0.0,
                 size: float = 0.0, brake: float = 0.0, tilt: Numbers = (0, 0), corners: Optional[Numbers] = None,
                 law: Optional[Law] = None) -> None:
        c = self._c = ffi.new("CpsPatch *", lib.cps_patch_default())
        try:
            c.kind = enum_value("CpsPatchKind", kind)
        except ValueError as error:
            raise ArgumentError(f"kind: {error}") from None
        self.kind = kind
        c.position = _numbers.array(position, (2,), "position").tolist()
        c.angle = math.radians(_numbers.number(angle, "angle"))
        c.friction, c.load = _numbers.number(friction, "friction"), _numbers.number(load, "load")
        c.size, c.brake = _numbers.number(size, "size"), _numbers.number(brake, "brake", infinite=True)
        c.tilt = _numbers.array(tilt, (2,), "tilt").tolist()
        if corners is not None:
            self._corners = _numbers.array(corners, (None, 2), "corners")
            c.corner_count, c.corner = len(self._corners), ffi.cast("double *", _data(self._corners))
        if law is not None:
            if not isinstance(law, Law):
                raise ArgumentError(f"law: found {type(law).__name__}, expected a Law")
            self._law, c.law = law, law._friction()
        err = ffi.new("CpsError *")
        check(lib.cps_patch_check(c, err), err)

    def __repr__(self) -> str:
        return f"<Patch: {self.kind}>"


class PlanarBody:
    """A body that slides on patches.

    >>> disc = PlanarBody([Patch("disc", friction=0.5, load=100, size=0.3)])
    >>> round(disc.dissipation([0, 0, 1]), 9), round(disc.dissipation([2, 0, 0]), 9)   # mu N 2 r/3, mu N v
    (10.0, 100.0)
    >>> disc.drive([[1, 0, 0]], [1]).twist.round(6).tolist()                           # pushed through its centre
    [1.0, 0.0, 0.0]
    """

    def __init__(self, patches: Sequence[Patch]) -> None:
        made = list(patches)
        if not made or not all(isinstance(patch, Patch) for patch in made):
            raise ArgumentError("patches: expected a list of at least one Patch")
        array = ffi.new("CpsPatch[]", [patch._c[0] for patch in made])
        out, err = ffi.new("CpsPlanar **"), ffi.new("CpsError *")
        check(lib.cps_planar_create(len(made), array, out, err), err)
        self._c = ffi.gc(out[0], lib.cps_planar_destroy)

    def __len__(self) -> int:
        """The number of patches."""
        return lib.cps_planar_patch_count(self._c)

    # ---- the law ----

    def _dissipation(self, twist: Numbers) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        v = _numbers.rows(twist, 3, "twist")
        value, wrench, by_patch = np.empty(v.shape[:-1]), np.empty_like(v), np.empty((*v.shape[:-1], len(self)))
        answer, err = ffi.new("CpsSetAnswer *"), ffi.new("CpsError *")
        for k in np.ndindex(value.shape):
            check(lib.cps_planar_dissipation(self._c, _data(v[k]), _data(wrench[k]), _data(by_patch[k]), answer, err), err)
            _answered(answer.outcome)
            value[k] = answer.value
        return value, wrench, by_patch

    def dissipation(self, twist: Numbers) -> Answer:
        """[W] the power that friction takes from a twist, by closed forms. Shape (.., 3) -> (..)."""
        return self._dissipation(twist)[0][()]

    def wrench(self, twist: Numbers) -> np.ndarray:
        """[N, N, N m] a wrench of friction at each twist. Shape (.., 3) -> (.., 3)."""
        return self._dissipation(twist)[1]

    def by_patch(self, twist: Numbers) -> np.ndarray:
        """[W] what each patch dissipates. Shape (.., 3) -> (.., patches)."""
        return self._dissipation(twist)[2]

    def bounds(self, twist: Numbers, tolerance: float = 0.0) -> Record:
        """Bounds of the dissipation by sums that share nothing with the closed forms (CpsPlanarBounds of planar.h)."""
        out, err = ffi.new("CpsPlanarBounds *"), ffi.new("CpsError *")
        check(lib.cps_planar_bounds(self._c, _data(_numbers.array(twist, (3,), "twist")), _numbers.number(tolerance, "tolerance"),
                                    out, err), err)
        return Record(out)

    def law(self, side: str = "inner", cells: int = 100) -> Law:
        """A law on wrenches, whose set lies inside the true one ("inner") or encloses it ("outer"); exact of points and wheels."""
        out, err = ffi.new("CpsLaw **"), ffi.new("CpsError *")
        check(lib.cps_planar_law(self._c, _side(side), _numbers.count(cells, "cells"), out, err), err)
        return Law._of(out[0])

    def system(self, side: str = "inner", cells: int = 100) -> System:
        """The body as a System without a drive: its parameters are the twist, and the spins of braked wheels."""
        out, err = ffi.new("CpsSystem **"), ffi.new("CpsError *")
        check(lib.cps_planar_system(self._c, _side(side), _numbers.count(cells, "cells"), out, err), err)
        return System._of(out[0])

    def wheel(self, patch: int, twist: Numbers) -> Record:
        """What a wheel does while the body moves (CpsWheelMotion of planar.h)."""
        out, err = ffi.new("CpsWheelMotion *"), ffi.new("CpsError *")
        check(lib.cps_planar_wheel(self._c, _numbers.count(patch, "patch"), _data(_numbers.array(twist, (3,), "twist")), out, err), err)
        return Record(out)

    # ---- driven ----

    def drive(self, matrix: Numbers, velocity: Numbers) -> Record:
        """The motion of least dissipation with matrix @ twist = velocity (CpsPlanarMotion of planar.h)."""
        rows, w = _drive(matrix, velocity)
        out, err = ffi.new("CpsPlanarMotion *"), ffi.new("CpsError *")
        check(lib.cps_planar_drive(self._c, len(rows), _data(rows), _data(w), out, err), err)
        return Record(out)

    def motions(self, matrix: Numbers, velocity: Numbers, tolerance: float = 0.0) -> Tuple[np.ndarray, np.ndarray]:
        """The least and the largest of each component over all motions that dissipate as little: (low (3), high (3))."""
        rows, w = _drive(matrix, velocity)
        low, high, err = np.empty(3), np.empty(3), ffi.new("CpsError *")
        check(lib.cps_planar_motions(self._c, len(rows), _data(rows), _data(w), _numbers.number(tolerance, "tolerance"),
                                     _data(low), _data(high), err), err)
        return low, high


def _side(side: str) -> int:
    try:
        return enum_value("CpsPlanarSide", side)
    except ValueError as error:
        raise ArgumentError(f"side: {error}") from None


def _drive(matrix: Numbers, velocity: Numbers) -> Tuple[np.ndarray, np.ndarray]:
    rows = _numbers.array(matrix, (None, 3), "matrix")
    return rows, _numbers.array(velocity, (len(rows),), "velocity")


def moved(pose: Numbers, twist: Numbers) -> np.ndarray:
    """A pose (x, y, angle) [m, m, rad], carried exactly along the screw motion of a twist increment in body axes."""
    made = _numbers.array(pose, (3,), "pose").copy()
    lib.cps_planar_move(_data(made), _data(_numbers.array(twist, (3,), "twist")))
    return made


class _State:
    """A state of C with its ledger, which steps change."""

    _c: Any

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(Record(self._c), name)

    def __repr__(self) -> str:
        return repr(Record(self._c))


class Tow(_State):
    """A body that is drawn by its hitch, or by an inextensible rope, step by step (CpsTow of planar.h).

    hitch: [m] (2) in body axes; rope: [m] its length, 0: the hitch itself is moved; end: [m] (2) where its far end is

    >>> body = PlanarBody([Patch("point", friction=1, load=1)])
    >>> tow = Tow(body, pose=[0, 0, 0], rope=1.0, end=[1, 0])
    >>> tow.step([1.5, 0]).pulled, tow.pose.round(6).tolist()
    (True, [0.5, 0.0, 0.0])
    """

    def __init__(self, body: PlanarBody, *, pose: Numbers = (0, 0, 0), hitch: Numbers = (0, 0), rope: float = 0.0,
                 end: Numbers = (0, 0)) -> None:
        if not isinstance(body, PlanarBody):
            raise ArgumentError(f"body: found {type(body).__name__}, expected a PlanarBody")
        self._body, self._c = body, ffi.new("CpsTow *", lib.cps_tow_default())
        self._c.pose = _numbers.array(pose, (3,), "pose").tolist()
        self._c.hitch = _numbers.array(hitch, (2,), "hitch").tolist()
        self._c.rope = _numbers.number(rope, "rope")
        self._c.end = _numbers.array(end, (2,), "end").tolist()

    def step(self, target: Numbers) -> Record:
        """Move the driven end to `target` [m] (2); reports on the step (CpsTowStep of planar.h)."""
        out, err = ffi.new("CpsTowStep *"), ffi.new("CpsError *")
        check(lib.cps_planar_tow(self._body._c, self._c, _data(_numbers.array(target, (2,), "target")), out, err), err)
        return Record(out)


class Sweep(_State):
    """A block with a friction law on a spring whose far end is moved (CpsSweep of planar.h).

    >>> from capstan.sets import interval
    >>> block = Sweep(Law(interval(2.0)), stiffness=10.0)
    >>> float(block.step([0.1]).slid[0]), round(float(block.step([0.5]).slid[0]), 12)      # holds 2 N: 0.2 m of spring
    (0.0, 0.3)
    """

    def __init__(self, law: Law, *, stiffness: float, position: Optional[Numbers] = None, end: Optional[Numbers] = None) -> None:
        if not isinstance(law, Law) or law.space > 3:
            raise ArgumentError("law: expected a Law of 1 to 3 components")
        self._law, self._n, self._c = law, law.space, ffi.new("CpsSweep *", lib.cps_sweep_default())
        self._c.stiffness = _numbers.number(stiffness, "stiffness")
        for name, value in (("position", position), ("end", end)):
            if value is not None:
                setattr(self._c, name, _numbers.array(value, (self._n,), name).tolist())

    def step(self, end: Numbers) -> Record:
        """Move the far end there [m]; reports on the step (CpsSweepStep of planar.h)."""
        out, err = ffi.new("CpsSweepStep *"), ffi.new("CpsError *")
        check(lib.cps_sweep_step(self._law._friction(), self._c, _data(_numbers.array(end, (self._n,), "end")), out, err), err)
        return Record(out)


def planimeter(points: Numbers, *, steps: int = 100, pole: Numbers = (0, 0), pole_arm: float, tracer_arm: float, friction: float,
               load: float, wheel: float = 0.0, left_elbow: bool = False) -> Record:
    """Trace a closed polygon (points, 2) [m] by a polar planimeter: what it reads (CpsPlanimeterReading of planar.h).

    >>> square = [[0.2, 0.2], [0.4, 0.2], [0.4, 0.4], [0.2, 0.4]]
    >>> reading = planimeter(square, pole_arm=0.5, tracer_arm=0.4, friction=0.3, load=1)
    >>> round(reading.area, 6), round(reading.exact, 6)
    (0.04, 0.04)
    """
    x = _numbers.array(points, (None, 2), "points")
    c = ffi.new("CpsPlanimeter *", lib.cps_planimeter_default())
    c.pole = _numbers.array(pole, (2,), "pole").tolist()
    for name, value in (("pole_arm", pole_arm), ("tracer_arm", tracer_arm), ("wheel", wheel), ("friction", friction), ("load", load)):
        setattr(c, name, _numbers.number(value, name))
    if not isinstance(left_elbow, (bool, np.bool_)):
        raise ArgumentError(f"left_elbow: found {left_elbow!r}, expected True or False")
    c.left_elbow = bool(left_elbow)
    out, err = ffi.new("CpsPlanimeterReading *"), ffi.new("CpsError *")
    check(lib.cps_planimeter_check(c, len(x), _data(x), err), err)
    check(lib.cps_planimeter_trace(c, len(x), _data(x), _numbers.count(steps, "steps"), out, err), err)
    return Record(out)


def rope(nodes: Numbers, resistance: float, *, driven: Tuple[bool, bool] = (False, True), slack: bool = False) -> System:
    """A heavy inextensible rope that lies on a rough table, as a System that is driven at its ends (CpsRope of planar.h).

    nodes:      [m] (nodes, 2)
    resistance: [N/m] friction coefficient times weight per length
    driven:     whether the velocity of the first, of the last node is imposed
    slack:      elements may become shorter, without tension

    >>> straight = rope([[0, 0], [1, 0], [2, 0]], 3.0)
    >>> round(straight.solve([1, 0]).value, 6)                # 2 m of it, at 1 m/s
    6.0
    """
    x = _numbers.array(nodes, (None, 2), "nodes")
    c = ffi.new("CpsRope *", lib.cps_rope_default())
    c.node_count, c.node, c.resistance = len(x), ffi.cast("double *", _data(x)), _numbers.number(resistance, "resistance")
    ends = list(driven) if isinstance(driven, (list, tuple, np.ndarray)) else []
    if len(ends) != 2 or not all(isinstance(value, (bool, np.bool_)) for value in [*ends, slack]):
        raise ArgumentError("driven: expected two of True and False, and slack one of them")
    c.driven, c.slack = [bool(value) for value in ends], bool(slack)
    out, err = ffi.new("CpsSystem **"), ffi.new("CpsError *")
    check(lib.cps_rope_check(c, err), err)
    check(lib.cps_rope_system(c, out, err), err)
    return System._of(out[0])
