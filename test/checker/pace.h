/* SPDX-License-Identifier: BSD-3-Clause */
/* By how much steps in time are wrong by themselves. */
#ifndef CAPSTAN_CHECKER_PACE_H
#define CAPSTAN_CHECKER_PACE_H

#include "inertia.h"

/* The error of a step, of what moves freely in it, from `least` to `most` where it is not known
 * what bears, and what rounding leaves of that. */
typedef struct StepError {
    double least, most,
        noise; /* [m]; noise INFINITY: the steps before it that it needs are not on file */
} StepError;

/* Is it what the file says? */
bool pace_agrees(double said, const StepError *own);

/* Of all steps of a file, (steps); 0 of quasi-static ones. Returns 0, or -1 after one sentence on
 * log. */
int pace_errors(const Source *source, StepError *out, FILE *log);

/* What the file says of them; 0 of steps whose length is given. Returns as pace_errors. */
int pace_said(const Source *source, double *out, FILE *log);

/* Whether times are sums of the lengths of steps, and errors of steps are what the file says, where
 * it says something: one finding per step. Returns as pace_errors. */
int pace_check(const Source *source, InertiaFind *find, void *user, FILE *log);

#endif
