/* SPDX-License-Identifier: BSD-3-Clause */
/* Planar motions along paths, with closed forms: towed bodies and vehicles, blocks on springs, the
 * polar planimeter.
 *
 * Tractrix: an axle of free wheels at L behind a hitch that moves along the y axis, or a block
 * dragged by a spring, follows x = L sech(t/L), y = t - L tanh(t/L). Play operator: a cycle of half
 * amplitude A takes 4 fN (A - fN/k). */
#include <stdio.h>
#include <stdlib.h>

#include "capstan/planar.h"
#include "check.h"

static const double PI = 3.14159265358979323846;

static CpsPlanar *body_of(int count, const CpsPatch *patch) {
    CpsPlanar *body = NULL;
    CpsError err = {.message = ""};
    if (cps_planar_create(count, patch, &body, &err) != CPS_OK) fail_msg("%s", err.message);
    return body;
}

/* ---- towing ---- */

/* An arc to the left of radius `radius`, from `start` along the x axis. */
typedef struct Arc {
    double start[2], radius, angle;
} Arc;

/* What a tow along an arc ends with; turning radius and speed ratio are those of the last step. */
typedef struct Towed {
    CpsTow tow;
    double radius, worst_gap, worst_hitch;
    int not_converged; /* steps; the hitch is watched in the others */
} Towed;

static Towed tow_along(const CpsPlanar *body, CpsTow tow, const Arc *arc, int steps) {
    Towed towed = {.tow = tow};
    CpsTowStep step;
    for (int i = 1; i <= steps; i++) {
        const double a = arc->angle * i / steps;
        const double target[2] = {arc->start[0] + arc->radius * sin(a),
                                  arc->start[1] + arc->radius * (1 - cos(a))};
        assert_int_equal(cps_planar_tow(body, &towed.tow, target, &step, NULL), CPS_OK);
        assert_int_equal(step.outcome, CPS_SET_OUTCOME_ANSWERED);
        assert_true(step.pulled);
        assert_true(step.lower <= step.upper);
        towed.not_converged += !step.converged;
        towed.worst_gap = fmax(towed.worst_gap, step.upper - step.lower);

        /* where the hitch is now: at the target, or the rope's length from it */
        const double *pose = towed.tow.pose, *hitch = tow.hitch;
        const double x = pose[0] + cos(pose[2]) * hitch[0] - sin(pose[2]) * hitch[1];
        const double y = pose[1] + sin(pose[2]) * hitch[0] + cos(pose[2]) * hitch[1];
        if (step.converged)
            towed.worst_hitch =
                fmax(towed.worst_hitch, fabs(hypot(x - target[0], y - target[1]) - tow.rope));
    }
    towed.radius = hypot(step.twist[0], step.twist[1]) / fabs(step.twist[2]);
    return towed;
}

static CpsPatch wheel(double x, double y, double heading, double load, double brake) {
    return (CpsPatch){.cookie = cps_patch_default().cookie,
                      .kind = CPS_PATCH_WHEEL,
                      .position = {x, y},
                      .angle = heading,
                      .friction = 0.8,
                      .load = load,
                      .size = 0.3,
                      .brake = brake};
}

/* An axle of free wheels drawn sideways: the tractrix, with no dissipation; error of second
 * order. */
static void axle_follows_tractrix(void **state) {
    (void)state;
    enum { L = 2 };
    const CpsPatch axle[2] = {wheel(0, 0.75, 0, 4000, 0), wheel(0, -0.75, 0, 4000, 0)};
    CpsPlanar *body = body_of(2, axle);
    double error[3];
    for (int k = 0; k < 3; k++) {
        const int steps = 100 << k;
        CpsTow tow = {.cookie = cps_tow_default().cookie, .pose = {L, 0, PI}, .hitch = {L, 0}};
        CpsTowStep step;
        for (int i = 1; i <= steps; i++) {
            assert_int_equal(cps_planar_tow(body, &tow, (double[2]){0, 4.0 * i / steps}, &step,
                                            NULL),
                             CPS_OK);
            assert_int_equal(step.outcome, CPS_SET_OUTCOME_ANSWERED);
            assert_true(step.converged);
        }
        error[k] = hypot(tow.pose[0] - L / cosh(2), tow.pose[1] - (4 - L * tanh(2)));
        CHECK_LESS(
            tow.dissipated,
            1e-9); /* J, where locked wheels would take 6400 N x 4 m: rounding of 1e-14 a step */
    }
    CHECK_BETWEEN(error[0] / error[1], 3.9,
                  4.1); /* order 2, observed with the next order's share */
    CHECK_BETWEEN(error[1] / error[2], 3.9, 4.1);
    CHECK_LESS(error[2],
               0.03 * 0.01 * 0.01); /* h^2 x third derivatives/24, of order 1/L^2; 0.022 found */
    cps_planar_destroy(body);
}

/* An axle on a circle settles on the radius sqrt(R^2 - L^2), exponentially: exp(-angle of 3 x
 * 9.7/2.5) = 1e-5 is left.
 */
static void axle_on_a_circle(void **state) {
    (void)state;
    const CpsPatch axle[2] = {wheel(0, 0.75, 0, 4000, 0), wheel(0, -0.75, 0, 4000, 0)};
    CpsPlanar *body = body_of(2, axle);
    const Arc arc = {.start = {2.5, 0}, .radius = 10, .angle = 3};
    const Towed towed =
        tow_along(body, (CpsTow){.cookie = cps_tow_default().cookie, .hitch = {2.5, 0}}, &arc, 400);
    CHECK_INT(towed.not_converged, 0);
    CHECK_RELATIVE(towed.radius, sqrt(100 - 6.25), 2e-5);
    CHECK_LESS(towed.worst_hitch,
               1e-12); /* converged to 1e-13 of a step of 75 mm; positions of 20 m round at 4e-15 */
    cps_planar_destroy(body);
}

/* A car with brakes on, drawn by its nose round an arc: radius and dissipation hardly move with the
 * number of steps, and what work and dissipation differ by falls with the square of the step. */
static void towed_car(void **state) {
    (void)state;
    const CpsPatch wheels[4] = {wheel(0, 0.75, 0, 4000, 100), wheel(0, -0.75, 0, 4000, 100),
                                wheel(2.5, 0.75, 0.2, 5000, 300),
                                wheel(2.5, -0.75, 0.2, 5000, 300)};
    CpsPlanar *body = body_of(4, wheels);
    const Arc arc = {.start = {3.2, 0}, .radius = 15, .angle = 2};
    Towed towed[4];
    for (int k = 0; k < 4; k++)
        towed[k] = tow_along(body, (CpsTow){.cookie = cps_tow_default().cookie, .hitch = {3.2, 0}},
                             &arc, 200 << k);

    /* 200 against 1600 steps: within 1 % asked; second order gives 1e-4 of that */
    CHECK_RELATIVE(towed[0].radius, towed[3].radius, 1e-5);
    CHECK_RELATIVE(towed[0].tow.dissipated, towed[3].tow.dissipated, 2e-6);
    for (int k = 0; k + 1 < 4; k++) {
        const double defect = towed[k].tow.work - towed[k].tow.dissipated;
        const double next = towed[k + 1].tow.work - towed[k + 1].tow.dissipated;
        CHECK_BETWEEN(defect / next, 3.9, 4.1); /* order 2 */
        CHECK_INT(towed[k].not_converged, 0);
        CHECK_LESS(towed[k].worst_gap, 1e-12 * towed[k].tow.work);
    }
    CHECK_LESS(fabs(towed[3].tow.work - towed[3].tow.dissipated),
               1e-7 * towed[3].tow.work); /* 4.8e-3 of 9e4 J found */

    /* dearer than the shortest way with all brakes slipping, cheaper than with all wheels locked */
    CHECK_BETWEEN(towed[3].tow.dissipated, 2 * (100 + 300) / 0.3 * 20, 0.8 * 18000 * 30);
    cps_planar_destroy(body);
}

/* The same car on a rope: between two ways to roll, one or the other front wheel skidding, some
 * steps do not settle. They are of first order; radius and dissipation still agree within 1 %, and
 * no bound opens. */
static void towed_car_on_a_rope(void **state) {
    (void)state;
    const CpsPatch wheels[4] = {wheel(0, 0.75, 0, 4000, 100), wheel(0, -0.75, 0, 4000, 100),
                                wheel(2.5, 0.75, 0.2, 5000, 300),
                                wheel(2.5, -0.75, 0.2, 5000, 300)};
    CpsPlanar *body = body_of(4, wheels);
    const Arc arc = {.start = {6.2, 0}, .radius = 15, .angle = 2};
    Towed towed[2];
    for (int k = 0; k < 2; k++)
        towed[k] = tow_along(body,
                             (CpsTow){.cookie = cps_tow_default().cookie,
                                      .hitch = {3.2, 0},
                                      .rope = 3,
                                      .end = {6.2, 0}},
                             &arc, 100 << k);
    CHECK_GREATER(towed[0].not_converged, 0);
    CHECK_LESS(towed[0].worst_gap, 1e-12 * towed[0].tow.work);
    CHECK_RELATIVE(towed[0].radius, towed[1].radius, 0.01);
    CHECK_RELATIVE(towed[0].tow.dissipated, towed[1].tow.dissipated, 0.01);
    CHECK_NEAR(towed[1].tow.work, towed[1].tow.dissipated,
               1e-4 * towed[1].tow.work); /* 7e-6 found, order 2 */
    cps_planar_destroy(body);
}

/* A square plate on a rope: second order in pose, work and ledger, whose rope keeps its length. */
static void plate_on_a_rope(void **state) {
    (void)state;
    static const double SQUARE[8] = {-0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, 0.5};
    CpsPlanar *body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                             .kind = CPS_PATCH_POLYGON,
                                             .friction = 0.5,
                                             .load = 2,
                                             .corner_count = 4,
                                             .corner = SQUARE});
    const Arc arc = {.start = {0.9, 0}, .radius = 1, .angle = 2};
    Towed towed[3];
    for (int k = 0; k < 3; k++)
        towed[k] = tow_along(body,
                             (CpsTow){.cookie = cps_tow_default().cookie,
                                      .hitch = {0.5, 0},
                                      .rope = 0.4,
                                      .end = {0.9, 0}},
                             &arc, 100 << k);
    for (int i = 0; i < 3; i++) {
        const double first = towed[1].tow.pose[i] - towed[0].tow.pose[i],
                     then = towed[2].tow.pose[i] - towed[1].tow.pose[i];
        CHECK_BETWEEN(first / then, 3.8, 4.2); /* order 2 */
    }
    CHECK_BETWEEN((towed[0].tow.work - towed[0].tow.dissipated) /
                      (towed[1].tow.work - towed[1].tow.dissipated),
                  3.9, 4.1);
    CHECK_INT(towed[2].not_converged, 0);
    CHECK_LESS(towed[2].worst_hitch, 1e-12);
    CHECK_LESS(towed[2].worst_gap,
               1e-14); /* of a power of 4e-3 J a step: 64 ulp of it and its scale */

    /* the plate follows nose first in the end: the torque about the hitch is 0, so friction points
     * along the rope */
    CHECK_BETWEEN(towed[2].tow.dissipated, 1.5, 2); /* 1 N over some 1.7 m */
    cps_planar_destroy(body);
}

/* ---- a block on a spring ---- */

static void spring_draws_tractrix(void **state) {
    (void)state;
    static const double KNOWN[3] = {3.52e-4, 1.76e-4, 8.80e-5};
    CpsLaw *law = NULL;
    assert_int_equal(cps_law_coulomb(0.5, 2, &law, NULL), CPS_OK);
    for (int k = 0; k < 3; k++) {
        const int steps = 1000 << k;
        CpsSweep sweep = {.cookie = cps_sweep_default().cookie, .stiffness = 1, .position = {1, 0}};
        CpsSweepStep step;
        for (int i = 1; i <= steps; i++) {
            assert_int_equal(cps_sweep_step(law, &sweep, (double[2]){0, 2.0 * i / steps}, &step,
                                            NULL),
                             CPS_OK);
            assert_int_equal(step.outcome, CPS_SET_OUTCOME_ANSWERED);
        }
        const double exact[2] = {1 / cosh(2), 2 - tanh(2)};
        CHECK_NEAR(hypot(sweep.position[0] - exact[0], sweep.position[1] - exact[1]), KNOWN[k],
                   5e-7); /* as printed */

        /* the spring stays at its full length, so what is put in is dissipated; the ledger closes
         * to second order */
        CHECK_NEAR(step.stored, 0.5, 1e-14);
        CHECK_NEAR(sweep.work, sweep.dissipated, 0.5 / ((double)steps * steps));
    }
    cps_law_release(law);
}

/* Any planar law: each step obeys the law (its dissipation is phi of what slid), and the ledger
 * closes. */
static void spring_on_a_ski(void **state) {
    (void)state;
    const double low[2] = {-0.3, -1}, high[2] = {0.1, 1};
    CpsSet *box = NULL;
    CpsLaw *law = NULL;
    assert_int_equal(cps_set_box(2, low, high, &box, NULL), CPS_OK);
    assert_int_equal(cps_law_friction(box, &law, NULL), CPS_OK);
    double defect[2];
    for (int k = 0; k < 2; k++) {
        const int steps = 250 << k;
        CpsSweep sweep = {.cookie = cps_sweep_default().cookie, .stiffness = 4};
        CpsSweepStep step;
        for (int i = 1; i <= steps; i++) {
            const double a = 2 * PI * i / steps;
            assert_int_equal(cps_sweep_step(law, &sweep, (double[2]){sin(a), 1 - cos(a)}, &step,
                                            NULL),
                             CPS_OK);
            CpsSetAnswer phi;
            assert_int_equal(cps_set_dissipation(box, step.slid, NULL, &phi, NULL), CPS_OK);
            CHECK_NEAR(step.dissipated, phi.value,
                       1e-14); /* of powers of 0.03 J a step, in a few operations */
            for (int c = 0; c < 2; c++) CHECK_BETWEEN(step.force[c], low[c], high[c]);
        }
        defect[k] = sweep.work - sweep.dissipated - step.stored;
        CHECK_NEAR(defect[k], 0,
                   4.0 / steps / steps * 2 * PI * 2 *
                       PI); /* a step's defect is k dX^2/2 at most, where it turns */
    }
    CHECK_LESS(fabs(defect[1]), 0.6 * fabs(defect[0])); /* first order at least */
    cps_law_release(law);
    cps_set_release(box);
}

/* Play operator: k = 2, fN = 1, A = 2. After the first cycle 4 fN (A - fN/k) = 6 J are lost in
 * each, whatever the steps. */
static void play_loop(void **state) {
    (void)state;
    CpsSet *interval = NULL;
    CpsLaw *law = NULL;
    assert_int_equal(cps_set_interval(-1, 1, &interval, NULL), CPS_OK);
    assert_int_equal(cps_law_friction(interval, &law, NULL), CPS_OK);
    for (int quarter = 40; quarter <= 97; quarter += 57) {
        CpsSweep sweep = {.cookie = cps_sweep_default().cookie, .stiffness = 2};
        CpsSweepStep step;
        double work = 0, dissipated = 0;
        for (int i = 1; i <= 12 * quarter; i++) {
            if (i == 8 * quarter + 1) {
                work = sweep.work;
                dissipated = sweep.dissipated;
            }
            const double phase = fmod((double)i / quarter, 4), end = phase < 1   ? 2 * phase
                                                                     : phase < 3 ? 4 - 2 * phase
                                                                                 : 2 * phase - 8;
            assert_int_equal(cps_sweep_step(law, &sweep, &end, &step, NULL), CPS_OK);
        }
        CHECK_NEAR(sweep.dissipated - dissipated, 6, 1e-10);
        /* the driver's trapezium is exact where the slip begins at the end of a step: 1 m from the
         * turn, 20 of 40 steps
         */
        if (quarter == 40) CHECK_NEAR(sweep.work - work, 6, 1e-10);
        CHECK_NEAR(sweep.work - work, 6,
                   2 * 2 * (2.0 / 97) * (2.0 / 97)); /* else two corners of k dX^2 at most */
    }
    cps_law_release(law);
    cps_set_release(interval);
}

/* ---- planimeter ---- */

static CpsPlanimeterReading trace_circle(double x, double y, double radius, int count) {
    const CpsPlanimeter planimeter = {.cookie = cps_planimeter_default().cookie,
                                      .pole_arm = 1,
                                      .tracer_arm = 1.3,
                                      .wheel = 0.4,
                                      .friction = 0.3,
                                      .load = 2};
    double *point = malloc(2 * (size_t)count * sizeof *point);
    assert_non_null(point);
    for (int i = 0; i < count; i++) {
        const double a = 2 * PI * i / count;
        point[2 * i] = x + radius * cos(a);
        point[2 * i + 1] = y + radius * sin(a);
    }
    CpsPlanimeterReading reading;
    assert_int_equal(cps_planimeter_trace(&planimeter, count, point, 1, &reading, NULL), CPS_OK);
    free(point);
    return reading;
}

static void planimeter_pole_outside(void **state) {
    (void)state;
    double error[3];
    for (int k = 0; k < 3; k++) {
        const CpsPlanimeterReading reading = trace_circle(1.2, 0.3, 0.5, 1000 << k);
        CHECK_NEAR(reading.area, 1.3 * reading.roll, 1e-15);
        CHECK_INT((int)reading.pole_turns, 0);
        CHECK_INT((int)reading.arm_turns, 0);
        CHECK_NEAR(reading.dissipated, 0.6 * reading.side_slip, 1e-13);
        error[k] = reading.area - PI / 4;
    }
    CHECK_BETWEEN(error[0] / error[1], 3.95, 4.05); /* order 2 */
    CHECK_BETWEEN(error[1] / error[2], 3.95, 4.05);
    CHECK_LESS(fabs(error[2]), 6.0 / (4000.0 * 4000.0));
    /* 5.5/count^2, as above; of that 0.65 of the area is what the polygon lacks of the circle: 2
     * pi^2/(3 count^2) */
    CHECK_NEAR(trace_circle(1.2, 0.3, 0.5, 200000).area, PI / 4, 2e-10);
}

static void planimeter_pole_inside(void **state) {
    (void)state;
    double error[3];
    for (int k = 0; k < 3; k++) {
        const CpsPlanimeterReading reading = trace_circle(0.1, 0, 1.2, 1000 << k);
        CHECK_INT((int)reading.pole_turns, 1);
        CHECK_INT((int)reading.arm_turns, 1);
        CHECK_NEAR(reading.area - 1.3 * reading.roll, PI * 1.65,
                   1e-13); /* the zero circle, radius^2 1.65 */
        error[k] = reading.area - PI * 1.44;
    }
    CHECK_BETWEEN(error[0] / error[1], 3.95, 4.05); /* order 2 */
    CHECK_BETWEEN(error[1] / error[2], 3.95, 4.05);
    CHECK_NEAR(trace_circle(0.1, 0, 1.2, 200000).area, 4.52389342117, 1e-10);
}

/* Where the wheel is, by intersecting two circles: the hinge at `along` on the line to the tracer
 * and `across` to its left or right. */
static void place_wheel(const CpsPlanimeter *planimeter, const double *tracer, double wheel[2],
                        double axis[2]) {
    const double a = planimeter->pole_arm, l = planimeter->tracer_arm,
                 d = hypot(tracer[0], tracer[1]);
    const double along = (d * d + a * a - l * l) / (2 * d),
                 across = sqrt(a * a - along * along) * (planimeter->left_elbow ? 1 : -1);
    const double hinge[2] = {(along * tracer[0] - across * tracer[1]) / d,
                             (along * tracer[1] + across * tracer[0]) / d};
    for (int i = 0; i < 2; i++) {
        axis[i] = (tracer[i] - hinge[i]) / l;
        wheel[i] = hinge[i] + planimeter->wheel * axis[i];
    }
}

/* A polygon has its exact area: sides in more and more steps, both ways round, both elbows. */
static void planimeter_on_a_polygon(void **state) {
    (void)state;
    static const double POINT[10] = {0.6, 0.1, 1.6, 0.2, 1.7, 0.9, 1.1, 1.3, 0.8, 0.7};
    CpsPlanimeter planimeter = {.cookie = cps_planimeter_default().cookie,
                                .pole_arm = 1,
                                .tracer_arm = 1.3,
                                .wheel = -0.2,
                                .friction = 0.3,
                                .load = 2};
    double backwards[10], error[2];
    for (int i = 0; i < 5; i++) {
        backwards[2 * i] = POINT[8 - 2 * i];
        backwards[2 * i + 1] = POINT[9 - 2 * i];
    }
    for (int elbow = 0; elbow < 2; elbow++) {
        planimeter.left_elbow = elbow;
        CpsPlanimeterReading reading, back;
        for (int k = 0; k < 2; k++) {
            assert_int_equal(cps_planimeter_trace(&planimeter, 5, POINT, 256 << k, &reading, NULL),
                             CPS_OK);
            CHECK_NEAR(reading.exact, 0.835, 1e-14); /* by hand, from the corners */
            error[k] = reading.area - reading.exact;
        }
        CHECK_BETWEEN(error[0] / error[1], 3.9, 4.1); /* order 2 */
        CHECK_LESS(fabs(error[1]),
                   0.1 * 0.002 * 0.002); /* sides of 1 m in steps of 2 mm; 0.03 and 0.05 found */
        assert_int_equal(cps_planimeter_trace(&planimeter, 5, backwards, 512, &back, NULL), CPS_OK);
        CHECK_NEAR(back.area, -reading.area, 1e-13); /* the same steps, rolled back */

        /* one step for each side: slip and roll by hand, at the mean heading as the bisector of the
         * axes */
        double wheel[6][2], axis[6][2], slip = 0, roll = 0;
        for (int i = 0; i <= 5; i++)
            place_wheel(&planimeter, POINT + 2 * (i % 5), wheel[i], axis[i]);
        for (int i = 0; i < 5; i++) {
            const double mean[2] = {axis[i][0] + axis[i + 1][0], axis[i][1] + axis[i + 1][1]},
                         size = hypot(mean[0], mean[1]);
            const double moved[2] = {wheel[i + 1][0] - wheel[i][0], wheel[i + 1][1] - wheel[i][1]};
            slip += fabs(moved[0] * mean[0] + moved[1] * mean[1]) / size;
            roll += (moved[1] * mean[0] - moved[0] * mean[1]) / size;
        }
        assert_int_equal(cps_planimeter_trace(&planimeter, 5, POINT, 1, &reading, NULL), CPS_OK);
        CHECK_NEAR(reading.side_slip, slip, 1e-13); /* angles and roots of order 1 */
        CHECK_NEAR(reading.roll, roll, 1e-13);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axle_follows_tractrix),
        cmocka_unit_test(axle_on_a_circle),
        cmocka_unit_test(towed_car),
        cmocka_unit_test(towed_car_on_a_rope),
        cmocka_unit_test(plate_on_a_rope),
        cmocka_unit_test(spring_draws_tractrix),
        cmocka_unit_test(spring_on_a_ski),
        cmocka_unit_test(play_loop),
        cmocka_unit_test(planimeter_pole_outside),
        cmocka_unit_test(planimeter_pole_inside),
        cmocka_unit_test(planimeter_on_a_polygon),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
