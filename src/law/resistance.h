/* SPDX-License-Identifier: BSD-3-Clause */
/* Resistance laws inside: a list of terms h(g), and what each answers about its h. */
#ifndef CAPSTAN_SRC_LAW_RESISTANCE_H
#define CAPSTAN_SRC_LAW_RESISTANCE_H

#include "law/law.h"

typedef enum CpsiTermKind { CPSI_DRY, CPSI_VISCOUS, CPSI_POWER, CPSI_TABLE } CpsiTermKind;

/* phi = h(g), g the dissipation function of `set`; a viscous term is h = g^2/2 with g^2 = <V, D V>. */
typedef struct CpsiTerm {
    CpsiTermKind kind;
    CpsSet *set;           /* a hold; viscous: NULL */
    double degree, factor; /* power: factor g^degree / degree */
    int count;             /* table: points of h' */
    double *data;          /* table: speeds, then factors (2 count); viscous: D (n x n); owned */
} CpsiTerm;

struct CpsResistance {
    int n, count;
    CpsiTerm term[]; /* (count) */
};

/* h and h' at g >= 0. */
double cpsi_term_potential(const CpsiTerm *term, double g);
double cpsi_term_slope(const CpsiTerm *term, double g);

/* h*(s) = max over g >= 0 of s g - h(g), and a g that attains it; INFINITY (and g INFINITY) where there is none. s >=
 * 0. */
double cpsi_term_conjugate(const CpsiTerm *term, double s, double *g);

#endif
