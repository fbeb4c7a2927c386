# SPDX-License-Identifier: BSD-3-Clause
"""Targets of moves: what changes in a step that is decided on the way (CpsStage of scene.h)."""
from __future__ import annotations

import math
import weakref
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Tuple

import numpy as np

from . import _numbers
from ._errors import ArgumentError
from ._native import ffi, lib

if TYPE_CHECKING:
    from .evolution import Evolution

_SWAY = ("sine", "cosine", "period", "oscillations")


def _quaternion(key: str, value: Any) -> np.ndarray:
    """A rotation as of a scene file: a quaternion, or yaw about z, then pitch about the y so turned, then roll [degrees]."""
    if isinstance(value, Mapping) and set(value) == {"quaternion"}:
        return _numbers.array(value["quaternion"], (4,), f"'{key}' quaternion")
    if not isinstance(value, Mapping) or set(value) != {"roll_pitch_yaw"}:
        raise ArgumentError(f"'{key}': expected rotation as a dictionary with 'quaternion' or 'roll_pitch_yaw'")
    roll, pitch, yaw = np.radians(_numbers.array(value["roll_pitch_yaw"], (3,), f"'{key}' roll_pitch_yaw")) / 2
    (a, x), (b, y), (c, z) = ((math.cos(half), math.sin(half)) for half in (roll, pitch, yaw))
    return np.array([a * b * c + x * y * z, x * b * c - a * y * z, a * y * c + x * b * z, a * b * z - x * y * c])


class Move:
    """A target of moves, made by `Evolution.target` of a dictionary with the keys of an entry of a scene's history:

        "LINE.A", "LINE.B"   {"position": [x, y, z]}, {"move": [x, y, z]} from where it is, {"force": [x, y, z]}, or
                             {"release": True}; in time beside it "sine" or "cosine" with "period", or a list of such
                             dictionaries as "oscillations"; in time beside a position "velocity", that at the end of the move
        "LINE.node"          with "at", the natural length from end A: {"position": ..}, {"hold": True}, {"force": ..} or
                             {"release": True}; further nodes as "LINE.node2" to "LINE.node4"
        "POINT.point"        as an end, but it is not let go
        "BODY.body"          {"position": .., "rotation": {"quaternion": [w, x, y, z]}}, "move" in place of "position",
                             "roll_pitch_yaw" [degrees] in place of "quaternion"; or {"force": .., "moment": .., "arm": ..}; in
                             time beside it "oscillations", each with "sine", "cosine", "rotation_sine", "rotation_cosine" [degrees],
                             "moment_sine" or "moment_cosine", and "period"; beside a pose "velocity" and "turn_rate" [rad/s]
        "LINE.pay_out_A", "LINE.pay_out_B"   length that the winch there pays out, negative: it hauls in
        "OBSTACLE.turn"      degrees
        "OBSTACLE.obstacle"  {"move": [x, y, z]}, {"turn": degrees, "axis": .., "about": ..} or both, of one that the history
                             moves or that is named in `moving` of the evolution
        "gravity"            [x, y, z]
        "stiffness"          "static" or "dynamic", of lines with a dynamic stiffness
        "duration"           seconds that the move takes: in time, with inertia; needs an evolution `in_time`
        "name"               name of the step

    The values of vectors can be changed between moves, without a new target:

        target = evolution.target({"rope.B": {"position": [1, 0, 0]}})
        target["rope.B"][:] = 1.1, 0, 0.2
        evolution.move(target)

    `move` is resolved when the target is made. Write to a target between moves, not while another thread takes one.
    """

    def __init__(self, evolution: "Evolution", changes: Mapping[str, Any]) -> None:
        if not isinstance(changes, Mapping):
            raise ArgumentError(f"target: found {type(changes).__name__}, expected a dictionary")
        self._owner = weakref.ref(evolution)
        self._evolution_names = evolution._names
        self._keep: List[Any] = []
        self._values: Dict[str, np.ndarray] = {}
        self._stage = ffi.new("CpsStage *", lib.cps_stage_default())
        self._rows: Dict[str, List[Tuple[str, Any]]] = {}
        for key, value in changes.items():
            self._sort(evolution, key, value)
        for rows, kind, fill in ((("change"), "CpsChange", self._end), (("turn"), "CpsTurn", self._turn),
                                 (("shift"), "CpsShift", self._shift), (("point_change"), "CpsPointChange", self._point),
                                 (("body_change"), "CpsBodyChange", self._body),
                                 (("grasp_change"), "CpsGraspChange", self._grasp),
                                 (("pay_out"), "CpsPayOut", self._pay_out), (("sway"), "CpsSway", self._sway)):
            self._fill(evolution, rows, kind, fill)

    def __getitem__(self, key: str) -> np.ndarray:
        """The vector of a change, to which values can be written: position or force; of a body, both its vectors."""
        return self._values[key]

    def __repr__(self) -> str:
        return f"<Move of {', '.join(self._values) or 'nothing'}>"

    # ---- which change belongs to what ----

    def _sort(self, evolution: "Evolution", key: Any, value: Any) -> None:
        if key == "name":
            if not isinstance(value, str) or "\0" in value:
                raise ArgumentError(f"name: found {value!r}, expected a text")
            self._stage.name = self._held(ffi.new("char[]", value.encode()))
            return
        if key == "stiffness":
            if value not in ("static", "dynamic"):
                raise ArgumentError(f"stiffness: found {value!r}, expected 'static' or 'dynamic'")
            self._stage.static_stiffness = value == "static"
            return
        if key == "duration":
            self._stage.duration = _numbers.number(value, "'duration'")
            if not self._stage.duration > 0:
                raise ArgumentError(f"'duration': found {value!r}, expected seconds > 0")
            return
        if key == "gravity":
            self._stage.gravity_changes = True
            self._vector(key, self._stage.gravity, value)
            return
        name, dot, what = str(key).rpartition(".")
        kinds = {"A": "change", "B": "change", "point": "point_change", "body": "body_change", "turn": "turn",
                 "obstacle": "shift", "node": "grasp_change", "node2": "grasp_change", "node3": "grasp_change",
                 "node4": "grasp_change", "pay_out_A": "pay_out", "pay_out_B": "pay_out"}
        if not isinstance(key, str) or not dot or what not in kinds:
            raise ArgumentError(f"target: found the key {key!r}, expected 'gravity', 'duration', 'stiffness', 'name', or a name with "
                                ".A, .B, .node, .pay_out_A, .pay_out_B, .point, .body, .turn or .obstacle")
        self._rows.setdefault(kinds[what], []).append((key, value))
        if what in ("A", "B", "point", "body") and isinstance(value, Mapping):
            self._rows.setdefault("sway", []).extend((key, sway) for sway in self._sways(key, value))

    def _fill(self, evolution: "Evolution", rows: str, kind: str, fill: Any) -> None:
        wanted = self._rows.get(rows, [])
        if not wanted:
            return
        array = self._held(ffi.new(f"{kind}[]", len(wanted)))
        for row, (key, value) in zip(array, wanted):
            fill(evolution, key, value, row)
        setattr(self._stage, rows, array)
        setattr(self._stage, rows + "_count", len(wanted))

    # ---- values ----

    def _held(self, made: Any) -> Any:
        self._keep.append(made)
        return made

    def _vector(self, key: str, field: Any, value: Any) -> None:
        """Write a vector to a field of the stage, and remember the field as an array."""
        view = np.frombuffer(ffi.buffer(field), np.float64)
        view[:] = _numbers.array(value, (len(view),), f"'{key}'")
        self._values[key] = view

    @staticmethod
    def _only(key: str, value: Any, allowed: Tuple[str, ...], beside: Tuple[str, ...] = ()) -> str:
        """The one word among those allowed that a change has."""
        if not isinstance(value, Mapping):
            raise ArgumentError(f"'{key}': found {value!r:.60}, expected a dictionary with {', '.join(allowed)}")
        bad = [word for word in value if word not in allowed + beside]
        found = [word for word in value if word in allowed]
        if bad or len(found) != 1:
            raise ArgumentError(f"'{key}': found {', '.join(map(str, value)) or 'nothing'}, "
                                f"expected exactly one of {', '.join(allowed)}")
        return found[0]

    @staticmethod
    def _true(key: str, word: str, value: Any) -> None:
        if value is not True:
            raise ArgumentError(f"'{key}': found {word} {value!r}, expected True")

    def _place(self, key: str, word: str, value: Any, now: Any) -> Any:
        """A vector, after `move` has been resolved from where the thing is now."""
        vector = _numbers.array(value, (3,), f"'{key}'")
        return vector + now if word == "move" else vector

    def _velocity(self, key: str, value: Mapping[str, Any], row: Any) -> None:
        """The velocity at the end of the move of what it leads to a place."""
        if "velocity" in value:
            row.has_velocity = True
            self._vector(key + ".velocity", row.velocity, value["velocity"])

    def _end(self, evolution: "Evolution", key: str, value: Any, row: Any) -> None:
        name, _, end = key.rpartition(".")
        word = self._only(key, value, ("position", "move", "force", "release"), _SWAY + ("velocity",))
        row.line, row.end = evolution._index("lines", name), "AB".index(end)
        self._velocity(key, value, row)
        if word == "release":
            self._true(key, word, value[word])
            row.to.kind = lib.CPS_END_KIND_RELEASED
            return
        row.to.kind = lib.CPS_END_KIND_FREE if word == "force" else lib.CPS_END_KIND_HELD
        now = evolution[name].report.end[row.end].position if word == "move" else None
        self._vector(key, row.to.value, self._place(key, word, value[word], now))

    def _point(self, evolution: "Evolution", key: str, value: Any, row: Any) -> None:
        name = key.rpartition(".")[0]
        word = self._only(key, value, ("position", "move", "force"), _SWAY + ("velocity",))
        self._velocity(key, value, row)
        row.point = evolution._index("points", name)
        row.kind = lib.CPS_POINT_KIND_FREE if word == "force" else lib.CPS_POINT_KIND_HELD
        now = evolution.points[name].position if word == "move" else None
        self._vector(key, row.value, self._place(key, word, value[word], now))

    def _grasp(self, evolution: "Evolution", key: str, value: Any, row: Any) -> None:
        name = key.rpartition(".")[0]
        word = self._only(key, value, ("position", "hold", "force", "release"), ("at",))
        row.line = evolution._index("lines", name)
        if "at" not in value:
            raise ArgumentError(f"'{key}': 'at' is missing, the natural length from end A to the node")
        at, places = _numbers.number(value["at"], f"'{key}' at"), evolution[name].arc_length
        if not 0 <= at <= places[-1]:
            raise ArgumentError(f"'{key}': found at {at}, expected 0 to {places[-1]}")
        row.node = int(np.argmin(np.abs(places - at)))
        row.kind = lib.CPS_END_KIND_FREE if word in ("force", "release") else lib.CPS_END_KIND_HELD
        row.stays, row.at_once = word == "hold", word == "release"
        if word in ("hold", "release"):
            self._true(key, word, value[word])
        else:
            self._vector(key, row.value, value[word])

    @staticmethod
    def _sways(key: str, value: Mapping[str, Any]) -> List[Tuple[str, Mapping[str, Any], bool]]:
        """The oscillations beside a change: that of its own words, and those of its list, by the keys of their vectors; and whether
        a body is held meanwhile."""
        held = not set(value) & {"force", "moment"}
        single = {word: value[word] for word in ("sine", "cosine", "period") if word in value}
        several = value.get("oscillations", [])
        if "release" in value and (single or several):
            raise ArgumentError(f"'{key}': found an oscillation beside 'release': what is let go does not oscillate")
        if not isinstance(several, (list, tuple)) or not all(isinstance(sway, Mapping) for sway in several):
            raise ArgumentError(f"'{key}' oscillations: found {several!r:.60}, expected a list of dictionaries")
        return [(key, single, held)] * bool(single) + [(f"{key}.oscillations[{i}]", sway, held) for i, sway in enumerate(several)]

    def _sway(self, evolution: "Evolution", key: str, value: Any, row: Any) -> None:
        path, sway, held = value
        name, _, what = key.rpartition(".")
        body = what == "body"
        sizes = ("sine", "cosine", "rotation_sine", "rotation_cosine", "moment_sine", "moment_cosine")[:6 if body else 2]
        if "period" not in sway or not any(word in sway for word in sizes) or not set(sway) <= {"period", *sizes}:
            raise ArgumentError(f"'{path}': expected 'period' with one or more of {', '.join(sizes)}")
        row.of = {"point": lib.CPS_SWAY_OF_POINT, "body": lib.CPS_SWAY_OF_BODY}.get(what, lib.CPS_SWAY_OF_END)
        row.owner = evolution._index({"point": "points", "body": "bodies"}.get(what, "lines"), name)
        row.end = "AB".index(what) if what in "AB" else 0
        row.period = _numbers.number(sway["period"], f"'{path}' period")
        for word, field in (("sine", row.sine), ("cosine", row.cosine)):
            first = _numbers.array(sway.get(word, [0, 0, 0]), (3,), f"'{path}' {word}")
            right, wrong = (f"rotation_{word}", f"moment_{word}") if held else (f"moment_{word}", f"rotation_{word}")
            if wrong in sway:
                raise ArgumentError(f"'{path}': found '{wrong}' of a body that is {'held' if held else 'loaded'} in this move")
            last = _numbers.array(sway.get(right, [0, 0, 0]), (3,), f"'{path}' {right}")
            both = np.concatenate([first, np.radians(last) if held else last])
            np.frombuffer(ffi.buffer(field), np.float64)[:] = both
            self._values[f"{path}.{word}"] = np.frombuffer(ffi.buffer(field), np.float64)[:6 if body else 3]

    def _body(self, evolution: "Evolution", key: str, value: Any, row: Any) -> None:
        name = key.rpartition(".")[0]
        held, free = {"position", "move", "rotation"}, {"force", "moment", "arm"}
        if isinstance(value, Mapping):
            moving = {word: vector for word, vector in value.items() if word in ("velocity", "turn_rate")}
            if moving:
                row.has_velocity = True
                both = [_numbers.array(moving.get(word, [0, 0, 0]), (3,), f"'{key}' {word}") for word in ("velocity", "turn_rate")]
                self._vector(key + ".velocity", row.velocity, np.concatenate(both))
            value = {word: vector for word, vector in value.items() if word != "oscillations" and word not in moving}
        known = isinstance(value, Mapping) and value and (set(value) <= held or set(value) <= free)
        if not known or {"position", "move"} <= set(value) or ("arm" in value and "force" not in value):
            raise ArgumentError(f"'{key}': expected a dictionary with position or move and rotation, or with force, moment and arm")
        row.body = evolution._index("bodies", name)
        if set(value) <= free:
            row.kind = lib.CPS_BODY_KIND_FREE
            force = _numbers.array(value.get("force", [0, 0, 0]), (3,), f"'{key}' force")
            arm = _numbers.array(value.get("arm", [0, 0, 0]), (3,), f"'{key}' arm")
            moment = _numbers.array(value.get("moment", [0, 0, 0]), (3,), f"'{key}' moment")
            self._vector(key + ".moment", row.moment, moment + np.cross(arm, force))
            self._vector(key, row.force, force)
            return
        row.kind, now = lib.CPS_BODY_KIND_HELD, evolution.bodies[name]
        self._vector(key + ".rotation", row.rotation, _quaternion(key, value["rotation"]) if "rotation" in value else now.rotation)
        word = "move" if "move" in value else "position"
        self._vector(key, row.position, self._place(key, word, value.get(word, now.position), now.position))

    def _turn(self, evolution: "Evolution", key: str, value: Any, row: Any) -> None:
        row.obstacle = evolution._index("obstacles", key.rpartition(".")[0])
        row.angle = math.radians(_numbers.number(value, f"'{key}'"))

    def _pay_out(self, evolution: "Evolution", key: str, value: Any, row: Any) -> None:
        name, _, what = key.rpartition(".")
        row.line, row.end = evolution._index("lines", name), "AB".index(what[-1])
        row.length = _numbers.number(value, f"'{key}'")

    def _shift(self, evolution: "Evolution", key: str, value: Any, row: Any) -> None:
        row.obstacle = evolution._index("obstacles", key.rpartition(".")[0])
        known = isinstance(value, Mapping) and ("move" in value or "turn" in value) and set(value) <= {"move", "turn", "axis", "about"}
        if not known or ("turn" in value) != ("axis" in value) or ("about" in value and "turn" not in value):
            raise ArgumentError(f"'{key}': expected a dictionary with move, or with turn, axis and about, or both")
        if "move" in value:
            self._vector(key, row.by, value["move"])
        if "turn" in value:
            axis = _numbers.array(value["axis"], (3,), f"'{key}' axis")
            size = float(np.linalg.norm(axis))
            if not 0 < size < math.inf:
                raise ArgumentError(f"'{key}': the axis has no direction")
            angle = math.radians(_numbers.number(value["turn"], f"'{key}' turn"))
            self._vector(key + ".turn", row.turn, angle / size * axis)
            self._vector(key + ".about", row.about, value.get("about", [0, 0, 0]))
