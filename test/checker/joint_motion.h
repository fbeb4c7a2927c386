/* SPDX-License-Identifier: BSD-3-Clause */
/* Points and bodies in steps in time: their inertia and damping, derived anew from places,
 * velocities and the time of the file, its scheme, and their kinetic energies. */
#ifndef CAPSTAN_CHECKER_JOINT_MOTION_H
#define CAPSTAN_CHECKER_JOINT_MOTION_H

#include "bodies.h"
#include "soft.h"

/* A point after a step; all 0 in a file without steps in time. */
typedef struct PointMotion {
    Vector inertia, velocity, reference, rest_velocity;
    double mass, span, kinetic, growth, impact, scheme, settling, damped;
    int velocity_given; /* by the caller of the step; x* is then the place from which it leads */
} PointMotion;

/* A body likewise; matrices row by row. */
typedef struct BodyMotion {
    double mass, moments[3], products[3], added[SIX * SIX], damping[SIX * SIX],
        quadratic[SIX * SIX];
    double inertia[SIX], damped[SIX];
    Vector velocity, rate, centre_velocity;
    double span, kinetic, lost, growth, scheme, settling, drag, waves; /* the last two of members */
    int velocity_given;                                                /* as of a point */
} BodyMotion;

/* Read the points, or the bodies, of a step. Return 0, or -1 after a sentence on log. */
int point_motions_read(const Source *source, size_t step, PointMotion *all, FILE *log);
int body_motions_read(const Source *source, size_t count, size_t step, BodyMotion *all, FILE *log);

/* [N] The largest of what acts on a body, moments over an arm: its load, what of it is given, which
 * weight and water may cancel, and its inertia. Where gravity has changed its change counts as
 * given. */
double body_acting(const Source *source, const BodyData *data, const BodyState *at,
                   const BodyMotion *motion, double arm);

/* [s] The length of a step in time; 0 of others. */
double step_length_of(const Source *source, size_t step);

typedef void MotionFind(void *user, const char *what, double said, double expected);

/* Three steps of a point, the last first; `older` or both NULL where there are none. */
typedef struct PointSteps {
    const Junction *now, *before, *older;
    const PointMotion *motion, *motion_before, *motion_older;
    double h, h_before, reach; /* [s] lengths of steps; [m] of the largest coordinate */
    double largest;            /* [N] force in the lines, which may cancel at the point */
    /* [J] by which the energy of its buoyancy has grown, and what the waves did, by the checker;
     * [N] the buoyancy */
    Real afloat, waves;
    double buoyancy;
    /* of what it touches: the way in the step, and the velocity along the normal, also before */
    double ground[3];         /* [m] */
    double rate, rate_before; /* [m/s] */
    bool is_free;
    bool is_stopped, was_stopped; /* by something rigid on which it bears; in the step before */
    SoftWork soft;                /* of what gives below it */
} PointSteps;
void point_motion_check(const PointSteps *steps, MotionFind *find, void *user);

/* ... and of a body. */
typedef struct BodySteps {
    const BodyData *data;
    const BodyState *now, *before, *older;
    const BodyMotion *motion, *motion_before, *motion_older;
    double h, h_before, reach;
} BodySteps;
void body_motion_check(const BodySteps *steps, MotionFind *find, void *user);

#endif
