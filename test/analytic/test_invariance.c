/* SPDX-License-Identifier: BSD-3-Clause */
/* The same scene in other forms: rotated and shifted, in other units, with the ends exchanged.
 *
 * A heavy elastic line lies over a half-buried pipe and along a bed, both with different friction
 * along and across the line; one end is lifted and moved aside. Another line is wound around a drum
 * that turns. Positions per length and forces per force must agree. Rotated, shifted or scaled, the
 * same iteration has the same numbers up to rounding, 1e-16 amplified by the conditioning of steps
 * that are solved to 1e-13 of their scale: 1e-9. With the ends exchanged another elimination leads
 * to another point inside that gap, and the gap is quadratic in positions along which the energy is
 * flat: 1e-7. */
#include <stdio.h>
#include <string.h>

#include "rig.h"

enum { N = 60 };

/* x becomes scale Q x + shift; forces are multiplied by `force`. */
typedef struct View {
    const char *name;
    double q[9], shift[3], scale, force;
    bool reversed;
} View;

static void turn_to(const View *view, const double x[3], bool place, double out[3]) {
    for (int a = 0; a < 3; a++) {
        out[a] = place ? view->shift[a] : 0;
        for (int b = 0; b < 3; b++) out[a] += view->q[3 * a + b] * x[b] * (place ? view->scale : 1);
    }
}

static void turn_back(const View *view, const double x[3], double out[3]) {
    for (int a = 0; a < 3; a++) {
        out[a] = 0;
        for (int b = 0; b < 3; b++)
            out[a] += view->q[3 * b + a] * (x[b] - view->shift[b]) / view->scale;
    }
}

static void set_end(Rig *rig, const View *view, bool change, int end, CpsEndKind kind, double x,
                    double y, double z) {
    double to[3];
    turn_to(view, (const double[]){x, y, z}, kind == CPS_END_KIND_HELD, to);
    if (kind == CPS_END_KIND_FREE)
        for (int a = 0; a < 3; a++) to[a] *= view->force;
    const int e = view->reversed ? 1 - end : end;
    if (change)
        rig_change(rig, e, kind, to[0], to[1], to[2]);
    else
        rig_end(rig, e, kind, to[0], to[1], to[2]);
}

static void begin(Rig *rig, const View *view, double weight, double stiffness) {
    rig_begin(rig, N, weight * view->force / view->scale, stiffness * view->force);
    turn_to(view, (const double[]){0, 0, -9.81}, false, rig->scene.gravity);
}

static CpsObstacle *obstacle(Rig *rig, const View *view, CpsObstacleKind kind,
                             const double point[3], const double axis[3], double radius,
                             double friction, double lateral) {
    CpsObstacle *o = rig_obstacle(rig, kind, friction);
    turn_to(view, point, true, o->point);
    turn_to(view, axis, false, kind == CPS_OBSTACLE_PLANE ? o->normal : o->axis);
    o->radius = radius * view->scale;
    o->has_friction_lateral = true;
    o->friction_lateral = lateral;
    return o;
}

/* Over the pipe. */
static void pipe_scene(Rig *rig, const View *view) {
    begin(rig, view, 10, 1e4);
    obstacle(rig, view, CPS_OBSTACLE_PLANE, (const double[]){0, 0, 0}, (const double[]){0, 0, 1}, 1,
             0.5, 0.8);
    obstacle(rig, view, CPS_OBSTACLE_CYLINDER, (const double[]){3, 0, 0}, (const double[]){0, 1, 0},
             1, 0.3, 0.2)
        ->friction_shape = CPS_FRICTION_SHAPE_BOX;
    rig->line.start.kind = CPS_START_STATIC;
    rig_length(rig, 7.2 * view->scale);
    set_end(rig, view, false, CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
    set_end(rig, view, false, CPS_END_B, CPS_END_KIND_HELD, 6, 0, 0.2);
    rig_stage(rig, 6);
    set_end(rig, view, true, CPS_END_B, CPS_END_KIND_HELD, 6.1, 1, 0.6);
}

/* Around the drum: half a turn, heavy, held at one end, pulled at the other; the drum turns and
 * turns back. */
static void drum_scene(Rig *rig, const View *view) {
    begin(rig, view, 1, 1e4);
    obstacle(rig, view, CPS_OBSTACLE_CYLINDER, (const double[]){0, 0, 0}, (const double[]){0, 1, 0},
             1, 0.3, 0.5);
    const double from = -1.2, d = 2.2 / N;
    for (int j = 0; j <= N; j++) {
        const double phi = from + (view->reversed ? N - j : j) * d;
        double x[3];
        turn_to(view, (const double[]){sin(phi), 0.05 * (view->reversed ? N - j : j) / N, cos(phi)},
                true, x);
        rig_point(rig, x[0], x[1], x[2]);
    }
    double chord = hypot(2 * sin(d / 2), 0.05 / N);
    rig_length(rig, N * chord * view->scale);
    set_end(rig, view, false, CPS_END_A, CPS_END_KIND_FREE, -2 * cos(from), 0, 2 * sin(from));
    rig_end(rig, view->reversed ? CPS_END_A : CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_stage(rig, 3);
    rig_turn(rig, 0, -0.05);
    rig_stage(rig, 3);
    rig_turn(rig, 0, 0.01);
}

typedef struct Found {
    double place[3 * (N + 1)], tension[N];
    double uplift[2], angle[2], suspended[2]; /* suspended over the length of the line */
} Found;

static void run_it(void (*make)(Rig *, const View *), const View *view, Found *found) {
    Rig rig;
    make(&rig, view);
    RigRun run = rig_open(&rig);
    while (cps_evolution_remaining_count(run.evolution) > 0) rig_step(&run);
    for (int j = 0; j <= N; j++)
        turn_back(view, &run.view.position[3 * (view->reversed ? N - j : j)], &found->place[3 * j]);
    for (int e = 0; e < N; e++)
        found->tension[e] = rig_tension(&run.view, view->reversed ? N - 1 - e : e) / view->force;
    for (int end = 0; end < 2; end++) {
        const CpsEndReport *of = &run.report.end[view->reversed ? 1 - end : end];
        found->uplift[end] = of->uplift / view->force;
        found->angle[end] = of->angle;
        found->suspended[end] = of->suspended / run.view.arc_length[N];
    }
    rig_close(&run);
}

static const double ONE[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static void compare(const char *name, void (*make)(Rig *, const View *)) {
    View view[] = {{.name = "itself", .scale = 1, .force = 1},
                   {.name = "turned, shifted", .shift = {3, -2, 5}, .scale = 1, .force = 1},
                   {.name = "in feet and pounds", .scale = 1 / 0.3048, .force = 1 / 4.4482216},
                   {.name = "in km and MN", .scale = 1e-3, .force = 1e-6},
                   {.name = "from the other end", .scale = 1, .force = 1, .reversed = true}};
    Found first, other;
    for (int k = 0; k < 5; k++) {
        memcpy(view[k].q, ONE, sizeof ONE);
        if (k == 1) { /* rotations about z, then x, by angles without symmetry */
            const double c = cos(0.7), s = sin(0.7), p = cos(1.9), t = sin(1.9);
            const double q[9] = {c, -s, 0, p * s, p * c, -t, t * s, t * c, p};
            memcpy(view[k].q, q, sizeof q);
        }
        run_it(make, &view[k], k ? &other : &first);
        if (k == 0) continue;
        double place = 0, tension = 0, most = 0;
        for (int i = 0; i < 3 * (N + 1); i++)
            place = fmax(place, fabs(other.place[i] - first.place[i]));
        for (int e = 0; e < N; e++) {
            tension = fmax(tension, fabs(other.tension[e] - first.tension[e]));
            most = fmax(most, first.tension[e]);
        }
        char figure[64];
        const double tolerance = view[k].reversed ? 1e-7 : 1e-9;
        snprintf(figure, sizeof figure, "%s: places [m]", view[k].name);
        CHECK_LESS(rig_show(name, figure, 0, place), tolerance);
        snprintf(figure, sizeof figure, "%s: tensions", view[k].name);
        CHECK_LESS(rig_show(name, figure, 0, tension / most), tolerance);
        for (int end = 0; end < 2; end++) {
            CHECK_NEAR(other.uplift[end], first.uplift[end], tolerance * most);
            CHECK_NEAR(other.angle[end], first.angle[end], tolerance);
            CHECK_NEAR(other.suspended[end], first.suspended[end], tolerance);
        }
    }
}

static void over_a_pipe(void **state) {
    (void)state;
    compare("line over a pipe", pipe_scene);
}

static void around_a_drum(void **state) {
    (void)state;
    compare("line around a drum", drum_scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(over_a_pipe),
        cmocka_unit_test(around_a_drum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
