# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of obstacles for pictures: each point sampled is at the distance that the shape says, where the obstacle is."""
import math

import numpy as np
import pytest

import capstan
from capstan._surfaces import surfaces

LOW, HIGH = np.array([-3.0, -3, -3]), np.array([3.0, 3, 3])
AXIS = np.array([1.0, 2, 2]) / 3
PLACE = np.array([0.3, -0.2, 0.1])
R = 0.4


def along(x):
    """Along the axis, and away from it."""
    t = (x - PLACE) @ AXIS
    return t, np.linalg.norm(x - PLACE - t[..., None] * AXIS, axis=-1)


def box_distance(x, size, turn):
    """From the sharp box that is smaller by the radius all round."""
    out = np.abs((x - PLACE) @ turn) - (np.array(size) / 2 - R)
    return np.linalg.norm(np.maximum(out, 0), axis=-1)


def capsule(x):
    t, away = along(x)
    return np.hypot(away, np.maximum(np.abs(t) - 0.75, 0))


def torus(x):
    t, away = along(x)
    return np.hypot(away - 1.1, t)


def cone(x):
    """From a sharp cone whose tip is R / sin(angle) - R below that of the rounded one, measured to its axis's side or tip."""
    t, away = along(x)
    angle = math.radians(30)
    t = t - R  # from the centre of the round tip
    side = away * math.cos(angle) - t * math.sin(angle)
    return np.where(t * math.cos(angle) + away * math.sin(angle) < 0, np.hypot(t, away), side)


ABOUT_Z = math.radians(20)
TURN = np.array([[math.cos(ABOUT_Z), -math.sin(ABOUT_Z), 0], [math.sin(ABOUT_Z), math.cos(ABOUT_Z), 0], [0, 0, 1]])
SHAPES = {
    "cylinder": ({"point": PLACE, "axis": AXIS, "radius": R}, lambda x: along(x)[1]),
    "sphere": ({"centre": PLACE, "radius": R}, lambda x: np.linalg.norm(x - PLACE, axis=-1)),
    "capsule": ({"centre": PLACE, "axis": AXIS, "length": 1.5, "radius": R}, capsule),
    "torus": ({"centre": PLACE, "axis": AXIS, "main_radius": 1.1, "radius": R}, torus),
    "cone": ({"tip": PLACE, "axis": AXIS, "angle": 30, "radius": R}, cone),
    "box": ({"centre": PLACE, "size": [1, 1.6, 2.2], "radius": R, "rotation": {"quaternion": [math.cos(ABOUT_Z / 2), 0, 0, math.sin(ABOUT_Z / 2)]}},
            lambda x: box_distance(x, [1, 1.6, 2.2], TURN)),
}


def evolution_with(obstacle, **moves):
    """A line far above, which touches nothing."""
    return capstan.Evolution(capstan.Scene(
        obstacles={"it": obstacle},
        lines={"rope": {"length": 1, "elements": 2, "mass": 1, "stiffness": 1e4, "start": {"straight": {"from": [-50, -50, 80], "to": [-49, -50, 80]}},
                        "ends": {"A": "held", "B": "held"}}},
        history=[{"name": "move", **moves}]))


def sampled(evolution):
    (name, surface), = surfaces(evolution, LOW, HIGH)
    assert name == "it"
    return surface


@pytest.mark.parametrize("kind", SHAPES)
def test_points_are_on_the_shape(kind):
    keys, distance = SHAPES[kind]
    evolution = evolution_with({kind: keys}, **{"it.obstacle": {"move": [0.5, 0.25, -0.5]}})
    before = sampled(evolution).point
    assert np.abs(distance(before) - R).max() < 1e-12
    # and all around it: the middle of what is sampled is the shape's own, where that has one
    if kind in ("sphere", "capsule", "torus", "box"):
        assert np.allclose((before.reshape(-1, 3).max(0) + before.reshape(-1, 3).min(0)) / 2, PLACE, atol=0.02)
    evolution.step()
    assert np.allclose(sampled(evolution).point, before + [0.5, 0.25, -0.5], atol=1e-12)


def test_a_plane_extends_beyond_the_lines():
    point = sampled(evolution_with({"plane": {"point": PLACE, "normal": AXIS}})).point
    assert np.abs((point - PLACE) @ AXIS).max() < 1e-12
    assert np.linalg.norm(point[1, 1] - point[0, 0]) > np.linalg.norm(HIGH - LOW)


def test_ground_is_its_grid(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    x, y = [0.0, 1, 3], [-1.0, 0, 2, 3]
    z = np.arange(12.0).reshape(4, 3)
    rows = [f"{a} {b} {z[j, i]}\n" for j, b in enumerate(y) for i, a in enumerate(x)]
    (tmp_path / "bed.xyz").write_text("".join(rows))
    surface = sampled(evolution_with({"ground": {"file": "bed.xyz", "form": "xyz", "extend": True}}))
    assert np.allclose(surface.point, np.stack([*np.meshgrid(x, y), z], -1))


def test_a_mesh_turns_with_its_obstacle(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    corner = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]])
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
    (tmp_path / "tip.obj").write_text("".join("v {} {} {}\n".format(*x) for x in corner) + "".join("f {} {} {}\n".format(*(f + 1)) for f in faces))
    evolution = evolution_with({"mesh": {"file": "tip.obj", "form": "obj", "radius": 0.1}},
                               **{"it.obstacle": {"move": [0, 0, 1], "turn": 90, "axis": [0, 0, 1], "about": [0, 0, 0]}})
    surface = sampled(evolution)
    order = [np.flatnonzero((np.abs(surface.point - x) < 1e-12).all(1))[0] for x in corner]
    assert len(surface.triangle) == 4
    evolution.step()
    assert np.allclose(sampled(evolution).point[order], np.stack([-corner[:, 1], corner[:, 0], corner[:, 2] + 1], 1), atol=1e-12)


def test_the_view_in_space_shows_them():
    plots = pytest.importorskip("matplotlib") and capstan.plots
    import matplotlib

    matplotlib.use("Agg")
    keys, _ = SHAPES["torus"]
    evolution = evolution_with({"torus": keys})
    shown, bare = plots.view_3d(evolution), plots.view_3d(evolution, obstacles=False)
    assert len(shown.collections) == len(bare.collections) + 1
