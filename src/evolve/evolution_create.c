/* SPDX-License-Identifier: BSD-3-Clause */
/* Creating and destroying an evolution: everything that it holds lies in one block. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "cable/held.h"
#include "cable/report.h"
#include "cable/winch.h"
#include "capstan/evolve.h"
#include "evolve/balance.h"
#include "evolve/body_motion.h"
#include "evolve/checkpoint.h"
#include "evolve/constraints.h"
#include "evolve/excitation.h"
#include "evolve/failure.h"
#include "evolve/friction_zone.h"
#include "evolve/loads.h"
#include "evolve/members.h"
#include "evolve/node_start.h"
#include "evolve/origin.h"
#include "evolve/point_motion.h"
#include "evolve/sections.h"
#include "evolve/soft_check.h"
#include "evolve/stages.h"
#include "evolve/start.h"
#include "evolve/sways.h"
#include "evolve/time_check.h"
#include "evolve/trial.h"
#include "evolve/view.h"
#include "evolve/waves.h"
#include "geometry/folds.h"

static char *copy_name(CpsiArena *arena, const char *name) {
    const size_t size = strlen(name) + 1;
    char *copy = cpsi_arena_take(arena, size, 1);
    if (copy) memcpy(copy, name, size);
    return copy;
}

/* Do contacts need axes of their own? Not on one plane with isotropic friction that stays. Where
 * that gives, rounds refine what the interior-point loop leaves of reactions; lines with inertia
 * have Newton's method for that, whose steps are short. */
static bool scene_needs_local_axes(const CpsScene *scene) {
    if (scene->obstacle_count != 1 || scene->obstacle[0].moves) return scene->obstacle_count > 0;
    const CpsiObstacle only = cpsi_obstacle(scene->obstacle);
    if (only.stiffness > 0)
        for (int i = 0; i < scene->line_count; i++)
            if (!(scene->line[i].inertia > 0)) return true;
    return cpsi_obstacle_needs_local_axes(&only);
}

/* May a node touch an obstacle in two places, beside a fold? Contact of the reference is with the
 * nearest one. */
static bool scene_has_folds(const CpsScene *scene) {
    bool folds = false;
    for (int k = 0;
         k < scene->obstacle_count && scene->contact_policy == CPS_CONTACT_POLICY_REACHED; k++) {
        const CpsiObstacle o = cpsi_obstacle(&scene->obstacle[k]);
        folds = folds || cpsi_obstacle_has_folds(&o);
    }
    return folds;
}

/* Do elements have contacts, beside the nodes? With what is convex somewhere they do, and where a
 * node may need a third contact; contact of the reference is that of S90, where only nodes touch.
 */
static bool scene_has_element_contacts(const CpsScene *scene, bool has_folds) {
    bool round = false;
    for (int k = 0; k < scene->obstacle_count; k++) {
        const CpsiObstacle o = cpsi_obstacle(&scene->obstacle[k]);
        round = round || cpsi_obstacle_faces_lines(&o);
    }
    return (round || scene->obstacle_count > 2 || has_folds) &&
           scene->contact_policy == CPS_CONTACT_POLICY_REACHED;
}

static void take_contacts(CpsiLine *line, const CpsiWorkspaceSize *size, bool has_folds) {
    line->obstacle_count = size->obstacles;
    line->has_local_axes = size->has_local_axes;
    line->has_folds = has_folds;
    line->contacts = size->contacts;
    line->element_contacts = size->element_contacts;
}

/* More threads than lines would have nothing to do. */
static int workspace_count(const CpsScene *scene) {
    const int threads = scene->solver.thread_count;
    return threads < scene->line_count ? threads : scene->line_count;
}

/* Current and waves. */
static void layout_water(CpsEvolution *evolution, CpsiArena *arena, const CpsScene *scene) {
    if (scene->current) {
        CPSI_PLACE(arena, evolution->current_row, scene->current->row_count);
        CPSI_PLACE(arena, evolution->flow, scene->line_count);
    }
    if (cpsi_waves_of(scene)) CPSI_PLACE(arena, evolution->wave, cpsi_waves_of(scene)->wave_count);
}

/* What stages are checked against. */
static void layout_given(CpsEvolution *evolution, CpsiArena *arena, const CpsScene *scene,
                         bool real) {
    CPSI_PLACE(arena, evolution->given_obstacle, scene->obstacle_count + 1);
    CPSI_PLACE(arena, evolution->given_line, scene->line_count);
    for (int k = 0; k < scene->obstacle_count; k++) {
        const char *name = copy_name(arena, scene->obstacle[k].name);
        if (real) evolution->given_obstacle[k].name = name;
    }
}

static void layout_bodies(CpsEvolution *evolution, CpsiArena *arena, const CpsScene *scene,
                          bool real) {
    cpsi_bodies_layout(&evolution->bodies, arena, scene);
    cpsi_excitation_layout(evolution, arena, scene);
    cpsi_body_motion_layout(evolution, arena, scene);
    cpsi_members_layout(evolution, arena, scene);
    CPSI_PLACE(arena, evolution->given_body, scene->body_count);
    for (int i = 0; i < scene->body_count; i++) {
        const char *name = copy_name(arena, scene->body[i].name);
        if (real) evolution->bodies.body[i].name = name;
    }
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
    CPSI_PLACE(arena, evolution->angle, scene->obstacle_count + 1);
    CPSI_PLACE(arena, evolution->shift, scene->obstacle_count + 1);
    CPSI_PLACE(arena, evolution->move, scene->line_count);
    CPSI_PLACE(arena, evolution->from, 2 * scene->line_count);
    CPSI_PLACE(arena, evolution->release, 2 * scene->line_count);
    layout_water(evolution, arena, scene);
    layout_given(evolution, arena, scene, real);
    const bool has_folds = scene_has_folds(scene);
    CpsiWorkspaceSize size = {.obstacles = scene->obstacle_count,
                              .contacts = scene->obstacle_count > 1 || has_folds ? 2 : 1,
                              .element_contacts =
                                  scene_has_element_contacts(scene, has_folds) ? 1 : 0,
                              .has_local_axes = scene_needs_local_axes(scene),
                              .has_path_tolerance = scene->solver.path_tolerance > 0,
                              .has_soft = cpsi_soft_obstacle(scene) != NULL,
                              .largest = largest,
                              .ops = scene->solver.linear_system == CPS_LINEAR_SYSTEM_DENSE
                                         ? &cpsi_linsys_dense
                                         : &cpsi_linsys_chain};
    for (int i = 0; i < scene->line_count; i++) {
        CpsiLine *line = real ? &evolution->line[i] : &any;
        line->name = copy_name(arena, scene->line[i].name);
        line->n = scene->line[i].element_count + 1;
        take_contacts(line, &size, has_folds);
        line->has_zones = scene->line[i].zone_count > 0;
        line->has_sections = cpsi_has_sections(&scene->line[i]);
        for (int end = 0; end < 2; end++) line->drums.on[end] = scene->line[i].winch[end].is_there;
        line->has_potential = cpsi_has_potential(&scene->line[i]);
        line->has_field = cpsi_has_springs(&scene->line[i]) || line->has_potential;
        cpsi_line_loads_take(line, &scene->line[i]);
        line->has_node_loads = cpsi_has_forces(&scene->line[i]) ||
                               cpsi_has_drag(scene, &scene->line[i]) || line->has_potential;
        line->has_breaking_load = cpsi_has_breaking_load(&scene->line[i]);
        line->has_break_at = cpsi_has_break_at(&scene->line[i]);
        line->has_inertia = cpsi_is_in_time(scene) && !scene->line[i].quasi_static;
        line->has_field = line->has_field || line->has_inertia;
        line->inertia.damping.coefficient = line->has_inertia ? scene->line[i].damping : 0;
        line->compliance = line->spring_compliance = cpsi_mean_compliance(&scene->line[i]);
        line->spring_count = cpsi_spring_count(&scene->line[i], false);
        line->two.exists = cpsi_has_dynamic_stiffness(&scene->line[i]);
        line->two.elasticity[CPSI_STATIC].spring_count = line->spring_count;
        line->two.elasticity[CPSI_DYNAMIC].spring_count =
            line->two.exists ? cpsi_spring_count(&scene->line[i], true) : 0;
        cpsi_line_layout(line, arena);
        if (line->n > size.nodes) size.nodes = line->n;
        if (cpsi_line_most_springs(line) > size.springs)
            size.springs = cpsi_line_most_springs(line);
        if (line->compliance == 0 && line->n > size.inextensible_nodes)
            size.inextensible_nodes = line->n;
    }
    for (int i = 0; i < scene->stage_count; i++) {
        CpsiEvolutionStage *stage = real ? &evolution->stage[i] : &none;
        stage->name = copy_name(arena, scene->stage[i].name);
        cpsi_stage_layout(stage, arena, scene->stage[i].change_count,
                          scene->stage[i].point_change_count, scene->stage[i].body_change_count,
                          scene->stage[i].turn_count, scene->stage[i].grasp_change_count,
                          scene->stage[i].shift_count, scene->stage[i].sway_count,
                          cpsi_sways_numbers(scene->stage[i].sway_count, scene->stage[i].sway),
                          scene->stage[i].pay_out_count);
    }
    cpsi_stage_layout(&evolution->live, arena, 2 * scene->line_count, scene->point_count,
                      scene->body_count, scene->obstacle_count,
                      CPSI_GRASP_CHANGES * scene->line_count, scene->obstacle_count,
                      cpsi_sways_of_move(2 * scene->line_count + scene->point_count +
                                         scene->body_count),
                      0, 2 * scene->line_count);
    cpsi_points_layout(&evolution->points, arena, scene);
    for (int i = 0; i < scene->point_count; i++) {
        const char *name = copy_name(arena, scene->point[i].name);
        if (real) evolution->points.point[i].name = name;
    }
    layout_bodies(evolution, arena, scene, real);
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
        const Vec3 x = vec3_at(line->position, j);
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
    line->bearing_width = def->bearing_width;
    fill_obstacles(line, evolution);
    const Vec3 gravity = vec3_load(scene->gravity);
    const double size = vec3_norm(gravity);
    vec3_store(line->weight, vec3_scale(size > 0 ? cpsi_mean_weight(def) / size : 0, gravity));
    memcpy(line->weight_before, line->weight, sizeof line->weight);
    /* both are one array but of a line with two stiffnesses */
    for (int e = 0; e < def->element_count; e++)
        line->element_length[e] = line->natural_length[e] =
            def->element_length ? def->element_length[e] : def->length / def->element_count;
    cpsi_line_set_arc_length(line);
    fill_friction_factor(line, def);
    if (line->has_sections || line->has_breaking_load || line->has_break_at ||
        line->spring_count > 0)
        cpsi_sections_fill(line, def);
    cpsi_winch_keep(line);
    cpsi_winch_set(line, (const double[2]){def->winch[0].stored, def->winch[1].stored});
    if (line->has_local_axes)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++)
            line->obstacle_index[c] = CPS_NO_OBSTACLE;
    if (line->has_folds)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++) line->face[c] = CPSI_NO_FACE;
    cpsi_start_place(def, line->position);
    if (def->loads)
        cpsi_line_loads_fill(line, scene, def, evolution->origin, evolution->current_row,
                             evolution->flow ? &evolution->flow[def - scene->line] : NULL);
    if (line->field.flow && evolution->wave)
        evolution->flow[def - scene->line].waves = &evolution->waves;
    if (line->field.flow && scene->current->function)
        evolution->flow[def - scene->line].given = &evolution->water;
    for (int end = 0; end < 2; end++) {
        line->end[end] = def->end[end];
        if (def->end[end].kind == CPS_END_KIND_FREE) continue;
        line->end[end].kind = CPS_END_KIND_HELD;
        cpsi_start_end(def, end, line->end[end].value);
    }
    cpsi_constraints_fill(line, def);
    cpsi_line_put_held(line, line->position); /* a start is so near them as rounding */
    switch (def->start.kind) {
    case CPS_START_STATIC: move_to_free_side(line); break;
    case CPS_START_NODES: cpsi_node_start(line, def); break;
    default: cpsi_line_start_reaction(line, CPS_TOUCH * line->length);
    }
    memcpy(line->reference, line->position, 3 * (size_t)line->n * sizeof *line->reference);
    if (line->has_inertia) cpsi_inertia_fill(line, def);
    cpsi_line_keep_start(line);
}

static void fill(CpsEvolution *evolution, const CpsScene *scene) {
    if (scene->current && scene->current->function) {
        evolution->water.function = scene->current->function;
        evolution->water.user = scene->current->user;
        memcpy(evolution->water.origin, evolution->origin, sizeof evolution->water.origin);
    }
    evolution->options = (CpsiStepOptions){.solver = scene->solver,
                                           .friction_policy = scene->friction_policy,
                                           .contact_policy = scene->contact_policy};
    evolution->obstacle_count = scene->obstacle_count;
    for (int k = 0; k < scene->obstacle_count; k++) {
        evolution->obstacle[k] = cpsi_obstacle(&scene->obstacle[k]);
        (void)cps_ground_retain(evolution->obstacle[k].ground);
        (void)cps_mesh_retain(evolution->obstacle[k].mesh);
    }
    evolution->in_time = cpsi_is_in_time(scene);
    evolution->time_scheme = scene->time_scheme;
    evolution->line_count = scene->line_count;
    evolution->stage_count = scene->stage_count;
    cpsi_waves_fill(&evolution->waves, evolution->wave, scene, evolution->origin);
    for (int i = 0; i < scene->line_count; i++) {
        fill_line(&evolution->line[i], evolution, scene, &scene->line[i]);
        const double pull = vec3_norm(vec3_load(scene->gravity));
        evolution->mass[i] = pull > 0 ? cpsi_mean_weight(&scene->line[i]) / pull : 0;
        evolution->move[i].angle = evolution->angle;
        evolution->is_static[i] = scene->line[i].start.kind == CPS_START_STATIC;
        evolution->has_static = evolution->has_static || evolution->is_static[i];
    }
    for (int i = 0; i < scene->stage_count; i++) {
        cpsi_stage_fill(&evolution->stage[i], &scene->stage[i], (const double[3]){0, 0, 0});
    }
    memcpy(evolution->gravity, scene->gravity, sizeof evolution->gravity);
    memcpy(evolution->gravity_given, scene->gravity, sizeof evolution->gravity_given);
    if (!evolution->has_static && scene->stage_count == 0) {
        /* no history: one step to the equilibrium under the initial ends */
        evolution->stage[0] =
            (CpsiEvolutionStage){.name = "equilibrium", .steps = 1, .static_stiffness = true};
        evolution->stage_count = 1;
    }
    for (int i = 0; i < evolution->workspace_count; i++)
        cpsi_workspace_connect(&evolution->workspace[i]);
    evolution->report = (CpsStepReport){.name = evolution->step_name};
    cpsi_evolution_hash_stages(evolution);
}

/* Keep what stages are checked against. */
static void fill_given(CpsEvolution *evolution, const CpsScene *scene) {
    for (int k = 0; k < scene->obstacle_count; k++) {
        CpsObstacle *given = &evolution->given_obstacle[k];
        const char *name = given->name;
        *given = scene->obstacle[k];
        given->name = name;
        given->friction_set = NULL;
    }
    for (int i = 0; i < scene->line_count; i++)
        evolution->given_line[i] =
            (CpsLine){.name = evolution->line[i].name,
                      .length = scene->line[i].length,
                      .element_count = scene->line[i].element_count,
                      .end = {scene->line[i].end[CPS_END_A], scene->line[i].end[CPS_END_B]},
                      .end_point = {scene->line[i].end_point[0], scene->line[i].end_point[1]},
                      .element_length = cpsi_line_has_winch(&evolution->line[i])
                                            ? evolution->line[i].drums.length
                                            : NULL,
                      .winch = {scene->line[i].winch[0], scene->line[i].winch[1]},
                      .constraint = {scene->line[i].constraint[0], scene->line[i].constraint[1]}};
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++) evolution->given_line[i].constraint[end].set = NULL;
}

/* Ends at points are where those are: of one on a body the place in the scene, less the origin, is
 * rounded more than that in the local scene. */
static void bring_ends_to_points(CpsEvolution *evolution) {
    const CpsiPoints *points = &evolution->points;
    for (int k = 0; k < 2 * evolution->line_count; k++)
        if (points->tie[k] != CPSI_NO_POINT)
            memcpy(evolution->line[k / 2].end[k % 2].value, points->point[points->tie[k]].position,
                   sizeof points->point->position);
}

/* The points, and the memory to find those that are free: with friction that has directions none
 * may be. */
static CpsStatus fill_points(CpsEvolution *evolution, const CpsScene *scene, const CpsScene *local,
                             CpsError *err) {
    cpsi_points_fill(&evolution->points, scene, local);
    bring_ends_to_points(evolution);
    cpsi_bodies_fill(&evolution->bodies, scene, local);
    cpsi_excitation_fill(evolution, local);
    cpsi_body_motion_fill(evolution);
    cpsi_members_fill(evolution, local);
    for (int i = 0; i < scene->body_count; i++)
        evolution->given_body[i] = evolution->bodies.body[i].given;
    cpsi_body_motion_start(evolution);
    cpsi_point_motion_start(evolution);
    cpsi_follow_releases(evolution);
    bool isotropic = true;
    for (int k = 0; k < evolution->obstacle_count; k++)
        isotropic = isotropic && cpsi_obstacle_is_isotropic(&evolution->obstacle[k]);
    if (scene->point_count == 0 || !isotropic) return CPS_OK;
    evolution->points.balance = cpsi_balance_create(evolution);
    if (!evolution->points.balance)
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for %d points", scene->point_count);
    cpsi_balance_start(evolution);
    return CPS_OK;
}

/* Give each workspace its friction sets and start the threads. `first` are the sets of the first
 * one, which the evolution owns from now on. */
static CpsStatus equip(CpsEvolution *evolution, const CpsScene *scene, CpsiFrictionSets first,
                       CpsError *err) {
    CpsiConicSet sizes;
    CpsStatus status = CPS_OK;
    evolution->workspace[0].friction_sets = first;
    for (int i = 1; i < evolution->workspace_count && status == CPS_OK; i++)
        status =
            cpsi_friction_sets_make(scene, &evolution->workspace[i].friction_sets, &sizes, err);
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

/* Memory for the state before a step that may be taken back, where a stage has an error. */
static CpsStatus make_room_before(CpsEvolution *evolution, CpsError *err) {
    bool any = false;
    for (int k = 0; k < evolution->stage_count; k++) any = any || evolution->stage[k].error > 0;
    if (!any) return CPS_OK;
    evolution->before = malloc(cps_evolution_state_size(evolution));
    return evolution->before
               ? CPS_OK
               : cpsi_fail(err, CPS_ERR_MEMORY, "out of memory for the state before a step");
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
    CpsiHeldScene held;
    status = cpsi_held_scene(scene, &held, err);
    if (status == CPS_OK) status = cpsi_local_scene(&held.scene, &local, err);
    if (status == CPS_OK) {
        status = place(&local, sets.set ? &sizes : NULL, &evolution, err);
        if (status == CPS_OK) {
            status = equip(evolution, scene, sets, err);
            sets = (CpsiFrictionSets){0};
            if (status == CPS_OK) {
                fill_given(evolution, scene);
                fill(evolution, &local.scene);
                cpsi_point_constraints_fill(&evolution->points, &local.scene);
                status = cpsi_constraints_make(evolution, &local.scene, err);
                if (status == CPS_OK) status = fill_points(evolution, scene, &local.scene, err);
                evolution->fingerprint = cpsi_evolution_fingerprint(evolution);
                if (status == CPS_OK) status = make_room_before(evolution, err);
            }
        }
        cpsi_local_scene_free(&local);
    }
    free(held.block);
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
        cpsi_friction_sets_free(&evolution->workspace[i].friction_sets);
    cpsi_constraints_free(evolution);
    free(evolution->before);
    cpsi_balance_free(evolution->points.balance);
    for (int k = 0; k < evolution->obstacle_count; k++) {
        cps_ground_release((CpsGround *)evolution->obstacle[k].ground);
        cps_mesh_release((CpsMesh *)evolution->obstacle[k].mesh);
    }
    CpsiArena arena = evolution->arena; /* the evolution itself lies in it */
    cpsi_arena_free(&arena);
}
