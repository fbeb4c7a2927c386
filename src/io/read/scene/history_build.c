/* SPDX-License-Identifier: BSD-3-Clause */
/* The history: from the values of a scene file to the scene's stages (see scene_build.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/math.h"
#include "base/status.h"
#include "io/read/scene/scene_build.h"

/* A duration that is a whole number of steps may be so but for rounding. */
static const double ROUNDING = 1e-12;

/* Whether this is the name before the last dot of NAME.WHAT. */
static bool is_owner(const char *name, const char *key) {
    const size_t n = (size_t)(strrchr(key, '.') - key);
    return strncmp(name, key, n) == 0 && !name[n];
}

/* The index of the line of LINE.END; the reader has checked that it exists. */
static int find_line(const CpsiHistoryBuild *b, const char *key) {
    int i = 0;
    while (i + 1 < b->scene->line_count && !is_owner(b->scene->line[i].name, key)) i++;
    return i;
}

/* The index of the obstacle of OBSTACLE.turn, likewise. */
static int find_obstacle(const CpsiHistoryBuild *b, const char *key) {
    int i = 0;
    while (i + 1 < b->scene->obstacle_count && !is_owner(b->scene->obstacle[i].name, key)) i++;
    return i;
}

/* The position or force that a change asks for; `held` is where what it changes is held before it,
 * NaN: not known, and becomes where it is held after it. */
static void build_value(const CpsiChangeValues *values, double held[3], double out[3]) {
    const bool move = values->kind == CPSI_CHANGE_MOVE, force = values->kind == CPSI_CHANGE_FORCE;
    for (int i = 0; i < 3; i++) {
        out[i] = values->value[i];
        if (move) out[i] += held[i];
        held[i] = force ? NAN : out[i];
    }
}

/* The index of the point of POINT.point, likewise. */
static int find_owner_point(const CpsiHistoryBuild *b, const char *key) {
    int i = 0;
    while (i + 1 < b->scene->point_count && !is_owner(b->scene->point[i].name, key)) i++;
    return i;
}

/* An end that is let go; it is at no point from then on. */
static CpsStatus build_release(const CpsiHistoryBuild *b, const CpsiChangeValues *values,
                               CpsChange *change) {
    if (!values->yes)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->node,
                                  "'%s': found false, expected true; leave the key out to leave "
                                  "the end as it is",
                                  values->node->key);
    *change = (CpsChange){.line = change->line,
                          .end = change->end,
                          .to = {.kind = CPS_END_KIND_RELEASED}};
    b->held.end[change->line][change->end][0] = NAN;
    b->held.released[change->line][change->end] = true;
    return CPS_OK;
}

static CpsStatus build_change(const CpsiHistoryBuild *b, const CpsiChangeValues *values,
                              CpsChange *change) {
    const char *key = values->node->key;
    *change = (CpsChange){.line = find_line(b, key)};
    change->end = key[strlen(key) - 1] == 'A' ? CPS_END_A : CPS_END_B;
    if (values->kind == CPSI_CHANGE_RELEASE) return build_release(b, values, change);
    change->to.kind = values->kind == CPSI_CHANGE_FORCE ? CPS_END_KIND_FREE : CPS_END_KIND_HELD;
    const CpsLine *line = &b->scene->line[change->line];
    const bool at_point = line->end[change->end].kind == CPS_END_KIND_POINT &&
                          !b->held.released[change->line][change->end];
    const char *point = at_point ? b->scene->point[line->end_point[change->end]].name : NULL;
    double *held = b->held.end[change->line][change->end];
    if (point)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->node,
                                  "'%s': this end is at the point '%s', expected a change of the "
                                  "point: write '%s.point', or release the end in an entry before",
                                  key, point, point);
    if (values->kind == CPSI_CHANGE_MOVE && isnan(held[0]))
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->node->child,
                                  "'%s': found a move, but the end's position before it is not "
                                  "known (it is free, or held at "
                                  "the end of an arc): give a position instead",
                                  key);
    build_value(values, held, change->to.value);
    return CPS_OK;
}

static CpsStatus build_point_change(const CpsiHistoryBuild *b, const CpsiChangeValues *values,
                                    CpsPointChange *change) {
    const char *key = values->node->key;
    change->point = find_owner_point(b, key);
    const CpsPoint *point = &b->scene->point[change->point];
    if (point->kind == CPS_POINT_KIND_ON_BODY)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->node,
                                  "'%s': this point is on the body '%s', expected a change of the "
                                  "body: write '%s.body'",
                                  key, b->scene->body[point->body].name,
                                  b->scene->body[point->body].name);
    change->kind = values->kind == CPSI_CHANGE_FORCE ? CPS_POINT_KIND_FREE : CPS_POINT_KIND_HELD;
    double *held = b->held.point[change->point];
    const bool drags = b->scene->point[change->point].drags;
    if (values->kind == CPSI_CHANGE_MOVE && isnan(held[0]))
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->node->child,
                                  "'%s': found a move, but the point's position before it is not "
                                  "known (it is free%s): give a position instead",
                                  key, drags ? ", or an anchor that drags" : "");
    build_value(values, held, change->value);
    if (drags) held[0] = NAN;
    return CPS_OK;
}

/* The index of the body of BODY.body, likewise. */
static int find_owner_body(const CpsiHistoryBuild *b, const char *key) {
    int i = 0;
    while (i + 1 < b->scene->body_count && !is_owner(b->scene->body[i].name, key)) i++;
    return i;
}

static CpsStatus build_body_changes(const CpsiHistoryBuild *b, const CpsiList *changes,
                                    CpsStage *stage) {
    const CpsiBodyChangeValues *values = changes->item;
    CpsBodyChange *change = CPSI_POOL_TAKE(b->pool, changes->count, CpsBodyChange);
    if (!change) return cpsi_document_no_memory(b->d);
    stage->body_change = change;
    stage->body_change_count = changes->count;
    CpsStatus status = CPS_OK;
    for (int k = 0; k < changes->count && status == CPS_OK; k++) {
        change[k].body = find_owner_body(b, values[k].node->key);
        status =
            cpsi_body_change_build(b->d, &values[k], &b->held.body[change[k].body], &change[k]);
    }
    return status;
}

/* ---- oscillations ---- */

/* An oscillation has a size. */
static CpsStatus check_size(const CpsiHistoryBuild *b, const CpsiYaml *node) {
    static const char *const sizes[] = {"sine",          "cosine",
                                        "rotation_sine", "rotation_cosine",
                                        "moment_sine",   "moment_cosine"};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        if (cpsi_yaml_child(node, sizes[i])) return CPS_OK;
    return cpsi_document_fail(b->d, CPS_ERR_INPUT, cpsi_yaml_child(node, "period"),
                              "'period': nothing oscillates, expected 'sine' or 'cosine' "
                              "beside it");
}

/* Oscillations of an end or point: that beside its value, and those of its list. */
static CpsStatus check_change_sways(const CpsiHistoryBuild *b, const CpsiChangeValues *values) {
    const CpsiYaml *period = cpsi_yaml_child(values->node, "period"),
                   *list = cpsi_yaml_child(values->node, "oscillations"),
                   *series = cpsi_yaml_child(values->node, "series");
    const CpsiSwayValues *sways = values->oscillations.item;
    if ((period || list) && values->kind == CPSI_CHANGE_RELEASE)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, period ? period : list,
                                  "'%s': found beside 'release': what is let go does not "
                                  "oscillate",
                                  period ? "period" : "oscillations");
    if (series && values->kind == CPSI_CHANGE_RELEASE)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, series,
                                  "'series': found beside 'release': what is let go is led "
                                  "nowhere");
    CpsStatus status = period ? check_size(b, values->node) : CPS_OK;
    for (int i = 0; i < values->oscillations.count && status == CPS_OK; i++)
        status = check_size(b, sways[i].node);
    return status;
}

/* Oscillations of a body, whose angles go with a pose and moments with a load. */
static CpsStatus check_body_sways(const CpsiHistoryBuild *b, const CpsiBodyChangeValues *values,
                                  const CpsBodyChange *change) {
    const bool held = change->kind == CPS_BODY_KIND_HELD;
    const CpsiSwayValues *sways = values->oscillations.item;
    for (int i = 0; i < values->oscillations.count; i++) {
        const CpsiYaml *sine =
            cpsi_yaml_child(sways[i].node, held ? "moment_sine" : "rotation_sine");
        const CpsiYaml *wrong =
            sine ? sine
                 : cpsi_yaml_child(sways[i].node, held ? "moment_cosine" : "rotation_cosine");
        if (wrong)
            return cpsi_document_fail(b->d, CPS_ERR_INPUT, wrong,
                                      held ? "'%s': the body is held in this entry, expected "
                                             "'rotation_sine' or 'rotation_cosine'"
                                           : "'%s': the body is loaded in this entry, expected "
                                             "'moment_sine' or 'moment_cosine'",
                                      wrong->key);
        const CpsStatus status = check_size(b, sways[i].node);
        if (status != CPS_OK) return status;
    }
    return CPS_OK;
}

/* Add an oscillation to the stage, and what it is at the end of the stage to `after`. */
static void add_sway(CpsStage *stage, CpsSway *sway, const CpsiSwayValues *values, bool held,
                     double after[6]) {
    double at[6];
    for (int i = 0; i < 3; i++) {
        sway->sine[i] = values->sine[i];
        sway->cosine[i] = values->cosine[i];
        sway->sine[3 + i] = held ? values->rotation_sine[i] * CPSI_DEGREE : values->moment_sine[i];
        sway->cosine[3 + i] =
            held ? values->rotation_cosine[i] * CPSI_DEGREE : values->moment_cosine[i];
    }
    sway->period = values->period;
    cps_sway_at(sway, stage->duration, at);
    for (int i = 0; i < 6; i++) after[i] += at[i];
    stage->sway_count++;
}

/* Add a time series of a place or load from its file, of a body also of its rotation or moment. */
static CpsStatus add_series(const CpsiHistoryBuild *b, const CpsiYaml *change, const char *name,
                            bool held, CpsSway like, CpsStage *stage, CpsSway *sway,
                            double after[6]) {
    static const CpsiCsvColumn PLACE[] = {{"time", "s", CPSI_CSV_REQUIRED},
                                          {"x", "m", CPSI_CSV_OPTIONAL},
                                          {"y", "m", CPSI_CSV_OPTIONAL},
                                          {"z", "m", CPSI_CSV_OPTIONAL},
                                          {"rx", "deg", CPSI_CSV_OPTIONAL},
                                          {"ry", "deg", CPSI_CSV_OPTIONAL},
                                          {"rz", "deg", CPSI_CSV_OPTIONAL}};
    static const CpsiCsvColumn LOAD[] = {{"time", "s", CPSI_CSV_REQUIRED},
                                         {"fx", "N", CPSI_CSV_OPTIONAL},
                                         {"fy", "N", CPSI_CSV_OPTIONAL},
                                         {"fz", "N", CPSI_CSV_OPTIONAL},
                                         {"mx", "N m", CPSI_CSV_OPTIONAL},
                                         {"my", "N m", CPSI_CSV_OPTIONAL},
                                         {"mz", "N m", CPSI_CSV_OPTIONAL}};
    enum { OF_SERIES = 7, OF_VECTOR = 4 };
    const CpsiYaml *node = cpsi_yaml_child(change, "series");
    const int count = like.of == CPS_SWAY_OF_BODY ? OF_SERIES : OF_VECTOR;
    CpsiCsvTable table;
    const char *path;
    CpsStatus status =
        cpsi_document_table(b->d, node, name, held ? PLACE : LOAD, count, b->pool, &table, &path);
    if (status != CPS_OK) return status;
    double *row = CPSI_POOL_TAKE(b->pool, OF_SERIES * (size_t)table.rows, double), at[6];
    if (!row) return cpsi_document_no_memory(b->d);
    for (int k = 0; k < table.rows; k++)
        for (int c = 0; c < count; c++)
            row[OF_SERIES * k + c] =
                table.value[count * k + c] * (held && c >= OF_VECTOR ? CPSI_DEGREE : 1);
    for (int k = 1; k < table.rows; k++)
        if (!(row[OF_SERIES * k] > row[OF_SERIES * (k - 1)]))
            return cpsi_fail_at(b->d->err, CPS_ERR_INPUT, path, table.line[k], 1,
                                "time: found %.9g s after %.9g s, expected times that increase",
                                row[OF_SERIES * k], row[OF_SERIES * (k - 1)]);
    bool any = false;
    for (int c = 1; c < count; c++) any = any || table.has[c];
    if (!any || table.rows < 2)
        return cpsi_fail_at(b->d->err, CPS_ERR_INPUT, path, 0, 0,
                            any ? "found one row, expected at least two"
                                : "found times alone, expected a column beside them");
    like.row_count = table.rows;
    like.row = row;
    sway[stage->sway_count++] = like;
    cps_sway_at(&like, stage->duration, at);
    for (int i = 0; i < 6; i++) after[i] += at[i];
    return CPS_OK;
}

/* The oscillations of an end or point, which is then held elsewhere. */
static CpsStatus build_change_sways(const CpsiHistoryBuild *b, const CpsiChangeValues *values,
                                    CpsSway like, double held[3], CpsStage *stage, CpsSway *sway) {
    const CpsiSwayValues *sways = values->oscillations.item;
    const bool place = values->kind != CPSI_CHANGE_FORCE;
    CpsStatus status = check_change_sways(b, values);
    double after[6] = {0};
    if (status != CPS_OK) return status;
    for (int i = -1; i < values->oscillations.count; i++) {
        if (i < 0 && isnan(values->sway.period)) continue;
        sway[stage->sway_count] = like;
        add_sway(stage, &sway[stage->sway_count], i < 0 ? &values->sway : &sways[i], true, after);
    }
    if (values->series)
        status = add_series(b, values->node, values->series, place, like, stage, sway, after);
    for (int i = 0; i < 3; i++) held[i] += after[i];
    return status;
}

/* The oscillations of a body, which is then held in another pose. */
static CpsStatus build_body_sways(const CpsiHistoryBuild *b, const CpsiBodyChangeValues *values,
                                  const CpsBodyChange *change, CpsStage *stage, CpsSway *sway) {
    const CpsiSwayValues *sways = values->oscillations.item;
    const bool held = change->kind == CPS_BODY_KIND_HELD;
    CpsStatus status = check_body_sways(b, values, change);
    double after[6] = {0};
    if (status != CPS_OK) return status;
    for (int i = 0; i < values->oscillations.count; i++) {
        sway[stage->sway_count] = (CpsSway){.of = CPS_SWAY_OF_BODY, .owner = change->body};
        add_sway(stage, &sway[stage->sway_count], &sways[i], held, after);
    }
    const CpsSway like = {.of = CPS_SWAY_OF_BODY, .owner = change->body};
    if (values->series)
        status = add_series(b, values->node, values->series, held, like, stage, sway, after);
    cpsi_held_pose_sway(&b->held.body[change->body], after);
    return status;
}

static int count_sways(const CpsiStageValues *values) {
    const CpsiChangeValues *end = values->changes.item, *point = values->point_changes.item;
    const CpsiBodyChangeValues *body = values->body_changes.item;
    int count =
        2 * (values->changes.count + values->point_changes.count) + values->body_changes.count;
    for (int k = 0; k < values->changes.count; k++) count += end[k].oscillations.count;
    for (int k = 0; k < values->point_changes.count; k++) count += point[k].oscillations.count;
    for (int k = 0; k < values->body_changes.count; k++) count += body[k].oscillations.count;
    return count;
}

/* The oscillations of all changes, which have been built. */
static CpsStatus build_sways(const CpsiHistoryBuild *b, const CpsiStageValues *values,
                             CpsStage *stage) {
    const CpsiChangeValues *end = values->changes.item, *point = values->point_changes.item;
    const CpsiBodyChangeValues *body = values->body_changes.item;
    CpsSway *sway = CPSI_POOL_TAKE(b->pool, count_sways(values), CpsSway);
    if (!sway) return cpsi_document_no_memory(b->d);
    stage->sway = sway;
    CpsStatus status = CPS_OK;
    for (int k = 0; k < stage->change_count && status == CPS_OK; k++) {
        const CpsChange *change = &stage->change[k];
        const CpsSway like = {.of = CPS_SWAY_OF_END, .owner = change->line, .end = change->end};
        status = build_change_sways(b, &end[k], like, b->held.end[change->line][change->end], stage,
                                    sway);
    }
    for (int k = 0; k < stage->point_change_count && status == CPS_OK; k++) {
        const CpsSway like = {.of = CPS_SWAY_OF_POINT, .owner = stage->point_change[k].point};
        status = build_change_sways(b, &point[k], like, b->held.point[like.owner], stage, sway);
    }
    for (int k = 0; k < stage->body_change_count && status == CPS_OK; k++)
        status = build_body_sways(b, &body[k], &stage->body_change[k], stage, sway);
    return status;
}

static CpsStatus build_changes(const CpsiHistoryBuild *b, const CpsiStageValues *values,
                               CpsStage *stage) {
    const int count = values->changes.count, point_count = values->point_changes.count;
    const CpsiChangeValues *from = values->changes.item, *point_from = values->point_changes.item;
    CpsChange *change = CPSI_POOL_TAKE(b->pool, count, CpsChange);
    CpsPointChange *point_change = CPSI_POOL_TAKE(b->pool, point_count, CpsPointChange);
    if (!change || !point_change) return cpsi_document_no_memory(b->d);
    stage->change = change;
    stage->change_count = count;
    stage->point_change = point_change;
    stage->point_change_count = point_count;
    CpsStatus status = CPS_OK;
    for (int k = 0; k < count && status == CPS_OK; k++)
        status = build_change(b, &from[k], &change[k]);
    for (int k = 0; k < point_count && status == CPS_OK; k++)
        status = build_point_change(b, &point_from[k], &point_change[k]);
    if (status == CPS_OK) status = build_body_changes(b, &values->body_changes, stage);
    return status == CPS_OK ? build_sways(b, values, stage) : status;
}

/* The node between the ends that is nearest to an arc length; 0: there is none. */
static int nearest_node(const CpsLine *line, double at) {
    double arc = 0, least = INFINITY;
    int nearest = 0;
    for (int j = 1; j < line->element_count; j++) {
        arc +=
            line->element_length ? line->element_length[j - 1] : line->length / line->element_count;
        if (!(fabs(arc - at) < least)) continue;
        least = fabs(arc - at);
        nearest = j;
    }
    return nearest;
}

static CpsStatus build_grasp(const CpsiHistoryBuild *b, const CpsiGraspValues *values,
                             CpsGraspChange *change) {
    const bool flag = values->kind == CPSI_GRASP_HOLD || values->kind == CPSI_GRASP_RELEASE;
    const char *key = values->node->key;
    change->line = find_line(b, key);
    const CpsLine *line = &b->scene->line[change->line];
    change->node = nearest_node(line, values->at);
    if (values->at > line->length || change->node == 0)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, cpsi_yaml_child(values->node, "at"),
                                  "'%s': found at %g m, expected a length up to that of the line, "
                                  "%g m, which has at least two elements",
                                  key, values->at, line->length);
    if (flag && !values->yes)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->node,
                                  "'%s': found false, expected true; leave the key out to leave "
                                  "the node as it is",
                                  key);
    const bool held = values->kind == CPSI_GRASP_POSITION || values->kind == CPSI_GRASP_HOLD;
    change->kind = held ? CPS_END_KIND_HELD : CPS_END_KIND_FREE;
    change->stays = values->kind == CPSI_GRASP_HOLD;
    change->at_once = values->kind == CPSI_GRASP_RELEASE;
    if (!flag) memcpy(change->value, values->value, sizeof change->value);
    return CPS_OK;
}

static CpsStatus build_grasps(const CpsiHistoryBuild *b, const CpsiList *grasps, CpsStage *stage) {
    const CpsiGraspValues *from = grasps->item;
    CpsGraspChange *change = CPSI_POOL_TAKE(b->pool, grasps->count, CpsGraspChange);
    if (!change) return cpsi_document_no_memory(b->d);
    stage->grasp_change = change;
    stage->grasp_change_count = grasps->count;
    CpsStatus status = CPS_OK;
    for (int k = 0; k < grasps->count && status == CPS_OK; k++)
        status = build_grasp(b, &from[k], &change[k]);
    return status;
}

static CpsStatus build_shift(const CpsiHistoryBuild *b, const CpsiShiftValues *values,
                             CpsShift *shift) {
    const double *axis = values->axis, size = hypot(hypot(axis[0], axis[1]), axis[2]),
                 angle = isnan(values->turn) ? 0 : values->turn * CPSI_DEGREE;
    if (!cpsi_yaml_child(values->node, "move") && isnan(values->turn))
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->node,
                                  "'%s': nothing given, expected 'move', or 'turn' with its 'axis'",
                                  values->node->key);
    if (!isnan(values->turn) && !(size > 0))
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, cpsi_yaml_child(values->node, "axis"),
                                  "'axis': found a vector of no length, expected a direction");
    shift->obstacle = find_obstacle(b, values->node->key);
    for (int i = 0; i < 3; i++) {
        shift->by[i] = values->move[i];
        shift->turn[i] = angle != 0 ? angle * (axis[i] / size) : 0;
        shift->about[i] = values->about[i];
    }
    return CPS_OK;
}

static CpsStatus build_shifts(const CpsiHistoryBuild *b, const CpsiList *shifts, CpsStage *stage) {
    const CpsiShiftValues *from = shifts->item;
    CpsShift *shift = CPSI_POOL_TAKE(b->pool, shifts->count, CpsShift);
    if (!shift) return cpsi_document_no_memory(b->d);
    stage->shift = shift;
    stage->shift_count = shifts->count;
    CpsStatus status = CPS_OK;
    for (int k = 0; k < shifts->count && status == CPS_OK; k++)
        status = build_shift(b, &from[k], &shift[k]);
    return status;
}

static CpsStatus build_pay_outs(const CpsiHistoryBuild *b, const CpsiList *pay_outs,
                                CpsStage *stage) {
    const CpsiNumberItem *from = pay_outs->item;
    CpsPayOut *pay = CPSI_POOL_TAKE(b->pool, pay_outs->count, CpsPayOut);
    if (!pay) return cpsi_document_no_memory(b->d);
    stage->pay_out = pay;
    stage->pay_out_count = pay_outs->count;
    for (int k = 0; k < pay_outs->count; k++) {
        const char *key = from[k].node->key;
        pay[k] = (CpsPayOut){.line = find_line(b, key),
                             .end = key[strlen(key) - 1] == 'A' ? CPS_END_A : CPS_END_B,
                             .length = from[k].number};
    }
    return CPS_OK;
}

/* Say which obstacles the history moves. */
static void find_moving(const CpsiHistoryBuild *b, const CpsiList *history) {
    const CpsiStageValues *values = history->item;
    for (int i = 0; i < history->count; i++) {
        const CpsiShiftValues *shift = values[i].shifts.item;
        for (int k = 0; k < values[i].shifts.count; k++)
            b->obstacle[find_obstacle(b, shift[k].node->key)].moves = true;
    }
}

/* The number of steps of a duration, none of which is longer than given. */
static CpsStatus count_steps(const CpsiHistoryBuild *b, const CpsiStageValues *values,
                             CpsStage *stage) {
    const double count = ceil(stage->duration / values->time_step * (1 - ROUNDING));
    if (!(count <= (double)b->d->limits->max_steps))
        return cpsi_document_fail(b->d, CPS_ERR_LIMIT, cpsi_yaml_child(values->node, "time_step"),
                                  "'time_step': %.15g steps of %g s, the limit is %lld", count,
                                  values->time_step, (long long)b->d->limits->max_steps);
    stage->step_count = count > 1 ? (int)count : 1;
    return CPS_OK;
}

/* Which stiffness a stage uses; that of a scene without dynamic ones is not chosen. */
static CpsStatus build_stiffness(const CpsiHistoryBuild *b, const CpsiStageValues *values,
                                 CpsStage *stage) {
    const CpsiYaml *given = cpsi_yaml_child(values->node, "stiffness");
    bool any = false;
    for (int i = 0; i < b->scene->line_count; i++) {
        const CpsLine *line = &b->scene->line[i];
        any = any || (line->section_count == 0 && line->has_dynamic_stiffness);
        for (int k = 0; k < line->section_count; k++)
            any = any || line->section[k].has_dynamic_stiffness;
    }
    stage->static_stiffness = values->stiffness == 1;
    if (!given || any) return CPS_OK;
    return cpsi_document_fail(b->d, CPS_ERR_INPUT, given,
                              "'stiffness': found %s, but no line has a 'dynamic_stiffness': leave "
                              "the key out, or give one",
                              values->stiffness == 1 ? "static" : "dynamic");
}

static CpsStatus build_stage(const CpsiHistoryBuild *b, const CpsiStageValues *values, int index,
                             CpsStage *stage) {
    const CpsiNumberItem *turns = values->turns.item;
    char number[32];
    snprintf(number, sizeof number, "entry %d", index + 1);
    *stage = values->stage;
    if (!isnan(values->time_step)) {
        const CpsStatus status = count_steps(b, values, stage);
        if (status != CPS_OK) return status;
    }
    const char *name = stage->name ? stage->name : number;
    stage->name = cpsi_pool_text(b->pool, name, strlen(name));
    stage->gravity_changes = !isnan(stage->gravity[0]);
    if (!stage->gravity_changes) stage->gravity[0] = 0;

    CpsTurn *turn = CPSI_POOL_TAKE(b->pool, values->turns.count, CpsTurn);
    if (!stage->name || !turn) return cpsi_document_no_memory(b->d);
    stage->turn = turn;
    stage->turn_count = values->turns.count;
    for (int k = 0; k < stage->turn_count; k++)
        turn[k] = (CpsTurn){.obstacle = find_obstacle(b, turns[k].node->key),
                            .angle = turns[k].number * CPSI_DEGREE};
    CpsStatus status = build_stiffness(b, values, stage);
    if (status == CPS_OK) status = build_changes(b, values, stage);
    if (status == CPS_OK) status = build_shifts(b, &values->shifts, stage);
    if (status == CPS_OK) status = build_pay_outs(b, &values->pay_outs, stage);
    return status == CPS_OK ? build_grasps(b, &values->grasps, stage) : status;
}

CpsStatus cpsi_history_build(const CpsiHistoryBuild *b, const CpsiList *history) {
    const CpsiStageValues *values = history->item;
    if (history->count == 0) return CPS_OK;
    find_moving(b, history);
    CpsStage *stage = CPSI_POOL_TAKE(b->pool, history->count, CpsStage);
    if (!stage) return cpsi_document_no_memory(b->d);
    b->scene->stage = stage;
    b->scene->stage_count = history->count;
    int64_t steps = 0;
    for (int i = 0; i < history->count; i++) {
        const CpsStatus status = build_stage(b, &values[i], i, &stage[i]);
        if (status != CPS_OK) return status;
        steps += stage[i].step_count;
        if (steps > b->d->limits->max_steps)
            return cpsi_document_fail(b->d, CPS_ERR_LIMIT, values[i].node,
                                      "history: %lld load steps so far, the limit is %lld",
                                      (long long)steps, (long long)b->d->limits->max_steps);
    }
    return CPS_OK;
}
