/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies that their loads turn for ever (docs/theory.md 5a), recomputed from a file. */
#ifndef CAPSTAN_CHECKER_TURNING_H
#define CAPSTAN_CHECKER_TURNING_H

#include "bodies.h"

/* A body that claims it, in a step. */
typedef struct Turning {
    const Source *source;
    const Bodies *bodies;
    const Record *line; /* (lines) */
    const BodyState *at;
    size_t body;
    double given[SIX];  /* the given load, and */
    double pull[3];     /* gravity, per that of the scene */
    bool other_moments; /* of the water on members, or of inertia: there is no proof */
} Turning;

/* What is wrong with the claim, in `sentence`; NULL: nothing. */
const char *turning_fault(const Turning *of, char *sentence, size_t bytes);

#endif
