/* SPDX-License-Identifier: BSD-3-Clause */
/* The numbers that a scene may have, the length of an element of its lines and the letter of an
 * end. */
#ifndef CAPSTAN_SRC_EVOLVE_RANGES_H
#define CAPSTAN_SRC_EVOLVE_RANGES_H

#include <math.h>
#include <stdbool.h>

#include "base/vec3.h"
#include "capstan/scene.h"

/* Numbers whose squares and products would overflow count as infinite; lengths whose squares would
 * underflow count as zero. */
#define CPSI_LARGEST_INPUT  1e100
#define CPSI_SMALLEST_INPUT 1e-100

static inline bool cpsi_is_usable(double x) { return fabs(x) <= CPSI_LARGEST_INPUT; }
static inline bool cpsi_are_usable(const double x[3]) {
    return cpsi_is_usable(x[0]) && cpsi_is_usable(x[1]) && cpsi_is_usable(x[2]);
}
static inline bool cpsi_is_positive(double x) {
    return x >= CPSI_SMALLEST_INPUT && x <= CPSI_LARGEST_INPUT;
}
static inline bool cpsi_is_not_negative(double x) { return x >= 0 && x <= CPSI_LARGEST_INPUT; }
static inline bool cpsi_is_direction(const double x[3]) {
    return cpsi_are_usable(x) && vec3_norm(vec3_load(x)) >= CPSI_SMALLEST_INPUT;
}

/* [m] Natural length of element e. */
static inline double cpsi_element_length(const CpsLine *line, int e) {
    return line->element_length ? line->element_length[e] : line->length / line->element_count;
}

/* [m] Natural length that is off the drums of its winches when the history begins. */
static inline double cpsi_length_off_drums(const CpsLine *line) {
    return line->length - line->winch[CPS_END_A].stored - line->winch[CPS_END_B].stored;
}

static inline const char *cpsi_end_letter(int end) { return end == CPS_END_A ? "A" : "B"; }

#endif
