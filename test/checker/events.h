/* SPDX-License-Identifier: BSD-3-Clause */
/* What happens in a step in time, read anew from positions, reactions and slips of the file. */
#ifndef CAPSTAN_CHECKER_EVENTS_H
#define CAPSTAN_CHECKER_EVENTS_H

#include "record.h"

typedef struct Events {
    int steps;    /* in time */
    int landed;   /* contacts without a reaction that have one after the step */
    int changed;  /* contacts with one before and after that go from rest to sliding or back */
    int snatched; /* elements shorter than at rest that are not so after the step */
    double imbalance, turnover; /* [J] sums of the sizes of imbalances and of all other entries */
} Events;

/* Add what happens between two steps of a line; nothing where the second is not in time. */
void events_add(const Record *r, const Record *before, Events *sum);

#endif
