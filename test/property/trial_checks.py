# SPDX-License-Identifier: BSD-3-Clause
"""What a history must keep that no single step tells, from the scene and result.nc alone: numbers that are numbers, places where nothing
happens, the ledger over all parts of a step, the way round posts, and a history whose ends bear each other's names."""
import math

SOLVED, TAUT = 0, 1
FINAL = (4, 5, 7)  # proofs that there is no answer
# a step in which nothing happens moves less than this per length
STILL = 1e-9
# histories with exchanged ends agree to this per length
SAME = 1e-6
# parts of what is dissipated and worked that may be made, or set free, without a word
MADE, FREED = 0.05, 0.5
# what may be no number: what is told only of some lines, ends and outcomes
MAY_BE_NONE = ("proof", "proof_length", "proof_force", "end_held_position", "end_applied_force", "motion", "end_tension_least", "end_tension_least_bound", "end_tension_greatest",
               "end_tension_greatest_bound", "tension_bound", "tension_mesh", "utilisation", "utilisation_at", "contact_gap", "contact_gap_second", "element_contact_gap",
               "normal", "normal_second", "element_normal")
# no place may be farther from where the step begins, and no force larger, than this times what the scene is made of: an answer that is not
# certified ends within 1e4 lengths along each axis (docs/theory.md, 5)
SANE = 2e4


def point(numbers, j):
    return numbers[3*j:3*j + 3]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def size(a):
    return math.sqrt(sum(x*x for x in a))


def inner(a, b):
    return sum(x*y for x, y in zip(a, b))


class Line:
    """What the scene says of a line, and its record of one step."""

    def __init__(self, scene, results, name):
        self.scene, self.results, self.name = scene, results, name
        given = scene["lines"][name]
        self.lengths = results.get(f"{name}_element_length")
        self.length, self.elements = sum(self.lengths), len(self.lengths)
        self.compliance = 0.0 if given["stiffness"] in (".inf", math.inf) else 1/given["stiffness"]
        gravity = scene["gravity"]
        pull = size(gravity)
        self.weight = [given["mass"]*g if "mass" in given else given["weight"]*g/pull if pull > 0 else 0 for g in gravity]

    def get(self, what, step):
        return self.results.get(f"{self.name}_{what}", step)

    def one(self, what, step):
        return self.get(what, step)[0]

    def certified(self, step):
        return self.one("outcome", step) in (SOLVED, TAUT)

    def final(self, step):
        return self.one("outcome", step) in FINAL

    def start(self, step):
        """where the step begins; None: not in the file, or it begins nowhere, as the statics of a line that is laid"""
        if step == 0 and self.scene["lines"][self.name]["start"] == "static":
            return None
        if step > 0:
            return self.get("position", step - 1)
        return self.get("reference", 0) if self.one("substeps", 0) == 1 else None


def weight_at(line, j):
    """[N] of the elements beside node j, half of each"""
    share = ((line.lengths[j - 1] if j > 0 else 0) + (line.lengths[j] if j < line.elements else 0))/2
    return [share*w for w in line.weight]


def displacement(before, now):
    return max(size(minus(point(now, j), point(before, j))) for j in range(len(now)//3))


# numbers ---------------------------------------------------------------------------------------------------------------

def reach(scene, line, step):
    """[m], [N]: of lengths and forces that the scene can make"""
    lengths, forces = line.length, line.length*size(line.weight)
    for end in range(2):
        if line.get("end_kind", step)[end]:
            forces += size(point(line.get("end_applied_force", step), end))
        else:
            lengths += size(minus(point(line.get("end_held_position", step), end), line.get("reference", step)[:3]))
    if line.compliance > 0:
        lengths *= 1 + forces*line.compliance
        forces += lengths/line.length/line.compliance
    return lengths, forces


def insane(line, step):
    """names of what is no number, or beyond all measure"""
    bad = []
    for name, (shape, kind, _, _) in line.results.variables.items():
        if kind != 6 or not name.startswith(line.name + "_") or not shape or shape[0] != 0:
            continue
        what = name[len(line.name) + 1:]
        if what not in MAY_BE_NONE and not all(math.isfinite(x) for x in line.get(what, step)):
            bad.append(f"{what} is no number")
    if bad or line.final(step):
        return bad
    lengths, forces = reach(line.scene, line, step)
    start = line.start(step) or line.get("reference", step)
    if displacement(start, line.get("position", step)) > SANE*lengths:
        bad.append(f"places {displacement(start, line.get('position', step))/lengths:.1e} lengths away")
    if line.compliance > 0 and max(map(abs, line.get("tension", step))) > SANE*forces:
        bad.append(f"tension {max(line.get('tension', step)):.1e} N, of {forces:.1e} N")
    for what in ("primal", "dual", "gap", "dissipated", "ledger_ends", "ledger_elastic", "ledger_gravity", "ledger_obstacles", "ledger_imbalance"):
        if line.compliance > 0 and abs(line.one(what, step)) > SANE*SANE*forces*lengths:
            bad.append(f"{what} {line.one(what, step):.1e} J, of {forces*lengths:.1e} J")
    return bad


# what nothing moves ----------------------------------------------------------------------------------------------------

def wanders(line, step):
    """the displacement of a step in which nothing happens, per length, where that is too far; None: not asked"""
    if step < 1 or not (line.certified(step - 1) and line.certified(step)):
        return None
    if line.results.attributes["friction_policy"] == "frozen":
        # what the bounds of friction change by, the line may move
        for bound in ("friction_bound", "friction_bound_second"):
            if f"{line.name}_{bound}" not in line.results.variables:
                continue
            before, now = line.get(bound, step - 1), line.get(bound, step)
            if max(abs(a - b) for a, b in zip(before, now)) > 1e-9*max(line.one("largest_force", step), 1e-300):
                return None
    moved = displacement(line.get("position", step - 1), line.get("position", step))/line.length
    return moved if moved > STILL else 0.0


# energy ----------------------------------------------------------------------------------------------------------------

def ledger(line, step):
    return {k: line.one(f"ledger_{k}", step) for k in ("ends", "obstacles", "elastic", "gravity", "imbalance")}


def exchanged(line, step):
    """[J] dissipated plus positive work"""
    book = ledger(line, step)
    return line.one("dissipated", step) + sum(max(0, book[k]) for k in ("ends", "obstacles")) + sum(max(0, -book[k]) for k in ("elastic", "gravity"))


def energy_faults(line, step):
    """the ledger of a step in whatever parts: weight and elongation from the places, its sum, and what it makes"""
    bad, before, now, book = [], line.start(step), line.get("position", step), ledger(line, step)
    if before is None or not line.certified(step):
        return bad
    force, parts = line.one("largest_force", step), line.one("substeps", step)
    extent = max(line.length, displacement(list(now[:3])*(len(now)//3), now))
    # places known to 1e-8 of the extent, what the certificate leaves, and a strain of 1e-12 by rounding of coordinates
    noise = 1e-8*parts*max(force, size(line.weight)*line.length)*extent + line.one("gap", step)
    noise += 1e-24*line.length/line.compliance if line.compliance > 0 else 0
    fall = -sum(inner(weight_at(line, j), minus(point(now, j), point(before, j))) for j in range(line.elements + 1))
    if abs(fall - book["gravity"]) > noise:
        bad.append(f"gravity of the ledger {book['gravity']:.6g} J, by the places {fall:.6g} J")
    closed = book["ends"] + book["obstacles"] - book["elastic"] - book["gravity"] - line.one("dissipated", step)
    if abs(closed - book["imbalance"]) > noise:
        bad.append(f"the ledger's imbalance {book['imbalance']:.6g} J, its sum {closed:.6g} J")
    if line.compliance > 0 and step > 0 and line.certified(step - 1):
        held = [sum(l*line.compliance*t*t/2 for l, t in zip(line.lengths, line.get("tension", s))) for s in (step - 1, step)]
        if abs(held[1] - held[0] - book["elastic"]) > 1e-6*max(held) + noise:
            bad.append(f"elastic energy of the ledger {book['elastic']:.6g} J, by the tensions {held[1] - held[0]:.6g} J")
    made = -book["imbalance"]
    if parts == 1 and made > 1.001*MADE*exchanged(line, step) + noise and not (line.one("unaccounted", step) > 0 or line.one("jumps", step) > 0):
        bad.append(f"{made:.6g} J are made beside {exchanged(line, step):.6g} J, and nothing is said")
    return bad


# the way round posts ---------------------------------------------------------------------------------------------------

def angle(obstacle, a, b):
    """[rad] from a to b about the axis, folded"""
    axis = obstacle["axis"]
    length = size(axis)
    spokes = []
    for x in (a, b):
        arm = minus(x, obstacle["point"])
        along = inner(arm, axis)/length
        spokes.append([v - along*w/length for v, w in zip(arm, axis)])
    cross = [spokes[0][(k + 1) % 3]*spokes[1][(k + 2) % 3] - spokes[0][(k + 2) % 3]*spokes[1][(k + 1) % 3] for k in range(3)]
    return math.atan2(inner(cross, axis)/length, inner(*spokes))


def winding_faults(line, step):
    """With both ends held, the angle from A to B along the line changes by what the ends' straight ways sweep."""
    bad, before = [], line.start(step)
    if before is None or not line.certified(step) or line.results.attributes["contact_policy"] == "reference" or \
            line.results.attributes["friction_policy"] == "frozen" or any(line.get("end_kind", step)):
        return bad
    now = line.get("position", step)
    origin = line.results.attributes.get("origin", [0.0, 0.0, 0.0])
    for name, obstacle in line.scene.get("obstacles", {}).items():
        if "cylinder" not in obstacle:
            continue
        post = {"axis": obstacle["cylinder"]["axis"], "point": minus(obstacle["cylinder"]["point"], origin)}
        turns = [sum(angle(post, point(x, j), point(x, j + 1)) for j in range(line.elements)) for x in (before, now)]
        swept = [angle(post, point(before, j), point(now, j)) for j in (0, line.elements)]
        if abs(turns[1] - turns[0] - swept[1] + swept[0]) > 1:
            bad.append(f"goes through {name}: {turns[1] - turns[0]:.3f} rad about it, its ends {swept[1] - swept[0]:.3f}")
    return bad


# other names of the ends -----------------------------------------------------------------------------------------------

def reflected(word):
    """a set of forces as one sees it who goes along the line the other way"""
    (kind, of), = word.items()
    if kind in ("polytope", "segment"):
        return {kind: [[-x for x in p] for p in of]}
    if kind in ("disc", "ellipse"):
        return {kind: of}
    if kind == "box":
        return {kind: [[-side[1], -side[0]] if isinstance(side, list) else side for side in of]}
    if kind in ("hull", "sum"):
        return {kind: [reflected(w) for w in of]}
    assert kind == "translate", f"how is a set {kind} reflected? add the word here"
    return {kind: {"by": [-x for x in of["by"]], "of": reflected(of["of"])}}


def nodes_of_arc(line):
    """chords of the circle, one after the other"""
    arc, n = line["start"]["arc"], line["elements"]
    axis = [a/size(arc["axis"]) for a in arc["axis"]]
    arm = minus(arc["from"], arc["centre"])
    along = inner(arm, axis)
    spoke = [a - along*b for a, b in zip(arm, axis)]
    across = [axis[(k + 1) % 3]*spoke[(k + 2) % 3] - axis[(k + 2) % 3]*spoke[(k + 1) % 3] for k in range(3)]
    turn = 2*math.asin(line["length"]/n/2/size(spoke))
    return [[c + along*b + math.cos(turn*j)*s + math.sin(turn*j)*t for c, b, s, t in zip(arc["centre"], axis, spoke, across)] for j in range(n + 1)]


def by_nodes(scene):
    """arcs as polylines: they have no other way round"""
    for line in scene["lines"].values():
        if isinstance(line["start"], dict) and "arc" in line["start"]:
            line["start"] = {"polyline": nodes_of_arc(line)}


def exchange(scene):
    """every line from B to A"""
    other = {"A": "B", "B": "A"}
    for obstacle in scene.get("obstacles", {}).values():
        friction = obstacle["friction"]
        if isinstance(friction, dict) and "set" in friction and "grain" not in friction:
            friction["set"] = reflected(friction["set"])
    for line in scene["lines"].values():
        line["ends"] = {other[e]: at for e, at in line["ends"].items()}
        start = line["start"]
        if isinstance(start, dict) and "straight" in start:
            start["straight"] = {"from": start["straight"]["to"], "to": start["straight"]["from"]}
        elif isinstance(start, dict):
            start["polyline"].reverse()
        if isinstance(line["elements"], list):
            line["elements"].reverse()
        for zone in line.get("friction_zones", []):
            zone["from"], zone["to"] = line["length"] - zone["to"], line["length"] - zone["from"]
        line.get("friction_zones", []).reverse()
    names = [f"{n}.{e}" for n in scene["lines"] for e in "AB"]
    for i, entry in enumerate(scene["history"]):
        scene["history"][i] = {(k[:-1] + other[k[-1]] if k in names else k): v for k, v in entry.items()}


def says_so(line, step):
    """does the record say that it may be one of several, or not what the line does?"""
    return not line.certified(step) or line.one("jumps", step) > 0 or line.one("unaccounted", step) > 0 or line.one("places_not_unique", step) > 0 \
        or line.one("ledger_imbalance", step) > FREED*exchanged(line, step)


def reactions_part(one, other, step):
    """do nodes press otherwise, though the places are the same?  The friction of the steps to come differs then."""
    here, there = one.get("reaction", step)[:one.elements + 1], other.get("reaction", step)[:one.elements + 1]
    return max(abs(a - b) for a, b in zip(here, reversed(there))) > SAME*max(map(abs, here))


def parted(pair, tally):
    """Two histories with exchanged ends, step by step up to where their places part, or the reactions of a step that says why: those that do
    part and do not say why in that step."""
    faults = []
    for name in pair[0]:
        one, other = (lines[name] for lines in pair)
        left = 0.0
        for step in range(min(one.results.steps, other.results.steps)):
            if one.final(step) or other.final(step):
                break
            # strain that the certificates leave open: the file has that of the step's last part
            left += sum(line.compliance*b*line.one("substeps", step) for line in (one, other) for b in line.get("tension_bound", step) if math.isfinite(b))
            here, there = one.get("position", step), other.get("position", step)
            apart = max(size(minus(point(here, j), point(there, one.elements - j))) for j in range(one.elements + 1))/one.length
            tally["compared"] += 1
            told = says_so(one, step) or says_so(other, step)
            if apart <= max(SAME, left) and not (told and reactions_part(one, other, step)):
                continue
            if told:
                tally["said"] += 1
            else:
                faults.append(f"line {name}, step {step}: {apart:.1e} of the length apart with its ends exchanged, and nothing is said")
            break
    return faults
