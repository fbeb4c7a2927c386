/* SPDX-License-Identifier: BSD-3-Clause */
/* Resistance laws inside: a list of terms h(g), and what each answers about its h. */
#ifndef CAPSTAN_SRC_LAW_RESISTANCE_H
#define CAPSTAN_SRC_LAW_RESISTANCE_H

#include "law/law.h"

typedef enum CpsiTermKind { CPSI_DRY, CPSI_VISCOUS, CPSI_POWER, CPSI_TABLE, CPSI_FUNCTION } CpsiTermKind;

/* phi = h(g), g the dissipation function of `set`; a viscous term is h = g^2/2 with g^2 = <V, D V>. */
typedef struct CpsiTerm {
    CpsiTermKind kind;
    CpsSet *set;           /* a hold; viscous: NULL */
    double degree, factor; /* power: factor g^degree / degree */
    int count;             /* table: points of h' */
    double *data;          /* table: speeds, then factors (2 count); viscous: D (n x n); owned */
    CpsSpeedLaw *h;        /* function */
    CpsSpeedConjugate *conjugate;
    void *user;
} CpsiTerm;

struct CpsResistance {
    int n, count;
    CpsiTerm term[]; /* (count) */
};

/* h and h' at g >= 0. Fails only for a user's function, with the reason. */
CpsStatus cpsi_term_at(const CpsiTerm *term, double g, double *h, double *slope, CpsError *err);

/* h*(s) = max over g >= 0 of s g - h(g), and the least and largest g that attain it; all INFINITY where there is none.
 */
typedef struct CpsiTermDual {
    double value, low, high;
} CpsiTermDual;
CpsStatus cpsi_term_dual(const CpsiTerm *term, double s, CpsiTermDual *dual, CpsError *err);

/* The same for a user's function (function.c), and the checks at its making. */
CpsStatus cpsi_function_at(const CpsiTerm *term, double g, double *h, double *slope, CpsError *err);
CpsStatus cpsi_function_dual(const CpsiTerm *term, double s, CpsiTermDual *dual, CpsError *err);
CpsStatus cpsi_function_check(const CpsiTerm *term, CpsError *err);

/* cps_resistance_conjugate for any sum of terms (sum.c). */
CpsStatus cpsi_sum_conjugate(const CpsResistance *law, const double *force, double *velocity, CpsSetAnswer *answer,
                             CpsError *err);

#endif
