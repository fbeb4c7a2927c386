/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory and rows of a large dense matrix (dense_ldl.h), and the width of its loops. */
#include "linalg/dense_ldl.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/lanes.h"
#include "base/width.h"

enum { LANES = CPSI_LANES, PANEL = CPSI_DENSE_PANEL };

/* Eight numbers that registers take at once lie within one line of the cache. */
enum { LINE = 64 };

static const CpsiDenseLoops *loops_of_width(int *width) {
#ifdef CPSI_HAS_WIDTHS
    static const CpsiDenseLoops *const loops[CPSI_WIDTHS] = {
        [CPSI_WIDTH_128] = &cpsi_dense_loops_128,
        [CPSI_WIDTH_256] = &cpsi_dense_loops_256,
        [CPSI_WIDTH_512] = &cpsi_dense_loops_512};
    return loops[cpsi_width_once(width)];
#else
    (void)width;
    return &cpsi_dense_loops_128;
#endif
}

bool cpsi_dense_ldl_new(CpsiDenseLdl *ldl, int size, int *width) {
    const size_t n = ((size_t)size + LANES - 1) / LANES * LANES, panel = PANEL;
    const size_t entries = n * (n + panel) / 2 + panel * panel;
    *ldl = (CpsiDenseLdl){.given = size, .n = (int)n, .loops = loops_of_width(width)};
    ldl->block = malloc((entries + 2 * n + panel * panel) * sizeof(double) + LINE);
    ldl->sign = malloc(n + 1);
    if (!ldl->block || !ldl->sign) return false;
    ldl->matrix = (double *)(((uintptr_t)ldl->block + LINE - 1) / LINE * LINE);
    ldl->scratch = ldl->matrix + entries;
    ldl->pivot = ldl->scratch + panel * panel;
    ldl->terms = ldl->pivot + n;
    return true;
}

void cpsi_dense_ldl_free(CpsiDenseLdl *ldl) {
    free(ldl->block);
    free(ldl->sign);
}

/* Where row i of the panel that begins with column `first` has that column's entry; those of the
 * next columns follow, LANES apart. */
static double *row_of(const CpsiDenseLdl *ldl, int i, int first) {
    const size_t below = (size_t)(i - first), lane = below % LANES;
    return cpsi_dense_panel(ldl, first) + (below - lane) * (size_t)cpsi_dense_width(ldl, first) +
           lane;
}

void cpsi_dense_ldl_row(CpsiDenseLdl *ldl, int i, const double *row, double terms,
                        signed char sign) {
    for (int first = 0; first <= i; first += PANEL) {
        const int width = cpsi_dense_width(ldl, first), rest = i + 1 - first;
        double *out = row_of(ldl, i, first);
        for (int j = 0; j < width && j < rest; j++) out[j * LANES] = row[first + j];
    }
    ldl->terms[i] = terms;
    ldl->sign[i] = sign;
}

/* A row that rounds the size up: that of the unit matrix. */
static void unit_row(CpsiDenseLdl *ldl, int i) {
    for (int j = 0; j <= i; j++)
        row_of(ldl, i, j / PANEL * PANEL)[j % PANEL * LANES] = j == i ? 1 : 0;
    ldl->terms[i] = 1;
    ldl->sign[i] = 1;
}

bool cpsi_dense_ldl_factor(CpsiDenseLdl *ldl, double least, double share) {
    for (int i = ldl->given; i < ldl->n; i++) unit_row(ldl, i);
    return ldl->loops->factor(ldl, least, share);
}

void cpsi_dense_ldl_forward(const CpsiDenseLdl *ldl, double *x) {
    for (int i = ldl->given; i < ldl->n; i++) x[i] = 0; /* an overflow before may have left NaN */
    ldl->loops->forward(ldl, x);
}

void cpsi_dense_ldl_backward(const CpsiDenseLdl *ldl, double *x) { ldl->loops->backward(ldl, x); }
