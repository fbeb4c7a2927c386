#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The net of examples/net.py, seen from aside after its last step, so that one sees how it lies on its ball and pegs.

usage: net.py BUILD MESHES PICTURE.svg        solves the net of MESHES x MESHES meshes, which takes minutes for 100, and draws it
"""
import csv
import math
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
# from where one looks: both horizontal parts of the direction to the eye are positive, so that rows and columns are drawn from behind
ROUND, UP = math.radians(32), math.radians(36)
EYE = (math.cos(UP) * math.cos(ROUND), math.cos(UP) * math.sin(ROUND), math.sin(UP))
RIGHT = (-math.sin(ROUND), math.cos(ROUND), 0)
ABOVE = (-math.sin(UP) * math.cos(ROUND), -math.sin(UP) * math.sin(ROUND), math.cos(UP))
LIGHT = (0.35, -0.45, 0.82)
WIDTH, EDGE, TOP, LEVELS = 960, 30, 80, 12
HANGS, LIES = ((226, 238, 246), (38, 92, 140)), ((255, 236, 214), (196, 92, 28))  # bright and dark


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def scene_of(meshes):
    maker = os.path.join(ROOT, "examples", "net.py")
    return subprocess.run([sys.executable, maker, str(meshes)], capture_output=True, text=True, check=True).stdout


def last_places(path, meshes):
    """Where the points are after the last step, and which of them touch, as squares of the net."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))[1:]
    last = rows[-1]["step"]
    place, touches = {}, {}
    for row in rows:
        if row["step"] == last:
            key = tuple(int(k) for k in row["point"][1:].split("-"))
            place[key] = tuple(float(row[c]) for c in "xyz")
            touches[key] = row["obstacle"] != ""
    return [[place[i, j] for j in range(meshes + 1)] for i in range(meshes + 1)], [[touches[i, j] for j in range(meshes + 1)] for i in range(meshes + 1)]


def shade(corners):
    """0 bright .. 1 dark, by the light on a mesh."""
    a, b = ([q - p for p, q in zip(corners[k], corners[k + 2])] for k in (0, 1))
    normal = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    size = math.sqrt(dot(normal, normal)) or 1
    return min(1, max(0, 1.9 * (1 - abs(dot(normal, LIGHT)) / size)))


def colour(of, level):
    t = level / (LEVELS - 1)
    return "#" + "".join(f"{round((1 - t) * a + t * b):02x}" for a, b in zip(*of))


def outline(corners):
    """A path round whole places, each from the one before."""
    steps = [c - b for p, q in zip(corners, corners[1:]) for b, c in zip(p, q)]
    return f"M{corners[0][0]} {corners[0][1]}l" + " ".join(map(str, steps)).replace(" -", "-") + "z"


def picture(scene, path, meshes):
    place, touches = last_places(path, meshes)
    balls = [([float(v) for v in c.split(",")], float(r)) for c, r in re.findall(r"sphere: \{centre: \[(.*?)\], radius: ([\d.]+)\}", scene)]
    flat = [p for row in place for p in row]
    low, high = min(dot(RIGHT, p) for p in flat), max(dot(RIGHT, p) for p in flat)
    scale = (WIDTH - 2 * EDGE) / (high - low)
    top = max([dot(ABOVE, p) for p in flat] + [dot(ABOVE, c) + r for c, r in balls])
    bottom = min([dot(ABOVE, p) for p in flat] + [dot(ABOVE, c) - r for c, r in balls])
    height = TOP + scale * (top - bottom) + EDGE + 40

    def at(p):
        return EDGE + scale * (dot(RIGHT, p) - low), TOP + scale * (top - dot(ABOVE, p))
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height:.0f}" font-family="sans-serif" font-size="12" fill="#222">',
           f'<rect width="{WIDTH}" height="{height:.0f}" fill="#fff"/>',
           f'<text x="24" y="30" font-size="17" font-weight="bold">A net of {meshes} x {meshes} meshes over a ball and four pegs</text>',
           f'<text x="24" y="52" fill="#555">{(meshes + 1) ** 2} points, {2 * meshes * (meshes + 1)} lines, after the last step; '
           f'seen from {math.degrees(UP):.0f} degrees above the horizontal</text>',
           '<defs><radialGradient id="ball" cx="0.4" cy="0.3" r="0.75"><stop offset="0" stop-color="#f4f1ea"/><stop offset="1" stop-color="#b3aa98"/>'
           "</radialGradient></defs>"]
    for centre, radius in sorted(balls, key=lambda ball: dot(EYE, ball[0])):
        x, y = at(centre)
        out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{scale * radius:.1f}" fill="url(#ball)" stroke="#8d8471" stroke-width="0.8"/>')
    # in tenths of a pixel, from corner to corner: whole numbers are short
    paper = [[tuple(round(10 * float(f"{c:.1f}")) for c in at(p)) for p in row] for row in place]
    out.append(f'<g transform="scale(0.1)" fill-opacity="0.93" stroke-width="{min(8, 160 / meshes):.1f}" stroke-linejoin="round">')
    run, begun = None, []

    def finish():
        if begun:
            of, level = run
            out.append(f'<path fill="{colour(of, level)}" stroke="{colour(of, LEVELS - 1)}" d="{"".join(begun)}"/>')
    for i in range(meshes):
        for j in range(meshes):
            keys = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
            of = LIES if all(touches[a][b] for a, b in keys) else HANGS
            style = of, round(shade([place[a][b] for a, b in keys]) * (LEVELS - 1))
            if style != run:
                finish()
                run, begun = style, []
            begun.append(outline([paper[a][b] for a, b in keys]))
    finish()
    out.append("</g>")
    for k, (of, words) in enumerate(((HANGS, "hangs"), (LIES, "all four corners of a mesh lie on the ball or a peg"))):
        x = 24 + 90 * k
        out.append(f'<rect x="{x}" y="{height - 30:.0f}" width="16" height="12" fill="{colour(of, LEVELS // 3)}" stroke="{colour(of, LEVELS - 1)}"/>')
        out.append(f'<text x="{x + 22}" y="{height - 20:.0f}">{words}</text>')
    return "\n".join([*out, "</svg>"]) + "\n"


def run_of(program, meshes):
    """The folder with the results of the net of so many meshes."""
    return program.run("run", program.file(f"net-{meshes}.yaml", scene_of(meshes)))[1]


def drape(program, meshes):
    """The picture of the run of the net of so many meshes."""
    folder, scene = run_of(program, meshes), scene_of(meshes)
    path = os.path.join(folder, "drape.svg")
    with open(path, "w", encoding="utf-8") as file:
        file.write(picture(scene, os.path.join(folder, "points.csv"), meshes))
    return path


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    build, meshes, path = os.path.abspath(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
    scene = scene_of(meshes)
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "net.yaml")
        with open(name, "w", encoding="utf-8") as file:
            file.write(scene)
        done = subprocess.run([os.path.join(build, "cli", "capstan"), "run", name, "-o", os.path.join(folder, "out"), "--no-paraview", "--sync", "end",
                               "--fields", "none"], check=False)
        if done.returncode != 0:
            sys.exit(f"net.py: capstan run ended with {done.returncode}: not every step is certified")
        text = picture(scene, os.path.join(folder, "out", "points.csv"), meshes)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
