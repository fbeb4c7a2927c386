/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies sliding on a plane, with closed forms.
 *
 * Limit surfaces: ring phi = (2/pi)(|v| + R|w|) E(m); disc by Farkas et al. (PRL 90, 248302, 2003);
 * rod by integrating hypot(vx, vy + w s); square in pure rotation (sqrt2 + asinh 1)/6. Every value
 * is also proved by sums from below and above. Driven bodies: centre of rotation and gamma of rod,
 * disc and ring. Vehicles: the sum of four wheels of M77 (26). */
#include <stdio.h>
#include <stdlib.h>

#include "capstan/planar.h"
#include "check.h"

/* A closed form in some tens of operations, near log singularities of elliptic integrals in some
 * hundreds. */
static const double EXACT = 1e-13;

/* What the brackets of a search leave: rounding over the slope's steepness, which is of order one
 * in these cases. */
static const double FOUND = 1e-11;

/* Published numbers that are printed to this many places. */
static const double PRINTED = 6e-12;

static const double PI = 3.14159265358979323846;

static CpsPlanar *body_of(int count, const CpsPatch *patch) {
    CpsPlanar *body = NULL;
    CpsError err = {.message = ""};
    if (cps_planar_create(count, patch, &body, &err) != CPS_OK) fail_msg("%s", err.message);
    return body;
}

/* Unit friction force and unit size at the origin. */
static CpsPlanar *unit_body(CpsPatchKind kind) {
    return body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                  .kind = kind,
                                  .friction = 1,
                                  .load = 1,
                                  .size = 1});
}

static const double SQUARE[8] = {-0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, 0.5};

static CpsPlanar *square_body(double tilt_x, double tilt_y) {
    return body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                  .kind = CPS_PATCH_POLYGON,
                                  .friction = 1,
                                  .load = 1,
                                  .tilt = {tilt_x, tilt_y},
                                  .corner_count = 4,
                                  .corner = SQUARE});
}

static double power(const CpsPlanar *body, double vx, double vy, double w, double wrench[3]) {
    CpsSetAnswer answer;
    assert_int_equal(cps_planar_dissipation(body, (double[3]){vx, vy, w}, wrench, NULL, &answer,
                                            NULL),
                     CPS_OK);
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    return answer.value;
}

/* The closed form lies between the certified sums, which are 1e-6 apart; the wrench takes that
 * power, and no other wrench of the law met here takes more (it lies in C). */
static void prove(const CpsPlanar *body, double vx, double vy, double w) {
    double wrench[3];
    const double twist[3] = {vx, vy, w}, value = power(body, vx, vy, w, wrench);
    CpsPlanarBounds bounds;
    assert_int_equal(cps_planar_bounds(body, twist, 0, &bounds, NULL), CPS_OK);
    assert_int_equal(bounds.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_BETWEEN(value, bounds.lower, bounds.upper);
    CHECK_LESS(bounds.upper - bounds.lower, 1.000001e-6 * bounds.upper);
    CHECK_RELATIVE(-(wrench[0] * vx + wrench[1] * vy + wrench[2] * w), value, EXACT);
    for (int i = 0; i < 24; i++) {
        const double a = 2 * PI * i / 24, b = PI * (i % 5 - 2) / 5;
        const double other[3] = {cos(a) * cos(b), sin(a) * cos(b), sin(b)};
        const double most = power(body, other[0], other[1], other[2], NULL);
        CHECK_LESS(-(wrench[0] * other[0] + wrench[1] * other[1] + wrench[2] * other[2]),
                   most + EXACT);
    }
}

/* ---- limit surfaces ---- */

static void ring(void **state) {
    (void)state;
    CpsPlanar *body = unit_body(CPS_PATCH_RING);
    CHECK_RELATIVE(power(body, 1, 0, 0.5, NULL), 1.0635444099733649, EXACT);
    CHECK_RELATIVE(power(body, 0.6, -0.8, -1, NULL), 4 / PI, EXACT);
    CHECK_RELATIVE(power(body, 3, 4, 0, NULL), 5, EXACT);
    prove(body, 1, 0, 0.5);
    prove(body, 0.6, -0.8, -1);
    prove(body, 0.1, 0, 2);
    cps_planar_destroy(body);

    /* under linear pressure, which in pure rotation takes as much and in translation has its centre
     * off the middle */
    body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                  .kind = CPS_PATCH_RING,
                                  .friction = 1,
                                  .load = 1,
                                  .size = 2,
                                  .tilt = {0.3, 0.4}});
    double wrench[3];
    CHECK_RELATIVE(power(body, 0, 0, 1, NULL), 2, EXACT);
    power(body, 1, 0, 0, wrench);
    CHECK_RELATIVE(wrench[2], 0.4 * 2, EXACT); /* tilt a^2/2 */
    prove(body, 1, 0.3, 0.5);
    prove(body, 0, 0.8, -0.4); /* the centre of rotation on the ring */
    cps_planar_destroy(body);
}

static void disc(void **state) {
    (void)state;
    static const double TABLE[][3] = {{0.25, 0.24803130976, 0.63578612361},
                                      {0.5, 0.48384375563, 0.54774835477},
                                      {1.5, 0.94081937550, 0.17379810553},
                                      {3, 0.98591116599, 0.08413023494}};
    CpsPlanar *body = unit_body(CPS_PATCH_DISC);
    double wrench[3];
    for (size_t i = 0; i < sizeof TABLE / sizeof TABLE[0]; i++) {
        power(body, TABLE[i][0], 0, 1, wrench);
        CHECK_NEAR(-wrench[0], TABLE[i][1], PRINTED);
        CHECK_NEAR(-wrench[2], TABLE[i][2], PRINTED);
        prove(body, TABLE[i][0], 0, 1);
    }
    power(body, 1, 0, 1, wrench);
    CHECK_RELATIVE(-wrench[0], 8 / (3 * PI), EXACT);
    CHECK_RELATIVE(-wrench[2], 8 / (9 * PI), EXACT);
    power(body, 0, 0, -1, wrench);
    CHECK_RELATIVE(wrench[2], 2.0 / 3, EXACT);

    /* near translation T = (R w/v)/4, near rotation F = v/(R w): small parts keep what digits the
     * whole has, or more */
    power(body, 1e7, 0, 1, wrench);
    CHECK_NEAR(-wrench[2], 0.25e-7, 1e-15);
    power(body, 1e-7, 0, 1, wrench);
    CHECK_RELATIVE(-wrench[0], 1e-7, 1e-12);
    prove(body, 3.999, 0, 1); /* on both sides of where the form changes */
    prove(body, 4.001, 0, 1);
    cps_planar_destroy(body);

    /* under linear pressure: the force of a pure rotation is tilt a/3, the torque of a translation
     * tilt a^2/4 */
    body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                  .kind = CPS_PATCH_DISC,
                                  .friction = 1,
                                  .load = 1,
                                  .size = 2,
                                  .tilt = {0.3, 0.4}});
    power(body, 0, 0, 1, wrench);
    CHECK_RELATIVE(wrench[2], -4.0 / 3, EXACT);
    CHECK_RELATIVE(wrench[0], 0.4 * 2 / 3, EXACT);
    CHECK_RELATIVE(wrench[1], -0.3 * 2 / 3, EXACT);
    power(body, 1, 0, 0, wrench);
    CHECK_RELATIVE(wrench[2], 0.4, EXACT);
    prove(body, 1, 0.3, 0.5);
    prove(body, 0, 0.8, -0.4);
    prove(body, 7.998, 0, 1);
    prove(body, 8.002, 0, 1);
    cps_planar_destroy(body);
}

/* Along the ray from the centre, where does the exact surface lie in the ellipsoid (1, 1, 2/3) of
 * robotics codes? */
static void disc_against_ellipsoid(void **state) {
    (void)state;
    CpsPlanar *body = unit_body(CPS_PATCH_DISC);
    double wrench[3], least = 2, where = 0;
    for (int i = 1; i < 4000; i++) {
        const double e = 0.001 * i;
        power(body, e, 0, 1, wrench);
        const double part = hypot(wrench[0], 1.5 * wrench[2]);
        if (part < least) {
            least = part;
            where = e;
        }
    }
    CHECK_NEAR(1 - least, 0.066, 5e-4); /* "6.6 %" */
    CHECK_NEAR(least, 0.93420517, 5e-9);
    CHECK_NEAR(where, 0.766, 1e-3); /* a flat minimum, on a grid of 1e-3 */
    power(body, 0.763, 0, 1, wrench);
    CHECK_NEAR(hypot(wrench[0], 1.5 * wrench[2]), 0.934209,
               1e-6); /* known elsewhere by a quadrature good to 1e-6 */
    cps_planar_destroy(body);
}

static void rod(void **state) {
    (void)state;
    CpsPlanar *body = unit_body(CPS_PATCH_ROD);
    CHECK_RELATIVE(power(body, 1, 0.5, 0.7, NULL), 1.17610140974653, EXACT);
    CHECK_RELATIVE(power(body, 0, 0, 3, NULL), 1.5, EXACT);
    CHECK_RELATIVE(power(body, 0, 0.5, 1, NULL), 0.625,
                   EXACT); /* (1 + 1/4)/2, centre of rotation on the rod */
    prove(body, 1, 0.5, 0.7);
    prove(body, 0, 0.5, 1);
    cps_planar_destroy(body);

    /* pressure that falls to 0 at one end, in pure rotation: integral of (1 + s)|s|/2 = 1/2, at any
     * heading */
    body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                  .kind = CPS_PATCH_ROD,
                                  .friction = 0.5,
                                  .load = 2,
                                  .size = 1,
                                  .angle = 0.6,
                                  .tilt = {1}});
    CHECK_RELATIVE(power(body, 0, 0, 1, NULL), 0.5, EXACT);
    prove(body, 1, 0.5, 0.7);
    prove(body, 1, 0.5, 0.27949); /* on both sides of where the closed form changes */
    prove(body, 1, 0.5, 0.27961);
    cps_planar_destroy(body);
}

static void polygon(void **state) {
    (void)state;
    CpsPlanar *body = square_body(0, 0);
    CHECK_RELATIVE(power(body, 0, 0, 1, NULL), 0.38259785823, 1e-11); /* as printed */
    CHECK_RELATIVE(power(body, 0, 0, 1, NULL), (sqrt(2) + asinh(1)) / 6, EXACT);
    CHECK_RELATIVE(power(body, 0.6, 0.8, 0, NULL), 1, EXACT);
    prove(body, 0, 0, 1);
    prove(body, 0.1, 0.2, 1);
    prove(body, 0.5, 0, 1);   /* the centre of rotation on a side */
    prove(body, 0.5, 0.5, 1); /* on a corner */
    prove(body, 2, 2,
          1); /* on both sides of where the closed form changes: |v| = 4 x half diagonal */
    prove(body, 2, 2.000001, 1);
    cps_planar_destroy(body);

    /* with linear pressure, turned and moved */
    body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                  .kind = CPS_PATCH_POLYGON,
                                  .position = {0.4, -1},
                                  .angle = 0.3,
                                  .friction = 0.7,
                                  .load = 20,
                                  .tilt = {0.7, -0.9},
                                  .corner_count = 4,
                                  .corner = SQUARE});
    prove(body, 0, 0, 1);
    prove(body, -1, -0.4, 1); /* about the middle */
    prove(body, 3, 0.1, -1);
    cps_planar_destroy(body);

    /* a regular polygon of 3000 corners is the disc, to the share of its area: 2 pi^2/(3 n^2) =
     * 7e-7 */
    enum { CORNERS = 3000 };
    double *corner = malloc(2 * CORNERS * sizeof *corner);
    for (int i = 0; i < CORNERS; i++) {
        corner[2 * i] = cos(2 * PI * i / CORNERS);
        corner[2 * i + 1] = sin(2 * PI * i / CORNERS);
    }
    body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                  .kind = CPS_PATCH_POLYGON,
                                  .friction = 1,
                                  .load = 1,
                                  .corner_count = CORNERS,
                                  .corner = corner});
    CpsPlanar *round = unit_body(CPS_PATCH_DISC);
    CHECK_RELATIVE(power(body, 0.7, 0.2, 1, NULL), power(round, 0.7, 0.2, 1, NULL), 8e-7);
    cps_planar_destroy(round);
    cps_planar_destroy(body);
    free(corner);
}

/* Laws inside and outside: their values enclose the closed form, and approach it as 1/cells in the
 * plane. */
static void inner_and_outer_laws(void **state) {
    (void)state;
    static const double TWIST[3] = {0.3, 0.2, 1};
    CpsPlanar *body[3] = {unit_body(CPS_PATCH_DISC), square_body(0.5, 0.9),
                          unit_body(CPS_PATCH_RING)};
    for (int k = 0; k < 3; k++) {
        const double value = power(body[k], TWIST[0], TWIST[1], TWIST[2], NULL);
        double width[2];
        for (int fine = 0; fine < 2; fine++) {
            double end[2];
            for (int side = 0; side < 2; side++) {
                CpsLaw *law = NULL;
                CpsSetAnswer answer;
                assert_int_equal(cps_planar_law(body[k], side ? CPS_PLANAR_OUTER : CPS_PLANAR_INNER,
                                                fine ? 1600 : 400, &law, NULL),
                                 CPS_OK);
                assert_int_equal(cps_set_dissipation(cps_law_set(law), TWIST, NULL, &answer, NULL),
                                 CPS_OK);
                end[side] = answer.value;
                cps_law_release(law);
            }
            CHECK_BETWEEN(value, end[0], end[1]);
            width[fine] = end[1] - end[0];
        }
        /* four times the cells: a quarter in the plane, a sixteenth on the line; whole rows make
         * the counts uneven */
        if (k < 2)
            CHECK_BETWEEN(width[0] / width[1], 3.3, 4.8);
        else
            CHECK_BETWEEN(width[0] / width[1], 14.5, 16.5);
        CHECK_LESS(
            width[1],
            2.0 / 1600 *
                value); /* load x h^2/rho, cells of h^2 = area/cells: 1.6/cells at most here */
        cps_planar_destroy(body[k]);
    }
}

/* ---- driven bodies ---- */

/* Both components of a point imposed, then only the one across: by symmetry the same motion. */
static void drive_end(const CpsPlanar *body, double gamma, double turning, double centre,
                      double tolerance) {
    const double map[6] = {1, 0, 0, 0, 1, 1}, velocity[2] = {0, 1};
    for (int rows = 1; rows <= 2; rows++) {
        CpsPlanarMotion motion;
        assert_int_equal(cps_planar_drive(body, rows, map + 6 - 3 * rows, velocity + 2 - rows,
                                          &motion, NULL),
                         CPS_OK);
        assert_int_equal(motion.outcome, CPS_SET_OUTCOME_ANSWERED);
        CHECK_NEAR(motion.lower, gamma, tolerance);
        CHECK_NEAR(motion.upper, gamma, tolerance);
        CHECK_LESS(motion.lower, motion.upper);
        CHECK_NEAR(motion.twist[2], turning, tolerance);
        CHECK_NEAR(motion.twist[0], 0, tolerance);
        CHECK_NEAR(motion.centre[0], centre, tolerance);
        CHECK_NEAR(motion.drive[rows - 1], gamma, tolerance);
        CHECK_NEAR(motion.wrench[2], motion.wrench[1],
                   tolerance); /* the line of action passes through the end (1, 0) */
    }
}

static void driven_rod_disc_and_ring(void **state) {
    (void)state;
    CpsPlanar *body = unit_body(CPS_PATCH_ROD);
    /* half length 1: centre 2/sqrt2 from the end; w = W/(distance) */
    drive_end(body, sqrt(2) - 1, 1 / sqrt(2), 1 - sqrt(2), FOUND);
    cps_planar_destroy(body);

    body = unit_body(CPS_PATCH_DISC);
    drive_end(body, 0.525790712182, 0.64636634, -0.54711027, 5e-9); /* as printed */
    cps_planar_destroy(body);

    body = unit_body(CPS_PATCH_RING);
    drive_end(body, 2 / PI, 0.5, -1, FOUND);
    cps_planar_destroy(body);
}

/* gamma of laws inside and outside, by the conic solver of drive.h, encloses the closed form's. */
static void driven_disc_by_cells(void **state) {
    (void)state;
    CpsPlanar *body = unit_body(CPS_PATCH_DISC);
    double gamma[2];
    for (int side = 0; side < 2; side++) {
        CpsSystem *system = NULL;
        CpsMotion *motion = NULL;
        assert_int_equal(cps_planar_system(body, side ? CPS_PLANAR_OUTER : CPS_PLANAR_INNER, 400,
                                           &system, NULL),
                         CPS_OK);
        const CpsEntry rim[3] = {{0, 0, 1}, {1, 1, 1}, {1, 2, 1}};
        assert_int_equal(cps_system_set_drive(system, 2, 3, rim, NULL), CPS_OK);
        assert_int_equal(cps_system_solve(system, (double[2]){0, 1}, NULL, &motion, NULL), CPS_OK);
        const CpsMotionReport report = cps_motion_report(motion);
        assert_int_equal(report.outcome, CPS_MOTION_OUTCOME_SOLVED);
        gamma[side] = side ? report.upper : report.lower;
        cps_motion_destroy(motion);
        cps_system_destroy(system);
    }
    CHECK_BETWEEN(0.525790712182, gamma[0], gamma[1]);
    CHECK_LESS(gamma[1] - gamma[0], 2.0 / 400 * 0.53); /* as for one value, above */
    cps_planar_destroy(body);
}

/* ---- two supports: motions and forces that are not unique ---- */

static CpsPlanar *bipod(void) {
    const CpsPatch patch[2] = {{.cookie = cps_patch_default().cookie,
                                .kind = CPS_PATCH_POINT,
                                .position = {-1, 0},
                                .friction = 1,
                                .load = 0.5},
                               {.cookie = cps_patch_default().cookie,
                                .kind = CPS_PATCH_POINT,
                                .position = {1, 0},
                                .friction = 1,
                                .load = 0.5}};
    return body_of(2, patch);
}

/* Pushed in the middle, across: phi = (|1 - w| + |1 + w|)/2 = 1 for every |w| <= 1, from turning
 * about one support to turning about the other. */
static void bipod_motions(void **state) {
    (void)state;
    static const double MAP[6] = {1, 0, 0, 0, 1, 0}, PUSH[2] = {0, 1};
    CpsPlanar *body = bipod();
    double low[3], high[3];
    CpsPlanarMotion motion;
    assert_int_equal(cps_planar_drive(body, 2, MAP, PUSH, &motion, NULL), CPS_OK);
    CHECK_NEAR(motion.lower, 1, EXACT);
    CHECK_NEAR(motion.upper, 1, EXACT);
    assert_int_equal(cps_planar_motions(body, 2, MAP, PUSH, 1e-10, low, high, NULL), CPS_OK);
    CHECK_NEAR(low[2], -1, 1.1e-10); /* the tolerance asked for, over the slope 1 */
    CHECK_NEAR(high[2], 1, 1.1e-10);
    CHECK_NEAR(low[1], 1, EXACT);
    CHECK_NEAR(high[1], 1, EXACT);

    /* pushed along: as cheap at both ends and between, dearer beyond */
    CHECK_NEAR(power(body, 0, 1, low[2], NULL), 1, 2e-10);
    CHECK_NEAR(power(body, 0, 1, 0.3, NULL), 1, EXACT);
    CHECK_NEAR(power(body, 0, 1, high[2], NULL), 1, 2e-10);
    CHECK_NEAR(power(body, 0, 1, 1.01, NULL), 1.01, EXACT);
    CHECK_NEAR(power(body, 0, 1, -1.01, NULL), 1.01, EXACT);

    /* the same from drive.h, which gives the set itself: a segment */
    CpsSystem *system = NULL;
    CpsMotion *solved = NULL;
    CpsSolutionSet all;
    assert_int_equal(cps_planar_system(body, CPS_PLANAR_INNER, 1, &system, NULL), CPS_OK);
    assert_int_equal(cps_system_set_drive(system, 2, 2, (CpsEntry[]){{0, 0, 1}, {1, 1, 1}}, NULL),
                     CPS_OK);
    assert_int_equal(cps_system_solve(system, PUSH, NULL, &solved, NULL), CPS_OK);
    assert_int_equal(cps_motion_velocities(solved, 0, &all, low, high, NULL), CPS_OK);
    assert_int_equal(all.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_INT(all.dimension, 1);
    CHECK_NEAR(low[2], -1, 1e-6); /* its tolerance */
    CHECK_NEAR(high[2], 1, 1e-6);
    cps_solution_set_clear(&all);
    cps_motion_destroy(solved);
    cps_system_destroy(system);
    cps_planar_destroy(body);
}

/* Turning about one support leaves that support's force open: a disc of wrenches, of dimension
 * 2. */
static void bipod_forces(void **state) {
    (void)state;
    CpsPlanar *body = bipod();
    CpsLaw *law = NULL;
    CpsSet *forces = NULL;
    CpsSetAnswer answer;
    CpsSetFacts facts;
    assert_int_equal(cps_planar_law(body, CPS_PLANAR_OUTER, 1, &law, NULL), CPS_OK);
    assert_int_equal(cps_set_forces(cps_law_set(law), (double[3]){0, 1, 1}, 0, &forces, &answer,
                                    NULL),
                     CPS_OK);
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_NEAR(answer.value, 1,
               1e-10); /* the sum of two closed forms, found through a set's answer */
    assert_int_equal(cps_set_facts(forces, 0, &facts, NULL, NULL, NULL), CPS_OK);
    CHECK_INT(facts.dimension, 2);
    cps_set_release(forces);
    cps_law_release(law);
    cps_planar_destroy(body);
}

/* ---- a vehicle on four wheels ---- */

typedef struct Wheel {
    double x, y, heading, friction, load, radius, brake;
} Wheel;

/* parallel steering, brakes stronger in front, one locked: every branch of the wheel's law */
static const Wheel CAR[4] = {{0, 0.75, 0, 0.8, 4000, 0.3, 100},
                             {0, -0.75, 0, 0.8, 4000, 0.3, 0},
                             {2.5, 0.75, 0.2, 0.8, 5000, 0.3, 300},
                             {2.5, -0.75, 0.2, 0.8, 5000, 0.3, 2000}};

static CpsPlanar *car_body(void) {
    CpsPatch patch[4];
    for (int i = 0; i < 4; i++)
        patch[i] = (CpsPatch){.cookie = cps_patch_default().cookie,
                              .kind = CPS_PATCH_WHEEL,
                              .position = {CAR[i].x, CAR[i].y},
                              .angle = CAR[i].heading,
                              .friction = CAR[i].friction,
                              .load = CAR[i].load,
                              .size = CAR[i].radius,
                              .brake = CAR[i].brake};
    return body_of(4, patch);
}

/* phi of M77 figure 1: r|W| on the arcs, s|Wj| + c|Wi| at corners and edges; the sum over wheels */
static double car_by_hand(const double twist[3]) {
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        const Wheel *wheel = &CAR[i];
        const double vx = twist[0] - twist[2] * wheel->y, vy = twist[1] + twist[2] * wheel->x;
        const double wj = fabs(vx * cos(wheel->heading) + vy * sin(wheel->heading));
        const double wi = fabs(vx * sin(wheel->heading) - vy * cos(wheel->heading));
        const double r = wheel->friction * wheel->load, s = fmin(wheel->brake / wheel->radius, r),
                     c = sqrt(r * r - s * s);
        sum += r * wj <= s * hypot(wi, wj) ? r * hypot(wi, wj) : s * wj + c * wi;
    }
    return sum;
}

static void vehicle_law(void **state) {
    (void)state;
    static const double TWIST[][3] = {{1, 0, 0},     {0, 1, 0},    {0, 0, 1},
                                      {5, 0.3, 0.4}, {5, 0, -0.2}, {-1, 2, 3}};
    CpsPlanar *body = car_body();
    CpsSystem *system = NULL;
    CpsLaw *sum = NULL, *eliminated = NULL;
    CpsSetAnswer answer;
    const CpsEntry whole[3] = {{0, 0, 1}, {1, 1, 1}, {2, 2, 1}};
    assert_int_equal(cps_planar_law(body, CPS_PLANAR_INNER, 1, &sum, NULL), CPS_OK);
    assert_int_equal(cps_planar_system(body, CPS_PLANAR_INNER, 1, &system, NULL), CPS_OK);
    CHECK_INT(cps_system_parameter_count(system), 7);
    assert_int_equal(cps_system_set_drive(system, 3, 3, whole, NULL), CPS_OK);
    assert_int_equal(cps_system_eliminate(system, &eliminated, NULL, NULL, NULL), CPS_OK);
    for (size_t i = 0; i < sizeof TWIST / sizeof TWIST[0]; i++) {
        const double expected = car_by_hand(TWIST[i]);
        CHECK_RELATIVE(power(body, TWIST[i][0], TWIST[i][1], TWIST[i][2], NULL), expected, EXACT);
        /* wheel by wheel, then all spins at once: both by conic programs that promise 1e-9 */
        assert_int_equal(cps_set_dissipation(cps_law_set(sum), TWIST[i], NULL, &answer, NULL),
                         CPS_OK);
        CHECK_RELATIVE(answer.value, expected, 1e-9);
        assert_int_equal(cps_set_dissipation(cps_law_set(eliminated), TWIST[i], NULL, &answer,
                                             NULL),
                         CPS_OK);
        CHECK_RELATIVE(answer.value, expected, 1e-9);
    }

    /* the spins that were forgotten: by minimum dissipation, wheel for wheel */
    CpsMotion *motion = NULL;
    assert_int_equal(cps_system_solve(system, TWIST[3], NULL, &motion, NULL), CPS_OK);
    for (int k = 0; k < 4; k++) {
        CpsWheelMotion wheel;
        assert_int_equal(cps_planar_wheel(body, k, TWIST[3], &wheel, NULL), CPS_OK);
        /* the minimum is sharp in the spin where the wheel is held or at a corner; 1e-8 is the
         * promised gap */
        CHECK_NEAR(cps_motion_velocity(motion)[3 + k], wheel.spin, 1e-4);
        CHECK_NEAR(wheel.slip[1], wheel.velocity[1] + wheel.spin * CAR[k].radius, EXACT);
    }
    cps_motion_destroy(motion);
    cps_law_release(sum);
    cps_law_release(eliminated);
    cps_system_destroy(system);
    cps_planar_destroy(body);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ring),
        cmocka_unit_test(disc),
        cmocka_unit_test(disc_against_ellipsoid),
        cmocka_unit_test(rod),
        cmocka_unit_test(polygon),
        cmocka_unit_test(inner_and_outer_laws),
        cmocka_unit_test(driven_rod_disc_and_ring),
        cmocka_unit_test(driven_disc_by_cells),
        cmocka_unit_test(bipod_motions),
        cmocka_unit_test(bipod_forces),
        cmocka_unit_test(vehicle_law),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
