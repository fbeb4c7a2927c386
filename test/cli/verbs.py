# SPDX-License-Identifier: BSD-3-Clause
"""What the verbs answer to small scenes, laws and driven systems: words, files and exit codes, one case per line.             usage: verbs.py CAPSTAN"""
import csv
import json
import os
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile

from checks import expect, faults, has_terminals, write

CAPSTAN = os.path.abspath(sys.argv[1])
BAR = """capstan: 1
lines:
  bar: {length: 1, elements: 2, weight: %s, stiffness: %s, start: {straight: {from: [0, 1, 0], to: [1, 1, 0]}}, ends: {A: held, B: %s}}
%s
"""
TWO = """capstan: 1
obstacles: {bed: {plane: {}, friction: 0.5}}
lines:
  rope: {length: 10, elements: 20, weight: 5, stiffness: 1e4, start: {straight: {from: [0, 0, 0], to: [10, 0, 0]}}, ends: {A: held, B: held}}
  other: {length: 10, elements: 10, weight: 5, stiffness: 1e4, start: {straight: {from: [0, 5, 0], to: [10, 5, 0]}}, ends: {A: held, B: held}}
history:
"""
STATIC = """capstan: 1
obstacles: {bed: {plane: {}, friction: 0.5}}
lines:
  rope: {length: 10, elements: 20, weight: 5, stiffness: 1e4, start: static, ends: {A: {held: [0, 0, 0]}, B: {held: [9, 0, 1]}}}
"""
SCENES = {
    "equilibrium.yaml": BAR % ("1", "1e3", "held", ""),
    "far.yaml": BAR % ("1", ".inf", "held", "history: [{name: apart, bar.B: {position: [3, 1, 0]}}]"),
    "falls.yaml": BAR % ("1", "1e3", "free", "history: [{name: fall, bar.A: {force: [0, 0, 0]}}]"),
    "same.yaml": BAR % ("1", "1e3", "held", "history: [" + ", ".join(2 * ["{name: pull, steps: 3, bar.B: {move: [0.01, 0, 0]}}"]) + "]"),
    "two.yaml": TWO + "  - {name: pull, steps: 60, rope.B: {move: [0.2, 0.3, 0]}}\n",
    "stages.yaml": TWO + "".join(f"  - {{name: s{i}, rope.B: {{move: [0.002, 0.003, 0]}}}}\n" for i in range(50)),
    "static.yaml": STATIC,
    "pulled.yaml": STATIC + "history: [{name: pull, steps: 2, rope.B: {move: [0.2, 0, 0]}}]\n",
    "friction.yaml": """capstan: 1
obstacles:
  grooved: {plane: {}, friction: {axial: 0.2, lateral: 0.5, grain: [0, 2, 0]}}
  upright: {plane: {point: [0, 0, -1], normal: [0, 1, 0]}, friction: {axial: 0.2, lateral: 0.5, shape: box, grain: [0, 0, 1]}}
  plain: {plane: {point: [0, 0, -2]}, friction: {axial: 0.3, lateral: 0.3}}
  boxed: {plane: {point: [0, 0, -3]}, friction: {axial: 0.3, shape: box}}
  of_points: {plane: {point: [0, 0, -4]}, friction: {set: {sum: [""" + ", ".join(
      f"{{polytope: [[-0.1123456{k}1, -0.1123456{k}2], [0.1123456{k}3, -0.1123456{k}4], [0.1123456{k}5, 0.1123456{k}6]]}}" for k in range(4)) + """]}}}
lines:
  bar: {length: 1, elements: 1, weight: 1, stiffness: 1e3, start: {straight: {from: [0, 1, 0], to: [1, 1, 0]}}, ends: {A: held, B: held}}
  rope: {length: 4, elements: [[3, 2], [9, 2]], weight: 1, stiffness: .inf, start: {straight: {from: [0, 1, 0], to: [4, 1, 0]}}, ends: {A: held, B: free}}
""",
}


def run(verb, *arguments, code=0, **options):
    done = subprocess.run([CAPSTAN, verb, *arguments], capture_output=True, text=True, timeout=300, check=False, **options)
    expect(f"{verb} {' '.join(arguments)}: exit code", done.returncode == code, (done.returncode, done.stderr[-300:]))
    return done


def says(what, text, *words):
    for word in words:
        expect(f"{what}: '{word}'", word in text, text[-600:])


def checks():
    out = run("check", "friction.yaml").stdout
    says("check", out, "friction 0.2 along (0, 2, 0) and 0.5 across, ellipse", "friction 0.2 along (0, 0, 1) and 0.5 across, box",
         "normal (0, 0, 1), friction 0.3\n", "friction 0.3 along the line and 0.3 across, box", "1 m, 1 element of 1 m, weight", "12 elements of 0.222222 m to 0.666667 m",
         "inextensible", "end B: free, force (0, 0, 0) N", "history: 0 entries, 0 load steps")
    cut = next(line for line in out.splitlines() if "of_points" in line)
    expect("check: a long set is cut", re.search(r", friction in \S.{198}\.\., along the line$", cut), cut)
    says("check", run("check", "pulled.yaml").stdout, "static equilibrium", "history: 1 entry, 3 load steps")


def steps_by_name():
    """The steps that --step knows: a name, one of several steps of it, a number."""
    for scene, step in (("static.yaml", "static"), ("pulled.yaml", "static"), ("pulled.yaml", "pull"), ("pulled.yaml", "pull 1/2"),
                        ("equilibrium.yaml", "equilibrium"), ("same.yaml", "6"), ("same.yaml", "1")):
        done = run("study", scene, "-s", step, "-o", "study")
        if step != "6" and step != "1" and scene != "pulled.yaml":
            says(f"{scene}, {step}", done.stdout, f": {step}, ")
    for step, words in (("pull", "step 3 and of step 6"), ("pull 1/3", "step 1 and of step 4"), ("pull 4/3", "from 1 to 6"),
                        ("pull 0/3", "from 1 to 6"), ("pull 1/4", "from 1 to 6"), ("pull 1/3x", "from 1 to 6"), ("b", "from 1 to 6"),
                        ("7", "from 1 to 6"), ("0", "from 1 to 6"), ("1x", "from 1 to 6"), ("static", "from 1 to 6"),
                        ("equilibrium", "from 1 to 6")):
        says(f"--step {step}", run("study", "same.yaml", "-s", step, "-q", "-o", "none", code=2).stderr, words)
    says("no step", run("study", "static.yaml", "-q", "-o", "none", code=2).stderr, "no step but a static one")
    says("--line", run("study", "two.yaml", "--line", "none", "-o", "none", code=2).stderr, "found 'none'")
    says("--line", run("study", "two.yaml", "--history", "--line", "none", "-o", "none", code=2).stderr, "none")
    says("--line", run("study", "two.yaml", "--line", "other", "-s", "2", "-o", "study").stdout, "pull 2/60, other")
    expect("nothing is written where nothing is studied", not os.path.exists("none"))


def no_solution():
    """What has no solution has nothing to compare with, in each verb that solves."""
    words = "no configuration: the ends are farther apart than the line is long"
    for arguments in (("study", "far.yaml"), ("study", "far.yaml", "--history"), ("study", "far.yaml", "--judge", "x.csv"),
                      ("study", "far.yaml", "-c", "meander"), ("run", "far.yaml", "-m", "regularized"), ("run", "far.yaml")):
        says(" ".join(arguments), run(*arguments, "-q", "-o", "far", code=5).stderr, words)
    says("falls", run("run", "falls.yaml", "-q", "-o", "fall", code=5).stderr, "step fall, line bar", "N along (0, 0, -1)")


def options():
    for option in ("--n=x", "--n=0", "--n=nan", "--n=-inf", "--lambda=inf", "--delta=-1", "--delta=1x", "--lambda="):
        expect(option, option.split("=")[0] in run("run", "two.yaml", "-m", "regularized", option, "-q", "-o", "none", code=2).stderr)
    for option in ("--n=x", "--h=x", "--h=inf"):
        expect(option, option.split("=")[0] in run("study", "two.yaml", option, "-q", "-o", "none", code=2).stderr)
    run("study", "two.yaml", "--history", "--n=x", "-q", "-o", "none", code=2)
    for option in ("--resume", "--fields=none", "--sync=end", "--path-tolerance=0", "--no-paraview", "--stiffness", "--out-table"):
        says(option, run("run", "two.yaml", "-m", "regularized", option, "-q", "-o", "none", code=2).stderr, "takes the steps as given")
    for option in ("x", "1e-400", "0.1x", "2", "1e-10", "-1", "nan"):
        says(option, run("run", "equilibrium.yaml", "--path-tolerance=" + option, "-q", "-o", "none", code=2).stderr, "0 or 1e-9 to 1")
    for option, words in (("--sync=x", "step or end"), ("--method=x", "exact or regularized"), ("--fields=x", "none or some of"),
                          ("--n=3", "those of --method regularized"), ("--force=1", "takes no argument"), ("--output", "needs an argument"),
                          ("-o", "needs an argument"), ("--output=", "needs an argument"), ("--outptu", "did you mean '--output'"), ("-Z", "unknown")):
        says(option, run("run", "equilibrium.yaml", option, code=2).stderr, words)
    for option in ("--sync=step", "--method=exact", "--path-tolerance=0"):
        run("run", "equilibrium.yaml", option, "-q", "-o", "plain")
    for verb in ("run", "check", "law", "drive", "study", "schema"):
        says(verb, run(verb, "--help").stdout, f"usage: capstan {verb} [options]", "-h, --help")
        says(verb, run(verb, "--version").stdout, "commit ", "build ")
        says(verb, run(verb, "--nonsense", code=2).stderr, f"Try 'capstan {verb} --help'")
    for verb in ("run", "check", "law", "drive", "study"):
        says(verb, run(verb, code=2).stderr, "no file given")
        says(verb, run(verb, "", code=2).stderr, "unexpected ''")
        says(verb, run(verb, "a", "b", code=2).stderr, "unexpected 'b'")
    says("--", run("check", "--", "--help", code=4).stderr, "--help: ")   # the name of a file
    says("-- --", run("check", "--", "--", code=4).stderr, "--: ")
    many = ["-v", "1"] * 257
    says("-v 257 times", run("law", "x.yaml", *many, code=2).stderr, "more than 256 times")
    says("--tol", run("run", "x.yaml", "--tol", "1", code=2).stderr, "is now '--path-tolerance'")
    says("--tol=", run("run", "x.yaml", "--tol=1", code=2).stderr, "is now '--path-tolerance'")
    says("--tol", run("check", "x.yaml", "--tol", code=2).stderr, "unknown option '--tol'")


def regularized():
    """Two lines by the method of 1990: each has its rows and its picture; a smoothing of 1e-300 m is none that converges."""
    done = run("run", "two.yaml", "-m", "regularized", "-o", "two")
    says("regularized", done.stdout, "pull 1/60 ", "pull 60/60 ", "line-1.svg, ..", "no certificate")
    expect("regularized: of 60 steps two are shown", done.stdout.count("converged") == 4, done.stdout)
    for name in ("line-1.svg", "line-2.svg", "history.csv", "summary.json"):
        expect(name, os.path.exists(os.path.join("two", name)))
    with open("two/history.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))[1:]
    expect("regularized: rows", len(rows) == 120 and {row["line"] for row in rows} == {"rope", "other"}, len(rows))
    summary = json.loads(run("run", "two.yaml", "-m", "regularized", "--json", "-q", "-o", "two").stdout)
    expect("regularized: summary", summary["converged"] and summary["complete"] and len(summary["steps"]) == 60, summary["converged"])
    done = run("run", "two.yaml", "-m", "regularized", "--delta", "1e-300", "-o", "two", code=1)
    says("not converged", done.stdout, "not converged")
    with open("two/summary.json", encoding="utf-8") as file:
        summary = json.load(file)
    expect("not converged: summary", summary["converged"] is False and summary["complete"], summary["converged"])
    done = run("study", "same.yaml", "--history", "-o", "three")
    says("three methods", done.stdout, "methods.csv", "consistent friction")
    done = run("study", "two.yaml", "--history", "--delta", "1e-300", "--line", "other", "-q", "-o", "three", code=1)
    says("three methods", done.stderr, "a regularised solve did not converge")


def slack():
    """Zones without friction leave slack loose, in several pieces; the picture shows the longest one, wherever it is."""
    rows = "".join(f"{0.25 * i!r},{0.225 * i!r},0,0\n" for i in range(41))
    write("nodes.csv", "arc_length,x,y,z\nm,m,m,m\n" + rows)
    for zones, pieces, length, shown in (([(1, 5), (7, 9)], 2, 6, "from 1 to 5 m"), ([(1, 3), (5, 9)], 2, 6, "from 5 to 9 m"),
                                         ([(k + 0.25, k + 0.75) for k in range(10)], 10, 5, "from 0.25 to 0.75 m")):
        text = ", ".join(f"{{from: {a}, to: {b}, factor: 0}}" for a, b in zones)
        write("slack.yaml", f"""capstan: 1
obstacles: {{bed: {{plane: {{}}, friction: 0.5}}}}
lines:
  rope: {{length: 10, weight: 5, stiffness: .inf, friction_zones: [{text}], start: {{nodes: nodes.csv}}, ends: {{A: held, B: held}}}}
history: [{{name: in, rope.B: {{move: [-0.001, 0, 0]}}}}]
""")
        # the stretches that friction holds keep |x'| = 0.9, which is no configuration of the line
        done = run("study", "slack.yaml", "-c", "meander", "-o", "slack", code=1)
        says(f"{pieces} pieces", done.stdout, f"{length} m of it in {pieces} pieces", f"{10 - length} m keep |x'| < 1",
             "held by friction, kept on the obstacle by contact", "loose, kept on the obstacle by contact")
        expect("more parts than are shown", ("and 13 more" in done.stdout) == (pieces == 10), done.stdout)
        with open("slack/completed.svg", encoding="utf-8") as file:
            says("the longest piece", file.read(), "Slack " + shown)
        # laid out, the loose stretches have their length
        with open("slack/completed.csv", newline="", encoding="utf-8") as file:
            nodes = [[float(row[c]) for c in ("arc_length", "x", "y", "z")] for row in list(csv.DictReader(file))[1:]]
        for a, b in zones:
            chords = [sum((q[k] - p[k]) ** 2 for k in (1, 2, 3)) ** 0.5 for p, q in zip(nodes, nodes[1:]) if a <= p[0] and q[0] <= b]
            expect(f"length of {a} to {b}", chords and abs(sum(chords) - (b - a)) < 1e-8 * 10, sum(chords))
    says("--complete", run("study", "slack.yaml", "-c", "knot", "-o", "none", code=2).stderr, "shortest, straight or meander")
    says("two tasks", run("study", "slack.yaml", "-c", "meander", "-j", "x", "-o", "none", code=2).stderr, "expected one at most")
    says("inextensible", run("study", "slack.yaml", "-o", "none", code=3).stderr, "no multiplier", "take inextensible lines too")
    says("inextensible", run("study", "slack.yaml", "--history", "-o", "none", code=3).stderr, "no multiplier")


def on_terminal(*arguments, stop=None):
    """The exit code, and what a command writes on a terminal as its standard error; it is stopped by a signal after `stop` bars."""
    own, terminal = pty.openpty()
    with subprocess.Popen([CAPSTAN, *arguments], stdout=subprocess.DEVNULL, stderr=terminal) as process:
        os.close(terminal)
        said = b""
        while True:
            try:
                select.select([own], [], [], 300)
                got = os.read(own, 65536)
            except OSError:   # the other side is closed
                got = b""
            if not got:
                break
            said += got
            if stop and said.count(b"\r[") >= stop:
                process.send_signal(signal.SIGINT)
                stop = None
    os.close(own)
    return process.returncode, said.decode()


def progress():
    """A terminal shows a bar of 30 places, which is cleared at the end; --quiet shows none."""
    if not has_terminals():
        print("no pseudo-terminals here: the bar is not looked at")
        return
    code, said = on_terminal("run", "two.yaml", "-o", "bar")
    bars = re.findall(r"\r\[([#.]*)\] (\d+)/60  [0-9.]+ s  (pull \d+/60) *", said)
    expect("bars", code == 0 and bars and all(len(bar) == 30 for bar, _, _ in bars), said)
    expect("bars fill", all(bar == "#" * (30 * int(k) // 60) + "." * (30 - 30 * int(k) // 60) for bar, k, _ in bars), bars)
    expect("the last step is shown", bars and bars[-1][1] == "60", bars)
    expect("cleared", said.rindex("\r\033[K") > said.rindex("\r["), said[-200:])
    for arguments in (("run", "two.yaml", "-q", "-o", "bar"), ("run", "two.yaml", "-m", "regularized", "-q", "-o", "bar1")):
        code, said = on_terminal(*arguments)
        expect("quiet", code == 0 and "[" not in said, said)
    code, said = on_terminal("study", "pulled.yaml", "-s", "pull", "-o", "bar2")
    expect("study", code == 0 and re.search(r"\r\[[#.]{30}\] \d+/\d+  [0-9.]+ s  h", said), said)


def rows():
    """50 stages of a step: more than 40 rows, of which each second one is shown, and the last, in the table of steps and in that of ends."""
    done = run("run", "stages.yaml", "-o", "stages")
    shown = re.findall(r"^s(\d+) ", done.stdout, re.M)
    expect("stages", shown == 2 * ([str(i) for i in range(0, 50, 2)] + ["49"]), shown)


def unresolved():
    """With a coarse tolerance it is not known which nodes slip: the summary says nothing of them."""
    write("coarse.yaml", SCENES["two.yaml"].replace("steps: 60", "steps: 2") + "solver: {tolerance: 1e-3}\n")
    run("run", "coarse.yaml", "-o", "coarse")
    with open("coarse/summary.json", encoding="utf-8") as file:
        summary = file.read()
    expect("coarse", '"slipping_m": null' in summary, summary[:600])
    run("run", "two.yaml", "-o", "fine")
    with open("fine/summary.json", encoding="utf-8") as file:
        expect("fine", '"slipping_m": null' not in file.read())


def drives():
    """Many parameters: those printed and those computed are limited, and it is said; the first two of a chain carry its weight."""
    n = 130
    names = [f"p{i}" for i in range(n)]
    laws = "".join(f"    - {{name: l{i}, on: [p{i}], law: {{interval: 1}}}}\n" for i in range(n))
    ties = "".join(f"    - {{p{i}: 1, p{i + 1}: -1}}\n" for i in range(n - 2))
    write("big.yaml", f"capstan: 1\nsystem:\n  parameters: [{', '.join(names)}]\n  laws:\n{laws}  constraints:\n{ties}"
                      f"  drive: [p0]\n  load: {{p3: 0.5, p{n - 1}: 0.5}}\n  velocity: [[1]]\n")
    out = run("drive", "big.yaml").stdout
    # 129 brakes of 1 N are driven together, and the load helps with 0.5 N; the last one holds 0.5 of 1 N
    says("big", out, "gamma = 128.5 W", "p23 1, ..", "l23: force (-1)", "not looked for (no solution, or a large system)", "105) ..",
         "up to 2 times as much")
    expect("big: 24 laws", "l24" not in out)
    answer = json.loads(run("drive", "big.yaml", "--json").stdout)["answers"][0]
    expect("big", answer["velocities"]["outcome"] == "CPS_SET_OUTCOME_NOT_AVAILABLE" and "continuous" not in answer, answer.keys())
    expect("big", len(answer["laws"]) == n and abs(answer["gamma_W"] - 128.5) <= 1e-9 * 128.5, answer["gamma_W"])
    n = 30
    laws = "".join(f"    - {{name: l{i}, on: [p{i}], law: {{interval: 1}}}}\n" for i in range(n))
    write("free.yaml", f"capstan: 1\nsystem:\n  parameters: [{', '.join(names[:n])}]\n  laws:\n{laws}  drive: [{', '.join(names[:28])}]\n"
                       f"  load: {{p{n - 1}: 1}}\n  velocity: [[{', '.join(28 * ['0'])}]]\n")
    out = run("drive", "free.yaml").stdout
    # the load is all that the last brake holds; the brakes that are driven at no speed carry any force of theirs
    says("limit", out, "the load is at the limit", "the velocities are a set of dimension 1", "the resistances are a set of dimension 28",
         "component 24 from -1 to 1 N", "up to 1 times as much")
    expect("limit: 24 components", "component 25" not in out, out[-600:])

    write("slippery.yaml", "capstan: 1\nbody: {patches: [{point: {position: [0, 0], friction: 0, load: 1}}], "
                           "push: [{at: [0, 0], velocity: [1, 0]}], tow: {hitch: [0, 0], path: [[1, 0]], steps: 2100}}\n")
    done = run("drive", "slippery.yaml")
    says("slippery", done.stdout, "when it slides along x: 0 N", "gamma = 0 W", "not unique: w from -inf to inf", "tow in 2100 steps")
    expect("slippery: no limit surface", "limit surface" not in done.stdout)
    says("slippery", done.stderr, "step 2100 of 2100")
    expect("quiet", run("drive", "slippery.yaml", "-q").stderr == "")
    write("play.yaml", "capstan: 1\nsweep: {law: {interval: 1}, stiffness: 2, position: [0], end: [0], path: [[2], [-2]], steps: 30000}\n")
    done = run("drive", "play.yaml", "-p", "play.svg")
    # the spring of 2 N/m is stretched by 0.5 m before the block moves: 1.5 m forth and 3 m back at 1 N
    says("play", done.stdout, "ends at (-1.5) m, force (1) N", "dissipated 4.5 J", "in the spring 0.25 J")
    says("play", done.stderr, "step 30000 of 30000")
    expect("quiet", run("drive", "play.yaml", "-q").stderr == "")
    says("no space", run("drive", "play.yaml", "-q", "-p", "none/play.svg", code=4).stderr, "cannot write")
    write("rope.yaml", "capstan: 1\nrope: {shape: {polyline: [[0, 0], [4, 0]]}, elements: 200, friction: 0.5, weight: 10, "
                       "ends: {A: free, B: [1, 0]}, path: [[6, 0]], steps: 120}\n")
    done = run("drive", "rope.yaml", "-p", "rope.svg")
    # 4 m of 10 N/m with mu 0.5, moved by 2 m
    says("rope", done.stdout, "gamma = 20 W", "resistance of the driven ends: (-20, 0) N", "dissipated 40 J", "end A comes to (2, 0)")
    says("rope", done.stderr, "step 120 of 120")
    write("taut.yaml", "capstan: 1\nrope: {shape: {polyline: [[0, 0], [4, 0]]}, elements: 20, friction: 0.5, weight: 10, "
                       "ends: {A: held, B: [1, 0]}, path: [[6, 0]], steps: 20}\n")
    says("taut", run("drive", "taut.yaml", "-p", "taut.svg", code=5).stdout, "no motion")
    expect("taut: no picture", not os.path.exists("taut.svg"))
    expect("taut", json.loads(run("drive", "taut.yaml", "--json", code=5).stdout)["outcome"] == "CPS_MOTION_OUTCOME_BLOCKED")
    says("axes", run("drive", "big.yaml", "--axes", "1,2", code=2).stderr, "--axes")
    says("plot", run("drive", "big.yaml", "-p", "x.svg", code=2).stderr, "this system has 1")


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, text in SCENES.items():
            write(name, text)
        for part in (checks, steps_by_name, no_solution, options, regularized, slack, progress, rows, unresolved, drives):
            part()
        os.chdir("/")
    print("\n".join(faults))
    print(f"{len(faults)} faults")
    return 1 if faults else 0


sys.exit(main())
