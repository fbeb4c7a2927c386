# SPDX-License-Identifier: BSD-3-Clause
"""Nothing of the library is forgotten: keys of scenes, entries of histories as targets, and functions of the headers."""
import inspect
import json
import re
import subprocess

import numpy as np
import pytest
import yaml

import capstan

OBJECTS = {"scene": capstan.Scene, "line": capstan.Line, "point": capstan.Point, "body": capstan.Body, "obstacle": capstan.Obstacle,
           "friction": capstan.Friction}


@pytest.fixture(scope="module")
def schema():
    import os
    return json.loads(subprocess.run([os.environ["CAPSTAN_COMMAND"], "schema", "scene"], capture_output=True, check=True).stdout)["$defs"]


@pytest.mark.parametrize("kind", OBJECTS)
def test_objects_take_every_key_of_the_schema(schema, kind):
    keys = list(schema[kind]["properties"])
    assert list(inspect.signature(OBJECTS[kind]).parameters) == keys and len(keys) > 4
    for key in keys:
        assert f"\n    {key + ':':18} " in OBJECTS[kind].__doc__
        made = OBJECTS[kind](**{key: 1})
        assert (made.tree if kind == "scene" else made.to_tree())[key] == 1


def test_the_reader_knows_what_the_objects_write(rope):
    """A wrong value of a key is refused as a value; only a word that is none is refused as a key."""
    def said(**more):
        scene = capstan.Scene.from_yaml(rope)
        scene["lines"]["rope"] = capstan.Line(**{**scene["lines"]["rope"], **more})
        with pytest.raises(capstan.InputError) as found:
            scene.check()
        return str(found.value)
    for key in inspect.signature(capstan.Line).parameters:
        if key not in ("elements", "element_length"):
            assert "unknown" not in said(**{key: [[{"no": "value"}]]}), key
    assert "unknown key 'lenght'" in said(lenght=1)


def objects_of(tree):
    """The same scene of objects."""
    made = dict(tree)
    for name, kind in (("lines", capstan.Line), ("points", capstan.Point), ("bodies", capstan.Body), ("obstacles", capstan.Obstacle)):
        if name in made:
            made[name] = {key: kind(**value) for key, value in made[name].items()}
    for obstacle in made.get("obstacles", {}).values():
        if "friction" in obstacle._keys and isinstance(obstacle.friction, dict):
            obstacle.friction = capstan.Friction(**obstacle.friction)
    return capstan.Scene(**made)


def test_every_example_can_be_made_of_objects(root, monkeypatch):
    monkeypatch.chdir(root / "examples")
    used = set()
    for path in sorted((root / "examples").glob("*.yaml")):
        read = capstan.Scene.read(path)
        made = objects_of(read.tree)
        made._name = str(path)  # beside which the files that it names lie
        made.check()
        assert made.to_dict() == read.to_dict()
        used |= {key for part in ("lines", "obstacles") for one in read.to_dict().get(part, {}).values() for key in one}
        used |= {key for entry in read.to_dict().get("history", []) for key in entry if "." not in key}
        used |= {end for line in read.to_dict()["lines"].values() for value in (line.get("ends") or {}).values()
                 if isinstance(value, dict) for end in value}
    for key in ("duration", "drag", "mesh", "ground", "box"):
        assert key in used, key


# ---- targets: what an entry of the history can say, but steps ----

# a value of each key of each kind of change, with what it cannot be without
SAMPLES = {
    "change": {"position": {}, "move": {}, "force": {}, "release": {}, "sine": {"position": [2, 0, 0], "period": 1},
               "cosine": {"position": [2, 0, 0], "period": 1}, "period": {"position": [2, 0, 0], "sine": [0, 0, 0.01]},
               "oscillations": {"move": [0, 0, 0]}},
    "grasp": {"at": {"hold": True}, "position": {"at": 1}, "hold": {"at": 1}, "force": {"at": 1}, "release": {"at": 1}},
    "point_change": {"position": {}, "move": {}, "force": {}, "sine": {"move": [0, 0, 0], "period": 1},
                     "cosine": {"move": [0, 0, 0], "period": 1}, "period": {"force": [2, 0, 0], "sine": [0, 0, 0.01]},
                     "oscillations": {"force": [0, 0, 0]}},
    "body_change": {"position": {}, "move": {}, "rotation": {}, "force": {}, "moment": {}, "arm": {"force": [0, 0, 1]},
                    "oscillations": {"move": [0, 0, 0]}},
    "obstacle_change": {"move": {}, "turn": {"axis": [0, 0, 1]}, "axis": {"turn": 1}, "about": {"turn": 1, "axis": [0, 0, 1]}}}
VALUES = {"release": True, "hold": True, "period": 1.0, "at": 1.0, "turn": 1.0, "rotation": {"quaternion": [1, 0, 0, 0]}, "axis": [0, 0, 1],
          "oscillations": [{"sine": [0, 0, 0.1], "period": 3}, {"cosine": [0, 0.1, 0], "period": 2}]}

SCENE = """\
capstan: 1
gravity: [0, 0, -9.81]
obstacles: {floor: {plane: {point: [0, 0, -5]}, friction: 0.5}, drum: {cylinder: {point: [0, 0, -9], radius: 1}, friction: 0.3}}
bodies: {spar: {held: [5, 0, 0], mass: 100}}
points: {eye: {body: spar, at: [0, 0, 0]}, knot: {held: [1, 2, 0]}}
lines:
  rope: {length: 2, elements: 10, mass: 1, inertia: 1, stiffness: 1e4, start: static, ends: {A: {held: [0, 0, 0]}, B: {held: [1.5, 0, 0]}}}
  other: {length: 4, elements: 10, mass: 1, stiffness: 1e4, start: static, ends: {A: {point: knot}, B: {point: eye}}}
"""


def test_targets_take_every_key_of_an_entry(schema):
    evolution = capstan.Evolution(SCENE, moving=["floor"])
    evolution.step()
    names = {"A": "rope", "B": "rope", "node": "rope", "node2": "rope", "node3": "rope", "node4": "rope", "pay_out_A": "rope",
             "pay_out_B": "rope", "turn": "drum", "point": "knot", "body": "spar", "obstacle": "floor"}
    taken = 0
    for pattern, what in schema["entry"]["patternProperties"].items():
        for word in re.search(r"\((.*)\)\$$", pattern).group(1).split("|"):
            key = f"{names[word]}.{word}"
            if "$ref" not in what:
                evolution.target({key: 0.1})
                taken += 1
                continue
            kind = what["$ref"].rpartition("/")[2]
            # a move is one step: it has no time series
            for name in set(schema[kind]["properties"]) - {"series"}:
                assert name in SAMPLES[kind], f"a target does not know the new key {name} of {kind}"
                evolution.target({key: {name: VALUES.get(name, [0.1, 0.2, 0.3]), **SAMPLES[kind][name]}})
                taken += 1
    assert taken > 40
    values = {"name": "a step", "gravity": [0, 0, -9], "stiffness": "static", "duration": 0.1}
    # a move is one step, as long as it says
    for name in set(schema["entry"]["properties"]) - {"steps", "time_step", "error"}:
        evolution.target({name: values[name]})


def test_targets_do_what_the_history_does():
    """The same changes as entries of a history, and as moves: the same bits."""
    entries = [{"name": "body", "spar.body": {"move": [0.1, 0, 0.2], "rotation": {"roll_pitch_yaw": [10, -20, 30]}}},
               {"name": "point", "knot.point": {"move": [0, 0.1, 0]}},
               {"name": "let go", "spar.body": {"force": [0, 0, 1200], "moment": [-240, 120, 0], "arm": [0.1, 0.2, 0]}}]
    scene = yaml.safe_load(SCENE)
    # 1e4 and the like are numbers for the reader of scenes, and texts for this one
    for line in scene["lines"].values():
        line["stiffness"] = 1e4
    whole = capstan.Evolution({**scene, "history": entries})
    for _ in whole:
        pass
    moves = capstan.Evolution(scene)
    moves.step()
    for entry in entries:
        moves.move(entry)
    for line in ("rope", "other"):
        assert np.array_equal(whole[line].position, moves[line].position)
    assert np.array_equal(whole.bodies["spar"].rotation, moves.bodies["spar"].rotation)
    assert whole.bodies["spar"].position[0] != 5.1  # it has been let go


def test_oscillations_of_points_and_bodies():
    scene = yaml.safe_load(SCENE)
    for line in scene["lines"].values():
        line.update(stiffness=1e4, quasi_static=True)
    evolution = capstan.Evolution(scene, in_time=True)
    evolution.step()
    turning = {"rotation_sine": [0, 0, 90], "sine": [0, 0, 0.5], "period": 4}
    evolution.move({"duration": 1, "spar.body": {"move": [0, 0, 0], "oscillations": [turning]},
                    "knot.point": {"move": [0, 0, 0], "sine": [0.1, 0, 0], "period": 4, "oscillations": [{"sine": [0, 0.1, 0], "period": 4}]}})
    # a quarter of the period: the body has turned by 90 degrees about z
    assert np.allclose(evolution.bodies["spar"].rotation, [np.sqrt(0.5), 0, 0, np.sqrt(0.5)], atol=1e-12)
    assert np.allclose(evolution.bodies["spar"].position, [5, 0, 0.5], atol=1e-12)
    assert np.allclose(evolution.points["knot"].position, [1.1, 2.1, 0], atol=1e-12)
    for bad, words in (({**turning, "moment_sine": [1, 0, 0]}, "held"), ({"period": 2}, "one or more"),
                       ({"sine": [0, 0, 1]}, "period"), ({**turning, "sway": 1}, "one or more"), (3, "list of dictionaries")):
        with pytest.raises(capstan.ArgumentError, match=words):
            evolution.target({"spar.body": {"move": [0, 0, 0], "oscillations": [bad]}})
    with pytest.raises(capstan.ArgumentError, match="release"):
        evolution.target({"rope.B": {"release": True, "oscillations": [{"sine": [0, 0, 1], "period": 1}]}})
    many = [{"sine": [0, 0, 0.01], "period": 3.0}] * 100
    with pytest.raises(capstan.Error, match="at most 56 in a move"):
        evolution.move({"duration": 1, "spar.body": {"move": [0, 0, 0], "oscillations": many}})


def test_moves_in_time():
    scene = yaml.safe_load(SCENE)
    del scene["points"], scene["bodies"], scene["lines"]["other"]
    scene["lines"]["rope"]["stiffness"] = 1e4
    with pytest.raises(capstan.ArgumentError, match="in_time"):
        still = capstan.Evolution(scene)
        still.step()
        still.move({"duration": 0.1})
    evolution = capstan.Evolution(scene, in_time=True)
    evolution.step()
    evolution.move({"duration": 0.05, "rope.B": {"position": [1.5, 0, 0], "sine": [0, 0, 0.2], "period": 0.2}})
    motion = evolution["rope"].in_time
    assert evolution.time == 0.05 and motion.is_moving and motion.kinetic > 0 and motion.velocity.shape == (11, 3)
    assert evolution.in_time.kinetic == motion.kinetic and evolution.in_time.ledger.scheme == motion.ledger.scheme
    assert evolution.pace.length == 0.05 and evolution.pace.error == 0 and evolution.pace.rejected == 0
    # a quarter of the period: the end has come to the top of its way
    assert np.allclose(evolution["rope"].B.position, [1.5, 0, 0.2], atol=1e-12)
    # the kinetic energy is that of the nodes
    assert 0.5 * (motion.mass * (motion.velocity ** 2).sum(1)).sum() == pytest.approx(motion.kinetic, rel=1e-9)
    assert evolution["rope"].winch("B").is_there is False and evolution["rope"].two_stiffnesses.exists is False
    assert evolution["rope"].winch("B").length is None


def test_points_and_bodies_in_time():
    # a clump on a stiff spring of a line, and a body that turns freely beside it
    evolution = capstan.Evolution({
        "bodies": {"top": {"free": [0, 0, 0], "mass": 4, "moments_of_inertia": [2, 2, 3], "turn_rate": [0, 0, 0.5]}},
        "points": {"eye": {"body": "top"}, "clump": {"free": [5, 0, 0], "mass": 2, "velocity": [0, 0, -1]}},
        "lines": {"one": {"length": 1, "elements": 2, "mass": 0.1, "stiffness": 1e5, "start": {"straight": {"from": [0, 0, 1], "to": [0, 0, 0]}},
                          "ends": {"A": {"held": [0, 0, 1]}, "B": {"point": "eye"}}},
                  "two": {"length": 1, "elements": 2, "mass": 0.1, "stiffness": 1e5, "start": {"straight": {"from": [5, 0, 1], "to": [5, 0, 0]}},
                          "ends": {"A": {"held": [5, 0, 1]}, "B": {"point": "clump"}}}},
        "history": [{"name": "swing", "duration": 0.01, "time_step": 0.001}]})
    for _ in evolution:
        pass
    top, clump = evolution.bodies_in_time["top"], evolution.points_in_time["clump"]
    assert top.is_moving and clump.is_moving and not evolution.points_in_time["eye"].landed
    assert clump.kinetic == pytest.approx(0.5 * clump.mass * (clump.velocity ** 2).sum(), rel=1e-9)
    # about its axis nothing turns the body: its angular momentum stays
    assert top.turn_rate[2] == pytest.approx(0.5, rel=1e-6) and top.angular_momentum[2] == pytest.approx(1.5, rel=1e-6)


def velocities(of, k):
    """What is led by the k-th step from rest at a constant acceleration: place and velocity."""
    step, push, spin = 0.1, np.array([0.7, -0.4, 0.5]), 0.9
    time = k * step
    place = {"position": of + push * time ** 2 / 2, "velocity": push * time}
    angle = spin * time ** 2 / 2
    turned = {"rotation": {"quaternion": [np.cos(angle / 2), 0, 0, np.sin(angle / 2)]}, "turn_rate": [0, 0, spin * time]}
    return place, {**place, **turned}, push, spin


def test_velocities_that_are_given():
    """The force that leads is that of the line, of one element, and mass times the acceleration, exact from the first step on."""
    ends = np.array([[2.1, 0, 0], [2.1, 5, 0], [2.1, 9, 0]])
    line = {"length": 2, "elements": 1, "stiffness": 500}
    start = [{"straight": {"from": [0, end[1], 0], "to": end.tolist()}} for end in ends]
    scene = {"bodies": {"hull": {"held": [2.1, 9, 0], "mass": 40, "moments_of_inertia": [8, 9, 12]}},
             "points": {"ring": {"held": [2.1, 5, 0], "mass": 40}, "eye": {"body": "hull", "at": [0, 0, 0]}},
             "lines": {"one": {**line, "mass": 40, "start": start[0], "ends": {"A": {"held": [0, 0, 0]}, "B": {"held": ends[0].tolist()}}},
                       "two": {**line, "mass": 0, "quasi_static": True, "start": start[1],
                               "ends": {"A": {"held": [0, 5, 0]}, "B": {"point": "ring"}}},
                       "three": {**line, "mass": 0, "quasi_static": True, "start": start[2],
                                 "ends": {"A": {"held": [0, 9, 0]}, "B": {"point": "eye"}}}},
             "gravity": [0, 0, 0]}
    evolution = capstan.Evolution(scene, in_time=True)
    for k in range(1, 6):
        (end, _, push, _), (ring, *_), (_, hull, _, spin) = (velocities(of, k) for of in ends)
        evolution.move({"duration": 0.1, "one.B": end, "ring.point": ring, "hull.body": hull})
        from_a = end["position"]
        pull = 500 * (np.linalg.norm(from_a) / 2 - 1) * from_a / np.linalg.norm(from_a)
        # of 60 N; places are rounded, and count by 40 kg/k^2
        assert np.allclose(evolution["one"].B.force, pull + 40 * push, atol=1e-9)
        assert np.allclose(evolution.points["ring"].support, pull + 40 * push, atol=1e-9)
        assert np.allclose(evolution.bodies["hull"].support, [*(pull + 40 * push), 0, 0, 12 * spin], atol=1e-9)
        moved = evolution["one"].in_time
        assert list(moved.velocity_given) == [False, True] and np.allclose(moved.velocity[-1], end["velocity"], atol=1e-12)
        assert evolution.points_in_time["ring"].velocity_given and evolution.points_in_time["eye"].velocity_given
        top = evolution.bodies_in_time["hull"]
        assert top.velocity_given and np.allclose(top.velocity, hull["velocity"], atol=1e-12)
        assert np.allclose(top.turn_rate, hull["turn_rate"], atol=1e-12)
    # without: the flags go, and x* is that of the scheme
    evolution.move({"duration": 0.1, "one.B": {"move": [0, 0, 0]}})
    assert list(evolution["one"].in_time.velocity_given) == [False, False]
    assert not evolution.points_in_time["ring"].velocity_given and not evolution.bodies_in_time["hull"].velocity_given
    # values can be written between moves; of a body the rate of rotation is behind the velocity
    target = evolution.target({"duration": 0.1, "hull.body": {"move": [0, 0, 0], "velocity": [0, 0, 0]}, "ring.point": {"move": [0, 0, 0], "velocity": [1, 0, 0]}})
    target["hull.body.velocity"][:] = 0.1, 0, 0, 0, 0.2, 0
    target["ring.point.velocity"][:] = 0, 0.3, 0
    evolution.move(target)
    assert np.allclose(evolution.bodies_in_time["hull"].velocity, [0.1, 0, 0], atol=1e-12)
    assert np.allclose(evolution.bodies_in_time["hull"].turn_rate, [0, 0.2, 0], atol=1e-12)
    assert np.allclose(evolution.points_in_time["ring"].velocity, [0, 0.3, 0], atol=1e-12)


def test_velocities_that_mean_nothing():
    evolution = capstan.Evolution(yaml.safe_load(SCENE.replace("1e4", "10000.0").replace("inertia: 1, ", "")), in_time=True)
    evolution.step()
    before, nan = evolution.save(), float("nan")
    hold, speed, timed = {"move": [0, 0, 0]}, {"velocity": [1, 0, 0]}, {"duration": 0.1}
    for move, words in (({"rope.B": {**hold, **speed}}, "takes no time"), ({"knot.point": {**hold, **speed}}, "takes no time"),
                        ({"spar.body": {**hold, "turn_rate": [0, 0, 1]}}, "takes no time"),
                        ({**timed, "rope.B": {"force": [0, 0, 1], **speed}}, "not held"), ({**timed, "rope.B": {"release": True, **speed}}, "not held"),
                        ({**timed, "knot.point": {"force": [0, 0, 1], **speed}}, "not held"),
                        ({**timed, "spar.body": {"force": [0, 0, 1], **speed}}, "not held"),
                        ({**timed, "rope.B": speed}, "exactly one of position"), ({**timed, "knot.point": speed}, "exactly one of position"),
                        ({**timed, "spar.body": speed}, "position or move"), ({**timed, "rope.node": {"at": 1, "hold": True, **speed}}, "exactly one of"),
                        ({**timed, "rope.B": {**hold, "turn_rate": [0, 0, 1]}}, "exactly one of"),
                        ({**timed, "floor.obstacle": speed}, "move"),
                        ({**timed, "rope.B": {**hold, "velocity": [nan, 0, 0]}}, "rope.B.velocity"),
                        ({**timed, "knot.point": {**hold, "velocity": [1, 0]}}, "knot.point.velocity"),
                        ({**timed, "spar.body": {**hold, "velocity": [1, 0, 0, 0, 0, 0]}}, "'spar.body' velocity"),
                        ({**timed, "spar.body": {**hold, "turn_rate": [0, 0, nan]}}, "'spar.body' turn_rate")):
        with pytest.raises(capstan.ArgumentError, match=words):
            evolution.move(move)
        assert evolution.save() == before, move


def test_the_reaction_of_a_rail(root):
    evolution = capstan.Evolution(root / "examples/bollard-and-rail.yaml")
    evolution.step()
    (line,) = evolution.lines.values()
    found = line.constraint("B")
    assert found.is_there and found.is_active and not line.constraint("A").is_there
    # the rail is along x, and has no friction: what it takes is across, and balances the line
    assert abs(found.reaction[0]) < 1e-9 * np.linalg.norm(found.reaction)
    with pytest.raises(capstan.ArgumentError, match="expected 'A' or 'B'"):
        line.constraint("C")


def test_a_point_on_a_rail():
    line = {"length": 3.5, "elements": 5, "weight": 2, "stiffness": 1e4, "start": "static"}
    evolution = capstan.Evolution({
        "capstan": 1, "points": {"ring": {"free": [0, 0, 0], "on": {"rail": {"from": [0, 0, 0], "along": [0, 1, 0]}}, "weight": 50}, "eye": {"held": [3, 1, 1]}},
        "lines": {"one": {**line, "ends": {"A": {"held": [-3, -2, 1]}, "B": {"point": "ring"}}}, "two": {**line, "ends": {"A": {"point": "ring"}, "B": {"point": "eye"}}}}})
    evolution.step()
    assert evolution.certified
    found, report = evolution.point_constraints["ring"], evolution.points["ring"]
    assert found.is_there and found.is_active and not evolution.point_constraints["eye"].is_there
    # across the rail, it balances lines and weight
    assert found.reaction[1] == 0 and np.allclose(found.reaction, report.set_reaction, atol=0)
    assert np.allclose(found.reaction + report.lines + report.load, 0, atol=1e-6)


def test_winches_partings_and_two_stiffnesses(root):
    evolution = capstan.Evolution(root / "examples/winched-mooring.yaml")
    stored = []
    for _ in evolution:
        line = next(line for line in evolution.lines.values() if any(line.winch(end).is_there for end in "AB"))
        found = next(line.winch(end) for end in "AB" if line.winch(end).is_there)
        assert found.length.shape == line.tension.shape and found.pull > 0
        stored.append(found.stored + found.paid)
    assert np.allclose(stored, stored[0], rtol=1e-12)  # no length is lost
    parting = capstan.Evolution(root / "examples/parting-lines.yaml")
    broken = []
    for _ in parting:
        if parting.parting.is_break:
            broken.append(parting.parting)
    assert broken and all(one.tension > one.break_at for one in broken)
    assert not parting.parts_next


# ---- functions ----

# what Python does not call, and why
NOT_CALLED = {
    r"cps_\w+_(retain|release|destroy)|cps_solution_set_clear": "objects of Python own what they hold",
    r"cps_(\w+_)?(default|check)": "structs that scenes fill; Scene.check",
    r"cps_\w+_(name|text)": "enumerations are their words",
    r"cps_evolution_(body|line|obstacle|point)_count|cps_ledgers_add|cps_law_file_(space|title)|cps_loaded_law_\w+|cps_extremes_add": "lists of Python",
    r"cps_set_(support|contains|gauge|dissipation)|cps_evolution_interrupt": "called by native.c, in loops and for signals",
    r"cps_set_conic\w*|cps_set_user": "for programs in C that extend the library",
    r"cps_sway_at|cps_wave_number|cps_breaking_height|cps_waves_at": "sines and cosines",
    r"cps_evolution_(point|point_motion|body|obstacle)_view": "reports have the places in the scene",
    r"cps_evolution_(potential|follow|water)": "functions in C; a loop of moves",
    r"cps_(ground|mesh)_(create|report|distance|height)": "scenes read grounds and meshes from files",
    r"cps_(json_\w+|write_file|row_read|suggest|read_limits_default|(law|drive)_write_schema|drive_walk)": "of the command",
    r"cps_drive_(read\w*|draw_\w+)|cps_(law|resistance)_draw|cps_law_picture_default": "files of driven systems: `python -m capstan drive`",
    r"cps_(journal|study|methods|completed|regularized|first_order|offsets)_\w+|cps_completed_\w+|cps_results_write_summary":
        "studies and journals: `python -m capstan study`, `offset`, `run`",
    r"cps_solution_(complete|judge|slack)": "all solutions of a step: `python -m capstan study`",
    r"cps_(line_resize|scene_length_for)": "the key `pretension`, and scipy (examples/python/line_length.py)",
    r"cps_law_load|cps_resistance_(conjugate|function|is_dry|residual)|cps_outcome_is_final|cps_body_(angles|added_mass)|cps_set_project": "can be had otherwise",
}


def test_every_function_is_called_or_has_a_reason(root):
    declared = {name for header in (root / "include/capstan").glob("*.h")
                for name in re.findall(r"^CPS_API[^;{]*?\b(cps_\w+)\(", header.read_text(), re.M)}
    assert len(declared) > 250
    package = "".join(path.read_text() for path in (root / "python/capstan").glob("*.py"))
    missing = {name for name in declared if not re.search(rf"\blib\.{name}\b", package)}
    unexplained = {name for name in missing if not any(re.fullmatch(pattern, name) for pattern in NOT_CALLED)}
    assert not unexplained, f"Python cannot call {sorted(unexplained)}: add them, or say why not"
