/* SPDX-License-Identifier: BSD-3-Clause */
/* Cones of velocities that contain lines, friction cones, and intervals with infinite ends. */
#include <math.h>
#include <string.h>

#include "capstan/drive.h"
#include "extreme_case.h"

/* ---- cones that contain lines ---- */

/* The segment from -low e to high e: at t e all w with <w, e> = 0 inside, <w, e> >= 0 at the end
 * high. */
static void try_segment(int n) {
    double e[MOST], ends[2 * MOST], normals[(2 * MOST + 1) * MOST], force[MOST];
    const int low = below(3), high = 1 + below(3),
              where = below(3); /* its low end, inside, its high end */
    double square = 0;
    for (int i = 0; i < n; i++) {
        e[i] = digit(3);
        square += e[i] * e[i];
    }
    if (square == 0) e[0] = square = 1;
    for (int i = 0; i < n; i++) {
        ends[i] = -low * e[i];
        ends[n + i] = high * e[i];
    }
    const double at = where == 0 ? -low : where == 2 ? high : 0.5 * (high - low);
    for (int i = 0; i < n; i++) force[i] = at * e[i];
    int count = 0;
    for (int k = 0; k < n; k++, count += 2) /* unit vectors less their part along e, both ways */
        for (int i = 0; i < n; i++) {
            const double part = (i == k) - e[k] * e[i] / square;
            normals[count * n + i] = part;
            normals[(count + 1) * n + i] = -part;
        }
    for (int k = count - 2; k >= 0; k -= 2) {
        if (dot(n, &normals[k * n], &normals[k * n]) > 1e-12) continue;
        memmove(&normals[k * n], &normals[(k + 2) * n],
                (size_t)((count - k - 2) * n) * sizeof *normals);
        count -= 2;
    }
    if (where != 1) {
        for (int i = 0; i < n; i++) normals[count * n + i] = where ? e[i] : -e[i];
        count++;
    }
    double outside[MOST];
    for (int i = 0; i < n; i++) outside[i] = (where == 0 ? -1 : 1) * e[i] / sqrt(square);
    CpsSet *set = NULL;
    need(cps_set_segment(n, ends, ends + n, &set, &err), "segment");
    compare_cone(set, n, force, count, normals, n - (where == 1), outside);
    cps_set_release(set);
}

/* {M t : |t| <= r} in space, M of rank 2: at M t with |t| < r the line across, at |t| = r also s
 * with M's = t. */
static void try_flat_disc(void) {
    double m[3][2], across[3], size = 0;
    do {
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 2; j++) m[i][j] = digit(3);
        for (int i = 0; i < 3; i++)
            across[i] =
                m[(i + 1) % 3][0] * m[(i + 2) % 3][1] - m[(i + 2) % 3][0] * m[(i + 1) % 3][1];
        size = dot(3, across, across);
    } while (size == 0);
    static const double UNIT[][2] = {{1, 0}, {0.6, 0.8}, {-0.28, 0.96}, {0, -1}, {-0.8, -0.6}};
    const double *t = UNIT[below(5)], r = pow(10, digit(3));
    const bool edge = below(2) == 0;
    /* s = M (M'M)^-1 t */
    double g[3] = {0}, y[2], normals[9], force[3], outside[3];
    for (int i = 0; i < 3; i++) {
        g[0] += m[i][0] * m[i][0];
        g[1] += m[i][0] * m[i][1];
        g[2] += m[i][1] * m[i][1];
    }
    const double det = g[0] * g[2] - g[1] * g[1];
    y[0] = (g[2] * t[0] - g[1] * t[1]) / det;
    y[1] = (g[0] * t[1] - g[1] * t[0]) / det;
    for (int i = 0; i < 3; i++) {
        normals[i] = across[i];
        normals[3 + i] = -across[i];
        normals[6 + i] = m[i][0] * y[0] + m[i][1] * y[1];
        force[i] = r * (edge ? 1 : 0.5) * (m[i][0] * t[0] + m[i][1] * t[1]);
    }
    const double length = sqrt(dot(3, normals + 6, normals + 6));
    for (int i = 0; i < 3; i++) outside[i] = normals[6 + i] / length;
    CpsSet *ball = NULL, *flat = NULL;
    need(cps_set_ball(2, NULL, r, &ball, &err), "ball");
    need(cps_set_image(3, &m[0][0], ball, &flat, &err), "image");
    compare_cone(flat, 3, force, edge ? 3 : 2, normals, edge ? 2 : 1, outside);
    cps_set_release(ball);
    cps_set_release(flat);
}

void try_lines(void) {
    if (below(2))
        try_segment(2 + below(3));
    else
        try_flat_disc();
}

/* ---- cones and infinite ends ---- */

/* {(F, N) : |F| <= f N}, 1 to 3 components, times a size: support 0 or infinite; cone of velocities
 * at 0, inside, on the mantle. */
static void friction_cone(void) {
    const int n = 2 + below(2);
    const double f = 0.25 * below(5), size = pow(10, digit(9)), N = size * (1 + below(3));
    double e[3] = {1, 0, 0}, force[3] = {0}, normals[5 * 3] = {0}, w[3], outside[3] = {0};
    if (n == 3) unit_vector(2, e);
    CpsSet *cone = NULL;
    CpsSetAnswer answer;
    need(cps_set_friction_cone(n, f, &cone, &err), "friction cone");
    /* <F, w> + N wn <= N (f |w| + wn) */
    double length = 0;
    for (int i = 0; i < n - 1; i++) {
        w[i] = digit(3);
        length += w[i] * w[i];
    }
    length = sqrt(length);
    w[n - 1] = -f * length + digit(1);
    need(cps_set_support(cone, w, NULL, &answer, &err), "support");
    same("outcome of the support", answer.outcome,
         f * length + w[n - 1] > 1e-9 ? CPS_SET_OUTCOME_UNBOUNDED : CPS_SET_OUTCOME_ANSWERED);
    const int where = below(3); /* at the tip, inside, on the mantle */
    if (where > 0) force[n - 1] = N;
    for (int i = 0; i < n - 1; i++) force[i] = where == 2 ? f * N * e[i] : 0;
    outside[n - 1] = -1; /* (0, -1) opens the contact's way: -V = (0, 1) is no normal */
    int count = 0;
    if (where == 0) {
        for (int side = -1; side <= 1; side += 2, count++) {
            for (int i = 0; i < n - 1; i++) normals[count * n + i] = side * e[i];
            normals[count * n + n - 1] = -f;
        }
        compare_cone(cone, n, force, count, normals, n, outside);
    } else if (where == 1 && f > 0) {
        compare_cone(cone, n, force, 0, normals, 0, outside);
    } else if (where == 2 && f > 0) {
        for (int i = 0; i < n - 1; i++) normals[i] = e[i];
        normals[n - 1] = -f;
        compare_cone(cone, n, force, 1, normals, 1, outside);
    } else { /* a ray: all that is across */
        for (int side = -1; side <= 1; side += 2, count++)
            for (int i = 0; i < n - 1; i++) normals[count * n + i] = side * e[i];
        compare_cone(cone, n, force, count, normals, n - 1, outside);
    }
    cps_set_release(cone);
}

/* A stop [0, inf) on x beside friction b in x and y, driven with (w, v): w > 0 lifts off, w = 0
 * leaves the reaction open, w < 0 is blocked. With U = x and forces >= 0 of the stop, phi is 0 for
 * x >= 0, else infinite. */
static void one_sided(void) {
    const double b = pow(10, digit(9));
    double w[2];
    for (int i = 0; i < 2; i++) w[i] = digit(2);
    CpsSet *stop = NULL, *friction = NULL;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    need(cps_set_interval(0, INFINITY, &stop, &err), "interval");
    need(cps_set_box(2, (double[]){-b, -2 * b}, (double[]){b, 2 * b}, &friction, &err), "box");
    CpsLaw *laws[2] = {law_of(stop), law_of(friction)};
    need(cps_system_create(2, &system, &err), "system");
    need(cps_system_add_friction(system, "stop", laws[0], 1, (const CpsEntry[]){{0, 0, 1}}, &err),
         "add");
    need(cps_system_add_friction(system, "table", laws[1], 2,
                                 (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}}, &err),
         "add");
    need(cps_system_set_drive(system, 2, 2, (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}}, &err),
         "drive");
    need(cps_system_solve(system, w, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    const int expected = w[0] < 0 ? CPS_MOTION_OUTCOME_BLOCKED : CPS_MOTION_OUTCOME_SOLVED;
    same("outcome", report.outcome, expected);
    if (w[0] >= 0) near("gamma", report.value, b * w[0] + 2 * b * fabs(w[1]), 1e-8 * b);
    if (w[0] >= 0) same("Proposition 1", report.composition, CPS_COMPOSITION_INTERIOR);
    CpsSolutionSet all;
    double low[2], high[2];
    need(cps_motion_resistances(motion, 0, &all, low, high, &err), "resistances");
    if (w[0] == 0) {
        same("resistance is open above", isinf(high[0]) && high[0] > 0, 1);
        near("resistance at least", low[0], -b, 1e-6 * b);
    } else if (w[0] > 0) {
        near("resistance", low[0], -b, 1e-6 * b);
        near("resistance", high[0], -b, 1e-6 * b);
    }
    cps_solution_set_clear(&all);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(laws[0]);
    cps_law_release(laws[1]);
}

void try_cone(void) {
    if (below(2))
        friction_cone();
    else
        one_sided();
}
