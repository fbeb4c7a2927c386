#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The ropes of examples/notebooks/beside_mujoco.ipynb in MuJoCo: round a peg, pulled on a table, drawn aside.

    compare_mujoco.py [--case peg|creep|aside] [--setting NAME]       writes bench/results/compare-mujoco.csv

MuJoCo (package index, into build/bench-venv) has no rope without stiffness; its closest model is a chain of capsules with joints that
turn freely, in coordinates of the joints, so that no length changes. The joints have a little damping and armature, and the integrator is
`implicitfast`, since the chain with a load at its end is unstable otherwise. The hand is a body on slides, moved by stiff servos whose
force is what it feels. `defaults` has every other setting as MuJoCo has it; the others change what its documentation advises against slip."""
import argparse
import csv
import math
import os
import subprocess
import sys
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), ".."))
VENV = os.path.join(ROOT, "build", "bench-venv")
RESULTS = os.path.join(ROOT, "bench", "results", "compare-mujoco.csv")
VERSION = "4.0.0"
GRAVITY = 9.81  # m/s^2
THICK = 0.005  # m, the radius of the rope
JOINT = 'damping="1e-4" armature="1e-5"'  # N m s, kg m^2
# time step [s], other settings
SETTINGS = {
    "defaults": (2e-3, ""),
    "noslip": (2e-3, 'noslip_iterations="50"'),
    "elliptic, noslip": (2e-3, 'cone="elliptic" noslip_iterations="50"'),
    "elliptic, impratio 1000, 0.5 ms": (5e-4, 'cone="elliptic" impratio="1000"'),
}


def own_environment():
    """Run again in an environment that has MuJoCo."""
    python = os.path.join(VENV, "bin", "python")
    if not os.path.exists(python):
        subprocess.run([sys.executable, "-m", "venv", VENV], check=True)
    if subprocess.run([python, "-c", f"import mujoco; assert mujoco.__version__ == '{VERSION}'"], capture_output=True).returncode:
        subprocess.run([python, "-m", "pip", "install", "-q", f"mujoco=={VERSION}"], check=True)
    os.execv(python, [python, *sys.argv])


def chain(turns, link, mass, friction, axis, first="", last=""):
    """Nested bodies, one capsule each; `turns` are the angles by which each is turned against the one before it [rad]."""
    text = ""
    for k, turn in enumerate(turns):
        x, s = (0 if k == 0 else link), math.sin(turn / 2)
        quaternion = f"{math.cos(turn / 2)} {axis[0] * s} {axis[1] * s} {axis[2] * s}"
        joint = first if k == 0 and first else f'<joint type="hinge" axis="{axis[0]} {axis[1]} {axis[2]}" {JOINT}/>'
        text += (f'<body pos="{x} 0 0" quat="{quaternion}">{joint}<geom type="capsule" size="{THICK}" fromto="0 0 0 {link} 0 0" '
                 f'mass="{mass}" contype="2" conaffinity="1" friction="{friction} 0 0"/>')
    return text + last + "</body>" * len(turns)


def model(step, options, ground, body, servos=""):
    import mujoco

    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{step}" integrator="implicitfast" gravity="0 0 {-GRAVITY}" {options}/>'
        f'<worldbody>{ground}{body}</worldbody><actuator>{servos}</actuator></mujoco>')


def advance(m, d, until):
    import mujoco

    while d.time < until - m.opt.timestep / 2:
        mujoco.mj_step(m, d)


def peg(step, options):
    """A rope of 0.1 kg/m over half a turn of a peg, a load of 1 kg; the hand draws it by 0.1 m at 0.02 m/s, and holds it for 10 s."""
    import mujoco

    radius, friction, link, hang, load, hand = 0.1, 0.3, 0.02, 0.3, 1.0, 0.1
    one = 2 * math.asin(link / 2 / (radius + THICK))
    arc = [one] * int(math.pi / one) + [math.pi % one]
    turns = [0.0] * round(hang / link) + [arc[0] / 2] + [(a + b) / 2 for a, b in zip(arc, arc[1:])] + [arc[-1] / 2] + [0.0] * round(hang / link)
    weight = (f'<body name="load" pos="{link} 0 0"><joint type="hinge" axis="0 1 0" damping="1e-3"/>'
              f'<geom type="sphere" size="0.02" mass="{load}" contype="0" conaffinity="0"/></body>')
    rope = chain(turns, link, 0.1 * link, friction, (0, -1, 0), last=weight)
    ground = (f'<geom type="cylinder" size="{radius} 0.2" euler="90 0 0" contype="1" conaffinity="2" friction="{friction} 0 0"/>')
    body = (f'<body pos="{radius + THICK} 0 {-hang}" gravcomp="1"><joint name="hand" type="slide" axis="0 0 -1"/><geom type="sphere" size="0.01" '
            f'mass="{hand}" contype="0" conaffinity="0"/><body quat="{math.sqrt(0.5)} 0 {-math.sqrt(0.5)} 0">{rope}</body></body>')
    m = model(step, options, ground, body, '<position joint="hand" kp="20000" kv="100"/>')
    d = mujoco.MjData(m)
    begun = time.process_time()
    advance(m, d, 1)
    drawn, count = 0.0, 0
    while d.time < 6 - step / 2:
        d.ctrl[0] = min((d.time - 1) * 0.02, 0.1)
        mujoco.mj_step(m, d)
        if d.time > 5:  # mean of the last second
            drawn, count = drawn + d.actuator_force[0], count + 1
    height = d.body("load").xpos[2]
    advance(m, d, 16)
    return {"force drawn [N]": drawn / count, "force 10 s later [N]": d.actuator_force[0],
            "load rose [mm]": 1e3 * (d.body("load").xpos[2] - height), "processor [s]": time.process_time() - begun}


TABLE = '<geom type="plane" size="5 5 1" contype="1" conaffinity="2" friction="0.4 0 0"/>'


def slides(names):
    return "".join(f'<joint name="{name}" type="slide" axis="{axis}"/>' for name, axis in zip(names, ("1 0 0", "0 1 0", "0 0 1")))


def creep(step, options):
    """A rope of 2 m and 1 kg/m on a table, pulled along by half of what friction can hold, for 30 s."""
    import mujoco

    rope = chain([0.0] * 50, 0.04, 0.04, 0.4, (0, 0, 1), first=slides("xyz") + '<joint type="hinge" axis="0 0 1"/>')
    m = model(step, options, TABLE, rope.replace("<body pos=", f'<body name="end" pos="0 0 {THICK}" alt=', 1).replace(' alt="0 0 0"', "", 1))
    d = mujoco.MjData(m)
    begun = time.process_time()
    advance(m, d, 0.5)
    body = m.body("end").id
    start = d.xpos[body, 0]
    d.xfrc_applied[body, 0] = -0.5 * 0.4 * 2 * GRAVITY
    advance(m, d, 30.5)
    return {"crept [mm]": 1e3 * (start - d.xpos[body, 0]), "processor [s]": time.process_time() - begun}


def aside(step, options, speed=0.02):
    """The same rope, one end drawn 1 m aside at 0.02 m/s."""
    import mujoco

    rope = chain([0.0] * 50, 0.04, 0.04, 0.4, (0, 0, 1), last='<site name="tail" pos="0.04 0 0"/>')
    body = (f'<body pos="2 0 {THICK}" quat="0 0 0 1" gravcomp="1">{slides("xyz")}<geom type="sphere" size="0.004" mass="0.1" contype="0" '
            f'conaffinity="0"/>{rope}</body>')
    servos = "".join(f'<position joint="{name}" kp="5000" kv="100"/>' for name in "xy")
    m = model(step, options, TABLE, body, servos)
    d = mujoco.MjData(m)
    begun = time.process_time()
    advance(m, d, 0.5)
    force, count, end = 0.0, 0, 0.5 + 1 / speed
    while d.time < end - step / 2:
        d.ctrl[1] = -(d.time - 0.5) * speed  # the axes of the hand are turned by half a turn
        mujoco.mj_step(m, d)
        if d.time > end - 1:
            force, count = force + math.hypot(*d.actuator_force[:2]), count + 1
    x, y = d.site("tail").xpos[:2]
    return {"tail x [m]": x, "tail y [m]": y, "force [N]": force / count, "processor [s]": time.process_time() - begun}


CASES = {"peg": peg, "creep": creep, "aside": aside}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--case", choices=CASES)
    parser.add_argument("--setting", choices=SETTINGS)
    options = parser.parse_args()
    if sys.prefix != VENV:
        own_environment()
    rows = []
    for case, measure in CASES.items():
        for setting, (step, text) in SETTINGS.items():
            if options.case not in (None, case) or options.setting not in (None, setting):
                continue
            for what, value in measure(step, text).items():
                rows.append([case, setting, what, f"{value:.4g}"])
                print(*rows[-1], sep=", ", flush=True)
    if options.case is None and options.setting is None:
        with open(RESULTS + ".new", "w", newline="") as file:
            file.write(f"# MuJoCo {VERSION}, written by bench/compare_mujoco.py\n")
            csv.writer(file).writerows([["case", "setting", "what", "value"], *rows])
        os.replace(RESULTS + ".new", RESULTS)


if __name__ == "__main__":
    main()
