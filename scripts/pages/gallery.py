# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of docs/gallery.md: of the first scene of README.md, of a bridle, of a bollard that is moved, of a cable on ground, of lines on a quay and in a bore, of an anchor line, of a net, of a buoy, of a spar and a barge on lines, and of driven systems."""
import os
import re

from marks import read
from net import drape, run_of


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


def of_example(name, picture):
    """A picture of the run of an example."""
    def make(program):
        _, place = program.run("run", f"examples/{name}.yaml")
        return os.path.join(place, picture)
    return make


def net(program):
    """The plan of the last step of the scene that examples/net.py writes of 20 x 20 meshes."""
    return os.path.join(run_of(program, 20), "step-00004-plan.svg")


def offset(program):
    """What the lines of examples/oc3-hywind.yaml oppose to its offset."""
    _, place = program.run("offset", "examples/oc3-hywind.yaml", "--headings", "0,30,60", "--to", "20", "--steps", "20")
    return os.path.join(place, "offset.svg")


PICTURES = {
    "run-offset": offset, "run-anchor-line": of_example("chain-wire-chain", "elevation.svg"),
    "run-rope": first_scene,
    "run-bridle": of_example("bridle", "plan.svg"),
    "run-moved-bollard": of_example("moved-bollard", "plan.svg"),
    "run-ridge": of_example("ridge", "elevation.svg"),
    "run-rock": of_example("rock", "plan.svg"),
    "run-ridge-plan": of_example("ridge", "plan.svg"),
    "run-quay": of_example("quay", "plan.svg"),
    "run-bore": of_example("bore", "plan.svg"),
    "run-lay-on-slope": of_example("lay-on-slope", "plan.svg"),
    "run-oc3-hywind": of_example("oc3-hywind", "step-00004-elevation.svg"),
    "run-barge": of_example("barge", "step-00006-plan.svg"),
    "run-bollard-and-rail": of_example("bollard-and-rail", "plan.svg"),
    "run-polyester": of_example("polyester-leg", "loop-mean-offset.svg"),
    "run-winch": of_example("winched-mooring", "tension.svg"),
    "run-riser": of_example("riser-in-a-current", "elevation.svg"),
    "run-soft-clay": of_example("soft-clay", "elevation.svg"),
    "run-dropped-chain": of_example("dropped-chain", "elevation.svg"),
    "run-oc3-decay": of_example("oc3-hywind-decay", "history.svg"),
    "run-oc3-waves": of_example("oc3-hywind-waves", "history.svg"),
    "run-floating-frame": of_example("floating-frame", "history.svg"),
    "run-parting-lines": of_example("parting-lines", "step-00008-plan.svg"),
    "run-net": net, "run-net-drape": lambda program: drape(program, 20), "run-oc3-planes": of_example("oc3-hywind", "planes.svg"),
    "run-moored-buoy": of_example("catenary-moored-buoy", "elevation.svg"),
    "drive-wheel-maps": driven("braked-wheel"),
    "drive-wheel-reduced": driven("braked-wheel", "--eliminate", "--velocity", "1,0.2", "--velocity", "0,1", "--velocity", "0.5,2"),
    "drive-disc": driven("disc"), "drive-plate": driven("plate"), "drive-car": driven("car"), "drive-planimeter": driven("planimeter"),
    "drive-rope-straight": driven("rope-straight"), "drive-rope-slack": driven("rope-slack"), "drive-rope-arc": driven("rope-arc"),
    "drive-tractrix": driven("tractrix"), "drive-play": driven("play"),
}
