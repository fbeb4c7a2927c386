/* SPDX-License-Identifier: BSD-3-Clause */
/* The reduced form of a set (conic_form.h): its rows are written (conic_rows.c) and then reduced
 * (conic_form.c). */
#include <stdlib.h>

#include "base/status.h"
#include "set/conic_form.h"

CpsStatus cpsi_conic_form_make(const CpsSet *set, double scale, CpsiConicForm **out,
                               CpsError *err) {
    const size_t n = (size_t)cps_set_space(set);
    CpsiCount count = {.unknowns = n};
    cpsi_conic_rows_count(set, &count);
    CpsiConicRows *conic = NULL;
    CpsStatus status = cpsi_conic_rows_new(count, (int)n, &conic, err);
    if (status) return status;
    double *x = calloc((n + 1) * (size_t)conic->width, sizeof *x),
           *t = x ? x + n * (size_t)conic->width : NULL;
    if (x) {
        for (size_t i = 0; i < n; i++) x[i * (size_t)conic->width + i] = 1;
        t[conic->unknowns] = scale;
    }
    if (!x || !cpsi_conic_rows_write(conic, set, x, t))
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a set's conic form");
    else
        status = cpsi_conic_form_reduce(conic, (int)n, x, 0, NULL, 1e-11, out, err);
    free(x);
    cpsi_conic_rows_free(conic);
    return status;
}
