/* SPDX-License-Identifier: BSD-3-Clause */
/* From the values of a scene file to the scene's structs (see scene_build.h). Defaults are those of
 * cps_scene_default() and similar functions, with which reading begins. */
#include "io/read/scene/scene_build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io/base/file/read_file.h"
#include "io/read/law/set_build.h"
#include "io/read/scene/parts/load_build.h"
#include "io/read/scene/parts/node_file.h"
#include "io/read/scene/parts/section_build.h"
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
    CpsiHeldBefore held; /* by the entries of the history so far */
    NamedPoint *by_name; /* (points) by name */
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
    CpsStatus status = cpsi_node_file_read(b->d, cpsi_yaml_child(values->start.node, "nodes"),
                                           values->start.nodes, b->pool, &file);
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

/* The set that an end or a point is held to. */
static CpsStatus build_set(Build *b, const CpsiOnValues *values, CpsConstraint *on) {
    *on = values->on;
    on->kind = (CpsConstraintKind)(CPS_CONSTRAINT_KIND_RAIL + values->kind);
    if (on->kind == CPS_CONSTRAINT_KIND_BOX && values->rotation.node) {
        cpsi_rotation_build(&values->rotation, on->rotation);
        const double *q = on->rotation;
        if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0)
            return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->rotation.node,
                                      "rotation: it is (0, 0, 0, 0), expected a quaternion of any "
                                      "length but zero");
    }
    if (on->kind == CPS_CONSTRAINT_KIND_SET)
        return cpsi_build_set(&b->set, values->set, (CpsSet **)&on->set);
    if (on->kind != CPS_CONSTRAINT_KIND_RAIL) return CPS_OK;
    on->length = INFINITY;
    if (values->rail == 1) return CPS_OK;
    for (int a = 0; a < 3; a++) on->axis[a] = values->to[a] - on->point[a];
    on->length = vec3_norm(vec3_load(on->axis));
    if (on->length > 0) return CPS_OK;
    return cpsi_document_fail(b->d, CPS_ERR_INPUT, values->node,
                              "rail: it goes from (%g, %g, %g) m to the same place: give it two "
                              "places, or hold what is on it",
                              on->point[0], on->point[1], on->point[2]);
}

static CpsStatus build_points(Build *b, const CpsiList *points) {
    const CpsiScenePointValues *values = points->item;
    if (points->count == 0) return CPS_OK;
    CpsPoint *point = CPSI_POOL_TAKE(b->pool, points->count, CpsPoint);
    b->held.point = CPSI_POOL_TAKE(b->d->pool, points->count, double[3]);
    b->by_name = CPSI_POOL_TAKE(b->d->pool, points->count, NamedPoint);
    if (!point || !b->held.point || !b->by_name) return cpsi_document_no_memory(b->d);
    b->scene->point = point;
    b->scene->point_count = points->count;
    for (int k = 0; k < points->count; k++) {
        point[k] = values[k].point;
        point[k].weight = cpsi_weight_in_water(&b->materials, values[k].mass, values[k].volume,
                                               values[k].point.weight);
        point[k].inertia = cpsi_moving_mass(values[k].inertia, values[k].mass);
        point[k].has_holding_capacity = !isnan(point[k].holding_capacity);
        if (!point[k].has_holding_capacity) point[k].holding_capacity = 0;
        point[k].has_uplift_limit = !isnan(point[k].uplift_limit);
        if (!point[k].has_uplift_limit) point[k].uplift_limit = 0;
        point[k].displaced_weight = cpsi_displaced_weight(&b->materials, values[k].volume);
        point[k].name = copy_text(b, values[k].node->key);
        if (!point[k].name) return cpsi_document_no_memory(b->d);
        copy_vector(b->held.point[k], point[k].position);
        if (point[k].kind == CPS_POINT_KIND_FREE || point[k].drags) b->held.point[k][0] = NAN;
        if (values[k].body) {
            const CpsiYaml *name = cpsi_yaml_child(values[k].node, "body");
            const CpsStatus status = cpsi_body_find(b->d, b->scene, name, &point[k].body);
            if (status != CPS_OK) return status;
            copy_vector(point[k].position, values[k].at);
            b->held.point[k][0] = NAN;
        }
        if (values[k].on.node) {
            const CpsStatus status = build_set(b, &values[k].on, &point[k].constraint);
            if (status != CPS_OK) return status;
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
 * force; or at a point, or in a set. */
static CpsStatus build_end(Build *b, const CpsiEndValues *values, CpsEnd *end, int *point,
                           CpsConstraint *on) {
    const bool is_free = values->word == CPSI_END_FREE;
    *end = (CpsEnd){.kind = CPS_END_KIND_AT_START};
    if (!is_free && !values->node) return CPS_OK;
    if (values->word == CPSI_END_ON_SET) {
        end->kind = CPS_END_KIND_FREE;
        copy_vector(end->value, values->on.force);
        return build_set(b, &values->on, on);
    }
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
    if (status == CPS_OK)
        status =
            cpsi_dynamic_stiffness_build(&b->materials, &values->dynamic,
                                         &line->has_dynamic_stiffness, &line->dynamic_stiffness);
    if (status == CPS_OK) status = build_elements(b, values, line);
    if (status == CPS_OK) status = build_zones(b, &values->zones, line);
    if (status == CPS_OK && values->sections.count > 0)
        status = cpsi_sections_build(&b->materials, values, line);
    if (status == CPS_OK)
        status = cpsi_point_weights_build(&b->materials, &values->point_weights, line);
    if (status == CPS_OK) status = cpsi_loads_build(&b->materials, values, line);
    if (status == CPS_OK)
        status = values->start.nodes ? build_nodes(b, values, line)
                                     : build_start(b, &values->start, &line->start);
    for (int end = 0; end < 2 && status == CPS_OK; end++) {
        const CpsiEndValues *of = &values->end[end];
        status = build_end(b, of, &line->end[end], &line->end_point[end], &line->constraint[end]);
        if (of->node && !isnan(of->stored))
            line->winch[end] = (CpsWinch){.is_there = true, .stored = of->stored};
        first_position(line, end, held[end]);
    }
    return status;
}

static CpsStatus build_lines(Build *b, const CpsiList *lines) {
    const CpsiLineValues *values = lines->item;
    b->line = CPSI_POOL_TAKE(b->pool, lines->count, CpsLine);
    b->held.end = CPSI_POOL_TAKE(b->pool, lines->count, double[2][3]);
    b->held.released = CPSI_POOL_TAKE(b->pool, lines->count, bool[2]);
    if (!b->line || !b->held.end || !b->held.released) return cpsi_document_no_memory(b->d);
    for (int i = 0; i < lines->count; i++) b->held.released[i][0] = b->held.released[i][1] = false;
    b->scene->line = b->line;
    b->scene->line_count = lines->count;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < lines->count && status == CPS_OK; i++)
        status = build_line(b, &values[i], &b->line[i], b->held.end[i]);
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
    CpsSet *set = NULL;
    *obstacle = values->obstacle;
    cpsi_shape_build(values, obstacle);
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
    if (status == CPS_OK)
        status = cpsi_current_build(&b.materials, &values->current, &values->waves, scene);
    if (status == CPS_OK) status = build_obstacles(&b, &values->obstacles);
    if (status == CPS_OK)
        status = cpsi_bodies_build(&b.materials, &values->bodies, scene, &b.held.body);
    if (status == CPS_OK) status = build_points(&b, &values->points);
    if (status == CPS_OK) status = build_lines(&b, &values->lines);
    const CpsiHistoryBuild history = {d, pool, scene, b.obstacle, b.held};
    if (status == CPS_OK) status = cpsi_history_build(&history, &values->history);
    return status ? status : cpsi_still_water_build(&b.materials, scene);
}
