#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bad scenes with steps in time: each must be refused with its exit code, its place (file:line:column) and its message.

usage: bad_motions.py CAPSTAN

Every case is one change to one of two good scenes. Expected is the exit code and what follows the file name in the message; standard error must be one
line, and standard output empty.
"""
import os
import subprocess
import sys
import tempfile

from checks import is_told

INPUT, LIMIT = 3, 6
GOOD = """\
capstan: 1
obstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}
lines:
  cable:
    length: 10
    elements: 4
    mass: 1
    stiffness: 1e6
    start: {straight: {from: [0, 0, 1], to: [10, 0, 1]}}
    ends: {A: held, B: held}
history:
  - {name: swing, duration: 2, time_step: 0.01, cable.B: {move: [0, 0, 0], sine: [0, 0, 0.5], period: 2}}
"""
ENTRY = "duration: 2, time_step: 0.01"
CHANGE = "{move: [0, 0, 0], sine: [0, 0, 0.5], period: 2}"
# name, what is replaced in GOOD, by what, exit code, expected after "FILE:"
CHANGES = [
    ("no duration", "duration: 2", "duration: 0", INPUT, "12:19: 'duration': found '0', expected a number in s, greater than 0"),
    ("negative duration", "duration: 2", "duration: -2", INPUT, "12:19: 'duration': found '-2', expected a number in s, greater than 0"),
    ("endless duration", "duration: 2", "duration: .inf", INPUT, "12:19: 'duration': found '.inf', expected a number in s"),
    ("NaN", "duration: 2", "duration: .nan", INPUT, "12:19: 'duration': found '.nan', expected a number in s"),
    ("a unit", "duration: 2", "duration: 2 s", INPUT, "12:19: 'duration': found '2 s', expected a number in s, greater than 0: write the number alone"),
    ("a word", "duration: 2", "duration: long", INPUT, "12:19: 'duration': found 'long', expected a number in s"),
    ("no step", "time_step: 0.01", "time_step: 0", INPUT, "12:32: 'time_step': found '0', expected a number in s, greater than 0"),
    ("negative step", "time_step: 0.01", "time_step: -0.01", INPUT, "12:32: 'time_step': found '-0.01', expected a number in s, greater than 0"),
    ("step and steps", ENTRY, ENTRY + ", steps: 3", INPUT, "12:32: 'time_step': it does not go with 'steps': leave one of them out"),
    ("step without a duration", "duration: 2, ", "", INPUT, "12:19: 'time_step': it goes with 'duration', which is not given"),
    ("too many steps", "time_step: 0.01", "time_step: 1e-9", LIMIT, "12:32: 'time_step': 2000000000 steps of 1e-09 s, the limit is"),
    ("steps of no length", "duration: 2, time_step: 0.01", "duration: 1e-90, steps: 3", INPUT, "12:19: stage 1: duration is 1e-90 s"),
    ("no error", ENTRY, ENTRY + ", error: 0", INPUT, "12:49: 'error': found '0', expected a number in m, greater than 0"),
    ("negative error", ENTRY, ENTRY + ", error: -1e-3", INPUT, "12:49: 'error': found '-1e-3', expected a number in m, greater than 0"),
    ("any error", ENTRY, ENTRY + ", error: .inf", INPUT, "12:49: 'error': found '.inf', expected a number in m"),
    ("an error that is no number", ENTRY, ENTRY + ", error: .nan", INPUT, "12:49: 'error': found '.nan', expected a number in m"),
    ("an error as a word", ENTRY, ENTRY + ", error: small", INPUT, "12:49: 'error': found 'small', expected a number in m"),
    ("an error too small to square", ENTRY, ENTRY + ", error: 1e-200", INPUT, "12:49: stage 1: error is 1e-200 m"),
    ("an error without a longest step", ENTRY, "duration: 2, error: 1e-3", INPUT, "12:32: 'error': it goes with 'time_step', which is not given"),
    ("an error of equal steps", ENTRY, "duration: 2, steps: 3, error: 1e-3", INPUT, "12:42: 'error': it goes with 'time_step', which is not given"),
    ("misspelt error", ENTRY, ENTRY + ", eror: 1e-3", INPUT, "12:49: entry: unknown key 'eror'; did you mean 'error'?"),
    ("misspelt duration", "duration:", "duratoin:", INPUT, "12:19: entry: unknown key 'duratoin'; did you mean 'duration'?"),
    ("misspelt step", "time_step:", "timestep:", INPUT, "12:32: entry: unknown key 'timestep'; did you mean 'time_step'?"),
    ("misspelt sine", "sine:", "sin:", INPUT, "12:76: 'cable.B': unknown key 'sin'; did you mean 'sine'?"),
    ("sine without a period", ", period: 2", "", INPUT, "12:76: 'sine': it goes with 'period', which is not given"),
    ("cosine without a period", "sine: [0, 0, 0.5], period: 2", "cosine: [0, 0, 0.5]", INPUT, "12:76: 'cosine': it goes with 'period', which is not given"),
    ("a period of nothing", "sine: [0, 0, 0.5], ", "", INPUT, "12:76: 'period': nothing oscillates, expected 'sine' or 'cosine' beside it"),
    ("period 0", "period: 2", "period: 0", INPUT, "12:95: 'period': found '0', expected a number in s, greater than 0"),
    ("negative period", "period: 2", "period: -2", INPUT, "12:95: 'period': found '-2', expected a number in s, greater than 0"),
    ("two components", "[0, 0, 0.5]", "[0, 0.5]", INPUT, "12:76: 'sine': found a list of 2, expected three numbers"),
    ("text in a sine", "[0, 0, 0.5]", "[0, 0, up]", INPUT, "12:89: 'sine': found 'up', expected a number"),
    ("nothing beside a sine", "move: [0, 0, 0], ", "", INPUT, "12:49: 'cable.B': nothing given, expected exactly one of 'position', 'move', 'force', 'release'"),
    ("an oscillation of what is let go", "move: [0, 0, 0]", "release: true", INPUT, "12:93: 'period': found beside 'release': what is let go does not oscillate"),
    ("an oscillation without time", ENTRY, "steps: 3", INPUT, "12:29: stage 1: cable.B oscillates in time, but the stage has no duration"),
    ("negative inertia", "mass: 1", "mass: 1\n    inertia: -1", INPUT, "8:5: 'inertia': found '-1', expected a number in kg/m, at least 0"),
    ("endless inertia", "mass: 1", "mass: 1\n    inertia: .inf", INPUT, "8:5: 'inertia': found '.inf', expected a number in kg/m"),
    ("no inertia", "mass: 1", "weight: 10", INPUT, "4:3: line 'cable': inertia: a step of the history has a duration, but the line has no mass to move: give its mass"),
    ("an inertia of 0", "mass: 1", "mass: 1\n    inertia: 0", INPUT, "8:5: line 'cable': inertia: a step of the history has a duration, but the line has no mass to move"),
    ("a massless line", "mass: 1", "mass: 0", INPUT, "4:3: line 'cable': inertia: a step of the history has a duration"),
    ("velocity of two components", "mass: 1", "mass: 1\n    velocity: [1, 2]", INPUT, "8:5: 'velocity': found a list of 2, expected three numbers in m/s"),
    ("NaN in a velocity", "mass: 1", "mass: 1\n    velocity: [1, 2, .nan]", INPUT, "8:22: 'velocity': found '.nan', expected a number in m/s"),
    ("frozen friction", "capstan: 1\n", "capstan: 1\nfriction_policy: frozen\n", INPUT, "2:1: friction_policy: a step of the history has a duration, which needs consistent friction"),
    ("contact of the reference", "capstan: 1\n", "capstan: 1\ncontact_policy: reference\n", INPUT, "2:1: contact_policy: a step of the history has a duration, which needs contact that is reached"),
    ("an unknown scheme", "capstan: 1\n", "capstan: 1\ntime_scheme: newmark\n", INPUT, "2:1: 'time_scheme': found 'newmark', expected one of: bdf2 euler"),
    ("a line that parts", "mass: 1", "mass: 1\n    break_at: 1e5", INPUT, "8:5: line 'cable': break_at: lines do not part in a history of which a step has a duration"),
    ("a negative damping", "mass: 1", "mass: 1\n    damping: -1", INPUT, "8:5: 'damping': found '-1', expected a number in N s, at least 0"),
    ("an endless damping", "mass: 1", "mass: 1\n    damping: .inf", INPUT, "8:5: 'damping': found '.inf', expected a number in N s"),
    ("a damping in words", "mass: 1", "mass: 1\n    damping: much", INPUT, "8:5: 'damping': found 'much', expected a number in N s"),
    ("damping of an inextensible line", "stiffness: 1e6", "stiffness: .inf\n    damping: 3", INPUT, "9:5: line 'cable': damping: it goes with a stiffness that is one number, not with an inextensible line: leave either out"),
    ("damping beside a table", "stiffness: 1e6", "stiffness: {strain: [0, 0.01, 0.02], tension: [0, 1e4, 3e4]}\n    damping: 3", INPUT, "9:5: line 'cable': damping: it goes with a stiffness that is one number, not with a table of strains and tensions: leave either out"),
    ("damping beside a dynamic stiffness", "stiffness: 1e6", "stiffness: 1e6\n    dynamic_stiffness: 2e6\n    damping: 3", INPUT, "10:5: line 'cable': damping: it goes with a stiffness that is one number, not with a dynamic stiffness: leave either out"),
    ("springs", "mass: 1", "mass: 1\n    springs: [{stiffness: [1, 1, 1], place: [0, 0, 0]}]", INPUT, "8:5: line 'cable': springs are those of lines at rest: make it quasi_static, or leave them or the motion in time out"),
    ("drag of a quasi-static line without water", "mass: 1", "mass: 1\n    quasi_static: true\n    drag: {diameter: 0.1, normal: 1}", INPUT, "9:5: line 'cable': drag: a step of the history has a duration, and there is no water that the line could move in: give water_density"),
    ("drag without water", "mass: 1", "mass: 1\n    drag: {diameter: 0.1, normal: 1}", INPUT, "8:5: line 'cable': drag: a step of the history has a duration, and there is no water that the line could move in: give water_density"),
    ("a negative added mass", "mass: 1", "mass: 1\n    drag: {diameter: 0.1, normal: 1, added_normal: -1}", INPUT, "8:38: 'added_normal': found '-1', expected a number, at least 0"),
    ("NaN in an added mass", "mass: 1", "mass: 1\n    drag: {diameter: 0.1, normal: 1, added_tangential: .nan}", INPUT, "8:38: 'added_tangential': found '.nan', expected a number"),
    ("an added mass in words", "mass: 1", "mass: 1\n    drag: {diameter: 0.1, normal: 1, added_normal: all}", INPUT, "8:38: 'added_normal': found 'all', expected a number"),
    ("a misspelt added mass", "mass: 1", "mass: 1\n    drag: {diameter: 0.1, normal: 1, added_norml: 1}", INPUT, "8:38: 'drag': unknown key 'added_norml'; did you mean 'added_normal'?"),
    ("a winch", "B: held}", "B: {held: [10, 0, 1], stored: 0}}", INPUT, "10:5: line 'cable': stored: winches do not wind in a history of which a step has a duration: leave it out"),
]
IN_WAVES = """\
capstan: 1
water_density: 1025
water_surface: 2
waves:
  depth: 20
  ramp: 3
  components:
    - {amplitude: 1, period: 9, direction: 0}
    - {amplitude: 0.5, period: 6, direction: 30, phase: 40}
bodies:
  hull: {free: [9, 5, 0], mass: 200, moments_of_inertia: [9, 9, 9], excitation: [{frequency: 0.2, direction: 390, amplitude: [1, 1, 1, 0, 0, 0]}, {frequency: 0.15, direction: 390, amplitude: [1, 2, 1, 0, 0, 0]}, {frequency: 0.11111111111111, direction: 360, amplitude: [1, 0, 1, 0, 1, 0], phase: [90, 0, 0, 0, -90, 0]}], members: [{from: [0, 0, -1], to: [0, 0, 1], diameter: 0.5, normal: 1}]}
points:
  knot: {free: [9, 0, 0], mass: 5, force: [0, 0, 100]}
  eye: {body: hull, at: [0, 0, 0]}
lines:
  leash: {length: 9, elements: 4, mass: 1, stiffness: 1e6, start: {straight: {from: [0, 5, 0], to: [9, 5, 0]}}, ends: {A: held, B: {point: eye}}}
  cable: {length: 9, elements: 4, mass: 1, stiffness: 1e6, start: {straight: {from: [0, 0, 0], to: [9, 0, 0]}}, drag: {diameter: 0.1, normal: 1}, ends: {A: held, B: {point: knot}}}
history:
  - {name: swing, duration: 2, time_step: 0.01}
"""
ONE, TWO = "{amplitude: 1, period: 9, direction: 0}", "{amplitude: 0.5, period: 6, direction: 30, phase: 40}"
NEEDED = "waves: they are those of a surface, which the water has not: give water_surface"
MEMBER = "members: [{from: [0, 0, -1], to: [0, 0, 1], diameter: 0.5, normal: 1}]"
WAVE_CHANGES = [
    ("waves without depth", "  depth: 20\n", "", INPUT, "4:1: 'waves': 'depth' is missing: [m] of the water below water_surface; .inf: deep water"),
    ("depth 0", "depth: 20", "depth: 0", INPUT, "5:3: 'depth': found '0', expected a number in m, greater than 0, or .inf"),
    ("a depth below the surface", "depth: 20", "depth: -20", INPUT, "5:3: 'depth': found '-20', expected a number in m, greater than 0, or .inf"),
    ("NaN in a depth", "depth: 20", "depth: .nan", INPUT, "5:3: 'depth': found '.nan', expected a number in m"),
    ("a depth in words", "depth: 20", "depth: deep", INPUT, "5:3: 'depth': found 'deep', expected a number in m"),
    ("waves without a surface", "water_surface: 2\n", "", INPUT, "3:1: 'waves': it goes with 'water_surface', which is not given"),
    ("waves without components", "  components:\n    - " + ONE + "\n    - " + TWO + "\n", "", INPUT, "4:1: 'waves': 'components' is missing"),
    ("no component", "  components:\n    - " + ONE + "\n    - " + TWO + "\n", "  components: []\n", INPUT, "7:3: 'components': found a list of 0, expected a list"),
    ("a component in words", ONE, "high", INPUT, "8:7: component: found 'high', expected a mapping with amplitude"),
    ("a negative ramp", "ramp: 3", "ramp: -3", INPUT, "6:3: 'ramp': found '-3', expected a number in s, at least 0"),
    ("a ramp without end", "ramp: 3", "ramp: .inf", INPUT, "6:3: 'ramp': found '.inf', expected a number in s"),
    ("no amplitude", "amplitude: 1, ", "", INPUT, "8:7: component: 'amplitude' is missing: [m] half of the height between trough and crest"),
    ("amplitude 0", "amplitude: 1,", "amplitude: 0,", INPUT, "8:8: 'amplitude': found '0', expected a number in m, greater than 0"),
    ("a negative amplitude", "amplitude: 1,", "amplitude: -1,", INPUT, "8:8: 'amplitude': found '-1', expected a number in m, greater than 0"),
    ("an amplitude in feet", "amplitude: 1,", "amplitude: 3 ft,", INPUT, "8:8: 'amplitude': found '3 ft', expected a number in m, greater than 0: write the number alone"),
    ("a wave that breaks", "amplitude: 1,", "amplitude: 8,", INPUT, "8:7: waves: component 1 would be 16 m high, but in this depth a wave with the period 9 s breaks at 12.43 m: give half of a height below that as amplitude"),
    ("a steep wave", "period: 6", "period: 1", INPUT, "9:7: waves: component 2 would be 1 m high, but in this depth a wave with the period 1 s breaks at 0.2217 m"),
    ("a period of 0", "period: 9", "period: 0", INPUT, "8:22: 'period': found '0', expected a number in s, greater than 0"),
    ("a wave of a negative period", "period: 9", "period: -9", INPUT, "8:22: 'period': found '-9', expected a number in s, greater than 0"),
    ("no period", "period: 9, ", "", INPUT, "8:7: component: 'period' is missing: [s] time from crest to crest in one place"),
    ("a period and a frequency", "period: 9", "period: 9, frequency: 0.1", INPUT, "8:22: 'period': it does not go with 'frequency': leave one of them out"),
    ("a negative frequency", "period: 9", "frequency: -0.1", INPUT, "8:22: 'frequency': found '-0.1', expected a number in Hz, greater than 0"),
    ("a wave without a length", "period: 9", "period: 1e-60", INPUT, "8:7: waves: component 1 has no wave length: its period is 1e-60 s"),
    ("no direction", ", direction: 0", "", INPUT, "8:7: component: 'direction' is missing: [degree] in which it goes"),
    ("a direction in words", "direction: 0", "direction: east", INPUT, "8:33: 'direction': found 'east', expected a number in degree"),
    ("a direction of two numbers", "direction: 0", "direction: [1, 0]", INPUT, "8:33: 'direction': found a list of 2, expected a number in degree"),
    ("NaN in a phase", "phase: 40", "phase: .nan", INPUT, "9:50: 'phase': found '.nan', expected a number in degree"),
    ("a misspelt phase", "phase: 40", "fase: 40", INPUT, "9:50: component: unknown key 'fase'; did you mean 'phase'?"),
    ("a misspelt component", "components", "component", INPUT, "7:3: 'waves': unknown key 'component'; did you mean 'components'?"),
    ("a list of waves", "waves:\n  depth: 20\n  ramp: 3\n  components:\n", "waves:\n", INPUT, "4:1: 'waves': found a list of 2, expected a mapping"),
    ("waves without time", "duration: 2, time_step: 0.01", "steps: 3", INPUT, "4:1: waves: they move the water in time, but no stage of the history has a duration: give one"),
    ("waves without gravity", "capstan: 1\n", "capstan: 1\ngravity: [0, 0, 0]\n", INPUT, "5:1: waves: without gravity there are none: give gravity (0, 0, -g)"),
    ("waves under gravity that leans", "capstan: 1\n", "capstan: 1\ngravity: [1, 0, -9]\n", INPUT, "2:1: gravity: (1, 0, -9) m/s2 in a scene with a water surface, which is a plane z = constant: expected (0, 0, -g)"),
    ("waves under gravity that changes", "time_step: 0.01", "time_step: 0.01, gravity: [0, 0, -8]", INPUT, "19:49: stage 1: gravity changes, but waves are those under one gravity: leave either out"),
    ("waves in air", "water_density: 1025\n", "", INPUT, "2:1: 'water_surface': it goes with 'water_density', which is not given"),
    ("a height of what displaces nothing", "mass: 5", "mass: 5, height: 0.1", INPUT, "13:36: 'height': it goes with 'volume', which is not given"),
    ("excitation without waves", "waves:\n  depth: 20\n  ramp: 3\n  components:\n    - " + ONE + "\n    - " + TWO + "\n", "", INPUT, "5:69: body 'hull': excitation: it is that of waves, and the scene has none: give waves, or leave it out"),
    ("excitation in words", "[{frequency: 0.2, direction: 390, amplitude: [1, 1, 1, 0, 0, 0]}, ", "[much, ", INPUT, "11:82: row of the excitation: found 'much', expected a mapping"),
    ("excitation without a period", "frequency: 0.2, ", "", INPUT, "11:82: row of the excitation: 'period' is missing"),
    ("excitation without a direction", "frequency: 0.2, direction: 390", "frequency: 0.2", INPUT, "11:82: row of the excitation: 'direction' is missing"),
    ("excitation without an amplitude", ", amplitude: [1, 1, 1, 0, 0, 0]", "", INPUT, "11:82: row of the excitation: 'amplitude' is missing"),
    ("excitation of three components", "[1, 1, 1, 0, 0, 0]", "[1, 1, 1]", INPUT, "11:115: 'amplitude': found a list of 3, expected six numbers, as in [x, y, z, rx, ry, rz]"),
    ("a negative excitation", "[1, 1, 1, 0, 0, 0]", "[1, 1, -1, 0, 0, 0]", INPUT, "11:133: 'amplitude': found '-1', expected a number, at least 0"),
    ("NaN in a phase of excitation", "[90, 0, 0, 0, -90, 0]", "[90, 0, .nan, 0, -90, 0]", INPUT, "11:305: 'phase': found '.nan', expected a number in degree"),
    ("excitation for other periods", "frequency: 0.15", "frequency: 0.18", INPUT, "11:69: body 'hull': excitation: no rows for the direction 30 degrees have the period 6 s of wave 2 between them"),
    ("excitation for another direction", "direction: 360", "direction: 10", INPUT, "11:69: body 'hull': excitation: no rows for the direction 0 degrees have the period 9 s of wave 1 between them"),
    ("excitation twice for a period", "frequency: 0.15", "frequency: 0.2", INPUT, "11:147: body 'hull': excitation: row 2 has the period 5 s and the direction 390 degrees, as row 1: leave one of them out"),
    ("a member in words", MEMBER, "members: [long]", INPUT, "11:332: member: found 'long', expected a mapping with from, to, diameter, normal, tangential, added_normal, strips"),
    ("members in words", MEMBER, "members: all", INPUT, "11:322: 'members': found 'all', expected a list, as in [{...}, {...}]"),
    ("no member", MEMBER, "members: []", INPUT, "11:322: 'members': found a list of 0, expected a list, as in [{...}, {...}]"),
    ("a member without an end", ", to: [0, 0, 1]", "", INPUT, "11:332: member: 'to' is missing: [m] the other end"),
    ("a member without a diameter", "diameter: 0.5, ", "", INPUT, "11:332: member: 'diameter' is missing: [m] of the cylinder, that the coefficients are for"),
    ("a member without a coefficient", ", normal: 1}]}", "}]}", INPUT, "11:332: member: 'normal' is missing: coefficient of drag across it, on its diameter"),
    ("a member of no length", "to: [0, 0, 1]", "to: [0, 0, -1]", INPUT, "11:332: body 'hull': members: number 1 goes from (0, 0, -1) m to (0, 0, -1) m, expected two places apart from each other"),
    ("an end of two numbers", "to: [0, 0, 1]", "to: [0, 1]", INPUT, "11:351: 'to': found a list of 2, expected three numbers in m, as in [x, y, z]"),
    ("NaN in an end", "to: [0, 0, 1]", "to: [0, .nan, 1]", INPUT, "11:359: 'to': found '.nan', expected a number in m, finite and at most 1e100"),
    ("an endless member", "to: [0, 0, 1]", "to: [0, 0, .inf]", INPUT, "11:362: 'to': found '.inf', expected a number in m, finite and at most 1e100"),
    ("a member of no diameter", "diameter: 0.5", "diameter: 0", INPUT, "11:366: 'diameter': found '0', expected a number in m, greater than 0"),
    ("a negative diameter", "diameter: 0.5", "diameter: -0.5", INPUT, "11:366: 'diameter': found '-0.5', expected a number in m, greater than 0"),
    ("a diameter with a unit", "diameter: 0.5", "diameter: 0.5 m", INPUT, "11:366: 'diameter': found '0.5 m', expected a number in m, greater than 0: write the number alone, without a unit"),
    ("a negative coefficient across", "normal: 1}]}", "normal: -1}]}", INPUT, "11:381: 'normal': found '-1', expected a number, at least 0"),
    ("a negative coefficient along", "normal: 1}]}", "normal: 1, tangential: -0.1}]}", INPUT, "11:392: 'tangential': found '-0.1', expected a number, at least 0"),
    ("a negative added mass of a member", "normal: 1}]}", "normal: 1, added_normal: -1}]}", INPUT, "11:392: 'added_normal': found '-1', expected a number, at least 0"),
    ("an endless added mass of a member", "normal: 1}]}", "normal: 1, added_normal: .inf}]}", INPUT, "11:392: 'added_normal': found '.inf', expected a number, at least 0, finite and at most 1e100"),
    ("an added mass along a member", "normal: 1}]}", "normal: 1, added_tangential: 1}]}", INPUT, "11:392: member: unknown key 'added_tangential', expected a mapping with from, to, diameter, normal, tangential, added_normal, strips"),
    ("no strips", "normal: 1}]}", "normal: 1, strips: 0}]}", INPUT, "11:392: 'strips': found '0', expected a whole number, from 1 to 1000"),
    ("half a strip", "normal: 1}]}", "normal: 1, strips: 2.5}]}", INPUT, "11:392: 'strips': found '2.5', expected a whole number, from 1 to 1000"),
    ("too many strips", "normal: 1}]}", "normal: 1, strips: 1001}]}", INPUT, "11:392: 'strips': found '1001', expected a whole number, from 1 to 1000"),
    ("a misspelt member", MEMBER, MEMBER.replace("members", "member"), INPUT, "11:322: body 'hull': unknown key 'member'; did you mean 'members'?"),
    ("a misspelt end of a member", "from: [0, 0, -1]", "form: [0, 0, -1]", INPUT, "11:333: member: unknown key 'form'; did you mean 'from'?"),
    ("too many members", MEMBER, "members: [" + ", ".join([MEMBER[10:-1]]*201) + "]", LIMIT, "11:322: body 'hull': members: found 201, the limit is 200"),
    ("memory of radiation", "moments_of_inertia: [9, 9, 9]", "moments_of_inertia: [9, 9, 9], radiation: [[0, 1]]", INPUT, "11:69: 'radiation': found a list of 1, expected a text of at most 255 bytes"),
]


def main():
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.yaml")

        def run(text):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            return subprocess.run([sys.argv[1], "check", path], capture_output=True, text=True, check=False)

        for scene in (GOOD, IN_WAVES):
            good = run(scene)
            if good.returncode:
                failed += 1
                print("a good scene:", good.stderr)
        cases = [(GOOD, *case) for case in CHANGES] + [(IN_WAVES, *case) for case in WAVE_CHANGES]
        for scene, name, old, new, code, wanted in cases:
            assert scene.count(old) == 1, name
            done = run(scene.replace(old, new))
            told = done.stderr.replace(path + ":", "", 1).replace("capstan: ", "", 1)
            if done.returncode != code or done.stdout or done.stderr.count("\n") != 1 or not told.startswith(wanted):
                failed += 1
                print(f"{name}: exit code {done.returncode}, expected {code}; {done.stderr.rstrip()}\n    expected {wanted}")
    print(f"{len(cases)} cases, {failed} failed")
    return 0 if is_told(len(cases)) and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
