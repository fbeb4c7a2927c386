/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines with floats become lines that meet at free points (see scene_build.h): a float within a
 * line is a point at which one part of the line ends and the next one begins. The scene has been
 * built and checked as if its floats were under water. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/rotation.h"
#include "io/read/scene/scene_build.h"

/* Sections and zones that reach less far into a part, per length of the line, end where it begins:
 * rounding. */
static const double AT_NODE = 1e-9;

typedef struct Split {
    const CpsiDocument *d;
    const CpsiSceneValues *values;
    CpsiPool *pool;
    CpsScene *scene;
    CpsLine *line; /* the first part of each line, then all others */
    CpsPoint *point;
    int lines, points; /* so far */
    int *cuts;         /* (lines of the file) how many nodes have floats */
    int **cut;         /* (lines of the file, cuts) these nodes */
    int *added;        /* (lines of the file) the index of the second part */
} Split;

/* The nodes and the arc lengths between which a part lies. */
typedef struct Stretch {
    int first, last;
    double from, to; /* [m] */
} Stretch;

/* ---- what cannot be divided ---- */

static CpsStatus fail_at(const Split *s, const CpsiYaml *at, const char *found) {
    return cpsi_document_fail(s->d, CPS_ERR_INPUT, at,
                              "'%s': found %s, which a line with floats cannot have: write it as "
                              "lines that end at a free point with 'mass' and 'volume'",
                              at->key, found);
}

/* A float needs water to float in. */
static CpsStatus check_float(const Split *s, const CpsiPointWeightValues *weight) {
    const CpsiYaml *floats = cpsi_yaml_child(weight->node, "floats");
    if (!s->scene->has_water_surface)
        return cpsi_document_fail(s->d, CPS_ERR_INPUT, floats,
                                  "'floats': the scene has no 'water_surface': give the height of "
                                  "the surface at which it floats");
    if (weight->volume > 0) return CPS_OK;
    return cpsi_document_fail(s->d, CPS_ERR_INPUT, floats,
                              "'floats': it displaces no water: give a 'volume'");
}

static CpsStatus check_line(const Split *s, const CpsiLineValues *values, const CpsLine *line) {
    const CpsiYaml *node = values->node, *ends = cpsi_yaml_child(node, "ends");
    if (values->pretension.node) return fail_at(s, values->pretension.node, "a length to be found");
    if (values->springs.count > 0)
        return fail_at(s, cpsi_yaml_child(node, "springs"), "springs to the ground");
    if (values->loads.count > 0) return fail_at(s, cpsi_yaml_child(node, "loads"), "given forces");
    if (line->start.kind != CPS_START_STATIC && line->start.kind != CPS_START_STRAIGHT)
        return fail_at(s, cpsi_yaml_child(node, "start"), "neither 'static' nor 'straight'");
    for (int end = 0; end < 2; end++) {
        const CpsiYaml *at = cpsi_yaml_child(ends, end == CPS_END_A ? "A" : "B");
        if (line->winch[end].is_there) return fail_at(s, at, "a winch");
        if (line->start.kind == CPS_START_STATIC && line->end[end].kind == CPS_END_KIND_FREE)
            return fail_at(s, at, "a free end of a static start");
    }
    return CPS_OK;
}

/* ---- the nodes with floats ---- */

static double element_length(const CpsLine *line, int element) {
    return line->element_length ? line->element_length[element]
                                : line->length / line->element_count;
}

/* [m] */
static double arc_length(const CpsLine *line, int node) {
    if (!line->element_length) return line->length * node / line->element_count;
    double arc = 0;
    for (int e = 0; e < node; e++) arc += line->element_length[e];
    return arc;
}

/* The node at an arc length, which has been checked to have one. */
static int node_at(const CpsLine *line, double at) {
    double arc = 0;
    for (int e = 0; e < line->element_count; e++) {
        if (at < arc + 0.5 * element_length(line, e)) return e;
        arc += element_length(line, e);
    }
    return line->element_count;
}

static CpsStatus find_cuts(Split *s, int i) {
    const CpsiLineValues *values = (const CpsiLineValues *)s->values->lines.item + i;
    const CpsiPointWeightValues *weight = values->point_weights.item;
    int *cut = CPSI_POOL_TAKE(s->pool, values->point_weights.count + 1, int), count = 0;
    if (!cut) return cpsi_document_no_memory(s->d);
    for (int k = 0; k < values->point_weights.count; k++) {
        if (!weight[k].floats) continue;
        const CpsStatus status = check_float(s, &weight[k]);
        if (status != CPS_OK) return status;
        const int node = node_at(&s->scene->line[i], weight[k].at);
        if (count == 0 || cut[count - 1] != node) cut[count++] = node;
    }
    s->cut[i] = cut;
    s->cuts[i] = count;
    return count > 0 ? check_line(s, values, &s->scene->line[i]) : CPS_OK;
}

/* ---- parts ---- */

static const char *part_name(const Split *s, const char *line, const char *what, int number) {
    char name[128];
    snprintf(name, sizeof name, "%.64s-%s%d", line, what, number);
    return cpsi_pool_text(s->pool, name, strlen(name));
}

static CpsStatus take_sections(const Split *s, const CpsLine *whole, Stretch on, CpsLine *part) {
    CpsSection *section = CPSI_POOL_TAKE(s->pool, whole->section_count, CpsSection);
    double at = 0;
    int count = 0;
    if (!section) return cpsi_document_no_memory(s->d);
    for (int k = 0; k < whole->section_count; k++) {
        const double from = fmax(at, on.from), to = fmin(at + whole->section[k].length, on.to);
        at += whole->section[k].length;
        if (to - from <= AT_NODE * whole->length) continue;
        section[count] = whole->section[k];
        section[count++].length = to - from;
    }
    part->section = section;
    part->section_count = count;
    return CPS_OK;
}

static CpsStatus take_zones(const Split *s, const CpsLine *whole, Stretch on, CpsLine *part) {
    CpsFrictionZone *zone = CPSI_POOL_TAKE(s->pool, whole->zone_count, CpsFrictionZone);
    int count = 0;
    if (!zone) return cpsi_document_no_memory(s->d);
    for (int k = 0; k < whole->zone_count; k++) {
        const double from = fmax(whole->zone[k].from, on.from), to = fmin(whole->zone[k].to, on.to);
        if (to - from <= AT_NODE * whole->length) continue;
        zone[count] = whole->zone[k];
        zone[count].from = from - on.from;
        zone[count++].to = to - on.from;
    }
    part->zone = zone;
    part->zone_count = count;
    return CPS_OK;
}

/* Those between the ends of the part: what is at a float is part of the float. */
static CpsStatus take_weights(const Split *s, const CpsLine *whole, Stretch on, CpsLine *part) {
    CpsPointWeight *weight = CPSI_POOL_TAKE(s->pool, whole->point_weight_count, CpsPointWeight);
    int count = 0;
    if (!weight) return cpsi_document_no_memory(s->d);
    for (int k = 0; k < whole->point_weight_count; k++) {
        const int node = node_at(whole, whole->point_weight[k].arc_length);
        if (node <= on.first || node >= on.last) continue;
        weight[count] = whole->point_weight[k];
        weight[count++].arc_length -= on.from;
    }
    part->point_weight = weight;
    part->point_weight_count = count;
    return CPS_OK;
}

/* The same share of a straight start. */
static CpsStatus take_start(const Split *s, const CpsLine *whole, Stretch on, CpsLine *part) {
    if (whole->start.kind == CPS_START_STATIC) return CPS_OK;
    double *point = CPSI_POOL_TAKE(s->pool, 2, double[3]);
    if (!point) return cpsi_document_no_memory(s->d);
    for (int a = 0; a < 3; a++) {
        const double from = whole->start.point[a], to = whole->start.point[3 + a];
        point[a] = on.first == 0 ? from : from + (to - from) * (on.from / whole->length);
        point[3 + a] =
            on.last == whole->element_count ? to : from + (to - from) * (on.to / whole->length);
    }
    part->start.point = point;
    return CPS_OK;
}

/* Part number k of a line. */
static CpsStatus take_part(const Split *s, int i, int k, CpsLine *part) {
    const CpsLine *whole = &s->scene->line[i];
    const bool is_first = k == 0, is_last = k == s->cuts[i];
    Stretch on = {.first = is_first ? 0 : s->cut[i][k - 1],
                  .last = is_last ? whole->element_count : s->cut[i][k]};
    on.from = arc_length(whole, on.first);
    on.to = is_last ? whole->length : arc_length(whole, on.last);
    *part = *whole;
    part->name = part_name(s, whole->name, "", k + 1);
    if (!part->name) return cpsi_document_no_memory(s->d);
    part->length = on.to - on.from;
    part->element_count = on.last - on.first;
    if (whole->element_length) part->element_length = whole->element_length + on.first;
    for (int end = 0; end < 2; end++) {
        if (end == CPS_END_A ? is_first : is_last) continue;
        part->end[end] = (CpsEnd){.kind = CPS_END_KIND_POINT};
        part->end_point[end] = s->points + k - (end == CPS_END_A);
    }
    CpsStatus status = CPS_OK;
    if (whole->section_count > 0) status = take_sections(s, whole, on, part);
    if (status == CPS_OK && whole->zone_count > 0) status = take_zones(s, whole, on, part);
    if (status == CPS_OK) status = take_weights(s, whole, on, part);
    return status == CPS_OK ? take_start(s, whole, on, part) : status;
}

/* ---- floats ---- */

/* [m] Where an end begins. */
static Vec3 end_place(const Split *s, const CpsLine *line, int end) {
    if (line->start.kind == CPS_START_STRAIGHT)
        return vec3_load(line->start.point + (end == CPS_END_A ? 0 : 3));
    if (line->end[end].kind != CPS_END_KIND_POINT) return vec3_load(line->end[end].value);
    const CpsPoint *point = &s->scene->point[line->end_point[end]];
    const Vec3 at = vec3_load(point->position);
    if (point->kind != CPS_POINT_KIND_ON_BODY) return at;
    const CpsBody *body = &s->scene->body[point->body];
    return vec3_add(vec3_load(body->position), rotation_apply(rotation_load(body->rotation), at));
}

/* What is at a node with a float: of a static start its place is a first guess, at the surface. */
static CpsStatus take_float(const Split *s, int i, int k, CpsPoint *point) {
    const CpsiLineValues *values = (const CpsiLineValues *)s->values->lines.item + i;
    const CpsiPointWeightValues *weight = values->point_weights.item;
    const CpsLine *line = &s->scene->line[i];
    const int node = s->cut[i][k];
    const double share = arc_length(line, node) / line->length,
                 gravity = vec3_norm(vec3_load(s->scene->gravity));
    const Vec3 a = end_place(s, line, CPS_END_A), b = end_place(s, line, CPS_END_B);
    *point = cps_point_default();
    point->kind = CPS_POINT_KIND_FREE;
    point->name = part_name(s, line->name, "float-", k + 1);
    if (!point->name) return cpsi_document_no_memory(s->d);
    vec3_store(point->position, vec3_axpy(share, vec3_sub(b, a), a));
    if (line->start.kind == CPS_START_STATIC) point->position[2] = s->scene->water_surface;
    memcpy(point->velocity, line->velocity, sizeof point->velocity);
    for (int w = 0; w < values->point_weights.count; w++) {
        if (node_at(line, weight[w].at) != node) continue;
        point->weight += line->point_weight[w].weight;
        point->inertia += line->point_weight[w].inertia;
        if (weight[w].floats)
            point->displaced_weight += s->values->water * weight[w].volume * gravity;
    }
    return CPS_OK;
}

static CpsStatus split_line(Split *s, int i) {
    CpsStatus status = CPS_OK;
    s->added[i] = s->lines;
    for (int k = 0; k <= s->cuts[i] && status == CPS_OK; k++)
        status = take_part(s, i, k, k == 0 ? &s->line[i] : &s->line[s->lines++]);
    for (int k = 0; k < s->cuts[i] && status == CPS_OK; k++)
        status = take_float(s, i, k, &s->point[s->points + k]);
    s->points += s->cuts[i];
    return status;
}

/* ---- the history ---- */

/* The part with an end of a line. */
static int part_of_end(const Split *s, int line, int end) {
    return end == CPS_END_B && s->cuts[line] > 0 ? s->added[line] + s->cuts[line] - 1 : line;
}

static CpsStatus move_grasp(const Split *s, const CpsiGraspValues *values, CpsGraspChange *grasp) {
    const int line = grasp->line, *cut = s->cut[line];
    int k = 0;
    while (k < s->cuts[line] && grasp->node > cut[k]) k++;
    if (k < s->cuts[line] && grasp->node == cut[k])
        return cpsi_document_fail(s->d, CPS_ERR_INPUT, values->node,
                                  "'%s': a float is there: write the line as lines that end at a "
                                  "free point, and change that",
                                  values->node->key);
    if (k > 0) {
        grasp->line = s->added[line] + k - 1;
        grasp->node -= cut[k - 1];
    }
    return CPS_OK;
}

/* A copy of the history in which the ends and nodes of lines are those of their parts. */
static CpsStatus move_history(const Split *s) {
    const int count = s->scene->stage_count;
    const CpsiStageValues *values = s->values->history.item;
    CpsStage *stage = CPSI_POOL_TAKE(s->pool, count, CpsStage);
    if (!stage) return cpsi_document_no_memory(s->d);
    for (int i = 0; i < count; i++) {
        stage[i] = s->scene->stage[i];
        CpsChange *change = CPSI_POOL_TAKE(s->pool, stage[i].change_count, CpsChange);
        CpsSway *sway = CPSI_POOL_TAKE(s->pool, stage[i].sway_count, CpsSway);
        CpsGraspChange *grasp =
            CPSI_POOL_TAKE(s->pool, stage[i].grasp_change_count, CpsGraspChange);
        if (!change || !sway || !grasp) return cpsi_document_no_memory(s->d);
        for (int k = 0; k < stage[i].change_count; k++) {
            change[k] = stage[i].change[k];
            change[k].line = part_of_end(s, change[k].line, change[k].end);
        }
        for (int k = 0; k < stage[i].sway_count; k++) {
            sway[k] = stage[i].sway[k];
            if (sway[k].of == CPS_SWAY_OF_END)
                sway[k].owner = part_of_end(s, sway[k].owner, sway[k].end);
        }
        const CpsiGraspValues *grasps = values[i].grasps.item;
        for (int k = 0; k < stage[i].grasp_change_count; k++) {
            grasp[k] = stage[i].grasp_change[k];
            const CpsStatus status = move_grasp(s, &grasps[k], &grasp[k]);
            if (status != CPS_OK) return status;
        }
        stage[i].change = change;
        stage[i].sway = sway;
        stage[i].grasp_change = grasp;
    }
    s->scene->stage = stage;
    return CPS_OK;
}

static int count_floats(const CpsiSceneValues *values) {
    const CpsiLineValues *line = values->lines.item;
    int floats = 0;
    for (int i = 0; i < values->lines.count; i++) {
        const CpsiPointWeightValues *weight = line[i].point_weights.item;
        for (int k = 0; k < line[i].point_weights.count; k++) floats += weight[k].floats;
    }
    return floats;
}

CpsStatus cpsi_scene_split_floats(const CpsiDocument *d, const CpsiSceneValues *values,
                                  CpsiPool *pool, CpsScene *scene) {
    const int floats = count_floats(values), lines = scene->line_count, points = scene->point_count;
    if (floats == 0) return CPS_OK;
    Split s = {.d = d, .values = values, .pool = pool, .scene = scene};
    s.line = CPSI_POOL_TAKE(pool, lines + floats, CpsLine);
    s.point = CPSI_POOL_TAKE(pool, points + floats, CpsPoint);
    s.cuts = CPSI_POOL_TAKE(pool, lines, int);
    s.cut = CPSI_POOL_TAKE(pool, lines, int *);
    s.added = CPSI_POOL_TAKE(pool, lines, int);
    if (!s.line || !s.point || !s.cuts || !s.cut || !s.added) return cpsi_document_no_memory(d);
    memcpy(s.line, scene->line, (size_t)lines * sizeof *s.line);
    if (points > 0) memcpy(s.point, scene->point, (size_t)points * sizeof *s.point);
    s.lines = lines;
    s.points = points;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < lines && status == CPS_OK; i++) status = find_cuts(&s, i);
    for (int i = 0; i < lines && status == CPS_OK; i++)
        if (s.cuts[i] > 0) status = split_line(&s, i);
    if (status == CPS_OK && scene->stage_count > 0) status = move_history(&s);
    if (status != CPS_OK) return status;
    scene->line = s.line;
    scene->line_count = s.lines;
    scene->point = s.point;
    scene->point_count = s.points;
    return CPS_OK;
}
