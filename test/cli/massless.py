# SPDX-License-Identifier: BSD-3-Clause
"""Points without inertia in steps in time.                                                  usage: massless.py CAPSTAN CHECKER

A buoy without inertia is afloat on a quasi-static line. When that lets go it comes up to the surface and floats by its own weight. Pushed
along the surface it has no place: nothing holds it, and nothing makes it slow. That is said, with what to do, and it stays where it was. With
inertia it goes off at F/m.
"""
import csv
import os
import subprocess
import sys
import tempfile

CAPSTAN, CHECKER = sys.argv[1:3]
WEIGHT, PUSH = 2 * 9.81, 3.0  # N
SAID = ("capstan: step pushed 1/2, point buoy: no place found where the forces on it balance (1.5 N are left after 105 trials); "
        "it has no 'inertia' to move with: give it one\n")


def run(folder, inertia):
    """The buoy in each step, and what the run says; the checker must find nothing."""
    path, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, "out")
    with open(path, "w", encoding="ascii") as file:
        file.write("capstan: 1\ngravity: [0, 0, -9.81]\ntime_scheme: euler\nwater_density: 1000\nwater_surface: 0\npoints:\n"
                   f"  buoy: {{free: [0, 0, -1], mass: 2, volume: 0.01, height: 0.2{inertia}}}\n  anchor: {{held: [0, 0, -5]}}\n"
                   "lines: {leg: {length: 4.9, elements: 4, mass: 0.5, stiffness: 1e5, quasi_static: true, start: static, "
                   "ends: {A: {point: anchor}, B: {point: buoy}}}}\n"
                   "history:\n  - {name: moored, steps: 3, duration: 3}\n  - {name: adrift, steps: 3, duration: 3, leg.B: {release: true}}\n"
                   f"  - {{name: pushed, steps: 2, duration: 2, buoy.point: {{force: [{PUSH}, 0, 0]}}}}\n")
    done = subprocess.run([CAPSTAN, "run", "-q", path, "-o", out, "--force", "--no-paraview"], capture_output=True, text=True, check=False)
    told = subprocess.run([CHECKER, os.path.join(out, "result.nc"), path, "-v"], capture_output=True, text=True, check=False).stdout
    if "refuted 0, not finite 0" not in told or "against the scene: 0 findings" not in told:
        sys.exit(f"the checker says {told}")
    with open(os.path.join(out, "points.csv"), encoding="ascii") as file:
        return done, {row["name"]: row for row in csv.DictReader(file) if row["point"] == "buoy"}


with tempfile.TemporaryDirectory() as work:
    done, buoy = run(work, ", inertia: 0")
    print(done.stderr, end="")
    for step in ("adrift 1/3", "adrift 3/3"):
        row = buoy[step]
        lift = float(row["buoyancy"])
        print(f"{step}: {row['water']} at {row['z']} m by {lift!r} N, of {WEIGHT!r} N")
        if row["has_place"] != "1" or row["water"] != "floating" or not abs(lift - WEIGHT) <= 1e-9 * WEIGHT:
            sys.exit("it does not float by its own weight")
    if SAID not in done.stderr or done.returncode != 1:
        sys.exit("it is not said that it has no inertia")
    if any(buoy["pushed 2/2"][a] != buoy["adrift 3/3"][a] for a in "xyz"):
        sys.exit(f"it has gone to x = {buoy['pushed 2/2']['x']} m, where nothing balances")
    done, buoy = run(work, "")
    # x = (F h^2/m) (1/2 + (1/2 + 1)) by (9c): the push grows evenly over two steps of h = 1 s
    gone, expected = float(buoy["pushed 2/2"]["x"]), PUSH / 2 * (0.5 + 0.5 + 1)
    print(f"with its mass it goes {gone!r} m, of {expected!r} m")
    if done.returncode != 0 or not abs(gone - expected) <= 1e-9 * expected:
        sys.exit("with its mass it does not move by F/m")
