/* SPDX-License-Identifier: BSD-3-Clause */
/* A gripper takes a rope in its middle, drags it round a bollard and lets go. The next target is
 * decided by the force that the last one took: a move that took too much is taken back, and the
 * gripper comes nearer to the bollard. */
#include <math.h>
#include <stdio.h>

#include "capstan/evolve.h"

static const double LENGTH = 6, CENTRE[2] = {1.5, 0.5}; /* [m] */
static const double LIMIT = 40, TURN = 3;               /* [N], [rad] */
enum { ELEMENTS = 120, MIDDLE = 60 };

/* A step in which the gripper holds the middle of the rope at (x, y), a little above the floor; or
 * has let it go. */
static CpsStatus grip(CpsEvolution *evolution, bool holds, double x, double y, CpsError *err) {
    CpsGraspChange change = {.node = MIDDLE, .kind = CPS_END_KIND_HELD, .value = {x, y, 0.05}};
    if (!holds) change = (CpsGraspChange){.node = MIDDLE, .kind = CPS_END_KIND_FREE};
    CpsStage move = cps_stage_default();
    move.grasp_change_count = 1;
    move.grasp_change = &change;
    return cps_evolution_move(evolution, &move, err);
}

/* [N] The force of the gripper on the rope. */
static double force(const CpsEvolution *evolution) {
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    const double *f = view.grasp[0].force;
    return sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
}

/* Drag the rope round the bollard, in moves of a tenth of a radian, each as far from the bollard as
 * the limit of the force allows. Returns the angle that the gripper has gone. */
static double drag(CpsEvolution *evolution, CpsError *err) {
    const double begin = atan2(-CENTRE[1], 0.5 * LENGTH - CENTRE[0]);
    double far = hypot(0.5 * LENGTH - CENTRE[0], CENTRE[1]), angle = 0;
    while (angle < TURN && far > 0.5) {
        const double to = begin + angle + 0.1;
        if (grip(evolution, true, CENTRE[0] + far * cos(to), CENTRE[1] + far * sin(to), err)) break;
        const bool certified = cps_outcome_is_certified(cps_evolution_report(evolution).outcome);
        if (certified && force(evolution) <= LIMIT) {
            angle += 0.1;
            continue;
        }
        cps_evolution_take_back(evolution, err);
        far -= 0.02;
    }
    return angle;
}

int main(void) {
    /* a floor and a bollard, and a rope along x, of which one end is made fast */
    CpsObstacle obstacle[2] = {cps_obstacle_default(), cps_obstacle_default()};
    obstacle[0].name = "floor";
    obstacle[0].friction = 0.3;
    obstacle[1].name = "bollard";
    obstacle[1].kind = CPS_OBSTACLE_CYLINDER;
    obstacle[1].radius = 0.3;
    obstacle[1].friction = 0.25;
    for (int a = 0; a < 3; a++) {
        obstacle[1].point[a] = a < 2 ? CENTRE[a] : 0;
        obstacle[1].axis[a] = a == 2;
    }
    const double ends[] = {0, 0, 0, LENGTH, 0, 0};
    CpsLine rope = cps_line_default();
    rope.name = "rope";
    rope.length = LENGTH;
    rope.element_count = ELEMENTS;
    rope.weight = 10;
    rope.stiffness = 5e4;
    rope.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = ends};
    CpsScene scene = cps_scene_default(); /* without a history */
    scene.obstacle_count = 2;
    scene.obstacle = obstacle;
    scene.line_count = 1;
    scene.line = &rope;

    CpsError err = {.message = "the rope is too short"};
    CpsEvolution *evolution;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) {
        fprintf(stderr, "%s\n", err.message);
        return 1;
    }
    const double angle = drag(evolution, &err), last = force(evolution);
    if (!(angle >= TURN) || grip(evolution, false, 0, 0, &err) != CPS_OK) {
        fprintf(stderr, "%s\n", err.message);
        return 1;
    }
    const CpsStepReport report = cps_evolution_report(evolution);
    const double tension = cps_evolution_line_report(evolution, 0).end[CPS_END_A].tension;
    printf("dragged round by %.1f degrees with %.2f N; let go, the rope pulls with %.2f N, %s\n",
           angle * 45 / atan(1), last, tension, cps_outcome_name(report.outcome));
    cps_evolution_destroy(evolution);
    return 0;
}
