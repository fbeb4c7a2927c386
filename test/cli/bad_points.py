#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Points where lines meet in scene files: good ones as `capstan check` prints them, and bad ones, each of which is refused with its place
(file:line:column) and its message, in one line.                                                        usage: bad_points.py CAPSTAN
                                                                or: bad_points.py --write FOLDER   (to begin fuzzing with)

Every bad one is one change to the good scene.
"""
import sys

from checks import is_told
from one_change import one_change_each, write_bad

GOOD = """\
capstan: 1
obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}
points:
  anchor: {held: [0, 0, 0]}
  knot: {free: [10, 0, 0], force: [1, 2, 3], weight: 50}
  buoy:
    free: [10, 5, 5]
    weight: -70
lines:
  leg: {length: 11, elements: 4, mass: 1, stiffness: 1e6, start: static, ends: {A: {point: anchor}, B: {point: knot}}}
  riser:
    length: 8
    elements: 4
    mass: 1
    stiffness: 1e6
    start: static
    ends: {A: {point: knot}, B: {point: buoy}}
  stray: {length: 9, elements: 3, mass: 1, stiffness: 1e6, start: static, ends: {A: {held: [0, 0, 9]}, B: {point: buoy}}}
history:
  - {name: pull, knot.point: {force: [1, 0, 0]}}
  - {name: move, anchor.point: {move: [1, 0, 0]}}
"""
HELD = "  anchor: {held: [0, 0, 0]}\n"
KNOT = "{free: [10, 0, 0], force: [1, 2, 3], weight: 50}"
PULL = "  - {name: pull, knot.point: {force: [1, 0, 0]}}\n"
RISER = "ends: {A: {point: knot}, B: {point: buoy}}"
LIST = "a mapping with held, free, body, at, force, on, mass, weight, volume, height, holding_capacity, uplift_limit, drags"

# name, what is replaced in GOOD, by what, expected after "FILE:"
CHANGES = [
    # points
    ("points as a list", "points:\n" + HELD, "points: []\nobstacels:\n" + HELD, "4:1: scene: unknown key 'obstacels'; did you mean 'obstacles'?"),
    ("a point that is a place", HELD, "  anchor: [0, 0, 0]\n", f"4:3: point 'anchor': found a list of 3, expected {LIST}"),
    ("a point that is a word", HELD, "  anchor: held\n", f"4:3: point 'anchor': found 'held', expected {LIST}"),
    ("a point that is nothing", HELD, "  anchor:\n", f"4:3: point 'anchor': found nothing, expected {LIST}"),
    ("neither held nor free", HELD, "  anchor: {weight: 3}\n", "4:3: point 'anchor': nothing given, expected exactly one of 'held', 'free', 'body'"),
    ("held and free", HELD, "  anchor: {held: [0, 0, 0], free: [0, 0, 0]}\n", "4:3: point 'anchor': too much given, expected exactly one of 'held', 'free', 'body'"),
    ("an unknown key", HELD, "  anchor: {hold: [0, 0, 0]}\n", "4:12: point 'anchor': unknown key 'hold'; did you mean 'held'?"),
    ("an unknown key, nothing near", HELD, "  anchor: {position: [0, 0, 0]}\n", f"4:12: point 'anchor': unknown key 'position', expected {LIST}"),
    ("an earlier word", HELD, "  anchor: {fixed: [0, 0, 0]}\n", "4:12: point 'anchor': unknown key 'fixed'"),
    ("a place of two numbers", HELD, "  anchor: {held: [0, 0]}\n", "4:12: 'held': found a list of 2, expected three numbers in m, as in [x, y, z]"),
    ("a place in words", HELD, "  anchor: {held: here}\n", "4:12: 'held': found 'here', expected three numbers in m, as in [x, y, z]"),
    ("a place that is no number", HELD, "  anchor: {held: [0, .nan, 0]}\n", "4:22: 'held': found '.nan', expected a number in m"),
    ("a place with a unit", KNOT, "{free: [10 m, 0, 0]}", "5:17: 'free': found '10 m', expected a number in m: write the number alone, without a unit"),
    ("a force on a held point", HELD, "  anchor: {held: [0, 0, 0], force: [1, 0, 0]}\n", "4:29: 'force': it goes with 'free', which is not given"),
    ("a force of one number", "force: [1, 2, 3]", "force: [1]", "5:28: 'force': found a list of 1, expected three numbers in N, as in [x, y, z]"),
    ("a force that is infinite", "force: [1, 2, 3]", "force: [.inf, 2, 3]", "5:36: 'force': found '.inf', expected a number in N"),
    ("weight and mass", "weight: 50", "weight: 50, mass: 5", "5:58: 'mass': it does not go with 'weight': leave one of them out"),
    ("a volume beside a weight", "weight: 50", "weight: 50, volume: 5", "5:58: 'volume': it goes with 'mass', which is not given"),
    ("a negative mass", "weight: 50", "mass: -5", "5:46: 'mass': found '-5', expected a number in kg, at least 0"),
    ("a negative volume", "weight: 50", "mass: 5, volume: -1", "5:55: 'volume': found '-1', expected a number in m3, at least 0"),
    ("a height without a volume", "weight: 50", "mass: 5, height: 2", "5:55: 'height': it goes with 'volume', which is not given"),
    ("a negative height", "weight: 50", "mass: 5, volume: 1, height: -2", "5:66: 'height': found '-2', expected a number in m, at least 0"),
    ("an endless height", "weight: 50", "mass: 5, volume: 1, height: .inf", "5:66: 'height': found '.inf', expected a number in m"),
    ("a height of what never floats", "weight: 50", "mass: 5, volume: 1, height: 2",
     "5:66: point 'knot': height: it is that of what floats, but the water has no surface: give water_surface, or leave the height out"),
    ("a weight without gravity", "capstan: 1\n", "gravity: [0, 0, 0]\ncapstan: 1\n", "6:3: point 'knot': it has a weight or a buoyancy, but gravity is zero and has no direction: give the scene a gravity"),
    ("a weight in words", "weight: 50", "weight: heavy", "5:46: 'weight': found 'heavy', expected a number in N"),
    ("a point twice", HELD, HELD + HELD, "5:3: key 'anchor' is given twice, first in line 4: keep one"),
    ("a name with a dot", HELD, "  an.chor: {held: [0, 0, 0]}\n" + HELD, "4:3: point 1: its name is 'an.chor', expected a letter followed by letters, digits,"),
    ("the name of a line", HELD, HELD + "  leg: {held: [0, 0, 0]}\n", "5:3: point 'leg': a line has the same name"),
    ("the name of an obstacle", HELD, HELD + "  bed: {held: [0, 0, 0]}\n", "5:3: point 'bed': an obstacle has the same name"),
    ("at no line", HELD, HELD + "  spare: {held: [0, 0, 0]}\n", "5:3: point 'spare': no line ends there: let an end of a line be at it, or leave it out"),
    ("below the bed", "{held: [0, 0, 0]}", "{held: [0, 0, -2]}", "4:3: point 'anchor': it is 2 m below obstacle 'bed'"),
    ("friction with directions", "friction: 0.5", "friction: {axial: 0.5, lateral: 0.6}", "5:3: point 'knot': it may come to rest on obstacle 'bed', whose friction has directions"),
    # ends
    ("an unknown point", RISER, "ends: {A: {point: knott}, B: {point: buoy}}", "17:16: 'point': there is no point 'knott'; did you mean 'knot'?"),
    ("an unknown point, nothing near", RISER, "ends: {A: {point: platform}, B: {point: buoy}}", "17:16: 'point': found 'platform', expected the name of one of the 3 points of the scene"),
    ("capitals", RISER, "ends: {A: {point: Knot}, B: {point: buoy}}", "17:16: 'point': there is no point 'Knot'; did you mean 'knot'?"),
    ("a line for a point", RISER, "ends: {A: {point: stray}, B: {point: buoy}}", "17:16: 'point': found 'stray', expected the name of one of the 3 points of the scene"),
    ("a point that is a list", RISER, "ends: {A: {point: [knot]}, B: {point: buoy}}", "17:16: 'point': found a list of 1, expected a text, not empty"),
    ("no name of a point", RISER, "ends: {A: {point: }, B: {point: buoy}}", "17:16: 'point': found nothing, expected a text, not empty"),
    ("a name in place of an end", RISER, "ends: {A: knot, B: {point: buoy}}", "17:12: 'A': found 'knot', expected one of: held free, or a mapping with held, force, point"),
    ("at a point and held", RISER, "ends: {A: {point: knot, held: [0, 0, 0]}, B: {point: buoy}}", "17:12: 'A': too much given, expected exactly one of 'held', 'force', 'point'"),
    ("an end at a point misspelt", RISER, "ends: {A: {pont: knot}, B: {point: buoy}}", "17:16: 'A': unknown key 'pont'; did you mean 'point'?"),
    ("a start away from its point", "stiffness: 1e6\n    start: static", "stiffness: 1e6\n    start: {straight: {from: [0, 0, 0], to: [8, 0, 0]}}", "17:12: line 'riser': ends: end A is held at (10, 0, 0) m, but the start puts it at (0, 0, 0) m"),
    ("points without points", GOOD[GOOD.index("points:"):], GOOD[GOOD.index("lines:"):GOOD.index("history:")], "4:85: 'point': found 'anchor', but the scene has no 'points': give it there, held or free"),
    # ends that are let go
    ("an end at a point that moves", PULL, "  - {name: pull, leg.B: {position: [1, 0, 0]}}\n", "20:18: 'leg.B': this end is at the point 'knot', expected a change of the point: write 'knot.point', or release the end in an entry before"),
    ("released and moved in one entry", PULL, "  - {name: pull, leg.B: {release: true, position: [1, 0, 0]}}\n", "20:18: 'leg.B': too much given, expected exactly one of 'position', 'move', 'force', 'release'"),
    ("a move of what was let go", PULL, "  - {leg.B: {release: true}}\n  - {leg.B: {move: [1, 0, 0]}}\n", "21:14: 'leg.B': found a move, but the end's position before it is not known"),
    ("not released", PULL, "  - {name: pull, leg.B: {release: false}}\n", "20:18: 'leg.B': found false, expected true; leave the key out to leave the end as it is"),
    ("released in words", PULL, "  - {name: pull, leg.B: {release: now}}\n", "20:26: 'release': found 'now', expected true or false"),
    ("a point that is released", PULL, "  - {name: pull, knot.point: {release: true}}\n", "20:31: 'knot.point': unknown key 'release'"),
    ("the other end, which is still there", PULL, "  - {leg.B: {release: true}}\n  - {leg.A: {force: [1, 0, 0]}}\n", "21:6: 'leg.A': this end is at the point 'anchor'"),
    # water
    ("a surface without water", "capstan: 1\n", "capstan: 1\nwater_surface: 3\n", "2:1: 'water_surface': it goes with 'water_density', which is not given"),
    ("a surface in words", "capstan: 1\n", "capstan: 1\nwater_density: 1e3\nwater_surface: high\n", "3:1: 'water_surface': found 'high', expected a number in m"),
    ("a surface that is no number", "capstan: 1\n", "capstan: 1\nwater_density: 1e3\nwater_surface: .nan\n", "3:1: 'water_surface': found '.nan', expected a number in m"),
    ("a surface and gravity that tilts", "capstan: 1\n", "capstan: 1\nwater_density: 1e3\nwater_surface: 3\ngravity: [1, 0, -9]\n", "4:1: gravity: (1, 0, -9) m/s2 in a scene with a water surface, which is a plane z = constant: expected (0, 0, -g)"),
    ("a surface and gravity that rises", "capstan: 1\n", "capstan: 1\nwater_density: 1e3\nwater_surface: 3\ngravity: [0, 0, 9]\n", "4:1: gravity: (0, 0, 9) m/s2 in a scene with a water surface"),
    # anchors
    ("an anchor that is free", KNOT, "{free: [10, 0, 0], holding_capacity: 5}", "5:28: 'holding_capacity': it goes with 'held', which is not given"),
    ("a limit of a free point", KNOT, "{free: [10, 0, 0], uplift_limit: 5}", "5:28: 'uplift_limit': it goes with 'held', which is not given"),
    ("a capacity of nothing", HELD, "  anchor: {held: [0, 0, 0], holding_capacity: 0}\n", "4:29: 'holding_capacity': found '0', expected a number in N, greater than 0"),
    ("a limit below nothing", HELD, "  anchor: {held: [0, 0, 0], uplift_limit: -1}\n", "4:29: 'uplift_limit': found '-1', expected a number in N, greater than 0"),
    ("an infinite capacity", HELD, "  anchor: {held: [0, 0, 0], holding_capacity: .inf}\n", "4:29: 'holding_capacity': found '.inf', expected a number in N"),
    ("drags without a capacity", HELD, "  anchor: {held: [0, 0, 0], drags: true}\n", "4:29: 'drags': it goes with 'holding_capacity', which is not given"),
    ("drags in words", HELD, "  anchor: {held: [0, 0, 0], holding_capacity: 5, drags: a bit}\n", "4:50: 'drags': found 'a bit', expected true or false"),
    ("a move of an anchor that drags", HELD, "  anchor: {held: [0, 0, 0], holding_capacity: 5, drags: true}\n", "21:33: 'anchor.point': found a move, but the point's position before it is not known (it is free, or an anchor that drags): give a position instead"),
    # areas with which points bear
    ("a bearing area of nothing", KNOT, "{free: [10, 0, 0], bearing_area: 0}", "5:28: 'bearing_area': found '0', expected a number in m2, greater than 0"),
    ("a negative bearing area", KNOT, "{free: [10, 0, 0], bearing_area: -1}", "5:28: 'bearing_area': found '-1', expected a number in m2, greater than 0"),
    ("a bearing area that is no number", KNOT, "{free: [10, 0, 0], bearing_area: .nan}", "5:28: 'bearing_area': found '.nan', expected a number in m2"),
    ("an endless bearing area", KNOT, "{free: [10, 0, 0], bearing_area: .inf}", "5:28: 'bearing_area': found '.inf', expected a number in m2"),
    ("a bearing area in words", KNOT, "{free: [10, 0, 0], bearing_area: wide}", "5:28: 'bearing_area': found 'wide', expected a number in m2"),
    ("a bearing area on what is rigid", KNOT, "{free: [10, 0, 0], bearing_area: 2}", "5:28: point 'knot': bearing_area: no obstacle gives: give one a stiffness, or leave the area out"),
    ("a bearing area of a held point", HELD, "  anchor: {held: [0, 0, 0], bearing_area: 2}\n", "4:29: point 'anchor': bearing_area: it is held throughout, and what holds it bears all: let it be free, or leave the area out"),
    ("a bearing area of a point in a set", KNOT, "{free: [10, 0, 0], on: {ball: {centre: [10, 0, 1], radius: 2}}, bearing_area: 2}",
     "5:73: point 'knot': bearing_area: it is held to a set, and no obstacle bears it: leave the set out, or leave the area out"),
    ("an end without its point", RISER, "ends: {A: {point: knot}}", "17:5: 'ends': 'B' is missing"),
    ("a third end", RISER, "ends: {A: {point: knot}, B: {point: buoy}, C: {point: anchor}}", "17:48: 'ends': unknown key 'C'"),
    ("at a point and pulled", RISER, "ends: {A: {point: knot, force: [1, 0, 0]}, B: {point: buoy}}", "17:12: 'A': too much given, expected exactly one of 'held', 'force', 'point'"),
    ("a number for a point", RISER, "ends: {A: {point: 3}, B: {point: buoy}}", "17:16: 'point': found '3', expected the name of one of the 3 points of the scene"),
    ("an empty name", RISER, "ends: {A: {point: ''}, B: {point: buoy}}", "17:16: 'point': found the text \"\" in quotes, expected a text, not empty"),
    ("a line of no length between points", "leg: {length: 11", "leg: {length: 0", "10:9: 'length': found '0', expected a number in m, greater than 0"),
    ("a type that is not there", "    mass: 1\n    stiffness: 1e6\n    start: static\n    ends", "    type: chain\n    start: static\n    ends", "14:5: line 'riser': unknown key 'type'"),
    ("a place at infinity", "{held: [0, 0, 0]}", "{held: [.inf, 0, 0]}", "4:19: 'held': found '.inf', expected a number in m, finite and at most 1e100"),
    ("a set of friction forces", "friction: 0.5", "friction: {set: {disc: 0.3}}", "5:3: point 'knot': it may come to rest on obstacle 'bed', whose friction has directions"),
    # history
    ("no steps", "{name: pull, knot", "{name: pull, steps: 0, knot", "20:18: 'steps': found '0', expected a whole number"),
    ("a position that is no number", "{move: [1, 0, 0]}", "{position: [1, .nan, 0]}", "21:47: 'position': found '.nan', expected a number in m"),
    ("an unknown point in the history", "knot.point:", "konot.point:", "20:18: 'konot.point': there is no such point; did you mean 'knot.point'?"),
    ("an unknown point in the history, nothing near", "knot.point:", "platform.point:", "20:18: 'platform.point': there is no such point under 'points'"),
    ("a line as a point", "knot.point:", "leg.point:", "20:18: 'leg.point': there is no such point"),
    ("a point as a line", "knot.point:", "knot.A:", "20:18: 'knot.A': there is no such line"),
    ("a point alone", "knot.point:", "knot:", "20:18: entry: unknown key 'knot', expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn, POINT.point, BODY.body"),
    ("a point that turns", "knot.point: {force: [1, 0, 0]}", "knot.turn: 5", "20:18: 'knot.turn': there is no such obstacle"),
    ("a point twice in an entry", PULL, PULL.replace("}}", "}, knot.point: {force: [2, 0, 0]}}"), "20:50: key 'knot.point' is given twice, first in line 20: keep one"),
    ("a change of nothing", "{force: [1, 0, 0]}", "{}", "20:18: 'knot.point': nothing given, expected exactly one of 'position', 'move', 'force'"),
    ("two changes", "{force: [1, 0, 0]}", "{force: [1, 0, 0], move: [1, 0, 0]}", "20:18: 'knot.point': too much given, expected exactly one of 'position', 'move', 'force'"),
    ("a change in words", "{force: [1, 0, 0]}", "free", "20:18: 'knot.point': found 'free', expected a mapping with position, move, force"),
    ("an unknown change", "{force: [1, 0, 0]}", "{held: [1, 0, 0]}", "20:31: 'knot.point': unknown key 'held', expected a mapping with position, move, force"),
    ("a move of two numbers", "{move: [1, 0, 0]}", "{move: [1, 0]}", "21:33: 'move': found a list of 2, expected three numbers in m, as in [x, y, z]"),
    ("a move of a free point", "{force: [1, 0, 0]}", "{move: [1, 0, 0]}", "20:31: 'knot.point': found a move, but the point's position before it is not known (it is free): give a position instead"),
    ("a move of a point that was let go", "anchor.point: {move: [1, 0, 0]}}", "anchor.point: {force: [1, 0, 0]}}\n  - {anchor.point: {move: [1, 0, 0]}}", "22:21: 'anchor.point': found a move, but the point's position before it is not known"),
    ("moved below the bed", "{move: [1, 0, 0]}", "{move: [1, 0, -3]}", "21:18: stage 2: point 'anchor' is moved to 3 m below obstacle 'bed'"),
    ("a change of an end at a point", "knot.point:", "leg.B:", "20:18: 'leg.B': this end is at the point 'knot', expected a change of the point: write 'knot.point'"),
    ("a move of an end at a point", "knot.point: {force: [1, 0, 0]}", "leg.A: {move: [1, 0, 0]}", "20:18: 'leg.A': this end is at the point 'anchor', expected a change of the point: write 'anchor.point'"),
]

# replacements in GOOD, and what `capstan check` prints then
WATER = ("capstan: 1\n", "capstan: 1\nwater_density: 1000\n")
ACCEPTED = [
    ([], "point anchor: held at (0, 0, 0) m\n"
         "point knot: free, begins at (10, 0, 0) m, clump of 50 N, force (1, 2, 3) N\n"
         "point buoy: free, begins at (10, 5, 5) m, buoy of 70 N, force (0, 0, 0) N\nline leg: "),
    ([], "  end A: at point knot\n  end B: at point buoy\n"),
    ([("weight: 50", "mass: 50")], "clump of 490.5 N"),
    ([("weight: 50", "mass: 50, volume: 0.01")], "clump of 490.5 N"),
    ([("weight: 50", "mass: 50, volume: 0.01"), WATER], "clump of 392.4 N"),
    ([("weight: 50", "mass: 50, volume: 0.15"), WATER], "buoy of 981 N"),
    ([WATER], "clump of 50 N"),
    ([("{held: [0, 0, 0]}", "{held: [0, 0, 0], holding_capacity: 5e3, uplift_limit: 10}")], "held at (0, 0, 0) m, holding capacity 5000 N, uplift limit 10 N\n"),
    ([("{held: [0, 0, 0]}", "{held: [0, 0, 0], holding_capacity: 5e3, drags: true}"), ("anchor.point: {move:", "anchor.point: {position:")],
     "held at (0, 0, 0) m, holding capacity 5000 N, drags\n"),
    ([("weight: 50", "mass: 50, volume: 0.15"), ("capstan: 1\n", WATER[1] + "water_surface: 7\n")],
     "surface of the water at z = 7 m\nobstacle bed"),
    ([("weight: 50", "mass: 50, volume: 0.15"), ("capstan: 1\n", WATER[1] + "water_surface: 7\n")],
     "buoy of 981 N, displaces water of 1471.5 N, force"),
    ([("weight: 50", "mass: 50, volume: 0.15, height: 0.5"), ("capstan: 1\n", WATER[1] + "water_surface: 7\n")],
     "buoy of 981 N, displaces water of 1471.5 N over a height of 0.5 m, force"),
    ([("{held: [0, 0, 0]}", "{held: [0, 0, 0], weight: 5}")], "point anchor: held at (0, 0, 0) m, clump of 5 N\n"),
    ([("friction: 0.5", "friction: 0.5, stiffness: 1e4"), ("weight: 50}", "weight: 50, bearing_area: 0.25}"), ("{length: 11,", "{length: 11, bearing_width: 0.1,"),
      ("    length: 8\n", "    length: 8\n    bearing_width: 0.1\n"), ("{length: 9,", "{length: 9, bearing_width: 0.1,")],
     "clump of 50 N, bears on 0.25 m2, force (1, 2, 3) N\n"),
    # relative moves add up from where the entry before has put the point: (1, 0, 2) m and then down to the bed
    ([("anchor.point: {move: [1, 0, 0]}}", "anchor.point: {position: [1, 0, 2]}}\n  - {anchor.point: {move: [0, 0, -2]}}")],
     "history: 3 entries, 4 load steps in all\n"),
    # a line may begin and end at one point: a sling
    ([("B: {point: knot}", "B: {point: anchor}"), ("{A: {point: knot}, B: {point: buoy}}", "{A: {point: knot}, B: {point: knot}}")],
     "  end A: at point anchor\n  end B: at point anchor\n"),
]


def main():
    if sys.argv[1] == "--write":
        return write_bad(sys.argv[2], "points", GOOD, CHANGES)
    failed = one_change_each(sys.argv[1], GOOD, ACCEPTED, CHANGES)
    print(f"{len(CHANGES)} cases, {failed} failed")
    return 0 if is_told(len(CHANGES)) and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
