/* SPDX-License-Identifier: BSD-3-Clause */
/* The waves of a file, and how the water moves in them. */
#ifndef CAPSTAN_CHECKER_SEA_H
#define CAPSTAN_CHECKER_SEA_H

#include "record.h"

typedef struct Wave {
    Real amplitude, frequency, number, heading[2], phase;
} Wave;

typedef struct Sea {
    size_t waves;                /* 0: the file has none, and the rest is not set */
    Wave *wave;                  /* (waves) */
    double surface, depth, ramp; /* INFINITY: deep */
    double origin[3];
} Sea;

/* k of a wave by bisection; the depth may be infinite. */
Real sea_number(Real frequency, Real g, Real depth);
/* Returns 0, or -1 after one sentence on log. */
int sea_read(const Source *source, Sea *out, FILE *log);
void sea_free(Sea *sea);

/* [-] What part of the waves there is at a time. */
Real sea_growth(const Sea *sea, Real time);

/* [m] By how much the waves lift the surface above x. */
Real sea_elevation(const Sea *sea, Real time, const Real *x);

/* Add the velocity of the water at a time in the place x of the file's coordinates, and its
 * acceleration. */
void sea_motion(const Sea *sea, Real time, const Real *x, Real *velocity, Real *acceleration);

#endif
