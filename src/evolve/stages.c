/* SPDX-License-Identifier: BSD-3-Clause */
/* What a load step imposes (stages.h). */
#include "evolve/stages.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/math.h"
#include "cable/two_stiffnesses.h"
#include "evolve/excitation.h"
#include "evolve/failure.h"
#include "evolve/grasps.h"
#include "evolve/loads.h"
#include "evolve/pace.h"
#include "evolve/path_check.h"
#include "evolve/ranges.h"
#include "evolve/shifts.h"
#include "evolve/soft_point.h"
#include "evolve/sways.h"
#include "evolve/velocities.h"
#include "evolve/water.h"
#include "evolve/winches.h"

/* Steps whose lengths differ by no more than this share are of one length: rounding. */
static const double SAME_STEP = 1e-12;
/* After a step so many times shorter the next one is an Euler step: the formula of the second order
 * is stable where steps grow by less than 1 + sqrt 2. */
static const double MOST_GROWTH = 2;

void cpsi_stage_layout(CpsiEvolutionStage *stage, CpsiArena *arena, int changes, int points,
                       int bodies, int turns, int grasps, int shifts, int sways, size_t rows,
                       int pay_outs) {
    CPSI_PLACE(arena, stage->series, rows);
    CPSI_PLACE(arena, stage->pay_out, pay_outs);
    CPSI_PLACE(arena, stage->shift, shifts);
    CPSI_PLACE(arena, stage->sway, sways);
    CPSI_PLACE(arena, stage->change, changes);
    CPSI_PLACE(arena, stage->grasp_change, grasps);
    CPSI_PLACE(arena, stage->body_change, bodies);
    CPSI_PLACE(arena, stage->point_change, points);
    CPSI_PLACE(arena, stage->turn, turns);
}

void cpsi_stage_fill(CpsiEvolutionStage *stage, const CpsStage *from, const double origin[3]) {
    stage->steps = from->step_count;
    stage->duration = from->duration;
    stage->error = from->error;
    stage->change_count = from->change_count;
    for (int k = 0; k < from->change_count; k++) {
        CpsChange *change = &stage->change[k];
        *change = from->change[k];
        if (change->to.kind == CPS_END_KIND_HELD)
            for (int a = 0; a < 3; a++) change->to.value[a] -= origin[a];
    }
    stage->point_change_count = from->point_change_count;
    for (int k = 0; k < from->point_change_count; k++) {
        CpsPointChange *change = &stage->point_change[k];
        *change = from->point_change[k];
        if (change->kind == CPS_POINT_KIND_HELD)
            for (int a = 0; a < 3; a++) change->value[a] -= origin[a];
    }
    stage->body_change_count = from->body_change_count;
    for (int k = 0; k < from->body_change_count; k++) {
        CpsBodyChange *change = &stage->body_change[k];
        *change = from->body_change[k];
        if (change->kind == CPS_BODY_KIND_HELD)
            for (int a = 0; a < 3; a++) change->position[a] -= origin[a];
    }
    stage->grasp_change_count = from->grasp_change_count;
    for (int k = 0; k < from->grasp_change_count; k++) {
        CpsGraspChange *change = &stage->grasp_change[k];
        *change = from->grasp_change[k];
        if (change->kind == CPS_END_KIND_HELD)
            for (int a = 0; a < 3; a++) change->value[a] -= origin[a];
    }
    stage->shift_count = from->shift_count;
    for (int k = 0; k < from->shift_count; k++) {
        stage->shift[k] = from->shift[k];
        for (int a = 0; a < 3; a++) stage->shift[k].about[a] -= origin[a];
    }
    stage->turn_count = from->turn_count;
    for (int k = 0; k < from->turn_count; k++) stage->turn[k] = from->turn[k];
    stage->sway_count = from->sway_count;
    cpsi_sways_copy(from->sway_count, from->sway, stage->sway, stage->series);
    stage->pay_out_count = from->pay_out_count;
    for (int k = 0; k < from->pay_out_count; k++) stage->pay_out[k] = from->pay_out[k];
    stage->static_stiffness = from->static_stiffness;
    stage->gravity_changes = from->gravity_changes;
    memcpy(stage->gravity, from->gravity, sizeof stage->gravity);
}

/* The initial value of a change of an end: its position if it is to be held, its force if it is to
 * be released over the stage. */
static CpsEnd end_now(const CpsiLine *line, int end, CpsEndKind kind) {
    CpsEnd now = {.kind = kind};
    if (kind == line->end[end].kind) return line->end[end];
    const double *x = &line->position[3 * (end == CPS_END_A ? 0 : line->n - 1)];
    memcpy(now.value, kind == CPS_END_KIND_HELD ? x : line->report.end[end].force,
           sizeof now.value);
    return now;
}

CpsScene cpsi_stage_scene(const CpsEvolution *evolution) {
    const double *gravity = evolution->gravity_given;
    return (CpsScene){.gravity = {gravity[0], gravity[1], gravity[2]},
                      .obstacle_count = evolution->obstacle_count,
                      .obstacle = evolution->given_obstacle,
                      .line_count = evolution->line_count,
                      .line = evolution->given_line,
                      .point_count = evolution->points.count,
                      .point = evolution->points.given,
                      .has_water_surface = evolution->points.has_surface,
                      .water_surface = evolution->points.surface + evolution->origin[2],
                      .body_count = evolution->bodies.count,
                      .body = evolution->given_body};
}

CpsStatus cpsi_stage_check_paths(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                                 bool all, const char *what, CpsError *err) {
    const CpsScene scene = cpsi_stage_scene(evolution);
    const CpsStatus clear = cpsi_shifts_check(evolution, stage, what, err);
    if (clear != CPS_OK) return clear;
    for (int i = 0; i < stage->change_count; i++) {
        CpsChange change = stage->change[i];
        const CpsiLine *line = &evolution->line[change.line];
        const bool grabbed = line->end[change.end].kind == CPS_END_KIND_FREE;
        if (change.to.kind != CPS_END_KIND_HELD || !(grabbed || all) ||
            cpsi_change_is_lost(evolution, stage, &change))
            continue;
        CpsEnd from = end_now(line, change.end, CPS_END_KIND_HELD);
        for (int a = 0; a < 3; a++) {
            from.value[a] += evolution->origin[a];
            change.to.value[a] += evolution->origin[a];
        }
        const CpsStatus status =
            cpsi_path_check_change(&scene, &change, from.value, grabbed, what, err);
        if (status) return status;
    }
    for (int i = 0; i < stage->point_change_count; i++) {
        CpsPointChange change = stage->point_change[i];
        const CpsiPoint *point = &evolution->points.point[change.point];
        const bool grabbed = point->kind == CPS_POINT_KIND_FREE;
        if (change.kind != CPS_POINT_KIND_HELD || !(grabbed || all)) continue;
        double from[3];
        for (int a = 0; a < 3; a++) {
            from[a] = point->position[a] + evolution->origin[a];
            change.value[a] += evolution->origin[a];
        }
        const CpsStatus status =
            cpsi_path_check_point(&scene, &change, point->length, from, grabbed, what, err);
        if (status) return status;
    }
    const CpsStatus stock = cpsi_pay_outs_check_now(evolution, stage, what, err);
    if (stock != CPS_OK) return stock;
    return cpsi_grasps_check(evolution, &scene, stage, what, err);
}

/* A value at a share of its stage. */
static void value_at(const double from[3], const double to[3], double share, double at[3]) {
    for (int a = 0; a < 3; a++) at[a] = share < 1 ? from[a] + share * (to[a] - from[a]) : to[a];
}

/* Let an end go at once, without a force. */
static void release(CpsEvolution *evolution, int line, int end, CpsRelease by) {
    CpsiMove *move = &evolution->move[line];
    cpsi_release_end(evolution, line, end, by);
    move->from[end] = move->to[end] = (CpsEnd){.kind = CPS_END_KIND_FREE};
}

/* What oscillations have become `time` [s] after a stage began. */
static void sway_at(const CpsiEvolutionStage *stage, CpsSwayOf of, int owner, int end, double time,
                    double out[6]) {
    cpsi_sways_at(stage->sway_count, stage->sway, of, owner, end, time, out);
}

/* An end of a line at a share of a stage, at a time since it began. */
static CpsEnd end_at(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                     const CpsChange *change, double share, double time) {
    const CpsEnd *from = &evolution->from[2 * change->line + change->end];
    CpsEnd at = cpsi_stage_value(from, &change->to, share);
    double sway[6];
    sway_at(stage, CPS_SWAY_OF_END, change->line, change->end, time, sway);
    for (int a = 0; a < 3; a++) at.value[a] += sway[a];
    return at;
}

/* The wrench at a share of the way. */
static CpsiWrench wrench_at(const CpsiWrench *from, const CpsiWrench *to, double share) {
    if (!(share < 1)) return *to;
    return (CpsiWrench){vec3_axpy(share, vec3_sub(to->force, from->force), from->force),
                        vec3_axpy(share, vec3_sub(to->moment, from->moment), from->moment)};
}

/* Add an oscillation, a displacement and a rotation vector. */
static void sway_pose(CpsiPose *pose, const double sway[6]) {
    pose->place = vec3_add(pose->place, vec3_load(sway));
    pose->turn = rotation_after(rotation_of(vec3_load(&sway[3])), pose->turn);
}

/* What is imposed on the bodies at the end of a step. */
static void plan_bodies(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                        const CpsiPortion *portion) {
    const double share = portion->to;
    for (int k = 0; k < stage->body_change_count; k++) {
        const CpsBodyChange *change = &stage->body_change[k];
        CpsiBody *body = &evolution->bodies.body[change->body];
        if (portion->part == 0) {
            const double *support = body->report.support;
            body->from = body->pose;
            body->load_from = body->kind == CPS_BODY_KIND_FREE
                                  ? body->load
                                  : (CpsiWrench){vec3_load(support), vec3_load(&support[3])};
            body->kind = change->kind;
        }
        double sway[6];
        sway_at(stage, CPS_SWAY_OF_BODY, change->body, 0, portion->end, sway);
        if (change->kind == CPS_BODY_KIND_HELD) {
            const CpsiPose to = {vec3_load(change->position), rotation_load(change->rotation)};
            body->pose = cpsi_pose_between(&body->from, &to, share);
            if (stage->sway_count > 0) sway_pose(&body->pose, sway);
            body->load = (CpsiWrench){vec3(0, 0, 0), vec3(0, 0, 0)};
        } else {
            const CpsiWrench to = {vec3_load(change->force), vec3_load(change->moment)};
            body->load = wrench_at(&body->load_from, &to, share);
            body->load.force = vec3_add(body->load.force, vec3_load(sway));
            body->load.moment = vec3_add(body->load.moment, vec3_load(&sway[3]));
        }
    }
}

/* What is imposed on the points at the end of a step, and on the ends at those that are held or on
 * a body. */
static void plan_points(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                        const CpsiPortion *portion) {
    CpsiPoints *points = &evolution->points;
    cpsi_soft_point_areas(evolution);
    for (int i = 0; i < points->count; i++) {
        CpsiPoint *point = &points->point[i];
        memcpy(point->inertia.past, point->before, sizeof point->before);
        memcpy(point->before, point->position, sizeof point->before);
        point->is_moving = portion->part > 0 && point->report.has_place;
    }
    for (int k = 0; k < stage->point_change_count; k++) {
        const CpsPointChange *change = &stage->point_change[k];
        CpsiPoint *point = &points->point[change->point];
        const bool held = change->kind == CPS_POINT_KIND_HELD;
        if (portion->part == 0) {
            const bool was_free = point->kind == CPS_POINT_KIND_FREE;
            double pushed[3];
            vec3_store(pushed, vec3_add(cpsi_buoyancy_at(point, evolution->gravity_from),
                                        cpsi_soft_point_push(evolution, change->point)));
            for (int a = 0; a < 3; a++) {
                const double load = was_free
                                        ? point->force[a]
                                        : point->report.support[a] -
                                              point->mass * evolution->gravity_from[a] - pushed[a];
                point->from[a] = held ? point->position[a] : load;
            }
            point->kind = change->kind;
        }
        double *value = held ? point->position : point->force, sway[6];
        value_at(point->from, change->value, portion->to, value);
        sway_at(stage, CPS_SWAY_OF_POINT, change->point, 0, portion->end, sway);
        for (int a = 0; a < 3; a++) value[a] += sway[a];
    }
    for (int i = 0; i < points->count; i++) {
        const CpsPoint *given = &points->given[i];
        if (given->kind == CPS_POINT_KIND_ON_BODY)
            vec3_store(points->point[i].position,
                       cpsi_pose_place(&evolution->bodies.body[given->body].pose, given->position));
    }
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++) {
            const int at = points->tie[2 * i + end];
            if (at != CPSI_NO_POINT)
                memcpy(evolution->move[i].to[end].value, points->point[at].position,
                       sizeof points->point[at].position);
        }
}

/* [N/m] The weights of the lines in a step. */
static void plan_weights(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                         const CpsiPortion *portion) {
    const double *from = evolution->gravity_from,
                 *to = stage->gravity_changes ? stage->gravity : from;
    double before[3], after[3];
    value_at(from, to, portion->from, before);
    value_at(from, to, portion->to, after);
    for (int i = 0; i < evolution->line_count; i++)
        for (int a = 0; a < 3; a++) {
            evolution->move[i].weight_from[a] = evolution->mass[i] * before[a];
            evolution->move[i].weight_to[a] = evolution->mass[i] * after[a];
        }
    memcpy(evolution->gravity, after, sizeof after);
}

/* Shift the obstacles to where they are at the end of the step. */
static void plan_shifts(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                        const CpsiPortion *portion) {
    const double share = cpsi_portion_of(stage, portion, 1);
    for (int k = 0; k < evolution->obstacle_count; k++) evolution->shift[k] = (CpsiShift){0};
    for (int k = 0; k < stage->shift_count; k++) {
        const CpsShift *given = &stage->shift[k];
        const CpsiShift whole = {vec3_load(given->by), vec3_load(given->turn),
                                 vec3_load(given->about)};
        CpsiShift *now = &evolution->shift[given->obstacle];
        *now = (CpsiShift){vec3_scale(share, whole.by), vec3_scale(share, whole.turn),
                           vec3_axpy(portion->from, whole.by, whole.about)};
        cpsi_obstacle_shift(&evolution->obstacle[given->obstacle], now);
    }
    for (int i = 0; i < evolution->line_count; i++) {
        evolution->move[i].shift = stage->shift_count > 0 ? evolution->shift : NULL;
        evolution->move[i].obstacle = evolution->obstacle;
    }
}

/* The time that the step takes, and its formula. Obstacles go on at the rate of the step before
 * within a stage. */
static void plan_time(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                      const CpsiPortion *portion) {
    const bool moves = stage->turn_count > 0 || stage->shift_count > 0;
    const double before = evolution->interval, length = cpsi_portion_length(stage, portion),
                 ratio = fabs(length - before) > SAME_STEP * before ? length / before : 1;
    evolution->interval = length;
    evolution->waves.time = evolution->water.time = evolution->time + length;
    for (int i = 0; i < evolution->line_count; i++)
        cpsi_line_loads_impose(&evolution->line[i], evolution->time + length);
    evolution->restarts = !(ratio <= MOST_GROWTH * (1 + SAME_STEP)) ||
                          (portion->part == 0 && (moves || evolution->ground_moved));
    evolution->formula = cpsi_formula(length, evolution->restarts ? 1 : ratio);
    evolution->ground_moved = moves;
    cpsi_excite_bodies(evolution);
}

void cpsi_stage_plan(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                     const CpsiPortion *portion) {
    const int part = portion->part;
    for (int i = 0; i < evolution->line_count; i++)
        cpsi_line_use_stiffness(&evolution->line[i], !stage->static_stiffness);
    if (part == 0) memcpy(evolution->gravity_from, evolution->gravity, sizeof evolution->gravity);
    plan_weights(evolution, stage, portion);
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++)
            evolution->move[i].from[end] = evolution->move[i].to[end] =
                cpsi_end_now(evolution, i, end);
    for (int k = 0; k < stage->change_count; k++) {
        const CpsChange *change = &stage->change[k];
        if (cpsi_change_is_lost(evolution, stage, change)) continue;
        if (change->to.kind == CPS_END_KIND_RELEASED) {
            if (part == 0) release(evolution, change->line, change->end, CPS_RELEASE_BY_STAGE);
            continue;
        }
        CpsRelease *release_of = &evolution->release[2 * change->line + change->end];
        if (part == 0 && *release_of != CPS_RELEASE_NONE) *release_of = CPS_RELEASE_TAKEN;
        if (part == 0)
            evolution->from[2 * change->line + change->end] =
                end_now(&evolution->line[change->line], change->end, change->to.kind);
        CpsiMove *move = &evolution->move[change->line];
        move->from[change->end] = end_at(evolution, stage, change, portion->from, portion->begin);
        move->to[change->end] = end_at(evolution, stage, change, portion->to, portion->end);
    }
    cpsi_grasps_plan(evolution, stage, portion);
    cpsi_pay_outs_plan(evolution, stage);
    plan_bodies(evolution, stage, portion);
    plan_points(evolution, stage, portion);
    cpsi_velocities_plan(evolution, stage);
    for (int k = 0; k < evolution->obstacle_count; k++) evolution->angle[k] = 0;
    for (int k = 0; k < stage->turn_count; k++)
        evolution->angle[stage->turn[k].obstacle] =
            cpsi_portion_of(stage, portion, stage->turn[k].angle);
    plan_shifts(evolution, stage, portion);
    plan_time(evolution, stage, portion);
    if (stage->error > 0)
        snprintf(evolution->step_name, CPSI_STEP_NAME, "%.64s %d", stage->name, part + 1);
    else if (stage->steps == 1)
        snprintf(evolution->step_name, CPSI_STEP_NAME, "%s", stage->name);
    else
        snprintf(evolution->step_name, CPSI_STEP_NAME, "%.64s %d/%d", stage->name, part + 1,
                 stage->steps);
}

/* Nothing changes. */
static void plan_rest(CpsEvolution *evolution) {
    evolution->interval = 0;
    for (int i = 0; i < evolution->line_count; i++)
        cpsi_line_loads_impose(&evolution->line[i], evolution->time);
    cpsi_excite_bodies(evolution);
    evolution->ground_moved = false;
    for (int k = 0; k < evolution->obstacle_count; k++) evolution->angle[k] = 0;
    for (int i = 0; i < evolution->line_count; i++) {
        const CpsiLine *line = &evolution->line[i];
        CpsiMove *move = &evolution->move[i];
        for (int end = 0; end < 2; end++)
            move->from[end] = move->to[end] = cpsi_end_now(evolution, i, end);
        move->grasp_count = line->grasp_count;
        for (int k = 0; k < line->grasp_count; k++)
            move->grasp_from[k] = move->grasp_to[k] = line->grasp[k].imposed;
        for (int a = 0; a < 3; a++) move->weight_from[a] = move->weight_to[a] = line->weight[a];
    }
    const CpsiEvolutionStage none = {.steps = 1};
    const CpsiPortion whole = {.to = 1, .is_last = true};
    cpsi_pay_outs_plan(evolution, &none);
    plan_shifts(evolution, &none, &whole);
    plan_points(evolution, &none, &whole);
    cpsi_velocities_plan(evolution, &none);
}

void cpsi_stage_plan_statics(CpsEvolution *evolution) {
    snprintf(evolution->step_name, CPSI_STEP_NAME, "static");
    plan_rest(evolution);
}

void cpsi_stage_plan_break(CpsEvolution *evolution, const CpsBreak *parts) {
    snprintf(evolution->step_name, CPSI_STEP_NAME, "%.64s.%s parts",
             evolution->line[parts->line].name, cpsi_end_letter(parts->end));
    plan_rest(evolution);
    release(evolution, parts->line, parts->end, CPS_RELEASE_BY_BREAK);
}
