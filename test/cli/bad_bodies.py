#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies in scene files: good ones as `capstan check` prints them, and bad ones, each of which is refused with its place
(file:line:column) and its message, in one line.                                                        usage: bad_bodies.py CAPSTAN
                                                                or: bad_bodies.py --write FOLDER   (to begin fuzzing with)

Every bad one is one change to the good scene.
"""
import sys

from checks import is_told
from one_change import one_change_each, write_bad

GOOD = """\
capstan: 1
water_density: 1000
gravity: [0, 0, -10]
obstacles: {bed: {plane: {point: [0, 0, -50]}, friction: 0.5}}
bodies:
  spar:
    free: [0, 0, 0]
    rotation: {roll_pitch_yaw: [0, 5, 90]}
    fixed: [z, rx]
    mass: 500
    centre_of_gravity: [0, 0, -3]
    volume: 0.6
    centre_of_buoyancy: [0, 0, -2]
    hydrostatics: {z: 400, rx: 30, ry: 30}
    force: [1, 2, 3]
    arm: [0, 0, 10]
  barge: {held: [20, 0, 0]}
points:
  anchor: {held: [-30, 0, -50]}
  eye: {body: spar, at: [1, 0, -5]}
  bow: {body: barge, at: [-2, 0, 0]}
lines:
  leg: {length: 70, elements: 4, mass: 1, stiffness: 1e6, start: static, ends: {A: {point: anchor}, B: {point: eye}}}
  hawser: {length: 19, elements: 4, mass: 1, stiffness: 1e6, start: static, ends: {A: {point: eye}, B: {point: bow}}}
history:
  - {name: tow, barge.body: {move: [1, 0, 0]}}
  - {name: push, spar.body: {force: [5, 0, 0], arm: [0, 0, 10]}}
"""
BARGE = "  barge: {held: [20, 0, 0]}\n"
EYE = "  eye: {body: spar, at: [1, 0, -5]}\n"
HEAVY = GOOD[GOOD.index("gravity: ["):GOOD.index("    centre_of_gravity")]
WATER = "    hydrostatics: {z: 400, rx: 30, ry: 30}\n"
TURN = "{roll_pitch_yaw: [0, 5, 90]}"
TOW, PUSH = "{move: [1, 0, 0]}", "{force: [5, 0, 0], arm: [0, 0, 10]}"
LIST = ("a mapping with held, free, rotation, fixed, mass, weight, centre_of_gravity, volume, buoyancy, centre_of_buoyancy, hydrostatics, "
        "force, moment, arm")
POSE_OR_LOAD = "expected a pose ('position' or 'move', 'rotation') or a load ('force', 'moment')"
ROWS = "6 rows of 6 numbers, or a mapping with x, y, z, rx, ry, rz"


def matrix(**entries):
    """Six rows with these entries, as rc=value for row r and column c."""
    rows = [[entries.get(f"e{r}{c}", 0) for c in range(6)] for r in range(6)]
    return f"    hydrostatics: {rows}\n"


# name, what is replaced in GOOD, by what, expected after "FILE:"
CHANGES = [
    # bodies
    ("a body that is a place", BARGE, "  barge: [20, 0, 0]\n", f"17:3: body 'barge': found a list of 3, expected {LIST}"),
    ("a body that is nothing", BARGE, "  barge:\n", f"17:3: body 'barge': found nothing, expected {LIST}"),
    ("neither held nor free", BARGE, "  barge: {weight: 3}\n", "17:3: body 'barge': nothing given, expected exactly one of 'held', 'free'"),
    ("held and free", BARGE, "  barge: {held: [20, 0, 0], free: [20, 0, 0]}\n", "17:3: body 'barge': too much given, expected exactly one of 'held', 'free'"),
    ("an unknown key", BARGE, "  barge: {holds: [20, 0, 0]}\n", "17:11: body 'barge': unknown key 'holds'; did you mean 'held'?"),
    ("an unknown key, nothing near", BARGE, "  barge: {held: [20, 0, 0], inertia: 3}\n", f"17:29: body 'barge': unknown key 'inertia', expected {LIST}"),
    ("another spelling", "    centre_of_gravity:", "    center_of_gravity:", "11:5: body 'spar': unknown key 'center_of_gravity'; did you mean 'centre_of_gravity'?"),
    ("a place of two numbers", BARGE, "  barge: {held: [20, 0]}\n", "17:11: 'held': found a list of 2, expected three numbers in m, as in [x, y, z]"),
    ("a place that is no number", BARGE, "  barge: {held: [20, .nan, 0]}\n", "17:22: 'held': found '.nan', expected a number in m"),
    ("weight and mass", "    mass: 500\n", "    mass: 500\n    weight: 5000\n", "10:5: 'mass': it does not go with 'weight': leave one of them out"),
    ("a negative mass", "    mass: 500\n", "    mass: -500\n", "10:5: 'mass': found '-500', expected a number in kg, at least 0"),
    ("a negative buoyancy", "    volume: 0.6\n", "    buoyancy: -1\n", "12:5: 'buoyancy': found '-1', expected a number in N, at least 0"),
    ("volume and buoyancy", "    volume: 0.6\n", "    volume: 0.6\n    buoyancy: 6000\n", "12:5: 'volume': it does not go with 'buoyancy': leave one of them out"),
    ("a volume without water", "water_density: 1000\n", "", "11:5: 'volume': it displaces water, but the scene has no 'water_density': give that, or the 'buoyancy' in N"),
    ("a centre of gravity without weight", "    mass: 500\n", "", "10:5: 'centre_of_gravity': it goes with 'mass' or 'weight', of which neither is given"),
    ("a centre of buoyancy without buoyancy", "    volume: 0.6\n", "", "12:5: 'centre_of_buoyancy': it goes with 'volume' or 'buoyancy', of which neither is given"),
    ("a weight without gravity", HEAVY, HEAVY.replace("-10", "0").replace("mass", "weight"), "6:3: body 'spar': it has a weight or a buoyancy, but gravity is zero and has no direction: give the scene a gravity"),
    ("a load on a held body", BARGE, "  barge: {held: [20, 0, 0], force: [1, 0, 0]}\n", "17:29: 'force': it goes with 'free', which is not given"),
    ("a moment on a held body", BARGE, "  barge: {held: [20, 0, 0], moment: [1, 0, 0]}\n", "17:29: 'moment': it goes with 'free', which is not given"),
    ("an arm without a force", "    force: [1, 2, 3]\n", "", "15:5: 'arm': it goes with 'force', which is not given"),
    ("a force of one number", "    force: [1, 2, 3]\n", "    force: [1]\n", "15:5: 'force': found a list of 1, expected three numbers in N, as in [x, y, z]"),
    ("free without mass and hydrostatics", BARGE, "  barge: {free: [20, 0, 0]}\n",
     "17:3: body 'barge': it is free and has neither mass nor hydrostatics: give its 'mass' or 'weight' (0 of one without), 'volume', 'buoyancy' or 'hydrostatics'"),
    ("free with a force alone", BARGE, "  barge: {free: [20, 0, 0], fixed: [x], force: [1, 0, 0]}\n", "17:3: body 'barge': it is free and has neither mass nor"),
    # rotations
    ("a rotation that is a list", TURN, "[0, 5, 90]", "8:5: 'rotation': found a list of 3, expected a mapping with quaternion, roll_pitch_yaw"),
    ("a rotation of nothing", TURN, "{}", "8:5: 'rotation': nothing given, expected exactly one of 'quaternion', 'roll_pitch_yaw'"),
    ("a rotation given twice", TURN, "{quaternion: [1, 0, 0, 0], roll_pitch_yaw: [0, 0, 0]}", "8:5: 'rotation': too much given, expected exactly one of 'quaternion', 'roll_pitch_yaw'"),
    ("a rotation by an unknown word", TURN, "{rollpitchyaw: [0, 0, 0]}", "8:16: 'rotation': unknown key 'rollpitchyaw'; did you mean 'roll_pitch_yaw'?"),
    ("a quaternion of three numbers", TURN, "{quaternion: [1, 0, 0]}", "8:16: 'quaternion': found a list of 3, expected four numbers, as in [w, x, y, z]"),
    ("a quaternion of zeros", TURN, "{quaternion: [0, 0, 0, 0]}", "8:5: body 'spar': rotation is (0, 0, 0, 0), expected a quaternion: finite numbers, not all 0"),
    ("angles with a unit", TURN, "{roll_pitch_yaw: [0, 5 deg, 90]}", "8:36: 'roll_pitch_yaw': found '5 deg', expected a number in degrees: write the number alone, without a unit"),
    # directions
    ("a direction that is none", "fixed: [z, rx]", "fixed: [z, roll]", "9:16: 'fixed': found 'roll', expected a list of some of: x y z rx ry rz, each once"),
    ("a direction twice", "fixed: [z, rx]", "fixed: [z, z]", "9:16: 'fixed': found 'z', expected a list of some of: x y z rx ry rz, each once"),
    ("a direction alone", "fixed: [z, rx]", "fixed: z", "9:5: 'fixed': found 'z', expected a list of some of: x y z rx ry rz, each once"),
    # hydrostatics
    ("hydrostatics of one number", WATER, "    hydrostatics: 400\n", f"14:5: 'hydrostatics': found '400', expected {ROWS}"),
    ("five rows", WATER, matrix().replace("[[0, 0, 0, 0, 0, 0], ", "["), f"14:5: 'hydrostatics': found a list of 5, expected {ROWS}"),
    ("rows of five", WATER, matrix().replace("0, 0, 0, 0, 0, 0", "0, 0, 0, 0, 0"), f"14:20: 'hydrostatics': found a list of 5, expected {ROWS}"),
    ("an unknown direction of the water", WATER, "    hydrostatics: {heave: 400}\n", "14:20: 'hydrostatics': unknown key 'heave', expected a mapping with x, y, z, rx, ry, rz"),
    ("a matrix that is not symmetric", WATER, matrix(e22=400, e04=5), "14:5: body 'spar': hydrostatics are not a symmetric matrix of finite numbers"),
    ("a matrix with infinity", WATER, matrix(e22=400).replace("400", ".inf"), "14:67: 'hydrostatics': found '.inf', expected a number"),
    # names, points
    ("a body twice", BARGE, BARGE + BARGE, "18:3: key 'barge' is given twice, first in line 17: keep one"),
    ("a name with a dot", BARGE, "  bar.ge: {held: [20, 0, 0]}\n" + BARGE, "17:3: body 2: its name is 'bar.ge', expected a letter followed by letters, digits,"),
    ("the name of a line", BARGE, BARGE + "  leg: {held: [0, 0, 0]}\n", "18:3: body 'leg': a line has the same name"),
    ("the name of a point", BARGE, BARGE + "  eye: {held: [0, 0, 0]}\n", "18:3: body 'eye': a point has the same name"),
    ("the name of an obstacle", BARGE, BARGE + "  bed: {held: [0, 0, 0]}\n", "18:3: body 'bed': an obstacle has the same name"),
    ("no point on it", BARGE, BARGE + "  tug: {free: [0, 0, 0], weight: 0}\n", "18:3: body 'tug': no point is on it: let a point with a line be on it, or leave it out"),
    ("a point on an unknown body", EYE, "  eye: {body: spur, at: [1, 0, -5]}\n", "20:9: 'body': there is no body 'spur'; did you mean 'spar'?"),
    ("a point on an unknown body, nothing near", EYE, "  eye: {body: platform, at: [1, 0, -5]}\n", "20:9: 'body': found 'platform', expected the name of one of the 2 bodies of the scene"),
    ("a point on a point", EYE, "  eye: {body: anchor, at: [1, 0, -5]}\n", "20:9: 'body': found 'anchor', expected the name of one of the 2 bodies of the scene"),
    ("points on no bodies", GOOD[GOOD.index("bodies:"):], GOOD[GOOD.index("points:"):GOOD.index("history:")], "7:9: 'body': found 'spar', but the scene has no 'bodies': give it there, held or free"),
    ("a point on a body and held", EYE, "  eye: {body: spar, held: [0, 0, 0]}\n", "20:3: point 'eye': too much given, expected exactly one of 'held', 'free', 'body'"),
    ("a place on no body", "{held: [-30, 0, -50]}", "{held: [-30, 0, -50], at: [0, 0, 0]}", "19:33: 'at': it goes with 'body', which is not given"),
    ("a weight of a point on a body", EYE, "  eye: {body: spar, at: [1, 0, -5], weight: 3}\n", "20:3: point 'eye': it is on a body, but has a force, a weight or an inertia: give them to the body"),
    ("an inertia of a point on a body", EYE, "  eye: {body: spar, at: [1, 0, -5], inertia: 3}\n", "20:3: point 'eye': it is on a body, but has a force, a weight or an inertia: give them to the body"),
    ("a point on a body without a line", EYE, EYE + "  spare: {body: spar}\n", "21:3: point 'spare': no line ends there: let an end of a line be at it, or leave it out"),
    ("a bearing area of a point on a body", EYE, "  eye: {body: spar, at: [1, 0, -5], bearing_area: 3}\n",
     "20:37: point 'eye': bearing_area: it is on a body, which does not bear on obstacles: let it be free, or leave the area out"),
    ("a point of a body below the bed", EYE, "  eye: {body: spar, at: [1, 0, -60]}\n", "20:3: point 'eye': it is 9.8"),
    ("friction with directions", "friction: 0.5", "friction: {axial: 0.5, lateral: 0.6}", "6:3: body 'spar': it may come to rest on obstacle 'bed', whose friction has directions"),
    # history
    ("an unknown body in the history", "barge.body:", "bargee.body:", "26:17: 'bargee.body': there is no such body; did you mean 'barge.body'?"),
    ("an unknown body in the history, nothing near", "barge.body:", "platform.body:", "26:17: 'platform.body': there is no such body under 'bodies'"),
    ("a point as a body", "barge.body:", "eye.body:", "26:17: 'eye.body': there is no such body under 'bodies'"),
    ("a body as a point", "barge.body:", "barge.point:", "26:17: 'barge.point': there is no such point"),
    ("a body alone", "barge.body:", "barge:", "26:17: entry: unknown key 'barge', expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn, POINT.point, BODY.body"),
    ("a body twice in an entry", TOW, TOW + ", barge.body: {move: [2, 0, 0]}", "26:48: key 'barge.body' is given twice, first in line 26: keep one"),
    ("a change of nothing", TOW, "{}", f"26:17: 'barge.body': nothing given, {POSE_OR_LOAD}"),
    ("a pose and a load", TOW, "{move: [1, 0, 0], force: [1, 0, 0]}", f"26:17: 'barge.body': both given, {POSE_OR_LOAD}"),
    ("a position and a move", TOW, "{move: [1, 0, 0], position: [1, 0, 0]}", "26:30: 'move': it does not go with 'position': leave one of them out"),
    ("an unknown change", TOW, "{turn: 5}", "26:30: 'barge.body': unknown key 'turn', expected a mapping with position, move, rotation, force, moment, arm"),
    ("a change in words", TOW, "free", "26:17: 'barge.body': found 'free', expected a mapping with position, move, rotation, force, moment, arm"),
    ("an arm alone", PUSH, "{arm: [0, 0, 10]}", "27:30: 'arm': it goes with 'force', which is not given"),
    ("a move of a free body", PUSH, "{move: [1, 0, 0]}", "27:30: 'spar.body': the body's pose before it is not known (it is free): give both its 'position' and its 'rotation'"),
    ("a position of a free body", PUSH, "{position: [1, 0, 0]}", "27:30: 'spar.body': the body's pose before it is not known (it is free): give both its 'position' and its 'rotation'"),
    ("a rotation of a free body", PUSH, "{rotation: {roll_pitch_yaw: [0, 0, 0]}}", "27:30: 'spar.body': the body's pose before it is not known (it is free): give both its 'position' and its 'rotation'"),
    ("a move of a body that was let go", TOW, "{force: [1, 0, 0]}}\n  - {barge.body: {move: [1, 0, 0]}", "27:19: 'barge.body': the body's pose before it is not known (it is free)"),
    ("turned to a quaternion of zeros", TOW, "{rotation: {quaternion: [0, 0, 0, 0]}}", "26:17: stage 1: body 'barge' gets numbers that are not finite, or no rotation"),
    ("a change of a point on a body", "barge.body:", "bow.point:", "26:17: 'bow.point': this point is on the body 'barge', expected a change of the body: write 'barge.body'"),
]

# replacements in GOOD, and what `capstan check` prints then
ACCEPTED = [
    ([], "  fixed in z rx\n  weight 5000 N at (0, 0, -3) m\n  buoyancy 6000 N at (0, 0, -2) m\n  hydrostatics      [0 0 0 0 0 0]\n"
         "                    [0 0 0 0 0 0]\n                    [0 0 400 0 0 0]\n                    [0 0 0 30 0 0]\n                    [0 0 0 0 30 0]\n"
         "                    [0 0 0 0 0 0]\n  force (1, 2, 3) N, moment (-20, 10, 0) N m\n"
         "body barge: held at (20, 0, 0) m, rotation (1, 0, 0, 0)\npoint anchor: held at (-30, 0, -50) m\n"
         "point eye: on body spar at (1, 0, -5) m\n"),
    # by hand: yaw about z first, then pitch about the new y: qz qy
    ([(TURN, "{roll_pitch_yaw: [0, 0, 90]}")], "body spar: free, begins at (0, 0, 0) m, rotation (0.707107, 0, 0, 0.707107)\n"),
    ([(TURN, "{roll_pitch_yaw: [0, 90, 90]}")], "rotation (0.5, -0.5, 0.5, 0.5)\n"),
    ([(TURN, "{roll_pitch_yaw: [90, 0, 90]}")], "rotation (0.5, 0.5, 0.5, 0.5)\n"),
    ([(TURN, "{roll_pitch_yaw: [90, 90, 0]}")], "rotation (0.5, 0.5, 0.5, -0.5)\n"),
    ([(TURN, "{quaternion: [2, 0, 0, 0]}")], "rotation (2, 0, 0, 0)\n"),
    ([("    mass: 500\n", "    weight: 7\n")], "  weight 7 N at (0, 0, -3) m\n"),
    ([("    volume: 0.6\n", "    buoyancy: 8\n")], "  buoyancy 8 N at (0, 0, -2) m\n"),
    ([(WATER, matrix(e22=400, e04=5, e40=5))], "  hydrostatics      [0 0 0 0 5 0]\n"),
    ([("    arm: [0, 0, 10]\n", "    arm: [0, 0, 10]\n    moment: [0, 0, 7]\n")], "force (1, 2, 3) N, moment (-20, 10, 7) N m\n"),
    ([("{body: spar, at: [1, 0, -5]}", "{body: spar}")], "point eye: on body spar at (0, 0, 0) m\n"),
    ([(PUSH, "{position: [1, 0, 0], rotation: {roll_pitch_yaw: [0, 0, 0]}}")], "history: 2 entries, 3 load steps in all\n"),
    ([(TOW, "{rotation: {roll_pitch_yaw: [0, 0, 30]}}}\n  - {barge.body: {move: [0, 1, 0]}")], "history: 3 entries, 4 load steps in all\n"),
]


def main():
    if sys.argv[1] == "--write":
        return write_bad(sys.argv[2], "bodies", GOOD, CHANGES)
    failed = one_change_each(sys.argv[1], GOOD, ACCEPTED, CHANGES)
    print(f"{len(CHANGES)} cases, {failed} failed")
    return 0 if is_told(len(CHANGES)) and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
