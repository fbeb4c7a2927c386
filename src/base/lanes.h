/* SPDX-License-Identifier: BSD-3-Clause */
/* Passes over elements take eight at a time: the numbers of eight elements stand side by side in
 * lanes, and a plain loop over the lanes is what the compiler makes wide instructions of. Files
 * with such loops are compiled once per width of the processor's registers (base/width.h). No
 * operation joins two lanes but a maximum and, at the end of a pass, the sums of the eight lanes in
 * their order (ipm/lane_sums.h), so every width gives the same bits.
 *
 * What a loop over lanes may contain: arithmetic, square roots and a choice between two numbers by
 * one comparison. Indices by an array, and what differs from element to element in kind, stand in
 * loops of their own before or after it. */
#ifndef CAPSTAN_SRC_BASE_LANES_H
#define CAPSTAN_SRC_BASE_LANES_H

#include <math.h>
#include <stddef.h>

#include "base/larger.h"

enum { CPSI_LANES = 8 };

/* A pass takes as many elements at a time as this: it gathers what they need by indices, goes over
 * their lanes, and adds what they give by indices. In turns of eight, each of these would wait for
 * the one before to reach memory. */
enum { CPSI_STRIP = 64 };

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

/* How many of the `rest` elements the next lanes, or the next strip, hold. */
static inline int cpsi_lanes_count(int rest) { return rest < CPSI_LANES ? rest : CPSI_LANES; }
static inline int cpsi_strip_count(int rest) { return rest < CPSI_STRIP ? rest : CPSI_STRIP; }

/* The strips of elements `from` to `to` - 1: each from `first` on, of `count`. */
#define CPSI_FOR_STRIPS(first, count, from, to)                                     \
    for (int first = (from), count = cpsi_strip_count((to) - (from)); first < (to); \
         first += count, count = cpsi_strip_count((to)-first))

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
    if (count == CPSI_LANES)
        CPSI_FOR_LANES(l) out[l] = from[l];
    else
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

/* Arrays that only passes over lanes read keep the n numbers of a whole block of eight elements as
 * lanes, and those of the last few elements one after the other. Returns the lanes where they are
 * kept or, of the last few elements, in `spare` (n). */
static inline CpsiLane *cpsi_lanes_of(const int n, double *kept, CpsiLane *spare, int count) {
    if (count == CPSI_LANES) return (CpsiLane *)kept;
    cpsi_lanes_load_some(n, spare, kept, count);
    return spare;
}

/* Keep the last few elements, whose lanes are in `spare`. */
static inline void cpsi_lanes_keep(const int n, double *kept, CpsiLane *spare, int count) {
    if (count < CPSI_LANES) cpsi_lanes_store_some(n, kept, spare, count);
}

/* Number a of element k in an array so kept for `total` elements. */
static inline double *cpsi_lanes_kept(int n, double *kept, int total, int k, int a) {
    const int lane = k % CPSI_LANES, first = k - lane;
    return total - first < CPSI_LANES ? &kept[n * k + a] : &kept[n * first + CPSI_LANES * a + lane];
}

/* The largest of `start` and all lanes; NaN if any is. */
static inline double cpsi_lanes_largest(double start, const CpsiLane x) {
    double largest = start;
    CPSI_FOR_LANES(l) largest = cpsi_max_nan(largest, x[l]);
    return largest;
}

/* `most` becomes the largest |x| of the lanes of `blocks` blocks. */
static __attribute__((noinline, unused)) void
cpsi_lanes_sizes(size_t blocks, const double *restrict x, double *restrict most) {
    for (size_t i = 0; i < blocks * CPSI_LANES; i += CPSI_LANES)
        CPSI_FOR_LANES(l) most[l] = cpsi_max_nan(most[l], fabs(x[i + (size_t)l]));
}

/* The largest |x| of n numbers; NaN if any is. */
static inline double cpsi_lanes_size(size_t n, const double *x) {
    CpsiLane most = {0};
    cpsi_lanes_sizes(n / CPSI_LANES, x, most);
    for (size_t i = n / CPSI_LANES * CPSI_LANES; i < n; i++)
        most[0] = cpsi_max_nan(most[0], fabs(x[i]));
    return cpsi_lanes_largest(0, most);
}

#endif
