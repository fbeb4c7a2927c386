# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/planar.md, most of them from test/figures/planar.c."""
import math

from marks import short

ELLIPTIC = {"0.25": (0.24803130976, 0.63578612361), "0.5": (0.48384375563, 0.54774835477), "1.5": (0.94081937550, 0.17379810553),
            "3": (0.98591116599, 0.08413023494)}  # F and T of a disc at e, as printed by Farkas et al. 2003
RIM = (0.64636634, 0.525790712182, 0.54711027)    # a disc driven at its rim: w R/W, gamma, centre, as printed


def of(program, name):
    return program.numbers("test", "figures", "planar_figures")[name]


def test_limit(program, name):
    return program.constant("analytic/test_planar.c", rf"double {name} = (\S+);")


def to(program, pairs, name):
    """`to 1e-13` where all pairs of found and known agree to the limit that the test has, else what they are off by."""
    off = max(abs(found - known) / abs(known) for found, known in pairs)
    limit = test_limit(program, name)
    return f"to {limit}" if off <= float(limit) else f"{off:.1g} off"


def as_printed(pairs):
    """pairs: a number found, and the text of what is printed of it."""
    return all(round(abs(found), len(text.partition(".")[2])) == float(text) for found, text in pairs)


def bounds(program):
    rows = ["| disc, radius 1, unit load, at | cells | bounds of phi, from the closed form |", "|---|---|---|"]
    for e, cells, low, high, value in of(program, "bounds"):
        rows.append(f"| ({e:g}, 0, 1) | {short(cells)} | {short(low)}, +{short(high)} of {value:.4f} |")
    return rows


def cases(program):
    ring, disc = of(program, "ring")[0], {f"{row[0]:g}": row[1:] for row in of(program, "disc")}
    rod, square, cells = of(program, "rod")[0][0], of(program, "square")[0][0], of(program, "driven-by-cells")[0]
    all_digits = all(as_printed([(x, f"{known:.11f}") for x, known in zip(disc[e], ELLIPTIC[e])]) for e in ELLIPTIC)
    right = (math.sqrt(2) + math.asinh(1)) / 6
    return ["| case | known | found |", "|---|---|---|",
            f"| ring, (1, 0, 0.5) and (1, 0, 1) | 1.0635444099733649, 4/pi | {to(program, [(ring[0], 1.0635444099733649), (ring[1], 4 / math.pi)], 'EXACT')} |",
            f"| disc, F and T at e = {', '.join(ELLIPTIC)} | eleven printed digits (Farkas et al. 2003) | {'all' if all_digits else 'not all'} |",
            f"| disc at e = 1 | 8/(3 pi), 8/(9 pi) | {to(program, [(disc['1'][0], 8 / 3 / math.pi), (disc['1'][1], 8 / 9 / math.pi)], 'EXACT')} |",
            f"| rod, (1, 0.5, 0.7) | 1.17610140974653 | {to(program, [(rod, 1.17610140974653)], 'EXACT')} |",
            f"| square in pure rotation | (sqrt2 + asinh 1)/6 = {right:.11f} | {to(program, [(square, right)], 'EXACT')} |",
            "| disc in 400 cells, driven at the rim by the conic solver of `drive.h` | "
            f"{RIM[1]} | {math.floor(1e5 * cells[0]) / 1e5:.5f} < gamma < {math.ceil(1e5 * cells[1]) / 1e5:.5f}, inner and outer law |"]


def driven(program):
    rod, disc, ring = (of(program, "driven-" + name)[0] for name in ("rod", "disc", "ring"))
    root, half = math.sqrt(2), 2 / math.pi
    rods = to(program, [(rod[3], 1 - root), (rod[1], root - 1), (rod[2], root - 1)], "FOUND")
    rings = to(program, [(ring[0], 0.5), (ring[1], half), (ring[2], half), (ring[3], -1)], "FOUND")
    discs = as_printed([(disc[0], "0.64636634"), (disc[1], "0.525790712182"), (disc[2], "0.525790712182"), (disc[3], "0.54711027")])
    return ["| pushed across at the end or rim, unit size and load | known | found |", "|---|---|---|",
            f"| rod: centre of rotation, gamma | 1/sqrt2 of its length from the end, sqrt2 - 1 | {rods} |",
            f"| disc: w R/W, gamma, centre | {RIM[0]}, {RIM[1]}, {RIM[2]} | {'all printed digits' if discs else 'not all digits'} |",
            f"| ring: w R/W, gamma, centre | 1/2, 2/pi, opposite | {rings} |"]


def car(program):
    rows = ["| steps | turning radius [m] | dissipated [J] | work - dissipated [J] |", "|---|---|---|---|"]
    for steps, radius, dissipated, defect in of(program, "car"):
        rows.append(f"| {steps:.0f} | {radius:.6f} | {dissipated:.4f} | {short(defect)} |")
    return rows


def planimeter(program):
    rows = ["| circle | points | area | error |", "|---|---|---|---|"]
    for name, circle in (("outside", "centre (1.2, 0.3), radius 0.5, pole outside"),
                         ("inside", "centre (0.1, 0), radius 1.2, pole inside: roll x arm + 1.65 pi")):
        for k, (points, area, error) in enumerate(of(program, "planimeter-" + name)):
            rows.append(f"| {circle if k == 0 else ''} | {points:.0f} | {area:.11f} | {short(error)} |")
    return rows


def errors(program, name, digits):
    """An error at each of three numbers of steps, then those."""
    rows = of(program, name)
    return [f"{error:.{digits}e}".replace("e-0", "e-") for _, error in rows] + [f"{steps:.0f}" for steps, _ in rows]


def ellipsoid(program):
    least, where = of(program, "ellipsoid")[0]
    return [f"{100 * (1 - least):.2f}", f"{least:.8f}", f"{where:.3f}"]


FIGURES = {"bounds": bounds, "cases": cases, "driven": driven, "car": car, "planimeter": planimeter}
SENTENCES = [
    ("with 8 points takes over, with {} of the value left", lambda p: short((4 + math.sqrt(15)) ** -16)),
    ("correct to rounding at every twist, {} in the tests", lambda p: test_limit(p, "EXACT")),
    ("over ever finer cells until they are {} apart", lambda p: p.constant("planar/bounds.c", r"TOLERANCE = (\S+);")),
    ("falls as 1/cells, about {}/cells for a disc", lambda p: f"{of(p, 'cells')[0][1]:.1f}"),
    ("by up to {} % along a ray: the exact surface is at {} of it for v/(R w) = {}", ellipsoid),
    ("On {} random bodies", lambda p: p.constant("unit/test_planar.c", r"i < (5\d*); i\+\+")),
    ("all are solved, bounds {} apart or nearer", lambda p: p.constant("unit/test_planar.c", r"motion\.upper - motion\.lower, (\S+) ?\* ?fmax")),
    ("comes out the same, to {}, as the sum", lambda p: p.constant("analytic/test_planar.c", r"answer\.value, expected, (1e-9)\)")),
    ("with errors of {}, {}, {} m at {}, {}, {} steps and no dissipation", lambda p: errors(p, "axle", 1)),
    ("keeps the rope's length to {} m", lambda p: p.constant("test_planar_paths.c", r"towed\[2\]\.worst_hitch, (\S+)\)")),
    ("with errors {}, {} and {} at {}, {} and {} steps: first order", lambda p: errors(p, "spring", 2)),
    ("takes 4 fN (A - fN/k) = 6 J, to {} at any", lambda p: p.constant("test_planar_paths.c", r"sweep\.dissipated - dissipated, 6, (\S+)\)")),
    ("looked for up to {} times the driven speed", lambda p: p.constant("planar/motion.c", r"\bFAR = (\S+);")),
]
GIVEN = ["A car of 18 kN with parallel steering at 0.2 rad and all brakes on, drawn by its nose 30 m along an arc of 15 m", "tracer arm 1.3, wheel at 0.4"]
