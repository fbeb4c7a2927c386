# SPDX-License-Identifier: BSD-3-Clause
"""Scenes from text, file, dictionary and objects are one and the same; errors say what the command says."""
import math
import pickle
import random
import subprocess

import numpy as np
import pytest

import capstan
from capstan import _yaml


def by_objects():
    return capstan.Scene(
        title="a rope on a floor",
        obstacles={"floor": capstan.Obstacle(plane={}, friction=0.5)},
        lines={"rope": capstan.Line(length=2, elements=20, mass=1, stiffness=1e4,
                                    start={"straight": {"from": [0, 0, 0], "to": (2, 0, 0)}},
                                    ends={"A": "free", "B": {"held": np.array([2.0, 0, 0])}})},
        history=[{"name": "pull", "rope.B": {"move": [0.5, 0.3, 0]}, "steps": 5},
                 {"name": "back", "rope.B": {"move": [-0.2, 0, 0]}, "steps": np.int64(3)}])


def ends(scene):
    return [step.lines["rope"].end[1].force.tolist() for step in capstan.run(scene)]


def test_every_way_to_make_a_scene_gives_the_same_bits(rope, tmp_path):
    path = tmp_path / "rope.yaml"
    path.write_text(rope)
    expected = ends(rope)
    assert len(expected) == 8 and all(any(force) for force in expected)
    for scene in (path, str(path), rope.encode(), capstan.Scene.read(path), capstan.Scene.from_yaml(rope), by_objects(),
                  by_objects().to_dict(), by_objects().to_yaml(), capstan.Scene.of(path).copy(),
                  pickle.loads(pickle.dumps(by_objects()))):
        assert ends(scene) == expected


def test_a_scene_that_was_read_can_be_changed(rope):
    scene = capstan.Scene.from_yaml(rope)
    assert scene.to_yaml() == rope
    scene["obstacles"]["floor"]["friction"] = 0
    slippery = ends(scene)
    assert slippery != ends(rope)
    # without friction a rope on a floor that is dragged by one end resists by nothing
    assert np.abs(slippery).max() < 1e-9 * 9.81


def test_objects_carry_the_keys_of_the_file():
    line = capstan.Line(length=2)
    line.stiffness = math.inf
    assert line.stiffness == math.inf and line.to_tree() == {"length": 2, "stiffness": math.inf}
    assert capstan.Line(length=2) == capstan.Line(length=2.0) != capstan.Line(length=3)
    with pytest.raises(AttributeError, match="no 'mass' yet"):
        line.mass
    del line.stiffness
    assert repr(line) == "Line(length=2)"


@pytest.mark.parametrize("wrong, words, line, column", [
    ("  rope:\n    length: -2\n", "'length'", 7, 5),
    ("  rope:\n    lenght: 2\n", "did you mean 'length'?", 7, 5),
])
def test_errors_have_the_words_and_the_place_of_the_command(rope, command, wrong, words, line, column, tmp_path):
    broken = rope.replace("  rope:\n    length: 2\n", wrong)
    path = tmp_path / "broken.yaml"
    path.write_text(broken)
    with pytest.raises(capstan.InputError) as found:
        capstan.Scene.read(path)
    assert found.value.code == "CPS_ERR_INPUT"
    assert found.value.path == (str(path), line, column)
    assert found.value.path.line == line and words in str(found.value)
    said = subprocess.run([command, "check", str(path)], capture_output=True, text=True)
    assert said.returncode == 3 and said.stderr == f"capstan: {found.value}\n"
    # the same from text, with a name of one's own, and through pickle
    with pytest.raises(capstan.InputError) as again:
        capstan.Scene.from_yaml(broken, "my scene").check()
    assert again.value.message == found.value.message and again.value.path == ("my scene", line, column)
    copy = pickle.loads(pickle.dumps(again.value))
    assert (copy.path, copy.code, copy.where, str(copy)) == \
        (again.value.path, again.value.code, again.value.where, str(again.value))


def test_the_place_in_the_scene_is_named(rope):
    with pytest.raises(capstan.InputError) as found:
        capstan.Scene.from_yaml(rope.replace("[2, 0, 0]}}\n    ends", "[3e3, 0, 0]}}\n    ends")).check()
    assert found.value.where.startswith("lines.rope")


def test_files_that_cannot_be_read():
    with pytest.raises(capstan.FileError, match="cannot open") as found:
        capstan.Scene.read("nowhere.yaml")
    assert found.value.code == "CPS_ERR_IO" and found.value.path == ("nowhere.yaml", 0, 0)
    with pytest.raises(capstan.FileError, match="directory"):
        capstan.run(".")


@pytest.mark.parametrize("source", [None, 3, [], object(), "", "a\0b\n", "capstan: 1\n\0", {"lines": None}, {"lines": {1: {}}},
                                    {"lines": {"a": object()}}, {}, b"\xff\xfe", "capstan: 1\ntitle: \ud800\n",
                                    {"title": "\0"}, {"title": float("nan")}, {"capstan": 2}, {"gravity": "down"}])
def test_what_is_no_scene_is_refused(source):
    with pytest.raises((capstan.Error, TypeError)) as found:
        capstan.Evolution(source)
    assert str(found.value)


def test_files_beside_a_scene_are_found(rope, tmp_path):
    folder = tmp_path / "inside"
    folder.mkdir()
    # nodes of the start in a table beside the scene
    rows = "x,y,z\n" + "".join(f"{0.1 * i},0,0\n" for i in range(21))
    (folder / "nodes.csv").write_text(rows)
    text = rope.replace("{straight: {from: [0, 0, 0], to: [2, 0, 0]}}", "{nodes: nodes.csv}")
    (folder / "rope.yaml").write_text(text)
    found = ends(folder / "rope.yaml")
    assert found == ends(capstan.Scene.from_yaml(text, str(folder / "any name.yaml")))
    with pytest.raises(capstan.Error, match="cannot open"):
        capstan.Scene.from_yaml(text).check()


# ---- YAML ----

def random_tree(draw, depth=0):
    kind = draw.randrange(8 if depth < 4 else 6)
    if kind == 0:
        return draw.choice([0, 1, -7, 10**18, True, False])
    if kind == 1:
        return draw.choice([0.0, -0.0, 1e-300, 1e300, math.inf, -math.inf, 0.1, 1e22, draw.gauss(0, 1)])
    if kind < 6:
        return draw.choice(["", "a", "true", "Null", "no", "1e5", "0x10", ".5", "a b", "a: b", "- a", "#", "'", '"', "é", "{", "~",
                            "a\nb", "\t", "line.B", "1_000", "=", "12:30", " a", "a ", "[", "\\", "%", "@", "\u2028"])
    if kind == 6:
        return [random_tree(draw, depth + 1) for _ in range(draw.randrange(5))]
    return {str(random_tree(draw, 9)): random_tree(draw, depth + 1) for _ in range(draw.randrange(5))}


def test_what_is_written_as_yaml_is_read_back():
    """Seeded trees of all that YAML could take for something else."""
    for seed in range(300):
        draw = random.Random(seed)
        tree = {f"key {i}": random_tree(draw) for i in range(3)}
        back = _yaml.load(_yaml.dump(tree), "tree")
        assert back == tree and repr(back) == repr(tree), seed


def test_numbers_reach_the_library_to_the_last_bit(rope):
    for seed in range(50):
        length = random.Random(seed).uniform(1.999, 2)
        scene = capstan.Scene.from_yaml(rope)
        scene["lines"]["rope"]["length"] = length
        scene["lines"]["rope"].update(elements=1)
        assert capstan.Evolution(scene)["rope"].arc_length[-1] == length
