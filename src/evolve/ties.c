/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends at points (ties.h). */
#include "evolve/ties.h"

#include <math.h>

#include "base/status.h"
#include "evolve/ranges.h"
#include "geometry/obstacle.h"

void cpsi_longest_lines(const CpsScene *scene, double *longest) {
    for (int i = 0; i < scene->point_count; i++) longest[i] = 0;
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++) {
            const int point = cpsi_point_of(&scene->line[i], end);
            if (point >= 0 && point < scene->point_count)
                longest[point] = fmax(longest[point], scene->line[i].length);
        }
}

double cpsi_longest_line(const CpsScene *scene, int point) {
    double longest = 0;
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++)
            if (cpsi_point_of(&scene->line[i], end) == point)
                longest = fmax(longest, scene->line[i].length);
    return longest;
}

CpsStatus cpsi_isotropy_check(const CpsScene *scene, const char *what, const char *name,
                              CpsError *err) {
    for (int k = 0; k < scene->obstacle_count; k++) {
        const CpsiObstacle obstacle = cpsi_obstacle(&scene->obstacle[k]);
        if (!cpsi_obstacle_is_isotropic(&obstacle))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s '%s': it may come to rest on obstacle '%s', whose friction has "
                             "directions: a free %s needs one coefficient of friction",
                             what, name, scene->obstacle[k].name, what);
    }
    return CPS_OK;
}

CpsStatus cpsi_gravity_check(const CpsScene *scene, const char *what, const char *name,
                             bool has_weight, CpsError *err) {
    if (!has_weight || cpsi_is_direction(scene->gravity)) return CPS_OK;
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "%s '%s': it has a weight or a buoyancy, but gravity is zero and has no "
                     "direction: give the scene a gravity",
                     what, name);
}
