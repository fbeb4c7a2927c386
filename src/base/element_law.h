/* SPDX-License-Identifier: BSD-3-Clause */
/* The tension of an element of a line as a function of its strain, by springs side by side.
 *
 * A table of strains and tensions whose slopes do not fall is a sum of springs that become taut one
 * after the other (docs/theory.md 1):
 *
 *     T(d) = d^+/c + sum_k K_k (d - s_k)^+,      0 < s_1 < s_2 < ...,  K_k > 0
 *
 * Without springs T = d/c; c = 0 is inextensible. With phi the inverse of T, the energy per length
 * is W(d) = int_0^d T, and its conjugate W*(T) = int_0^T phi. */
#ifndef CAPSTAN_SRC_BASE_ELEMENT_LAW_H
#define CAPSTAN_SRC_BASE_ELEMENT_LAW_H

#include <math.h>

typedef struct CpsiElementLaw {
    double compliance;       /* c [1/N] >= 0 */
    int count;               /* springs beside the first, >= 0; 0 where c = 0 */
    const double *start;     /* (count) s_k > 0 in rising order [-], to be multiplied with `longer`;
                                not read where there is none */
    const double *stiffness; /* (count) K_k > 0 [N], to be multiplied with `stiffer` */
    double longer, stiffer;
} CpsiElementLaw;

/* The springs that are taut at the tension T are like one: T = k d - pre. Returns their number. */
static inline int cpsi_law_taut_at(const CpsiElementLaw *law, double tension, double *k,
                                   double *pre) {
    int i = 0;
    *k = 1 / law->compliance;
    *pre = 0;
    for (; i < law->count; i++) {
        const double start = law->longer * law->start[i], more = law->stiffer * law->stiffness[i];
        if (!(tension > *k * start - *pre)) break;
        *k += more;
        *pre += more * start;
    }
    return i;
}

/* phi(T) for T >= 0; T < 0 goes on along the first spring. */
static inline double cpsi_law_strain(const CpsiElementLaw *law, double tension) {
    double k, pre;
    if (law->count == 0) return law->compliance * tension;
    cpsi_law_taut_at(law, tension, &k, &pre);
    return (tension + pre) / k;
}

/* phi'(T), at a corner that of the lower tension. */
static inline double cpsi_law_compliance(const CpsiElementLaw *law, double tension) {
    double k, pre;
    if (law->count == 0) return law->compliance;
    cpsi_law_taut_at(law, tension, &k, &pre);
    return 1 / k;
}

/* 1/T'(d) beyond all corners: the least compliance. */
static inline double cpsi_law_least_compliance(const CpsiElementLaw *law) {
    return cpsi_law_compliance(law, INFINITY);
}

/* T(d); of an elastic element. */
static inline double cpsi_law_tension(const CpsiElementLaw *law, double strain) {
    if (!(strain > 0)) return 0;
    double sum = strain / law->compliance;
    for (int i = 0; i < law->count; i++) {
        const double over = strain - law->longer * law->start[i];
        if (!(over > 0)) break;
        sum += law->stiffer * law->stiffness[i] * over;
    }
    return sum;
}

/* W(d); of an elastic element. */
static inline double cpsi_law_energy(const CpsiElementLaw *law, double strain) {
    if (!(strain > 0)) return 0;
    double sum = strain * (strain / (2 * law->compliance));
    for (int i = 0; i < law->count; i++) {
        const double over = strain - law->longer * law->start[i];
        if (!(over > 0)) break;
        sum += 0.5 * law->stiffer * law->stiffness[i] * over * over;
    }
    return sum;
}

/* W*(T). */
static inline double cpsi_law_conjugate(const CpsiElementLaw *law, double tension) {
    const double strain = cpsi_law_strain(law, tension);
    return law->count == 0 ? 0.5 * tension * strain
                           : tension * strain - cpsi_law_energy(law, strain);
}

/* W(d) + W*(T) - T d >= 0 for d >= 0, of an elastic element; the sum of the same of its springs,
 * without cancellation: int T'(x) |x - d| dx between d and phi(T). */
static inline double cpsi_law_gap(const CpsiElementLaw *law, double strain, double tension) {
    const double to = cpsi_law_strain(law, tension), off = strain - to;
    double sum = 0.5 * off * (off / law->compliance);
    for (int i = 0; i < law->count; i++) {
        const double start = law->longer * law->start[i];
        const double from = fmax(start, fmin(strain, to)), until = fmax(strain, to);
        if (!(until > from)) continue;
        const double mean = 0.5 * (from + until);
        sum += law->stiffer * law->stiffness[i] * (until - from) * fabs(mean - strain);
    }
    return sum;
}

#endif
