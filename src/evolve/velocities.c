/* SPDX-License-Identifier: BSD-3-Clause */
/* Velocities that are given (velocities.h). */
#include "evolve/velocities.h"

#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "evolve/hash.h"
#include "evolve/ranges.h"

/* A change that may have a velocity. */
typedef struct Given {
    const char *of, *what; /* "rope", "A" */
    bool is_held, is_given;
    const double *velocity, *turn; /* turn: of a body, else NULL */
} Given;

static CpsStatus check(const Given *given, const CpsStage *stage, const char *what, CpsError *err) {
    if (!given->is_given) return CPS_OK;
    const double *v = given->velocity, *w = given->turn;
    char place[80];
    snprintf(place, sizeof place, "%s.%s", given->of, given->what);
    if (!given->is_held)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s has a velocity but is not held: only what is led to a place "
                            "has a given one",
                            what, place);
    if (!cpsi_are_usable(v))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s gets the velocity (%g, %g, %g) m/s, expected finite numbers",
                            what, place, v[0], v[1], v[2]);
    if (w && !cpsi_are_usable(w))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s turns at (%g, %g, %g) rad/s, expected finite numbers", what,
                            place, w[0], w[1], w[2]);
    if (!(stage->duration > 0))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s has a velocity, but the step takes no time: give it a "
                            "duration, or leave the velocity out",
                            what, place);
    if (stage->step_count != 1 || stage->error > 0)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s has a velocity, which is that at the end of one step: expected "
                            "steps 1 and error 0, found %d and %g m",
                            what, place, stage->step_count, stage->error);
    return CPS_OK;
}

CpsStatus cpsi_velocities_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int i = 0; i < stage->change_count && status == CPS_OK; i++) {
        const CpsChange *change = &stage->change[i];
        status = check(&(Given){scene->line[change->line].name, cpsi_end_letter(change->end),
                                change->to.kind == CPS_END_KIND_HELD, change->has_velocity,
                                change->velocity, NULL},
                       stage, what, err);
    }
    for (int i = 0; i < stage->point_change_count && status == CPS_OK; i++) {
        const CpsPointChange *change = &stage->point_change[i];
        status = check(&(Given){scene->point[change->point].name, "point",
                                change->kind == CPS_POINT_KIND_HELD, change->has_velocity,
                                change->velocity, NULL},
                       stage, what, err);
    }
    for (int i = 0; i < stage->body_change_count && status == CPS_OK; i++) {
        const CpsBodyChange *change = &stage->body_change[i];
        status = check(&(Given){scene->body[change->body].name, "body",
                                change->kind == CPS_BODY_KIND_HELD, change->has_velocity,
                                change->velocity, &change->velocity[3]},
                       stage, what, err);
    }
    return status;
}

/* The points on a body go with it. */
static void plan_point(CpsEvolution *evolution, int index) {
    CpsiPointInertia *inertia = &evolution->points.point[index].inertia;
    const CpsPoint *given = &evolution->points.given[index];
    if (given->kind != CPS_POINT_KIND_ON_BODY) return;
    const CpsiBody *body = &evolution->bodies.body[given->body];
    const Vec3 arm = cpsi_pose_arm(&body->pose, given->position);
    inertia->velocity_given = body->inertia.velocity_given;
    vec3_store(inertia->given_velocity,
               vec3_add(body->inertia.given_velocity, vec3_cross(body->inertia.given_rate, arm)));
}

/* The ends of lines go with their points. */
static void plan_end(CpsEvolution *evolution, int line, int end) {
    CpsiMove *move = &evolution->move[line];
    const int point = evolution->points.tie[2 * line + end];
    move->has_velocity[end] = false;
    if (point == CPSI_NO_POINT) return;
    const CpsiPointInertia *inertia = &evolution->points.point[point].inertia;
    move->has_velocity[end] = inertia->velocity_given;
    memcpy(move->velocity[end], inertia->given_velocity, sizeof move->velocity[end]);
}

void cpsi_velocities_plan(CpsEvolution *evolution, const CpsiEvolutionStage *stage) {
    for (int i = 0; i < evolution->bodies.count; i++)
        evolution->bodies.body[i].inertia.velocity_given = false;
    for (int k = 0; k < stage->body_change_count; k++) {
        const CpsBodyChange *change = &stage->body_change[k];
        CpsiBodyInertia *inertia = &evolution->bodies.body[change->body].inertia;
        inertia->velocity_given = change->has_velocity;
        inertia->given_velocity = vec3_load(change->velocity);
        inertia->given_rate = vec3_load(&change->velocity[3]);
    }
    for (int i = 0; i < evolution->points.count; i++)
        evolution->points.point[i].inertia.velocity_given = false;
    for (int k = 0; k < stage->point_change_count; k++) {
        const CpsPointChange *change = &stage->point_change[k];
        CpsiPointInertia *inertia = &evolution->points.point[change->point].inertia;
        inertia->velocity_given = change->has_velocity;
        memcpy(inertia->given_velocity, change->velocity, sizeof inertia->given_velocity);
    }
    for (int i = 0; i < evolution->points.count; i++) plan_point(evolution, i);
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++) plan_end(evolution, i, end);
    for (int k = 0; k < stage->change_count; k++) {
        const CpsChange *change = &stage->change[k];
        CpsiMove *move = &evolution->move[change->line];
        if (!change->has_velocity || move->to[change->end].kind != CPS_END_KIND_HELD) continue;
        move->has_velocity[change->end] = true;
        memcpy(move->velocity[change->end], change->velocity, sizeof change->velocity);
    }
}

static void add(uint64_t *hash, bool is_given, char kind, int index, int count, const double *v) {
    if (!is_given) return;
    hash_bytes(hash, &kind, sizeof kind);
    hash_bytes(hash, &index, sizeof index);
    hash_numbers(hash, (size_t)count, v);
}

void cpsi_velocities_hash(uint64_t *hash, const CpsiEvolutionStage *stage) {
    for (int i = 0; i < stage->change_count; i++)
        add(hash, stage->change[i].has_velocity, 'e', i, 3, stage->change[i].velocity);
    for (int i = 0; i < stage->point_change_count; i++)
        add(hash, stage->point_change[i].has_velocity, 'p', i, 3, stage->point_change[i].velocity);
    for (int i = 0; i < stage->body_change_count; i++)
        add(hash, stage->body_change[i].has_velocity, 'b', i, CPS_BODY_DIRECTIONS,
            stage->body_change[i].velocity);
}
