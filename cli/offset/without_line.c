/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene without one of its lines (without_line.h). */
#include "offset/without_line.h"

#include <stdlib.h>
#include <string.h>

enum { GONE = -1 };

/* The arrays of the scene, and the new index of each point. */
typedef struct Arrays {
    CpsLine *line;
    CpsPoint *point;
    CpsStage *stage;
    CpsChange *change;
    CpsPointChange *point_change;
    int *index;
} Arrays;

/* Place the arrays in one block, which is NULL while it is measured; returns its size. */
static size_t place(const CpsScene *scene, char *memory, Arrays *arrays) {
    size_t changes = 0, point_changes = 0, size = 0;
    for (int s = 0; s < scene->stage_count; ++s) {
        changes += (size_t)scene->stage[s].change_count;
        point_changes += (size_t)scene->stage[s].point_change_count;
    }
    const struct {
        void **to;
        size_t size;
    } part[] = {{(void **)&arrays->line, (size_t)scene->line_count * sizeof(CpsLine)},
                {(void **)&arrays->point, (size_t)scene->point_count * sizeof(CpsPoint)},
                {(void **)&arrays->stage, (size_t)scene->stage_count * sizeof(CpsStage)},
                {(void **)&arrays->change, changes * sizeof(CpsChange)},
                {(void **)&arrays->point_change, point_changes * sizeof(CpsPointChange)},
                {(void **)&arrays->index, (size_t)scene->point_count * sizeof(int)}};
    for (size_t i = 0; i < sizeof part / sizeof *part; ++i) {
        if (memory) *part[i].to = memory + size;
        size += (part[i].size + 15) / 16 * 16;
    }
    return size;
}

/* Number the points at which another line ends. */
static int number_points(const CpsScene *scene, int line, int *index) {
    for (int i = 0; i < scene->point_count; ++i) index[i] = GONE;
    for (int i = 0; i < scene->line_count; ++i)
        for (int end = 0; end < 2; ++end)
            if (i != line && scene->line[i].end[end].kind == CPS_END_KIND_POINT)
                index[scene->line[i].end_point[end]] = 0;
    int count = 0;
    for (int i = 0; i < scene->point_count; ++i)
        if (index[i] != GONE) index[i] = count++;
    return count;
}

static void copy_lines(const CpsScene *scene, int line, const Arrays *to) {
    CpsLine *next = to->line;
    for (int i = 0; i < scene->line_count; ++i) {
        if (i == line) continue;
        *next = scene->line[i];
        for (int end = 0; end < 2; ++end)
            if (next->end[end].kind == CPS_END_KIND_POINT)
                next->end_point[end] = to->index[next->end_point[end]];
        ++next;
    }
}

static void copy_stages(const CpsScene *scene, int line, const Arrays *to) {
    CpsChange *change = to->change;
    CpsPointChange *point_change = to->point_change;
    for (int s = 0; s < scene->stage_count; ++s) {
        const CpsStage *from = &scene->stage[s];
        CpsStage *stage = &to->stage[s];
        *stage = *from;
        stage->change = change;
        stage->point_change = point_change;
        for (int k = 0; k < from->change_count; ++k) {
            if (from->change[k].line == line) continue;
            *change = from->change[k];
            change->line -= change->line > line;
            ++change;
        }
        for (int k = 0; k < from->point_change_count; ++k) {
            if (to->index[from->point_change[k].point] == GONE) continue;
            *point_change = from->point_change[k];
            point_change->point = to->index[point_change->point];
            ++point_change;
        }
        stage->change_count = (int)(change - stage->change);
        stage->point_change_count = (int)(point_change - stage->point_change);
    }
}

bool without_line(const CpsScene *scene, int line, WithoutLine *out) {
    Arrays to = {0};
    *out = (WithoutLine){.scene = *scene, .memory = malloc(place(scene, NULL, &to))};
    if (!out->memory) return false;
    (void)place(scene, out->memory, &to);
    out->scene.point_count = number_points(scene, line, to.index);
    for (int i = 0; i < scene->point_count; ++i)
        if (to.index[i] != GONE) to.point[to.index[i]] = scene->point[i];
    copy_lines(scene, line, &to);
    copy_stages(scene, line, &to);
    out->scene.line_count = scene->line_count - 1;
    out->scene.line = to.line;
    out->scene.point = to.point;
    out->scene.stage = to.stage;
    return true;
}

void without_line_clear(WithoutLine *without) {
    free(without->memory);
    without->memory = NULL;
}
