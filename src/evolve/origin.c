/* SPDX-License-Identifier: BSD-3-Clause */
/* The local origin of a scene (origin.h): the middle of the lines' positions, rounded, along those
 * axes only on which it is far away. */
#include "evolve/origin.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"

/* Lines within so many lengths of the origin keep it: their coordinates lose three digits at most,
 * and results of scenes near the origin do not change. */
static const double FAR = 512;
/* Rounding of two positions, in data and arithmetic, in units in the last place of their
 * coordinates. */
static const double ROUNDINGS = 8;

typedef struct Box {
    double low[3], high[3];
} Box;

/* NaN, an unknown position, is ignored. */
static void include(Box *box, const double x[3]) {
    for (int a = 0; a < 3; a++) {
        box->low[a] = fmin(box->low[a], x[a]);
        box->high[a] = fmax(box->high[a], x[a]);
    }
}

static Box places_of(const CpsScene *scene) {
    Box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 0; i < scene->line_count; i++) {
        const CpsLine *line = &scene->line[i];
        for (int k = 0; k < line->start.point_count; k++) include(&box, &line->start.point[3 * k]);
        for (int end = 0; end < 2; end++)
            if (line->end[end].kind == CPS_END_KIND_HELD) include(&box, line->end[end].value);
    }
    for (int i = 0; i < scene->point_count; i++)
        if (scene->point[i].kind != CPS_POINT_KIND_ON_BODY) include(&box, scene->point[i].position);
    for (int i = 0; i < scene->body_count; i++) include(&box, scene->body[i].position);
    return box;
}

static void find_origin(const CpsScene *scene, double origin[3]) {
    double length = 0;
    for (int i = 0; i < scene->line_count; i++) length = fmax(length, scene->line[i].length);
    const double unit = pow(10, ceil(log10(length)));
    const Box box = places_of(scene);
    for (int a = 0; a < 3; a++) {
        const double middle = 0.5 * (box.low[a] + box.high[a]);
        origin[a] = fabs(middle) > FAR * length ? round(middle / unit) * unit : 0;
    }
}

static void shift(double x[3], const double origin[3]) {
    for (int a = 0; a < 3; a++) x[a] -= origin[a];
}

static void shift_end(CpsEnd *end, const double origin[3]) {
    if (end->kind == CPS_END_KIND_HELD) shift(end->value, origin);
}

/* Copy data into a block of which `used` bytes are taken; all data in it have the alignment of a
 * double. */
static void *copy(char *block, size_t *used, const void *from, size_t size) {
    void *to = block + *used;
    if (size > 0) memcpy(to, from, size);
    *used += size;
    return to;
}

static size_t size_of(const CpsScene *scene) {
    size_t size = (size_t)scene->obstacle_count * sizeof(CpsObstacle) +
                  (size_t)scene->line_count * sizeof(CpsLine) +
                  (size_t)scene->stage_count * sizeof(CpsStage) +
                  (size_t)scene->point_count * sizeof(CpsPoint) +
                  (size_t)scene->body_count * sizeof(CpsBody);
    for (int i = 0; i < scene->line_count; i++)
        size += (size_t)scene->line[i].start.point_count * 3 * sizeof(double);
    for (int i = 0; i < scene->stage_count; i++)
        size += (size_t)scene->stage[i].change_count * sizeof(CpsChange) +
                (size_t)scene->stage[i].point_change_count * sizeof(CpsPointChange) +
                (size_t)scene->stage[i].body_change_count * sizeof(CpsBodyChange) +
                (size_t)scene->stage[i].grasp_change_count * sizeof(CpsGraspChange) +
                (size_t)scene->stage[i].shift_count * sizeof(CpsShift);
    return size;
}

CpsStatus cpsi_local_scene(const CpsScene *scene, CpsiLocalScene *out, CpsError *err) {
    *out = (CpsiLocalScene){.scene = *scene};
    double *origin = out->origin;
    find_origin(scene, origin);
    if (origin[0] == 0 && origin[1] == 0 && origin[2] == 0) return CPS_OK;
    char *block = out->block = malloc(size_of(scene));
    if (!block)
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the scene about a local origin");
    size_t used = 0;
    CpsObstacle *obstacle =
        copy(block, &used, scene->obstacle, (size_t)scene->obstacle_count * sizeof *obstacle);
    CpsLine *line = copy(block, &used, scene->line, (size_t)scene->line_count * sizeof *line);
    CpsStage *stage = copy(block, &used, scene->stage, (size_t)scene->stage_count * sizeof *stage);
    for (int k = 0; k < scene->obstacle_count; k++) shift(obstacle[k].point, origin);
    for (int i = 0; i < scene->line_count; i++) {
        const int points = line[i].start.point_count;
        double *point = copy(block, &used, line[i].start.point, (size_t)points * 3 * sizeof *point);
        for (int k = 0; k < points; k++) shift(&point[3 * k], origin);
        line[i].start.point = point;
        for (int end = 0; end < 2; end++) shift_end(&line[i].end[end], origin);
        for (int end = 0; end < 2; end++) shift(line[i].constraint[end].point, origin);
    }
    for (int i = 0; i < scene->stage_count; i++) {
        CpsChange *change =
            copy(block, &used, stage[i].change, (size_t)stage[i].change_count * sizeof *change);
        for (int k = 0; k < stage[i].change_count; k++) shift_end(&change[k].to, origin);
        stage[i].change = change;
        const int count = stage[i].point_change_count;
        CpsPointChange *at = copy(block, &used, stage[i].point_change, (size_t)count * sizeof *at);
        for (int k = 0; k < count; k++)
            if (at[k].kind == CPS_POINT_KIND_HELD) shift(at[k].value, origin);
        stage[i].point_change = at;
        const int bodies = stage[i].body_change_count;
        CpsBodyChange *to = copy(block, &used, stage[i].body_change, (size_t)bodies * sizeof *to);
        for (int k = 0; k < bodies; k++)
            if (to[k].kind == CPS_BODY_KIND_HELD) shift(to[k].position, origin);
        stage[i].body_change = to;
        const int grasps = stage[i].grasp_change_count;
        CpsGraspChange *grasp =
            copy(block, &used, stage[i].grasp_change, (size_t)grasps * sizeof *grasp);
        for (int k = 0; k < grasps; k++)
            if (grasp[k].kind == CPS_END_KIND_HELD) shift(grasp[k].value, origin);
        stage[i].grasp_change = grasp;
        const int shifts = stage[i].shift_count;
        CpsShift *moved = copy(block, &used, scene->stage[i].shift, (size_t)shifts * sizeof *moved);
        for (int k = 0; k < shifts; k++) shift(moved[k].about, origin);
        stage[i].shift = moved;
    }
    CpsPoint *point = copy(block, &used, scene->point, (size_t)scene->point_count * sizeof *point);
    for (int i = 0; i < scene->point_count; i++)
        if (point[i].kind != CPS_POINT_KIND_ON_BODY) {
            shift(point[i].position, origin);
            shift(point[i].constraint.point, origin);
        }
    out->scene.point = point;
    CpsBody *body = copy(block, &used, scene->body, (size_t)scene->body_count * sizeof *body);
    for (int i = 0; i < scene->body_count; i++) shift(body[i].position, origin);
    out->scene.body = body;
    out->scene.water_surface -= origin[2];
    out->scene.obstacle = obstacle;
    out->scene.line = line;
    out->scene.stage = stage;
    return CPS_OK;
}

void cpsi_local_scene_free(CpsiLocalScene *local) { free(local->block); }

double cpsi_place_rounding(double length, Vec3 x) {
    const double reach = fmax(fabs(x.x), fmax(fabs(x.y), fabs(x.z)));
    return reach > FAR * length ? ROUNDINGS * DBL_EPSILON * reach : 0;
}
