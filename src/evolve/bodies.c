/* SPDX-License-Identifier: BSD-3-Clause */
/* The data of rigid bodies, their check, and the forces on them (bodies.h). */
#include "evolve/bodies.h"

#include <string.h>

#include "base/status.h"
#include "evolve/names.h"
#include "evolve/ranges.h"
#include "evolve/ties.h"

enum { BODY_COOKIE = 0x0b0d1e06, MAX_BODIES = 100 };
/* Hydrostatics are symmetric to this share of their largest entry. */
static const double SYMMETRY = 1e-9;

CpsBody cps_body_default(void) {
    return (CpsBody){.cookie = BODY_COOKIE, .rotation = {1, 0, 0, 0}};
}

/* check ---------------------------------------------------------------------------------------- */

static bool is_rotation(const double q[4]) {
    double most = 0;
    for (int i = 0; i < 4; i++) {
        if (!cpsi_is_usable(q[i])) return false;
        most = fmax(most, fabs(q[i]));
    }
    return most >= CPSI_SMALLEST_INPUT;
}

static bool is_symmetric(const double m[36]) {
    double most = 0;
    for (int i = 0; i < 36; i++) {
        if (!cpsi_is_usable(m[i])) return false;
        most = fmax(most, fabs(m[i]));
    }
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < i; k++)
            if (!(fabs(m[6 * i + k] - m[6 * k + i]) <= SYMMETRY * most)) return false;
    }
    return true;
}

static CpsStatus check_name(const CpsScene *scene, int index, CpsError *err) {
    const char *name = scene->body[index].name, *other = NULL;
    const CpsStatus status = cpsi_name_check("body", index, name, err);
    if (status != CPS_OK) return status;
    for (int i = 0; i < index; i++)
        if (strcmp(scene->body[i].name, name) == 0) other = "a body";
    for (int i = 0; i < scene->point_count; i++)
        if (scene->point[i].name && strcmp(scene->point[i].name, name) == 0) other = "a point";
    for (int i = 0; i < scene->line_count; i++)
        if (scene->line[i].name && strcmp(scene->line[i].name, name) == 0) other = "a line";
    for (int i = 0; i < scene->obstacle_count; i++)
        if (strcmp(scene->obstacle[i].name, name) == 0) other = "an obstacle";
    if (!other) return CPS_OK;
    return cpsi_fail(err, CPS_ERR_ARGUMENT, "body '%s': %s has the same name", name, other);
}

static bool is_used(const CpsScene *scene, int index) {
    for (int i = 0; i < scene->point_count; i++)
        if (scene->point[i].kind == CPS_POINT_KIND_ON_BODY && scene->point[i].body == index)
            return true;
    return false;
}

static CpsStatus check_numbers(const CpsBody *body, CpsError *err) {
    const double *vector[] = {body->position, body->centre_of_gravity, body->centre_of_buoyancy,
                              body->force, body->moment};
    static const char *const WHAT[] = {"position", "centre_of_gravity", "centre_of_buoyancy",
                                       "force", "moment"};
    for (int i = 0; i < 5; i++)
        if (!cpsi_are_usable(vector[i]))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "body '%s': %s is (%g, %g, %g), expected finite numbers", body->name,
                             WHAT[i], vector[i][0], vector[i][1], vector[i][2]);
    if (!is_rotation(body->rotation))
        return CPSI_FAIL_AT(
            "rotation", err, CPS_ERR_ARGUMENT,
            "body '%s': rotation is (%g, %g, %g, %g), expected a quaternion: finite "
            "numbers, not all 0",
            body->name, body->rotation[0], body->rotation[1], body->rotation[2], body->rotation[3]);
    if (!cpsi_is_not_negative(body->weight) || !cpsi_is_not_negative(body->buoyancy))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "body '%s': weight %g N and buoyancy %g N, expected finite numbers >= 0",
                         body->name, body->weight, body->buoyancy);
    if (!is_symmetric(body->hydrostatics))
        return CPSI_FAIL_AT("hydrostatics", err, CPS_ERR_ARGUMENT,
                            "body '%s': hydrostatics are not a symmetric matrix of finite numbers",
                            body->name);
    return CPS_OK;
}

static CpsStatus check_body(const CpsScene *scene, int index, CpsError *err) {
    const CpsBody *body = &scene->body[index];
    if (body->cookie != BODY_COOKIE)
        return CPSI_FAIL_AT("bodies", err, CPS_ERR_ARGUMENT,
                            "body %d: not made by cps_body_default()", index + 1);
    CpsStatus status = check_name(scene, index, err);
    if (status != CPS_OK) return cpsi_fail_inside(err, status, "bodies[%d]", index + 1);
    const double *f = body->force, *m = body->moment;
    const bool loaded = f[0] != 0 || f[1] != 0 || f[2] != 0 || m[0] != 0 || m[1] != 0 || m[2] != 0;
    if (body->kind != CPS_BODY_KIND_HELD && body->kind != CPS_BODY_KIND_FREE)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT, "body '%s': unknown kind %d", body->name,
                           (int)body->kind);
    else if (!is_used(scene, index))
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "body '%s': no point is on it: let a point with a line be on it, or "
                           "leave it out",
                           body->name);
    else
        status = check_numbers(body, err);
    if (status == CPS_OK)
        status = cpsi_gravity_check(scene, "body", body->name,
                                    body->weight > 0 || body->buoyancy > 0, err);
    if (status == CPS_OK && body->kind == CPS_BODY_KIND_FREE)
        status = cpsi_isotropy_check(scene, "body", body->name, err);
    if (status == CPS_OK && body->kind == CPS_BODY_KIND_HELD && loaded)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "body '%s': a load acts on it, but it is held: leave the load out, or "
                           "let the body be free",
                           body->name);
    return cpsi_fail_inside(err, status, "bodies.%s", body->name);
}

CpsStatus cpsi_bodies_check(const CpsScene *scene, CpsError *err) {
    if (scene->body_count < 0 || (scene->body_count > 0 && !scene->body))
        return CPSI_FAIL_AT("bodies", err, CPS_ERR_ARGUMENT, "bodies: found %d, expected 0 or more",
                            scene->body_count);
    if (scene->body_count > MAX_BODIES)
        return CPSI_FAIL_AT("bodies", err, CPS_ERR_LIMIT, "bodies: found %d, the limit is %d",
                            scene->body_count, (int)MAX_BODIES);
    for (int i = 0; i < scene->point_count; i++) {
        const CpsPoint *point = &scene->point[i];
        if (point->kind == CPS_POINT_KIND_ON_BODY &&
            (point->body < 0 || point->body >= scene->body_count))
            return CPSI_FAIL_AT("points", err, CPS_ERR_ARGUMENT,
                                "point %d: it is on body %d: there are %d, the first is 0", i + 1,
                                point->body, scene->body_count);
    }
    for (int i = 0; i < scene->body_count; i++) {
        const CpsStatus status = check_body(scene, i, err);
        if (status != CPS_OK) return status;
    }
    return CPS_OK;
}

static CpsStatus check_change(const CpsScene *scene, const CpsStage *stage, int index,
                              const char *what, CpsError *err) {
    const CpsBodyChange *change = &stage->body_change[index];
    if (change->body < 0 || change->body >= scene->body_count)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: change %d names body %d: there are %d", what,
                         index + 1, change->body, scene->body_count);
    const char *name = scene->body[change->body].name;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < index; i++)
        if (stage->body_change[i].body == change->body)
            status = cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: body '%s' is changed twice", what, name);
    if (status == CPS_OK && change->kind != CPS_BODY_KIND_HELD &&
        change->kind != CPS_BODY_KIND_FREE)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: body '%s' gets the unknown kind %d", what,
                           name, (int)change->kind);
    if (status == CPS_OK && change->kind == CPS_BODY_KIND_FREE)
        status = cpsi_isotropy_check(scene, "body", name, err);
    const bool sound = change->kind == CPS_BODY_KIND_HELD
                           ? cpsi_are_usable(change->position) && is_rotation(change->rotation)
                           : cpsi_are_usable(change->force) && cpsi_are_usable(change->moment);
    if (status == CPS_OK && !sound)
        status =
            cpsi_fail(err, CPS_ERR_ARGUMENT,
                      "%s: body '%s' gets numbers that are not finite, or no rotation", what, name);
    return cpsi_fail_inside(err, status, "%s.body", name);
}

CpsStatus cpsi_body_changes_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                  CpsError *err) {
    if (stage->body_change_count < 0 || (stage->body_change_count > 0 && !stage->body_change))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: found %d changes of bodies, expected 0 or more", what,
                         stage->body_change_count);
    CpsStatus status = CPS_OK;
    for (int i = 0; i < stage->body_change_count && status == CPS_OK; i++)
        status = check_change(scene, stage, i, what, err);
    return status;
}

/* data ----------------------------------------------------------------------------------------- */

CpsiPose cpsi_body_begin(const CpsBody *body) {
    return (CpsiPose){vec3_load(body->position), rotation_load(body->rotation)};
}

void cpsi_bodies_layout(CpsiBodies *bodies, CpsiArena *arena, const CpsScene *scene) {
    CPSI_PLACE(arena, bodies->body, scene->body_count);
}

void cpsi_bodies_fill(CpsiBodies *bodies, const CpsScene *scene, const CpsScene *local) {
    const double pull = vec3_norm(vec3_load(scene->gravity));
    bodies->count = scene->body_count;
    for (int i = 0; i < scene->body_count; i++) {
        const CpsBody *from = &scene->body[i];
        CpsiBody *body = &bodies->body[i];
        body->kind = from->kind;
        body->begin = body->pose = body->from = cpsi_body_begin(&local->body[i]);
        body->load = (CpsiWrench){vec3_load(from->force), vec3_load(from->moment)};
        body->mass = pull > 0 ? from->weight / pull : 0;
        body->lift = pull > 0 ? from->buoyancy / pull : 0;
        body->given = *from;
        body->given.name = body->name;
        for (int k = 0; k < scene->point_count; k++) {
            const CpsPoint *point = &scene->point[k];
            if (point->kind != CPS_POINT_KIND_ON_BODY || point->body != i) continue;
            body->arm = fmax(body->arm, vec3_norm(vec3_load(point->position)));
            body->length = fmax(body->length, cpsi_longest_line(scene, k));
        }
        if (!(body->arm > 0)) body->arm = body->length;
        body->report = (CpsBodyReport){.kind = from->kind, .has_place = true, .is_stable = true};
        vec3_store(body->report.position, body->pose.place);
        rotation_store(body->report.rotation, body->pose.turn);
    }
}

CpsiPose cpsi_pose_between(const CpsiPose *from, const CpsiPose *to, double share) {
    if (!(share < 1)) return *to;
    const Vec3 turn = rotation_vector(rotation_after(to->turn, rotation_inverse(from->turn)));
    return (CpsiPose){vec3_axpy(share, vec3_sub(to->place, from->place), from->place),
                      rotation_after(rotation_of(vec3_scale(share, turn)), from->turn)};
}

/* [-] A z axis of the body this close to horizontal, as the cosine, leaves only the sum of roll and
 * yaw: rounding of a unit quaternion. */
static const double UPRIGHT = 1e-12;

void cps_body_angles(const CpsBodyReport *report, double roll_pitch_yaw[3], double *heel) {
    if (!report || !roll_pitch_yaw || !heel) return;
    const Rotation turn = rotation_load(report->rotation);
    const Vec3 x = rotation_apply(turn, vec3(1, 0, 0)), y = rotation_apply(turn, vec3(0, 1, 0)),
               z = rotation_apply(turn, vec3(0, 0, 1));
    const double level = hypot(x.x, x.y);
    const bool has_both = level > UPRIGHT;
    roll_pitch_yaw[0] = has_both ? atan2(y.z, z.z) : 0;
    roll_pitch_yaw[1] = atan2(-x.z, level);
    roll_pitch_yaw[2] = has_both ? atan2(x.y, x.x) : atan2(-y.x, y.y);
    *heel = atan2(hypot(z.x, z.y), z.z);
}

/* forces --------------------------------------------------------------------------------------- */

static void add_force(CpsiWrench *to, Vec3 force, Vec3 arm) {
    to->force = vec3_add(to->force, force);
    to->moment = vec3_add(to->moment, vec3_cross(arm, force));
}

/* The rate of the rotation vector v of a rotation that turns on by theta is J theta, with J = I -
 * [v]/2 + c [v]^2 and [v] theta = v x theta: J' w. */
static Vec3 transposed_rate(Vec3 v, Vec3 w) {
    const double size = vec3_norm(v);
    const double c =
        size > 1e-4 ? 1 / (size * size) - (1 + cos(size)) / (2 * size * sin(size)) : 1.0 / 12;
    const Vec3 once = vec3_cross(v, w), twice = vec3_cross(v, once);
    return vec3_axpy(c, twice, vec3_axpy(0.5, once, w));
}

/* The displacement of a body from the pose in which it begins; returns its rotation vector. */
static Vec3 displacement(const CpsiBody *body, const CpsiPose *pose, double q[6]) {
    const Vec3 turn =
        rotation_vector(rotation_after(pose->turn, rotation_inverse(body->begin.turn)));
    vec3_store(q, vec3_sub(pose->place, body->begin.place));
    vec3_store(&q[3], turn);
    return turn;
}

double cpsi_body_water_energy(const CpsiBody *body, const CpsiPose *pose) {
    double q[6], sum = 0;
    (void)displacement(body, pose, q);
    for (int i = 0; i < 36; i++) sum += 0.5 * q[i / 6] * body->given.hydrostatics[i] * q[i % 6];
    return sum;
}

/* Hydrostatics: what the energy q' C q/2 loses in a motion. */
CpsiWrench cpsi_body_water(const CpsiBody *body, const CpsiPose *pose) {
    double q[6], f[6] = {0};
    const Vec3 turn = displacement(body, pose, q);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 6; k++) f[i] -= body->given.hydrostatics[6 * i + k] * q[k];
    return (CpsiWrench){vec3_load(f), transposed_rate(turn, vec3_load(&f[3]))};
}

/* Derivatives are central differences: the error of the square of this is rounding. */
static const double DIFFERENCE = 1e-5;

void cpsi_body_add_stiffness_of(CpsiWrenchAt *force, const CpsiBody *body, const CpsiPose *pose,
                                double stiffness[36]) {
    for (int k = 0; k < 6; k++) {
        double by[2][6];
        const double size = k < 3 ? DIFFERENCE * body->arm : DIFFERENCE;
        for (int side = 0; side < 2; side++) {
            double move[6] = {0};
            move[k] = side ? size : -size;
            const CpsiPose at = {vec3_add(pose->place, vec3_load(move)),
                                 rotation_after(rotation_of(vec3_load(&move[3])), pose->turn)};
            const CpsiWrench there = force(body, &at);
            vec3_store(by[side], there.force);
            vec3_store(&by[side][3], there.moment);
        }
        for (int i = 0; i < 6; i++) stiffness[6 * i + k] -= (by[1][i] - by[0][i]) / (2 * size);
    }
}

CpsiWrench cpsi_body_load(const CpsiBody *body, const CpsiPose *pose, const double gravity[3]) {
    const Vec3 g = vec3_load(gravity);
    CpsiWrench out = {vec3_add(body->load.force, body->waves.force),
                      vec3_add(body->load.moment, body->waves.moment)};
    add_force(&out, vec3_scale(body->mass, g),
              rotation_apply(pose->turn, vec3_load(body->given.centre_of_gravity)));
    add_force(&out, vec3_scale(-body->lift, g),
              rotation_apply(pose->turn, vec3_load(body->given.centre_of_buoyancy)));
    const CpsiWrench water = cpsi_body_water(body, pose);
    out.force = vec3_add(out.force, water.force);
    out.moment = vec3_add(out.moment, water.moment);
    return out;
}

void cpsi_add_turning_force(Vec3 force, Vec3 arm, double stiffness[36]) {
    const double f[3] = {force.x, force.y, force.z}, a[3] = {arm.x, arm.y, arm.z},
                 along = vec3_dot(force, arm);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            stiffness[6 * (3 + i) + 3 + k] += (i == k ? along : 0) - a[i] * f[k];
}

void cpsi_body_stiffness(const CpsiBody *body, const CpsiPose *pose, const double gravity[3],
                         double stiffness[36]) {
    const Vec3 g = vec3_load(gravity);
    cpsi_body_add_stiffness_of(cpsi_body_water, body, pose, stiffness);
    cpsi_add_turning_force(vec3_scale(body->mass, g),
                           rotation_apply(pose->turn, vec3_load(body->given.centre_of_gravity)),
                           stiffness);
    cpsi_add_turning_force(vec3_scale(-body->lift, g),
                           rotation_apply(pose->turn, vec3_load(body->given.centre_of_buoyancy)),
                           stiffness);
}
