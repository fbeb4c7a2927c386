/* SPDX-License-Identifier: BSD-3-Clause */
/* Motions of driven systems: flat laws along free directions, loads at the limit, weak laws beside
 * strong ones. */
#include <math.h>
#include <stdbool.h>

#include "capstan/drive.h"
#include "extreme_case.h"

/* ---- flat laws along free directions ---- */

/* Parameters (x, y, z): a segment of forces from -e to 2 e on U = (x, y, z), x driven, z held at 0
 * or free. Its forces do work on what is free unless those components of e are 0. */
void try_flat(void) {
    double e[3] = {1 + below(3)};
    for (int a = 1; a < 3; a++) e[a] = below(2) ? digit(2) : 0;
    const double size = pow(10, digit(3));
    const bool held = below(2) == 0;
    double ends[6];
    for (int i = 0; i < 3; i++) {
        ends[i] = -size * e[i];
        ends[3 + i] = 2 * size * e[i];
    }
    CpsSet *segment = NULL, *forces = NULL;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    need(cps_set_segment(3, ends, ends + 3, &segment, &err), "segment");
    CpsLaw *law = law_of(segment);
    need(cps_system_create(3, &system, &err), "system");
    need(cps_system_add_friction(system, "flat", law, 3,
                                 (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}, {2, 2, 1}}, &err),
         "add");
    if (held)
        need(cps_system_add_constraints(system, 1, 1, (const CpsEntry[]){{0, 2, 1}}, &err),
             "constraint");
    need(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 0, 1}}, &err), "drive");
    const double w = digit(3), works = e[1] == 0 && (held || e[2] == 0), power = -size * e[0] * w;
    const double gamma = works != 0 ? fmax(-power, 2 * power) : 0, allowed = 1e-7 * size * 10;
    need(cps_system_solve(system, &w, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    same("outcome", report.outcome, CPS_MOTION_OUTCOME_SOLVED);
    near("gamma", report.value, gamma, allowed);
    if (!(report.lower <= gamma + allowed)) fail("lower bound", report.lower, gamma);
    need(cps_system_eliminate(system, NULL, &forces, NULL, &err), "eliminate");
    CpsSetAnswer phi;
    need(cps_set_support(forces, (const double[]){-w}, NULL, &phi, &err), "support");
    near("gamma of the reduced law", phi.value, gamma, allowed);
    cps_set_release(forces);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(law);
}

/* ---- loads at the limit ---- */

/* A block with friction r (disc) or a in x, b in y (box), driven along x with w under the load f L
 * along y, L what friction holds: disc: gamma = r |w| sqrt(1 - f^2), at f = 1 not attained unless w
 * = 0; box: gamma = a |w|, at f = 1 attained; beyond: none. */
void try_limit(void) {
    static const int TEN[] = {0, 1, 3, 5, 7, 9, 11};
    const bool round = below(2) == 0;
    const int side = digit(1), power = TEN[below(7)];
    const double tens = pow(10, digit(2)), r = tens * (1 + below(5)), a = r * (1 + below(3)),
                 w = digit(2);
    const double factor = 1 + side * pow(10, -power) * (side < 0 ? 0.9 : 1);
    double u[2];
    CpsSet *set = NULL;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    unit_vector(2, u); /* the block's axes */
    if (round)
        need(cps_set_ball(2, NULL, r, &set, &err), "disc");
    else
        need(cps_set_box(2, (double[]){-a, -r}, (double[]){a, r}, &set, &err), "box");
    CpsLaw *law = law_of(set);
    need(cps_system_create(2, &system, &err), "system");
    const CpsEntry map[] = {{0, 0, u[0]}, {0, 1, u[1]}, {1, 0, -u[1]}, {1, 1, u[0]}};
    need(cps_system_add_friction(system, "table", law, 4, map, &err), "add");
    need(cps_system_set_drive(system, 1, 2, (const CpsEntry[]){{0, 0, u[0]}, {0, 1, u[1]}}, &err),
         "drive");
    need(cps_system_set_load(system, (double[]){-u[1] * factor * r, u[0] * factor * r}, &err),
         "load");
    need(cps_system_solve(system, &w, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    const bool beyond = side > 0, at = side == 0, attained = !round || w == 0;
    const double gamma = beyond  ? -INFINITY
                         : round ? r * fabs(w) * sqrt(fmax(0, 1 - factor * factor))
                                 : a * fabs(w);
    if (beyond)
        same("beyond the limit", report.outcome, CPS_MOTION_OUTCOME_NO_BALANCE);
    else if (at && !attained)
        same("at the limit", report.outcome, CPS_MOTION_OUTCOME_NOT_ATTAINED);
    else if (report.outcome != CPS_MOTION_OUTCOME_SOLVED &&
             report.outcome != CPS_MOTION_OUTCOME_LIMIT_LOAD &&
             !(round && power >= 9 &&
               report.outcome == CPS_MOTION_OUTCOME_NOT_ATTAINED)) /* V = w tan: 3e4 w and more */
        fail("below the limit", report.outcome, CPS_MOTION_OUTCOME_SOLVED);
    if (beyond)
        same("no gamma", isinf(report.value) && report.value < 0, 1);
    else {
        /* near the limit the force is known along the disc to the root of its rounding */
        near("gamma", report.value, gamma, 1e-6 * a * fmax(1, fabs(w)));
        if (!(report.lower <= gamma + 1e-9 * a)) fail("lower bound", report.lower, gamma);
    }
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(law);
}

/* ---- weak laws beside strong ones, drives that hardly move ---- */

typedef struct Wheel {
    double ground, brake, w[2]; /* f N, b; the radius is 1/2, so that b = f N/2 is exact */
} Wheel;

static Wheel draw_wheel(void) {
    static const double BETA[] = {1, 1, 0.6, 0.8, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e3, 1e6};
    const int first = 1 + below(5);
    const double ground = first * pow(10, digit(9)), speed = pow(10, digit(6));
    Wheel wheel = {ground, 0.5 * ground * BETA[below(11)], {0, 0}};
    for (int i = 0; i < 2; i++) {
        wheel.w[i] = digit(3) * speed;
        if (!below(2)) wheel.w[i] *= pow(10, -below(13));
    }
    return wheel;
}

/* omega, V by least dissipation: with beta = 2 b/(f N), s = sign(Wj) min(|Wj|, |Wi| beta/sqrt(1 -
 * beta^2)), V = (Wi, s), omega = 2 (s - Wj). */
static void wheel_motion(const Wheel *wheel, double *v) {
    const double beta = 2 * wheel->brake / wheel->ground;
    double s = fabs(wheel->w[1]);
    if (beta < 1) s = fmin(s, fabs(wheel->w[0]) * beta / sqrt((1 - beta) * (1 + beta)));
    s = copysign(s, wheel->w[1]);
    v[0] = 2 * (s - wheel->w[1]);
    v[1] = wheel->w[0];
    v[2] = s;
}

/* A claim of the sets of all motions, or of all forces: the expected one belongs to it; and is the
 * one found, where that is said to be the only one. */
static void belongs(const char *what, const CpsSolutionSet *all, int n, const double *expected,
                    const double *low, const double *high, const double *allowed) {
    if (all->outcome == CPS_SET_OUTCOME_ANSWERED)
        for (int i = 0; i < n; i++)
            if (!(low[i] - allowed[i] <= expected[i] && expected[i] <= high[i] + allowed[i]))
                fail(what, low[i], expected[i]);
}

void try_wheel(void) {
    const Wheel wheel = draw_wheel();
    double v[3], low[3], high[3];
    CpsSet *set[2] = {NULL, NULL};
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    CpsSolutionSet all;
    need(cps_set_interval(-wheel.brake, wheel.brake, &set[0], &err), "interval");
    need(cps_set_ball(2, NULL, wheel.ground, &set[1], &err), "disc");
    CpsLaw *brake = law_of(set[0]), *ground = law_of(set[1]);
    need(cps_system_create(3, &system, &err), "system");
    need(cps_system_add_friction(system, "brake", brake, 1, (const CpsEntry[]){{0, 0, 1}}, &err),
         "add");
    need(cps_system_add_friction(system, "ground", ground, 2,
                                 (const CpsEntry[]){{0, 1, 1}, {1, 2, 1}}, &err),
         "add");
    need(cps_system_set_drive(system, 2, 3, (const CpsEntry[]){{0, 1, 1}, {1, 2, 1}, {1, 0, -0.5}},
                              &err),
         "drive");
    need(cps_system_solve(system, wheel.w, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    wheel_motion(&wheel, v);
    const double speed = fmax(fabs(wheel.w[0]), fabs(wheel.w[1])), length = hypot(v[1], v[2]);
    const double gamma = wheel.ground * length + wheel.brake * fabs(v[0]),
                 power = wheel.ground * speed;
    same("outcome", report.outcome, CPS_MOTION_OUTCOME_SOLVED);
    /* the promise is 1e-8 of the power scale, in which a strong brake that does not slip has a
     * part */
    near("gamma", report.value, gamma, 1e-9 * power);
    if (!(report.lower <= gamma * (1 + 1e-12) && gamma * (1 - 1e-12) <= report.upper))
        fail("bounds", report.lower, gamma);
    need(cps_motion_velocities(motion, 0, &all, low, high, &err), "velocities");
    belongs("velocities", &all, 3, v, low, high,
            (const double[]){4e-5 * speed, 1e-5 * speed, 1e-5 * speed});
    cps_solution_set_clear(&all);
    /* one pair of forces, by the motion: where the ground slips it tells all; where the wheel rolls
     * straight on, the brake does */
    double force[3] = {0, 0, 0};
    bool known = length > 0;
    if (known)
        for (int i = 0; i < 2; i++) force[1 + i] = -wheel.ground * v[1 + i] / length;
    if (!known && v[0] != 0) {
        force[0] = -copysign(wheel.brake, v[0]);
        force[2] = -2 * force[0];
    } else {
        force[0] = v[0] != 0 ? -copysign(wheel.brake, v[0]) : -0.5 * force[2];
    }
    need(cps_motion_forces(motion, 0, &all, low, high, &err), "forces");
    /* the tolerance of these sets is 1e-6 of the largest force, and a set may have been moved by
     * that */
    const double allowed = 2e-6 * fmax(wheel.ground, wheel.brake);
    belongs("forces", &all, 3, force, low, high, (const double[]){allowed, allowed, allowed});
    cps_solution_set_clear(&all);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(brake);
    cps_law_release(ground);
}
