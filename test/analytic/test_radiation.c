/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies with memory of radiation. For kernels that are sums of A exp(-a s) cos(b s) the memory is
 * the state of linear equations, which are integrated here by the method of Runge and Kutta. Each
 * figure is printed. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"

enum { ROWS = 1601, SIX = CPS_BODY_DIRECTIONS };
static const double MASS = 100, SPRING = 400, RISE = 0.3;   /* kg, N/m, m/s */
static const double SIZE = 90, DECAY = 0.5, BEATS = 1.5;    /* N/m, 1/s, rad/s of the kernel */
static const double COUPLED = 0.4, WHILE = 8, LONGEST = 32; /* -, s, s */

/* A body that moves along y and z, on a thread that it does not feel. */
typedef struct Rig {
    CpsScene scene;
    CpsLine line;
    CpsPoint point[2];
    double node[9];
    CpsBody body;
    CpsStage stage[3];
    CpsRadiation row[ROWS];
} Rig;

static double kernel_at(double s) { return SIZE * exp(-DECAY * s) * cos(BEATS * s); }

static void begin(Rig *rig, int rows) {
    memset(rig, 0, sizeof *rig);
    rig->scene = cps_scene_default();
    rig->line = cps_line_default();
    rig->line.name = "line";
    rig->line.length = 2.9;
    rig->line.element_count = 2;
    rig->line.stiffness = 1e-6; /* N, of no account */
    rig->line.quasi_static = true;
    rig->line.start = (CpsStart){.kind = CPS_START_NODES, .point = rig->node, .point_count = 3};
    rig->node[0] = 3;
    rig->node[3] = 1.5;
    for (int i = 0; i < 2; i++) {
        rig->point[i] = cps_point_default();
        rig->point[i].name = i ? "eye" : "anchor";
        rig->line.end[i].kind = CPS_END_KIND_POINT;
        rig->line.end_point[i] = i;
    }
    rig->point[0].position[0] = 3;
    rig->point[1].kind = CPS_POINT_KIND_ON_BODY;
    rig->scene.point = rig->point;
    rig->scene.point_count = 2;
    rig->body = cps_body_default();
    rig->body.name = "body";
    rig->body.kind = CPS_BODY_KIND_FREE;
    rig->body.mass = MASS;
    for (int i = 0; i < 3; i++) rig->body.inertia[i] = 10;
    rig->body.hydrostatics[7] = rig->body.hydrostatics[14] = SPRING;
    for (int i = 3; i < SIX; i++) rig->body.fixed[i] = true;
    rig->body.fixed[0] = true;
    for (int k = 0; k < rows; k++) {
        rig->row[k].time = LONGEST * k / (rows - 1);
        const double k0 = kernel_at(rig->row[k].time);
        rig->row[k].kernel[7] = rig->row[k].kernel[14] = k0;
        rig->row[k].kernel[8] = rig->row[k].kernel[13] = COUPLED * k0;
    }
    rig->body.radiation = rig->row;
    rig->body.radiation_count = rows;
    rig->scene.line = &rig->line;
    rig->scene.line_count = 1;
    rig->scene.body = &rig->body;
    rig->scene.body_count = 1;
    rig->scene.stage = rig->stage;
    rig->scene.stage_count = 1;
    for (int i = 0; i < 3; i++) {
        rig->stage[i] = cps_stage_default();
        rig->stage[i].name = "decay";
    }
}

/* Of y + z (which = 0) and y - z: x'' = -(c x + m)/M, m' = -a m - b n + A x', n' = b m - a n. */
static double place_of(double x, double v, double share, double time) {
    enum { STEPS = 20000 };
    double q[4] = {x, v, 0, 0};
    const double h = time / STEPS;
    for (int s = 0; s < STEPS; s++) {
        double rate[4][4];
        for (int part = 0; part < 4; part++) {
            const double by = part == 0 ? 0 : part == 3 ? h : h / 2;
            double p[4];
            for (int i = 0; i < 4; i++) p[i] = q[i] + (part ? by * rate[part - 1][i] : 0);
            rate[part][0] = p[1];
            rate[part][1] = -(SPRING * p[0] + p[2]) / MASS;
            rate[part][2] = -DECAY * p[2] - BEATS * p[3] + share * SIZE * p[1];
            rate[part][3] = BEATS * p[2] - DECAY * p[3];
        }
        for (int i = 0; i < 4; i++)
            q[i] += h / 6 * (rate[0][i] + 2 * rate[1][i] + 2 * rate[2][i] + rate[3][i]);
    }
    return q[0];
}

static CpsEvolution *open(const Rig *rig) {
    CpsEvolution *evolution;
    CpsError err;
    if (cps_evolution_create(&rig->scene, &evolution, &err)) fail_msg("%s", err.message);
    return evolution;
}

/* [J] What the body's ledger does not close by, and its turnover. */
typedef struct Sums {
    double remainder, turnover;
} Sums;

static void step(CpsEvolution *evolution, Sums *sums) {
    CpsError err;
    if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
    const CpsStepReport report = cps_evolution_report(evolution);
    assert_true(cps_outcome_is_certified(report.outcome));
    sums->remainder += fabs(report.ledger.imbalance);
    sums->turnover += cps_evolution_body_motion(evolution, 0).ledger.turnover;
}

/* The place after a decay from a pose or with a velocity. */
static void decay(int rows, int steps, bool thrown, double out[2]) {
    static Rig rig;
    Sums sums = {0, 0};
    begin(&rig, rows);
    rig.stage[0].duration = WHILE;
    rig.stage[0].step_count = steps;
    if (thrown)
        rig.body.velocity[2] = RISE;
    else
        rig.body.force[2] = 30;
    CpsEvolution *evolution = open(&rig);
    for (int i = 0; i < steps; i++) step(evolution, &sums);
    const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
    out[0] = report.position[1];
    out[1] = report.position[2];
    CHECK_LESS(sums.remainder, 1e-10 * sums.turnover);
    cps_evolution_destroy(evolution);
}

static void it_decays_as_the_equations(void **state) {
    (void)state;
    for (int thrown = 0; thrown < 2; thrown++) {
        double error[3], place[2], exact[2];
        const double rest = thrown ? 0 : 30 / SPRING, rise = thrown ? RISE : 0;
        const double sum = place_of(-rest, rise, 1 + COUPLED, WHILE),
                     difference = place_of(-rest, rise, 1 - COUPLED, WHILE);
        exact[0] = 0.5 * (sum - difference);
        exact[1] = rest + 0.5 * (sum + difference);
        for (int k = 0; k < 3; k++) {
            decay(1 + (200 << k), 100 << k, thrown, place);
            error[k] = hypot(place[0] - exact[0], place[1] - exact[1]);
        }
        printf("%s: %.6f m, %.6f m, off by %.2e, %.2e, %.2e m: order %.2f\n",
               thrown ? "thrown" : "pushed", exact[0], exact[1], error[0], error[1], error[2],
               log2(error[1] / error[2]));
        CHECK_NEAR(log2(error[1] / error[2]), 2, 0.15);
    }
}

/* Steps and rows that have nothing to do with each other: the order is 2 in either. */
static void order_in_steps_and_in_rows(void **state) {
    (void)state;
    double exact[2], place[2], error[2][3];
    const double sum = place_of(0, RISE, 1 + COUPLED, WHILE),
                 difference = place_of(0, RISE, 1 - COUPLED, WHILE);
    exact[0] = 0.5 * (sum - difference);
    exact[1] = 0.5 * (sum + difference);
    for (int k = 0; k < 3; k++) {
        decay(ROWS, 37 << k, true, place);
        error[0][k] = hypot(place[0] - exact[0], place[1] - exact[1]);
        decay(1 + (50 << k), 3001, true, place);
        error[1][k] = hypot(place[0] - exact[0], place[1] - exact[1]);
    }
    for (int i = 0; i < 2; i++) {
        printf("%s: off by %.2e, %.2e, %.2e m: order %.2f\n", i ? "rows" : "steps", error[i][0],
               error[i][1], error[i][2], log2(error[i][1] / error[i][2]));
        CHECK_NEAR(log2(error[i][1] / error[i][2]), 2, 0.2);
    }
}

/* A step as long as the whole table and more. */
static void longer_steps_than_the_table(void **state) {
    (void)state;
    static Rig rig;
    Sums sums = {0, 0};
    begin(&rig, 3);
    rig.row[1].time = 0.01;
    rig.row[2].time = 0.02;
    rig.body.velocity[2] = RISE;
    rig.stage[0].duration = WHILE;
    rig.stage[0].step_count = 80;
    CpsEvolution *evolution = open(&rig);
    double before = INFINITY;
    for (int i = 0; i < 80; i++) {
        step(evolution, &sums);
        const double z = cps_evolution_body_report(evolution, 0).position[2],
                     energy =
                         cps_evolution_body_motion(evolution, 0).kinetic + 0.5 * SPRING * z * z;
        CHECK_LESS(energy, before * (1 + 1e-9)); /* a damper of 0.9 N s/m all but stays behind */
        before = energy;
    }
    cps_evolution_destroy(evolution);
}

/* After a quasi-static step, a motion that begins at a multiple of the spacing is that of a fresh
 * history; a state that is loaded goes on with the same bits. */
static void rest_and_states(void **state) {
    (void)state;
    static Rig rig, fresh;
    static unsigned char bytes[1 << 20];
    enum { STEPS = 30 };
    Sums sums = {0, 0};
    CpsError err;
    CpsBodyChange push = {.kind = CPS_BODY_KIND_FREE, .force = {0, 5, 30}};
    begin(&rig, 161);
    rig.scene.stage_count = 3;
    rig.body.velocity[2] = RISE;
    for (int i = 0; i < 3; i++) rig.stage[i].name = i == 1 ? "rest" : i ? "again" : "first";
    rig.stage[0].duration = rig.stage[2].duration = 6;
    rig.stage[0].step_count = rig.stage[2].step_count = STEPS;
    rig.stage[2].body_change = &push;
    rig.stage[2].body_change_count = 1;
    begin(&fresh, 161);
    fresh.scene.stage_count = 2;
    fresh.stage[0] = rig.stage[1];
    fresh.stage[1] = rig.stage[2];
    CpsEvolution *one = open(&rig), *other = open(&fresh), *loaded = open(&rig);
    for (int i = 0; i < STEPS + 1 + STEPS / 2; i++) step(one, &sums);
    const size_t size = cps_evolution_state_size(one);
    assert_true(size < sizeof bytes);
    cps_evolution_save(one, bytes);
    if (cps_evolution_load(loaded, bytes, size, &err)) fail_msg("%s", err.message);
    for (int i = STEPS / 2; i < STEPS; i++) step(one, &sums);
    for (int i = STEPS / 2; i < STEPS; i++) step(loaded, &sums);
    for (int i = 0; i < 1 + STEPS; i++) step(other, &sums);
    const CpsBodyReport a = cps_evolution_body_report(one, 0),
                        b = cps_evolution_body_report(loaded, 0),
                        c = cps_evolution_body_report(other, 0);
    assert_memory_equal(a.position, b.position, sizeof a.position);
    assert_memory_equal(a.load, b.load, sizeof a.load);
    printf("after a rest: %.9f m, of a fresh history %.9f m\n", a.position[2], c.position[2]);
    for (int i = 0; i < 3; i++) CHECK_NEAR(a.position[i], c.position[i], 1e-9);
    cps_evolution_destroy(one);
    cps_evolution_destroy(other);
    cps_evolution_destroy(loaded);
}

static void refuse(Rig *rig, const char *said) {
    CpsEvolution *evolution;
    CpsError err;
    assert_int_not_equal(cps_evolution_create(&rig->scene, &evolution, &err), CPS_OK);
    if (!strstr(err.message, said)) fail_msg("%s", err.message);
}

static void wrong_tables_are_refused(void **state) {
    (void)state;
    static Rig rig;
    begin(&rig, 11);
    rig.body.radiation_count = 1;
    refuse(&rig, "found 1 rows, expected 0, or 2 or more");
    rig.body.radiation_count = -3;
    refuse(&rig, "found -3 rows");
    rig.body.radiation_count = CPS_MAX_RADIATION + 1;
    refuse(&rig, "the limit is 10000");
    begin(&rig, 11);
    rig.row[3].time *= 1.01;
    refuse(&rig, "radiation: row 4 is at 9.696 s");
    begin(&rig, 11);
    rig.row[0].time = 0.1;
    refuse(&rig, "radiation: row 1 is at 0.1 s");
    begin(&rig, 11);
    rig.row[10].time = 0;
    refuse(&rig, "the last row is at 0 s");
    begin(&rig, 11);
    rig.row[7].kernel[3] = NAN;
    refuse(&rig, "radiation: row 8");
    begin(&rig, 11);
    rig.row[0].kernel[8] = rig.row[0].kernel[13] = 2 * SIZE;
    refuse(&rig, "the kernel at 0 s would drive some motion");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_decays_as_the_equations),  cmocka_unit_test(order_in_steps_and_in_rows),
        cmocka_unit_test(longer_steps_than_the_table), cmocka_unit_test(rest_and_states),
        cmocka_unit_test(wrong_tables_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
