#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bad histories, data files and command lines: each is refused with its exit code, its place and its message, in one line.
                                                                                                       usage: bad_data.py CAPSTAN

(Bad scenes, laws and driven systems: bad_scenes.py, bad_laws.py and bad_drives.py.)
"""
import os
import subprocess
import sys
import tempfile

from bad_scenes import GOOD
from checks import is_told

INPUT, IO = 3, 4
ENTRY = "  - {name: pull, cable.B: {force: [1, 0, 0]}}\n"
METER = "capstan: 1\nplanimeter: {pole: [0, 0], pole_arm: 1, tracer_arm: 1, wheel: 0.5, friction: 0.2, load: 1, curve: {file: %s}}\n"
LINE = """capstan: 1
friction_policy: frozen
obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}
lines:
  rope: {length: 1, elements: 2, weight: 1, stiffness: 100, start: {straight: {from: [0, 0, 0], to: [1, 0, 0]}}, ends: {A: held, B: free}}
history: [{name: pull, rope.B: {force: [1, 0, 0]}}]
"""

# what stands below `history:`, exit code 3, expected after "FILE:"
HISTORIES = [
    ("an entry that is a word", "  - pull\n", "12:5: entry: found 'pull', expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn"),
    ("an entry that is a list", "  - [pull]\n", "12:5: entry: found a list of 1, expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn"),
    ("an entry that is nothing", "  -\n", "12:3: entry: found nothing, expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn"),
    ("a number for a history", "5\n", "11:1: 'history': found '5', expected a list, as in [{...}, {...}]"),
    ("a name in two lines", '  - {name: "a\\nb", cable.B: {force: [1, 0, 0]}}\n', "12:12: found a text with a line break, a tab or a control character: write it on one line, without"),
    ("a name that is a list", "  - {name: [a], cable.B: {force: [1, 0, 0]}}\n", "12:6: 'name': found a list of 1, expected a text"),
    ("steps in words", "  - {name: pull, steps: ten}\n", "12:18: 'steps': found 'ten', expected a whole number, from 1 to 1000000"),
    ("half a step", "  - {name: pull, steps: 2.5}\n", "12:18: 'steps': found '2.5', expected a whole number, from 1 to 1000000"),
    ("negative steps", "  - {name: pull, steps: -3}\n", "12:18: 'steps': found '-3', expected a whole number, from 1 to 1000000"),
    ("steps beyond the limit", "  - {name: pull, steps: 1000001}\n", "12:18: 'steps': found '1000001', expected a whole number, from 1 to 1000000"),
    ("steps as a list", "  - {name: pull, steps: [3]}\n", "12:18: 'steps': found a list of 1, expected a whole number, from 1 to 1000000"),
    ("steps twice", "  - {name: pull, steps: 3, steps: 4}\n", "12:28: key 'steps' is given twice, first in line 12: keep one"),
    ("steps misspelt", "  - {name: pull, step: 3}\n", "12:18: entry: unknown key 'step'; did you mean 'steps'?"),
    ("a line without an end", "  - {name: pull, cable: {force: [1, 0, 0]}}\n", "12:18: entry: unknown key 'cable', expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn"),
    ("an end of nothing", "  - {name: pull, .B: {force: [1, 0, 0]}}\n", "12:18: entry: unknown key '.B', expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn"),
    ("an end in small letters", "  - {name: pull, cable.b: {force: [1, 0, 0]}}\n", "12:18: entry: unknown key 'cable.b', expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn"),
    ("two dots", "  - {name: pull, cable..B: {force: [1, 0, 0]}}\n", "12:18: 'cable..B': there is no such line; did you mean 'cable.B'?"),
    ("an end with a space", "  - {name: pull, cable. B: {force: [1, 0, 0]}}\n", "12:18: entry: unknown key 'cable. B', expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn"),
    ("the same end twice", "  - {name: pull, cable.B: {force: [1, 0, 0]}, cable.B: {force: [2, 0, 0]}}\n", "12:47: key 'cable.B' is given twice, first in line 12: keep one"),
    ("a force as a number", "  - {name: pull, cable.B: {force: 1}}\n", "12:28: 'force': found '1', expected three numbers in N, as in [x, y, z]"),
    ("a force of two", "  - {name: pull, cable.B: {force: [1, 0]}}\n", "12:28: 'force': found a list of 2, expected three numbers in N, as in [x, y, z]"),
    ("a force of four", "  - {name: pull, cable.B: {force: [1, 0, 0, 0]}}\n", "12:28: 'force': found a list of 4, expected three numbers in N, as in [x, y, z]"),
    ("a force in words", "  - {name: pull, cable.B: {force: up}}\n", "12:28: 'force': found 'up', expected three numbers in N, as in [x, y, z]"),
    ("a force with units", "  - {name: pull, cable.B: {force: [1 N, 0, 0]}}\n", "12:36: 'force': found '1 N', expected a number in N: write the number alone, without a unit"),
    ("a force that overflows", "  - {name: pull, cable.B: {force: [1e999, 0, 0]}}\n", "12:36: 'force': found '1e999', expected a number in N"),
    ("a force that is no number", "  - {name: pull, cable.B: {force: [.nan, 0, 0]}}\n", "12:36: 'force': found '.nan', expected a number in N"),
    ("a force within a force", "  - {name: pull, cable.B: {force: [[1], 0, 0]}}\n", "12:36: 'force': found a list of 1, expected a number in N"),
    ("a force that is nothing", "  - {name: pull, cable.B: {force: }}\n", "12:28: 'force': found nothing, expected three numbers in N, as in [x, y, z]"),
    ("a force and a position", "  - {name: pull, cable.B: {force: [1, 0, 0], position: [1, 0, 0]}}\n", "12:18: 'cable.B': too much given, expected exactly one of 'position', 'move', 'force'"),
    ("an end that is nothing", "  - {name: pull, cable.B: }\n", "12:18: 'cable.B': found nothing, expected a mapping with position, move, force"),
    ("an end that is empty", "  - {name: pull, cable.B: {}}\n", "12:18: 'cable.B': nothing given, expected exactly one of 'position', 'move', 'force'"),
    ("an end that is a list", "  - {name: pull, cable.B: [1, 0, 0]}\n", "12:18: 'cable.B': found a list of 3, expected a mapping with position, move, force"),
    ("an end in words", "  - {name: pull, cable.B: up}\n", "12:18: 'cable.B': found 'up', expected a mapping with position, move, force"),
    ("an unknown key of an end", "  - {name: pull, cable.B: {froce: [1, 0, 0]}}\n", "12:28: 'cable.B': unknown key 'froce'; did you mean 'force'?"),
    ("a position of one", "  - {name: pull, cable.B: {position: [1]}}\n", "12:28: 'position': found a list of 1, expected three numbers in m, as in [x, y, z]"),
    ("a position in quotes", "  - {name: pull, cable.B: {position: ['1', 0, 0]}}\n", '12:39: \'position\': found the text "1" in quotes, expected a number in m'),
    ("a position that is infinite", "  - {name: pull, cable.B: {position: [.inf, 0, 0]}}\n", "12:39: 'position': found '.inf', expected a number in m"),
    ("a move that is a number", "  - {name: pull, cable.A: {move: 3}}\n", "12:28: 'move': found '3', expected three numbers in m, as in [x, y, z]"),
    ("a move in words", "  - {name: pull, cable.A: {move: [left, 0, 0]}}\n", "12:35: 'move': found 'left', expected a number in m"),
    ("a move below the bed", "  - {name: pull, cable.A: {move: [0, 0, -1]}}\n", "12:18: stage 1: cable.A is moved to 1 m below obstacle 'bed'"),
    ("two moves that end below the bed", "  - {name: up, cable.A: {move: [0, 0, 1]}}\n  - {name: down, cable.A: {move: [0, 0, -2]}}\n", "13:18: stage 2: cable.A is moved to 1 m below obstacle 'bed'"),
    ("held in a history", "  - {name: pull, cable.B: held}\n", "12:18: 'cable.B': found 'held', expected a mapping with position, move, force"),
    ("free and pulled", "  - {name: pull, cable.B: {free: 1}}\n", "12:28: 'cable.B': unknown key 'free'; did you mean 'force'?"),
    ("a turn of a plane in a later entry", "  - {name: pull, cable.B: {force: [1, 0, 0]}}\n  - {name: turn, bed.turn: 5}\n", "13:18: stage 2: obstacle 'bed' is a plane: only a round obstacle turns"),
    ("a turn that is nothing", "  - {name: pull, bed.turn: }\n", "12:18: 'bed.turn': found nothing, expected a number in degrees"),
    ("a turn of a list", "  - {name: pull, bed.turn: [1]}\n", "12:18: 'bed.turn': found a list of 1, expected a number in degrees"),
    ("a turn that is infinite", "  - {name: pull, bed.turn: .inf}\n", "12:18: 'bed.turn': found '.inf', expected a number in degrees"),
    ("an unknown motion of an obstacle", "  - {name: pull, bed.trun: 5}\n", "12:18: entry: unknown key 'bed.trun', expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn"),
    ("an anchor", "  - &pull {name: pull, steps: 2}\n", "12:6: found an anchor ('&'): write the value out instead"),
    ("an alias", "  - {name: pull, steps: 2}\n  - *pull\n", "13:6: found an alias ('*'): write the value out instead"),
    ("a merge key", "  - {<<: {name: pull}, steps: 2}\n", "12:6: entry: unknown key '<<', expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn"),
    ("a tag", "  - !stage {name: pull}\n", "12:5: found a tag ('!'): remove it"),
    ("a mapping that is not closed", "  - {name: pull, steps: 2\n", "13:1: not valid YAML: missing comma in flow mapping"),
    ("a quote that is not closed", "  - {name: 'pull, steps: 2}\n", "12:13: not valid YAML: single-quoted scalar without closing quote"),
    ("a tab before a key", "  - name: pull\n\tsteps: 2\n", "13:2: not valid YAML: invalid tab used as indentation"),
    ("an entry too far to the left", " - {name: pull}\n- {name: on}\n", "13:1: not valid YAML: did not find expected key"),
    ("a stray bracket", "  - {name: pull}}\n", "12:17: not valid YAML: flow mapping with invalid extra closing brace"),
    ("a colon alone", "  - {name: pull, : 3}\n", "12:12: entry: unknown key '', expected a mapping with name, steps, duration, time_step, error, gravity, LINE.END, LINE.node, LINE.pay_out, OBSTACLE.turn"),
    ("a question mark", "  - ? [a, b]\n    : 3\n", "12:7: found a mapping or a list as a key: a key is a word"),
    ("a control character", '  - {name: "p\\x07ull"}\n', "12:12: found a text with a line break, a tab or a control character: write it on one line, without"),
    ("a name in Latin-1", b"  - {name: p\xfcll}\n", "12:13: found byte 0xfc, which is not UTF-8: save the file as UTF-8"),
    ("a zero byte", b"  - {name: p\x00ll}\n", "12:13: found a control character (byte 0x00): remove it (is this a text file?)"),
    ("a second document in the middle", "  - {name: pull}\n---\n  - {name: on}\n", "13:1: found a second document ('---'): a file holds one scene"),
]

# the file that a planimeter names; expected after "capstan: ", of the file of the curve or of the one that names it
CURVES = [
    ("empty", b"", "c.csv: found 0 points, expected at least 3"),
    ("one point", b"1, 0\n", "c.csv: found 1 points, expected at least 3"),
    ("two points", b"1, 0\n1, 1\n", "c.csv: found 2 points, expected at least 3"),
    ("only names", b"x, y\n", "c.csv: found 0 points, expected at least 3"),
    ("only a comment", b"# nothing\n", "c.csv: found 0 points, expected at least 3"),
    ("names in the second line", b"1, 0\nx, y\n1, 1\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("two lines of names", b"x, y\nm, m\n1, 0\n1, 1\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("one number in a row", b"1, 0\n1\n0, 1\n0.5, 0.5\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("three numbers in a row", b"1, 0\n1, 1, 1\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("a word in a row", b"1, 0\n1, one\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("a word behind", b"1, 0\n1, 1 m\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("not a number", b"1, 0\nnan, 1\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("infinite", b"1, 0\n1, inf\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("overflow", b"1, 0\n1, 1e999\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("too large", b"1, 0\n1, 1e101\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("semicolons between rows", b"1, 0; 1, 1; 0, 1\n", "c.csv:1:1: found something else, expected two numbers x, y (in m) in each line"),
    ("a zero byte", b"1, 0\n1, 1\x00\n0, 1\n", "c.csv: found a zero byte: is this text?"),
    ("an escape", b"1, 0\n\x1b[31m, 1\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("out of reach", b"1, 0\n1, 1\n9, 9\n", "m.yaml:2:92: 'curve': the tracer cannot reach (9, 9), between points 1 and 2: the arms of 1 m and 1 m are too "),
    ("at the pole", b"0, 0\n1, 0\n0, 1\n", "m.yaml:2:92: 'curve': the tracer cannot reach the first point (0, 0)"),
    ("a decimal comma", b"1,5, 0\n1, 1\n0, 1\n", "c.csv:1:1: found something else, expected two numbers x, y (in m) in each line"),
    ("quotes", b'"1", 0\n1, 1\n0, 1\n', "c.csv: found 2 points, expected at least 3"),
    ("dots for a point", b"1, 0\n., .\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("hexadecimal words", b"1, 0\n0xg, 1\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("a lone sign", b"1, 0\n-, 1\n0, 1\n", "c.csv:2:1: found something else, expected two numbers x, y (in m) in each line"),
    ("UTF-16", b"\xff\xfe1\x00,\x00 \x000\x00\n\x00", "c.csv: found a zero byte: is this text?"),
]

# its name, exit code, expected after "capstan: "
CURVE_NAMES = [
    ("a folder", "sub", 4, "sub: is a directory, expected a file"),
    ("not there", "none.csv", 4, "none.csv: cannot open: No such file or directory"),
    ("up", "../c.csv", 3, "m.yaml:2:100: 'file': found '../c.csv', expected the name of a file beside this one, without '/'"),
    ("absolute", "/etc/passwd", 3, "m.yaml:2:100: 'file': found '/etc/passwd', expected the name of a file beside this one, without '/'"),
    ("an empty name", "''", 3, "m.yaml:2:100: 'file': found the text \"\" in quotes, expected a text, not empty"),
    ("a dash in quotes", "'-'", 3, "m.yaml:2:100: 'file': found the text \"-\" in quotes, expected the name of a file beside this one, without '/'"),
    ("a list", "[a]", 3, "m.yaml:2:100: 'file': found a list of 1, expected a text, not empty"),
    ("a link", "link.csv", 4, "link.csv: is a symbolic link, expected a file of this name itself"),
    ("a FIFO", "fifo.csv", 4, "fifo.csv: is not a regular file; '-' reads standard input"),
    ("a name with a slash", "sub/c.csv", 3, "m.yaml:2:100: 'file': found 'sub/c.csv', expected the name of a file beside this one, without '/'"),
    ("a dot", ".", 3, "m.yaml:2:100: 'file': found '.', expected the name of a file beside this one, without '/'"),
    ("two dots", "..", 3, "m.yaml:2:100: 'file': found '..', expected the name of a file beside this one, without '/'"),
    ("a number", "5", 4, "5: cannot open: No such file or directory"),
    ("nothing", "", 3, "m.yaml:2:100: 'file': found nothing, expected a text, not empty"),
]

# nodes to judge, of a line with two elements, expected after "capstan: "
NODES = [
    ("empty", b"", "n.csv: found 0 rows of nodes, expected 3"),
    ("only names", b"x,y,z\nm,m,m\n", "n.csv: found 0 rows of nodes, expected 3"),
    ("too few", b"0,0,0\n0.5,0,0\n", "n.csv: found 2 rows of nodes, expected 3"),
    ("too many", b"0,0,0\n0.5,0,0\n1,0,0\n2,0,0\n", "n.csv: found more than 3 rows of nodes, expected 3"),
    ("two numbers", b"0,0,0\n0.5,0\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("columns change", b"0,0,0\n0.5,0.5,0,0\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("a word", b"0,0,0\n0.5,0,up\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("not a number", b"0,0,0\nnan,0,0\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("infinite", b"0,0,0\n0.5,inf,0\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("overflow", b"0,0,0\n0.5,1e999,0\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("a blank row", b"0,0,0\n\n0.5,0,0\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("a comment in the middle", b"0,0,0\n# half\n0.5,0,0\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("three lines of names", b"a\nb\nc\n0,0,0\n0.5,0,0\n1,0,0\n", "n.csv:3: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("blanks for commas", b"0 0 0\n0.5 0 0\n1 0 0\n", "n.csv:3: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("semicolons", b"0;0;0\n0.5;0;0\n1;0;0\n", "n.csv:3: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("a trailing comma", b"0,0,0\n0.5,0,0,\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("an arc length that falls", b"0,0,0,0\n0.9,0.5,0,0\n1,1,0,0\n", "n.csv:2: found arc length 0.9 m, expected that of the line's nodes, in order"),
    ("arc lengths of another line", b"0,0,0,0\n5,0.5,0,0\n10,1,0,0\n", "n.csv:2: found arc length 5 m, expected that of the line's nodes, in order"),
    ("a row of 600 bytes", b"0,0,0\n0.5,0," + b"0" * 600 + b"\n1,0,0\n", "n.csv:2: found a row of more than 510 bytes, expected x,y,z or arc_length,x,y,z, finite numbers, one row per n"),
    ("a zero byte", b"0,0,0\n0.5\x00,0,0\n1,0,0\n", "n.csv:2: found a zero byte, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("an escape", b"0,0,0\n\x1b]0;x\x07,0,0\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
    ("quotes", b"0,0,0\n'0.5',0,0\n1,0,0\n", "n.csv:2: found another row, expected x,y,z or arc_length,x,y,z, finite numbers, one row per node"),
]

# files that are none, to judge
NODE_FILES = [
    ("a folder", "sub", "sub: Is a directory"),
    ("not there", "none.csv", "none.csv: No such file or directory"),
    ("a FIFO", "fifo.csv", "fifo.csv: is not a regular file"),
    ("a device", "/dev/zero", "/dev/zero: is not a regular file"),
]

# forces asked of a law on standard input, expected after "capstan: standard input:"
ROWS = [
    ("a blank file", b"\n\n", " found no rows, expected 2 numbers separated by commas, at most 1e100 in each"),
    ("three numbers", b"1,2,3\n", "1: expected 2 numbers separated by commas, at most 1e100: found '1,2,3'"),
    ("a word in the second row", b"1,2\na,b\n", "2: expected 2 numbers separated by commas, at most 1e100: found 'a,b'"),
    ("names twice", b"vx,vy\nvx,vy\n1,2\n", "2: expected 2 numbers separated by commas, at most 1e100: found 'vx,vy'"),
    ("infinite", b"inf,0\n", "1: expected 2 numbers separated by commas, at most 1e100: found 'inf,0'"),
    ("overflow", b"1e999,0\n", "1: expected 2 numbers separated by commas, at most 1e100: found '1e999,0'"),
    ("too large", b"1e101,0\n", "1: expected 2 numbers separated by commas, at most 1e100: found '1e101,0'"),
    ("tabs alone", b"\t\t\n", " found no rows, expected 2 numbers separated by commas, at most 1e100 in each"),
    ("a trailing comma", b"1,2,\n", "1: expected 2 numbers separated by commas, at most 1e100: found '1,2,'"),
    ("a leading comma", b",1,2\n", "1: expected 2 numbers separated by commas, at most 1e100: found ',1,2'"),
    ("two points", b"1..2,3\n", "1: expected 2 numbers separated by commas, at most 1e100: found '1..2,3'"),
    ("an escape", b"\x1b[2J,1\n", "1: expected 2 numbers separated by commas, at most 1e100: found '?[2J,1'"),
    ("a quote", b'"1",2\n', '1: expected 2 numbers separated by commas, at most 1e100: found \'"1",2\''),
    ("Latin-1", b"1,2\n\xfc,1\n", "2: expected 2 numbers separated by commas, at most 1e100: found '?,1'"),
    ("blank between", b"1 2\n", "1: expected 2 numbers separated by commas, at most 1e100: found '1 2'"),
    ("a unit", b"1 N,2\n", "1: expected 2 numbers separated by commas, at most 1e100: found '1 N,2'"),
    ("a comment behind", b"1,2 # here\n", "1: expected 2 numbers separated by commas, at most 1e100: found '1,2 # here'"),
    ("a percent sign", b"1%,2\n", "1: expected 2 numbers separated by commas, at most 1e100: found '1%,2'"),
    ("a long line", b"1," + b" " * (1 << 20) + b"2\n", "1: the line is longer than 1 MiB: found '...'"),
    ("no line end", b"1", "1: expected 2 numbers separated by commas, at most 1e100: found '1'"),
]

# command lines: exit code, expected on standard error
COMMANDS = [
    ("run", 2, "capstan run: no file given: capstan run SCENE.yaml ('-' reads standard input)"),
    ("run -o", 2, "capstan run: option '--output' needs an argument: --output DIR"),
    ("run j.yaml -o", 2, "capstan run: option '--output' needs an argument: --output DIR"),
    ("run j.yaml k.yaml", 2, "capstan run: unexpected 'k.yaml'"),
    ("run j.yaml --path-tolerance", 2, "capstan run: option '--path-tolerance' needs an argument: --path-tolerance TOL"),
    ("run j.yaml --path-tolerance x", 2, "capstan run: --path-tolerance 'x': expected a number, 0 or 1e-9 to 1"),
    ("run j.yaml --path-tolerance -1", 2, "capstan run: --path-tolerance '-1': expected a number, 0 or 1e-9 to 1"),
    ("run j.yaml --path-tolerance 2", 2, "capstan run: --path-tolerance '2': expected a number, 0 or 1e-9 to 1"),
    ("run j.yaml --path-tolerance nan", 2, "capstan run: --path-tolerance 'nan': expected a number, 0 or 1e-9 to 1"),
    ("run j.yaml --threads", 2, "capstan run: option '--threads' needs an argument: --threads N"),
    ("run j.yaml --threads two", 2, "capstan run: --threads 'two': expected a whole number, 1 to 256"),
    ("run j.yaml --threads 0", 2, "capstan run: --threads '0': expected a whole number, 1 to 256"),
    ("run j.yaml --threads 257", 2, "capstan run: --threads '257': expected a whole number, 1 to 256"),
    ("run j.yaml --threads 1.5", 2, "capstan run: --threads '1.5': expected a whole number, 1 to 256"),
    ("run j.yaml --threads 99999999999999999999", 2, "capstan run: --threads '99999999999999999999': expected a whole number, 1 to 256"),
    ("run j.yaml --threads 2 --method regularized", 2, "capstan run: --method regularized: takes the steps as given, without --path-tolerance, --threads and --resume, and writes no fields"),
    ("run j.yaml --sync", 2, "capstan run: option '--sync' needs an argument: --sync WHEN"),
    ("run j.yaml --sync never", 2, "capstan run: --sync: found 'never', expected step or end"),
    ("run j.yaml --fields", 2, "capstan run: option '--fields' needs an argument: --fields NAME,.."),
    ("run j.yaml --fields nothing", 2, "capstan run: --fields: found 'nothing', expected none or some of reference, position, load, normal, contact_ga"),
    ("run j.yaml --fields position,,tension", 2, "capstan run: --fields: found '', expected none or some of reference, position, load, normal, contact_gap, fric"),
    ("run j.yaml --method", 2, "capstan run: option '--method' needs an argument: --method NAME"),
    ("run j.yaml --method newton", 2, "capstan run: --method: found 'newton', expected exact or regularized"),
    ("run j.yaml --quite", 2, "capstan run: unknown option '--quite'; did you mean '--quiet'?"),
    ("run j.yaml -z", 2, "capstan run: unknown option '-z'"),
    ("run j.yaml --force=1", 2, "capstan run: '--force=1': option '--force' takes no argument"),
    ("run j.yaml --resume=yes", 2, "capstan run: '--resume=yes': option '--resume' takes no argument"),
    ("run j.yaml --plot x.svg", 2, "capstan run: unknown option '--plot'"),
    ("run j.yaml -o /dev/null", 4, "capstan: cannot use /dev/null as a directory for results: Not a directory"),
    ("run j.yaml -o /proc/none", 4, "capstan: cannot use /proc/none as a directory for results: No such file or directory"),
    ("run none.yaml", 4, "capstan: none.yaml: cannot open: No such file or directory"),
    ("run sub", 4, "capstan: sub: is a directory, expected a file"),
    ("run l.yaml", 3, "capstan: l.yaml:2:1: found a law ('law'), which 'capstan law' takes; expected a scene"),
    ("run m.yaml", 3, "capstan: m.yaml:2:1: found a driven system ('planimeter'), which 'capstan drive' takes; expected a scene"),
    ("run c.csv", 3, "capstan: c.csv:1:1: scene: found '1, 0 1, 1 0, 1', expected a mapping with capstan, title, gravity, water_density,"),
    ("check", 2, "capstan check: no file given: capstan check SCENE.yaml ('-' reads standard input)"),
    ("check none.yaml", 4, "capstan: none.yaml: cannot open: No such file or directory"),
    ("check l.yaml", 3, "capstan: l.yaml:2:1: found a law ('law'), which 'capstan law' takes; expected a scene"),
    ("check m.yaml", 3, "capstan: m.yaml:2:1: found a driven system ('planimeter'), which 'capstan drive' takes; expected a scene"),
    ("check j.yaml -o x", 2, "capstan check: unknown option '-o'"),
    ("check j.yaml --force", 2, "capstan check: unknown option '--force'"),
    ("study", 2, "capstan study: no file given: capstan study SCENE.yaml ('-' reads standard input)"),
    ("study none.yaml", 4, "capstan: none.yaml: cannot open: No such file or directory"),
    ("study j.yaml --judge", 2, "capstan study: option '--judge' needs an argument: --judge FILE.csv"),
    ("study j.yaml --complete", 2, "capstan study: option '--complete' needs an argument: --complete SHAPE"),
    ("study j.yaml --complete curly -o jd", 2, "capstan study: --complete: found 'curly', expected shortest, straight or meander"),
    ("study j.yaml --judge n.csv --complete straight -o jd", 2, "capstan study: found two of --history, --judge and --complete, expected one at most"),
    ("study j.yaml --history --judge n.csv -o jd", 2, "capstan study: found two of --history, --judge and --complete, expected one at most"),
    ("study j.yaml --step none -o jd", 2, "capstan study: --step: found 'none', expected the name of a step, 'capstan run' lists them, or a number from 1 to 1"),
    ("study j.yaml --line none -o jd", 2, "capstan study: --line: found 'none', expected the name of a line of the scene"),
    ("study j.yaml --tolerance 0 -o jd", 2, "capstan study: --tolerance '0': expected a number above 0 and below 1"),
    ("study j.yaml --tolerance 1 -o jd", 2, "capstan study: --tolerance '1': expected a number above 0 and below 1"),
    ("study j.yaml --tolerance x -o jd", 2, "capstan study: --tolerance 'x': expected a number above 0 and below 1"),
    ("study j.yaml --tol 1", 2, "capstan study: unknown option '--tol'; did you mean '--tolerance'?"),
    ("study l.yaml", 3, "capstan: l.yaml:2:1: found a law ('law'), which 'capstan law' takes; expected a scene"),
    ("law none.yaml", 4, "capstan: none.yaml: cannot open: No such file or directory"),
    ("law j.yaml", 3, "capstan: j.yaml:4:1: found a scene ('lines'), which 'capstan run', 'check' and 'study' take; expected a law"),
    ("law m.yaml", 3, "capstan: m.yaml:2:1: found a driven system ('planimeter'), which 'capstan drive' takes; expected a law"),
    ("law l.yaml --velocity", 2, "capstan law: option '--velocity' needs an argument: --velocity V,.."),
    ("law l.yaml --velocity x", 2, "capstan law: --velocity: expected 2 numbers separated by commas, at most 1e100: found 'x'"),
    ("law l.yaml --velocity 1,2,", 2, "capstan law: --velocity: expected 2 numbers separated by commas, at most 1e100: found '1,2,'"),
    ("law l.yaml --force 1", 2, "capstan law: --force: expected 2 numbers separated by commas, at most 1e100: found '1'"),
    ("law l.yaml --force inf,0", 2, "capstan law: --force: expected 2 numbers separated by commas, at most 1e100: found 'inf,0'"),
    ("law l.yaml --plot", 2, "capstan law: option '--plot' needs an argument: --plot FILE.svg"),
    ("law l.yaml --plot x.svg --axes", 2, "capstan law: option '--axes' needs an argument: --axes I,J"),
    ("law l.yaml --plot x.svg --axes 1", 2, "capstan law: --axes: found '1', expected two components from 1 to 2, as in 1,2"),
    ("law l.yaml --plot x.svg --axes 1,2,3", 2, "capstan law: --axes: found '1,2,3', expected two components from 1 to 2, as in 1,2"),
    ("law l.yaml --plot x.svg --axes 0,1", 2, "capstan law: --axes: found '0,1', expected two components from 1 to 2, as in 1,2"),
    ("law l.yaml --plot x.svg --axes a,b", 2, "capstan law: --axes: found 'a,b', expected two components from 1 to 2, as in 1,2"),
    ("law l.yaml --resume", 2, "capstan law: unknown option '--resume'"),
    ("drive none.yaml", 4, "capstan: none.yaml: cannot open: No such file or directory"),
    ("drive j.yaml", 3, "capstan: j.yaml:4:1: found a scene ('lines'), which 'capstan run', 'check' and 'study' take; expected a driven"),
    ("drive l.yaml", 3, "capstan: l.yaml:2:1: found a law ('law'), which 'capstan law' takes; expected a driven system"),
    ("drive m.yaml --eliminate", 2, "capstan drive: --velocity, --force and --eliminate go with 'system'; found 'planimeter', which says in the fil"),
    ("drive m.yaml --force 1", 2, "capstan drive: --velocity, --force and --eliminate go with 'system'; found 'planimeter', which says in the fil"),
    ("drive m.yaml --axes 1,2", 2, "capstan drive: --axes goes with --eliminate --plot"),
    ("drive m.yaml --plot", 2, "capstan drive: option '--plot' needs an argument: --plot FILE.svg"),
    ("drive m.yaml --tol 1", 2, "capstan drive: unknown option '--tol'"),
    ("schema law drive", 2, "capstan schema: unexpected 'drive'"),
    ("schema lawn", 2, "capstan schema: found 'lawn', expected scene, law or drive"),
    ("schema -o x", 2, "capstan schema: unknown option '-o'"),
    ("schema --quiet=3", 2, "capstan schema: unknown option '--quiet=3'"),
    ("version", 2, "capstan: unknown command 'version'"),
    ("-", 2, "capstan: unexpected '-'"),
    ("--help=me", 2, "capstan: '--help=me': option '--help' takes no argument"),
    ("--version=2", 2, "capstan: '--version=2': option '--version' takes no argument"),
    ("-hq", 2, "capstan: '-hq': option '--help' takes no argument"),
    ("help nothing", 2, "capstan: unknown command 'help'"),
    ("RUN j.yaml", 2, "capstan: unknown command 'RUN'"),
    ("run j.yaml -q -q --jsno", 2, "capstan run: unknown option '--jsno'; did you mean '--json'?"),
    ("law l.yaml --vel 1,0", 2, "capstan law: unknown option '--vel'; did you mean '--velocity'?"),
    ("drive m.yaml --velocty 1", 2, "capstan drive: unknown option '--velocty'; did you mean '--velocity'?"),
]

count = failed = 0


def expect(name, command, code, wanted, data=None, lines=1):
    global count, failed
    count += 1
    done = subprocess.run([CAPSTAN, *command], capture_output=True, input=data or b"", timeout=60)
    err = done.stderr.decode(errors="replace")
    if done.returncode != code or done.stdout or not err.startswith(wanted) or not err.endswith("\n") or err.count("\n") > lines:
        failed += 1
        print(f"FAILED {name}\n  expected exit {code}: {wanted}\n  found    exit {done.returncode}: {err}")


def write(name, data):
    with open(name, "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode())


def main():
    os.mkdir("sub")
    os.symlink("c.csv", "link.csv")
    os.mkfifo("fifo.csv")
    write("j.yaml", LINE)
    write("l.yaml", "capstan: 1\nlaw: {disc: 1}\n")
    for name, below, wanted in HISTORIES:
        below = below if isinstance(below, bytes) else below.encode()
        old = ENTRY.encode() if below.startswith((b" ", b"-")) else b"\n" + ENTRY.encode()
        write("s.yaml", GOOD.encode().replace(old, below if old.startswith(b" ") else b" " + below))
        expect(f"history: {name}", ["check", "s.yaml"], INPUT, f"capstan: s.yaml:{wanted}")
    for name, file, code, wanted in CURVE_NAMES:
        write("c.csv", "1, 0\n1, 1\n0, 1\n")
        write("m.yaml", METER % file)
        expect(f"name of a curve: {name}", ["drive", "m.yaml"], code, f"capstan: {wanted}")
    write("m.yaml", METER % "c.csv")
    for name, data, wanted in CURVES:
        write("c.csv", data)
        expect(f"curve: {name}", ["drive", "m.yaml"], INPUT, f"capstan: {wanted}")
    judge = ["study", "j.yaml", "-q", "-o", "judged", "--judge"]
    for name, data, wanted in NODES:
        write("n.csv", data)
        expect(f"nodes: {name}", [*judge, "n.csv"], INPUT, f"capstan: {wanted}")
    for name, file, wanted in NODE_FILES:
        expect(f"nodes: {name}", [*judge, file], IO, f"capstan: {wanted}")
    expect("nodes: nothing on standard input", [*judge, "-"], INPUT, "capstan: standard input: found 0 rows of nodes, expected 3")
    for name, data, wanted in ROWS:
        expect(f"rows: {name}", ["law", "l.yaml", "-f", "-"], INPUT, f"capstan: standard input:{wanted}", data)
    write("c.csv", "1, 0\n1, 1\n0, 1\n")
    for command, code, wanted in COMMANDS:
        expect(command, command.split(), code, wanted, lines=2)


CAPSTAN = os.path.abspath(sys.argv[1])
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
    os.chdir("/")
print(f"{count} cases, {failed} failed")
sys.exit(0 if is_told(count) and not failed else 1)
