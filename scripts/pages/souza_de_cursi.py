# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/souza-de-cursi-1990.md."""
import json
import math
import os
import re

from marks import read, short, table

STARTS = (("straight", "souza-de-cursi-1990"), ("half circle", "souza-de-cursi-1990-half-circle"), ("full circle", "souza-de-cursi-1990-circle"))
STEPS = ("Y2", "Y3", "Y4", "Y5")


def summary(place):
    return json.loads(read(os.path.join(place, "summary.json")))["steps"]


def study(program, name, step):
    text, place = program.run("study", program.example(name), "--step", step)
    return text, table(os.path.join(place, "study.csv"))


def indented(lines):
    return ["    " + line.rstrip() for line in lines]


def example_5_7(program):
    rows = ["| start | step | J** + j of P4.2 [J] | error of I at the end [J] | of the tension, rms [N] | of the place [m] | Newton steps |",
            "|---|---|---|---|---|---|---|"]
    for start, name in STARTS:
        for k, step in enumerate(STEPS):
            solves = study(program, name, step)[1]
            last = solves[-1]
            energy = float(last["total"]) - float(last["energy_error"])
            rows.append(f"| {start if k == 0 else ''} | {step} | {energy:.7f} | {short(float(last['energy_error']))} | "
                        f"{short(float(last['tension_rms_error']))} | {short(float(last['position_max_error']))} | "
                        f"{short(sum(int(r['iterations']) for r in solves))} |")
    return rows


def orders(program):
    rows = ["| start | step | h | lambda | n | delta |", "|---|---|---|---|---|---|"]
    for start, name in (STARTS[0], STARTS[2]):
        for k, step in enumerate(STEPS):
            solves = study(program, name, step)[1]
            cells = []
            for stage in ("h", "lambda", "n", "delta"):
                rates = [r["energy_rate"] for r in solves if r["stage"] == stage]
                cells.append(", ".join(f"{float(r):.1f}" if r else "-" for r in rates[-2:]))
            rows.append(f"| {start if k == 0 else ''} | {step} | " + " | ".join(cells) + " |")
    return rows


def parameters_leave(program):
    rows = ["| what | column | is due to | largest | at the end |", "|---|---|---|---|---|"]
    solves = study(program, "souza-de-cursi-1990-circle", "Y2")[1]
    for what, column, due in (("penetration [m]", "penetration", "lambda"),
                              ("tension below zero: axial push carried by the stiffness [N]", "compression", "n"),
                              ("friction above its bound: force that friction and contact would have to give beyond what they may, were T alone "
                               "to carry the loads [N]", "friction_excess", "n, lambda"),
                              ("slip where abs(phi) < 0.99 A, against (36) [m]", "creep", "delta"),
                              ("strain below zero, largest 1 - abs(x'), free in J**", "shortening", "J**")):
        values = [float(r[column]) for r in solves]
        rows.append(f"| {what} | `{column}` | {due} | {short(max(values))} | {short(values[-1])} |")
    return rows


def stiffness(program):
    rows = ["| K [N] | Newton steps of the study's 31 solves | its solves that do not end in 2000 steps | iterations of the program for P4.2 |",
            "|---|---|---|---|"]
    for k in (10, 1000, 100000, 10000000):
        path = program.example("souza-de-cursi-1990", elements=100, stiffness=k)
        _, place = program.run("study", path, "--step", "Y2")
        solves = table(os.path.join(place, "study.csv"))
        _, place = program.run("run", path)
        step = summary(place)[0]
        rows.append(f"| {k:g} | {short(sum(int(r['iterations']) for r in solves))} | {sum(r['converged'] == '0' for r in solves)} | "
                    f"{short(step['lines']['cable']['iterations'])} |")
    return rows


def regularized_run(program):
    text, _ = program.run("run", program.example("souza-de-cursi-1990"), "--method", "regularized")
    rows = ["| step | tension B [N] | sunk [m] | tension, rms off [N] | place off [m] |", "|---|---|---|---|---|"]
    place = program.run("run", program.example("souza-de-cursi-1990"), "--method", "regularized")[1]
    for r in table(os.path.join(place, "history.csv")):
        rows.append(f"| {r['step']} | {float(r['tension_B']):.6f} | {short(float(r['penetration']))} | {short(float(r['tension_rms_error']))} | "
                    f"{short(float(r['position_max_error']))} |")
    return rows


def methods(program):
    rows = ["| start | step | tip, regularised [m] | frozen | consistent | regularised - frozen, farthest node | consistent - frozen |",
            "|---|---|---|---|---|---|---|"]
    for start, name in STARTS:
        text, _ = program.run("study", program.example(name), "--history")
        tips = re.findall(r"(?:regularised, 1990|frozen friction|consistent friction)\s+(\S+)\s+(\S+)\s+(\S+)\s+(\S+)", text)[3:]
        for k, step in enumerate(STEPS):
            own = tips[3 * k:3 * k + 3]
            places = " | ".join(", ".join(f"{float(c) + 0:.5f}".replace("-0.00000", "0.00000") for c in t[:3]) for t in own)
            rows.append(f"| {start if k == 0 else ''} | {step} | {places} | {short(float(own[0][3]))} | {short(float(own[2][3]))} |")
    return rows


def slack_of_y4(program):
    text, _ = study(program, "souza-de-cursi-1990", "Y4")
    lines = text[text.index("slack:"):].split("\n")
    return indented(lines[:lines.index("")])


def first_order(program):
    rows = ["| start | step | P10.1 with C of (77) | from P2.1 [m] |", "|---|---|---|---|"]
    for start, name in STARTS:
        for k, step in enumerate(STEPS):
            text, _ = study(program, name, step)
            said = text[text.index("C of (77)"):].split("\n")
            verdict = said[0].split(": ", 1)[1].split(":")[0]
            more = re.search(r"at most (\S+) m", said[1])
            force = re.search(r"\(([^)]*)\) N", said[1])
            vector = ", ".join(f"{float(c):.3f}".replace("-0.000", "0.000") for c in force[1].split(",")) if force else ""
            rows.append(f"| {start if k == 0 else ''} | {step} | {verdict}{f': ({vector}) N is carried by nothing' if force else ''} | "
                        f"{f'{float(more[1]):.4f}' if more else ''} |")
    return rows


def plane(program):
    rows = ["| history of the end force [N] | tip [m] | slack [m] |", "|---|---|---|"]
    _, place = program.run("run", program.example("souza-de-cursi-1990-plane"))
    lines = summary(place)[-1]["lines"]
    for name, forces in (("direct", "0.5 e3 at once"), ("around", "0.5 (e1 + e2 + e3), e3, 0.5 e3"), ("aside", "e2 + 0.5 e3, 0.5 e3")):
        line = lines[name]
        tip = ", ".join(f"{c:.4f}" if abs(c) > 1e-9 else "0" for c in line["B"]["position_m"])
        rows.append(f"| {forces} | {tip} | {line['slack_m']:.3f} |")
    return rows


def tip_height(program):
    """A vertical end: f = 0.5 N lifts f/w of line, stretched by f^2/(2 w K)."""
    exact = 0.5 / 9.81 + 0.5 ** 2 / (2 * 9.81 * 10)
    rows = ["| elements | height of the tip of Y4 [m] | below f/w + f^2/(2 w K) |", "|---|---|---|"]
    for n in (200, 400, 800, 1600, 3200):
        _, place = program.run("run", program.example("souza-de-cursi-1990", elements=n))
        height = summary(place)[2]["lines"]["cable"]["B"]["position_m"][2]
        rows.append(f"| {n} | {height:.5f} | {100 * (1 - height / exact):.1f} % |")
    return rows


def load_steps(program):
    """Tip of Y5, consistent less frozen, from the straight line with each force put on in n steps."""
    rows = ["| steps per force | consistent - frozen, tip of Y5 [mm] |", "|---|---|"]
    for n in (1, 10, 30):
        tip = []
        for law in ("frozen", "consistent"):
            text = read(os.path.join(program.root, program.example("souza-de-cursi-1990"))).replace("friction_policy: frozen", f"friction_policy: {law}")
            path = program.file(f"steps-{n}-{law}.yaml", re.sub(r"(\{name: Y\d, )", rf"\1steps: {n}, ", text))
            _, place = program.run("run", path, "--no-paraview")
            tip.append(summary(place)[-1]["lines"]["cable"]["B"]["position_m"])
        rows.append(f"| {n} | {1000 * math.dist(*tip):.2f} |")
    return rows


def mesh(program):
    """What the study's end leaves in Y2, with finer and finer meshes."""
    rows = ["| elements | error of the tension, rms [N] | uncarried [N] | Newton steps |", "|---|---|---|---|"]
    for n in (200, 800, 3200, 12800):
        _, place = program.run("study", program.example("souza-de-cursi-1990", elements=n), "--step", "Y2")
        solves = table(os.path.join(place, "study.csv"))
        rows.append(f"| {n} | {short(float(solves[-1]['tension_rms_error']))} | {short(float(solves[-1]['friction_excess']))} | "
                    f"{short(sum(int(r['iterations']) for r in solves))} |")
    return rows


# ---- in sentences ----

def parameters(program):
    """Where the study of Y2 begins and ends: l/h, lambda, 1/n, delta; and its solves."""
    solves = study(program, "souza-de-cursi-1990", "Y2")[1]
    ends = [f"{6.28 / f([float(r['h']) for r in solves]):.0f}" for f in (max, min)]
    for column in ("lambda", "1/n", "delta"):
        values = [float(r[column]) for r in solves]
        ends += [short(f(values)) for f in ((min, max) if column == "lambda" else (max, min))]
    return [*ends, str(len(solves))]


def slack_of_y4_mm(program):
    """What Y4 lets down: the loose part of its slack."""
    low, high = re.search(r"(\S+) to +(\S+) m +loose", study(program, "souza-de-cursi-1990", "Y4")[0]).groups()
    return f"{1000 * (float(high) - float(low)):.0f}"


def apart(program):
    """Least and largest difference of the two laws of friction in the table of methods, in cm."""
    cells = [float(row.split("|")[-2]) for row in methods(program)[2:]]
    return [f"{100 * min(cells):.0f}", f"{100 * max(cells):.0f}"]


def tension_of_y2(program):
    line = summary(program.run("run", program.example("souza-de-cursi-1990", elements=100))[1])[0]["lines"]["cable"]
    return f"{line['B']['tension_N']:.2f}"


def steel_line(program):
    """EA/T, what the study leaves in the tension, and the tension in kN, of the step `surge out`."""
    _, place = program.run("study", program.example("oc3-hywind-line"), "--step", "surge out")
    off = float(table(os.path.join(place, "study.csv"))[-1]["tension_rms_error"])
    steps = summary(program.run("run", program.example("oc3-hywind-line"))[1])
    tension = next(s for s in steps if s["name"] == "surge out 10/10")["lines"]["mooring"]["B"]["tension_N"]
    stiffness = float(re.search(r"stiffness: (\S+)", read(os.path.join(program.root, program.example("oc3-hywind-line"))))[1].rstrip(","))
    return [f"{stiffness / tension:.0f}", short(off), f"{tension / 1000:.0f}"]


LINE = "lines:\n  line: {{length: 1, elements: 50, weight: 1, stiffness: {}, start: {{straight: {{from: [0, 0, 0], to: [1, 0, 0]}}}}, ends: {}}}\n"


def unbounded(program):
    text = "capstan: 1\nfriction_policy: frozen\nobstacles: {bed: {plane: {}, friction: 0.3}}\n" + LINE.format("100", "{A: free, B: free}")
    _, place = program.run("run", program.file("unbounded.yaml", text + "history: [{line.B: {force: [0.5, 0, 0]}}]\n"))
    return f"{summary(place)[0]['lines']['line']['proof']['fall_N']:.2g}"


def infeasible(program):
    text = "capstan: 1\n" + LINE.format(".inf", "{A: held, B: held}") + "history: [{line.B: {position: [1.2, 0, 0]}}]\n"
    _, place = program.run("run", program.file("infeasible.yaml", text))
    return f"{summary(place)[0]['lines']['line']['proof']['excess_m']:.2g}"


def annex_5(program, force="-0.4, 0, 0"):
    text = read(os.path.join(program.root, program.example("souza-de-cursi-1990-annex-5"))).replace("-0.4, 0, 0", force)
    return program.run("study", program.file("annex-5-" + re.sub(r"\W+", "_", force) + ".yaml", text))[0]


def shortened(program):
    """Least t.u', and where (86) fails."""
    return list(re.search(r"t_R\.u' = (-[\d.]+) at.*?fails on (\S+) m", annex_5(program)).groups())


def pulled(program):
    found = re.search(r"at most (\S+) m from the solution of P2.1", annex_5(program, "0.4, 0, 0"))
    return "1e-12" if float(found[1]) <= 1e-12 else short(float(found[1]))  # rounding of 200 elements


def across(program):
    """What is carried by nothing of 0.3 N across the slack end, either way, and what half an element carries."""
    left = [max(abs(float(c)) for c in re.search(r"\(([^)]*)\) N at", annex_5(program, force))[1].split(",")) for force in ("0, 0, 0.3", "0, 0.3, 0")]
    if abs(left[0] - left[1]) > 1e-9:
        raise SystemExit(f"annex 5: {left}")
    return [f"{left[0]:.4f}", f"{0.3 - left[0]:.4f}"]


def order_of_first_order(program):
    """Distance of P10.1 and P2.1 of a taut line on a smooth bed, for changes of the force of 0.2 and 0.1 N."""
    far = []
    for change in (0.2, 0.1):
        text = ("capstan: 1\nfriction_policy: frozen\nobstacles: {bed: {plane: {}}}\n" + LINE.format("10", "{A: held, B: {force: [1, 0, 0]}}") +
                f"history: [{{line.B: {{force: [1, 0, 0]}}}}, {{line.B: {{force: [1, {change}, {change}]}}}}]\n")
        said, _ = program.run("study", program.file(f"taut-{change}.yaml", text), "--step", "2")
        far.append(float(re.search(r"at most (\S+) m from the solution of P2.1", said)[1]))
    return f"{math.log2(far[0] / far[1]):.2f}"


def warnings(program, number, pattern):
    done = program.call("run", program.example(f"souza-de-cursi-1990-example-11-{number}"), "-o", os.path.join(program.folder, f"eleven-{number}"), errors=True)
    return [f"{float(c):.3g}" for c in re.search(pattern, done).groups()]


SENTENCES = [
    ("both are least at alpha = {}", lambda p: f"{-(1 + 1 / 8)}"),
    ("h from l/{} to l/{}, lambda from {} to {} N/m2, 1/n from {} to {} N m2, delta from {} m to {} m. Each study is {} solves", parameters),
    ("the energy w^2 l/(2 lambda) = {} J",
     lambda p: short(9.81 ** 2 * 6.28 / 2 / max(float(r["lambda"]) for r in study(p, "souza-de-cursi-1990", "Y2")[1]))),
    ("In Y4, {} mm of line come down", slack_of_y4_mm),
    ("the tension being {} N", tension_of_y2),
    ("So beyond {} elements the study ends", lambda p: p.constant("regularized/method.c", r"finer = (\d+) ?\* ?shortest")),
    ("(EA/T = {}, step `surge out`) the study ends with an rms error of {} N of the tensions, which are about {} kN", steel_line),
    ("between frozen and consistent friction, {} to {} cm", apart),
    ("It prints its tolerance, {} or that", lambda p: p.constant("study_solutions.c", r"if \(!text\)\s+return (\S+);")),
    ("All have abs(x') = 1 to {} and the energy", lambda p: p.constant("test_solutions.c", r"laid\.shortening\), (\S+)\)")),
    ("In Y5 the {} mm are held by friction", slack_of_y4_mm),
    ("unbounded: the energy falls by {} N per metre along the pull", unbounded),
    ("infeasible: {} m too far", infeasible),
    ("{} in the last element where (86) asks for >= 0; (86) fails on {} m", shortened),
    ("and it is that of P2.1 to {} m", pulled),
    ("no solution: {} N at a = l carried by nothing (half an element's weight or friction carries {} N)", across),
    ("less than half an element's {} N across it or pushing", lambda p: across(p)[1]),
    ("second order in the change (observed {})", order_of_first_order),
    ("the line is {} m inside the obstacle;", lambda p: warnings(p, 1, r"the line is (\S+) m inside")),
    ("bounds differ from mu R by {} N of {} N", lambda p: warnings(p, 1, r"differ from mu R by (\S+) N, of (\S+) N in all")),
    ("friction of {} N, of bounds of {} N, acts where", lambda p: warnings(p, 2, r"friction of (\S+) N, of bounds of (\S+) N in all, acts")),
    ("friction of {} N of {} N acts in the air", lambda p: warnings(p, 3, r"friction of (\S+) N, of bounds of (\S+) N in all, acts")),
    ("{} N is mu w l less the half element", lambda p: warnings(p, 2, r"friction of (\S+) N")),
]

# data of examples and of tests, and the papers'
GIVEN = ["Ann. Fac. Sci. Toulouse 11 (1990) 137–186", "slack on 0.6 m of 1 m", "800 elements, mu = 0.0255", "100 elements, with a stiffness", "figures 5 to 12",
         "curves of length 6.28 m", "lifted by 0.1 mm", "pulled by 0.4 N of the 1 N", "T = (a - 0.6 m) N/m", "T = 0.4 a N/m", "pulled by 0.5 N on a bed",
         "mu w l = 0.3 N", "ends 1.2 m apart", "eta = 0.4 |", "t.u' = -(a - 0.6)", "beyond a = 0.6 m", "up to s = 0.6", "f = 0.3 e3 or 0.3 e2", "T = 0.4 N at A", "force 0.5 e3 N",
         "with 0.5 N;", "not carry over is 4.4 (i)", "| 11.1, through", "| 11.2, friction", "| 11.3, an equilibrium", "T = 0 of 11.1",
         "50 random steps of five kinds", "50 random steps in a quadratic field", "scene alone, to 1e-8 of the sum", "has the solution u = 0.2 N/k", "in the one solution, to 1e-6 m"]


# ---- pictures ----

def of_study(file, name, *arguments):
    return lambda program: os.path.join(program.run("study", program.example(name), *arguments)[1], file)


def relaxed(program):
    """Figure 4 is drawn for K = 8 times the tension: a line of K = 8 N pulled by 1 N."""
    text = ("capstan: 1\nfriction_policy: frozen\nlines:\n  cable: {length: 1, elements: 20, weight: 0, stiffness: 8, "
            "start: {straight: {from: [0, 0, 0], to: [1, 0, 0]}}, ends: {A: held, B: free}}\nhistory: [{cable.B: {force: [1, 0, 0]}}]\n")
    return os.path.join(program.run("study", program.file("relaxed.yaml", text))[1], "relaxed.svg")


PICTURES = {
    "classic-study": of_study("study.svg", "souza-de-cursi-1990", "--step", "Y2"),
    "classic-relaxed": relaxed,
    "classic-first-order": of_study("first-order.svg", "souza-de-cursi-1990-annex-5"),
    "classic-completions": of_study("completed.svg", "souza-de-cursi-1990-slack", "--complete", "shortest"),
    "classic-history-straight": of_study("methods.svg", "souza-de-cursi-1990", "--history"),
    "classic-history-half-circle": of_study("methods.svg", "souza-de-cursi-1990-half-circle", "--history"),
    "classic-history-circle": of_study("methods.svg", "souza-de-cursi-1990-circle", "--history"),
}

FIGURES = {"example-5-7": example_5_7, "orders": orders, "parameters-leave": parameters_leave, "stiffness": stiffness,
           "regularized-run": regularized_run, "methods": methods, "slack-of-y4": slack_of_y4, "first-order": first_order, "plane": plane,
           "tip-height": tip_height, "load-steps": load_steps, "mesh": mesh}
