/* SPDX-License-Identifier: BSD-3-Clause */
/* Morison's loads on the members of bodies, up to the surface (members.h).
 *
 * A member is divided into strips of equal length. What of a strip is below the surface, whose
 * height above it is taken as linear along the strip, has the load of its middle, so that loads are
 * continuous in pose and time, and off their integrals by the square of the length of a strip:
 *
 *     per length  (rho/2) d (normal |u_n| u_n + pi tangential |u_t| u_t)
 *                 + rho (pi/4) d^2 (1 + added_normal) a_n,
 *
 * u the velocity of the water less that of the strip, a the acceleration of the water. The added
 * mass is that of what is wet as the scene begins, in water at rest. */
#include "evolve/members.h"

#include <math.h>
#include <stdio.h>

#include "base/math.h"
#include "base/status.h"
#include "cable/flow.h"
#include "evolve/bodies.h"
#include "evolve/loads.h"
#include "evolve/ranges.h"
#include "evolve/time_check.h"

/* A member. */
static CpsiCylinder member_of(const CpsScene *scene, const CpsMember *given) {
    const Vec3 from = vec3_load(given->from), way = vec3_sub(vec3_load(given->to), from);
    const double length = vec3_norm(way);
    const int strips = given->strip_count > 0 ? given->strip_count : CPS_MEMBER_STRIPS;
    return (CpsiCylinder){.from = from,
                          .axis = vec3_scale(1 / length, way),
                          .length = length,
                          .each = length / strips,
                          .surface = scene->has_water_surface ? scene->water_surface : INFINITY,
                          .strips = strips,
                          .flow = {.density = scene->current ? scene->current->density : 0,
                                   .drag = {.diameter = given->diameter,
                                            .normal = given->normal,
                                            .tangential = given->tangential,
                                            .added_normal = given->added_normal}}};
}

/* [kg/m] of the water in its place. */
static double displaced(const CpsiCylinder *member) {
    const double d = member->flow.drag.diameter;
    return member->flow.density * 0.25 * CPSI_PI * d * d;
}

/* ---- check ---- */

static CpsStatus check_member(const CpsBody *body, int index, CpsError *err) {
    const CpsMember *member = &body->member[index];
    char place[32];
    snprintf(place, sizeof place, "members[%d]", index + 1);
    if (!cpsi_are_usable(member->from) || !cpsi_are_usable(member->to) ||
        !cpsi_is_positive(vec3_norm(vec3_sub(vec3_load(member->to), vec3_load(member->from)))))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "body '%s': members: number %d goes from (%g, %g, %g) m to (%g, %g, "
                            "%g) m, expected two places apart from each other",
                            body->name, index + 1, member->from[0], member->from[1],
                            member->from[2], member->to[0], member->to[1], member->to[2]);
    if (!cpsi_is_positive(member->diameter) || !cpsi_is_not_negative(member->normal) ||
        !cpsi_is_not_negative(member->tangential) || !cpsi_is_not_negative(member->added_normal))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "body '%s': members: number %d has the diameter %g m, normal %g, "
                            "tangential %g, added_normal %g: expected a positive diameter and "
                            "finite numbers >= 0",
                            body->name, index + 1, member->diameter, member->normal,
                            member->tangential, member->added_normal);
    if (member->strip_count < 0 || member->strip_count > CPS_MAX_STRIPS)
        return CPSI_FAIL_AT(place, err, CPS_ERR_LIMIT,
                            "body '%s': members: number %d has %d strips, expected 1 to %d",
                            body->name, index + 1, member->strip_count, (int)CPS_MAX_STRIPS);
    return CPS_OK;
}

static CpsStatus check_body(const CpsScene *scene, const CpsBody *body, CpsError *err) {
    const int count = body->member_count;
    if (count < 0 || (count > 0 && !body->member))
        return CPSI_FAIL_AT("members", err, CPS_ERR_ARGUMENT,
                            "body '%s': members: found %d, expected 0 or more", body->name, count);
    if (count > CPS_MAX_MEMBERS)
        return CPSI_FAIL_AT("members", err, CPS_ERR_LIMIT,
                            "body '%s': members: found %d, the limit is %d", body->name, count,
                            (int)CPS_MAX_MEMBERS);
    if (count > 0 && !scene->current && cpsi_is_in_time(scene))
        return CPSI_FAIL_AT("members", err, CPS_ERR_ARGUMENT,
                            "body '%s': members: a step of the history has a duration, and there "
                            "is no water that they could move in: give water_density",
                            body->name);
    CpsStatus status = CPS_OK;
    for (int k = 0; k < count && status == CPS_OK; k++) status = check_member(body, k, err);
    return status;
}

CpsStatus cpsi_members_check(const CpsScene *scene, CpsError *err) {
    for (int i = 0; i < scene->body_count; i++) {
        const CpsStatus status = check_body(scene, &scene->body[i], err);
        if (status != CPS_OK)
            return cpsi_fail_inside(err, status, "bodies.%s", scene->body[i].name);
    }
    return CPS_OK;
}

/* ---- added mass ---- */

/* The part of a piece, of the heights low and high above the surface at its beginning and end, that
 * is below it: shares of the way from the one to the other. False: none. */
static bool find_wet(double low, double high, double share[2]) {
    share[0] = 0;
    share[1] = 1;
    if (low > 0 && high > 0) return false;
    if (low > 0) share[0] = low / (low - high);
    if (high > 0) share[1] = low / (low - high);
    return share[1] > share[0];
}

/* Add a mass at an arm that moves across an axis only: m G' (1 - e e') G, G = (1, -[arm]). */
static void add_mass(double mass, Vec3 arm, Vec3 axis, double out[36]) {
    double across[6][3];
    for (int k = 0; k < 6; k++) {
        double unit[3] = {0, 0, 0};
        unit[k % 3] = 1;
        const Vec3 one = vec3_load(unit), moved = k < 3 ? one : vec3_cross(one, arm);
        vec3_store(across[k], vec3_reject(moved, axis));
    }
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 6; k++)
            out[6 * i + k] += mass * vec3_dot(vec3_load(across[i]), vec3_load(across[k]));
}

/* Add that of a member in the axes of its body, in the pose in which it begins: by Gauss's formula
 * with two places, which is exact for squares of them. */
static void add_member_mass(const CpsiCylinder *member, const CpsiPose *begin, double out[36]) {
    const double gauss = 0.5 / sqrt(3.0), up = rotation_apply(begin->turn, member->axis).z,
                 z = begin->place.z + rotation_apply(begin->turn, member->from).z;
    double share[2];
    const double low = z - member->surface, high = low + up * member->length;
    if (!find_wet(low, high, share)) return; /* without a surface both are -INFINITY */
    const double wet = (share[1] - share[0]) * member->length,
                 middle = 0.5 * (share[0] + share[1]) * member->length,
                 mass = displaced(member) * member->flow.drag.added_normal * wet;
    for (int side = -1; side <= 1; side += 2)
        add_mass(0.5 * mass, vec3_axpy(middle + side * gauss * wet, member->axis, member->from),
                 member->axis, out);
}

void cps_body_added_mass(const CpsScene *scene, int body, double added[36]) {
    if (!added) return;
    for (int i = 0; i < 36; i++) added[i] = 0;
    if (!scene || body < 0 || body >= scene->body_count) return;
    const CpsBody *given = &scene->body[body];
    const CpsiPose begin = cpsi_body_begin(given);
    for (int i = 0; i < 36; i++) added[i] = given->added_mass[i];
    for (int k = 0; k < given->member_count; k++) {
        const CpsiCylinder member = member_of(scene, &given->member[k]);
        add_member_mass(&member, &begin, added);
    }
}

/* ---- data ---- */

void cpsi_members_layout(CpsEvolution *evolution, CpsiArena *arena, const CpsScene *scene) {
    size_t members = 0;
    for (int i = 0; i < scene->body_count; i++) members += (size_t)scene->body[i].member_count;
    CPSI_PLACE(arena, evolution->member, members);
}

void cpsi_members_fill(CpsEvolution *evolution, const CpsScene *local) {
    CpsiCylinder *next = evolution->member;
    for (int i = 0; i < local->body_count; i++) {
        const CpsBody *given = &local->body[i];
        CpsiBody *body = &evolution->bodies.body[i];
        body->given.member = NULL; /* the caller's */
        body->given.member_count = 0;
        if (given->member_count == 0 || !local->current) continue;
        cps_body_added_mass(local, i, body->given.added_mass);
        cpsi_current_fill(local->current, evolution->origin, evolution->current_row);
        body->member = next;
        body->member_count = given->member_count;
        for (int k = 0; k < given->member_count; k++, next++) {
            *next = member_of(local, &given->member[k]);
            next->flow.row_count = local->current->row_count;
            next->flow.row = evolution->current_row;
            next->flow.waves = evolution->wave ? &evolution->waves : NULL;
            next->flow.given = evolution->water.function ? &evolution->water : NULL;
        }
    }
}

/* ---- loads ---- */

/* A member in a pose, and the motion of its body. */
typedef struct Site {
    const CpsiCylinder *member;
    Vec3 place, from, axis; /* of the reference point; of the member's beginning from it */
    Vec3 velocity, rate;
    bool in_time;           /* otherwise there are neither waves nor what a function gives */
    const CpsiWaves *waves; /* that lift the surface; NULL: none in the step */
    double reach;           /* [m] by which waves lift the surface at most */
} Site;

static Vec3 place_at(const Site *site, double s) {
    return vec3_add(site->place, vec3_axpy(s, site->axis, site->from));
}

/* [m] The height above the surface. */
static double height_at(const Site *site, double s) {
    const Vec3 x = place_at(site, s);
    double lift = 0;
    if (site->waves) (void)cpsi_waves_at(site->waves, x, &lift);
    return x.z - (site->member->surface + lift);
}

/* The part of the piece from s to `end` that is wet; false: none. */
static bool find_part(const Site *site, double s, double end, double part[2]) {
    const double surface = site->member->surface, low = place_at(site, s).z,
                 high = place_at(site, end).z;
    double share[2];
    part[0] = s;
    part[1] = end;
    if (fmax(low, high) + site->reach <= surface) return true;
    if (fmin(low, high) - site->reach > surface) return false;
    if (!find_wet(height_at(site, s), height_at(site, end), share)) return false;
    part[0] = s + share[0] * (end - s);
    part[1] = s + share[1] * (end - s);
    return true;
}

static void add_force(CpsiWrench *to, Vec3 force, Vec3 arm) {
    to->force = vec3_add(to->force, force);
    to->moment = vec3_add(to->moment, vec3_cross(arm, force));
}

static void add_part(const Site *site, const double part[2], CpsiMemberLoad *out) {
    const CpsiCylinder *member = site->member;
    const CpsiFlow *flow = &member->flow;
    const double middle = 0.5 * (part[0] + part[1]), length = part[1] - part[0];
    const Vec3 x = place_at(site, middle), arm = vec3_axpy(middle, site->axis, site->from);
    const CpsiWaterMotion water =
        site->in_time ? cpsi_flow_motion(flow, x)
                      : (CpsiWaterMotion){.velocity = cpsi_flow_velocity(flow, x.z)};
    const Vec3 strip = vec3_add(site->velocity, vec3_cross(site->rate, arm)),
               u = vec3_sub(water.velocity, strip);
    add_force(&out->drag, vec3_scale(length, cpsi_flow_drag(flow, u, site->axis)), arm);
    const double mass = displaced(member) * (1 + flow->drag.added_normal) * length;
    add_force(&out->waves, vec3_scale(mass, vec3_reject(water.acceleration, site->axis)), arm);
}

CpsiMemberLoad cpsi_members_load(const CpsiBody *body, const CpsiPose *pose,
                                 const CpsiBodyPhase *phase) {
    const Vec3 none = vec3(0, 0, 0);
    CpsiMemberLoad out = {{none, none}, {none, none}};
    if (body->member_count == 0) return out;
    const CpsiWaves *waves = phase ? body->member[0].flow.waves : NULL; /* the scene's */
    const int count = waves ? waves->count : 0;
    double reach = 0;
    for (int w = 0; w < count; w++) reach += waves->wave[w].amplitude;
    for (int k = 0; k < body->member_count; k++) {
        const CpsiCylinder *member = &body->member[k];
        const Site site = {.member = member,
                           .place = pose->place,
                           .from = rotation_apply(pose->turn, member->from),
                           .axis = rotation_apply(pose->turn, member->axis),
                           .velocity = phase ? phase->velocity : none,
                           .rate = phase ? phase->rate : none,
                           .in_time = phase != NULL,
                           .waves = waves,
                           .reach = reach};
        for (int i = 0; i < member->strips; i++) {
            double part[2];
            if (find_part(&site, i * member->each, (i + 1) * member->each, part))
                add_part(&site, part, &out);
        }
    }
    return out;
}

static CpsiWrench drag_at_rest(const CpsiBody *body, const CpsiPose *pose) {
    return cpsi_members_load(body, pose, NULL).drag;
}

void cpsi_members_stiffness(const CpsiBody *body, const CpsiPose *pose, double stiffness[36]) {
    if (body->member_count > 0) cpsi_body_add_stiffness_of(drag_at_rest, body, pose, stiffness);
}
