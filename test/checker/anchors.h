/* SPDX-License-Identifier: BSD-3-Clause */
/* Anchors in a file: their capacities, and how they have given way. */
#ifndef CAPSTAN_TEST_CHECKER_ANCHORS_H
#define CAPSTAN_TEST_CHECKER_ANCHORS_H

#include "record.h"

typedef struct Anchor {
    double capacity, limit; /* [N] 0: not given */
    bool drags;
    double capacity_used, uplift_used, drag[3], dragged; /* of a step */
} Anchor;

/* What does not change; nothing in files that do not say. */
int anchors_open(const Source *source, Anchor *all, FILE *log);
int anchors_read(const Source *source, size_t step, Anchor *all, FILE *log);

#endif
