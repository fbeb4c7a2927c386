# SPDX-License-Identifier: BSD-3-Clause
"""The spar of OC3-Hywind under thrust on and off, from examples/oc3-hywind.yaml with other meshes and thrusts: a table and a picture."""
import math
import os

from marks import read, table, write

MESHES = [50, 100, 200, 400]
# the thrust along x, and the line that leads: the second (and third) behind, or the first ahead
WAYS = {"between two lines": (400e3, "second"), "along one line": (-400e3, "first")}
PER_CYCLE, STAGE = 8, 4


def history(program, thrust, elements, steps=STAGE):
    """What happens in a history of three cycles: the rows of bodies.csv and of history.csv."""
    text = read(os.path.join(program.root, "examples", "oc3-hywind.yaml"))
    text = text.replace("force: [400e3,", f"force: [{thrust:g},").replace("elements: 100", f"elements: {elements}").replace("steps: 4", f"steps: {steps}")
    scene = program.file(f"spar-{thrust:g}-{elements}-{steps}.yaml", text)
    _, place = program.run("run", scene, "--no-paraview")
    return table(os.path.join(place, "bodies.csv")), table(os.path.join(place, "history.csv"))


def numbers(program, way, elements):
    """Offset and heel under the first full thrust, the leading anchor's tension, what of its line lies on the bed, and the widths of the loops."""
    thrust, line = WAYS[way]
    bodies, lines = history(program, thrust, elements)
    x = [float(row["x"]) for row in bodies]
    full = STAGE

    def width(cycle):
        """Between going out and coming back, at half the thrust."""
        return abs(x[PER_CYCLE*cycle + STAGE + 2] - x[PER_CYCLE*cycle + 2])
    return [x[full], float(bodies[full]["heel"]), float(lines[full][f"{line}.A.tension"])/1e3, float(lines[full][f"{line}.grounded"]),
            x[2*STAGE] - x[0], width(0), width(2)]


def thrust(program):
    lines = ["| thrust of 400 kN | elements a line | offset [m] | heel [degrees] | anchor [kN] | on the bed [m] | left after the first cycle [m] "
             "| width of the first loop [m] | of the third [m] |", "|---|---|---|---|---|---|---|---|---|"]
    for way in WAYS:
        for elements in MESHES:
            row = numbers(program, way, elements)
            lines.append(f"| {way} | {elements} | " + " | ".join(f"{value:.{places}f}" for value, places in zip(row, (3, 3, 1, 1, 3, 3, 3))) + " |")
    return lines


# ---- the line that lifts ----

LENGTH, WEIGHT, STIFFNESS, ANCHOR, DEPTH = 902.2, 698.094, 384.243e6, 853.87, 320.0


def hanging(height):
    """H and span of an elastic catenary that is level at its lower end and hangs wholly: V = w L, z = (H/w)(sqrt(1 + (V/H)^2) - 1) + w L^2/(2 EA)."""
    v, low, high = WEIGHT*LENGTH, 1e4, 1e9
    for _ in range(200):
        h = math.sqrt(low*high)
        rise = h/WEIGHT*(math.sqrt(1 + (v/h)**2) - 1) + WEIGHT*LENGTH**2/(2*STIFFNESS)
        low, high = (h, high) if rise > height else (low, h)
    return low, low/WEIGHT*math.asinh(v/low) + low*LENGTH/STIFFNESS


def lifts(program):
    """At which thrust along one line that line hangs wholly: its anchor is pulled up no less than down."""
    lines = ["| elements a line | thrust [kN] | offset [m] | tension of the anchor [N] | closed form [N] | span [m] | closed form [m] |", "|---|---|---|---|---|---|---|"]
    text = read(os.path.join(program.root, "examples", "oc3-hywind.yaml"))
    text = text[:text.index("history:")] + "history:\n" + "".join(
        f"  - {{name: to {force}, steps: {steps}, spar.body: {{force: [-{force}e3, 0, 0], arm: [0, 0, 90]}}}}\n" for force, steps in ((400, 4), (440, 20)))
    thrusts = [0, 100, 200, 300, 400] + [400 + 2*k for k in range(1, 21)]
    for elements in MESHES:
        scene = program.file(f"spar-lifts-{elements}.yaml", text.replace("elements: 100", f"elements: {elements}"))
        _, place = program.run("run", scene, "--no-paraview")
        rows = [{**a, **b} for a, b in zip(table(os.path.join(place, "bodies.csv")), table(os.path.join(place, "history.csv")))]
        # the anchor's uplift is without what the bed bears: of the whole force on the line there
        k = next(k for k in range(1, len(rows)) if float(rows[k]["first.A.fz"]) <= 0)
        before, after = -float(rows[k - 1]["first.A.fz"]), -float(rows[k]["first.A.fz"])
        share = -before/(after - before)

        def at(name):
            return (1 - share)*float(rows[k - 1][name]) + share*float(rows[k][name])
        h, span = hanging(at("first.B.z") + DEPTH)
        thrust_there = (1 - share)*thrusts[k - 1] + share*thrusts[k]
        lines.append(f"| {elements} | {thrust_there:.1f} | {at('x'):.3f} | {abs(at('first.A.fx')):.0f} | {h:.0f} | {ANCHOR - at('first.B.x'):.3f} | {span:.3f} |")
    return lines


# ---- the picture ----

WIDTH, HEIGHT, GAP, LEFT, TOP = 350, 200, 90, 70, 60
COLOURS = ["#e07b39", "#3b8ea5", "#222222"]


def ticks(least):
    """1, 2 or 5 times a power of ten, no less than this."""
    power = 10**math.floor(math.log10(least))
    return next(n*power for n in (1, 2, 5, 10) if n*power >= least)


def panel(x, y, curves, labels):
    """A frame with one curve per cycle."""
    (x0, x1), (y0, y1) = ((min(v), max(v)) for v in zip(*(p for curve in curves for p in curve)))
    step = ticks((y1 - y0)/4)
    y0, y1 = step*math.floor(y0/step), step*math.ceil(y1/step)
    rows = round((y1 - y0)/step)

    def at(point):
        return f"{x + WIDTH*(point[0] - x0)/(x1 - x0):.1f},{y + HEIGHT*(1 - (point[1] - y0)/(y1 - y0)):.1f}"
    out = [f'<rect x="{x}" y="{y}" width="{WIDTH}" height="{HEIGHT}" fill="#fdfdfd" stroke="#999"/>']
    for k in range(5):
        place, value = x + WIDTH*k/4, x0 + (x1 - x0)*k/4
        out.append(f'<text x="{place:.1f}" y="{y + HEIGHT + 16}" text-anchor="middle">{value:.0f}</text>')
    for k in range(rows + 1):
        place, value = y + HEIGHT*(1 - k/rows), y0 + step*k
        out.append(f'<text x="{x - 6}" y="{place + 4:.1f}" text-anchor="end">{value:.0f}</text>')
        out.append(f'<line x1="{x}" x2="{x + WIDTH}" y1="{place:.1f}" y2="{place:.1f}" stroke="#e4e4e4"/>')
    out.append(f'<text x="{x + WIDTH/2}" y="{y + HEIGHT + 34}" text-anchor="middle">{labels[0]}</text>')
    out.append(f'<text x="{x}" y="{y - 8}">{labels[1]}</text>')
    for colour, curve in zip(COLOURS, curves):
        out.append(f'<polyline fill="none" stroke="{colour}" stroke-width="1.8" points="{" ".join(map(at, curve))}"/>')
    return out


def loops(program):
    """Tension of the leading anchor, and what of its line lies on the bed, against the thrust, cycle by cycle."""
    steps = 16
    out = ['<svg xmlns="http://www.w3.org/2000/svg" width="920" height="625" font-family="sans-serif" font-size="12" fill="#222">',
           '<rect width="920" height="625" fill="#fff"/>',
           '<text x="24" y="26" font-size="17" font-weight="bold">OC3-Hywind under thrust on and off, mu = 0.5</text>']
    for column, (way, (force, line)) in enumerate(WAYS.items()):
        _, rows = history(program, force, 200, steps)
        for place, (quantity, scale, label) in enumerate([("A.tension", 1e-3, "anchor tension (kN)"), ("grounded", 1, "on the bed (m)")]):
            cycles = []
            for cycle in range(3):
                first = 2*steps*cycle
                shares = [k/steps for k in range(steps + 1)] + [1 - k/steps for k in range(1, steps + 1)]
                cycles.append([(400*share, scale*float(rows[first + k][f"{line}.{quantity}"])) for k, share in enumerate(shares)])
            out += panel(LEFT + column*(WIDTH + GAP), TOP + place*(HEIGHT + 70), cycles, ("thrust (kN)", f"{label}, thrust {way}"))
    for k, (colour, name) in enumerate(zip(COLOURS, ("first cycle", "second", "third"))):
        out.append(f'<line x1="{LEFT + 120*k}" x2="{LEFT + 120*k + 24}" y1="605" y2="605" stroke="{colour}" stroke-width="2"/>')
        out.append(f'<text x="{LEFT + 120*k + 30}" y="609">{name}</text>')
    path = os.path.join(program.folder, "spar-thrust.svg")
    write(path, "\n".join([*out, "</svg>"]) + "\n")
    return path
