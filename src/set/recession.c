/* SPDX-License-Identifier: BSD-3-Clause */
/* The recession cone of a set: its rows "X in t C" at t = 0 (conic_make.c). */
#include "set/set.h"

CpsStatus cpsi_set_recession(const CpsSet *set, CpsSet **out, CpsError *err) {
    CpsiConicForm *form = NULL;
    bool touching = false;
    CpsStatus status = cpsi_conic_form_make(set, 0, &form, err);
    if (status) return status;
    /* for a bounded set only 0 remains, which has no interior */
    status = cpsi_conic_form_reduce_to_face(&form, &touching, err);
    if (!status) return cpsi_set_from_conic_form(form, out, err);
    cpsi_conic_form_free(form);
    return status;
}
