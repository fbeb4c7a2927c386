# SPDX-License-Identifier: BSD-3-Clause
"""The load on an anchor when the friction of the sea bed is not known: a sweep over 60 coefficients from a distribution.

The platform of the OC3-Hywind line surges out by 4 m. The chain on the bed carries a part of the pull: where all of it
slides, the anchor has what arrives at the touchdown point, less friction times weight."""
import numpy as np

import capstan

WEIGHT, LENGTH = 698.094, 902.2  # N/m, m


def scene(friction):
    return capstan.Scene(
        obstacles={"bed": capstan.Obstacle(plane={"point": [0, 0, -320]}, friction=friction)},
        lines={"mooring": capstan.Line(length=LENGTH, elements=200, weight=WEIGHT, stiffness=384.243e6, start="static", ends={
            "A": {"held": [0, 0, -320]}, "B": {"held": [848.67, 0, -70]}})},
        history=[{"name": "surge out", "steps": 5, "mooring.B": {"move": [4, 0, 0]}}])


def measure(results):
    line, tension = results.steps[-1].lines["mooring"], results["mooring"].tension[-1]
    return {"anchor": line.end[0].tension, "grounded": line.grounded, "slipping": line.slipping,
            "touchdown": tension[int(line.grounded / LENGTH * len(tension))]}


if __name__ == "__main__":
    frictions = np.random.default_rng(1).lognormal(np.log(0.6), 0.3, 60)
    found = capstan.sweep(scene, [{"friction": mu} for mu in sorted(frictions)], jobs=2, measure=measure)
    assert bool(found.certified.all())
    load = found.anchor.values
    print(f"anchor: {load.mean() / 1e3:.1f} kN on average, standard deviation {load.std() / 1e3:.1f} kN, "
          f"95 % below {np.quantile(load, 0.95) / 1e3:.1f} kN")
    # the rougher the bed, the less arrives at the anchor
    assert (np.diff(load) < 0).all()
    # where all but the half element at the anchor slides: T(anchor) = T(touchdown) - mu w L, to one element of 200
    slides, element = (found.slipping > found.grounded - LENGTH / 200).values, LENGTH / 200
    carried, expected = (found.touchdown - found.anchor).values, (found.friction * WEIGHT * found.grounded).values
    assert slides.sum() > 10 and (np.abs(carried - expected) < found.friction.values * WEIGHT * element)[slides].all()
