# SPDX-License-Identifier: BSD-3-Clause
"""Stepping through a scene, with targets that are decided on the way."""
from __future__ import annotations

import os
import threading
import weakref
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _numbers
from ._errors import ArgumentError, check, fail, text
from ._native import ffi, lib
from ._record import Record, enum_value
from .move import Move
from .scene import Scene, SceneLike, names_of

_DOUBLE, _INT, _BYTE = np.dtype(np.float64), np.dtype(np.int32), np.dtype(np.uint8)

# Arrays of a line: type, shape and meaning. n nodes, e = n - 1 elements, c contacts of a node (1, or 2 where the scene has
# several obstacles), s springs of tables of stiffness. They are those of CpsLineView (include/capstan/step.h).
ARRAYS: Dict[str, Tuple[np.dtype, str, str]] = {
    "arc_length": (_DOUBLE, "n", "[m] natural arc length of the nodes from end A"),
    "element_length": (_DOUBLE, "e", "[m]"),
    "compliance_factor": (_DOUBLE, "e", "[-] of the mean compliance"),
    "weight_length": (_DOUBLE, "n", "[m] weight at a node over the mean one; 0 where the line is uniform"),
    "spring_element": (_INT, "s", "element of a spring of a table of stiffness"),
    "spring_strain": (_DOUBLE, "s", "[-] from which it acts"),
    "spring_stiffness": (_DOUBLE, "s", "[N]"),
    "breaking_load": (_DOUBLE, "e", "[N] infinite of elements without one; all 0 where no element has one"),
    "reference": (_DOUBLE, "n3", "[m] where the step, or its last substep, began"),
    "position": (_DOUBLE, "n3", "[m] of the nodes, from `origin`"),
    "load": (_DOUBLE, "n3", "[N] weight, given loads, drag, and the force on a free end"),
    "node_load": (_DOUBLE, "n3", "[N] of that, given loads and drag; 0 where there are none"),
    "node_stiffness": (_DOUBLE, "n3", "[N/m] of the springs of the nodes; 0 without"),
    "node_coupling": (_DOUBLE, "n3", "[N/m] the same, of x and y, x and z, y and z"),
    "node_place": (_DOUBLE, "n3", "[m] where they are without force"),
    "node_beside": (_DOUBLE, "n3", "[m] beside the position at which they are taken, small"),
    "obstacle": (_INT, "cn", "index of the obstacle of a contact, -1: none"),
    "normal": (_DOUBLE, "cn3", "[-] of the obstacle"),
    "gap": (_DOUBLE, "cn", "[m] from the reference to the obstacle; infinite where no contact was considered"),
    "friction_bound": (_DOUBLE, "cn", "[N] largest friction force"),
    "friction_factor": (_DOUBLE, "n", "[-] of the friction zones"),
    "friction_force": (_DOUBLE, "cn3", "[N] on the line"),
    "reaction": (_DOUBLE, "cn", "[N] along the normal, >= 0"),
    "slip": (_DOUBLE, "cn3", "[m] on the obstacle in this step"),
    "segment_force": (_DOUBLE, "e3", "[N] of the B side on the A side"),
    "tension": (_DOUBLE, "e", "[N] >= 0"),
    "motion": (_DOUBLE, "n3", "[-] velocities that prove an endless slide, else 0"),
    "state": (_BYTE, "cn", "0 free, 1 stick, 2 slip, 3 unresolved"),
    "element_obstacle": (_INT, "e", "index of the obstacle of an element's own contact, -1: none"),
    "element_share": (_DOUBLE, "e", "[-] where on the element that is"),
    "element_normal": (_DOUBLE, "e3", "[-]"),
    "element_gap": (_DOUBLE, "e", "[m]"),
    "element_friction_bound": (_DOUBLE, "e", "[N]"),
    "element_friction_force": (_DOUBLE, "e3", "[N]"),
    "element_reaction": (_DOUBLE, "e", "[N]"),
    "element_slip": (_DOUBLE, "e3", "[m]"),
    "element_state": (_BYTE, "e", "as `state`"),
}


# ---- signals ----

_raised: Dict[int, BaseException] = {}


def _note(kind: Any, exception: Any, traceback: Any) -> int:
    """A handler of a signal has raised an exception while a step asked for it: the step is given up."""
    if traceback is not None:
        _raised[int(ffi.cast("intptr_t", traceback.tb_frame.f_locals["watch"]))] = exception
    return 1


@ffi.def_extern(name="capstan_python_asked", error=1, onerror=_note)
def _asked(watch: Any) -> int:
    # handlers of signals run between two instructions of a loop
    for _ in (0, 1):
        pass
    return 0


# ---- forks: a step that another thread was taking does not go on in a child ----

_all: "weakref.WeakSet[Evolution]" = weakref.WeakSet()


def _after_fork() -> None:
    for evolution in list(_all):
        if evolution._lock.locked():
            evolution._handle = None
        evolution._lock = threading.Lock()


os.register_at_fork(after_in_child=_after_fork)


class LineState:
    """A line of an evolution, as the last completed step has left it.

    Every array (``position``, ``tension``, ..: `capstan.ARRAYS` lists them with shape and unit) is a view of the
    library's own memory: nothing is copied, and it cannot be written to. It keeps that memory alive, also after the
    evolution is closed. A view follows the evolution: after the next step it shows that step. While another thread
    takes a step its contents are not defined; copy what is to stay (``line.position.copy()``)."""

    def __init__(self, evolution: "Evolution", index: int, name: str) -> None:
        self._evolution, self._index, self.name = evolution, index, name

    @property
    def report(self) -> Record:
        """The report on the line (CpsLineReport of step.h): outcome, certificate, lengths, ledger."""
        return self._evolution._ask(lambda handle: Record(lib.cps_evolution_line_report(handle, self._index)))

    @property
    def A(self) -> Record:
        """End A: position, force, tension, uplift, .. (CpsEndReport of step.h)."""
        return self.report.end[0]

    @property
    def B(self) -> Record:
        """End B, as A."""
        return self.report.end[1]

    @property
    def origin(self) -> np.ndarray:
        """[m] (3) the point from which `position` and `reference` are measured: 0 unless the lines are far away."""
        return self._evolution._ask(
            lambda handle: np.array(list(lib.cps_evolution_line_view(handle, self._index).origin)))

    @property
    def failure(self) -> Record:
        """Whether the line has parted, or an end was let go (CpsLineFailure of failure.h)."""
        return self._evolution._ask(lambda handle: Record(lib.cps_evolution_line_failure(handle, self._index)))

    @property
    def in_time(self) -> Record:
        """Velocity and energy of a line in time (CpsLineMotion of motion.h); its arrays are copies, None where there are none."""
        def asked(handle: Any) -> Record:
            found, n = lib.cps_evolution_line_motion(handle, self._index), lib.cps_evolution_line_view(handle, self._index).element_count + 1
            return Record(found, arrays={"mass": (n,), "velocity": (n, 3), "before": (n, 3), "rest_velocity": (n, 3), "span": (n,)})
        return self._evolution._ask(asked)

    def winch(self, end: str = "B") -> Record:
        """The winch at an end (CpsWinchReport of winch.h): length stored, pull; `is_there` says whether there is one."""
        if end not in ("A", "B"):
            raise ArgumentError(f"end: found {end!r}, expected 'A' or 'B'")

        def asked(handle: Any) -> Record:
            e = lib.cps_evolution_line_view(handle, self._index).element_count
            return Record(lib.cps_evolution_winch_report(handle, self._index, "AB".index(end)), arrays={"length": (e,)})
        return self._evolution._ask(asked)

    def constraint(self, end: str = "B") -> Record:
        """The set that an end is in (CpsConstraintReport of constraint.h): its reaction; `is_there` says whether there is one."""
        if end not in ("A", "B"):
            raise ArgumentError(f"end: found {end!r}, expected 'A' or 'B'")
        return self._evolution._ask(lambda handle: Record(lib.cps_evolution_constraint_report(handle, self._index, "AB".index(end))))

    @property
    def two_stiffnesses(self) -> Record:
        """Static and dynamic stiffness of the line (CpsTwoStiffnesses of two_stiffnesses.h)."""
        def asked(handle: Any) -> Record:
            e = lib.cps_evolution_line_view(handle, self._index).element_count
            return Record(lib.cps_evolution_two_stiffnesses(handle, self._index), arrays={"element_length": (e,), "rest_strain": (e,)})
        return self._evolution._ask(asked)

    def stiffness(self, end: str = "B", kind: str = "step", smooth: bool = False) -> np.ndarray:
        """[N/m] (3, 3) the derivative of the force at an end by the place of that end, or of the point at which it is, while the
        free points to which lines lead from there follow (stiffness.h).

        kind:   "step", what slides goes on to slide; "stick", of a small cycle
        smooth: with touchdown points that move along the elements

        Raises NoAnswer, with the reason, where there is no such matrix."""
        return self._evolution._stiffness(self._index, end, kind, smooth)

    def __getattr__(self, name: str) -> np.ndarray:
        if name not in ARRAYS:
            raise AttributeError(f"a line has no {name!r}")
        return self._evolution._array(self._index, name)

    def __dir__(self) -> List[str]:
        return sorted(set(super().__dir__()) | set(ARRAYS))

    def __repr__(self) -> str:
        return f"<line {self.name!r}: {self.report.outcome}, {len(self.tension)} elements>"


class Evolution:
    """A scene carried through its history, one certified load step at a time, and through moves decided on the way.

    >>> evolution = Evolution({"lines": {"rope": {"length": 2, "mass": 1, "stiffness": 1e4, "elements": 4,
    ...     "start": "static", "ends": {"A": {"held": [0, 0, 0]}, "B": {"held": [1, 0, 0]}}}}})
    >>> evolution.step().outcome
    'solved'
    >>> evolution.move({"rope.B": {"position": [1.5, 0, 0]}}).outcome
    'solved'
    >>> evolution["rope"].position.shape
    (5, 3)

    Steps release the interpreter's lock, so several evolutions run side by side in threads; one evolution takes the
    calls of several threads one after the other. Ctrl-C interrupts a step, which then has not happened.

    scene:          whatever `Scene.of` takes
    threads:        threads that share the lines of a step (with several lines); None: as the scene says
    path_tolerance: as the key of the scene; None: as the scene says
    moving:         names of obstacles that moves will shift, beside those that the history moves
    in_time:        moves may have a duration; None: where entries of the history have one
    """

    def __init__(self, scene: SceneLike, *, threads: Optional[int] = None, path_tolerance: Optional[float] = None,
                 moving: Sequence[str] = (), in_time: Optional[bool] = None) -> None:
        self._lock = threading.Lock()
        self._handle: Any = None
        self.scene = Scene.of(scene).copy()
        self._settings: Dict[str, Any] = {"threads": threads, "path_tolerance": path_tolerance, "moving": tuple(moving), "in_time": in_time}
        self._file = self.scene._file()
        self._c_scene = ffi.new("CpsScene *", lib.cps_scene_file_scene(self._file)[0])
        if threads is not None:
            self._c_scene.solver.thread_count = _numbers.count(threads, "threads", 1)
        if path_tolerance is not None:
            self._c_scene.solver.path_tolerance = _numbers.number(path_tolerance, "path_tolerance")
        if in_time is not None:
            if not isinstance(in_time, (bool, np.bool_)):
                raise ArgumentError(f"in_time: found {in_time!r}, expected True or False")
            self._c_scene.in_time = bool(in_time)
        self._names = names_of(self._c_scene)
        if moving:
            c = self._c_scene
            self._obstacles = ffi.new("CpsObstacle[]", [c.obstacle[i] for i in range(c.obstacle_count)])
            for name in moving:
                self._obstacles[self._index("obstacles", name)].moves = True
            c.obstacle = self._obstacles
        self._err = ffi.new("CpsError *")
        self._watch = ffi.new("CapstanWatch *")
        out = ffi.new("CpsEvolution **")
        check(lib.cps_evolution_create(self._c_scene, out, self._err), self._err)
        self._handle = ffi.gc(out[0], lib.cps_evolution_destroy)
        check(lib.capstan_watch_evolution(self._watch, self._handle, self._err), self._err)
        self.lines: Dict[str, LineState] = {name: LineState(self, i, name) for i, name in enumerate(self._names["lines"])}
        _all.add(self)

    # ---- steps ----

    @property
    def step_count(self) -> int:
        """Load steps in all: of the history, a static start, and the moves taken."""
        return self._ask(lib.cps_evolution_step_count)

    @property
    def remaining(self) -> int:
        """Load steps of the history that are still to do; 0 after one that has no equilibrium."""
        return self._ask(lib.cps_evolution_remaining_count)

    def step(self) -> Record:
        """Take the next step of the history, and return the report on it (CpsStepReport of step.h)."""
        return self._take(lib.cps_evolution_step)

    def move(self, target: Union[Move, Mapping[str, Any]]) -> Record:
        """Take a step to a target that the history does not hold: `target(..)`, or what that is made of."""
        made = target if isinstance(target, Move) else Move(self, target)
        if made._owner() is not self:
            raise ArgumentError("the target was made for another evolution")
        return self._take(lib.cps_evolution_move, made._stage)

    def target(self, changes: Mapping[str, Any]) -> Move:
        """A target of moves that can be used again, with other values: see `Move`."""
        return Move(self, changes)

    def take_back(self) -> None:
        """Take the last move back: everything is, bit for bit, as it was before it."""
        self._call(lib.cps_evolution_take_back)

    def __iter__(self) -> Iterator[Record]:
        """The steps of the history that remain, taken one after the other."""
        while self.remaining > 0:
            yield self.step()

    # ---- states ----

    def save(self) -> bytes:
        """The state between two steps. It can be loaded in another process of the same build of capstan."""
        def saved(handle: Any) -> bytes:
            state = bytearray(lib.cps_evolution_state_size(handle))
            lib.cps_evolution_save(handle, ffi.from_buffer(state, require_writable=True))
            return bytes(state)
        return self._ask(saved)

    def load(self, state: bytes) -> None:
        """Go back, or on, to a state saved from an evolution of the same scene; what follows has the same bits."""
        if not isinstance(state, (bytes, bytearray, memoryview)):
            raise ArgumentError(f"state: found {type(state).__name__}, expected what save() has returned")
        data = bytes(state)
        self._call(lib.cps_evolution_load, ffi.from_buffer(data), len(data))

    # ---- what the last step has found ----

    @property
    def report(self) -> Record:
        """The report on the last step (CpsStepReport of step.h); `certificate` is its certificate."""
        return self._ask(lambda handle: Record(lib.cps_evolution_report(handle)))

    @property
    def in_time(self) -> Record:
        """How all lines, points and bodies moved in the last step: sums (CpsStepMotion of motion.h)."""
        return self._ask(lambda handle: Record(lib.cps_evolution_motion(handle)))

    @property
    def certified(self) -> bool:
        """Whether the last step has a certified answer."""
        return self._ask(lambda handle: lib.cps_evolution_report(handle).step_count > 0 and
                         bool(lib.cps_outcome_is_certified(lib.cps_evolution_report(handle).outcome)))

    def __getitem__(self, name: str) -> LineState:
        """A line by its name."""
        if name not in self.lines:
            raise KeyError(f"no line {name!r}: there are {', '.join(self.lines)}")
        return self.lines[name]

    @property
    def points(self) -> Dict[str, Record]:
        """Reports on the points by name (CpsPointReport of point.h)."""
        return self._reports("points", lib.cps_evolution_point_report)

    @property
    def point_constraints(self) -> Dict[str, Record]:
        """The sets that points are in, by name (CpsConstraintReport of constraint.h); `is_there` says whether there is one."""
        return self._reports("points", lib.cps_evolution_point_constraint_report)

    @property
    def bodies(self) -> Dict[str, Record]:
        """Reports on the bodies by name (CpsBodyReport of body.h)."""
        return self._reports("bodies", lib.cps_evolution_body_report)

    @property
    def obstacles(self) -> Dict[str, Record]:
        """Reports on the obstacles by name: where they are now (CpsObstacleReport of shift.h)."""
        return self._reports("obstacles", lib.cps_evolution_obstacle_report)

    @property
    def points_in_time(self) -> Dict[str, Record]:
        """How the points moved in the last step, by name (CpsPointMotion of motion.h)."""
        return self._reports("points", lib.cps_evolution_point_motion)

    @property
    def bodies_in_time(self) -> Dict[str, Record]:
        """How the bodies moved in the last step, by name (CpsBodyMotion of motion.h)."""
        return self._reports("bodies", lib.cps_evolution_body_motion)

    @property
    def time(self) -> float:
        """[s] the time that steps with a duration have taken since the start."""
        return self._ask(lib.cps_evolution_time)

    @property
    def pace(self) -> Record:
        """How long the last step was, its error, and how many tries were taken back (CpsPace of motion.h)."""
        return self._ask(lambda handle: Record(lib.cps_evolution_pace(handle)))

    @property
    def parting(self) -> Record:
        """The break that the last step was (CpsBreak of failure.h); `is_break` says whether it was one."""
        return self._ask(lambda handle: Record(lib.cps_evolution_break(handle)))

    @property
    def parts_next(self) -> bool:
        """Whether the next step is a break: a line is above its break_at."""
        return self._ask(lib.cps_evolution_breaks)

    def point_stiffness(self, point: str, kind: str = "step", smooth: bool = False) -> np.ndarray:
        """[N/m] (3, 3) of a point against all lines that end there: the derivative of force by position, other free points following."""
        index = self._index("points", point)
        out = ffi.new("CpsStiffness *")
        kind_ = self._stiffness_kind(kind)
        self._call(lib.cps_evolution_point_stiffness, index, kind_, out)
        return _stiffness_matrix(out, 3, smooth)

    def body_stiffness(self, body: str, kind: str = "step", smooth: bool = False) -> np.ndarray:
        """[N/m, N, N m] (6, 6) of a body in its pose: the derivative of force and moment by position and rotation, free points following."""
        index = self._index("bodies", body)
        out = ffi.new("CpsBodyStiffness *")
        kind_ = self._stiffness_kind(kind)
        self._call(lib.cps_evolution_body_stiffness, index, kind_, out)
        return _stiffness_matrix(out, 6, smooth)

    # ---- the end ----

    def fresh(self) -> "Evolution":
        """Another evolution of the same scene and settings, at its start."""
        return Evolution(self.scene, **self._settings)

    def close(self) -> None:
        """Let go of the library's memory, which is freed as soon as no view of it is left. Later calls are refused."""
        with self._lock:
            self._handle = None

    def __enter__(self) -> "Evolution":
        return self

    def __exit__(self, *exception: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        if self._handle is None:
            return "<Evolution, closed>"
        return f"<Evolution: {self.report.step_count} steps taken, {self.remaining} of the history remain>"

    def __getstate__(self) -> Any:
        raise TypeError("an Evolution cannot be pickled: pickle its scene, and the bytes of save()")

    # ---- inside ----

    def _open(self) -> Any:
        if self._handle is None:
            raise ArgumentError("the evolution is closed")
        return self._handle

    def _ask(self, question: Callable[[Any], Any]) -> Any:
        with self._lock:
            return question(self._open())

    def _call(self, function: Callable[..., int], *arguments: Any) -> None:
        with self._lock:
            check(function(self._open(), *arguments, self._err), self._err)

    def _take(self, function: Callable[..., int], *arguments: Any) -> Record:
        """Take a step by a call of the library, and report on it."""
        with self._lock:
            handle, watch = self._open(), self._watch
            lib.capstan_watch_begin(watch)
            status = function(handle, *arguments, self._err)
            if watch.stopped:
                raise _raised.pop(int(ffi.cast("intptr_t", watch)), None) or KeyboardInterrupt()
            if status:
                fail(status, self._err)
            return Record(lib.cps_evolution_report(handle))

    def _index(self, kind: str, name: Any) -> int:
        try:
            return self._names[kind].index(name)
        except ValueError:
            there = ", ".join(self._names[kind]) or "none"
            one = "body" if kind == "bodies" else kind[:-1]
            raise ArgumentError(f"no {one} of the name {name!r}: there are {there}") from None

    def _reports(self, kind: str, function: Callable[[Any, int], Any]) -> Dict[str, Record]:
        return self._ask(lambda handle: {name: Record(function(handle, i)) for i, name in enumerate(self._names[kind])})

    def _array(self, line: int, name: str) -> np.ndarray:
        dtype, dims, _ = ARRAYS[name]
        with self._lock:
            handle = self._open()
            view = lib.cps_evolution_line_view(handle, line)
            sizes = {"n": view.element_count + 1, "e": view.element_count, "c": view.contact_count, "s": view.spring_count,
                     "3": 3}
            shape = tuple(sizes[dim] for dim in dims)
            pointer = getattr(view, name)
            if pointer == ffi.NULL:
                return np.zeros([0] * len(shape), dtype)
            return _view(pointer, shape, dtype, handle)

    def _stiffness_kind(self, kind: str) -> int:
        try:
            return enum_value("CpsStiffnessKind", kind)
        except ValueError as error:
            raise ArgumentError(f"kind: {error}") from None

    def _stiffness(self, line: int, end: str, kind: str, smooth: bool) -> np.ndarray:
        if end not in ("A", "B"):
            raise ArgumentError(f"end: found {end!r}, expected 'A' or 'B'")
        out = ffi.new("CpsStiffness *")
        self._call(lib.cps_evolution_stiffness, line, "AB".index(end), self._stiffness_kind(kind), out)
        return _stiffness_matrix(out, 3, smooth)


def _stiffness_matrix(found: Any, n: int, smooth: bool) -> np.ndarray:
    from ._errors import NoAnswer

    if found.outcome != lib.CPS_STIFFNESS_OUTCOME_FOUND:
        raise NoAnswer(text(lib.cps_stiffness_outcome_text(found.outcome)),
                       text(lib.cps_stiffness_outcome_name(found.outcome)))
    if smooth and not found.has_smooth:
        raise NoAnswer("there is no smooth stiffness here", "not_given")
    return np.array(list(found.smooth if smooth else found.matrix)).reshape(n, n)


def _view(pointer: Any, shape: Any, dtype: np.dtype, owner: Any) -> np.ndarray:
    """A view of memory of the library that cannot be written to and keeps `owner` alive."""
    size = int(np.prod(shape)) * dtype.itemsize
    held = ffi.gc(ffi.cast("char *", pointer), lambda _, owner=owner: None)
    return np.frombuffer(memoryview(ffi.buffer(held, size)).toreadonly(), dtype).reshape(shape)
