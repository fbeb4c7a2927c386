# SPDX-License-Identifier: BSD-3-Clause
"""planes.svg: each line of a mooring is drawn in its own vertical plane. The curves are read from the picture, through the ticks of their axes, and
compared with the places of the ends in history.csv: the distance along the plane between the ends is that in plan, wherever the line points to; the
names of its points, and of a body at which it ends, stand there, and those of others do not.                     usage: planes.py CAPSTAN"""
import csv
import math
import os
import re
import subprocess
import sys
import tempfile

CAPSTAN = sys.argv[1]
faults = []


def scene(lines, turn):
    points, all_lines = {}, []
    for k in range(lines):
        angle = turn + 2 * math.pi * k / lines
        c, s = math.cos(angle), math.sin(angle)
        points[f"anchor_{k}"] = f"{{held: [{90 * c:.9g}, {90 * s:.9g}, -40]}}"
        points[f"fairlead_{k}"] = f"{{body: buoy, at: [{3 * c:.9g}, {3 * s:.9g}, -2]}}"
        all_lines.append(f"  leg_{k}: {{length: 105, elements: 30, weight: 200, stiffness: 1e7, start: static, ends: {{A: {{point: anchor_{k}}}, B: {{point: fairlead_{k}}}}}}}")
    text = "capstan: 1\ntitle: planes\nobstacles:\n  bed: {plane: {point: [0, 0, -40], normal: [0, 0, 1]}, friction: 0.3}\n"
    text += "bodies:\n  buoy: {held: [0, 0, 0]}\npoints:\n" + "".join(f"  {name}: {what}\n" for name, what in points.items())
    return text + "lines:\n" + "\n".join(all_lines) + "\nhistory:\n  - {name: out, steps: 3, buoy.body: {position: [4, 1, 0]}}\n"


def run(folder, name, text):
    path, out = os.path.join(folder, name + ".yaml"), os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([CAPSTAN, "run", path, "-o", out, "--no-paraview", "-q"], capture_output=True, text=True, timeout=300)
    if done.returncode != 0:
        sys.exit(f"{name}: exit {done.returncode}: {done.stderr}")
    return out


def panels(picture):
    """The text of each frame: from the label of its heights on."""
    parts = re.split(r'(?=<clipPath id="[^"]*")', picture)
    frames = [parts[k] + (parts[k + 1] if k + 1 < len(parts) else "") for k in range(1, len(parts), 2)]
    return frames


def scale(panel, anchor):
    """Pixels over metres along x: the ticks below the frame are numbers at places."""
    ticks = [(float(x), float(t.replace("\u2212", "-"))) for x, t in re.findall(r'<text x="([\d.]+)" y="[\d.]+" text-anchor="' + anchor + r'"[^>]*>(-?[\d.]+)</text>', panel)]
    (x0, t0), (x1, t1) = ticks[0], ticks[-1]
    return (x1 - x0) / (t1 - t0), x0, t0


with tempfile.TemporaryDirectory() as folder:
    for lines, turn in ((2, 0.0), (3, 0.4), (5, -1.1), (12, 0.05)):
        name = f"of-{lines}"
        out = run(folder, name, scene(lines, turn))
        with open(os.path.join(out, "planes.svg"), encoding="utf-8") as file:
            picture = file.read()
        with open(os.path.join(out, "history.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))[1:]
        found = panels(picture)
        if len(found) != lines:
            faults.append(f"{name}: {len(found)} frames")
            continue
        for k, panel in enumerate(found):
            words = set(re.findall(r">([^<>]+)</text>", panel))
            wanted, others = {f"anchor_{k}", f"fairlead_{k}", "buoy"}, {f"{what}_{m}" for what in ("anchor", "fairlead") for m in range(lines) if m != k}
            if not wanted <= words or words & others or not any(w.startswith(f"line leg_{k}") for w in words):
                faults.append(f"{name}, leg_{k}: it has {sorted(words & (wanted | others))}")
            curves = [[tuple(map(float, p.split(","))) for p in text.split()] for text in re.findall(r'<polyline fill="none" stroke="#[0-9a-f]{6}" stroke-width="[\d.]+" stroke-linejoin="round"  points="([^"]*)"', panel)]
            if len(curves) != len(rows) + 1:
                faults.append(f"{name}, leg_{k}: {len(curves)} curves of {len(rows)} steps")
                continue
            per_metre, x0, t0 = scale(panel, "middle")
            first = [[float(rows[0][f"leg_{k}.{end}.{c}"]) for c in "xyz"] for end in "AB"]
            chord = [b - a for a, b in zip(*first)]
            span = math.hypot(chord[0], chord[1])
            for row, curve in zip(rows, curves[1:]):
                ends = [[float(row[f"leg_{k}.{end}.{c}"]) for c in "xyz"] for end in "AB"]
                # along the plane of the first step, in metres; pixels are drawn to a tenth
                along = ((ends[1][0] - ends[0][0]) * chord[0] + (ends[1][1] - ends[0][1]) * chord[1]) / span
                drawn = abs(curve[-1][0] - curve[0][0]) / per_metre
                if abs(drawn - along) > 0.3 / per_metre + 1e-3 * along:
                    faults.append(f"{name}, leg_{k}, {row['name']}: {drawn} m between the ends, expected {along}")
                if not curve[-1][1] < curve[0][1]:
                    faults.append(f"{name}, leg_{k}: the fairlead is drawn below the anchor")
    if os.path.exists(os.path.join(run(folder, "many", scene(13, 0)), "planes.svg")):
        faults.append("13 lines have a planes.svg")

for fault in faults[:20]:
    print(fault)
sys.exit(1 if faults else 0)
