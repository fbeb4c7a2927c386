/* SPDX-License-Identifier: BSD-3-Clause */
/* The margin of a point in closed form, for sets that have one:
 *
 *     products, intersections    inside, the least of the parts' margins
 *     C + ball                   margin in C, inside or outside, plus the radius
 *     translates, scales, images by similarities    the part's margin times the factor
 *     preimages by L with L L' = s^2 I
 *         margin of L p + shift over s, since L maps balls onto balls
 *     polar of points v_k                           least (1 - <v_k, p>)/|v_k| */
#include <math.h>
#include <string.h>

#include "linalg/dense.h"
#include "set/set.h"

/* The length s of the rows of a map whose rows are normal to each other and of one length, up to
 * rounding; else 0. */
static double similar(int rows, int n, const double *map) {
    const double size = cpsi_norm(n, map);
    for (int i = 0; i < rows; i++)
        for (int j = 0; j <= i; j++) {
            const double product = cpsi_dot(n, &map[i * n], &map[j * n]) / size / size;
            if (!(fabs(product - (i == j)) <= 2e-15)) return 0;
        }
    return size;
}

/* C + ball, where all parts but one are balls and points. */
static bool sum_margin(const CpsSet *set, const double *p, double *separating, double *margin) {
    const CpsSet *other = NULL;
    const int n = set->n;
    double radius = 0;
    for (int k = 0; k < set->count; k++) {
        const CpsSet *part = set->part[k];
        if (part->kind == CPSI_SET_BALL)
            radius += part->scalar;
        else if (part->kind == CPSI_SET_POINTS && part->count == 1)
            continue;
        else if (other)
            return false;
        else
            other = part;
    }
    CpsiScratch scratch;
    double *q = cpsi_scratch_take(&scratch, (size_t)n), distance = 0;
    if (!q) return false;
    memcpy(q, p, (size_t)n * sizeof *q);
    for (int k = 0; k < set->count; k++)
        if (set->part[k] != other)
            for (int i = 0; i < n; i++) q[i] -= set->part[k]->a[i];
    bool done = true;
    if (other)
        done = cpsi_closed_margin(other, q, separating, &distance);
    else {
        distance = -cpsi_norm(n, q);
        for (int i = 0; separating && i < n; i++)
            separating[i] = distance < 0 ? -q[i] / distance : 0;
    }
    if (done) *margin = distance + radius;
    if (done && separating && *margin >= 0) memset(separating, 0, (size_t)n * sizeof *separating);
    cpsi_scratch_give(&scratch);
    return done;
}

/* Images and preimages by similarities. */
static bool mapped_margin(const CpsSet *set, const double *p, double *separating, double *margin) {
    const CpsSet *part = set->part[0];
    const bool image = set->kind == CPSI_SET_IMAGE;
    const int n = set->n, m = part->n;
    if (image ? m != n : m > n) return false;
    const double size = similar(m, n, set->a);
    if (!(size > 0)) return false;
    CpsiScratch scratch;
    double *q = cpsi_scratch_take(&scratch, 2 * (size_t)m), *away = q ? q + m : NULL;
    if (!q) return false;
    for (int i = 0; i < m; i++) {
        q[i] = image ? 0 : cpsi_dot(n, &set->a[i * n], p) + set->b[i];
        if (image)
            for (int j = 0; j < n; j++) q[i] += set->a[j * n + i] * p[j] / size / size;
    }
    const bool done = cpsi_closed_margin(part, q, separating ? away : NULL, margin);
    if (done) *margin = image ? *margin * size : *margin / size;
    if (done)
        for (int i = 0; separating && i < n; i++) {
            separating[i] = 0;
            for (int j = 0; j < m; j++)
                separating[i] += (image ? set->a[i * m + j] : set->a[j * n + i]) * away[j] / size;
        }
    cpsi_scratch_give(&scratch);
    return done;
}

static bool moved_margin(const CpsSet *set, const double *p, double *separating, double *margin) {
    const int n = set->n;
    const bool shift = set->kind == CPSI_SET_TRANSLATE;
    CpsiScratch scratch;
    double *y = cpsi_scratch_take(&scratch, (size_t)n);
    for (int i = 0; y && i < n; i++) y[i] = shift ? p[i] - set->a[i] : p[i] / set->scalar;
    const bool done = y && cpsi_closed_margin(set->part[0], y, separating, margin);
    if (done && !shift) *margin *= fabs(set->scalar);
    if (done && !shift)
        for (int i = 0; separating && i < n; i++) separating[i] *= copysign(1, set->scalar);
    cpsi_scratch_give(&scratch);
    return done;
}

static bool ellipsoid_margin(const CpsSet *set, const double *p, double *radius) {
    bool inside = false;
    CpsiScratch scratch;
    double *nearest = cpsi_scratch_take(&scratch, (size_t)set->n);
    const bool done = nearest && cpsi_ellipsoid_nearest(set, p, nearest, radius, &inside);
    if (!inside) *radius = -1;
    cpsi_scratch_give(&scratch);
    return done;
}

/* The radius of the largest ball round a point of the set, a negative number for other points.
 * Returns false where no formula is known. */
static bool inner_radius(const CpsSet *set, const double *p, double *radius) {
    const int n = set->n;
    double least = INFINITY, part = 0;
    switch (set->kind) {
    case CPSI_SET_POINTS:
        *radius = set->hull && set->hull->dimension == n ? cpsi_hull_margin(set->hull, p) : 0;
        return set->hull || (set->count <= 2 && (n > 1 || set->count == 1));
    case CPSI_SET_BALL:
        for (int i = 0; i < n; i++) part = hypot(part, p[i] - set->a[i]);
        *radius = set->scalar - part;
        return true;
    case CPSI_SET_ELLIPSOID: return ellipsoid_margin(set, p, radius);
    case CPSI_SET_BOX:
        for (int i = 0; i < n; i++) least = fmin(least, fmin(p[i] - set->a[i], set->b[i] - p[i]));
        break;
    case CPSI_SET_INEQUALITIES:
        for (int k = 0; k < set->count; k++) {
            const double *a = &set->a[(size_t)k * (size_t)n];
            least = fmin(least, (set->b[k] - cpsi_dot(n, a, p)) / cpsi_norm(n, a));
        }
        break;
    case CPSI_SET_POLAR:
        if (set->part[0]->kind != CPSI_SET_POINTS) return false;
        for (int k = 0; k < set->part[0]->count; k++) {
            const double *a = &set->part[0]->a[(size_t)k * (size_t)n], size = cpsi_norm(n, a);
            if (size > 0) least = fmin(least, (1 - cpsi_dot(n, a, p)) / size);
        }
        break;
    case CPSI_SET_SUBSPACE: least = set->count < n ? 0 : INFINITY; break;
    case CPSI_SET_PRODUCT:
    case CPSI_SET_INTERSECTION:
        for (int k = 0, at = 0; k < set->count;
             at += set->kind == CPSI_SET_PRODUCT ? set->part[k]->n : 0, k++) {
            if (!cpsi_closed_margin(set->part[k], p + at, NULL, &part)) return false;
            least = fmin(least, part);
        }
        break;
    default: return false;
    }
    *radius = least;
    return true;
}

bool cpsi_closed_margin(const CpsSet *set, const double *p, double *separating, double *margin) {
    switch (set->kind) {
    case CPSI_SET_TRANSLATE:
    case CPSI_SET_SCALE: return moved_margin(set, p, separating, margin);
    case CPSI_SET_SUM: return sum_margin(set, p, separating, margin);
    case CPSI_SET_IMAGE:
    case CPSI_SET_PREIMAGE: return mapped_margin(set, p, separating, margin);
    default: break;
    }
    const int n = set->n;
    double distance = 0;
    const bool inside = inner_radius(set, p, margin) && *margin >= 0 &&
                        (set->kind != CPSI_SET_POINTS || (set->hull && set->hull->dimension == n));
    if (inside && (set->kind != CPSI_SET_SUBSPACE || set->count == n)) {
        if (separating) memset(separating, 0, (size_t)n * sizeof *separating);
        return true;
    }
    CpsiScratch scratch;
    double *nearest = cpsi_scratch_take(&scratch, (size_t)n);
    bool done = nearest && cpsi_closed_project(set, p, nearest);
    if (done)
        for (int i = 0; i < n; i++) distance = hypot(distance, p[i] - nearest[i]);
    if (done && distance > 0)
        *margin = -distance;
    else if (done)
        done = inner_radius(set, p, margin);
    if (done && !(distance > 0)) *margin = fmax(*margin, 0);
    if (done)
        for (int i = 0; separating && i < n; i++)
            separating[i] = distance > 0 ? (p[i] - nearest[i]) / distance : 0;
    cpsi_scratch_give(&scratch);
    return done;
}
