/* SPDX-License-Identifier: BSD-3-Clause */
/* Positions of a scene beside its obstacles (places.h). */
#include "evolve/places.h"

#include <math.h>

#include "evolve/origin.h"
#include "geometry/obstacle.h"

/* Per length of the line. */
static const double PLACE_TOLERANCE = 1e-9;

double cpsi_scene_height(const CpsScene *scene, Vec3 x, bool at_start, const char **name) {
    double least = INFINITY;
    for (int k = 0; k < scene->obstacle_count; k++) {
        if ((scene->obstacle[k].moves && !at_start) || scene->obstacle[k].stiffness > 0) continue;
        const CpsiObstacle obstacle = cpsi_obstacle(&scene->obstacle[k]);
        const double gap = cpsi_obstacle_gap(&obstacle, x);
        if (gap < least) {
            least = gap;
            *name = scene->obstacle[k].name;
        }
    }
    return least;
}

double cpsi_place_tolerance(const CpsLine *line, Vec3 x) {
    return PLACE_TOLERANCE * line->length + cpsi_place_rounding(line->length, x);
}
