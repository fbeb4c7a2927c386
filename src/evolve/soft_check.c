/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of obstacles that give (soft_check.h). */
#include "evolve/soft_check.h"

#include "base/status.h"
#include "evolve/ranges.h"

/* Can a point be free in the history, or drag? Then it bears on the ground, by an area of its own
 * that is not known; what is held, or on a body, does not. */
static bool may_bear(const CpsScene *scene) {
    bool any = false;
    for (int i = 0; i < scene->point_count; i++)
        any = any || scene->point[i].kind == CPS_POINT_KIND_FREE || scene->point[i].drags;
    const int stages =
        scene->stage ? scene->stage_count : 0; /* also asked before they are checked */
    for (int k = 0; k < stages; k++)
        for (int i = 0; i < scene->stage[k].point_change_count; i++)
            any = any || scene->stage[k].point_change[i].kind == CPS_POINT_KIND_FREE;
    return any;
}

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
    else if (may_bear(scene))
        why = "there are free points, or anchors that drag, of which no bearing area is known: "
              "hold them";
    if (!why) return CPS_OK;
    return CPSI_FAIL_AT("stiffness", err, CPS_ERR_ARGUMENT,
                        "obstacle '%s': stiffness: it gives, but %s, or leave the stiffness out",
                        o->name, why);
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
    if (line->winch[CPS_END_A].is_there || line->winch[CPS_END_B].is_there)
        return CPSI_FAIL_AT("ends", err, CPS_ERR_ARGUMENT,
                            "line '%s': stored: obstacle '%s' gives (stiffness), and lines on it "
                            "have no winch: leave one of them out",
                            line->name, soft->name);
    return CPS_OK;
}
