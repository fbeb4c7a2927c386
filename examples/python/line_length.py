# SPDX-License-Identifier: BSD-3-Clause
"""The length of a mooring line for a wanted pretension, by scipy: the OC3-Hywind line shall pull its fairlead with 950 kN.

The same is asked of the library with the key `pretension`; both agree."""
import scipy.optimize

import capstan

WANTED = 950e3  # N


def scene(length, **keys):
    return capstan.Scene(
        obstacles={"bed": capstan.Obstacle(plane={"point": [0, 0, -320]}, friction=0.5)},
        lines={"mooring": capstan.Line(length=length, elements=200, weight=698.094, stiffness=384.243e6, start="static", ends={
            "A": {"held": [0, 0, -320]}, "B": {"held": [848.67, 0, -70]}}, **keys)})


def tension(length):
    evolution = capstan.Evolution(scene(length))
    evolution.step()
    assert evolution.certified
    return evolution["mooring"].B.tension


length = scipy.optimize.brentq(lambda length: tension(length) - WANTED, 895, 905, xtol=1e-9)
asked = capstan.Evolution(scene(900, pretension={"end": "B", "tension": WANTED}))["mooring"].arc_length[-1]

# the tension grows by some 20 kN when the line is a metre shorter: both find it to 1e-6 N or better
assert abs(length - asked) < 1e-6 and abs(tension(length) - WANTED) < 1e-2
print(f"length {length:.6f} m by scipy, {asked:.6f} m by the library: {tension(length):.1f} N")
