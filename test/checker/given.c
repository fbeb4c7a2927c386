/* SPDX-License-Identifier: BSD-3-Clause */
/* Comparison of a file with its scene (given.h).
 *
 * A stage moves an end from its present value to the stage's value in equal steps. The present
 * value is the value imposed before; where the kind of the end changes, it is the position that the
 * end had reached, or the force that it carried. These two are results, and are taken from the
 * preceding step of the file; before the first step an end has the position of the start shape. */
#include "given.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "elongation.h"
#include "given_bodies.h"
#include "record.h"

/* Numbers of the scene are copied; a share of a stage, a weight vector and a load are a few
 * products and sums of them. */
static const double COPIED = 1e-14, COMPUTED = 1e-12;

typedef struct Compare {
    const CpsScene *scene;
    Source source;
    FILE *log;
    int findings;
} Compare;

__attribute__((format(printf, 2, 3))) static void find(Compare *compare, const char *format, ...) {
    compare->findings++;
    if (!compare->log) return;
    va_list list;
    va_start(list, format);
    fputs("not the scene's: ", compare->log);
    vfprintf(compare->log, format, list);
    fputc('\n', compare->log);
    va_end(list);
}

static double size(const double *v) { return hypot(hypot(v[0], v[1]), v[2]); }

/* count numbers equal to within `noise` of the largest, else a finding */
static void same(Compare *compare, const char *what, const char *of, const double *file,
                 const double *scene, size_t count, double noise) {
    double most = 0;
    for (size_t i = 0; i < count; i++) most = fmax(most, fabs(scene[i]));
    for (size_t i = 0; i < count; i++)
        if (!(fabs(file[i] - scene[i]) <= noise * most)) {
            find(compare, "%s of %s is %.17g, in the scene %.17g", what, of, file[i], scene[i]);
            return;
        }
}

static void same_number(Compare *compare, const char *what, const char *of, double file,
                        double scene) {
    same(compare, what, of, &file, &scene, 1, COPIED);
}

/* ---- what holds for the whole run ---- */

/* Two sets with the same support in DIRECTIONS directions, to what small programs leave of it. */
static void compare_sets(Compare *compare, const CpsObstacle *o, const Surface *s) {
    enum { DIRECTIONS = 48 };
    for (int i = 0; i < DIRECTIONS; i++) {
        const double angle = 6.283185307179586 * i / DIRECTIONS, d[2] = {cos(angle), sin(angle)};
        CpsSetAnswer answer;
        if (cps_set_support(o->friction_set, d, NULL, &answer, NULL) != CPS_OK ||
            answer.outcome != CPS_SET_OUTCOME_ANSWERED)
            return;
        const double file = (double)conic_support(s->set, (Real[]){d[0], d[1]});
        if (fabs(file - answer.value) <= answer.gap + 1e-9 * (double)s->set->reach) continue;
        find(compare, "friction set of %s reaches %.17g along (%.3g, %.3g), in the scene %.17g",
             o->name, file, d[0], d[1], answer.value);
        return;
    }
}

static void compare_obstacle(Compare *compare, const CpsObstacle *o, const Surface *s) {
    const bool plane = o->kind == CPS_OBSTACLE_PLANE;
    const double *given = plane ? o->normal : o->axis, length = size(given);
    double axis[3], point[3], there[3], grain[3], unit[3];
    for (int k = 0; k < 3; k++) {
        there[k] = o->point[k] - compare->source.origin[k];
        axis[k] = (double)s->axis[k];
        point[k] = (double)s->point[k];
        grain[k] = (double)s->grain[k];
        unit[k] = given[k] / length;
    }
    same_number(compare, "kind", o->name, s->kind, o->kind);
    same(compare, "point", o->name, point, there, 3, COPIED);
    same(compare, "axis", o->name, axis, unit, 3, COMPUTED);
    same_number(compare, "radius", o->name, (double)s->radius, plane ? 0 : o->radius);
    if ((s->set != NULL) != (o->friction_set != NULL))
        find(compare, "friction set of %s: one of the two has none", o->name);
    if (s->set && o->friction_set) compare_sets(compare, o, s);
    same(compare, "grain", o->name, grain, o->grain, 3, COPIED);
    if (s->set || o->friction_set) return;
    same_number(compare, "axial coefficient", o->name, (double)s->mu[0], o->friction);
    same_number(compare, "lateral coefficient", o->name, (double)s->mu[1],
                o->has_friction_lateral ? o->friction_lateral : o->friction);
    same_number(compare, "shape of friction", o->name, s->box,
                o->friction_shape == CPS_FRICTION_SHAPE_BOX);
}

static void compare_run(Compare *compare) {
    const CpsScene *scene = compare->scene;
    const Source *source = &compare->source;
    same_number(compare, "tolerance", "the run", source->tolerance, scene->solver.tolerance);
    same(compare, "gravity", "the run", source->gravity, scene->gravity, 3, COPIED);
    if (source->consistent != (scene->friction_policy == CPS_FRICTION_POLICY_CONSISTENT))
        find(compare, "friction_policy: frozen or consistent");
    if (source->touching_only != (scene->contact_policy == CPS_CONTACT_POLICY_REFERENCE))
        find(compare, "contact_policy: reference or reached");
    if (source->surfaces != (size_t)scene->obstacle_count) {
        find(compare, "%zu obstacles, in the scene %d", source->surfaces, scene->obstacle_count);
        return;
    }
    for (int k = 0; k < scene->obstacle_count; k++)
        compare_obstacle(compare, &scene->obstacle[k], &source->surface[k]);
}

/* The section of element i, whose middle lies at `middle`; NULL without sections. */
static const CpsSection *section_at(const CpsLine *line, double middle) {
    const CpsSection *section = line->section;
    double end = 0;
    for (int k = 0; k < line->section_count; k++) {
        section = &line->section[k];
        end += section->length;
        if (middle < end) break;
    }
    return line->section_count > 0 ? section : NULL;
}

/* The rows of its table; 0: it has none. */
static int table_of(const CpsLine *line, const CpsSection *section, const CpsStiffnessRow **row) {
    *row = section ? section->stiffness_row : line->stiffness_row;
    return section ? section->stiffness_row_count : line->stiffness_row_count;
}

static double softness(const CpsLine *line, const CpsSection *section) {
    const CpsStiffnessRow *row;
    if (table_of(line, section, &row) > 0) return row[1].strain / row[1].tension;
    const double stiffness = section ? section->stiffness : line->stiffness;
    return isinf(stiffness) ? 0 : 1 / stiffness;
}

/* [N] What the nodes weigh in the scene, (nodes): half of their elements, and what hangs there; and
 * the sum of the sizes of these terms. */
static void node_weights(const CpsLine *line, const Record *r, double *weight, double *sizes) {
    double arc = 0;
    for (size_t j = 0; j < r->nodes; j++) weight[j] = sizes[j] = 0;
    for (size_t i = 0; i < r->elements; i++) {
        const double l = r->element_length[i];
        const CpsSection *section = section_at(line, arc + l / 2);
        const double half = l * (section ? section->weight : line->weight) / 2;
        weight[i] += half;
        weight[i + 1] += half;
        arc += l;
        for (int k = 0; k < line->point_weight_count; k++) {
            const CpsPointWeight *point = &line->point_weight[k];
            if (fabs(point->arc_length - arc) > 1e-8 * line->length) continue;
            weight[i + 1] += point->weight;
            sizes[i + 1] += fabs(point->weight);
        }
    }
    for (size_t j = 0; j < r->nodes; j++) sizes[j] = fmax(sizes[j], fabs(weight[j]));
}

/* [N/m] All weights over the length, buoys as if they hung: the unit of the file's weights. */
static double mean_weight(const CpsLine *line) {
    double sum = line->section_count > 0 ? 0 : line->weight * line->length;
    for (int k = 0; k < line->section_count; k++)
        sum += line->section[k].weight * line->section[k].length;
    for (int k = 0; k < line->point_weight_count; k++) sum += fabs(line->point_weight[k].weight);
    return sum / line->length;
}

static void compare_weights(Compare *compare, const CpsLine *line, const Record *r) {
    const double mean = mean_weight(line);
    if (!(mean > 0)) return;
    double *own = calloc(2 * r->nodes, sizeof *own), *sizes = own + r->nodes;
    if (!own) {
        find(compare, "no memory for the weights of %s", line->name);
        return;
    }
    node_weights(line, r, own, sizes);
    for (size_t j = 0; j < r->nodes; j++) {
        if (fabs(r->weight_length[j] * mean - own[j]) <= COMPUTED * (sizes[j] + mean)) continue;
        find(compare, "weight_length of %s at node %zu is %.17g m, in the scene %.17g m",
             line->name, j, r->weight_length[j], own[j] / mean);
        break;
    }
    free(own);
}

/* Stiffness along the line, and whether its weights differ. */
static void compare_sections(Compare *compare, const CpsLine *line, const Record *r) {
    double arc = 0, mean = 0;
    for (size_t i = 0; i < r->elements; i++) {
        const double l = r->element_length[i],
                     given = softness(line, section_at(line, arc + l / 2));
        mean += l * given / line->length;
        arc += l;
        if (fabs(r->element_compliance[i] - given) <= COMPUTED * given) continue;
        find(compare, "compliance of %s: %.17g in element %zu, in the scene %.17g", line->name,
             r->element_compliance[i], i, given);
        return;
    }
    if (line->section_count == 0) mean = softness(line, NULL);
    const bool computed = line->section_count > 0 || line->stiffness_row_count > 0;
    if (!(fabs(r->compliance - mean) <= (computed ? COMPUTED * mean : 0)))
        find(compare, "compliance of %s is %.17g, in the scene %.17g", line->name, r->compliance,
             mean);
    const bool uniform = line->section_count == 0 && line->point_weight_count == 0;
    if (uniform != (r->weight_length == NULL))
        find(compare, "sections or point weights of %s", line->name);
    else if (!uniform)
        compare_weights(compare, line, r);
}

/* Do the springs of the file reach every row of the scene's tables, and the slope beyond? */
static void compare_tables(Compare *compare, const CpsLine *line, const Record *r) {
    double arc = 0;
    for (size_t i = 0; i < r->elements; i++) {
        const CpsStiffnessRow *row;
        const double l = r->element_length[i];
        const int rows = table_of(line, section_at(line, arc + l / 2), &row);
        arc += l;
        if (rows == 0 && r->spring_of && r->spring_of[i] < r->spring_of[i + 1])
            find(compare, "springs of %s in element %zu, in the scene none", line->name, i);
        for (int k = 1; k < rows + 1; k++) {
            const int last = rows - 1;
            const double by = k < rows ? 0 : row[last].strain,
                         slope = (row[last].tension - row[last - 1].tension) /
                                 (row[last].strain - row[last - 1].strain);
            const double strain = k < rows ? row[k].strain : row[last].strain + by,
                         given = k < rows ? row[k].tension : row[last].tension + slope * by,
                         found = (double)elongation_tension(r, i, strain);
            if (fabs(found - given) <= COMPUTED * given) continue;
            find(compare,
                 "tension of %s in element %zu at the strain %g: %.17g N, in the scene "
                 "%.17g N",
                 line->name, i, strain, found, given);
            return;
        }
    }
}

static void compare_breaking_load(Compare *compare, const CpsLine *line, const Record *r) {
    double arc = 0;
    bool any = line->section_count == 0 && line->has_breaking_load;
    for (int k = 0; k < line->section_count; k++) any = any || line->section[k].has_breaking_load;
    if (any != (r->breaking_load != NULL)) {
        find(compare, "breaking_load of %s", line->name);
        return;
    }
    if (!any) return;
    for (size_t i = 0; i < r->elements; i++) {
        const CpsSection *section = section_at(line, arc + r->element_length[i] / 2);
        const bool has = section ? section->has_breaking_load : line->has_breaking_load;
        const double load = section ? section->breaking_load : line->breaking_load;
        arc += r->element_length[i];
        if (r->breaking_load[i] == (has ? load : INFINITY)) continue;
        find(compare, "breaking_load of %s: %.17g in element %zu", line->name, r->breaking_load[i],
             i);
        return;
    }
}

static void compare_line(Compare *compare, const CpsLine *line, const Record *r) {
    if (r->elements != (size_t)line->element_count) {
        find(compare, "%zu elements of %s, in the scene %d", r->elements, line->name,
             line->element_count);
        return;
    }
    for (size_t i = 0; i < r->elements; i++) {
        const double given =
            line->element_length ? line->element_length[i] : line->length / line->element_count;
        if (fabs(r->element_length[i] - given) <= COPIED * given) continue;
        find(compare, "element_length of %s is %.17g, in the scene %.17g", line->name,
             r->element_length[i], given);
        return;
    }
    compare_sections(compare, line, r);
    compare_tables(compare, line, r);
    compare_breaking_load(compare, line, r);
    /* what zones do is in the mean factors, which the reader has made of those in the file */
    double at = 0;
    for (size_t j = 0; j < r->nodes; j++) {
        const double before = j > 0 ? r->element_length[j - 1] : 0,
                     after = j < r->elements ? r->element_length[j] : 0;
        at += before;
        double sum = (before + after) / 2, most = 1;
        for (int k = 0; k < line->zone_count; k++) {
            const CpsFrictionZone *zone = &line->zone[k];
            const double common =
                fmin(at + after / 2, zone->to) - fmax(at - before / 2, zone->from);
            if (common > 0) {
                sum += (zone->factor - 1) * common;
                most = fmax(most, zone->factor);
            }
        }
        const double factor = sum / ((before + after) / 2), file = r->factor ? r->factor[j] : 1;
        if (fabs(file - factor) <= COMPUTED * most * line->length / (before + after)) continue;
        find(compare, "friction_zones of %s: factor %.17g at node %zu, in the scene %.17g",
             line->name, file, j, factor);
        return;
    }
}

/* ---- steps ---- */

/* The stage and its part that a step is; false: the statics of lines laid, or a scene without
 * stages. */
static bool stage_of(const Compare *compare, size_t step, int *stage, int *part) {
    if (compare->source.has_static && step-- == 0) return false;
    for (*stage = 0; *stage < compare->scene->stage_count; ++*stage) {
        const size_t steps = (size_t)compare->scene->stage[*stage].step_count;
        *part = (int)step + 1;
        if (step < steps) return true;
        step -= steps;
    }
    return false;
}

static size_t planned(const Compare *compare) {
    size_t steps = 0;
    bool first = false;
    for (int i = 0; i < compare->scene->stage_count; i++)
        steps += (size_t)compare->scene->stage[i].step_count;
    for (int i = 0; i < compare->scene->line_count; i++)
        first = first || compare->scene->line[i].start.kind == CPS_START_STATIC;
    return steps + first > 0 ? steps + first : 1;
}

/* An end of a line as the scene has it. */
typedef struct Imposed {
    CpsEnd from, now;
    double noise; /* COPIED, or COMPUTED where it starts from the end of an arc, a sum of angles */
} Imposed;

/* What is imposed, places about the origin of the file; NaN stays NaN. */
static CpsEnd about(const Source *source, CpsEnd end) {
    if (end.kind == CPS_END_KIND_HELD)
        for (int k = 0; k < 3; k++) end.value[k] -= source->origin[k];
    return end;
}

/* End B of an arc: elements are chords of the circle about the axis through the centre, one after
 * the other from A. */
static void arc_end(const CpsLine *line, const Record *r, double place[3]) {
    const double *from = line->start.point, *centre = &line->start.point[3],
                 *axis = line->start.axis;
    const double length = size(axis);
    double unit[3], spoke[3], along = 0, angle = 0;
    for (int k = 0; k < 3; k++) {
        unit[k] = axis[k] / length;
        along += (from[k] - centre[k]) * unit[k];
    }
    for (int k = 0; k < 3; k++) spoke[k] = from[k] - centre[k] - along * unit[k];
    for (size_t i = 0; i < r->elements; i++)
        angle += 2 * asin(r->element_length[i] / (2 * size(spoke)));
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        place[k] = centre[k] + along * unit[k] + cos(angle) * spoke[k] +
                   sin(angle) * (unit[a] * spoke[b] - unit[b] * spoke[a]);
    }
}

/* Where the start puts an end. The first record has it as well, but only where the step was taken
 * in one part. */
static void start_place(const Source *source, const CpsLine *line, int e, const Record *r,
                        double place[3]) {
    const CpsStart *start = &line->start;
    const bool arc = start->kind == CPS_START_ARC, drawn = start->kind != CPS_START_STATIC;
    const double *point = drawn ? &start->point[e && !arc ? 3 * (start->point_count - 1) : 0]
                                : r->reference[e ? r->elements : 0];
    memcpy(place, point, 3 * sizeof *place);
    if (arc && e) arc_end(line, r, place);
    if (drawn)
        for (int k = 0; k < 3; k++) place[k] -= source->origin[k];
}

/* Where the end starts: a held end without a place of its own is where the start puts it. */
static CpsEnd first_end(const Source *source, const CpsLine *line, int e, const Record *r) {
    CpsEnd end = about(source, line->end[e]);
    double place[3];
    start_place(source, line, e, r, place);
    if (end.kind != CPS_END_KIND_AT_START) return end;
    end.kind = CPS_END_KIND_HELD;
    memcpy(end.value, place, sizeof end.value);
    return end;
}

/* The end at part k of a stage that changes it; `before`: the step before, NULL for the first;
 * `start`: where it starts. */
static void impose(const Source *source, Imposed *end, const CpsStage *stage, int part, int line,
                   int e, const Record *before, const double start[3]) {
    for (int i = 0; i < stage->change_count; i++) {
        const CpsChange *change = &stage->change[i];
        if (change->line != line || change->end != e) continue;
        if (part == 1) end->from = end->now;
        const double *place = before ? before->position[e ? before->elements : 0] : start;
        if (part == 1 && before) end->noise = COPIED;
        if (part == 1 && change->to.kind != end->now.kind)
            for (int k = 0; k < 3; k++)
                end->from.value[k] = change->to.kind == CPS_END_KIND_HELD ? place[k]
                                     : before                             ? before->end_force[e][k]
                                                                          : 0;
        const double share = (double)part / stage->step_count;
        const CpsEnd to = about(source, change->to);
        end->now.kind = to.kind;
        for (int k = 0; k < 3; k++)
            end->now.value[k] =
                part == stage->step_count
                    ? to.value[k]
                    : end->from.value[k] + share * (to.value[k] - end->from.value[k]);
    }
}

static void compare_end(Compare *compare, const CpsLine *line, int e, const Imposed *end,
                        const CpsEnd *was, size_t step, const Record *r) {
    char of[300];
    snprintf(of, sizeof of, "%.200s, end %c, step %zu", line->name, e ? 'B' : 'A', step);
    if (r->end_kind[e] != (end->now.kind == CPS_END_KIND_FREE)) {
        find(compare, "end_kind of %s", of);
        return;
    }
    // where a part of a step has no equilibrium, the file has the end on its way
    const bool ended = r->outcome == OUTCOME_UNBOUNDED || r->outcome == OUTCOME_INFEASIBLE ||
                       r->outcome == OUTCOME_SLIDES;
    if (ended && (r->substeps > 1 || r->share < 1)) return;
    const double most = fmax(size(end->now.value), size(was->value));
    const bool held = r->end_kind[e] == END_HELD;
    const double *value = held ? r->held_position[e] : r->applied_force[e];
    for (int k = 0; k < 3; k++)
        if (!(fabs(value[k] - end->now.value[k]) <= end->noise * most))
            find(compare, "%s of %s is %.17g, in the scene %.17g",
                 held ? "end_held_position" : "end_applied_force", of, value[k], end->now.value[k]);
}

/* Gravity of the scene after so many steps of a stage, or without one that of its beginning. */
static void gravity_at(const Compare *compare, bool staged, int stage, int part, double g[3]) {
    const CpsScene *scene = compare->scene;
    memcpy(g, scene->gravity, 3 * sizeof *g);
    if (staged)
        for (int s = 0; s <= stage; s++) {
            const double share = s < stage ? 1 : (double)part / scene->stage[s].step_count;
            if (scene->stage[s].gravity_changes)
                for (int k = 0; k < 3; k++) g[k] += share * (scene->stage[s].gravity[k] - g[k]);
        }
}

/* Weight, half of each element to each of its nodes, and the forces at free ends; and the weight
 * before the step. What has no equilibrium may be on its way. */
static void compare_loads(Compare *compare, const CpsLine *line, size_t step, const Record *r) {
    int stage = 0, part = 0;
    double g[3], was[3];
    const bool staged = stage_of(compare, step, &stage, &part);
    gravity_at(compare, staged, stage, part, g);
    gravity_at(compare, staged, stage, part - 1, was);
    if ((r->outcome == OUTCOME_UNBOUNDED || r->outcome == OUTCOME_INFEASIBLE ||
         r->outcome == OUTCOME_SLIDES) &&
        memcmp(g, was, sizeof g) != 0)
        return;
    const double pull = size(compare->scene->gravity),
                 weight = pull > 0 ? mean_weight(line) / pull : 0,
                 most = weight * fmax(size(g), size(was));
    if (r->has_weight_before && r->substeps == 1)
        for (int k = 0; k < 3; k++)
            if (!(fabs(r->weight_before[k] - weight * was[k]) <= COPIED * most))
                find(compare, "weight_before of %s, step %zu, is %.17g, in the scene %.17g",
                     line->name, step, r->weight_before[k], weight * was[k]);
    double *own = calloc(2 * r->nodes, sizeof *own), *sizes = own + r->nodes;
    if (!own) {
        find(compare, "no memory for the weights of %s", line->name);
        return;
    }
    node_weights(line, r, own, sizes);
    for (size_t j = 0; j < r->nodes; j++) {
        const double here = pull > 0 ? own[j] / pull : 0;
        double load[3], noise = pull > 0 ? sizes[j] / pull * fmax(size(g), size(was)) : 0;
        for (int k = 0; k < 3; k++) load[k] = here * g[k];
        for (int e = 0; e < 2; e++) {
            if (r->end_kind[e] == END_HELD || j != (e ? r->elements : 0)) continue;
            for (int k = 0; k < 3; k++) load[k] += r->applied_force[e][k];
            noise += size(r->applied_force[e]);
        }
        for (int k = 0; k < 3; k++)
            if (!(fabs(r->load[j][k] - load[k]) <= COPIED * noise)) {
                find(compare, "load of %s at node %zu, step %zu, is %.17g, in the scene %.17g",
                     line->name, j, step, r->load[j][k], load[k]);
                free(own);
                return;
            }
    }
    free(own);
}

/* The larger coefficient of whatever the node touches, by its obstacle in the file; of a given set
 * 1. */
static double coefficient(const Compare *compare, const Record *r, size_t j) {
    const int k = r->obstacle[j] >= 0 && r->obstacle[j] < compare->scene->obstacle_count
                      ? (int)r->obstacle[j]
                      : 0;
    const CpsObstacle *o = &compare->scene->obstacle[k];
    return (r->factor ? r->factor[j] : 1) *
           (o->friction_set ? 1 : fmax(o->friction, o->friction_lateral));
}

/* A start from nodes: the first step begins there, and frozen friction has the bounds that are
 * given, A = mu R, but where they are small beside the largest and count for none. A step in
 * several parts has the reference of the last of them. */
static void compare_nodes(Compare *compare, const CpsLine *line, const Record *r) {
    const CpsStart *start = &line->start;
    if (start->kind != CPS_START_NODES || r->substeps != 1) return;
    for (size_t j = 0; j < r->nodes; j++) {
        double place[3];
        for (int k = 0; k < 3; k++)
            place[k] = start->point[3 * j + (size_t)k] - compare->source.origin[k];
        same(compare, "first reference", line->name, r->reference[j], place, 3, COPIED);
    }
    const double *force = start->friction_bound ? start->friction_bound : start->reaction;
    if (!force || compare->source.consistent || compare->scene->obstacle_count == 0) return;
    double largest = 0;
    for (size_t j = 0; j < r->nodes; j++)
        largest =
            fmax(largest, force[j] * (start->friction_bound ? 1 : coefficient(compare, r, j)));
    for (size_t j = 0; j < r->nodes; j++) {
        const bool held = (j == 0 && r->end_kind[0] == END_HELD) ||
                          (j == r->elements && r->end_kind[1] == END_HELD);
        const double given = force[j] * (start->friction_bound ? 1 : coefficient(compare, r, j)),
                     found = r->friction_bound[j];
        if (held || (found == 0 && given <= 1e-3 * largest)) continue;
        if (fabs(found - given) <= COMPUTED * given + 1e-12 * largest)
            continue; /* a factor is a mean of sums of abscissae */
        find(compare,
             "friction bound of %s at node %zu in the first step is %.17g, in the scene %.17g",
             line->name, j, found, given);
        return;
    }
}

static void compare_turns(Compare *compare, size_t step, const Record *r) {
    int stage = 0, part = 0;
    const bool staged = stage_of(compare, step, &stage, &part);
    for (int k = 0; k < compare->scene->obstacle_count; k++) {
        double angle = 0;
        if (staged)
            for (int i = 0; i < compare->scene->stage[stage].turn_count; i++) {
                const CpsTurn *turn = &compare->scene->stage[stage].turn[i];
                if (turn->obstacle == k)
                    angle = turn->angle / compare->scene->stage[stage].step_count;
            }
        if (!(fabs(r->turn[k] - angle) <= COPIED * fabs(angle)))
            find(compare, "obstacle_turn of %s, step %zu, is %.17g, in the scene %.17g",
                 compare->scene->obstacle[k].name, step, r->turn[k], angle);
    }
}

/* Whether the end is at a point, the same as in the scene: then nothing is imposed on it here. */
static bool is_at_point(Compare *compare, const CpsLine *line, int e, const Record *r) {
    const bool is_at = line->end[e].kind == CPS_END_KIND_POINT;
    const int point = is_at ? line->end_point[e] : -1;
    if (r->end_point[e] != point)
        find(compare, "end_point of %s, end %c, is %d, in the scene %d", line->name, e ? 'B' : 'A',
             r->end_point[e], point);
    return is_at;
}

/* ---- points ---- */

/* What the scene imposes on a point: its position, or the force on it. */
typedef struct ImposedPoint {
    CpsPointKind kind;
    double from[3], now[3];
    /* of a point that is let go the force it begins with is a result: it is known when the stage
     * ends */
    bool is_known;
} ImposedPoint;

static void impose_on_point(const Compare *compare, ImposedPoint *point,
                            const CpsPointChange *change, int part, int parts,
                            const Junction *before) {
    const double share = (double)part / parts;
    double to[3];
    for (int k = 0; k < 3; k++)
        to[k] = change->value[k] -
                (change->kind == CPS_POINT_KIND_HELD ? compare->source.origin[k] : 0);
    if (part == 1) {
        memcpy(point->from, point->now, sizeof point->from);
        if (change->kind != point->kind && change->kind == CPS_POINT_KIND_HELD && before)
            memcpy(point->from, before->position, sizeof point->from);
        point->is_known =
            point->is_known && (change->kind == point->kind || change->kind == CPS_POINT_KIND_HELD);
        point->kind = change->kind;
    }
    point->is_known = point->is_known || part == parts;
    for (int k = 0; k < 3; k++)
        point->now[k] = part == parts ? to[k] : point->from[k] + share * (to[k] - point->from[k]);
}

static void compare_point(Compare *compare, const CpsPoint *given, const ImposedPoint *point,
                          size_t step, const double g[3], const Junction *at) {
    const bool is_held = point->kind == CPS_POINT_KIND_HELD;
    const double pull = size(compare->scene->gravity);
    double wanted[3], noise = 0;
    if (point->kind == CPS_POINT_KIND_ON_BODY) { /* where it is follows from its body */
        if (at->state != POINT_ON_BODY)
            find(compare, "state_of_point of %s, step %zu", given->name, step);
        return;
    }
    if ((at->state == POINT_HELD) != is_held) {
        find(compare, "state_of_point of %s, step %zu", given->name, step);
        return;
    }
    if (!point->is_known) return;
    for (int k = 0; k < 3; k++) {
        const double weight = is_held || pull == 0 ? 0 : given->weight / pull * g[k];
        wanted[k] = point->now[k] + weight;
        noise += fabs(point->now[k]) + fabs(point->from[k]) + fabs(weight);
        if (is_held) noise += fabs(compare->source.origin[k]);
    }
    const double *found = is_held ? at->position : at->load;
    for (int k = 0; k < 3; k++)
        if (!(fabs(found[k] - wanted[k]) <= COPIED * noise))
            find(compare, "%s_of_point of %s, step %zu, is %.17g, in the scene %.17g",
                 is_held ? "position" : "load", given->name, step, found[k], wanted[k]);
}

static void compare_points_at(Compare *compare, size_t step, ImposedPoint *imposed,
                              const Junction *before, const Junction *now) {
    int stage = 0, part = 0;
    double g[3];
    const bool staged = stage_of(compare, step, &stage, &part);
    gravity_at(compare, staged, stage, part, g);
    const CpsStage *at = staged ? &compare->scene->stage[stage] : NULL;
    const int changes = staged ? at->point_change_count : 0;
    for (int i = 0; i < changes; i++) {
        const CpsPointChange *change = &at->point_change[i];
        impose_on_point(compare, &imposed[change->point], change, part, at->step_count,
                        step > 0 ? &before[change->point] : NULL);
    }
    for (int k = 0; k < compare->scene->point_count; k++)
        compare_point(compare, &compare->scene->point[k], &imposed[k], step, g, &now[k]);
}

/* Names, kinds and weights; and what is imposed at first. */
static void compare_given_points(Compare *compare, ImposedPoint *imposed) {
    const Source *source = &compare->source;
    for (int k = 0; k < compare->scene->point_count; k++) {
        const CpsPoint *point = &compare->scene->point[k];
        const bool is_held = point->kind == CPS_POINT_KIND_HELD;
        const int kind = point->kind == CPS_POINT_KIND_ON_BODY ? POINT_KIND_ON_BODY
                         : is_held                             ? POINT_HELD
                                                               : POINT_FREE;
        if (strcmp(source->point_name[k], point->name) != 0)
            find(compare, "point %s, in the scene %s", source->point_name[k], point->name);
        if (source->point_kind[k] != kind) find(compare, "kind_of_point of %s", point->name);
        same_number(compare, "weight_of_point", point->name, source->point_weight[k],
                    point->weight);
        imposed[k] = (ImposedPoint){.kind = point->kind, .is_known = true};
        for (int a = 0; a < 3; a++)
            imposed[k].now[a] = imposed[k].from[a] =
                is_held ? point->position[a] - source->origin[a] : point->force[a];
    }
}

static int compare_points(Compare *compare) {
    const Source *source = &compare->source;
    const size_t n = source->points;
    if (n != (size_t)compare->scene->point_count) {
        find(compare, "%zu points, in the scene %d", n, compare->scene->point_count);
        return 0;
    }
    if (n == 0) return 0;
    ImposedPoint *imposed = calloc(n, sizeof *imposed);
    Junction *now = calloc(n, sizeof *now), *before = calloc(n, sizeof *before);
    int bad = imposed && now && before ? 0 : -1;
    if (!bad) compare_given_points(compare, imposed);
    for (size_t step = 0; step < source->steps && !bad && compare->findings == 0; step++) {
        bad = junctions_read(source, step, now, compare->log);
        if (!bad) compare_points_at(compare, step, imposed, before, now);
        Junction *swap = before;
        before = now;
        now = swap;
    }
    free(imposed);
    free(now);
    free(before);
    return bad;
}

/* ---- bodies ---- */

static GivenStep step_of(const void *user, size_t step) {
    const Compare *compare = user;
    int stage = 0, part = 0;
    GivenStep given = {0};
    const bool staged = stage_of(compare, step, &stage, &part);
    gravity_at(compare, staged, stage, part, given.gravity);
    given.stage = staged ? &compare->scene->stage[stage] : NULL;
    given.part = part;
    return given;
}

static void find_at_body(void *user, const char *sentence) { find(user, "%s", sentence); }

static int compare_steps(Compare *compare, int index) {
    const CpsLine *line = &compare->scene->line[index];
    Record now = {0}, before = {0};
    int bad = record_create(&compare->source, line->name, &now, compare->log);
    if (!bad) bad = record_create(&compare->source, line->name, &before, compare->log);
    if (!bad) compare_line(compare, line, &now);
    Imposed end[2] = {0};
    for (size_t step = 0; step < compare->source.steps && !bad && compare->findings == 0; step++) {
        bad = record_read(&compare->source, line->name, step, &now, compare->log);
        int stage, part;
        if (!bad)
            for (int e = 0; e < 2; e++) {
                if (is_at_point(compare, line, e, &now)) continue;
                if (step == 0) {
                    end[e].now = first_end(&compare->source, line, e, &now);
                    end[e].noise = line->start.kind == CPS_START_ARC ? COMPUTED : COPIED;
                }
                const CpsEnd was = end[e].now;
                double start[3];
                start_place(&compare->source, line, e, &now, start);
                if (stage_of(compare, step, &stage, &part))
                    impose(&compare->source, &end[e], &compare->scene->stage[stage], part, index, e,
                           step > 0 ? &before : NULL, start);
                compare_end(compare, line, e, &end[e], &was, step, &now);
            }
        if (!bad && step == 0) compare_nodes(compare, line, &now);
        if (!bad) compare_loads(compare, line, step, &now);
        if (!bad && index == 0) compare_turns(compare, step, &now);
        const Record swap = before;
        before = now;
        now = swap;
    }
    record_destroy(&now);
    record_destroy(&before);
    return bad;
}

int given_file(const char *path, const CpsScene *scene, FILE *log) {
    Compare compare = {.scene = scene, .log = log};
    int bad = source_open(path, &compare.source, log);
    if (!bad) compare_run(&compare);
    if (!bad && compare.source.steps > planned(&compare))
        find(&compare, "%zu steps, in the scene %zu", compare.source.steps, planned(&compare));
    if (!bad && compare.source.lines != (size_t)scene->line_count)
        find(&compare, "%zu lines, in the scene %d", compare.source.lines, scene->line_count);
    for (int i = 0; i < scene->line_count && !bad && compare.findings == 0; i++) {
        if (strcmp(compare.source.line_name[i], scene->line[i].name) == 0)
            bad = compare_steps(&compare, i);
        else
            find(&compare, "line %s, in the scene %s", compare.source.line_name[i],
                 scene->line[i].name);
    }
    if (!bad && compare.findings == 0) bad = compare_points(&compare);
    if (!bad && compare.findings == 0)
        bad = given_bodies(&compare.source, scene, step_of, find_at_body, &compare, log);
    source_close(&compare.source);
    return bad ? -1 : compare.findings;
}
