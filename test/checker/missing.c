/* SPDX-License-Identifier: BSD-3-Clause */
/* Values of a record that cannot be (missing.h). */
#include "missing.h"

#include <math.h>

static bool all_within(const double *value, size_t count, double low, double high) {
    for (size_t i = 0; i < count; i++) {
        if (!(value[i] >= low && value[i] <= high)) return false;
    }
    return true;
}

/* The first variable with a value that cannot be. Infinite may be: the gap to an obstacle that is
 * not looked for; NaN must be what is not imposed on an end, and may be the rms bound. */
const char *missing_variable(const Record *r) {
    const double most = 1.7976931348623157e308, tiny = 4.9e-324;
    const bool place[2] = {r->end_kind[0] == END_HELD, r->end_kind[1] == END_HELD}; /* is imposed */
    size_t n = r->nodes, m = r->elements, all = r->contacts * n + (r->has_elements ? m : 0);
    const struct {
        const char *name;
        const double *value;
        size_t count;
        double low, high;
    } table[] = {
        {"element_length", r->element_length, m, tiny, most},
        {"compliance", &r->compliance, 1, 0, most},
        {"reference", r->reference[0], 3 * n, -most, most},
        {"position", r->position[0], 3 * n, -most, most},
        {"load", r->load[0], 3 * n, -most, most},
        {"normal", r->normal[0], 3 * all, -most, most},
        {"friction_force", r->friction[0], 3 * all, -most, most},
        {"slip", r->slip[0], 3 * all, -most, most},
        {"segment_force", r->segment_force[0], 3 * m, -most, most},
        {"tension", r->tension, m, -most, most},
        {"friction_bound", r->friction_bound, all, 0, most},
        {"reaction", r->reaction, all, -most, most},
        {"contact_gap", r->gap, all, -most, INFINITY},
        {"end_held_position", r->held_position[0], place[0] ? 3 : 0, -most, most},
        {"end_held_position", r->held_position[1], place[1] ? 3 : 0, -most, most},
        {"end_applied_force", r->applied_force[0], place[0] ? 0 : 3, -most, most},
        {"end_applied_force", r->applied_force[1], place[1] ? 0 : 3, -most, most},
        {"end_force", r->end_force[0], 6, -most, most},
        {"end_friction_force", r->end_friction_force[0], 6, -most, most},
        {"end_tension", r->end_tension, 2, 0, most},
        {"element_share", r->share_of, r->has_elements ? m : 0, 0, 1},
        {"proof", r->proof, 3, -most, most},
        {"motion", r->motion ? r->motion[0] : NULL, r->motion ? 3 * n : 0, -most, most},
        {"proof_length", &r->proof_length, 1, 0, most},
        {"proof_force", &r->proof_force, 1, 0, most},
        {"dissipated", &r->dissipated, 1, -most, most},
        {"unaccounted", &r->unaccounted, 1, 0, most},
        {"bend_turn", &r->bend_turn, 1, 0, most},
        {"bend_friction", &r->bend_friction, 1, 0, most},
        {"bend_at", &r->bend_at, 1, 0, most},
        {"ledger", r->ledger, LEDGER_ENTRIES, -most, most},
    };
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        if (!all_within(table[k].value, table[k].count, table[k].low, table[k].high))
            return table[k].name;
    }
    for (int k = 0; k < 6; k++) {
        const int e = k / 3;
        if (!isnan(place[e] ? r->applied_force[e][k % 3] : r->held_position[e][k % 3]))
            return place[e] ? "end_applied_force" : "end_held_position";
    }
    for (int k = 0; k < CLAIMS; k++) {
        bool may_miss = k == CLAIM_TENSION_BOUND && isnan(r->claim[k]);
        if (!isfinite(r->claim[k]) && !may_miss) return CLAIM_NAME[k];
    }
    return NULL;
}
