#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Solve random second-order cone programs with capstan's sparse solver and with Clarabel and QOCO, and compare.

    compare_conic.py [--bench CONIC_BENCH] [--unknowns 100,1000,...] [--kinds banded,random] [--seeds 3] [--solvers clarabel,qoco] [--limit SECONDS] [--csv FILE]

The programs are those of `conic_bench` (test/property/random_program.h), handed on by its --dump:

    min c.x   s.t.  E x + h = 0,  A_k x_k + b_k in K_k

One norm judges all answers, the one of conic_bench: the largest of |E x + h|, |c - A'z - E'y|, the distances of A x + b and z
to their cones, and |c.x + h.y + b.z|/(1 + |c.x|). A peer's tolerance is tightened tenfold until that is at most 1e-8, and its
time is that of this run, the least of three; capstan's is its default work, the least of three. Both are seconds of processor
for set-up and solution, without the conversion of matrices. The solvers are installed as by compare.py."""
import argparse
import csv
import os
import subprocess
import sys
import tempfile
import time

import compare

ACCURACY = compare.ACCURACY
REPEATS = compare.REPEATS

if __name__ == "__main__":
    compare.enter_environment()
    os.environ["OMP_NUM_THREADS"] = "1"
    import numpy as np
    from scipy import sparse


class Program:
    """What `conic_bench --dump` writes."""

    def __init__(self, path):
        blocks, value = [], {}
        with open(path, encoding="ascii") as file:
            if file.readline().strip() != "# capstan conic program 1":
                sys.exit(f"compare_conic: {path} is not a conic program")
            for line in file:
                word, count, *rest = line.split()
                if word == "block":
                    blocks.append([[int(d) for d in rest], None, None])
                elif word in ("A", "b"):
                    blocks[-1][1 if word == "A" else 2] = np.array(rest, float)
                else:
                    assert int(count) == len(rest)
                    value[word] = np.array(rest, int if word == "columns" else float)
        self.c, self.h = value["c"], value["h"]
        n, m = len(self.c), len(self.h)
        per = len(value["E"])//m if m else 1
        self.E = sparse.csc_matrix((value["E"], (np.arange(len(value["E"]))//per, value["columns"])), shape=(m, n))
        parts = [a.reshape(len(b), -1) for _, a, b in blocks]
        A = sparse.block_diag(parts, format="csc")
        self.A = sparse.hstack([A, sparse.csc_matrix((A.shape[0], n - A.shape[1]))], format="csc")
        self.b = np.concatenate([b for _, _, b in blocks])
        self.cones = [d for dims, _, _ in blocks for d in dims]
        self.seconds, self.iterations, self.error = value["answer"]

    def error_of(self, x, y, z):
        """The norm; z of the cones and y of the equations with the signs of capstan."""
        s = self.A @ x + self.b
        worst = max(np.abs(self.E @ x + self.h).max(initial=0), np.abs(self.c - self.A.T @ z - self.E.T @ y).max())
        first = np.concatenate([[0], np.cumsum(self.cones)[:-1]])
        for v in (s, z):
            square = np.add.reduceat(v*v, first) - v[first]**2
            worst = max(worst, np.max(np.sqrt(np.maximum(square, 0)) - v[first]))
        value = self.c @ x
        worst = max(worst, abs(value + self.h @ y + self.b @ z)/(1 + abs(value)))
        return worst if np.isfinite(worst) else np.inf

    def half_lines_first(self):
        """Order of the rows with half-lines in front, and the dimensions of the other cones."""
        first = np.concatenate([[0], np.cumsum(self.cones)[:-1]])
        lines = [i for i, d in zip(first, self.cones) if d == 1]
        others = [np.arange(i, i + d) for i, d in zip(first, self.cones) if d > 1]
        return np.concatenate([np.array(lines, int), *others]), len(lines), [d for d in self.cones if d > 1]


def solve_clarabel(program, tolerance, limit):
    import clarabel
    s = clarabel.DefaultSettings()
    s.verbose, s.max_iter, s.time_limit, s.max_threads = False, 500, limit, 1
    s.tol_gap_abs = s.tol_gap_rel = s.tol_feas = tolerance
    order, lines, dims = program.half_lines_first()
    rows = sparse.vstack([program.E, -program.A[order]], format="csc")
    right = np.concatenate([-program.h, program.b[order]])
    cones = [clarabel.ZeroConeT(len(program.h)), clarabel.NonnegativeConeT(lines)] + [clarabel.SecondOrderConeT(d) for d in dims]
    n = len(program.c)
    cost = sparse.csc_matrix((n, n))
    begin = time.process_time()
    out = clarabel.DefaultSolver(cost, program.c, rows, right, cones, s).solve()
    seconds = time.process_time() - begin
    dual = np.array(out.z)
    z = np.empty(len(program.b))
    z[order] = dual[len(program.h):]
    return np.array(out.x), -dual[:len(program.h)], z, out.iterations, seconds


def solve_qoco(program, tolerance, _limit):
    import qoco
    order, lines, dims = program.half_lines_first()
    n, m = len(program.c), len(program.h)
    cost, A, b = sparse.csc_matrix((n, n)), -program.A[order].tocsc(), program.b[order]
    begin = time.process_time()
    solver = qoco.QOCO()
    solver.setup(n, len(b), m, cost, program.c, program.E, -program.h, A, b, lines, len(dims),
                 np.array(dims, np.int32), abstol=tolerance, reltol=tolerance, max_iters=500, verbose=0)
    out = solver.solve()
    seconds = time.process_time() - begin
    z = np.empty(len(program.b))
    z[order] = out.z
    return np.array(out.x), -np.array(out.y), z, out.iters, seconds


SOLVERS = {"clarabel": solve_clarabel, "qoco": solve_qoco}


def first_to_reach(name, program, limit):
    """The least time of the loosest tolerance that reaches the accuracy, or the best norm."""
    best = None
    for tolerance in compare.TOLERANCES:
        try:
            x, y, z, iterations, seconds = SOLVERS[name](program, tolerance, limit)
        except Exception as fault:  # a peer that refuses a program is a row of the table
            return {"error": float("inf"), "iterations": 0, "seconds": float("nan"), "note": str(fault)}
        row = {"error": program.error_of(x, y, z), "iterations": iterations, "seconds": seconds, "note": f"{tolerance:g}"}
        if best is None or row["error"] < best["error"]:
            best = row
        if row["error"] <= ACCURACY:
            for _ in range(REPEATS - 1):
                best["seconds"] = min(best["seconds"], SOLVERS[name](program, tolerance, limit)[4])
            return best
        if seconds > limit:
            break
    best["note"] += ": NOT REACHED"
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bench", default=os.path.join(compare.ROOT, "build", "release", "bench", "conic_bench"))
    parser.add_argument("--unknowns", default="100,1000,10000,100000")
    parser.add_argument("--kinds", default="banded,random")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--solvers", default=",".join(SOLVERS))
    parser.add_argument("--limit", type=float, default=60)
    parser.add_argument("--csv")
    args = parser.parse_args()
    rows = []
    print(f"{'kind':>8} {'unknowns':>8} {'seed':>4} {'solver':>9} {'iterations':>10} {'error':>9} {'ms':>10} {'over capstan':>12}")
    for kind in args.kinds.split(","):
        for unknowns in map(int, args.unknowns.split(",")):
            for seed in range(1, args.seeds + 1):
                with tempfile.TemporaryDirectory() as folder:
                    path = os.path.join(folder, "program.txt")
                    try:
                        subprocess.run([args.bench, "--kind", kind, "--unknowns", str(unknowns), "--seed", str(seed), "--repeats",
                                        str(REPEATS), "--dump", path], check=True, stdout=subprocess.DEVNULL,
                                       timeout=10*args.limit)
                    except subprocess.TimeoutExpired:
                        print(f"{kind:>8} {unknowns:8d} {seed:4d}   capstan took more than {10*args.limit:g} s")
                        continue
                    program = Program(path)
                own = {"error": program.error, "iterations": int(program.iterations), "seconds": program.seconds, "note": ""}
                for name, row in [("capstan", own)] + [(name, first_to_reach(name, program, args.limit)) for name in args.solvers.split(",")]:
                    ratio = row["seconds"]/own["seconds"]
                    print(f"{kind:>8} {unknowns:8d} {seed:4d} {name:>9} {row['iterations']:10d} {row['error']:9.1e} "
                          f"{1e3*row['seconds']:10.3f} {ratio:12.2f}  {row['note']}", flush=True)
                    rows.append([kind, unknowns, seed, name, row["iterations"], row["error"], row["seconds"], row["note"]])
    if args.csv:
        with open(args.csv, "w", newline="", encoding="ascii") as file:
            csv.writer(file).writerows([["kind", "unknowns", "seed", "solver", "iterations", "error", "seconds", "note"], *rows])


if __name__ == "__main__":
    main()
