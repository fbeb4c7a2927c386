/* SPDX-License-Identifier: BSD-3-Clause */
/* A ship of another program at the end of a mooring rope: at each step of time the program gives
 * place and velocity of the end, and the force of the rope, its inertia included, moves the ship.
 */
#include <math.h>
#include <stdio.h>

#include "capstan/evolve.h"

static const double LENGTH = 20, MASS_PER_METRE = 2, STIFFNESS = 4e5; /* m, kg/m, N */
static const double SHIP = 2000, WIND = 2e4, OFF = 0.3;               /* kg, N, m */
static const double STEP = 0.01, PI = 3.14159265358979323846;         /* s */

/* Take the end to the place and velocity of the ship at the end of a step. Returns the rope's pull
 * on the ship, negative where the step is not certified. */
static double step_rope(CpsEvolution *rope, double x, double v) {
    const CpsChange change = {.line = 0,
                              .end = CPS_END_B,
                              .to = {CPS_END_KIND_HELD, {x, 0, 0}},
                              .has_velocity = true,
                              .velocity = {v, 0, 0}};
    CpsStage move = cps_stage_default();
    move.duration = STEP;
    move.change_count = 1;
    move.change = &change;
    CpsError err;
    if (cps_evolution_move(rope, &move, &err) != CPS_OK) {
        fprintf(stderr, "%s\n", err.message);
        return -1;
    }
    if (!cps_outcome_is_certified(cps_evolution_report(rope).outcome)) return -1;
    return cps_evolution_line_report(rope, 0).end[CPS_END_B].force[0];
}

int main(void) {
    /* at rest the wind stretches the rope by WIND LENGTH/STIFFNESS = 1 m; the ship begins further
     * out */
    const double rest = LENGTH * (1 + WIND / STIFFNESS), ends[] = {0, 0, 0, rest + OFF, 0, 0};
    CpsLine line = cps_line_default();
    line.name = "rope";
    line.length = LENGTH;
    line.element_count = 20;
    line.inertia = MASS_PER_METRE;
    line.stiffness = STIFFNESS;
    line.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = ends};
    CpsScene scene = cps_scene_default(); /* without a history */
    scene.in_time = true;
    scene.line_count = 1;
    scene.line = &line;

    CpsError err;
    CpsEvolution *rope;
    if (cps_evolution_create(&scene, &rope, &err) != CPS_OK) {
        fprintf(stderr, "%s\n", err.message);
        return 1;
    }
    /* the other program: M v' = wind - pull, x' = v, from rest. Its step is explicit, for the pull
     * that it knows is that of the place before */
    double x = rest + OFF, v = 0, pull = WIND * (x - LENGTH) / (rest - LENGTH), time = 0,
           before = x;
    int turned = 0;
    while (turned < 10 && pull >= 0) {
        v += STEP * (WIND - pull) / SHIP;
        before = x;
        x += STEP * v;
        pull = step_rope(rope, x, v);
        time += STEP;
        turned += (before - rest) * (x - rest) < 0;
    }
    /* where it passed the place of rest within the last step; it has passed it after a quarter of a
     * period and then every half one */
    time -= STEP * (x - rest) / (x - before);
    const double period = time / (0.25 + 0.5 * (turned - 1)),
                 known = 2 * PI * sqrt((SHIP + MASS_PER_METRE * LENGTH / 3) / (STIFFNESS / LENGTH));
    printf("period %.3f s, of a mass on a spring with a third of the rope's %.3f s\n", period,
           known);
    cps_evolution_destroy(rope);
    return 0;
}
