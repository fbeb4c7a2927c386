/* SPDX-License-Identifier: BSD-3-Clause */
/* Free bodies together (bodies_together.h).
 *
 * Along small motions u_k of all bodies the energy grows by u' S u / 2, S_kk the stiffness of body
 * k in the file and S_kl what the force on k loses by the motion of l, free points following. It
 * grows along all of them where the pivots of the symmetric part of S are positive. */
#include "bodies_together.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BODIES = 40 };

/* Pivots this small, per the largest entry, may have either sign: the error of the numbers. */
static const Real DEFINITE = 1e-9L;

int pivots_of(Real *m, size_t n) {
    Real most = 0;
    int sign = 1;
    for (size_t i = 0; i < n * n; i++) most = fmaxl(most, fabsl(m[i]));
    for (size_t p = 0; p < n; p++) {
        if (m[n * p + p] < -DEFINITE * most) return -1;
        if (m[n * p + p] <= DEFINITE * most) return 0;
        for (size_t i = p + 1; i < n; i++)
            for (size_t k = p + 1; k < n; k++)
                m[n * i + k] -= m[n * i + p] * m[n * p + k] / m[n * p + p];
    }
    return sign;
}

/* ---- which bodies ---- */

static size_t root(const size_t *of, size_t i) {
    while (of[i] != i) i = of[i];
    return i;
}

/* What moves at an end: a free body, by its number, or a free point, after those; else `none`. */
static size_t mover(const StiffnessStep *step, const BodyState *all, const Junction *point, int at,
                    size_t none) {
    if (at < 0) return none;
    const int body = step->bodies->of_point[at], state = point[at].state;
    if (body >= 0) return all[body].kind == BODY_FREE ? (size_t)body : none;
    const bool is_free = state == POINT_FREE || state == POINT_STICK || state == POINT_SLIP;
    return is_free ? step->bodies->count + (size_t)at : none;
}

/* The group of each body and point, by the lines between them. */
static size_t *find_groups(const StiffnessStep *step, const BodyState *all, const Junction *point) {
    const size_t n = step->bodies->count + step->source->points;
    size_t *of = malloc((n + 1) * sizeof *of);
    if (!of) return NULL;
    for (size_t i = 0; i < n; i++) of[i] = i;
    for (size_t i = 0; i < step->source->lines; i++) {
        const int *end = step->line[i].end_point;
        const size_t a = mover(step, all, point, end[0], n), b = mover(step, all, point, end[1], n);
        if (a < n && b < n) of[root(of, a)] = root(of, b);
    }
    return of;
}

/* ---- their matrix ---- */

/* Lengths in arms, and the largest entry of each body 1. */
static Real unit_of(const BodyData *data, const BodyState *at, double arm, int i) {
    Real most = 0;
    for (int k = 0; k < SIX * SIX; k++) {
        const Real arms = (k / SIX < 3 ? 1 : arm) * (k % SIX < 3 ? 1 : arm);
        if (!data->fixed[k / SIX] && !data->fixed[k % SIX])
            most = fmaxl(most, fabsl(at->stiffness[k]) / arms);
    }
    return (i < 3 ? 1 : arm) * sqrtl(most > 0 ? most : 1);
}

/* Add half of block (k, l), and of its transpose, at rows 6 a and columns 6 b of m (n, n). */
static bool add_block(const StiffnessStep *step, const BodyState *all, const double *arm,
                      const size_t body[2], const size_t place[2], size_t n, Real *m) {
    const size_t k = body[0], l = body[1];
    Real block[SIX * SIX];
    if (k != l && !body_coupling(step, k, l, all, block)) return false;
    for (int i = 0; i < SIX; i++)
        for (int j = 0; j < SIX; j++) {
            const BodyData *to = &step->bodies->data[k], *from = &step->bodies->data[l];
            const size_t row = SIX * place[0] + (size_t)i, column = SIX * place[1] + (size_t)j;
            const Real entry = k == l ? all[k].stiffness[SIX * i + j] : block[SIX * i + j];
            if (to->fixed[i] && k == l && i == j) m[n * row + column] = 1;
            if (to->fixed[i] || from->fixed[j]) continue;
            const Real half =
                entry / (2 * unit_of(to, &all[k], arm[k], i) * unit_of(from, &all[l], arm[l], j));
            m[n * row + column] += half;
            m[n * column + row] += half;
        }
    return true;
}

/* The sign of those together. */
static int sign_of_all(const StiffnessStep *step, const BodyState *all, const double *arm,
                       const size_t *body, size_t count) {
    const size_t n = SIX * count;
    Real *m = calloc(n * n, sizeof *m);
    bool known = m != NULL;
    for (size_t a = 0; a < count && known; a++)
        for (size_t b = 0; b < count && known; b++)
            known = add_block(step, all, arm, (const size_t[2]){body[a], body[b]},
                              (const size_t[2]){a, b}, n, m);
    const int sign = known ? pivots_of(m, n) : 0;
    free(m);
    return sign;
}

/* Of the group of the first of its bodies. */
static void judge_group(const StiffnessStep *step, const BodyState *all, const double *arm,
                        const size_t *of, size_t first, int *sign) {
    size_t body[MOST_BODIES], members = 0;
    bool unsure = false;
    for (size_t k = first; k < step->bodies->count; k++) {
        if (all[k].kind != BODY_FREE || root(of, k) != root(of, first)) continue;
        unsure = unsure || sign[k] == 0 || (sign[k] > 0 && members == MOST_BODIES);
        if (sign[k] > 0 && members < MOST_BODIES) body[members++] = k;
    }
    if (members < 2) return;
    const int together = unsure ? 0 : sign_of_all(step, all, arm, body, members);
    for (size_t k = first; k < step->bodies->count; k++)
        if (all[k].kind == BODY_FREE && root(of, k) == root(of, first) && sign[k] > 0)
            sign[k] = together;
}

void bodies_together(const StiffnessStep *step, const BodyState *all, const Junction *point,
                     const double *arm, int *sign) {
    size_t *of = find_groups(step, all, point);
    const size_t count = of ? step->bodies->count : 0;
    for (size_t g = 0; g < count; g++) {
        size_t first = 0;
        while (root(of, first) != root(of, g)) first++;
        if (first == g) judge_group(step, all, arm, of, g, sign);
    }
    free(of);
}
