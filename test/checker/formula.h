/* SPDX-License-Identifier: BSD-3-Clause */
/* The formula of a step in time, from the lengths of two steps: the rate at the end of the parabola
 * through the last three values y of steps of lengths `before` and h is (y_{n+1} - y*)/k, y* a mean
 * of the two earlier ones; that at the end of the straight line through the last two (y_{n+1} -
 * y_n)/h. */
#ifndef CAPSTAN_CHECKER_FORMULA_H
#define CAPSTAN_CHECKER_FORMULA_H

#include <math.h>
#include <stdbool.h>

#include "surface.h"

/* Two lengths of time are the same, as shares. */
static const double FORMULA_TIMES = 1e-9;

typedef struct Formula {
    Real span; /* [s] k */
    Real back; /* y* = y_n + back (y_n - y_{n-1}) */
} Formula;

static inline bool formula_is_euler(double span, double h) {
    return fabs(span - h) <= FORMULA_TIMES * h;
}

/* Of a step in which k is `span`; before: [s] length of the step before, 0 where none was in time,
 * after which only a straight line is known. */
static inline Formula formula_of(double span, double h, double before) {
    if (formula_is_euler(span, h) || !(before > 0)) return (Formula){h, 0};
    /* derivatives of Lagrange's polynomials at the end, of the values y_{n+1} and y_{n-1} */
    const Real both = (Real)h + before, last = 1 / (Real)h + 1 / both, first = h / (before * both);
    return (Formula){1 / last, first / last};
}

#endif
