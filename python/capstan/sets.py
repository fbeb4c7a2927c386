# SPDX-License-Identifier: BSD-3-Clause
"""Closed convex sets: made of primitives by operators, and asked for support, projection, faces and normal cones.

    from capstan.sets import disc, segment
    S = disc(2) + segment([0, -1], [0, 1])       # sum; also A @ S, S & T (common points), S | T (hull), S * T (product)
    S.support([[1, 0], [0, 1]])                  # for one direction, or for an array of them

docs/sets.md says how the answers are found, and how accurate they are."""
from __future__ import annotations

from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _numbers
from ._errors import ArgumentError, NoAnswer, check, text
from ._native import ffi, lib
from ._record import Record, enum_word

Numbers = Any  # what numpy takes for an array of numbers
Answer = Union[float, np.ndarray]


def _data(array: Optional[np.ndarray]) -> Any:
    return ffi.NULL if array is None else ffi.from_buffer("double[]", array)


def _answered(outcome: int, *fine: int) -> None:
    """Raise NoAnswer for an outcome other than ANSWERED and those that are fine."""
    if outcome != lib.CPS_SET_OUTCOME_ANSWERED and outcome not in fine:
        raise NoAnswer(text(lib.cps_set_outcome_text(outcome)), enum_word("CpsSetOutcome", outcome))


class Set:
    """A closed convex set in R^n. It does not change. The functions of this module make sets; operators join them.

    >>> S = disc(2) + segment([0, -1], [0, 1])
    >>> float(S.support([0, 1])), round(S.measure().perimeter - (4 * np.pi + 4), 9)
    (3.0, 0.0)
    >>> round((np.diag([1, 2]) @ disc(1) & box([0.5, 5])).support([0, 1]), 9)
    2.0
    """

    __array_ufunc__ = None  # numpy leaves the operators to this class

    def __init__(self, c: Any, tree: Optional[Dict[str, Any]] = None, retain: bool = False) -> None:
        self._c = ffi.gc(lib.cps_set_retain(c) if retain else c, lib.cps_set_release)
        self._tree = tree

    @classmethod
    def _make(cls, function: Callable[..., int], arguments: Sequence[Any], tree: Optional[Dict[str, Any]]) -> "Set":
        out, err = ffi.new("CpsSet **"), ffi.new("CpsError *")
        check(function(*arguments, out, err), err)
        return cls(out[0], tree)

    # ---- operators ----

    def __add__(self, other: Any) -> "Set":
        """The sum with a set, or the set translated by a vector."""
        if isinstance(other, Set):
            return _join(lib.cps_set_sum, "sum", [self, other])
        shift = _numbers.array(other, (self.space,), "vector")
        return Set._make(lib.cps_set_translate, [_data(shift), self._c], _word("translate", self, by=shift))

    __radd__ = __add__

    def __sub__(self, other: Any) -> "Set":
        """The set translated by minus a vector."""
        if isinstance(other, Set):
            return NotImplemented
        return self + -_numbers.array(other, (self.space,), "vector")

    def __neg__(self) -> "Set":
        return _scaled(-1.0, self)

    def __mul__(self, other: Any) -> "Set":
        """The product with a set, whose components follow, or the set multiplied by a number."""
        if isinstance(other, Set):
            return _join(lib.cps_set_product, "product", [self, other])
        return _scaled(_numbers.number(other, "factor"), self)

    def __rmul__(self, other: Any) -> "Set":
        return _scaled(_numbers.number(other, "factor"), self)

    def __rmatmul__(self, other: Any) -> "Set":
        """The image {A x} of the set under a matrix."""
        matrix = _numbers.array(other, (None, self.space), "matrix")
        return Set._make(lib.cps_set_image, [len(matrix), _data(matrix), self._c], _word("image", self, map=matrix))

    def __and__(self, other: "Set") -> "Set":
        """The points that both have in common."""
        return _join(lib.cps_set_intersection, "intersection", [self, other])

    def __or__(self, other: "Set") -> "Set":
        """The closed convex hull of both."""
        return _join(lib.cps_set_hull, "hull", [self, other])

    def preimage(self, matrix: Numbers, shift: Optional[Numbers] = None) -> "Set":
        """{x : L x + shift in set}."""
        made = _numbers.array(matrix, (self.space, None), "matrix")
        by = None if shift is None else _numbers.array(shift, (self.space,), "shift")
        tree = _word("preimage", self, map=made) if by is None else None
        return Set._make(lib.cps_set_preimage, [made.shape[1], _data(made), _data(by), self._c], tree)

    def polar(self) -> "Set":
        """{x : <x, y> <= 1 for every y of the set}."""
        return Set._make(lib.cps_set_polar, [self._c], None if self._tree is None else {"polar": self._tree})

    # ---- questions that are asked for one vector, or for an array of them (.., n) ----

    def _many(self, function: Callable[..., int], x: Numbers, what: str, *fine: int,
              wanted: bool = True) -> Tuple[np.ndarray, np.ndarray]:
        vectors = _numbers.rows(x, self.space, what)
        shape, count = vectors.shape[:-1], vectors.size // self.space
        value, gap, outcome = np.empty(shape), np.empty(shape), np.empty(shape, np.int32)
        points = np.empty(vectors.shape) if wanted else None
        err = ffi.new("CpsError *")
        check(function(self._c, count, _data(vectors), _data(points), _data(value), _data(gap),
                       ffi.from_buffer("int[]", outcome), err), err)
        for found in np.unique(outcome):
            _answered(int(found), *fine)
        return value, vectors if points is None else points

    def support(self, direction: Numbers) -> Answer:
        """sup of <w, x> over the set: infinite where there is no bound, -inf of an empty set. Shape (.., n) -> (..)."""
        return self._many(lib.capstan_support_many, direction, "direction", lib.CPS_SET_OUTCOME_EMPTY,
                          lib.CPS_SET_OUTCOME_UNBOUNDED, lib.CPS_SET_OUTCOME_NOT_ATTAINED, wanted=False)[0][()]

    def support_point(self, direction: Numbers) -> np.ndarray:
        """A point of the set that attains the support. Shape (.., n) -> (.., n)."""
        return self._many(lib.capstan_support_many, direction, "direction")[1]

    def project(self, point: Numbers, metric: Optional[Numbers] = None) -> np.ndarray:
        """The nearest point of the set, in the norm sqrt(d' M d). Shape (.., n) -> (.., n).

        metric: M (n, n), symmetric positive definite; None: the identity"""
        if metric is None:
            return self._many(lib.capstan_project_many, point, "point")[1]
        n = self.space
        made, points = _numbers.array(metric, (n, n), "metric"), _numbers.rows(point, n, "point")
        nearest, answer, err = np.empty(points.shape), ffi.new("CpsSetAnswer *"), ffi.new("CpsError *")
        for x, y in zip(points.reshape(-1, n), nearest.reshape(-1, n)):
            check(lib.cps_set_project(self._c, _data(x), _data(made), _data(y), answer, err), err)
            _answered(answer.outcome)
        return nearest

    def margin(self, point: Numbers) -> Answer:
        """Outside, minus the distance from the set; inside, the radius of a ball round the point in the set."""
        return self._many(lib.capstan_contains_many, point, "point", wanted=False)[0][()]

    def gauge(self, point: Numbers) -> Answer:
        """inf {t >= 0 : point in t set}; infinite where there is no such t. The set must contain 0."""
        return self._many(lib.capstan_gauge_many, point, "point", wanted=False)[0][()]

    # ---- questions about one vector ----

    def extent(self, direction: Numbers) -> Tuple[float, float]:
        """The least and the largest <w, x> over the set."""
        extent, err = ffi.new("CpsSetExtent *"), ffi.new("CpsError *")
        w = _numbers.array(direction, (self.space,), "direction")
        check(lib.cps_set_extent(self._c, _data(w), extent, err), err)
        _answered(extent.outcome, lib.CPS_SET_OUTCOME_UNBOUNDED, lib.CPS_SET_OUTCOME_NOT_ATTAINED)
        return extent.low, extent.high

    def _set_of(self, function: Callable[..., int], x: Numbers, what: str, tolerance: float) -> "Set":
        """A set that answers a question about a vector."""
        vector, out = _numbers.array(x, (self.space,), what), ffi.new("CpsSet **")
        answer, err = ffi.new("CpsSetAnswer *"), ffi.new("CpsError *")
        check(function(self._c, _data(vector), _numbers.number(tolerance, "tolerance"), out, answer, err), err)
        _answered(answer.outcome)
        return Set(out[0])

    def face(self, direction: Numbers, tolerance: float = 0.0) -> Union["Set", List[Any]]:
        """The face {x in set : <w, x> = h(w)}; for an array of directions a list of faces, nested as the array is.

        tolerance: [rad] by which the direction may be wrong; 0 stands for 1e-9"""
        w = _numbers.rows(direction, self.space, "direction")
        if w.ndim > 1:
            return [self.face(row, tolerance) for row in w]
        return self._set_of(lib.cps_set_face, w, "direction", tolerance)

    def normal_cone(self, point: Numbers, tolerance: float = 0.0) -> "Set":
        """{w : <w, x - point> <= 0 for every x of the set}.

        tolerance: [-] of the size of the set, up to which the point counts as touching; 0 stands for 1e-9"""
        return self._set_of(lib.cps_set_normal_cone, point, "point", tolerance)

    # ---- what the set is ----

    @property
    def space(self) -> int:
        """The dimension n of its space."""
        return lib.cps_set_space(self._c)

    def facts(self) -> Record:
        """Whether it is bounded, contains 0, and of which dimension it is (CpsSetFacts of set.h)."""
        facts, err = ffi.new("CpsSetFacts *"), ffi.new("CpsError *")
        check(lib.cps_set_facts(self._c, 0, facts, ffi.NULL, ffi.NULL, err), err)
        return Record(facts)

    def measure(self) -> Record:
        """Area and perimeter of a bounded set of the plane (CpsSetMeasure of set.h)."""
        measure, err = ffi.new("CpsSetMeasure *"), ffi.new("CpsError *")
        check(lib.cps_set_measure(self._c, measure, err), err)
        _answered(measure.outcome)
        return Record(measure)

    def _listed(self, function: Callable[..., int]) -> np.ndarray:
        answer, err, count = ffi.new("CpsSetAnswer *"), ffi.new("CpsError *"), ffi.new("int *")
        found = np.empty((16, self.space))
        for _ in range(2):
            check(function(self._c, 0, len(found), _data(found), count, answer, err), err)
            _answered(answer.outcome)
            if count[0] <= len(found):
                break
            found = np.empty((count[0], self.space))
        return found[:count[0]].copy()

    def vertices(self) -> np.ndarray:
        """(count, n) corners of a set of dimension 2 or less, of a hull of points or of a box."""
        return self._listed(lib.cps_set_vertices)

    def rays(self) -> np.ndarray:
        """(count, n) unit generators of a cone whose pointed part has dimension 2 or less, or that was made of rays."""
        return self._listed(lib.cps_set_rays)

    def to_tree(self) -> Dict[str, Any]:
        """The set in the words of scene and law files, for `Friction(set=..)` and the like."""
        if self._tree is None:
            raise ArgumentError(f"no words of a file for {self}")
        return self._tree

    def __str__(self) -> str:
        size = lib.cps_set_text(self._c, ffi.NULL, 0)
        made = ffi.new("char[]", size + 1)
        lib.cps_set_text(self._c, made, size + 1)
        return text(made)

    def __repr__(self) -> str:
        words = str(self)
        return f"<Set {words if len(words) < 120 else words[:117] + '...'}>"

    def __getstate__(self) -> Any:
        raise TypeError("a Set cannot be pickled: keep what it is made of")


# ---- operations ----

def _word(word: str, of: Set, **values: Any) -> Optional[Dict[str, Any]]:
    if of._tree is None:
        return None
    return {word: {**{key: np.asarray(value).tolist() for key, value in values.items()}, "of": of._tree}}


def _scaled(factor: float, of: Set) -> Set:
    return Set._make(lib.cps_set_scale, [factor, of._c], _word("scale", of, by=factor))


def _join(function: Callable[..., int], word: str, parts: Sequence[Any]) -> Set:
    for part in parts:
        if not isinstance(part, Set):
            raise ArgumentError(f"{word}: found {type(part).__name__}, expected a Set")
    trees = [part._tree for part in parts]
    pointers = ffi.new("CpsSet *[]", [part._c for part in parts])
    return Set._make(function, [len(parts), pointers], None if None in trees else {word: trees})


def product(*parts: Set) -> Set:
    """A x B x ..: the components of the parts one after the other."""
    return _join(lib.cps_set_product, "product", parts)


def intersection(*parts: Set) -> Set:
    """The points that all parts have in common."""
    return _join(lib.cps_set_intersection, "intersection", parts)


def minkowski_sum(*parts: Set) -> Set:
    """The closure of the sum of all parts."""
    return _join(lib.cps_set_sum, "sum", parts)


def hull(*parts: Set) -> Set:
    """The closed convex hull of the union."""
    return _join(lib.cps_set_hull, "hull", parts)


# ---- primitives, with the words of docs/formats.md ----

def _points(value: Numbers, what: str) -> np.ndarray:
    return _numbers.array(value, (None, None), what)


def point(x: Numbers) -> Set:
    """{x}."""
    made = _numbers.array(x, (None,), "point")
    return Set._make(lib.cps_set_point, [len(made), _data(made)], {"point": made.tolist()})


def ball(radius: float, dimension: int = 3) -> Set:
    """The ball round 0."""
    n, r = _numbers.count(dimension, "dimension", 1), _numbers.number(radius, "radius")
    return Set._make(lib.cps_set_ball, [n, ffi.NULL, r], {"ball": {"radius": r, "dimension": n}})


def disc(radius: float) -> Set:
    """The disc round 0 in the plane."""
    r = _numbers.number(radius, "radius")
    return Set._make(lib.cps_set_ball, [2, ffi.NULL, r], {"disc": r})


def ellipse(*axes: float) -> Set:
    """The ellipse or ellipsoid round 0 with these semi-axes along the components, > 0."""
    a = _numbers.array(axes, (None,), "axes")
    return Set._make(lib.cps_set_ellipsoid, [len(a), ffi.NULL, _data(np.diag(a * a))], {"ellipse": a.tolist()})


def ellipsoid(shape: Numbers) -> Set:
    """{x : x' S^-1 x <= 1}, S symmetric positive definite (n, n)."""
    s = _points(shape, "shape")
    return Set._make(lib.cps_set_ellipsoid, [len(s), ffi.NULL, _data(_square(s))], {"ellipsoid": s.tolist()})


def _square(matrix: np.ndarray) -> np.ndarray:
    if matrix.shape[0] != matrix.shape[1]:
        raise ArgumentError(f"shape: found {matrix.shape}, expected a square matrix")
    return matrix


def interval(low: float, high: Optional[float] = None) -> Set:
    """[low, high] in R, or [-b, b] of one number b; the ends may be infinite."""
    b = _numbers.number(low, "interval", infinite=True)
    ends = (-b, b) if high is None else (b, _numbers.number(high, "interval", infinite=True))
    return Set._make(lib.cps_set_interval, list(ends), {"interval": list(ends)})


def box(low: Numbers, high: Optional[Numbers] = None) -> Set:
    """{x : low <= x <= high} by component, or |x| <= b of one vector b; bounds may be infinite."""
    b = _numbers.array(low, (None,), "box", infinite=True)
    low_, high_ = (-b, b) if high is None else (b, _numbers.array(high, b.shape, "box", infinite=True))
    return Set._make(lib.cps_set_box, [len(b), _data(low_), _data(high_)], {"box": np.stack([low_, high_], 1).tolist()})


def half_space(normal: Numbers, offset: float) -> Set:
    """{x : <normal, x> <= offset}."""
    n, c = _numbers.array(normal, (None,), "normal"), _numbers.number(offset, "offset")
    return Set._make(lib.cps_set_half_space, [len(n), _data(n), c], {"half_space": {"normal": n.tolist(), "offset": c}})


def strip(normal: Numbers, width: float) -> Set:
    """{x : |<normal, x>| <= width / 2}."""
    n, w = _numbers.array(normal, (None,), "normal"), _numbers.number(width, "width")
    return Set._make(lib.cps_set_strip, [len(n), _data(n), -w / 2, w / 2], {"strip": {"normal": n.tolist(), "width": w}})


def polytope(points: Numbers) -> Set:
    """The convex hull of points (count, n)."""
    p = _points(points, "points")
    return Set._make(lib.cps_set_hull_of_points, [p.shape[1], len(p), _data(p)], {"polytope": p.tolist()})


def segment(start: Numbers, end: Numbers) -> Set:
    """The segment between two points."""
    a = _numbers.array(start, (None,), "segment")
    b = _numbers.array(end, a.shape, "segment")
    return Set._make(lib.cps_set_segment, [len(a), _data(a), _data(b)], {"segment": [a.tolist(), b.tolist()]})


def inequalities(rows: Numbers, offsets: Numbers) -> Set:
    """{x : <row_i, x> <= offset_i}, rows (count, n)."""
    r = _points(rows, "rows")
    c = _numbers.array(offsets, (len(r),), "offsets")
    return Set._make(lib.cps_set_inequalities, [r.shape[1], len(r), _data(r), _data(c)],
                     {"inequalities": {"rows": r.tolist(), "offsets": c.tolist()}})


def subspace(spanning: Numbers) -> Set:
    """The span of the rows (count, n)."""
    r = _points(spanning, "rows")
    return Set._make(lib.cps_set_subspace, [r.shape[1], len(r), _data(r)], {"subspace": r.tolist()})


def rays(directions: Numbers) -> Set:
    """The cone of all sums of the rows (count, n) with factors >= 0."""
    r = _points(directions, "rays")
    return Set._make(lib.cps_set_cone_of_rays, [r.shape[1], len(r), _data(r)], {"rays": r.tolist()})


def friction_cone(friction: float, dimension: int = 3) -> Set:
    """{(F, N) : |F| <= friction N}, N the last of n components."""
    f, n = _numbers.number(friction, "friction"), _numbers.count(dimension, "dimension", 2)
    return Set._make(lib.cps_set_friction_cone, [n, f], {"friction_cone": {"friction": f, "dimension": n}})
