/* SPDX-License-Identifier: BSD-3-Clause */
/* Winches. What is known beforehand:
 *
 *   - a hanging line of paid length L has the closed form of the catenary of that length, at order
 *     2, whatever the winch has done before and wherever it cuts an element;
 *   - without friction, out and in again is where it was; the mesh is a function of the length;
 *   - the work of the winch is the energy of the line: of a line that hangs straight down from it,
 *     w L^2/2 + w^2 L^3/(6 EA) to rounding, and of a catenary at order 2 of the steps;
 *   - hauled in over a cylinder, Euler and Eytelwein: T = T0 exp(mu angle), and paid out T0 exp(-mu
 *     angle); there and back the winch loses (T_in - T_out) times the length that slides;
 *   - a rope on a rough bed that a winch draws in: its pull is mu w times what slides. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "catenary.h"
#include "check.h"
#include "splitmix.h"

static CpsEvolution *make(const CpsScene *scene) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

/* A line with ends at (0, 0, 0) and (x, 0, z), and winches. */
static CpsEvolution *hung_over(const CpsObstacle *bed, double length, int elements,
                               double stiffness, double x, double z, const double stored[2]) {
    CpsLine line = cps_line_default();
    line.name = "line";
    line.length = length;
    line.element_count = elements;
    line.weight = 10;
    line.stiffness = stiffness;
    line.start.kind = CPS_START_STATIC;
    line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_HELD};
    line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {x, 0, z}};
    for (int end = 0; end < 2; end++)
        if (stored[end] >= 0) line.winch[end] = (CpsWinch){true, stored[end]};
    CpsScene scene = cps_scene_default();
    scene.line_count = 1;
    scene.line = &line;
    scene.obstacle_count = bed ? 1 : 0;
    scene.obstacle = bed;
    line.bearing_width = bed ? 0.1 : 0;
    CpsEvolution *evolution = make(&scene);
    CpsError err;
    if (cps_evolution_step(evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

static CpsEvolution *hung(double length, int elements, double stiffness, double x, double z,
                          const double stored[2]) {
    return hung_over(NULL, length, elements, stiffness, x, z, stored);
}

static CpsStatus try_pay(CpsEvolution *evolution, int end, double length, CpsError *err) {
    const CpsPayOut pay = {.end = end, .length = length};
    CpsStage move = cps_stage_default();
    move.pay_out_count = 1;
    move.pay_out = &pay;
    return cps_evolution_move(evolution, &move, err);
}

static CpsLineReport pay_out(CpsEvolution *evolution, int end, double length) {
    CpsError err;
    if (try_pay(evolution, end, length, &err) != CPS_OK) fail_msg("%s", err.message);
    const CpsLineReport report = cps_evolution_line_report(evolution, 0);
    CHECK_INT((int)report.outcome, CPS_OUTCOME_SOLVED);
    return report;
}

/* The largest difference of the force at B from the closed form over paid lengths that cut elements
 * anywhere, out and in, relative to it. */
static double catenary_error(int elements, int end, double stiffness) {
    static const double BY[] = {1.7, 3.05, -0.4, 2.123456, -6, 0.9, 3, -2.2};
    double stored[2] = {-1, -1}, worst = 0, paid = 20;
    stored[end] = 10;
    CpsEvolution *evolution = hung(30, elements, stiffness, 12, 3, stored);
    for (size_t k = 0; k < sizeof BY / sizeof *BY; k++) {
        const CpsLineReport report = pay_out(evolution, end, BY[k]);
        paid += BY[k];
        CHECK_NEAR(cps_evolution_winch_report(evolution, 0, end).paid, paid, 1e-12);
        Catenary c = {.length = paid, .weight = 10, .stiffness = stiffness, .h = 50, .v = 120};
        assert_true(catenary_solve(&c, 12, 3));
        const double *f = report.end[CPS_END_B].force, size = hypot(c.h, c.v);
        worst = fmax(worst, hypot(f[0] - c.h, f[2] - c.v) / size);
    }
    cps_evolution_destroy(evolution);
    return worst;
}

static void a_hanging_line_of_any_paid_length(void **state) {
    (void)state;
    static const double STIFFNESS[] = {INFINITY, 3e3};
    for (int i = 0; i < 2; i++)
        for (int end = 0; end < 2; end++) {
            const double coarse = catenary_error(30, end, STIFFNESS[i]),
                         fine = catenary_error(120, end, STIFFNESS[i]);
            /* order 2: a quarter of the element length has a sixteenth of the error */
            CHECK_LESS(coarse, 1.5e-3);
            CHECK_LESS(fine, coarse / 12);
        }
}

static void out_and_in_is_where_it_was(void **state) {
    (void)state;
    enum { N = 40, SEEDS = 40 };
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        uint64_t random = seed;
        const double stiffness = seed % 4 == 0 ? INFINITY : pow(10, splitmix(&random, 3, 6)),
                     stored[2] = {seed % 3 == 0 ? -1 : 6, seed % 3 == 1 ? -1 : 8};
        CpsEvolution *evolution = hung(30, N, stiffness, 9, -2, stored);
        double first[3 * (N + 1)], lengths[N], worst = 0, by[4];
        int at[4];
        CpsLineView view = cps_evolution_line_view(evolution, 0);
        memcpy(first, view.position, sizeof first);
        memcpy(lengths, view.element_length, sizeof lengths);
        for (int k = 0; k < 4; k++) {
            const int end = stored[k % 2] >= 0 ? k % 2 : 1 - k % 2;
            at[k] = end;
            by[k] = splitmix(&random, -0.9, 2.1);
            pay_out(evolution, end, by[k]);
        }
        for (int k = 3; k >= 0; k--) pay_out(evolution, at[k], -by[k]);
        view = cps_evolution_line_view(evolution, 0);
        for (int i = 0; i < 3 * (N + 1); i++)
            worst = fmax(worst, fabs(view.position[i] - first[i]));
        /* places are known to about the root of the certified gap */
        if (!(worst <= 1e-8 * 30)) fail_msg("seed %d: back to %.3g m", (int)seed, worst);
        /* lengths are sums of four numbers: their rounding */
        for (int e = 0; e < N; e++) CHECK_NEAR(view.element_length[e], lengths[e], 1e-13);
        cps_evolution_destroy(evolution);
    }
}

/* A weight of line straight below the drum, without its other end held. */
static void the_work_of_a_winch_is_the_energy(void **state) {
    (void)state;
    const double w = 10, stiffness[] = {INFINITY, 500};
    for (int i = 0; i < 2; i++) {
        CpsLine line = cps_line_default();
        line.name = "line";
        line.length = 12;
        line.element_count = 24;
        line.weight = w;
        line.stiffness = stiffness[i];
        line.start.kind = CPS_START_STATIC;
        line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_HELD};
        line.winch[CPS_END_A] = (CpsWinch){true, 7};
        CpsScene scene = cps_scene_default();
        scene.line_count = 1;
        scene.line = &line;
        CpsEvolution *evolution = make(&scene);
        CpsError err;
        if (cps_evolution_step(evolution, &err) != CPS_OK) fail_msg("%s", err.message);
        CpsLedger sum = {0};
        double paid = 5;
        static const double BY[] = {0.25, 0.25, 0.125, 3, -0.4, -1.1, 2.375};
        for (size_t k = 0; k < sizeof BY / sizeof *BY; k++) {
            const CpsLineReport report = pay_out(evolution, CPS_END_A, BY[k]);
            paid += BY[k];
            sum.winches += report.ledger.winches;
            sum.elastic += report.ledger.elastic;
            sum.gravity += report.ledger.gravity;
            /* the pull at the drum is the weight of what hangs there, and its stretch */
            const double pull = w * paid + pow(w * paid, 2) / (2 * stiffness[i]);
            const CpsWinchReport winch = cps_evolution_winch_report(evolution, 0, CPS_END_A);
            /* half of the end element raises less than it weighs: of order 2 of it */
            CHECK_RELATIVE(winch.pull, pull, 1e-3);
            CHECK_NEAR(report.end[CPS_END_A].tension, w * paid, 1e-9);
            /* the mean of two pulls: of the part that grows with the square of the length the rule
             * of the trapezium leaves b^3/12 times its second derivative. In an element of length l
             * the pull of the mesh is off that square by up to w^2 l^2/(4 EA) */
            const double left = -pow(BY[k], 3) / 12 * w * w / stiffness[i];
            CHECK_NEAR(report.ledger.imbalance, left,
                       1e-9 + fabs(BY[k]) * w * w * 0.25 / (4 * stiffness[i]));
        }
        const double from = 5, to = paid,
                     fallen = w * (to * to - from * from) / 2 +
                              w * w * (to * to * to - from * from * from) / (3 * stiffness[i]),
                     stretched = w * w * (to * to * to - from * from * from) / (6 * stiffness[i]);
        CHECK_RELATIVE(-sum.gravity, fallen, i == 0 ? 1e-9 : 1e-4);
        if (i == 1) CHECK_RELATIVE(sum.elastic, stretched, 1e-3);
        /* the imbalances above are in this sum */
        CHECK_RELATIVE(-sum.winches, fallen - stretched, i == 0 ? 1e-9 : 4e-3);
        cps_evolution_destroy(evolution);
    }
}

/* The imbalance over a way out is of third order in each step, so of second in all; where a node
 * comes off the drum the pull turns a little, which a step does not see. */
static void the_ledger_closes_at_order_two(void **state) {
    (void)state;
    double open[2];
    for (int i = 0; i < 2; i++) {
        const double stored[2] = {-1, 10};
        const int steps = i == 0 ? 8 : 32;
        CpsEvolution *evolution = hung(30, 40, 1e4, 12, 3, stored);
        open[i] = 0;
        for (int k = 0; k < steps; k++)
            open[i] += fabs(pay_out(evolution, CPS_END_B, 8.0 / steps).ledger.imbalance);
        cps_evolution_destroy(evolution);
    }
    CHECK_LESS(open[1], open[0] / 8);
}

/* Over a smooth bed that gives, on which most of it lies, from a winch above the bed and one in it:
 * out and in again is where it was. What is stored below the line is in the pull, so that the
 * ledger closes at order 2, but in the bed, where a node that leaves the drum begins to bear at its
 * depth.
 */
static void a_line_on_what_gives(void **state) {
    (void)state;
    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    bed.point[2] = -1;
    bed.stiffness = 4000;
    for (int i = 0; i < 3; i++) {
        const double z = i < 2 ? 2 : -1.02, stored[2] = {-1, 8}, ea = i % 2 ? INFINITY : 1e5;
        double open[2], off = 0;
        for (int fine = 0; fine < 2; fine++) {
            const int steps = fine ? 32 : 8;
            CpsEvolution *evolution = hung_over(&bed, 30, 60, ea, 19.4, z, stored);
            const double first = cps_evolution_line_report(evolution, 0).end[0].tension;
            open[fine] = 0;
            for (int k = 0; k < steps; k++)
                open[fine] += pay_out(evolution, CPS_END_B, -1.4 / steps).ledger.imbalance;
            for (int k = 0; k < steps; k++) (void)pay_out(evolution, CPS_END_B, 1.4 / steps);
            const double now = cps_evolution_line_report(evolution, 0).end[0].tension;
            off = fmax(off, fabs(now / first - 1));
            cps_evolution_destroy(evolution);
        }
        print_message("EA %g, end at %g m: imbalance %.3e, %.3e J; force off by %.2e\n", ea, z,
                      open[0], open[1], off);
        CHECK_LESS(off, 1e-8);
        if (z > 0) CHECK_LESS(fabs(open[1]), fabs(open[0]) / 8);
    }
}

/* A rope over a quarter of a cylinder, T0 at A, hauled in and paid out at B, there and back. */
static void a_line_over_a_bollard(void **state) {
    (void)state;
    const double mu = 0.3, radius = 0.5, t0 = 100, angle = 0.5 * acos(-1);
    enum { N = 240 };
    CpsObstacle post = cps_obstacle_default();
    post.name = "post";
    post.kind = CPS_OBSTACLE_CYLINDER;
    post.radius = radius;
    post.friction = mu;
    /* along z up to the post, a quarter round it as chords, then along x */
    enum { ARC = 21 };
    double point[3 * (ARC + 2)] = {-radius, 0, -5}, length = 0;
    for (int k = 0; k < ARC; k++) {
        const double a = angle * k / (ARC - 1), r = radius / cos(0.5 * angle / (ARC - 1));
        point[3 * (k + 1)] = -r * cos(a);
        point[3 * (k + 1) + 2] = r * sin(a);
    }
    point[3 * (ARC + 1)] = 5;
    point[3 * (ARC + 1) + 2] = point[3 * ARC + 2];
    for (int k = 0; k <= ARC; k++)
        length += hypot(point[3 * k + 3] - point[3 * k], point[3 * k + 5] - point[3 * k + 2]);
    CpsLine line = cps_line_default();
    line.name = "rope";
    line.length = length + 2;
    line.element_count = N;
    line.stiffness = 1e6;
    line.start.kind = CPS_START_POLYLINE;
    line.start.point_count = ARC + 2;
    line.start.point = point;
    line.end[CPS_END_A] = (CpsEnd){CPS_END_KIND_FREE, {0, 0, -t0}};
    line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_AT_START};
    line.winch[CPS_END_B] = (CpsWinch){true, 2};
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = 1;
    scene.obstacle = &post;
    scene.line_count = 1;
    scene.line = &line;
    CpsEvolution *evolution = make(&scene);
    double supplied = 0, lost = 0, in = 0, out = 0;
    for (int k = 0; k < 16; k++) {
        const CpsLineReport report = pay_out(evolution, CPS_END_B, k < 8 ? -0.15 : 0.15);
        const double turn = atan2(report.end[CPS_END_B].force[2], report.end[CPS_END_B].force[0]),
                     wrapped = angle - turn;
        /* what a node holds on chords is e^(mu angle) at order 2 of the elements */
        if (k == 7) in = report.end[CPS_END_B].tension;
        if (k == 15) out = report.end[CPS_END_B].tension;
        if (k >= 4 && k < 8)
            CHECK_RELATIVE(report.end[CPS_END_B].tension, t0 * exp(mu * wrapped), 2e-2);
        if (k >= 12) CHECK_RELATIVE(report.end[CPS_END_B].tension, t0 * exp(-mu * wrapped), 2e-2);
        supplied += report.ledger.winches + report.ledger.ends;
        lost += report.dissipated;
    }
    /* hysteresis: what was put in has been lost, and it is the difference of the pulls times the
     * way; the first slip each way, and the turn of the pull, are its beginning */
    CHECK_RELATIVE(supplied, lost, 2e-2);
    CHECK_RELATIVE(lost, (in - out) * 8 * 0.15, 5e-2);
    cps_evolution_destroy(evolution);
}

/* A rope straight on a rough bed, drawn in at one end: all of it slides. */
static void a_rope_drawn_in_over_a_bed(void **state) {
    (void)state;
    enum { N = 50 };
    const double w = 10, mu = 0.4, length = 10;
    for (int end = 0; end < 2; end++) {
        CpsObstacle bed = cps_obstacle_default();
        bed.name = "bed";
        bed.friction = mu;
        const double point[6] = {0, 0, 0, length, 0, 0};
        CpsLine line = cps_line_default();
        line.name = "rope";
        line.length = length;
        line.element_count = N;
        line.weight = w;
        line.stiffness = 1e5;
        line.start.kind = CPS_START_STRAIGHT;
        line.start.point_count = 2;
        line.start.point = point;
        line.end[end] = (CpsEnd){.kind = CPS_END_KIND_AT_START};
        line.end[1 - end] = (CpsEnd){.kind = CPS_END_KIND_FREE};
        line.winch[end].is_there = true;
        CpsScene scene = cps_scene_default();
        scene.obstacle_count = 1;
        scene.obstacle = &bed;
        scene.line_count = 1;
        scene.line = &line;
        CpsEvolution *evolution = make(&scene);
        double paid = length;
        for (int k = 0; k < 12; k++) {
            paid -= 0.77;
            const CpsLineReport report = pay_out(evolution, end, -0.77);
            CHECK_NEAR(report.end[end].tension, mu * w * paid, 1e-6);
        }
        /* paid out again, what comes off the drum is slack on it, and nothing moves the rest */
        CpsLineView view = cps_evolution_line_view(evolution, 0);
        const int far = end == CPS_END_A ? N : 0;
        const double still = view.position[3 * far];
        const CpsLineReport back = pay_out(evolution, end, 0.5);
        view = cps_evolution_line_view(evolution, 0);
        CHECK_NEAR(view.position[3 * far], still, 1e-9);
        CHECK_LESS(back.end[end].tension, 1e-3);
        cps_evolution_destroy(evolution);
    }
}

/* To the last tenth of an element and back; more is refused, and nothing is changed then. */
static void to_nothing_left(void **state) {
    (void)state;
    const double stored[2] = {-1, 0};
    CpsEvolution *evolution = hung(10, 10, 1e4, 0.05, 0, stored);
    CpsError err;
    CHECK_INT((int)try_pay(evolution, CPS_END_B, 0.001, &err), (int)CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "only 0 m are on its drum"));
    CHECK_INT((int)try_pay(evolution, CPS_END_B, -9.95, &err), (int)CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "at least 0.1 m stay there"));
    CHECK_INT((int)try_pay(evolution, CPS_END_B, NAN, &err), (int)CPS_ERR_ARGUMENT);
    CHECK_INT((int)try_pay(evolution, CPS_END_A, -1, &err), (int)CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "has no winch"));
    CpsLineView view = cps_evolution_line_view(evolution, 0);
    double first[33];
    memcpy(first, view.position, sizeof first);
    for (int k = 0; k < 9; k++) pay_out(evolution, CPS_END_B, -1.1);
    CHECK_NEAR(cps_evolution_winch_report(evolution, 0, CPS_END_B).paid, 0.1, 1e-12);
    pay_out(evolution, CPS_END_B, 9.9);
    view = cps_evolution_line_view(evolution, 0);
    for (int i = 0; i < 33; i++) CHECK_NEAR(view.position[i], first[i], 1e-6);
    /* taken back, it is as it was, bit for bit */
    pay_out(evolution, CPS_END_B, -3);
    if (cps_evolution_take_back(evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    CHECK_NEAR(cps_evolution_winch_report(evolution, 0, CPS_END_B).paid, 10, 1e-12);
    CHECK_INT(cps_evolution_winch_report(evolution, 0, CPS_END_A).is_there, 0);
    CHECK_INT(cps_evolution_winch_report(NULL, 0, CPS_END_B).is_there, 0);
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hanging_line_of_any_paid_length),
        cmocka_unit_test(out_and_in_is_where_it_was),
        cmocka_unit_test(the_work_of_a_winch_is_the_energy),
        cmocka_unit_test(the_ledger_closes_at_order_two),
        cmocka_unit_test(a_line_on_what_gives),
        cmocka_unit_test(a_line_over_a_bollard),
        cmocka_unit_test(a_rope_drawn_in_over_a_bed),
        cmocka_unit_test(to_nothing_left),
    };
    return cmocka_run_group_tests_name("winches", tests, NULL, NULL);
}
