/* SPDX-License-Identifier: BSD-3-Clause */
/* The reduced conic form of a set (form.h), handed out. */
#include "set/node.h"

CpsStatus cps_set_conic(const CpsSet *set, CpsSetConic *conic, CpsError *err) {
    if (!set || !conic) return cpsi_fail(err, CPS_ERR_ARGUMENT, "cps_set_conic: set and conic are both needed");
    if (cpsi_set_has_user(set)) {
        *conic = (CpsSetConic){.outcome = CPS_SET_NOT_AVAILABLE};
        return CPS_OK;
    }
    CpsiForm *form = NULL;
    const CpsStatus status = cpsi_form_make(set, &form, err);
    if (status) return status;
    if (form->empty || form->lines > 0) {
        *conic = (CpsSetConic){.outcome = form->empty ? CPS_SET_EMPTY : CPS_SET_UNBOUNDED};
        cpsi_form_free(form);
        return CPS_OK;
    }
    *conic = (CpsSetConic){.space = form->n, .unknowns = form->unknowns, .rows = form->rows, .cones = form->cones,
                           .dim = form->dim, .origin = form->origin, .p = form->p, .a = form->a, .b = form->b,
                           .owner = form};
    return CPS_OK;
}

void cps_set_conic_free(CpsSetConic *conic) {
    if (!conic) return;
    cpsi_form_free(conic->owner);
    *conic = (CpsSetConic){0};
}
