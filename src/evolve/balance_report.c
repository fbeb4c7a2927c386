/* SPDX-License-Identifier: BSD-3-Clause */
/* The reports on points and bodies (balance_report.h). */
#include "evolve/balance_report.h"

#include <math.h>
#include <string.h>

#include "cable/certificate.h"
#include "evolve/anchors.h"
#include "evolve/bodies.h"
#include "evolve/body_following.h"
#include "evolve/body_motion.h"
#include "evolve/body_stability.h"
#include "evolve/moving_ground.h"
#include "evolve/newton_step.h"
#include "evolve/point_motion.h"
#include "evolve/points.h"

static void report_point(const CpsiBalance *balance, const CpsiFree *at) {
    CpsEvolution *evolution = balance->evolution;
    CpsiPoint *point = &evolution->points.point[at->point];
    CpsPointReport *report = &point->report;
    const double touch = cpsi_trial_touch(balance, at), dissipated = -vec3_dot(at->force, at->slip);
    const bool touches = at->reaction > 0, slides = vec3_norm(at->slip) > touch;
    const CpsPointWater water = cpsi_water_state(&at->water, touch);
    point->inertia.crossed = water != report->water;
    *report = (CpsPointReport){.state = !touches ? CPS_POINT_STATE_FREE
                                        : slides ? CPS_POINT_STATE_SLIP
                                                 : CPS_POINT_STATE_STICK,
                               .obstacle = touches ? at->obstacle : CPS_NO_OBSTACLE,
                               .reaction = at->reaction,
                               .dissipated = fmax(0, dissipated),
                               .trial_count = balance->trials};
    cpsi_point_load(point, evolution->gravity, report->load);
    report->water = water;
    report->buoyancy = at->water.buoyancy;
    report->displaced = at->water.displaced;
    if (water != CPS_POINT_WATER_NONE) {
        vec3_store(report->water_direction, at->water.n);
        report->water_level = cpsi_surface_below(&point->surface, at->place).z;
    }
    vec3_store(report->position, at->place);
    if (evolution->interval > 0) vec3_store(report->inertia, cpsi_point_inertia(point, at->place));
    if (at->in_set.on) {
        vec3_store(report->set_reaction, at->in_set.reaction);
        memcpy(point->on.reaction, at->in_set.own, sizeof at->in_set.own);
    }
    vec3_store(report->lines, vec3_sub(vec3_sub(cpsi_rest_with(at, 0), vec3_load(report->load)),
                                       vec3_load(report->inertia)));
    vec3_store(report->friction, at->force);
    vec3_store(report->residual, at->left);
    if (touches) vec3_store(report->normal, at->normal);
    if (touches) vec3_store(report->slip, at->slip);
    report->has_place = cpsi_is_balanced(balance, vec3_norm(at->left)) &&
                        cpsi_obeys_friction(balance, at) && cpsi_is_kept_in_set(balance, at) &&
                        !cpsi_ground_outruns(evolution, point, at->start);
    for (int a = 0; a < 3; a++) point->move[a] = report->position[a] - point->before[a];
    memcpy(point->position, report->position, sizeof point->position);
}

/* A line of which a trial has proved that it has no equilibrium there is not certified, with the
 * forces that it has. */
static void withdraw_proof(CpsEvolution *evolution, int index) {
    CpsiLine *line = &evolution->line[index];
    CpsLineReport *report = &line->report;
    report->outcome = CPS_OUTCOME_STALLED;
    memset(report->proof, 0, sizeof report->proof);
    report->proof_length = report->proof_force = report->coulomb = 0;
    report->has_proof_obstacle = report->has_proof_plane = false;
    report->proof_obstacle = report->proof_plane = 0;
    report->certificate = cpsi_certificate(line, evolution->options.solver.tolerance);
}

/* Has a line gone too far in a step in time? */
static bool goes_too_far(const CpsiBalance *balance, int item) {
    const CpsiLine *line = &balance->evolution->line[balance->line[item]];
    return balance->evolution->interval > 0 && line->has_inertia && line->inertia.goes_too_far;
}

/* Is there a free point without a place, or has a line gone too far? Then the lines there are not
 * certified; nor do they prove that there is no equilibrium, which would depend on the places
 * tried. */
static void report_lines(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    bool all = balance->certified;
    for (int k = 0; k < balance->count; k++)
        all = all && evolution->points.point[balance->at[k].point].report.has_place;
    for (int k = 0; k < balance->body_count; k++)
        all = all && evolution->bodies.body[balance->rigid[k].body].report.has_place;
    for (int item = 0; item < balance->line_count; item++)
        all = all && !goes_too_far(balance, item);
    for (int item = 0; item < balance->line_count; item++) {
        CpsLineReport *report = &evolution->line[balance->line[item]].report;
        report->iteration_count += balance->iterations[balance->line[item]];
        if (all) continue;
        if (cps_outcome_is_final(report->outcome)) withdraw_proof(evolution, balance->line[item]);
        if (cps_outcome_is_certified(report->outcome)) report->outcome = CPS_OUTCOME_STALLED;
    }
}

static void store(double out[6], const CpsiWrench *wrench) {
    vec3_store(out, wrench->force);
    vec3_store(&out[3], wrench->moment);
}

/* Does a point of the body lie inside an obstacle? Nothing there holds it off. */
static bool is_inside(const CpsiBalance *balance, int k) {
    const CpsEvolution *evolution = balance->evolution;
    for (int i = 0; i < evolution->points.count; i++) {
        Vec3 place;
        if (balance->rigid_of[i] != k || !cpsi_trial_place(balance, i, &place)) continue;
        const double touch = CPS_TOUCH * evolution->points.point[i].length;
        for (int o = 0; o < evolution->obstacle_count; o++)
            if (cpsi_obstacle_gap(&evolution->obstacle[o], place) < -touch) return true;
    }
    return false;
}

static void report_body(CpsiBalance *balance, int k) {
    CpsEvolution *evolution = balance->evolution;
    const CpsiRigid *rigid = &balance->rigid[k];
    CpsiBody *body = &evolution->bodies.body[rigid->body];
    CpsBodyReport *report = &body->report;
    const CpsiWrench load = cpsi_body_whole_load(evolution, body, &rigid->pose);
    *report = (CpsBodyReport){.kind = CPS_BODY_KIND_FREE, .trial_count = balance->trials};
    vec3_store(report->position, rigid->pose.place);
    rotation_store(report->rotation, rigid->pose.turn);
    store(report->lines, &rigid->lines);
    store(report->load, &load);
    store(report->inertia, &rigid->inertia);
    store(report->damping, &rigid->damping);
    store(report->residual, &rigid->left);
    double rest[6];
    store(rest, &rigid->rest);
    for (int i = 0; i < 6; i++)
        if (body->given.fixed[i]) report->support[i] = -rest[i];
    cpsi_body_block(balance, k, report->stiffness);
    report->has_place =
        cpsi_is_balanced(balance, fmax(vec3_norm(rigid->left.force),
                                       vec3_norm(rigid->left.moment) / body->arm)) &&
        !is_inside(balance, k);
    body->pose = rigid->pose;
}

/* Points on a body are where it is. */
static void follow_body(CpsEvolution *evolution, int index) {
    CpsiPoint *point = &evolution->points.point[index];
    const CpsPoint *given = &evolution->points.given[index];
    vec3_store(point->position,
               cpsi_pose_place(&evolution->bodies.body[given->body].pose, given->position));
}

static void report_held_body(CpsEvolution *evolution, int index) {
    CpsiBody *body = &evolution->bodies.body[index];
    CpsBodyReport *report = &body->report;
    CpsiWrench lines = {vec3(0, 0, 0), vec3(0, 0, 0)};
    const CpsiWrench load = cpsi_body_whole_load(evolution, body, &body->pose);
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++) {
            const int point = evolution->points.tie[2 * i + end];
            const CpsPoint *given = &evolution->points.given[point < 0 ? 0 : point];
            if (point == CPSI_NO_POINT || given->kind != CPS_POINT_KIND_ON_BODY ||
                given->body != index)
                continue;
            const Vec3 pull = vec3_scale(-1, vec3_load(evolution->line[i].report.end[end].force)),
                       arm = cpsi_pose_arm(&body->pose, given->position);
            lines.force = vec3_add(lines.force, pull);
            lines.moment = vec3_add(lines.moment, vec3_cross(arm, pull));
        }
    *report = (CpsBodyReport){.kind = CPS_BODY_KIND_HELD, .has_place = true, .is_stable = true};
    vec3_store(report->position, body->pose.place);
    rotation_store(report->rotation, body->pose.turn);
    store(report->lines, &lines);
    store(report->load, &load);
    if (evolution->interval > 0) {
        const CpsiWrench inertia = cpsi_body_inertia(body, &body->pose),
                         damping = cpsi_body_damping(body, &body->pose);
        store(report->inertia, &inertia);
        store(report->damping, &damping);
    }
    for (int i = 0; i < 6; i++)
        report->support[i] =
            -report->lines[i] - report->load[i] - report->inertia[i] - report->damping[i];
}

/* What holds a held point; of it, what the obstacle on which it lies bears is its reaction. In what
 * gives the support bears all. */
static void report_support(const CpsEvolution *evolution, int index, Vec3 place, Vec3 support,
                           CpsPointReport *report) {
    const CpsiPoint *point = &evolution->points.point[index];
    double gap;
    Vec3 normal = vec3(0, 0, 0);
    const int obstacle = cpsi_trial_nearest(evolution, place, true, &gap, &normal);
    if (point->kind == CPS_POINT_KIND_HELD && gap <= CPS_TOUCH * point->length &&
        vec3_dot(support, normal) > 0) {
        report->obstacle = obstacle;
        report->reaction = vec3_dot(support, normal);
        vec3_store(report->normal, normal);
        support = vec3_reject(support, normal);
    }
    vec3_store(report->support, support);
}

static void report_held(CpsEvolution *evolution, int index) {
    CpsiPoint *point = &evolution->points.point[index];
    CpsPointReport *report = &point->report;
    Vec3 lines = vec3(0, 0, 0);
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++)
            if (evolution->points.tie[2 * i + end] == index)
                lines = vec3_sub(lines, vec3_load(evolution->line[i].report.end[end].force));
    *report =
        (CpsPointReport){.state = point->kind == CPS_POINT_KIND_HELD ? CPS_POINT_STATE_HELD
                                                                     : CPS_POINT_STATE_ON_BODY,
                         .obstacle = CPS_NO_OBSTACLE,
                         .has_place = true};
    memcpy(report->position, point->position, sizeof report->position);
    vec3_store(report->lines, lines);
    if (evolution->interval > 0)
        vec3_store(report->inertia, cpsi_point_inertia(point, vec3_load(point->position)));
    const Vec3 support = vec3_scale(-1, vec3_add(lines, vec3_load(report->inertia)));
    report_support(evolution, index, vec3_load(point->position), support, report);
    if (point->kind == CPS_POINT_KIND_HELD) cpsi_anchor_use(evolution, index, support, report);
}

/* An anchor that drags. */
static void report_anchor(const CpsiBalance *balance, const CpsiFree *at) {
    CpsEvolution *evolution = balance->evolution;
    CpsiPoint *point = &evolution->points.point[at->point];
    CpsPointReport *report = &point->report;
    const Vec3 across = vec3_scale(vec3_dot(at->rest, at->normal), at->normal),
               support = vec3_sub(at->force, across);
    point->dragged += vec3_norm(at->slip);
    *report = (CpsPointReport){.state = CPS_POINT_STATE_HELD,
                               .obstacle = CPS_NO_OBSTACLE,
                               .dragged = point->dragged,
                               .dissipated = fmax(0, -vec3_dot(at->force, at->slip)),
                               .trial_count = balance->trials};
    vec3_store(report->position, at->place);
    vec3_store(report->lines, at->rest);
    vec3_store(report->drag, at->slip);
    vec3_store(report->residual, at->left);
    cpsi_anchor_use(evolution, at->point, support, report);
    report_support(evolution, at->point, at->place, support, report);
    report->has_place =
        cpsi_is_balanced(balance, vec3_norm(at->left)) && cpsi_obeys_friction(balance, at);
    for (int a = 0; a < 3; a++) point->move[a] = report->position[a] - point->before[a];
    memcpy(point->position, report->position, sizeof point->position);
}

void cpsi_report_found(CpsiBalance *balance) {
    if (balance->body_count > 0) cpsi_fill_matrix(balance);
    for (int k = 0; k < balance->count; k++) {
        if (balance->at[k].drags)
            report_anchor(balance, &balance->at[k]);
        else
            report_point(balance, &balance->at[k]);
    }
    for (int k = 0; k < balance->body_count; k++) report_body(balance, k);
    cpsi_add_followers(balance);
    cpsi_judge_stability(balance);
    report_lines(balance);
}

void cpsi_report_no_place(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    for (int k = 0; k < balance->count; k++) {
        CpsiPoint *point = &evolution->points.point[balance->at[k].point];
        CpsPointReport *report = &point->report;
        *report = (CpsPointReport){.state = CPS_POINT_STATE_FREE,
                                   .obstacle = CPS_NO_OBSTACLE,
                                   .trial_count = balance->trials};
        memcpy(report->position, point->before, sizeof report->position);
        cpsi_point_load(point, evolution->gravity, report->load);
        memcpy(report->residual, report->load, sizeof report->residual);
    }
    for (int k = 0; k < balance->body_count; k++) {
        CpsiRigid *rigid = &balance->rigid[k];
        CpsiBody *body = &evolution->bodies.body[rigid->body];
        const CpsiWrench load = cpsi_body_whole_load(evolution, body, &rigid->pose);
        body->report = (CpsBodyReport){.kind = CPS_BODY_KIND_FREE, .trial_count = balance->trials};
        vec3_store(body->report.position, rigid->pose.place);
        rotation_store(body->report.rotation, rigid->pose.turn);
        store(body->report.load, &load);
        store(body->report.residual, &load);
        body->report.is_stable =
            cpsi_is_stable(body->report.stiffness, body->given.fixed, body->arm);
        for (int i = 0; i < 6; i++)
            if (body->given.fixed[i]) {
                body->report.support[i] = -body->report.load[i];
                body->report.residual[i] = 0;
            }
    }
}

void cpsi_report_held(CpsEvolution *evolution) {
    const CpsiPoints *points = &evolution->points;
    for (int i = 0; i < points->count; i++) {
        if (points->point[i].kind == CPS_POINT_KIND_ON_BODY) follow_body(evolution, i);
        if (points->point[i].kind != CPS_POINT_KIND_FREE && !cpsi_point_drags(points, i))
            report_held(evolution, i);
    }
    for (int i = 0; i < evolution->bodies.count; i++)
        if (evolution->bodies.body[i].kind == CPS_BODY_KIND_HELD) report_held_body(evolution, i);
}
