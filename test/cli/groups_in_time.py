# SPDX-License-Identifier: BSD-3-Clause
"""Points that no line connects move in time as if the others were not there.                     usage: groups_in_time.py CAPSTAN

A clump falls on a drum with its lines. Another one far from it falls on eight lines, which are snatched taut one after the other; its steps are
taken again where they are, some of them in steps in which an element beside the first clump lands.
"""
import csv
import os
import subprocess
import sys
import tempfile

CAPSTAN = sys.argv[1]


def scene(beside):
    points = ["clump: {held: [-0.038496, 0.033098, 0.14268], mass: 1.7085}"]
    lines = ["l0: {length: 0.56666, elements: 11, mass: 31.025, stiffness: 31149, start: static, "
             "ends: {A: {held: [0.34665, 0.036504, 0.085175]}, B: {point: clump}}}",
             "l1: {length: 0.3259, elements: 21, mass: 31.025, stiffness: 43106, damping: 6.6209, start: static, "
             "ends: {A: {held: [-0.30704, -0.069978, 0.17227]}, B: {point: clump}}}"]
    free = ["clump.point: {force: [0, 0, 0]}"]
    if beside:
        points.append("drop: {held: [1.3353, 0, 1.549], mass: 16.572}")
        free.append("drop.point: {force: [0, 0, 0]}")
        for i in range(8):
            lines.append(f"g{i}: {{length: {0.26707 + 0.021366 * i!r}, elements: 3, mass: 3.1025, stiffness: 16257, start: static, "
                         f"ends: {{A: {{held: [{1.1217 + 0.053414 * i!r}, {0.053414 * (i % 3)!r}, 1.6024]}}, B: {{point: drop}}}}}}")
    return ("capstan: 1\ngravity: [0, 0, -9.81]\n"
            "obstacles: {drum: {sphere: {centre: [0, 0, 0], axis: [0, 1, 0], radius: 0.14881}, friction: 0.16427}}\n"
            "points: {" + ", ".join(points) + "}\nlines:\n  " + "\n  ".join(lines) +
            "\nhistory:\n  - {name: let go, steps: 16, duration: 0.024693, " + ", ".join(free) + "}\n  - {name: fall, steps: 14, duration: 0.44991}\n")


def path_of_clump(folder, beside):
    path, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
    with open(path, "w", encoding="ascii") as file:
        file.write(scene(beside))
    subprocess.run([CAPSTAN, "run", "-q", path, "-o", out, "--force", "--no-paraview"], check=True)
    snatched = 0
    with open(os.path.join(out, "history.csv"), encoding="ascii") as file:
        for row in csv.DictReader(file):
            snatched += int(row["snatched"]) if row["name"] else 0
    with open(os.path.join(out, "points.csv"), encoding="ascii") as file:
        return [[float(row[a]) for a in ("x", "y", "z")] for row in csv.DictReader(file) if row["point"] == "clump"], snatched


def main():
    with tempfile.TemporaryDirectory() as folder:
        alone, _ = path_of_clump(folder, False)
        beside, snatched = path_of_clump(folder, True)
    most = max(abs(p - q) for a, b in zip(alone, beside) for p, q in zip(a, b))
    print(f"{len(alone)} steps, {snatched} snatches, the clump is off by {most:.3g} m at most")
    return 0 if len(alone) == len(beside) > 0 and snatched > 0 and most == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
