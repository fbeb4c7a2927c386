/* SPDX-License-Identifier: BSD-3-Clause */
/* Arrays of vectors, (n, 3) place by place, and the blocks of places in a band matrix. Place 0 is
 * held; the unknowns are the coordinates of places 1, 2, ... */
#ifndef CAPSTAN_SRC_REGULARIZED_BAND_BLOCKS_H
#define CAPSTAN_SRC_REGULARIZED_BAND_BLOCKS_H

#include "base/vec3.h"
#include "linalg/band.h"

static inline void cpsi_add(double *v, int j, double k, Vec3 a) {
    vec3_store(v + 3 * (size_t)j, vec3_axpy(k, a, vec3_at(v, j)));
}

/* Add k I + l d d^T to the block (i, j) of places, i >= j, where both are free; only the lower half
 * of a block on the diagonal. */
static inline void cpsi_add_block(double *a, int band, int unknowns, int i, int j, double k,
                                  double l, Vec3 d) {
    const int row = 3 * (i - 1), column = 3 * (j - 1);
    if (column < 0 || row >= unknowns) return;
    const double v[3] = {d.x, d.y, d.z};
    for (int r = 0; r < 3; ++r)
        for (int s = 0; s < (i == j ? r + 1 : 3); ++s)
            *cpsi_band_at(a, band, row + r, column + s) += (r == s ? k : 0) + l * v[r] * v[s];
}

#endif
