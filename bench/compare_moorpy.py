#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Equilibria of OC3-Hywind's spar on its three lines: capstan beside MoorPy, in one run.

    compare_moorpy.py [--bench MOORING_BENCH] [--elements 100,400,1600] [--tol 0.05,1e-6]

The loads are those of mooring_bench --moorpy: thrust at 90 m in several headings, without friction (MoorPy's has no memory). The spar has
its weight, its buoyancy at the metacentre and the stiffness of its waterplane in heave, which both programs have; MoorPy solves the elastic
catenary of each line, so what capstan differs by goes down with the square of its element length as long as MoorPy's own tolerance allows.
Printed for each mesh and each tolerance of MoorPy's `solveEquilibrium` (default 0.05 m): the largest difference over the loads of position
[m], angle [degrees], tension over the largest one, stiffness over the size of its block; the force and moment that MoorPy's own sum leaves
at its answer; and seconds of processor per equilibrium. MoorPy is installed, at the first run, into build/moorpy-venv."""
import argparse
import os
import subprocess
import sys
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), ".."))
VENV = os.path.join(ROOT, "build", "moorpy-venv")
PACKAGES = ["moorpy==1.3.0", "numpy", "scipy", "matplotlib", "pyyaml"]

G, DENSITY, DEPTH = 9.80665, 1025.0, 320.0
WEIGHT = 8066048 * G
BUOYANCY = WEIGHT + 1607182
HEAVE = 332941.0
ROLL = -4.999e9
HEIGHT = 90.0


def enter_environment():
    """Run again inside the virtual environment, made at the first run."""
    python = os.path.join(VENV, "bin", "python")
    if os.path.realpath(sys.prefix) == os.path.realpath(VENV):
        return
    if not os.path.exists(python):
        print(f"compare_moorpy: making {os.path.relpath(VENV)}", file=sys.stderr)
        subprocess.run([sys.executable, "-m", "venv", VENV], check=True)
        done = subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"] + PACKAGES)
        if done.returncode:
            sys.exit("compare_moorpy: MoorPy cannot be installed")
    os.execv(python, [python, os.path.abspath(sys.argv[0])] + sys.argv[1:])


if __name__ == "__main__":
    enter_environment()
    os.environ["OMP_NUM_THREADS"] = "1"
    import moorpy
    import numpy as np


def spar():
    """The mooring in MoorPy, its body free."""
    system = moorpy.System(depth=DEPTH, rho=DENSITY, g=G)
    w = 698.094
    system.lineTypes["main"] = dict(name="main", d_vol=0.09, m=w / G + DENSITY * np.pi / 4 * 0.09**2, w=w, EA=384.243e6, cost=0,
                                    input_d=0.09, input_type="chain", material="chain")
    system.addBody(0, np.zeros(6), m=WEIGHT / G, v=BUOYANCY / (DENSITY * G), rCG=np.array([0, 0, -78.0]), AWP=HEAVE / (DENSITY * G),
                   rM=np.array([0, 0, ROLL / BUOYANCY]))
    for i in range(3):
        turn = 2 * np.pi * i / 3
        system.addPoint(1, np.array([853.87 * np.cos(turn), 853.87 * np.sin(turn), -DEPTH]))
        fairlead = np.array([5.2 * np.cos(turn), 5.2 * np.sin(turn), -70.0])
        system.addPoint(1, fairlead)
        system.bodyList[0].attachPoint(len(system.pointList), fairlead)
        system.addLine(902.2, "main", pointA=2 * i + 1, pointB=2 * i + 2)
    system.initialize()
    return system


def by_moorpy(force, heading, tol):
    """Pose, rotation matrix, tensions, stiffness, what is left and seconds at the equilibrium that MoorPy finds from the same start."""
    start = time.process_time()
    system = spar()
    body = system.bodyList[0]
    f = force * np.array([np.cos(np.radians(heading)), np.sin(np.radians(heading)), 0])
    body.f6Ext = np.concatenate([f, np.cross([0, 0, HEIGHT], f)])
    system.solveEquilibrium(tol=tol)
    seconds = time.process_time() - start
    tensions = np.array([[line.TA, line.TB] for line in system.lineList])
    return dict(position=body.r6[:3].copy(), turn=moorpy.helpers.rotationMatrix(*body.r6[3:]), tension=tensions,
                stiffness=body.getStiffnessA(), left=body.getForces(), seconds=seconds)


def matrix_of(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def by_capstan(bench, elements):
    out = []
    text = subprocess.run([bench, "--moorpy", "--elements", str(elements)], check=True, capture_output=True, text=True).stdout
    for row in text.splitlines():
        v = np.array([float(x) for x in row.split()])
        out.append(dict(force=v[0], heading=v[1], position=v[2:5], turn=matrix_of(v[5:9]), stiffness=v[15:51].reshape(6, 6),
                        tension=v[51:57].reshape(3, 2), seconds=v[57], solved=v[58] == 1))
    return out


def differences(a, b):
    """Position [m], angle [degrees], tensions, stiffness by blocks."""
    turn = a["turn"].T @ b["turn"]
    angle = np.degrees(np.arcsin(min(1, 0.5 * np.linalg.norm([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]))))
    block = 0
    for i in (0, 3):
        for j in (0, 3):
            size = np.sqrt(np.linalg.norm(b["stiffness"][i:i + 3, i:i + 3]) * np.linalg.norm(b["stiffness"][j:j + 3, j:j + 3]))
            block = max(block, np.linalg.norm((a["stiffness"] - b["stiffness"])[i:i + 3, j:j + 3]) / size)
    return [np.linalg.norm(a["position"] - b["position"]), angle, abs(a["tension"] - b["tension"]).max() / b["tension"].max(), block]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--bench", default=os.path.join(ROOT, "build/release/bench/mooring_bench"))
    parser.add_argument("--elements", default="100,400,1600")
    parser.add_argument("--tol", default="0.05,1e-6")
    args = parser.parse_args()
    ours = {n: by_capstan(args.bench, n) for n in (int(x) for x in args.elements.split(","))}
    loads = next(iter(ours.values()))
    theirs = {}
    for tol in (float(x) for x in args.tol.split(",")):
        theirs[tol] = [by_moorpy(a["force"], a["heading"], tol) for a in loads]
        left = np.array([b["left"] for b in theirs[tol]])
        print(f"MoorPy {moorpy.__version__ if hasattr(moorpy, '__version__') else '1.3.0'}, tol {tol:g}: "
              f"{1e3 * np.mean([b['seconds'] for b in theirs[tol]]):.1f} ms; left {np.linalg.norm(left[:, :3], axis=1).max():.3g} N, "
              f"{np.linalg.norm(left[:, 3:], axis=1).max():.3g} N m")
    for n, rows in ours.items():
        unsolved = sum(not a["solved"] for a in rows)
        print(f"capstan, {n} elements a line: {1e3 * np.mean([a['seconds'] for a in rows]):.1f} ms, {unsolved} not certified")
        for tol, peers in theirs.items():
            d = np.array([differences(a, b) for a, b in zip(rows, peers)])
            print(f"    against tol {tol:g}: position {d[:, 0].max():.2e} m, angle {d[:, 1].max():.2e} deg, tension {d[:, 2].max():.2e}, "
                  f"stiffness {d[:, 3].max():.2e}")


if __name__ == "__main__":
    main()
