/* SPDX-License-Identifier: BSD-3-Clause */
/* How sharply a line turns round an obstacle at one contact, and what that does to the law of
 * friction. */
#ifndef CAPSTAN_CHECKER_BEND_H
#define CAPSTAN_CHECKER_BEND_H

#include "record.h"

typedef struct Bend {
    double turn, friction; /* of the contact where the ratio of tensions is farthest from exp(mu d);
                              0 without any */
    double ratio;          /* that it holds; INFINITY: any */
    double there;          /* the turn at the arc length that the file names */
} Bend;

/* The sharpest bend of a record, the axes of friction those of the configuration reached or of the
 * reference; a force below 1e-9 of the largest has the direction of its element if that is
 * stretched to its length, and none otherwise. */
Bend bend_of_record(const Source *source, const Record *record, bool reached, double largest_force);

#endif
