/* SPDX-License-Identifier: BSD-3-Clause */
/* Comparison of a file with its scene (given.h).
 *
 * A stage moves an end from its present value to the stage's value in equal steps. The present
 * value is the value imposed before; where the kind of the end changes, it is the position that the
 * end had reached, or the force that it carried. These two are results, and are taken from the
 * preceding step of the file; before the first step an end has the position of the start shape. */
#include "given.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "anchors.h"
#include "compare.h"
#include "failure.h"
#include "given_bodies.h"
#include "grasps.h"
#include "joint_motion.h"
#include "loads.h"
#include "oscillation.h"
#include "record.h"
#include "sea.h"
#include "soft.h"
#include "water.h"

/* ---- what holds for the whole run ---- */

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

/* ---- steps ---- */

/* An end of a line as the scene has it. */
typedef struct Imposed {
    CpsEnd from, now;
    double noise; /* COPIED, or COMPUTED where it starts from the end of an arc, a sum of angles */
    double sway_noise[3]; /* [m] or [N] to what its oscillation is known, which may have ended */
    int release;          /* whether it was let go (failure.h) */
} Imposed;

/* An end that is let go is free without a force. */
static void let_go(Imposed *end, int release) {
    end->now = (CpsEnd){.kind = CPS_END_KIND_FREE};
    end->release = release;
}

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
static void impose(const Source *source, Imposed *end, const CpsStage *stage, const Part *part,
                   int line, int e, const Record *before, const double start[3]) {
    for (int i = 0; i < stage->change_count; i++) {
        const CpsChange *change = &stage->change[i];
        if (change->line != line || change->end != e || end->release == RELEASE_BREAK) continue;
        if (change->to.kind == CPS_END_KIND_RELEASED) {
            let_go(end, RELEASE_STAGE);
            continue;
        }
        if (part->number == 1) end->from = end->now;
        if (part->number == 1 && end->release != RELEASE_NONE) end->release = RELEASE_TAKEN;
        const double *place = before ? before->position[e ? before->elements : 0] : start;
        if (part->number == 1 && before) end->noise = COPIED;
        if (part->number == 1 && change->to.kind != end->now.kind)
            for (int k = 0; k < 3; k++)
                end->from.value[k] = change->to.kind == CPS_END_KIND_HELD ? place[k]
                                     : before                             ? before->end_force[e][k]
                                                                          : 0;
        const double share = part->to;
        const CpsEnd to = about(source, change->to);
        end->now.kind = to.kind;
        for (int k = 0; k < 3; k++)
            end->now.value[k] =
                share == 1 ? to.value[k]
                           : end->from.value[k] + share * (to.value[k] - end->from.value[k]);
        double added[6], noise[6];
        oscillation(stage, CPS_SWAY_OF_END, line, e, part->end, added, noise);
        for (int k = 0; k < 3; k++) {
            end->now.value[k] += added[k];
            end->sway_noise[k] += noise[k] + part->noise * fabs(to.value[k] - end->from.value[k]);
        }
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
        if (!(fabs(value[k] - end->now.value[k]) <= end->noise * most + end->sway_noise[k]))
            find(compare, "%s of %s is %.17g, in the scene %.17g",
                 held ? "end_held_position" : "end_applied_force", of, value[k], end->now.value[k]);
}

/* Gravity of the scene at a share of a stage, or without one that of its beginning. */
static void gravity_at(const Compare *compare, bool staged, int stage, double at, double g[3]) {
    const CpsScene *scene = compare->scene;
    memcpy(g, scene->gravity, 3 * sizeof *g);
    if (staged)
        for (int s = 0; s <= stage; s++) {
            const double share = s < stage ? 1 : at;
            if (scene->stage[s].gravity_changes)
                for (int k = 0; k < 3; k++) g[k] += share * (scene->stage[s].gravity[k] - g[k]);
        }
}

/* Weight, half of each element to each of its nodes, and the forces at free ends; and the weight
 * before the step. What has no equilibrium may be on its way. */
static void compare_loads(Compare *compare, const CpsLine *line, size_t step, const Record *r) {
    Part part;
    double g[3], was[3];
    const bool staged = stage_of(compare, step, &part);
    gravity_at(compare, staged, part.stage, part.to, g);
    gravity_at(compare, staged, part.stage, is_break(&compare->source, step) ? part.to : part.from,
               was);
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
    compare_node_loads(compare, line, r, step);
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
        for (size_t i = 0; i < r->grasps; i++) {
            if (r->grasp_kind[i] == END_HELD || r->grasp_node[i] != j) continue;
            for (int k = 0; k < 3; k++) load[k] += r->grasp_load[i][k];
            noise += size(r->grasp_load[i]);
        }
        if (r->loads && r->loads->given) {
            for (int k = 0; k < 3; k++) load[k] += r->loads->given[j][k];
            noise += size(r->loads->given[j]);
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
 * several parts has the reference of the last of them, and an end with a given velocity one that
 * follows from that (given_velocities.c). */
static void compare_nodes(Compare *compare, const CpsLine *line, const Record *r) {
    const CpsStart *start = &line->start;
    if (start->kind != CPS_START_NODES || r->substeps != 1) return;
    for (size_t j = 0; j < r->nodes; j++) {
        double place[3];
        if (r->velocity_given[j ? 1 : 0] && (j == 0 || j == r->elements)) continue;
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
        const bool held = node_is_held(r, j);
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

/* Of what changes evenly in a stage, the share of one of its steps. */
static double share_of(const Compare *compare, const Part *part) {
    const CpsStage *at = &compare->scene->stage[part->stage];
    return at->error > 0 ? part->to - part->from : 1.0 / at->step_count;
}

static void compare_turns(Compare *compare, size_t step, const Record *r) {
    Part part;
    const bool staged = stage_of(compare, step, &part);
    for (int k = 0; k < compare->scene->obstacle_count; k++) {
        double angle = 0, noise = 0;
        if (staged && !is_break(&compare->source, step))
            for (int i = 0; i < compare->scene->stage[part.stage].turn_count; i++) {
                const CpsTurn *turn = &compare->scene->stage[part.stage].turn[i];
                if (turn->obstacle != k) continue;
                angle = share_of(compare, &part) * turn->angle;
                noise = part.noise * fabs(turn->angle);
            }
        if (!(fabs(r->turn[k] - angle) <= COPIED * fabs(angle) + noise))
            find(compare, "obstacle_turn of %s, step %zu, is %.17g, in the scene %.17g",
                 compare->scene->obstacle[k].name, step, r->turn[k], angle);
    }
}

/* The shift of obstacle k in a step: the scene's, in its parts. */
static void compare_shifts(Compare *compare, size_t step) {
    Part part;
    const bool staged = stage_of(compare, step, &part);
    for (int k = 0; k < compare->scene->obstacle_count; k++) {
        const Surface *s = &compare->source.surface[k];
        const CpsStage *at =
            staged && !is_break(&compare->source, step) ? &compare->scene->stage[part.stage] : NULL;
        double given[9] = {0}, size = 0, noise = 0;
        for (int i = 0; at && i < at->shift_count; i++) {
            const CpsShift *shift = &at->shift[i];
            if (shift->obstacle != k) continue;
            for (int a = 0; a < 3; a++) {
                given[a] = share_of(compare, &part) * shift->by[a];
                given[3 + a] = share_of(compare, &part) * shift->turn[a];
                given[6 + a] =
                    shift->about[a] - compare->source.origin[a] + part.from * shift->by[a];
                noise = fmax(noise, part.noise * (fabs(shift->by[a]) + fabs(shift->turn[a])));
            }
            const double *turn = shift->turn;
            if (turn[0] == 0 && turn[1] == 0 && turn[2] == 0)
                for (int a = 0; a < 3; a++) given[6 + a] = 0;
        }
        for (int a = 0; a < 9; a++) size = fmax(size, fabs(given[a]));
        for (int a = 0; a < 9; a++) {
            const double found = (double)(a < 3   ? s->by[a]
                                          : a < 6 ? s->spin[a - 3]
                                                  : s->about[a - 6]);
            if (!(fabs(found - given[a]) <= COMPUTED * size + noise))
                find(compare, "shift of obstacle %s, step %zu, is %.17g, in the scene %.17g",
                     compare->scene->obstacle[k].name, step, found, given[a]);
        }
    }
}

/* Whether the end begins at a point, the same as in the scene: while it is there nothing is imposed
 * on it here. */
static bool begins_at_point(Compare *compare, const CpsLine *line, int e, const Record *r) {
    const bool is_at = line->end[e].kind == CPS_END_KIND_POINT;
    const int point = is_at ? line->end_point[e] : -1;
    if (r->given_point[e] != point)
        find(compare, "end_point of %s, end %c, is %d, in the scene %d", line->name, e ? 'B' : 'A',
             r->given_point[e], point);
    return is_at;
}

/* ---- points ---- */

/* What the scene imposes on a point: its position, or the force on it. */
typedef struct ImposedPoint {
    CpsPointKind kind;
    double from[3], now[3];
    double sway_noise[3]; /* to what its oscillations so far are known */
    /* of a point that is let go the force it begins with is a result: it is known when the stage
     * ends */
    bool is_known;
} ImposedPoint;

static void impose_on_point(const Compare *compare, ImposedPoint *point, const CpsStage *stage,
                            const CpsPointChange *change, const Part *part,
                            const Junction *before) {
    const double share = part->to;
    double to[3], added[6], noise[6];
    for (int k = 0; k < 3; k++)
        to[k] = change->value[k] -
                (change->kind == CPS_POINT_KIND_HELD ? compare->source.origin[k] : 0);
    if (part->number == 1) {
        memcpy(point->from, point->now, sizeof point->from);
        if (change->kind != point->kind && change->kind == CPS_POINT_KIND_HELD && before)
            memcpy(point->from, before->position, sizeof point->from);
        point->is_known =
            point->is_known && (change->kind == point->kind || change->kind == CPS_POINT_KIND_HELD);
        point->kind = change->kind;
    }
    point->is_known = point->is_known || share == 1;
    for (int k = 0; k < 3; k++)
        point->now[k] = share == 1 ? to[k] : point->from[k] + share * (to[k] - point->from[k]);
    oscillation(stage, CPS_SWAY_OF_POINT, change->point, 0, part->end, added, noise);
    for (int k = 0; k < 3; k++) {
        point->now[k] += added[k];
        point->sway_noise[k] += noise[k] + part->noise * fabs(to[k] - point->from[k]);
    }
}

/* Where an anchor that drags is held: where the stage puts it, or where it was; and from there it
 * has given way. */
static void add_drag(Compare *compare, const CpsPoint *given, ImposedPoint *point, size_t k,
                     size_t step, bool is_moved, const Junction *before) {
    if (!given->drags || point->kind != CPS_POINT_KIND_HELD) return;
    Anchor *anchor = calloc(compare->source.points, sizeof *anchor);
    if (!anchor || anchors_open(&compare->source, anchor, compare->log) ||
        anchors_read(&compare->source, step, anchor, compare->log))
        find(compare, "drag_of_point, step %zu", step);
    else
        for (int a = 0; a < 3; a++)
            point->now[a] =
                (is_moved || !before ? point->now[a] : before->position[a]) + anchor[k].drag[a];
    free(anchor);
}

static void compare_point(Compare *compare, const CpsPoint *given, const ImposedPoint *point,
                          size_t step, const double g[3], const Junction *at) {
    const bool is_held = point->kind == CPS_POINT_KIND_HELD;
    const double pull = size(compare->scene->gravity),
                 out = compare->scene->has_water_surface ? given->displaced_weight : 0;
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
        const double weight = is_held || pull == 0 ? 0 : (given->weight + out) / pull * g[k];
        wanted[k] = point->now[k] + weight;
        noise += fabs(point->now[k]) + fabs(point->from[k]) + fabs(weight);
        if (is_held) noise += fabs(compare->source.origin[k]);
    }
    const double *found = is_held ? at->position : at->load;
    for (int k = 0; k < 3; k++)
        if (!(fabs(found[k] - wanted[k]) <= COPIED * noise + point->sway_noise[k]))
            find(compare, "%s_of_point of %s, step %zu, is %.17g, in the scene %.17g",
                 is_held ? "position" : "load", given->name, step, found[k], wanted[k]);
}

/* What the free points displace, under the gravity of the step. */
static void compare_water(Compare *compare, size_t step, const ImposedPoint *imposed,
                          const double g[3]) {
    const CpsScene *scene = compare->scene;
    const double pull = size(scene->gravity);
    Water *water = calloc((size_t)scene->point_count, sizeof *water);
    if (!water || water_read(&compare->source, step, water, compare->log)) {
        find(compare, "water_of_point, step %zu", step);
        free(water);
        return;
    }
    for (int k = 0; k < scene->point_count; k++) {
        const bool floats = scene->has_water_surface && imposed[k].kind == CPS_POINT_KIND_FREE;
        const double wanted =
            floats && pull > 0 ? scene->point[k].displaced_weight / pull * size(g) : 0;
        if (!(fabs(water[k].displaced - wanted) <= COPIED * wanted))
            find(compare, "displaced_of_point of %s, step %zu, is %.17g, in the scene %.17g",
                 scene->point[k].name, step, water[k].displaced, wanted);
    }
    free(water);
}

static void compare_points_at(Compare *compare, size_t step, ImposedPoint *imposed,
                              const Junction *before, const Junction *now) {
    Part part;
    double g[3];
    const bool staged = stage_of(compare, step, &part);
    gravity_at(compare, staged, part.stage, part.to, g);
    const CpsStage *at = staged ? &compare->scene->stage[part.stage] : NULL;
    const int changes = staged && !is_break(&compare->source, step) ? at->point_change_count : 0;
    for (int i = 0; i < changes; i++) {
        const CpsPointChange *change = &at->point_change[i];
        impose_on_point(compare, &imposed[change->point], at, change, &part,
                        step > 0 ? &before[change->point] : NULL);
    }
    for (int k = 0; k < compare->scene->point_count; k++) {
        bool is_moved = false;
        for (int i = 0; i < changes; i++) is_moved = is_moved || at->point_change[i].point == k;
        add_drag(compare, &compare->scene->point[k], &imposed[k], (size_t)k, step, is_moved,
                 step > 0 ? &before[k] : NULL);
        compare_point(compare, &compare->scene->point[k], &imposed[k], step, g, &now[k]);
    }
    compare_water(compare, step, imposed, g);
}

/* What floats, and the waves about it. */
static void compare_heights(Compare *compare) {
    Sea sea;
    double *height = calloc(compare->source.points + 1, sizeof *height);
    if (!height || water_heights(&compare->source, height, compare->log)) {
        find(compare, "height_of_point");
        free(height);
        return;
    }
    for (int k = 0; k < compare->scene->point_count; k++) {
        const CpsPoint *point = &compare->scene->point[k];
        same_number(compare, "height_of_point", point->name, height[k],
                    compare->scene->has_water_surface ? point->height : 0);
    }
    free(height);
    if (sea_read(&compare->source, &sea, compare->log))
        find(compare, "waves");
    else
        compare_waves(compare, &sea);
    sea_free(&sea);
}

/* Names, kinds and weights; and what is imposed at first. */
static void compare_given_points(Compare *compare, ImposedPoint *imposed) {
    const Source *source = &compare->source;
    const CpsScene *scene = compare->scene;
    double surface;
    bool gives = false;
    for (int k = 0; k < scene->obstacle_count; k++)
        gives = gives || scene->obstacle[k].stiffness > 0;
    Anchor *anchor = calloc(source->points, sizeof *anchor);
    double *area = calloc(source->points, sizeof *area);
    compare_heights(compare);
    if (!anchor || !area || anchors_open(source, anchor, compare->log) ||
        soft_areas_read(source, area, compare->log)) {
        find(compare, "holding_capacity_of_point, or bearing_area_of_point");
        free(anchor);
        free(area);
        return;
    }
    if (water_surface(source, &surface) != scene->has_water_surface ||
        (scene->has_water_surface &&
         !(fabs(surface - (scene->water_surface - source->origin[2])) <=
           COPIED * (fabs(scene->water_surface) + fabs(source->origin[2])))))
        find(compare, "water_surface");
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
        same_number(compare, "holding_capacity_of_point", point->name, anchor[k].capacity,
                    point->has_holding_capacity ? point->holding_capacity : 0);
        same_number(compare, "uplift_limit_of_point", point->name, anchor[k].limit,
                    point->has_uplift_limit ? point->uplift_limit : 0);
        same_number(compare, "bearing_area_of_point", point->name, area[k],
                    gives ? point->bearing_area : 0);
        if (anchor[k].drags != point->drags) find(compare, "drags_of_point of %s", point->name);
        imposed[k] = (ImposedPoint){.kind = point->kind, .is_known = true};
        for (int a = 0; a < 3; a++)
            imposed[k].now[a] = imposed[k].from[a] =
                is_held ? point->position[a] - source->origin[a] : point->force[a];
    }
    free(anchor);
    free(area);
}

/* The masses of points, of a file with steps in time. */
static int compare_point_masses(Compare *compare) {
    const size_t n = compare->source.points;
    PointMotion *motion = calloc(n, sizeof *motion);
    int bad = motion ? 0 : -1;
    if (!bad && compare->time) bad = point_motions_read(&compare->source, 0, motion, compare->log);
    if (!bad && compare->time)
        for (size_t k = 0; k < n; k++)
            same_number(compare, "mass of point", compare->source.point_name[k], motion[k].mass,
                        compare->scene->point[k].inertia);
    free(motion);
    return bad;
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
    int bad = imposed && now && before ? compare_point_masses(compare) : -1;
    if (!bad) compare_given_points(compare, imposed);
    if (!bad) point_sets_compare(compare, compare->scene);
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
    GivenStep given = {0};
    const bool staged = stage_of(compare, step, &given.part);
    gravity_at(compare, staged, given.part.stage, given.part.to, given.gravity);
    const bool stays = is_break(&compare->source, step);
    given.stage = staged && !stays ? &compare->scene->stage[given.part.stage] : NULL;
    return given;
}

static void find_at_body(void *user, const char *sentence) { find(user, "%s", sentence); }
/* The place of node j among the grasps of a record; their count: it is not there. */
static size_t grasp_of(const Record *r, size_t j) {
    size_t k = 0;
    while (k < r->grasps && r->grasp_node[k] != j) k++;
    return k;
}

/* What is imposed on a node by a part of a stage that changes it: its share of what is left of the
 * way from the step before. */
static void next_grasp(const Compare *compare, const CpsGraspChange *change, const Part *part,
                       const Record *before, const Record *r, double value[3]) {
    const size_t j = (size_t)change->node, k = before ? grasp_of(before, j) : 0;
    const bool held = change->kind == CPS_END_KIND_HELD, was = before && k < before->grasps,
               was_held = was && before->grasp_kind[k] == END_HELD;
    for (int a = 0; a < 3; a++) {
        const double shift = held ? compare->source.origin[a] : 0, to = change->value[a] - shift;
        const double place = was_held ? before->grasp_place[k][a]
                             : before ? before->position[j][a]
                                      : r->reference[j][a],
                     force = was ? before->grasp_force[k][a] : 0, from = held ? place : force;
        value[a] = change->stays ? from
                   : change->at_once || part->to == 1
                       ? to
                       : from + (to - from) * (part->to - part->from) / (1 - part->from);
    }
}

/* Nodes that are held or pulled are those that the history names, and what is imposed on them is
 * what it says. */
static void compare_grasps(Compare *compare, const CpsLine *line, int index, size_t step,
                           const Record *before, const Record *r) {
    Part part;
    const bool staged = stage_of(compare, step, &part), ended = r->outcome == OUTCOME_UNBOUNDED ||
                                                                r->outcome == OUTCOME_INFEASIBLE ||
                                                                r->outcome == OUTCOME_SLIDES;
    const CpsStage *at = &compare->scene->stage[part.stage];
    const int changes = staged && !is_break(&compare->source, step) ? at->grasp_change_count : 0;
    size_t named = 0, kept = 0;
    if (ended) return;
    for (int i = 0; i < changes; i++) {
        const CpsGraspChange *change = &at->grasp_change[i];
        const size_t k = grasp_of(r, (size_t)change->node);
        if (change->line != index) continue;
        named++;
        if (k == r->grasps || r->grasp_kind[k] != (change->kind == CPS_END_KIND_FREE)) {
            find(compare, "node %d of %s, step %zu, is not grasped as the scene says", change->node,
                 line->name, step);
            return;
        }
        double value[3];
        const double *found = r->grasp_kind[k] == END_HELD ? r->grasp_place[k] : r->grasp_load[k];
        next_grasp(compare, change, &part, before, r, value);
        for (int a = 0; a < 3; a++)
            if (!(fabs(found[a] - value[a]) <= COMPUTED * (size(value) + size(found))))
                find(compare,
                     "what is imposed on node %d of %s, step %zu, is %.17g, in the scene "
                     "%.17g",
                     change->node, line->name, step, found[a], value[a]);
    }
    const size_t earlier = before ? before->grasps : 0;
    for (size_t k = 0; k < earlier; k++) {
        const size_t now = grasp_of(r, before->grasp_node[k]);
        bool changed = false;
        for (int i = 0; i < changes; i++)
            changed = changed || (at->grasp_change[i].line == index &&
                                  (size_t)at->grasp_change[i].node == before->grasp_node[k]);
        if (changed) continue;
        const bool held = before->grasp_kind[k] == END_HELD;
        const double *was = held ? before->grasp_place[k] : before->grasp_load[k];
        if (now == r->grasps && !held && size(was) == 0) continue;
        kept++;
        if (now == r->grasps || r->grasp_kind[now] != before->grasp_kind[k] ||
            memcmp(held ? r->grasp_place[now] : r->grasp_load[now], was, 3 * sizeof *was) != 0)
            find(compare, "node %zu of %s, step %zu, is no longer as it was grasped",
                 before->grasp_node[k], line->name, step);
    }
    if (r->grasps != named + kept)
        find(compare, "%zu nodes of %s, step %zu, are grasped, in the scene %zu", r->grasps,
             line->name, step, named + kept);
}

/* The end in a break. */
static void part_end(const Source *source, size_t step, int line, int e, Imposed *end) {
    if ((int)source->break_line[step] == line && (int)source->break_end[step] == e)
        let_go(end, RELEASE_BREAK);
}

/* A line that is above its break_at after the last step of the scene would have parted. */
static void compare_end_of_run(Compare *compare, const CpsLine *line, const Record *last) {
    const double share = failure_is_loaded(last) ? failure_share(last) : 0;
    if (compare->source.steps == planned(compare) && last->outcome <= OUTCOME_TAUT &&
        share > 1 + 1e-9)
        find(compare, "%s is at %.9g of its break_at in the last step", line->name, share);
}

/* Which stiffness holds: the one of the stage, the static one without a stage. */
static void compare_stiffness(Compare *compare, const CpsLine *line, size_t step, const Record *r) {
    Part part;
    const bool staged = stage_of(compare, step, &part),
               is_dynamic = staged && !compare->scene->stage[part.stage].static_stiffness;
    if (r->is_dynamic != is_dynamic) find(compare, "stiffness of %s in step %zu", line->name, step);
}

static int compare_steps(Compare *compare, int index) {
    const CpsLine *line = &compare->scene->line[index];
    Record now = {0}, before = {0};
    int bad = record_create(&compare->source, line->name, &now, compare->log);
    if (!bad) bad = record_create(&compare->source, line->name, &before, compare->log);
    if (!bad) compare_line(compare, line, &now);
    Imposed end[2] = {0};
    for (size_t step = 0; step < compare->source.steps && !bad && compare->findings == 0; step++) {
        bad = record_read(&compare->source, line->name, step, &now, compare->log);
        Part part;
        if (!bad)
            for (int e = 0; e < 2; e++) {
                const bool at_point = begins_at_point(compare, line, e, &now);
                if (step == 0 && !at_point) {
                    end[e].now = first_end(&compare->source, line, e, &now);
                    end[e].noise = line->start.kind == CPS_START_ARC ? COMPUTED : COPIED;
                }
                const CpsEnd was = end[e].now;
                double start[3];
                start_place(&compare->source, line, e, &now, start);
                if (is_break(&compare->source, step))
                    part_end(&compare->source, step, index, e, &end[e]);
                else if (stage_of(compare, step, &part))
                    impose(&compare->source, &end[e], &compare->scene->stage[part.stage], &part,
                           index, e, step > 0 ? &before : NULL, start);
                if (now.release[e] != end[e].release)
                    find(compare, "end_release of %s, end %c, step %zu", line->name, e ? 'B' : 'A',
                         step);
                if (at_point && end[e].release == RELEASE_NONE) continue;
                compare_end(compare, line, e, &end[e], &was, step, &now);
            }
        if (!bad && step == 0) compare_nodes(compare, line, &now);
        if (!bad && step == 0) sets_compare(compare, line, &now);
        if (!bad) compare_grasps(compare, line, index, step, step > 0 ? &before : NULL, &now);
        if (!bad) winches_compare(compare, line, index, step, &now);
        if (!bad) compare_loads(compare, line, step, &now);
        if (!bad && now.has_dynamic) compare_stiffness(compare, line, step, &now);
        if (!bad && index == 0) compare_turns(compare, step, &now);
        if (!bad && index == 0) compare_shifts(compare, step);
        const Record swap = before;
        before = now;
        now = swap;
    }
    if (!bad && compare->findings == 0) compare_end_of_run(compare, line, &before);
    record_destroy(&now);
    record_destroy(&before);
    return bad;
}

int given_file(const char *path, const CpsScene *scene, FILE *log) {
    Compare compare = {.scene = scene, .log = log};
    int bad = source_open(path, &compare.source, log);
    if (!bad) bad = !read_times(&compare);
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
    if (!bad && compare.findings == 0) bad = compare_pace(&compare);
    if (!bad && compare.findings == 0) bad = compare_velocities(&compare);
    if (!bad && compare.findings == 0) bad = compare_points(&compare);
    if (!bad && compare.findings == 0)
        bad = given_bodies(&compare.source, scene, step_of, find_at_body, &compare, log);
    free(compare.time);
    source_close(&compare.source);
    return bad ? -1 : compare.findings;
}
