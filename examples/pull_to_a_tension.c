/* SPDX-License-Identifier: BSD-3-Clause */
/* Move the end of a rope until it carries a wanted tension: each move is decided by the answer to
 * the one before, and one that goes too far is taken back. */
#include <stdio.h>

#include "capstan/evolve.h"

static const double LENGTH = 6.28;

/* Move end B along x, in moves of at first `step` metres, until its tension has come to `wanted`
 * newtons. Returns where it is then. */
static double pull(CpsEvolution *evolution, double x, double step, double wanted) {
    const bool rises = step > 0;
    while (step > 1e-6 || step < -1e-6) {
        const CpsChange change = {.line = 0,
                                  .end = CPS_END_B,
                                  .to = {CPS_END_KIND_HELD, {x + step, 0, 0}}};
        CpsStage move = cps_stage_default();
        move.change_count = 1;
        move.change = &change;
        CpsError err;
        if (cps_evolution_move(evolution, &move, &err) != CPS_OK) {
            fprintf(stderr, "%s\n", err.message);
            return x;
        }
        const bool certified = cps_outcome_is_certified(cps_evolution_report(evolution).outcome);
        const double tension = cps_evolution_line_report(evolution, 0).end[CPS_END_B].tension;
        if (certified && (rises ? tension <= wanted : tension >= wanted)) {
            x += step;
            continue;
        }
        cps_evolution_take_back(evolution, &err);
        step /= 2;
    }
    return x;
}

int main(void) {
    /* a floor with mu = 0.0255, and a soft rope along x, 6.28 m, 1 kg/m, EA = 10 N */
    CpsObstacle floor = cps_obstacle_default();
    floor.name = "floor";
    floor.friction = 0.25 / 9.81;
    const double ends[] = {0, 0, 0, LENGTH, 0, 0};
    CpsLine rope = cps_line_default();
    rope.name = "rope";
    rope.length = LENGTH;
    rope.element_count = 400;
    rope.weight = 9.81;
    rope.stiffness = 10;
    rope.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = ends};
    CpsScene scene = cps_scene_default(); /* without a history */
    scene.obstacle_count = scene.line_count = 1;
    scene.obstacle = &floor;
    scene.line = &rope;

    CpsError err;
    CpsEvolution *evolution;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) {
        fprintf(stderr, "%s\n", err.message);
        return 1;
    }
    /* theory: P = 0.5 N at P^2/(2 mu w EA) = 0.05 m; eased to p = 0.25 N, the end goes back by
     * (P - p)^2/(4 mu w EA) = 0.00625 m only, as friction turns round beside it */
    const double out = pull(evolution, LENGTH, 0.02, 0.5), back = pull(evolution, out, -0.02, 0.25);
    printf("0.5 N at %.4f m, eased to 0.25 N at %.4f m, in %d steps\n", out - LENGTH, back - LENGTH,
           cps_evolution_report(evolution).step_count);
    cps_evolution_destroy(evolution);
    return 0;
}
