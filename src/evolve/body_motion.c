/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies in time (body_motion.h). */
#include "evolve/body_motion.h"

#include <math.h>

#include "evolve/bodies.h"
#include "evolve/members.h"
#include "evolve/pace.h"
#include "evolve/points.h"

/* [rad] Below this angle the series of the rate of rotation is used: its error is the fourth
 * power. */
static const double SMALL = 1e-3;

/* w of the rotation vector t and its rate. */
static Vec3 rate_of(Vec3 t, Vec3 rate) {
    const double square = vec3_dot(t, t), size = sqrt(square);
    const double once = size > SMALL ? (1 - cos(size)) / square : 0.5 - square / 24,
                 twice =
                     size > SMALL ? (size - sin(size)) / (size * square) : 1.0 / 6 - square / 120;
    const Vec3 turned = vec3_cross(t, rate);
    return vec3_axpy(twice, vec3_cross(t, turned), vec3_axpy(once, turned, rate));
}

/* The rate of the rotation vector t at which the rate of rotation is w: V(t)^-1 w. */
static Vec3 rate_to_turn(Vec3 t, Vec3 w) {
    const double square = vec3_dot(t, t), size = sqrt(square);
    const double twice = size > SMALL
                             ? (1 - 0.5 * size * cos(0.5 * size) / sin(0.5 * size)) / square
                             : 1.0 / 12 + square / 720;
    const Vec3 turned = vec3_cross(t, w);
    return vec3_axpy(twice, vec3_cross(t, turned), vec3_axpy(-0.5, turned, w));
}

/* J w about the centre of gravity, J in the axes of the body. */
static Vec3 angular_momentum(const CpsBody *given, Rotation turn, Vec3 rate) {
    const double *j = given->inertia;
    const Vec3 w = rotation_apply(rotation_inverse(turn), rate);
    const Vec3 l = vec3(j[0] * w.x + j[3] * w.y + j[4] * w.z, j[3] * w.x + j[1] * w.y + j[5] * w.z,
                        j[4] * w.x + j[5] * w.y + j[2] * w.z);
    return rotation_apply(turn, l);
}

/* u in the axes of the body: velocity of the reference point and rate of rotation. */
static void to_body(const CpsiBodyPhase *at, double u[6]) {
    const Rotation back = rotation_inverse(at->turn);
    vec3_store(u, rotation_apply(back, at->velocity));
    vec3_store(&u[3], rotation_apply(back, at->rate));
}

/* Find the momenta of velocities. */
static void find_momenta(const CpsBody *given, CpsiBodyPhase *at) {
    double u[6], p[6] = {0};
    to_body(at, u);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 6; k++) p[i] += given->added_mass[6 * i + k] * u[k];
    at->angular = angular_momentum(given, at->turn, at->rate);
    at->water = rotation_apply(at->turn, vec3_load(p));
    at->water_angular = rotation_apply(at->turn, vec3_load(&p[3]));
}

static double kinetic_energy(const CpsBody *given, const CpsiBodyPhase *at) {
    return 0.5 * (given->mass * vec3_dot(at->centre_velocity, at->centre_velocity) +
                  vec3_dot(at->angular, at->rate) + vec3_dot(at->water, at->velocity) +
                  vec3_dot(at->water_angular, at->rate));
}

static Vec3 centre_of(const CpsBody *given, const CpsiPose *pose) {
    return cpsi_pose_place(pose, given->centre_of_gravity);
}

/* A body at rest in its pose. */
static CpsiBodyPhase at_rest(const CpsiBody *body) {
    return (CpsiBodyPhase){.place = body->pose.place,
                           .centre = centre_of(&body->given, &body->pose),
                           .turn = body->pose.turn};
}

void cpsi_body_motion_layout(CpsEvolution *evolution, CpsiArena *arena, const CpsScene *scene) {
    size_t numbers = 0;
    for (int i = 0; i < scene->body_count; i++) numbers += cpsi_radiation_size(&scene->body[i]);
    CPSI_PLACE(arena, evolution->radiation, numbers);
}

void cpsi_body_motion_fill(CpsEvolution *evolution) {
    double *next = evolution->radiation;
    for (int i = 0; i < evolution->bodies.count; i++) {
        CpsiBody *body = &evolution->bodies.body[i];
        body->radiation = cpsi_radiation_of(&body->given, next);
        next += cpsi_radiation_size(&body->given);
        body->given.radiation = NULL; /* the caller's */
    }
}

void cpsi_body_motion_start(CpsEvolution *evolution) {
    for (int i = 0; i < evolution->bodies.count; i++) {
        CpsiBody *body = &evolution->bodies.body[i];
        const double *v = body->given.velocity;
        CpsiBodyPhase *now = &body->inertia.now;
        *now = at_rest(body);
        body->inertia.restarts = true;
        if (body->kind == CPS_BODY_KIND_FREE) {
            now->velocity = vec3_load(v);
            now->rate = vec3_load(&v[3]);
        }
        now->centre_velocity =
            vec3_add(now->velocity, vec3_cross(now->rate, vec3_sub(now->centre, now->place)));
        find_momenta(&body->given, now);
        body->inertia.kinetic = kinetic_energy(&body->given, now);
    }
}

/* With a given velocity x* and t* are those from which it leads to the pose in which the body is
 * held. */
static void lead(CpsiBody *body) {
    CpsiBodyPhase *rest = &body->inertia.rest;
    const Vec3 u = body->inertia.given_velocity, w = body->inertia.given_rate,
               centre = centre_of(&body->given, &body->pose),
               around = vec3_cross(w, vec3_sub(centre, body->pose.place)),
               t = rotation_vector(rotation_after(body->pose.turn, rotation_inverse(rest->turn)));
    const double span = body->inertia.span;
    rest->place = vec3_axpy(-span, u, body->pose.place);
    rest->centre = vec3_axpy(-span, vec3_add(u, around), centre);
    rest->rate = vec3_axpy(-span, rate_to_turn(t, w), t);
}

/* a + back (a - b) */
static Vec3 star(double back, Vec3 a, Vec3 b) {
    return back > 0 ? vec3_axpy(back, vec3_sub(a, b), a) : a;
}

/* Did a body that is free now move in a fixed direction as it was held? It is stopped in that
 * direction by two Euler steps: the next formula of second order speaks of what has stopped. */
static bool is_stopped(const CpsiBody *body) {
    const CpsiBodyPhase *phase[] = {&body->inertia.now, &body->inertia.before};
    const bool held[] = {body->inertia.held_now, body->inertia.held_before};
    if (body->kind != CPS_BODY_KIND_FREE) return false;
    for (int i = 0; i < 2; i++) {
        double v[6];
        if (!held[i]) continue;
        vec3_store(v, phase[i]->velocity);
        vec3_store(&v[3], phase[i]->rate);
        for (int a = 0; a < 6; a++)
            if (body->given.fixed[a] && v[a] != 0) return true;
    }
    return false;
}

void cpsi_body_motion_predict(CpsEvolution *evolution) {
    const CpsiFormula *formula = &evolution->formula;
    for (int i = 0; i < evolution->bodies.count; i++) {
        CpsiBodyInertia *inertia = &evolution->bodies.body[i].inertia;
        const CpsiBodyPhase *a = &inertia->now, *b = &inertia->before;
        const bool euler = evolution->time_scheme == CPS_TIME_SCHEME_EULER || evolution->restarts ||
                           inertia->restarts || is_stopped(&evolution->bodies.body[i]);
        const double by = euler ? 0 : formula->back;
        const Vec3 back = euler
                              ? vec3(0, 0, 0)
                              : rotation_vector(rotation_after(b->turn, rotation_inverse(a->turn)));
        inertia->is_moving = true;
        inertia->span = euler ? formula->length : formula->span;
        inertia->rest =
            (CpsiBodyPhase){.place = star(by, a->place, b->place),
                            .centre = star(by, a->centre, b->centre),
                            .turn = a->turn,
                            .velocity = star(by, a->velocity, b->velocity),
                            .centre_velocity = star(by, a->centre_velocity, b->centre_velocity),
                            .rate = vec3_scale(-by, back),
                            .angular = star(by, a->angular, b->angular),
                            .water = star(by, a->water, b->water),
                            .water_angular = star(by, a->water_angular, b->water_angular)};
        if (inertia->velocity_given) lead(&evolution->bodies.body[i]);
        double u[6];
        to_body(a, u);
        cpsi_radiation_begin(&evolution->bodies.body[i].radiation, evolution->time, formula->length,
                             u);
    }
}

/* The phase after the step in a pose. */
static CpsiBodyPhase phase_in(const CpsiBody *body, const CpsiPose *pose) {
    const CpsiBodyInertia *inertia = &body->inertia;
    const CpsiBodyPhase *rest = &inertia->rest;
    const double by = 1 / inertia->span;
    const Vec3 t = rotation_vector(rotation_after(pose->turn, rotation_inverse(rest->turn)));
    CpsiBodyPhase out = {.place = pose->place,
                         .centre = centre_of(&body->given, pose),
                         .turn = pose->turn,
                         .rate = rate_of(t, vec3_scale(by, vec3_sub(t, rest->rate)))};
    out.velocity = vec3_scale(by, vec3_sub(out.place, rest->place));
    out.centre_velocity = vec3_scale(by, vec3_sub(out.centre, rest->centre));
    find_momenta(&body->given, &out);
    return out;
}

CpsiPose cpsi_body_motion_guess(const CpsiBody *body) {
    const CpsiBodyInertia *inertia = &body->inertia;
    const CpsiBodyPhase *now = &inertia->now, *rest = &inertia->rest;
    double to[3], turn[3], from[3];
    vec3_store(to, vec3_axpy(inertia->span, rest->velocity, rest->place));
    vec3_store(turn, vec3_axpy(inertia->span, now->rate, rest->rate));
    vec3_store(from, now->place);
    const bool is_free = body->kind == CPS_BODY_KIND_FREE;
    for (int a = 0; a < 3; a++) {
        if (is_free && body->given.fixed[a]) to[a] = from[a];
        if (is_free && body->given.fixed[3 + a]) turn[a] = 0;
    }
    return (CpsiPose){vec3_load(to), rotation_after(rotation_of(vec3_load(turn)), now->turn)};
}

/* Of the momenta of a phase and of the scheme, minus their rates. */
static CpsiWrench inertia_of(const CpsiBody *body, const CpsiBodyPhase *at) {
    const CpsiBodyPhase *rest = &body->inertia.rest;
    const double by = -1 / body->inertia.span;
    const Vec3 mass = vec3_scale(by * body->given.mass,
                                 vec3_sub(at->centre_velocity, rest->centre_velocity)),
               water = vec3_scale(by, vec3_sub(at->water, rest->water)),
               spin = vec3_scale(by, vec3_sub(at->angular, rest->angular)),
               water_spin = vec3_scale(by, vec3_sub(at->water_angular, rest->water_angular));
    const Vec3 arm = vec3_sub(at->centre, at->place);
    Vec3 moment = vec3_add(vec3_add(spin, water_spin), vec3_cross(arm, mass));
    moment = vec3_sub(moment, vec3_cross(at->velocity, at->water));
    return (CpsiWrench){vec3_add(mass, water), moment};
}

/* A force and a moment in the axes of the body. */
static CpsiWrench from_body(const CpsiBodyPhase *at, const double f[6]) {
    return (CpsiWrench){rotation_apply(at->turn, vec3_load(f)),
                        rotation_apply(at->turn, vec3_load(&f[3]))};
}

static CpsiWrench damping_of(const CpsiBody *body, const CpsiBodyPhase *at) {
    const CpsBody *given = &body->given;
    double u[6], f[6] = {0};
    to_body(at, u);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 6; k++)
            f[i] -= (given->damping[6 * i + k] + given->quadratic_damping[6 * i + k] * fabs(u[k])) *
                    u[k];
    return from_body(at, f);
}

CpsiWrench cpsi_body_inertia(const CpsiBody *body, const CpsiPose *pose) {
    const CpsiBodyPhase at = phase_in(body, pose);
    return inertia_of(body, &at);
}

CpsiWrench cpsi_body_damping(const CpsiBody *body, const CpsiPose *pose) {
    const CpsiBodyPhase at = phase_in(body, pose);
    return damping_of(body, &at);
}

static CpsiWrench sum_of(CpsiWrench a, CpsiWrench b) {
    return (CpsiWrench){vec3_add(a.force, b.force), vec3_add(a.moment, b.moment)};
}

/* Of the waves that the body has made. */
static CpsiWrench radiation_of(const CpsiBody *body, const CpsiBodyPhase *at) {
    double u[6], f[6] = {0};
    to_body(at, u);
    cpsi_radiation_add(&body->radiation, u, f);
    return from_body(at, f);
}

/* The water on members and that of radiation, in a step in time. */
static CpsiMemberLoad moving_water(const CpsiBody *body, const CpsiPose *pose,
                                   const CpsiBodyPhase *at) {
    CpsiMemberLoad out = cpsi_members_load(body, pose, at);
    if (body->radiation.rows > 0) out.drag = sum_of(out.drag, radiation_of(body, at));
    return out;
}

/* Inertia, damping and this water together. */
static CpsiWrench resistance_in(const CpsiBody *body, const CpsiPose *pose) {
    const CpsiBodyPhase at = phase_in(body, pose);
    const CpsiMemberLoad water = moving_water(body, pose, &at);
    return sum_of(sum_of(inertia_of(body, &at), damping_of(body, &at)),
                  sum_of(water.drag, water.waves));
}

void cpsi_body_motion_stiffness(const CpsiBody *body, const CpsiPose *pose, double stiffness[36]) {
    cpsi_body_add_stiffness_of(resistance_in, body, pose, stiffness);
}

CpsiWrench cpsi_body_whole_load(const CpsEvolution *evolution, const CpsiBody *body,
                                const CpsiPose *pose) {
    const CpsiWrench load = cpsi_body_load(body, pose, evolution->gravity);
    if (body->member_count == 0 && body->radiation.rows == 0) return load;
    if (!(evolution->interval > 0)) return sum_of(load, cpsi_members_load(body, pose, NULL).drag);
    const CpsiBodyPhase at = phase_in(body, pose);
    const CpsiMemberLoad water = moving_water(body, pose, &at);
    return sum_of(load, sum_of(water.drag, water.waves));
}

void cpsi_body_whole_stiffness(const CpsEvolution *evolution, const CpsiBody *body,
                               const CpsiPose *pose, double stiffness[36]) {
    cpsi_body_stiffness(body, pose, evolution->gravity, stiffness);
    if (!(evolution->interval > 0)) cpsi_members_stiffness(body, pose, stiffness);
}

/* ledger --------------------------------------------------------------------------------------- */

/* [J] Of a force and a moment on a motion. */
static double work_of(CpsiWrench wrench, const double motion[6]) {
    return vec3_dot(wrench.force, vec3_load(motion)) +
           vec3_dot(wrench.moment, vec3_load(&motion[3]));
}

/* What forces do in the step by their values after it on the motion d and t, beyond what they do on
 * the way of the place at which they act: that place turns on a circle. */
static double beyond(Vec3 force, Vec3 arm, Rotation step) {
    const Vec3 t = rotation_vector(step), before = rotation_apply(rotation_inverse(step), arm);
    return vec3_dot(force, vec3_sub(vec3_cross(t, arm), vec3_sub(arm, before)));
}

/* Beyond: lines, weight and buoyancy, and the water's stiffness, of which the energy is stored. */
static double beyond_all(const CpsEvolution *evolution, const CpsiBody *body, Rotation step,
                         const double motion[6]) {
    const CpsiPoints *points = &evolution->points;
    const Vec3 g = vec3_load(evolution->gravity);
    const CpsiPose from = {body->inertia.now.place, body->inertia.now.turn};
    double sum =
        beyond(vec3_scale(body->mass, g),
               rotation_apply(body->pose.turn, vec3_load(body->given.centre_of_gravity)), step) +
        beyond(vec3_scale(-body->lift, g),
               rotation_apply(body->pose.turn, vec3_load(body->given.centre_of_buoyancy)), step);
    for (int i = 0; i < 2 * evolution->line_count; i++) {
        const int point = points->tie[i];
        if (point == CPSI_NO_POINT) continue;
        const CpsPoint *given = &points->given[point];
        if (given->kind != CPS_POINT_KIND_ON_BODY || &evolution->bodies.body[given->body] != body)
            continue;
        const Vec3 pull = vec3_scale(-1, vec3_load(evolution->line[i / 2].report.end[i % 2].force));
        sum += beyond(pull, cpsi_pose_arm(&body->pose, given->position), step);
    }
    sum += work_of(cpsi_body_water(body, &body->pose), motion);
    return sum + cpsi_body_water_energy(body, &body->pose) - cpsi_body_water_energy(body, &from);
}

/* [m] The error of a free body: of its reference point and centre of gravity, and of its rotation
 * at the radius of gyration. */
static double error_of(const CpsEvolution *evolution, const CpsiBody *body,
                       const CpsiBodyPhase *next) {
    const CpsiBodyInertia *inertia = &body->inertia;
    const CpsiBodyPhase *before = &inertia->before, *now = &inertia->now;
    const CpsiFormula *formula = &evolution->formula;
    const double *moment = body->given.inertia;
    if (body->kind != CPS_BODY_KIND_FREE) return 0;
    const bool euler = inertia->span == formula->length;
    const double most = fmax(moment[0], fmax(moment[1], moment[2])),
                 radius = body->given.mass > 0 ? sqrt(most / body->given.mass) : 0;
    const Vec3 off[] = {
        cpsi_step_error(formula, euler, before->velocity, now->velocity, next->velocity),
        cpsi_step_error(formula, euler, before->centre_velocity, now->centre_velocity,
                        next->centre_velocity),
        vec3_scale(radius, cpsi_step_error(formula, euler, before->rate, now->rate, next->rate))};
    return fmax(vec3_norm(off[0]), fmax(vec3_norm(off[1]), vec3_norm(off[2])));
}

static void advance(const CpsEvolution *evolution, CpsiBody *body) {
    CpsiBodyInertia *inertia = &body->inertia;
    const CpsiBodyPhase at = phase_in(body, &body->pose);
    inertia->error = error_of(evolution, body, &at);
    const Rotation step = rotation_after(body->pose.turn, rotation_inverse(inertia->now.turn));
    const double kinetic = kinetic_energy(&body->given, &at);
    const CpsiMemberLoad water = moving_water(body, &body->pose, &at);
    double motion[6], work[2] = {0, 0}, before[6], after[6];
    vec3_store(motion, vec3_sub(at.place, inertia->now.place));
    vec3_store(&motion[3], rotation_vector(step));
    for (int i = 0; i < 6; i++) {
        work[0] -= body->report.inertia[i] * motion[i];
        work[1] -= body->report.damping[i] * motion[i];
    }
    CpsMotionLedger *ledger = &inertia->ledger;
    *ledger = (CpsMotionLedger){.kinetic = kinetic - inertia->kinetic,
                                .drag = -work_of(water.drag, motion),
                                .waves = work_of(water.waves, motion)};
    ledger->scheme = work[0] - ledger->kinetic - beyond_all(evolution, body, step, motion);
    inertia->dissipated = work[1];
    ledger->turnover = fabs(ledger->kinetic) + fabs(ledger->scheme) + fabs(work[1]) +
                       fabs(ledger->drag) + fabs(ledger->waves);
    inertia->kinetic = kinetic;
    to_body(&inertia->now, before);
    to_body(&at, after);
    cpsi_radiation_advance(&body->radiation, before, after);
    inertia->held_before = inertia->held_now;
    inertia->held_now = body->kind == CPS_BODY_KIND_HELD;
    inertia->before = inertia->now;
    inertia->now = at;
    inertia->restarts = false;
}

void cpsi_body_motion_advance(CpsEvolution *evolution) {
    for (int i = 0; i < evolution->bodies.count; i++)
        advance(evolution, &evolution->bodies.body[i]);
}

void cpsi_body_motion_stop(CpsEvolution *evolution) {
    for (int i = 0; i < evolution->bodies.count; i++) {
        CpsiBody *body = &evolution->bodies.body[i];
        const double lost = body->inertia.kinetic;
        cpsi_radiation_forget(&body->radiation);
        body->inertia = (CpsiBodyInertia){.restarts = true,
                                          .now = at_rest(body),
                                          .ledger = {.kinetic = 0 - lost,
                                                     .settling = lost,
                                                     .turnover = 2 * lost}};
    }
}
