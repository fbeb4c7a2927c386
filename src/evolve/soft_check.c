/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of obstacles that give (soft_check.h). */
#include "evolve/soft_check.h"

#include "base/status.h"
#include "evolve/ranges.h"
#include "evolve/ties.h"

CpsStatus cpsi_soft_obstacle_check(const CpsScene *scene, const CpsObstacle *o, CpsError *err) {
    const char *why = NULL;
    if (!cpsi_is_not_negative(o->stiffness))
        return CPSI_FAIL_AT("stiffness", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': stiffness is %g N/m3, expected a finite number >= 0",
                            o->name, o->stiffness);
    if (!cpsi_is_not_negative(o->damping))
        return CPSI_FAIL_AT("damping", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': damping is %g N s/m3, expected a finite number >= 0",
                            o->name, o->damping);
    if (o->damping > 0 && !(o->stiffness > 0))
        return CPSI_FAIL_AT("damping", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': damping: only an obstacle that gives has it: give its "
                            "stiffness too, or leave it out",
                            o->name);
    if (!(o->stiffness > 0)) return CPS_OK;
    if (scene->friction_policy != CPS_FRICTION_POLICY_CONSISTENT)
        why = "friction_policy is frozen: make it consistent";
    else if (scene->contact_policy != CPS_CONTACT_POLICY_REACHED)
        why = "contact_policy is reference: make it reached";
    if (!why) return CPS_OK;
    return CPSI_FAIL_AT("stiffness", err, CPS_ERR_ARGUMENT,
                        "obstacle '%s': stiffness: it gives, but %s, or leave the stiffness out",
                        o->name, why);
}

/* Is a point ever free in the history? Also asked before its stages are checked. */
static bool is_ever_free(const CpsScene *scene, int index) {
    bool free = scene->point[index].kind == CPS_POINT_KIND_FREE;
    const int stages = scene->stage ? scene->stage_count : 0;
    for (int k = 0; k < stages; k++) {
        const CpsStage *stage = &scene->stage[k];
        const int changes = stage->point_change ? stage->point_change_count : 0;
        for (int i = 0; i < changes; i++)
            free = free || (stage->point_change[i].point == index &&
                            stage->point_change[i].kind == CPS_POINT_KIND_FREE);
    }
    return free;
}

/* The area of a point does not follow what a winch there pays out. */
static CpsStatus check_winch(const CpsScene *scene, int index, CpsError *err) {
    const CpsObstacle *soft = cpsi_soft_obstacle(scene);
    if (!soft) return CPS_OK;
    for (int k = 0; k < 2 * scene->line_count; k++) {
        const CpsLine *line = &scene->line[k / 2];
        if (line->winch[k % 2].is_there && cpsi_point_of(line, k % 2) == index)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "point '%s': line '%s' has a winch there, and obstacle '%s' gives "
                             "(stiffness): a winch beside it holds its end at no point",
                             scene->point[index].name, line->name, soft->name);
    }
    return CPS_OK;
}

CpsStatus cpsi_soft_point_check(const CpsScene *scene, int index, CpsError *err) {
    const CpsPoint *point = &scene->point[index];
    const char *why = NULL;
    const CpsStatus status = check_winch(scene, index, err);
    if (status != CPS_OK) return status;
    if (!cpsi_is_not_negative(point->bearing_area))
        return CPSI_FAIL_AT("bearing_area", err, CPS_ERR_ARGUMENT,
                            "point '%s': bearing_area is %g m2, expected a finite number >= 0",
                            point->name, point->bearing_area);
    if (!(point->bearing_area > 0)) return CPS_OK;
    if (point->kind == CPS_POINT_KIND_ON_BODY)
        why = "it is on a body, which does not bear on obstacles: let it be free";
    else if (!is_ever_free(scene, index))
        why = "it is held throughout, and what holds it bears all: let it be free";
    else if (point->constraint.kind != CPS_CONSTRAINT_KIND_NONE)
        why = "it is held to a set, and no obstacle bears it: leave the set out";
    else if (!cpsi_soft_obstacle(scene))
        why = "no obstacle gives: give one a stiffness";
    if (!why) return CPS_OK;
    return CPSI_FAIL_AT("bearing_area", err, CPS_ERR_ARGUMENT,
                        "point '%s': bearing_area: %s, or leave the area out", point->name, why);
}

const CpsObstacle *cpsi_soft_obstacle(const CpsScene *scene) {
    for (int k = 0; k < scene->obstacle_count; k++)
        if (scene->obstacle[k].stiffness > 0) return &scene->obstacle[k];
    return NULL;
}

CpsStatus cpsi_soft_line_check(const CpsScene *scene, const CpsLine *line, CpsError *err) {
    const CpsObstacle *soft = cpsi_soft_obstacle(scene);
    if (!cpsi_is_not_negative(line->bearing_width))
        return CPSI_FAIL_AT("bearing_width", err, CPS_ERR_ARGUMENT,
                            "line '%s': bearing_width is %g m, expected a finite number >= 0",
                            line->name, line->bearing_width);
    if (!soft) return CPS_OK;
    if (!(line->bearing_width > 0))
        return CPSI_FAIL_AT(
            "bearing_width", err, CPS_ERR_ARGUMENT,
            "line '%s': bearing_width: obstacle '%s' gives (stiffness), so how wide the "
            "line bears on it has to be known: give its bearing_width",
            line->name, soft->name);
    if (line->start.kind == CPS_START_NODES && (line->start.reaction || line->start.friction_bound))
        return CPSI_FAIL_AT("start", err, CPS_ERR_ARGUMENT,
                            "line '%s': start: obstacle '%s' gives (stiffness), so the reactions "
                            "follow from the nodes: leave reactions and friction bounds out",
                            line->name, soft->name);
    return CPS_OK;
}
