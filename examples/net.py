#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The scene of a net over a ball and four pegs.    usage: net.py [MESHES] > net.yaml

A square net of MESHES x MESHES meshes (default 100), 4 m wide, hangs from its corners over a ball and four pegs: it is placed by statics, then
two of its corners are pulled outwards and let back, over rough obstacles. The whole weighs 20 N/m2 and has a stiffness of 100 kN over its width,
whatever the number of meshes. A side of a mesh is one element, which may not be longer than 1.3 radii of a peg: MESHES is at least 10.
SI units: m, N.
"""
import sys

SIDE, HALF, HEIGHT, WEIGHT, STIFFNESS, FRICTION = 4, 1.9, 0.3, 20, 1e5, 0.3
BALLS = {"ball": (0, 0, -0.6, 0.8)} | {f"peg{i + 1}": (x, y, -0.3, 0.4) for i, (x, y) in
                                        enumerate(((1.2, 1.2), (-1.2, 1.2), (-1.2, -1.2), (1.2, -1.2)))}


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    if not 10 <= n <= 300:
        sys.exit("net.py: from 10 to 300 meshes")
    print(f"capstan: 1\ntitle: A net of {n} x {n} meshes over a ball and four pegs\n\nobstacles:")
    for name, (x, y, z, r) in BALLS.items():
        print(f"  {name}: {{sphere: {{centre: [{x}, {y}, {z}], radius: {r}}}, friction: {FRICTION}}}")
    print("\npoints:")
    for i in range(n + 1):
        for j in range(n + 1):
            kind = "held" if i in (0, n) and j in (0, n) else "free"
            x, y = (HALF * (2 * k / n - 1) for k in (i, j))
            print(f"  p{i}-{j}: {{{kind}: [{x:.9g}, {y:.9g}, {HEIGHT}]}}")
    print("\nlines:")
    twine = (f"length: {SIDE / n:.9g}, elements: 1, weight: {WEIGHT * SIDE / (2 * (n + 1)):.9g}, stiffness: {STIFFNESS / n:.9g}, start: static")
    for i in range(n + 1):
        for j in range(n + 1):
            for kind, (k, m) in (("a", (i + 1, j)), ("b", (i, j + 1))):
                if k <= n and m <= n:
                    print(f"  {kind}{i}-{j}: {{{twine}, ends: {{A: {{point: p{i}-{j}}}, B: {{point: p{k}-{m}}}}}}}")
    ends = [f"p{n}-{j}" for j in (0, n)]
    print("\nhistory:")
    for name, steps, out in (("pull", 2, 0.05), ("back", 2, 0)):
        moves = ", ".join(f"{end}.point: {{position: [{HALF + out}, {y}, {HEIGHT}]}}" for end, y in zip(ends, (-HALF, HALF)))
        print(f"  - {{name: {name}, steps: {steps}, {moves}}}")


main()
