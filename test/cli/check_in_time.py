#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What `capstan check` says of a scene in time: inertia, added mass, damping, drag, excitation, times; and what both `check` and `run` say
of steps that are too long for what an entry imposes.                                                      usage: check_in_time.py CAPSTAN"""
import math
import os
import subprocess
import sys
import tempfile

SCENE = """capstan: 1
water_density: 1000
water_surface: 0
time_scheme: euler
current: [{z: -20, velocity: [0, 0, 0]}, {z: 0, velocity: [0.5, 0, 0]}]
waves: {depth: 30, components: [{amplitude: 0.5, period: 8, direction: 0}, {amplitude: 0.1, period: 3, direction: 0}]}
types: {chain: {mass: 20, stiffness: 1e6}, wire: {mass: 5, diameter: 0.02, stiffness: 1e6}}
bodies:
  hull: {free: [0, 0, 0], mass: 500, moments_of_inertia: [10, 11, 12], products_of_inertia: [0.5, 0, 0], hydrostatics: {z: 1e4},
         added_mass: {x: 7}, damping: {z: 30}, radiation: kernel.csv, quadratic_damping: {rx: 4}, velocity: [0, 0, 0.5], turn_rate: [0, 0, 0.1],
         members: [{from: [0, 0, -4], to: [0, 0, 0], diameter: 1, normal: 1, added_normal: 1}],
         excitation: [{period: 3, direction: 0, amplitude: [1, 0, 0, 0, 0, 0], phase: [0, 0, 0, 0, 0, 0]},
                      {period: 8, direction: 0, amplitude: [1, 0, 0, 0, 0, 0], phase: [0, 0, 0, 0, 0, 0]}]}
points:
  eye: {body: hull, at: [0, 0, -4]}
  clump: {free: [6, 0, -12], mass: 30, velocity: [0.1, 0, 0]}
lines:
  upper: {sections: [{type: chain, length: 5, elements: 2}, {type: wire, length: 5, elements: 2}], damping: 300,
          drag: {diameter: 0.05, normal: 1.2, tangential: 0.1, added_normal: 1}, start: {straight: {from: [6, 0, -12], to: [0, 0, -4]}},
          ends: {A: {point: clump}, B: {point: eye}}}
  lower: {length: 10, elements: 2, weight: 50, stiffness: 1e6, quasi_static: true, start: {straight: {from: [12, 0, -20], to: [6, 0, -12]}},
          ends: {A: held, B: {point: clump}}}
history:
  - {name: hold, steps: 2}
  - {name: sea, duration: 30, time_step: 0.1}
  - {name: calm, duration: 20, time_step: 0.2}
"""
# Of the water that goes along with 4 m of the cylinder, whose middle is 2 m below: 1000 pi/4 x 4 kg, and the moments of that about the top.
COLUMN = 1000*math.pi/4*4
SAID = ["water of 1000 kg/m3, current (0, 0, 0) m/s at z = -20 m, (0.5, 0, 0) m/s at z = 0 m",
        "  mass 500 kg, moments of inertia (10, 11, 12) kg m2, products (0.5, 0, 0) kg m2, velocity (0, 0, 0.5) m/s, turn rate (0, 0, 0.1) rad/s",
        f"  added mass        [{COLUMN + 7:g} 0 0 0 {-2*COLUMN:g} 0]", "  quadratic damping [0 0 0 0 0 0]", "[0 0 30 0 0 0]", "[0 0 0 4 0 0]",
        "  excitation by waves in 2 rows", "  memory of radiation over 4 s in 3 rows", "  1 member, whose added mass is in the one above",
        "point clump: free, begins at (6, 0, -12) m, clump of 294.3 N, force (0, 0, 0) N, moves with 30 kg, velocity (0.1, 0, 0) m/s",
        "  moves with 5 to 20 kg/m, internal damping 300 N s", "  drag on a diameter of 0.05 m: 1.2 across, 0.1 along; added mass 1 across, 0 along",
        "  moves without inertia", "history: 3 entries, 402 load steps in all, 50 s in time by euler, steps of 0.1 to 0.2 s"]
SWING = """capstan: 1
water_density: 1000
water_surface: 0
waves: {depth: 30, components: [{amplitude: 0.005, period: WAVE, direction: 0}, {amplitude: 0.5, period: 8, direction: 0}]}
bodies:
  hull: {held: [0, 0, 0], mass: 5, moments_of_inertia: [1, 1, 1]}
points: {eye: {body: hull}}
lines:
  rope: {length: 2, elements: 4, mass: 1, stiffness: 1e4, drag: {diameter: 0.01, normal: 1}, start: static, ends: {A: {held: [1.5, 0, -1]}, B: {point: eye}}}
history: [{name: swing, duration: 2, time_step: 0.1, rope.A: {move: [0, 0, 0], cosine: [0.1, 0, 0], period: END},
           hull.body: {move: [0, 0, 0], oscillations: [{rotation_sine: [TURN, 0, 0], period: 2}]}}]
"""
STILL = """capstan: 1
lines: {rope: {length: 2, mass: 1, stiffness: 1e4, start: {straight: {from: [0, 0, 0], to: [2, 0, 0]}}, ends: {A: held, B: held}}}
history: [{steps: 2}]
"""
# 0.1 s is a 4th of 0.4 s; the fastest of an oscillation over a step is 2 sin(pi/20) of its amplitude: half a turn for 575.4 degrees.
COARSE = (({}, None), ({"END": 0.4}, None), ({"END": 0.25}, "an oscillation goes through 0.4 of its period of 0.25 s"),
          ({"WAVE": 0.3}, "a wave goes through 0.333 of its period of 0.3 s"), ({"WAVE": 0.3}, "(1 of 2 waves have fewer than four)"),
          ({"TURN": 570}, None), ({"TURN": 600}, "body hull is turned by up to 185.4 degrees"))


def main():
    capstan, = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        scene = os.path.join(folder, "scene.yaml")

        def ask(text, *words):
            with open(scene, "w", encoding="utf-8") as file:
                file.write(text)
            done = subprocess.run([capstan, *words, scene], capture_output=True, text=True, timeout=100, cwd=folder)
            assert done.returncode == 0, done.stderr
            return done

        with open(os.path.join(folder, "kernel.csv"), "w", encoding="utf-8") as file:
            file.write("time,k33\n0,50\n2,10\n4,0\n")
        done = ask(SCENE, "check")
        missing = [text for text in SAID if text not in done.stdout]
        assert not missing and not done.stderr, f"{missing} not in\n{done.stdout}{done.stderr}"
        still = ask(STILL, "check").stdout
        assert "moves with" not in still and "in time" not in still and "history: 1 entry, 2 load steps in all\n" in still, still
        for change, told in COARSE:
            given = {"WAVE": 0.5, "END": 1, "TURN": 20, **change}
            text = SWING
            for key, value in given.items():
                text = text.replace(key, str(value))
            for words in (("check",), ("run", "--force", "--no-paraview")):
                said = ask(text, *words).stderr
                assert ("warning: entry swing: in a step of 0.1 s" in said) == (told is not None) and (told or "") in said, (change, said)
            assert "entry swing" not in ask(text, "run", "-q", "--force", "--no-paraview").stderr


main()
