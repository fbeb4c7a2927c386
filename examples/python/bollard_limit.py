# SPDX-License-Identifier: BSD-3-Clause
"""How much does half a turn round a bollard hold? A hand keeps 100 N on one end of a rope; the pull on the other end grows,
and a decision in the loop takes the last move back when the rope has begun to run, and tries a smaller one.

Euler: the rope runs at exp(0.3 pi) = 2.566 times the hand's force."""
import math

import capstan

FRICTION, HAND, RADIUS, ELEMENTS = 0.3, 100.0, 0.3, 60

scene = capstan.Scene(
    obstacles={"bollard": capstan.Obstacle(cylinder={"axis": [0, 0, 1], "radius": RADIUS}, friction=FRICTION)},
    lines={"rope": capstan.Line(
        length=math.pi * RADIUS, elements=ELEMENTS, weight=0, stiffness=2e6,
        start={"arc": {"from": [RADIUS, 0, 0], "centre": [0, 0, 0], "axis": [0, 0, 1]}},
        ends={"A": "free", "B": "free"})},
    history=[{"name": "hold", "rope.A": {"force": [0, -HAND, 0]}, "rope.B": {"force": [0, -HAND, 0]}}])

evolution = capstan.Evolution(scene)
evolution.step()
target = evolution.target({"rope.B": {"force": [0, -HAND, 0]}})
pull, more, moves = HAND, 64.0, 0
while more > 0.25:
    target["rope.B"][1] = -(pull + more)
    report = evolution.move(target)
    moves += 1
    if evolution.certified:
        pull += more
    else:                              # it runs: there is no equilibrium, with a proof in the report
        evolution.take_back()
        more /= 2

# each node of the mesh holds (1 + mu tan(d/2))/(1 - mu tan(d/2)) at its turn d of 3 degrees, 2.4e-4 more in all than
# exp(0.3 pi); and the search stops at 0.25 N of 257 N, a thousandth
assert abs(pull / HAND / math.exp(FRICTION * math.pi) - 1) < 1.3e-3
assert evolution.certified and evolution["rope"].B.tension > 256
print(f"{moves} moves: the bollard holds {pull / HAND:.3f} times the hand's force, Euler {math.exp(FRICTION * math.pi):.3f}")
