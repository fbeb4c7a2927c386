/* SPDX-License-Identifier: BSD-3-Clause */
/* Drag and added mass of lines that move in time, by known answers: sinking to the terminal
 * velocity, a rope that glides, carried by a current, a pendulum in water, statics as the limit.
 * Each figure is printed. */
#include <stdio.h>
#include <string.h>

#include "time_rig.h"

static const double PI = 3.14159265358979323846;

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ---- a straight rope with free ends ---- */

/* A rope in water: per metre its mass and weight, its direction, the water. */
typedef struct Glider {
    double mass, weight, density, direction[3], water[3];
    CpsDrag drag;
} Glider;

/* The acceleration of all of the rope at the velocity v: its forces are the same everywhere. Mass
 * with that of the water across and along, each by itself. */
static void acceleration(const Glider *g, const double *v, double *out) {
    const double *t = g->direction, half = g->density * g->drag.diameter / 2,
                 moved = g->density * PI / 4 * g->drag.diameter * g->drag.diameter;
    double w[3], across[3], force[3];
    for (int a = 0; a < 3; a++) w[a] = g->water[a] - v[a];
    const double along = dot(w, t);
    for (int a = 0; a < 3; a++) across[a] = w[a] - along * t[a];
    const double fast = sqrt(dot(across, across));
    for (int a = 0; a < 3; a++)
        force[a] = (a == 2 ? -g->weight : 0) + half * g->drag.normal * fast * across[a] +
                   half * PI * g->drag.tangential * fabs(along) * along * t[a];
    const double push = dot(force, t);
    for (int a = 0; a < 3; a++)
        out[a] = (force[a] - push * t[a]) / (g->mass + moved * g->drag.added_normal) +
                 push * t[a] / (g->mass + moved * g->drag.added_tangential);
}

/* Where such a rope has gone from rest, by the Runge-Kutta method of fourth order. */
static void glide(const Glider *g, double time, double *way, double *v) {
    const int steps = 20000;
    const double h = time / steps;
    memset(way, 0, 3 * sizeof *way);
    memset(v, 0, 3 * sizeof *v);
    for (int i = 0; i < steps; i++) {
        double k[4][3], at[4][3];
        for (int s = 0; s < 4; s++) {
            const double by = s == 0 ? 0 : s < 3 ? h / 2 : h;
            for (int a = 0; a < 3; a++) at[s][a] = v[a] + (s ? by * k[s - 1][a] : 0);
            acceleration(g, at[s], k[s]);
        }
        for (int a = 0; a < 3; a++) {
            way[a] += h / 6 * (at[0][a] + 2 * at[1][a] + 2 * at[2][a] + at[3][a]);
            v[a] += h / 6 * (k[0][a] + 2 * k[1][a] + 2 * k[2][a] + k[3][a]);
        }
    }
}

/* The error of the place of the middle after `time`, in `steps`. */
static double glide_error(const Glider *g, CpsTimeScheme scheme, double time, int steps,
                          const char *name, double *last) {
    enum { ELEMENTS = 6 };
    TimeRig rig;
    const double length = 3;
    time_begin(&rig, length, ELEMENTS, g->mass, 1e6);
    rig.line.weight = g->weight;
    rig.scene.time_scheme = scheme;
    rig.line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    time_water(&rig, g->density, g->water, g->drag);
    for (int j = 0; j <= ELEMENTS; j++) {
        const double s = length * j / ELEMENTS;
        time_node(&rig, j, s * g->direction[0], s * g->direction[1], s * g->direction[2]);
    }
    time_stage(&rig, time, steps);
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    double way[3], off = 0;
    glide(g, time, way, last);
    for (int j = 0; j <= ELEMENTS; j++)
        for (int a = 0; a < 3; a++)
            off = fmax(off, fabs(run.view.position[3 * j + a] - rig.point[3 * j + a] - way[a]));
    double slower = 0;
    for (int a = 0; a < 3; a++)
        slower = fmax(slower, fabs(run.motion.velocity[3 * 3 + a] - last[a]));
    printf("%-26s %5d steps: place off by %.3e m, velocity by %.3e m/s; work on drag %.6g J, on "
           "the water that goes along %.6g J\n",
           name, steps, off, slower, run.drag, run.added);
    if (dot(g->water, g->water) == 0) CHECK_GREATER(run.drag, 0);
    time_close(&run, name);
    return off;
}

static void orders(const Glider *g, const char *name) {
    double v[3];
    for (int scheme = 0; scheme < 2; scheme++) {
        double error[4];
        for (int k = 0; k < 4; k++)
            error[k] = glide_error(g, (CpsTimeScheme)scheme, 1.5, 80 << k, name, v);
        const double order = log2(error[2] / error[3]);
        time_report(name, scheme ? "order of Euler" : "order of BDF2", scheme ? 1 : 2, order);
        CHECK_NEAR(order, scheme ? 1 : 2, 0.1);
        if (!scheme) CHECK_LESS(error[3], 2e-4);
    }
}

static void a_rope_sinks_to_its_terminal_velocity(void **state) {
    (void)state;
    Glider g = {.mass = 0.9,
                .weight = 5,
                .density = 1025,
                .direction = {1, 0, 0},
                .drag = {.diameter = 0.03, .normal = 1.2, .tangential = 0.05, .added_normal = 1}};
    double v[3];
    const double across = sqrt(5 / (1025 * 0.03 * 1.2 / 2)),
                 along = sqrt(5 / (1025 * 0.03 * PI * 0.05 / 2));
    (void)glide_error(&g, CPS_TIME_SCHEME_BDF2, 4, 400, "broadside", v);
    CHECK_NEAR(time_report("broadside", "terminal velocity [m/s]", -across, v[2]), 0, 1e-9);
    orders(&g, "broadside");
    const double down[3] = {0, 0, -1};
    memcpy(g.direction, down, sizeof down);
    (void)glide_error(&g, CPS_TIME_SCHEME_BDF2, 12, 1200, "upright", v);
    CHECK_NEAR(time_report("upright", "terminal velocity [m/s]", -along, v[2]), 0, 1e-4);
    orders(&g, "upright");
}

static void an_inclined_rope_glides_in_a_current(void **state) {
    (void)state;
    const Glider g = {.mass = 1.1,
                      .weight = 6,
                      .density = 1000,
                      .direction = {0.48, 0.64, -0.6},
                      .water = {0.4, -0.3, 0.1},
                      .drag = {.diameter = 0.025,
                               .normal = 1.6,
                               .tangential = 0.4,
                               .added_normal = 1,
                               .added_tangential = 0.3}};
    orders(&g, "inclined, in a current");
}

/* ---- a pendulum in water ---- */

/* (m + a) L theta'' = -m g sin theta - c |L theta'| L theta', m, a and c of half an element. */
static double pendulum_angle(double angle, double pull, double brake, double time) {
    const int steps = 100000;
    const double h = time / steps;
    double omega = 0;
    for (int i = 0; i < steps; i++) {
        double k[4], l[4], at = angle, rate = omega;
        for (int s = 0; s < 4; s++) {
            const double by = s < 2 ? h / 2 : h;
            k[s] = rate;
            l[s] = -pull * sin(at) - brake * fabs(rate) * rate;
            at = angle + by * k[s];
            rate = omega + by * l[s];
        }
        angle += h / 6 * (k[0] + 2 * k[1] + 2 * k[2] + k[3]);
        omega += h / 6 * (l[0] + 2 * l[1] + 2 * l[2] + l[3]);
    }
    return angle;
}

static double pendulum(CpsTimeScheme scheme, int steps) {
    TimeRig rig;
    const double angle = 0.9, time = 3, length = 1.5, mass = 2;
    const CpsDrag drag = {.diameter = 0.02, .normal = 1.3, .tangential = 0.7, .added_normal = 0.8};
    const double water[3] = {0, 0, 0}, density = 998;
    time_begin(&rig, length, 1, mass, INFINITY);
    rig.scene.time_scheme = scheme;
    time_water(&rig, density, water, drag);
    time_node(&rig, 1, length * sin(angle), 0, -length * cos(angle));
    time_stage(&rig, time, steps);
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    const double all = mass + density * PI / 4 * 0.02 * 0.02 * 0.8;
    const double exact = pendulum_angle(angle, mass / all * rig.gravity / length,
                                        density / 2 * 0.02 * 1.3 * length / all, time),
                 found = atan2(run.view.position[3], -run.view.position[5]);
    char name[48];
    snprintf(name, sizeof name, "pendulum, %s, %d steps", scheme ? "Euler" : "BDF2", steps);
    const double error = time_report(name, "angle after 3 s [rad]", exact, found);
    CHECK_GREATER(run.drag, 0);
    time_close(&run, name);
    return error;
}

static void a_pendulum_in_water_decays(void **state) {
    (void)state;
    for (int scheme = 0; scheme < 2; scheme++) {
        double error[4];
        for (int k = 0; k < 4; k++)
            error[k] = pendulum((CpsTimeScheme)scheme, (scheme ? 800 : 400) << k);
        const double order = log2(error[2] / error[3]);
        time_report(scheme ? "pendulum, Euler" : "pendulum, BDF2", "order", scheme ? 1 : 2, order);
        CHECK_NEAR(order, scheme ? 1 : 2, 0.1);
    }
}

/* ---- statics as the limit ---- */

/* A line that hangs from A in a current, as it comes to rest: in time, or statically. */
static void hang(bool in_time, double *x, int nodes) {
    TimeRig rig;
    const double length = 8, water[3] = {0.7, 0.3, 0};
    const CpsDrag drag = {.diameter = 0.04, .normal = 1.2, .tangential = 0.1, .added_normal = 1};
    time_begin(&rig, length, nodes - 1, 1.5, 1e6);
    time_water(&rig, 1025, water, drag);
    for (int j = 0; j < nodes; j++) time_node(&rig, j, 0, 0, -length * j / (nodes - 1));
    time_stage(&rig, in_time ? 120 : 0, in_time ? 400 : 4);
    if (!in_time) rig.scene.in_time = true;
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    memcpy(x, run.view.position, 3 * (size_t)nodes * sizeof *x);
    time_close(&run, in_time ? "hanging, in time" : "hanging, static");
}

static void a_line_comes_to_rest_where_statics_say(void **state) {
    (void)state;
    enum { NODES = 21 };
    double moved[3 * NODES], rests[3 * NODES], off = 0;
    hang(true, moved, NODES);
    hang(false, rests, NODES);
    for (int i = 0; i < 3 * NODES; i++) off = fmax(off, fabs(moved[i] - rests[i]));
    time_report("hanging", "tip, along the current [m]", rests[3 * NODES - 3],
                moved[3 * NODES - 3]);
    CHECK_GREATER(rests[3 * NODES - 3], 1);
    /* the last of the swing has decayed like 1/t */
    CHECK_LESS(time_report("hanging", "places off by [m]", 0, off), 1e-6);
}

/* On a rough bed a line stays in a current that its friction holds; in a faster one it is carried
 * along until it has the speed at which drag and friction are equal. */
static void friction_holds_a_line_in_a_current(void **state) {
    (void)state;
    for (int fast = 0; fast < 2; fast++) {
        TimeRig rig;
        const double speed = fast ? 1.5 : 0.5, water[3] = {0, speed, 0};
        const CpsDrag drag = {.diameter = 0.04, .normal = 1.2, .added_normal = 1};
        time_begin(&rig, 4, 8, 1.5, 1e6);
        rig.line.weight = 10;
        rig.line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_FREE};
        time_plane(&rig, 0, 0.7);
        time_water(&rig, 1025, water, drag);
        for (int j = 0; j <= 8; j++) time_node(&rig, j, 0.5 * j, 0, 0);
        time_stage(&rig, 20, 200);
        TimeRun run = time_open(&rig);
        time_steps(&run, 0);
        const double still = sqrt(2 * 7 / (1025 * 0.04 * 1.2)),
                     moved = run.view.position[1] - rig.point[1];
        if (fast)
            CHECK_NEAR(time_report("on a bed", "speed in the end [m/s]", speed - still,
                                   run.motion.velocity[13]),
                       0, 1e-9);
        else
            CHECK_NEAR(time_report("on a bed", "way of a line that is held [m]", 0, moved), 0,
                       1e-15);
        time_close(&run, fast ? "carried along a bed" : "held on a bed");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rope_sinks_to_its_terminal_velocity),
        cmocka_unit_test(an_inclined_rope_glides_in_a_current),
        cmocka_unit_test(a_pendulum_in_water_decays),
        cmocka_unit_test(a_line_comes_to_rest_where_statics_say),
        cmocka_unit_test(friction_holds_a_line_in_a_current),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
