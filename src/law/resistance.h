/* SPDX-License-Identifier: BSD-3-Clause */
/* Resistance laws inside: a list of terms h(g), and what each answers about its h. */
#ifndef CAPSTAN_SRC_LAW_RESISTANCE_H
#define CAPSTAN_SRC_LAW_RESISTANCE_H

#include "law/law.h"

typedef enum CpsiTermKind {
    CPSI_DRY,
    CPSI_VISCOUS,
    CPSI_POWER,
    CPSI_TABLE,
    CPSI_FUNCTION
} CpsiTermKind;

/* phi = h(g), g the dissipation function of `set`; a viscous term is h = g^2/2 with g^2 = <V, D
 * V>. */
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
    atomic_int refcount;
    int n, count;
    CpsiTerm term[]; /* (count) */
};

/* h and h' at g >= 0. Fails only for a user's function, with the reason. */
CpsStatus cpsi_term_at(const CpsiTerm *term, double g, double *h, double *slope, CpsError *err);

/* h*(s) = max over g >= 0 of s g - h(g), and the least and largest g that attain it; all INFINITY
 * where there is none.
 */
typedef struct CpsiTermDual {
    double value, low, high;
} CpsiTermDual;
CpsStatus cpsi_term_dual(const CpsiTerm *term, double s, CpsiTermDual *dual, CpsError *err);

/* The same for a user's function (function.c), and the checks at its making. */
CpsStatus cpsi_function_at(const CpsiTerm *term, double g, double *h, double *slope, CpsError *err);
CpsStatus cpsi_function_dual(const CpsiTerm *term, double s, CpsiTermDual *dual, CpsError *err);
CpsStatus cpsi_function_check(const CpsiTerm *term, CpsError *err);

/* False for a power without factor and a table of zeros: no force at any speed. */
bool cpsi_term_resists(const CpsiTerm *term);

/* cps_resistance_conjugate for any sum of terms (conjugate_sum.c). share (count, n) or NULL: the
 * terms' shares of the force at least cost. */
CpsStatus cpsi_conjugate_sum(const CpsResistance *law, const double *force, double *velocity,
                             double *share, CpsSetAnswer *answer, CpsError *err);

/* The sum of the dry terms' sets. */
CpsStatus cpsi_dry_sum(const CpsResistance *law, CpsSet **dry, CpsError *err);

/* The velocities of one term, no viscous one, at its share of the force, known to the share
 * `tolerance` (velocities.c); *out NULL: not known. */
CpsStatus cpsi_term_velocities(int n, const CpsiTerm *term, const double *force, double tolerance,
                               CpsSet **out, CpsError *err);

#endif
