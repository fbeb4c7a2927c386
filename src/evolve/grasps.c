/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes that are held, pulled and let go (grasps.h).
 *
 * A line has a list of them in the order of the nodes. The first step of a stage makes the list for
 * the stage: nodes that were let go and have come to no force are dropped, those that the stage
 * changes are added. */
#include "evolve/grasps.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "evolve/path_check.h"
#include "evolve/places.h"
#include "evolve/ranges.h"

/* check ---------------------------------------------------------------------------------------- */

static CpsStatus check_change(const CpsScene *scene, const CpsStage *stage, int index,
                              const char *what, CpsError *err) {
    const CpsGraspChange *change = &stage->grasp_change[index];
    if (change->line < 0 || change->line >= scene->line_count)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: grasp %d names line %d: there are %d", what,
                         index + 1, change->line, scene->line_count);
    const CpsLine *line = &scene->line[change->line];
    const double *v = change->value;
    const bool held = change->kind == CPS_END_KIND_HELD;
    char place[80];
    snprintf(place, sizeof place, "%s.node", line->name);
    if (change->node < 1 || change->node >= line->element_count)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: node %d of line '%s' cannot be grasped: nodes between its ends "
                            "are 1 to %d",
                            what, change->node, line->name, line->element_count - 1);
    for (int i = 0; i < index; i++)
        if (stage->grasp_change[i].line == change->line &&
            stage->grasp_change[i].node == change->node)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: node %d of line '%s' is changed twice", what, change->node,
                                line->name);
    if (!held && change->kind != CPS_END_KIND_FREE)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: node %d of line '%s' has the unknown kind %d", what, change->node,
                            line->name, (int)change->kind);
    if ((change->stays && !held) || (change->at_once && held))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: node %d of line '%s': only what is held stays, and only a force "
                            "is there at once",
                            what, change->node, line->name);
    if (change->stays) return CPS_OK;
    if (!cpsi_are_usable(v))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: node %d of line '%s' gets (%g, %g, %g), expected finite numbers",
                            what, change->node, line->name, v[0], v[1], v[2]);
    const char *name = "";
    const double above = held ? cpsi_scene_height(scene, vec3_load(v), false, &name) : INFINITY;
    if (!(above >= -cpsi_place_tolerance(line, vec3_load(v))))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: node %d of line '%s' is moved to %g m below obstacle '%s'", what,
                            change->node, line->name, -above, name);
    return CPS_OK;
}

CpsStatus cpsi_grasp_changes_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                   CpsError *err) {
    const int count = stage->grasp_change_count, most = CPSI_GRASP_CHANGES * scene->line_count;
    if (count < 0 || (count > 0 && !stage->grasp_change))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: found %d grasps, expected 0 or more", what,
                         count);
    if (count > most)
        return cpsi_fail(err, CPS_ERR_LIMIT, "%s: %d nodes are grasped or let go, the limit is %d",
                         what, count, most);
    CpsStatus status = CPS_OK;
    for (int i = 0; i < count && status == CPS_OK; i++)
        status = check_change(scene, stage, i, what, err);
    return status;
}

/* The change of a node in a stage, or NULL. */
static const CpsGraspChange *change_of(const CpsiEvolutionStage *stage, int line, int node) {
    for (int i = 0; i < stage->grasp_change_count; i++)
        if (stage->grasp_change[i].line == line && stage->grasp_change[i].node == node)
            return &stage->grasp_change[i];
    return NULL;
}

static bool is_let_go(const CpsGrasp *grasp) {
    const double *force = grasp->imposed.value;
    return grasp->imposed.kind == CPS_END_KIND_FREE && force[0] == 0 && force[1] == 0 &&
           force[2] == 0;
}

/* The place of a node in the list, or -1. */
static int find(const CpsiLine *line, int node) {
    for (int k = 0; k < line->grasp_count; k++)
        if (line->grasp[k].node == node) return k;
    return -1;
}

/* How many nodes of a line are in its list in the stage. */
static int count_after(const CpsiLine *line, const CpsiEvolutionStage *stage, int index) {
    int count = 0;
    for (int k = 0; k < line->grasp_count; k++)
        count += !is_let_go(&line->grasp[k]) || change_of(stage, index, line->grasp[k].node);
    for (int i = 0; i < stage->grasp_change_count; i++)
        count +=
            stage->grasp_change[i].line == index && find(line, stage->grasp_change[i].node) < 0;
    return count;
}

CpsStatus cpsi_grasps_check(const CpsEvolution *evolution, const CpsScene *scene,
                            const CpsiEvolutionStage *stage, const char *what, CpsError *err) {
    for (int i = 0; i < stage->grasp_change_count; i++) {
        CpsGraspChange change = stage->grasp_change[i];
        const CpsiLine *line = &evolution->line[change.line];
        const int count = count_after(line, stage, change.line);
        if (count > CPS_MAX_GRASPS)
            return cpsi_fail(err, CPS_ERR_LIMIT,
                             "%s: %d nodes of line '%s' are held or pulled, the limit is %d", what,
                             count, line->name, (int)CPS_MAX_GRASPS);
        if (change.kind != CPS_END_KIND_HELD || change.stays) continue;
        double from[3];
        for (int a = 0; a < 3; a++) {
            from[a] = line->position[3 * change.node + a] + evolution->origin[a];
            change.value[a] += evolution->origin[a];
        }
        const CpsStatus status = cpsi_path_check_grasp(scene, &change, from, what, err);
        if (status != CPS_OK) return status;
    }
    return CPS_OK;
}

/* plan ----------------------------------------------------------------------------------------- */

CpsEnd cpsi_stage_value(const CpsEnd *from, const CpsEnd *to, double share) {
    if (!(share > 0)) return *from;
    if (!(share < 1)) return *to;
    CpsEnd at = *to;
    for (int a = 0; a < 3; a++)
        at.value[a] = from->value[a] + share * (to->value[a] - from->value[a]);
    return at;
}

/* [N] What the obstacles do to node j, which whatever grasps it takes over. */
static Vec3 borne_by_obstacles(const CpsiLine *line, int j) {
    Vec3 sum = vec3(0, 0, 0);
    for (int c = j; c < cpsi_line_contacts(line); c += line->n) {
        const Vec3 push = vec3_scale(line->reaction[c], vec3_at(line->normal, c));
        sum = vec3_add(sum, vec3_add(push, vec3_at(line->friction_force, c)));
    }
    return sum;
}

static void drop(CpsiLine *line, int k) {
    line->grasp_count--;
    memmove(&line->grasp[k], &line->grasp[k + 1],
            (size_t)(line->grasp_count - k) * sizeof *line->grasp);
}

/* Add a node on which there is no force yet. */
static void insert(CpsiLine *line, int node) {
    int k = 0;
    while (k < line->grasp_count && line->grasp[k].node < node) k++;
    memmove(&line->grasp[k + 1], &line->grasp[k],
            (size_t)(line->grasp_count - k) * sizeof *line->grasp);
    line->grasp_count++;
    line->grasp[k] = (CpsGrasp){.node = node, .imposed = {.kind = CPS_END_KIND_FREE}};
}

/* Where the change of a node begins. */
static CpsEnd begin(const CpsiLine *line, const CpsGrasp *grasp, const CpsGraspChange *change) {
    CpsEnd from = {.kind = change->kind};
    if (change->at_once)
        memcpy(from.value, change->value, sizeof from.value);
    else if (change->kind == grasp->imposed.kind)
        from = grasp->imposed;
    else if (change->kind == CPS_END_KIND_HELD)
        memcpy(from.value, &line->position[3 * grasp->node], sizeof from.value);
    else
        memcpy(from.value, grasp->force, sizeof from.value);
    return from;
}

/* The list of a line for a stage that begins. */
static void begin_list(CpsiLine *line, const CpsiEvolutionStage *stage, int index) {
    for (int k = line->grasp_count; k-- > 0;)
        if (is_let_go(&line->grasp[k]) && !change_of(stage, index, line->grasp[k].node))
            drop(line, k);
    for (int i = 0; i < stage->grasp_change_count; i++) {
        const CpsGraspChange *change = &stage->grasp_change[i];
        if (change->line == index && find(line, change->node) < 0) insert(line, change->node);
    }
    for (int k = 0; k < line->grasp_count; k++) {
        CpsGrasp *grasp = &line->grasp[k];
        const CpsGraspChange *change = change_of(stage, index, grasp->node);
        line->grasp_from[k] = change ? begin(line, grasp, change) : grasp->imposed;
        if (!change || change->kind == grasp->imposed.kind || change->kind == CPS_END_KIND_FREE)
            continue;
        const Vec3 own = vec3_load(grasp->force), borne = borne_by_obstacles(line, grasp->node);
        vec3_store(grasp->force, vec3_add(own, borne));
    }
}

void cpsi_grasps_plan(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                      const CpsiPortion *portion) {
    for (int i = 0; i < evolution->line_count; i++) {
        CpsiLine *line = &evolution->line[i];
        CpsiMove *move = &evolution->move[i];
        if (portion->part == 0 && (line->grasp_count > 0 || stage->grasp_change_count > 0))
            begin_list(line, stage, i);
        move->grasp_count = line->grasp_count;
        for (int k = 0; k < line->grasp_count; k++) {
            const CpsGraspChange *change = change_of(stage, i, line->grasp[k].node);
            const CpsEnd *from = &line->grasp_from[k];
            CpsEnd to = *from;
            if (change && !change->stays) memcpy(to.value, change->value, sizeof to.value);
            move->grasp_from[k] = cpsi_stage_value(from, &to, portion->from);
            move->grasp_to[k] = cpsi_stage_value(from, &to, portion->to);
        }
    }
}

bool cpsi_grasps_are_sound(const CpsiLine *line) {
    if (line->grasp_count < 0 || line->grasp_count > CPS_MAX_GRASPS) return false;
    for (int k = 0; k < line->grasp_count; k++) {
        const CpsGrasp *grasp = &line->grasp[k];
        const int after = k > 0 ? line->grasp[k - 1].node : 0;
        const CpsEndKind kinds[] = {grasp->imposed.kind, line->grasp_from[k].kind};
        if (!(grasp->node > after && grasp->node < line->n - 1)) return false;
        for (int i = 0; i < 2; i++)
            if (kinds[i] != CPS_END_KIND_HELD && kinds[i] != CPS_END_KIND_FREE) return false;
        for (int a = 0; a < 3; a++)
            if (!isfinite(grasp->imposed.value[a]) || !isfinite(grasp->force[a]) ||
                !isfinite(line->grasp_from[k].value[a]))
                return false;
    }
    return true;
}
