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
    # displacements are from where the end was before the first step
    begin = capstan.Evolution(rope)["rope"].position[-1, 0]
    assert abs(x[0, 0] - begin) > 0.05
    assert np.allclose(first_line(ax), np.stack([x[:, 0] - begin, force[:, 0]], 1))


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
