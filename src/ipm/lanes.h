/* SPDX-License-Identifier: BSD-3-Clause */
/* Passes over elements take eight at a time: the numbers of eight elements stand side by side in
 * lanes, and a plain loop over the lanes is what the compiler makes wide instructions of. Files
 * with such loops are compiled once per width of the processor's registers (ipm/width.h). No
 * operation joins two lanes but a maximum and, at the end of a pass, the sums of the eight lanes in
 * their order (lane_sums.h), so every width gives the same bits.
 *
 * What a loop over lanes may contain: arithmetic, square roots and a choice between two numbers by
 * one comparison. Indices by an array, and what differs from element to element in kind, stand in
 * loops of their own before or after it. */
#ifndef CAPSTAN_SRC_IPM_LANES_H
#define CAPSTAN_SRC_IPM_LANES_H

#include <math.h>
#include <stddef.h>

#include "base/larger.h"

enum { CPSI_LANES = 8 };

/* One number of each of eight elements. */
typedef double CpsiLane[CPSI_LANES];
typedef int CpsiIndexLane[CPSI_LANES];

/* A function with a loop over lanes. It stands for itself, and its pointers are `restrict`: in the
 * midst of other code gcc 12 does not see what it may do at once. CPSI_LANES_PART: a part of such
 * functions. */
#define CPSI_LANES_FUNCTION static __attribute__((noinline))
#define CPSI_LANES_PART     static inline __attribute__((always_inline))

/* All loops over lanes. */
#define CPSI_FOR_LANES(l) for (int l = 0; l < CPSI_LANES; l++)

/* How many of the `rest` elements the next lanes hold. */
static inline int cpsi_lanes_count(int rest) { return rest < CPSI_LANES ? rest : CPSI_LANES; }

/* Fewer than eight elements: the other lanes repeat the last. */
static inline void cpsi_lanes_load_some(const int n, CpsiLane *out, const double *from, int count) {
    CPSI_FOR_LANES(l)
    for (int a = 0; a < n; a++) out[a][l] = from[n * (l < count ? l : count - 1) + a];
}

static inline void cpsi_lanes_store_some(const int n, double *to, CpsiLane *x, int count) {
    for (int l = 0; l < count; l++)
        for (int a = 0; a < n; a++) to[n * l + a] = x[a][l];
}

/* Weights of `count` elements: 0 in the lanes that repeat the last, so that sums do not count it
 * again. */
static inline void cpsi_lanes_load_weights(CpsiLane out, const double *from, int count) {
    CPSI_FOR_LANES(l) out[l] = l < count ? from[l] : 0;
}

/* The n numbers of each of `count` elements, which follow one another in `from`. */
CPSI_LANES_PART void cpsi_lanes_load(const int n, CpsiLane *out, const double *from, int count) {
    if (count < CPSI_LANES) {
        cpsi_lanes_load_some(n, out, from, count);
        return;
    }
    CPSI_FOR_LANES(l)
    for (int a = 0; a < n; a++) out[a][l] = from[n * l + a];
}

/* The reverse. */
CPSI_LANES_PART void cpsi_lanes_store(const int n, double *to, CpsiLane *x, int count) {
    if (count < CPSI_LANES) {
        cpsi_lanes_store_some(n, to, x, count);
        return;
    }
    CPSI_FOR_LANES(l)
    for (int a = 0; a < n; a++) to[n * l + a] = x[a][l];
}

/* The largest of `start` and all lanes; NaN if any is. */
static inline double cpsi_lanes_largest(double start, const CpsiLane x) {
    double largest = start;
    CPSI_FOR_LANES(l) largest = cpsi_max_nan(largest, x[l]);
    return largest;
}

/* The largest |x| of n numbers; NaN if any is. */
static inline double cpsi_lanes_size(size_t n, const double *x) {
    CpsiLane most = {0};
    size_t i = 0;
    for (; i + CPSI_LANES <= n; i += CPSI_LANES)
        CPSI_FOR_LANES(l) most[l] = cpsi_max_nan(most[l], fabs(x[i + (size_t)l]));
    for (; i < n; i++) most[0] = cpsi_max_nan(most[0], fabs(x[i]));
    return cpsi_lanes_largest(0, most);
}

#endif
