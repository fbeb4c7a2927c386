/* SPDX-License-Identifier: BSD-3-Clause */
/* Small conic programs by the primal barrier method (conic.h): minimise <c, v> over A v + b in K.
 *
 * For a growing weight t the minimum of t <c, v> - sum log z (half-lines) - sum log(z_1^2 - z_2^2 -
 * ..) (cones), with z = A v + b, is found by Newton's method with an exact search along each step.
 * Where the Newton decrement is lambda < 1, <c, v> exceeds the minimum by no more than (nu + lambda
 * sqrt(nu)/(1 - lambda))/t, nu being 1 for a half-line and 2 for a cone (Nesterov and Nemirovskii
 * 1994): a bound that needs nothing but a point inside. */
#include "conic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What a value is found to, of data of order one; 64-bit mantissas leave 1e-19. Where multipliers
 * are large, as those of shallow angles, cones shrink below that rounding before the weight is as
 * large as this asks: then the last weight that was settled counts, if it leaves no more than
 * ENOUGH. */
static const Real ACCURACY = 1e-14L, ENOUGH = 1e-10L;
/* Cones that leave a smaller margin than LEAST_MARGIN, of rows of order one, are widened by WIDER.
 */
static const Real LEAST_MARGIN = 1e-9L, WIDER = 1e-13L;
static const Real GROWTH = 10, LAST_DECREMENT = 1e-3L;
enum { MOST_NEWTON = 2000, HALVINGS = 40 };

typedef struct Program {
    size_t n, m;
    const size_t *cone;
    const Real *a, *b, *c;
    Real *v, *gradient, *step, *cost; /* (n) */
    Real *settled;                    /* (n) v of the last weight that was settled */
    Real *z, *dz, *at;                /* (m) */
    Real *root, *r;                   /* (n, m), (n, n) */
} Program;

static Real dot(size_t n, const Real *x, const Real *y) {
    Real sum = 0;
    for (size_t i = 0; i < n; i++) sum += x[i] * y[i];
    return sum;
}

/* z_1^2 - z_2^2 - ..; a half-line's is z^2 */
static Real det(size_t size, const Real *z) {
    Real tail = sqrtl(dot(size - 1, z + 1, z + 1));
    return (z[0] - tail) * (z[0] + tail);
}

/* <x, Jy> */
static Real form(size_t size, const Real *x, const Real *y) {
    return x[0] * y[0] - dot(size - 1, x + 1, y + 1);
}

static Real degree(size_t size) { return size == 1 ? 1 : 2; }

/* Is z + by dz inside, and how does the barrier grow along dz there? */
static bool slope(const Program *p, Real by, Real *growth) {
    Real *at = p->at;
    *growth = 0;
    for (size_t i = 0; i < p->m; i++) at[i] = p->z[i] + by * p->dz[i];
    for (size_t i = 0; i < p->m; i += p->cone[i]) {
        Real d = det(p->cone[i], &at[i]);
        if (!(at[i] > 0 && d > 0)) return false;
        *growth -= degree(p->cone[i]) * form(p->cone[i], &at[i], &p->dz[i]) / d;
    }
    return true;
}

/* z, and the gradient of t <c, v> and the barrier at v; in the rows of `root` the columns of a
 * matrix M with M'M = the barrier's Hessian: those of A over z for a half-line, of sqrt 2 (2 y y' -
 * det(y) J) A with y = z^(-1/2) for a cone. Its condition is the root of the Hessian's, which near
 * a face is that of t^2. */
static void differentiate(const Program *p, Real t) {
    size_t n = p->n, m = p->m;
    for (size_t i = 0; i < m; i++) p->z[i] = dot(n, &p->a[i * n], p->v) + p->b[i];
    for (size_t j = 0; j < n; j++) p->gradient[j] = t * p->c[j];
    for (size_t i = 0; i < m; i += p->cone[i]) {
        size_t size = p->cone[i];
        const Real *a = &p->a[i * n], *z = &p->z[i];
        Real tail = sqrtl(dot(size - 1, z + 1, z + 1)), d = (z[0] - tail) * (z[0] + tail),
             *y = p->dz;
        Real low = 1 / sqrtl(z[0] + tail), high = 1 / sqrtl(z[0] - tail),
             root = sqrtl(degree(size));
        y[0] = (low + high) / 2;
        for (size_t r = 1; r < size; r++) y[r] = tail > 0 ? (low - high) / 2 * z[r] / tail : 0;
        for (size_t j = 0; j < n; j++) {
            Real jz = z[0] * a[j], along = 0, *column = &p->root[j * m + i];
            for (size_t r = 1; r < size; r++) jz -= z[r] * a[r * n + j];
            for (size_t r = 0; r < size; r++) along += y[r] * a[r * n + j];
            p->gradient[j] -= degree(size) * jz / d;
            for (size_t r = 0; r < size; r++)
                column[r] =
                    root * (2 * y[r] * along - (r > 0 ? -1 : 1) * low * high * a[r * n + j]);
        }
    }
}

/* step = -(M'M)^-1 gradient, by R of M = Q R (modified Gram and Schmidt); returns the decrement,
 * NAN where M is singular. */
static Real newton(const Program *p) {
    size_t n = p->n, m = p->m;
    Real *x = p->step, decrement = 0;
    for (size_t j = 0; j < n; j++) {
        Real *column = &p->root[j * m], size = sqrtl(dot(m, column, column));
        if (!(size > 0)) return NAN;
        p->r[j * n + j] = size;
        for (size_t i = 0; i < m; i++) column[i] /= size;
        for (size_t k = j + 1; k < n; k++) {
            Real *other = &p->root[k * m], common = p->r[j * n + k] = dot(m, column, other);
            for (size_t i = 0; i < m; i++) other[i] -= common * column[i];
        }
    }
    for (size_t i = 0; i < n; i++) {
        x[i] = -p->gradient[i];
        for (size_t j = 0; j < i; j++) x[i] -= p->r[j * n + i] * x[j];
        x[i] /= p->r[i * n + i];
        decrement += x[i] * x[i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; j++) x[i] -= p->r[i * n + j] * x[j];
        x[i] /= p->r[i * n + i];
    }
    return sqrtl(decrement);
}

/* From v inside to the minimum for the weight t; returns the decrement that is left, NAN where
 * Newton's method fails.
 */
static Real settle(const Program *p, Real t, Real wanted) {
    Real last = INFINITY;
    for (int round = 0; round < MOST_NEWTON; round++) {
        differentiate(p, t);
        Real left = newton(p), growth, by = 1, low = 0;
        if (!(left > wanted) || (left < 0.1L && !(left < last)))
            return left; // rounding stops it below wanted or never
        last = left;
        for (size_t i = 0; i < p->m; i++) p->dz[i] = dot(p->n, &p->a[i * p->n], p->step);
        Real pull = t * dot(p->n, p->c, p->step);
        if (!slope(p, 1, &growth) || growth + pull > 0) { // the largest way on which it still falls
            Real high = 1;
            for (int k = 0; k < HALVINGS; k++) {
                Real middle = (low + high) / 2;
                if (slope(p, middle, &growth) && growth + pull <= 0)
                    low = middle;
                else
                    high = middle;
            }
            by = low;
        }
        if (by == 0) return left;
        for (size_t j = 0; j < p->n; j++) p->v[j] += by * p->step[j];
    }
    return NAN;
}

/* From v inside to <c, v> that exceeds the minimum by no more than *gap. False: not found. */
static bool minimise(const Program *p, Real *gap) {
    Real nu = 0, t = 1, left = 0;
    *gap = INFINITY;
    for (size_t i = 0; i < p->m; i += p->cone[i]) nu += degree(p->cone[i]);
    for (; t * ACCURACY < nu * GROWTH; t *= GROWTH) {
        left = settle(p, t, LAST_DECREMENT);
        if (!(left < 0.5L)) break;
        *gap = (nu + left * sqrtl(nu) / (1 - left)) / t;
        memcpy(p->settled, p->v, p->n * sizeof *p->v);
    }
    if (*gap < INFINITY) memcpy(p->v, p->settled, p->n * sizeof *p->v);
    return *gap <= ENOUGH;
}

/* Scratch for n unknowns and m rows, in one block that begins at v. */
static bool take(Program *p, size_t n, size_t m) {
    Real *block = calloc(5 * n + 3 * m + n * m + n * n + 1, sizeof *block);
    p->n = n;
    p->m = m;
    p->v = block;
    p->gradient = block + n;
    p->step = block + 2 * n;
    p->cost = block + 3 * n;
    p->settled = block + 4 * n;
    p->z = block + 5 * n;
    p->dz = p->z + m;
    p->at = p->dz + m;
    p->root = p->at + m;
    p->r = p->root + n * m;
    p->c = p->cost;
    return block != NULL;
}

Conic *conic_create(size_t space, size_t unknowns, size_t rows) {
    Conic *set = calloc(1, sizeof *set);
    if (!set) return NULL;
    *set = (Conic){.space = space, .unknowns = unknowns, .rows = rows};
    set->cone = calloc(rows + 1, sizeof *set->cone);
    set->a = calloc(rows * unknowns + rows + (space + 1) * unknowns + 1, sizeof *set->a);
    if (!set->cone || !set->a) {
        conic_free(set);
        return NULL;
    }
    set->b = set->a + rows * unknowns;
    set->map = set->b + rows;
    set->centre = set->map + space * unknowns;
    return set;
}

void conic_free(Conic *set) {
    if (!set) return;
    free(set->cone);
    free(set->a);
    free(set);
}

/* The largest margin r <= 1 with A v + b - r e in K, e the first axes of the cones, as a program in
 * (v, -r). */
static Real find_margin(Conic *set) {
    size_t n = set->unknowns, m = set->rows;
    Program p;
    Conic *wider = conic_create(set->space, n + 1, m + 1);
    Real margin = NAN, gap, most = 1;
    if (!wider) return NAN;
    for (size_t i = 0; i < m; i++) {
        memcpy(&wider->a[i * (n + 1)], &set->a[i * n], n * sizeof *set->a);
        wider->b[i] = set->b[i];
        wider->cone[i] = set->cone[i];
        wider->a[i * (n + 1) + n] = set->cone[i] > 0;
        most += fabsl(set->b[i]);
    }
    wider->a[m * (n + 1) + n] = 1;
    wider->b[m] = 1;
    wider->cone[m] = 1;
    if (take(&p, n + 1, m + 1)) {
        p.cone = wider->cone;
        p.a = wider->a;
        p.b = wider->b;
        p.cost[n] = 1;
        p.v[n] = 2 * most;
        if (minimise(&p, &gap)) margin = -p.v[n];
        memcpy(set->centre, p.v, n * sizeof *p.v);
    }
    free(p.v);
    conic_free(wider);
    return margin;
}

bool conic_prepare(Conic *set) {
    set->reach = hypotl(hypotl(set->origin[0], set->origin[1]), set->origin[2]);
    for (size_t j = 0; j < set->space * set->unknowns; j++)
        set->reach = hypotl(set->reach, set->map[j]);
    if (set->unknowns == 0) return true;
    Real margin = find_margin(set);
    if (!(margin > -WIDER / 2)) return false;
    if (margin < LEAST_MARGIN)
        for (size_t i = 0; i < set->rows; i += set->cone[i]) set->b[i] += WIDER;

    // the centre: no cost at all
    Program p;
    bool found = take(&p, set->unknowns, set->rows);
    if (found) {
        p.cone = set->cone;
        p.a = set->a;
        p.b = set->b;
        memcpy(p.v, set->centre, set->unknowns * sizeof *p.v);
        found = settle(&p, 0, LAST_DECREMENT) < 0.5L;
        memcpy(set->centre, p.v, set->unknowns * sizeof *p.v);
    }
    free(p.v);
    return found;
}

Real conic_support(const Conic *set, const Real *d) {
    size_t n = set->unknowns;
    Real size = 0, gap = 0, value = dot(set->space, d, set->origin);
    Program p;
    if (!take(&p, n, set->rows)) return NAN;
    for (size_t j = 0; j < n; j++) {
        for (size_t k = 0; k < set->space; k++) p.cost[j] -= d[k] * set->map[k * n + j];
        size = hypotl(size, p.cost[j]);
    }
    if (size > 0) {
        for (size_t j = 0; j < n; j++) p.cost[j] /= size;
        p.cone = set->cone;
        p.a = set->a;
        p.b = set->b;
        memcpy(p.v, set->centre, n * sizeof *p.v);
        value = minimise(&p, &gap) ? value + size * (gap - dot(n, p.cost, p.v)) : NAN;
    }
    free(p.v);
    return value;
}

/* The least r with |origin + P v - F| <= r reach, in (v, r): one more cone. */
Real conic_distance(const Conic *set, const Real *F) {
    size_t n = set->unknowns, m = set->rows, space = set->space;
    Real off[3] = {0}, gap, distance = NAN;
    for (size_t k = 0; k < space; k++) off[k] = set->origin[k] - F[k];
    if (n == 0) return sqrtl(dot(space, off, off));
    Conic *all = conic_create(space, n + 1, m + space + 1);
    Program p = {.v = NULL};
    if (all && take(&p, n + 1, m + space + 1)) {
        size_t w = n + 1;
        for (size_t i = 0; i < m; i++) {
            memcpy(&all->a[i * w], &set->a[i * n], n * sizeof *all->a);
            all->b[i] = set->b[i];
            all->cone[i] = set->cone[i];
        }
        all->cone[m] = space + 1;
        all->a[m * w + n] = p.cost[n] = 1;
        for (size_t k = 0; k < space; k++) {
            for (size_t j = 0; j < n; j++)
                all->a[(m + 1 + k) * w + j] = set->map[k * n + j] / set->reach;
            all->b[m + 1 + k] = off[k] / set->reach;
        }
        p.cone = all->cone;
        p.a = all->a;
        p.b = all->b;
        memcpy(p.v, set->centre, n * sizeof *p.v);
        for (size_t k = 0; k < space; k++) off[k] += dot(n, &set->map[k * n], p.v);
        p.v[n] = 1 + sqrtl(dot(space, off, off)) / set->reach;
        // the point found is one of the set, whatever the bound says
        if (minimise(&p, &gap)) {
            for (size_t k = 0; k < space; k++)
                off[k] = set->origin[k] - F[k] + dot(n, &set->map[k * n], p.v);
            distance = sqrtl(dot(space, off, off));
        }
    }
    free(p.v);
    conic_free(all);
    return distance;
}
