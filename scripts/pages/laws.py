# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/laws.md."""
import json
import math
import os
import re

from marks import read, same, short

# picture: law file and what is asked
ASKED = {
    "coulomb": ("coulomb", "-v 1,0 -v -0.5,0.4 -v 0.2,-1"),
    "braked-wheel": ("braked-wheel", "-v 1,0.2 -v 1,1 -v 0,1"),
    "free-wheel": ("free-wheel", "-v 1,0.5 -v 0,1"),
    "free-wheel-velocities": ("free-wheel", "-f 0,0 -f 500,0"),
    "ski": ("ski", "-v 1,0 -v 1,0.3 -v 0,1"),
    "wood": ("wood", "-v 1,1 -v -1,0.3"),
    "ratchet": ("ratchet", "-v 1,0 -v -1,0.2 -v -0.2,1.5"),
    "slope": ("slope", "-v -1,0 -v 0,1 -v 1,0"),
    "bipod": ("bipod", "-v 0,-1,1 -v 0,1,0 --axes 2,3"),
    "stool": ("stool", "-v 0,-0.2,1 -v 0,0.3,1 -v 0,0,1 --axes 2,3"),
    "friction-cone": ("friction-cone", "-v 1,1 -f 0,0 -f 50,100"),
    "ratchet-brake": ("ratchet-brake", "-v 0 -v 1"),
    "grease": ("grease", ""),
}



def vector(x):
    return "(" + ", ".join(f"{v + 0:.6g}" for v in x) + ")"


def what_is(s):
    """A set among the answers, in words."""
    if "outcome" in s:
        return "none"
    points = s.get("vertices") or s.get("rays") or []
    if s["description"] in ("point", "zero"):
        return vector(s["centre"])
    if s["description"] in ("segment", "ray", "sector"):
        return s["description"] + " " + ", ".join(vector(p) for p in points)
    if s["description"] in ("line", "half-plane") and "lines" in s:
        return s["description"] + " along " + vector(s["lines"][0])
    return f"{s['description']} of dimension {s['dimension']}"


def gallery(program):
    rows = ["| law | asked | power [W] | answer |", "|---|---|---|---|"]
    for law, asked in ASKED.values():
        asked = re.sub(r" *--axes \S+", "", asked)
        if not asked:
            continue
        answers = json.loads(program.call("law", f"examples/laws/{law}.yaml", "--json", *asked.split()))["answers"]
        for a in answers:
            key = "velocity" if "velocity" in a else "force"
            power = "" if key == "force" else f"{a['dissipation_W'] if abs(a['dissipation_W']) > 1e-12 else 0:.6g}"
            rows.append(f"| `{law}` | {key[0].upper()} = {vector(a[key])} | {power} | {what_is(a['forces' if key == 'velocity' else 'velocities'])} |")
    return rows


def random_tests(program, names):
    text = read(os.path.join(program.root, "test", "property", "CMakeLists.txt"))
    rows = ["| test | cases in every run | all |", "|---|---|---|"]
    for name in names:
        few, every = re.search(rf'sampled\({name} "--cases (\d+)" "--cases (\d+)"\)', text).groups()
        rows.append(f"| `{name}` | {few} | {every} |")
    return rows


def drawn(law, asked):
    def draw(program):
        path = os.path.join(program.folder, f"law-{law}-{re.sub(r'[^0-9a-z]+', '_', asked)}.svg")
        program.call("law", f"examples/laws/{law}.yaml", *asked.split(), "--plot", path, accept=(0,))
        return path
    return draw


def accuracies(*gaps):
    """The root of each gap, and the gap."""
    return [text for gap in gaps for text in (short(math.sqrt(float(gap))), gap)]


FIGURES = {"gallery": gallery, "random-laws": lambda p: random_tests(p, ("random_sets", "random_laws", "random_resistances", "random_extremes", "random_contacts"))}
PICTURES = {f"law-{name}": drawn(*asked) for name, asked in ASKED.items()}
ALIKE = same
SENTENCES = [
    ("with relative tolerance {}. A factor counts", lambda p: p.constant("law/law.c", r"BOUNDARY_TOLERANCE = (\S+);")),
    ("whose gap is more than {} of phi(V)", lambda p: p.constant("law/conjugate_sum.c", r"PROMISE = (\S+);")),
    ("It is {} at a gap of {}, the target of the iteration, and {} at {}, the largest gap", lambda p: accuracies(
        p.constant("law/conjugate_sum.c", r"TARGET = (\S+),"), p.constant("law/conjugate_sum.c", r"ENOUGH = (\S+),"))),
    ("A force outside by less than {} of its length", lambda p: p.constant("law/conjugate_sum.c", r"ON_BOUNDARY = (\S+);")),
    ("asks bodies on {} to {} contacts", lambda p: [p.constant("random_contacts.c", rf"\b{name} = (\d+)") for name in ("FEWEST", "MOST")]),
]
GIVEN = []
