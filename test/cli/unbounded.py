# SPDX-License-Identifier: BSD-3-Clause
"""Laws and driven systems without bounds: half-lines, lines, cones with lines, powers without end, minima that are not attained, nothing asked. Each
answer in words and in JSON, as its closed form says.                                                              usage: unbounded.py CAPSTAN"""
import json
import math
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from checks import expect, faults, write

CAPSTAN = os.path.abspath(sys.argv[1])
OUTSIDE, UNBOUNDED = "CPS_SET_OUTCOME_OUTSIDE", "CPS_SET_OUTCOME_UNBOUNDED"


def run(verb, text, *arguments, code=0):
    write("file.yaml", "capstan: 1\n" + text)
    done = subprocess.run([CAPSTAN, verb, "file.yaml", *arguments], capture_output=True, text=True, timeout=100, check=False)
    expect(f"{verb} {text} {arguments}: exit code", done.returncode == code, (done.returncode, done.stderr[-300:]))
    return done.stdout


def ask(verb, text, *arguments, code=0):
    """The words of the answers, and the answers in JSON."""
    return run(verb, text, *arguments, code=code), json.loads(run(verb, text, *arguments, "--json", code=code))["answers"]


def says(what, text, *words):
    for word in words:
        expect(f"{what}: '{word}'", word in text, text[-900:])


def near(x, wanted, tolerance=1e-6):
    return x is not None and abs(x - wanted) <= tolerance


def intervals():
    """Forces at rest are the whole interval; at a velocity its end, or none."""
    words, answers = ask("law", "law: {interval: [-.inf, .inf]}", "--velocity", "0", "--velocity", "1", "--force", "3")
    says("line", words, "a line through", "forces: none: the set is unbounded", "only the velocity 0")
    at_rest, moving, pushed = answers
    expect("line at rest", at_rest["forces"]["description"] == "line" and at_rest["dissipation_W"] == 0, at_rest)
    expect("line moving", moving["forces"] == {"outcome": UNBOUNDED} and moving["dissipation_W"] is None, moving)
    expect("line pushed", pushed["velocities"]["description"] == "zero", pushed)
    for sign in (1, -1):
        interval = "[-.inf, 2]" if sign > 0 else "[-2, .inf]"
        words, answers = ask("law", f"law: {{interval: {interval}}}", f"--velocity={-sign}", f"--velocity={sign}", "--velocity=0", f"--force={2*sign}",
                             f"--force={3*sign}")
        against, along, at_rest, end, beyond = answers
        # -U in N_C(F): power -U F = 2 at the end of the interval, none the other way
        expect(f"{interval}: at the end", against["forces"]["centre"] == [2*sign] and near(against["dissipation_W"], 2), against)
        expect(f"{interval}: without end", along["forces"] == {"outcome": UNBOUNDED}, along)
        expect(f"{interval}: at rest", at_rest["forces"]["description"] == "half-line", at_rest)
        expect(f"{interval}: end", end["velocities"]["rays"] == [[-sign]], end)
        expect(f"{interval}: beyond", beyond["velocities"] == {"outcome": OUTSIDE}, beyond)
        says(interval, words, f"a half-line from ({2*sign}) along ({-sign})", f"a ray along ({-sign})", "the point lies outside the set")


def cones():
    """At the apex of a friction cone the velocities are its polar, turned; beside it a line where a force is 0 and nothing else."""
    law = "law: {product: [{interval: 0}, {friction_cone: {friction: 0.5, dimension: 3}}]}"
    words, answers = ask("law", law, "--force", "0,0,0,0")
    says("cone", words, "a cone of dimension 4 with the line along (1, 0, 0, 0), around")
    velocities = answers[0]["velocities"]
    expect("cone", velocities["description"] == "cone" and velocities["dimension"] == 4 and velocities["lineality"] == 1, velocities)
    # centre -U in the polar cone { (w, w_n): 0.5 w_n + |w| <= 0 .. }: <U, F> >= 0 for every F of the cone, whose edge is (0.5 e, 1)
    _, x, y, z = velocities["centre"]
    for k in range(8):
        e = math.cos(k*math.pi/4), math.sin(k*math.pi/4)
        products = [p*x + q*y + r*z for p, q, r in ((0.5*e[0], 0.5*e[1], 1), (1, 0.5*e[0], 0.5*e[1]))]
        expect(f"cone: centre, {k}", max(products) >= 0, (velocities["centre"], products))


def resistances():
    """A stop on one side, in a resistance: no power where it gives way, none that is finite where it does not."""
    words, answers = ask("law", "resistance: [{dry: {interval: [0, .inf]}}]", "--velocity=1", "--velocity=-1", "--force=1")
    free, stopped, pushed = answers
    expect("stop: free", free["dissipation_W"] == 0 and free["potential_W"] == 0, free)
    expect("stop: stopped", stopped["forces"] == {"outcome": UNBOUNDED} and stopped["potential_W"] is None, stopped)
    expect("stop: pushed", pushed["velocities"]["centre"] == [0], pushed)
    says("stop", words, "forces: none: the set is unbounded", "dissipates 0 W")
    # phi = 2 |v|^3, force 6 |v| v: at 1e150 both are more than a number can be
    words, answers = ask("law", "resistance: [{power: {degree: 3, factor: 2, of: {interval: 1}}}]", "--velocity=1e100", "--velocity=3")
    fast, slow = answers
    expect("power: slow", near(slow["potential_W"], 18, 1e-9) or near(slow["potential_W"], 54, 1e-9), slow)
    expect("power: fast", fast["dissipation_W"] is None or fast["dissipation_W"] > 1e299, fast)
    # what is left out of a long set is said: rows behind the eighth, and what is behind 400 characters
    points = [f"[{math.cos(k):.12f}, {math.sin(k):.12f}]" for k in range(80)]
    words = run("law", f"law: {{polytope: [{', '.join(points[:9])}]}}")
    says("nine corners", words, "points(1 0; 0.540302306 0.841470985; ", "0.756802495; 0.283662185 -0.958924275; 0.960170287 -0.279415498; 0.753902254 "
         "0.656986599; ..)")
    words = run("law", f"law: {{sum: [{', '.join(f'{{polytope: [{chr(44).join(points[8*k:8*k + 8])}]}}' for k in range(9))}]}}")
    cut = next(line for line in words.splitlines() if "set of forces" in line)
    expect("a long set is cut", cut.endswith("..") and len(cut) < 430, cut)


TWO = """system:
  parameters: [a, b]
  laws: [{name: x, on: [a], law: {interval: 1}}, {name: y, on: [b], law: {interval: [0, .inf]}}]
  drive: [a, b]
"""


def systems():
    expect("nothing asked", "nothing asked: add --velocity W" in run("drive", TWO), "")
    words, answers = ask("drive", TWO, "--velocity", "1,1", "--velocity", "1,-1", "--velocity=-1,0", code=5)
    free, stopped, beside = answers
    # the stop gives way to b > 0, and resists b < 0 without bound; at b = 0 phi is not continuous
    expect("two: free", near(free["gamma_W"], 1) and near(free["G"][0], -1) and near(free["G"][1], 0) and free["continuous"] is True, free)
    expect("two: stopped", stopped["outcome"] == "CPS_MOTION_OUTCOME_BLOCKED" and stopped["G"][1] > 0 and "composition" not in stopped, stopped)
    expect("two: beside", near(beside["gamma_W"], 1) and beside["continuous"] is False, beside)
    says("two", words, "no motion: no velocity that constraints and one-sided laws admit", "component 2 from 0 to inf N",
         "Proposition 2: phi is continuous at no velocity that agrees with W")
    words, answers = ask("drive", TWO, "--eliminate", "--velocity", "1,1", "--velocity", "1,-1", "--velocity", "0,0", "--force", "1,0.5", "--force", "3,0")
    free, stopped, at_rest, end, outside = answers
    expect("two: law, free", free["forces"]["centre"] == [-1, 0] and near(free["dissipation_W"], 1), free)
    expect("two: law, stopped", stopped["forces"] == {"outcome": UNBOUNDED} and stopped["dissipation_W"] is None, stopped)
    expect("two: law, at rest", at_rest["forces"]["dimension"] == 2, at_rest)
    expect("two: law, end", end["velocities"]["rays"] == [[-1, 0]], end)
    expect("two: law, outside", outside["velocities"] == {"outcome": OUTSIDE}, outside)
    says("two: law", words, "forces: none: the set is unbounded", "a ray along (-1, 0)", "velocities: none: the point lies outside")
    # the area of a set that has none is not told
    whole = json.loads(run("drive", TWO, "--eliminate", "--velocity", "1,1", "--json"))
    expect("two: area", "area" not in whole and whole["components"] == 2, whole)
    # a load on the parameter that is not driven, which is more than its brake holds: there is no law
    loaded = "system:\n  parameters: [a, b]\n  laws: [{name: y, on: [b], law: {interval: 1}}]\n  drive: [a]\n  load: {a: 0.3, b: %s}\n"
    words = run("drive", loaded % "0.5", "--eliminate", "--velocity", "1")
    says("borne", words, "reduced law between W and G, 1 component", "forces: one: (0.3)")
    words = run("drive", loaded % "1.5", "--eliminate", "--velocity", "1", code=5)
    says("too much", words, "no reduced law: no forces of the laws balance the load")
    answer = json.loads(run("drive", loaded % "1.5", "--eliminate", "--velocity", "1", "--json", code=5))
    expect("too much", answer["forces"] == {"outcome": "CPS_SET_OUTCOME_EMPTY"} and answer["answers"] == [], answer)


def not_attained():
    """phi(a, b) = sqrt(a^2 + b^2) - b of a disc that touches 0 falls to 0 as b grows."""
    disc = """system:
  parameters: [a, b]
  laws: [{name: beside, on: [a, b], law: {translate: {by: [0, 1], of: {disc: 1}}}}]
  drive: [a]
  velocity: [[2], [0]]
"""
    words, answers = ask("drive", disc, code=5)
    says("not attained", words, "the least dissipation is approached by ever faster velocities only", "W is an infimum, between bounds", "V: a 0, b 1", "b 0 (from 0 to inf)")
    moving, still = answers
    expect("not attained", moving["outcome"] == "CPS_MOTION_OUTCOME_NOT_ATTAINED" and near(moving["gamma_W"], 0, 1e-6), moving)
    expect("not attained: direction", near(moving["direction"][0], 0) and near(moving["direction"][1], 1), moving["direction"])
    expect("not attained: no sets", moving["velocities"] == {"outcome": "CPS_SET_OUTCOME_NOT_AVAILABLE"}, moving)
    expect("at rest", still["gamma_W"] == 0 and "direction" not in still, still)


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for part in (intervals, cones, resistances, systems, not_attained):
            part()
        os.chdir("/")
    print("\n".join(faults[:20]) or "laws and systems without bounds are answered")
    return 1 if faults else 0


sys.exit(main())
