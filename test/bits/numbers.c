/* SPDX-License-Identifier: BSD-3-Clause */
/* Numbers of every layer of the library, with all their digits, for scripts/same-bits: a rope that
 * is pulled over a floor with friction and over a drum, a wheel with a brake, a disc that is
 * pushed, an area of a set. Only the library is needed. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "capstan/evolve.h"
#include "capstan/planar.h"

/* FNV-1a over the bytes of many numbers */
static uint64_t mixed(uint64_t hash, int count, const double *number) {
    for (int i = 0; i < count; ++i) {
        uint64_t word;
        memcpy(&word, &number[i], sizeof word);
        for (int k = 0; k < 8; ++k) hash = (hash ^ (word >> 8 * k & 0xff)) * 1099511628211u;
    }
    return hash;
}

static int failed(const char *what, const CpsError *err) {
    fprintf(stderr, "%s: %s\n", what, err->message);
    return 1;
}

/* A line over one obstacle, its end B pulled in some steps. */
static int pull(const char *what, CpsObstacle obstacle, const double *start, int points,
                double stiffness, const double force[3]) {
    obstacle.name = "obstacle";
    CpsLine line = cps_line_default();
    line.name = "line";
    line.length = 6;
    line.element_count = 60;
    line.weight = 9.81;
    line.stiffness = stiffness;
    line.start = (CpsStart){.kind = CPS_START_POLYLINE, .point_count = points, .point = start};
    if (points == 2) line.start.kind = CPS_START_STRAIGHT;
    const CpsChange change = {.line = 0,
                              .end = CPS_END_B,
                              .to = {CPS_END_KIND_FREE, {force[0], force[1], force[2]}}};
    const CpsStage stage = {.cookie = cps_stage_default().cookie,
                            .name = "pull",
                            .step_count = 4,
                            .change_count = 1,
                            .change = &change};
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = scene.line_count = scene.stage_count = 1;
    scene.obstacle = &obstacle;
    scene.line = &line;
    scene.stage = &stage;
    CpsError err;
    CpsEvolution *evolution = NULL;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) return failed(what, &err);
    while (cps_evolution_remaining_count(evolution) > 0) {
        if (cps_evolution_step(evolution, &err) != CPS_OK) return failed(what, &err);
        const CpsStepReport step = cps_evolution_report(evolution);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        uint64_t hash = mixed(14695981039346656037u, 3 * (view.element_count + 1), view.position);
        hash = mixed(hash, view.element_count, view.tension);
        printf("%s %d: %s, tip %a, dissipated %a, all %016llx\n", what, step.step_count - 1,
               cps_outcome_name(step.outcome), view.position[3 * view.element_count],
               step.dissipated, (unsigned long long)hash);
    }
    cps_evolution_destroy(evolution);
    return 0;
}

static int wheel(void) {
    CpsError err;
    CpsLaw *brake = NULL, *ground = NULL, *law = NULL;
    CpsSet *interval = NULL, *disc = NULL;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    CpsSetMeasure measure;
    const CpsEntry spin = {0, 0, 1}, side[2] = {{0, 1, 1}, {1, 2, 1}},
                   drive[3] = {{0, 1, 1}, {1, 2, 1}, {1, 0, -0.3}};
    if (cps_set_interval(-60, 60, &interval, &err) || cps_law_friction(interval, &brake, &err) ||
        cps_set_ball(2, NULL, 500, &disc, &err) || cps_law_friction(disc, &ground, &err) ||
        cps_system_create(3, &system, &err) ||
        cps_system_add_friction(system, "brake", brake, 1, &spin, &err) ||
        cps_system_add_friction(system, "ground", ground, 2, side, &err) ||
        cps_system_set_drive(system, 2, 3, drive, &err) ||
        cps_system_solve(system, (double[]){1, 0.5}, NULL, &motion, &err) ||
        cps_system_eliminate(system, &law, NULL, NULL, &err) ||
        cps_set_measure(cps_law_set(law), &measure, &err))
        return failed("wheel", &err);
    const double *v = cps_motion_velocity(motion), *g = cps_motion_resistance(motion);
    printf("wheel: %a %a %a, resistance %a %a, area %a\n", v[0], v[1], v[2], g[0], g[1],
           measure.area);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(law);
    cps_law_release(brake);
    cps_law_release(ground);
    cps_set_release(interval);
    cps_set_release(disc);
    return 0;
}

static int body(void) {
    CpsError err;
    const CpsPatch patch[2] = {{.cookie = cps_patch_default().cookie,
                                .kind = CPS_PATCH_DISC,
                                .friction = 0.5,
                                .load = 10,
                                .size = 0.3},
                               {.cookie = cps_patch_default().cookie,
                                .kind = CPS_PATCH_ROD,
                                .position = {1, 0.2},
                                .angle = 0.7,
                                .friction = 0.3,
                                .load = 4,
                                .size = 0.5}};
    CpsPlanar *planar = NULL;
    CpsPlanarMotion motion;
    CpsSetAnswer answer;
    const double twist[3] = {0.3, -0.2, 0.9}, map[6] = {1, 0, -0.4, 0, 1, 0.1},
                 velocity[2] = {0, 1};
    double wrench[3];
    if (cps_planar_create(2, patch, &planar, &err) ||
        cps_planar_dissipation(planar, twist, wrench, NULL, &answer, &err) ||
        cps_planar_drive(planar, 2, map, velocity, &motion, &err))
        return failed("body", &err);
    printf("body: %a, wrench %a %a %a; pushed %a %a %a, %a to %a\n", answer.value, wrench[0],
           wrench[1], wrench[2], motion.twist[0], motion.twist[1], motion.twist[2], motion.lower,
           motion.upper);
    cps_planar_destroy(planar);
    return 0;
}

int main(void) {
    CpsObstacle floor = cps_obstacle_default(), drum = cps_obstacle_default();
    floor.friction = 0.3;
    drum.kind = CPS_OBSTACLE_CYLINDER;
    drum.friction = 0.2;
    drum.radius = 1;
    drum.point[2] = -1; /* its axis lies along y */
    const double flat[] = {0, 0, 0, 6, 0, 0}, over[] = {-3, 0, 0.01, 3, 0, 0.01};
    return pull("floor", floor, flat, 2, 100, (const double[]){12, 3, 2}) ||
           pull("drum", drum, over, 2, 1e4, (const double[]){40, 5, -30}) || wheel() || body();
}
