/* SPDX-License-Identifier: BSD-3-Clause */
/* A user's function h of speed: checked at every evaluation, and its conjugate by bisection.
 *
 * h is convex and increasing from h(0) = 0 when its slopes do not decrease and every tangent lies
 * below the known points. Each evaluation is compared with speed 0, and each step of a bisection
 * with both ends of its bracket. */
#include "base/status.h"
#include "law/resistance.h"

/* Values and slopes of a carefully written function are accurate to a few ulps, differences of them
 * less so. */
static const double SLACK = 1e-9;
/* Slopes that differ by less are equal: the function is linear there. */
static const double STRAIGHT = 1e-14;
/* Speeds beyond these are never needed; the squares of these neither overflow nor vanish. */
static const double FASTEST = 1e150, SLOWEST = 1e-150;
/* Smaller values may have lost all digits. */
static const double VANISHING = 1e-290;

/* A point of h. */
typedef struct Point {
    double g, h, slope;
} Point;

static CpsStatus falls(double slow, double high, double fast, double low, CpsError *err) {
    return cpsi_fail(
        err, CPS_ERR_ARGUMENT,
        "the user's function is not convex: its slope falls from %g at speed %g to %g at speed %g; "
        "friction that falls with speed is no subdifferential of a convex potential (Moreau 1970, "
        "section 7)",
        high, slow, low, fast);
}

/* Check that h is convex between two points: h(b) - h(a) lies between the slopes times b - a. */
static CpsStatus check_between(const Point *a, const Point *b, CpsError *err) {
    if (isinf(b->h)) return CPS_OK;
    if (isinf(a->h) || a->slope > b->slope + SLACK * b->slope + VANISHING)
        return falls(a->g, a->slope, b->g, b->slope, err);
    const double rise = b->h - a->h, width = b->g - a->g,
                 slack = SLACK * (b->h + a->h + b->slope * width) + VANISHING;
    if (rise < a->slope * width - slack || rise > b->slope * width + slack)
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "the user's function rises by %g from speed %g to %g, expected from %g to %g: its "
            "slope falls with speed between, which is no subdifferential of a convex potential "
            "(Moreau 1970, section 7), or it is not the slope of its values",
            rise, a->g, b->g, a->slope * width, b->slope * width);
    return CPS_OK;
}

static CpsStatus evaluate(const CpsiTerm *term, double g, Point *at, CpsError *err) {
    *at = (Point){.g = g};
    if (!term->h(term->user, g, &at->h, &at->slope) || isnan(at->h) || isnan(at->slope))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the user's function has no value and slope at speed %g", g);
    if (isinf(at->h) || isinf(at->slope)) at->h = at->slope = INFINITY;
    if (at->h < 0)
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "the user's function is %g at speed %g: phi < phi(0) would give power to the motion",
            at->h, g);
    if (at->slope < 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the user's function has slope %g at speed %g: it would give power to the "
                         "motion; slopes are at least 0",
                         at->slope, g);
    if (g == 0 && at->h != 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the user's function is %g at speed 0, expected 0",
                         at->h);
    const Point rest = {0};
    return check_between(&rest, at, err);
}

CpsStatus cpsi_function_at(const CpsiTerm *term, double g, double *h, double *slope,
                           CpsError *err) {
    Point at;
    const CpsStatus status = evaluate(term, fmin(g, FASTEST), &at, err);
    if (status == CPS_OK) {
        *h = g > FASTEST ? INFINITY : at.h;
        *slope = at.slope;
    }
    return status;
}

/* Points far apart detect a decreasing slope, points close together a slope that is not the
 * derivative of h. */
CpsStatus cpsi_function_check(const CpsiTerm *term, CpsError *err) {
    Point last, next;
    CpsStatus status = evaluate(term, 0, &last, err);
    for (double g = 0x1p-40; g <= 0x1p40; g *= 2)
        for (int close = 0; close < 2 && status == CPS_OK; close++, last = next) {
            status = evaluate(term, close ? g + 0x1p-10 * g : g, &next, err);
            if (status == CPS_OK) status = check_between(&last, &next, err);
        }
    return status;
}

/* ---- conjugate ---- */

/* A bracket (below, above) of neighbouring speeds with slope(below) < s <= slope(above), at or
 * after `below`; above->g is INFINITY where no slope reaches s. */
static CpsStatus find(const CpsiTerm *term, double s, Point *below, Point *above, CpsError *err) {
    CpsStatus status = CPS_OK;
    *above = *below;
    for (double g = fmax(1, 2 * below->g); above->slope < s && status == CPS_OK; g *= 8) {
        *below = *above;
        if (!(g < FASTEST)) {
            above->g = INFINITY;
            return CPS_OK;
        }
        status = evaluate(term, g, above, err);
        if (status == CPS_OK) status = check_between(below, above, err);
    }
    while (status == CPS_OK && below->slope < s && above->g > SLOWEST) {
        const double g = below->g > 0 ? 0.5 * (below->g + above->g) : above->g / 64;
        if (!(g > below->g && g < above->g)) break;
        Point at;
        status = evaluate(term, g, &at, err);
        if (status == CPS_OK) status = check_between(below, &at, err);
        if (status == CPS_OK) status = check_between(&at, above, err);
        *(at.slope < s ? below : above) = at;
    }
    return status;
}

/* the user's own h*, checked against h */
static CpsStatus given_dual(const CpsiTerm *term, double s, CpsiTermDual *dual, CpsError *err) {
    double value, g;
    Point at;
    if (!term->conjugate(term->user, s, &value, &g) || isnan(value) || !(g >= 0))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the user's conjugate has no value and speed at slope %g", s);
    *dual = (CpsiTermDual){INFINITY, INFINITY, INFINITY};
    if (isinf(value) || isinf(g)) return CPS_OK;
    const CpsStatus status = evaluate(term, g, &at, err);
    if (status != CPS_OK) return status;
    if (!(fabs(s * g - at.h - value) <= SLACK * (s * g + at.h)))
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "the user's conjugate is %g at slope %g with speed %g, where slope x speed - h is %g",
            value, s, g, s * g - at.h);
    *dual = (CpsiTermDual){s * g - at.h, g, g};
    return CPS_OK;
}

CpsStatus cpsi_function_dual(const CpsiTerm *term, double s, CpsiTermDual *dual, CpsError *err) {
    s = fmax(s, 0);
    if (term->conjugate) return given_dual(term, s, dual, err);
    Point below, above, beyond;
    CpsStatus status = evaluate(term, 0, &below, err);
    if (status == CPS_OK) status = find(term, s, &below, &above, err);
    if (status != CPS_OK) return status;
    *dual = (CpsiTermDual){INFINITY, INFINITY, INFINITY};
    if (isinf(above.g)) return CPS_OK;

    /* the smallest speed is the right end, unless h is infinite there; the largest is where the
     * slope leaves s */
    const Point at = isinf(above.h) ? below : above;
    *dual = (CpsiTermDual){fmax(s * at.g - at.h, 0), at.g, at.g};
    const double leave = s + STRAIGHT * s;
    if (at.slope > leave) return CPS_OK;
    below = at;
    status = find(term, nextafter(leave, INFINITY), &below, &beyond, err);
    if (status == CPS_OK) dual->high = isinf(beyond.g) ? INFINITY : below.g;
    return status;
}
