/* SPDX-License-Identifier: BSD-3-Clause */
/* Where forces do not determine the positions of a line, it moves no farther than necessary: of all
 * positions compatible with the forces, those of least sum h |x - x_R|^2.
 *
 * First closed forms: lines without load, a rope at rest and a rope dropped on a smooth floor, an
 * end that moves straight back. Then slack lines with both ends moved at random, compared with
 * Dykstra's alternating projections, which find the nearest point of an intersection of convex sets
 * from their projections alone. Exchanged names of the ends, and rotated axes, give the same
 * positions. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"

static double largest_move(const CpsLineView *v) {
    double most = 0;
    for (int i = 0; i < 3 * (v->element_count + 1); i++)
        most = fmax(most, fabs(v->position[i] - v->reference[i]));
    return most;
}

/* An end of no force. */
static void let_go(Case *c, int end) { c->line.end[end] = (CpsEnd){.kind = CPS_END_KIND_FREE}; }

/* A step named so that changes nothing. */
static void hold(Case *c, int steps) {
    c->stage[c->scene.stage_count++] =
        (CpsStage){.cookie = cps_stage_default().cookie, .name = "nothing", .step_count = steps};
}

static CpsPlaces places(const Run *run) {
    return cps_evolution_line_report(run->evolution, 0).places;
}

/* No weight, no force: u = 0 and T = 0, with one end held or none, over a bed or not; elements of
 * any stiffness. */
static void nothing_loads_the_line(void **state) {
    (void)state;
    for (int k = 0; k < 12; k++) {
        Case c;
        case_begin(&c, 1, 20, 0, k % 3 == 0 ? INFINITY : k % 3 == 1 ? 1e3 : 1e12);
        if (k & 1) case_bed(&c, 0.3);
        case_straight(&c, 0, 1);
        if (k & 2) let_go(&c, CPS_END_A);
        hold(&c, 3);
        Run run = case_open(&c);
        for (int s = 0; s < 3; s++) {
            const CpsLineView v = case_step(&run);
            CHECK_NEAR(largest_move(&v), 0, 0);
            for (int e = 0; e < v.element_count; e++) CHECK_NEAR(v.tension[e], 0, 0);
            if (k == 0 && s == 0) CHECK_INT(places(&run), CPS_PLACES_NEAREST);
        }
        case_close(&run);
    }
}

/* On a smooth floor every shape that the elements allow has the same energy: the rope stays as it
 * lies. */
static void rest_on_a_smooth_floor(void **state) {
    (void)state;
    for (int inextensible = 0; inextensible < 2; inextensible++) {
        Case c;
        case_begin(&c, 1, 20, 1, inextensible ? INFINITY : 1e3);
        case_bed(&c, 0);
        case_straight(&c, 0, 1);
        hold(&c, 5);
        Run run = case_open(&c);
        for (int s = 0; s < 5; s++) {
            const CpsLineView v = case_step(&run);
            /* rounding of positions of order one, in a few sums over the nodes */
            CHECK_LESS(largest_move(&v), 1e-14);
            CHECK_INT(places(&run), CPS_PLACES_NEAREST);
        }
        case_close(&run);
    }
}

/* Let fall on a smooth floor, beside a wall or not: straight down, though floor and wall leave all
 * else open. */
static void dropped_beside_a_wall(void **state) {
    (void)state;
    for (int wall = 0; wall < 2; wall++) {
        Case c;
        CpsObstacle both[2];
        case_begin(&c, 1, 20, 1, 1e3);
        case_bed(&c, 0);
        case_straight(&c, 0, 1);
        c.point[2] = c.point[5] = 0.3;
        let_go(&c, CPS_END_A);
        hold(&c, 3);
        both[0] = both[1] = c.bed;
        both[1].name = "wall";
        const double at[3] = {0, -0.1, 0}, normal[3] = {0, 1, 0};
        memcpy(both[1].point, at, sizeof at);
        memcpy(both[1].normal, normal, sizeof normal);
        c.scene.obstacle = both;
        c.scene.obstacle_count = 1 + wall;
        Run run = case_open(&c);
        for (int s = 0; s < 3; s++) {
            const CpsLineView v = case_step(&run);
            for (int j = 0; j <= v.element_count; j++) {
                const double want[3] = {0.05 * j, 0, 0};
                CHECK_VECTOR(&v.position[3 * j], want, 1e-13); /* 1e-16 per operation */
            }
        }
        case_close(&run);
    }
}

/* B goes straight back by d on a smooth floor: sum h u^2 is least where a <= L - d/2 stays and the
 * rest is folded back, x = 2 L - d - a: the nearest of all x with |x'| <= 1 to x_R = a with that
 * end. */
static void end_goes_back(void **state) {
    (void)state;
    for (int inextensible = 0; inextensible < 2; inextensible++) {
        Case c;
        case_begin(&c, 1, 100, 1, inextensible ? INFINITY : 1e3);
        case_bed(&c, 0);
        case_straight(&c, 0, 1);
        c.line.end[CPS_END_B].kind = CPS_END_KIND_HELD;
        c.line.end[CPS_END_B].value[0] = 1;
        case_move(&c, 1, 0.5, 0, 0);
        Run run = case_open(&c);
        const CpsLineView v = case_step(&run);
        double worst = 0;
        for (int j = 0; j <= 100; j++) {
            const double a = 0.01 * j, want[3] = {fmin(a, 1.5 - a), 0, 0};
            for (int k = 0; k < 3; k++) worst = fmax(worst, fabs(v.position[3 * j + k] - want[k]));
        }
        /* the nodes beside the fold rest on it without force: the loop's square root of 1e-16 */
        CHECK_LESS(show("end goes straight back", "places, largest error [m]", 0, worst), 1e-8);
        case_close(&run);
    }
}

/* Pulled taut on a smooth floor, or in the air without weight, and let go: nothing is left but the
 * rounding of the tension before, which is none. So all of it is slack, and it may lie otherwise.
 */
static void let_go_of_what_was_taut(void **state) {
    (void)state;
    for (int k = 0; k < 6; k++) {
        Case c;
        case_begin(&c, 3, 30, k & 1 ? 2 : 0, k < 2 ? 300 : k < 4 ? 1e5 : INFINITY);
        if (k & 1) case_bed(&c, 0);
        case_straight(&c, 0, 3);
        let_go(&c, CPS_END_B);
        case_force(&c, 1, 7.3, 0, 0);
        case_force(&c, 1, 0, 0, 0);
        Run run = case_open(&c);
        const CpsLineView v = case_step(&run);
        CHECK_NEAR(v.tension[0], 7.3, 1e-9);
        CHECK_INT(places(&run), CPS_PLACES_UNIQUE);
        CHECK_LESS(case_step(&run).tension[0], 7.3e-12);
        CHECK_INT(places(&run), CPS_PLACES_NEAREST);
        CHECK_NEAR(cps_evolution_line_report(run.evolution, 0).slack, 3, 1e-12);
        case_close(&run);
    }
}

enum { N = 9, SWEEPS = 200000 };

static double random_between(uint64_t *seed, double from, double to) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return from + (to - from) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* The nearest of a pair of nodes of weights w0, w1 whose distance is at most l. */
static void shorten(double *x0, double *x1, double w0, double w1, double l) {
    double d[3], size = 0;
    for (int a = 0; a < 3; a++) {
        d[a] = x1[a] - x0[a];
        size += d[a] * d[a];
    }
    size = sqrt(size);
    if (size <= l) return;
    for (int a = 0; a < 3; a++) {
        const double over = d[a] * (1 - l / size);
        x0[a] += over * w1 / (w0 + w1);
        x1[a] -= over * w0 / (w0 + w1);
    }
}

/* Dykstra: the nearest to x, by weights h, of the places with elements at most l long, ends as they
 * are, and z >= 0 or z = 0. */
static void dykstra(int n, double *x, const double *l, int flat, int floor) {
    double kept[N][6] = {{0}}, up[N] = {0}, h[N];
    for (int j = 0; j < n; j++) h[j] = 0.5 * ((j > 0 ? l[j] : 0) + (j + 1 < n ? l[j + 1] : 0));
    if (flat)
        for (int j = 1; j + 1 < n; j++)
            x[3 * j + 2] = 0; /* a subspace: once, all else moves in it */
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        double moved = 0;
        for (int i = 1; i < n; i++) {
            double pair[6], *x0 = &x[3 * (i - 1)], *x1 = &x[3 * i];
            for (int a = 0; a < 3; a++) {
                pair[a] = x0[a] + kept[i][a];
                pair[3 + a] = x1[a] + kept[i][3 + a];
            }
            double from[6];
            memcpy(from, pair, sizeof from);
            /* ends are held: of infinite weight */
            shorten(pair, &pair[3], i == 1 ? 1e30 : h[i - 1], i == n - 1 ? 1e30 : h[i], l[i]);
            for (int a = 0; a < 6; a++) {
                kept[i][a] = from[a] - pair[a];
                double *to = a < 3 ? &x0[a] : &x1[a - 3];
                moved = fmax(moved, fabs(*to - pair[a]));
                *to = pair[a];
            }
        }
        if (floor)
            for (int j = 1; j + 1 < n; j++) {
                const double z = x[3 * j + 2] + up[j], to = z > 0 ? z : 0;
                up[j] = z - to;
                moved = fmax(moved, fabs(x[3 * j + 2] - to));
                x[3 * j + 2] = to;
            }
        if (moved < 1e-13) return;
    }
}

/* Slack lines between ends that move at random: without weight in the air or over a floor, with
 * weight on a smooth floor. */
static void nearest_by_projections(void **state) {
    (void)state;
    uint64_t seed = 20260807;
    double worst = 0;
    int compared = 0;
    for (int run = 0; run < 120; run++) {
        Case c;
        const int kind = run % 3, n = 3 + run % (N - 2);
        double l[N] = {0}, length = 0, element[N];
        for (int i = 1; i < n; i++) {
            l[i] = element[i - 1] = random_between(&seed, 0.2, 1);
            length += l[i];
        }
        case_begin(&c, length, n - 1, kind == 2 ? 1 : 0, run & 1 ? INFINITY : 100);
        c.line.element_length = element;
        if (kind > 0) case_bed(&c, 0);
        case_straight(&c, 0, length);
        c.line.end[CPS_END_B].kind = CPS_END_KIND_HELD;
        c.line.end[CPS_END_B].value[0] = length;
        double to[2][3];
        for (int m = 0; m < 2; m++) {
            const double reach = random_between(&seed, 0.1, 0.9) * length,
                         turn = random_between(&seed, -2, 2);
            const double lift = kind == 2 ? 0 : random_between(&seed, 0, 0.5);
            to[m][0] = reach * cos(turn) * cos(lift);
            to[m][1] = reach * sin(turn) * cos(lift);
            to[m][2] = reach * sin(lift);
            case_move(&c, 1, to[m][0], to[m][1], to[m][2]);
        }
        hold(&c, 2);
        Run r = case_open(&c);
        for (int m = 0; m < 2; m++) {
            const CpsLineView v = case_step(&r);
            double x[3 * N];
            memcpy(x, v.reference, (size_t)(3 * n) * sizeof *x);
            memcpy(&x[3 * (n - 1)], to[m], sizeof to[m]);
            dykstra(n, x, l, kind == 2, kind > 0);
            double cost[2] = {0};
            for (int j = 0; j < n; j++)
                for (int a = 0; a < 3; a++) {
                    const double h = 0.5 * (l[j] + (j + 1 < n ? l[j + 1] : 0));
                    worst = fmax(worst, fabs(x[3 * j + a] - v.position[3 * j + a]));
                    cost[0] += h * pow(x[3 * j + a] - v.reference[3 * j + a], 2);
                    cost[1] += h * pow(v.position[3 * j + a] - v.reference[3 * j + a], 2);
                }
            CHECK_INT(places(&r), CPS_PLACES_NEAREST);
            CHECK_RELATIVE(cost[1], cost[0], 1e-5);
            compared++;
        }
        for (int s = 0; s < 2; s++) {
            const CpsLineView v = case_step(&r);
            CHECK_LESS(largest_move(&v), 1e-9 * length);
        }
        case_close(&r);
    }
    /* projections converge by a factor per sweep that may be near 1 */
    CHECK_LESS(show("slack, by projections", "places, largest difference [m]", 0, worst), 1e-4);
    CHECK_GREATER(compared, 200);
}

/* The same scene with its ends named the other way round, mirrored, and turned about the vertical:
 * the same places. */
static void the_other_way_round(void **state) {
    (void)state;
    uint64_t seed = 7;
    double worst = 0;
    for (int run = 0; run < 40; run++) {
        double place[4][3 * 13], to[3], turn = random_between(&seed, 0, 6);
        const double reach = random_between(&seed, 0.2, 0.9),
                     about = random_between(&seed, -1.5, 1.5);
        to[0] = reach * cos(about);
        to[1] = reach * sin(about);
        to[2] = 0;
        for (int variant = 0; variant < 4; variant++) {
            Case c;
            const double cosine = variant == 3 ? cos(turn) : 1, sine = variant == 3 ? sin(turn) : 0,
                         mirror = variant == 2 ? -1 : 1;
            case_begin(&c, 1, 12, 1, run & 1 ? INFINITY : 50);
            case_bed(&c, run % 4 < 2 ? 0 : 0.3);
            case_straight(&c, 0, 0);
            const int far =
                variant == 1 ? 0 : 1; /* the point of the start at which the moving end is */
            c.point[3 * far] = cosine;
            c.point[3 * far + 1] = sine;
            for (int e = 0; e < 2; e++) {
                c.line.end[e].kind = CPS_END_KIND_HELD;
                memcpy(c.line.end[e].value, &c.point[3 * e], sizeof c.line.end[e].value);
            }
            case_move(&c, 1, cosine * to[0] - sine * mirror * to[1],
                      sine * to[0] + cosine * mirror * to[1], 0);
            if (variant == 1) c.change[0].end = CPS_END_A;
            Run r = case_open(&c);
            const CpsLineView v = case_step(&r);
            for (int j = 0; j <= 12; j++) {
                const double *x = &v.position[3 * (variant == 1 ? 12 - j : j)];
                place[variant][3 * j] = cosine * x[0] + sine * x[1];
                place[variant][3 * j + 1] = mirror * (cosine * x[1] - sine * x[0]);
                place[variant][3 * j + 2] = x[2];
            }
            case_close(&r);
            for (int i = 0; i < 3 * 13; i++)
                worst = fmax(worst, fabs(place[variant][i] - place[0][i]));
        }
    }
    /* where a node rests on a limit without force, the loop leaves the square root of its 1e-13 */
    CHECK_LESS(show("the other way round", "places, largest difference [m]", 0, worst), 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(let_go_of_what_was_taut), cmocka_unit_test(nothing_loads_the_line),
        cmocka_unit_test(rest_on_a_smooth_floor),  cmocka_unit_test(dropped_beside_a_wall),
        cmocka_unit_test(end_goes_back),           cmocka_unit_test(nearest_by_projections),
        cmocka_unit_test(the_other_way_round),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
