/* SPDX-License-Identifier: BSD-3-Clause */
/* The history of a scene: load steps in sequence, each line solved on its own.
 *
 * A stage of n steps takes each end that it changes from where it is (position, or force carried)
 * to the stage's value in n equal parts. The lines do not act on each other, so a step is one
 * program per line and the report adds them up. */
#define _POSIX_C_SOURCE 200809L
#include "capstan/evolve.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/larger.h"
#include "base/status.h"
#include "cable/tension_field.h"
#include "evolve/checkpoint.h"
#include "evolve/friction_zone.h"
#include "evolve/ledger.h"
#include "evolve/node_start.h"
#include "evolve/origin.h"
#include "evolve/path_check.h"
#include "evolve/sections.h"
#include "evolve/start.h"
#include "evolve/state.h"
#include "evolve/statics.h"
#include "evolve/view.h"

/* create --------------------------------------------------------------------------------------- */

static char *copy_name(CpsiArena *arena, const char *name) {
    const size_t size = strlen(name) + 1;
    char *copy = cpsi_arena_take(arena, size, 1);
    if (copy) memcpy(copy, name, size);
    return copy;
}

/* Do contacts need axes of their own? Not on one plane with isotropic friction. */
static bool scene_needs_local_axes(const CpsScene *scene) {
    if (scene->obstacle_count != 1) return scene->obstacle_count > 1;
    const CpsiObstacle only = cpsi_obstacle(scene->obstacle);
    return cpsi_obstacle_needs_local_axes(&only);
}

/* Do elements have contacts, beside the nodes? With round obstacles they do, and where a node may
 * need a third contact; contact of the reference is that of S90, where only nodes touch. */
static bool scene_has_element_contacts(const CpsScene *scene) {
    bool round = false;
    for (int k = 0; k < scene->obstacle_count; k++)
        round = round || scene->obstacle[k].kind != CPS_OBSTACLE_PLANE;
    return (round || scene->obstacle_count > 2) &&
           scene->contact_policy == CPS_CONTACT_POLICY_REACHED;
}

/* More threads than lines would have nothing to do. */
static int workspace_count(const CpsScene *scene) {
    const int threads = scene->solver.thread_count;
    return threads < scene->line_count ? threads : scene->line_count;
}

/* Everything an evolution holds, in one block (base/arena.h); called once to measure the size and
 * once to place the arrays. */
static CpsEvolution *layout(CpsiArena *arena, const CpsScene *scene, const CpsiConicSet *largest) {
    CpsEvolution measured = {0};
    CpsiLine any = {0};
    CpsiEvolutionStage none = {0};
    CpsEvolution *placed = cpsi_arena_take(arena, 1, sizeof *placed),
                 *evolution = placed ? placed : &measured;
    const bool real = placed != NULL;
    CPSI_PLACE(arena, evolution->line, scene->line_count);
    CPSI_PLACE(arena, evolution->is_static, scene->line_count);
    CPSI_PLACE(arena, evolution->mass, scene->line_count);
    CPSI_PLACE(arena, evolution->stage, scene->stage_count + 1);
    CPSI_PLACE(arena, evolution->obstacle, scene->obstacle_count + 1);
    CPSI_PLACE(arena, evolution->obstacle_name, scene->obstacle_count + 1);
    for (int k = 0; k < scene->obstacle_count; k++) {
        const char *name = copy_name(arena, scene->obstacle[k].name);
        if (real) evolution->obstacle_name[k] = name;
    }
    CPSI_PLACE(arena, evolution->angle, scene->obstacle_count + 1);
    CPSI_PLACE(arena, evolution->move, scene->line_count);
    CpsiWorkspaceSize size = {.obstacles = scene->obstacle_count,
                              .contacts = scene->obstacle_count > 1 ? 2 : 1,
                              .element_contacts = scene_has_element_contacts(scene) ? 1 : 0,
                              .has_local_axes = scene_needs_local_axes(scene),
                              .has_path_tolerance = scene->solver.path_tolerance > 0,
                              .largest = largest,
                              .ops = scene->solver.linear_system == CPS_LINEAR_SYSTEM_DENSE
                                         ? &cpsi_linsys_dense
                                         : &cpsi_linsys_chain};
    for (int i = 0; i < scene->line_count; i++) {
        CpsiLine *line = real ? &evolution->line[i] : &any;
        line->name = copy_name(arena, scene->line[i].name);
        line->n = scene->line[i].element_count + 1;
        line->has_local_axes = size.has_local_axes;
        line->contacts = size.contacts;
        line->element_contacts = size.element_contacts;
        line->has_zones = scene->line[i].zone_count > 0;
        line->has_sections = cpsi_has_sections(&scene->line[i]);
        line->compliance = cpsi_mean_compliance(&scene->line[i]);
        cpsi_line_layout(line, arena);
        if (line->n > size.nodes) size.nodes = line->n;
        if (line->compliance == 0 && line->n > size.inextensible_nodes)
            size.inextensible_nodes = line->n;
    }
    for (int i = 0; i < scene->stage_count; i++) {
        CpsiEvolutionStage *stage = real ? &evolution->stage[i] : &none;
        stage->name = copy_name(arena, scene->stage[i].name);
        CPSI_PLACE(arena, stage->change, scene->stage[i].change_count);
        CPSI_PLACE(arena, stage->turn, scene->stage[i].turn_count);
    }
    cpsi_view_layout(&evolution->fill, arena, size.nodes);
    if (real) cpsi_view_fill(&evolution->fill, size.nodes);
    evolution->workspace_count = workspace_count(scene);
    CPSI_PLACE(arena, evolution->workspace, evolution->workspace_count);
    CpsiWorkspace nothing = {0};
    for (int i = 0; i < evolution->workspace_count; i++)
        cpsi_workspace_layout(real ? &evolution->workspace[i] : &nothing, arena, &size);
    return placed;
}

/* The obstacles of a line, and its axes: those of the one plane, else of the world. */
static void fill_obstacles(CpsiLine *line, const CpsEvolution *evolution) {
    static const double origin[3] = {0, 0, 0}, up[3] = {0, 0, 1};
    line->obstacle_count = evolution->obstacle_count;
    line->obstacle = evolution->obstacle;
    cpsi_workspace_attach(&evolution->workspace[0], line);
    const bool own = line->has_local_axes || line->obstacle_count == 0;
    const CpsiPlane plane = own ? cpsi_plane(origin, up) : line->obstacle[0].frame;
    for (int i = 0; i < 3; i++) vec3_store(&line->common_axes[3 * i], plane.axis[i]);
}

/* The mean factor of the zones over the length that each node stands for. */
static void fill_friction_factor(CpsiLine *line, const CpsLine *def) {
    if (!line->has_zones) return;
    int first = 0;
    for (int j = 0; j < line->n; j++) {
        const double low =
            j > 0 ? line->arc_length[j] - 0.5 * line->element_length[j - 1] : line->arc_length[j];
        line->friction_factor[j] = cpsi_zone_factor(def, &first, low, cpsi_line_share(line, j));
    }
}

/* Move the first guess of statics to the free side of the obstacles. */
static void move_to_free_side(CpsiLine *line) {
    for (int j = 0; j < line->n; j++) {
        const Vec3 x = vec3_load(&line->position[3 * j]);
        double gap;
        const int on = cpsi_line_nearest(line, x, &gap);
        if (gap < 0)
            vec3_store(&line->position[3 * j],
                       vec3_axpy(-gap, cpsi_obstacle_normal(&line->obstacle[on], x), x));
    }
}

static void fill_line(CpsiLine *line, const CpsEvolution *evolution, const CpsScene *scene,
                      const CpsLine *def) {
    line->length = def->length;
    fill_obstacles(line, evolution);
    const Vec3 gravity = vec3_load(scene->gravity);
    const double size = vec3_norm(gravity);
    vec3_store(line->weight, vec3_scale(size > 0 ? cpsi_mean_weight(def) / size : 0, gravity));
    memcpy(line->weight_before, line->weight, sizeof line->weight);
    for (int e = 0; e < def->element_count; e++)
        line->element_length[e] =
            def->element_length ? def->element_length[e] : def->length / def->element_count;
    cpsi_line_set_arc_length(line);
    fill_friction_factor(line, def);
    if (line->has_sections) cpsi_sections_fill(line, def);
    if (line->has_local_axes)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++) line->obstacle_index[c] = -1;
    cpsi_start_place(def, line->position);
    for (int end = 0; end < 2; end++) {
        line->end[end] = def->end[end];
        if (def->end[end].kind == CPS_END_KIND_FREE) continue;
        line->end[end].kind = CPS_END_KIND_HELD;
        cpsi_start_end(def, end, line->end[end].value);
    }
    switch (def->start.kind) {
    case CPS_START_STATIC: move_to_free_side(line); break;
    case CPS_START_NODES: cpsi_node_start(line, def); break;
    default: cpsi_line_start_reaction(line, CPS_TOUCH * line->length);
    }
    memcpy(line->reference, line->position, 3 * (size_t)line->n * sizeof *line->reference);
}

static void fill(CpsEvolution *evolution, const CpsScene *scene) {
    evolution->options = (CpsiStepOptions){.solver = scene->solver,
                                           .friction_policy = scene->friction_policy,
                                           .contact_policy = scene->contact_policy};
    evolution->obstacle_count = scene->obstacle_count;
    for (int k = 0; k < scene->obstacle_count; k++)
        evolution->obstacle[k] = cpsi_obstacle(&scene->obstacle[k]);
    evolution->line_count = scene->line_count;
    evolution->stage_count = scene->stage_count;
    for (int i = 0; i < scene->line_count; i++) {
        fill_line(&evolution->line[i], evolution, scene, &scene->line[i]);
        const double pull = vec3_norm(vec3_load(scene->gravity));
        evolution->mass[i] = pull > 0 ? cpsi_mean_weight(&scene->line[i]) / pull : 0;
        evolution->move[i].angle = evolution->angle;
        evolution->is_static[i] = scene->line[i].start.kind == CPS_START_STATIC;
        evolution->has_static = evolution->has_static || evolution->is_static[i];
    }
    for (int i = 0; i < scene->stage_count; i++) {
        const CpsStage *from = &scene->stage[i];
        CpsiEvolutionStage *stage = &evolution->stage[i];
        stage->steps = from->step_count;
        stage->change_count = from->change_count;
        for (int k = 0; k < from->change_count; k++)
            stage->change[k] = (CpsiChange){.line = from->change[k].line,
                                            .end = from->change[k].end,
                                            .to = from->change[k].to};
        memcpy(stage->from, i > 0 ? evolution->stage[i - 1].to : scene->gravity,
               sizeof stage->from);
        memcpy(stage->to, from->gravity_changes ? from->gravity : stage->from, sizeof stage->to);
        stage->turn_count = from->turn_count;
        for (int k = 0; k < from->turn_count; k++) stage->turn[k] = from->turn[k];
        evolution->step_count += from->step_count;
    }
    if (evolution->has_static) evolution->step_count++;
    if (evolution->step_count == 0) {
        /* no history: one step to the equilibrium under the initial ends */
        const double *g = scene->gravity;
        evolution->stage[0] = (CpsiEvolutionStage){.name = "equilibrium",
                                                   .steps = 1,
                                                   .from = {g[0], g[1], g[2]},
                                                   .to = {g[0], g[1], g[2]}};
        evolution->stage_count = evolution->step_count = 1;
    }
    for (int i = 0; i < evolution->workspace_count; i++)
        cpsi_workspace_connect(&evolution->workspace[i]);
    evolution->report = (CpsStepReport){.name = evolution->step_name};
    evolution->fingerprint = cpsi_evolution_fingerprint(evolution);
}

/* Give each workspace its friction sets and start the threads. `first` are the sets of the first
 * one, which the evolution owns from now on. */
static CpsStatus equip(CpsEvolution *evolution, const CpsScene *scene, CpsiFrictionSets first,
                       CpsError *err) {
    CpsiConicSet sizes;
    CpsStatus status = CPS_OK;
    evolution->workspace[0].friction = first;
    for (int i = 1; i < evolution->workspace_count && status == CPS_OK; i++)
        status = cpsi_friction_sets_make(scene, &evolution->workspace[i].friction, &sizes, err);
    if (status != CPS_OK || evolution->workspace_count == 1) return status;
    evolution->workers = cpsi_workers_create(evolution->workspace_count);
    if (evolution->workers) return CPS_OK;
    return cpsi_fail(err, CPS_ERR_MEMORY, "the system does not give %d threads: ask for fewer",
                     evolution->workspace_count);
}

/* Place the evolution of a scene whose positions are relative to its origin. */
static CpsStatus place(const CpsiLocalScene *local, const CpsiConicSet *largest, CpsEvolution **out,
                       CpsError *err) {
    CpsiArena arena = {0};
    layout(&arena, &local->scene, largest);
    const size_t bytes = arena.used;
    if (!cpsi_arena_allocate(&arena))
        return cpsi_fail(err, CPS_ERR_MEMORY, "%.3g MB for the scene's lines are not to be had",
                         (double)bytes * 1e-6);
    *out = layout(&arena, &local->scene, largest);
    (*out)->arena = arena;
    memcpy((*out)->origin, local->origin, sizeof local->origin);
    return CPS_OK;
}

CpsStatus cps_evolution_create(const CpsScene *scene, CpsEvolution **out, CpsError *err) {
    if (!out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL, expected a place for the handle");
    *out = NULL;
    CpsiFrictionSets sets = {0};
    CpsiConicSet sizes;
    CpsiLocalScene local;
    CpsEvolution *evolution = NULL;
    CpsStatus status = cps_scene_check(scene, err);
    if (status == CPS_OK) status = cpsi_friction_sets_make(scene, &sets, &sizes, err);
    if (status != CPS_OK) return status;
    status = cpsi_local_scene(scene, &local, err);
    if (status == CPS_OK) {
        status = place(&local, sets.set ? &sizes : NULL, &evolution, err);
        if (status == CPS_OK) {
            status = equip(evolution, scene, sets, err);
            sets = (CpsiFrictionSets){0};
            if (status == CPS_OK) fill(evolution, &local.scene);
        }
        cpsi_local_scene_free(&local);
    }
    cpsi_friction_sets_free(&sets);
    if (status == CPS_OK)
        *out = evolution;
    else
        cps_evolution_destroy(evolution);
    return status;
}

void cps_evolution_destroy(CpsEvolution *evolution) {
    if (!evolution) return;
    cpsi_workers_destroy(evolution->workers);
    for (int i = 0; i < evolution->workspace_count; i++)
        cpsi_friction_sets_free(&evolution->workspace[i].friction);
    free(evolution->before);
    CpsiArena arena = evolution->arena; /* the evolution itself lies in it */
    cpsi_arena_free(&arena);
}

/* step ----------------------------------------------------------------------------------------- */

int cps_evolution_step_count(const CpsEvolution *evolution) {
    return evolution ? evolution->step_count : 0;
}

int cps_evolution_remaining_count(const CpsEvolution *evolution) {
    return !evolution || evolution->ended ? 0 : evolution->step_count - evolution->done;
}

/* The initial value of a change of an end: its position if it is to be held, its force if it is to
 * be released. */
static CpsEnd end_now(const CpsiLine *line, int end, CpsEndKind kind) {
    CpsEnd now = {.kind = kind};
    if (kind == line->end[end].kind) return line->end[end];
    const double *x = &line->position[3 * (end == CPS_END_A ? 0 : line->n - 1)];
    memcpy(now.value, kind == CPS_END_KIND_HELD ? x : line->report.end[end].force,
           sizeof now.value);
    return now;
}

/* An end at `part` of the `steps` of its stage. */
static CpsEnd end_at(const CpsiChange *change, int part, int steps) {
    CpsEnd end = change->to;
    const double share = (double)part / steps;
    if (part < steps)
        for (int a = 0; a < 3; a++)
            end.value[a] =
                change->from.value[a] + share * (change->to.value[a] - change->from.value[a]);
    return end;
}

/* A free end is held from where it is. Only now can it be checked whether its straight path from
 * there leads through an obstacle. */
static CpsStatus check_grabs(const CpsEvolution *evolution, CpsError *err) {
    const CpsiEvolutionStage *stage = &evolution->stage[evolution->current];
    if (evolution->part == 0)
        for (int i = 0; i < stage->change_count; i++) {
            const CpsiChange *change = &stage->change[i];
            const CpsiLine *line = &evolution->line[change->line];
            if (change->to.kind != CPS_END_KIND_HELD ||
                line->end[change->end].kind == CPS_END_KIND_HELD)
                continue;
            const CpsEnd from = end_now(line, change->end, CPS_END_KIND_HELD);
            const double *a = from.value, *b = change->to.value, *o = evolution->origin;
            /* rounding of the data, which are coordinates of the scene */
            const double rounding =
                cpsi_place_rounding(line->length, vec3_add(vec3_load(o), vec3_load(b)));
            for (int k = 0; k < evolution->obstacle_count; k++) {
                const double depth =
                    cpsi_path_depth(&evolution->obstacle[k], vec3_load(a), vec3_load(b),
                                    CPSI_PATH_TOUCH * line->length + rounding);
                if (depth > 0)
                    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                                     "stage '%.64s': %s.%s is grabbed at (%g, %g, %g) m and goes "
                                     "straight to (%g, %g, %g) m, through obstacle "
                                     "'%s', up to %g m deep: add way points around it",
                                     stage->name, line->name, change->end == CPS_END_A ? "A" : "B",
                                     o[0] + a[0], o[1] + a[1], o[2] + a[2], o[0] + b[0],
                                     o[1] + b[1], o[2] + b[2], evolution->obstacle_name[k], depth);
            }
        }
    return CPS_OK;
}

/* [N/m] The weight of line i after `part` steps of a stage. */
static void weight_at(const CpsEvolution *evolution, const CpsiEvolutionStage *stage, int i,
                      int part, double weight[3]) {
    const double share = (double)part / stage->steps;
    for (int a = 0; a < 3; a++) {
        const double gravity = part < stage->steps
                                   ? stage->from[a] + share * (stage->to[a] - stage->from[a])
                                   : stage->to[a];
        weight[a] = evolution->mass[i] * gravity;
    }
}

/* Set the change of each line in the next load step, and the name of the step. */
static void plan_step(CpsEvolution *evolution) {
    CpsiEvolutionStage *stage = &evolution->stage[evolution->current];
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++)
            evolution->move[i].from[end] = evolution->move[i].to[end] = evolution->line[i].end[end];
    for (int i = 0; i < evolution->line_count; i++) {
        weight_at(evolution, stage, i, evolution->part, evolution->move[i].weight_from);
        weight_at(evolution, stage, i, evolution->part + 1, evolution->move[i].weight_to);
    }
    for (int k = 0; k < stage->change_count; k++) {
        CpsiChange *change = &stage->change[k];
        if (evolution->part == 0)
            change->from = end_now(&evolution->line[change->line], change->end, change->to.kind);
        CpsiMove *move = &evolution->move[change->line];
        move->from[change->end] =
            evolution->part == 0 ? change->from : end_at(change, evolution->part, stage->steps);
        move->to[change->end] = end_at(change, evolution->part + 1, stage->steps);
    }
    for (int k = 0; k < evolution->obstacle_count; k++) evolution->angle[k] = 0;
    for (int k = 0; k < stage->turn_count; k++)
        evolution->angle[stage->turn[k].obstacle] = stage->turn[k].angle / stage->steps;
    if (stage->steps == 1)
        snprintf(evolution->step_name, CPSI_STEP_NAME, "%s", stage->name);
    else
        snprintf(evolution->step_name, CPSI_STEP_NAME, "%.64s %d/%d", stage->name,
                 evolution->part + 1, stage->steps);
    if (++evolution->part == stage->steps) {
        evolution->part = 0;
        evolution->current++;
    }
}

/* Before the first step, where lines start by statics: loads that do not change. */
static void plan_statics(CpsEvolution *evolution) {
    snprintf(evolution->step_name, CPSI_STEP_NAME, "static");
    for (int k = 0; k < evolution->obstacle_count; k++) evolution->angle[k] = 0;
    for (int i = 0; i < evolution->line_count; i++) {
        const CpsiLine *line = &evolution->line[i];
        CpsiMove *move = &evolution->move[i];
        for (int end = 0; end < 2; end++) move->from[end] = move->to[end] = line->end[end];
        for (int a = 0; a < 3; a++) move->weight_from[a] = move->weight_to[a] = line->weight[a];
    }
}

/* The ranges of the tensions at the ends, after the last step of a stage and after statics. */
static void find_range(CpsiLine *line, const CpsiStepOptions *options) {
    if (!cps_outcome_is_certified(line->report.outcome)) return;
    if (line->forces)
        cpsi_line_tension_range(line, line->forces, options);
    else
        for (int end = 0; end < 2; end++)
            line->report.end[end].range = (CpsTensionRange){.kind = CPS_RANGE_STRAIN};
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
    if (evolution->has_static && evolution->done == 0 && evolution->is_static[i]) {
        options.frictionless = true;
        CpsiStepOptions placing = options;
        placing.contact_policy = CPS_CONTACT_POLICY_REACHED;
        cpsi_line_place_statically(line, &workspace->program, &placing, &workspace->scratch);
    } else {
        cpsi_line_substeps(line, &workspace->program, &options, &evolution->move[i],
                           &workspace->scratch, evolution->done > 0);
    }
    if (evolution->part == 0) find_range(line, &options);
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

CpsStatus cps_evolution_step(CpsEvolution *evolution, CpsError *err) {
    if (!evolution) return cpsi_fail(err, CPS_ERR_ARGUMENT, "evolution is NULL");
    if (cps_evolution_remaining_count(evolution) == 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "no load step remains: ask cps_evolution_remaining_count first");
    const double begin = seconds();
    const bool statics = evolution->has_static && evolution->done == 0;
    const CpsStatus status = statics ? CPS_OK : check_grabs(evolution, err);
    if (status) return status;
    const CpsiInterrupt *interrupt = &evolution->workspace[0].interrupt;
    if (interrupt->asked) cps_evolution_save(evolution, evolution->before);
    set_interrupt(evolution, (CpsiInterrupt){.asked = interrupt->asked, .user = interrupt->user});
    if (statics)
        plan_statics(evolution);
    else
        plan_step(evolution);
    cpsi_workers_run(evolution->workers, step_line, evolution, evolution->line_count);
    if (was_interrupted(evolution)) {
        cpsi_evolution_restore(evolution, evolution->before);
        return cpsi_fail(err, CPS_ERR_INTERRUPTED,
                         "the load step was interrupted, and is not taken");
    }
    evolution->report = (CpsStepReport){.name = evolution->step_name,
                                        .step_count = evolution->done + 1,
                                        .certificate.has_tension_bound = true};
    for (int i = 0; i < evolution->line_count; i++)
        add_report(&evolution->report, &evolution->line[i].report);
    evolution->done++;
    for (int i = 0; i < evolution->line_count; i++) cpsi_view_update(&evolution->line[i]);
    evolution->ended = cps_outcome_is_final(evolution->report.outcome);
    evolution->report.wall = seconds() - begin;
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
            if (evolution->origin[a] != 0)
                report.end[end].position[a] += evolution->origin[a]; /* 0 keeps its sign */
    return report;
}
