/* SPDX-License-Identifier: BSD-3-Clause */
/* Proofs that lines which meet at points have no equilibrium (docs/theory.md 5a), recomputed from a
 * file: what one of them claims is a claim of all that free points connect with it. */
#ifndef CAPSTAN_CHECKER_GROUPS_H
#define CAPSTAN_CHECKER_GROUPS_H

#include "bodies.h"
#include "points.h"

/* Does the record claim a proof that is that of its group? */
bool groups_claim(const Record *r);

/* The lines and points of a step. */
typedef struct GroupStep {
    const Source *source;
    const Record *line;     /* (lines) */
    const Junction *now;    /* (points) */
    const Junction *before; /* (points) after the step before; NULL in the first one */
    const bool *gives;      /* (points) it floats, or is an anchor that drags: there is no proof */
    const Bodies *bodies;
    const BodyState *body; /* (bodies) */
    size_t step;
    PointFinding *find;
    void *user;
} GroupStep;

/* Check all such claims of a step; findings are at a point of the group. Returns 0, or -1 where
 * there is no memory. */
int groups_check(const GroupStep *step, FILE *log);

#endif
