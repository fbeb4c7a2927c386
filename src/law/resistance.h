/* SPDX-License-Identifier: BSD-3-Clause */
/* The content of resistance laws: a list of terms h(g), and the queries of each h. */
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
    CpsSet *set;           /* retained; NULL for viscous terms */
    double degree, factor; /* power: factor g^degree / degree */
    int count;             /* table: number of points of h' */
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

/* h and h' at g >= 0. Fails only for a user's function; the message gives the reason. */
CpsStatus cpsi_term_at(const CpsiTerm *term, double g, double *h, double *slope, CpsError *err);

/* h*(s) = max over g >= 0 of s g - h(g), and the smallest and largest g that attain it; all
 * INFINITY where there is no maximum. */
typedef struct CpsiTermDual {
    double value, low, high;
} CpsiTermDual;
CpsStatus cpsi_term_dual(const CpsiTerm *term, double s, CpsiTermDual *dual, CpsError *err);

/* The same for a user's function (function.c), and the checks when it is constructed. */
CpsStatus cpsi_function_at(const CpsiTerm *term, double g, double *h, double *slope, CpsError *err);
CpsStatus cpsi_function_dual(const CpsiTerm *term, double s, CpsiTermDual *dual, CpsError *err);
CpsStatus cpsi_function_check(const CpsiTerm *term, CpsError *err);

/* False for a power without factor and for a table of zeros, which have no force at any speed. */
bool cpsi_term_resists(const CpsiTerm *term);

/* cps_resistance_conjugate for any sum of terms (conjugate_sum.c). share (count, n) or NULL: the
 * terms' shares of the force in the split of least cost. */
CpsStatus cpsi_conjugate_sum(const CpsResistance *law, const double *force, double *velocity,
                             double *share, CpsSetAnswer *answer, CpsError *err);

/* The sum of the dry terms' sets. */
CpsStatus cpsi_dry_sum(const CpsResistance *law, CpsSet **dry, CpsError *err);

/* The velocities of one term, not a viscous one, at its share of the force with relative error
 * `tolerance` (velocities.c). *out is NULL where they are not known. */
CpsStatus cpsi_term_velocities(int n, const CpsiTerm *term, const double *force, double tolerance,
                               CpsSet **out, CpsError *err);

#endif
