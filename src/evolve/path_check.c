/* SPDX-License-Identifier: BSD-3-Clause */
/* Check of the paths of held ends against the obstacles (path_check.h). */
#include "evolve/path_check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "evolve/origin.h"
#include "evolve/points.h"
#include "evolve/ranges.h"
#include "evolve/start.h"
#include "geometry/obstacle.h"

/* Depth below the surface that still counts as touching, per length of the line. */
static const double PATH_TOUCH = 1e-9;

/* Positions of both ends of a line; NaN while an end is free, as its position is then not known
 * before the scene is solved. */
typedef struct Places {
    double end[2][3];
} Places;

/* [m] Depth of the straight path in the obstacle, if it exceeds `touch` and the depth of its first
 * point; else 0. */
static double path_depth(const CpsiObstacle *obstacle, Vec3 from, Vec3 to, double touch) {
    if (obstacle->stiffness > 0) return 0;
    const double depth = cpsi_obstacle_depth(obstacle, from, to);
    return depth > fmax(touch, -cpsi_obstacle_gap(obstacle, from)) ? depth : 0;
}

/* Check the path of `name`, an end or a point, of lines up to `length` [m] long. */
static CpsStatus check_path(const CpsScene *scene, const char *name, double length,
                            const double from[3], const double to[3], bool grabbed,
                            const char *what, CpsError *err) {
    for (int k = 0; k < scene->obstacle_count; k++) {
        if (scene->obstacle[k].moves) continue; /* shifts.h */
        const CpsiObstacle obstacle = cpsi_obstacle(&scene->obstacle[k]);
        const double touch = PATH_TOUCH * length + cpsi_place_rounding(length, vec3_load(to));
        if (!cpsi_obstacle_covers(&obstacle, vec3_load(to), CPS_TOUCH * length))
            return cpsi_fail(
                err, CPS_ERR_ARGUMENT,
                "%s: %s goes to (%g, %g, %g) m, beyond the grid of ground '%s': take a "
                "larger grid, or say that it extends",
                what, name, to[0], to[1], to[2], scene->obstacle[k].name);
        const double depth = path_depth(&obstacle, vec3_load(from), vec3_load(to), touch);
        if (!(depth > 0)) continue;
        cpsi_fail(err, CPS_ERR_ARGUMENT,
                  "%s: %s %s (%g, %g, %g) m %s (%g, %g, %g) m, through obstacle '%s', up to %g m "
                  "deep: add way points around it",
                  what, name, grabbed ? "is grabbed at" : "goes straight from", from[0], from[1],
                  from[2], grabbed ? "and goes straight to" : "to", to[0], to[1], to[2],
                  scene->obstacle[k].name, depth);
        return cpsi_fail_inside(err, CPS_ERR_ARGUMENT, "%s", name);
    }
    return CPS_OK;
}

CpsStatus cpsi_path_check_change(const CpsScene *scene, const CpsChange *change,
                                 const double from[3], bool grabbed, const char *what,
                                 CpsError *err) {
    const CpsLine *line = &scene->line[change->line];
    char name[80];
    snprintf(name, sizeof name, "%s.%s", line->name, cpsi_end_letter(change->end));
    return check_path(scene, name, line->length, from, change->to.value, grabbed, what, err);
}

CpsStatus cpsi_path_check_point(const CpsScene *scene, const CpsPointChange *change, double length,
                                const double from[3], bool grabbed, const char *what,
                                CpsError *err) {
    char name[80];
    snprintf(name, sizeof name, "%s.point", scene->point[change->point].name);
    return check_path(scene, name, length, from, change->value, grabbed, what, err);
}

CpsStatus cpsi_path_check_grasp(const CpsScene *scene, const CpsGraspChange *change,
                                const double from[3], const char *what, CpsError *err) {
    const CpsLine *line = &scene->line[change->line];
    char name[80];
    snprintf(name, sizeof name, "%s.node %d", line->name, change->node);
    return check_path(scene, name, line->length, from, change->value, true, what, err);
}

CpsStatus cpsi_path_check_points(const CpsScene *scene, CpsError *err) {
    if (scene->obstacle_count == 0) return CPS_OK;
    for (int i = 0; i < scene->point_count; i++) {
        double at[3];
        bool known = scene->point[i].kind == CPS_POINT_KIND_HELD;
        memcpy(at, scene->point[i].position, sizeof at);
        for (int k = 0; k < scene->stage_count; k++)
            for (int c = 0; c < scene->stage[k].point_change_count; c++) {
                const CpsPointChange *change = &scene->stage[k].point_change[c];
                if (change->point != i) continue;
                const bool held = change->kind == CPS_POINT_KIND_HELD;
                char what[32];
                snprintf(what, sizeof what, "stage %d", k + 1);
                const CpsStatus status =
                    held && known
                        ? cpsi_path_check_point(scene, change, cpsi_longest_line(scene, i), at,
                                                false, what, err)
                        : CPS_OK;
                if (status != CPS_OK) return cpsi_fail_inside(err, status, "history[%d]", k + 1);
                known = held;
                memcpy(at, change->value, sizeof at);
            }
    }
    return CPS_OK;
}

CpsStatus cpsi_path_check(const CpsScene *scene, CpsError *err) {
    if (scene->obstacle_count == 0 || scene->stage_count == 0) return CPS_OK;
    Places *place = malloc((size_t)scene->line_count * sizeof *place);
    if (!place)
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the ends of %d lines",
                         scene->line_count);
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++) {
            cpsi_start_end(&scene->line[i], end, place[i].end[end]);
            if (scene->line[i].end[end].kind == CPS_END_KIND_FREE) place[i].end[end][0] = NAN;
        }
    CpsStatus status = CPS_OK;
    for (int k = 0; k < scene->stage_count && status == CPS_OK; k++) {
        const CpsStage *stage = &scene->stage[k];
        for (int i = 0; i < stage->change_count && status == CPS_OK; i++) {
            const CpsChange *change = &stage->change[i];
            double *at = place[change->line].end[change->end];
            const bool held = change->to.kind == CPS_END_KIND_HELD;
            if (held && !isnan(at[0])) {
                char what[32];
                snprintf(what, sizeof what, "stage %d", k + 1);
                status = cpsi_path_check_change(scene, change, at, false, what, err);
                cpsi_fail_inside(err, status, "history[%d]", k + 1);
            }
            memcpy(at, change->to.value, sizeof place->end[0]);
            if (!held) at[0] = NAN;
        }
    }
    free(place);
    return status;
}
