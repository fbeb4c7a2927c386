/* SPDX-License-Identifier: BSD-3-Clause */
/* The force of radiation on a body of a scene by the velocities that it has had. */
#ifndef CAPSTAN_CHECKER_RADIATION_H
#define CAPSTAN_CHECKER_RADIATION_H

#include "bodies.h"
#include "capstan/scene.h"

/* At a time: velocity and rate of rotation in the axes of the body. */
typedef struct RadiationMoment {
    double time;
    Real u[SIX];
} RadiationMoment;

/* Moments in their order, from the last one at which the body was at rest, or the beginning. */
typedef struct RadiationPast {
    size_t count, room;
    RadiationMoment *moment;
} RadiationPast;

RadiationMoment radiation_moment(double time, const double rotation[FOUR], const double *velocity,
                                 const double *rate);
/* The body is at rest, before all else; and what comes after the last one. Return 0, or -1 without
 * memory. */
int radiation_rest(RadiationPast *past, double time);
int radiation_note(RadiationPast *past, RadiationMoment moment);

/* Force and moment in the axes of the body at the moment `now`, after those of the past; the sizes
 * of the terms of each are added to sizes. */
void radiation_force(const CpsBody *body, const RadiationPast *past, RadiationMoment now,
                     Real out[SIX], double sizes[2]);

#endif
