/* SPDX-License-Identifier: BSD-3-Clause */
/* The recession cone of a set: its rows "X in t C" at t = 0 (emit.c). */
#include <stdlib.h>

#include "set/node.h"

CpsStatus cpsi_set_recession(const CpsSet *set, CpsSet **out, CpsError *err) {
    const size_t n = (size_t)set->n;
    CpsiCount count = {.unknowns = n};
    cpsi_raw_count(set, &count);
    CpsiRaw *raw = NULL;
    CpsiForm *form = NULL;
    bool touching = false;
    CpsStatus status = cpsi_raw_new(count, (int)n, &raw, err);
    if (status) return status;
    double *x = calloc((n + 1) * (size_t)raw->width, sizeof *x),
           *t = x ? x + n * (size_t)raw->width : NULL;
    for (size_t i = 0; x && i < n; i++) x[i * (size_t)raw->width + i] = 1;
    if (!x || !cpsi_raw_emit(raw, set, x, t))
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a recession cone");
    else
        status = cpsi_form_reduce(raw, (int)n, x, 0, NULL, 1e-11, &form, err);
    free(x);
    cpsi_raw_free(raw);
    /* of a bounded set 0 alone is left, in no interior */
    if (!status) status = cpsi_form_deepen(&form, &touching, err);
    if (!status) return cpsi_set_from_form(form, out, err);
    cpsi_form_free(form);
    return status;
}
