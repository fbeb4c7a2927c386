# SPDX-License-Identifier: BSD-3-Clause
"""Sets, laws and systems: operators against what they mean, arrays against single questions, and against the command."""
import gc
import json
import math
import subprocess
import threading

import numpy as np
import pytest

import capstan
from capstan import laws, sets
from capstan.sets import ball, box, disc, ellipse, friction_cone, half_space, interval, polytope, rays, segment, strip
from conftest import ROOT

RANDOM = np.random.default_rng(19)
W = RANDOM.normal(size=(7, 40, 2))  # directions of the plane, in an array of more than one dimension
# rounding of sums of a few terms
CLOSE = dict(rtol=1e-12, atol=1e-12)
# what conic programs promise, docs/sets.md: 1e-9 of the size of the data
CONIC = dict(rtol=0, atol=1e-8)


def norm(x):
    return np.linalg.norm(x, axis=-1)


def test_operators_mean_what_they_say():
    """By support functions: h(A + B) = h(A) + h(B), h(L A) = h(A) o L', h of a hull the larger one, .."""
    A, B = disc(2), segment([0, -1], [0.5, 1])
    hA = 2 * norm(W)
    hB = np.maximum(W @ [0, -1], W @ [0.5, 1])
    L = np.array([[1.0, 2], [0, 3], [-1, 0.5]])
    W3 = RANDOM.normal(size=(30, 3))
    assert np.allclose(A.support(W), hA, **CLOSE) and np.allclose(B.support(W), hB, **CLOSE)
    assert np.allclose((A + B).support(W), hA + hB, **CLOSE)
    assert np.allclose((A | B).support(W), np.maximum(hA, hB), **CONIC)
    assert np.allclose((L @ B).support(W3), B.support(W3 @ L), **CLOSE)
    assert np.allclose((A + [3, 4]).support(W), hA + W @ [3, 4], **CLOSE)
    assert np.allclose(([3, 4] + A - [3, 4]).support(W), hA, **CLOSE)
    assert np.allclose((-B).support(W), B.support(-W), **CLOSE)
    assert np.allclose((2.5 * B).support(W), 2.5 * hB, **CLOSE) and np.allclose((B * 2.5).support(W), 2.5 * hB, **CLOSE)
    assert np.allclose((interval(-1, 3) * interval(2)).support(W), box([-1, -2], [3, 2]).support(W), **CLOSE)
    assert np.allclose((disc(1) & half_space([1, 0], 0)).support([[1, 0], [0, 1], [-1, 0]]), [0, 1, 1], **CONIC)
    assert np.allclose(disc(2).polar().support(W), norm(W) / 2, **CONIC)
    assert np.allclose(box([1, 1]).preimage([[2, 0], [0, 4]]).support(W), np.abs(W) @ [0.5, 0.25], **CONIC)
    assert np.allclose(box([1, 1]).preimage([[1, 0], [0, 1]], [0.5, 0]).support([1, 0]), 0.5, **CONIC)
    for whole, parts in ((sets.minkowski_sum(A, B), A + B), (sets.product(A, B), A * B), (sets.hull(A, B), A | B),
                         (sets.intersection(A, B), A & B)):
        assert str(whole) == str(parts)


def test_primitives():
    assert np.allclose(ellipse(3, 0.5).support(W), norm(W * [3, 0.5]), **CLOSE)
    assert np.allclose(sets.ellipsoid([[9, 0], [0, 0.25]]).support(W), norm(W * [3, 0.5]), **CLOSE)
    assert np.allclose(polytope([[0, 0], [2, 0], [0, 1]]).support(W), np.max(W @ np.array([[0, 0], [2, 0], [0, 1]]).T, -1), **CLOSE)
    assert interval(2).extent([1]) == (-2, 2) and interval(-math.inf, 3).extent([1]) == (-math.inf, 3)
    assert strip([0, 2], 8).extent([0, 1]) == (-2, 2)
    assert half_space([0, 1], 3).support([0, 1]) == 3 and half_space([0, 1], 3).support([1, 0]) == math.inf
    assert ball(2, 4).support([0, 0, 0, 3]) == 6 and ball(1).space == 3
    assert np.allclose(sets.subspace([[1, 1]]).project([2, 0]), [1, 1], **CLOSE)
    assert np.allclose(sets.point([1, 2]).project([5, 5]), [1, 2], **CLOSE)
    assert sets.inequalities([[1, 0], [-1, 0], [0, 1], [0, -1]], [1, 1, 2, 2]).measure().area == pytest.approx(8)
    assert len(rays([[1, 0], [1, 1]]).rays()) == 2
    cone = friction_cone(0.5)
    assert cone.margin([0, 0, 1]) > 0 > cone.margin([1, 0, 1])


def test_arrays_are_many_single_questions():
    S = (disc(2) + segment([0, -1], [0, 1])) & half_space([1, 1], 1.5)
    x = RANDOM.normal(size=(3, 5, 2)) * 3
    for question in ("support", "support_point", "project", "margin"):
        whole = getattr(S, question)(x)
        assert whole.shape[:2] == (3, 5)
        for i in range(3):
            for j in range(5):
                assert np.array_equal(whole[i, j], getattr(S, question)(x[i, j]))
    # any layout gives the same
    assert np.array_equal(S.support(np.asfortranarray(x)), S.support(x))
    assert np.array_equal(S.support(x[::-1, ::2]), S.support(x)[::-1, ::2])
    assert S.support(np.empty((0, 2))).shape == (0,)
    assert isinstance(S.support([1, 0]), float)


def test_projections_are_nearest():
    """By the variational inequality <x - p, q - p> <= 0 for points q of the set."""
    S = ellipse(3, 1) + segment([0, 0], [1, 1])
    x = RANDOM.normal(size=(50, 2)) * 5
    p, q = S.project(x), S.support_point(W.reshape(-1, 2))
    assert (np.einsum("ik,ijk->ij", x - p, q[None] - p[:, None]) <= 1e-6).all()
    assert np.allclose(np.maximum(-S.margin(x), 0), norm(x - p), atol=1e-7)
    # in a metric: the nearest point of a half-space in M is x - M^-1 n <..>
    M = np.array([[2, 0.5], [0.5, 1]])
    y = half_space([1, 0], 0).project([[1, 1], [2, 0]], metric=M)
    step = np.linalg.solve(M, [1, 0])
    assert np.allclose(y, np.array([[1, 1], [2, 0]]) - np.outer([1, 2], step / step[0]), atol=1e-8)


def test_faces_cones_facts_and_measures():
    S = box([1, 2])
    assert np.allclose(sorted(S.face([1, 0]).vertices().tolist()), [[1, -2], [1, 2]])
    faces = S.face([[1, 0], [1, 1], [0, 0]])
    assert [face.facts().dimension for face in faces] == [1, 0, 2]
    assert sorted(S.normal_cone([1, 2]).rays().round(9).tolist()) == [[0, 1], [1, 0]]
    assert S.measure().area == 8 and S.measure().exact and S.facts().bounded and S.facts().zero_interior
    assert np.allclose(S.gauge([[2, 0], [0, 1]]), [2, 0.5], **CLOSE)
    assert polytope(np.stack([np.cos(np.arange(40)), np.sin(np.arange(40))], 1)).vertices().shape == (40, 2)


def test_no_answer_says_why():
    with pytest.raises(capstan.NoAnswer) as found:
        half_space([1, 0], 1).measure()
    assert found.value.outcome == "unbounded"
    with pytest.raises(capstan.NoAnswer) as found:
        (disc(1) & (disc(1) + [5, 0])).project([0, 0])
    assert found.value.outcome == "empty"
    with pytest.raises(capstan.NoAnswer) as found:
        disc(1).normal_cone([5, 0])
    assert found.value.outcome == "outside"
    with pytest.raises(capstan.NoAnswer):
        (disc(1) + [5, 0]).gauge([[0, 1], [1, 0]])
    assert (disc(1) & (disc(1) + [5, 0])).support([1, 0]) == -math.inf


BAD = [lambda: disc(-1), lambda: disc(None), lambda: disc("1"), lambda: disc(math.nan), lambda: ball(1, 0), lambda: box([[1]]),
       lambda: box([1, math.nan]), lambda: interval(3, 1), lambda: segment([0, 0], [1]), lambda: polytope([]), lambda: polytope([1, 2]),
       lambda: disc(1) + "x", lambda: disc(1) + [1, 2, 3], lambda: disc(1) + ball(1),
       lambda: disc(1) & None, lambda: disc(1) | 3, lambda: disc(1) * None, lambda: [[1, 2, 3]] @ disc(1), lambda: None @ disc(1),
       lambda: disc(1).support([1, 2, 3]), lambda: disc(1).support(1), lambda: disc(1).support([math.inf, 0]), lambda: disc(1).support(None),
       lambda: disc(1).project([[1, None]]), lambda: disc(1).project([1, 1], metric=[[1, 0]]), lambda: disc(1).project([1, 1], metric=-np.eye(2)),
       lambda: disc(1).face([1, 0], tolerance=7), lambda: disc(1).face([1, 0], tolerance=None), lambda: sets.ellipsoid([[1, 2]]),
       lambda: sets.ellipsoid([[1, 2], [0, 1]]), lambda: half_space([0, 0], 1), lambda: sets.inequalities([[1, 0]], [1, 2]), lambda: ellipse(0, 1),
       lambda: disc(1).preimage([[1, 2, 3]]), lambda: sets.product(), lambda: sets.hull(1, 2), lambda: capstan.Law(disc(1) + [5, 0]),
       lambda: capstan.Law(None), lambda: capstan.Law(disc(1), load=[1]), lambda: laws.coulomb(-1, 1), lambda: laws.contacts([]),
       lambda: laws.viscous([[1, 2]]), lambda: laws.viscous([[0, 1], [0, 0]]), lambda: laws.viscous([[-1]]), lambda: laws.dry(disc(1)),
       lambda: laws.power(capstan.Law(disc(1)), 0.5), lambda: laws.table(capstan.Law(disc(1)), [[0, 2], [1, 1]]),
       lambda: capstan.Law.from_yaml("capstan: 1\nlaw: {disk: 1}\n"), lambda: capstan.Law.from_yaml(None), lambda: capstan.Law.read("nowhere.yaml"),
       lambda: capstan.System(0), lambda: capstan.System("2"), lambda: capstan.System(2).add(disc(1), np.eye(2)),
       lambda: capstan.System(2).add(capstan.Law(disc(1)), [[1, 0]]), lambda: capstan.System(2).drive([1, 2]), lambda: capstan.System(2).load([1]),
       lambda: capstan.System(1).solve([1]), lambda: capstan.Law(disc(1)) * disc(1), lambda: capstan.Law(disc(1), [0.1, 0]).preimage([[1], [0]])]


@pytest.mark.parametrize("bad", BAD)
def test_wrong_values_are_refused(bad):
    with pytest.raises((capstan.Error, TypeError)) as found:
        bad()
    assert str(found.value)


def test_sets_outlive_what_they_are_made_of():
    whole = disc(1)
    for _ in range(200):
        whole = whole + segment([0, 0], [0.01, 0])
    face = whole.face([0, 1])
    expected = whole.support([1, 0])
    gc.collect()
    assert expected == pytest.approx(3) and face.support([1, 0]) == pytest.approx(2)
    law = laws.coulomb(0.5, 10)
    forces = law.set
    del law
    gc.collect()
    assert forces.support([1, 0]) == 5


def test_threads_share_a_set():
    S, x, found = disc(1) & half_space([1, 1], 0.5), RANDOM.normal(size=(500, 2)), []
    expected = S.support(x)
    threads = [threading.Thread(target=lambda: found.append(np.array_equal(S.support(x), expected))) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [True] * 6


# ---- laws ----

def test_laws():
    ground = laws.coulomb(0.5, 1000)
    v = RANDOM.normal(size=(20, 2))
    assert np.allclose(ground.dissipation(v), 500 * norm(v), **CLOSE)
    assert np.allclose(ground.force(v), -500 * v / norm(v)[:, None], **CLOSE)
    assert ground.residual([-500, 0], [1, 0]).dissipation == 0 and ground.residual([0, 0], [1, 0]).dissipation == 500
    assert ground.velocities([-500, 0]).rays().tolist() == [[1, 0]]
    assert ground.forces([0, 0]).measure().area == pytest.approx(math.pi * 500**2)
    wheel = (capstan.Law(interval(60)) * ground).preimage([[0, -0.3], [1, 0], [0, 1]])
    assert wheel.composition == "interior" and wheel.dissipation([0, 1]) == pytest.approx(200)
    loaded = capstan.Law(disc(1), load=[3, 0])
    assert loaded.dissipation([1, 0]) == -2 and loaded.set.facts().has_zero is False
    body = laws.contacts([([[1, 0, 0], [0, 1, 1]], ground), ([[1, 0, 0], [0, 1, -1]], ground)])
    assert body.dissipation([0, 0, 1]) == pytest.approx(1000)
    assert capstan.Law.unit_load(box([0.2, 0.3]), 10).dissipation([1, 1]) == pytest.approx(5)


def test_resistances():
    law = laws.dry(capstan.Law(disc(2))) + laws.viscous(3 * np.eye(2)) + laws.power(capstan.Law(disc(1)), 3, 6)
    # phi = 2 v + 3 v^2 / 2 + 6 v^3 / 3
    assert law.potential([2, 0]) == pytest.approx(4 + 6 + 16) and law.power([0, 2]) == pytest.approx(4 + 12 + 48)
    assert np.allclose(law.forces([2, 0]).support_point([1, 0]), [-(2 + 6 + 24), 0])
    assert np.allclose(law.velocities([-32, 0]).support_point([1, 0]), [2, 0], atol=1e-6)
    table = laws.table(capstan.Law(disc(1)), [[0, 1], [1, 3]])
    assert table.power([0.5, 0]) == pytest.approx(0.5 * 2)


def answers(command, *arguments):
    return json.loads(subprocess.run([command, *arguments, "--json"], capture_output=True, text=True, check=True).stdout)


@pytest.mark.parametrize("path", sorted((ROOT / "examples/laws").glob("*.yaml")), ids=lambda path: path.stem)
def test_law_files_give_the_answers_of_the_command(path, command):
    law = capstan.Law.read(path)
    n = law.space
    velocities = RANDOM.normal(size=(4, n)).round(3)
    asked = [word for v in velocities for word in ("--velocity", ",".join(map(str, v)))]
    found = answers(command, "law", str(path), *asked)
    assert found["components"] == n
    for v, answer in zip(velocities, found["answers"]):
        power = law.dissipation(v) if isinstance(law, capstan.Law) else law.power(v)
        assert answer["dissipation_W"] == (power if math.isfinite(power) else None), path.stem
    again = capstan.Law.from_yaml(path.read_text())
    assert type(again) is type(law) and again.space == n


# ---- systems ----

def wheel():
    system = capstan.System(3)
    system.add(capstan.Law(interval(60)), [[1, 0, 0]], "brake")
    system.add(capstan.Law(disc(500)), [[0, 1, 0], [0, 0, 1]], "ground")
    system.drive([[0, 1, 0], [-0.3, 0, 1]])
    return system


def test_a_system_gives_the_motions_of_the_command(command):
    found = answers(command, "drive", str(ROOT / "examples/drive/braked-wheel.yaml"))
    system = wheel()
    assert system.laws == ["brake", "ground"]
    for answer in found["answers"] if "answers" in found else found["motions"]:
        w = answer.get("driving", answer.get("velocity"))
        w = list(w.values()) if isinstance(w, dict) else w
        motion = system.solve(w)
        assert motion.outcome == "solved" and motion.report.lower <= motion.value <= motion.report.upper
        assert motion.value == answer["gamma_W"]
        # the device feels what the laws do: power in = power dissipated
        assert -np.dot(w, motion.resistance) == pytest.approx(motion.value, rel=1e-9)
        assert np.allclose(motion.velocities["brake"], motion.velocity[:1]) and motion.forces["ground"].shape == (2,)


def test_elimination_is_the_law_that_is_written_down():
    law = wheel().eliminate()
    other = capstan.Law.read(ROOT / "examples/laws/braked-wheel.yaml")
    assert law.composition == other.composition == "interior"
    assert np.allclose(law.dissipation(W), other.dissipation(W), rtol=1e-9)
    assert np.allclose(wheel().forces().support(W), law.set.support(W), rtol=1e-9)


def test_a_solved_system_stays_as_it_is():
    system = wheel()
    motion = system.solve([0, 1])
    with pytest.raises(capstan.ArgumentError, match="solved"):
        system.load([1, 0, 0])
    velocity = motion.velocity
    del system, motion
    gc.collect()
    assert velocity[0] == pytest.approx(-10 / 3)


# ---- sets in scenes ----

def test_a_set_is_friction_of_a_scene(rope):
    scene = capstan.Scene.from_yaml(rope)
    by_word = scene.copy()
    by_word["obstacles"]["floor"]["friction"] = {"set": {"sum": [{"disc": 0.3}, {"segment": [[0, -0.1], [0, 0.2]]}]}}
    scene["obstacles"]["floor"]["friction"] = capstan.Friction(set=disc(0.3) + segment([0, -0.1], [0, 0.2]))
    one, two = capstan.run(scene), capstan.run(by_word)
    assert np.array_equal(one["rope"].tension, two["rope"].tension) and one.certified
    with pytest.raises(capstan.ArgumentError, match="no words"):
        capstan.Friction(set=disc(1).face([1, 0])).to_tree()


@pytest.mark.parametrize("made", [disc(2), ball(1, 3), ellipse(1, 2), box([1, 2]), interval(2), segment([0, -1], [0, 3]), polytope([[0, 0], [1, 0], [0, 1]]),
                                  strip([1, 2], 3), disc(1) + [1, 0] + disc(2), -disc(1), (disc(1) * interval(1)), disc(1) & box([1, 1]),
                                  disc(1) | segment([0, 0], [2, 2]), np.eye(2) @ disc(1), disc(1).preimage([[1, 2], [0, 1]]), disc(2).polar(),
                                  sets.ellipsoid([[2, 1], [1, 2]]), sets.point([0, 0]), friction_cone(0.3, 2)], ids=str)
def test_words_are_read_back_as_the_same_set(made):
    back = capstan.Law.from_yaml(capstan.Scene.from_dict({"law": made}).to_yaml())
    w = RANDOM.normal(size=(20, made.space))
    assert np.allclose(back.set.support(w), made.support(w), rtol=1e-9, equal_nan=False)
