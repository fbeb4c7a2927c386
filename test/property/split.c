/* SPDX-License-Identifier: BSD-3-Clause */
/* Certificates for intersections (split.h). The splitting is read off x: w is written as a sum with
 * factors >= 0 of the unit normals of the parts that x touches, by non-negative least squares
 * (Lawson and Hanson 1974, chapter 23); what is left over goes to the first part, so that the
 * pieces add up to w whatever x is. */
#include "split.h"

#include <math.h>
#include <string.h>

/* x touches a part within this share of its size: a normal too many does no harm. */
static const double TOUCH = 1e-5;

enum { MOST_NORMALS = SPLIT_PARTS * MAX_SPACE };

int split_random(int n, SplitPart *part) {
    const int count = 2 + below(SPLIT_PARTS - 1);
    double at[MAX_SPACE];
    fill(n, 1, at);
    for (int k = 0; k < count; k++) {
        SplitPart *one = &part[k];
        memset(one, 0, sizeof *one);
        one->kind = (SplitKind)below(k == 0 ? 3 : 5);
        fill(n, 0.2, one->centre);
        for (int i = 0; i < n; i++) {
            one->centre[i] += at[i];
            one->half[i] = uniform(0.4, 1.5);
        }
        do {
            fill(n * n, 0.6, one->factor);
            for (int i = 0; i < n; i++) one->factor[i * n + i] += 1;
        } while (!invert(n, one->factor, 0.01, one->inverse));
        fill(n, 1, one->normal);
        one->low = one->kind == SPLIT_STRIP ? dot(n, one->normal, at) - uniform(0, 1) : -INFINITY;
        one->high = dot(n, one->normal, at) + uniform(0, 1);
    }
    return count;
}

CpsSet *split_set(int n, const SplitPart *part) {
    double a[MAX_SPACE], b[MAX_SPACE], shape[MAX_SPACE * MAX_SPACE];
    CpsSet *set = NULL;
    for (int i = 0; i < n; i++) {
        a[i] = part->centre[i] - part->half[i];
        b[i] = part->centre[i] + part->half[i];
        for (int j = 0; j < n; j++)
            shape[i * n + j] = dot(n, &part->factor[i * n], &part->factor[j * n]);
    }
    switch (part->kind) {
    case SPLIT_BALL: DO(cps_set_ball(n, part->centre, part->half[0], &set, &err)); break;
    case SPLIT_ELLIPSOID: DO(cps_set_ellipsoid(n, part->centre, shape, &set, &err)); break;
    case SPLIT_BOX: DO(cps_set_box(n, a, b, &set, &err)); break;
    case SPLIT_HALF_SPACE: DO(cps_set_half_space(n, part->normal, part->high, &set, &err)); break;
    case SPLIT_STRIP: DO(cps_set_strip(n, part->normal, part->low, part->high, &set, &err)); break;
    }
    return set;
}

/* One unit normal that may press: of which part, and its offset for parts that have no other
 * normals. */
typedef struct Normal {
    int part;
    double direction[MAX_SPACE], offset;
} Normal;

/* How far x is outside of the part, and the unit normals of what it touches, into list; *count
 * grows. */
static double touched(int n, int k, const SplitPart *part, const double *x, Normal *list,
                      int *count) {
    double d[MAX_SPACE], y[MAX_SPACE], outside = -INFINITY;
    for (int i = 0; i < n; i++) d[i] = x[i] - part->centre[i];
    if (part->kind == SPLIT_BALL || part->kind == SPLIT_ELLIPSOID) {
        const bool ball = part->kind == SPLIT_BALL;
        times(n, n, part->inverse, 1, d, y);
        const double radius = ball ? part->half[0] : 1, far = ball ? norm(n, d) : norm(n, y);
        if (far > radius * (1 - TOUCH)) {
            Normal *normal = &list[(*count)++];
            normal->part = k;
            if (ball)
                memcpy(normal->direction, d, sizeof d);
            else
                times(n, n, part->inverse, -1, y, normal->direction);
            const double size = norm(n, normal->direction);
            for (int i = 0; i < n; i++) normal->direction[i] /= size;
        }
        return (far - radius) * (ball ? 1 : norm(n * n, part->factor));
    }
    if (part->kind == SPLIT_BOX) {
        for (int i = 0; i < n; i++) {
            outside = fmax(outside, fabs(d[i]) - part->half[i]);
            if (fabs(d[i]) < part->half[i] * (1 - TOUCH)) continue;
            Normal *normal = &list[(*count)++];
            *normal = (Normal){.part = k};
            normal->direction[i] = d[i] > 0 ? 1 : -1;
        }
        return outside;
    }
    const double size = norm(n, part->normal), along = dot(n, part->normal, x);
    for (int side = 1; side >= -1; side -= 2) {
        const double end = side > 0 ? part->high : -part->low, off = (side * along - end) / size;
        outside = fmax(outside, off);
        if (!(off > -TOUCH)) continue;
        Normal *normal = &list[(*count)++];
        normal->part = k;
        normal->offset = end / size;
        for (int i = 0; i < n; i++) normal->direction[i] = side * part->normal[i] / size;
    }
    return outside;
}

/* Least squares on the normals that are in use, by the normal equations; false where they are
 * dependent. */
static bool least_squares(int n, int used, const int *use, const Normal *list, const double *w,
                          double *factor) {
    double gram[MAX_SPACE * MAX_SPACE], inverse[MAX_SPACE * MAX_SPACE], right[MAX_SPACE];
    for (int i = 0; i < used; i++) {
        right[i] = dot(n, list[use[i]].direction, w);
        for (int j = 0; j < used; j++)
            gram[i * used + j] = dot(n, list[use[i]].direction, list[use[j]].direction);
    }
    if (!invert(used, gram, 1e-10, inverse)) return false;
    times(used, used, inverse, 1, right, factor);
    return true;
}

/* w = sum factor_j direction_j + left, factors >= 0, |left| least; normals that are nearly
 * dependent stay out. */
static void spread(int n, int count, const Normal *list, const double *w, double *factor,
                   double *left) {
    int use[MAX_SPACE], used = 0;
    bool barred[MOST_NORMALS] = {false};
    memset(factor, 0, (size_t)count * sizeof *factor);
    for (int round = 0; round < 100; round++) {
        memcpy(left, w, (size_t)n * sizeof *w);
        for (int j = 0; j < count; j++)
            for (int i = 0; i < n; i++) left[i] -= factor[j] * list[j].direction[i];
        /* the normal that would gain most joins */
        int best = -1;
        double gain = 1e-14 * norm(n, w), trial[MAX_SPACE];
        for (int j = 0; j < count; j++) {
            const double along = dot(n, list[j].direction, left);
            if (factor[j] == 0 && !barred[j] && along > gain) {
                best = j;
                gain = along;
            }
        }
        if (best < 0 || used == n) return;
        use[used++] = best;
        barred[best] = true;
        while (used > 0) {
            if (!least_squares(n, used, use, list, w, trial)) { /* the last one is no news */
                used--;
                continue;
            }
            /* go as far as all stay >= 0; the one that stops leaves */
            double share = 1;
            int stop = -1;
            for (int i = 0; i < used; i++) {
                const double now = factor[use[i]];
                if (trial[i] < 0 && now / (now - trial[i]) < share) {
                    share = now / (now - trial[i]);
                    stop = i;
                }
            }
            for (int i = 0; i < used; i++) factor[use[i]] += share * (trial[i] - factor[use[i]]);
            if (stop < 0) break;
            factor[use[stop]] = 0;
            use[stop] = use[--used];
        }
        if (used > 0)
            for (int j = 0; j < count; j++) barred[j] = j == best && factor[j] == 0;
    }
}

/* h of one part at u, which for half-spaces and strips is `press` times the unit normals chosen */
static double support(int n, const SplitPart *part, const double *u, double press) {
    double turned[MAX_SPACE], value = dot(n, u, part->centre);
    switch (part->kind) {
    case SPLIT_BALL: return value + part->half[0] * norm(n, u);
    case SPLIT_ELLIPSOID: times(n, n, part->factor, -1, u, turned); return value + norm(n, turned);
    case SPLIT_BOX:
        for (int i = 0; i < n; i++) value += part->half[i] * fabs(u[i]);
        return value;
    default: return press;
    }
}

SplitBounds split_bounds(int n, int count, const SplitPart *part, const double *w,
                         const double *x) {
    Normal list[MOST_NORMALS];
    double factor[MOST_NORMALS], left[MAX_SPACE];
    SplitBounds bounds = {.lower = dot(n, w, x), .outside = 0};
    int normals = 0;
    for (int k = 0; k < count; k++)
        bounds.outside = fmax(bounds.outside, touched(n, k, &part[k], x, list, &normals));
    spread(n, normals, list, w, factor, left);
    for (int k = 0; k < count; k++) {
        double u[MAX_SPACE] = {0}, press = 0;
        if (k == 0) memcpy(u, left, sizeof u);
        for (int j = 0; j < normals; j++) {
            if (list[j].part != k) continue;
            press += factor[j] * list[j].offset;
            for (int i = 0; i < n; i++) u[i] += factor[j] * list[j].direction[i];
        }
        bounds.upper += support(n, &part[k], u, press);
    }
    return bounds;
}
