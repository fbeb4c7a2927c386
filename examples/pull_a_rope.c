/* SPDX-License-Identifier: BSD-3-Clause */
/* Pull the end of a rope that lies straight on a rough floor, and ask how far it moved. */
#include <stdio.h>

#include "capstan/evolve.h"

int main(void) {
    /* a floor with mu = 0.0255, and a soft rope along x, 6.28 m, 1 kg/m, EA = 10 N */
    CpsObstacle floor = cps_obstacle_default();
    floor.name = "floor";
    floor.friction = 0.25 / 9.81;
    const double ends[] = {0, 0, 0, 6.28, 0, 0};
    CpsLine rope = cps_line_default();
    rope.name = "rope";
    rope.length = 6.28;
    rope.element_count = 400;
    rope.weight = 9.81;
    rope.stiffness = 10;
    rope.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = ends};

    /* one step: half a newton along x on end B, which is free */
    const CpsChange pull = {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_FREE, {0.5, 0, 0}}};
    CpsStage stage = cps_stage_default();
    stage.name = "pull";
    stage.change_count = 1;
    stage.change = &pull;
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = scene.line_count = scene.stage_count = 1;
    scene.obstacle = &floor;
    scene.line = &rope;
    scene.stage = &stage;

    CpsError err;
    CpsEvolution *evolution;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK ||
        cps_evolution_step(evolution, &err) != CPS_OK) {
        fprintf(stderr, "%s\n", err.message);
        return 1;
    }
    /* theory: 2 m of rope slide, the tip moves P^2/(2 mu w EA) = 0.05 m, friction takes P^3/(6 mu w
     * EA) = 1/120 J */
    const CpsStepReport report = cps_evolution_report(evolution);
    const CpsLineReport line = cps_evolution_line_report(evolution, 0);
    printf("%s: the tip moved %.5f m, %.5f J went into friction\n",
           cps_outcome_name(report.outcome), line.end[CPS_END_B].position[0] - 6.28,
           report.dissipated);
    printf("proof: the energy is within %.1e of the least one possible\n",
           report.certificate.gap / report.certificate.scale);
    cps_evolution_destroy(evolution);
    return 0;
}
