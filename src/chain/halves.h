/* SPDX-License-Identifier: BSD-3-Clause */
/* Two numbers side by side, one of each half of a chain that is eliminated from both ends: the
 * operations of C act on both at once. Every function must be inlined: how such a pair is handed to
 * a function depends on the processor. */
#ifndef CAPSTAN_SRC_CHAIN_HALVES_H
#define CAPSTAN_SRC_CHAIN_HALVES_H

#include <stdint.h>

typedef double CpsiHalves __attribute__((vector_size(2 * sizeof(double))));
/* What a comparison gives: all bits set where it holds. */
typedef int64_t CpsiHalvesMask __attribute__((vector_size(2 * sizeof(int64_t))));

#define CPSI_HALVES_FUNCTION static inline __attribute__((always_inline))

/* Both halves: for (int l ..) over the numbers of a pair. */
#define CPSI_FOR_HALVES(l) for (int l = 0; l < 2; l++)

CPSI_HALVES_FUNCTION CpsiHalves cpsi_halves(double first, double last) {
    return (CpsiHalves){first, last};
}

/* a where the mask is set, else b. */
CPSI_HALVES_FUNCTION CpsiHalves cpsi_halves_choose(CpsiHalvesMask mask, CpsiHalves a,
                                                   CpsiHalves b) {
    return (CpsiHalves)((mask & (CpsiHalvesMask)a) | (~mask & (CpsiHalvesMask)b));
}

CPSI_HALVES_FUNCTION CpsiHalves cpsi_halves_abs(CpsiHalves a) {
    return (CpsiHalves)((CpsiHalvesMask)a & (CpsiHalvesMask){INT64_MAX, INT64_MAX});
}

/* Component r of the vectors of `size` numbers that stand at `at` in p. */
CPSI_HALVES_FUNCTION CpsiHalves cpsi_halves_get(const double *p, const int at[2], int size, int r) {
    return (CpsiHalves){p[size * at[0] + r], p[size * at[1] + r]};
}

CPSI_HALVES_FUNCTION void cpsi_halves_put(double *p, const int at[2], int size, int r,
                                          CpsiHalves x) {
    CPSI_FOR_HALVES(l) p[size * at[l] + r] = x[l];
}

CPSI_HALVES_FUNCTION CpsiHalves cpsi_halves_dot(const CpsiHalves a[3], const CpsiHalves b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* out = A x and out = A^T x for A (3, 3). */
CPSI_HALVES_FUNCTION void cpsi_halves_apply(CpsiHalves out[3], const CpsiHalves a[9],
                                            const CpsiHalves x[3]) {
    for (int i = 0; i < 3; i++) out[i] = cpsi_halves_dot(&a[3 * i], x);
}

CPSI_HALVES_FUNCTION void cpsi_halves_apply_transposed(CpsiHalves out[3], const CpsiHalves a[9],
                                                       const CpsiHalves x[3]) {
    for (int i = 0; i < 3; i++) out[i] = a[i] * x[0] + a[3 + i] * x[1] + a[6 + i] * x[2];
}

#endif
