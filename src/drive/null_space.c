/* SPDX-License-Identifier: BSD-3-Clause */
/* Dense bases of free velocities and of forces in equilibrium. */
#include "drive/null_space.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"

/* A velocity is resisted by no law where its row is below this share: rounding of the given
 * numbers. */
static const double DEPENDENT = 1e-11;
/* Products below this share of their factors are rounding. */
static const double ROUNDING = 1e-13;
/* A load is contradictory where the part that nothing can balance exceeds this share; rounding
 * leaves less. */
static const double CONTRADICTION = 1e-9;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for dense maps");
}

void cpsi_dense_clear(CpsiDense *dense) {
    free(dense->map);
    free(dense->all);
    free(dense->force_all);
    free(dense->start);
    *dense = (CpsiDense){0};
}

void cpsi_dense_round(size_t count, double size, double *a) {
    for (size_t i = 0; i < count; i++)
        if (fabs(a[i]) <= ROUNDING * size) a[i] = 0;
}

/* The forces in equilibrium: the null space of the rows B N_j, and a solution for the load. */
static CpsStatus balance(const CpsSystem *system, CpsiDense *d, CpsError *err) {
    const size_t n = (size_t)d->n, c = (size_t)d->components, q = (size_t)d->free,
                 high = q > c ? q : c;
    double *rows = calloc(high * c + 1, sizeof *rows), *rhs = calloc(q + 1, sizeof *rhs);
    d->force_all = rows;
    d->start = calloc(c + 1, sizeof *d->start);
    CpsStatus status = rows && rhs && d->start ? CPS_OK : out_of_memory(err);
    double largest = 0, load = system->load ? cpsi_norm(d->n, system->load) : 0;
    for (size_t i = 0; i < c; i++) largest = fmax(largest, cpsi_norm(d->n, &d->map[i * n]));
    if (status == CPS_OK)
        for (size_t j = 0; j < q; j++) {
            for (size_t i = 0; i < c; i++) {
                rows[j * c + i] = cpsi_dot(d->n, &d->map[i * n], &d->kernel[j * n]);
                cpsi_dense_round(1, cpsi_norm(d->n, &d->map[i * n]), &rows[j * c + i]);
            }
            rhs[j] = system->load ? -cpsi_dot(d->n, system->load, &d->kernel[j * n]) : 0;
            /* A direction without resistance must carry no load; the remainder of an eliminated row
             * measures rounding. */
            if (cpsi_norm(d->components, &rows[j * c]) > DEPENDENT * largest) continue;
            memset(&rows[j * c], 0, c * sizeof *rows);
            if (fabs(rhs[j]) > CONTRADICTION * load) d->contradiction = true;
            rhs[j] = 0;
        }
    if (status == CPS_OK && c > 0) {
        const int rank = cpsi_orthonormal_rows(d->free, d->components, rows, rhs, DEPENDENT);
        for (size_t j = (size_t)rank; j < q; j++)
            if (fabs(rhs[j]) > CONTRADICTION * load / largest) d->contradiction = true;
        for (int j = 0; j < rank; j++)
            for (size_t i = 0; i < c; i++) d->start[i] += rhs[j] * rows[(size_t)j * c + i];
        cpsi_complete_rows(rank, d->components, rows);
        cpsi_dense_round(c * c, 1, rows);
        d->balanced = d->components - rank;
        d->forces = rows + (size_t)rank * c;
    }
    free(rhs);
    return status;
}

CpsStatus cpsi_dense_new(const CpsSystem *system, CpsiDense *out, CpsError *err) {
    CpsiDense d = {.n = system->n, .components = system->components};
    if (d.components > CPS_SET_MAX_SPACE)
        return cpsi_fail(err, CPS_ERR_LIMIT,
                         "the laws have %d components, at most %d for dense questions",
                         d.components, CPS_SET_MAX_SPACE);
    const size_t n = (size_t)d.n, c = (size_t)d.components;
    int rank = 0;
    d.map = calloc(c * n + 1, sizeof *d.map);
    CpsStatus status =
        d.map ? cpsi_system_kernel(system, NULL, &rank, &d.all, err) : out_of_memory(err);
    if (status == CPS_OK) {
        d.kernel = d.all + (size_t)rank * n;
        d.free = d.n - rank;
        cpsi_dense_round(n * n, 1, d.all);
        for (size_t i = 0; i < c; i++) cpsi_rows_add(&system->map, (int)i, 1, &d.map[i * n]);
        status = balance(system, &d, err);
    }
    if (status == CPS_OK)
        *out = d;
    else
        cpsi_dense_clear(&d);
    return status;
}
