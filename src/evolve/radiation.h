/* SPDX-License-Identifier: BSD-3-Clause */
/* The force of the waves that a body has made: memory of radiation (capstan/body.h, docs/theory.md
 * 9).
 *
 *     f(t) = -int_0^T K(s) u(t - s) ds
 *
 * u the velocities of a body in its own axes, K between the rows of a table linear in s, and 0
 * after the last one. Past velocities are kept at the times j g, g the spacing of the table: there
 * they are linear between steps. The integral is the trapezoidal sum over these times and that
 * after the step, of the second order in g and the length of steps. */
#ifndef CAPSTAN_SRC_EVOLVE_RADIATION_H
#define CAPSTAN_SRC_EVOLVE_RADIATION_H

#include <stdint.h>

#include "capstan/scene.h"

typedef struct CpsiRadiation {
    int rows;             /* 0: no memory */
    double spacing;       /* [s] g */
    const double *kernel; /* (rows, 36) K(m g) */
    double *past;         /* (rows, 6) u(j g) in row j mod rows */
    int64_t kept;         /* j of the next one; negative: the body has been at rest */
    /* of the step under way: f = -(direct u + known) with u after it */
    double from, length; /* [s] */
    double direct[36], known[6];
} CpsiRadiation;

/* Check the table of a body. */
CpsStatus cpsi_radiation_check(const CpsBody *body, CpsError *err);

/* How many numbers the memory of a body takes; and the memory in such an array. */
size_t cpsi_radiation_size(const CpsBody *body);
CpsiRadiation cpsi_radiation_of(const CpsBody *body, double *numbers);

/* A step of a length begins at a time, with the velocities `now` (6). */
void cpsi_radiation_begin(CpsiRadiation *radiation, double time, double length, const double *now);
/* Add f, if the velocities after the step are u (6). */
void cpsi_radiation_add(const CpsiRadiation *radiation, const double *u, double *f);
/* The step has led from the velocities `now` to `next` (6). */
void cpsi_radiation_advance(CpsiRadiation *radiation, const double *now, const double *next);
/* The body is at rest, and the waves have gone. */
void cpsi_radiation_forget(CpsiRadiation *radiation);

#endif
