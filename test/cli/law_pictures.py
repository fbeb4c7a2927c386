# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of laws: unbounded sets, cones of velocities of every kind, graphs of one component, resistances.

usage: law_pictures.py CAPSTAN EXAMPLES

Lengths are read off the pictures and compared with what the law says; a picture holds its scale in its labelled ticks.
"""
import math
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as tree

from checks import expect, faults

SVG = "{http://www.w3.org/2000/svg}"
ORANGE, BLUE, CONE = "#c98a1b", "#2b5fa8", "#f0b429"


class Picture:
    def __init__(self, command, law, *asked):
        with tempfile.TemporaryDirectory() as folder:
            path, out = os.path.join(folder, "law.yaml"), os.path.join(folder, "law.svg")
            with open(path, "w") as file:
                file.write("capstan: 1\n" + law + "\n")
            done = subprocess.run([command, "law", path, "--plot", out, *asked], capture_output=True, text=True)
            self.text = open(out).read() if os.path.exists(out) else "<svg/>"
        self.what = f"{law} {' '.join(asked)}"
        expect(self.what, done.returncode == 0, done.stderr)
        expect(self.what + ": numbers", not re.search(r"\b(nan|inf)\b", self.text), "nan or inf")
        self.root = tree.fromstring(self.text)

    def all(self, kind, **attributes):
        return [e for e in self.root.iter(SVG + kind) if all(e.get(k) == v for k, v in attributes.items())]

    def heads(self):
        """directions of the arrows of velocities"""
        found = []
        for polygon in self.all("polygon", fill=ORANGE):
            p = points(polygon)
            found.append(math.atan2(-(p[0][1] - (p[1][1] + p[2][1])/2), p[0][0] - (p[1][0] + p[2][0])/2))
        return found

    def sectors(self):
        """how far the cones of velocities turn"""
        turns = []
        for polygon in self.all("polygon", fill=CONE):
            p = points(polygon)
            turns.append(area(p)/(0.5*max(math.dist(p[0], q) for q in p)**2) if len(p) == 50 else 4*area(p)/max(
                math.dist(a, b) for a in p for b in p)**2*2)
        return turns


def points(element):
    return [tuple(map(float, p.split(","))) for p in element.get("points").split()]


def area(p):
    return abs(sum(a[0]*b[1] - a[1]*b[0] for a, b in zip(p, p[1:] + p[:1])))/2


def angle_between(a, b):
    return abs((a - b + math.pi) % (2*math.pi) - math.pi)


def cones(command):
    # (law, force, arrows, turn): drawn are directions of -V
    half, whole = math.pi, 2*math.pi
    for law, force, arrows, turn in [
            ("law: {segment: [[-100, 0], [100, 0]]}", "0,0", [half/2, -half/2], None),      # across the free wheel, both ways
            ("law: {segment: [[-100, 0], [100, 0]]}", "100,0", [], half),                   # at its end
            ("law: {disc: 0}", "0,0", [], whole),
            ("law: {disc: 100}", "60,80", [math.atan2(80, 60)], None),
            ("law: {box: [3, 2]}", "3,2", [], half/2),
            ("law: {friction_cone: {friction: 0.5, dimension: 2}}", "0,0", [], half - 2*math.atan(0.5)),
            ("law: {friction_cone: {friction: 0.5, dimension: 2}}", "50,100", [-math.atan(0.5)], None),
            ("law: {subspace: [[1, 1]]}", "2,2", [3*half/4, -half/4], None)]:
        picture = Picture(command, law, f"--force={force}")
        found = picture.heads()
        expect(picture.what + ": arrows", len(found) == len(arrows) and all(
            min(angle_between(a, b) for b in found) < 0.02 for a in arrows), found)
        turns = picture.sectors()
        # 48 chords of an arc: 1 - (turn/48)^2/6, at most 0.3 %
        expect(picture.what + ": turn", len(turns) == (turn is not None) and all(abs(t - turn) < 0.01*turn for t in turns), turns)


def unbounded(command):
    # what has no bounds goes on beyond the frame: some of its border lies outside
    for law in ("{strip: {normal: [1, 2], width: 200}}", "{half_space: {normal: [1, 3], offset: 40}}",
                "{hull: [{disc: 100}, {rays: [[1, 1]]}]}", "{friction_cone: {friction: 0.5, dimension: 3}}",
                "{box: [1, [-.inf, 2]]}"):
        picture = Picture(command, f"law: {law}")
        if not picture.all("clipPath"):
            continue    # said already: it is not drawn
        frame = picture.all("clipPath")[0][0]
        left, top = float(frame.get("x")), float(frame.get("y"))
        right, bottom = left + float(frame.get("width")), top + float(frame.get("height"))
        p = [q for e in picture.all("polygon", stroke=BLUE) for q in points(e)]
        outside = [q for q in p if not (left <= q[0] <= right and top <= q[1] <= bottom)]
        inside = [q for q in p if left < q[0] < right and top < q[1] < bottom]
        expect(picture.what + ": beyond the frame", outside, p[:4])
        expect(picture.what + ": its near part is seen", inside or len(p) <= 6, p[:4])


def ticks(picture):
    """force per pixel and the pixel of force 0, of the vertical axis"""
    found = []
    for text in picture.all("text"):
        words = "".join(text.itertext()).replace("\u2212", "-")
        if re.fullmatch(r"-?[0-9.]+", words) and text.get("text-anchor") == "end":
            found.append((float(words), float(text.get("y"))))
    if len(found) < 2:
        return 1, [(0, 0)]
    (a, ya), (b, yb) = found[0], found[-1]
    return (b - a)/(yb - ya), found


def graphs(command):
    # one component: forces at each velocity, in the units of the labels
    for law, levels in [("law: {interval: 60}", (-60, 60)), ("law: {interval: [-20, 80]}", (-20, 80)),
                        ("resistance: [{dry: {interval: 20}}]", (-20, 20)),
                        ("resistance: [{dry: {interval: 20}}, {viscous: [[30]]}]", (-57.5, 57.5)),       # 20 + 30*1.25 at --velocity 1
                        ("law: {interval: [-60, .inf]}", (-60, None))]:
        picture = Picture(command, law, "--velocity", "1")
        scale, found = ticks(picture)
        lines = [e for e in picture.all("polyline") if e.get("stroke") == BLUE]
        expect(picture.what + ": one curve", len(lines) == 1, len(lines))
        if len(lines) != 1:
            continue
        y = [q[1] for q in points(lines[0])]
        zero = found[0][1] - found[0][0]/scale
        # text stands some pixels below its tick, the same for all
        values = sorted((v - zero)*scale for v in (min(y), max(y)))
        offset = (values[0] + values[1])/2 - sum(levels)/2 if levels[1] is not None else 0
        expect(picture.what + ": offset of the labels", abs(offset/scale) < 8, offset)
        expect(picture.what + ": least force", abs(values[0] - offset - levels[0]) < 0.02*abs(levels[0]) + 8*abs(scale)*(levels[1] is None), values)
        if levels[1] is None:
            expect(picture.what + ": no greatest force", values[1] > 500, values)
        else:
            expect(picture.what + ": greatest force", abs(values[1] - offset - levels[1]) < 0.02*abs(levels[1]), values)


def resistances(command, examples):
    with open(os.path.join(examples, "grease.yaml")) as file:
        law = file.read().split("capstan: 1\n")[-1]
    picture = Picture(command, law)
    curves = [e for kind in ("polygon", "polyline") for e in picture.all(kind) if e.get("fill") == "none"]
    expect("grease: five speeds", len(curves) == 5, len(curves))
    widths = [max(q[0] for q in points(c)) - min(q[0] for q in points(c)) for c in curves]
    expect("grease: faster is stronger", widths == sorted(widths), widths)
    # 3 N of dry friction and 2 N s/m: 3.4 to 5 N at 0.2 to 1 m/s
    expect("grease: by the law", len(widths) == 5 and abs(widths[0]/widths[4] - 3.4/5) < 0.01, widths)


def main():
    cones(sys.argv[1])
    unbounded(sys.argv[1])
    graphs(sys.argv[1])
    resistances(sys.argv[1], sys.argv[2])
    for fault in faults:
        print("FAULT", fault)
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
