/* SPDX-License-Identifier: BSD-3-Clause */
/* Points and bodies with inertia: known answers, orders of the scheme, energy. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"
#include "splitmix.h"

static const double PI = 3.14159265358979323846;
/* Forces balance to 1e-11 of the largest one, 98 N, in each step: over 12 s the angular momentum of
 * 6 kg m2/s of a body on a line of 3 m may drift by 98 x 3 x 12/6 of that, 6e-9. */
static const double ROUNDING = 1e-9;

/* A scene of a few lines, points and one body. */
enum { LINES = 3, POINTS = 4, NODES = 64 };
typedef struct Rig {
    CpsScene scene;
    CpsLine line[LINES];
    CpsPoint point[POINTS];
    CpsBody body;
    CpsObstacle plane;
    CpsStage stage;
    CpsPointChange point_change;
    CpsBodyChange body_change;
    double node[LINES][3 * NODES];
} Rig;

static void begin(Rig *rig) {
    static const char *const LINE[] = {"one", "two", "three"}, *const POINT[] = {"a", "b", "c",
                                                                                 "d"};
    *rig = (Rig){.scene = cps_scene_default()};
    rig->scene.line = rig->line;
    rig->scene.point = rig->point;
    rig->scene.body = &rig->body;
    rig->scene.stage = &rig->stage;
    rig->scene.stage_count = 1;
    for (int i = 0; i < LINES; i++) {
        rig->line[i] = cps_line_default();
        rig->line[i].name = LINE[i];
        rig->line[i].quasi_static = true;
    }
    for (int i = 0; i < POINTS; i++) {
        rig->point[i] = cps_point_default();
        rig->point[i].name = POINT[i];
    }
    rig->body = cps_body_default();
    rig->body.name = "body";
    rig->stage = cps_stage_default();
    rig->stage.name = "time";
}

/* A straight line of `elements` from point a to point b, stretched evenly. */
static void tie(Rig *rig, int line, int a, int b, double length, int elements, double stiffness,
                const double from[3], const double to[3]) {
    CpsLine *of = &rig->line[line];
    of->length = length;
    of->element_count = elements;
    of->stiffness = stiffness;
    of->start.kind = CPS_START_NODES;
    of->start.point = rig->node[line];
    of->start.point_count = elements + 1;
    for (int j = 0; j <= elements; j++)
        for (int k = 0; k < 3; k++)
            rig->node[line][3 * j + k] = from[k] + (to[k] - from[k]) * j / elements;
    of->end[0].kind = of->end[1].kind = CPS_END_KIND_POINT;
    of->end_point[0] = a;
    of->end_point[1] = b;
}

static void place(CpsPoint *point, double x, double y, double z) {
    const double at[3] = {x, y, z};
    memcpy(point->position, at, sizeof at);
}

/* [J] Sums over the steps of a test. */
static struct Ledgers { double turnover, imbalance; } ledgers;

static CpsEvolution *open(Rig *rig, double duration, int steps) {
    CpsEvolution *evolution;
    CpsError err;
    rig->stage.duration = duration;
    rig->stage.step_count = steps;
    if (cps_evolution_create(&rig->scene, &evolution, &err)) fail_msg("%s", err.message);
    return evolution;
}

/* The ledger of the step closes, but for what those of quasi-static lines do not close by. What
 * moves freely turns nothing over: its kinetic energy counts as well. */
static void check_ledger(const CpsEvolution *evolution, const CpsLedger *ledger) {
    double size = fabs(ledger->ends) + fabs(ledger->obstacles) + fabs(ledger->elastic) +
                  fabs(ledger->gravity) + fabs(ledger->dissipated);
    for (int i = 0; i < cps_evolution_line_count(evolution); i++)
        size += cps_evolution_line_motion(evolution, i).ledger.turnover;
    for (int i = 0; i < cps_evolution_point_count(evolution); i++) {
        const CpsPointMotion motion = cps_evolution_point_motion(evolution, i);
        size += motion.ledger.turnover + motion.kinetic;
    }
    for (int i = 0; i < cps_evolution_body_count(evolution); i++) {
        const CpsBodyMotion motion = cps_evolution_body_motion(evolution, i);
        size += motion.ledger.turnover + motion.kinetic;
    }
    double imbalance = ledger->imbalance;
    for (int i = 0; i < cps_evolution_line_count(evolution); i++)
        if (!cps_evolution_line_motion(evolution, i).is_moving)
            imbalance -= cps_evolution_line_report(evolution, i).ledger.imbalance;
    ledgers.turnover += size;
    ledgers.imbalance += fabs(imbalance);
}

static void step(CpsEvolution *evolution) {
    CpsError err;
    if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
    const CpsStepReport report = cps_evolution_report(evolution);
    if (!cps_outcome_is_certified(report.outcome))
        fail_msg("step %d is not certified: outcome %d", report.step_count, (int)report.outcome);
    check_ledger(evolution, &report.ledger);
}

static double norm(const double *v) { return hypot(hypot(v[0], v[1]), v[2]); }

/* ---- points ---- */

/* A mass under an elastic line without weight: it swings with sqrt(k/m). */
static double mass_on_a_line(int steps) {
    Rig rig;
    const double k = 2000, m = 5, length = 10, weight = m * 9.81, periods = 2;
    const double frequency = sqrt(k / m), rise = 0.02;
    begin(&rig);
    rig.scene.line_count = 1;
    rig.scene.point_count = 2;
    rig.point[1].kind = CPS_POINT_KIND_FREE;
    rig.point[1].weight = weight;
    rig.point[1].inertia = m;
    rig.point[1].velocity[2] = rise * frequency;
    place(&rig.point[1], 0, 0, -length - weight / k);
    tie(&rig, 0, 0, 1, length, 1, k * length, rig.point[0].position, rig.point[1].position);
    CpsEvolution *evolution = open(&rig, periods * 2 * PI / frequency, steps);
    const double height = rig.point[1].position[2];
    double worst = 0;
    for (int i = 1; i <= steps; i++) {
        step(evolution);
        const CpsPointReport report = cps_evolution_point_report(evolution, 1);
        const double t = cps_evolution_time(evolution);
        worst = fmax(worst, fabs(report.position[2] - height - rise * sin(frequency * t)));
        CHECK_LESS(norm(report.residual), 1e-9 * weight);
    }
    cps_evolution_destroy(evolution);
    return worst / rise;
}

static void test_mass_on_a_line(void **state) {
    (void)state;
    double error[3];
    for (int i = 0; i < 3; i++) error[i] = mass_on_a_line(200 << i);
    printf("a mass on an elastic line, 2 periods: error %.3e %.3e %.3e of the amplitude with 100, "
           "200, 400 steps per period: order %.2f, %.2f\n",
           error[0], error[1], error[2], log2(error[0] / error[1]), log2(error[1] / error[2]));
    CHECK_LESS(fabs(log2(error[1] / error[2]) - 2), 0.1);
    CHECK_LESS(error[2], 5e-3);
}

/* A chain in one piece, or of two lines joined by a free point, in air or in water that flows, much
 * of which goes along. Returns the most trials of a step. */
enum { LINKS = 12 };
static int swing(bool joined, bool in_water, double out[][3], int steps, double clump) {
    static const CpsCurrentRow flow = {.velocity = {0.3, 0.5, 0}};
    static const CpsCurrent water = {.density = 1025, .row_count = 1, .row = &flow};
    static const CpsLineLoads loads = {
        .drag = {.diameter = 0.1, .normal = 1.2, .tangential = 0.1, .added_normal = 1}};
    int trials = 0;
    Rig rig;
    const double length = 6, mass = 2, stiffness = 4e4, drop = 0.3;
    const double a[3] = {0, 0, 0}, b[3] = {length * cos(drop), 0, -length * sin(drop)};
    begin(&rig);
    CpsPointWeight weight = {length / 2, 9.81 * clump, clump};
    rig.scene.line_count = joined ? 2 : 1;
    rig.scene.point_count = joined ? 3 : 2;
    place(&rig.point[1], b[0], b[1], b[2]);
    rig.point[1].kind = CPS_POINT_KIND_FREE;
    rig.point[1].inertia = 0.5;
    rig.point[1].weight = 0.5 * 9.81;
    if (joined) {
        double middle[3];
        for (int k = 0; k < 3; k++) middle[k] = 0.5 * (a[k] + b[k]);
        place(&rig.point[2], middle[0], middle[1], middle[2]);
        rig.point[2].kind = CPS_POINT_KIND_FREE;
        rig.point[2].inertia = clump;
        rig.point[2].weight = 9.81 * clump;
        tie(&rig, 0, 0, 2, length / 2, LINKS / 2, stiffness, a, middle);
        tie(&rig, 1, 2, 1, length / 2, LINKS / 2, stiffness, middle, b);
    } else {
        tie(&rig, 0, 0, 1, length, LINKS, stiffness, a, b);
        if (clump > 0) {
            rig.line[0].point_weight_count = 1;
            rig.line[0].point_weight = &weight;
        }
    }
    for (int i = 0; i < 2; i++) {
        rig.line[i].quasi_static = false;
        rig.line[i].weight = mass * 9.81;
        rig.line[i].inertia = mass;
        if (in_water) rig.line[i].loads = &loads;
    }
    if (in_water) rig.scene.current = &water;
    CpsEvolution *evolution = open(&rig, 1.2, steps);
    for (int i = 0; i < steps; i++) {
        step(evolution);
        const CpsPointReport end = cps_evolution_point_report(evolution, 1);
        trials = end.trial_count > trials ? end.trial_count : trials;
    }
    for (int line = 0, j = 0; line < rig.scene.line_count; line++) {
        const CpsLineView view = cps_evolution_line_view(evolution, line);
        for (int k = line; k <= view.element_count; k++, j++)
            memcpy(out[j], &view.position[3 * k], sizeof out[j]);
    }
    cps_evolution_destroy(evolution);
    return trials;
}

static void test_two_lines_are_one(void **state) {
    (void)state;
    static const double CLUMP[] = {0, 3, 0, 3};
    for (int c = 0; c < 4; c++) {
        double one[LINKS + 1][3], two[LINKS + 1][3], off = 0;
        swing(false, c > 1, one, 60, CLUMP[c]);
        const int trials = swing(true, c > 1, two, 60, CLUMP[c]);
        for (int j = 0; j <= LINKS; j++)
            for (int k = 0; k < 3; k++) off = fmax(off, fabs(one[j][k] - two[j][k]));
        printf(
            "a chain of 6 m, clump of %g kg, swings in %s, in one piece and of two joined lines: "
            "%.1e m apart after 60 steps, its end at (%.3f, %.3f, %.3f); up to %d trials a step\n",
            CLUMP[c], c > 1 ? "water" : "air", off, one[LINKS][0], one[LINKS][1], one[LINKS][2],
            trials);
        CHECK_LESS(off, 1e-9 * 6);
        /* by Newton's method; it took up to 77 without what the water adds to the stiffness */
        CHECK_LESS(trials, 8);
    }
}

/* ---- a falling clump ---- */

/* Drops onto the ground, on a slack line; returns how far it rises again, and raises `gain` to the
 * growth of its energy in a step. */
static double drop(double height, double h, double friction, double sideways, double *gain) {
    Rig rig;
    const double m = 40, length = 30;
    begin(&rig);
    rig.scene.line_count = 1;
    rig.scene.point_count = 2;
    rig.plane = cps_obstacle_default();
    rig.plane.name = "ground";
    rig.plane.friction = friction;
    rig.scene.obstacle = &rig.plane;
    rig.scene.obstacle_count = 1;
    place(&rig.point[0], 0, 0, 0);
    place(&rig.point[1], 20, 0, height);
    rig.point[1].kind = CPS_POINT_KIND_FREE;
    rig.point[1].weight = m * 9.81;
    rig.point[1].inertia = m;
    rig.point[1].velocity[0] = sideways;
    tie(&rig, 0, 0, 1, length, 10, 1e6, rig.point[0].position, rig.point[1].position);
    rig.line[0].weight = 0.5;
    const int steps = (int)((sqrt(2 * height / 9.81) + 0.4) / h);
    CpsEvolution *evolution = open(&rig, steps * h, steps);
    double lowest = height, rise = 0, energy = m * 9.81 * height + 0.5 * m * sideways * sideways;
    for (int i = 0; i < steps; i++) {
        step(evolution);
        const CpsPointReport report = cps_evolution_point_report(evolution, 1);
        const CpsPointMotion motion = cps_evolution_point_motion(evolution, 1);
        const double z = report.position[2], now = m * 9.81 * z + motion.kinetic;
        lowest = fmin(lowest, z);
        if (report.reaction > 0) rise = fmax(rise, z - lowest);
        rise = fmax(rise, lowest < 1e-9 ? z : 0);
        /* the line's weight, 15 N in all, pulls at it */
        const double pulled = 15 * 9.81 * h * h + 15 * h * norm(motion.velocity);
        *gain = fmax(*gain, (now - energy - pulled) / (m * 9.81 * height));
        energy = now;
    }
    CHECK_LESS(lowest, 1e-9);
    cps_evolution_destroy(evolution);
    return rise;
}

static void test_drops(void **state) {
    (void)state;
    static const double STEP[] = {0.01, 0.004};
    double rise = 0, gain = -INFINITY;
    int drops = 0;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 200; i++, drops++)
            rise = fmax(rise,
                        drop(0.05 + 0.013 * i, STEP[k], i % 2 ? 0.5 : 0, i % 3 ? 1.5 : 0, &gain));
    printf("%d drops of a clump from 0.05 to 2.6 m: it rises again by %.1e m at most, and its "
           "energy grows by %.1e of that of its height at most\n",
           drops, rise, gain);
    CHECK_LESS(rise, 1e-9);
    CHECK_LESS(gain, 1e-9);
}

/* ---- bodies ---- */

/* A body whose centre of gravity is at a line, which has no moment on it. */
static void hang_top(Rig *rig, double length, double stiffness) {
    begin(rig);
    rig->scene.line_count = 1;
    rig->scene.point_count = 2;
    rig->scene.body_count = 1;
    rig->point[1].kind = CPS_POINT_KIND_ON_BODY;
    rig->body.kind = CPS_BODY_KIND_FREE;
    rig->body.mass = 10;
    rig->body.weight = 98.1;
    const double to[3] = {0, 0, -length - 98.1 * length / stiffness};
    memcpy(rig->body.position, to, sizeof to);
    tie(rig, 0, 0, 1, length, 2, stiffness, rig->point[0].position, to);
}

/* The rotation of an asymmetric top without a moment after `end` seconds. */
static void spin(int steps, double end, const double rate[3], double rotation[4], double *momentum,
                 double *flip) {
    Rig rig;
    hang_top(&rig, 3, 1e5);
    const double j[6] = {1, 2, 2.6, 0, 0, 0};
    memcpy(rig.body.inertia, j, sizeof j);
    memcpy(&rig.body.velocity[3], rate, 3 * sizeof *rate);
    CpsEvolution *evolution = open(&rig, end, steps);
    const double l[3] = {j[0] * rate[0], j[1] * rate[1], j[2] * rate[2]};
    *momentum = 0;
    *flip = 1;
    for (int i = 0; i < steps; i++) {
        step(evolution);
        const CpsBodyMotion motion = cps_evolution_body_motion(evolution, 0);
        const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
        const double *q = report.rotation;
        double off[3];
        for (int k = 0; k < 3; k++) off[k] = motion.angular_momentum[k] - l[k];
        *momentum = fmax(*momentum, norm(off) / norm(l));
        /* the y axis of the body beside that of the scene */
        *flip = fmin(*flip, 1 - 2 * (q[1] * q[1] + q[3] * q[3]));
        memcpy(rotation, q, 4 * sizeof *q);
    }
    cps_evolution_destroy(evolution);
}

static void test_top(void **state) {
    (void)state;
    const double rate[3] = {1.2, 0.3, 0.8}, unstable[3] = {0.01, 3, 0};
    double q[4][4], momentum, flip, off[3];
    for (int i = 0; i < 4; i++) {
        spin(200 << i, 5, rate, q[i], &momentum, &flip);
        CHECK_LESS(momentum, ROUNDING);
    }
    for (int i = 0; i < 3; i++) {
        double dot = 0;
        for (int k = 0; k < 4; k++) dot += q[i][k] * q[i + 1][k];
        off[i] = 2 * acos(fmin(1, fabs(dot)));
    }
    printf("a top of 1, 2, 2.6 kg m2 without moment, 5 s: %.2e, %.2e, %.2e rad between 200, 400, "
           "800, 1600 steps: order %.2f, %.2f; its angular momentum stays to %.1e\n",
           off[0], off[1], off[2], log2(off[0] / off[1]), log2(off[1] / off[2]), momentum);
    CHECK_LESS(fabs(log2(off[1] / off[2]) - 2), 0.1);
    double q4[4];
    spin(2000, 12, unstable, q4, &momentum, &flip);
    printf("about its middle axis it flips: cosine of that axis with its direction down to %.4f; "
           "angular momentum stays to %.1e\n",
           flip, momentum);
    CHECK_LESS(flip, -0.9);
    CHECK_LESS(momentum, ROUNDING);
}

/* The same motion from another reference point, of a body that hangs off its centre of gravity. */
static void swing_body(const double off[3], double place[3], double rotation[4]) {
    Rig rig;
    hang_top(&rig, 2, 1e5);
    const double j[6] = {1, 2, 2.6, 0.1, 0, -0.05}, rate[3] = {0.4, -0.7, 0.5},
                 eye[3] = {0.1, 0, 0.3};
    memcpy(rig.body.inertia, j, sizeof j);
    memcpy(&rig.body.velocity[3], rate, sizeof rate);
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        rig.body.position[k] += off[k] - eye[k];
        rig.body.centre_of_gravity[k] = -off[k];
        rig.point[1].position[k] = eye[k] - off[k];
        rig.body.velocity[k] = rate[l] * off[m] - rate[m] * off[l]; /* of a centre at rest */
    }
    CpsEvolution *evolution = open(&rig, 2, 100);
    for (int i = 0; i < 100; i++) step(evolution);
    const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
    memcpy(rotation, report.rotation, 4 * sizeof *rotation);
    const double *q = rotation;
    for (int k = 0; k < 3; k++) { /* the centre of gravity: place - Q off */
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        double t[3];
        for (int a = 0; a < 3; a++)
            t[a] =
                2 * (q[1 + (a + 1) % 3] * off[(a + 2) % 3] - q[1 + (a + 2) % 3] * off[(a + 1) % 3]);
        place[k] = report.position[k] - (off[k] + q[0] * t[k] + q[1 + l] * t[m] - q[1 + m] * t[l]);
    }
    cps_evolution_destroy(evolution);
}

static void test_reference_point(void **state) {
    (void)state;
    static const double OFF[2][3] = {{0, 0, 0}, {1.5, -2, 0.7}};
    double place[2][3], rotation[2][4], apart = 0, turned = 0;
    for (int i = 0; i < 2; i++) swing_body(OFF[i], place[i], rotation[i]);
    for (int k = 0; k < 3; k++) apart = fmax(apart, fabs(place[0][k] - place[1][k]));
    for (int k = 0; k < 4; k++) turned = fmax(turned, fabs(rotation[0][k] - rotation[1][k]));
    printf("a body that swings off its centre of gravity for 2 s, from two reference points 2.6 m "
           "apart: %.1e m and %.1e apart, its rotation %.3f %.3f %.3f %.3f\n",
           apart, turned, rotation[0][0], rotation[0][1], rotation[0][2], rotation[0][3]);
    CHECK_LESS(apart, ROUNDING);
    CHECK_LESS(turned, ROUNDING);
    CHECK_LESS(fabs(rotation[0][0]), 0.99);
}

/* ---- one direction ---- */

/* A body that moves in one direction only, on a slack line without weight. */
static void guide(Rig *rig, int direction) {
    begin(rig);
    rig->scene.line_count = 1;
    rig->scene.point_count = 2;
    rig->scene.body_count = 1;
    rig->point[1].kind = CPS_POINT_KIND_ON_BODY;
    rig->body.kind = CPS_BODY_KIND_FREE;
    for (int i = 0; i < CPS_BODY_DIRECTIONS; i++) rig->body.fixed[i] = i != direction;
    const double to[3] = {0, 0, -3};
    memcpy(rig->body.position, to, sizeof to);
    tie(rig, 0, 0, 1, 20, 4, 1e5, rig->point[0].position, to);
}

/* A physical pendulum of a large amplitude: after 5 quarters of its period it hangs. */
static double pendulum(int steps, double amplitude) {
    Rig rig;
    const double mass = 7, arm = 1.3, own = 2.1, weight = mass * 9.81;
    const double frequency = sqrt(weight * arm / (own + mass * arm * arm));
    guide(&rig, 4);
    rig.body.mass = mass;
    rig.body.weight = weight;
    rig.body.inertia[0] = rig.body.inertia[1] = own;
    rig.body.inertia[2] = 0.5;
    rig.body.centre_of_gravity[2] = -arm;
    rig.body.rotation[0] = cos(amplitude / 2);
    rig.body.rotation[2] = sin(amplitude / 2);
    /* the quarter of the period is K(sin(amplitude/2))/w, by the arithmetic-geometric mean */
    double a = 1, b = cos(amplitude / 2);
    for (int i = 0; i < 8; i++) {
        const double mean = 0.5 * (a + b);
        b = sqrt(a * b);
        a = mean;
    }
    const double quarter = PI / (2 * a) / frequency;
    CpsEvolution *evolution = open(&rig, 5 * quarter, steps);
    for (int i = 0; i < steps; i++) step(evolution);
    const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
    cps_evolution_destroy(evolution);
    return fabs(2 * asin(report.rotation[2]));
}

static void test_pendulum(void **state) {
    (void)state;
    double error[3];
    for (int i = 0; i < 3; i++) error[i] = pendulum(1000 << i, 2);
    printf("a pendulum of amplitude 2 rad after 5 quarters of its period: %.3e %.3e %.3e rad off "
           "with 1000, 2000, 4000 steps: order %.2f, %.2f\n",
           error[0], error[1], error[2], log2(error[0] / error[1]), log2(error[1] / error[2]));
    CHECK_LESS(fabs(log2(error[1] / error[2]) - 2), 0.1);
    CHECK_LESS(error[2], 2e-4);
}

/* Free decay in heave (direction 2) or pitch (4), with added mass and linear damping. */
static double decay(int direction, int steps) {
    Rig rig;
    const double mass = 400, water = 150, c = 900, d = 120, start = 0.2, end = 12;
    guide(&rig, direction);
    rig.body.mass = direction == 2 ? mass : 1;
    for (int i = 0; i < 3; i++) rig.body.inertia[i] = direction == 4 ? mass : 1;
    rig.body.added_mass[7 * direction] = water;
    rig.body.hydrostatics[7 * direction] = c;
    rig.body.damping[7 * direction] = d;
    const double rate = d / (2 * (mass + water)), w = sqrt(c / (mass + water) - rate * rate);
    rig.body.velocity[direction] = start * w;
    CpsEvolution *evolution = open(&rig, end, steps);
    double worst = 0;
    for (int i = 0; i < steps; i++) {
        step(evolution);
        const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
        const double t = cps_evolution_time(evolution), exact = start * exp(-rate * t) * sin(w * t),
                     is = direction == 2 ? report.position[2] + 3 : 2 * asin(report.rotation[2]);
        worst = fmax(worst, fabs(is - exact));
    }
    cps_evolution_destroy(evolution);
    return worst / start;
}

static void test_decay(void **state) {
    (void)state;
    static const int DIRECTION[2] = {2, 4};
    for (int k = 0; k < 2; k++) {
        double error[3];
        for (int i = 0; i < 3; i++) error[i] = decay(DIRECTION[k], 200 << i);
        printf("free decay in %s: %.3e %.3e %.3e of the start off with 200, 400, 800 steps: order "
               "%.2f, %.2f\n",
               k ? "pitch" : "heave", error[0], error[1], error[2], log2(error[0] / error[1]),
               log2(error[1] / error[2]));
        CHECK_LESS(fabs(log2(error[1] / error[2]) - 2), 0.1);
        CHECK_LESS(error[2], 1e-3);
    }
}

/* Slowed by quadratic damping alone: v = v0/(1 + D v0 t/m), x = (m/D) log(1 + D v0 t/m). */
static double slow_down(int steps) {
    Rig rig;
    const double mass = 50, d = 40, start = 3, end = 6;
    guide(&rig, 0);
    rig.body.mass = mass;
    for (int i = 0; i < 3; i++) rig.body.inertia[i] = 1;
    rig.body.quadratic_damping[0] = d;
    rig.body.velocity[0] = start;
    CpsEvolution *evolution = open(&rig, end, steps);
    double lost = 0, scheme = 0;
    for (int i = 0; i < steps; i++) {
        step(evolution);
        const CpsBodyMotion motion = cps_evolution_body_motion(evolution, 0);
        lost += motion.dissipated;
        scheme += motion.ledger.scheme;
    }
    const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
    const CpsBodyMotion motion = cps_evolution_body_motion(evolution, 0);
    /* its whole energy is lost to damping and to the scheme */
    const double whole = 0.5 * mass * start * start;
    CHECK_NEAR(lost + scheme + motion.kinetic, whole, 1e-9 * whole);
    cps_evolution_destroy(evolution);
    return fabs(report.position[0] - mass / d * log(1 + d * start * end / mass));
}

static void test_quadratic(void **state) {
    (void)state;
    double error[3];
    for (int i = 0; i < 3; i++) error[i] = slow_down(400 << i);
    printf("a body slowed by quadratic damping: %.2e %.2e %.2e m off after %.1f m with 400, 800, "
           "1600 steps: order %.2f, %.2f\n",
           error[0], error[1], error[2], 50.0 / 40 * log(1 + 40.0 * 3 * 6 / 50),
           log2(error[0] / error[1]), log2(error[1] / error[2]));
    CHECK_LESS(fabs(log2(error[1] / error[2]) - 2), 0.15);
    CHECK_LESS(error[2], 1e-3);
}

/* Slowed by quadratic damping that couples heave and yaw. With u = s(t) (a, b), where a E_zz a +
 * E_zr b^2 = l m a and E_rz a^2 + E_rr b^2 = l j b, all of u falls by s' = -l s^2: the way is log(1
 * + l s t) (a, b)/l. */
static double slow_both(int steps, double *way) {
    Rig rig;
    const double mass = 50, own = 20, start = 1.5, end = 1, turn = 2;
    guide(&rig, 2);
    rig.body.fixed[5] = false;
    rig.body.mass = mass;
    for (int i = 0; i < 3; i++) rig.body.inertia[i] = own;
    double *e = rig.body.quadratic_damping; /* l = 1, a = 1, b = 2 */
    e[7 * 2] = 60;
    e[6 * 2 + 5] = -2.5;
    e[6 * 5 + 2] = -8;
    e[7 * 5] = 12;
    rig.body.velocity[2] = start;
    rig.body.velocity[5] = turn * start;
    CpsEvolution *evolution = open(&rig, end, steps);
    for (int i = 0; i < steps; i++) step(evolution);
    const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
    cps_evolution_destroy(evolution);
    *way = log(1 + start * end);
    return fmax(fabs(report.position[2] + 3 - *way),
                fabs(2 * asin(report.rotation[3]) - turn * *way));
}

static void test_coupled(void **state) {
    (void)state;
    double error[3], way = 0;
    for (int i = 0; i < 3; i++) error[i] = slow_both(200 << i, &way);
    printf("heave and yaw coupled by quadratic damping: %.2e %.2e %.2e off after %.3f m and %.3f "
           "rad with 200, 400, 800 steps: order %.2f, %.2f\n",
           error[0], error[1], error[2], way, 2 * way, log2(error[0] / error[1]),
           log2(error[1] / error[2]));
    CHECK_LESS(fabs(log2(error[1] / error[2]) - 2), 0.15);
    CHECK_LESS(error[2], 1e-4);
}

/* Is a matrix of quadratic damping accepted? */
static bool is_accepted(const double e[36]) {
    Rig rig;
    CpsError err = {0};
    guide(&rig, 0);
    rig.body.mass = 1;
    for (int i = 0; i < 3; i++) rig.body.inertia[i] = 1;
    memcpy(rig.body.quadratic_damping, e, sizeof rig.body.quadratic_damping);
    return cps_scene_check(&rig.scene, &err) == CPS_OK;
}

/* One coupling c beside the diagonal (p, q) takes energy in every motion up to c = (3 p)^(1/3) (3
 * q/2)^(2/3), where p a^3 + q b^3 - c a b^2 has the least value 0. */
static void test_bound_of_a_coupling(void **state) {
    (void)state;
    uint64_t dice = 7;
    for (int trial = 0; trial < 200; trial++) {
        double e[36] = {0};
        const int i = trial % 6, j = (i + 1 + trial / 6 % 5) % 6;
        const double p = pow(10, splitmix(&dice, -6, 6));
        const double q = pow(10, splitmix(&dice, -6, 6)), sign = trial % 4 < 2 ? 1 : -1;
        const double most = cbrt(3 * p) * pow(1.5 * q, 2.0 / 3);
        e[7 * i] = p;
        e[7 * j] = q;
        e[6 * i + j] = sign * 0.99 * most;
        CHECK_INT(is_accepted(e), true);
        e[6 * i + j] = sign * 1.01 * most;
        CHECK_INT(is_accepted(e), false);
        e[7 * i] = 0;
        CHECK_INT(is_accepted(e), false);
        e[6 * i + j] = 0;
        CHECK_INT(is_accepted(e), true);
        e[7 * i] = -p;
        CHECK_INT(is_accepted(e), false);
    }
}

/* No motion of many gains energy from a matrix that is accepted. */
static void test_accepted_couplings(void **state) {
    (void)state;
    enum { MATRICES = 400, MOTIONS = 2000 };
    uint64_t dice = 8;
    int accepted = 0;
    for (int trial = 0; trial < MATRICES; trial++) {
        double e[36], unit[6];
        const double coupling = splitmix(&dice, 0, 1.2);
        for (int i = 0; i < 6; i++) unit[i] = pow(10, splitmix(&dice, -2, 2));
        for (int i = 0; i < 36; i++) {
            const double size = unit[i / 6] * unit[i % 6] * unit[i % 6];
            e[i] =
                size * (i % 7 == 0 ? splitmix(&dice, 0.2, 2) : coupling * splitmix(&dice, -1, 1));
        }
        if (!is_accepted(e)) continue;
        accepted++;
        for (int k = 0; k < MOTIONS; k++) {
            double u[6], power = 0, size = 0;
            for (int i = 0; i < 6; i++) u[i] = splitmix(&dice, -1, 1) / unit[i];
            for (int i = 0; i < 36; i++) {
                const double one = e[i] * u[i / 6] * u[i % 6] * fabs(u[i % 6]);
                power += one;
                size += fabs(one);
            }
            CHECK_LESS(-power, 1e-12 * size);
        }
    }
    printf("quadratic damping: %d of %d matrices accepted, and no motion gains energy\n", accepted,
           MATRICES);
    CHECK_LESS(50, accepted);
    CHECK_LESS(accepted, MATRICES - 50);
}

/* Steps of another length are taken by the scheme of equal steps from their first one on. */
static void test_step_lengths(void **state) {
    (void)state;
    Rig rig;
    guide(&rig, 0);
    CpsStage stage[2] = {cps_stage_default(), cps_stage_default()};
    static const double LENGTH[2] = {1, 0.1};
    for (int i = 0; i < 2; i++) {
        stage[i].name = i ? "fine" : "coarse";
        stage[i].step_count = 10;
        stage[i].duration = 10 * LENGTH[i];
    }
    rig.body.mass = 3;
    for (int i = 0; i < 3; i++) rig.body.inertia[i] = 1;
    rig.body.velocity[0] = 0.5;
    rig.scene.stage = stage;
    rig.scene.stage_count = 2;
    CpsEvolution *evolution;
    CpsError err;
    if (cps_evolution_create(&rig.scene, &evolution, &err)) fail_msg("%s", err.message);
    for (int i = 0; i < 20; i++) step(evolution);
    const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
    CHECK_NEAR(report.position[0], 5.5, 1e-9);
    cps_evolution_destroy(evolution);
}

static int begin_ledgers(void **state) {
    (void)state;
    ledgers = (struct Ledgers){0, 0};
    return 0;
}

/* Forces balance to 1e-11 of the largest one, over ways of the size of the motion. */
static int close_ledgers(void **state) {
    (void)state;
    printf("imbalance of the ledger: %.1e of its turnover\n", ledgers.imbalance / ledgers.turnover);
    return !(ledgers.imbalance <= 1e-10 * ledgers.turnover);
}

/* Oscillations of what is not there, or does not change, are refused. */
static void test_absent_owners(void **state) {
    (void)state;
    static const int ABSENT[] = {-1, 99, INT_MAX, INT_MIN, 0};
    for (int k = 0; k < 5; k++)
        for (int of = CPS_SWAY_OF_END; of <= CPS_SWAY_OF_BODY + 1; of++)
            for (int changed = 0; changed < 2; changed++) {
                Rig rig;
                CpsError err = {0};
                CpsEvolution *evolution = NULL;
                CpsSway sway = {.of = (CpsSwayOf)of, .owner = ABSENT[k], .period = 1};
                CpsChange change = {.line = ABSENT[k], .to = {.kind = CPS_END_KIND_FREE}};
                if (ABSENT[k] == 0 && changed) continue; /* they are there */
                guide(&rig, 0);
                rig.body.mass = 3;
                for (int i = 0; i < 3; i++) rig.body.inertia[i] = 1;
                rig.point_change = (CpsPointChange){.point = ABSENT[k]};
                rig.body_change = (CpsBodyChange){.body = ABSENT[k]};
                rig.stage.sway_count = 1;
                rig.stage.sway = &sway;
                rig.stage.duration = 1;
                rig.stage.change = &change;
                rig.stage.point_change = &rig.point_change;
                rig.stage.body_change = &rig.body_change;
                rig.stage.change_count = changed && of == CPS_SWAY_OF_END;
                rig.stage.point_change_count = changed && of == CPS_SWAY_OF_POINT;
                rig.stage.body_change_count = changed && of == CPS_SWAY_OF_BODY;
                CHECK_INT(cps_evolution_create(&rig.scene, &evolution, &err), CPS_ERR_ARGUMENT);
                assert_null(evolution);
            }
}

/* A body is led along x and y, turned about z, and let go, free to move along y and z alone: it
 * stops along x and about z, and goes on along y; its centre of gravity is where that asks no
 * moment. */
static void test_let_go_in_fixed_directions(void **state) {
    (void)state;
    static Rig rig;
    enum { STEPS = 20 };
    CpsStage stage[2] = {cps_stage_default(), cps_stage_default()};
    CpsBodyChange change[2] = {{.kind = CPS_BODY_KIND_HELD,
                                .position = {1, 2, 0},
                                .rotation = {cos(0.2), 0, 0, sin(0.2)}},
                               {.kind = CPS_BODY_KIND_FREE}};
    begin(&rig);
    rig.scene.gravity[2] = 0;
    rig.scene.line_count = rig.scene.body_count = 1;
    rig.scene.point_count = 2;
    rig.body.mass = 3;
    for (int i = 0; i < 3; i++) rig.body.inertia[i] = 2;
    rig.body.fixed[0] = rig.body.fixed[3] = rig.body.fixed[4] = rig.body.fixed[5] = true;
    rig.point[1].kind = CPS_POINT_KIND_ON_BODY;
    place(&rig.point[0], 0, 0, 50);
    tie(&rig, 0, 0, 1, 49, 2, 1e-9, rig.point[0].position, rig.point[1].position);
    for (int k = 0; k < 2; k++) {
        stage[k].name = k ? "let go" : "led";
        stage[k].duration = 1;
        stage[k].step_count = STEPS;
        stage[k].body_change = &change[k];
        stage[k].body_change_count = 1;
    }
    rig.scene.stage = stage;
    rig.scene.stage_count = 2;
    CpsEvolution *evolution;
    CpsError err;
    if (cps_evolution_create(&rig.scene, &evolution, &err)) fail_msg("%s", err.message);
    for (int i = 0; i < 2 * STEPS; i++) {
        step(evolution);
        if (i < STEPS) continue;
        const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
        const CpsBodyMotion motion = cps_evolution_body_motion(evolution, 0);
        CHECK_NEAR(report.position[0], 1, 0);
        CHECK_NEAR(report.position[1], 2 + 2.0 * (i + 1 - STEPS) / STEPS, 1e-9);
        CHECK_NEAR(report.rotation[3], sin(0.2), 1e-15);
        CHECK_NEAR(motion.velocity[0], 0, 0);
        CHECK_NEAR(motion.velocity[1], 2, 1e-9);
        if (i > STEPS) CHECK_NEAR(report.support[0], 0, 1e-9); /* N */
    }
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_mass_on_a_line, begin_ledgers, close_ledgers),
        cmocka_unit_test_setup_teardown(test_two_lines_are_one, begin_ledgers, close_ledgers),
        cmocka_unit_test_setup_teardown(test_drops, begin_ledgers, close_ledgers),
        cmocka_unit_test_setup_teardown(test_top, begin_ledgers, close_ledgers),
        cmocka_unit_test_setup_teardown(test_reference_point, begin_ledgers, close_ledgers),
        cmocka_unit_test_setup_teardown(test_pendulum, begin_ledgers, close_ledgers),
        cmocka_unit_test_setup_teardown(test_decay, begin_ledgers, close_ledgers),
        cmocka_unit_test_setup_teardown(test_quadratic, begin_ledgers, close_ledgers),
        cmocka_unit_test_setup_teardown(test_coupled, begin_ledgers, close_ledgers),
        cmocka_unit_test(test_bound_of_a_coupling),
        cmocka_unit_test(test_accepted_couplings),
        cmocka_unit_test_setup_teardown(test_step_lengths, begin_ledgers, close_ledgers),
        cmocka_unit_test_setup_teardown(test_let_go_in_fixed_directions, begin_ledgers,
                                        close_ledgers),
        cmocka_unit_test(test_absent_owners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
