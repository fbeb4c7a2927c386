/* SPDX-License-Identifier: BSD-3-Clause */
/* The recession cone of a set: its rows "X in t C" at t = 0 (conic_rows.c). */
#include <stdlib.h>

#include "set/set.h"

CpsStatus cpsi_set_recession(const CpsSet *set, CpsSet **out, CpsError *err) {
    const size_t n = (size_t)set->n;
    CpsiCount count = {.unknowns = n};
    cpsi_conic_rows_count(set, &count);
    CpsiConicRows *conic = NULL;
    CpsiConicForm *form = NULL;
    bool touching = false;
    CpsStatus status = cpsi_conic_rows_new(count, (int)n, &conic, err);
    if (status) return status;
    double *x = calloc((n + 1) * (size_t)conic->width, sizeof *x),
           *t = x ? x + n * (size_t)conic->width : NULL;
    for (size_t i = 0; x && i < n; i++) x[i * (size_t)conic->width + i] = 1;
    if (!x || !cpsi_conic_rows_write(conic, set, x, t))
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a recession cone");
    else
        status = cpsi_conic_form_reduce(conic, (int)n, x, 0, NULL, 1e-11, &form, err);
    free(x);
    cpsi_conic_rows_free(conic);
    /* for a bounded set only 0 remains, which has no interior */
    if (!status) status = cpsi_conic_form_deepen(&form, &touching, err);
    if (!status) return cpsi_set_from_conic_form(form, out, err);
    cpsi_conic_form_free(form);
    return status;
}
