# SPDX-License-Identifier: BSD-3-Clause
"""Pictures: what is drawn are the arrays, into the axes that are given."""
import numpy as np
import pytest

import capstan
from capstan import plots, sets

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")


@pytest.fixture
def axes():
    import matplotlib.pyplot as pyplot
    figure, ax = pyplot.subplots()
    yield ax


@pytest.fixture(autouse=True)
def closed():
    import matplotlib.pyplot as pyplot
    yield
    pyplot.close("all")


def first_line(ax):
    return np.stack(ax.lines[0].get_data(), 1)


def test_plan_and_elevation_show_the_line(rope, axes):
    results = capstan.run(rope)
    position = results["rope"].position
    assert plots.plan(results, ax=axes) is axes
    assert np.array_equal(first_line(axes), position[-1][:, :2]) and axes.get_xlabel() == "x [m]"
    assert np.array_equal(first_line(plots.plan(results, step=2)), position[2][:, :2])
    assert np.array_equal(first_line(plots.elevation(results, step=3, along="y")), position[3][:, 1:])
    evolution = results.evolution(4)
    assert np.array_equal(first_line(plots.plan(evolution)), position[4][:, :2])
    assert plots.view_3d(results).name == "3d"
    # nodes by their state: green where they stick, red where they slip
    drawn = {line.get_label(): line.get_color() for line in axes.lines}
    assert drawn["slips"] == "tab:red"


def test_tension_friction_and_hysteresis(rope, axes):
    results = capstan.run(rope)
    assert plots.tension(results, ax=axes) is axes
    assert np.array_equal(axes.patches[0].get_data().values, results["rope"].tension[-1])
    use = np.stack(plots.friction_use(results).lines[0].get_data(), 1)
    # a rope that has been turned round rests somewhere and slips elsewhere; nothing exceeds its bound but by rounding
    assert use[:, 1].max() == pytest.approx(1, rel=1e-6) and use[:, 1].min() < 0.999
    ax = plots.hysteresis(results, "rope", direction=[1, 0, 0])
    x, force = results["rope"].end("B", "position"), results["rope"].end("B", "force")
    # from where the scene begins, without force there
    assert np.allclose(first_line(ax), np.stack([np.r_[0, x[:, 0] - 2], np.r_[0, force[:, 0]]], 1))


def test_hysteresis_begins_at_the_start():
    """Of a static start that is the first step; of a line that begins stretched, with its force; of a free end, with that given."""
    hanging = {"length": 2.1, "mass": 1, "stiffness": 1e4, "elements": 8, "start": "static", "ends": {"A": {"held": [0, 0, 0]}, "B": {"held": [2, 0, 0]}}}
    move = [{"name": "out", "rope.B": {"move": [0.01, 0, 0]}, "steps": 2}]
    results = capstan.run({"lines": {"rope": hanging}, "history": move})
    assert np.allclose(first_line(plots.hysteresis(results, "rope"))[:, 0], [0, 0.005, 0.01])
    taut = {**hanging, "length": 2.0, "start": {"straight": {"from": [0, 0, 0], "to": [2.02, 0, 0]}}, "mass": 1e-9,
            "ends": {"A": {"held": [0, 0, 0]}, "B": {"held": [2.02, 0, 0]}}}
    results = capstan.run({"lines": {"rope": taut}, "history": move})
    for end in "AB":  # EA times the strain, at both ends, outwards
        drawn = first_line(plots.hysteresis(results, "rope", end, direction=[1 if end == "B" else -1, 0, 0]))
        assert drawn[0] == pytest.approx([0, 100], rel=1e-6) and len(drawn) == 3
    pulled = {**taut, "ends": {"A": {"held": [0, 0, 0]}, "B": {"force": [100, 0, 0]}}}
    results = capstan.run({"lines": {"rope": pulled}, "history": [{"name": "more", "rope.B": {"force": [200, 0, 0]}}]})
    assert np.allclose(first_line(plots.hysteresis(results, "rope")), [[0, 100], [0.02, 200]], rtol=1e-5)


SHAPES = {
    "capsule": ({"centre": [0, 0, 0.2], "axis": [1, 0, 1], "length": 1, "radius": 0.3}, "centre"),
    "torus": ({"centre": [0.1, 0, 0], "axis": [0, 1, 1], "main_radius": 1, "radius": 0.3}, "centre"),
    "cone": ({"tip": [0, 0, 0.1], "axis": [0.1, 0, -1], "angle": 30, "radius": 0.1}, "tip"),
    "box": ({"centre": [0, 0.1, 0], "size": [1, 2, 1.5], "radius": 0.2, "rotation": {"roll_pitch_yaw": [20, 10, 30]}}, "centre"),
    "sphere": ({"centre": [0, 0, 0.1], "radius": 0.8}, "centre"),
    "cylinder": ({"point": [0, 0, 0.1], "axis": [0, 1, 0.2], "radius": 0.5}, "point"),
    "plane": ({"point": [0, 0, 0.3], "normal": [0.3, 0, 1]}, "point")}


def over(kind, shape, start=0.0):
    """A rope that is let down on an obstacle, which then moves."""
    return {"obstacles": {"it": {kind: shape, "friction": 0.3}},
            "lines": {"rope": {"length": 4, "elements": 80, "mass": 0.2, "stiffness": 1e4,
                               "start": {"straight": {"from": [-2, 0.1, 2], "to": [2, 0.1, 2]}},
                               "ends": {"A": {"held": [-2, 0.1, 2]}, "B": {"held": [2, 0.1, 2]}}}},
            "history": [{"name": "down", "rope.A": {"move": [0.7, 0, -1]}, "rope.B": {"move": [-0.7, 0, -1]}, "steps": 4},
                        {"name": "away", "it.obstacle": {"move": [0.05, 0, -0.02], "turn": 3, "axis": [0, 0, 1]}}]}


def faces(ax):
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    return np.concatenate([part._vec.T[:, :3] for part in ax.collections if isinstance(part, Poly3DCollection)])


@pytest.mark.parametrize("kind", SHAPES)
def test_obstacles_are_drawn_where_they_are(kind):
    """Nodes that touch lie on the faces, as near as these are fine; no node is deeper inside; also after a move."""
    results = capstan.run(over(kind, SHAPES[kind][0]))
    for step in (3, 4):
        corner = faces(plots.view_3d(results, step=step))
        assert len(corner) >= 4
        evolution = results.evolution(step)
        line = evolution["rope"]
        touching = (line.state[0] > 0) & (line.reaction[0] > 0)
        assert touching.any()
        # corners of the faces lie in the obstacle or on it: the plane through a node across its normal has them behind it,
        # where the obstacle is convex
        if kind != "torus":
            for x, n in zip(line.position[touching] + line.origin, line.normal[0][touching]):
                depth = (corner - x) @ n
                assert depth.max() <= 1e-9 + 1e-6 and depth.max() > -0.02


def test_ground_and_meshes_are_drawn_from_their_files(root):
    for name, obstacle in (("ridge", "ground"), ("rock", "mesh")):
        scene = capstan.Scene.read(root / f"examples/{name}.yaml")
        assert any(obstacle in shape for shape in scene["obstacles"].values())
        evolution = capstan.Evolution(scene)
        evolution.step()
        corner = faces(plots.view_3d(evolution))
        (line,) = evolution.lines.values()
        x = line.position + line.origin
        lying = x[(line.reaction > 0).any(0)]
        assert len(lying) > 5
        apart = np.linalg.norm(lying[:, None] - corner, axis=2).min(1)
        # by no more than half the diagonal of a face, and 0.3 m for the radius about the mesh, which is not drawn
        assert apart.max() < 0.5 * np.hypot(*np.ptp(corner[:4, :2], 0)) + 0.3


def test_pictures_from_the_side_leave_out_what_faces_the_viewer():
    from matplotlib.collections import PolyCollection
    results = capstan.run(over("plane", SHAPES["plane"][0]))
    drawn = [[part for part in view(results, tension=False).collections if isinstance(part, PolyCollection)] for view in (plots.plan, plots.elevation)]
    assert [len(parts) for parts in drawn] == [0, 1]
    assert not [part for part in plots.elevation(results, tension=False, obstacles=False).collections if isinstance(part, PolyCollection)]


def test_sets_are_drawn_by_their_support_points(axes):
    S = sets.disc(2) + sets.segment([0, -1], [0, 1])
    assert plots.plot_set(S, ax=axes, color="C3") is axes
    outline = first_line(axes)
    assert np.allclose(S.margin(outline), 0, atol=1e-9) and len(outline) == 721
    assert plots.plot_set(sets.ball(1)).name == "3d"


def test_animations(rope):
    from PIL import Image
    results = capstan.run(rope)
    with Image.open(plots.animate(results, "rope.gif", "plan")) as picture:
        assert picture.n_frames == len(results)


@pytest.mark.parametrize("wrong", [lambda r: plots.plan(3), lambda r: plots.elevation(r, along="z"), lambda r: plots.plot_set(sets.interval(1)),
                                   lambda r: plots.plot_set("disc"), lambda r: plots.animate(r, "a.gif", "top"), lambda r: plots.hysteresis(r, "cable")])
def test_wrong_values(rope, wrong):
    with pytest.raises((capstan.Error, KeyError)):
        wrong(capstan.run(rope))
