#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bad scenes: each must be refused with its exit code, its place (file:line:column) and its message.

usage: bad_scenes.py CAPSTAN           or: bad_scenes.py --write FOLDER   (to begin fuzzing with)

Every case is one change to a good scene, or whole file contents. Expected is the exit code and what follows the file
name in the message; the whole of standard error must be one line, and standard output empty.
"""
import os
import subprocess
import sys
import tempfile

from checks import is_told

GOOD = """\
capstan: 1
obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}
lines:
  cable:
    length: 10
    elements: 4
    mass: 1
    stiffness: 1e6
    start: {straight: {from: [0, 0, 0], to: [10, 0, 0]}}
    ends: {A: held, B: free}
history:
  - {name: pull, cable.B: {force: [1, 0, 0]}}
"""
INPUT, IO, LIMIT = 3, 4, 6
START = "{straight: {from: [0, 0, 0], to: [10, 0, 0]}}"
ENDS = "{A: held, B: free}"

SURFACE, FLOAT = "water_density: 1000\nwater_surface: 5\n", "    point_weights: [{at: 4, mass: 1, volume: 0.1, floats: true}]\n"

# a line in one piece, and made of sections
PLAIN = "lines:\n  cable:\n    length: 10\n    elements: 4\n    mass: 1\n    stiffness: 1e6\n"


def made(sections="[{type: chain, length: 4, elements: 2}, {type: wire, length: 6, elements: 3}]", chain="{mass: 1, stiffness: 1e6}",
         wire="{weight: 5, stiffness: 2e6}", more="", water=""):
    return f"{water}types:\n  chain: {chain}\n  wire: {wire}\nlines:\n  cable:\n    sections: {sections}\n{more}"


# name, what is replaced in GOOD, by what, exit code, expected after "FILE:"
CHANGES = [
    # keys
    ("unknown key at the top", "obstacles:", "obstacels:", INPUT, "2:1: scene: unknown key 'obstacels'; did you mean 'obstacles'?"),
    ("unknown key of a line", "stiffness: 1e6", "stifness: 1e6", INPUT, "8:5: line 'cable': unknown key 'stifness'; did you mean 'stiffness'?"),
    ("capitals", "length: 10", "Length: 10", INPUT, "5:5: line 'cable': unknown key 'Length'; did you mean 'length'?"),
    ("unknown key, nothing near", "mass: 1", "colour: 1", INPUT, "7:5: line 'cable': unknown key 'colour', expected a mapping with length, elements, element_length, grade, mass,"),
    ("unknown key of a plane", "{normal:", "{norm:", INPUT, "2:27: 'plane': unknown key 'norm'"),
    ("unknown key of an entry", "name: pull,", "nmae: pull,", INPUT, "12:6: entry: unknown key 'nmae'; did you mean 'name'?"),
    ("unknown line in the history", "cable.B:", "cabel.B:", INPUT, "12:18: 'cabel.B': there is no such line; did you mean 'cable.B'?"),
    ("unknown line, nothing near", "cable.B:", "mooring.B:", INPUT, "12:18: 'mooring.B': there is no such line under 'lines'"),
    ("unknown line, too long a name", "cable.B:", "c" * 100 + ".B:", INPUT, "12:18: 'ccc"),
    ("unknown end in the history", "cable.B:", "cable.C:", INPUT, "12:18: entry: unknown key 'cable.C'"),
    ("duplicate key", "    mass: 1\n", "    mass: 1\n    length: 9\n", INPUT, "8:5: key 'length' is given twice, first in line 5"),
    ("duplicate line", "history:", "  cable: {}\nhistory:", INPUT, "11:3: key 'cable' is given twice, first in line 4"),
    ("duplicate key, quoted", "    mass: 1\n", "    mass: 1\n    \"length\": 9\n", INPUT, "8:5: key 'length' is given twice"),
    ("key missing", "    length: 10\n", "", INPUT, "4:3: line 'cable': 'length' is missing: [m] unstretched length"),
    ("version missing", "capstan: 1\n", "", INPUT, "1:1: scene: 'capstan' is missing"),
    ("version of the future", "capstan: 1", "capstan: 2", INPUT, "1:1: 'capstan': found '2', expected a whole number: 1"),
    ("neither mass nor weight", "    mass: 1\n", "", INPUT, "4:3: line 'cable': nothing given, expected exactly one of 'mass', 'weight', 'sections'"),
    ("mass and weight", "mass: 1", "mass: 1\n    weight: 10", INPUT, "4:3: line 'cable': too much given, expected exactly one of 'mass', 'weight'"),
    ("end missing", ENDS, "{A: held}", INPUT, "10:5: 'ends': 'B' is missing"),
    ("ends missing", "    ends: " + ENDS + "\n", "", INPUT, "4:3: line 'cable': 'ends' is missing"),
    ("a list as key", "mass: 1", "[mass]: 1", INPUT, "7:5: found a mapping or a list as a key"),
    ("name of an obstacle", "{bed:", "{1bed:", INPUT, "2:13: obstacle 1: its name is '1bed'"),
    # types and units
    ("unit in the value", "length: 10", "length: 10 m", INPUT, "5:5: 'length': found '10 m', expected a number in m, greater than 0: write the number alone, without a unit"),
    ("decimal comma", "mass: 1", "mass: 1,5", INPUT, "7:5: 'mass': found '1,5', expected a number in kg/m, at least 0: write a decimal point"),
    ("text for a number", "length: 10", "length: long", INPUT, "5:5: 'length': found 'long', expected a number in m"),
    ("number in quotes", "length: 10", "length: '10'", INPUT, "5:5: 'length': found the text \"10\" in quotes, expected a number"),
    ("nothing for a number", "length: 10", "length:", INPUT, "5:5: 'length': found nothing, expected a number in m"),
    ("list for a number", "length: 10", "length: [10]", INPUT, "5:5: 'length': found a list of 1, expected a number"),
    ("number for a mapping", "start: " + START, "start: 3", INPUT, "9:5: 'start': found '3', expected 'static', or a mapping with straight, polyline, arc, nodes"),
    ("mapping for a list", "  - {name: pull,", "  {name: pull,", INPUT, "11:1: 'history': found a mapping, expected a list"),
    ("list for a mapping", "obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}", "obstacles: []", INPUT, "2:1: 'obstacles': found a list of 0, expected a mapping"),
    ("two components", "to: [10, 0, 0]", "to: [10, 0]", INPUT, "9:41: 'to': found a list of 2, expected three numbers in m, as in [x, y, z]"),
    ("text in a vector", "to: [10, 0, 0]", "to: [10, y, 0]", INPUT, "9:50: 'to': found 'y', expected a number in m"),
    ("an unknown word", "history:", "contact_policy: lost\nhistory:", INPUT, "11:1: 'contact_policy': found 'lost', expected one of: reached reference"),
    ("one point", START, "{polyline: [[0, 0, 0]]}", INPUT, "9:13: 'polyline': found a list of 1, expected a list of at least 2 rows of 3 numbers in m, as in"),
    ("two shapes", START, "{straight: {from: [0, 0, 0], to: [10, 0, 0]}, arc: {from: [0, 0, 0], centre: [0, 5, 0]}}", INPUT, "9:5: 'start': too much given, expected exactly one of"),
    # numbers
    ("NaN", "length: 10", "length: .nan", INPUT, "5:5: 'length': found '.nan', expected a number in m, greater than 0"),
    ("NaN in a vector", "to: [10, 0, 0]", "to: [10, .NaN, 0]", INPUT, "9:50: 'to': found '.NaN'"),
    ("infinite length", "length: 10", "length: .inf", INPUT, "5:5: 'length': found '.inf', expected a number in m, greater than 0"),
    ("overflow", "length: 10", "length: 1e999", INPUT, "5:5: 'length': found '1e999'"),
    ("infinite force", "force: [1, 0, 0]", "force: [-.inf, 0, 0]", INPUT, "12:36: 'force': found '-.inf'"),
    ("negative length", "length: 10", "length: -2", INPUT, "5:5: 'length': found '-2', expected a number in m, greater than 0"),
    ("zero length", "length: 10", "length: 0", INPUT, "5:5: 'length': found '0', expected a number in m, greater than 0"),
    ("zero stiffness", "1e6", "0", INPUT, "8:5: 'stiffness': found '0', expected a number in N, greater than 0, or .inf"),
    ("negative stiffness", "1e6", "-.inf", INPUT, "8:5: 'stiffness': found '-.inf'"),
    ("negative friction", "friction: 0.5", "friction: -0.5", INPUT, "2:47: 'friction': found '-0.5', expected a number, at least 0, or a mapping with axial"),
    ("zero elements", "elements: 4", "elements: 0", INPUT, "6:5: 'elements': found '0', expected a whole number, at least 1"),
    ("part of an element", "elements: 4", "elements: 4.5", INPUT, "6:5: 'elements': found '4.5', expected a whole number"),
    ("zero steps", "name: pull,", "steps: 0,", INPUT, "12:6: 'steps': found '0', expected a whole number, from 1 to 1000000"),
    ("tolerance too wide", "history:", "solver: {tolerance: 1}\nhistory:", INPUT, "11:10: 'tolerance': found '1', expected a number, from 1e-14 to 0.01"),
    ("zero normal", "[0, 0, 1]", "[0, 0, 0]", INPUT, "2:27: obstacle 'bed': plane normal is (0, 0, 0), expected a direction"),
    # sizes
    ("1e12 elements", "elements: 4", "elements: 1e12", LIMIT, "6:5: elements: 1000000000000 elements in all lines so far, the limit is 10000000"),
    ("1e300 elements", "elements: 4", "elements: [[1e99, 10]]", LIMIT, "6:5: elements: 1e+99 elements in all lines so far"),
    ("too many steps", "name: pull,", "steps: 1e6}\n  - {", LIMIT, "13:5: history: 1000001 load steps so far, the limit is 1000000"),
    # elements
    ("elements too short in all", "elements: 4", "elements: [2, 2, 2]", INPUT, "6:5: line 'cable': elements are 6 m long together, but length is 10 m"),
    ("negative element", "elements: 4", "elements: [12, -2]", INPUT, "6:20: 'elements': found '-2', expected a number in m, greater than 0"),
    ("zero elements in a pair", "elements: 4", "elements: [[0, 10]]", INPUT, "6:17: 'elements': found '0', expected a whole number, at least 1"),
    ("no elements", "elements: 4", "elements: []", INPUT, "6:5: 'elements': found a list of 0"),
    # sections, types, clumps and buoys
    ("sections and a length", PLAIN, made(more="    length: 10\n"), INPUT, "9:5: 'length': it does not go with 'sections': leave one of them out"),
    ("sections and elements", PLAIN, made(more="    elements: 4\n"), INPUT, "9:5: 'elements': it does not go with 'sections'"),
    ("sections and a stiffness", PLAIN, made(more="    stiffness: 1e6\n"), INPUT, "9:5: 'stiffness': it does not go with 'sections'"),
    ("sections and a weight", PLAIN, made(more="    weight: 3\n"), INPUT, "7:3: line 'cable': too much given, expected exactly one of 'mass', 'weight', 'sections'"),
    ("no section", PLAIN, made("[]"), INPUT, "8:5: 'sections': found a list of 0, expected a list"),
    ("a section of no type", PLAIN, made("[{length: 10, elements: 2}]"), INPUT, "8:16: section: 'type' is missing: name of one of the scene's types"),
    ("an unknown type", PLAIN, made("[{type: chian, length: 10, elements: 2}]"), INPUT, "8:17: 'type': found 'chian', expected the name of one of the 2 types"),
    ("a section of no length", PLAIN, made("[{type: chain, length: 0, elements: 2}]"), INPUT, "8:30: 'length': found '0', expected a number in m, greater than 0"),
    ("a section without elements", PLAIN, made("[{type: chain, length: 10}]"), INPUT, "8:16: section: nothing given, expected exactly one of 'elements', 'element_length'"),
    ("a section of half an element", PLAIN, made("[{type: chain, length: 10, elements: 0.5}]"), INPUT, "8:42: 'elements': found '0.5', expected a whole number"),
    ("far too short elements", PLAIN, made("[{type: chain, length: 10, element_length: 1e-9}]"), LIMIT, "7:3: elements: 10000000000 elements in all lines so far"),
    ("a type that floats", PLAIN, made(chain="{mass: 1, diameter: 0.1, stiffness: 1e6}", water="water_density: 1000\n"), INPUT, "5:20: 'diameter': found 0.1 m, with which 1 kg/m float (-67.2376 N/m): expected a line that sinks"),
    ("a line that floats", PLAIN, "water_density: 1025\n" + PLAIN.replace("mass: 1", "mass: 1\n    diameter: 0.5"), INPUT, "9:5: 'diameter': found 0.5 m, with which 1 kg/m float"),
    ("a diameter beside a weight", PLAIN, made(wire="{weight: 5, diameter: 0.1, stiffness: 2e6}"), INPUT, "5:21: 'diameter': it goes with 'mass', which is not given"),
    ("a breaking load of nothing", "stiffness: 1e6", "stiffness: 1e6\n    breaking_load: 0", INPUT, "9:5: 'breaking_load': found '0', expected a number in N, greater than 0"),
    ("a breaking load that is infinite", "stiffness: 1e6", "stiffness: 1e6\n    breaking_load: .inf", INPUT, "9:5: 'breaking_load': found '.inf', expected a number in N, greater than 0"),
    ("a breaking load beside sections", PLAIN, made(more="    breaking_load: 5e6\n"), INPUT, "9:5: 'breaking_load': it does not go with 'sections'"),
    ("a type with a negative breaking load", PLAIN, made(wire="{weight: 5, stiffness: 2e6, breaking_load: -1}"), INPUT, "5:37: 'breaking_load': found '-1'"),
    ("a break_at of nothing", "stiffness: 1e6", "stiffness: 1e6\n    break_at: 0", INPUT, "9:5: 'break_at': found '0', expected a number in N, greater than 0"),
    ("a break_at that is infinite", "stiffness: 1e6", "stiffness: 1e6\n    break_at: .inf", INPUT, "9:5: 'break_at': found '.inf', expected a number in N, greater than 0"),
    ("a break_at in words", "stiffness: 1e6", "stiffness: 1e6\n    break_at: breaking_load", INPUT, "9:5: 'break_at': found 'breaking_load', expected a number in N"),
    ("a break_at beside sections", PLAIN, made(more="    break_at: 5e6\n"), INPUT, "9:5: 'break_at': it does not go with 'sections'"),
    ("a type with a negative break_at", PLAIN, made(wire="{weight: 5, stiffness: 2e6, break_at: -1}"), INPUT, "5:37: 'break_at': found '-1'"),
    ("a type without stiffness", PLAIN, made(wire="{weight: 5}"), INPUT, "5:3: type 'wire': 'stiffness' is missing"),
    ("an inextensible section", PLAIN, made(wire="{weight: 5, stiffness: .inf}"), INPUT, "8:55: line 'cable': sections: number 2 is inextensible or elastic, those before it are not"),
    ("elements and their length", "elements: 4", "elements: 4\n    element_length: 2", INPUT, "7:5: 'element_length': it does not go with 'elements': leave one of them out"),
    ("elements of no length", "elements: 4", "element_length: 0", INPUT, "6:5: 'element_length': found '0', expected a number in m, greater than 0"),
    ("elements beyond the limit by their length", "elements: 4", "element_length: 1e-90", LIMIT, "6:5: elements: 9.99999999999e+90 elements in all lines so far"),
    ("sections and a length of elements", PLAIN, made(more="    element_length: 4\n"), INPUT, "9:5: 'element_length': it does not go with 'sections'"),
    ("sections and a grade", PLAIN, made(more="    grade: {towards: A, ratio: 2}\n"), INPUT, "9:5: 'grade': it does not go with 'sections'"),
    ("a grade of a list", "elements: 4", "elements: [[4, 10]]\n    grade: {towards: A, ratio: 2}", INPUT, "7:5: 'grade': found beside a list of elements"),
    ("a grade towards nowhere", "elements: 4", "elements: 4\n    grade: {towards: C, ratio: 2}", INPUT, "7:13: 'towards': found 'C', expected one of: A B both"),
    ("a grade that grows", "elements: 4", "elements: 4\n    grade: {towards: B, ratio: 0.5}", INPUT, "7:25: 'ratio': found '0.5', expected a number, from 1 to 1000000"),
    ("a grade without a ratio", PLAIN, made("[{type: chain, length: 10, elements: 4, grade: {towards: A}}]"), INPUT, "8:55: 'grade': 'ratio' is missing"),
    ("a pretension of nothing", "stiffness: 1e6", "stiffness: 1e6\n    pretension: {end: B}", INPUT, "9:5: 'pretension': nothing given, expected exactly one of 'tension', 'horizontal'"),
    ("a pretension and a grasp", GOOD[GOOD.index("    start"):], "    pretension: {end: B, tension: 1}\n    start: static\n    ends: {A: {held: [0, 0, 0]}, B: {held: [9, 0, 0]}}\nhistory: [{name: x, cable.node: {at: 1, hold: true}}]\n", INPUT, "9:5: 'pretension': the history grasps a node of this line"),
    ("a pretension of both kinds", "stiffness: 1e6", "stiffness: 1e6\n    pretension: {end: B, tension: 1, horizontal: 1}", INPUT, "9:5: 'pretension': too much given, expected exactly one of"),
    ("a negative pretension", "stiffness: 1e6", "stiffness: 1e6\n    pretension: {end: B, tension: -1}", INPUT, "9:26: 'tension': found '-1', expected a number in N, greater than 0"),
    ("a pretension of a shape", "stiffness: 1e6", "stiffness: 1e6\n    pretension: {end: B, tension: 1}", INPUT, "9:5: line 'cable': pretension: the line starts as a shape of its length, expected a static start"),
    ("a pretension of a free end", PLAIN + "    start: " + START + "\n    ends: " + ENDS, PLAIN + "    pretension: {end: B, tension: 1}\n    start: static\n    ends: {A: {held: [0, 0, 0]}, B: free}", INPUT, "9:5: line 'cable': pretension: end B is free"),
    ("a pretension below the least", PLAIN + "    start: " + START + "\n    ends: " + ENDS, PLAIN + "    pretension: {end: B, tension: 1}\n    start: static\n    ends: {A: {held: [0, 0, 0]}, B: {held: [9, 0, 1]}}", INPUT, "9:5: line 'cable': pretension: found no length with 1 N at end B: the nearest is "),
    ("a pretension of a section that is not there", PLAIN + "    start: " + START + "\n    ends: " + ENDS, PLAIN + "    pretension: {end: B, tension: 1e3, section: 2}\n    start: static\n    ends: {A: {held: [0, 0, 0]}, B: {held: [9, 0, 1]}}", INPUT, "9:5: line 'cable': pretension: found section 2, it has 0"),
    ("a pretension of no section", PLAIN + "    start: " + START + "\n    ends: " + ENDS, made(more="    pretension: {end: B, tension: 1e3}\n    start: static\n    ends: {A: {held: [0, 0, 0]}, B: {held: [9, 0, 1]}}"), INPUT, "9:5: 'pretension': 'section' is missing: the number, from 1 to 2"),
    ("a table without tensions", "stiffness: 1e6", "stiffness: {strain: [0, 0.1]}", INPUT, "8:5: 'stiffness': 'tension' is missing"),
    ("a table of another length", "stiffness: 1e6", "stiffness: {strain: [0, 0.1, 0.2], tension: [0, 1e5]}", INPUT, "8:40: 'tension': found 2 numbers, expected as many as 'strain' has, 3"),
    ("a table with a negative strain", "stiffness: 1e6", "stiffness: {strain: [0, -0.1], tension: [0, 1e5]}", INPUT, "8:29: 'strain': found '-0.1', expected a number"),
    ("a table that does not begin at 0", "stiffness: 1e6", "stiffness: {strain: [0, 0.1], tension: [5, 1e5]}", INPUT, "8:5: line 'cable': stiffness as a table begins with 0, 5 N, expected 0, 0"),
    ("a table that becomes softer", "stiffness: 1e6", "stiffness: {strain: [0, 0.1, 0.3], tension: [0, 1e5, 2e5]}", INPUT, "8:5: line 'cable': stiffness as a table becomes softer at row 2, from 1e+06 N to 500000 N"),
    ("a table that falls", "stiffness: 1e6", "stiffness: {strain: [0, 0.1, 0.3], tension: [0, 1e5, 1e5]}", INPUT, "8:5: line 'cable': stiffness as a table goes from 0.1, 100000 N to 0.3, 100000 N in row 3"),
    ("a table of one row", PLAIN, made(wire="{weight: 5, stiffness: {strain: [0], tension: [0]}}"), INPUT, "8:55: line 'cable': sections: number 2 has a table that has 1 rows, expected 2 to 100"),
    ("a table beside inextensible sections", PLAIN, made(chain="{mass: 1, stiffness: .inf}", wire="{weight: 5, stiffness: {strain: [0, 1], tension: [0, 9]}}"), INPUT, "8:55: line 'cable': sections: number 2 is inextensible or elastic"),
    ("a dynamic stiffness of nothing", "stiffness: 1e6", "stiffness: 1e6\n    dynamic_stiffness: 0", INPUT, "9:5: 'dynamic_stiffness': found '0', expected a number in N, greater than 0"),
    ("a dynamic stiffness that is infinite", "stiffness: 1e6", "stiffness: 1e6\n    dynamic_stiffness: .inf", INPUT, "9:5: 'dynamic_stiffness': found '.inf', expected a number in N, greater than 0"),
    ("a dynamic stiffness that is softer", "stiffness: 1e6", "stiffness: 1e6\n    dynamic_stiffness: 9e5", INPUT, "9:5: line 'cable': dynamic_stiffness is softer than the static one at 2e+06 N, with the strain 2.22222 there instead of 2: expected one that is nowhere softer"),
    ("a dynamic table that becomes softer", "stiffness: 1e6", "stiffness: 1e6\n    dynamic_stiffness: {strain: [0, 0.1, 0.3], tension: [0, 1e6, 2e6]}", INPUT, "9:5: line 'cable': dynamic_stiffness as a table becomes softer at row 2, from 1e+07 N to 5e+06 N"),
    ("a dynamic table without strains", "stiffness: 1e6", "stiffness: 1e6\n    dynamic_stiffness: {tension: [0, 1e6]}", INPUT, "9:5: 'dynamic_stiffness': 'strain' is missing"),
    ("a dynamic stiffness of an inextensible line", "stiffness: 1e6", "stiffness: .inf\n    dynamic_stiffness: 1e7", INPUT, "9:5: line 'cable': dynamic_stiffness stands beside an inextensible one: give a finite one"),
    ("a type whose dynamic stiffness is softer", PLAIN, made(wire="{weight: 5, stiffness: 2e6, dynamic_stiffness: 1e6}"), INPUT, "8:55: line 'cable': sections: number 2 has a dynamic stiffness that is softer than the static one at 4e+06 N"),
    ("sections and a dynamic stiffness", PLAIN, made(more="    dynamic_stiffness: 1e7\n"), INPUT, "9:5: 'dynamic_stiffness': it does not go with 'sections'"),
    ("a stage by another stiffness", "history:\n", "history:\n  - {stiffness: slow}\n", INPUT, "12:6: 'stiffness': found 'slow', expected one of: dynamic static"),
    ("a stage by one of two stiffnesses that are not there", "history:\n", "history:\n  - {stiffness: static}\n", INPUT, "12:6: 'stiffness': found static, but no line has a 'dynamic_stiffness': leave the key out, or give one"),
    ("zones beside a type's friction", PLAIN, made(wire="{weight: 5, stiffness: 2e6, friction: 2}", more="    friction_zones: [{from: 0, to: 1, factor: 2}]\n"), INPUT, "9:5: 'friction_zones': they do not go with the type 'wire'"),
    ("water of lead", PLAIN, made(water="water_density: -1\n"), INPUT, "3:1: 'water_density': found '-1', expected a number in kg/m3, at least 0"),
    ("a clump between nodes", PLAIN, made(more="    point_weights: [{at: 5, mass: 1}]\n"), INPUT, "9:21: line 'cable': point_weights: number 1 is at 5 m, expected a node between the ends (the next one lies at 6 m)"),
    ("a clump at an end", PLAIN, made(more="    point_weights: [{at: 2, mass: 1}, {at: 10, mass: 1}]\n"), INPUT, "9:39: line 'cable': point_weights: number 2 is at 10 m, expected a node between the ends"),
    ("a clump beyond the end", PLAIN, made(more="    point_weights: [{at: 11, mass: 1}]\n"), INPUT, "9:21: line 'cable': point_weights: number 1 is at 11 m"),
    ("a clump behind the next", PLAIN, made(more="    point_weights: [{at: 6, mass: 1}, {at: 2, mass: 1}]\n"), INPUT, "9:39: line 'cable': point_weights: number 2 is at 2 m, the one before it at 6 m: give them in order from A to B"),
    ("a clump without a place", PLAIN, made(more="    point_weights: [{mass: 1}]\n"), INPUT, "9:21: point weight: 'at' is missing"),
    ("a clump of nothing", PLAIN, made(more="    point_weights: [{at: 2}]\n"), INPUT, "9:21: point weight: nothing given, expected exactly one of 'mass', 'weight'"),
    ("a buoy's volume beside a weight", PLAIN, made(more="    point_weights: [{at: 2, weight: -5, volume: 1}]\n"), INPUT, "9:41: 'volume': it goes with 'mass'"),
    # obstacles that give
    ("ground that gives under a line without a width", "friction: 0.5}}", "friction: 0.5, stiffness: 1e4}}", INPUT,
     "4:3: line 'cable': bearing_width: obstacle 'bed' gives (stiffness), so how wide the line bears on it has to be known: give its bearing_width"),
    ("a negative stiffness of the ground", "friction: 0.5}}", "friction: 0.5, stiffness: -1}}", INPUT, "2:62: 'stiffness': found '-1', expected a number in N/m3, at least 0"),
    ("a stiffness of the ground without bound", "friction: 0.5}}", "friction: 0.5, stiffness: .inf}}", INPUT, "2:62: 'stiffness': found '.inf'"),
    ("a stiffness of the ground in words", "friction: 0.5}}", "friction: 0.5, stiffness: soft}}", INPUT, "2:62: 'stiffness': found 'soft'"),
    ("a negative bearing width", "elements: 4", "bearing_width: -1", INPUT, "6:5: 'bearing_width': found '-1', expected a number in m, at least 0"),
    ("ground that gives with frozen friction", "obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}",
     "friction_policy: frozen\nobstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5, stiffness: 1e4}}", INPUT,
     "3:62: obstacle 'bed': stiffness: it gives, but friction_policy is frozen: make it consistent, or leave the stiffness out"),
    ("ground that gives with contact of the reference", "obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}",
     "contact_policy: reference\nobstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5, stiffness: 1e4}}", INPUT,
     "3:62: obstacle 'bed': stiffness: it gives, but contact_policy is reference: make it reached, or leave the stiffness out"),
    ("ground that damps and does not give", "obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}",
     "obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5, damping: 1e4}}", INPUT,
     "2:62: obstacle 'bed': damping: only an obstacle that gives has it: give its stiffness too, or leave it out"),
    ("ground whose damping is negative", "obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}",
     "obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5, stiffness: 1e4, damping: -1}}", INPUT,
     "2:78: 'damping': found '-1', expected a number in N s/m3, at least 0"),
    ("a float without volume", PLAIN, made(water=SURFACE, more="    point_weights: [{at: 4, mass: 1, floats: true}]\n"), INPUT, "11:38: 'floats': it goes with 'volume', which is not given"),
    ("a float of no volume", PLAIN, made(water=SURFACE, more="    point_weights: [{at: 4, mass: 1, volume: 0, floats: true}]\n"), INPUT, "11:49: 'floats': it displaces no water: give a 'volume'"),
    ("a float in words", PLAIN, made(water=SURFACE, more="    point_weights: [{at: 4, mass: 1, volume: 1, floats: high}]\n"), INPUT, "11:49: 'floats': found 'high', expected true or false"),
    ("a float without a surface", PLAIN, made(water="water_density: 1000\n", more=FLOAT), INPUT, "10:51: 'floats': the scene has no 'water_surface': give the height of the surface at which it floats"),
    ("a float between nodes", PLAIN, made(water=SURFACE, more=FLOAT.replace("at: 4", "at: 5")), INPUT, "11:21: line 'cable': point_weights: number 1 is at 5 m, expected a node between the ends"),
    ("a float beside springs", PLAIN, made(water=SURFACE, more=FLOAT + "    springs: [{stiffness: [1, 1, 1]}]\n"), INPUT, "12:5: 'springs': found springs to the ground, which a line with floats cannot have"),
    ("a float beside forces", PLAIN, made(water=SURFACE, more=FLOAT + "    loads: [{force: [1, 0, 0]}]\n"), INPUT, "12:5: 'loads': found given forces, which a line with floats cannot have"),
    # springs, loads, drag and current
    ("springs that are no list", "elements: 4", "springs: {stiffness: [1, 1, 1]}", INPUT, "6:5: 'springs': found a mapping, expected a list"),
    ("a spring without stiffness", "elements: 4", "springs: [{from: 0, to: 1}]", INPUT, "6:15: spring: 'stiffness' is missing"),
    ("a spring of one number", "elements: 4", "springs: [{stiffness: 3}]", INPUT, "6:16: 'stiffness': found '3', expected three numbers"),
    ("a negative stiffness", "elements: 4", "springs: [{stiffness: [1, -1, 1]}]", INPUT, "6:31: 'stiffness': found '-1'"),
    ("a coupling that pushes away", "elements: 4", "springs: [{stiffness: [1, 4, 1], coupling: [2.1, 0, 0]}]", INPUT, "6:15: line 'cable': springs: number 1 pushes away along some direction"),
    ("a coupling of three that pushes away", "elements: 4", "springs: [{stiffness: [1, 1, 1], coupling: [-0.9, 0.9, 0.9]}]", INPUT, "6:15: line 'cable': springs: number 1 pushes away along some direction"),
    ("a coupling of two numbers", "elements: 4", "springs: [{stiffness: [1, 4, 1], coupling: [2, 0]}]", INPUT, "6:38: 'coupling': found a list of 2, expected three numbers"),
    ("a coupling that is no number", "elements: 4", "springs: [{stiffness: [1, 4, 1], coupling: [.inf, 0, 0]}]", INPUT, "6:49: 'coupling': found '.inf'"),
    ("a stiffness that is no number", "elements: 4", "springs: [{stiffness: [1, .nan, 1]}]", INPUT, "6:31: 'stiffness'"),
    ("an unknown key of a spring", "elements: 4", "springs: [{stiffness: [1, 1, 1], til: 3}]", INPUT, "6:38: spring: unknown key 'til'"),
    ("a spring at a place and from another", "elements: 4", "springs: [{stiffness: [1, 1, 1], at: 3, from: 1}]", INPUT, "6:45: 'from': "),
    ("a spring beyond the line", "elements: 4", "springs: [{stiffness: [1, 1, 1], at: 11}]", INPUT, "6:15: line 'cable': springs: number 1 goes from 11 m to 11 m, expected a piece of the line's length 10 m"),
    ("springs from behind their end", "elements: 4", "springs: [{stiffness: [1, 1, 1], from: 5, to: 3}]", INPUT, "6:15: line 'cable': springs: number 1 goes from 5 m to 3 m"),
    ("a spring at a place of two numbers", "elements: 4", "springs: [{stiffness: [1, 1, 1], place: [1, 2]}]", INPUT, "6:38: 'place': found a list of 2, expected three numbers"),
    ("a load without a force", "elements: 4", "loads: [{from: 0}]", INPUT, "6:13: load: 'force' is missing"),
    ("a load of no length", "elements: 4", "loads: [{force: [0, 0, 1], from: 3, to: 3}]", INPUT, "6:13: line 'cable': loads: number 1 goes from 3 m to 3 m"),
    ("a load beyond the line", "elements: 4", "loads: [{force: [0, 0, 1], to: 12}]", INPUT, "6:13: line 'cable': loads: number 1 goes from 0 m to 12 m"),
    ("an endless load", "elements: 4", "loads: [{force: [0, 0, .inf]}]", INPUT, "6:28: 'force'"),
    ("drag without a diameter", "elements: 4", "drag: {normal: 1}", INPUT, "6:5: 'drag': 'diameter' is missing"),
    ("a negative drag", "elements: 4", "drag: {diameter: 0.1, normal: -1}", INPUT, "6:27: 'normal': found '-1', expected a number, at least 0"),
    ("a current without water", "lines:", "current: [{z: 0, velocity: [1, 0, 0]}]\nlines:", INPUT, "3:1: 'current': it goes with 'water_density', which is not given"),
    ("a current in air", "lines:", "water_density: 0\ncurrent: [{z: 0, velocity: [1, 0, 0]}]\nlines:", INPUT, "4:1: current: the water's density is 0 kg/m3"),
    ("a current from above", "lines:", "water_density: 1025\ncurrent: [{z: 0, velocity: [1, 0, 0]}, {z: -5, velocity: [0, 0, 0]}]\nlines:", INPUT, "4:40: current: row 2 has z = -5 m, after 0 m: give the rows from the lowest to the highest"),
    ("a current without rows", "lines:", "water_density: 1025\ncurrent: []\nlines:", INPUT, "4:1: 'current': found a list of 0, expected a list"),
    ("a current without a height", "lines:", "water_density: 1025\ncurrent: [{velocity: [1, 0, 0]}]\nlines:", INPUT, "4:11: row of the current: 'z' is missing"),
    # friction zones
    ("zones that are no list", "elements: 4", "friction_zones: {from: 0, to: 1, factor: 2}", INPUT, "6:5: 'friction_zones': found a mapping, expected a list"),
    ("a zone without factor", "elements: 4", "friction_zones: [{from: 0, to: 1}]", INPUT, "6:22: zone: 'factor' is missing: of the friction of whatever it touches"),
    ("unknown key of a zone", "elements: 4", "friction_zones: [{from: 0, til: 1, factor: 2}]", INPUT, "6:32: zone: unknown key 'til'"),
    ("a zone before the line", "elements: 4", "friction_zones: [{from: -1, to: 1, factor: 2}]", INPUT, "6:23: 'from': found '-1', expected a number in m, at least 0"),
    ("a negative factor", "elements: 4", "friction_zones: [{from: 0, to: 1, factor: -2}]", INPUT, "6:39: 'factor': found '-2', expected a number, at least 0"),
    ("a factor with a unit", "elements: 4", "friction_zones: [{from: 0, to: 1 m, factor: 2}]", INPUT, "6:32: 'to': found '1 m', expected a number in m, greater than 0: write the number alone"),
    ("a zone beyond the line", "elements: 4", "friction_zones: [{from: 0, to: 1, factor: 2}, {from: 9, to: 11, factor: 2}]", INPUT, "6:51: line 'cable': friction zones: number 2 goes from 9 m to 11 m, expected one that begins at 1 m or after"),
    ("zones that overlap", "elements: 4", "friction_zones: [{from: 0, to: 5, factor: 2}, {from: 4, to: 6, factor: 2}]", INPUT, "6:51: line 'cable': friction zones: number 2 goes from 4 m to 6 m, expected one that begins at 5 m"),
    ("a zone of no length", "elements: 4", "friction_zones: [{from: 3, to: 3, factor: 2}]", INPUT, "6:22: line 'cable': friction zones: number 1 goes from 3 m to 3 m"),
    # shapes and ends
    ("start too short", "to: [10, 0, 0]", "to: [9, 0, 0]", INPUT, "9:5: line 'cable': start is 9 m long, shorter than the line's length 10 m"),
    ("start too long", "to: [10, 0, 0]", "to: [20.1, 0, 0]", INPUT, "9:5: line 'cable': start is 20.1 m long, more than twice the line's length 10 m"),
    ("start below the bed", "to: [10, 0, 0]", "to: [9, 0, -5]", INPUT, "9:5: line 'cable': start: node 1 lies 1.25 m below obstacle 'bed'"),
    ("arc without radius", START, "{arc: {from: [0, 0, 5], centre: [0, 0, 0]}}", INPUT, "9:5: line 'cable': start: the arc's first point lies on its axis"),
    ("arc without axis", START, "{arc: {from: [0, 0, 0], centre: [0, 5, 0], axis: [0, 0, 0]}}", INPUT, "9:55: line 'cable': start: arc axis is (0, 0, 0)"),
    ("elements too long for the arc", "elements: 4\n    mass: 1\n    stiffness: 1e6\n    start: " + START, "elements: 1\n    mass: 1\n    stiffness: 1e6\n    start: {arc: {from: [0, 0, 0], centre: [0, 2, 0]}}", INPUT, "9:5: line 'cable': start: an element is 10 m long, longer than the arc's diameter 4 m"),
    ("end beside the start", ENDS, "{A: {held: [0, 0, 1]}, B: free}", INPUT, "10:12: line 'cable': ends: end A is held at (0, 0, 1) m, but the start puts it at (0, 0, 0) m"),
    ("end below the bed", ENDS, "{A: {held: [0, 0, -1]}, B: free}", INPUT, "10:12: line 'cable': ends: end A is 1 m below obstacle 'bed'"),
    ("static without a position", START + "\n    ends: " + ENDS, "static\n    ends: " + ENDS, INPUT, "10:12: line 'cable': ends: end A has no position, and a static start gives none"),
    ("static with free ends", START + "\n    ends: " + ENDS, "static\n    ends: {A: free, B: free}", INPUT, "10:5: line 'cable': ends: both are free, but a static start needs a held one"),
    ("an end held and pulled", ENDS, "{A: {held: [0, 0, 0], force: [0, 0, 0]}, B: free}", INPUT, "10:12: 'A': too much given, expected exactly one of 'held', 'force'"),
    ("moved below the bed", "{force: [1, 0, 0]}", "{position: [9, 0, -1]}", INPUT, "12:18: stage 1: cable.B is moved to 1 m below obstacle 'bed'"),
    ("a node of no line", "cable.B: {force", "cabel.node: {at: 5, force", INPUT, "12:18: 'cabel.node': there is no such line; did you mean 'cable.node'?"),
    ("a node nowhere", "cable.B: {force", "cable.node: {force", INPUT, "12:18: 'cable.node': 'at' is missing"),
    ("a node beyond the line", "cable.B: {force", "cable.node: {at: 11, force", INPUT,
     "12:31: 'cable.node': found at 11 m, expected a length up to that of the line, 10 m"),
    ("a node before the line", "cable.B: {force", "cable.node: {at: -1, force", INPUT, "12:31: 'at': found '-1', expected a number in m, at least 0"),
    ("a node held and pulled", "cable.B: {force", "cable.node: {at: 5, hold: true, force", INPUT, "12:18: 'cable.node': too much given, expected exactly one of 'position'"),
    ("a node neither held nor pulled", "cable.B: {force: [1, 0, 0]}", "cable.node: {at: 5}", INPUT, "12:18: 'cable.node': nothing given, expected exactly one of 'position'"),
    ("a node not let go", "cable.B: {force: [1, 0, 0]}", "cable.node: {at: 5, release: false}", INPUT, "12:18: 'cable.node': found false, expected true"),
    ("a node below the bed", "cable.B: {force: [1, 0, 0]}", "cable.node: {at: 5, position: [5, 0, -1]}", INPUT,
     "12:18: stage 1: node 2 of line 'cable' is moved to 1 m below obstacle 'bed'"),
    ("a node twice", "cable.B: {force: [1, 0, 0]}", "cable.node: {at: 5, hold: true}, cable.node2: {at: 5.1, hold: true}", INPUT,
     "12:18: stage 1: node 2 of line 'cable' is changed twice"),
    ("move of a free end", "{force: [1, 0, 0]}", "{move: [1, 0, 0]}", INPUT, "12:28: 'cable.B': found a move, but the end's position before it is not known"),
    # obstacles
    ("obstacle without a surface", "plane: {normal: [0, 0, 1]}, ", "", INPUT, "2:13: obstacle 'bed': nothing given, expected exactly one of 'plane', 'cylinder', 'sphere'"),
    ("two surfaces", "{bed: {", "{bed: {sphere: {radius: 1}, ", INPUT, "2:13: obstacle 'bed': too much given, expected exactly one of 'plane', 'cylinder', 'sphere'"),
    ("cylinder without radius", "{plane: {normal: [0, 0, 1]}", "{cylinder: {axis: [0, 0, 1]}", INPUT, "2:19: 'cylinder': 'radius' is missing: [m] radius of the cylinder"),
    ("ball without size", "{plane: {normal: [0, 0, 1]}", "{sphere: {radius: 0}", INPUT, "2:28: 'radius': found '0', expected a number in m, greater than 0"),
    ("ball with a point", "{plane: {normal: [0, 0, 1]}", "{sphere: {point: [0, 0, 1], radius: 1}", INPUT, "2:28: 'sphere': unknown key 'point'"),
    ("cylinder misspelt", "{plane: {normal: [0, 0, 1]}", "{cilinder: {radius: 1}", INPUT, "2:19: obstacle 'bed': unknown key 'cilinder'; did you mean 'cylinder'?"),
    ("zero axis", "{plane: {normal: [0, 0, 1]}", "{cylinder: {point: [0, 0, -5], axis: [0, 0, 0], radius: 1}", INPUT, "2:49: obstacle 'bed': axis is (0, 0, 0), expected a direction"),
    ("line in the cylinder", "{plane: {normal: [0, 0, 1]}", "{cylinder: {radius: 1}", INPUT, "9:5: line 'cable': start: node 0 lies 1 m below obstacle 'bed'"),
    ("second obstacle in the way", "friction: 0.5}}", "friction: 0.5}, ball: {sphere: {centre: [5, 0, 0], radius: 1}}}", INPUT, "9:5: line 'cable': start: node 2 lies 1 m below obstacle 'ball'"),
    ("friction as a list", "friction: 0.5", "friction: [0.5, 0.6]", INPUT, "2:47: 'friction': found a list of 2, expected a number, at least 0, or a mapping with axial, set, lateral, shape, grain"),
    ("friction without axial", "friction: 0.5", "friction: {lateral: 0.5}", INPUT, "2:47: 'friction': nothing given, expected exactly one of 'axial', 'set'"),
    ("negative lateral friction", "friction: 0.5", "friction: {axial: 0.5, lateral: -1}", INPUT, "2:70: 'lateral': found '-1', expected a number, at least 0"),
    ("a set and a coefficient", "friction: 0.5", "friction: {axial: 0.5, set: {disc: 0.5}}", INPUT, "2:47: 'friction': too much given, expected exactly one of 'axial', 'set'"),
    ("a set and a lateral coefficient", "friction: 0.5", "friction: {set: {disc: 0.5}, lateral: 0.3}", INPUT, "2:76: 'lateral': it goes with 'axial', which is not given"),
    ("a set and a shape", "friction: 0.5", "friction: {set: {disc: 0.5}, shape: box}", INPUT, "2:76: 'shape': it goes with 'axial', which is not given"),
    ("a number for a set", "friction: 0.5", "friction: {set: 0.5}", INPUT, "2:58: 'set': found '0.5', expected one word with its value, as in {disc: 500}"),
    ("nothing for a set", "friction: 0.5", "friction: {set: }", INPUT, "2:58: 'set': found nothing, expected one word with its value"),
    ("two words for a set", "friction: 0.5", "friction: {set: {disc: 1, box: [1, 1]}}", INPUT, "2:58: 'set': found a mapping, expected one word"),
    ("unknown word of a set", "friction: 0.5", "friction: {set: {disk: 0.5}}", INPUT, "2:64: unknown word 'disk'; did you mean 'disc'?"),
    ("negative radius of a set", "friction: 0.5", "friction: {set: {disc: -0.5}}", INPUT, "2:64: 'disc': found '-0.5', expected a number, at least 0"),
    ("a set of one component", "friction: 0.5", "friction: {set: {interval: 0.5}}", INPUT, "2:58: obstacle 'bed': friction set: it lies in R^1, expected the plane R^2"),
    ("a set of three components", "friction: 0.5", "friction: {set: {box: [1, 1, 1]}}", INPUT, "2:58: obstacle 'bed': friction set: it lies in R^3, expected the plane R^2"),
    ("a set without 0", "friction: 0.5", "friction: {set: {box: [[0.1, 0.5], 0.5]}}", INPUT, "2:58: obstacle 'bed': friction set: it does not contain 0"),
    ("an unbounded set", "friction: 0.5", "friction: {set: {strip: {normal: [0, 1], width: 1}}}", INPUT, "2:58: obstacle 'bed': friction set: it is unbounded, expected a bounded one"),
    ("an empty set", "friction: 0.5", "friction: {set: {intersection: [{point: [0, 0]}, {point: [1, 0]}]}}", INPUT, "2:58: obstacle 'bed': friction set: the set is empty"),
    ("sets within one another, too large", "friction: 0.5", "friction: {set: {hull: [{polytope: [" + ", ".join(f"[{i}, {i * i}]" for i in range(-150, 151)) + "]}, {disc: 1}]}}", LIMIT, "2:72: 'polytope': the sets up to here that are not answered in closed form have"),
    ("components of a set", "friction: 0.5", "friction: {set: {preimage: {map: [[1, 0], [0, 1]], of: {interval: 1}}}}", INPUT, "2:75: 'map': found 2 rows, expected 1, as many as its set has components"),
    ("grain of a set", "friction: 0.5", "friction: {set: {disc: 1}, grain: [1, 0]}", INPUT, "2:74: 'grain': found a list of 2, expected three numbers"),
    ("unknown friction shape", "friction: 0.5", "friction: {axial: 0.5, shape: disc}", INPUT, "2:70: 'shape': found 'disc', expected one of: ellipse box"),
    ("grain too small", "friction: 0.5", "friction: {axial: 0.5, grain: [0, 0, 1e-200]}", INPUT, "2:70: obstacle 'bed': friction: grain is (0, 0, 1e-200), expected a direction"),
    ("a plane that turns", "name: pull,", "bed.turn: 90,", INPUT, "12:6: stage 1: obstacle 'bed' is a plane: only a round obstacle turns"),
    ("turn in words", "name: pull,", "bed.turn: half,", INPUT, "12:6: 'bed.turn': found 'half', expected a number in degrees"),
    ("turn of nothing", "name: pull,", "bad.turn: 90,", INPUT, "12:6: 'bad.turn': there is no such obstacle; did you mean 'bed.turn'?"),
    ("turn of a line", "name: pull,", "cable.turn: 90,", INPUT, "12:6: 'cable.turn': there is no such obstacle under 'obstacles'"),
    ("no lines", GOOD[GOOD.index("lines:"):], "lines: {}\n", INPUT, "3:1: lines: found 0, expected at least one"),
    # YAML
    ("anchor", "length: 10", "length: &l 10", INPUT, "5:14: found an anchor"),
    ("alias", "length: 10", "length: *l", INPUT, "5:14: found an alias"),
    ("merge key", "length: 10", "<<: {length: 10}", INPUT, "5:5: line 'cable': unknown key '<<'"),
    ("tag", "length: 10", "length: !!float 10", INPUT, "5:13: found a tag"),
    ("second document", "history:", "---\nhistory:", INPUT, "11:1: found a second document"),
    ("tab as indentation", "    mass: 1", "\tmass: 1", INPUT, "7:2: not valid YAML"),
    ("bad indentation", "    mass: 1", "   mass: 1", INPUT, "7:4: not valid YAML"),
    ("bracket not closed", "to: [10, 0, 0]}}", "to: [10, 0, 0", INPUT, "11:1: not valid YAML"),
    ("escape in a text", "capstan: 1", "capstan: 1\ntitle: \"\\e[31mred\"", INPUT, "2:8: found a text with a line break, a tab or a control character"),
    ("text of two lines", "capstan: 1", "capstan: 1\ntitle: |\n  a\n  b", INPUT, "3:1: found a text with a line break"),
    ("two apostrophes", "capstan: 1", "capstan: 1\ntitle: 'it''''s'", INPUT, "2:8: found two apostrophes in a row in single quotes: write"),
    ("two apostrophes behind other letters", "capstan: 1", "capstan: 1\ntitle: '\u00e9\u20ac it''''s'", INPUT, "2:8: found two apostrophes"),
    ("apostrophes alone", "capstan: 1", "capstan: 1\ntitle: " + "'" * 46, INPUT, "2:8: found two apostrophes"),
    ("text too long", "capstan: 1", "capstan: 1\ntitle: " + "x" * 70000, LIMIT, "2:8: a text of 70000 bytes, the limit is 65536"),
]

# name, contents, exit code, expected after "FILE:"
FILES = [
    ("empty", b"", INPUT, "1:1: found an empty file"),
    ("weight without gravity", GOOD.replace("lines:", "gravity: [0, 0, 0]\nlines:").replace("mass:", "weight:").encode(), INPUT,
     "8:5: line 'cable': weight is 1 N/m, but gravity is zero and has no direction"),
    ("gravity that begins with none", GOOD.replace("lines:", "gravity: [0, 0, 0]\nlines:").replace("{name: pull,", "{gravity: [0, 0, -9],").encode(), INPUT,
     "13:6: stage 1: gravity changes, but that of the scene is zero, so that nothing has a mass: give the scene a gravity"),
    ("inextensible and stretched", GOOD.replace("1e6", ".inf").replace("[10, 0, 0]", "[10.1, 0, 0]").encode(), INPUT,
     "9:5: line 'cable': start is 10.1 m long, longer than the inextensible line's length 10 m"),
    ("two lines beyond the limit", GOOD.replace("history:", "  other: {length: 10, elements: 9999999, mass: 0, stiffness: 1, "
     "start: " + START + ", ends: " + ENDS + "}\nhistory:").encode(), LIMIT, "11:23: elements: 10000003 elements in all lines"),
    ("bad name", GOOD.replace("cable", "the cable").encode(), INPUT,
     "4:3: line 1: its name is 'the cable', expected a letter followed by"),
    ("name that is a formula", GOOD.replace("cable", "=cable").encode(), INPUT, "4:3: line 1: its name is '=cable'"),
    ("name of 65 letters", GOOD.replace("cable", "c" * 65).encode(), INPUT, "4:3: line 1: its name is 'ccc"),
    ("only a comment", b"# nothing here\n", INPUT, "1:1: found nothing"),
    ("a word", b"hello\n", INPUT, "1:1: scene: found 'hello', expected a mapping with capstan, title"),
    ("a list", b"- capstan: 1\n", INPUT, "1:1: scene: found a list of 1, expected a mapping"),
    ("not UTF-8", b"capstan: 1\ntitle: caf\xe9 noir\n", INPUT, "2:11: found byte 0xe9, which is not UTF-8"),
    ("overlong UTF-8", b"title: \xc0\xaf\n", INPUT, "1:8: found byte 0xc0, which is not UTF-8"),
    ("UTF-16", "capstan: 1\n".encode("utf-16-le"), INPUT, "1:2: found a control character (byte 0x00)"),
    ("an executable", b"\x7fELF\x02\x01\x01\x00", INPUT, "1:1: found a control character (byte 0x7f)"),
    ("deep nesting", b"title: " + b"[" * 100000, LIMIT, "1:71: mappings and lists are nested deeper than 64, the limit"),
    ("deep nesting of mappings", b"".join(b" " * i + b"a:\n" for i in range(100)), LIMIT, "65:65: mappings and lists are nested deeper than 64"),
    ("a bomb", b"a: &a [x, x]\nb: &b [*a, *a]\nc: &c [*b, *b]\n", INPUT, "1:"),
    ("a long key cut within a character", ("a" + "\u00e9" * 70 + ": 1\n").encode(), INPUT,
     "1:1: scene: unknown key 'a" + "\u00e9" * 31 + "?', expected"),
    ("too many values", b"title: [" + b"1," * 4100000 + b"]\n", LIMIT, "1:"),
    ("a huge file", None, LIMIT, " is larger than 67108864 bytes, the limit"),
]


# arguments, exit code, expected on standard error (one line, or the first of two)
USAGE = [
    (["check"], "capstan check: no file given"),
    (["check", "a", "b"], "capstan check: unexpected 'b'"),
    (["check", "--jsn", "a"], "capstan check: unknown option '--jsn'"),
    (["check", "--hlep"], "capstan check: unknown option '--hlep'; did you mean '--help'?"),
    (["check", "-x"], "capstan check: unknown option '-x'"),
    (["check", "--help=5"], "capstan check: '--help=5': option '--help' takes no argument"),
    (["chek", "a"], "capstan: unknown command 'chek'; did you mean 'check'?"),
    (["schema", "a"], "capstan schema: found 'a', expected scene, law or drive"),
    (["--verzion"], "capstan: unknown option '--verzion'; did you mean '--version'?"),
]


def run(capstan, arguments, **options):
    done = subprocess.run([capstan, *arguments], stdout=options.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE,
                          timeout=60, **options)
    return done.returncode, (done.stdout or b"").decode(), done.stderr.decode()


class Suite:
    def __init__(self, capstan, folder):
        self.capstan, self.folder, self.count, self.failed = capstan, folder, 0, 0

    def expect(self, name, result, code, wanted, lines=1):
        """result: exit code, standard output (must be empty), standard error (begins with `wanted`, at most `lines` lines)"""
        self.count += 1
        got, out, err = result
        whole_lines = err.endswith("\n") and err.count("\n") <= lines
        if not (got == code and out == "" and whole_lines and err.startswith(wanted)):
            self.failed += 1
            print(f"FAILED {name}\n  expected exit {code}: {wanted}\n  found    exit {got}: {err}{out}")

    def scene(self, name, contents, code, fragment):
        path = os.path.join(self.folder, "scene.yaml")
        with open(path, "wb") as f:
            if contents is None:
                f.truncate((64 << 20) + 1)
            else:
                f.write(contents)
        self.expect(name, run(self.capstan, ["check", path]), code, f"capstan: {path}:{fragment}")

    def unreadable(self):
        """files that are no scene file at all, and standard input and output"""
        def path_case(name, path, code, message):
            self.expect(name, run(self.capstan, ["check", path]), code, f"capstan: {path}: {message}")

        missing = os.path.join(self.folder, "missing.yaml")
        path_case("no file", missing, IO, "cannot open: No such file or directory")
        path_case("a directory", self.folder, IO, "is a directory, expected a file")
        path_case("a device", "/dev/zero", IO, "is not a regular file; '-' reads standard input")
        path_case("a long name", "x" * 300, IO, "cannot open: File name too long")
        fifo = os.path.join(self.folder, "fifo")
        os.mkfifo(fifo)
        path_case("a FIFO without a writer", fifo, IO, "is not a regular file")
        secret = os.path.join(self.folder, "secret.yaml")
        with open(secret, "w") as f:
            f.write(GOOD)
        os.chmod(secret, 0)
        if os.geteuid() != 0:  # root may read everything
            path_case("no permission", secret, IO, "cannot open: Permission denied")
        self.expect("bad standard input", run(self.capstan, ["check", "-"], input=b"capstan: 2\n"), INPUT,
                    "capstan: standard input:1:1: 'capstan': found '2'")
        self.expect("endless standard input", run(self.capstan, ["check", "-"], stdin=open("/dev/zero", "rb")), LIMIT,
                    "capstan: standard input: is larger than 67108864 bytes, the limit")
        self.expect("a directory as standard input", run(self.capstan, ["check", "-"], stdin=os.open(self.folder, os.O_RDONLY)),
                    IO, "capstan: standard input: cannot read: Is a directory")
        with open("/dev/full", "wb") as full:
            for command in ["schema", "--help"]:
                self.expect(f"full disk, {command}", run(self.capstan, [command], stdout=full), IO, "capstan: ", lines=2)

    def usage(self):
        for arguments, wanted in USAGE:
            self.expect(" ".join(arguments), run(self.capstan, arguments), 2, wanted, lines=2)

    def good(self):
        """the scene that all changes start from must itself be accepted"""
        self.count += 1
        code, out, err = run(self.capstan, ["check", "-"], input=GOOD.encode())
        if code != 0 or err or "The scene is valid." not in out:
            self.failed += 1
            print(f"FAILED the good scene: exit {code}: {err}")


def write(folder):
    cases = [GOOD.replace(old, new).encode() for _, old, new, _, _ in CHANGES] + [contents for _, contents, _, _ in FILES if contents]
    for i, contents in enumerate(cases):
        if len(contents) < 1 << 16:
            with open(os.path.join(folder, f"bad-{i}.yaml"), "wb") as file:
                file.write(contents)


def main():
    if sys.argv[1] == "--write":
        return write(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        suite = Suite(sys.argv[1], folder)
        suite.good()
        for name, old, new, code, fragment in CHANGES:
            assert GOOD.count(old) == 1, name
            suite.scene(name, GOOD.replace(old, new).encode(), code, fragment)
        for case in FILES:
            suite.scene(*case)
        suite.unreadable()
        suite.usage()
        print(f"{suite.count} cases, {suite.failed} failed")
        return 0 if is_told(suite.count) and not suite.failed else 1


if __name__ == "__main__":
    sys.exit(main())
