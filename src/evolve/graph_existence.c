/* SPDX-License-Identifier: BSD-3-Clause */
/* Proofs for a group of points, bodies and lines (graph_existence.h). The proof is that of the
 * whole group; each of its lines reports it. */
#include "evolve/graph_existence.h"

#include <math.h>
#include <string.h>

#include "cable/certificate.h"
#include "cable/existence.h"
#include "cable/field.h"
#include "cable/line_solve.h"
#include "cable/line_step.h"
#include "cable/report.h"
#include "cable/self_stress.h"
#include "cable/slopes.h"
#include "evolve/balance_report.h"
#include "evolve/bodies.h"
#include "evolve/body_motion.h"
#include "evolve/body_self_stress.h"
#include "evolve/body_turning.h"
#include "evolve/checkpoint.h"
#include "evolve/first_guess.h"
#include "evolve/points.h"

/* the report ----------------------------------------------------------------------------------- */

/* Leave the group where it was before the step, its lines with this outcome. */
static void report_proof(CpsiBalance *balance, CpsOutcome outcome) {
    CpsEvolution *evolution = balance->evolution;
    const CpsiStepOptions options = cpsi_trial_options(evolution);
    cpsi_begin_again(balance);
    (void)cpsi_place_joints(balance, true);
    for (int item = 0; item < balance->line_count; item++) {
        CpsiLine *line = &evolution->line[balance->line[item]];
        cpsi_trial_restore_line(balance, balance->line[item]);
        cpsi_impose_plan(balance, item);
        cpsi_line_refuse_step(line, &options, outcome);
        cpsi_line_report_uplift(line, evolution->gravity);
        cpsi_line_report_utilisation(line);
    }
    cpsi_report_no_place(balance);
}

bool cpsi_group_is_left(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    bool any = false;
    for (int item = 0; item < balance->line_count; item++)
        any = any || cps_outcome_is_final(evolution->line[balance->line[item]].report.outcome);
    if (!any) return false;
    report_proof(balance, CPS_OUTCOME_STALLED);
    for (int item = 0; item < balance->line_count; item++) {
        CpsiLine *line = &evolution->line[balance->line[item]];
        line->report.certificate = cpsi_certificate(line, evolution->options.solver.tolerance);
    }
    return true;
}

/* unbounded ------------------------------------------------------------------------------------ */

bool cpsi_group_is_held(const CpsiBalance *balance) {
    const CpsEvolution *evolution = balance->evolution;
    for (int item = 0; item < balance->line_count; item++)
        if (evolution->line[balance->line[item]].grasp_count > 0) return true;
    for (int item = 0; item < balance->line_count; item++)
        for (int end = 0; end < 2; end++) {
            const int i = balance->line[item], point = evolution->points.tie[2 * i + end];
            if (point == CPSI_NO_POINT ? evolution->move[i].to[end].kind == CPS_END_KIND_HELD
                                       : evolution->points.group[point] == CPSI_NO_POINT ||
                                             cpsi_set_of_point(&evolution->points, point))
                return true;
        }
    return false;
}

/* The loads of the group. */
typedef struct Loads {
    Vec3 sum;
    double sizes;    /* [N] sum of their sizes */
    bool stopped[3]; /* directions in which a body is fixed or has a stiffness, or a line a field */
} Loads;

static void add_load(Loads *loads, Vec3 load) {
    loads->sum = vec3_add(loads->sum, load);
    loads->sizes += vec3_norm(load);
}

static void add_body_load(const CpsiBalance *balance, const CpsiRigid *rigid, Loads *loads) {
    const CpsEvolution *evolution = balance->evolution;
    const CpsiBody *body = &evolution->bodies.body[rigid->body];
    add_load(loads, cpsi_body_whole_load(evolution, body, &rigid->pose).force);
    for (int a = 0; a < 3; a++) {
        loads->stopped[a] = loads->stopped[a] || body->given.fixed[a] || body->member_count > 0;
        for (int b = 0; b < 6; b++)
            loads->stopped[a] = loads->stopped[a] || body->given.hydrostatics[6 * a + b] != 0;
    }
}

/* The directions that the field of a line resists. */
static void note_stiffness(const CpsiLine *line, bool stopped[3]) {
    for (int j = 0; j < line->n; j++) {
        const double *k = &line->field.stiffness[6 * j];
        stopped[0] = stopped[0] || k[0] > 0;
        stopped[1] = stopped[1] || k[2] > 0;
        stopped[2] = stopped[2] || k[5] > 0;
    }
}

/* The loads of the step, after the reference of each line has been set. */
static Loads loads_of(CpsiBalance *balance) {
    const CpsEvolution *evolution = balance->evolution;
    const CpsiStepOptions options = cpsi_trial_options(evolution);
    Loads loads = {.sum = vec3(0, 0, 0)};
    for (int item = 0; item < balance->line_count; item++) {
        CpsiLine *line = &evolution->line[balance->line[item]];
        cpsi_impose_plan(balance, item);
        cpsi_line_set_reference(line, &options);
        for (int j = 0; j < line->n; j++) add_load(&loads, vec3_at(line->load, j));
        if (line->has_field) note_stiffness(line, loads.stopped);
        if (cpsi_line_loads_follow(line))
            loads.stopped[0] = loads.stopped[1] = loads.stopped[2] = true;
    }
    for (int k = 0; k < balance->count; k++) {
        double load[3];
        cpsi_point_load(&evolution->points.point[balance->at[k].point], evolution->gravity, load);
        add_load(&loads, vec3_load(load));
    }
    for (int k = 0; k < balance->body_count; k++)
        add_body_load(balance, &balance->rigid[k], &loads);
    double sum[3];
    vec3_store(sum, loads.sum);
    for (int a = 0; a < 3; a++)
        if (loads.stopped[a]) sum[a] = 0;
    loads.sum = vec3_load(sum);
    return loads;
}

static bool is_stopped(const Loads *loads, Vec3 v) {
    double along[3];
    vec3_store(along, v);
    for (int a = 0; a < 3; a++)
        if (loads->stopped[a] && along[a] != 0) return true;
    return false;
}

/* Add what frozen friction takes at most: its bounds at the lines' nodes, whose reference is set,
 * and at the points. */
static void add_frozen_bounds(const CpsiBalance *balance, CpsiSlopes *slopes) {
    const CpsEvolution *evolution = balance->evolution;
    for (int item = 0; item < balance->line_count; item++)
        cpsi_slopes_add_bounds(&evolution->line[balance->line[item]], slopes);
    for (int k = 0; k < balance->count; k++) {
        const CpsiPoint *point = &evolution->points.point[balance->at[k].point];
        CpsiFree at = {.point = balance->at[k].point, .place = vec3_load(point->before)};
        cpsi_trial_find_obstacle(evolution, &at);
        if (at.obstacle != CPS_NO_OBSTACLE)
            slopes->slope[at.obstacle].bound += at.friction * point->reaction_before;
    }
}

/* [-] The largest factor by which zones of lines make friction larger than it is at points. */
static double largest_factor(const CpsiBalance *balance) {
    double factor = 1;
    for (int item = 0; item < balance->line_count; item++)
        factor = fmax(factor,
                      cpsi_largest_friction_factor(&balance->evolution->line[balance->line[item]]));
    return factor;
}

/* Does the group slide off planes? */
static bool slips_off(const CpsiBalance *balance, CpsiFall *fall) {
    const CpsEvolution *evolution = balance->evolution;
    const CpsiStepOptions options = cpsi_trial_options(evolution);
    const bool frozen = options.friction_policy == CPS_FRICTION_POLICY_FROZEN;
    const double factor = options.frictionless ? 0 : largest_factor(balance);
    CpsiSlopes slopes;
    if (!cpsi_slopes_fill(&evolution->line[balance->line[0]], factor, frozen, &slopes))
        return false;
    if (frozen && !options.frictionless) add_frozen_bounds(balance, &slopes);
    cpsi_slopes_fall(&slopes, fall);
    return fall->power > 0;
}

/* Does no line touch anything, now or later, on the way along the loads? */
static bool falls_freely(const CpsiBalance *balance, CpsiFall *fall) {
    fall->power = vec3_norm(fall->sum);
    fall->v = vec3_scale(1 / fall->power, fall->sum);
    for (int item = 0; item < balance->line_count; item++)
        if (!cpsi_line_moves_away(&balance->evolution->line[balance->line[item]], fall->v))
            return false;
    return true;
}

bool cpsi_group_falls(CpsiBalance *balance) {
    if (cpsi_group_is_held(balance) || !cpsi_is_without_bounds(balance)) return false;
    (void)cpsi_place_joints(balance, true);
    const Loads loads = loads_of(balance);
    CpsiFall fall = {.sum = loads.sum};
    const double least = CPSI_LEAST_POWER * loads.sizes;
    bool falls = slips_off(balance, &fall) && fall.power > least && !is_stopped(&loads, fall.v);
    if (!falls && vec3_norm(fall.sum) > least) falls = falls_freely(balance, &fall);
    if (!falls) {
        cpsi_trial_restore_lines(balance);
        cpsi_begin_again(balance);
        return false;
    }
    report_proof(balance, CPS_OUTCOME_UNBOUNDED);
    for (int item = 0; item < balance->line_count; item++) {
        CpsLineReport *report = &balance->evolution->line[balance->line[item]].report;
        vec3_store(report->proof, fall.v);
        report->proof_force = fall.power;
    }
    return true;
}

/* a body that turns for ever ------------------------------------------------------------------- */

/* Where on the body its lines end, in its own axes; false if not at one point. */
static bool eye_of(const CpsEvolution *evolution, int body, Vec3 *eye) {
    bool any = false;
    for (int i = 0; i < 2 * evolution->line_count; i++) {
        const int point = evolution->points.tie[i];
        if (point == CPSI_NO_POINT) continue;
        const CpsPoint *given = &evolution->points.given[point];
        if (given->kind != CPS_POINT_KIND_ON_BODY || given->body != body) continue;
        const Vec3 at = vec3_load(given->position);
        if (any && (at.x != eye->x || at.y != eye->y || at.z != eye->z)) return false;
        *eye = at;
        any = true;
    }
    return any;
}

/* The axes about which the loads balance by themselves: none is fixed, and no force at the
 * reference point of which nothing is known, as of a fixed direction, has a moment there. False if
 * the water has moments, of which there is no proof. */
static bool find_axes(const CpsBody *given, Vec3 eye, bool about[3]) {
    if (given->member_count > 0) return false;
    for (int a = 0; a < 3; a++) about[a] = !given->fixed[3 + a];
    for (int a = 0; a < 3; a++) {
        bool held = given->fixed[a];
        for (int b = 0; b < 6; b++) {
            if (given->hydrostatics[6 * (3 + a) + b] != 0) return false;
            held = held || given->hydrostatics[6 * a + b] != 0;
        }
        for (int b = 0; b < 3; b++)
            if (held && vec3_norm(eye) > 0 && b != a) about[b] = false;
    }
    return true;
}

/* Does a moment turn the body in whatever pose it is? */
static bool turns(const CpsEvolution *evolution, const CpsiBody *body, int index, Vec3 *axis,
                  double *moment) {
    CpsiTurning of = {.force = vec3_add(body->load.force, body->waves.force),
                      .moment = vec3_add(body->load.moment, body->waves.moment),
                      .gravity = vec3_load(evolution->gravity)};
    if (!(vec3_norm(of.moment) > 0) || !eye_of(evolution, index, &of.eye) ||
        !find_axes(&body->given, of.eye, of.about))
        return false;
    const Vec3 weight = vec3_sub(of.eye, vec3_load(body->given.centre_of_gravity)),
               lift = vec3_sub(of.eye, vec3_load(body->given.centre_of_buoyancy));
    of.weight_by = vec3_axpy(-body->lift, lift, vec3_scale(body->mass, weight));
    of.sizes =
        vec3_norm(of.moment) + vec3_norm(of.eye) * vec3_norm(of.force) +
        (body->mass * vec3_norm(weight) + body->lift * vec3_norm(lift)) * vec3_norm(of.gravity);
    return cpsi_turns_for_ever(&of, axis, moment);
}

bool cpsi_group_turns(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    for (int k = 0; k < balance->body_count; k++) {
        const int index = balance->rigid[k].body;
        CpsiBody *body = &evolution->bodies.body[index];
        Vec3 axis;
        double moment;
        if (!turns(evolution, body, index, &axis, &moment)) continue;
        report_proof(balance, CPS_OUTCOME_UNBOUNDED);
        vec3_store(body->report.proof, axis);
        body->report.proof_moment = moment;
        return true;
    }
    return false;
}

/* infeasible ----------------------------------------------------------------------------------- */

/* The lines of the group as for a guess. */
static CpsiNetworkPart plan_lines(CpsiBalance *balance) {
    cpsi_trial_restore_lines(balance);
    return cpsi_network_part(balance, true);
}

/* ... and again as before the step. */
static void leave_lines(CpsiBalance *balance) {
    cpsi_trial_restore_lines(balance);
    cpsi_trial_use_blocks(balance);
}

/* The proof for a group with bodies; the places and poses of the trial stay. */
static bool bodies_are_too_far(CpsiBalance *balance, double *missing) {
    const size_t bytes = (size_t)balance->count * sizeof *balance->at,
                 rigid = (size_t)balance->body_count * sizeof *balance->rigid;
    memcpy(balance->best, balance->at, bytes);
    memcpy(balance->rigid_best, balance->rigid, rigid);
    const bool proven = cpsi_bodies_are_out_of_reach(balance, missing);
    memcpy(balance->at, balance->best, bytes);
    memcpy(balance->rigid, balance->rigid_best, rigid);
    return proven;
}

void cpsi_bring_bodies_within_reach(CpsiBalance *balance) {
    double missing;
    cpsi_begin_again(balance);
    (void)plan_lines(balance);
    (void)cpsi_bodies_are_out_of_reach(balance, &missing);
    leave_lines(balance);
}

bool cpsi_group_is_too_short(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    if (!cpsi_has_inextensible(balance) || !cpsi_is_without_bounds(balance)) return false;
    const CpsiNetworkPart part = plan_lines(balance);
    double missing;
    const bool short_of = balance->body_count > 0
                              ? bodies_are_too_far(balance, &missing)
                              : cpsi_network_is_too_short(&balance->network, evolution->line, &part,
                                                          balance->node, &balance->guess, &missing);
    leave_lines(balance);
    if (!short_of) return false;
    report_proof(balance, CPS_OUTCOME_INFEASIBLE);
    for (int item = 0; item < balance->line_count; item++) {
        CpsLineReport *report = &evolution->line[balance->line[item]].report;
        memcpy(report->proof, &balance->guess.pull[6 * item], sizeof report->proof);
        report->proof_length = missing;
    }
    return true;
}
