/* SPDX-License-Identifier: BSD-3-Clause */
/* Check of the paths of held ends against the obstacles (path_check.h). */
#include "evolve/path_check.h"

#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "evolve/origin.h"
#include "evolve/start.h"

/* Positions of both ends of a line; NaN while an end is free, as its position is then not known
 * before the scene is solved. */
typedef struct Places {
    double end[2][3];
} Places;

double cpsi_path_depth(const CpsiObstacle *obstacle, Vec3 from, Vec3 to, double touch) {
    const double depth = cpsi_obstacle_depth(obstacle, from, to);
    return depth > fmax(touch, -cpsi_obstacle_gap(obstacle, from)) ? depth : 0;
}

static CpsStatus check_path(const CpsScene *scene, int stage, const CpsChange *change,
                            const double *from, CpsError *err) {
    const CpsLine *line = &scene->line[change->line];
    const double *to = change->to.value;
    for (int k = 0; k < scene->obstacle_count; k++) {
        const CpsiObstacle obstacle = cpsi_obstacle(&scene->obstacle[k]);
        const double touch =
            CPSI_PATH_TOUCH * line->length + cpsi_place_rounding(line->length, vec3_load(to));
        const double depth = cpsi_path_depth(&obstacle, vec3_load(from), vec3_load(to), touch);
        if (!(depth > 0)) continue;
        const char *end = change->end == CPS_END_A ? "A" : "B";
        cpsi_fail(err, CPS_ERR_ARGUMENT,
                  "stage %d: %s.%s goes straight from (%g, %g, %g) m to (%g, %g, %g) m, through "
                  "obstacle '%s', up to %g m deep: add way points around it",
                  stage + 1, line->name, end, from[0], from[1], from[2], to[0], to[1], to[2],
                  scene->obstacle[k].name, depth);
        return cpsi_fail_inside(err, CPS_ERR_ARGUMENT, "history[%d].%s.%s", stage + 1, line->name,
                                end);
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
            if (held && !isnan(at[0])) status = check_path(scene, k, change, at, err);
            memcpy(at, change->to.value, sizeof place->end[0]);
            if (!held) at[0] = NAN;
        }
    }
    free(place);
    return status;
}
