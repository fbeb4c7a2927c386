/* SPDX-License-Identifier: BSD-3-Clause */
/* Random set expressions with a known point, for the property tests; and the random numbers they
 * are made of. */
#ifndef CAPSTAN_TEST_RANDOM_EXPRESSION_H
#define CAPSTAN_TEST_RANDOM_EXPRESSION_H

#include <stdbool.h>
#include <stdint.h>

#include "capstan/set.h"

enum { MAX_SPACE = 6, MAX_DEPTH = 4 };

/* ---- random numbers: splitmix64, one stream per case ---- */

void random_seed(uint64_t number);
double uniform(double low, double high);
int below(int bound);
void fill(int count, double size, double *out); /* uniform in -size .. size */

/* ---- vectors ---- */

double dot(int n, const double *a, const double *b);
double norm(int n, const double *a);
/* out = L x (sign 1), L (rows x columns); L'x (sign -1) */
void times(int rows, int columns, const double *map, int sign, const double *x, double *out);
/* The inverse of a (n x n) by Gauss and Jordan with row exchanges; false where a pivot is not above
 * the share `least` of a's size. */
bool invert(int n, const double *a, double least, double *out);

/* A call that must work: ends the test with the message where it does not. */
#define DO(call) done_((call), #call, __FILE__, __LINE__)
extern CpsError err;
void done_(CpsStatus status, const char *text, const char *file, int line);

/* ---- expressions ---- */

/* A set with one hold, and a point of its relative interior. */
typedef struct Sample {
    CpsSet *set;
    double inside[MAX_SPACE];
} Sample;

/* A primitive in R^n: ball, ellipsoid, box, polytopes by points and by inequalities, segment,
 * point; where it need not be bounded also half-space, strip, subspace, cone of rays. */
Sample random_primitive(int n, bool bounded);

/* An expression of at most `depth` operations above each other: products, intersections, sums,
 * images, translates, scales, hulls, preimages, polars. The parts of an intersection share a point
 * of their relative interiors, so that none is empty. Where it is to be bounded, what need not be
 * is cut with a ball. */
Sample random_expression(int n, int depth, bool bounded);

/* A bounded one with 0 well inside: a ball round 0 is added. */
CpsSet *random_round_zero(int n, int depth);

/* ---- answers ---- */

/* A case ends answered and right; refused for the reason that was due; open
 * (CPS_SET_OUTCOME_INACCURATE); or wrong. */
typedef enum Result { ANSWERED, REFUSED, OPEN, WRONG } Result;

/* "--seed S" or "--cases N" from the command line; false where it is neither. */
bool random_cases(int argc, char **argv, uint64_t *first, uint64_t *count);

#endif
