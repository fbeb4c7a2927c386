/* SPDX-License-Identifier: BSD-3-Clause */
/* The margin of a point: the radius of the largest ball round it inside a set, or minus its
 * distance from the set.
 *
 * Closed forms are in closed_margin.c. Inside any other planar set it is the minimum of h(w) - <w,
 * p> over unit w, enclosed by bisection of the angle: values at computed angles bound it from
 * above, the chords between the points found from below. In more dimensions this minimum is not a
 * convex problem; it is enclosed by a ball that fits and a distance that is attained. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "linalg/dense.h"
#include "set/set.h"

static const double TURN = 2 * CPSI_PI;

/* ---- inside a planar set ---- */

/* An interval of angles; the boundary in it lies on or beyond the chord from x to y. */
typedef struct Sector {
    double from, to, x[2], y[2]; /* x, y relative to the point */
    double least;                /* lower bound of the distance in it */
} Sector;

static double chord_distance(const double x[2], const double y[2]) {
    const double d[2] = {y[0] - x[0], y[1] - x[1]}, size = hypot(d[0], d[1]);
    if (!(size > 0)) return hypot(x[0], x[1]);
    if (x[0] * d[1] - x[1] * d[0] < 0) return 0; /* the point is between chord and boundary */
    if (x[0] * d[0] + x[1] * d[1] > 0) return hypot(x[0], x[1]);
    if (y[0] * d[0] + y[1] * d[1] < 0) return hypot(y[0], y[1]);
    return (x[0] * d[1] - x[1] * d[0]) / size;
}

/* Evaluate the support at an angle; false where it has no answer. */
static bool look(const CpsSet *set, const double *p, double theta, double x[2], double *most,
                 CpsSetAnswer *answer, CpsStatus *status, CpsError *err) {
    const double w[2] = {cos(theta), sin(theta)};
    CpsSetAnswer one;
    *status = cpsi_support(set, w, x, &one, err);
    if (*status || one.outcome != CPS_SET_OUTCOME_ANSWERED) return false;
    x[0] -= p[0];
    x[1] -= p[1];
    *most = fmin(*most, one.value - w[0] * p[0] - w[1] * p[1]);
    answer->gap = fmax(answer->gap, one.gap);
    answer->exact &= one.exact;
    return true;
}

/* The margin by bisection. *found is false where a support has no answer. */
static CpsStatus planar_margin(const CpsSet *set, const double *p, CpsSetAnswer *answer,
                               bool *found, CpsError *err) {
    enum { STARTS = 8, LOOKS = 400 };
    Sector sector[LOOKS];
    double most = INFINITY, least = 0;
    const double first = 0.1234567; /* an angle without special meaning */
    CpsSetAnswer asked = {.exact = true};
    CpsStatus status = CPS_OK;
    int count = 0, worst = 0;
    *found = true;
    for (; *found && count < STARTS; count++) {
        sector[count] = (Sector){.from = first + count * TURN / (double)STARTS,
                                 .to = first + (count + 1) * TURN / (double)STARTS};
        *found = look(set, p, sector[count].from, sector[count].x, &most, &asked, &status, err);
    }
    if (*found)
        for (int k = 0; k < STARTS; k++) {
            memcpy(sector[k].y, sector[(k + 1) % STARTS].x, sizeof sector[k].y);
            sector[k].least = chord_distance(sector[k].x, sector[k].y);
        }
    for (; *found; count++) {
        for (int k = worst = 0; k < count; k++)
            worst = sector[k].least < sector[worst].least ? k : worst;
        least = fmin(sector[worst].least, most);
        Sector *s = &sector[worst];
        /* 1e-15: rounding of the difference */
        if (most - least <= 1e-13 * most + 1e-15 * cpsi_set_size(set) || count == LOOKS ||
            s->to - s->from < 1e-14)
            break;
        /* the normal of the chord, which finds edges; for arcs it is as good as the middle */
        double at = atan2(s->x[0] - s->y[0], s->y[1] - s->x[1]), z[2];
        at += TURN * ceil((s->from - at) / TURN);
        if (!(at > s->from + 1e-3 * (s->to - s->from) && at < s->to - 1e-3 * (s->to - s->from)))
            at = 0.5 * (s->from + s->to);
        *found = look(set, p, at, z, &most, &asked, &status, err);
        sector[count] =
            (Sector){at, s->to, {z[0], z[1]}, {s->y[0], s->y[1]}, chord_distance(z, s->y)};
        s->to = at;
        memcpy(s->y, z, sizeof z);
        s->least = chord_distance(s->x, z);
    }
    if (!*found || status) return status;
    answer->value = fmax(0, least - asked.gap);
    answer->gap = most - answer->value + asked.gap;
    answer->exact = false;
    return CPS_OK;
}

/* ---- inside sets of more dimensions ---- */

/* A ball that certainly fits: the hull of the points reached along the axes contains one of radius
 * 1/|1/t|. None larger than the smallest t fits. */
static CpsStatus inscribed(const CpsSet *set, const double *p, CpsSetAnswer *answer,
                           CpsError *err) {
    double sum = 0, most = INFINITY;
    CpsiScratch scratch;
    double *d = cpsi_scratch_take(&scratch, (size_t)set->n);
    if (!d) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a direction");
    memset(d, 0, (size_t)set->n * sizeof *d);
    CpsStatus status = CPS_OK;
    for (int i = 0; !status && answer->outcome == CPS_SET_OUTCOME_ANSWERED && i < set->n; i++) {
        double least = INFINITY;
        for (int sign = -1; !status && sign <= 1; sign += 2) {
            CpsSetAnswer reach;
            d[i] = sign;
            status = cpsi_reach(set, p, d, &reach, err);
            if (status) break;
            if (reach.outcome == CPS_SET_OUTCOME_INACCURATE) answer->outcome = reach.outcome;
            const bool there = reach.outcome == CPS_SET_OUTCOME_ANSWERED;
            least = fmin(least, there ? fmax(reach.value - reach.gap, 0) : 0);
            most = fmin(most, there ? fmax(reach.value + reach.gap, 0) : 0);
        }
        d[i] = 0;
        sum += 1 / (least * least);
    }
    answer->value = sum > 0 ? 1 / sqrt(sum) : INFINITY;
    answer->gap = isfinite(most) ? most - answer->value : 0;
    cpsi_scratch_give(&scratch);
    return status;
}

CpsStatus cps_set_contains(const CpsSet *set, const double *point, double *separating,
                           CpsSetAnswer *answer, CpsError *err) {
    CpsStatus status = cpsi_set_check(set, "point", point, answer, err);
    if (status) return status;
    const int n = set->n;
    *answer =
        (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true, .closure = set->closure};
    if (cpsi_closed_margin(set, point, separating, &answer->value)) return CPS_OK;
    CpsiScratch scratch;
    double *nearest = cpsi_scratch_take(&scratch, (size_t)n);
    if (!nearest) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    status = cps_set_project(set, point, NULL, nearest, answer, err);
    if (!status && answer->outcome == CPS_SET_OUTCOME_ANSWERED) {
        const double distance = answer->value;
        /* when the distance is rounding, its direction is meaningless */
        const bool outside = distance > fmax(answer->gap, 1e-10 * cpsi_set_size(set));
        for (int i = 0; separating && i < n; i++)
            separating[i] = outside ? (point[i] - nearest[i]) / distance : 0;
        answer->value = outside ? -distance : 0;
        answer->exact &= outside;
        bool found = outside;
        if (!outside && n == 2) status = planar_margin(set, point, answer, &found, err);
        if (!status && !found) status = inscribed(set, point, answer, err);
    }
    cpsi_scratch_give(&scratch);
    return status;
}
