/* SPDX-License-Identifier: BSD-3-Clause */
/* The line that small tests begin with. */
#ifndef CAPSTAN_TEST_STRAIGHT_ROPE_H
#define CAPSTAN_TEST_STRAIGHT_ROPE_H

#include "capstan/scene.h"

/* A rope that starts straight between two points, which the caller keeps. */
static inline CpsLine straight_rope(const double point[6], double length, int elements,
                                    double weight, double stiffness) {
    CpsLine line = cps_line_default();
    line.name = "rope";
    line.length = length;
    line.element_count = elements;
    line.weight = weight;
    line.stiffness = stiffness;
    line.start =
        (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = point, .axis = {0, 0, 1}};
    return line;
}

#endif
