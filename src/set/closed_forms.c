/* SPDX-License-Identifier: BSD-3-Clause */
/* Closed forms: support of primitives; projection and gauge of primitives and of sets composed of
 * them without intersections (products, translates, scales; for gauges intersections too). Margins
 * are in margin.c.
 *
 *     ball        h = <w, c> + r|w|
 *     ellipsoid   h = <w, c> + sqrt(w'Sw)
 *     box         h = sum max(w_i low_i, w_i high_i)
 *     cone        h = 0 on its polar, else infinite
 *     gauge of a ball that contains 0: the positive root of
 *                 (r^2 - |c|^2) t^2 + 2 <c, x> t - |x|^2 = 0
 *     polar of a ball that contains 0: h is the ball's gauge t, attained at its gradient
 *                 (w - t c)/(<c, w - t c> + t r^2) */
#include <math.h>
#include <string.h>

#include "linalg/dense.h"
#include "set/set.h"

/* Directions closer than this (radians) count as parallel where a set is unbounded in the direction
 * normal to them. */
static const double PARALLEL = 1e-12;

/* ---- support ---- */

static void unit_axis(int n, int i, double sign, double *point) {
    if (!point) return;
    memset(point, 0, (size_t)n * sizeof *point);
    point[i] = sign;
}

static double support_points(const CpsSet *set, const double *w, double *point) {
    int best = 0;
    double most = -INFINITY;
    for (int k = 0; k < set->count; k++) {
        const double value = cpsi_dot(set->n, w, &set->a[(size_t)k * (size_t)set->n]);
        if (value > most) {
            most = value;
            best = k;
        }
    }
    if (point)
        memcpy(point, &set->a[(size_t)best * (size_t)set->n], (size_t)set->n * sizeof *point);
    return most;
}

static double support_ball(const CpsSet *set, const double *w, double *point) {
    const int n = set->n;
    const double size = cpsi_norm(n, w);
    for (int i = 0; point && i < n; i++)
        point[i] = set->a[i] + (size > 0 ? set->scalar * (w[i] / size) : 0);
    return cpsi_dot(n, w, set->a) + set->scalar * size;
}

static double support_ellipsoid(const CpsSet *set, const double *w, double *point) {
    const int n = set->n;
    double square = 0;
    for (int i = 0; i < n; i++) square += w[i] * cpsi_dot(n, &set->b[(size_t)i * (size_t)n], w);
    const double size = sqrt(square > 0 ? square : 0);
    for (int i = 0; point && i < n; i++)
        point[i] =
            set->a[i] + (size > 0 ? cpsi_dot(n, &set->b[(size_t)i * (size_t)n], w) / size : 0);
    return cpsi_dot(n, w, set->a) + size;
}

static double support_box(const CpsSet *set, const double *w, double *point) {
    double value = 0;
    for (int i = 0; i < set->n; i++) {
        const double low = set->a[i], high = set->b[i];
        const double end = w[i] > 0         ? high
                           : w[i] < 0       ? low
                           : isfinite(low)  ? low
                           : isfinite(high) ? high
                                            : 0;
        if (isinf(end)) {
            unit_axis(set->n, i, w[i], point);
            return INFINITY;
        }
        value += w[i] * end;
        if (point)
            point[i] = w[i] == 0 && isfinite(low) && isfinite(high) ? 0.5 * low + 0.5 * high : end;
    }
    return value;
}

static double support_rays(const CpsSet *set, const double *w, double *point) {
    const size_t n = (size_t)set->n;
    const double size = cpsi_norm(set->n, w);
    if (point) memset(point, 0, n * sizeof *point);
    for (int k = 0; k < set->count; k++) {
        const double *ray = &set->a[(size_t)k * n];
        if (cpsi_dot(set->n, w, ray) <= PARALLEL * size * cpsi_norm(set->n, ray)) continue;
        if (point) memcpy(point, ray, n * sizeof *point);
        return INFINITY;
    }
    return 0;
}

static double support_subspace(const CpsSet *set, const double *w, double *point) {
    const size_t n = (size_t)set->n;
    const double size = cpsi_norm(set->n, w);
    if (point) memset(point, 0, n * sizeof *point);
    for (int k = 0; k < set->count; k++) {
        const double along = cpsi_dot(set->n, w, &set->a[(size_t)k * n]);
        if (fabs(along) <= PARALLEL * size) continue;
        for (size_t i = 0; point && i < n; i++)
            point[i] = copysign(1, along) * set->a[(size_t)k * n + i];
        return INFINITY;
    }
    return 0;
}

/* A half-space or a strip: rows a and perhaps -a. */
static bool is_strip(const CpsSet *set) {
    if (set->kind != CPSI_SET_INEQUALITIES || set->count < 1 || set->count > 2) return false;
    if (set->count == 1) return true;
    for (int i = 0; i < set->n; i++)
        if (set->a[i] != -set->a[set->n + i]) return false;
    return set->b[0] >= -set->b[1];
}

static double support_strip(const CpsSet *set, const double *w, double *point) {
    const int n = set->n;
    const double *a = set->a, square = cpsi_dot(n, a, a), factor = cpsi_dot(n, w, a) / square;
    double left = 0;
    for (int i = 0; i < n; i++) left = hypot(left, w[i] - factor * a[i]);
    const bool across = left > PARALLEL * cpsi_norm(n, w);
    if (across || (set->count == 1 && factor < 0)) {
        for (int i = 0; point && i < n; i++)
            point[i] = across ? (w[i] - factor * a[i]) / left : -a[i];
        return INFINITY;
    }
    const double end = factor >= 0 ? set->b[0] : -set->b[1];
    for (int i = 0; point && i < n; i++) point[i] = end / square * a[i];
    return factor * end;
}

/* ---- balls and the origin ---- */

/* The boundary of a ball passes through 0 where 0 is this near to it, relative to the square of the
 * radius. INSIDE: farther inside than this the root keeps its digits. */
static const double THROUGH_ZERO = 1e-14, INSIDE = 1e-6;

/* Whether the root keeps its digits. Towards the centre it always does. */
static bool gauge_is_known(double square, double cc, double cx) {
    return cx > 0 || fabs(square - cc) <= THROUGH_ZERO * square || cc < square * (1 - INSIDE);
}

/* Root for a ball of square radius `square` about c, given the products. With 0 on the boundary the
 * multiples of the ball fill the open half-space of its centre: |x|^2/2<c, x> there, else
 * infinite. */
static double gauge_ball(double square, double cc, double cx, double xx) {
    const double lead = square - cc;
    if (xx == 0) return 0;
    if (fabs(lead) <= THROUGH_ZERO * square)
        return cx > 1e-15 * sqrt(cc) * sqrt(xx) ? xx / (2 * cx) : INFINITY;
    /* the form without cancellation */
    const double root = sqrt(cx * cx + lead * xx);
    return cx > 0 ? xx / (cx + root) : (root - cx) / lead;
}

/* Component i of the ball's centre; shift NULL: none. */
static double centre(const CpsSet *ball, const double *shift, int i) {
    return ball->a[i] + (shift ? shift[i] : 0);
}

/* Support of the polar of a ball that contains 0. With 0 on the boundary the polar is a paraboloid:
 * it is unbounded in directions across its axis too, although its only ray is -c. Returns false
 * where 0 lies outside or the gauge has lost its digits. */
static bool support_polar(const CpsSet *set, const double *w, double *point, double *value) {
    const CpsSet *part = set->part[0],
                 *ball = part->kind == CPSI_SET_TRANSLATE ? part->part[0] : part;
    const double *shift = ball == part ? NULL : part->a;
    if (ball->kind != CPSI_SET_BALL) return false;
    const double square = ball->scalar * ball->scalar;
    double cc = 0, cw = 0;
    for (int i = 0; i < set->n; i++) {
        const double c = centre(ball, shift, i);
        cc += c * c;
        cw += c * w[i];
    }
    if (!(square > 0) || cc > square * (1 + THROUGH_ZERO) || !gauge_is_known(square, cc, cw))
        return false;
    const double t = gauge_ball(square, cc, cw, cpsi_dot(set->n, w, w)),
                 slope = cw + t * (square - cc);
    for (int i = 0; point && i < set->n; i++) {
        const double c = centre(ball, shift, i);
        point[i] = isinf(t) ? -c : slope > 0 ? (w[i] - t * c) / slope : 0;
    }
    *value = t;
    return true;
}

bool cpsi_closed_support(const CpsSet *set, const double *w, double *point, double *value) {
    switch (set->kind) {
    case CPSI_SET_POINTS: *value = support_points(set, w, point); return true;
    case CPSI_SET_BALL: *value = support_ball(set, w, point); return true;
    case CPSI_SET_ELLIPSOID: *value = support_ellipsoid(set, w, point); return true;
    case CPSI_SET_BOX: *value = support_box(set, w, point); return true;
    case CPSI_SET_RAYS: *value = support_rays(set, w, point); return true;
    case CPSI_SET_SUBSPACE: *value = support_subspace(set, w, point); return true;
    case CPSI_SET_INEQUALITIES:
        if (!is_strip(set)) return false;
        *value = support_strip(set, w, point);
        return true;
    case CPSI_SET_POLAR: return support_polar(set, w, point, value);
    default: return false;
    }
}

/* ---- projection ---- */

static void project_strip(const CpsSet *set, const double *p, double *nearest) {
    const int n = set->n;
    const double at = cpsi_dot(n, set->a, p), low = set->count == 2 ? -set->b[1] : -INFINITY;
    const double to = at > set->b[0] ? set->b[0]
                      : at < low     ? low
                                     : at,
                 shift = (to - at) / cpsi_dot(n, set->a, set->a);
    for (int i = 0; i < n; i++) nearest[i] = p[i] + shift * set->a[i];
}

static void project_subspace(const CpsSet *set, const double *p, double *nearest) {
    const int n = set->n;
    memset(nearest, 0, (size_t)n * sizeof *nearest);
    for (int k = 0; k < set->count; k++) {
        const double *q = &set->a[(size_t)k * (size_t)n], along = cpsi_dot(n, p, q);
        for (int i = 0; i < n; i++) nearest[i] += along * q[i];
    }
}

static bool project_product(const CpsSet *set, const double *p, double *nearest) {
    for (int k = 0, at = 0; k < set->count; at += set->part[k++]->n)
        if (!cpsi_closed_project(set->part[k], p + at, nearest + at)) return false;
    return true;
}

/* translate by g, scale by f: x = g + f y */
static bool project_moved(const CpsSet *set, const double *p, double *nearest) {
    const int n = set->n;
    const bool shift = set->kind == CPSI_SET_TRANSLATE;
    CpsiScratch scratch;
    double *y = cpsi_scratch_take(&scratch, (size_t)n);
    for (int i = 0; y && i < n; i++) y[i] = shift ? p[i] - set->a[i] : p[i] / set->scalar;
    const bool done = y && cpsi_closed_project(set->part[0], y, nearest);
    if (done)
        for (int i = 0; i < n; i++)
            nearest[i] = shift ? nearest[i] + set->a[i] : nearest[i] * set->scalar;
    cpsi_scratch_give(&scratch);
    return done;
}

bool cpsi_closed_project(const CpsSet *set, const double *p, double *nearest) {
    const int n = set->n;
    switch (set->kind) {
    case CPSI_SET_POINTS:
        if (set->hull)
            cpsi_hull_project(set->hull, p, nearest);
        else if (set->count <= 2)
            cpsi_nearest_on_segment(n, set->a, set->a + (set->count - 1) * n, p, nearest);
        return set->hull || set->count <= 2;
    case CPSI_SET_BALL: {
        double distance = 0;
        for (int i = 0; i < n; i++) distance = hypot(distance, p[i] - set->a[i]);
        const double share = distance > set->scalar ? set->scalar / distance : 1;
        for (int i = 0; i < n; i++)
            nearest[i] = share < 1 ? set->a[i] + share * (p[i] - set->a[i]) : p[i];
        return true;
    }
    case CPSI_SET_BOX:
        for (int i = 0; i < n; i++) nearest[i] = fmin(set->b[i], fmax(set->a[i], p[i]));
        return true;
    case CPSI_SET_INEQUALITIES:
        if (!is_strip(set)) return false;
        project_strip(set, p, nearest);
        return true;
    case CPSI_SET_SUBSPACE: project_subspace(set, p, nearest); return true;
    case CPSI_SET_ELLIPSOID: {
        bool inside;
        double distance;
        if (!cpsi_ellipsoid_nearest(set, p, nearest, &distance, &inside)) return false;
        if (inside) memcpy(nearest, p, (size_t)n * sizeof *nearest);
        return true;
    }
    case CPSI_SET_PRODUCT: return project_product(set, p, nearest);
    case CPSI_SET_TRANSLATE:
    case CPSI_SET_SCALE: return project_moved(set, p, nearest);
    default: return false;
    }
}

/* ---- gauge ---- */

static bool moved_ball_gauge(const CpsSet *ball, const double *shift, const double *p,
                             double *value) {
    double cc = 0, cx = 0;
    for (int i = 0; i < ball->n; i++) {
        const double c = centre(ball, shift, i);
        cc += c * c;
        cx += c * p[i];
    }
    const double square = ball->scalar * ball->scalar;
    *value = gauge_ball(square, cc, cx, cpsi_dot(ball->n, p, p));
    return gauge_is_known(square, cc, cx);
}

static bool gauge_ellipsoid(const CpsSet *set, const double *p, double *value) {
    const int n = set->n;
    double cc = 0, cx = 0, xx = 0;
    for (int i = 0; i < n; i++) {
        const double *row = &set->c[(size_t)i * (size_t)n];
        const double c = cpsi_dot(i + 1, row, set->a), x = cpsi_dot(i + 1, row, p);
        cc += c * c;
        cx += c * x;
        xx += x * x;
    }
    *value = gauge_ball(1, cc, cx, xx);
    return gauge_is_known(1, cc, cx);
}

bool cpsi_closed_gauge(const CpsSet *set, const double *p, double *value) {
    const int n = set->n;
    double part = 0;
    *value = 0;
    switch (set->kind) {
    case CPSI_SET_BALL: return moved_ball_gauge(set, NULL, p, value);
    case CPSI_SET_TRANSLATE:
        return set->part[0]->kind == CPSI_SET_BALL &&
               moved_ball_gauge(set->part[0], set->a, p, value);
    case CPSI_SET_ELLIPSOID: return gauge_ellipsoid(set, p, value);
    case CPSI_SET_POINTS:
        if (set->hull) *value = cpsi_hull_gauge(set->hull, p);
        return set->hull != NULL;
    case CPSI_SET_BOX:
        for (int i = 0; i < n; i++)
            if (p[i] != 0)
                *value = fmax(*value,
                              p[i] > 0 ? p[i] / fmax(set->b[i], 0) : p[i] / fmin(set->a[i], -0.0));
        return true;
    case CPSI_SET_INEQUALITIES:
        for (int k = 0; k < set->count; k++) {
            const double along = cpsi_dot(n, &set->a[(size_t)k * (size_t)n], p);
            if (along > 0) *value = fmax(*value, along / fmax(set->b[k], 0));
        }
        return true;
    case CPSI_SET_PRODUCT:
    case CPSI_SET_INTERSECTION:
        for (int k = 0, at = 0; k < set->count;
             at += set->kind == CPSI_SET_PRODUCT ? set->part[k]->n : 0, k++) {
            if (!cpsi_closed_gauge(set->part[k], p + at, &part)) return false;
            *value = fmax(*value, part);
        }
        return true;
    default: return false;
    }
}
