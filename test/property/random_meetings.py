# SPDX-License-Identifier: BSD-3-Clause
"""Lines whose ends meet exactly on a bed that is smooth, mostly: each step has to be certified, though nothing but the line's weight
and rounding is there to work with.                                usage: random_meetings.py CAPSTAN [--scenes N] [--seed S]

Lengths, weights, stiffnesses and meshes of all sizes, beds that lean, lines laid straight, in an arc, with a bend or by statics; end B goes to
where end A is, aside first or not, on to elsewhere and back, is let go there, or both are carried off together. Where the ends are is known.
"""
import argparse
import csv
import math
import os
import random
import subprocess
import sys
import tempfile

COUNTS = (2, 3, 5, 10, 20, 50, 101, 200)


def vector(v):
    return "[" + ", ".join(repr(c) for c in v) + "]"


class Bed:
    """A plane through a point of the line, with axes f and g in it."""

    def __init__(self, draw, length):
        self.length, u = length, draw.uniform
        self.point = [0.0, 0.0, 0.0] if draw.random() < 0.5 else [u(-3, 3) * length, u(-3, 3) * length, u(-1, 1) * length]
        lean = u(-0.2, 0.2) if draw.random() < 0.2 else 0.0
        turn = u(0, 2 * math.pi)
        self.f = [math.cos(turn) * math.cos(lean), math.sin(turn) * math.cos(lean), math.sin(lean)]
        self.g = [-math.sin(turn), math.cos(turn), 0.0]
        self.normal = [-math.cos(turn) * math.sin(lean), -math.sin(turn) * math.sin(lean), math.cos(lean)]

    def at(self, x, y, z=0.0):
        return [p + self.length * (x * a + y * b + z * n) for p, a, b, n in zip(self.point, self.f, self.g, self.normal)]


def start_of(draw, bed):
    """The start shape, and where it puts end B (None: as it comes)."""
    kind, a = draw.choice(("straight", "arc", "static", "bend")), bed.at(0, 0)
    if kind == "straight":
        return f"{{straight: {{from: {vector(a)}, to: {vector(bed.at(1, 0))}}}}}", None
    if kind == "arc":
        radius = 1 / (2 * math.pi * draw.uniform(0.2, 0.8))
        return f"{{arc: {{from: {vector(a)}, centre: {vector(bed.at(0, radius))}, axis: {vector(bed.normal)}}}}}", None
    if kind == "bend":
        share, angle = draw.uniform(0.3, 0.7), draw.uniform(-2.5, 2.5)
        end = bed.at(share + (1 - share) * math.cos(angle), (1 - share) * math.sin(angle))
        return f"{{polyline: [{vector(a)}, {vector(bed.at(share, 0))}, {vector(end)}]}}", None
    return "static", bed.at(draw.uniform(0.2, 0.99), 0)


def history_of(draw, bed):
    """Entries, and where end B is after each (None: free)."""
    u, entries, places = draw.uniform, [], []

    def go(place, steps=1):
        entries.append(f"{{rope.B: {{position: {vector(place)}}}, steps: {steps}}}")
        places.append(place)

    if draw.random() < 0.4:
        go(bed.at(u(-0.5, 0.5), u(-0.5, 0.5), u(0, 0.3) if draw.random() < 0.5 else 0.0))
    go(bed.at(0, 0), draw.choice((1, 1, 2, 5)))
    if draw.random() < 0.5:
        go(bed.at(u(-0.5, 0.5), u(-0.5, 0.5)))
        go(bed.at(0, 0))
    if draw.random() < 0.3:
        entries.append("{rope.B: {force: [0, 0, 0]}}")
        places.append(None)
    elif draw.random() < 0.3:
        place = bed.at(0.3, 0.1)
        entries.append(f"{{rope.A: {{position: {vector(place)}}}, rope.B: {{position: {vector(place)}}}}}")
        places.append(place)
    return entries, places


def scene(draw):
    """The text of a scene, where end B has to be after each entry, and the line's length."""
    length, weight, count = 10 ** draw.uniform(-3, 4), 10 ** draw.uniform(-6, 5), draw.choice(COUNTS)
    bed = Bed(draw, length)
    start, held = start_of(draw, bed)
    graded = draw.random() < 0.3
    if start.startswith("{arc"):
        count, graded = max(count, 10), False  # no element is longer than the circle is wide
    raw = [math.exp(draw.uniform(0, 3)) if graded else 1.0 for _ in range(count)]
    elements = [length * r / sum(raw) for r in raw]
    stiffness = ".inf" if draw.random() < 0.25 else repr(10 ** draw.uniform(-1, 6) * weight * length)
    friction = 0.0 if draw.random() < 0.8 else draw.uniform(0.01, 0.5)
    ends = ("{held: " + vector(bed.at(0, 0)) + "}", "{held: " + vector(held) + "}") if held else ("held", draw.choice(("held", "held", "free")))
    entries, places = history_of(draw, bed)
    text = f"""capstan: 1
friction_policy: {draw.choice(("frozen", "consistent"))}
contact_policy: {draw.choice(("reached", "reached", "reference"))}
obstacles: {{bed: {{plane: {{point: {vector(bed.point)}, normal: {vector(bed.normal)}}}, friction: {friction!r}}}}}
lines:
  rope: {{length: {length!r}, elements: {vector(elements)}, weight: {weight!r}, stiffness: {stiffness}, start: {start}, ends: {{A: {ends[0]}, B: {ends[1]}}}}}
history:
""" + "".join(f"  - {entry}\n" for entry in entries)
    return text, places, length


def fault_of(capstan, draw):
    text, places, length = scene(draw)
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scene.yaml"), "w", encoding="utf-8") as file:
            file.write(text)
        done = subprocess.run([capstan, "run", "scene.yaml", "-o", "out", "--no-paraview", "--fields", "none"], cwd=folder, capture_output=True, text=True,
                              timeout=300)
        if done.returncode != 0:
            return f"exit code {done.returncode}\n{done.stdout.split(chr(10) * 2)[0]}\n{done.stderr}\n{text}"
        with open(os.path.join(folder, "out", "history.csv"), newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file)][1:]
    last = {row["name"].split(" ")[1].split("/")[0]: row for row in rows if row["name"].startswith("entry")}
    for number, place in enumerate(places, 1):
        found = [float(last[str(number)]["rope.B." + c]) for c in "xyz"]
        if not all(math.isfinite(c) for c in found) or (place and max(abs(a - b) for a, b in zip(found, place)) > 1e-9 * length):
            return f"entry {number}: end B at {found}, expected {place}\n{text}"
    return None


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("capstan")
    arguments.add_argument("--scenes", type=int, default=400)
    arguments.add_argument("--seed", type=int, default=8)
    given = arguments.parse_args()
    faults = []
    for number in range(given.scenes):
        fault = fault_of(os.path.abspath(given.capstan), random.Random(given.seed * 1000003 + number))
        if fault:
            faults.append(f"scene {number}: {fault}")
    print("\n".join(faults))
    print(f"random_meetings: seed {given.seed}, {given.scenes} scenes, {len(faults)} not certified or elsewhere")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
