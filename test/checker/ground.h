/* SPDX-License-Identifier: BSD-3-Clause */
/* Ground as the checker sees it: the points of a grid from result.nc, in long double. */
#ifndef CAPSTAN_CHECKER_GROUND_H
#define CAPSTAN_CHECKER_GROUND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "conic.h"

typedef struct Ground {
    size_t columns, rows;
    double *x, *y, *z, *factor; /* z, factor: (rows, columns); factor may be NULL */
    bool extends;
} Ground;

/* Read the ground of obstacle k, by its name; NULL, with a line in `log`, where it is not whole. */
Ground *ground_read(int nc, size_t k, FILE *log);
void ground_free(Ground *ground);
/* Height and slopes along x and y. */
Real ground_height(const Ground *ground, Real x, Real y, Real slope[2]);
/* By which friction is multiplied. */
Real ground_factor(const Ground *ground, Real x, Real y);
/* The largest factor less the smallest. */
double ground_range_of_factors(const Ground *ground);
/* [m] The smallest distance of two neighbouring points. */
Real ground_spacing(const Ground *ground);
/* Rounding of the factor at a position: that of its coordinates and of the ground's reference
 * point, a few times, over the spacing of the points between which the factor changes. */
double ground_factor_noise(const Ground *ground, const double *position, const Real *point);

#endif
