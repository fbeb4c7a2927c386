/* SPDX-License-Identifier: BSD-3-Clause */
/* Hulls of points in space, of points in a plane of space, and normal cones of sums of many balls:
 * each allocation of making them and asking them is refused once. A set that could not be prepared
 * answers by another way, with the same numbers; and everything is given back. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../splitmix.h"
#include "capstan/set.h"
#include "refuse.h"

enum { N = 3, POINTS = 40, BALLS = 24 };

static CpsError err;

typedef struct Case {
    int count;
    double point[N * POINTS];
    double direction[N], highest; /* the largest <direction, x> of the points */
} Case;

/* Random points in space, or flattened into the plane x + y + z = 0; some inside the others. */
static Case make_case(uint64_t seed, bool flat) {
    Case c = {.count = POINTS, .direction = {0.3, -0.8, 0.5}, .highest = -INFINITY};
    uint64_t state = seed;
    for (int k = 0; k < POINTS; k++) {
        double *x = &c.point[N * k], mean = 0;
        for (int i = 0; i < N; i++) x[i] = (k % 4 ? 1 : 0.3) * splitmix(&state, -1, 1);
        for (int i = 0; i < N; i++) mean += x[i] / N;
        for (int i = 0; i < N; i++) x[i] -= flat ? mean : 0;
        c.highest =
            fmax(c.highest, x[0] * c.direction[0] + x[1] * c.direction[1] + x[2] * c.direction[2]);
    }
    return c;
}

static CpsStatus ask(const Case *c, bool *right) {
    CpsSet *set = NULL;
    CpsSetAnswer answer;
    double at[N];
    *right = false;
    CpsStatus status = cps_set_hull_of_points(N, c->count, c->point, &set, &err);
    if (status == CPS_OK) status = cps_set_support(set, c->direction, at, &answer, &err);
    if (status == CPS_OK) {
        *right =
            answer.outcome == CPS_SET_OUTCOME_ANSWERED && fabs(answer.value - c->highest) <= 1e-12;
        status = cps_set_contains(set, c->point, NULL, &answer, &err);
    }
    if (status == CPS_OK) /* one of the points: inside, up to the tolerance of the solver */
        *right =
            *right && (answer.outcome == CPS_SET_OUTCOME_ANSWERED ? answer.value >= -1e-7 : false);
    cps_set_release(set);
    return status;
}

static long refuse_each(const Case *c) {
    bool right;
    assert_int_equal(ask(c, &right), CPS_OK);
    assert_true(right);
    for (long k = 0;; k++) {
        const long before = live;
        allowed = k;
        const CpsStatus status = ask(c, &right);
        const bool reached = allowed < 0;
        allowed = -1;
        if (live != before) fail_msg("allocation %ld: %ld blocks lost", k, live - before);
        if (status == CPS_OK ? !right : !(reached && status == CPS_ERR_MEMORY))
            fail_msg("allocation %ld: %s: %s", k, cps_status_name(status),
                     status ? err.message : "another answer");
        if (!reached) return k;
    }
}

static void hulls(void **state) {
    (void)state;
    long all = 0;
    for (uint64_t seed = 1; seed <= 4; seed++)
        for (int flat = 0; flat < 2; flat++) {
            const Case c = make_case(seed, flat);
            all += refuse_each(&c);
        }
    if (all == 0) skip(); /* built as shared libraries it cannot be reached */
    print_message("%ld allocations, each refused once\n", all);
    assert_in_range(all, 40, 100000);
}

/* The sum of balls of radii that make up `radius`, about `centre`; every second one is the image of
 * a ball of R^m under a part of a rotation, and some have no radius. */
static CpsSet *sum_of_balls(int n, double radius, const double *centre) {
    static const double TURN[N * N] = {0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1};
    CpsSet *ball[BALLS] = {NULL}, *sum = NULL;
    for (int k = 0; k < BALLS; k++) {
        CpsSet *own = NULL;
        const double r = k % 6 == 5 ? 0 : radius / (BALLS - BALLS / 6);
        assert_int_equal(cps_set_ball(n, k ? NULL : centre, r, &own, &err), CPS_OK);
        double map[N * N];
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) map[i * n + j] = TURN[i * N + j];
        if (k % 2)
            assert_int_equal(cps_set_image(n, map, own, &ball[k], &err), CPS_OK);
        else
            ball[k] = cps_set_retain(own);
        cps_set_release(own);
    }
    assert_int_equal(cps_set_sum(BALLS, (const CpsSet *const *)ball, &sum, &err), CPS_OK);
    for (int k = 0; k < BALLS; k++) cps_set_release(ball[k]);
    return sum;
}

/* The normal cone at centre + share radius e: the ray e at the boundary, {0} inside, none outside,
 * where the distance is told. */
static void expect_normals(const CpsSet *sum, int n, const double *centre, double radius,
                           double share) {
    static const double E[N] = {0.48, 0.6, 0.64}, FLAT[N] = {0.6, 0.8, 0};
    const double *e = n == N ? E : FLAT;
    double x[N], ray[2 * N];
    CpsSet *cone = NULL;
    CpsSetAnswer answer, listed;
    int count = 0;
    for (int i = 0; i < n; i++) x[i] = centre[i] + share * radius * e[i];
    assert_int_equal(cps_set_normal_cone(sum, x, 0, &cone, &answer, &err), CPS_OK);
    if (share > 1) {
        assert_int_equal(answer.outcome, CPS_SET_OUTCOME_OUTSIDE);
        assert_true(fabs(answer.value - (share - 1) * radius) <= 1e-6 * radius);
        assert_null(cone);
        return;
    }
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    assert_int_equal(cps_set_rays(cone, 0, 2, ray, &count, &listed, &err), CPS_OK);
    assert_int_equal(count, share < 1 ? 0 : 1);
    if (count > 0)
        for (int i = 0; i < n; i++) assert_true(fabs(ray[i] - e[i]) <= 1e-6);
    cps_set_release(cone);
}

static void normals_of_many_balls(void **state) {
    (void)state;
    static const double CENTRE[N] = {1, -2, 0.5}, SHARE[] = {0, 0.3, 0.99, 1, 1.001, 1.5, 10};
    for (int n = 2; n <= N; n++) {
        CpsSet *sum = sum_of_balls(n, 3, CENTRE);
        for (size_t k = 0; k < sizeof SHARE / sizeof *SHARE; k++)
            expect_normals(sum, n, CENTRE, 3, SHARE[k]);
        cps_set_release(sum);
        /* all radii are 0: the set is a point, whose normals are all directions */
        sum = sum_of_balls(n, 0, CENTRE);
        CpsSet *cone = NULL;
        CpsSetAnswer answer;
        CpsSetFacts facts;
        assert_int_equal(cps_set_normal_cone(sum, CENTRE, 0, &cone, &answer, &err), CPS_OK);
        assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
        assert_int_equal(cps_set_facts(cone, 0, &facts, NULL, NULL, &err), CPS_OK);
        assert_int_equal(facts.dimension, n);
        assert_false(facts.bounded);
        cps_set_release(cone);
        cps_set_release(sum);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(hulls),
                                       cmocka_unit_test(normals_of_many_balls)};
    return cmocka_run_group_tests_name("hulls without memory", tests, NULL, NULL);
}
