# SPDX-License-Identifier: BSD-3-Clause
"""Steps, moves, states, views and their lifetime, threads, forks and signals."""
import gc
import math
import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import capstan

MOORED = {
    "water_density": 1025,
    "obstacles": {"bed": {"plane": {"point": [0, 0, -50]}, "friction": 0.6}, "drum": {"cylinder": {
        "point": [500, 0, 0], "radius": 1}}},
    "bodies": {"float": {"held": [0, 0, 0], "weight": 1e5, "buoyancy": 1.2e5}},
    "points": {"eye": {"body": "float", "at": [0, 0, -1]}, "knot": {"free": [40, 0, -30], "weight": 500}},
    "lines": {
        "upper": {"length": 50, "elements": 10, "mass": 40, "stiffness": 1e8, "start": "static",
                  "ends": {"A": {"point": "knot"}, "B": {"point": "eye"}}},
        "lower": {"length": 40, "elements": 12, "mass": 20, "stiffness": 1e8, "start": "static",
                  "ends": {"A": {"held": [70, 0, -50]}, "B": {"point": "knot"}}}},
}


def test_reports_are_values_with_words_and_gaps(rope):
    evolution = capstan.Evolution(rope)
    assert evolution.step_count == 8 and evolution.remaining == 8 and not evolution.certified
    report = evolution.step()
    assert (report.name, report.outcome, report.step_count) == ("pull 1/5", "solved", 1)
    assert evolution.certified and 0 <= report.certificate.gap <= 1e-8 * report.certificate.scale
    line = evolution["rope"].report
    assert line.places in ("unique", "nearest") and line.utilisation is None
    before = line.end[1].tension
    assert evolution["rope"].B.tension == before and len(list(evolution)) == 7
    # a report is a copy: it does not change with later steps
    assert line.end[1].tension == before != evolution["rope"].B.tension and report.name == "pull 1/5"
    assert "outcome='solved'" in repr(report) and report.to_dict()["certificate"]["gap"] == report.certificate.gap
    with pytest.raises(AttributeError, match="no 'gapp'"):
        report.certificate.gapp
    with pytest.raises(capstan.ArgumentError, match="no load step remains"):
        evolution.step()


def after(scene, steps):
    evolution = capstan.Evolution(scene)
    for _ in range(steps):
        evolution.step()
    return evolution


def test_friction_of_a_sliding_rope_is_mu_times_its_weight(rope):
    evolution = after(rope.replace("[0.5, 0.3, 0]", "[0.5, 0, 0]"), 5)
    # Coulomb: mu w L, to the accuracy of the certificate (1e-8 of the energies)
    assert evolution["rope"].B.force == pytest.approx([0.5 * 9.81 * 2, 0, 0], rel=1e-7, abs=1e-7)
    assert evolution["rope"].reaction.sum() == pytest.approx(9.81 * 2, rel=1e-9)


def test_views_are_the_library_s_memory_and_cannot_be_written_to(rope):
    evolution = capstan.Evolution(rope)
    line = evolution["rope"]
    position, tension, state = line.position, line.tension, line.state
    assert position.shape == (21, 3) and tension.shape == (20,) and state.shape == (1, 21) and state.dtype == np.uint8
    for array in (position, tension, state):
        assert not array.flags.owndata and not array.flags.writeable
        with pytest.raises(ValueError):
            array[0] = 1
        with pytest.raises(ValueError):
            array.flags.writeable = True
    start = position.copy()
    evolution.step()
    # the same view shows the step that has been completed
    assert not np.array_equal(position, start) and np.array_equal(position, line.position)
    assert np.shares_memory(position, line.position)
    for name, (dtype, dims, _) in capstan.ARRAYS.items():
        array = getattr(line, name)
        assert array.dtype == dtype and array.ndim == len(dims) and not array.flags.writeable or array.size == 0, name


def test_a_view_keeps_the_memory_of_its_evolution(rope):
    for close in (False, True):
        evolution = capstan.Evolution(rope)
        evolution.step()
        view = evolution["rope"].position[3:7, :2]
        kept = view.copy()
        if close:
            evolution.close()
        del evolution
        gc.collect()
        others = [capstan.Evolution(rope) for _ in range(20)]
        assert np.array_equal(view, kept)
        del others


def test_a_closed_evolution_refuses_every_call(rope):
    with capstan.Evolution(rope) as evolution:
        evolution.step()
        line, target, state = evolution["rope"], evolution.target({"rope.B": {"force": [0, 0, 0]}}), evolution.save()
    evolution.close()
    for call in (evolution.step, evolution.save, evolution.take_back, lambda: evolution.move(target),
                 lambda: evolution.load(state), lambda: evolution.report, lambda: line.position, lambda: line.report,
                 lambda: line.stiffness(), lambda: evolution.points, lambda: evolution.step_count, lambda: line.origin,
                 lambda: evolution.move({"rope.B": {"force": [0, 0, 0]}}), lambda: evolution.certified):
        with pytest.raises(capstan.ArgumentError, match="closed"):
            call()
    assert "closed" in repr(evolution)


def test_moves_do_what_stages_do(rope):
    history = capstan.Evolution(rope)
    free = capstan.Evolution(rope)
    target = free.target({"rope.B": {"position": [2, 0, 0]}})
    start = np.array([2.0, 0, 0])
    for i in range(5):
        history.step()
        target["rope.B"][:] = start + (i + 1) / 5 * np.array([0.5, 0.3, 0])
        report = free.move(target)
        assert report.outcome == "solved"
        assert np.allclose(free["rope"].position, history["rope"].position, rtol=0, atol=1e-12)
    now = free["rope"].B.position.copy()
    free.move({"rope.B": {"move": [0, 0, 0.25]}, "name": "up"})
    assert np.array_equal(free["rope"].B.position, now + [0, 0, 0.25]) and free.report.name == "up"


def test_a_move_taken_back_leaves_the_same_bits(rope):
    evolution = after(rope, 5)
    evolution.move({"rope.B": {"move": [0.1, 0, 0]}})
    before = evolution.save(), evolution["rope"].position.copy()
    evolution.move({"rope.B": {"move": [0, 0.4, 0]}, "gravity": [0, 0, -5]})
    assert evolution["rope"].position.tobytes() != before[1].tobytes()
    evolution.take_back()
    assert evolution["rope"].position.tobytes() == before[1].tobytes()
    with pytest.raises(capstan.ArgumentError):
        evolution.take_back()


def test_states_go_on_with_the_same_bits(rope):
    whole = capstan.Evolution(rope)
    states, forces = [whole.save()], []
    for _ in whole:
        states.append(whole.save())
        forces.append(whole["rope"].B.force.tobytes())
    for k in (0, 3, 7):
        other = capstan.Evolution(rope)
        other.load(states[k])
        assert [other["rope"].B.force.tobytes() for _ in other] == forces[k:]
    assert whole.save() == states[-1]


@pytest.mark.parametrize("spoil", [lambda s: b"", lambda s: s[:-1], lambda s: s + b"0", lambda s: bytes(len(s)), lambda s: "text",
                                   lambda s: None, lambda s: bytes([s[0] ^ 1]) + s[1:], lambda s: 7])
def test_states_that_are_none_are_refused(rope, spoil):
    evolution = capstan.Evolution(rope)
    evolution.step()
    state, before = evolution.save(), evolution["rope"].position.copy()
    with pytest.raises(capstan.Error):
        evolution.load(spoil(state))
    assert np.array_equal(evolution["rope"].position, before)


def test_points_bodies_and_obstacles():
    evolution = capstan.Evolution(MOORED)
    evolution.step()
    knot, float_ = evolution.points["knot"], evolution.bodies["float"]
    assert knot.has_place and knot.state == "free"
    assert np.abs(knot.residual).max() < 1e-3 and float_.kind == "held"
    # the body is held: what holds it balances lines, weight and buoyancy
    assert np.allclose(float_.lines + float_.load + float_.support, 0, atol=1e-6)
    stiffness = evolution.body_stiffness("float")
    assert stiffness.shape == (6, 6) and stiffness[0, 0] > 0
    evolution.move({"float.body": {"position": [-1, 0, 0]}})
    assert np.array_equal(evolution.bodies["float"].position, [-1, 0, 0])
    half = math.sqrt(0.5)
    evolution.move({"float.body": {"rotation": {"quaternion": [half, 0, 0, half]}}, "drum.turn": 90,
                    "knot.point": {"force": [0, 0, 100]}})
    assert np.allclose(np.abs(evolution.bodies["float"].rotation), [half, 0, 0, half])
    assert np.array_equal(evolution.obstacles["bed"].point, [0, 0, -50])
    assert evolution.obstacles["drum"].turned == pytest.approx(math.pi / 2)
    # nothing says that the bed may move
    with pytest.raises(capstan.ArgumentError, match="moves"):
        evolution.move({"bed.obstacle": {"move": [0, 0, 1]}})


def test_obstacles_move_and_ends_are_let_go(rope):
    evolution = capstan.Evolution(rope, moving=["floor"])
    for _ in evolution:
        pass
    place, friction = evolution["rope"].position.copy(), 0.5 * 9.81 * 2
    evolution.move({"rope.B": {"release": True}})
    assert evolution["rope"].failure.release == ("none", "by_stage") and not evolution["rope"].B.force.any()
    place = evolution["rope"].position.copy()
    # what rests on a floor goes up with it; and along with it, as far as friction holds what nothing pulls
    evolution.move({"floor.obstacle": {"move": [0.25, 0, 0.5]}})
    assert np.allclose(evolution["rope"].position, place + [0.25, 0, 0.5], atol=1e-7)
    evolution.move({"floor.obstacle": {"turn": 180, "axis": [0, 0, 2], "about": [0.25, 0, 0.5]}})
    assert evolution.obstacles["floor"].turn[2] == pytest.approx(math.pi)
    assert np.allclose(evolution["rope"].position, np.array([0.25, 0, 0.5]) + [-1, -1, 1] * place, atol=1e-6)
    for wrong in ({"turn": 3}, {"axis": [0, 0, 1]}, {"turn": 3, "axis": [0, 0, 0]}, {"move": [0, 0, 1], "about": [0, 0, 0]}, {}, [0, 0, 1]):
        with pytest.raises(capstan.ArgumentError):
            evolution.move({"floor.obstacle": wrong})
    with pytest.raises(capstan.ArgumentError, match="no obstacle"):
        capstan.Evolution(rope, moving=["ceiling"])


def test_nodes_are_grasped(rope):
    evolution = after(rope, 5)
    evolution.move({"rope.node": {"at": 1.0, "hold": True}})
    held = evolution["rope"].position[10].copy()
    evolution.move({"rope.B": {"move": [0, 0.2, 0]}})
    assert np.array_equal(evolution["rope"].position[10], held)
    evolution.move({"rope.node": {"at": 1.0, "position": held + [0, 0, 0.1]}})
    assert np.allclose(evolution["rope"].position[10], held + [0, 0, 0.1], atol=1e-12)
    assert evolution.move({"rope.node": {"at": 1, "release": True}}).outcome == "solved"


def test_stiffness_is_the_difference_of_forces():
    """Against central differences of moves of the end, each from the same state, of a rope that hangs."""
    evolution = after({"lines": {"rope": {"length": 2, "elements": 30, "mass": 1, "stiffness": 1e4, "start": "static", "ends": {
        "A": {"held": [0, 0, 0]}, "B": {"held": [1.5, 0.2, 0.3]}}}}}, 1)
    place, step = np.array([1.52, 0.2, 0.3]), 1e-4

    def force_at(to):
        evolution.move({"rope.B": {"position": to}})
        force = evolution["rope"].B.force.copy()
        return force

    force_at(place)
    analytic = evolution["rope"].stiffness("B")
    evolution.take_back()
    found = np.zeros((3, 3))
    for j in range(3):
        for sign in (1, -1):
            found[:, j] += sign * force_at(place + sign * step * np.eye(3)[j]) / (2 * step)
            evolution.take_back()
    # the differences err by step^2 times the third derivative, of the order of the stiffness over m2: 1e-8 of it; and
    # by the solver's error of the forces over the step: 1e-9 N / 1e-4 m, a millionth of the stiffness
    assert np.allclose(analytic, found, rtol=1e-5, atol=1e-6 * np.abs(found).max())
    # node 0 is end A: the same line with its ends exchanged has the same stiffness there
    assert np.allclose(evolution["rope"].stiffness("A"), evolution["rope"].stiffness("B"), rtol=1e-9)


def springs(rng, count):
    """Taut weightless lines from a point at 0 to places around it, and the stiffness that straight springs have there."""
    lines, points, known = {}, {"knot": {"held": [0, 0, 0]}}, np.zeros((3, 3))
    for k in range(count):
        far = rng.normal(size=3) * 10 ** rng.uniform(0, 1)
        distance = np.linalg.norm(far)
        length, stiffness = distance / (1 + 10 ** rng.uniform(-4, -2)), 10 ** rng.uniform(4, 6)
        along = np.outer(far, far) / distance ** 2
        # extended by a strain e it pulls with EA e
        known += stiffness / length * along + stiffness * (distance / length - 1) / distance * (np.eye(3) - along)
        points[f"far_{k}"] = {"held": list(far)}
        ends = [{"point": f"far_{k}"}, {"point": "knot"}]
        a, b = ends if k % 2 else ends[::-1]
        lines[f"line_{k}"] = {"length": float(length), "elements": 1 + int(rng.integers(5)), "weight": 0, "stiffness": float(stiffness),
                              "start": "static", "ends": {"A": a, "B": b}}
    return {"gravity": [0, 0, 0], "points": points, "lines": lines}, known


@pytest.mark.parametrize("count", [1, 2, 3, 7])
def test_stiffness_of_a_point_between_taut_springs(count):
    rng = np.random.default_rng(count)
    scene, known = springs(rng, count)
    evolution = after(scene, 1)
    for kind in ("step", "stick"):
        found = evolution.point_stiffness("knot", kind)
        assert np.abs(found - known).max() < 1e-8 * np.abs(known).max()
        assert np.abs(evolution.point_stiffness("knot", kind, smooth=True) - known).max() < 1e-8 * np.abs(known).max()


def test_a_loop_has_no_stiffness_at_its_point():
    # both its ends go with the point: the line is carried along
    evolution = after({"points": {"hook": {"held": [3, -2, 5]}}, "lines": {"loop": {
        "length": 2, "elements": 20, "mass": 1, "stiffness": 1e4, "start": "static", "ends": {"A": {"point": "hook"}, "B": {"point": "hook"}}}},
        "history": [{"name": "aside", "gravity": [1, 2, -9]}]}, 2)
    # beside some 10 N/m, what a weight of 10 N and 1 m make
    assert np.abs(evolution.point_stiffness("hook")).max() < 1e-5
    assert np.abs(evolution["loop"].stiffness("A")).max() < 1e-5


@pytest.mark.parametrize("kind", ["step", "stick"])
def test_free_points_follow(kind):
    """Two taut weightless springs in a row: along them they are in series, across them a string of the whole length."""
    evolution = after({"points": {"left": {"held": [0, 0, 0]}, "knot": {"free": [2, 0, 0]}, "right": {"held": [5.03, 0, 0]}},
                       "lines": {"a": {"length": 2, "elements": 3, "weight": 0, "stiffness": 1e3, "start": "static",
                                       "ends": {"A": {"point": "left"}, "B": {"point": "knot"}}},
                                 "b": {"length": 3, "elements": 2, "weight": 0, "stiffness": 4e3, "start": "static",
                                       "ends": {"A": {"point": "right"}, "B": {"point": "knot"}}}}}, 1)
    along = 1 / (2 / 1e3 + 3 / 4e3)
    tension = 0.03 * along
    known = np.diag([along, tension / 5.03, tension / 5.03])
    for found in (evolution.point_stiffness("left", kind), evolution["b"].stiffness("A", kind, smooth=True)):
        assert np.abs(found - known).max() < 1e-8 * along


KNOT = {"obstacles": {"bed": {"plane": {"point": [0, 0, -30]}, "friction": 0.4}},
        "points": {"knot": {"held": [0, 0, -4]}, "east": {"held": [80, 5, -30]}, "west": {"held": [-40, 70, -30]}, "south": {"held": [-45, -60, -30]},
                   "buoy": {"held": [10, 0, 6]}},
        "lines": {"to_" + name: {"length": length, "elements": 40, "weight": 300, "stiffness": 1e6, "start": "static",
                         "ends": {"A": {"point": name}, "B": {"point": "knot"}}}
                  for name, length in (("east", 88), ("west", 88), ("south", 84), ("buoy", 15))}}


def test_stiffness_of_a_point_is_the_difference_of_forces():
    """K of the step against the same step with its target moved: three lines with friction on the bed, of which one is dragged, and one that hangs."""
    evolution = after(KNOT, 1)
    evolution.move({"knot.point": {"position": [1.5, 0.7, -3.6]}})
    target, before, step = np.array([1.8, 0.9, -3.5]), evolution.save(), 1e-4

    def force(place):
        evolution.load(before)
        evolution.move({"knot.point": {"position": [float(x) for x in place]}})
        return evolution.points["knot"].lines

    differences = np.array([(force(target + step * e) - force(target - step * e)) / (2 * step) for e in np.eye(3)]).T
    force(target)
    found = evolution.point_stiffness("knot")
    # the lines pull back: K is minus the change of what they do to the point; forces are known to 1e-6 N
    assert np.abs(found + differences).max() < 1e-4 * np.abs(found).max()
    moored = [evolution["to_" + name] for name in ("east", "west", "south")]
    assert min(line.report.grounded for line in moored) > 1 and max(line.report.slipping for line in moored) > 0
    for kind in ("step", "stick"):
        whole = evolution.point_stiffness("knot", kind)
        assert np.allclose(whole, sum(line.stiffness("B", kind) for line in moored + [evolution["to_buoy"]]), rtol=1e-12, atol=1e-6)
    assert np.abs(evolution.point_stiffness("knot", "stick") - found).max() > 1e-3 * np.abs(found).max()
    # what the bed does to an anchor is not in its stiffness
    assert np.allclose(evolution.point_stiffness("east"), evolution["to_east"].stiffness("A"), rtol=1e-12, atol=1e-6)


def test_no_point_stiffness_says_why():
    evolution = capstan.Evolution(KNOT)
    with pytest.raises(capstan.NoAnswer) as caught:
        evolution.point_stiffness("knot")
    assert caught.value.outcome == "no_step"


def test_no_stiffness_says_why(rope):
    evolution = capstan.Evolution(rope)
    with pytest.raises(capstan.NoAnswer) as found:
        evolution["rope"].stiffness()
    assert found.value.outcome == "no_step" and "load step" in str(found.value)
    copy = pickle.loads(pickle.dumps(found.value))
    assert copy.outcome == "no_step"


# ---- threads, forks, signals ----

LONG = """
capstan: 1
lines:
  rope: {length: 2, elements: 4000, mass: 1, stiffness: 1e4, start: {straight: {from: [0, 0, 0], to: [2, 0, 0]}},
         ends: {A: free, B: {held: [2, 0, 0]}}}
obstacles: {floor: {plane: {}, friction: 0.5}}
solver: {path_tolerance: 1e-9, halvings: 30}
history: [{name: pull, rope.B: {move: [0.5, 1.3, 0.2]}}]
"""


def test_threads_step_evolutions_of_their_own(rope):
    expected = [step.lines["rope"].end[1].force.tobytes() for step in capstan.run(rope)]
    found = {}

    def work(k):
        evolution = capstan.Evolution(rope)
        found[k] = [evolution["rope"].B.force.tobytes() for _ in evolution]
    threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(found[k] == expected for k in range(8))


def test_threads_may_share_one_evolution(rope):
    evolution, failures = capstan.Evolution(rope), []

    def work():
        for _ in range(60):
            try:
                evolution["rope"].position.sum()
                evolution.report.certificate.gap
                evolution.move({"rope.B": {"move": [1e-3, 0, 0]}})
                evolution.save()
            except capstan.Error as error:
                if "history" not in str(error):
                    failures.append(error)
    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures and evolution.report.step_count == 240


def test_a_step_lets_other_threads_run():
    evolution, ticks, done = capstan.Evolution(LONG), [], threading.Event()

    def count():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)
    thread = threading.Thread(target=count)
    thread.start()
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        evolution.step()
    ended = time.monotonic()
    done.set()
    thread.join()
    inside = [tick for tick in ticks if begun < tick < ended]
    assert len(inside) > 50  # of about 500; with the interpreter locked there would be none


def test_ctrl_c_leaves_the_evolution_as_it_was():
    evolution = capstan.Evolution(LONG)
    before = evolution.save()
    threading.Timer(0.4, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        evolution.step()
    assert time.monotonic() - begun < 20  # the whole step takes minutes
    assert evolution.save() == before and evolution.remaining == 1


def test_other_handlers_raise_their_own_exception():
    def handler(number, frame):
        raise TimeoutError("too long")
    old = signal.signal(signal.SIGALRM, handler)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    try:
        with pytest.raises(TimeoutError, match="too long"):
            capstan.Evolution(LONG).step()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def test_a_run_that_is_interrupted_keeps_its_steps(rope):
    def stop(done, total, report):
        assert total == 8
        if done == 3:
            raise KeyboardInterrupt
    with pytest.raises(KeyboardInterrupt) as stopped:
        capstan.run(rope, progress=stop, directory="out")
    results = stopped.value.results
    assert len(results) == 3 and not results.complete and not results.certified
    assert len(capstan.open("out").summary["steps"]) == 3


def test_a_fork_goes_on_by_itself(rope):
    expected = [step.lines["rope"].end[1].force.tobytes() for step in capstan.run(rope)]
    evolution = capstan.Evolution(rope)
    evolution.step()
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        code = 1
        try:
            rest = [evolution["rope"].B.force.tobytes() for _ in evolution]
            code = 0 if rest == expected[1:] else 2
        finally:
            os._exit(code)
    os.close(read)
    os.close(write)
    assert os.waitpid(child, 0)[1] == 0
    assert [evolution["rope"].B.force.tobytes() for _ in evolution] == expected[1:]


def test_a_fork_during_a_step_has_no_half_step():
    """In the child of a fork, an evolution that another thread was stepping is closed, and nothing waits for it."""
    evolution = capstan.Evolution(LONG)
    thread = threading.Thread(target=stepping, args=(evolution,))
    thread.start()
    time.sleep(0.3)
    child = os.fork()
    if child == 0:
        code = 1
        try:
            try:
                evolution.step()
            except capstan.ArgumentError as error:
                code = 0 if "closed" in str(error) else 2
        finally:
            os._exit(code)
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline:
        pid, status = os.waitpid(child, os.WNOHANG)
        if pid:
            break
        time.sleep(0.05)
    else:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        status = -1
    evolution._watch.stopped = 1  # end the step of the thread
    thread.join()
    assert status == 0


def stepping(evolution):
    try:
        evolution.step()
    except KeyboardInterrupt:
        pass
