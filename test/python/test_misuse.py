# SPDX-License-Identifier: BSD-3-Clause
"""Wrong values to every public call: exceptions with words, no crash, and nothing changed.

The cases are generated: each argument of each call below, with each of the wrong values. At least 200 must be refused."""
import math

import numpy as np
import pytest

import capstan
from conftest import ROPE

NAN, INF = float("nan"), float("inf")

# what is no vector of three finite numbers
VECTORS = [None, "text", b"abc", "1 2 3", [1, 2], [1, 2, 3, 4], [], 1.0, [[1, 2, 3]], [NAN, 0, 0], [INF, 0, 0], [1, None, 0],
           [1, "2", 3], [1j, 0, 0], np.zeros((3, 1)), np.zeros(3, complex), np.zeros(3, object), np.zeros(3, bool),
           np.array(["a", "b", "c"]), np.full(3, NAN), {}, {"x": 1}, object(), [[1], [2, 3], 4], np.ma.masked, True,
           np.array("2020-01-01", "M8[D]"), 10**400, [10**400, 0, 0], [1e308 * 10, 0, 0]]
# what is no finite number
NUMBERS = [None, "1", [], [1], NAN, INF, -INF, 1j, {}, object(), np.zeros(1), np.zeros(2), True, b"1", 10**400]
NAMES = [None, "", "rope", "nobody.A", "rope.C", ".A", "rope.", 1, ("rope", "A"), "rope.A.B", "r\0pe.A", "rope.node9", b"rope.A"]
CHANGES = [None, {}, {"position": [0, 0, 0], "force": [0, 0, 0]}, {"place": [0, 0, 0]}, [0, 0, 0], "held", {1: [0, 0, 0]}]


def evolution():
    made = capstan.Evolution(ROPE)
    for _ in range(5):
        made.step()
    return made


def cases():
    for value in VECTORS:
        yield "end position", lambda e, v=value: e.move({"rope.B": {"position": v}})
        yield "end force", lambda e, v=value: e.move({"rope.A": {"force": v}})
        yield "node position", lambda e, v=value: e.move({"rope.node": {"at": 1, "position": v}})
        yield "velocity", lambda e, v=value: e.target({"rope.B": {"position": [6, 0, 0], "velocity": v}})
        yield "gravity", lambda e, v=value: e.move({"gravity": v})
        yield "shift", lambda e, v=value: e.move({"floor.obstacle": {"move": v}})
    for value in NUMBERS:
        yield "place of a node", lambda e, v=value: e.move({"rope.node": {"at": v, "hold": True}})
        yield "turn", lambda e, v=value: e.move({"floor.turn": v})
        yield "path tolerance", lambda e, v=value: capstan.Evolution(ROPE, path_tolerance=v) if v is not None else e.move(None)
        yield "threads", lambda e, v=value: capstan.Evolution(ROPE, threads=v) if v is not None else e.move(None)
    for name in NAMES:
        yield "name", lambda e, n=name: e.move({n: {"position": [0, 0, 0]}})
    for change in CHANGES:
        for key in ("rope.B", "rope.node", "floor.body", "knot.point"):
            yield "change", lambda e, k=key, c=change: e.move({k: c})
    for value in (None, 3, [], "rope", b"", object()):
        yield "target", lambda e, v=value: e.move(v)
        yield "state", lambda e, v=value: e.load(v)
        yield "stiffness end", lambda e, v=value: e["rope"].stiffness(end=v)
        yield "stiffness kind", lambda e, v=value: e["rope"].stiffness(kind=v)
        yield "body", lambda e, v=value: e.body_stiffness(v)
        yield "point", lambda e, v=value: e.point_stiffness(v)
        yield "line", lambda e, v=value: e[v]["rope" if v == "rope" else 0]
        yield "scene", lambda e, v=value: capstan.Evolution(v)
        yield "run", lambda e, v=value: capstan.run(v)
        yield "yaml", lambda e, v=value: capstan.Scene.from_yaml(v).check()
        yield "directory", lambda e, v=value: capstan.open(v)
    for value in (-1, 0, 10**9, 2**40):
        yield "threads", lambda e, v=value: capstan.Evolution(ROPE, threads=v)
    yield "another's target", lambda e: e.move(evolution().target({"rope.B": {"position": [0, 0, 0]}}))


CASES = list(cases())


def test_there_are_enough_cases():
    assert len(CASES) >= 200


def test_wrong_values_are_refused_and_change_nothing():
    whole = evolution()
    before, position = whole.save(), whole["rope"].position.copy()
    passed = []
    for k, (what, call) in enumerate(CASES):
        try:
            call(whole)
            passed.append(f"case {k}, {what}: was accepted")
        except (capstan.Error, TypeError, KeyError) as error:
            if not str(error):
                passed.append(f"case {k}, {what}: without words")
        except Exception as error:  # noqa: BLE001 - of what else there is, each is a fault
            passed.append(f"case {k}, {what}: {type(error).__name__}: {error}")
        if whole.save() != before:
            passed.append(f"case {k}, {what}: changed the evolution")
            whole.load(before)
    assert not passed, "\n".join(passed)
    assert np.array_equal(whole["rope"].position, position)


@pytest.mark.parametrize("good", [np.array([2.4, 0.3, 0.1]), np.array([2.4, 0, 0.3, 0, 0.1, 0])[::2], np.asfortranarray([[2.4, 0.3, 0.1]])[0],
                                  np.array([2.4, 0.3, 0.1], ">f8"), (2.4, 0.3, 0.1), [np.float64(2.4), 0.3, 0.1],
                                  np.array([0.1, 0.3, 2.4])[::-1]])
def test_any_layout_of_numbers_is_accepted(good):
    found = evolution()
    found.move({"rope.B": {"position": good}})
    assert np.array_equal(found["rope"].B.position, [2.4, 0.3, 0.1])


def test_arrays_that_cannot_be_written_to_are_accepted():
    place = np.array([2.4, 0.3, 0.1])
    place.flags.writeable = False
    evolution().move({"rope.B": {"position": place}})


def test_targets_check_what_is_written_to_them():
    found = evolution()
    target = found.target({"rope.B": {"position": [2.4, 0.3, 0.1]}})
    before = found.save()
    for wrong in (NAN, INF, -INF):
        target["rope.B"][1] = wrong
        with pytest.raises(capstan.ArgumentError):
            found.move(target)
        assert found.save() == before
    with pytest.raises((ValueError, TypeError)):
        target["rope.B"][:] = 1, 2
    with pytest.raises(KeyError):
        target["rope.A"]
    target["rope.B"][:] = 2.4, 0.3, 0.2
    assert found.move(target).outcome == "solved" and math.isclose(found["rope"].B.position[2], 0.2)
