/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of anchors (anchor_check.h). */
#include "evolve/anchor_check.h"

#include "base/status.h"
#include "base/vec3.h"
#include "capstan/step.h"
#include "evolve/ranges.h"
#include "geometry/obstacle.h"

static CpsStatus check_limit(const CpsPoint *point, bool has, double value, const char *what,
                             CpsError *err) {
    if (!has || (cpsi_is_usable(value) && value > 0)) return CPS_OK;
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "point '%s': %s of %g N, expected a finite number above 0", point->name, what,
                     value);
}

/* An anchor drags in a plane: it does not begin on anything else. */
static CpsStatus check_ground(const CpsScene *scene, const CpsPoint *point, double length,
                              CpsError *err) {
    for (int k = 0; k < scene->obstacle_count; k++) {
        const CpsObstacle *obstacle = &scene->obstacle[k];
        if (obstacle->kind == CPS_OBSTACLE_PLANE) continue;
        const CpsiObstacle on = cpsi_obstacle(obstacle);
        if (cpsi_obstacle_gap(&on, vec3_load(point->position)) > CPS_TOUCH * length) continue;
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "point '%s': it drags, but lies on obstacle '%s', which is %s: expected "
                         "a plane, or a place off all obstacles",
                         point->name, obstacle->name,
                         cpsi_obstacle_is_round(&on) ? "round" : "not a plane");
    }
    return CPS_OK;
}

CpsStatus cpsi_anchor_check(const CpsScene *scene, const CpsPoint *point, double length,
                            CpsError *err) {
    const bool is_anchor = point->has_holding_capacity || point->has_uplift_limit || point->drags;
    if (!is_anchor) return CPS_OK;
    if (point->kind != CPS_POINT_KIND_HELD)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "point '%s': it has the limits of an anchor, but is not held",
                         point->name);
    CpsStatus status = check_limit(point, point->has_holding_capacity, point->holding_capacity,
                                   "a holding capacity", err);
    if (status == CPS_OK)
        status = check_limit(point, point->has_uplift_limit, point->uplift_limit, "an uplift limit",
                             err);
    if (status != CPS_OK || !point->drags) return status;
    if (!point->has_holding_capacity)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "point '%s': it drags, but has no holding capacity: give it one",
                         point->name);
    return check_ground(scene, point, length, err);
}
