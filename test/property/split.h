/* SPDX-License-Identifier: BSD-3-Clause */
/* Certificates for the support of an intersection of simple sets, without the library: h(w) lies
 * between <w, x> for x in every part and sum h_i(w_i) for any splitting w = sum w_i. */
#ifndef CAPSTAN_TEST_SPLIT_H
#define CAPSTAN_TEST_SPLIT_H

#include "random_expression.h"

enum { SPLIT_PARTS = 5 };

typedef enum SplitKind {
    SPLIT_BALL,
    SPLIT_ELLIPSOID,
    SPLIT_BOX,
    SPLIT_HALF_SPACE,
    SPLIT_STRIP
} SplitKind;

typedef struct SplitPart {
    SplitKind kind;
    double centre[MAX_SPACE];
    double factor[MAX_SPACE * MAX_SPACE];  /* ellipsoid: {centre + F y : |y| <= 1} */
    double inverse[MAX_SPACE * MAX_SPACE]; /* of F */
    double half[MAX_SPACE];                /* box: half sides; ball: its radius */
    double normal[MAX_SPACE], low, high;   /* half-space, strip: low <= <normal, x> <= high */
} SplitPart;

typedef struct SplitBounds {
    double lower, upper;
    double outside; /* largest distance of x from a part */
} SplitBounds;

/* Two to SPLIT_PARTS parts, all round one point, the first one bounded; returns how many. */
int split_random(int n, SplitPart *part);
/* The library's set. */
CpsSet *split_set(int n, const SplitPart *part);
/* Bounds of max <w, .> from a point x that is to attain it. */
SplitBounds split_bounds(int n, int count, const SplitPart *part, const double *w, const double *x);

#endif
