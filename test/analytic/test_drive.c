/* SPDX-License-Identifier: BSD-3-Clause */
/* Driven systems with closed forms: the braked wheel in all its cases (M77 sections 9-11), the
 * bipod, loads at and past their limit, a driver that slips, dashpots, and the heavy rope on a
 * table (M77 section 11, remark). */
#include <stdio.h>
#include <stdlib.h>

#include "capstan/drive.h"
#include "check.h"

/* gamma: the bounds are 1e-12 of the power scale apart or less in all these cases; with a factor
 * 100. */
static const double VALUE = 1e-10;
/* V and F after the last Newton step: rounding, times the number of laws and a factor 1e4 for the
 * worst conditioned of them. */
static const double ROOT = 1e-10;

static const double PI = 3.14159265358979323846;

static CpsError err;

static void ok(CpsStatus status) {
    if (status != CPS_OK) print_error("%s\n", err.message);
    assert_int_equal(status, CPS_OK);
}

static CpsLaw *disc(double radius) {
    CpsLaw *law = NULL;
    ok(cps_law_coulomb(1, radius, &law, &err));
    return law;
}

static CpsLaw *interval(double low, double high) {
    CpsSet *set = NULL;
    CpsLaw *law = NULL;
    ok(cps_set_interval(low, high, &set, &err));
    ok(cps_law_friction(set, &law, &err));
    cps_set_release(set);
    return law;
}

/* the law is used up */
static void add(CpsSystem *system, const char *name, CpsLaw *law, int count, const CpsEntry *map) {
    ok(cps_system_add_friction(system, name, law, count, map, &err));
    cps_law_release(law);
}

static CpsMotion *solve(const CpsSystem *system, const double *w) {
    CpsMotion *motion = NULL;
    ok(cps_system_solve(system, w, NULL, &motion, &err));
    return motion;
}

/* bounds are honest, near, and made of admissible V and F */
static void certified(const CpsMotion *motion) {
    const CpsMotionReport r = cps_motion_report(motion);
    CHECK_INT(r.outcome, CPS_MOTION_OUTCOME_SOLVED);
    CHECK_BETWEEN(r.minimum, -1e-13 * r.scale, 1e-8 * r.scale);
    CHECK_BETWEEN(r.drive, 0, 1e-12);
    CHECK_BETWEEN(r.constraint, 0, 1e-9);
    CHECK_BETWEEN(r.equilibrium, 0, 1e-9);
    CHECK_BETWEEN(r.outside, 0, 1e-12);
}

/* ---- the braked wheel: V = (omega, V_i, V_j), W = V - omega a j ---- */

static const double A = 0.3, RADIUS = 500;

static CpsSystem *wheel(double brake) {
    CpsSystem *system = NULL;
    ok(cps_system_create(3, &system, &err));
    add(system, "brake", interval(-brake, brake), 1, (const CpsEntry[]){{0, 0, 1}});
    add(system, "ground", disc(RADIUS), 2, (const CpsEntry[]){{0, 1, 1}, {1, 2, 1}});
    ok(cps_system_set_drive(system, 2, 3, (const CpsEntry[]){{0, 1, 1}, {1, 2, 1}, {1, 0, -A}},
                            &err));
    return system;
}

/* omega and V by minimum dissipation: beta = b/(a f N) < 1, s = sign(Wj) min(|Wj|, |Wi| beta/sqrt(1
 * - beta^2)), V = (Wi, s), omega = (s - Wj)/a; gamma = f N |V| + b |omega| */
static void wheel_closed_form(double brake, const double *w, double *v, double *gamma) {
    const double beta = brake / (A * RADIUS);
    double s = fabs(w[1]);
    if (beta < 1) s = fmin(s, fabs(w[0]) * beta / sqrt(1 - beta * beta));
    if (w[1] < 0) s = -s;
    v[0] = (s - w[1]) / A;
    v[1] = w[0];
    v[2] = s;
    *gamma = RADIUS * hypot(v[1], v[2]) + brake * fabs(v[0]);
}

static void wheel_all_cases(void **state) {
    (void)state;
    static const double BRAKE[] = {0, 10, 60, 149, 200, 1000}; /* a f N = 150 */
    for (int b = 0; b < 6; b++) {
        CpsSystem *system = wheel(BRAKE[b]);
        for (int i = 1; i < 24; i++) {
            const double angle = 2 * PI * (i + 0.1) / 24, w[] = {cos(angle), sin(angle)};
            double v[3], gamma;
            CpsMotion *motion = solve(system, w);
            wheel_closed_form(BRAKE[b], w, v, &gamma);
            certified(motion);
            CHECK_NEAR(cps_motion_report(motion).value, gamma, VALUE * RADIUS);
            CHECK_INT(cps_motion_report(motion).composition,
                      b ? CPS_COMPOSITION_INTERIOR : CPS_COMPOSITION_RELATIVE_INTERIOR);
            for (int k = 0; k < 3; k++) CHECK_NEAR(cps_motion_velocity(motion)[k], v[k], ROOT / A);
            /* h = - a j.F, G = F: M77 (19), (20) */
            const double *h = cps_motion_law_force(motion, 0), *f = cps_motion_law_force(motion, 1);
            CHECK_NEAR(h[0], -A * f[1], 1e-9 * RADIUS);
            for (int k = 0; k < 2; k++)
                CHECK_NEAR(cps_motion_resistance(motion)[k], f[k], 1e-9 * RADIUS);
            cps_motion_destroy(motion);
        }
        cps_system_destroy(system);
    }
}

/* Along a path: W turns once round in 64 intervals of 0.1 s, then 10 s straight ahead. Each
 * interval is the closed form, the ledger closes, and the spin adds up to what the closed form's
 * does. */
static void wheel_along_a_path(void **state) {
    (void)state;
    enum { TURN = 64, COUNT = TURN + 1 };
    CpsSystem *system = wheel(60);
    double duration[COUNT], driving[COUNT][2], travel[COUNT][3], work = 0, spin = 0;
    CpsPathStep step[COUNT];
    for (int i = 0; i < TURN; i++) {
        duration[i] = 0.1;
        driving[i][0] = cos(2 * PI * (i + 0.5) / TURN);
        driving[i][1] = sin(2 * PI * (i + 0.5) / TURN);
    }
    duration[TURN] = 10;
    driving[TURN][0] = 0;
    driving[TURN][1] = 1.5;
    int done = 0;
    ok(cps_system_drive_path(system, COUNT, duration, driving[0], NULL, step, travel[0], &done,
                             &err));
    CHECK_INT(done, COUNT);
    for (int i = 0; i < COUNT; i++) {
        double v[3], gamma;
        wheel_closed_form(60, driving[i], v, &gamma);
        work += duration[i] * gamma;
        spin += duration[i] * v[0];
        CHECK_NEAR(step[i].dissipated, duration[i] * gamma, VALUE * duration[i] * gamma);
        CHECK_NEAR(step[i].driven, step[i].dissipated, VALUE * duration[i] * gamma);
        CHECK_NEAR(step[i].imbalance, 0, VALUE * duration[i] * gamma);
        CHECK_BETWEEN(step[i].upper - step[i].lower, -1e-10 * duration[i] * gamma,
                      1e-8 * duration[i] * gamma);
        CHECK_NEAR(travel[i][0], spin, 1e-9 * (1 + fabs(spin)));
    }
    assert_true(work > 0);
    /* a bad path is refused, and nothing is done */
    duration[3] = 0;
    CHECK_INT(cps_system_drive_path(system, COUNT, duration, driving[0], NULL, step, NULL, &done,
                                    &err),
              CPS_ERR_ARGUMENT);
    CHECK_INT(done, 0);
    cps_system_destroy(system);
}

/* numbers of two independent programs */
static void wheel_numbers(void **state) {
    (void)state;
    static const double CASE[][4] = {{1, 0, 500, 0},
                                     {1, 0.3, 522.0153254455275, 0},
                                     {1, 1, 658.257569495584, -1.8785473984267176},
                                     {0.5, 2, 629.128784747792, -5.939273699213359},
                                     {0, 1, 200, -10.0 / 3}};
    CpsSystem *system = wheel(60);
    CpsLaw *reduced = NULL;
    CpsComposition composition;
    ok(cps_system_eliminate(system, &reduced, NULL, &composition, &err));
    CHECK_INT(composition, CPS_COMPOSITION_INTERIOR);
    for (int i = 0; i < 5; i++) {
        CpsMotion *motion = solve(system, CASE[i]);
        CpsSetAnswer phi;
        certified(motion);
        CHECK_RELATIVE(cps_motion_report(motion).value, CASE[i][2], VALUE);
        CHECK_NEAR(cps_motion_velocity(motion)[0], CASE[i][3], ROOT / A);
        ok(cps_set_dissipation(cps_law_set(reduced), CASE[i], NULL, &phi, &err));
        CHECK_RELATIVE(phi.value, CASE[i][2], VALUE);
        cps_motion_destroy(motion);
    }
    /* the disc with its strip is itself a law, M77 (26) */
    CpsSetMeasure measure;
    ok(cps_set_measure(cps_law_set(reduced), &measure, &err));
    CHECK_RELATIVE(measure.area, 389061.45083197765, 1e-8);
    CHECK_RELATIVE(measure.perimeter, 2656.0639701173122, 1e-8);
    cps_law_release(reduced);
    cps_system_destroy(system);
}

static void extents(const CpsMotion *motion, bool forces, int dimension, int n, const double *low,
                    const double *high, double tolerance) {
    CpsSolutionSet all;
    double from[8], to[8];
    ok(forces ? cps_motion_forces(motion, 0, &all, from, to, &err)
              : cps_motion_velocities(motion, 0, &all, from, to, &err));
    CHECK_INT(all.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_INT(all.dimension, dimension);
    CHECK_INT(all.unique, dimension == 0);
    for (int i = 0; i < n; i++) {
        CHECK_NEAR(from[i], low[i], tolerance);
        CHECK_NEAR(to[i], high[i], tolerance);
    }
    cps_solution_set_clear(&all);
}

/* W along j: the force may lie anywhere on an edge of C; and with b = a f N, so may the motion
 * between rolling and sliding */
static void wheel_along_its_plane(void **state) {
    (void)state;
    static const double W[] = {0, 1}, C = 458.257569495584;
    CpsSystem *braked = wheel(60), *even = wheel(150);
    CpsMotion *motion = solve(braked, W);
    extents(motion, false, 0, 3, (const double[]){-1 / 0.3, 0, 0}, (const double[]){-1 / 0.3, 0, 0},
            ROOT);
    extents(motion, true, 1, 3, (const double[]){60, -C, -200}, (const double[]){60, C, -200},
            ROOT * RADIUS);
    cps_motion_destroy(motion);
    motion = solve(even, W);
    CHECK_RELATIVE(cps_motion_report(motion).value, 500, VALUE);
    extents(motion, false, 1, 3, (const double[]){-1 / 0.3, 0, 0}, (const double[]){0, 0, 1}, ROOT);
    extents(motion, true, 0, 3, (const double[]){150, 0, -500}, (const double[]){150, 0, -500},
            ROOT * RADIUS);
    cps_motion_destroy(motion);
    cps_system_destroy(braked);
    cps_system_destroy(even);
}

/* ---- bipod on +-1, half of the weight each ---- */

static CpsSystem *bipod(void) {
    CpsSystem *system = NULL;
    ok(cps_system_create(3, &system, &err)); /* vx, vy, w */
    add(system, "left", disc(0.5), 3, (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}, {1, 2, -1}});
    add(system, "right", disc(0.5), 3, (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}, {1, 2, 1}});
    return system;
}

static void bipod_about_one_support(void **state) {
    (void)state;
    CpsSystem *system = bipod();
    ok(cps_system_set_drive(system, 3, 3, (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}, {2, 2, 1}},
                            &err));
    CpsMotion *motion = solve(system, (const double[]){0, 1, 1});
    certified(motion);
    CHECK_RELATIVE(cps_motion_report(motion).value, 1, VALUE);
    /* the support at rest bears any force of its disc */
    extents(motion, true, 2, 4, (const double[]){-0.5, -0.5, 0, -0.5},
            (const double[]){0.5, 0.5, 0, -0.5}, ROOT);
    cps_motion_destroy(motion);

    /* turned only: the centre may lie anywhere between the supports */
    ok(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 2, 1}}, &err));
    motion = solve(system, (const double[]){1});
    certified(motion);
    CHECK_RELATIVE(cps_motion_report(motion).value, 1, VALUE);
    extents(motion, false, 1, 3, (const double[]){0, -1, 1}, (const double[]){0, 1, 1}, ROOT);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
}

/* ---- loads: a block of friction 10 on a table ---- */

static CpsSystem *block(double x, double y) {
    CpsSystem *system = NULL;
    ok(cps_system_create(2, &system, &err));
    add(system, "table", disc(10), 2, (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}});
    ok(cps_system_set_load(system, (const double[]){x, y}, &err));
    return system;
}

static void loads(void **state) {
    (void)state;
    CpsSystem *light = block(3, 4), *limit = block(6, 8), *heavy = block(12, 16),
              *driven = block(0, 5);
    CpsMotion *motion = solve(light, NULL);
    certified(motion);
    CHECK_RELATIVE(cps_motion_report(motion).load_factor, 2, VALUE);
    CHECK_NEAR(cps_motion_report(motion).value, 0, 0);
    cps_motion_destroy(motion);

    motion = solve(limit, NULL);
    CHECK_INT(cps_motion_report(motion).outcome, CPS_MOTION_OUTCOME_LIMIT_LOAD);
    CHECK_RELATIVE(cps_motion_report(motion).load_factor, 1, VALUE);
    CHECK_INT(cps_motion_report(motion).composition, CPS_COMPOSITION_NOT_SATISFIED);
    cps_motion_destroy(motion);

    motion = solve(heavy, NULL);
    CHECK_INT(cps_motion_report(motion).outcome, CPS_MOTION_OUTCOME_NO_BALANCE);
    CHECK_RELATIVE(cps_motion_report(motion).load_factor, 0.5, VALUE);
    const double *v = cps_motion_velocity(motion);
    CHECK_RELATIVE(v[1] / v[0], 4.0 / 3, ROOT);
    CHECK_GREATER(12 * v[0] + 16 * v[1], 10 * hypot(v[0], v[1])); /* the proof */
    cps_motion_destroy(motion);

    /* driven along x with 5 of 10 pulling along y: V = (1, 1/sqrt 3), gamma = sqrt(100 - 25) */
    ok(cps_system_set_drive(driven, 1, 1, (const CpsEntry[]){{0, 0, 1}}, &err));
    motion = solve(driven, (const double[]){1});
    certified(motion);
    CHECK_RELATIVE(cps_motion_report(motion).value, sqrt(75), VALUE);
    CHECK_NEAR(cps_motion_velocity(motion)[1], 1 / sqrt(3), ROOT);
    cps_motion_destroy(motion);
    CpsSet *forces = NULL;
    CpsSetExtent extent;
    ok(cps_system_eliminate(driven, NULL, &forces, NULL, &err));
    ok(cps_set_extent(forces, (const double[]){1}, &extent, &err));
    CHECK_RELATIVE(extent.high, sqrt(75), VALUE);
    cps_set_release(forces);
    cps_system_destroy(light);
    cps_system_destroy(limit);
    cps_system_destroy(heavy);
    cps_system_destroy(driven);
}

/* A disc moved so that 0 is on its boundary, driven across and free along its normal: phi(1, b) =
 * sqrt(1 + b^2) - b falls to 0 for ever. The same as a load at the limit. */
static void infimum_not_attained(void **state) {
    (void)state;
    CpsSet *moved = NULL, *ball = NULL;
    ok(cps_set_ball(2, NULL, 1, &ball, &err));
    ok(cps_set_translate((const double[]){0, 1}, ball, &moved, &err));
    for (int k = 0; k < 2; k++) {
        CpsSystem *system = k ? block(0, 10) : NULL;
        if (!k) ok(cps_system_create(2, &system, &err));
        CpsLaw *law = NULL;
        if (!k) ok(cps_law_friction(moved, &law, &err));
        if (!k)
            ok(cps_system_add_friction(system, "beside", law, 2,
                                       (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}}, &err));
        ok(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 0, 1}}, &err));
        CpsMotion *motion = solve(system, (const double[]){2});
        const CpsMotionReport r = cps_motion_report(motion);
        CHECK_INT(r.outcome, CPS_MOTION_OUTCOME_NOT_ATTAINED);
        CHECK_NEAR(r.upper, 0,
                   1e-6 * (k ? 20 : 2)); /* the root of rounding, of the size of force times W */
        CHECK_GREATER(r.upper, 0);
        CHECK_LESS(r.lower, r.upper);
        const double *d = cps_motion_direction(motion);
        CHECK_NEAR(d[0], 0, 1e-9);
        CHECK_NEAR(d[1], 1, 1e-9);
        cps_motion_destroy(motion);
        cps_system_destroy(system);
        cps_law_release(law);
    }
    cps_set_release(ball);
    cps_set_release(moved);
    /* at rest the limit load has motions */
    CpsSystem *still = block(0, 10);
    ok(cps_system_set_drive(still, 1, 1, (const CpsEntry[]){{0, 0, 1}}, &err));
    CpsMotion *motion = solve(still, (const double[]){0});
    CHECK_INT(cps_motion_report(motion).outcome, CPS_MOTION_OUTCOME_LIMIT_LOAD);
    cps_motion_destroy(motion);
    cps_system_destroy(still);
}

/* phi of a half-line of forces F <= 0 is 0 for u <= 0 and infinite beyond: continuous at x = W only
 * for W < 0; a line of forces has it nowhere, bounded laws everywhere. */
static void continuity_of_phi(void **state) {
    (void)state;
    static const struct {
        double low, high, w;
        bool holds;
    } CASE[] = {{-INFINITY, 0, -1, true}, {-INFINITY, 0, 0, false}, {-INFINITY, INFINITY, 0, false},
                {-1, 2, 5, true},         {-1, INFINITY, 2, true},  {-1, INFINITY, 0, false}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; k++) {
        CpsSystem *system = NULL;
        bool known, holds;
        ok(cps_system_create(2, &system, &err));
        add(system, "side", interval(CASE[k].low, CASE[k].high), 1, (const CpsEntry[]){{0, 0, 1}});
        add(system, "table", interval(-1, 1), 1, (const CpsEntry[]){{0, 1, 1}});
        ok(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 0, 1}}, &err));
        CpsMotion *motion = solve(system, &CASE[k].w);
        ok(cps_motion_continuous(motion, &known, &holds, &err));
        assert_true(known);
        CHECK_INT(holds, CASE[k].holds);
        cps_motion_destroy(motion);
        /* free to move, x finds its own place inside: continuous, but for the line */
        ok(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 1, 1}}, &err));
        motion = solve(system, (const double[]){1});
        ok(cps_motion_continuous(motion, &known, &holds, &err));
        CHECK_INT(known && holds, k != 2);
        cps_motion_destroy(motion);
        cps_system_destroy(system);
    }
}

/* b = a f N exactly and W = (1e-6, 1): sliding locked, 500 + 2.5e-10 W, is the only motion. Rolling
 * dissipates up to 4e-10 W more, which the forces of the solution tell and its first digits do
 * not. */
static void told_apart(void **state) {
    (void)state;
    CpsSystem *system = NULL;
    CpsSolutionSet all;
    double low[3], high[3];
    ok(cps_system_create(3, &system, &err));
    add(system, "brake", interval(-150, 150), 1, (const CpsEntry[]){{0, 0, 1}});
    add(system, "ground", disc(500), 2, (const CpsEntry[]){{0, 1, 1}, {1, 2, 1}});
    ok(cps_system_set_drive(system, 2, 3, (const CpsEntry[]){{0, 1, 1}, {1, 2, 1}, {1, 0, -0.3}},
                            &err));
    CpsMotion *motion = solve(system, (const double[]){1e-6, 1});
    ok(cps_motion_velocities(motion, 0, &all, low, high, &err));
    CHECK_NEAR(cps_motion_velocity(motion)[0], 0, ROOT / 0.3);
    CHECK_NEAR(cps_motion_resistance(motion)[0], -500 * 1e-6,
               500 * ROOT); /* the force is against W */
    assert_true(all.outcome != CPS_SET_OUTCOME_ANSWERED ||
                (all.unique && fabs(low[0]) < 1e-6 && fabs(high[0]) < 1e-6));
    cps_solution_set_clear(&all);
    cps_motion_destroy(motion);
    /* aside by a hundredth they are told apart */
    motion = solve(system, (const double[]){1e-2, 1});
    ok(cps_motion_velocities(motion, 0, &all, low, high, &err));
    CHECK_INT(all.outcome, CPS_SET_OUTCOME_ANSWERED);
    assert_true(all.unique);
    cps_solution_set_clear(&all);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
}

/* A load above the limit by one part in 1e7 to 1e12 has no balance, and the proof says so; below it
 * it has. */
static void loads_beside_the_limit(void **state) {
    (void)state;
    for (int k = 7; k <= 12; k++) {
        for (int side = -1; side <= 1; side += 2) {
            CpsSystem *system = block(6 * (1 + side * pow(10, -k)), 8 * (1 + side * pow(10, -k)));
            CpsMotion *motion = solve(system, NULL);
            const CpsMotionReport r = cps_motion_report(motion);
            CHECK_INT(r.outcome,
                      side > 0 ? CPS_MOTION_OUTCOME_NO_BALANCE : CPS_MOTION_OUTCOME_LIMIT_LOAD);
            if (side > 0)
                assert_true(isinf(r.value) && r.value < 0);
            else
                CHECK_NEAR(r.value, 0, 0);
            cps_motion_destroy(motion);
            cps_system_destroy(system);
        }
    }
}

/* A brake of 1e-9 beside a ground of 500: the wheel rolls, gamma = 500 |side| + 1e-9 |roll|/0.3. */
static void weak_beside_strong(void **state) {
    (void)state;
    CpsSystem *system = NULL;
    ok(cps_system_create(3, &system, &err));
    add(system, "brake", interval(-1e-9, 1e-9), 1, (const CpsEntry[]){{0, 0, 1}});
    add(system, "ground", disc(500), 2, (const CpsEntry[]){{0, 1, 1}, {1, 2, 1}});
    ok(cps_system_set_drive(system, 2, 3, (const CpsEntry[]){{0, 1, 1}, {1, 2, 1}, {1, 0, -0.3}},
                            &err));
    static const double W[][2] = {{1, 1}, {1, -1}, {0.3, 2}, {-1, 0.001}};
    for (int k = 0; k < 4; k++) {
        CpsMotion *motion = solve(system, W[k]);
        certified(motion);
        /* the solver's own bound, and its root: phi is curved in the velocity that nothing but the
         * ground resists */
        CHECK_RELATIVE(cps_motion_report(motion).value,
                       500 * fabs(W[k][0]) + 1e-9 * fabs(W[k][1]) / 0.3, 1e-8);
        CHECK_NEAR(cps_motion_velocity(motion)[0], -W[k][1] / 0.3, ROOT / 0.3);
        /* it slips in its brake, which then bears all it can; the last slips at a power of 3e-12 W
         * beside 500 W, too little to decide */
        if (k < 3)
            CHECK_RELATIVE(cps_motion_law_force(motion, 0)[0], copysign(1e-9, W[k][1]), 1e-9);
        cps_motion_destroy(motion);
    }
    cps_system_destroy(system);
}

/* All resistances: dependent rows of the drive leave G open along a line; at rest it is as open as
 * the forces. */
static void resistances_that_are_open(void **state) {
    (void)state;
    CpsSystem *system = NULL;
    double low[2], high[2];
    CpsSolutionSet all;
    ok(cps_system_create(1, &system, &err));
    add(system, "table", interval(-3, 3), 1, (const CpsEntry[]){{0, 0, 1}});
    ok(cps_system_set_drive(system, 2, 2, (const CpsEntry[]){{0, 0, 1}, {1, 0, 2}}, &err));
    CpsMotion *motion = solve(system, (const double[]){1, 2});
    ok(cps_motion_resistances(motion, 0, &all, low, high, &err));
    CHECK_INT(all.dimension, 1);
    assert_true(!all.unique && !all.bounded && isinf(low[0]) && isinf(high[1]));
    CpsSetExtent extent; /* G1 + 2 G2 = -3 all the same */
    ok(cps_set_extent(all.set, (const double[]){1, 2}, &extent, &err));
    CHECK_NEAR(extent.low, -3, 1e-9);
    CHECK_NEAR(extent.high, -3, 1e-9);
    cps_solution_set_clear(&all);
    cps_motion_destroy(motion);
    ok(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 0, 1}}, &err));
    motion = solve(system, (const double[]){0});
    ok(cps_motion_resistances(motion, 0, &all, low, high, &err));
    CHECK_NEAR(low[0], -3, 1e-9);
    CHECK_NEAR(high[0], 3, 1e-9);
    cps_solution_set_clear(&all);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
}

/* a driver that holds the block by 8 slips on it; one that holds it by 12 moves it */
static void driver_of_bounded_strength(void **state) {
    (void)state;
    for (int strong = 0; strong < 2; strong++) {
        CpsSystem *system = NULL;
        ok(cps_system_create(2, &system, &err)); /* block, driver */
        add(system, "table", interval(-10, 10), 1, (const CpsEntry[]){{0, 0, 1}});
        add(system, "grip", interval(strong ? -12 : -8, strong ? 12 : 8), 2,
            (const CpsEntry[]){{0, 1, 1}, {0, 0, -1}});
        ok(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 1, 1}}, &err));
        CpsMotion *motion = solve(system, (const double[]){2});
        certified(motion);
        CHECK_RELATIVE(cps_motion_report(motion).value, strong ? 20 : 16, VALUE);
        CHECK_NEAR(cps_motion_velocity(motion)[0], strong ? 2 : 0, ROOT);
        CHECK_NEAR(cps_motion_resistance(motion)[0], strong ? -10 : -8, ROOT * 10);
        cps_motion_destroy(motion);
        cps_system_destroy(system);
    }
}

/* ---- resistances ---- */

/* Two dashpots c1, c2 in series: the middle moves at c2 W/(c1 + c2); potential c1 c2/(c1 + c2)
 * W^2/2, power twice that. */
static void dashpots_in_series(void **state) {
    (void)state;
    static const double C1 = 3, C2 = 5, W = 0.7;
    CpsSystem *system = NULL;
    CpsResistance *one = NULL, *two = NULL;
    ok(cps_system_create(2, &system, &err)); /* middle, end */
    ok(cps_resistance_viscous(1, &C1, &one, &err));
    ok(cps_resistance_viscous(1, &C2, &two, &err));
    ok(cps_system_add_resistance(system, "first", one, 1, (const CpsEntry[]){{0, 0, 1}}, &err));
    ok(cps_system_add_resistance(system, "second", two, 2,
                                 (const CpsEntry[]){{0, 1, 1}, {0, 0, -1}}, &err));
    ok(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 1, 1}}, &err));
    CpsMotion *motion = solve(system, &W);
    certified(motion);
    const double c = C1 * C2 / (C1 + C2);
    CHECK_RELATIVE(cps_motion_report(motion).value, c * W * W / 2, VALUE);
    CHECK_RELATIVE(cps_motion_report(motion).dissipated, c * W * W, ROOT);
    CHECK_RELATIVE(cps_motion_velocity(motion)[0], C2 * W / (C1 + C2), ROOT);
    CHECK_RELATIVE(cps_motion_resistance(motion)[0], -c * W, ROOT);
    cps_motion_destroy(motion);
    cps_resistance_release(one);
    cps_resistance_release(two);
    cps_system_destroy(system);
}

/* A load g on a parameter with dry friction 2, viscosity 3, a quadratic term 4 of an interval of 1,
 * and a table: V where the resistance is g. The table's factor rises from 0 to 5 between speeds 0
 * and 1 and stays. */
static void terms_side_by_side(void **state) {
    (void)state;
    static const double C = 3, LOAD = 20, SPEED[] = {0, 1}, FACTOR[] = {0, 5};
    CpsLaw *dry = interval(-2, 2), *unit = interval(-1, 1);
    CpsResistance *part[4] = {NULL}, *sum = NULL;
    ok(cps_resistance_dry(dry, &part[0], &err));
    ok(cps_resistance_viscous(1, &C, &part[1], &err));
    ok(cps_resistance_power(unit, 2, 4, &part[2], &err));
    ok(cps_resistance_table(unit, 2, SPEED, FACTOR, &part[3], &err));
    ok(cps_resistance_sum(4, (const CpsResistance *const *)part, &sum, &err));
    CpsSystem *system = NULL;
    ok(cps_system_create(1, &system, &err));
    ok(cps_system_add_resistance(system, "all", sum, 1, (const CpsEntry[]){{0, 0, 1}}, &err));
    ok(cps_system_set_load(system, &LOAD, &err));
    CpsMotion *motion = solve(system, NULL);
    certified(motion);
    /* 2 + 3 v + 4 v + 5 = 20 */
    const double v = 13.0 / 7;
    CHECK_RELATIVE(cps_motion_velocity(motion)[0], v, ROOT);
    CHECK_RELATIVE(cps_motion_report(motion).value,
                   2 * v + 3.5 * v * v + 2.5 + 5 * (v - 1) - LOAD * v, VALUE);
    CHECK_RELATIVE(cps_motion_report(motion).dissipated, LOAD * v, ROOT);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    for (int i = 0; i < 4; i++) cps_resistance_release(part[i]);
    cps_resistance_release(sum);
    cps_law_release(dry);
    cps_law_release(unit);
}

/* ---- rope on a table: friction 1 per length, inextensible elements ---- */

enum Ends { HALVES, FREE_END_WHOLE };

/* Nodes 0 .. n, element i between i - 1 and i turned by i turn from the first. HALVES: end nodes
 * stand for half an element; FREE_END_WHOLE: node i for the element behind it, so the driven one
 * for none. */
static CpsSystem *rope(int n, double length, double turn, enum Ends ends, bool one_sided) {
    const double h = length / n;
    CpsSystem *system = NULL;
    CpsLaw *whole = disc(h), *half = disc(h / 2), *taut = interval(-INFINITY, 0);
    ok(cps_system_create(2 * (n + 1), &system, &err));
    for (int i = 0; i <= n; i++) {
        const bool end = i == 0 || i == n;
        if (ends == FREE_END_WHOLE && i == n) continue;
        ok(cps_system_add_friction(system, NULL, ends == HALVES && end ? half : whole, 2,
                                   (const CpsEntry[]){{0, 2 * i, 1}, {1, 2 * i + 1, 1}}, &err));
    }
    for (int i = 1; i <= n; i++) {
        const double x = cos((i - 1) * turn), y = sin((i - 1) * turn);
        const CpsEntry stretch[] = {{0, 2 * i, x},
                                    {0, 2 * i + 1, y},
                                    {0, 2 * i - 2, -x},
                                    {0, 2 * i - 1, -y}};
        if (one_sided)
            ok(cps_system_add_friction(system, NULL, taut, 4, stretch, &err));
        else
            ok(cps_system_add_constraints(system, 1, 4, stretch, &err));
    }
    ok(cps_system_set_drive(system, 2, 2, (const CpsEntry[]){{0, 2 * n, 1}, {1, 2 * n + 1, 1}},
                            &err));
    cps_law_release(whole);
    cps_law_release(half);
    cps_law_release(taut);
    return system;
}

/* Pulled at 60 degrees, all nodes move along the rope but the driven one: gamma = L cos + h/2 (1 -
 * cos) */
static void straight_rope_at_an_angle(void **state) {
    (void)state;
    static const int N[] = {10, 100, 1000};
    static const double WANT[] = {0.525, 0.5025, 0.50025};
    for (int i = 0; i < 3; i++)
        for (int one_sided = 0; one_sided < 2; one_sided++) {
            CpsSystem *system = rope(N[i], 1, 0, HALVES, one_sided);
            CpsMotion *motion = solve(system, (const double[]){cos(PI / 3), sin(PI / 3)});
            certified(motion);
            CHECK_NEAR(cps_motion_report(motion).value, WANT[i], VALUE);
            cps_motion_destroy(motion);
            cps_system_destroy(system);
        }
}

/* Pulled along itself, an arc of one radian bears T' = sqrt(1 - T^2): T = sin 1 as the mesh is
 * refined. Node by node the most that the next element bears is T cos(d) + sqrt(h^2 - T^2
 * sin(d)^2). */
static void arc_of_rope(void **state) {
    (void)state;
    static const int N[] = {100, 1000, 10000};
    static const double PRINTED[] = {0.8414850, 0.84147113, 0.84147099}; /* to the digits given */
    for (int i = 0; i < 3; i++) {
        const double h = 1.0 / N[i];
        double tension = h;
        for (int k = 1; k < N[i]; k++)
            tension = tension * cos(h) + sqrt(h * h - pow(tension * sin(h), 2));
        CpsSystem *system = rope(N[i], 1, h, FREE_END_WHOLE, false);
        const double angle = (N[i] - 1) * h;
        CpsMotion *motion = solve(system, (const double[]){cos(angle), sin(angle)});
        certified(motion);
        CHECK_NEAR(cps_motion_report(motion).value, tension, VALUE);
        CHECK_NEAR(cps_motion_report(motion).value, PRINTED[i], i == 0 ? 6e-8 : 6e-9);
        cps_motion_destroy(motion);
        cps_system_destroy(system);
    }
}

/* Pushed along itself, a rope that may shorten does not move but for its end: gamma is the end's
 * own friction. */
static void pushed_rope(void **state) {
    (void)state;
    CpsSystem *system = rope(20, 1, 0, HALVES, true);
    CpsMotion *motion = solve(system, (const double[]){-1, 0});
    certified(motion);
    CHECK_NEAR(cps_motion_report(motion).value, 0.025, VALUE);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wheel_all_cases),
        cmocka_unit_test(wheel_along_a_path),
        cmocka_unit_test(wheel_numbers),
        cmocka_unit_test(wheel_along_its_plane),
        cmocka_unit_test(bipod_about_one_support),
        cmocka_unit_test(loads),
        cmocka_unit_test(infimum_not_attained),
        cmocka_unit_test(told_apart),
        cmocka_unit_test(continuity_of_phi),
        cmocka_unit_test(loads_beside_the_limit),
        cmocka_unit_test(weak_beside_strong),
        cmocka_unit_test(resistances_that_are_open),
        cmocka_unit_test(driver_of_bounded_strength),
        cmocka_unit_test(dashpots_in_series),
        cmocka_unit_test(terms_side_by_side),
        cmocka_unit_test(straight_rope_at_an_angle),
        cmocka_unit_test(arc_of_rope),
        cmocka_unit_test(pushed_rope),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
