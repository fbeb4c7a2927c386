/* SPDX-License-Identifier: BSD-3-Clause */
/* Stability of bodies (body_stability.h).
 *
 * A body is stable by itself where its stiffness, free points following and the other bodies of its
 * group in their poses, is positive definite in its free directions. Those of which this is so are
 * stable where they are together: where the matrix of all of them with their couplings is as well.
 * Each is taken in units of its own largest entry, so that what counts as rounding follows from
 * it. */
#include "evolve/body_stability.h"

#include <math.h>

#include "evolve/bodies.h"
#include "evolve/newton_step.h"
#include "linalg/dense.h"

static CpsiBody *body_of(const CpsiBalance *balance, int k) {
    return &balance->evolution->bodies.body[balance->rigid[k].body];
}

/* The units in which the directions of a body are taken. */
static void find_units(const CpsiBody *body, double unit[6]) {
    double most = 0;
    for (int i = 0; i < 36; i++) {
        const bool fixed = body->given.fixed[i / 6] || body->given.fixed[i % 6];
        const double arms = (i / 6 < 3 ? 1 : body->arm) * (i % 6 < 3 ? 1 : body->arm);
        if (!fixed) most = fmax(most, fabs(body->report.stiffness[i]) / arms);
    }
    for (int i = 0; i < 6; i++) unit[i] = (i < 3 ? 1 : body->arm) * sqrt(most > 0 ? most : 1);
}

/* Put the block of bodies k and l of the matrix of all into rows from `row` on and columns from
 * `column` on of that of those which are stable by themselves, (n, n). */
static void put_block(CpsiBalance *balance, int k, int l, size_t row, size_t column, size_t n) {
    const CpsiBody *to = body_of(balance, k), *from = body_of(balance, l);
    const size_t width = 6 * (size_t)balance->body_count, first = 6 * (size_t)k,
                 other = 6 * (size_t)l;
    double units[2][6];
    find_units(to, units[0]);
    find_units(from, units[1]);
    for (size_t a = 0; a < 6; a++)
        for (size_t b = 0; b < 6; b++) {
            const double *c = balance->coupling, *own = to->report.stiffness,
                         both = k == l ? own[6 * a + b] + own[6 * b + a]
                                       : c[width * (first + a) + other + b] +
                                             c[width * (other + b) + first + a];
            const bool fixed = to->given.fixed[a] || from->given.fixed[b];
            const double rest = k == l && a == b ? 1 : 0;
            balance->together[n * (row + a) + column + b] =
                fixed ? rest : 0.5 * both / (units[0][a] * units[1][b]) - CPSI_NEUTRAL * rest;
        }
}

static bool are_stable_together(CpsiBalance *balance, int count) {
    const size_t n = 6 * (size_t)count;
    size_t row = 0;
    for (int k = 0; k < balance->body_count; k++) {
        if (!body_of(balance, k)->report.is_stable) continue;
        size_t column = 0;
        for (int l = 0; l < balance->body_count; l++) {
            if (!body_of(balance, l)->report.is_stable) continue;
            put_block(balance, k, l, row, column, n);
            column += 6;
        }
        row += 6;
    }
    return cpsi_cholesky((int)n, balance->together, balance->coupling);
}

void cpsi_judge_stability(CpsiBalance *balance) {
    int count = 0;
    for (int k = 0; k < balance->body_count; k++) {
        CpsiBody *body = body_of(balance, k);
        body->report.is_stable =
            cpsi_is_stable(body->report.stiffness, body->given.fixed, body->arm);
        count += body->report.is_stable;
    }
    if (count < 2 || balance->body_count > CPSI_TOGETHER || are_stable_together(balance, count))
        return;
    for (int k = 0; k < balance->body_count; k++) body_of(balance, k)->report.is_stable = false;
}
