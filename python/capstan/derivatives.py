# SPDX-License-Identifier: BSD-3-Clause
"""Derivatives of anything that can be measured by what a move changes: differences of moves that are taken back."""
from __future__ import annotations

from typing import Any, Callable, List, Mapping, NamedTuple, Optional

import numpy as np

from . import _numbers
from ._errors import ArgumentError, NoAnswer
from .evolution import Evolution
from .sets import Numbers


class Derivative(NamedTuple):
    """Along each direction, the first axis. With friction the way forth and the way back differ: each is the
    rate of change for a motion that way. Both are per unit of the vector, so they agree where friction does not act."""

    forth: np.ndarray
    back: np.ndarray

    @property
    def mean(self) -> np.ndarray:
        """Of the two; where there is no friction, the central difference."""
        return 0.5 * (self.forth + self.back)


def derivative(evolution: Evolution, change: Mapping[str, Any], measure: Callable[[Evolution], Any], *,
               step: float, directions: Optional[Numbers] = None) -> Derivative:
    """How what `measure` finds after a move changes with the vector of that move.

    change:  one vector of a target, as {"rope.B": {"position": [1, 0, 0]}} or {"gravity": [0, 0, -9.81]}: where the
             derivative is wanted; usually what holds now
    measure: called after each move with the evolution; a number or an array, always of the same shape
    step:    how far to move along each direction, in the unit of the vector. A large one errs by the curvature, a small one
             by the accuracy of the steps over it
    directions: (k, components of the vector) along which; by default along each component. On a floor, not into it

    Returns arrays (directions, shape of what was measured), per unit of a direction. Every move is taken back, so that the
    evolution is as it was, bit for bit. NoAnswer where a move has no certified answer.

    >>> rope = Evolution({"lines": {"rope": {"length": 2, "mass": 1, "stiffness": 1e4, "elements": 10, "start": "static",
    ...                   "ends": {"A": {"held": [0, 0, 0]}, "B": {"held": [1, 0, 0]}}}}})
    >>> rope.step().outcome
    'solved'
    >>> found = derivative(rope, {"rope.B": {"position": [1, 0, 0]}}, lambda now: now["rope"].B.force, step=1e-3)
    >>> bool(np.abs(found.mean - rope["rope"].stiffness("B")).max() < 1e-5 * found.mean.max())
    True
    """
    far = _numbers.number(step, "step")
    if not far > 0:
        raise ArgumentError(f"step: found {far:g}, expected more than 0")
    target = evolution.target(change)
    keys = [key for key in change if key != "name"]
    if len(keys) != 1:
        raise ArgumentError(f"change: found {len(keys)} changes, expected one vector")
    vector = target[keys[0]]
    if vector.ndim != 1:
        raise ArgumentError(f"change: {keys[0]!r} has several vectors, expected one")

    def after() -> np.ndarray:
        evolution.move(target)
        try:
            if not evolution.certified:
                raise NoAnswer(f"the move to {vector.tolist()} has no certified answer: a smaller step may have one",
                               outcome=str(evolution.report.outcome))
            return np.array(measure(evolution), float)
        finally:
            evolution.take_back()

    start = vector.copy()
    along = np.eye(vector.size) if directions is None else _numbers.array(directions, (None, vector.size), "directions")
    here = after()
    forth: List[np.ndarray] = []
    back: List[np.ndarray] = []
    for direction in along:
        vector[:] = start + far * direction
        forth.append((after() - here) / far)
        vector[:] = start - far * direction
        back.append((here - after()) / far)
    return Derivative(np.array(forth), np.array(back))
