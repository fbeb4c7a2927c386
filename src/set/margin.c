/* SPDX-License-Identifier: BSD-3-Clause */
/* The margin of a point: how large a ball round it fits in a set, or minus its distance from it.
 *
 *     products, intersections    inside, the least of the parts' margins
 *     C + ball                   margin in C, inside or outside, plus the radius
 *     translates, scales, images by similarities    the part's margin times the factor
 *     preimages by L with L L' = s^2 I              margin of L p + shift over s: a ball is mapped onto one
 *     polar of points v_k                           least (1 - <v_k, p>)/|v_k|
 *
 * Inside any other set of the plane, it is the least distance h(w) - <w, p> over unit w, enclosed by bisection of the
 * turn: what was asked bounds it from above, the chords between the points found from below. In more dimensions the
 * least distance is no convex problem; a ball that fits and a distance that is reached enclose it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linsys/small.h"
#include "set/node.h"

static const double TURN = 6.283185307179586476925;

/* ---- closed forms ---- */

/* The length s of the rows of a map whose rows are normal to each other and of one length, to rounding; else 0. */
static double similar(int rows, int n, const double *map) {
    const double size = cpsi_norm(n, map);
    for (int i = 0; i < rows; i++)
        for (int j = 0; j <= i; j++) {
            const double product = cpsi_dot(n, &map[i*n], &map[j*n])/size/size;
            if (!(fabs(product - (i == j)) <= 2e-15)) return 0;
        }
    return size;
}

/* C + ball: all parts but one are balls and points. */
static bool sum_margin(const CpsSet *set, const double *p, double *separating, double *margin) {
    const CpsSet *other = NULL;
    const int n = set->n;
    double radius = 0;
    for (int k = 0; k < set->count; k++) {
        const CpsSet *part = set->part[k];
        if (part->kind == CPSI_SET_BALL) radius += part->scalar;
        else if (part->kind == CPSI_SET_POINTS && part->count == 1) continue;
        else if (other) return false;
        else other = part;
    }
    CpsiScratch scratch;
    double *q = cpsi_scratch_take(&scratch, (size_t)n), distance = 0;
    if (!q) return false;
    memcpy(q, p, (size_t)n*sizeof *q);
    for (int k = 0; k < set->count; k++)
        for (int i = 0; set->part[k] != other && i < n; i++) q[i] -= set->part[k]->a[i];
    bool done = true;
    if (other) done = cpsi_closed_margin(other, q, separating, &distance);
    else {
        distance = -cpsi_norm(n, q);
        for (int i = 0; separating && i < n; i++) separating[i] = distance < 0 ? -q[i]/distance : 0;
    }
    if (done) *margin = distance + radius;
    if (done && separating && *margin >= 0) memset(separating, 0, (size_t)n*sizeof *separating);
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
    double *q = cpsi_scratch_take(&scratch, 2*(size_t)m), *away = q ? q + m : NULL;
    if (!q) return false;
    for (int i = 0; i < m; i++) {
        q[i] = image ? 0 : cpsi_dot(n, &set->a[i*n], p) + set->b[i];
        for (int j = 0; image && j < n; j++) q[i] += set->a[j*n + i]*p[j]/size/size;
    }
    const bool done = cpsi_closed_margin(part, q, separating ? away : NULL, margin);
    if (done) *margin = image ? *margin*size : *margin/size;
    for (int i = 0; done && separating && i < n; i++) {
        separating[i] = 0;
        for (int j = 0; j < m; j++) separating[i] += (image ? set->a[i*m + j] : set->a[j*n + i])*away[j]/size;
    }
    cpsi_scratch_give(&scratch);
    return done;
}

static bool moved_margin(const CpsSet *set, const double *p, double *separating, double *margin) {
    const int n = set->n;
    const bool shift = set->kind == CPSI_SET_TRANSLATE;
    CpsiScratch scratch;
    double *y = cpsi_scratch_take(&scratch, (size_t)n);
    for (int i = 0; y && i < n; i++) y[i] = shift ? p[i] - set->a[i] : p[i]/set->scalar;
    const bool done = y && cpsi_closed_margin(set->part[0], y, separating, margin);
    if (done && !shift) *margin *= fabs(set->scalar);
    for (int i = 0; done && !shift && separating && i < n; i++) separating[i] *= copysign(1, set->scalar);
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

/* The radius that fits round a point of the set, something negative for others; false where no formula is known. */
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
            const double *a = &set->a[(size_t)k*(size_t)n];
            least = fmin(least, (set->b[k] - cpsi_dot(n, a, p))/cpsi_norm(n, a));
        }
        break;
    case CPSI_SET_POLAR:
        if (set->part[0]->kind != CPSI_SET_POINTS) return false;
        for (int k = 0; k < set->part[0]->count; k++) {
            const double *a = &set->part[0]->a[(size_t)k*(size_t)n], size = cpsi_norm(n, a);
            if (size > 0) least = fmin(least, (1 - cpsi_dot(n, a, p))/size);
        }
        break;
    case CPSI_SET_SUBSPACE: least = set->count < n ? 0 : INFINITY; break;
    case CPSI_SET_PRODUCT:
    case CPSI_SET_INTERSECTION:
        for (int k = 0, at = 0; k < set->count; at += set->kind == CPSI_SET_PRODUCT ? set->part[k]->n : 0, k++) {
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
    const bool inside = inner_radius(set, p, margin) && *margin >= 0 && (set->kind != CPSI_SET_POINTS || (set->hull && set->hull->dimension == n));
    if (inside && (set->kind != CPSI_SET_SUBSPACE || set->count == n)) {
        if (separating) memset(separating, 0, (size_t)n*sizeof *separating);
        return true;
    }
    CpsiScratch scratch;
    double *nearest = cpsi_scratch_take(&scratch, (size_t)n);
    bool done = nearest && cpsi_closed_project(set, p, nearest);
    for (int i = 0; done && i < n; i++) distance = hypot(distance, p[i] - nearest[i]);
    if (done && distance > 0) *margin = -distance;
    else if (done) done = inner_radius(set, p, margin) && (*margin = fmax(*margin, 0), true);
    for (int i = 0; done && separating && i < n; i++) separating[i] = distance > 0 ? (p[i] - nearest[i])/distance : 0;
    cpsi_scratch_give(&scratch);
    return done;
}

/* ---- inside a planar set ---- */

/* A part of the turn; the boundary in it lies beyond the chord from x to y. */
typedef struct Sector {
    double from, to, x[2], y[2]; /* x, y as seen from the point */
    double least;                /* its distance is not less */
} Sector;

static double chord_distance(const double x[2], const double y[2]) {
    const double d[2] = {y[0] - x[0], y[1] - x[1]}, size = hypot(d[0], d[1]);
    if (!(size > 0)) return hypot(x[0], x[1]);
    if (x[0]*d[1] - x[1]*d[0] < 0) return 0; /* the point is between chord and boundary */
    if (x[0]*d[0] + x[1]*d[1] > 0) return hypot(x[0], x[1]);
    if (y[0]*d[0] + y[1]*d[1] < 0) return hypot(y[0], y[1]);
    return (x[0]*d[1] - x[1]*d[0])/size;
}

/* Ask at an angle; false where the support has no answer. */
static bool look(const CpsSet *set, const double *p, double theta, double x[2], double *most, CpsSetAnswer *answer,
                 CpsStatus *status, CpsError *err) {
    const double w[2] = {cos(theta), sin(theta)};
    CpsSetAnswer one;
    *status = cpsi_support(set, w, x, &one, err);
    if (*status || one.outcome != CPS_SET_ANSWERED) return false;
    x[0] -= p[0], x[1] -= p[1];
    *most = fmin(*most, one.value - w[0]*p[0] - w[1]*p[1]);
    answer->gap = fmax(answer->gap, one.gap);
    answer->exact = answer->exact && one.exact;
    return true;
}

/* *found: false where a support has no answer. */
static CpsStatus planar_margin(const CpsSet *set, const double *p, CpsSetAnswer *answer, bool *found, CpsError *err) {
    enum { STARTS = 8, LOOKS = 400 };
    Sector sector[LOOKS];
    double most = INFINITY, least = 0;
    const double first = 0.1234567; /* no special one */
    CpsSetAnswer asked = {.exact = true};
    CpsStatus status = CPS_OK;
    int count = 0, worst = 0;
    *found = true;
    for (; *found && count < STARTS; count++) {
        sector[count] = (Sector){.from = first + count*TURN/STARTS, .to = first + (count + 1)*TURN/STARTS};
        *found = look(set, p, sector[count].from, sector[count].x, &most, &asked, &status, err);
    }
    for (int k = 0; *found && k < STARTS; k++) {
        memcpy(sector[k].y, sector[(k + 1)%STARTS].x, sizeof sector[k].y);
        sector[k].least = chord_distance(sector[k].x, sector[k].y);
    }
    for (; *found; count++) {
        for (int k = worst = 0; k < count; k++) worst = sector[k].least < sector[worst].least ? k : worst;
        least = fmin(sector[worst].least, most);
        Sector *s = &sector[worst];
        /* 1e-15: what rounding leaves of the difference */
        if (most - least <= 1e-13*most + 1e-15*cpsi_set_size(set) || count == LOOKS || s->to - s->from < 1e-14) break;
        /* the chord's own normal, where an edge lies; for arcs it is as good as the middle */
        double at = atan2(s->x[0] - s->y[0], s->y[1] - s->x[1]), z[2];
        at += TURN*ceil((s->from - at)/TURN);
        if (!(at > s->from + 1e-3*(s->to - s->from) && at < s->to - 1e-3*(s->to - s->from)))
            at = 0.5*(s->from + s->to);
        *found = look(set, p, at, z, &most, &asked, &status, err);
        sector[count] = (Sector){at, s->to, {z[0], z[1]}, {s->y[0], s->y[1]}, chord_distance(z, s->y)};
        s->to = at, memcpy(s->y, z, sizeof z), s->least = chord_distance(s->x, z);
    }
    if (!*found || status) return status;
    answer->value = fmax(0, least - asked.gap);
    answer->gap = most - answer->value + asked.gap;
    answer->exact = false;
    return CPS_OK;
}

/* ---- inside others ---- */

/* A ball that is certain to fit: the hull of what is reached along the axes holds one of radius 1/|1/t|; no larger one
 * than the least t does. */
static CpsStatus inscribed(const CpsSet *set, const double *p, CpsSetAnswer *answer, CpsError *err) {
    double sum = 0, most = INFINITY;
    CpsiScratch scratch;
    double *d = cpsi_scratch_take(&scratch, (size_t)set->n);
    if (!d) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a direction");
    memset(d, 0, (size_t)set->n*sizeof *d);
    CpsStatus status = CPS_OK;
    for (int i = 0; !status && answer->outcome == CPS_SET_ANSWERED && i < set->n; i++) {
        double least = INFINITY;
        for (int sign = -1; !status && sign <= 1; sign += 2) {
            CpsSetAnswer reach;
            d[i] = sign;
            status = cpsi_reach(set, p, d, &reach, err);
            if (status) break;
            if (reach.outcome == CPS_SET_INACCURATE) answer->outcome = reach.outcome;
            const bool there = reach.outcome == CPS_SET_ANSWERED;
            least = fmin(least, there ? fmax(reach.value - reach.gap, 0) : 0);
            most = fmin(most, there ? fmax(reach.value + reach.gap, 0) : 0);
        }
        d[i] = 0;
        sum += 1/(least*least);
    }
    answer->value = sum > 0 ? 1/sqrt(sum) : INFINITY;
    answer->gap = isfinite(most) ? most - answer->value : 0;
    cpsi_scratch_give(&scratch);
    return status;
}

CpsStatus cps_set_contains(const CpsSet *set, const double *point, double *separating, CpsSetAnswer *answer,
                           CpsError *err) {
    CpsStatus status = cpsi_set_check("cps_set_contains", set, "point", point, answer, err);
    if (status) return status;
    const int n = set->n;
    *answer = (CpsSetAnswer){.outcome = CPS_SET_ANSWERED, .exact = true, .closure = set->closure};
    if (cpsi_closed_margin(set, point, separating, &answer->value)) return CPS_OK;
    CpsiScratch scratch;
    double *nearest = cpsi_scratch_take(&scratch, (size_t)n);
    if (!nearest) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    status = cps_set_project(set, point, NULL, nearest, answer, err);
    if (!status && answer->outcome == CPS_SET_ANSWERED) {
        const double distance = answer->value;
        /* the direction of a distance lost in rounding says nothing */
        const bool outside = distance > fmax(answer->gap, 1e-10*cpsi_set_size(set));
        for (int i = 0; separating && i < n; i++) separating[i] = outside ? (point[i] - nearest[i])/distance : 0;
        answer->value = outside ? -distance : 0;
        answer->exact = answer->exact && outside;
        bool found = outside;
        if (!outside && n == 2) status = planar_margin(set, point, answer, &found, err);
        if (!status && !found) status = inscribed(set, point, answer, err);
    }
    cpsi_scratch_give(&scratch);
    return status;
}
