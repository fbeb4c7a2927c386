/* SPDX-License-Identifier: BSD-3-Clause */
/* Public access to the reduced conic form of a set (conic_form.h), and sets made by writing one. */
#include <math.h>

#include "set/set.h"

CpsStatus cps_set_conic(const CpsSet *set, CpsSetConic *conic, CpsError *err) {
    if (!set || !conic) return cpsi_fail(err, CPS_ERR_ARGUMENT, "set and conic are both needed");
    if (cpsi_set_has_user(set)) {
        *conic = (CpsSetConic){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
        return CPS_OK;
    }
    CpsiConicForm *form = NULL;
    const CpsStatus status = cpsi_conic_form_make(set, 1, &form, err);
    if (status) return status;
    if (form->empty || form->lines > 0) {
        *conic = (CpsSetConic){.outcome =
                                   form->empty ? CPS_SET_OUTCOME_EMPTY : CPS_SET_OUTCOME_UNBOUNDED};
        cpsi_conic_form_free(form);
        return CPS_OK;
    }
    *conic = (CpsSetConic){.space = form->n,
                           .unknown_count = form->unknowns,
                           .row_count = form->rows,
                           .cone_count = form->cones,
                           .dim = form->dim,
                           .origin = form->origin,
                           .p = form->p,
                           .a = form->a,
                           .b = form->b,
                           .owner = form};
    return CPS_OK;
}

CpsStatus cps_set_friction_cone(int n, double friction, CpsSet **out, CpsError *err) {
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL, expected a place for the set");
    if (n < 2 || n > CPS_SET_MAX_SPACE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "n is %d, expected 2 to %d", n, CPS_SET_MAX_SPACE);
    if (!(friction >= 0) || !isfinite(friction))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "friction is %g, expected a finite number >= 0",
                         friction);
    CpsiConicForm *form = cpsi_conic_form_new(n, n, 0, n, 1);
    if (!form) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a cone");
    /* x = (friction v, N), |v| <= N */
    for (int i = 0; i < n; i++) {
        form->p[(size_t)i * (size_t)n + (size_t)i] = i < n - 1 ? friction : 1;
        form->a[(size_t)(i < n - 1 ? i + 1 : 0) * (size_t)n + (size_t)i] = 1;
    }
    form->dim[0] = n;
    form->rows = n;
    form->cones = 1;
    form->largest_cone = n;
    return cpsi_set_from_conic_form(form, out, err);
}

void cps_set_conic_clear(CpsSetConic *conic) {
    if (!conic) return;
    cpsi_conic_form_free(conic->owner);
    *conic = (CpsSetConic){0};
}
