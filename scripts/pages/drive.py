# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/drive.md."""
import json
import os
import re

from laws import random_tests, vector
from marks import read, short


def motion(program, path, *asked):
    return json.loads(program.call("drive", path, "--json", *asked))["answers"]


def first_system(program):
    a = motion(program, "examples/drive/braked-wheel.yaml", "-v", "1,1")[0]
    return [f"gamma(W) = {a['gamma_W']:.9g} W, V = ({', '.join(f'{v:.8f}' for v in a['V'])}): as `examples/drive/braked-wheel.yaml` at W = (1, 1)."]


def systems(program):
    rows = ["| `examples/drive/` | W | outcome | gamma [W] | V | motions | forces |", "|---|---|---|---|---|---|---|"]
    for name in ("braked-wheel", "braked-wheel-equal", "braked-wheel-locked", "free-wheel", "slipping-hitch", "slope-load", "winch"):
        for a in motion(program, f"examples/drive/{name}.yaml"):
            few = {key: "one" if a[key].get("unique") else "open" if "dimension" not in a[key] else f"dimension {a[key]['dimension']}"
                   for key in ("velocities", "forces")}
            scale = max(abs(v) for v in a["V"]) if a["V"] else 0
            v = vector([x if abs(x) > 1e-9*scale else 0 for x in a["V"]])
            rows.append(f"| `{name}` | {vector(a['velocity'])} | {a['outcome'][len('CPS_MOTION_OUTCOME_'):]} | {a['gamma_W']:.6g} | "
                        f"{v if few['velocities'] == 'one' else 'not unique'} | {few['velocities']} | {few['forces']} |")
    return rows


def ropes(program):
    rows = ["| elements | gamma / (f w L) | bounds apart |", "|---|---|---|"]
    text = read(os.path.join(program.root, "examples", "drive", "rope-straight.yaml"))
    text = text[:text.index("  path:")]
    for n in (10, 100, 1000):
        path = program.file(f"rope-{n}.yaml", text.replace("elements: 100", f"elements: {n}"))
        a = json.loads(program.call("drive", path, "--json"))
        below = "below 1e-8" if abs(a["upper_W"] - a["lower_W"]) < 1e-8*a["upper_W"] else "more"
        rows.append(f"| {n} | {a['gamma_W']:.6g} | {below} |")
    return rows


def times(program):
    rows = ["| nodes | elements | s | us per node | iterations | gap / scale |", "|---|---|---|---|---|---|"]
    for line in program.output("bench", "drive_bench").splitlines()[1:]:
        nodes, elements, seconds, each, iterations, gap, _ = line.split()
        rows.append(f"| {nodes} | {'rigid' if elements == 'rigid' else 'may shorten'} | {float(seconds):.2g} | {float(each):.0f} | {iterations} | {short(float(gap))} |")
    return rows


def same_times(old, new):
    """Words, nodes and iterations the same, gaps of rounding within a factor of 10; times within 20, as machines and their load differ."""
    old, new = ([cell.strip() for cell in row.split("|")] for row in (old, new))
    if len(old) < 7 or not old[1].isdigit():
        return old == new
    within = lambda k, factor: float(old[k]) <= factor * float(new[k]) and float(new[k]) <= factor * float(old[k])
    return old[1:3] == new[1:3] and old[5] == new[5] and within(3, 20) and within(4, 20) and within(6, 10)


def random_systems(program):
    """Of those in every run: how many, with a motion, sets of solutions, and those without an answer."""
    few = re.search(r'sampled\(random_systems "--cases (\d+)"', read(os.path.join(program.root, "test", "property", "CMakeLists.txt")))[1]
    said = program.output("test", "property", "random_systems", "--cases", few)
    found = re.search(r"(\d+) systems: (\d+) solved, .* (\d+) of (\d+) sets of solutions open", said)
    return [found[1], found[2], program.constant("random_systems.c", r"double GAP = (\S+);"), found[4], found[3]]


def wheels(program):
    """Strengths of the brake over the ground, sizes, and the least component of W beside the other, of extreme_motions.c."""
    beta = [float(b) for b in program.constant("extreme_motions.c", r"BETA\[\] = \{([^}]*)\}").split(",")]
    size = program.constant("extreme_motions.c", r"\* ?pow\(10, digit\((\d)\)\), speed")
    least = int(program.constant("extreme_motions.c", r"-below\((\d+)\)\);")) - 1
    return [short(min(beta)), short(max(beta)), f"1e-{size}", f"1e{size}", f"1e-{least}"]


FIGURES = {"times": times, "first-system": first_system, "systems": systems, "ropes": ropes,
           "random-systems": lambda p: random_tests(p, ("random_systems", "random_flat_laws", "random_extremes"))}
LOOSELY = {"times": same_times}
SENTENCES = [
    ("means bounds within `tolerance` ({}) of the power scale", lambda p: p.constant("drive/motion.c", r"\.tolerance = (\S+), \.boundary")),
    ("the load factor is 1 within `boundary` ({})", lambda p: p.constant("drive/motion.c", r"\.boundary = (\S+),")),
    ("a friction of {}, and of {}, of the forces' size", lambda p: [p.constant("drive/attainment.c", rf"\b{name} = ([^,;]+)[,;]") for name in ("STRONG", "WEAK")]),
    ("and {} times as fast as the drive, the velocities", lambda p: p.constant("drive/attainment.c", r"\bFAR = (\d+);")),
    ("more than about {} times as fast as the drive cannot be", lambda p: p.constant("drive/attainment.c", r"less than (\S+) times the driving")),
    ("The tolerance (default {}) decides", lambda p: p.constant("drive/solutions.c", r"TOLERANCE = (\S+);")),
    ("limited to {} entries", lambda p: short(int(p.constant("sparse_program.c", r"MOST_ENTRIES = \(size_t\) ?(\d+) << 20")) * 2 ** 20)),
    ("Of the {} of every run, with {} motions, each one was certified with a gap of at most {} of its power scale; of {} sets of all solutions {} had", random_systems),
    ("sizes differ by up to {}.", lambda p: short(10 ** (2 * int(p.constant("random_systems.c", r"\.size = pow\(10, uniform\(-(\d), "))))),
    ("wheels whose brake is from {} to {} times as strong as the ground or just as strong along the drive, in sizes from {} to {} and at W with components down to {} of the others", wheels),
    ("must be right to {} of the drive", lambda p: p.constant("extreme_motions.c", r"4e-5 ?\* ?speed, (\S+?) ?\* ?speed")),
    ("the tolerance of their sets, {} of the largest", lambda p: p.constant("extreme_motions.c", r"allowed = (\S+?) ?\* ?fmax\(wheel")),
]
GIVEN = ["at an angle of 60 degrees"]
