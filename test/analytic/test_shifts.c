/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that are shifted.
 *
 * A belt that is drawn away under a rope pulls it with mu times its weight. A cylinder that pushes
 * a weightless string aside stretches it to the length of two tangents and an arc; the work of the
 * push is the string's energy. What moves as a whole changes its place and nothing else, and an
 * obstacle that moves while the ends stay is, seen from the obstacle, one that stays while the ends
 * move back: both are compared on random ropes over a bed and a bollard. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"
#include "splitmix.h"
#include "straight_rope.h"

static const double LENGTH = 6;
enum { N = 80, SEEDS = 60, MOVES = 8 };

static CpsObstacle bed(double friction) {
    CpsObstacle plane = cps_obstacle_default();
    plane.name = "bed";
    plane.friction = friction;
    plane.moves = true;
    return plane;
}

/* Upright, its axis through (x, y). */
static CpsObstacle bollard(double x, double y, double radius, double friction) {
    CpsObstacle post = cps_obstacle_default();
    post.name = "bollard";
    post.kind = CPS_OBSTACLE_CYLINDER;
    post.axis[1] = 0;
    post.axis[2] = 1;
    post.point[0] = x;
    post.point[1] = y;
    post.radius = radius;
    post.friction = friction;
    post.moves = true;
    return post;
}

/* A rope along x, its nodes at `stretch` of their natural distances; end B held or not. */
static CpsEvolution *rope(double weight, double stiffness, double stretch, bool held, int obstacles,
                          const CpsObstacle *obstacle) {
    double point[3 * (N + 1)] = {0};
    for (int j = 0; j <= N; j++) point[3 * j] = stretch * LENGTH * j / N;
    CpsLine line = straight_rope(point, LENGTH, N, weight, stiffness);
    line.start.kind = CPS_START_NODES;
    line.start.point_count = N + 1;
    if (held) line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {stretch * LENGTH, 0, 0}};
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = obstacles;
    scene.obstacle = obstacle;
    scene.line_count = 1;
    scene.line = &line;
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

static CpsStatus shift(CpsEvolution *evolution, int obstacle, double x, double y, double z,
                       CpsError *err) {
    const CpsShift by = {.obstacle = obstacle, .by = {x, y, z}};
    CpsStage move = cps_stage_default();
    move.shift_count = 1;
    move.shift = &by;
    return cps_evolution_move(evolution, &move, err);
}

static void expect(CpsEvolution *evolution, int obstacle, double x, double y, double z) {
    CpsError err;
    if (shift(evolution, obstacle, x, y, z, &err) != CPS_OK) fail_msg("%s", err.message);
    CHECK_INT((int)cps_evolution_report(evolution).outcome, (int)CPS_OUTCOME_SOLVED);
}

static void a_belt_pulls_with_mu_times_the_weight(void **state) {
    (void)state;
    const double mu = 0.3, weight = 10, stiffness[] = {1e4, INFINITY};
    const CpsObstacle belt = bed(mu);
    for (int k = 0; k < 2; k++) {
        CpsEvolution *evolution = rope(weight, stiffness[k], 1, false, 1, &belt);
        expect(evolution, 0, 0.5, 0, 0);
        CpsLineView view = cps_evolution_line_view(evolution, 0);
        /* all but the half element at the held end, which is the support's and the belt's */
        CHECK_RELATIVE(view.tension[0], mu * weight * LENGTH * (1 - 0.5 / N), 1e-7);
        const CpsObstacleReport place = cps_evolution_obstacle_report(evolution, 0);
        CHECK_VECTOR(place.point, ((double[]){0.5, 0, 0}), 0);
        CHECK_VECTOR(place.by, ((double[]){0.5, 0, 0}), 0);
        CHECK_VECTOR(place.axis, ((double[]){0, 0, 1}), 0);
        CpsLedger ledger = cps_evolution_report(evolution).ledger;
        CHECK_NEAR(ledger.ends, 0, 1e-12);
        /* the belt slips below nearly all of it by nearly half a metre */
        CHECK_RELATIVE(ledger.obstacles, mu * weight * LENGTH * 0.5, 0.02);
        CHECK_RELATIVE(ledger.dissipated, ledger.obstacles, 0.02);
        /* drawn back, it takes the rope along; beside the end that is held a quarter of a metre is
         * folded over and trails behind that */
        expect(evolution, 0, -0.5, 0, 0);
        view = cps_evolution_line_view(evolution, 0);
        CHECK_NEAR(view.tension[0], mu * weight * 0.25, mu * weight * LENGTH / N);
        CHECK_NEAR(view.position[3 * N] - LENGTH, -0.5, 0.01);
        cps_evolution_destroy(evolution);
    }
}

/* [m] Two tangents from ends 2 a apart to a circle whose axis is `in` - radius beyond their line,
 * and the arc between. */
static double length_round(double a, double radius, double in) {
    const double d = in - radius, far = hypot(a, d), tangent = sqrt(far * far - radius * radius);
    const double turn = atan2(d, a) + asin(radius / far);
    return 2 * (tangent + radius * turn);
}

static void a_cylinder_pushes_a_string_aside(void **state) {
    (void)state;
    const double ea = 1000, radius = 0.4, a = 0.5 * LENGTH;
    double open[2] = {0};
    for (int fine = 0; fine < 2; fine++) {
        const CpsObstacle post = bollard(a, -radius, radius, 0);
        CpsEvolution *evolution = rope(0, ea, 1, true, 1, &post);
        const int steps = fine ? 24 : 6;
        double work = 0, energy = 0;
        for (int k = 1; k <= steps; k++) {
            const double in = 1.2 * k / steps;
            expect(evolution, 0, 0, 1.2 / steps, 0);
            const CpsLineView view = cps_evolution_line_view(evolution, 0);
            const double strain = length_round(a, radius, in) / LENGTH - 1;
            /* chords of 7.5 cm go round a radius of 40 cm */
            CHECK_RELATIVE(view.tension[0], ea * strain, 5e-3);
            CHECK_GREATER(view.position[3 * (N / 2) + 1], in - 1e-2);
            const CpsLedger ledger = cps_evolution_report(evolution).ledger;
            work += ledger.obstacles;
            energy += ledger.elastic;
            CHECK_NEAR(ledger.ends, 0, 1e-12);
        }
        open[fine] = fabs(work / energy - 1);
        cps_evolution_destroy(evolution);
    }
    CHECK_LESS(open[0], 0.1);
    CHECK_LESS(open[1], 0.3 * open[0] + 1e-3);
}

static void it_does_not_jump_over_a_line(void **state) {
    (void)state;
    /* by twelve radii in one move, through where the string was */
    const double radius = 0.1;
    const CpsObstacle post = bollard(0.5 * LENGTH, -0.3, radius, 0.2);
    CpsEvolution *evolution = rope(1, 1000, 1, true, 1, &post);
    expect(evolution, 0, 0, 1.2, 0);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    CHECK_GREATER(view.position[3 * (N / 2) + 1], 0.9);
    CHECK_GREATER(cps_evolution_report(evolution).substep_count, 40);
    cps_evolution_destroy(evolution);
}

static void a_floor_that_rises_lifts_and_one_that_sinks_is_left(void **state) {
    (void)state;
    const CpsObstacle floor = bed(0.2);
    CpsEvolution *evolution = rope(10, 1e5, 0.9, true, 1, &floor);
    const CpsChange up[2] = {{.line = 0, .end = CPS_END_A, .to = {CPS_END_KIND_HELD, {0, 0, 1}}},
                             {.line = 0,
                              .end = CPS_END_B,
                              .to = {CPS_END_KIND_HELD, {0.9 * LENGTH, 0, 1}}}};
    CpsStage move = cps_stage_default();
    move.change_count = 2;
    move.change = up;
    assert_int_equal(cps_evolution_move(evolution, &move, NULL), CPS_OK);
    expect(evolution, 0, 0, 0, -2);
    CHECK_NEAR(cps_evolution_line_report(evolution, 0).grounded, 0, 0);
    expect(evolution, 0, 0, 0, 2.8);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    double least = INFINITY;
    for (int j = 0; j <= N; j++) least = fmin(least, view.position[3 * j + 2]);
    CHECK_NEAR(least, 0.8, 1e-8);
    CHECK_GREATER(cps_evolution_line_report(evolution, 0).grounded, 1);
    /* the ends are at 1 m */
    CpsError err;
    CHECK_INT((int)shift(evolution, 0, 0, 0, 0.5, &err), (int)CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "in the way of obstacle 'bed'"));
    expect(evolution, 0, 0, 0, 0.1);
    cps_evolution_destroy(evolution);
}

/* ---- invariance ---- */

typedef struct Random {
    CpsObstacle obstacle[2];
    double weight, stiffness, slack;
    int count;
} Random;

static Random draw(uint64_t *s) {
    Random r = {.weight = splitmix(s, 2, 20), .count = 2};
    r.slack = splitmix(s, 0.85, 0.98);
    r.stiffness = splitmix(s, 0, 1) < 0.3 ? INFINITY : 5000;
    r.obstacle[0] = bed(splitmix(s, 0.1, 0.8));
    const double friction = splitmix(s, 0, 0.5), radius = splitmix(s, 0.15, 0.35),
                 away = splitmix(s, 0.5, 0.8), side = splitmix(s, 0, 1) < 0.5 ? 1 : -1;
    r.obstacle[1] = bollard(splitmix(s, 2, 4), away * side, radius, friction);
    return r;
}

/* A move of both ends, and of both obstacles. */
static CpsOutcome go(CpsEvolution *evolution, const double a[3], const double b[3],
                     const double by[3]) {
    const CpsChange end[2] = {
        {.line = 0, .end = CPS_END_A, .to = {CPS_END_KIND_HELD, {a[0], a[1], a[2]}}},
        {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {b[0], b[1], b[2]}}}};
    const CpsShift shifts[2] = {{.obstacle = 0, .by = {by[0], by[1], by[2]}},
                                {.obstacle = 1, .by = {by[0], by[1], by[2]}}};
    CpsStage move = cps_stage_default();
    CpsError err;
    move.change_count = move.shift_count = 2;
    move.change = end;
    move.shift = shifts;
    if (cps_evolution_move(evolution, &move, &err) != CPS_OK) fail_msg("%s", err.message);
    return cps_evolution_report(evolution).outcome;
}

/* One evolution whose obstacles move and whose ends go their way, and another as it is seen from
 * the obstacles. In the first kind of history everything moves alike. */
static void compare_frames(bool alike) {
    int steps = 0, certified = 0, compared = 0;
    double apart = 0, tension = 0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        uint64_t s = seed;
        const Random r = draw(&s);
        CpsEvolution *moving = rope(r.weight, r.stiffness, r.slack, true, r.count, r.obstacle),
                     *still = rope(r.weight, r.stiffness, r.slack, true, r.count, r.obstacle);
        double a[3] = {0}, b[3] = {r.slack * LENGTH, 0, 0}, gone[3] = {0};
        bool same = true;
        for (int k = 0; k < MOVES && same; k++) {
            double by[3], there[2][3];
            for (int i = 0; i < 3; i++) {
                by[i] = i < 2 || alike ? splitmix(&s, -0.06, 0.06) : 0;
                gone[i] += by[i];
                if (alike || i == 2) {
                    const double more = i < 2 ? splitmix(&s, -0.05, 0.05) : splitmix(&s, 0, 0.05);
                    a[i] += more;
                    b[i] -= i < 2 ? more : 0;
                } else {
                    a[i] -= by[i];
                    b[i] -= by[i];
                }
                there[0][i] = a[i] + gone[i];
                there[1][i] = b[i] + gone[i];
            }
            static const double none[3] = {0};
            const CpsOutcome one = go(moving, there[0], there[1], by),
                             other = go(still, a, b, none);
            steps++;
            certified += cps_outcome_is_certified(one);
            same = cps_outcome_is_certified(one) && cps_outcome_is_certified(other) &&
                   cps_evolution_report(moving).substep_count == 1 &&
                   cps_evolution_report(still).substep_count == 1 &&
                   cps_evolution_report(moving).places == CPS_PLACES_UNIQUE;
            if (!same) continue;
            const CpsLineView x = cps_evolution_line_view(moving, 0),
                              y = cps_evolution_line_view(still, 0);
            const double force = cps_evolution_report(still).certificate.largest_force;
            for (int i = 0; i < 3 * (N + 1); i++)
                apart = fmax(apart, fabs(x.position[i] - gone[i % 3] - y.position[i]));
            for (int e = 0; e < N; e++)
                tension = fmax(tension, fabs(x.tension[e] - y.tension[e]) / force);
            compared++;
        }
        cps_evolution_destroy(moving);
        cps_evolution_destroy(still);
    }
    print_message("%d of %d steps certified; %d compared: %.1e m, %.1e of the force\n", certified,
                  steps, compared, apart, tension);
    CHECK_GREATER(certified, 0.99 * steps - 1);
    CHECK_GREATER(compared, 60);
    CHECK_LESS(apart, 1e-6);
    CHECK_LESS(tension, 1e-5);
}

static void what_moves_as_a_whole_only_changes_its_place(void **state) {
    (void)state;
    compare_frames(true);
}

static void what_moves_below_ends_that_stay_is_ends_that_move_back(void **state) {
    (void)state;
    compare_frames(false);
}

/* ---- take back, save, refuse ---- */

static void shifts_are_taken_back_and_saved(void **state) {
    (void)state;
    const CpsObstacle belt = bed(0.4);
    CpsEvolution *one = rope(10, 500, 1, false, 1, &belt),
                 *other = rope(10, 500, 1, false, 1, &belt);
    const size_t size = cps_evolution_state_size(one);
    void *bytes = malloc(size);
    for (int k = 0; k < 5; k++) {
        const double by = 0.1 * (k - 2);
        expect(one, 0, by, 0.05, 0);
        expect(other, 0, -by, 0.3, -0.1);
        assert_int_equal(cps_evolution_take_back(other, NULL), CPS_OK);
        cps_evolution_save(other, bytes);
        cps_evolution_destroy(other);
        other = rope(10, 500, 1, false, 1, &belt);
        assert_int_equal(cps_evolution_load(other, bytes, size, NULL), CPS_OK);
        expect(other, 0, by, 0.05, 0);
        const CpsLineView x = cps_evolution_line_view(one, 0),
                          y = cps_evolution_line_view(other, 0);
        assert_memory_equal(x.position, y.position, 3 * (N + 1) * sizeof(double));
        assert_memory_equal(x.tension, y.tension, N * sizeof(double));
    }
    const CpsObstacleReport a = cps_evolution_obstacle_report(one, 0),
                            b = cps_evolution_obstacle_report(other, 0),
                            none = cps_evolution_obstacle_report(one, 1);
    assert_memory_equal(&a, &b, sizeof a);
    CHECK_INT(cps_evolution_obstacle_count(one), 1);
    CHECK_VECTOR(none.axis, ((double[]){0, 0, 0}), 0);
    CpsError err;
    CHECK_INT((int)shift(one, 1, 0, 0, 0, &err), (int)CPS_ERR_ARGUMENT);
    CHECK_INT((int)shift(one, 0, NAN, 0, 0, &err), (int)CPS_ERR_ARGUMENT);
    cps_evolution_destroy(one);
    cps_evolution_destroy(other);
    CpsObstacle fixed = belt;
    fixed.moves = false;
    one = rope(10, 500, 1, false, 1, &fixed);
    assert_true(cps_evolution_state_size(one) > 0);
    CHECK_INT((int)shift(one, 0, 1, 0, 0, &err), (int)CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "say that it moves"));
    CHECK_INT((int)cps_evolution_load(one, bytes, size, &err), (int)CPS_ERR_ARGUMENT);
    cps_evolution_destroy(one);
    free(bytes);
}

/* With frozen friction, or contact of the reference alone, a step is about the reference. */
static void it_needs_coulombs_law_and_contact_that_is_reached(void **state) {
    (void)state;
    const double point[6] = {0, 0, 0, LENGTH, 0, 0};
    const CpsLine line = straight_rope(point, LENGTH, N, 1, 10);
    const CpsObstacle belt = bed(0.4);
    CpsScene scene = cps_scene_default();
    CpsError err;
    scene.obstacle_count = scene.line_count = 1;
    scene.obstacle = &belt;
    scene.line = &line;
    CHECK_INT((int)cps_scene_check(&scene, &err), (int)CPS_OK);
    scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    CHECK_INT((int)cps_scene_check(&scene, &err), (int)CPS_ERR_ARGUMENT);
    assert_string_equal(err.where, "obstacles.bed.moves");
    scene.friction_policy = CPS_FRICTION_POLICY_CONSISTENT;
    scene.contact_policy = CPS_CONTACT_POLICY_REFERENCE;
    CHECK_INT((int)cps_scene_check(&scene, &err), (int)CPS_ERR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_belt_pulls_with_mu_times_the_weight),
        cmocka_unit_test(a_cylinder_pushes_a_string_aside),
        cmocka_unit_test(it_does_not_jump_over_a_line),
        cmocka_unit_test(a_floor_that_rises_lifts_and_one_that_sinks_is_left),
        cmocka_unit_test(what_moves_as_a_whole_only_changes_its_place),
        cmocka_unit_test(what_moves_below_ends_that_stay_is_ends_that_move_back),
        cmocka_unit_test(shifts_are_taken_back_and_saved),
        cmocka_unit_test(it_needs_coulombs_law_and_contact_that_is_reached),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
