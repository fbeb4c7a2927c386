/* SPDX-License-Identifier: BSD-3-Clause */
/* Random conic programs of the sparse solver, and how well an answer solves them.
 *
 * A program min c.x, E x + h = 0, A_k x_k + b_k in K_k has blocks of 1 to 4 unknowns, each in one
 * second-order cone and half of them in a half-line too, and one equation of four unknowns for
 * every two unknowns: near each other (banded), or anywhere. The last unknowns may be in no block,
 * and the last equations may repeat others. c, h and b are chosen so that interior points x, s
 * and z exist; therefore there is a solution. */
#ifndef CAPSTAN_TEST_RANDOM_PROGRAM_H
#define CAPSTAN_TEST_RANDOM_PROGRAM_H

#include <stdbool.h>
#include <stdint.h>

#include "conic/sparse_program.h"

/* The least number of unknowns. */
enum { RANDOM_PROGRAM_LEAST = 16 };

typedef struct RandomProgramKind {
    int unknowns;
    bool banded;
    int loose;    /* unknowns in no block */
    int repeated; /* equations that stand twice */
} RandomProgramKind;

typedef struct RandomProgram {
    CpsiSparseData data; /* points into the arrays */
    CpsiBlock *block;
    int *dim, *column;
    size_t *start;
    double *a, *b, *c, *h, *value;
    int rows;
} RandomProgram;

/* Ends the process when memory does not suffice. */
RandomProgram random_program_new(const RandomProgramKind *kind, uint64_t seed);
void random_program_free(RandomProgram *made);

/* The largest of what an answer misses: E x + h, c - A'z - E'y, the distances of A x + b and z to
 * their cones, and c.x + h.y + b.z over 1 + |c.x|. NaN counts as infinite. */
double random_program_error(const RandomProgram *made, const CpsiConicResult *found);

#endif
