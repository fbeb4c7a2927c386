/* SPDX-License-Identifier: BSD-3-Clause */
/* What a friction law is inside, and checks that its files share. */
#ifndef CAPSTAN_SRC_LAW_LAW_H
#define CAPSTAN_SRC_LAW_LAW_H

#include <math.h>
#include <stdatomic.h>

#include "capstan/law.h"
#include "linalg/dense.h"

/* C, and the factors it is a product of (itself, where it is none): the composition rule looks at
 * each on its own. */
struct CpsLaw {
    atomic_int refcount;
    CpsSet *set;
    int factor_count;
    CpsSet *factor[]; /* (factor_count), each with a hold */
};

/* are all components finite numbers? */
static inline bool cpsi_all_finite(int n, const double *a) {
    for (int i = 0; i < n; i++)
        if (!isfinite(a[i])) return false;
    return true;
}

/* CPS_OK, or CPS_ERR_ARGUMENT with a message that calls the vector `what`. */
CpsStatus cpsi_law_check_vector(const char *what, int n, const double *a, CpsError *err);

/* Is the set polyhedral by construction? */
bool cpsi_law_polyhedral(const CpsSet *set);

#endif
