/* SPDX-License-Identifier: BSD-3-Clause */
/* What leads an end, a point or a body at constant acceleration from rest, with the velocities of
 * its steps given and by its places alone.
 *
 * Both formulas of the scheme are exact for a velocity that is linear in time, from zero. So with
 * the velocities a k h given the force that leads it is that of the line and M a in each step,
 * about a body also J alpha. By the places a (k h)^2/2 alone the velocities of the scheme are a
 * h/2, 2 a h, 3 a h, .. and thus the accelerations, by (v_1 - v_0)/h and (3 v_{n+1} - 4 v_n +
 * v_{n-1})/(2 h), a/2, 2 a, 3 a/4, and a from the fourth step on. The line is one elastic element,
 * whose force follows from its length. Each figure is printed. */
#include <stdio.h>

#include "time_rig.h"

enum { STEPS = 8 };
static const double STEP = 0.1, LENGTH = 2, STIFFNESS = 500, FROM = 2.1;
static const double PUSH[3] = {0.7, -0.4, 0.5}, SPIN = 0.9, ARM[3] = {0.3, 0.1, 0};
static const double MASS = 40, TURNING = 12;
/* The inertia of the scheme by places alone, over that of the motion. */
static const double PLACES_ALONE[STEPS] = {0.5, 2, 0.75, 1, 1, 1, 1, 1};
/* Of the largest force: places are rounded, which counts by M/k^2; nothing is left to solve. */
static const double SHARE = 1e-12;

typedef enum Lead { LEAD_END, LEAD_POINT, LEAD_BODY } Lead;
static const char *const NAME[] = {"end", "point", "body"};

typedef struct Led {
    CpsLine line;
    CpsPoint point[2];
    CpsBody body;
    CpsScene scene;
    double start[6];
} Led;

static void make(Led *led, Lead lead) {
    *led = (Led){.start = {0, 0, 0, FROM, 0, 0}};
    led->scene = cps_scene_default();
    led->scene.in_time = true;
    led->line = cps_line_default();
    led->line.name = "line";
    led->line.length = LENGTH;
    led->line.element_count = 1;
    led->line.stiffness = STIFFNESS;
    led->line.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = led->start};
    led->line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_HELD};
    led->line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {FROM, 0, 0}};
    led->scene.line = &led->line;
    led->scene.line_count = 1;
    if (lead == LEAD_END) led->line.inertia = 2 * MASS / LENGTH; /* half of it is at each end */
    if (lead == LEAD_END) return;
    led->line.quasi_static = true;
    led->line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_POINT};
    led->point[0] = cps_point_default();
    led->point[0].name = "eye";
    led->point[0].position[0] = FROM;
    led->point[0].inertia = lead == LEAD_POINT ? MASS : 0;
    led->scene.point = led->point;
    led->scene.point_count = 1;
    if (lead == LEAD_POINT) return;
    led->body = cps_body_default();
    led->body.name = "body";
    led->body.mass = MASS;
    led->body.inertia[0] = led->body.inertia[1] = 0.7 * TURNING;
    led->body.inertia[2] = TURNING;
    led->body.position[0] = FROM;
    led->point[0].kind = CPS_POINT_KIND_ON_BODY;
    for (int a = 0; a < 3; a++) led->point[0].position[a] = ARM[a];
    for (int a = 0; a < 3; a++) led->start[3 + a] += ARM[a];
    led->scene.body = &led->body;
    led->scene.body_count = 1;
}

/* Lead it by the k-th step, k >= 1. */
static void move(CpsEvolution *evolution, Lead lead, int k, bool with) {
    const double time = k * STEP, angle = SPIN * time * time / 2;
    CpsError err;
    CpsChange end = {.end = CPS_END_B, .to.kind = CPS_END_KIND_HELD, .has_velocity = with};
    CpsPointChange point = {.kind = CPS_POINT_KIND_HELD, .has_velocity = with};
    CpsBodyChange body = {.kind = CPS_BODY_KIND_HELD,
                          .rotation = {cos(angle / 2), 0, 0, sin(angle / 2)},
                          .has_velocity = with};
    for (int a = 0; a < 3; a++) {
        const double place = (a ? 0 : FROM) + PUSH[a] * time * time / 2, v = PUSH[a] * time;
        end.to.value[a] = point.value[a] = body.position[a] = place;
        if (with) end.velocity[a] = point.velocity[a] = body.velocity[a] = v;
    }
    if (with) body.velocity[5] = SPIN * time;
    CpsStage step = cps_stage_default();
    step.name = "lead";
    step.duration = STEP;
    step.change = &end;
    step.point_change = &point;
    step.body_change = &body;
    step.change_count = lead == LEAD_END;
    step.point_change_count = lead == LEAD_POINT;
    step.body_change_count = lead == LEAD_BODY;
    if (cps_evolution_move(evolution, &step, &err)) fail_msg("%s", err.message);
    CHECK_INT((int)cps_evolution_report(evolution).outcome, (int)CPS_OUTCOME_SOLVED);
}

/* What leads it, and its velocity: of a body with moment and rate of rotation about z. */
static void found(const CpsEvolution *evolution, Lead lead, double force[4], double velocity[4]) {
    const CpsLineReport line = cps_evolution_line_report(evolution, 0);
    const CpsLineMotion moved = cps_evolution_line_motion(evolution, 0);
    const CpsPointReport point = cps_evolution_point_report(evolution, 0);
    const CpsPointMotion point_moved = cps_evolution_point_motion(evolution, 0);
    const CpsBodyReport body = cps_evolution_body_report(evolution, 0);
    const CpsBodyMotion body_moved = cps_evolution_body_motion(evolution, 0);
    for (int a = 0; a < 3; a++) {
        force[a] = lead == LEAD_END     ? line.end[CPS_END_B].force[a]
                   : lead == LEAD_POINT ? point.support[a]
                                        : body.support[a];
        velocity[a] = lead == LEAD_END     ? moved.velocity[3 + a]
                      : lead == LEAD_POINT ? point_moved.velocity[a]
                                           : body_moved.velocity[a];
    }
    force[3] = lead == LEAD_BODY ? body.support[5] : 0;
    velocity[3] = lead == LEAD_BODY ? body_moved.turn_rate[2] : 0;
}

/* What the elastic line asks for after the k-th step, from the places alone. */
static void of_line(Lead lead, int k, double force[4]) {
    const double time = k * STEP, angle = SPIN * time * time / 2, c = cos(angle), s = sin(angle);
    const double arm[3] = {c * ARM[0] - s * ARM[1], s * ARM[0] + c * ARM[1], ARM[2]};
    double at[3], square = 0;
    for (int a = 0; a < 3; a++) {
        at[a] = (a ? 0 : FROM) + PUSH[a] * time * time / 2 + (lead == LEAD_BODY ? arm[a] : 0);
        square += at[a] * at[a];
    }
    const double tension = STIFFNESS * (sqrt(square) / LENGTH - 1);
    for (int a = 0; a < 3; a++) force[a] = tension * at[a] / sqrt(square);
    force[3] = lead == LEAD_BODY ? arm[0] * force[1] - arm[1] * force[0] : 0;
}

static void lead_at_constant_acceleration(Lead lead, bool with) {
    Led led;
    CpsError err;
    CpsEvolution *evolution = NULL;
    make(&led, lead);
    if (cps_evolution_create(&led.scene, &evolution, &err))
        fail_msg("%s: %s", err.where, err.message);
    double worst = 0, largest = 0;
    for (int k = 1; k <= STEPS; k++) {
        double force[4], velocity[4], line[4];
        move(evolution, lead, k, with);
        found(evolution, lead, force, velocity);
        of_line(lead, k, line);
        const double share = with ? 1 : PLACES_ALONE[k - 1];
        for (int a = 0; a < 4; a++) {
            const double per = a < 3               ? PUSH[a]
                               : lead == LEAD_BODY ? SPIN
                                                   : 0,
                         whole = line[a] + share * per * (a < 3 ? MASS : TURNING);
            worst = fmax(worst, fabs(force[a] - whole));
            largest = fmax(largest, fabs(whole));
            if (with || k > 1) CHECK_NEAR(velocity[a], per * k * STEP, 1e-12);
            if (!with && k == 1) CHECK_NEAR(velocity[a], per * STEP / 2, 1e-12);
        }
    }
    char name[80];
    snprintf(name, sizeof name, "%s led %s", NAME[lead], with ? "with velocities" : "by places");
    CHECK_LESS(time_report(name, "largest error of a force, share", 0, worst / largest), SHARE);
    cps_evolution_destroy(evolution);
}

static void velocities_that_are_given(void **state) {
    (void)state;
    for (Lead lead = LEAD_END; lead <= LEAD_BODY; lead++) lead_at_constant_acceleration(lead, true);
}

static void places_alone(void **state) {
    (void)state;
    for (Lead lead = LEAD_END; lead <= LEAD_BODY; lead++)
        lead_at_constant_acceleration(lead, false);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(velocities_that_are_given),
                                       cmocka_unit_test(places_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
