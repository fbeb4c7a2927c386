/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines in time that stick to ground which turns: to a table, to one that moves as well, to a drum
 * that turns about its own axis, and to one that is taken along. What sticks is where the ground
 * has taken it, whatever the length of the steps. Each figure is printed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "time_rig.h"

enum { ELEMENTS = 6, NODES = ELEMENTS + 1 };

/* A rigid motion in one stage: a turn about a point, which goes by `by` meanwhile, and one about
 * the own axis of what is round. */
typedef struct Motion {
    double by[3], turn[3], about[3], own;
    double duration;
    int steps;
    double error;
} Motion;

typedef struct Ride {
    TimeRig rig;
    CpsShift shift[TIME_STAGES];
    CpsTurn turn[TIME_STAGES];
    Motion motion[TIME_STAGES];
    CpsEvolution *evolution;
    double place[3 * NODES];  /* [m] where the ground has taken the nodes */
    double point[3], axis[3]; /* ... and the axis of what is round */
    double imbalance, turnover, dissipated, obstacles;
    double off;         /* [m] the farthest that a node has been from there after a stage */
    double lately;      /* [m] ... and after the last one */
    bool hands_over;    /* each step is taken by another evolution, from a state that is saved */
    int steps, lengths; /* taken, and of how many other lengths than the one before */
} Ride;

static void begin(Ride *ride, CpsTimeScheme scheme, double friction) {
    memset(ride, 0, sizeof *ride);
    time_begin(&ride->rig, 0.6, ELEMENTS, 3, 1e4);
    ride->rig.scene.time_scheme = scheme;
    time_plane(&ride->rig, 0, friction);
    ride->rig.plane.moves = true;
    ride->rig.line.end[CPS_END_A] = ride->rig.line.end[CPS_END_B] =
        (CpsEnd){.kind = CPS_END_KIND_FREE};
    /* a rope in bends, as long as it is */
    double x = 1.2, y = 0.1;
    for (int j = 0; j < NODES; j++) {
        time_node(&ride->rig, j, x, y, 0);
        x += 0.1 * cos(0.5 * j);
        y += 0.1 * sin(0.5 * j);
    }
}

/* In place of the table a drum of radius R below z = 0 whose axis is y; the rope lies along the
 * top, or round it. */
static void lay_on_drum(Ride *ride, double radius, int around) {
    CpsObstacle *drum = &ride->rig.plane;
    drum->kind = CPS_OBSTACLE_CYLINDER;
    drum->radius = radius;
    memcpy(drum->point, (double[]){0, 0, -radius}, sizeof drum->point);
    memcpy(drum->axis, (double[]){0, 1, 0}, sizeof drum->axis);
    /* nodes on the drum, chords as long as elements */
    const double step = around ? 2 * asin(0.05 / radius) : 0;
    for (int j = 0; j < NODES; j++) {
        const double angle = step * (j - ELEMENTS / 2);
        time_node(&ride->rig, j, radius * sin(angle), around ? 0 : 0.1 * j,
                  radius * (cos(angle) - 1));
    }
}

static void add(Ride *ride, Motion motion) {
    const int s = ride->rig.scene.stage_count;
    CpsStage *stage = time_stage(&ride->rig, motion.duration, motion.steps);
    CpsShift *shift = &ride->shift[s];
    ride->motion[s] = motion;
    stage->error = motion.error;
    memcpy(shift->by, motion.by, sizeof shift->by);
    memcpy(shift->turn, motion.turn, sizeof shift->turn);
    memcpy(shift->about, motion.about, sizeof shift->about);
    ride->turn[s] = (CpsTurn){.obstacle = 0, .angle = motion.own};
    stage->shift = shift;
    stage->shift_count = 1;
    stage->turn = &ride->turn[s];
    stage->turn_count = motion.own != 0;
}

/* v turned by the vector `turn` (Rodrigues). */
static void rotate(const double turn[3], double v[3]) {
    const double angle = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
    if (!(angle > 0)) return;
    const double e[3] = {turn[0] / angle, turn[1] / angle, turn[2] / angle},
                 across[3] = {e[1] * v[2] - e[2] * v[1], e[2] * v[0] - e[0] * v[2],
                              e[0] * v[1] - e[1] * v[0]},
                 along = e[0] * v[0] + e[1] * v[1] + e[2] * v[2];
    for (int a = 0; a < 3; a++)
        v[a] = cos(angle) * v[a] + sin(angle) * across[a] + (1 - cos(angle)) * along * e[a];
}

static void carry_about(const double about[3], const double turn[3], double x[3]) {
    for (int a = 0; a < 3; a++) x[a] -= about[a];
    rotate(turn, x);
    for (int a = 0; a < 3; a++) x[a] += about[a];
}

/* Take what sticks along by a motion. */
static void carry(Ride *ride, const Motion *motion) {
    const double none[3] = {0};
    carry_about(motion->about, motion->turn, ride->point);
    for (int a = 0; a < 3; a++) ride->point[a] += motion->by[a];
    carry_about(none, motion->turn, ride->axis);
    double own[3];
    for (int a = 0; a < 3; a++) own[a] = motion->own * ride->axis[a];
    for (int j = 0; j < NODES; j++) {
        double *x = &ride->place[3 * j];
        carry_about(motion->about, motion->turn, x);
        for (int a = 0; a < 3; a++) x[a] += motion->by[a];
        carry_about(ride->point, own, x);
    }
}

static void hand_over(Ride *ride) {
    CpsEvolution *fresh;
    CpsError err;
    const size_t size = cps_evolution_state_size(ride->evolution);
    void *state = malloc(size);
    assert_non_null(state);
    cps_evolution_save(ride->evolution, state);
    if (cps_evolution_create(&ride->rig.scene, &fresh, &err) ||
        cps_evolution_load(fresh, state, size, &err))
        fail_msg("%s", err.message);
    free(state);
    cps_evolution_destroy(ride->evolution);
    ride->evolution = fresh;
}

static void take_stage(Ride *ride, int s, double *length) {
    CpsError err;
    const double end = cps_evolution_time(ride->evolution) + ride->motion[s].duration;
    while (cps_evolution_time(ride->evolution) < end - 1e-9) {
        if (ride->hands_over) hand_over(ride);
        if (cps_evolution_step(ride->evolution, &err)) fail_msg("%s", err.message);
        const CpsLineReport report = cps_evolution_line_report(ride->evolution, 0);
        const CpsLineMotion motion = cps_evolution_line_motion(ride->evolution, 0);
        const double now = cps_evolution_pace(ride->evolution).length;
        assert_true(cps_outcome_is_certified(report.outcome));
        ride->imbalance += fabs(report.ledger.imbalance);
        ride->turnover += motion.ledger.turnover;
        ride->dissipated += report.ledger.dissipated;
        ride->obstacles += report.ledger.obstacles;
        ride->lengths += fabs(now - *length) > 1e-9 * now;
        *length = now;
        ride->steps++;
    }
}

static void go(Ride *ride, const char *name) {
    CpsError err;
    if (cps_evolution_create(&ride->rig.scene, &ride->evolution, &err)) fail_msg("%s", err.message);
    memcpy(ride->place, ride->rig.point, sizeof ride->place);
    memcpy(ride->point, ride->rig.plane.point, sizeof ride->point);
    memcpy(ride->axis, ride->rig.plane.axis, sizeof ride->axis);
    double length = 0;
    for (int s = 0; s < ride->rig.scene.stage_count; s++) {
        take_stage(ride, s, &length);
        carry(ride, &ride->motion[s]);
        const double *at = cps_evolution_line_view(ride->evolution, 0).position;
        ride->lately = 0;
        for (int j = 0; j < NODES; j++) {
            double square = 0;
            for (int a = 0; a < 3; a++) square += pow(at[3 * j + a] - ride->place[3 * j + a], 2);
            ride->lately = fmax(ride->lately, sqrt(square));
        }
        ride->off = fmax(ride->off, ride->lately);
    }
    char title[80];
    snprintf(title, sizeof title, "%s, %s", name,
             ride->rig.scene.time_scheme == CPS_TIME_SCHEME_EULER ? "Euler" : "BDF2");
    time_report(title, "farthest from its place [m]", 0, ride->off);
    time_report(title, "lost to friction [J]", 0, ride->dissipated);
    /* places are known to the tolerance of contacts, and friction holds to it in each step */
    CHECK_LESS(ride->off, 1e-11);
    CHECK_LESS(fabs(ride->dissipated), 1e-9 * (1 + ride->turnover));
    CHECK_LESS(ride->imbalance, 1e-10 * ride->turnover);
    cps_evolution_destroy(ride->evolution);
}

/* A table that turns one way, then the other, rests, and turns again. */
static void a_table_turns_to_and_fro(void **state) {
    (void)state;
    for (int scheme = 0; scheme < 2; scheme++)
        for (int k = 1; k <= 16; k *= 4) { /* 0.4, 0.1 and 0.025 rad in a step */
            Ride ride;
            char name[40];
            begin(&ride, (CpsTimeScheme)scheme, 50);
            add(&ride, (Motion){.turn = {0, 0, 2}, .duration = 2, .steps = 5 * k});
            add(&ride, (Motion){.turn = {0, 0, -6}, .duration = 5, .steps = 15 * k});
            add(&ride, (Motion){.duration = 1, .steps = 3 * k});
            add(&ride, (Motion){.turn = {0, 0, 2.4}, .duration = 3, .steps = 6 * k});
            snprintf(name, sizeof name, "table, %.3g rad", 0.4 / k);
            go(&ride, name);
        }
}

/* ... and goes aside meanwhile, about another point each time. */
static void a_table_goes_aside(void **state) {
    (void)state;
    Ride ride;
    begin(&ride, CPS_TIME_SCHEME_BDF2, 50);
    add(&ride, (Motion){.by = {1, -0.5, 0},
                        .turn = {0, 0, 2},
                        .about = {0.3, 1, 0},
                        .duration = 2,
                        .steps = 12});
    add(&ride,
        (Motion){
            .by = {-2, 0, 0}, .turn = {0, 0, -3}, .about = {2, 0, 0}, .duration = 3, .steps = 20});
    go(&ride, "table aside");
}

/* ... and one that is raised at its far end. */
static void a_table_tilts(void **state) {
    (void)state;
    Ride ride;
    begin(&ride, CPS_TIME_SCHEME_BDF2, 50);
    add(&ride,
        (Motion){.turn = {0.1, -0.8, 0.5}, .about = {0, 0, 0.2}, .duration = 4, .steps = 16});
    go(&ride, "table that tilts");
}

/* The last two places are part of a state. */
static void states_go_on(void **state) {
    (void)state;
    Ride ride;
    begin(&ride, CPS_TIME_SCHEME_BDF2, 50);
    ride.hands_over = true;
    add(&ride, (Motion){.turn = {0, 0, 2}, .duration = 2, .steps = 10});
    add(&ride, (Motion){.turn = {0, 0, -1}, .duration = 1, .steps = 5});
    go(&ride, "table, states");
}

/* Steps that grow from a short one. */
static void steps_of_any_length(void **state) {
    (void)state;
    Ride ride;
    begin(&ride, CPS_TIME_SCHEME_BDF2, 1e5);
    add(&ride, (Motion){.turn = {0, 0, 1}, .duration = 2, .steps = 2, .error = 1e-4});
    add(&ride, (Motion){.turn = {0, 0, -6}, .duration = 3, .steps = 4, .error = 1e-3});
    go(&ride, "table, error");
    time_report("table, error", "steps of another length", 28, ride.lengths);
    CHECK_GREATER(ride.lengths, 4);
}

/* A drum that turns about its own axis, to and fro, with a rope along its top or round it; and one
 * that is carried along, and turned, meanwhile. */
static void a_drum_turns(void **state) {
    (void)state;
    for (int around = 0; around < 2; around++)
        for (int k = 1; k <= 4; k *= 2) {
            Ride ride;
            char name[40];
            begin(&ride, CPS_TIME_SCHEME_BDF2, 10);
            lay_on_drum(&ride, 0.7, around);
            add(&ride, (Motion){.own = 0.6, .duration = 1, .steps = 4 * k});
            add(&ride, (Motion){.own = -1.2, .duration = 1.5, .steps = 9 * k});
            add(&ride, (Motion){.own = 0.3, .duration = 1, .steps = 5 * k});
            snprintf(name, sizeof name, "drum, %s, %.3g rad", around ? "round" : "along", 0.15 / k);
            go(&ride, name);
            begin(&ride, CPS_TIME_SCHEME_BDF2, 10);
            lay_on_drum(&ride, 0.7, around);
            add(&ride, (Motion){.own = 0.5,
                                .by = {0.3, 0.4, 0},
                                .turn = {0, 0, 0.9},
                                .about = {1, 0, 0},
                                .duration = 2,
                                .steps = 6 * k});
            snprintf(name, sizeof name, "drum taken along, %s", around ? "round" : "along");
            go(&ride, name);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_turns_to_and_fro),
        cmocka_unit_test(a_table_goes_aside),
        cmocka_unit_test(a_table_tilts),
        cmocka_unit_test(states_go_on),
        cmocka_unit_test(steps_of_any_length),
        cmocka_unit_test(a_drum_turns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
