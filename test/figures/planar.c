/* SPDX-License-Identifier: BSD-3-Clause */
/* The numbers of docs/planar.md: a name and its numbers on each line, for scripts/figures.
 *
 * test_planar and test_planar_paths check that they are right; here they are printed as the library
 * returns them. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "capstan/planar.h"

static const double PI = 3.14159265358979323846;

static void need(CpsStatus status, const CpsError *err) {
    if (status == CPS_OK) return;
    fprintf(stderr, "planar figures: %s\n", err->message);
    exit(1);
}

static void say(const char *name, int count, ...) {
    va_list numbers;
    va_start(numbers, count);
    printf("%s", name);
    for (int i = 0; i < count; i++) printf(" %.17g", va_arg(numbers, double));
    printf("\n");
    va_end(numbers);
}

static CpsPlanar *body_of(int count, const CpsPatch *patch) {
    CpsPlanar *body = NULL;
    CpsError err;
    need(cps_planar_create(count, patch, &body, &err), &err);
    return body;
}

/* Unit friction force and unit size at the origin. */
static CpsPlanar *unit_body(CpsPatchKind kind) {
    static const double SQUARE[8] = {-0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, 0.5};
    const bool polygon = kind == CPS_PATCH_POLYGON;
    return body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                  .kind = kind,
                                  .friction = 1,
                                  .load = 1,
                                  .size = polygon ? 0 : 1,
                                  .corner_count = polygon ? 4 : 0,
                                  .corner = polygon ? SQUARE : NULL});
}

static double power(const CpsPlanar *body, double vx, double vy, double w, double wrench[3]) {
    CpsSetAnswer answer;
    CpsError err;
    need(cps_planar_dissipation(body, (double[3]){vx, vy, w}, wrench, NULL, &answer, &err), &err);
    return answer.value;
}

/* ---- limit surfaces ---- */

static void bounds(void) {
    static const double E[3] = {0.25, 1, 3};
    CpsPlanar *body = unit_body(CPS_PATCH_DISC);
    for (int k = 0; k < 3; k++) {
        CpsPlanarBounds found;
        CpsError err;
        need(cps_planar_bounds(body, (double[3]){E[k], 0, 1}, 0, &found, &err), &err);
        const double value = power(body, E[k], 0, 1, NULL);
        say("bounds", 5, E[k], (double)found.cell_count, found.lower - value, found.upper - value,
            value);
    }
    cps_planar_destroy(body);
}

/* How far laws of the disc inside and outside are apart, as a share of their dissipation, times the
 * cells. */
static void inner_and_outer(void) {
    CpsPlanar *body = unit_body(CPS_PATCH_DISC);
    for (int cells = 400; cells <= 1600; cells *= 4) {
        double end[2];
        for (int side = 0; side < 2; side++) {
            CpsLaw *law = NULL;
            CpsSetAnswer answer;
            CpsError err;
            need(cps_planar_law(body, side ? CPS_PLANAR_OUTER : CPS_PLANAR_INNER, cells, &law,
                                &err),
                 &err);
            need(cps_set_dissipation(cps_law_set(law), (const double[]){0.3, 0.2, 1}, NULL, &answer,
                                     &err),
                 &err);
            end[side] = answer.value;
            cps_law_release(law);
        }
        say("cells", 2, (double)cells, (end[1] - end[0]) / end[0] * cells);
    }
    cps_planar_destroy(body);
}

static void values(void) {
    static const double E[4] = {0.25, 0.5, 1.5, 3};
    CpsPlanar *ring = unit_body(CPS_PATCH_RING), *disc = unit_body(CPS_PATCH_DISC),
              *rod = unit_body(CPS_PATCH_ROD);
    CpsPlanar *square = unit_body(CPS_PATCH_POLYGON);
    say("ring", 2, power(ring, 1, 0, 0.5, NULL), power(ring, 1, 0, 1, NULL));
    say("rod", 1, power(rod, 1, 0.5, 0.7, NULL));
    say("square", 1, power(square, 0, 0, 1, NULL));
    double wrench[3];
    for (int k = 0; k < 4; k++) {
        power(disc, E[k], 0, 1, wrench);
        say("disc", 3, E[k], -wrench[0], -wrench[2]);
    }
    power(disc, 1, 0, 1, wrench);
    say("disc", 3, 1.0, -wrench[0], -wrench[2]);
    cps_planar_destroy(ring);
    cps_planar_destroy(disc);
    cps_planar_destroy(rod);
    cps_planar_destroy(square);
}

/* Along the ray from the centre, where does the exact surface lie in the ellipsoid (1, 1, 2/3) of
 * robotics codes? */
static void ellipsoid(void) {
    CpsPlanar *body = unit_body(CPS_PATCH_DISC);
    double wrench[3], least = 2, where = 0;
    for (int i = 1; i < 4000; i++) {
        power(body, 0.001 * i, 0, 1, wrench);
        const double part = hypot(wrench[0], 1.5 * wrench[2]);
        if (part >= least) continue;
        least = part;
        where = 0.001 * i;
    }
    say("ellipsoid", 2, least, where);
    cps_planar_destroy(body);
}

/* ---- driven bodies ---- */

static void driven(const char *name, CpsPatchKind kind) {
    CpsPlanar *body = unit_body(kind);
    CpsPlanarMotion motion;
    CpsError err;
    need(cps_planar_drive(body, 2, (const double[]){1, 0, 0, 0, 1, 1}, (const double[]){0, 1},
                          &motion, &err),
         &err);
    say(name, 4, motion.twist[2], motion.lower, motion.upper, motion.centre[0]);
    cps_planar_destroy(body);
}

/* gamma of laws of 400 cells inside and outside, by the conic solver of drive.h */
static void driven_by_cells(void) {
    CpsPlanar *body = unit_body(CPS_PATCH_DISC);
    double gamma[2];
    for (int side = 0; side < 2; side++) {
        static const CpsEntry RIM[3] = {{0, 0, 1}, {1, 1, 1}, {1, 2, 1}};
        CpsSystem *system = NULL;
        CpsMotion *motion = NULL;
        CpsError err;
        need(cps_planar_system(body, side ? CPS_PLANAR_OUTER : CPS_PLANAR_INNER, 400, &system,
                               &err),
             &err);
        need(cps_system_set_drive(system, 2, 3, RIM, &err), &err);
        need(cps_system_solve(system, (const double[]){0, 1}, NULL, &motion, &err), &err);
        gamma[side] = side ? cps_motion_report(motion).upper : cps_motion_report(motion).lower;
        cps_motion_destroy(motion);
        cps_system_destroy(system);
    }
    say("driven-by-cells", 2, gamma[0], gamma[1]);
    cps_planar_destroy(body);
}

/* ---- along paths ---- */

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

/* A car drawn by its nose along an arc of 15 m, 30 m in all. */
static void towed_car(void) {
    const CpsPatch wheels[4] = {wheel(0, 0.75, 0, 4000, 100), wheel(0, -0.75, 0, 4000, 100),
                                wheel(2.5, 0.75, 0.2, 5000, 300),
                                wheel(2.5, -0.75, 0.2, 5000, 300)};
    CpsPlanar *body = body_of(4, wheels);
    for (int steps = 200; steps <= 1600; steps *= 2) {
        CpsTow tow = {.cookie = cps_tow_default().cookie, .hitch = {3.2, 0}};
        CpsTowStep step;
        CpsError err;
        for (int i = 1; i <= steps; i++) {
            const double a = 2.0 * i / steps;
            need(cps_planar_tow(body, &tow, (double[]){3.2 + 15 * sin(a), 15 * (1 - cos(a))}, &step,
                                &err),
                 &err);
        }
        say("car", 4, (double)steps, hypot(step.twist[0], step.twist[1]) / fabs(step.twist[2]),
            tow.dissipated, tow.work - tow.dissipated);
    }
    cps_planar_destroy(body);
}

/* An axle of free wheels 2 m behind a hitch that goes 4 m across: the tractrix. */
static void axle(void) {
    CpsPlanar *body =
        body_of(2, (CpsPatch[]){wheel(0, 0.75, 0, 4000, 0), wheel(0, -0.75, 0, 4000, 0)});
    for (int steps = 100; steps <= 400; steps *= 2) {
        CpsTow tow = {.cookie = cps_tow_default().cookie, .pose = {2, 0, PI}, .hitch = {2, 0}};
        CpsTowStep step;
        CpsError err;
        for (int i = 1; i <= steps; i++)
            need(cps_planar_tow(body, &tow, (double[]){0, 4.0 * i / steps}, &step, &err), &err);
        say("axle", 2, (double)steps,
            hypot(tow.pose[0] - 2 / cosh(2), tow.pose[1] - (4 - 2 * tanh(2))));
    }
    cps_planar_destroy(body);
}

static void block_on_a_spring(void) {
    CpsLaw *law = NULL;
    CpsError err;
    need(cps_law_coulomb(0.5, 2, &law, &err), &err);
    for (int steps = 1000; steps <= 4000; steps *= 2) {
        CpsSweep sweep = {.cookie = cps_sweep_default().cookie, .stiffness = 1, .position = {1, 0}};
        CpsSweepStep step;
        for (int i = 1; i <= steps; i++)
            need(cps_sweep_step(law, &sweep, (double[]){0, 2.0 * i / steps}, &step, &err), &err);
        say("spring", 2, (double)steps,
            hypot(sweep.position[0] - 1 / cosh(2), sweep.position[1] - 2 + tanh(2)));
    }
    cps_law_release(law);
}

static void planimeter(const char *name, double x, double radius, double y) {
    const CpsPlanimeter arms = {.cookie = cps_planimeter_default().cookie,
                                .pole_arm = 1,
                                .tracer_arm = 1.3,
                                .wheel = 0.4,
                                .friction = 0.3,
                                .load = 2};
    static const int POINTS[3] = {1000, 4000, 256000};
    for (int k = 0; k < 3; k++) {
        const int count = POINTS[k];
        double *point = malloc(2 * (size_t)count * sizeof *point);
        if (!point) exit(1);
        for (int i = 0; i < count; i++) {
            point[2 * i] = x + radius * cos(2 * PI * i / count);
            point[2 * i + 1] = y + radius * sin(2 * PI * i / count);
        }
        CpsPlanimeterReading reading;
        CpsError err;
        need(cps_planimeter_trace(&arms, count, point, 1, &reading, &err), &err);
        say(name, 3, (double)count, reading.area, reading.area - PI * radius * radius);
        free(point);
    }
}

int main(void) {
    bounds();
    inner_and_outer();
    values();
    ellipsoid();
    driven("driven-rod", CPS_PATCH_ROD);
    driven("driven-disc", CPS_PATCH_DISC);
    driven("driven-ring", CPS_PATCH_RING);
    driven_by_cells();
    towed_car();
    axle();
    block_on_a_spring();
    planimeter("planimeter-outside", 1.2, 0.5, 0.3);
    planimeter("planimeter-inside", 0.1, 1.2, 0);
    return 0;
}
