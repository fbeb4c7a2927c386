# SPDX-License-Identifier: BSD-3-Clause
"""Derivatives by moves: against formulas, with friction there and back; the evolution is left as it was."""
import math

import numpy as np
import pytest

import capstan

FRICTION, WEIGHT, STIFFNESS = 0.4, 9.81, 1000.0  # -, N/m, N


def on_a_table(pulled):
    """A rope of 2 m on a table, its end B pulled along by so much."""
    evolution = capstan.Evolution({
        "obstacles": {"table": {"plane": {}, "friction": FRICTION}},
        "lines": {"rope": {"length": 2, "elements": 400, "mass": 1, "stiffness": STIFFNESS,
                           "start": {"straight": {"from": [0, 0, 0], "to": [2, 0, 0]}}, "ends": {"A": "free", "B": {"held": [2, 0, 0]}}}},
        "history": [{"name": "pull", "steps": 5, "rope.B": {"move": [pulled, 0, 0]}}]})
    for _ in evolution:
        assert evolution.certified
    return evolution


def force(now):
    return now["rope"].B.force[0]


@pytest.mark.parametrize("pulled", [0.002, 0.004, 0.006])
def test_with_friction_there_and_back_differ(pulled):
    evolution, step = on_a_table(pulled), 1e-4
    state = evolution.save()
    found = capstan.derivative(evolution, {"rope.B": {"position": [2 + pulled, 0, 0]}}, force, step=step,
                               directions=[[1, 0, 0]])
    assert evolution.save() == state
    # F = sqrt(2 mu w EA u) on the way out, and 2 sqrt(mu w EA h) less on the way back by h; the front lies in an element of
    # 5 mm, whose friction of half a weight is 1 % of the force of the smallest pull
    spring = FRICTION * WEIGHT * STIFFNESS
    forth = (math.sqrt(2 * spring * (pulled + step)) - math.sqrt(2 * spring * pulled)) / step
    back = 2 * math.sqrt(spring * step) / step
    assert abs(found.forth[0] / forth - 1) < 1e-2 and abs(found.back[0] / back - 1) < 1e-2
    assert found.forth[0] < 0.5 * found.back[0] and found.mean[0] == 0.5 * (found.forth[0] + found.back[0])


@pytest.mark.parametrize("kind, value, expected", [
    ("gravity", [0, 0, -9.81], [0, 0, -1.5]),                 # what hangs: m L g, upwards at A
    ("rope.B", {"force": [0, 0, -20]}, [0, 0, -1])])          # what pulls below pulls above
def test_what_a_hanging_rope_carries(kind, value, expected):
    evolution = capstan.Evolution({"lines": {"rope": {
        "length": 3, "mass": 0.5, "stiffness": 1e5, "elements": 7, "start": {"straight": {"from": [1, 2, 3], "to": [1, 2, 0]}},
        "ends": {"A": {"held": [1, 2, 3]}, "B": "free"}}}, "history": [{"name": "load", "rope.B": {"force": [0, 0, -20]}}]})
    evolution.step()
    found = capstan.derivative(evolution, {kind: value}, lambda now: now["rope"].A.force, step=1e-3)
    assert found.forth.shape == found.back.shape == (3, 3)
    assert np.allclose(found.mean[2], expected, atol=1e-6)


def test_numbers_and_arrays():
    evolution = on_a_table(0.002)
    change = {"rope.B": {"position": [2.002, 0, 0]}}
    flat = [[1, 0, 0], [0, 1, 0]]
    assert capstan.derivative(evolution, change, force, step=1e-5, directions=flat).forth.shape == (2,)
    places = capstan.derivative(evolution, change, lambda now: now["rope"].position, step=1e-5, directions=flat).back
    assert places.shape == (2, 401, 3) and np.allclose(places[:, -1], flat, atol=1e-9)
    with pytest.raises(capstan.ArgumentError, match="below obstacle 'table'"):
        capstan.derivative(evolution, change, force, step=1e-5)
    with pytest.raises(capstan.ArgumentError, match="directions"):
        capstan.derivative(evolution, change, force, step=1e-5, directions=[1, 0])


@pytest.mark.parametrize("change, step, words", [
    ({"rope.B": {"position": [2, 0, 0]}}, 0, "more than 0"), ({"rope.B": {"position": [2, 0, 0]}}, -1e-3, "more than 0"),
    ({"rope.B": {"position": [2, 0, 0]}}, math.nan, "finite"), ({"rope.B": {"position": [2, 0, 0]}}, None, "a number"),
    ({}, 1e-3, "one vector"), ({"rope.B": {"position": [2, 0, 0]}, "gravity": [0, 0, -9]}, 1e-3, "one vector"),
    ({"rope.C": {"position": [2, 0, 0]}}, 1e-3, "rope.C"), (None, 1e-3, "dictionary")])
def test_nonsense_is_refused(change, step, words):
    evolution = on_a_table(0.002)
    state = evolution.save()
    with pytest.raises(capstan.ArgumentError, match=words):
        capstan.derivative(evolution, change, force, step=step)
    assert evolution.save() == state


def test_a_place_that_cannot_be_reached_and_a_measure_that_fails():
    evolution = capstan.Evolution({"lines": {"rope": {
        "length": 2, "mass": 1, "stiffness": math.inf, "elements": 8, "start": "static",
        "ends": {"A": {"held": [0, 0, 0]}, "B": {"held": [1.99, 0, 0]}}}}})
    evolution.step()
    state = evolution.save()
    with pytest.raises(capstan.NoAnswer) as found:
        capstan.derivative(evolution, {"rope.B": {"position": [1.99, 0, 0]}}, force, step=0.1)
    assert found.value.outcome == "infeasible" and evolution.save() == state
    with pytest.raises(ZeroDivisionError):
        capstan.derivative(evolution, {"rope.B": {"position": [1.99, 0, 0]}}, lambda now: 1 / 0, step=1e-3)
    assert evolution.save() == state
