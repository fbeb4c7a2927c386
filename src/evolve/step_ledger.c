/* SPDX-License-Identifier: BSD-3-Clause */
/* The ledger of a step (step_ledger.h). */
#include "evolve/step_ledger.h"

#include <math.h>

#include "evolve/bodies.h"
#include "evolve/moving_ground.h"
#include "evolve/points.h"
#include "evolve/soft_point.h"

/* The pose of a body before the step in time. */
static CpsiPose pose_before(const CpsiBody *body) {
    return (CpsiPose){body->inertia.before.place, body->inertia.before.turn};
}

/* The way of a point in the step. */
static Vec3 way_of_point(const CpsEvolution *evolution, int index) {
    const CpsPoint *given = &evolution->points.given[index];
    const CpsiPoint *point = &evolution->points.point[index];
    if (given->kind != CPS_POINT_KIND_ON_BODY)
        return vec3_sub(vec3_load(point->position), vec3_load(point->before));
    const CpsiBody *body = &evolution->bodies.body[given->body];
    const CpsiPose from = pose_before(body);
    return vec3_sub(cpsi_pose_place(&body->pose, given->position),
                    cpsi_pose_place(&from, given->position));
}

void cpsi_coupling_ledger(CpsEvolution *evolution) {
    for (int i = 0; i < evolution->line_count; i++) {
        CpsiLine *line = &evolution->line[i];
        if (line->has_inertia) continue;
        double lost = 0;
        for (int end = 0; end < 2; end++) {
            const int point = evolution->points.tie[2 * i + end];
            const CpsEndReport *report = &line->report.end[end];
            if (point == CPSI_NO_POINT || !(evolution->interval > 0)) continue;
            lost +=
                vec3_dot(vec3_load(report->force), way_of_point(evolution, point)) - report->work;
        }
        line->inertia.ledger = (CpsMotionLedger){.scheme = lost, .turnover = fabs(lost)};
    }
}

/* [J] The work that an obstacle which turns or moves does on a point that touches it. */
static double work_on_point(const CpsEvolution *evolution, const CpsiPoint *point) {
    const CpsPointReport *report = &point->report;
    return vec3_dot(cpsi_ground_way(evolution, report->obstacle, vec3_load(point->position)),
                    vec3_axpy(report->reaction, vec3_load(report->normal),
                              vec3_load(report->friction)));
}

/* [J] of load, weight and buoyancy on a point, by the energy of the latter, or of what holds it
 * beside an obstacle that moves. */
static double work_outside(const CpsEvolution *evolution, int index) {
    const CpsiPoint *point = &evolution->points.point[index];
    const CpsPointReport *report = &point->report;
    Vec3 force = vec3(0, 0, 0);
    double afloat = 0;
    if (point->kind == CPS_POINT_KIND_FREE) {
        force = vec3_load(report->load);
        afloat = point->inertia.afloat;
    }
    if (point->kind == CPS_POINT_KIND_HELD)
        force = vec3_axpy(report->reaction, vec3_load(report->normal), vec3_load(report->support));
    const double work = vec3_dot(force, way_of_point(evolution, index)) - afloat;
    return point->kind == CPS_POINT_KIND_HELD ? work - work_on_point(evolution, point) : work;
}

/* [J] of load, weight and water on a body, and of what holds it. */
static double work_on_body(const CpsEvolution *evolution, const CpsiBody *body) {
    const CpsiPose from = pose_before(body), *to = &body->pose;
    const double *centre[2] = {body->given.centre_of_gravity, body->given.centre_of_buoyancy};
    const Vec3 g = vec3_load(evolution->gravity), way = vec3_sub(to->place, from.place),
               turn = rotation_vector(rotation_after(to->turn, rotation_inverse(from.turn)));
    double work = cpsi_body_water_energy(body, &from) - cpsi_body_water_energy(body, to);
    for (int k = 0; k < 2; k++)
        work += (k == 0 ? body->mass : -body->lift) *
                vec3_dot(g, vec3_sub(cpsi_pose_place(to, centre[k]),
                                     cpsi_pose_place(&from, centre[k])));
    const double *support = body->report.support;
    const Vec3 force = vec3_add(body->load.force, body->waves.force),
               moment = vec3_add(body->load.moment, body->waves.moment);
    work += vec3_dot(vec3_add(force, vec3_load(support)), way);
    return work + vec3_dot(vec3_add(moment, vec3_load(&support[3])), turn);
}

/* Friction of the points, and the work of the obstacles under them. */
static double add_points(const CpsEvolution *evolution, CpsStepReport *step) {
    double pushed = 0;
    for (int i = 0; i < evolution->points.count; i++) {
        const CpsPointReport *report = &evolution->points.point[i].report;
        step->dissipated += report->dissipated;
        step->ledger.dissipated += report->dissipated;
        pushed += work_on_point(evolution, &evolution->points.point[i]);
    }
    step->ledger.obstacles += pushed;
    return pushed;
}

/* [J] What obstacles that give have stored more under points. */
static double stored_below(const CpsEvolution *evolution) {
    double sum = 0;
    for (int i = 0; i < evolution->points.count; i++)
        sum += cpsi_soft_point_growth(evolution, i, vec3_load(evolution->points.point[i].position));
    return sum;
}

/* [J] What lines at points get of these; they keep it, and what the scheme loses. */
static double work_inside(const CpsEvolution *evolution) {
    double sum = 0;
    for (int k = 0; k < 2 * evolution->line_count; k++)
        if (evolution->points.tie[k] != CPSI_NO_POINT)
            sum += evolution->line[k / 2].report.end[k % 2].work;
    return sum;
}

static double spent_by(const CpsMotionLedger *ledger) {
    return ledger->kinetic + ledger->impact + ledger->scheme + ledger->damping;
}

static void add_in_time(const CpsEvolution *evolution, double pushed, CpsStepReport *step) {
    double outside = 0, spent = 0, water = 0;
    for (int i = 0; i < evolution->line_count; i++)
        if (!evolution->line[i].has_inertia) spent += spent_by(&evolution->line[i].inertia.ledger);
    for (int i = 0; i < evolution->points.count; i++) {
        const CpsiPoint *point = &evolution->points.point[i];
        outside += work_outside(evolution, i);
        spent += point->report.dissipated + spent_by(&point->inertia.ledger);
        water += point->inertia.ledger.waves;
    }
    for (int i = 0; i < evolution->bodies.count; i++) {
        const CpsiBody *body = &evolution->bodies.body[i];
        const double damped = body->inertia.dissipated;
        outside += work_on_body(evolution, body);
        spent += damped + spent_by(&body->inertia.ledger);
        water += body->inertia.ledger.waves - body->inertia.ledger.drag;
        step->dissipated += damped;
        step->ledger.dissipated += damped;
    }
    const double more = outside - work_inside(evolution);
    step->ledger.ends += more;
    step->ledger.imbalance += more + pushed + water - spent;
}

void cpsi_step_ledger(const CpsEvolution *evolution, CpsStepReport *step) {
    const double dissipated = step->ledger.dissipated;
    const double pushed = add_points(evolution, step), stored = stored_below(evolution);
    step->ledger.elastic += stored;
    if (evolution->interval > 0)
        add_in_time(evolution, pushed - stored, step);
    else /* the forces at points do the work of their friction, and what is stored */
        step->ledger.ends += step->ledger.dissipated - dissipated - pushed + stored;
}
