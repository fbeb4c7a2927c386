/* SPDX-License-Identifier: BSD-3-Clause */
/* The functions h of speed of resistance laws, their slopes and their conjugates.
 *
 * power     h = c g^p/p           h' = c g^(p-1)      h*(s) = s g (1 - 1/p) at g = (s/c)^(1/(p-1))
 * table     h' piecewise linear   h by trapezia       h*(s) = s g - h(g) where h'(g) = s
 * dry       h = g                 h' = 1              h*(s) = 0 for s <= 1, else infinite
 * function  the user's            (function.c)
 *     h*(s) = s g - h(g) where h'(g) = s, found by bisection */
#include "law/resistance.h"

static const CpsiTermDual NO_SPEED = {INFINITY, INFINITY, INFINITY};

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

static CpsiTermDual table_dual(const CpsiTerm *t, double s) {
    const double *x = t->data, *y = t->data + t->count;
    const int last = t->count - 1;
    if (s > y[last]) return NO_SPEED;
    int i = 0, j = last;
    while (i < last && y[i + 1] < s) i++;
    while (j > 0 && y[j - 1] > s) j--;
    CpsiTermDual dual = {.low = 0, .high = INFINITY};
    if (s > y[0]) dual.low = x[i] + (x[i + 1] - x[i]) * ((s - y[i]) / (y[i + 1] - y[i]));
    if (s < y[0])
        dual.high = 0;
    else if (s < y[last])
        dual.high = x[j - 1] + (x[j] - x[j - 1]) * ((s - y[j - 1]) / (y[j] - y[j - 1]));
    dual.high = fmax(dual.low, dual.high);
    dual.value = s * dual.low - table_potential(t, dual.low);
    return dual;
}

/* ---- all kinds ---- */

bool cpsi_term_resists(const CpsiTerm *term) {
    if (term->kind == CPSI_POWER) return term->factor > 0;
    return term->kind != CPSI_TABLE || term->data[2 * term->count - 1] > 0;
}

CpsStatus cpsi_term_at(const CpsiTerm *term, double g, double *h, double *slope, CpsError *err) {
    switch (term->kind) {
    case CPSI_DRY:
        *h = g;
        *slope = 1;
        return CPS_OK;
    case CPSI_VISCOUS:
        *h = 0.5 * g * g;
        *slope = g;
        return CPS_OK;
    case CPSI_POWER:
        /* without a factor there is no force, however large the power */
        *slope = term->factor > 0 ? term->factor * pow(g, term->degree - 1) : 0;
        *h = *slope * g / term->degree;
        return CPS_OK;
    case CPSI_TABLE:
        *h = table_potential(term, g);
        *slope = table_slope(term, g);
        return CPS_OK;
    case CPSI_FUNCTION: return cpsi_function_at(term, g, h, slope, err);
    }
    return CPS_ERR_ARGUMENT;
}

CpsStatus cpsi_term_dual(const CpsiTerm *term, double s, CpsiTermDual *dual, CpsError *err) {
    *dual = (CpsiTermDual){0};
    switch (term->kind) {
    case CPSI_DRY:
        if (s > 1) *dual = NO_SPEED;
        if (s == 1) dual->high = INFINITY;
        return CPS_OK;
    case CPSI_VISCOUS:
        if (s > 0) *dual = (CpsiTermDual){0.5 * s * s, s, s};
        return CPS_OK;
    case CPSI_POWER:
        if (!(s > 0)) return CPS_OK;
        if (!(term->factor > 0) || isinf(s)) {
            *dual = NO_SPEED;
            return CPS_OK;
        }
        dual->low = dual->high = pow(s / term->factor, 1 / (term->degree - 1));
        dual->value = s * dual->low * (1 - 1 / term->degree);
        return CPS_OK;
    case CPSI_TABLE: *dual = table_dual(term, fmax(s, 0)); return CPS_OK;
    case CPSI_FUNCTION: return cpsi_function_dual(term, s, dual, err);
    }
    return CPS_ERR_ARGUMENT;
}
