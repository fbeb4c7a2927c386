/* SPDX-License-Identifier: BSD-3-Clause */
/* The position of 0 in a set, as far as the expression of the set shows it. */
#include <math.h>
#include <string.h>

#include "linalg/dense.h"
#include "set/set.h"

/* From a closed margin, with a ball round 0. A box or product that is flat in some components may
 * still have 0 in its relative interior. */
static CpsiZero known_primitive(const CpsSet *set, const double *zero) {
    const double least = 1e-7 * cpsi_set_size(set);
    double margin;
    bool relative = true;
    switch (set->kind) {
    case CPSI_SET_SUBSPACE: return CPSI_ZERO_RELATIVE;
    case CPSI_SET_RAYS:
    case CPSI_SET_POLAR: return CPSI_ZERO_INSIDE;
    case CPSI_SET_POINTS:
        if (set->hull) {
            for (int i = 0; i < set->n - set->hull->dimension; i++)
                if (fabs(set->hull->level[i]) > 1e-14 * set->hull->size) return CPSI_ZERO_UNKNOWN;
            margin = cpsi_hull_margin(set->hull, zero);
            return margin > least ? CPSI_ZERO_RELATIVE
                   : margin >= 0  ? CPSI_ZERO_INSIDE
                                  : CPSI_ZERO_UNKNOWN;
        }
        if (set->count != 1 || cpsi_norm(set->n, set->a) > 0) return CPSI_ZERO_UNKNOWN;
        return CPSI_ZERO_RELATIVE;
    case CPSI_SET_BOX:
        for (int i = 0; i < set->n; i++) {
            if (set->a[i] > 0 || set->b[i] < 0) return CPSI_ZERO_UNKNOWN;
            relative = relative &&
                       ((set->a[i] == 0 && set->b[i] == 0) || fmin(-set->a[i], set->b[i]) > least);
        }
        return relative ? CPSI_ZERO_RELATIVE : CPSI_ZERO_INSIDE;
    case CPSI_SET_ELLIPSOID: {
        double square = 0;
        for (int i = 0; i < set->n; i++) {
            const double c = cpsi_dot(i + 1, &set->c[(size_t)i * (size_t)set->n], set->a);
            square += c * c;
        }
        return square < 1 - 1e-7 ? CPSI_ZERO_RELATIVE
               : square <= 1     ? CPSI_ZERO_INSIDE
                                 : CPSI_ZERO_UNKNOWN;
    }
    case CPSI_SET_BALL:
        if (set->scalar == 0 && cpsi_norm(set->n, set->a) == 0) return CPSI_ZERO_RELATIVE;
        break;
    default: break;
    }
    if (!cpsi_closed_margin(set, zero, NULL, &margin) || margin < 0) return CPSI_ZERO_UNKNOWN;
    return margin > least ? CPSI_ZERO_RELATIVE : CPSI_ZERO_INSIDE;
}

/* Relative interiors are preserved by sums, products, images, hulls and, where they have a common
 * point, by intersections and preimages (Rockafellar 1970, 6.4-6.9): what holds for all parts holds
 * for the whole. */
static CpsiZero known_zero(const CpsSet *set, const double *zero) {
    CpsiZero least = CPSI_ZERO_RELATIVE;
    switch (set->kind) {
    case CPSI_SET_PREIMAGE:
        if (cpsi_norm(set->part[0]->n, set->b) > 0) return CPSI_ZERO_UNKNOWN;
        break;
    case CPSI_SET_PRODUCT:
    case CPSI_SET_INTERSECTION:
    case CPSI_SET_IMAGE:
    case CPSI_SET_SUM:
    case CPSI_SET_SCALE:
    case CPSI_SET_HULL: break;
    default: return known_primitive(set, zero);
    }
    for (int k = 0; k < set->count && least > CPSI_ZERO_UNKNOWN; k++) {
        const CpsiZero part = known_zero(set->part[k], zero);
        least = part < least ? part : least;
    }
    return least;
}

/* The largest dimension of the spaces of the set and its parts. */
static size_t most_components(const CpsSet *set) {
    size_t most = (size_t)set->n;
    for (int k = 0; set->part && k < set->count; k++) {
        const size_t part = most_components(set->part[k]);
        most = part > most ? part : most;
    }
    return most;
}

CpsStatus cpsi_set_locate_zero(const CpsSet *set, CpsiZero *known, CpsError *err) {
    CpsiScratch scratch;
    const size_t most = most_components(set);
    double *zero = cpsi_scratch_take(&scratch, most);
    if (!zero) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    memset(zero, 0, most * sizeof *zero);
    *known = known_zero(set, zero);
    cpsi_scratch_give(&scratch);
    return CPS_OK;
}
