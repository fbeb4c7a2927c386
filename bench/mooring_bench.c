/* SPDX-License-Identifier: BSD-3-Clause */
/* Time of a mooring with a free body: mooring_bench [--elements N] [--friction MU] [--repeat R]
 *                                      mooring_bench --moorpy [--elements N]
 *
 * OC3-Hywind: its spar on three lines (NREL/TP-500-47535; the lines as in test/analytic), under the
 * thrust of its turbine at 90 m.
 *
 * As it is, it takes three cycles of thrust, 0 to 400 kN and back in eight steps each, with the
 * spar free, and then the three lines alone to the same places, in turns. Prints as CSV the fastest
 * of each: processor time per step, their ratio, and how many places the search tried in a step, in
 * the mean and at most (each a step of the three lines).
 *
 * With --moorpy it prints the equilibria that compare_moorpy.py compares, without friction, a row
 * per load: pose, force and moment of the lines, the stiffness of the lines (smooth), tensions at
 * both ends of all lines, and processor time. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "capstan/evolve.h"

enum { LINES = 3, CYCLES = 3, STEPS = 8, ALL = 2 * CYCLES * STEPS };
static const double THRUST = 400e3, HEIGHT = 90, TURN = 2.0943951023931953;

typedef struct Mooring {
    CpsObstacle bed;
    CpsLine line[LINES];
    CpsPoint point[2 * LINES];
    CpsBody body;
    CpsScene scene;
} Mooring;

static void make_mooring(Mooring *m, int elements, double friction) {
    static const char *const LINE[] = {"one", "two", "three"}, *const POINT[] = {"a1", "a2", "a3",
                                                                                 "f1", "f2", "f3"};
    *m = (Mooring){.bed = cps_obstacle_default(),
                   .body = cps_body_default(),
                   .scene = cps_scene_default()};
    m->bed.name = "bed";
    m->bed.point[2] = -320;
    m->bed.friction = friction;
    m->body.name = "spar";
    m->body.kind = CPS_BODY_KIND_FREE;
    m->body.weight = 8066048 * 9.80665;
    m->body.buoyancy = m->body.weight + 1607182;
    m->body.centre_of_gravity[2] = -78;
    m->body.hydrostatics[14] = 332941;
    m->body.hydrostatics[21] = m->body.hydrostatics[28] = -4.999e9;
    m->body.hydrostatics[35] = 98.34e6;
    for (int i = 0; i < 2 * LINES; i++) {
        const bool upper = i >= LINES;
        const double radius = upper ? 5.2 : 853.87, turn = TURN * (i % LINES);
        m->point[i] = cps_point_default();
        m->point[i].name = POINT[i];
        if (upper) m->point[i].kind = CPS_POINT_KIND_ON_BODY;
        m->point[i].position[0] = radius * cos(turn);
        m->point[i].position[1] = radius * sin(turn);
        m->point[i].position[2] = upper ? -70 : -320;
    }
    for (int i = 0; i < LINES; i++) {
        m->line[i] = cps_line_default();
        m->line[i].name = LINE[i];
        m->line[i].length = 902.2;
        m->line[i].element_count = elements;
        m->line[i].weight = 698.094;
        m->line[i].stiffness = 384.243e6;
        m->line[i].start.kind = CPS_START_STATIC;
        for (int end = 0; end < 2; end++) {
            m->line[i].end[end].kind = CPS_END_KIND_POINT;
            m->line[i].end_point[end] = LINES * end + i;
        }
    }
    m->scene.gravity[2] = -9.80665;
    m->scene.obstacle_count = m->scene.body_count = 1;
    m->scene.obstacle = &m->bed;
    m->scene.body = &m->body;
    m->scene.line_count = LINES;
    m->scene.line = m->line;
    m->scene.point_count = 2 * LINES;
    m->scene.point = m->point;
}

static void need(CpsStatus status, const CpsError *err) {
    if (status == CPS_OK) return;
    fprintf(stderr, "mooring_bench: %s\n", err->message);
    exit(1);
}

static CpsEvolution *begin(const CpsScene *scene) {
    CpsEvolution *out = NULL;
    CpsError err;
    need(cps_evolution_create(scene, &out, &err), &err);
    need(cps_evolution_step(out, &err), &err);
    return out;
}

static double now(void) { return (double)clock() / CLOCKS_PER_SEC; }

static void take(CpsEvolution *evolution, const CpsBodyChange *change) {
    CpsStage move = cps_stage_default();
    CpsError err;
    move.body_change_count = 1;
    move.body_change = change;
    need(cps_evolution_move(evolution, &move, &err), &err);
    if (cps_evolution_report(evolution).outcome == CPS_OUTCOME_SOLVED) return;
    fprintf(stderr, "mooring_bench: a step is %s\n",
            cps_outcome_name(cps_evolution_report(evolution).outcome));
    exit(1);
}

static CpsBodyChange thrust(double force, double heading) {
    CpsBodyChange out = {.kind = CPS_BODY_KIND_FREE};
    out.force[0] = force * cos(heading);
    out.force[1] = force * sin(heading);
    out.moment[0] = -HEIGHT * out.force[1];
    out.moment[1] = HEIGHT * out.force[0];
    return out;
}

/* The poses of all steps and the places tried. */
typedef struct History {
    CpsBodyChange pose[ALL];
    int tried, most;
} History;

/* Seconds of processor of the history with the spar free. */
static double run_free(Mooring *m, History *history) {
    m->body.kind = CPS_BODY_KIND_FREE;
    CpsEvolution *evolution = begin(&m->scene);
    history->tried = history->most = 0;
    double seconds = 0;
    for (int k = 0; k < ALL; k++) {
        const int in_cycle = k % (2 * STEPS) + 1;
        const double share = in_cycle <= STEPS ? in_cycle : 2 * STEPS - in_cycle;
        const CpsBodyChange load = thrust(THRUST * share / STEPS, 0);
        const double start = now();
        take(evolution, &load);
        seconds += now() - start;
        const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
        history->tried += report.trial_count;
        if (report.trial_count > history->most) history->most = report.trial_count;
        history->pose[k] = (CpsBodyChange){.kind = CPS_BODY_KIND_HELD};
        memcpy(history->pose[k].position, report.position, sizeof report.position);
        memcpy(history->pose[k].rotation, report.rotation, sizeof report.rotation);
    }
    cps_evolution_destroy(evolution);
    return seconds;
}

/* Seconds of processor of the three lines to the same places. */
static double run_held(Mooring *m, const History *history) {
    m->body.kind = CPS_BODY_KIND_HELD;
    CpsEvolution *evolution = begin(&m->scene);
    double seconds = 0;
    for (int k = 0; k < ALL; k++) {
        const double start = now();
        take(evolution, &history->pose[k]);
        seconds += now() - start;
    }
    cps_evolution_destroy(evolution);
    return seconds;
}

static void time_cycles(int elements, double friction, int repeat) {
    Mooring m;
    History history;
    double seconds[2] = {INFINITY, INFINITY};
    make_mooring(&m, elements, friction);
    for (int i = 0; i < repeat; i++) {
        seconds[0] = fmin(seconds[0], run_free(&m, &history));
        seconds[1] = fmin(seconds[1], run_held(&m, &history));
    }
    printf("elements,friction,steps,free_ms,held_ms,free_over_held,tried,most_tried\n");
    printf("%d,%g,%d,%.3f,%.3f,%.2f,%.2f,%d\n", elements, friction, ALL, 1e3 * seconds[0] / ALL,
           1e3 * seconds[1] / ALL, seconds[0] / seconds[1], (double)history.tried / ALL,
           history.most);
}

/* The loads that are compared: thrust [N] and its heading [rad]. */
static const double LOAD[][2] = {{0, 0},      {200e3, 0},   {400e3, 0},  {800e3, 0},
                                 {400e3, 60}, {400e3, 180}, {800e3, 30}, {1200e3, 100}};
enum { LOADS = sizeof LOAD / sizeof LOAD[0] };

static void print_equilibria(int elements) {
    Mooring m;
    CpsError err;
    make_mooring(&m, elements, 0);
    /* as MoorPy has it: buoyancy at the metacentre, and heave */
    m.body.centre_of_buoyancy[2] = m.body.hydrostatics[21] / m.body.buoyancy;
    m.body.hydrostatics[21] = m.body.hydrostatics[28] = m.body.hydrostatics[35] = 0;
    for (int k = 0; k < LOADS; k++) {
        const double start = now();
        const CpsBodyChange load = thrust(LOAD[k][0], LOAD[k][1] * acos(-1) / 180);
        memcpy(m.body.force, load.force, sizeof load.force);
        memcpy(m.body.moment, load.moment, sizeof load.moment);
        CpsEvolution *evolution = begin(&m.scene);
        const double seconds = now() - start;
        const CpsBodyReport body = cps_evolution_body_report(evolution, 0);
        CpsBodyStiffness stiffness;
        need(cps_evolution_body_stiffness(evolution, 0, CPS_STIFFNESS_STEP, &stiffness, &err),
             &err);
        printf("%.17g %.17g", LOAD[k][0], LOAD[k][1]);
        for (int i = 0; i < 3; i++) printf(" %.17g", body.position[i]);
        for (int i = 0; i < 4; i++) printf(" %.17g", body.rotation[i]);
        for (int i = 0; i < 6; i++) printf(" %.17g", body.lines[i]);
        for (int i = 0; i < 36; i++) printf(" %.17g", stiffness.smooth[i]);
        for (int i = 0; i < LINES; i++)
            for (int end = 0; end < 2; end++)
                printf(" %.17g", cps_evolution_line_report(evolution, i).end[end].tension);
        printf(" %.6g %d\n", seconds,
               cps_evolution_report(evolution).outcome == CPS_OUTCOME_SOLVED);
        cps_evolution_destroy(evolution);
    }
}

int main(int argc, char **argv) {
    int elements = 100, repeat = 5, moorpy = 0;
    double friction = 1;
    for (int i = 1; i < argc; i++) {
        const bool more = i + 1 < argc;
        if (strcmp(argv[i], "--moorpy") == 0)
            moorpy = 1;
        else if (more && strcmp(argv[i], "--elements") == 0)
            elements = atoi(argv[++i]);
        else if (more && strcmp(argv[i], "--repeat") == 0)
            repeat = atoi(argv[++i]);
        else if (more && strcmp(argv[i], "--friction") == 0)
            friction = atof(argv[++i]);
        else
            elements = 0;
    }
    if (elements < 1 || repeat < 1) {
        fprintf(stderr, "usage: mooring_bench [--elements N] [--friction MU] [--repeat R] | "
                        "--moorpy [--elements N]\n");
        return 2;
    }
    if (moorpy)
        print_equilibria(elements);
    else
        time_cycles(elements, friction, repeat);
    return 0;
}
