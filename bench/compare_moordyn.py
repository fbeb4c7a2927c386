#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""One cycle of sway of a mooring line with bed friction: capstan beside MoorDyn.

    compare_moordyn.py [--bench HISTORY_BENCH] [--period SECONDS] [--steps 0.001,..] [--damping 200,1e6]

The scene is bench/oc3-sway.yaml: the OC3-Hywind line in 100 elements, its fairlead taken 20 m to one side, across, and back, friction
coefficient 1. The truth is quasi-static and does not depend on time: what remains across at the end is what dry friction holds. MoorDyn
(package index, into build/bench-venv) moves the same fairlead along a cosine of the given period, after its own initial conditions; its
friction is a damping `FricDamp` up to mu N. Printed for both: seconds of processor time, force across at +20 m and back at 0 m, [N]."""
import argparse
import contextlib
import csv
import io
import math
import os
import resource
import subprocess
import sys
import tempfile

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), ".."))
VENV = os.path.join(ROOT, "build", "bench-venv")
SWAY = 20.0  # m, as in oc3-sway.yaml
DECK = """--- the line of bench/oc3-sway.yaml ---
----------------------- LINE TYPES ------------------------------
Name Diam MassDen EA BA EI Cd Ca CdAx CaAx
(-) (m) (kg/m) (N) (N-s) (N-m^2) (-) (-) (-) (-)
main 0.09 77.7066 384.243E6 -0.8 0 1.6 1.0 0.0 0.0
----------------------- POINTS -----------------------------------
ID Attachment X Y Z M V CdA CA
(-) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed 0 0 -320 0 0 0 0
2 Coupled 848.67 0 -70 0 0 0 0
----------------------- LINES ------------------------------------
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(-) (-) (-) (-) (m) (-) (-)
1 main 1 2 902.2 100 -
----------------------- OPTIONS -----------------------------------
{step} dtM
3e6 kBot
3e5 cBot
1025 WtrDnsty
320 WtrDpth
1.0 FrictionCoefficient
{damping} FricDamp
1.0 StatDynFricScale
1.0 dtIC
200 TmaxIC
5 CdScaleIC
1e-4 threshIC
rk2 tScheme
----------------------- END ---------------------------------------
"""


def seconds():
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def with_packages():
    """Go on in the virtual environment where the packages are."""
    python = os.path.join(VENV, "bin", "python")
    if os.path.realpath(sys.prefix) != os.path.realpath(VENV):
        if not os.path.exists(python):
            subprocess.run([sys.executable, "-m", "venv", VENV], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "moordyn==2.7.2"], check=True)
        os.execv(python, [python] + sys.argv)


@contextlib.contextmanager
def quiet():
    """What a library prints goes nowhere."""
    sys.stdout.flush()
    kept = os.dup(1)
    with open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)


def moordyn_cycle(period, step, damping):
    """Processor time, and the force across on the fairlead at +20 m and back at 0 m, going out and coming home."""
    import moordyn

    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, "line.txt")
        with open(path, "w") as deck:
            deck.write(DECK.format(step=step, damping=damping))
        here = os.getcwd()
        os.chdir(directory)
        begun = seconds()
        system = moordyn.Create(path)
        x, v = [848.67, 0.0, -70.0], [0.0, 0.0, 0.0]
        moordyn.Init(system, x, v)
        ready, dt, time, across = seconds(), 0.05, 0.0, []
        for i in range(round(period/dt)):
            # the place at the beginning of the call, and the velocity in it
            x[1] = SWAY*math.sin(2*math.pi*time/period)
            v[1] = (SWAY*math.sin(2*math.pi*(time + dt)/period) - x[1])/dt
            force = moordyn.Step(system, x, v, time, dt)
            across.append(force[1])
            time += dt
        done = seconds()
        moordyn.Close(system)
        os.chdir(here)
    n = len(across)
    return ready - begun, done - ready, across[n//4 - 1], across[n//2 - 1], across[n - 1]


def capstan_cycle(bench, name="oc3-sway.yaml"):
    begun = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    out = subprocess.run([bench, os.path.join(ROOT, "bench", name), "1"], check=True, capture_output=True, text=True).stdout
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - begun, next(csv.DictReader(io.StringIO(out)))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--bench", default=os.path.join(ROOT, "build", "release", "bench", "history_bench"))
    parser.add_argument("--period", type=float, default=1600.0)
    parser.add_argument("--steps", default="0.001")
    parser.add_argument("--damping", default="200,1e6")
    options = parser.parse_args()
    with_packages()
    spent, row = capstan_cycle(options.bench)
    print(f"capstan: {spent:.2f} s, {row['steps']} load steps, {row['uncertified']} not certified, worst gap {row['worst_gap']}; "
          f"force across back at 0 m {row['last_lateral_N']} N, dissipated {row['dissipated_J']} J")
    for step in options.steps.split(","):
        for damping in options.damping.split(","):
            with quiet():
                start, cycle, out, half, home = moordyn_cycle(options.period, step, damping)
            print(f"MoorDyn, dtM {step} s, FricDamp {damping}, period {options.period:g} s: start {start:.2f} s, cycle {cycle:.2f} s; "
                  f"force across at +20 m {out:.1f} N, back at 0 m {half:.1f} N and {home:.1f} N", flush=True)


if __name__ == "__main__":
    main()
