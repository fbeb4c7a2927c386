/* SPDX-License-Identifier: BSD-3-Clause */
/* Terms of resistance laws as epigraphs of their conjugates, e >= phi*(-F).
 *
 *     viscous     phi* = |y|^2/2,  F = L y,  D = L L'
 *                 2 a q >= a |y|^2, a second-order cone
 *     h of gauge  phi* = h*(s),  F in s C;  h' is a sum of ramps from speed x_i that rise by r_i
 *                 with slope m_i, so h* is the inf-convolution of theirs:  s = s_0 + sum of s_i,
 *                 0 <= s_0 <= h'(0),  0 <= s_i <= r_i,  e = sum of x_i s_i + s_i^2/(2 m_i)
 *
 * Without their costs these are the forces that the term can have, all of R^n for a viscous one.
 *
 * Each square is q_i >= s_i^2/(2 m_i), written with the size a of q as |(q - a/2, ..)| <= q +
 * a/2. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "drive/system_program.h"
#include "linalg/dense.h"
#include "set/set.h"

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a resistance law");
}

/* The cone |(q - a/2, sqrt(a) y)| <= q + a/2. Writes its rows except those of y; q is unknown
 * number `q`. */
static double *square_cone(CpsiConicRows *raw, int q, double a, int count) {
    double *rows = cpsi_conic_rows_cone(raw, count + 2);
    const size_t w = (size_t)raw->width;
    rows[q] = 1;
    rows[w - 1] = 0.5 * a;
    rows[w + (size_t)q] = 1;
    rows[2 * w - 1] = -0.5 * a;
    return rows + 2 * w;
}

/* x (n + 1, width): F and e; the first unknowns are F */
static double *begin_x(const CpsiConicRows *raw, int n) {
    const size_t w = (size_t)raw->width;
    double *x = calloc(((size_t)n + 2) * w, sizeof *x);
    for (size_t i = 0; x && i < (size_t)n; i++) x[i * w + i] = 1;
    return x;
}

/* R^n x {0} */
static CpsStatus any_force(int n, CpsiConicForm **out, CpsError *err) {
    const CpsiCount count = {.unknowns = (size_t)n};
    CpsiConicRows *raw = NULL;
    CpsStatus status = cpsi_conic_rows_new(count, n, &raw, err);
    double *x = status == CPS_OK ? begin_x(raw, n) : NULL;
    if (status == CPS_OK && !x) status = out_of_memory(err);
    if (status == CPS_OK) status = cpsi_conic_form_reduce(raw, n + 1, x, 0, NULL, 1e-11, out, err);
    free(x);
    cpsi_conic_rows_free(raw);
    return status;
}

static CpsStatus viscous_form(int n, const double *matrix, double speed, CpsiConicForm **out,
                              CpsError *err) {
    const size_t w = (size_t)n;
    const CpsiCount count = {.unknowns = w + 1, .rows = w + 2, .cones = 1};
    CpsiConicRows *raw = NULL;
    CpsStatus status = cpsi_conic_rows_new(count, n + 1, &raw, err);
    if (status != CPS_OK) return status;
    double *factor = calloc(2 * w * w, sizeof *factor), *inverse = factor ? factor + w * w : NULL,
           *x = begin_x(raw, n);
    double trace = 0;
    for (size_t i = 0; i < w; i++) trace += matrix[i * w + i];
    const double a = speed * speed * trace / n;
    if (!factor || !x)
        status = out_of_memory(err);
    else if (!cpsi_cholesky(n, matrix, factor))
        status =
            cpsi_fail(err, CPS_ERR_ARGUMENT, "a viscous matrix lost its definiteness to rounding");
    else {
        cpsi_lower_inverse(n, factor, inverse);
        double *rows = square_cone(raw, n, a, n);
        for (size_t i = 0; i < w; i++)
            for (size_t j = 0; j <= i; j++) rows[i * (w + 2) + j] = sqrt(a) * inverse[i * w + j];
        x[w * (w + 2) + w] = 1;
        status = cpsi_conic_form_reduce(raw, n + 1, x, 0, NULL, 1e-11, out, err);
    }
    free(factor);
    free(x);
    cpsi_conic_rows_free(raw);
    return status;
}

/* One ramp of h': from speed `from` it rises by `rise` (INFINITY: unbounded) with `slope`;
 * INFINITY: a step. */
typedef struct Ramp {
    double from, rise, slope;
} Ramp;

/* Ramps of a power of degree 2, or of a table; at most count + 1. */
static int ramps_of(const CpsiTerm *term, Ramp *ramp) {
    int count = 0;
    if (term->kind == CPSI_POWER) {
        if (term->factor > 0) ramp[count++] = (Ramp){0, INFINITY, term->factor};
        return count;
    }
    if (term->kind == CPSI_DRY) {
        ramp[count++] = (Ramp){0, 1, INFINITY};
        return count;
    }
    const double *speed = term->data, *factor = term->data + term->count;
    if (factor[0] > 0) ramp[count++] = (Ramp){0, factor[0], INFINITY};
    for (int i = 1; i < term->count; i++) {
        const double rise = factor[i] - factor[i - 1];
        if (rise > 0) ramp[count++] = (Ramp){speed[i - 1], rise, rise / (speed[i] - speed[i - 1])};
    }
    return count;
}

/* Write a ramp: its s is added to t and its cost, where speed > 0, to e; its unknowns begin at
 * raw->next. */
static void ramp_rows(CpsiConicRows *raw, const Ramp *ramp, double speed, double *t, double *e) {
    const int s = raw->next++;
    const size_t w = (size_t)raw->width;
    t[s] += 1;
    if (speed > 0) e[s] += ramp->from;
    if (isfinite(ramp->slope) && speed > 0) {
        const int q = raw->next++;
        const double size = fmin(ramp->rise, ramp->slope * speed), a = size * size / ramp->slope;
        double *row = square_cone(raw, q, a, 1);
        row[s] = size / ramp->slope; /* sqrt(a/slope) */
        e[q] += 1;
    }
    cpsi_conic_rows_cone(raw, 1)[s] = 1;
    if (!isfinite(ramp->rise)) return;
    double *below = cpsi_conic_rows_cone(raw, 1);
    below[s] = -1;
    below[w - 1] = ramp->rise;
}

static CpsStatus gauge_form(int n, const CpsiTerm *term, double speed, CpsiConicForm **out,
                            CpsError *err) {
    Ramp *ramp = malloc(((size_t)term->count + 2) * sizeof *ramp);
    if (!ramp) return out_of_memory(err);
    const int ramps = ramps_of(term, ramp);
    CpsiCount count = {.unknowns = (size_t)n + 2 * (size_t)ramps,
                       .equations = (size_t)n,
                       .rows = 5 * (size_t)ramps,
                       .cones = 3 * (size_t)ramps};
    cpsi_conic_rows_count(term->set, &count);
    CpsiConicRows *raw = NULL;
    CpsStatus status = cpsi_conic_rows_new(count, n, &raw, err);
    double *x = status == CPS_OK ? begin_x(raw, n) : NULL;
    if (status == CPS_OK && !x) status = out_of_memory(err);
    if (status == CPS_OK) {
        const size_t w = (size_t)raw->width;
        double *e = x + (size_t)n * w, *t = e + w;
        const double size = cpsi_set_size(term->set);
        for (int k = 0; k < ramps; k++) ramp_rows(raw, &ramp[k], speed * size, t, e);
        /* without a ramp there is no force */
        if (ramps == 0)
            for (int i = 0; i < n; i++) cpsi_conic_rows_equation(raw)[i] = 1;
        if (ramps > 0 && !cpsi_conic_rows_write(raw, term->set, x, t)) status = out_of_memory(err);
        if (status == CPS_OK)
            status = cpsi_conic_form_reduce(raw, n + 1, x, 0, NULL, 1e-11, out, err);
    }
    free(ramp);
    free(x);
    cpsi_conic_rows_free(raw);
    return status;
}

CpsStatus cpsi_term_form(int n, const CpsiTerm *term, double speed, CpsiConicForm **out,
                         CpsError *err) {
    if (term->kind == CPSI_VISCOUS && !(speed > 0)) return any_force(n, out, err);
    if (term->kind == CPSI_VISCOUS) return viscous_form(n, term->data, speed, out, err);
    return gauge_form(n, term, speed, out, err);
}
