/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether a set is polyhedral by construction. Images, sums, hulls, polars and preimages of
 * polyhedra are polyhedra (Rockafellar 19), so the leaves of the expression decide. A set of
 * dimension 1 is an interval, however it was constructed. */
#include "law/law.h"
#include "set/set.h"

bool cpsi_law_polyhedral(const CpsSet *set) {
    if (set->n == 1) return true;
    switch (set->kind) {
    case CPSI_SET_BALL: return !(set->scalar > 0);
    case CPSI_SET_ELLIPSOID:
    case CPSI_SET_USER:
    case CPSI_SET_CONIC: return false;
    case CPSI_SET_POINTS:
    case CPSI_SET_BOX:
    case CPSI_SET_INEQUALITIES:
    case CPSI_SET_SUBSPACE:
    case CPSI_SET_RAYS: return true;
    default: break;
    }
    for (int i = 0; i < set->count; i++)
        if (!cpsi_law_polyhedral(set->part[i])) return false;
    return true;
}
