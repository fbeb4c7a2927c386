/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether a given moment turns a free body whose lines all end at one point of it, in whatever pose
 * it is (docs/theory.md 5a). */
#ifndef CAPSTAN_SRC_EVOLVE_BODY_TURNING_H
#define CAPSTAN_SRC_EVOLVE_BODY_TURNING_H

#include "evolve/bodies.h"

/* Everything about such a body that turns it, in the axes of the scene but for the arms, which are
 * in those of the body. */
typedef struct CpsiTurning {
    Vec3 force, moment;  /* [N] at the reference point, [N m] */
    Vec3 gravity;        /* [m/s2] */
    Vec3 eye, weight_by; /* [m] where the lines end; [kg m] weight and lift, with their arms */
    bool about[3];       /* axes x, y, z that the motion may be about */
    double sizes;        /* [N m] sum of the sizes of all moments */
} CpsiTurning;

/* Is there an axis about which the moments of all rotations have one sign? *axis: of unit length,
 * and *moment [N m]: the least of these moments, within a hundredth of the largest such one of any
 * axis. */
bool cpsi_turns_for_ever(const CpsiTurning *turning, Vec3 *axis, double *moment);

#endif
