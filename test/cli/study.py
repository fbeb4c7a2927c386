# SPDX-License-Identifier: BSD-3-Clause
"""capstan study: its files, its words and its exit codes.                     usage: study.py CAPSTAN EXAMPLES"""
import csv
import math
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

CAPSTAN, EXAMPLES = sys.argv[1:]
EXAMPLE = os.path.join(EXAMPLES, "souza-de-cursi-1990.yaml")
SLACK = os.path.join(EXAMPLES, "souza-de-cursi-1990-slack.yaml")
ANNEX_5 = os.path.join(EXAMPLES, "souza-de-cursi-1990-annex-5.yaml")

faults = []


def check(condition, text):
    if not condition:
        faults.append(text)


def study(folder, *arguments):
    return subprocess.run([CAPSTAN, "study", *arguments], cwd=folder, capture_output=True, text=True, timeout=120)


def table(path):
    """Rows as dictionaries, without the row of units."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))[1:]


with tempfile.TemporaryDirectory() as folder:
    # the default directory; every file whole; numbers that mean something
    done = study(folder, EXAMPLE, "--step", "Y3")
    check(done.returncode == 0, f"Y3: exit code {done.returncode}\n{done.stderr}")
    place = os.path.join(folder, "results", "souza-de-cursi-1990-study")
    names = sorted(os.listdir(place))
    check(names == [".capstan", "first-order.csv", "first-order.svg", "relaxed.svg", "study.csv", "study.json", "study.svg"], f"files: {names}")
    for name in names:
        if name.endswith(".svg"):
            root = xml.parse(os.path.join(place, name)).getroot()
            check(root.tag.endswith("svg"), f"{name}: no SVG")
            check("nan" not in xml.tostring(root, encoding="unicode"), f"{name}: draws NaN")
    rows = table(os.path.join(place, "study.csv"))
    check([row["stage"] for row in rows] == sorted((row["stage"] for row in rows), key="h lambda n delta".split().index),
          "study.csv: stages out of order")
    check(all(row["converged"] == "1" for row in rows), "study.csv: a solve did not converge")
    first, last = rows[0], rows[-1]
    check(float(last["tension_rms_error"]) < 1e-4 * float(first["tension_rms_error"]), "study.csv: tensions do not converge")
    check(abs(float(last["total"]) - sum(float(last[part]) for part in
                                         ("elastic", "potential", "friction_energy", "bending", "contact"))) < 1e-9,
          "study.csv: the total is not the sum of its parts")
    check(len(table(os.path.join(place, "first-order.csv"))) == 801, "first-order.csv: not one row per node")

    # the counter-example: no solution is an answer, with its condition
    done = study(folder, ANNEX_5, "-o", "annex")
    check(done.returncode == 0, f"annex 5: exit code {done.returncode}\n{done.stderr}")
    check("no solution" in done.stdout and "(86)" in done.stdout, f"annex 5: said\n{done.stdout}")
    strain = [float(row["strain"]) for row in table(os.path.join(folder, "annex", "first-order.csv"))[1:]]
    check(abs(min(strain) + 0.3975) < 1e-6, f"annex 5: least strain {min(strain)}")

    # three methods side by side: the regularised and the frozen one agree to their parameters where nothing is loose
    done = study(folder, EXAMPLE, "--history", "-o", "methods")
    check(done.returncode == 0, f"history: exit code {done.returncode}\n{done.stderr}")
    rows = table(os.path.join(folder, "methods", "methods.csv"))
    check(len(rows) == 15, f"methods.csv: {len(rows)} rows, expected 3 methods at the start and in 4 steps")
    apart = {(row["step"], row["method"]): float(row["farthest_from_first"]) for row in rows}
    check(apart["Y3", "frozen friction"] < 2e-5, f"methods.csv: regularised and frozen Y3 are {apart['Y3', 'frozen friction']} m apart")
    check(0.01 < apart["Y3", "consistent friction"] < 0.1, "methods.csv: consistent friction is the frozen one")
    xml.parse(os.path.join(folder, "methods", "methods.svg"))

    # slack laid out in three ways, each a solution of P3.1 when read back; and configurations that are none, with the reason
    def change(name, row, column, by, width=0):
        """Move a node; or those up to `width` to both sides as well, less and less."""
        with open(os.path.join(folder, "laid", "completed.csv"), newline="", encoding="utf-8") as file:
            lines = list(csv.reader(file))
        for k in range(row - width, row + width + 1):
            share = math.cos(math.pi / 2 * (k - row) / (width + 1)) ** 2
            lines[k + 2][column] = repr(float(lines[k + 2][column]) + share * by)
        with open(os.path.join(folder, name), "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows(lines)

    # what the methods of 1990 do not know is refused: with it they would judge another step
    for what, of_line, of_end in (("springs", "elements: 10\n    springs: [{stiffness: [10, 10, 10]}]", "held"), ("loads", "elements: 10\n    loads: [{force: [0, 1, 0]}]", "held"),
                                  ("a winch", "elements: 10", "{held: [10, 0, 0], stored: 0}"), ("nothing", "elements: 10", "held")):
        with open(os.path.join(folder, "beside.yaml"), "w", encoding="utf-8") as file:
            file.write("capstan: 1\nobstacles: {bed: {plane: {}, friction: 0.5}}\nlines:\n  cable:\n    length: 10\n    mass: 1\n    stiffness: 1e6\n"
                       f"    {of_line}\n    start: {{straight: {{from: [0, 0, 0], to: [10, 0, 0]}}}}\n    ends: {{A: held, B: {of_end}}}\n"
                       "history: [{name: up, cable.B: {move: [0, 0, 0.1]}}]\n")
        for done in (study(folder, "beside.yaml", "-o", what.replace(" ", "-")),
                     subprocess.run([CAPSTAN, "run", "--method", "regularized", "beside.yaml", "-o", "run-" + what.replace(" ", "-")],
                                    cwd=folder, capture_output=True, text=True, timeout=120)):
            refused = done.returncode == 3 and ("a winch, springs, loads or drag" in done.stderr or "sections" in done.stderr)
            check(refused == (what != "nothing"), f"{what} beside a plane: exit code {done.returncode}\n{done.stderr}")

    laid = os.path.join("laid", "completed.csv")
    # the chain of least motion lies shortened where the line was pulled aside, and folded back, |x'| = 1, where its end went straight back
    for scene, step, loose, found in ((EXAMPLE, "Y4", "6.2329 m  loose", "as found: a solution of P4.2 but not of P3.1"),
                                      (SLACK, "back", "1 m  loose", "as found: a solution of P3.1")):
        shapes = set()
        for shape in ("shortest", "straight", "meander"):
            done = study(folder, scene, "--step", step, "--complete", shape, "-o", "laid")
            check(done.returncode == 0, f"{step}, {shape}: exit code {done.returncode}\n{done.stderr}")
            check(loose in done.stdout and "kept on the obstacle by contact" in done.stdout, f"{step}: said\n{done.stdout}")
            check(found in done.stdout, f"{step}: said\n{done.stdout}")
            xml.parse(os.path.join(folder, "laid", "completed.svg"))
            with open(os.path.join(folder, laid), encoding="utf-8") as file:
                shapes.add(file.read())
            done = study(folder, scene, "--step", step, "--judge", laid)
            check(done.returncode == 0 and "a solution of P3.1" in done.stdout, f"{step}, {shape}, judged: {done.stdout}{done.stderr}")
        check(len(shapes) == 3, f"{step}: {len(shapes)} different shapes, expected 3")

    # a node at its bound where the tension begins slides on nowhere: what is taut holds it, and the configuration is unique
    done = study(folder, os.path.join(EXAMPLES, "souza-de-cursi-1990-circle.yaml"), "--step", "Y2", "--complete", "meander", "-o", "circle")
    check("at its bound where nothing slides by itself" in done.stdout and "may slide" not in done.stdout, f"full circle, Y2: said\n{done.stdout}")

    # the tolerance of a judgement is printed with its scale, and an option
    study(folder, EXAMPLE, "--step", "Y4", "--complete", "meander", "-o", "laid")
    change("moved.csv", 790, 3, 1e-4)
    for arguments, code, words in (([], 1, "tolerance 1e-08"), (["--tolerance", "1e-3"], 0, "tolerance 0.001"),
                                   (["--tolerance=0"], 2, ""), (["--tolerance", "1"], 2, ""), (["--tolerance", "nan"], 2, "")):
        done = study(folder, EXAMPLE, "--step", "Y4", "--judge", "moved.csv", *arguments)
        check(done.returncode == code and words in done.stdout, f"--judge {arguments}: {done.returncode} {done.stdout}{done.stderr}")
    # 0.077 N x 0.1 mm of contact beside a scale that the program prints: the ratio decides
    done = study(folder, EXAMPLE, "--step", "Y4", "--judge", "moved.csv")
    scale = float(done.stdout.split("the scale S = ")[1].split()[0]) if "the scale S = " in done.stdout else 0
    check(1e-8 * scale < 9.81 * 0.00785 * 1e-4 < 1e-3 * scale, f"scale of the judgement: {scale} J")

    for row, column, by, width, words in ((790, 3, 1e-4, 0, "contact is lost"),    # slack lifted, R > 0: 0.077 N x 0.1 mm
                                          (160, 2, 0.001, 150, "sliding outside"), # slack that friction holds, moved aside
                                          (160, 2, 1e-4, 0, "sliding outside"),    # one node of it: 2e-7 J, of 0.01 J that is dissipated
                                          (500, 2, 1e-3, 0, "other tensions"),     # under tension
                                          (790, 3, -1e-6, 0, "inside the obstacle"),
                                          (0, 1, 1e-6, 0, "a held end")):
        change("moved.csv", row, column, by, width)
        done = study(folder, EXAMPLE, "--step", "Y4", "--judge", "moved.csv")
        check(done.returncode == 1 and words in done.stdout, f"node {row} moved: {done.returncode}, '{words}' not in\n{done.stdout}")
    change("moved.csv", 500, 0, 1)
    for name, words in (("moved.csv", "arc length"), ("laid", "irectory"), (EXAMPLE, "another row")):
        done = study(folder, EXAMPLE, "--step", "Y4", "--judge", name)
        check(done.returncode in (3, 4) and words in done.stderr, f"judge {name}: {done.returncode} {done.stderr}")

    # the friction bound of the paper's step is that of the reference, (78), whatever the scene's own friction: the same files, and said
    # so; while the runs of the two scenes differ, here by where a line pulled aside and up comes to lie
    text = open(EXAMPLE, encoding="utf-8").read()
    check("friction_policy: frozen" in text, "example 5.7 is not frozen any more: change this test")
    with open(os.path.join(folder, "default.yaml"), "w", encoding="utf-8") as file:
        file.write("".join(line for line in text.splitlines(keepends=True) if not line.startswith("friction_policy:")) +
                   "solver: {path_tolerance: 1e-3}\n")
    for scene, words in ((EXAMPLE, False), ("default.yaml", True)):
        done = study(folder, scene, "--step", "Y2", "-o", "bound" + str(words))
        check(("(78)" in done.stdout and "path_tolerance" in done.stdout) == words, f"{scene}: said\n{done.stdout}")
    for name in ("study.csv", "first-order.csv"):
        texts = [open(os.path.join(folder, "bound" + str(words), name), encoding="utf-8").read() for words in (False, True)]
        if name == "study.csv":  # all but the wall clock
            texts = ["\n".join(",".join(row[column] for column in row if column != "wall") for row in csv.DictReader(t.splitlines()))
                     for t in texts]
        check(texts[0] == texts[1], f"{name}: the default friction gives another problem than the frozen one")
    done = study(folder, "default.yaml", "--step", "Y2", "--complete", "meander", "-o", "laid-default")
    check("A = mu R at x" in done.stdout, f"--complete does not say which bounds it takes:\n{done.stdout}")

    # path_tolerance is applied to none of the three methods: their rows are those without it
    for scene in ("default.yaml", EXAMPLE):
        done = study(folder, scene, "--history", "-o", "methods-" + ("given" if scene == EXAMPLE else "default"))
        check(done.returncode == 0, f"history of {scene}: {done.stderr}")
    texts = [open(os.path.join(folder, "methods-" + name, "methods.csv"), encoding="utf-8").read() for name in ("given", "default")]
    check(texts[0] == texts[1], "history: a path_tolerance is applied to one of the methods")

    # quiet says nothing
    done = study(folder, ANNEX_5, "-q", "-o", "annex")
    check(done.returncode == 0 and not done.stdout and not done.stderr, "quiet: is not")

    # the end of the study does not depend on the mesh: what the clamped corner's bending leaves, (1/n)/w^2, stays where it is at 800 elements
    # (2.5e-5 N of 0.87 N), where a 1/n that the mesh does not change leaves 2.6e-3 N at 6400
    text = open(EXAMPLE, encoding="utf-8").read()
    with open(os.path.join(folder, "fine.yaml"), "w", encoding="utf-8") as file:
        file.write(text.replace("elements: 800 ", "elements: 6400 "))
    done = study(folder, "fine.yaml", "--step", "Y2", "-q", "-o", "fine")
    last = table(os.path.join(folder, "fine", "study.csv"))[-1]
    check(done.returncode == 0 and float(last["friction_excess"]) < 1e-4 and float(last["tension_rms_error"]) < 1e-5,
          f"6400 elements: uncarried {last['friction_excess']} N, tensions {last['tension_rms_error']} N off")

    # delta, n, lambda and h of one's own: the study ends there, in decades at most; n = inf is P5.1, without any bending
    for given, ends in (({"delta": 1e-3}, {"delta": 1e-3}), ({"lambda": 3e4, "n": 2e6}, {"lambda": 3e4, "1/n": 5e-7}),
                        ({"n": "inf", "delta": 1e-5, "h": 0.02}, {"1/n": 0.0, "delta": 1e-5})):
        done = study(folder, EXAMPLE, "--step", "Y2", *(f"--{k}={v}" for k, v in given.items()), "-o", "own")
        rows = table(os.path.join(folder, "own", "study.csv"))
        check(done.returncode == 0, f"{given}: {done.returncode} {done.stderr}")
        for column, value in ends.items():
            check(abs(float(rows[-1][column]) - value) <= 1e-9 * value, f"{given}: {column} ends at {rows[-1][column]}")
            steps = [float(r[column]) for r in rows if value > 0]
            check(all(0.0999 < b / a < 10.001 for a, b in zip(steps, steps[1:])), f"{given}: {column} goes by {steps}")
        if "h" in given:
            finest = [float(r["h"]) for r in rows if r["stage"] == "h"][-1]
            check(0.018 < finest <= 0.02, f"stage h ends at {finest}")
            check(all(float(r["bending"]) == 0 and float(r["1/n"]) == 0 for r in rows), "P5.1 bends")
            # what is left is the smoothing, delta A on the part that sticks, and the penalty's w/lambda: the energy tells it to first order
            check(abs(float(rows[-1]["energy_error"])) < 1e-4, f"P5.1: {rows[-1]['energy_error']} J off")
    done = study(folder, EXAMPLE, "--history", "--delta", "1e-3", "-o", "own-history")
    check(done.returncode == 0, f"--history --delta: {done.returncode} {done.stderr}")
    coarse = [float(r["farthest_from_first"]) for r in table(os.path.join(folder, "own-history", "methods.csv")) if r["method"] == "frozen friction"]
    check(max(coarse) > 1e-3, f"--history --delta: {max(coarse)} m from the frozen one, as without")
    for arguments, words in ((["--delta", "0"], "above 0"), (["--delta", "x"], "above 0"), (["--n", "-1"], "or inf"), (["--lambda", "inf"], "above 0"),
                             (["--h", "0.1", "--history"], "--h is that of a step"), (["--delta", "1", "--complete", "meander"], "of the method of 1990")):
        done = study(folder, EXAMPLE, *arguments, "-o", "own-bad")
        check(done.returncode == 2 and words in done.stderr, f"{arguments}: {done.returncode} {done.stderr}")

    # names that repeat, load steps, and numbers: each of six steps is found, by the force that was on the end there
    text = open(ANNEX_5, encoding="utf-8").read()
    repeated = text[:text.index("history:")] + "history:\n" + "".join(
        f"  - {{name: {name}, steps: {steps}, {line}.B: {{force: [{pull}, 0, 0]}}}}\n" for line in ["cable"] for name, steps, pull in
        (("pull", 2, 0.2), ("turn", 1, 0.3), ("pull", 3, 0.6)))
    with open(os.path.join(folder, "repeated.yaml"), "w", encoding="utf-8") as file:
        file.write(repeated)
    for asked, code, words in (("1", 0, "pull 1/2"), ("2", 0, "pull 2/2"), ("3", 0, "turn"), ("turn", 0, "turn"), ("pull 2/3", 0, "pull 2/3"), ("pull 1/2", 0, "pull 1/2"),
                               ("6", 0, "pull 3/3"), ("7", 2, "a number from 1 to 6"), ("0", 2, "a number from 1 to 6"), ("pull 2/4", 2, "a number from 1 to 6"),
                               ("pull", 2, "'pull' is the name of step 2 and of step 6: give the number")):
        done = study(folder, "repeated.yaml", "--step", asked, "--complete", "straight", "-o", "repeated")
        check(done.returncode == code and words in (done.stdout.split("\n")[0] if code == 0 else done.stderr), f"--step {asked}: {done.returncode} {done.stdout[:200]}{done.stderr}")

    # what is wrong, and what to do
    for arguments, code, words in (
            ([EXAMPLE, "--step", "Y9"], 2, ["--step", "Y9", "capstan run"]),
            ([EXAMPLE, "--line", "rope"], 2, ["--line", "rope"]),
            ([EXAMPLE, "--step"], 2, ["needs an argument"]),
            ([EXAMPLE, "--complete", "wavy"], 2, ["wavy", "meander"]),
            ([EXAMPLE, "--complete", "meander", "--history"], 2, ["one at most"]),
            (["missing.yaml"], 4, ["missing.yaml"]),
            ([ANNEX_5, "-o", os.path.join("no", "such", "place")], 4, ["no"]),
            ([], 2, ["SCENE.yaml"])):
        done = study(folder, *arguments)
        check(done.returncode == code, f"{arguments}: exit code {done.returncode}, expected {code}")
        for word in words:
            check(word in done.stderr, f"{arguments}: '{word}' not in: {done.stderr}")

    # an inextensible line is refused with the reason
    scene = open(ANNEX_5, encoding="utf-8").read().replace("stiffness: 1 ", "stiffness: .inf ")
    with open(os.path.join(folder, "stiff.yaml"), "w", encoding="utf-8") as file:
        file.write(scene)
    done = study(folder, "stiff.yaml", "-o", "stiff")
    check(done.returncode == 3 and "inextensible" in done.stderr and "--judge" in done.stderr, f"inextensible: {done.returncode} {done.stderr}")
    check(not os.path.exists(os.path.join(folder, "stiff")), "inextensible: a directory was left behind")

print("\n".join(faults) or "study: files, words and exit codes as documented")
sys.exit(1 if faults else 0)
