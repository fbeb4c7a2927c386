/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that are shifted (shifts.h). */
#include "evolve/shifts.h"

#include <math.h>
#include <stdio.h>

#include "base/status.h"
#include "evolve/ranges.h"

/* Limit of a shift in one stage, in radii of a round obstacle, which takes a substep for each
 * quarter of one. */
static const double MOST_RADII = 1e4;

/* Depth below the surface that still counts as touching, per length of the line. */
static const double PATH_TOUCH = 1e-9;

CpsStatus cpsi_stage_shifts_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                  CpsError *err) {
    if (stage->shift_count < 0 || (stage->shift_count > 0 && !stage->shift))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: found %d shifts, expected 0 or more", what,
                         stage->shift_count);
    for (int i = 0; i < stage->shift_count; i++) {
        const CpsShift *shift = &stage->shift[i];
        if (shift->obstacle < 0 || shift->obstacle >= scene->obstacle_count)
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: shift %d names obstacle %d: there are %d",
                             what, i + 1, shift->obstacle, scene->obstacle_count);
        const CpsObstacle *obstacle = &scene->obstacle[shift->obstacle];
        char place[80];
        snprintf(place, sizeof place, "%s.move", obstacle->name);
        if (!obstacle->moves)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: obstacle '%s' is shifted, but stays in its place: say that it "
                                "moves",
                                what, obstacle->name);
        if (!cpsi_are_usable(shift->by))
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: obstacle '%s' is shifted by (%g, %g, %g), expected finite "
                                "numbers",
                                what, obstacle->name, shift->by[0], shift->by[1], shift->by[2]);
        if (obstacle->kind != CPS_OBSTACLE_PLANE &&
            vec3_norm(vec3_load(shift->by)) > MOST_RADII * obstacle->radius)
            return CPSI_FAIL_AT(place, err, CPS_ERR_LIMIT,
                                "%s: obstacle '%s' is shifted by %g m, the limit is %g radii", what,
                                obstacle->name, vec3_norm(vec3_load(shift->by)), MOST_RADII);
        for (int k = 0; k < i; k++)
            if (stage->shift[k].obstacle == shift->obstacle)
                return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                    "%s: obstacle '%s' is shifted twice", what, obstacle->name);
    }
    return CPS_OK;
}

/* What is held goes from one place to another, relative to the origin. */
static CpsStatus check_held(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                            const CpsiLine *line, int node, Vec3 from, Vec3 to, const char *what,
                            CpsError *err) {
    for (int k = 0; k < evolution->obstacle_count; k++) {
        const CpsiObstacle *obstacle = &evolution->obstacle[k];
        if (!obstacle->moves) continue;
        Vec3 by = vec3(0, 0, 0);
        for (int i = 0; i < stage->shift_count; i++)
            if (stage->shift[i].obstacle == k) by = vec3_load(stage->shift[i].by);
        /* as seen from the obstacle */
        const double depth = cpsi_obstacle_depth(obstacle, from, vec3_sub(to, by)),
                     before = -cpsi_obstacle_gap(obstacle, from);
        if (!(depth > fmax(PATH_TOUCH * line->length, before))) continue;
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: node %d of line '%s' is held in the way of obstacle '%s', up to %g m "
                         "deep: move one of them round the other",
                         what, node, line->name, evolution->given_obstacle[k].name, depth);
    }
    return CPS_OK;
}

CpsStatus cpsi_shifts_check(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                            const char *what, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int i = 0; i < evolution->line_count && status == CPS_OK; i++) {
        const CpsiLine *line = &evolution->line[i];
        for (int end = 0; end < 2 && status == CPS_OK; end++) {
            const int node = end == CPS_END_A ? 0 : line->n - 1;
            const Vec3 from = vec3_at(line->position, node);
            bool held = line->end[end].kind == CPS_END_KIND_HELD;
            Vec3 to = from;
            for (int k = 0; k < stage->change_count; k++) {
                const CpsChange *change = &stage->change[k];
                if (change->line != i || change->end != end) continue;
                held = change->to.kind == CPS_END_KIND_HELD;
                if (held) to = vec3_load(change->to.value);
            }
            if (held) status = check_held(evolution, stage, line, node, from, to, what, err);
        }
        for (int j = 1; j + 1 < line->n && status == CPS_OK; j++) {
            const Vec3 from = vec3_at(line->position, j);
            bool held = line->grasp_count > 0 && cpsi_line_grasp_holds(line, j);
            Vec3 to = from;
            for (int k = 0; k < stage->grasp_change_count; k++) {
                const CpsGraspChange *change = &stage->grasp_change[k];
                if (change->line != i || change->node != j) continue;
                held = change->kind == CPS_END_KIND_HELD;
                if (held && !change->stays) to = vec3_load(change->value);
            }
            if (held) status = check_held(evolution, stage, line, j, from, to, what, err);
        }
    }
    return status;
}
