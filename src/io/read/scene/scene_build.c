/* SPDX-License-Identifier: BSD-3-Clause */
/* From the values of a scene file to the scene's structs (see scene_build.h). Defaults are those of
 * cps_scene_default() and similar functions, with which reading begins. */
#include "io/read/scene/scene_build.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "capstan/pretension.h"
#include "io/base/file/read_file.h"
#include "io/read/law/set_build.h"
#include "io/read/scene/node_file.h"
#include "io/read/scene/section_build.h"
#include "io/read/shapes/ground/ground_build.h"
#include "io/read/shapes/mesh/mesh_build.h"

/* A point of the scene, found by its name. */
typedef struct NamedPoint {
    const char *name;
    int index; /* in the scene */
} NamedPoint;

typedef struct Build {
    const CpsiDocument *d;
    CpsiPool *pool; /* memory of the scene */
    CpsScene *scene;
    CpsObstacle *obstacle;
    CpsLine *line;
    CpsiSetBuild set; /* of friction sets */
    double elements;  /* number of elements of the lines so far */
    CpsiMaterials materials;
    bool (*released)[2]; /* (lines) ends that the history has let go so far */
    /* (lines) [m] position at which each end is held after the preceding entry; NaN: not held, or
     * not known */
    double (*held)[2][3];
    double (*held_point)[3]; /* (points) [m] likewise */
    NamedPoint *by_name;     /* (points) by name */
    CpsiHeldPose *held_body; /* (bodies) likewise */
} Build;

static const char *copy_text(const Build *b, const char *text) {
    return cpsi_pool_text(b->pool, text, strlen(text));
}

static void copy_vector(double out[3], const double x[3]) { memcpy(out, x, 3 * sizeof *out); }

/* ---- elements ---- */

/* Check that the elements of the lines so far are within the limits, and so is their number times
 * that of the obstacles, with which computing times increase. */
static CpsStatus check_size(const Build *b, const CpsiYaml *place) {
    const double most = fmin((double)b->d->limits->max_elements, 1e9);
    const double pairs = b->elements * b->scene->obstacle_count;
    if (!(b->elements <= most))
        return cpsi_document_fail(b->d, CPS_ERR_LIMIT, place,
                                  "elements: %.15g elements in all lines so far, the limit is "
                                  "%.15g: use fewer, longer elements",
                                  b->elements, most);
    if (!(pairs <= (double)b->d->limits->max_pairs))
        return cpsi_document_fail(b->d, CPS_ERR_LIMIT, place,
                                  "elements: %.15g elements in all lines so far beside %d "
                                  "obstacles, %.15g pairs, the limit is %lld: use fewer, longer "
                                  "elements",
                                  b->elements, b->scene->obstacle_count, pairs,
                                  (long long)b->d->limits->max_pairs);
    return CPS_OK;
}

/* What the file says of the elements of a line; NULL: nothing. */
static const CpsiYaml *given_elements(const CpsiLineValues *values) {
    const CpsiYaml *given = cpsi_yaml_child(values->node, "elements");
    return given ? given : cpsi_yaml_child(values->node, "element_length");
}

/* Count the elements and check the limits before memory is allocated for them. */
static CpsStatus count_elements(Build *b, const CpsiLineValues *values, CpsLine *line) {
    const CpsiYaml *list = values->elements, *given = given_elements(values);
    double count = isnan(values->count) ? line->element_count : values->count;
    if (!isnan(values->element_length))
        count = cpsi_graded_count(line->length, NAN, values->element_length, &values->grade);
    if (list) count = 0;
    if (values->sections.count > 0) count = cpsi_section_elements(&values->sections);
    for (const CpsiYaml *item = list ? list->child : NULL; item; item = item->next) {
        double each = 1;
        if (item->child) cpsi_yaml_number(item->child->text, &each);
        count += each;
    }
    b->elements += count;
    const CpsStatus status = check_size(b, given ? given : values->node);
    if (status == CPS_OK) line->element_count = (int)count;
    return status;
}

/* Two ways to say what the elements are do not go together. */
static CpsStatus check_elements(const Build *b, const CpsiLineValues *values) {
    const CpsiYaml *target = cpsi_yaml_child(values->node, "element_length");
    if (target && cpsi_yaml_child(values->node, "elements"))
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, target,
                                  "'element_length': it does not go with 'elements': leave one of "
                                  "them out");
    if (values->grade.node && values->elements)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->grade.node,
                                  "'grade': found beside a list of elements, expected their number "
                                  "or 'element_length'");
    return CPS_OK;
}

static CpsStatus build_elements(Build *b, const CpsiLineValues *values, CpsLine *line) {
    CpsStatus status = check_elements(b, values);
    if (status == CPS_OK) status = count_elements(b, values, line);
    if (status != CPS_OK || values->sections.count > 0) return status;
    if (!values->elements && !values->grade.node) return CPS_OK;
    double *length = CPSI_POOL_TAKE(b->pool, line->element_count, double);
    if (!length) return cpsi_document_no_memory(b->d);
    line->element_length = length;
    if (!values->elements) {
        cpsi_graded_fill(line->length, line->element_count, &values->grade, length);
        return CPS_OK;
    }
    for (const CpsiYaml *item = values->elements->child; item; item = item->next) {
        double count = 1, whole = 0;
        if (item->child) cpsi_yaml_number(item->child->text, &count);
        cpsi_yaml_number(item->child ? item->child->next->text : item->text, &whole);
        for (int i = 0; i < (int)count; i++) *length++ = whole / (int)count;
    }
    return CPS_OK;
}

/* ---- a start from nodes ---- */

static CpsStatus read_nodes(const Build *b, const CpsiStartValues *start, CpsiNodeFile *file) {
    if (!cpsi_is_beside(start->nodes))
        return cpsi_document_fail(
            b->d, CPS_ERR_INPUT, cpsi_yaml_child(start->node, "nodes"),
            "'nodes': found '%.64s', expected the name of a file beside this one, without '/'",
            start->nodes);
    const char *path = cpsi_path_beside(b->pool, b->d->name, start->nodes);
    if (!path) return cpsi_document_no_memory(b->d);
    return cpsi_node_file_read(path, b->d->limits->max_bytes, b->pool, file, b->d->err);
}

/* The elements of the file where the scene gives none; otherwise both must have the same. */
static CpsStatus read_elements(Build *b, const CpsiLineValues *values, const CpsiNodeFile *file,
                               CpsLine *line) {
    const CpsiYaml *given = given_elements(values);
    if (!given) given = values->grade.node;
    if (!given) given = values->sections.node;
    const double *arc = file->arc_length;
    if (!given) {
        b->elements += file->nodes - 1 - line->element_count;
        line->element_count = file->nodes - 1;
    }
    const CpsStatus status = check_size(b, values->node);
    if (status != CPS_OK) return status;
    if (given && line->element_count != file->nodes - 1)
        return cpsi_document_fail(
            b->d, CPS_ERR_INPUT, given,
            "'%s': found %d, expected %d, one less than nodes are given, or none", given->key,
            line->element_count, file->nodes - 1);
    if (!arc) return CPS_OK;
    double *length = CPSI_POOL_TAKE(b->pool, line->element_count, double), worst = 0;
    if (!length) return cpsi_document_no_memory(b->d);
    for (int e = 0; e < line->element_count; e++) {
        const double here =
            line->element_length ? line->element_length[e] : line->length / line->element_count;
        length[e] = arc[e + 1] - arc[e];
        worst = fmax(worst, fabs(length[e] - here));
    }
    if (!given) line->element_length = length;
    /* tolerance for abscissae written with 9 digits */
    if (!given || worst <= 1e-9 * line->length) return CPS_OK;
    return cpsi_document_fail(b->d, CPS_ERR_INPUT, given,
                              "'%s': natural lengths differ by %g m from those of arc_length in "
                              "the file of nodes: leave one of the two out",
                              given->key, worst);
}

static CpsStatus build_nodes(Build *b, const CpsiLineValues *values, CpsLine *line) {
    CpsiNodeFile file = {0};
    CpsStatus status = read_nodes(b, &values->start, &file);
    if (status == CPS_OK) status = read_elements(b, values, &file, line);
    line->start = (CpsStart){.kind = CPS_START_NODES,
                             .point_count = file.nodes,
                             .point = file.position,
                             .tension = file.tension,
                             .reaction = file.reaction,
                             .friction_bound = file.friction_bound};
    return status;
}

/* ---- points ---- */

static int by_name(const void *a, const void *b) {
    const NamedPoint *left = a, *right = b;
    return strcmp(left->name, right->name);
}

static CpsStatus build_points(Build *b, const CpsiList *points) {
    const CpsiScenePointValues *values = points->item;
    if (points->count == 0) return CPS_OK;
    CpsPoint *point = CPSI_POOL_TAKE(b->pool, points->count, CpsPoint);
    b->held_point = CPSI_POOL_TAKE(b->d->pool, points->count, double[3]);
    b->by_name = CPSI_POOL_TAKE(b->d->pool, points->count, NamedPoint);
    if (!point || !b->held_point || !b->by_name) return cpsi_document_no_memory(b->d);
    b->scene->point = point;
    b->scene->point_count = points->count;
    for (int k = 0; k < points->count; k++) {
        point[k] = values[k].point;
        point[k].weight = cpsi_weight_in_water(&b->materials, values[k].mass, values[k].volume,
                                               values[k].point.weight);
        point[k].has_holding_capacity = !isnan(point[k].holding_capacity);
        if (!point[k].has_holding_capacity) point[k].holding_capacity = 0;
        point[k].has_uplift_limit = !isnan(point[k].uplift_limit);
        if (!point[k].has_uplift_limit) point[k].uplift_limit = 0;
        point[k].displaced_weight = cpsi_displaced_weight(&b->materials, values[k].volume);
        point[k].name = copy_text(b, values[k].node->key);
        if (!point[k].name) return cpsi_document_no_memory(b->d);
        copy_vector(b->held_point[k], point[k].position);
        if (point[k].kind == CPS_POINT_KIND_FREE || point[k].drags) b->held_point[k][0] = NAN;
        if (values[k].body) {
            const CpsiYaml *name = cpsi_yaml_child(values[k].node, "body");
            const CpsStatus status = cpsi_body_find(b->d, b->scene, name, &point[k].body);
            if (status != CPS_OK) return status;
            copy_vector(point[k].position, values[k].at);
            b->held_point[k][0] = NAN;
        }
        b->by_name[k] = (NamedPoint){point[k].name, k};
    }
    qsort(b->by_name, (size_t)points->count, sizeof *b->by_name, by_name);
    return CPS_OK;
}

/* The index of the point whose name is the node's text. */
static CpsStatus find_point(const Build *b, const CpsiYaml *node, int *index) {
    const int count = b->scene->point_count;
    const NamedPoint wanted = {.name = node->text},
                     *found = count > 0 ? bsearch(&wanted, b->by_name, (size_t)count, sizeof wanted,
                                                  by_name)
                                        : NULL;
    if (found) {
        *index = found->index;
        return CPS_OK;
    }
    CpsSuggestion suggestion = {.word = node->text};
    for (int k = 0; k < count; k++) cps_suggest(&suggestion, b->scene->point[k].name);
    if (count == 0)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, node,
                                  "'point': found '%.64s', but the scene has no 'points': give it "
                                  "there, held or free",
                                  node->text);
    if (suggestion.best)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, node,
                                  "'point': there is no point '%.64s'; did you mean '%.64s'?",
                                  node->text, suggestion.best);
    return cpsi_document_fail(b->d, CPS_ERR_INPUT, node,
                              "'point': found '%.64s', expected the name of one of the %d points "
                              "of the scene",
                              node->text, count);
}

/* ---- lines ---- */

static CpsStatus build_start(const Build *b, const CpsiStartValues *values, CpsStart *start) {
    const CpsiStraightValues *straight = &values->straight;
    const CpsiArcValues *arc = &values->arc;
    const CpsiNumberRows *polyline = &values->polyline;
    if (!values->node) {
        start->kind = CPS_START_STATIC;
        return CPS_OK;
    }
    start->kind = straight->node   ? CPS_START_STRAIGHT
                  : polyline->node ? CPS_START_POLYLINE
                                   : CPS_START_ARC;
    start->point_count = polyline->node ? polyline->rows : 2;
    double *point = CPSI_POOL_TAKE(b->pool, start->point_count, double[3]);
    if (!point) return cpsi_document_no_memory(b->d);
    start->point = point;
    if (polyline->node) {
        memcpy(point, polyline->x, (size_t)polyline->rows * sizeof(double[3]));
    } else if (straight->node) {
        copy_vector(point, straight->from);
        copy_vector(point + 3, straight->to);
    } else {
        copy_vector(point, arc->from);
        copy_vector(point + 3, arc->centre);
        copy_vector(start->axis, arc->axis);
    }
    return CPS_OK;
}

/* `held`: at its initial position, `free`: without force; or at a given position, or with a given
 * force; or at a point. */
static CpsStatus build_end(const Build *b, const CpsiEndValues *values, CpsEnd *end, int *point) {
    const bool is_free = values->word == CPSI_END_FREE;
    *end = (CpsEnd){.kind = CPS_END_KIND_AT_START};
    if (!is_free && !values->node) return CPS_OK;
    if (values->word == CPSI_END_AT_POINT) {
        end->kind = CPS_END_KIND_POINT;
        return find_point(b, cpsi_yaml_child(values->node, "point"), point);
    }
    end->kind = is_free ? CPS_END_KIND_FREE : CPS_END_KIND_HELD;
    copy_vector(end->value, values->value);
    return CPS_OK;
}

/* Initial position of a held end. NaN of a free one, and for the end of an arc, which only the
 * start itself knows. */
static void first_position(const CpsLine *line, int end, double out[3]) {
    const CpsStart *start = &line->start;
    const CpsEnd *e = &line->end[end];
    const bool known = start->point && (end == CPS_END_A || start->kind != CPS_START_ARC);
    out[0] = NAN;
    if (e->kind == CPS_END_KIND_HELD) copy_vector(out, e->value);
    if (e->kind == CPS_END_KIND_AT_START && known)
        copy_vector(out, start->point + 3 * (end == CPS_END_A ? 0 : start->point_count - 1));
}

static CpsStatus build_zones(const Build *b, const CpsiList *zones, CpsLine *line) {
    const CpsiZoneValues *values = zones->item;
    if (zones->count == 0) return CPS_OK;
    CpsFrictionZone *zone = CPSI_POOL_TAKE(b->pool, zones->count, CpsFrictionZone);
    if (!zone) return cpsi_document_no_memory(b->d);
    for (int k = 0; k < zones->count; k++) zone[k] = values[k].zone;
    line->zone = zone;
    line->zone_count = zones->count;
    return CPS_OK;
}

static CpsStatus build_line(Build *b, const CpsiLineValues *values, CpsLine *line,
                            double held[2][3]) {
    *line = values->line;
    line->name = copy_text(b, values->node->key);
    if (!line->name) return cpsi_document_no_memory(b->d);
    line->has_breaking_load = !isnan(values->breaking_load);
    if (line->has_breaking_load) line->breaking_load = values->breaking_load;
    line->has_break_at = !isnan(values->break_at);
    if (line->has_break_at) line->break_at = values->break_at;
    CpsStatus status = cpsi_line_weight_build(&b->materials, values, line);
    if (status == CPS_OK)
        status = cpsi_stiffness_build(&b->materials, &values->table, &line->stiffness_row_count,
                                      &line->stiffness_row);
    if (status == CPS_OK) status = build_elements(b, values, line);
    if (status == CPS_OK) status = build_zones(b, &values->zones, line);
    if (status == CPS_OK && values->sections.count > 0)
        status = cpsi_sections_build(&b->materials, values, line);
    if (status == CPS_OK)
        status = cpsi_point_weights_build(&b->materials, &values->point_weights, line);
    if (status == CPS_OK)
        status = values->start.nodes ? build_nodes(b, values, line)
                                     : build_start(b, &values->start, &line->start);
    for (int end = 0; end < 2 && status == CPS_OK; end++) {
        status = build_end(b, &values->end[end], &line->end[end], &line->end_point[end]);
        first_position(line, end, held[end]);
    }
    return status;
}

static CpsStatus build_lines(Build *b, const CpsiList *lines) {
    const CpsiLineValues *values = lines->item;
    b->line = CPSI_POOL_TAKE(b->pool, lines->count, CpsLine);
    b->held = CPSI_POOL_TAKE(b->pool, lines->count, double[2][3]);
    b->released = CPSI_POOL_TAKE(b->pool, lines->count, bool[2]);
    if (!b->line || !b->held || !b->released) return cpsi_document_no_memory(b->d);
    for (int i = 0; i < lines->count; i++) b->released[i][0] = b->released[i][1] = false;
    b->scene->line = b->line;
    b->scene->line_count = lines->count;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < lines->count && status == CPS_OK; i++)
        status = build_line(b, &values[i], &b->line[i], b->held[i]);
    return status;
}

/* ---- obstacles ---- */

static CpsStatus build_mesh(Build *b, const CpsiObstacleValues *values, CpsObstacle *obstacle) {
    double turn[4] = {1, 0, 0, 0};
    if (values->rotation.node) cpsi_rotation_build(&values->rotation, turn);
    if (turn[0] == 0 && turn[1] == 0 && turn[2] == 0 && turn[3] == 0)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->rotation.node,
                                  "'quaternion': found zeros, expected any other length");
    return cpsi_mesh_build(b->d, values, rotation_load(turn), (CpsMesh **)&obstacle->mesh);
}

static CpsStatus build_obstacle(Build *b, const CpsiObstacleValues *values, CpsObstacle *obstacle) {
    /* in the order of the keys */
    static const CpsObstacleKind KIND[] = {CPS_OBSTACLE_PLANE, CPS_OBSTACLE_CYLINDER,
                                           CPS_OBSTACLE_SPHERE, CPS_OBSTACLE_GROUND,
                                           CPS_OBSTACLE_MESH};
    CpsSet *set = NULL;
    *obstacle = values->obstacle;
    obstacle->kind = KIND[values->shape];
    obstacle->has_friction_lateral = !isnan(obstacle->friction_lateral);
    if (!obstacle->has_friction_lateral) obstacle->friction_lateral = 0;
    obstacle->name = copy_text(b, values->node->key);
    if (!obstacle->name) return cpsi_document_no_memory(b->d);
    CpsStatus status = values->set ? cpsi_build_set(&b->set, values->set, &set) : CPS_OK;
    obstacle->friction_set = set;
    if (status == CPS_OK && obstacle->kind == CPS_OBSTACLE_GROUND)
        status = cpsi_ground_build(b->d, values, (CpsGround **)&obstacle->ground);
    if (status == CPS_OK && obstacle->kind == CPS_OBSTACLE_MESH)
        status = build_mesh(b, values, obstacle);
    return status;
}

static CpsStatus build_obstacles(Build *b, const CpsiList *obstacles) {
    const CpsiObstacleValues *values = obstacles->item;
    if (obstacles->count == 0) return CPS_OK;
    CpsObstacle *obstacle = CPSI_POOL_TAKE(b->pool, obstacles->count, CpsObstacle);
    if (!obstacle) return cpsi_document_no_memory(b->d);
    b->scene->obstacle = b->obstacle = obstacle;
    b->scene->obstacle_count = obstacles->count;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < obstacles->count && status == CPS_OK; i++)
        status = build_obstacle(b, &values[i], &obstacle[i]);
    return status;
}

/* ---- history ---- */

/* Whether this is the name before the last dot of NAME.WHAT. */
static bool is_owner(const char *name, const char *key) {
    const size_t n = (size_t)(strrchr(key, '.') - key);
    return strncmp(name, key, n) == 0 && !name[n];
}

/* The index of the line of LINE.END; the reader has checked that it exists. */
static int find_line(const Build *b, const char *key) {
    int i = 0;
    while (i + 1 < b->scene->line_count && !is_owner(b->line[i].name, key)) i++;
    return i;
}

/* The index of the obstacle of OBSTACLE.turn, likewise. */
static int find_obstacle(const Build *b, const char *key) {
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
static int find_owner_point(const Build *b, const char *key) {
    int i = 0;
    while (i + 1 < b->scene->point_count && !is_owner(b->scene->point[i].name, key)) i++;
    return i;
}

/* An end that is let go; it is at no point from then on. */
static CpsStatus build_release(const Build *b, const CpsiChangeValues *values, CpsChange *change) {
    if (!values->yes)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->node,
                                  "'%s': found false, expected true; leave the key out to leave "
                                  "the end as it is",
                                  values->node->key);
    *change = (CpsChange){.line = change->line,
                          .end = change->end,
                          .to = {.kind = CPS_END_KIND_RELEASED}};
    b->held[change->line][change->end][0] = NAN;
    b->released[change->line][change->end] = true;
    return CPS_OK;
}

static CpsStatus build_change(const Build *b, const CpsiChangeValues *values, CpsChange *change) {
    const char *key = values->node->key;
    *change = (CpsChange){.line = find_line(b, key)};
    change->end = key[strlen(key) - 1] == 'A' ? CPS_END_A : CPS_END_B;
    if (values->kind == CPSI_CHANGE_RELEASE) return build_release(b, values, change);
    change->to.kind = values->kind == CPSI_CHANGE_FORCE ? CPS_END_KIND_FREE : CPS_END_KIND_HELD;
    const CpsLine *line = &b->line[change->line];
    const bool at_point = line->end[change->end].kind == CPS_END_KIND_POINT &&
                          !b->released[change->line][change->end];
    const char *point = at_point ? b->scene->point[line->end_point[change->end]].name : NULL;
    double *held = b->held[change->line][change->end];
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

static CpsStatus build_point_change(const Build *b, const CpsiChangeValues *values,
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
    double *held = b->held_point[change->point];
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
static int find_owner_body(const Build *b, const char *key) {
    int i = 0;
    while (i + 1 < b->scene->body_count && !is_owner(b->scene->body[i].name, key)) i++;
    return i;
}

static CpsStatus build_body_changes(const Build *b, const CpsiList *changes, CpsStage *stage) {
    const CpsiBodyChangeValues *values = changes->item;
    CpsBodyChange *change = CPSI_POOL_TAKE(b->pool, changes->count, CpsBodyChange);
    if (!change) return cpsi_document_no_memory(b->d);
    stage->body_change = change;
    stage->body_change_count = changes->count;
    CpsStatus status = CPS_OK;
    for (int k = 0; k < changes->count && status == CPS_OK; k++) {
        change[k].body = find_owner_body(b, values[k].node->key);
        status =
            cpsi_body_change_build(b->d, &values[k], &b->held_body[change[k].body], &change[k]);
    }
    return status;
}

static CpsStatus build_changes(const Build *b, const CpsiStageValues *values, CpsStage *stage) {
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
    return status ? status : build_body_changes(b, &values->body_changes, stage);
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

static CpsStatus build_grasp(const Build *b, const CpsiGraspValues *values,
                             CpsGraspChange *change) {
    const bool flag = values->kind == CPSI_GRASP_HOLD || values->kind == CPSI_GRASP_RELEASE;
    const char *key = values->node->key;
    change->line = find_line(b, key);
    const CpsLine *line = &b->line[change->line];
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

static CpsStatus build_grasps(const Build *b, const CpsiList *grasps, CpsStage *stage) {
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

static CpsStatus build_shift(const Build *b, const CpsiShiftValues *values, CpsShift *shift) {
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

static CpsStatus build_shifts(const Build *b, const CpsiList *shifts, CpsStage *stage) {
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

/* Say which obstacles the history moves. */
static void find_moving(const Build *b, const CpsiList *history) {
    const CpsiStageValues *values = history->item;
    for (int i = 0; i < history->count; i++) {
        const CpsiShiftValues *shift = values[i].shifts.item;
        for (int k = 0; k < values[i].shifts.count; k++)
            b->obstacle[find_obstacle(b, shift[k].node->key)].moves = true;
    }
}

static CpsStatus build_stage(const Build *b, const CpsiStageValues *values, int index,
                             CpsStage *stage) {
    const CpsiNumberItem *turns = values->turns.item;
    char number[32];
    snprintf(number, sizeof number, "entry %d", index + 1);
    *stage = values->stage;
    stage->name = copy_text(b, stage->name ? stage->name : number);
    stage->gravity_changes = !isnan(stage->gravity[0]);
    if (!stage->gravity_changes) stage->gravity[0] = 0;

    CpsTurn *turn = CPSI_POOL_TAKE(b->pool, values->turns.count, CpsTurn);
    if (!stage->name || !turn) return cpsi_document_no_memory(b->d);
    stage->turn = turn;
    stage->turn_count = values->turns.count;
    for (int k = 0; k < stage->turn_count; k++)
        turn[k] = (CpsTurn){.obstacle = find_obstacle(b, turns[k].node->key),
                            .angle = turns[k].number * CPSI_DEGREE};
    CpsStatus status = build_changes(b, values, stage);
    if (status == CPS_OK) status = build_shifts(b, &values->shifts, stage);
    return status == CPS_OK ? build_grasps(b, &values->grasps, stage) : status;
}

static CpsStatus build_history(const Build *b, const CpsiList *history) {
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

CpsStatus cpsi_scene_build(const CpsiDocument *d, const CpsiSceneValues *values, CpsiPool *pool,
                           CpsScene *scene) {
    Build b = {.d = d, .pool = pool, .scene = scene, .set = {.d = d}};
    *scene = values->scene;
    scene->has_water_surface = !isnan(scene->water_surface);
    if (!scene->has_water_surface) scene->water_surface = 0;
    const double *g = scene->gravity;
    b.materials = (CpsiMaterials){.d = d,
                                  .pool = pool,
                                  .gravity = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]),
                                  .water = values->water};
    if (scene->title) scene->title = copy_text(&b, scene->title);
    if (values->scene.title && !scene->title) return cpsi_document_no_memory(d);
    CpsStatus status = cpsi_materials_sort(&b.materials, &values->types);
    if (status == CPS_OK) status = build_obstacles(&b, &values->obstacles);
    if (status == CPS_OK)
        status = cpsi_bodies_build(&b.materials, &values->bodies, scene, &b.held_body);
    if (status == CPS_OK) status = build_points(&b, &values->points);
    if (status == CPS_OK) status = build_lines(&b, &values->lines);
    return status ? status : build_history(&b, &values->history);
}

/* ---- lengths ---- */

static CpsStatus find_length(const CpsiDocument *d, const CpsiPretensionValues *values,
                             CpsiPool *pool, const CpsScene *scene, CpsLine *line) {
    const int index = (int)(line - scene->line);
    const bool horizontal = isnan(values->tension);
    int section = CPS_WHOLE_LINE;
    if (!isnan(values->section)) section = (int)fmin(values->section, INT_MAX) - 1;
    if (line->section_count > 0 && section == CPS_WHOLE_LINE)
        return cpsi_document_fail(d, CPS_ERR_INPUT, values->node,
                                  "'pretension': 'section' is missing: the number, from 1 to %d, "
                                  "of the section whose length is found",
                                  line->section_count);
    CpsError found;
    double length;
    const CpsStatus status =
        cps_scene_length_for(scene, index, section, values->end,
                             horizontal ? CPS_PULL_HORIZONTAL : CPS_PULL_TENSION,
                             horizontal ? values->horizontal : values->tension, &length, &found);
    if (status != CPS_OK)
        return cpsi_document_fail(d, status == CPS_ERR_ARGUMENT ? CPS_ERR_INPUT : status,
                                  values->node, "%s", found.message);
    const CpsLineArrays arrays = {
        .element_length = CPSI_POOL_TAKE(pool, line->element_count, double),
        .section = CPSI_POOL_TAKE(pool, line->section_count + 1, CpsSection),
        .point_weight = CPSI_POOL_TAKE(pool, line->point_weight_count + 1, CpsPointWeight),
        .zone = CPSI_POOL_TAKE(pool, line->zone_count + 1, CpsFrictionZone)};
    if (!arrays.element_length || !arrays.section || !arrays.point_weight || !arrays.zone)
        return cpsi_document_no_memory(d);
    cps_line_resize(line, section, length, &arrays);
    return CPS_OK;
}

/* Does the history grasp a node of the line? */
static bool is_grasped(const CpsScene *scene, int line) {
    for (int s = 0; s < scene->stage_count; s++)
        for (int k = 0; k < scene->stage[s].grasp_change_count; k++)
            if (scene->stage[s].grasp_change[k].line == line) return true;
    return false;
}

CpsStatus cpsi_scene_find_lengths(const CpsiDocument *d, const CpsiSceneValues *values,
                                  CpsiPool *pool, CpsScene *scene) {
    const CpsiLineValues *from = values->lines.item;
    bool any = false;
    for (int i = 0; i < scene->line_count; i++) any = any || from[i].pretension.node;
    if (!any) return CPS_OK;
    CpsLine *line = CPSI_POOL_TAKE(pool, scene->line_count, CpsLine);
    if (!line) return cpsi_document_no_memory(d);
    memcpy(line, scene->line, (size_t)scene->line_count * sizeof *line);
    scene->line = line;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < scene->line_count && status == CPS_OK; i++)
        if (from[i].pretension.node && is_grasped(scene, i))
            status = cpsi_document_fail(
                d, CPS_ERR_INPUT, from[i].pretension.node,
                "'pretension': the history grasps a node of this line, whose arc length is not "
                "known before the length is found; give the line the length that `capstan check` "
                "prints without these entries, and no pretension");
        else if (from[i].pretension.node)
            status = find_length(d, &from[i].pretension, pool, scene, &line[i]);
    return status;
}
