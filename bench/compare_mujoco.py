#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The ropes of examples/notebooks/beside_mujoco.ipynb in MuJoCo.   usage: compare_mujoco.py [FILE]

Writes what MuJoCo finds, with its version, settings and processor times, to FILE, by default bench/results/mujoco.json, which the notebook
reads. MuJoCo (package index) is installed into build/mujoco-venv at the first run. A few minutes.

A rope is a chain of point masses with three slides each, which touch by small spheres and are joined by tendons of limited length:
MuJoCo's own constraint solver carries tension and contact. The masses do not turn, so that they slide and do not roll.

  euler  half a turn round a drum, mu = 0.3, no gravity, 2 N at one end; the hand at the other moves by 0.1 m within 2 s, smoothly, and
         then stops for 5 s. The tension at the hand over 2 N is exp(mu pi) = 2.566 by Euler, and stays when the hand has stopped
  aside  2 m on a table, mu = 0.4, 1 kg/m, one end in a hand that walks 1 m to the side within 10 s
  creep  the same rope, pulled along itself by half of what friction holds, for 30 s; the truth is that its other end stays

The settings: MuJoCo's defaults; then elliptic cones, impratio 100, a time step of 0.5 ms and stiff constraints, the best found without
and with the no-slip iterations."""
import argparse
import json
import math
import os
import platform
import subprocess
import sys
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), ".."))
VENV = os.path.join(ROOT, "build", "mujoco-venv")
RADIUS = 0.004  # m of the spheres
STIFF = {"solref": "0.002 1", "solimp": "0.99 0.9999 0.0001"}
TUNED = {"timestep": 0.0005, "cone": "elliptic", "impratio": 100}
SETTINGS = {"defaults": ({}, {}), "tuned": (TUNED, STIFF),
            "tuned, no-slip": ({**TUNED, "noslip_iterations": 20, "noslip_tolerance": 1e-12}, STIFF)}


def with_packages():
    """Go on in the virtual environment where the packages are."""
    python = os.path.join(VENV, "bin", "python")
    if os.path.realpath(sys.prefix) != os.path.realpath(VENV):
        if not os.path.exists(python):
            subprocess.run([sys.executable, "-m", "venv", VENV], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "mujoco==4.0.0"], check=True)
        os.execv(python, [python] + sys.argv)


class Rope:
    """A chain of nodes beside an obstacle, which MuJoCo steps in time. Where `hand` is true, the last node is moved."""

    def __init__(self, nodes, mass, friction, obstacle, gravity, settings, hand):
        import mujoco

        option, constraint = settings
        self.mujoco, self.count = mujoco, len(nodes)
        contact = " ".join(f'{key}="{value}"' for key, value in constraint.items())
        limit = " ".join(f'{key}limit="{value}"' for key, value in constraint.items())
        length = [math.dist(a, b) for a, b in zip(nodes, nodes[1:])]
        slides = "".join(f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 1 0", "0 0 1"))
        bodies = "".join(
            f'<body pos="{x} {y} {z}" {"mocap=%r" % "true" if hand and i + 1 == self.count else ""}>'
            f'{slides if not hand or i + 1 < self.count else ""}<site name="s{i}"/>'
            f'<geom type="sphere" size="{RADIUS}" mass="{mass}" contype="1" conaffinity="2" friction="{friction} 0 0" {contact}/></body>'
            for i, (x, y, z) in enumerate(nodes))
        tendons = "".join(f'<spatial limited="true" range="0 {length[i]}" {limit}><site site="s{i}"/><site site="s{i + 1}"/></spatial>'
                          for i in range(self.count - 1))
        options = " ".join(f'{key}="{value}"' for key, value in option.items())
        self.model = mujoco.MjModel.from_xml_string(
            f'<mujoco><option gravity="0 0 {-gravity}" {options}/><size memory="200M"/><worldbody>'
            f'<geom {obstacle} contype="2" conaffinity="1" friction="{friction} 0 0" {contact}/>{bodies}</worldbody>'
            f'<tendon>{tendons}</tendon></mujoco>')
        self.data = mujoco.MjData(self.model)
        self.step_length = self.model.opt.timestep

    def tension(self):
        """[N] at the hand: the force of the last tendon's limit."""
        data, n = self.data, self.data.nefc
        mine = (data.efc_type[:n] == self.mujoco.mjtConstraint.mjCNSTR_LIMIT_TENDON) & (data.efc_id[:n] == self.count - 2)
        return float(data.efc_force[:n][mine].sum())

    def go(self, seconds, each=lambda t: None):
        """Step for so long; `each` is called before every step."""
        for i in range(round(seconds / self.step_length)):
            each(i * self.step_length)
            self.mujoco.mj_step(self.model, self.data)

    def place(self, i):
        """[m] of a node."""
        return self.data.xpos[i + 1].tolist()


def smooth(u):
    """A way from 0 to 1 that speeds up in its first quarter and slows down in its last."""
    if u >= 1:
        return 1.0
    return u * u / 0.375 if u < 0.25 else (u - 0.125) / 0.75 if u < 0.75 else 1 - (1 - u) ** 2 / 0.375


def mean(values):
    return sum(values) / max(len(values), 1)


def euler(settings):
    drum, around, step = 0.1, 0.1 + RADIUS, 0.01
    before, after = 0.3, 0.1
    whole = before + math.pi * around + after
    nodes = []
    for i in range(round(whole / step) + 1):
        s = i * whole / round(whole / step)
        turn = min(max((s - before) / around, 0), math.pi)
        down = max(before - s, 0) + max(s - before - math.pi * around, 0)
        nodes.append((-around * math.cos(turn), 0, around * math.sin(turn) - down))
    rope = Rope(nodes, 1.0 * step, 0.3, f'type="cylinder" size="{drum} 0.5" euler="90 0 0"', 0, settings, True)
    rope.data.qfrc_applied[2] = -2.0
    felt, hand = [], rope.data.mocap_pos[0].copy()

    def each(t):
        rope.data.mocap_pos[0] = hand - [0, 0, 0.1 * smooth((t - 0.5) / 2) if t > 0.5 else 0]
        felt.append((t, rope.tension() / 2))
    rope.go(7.5, each)

    def between(a, b):
        return mean([ratio for t, ratio in felt if a <= t < b])
    return {"pulled": between(1.5, 2.0), "held 1 s": between(3.4, 3.6), "held 5 s": between(7.3, 7.5), "lifted": rope.place(0)[2] - nodes[0][2]}


TABLE = {"length": 2.0, "elements": 80, "friction": 0.4, "mass": 1.0, "gravity": 9.81}


def on_the_table(settings, hand):
    n = TABLE["elements"]
    nodes = [(TABLE["length"] * i / n, 0, RADIUS) for i in range(n + 1)]
    return Rope(nodes, TABLE["mass"] * TABLE["length"] / n, TABLE["friction"], 'type="plane" size="10 10 1"', TABLE["gravity"], settings, hand)


def aside(settings):
    rope = on_the_table(settings, True)
    felt, hand = [], rope.data.mocap_pos[0].copy()

    def each(t):
        rope.data.mocap_pos[0] = hand + [0, smooth((t - 0.5) / 10) if t > 0.5 else 0, 0]
        felt.append((t, rope.tension()))
    rope.go(10.6, each)
    return {"position": [[round(x, 6) for x in rope.place(i)[:2]] for i in range(rope.count)],
            "force": mean([force for t, force in felt if 7.5 <= t < 8.0])}


def creep(settings):
    rope = on_the_table(settings, False)
    rope.data.qfrc_applied[3 * rope.count - 3] = 0.5 * TABLE["friction"] * TABLE["mass"] * TABLE["gravity"] * TABLE["length"]
    rope.go(1.0)
    begun = rope.place(rope.count - 1)[0]
    rope.go(29.0)
    return {"crept": rope.place(rope.count - 1)[0] - begun}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", nargs="?", default=os.path.join(ROOT, "bench", "results", "mujoco.json"))
    options = parser.parse_args()
    with_packages()
    import mujoco

    found = {"mujoco": mujoco.__version__, "python": platform.python_version(), "runs": {}}
    for name, settings in SETTINGS.items():
        row = found["runs"][name] = {"settings": {**settings[0], **settings[1]}}
        for run in (euler, aside, creep):
            begun = time.process_time()
            row[run.__name__] = {**run(settings), "seconds": round(time.process_time() - begun, 2)}
            print(name, run.__name__, {key: value for key, value in row[run.__name__].items() if key != "position"}, flush=True)
    with open(options.file, "w", encoding="utf-8") as file:
        json.dump(found, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()
