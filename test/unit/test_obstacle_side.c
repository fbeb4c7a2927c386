/* SPDX-License-Identifier: BSD-3-Clause */
/* The distance that a move may go before an element comes too near to an axis or a centre, compared
 * with the move in small steps. */
#include "cable/obstacle_side.h"

#include <stdio.h>

#include "check.h"
#include "splitmix.h"

enum { MOVES = 4000, SAMPLES = 400 };

/* Distance of the piece from a to b from the axis or centre: the least of |a + t (b - a)| without
 * its part along the axis, by golden section, as it has one valley. */
static double at(const CpsObstacle *o, const double *a, const double *b, double t) {
    double from[3], along = 0, size = 0, sum = 0;
    for (int k = 0; k < 3; k++) {
        from[k] = a[k] + t * (b[k] - a[k]) - o->point[k];
        along += from[k] * o->axis[k];
        size += o->axis[k] * o->axis[k];
    }
    for (int k = 0; k < 3; k++) {
        const double across =
            o->kind == CPS_OBSTACLE_CYLINDER ? from[k] - along / size * o->axis[k] : from[k];
        sum += across * across;
    }
    return sqrt(sum);
}

static double piece(const CpsObstacle *o, const double *a, const double *b) {
    const double golden = 0.6180339887498949;
    double low = 0, high = 1;
    for (int i = 0; i < 60; i++) {
        const double left = high - golden * (high - low), right = low + golden * (high - low);
        if (at(o, a, b, left) < at(o, a, b, right))
            high = right;
        else
            low = left;
    }
    return fmin(at(o, a, b, 0.5 * (low + high)), fmin(at(o, a, b, 0), at(o, a, b, 1)));
}

/* the nearest that the element comes in a share of the move, over what it is allowed; and where it
 * is at the end of that */
static double nearest_of(const CpsObstacle *o, const double *from, const double *to, double share,
                         double *last) {
    const double least = 0.5 * fmin(o->radius, piece(o, from, from + 3));
    double nearest = INFINITY;
    for (int i = 0; i <= SAMPLES; i++) {
        double x[6];
        for (int k = 0; k < 6; k++) x[k] = from[k] + share * i / SAMPLES * (to[k] - from[k]);
        *last = piece(o, x, x + 3) / least;
        nearest = fmin(nearest, *last);
    }
    return nearest;
}

static void moves_end_in_time(void **state) {
    (void)state;
    uint64_t seed = 3;
    int shortened = 0, through = 0;
    for (int i = 0; i < MOVES; i++) {
        CpsObstacle def = cps_obstacle_default();
        def.kind = i % 2 ? CPS_OBSTACLE_SPHERE : CPS_OBSTACLE_CYLINDER;
        def.radius = pow(10, splitmix(&seed, -3, 1));
        for (int k = 0; k < 3; k++) {
            def.point[k] = splitmix(&seed, -1, 1);
            def.axis[k] = splitmix(&seed, -1, 1);
        }
        double from[6], to[6];
        const double reach = pow(10, splitmix(&seed, -2, 1)); /* of the move */
        for (int k = 0; k < 6; k++) {
            from[k] = splitmix(&seed, -2, 2);
            to[k] = from[k] + reach * splitmix(&seed, -1, 1);
        }
        const CpsiObstacle obstacle = cpsi_obstacle(&def);
        const CpsiLine line = {.n = 2, .obstacle_count = 1, .obstacle = &obstacle};
        const double share = cpsi_obstacle_side_share(&line, from, to, 1);
        double last;
        CHECK_BETWEEN(share, 0, 1);
        /* never nearer than allowed, but for rounding of coordinates of size 3 against 5e-4 of what
         * is allowed at least */
        CHECK_GREATER(nearest_of(&def, from, to, share, &last), 1 - 1e-9);
        if (share < 1) {
            shortened++;
            CHECK_LESS(last, 1 + 1e-3 + 1e-9); /* and no shorter than needed */
            through += nearest_of(&def, from, to, 1, &last) < 1;
        }
        /* a move that must be shorter for another reason is no longer for this one */
        CHECK_NEAR(cpsi_obstacle_side_share(&line, from, to, 0.5 * share), 0.5 * share, 0);
    }
    printf("%d of %d moves were shortened, %d of them seen to come too near by samples\n",
           shortened, MOVES, through);
    assert_true(shortened > MOVES / 20 && through > shortened / 2);
}

/* A wide element far away comes straight across an axis; one beside it goes past; one through the
 * axis has no side. */
static void by_hand(void **state) {
    (void)state;
    CpsObstacle def = cps_obstacle_default();
    def.kind = CPS_OBSTACLE_CYLINDER;
    def.radius = 0.25;
    def.axis[1] = 0;
    def.axis[2] = 1;
    const CpsiObstacle obstacle = cpsi_obstacle(&def);
    const CpsiLine line = {.n = 2, .obstacle_count = 1, .obstacle = &obstacle};
    const double from[6] = {-5, 4, 0, 5, 4, 1}, across[6] = {-5, -4, 0, 5, -4, 1},
                 aside[6] = {100, 4, 0, 110, 4, 1};
    CHECK_NEAR(cpsi_obstacle_side_share(&line, from, across, 1), (4 - 0.125) / 8, 1e-12);
    CHECK_NEAR(cpsi_obstacle_side_share(&line, from, aside, 1), 1, 0);
    const double near[6] = {-5, 0.1, 0, 5, 0.1, 1}, nearer[6] = {-5, -0.1, 0, 5, -0.1, 1};
    CHECK_NEAR(cpsi_obstacle_side_share(&line, near, nearer, 1), 0.25,
               1e-12); /* half of its own distance */
    const double on[6] = {-5, 0, 0, 5, 0, 1};
    CHECK_NEAR(cpsi_obstacle_side_share(&line, on, across, 1), 1, 0);
    /* what gives may be gone through */
    def.stiffness = 1e9;
    const CpsiObstacle soft = cpsi_obstacle(&def);
    const CpsiLine over = {.n = 2, .obstacle_count = 1, .obstacle = &soft};
    CHECK_NEAR(cpsi_obstacle_side_share(&over, from, across, 1), 1, 0);
    assert_int_equal(cpsi_obstacle_passed(&over, from, across), CPS_NO_OBSTACLE);
    assert_int_equal(cpsi_obstacle_passed(&line, from, across), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(moves_end_in_time),
                                       cmocka_unit_test(by_hand)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
