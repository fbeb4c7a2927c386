/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of what a stage changes (stage_check.h). */
#include "evolve/stage_check.h"

#include <math.h>
#include <stdio.h>

#include "base/math.h"
#include "base/status.h"
#include "evolve/bodies.h"
#include "evolve/constraints.h"
#include "evolve/grasps.h"
#include "evolve/places.h"
#include "evolve/points.h"
#include "evolve/ranges.h"
#include "evolve/shifts.h"
#include "evolve/sways.h"
#include "evolve/time_check.h"
#include "evolve/velocities.h"
#include "evolve/water_check.h"
#include "evolve/winches.h"

enum { STAGE_COOKIE = 0x57a9e004 };

/* [rad] Limit of a turn in one stage, which takes a substep for every quarter of a turn: 10 000
 * turns. */
static const double MAX_TURN = 2e4 * CPSI_PI, DEGREES = 180 / CPSI_PI;

CpsStage cps_stage_default(void) { return (CpsStage){.cookie = STAGE_COOKIE, .step_count = 1}; }

/* Does a stage of the scene before this one let the end go? */
static bool was_released(const CpsScene *scene, const CpsStage *stage, const CpsChange *change) {
    for (int k = 0; k < scene->stage_count && &scene->stage[k] != stage; k++)
        for (int i = 0; i < scene->stage[k].change_count; i++) {
            const CpsChange *earlier = &scene->stage[k].change[i];
            if (earlier->to.kind == CPS_END_KIND_RELEASED && earlier->line == change->line &&
                earlier->end == change->end)
                return true;
        }
    return false;
}

static CpsStatus check_change(const CpsScene *scene, const CpsStage *stage, int index,
                              const char *what, CpsError *err) {
    const CpsChange *change = &stage->change[index];
    if (change->line < 0 || change->line >= scene->line_count ||
        (change->end != CPS_END_A && change->end != CPS_END_B))
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "%s: change %d names line %d, end %d: there are %d lines, ends are 0 and 1", what,
            index + 1, change->line, change->end, scene->line_count);
    const CpsLine *line = &scene->line[change->line];
    const char *letter = cpsi_end_letter(change->end);
    char place[80];
    snprintf(place, sizeof place, "%s.%s", line->name, letter);
    for (int i = 0; i < index; i++) {
        const CpsChange *other = &stage->change[i];
        if (other->line == change->line && other->end == change->end)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT, "%s: %s.%s is changed twice", what,
                                line->name, letter);
    }
    const double *v = change->to.value;
    if (change->to.kind == CPS_END_KIND_RELEASED) return CPS_OK;
    if (cpsi_point_of(line, change->end) != CPSI_NO_POINT && !was_released(scene, stage, change))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s.%s is at a point: change the point instead, or release it "
                            "before",
                            what, line->name, letter);
    if (change->to.kind != CPS_END_KIND_HELD && change->to.kind != CPS_END_KIND_FREE)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT, "%s: %s.%s has the unknown kind %d", what,
                            line->name, letter, (int)change->to.kind);
    if (!cpsi_are_usable(v))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s.%s gets (%g, %g, %g), expected finite numbers", what,
                            line->name, letter, v[0], v[1], v[2]);
    const char *name = "";
    const double above = change->to.kind == CPS_END_KIND_HELD
                             ? cpsi_scene_height(scene, vec3_load(v), false, &name)
                             : INFINITY;
    if (!(above >= -cpsi_place_tolerance(line, vec3_load(v))))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s.%s is moved to %g m below obstacle '%s'", what, line->name,
                            letter, -above, name);
    return CPS_OK;
}

static CpsStatus check_turns(const CpsScene *scene, const CpsStage *stage, const char *what,
                             CpsError *err) {
    if (stage->turn_count < 0 || (stage->turn_count > 0 && !stage->turn))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: found %d turns, expected 0 or more", what,
                         stage->turn_count);
    for (int i = 0; i < stage->turn_count; i++) {
        const CpsTurn *turn = &stage->turn[i];
        if (turn->obstacle < 0 || turn->obstacle >= scene->obstacle_count)
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: turn %d names obstacle %d: there are %d",
                             what, i + 1, turn->obstacle, scene->obstacle_count);
        const CpsObstacle *obstacle = &scene->obstacle[turn->obstacle];
        char place[80];
        snprintf(place, sizeof place, "%s.turn", obstacle->name);
        if (obstacle->kind == CPS_OBSTACLE_PLANE || obstacle->kind == CPS_OBSTACLE_MESH)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: obstacle '%s' is a %s: only a round obstacle turns "
                                "about its own axis; %s.obstacle has turns about any",
                                what, obstacle->name,
                                obstacle->kind == CPS_OBSTACLE_PLANE ? "plane" : "mesh",
                                obstacle->name);
        if (obstacle->kind == CPS_OBSTACLE_BOX)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: obstacle '%s' is a box, which has no axis of rotation; "
                                "%s.obstacle has turns about any",
                                what, obstacle->name, obstacle->name);
        if (obstacle->kind == CPS_OBSTACLE_GROUND || obstacle->kind == CPS_OBSTACLE_SURFACE)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: obstacle '%s' is a %s: only a round obstacle turns", what,
                                obstacle->name,
                                obstacle->kind == CPS_OBSTACLE_GROUND ? "ground" : "surface");
        if (!cpsi_is_usable(turn->angle))
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: obstacle '%s' turns by %g, expected a finite angle", what,
                                obstacle->name, turn->angle);
        if (fabs(turn->angle) > MAX_TURN)
            return CPSI_FAIL_AT(place, err, CPS_ERR_LIMIT,
                                "%s: obstacle '%s' turns by %g degrees, the limit is %g", what,
                                obstacle->name, turn->angle * DEGREES, MAX_TURN * DEGREES);
        for (int k = 0; k < i; k++)
            if (stage->turn[k].obstacle == turn->obstacle)
                return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                    "%s: obstacle '%s' is turned twice", what, obstacle->name);
    }
    return CPS_OK;
}

CpsStatus cpsi_stage_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                           CpsError *err) {
    if (stage->cookie != STAGE_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: not made by cps_stage_default()", what);
    if (stage->step_count < 1)
        return CPSI_FAIL_AT("steps", err, CPS_ERR_ARGUMENT, "%s: steps is %d, expected at least 1",
                            what, stage->step_count);
    if (stage->change_count < 0 || (stage->change_count > 0 && !stage->change))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: found %d changes, expected 0 or more", what,
                         stage->change_count);
    if (stage->gravity_changes && !cpsi_are_usable(stage->gravity))
        return CPSI_FAIL_AT("gravity", err, CPS_ERR_ARGUMENT,
                            "%s: gravity is (%g, %g, %g) m/s2, expected finite numbers", what,
                            stage->gravity[0], stage->gravity[1], stage->gravity[2]);
    if (stage->gravity_changes && !cpsi_is_direction(scene->gravity))
        return CPSI_FAIL_AT("gravity", err, CPS_ERR_ARGUMENT,
                            "%s: gravity changes, but that of the scene is zero, so that nothing "
                            "has a mass: give the scene a gravity, and change it in its history",
                            what);
    CpsStatus status =
        stage->gravity_changes ? cpsi_water_check(scene, stage->gravity, what, err) : CPS_OK;
    if (status == CPS_OK) status = check_turns(scene, stage, what, err);
    if (status == CPS_OK) status = cpsi_stage_shifts_check(scene, stage, what, err);
    for (int i = 0; i < stage->change_count && status == CPS_OK; i++)
        status = check_change(scene, stage, i, what, err);
    if (status == CPS_OK) status = cpsi_stage_time_check(stage, what, err);
    if (status == CPS_OK) status = cpsi_point_changes_check(scene, stage, what, err);
    if (status == CPS_OK) status = cpsi_grasp_changes_check(scene, stage, what, err);
    if (status == CPS_OK) status = cpsi_pay_outs_check(scene, stage, what, err);
    if (status == CPS_OK) status = cpsi_constraints_check_stage(scene, stage, what, err);
    if (status == CPS_OK) status = cpsi_body_changes_check(scene, stage, what, err);
    if (status == CPS_OK) status = cpsi_velocities_check(scene, stage, what, err);
    return status == CPS_OK ? cpsi_sways_check(scene, stage, what, err) : status;
}
