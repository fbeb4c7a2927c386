/* SPDX-License-Identifier: BSD-3-Clause */
/* From a validated tree to the scene's structs. Defaults are those of cps_scene_default() and the like: a key that is
 * absent leaves its field alone. */
#include "io/read/scene_build.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/math.h"
#include "io/base/read_file.h"
#include "io/read/node_file.h"
#include "io/read/scene_store.h"
#include "io/read/set_build.h"

/* [rad] */
static const double DEGREE = CPSI_PI / 180;

typedef struct Build {
    const char *file;
    const CpsReadLimits *limits;
    CpsiPool *pool;
    CpsError *err;
    CpsScene *scene;
    CpsLine *line;
    CpsiLawBuild law;     /* of friction sets */
    double elements;      /* of the lines so far */
    double (*held)[2][3]; /* (lines) [m] where each end is held after the entry before; NaN: not held, or not known */
} Build;

static CpsStatus out_of_memory(const Build *b) {
    return cpsi_fail_at(b->err, CPS_ERR_MEMORY, b->file, 0, 0, "out of memory while reading the scene");
}

/* ---- values ---- */

static void copy_vector(const CpsiYaml *list, double out[3]) {
    const CpsiYaml *x = list->child;
    for (int i = 0; i < 3; i++, x = x->next) out[i] = x->number;
}

/* A missing key leaves out as it is. */
static void get_vector(const CpsiYaml *mapping, const char *key, double out[3]) {
    const CpsiYaml *node = cpsi_yaml_child(mapping, key);
    if (node) copy_vector(node, out);
}

static const char *copy_text(const Build *b, const char *text) { return cpsi_pool_text(b->pool, text, strlen(text)); }

/* ---- lines ---- */

/* Count the elements, within the limit, before room for them is made. Returns CPS_OK or CPS_ERR_LIMIT. */
static CpsStatus count_elements(Build *b, const CpsiYaml *line_node, const CpsiYaml *node, CpsLine *line) {
    double count = line->elements;
    if (node) count = node->kind == CPSI_YAML_SCALAR ? node->number : 0;
    if (node && node->kind == CPSI_YAML_SEQUENCE)
        for (const CpsiYaml *item = node->child; item; item = item->next)
            count += item->child ? item->child->number : 1;
    b->elements += count;
    const double limit = fmin((double)b->limits->max_elements, 1e9);
    const CpsiYaml *place = node ? node : line_node;
    if (!(b->elements <= limit))
        return cpsi_fail_at(
            b->err, CPS_ERR_LIMIT, b->file, place->line, place->column,
            "elements: %.15g elements in all lines so far, the limit is %.15g: use fewer, longer elements", b->elements,
            limit);
    line->elements = (int)count;
    return CPS_OK;
}

static CpsStatus build_elements(Build *b, const CpsiYaml *line_node, CpsLine *line) {
    const CpsiYaml *node = cpsi_yaml_child(line_node, "elements");
    const CpsStatus status = count_elements(b, line_node, node, line);
    if (status != CPS_OK || !node || node->kind == CPSI_YAML_SCALAR) return status;
    double *length = CPSI_POOL_TAKE(b->pool, line->elements, double);
    if (!length) return out_of_memory(b);
    line->element_length = length;
    for (const CpsiYaml *item = node->child; item; item = item->next) {
        const int count = item->child ? (int)item->child->number : 1;
        const double each = item->child ? item->child->next->number / count : item->number;
        for (int i = 0; i < count; i++) *length++ = each;
    }
    return CPS_OK;
}

/* ---- a start from nodes ---- */

static CpsStatus read_nodes(const Build *b, const CpsiYaml *node, CpsiNodeFile *file) {
    if (!cpsi_is_beside(node->text))
        return cpsi_fail_at(b->err, CPS_ERR_INPUT, b->file, node->line, node->column,
                            "'nodes': found '%.64s', expected the name of a file beside this one, without '/'", node->text);
    const char *path = cpsi_path_beside(b->pool, b->file, node->text);
    return path ? cpsi_node_file_read(path, b->limits->max_bytes, b->pool, file, b->err) : out_of_memory(b);
}

/* The elements of the file where the scene gives none; else both have the same. */
static CpsStatus read_elements(Build *b, const CpsiYaml *line_node, const CpsiNodeFile *file, CpsLine *line) {
    const CpsiYaml *given = cpsi_yaml_child(line_node, "elements");
    const double *arc = file->arc_length;
    if (!given) {
        b->elements += file->nodes - 1 - line->elements;
        line->elements = file->nodes - 1;
    }
    if (!(b->elements <= (double)b->limits->max_elements))
        return cpsi_fail_at(b->err, CPS_ERR_LIMIT, b->file, line_node->line, line_node->column,
                            "elements: %.15g elements in all lines so far, the limit is %lld", b->elements, (long long)b->limits->max_elements);
    if (given && line->elements != file->nodes - 1)
        return cpsi_fail_at(b->err, CPS_ERR_INPUT, b->file, given->line, given->column,
                            "'elements': found %d, expected %d, one less than nodes are given, or none", line->elements, file->nodes - 1);
    if (!arc) return CPS_OK;
    double *length = CPSI_POOL_TAKE(b->pool, line->elements, double), worst = 0;
    if (!length) return out_of_memory(b);
    for (int e = 0; e < line->elements; e++) {
        const double here = line->element_length ? line->element_length[e] : line->length / line->elements;
        length[e] = arc[e + 1] - arc[e];
        worst = fmax(worst, fabs(length[e] - here));
    }
    if (!given) line->element_length = length;
    if (!given || worst <= 1e-9 * line->length) return CPS_OK; /* written with 9 digits */
    return cpsi_fail_at(b->err, CPS_ERR_INPUT, b->file, given->line, given->column,
                        "'elements': natural lengths differ by %g m from those of arc_length in the file of nodes: leave one of the two out", worst);
}

static CpsStatus build_nodes(Build *b, const CpsiYaml *line_node, const CpsiYaml *node, CpsLine *line) {
    CpsiNodeFile file = {0};
    CpsStatus status = read_nodes(b, node, &file);
    if (status == CPS_OK) status = read_elements(b, line_node, &file, line);
    line->start = (CpsStart){.kind = CPS_START_NODES,
                             .point_count = file.nodes,
                             .point = file.position,
                             .tension = file.tension,
                             .reaction = file.reaction,
                             .friction_bound = file.friction_bound};
    return status;
}

static CpsStatus build_start(const Build *b, const CpsiYaml *node, CpsStart *start) {
    const CpsiYaml *straight = cpsi_yaml_child(node, "straight"), *polyline = cpsi_yaml_child(node, "polyline"),
                   *arc = cpsi_yaml_child(node, "arc");
    if (!straight && !polyline && !arc) {
        start->kind = CPS_START_LAID;
        return CPS_OK;
    }
    start->kind = straight ? CPS_START_STRAIGHT : polyline ? CPS_START_POLYLINE : CPS_START_ARC;
    start->point_count = polyline ? polyline->count : 2;
    double *point = CPSI_POOL_TAKE(b->pool, start->point_count, double[3]);
    if (!point) return out_of_memory(b);
    start->point = point;
    if (polyline) {
        for (const CpsiYaml *p = polyline->child; p; p = p->next, point += 3) copy_vector(p, point);
        return CPS_OK;
    }
    const CpsiYaml *shape = straight ? straight : arc;
    get_vector(shape, "from", point);
    get_vector(shape, straight ? "to" : "center", point + 3);
    get_vector(shape, "axis", start->axis);
    return CPS_OK;
}

/* `fixed`: where the start puts it, `free`: without force; or a mapping with one of fixed, force. */
static CpsEnd build_end(const CpsiYaml *node) {
    const CpsiYaml *force = cpsi_yaml_child(node, "force");
    CpsEnd end = {.kind = CPS_END_HELD, .value = {NAN, NAN, NAN}};
    if (force || (node->kind == CPSI_YAML_SCALAR && strcmp(node->text, "free") == 0))
        end = (CpsEnd){.kind = CPS_END_FREE};
    get_vector(node, force ? "force" : "fixed", end.value);
    return end;
}

/* Where an end is held at first; for the end of an arc only the start itself knows. */
static void first_position(const CpsLine *line, int end, double out[3]) {
    const CpsStart *start = &line->start;
    const double *value = line->end[end].value;
    const bool known = end == CPS_END_A || start->kind != CPS_START_ARC;
    const double *shape =
        start->point && known ? start->point + 3 * (end == CPS_END_A ? 0 : start->point_count - 1) : NULL;
    for (int i = 0; i < 3; i++) {
        out[i] = value[i];
        if (isnan(out[i]) && shape) out[i] = shape[i];
        if (line->end[end].kind == CPS_END_FREE) out[i] = NAN;
    }
}

static CpsStatus build_zones(const Build *b, const CpsiYaml *zones, CpsLine *line) {
    if (!zones || zones->count == 0) return CPS_OK;
    CpsFrictionZone *zone = CPSI_POOL_TAKE(b->pool, zones->count, CpsFrictionZone);
    if (!zone) return out_of_memory(b);
    line->zone = zone, line->zone_count = zones->count;
    for (const CpsiYaml *node = zones->child; node; node = node->next, zone++) {
        if (!cpsi_scene_store(CPSI_ZONE, node, b->pool, zone)) return out_of_memory(b);
    }
    return CPS_OK;
}

static CpsStatus build_line(Build *b, const CpsiYaml *node, CpsLine *line, double held[2][3]) {
    *line = cps_line_default();
    line->name = copy_text(b, node->key);
    if (!line->name || !cpsi_scene_store(CPSI_LINE, node, b->pool, line)) return out_of_memory(b);
    const CpsiYaml *mass = cpsi_yaml_child(node, "mass");
    const double *g = b->scene->gravity;
    if (mass) line->weight = mass->number * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);

    CpsStatus status = build_elements(b, node, line);
    if (status == CPS_OK) status = build_zones(b, cpsi_yaml_child(node, "friction_zones"), line);
    const CpsiYaml *start = cpsi_yaml_child(node, "start"), *nodes = cpsi_yaml_child(start, "nodes");
    if (status == CPS_OK) status = nodes ? build_nodes(b, node, nodes, line) : build_start(b, start, &line->start);
    const CpsiYaml *ends = cpsi_yaml_child(node, "ends");
    line->end[CPS_END_A] = build_end(cpsi_yaml_child(ends, "A"));
    line->end[CPS_END_B] = build_end(cpsi_yaml_child(ends, "B"));
    for (int end = 0; end < 2 && status == CPS_OK; end++) first_position(line, end, held[end]);
    return status;
}

static CpsStatus build_lines(Build *b, const CpsiYaml *lines) {
    b->line = CPSI_POOL_TAKE(b->pool, lines->count, CpsLine);
    b->held = CPSI_POOL_TAKE(b->pool, lines->count, double[2][3]);
    if (!b->line || !b->held) return out_of_memory(b);
    b->scene->line = b->line;
    b->scene->line_count = lines->count;
    CpsStatus status = CPS_OK;
    int i = 0;
    for (const CpsiYaml *node = lines->child; node && status == CPS_OK; node = node->next, i++)
        status = build_line(b, node, &b->line[i], b->held[i]);
    return status;
}

/* ---- obstacles ---- */

/* A set in the words of law files. */
static CpsStatus build_set(Build *b, const CpsiYaml *node, CpsObstacle *obstacle) {
    static const CpsiLawWord SET = {.name = "set", .key = {{.type = CPSI_SET}}};
    CpsiLawValue value[CPSI_LAW_MOST_KEYS] = {{.node = NULL}};
    const CpsStatus status = cpsi_law_read_values(&b->law, node, &SET, "'set'", value);
    if (status == CPS_OK) obstacle->friction_set = value[0].set[0], value[0].set[0] = NULL;
    cpsi_law_release(value);
    return status;
}

static CpsStatus build_obstacle(Build *b, const CpsiYaml *node, CpsObstacle *obstacle) {
    *obstacle = cps_obstacle_default();
    obstacle->name = copy_text(b, node->key);
    if (!obstacle->name || !cpsi_scene_store(CPSI_OBSTACLE, node, b->pool, obstacle)) return out_of_memory(b);
    obstacle->kind = cpsi_yaml_child(node, "plane")      ? CPS_OBSTACLE_PLANE
                     : cpsi_yaml_child(node, "cylinder") ? CPS_OBSTACLE_CYLINDER
                                                         : CPS_OBSTACLE_SPHERE;
    const CpsiYaml *set = cpsi_yaml_child(cpsi_yaml_child(node, "friction"), "set");
    return set ? build_set(b, set, obstacle) : CPS_OK;
}

static CpsStatus build_obstacles(Build *b, const CpsiYaml *obstacles) {
    if (!obstacles || obstacles->count == 0) return CPS_OK;
    CpsObstacle *obstacle = CPSI_POOL_TAKE(b->pool, obstacles->count, CpsObstacle);
    if (!obstacle) return out_of_memory(b);
    b->scene->obstacle = obstacle;
    b->scene->obstacle_count = obstacles->count;
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *node = obstacles->child; node && status == CPS_OK; node = node->next)
        status = build_obstacle(b, node, obstacle++);
    return status;
}

/* ---- history ---- */

/* The index of the line of LINE.END; the validation has seen that there is one. */
static int find_line(const Build *b, const char *line_end) {
    const size_t n = strlen(line_end) - 2;
    int i = 0;
    while (i + 1 < b->scene->line_count && (strncmp(b->line[i].name, line_end, n) != 0 || b->line[i].name[n])) i++;
    return i;
}

static CpsStatus build_change(const Build *b, const CpsiYaml *node, CpsChange *change) {
    change->line = find_line(b, node->key);
    change->end = cpsi_key_end(node->key) == 'A' ? CPS_END_A : CPS_END_B;
    const CpsiYaml *move = cpsi_yaml_child(node, "move"), *force = cpsi_yaml_child(node, "force");
    double *held = b->held[change->line][change->end];
    double *value = change->to.value;
    change->to.kind = force ? CPS_END_FREE : CPS_END_HELD;
    get_vector(node, force ? "force" : move ? "move" : "position", value);
    if (move && isnan(held[0]))
        return cpsi_fail_at(
            b->err, CPS_ERR_INPUT, b->file, move->line, move->column,
            "'%s': found a move, but the end's position before it is not known (it is free, or fixed at the "
            "end of an arc): give a position instead",
            node->key);
    for (int i = 0; i < 3; i++) {
        if (move) value[i] += held[i];
        held[i] = force ? NAN : value[i];
    }
    return CPS_OK;
}

/* The index of the obstacle of OBSTACLE.turn; the validation has seen that there is one. */
static int find_obstacle(const Build *b, const char *turn) {
    const size_t n = (size_t)(strrchr(turn, '.') - turn);
    int i = 0;
    while (i + 1 < b->scene->obstacle_count &&
           (strncmp(b->scene->obstacle[i].name, turn, n) != 0 || b->scene->obstacle[i].name[n]))
        i++;
    return i;
}

static CpsStatus build_stage(const Build *b, const CpsiYaml *node, int index, CpsStage *stage) {
    *stage = (CpsStage){.steps = 1};
    if (!cpsi_scene_store(CPSI_STAGE, node, b->pool, stage)) return out_of_memory(b);
    char number[32];
    snprintf(number, sizeof number, "entry %d", index + 1);
    if (!stage->name) stage->name = copy_text(b, number);
    stage->gravity_changes = cpsi_yaml_child(node, "gravity") != NULL;

    /* all other keys are ends of lines and turns of obstacles */
    CpsChange *change = CPSI_POOL_TAKE(b->pool, node->count, CpsChange);
    CpsTurn *turn = CPSI_POOL_TAKE(b->pool, node->count, CpsTurn);
    if (!stage->name || !change || !turn) return out_of_memory(b);
    stage->change = change;
    stage->turn = turn;
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *child = node->child; child && status == CPS_OK; child = child->next) {
        if (cpsi_key_end(child->key)) status = build_change(b, child, &change[stage->change_count++]);
        if (cpsi_key_is_turn(child->key))
            turn[stage->turn_count++] =
                (CpsTurn){.obstacle = find_obstacle(b, child->key), .angle = child->number * DEGREE};
    }
    return status;
}

static CpsStatus build_history(const Build *b, const CpsiYaml *history) {
    if (!history || history->count == 0) return CPS_OK;
    CpsStage *stage = CPSI_POOL_TAKE(b->pool, history->count, CpsStage);
    if (!stage) return out_of_memory(b);
    b->scene->stage = stage;
    b->scene->stage_count = history->count;
    int64_t steps = 0;
    int i = 0;
    for (const CpsiYaml *node = history->child; node; node = node->next, i++) {
        const CpsStatus status = build_stage(b, node, i, &stage[i]);
        if (status != CPS_OK) return status;
        steps += stage[i].steps;
        if (steps > b->limits->max_steps)
            return cpsi_fail_at(b->err, CPS_ERR_LIMIT, b->file, node->line, node->column,
                                "history: %lld load steps so far, the limit is %lld", (long long)steps,
                                (long long)b->limits->max_steps);
    }
    return CPS_OK;
}

CpsStatus cpsi_scene_build(const char *file, const CpsiYaml *root, const CpsReadLimits *limits, CpsiPool *pool,
                           CpsScene *scene, CpsError *err) {
    Build b = {.file = file, .limits = limits, .pool = pool, .err = err, .scene = scene};
    b.law.file = (CpsiLawFile){.name = file, .pool = pool, .err = err};
    *scene = cps_scene_default();
    if (!cpsi_scene_store(CPSI_SCENE, root, pool, scene)) return out_of_memory(&b);
    CpsStatus status = build_obstacles(&b, cpsi_yaml_child(root, "obstacles"));
    if (status == CPS_OK) status = build_lines(&b, cpsi_yaml_child(root, "lines"));
    if (status == CPS_OK) status = build_history(&b, cpsi_yaml_child(root, "history"));
    return status;
}
