/* SPDX-License-Identifier: BSD-3-Clause */
/* Which obstacle, and which of its feet, a contact of a node sees (seen.h). */
#include "seen.h"

#include "grasps.h"

#include <math.h>

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void widen(const double *a, Real *out) {
    for (int k = 0; k < 3; k++) out[k] = (Real)a[k];
}

void seen_from(const Where *where, const Record *r, size_t j, Real x[3]) {
    widen(node_is_held(r, j) && r->reaction[j] > 0 ? r->position[j] : where->place[j], x);
}

const Surface *seen_surface(const Where *where, const Record *r, size_t j, size_t c) {
    const Source *source = where->source;
    if (source->surfaces == 0 || r->obstacle[c] < 0) return NULL;
    if (c >= r->nodes || !node_is_held(r, j)) return &source->surface[(size_t)r->obstacle[c]];
    Real x[3];
    seen_from(where, r, j, x);
    size_t best = 0;
    for (size_t k = 1; k < source->surfaces; k++)
        if (surface_distance(&source->surface[k], x) < surface_distance(&source->surface[best], x))
            best = k;
    return &source->surface[best];
}

Surface seen_by(const Where *where, const Record *r, size_t j, size_t c) {
    const Surface *on = seen_surface(where, r, j, c);
    if (!on) return (Surface){.kind = SURFACE_KINDS};
    return where->source->touching_only || node_is_held(r, j) ? *on
                                                              : surface_seen(on, r->normal[c]);
}

/* Does contact c stay with its obstacle through the step, whichever are near where it ends? Frozen
 * friction does, and what contact of the reference keeps out. */
static bool stays(const Where *where, const Record *r, size_t c) {
    if (where->source->touching_only) return where->reached && isfinite(r->gap[c]);
    return where->frozen && r->friction_bound[c] > 0;
}

/* Which of the feet of a surface a contact with normal n has: that with the nearest normal. */
static size_t foot_with(size_t feet, Real normal[MESH_FEET][3], const double *n) {
    size_t best = 0;
    Real wide[3];
    widen(n, wide);
    for (size_t i = 1; i < feet; i++)
        if (dot(normal[i], wide) > dot(normal[best], wide)) best = i;
    return best;
}

/* The third contact of node j, at the end of the element before it; 0: none. */
static size_t third_of(const Where *where, const Record *r, size_t j) {
    const size_t c = r->contacts * r->nodes + j - 1;
    if (!r->has_elements || j == 0 || r->obstacle[c] < 0) return 0;
    return surface_may_be_third(&where->source->surface[(size_t)r->obstacle[c]]) ? c : 0;
}

/* Is contact c, which stays, with the nearest obstacle at the reference, or with the next? */
static bool was_in_place(const Where *where, const Record *r, size_t j, size_t c, Real margin) {
    const Surface *surface = where->source->surface;
    const size_t mine = (size_t)r->obstacle[c];
    Real x[3];
    widen(r->reference[j], x);
    const Real distance = surface_distance(&surface[mine], x);
    const size_t third = third_of(where, r, j);
    size_t nearer = 0;
    for (size_t k = 0; k < where->source->surfaces; k++)
        if (k != mine && !(third && r->obstacle[third] == (double)k))
            nearer += distance > surface_distance(&surface[k], x) + margin;
    return nearer <= 1;
}

bool seen_in_place(const Where *where, const Record *r, size_t j, size_t c, Real margin) {
    const size_t other = c == j ? j + r->nodes : j, third = third_of(where, r, j);
    if (stays(where, r, c)) return was_in_place(where, r, j, c, margin);
    const bool skips_other = c != j || stays(where, r, other);
    Real gap[MESH_FEET], normal[MESH_FEET][3];
    Real x[3];
    widen(where->place[j], x);
    const Surface seen = seen_by(where, r, j, c);
    const Real distance = surface_distance(&seen, x);
    for (size_t k = 0; k < where->source->surfaces; k++) {
        const size_t feet = surface_feet(&where->source->surface[k], x, gap, normal);
        const bool is_mine = r->obstacle[c] == (double)k,
                   is_others = r->obstacle[other] == (double)k,
                   is_thirds = third && r->obstacle[third] == (double)k;
        const size_t mine = is_mine ? foot_with(feet, normal, r->normal[c]) : feet,
                     others = is_others ? foot_with(feet, normal, r->normal[other]) : feet,
                     thirds = is_thirds ? foot_with(feet, normal, r->normal[third]) : feet;
        if (is_mine && mine == others) return false;
        for (size_t i = 0; i < feet; i++)
            if (i != mine && i != thirds && (!skips_other || i != others) &&
                distance > gap[i] + margin)
                return false;
    }
    return true;
}
