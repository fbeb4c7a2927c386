/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of a free body in its pose, recomputed from places, forces and lengths. */
#ifndef CAPSTAN_CHECKER_BODY_STIFFNESS_H
#define CAPSTAN_CHECKER_BODY_STIFFNESS_H

#include "bodies.h"

/* The lines of a step, and what pulls the weights: gravity per that of the scene. */
typedef struct StiffnessStep {
    const Source *source;
    const Bodies *bodies;
    const Record *line; /* (lines) */
    const double *gravity;
    size_t step;
    bool sticks; /* what friction can hold stays: the stiffness against a small cycle */
} StiffnessStep;

/* [N/m, N, N m] (6, 6) What force and moment on body k lose by its displacement and rotation from
 * the pose that it has, the free points to which its lines lead following it, all other bodies
 * staying. False where that is not known here: a line is slack in part, touches what
 * is no plane, slides with two coefficients, is between two states, or moves in time; or no memory.
 * `all`: (bodies) their poses; `arm` [m]: a length of the body. */
bool body_stiffness(const StiffnessStep *step, size_t k, const BodyState *all, double arm,
                    Real stiffness[SIX * SIX]);

/* What that on body `to` loses by the motion of body `from` in the lines, likewise. */
bool body_coupling(const StiffnessStep *step, size_t to, size_t from, const BodyState *all,
                   Real stiffness[SIX * SIX]);

#endif
