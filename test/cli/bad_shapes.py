#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bad shapes of obstacles: each must be refused with its exit code, its place and its message.

usage: bad_shapes.py CAPSTAN

Every case is one obstacle of a scene; expected is what follows the file name in the message. Standard error must be one line, and standard
output empty. One good obstacle of each shape is accepted, and told as it is.
"""
import os
import subprocess
import sys
import tempfile

from checks import is_told

INPUT = 3
SCENE = """\
capstan: 1
obstacles:
  it: {%s}
lines:
  cable: {length: 2, elements: 4, mass: 1, stiffness: 1e6, start: {straight: {from: [0, 0, 40], to: [2, 0, 40]}}, ends: {A: held, B: held}}
history:
  - {name: stage%s}
"""
CAPSULE, TORUS = "capsule: {length: 1, radius: 1}", "torus: {main_radius: 3, radius: 1}"
CONE, BOX = "cone: {axis: [0, 0, -1], angle: 30, radius: 1}", "box: {size: [2, 3, 4], radius: 0.5}"
GOOD = [
    (CAPSULE, "it: capsule of radius 1 m and length 1 m around (0, 0, 0) m, axis (0, 1, 0), friction 0"),
    ("capsule: {length: 0, radius: 1}", "it: capsule of radius 1 m and length 0 m"),
    (TORUS, "it: torus of radii 3 and 1 m around (0, 0, 0) m, axis (0, 1, 0)"),
    (CONE, "it: cone of 30 degrees with a tip of radius 1 m at (0, 0, 0) m, axis (0, 0, -1)"),
    (BOX, "it: box of 2 x 3 x 4 m with edges of radius 0.5 m around (0, 0, 0) m"),
    ("box: {centre: [0, 0, -300], size: [200, 3, 400], radius: 0.5, rotation: {roll_pitch_yaw: [1, 2, 3]}}", "it: box of 200 x 3 x 400 m"),
    ("sphere: {radius: 100, inside: true}", "it: ball of radius 100 m around (0, 0, 0) m, lines inside"),
    ("cylinder: {radius: 100, inside: true}", "lines inside"),
    ("cone: {tip: [0, 0, 1], axis: [0, 0, 1], angle: 60, radius: 1, inside: true}", "lines inside"),
]
# the obstacle, what else the stage has, and the message
BAD = [
    ("capsule: {radius: 1}", "", "3:8: 'capsule': 'length' is missing"),
    ("capsule: {length: 1}", "", "3:8: 'capsule': 'radius' is missing"),
    ("capsule: {length: -1, radius: 1}", "", "'length': found '-1', expected a number in m"),
    ("capsule: {length: .nan, radius: 1}", "", "'length': found '.nan'"),
    ("capsule: {length: 1, radius: 0}", "", "'radius': found '0', expected a number in m, greater than 0"),
    ("capsule: {length: 1, radius: -1}", "", "'radius': found '-1', expected a number in m, greater than 0"),
    ("capsule: {length: 1, radius: .inf}", "", "'radius': found '.inf'"),
    ("capsule: {length: 1, radius: 1, axis: [0, 0, 0]}", "", "obstacle 'it': axis is (0, 0, 0), expected a direction"),
    ("capsule: {length: 1, radius: 1, point: [0, 0, 0]}", "", "'capsule': unknown key 'point'"),
    ("capsule: {length: 1, radius: 1, center: [0, 0, 0]}", "", "'center'"),
    ("capsule: {length: 1, radius: 1, inside: 1}", "", "'inside': found '1'"),
    ("torus: {radius: 1}", "", "'torus': 'main_radius' is missing"),
    ("torus: {main_radius: 1, radius: 1}", "", "obstacle 'it': main_radius is 1 m, expected a finite number above the radius of the tube, 1 m"),
    ("torus: {main_radius: 0.5, radius: 1}", "", "obstacle 'it': main_radius is 0.5 m, expected a finite number above the radius of the tube, 1 m"),
    ("torus: {main_radius: 2, radius: 0}", "", "'radius': found '0', expected a number in m, greater than 0"),
    ("torus: {main_radius: 2, radius: 1, axis: [0, 1]}", "", "'axis'"),
    ("torus: {main_radius: 2, radius: 1, axis: [0, 0, 0]}", "", "obstacle 'it': axis is (0, 0, 0), expected a direction"),
    ("torus: {main_radius: 2, tube: 1}", "", "'torus': unknown key 'tube'"),
    ("cone: {angle: 30, radius: 1}", "", "'cone': 'axis' is missing"),
    ("cone: {axis: [0, 0, -1], radius: 1}", "", "'cone': 'angle' is missing"),
    ("cone: {axis: [0, 0, -1], angle: 30}", "", "'cone': 'radius' is missing: [m] radius of the ball that rounds its tip"),
    ("cone: {axis: [0, 0, -1], angle: 30, radius: 0}", "", "'radius': found '0', expected a number in m, greater than 0"),
    ("cone: {axis: [0, 0, -1], angle: 0, radius: 1}", "", "'angle': found '0', expected a number in degrees, greater than 0"),
    ("cone: {axis: [0, 0, -1], angle: 90, radius: 1}", "", "obstacle 'it': the angle between axis and side is 90 degrees, expected more than 0 and less than 90"),
    ("cone: {axis: [0, 0, -1], angle: 120, radius: 1}", "", "obstacle 'it': the angle between axis and side is 120 degrees"),
    ("cone: {axis: [0, 0, 0], angle: 30, radius: 1}", "", "obstacle 'it': axis is (0, 0, 0), expected a direction"),
    ("cone: {axis: [0, 0, -1], angle: 30, radius: 1, centre: [0, 0, 0]}", "", "'cone': unknown key 'centre'"),
    ("box: {size: [2, 3, 4]}", "", "'box': 'radius' is missing: [m] radius of its edges and corners"),
    ("box: {radius: 1}", "", "'box': 'size' is missing"),
    ("box: {size: [2, 3, 4], radius: 0}", "", "'radius': found '0', expected a number in m, greater than 0"),
    ("box: {size: [2, 3, 4], radius: 1}", "", "obstacle 'it': size is (2, 3, 4) m, expected finite numbers above twice the radius of the edges, 2 m"),
    ("box: {size: [2, 3, -4], radius: 0.5}", "", "'size'"),
    ("box: {size: [2, 3], radius: 0.5}", "", "'size'"),
    ("box: {size: [2, 3, 4], radius: 0.5, rotation: {quaternion: [0, 0, 0, 0]}}", "", "obstacle 'it': rotation is (0, 0, 0, 0), expected a quaternion"),
    ("box: {size: [2, 3, 4], radius: 0.5, axis: [0, 0, 1]}", "", "'box': unknown key 'axis'"),
    ("plane: {inside: true}", "", "'plane': unknown key 'inside'"),
    (BOX, ", it.turn: 20", "obstacle 'it' is a box, which has no axis of rotation; it.obstacle has turns about any"),
    ("box: {size: [200, 200, 200], radius: 0.5}", "", "start: node 0 lies 60 m below obstacle 'it'"),
    ("sphere: {radius: 2, inside: true}", "", "start: node 0 lies 38 m below obstacle 'it'"),
]


def main():
    capstan, failed = sys.argv[1], 0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.yaml")

        def check(obstacle, stage):
            with open(path, "w", encoding="ascii") as out:
                out.write(SCENE % (obstacle, stage))
            return subprocess.run([capstan, "check", path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60, check=False)

        for obstacle, says in GOOD:
            found = check(obstacle, "")
            if found.returncode != 0 or says not in found.stdout:
                print(f"{obstacle}: expected '{says}', found {found.returncode}, {found.stdout}{found.stderr}")
                failed += 1
        for obstacle, stage, says in BAD:
            found = check(obstacle, stage)
            lines = found.stderr.splitlines()
            if found.returncode != INPUT or found.stdout or len(lines) != 1 or says not in lines[0] or not lines[0].startswith(f"capstan: {path}:"):
                print(f"{obstacle}: expected '{says}', found {found.returncode}, {found.stderr.strip()}")
                failed += 1
    if not is_told(len(BAD)):
        failed += 1
    print(f"{len(GOOD)} good and {len(BAD)} bad shapes, {failed} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
