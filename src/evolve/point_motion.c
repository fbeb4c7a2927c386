/* SPDX-License-Identifier: BSD-3-Clause */
/* Points in time (point_motion.h). */
#include "evolve/point_motion.h"

#include <math.h>
#include <string.h>

#include "evolve/bodies.h"
#include "evolve/moving_ground.h"
#include "evolve/pace.h"
#include "evolve/points.h"
#include "evolve/soft_point.h"
#include "evolve/water.h"

/* The end of a line with inertia that is at a point. */
typedef struct LineEnd {
    CpsiInertia *inertia;
    int node;
    CpsiPoint *point;
} LineEnd;

/* LineEnd number k = 0 .. 2 lines - 1; false: it is no such end. */
static bool take_end(CpsEvolution *evolution, int k, LineEnd *out) {
    CpsiLine *line = &evolution->line[k / 2];
    const int point = evolution->points.tie[k];
    if (point == CPSI_NO_POINT || !line->has_inertia) return false;
    *out = (LineEnd){&line->inertia, k % 2 == CPS_END_A ? 0 : line->n - 1,
                     &evolution->points.point[point]};
    return true;
}

/* The velocity with which a point begins. */
static Vec3 first_velocity(const CpsEvolution *evolution, int index) {
    const CpsPoint *given = &evolution->points.given[index];
    if (given->kind == CPS_POINT_KIND_FREE) return vec3_load(given->velocity);
    if (given->kind != CPS_POINT_KIND_ON_BODY) return vec3(0, 0, 0);
    const CpsiBody *body = &evolution->bodies.body[given->body];
    const CpsiBodyPhase *now = &body->inertia.now;
    const Vec3 arm = cpsi_pose_arm(&body->pose, given->position);
    return vec3_add(now->velocity, vec3_cross(now->rate, arm));
}

static double kinetic_energy(double mass, const double v[3]) {
    return 0.5 * mass * vec3_dot(vec3_load(v), vec3_load(v));
}

void cpsi_point_motion_start(CpsEvolution *evolution) {
    for (int i = 0; i < evolution->points.count; i++) {
        CpsiPoint *point = &evolution->points.point[i];
        CpsiPointInertia *inertia = &point->inertia;
        inertia->mass = evolution->points.given[i].inertia;
        inertia->restarts = true;
        vec3_store(inertia->velocity, first_velocity(evolution, i));
        memcpy(inertia->before, point->position, sizeof inertia->before);
        inertia->kinetic = kinetic_energy(inertia->mass, inertia->velocity);
    }
    LineEnd end;
    for (int k = 0; k < 2 * evolution->line_count; k++) {
        if (!take_end(evolution, k, &end)) continue;
        const double *v = end.point->inertia.velocity;
        memcpy(&end.inertia->velocity[3 * end.node], v, 3 * sizeof *v);
        end.inertia->kinetic += kinetic_energy(end.inertia->mass[end.node], v);
    }
}

/* Does a node of a line that moves in time take an Euler step next? */
static bool any_restarts(const CpsiLine *line) {
    if (!line->has_inertia) return false;
    for (int j = 0; j < line->n; j++)
        if (line->inertia.restarts[j]) return true;
    return false;
}

/* Does a line belong to a group, or to any? */
static bool is_of(const CpsEvolution *evolution, int line, int group) {
    return group == CPSI_ALL_GROUPS || cpsi_group_of_line(&evolution->points, line) == group;
}

/* Where ground moves, its way in k is one for all nodes of a line (time_step.c), and so for all
 * lines and points of a group. */
static void join_groups(CpsEvolution *evolution, int only) {
    CpsiPoint *point = evolution->points.point;
    const int *group = evolution->points.group;
    for (int i = 0; i < evolution->points.count; i++)
        if (group[i] != CPSI_NO_POINT && point[i].inertia.restarts)
            point[group[i]].inertia.restarts = true;
    for (int i = 0; i < evolution->line_count; i++) {
        const int of = cpsi_group_of_line(&evolution->points, i);
        if (of != CPSI_NO_POINT && is_of(evolution, i, only) && any_restarts(&evolution->line[i]))
            point[of].inertia.restarts = true;
    }
    LineEnd end;
    for (int k = 0; k < 2 * evolution->line_count; k++) {
        const int at = evolution->points.tie[k];
        if (!is_of(evolution, k / 2, only) || !take_end(evolution, k, &end) ||
            group[at] == CPSI_NO_POINT)
            continue;
        end.point->inertia.restarts = end.inertia->restarts[end.node] =
            point[group[at]].inertia.restarts;
    }
}

void cpsi_point_motion_join(CpsEvolution *evolution, int group) {
    LineEnd end;
    for (int k = 0; k < 2 * evolution->line_count; k++)
        if (is_of(evolution, k / 2, group) && take_end(evolution, k, &end) &&
            end.inertia->restarts[end.node])
            end.point->inertia.restarts = true;
    for (int k = 0; k < 2 * evolution->line_count; k++)
        if (is_of(evolution, k / 2, group) && take_end(evolution, k, &end))
            end.inertia->restarts[end.node] = end.point->inertia.restarts;
    if (cpsi_ground_moves(evolution)) join_groups(evolution, group);
}

void cpsi_point_motion_predict(CpsEvolution *evolution) {
    const CpsiFormula *formula = &evolution->formula;
    for (int i = 0; i < evolution->points.count; i++) {
        CpsiPoint *point = &evolution->points.point[i];
        CpsiPointInertia *inertia = &point->inertia;
        const bool euler = evolution->time_scheme == CPS_TIME_SCHEME_EULER || evolution->restarts ||
                           inertia->restarts;
        inertia->is_moving = true;
        inertia->span = euler ? formula->length : formula->span;
        for (int a = 0; a < 3; a++) {
            const double x = point->before[a], v = inertia->velocity[a];
            inertia->reference[a] = euler ? x : x + formula->back * (x - inertia->before[a]);
            inertia->rest_velocity[a] =
                euler ? v : v + formula->back * (v - inertia->before_velocity[a]);
            if (inertia->velocity_given) /* from there it leads to where the point is held */
                inertia->reference[a] =
                    point->position[a] - inertia->span * inertia->given_velocity[a];
        }
    }
}

Vec3 cpsi_point_inertia(const CpsiPoint *point, Vec3 place) {
    const CpsiPointInertia *inertia = &point->inertia;
    if (!(inertia->mass > 0)) return vec3(0, 0, 0);
    const Vec3 velocity =
        vec3_scale(1 / inertia->span, vec3_sub(place, vec3_load(inertia->reference)));
    return vec3_scale(-inertia->mass / inertia->span,
                      vec3_sub(velocity, vec3_load(inertia->rest_velocity)));
}

double cpsi_point_inertia_stiffness(const CpsiPoint *point) {
    return point->inertia.mass / (point->inertia.span * point->inertia.span);
}

static bool bears_now(const CpsiPoint *point) {
    return point->kind == CPS_POINT_KIND_FREE && point->report.reaction > 0;
}

/* Does it bear on what is rigid? What gives slows a point down by its force alone. */
static bool stops(const CpsEvolution *evolution, const CpsiPoint *point) {
    return bears_now(point) && !(evolution->obstacle[point->report.obstacle].stiffness > 0);
}

/* Give v the part `rate` along the unit vector n. */
static void stop_along(double v[3], Vec3 n, double rate) {
    vec3_store(v, vec3_axpy(rate - vec3_dot(vec3_load(v), n), n, vec3_load(v)));
}

/* The energy of the part of v along n, beside ground of the velocity `ground`, where it goes
 * against n. */
static double energy_of_landing(double mass, const double v[3], Vec3 n, double ground) {
    const double rate = fmin(0, vec3_dot(vec3_load(v), n) - ground);
    return 0.5 * mass * rate * rate;
}

double cpsi_point_loss(CpsEvolution *evolution, int index, Vec3 place, int on, double reaction,
                       Vec3 normal) {
    const CpsiPoint *point = &evolution->points.point[index];
    const CpsiPointInertia *inertia = &point->inertia;
    const double rate = 1 / inertia->span,
                 damped = cpsi_soft_point_damped(evolution, index, place, reaction);
    const Vec3 way = vec3_sub(place, vec3_load(point->before)),
               slip = vec3_sub(way, cpsi_ground_way(evolution, on, place)),
               v0 = vec3_load(inertia->velocity),
               v = vec3_scale(rate, vec3_sub(place, vec3_load(inertia->reference))),
               acceleration = vec3_scale(rate, vec3_sub(v, vec3_load(inertia->rest_velocity)));
    double mass = inertia->mass;
    LineEnd end;
    for (int k = 0; k < 2 * evolution->line_count; k++)
        if (take_end(evolution, k, &end) && end.point == point) mass += end.inertia->mass[end.node];
    return mass * (vec3_dot(acceleration, way) - 0.5 * vec3_dot(vec3_sub(v, v0), vec3_add(v, v0))) -
           cpsi_soft_point_growth(evolution, index, place) - reaction * vec3_dot(normal, slip) -
           fmax(0, damped);
}

/* What the water does to it: the energy of the buoyancy, what the scheme loses of that, which is
 * not negative since the energy is convex, and what the surface does as it rises. */
static void add_water(CpsiPoint *point) {
    CpsiPointInertia *inertia = &point->inertia;
    const CpsPointReport *report = &point->report;
    const double height = cpsi_surface_height(&point->surface, vec3_load(point->position)),
                 sunk = cpsi_surface_height(&point->surface, vec3_load(point->before)),
                 before = point->height_before;
    inertia->afloat = cpsi_water_energy(report->displaced, point->extent, height) -
                      cpsi_water_energy(report->displaced, point->extent, before);
    inertia->ledger.scheme -= report->buoyancy * (height - before) + inertia->afloat;
    inertia->ledger.waves = report->buoyancy * (before - sunk);
}

/* The ledger of the step, by the values after it, before what bears is stopped. */
static void close_ledger(const CpsEvolution *evolution, int index, const double velocity[3]) {
    CpsiPoint *point = &evolution->points.point[index];
    CpsiPointInertia *inertia = &point->inertia;
    CpsPointReport *report = &point->report;
    const Vec3 place = vec3_load(point->position), n = vec3_load(report->normal),
               way = vec3_sub(place, vec3_load(point->before)),
               slip = vec3_sub(way, cpsi_ground_way(evolution, report->obstacle, place));
    const double gained = kinetic_energy(inertia->mass, velocity) - inertia->kinetic;
    CpsMotionLedger *ledger = &inertia->ledger;
    const double stored = cpsi_soft_point_growth(evolution, index, place),
                 damped = cpsi_soft_point_damped(evolution, index, place, report->reaction);
    *ledger = (CpsMotionLedger){.kinetic = gained, .damping = damped};
    ledger->scheme = -vec3_dot(vec3_load(report->inertia), way) - gained - stored - ledger->damping;
    ledger->turnover = fabs(stored);
    add_water(point);
    report->dissipated = 0;
    if (bears_now(point)) {
        report->dissipated = -vec3_dot(vec3_load(report->friction), slip);
        ledger->scheme -= report->reaction * vec3_dot(n, slip);
        if (inertia->landed && stops(evolution, point))
            ledger->impact = energy_of_landing(inertia->mass, inertia->velocity, n,
                                               cpsi_ground_rate(evolution, point));
        ledger->scheme -= ledger->impact;
    }
}

static void add_turnover(const CpsPointReport *report, CpsMotionLedger *ledger) {
    ledger->turnover += fabs(report->dissipated) + fabs(ledger->kinetic) + fabs(ledger->impact) +
                        fabs(ledger->scheme) + fabs(ledger->damping) + fabs(ledger->waves);
}

/* The end of a line follows its point; where that bears, and has been stopped along the normal, the
 * line loses the energy. */
static void follow(const CpsEvolution *evolution, const LineEnd *end) {
    const CpsiPointInertia *inertia = &end->point->inertia;
    CpsiInertia *of = end->inertia;
    const double mass = of->mass[end->node];
    /* a line at a held point may have taken this step as another one than the point */
    if (of->span[end->node] != inertia->span) return;
    const Vec3 n = vec3_load(end->point->report.normal);
    double *v = &of->velocity[3 * end->node], *v0 = &of->before_velocity[3 * end->node];
    if (stops(evolution, end->point)) {
        const double rate = cpsi_ground_rate(evolution, end->point),
                     impact = inertia->landed ? energy_of_landing(mass, v0, n, rate) : 0,
                     lost = kinetic_energy(mass, v) - kinetic_energy(mass, inertia->velocity);
        of->kinetic -= lost;
        of->ledger.kinetic -= lost;
        of->ledger.scheme += lost - impact;
        of->ledger.impact += impact;
    }
    memcpy(v, inertia->velocity, sizeof inertia->velocity);
    memcpy(v0, inertia->before_velocity, sizeof inertia->before_velocity);
    memcpy(&of->before[3 * end->node], inertia->before, sizeof inertia->before);
    of->restarts[end->node] = of->restarts[end->node] || inertia->restarts;
}

/* [m] The error of a point that moves freely or with a body, along a normal 0. */
static double error_of(const CpsEvolution *evolution, const CpsiPoint *point, Vec3 normal,
                       const double velocity[3]) {
    const CpsiPointInertia *inertia = &point->inertia;
    const CpsiFormula *formula = &evolution->formula;
    if (point->kind == CPS_POINT_KIND_HELD) return 0;
    const Vec3 off = cpsi_step_error(formula, inertia->span == formula->length,
                                     vec3_load(inertia->before_velocity),
                                     vec3_load(inertia->velocity), vec3_load(velocity));
    return vec3_norm(vec3_reject(off, normal));
}

void cpsi_point_motion_advance(CpsEvolution *evolution) {
    for (int i = 0; i < evolution->points.count; i++) {
        CpsiPoint *point = &evolution->points.point[i];
        CpsiPointInertia *inertia = &point->inertia;
        const CpsPointReport *report = &point->report;
        const bool bears = bears_now(point), stopped = stops(evolution, point);
        const Vec3 n = vec3_load(report->normal);
        double velocity[3];
        for (int a = 0; a < 3; a++)
            velocity[a] = (point->position[a] - inertia->reference[a]) / inertia->span;
        inertia->landed = bears && !inertia->bore;
        inertia->error = error_of(evolution, point, stopped ? n : vec3(0, 0, 0), velocity);
        close_ledger(evolution, i, velocity);
        memcpy(inertia->before, point->before, sizeof inertia->before);
        memcpy(inertia->before_velocity, inertia->velocity, sizeof inertia->before_velocity);
        memcpy(inertia->velocity, velocity, sizeof velocity);
        const double had = inertia->kinetic;
        inertia->kinetic = kinetic_energy(inertia->mass, velocity);
        if (stopped) {
            const Vec3 way = vec3_sub(vec3_load(point->position), vec3_load(point->before));
            const double rate = cpsi_ground_rate(evolution, point),
                         off = vec3_dot(way, n) - evolution->formula.length * rate;
            vec3_store(inertia->before, vec3_axpy(off, n, vec3_load(point->before)));
            stop_along(inertia->velocity, n, rate);
            stop_along(inertia->before_velocity, n, rate);
            const double now = kinetic_energy(inertia->mass, inertia->velocity),
                         lost = inertia->kinetic - now;
            inertia->kinetic = now;
            inertia->ledger.kinetic = now - had; /* which may be far less than what is lost */
            inertia->ledger.scheme += lost;
        }
        add_turnover(report, &inertia->ledger);
        inertia->bore = bears;
        inertia->restarts = inertia->landed || inertia->crossed ||
                            cpsi_soft_point_is_crossed(evolution, i, vec3_load(point->position));
    }
    LineEnd end;
    for (int k = 0; k < 2 * evolution->line_count; k++)
        if (take_end(evolution, k, &end)) follow(evolution, &end);
}

void cpsi_point_motion_stop(CpsEvolution *evolution) {
    for (int i = 0; i < evolution->points.count; i++) {
        CpsiPoint *point = &evolution->points.point[i];
        const double mass = point->inertia.mass, lost = point->inertia.kinetic;
        point->inertia = (CpsiPointInertia){.mass = mass,
                                            .restarts = true,
                                            .bore = bears_now(point),
                                            .ledger = {.kinetic = 0 - lost,
                                                       .settling = lost,
                                                       .turnover = 2 * lost}};
        memcpy(point->inertia.before, point->position, sizeof point->inertia.before);
    }
}
