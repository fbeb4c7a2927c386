/* SPDX-License-Identifier: BSD-3-Clause */
/* The functions h of speed of resistance laws, their slopes and their conjugates.
 *
 * power   h = c g^p/p           h' = c g^(p-1)      h*(s) = s g (1 - 1/p) at g = (s/c)^(1/(p-1))
 * table   h' piecewise linear   h by trapezia       h*(s) = s g - h(g) where h'(g) = s
 * dry     h = g                 h' = 1              h*(s) = 0 for s <= 1, else infinite */
#include "law/resistance.h"

/* ---- tables: speeds x (count), factors y (count) ---- */

/* the last point at or before g */
static int piece(const CpsiTerm *t, double g) {
    int i = 0;
    while (i + 1 < t->count && t->data[i + 1] <= g) i++;
    return i;
}

static double table_slope(const CpsiTerm *t, double g) {
    const double *x = t->data, *y = t->data + t->count;
    const int i = piece(t, g);
    if (i + 1 == t->count) return y[i];
    return y[i] + (y[i + 1] - y[i]) * ((g - x[i]) / (x[i + 1] - x[i]));
}

static double table_potential(const CpsiTerm *t, double g) {
    const double *x = t->data, *y = t->data + t->count;
    const int last = piece(t, g);
    double sum = 0;
    for (int i = 0; i < last; i++) sum += 0.5 * (y[i] + y[i + 1]) * (x[i + 1] - x[i]);
    return sum + 0.5 * (y[last] + table_slope(t, g)) * (g - x[last]);
}

static double table_conjugate(const CpsiTerm *t, double s, double *g) {
    const double *x = t->data, *y = t->data + t->count;
    if (s > y[t->count - 1]) return *g = INFINITY;
    int i = 0;
    while (i + 1 < t->count && y[i + 1] < s) i++;
    *g = s <= y[0] ? 0 : x[i] + (x[i + 1] - x[i]) * ((s - y[i]) / (y[i + 1] - y[i]));
    return s * *g - table_potential(t, *g);
}

/* ---- all kinds ---- */

double cpsi_term_potential(const CpsiTerm *term, double g) {
    switch (term->kind) {
    case CPSI_DRY:
        return g;
    case CPSI_VISCOUS:
        return 0.5 * g * g;
    case CPSI_POWER:
        return term->factor * pow(g, term->degree) / term->degree;
    case CPSI_TABLE:
        return isinf(g) ? INFINITY : table_potential(term, g);
    }
    return NAN;
}

double cpsi_term_slope(const CpsiTerm *term, double g) {
    switch (term->kind) {
    case CPSI_DRY:
        return 1;
    case CPSI_VISCOUS:
        return g;
    case CPSI_POWER:
        return term->factor * pow(g, term->degree - 1);
    case CPSI_TABLE:
        return table_slope(term, g);
    }
    return NAN;
}

double cpsi_term_conjugate(const CpsiTerm *term, double s, double *g) {
    *g = 0;
    if (!(s > 0)) return 0;
    switch (term->kind) {
    case CPSI_DRY:
        return s <= 1 ? 0 : (*g = INFINITY);
    case CPSI_VISCOUS:
        *g = s;
        return 0.5 * s * s;
    case CPSI_POWER:
        if (!(term->factor > 0) || isinf(s)) return *g = INFINITY;
        *g = pow(s / term->factor, 1 / (term->degree - 1));
        return s * *g * (1 - 1 / term->degree);
    case CPSI_TABLE:
        return table_conjugate(term, s, g);
    }
    return NAN;
}
