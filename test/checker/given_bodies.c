/* SPDX-License-Identifier: BSD-3-Clause */
/* The bodies of a file beside their scene (given_bodies.h).
 *
 * A stage moves a held body from its present pose to that of the stage: its reference point along a
 * straight line, its rotation along the shorter great circle of unit quaternions, both evenly. On a
 * free body the load goes evenly from the present one to that of the stage. A free body that is
 * held begins in the pose it had reached; one that is let go, with the support that held it. */
#include "given_bodies.h"

#include <math.h>
#include <netcdf.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "bodies.h"
#include "body_ledger.h"
#include "body_stiffness.h"
#include "excitation.h"
#include "members.h"
#include "oscillation.h"
#include "radiation.h"
#include "ranges.h"
#include "turning.h"

/* Numbers that are copied; poses on their way; loads: sums of a few products, and the turning
 * moment of the water by differences. */
static const double COPIED = 1e-14, POSES = 1e-12, LOADS = 1e-11;
/* A stiffness, lengths in arms of the body, per its largest entry: rounding of places up to 1e4
 * lengths from the origin, which strains of stiff lines magnify, makes 1e-8 of it. */
static const double STIFFNESS = 1e-6;

/* A work, per the sizes of its terms. */
static const double WORKS = 1e-9;

/* Loads on members, per the sizes of their terms: rounding of places and of phases far from the
 * origin, and of velocities, which are places over k. */
static const double MEMBERS = 1e-9;

/* What the scene imposes on a body. */
typedef struct Imposed {
    int kind;
    double from_position[3], position[3], from_rotation[FOUR], rotation[FOUR];
    double from_load[SIX], load[SIX];
    double noise[SIX]; /* to what its oscillations so far are known */
} Imposed;

typedef struct Compare {
    const Source *source;
    const CpsScene *scene;
    Bodies bodies;
    Record *line;        /* (lines) of the step */
    BodyMotion *motion;  /* (bodies) of the step */
    RadiationPast *past; /* (bodies) before the step */
    GivenFinding *find;
    void *user;
    bool found;
} Compare;

__attribute__((format(printf, 2, 3))) static void find(Compare *c, const char *format, ...) {
    char sentence[300];
    va_list list;
    va_start(list, format);
    vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    c->found = true;
    c->find(c->user, sentence);
}

static double size(const double *v) { return hypot(hypot(v[0], v[1]), v[2]); }

/* numbers equal to within `noise`, else a finding */
static void same(Compare *c, const char *what, const char *of, const double *file,
                 const double *scene, size_t count, double noise) {
    for (size_t i = 0; i < count; i++)
        if (!(fabs(file[i] - scene[i]) <= noise)) {
            find(c, "%s of %s is %.17g, in the scene %.17g", what, of, file[i], scene[i]);
            return;
        }
}

static double largest(const double *v, size_t count) {
    double most = 0;
    for (size_t i = 0; i < count; i++) most = fmax(most, fabs(v[i]));
    return most;
}

static void same_constant(Compare *c, const char *what, const char *of, const double *file,
                          const double *scene, size_t count) {
    same(c, what, of, file, scene, count, COPIED * largest(scene, count));
}

static void unit(const double q[FOUR], double out[FOUR]) {
    const double length = hypot(hypot(q[0], q[1]), hypot(q[2], q[3]));
    for (int i = 0; i < FOUR; i++) out[i] = q[i] / length;
}

/* ---- numbers of the scene ---- */

static void compare_body(Compare *c, size_t k) {
    const CpsBody *body = &c->scene->body[k];
    const BodyData *data = &c->bodies.data[k];
    const char *name = body->name;
    double start[3];
    if (strcmp(data->name, name) != 0) {
        find(c, "body %s, in the scene %s", data->name, name);
        return;
    }
    if (data->kind != (body->kind == CPS_BODY_KIND_HELD ? BODY_HELD : BODY_FREE))
        find(c, "kind_of_body of %s", name);
    for (int i = 0; i < SIX; i++)
        if (data->fixed[i] != body->fixed[i]) find(c, "fixed_of_body of %s", name);
    same_constant(c, "weight_of_body", name, &data->weight, &body->weight, 1);
    same_constant(c, "buoyancy_of_body", name, &data->buoyancy, &body->buoyancy, 1);
    same_constant(c, "centre_of_gravity_of_body", name, data->centre_of_gravity,
                  body->centre_of_gravity, 3);
    same_constant(c, "centre_of_buoyancy_of_body", name, data->centre_of_buoyancy,
                  body->centre_of_buoyancy, 3);
    same_constant(c, "hydrostatics_of_body", name, data->hydrostatics, body->hydrostatics,
                  SIX * SIX);
    same_constant(c, "start_rotation_of_body", name, data->start_rotation, body->rotation, FOUR);
    for (int i = 0; i < 3; i++) start[i] = body->position[i] - c->source->origin[i];
    same(c, "start_position_of_body", name, data->start_position, start, 3,
         COPIED * (size(body->position) + size(c->source->origin)));
}

static void compare_points(Compare *c) {
    for (size_t k = 0; k < c->source->points; k++) {
        const CpsPoint *point = &c->scene->point[k];
        const bool is_on = point->kind == CPS_POINT_KIND_ON_BODY;
        if (c->bodies.of_point[k] != (is_on ? point->body : ON_NO_BODY))
            find(c, "body_of_point of %s", point->name);
        else if (is_on)
            same_constant(c, "place_on_body_of_point", point->name, c->bodies.place[k],
                          point->position, 3);
    }
}

static Imposed first(const Compare *c, size_t k) {
    const CpsBody *body = &c->scene->body[k];
    Imposed out = {.kind = body->kind == CPS_BODY_KIND_HELD ? BODY_HELD : BODY_FREE};
    for (int i = 0; i < 3; i++) {
        out.position[i] = body->position[i] - c->source->origin[i];
        out.load[i] = body->force[i];
        out.load[3 + i] = body->moment[i];
    }
    unit(body->rotation, out.rotation);
    return out;
}

/* ---- steps ---- */

/* Between two unit quaternions, on the shorter great circle. */
static void between(const double from[FOUR], const double to[FOUR], double share,
                    double out[FOUR]) {
    double cosine = 0, sum[FOUR];
    for (int i = 0; i < FOUR; i++) cosine += from[i] * to[i];
    const double sign = cosine < 0 ? -1 : 1;
    for (int i = 0; i < FOUR; i++) sum[i] = from[i] - sign * to[i];
    /* the angle from the chord, which is accurate where it is small */
    const double angle =
        2 * asin(fmin(1, 0.5 * hypot(hypot(sum[0], sum[1]), hypot(sum[2], sum[3]))));
    const double one = angle > 1e-9 ? sin((1 - share) * angle) / sin(angle) : 1 - share,
                 other = angle > 1e-9 ? sin(share * angle) / sin(angle) : share;
    for (int i = 0; i < FOUR; i++) sum[i] = one * from[i] + sign * other * to[i];
    unit(sum, out);
}

/* Turn q further by a rotation vector. */
static void turn_further(const double by[3], double q[FOUR]) {
    const double angle = size(by);
    if (angle == 0) return;
    double p[FOUR] = {cos(angle / 2)}, out[FOUR];
    for (int i = 0; i < 3; i++) p[1 + i] = sin(angle / 2) / angle * by[i];
    out[0] = p[0] * q[0];
    for (int i = 1; i < FOUR; i++) {
        const int j = i % 3 + 1, k = j % 3 + 1;
        out[0] -= p[i] * q[i];
        out[i] = p[0] * q[i] + q[0] * p[i] + p[j] * q[k] - p[k] * q[j];
    }
    unit(out, q);
}

static void impose(const Compare *c, Imposed *body, const CpsStage *stage,
                   const CpsBodyChange *change, const Part *part, const BodyState *before) {
    const double share = part->to;
    double added[SIX], noise[SIX];
    oscillation(stage, CPS_SWAY_OF_BODY, change->body, 0, part->end, added, noise);
    for (int i = 0; i < SIX; i++) body->noise[i] += noise[i];
    const int kind = change->kind == CPS_BODY_KIND_HELD ? BODY_HELD : BODY_FREE;
    if (part->number == 1) {
        if (kind == BODY_HELD && body->kind == BODY_FREE && before) {
            memcpy(body->position, before->position, sizeof body->position);
            unit(before->rotation, body->rotation);
        }
        if (kind == BODY_FREE && body->kind == BODY_HELD)
            for (int i = 0; i < SIX; i++) body->load[i] = before ? before->support[i] : 0;
        memcpy(body->from_position, body->position, sizeof body->from_position);
        memcpy(body->from_rotation, body->rotation, sizeof body->from_rotation);
        memcpy(body->from_load, body->load, sizeof body->from_load);
        body->kind = kind;
    }
    if (kind == BODY_HELD) {
        double to[FOUR];
        unit(change->rotation, to);
        between(body->from_rotation, to, share, body->rotation);
        for (int i = 0; i < 3; i++) {
            const double end = change->position[i] - c->source->origin[i];
            body->position[i] =
                body->from_position[i] + share * (end - body->from_position[i]) + added[i];
        }
        for (int i = 0; i < 3; i++)
            body->noise[i] += part->noise * fabs(body->position[i] - body->from_position[i]);
        turn_further(&added[3], body->rotation);
        memset(body->load, 0, sizeof body->load);
        return;
    }
    for (int i = 0; i < SIX; i++) {
        const double end = i < 3 ? change->force[i] : change->moment[i - 3];
        body->load[i] = body->from_load[i] + share * (end - body->from_load[i]) + added[i];
        body->noise[i] += part->noise * fabs(end - body->from_load[i]);
    }
}

/* [s] since the history began. */
static double time_after(const Compare *c, size_t step) {
    int id;
    double time = 0;
    if (nc_inq_varid(c->source->nc, "time", &id) == NC_NOERR)
        nc_get_var1_double(c->source->nc, id, &step, &time);
    return time;
}

/* Has the step a duration? */
static bool has_duration(const Compare *c, size_t step) {
    return time_after(c, step) > (step > 0 ? time_after(c, step - 1) : 0);
}

/* The velocities after a step, in the axes of the body. */
static RadiationMoment moment_of(const Compare *c, size_t k, size_t step, const BodyState *at) {
    return radiation_moment(time_after(c, step), at->rotation, c->motion[k].velocity,
                            c->motion[k].rate);
}

/* Add the force of radiation, turned to the axes of the scene. */
static void add_radiation(const Compare *c, size_t k, size_t step, const BodyState *at,
                          MemberLoad *out) {
    Real own[SIX], m[3][3];
    if (c->scene->body[k].radiation_count == 0 || !has_duration(c, step)) return;
    radiation_force(&c->scene->body[k], &c->past[k], moment_of(c, k, step, at), own, out->sizes);
    body_matrix(at->rotation, m);
    for (int i = 0; i < SIX; i++)
        for (int j = 0; j < 3; j++) out->drag[i] += m[i % 3][j] * own[i - i % 3 + j];
}

/* The step belongs to the past of the next one. Before the first one a body has the velocities of
 * the scene. */
static int note_past(const Compare *c, size_t k, size_t step, const BodyState *at) {
    if (c->scene->body[k].radiation_count == 0) return 0;
    if (!has_duration(c, step)) return radiation_rest(&c->past[k], time_after(c, step));
    return radiation_note(&c->past[k], moment_of(c, k, step, at));
}

static int begin_past(const Compare *c, size_t k) {
    const CpsBody *body = &c->scene->body[k];
    double start[FOUR];
    unit(body->rotation, start);
    return radiation_note(&c->past[k],
                          radiation_moment(0, start, body->velocity, &body->velocity[3]));
}

/* The water on the members of a body after a step, and that of radiation. */
static MemberLoad on_members(const Compare *c, size_t k, size_t step, const BodyState *at) {
    const BodyMotion *motion = &c->motion[k];
    MemberBody of = {.rotation = at->rotation,
                     .velocity = motion->velocity,
                     .rate = motion->rate,
                     .time = has_duration(c, step) ? time_after(c, step) : -1};
    for (int i = 0; i < 3; i++) of.position[i] = (Real)at->position[i] + c->source->origin[i];
    MemberLoad out = members_load(c->scene, (int)k, &of);
    add_radiation(c, k, step, at, &out);
    return out;
}

/* What the ledger says of them. */
static void compare_members(Compare *c, size_t k, size_t step, const BodyState *before,
                            const BodyState *now) {
    const BodyMotion *motion = &c->motion[k];
    if (step == 0 || !(motion->span > 0)) return;
    const MemberLoad load = on_members(c, k, step, now);
    Real t[3], work[2] = {0, 0}, sizes = 0;
    body_turn(before->rotation, now->rotation, t);
    for (int i = 0; i < SIX; i++) {
        const Real way = i < 3 ? (Real)now->position[i] - before->position[i] : t[i - 3];
        work[0] -= load.drag[i] * way;
        work[1] += load.waves[i] * way;
        sizes += load.sizes[i / 3] * (fabsl(way) + 1e-6L * (i < 3 ? size(now->position) : 1));
    }
    const double said[2] = {motion->drag, motion->waves};
    for (int i = 0; i < 2; i++)
        if (!(fabs(said[i] - (double)work[i]) <= WORKS * (double)sizes + 1e-300))
            find(c, "ledger_%s of body %s, step %zu: %.9g J, expected %.9g J", i ? "waves" : "drag",
                 c->bodies.data[k].name, step, said[i], (double)work[i]);
}

static void compare_state(Compare *c, size_t k, const Imposed *body, const double g[3], size_t step,
                          const BodyState *at) {
    const BodyData *data = &c->bodies.data[k];
    char of[120];
    snprintf(of, sizeof of, "%.60s, step %zu,", data->name, step);
    if (at->kind != body->kind) {
        find(c, "state_of_body of %s", of);
        return;
    }
    if (at->kind == BODY_HELD) {
        double sign = 0, wanted[FOUR];
        same(c, "position_of_body", of, at->position, body->position, 3,
             POSES * (size(body->position) + size(body->from_position) + size(c->source->origin)) +
                 size(body->noise));
        for (int i = 0; i < FOUR; i++) sign += at->rotation[i] * body->rotation[i];
        for (int i = 0; i < FOUR; i++)
            wanted[i] = sign < 0 ? -body->rotation[i] : body->rotation[i];
        same(c, "rotation_of_body", of, at->rotation, wanted, FOUR, POSES + size(&body->noise[3]));
    }
    const double pull = size(c->scene->gravity);
    double per[3], wanted[SIX], noise[2], q[SIX];
    Real load[SIX];
    for (int i = 0; i < 3; i++) per[i] = pull > 0 ? g[i] / pull : 0;
    body_load(data, at->position, at->rotation, per, load);
    double waves[SIX] = {0}, known[SIX] = {0};
    if (has_duration(c, step)) excitation(c->scene, (int)k, time_after(c, step), waves, known);
    const MemberLoad members = on_members(c, k, step, at);
    for (int i = 0; i < SIX; i++)
        wanted[i] =
            (double)(load[i] + members.drag[i] + members.waves[i]) + body->load[i] + waves[i];
    /* sizes of what the sums are made of; of rotations, up to half a turn */
    for (int i = 0; i < 3; i++)
        q[i] = fabs(at->position[i]) + fabs(data->start_position[i]) + size(c->source->origin);
    for (int i = 3; i < SIX; i++) q[i] = 4;
    const double weights = (data->weight + data->buoyancy) * size(per);
    noise[0] = weights + size(body->load) + size(body->from_load);
    noise[1] = data->weight * size(per) * size(data->centre_of_gravity) +
               data->buoyancy * size(per) * size(data->centre_of_buoyancy) + size(&body->load[3]) +
               size(&body->from_load[3]);
    for (int i = 0; i < SIX; i++)
        for (int j = 0; j < SIX; j++) noise[i / 3] += fabs(data->hydrostatics[SIX * i + j]) * q[j];
    same(c, "load_of_body", of, at->load, wanted, 3,
         LOADS * noise[0] + MEMBERS * members.sizes[0] + size(body->noise) + size(known));
    same(c, "moment of load_of_body", of, &at->load[3], &wanted[3], 3,
         LOADS * noise[1] + MEMBERS * members.sizes[1] + size(&body->noise[3]) + size(&known[3]));
}

/* [m] How far the farthest point of body k is from its reference point; else 1. */
static double arm_of(const Compare *c, size_t k) {
    double arm = 0;
    for (size_t i = 0; i < c->source->points; i++)
        if (c->bodies.of_point[i] == (int)k) arm = fmax(arm, size(c->bodies.place[i]));
    return arm > 0 ? arm : 1;
}

/* Add to a stiffness what the water on members at rest loses, by differences: its second derivative
 * jumps where a strip begins to be wet, so that they are small. */
static void add_members(const Compare *c, size_t k, const BodyState *at, double arm,
                        Real stiffness[SIX * SIX]) {
    static const double STEP = 1e-5;
    const double rest[3] = {0, 0, 0};
    if (c->scene->body[k].member_count == 0) return;
    for (int i = 0; i < SIX; i++)
        for (int side = -1; side <= 1; side += 2) {
            const double by = side * (i < 3 ? STEP * arm : STEP);
            double rotation[FOUR], turn[3] = {0, 0, 0};
            MemberBody of = {.rotation = rotation, .velocity = rest, .rate = rest, .time = -1};
            memcpy(rotation, at->rotation, sizeof rotation);
            if (i >= 3) turn[i - 3] = by;
            turn_further(turn, rotation);
            for (int a = 0; a < 3; a++)
                of.position[a] = (Real)at->position[a] + c->source->origin[a] + (a == i ? by : 0);
            const MemberLoad load = members_load(c->scene, (int)k, &of);
            for (int a = 0; a < SIX; a++) stiffness[SIX * a + i] -= load.drag[a] / (2 * by);
        }
}

/* The share of it to which the stiffness of all lines is known: that of one that cannot be
 * stretched is of its sag, which goes with the third power of the tension. */
static double stiffness_told(const Compare *c) {
    double most = 0;
    for (size_t i = 0; i < c->source->lines; i++)
        if (!(c->line[i].compliance > 0)) most = fmax(most, 3 * tension_told(&c->line[i]));
    return most;
}

/* The stiffness of a free body against that of its lines, weight and water, where that is known. */
static void compare_stiffness(Compare *c, size_t k, const double g[3], size_t step,
                              const BodyState *all) {
    const BodyState *at = &all[k];
    const double pull = size(c->scene->gravity), arm = arm_of(c, k);
    double per[3], most = 0, worst = 0;
    Real own[SIX * SIX];
    for (int i = 0; i < 3; i++) per[i] = pull > 0 ? g[i] / pull : 0;
    const StiffnessStep of = {c->source, &c->bodies, c->line, per, step, false};
    if (at->kind != BODY_FREE || !at->has_place || !body_stiffness(&of, k, all, arm, own)) return;
    if (!has_duration(c, step)) add_members(c, k, at, arm, own);
    for (int i = 0; i < SIX * SIX; i++) {
        const double unit = (i / SIX < 3 ? 1 : arm) * (i % SIX < 3 ? 1 : arm);
        most = fmax(most, fabs((double)own[i]) / unit);
        worst = fmax(worst, fabs((double)own[i] - at->stiffness[i]) / unit);
    }
    if (!(worst <= (STIFFNESS + stiffness_told(c)) * most))
        find(c, "stiffness of body %s, step %zu: off by %.3g N/m, the largest entry is %.3g N/m",
             c->bodies.data[k].name, step, worst, most);
}

/* What is claimed of a body that turns for ever. */
static void compare_turning(Compare *c, size_t k, const double load[SIX], const double g[3],
                            size_t step, const BodyState *at) {
    const double pull = size(c->scene->gravity);
    char sentence[200];
    if (at->proof_moment == 0 && size(at->proof) == 0) return;
    Turning of = {.source = c->source,
                  .bodies = &c->bodies,
                  .line = c->line,
                  .at = at,
                  .body = k,
                  .other_moments = has_duration(c, step) || c->scene->body[k].member_count > 0};
    for (int i = 0; i < 3; i++) of.pull[i] = pull > 0 ? g[i] / pull : 0;
    memcpy(of.given, load, sizeof of.given);
    const char *fault = turning_fault(&of, sentence, sizeof sentence);
    if (fault) find(c, "body %s, step %zu: %s", c->bodies.data[k].name, step, fault);
}

/* The ledger of a body in a step in time: the work of all forces is dissipated by damping, or in
 * its motion, or lost by the scheme. */
static void compare_ledger(Compare *c, size_t k, const double g[3], size_t step,
                           const BodyState *before, const BodyState *now) {
    const double pull = size(c->scene->gravity);
    const BodyMotion *motion = &c->motion[k];
    double per[3], sizes = fabs(motion->lost) + fabs(motion->growth) + motion->kinetic;
    if (step == 0 || !(motion->span > 0)) return;
    for (int i = 0; i < 3; i++) per[i] = pull > 0 ? g[i] / pull : 0;
    const BodyLedger of = {c->source, &c->bodies, c->line, per, now, before, k};
    const double work = (double)body_ledger_work(&of, &sizes),
                 spent = motion->lost + motion->growth + motion->scheme;
    if (!(fabs(work - spent) <= WORKS * sizes))
        find(c, "ledger of body %s, step %zu: work of %.9g J, spent %.9g J", c->bodies.data[k].name,
             step, work, spent);
}

/* The added mass in the file, with that of members. */
static void compare_added(Compare *c, size_t k) {
    double wanted[SIX * SIX];
    members_added(c->scene, (int)k, wanted);
    same(c, "added_mass of body", c->bodies.data[k].name, c->motion[k].added, wanted, SIX * SIX,
         LOADS * largest(wanted, SIX * SIX));
}

static bool is_in_time(const CpsScene *scene) {
    bool any = scene->in_time;
    for (int k = 0; k < scene->stage_count; k++) any = any || scene->stage[k].duration > 0;
    return any;
}

/* What else moves with it, or damps it. */
static void compare_masses(Compare *c, size_t k) {
    const CpsBody *given = &c->scene->body[k];
    const BodyMotion *m = &c->motion[k];
    const char *of = c->bodies.data[k].name;
    same_constant(c, "mass_of_body", of, &m->mass, &given->mass, 1);
    same_constant(c, "moments_of_inertia_of_body", of, m->moments, given->inertia, 3);
    same_constant(c, "products_of_inertia_of_body", of, m->products, &given->inertia[3], 3);
    same_constant(c, "damping_matrix_of_body", of, m->damping, given->damping, SIX * SIX);
    same_constant(c, "quadratic_damping_of_body", of, m->quadratic, given->quadratic_damping,
                  SIX * SIX);
}

static void compare_step(Compare *c, const GivenStep *given, size_t step, Imposed *imposed,
                         const BodyState *before, const BodyState *now) {
    const int changes = given->stage ? given->stage->body_change_count : 0;
    for (int i = 0; i < changes; i++) {
        const CpsBodyChange *change = &given->stage->body_change[i];
        impose(c, &imposed[change->body], given->stage, change, &given->part,
               step > 0 ? &before[change->body] : NULL);
    }
    for (size_t k = 0; k < c->bodies.count; k++) {
        compare_state(c, k, &imposed[k], given->gravity, step, &now[k]);
        compare_stiffness(c, k, given->gravity, step, now);
        compare_turning(c, k, imposed[k].load, given->gravity, step, &now[k]);
        compare_ledger(c, k, given->gravity, step, &before[k], &now[k]);
        compare_members(c, k, step, &before[k], &now[k]);
        if (step == 0 && is_in_time(c->scene)) {
            compare_added(c, k);
            compare_masses(c, k);
        }
    }
}

static int compare_steps(Compare *c, GivenStep (*step_of)(const void *user, size_t step),
                         FILE *log) {
    const size_t n = c->bodies.count;
    Imposed *imposed = calloc(n, sizeof *imposed);
    BodyState *now = calloc(n, sizeof *now), *before = calloc(n, sizeof *before);
    c->line = calloc(c->source->lines, sizeof *c->line);
    c->motion = calloc(n, sizeof *c->motion);
    c->past = calloc(n, sizeof *c->past);
    int bad = imposed && now && before && c->line && c->motion && c->past ? 0 : -1;
    for (size_t k = 0; k < n && !bad; k++) bad = begin_past(c, k);
    for (size_t i = 0; i < c->source->lines && !bad; i++)
        bad = record_create(c->source, c->source->line_name[i], &c->line[i], log);
    if (!bad)
        for (size_t k = 0; k < n; k++) imposed[k] = first(c, k);
    for (size_t step = 0; step < c->source->steps && !bad && !c->found; step++) {
        const GivenStep given = step_of(c->user, step);
        bad = bodies_read(c->source, &c->bodies, step, now, log);
        if (!bad) bad = body_motions_read(c->source, n, step, c->motion, log);
        for (size_t i = 0; i < c->source->lines && !bad; i++)
            bad = record_read(c->source, c->source->line_name[i], step, &c->line[i], log);
        if (!bad) compare_step(c, &given, step, imposed, before, now);
        for (size_t k = 0; k < n && !bad; k++) bad = note_past(c, k, step, &now[k]);
        BodyState *swap = before;
        before = now;
        now = swap;
    }
    for (size_t i = 0; i < c->source->lines && c->line; i++) record_destroy(&c->line[i]);
    free(c->line);
    if (c->past)
        for (size_t k = 0; k < n; k++) free(c->past[k].moment);
    free(c->past);
    free(c->motion);
    free(imposed);
    free(now);
    free(before);
    return bad;
}

int given_bodies(const Source *source, const CpsScene *scene,
                 GivenStep (*step_of)(const void *user, size_t step), GivenFinding *finding,
                 void *user, FILE *log) {
    Compare c = {.source = source, .scene = scene, .find = finding, .user = user};
    int bad = bodies_open(source, &c.bodies, log);
    if (!bad && c.bodies.count != (size_t)scene->body_count)
        find(&c, "%zu bodies, in the scene %d", c.bodies.count, scene->body_count);
    if (!bad && !c.found && c.bodies.count > 0) {
        for (size_t k = 0; k < c.bodies.count; k++) compare_body(&c, k);
        compare_points(&c);
        if (!c.found) bad = compare_steps(&c, step_of, log);
    }
    bodies_close(&c.bodies);
    return bad;
}
