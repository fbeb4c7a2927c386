/* SPDX-License-Identifier: BSD-3-Clause */
/* The reduced form of a set (form.h): its rows are written (emit.c), then reduced (form.c). */
#include <stdlib.h>

#include "base/status.h"
#include "set/form.h"

CpsStatus cpsi_form_make(const CpsSet *set, CpsiForm **out, CpsError *err) {
    const size_t n = (size_t)cps_set_space(set);
    CpsiCount count = {.unknowns = n};
    cpsi_raw_count(set, &count);
    CpsiRaw *raw = NULL;
    CpsStatus status = cpsi_raw_new(count, (int)n, &raw, err);
    if (status) return status;
    double *x = calloc((n + 1) * (size_t)raw->width, sizeof *x),
           *t = x ? x + n * (size_t)raw->width : NULL;
    if (x) {
        for (size_t i = 0; i < n; i++) x[i * (size_t)raw->width + i] = 1;
        t[raw->unknowns] = 1;
    }
    if (!x || !cpsi_raw_emit(raw, set, x, t))
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a set's conic form");
    else
        status = cpsi_form_reduce(raw, (int)n, x, 0, NULL, 1e-11, out, err);
    free(x);
    cpsi_raw_free(raw);
    return status;
}
