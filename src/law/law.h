/* SPDX-License-Identifier: BSD-3-Clause */
/* The content of a friction law, and checks that its files share. */
#ifndef CAPSTAN_SRC_LAW_LAW_H
#define CAPSTAN_SRC_LAW_LAW_H

#include <math.h>
#include <stdatomic.h>

#include "capstan/law.h"
#include "linalg/dense.h"

/* C, and the factors of which it is a product (itself if it is none), because the composition rule
 * examines each factor separately. */
struct CpsLaw {
    atomic_int refcount;
    CpsSet *set;
    int factor_count;
    CpsSet *factor[]; /* (factor_count), each retained */
};

/* are all components finite numbers? */
static inline bool cpsi_all_finite(int n, const double *a) {
    for (int i = 0; i < n; i++)
        if (!isfinite(a[i])) return false;
    return true;
}

/* CPS_OK, or CPS_ERR_ARGUMENT with a message that calls the vector `what`. */
CpsStatus cpsi_law_check_vector(const char *what, int n, const double *a, CpsError *err);

/* Whether the set is polyhedral by construction. */
bool cpsi_law_polyhedral(const CpsSet *set);

#endif
