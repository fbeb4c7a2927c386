/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets that touch in one point, unbounded sets, polars and gauges. */
#include <math.h>
#include <stdbool.h>

#include "extreme_case.h"

/* ---- touching sets ---- */

void try_touching(void) {
    const int n = 2 + below(2), kind = below(3);
    const double r = pow(10, digit(2)), s = r * (1 + below(4));
    double u[3], c[3], touch[3], w[3], far[3], nearest[3], map[3] = {0};
    CpsSet *part[2] = {NULL, NULL}, *both = NULL;
    unit_vector(n, u);
    for (int i = 0; i < n; i++) {
        c[i] = digit(3) * r;
        touch[i] = c[i] + r * u[i];
        far[i] = c[i] + (r + s) * u[i];
    }
    need(cps_set_ball(n, c, r, &part[0], &err), "ball");
    if (kind == 0)
        need(cps_set_ball(n, far, s, &part[1], &err), "ball");
    else {
        for (int i = 0; i < n; i++) map[i] = -u[i];
        need(cps_set_half_space(n, map, dot(n, map, touch), &part[1], &err), "half-space");
    }
    if (kind < 2)
        need(cps_set_intersection(2, (const CpsSet *const *)part, &both, &err), "intersection");
    else { /* the line touch + x v, v normal to u */
        const double v[3] = {-u[1], u[0], 0}, size = hypot(u[0], u[1]);
        for (int i = 0; i < n; i++) map[i] = size > 0 ? v[i] / size : i == 0;
        need(cps_set_preimage(1, map, touch, part[0], &both, &err), "preimage");
    }
    const int space = kind < 2 ? n : 1;
    /* the root of rounding, of the size that the numbers have */
    const double size = 10 * r + 2 * s, allowed = 1e-6 * size;
    CpsSetAnswer answer;
    CpsSetFacts facts;
    for (int i = 0; i < n; i++) w[i] = digit(3);
    need(cps_set_support(both, w, NULL, &answer, &err), "support");
    same("outcome of the support", answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    near("support", answer.value, kind < 2 ? dot(n, w, touch) : 0,
         allowed * (1 + sqrt(dot(n, w, w))));
    for (int i = 0; i < space; i++) far[i] = (kind < 2 ? touch[i] : 0) + size * (i == 0);
    need(cps_set_project(both, far, NULL, nearest, &answer, &err), "project");
    same("outcome of the projection", answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    near("distance", answer.value, size, allowed);
    need(cps_set_facts(both, 1e-5, &facts, NULL, NULL, &err), "facts");
    same("dimension", facts.dimension, 0);
    for (int k = 0; k < 2; k++) cps_set_release(part[k]);
    cps_set_release(both);
}

/* ---- unbounded sets ---- */

/* A disc of radius r round c and the ray along e from its centre (or the whole line): sum or hull.
 * For both h(w) = <w, c> + r|w| where <w, e> <= 0 (= 0 for a line), else infinite; where <w, e> = 0
 * the face is the ray (line) from the disc's point. */
void try_unbounded(void) {
    double e[2], c[2], w[2], point[2];
    const double r = 1 + below(4);
    const bool line = below(2) == 0, hull = below(2) == 0;
    unit_vector(2, e);
    for (int i = 0; i < 2; i++) c[i] = digit(3);
    CpsSet *disc = NULL, *ray = NULL, *moved = NULL, *set = NULL, *face = NULL;
    need(cps_set_ball(2, c, r, &disc, &err), "disc");
    if (line)
        need(cps_set_subspace(2, 1, e, &ray, &err), "line");
    else
        need(cps_set_cone_of_rays(2, 1, e, &ray, &err), "ray");
    need(cps_set_translate(c, ray, &moved, &err), "translate");
    const CpsSet *const parts[2] = {disc, hull ? moved : ray};
    need(hull ? cps_set_hull(2, parts, &set, &err) : cps_set_sum(2, parts, &set, &err),
         "sum or hull");
    const int side = digit(1); /* along e, against it, across */
    const double turn = below(2) ? 1 : -1;
    for (int i = 0; i < 2; i++)
        w[i] = side * e[i] + turn * (i ? e[0] : -e[1]) * (side && below(2) ? 0.5 : 1);
    CpsSetAnswer answer;
    CpsSetExtent extent;
    need(cps_set_support(set, w, point, &answer, &err), "support");
    const bool infinite = line ? side != 0 : side > 0;
    same("outcome of the support", answer.outcome,
         infinite ? CPS_SET_OUTCOME_UNBOUNDED : CPS_SET_OUTCOME_ANSWERED);
    if (!infinite) near("support", answer.value, dot(2, w, c) + r * sqrt(dot(2, w, w)), CLOSE * 10);
    if (side == 0) {
        const double at = dot(2, e, c);
        need(cps_set_face(set, w, 0, &face, &answer, &err), "face");
        same("outcome of the face", answer.outcome, CPS_SET_OUTCOME_ANSWERED);
        if (face) need(cps_set_extent(face, e, &extent, &err), "extent");
        if (face && !isinf(extent.high)) fail("face ends", extent.high, INFINITY);
        if (face && line && !isinf(extent.low)) fail("face begins", extent.low, -INFINITY);
        if (face && !line) near("face begins", extent.low, at, CLOSE * 10);
        cps_set_release(face);
    }
    CpsSet *const all[] = {disc, ray, moved, set};
    for (int i = 0; i < 4; i++) cps_set_release(all[i]);
}

/* ---- polars, gauges ---- */

/* A ball of radius r round c = rho r u: 0 inside, on the boundary, outside. Gauge of the ball at x:
 * least t >= 0 with |x - t c| <= t r. Its polar is {x : <x, c> + r |x| <= 1}; that of the ball
 * without 0 has the hull of ball and 0 as its polar. */
static void support_of_polar(const CpsSet *polar, int n, double rho, double r, const double *u,
                             const double *w) {
    /* least t with |w - t c| <= t r; of a ball without 0 only within the cone that touches it,
     * which is left out here */
    const double s = dot(n, w, u), size = dot(n, w, w), lead = r * r * (1 - rho * rho),
                 root = rho * r * s;
    if (rho > 1) return;
    const bool none = rho == 1 && s <= 1e-9;
    const double t = rho < 1 ? (sqrt(root * root + lead * size) - root) / lead : size / (2 * root);
    double at[3];
    CpsSetAnswer answer;
    need(cps_set_support(polar, w, at, &answer, &err), "support of the polar");
    same("outcome of the polar's support", answer.outcome,
         none ? CPS_SET_OUTCOME_UNBOUNDED : CPS_SET_OUTCOME_ANSWERED);
    if (none) return;
    near("support of the polar", answer.value, t, 1e-9 * t);
    near("where it is attained", dot(n, at, w), t, 1e-9 * t);
    near("that point on the polar's boundary", rho * r * dot(n, at, u) + r * sqrt(dot(n, at, at)),
         1, 1e-9 * (1 + r * sqrt(dot(n, at, at))));
}

void try_polar(void) {
    static const double RHO[] = {0, 0.5, 1, 1, 2};
    const int n = 2 + below(2);
    const double rho = RHO[below(5)], r = pow(10, digit(6)), scale = pow(10, digit(2));
    double u[3], c[3], x[3], w[3];
    unit_vector(n, u);
    unit_vector(n, w);
    for (int i = 0; i < n; i++) c[i] = rho * r * u[i];
    CpsSet *ball = NULL, *polar = NULL;
    CpsSetFacts facts;
    CpsSetAnswer answer;
    need(cps_set_ball(n, c, r, &ball, &err), "ball");
    need(cps_set_polar(ball, &polar, &err), "polar");
    need(cps_set_facts(polar, 0, &facts, NULL, NULL, &err), "facts");
    same("outcome of the facts", facts.outcome, CPS_SET_OUTCOME_ANSWERED);
    same("dimension", facts.dimension, n);
    same("0 is inside", facts.zero_interior, true);
    same("bounded", facts.bounded, rho < 1);
    /* gauge of the ball, 0 not outside: |x - t c| = t r, with s = <x, u>: t = |x|^2/(2 r s) on the
     * boundary */
    for (int i = 0; i < n; i++) x[i] = scale * r * w[i];
    const double s = dot(n, x, u), square = dot(n, x, x);
    if (rho < 1) {
        const double a = r * r * (1 - rho * rho), b = rho * r * s;
        need(cps_set_gauge(ball, x, &answer, &err), "gauge");
        near("gauge", answer.value, (sqrt(b * b + a * square) - b) / a, 1e-9 * scale);
    } else if (rho == 1) {
        need(cps_set_gauge(ball, x, &answer, &err), "gauge");
        const bool some = s > 1e-9 * scale * r;
        if (some)
            near("gauge on the boundary", answer.value, square / (2 * r * s),
                 1e-9 * square / (2 * r * s));
        else
            same("no gauge", isinf(answer.value) || answer.outcome != CPS_SET_OUTCOME_ANSWERED, 1);
    }
    /* the polar at 1/h along w, h = <w, c> + r |w|: its boundary, where there is one */
    const double h = dot(n, w, c) + r;
    CpsSetAnswer inside;
    for (int i = 0; i < n; i++) x[i] = w[i] * (h > 1e-9 * r ? 0.5 / h : 1 / r);
    need(cps_set_contains(polar, x, NULL, &inside, &err), "contains");
    same("outcome of the margin", inside.outcome, CPS_SET_OUTCOME_ANSWERED);
    if (!(inside.value >= -1e-9 / r)) fail("a point of the polar", inside.value, 0);
    if (h > 1e-9 * r) {
        for (int i = 0; i < n; i++) x[i] = w[i] * 1.5 / h;
        need(cps_set_contains(polar, x, NULL, &inside, &err), "contains");
        if (!(inside.value < 0)) fail("no point of the polar", inside.value, -1);
    }
    support_of_polar(polar, n, rho, r, u, w);
    if (below(3) == 0) { /* across the axis */
        w[0] = -u[1];
        w[1] = u[0];
        for (int i = 2; i < n; i++) w[i] = 0;
        if (dot(n, w, w) > 0) support_of_polar(polar, n, rho, r, u, w);
    }
    cps_set_release(polar);
    cps_set_release(ball);
}
