/* SPDX-License-Identifier: BSD-3-Clause */
/* The points of a scene in result.nc (see netcdf_obstacles.h): two tables, of the numbers and of
 * the vectors of their reports; and the nodes that are grasped, for which a line has CPS_MAX_GRASPS
 * places, of which the first ones are taken in a step. No name of a line's field ends in
 * "of_point", so that none of these names is taken, whatever a line is called. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/base/text/columns.h"
#include "io/results/netcdf/netcdf_obstacles.h"

enum { XYZ = 3 };

static const struct {
    const char *name, *long_name, *units;
    size_t offset;
} VECTOR[CPSI_POINT_VECTORS] = {
    {"position_of_point", "where the point is", "m", offsetof(CpsPointReport, position)},
    {"lines_of_point", "sum of the forces of the lines on it", "N",
     offsetof(CpsPointReport, lines)},
    {"load_of_point", "force and weight of a free point", "N", offsetof(CpsPointReport, load)},
    {"support_of_point", "what holds a held point", "N", offsetof(CpsPointReport, support)},
    {"normal_of_point", "normal of the obstacle that it touches, 0: it touches none", "1",
     offsetof(CpsPointReport, normal)},
    {"friction_of_point", "friction of that obstacle on it", "N",
     offsetof(CpsPointReport, friction)},
    {"slip_of_point", "slip on that obstacle in the step", "m", offsetof(CpsPointReport, slip)},
    {"residual_of_point", "sum of all forces on it", "N", offsetof(CpsPointReport, residual)},
};

static const struct {
    const char *name, *long_name, *units;
    CpsiMember member;
} NUMBER[CPSI_POINT_NUMBERS] = {
    {"reaction_of_point", "reaction of that obstacle along the normal", "N",
     CPSI_MEMBER(CpsPointReport, reaction)},
    {"dissipated_of_point", "energy dissipated by its friction in the step", "J",
     CPSI_MEMBER(CpsPointReport, dissipated)},
};

typedef enum PointInt { POINT_STATE, POINT_OBSTACLE, POINT_TRIALS, POINT_HAS_PLACE } PointInt;

static const struct {
    const char *name, *long_name;
} WHOLE[CPSI_POINT_INTS] = {
    [POINT_STATE] = {"state_of_point", "what holds the point"},
    [POINT_OBSTACLE] = {"obstacle_of_point",
                        "place of the obstacle that it touches in the scene, -1: none"},
    [POINT_TRIALS] = {"trials_of_point", "places tried in the step"},
    [POINT_HAS_PLACE] = {"has_place_of_point", "was a place found where the forces balance"},
};

static void define_names(CpsiNetcdfFile *file, const CpsScene *scene) {
    size_t size = 1;
    for (int k = 0; k < scene->point_count; ++k) size += strlen(scene->point[k].name) + 1;
    char *names = calloc(size, 1), *next = names;
    if (!names) cpsi_netcdf_keep(file, NC_ENOMEM);
    if (names)
        for (int k = 0; k < scene->point_count; ++k)
            next += snprintf(next, size - (size_t)(next - names), "%s%s", k ? " " : "",
                             scene->point[k].name);
    cpsi_netcdf_text(file, NC_GLOBAL, "points", names ? names : "");
    free(names);
}

void cpsi_netcdf_define_points(CpsiNetcdfFile *file, CpsiNetcdfPoints *points,
                               const CpsScene *scene, int step, int xyz) {
    points->count = scene->point_count;
    if (scene->point_count == 0) return; /* a dimension of no length would be an unlimited one */
    define_names(file, scene);
    points->dimension = cpsi_netcdf_dimension(file, "point", (size_t)scene->point_count);
    const int shape[] = {step, points->dimension, xyz};
    points->kind =
        cpsi_netcdf_variable(file, "", "kind_of_point", NC_INT, 1, &points->dimension,
                             "how the point begins; state_of_point says how it goes on", "1");
    cpsi_netcdf_flags(file, points->kind, NC_INT, 2, NULL, "held free");
    points->weight =
        cpsi_netcdf_variable(file, "", "weight_of_point", NC_DOUBLE, 1, &points->dimension,
                             "weight under the gravity of the scene, negative: it is lifted", "N");
    for (int i = 0; i < CPSI_POINT_VECTORS; ++i)
        points->vector[i] = cpsi_netcdf_variable(file, "", VECTOR[i].name, NC_DOUBLE, 3, shape,
                                                 VECTOR[i].long_name, VECTOR[i].units);
    for (int i = 0; i < CPSI_POINT_NUMBERS; ++i)
        points->number[i] = cpsi_netcdf_variable(file, "", NUMBER[i].name, NC_DOUBLE, 2, shape,
                                                 NUMBER[i].long_name, NUMBER[i].units);
    for (int i = 0; i < CPSI_POINT_INTS; ++i)
        points->whole[i] = cpsi_netcdf_variable(file, "", WHOLE[i].name, NC_INT, 2, shape,
                                                WHOLE[i].long_name, "1");
    cpsi_netcdf_flags(file, points->whole[POINT_STATE], NC_INT, 4, NULL, "held free stick slip");
    cpsi_netcdf_flags(file, points->whole[POINT_HAS_PLACE], NC_INT, 2, NULL, "no yes");
}

void cpsi_netcdf_write_points(CpsiNetcdfFile *file, const CpsiNetcdfPoints *points,
                              const CpsScene *scene) {
    for (size_t k = 0; k < (size_t)points->count; ++k) {
        static const size_t ONE[] = {1};
        cpsi_netcdf_int(file, points->kind, &k, (int)scene->point[k].kind);
        cpsi_netcdf_doubles(file, points->weight, &k, ONE, &scene->point[k].weight);
    }
}

static void append_point(CpsiNetcdfFile *file, const CpsiNetcdfPoints *points, size_t step,
                         size_t k, const CpsPointReport *report, const double origin[XYZ]) {
    const size_t start[] = {step, k, 0}, count[] = {1, 1, XYZ};
    for (int i = 0; i < CPSI_POINT_VECTORS; ++i) {
        double value[XYZ];
        memcpy(value, (const char *)report + VECTOR[i].offset, sizeof value);
        if (VECTOR[i].offset == offsetof(CpsPointReport, position))
            for (int a = 0; a < XYZ; ++a) value[a] -= origin[a];
        cpsi_netcdf_doubles(file, points->vector[i], start, count, value);
    }
    for (int i = 0; i < CPSI_POINT_NUMBERS; ++i) {
        const double value = cpsi_member(report, NUMBER[i].member);
        cpsi_netcdf_doubles(file, points->number[i], start, count, &value);
    }
    const int whole[CPSI_POINT_INTS] = {[POINT_STATE] = (int)report->state,
                                        [POINT_OBSTACLE] = report->obstacle,
                                        [POINT_TRIALS] = report->trial_count,
                                        [POINT_HAS_PLACE] = report->has_place};
    for (int i = 0; i < CPSI_POINT_INTS; ++i)
        cpsi_netcdf_int(file, points->whole[i], start, whole[i]);
}

void cpsi_netcdf_append_points(CpsiNetcdfFile *file, const CpsiNetcdfPoints *points, size_t step,
                               const CpsEvolution *evolution, const double origin[XYZ]) {
    for (int k = 0; k < points->count && file->status == NC_NOERR; ++k) {
        const CpsPointReport report = cps_evolution_point_report(evolution, k);
        append_point(file, points, step, (size_t)k, &report, origin);
    }
}

static bool grasps(const CpsScene *scene, int line) {
    for (int i = 0; i < scene->stage_count; ++i)
        for (int k = 0; k < scene->stage[i].grasp_change_count; ++k)
            if (scene->stage[i].grasp_change[k].line == line) return true;
    return false;
}

void cpsi_netcdf_define_grasps(CpsiNetcdfFile *file, CpsiNetcdfGrasps *ids, const CpsScene *scene,
                               int line, int step, int xyz) {
    const char *of = scene->line[line].name;
    char name[NC_MAX_NAME + 1];
    ids->is_there = grasps(scene, line);
    if (!ids->is_there) return;
    snprintf(name, sizeof name, "%.200s_grasp", of);
    const int on[] = {step, cpsi_netcdf_dimension(file, name, CPS_MAX_GRASPS), xyz};
    ids->node = cpsi_netcdf_variable(file, of, "grasp_node", NC_INT, 2, on,
                                     "node that is held or pulled, -1: none", "1");
    ids->kind = cpsi_netcdf_variable(file, of, "grasp_kind", NC_BYTE, 2, on,
                                     "what is imposed on that node", "1");
    cpsi_netcdf_flags(file, ids->kind, NC_BYTE, 2, NULL, "held free");
    ids->held_position = cpsi_netcdf_variable(file, of, "grasp_held_position", NC_DOUBLE, 3, on,
                                              "imposed position of a node that is held", "m");
    ids->applied_force = cpsi_netcdf_variable(file, of, "grasp_applied_force", NC_DOUBLE, 3, on,
                                              "imposed force on a node that is pulled", "N");
    ids->force = cpsi_netcdf_variable(file, of, "grasp_force", NC_DOUBLE, 3, on,
                                      "force on the line at that node", "N");
    cpsi_netcdf_may_miss(file, ids->held_position);
    cpsi_netcdf_may_miss(file, ids->applied_force);
    cpsi_netcdf_may_miss(file, ids->force);
}

void cpsi_netcdf_append_grasps(CpsiNetcdfFile *file, const CpsiNetcdfGrasps *ids, size_t step,
                               const CpsLineView *view) {
    if (!ids->is_there) return;
    const size_t start[] = {step, 0, 0}, count[] = {1, CPS_MAX_GRASPS, XYZ};
    int node[CPS_MAX_GRASPS];
    unsigned char kind[CPS_MAX_GRASPS];
    double held[CPS_MAX_GRASPS][XYZ], applied[CPS_MAX_GRASPS][XYZ], force[CPS_MAX_GRASPS][XYZ];
    for (int k = 0; k < CPS_MAX_GRASPS; ++k) {
        const bool is = k < view->grasp_count;
        const CpsGrasp *grasp = &view->grasp[is ? k : 0];
        node[k] = is ? grasp->node : -1;
        kind[k] = !is || grasp->imposed.kind == CPS_END_KIND_FREE;
        for (int a = 0; a < XYZ; ++a) {
            held[k][a] = kind[k] ? NAN : grasp->imposed.value[a];
            applied[k][a] = is && kind[k] ? grasp->imposed.value[a] : NAN;
            force[k][a] = is ? grasp->force[a] : NAN;
        }
    }
    cpsi_netcdf_ints(file, ids->node, start, count, node);
    cpsi_netcdf_bytes(file, ids->kind, start, count, kind);
    cpsi_netcdf_doubles(file, ids->held_position, start, count, held[0]);
    cpsi_netcdf_doubles(file, ids->applied_force, start, count, applied[0]);
    cpsi_netcdf_doubles(file, ids->force, start, count, force[0]);
}
