/* SPDX-License-Identifier: BSD-3-Clause */
/* The history of a scene: load steps in sequence, each line solved on its own; and moves beside it.
 *
 * Lines act on each other only at points (balance.h), so a step is one program per line and the
 * report adds them up. */
#define _POSIX_C_SOURCE 200809L
#include "cable/soft.h"
#include "capstan/evolve.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/larger.h"
#include "base/status.h"
#include "cable/report.h"
#include "cable/tension_field.h"
#include "evolve/balance.h"
#include "evolve/checkpoint.h"
#include "evolve/end_grounds.h"
#include "evolve/failure.h"
#include "evolve/ledger.h"
#include "evolve/pace.h"
#include "evolve/settling.h"
#include "evolve/stage_check.h"
#include "evolve/stages.h"
#include "evolve/statics.h"
#include "evolve/step_ledger.h"
#include "evolve/sways.h"
#include "evolve/time_step.h"
#include "evolve/view.h"
#include "evolve/waves.h"

int cps_evolution_step_count(const CpsEvolution *evolution) {
    if (!evolution) return 0;
    return evolution->done + cpsi_steps_left(evolution) + evolution->move_count +
           evolution->break_count + cpsi_break_due(evolution).is_break;
}

int cps_evolution_remaining_count(const CpsEvolution *evolution) {
    if (!evolution || evolution->ended) return 0;
    return cpsi_steps_left(evolution) + cpsi_break_due(evolution).is_break;
}

/* The ranges of the tensions at the ends, after the last step of a stage and after statics. */
static void find_range(CpsiLine *line, const CpsiStepOptions *options) {
    if (!cps_outcome_is_certified(line->report.outcome)) return;
    if (line->forces && !cpsi_line_has_soft(line))
        cpsi_line_tension_range(line, line->forces, options);
    else
        for (int end = 0; end < 2; end++)
            line->report.end[end].range = (CpsTensionRange){.kind = CPS_RANGE_STRAIN};
}

/* Take a step in time of a line. Its places are unique, for its nodes have mass. */
static void move_line(const CpsEvolution *evolution, CpsiWorkspace *workspace, CpsiLine *line,
                      const CpsiMove *move) {
    const int index = (int)(line - evolution->line);
    const CpsiTimeStep step = {evolution->formula, evolution->time_scheme, evolution->restarts,
                               cpsi_group_of_line(&evolution->points, index) != CPSI_NO_POINT};
    CpsiStepOptions options = evolution->options;
    options.least = NULL;
    cpsi_line_time_step(line, &workspace->program, &options, move, &workspace->scratch, &step);
}

/* Take the load step of line i in a workspace: its first equilibrium without friction where it
 * starts by statics, else the step that was planned. */
static void step_line(void *data, int workspace_index, int i) {
    CpsEvolution *evolution = data;
    CpsiWorkspace *workspace = &evolution->workspace[workspace_index];
    CpsiLine *line = &evolution->line[i];
    CpsiStepOptions options = evolution->options;
    options.least = &workspace->least;
    cpsi_workspace_attach(workspace, line);
    memset(line->ground, 0, sizeof line->ground);
    const bool is_first = evolution->has_static && evolution->done == 0;
    if (is_first && evolution->is_static[i]) {
        options.frictionless = true;
        CpsiStepOptions placing = options;
        placing.contact_policy = CPS_CONTACT_POLICY_REACHED;
        cpsi_line_place_statically(line, &workspace->program, &placing, &workspace->scratch);
    } else {
        if (evolution->move[i].shift) line->obstacle = workspace->scratch.obstacle;
        /* In the step that places others a line keeps the velocity with which the history begins.
         */
        const bool rests = line->has_inertia && !(evolution->interval > 0) && !is_first;
        if (rests) cpsi_line_stop(line);
        if (line->has_inertia && evolution->interval > 0)
            move_line(evolution, workspace, line, &evolution->move[i]);
        else
            cpsi_line_substeps(line, &workspace->program, &options, &evolution->move[i],
                               &workspace->scratch,
                               evolution->report.step_count > 0 && !line->two.has_jumped &&
                                   !line->inertia.settles);
        if (rests) cpsi_settling_close(line);
        line->obstacle = evolution->obstacle;
    }
    if (evolution->part == 0 && !(evolution->interval > 0)) find_range(line, &options);
    cpsi_line_report_uplift(line, evolution->gravity);
    cpsi_line_report_utilisation(line);
}

/* Add a line's report to the step's. */
static void add_report(CpsStepReport *step, const CpsLineReport *line) {
    CpsCertificate *to = &step->certificate;
    const CpsCertificate *from = &line->certificate;
    step->outcome = cps_outcome_worse(step->outcome, line->outcome);
    if (line->iteration_count > step->iteration_count)
        step->iteration_count = line->iteration_count;
    step->dissipated += line->dissipated;
    cpsi_ledger_add(&step->ledger, &line->ledger);
    if (line->substep_count > step->substep_count) step->substep_count = line->substep_count;
    if (line->warm_count > step->warm_count) step->warm_count = line->warm_count;
    step->jump_count += line->jump_count;
    if (line->places > step->places) step->places = line->places;
    step->jump = cpsi_max_nan(step->jump, line->jump);
    step->unaccounted += line->unaccounted;
    to->primal += from->primal;
    to->dual += from->dual;
    to->gap += from->gap;
    to->scale += from->scale;
    to->friction_residual += from->friction_residual;
    to->load_residual += from->load_residual;
    to->law_residual += from->law_residual;
    to->contact_residual += from->contact_residual;
    to->has_tension_bound = to->has_tension_bound && from->has_tension_bound;
    to->tension_bound = to->has_tension_bound ? fmax(to->tension_bound, from->tension_bound) : 0;
    to->tension_estimate = cpsi_max_nan(to->tension_estimate, from->tension_estimate);
    to->force_residual = cpsi_max_nan(to->force_residual, from->force_residual);
    to->largest_force = cpsi_max_nan(to->largest_force, from->largest_force);
    to->element_push = cpsi_max_nan(to->element_push, from->element_push);
    to->elongation_residual = cpsi_max_nan(to->elongation_residual, from->elongation_residual);
    to->stretch_residual = cpsi_max_nan(to->stretch_residual, from->stretch_residual);
    to->penetration = cpsi_max_nan(to->penetration, from->penetration);
    to->element_penetration = cpsi_max_nan(to->element_penetration, from->element_penetration);
}

static double seconds(void) {
    struct timespec now = {0}; /* no time passes where there is no such clock */
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void set_interrupt(CpsEvolution *evolution, CpsiInterrupt interrupt) {
    for (int i = 0; i < evolution->workspace_count; i++)
        evolution->workspace[i].interrupt = interrupt;
}

static bool was_interrupted(const CpsEvolution *evolution) {
    bool seen = false;
    for (int i = 0; i < evolution->workspace_count; i++)
        seen = seen || cpsi_interrupt_seen(&evolution->workspace[i].interrupt);
    return seen;
}

CpsStatus cps_evolution_interrupt(CpsEvolution *evolution, bool (*asked)(void *user), void *user,
                                  CpsError *err) {
    if (!evolution) return cpsi_fail(err, CPS_ERR_ARGUMENT, "evolution is NULL");
    if (asked && !evolution->before) {
        evolution->before = malloc(cps_evolution_state_size(evolution));
        if (!evolution->before)
            return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory for the state before a step");
    }
    set_interrupt(evolution, (CpsiInterrupt){.asked = asked, .user = user});
    return CPS_OK;
}

static void return_to_kept(CpsEvolution *evolution) {
    cpsi_evolution_restore(evolution, evolution->before);
    evolution->is_kept = false;
}

/* How far the lines have been swept; statics place them where the history starts. */
static void report_sweep(CpsEvolution *evolution, bool is_start) {
    for (int i = 0; i < evolution->line_count; i++) {
        if (is_start) cpsi_line_keep_start(&evolution->line[i]);
        cpsi_line_report_sweep(&evolution->line[i], evolution->gravity);
    }
}

/* No line may leave a grid: what is below it there is not known. */
static CpsStatus check_cover(const CpsEvolution *evolution, CpsError *err) {
    for (int k = 0; k < evolution->obstacle_count; k++) {
        const CpsiObstacle *on = &evolution->obstacle[k];
        for (int i = 0; i < evolution->line_count && on->ground; i++) {
            const CpsiLine *line = &evolution->line[i];
            for (int j = 0; j < line->n; j++) {
                const Vec3 x = vec3_at(line->position, j);
                if (cpsi_obstacle_covers(on, x, CPS_TOUCH * line->length)) continue;
                return cpsi_fail(err, CPS_ERR_ARGUMENT,
                                 "line '%s': node %d at (%.9g, %.9g) m has left the grid of ground "
                                 "'%s': take a larger grid, or say that it extends",
                                 line->name, j, x.x + evolution->origin[0],
                                 x.y + evolution->origin[1], evolution->given_obstacle[k].name);
            }
        }
    }
    return CPS_OK;
}

/* Plan a step of a stage, of the move where `is_move`; of no stage the break that is due, or where
 * lines are placed by statics. */
static void plan_step(CpsEvolution *evolution, const CpsiEvolutionStage *stage, bool is_move,
                      const CpsBreak *parts) {
    if (parts->is_break)
        cpsi_stage_plan_break(evolution, parts);
    else if (!stage)
        cpsi_stage_plan_statics(evolution);
    if (!stage || parts->is_break) return;
    const CpsiPortion portion = cpsi_portion_next(evolution, stage, is_move);
    cpsi_stage_plan(evolution, stage, &portion);
    if (!is_move) cpsi_portion_advance(evolution, stage, &portion);
}

/* Plan a step and solve it, of a stage with an error as long as that allows. False: it was
 * interrupted. */
static bool solve_step(CpsEvolution *evolution, const CpsiEvolutionStage *stage, bool is_move,
                       const CpsBreak *parts) {
    const bool has_pace = stage && stage->error > 0;
    int rejected = 0;
    for (bool again = true; again;) {
        plan_step(evolution, stage, is_move, parts);
        evolution->pace = (CpsPace){.length = evolution->interval};
        cpsi_balance_step(evolution, step_line);
        if (was_interrupted(evolution)) return false;
        double shorter = 0;
        again = has_pace && cpsi_pace_rejects(evolution, stage, &shorter);
        if (again) {
            cpsi_evolution_restore(evolution, evolution->before);
            evolution->next = shorter;
            rejected++;
        }
    }
    evolution->pace.rejected = rejected;
    return true;
}

/* Take a step (plan_step). */
static CpsStatus take_step(CpsEvolution *evolution, const CpsiEvolutionStage *stage, bool is_move,
                           const CpsBreak *parts, CpsError *err) {
    const double begin = seconds();
    const CpsiInterrupt *interrupt = &evolution->workspace[0].interrupt;
    if (interrupt->asked || is_move || (stage && stage->error > 0))
        cpsi_evolution_keep(evolution, evolution->before);
    set_interrupt(evolution, (CpsiInterrupt){.asked = interrupt->asked, .user = interrupt->user});
    const bool solved = solve_step(evolution, stage, is_move, parts);
    evolution->is_kept = is_move;
    if (!solved) {
        return_to_kept(evolution);
        return cpsi_fail(err, CPS_ERR_INTERRUPTED,
                         "the load step was interrupted, and is not taken");
    }
    evolution->time += evolution->interval;
    cpsi_end_grounds_report(evolution);
    report_sweep(evolution, stage == NULL && !parts->is_break);
    const CpsStatus covered = check_cover(evolution, err);
    if (covered != CPS_OK) {
        /* a history ends there; a move is not taken, and another may be */
        if (is_move)
            return_to_kept(evolution);
        else
            evolution->ended = true;
        return covered;
    }
    if (parts->is_break)
        evolution->break_count++;
    else if (is_move)
        evolution->move_count++;
    else
        evolution->done++;
    evolution->parted = *parts;
    evolution->report = (CpsStepReport){.name = evolution->step_name,
                                        .step_count = evolution->done + evolution->move_count +
                                                      evolution->break_count,
                                        .outcome = evolution->lone,
                                        .certificate.has_tension_bound = true};
    for (int i = 0; i < evolution->line_count; i++)
        add_report(&evolution->report, &evolution->line[i].report);
    cpsi_coupling_ledger(evolution);
    cpsi_step_ledger(evolution, &evolution->report);
    for (int i = 0; i < evolution->line_count; i++) cpsi_view_update(&evolution->line[i]);
    evolution->ended = !is_move && cps_outcome_is_final(evolution->report.outcome);
    evolution->report.wall = seconds() - begin;
    return CPS_OK;
}

CpsStatus cps_evolution_step(CpsEvolution *evolution, CpsError *err) {
    if (!evolution) return cpsi_fail(err, CPS_ERR_ARGUMENT, "evolution is NULL");
    if (cps_evolution_remaining_count(evolution) == 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "no load step remains: ask cps_evolution_remaining_count first");
    if (cpsi_move_failed(evolution)) return_to_kept(evolution);
    const CpsBreak due = cpsi_break_due(evolution), none = {0};
    if (due.is_break || (evolution->has_static && evolution->done == 0))
        return take_step(evolution, NULL, false, &due, err);
    const CpsiEvolutionStage *stage = &evolution->stage[evolution->current];
    if (evolution->part == 0) {
        char what[96];
        snprintf(what, sizeof what, "stage '%.64s'", stage->name);
        const CpsStatus status =
            cpsi_stage_check_paths(evolution, stage, evolution->move_count > 0, what, err);
        if (status) return cpsi_fail_inside(err, status, "history[%d]", evolution->current + 1);
    }
    return take_step(evolution, stage, false, &none, err);
}

/* Whether a move may be taken now, and memory for the state before it. */
static CpsStatus prepare_move(CpsEvolution *evolution, CpsError *err) {
    if (evolution->ended)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the history ended in a step without an equilibrium: no move follows it");
    if (evolution->has_static && evolution->done == 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the lines are not placed yet: their static start is the first step");
    if (evolution->part > 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "stage '%.64s' of the history is under way: take its other %d steps first",
                         evolution->stage[evolution->current].name, cpsi_steps_left_now(evolution));
    const CpsBreak due = cpsi_break_due(evolution);
    if (due.is_break)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%.64s' carries %g N, above its break_at of %g N: it parts in the "
                         "next step, which cps_evolution_step takes; take that first, or the last "
                         "move back",
                         evolution->line[due.line].name, due.tension, due.break_at);
    if (!evolution->before) evolution->before = malloc(cps_evolution_state_size(evolution));
    return evolution->before
               ? CPS_OK
               : cpsi_fail(err, CPS_ERR_MEMORY, "out of memory for the state before a move");
}

/* May a move have a duration? */
static CpsStatus check_time(const CpsEvolution *evolution, const CpsStage *move, const char *what,
                            CpsError *err) {
    if (!evolution->in_time)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: it has a duration, but the scene is not in time: set its in_time",
                         what);
    bool free = evolution->bodies.count > 0;
    for (int i = 0; i < evolution->points.count; i++)
        free = free || evolution->points.point[i].kind != CPS_POINT_KIND_HELD;
    for (int i = 0; i < move->point_change_count; i++)
        free = free || move->point_change[i].kind == CPS_POINT_KIND_FREE;
    if (!free) return CPS_OK;
    for (int i = 0; i < evolution->line_count; i++)
        if (!(evolution->line[i].compliance > 0))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s: it has a duration, but beside free points or bodies line '%s' "
                             "cannot stretch",
                             what, evolution->line[i].name);
    return CPS_OK;
}

CpsStatus cps_evolution_move(CpsEvolution *evolution, const CpsStage *move, CpsError *err) {
    if (!evolution || !move)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "evolution and move are both needed");
    const CpsScene scene = cpsi_stage_scene(evolution);
    char what[96];
    snprintf(what, sizeof what, "move '%.64s'", move->name ? move->name : "");
    CpsStatus status = cpsi_stage_check(&scene, move, what, err);
    if (status == CPS_OK && move->step_count != 1)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: steps is %d: a move is one step", what,
                           move->step_count);
    const int things = scene.line_count * 2 + scene.point_count + scene.body_count;
    if (status == CPS_OK && move->sway_count > cpsi_sways_of_move(things))
        status = cpsi_fail(err, CPS_ERR_LIMIT, "%s: found %d oscillations, at most %d in a move",
                           what, move->sway_count, cpsi_sways_of_move(things));
    if (status == CPS_OK && cpsi_sways_numbers(move->sway_count, move->sway) > 0)
        status =
            cpsi_fail(err, CPS_ERR_ARGUMENT,
                      "%s: a move is one step, and has no time series: impose its place", what);
    if (status == CPS_OK && move->error > 0)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "%s: error is %g m: a move is one step of its own length, expected 0",
                           what, move->error);
    if (status == CPS_OK && move->duration > 0) status = check_time(evolution, move, what, err);
    if (status == CPS_OK && evolution->wave) status = cpsi_waves_check_stage(move, what, err);
    if (status == CPS_OK) status = prepare_move(evolution, err);
    if (status != CPS_OK) return status;
    for (int i = 0; i < move->body_change_count; i++)
        if (move->body_change[i].kind == CPS_BODY_KIND_FREE && !evolution->points.balance)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s: body '%s' cannot be free: an obstacle's friction has directions",
                             what, evolution->bodies.body[move->body_change[i].body].name);
    for (int i = 0; i < move->point_change_count; i++)
        if (move->point_change[i].kind == CPS_POINT_KIND_FREE && !evolution->points.balance)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s: point '%s' cannot be free: an obstacle's friction has directions",
                             what, evolution->points.point[move->point_change[i].point].name);
    if (cpsi_move_failed(evolution)) return_to_kept(evolution);
    cpsi_stage_fill(&evolution->live, move, evolution->origin);
    evolution->live.name = move->name ? move->name : "move";
    status = cpsi_stage_check_paths(evolution, &evolution->live, true, what, err);
    const CpsBreak none = {0};
    return status == CPS_OK ? take_step(evolution, &evolution->live, true, &none, err) : status;
}

CpsStatus cps_evolution_take_back(CpsEvolution *evolution, CpsError *err) {
    if (!evolution) return cpsi_fail(err, CPS_ERR_ARGUMENT, "evolution is NULL");
    if (!evolution->is_kept)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the last step was no move: there is nothing to take back");
    return_to_kept(evolution);
    return CPS_OK;
}

/* report --------------------------------------------------------------------------------------- */

CpsStepReport cps_evolution_report(const CpsEvolution *evolution) {
    return evolution ? evolution->report
                     : (CpsStepReport){.name = "", .outcome = CPS_OUTCOME_STALLED};
}

int cps_evolution_line_count(const CpsEvolution *evolution) {
    return evolution ? evolution->line_count : 0;
}

static bool has_line(const CpsEvolution *evolution, int line) {
    return line >= 0 && line < cps_evolution_line_count(evolution);
}

CpsLineReport cps_evolution_line_report(const CpsEvolution *evolution, int line) {
    if (!has_line(evolution, line)) return (CpsLineReport){.outcome = CPS_OUTCOME_STALLED};
    CpsLineReport report = evolution->line[line].report;
    for (int end = 0; end < 2; end++)
        for (int a = 0; a < 3; a++)
            if (evolution->origin[a] != 0) { /* 0 keeps its sign */
                report.end[end].position[a] += evolution->origin[a];
                if (report.has_touchdown) report.end[end].touchdown[a] += evolution->origin[a];
            }
    return report;
}

CpsLineMotion cps_evolution_line_motion(const CpsEvolution *evolution, int line) {
    if (!has_line(evolution, line)) return (CpsLineMotion){0};
    const CpsiInertia *inertia = &evolution->line[line].inertia;
    if (!evolution->line[line].has_inertia) return (CpsLineMotion){.ledger = inertia->ledger};
    return (CpsLineMotion){.is_moving = inertia->is_moving,
                           .kinetic = inertia->kinetic,
                           .ledger = inertia->ledger,
                           .landed = inertia->landed,
                           .changed = inertia->changed,
                           .snatched = inertia->snatched,
                           .position_bound = inertia->position_bound,
                           .mass = inertia->mass,
                           .velocity = inertia->velocity,
                           .before = inertia->start,
                           .rest_velocity = inertia->rest_velocity,
                           .span = inertia->span,
                           .velocity_given = {inertia->velocity_given[CPS_END_A],
                                              inertia->velocity_given[CPS_END_B]},
                           .damping = inertia->damping.coefficient,
                           .elongation = inertia->damping.elongation,
                           .rest = inertia->damping.rest};
}

CpsPointMotion cps_evolution_point_motion_view(const CpsEvolution *evolution, int point) {
    if (point < 0 || point >= cps_evolution_point_count(evolution)) return (CpsPointMotion){0};
    const CpsiPointInertia *inertia = &evolution->points.point[point].inertia;
    CpsPointMotion out = {.is_moving = inertia->is_moving,
                          .mass = inertia->mass,
                          .span = inertia->span,
                          .kinetic = inertia->kinetic,
                          .ledger = inertia->ledger,
                          .landed = inertia->landed,
                          .velocity_given = inertia->velocity_given};
    memcpy(out.velocity, inertia->velocity, sizeof out.velocity);
    memcpy(out.rest_velocity, inertia->rest_velocity, sizeof out.rest_velocity);
    if (inertia->is_moving) memcpy(out.reference, inertia->reference, sizeof out.reference);
    return out;
}

/* A place in the coordinates of the scene. */
static void to_scene(const CpsEvolution *evolution, double place[3]) {
    for (int a = 0; a < 3; a++)
        if (evolution->origin[a] != 0) place[a] += evolution->origin[a]; /* 0 keeps its sign */
}

CpsPointMotion cps_evolution_point_motion(const CpsEvolution *evolution, int point) {
    CpsPointMotion out = cps_evolution_point_motion_view(evolution, point);
    if (out.is_moving) to_scene(evolution, out.reference);
    return out;
}

CpsBodyMotion cps_evolution_body_motion(const CpsEvolution *evolution, int body) {
    if (body < 0 || body >= cps_evolution_body_count(evolution)) return (CpsBodyMotion){0};
    const CpsiBodyInertia *inertia = &evolution->bodies.body[body].inertia;
    CpsBodyMotion out = {.is_moving = inertia->is_moving,
                         .span = inertia->span,
                         .kinetic = inertia->kinetic,
                         .dissipated = inertia->dissipated,
                         .ledger = inertia->ledger,
                         .velocity_given = inertia->velocity_given};
    vec3_store(out.velocity, inertia->now.velocity);
    vec3_store(out.turn_rate, inertia->now.rate);
    vec3_store(out.centre_velocity, inertia->now.centre_velocity);
    vec3_store(out.angular_momentum, inertia->now.angular);
    return out;
}

CpsPace cps_evolution_pace(const CpsEvolution *evolution) {
    return evolution ? evolution->pace : (CpsPace){0};
}

double cps_evolution_time(const CpsEvolution *evolution) { return evolution ? evolution->time : 0; }

int cps_evolution_obstacle_count(const CpsEvolution *evolution) {
    return evolution ? evolution->obstacle_count : 0;
}

CpsObstacleReport cps_evolution_obstacle_view(const CpsEvolution *evolution, int obstacle) {
    CpsObstacleReport report = {.turned = 0};
    if (obstacle < 0 || obstacle >= cps_evolution_obstacle_count(evolution)) return report;
    const CpsiObstacle *now = &evolution->obstacle[obstacle];
    const CpsiShift *shift = &evolution->shift[obstacle];
    vec3_store(report.point, now->frame.point);
    vec3_store(report.axis, now->frame.axis[2]);
    vec3_store(report.side, now->frame.axis[0]);
    vec3_store(report.grain, now->grain);
    vec3_store(report.by, shift->by);
    vec3_store(report.turn, shift->turn);
    if (!cpsi_vec3_is_zero(shift->turn)) vec3_store(report.about, shift->about);
    report.turned = evolution->angle[obstacle];
    return report;
}

CpsObstacleReport cps_evolution_obstacle_report(const CpsEvolution *evolution, int obstacle) {
    CpsObstacleReport report = cps_evolution_obstacle_view(evolution, obstacle);
    if (obstacle < 0 || obstacle >= cps_evolution_obstacle_count(evolution)) return report;
    to_scene(evolution, report.point);
    if (report.turn[0] != 0 || report.turn[1] != 0 || report.turn[2] != 0)
        to_scene(evolution, report.about);
    return report;
}

int cps_evolution_point_count(const CpsEvolution *evolution) {
    return evolution ? evolution->points.count : 0;
}

CpsPointReport cps_evolution_point_view(const CpsEvolution *evolution, int point) {
    if (point < 0 || point >= cps_evolution_point_count(evolution))
        return (CpsPointReport){.obstacle = CPS_NO_OBSTACLE};
    return evolution->points.point[point].report;
}

CpsPointReport cps_evolution_point_report(const CpsEvolution *evolution, int point) {
    CpsPointReport report = cps_evolution_point_view(evolution, point);
    if (point >= 0 && point < cps_evolution_point_count(evolution)) {
        to_scene(evolution, report.position);
        if (report.water != CPS_POINT_WATER_NONE) report.water_level += evolution->origin[2];
    }
    return report;
}

int cps_evolution_body_count(const CpsEvolution *evolution) {
    return evolution ? evolution->bodies.count : 0;
}

CpsBodyReport cps_evolution_body_view(const CpsEvolution *evolution, int body) {
    if (body < 0 || body >= cps_evolution_body_count(evolution)) return (CpsBodyReport){0};
    return evolution->bodies.body[body].report;
}

CpsBodyReport cps_evolution_body_report(const CpsEvolution *evolution, int body) {
    CpsBodyReport report = cps_evolution_body_view(evolution, body);
    if (body >= 0 && body < cps_evolution_body_count(evolution))
        to_scene(evolution, report.position);
    return report;
}
