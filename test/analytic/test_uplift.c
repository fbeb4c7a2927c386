/* SPDX-License-Identifier: BSD-3-Clause */
/* The vertical force and the angle at the ends of a line, and how much of it hangs beside each end.
 *
 * What hangs between an end and the bed is carried by that end: where the line lies on the bed, its
 * force is horizontal, so the uplift is minus the weight of the suspended length, whatever the
 * friction, the mesh and the elongation are. Without friction the tension H is the same along the
 * bed, and an inextensible line that rises from it by h has the length s = sqrt(h^2 + 2 h H/w). */
#include <stdio.h>

#include "rig.h"
#include "splitmix.h"

/* A bed at z = 0; the line lies on it along x from A at the origin, then B is lifted and moved. */
static RigRun lift(Rig *rig, int elements, double length, double weight, double stiffness,
                   double friction, const double to[3]) {
    rig_begin(rig, elements, weight, stiffness);
    rig_length(rig, length);
    rig_obstacle(rig, CPS_OBSTACLE_PLANE, friction);
    rig_point(rig, 0, 0, 0);
    rig_point(rig, length, 0, 0);
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
    rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, length, 0, 0);
    rig_stage(rig, 8);
    rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, to[0], to[1], to[2]);
    RigRun run = rig_open(rig);
    rig_next(&run);
    return run;
}

/* Random lines with end B lifted, so that they rise from the bed once. */
static void weight_of_what_hangs(void **unused) {
    (void)unused;
    uint64_t state = 11;
    for (int i = 0; i < 60; i++) {
        static Rig rig;
        const int elements = 5 + (int)(60 * splitmix(&state, 0, 1));
        const double length = pow(10, 3 * splitmix(&state, 0, 1) - 1),
                     weight = pow(10, 4 * splitmix(&state, 0, 1)),
                     friction = i % 3 == 0 ? 0 : splitmix(&state, 0, 1),
                     height = (0.05 + 0.25 * splitmix(&state, 0, 1)) * length,
                     aside = 0.2 * splitmix(&state, 0, 1) * length,
                     stiffness = weight * length * pow(10, 1 + 4 * splitmix(&state, 0, 1));
        const double to[3] = {0.85 * length, aside, height};
        RigRun run = lift(&rig, elements, length, weight, stiffness, friction, to);
        const CpsEndReport *a = &run.report.end[CPS_END_A], *b = &run.report.end[CPS_END_B];
        /* steps are certified to 1e-8 of the energy, which their forces keep far better */
        CHECK_NEAR(b->uplift, -weight * b->suspended, 1e-9 * weight * length);
        CHECK_NEAR(b->uplift, -b->force[2], 0);
        CHECK_NEAR(a->suspended, 0, 0);
        CHECK_NEAR(b->suspended + run.report.grounded, length, 1e-12 * length);
        CHECK_LESS(b->angle, 0);
        CHECK_NEAR(b->tension * sin(b->angle), b->uplift, 1e-9 * weight * length);
        CHECK_NEAR(b->tension * cos(b->angle), hypot(b->force[0], b->force[1]),
                   1e-9 * weight * length);
        CHECK_NEAR(a->uplift, 0, 1e-9 * weight * length);
        rig_close(&run);
    }
}

/* The length that hangs against the catenary that rises from a smooth bed, by the number of
 * elements. */
static void catenary_from_the_bed(void **unused) {
    (void)unused;
    const double length = 100, height = 20, weight = 30;
    double error[3];
    for (int k = 0; k < 3; k++) {
        static Rig rig;
        const double to[3] = {92, 0, height};
        RigRun run = lift(&rig, 100 << (2 * k), length, weight, 1e11, 0, to);
        const double pull = run.report.end[CPS_END_A].tension,
                     s = sqrt(height * height + 2 * height * pull / weight);
        error[k] = fabs(rig_show("lifted from a smooth bed", "suspended length [m]", s,
                                 run.report.end[CPS_END_B].suspended));
        rig_close(&run);
    }
    CHECK_LESS(error[2], error[0] / 16); /* order one at least; the last node counts in part */
    CHECK_LESS(error[2], 1e-4 * length);
}

/* A line by statics between (0, 0, high) and (8, 0, higher), over a bed at z = bed. */
static RigRun hang(Rig *rig, double high, double higher, double bed) {
    rig_begin(rig, 50, 7, 1e6);
    rig_length(rig, 12);
    rig_obstacle(rig, CPS_OBSTACLE_PLANE, 0.3)->point[2] = bed;
    rig->line.start.kind = CPS_START_STATIC;
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, 0, 0, high);
    rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, 8, 0, higher);
    RigRun run = rig_open(rig);
    rig_step(&run);
    return run;
}

static void both_ends_lifted(void **unused) {
    (void)unused;
    static Rig rig;
    for (int reversed = 0; reversed < 2; reversed++) {
        RigRun run = hang(&rig, reversed ? 2 : 1, reversed ? 1 : 2, 0);
        const CpsEndReport *end = run.report.end;
        CHECK_GREATER(run.report.grounded, 1);
        CHECK_NEAR(end[0].suspended + run.report.grounded + end[1].suspended, 12, 1e-11);
        for (int e = 0; e < 2; e++) {
            CHECK_NEAR(end[e].uplift, -7 * end[e].suspended, 1e-9 * 7 * 12);
            CHECK_BETWEEN(end[e].angle, -1.6, -0.5);
        }
        CHECK_GREATER(end[reversed ? 0 : 1].suspended, end[reversed ? 1 : 0].suspended);
        rig_close(&run);
    }
}

static void clear_of_the_bed(void **unused) {
    (void)unused;
    static Rig rig;
    RigRun run = hang(&rig, 1, 2, -20);
    const CpsEndReport *end = run.report.end;
    for (int e = 0; e < 2; e++) CHECK_NEAR(end[e].suspended, 12, 0);
    CHECK_NEAR(end[0].uplift + end[1].uplift, -7 * 12, 1e-9 * 7 * 12);
    rig_close(&run);
}

/* Without gravity up is z, against a gravity to the side it is the other side; a line without force
 * has no angle. */
static void up_is_against_gravity(void **unused) {
    (void)unused;
    static Rig rig;
    for (int i = 0; i < 4; i++) {
        rig_begin(&rig, 1 + i, 0, 1e6);
        rig_length(&rig, 2);
        const bool sideways = i == 2;
        if (i < 3)
            for (int a = 0; a < 3; a++) rig.scene.gravity[a] = sideways && a == 1 ? 3 : 0;
        rig_point(&rig, 0, 0, 0);
        rig_point(&rig, 0, sideways ? -2 : 0, sideways ? 0 : 2);
        const double pull = i == 3 ? 0 : 5;
        rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 0, sideways ? -pull : 0, sideways ? 0 : pull);
        rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
        rig_stage(&rig, 1);
        RigRun run = rig_open(&rig);
        rig_step(&run);
        for (int e = 0; e < 2; e++) {
            const CpsEndReport *end = &run.report.end[e];
            CHECK_NEAR(end->uplift, e == CPS_END_A ? pull : -pull, 1e-12);
            CHECK_NEAR(end->angle, i == 3 ? 0 : (e == CPS_END_A ? 2 : -2) * atan(1), 1e-7);
            CHECK_NEAR(end->suspended, 2, 0);
        }
        rig_close(&run);
    }
}

/* A hanging line that touches a bed with one node: the rest is off it on both sides. */
static void one_node_touches(void **unused) {
    (void)unused;
    static Rig rig;
    RigRun run = hang(&rig, 1, 1, -20);
    double lowest = 0;
    for (int j = 0; j <= 50; j++) lowest = fmin(lowest, run.view.position[3 * j + 2]);
    rig_close(&run);
    run = hang(&rig, 1, 1, lowest + 1e-4);
    const CpsEndReport *end = run.report.end;
    CHECK_BETWEEN(run.report.grounded, 1e-6, 12.0 / 50);
    CHECK_NEAR(end[0].suspended + run.report.grounded + end[1].suspended, 12, 1e-11);
    CHECK_NEAR(end[0].suspended, end[1].suspended, 1e-6);
    rig_close(&run);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weight_of_what_hangs),  cmocka_unit_test(catenary_from_the_bed),
        cmocka_unit_test(both_ends_lifted),      cmocka_unit_test(clear_of_the_bed),
        cmocka_unit_test(up_is_against_gravity), cmocka_unit_test(one_node_touches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
