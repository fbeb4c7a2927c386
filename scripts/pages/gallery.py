# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of docs/gallery.md: of the first scene of README.md, of a bridle, of a bollard that is moved, of a cable on ground, of an anchor line, of a net, of a buoy, of a spar and a barge on lines, and of driven systems."""
import os
import re
import subprocess
import sys

from marks import read


def driven(name, *arguments):
    def draw(program):
        path = os.path.join(program.folder, re.sub(r"\W+", "_", "-".join(("drive", name) + arguments)) + ".svg")
        program.call("drive", f"examples/drive/{name}.yaml", *arguments, "--plot", path)
        return path
    return draw


def first_scene(program):
    """The plan of the last step of the scene in README.md."""
    scene = re.search(r"```yaml\n(.*?)```", read(os.path.join(program.root, "README.md")), re.S)[1]
    _, place = program.run("run", program.file("rope.yaml", scene))
    return os.path.join(place, "step-00004-plan.svg")


def bridle(program):
    """The plan of all steps of examples/bridle.yaml."""
    _, place = program.run("run", "examples/bridle.yaml")
    return os.path.join(place, "plan.svg")


def moved_bollard(program):
    """The plan of all steps of examples/moved-bollard.yaml."""
    _, place = program.run("run", "examples/moved-bollard.yaml")
    return os.path.join(place, "plan.svg")


def ridge(program):
    """The elevation of all steps of examples/ridge.yaml."""
    _, place = program.run("run", "examples/ridge.yaml")
    return os.path.join(place, "elevation.svg")


def ridge_plan(program):
    """Its plan."""
    _, place = program.run("run", "examples/ridge.yaml")
    return os.path.join(place, "plan.svg")


def spar(program):
    """The elevation of examples/oc3-hywind.yaml under the first thrust."""
    _, place = program.run("run", "examples/oc3-hywind.yaml")
    return os.path.join(place, "step-00004-elevation.svg")


def parting_lines(program):
    """The plan of examples/parting-lines.yaml where its first line has parted."""
    _, place = program.run("run", "examples/parting-lines.yaml")
    return os.path.join(place, "step-00008-plan.svg")


def barge(program):
    """The plan of examples/barge.yaml in the full wind."""
    _, place = program.run("run", "examples/barge.yaml")
    return os.path.join(place, "step-00006-plan.svg")


def net(program):
    """The plan of the last step of the scene that examples/net.py writes of 20 x 20 meshes."""
    maker = os.path.join(program.root, "examples", "net.py")
    scene = subprocess.run([sys.executable, maker, "20"], capture_output=True, text=True, check=True).stdout
    _, place = program.run("run", program.file("net.yaml", scene))
    return os.path.join(place, "step-00004-plan.svg")


def moored_buoy(program):
    """The elevation of all steps of examples/catenary-moored-buoy.yaml."""
    _, place = program.run("run", "examples/catenary-moored-buoy.yaml")
    return os.path.join(place, "elevation.svg")


def offset(program):
    """What the lines of examples/oc3-hywind.yaml oppose to its offset."""
    _, place = program.run("offset", "examples/oc3-hywind.yaml", "--headings", "0,30,60", "--to", "20", "--steps", "20")
    return os.path.join(place, "offset.svg")


def anchor_line(program):
    """The elevation of all steps of examples/chain-wire-chain.yaml."""
    _, place = program.run("run", "examples/chain-wire-chain.yaml")
    return os.path.join(place, "elevation.svg")


PICTURES = {
    "run-offset": offset, "run-anchor-line": anchor_line,
    "run-rope": first_scene, "run-bridle": bridle, "run-moved-bollard": moved_bollard, "run-ridge": ridge, "run-ridge-plan": ridge_plan, "run-oc3-hywind": spar, "run-barge": barge,
    "run-parting-lines": parting_lines, "run-net": net, "run-moored-buoy": moored_buoy,
    "drive-wheel-maps": driven("braked-wheel"),
    "drive-wheel-reduced": driven("braked-wheel", "--eliminate", "--velocity", "1,0.2", "--velocity", "0,1", "--velocity", "0.5,2"),
    "drive-disc": driven("disc"), "drive-plate": driven("plate"), "drive-car": driven("car"), "drive-planimeter": driven("planimeter"),
    "drive-rope-straight": driven("rope-straight"), "drive-rope-slack": driven("rope-slack"), "drive-rope-arc": driven("rope-arc"),
    "drive-tractrix": driven("tractrix"), "drive-play": driven("play"),
}
