# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/theory.md: constants of the program, and what tests find."""
import math
import re

from marks import short


def number(where, name):
    """A constant of the program."""
    return lambda p: p.constant(where, rf"\b{name}\s+(?:= )?(-?[\d.]+(?:e-?\d+)?)\b")


def numbers(*constants):
    return lambda p: [number(*c)(p) for c in constants]


def in_vain(p):
    most, beside, sets = numbers(*(("evolve/substeps.c", n) for n in ("MAX_WASTED_WORK", "NODES_BESIDE", "SET_COST")))(p)
    return [f"{float(most) / 1e6:g}", beside, sets]


def locked(p):
    """mu tan(d/2) where a bend is taken for locked, and its k = (1 + mu tan(d/2))/(1 - mu tan(d/2))."""
    most = number("cable/bend.c", "LOCKED")(p)
    return [most, f"{(1 + float(most)) / (1 - float(most)):.0f}"]


def percent(where, name):
    return lambda p: f"{100 * float(number(where, name)(p)):g}"


def mesh_error(p):
    """Of the errors over their estimates in the test `mesh_error`: the least and the largest without friction."""
    found = re.findall(r"(?:hanging|laid on a bed) +error over estimate: least ([\d.]+),.* largest ([\d.]+);", p.output("test", "analytic", "test_mesh_error"))
    return [p.constant("test_mesh_error.c", r"solve\(&m, (\d+) ?\* ?n, fine\)"), min(low for low, _ in found), f"{max(float(high) for _, high in found):.1f}"]


def mesh_error_moved(p):
    return list(re.search(r"moved with friction.*; (\d+) of (\d+) within", p.output("test", "analytic", "test_mesh_error")).groups())


def balanced(p):
    """What is left of the forces on points, per largest force, and in units of the tolerance."""
    times = number("evolve/trial.c", "BALANCED")(p)
    return [short(float(times) * 1e-8), times]


def strategy(field, begins):
    """A number of the rows that begin so in the table of strategies; of several the same in all."""
    return lambda p: p.constant("cable/line_step.c", begins + r"[^}]*?\." + field + r" = (\d+)\b")


FIGURES = {}
SENTENCES = [
    ("and h becomes h max(1/5, min(2, {} (E/e)^(1/3)))", lambda p: [number("evolve/pace.c", "CAUTION")(p)]),
    ("are no longer than asked for, and no shorter than {} of that", lambda p: [number("evolve/pace.c", "LEAST")(p)]),
    ("or not finite, the residual is {} N", number("cable/potential.c", "NOT_USABLE")),
    ("psi(x_R) = 0 }, to {} of the length", number(".h", "CPS_TOUCH")),
    ("and the proof counts beyond {} of the", number("cable/existence.h", "CPSI_LEAST_POWER")),
    ("besides what {} of the longest line, to which places are known", number(".h", "CPS_TOUCH")),
    ("at mu theta = 6 pi, a ratio of tensions of {}", lambda p: short(math.exp(6 * math.pi))),
    ("when no touching node's axes turned by more than {} rad", number("cable/rounds.c", "AXES_TOL")),
    ("they turned by no more than {} rad and not by half", number("cable/rounds.c", "AXES_ROUNDING")),
    ("They may be {}, or {} if they converge.",
     lambda p: [strategy("rounds", r"\{\.unless = STATIC_ROUNDS,")(p), number("cable/rounds.c", "MAX_CONVERGING_ROUNDS")(p)]),
    ("as a slow sequence, up to {} rounds without acceleration", strategy("rounds", r"\{\.when = LOCAL_AXES, (?=\.rounds)")),
    ("evaluates its certificate every {} rounds.", strategy("patience", r"\{\.when = LOCAL_AXES, (?=\.rounds)")),
    ("up to {} rounds go on from the reference", strategy("rounds", r"\{\.when = ROUNDS,")),
    ("its reaction below {} of the unit of force", number("cable/line_solve.c", "LEAST_REACTION")),
    ("The drag begins with {} units of force", number("evolve/relaxation.c", "FIRST_DRAG")),
    ("drag times motion is below {} of the unit of force, and the motion below {} of the length",
     numbers(("evolve/relaxation.c", "REST_FORCE"), ("evolve/relaxation.c", "REST_MOTION"))),
    ("The motion covers at most {}/{} of what is left", lambda p: [f"{1 / float(number('evolve/substeps.c', 'LAST_SHARE')(p)) - 1:g}", f"{1 / float(number('evolve/substeps.c', 'LAST_SHARE')(p)):g}"]),
    ("Normals that differ by less than {} make", number("cable/step_program.c", "PARALLEL")),
    ("have cost {} 10^6 iterations times nodes ({} added to them, or {} times as many", in_vain),
    ("A substep with E above {} % of that", percent("evolve/substeps.c", "OPEN_ENERGY_SHARE")),
    ("what the certificate and places known to {} of the length leave of an energy (gap + {} F L)",
     lambda p: [number(".h", "CPS_TOUCH")(p)] * 2),
    ("is below half of that of the substep and below {} %;", percent("evolve/substeps.c", "OPEN_ENERGY_SHARE")),
    ("is largest; beyond {} % a warning", percent("cable/bend.c", "RATIO_TOL")),
    ("the turn at which they differ by {} %. With mu tan(d/2) >= {}, k = {},", lambda p: [percent("cable/bend.c", "RATIO_TOL")(p), *locked(p)]),
    ("no gap is asked to be less than {} F0 L", number("cable/certificate.c", "GAP_FLOOR")),
    ("of the gap is what the loop ({})", number("cable/line_solve.h", "CPSI_TARGET")),
    ("gap <= tolerance S ({} unless", lambda p: p.constant("evolve/scene_check.c", r"\.tolerance = (\S+?)[,}]")),
    ("Against meshes {} times as fine the error is {} to {} times", mesh_error),
    ("{} of {} moorings moved in ten steps", mesh_error_moved),
    ("Directions within {} rad are taken as one", number("cable/force_set.c", "ANGLE")),
    ("with the cones widened by {} of the largest force", number("cable/force_set.c", "CONE_SLACK")),
    ("shorter than its length by less than {} of it", number("cable/force_set.c", "EXACT")),
    ("or if it moved by less than {} L.", number("cable/force_set.c", "EXACT")),
    ("If the sum exceeds L (1 + {})", number("cable/held.h", "CPSI_TAUT")),
    ("exactly straight (within {} of its length)", number("cable/held.h", "CPSI_TAUT")),
    ("a line longer by one part in {}:", lambda p: f"{1 / float(number('cable/held.h', 'CPSI_TAUT_SLACK')(p)):.0e}".replace("+0", "")),
    ("Where the tensions found are more than {} times what acts on the group", number("evolve/joint_answer.c", "STRAINED")),
    ("the forces are those of lines longer by one part in {}, as for a single line", lambda p: f"{1 / float(number('cable/held.h', 'CPSI_TAUT_SLACK')(p)):.0e}".replace("+0", "")),
    ("a point that is as near as {} of its longest line", lambda p: f"{float(number('cable/held.h', 'CPSI_TAUT_SLACK')(p))**0.5:.0e}".replace("e-0", "e-")),
    ("turns a body by more than {} taken with the other sign", number("evolve/first_guess.c", "FAR")),
    ("a round that turns no body by more than {}, of which the square", number("evolve/body_rounds.c", "LINEAR")),
    ("longer than their ways by one part in {}, with tensions", lambda p: "1e" + p.constant("random_taut_bodies.c", r"share = pow\(10, uniform\(-(\d+),")),
    ("To this comes what {} roundings of coordinates", number("evolve/trial.c", "ROUNDINGS")),
    ("nor turns by more than {} rad: a displacement", number("evolve/newton_step.c", "FARTHEST_TURN")),
    ("at places at most {} rad apart where it turns", number("evolve/shifts.c", "PATH_ANGLE")),
    ("P_k must exceed {} of the sum", number("evolve/substeps.c", "SLIDES_LEAST")),
    ("farther than {} lengths from where the step began", number("cable/line_solve.c", "MAX_DISPLACEMENT")),
    ("The loop runs down to a relative gap of {},", number("cable/line_solve.h", "CPSI_TARGET")),
    ("is not below {} of s0 z0", number("ipm/soc.h", "CPSI_SOC_ROUNDING")),
    ("no direction is held more stiffly than that of a slip of {} of the length", number("chain/active_system.c", "NO_SLIP")),
    ("past a torus the least of at most {} parts is taken", number("geometry/shape_rounded.c", "MOST_PARTS")),
    ("it ends when the sum of the changes is below {} of the largest force", number("cable/flow.h", "CPSI_FOLLOWED")),
    ("It ends when the sum of the changes is below {} of the largest force", number("cable/flow.h", "CPSI_FOLLOWED")),
    ("are as forces, at most {}; within that", number("chain/active_set.c", "MOST_NOISE")),
    ("it is held by a stiffness of {} that pulls it to where", number("chain/active_system.c", "PULLING")),
    ("du + rho + e dz with e = {} in", number("chain/constraints.h", "CPSI_YIELD")),
    ("an excess of less than {} of these releases nothing", number("chain/active_status.c", "SIGNIFICANT")),
    ("a coordinate is more than {} of the shortest element", number("chain/active_set.c", "MOST_NOISE")),
    ("of all equations are rounding, {} eps (1 + |u|/l)", number("chain/active_set.c", "ROUNDINGS")),
    ("between nodes at rest is known to {} eps/l only", number("chain/active_set.c", "COORDINATE_ROUNDINGS")),
    ("After {} linear systems, or {} without progress,", numbers(("chain/active_set.c", "MOST_STEPS"), ("chain/active_set.c", "PATIENCE"))),
    ("moreover its gap must be at most {} of its scale", number("cable/line_solve.h", "CPSI_TARGET")),
    ("A node slips where it has moved by more than {} L on", number(".h", "CPS_TOUCH")),
    ("Points count as found up to {} (at the default tolerance; {} times the tolerance)", balanced),
    ("Up to {} points it is dense.", number("linalg/graph_matrix.c", "DENSE")),
    ("First rounds stop at a gap of {}, the others at {}, until no normal of a point that touches turns by more than {}.",
     numbers(*(("evolve/first_guess.c", n) for n in ("ROUGH", "FINE", "ON_ITS_PLANE")))),
    ("of its rounds, in which no axes turn by more than {}, as of a line", number("evolve/first_guess.c", "TURNS_NO_MORE")),
    ("where the search fails, of groups of more than {} points where it has not", number("evolve/balance.c", "MANY")),
    ("those with d_i up to {} r take part", lambda p: f"{1 + float(number('geometry/shape_mesh.c', 'RANGE')(p)):g}"),
    ("from a guess to {} with the refinement of", number("evolve/first_guess.c", "REFINED")),
    ("its friction is at its bound to {};", number("cable/report.c", "AT_BOUND")),
    ("= 0.0255 x 1 x 9.81 = {} N/m", lambda p: f"{0.0255 * 9.81:.6f}"),
    ("and {} eps of all terms are added", number("drive/certificate.c", "ROUNDING")),
]
# data of the papers, exponents of formulas, and what double precision is
GIVEN = ["as with 1e6 elements of a rope", "and n_z is at least 0.1", "and so on down to 1e-4", "has after 1e6 rad at 200 km", "loop has to come to a gap of 1e-11", "to 0.1/n^2 where this is less", "of the equations exceed 1e-2 in the solution", "as if these were two obstacles (2.8), each", "beside a fold of a mesh (2.3), as do", "or out of it, with up to 0.06 % more energy", "The curvature of rounds (2.4)", "said of round obstacles in 2.7", "across the middle (2.7)", "**Contacts of elements** (2.7) are like", "the term R K of 2.4", "less (length/R)^2/24 of it", "between +1/24 and -1/12 of w h^2/H", "up to 29 % shorter", "below (length/r)^2/18", "A value is a sum of 16 points", "is counted beside it (2.9)", "Ann. Fac. Sci. Toulouse 11 (1990) 137–186", "up to l = 1.3 R", "at most 90 degrees", "a path of 350 degrees is not taken for one of -10",
         "d^3/12 and more", "positions and reactions (1e-16)", "lie 1e-7 beside", "lemma 9.6 for 7.6", "\"A = 0.25 N\"",
         "slack on 0.6 of its length", "120 degrees apart, and three lines of 0.9 to one point", "and lack 0.3 m all the same"]
