#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Solve the same load step with capstan and with general conic solvers, to the same accuracy, and compare.

    compare.py [--bench STEP_BENCH] [--case souza|oc3] [--elements 100,1000,...] [--solvers a,b] [--limit SECONDS] [--as-written] [--csv FILE]

The solvers are Clarabel, ECOS, QOCO and SCS, as far as the package index gives them; they are installed, at the first run,
into a virtual environment of their own in build/bench-venv. Nothing else of the project depends on them.

One step (docs/theory.md) with lengths divided by the line's length L and forces by the sum of its loads:

    min  sum l c T^2/2 + sum w t - sum b.u    (1 + c T_i, e_i) in Q4,  (t_j, tangential u_j) in Q3,  gap_j + n.u_j >= 0

with e_i = e_i^0 + (u_i - u_{i-1})/l_i. Clarabel, QOCO and SCS take the quadratic cost; ECOS gets it as one rotated cone per
element. General solvers are sensitive to how that is scaled, so each is given it in six ways (rows of the stretch cones times
1, sqrt(l) or l; cost times 1 or the number of elements) and keeps the fastest.

One norm judges all answers, capstan's too: from positions, friction and reactions the segment forces follow by summation, so
that forces balance; the sum of the local Fenchel gaps, each >= 0, over the scale S, plus what is left of imbalance over the
largest force. A solver's own tolerances are tightened tenfold until that norm is at most the accuracy asked, 1e-8; the time is
that of the first run that reaches it, the fastest of three: seconds of processor for set-up and solution, without the
conversion of matrices. capstan's is the whole step as it does it by default, its scaling, the refinement to the smallest gap and
the certificate included."""
import argparse
import csv
import importlib.util
import io
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), ".."))
VENV = os.path.join(ROOT, "build", "bench-venv")
PACKAGES = ["numpy", "scipy", "clarabel==0.11.1", "ecos==2.0.14", "qoco==0.3.2", "scs==3.3.1"]
ACCURACY = 1e-8
TOLERANCES = [10.0**-k for k in range(4, 15)]
AS_WRITTEN = [("1", "1")]  # rows, cost: the step as it stands above
SCALINGS = [("sqrt(l)", "N"), ("l", "1"), ("1", "N"), ("sqrt(l)", "1"), ("l", "N"), ("1", "1")]  # rows, cost
REPEATS = 3
PATIENCE = 4      # tightenings in a row that do not halve the norm end the search in one scaling
ALL_SOLVES = 3    # all solves of one solver and size together may take so many times the limit of one


def enter_environment():
    """Run again inside the virtual environment, made at the first run; packages that are not to be had, in these versions, are skipped."""
    python = os.path.join(VENV, "bin", "python")
    if os.path.realpath(sys.prefix) == os.path.realpath(VENV):
        return
    if not os.path.exists(python):
        print(f"compare: making {os.path.relpath(VENV)}", file=sys.stderr)
        subprocess.run([sys.executable, "-m", "venv", VENV], check=True)
    present = subprocess.run([python, "-m", "pip", "freeze"], capture_output=True, text=True, check=True).stdout.lower().split()
    for name in PACKAGES:
        if name not in present and not any(line.startswith(name + "==") for line in present):
            if subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", name]).returncode:
                print(f"compare: {name} cannot be installed: left out", file=sys.stderr)
    os.execv(python, [python, os.path.abspath(sys.argv[0])] + sys.argv[1:])


if __name__ == "__main__":
    enter_environment()
    os.environ["OMP_NUM_THREADS"] = "1"
    import numpy as np
    from scipy import sparse


# the step problem ---------------------------------------------------------------------------------------------------


class Problem:
    """What `step_bench --dump` writes: the step's data, and capstan's answer to it."""

    def __init__(self, path):
        ends, numbers = {}, {}
        with open(path, encoding="ascii") as file:
            if file.readline().strip() != "# capstan step problem 1":
                sys.exit(f"compare: {path} is not a step problem")
            for line in file:
                if not line.startswith("#"):
                    names = line.strip().split(",")
                    break
                word, *rest = line[1:].split()
                if word == "end":
                    ends[rest[0]] = (rest[1] == "held", np.array(rest[2:], float))
                else:
                    numbers[word] = float(rest[0])
            table = np.loadtxt(file, delimiter=",", ndmin=2)
        column = {name: table[:, k] for k, name in enumerate(names)}
        vector = lambda name: np.stack([column[f"{name}_{a}"] for a in "xyz"], axis=1)
        self.compliance, self.iterations, self.seconds = numbers["compliance"], int(numbers["iterations"]), numbers["seconds"]
        self.ends = [ends["A"], ends["B"]]
        self.length = column["element_length"][1:]
        self.reference, self.load, self.normal = vector("reference"), vector("load"), vector("normal")
        self.gap, self.bound = column["gap"], column["friction_bound"]
        self.answer = Answer(vector("position"), vector("friction_force"), column["reaction"], vector("segment_force")[1:])
        self.nodes = len(self.gap)
        self.held = np.zeros(self.nodes, bool)
        self.held[[0, -1]] = self.ends[0][0], self.ends[1][0]
        if not self.held.any():
            sys.exit("compare: a line with two free ends is not supported here")


class Answer:
    """Positions (nodes, 3), friction (nodes, 3), reactions (nodes) and segment forces (nodes - 1, 3)."""

    def __init__(self, position, friction, reaction, force):
        self.position, self.friction, self.reaction, self.force = position, friction, reaction, force


# the one norm -------------------------------------------------------------------------------------------------------


def dot(a, b):
    return np.einsum("ij,ij->i", a, b)


def size(a):
    return np.sqrt(dot(a, a))


def angle_defect(a, b):
    """|a||b| - a.b of each row, without cancellation."""
    both, along = size(a)*size(b), dot(a, b)
    cross = np.cross(a, b)
    sharp = dot(cross, cross)/np.where(along > 0, both + along, 1)
    return np.where(along > 0, sharp, both - along)


def admissible(problem, answer):
    """The answer made admissible: ends where they are held, above the obstacle, |F| <= w, R >= 0, forces in balance."""
    n, free = problem.normal, ~problem.held
    x = answer.position.copy()
    for j, (held, where) in zip((0, -1), problem.ends):
        if held:
            x[j] = where
    watched = np.isfinite(problem.gap) & free
    below = np.where(watched, np.minimum(0, dot(n, x - problem.reference) + np.where(watched, problem.gap, 0)), 0)
    x -= below[:, None]*n

    f = answer.friction - dot(answer.friction, n)[:, None]*n
    much = size(f)
    f *= np.where(free, problem.bound/np.maximum(np.maximum(much, problem.bound), 1e-300), 0)[:, None]
    r = np.where(watched, np.maximum(answer.reaction, 0), 0)

    # -p_j + p_{j+1} + F + R n + b = 0 at every free node
    q = problem.load + f + r[:, None]*n
    if problem.held[0]:
        p = np.cumsum(q[:0:-1], axis=0)[::-1]  # from B, as if it were free
        if problem.held[-1]:
            p -= q[-1]
            p += np.mean(answer.force - p, axis=0)
    else:
        p = -np.cumsum(q[:-1], axis=0)
    return Answer(x, f, r, p)


def norm(problem, answer):
    """Relative gap plus relative imbalance of the admissible answer next to the given one."""
    a = admissible(problem, answer)
    l, c, n = problem.length, problem.compliance, problem.normal
    e, force = np.diff(a.position, axis=0)/l[:, None], size(a.force)
    much = size(e)
    over, along = much - 1, c*force

    # segments: l [W(e) + W*(p) - p.e]
    gap = angle_defect(a.force, e)
    excess = 0
    if c > 0:
        gap += np.where(over > 0, 0.5*(over - along)**2/c, force*(-over + 0.5*along))
    else:
        gap += force*np.maximum(-over, 0)
        excess = max(0, over.max())
    total, scale = np.sum(l*gap), np.sum(l*force*(1 + along))

    # friction: w |u_T| + F.u_T,  contact: R (n.u + gap)
    u = a.position - problem.reference
    ut = u - dot(u, n)[:, None]*n
    free = ~problem.held
    slide, drag = size(ut), size(a.friction)
    law = (problem.bound - drag)*slide + angle_defect(-a.friction, ut)
    touch = np.where(a.reaction > 0, a.reaction*np.maximum(dot(n, u) + np.where(np.isfinite(problem.gap), problem.gap, 0), 0), 0)
    total += np.sum(law[free]) + np.sum(touch[free])
    scale += np.sum((problem.bound*slide)[free]) + np.sum(size(problem.load)*size(a.position - a.position[0]))

    # what is left of the imbalance
    rest = problem.load + a.friction + a.reaction[:, None]*n
    rest[1:] -= a.force
    rest[:-1] += a.force
    largest = max(force.max(), size(problem.load).max(), a.reaction.max())
    value = total/scale + size(rest)[free].max()/largest + excess
    return value if np.isfinite(value) else np.inf


# the conic form -----------------------------------------------------------------------------------------------------


class Conic:
    """min x.P x/2 + q.x,  h - G x in R+^l x Q3 ... x Q4 ...;  x = (u of free nodes, T of elements, t of nodes with friction)."""

    def __init__(self, problem, scaling):
        self.problem, self.scaling = problem, f"rows {scaling[0]}, cost {scaling[1]}"
        self.L = L = np.sum(problem.length)
        self.F = F = np.sum(size(problem.load))
        self.frame = frame(problem.normal)
        free = np.flatnonzero(~problem.held)
        m, self.free = problem.nodes - 1, free
        l, c = problem.length/L, problem.compliance*F
        self.l = l
        self.discs = np.flatnonzero((problem.bound > 0) & ~problem.held)
        self.stops = np.flatnonzero(np.isfinite(problem.gap) & ~problem.held)
        at = np.full(problem.nodes, -1)
        at[free] = 3*np.arange(len(free))
        tension, slide = 3*len(free), 3*len(free) + (m if c > 0 else 0)
        self.slide, self.columns = slide, slide + len(self.discs)

        # the objective
        self.q = np.zeros(self.columns)
        self.q[:tension] = -(problem.load[free] @ self.frame.T).ravel()/F
        self.q[slide:] = problem.bound[self.discs]/F
        self.p = np.zeros(self.columns)
        self.p[tension:slide] = l*c if c > 0 else 0

        # the rows: reactions, friction discs, tensions
        rows, cols, values = [], [], []

        def put(row, col, value):
            keep = col >= 0
            rows.append(row[keep]), cols.append(col[keep]), values.append(np.broadcast_to(value, row.shape)[keep])

        ns, nr = len(self.stops), len(self.discs)
        h = np.zeros(ns + 3*nr + 4*m)
        put(np.arange(ns), at[self.stops] + 2, -1.0)
        h[:ns] = problem.gap[self.stops]/L
        first = ns + 3*np.arange(nr)
        put(first, slide + np.arange(nr), -1.0)
        for a in range(2):
            put(first + 1 + a, at[self.discs] + a, -1.0)
        stretch = ns + 3*nr + 4*np.arange(m)
        if c > 0:
            put(stretch, tension + np.arange(m), -c)
        h[stretch] = 1
        # held nodes are where they are held; the others move by u
        fixed = problem.reference.copy()
        for j, (held, where) in zip((0, -1), problem.ends):
            if held:
                fixed[j] = where
        e = (np.diff(fixed, axis=0)/problem.length[:, None]) @ self.frame.T
        for a in range(3):
            h[stretch + 1 + a] = e[:, a]
            put(stretch + 1 + a, np.where(at[1:] >= 0, at[1:] + a, -1), -1/l)
            put(stretch + 1 + a, np.where(at[:-1] >= 0, at[:-1] + a, -1), 1/l)
        where = np.concatenate(rows), np.concatenate(cols)
        G = sparse.csc_matrix((np.concatenate(values), where), shape=(len(h), self.columns))

        # the scaling asked for, and what undoes it on the duals
        factor, cost = np.ones(len(h)), m if scaling[1] == "N" else 1
        factor[ns + 3*nr:] = np.repeat({"1": 1 + 0*l, "sqrt(l)": np.sqrt(l), "l": l}[scaling[0]], 4)
        self.h, self.G = h*factor, sparse.csc_matrix(sparse.diags(factor) @ G)
        self.q, self.p, self.undo = cost*self.q, cost*self.p, factor/cost
        self.P = sparse.diags(self.p, format="csc")
        self.orthant, self.cones = ns, [3]*nr + [4]*m

    def answer(self, x, z):
        """Positions and forces in world axes from primal x and dual z."""
        problem, F, z = self.problem, self.F, z[:len(self.undo)]*self.undo
        position = problem.reference.copy()
        position[self.free] += self.L*x[:3*len(self.free)].reshape(-1, 3) @ self.frame
        ns, nr = self.orthant, len(self.discs)
        reaction, friction = np.zeros(problem.nodes), np.zeros((problem.nodes, 3))
        reaction[self.stops] = F*z[:ns]
        friction[self.discs, :2] = F*z[ns:ns + 3*nr].reshape(-1, 3)[:, 1:]
        force = -F*z[ns + 3*nr:].reshape(-1, 4)[:, 1:]/self.l[:, None]
        return Answer(position, friction @ self.frame, reaction, force @ self.frame)

    def linear(self):
        """(q, G, h, cones) with the quadratic cost as rotated cones: p T^2/2 <= p r/2 where (r + 1, r - 1, 2 T) in Q3."""
        index = np.flatnonzero(self.p)
        k = len(index)
        r = self.columns + np.arange(k)
        row = 3*np.arange(k)
        more = sparse.csc_matrix((np.concatenate([np.full(2*k, -1.0), np.full(k, -2.0)]),
                                  (np.concatenate([row, row + 1, row + 2]), np.concatenate([r, r, index]))),
                                 shape=(3*k, self.columns + k))
        G = sparse.vstack([sparse.hstack([self.G, sparse.csc_matrix((self.G.shape[0], k))]), more], format="csc")
        h = np.concatenate([self.h, np.tile([1.0, -1.0, 0.0], k)])
        return np.concatenate([self.q, 0.5*self.p[index]]), G, h, self.cones + [3]*k


def frame(normal):
    """Rows: two tangents and the obstacle's normal, the same for all nodes; the axes themselves without an obstacle."""
    n = normal[np.argmax(size(normal))]
    if not n.any():
        return np.eye(3)
    t = np.cross(n, np.eye(3)[np.argmin(np.abs(n))])
    t /= np.linalg.norm(t)
    return np.stack([t, np.cross(n, t), n])


# the solvers: (conic, tolerance, time limit) -> (x, z, iterations, seconds, status) ---------------------------------


def solve_clarabel(conic, tolerance, limit):
    import clarabel
    s = clarabel.DefaultSettings()
    s.verbose, s.max_iter, s.time_limit, s.max_threads = False, 500, limit, 1
    s.tol_gap_abs = s.tol_gap_rel = s.tol_feas = tolerance
    cones = [clarabel.NonnegativeConeT(conic.orthant)] + [clarabel.SecondOrderConeT(k) for k in conic.cones]
    begin = time.process_time()
    out = clarabel.DefaultSolver(conic.P, conic.q, conic.G, conic.h, cones, s).solve()
    seconds = time.process_time() - begin
    return np.array(out.x), np.array(out.z), out.iterations, seconds, str(out.status)


def solve_ecos(conic, tolerance, _limit):
    import ecos
    q, G, h, cones = conic.linear()
    begin = time.process_time()
    out = ecos.solve(q, G, h, {"l": conic.orthant, "q": cones}, verbose=False, max_iters=500,
                     abstol=tolerance, reltol=tolerance, feastol=tolerance)
    seconds = time.process_time() - begin
    return out["x"], out["z"], out["info"]["iter"], seconds, out["info"]["infostring"]


def solve_qoco(conic, tolerance, _limit):
    import qoco
    dims = np.array(conic.cones, np.int32)
    begin = time.process_time()
    solver = qoco.QOCO()
    solver.setup(conic.columns, len(conic.h), 0, conic.P, conic.q, None, None, conic.G, conic.h, conic.orthant,
                 len(dims), dims, abstol=tolerance, reltol=tolerance, max_iters=500, verbose=0)
    out = solver.solve()
    seconds = time.process_time() - begin
    return np.array(out.x), np.array(out.z), out.iters, seconds, str(out.status)


def solve_scs(conic, tolerance, limit):
    import scs
    begin = time.process_time()
    solver = scs.SCS({"P": conic.P, "A": conic.G, "b": conic.h, "c": conic.q}, {"l": conic.orthant, "q": conic.cones},
                     eps_abs=tolerance, eps_rel=tolerance, max_iters=10**9, time_limit_secs=limit, verbose=False)
    out = solver.solve()
    seconds = time.process_time() - begin
    return out["x"], out["y"], out["info"]["iter"], seconds, out["info"]["status"]


SOLVERS = {"clarabel": solve_clarabel, "ecos": solve_ecos, "qoco": solve_qoco, "scs": solve_scs}


def apart(name, conic, tolerance, limit):
    """One solve in a process of its own; None when it takes longer than the limit, or dies."""
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)

    def work():
        importlib.import_module(name)
        begin = time.perf_counter()
        x, z, iterations, seconds, status = SOLVERS[name](conic, tolerance, limit)
        wall = time.perf_counter() - begin
        there.send((norm(conic.problem, conic.answer(x, z)), iterations, seconds, wall, status))

    process = context.Process(target=work)
    process.start()
    there.close()
    try:
        return here.recv() if here.poll(limit + 30) else None
    except EOFError:
        return None
    finally:
        process.kill()
        process.join()


def first_to_reach(name, conic, limit, left, slowest):
    """Tighten the tolerance until the norm is reached, or no longer follows; runs slower than `slowest` are of no use."""
    best, idle, begin = None, 0, time.perf_counter()
    for tolerance in TOLERANCES:
        found = apart(name, conic, tolerance, limit)
        if found is None:
            return best
        value, iterations, seconds, wall, status = found
        idle = 0 if best is None or value < 0.5*best["norm"] else idle + 1
        if best is None or value < best["norm"]:
            best = {"norm": value, "iterations": iterations, "seconds": seconds, "wall": wall, "tolerance": tolerance,
                    "note": f"{conic.scaling}: {status}"}
        if value <= ACCURACY or seconds > slowest or idle == PATIENCE or time.perf_counter() - begin > left:
            return best
    return best


def best_of(name, problem, limit, scalings):
    """The fastest way for this solver to reach the norm, or the best norm that it reaches: a row of the table."""
    best, left = None, ALL_SOLVES*limit
    nan = float("nan")
    nothing = {"norm": float("inf"), "iterations": 0, "seconds": nan, "wall": nan, "tolerance": nan, "note": "no answer"}
    for count, scaling in enumerate(scalings):
        reached = best is not None and best["norm"] <= ACCURACY
        conic = Conic(problem, scaling)
        begin = time.perf_counter()
        row = first_to_reach(name, conic, limit, left, best["seconds"] if reached else float("inf"))
        left -= time.perf_counter() - begin
        good = row is not None and row["norm"] <= ACCURACY
        if row and (best is None or (good and (not reached or row["seconds"] < best["seconds"])) or
                    (not good and not reached and row["norm"] < best["norm"])):
            best, chosen = row, conic
        if left <= 0:
            break
    late = f"; out of time after {count + 1} of {len(scalings)} scalings" if left <= 0 else ""
    if best is None or best["norm"] > ACCURACY:
        best = best or nothing
        return {**best, "note": f"NOT REACHED; {best['note']}{late}"}
    for _ in range(REPEATS - 1):
        again = apart(name, chosen, best["tolerance"], limit)
        if again:
            best["seconds"], best["wall"] = min(best["seconds"], again[2]), min(best["wall"], again[3])
    return {**best, "note": best["note"] + late}


# capstan ------------------------------------------------------------------------------------------------------------


def capstan_problem(bench, case, elements):
    """The step problem with capstan's answer to it."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "step.csv")
        subprocess.run([bench, "--case", case, "--elements", str(elements), "--dump", path], check=True)
        return Problem(path)


def capstan_seconds(bench, case, elements):
    """The fastest of the repeats."""
    command = [bench, "--case", case, "--elements", str(elements)]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return 1e-3*float(next(csv.DictReader(io.StringIO(text)))["min_ms"])


# the table ----------------------------------------------------------------------------------------------------------

COLUMNS = ["case", "elements", "solver", "iterations", "norm", "solve_s", "wall_s", "ratio", "own_tolerance", "note"]


def compare(bench, case, elements, solvers, limit, scalings):
    """Rows of one size."""
    problem = capstan_problem(bench, case, elements)
    rows = {"capstan": {"norm": norm(problem, problem.answer), "iterations": problem.iterations,
                        "seconds": capstan_seconds(bench, case, elements), "tolerance": float("nan"), "note": "by default"}}
    for name in solvers:
        if importlib.util.find_spec(name) is None:
            print(f"compare: {name} is not installed: left out", file=sys.stderr)
            continue
        rows[name] = best_of(name, problem, limit, scalings)
    # once more after the others, as they too had more than one chance on a machine that may be busy
    own = rows["capstan"]
    own["seconds"] = own["wall"] = min(own["seconds"], capstan_seconds(bench, case, elements))
    fastest = own["seconds"]
    for name, row in rows.items():
        yield {"case": case, "elements": elements, "solver": name, "iterations": row["iterations"],
               "norm": f"{row['norm']:.1e}", "solve_s": f"{row['seconds']:.4g}", "wall_s": f"{row['wall']:.4g}",
               "ratio": f"{row['seconds']/fastest:.3g}" if row["norm"] <= ACCURACY else "-",
               "own_tolerance": f"{row['tolerance']:.0e}", "note": row["note"]}


def find_bench():
    places = [os.path.join(ROOT, "build", preset, "bench", "step_bench") for preset in ("release", "dev")]
    return next((place for place in places if os.path.exists(place)), places[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bench", default=find_bench(), help="the step_bench program (default: %(default)s)")
    parser.add_argument("--case", choices=["souza", "oc3", "all"], default="all")
    parser.add_argument("--elements", default="100,1000,10000,100000")
    parser.add_argument("--solvers", default=",".join(SOLVERS))
    parser.add_argument("--limit", type=float, default=120, help="seconds that one solve may take (default: %(default)s)")
    parser.add_argument("--as-written", action="store_true", help="one scaling for all instead of the best of six")
    parser.add_argument("--csv", help="also write the rows to this file")
    options = parser.parse_args()
    if not os.access(options.bench, os.X_OK):
        sys.exit(f"compare: no program {options.bench}: build with scripts/build, or give --bench")
    unknown = set(options.solvers.split(",")) - set(SOLVERS)
    if unknown:
        sys.exit(f"compare: unknown solver {', '.join(sorted(unknown))}: expected {', '.join(SOLVERS)}")

    form = ("{case:6} {elements:>8} {solver:17} {iterations:>10} {norm:>9} {solve_s:>9} {wall_s:>9} {ratio:>8} "
            "{own_tolerance:>7}  {note}")
    print(form.format(**{name: name for name in COLUMNS} | {"own_tolerance": "own tol"}), flush=True)
    rows, scalings = [], AS_WRITTEN if options.as_written else SCALINGS
    for case in ["souza", "oc3"] if options.case == "all" else [options.case]:
        for elements in map(int, options.elements.split(",")):
            for row in compare(options.bench, case, elements, options.solvers.split(","), options.limit, scalings):
                print(form.format(**row), flush=True)
                rows.append(row)
    if options.csv:
        with open(options.csv, "w", newline="", encoding="ascii") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
