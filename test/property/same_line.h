/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether two evolutions agree to the last bit. */
#ifndef CAPSTAN_TEST_SAME_LINE_H
#define CAPSTAN_TEST_SAME_LINE_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "capstan/motion.h"

static inline bool same_numbers(const double *a, const double *b, int count) {
    return memcmp(a, b, (size_t)count * sizeof *a) == 0;
}

/* Line i of one evolution and line j of the other: iterations, positions and forces. */
static inline bool same_line(const CpsEvolution *one, int i, const CpsEvolution *other, int j) {
    const CpsLineView a = cps_evolution_line_view(one, i), b = cps_evolution_line_view(other, j);
    const int elements = a.element_count, nodes = elements + 1, contacts = a.contact_count * nodes;
    return cps_evolution_line_report(one, i).iteration_count ==
               cps_evolution_line_report(other, j).iteration_count &&
           same_numbers(a.position, b.position, 3 * nodes) &&
           same_numbers(a.tension, b.tension, elements) &&
           same_numbers(a.segment_force, b.segment_force, 3 * elements) &&
           same_numbers(a.reaction, b.reaction, contacts) &&
           same_numbers(a.friction_force, b.friction_force, 3 * contacts);
}

/* Their motions, of a scene in time. */
static inline bool same_motion(const CpsEvolution *one, int i, const CpsEvolution *other, int j) {
    const CpsLineMotion a = cps_evolution_line_motion(one, i),
                        b = cps_evolution_line_motion(other, j);
    const int nodes = cps_evolution_line_view(one, i).element_count + 1;
    if (a.is_moving != b.is_moving || memcmp(&a.ledger, &b.ledger, sizeof a.ledger) != 0)
        return false;
    return !a.mass ||
           (a.kinetic == b.kinetic && same_numbers(a.velocity, b.velocity, 3 * nodes) &&
            same_numbers(a.before, b.before, 3 * nodes) && same_numbers(a.span, b.span, nodes) &&
            same_numbers(a.rest_velocity, b.rest_velocity, 3 * nodes));
}

/* The state of an evolution, to be freed. */
static inline unsigned char *saved_state(const CpsEvolution *evolution, size_t *size) {
    *size = cps_evolution_state_size(evolution);
    unsigned char *state = malloc(*size);
    if (!state) exit(1);
    cps_evolution_save(evolution, state);
    return state;
}

#endif
