# SPDX-License-Identifier: BSD-3-Clause
"""Bodies on a plane: closed forms by hand, ledgers, and what is refused; systems along a path, and all their solutions."""
import math

import numpy as np
import pytest

import capstan
from capstan import planar
from capstan.planar import Patch, PlanarBody, Sweep, Tow, moved, planimeter, rope
from capstan.sets import box, disc, interval

rng = np.random.default_rng(7)


def body():
    return PlanarBody([Patch("rod", friction=0.4, load=10, size=0.5, angle=30, position=[0.2, 0.1]), Patch("point", friction=0.2, load=5, position=[-1, 0]),
                       Patch("polygon", friction=0.3, load=8, corners=[[0, 0], [1, 0], [0, 1]], tilt=[0.1, 0]),
                       Patch("wheel", friction=0.5, load=6, size=0.3, brake=0.2, angle=90), Patch("ring", friction=0.1, load=3, size=0.2)])


def test_dissipation_by_hand():
    # a rod of half length a, turned about its middle: mu N a/2; moved: mu N v. A point: mu N |v + w x r|
    rod, point = PlanarBody([Patch("rod", friction=0.4, load=10, size=0.5)]), PlanarBody([Patch("point", friction=0.2, load=5, position=[3, 4])])
    assert rod.dissipation([0, 0, 2]) == pytest.approx(0.4 * 10 * 0.25 * 2, rel=1e-12)
    v = rng.normal(size=(3, 5, 3))
    expected = np.hypot(v[..., 0] - 4 * v[..., 2], v[..., 1] + 3 * v[..., 2])
    assert point.dissipation(v) == pytest.approx(expected, rel=1e-12) and point.wrench(v).shape == (3, 5, 3)
    # degrees: a rod along y that moves along itself, or turned by 90 degrees, is the same
    turned = PlanarBody([Patch("rod", friction=0.4, load=10, size=0.5, angle=90, position=[1, 0])])
    assert turned.dissipation([0, 1, 1]) == pytest.approx(rod.dissipation([2, 0, -1]), rel=1e-12)


def test_wrenches_dissipate_what_they_say_and_obey_the_law():
    whole = body()
    assert len(whole) == 5
    for v in rng.normal(size=(20, 3)):
        wrench, power = whole.wrench(v), whole.dissipation(v)
        assert -(wrench @ v) == pytest.approx(power, rel=1e-9) and whole.by_patch(v).sum() == pytest.approx(power, rel=1e-9)
        # no other twist takes less power from it than its own dissipation: the wrench is in the set
        for other in rng.normal(size=(20, 3)):
            assert -(wrench @ other) <= whole.dissipation(other) * (1 + 1e-9)
        bounds = whole.bounds(v, 1e-3)
        assert bounds.lower <= power <= bounds.upper and bounds.upper - bounds.lower <= 1e-3 * bounds.upper
    inner, outer = whole.law("inner", 50), whole.law("outer", 50)
    v = rng.normal(size=(10, 3))
    assert (inner.dissipation(v) <= whole.dissipation(v) * (1 + 1e-6)).all() and (whole.dissipation(v) <= outer.dissipation(v) * (1 + 1e-6)).all()


def test_a_braked_wheel_of_a_body():
    """Rolling, the contact gives way only as far as the brake holds: b/r < mu N."""
    wheel = PlanarBody([Patch("wheel", friction=0.5, load=6, size=0.3, brake=0.2)])
    assert wheel.dissipation([1, 0, 0]) == pytest.approx(0.2 / 0.3, rel=1e-9)
    assert wheel.dissipation([0, 1, 0]) == pytest.approx(3, rel=1e-9)
    found = wheel.wheel(0, [1, 0, 0])
    assert found.ground == pytest.approx(0, abs=1e-9) and found.brake == pytest.approx(0.2 / 0.3, rel=1e-9)
    assert found.spin == pytest.approx(-1 / 0.3, rel=1e-9)
    system = wheel.system()
    system.drive([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]])
    assert system.solve([1, 0, 0]).value == pytest.approx(0.2 / 0.3, rel=1e-7)


def test_driven_bodies():
    two = PlanarBody([Patch("point", friction=1, load=1, position=[0, y]) for y in (-1, 1)])
    # a push along x beside the middle turns it; through one of the feet it turns about the other
    motion = two.drive([[1, 0, -1]], [1])
    assert motion.outcome == "answered" and motion.lower <= motion.upper and motion.upper == pytest.approx(1, rel=1e-6)
    low, high = two.motions([[1, 0, -1]], [1])
    assert (low <= motion.twist + 1e-4).all() and (motion.twist <= high + 1e-4).all()
    pose = moved([1, 2, math.pi / 2], [0.5, 0, 0])
    assert pose == pytest.approx([1, 2.5, math.pi / 2])


def test_towing_and_sweeping_close_their_ledgers():
    one = PlanarBody([Patch("disc", friction=0.3, load=20, size=0.4)])
    tow = Tow(one, hitch=[0.5, 0.1], rope=1.0, end=[1.5, 0.1])
    work = 0.0
    for k in range(40):
        step = tow.step([1.5 + 0.02 * k, 0.1 + 0.01 * k])
        assert step.outcome == "answered" and step.lower <= step.dissipated * (1 + 1e-6)
        work += step.work
    assert tow.work == pytest.approx(work, rel=1e-12) and tow.dissipated == pytest.approx(work, rel=2e-3)
    block = Sweep(capstan.Law(disc(2.0)), stiffness=10.0)
    for angle in np.linspace(0, 2 * np.pi, 50):
        step = block.step([math.sin(angle), 1 - math.cos(angle)])
        assert np.hypot(*step.force[:2]) <= 2 * (1 + 1e-9)
        assert step.force[:2] == pytest.approx(10 * (block.position[:2] - block.end[:2]), abs=1e-9)


def test_planimeters_measure_areas():
    corners = np.array([[0.2, 0.1], [0.5, 0.1], [0.4, 0.4], [0.25, 0.45]])
    area = 0.5 * abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(corners, np.roll(corners, -1, 0))))
    for elbow in (False, True):
        found = planimeter(corners, pole_arm=0.5, tracer_arm=0.4, wheel=0.1, friction=0.3, load=1, left_elbow=elbow, steps=400)
        assert found.exact == pytest.approx(area, rel=1e-12) and found.area == pytest.approx(area, rel=1e-5)


def test_ropes_on_a_table():
    bent = rope([[0, 0], [1, 0], [1, 1]], 3.0, driven=(True, True))
    motion = bent.solve([1, 0, 1, 0])
    assert motion.outcome == "solved" and motion.value <= 6 * (1 + 1e-9)
    slack = rope([[0, 0], [1, 0]], 3.0, slack=True)
    assert slack.solve([-1, 0]).value == pytest.approx(1.5, rel=1e-6)  # the last node alone moves
    assert rope([[0, 0], [1, 0]], 3.0).solve([-1, 0]).value == pytest.approx(3, rel=1e-6)


def wheel_system():
    system = capstan.System(3)
    system.add(capstan.Law(interval(60)), [[1, 0, 0]], "brake")
    system.add(capstan.Law(disc(500)), [[0, 1, 0], [0, 0, 1]], "ground")
    system.drive([[0, 1, 0], [-0.3, 0, 1]])
    return system


def test_systems_along_a_path():
    system = wheel_system()
    driving = np.array([[0, 1], [1, 0], [0.3, -0.4]])
    steps, travel = system.drive_path([1, 2, 0.5], driving)
    single = [system.solve(w) for w in driving]
    assert [step.outcome for step in steps] == ["solved"] * 3 and travel.shape == (3, 3)
    for step, motion, h in zip(steps, single, (1, 2, 0.5)):
        assert step.dissipated == pytest.approx(h * motion.value, rel=1e-7) and abs(step.imbalance) < 1e-6
    assert travel[-1] == pytest.approx(sum(h * motion.velocity for h, motion in zip((1, 2, 0.5), single)), abs=1e-6)


def test_all_solutions_of_a_system():
    # two equal brakes beside each other: only their sum is known, and each lies within its bound
    system = capstan.System(2)
    for k in (0, 1):
        system.add(capstan.Law(interval(1)), np.eye(2)[[k]], f"brake {k}")
    system.restrict([[1, 1]])
    system.drive([[1, 0]])
    motion = system.solve([1], tolerance=1e-9)
    assert motion.velocity == pytest.approx([1, 1]) and motion.value == pytest.approx(2, rel=1e-8) and motion.continuous is True
    assert motion.shares["brake 1"].dissipated == pytest.approx(1, rel=1e-8)
    velocities, forces = motion.all_velocities(), motion.all_forces()
    assert velocities.report.unique and velocities.low == pytest.approx([1, 1], abs=1e-4)
    assert forces.report.unique and forces.set.space == 2 and motion.all_resistances().low == pytest.approx(motion.resistance, abs=1e-4)
    still = system.solve([0])
    loose = still.all_forces()
    assert not loose.report.unique and loose.low == pytest.approx([-1, -1], abs=1e-4) and loose.high == pytest.approx([1, 1], abs=1e-4)
    assert np.all(still.direction == 0) and motion.constraint_forces.shape == (1,)


NAN = float("nan")
WRONG = [None, "text", b"1", [], [1], [1, 2, 3, 4, 5], {}, object(), NAN, [NAN, 0, 0], [1j, 0, 0], np.zeros((2, 2, 2)), True, 10**400, [[1, 2], [3]]]
CALLS = {
    "kind": lambda v: Patch(v), "position": lambda v: Patch("point", position=v), "angle": lambda v: Patch("rod", size=1, angle=v),
    "friction": lambda v: Patch("point", friction=v), "load": lambda v: Patch("point", load=v), "size": lambda v: Patch("disc", size=v),
    "tilt": lambda v: Patch("disc", size=1, tilt=v), "corners": lambda v: Patch("polygon", corners=v) if v is not None else Patch(v),
    "law": lambda v: Patch("point", law=v) if v is not None else Patch(v), "brake": lambda v: Patch("wheel", size=1, brake=v),
    "patches": lambda v: PlanarBody(v), "twist": lambda v: body().dissipation(v), "wrench": lambda v: body().wrench(v),
    "bounds": lambda v: body().bounds(v), "tolerance": lambda v: body().bounds([1, 0, 0], v), "side": lambda v: body().law(v),
    "cells": lambda v: body().law("inner", v), "wheel": lambda v: body().wheel(v, [1, 0, 0]), "matrix": lambda v: body().drive(v, [1]),
    "velocity": lambda v: body().drive([[1, 0, 0], [0, 1, 0]], v), "pose": lambda v: moved(v, [0, 0, 0]), "increment": lambda v: moved([0, 0, 0], v),
    "body": lambda v: Tow(v), "hitch": lambda v: Tow(body(), hitch=v), "rope": lambda v: Tow(body(), rope=v), "target": lambda v: Tow(body()).step(v),
    "swept law": lambda v: Sweep(v, stiffness=1), "stiffness": lambda v: Sweep(capstan.Law(disc(1)), stiffness=v),
    "end": lambda v: Sweep(capstan.Law(disc(1)), stiffness=1).step(v), "points": lambda v: planimeter(v, pole_arm=1, tracer_arm=1, friction=1, load=1),
    "pole_arm": lambda v: planimeter([[0.2, 0], [0.4, 0], [0.4, 0.2]], pole_arm=v, tracer_arm=1, friction=1, load=1), "nodes": lambda v: rope(v, 1),
    "resistance": lambda v: rope([[0, 0], [1, 0]], v), "driven": lambda v: rope([[0, 0], [1, 0]], 1, driven=v),
    "path": lambda v: wheel_system().drive_path(v, [[0, 1]] * 7), "driving": lambda v: wheel_system().drive_path([1], v),
    "options": lambda v: wheel_system().solve([0, 1], tolerance=v), "spanning": lambda v: wheel_system().restrict(v)}


def test_wrong_values_are_refused():
    passed, count = [], 0
    for what, call in CALLS.items():
        for k, value in enumerate(WRONG):
            count += 1
            try:
                call(value)
                passed.append(f"{what}: {value!r} was accepted")
            except (capstan.Error, TypeError, KeyError) as error:
                if not str(error):
                    passed.append(f"{what}: {value!r}: without words")
            except Exception as error:  # noqa: BLE001 - of what else there is, each is a fault
                passed.append(f"{what}: {value!r}: {type(error).__name__}: {error}")
    assert count > 500 and not passed, "\n".join(passed)


def test_bodies_outlive_what_they_were_made_of():
    import gc
    law = capstan.Law(box([1, 2]))
    made = PlanarBody([Patch("point", law=law), Patch("polygon", friction=1, load=1, corners=np.array([[0, 0], [1, 0], [0, 1.0]]))])
    before = made.dissipation([1, 1, 0])
    del law
    gc.collect()
    assert made.dissipation([1, 1, 0]) == before
    assert planar.__doc__
