/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes between the ends that are held, pulled and let go.
 *
 * A line that is held at a node is two lines that are each held there: random histories of both are
 * compared. A weightless string with a load in its middle has the tension P/(2 sin a), and a node
 * of a rope on a rough bed that is drawn along it carries the friction of both sides, mu w times
 * the length that slides. What nothing moves is not changed by being held; the holder bears what
 * the obstacle did. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"
#include "splitmix.h"
#include "straight_rope.h"

static const double LENGTH = 6;
enum { N = 60, LINES = 3, SEEDS = 80 };

static CpsEvolution *make(const CpsScene *scene) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

static CpsObstacle bed(double friction) {
    CpsObstacle plane = cps_obstacle_default();
    plane.name = "bed";
    plane.friction = friction;
    return plane;
}

/* A straight rope from x = 0 to LENGTH `stretch`, its far end held. */
static CpsEvolution *rope(double weight, double stiffness, double stretch, int obstacles,
                          const CpsObstacle *obstacle) {
    double point[3 * (N + 1)] = {0};
    for (int j = 0; j <= N; j++) point[3 * j] = stretch * LENGTH * j / N;
    CpsLine line = straight_rope(point, LENGTH, N, weight, stiffness);
    line.start.kind = CPS_START_NODES;
    line.start.point_count = N + 1;
    line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {stretch * LENGTH, 0, 0}};
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = obstacles;
    scene.obstacle = obstacle;
    scene.line_count = 1;
    scene.line = &line;
    return make(&scene);
}

static CpsStatus change(CpsEvolution *evolution, CpsGraspChange grip, CpsError *err) {
    CpsStage move = cps_stage_default();
    move.grasp_change_count = 1;
    move.grasp_change = &grip;
    return cps_evolution_move(evolution, &move, err);
}

static void expect(CpsEvolution *evolution, CpsGraspChange grip, CpsOutcome outcome) {
    CpsError err;
    if (change(evolution, grip, &err) != CPS_OK) fail_msg("%s", err.message);
    CHECK_INT((int)cps_evolution_report(evolution).outcome, (int)outcome);
}

static CpsGraspChange held(int node, double x, double y, double z) {
    return (CpsGraspChange){.node = node, .kind = CPS_END_KIND_HELD, .value = {x, y, z}};
}

static CpsGraspChange stays(int node) {
    return (CpsGraspChange){.node = node, .kind = CPS_END_KIND_HELD, .stays = true};
}

static CpsGraspChange pulled(int node, double x, double y, double z) {
    return (CpsGraspChange){.node = node, .kind = CPS_END_KIND_FREE, .value = {x, y, z}};
}

static CpsGraspChange let_go(int node) {
    return (CpsGraspChange){.node = node, .kind = CPS_END_KIND_FREE, .at_once = true};
}

static void a_string_with_a_load_in_its_middle(void **state) {
    (void)state;
    const double ea = 1000, load = 3;
    CpsEvolution *evolution = rope(0, ea, 1.01, 0, NULL);
    expect(evolution, pulled(N / 2, 0, 0, -load), CPS_OUTCOME_SOLVED);
    CpsLineView view = cps_evolution_line_view(evolution, 0);
    const double sag = -view.position[3 * (N / 2) + 2], half = 0.5 * 1.01 * LENGTH,
                 long_half = hypot(half, sag), tension = view.tension[0];
    /* gaps of 1e-13 are of second order in the tension */
    CHECK_RELATIVE(tension, load * long_half / (2 * sag), 1e-6);
    CHECK_RELATIVE(tension, ea * (long_half / (0.5 * LENGTH) - 1), 1e-6);
    CHECK_INT(view.grasp_count, 1);
    CHECK_NEAR(view.grasp[0].force[2], -load, 0);
    /* held there, it is the same; let go, the string is straight again */
    expect(evolution, stays(N / 2), CPS_OUTCOME_SOLVED);
    view = cps_evolution_line_view(evolution, 0);
    CHECK_NEAR(view.grasp[0].force[2], -load, 1e-8 * load);
    CHECK_NEAR(view.position[3 * (N / 2) + 2], -sag, 0);
    expect(evolution, pulled(N / 2, 0, 0, 0), CPS_OUTCOME_SOLVED);
    view = cps_evolution_line_view(evolution, 0);
    for (int j = 0; j <= N; j++) CHECK_NEAR(view.position[3 * j + 2], 0, 1e-9);
    expect(evolution, stays(3), CPS_OUTCOME_SOLVED);
    CHECK_INT(cps_evolution_line_view(evolution, 0).grasp_count, 1);
    cps_evolution_destroy(evolution);
}

static void what_is_held_where_it_is_stays_and_bears_what_the_bed_did(void **state) {
    (void)state;
    const double stiffness[] = {500, INFINITY};
    for (int k = 0; k < 2; k++) {
        const CpsObstacle plane = bed(0.4);
        CpsEvolution *evolution = rope(10, stiffness[k], 0.97, 1, &plane);
        /* drawn aside at its middle, so that there is friction */
        expect(evolution, pulled(N / 2, 0, 20, 0), CPS_OUTCOME_SOLVED);
        CpsLineView view = cps_evolution_line_view(evolution, 0);
        double before[3 * (N + 1)], borne[3];
        memcpy(before, view.position, sizeof before);
        const int j = N / 2 + 5;
        for (int a = 0; a < 3; a++)
            borne[a] = view.reaction[j] * view.normal[3 * j + a] + view.friction_force[3 * j + a];
        CHECK_GREATER(borne[2], 0);
        expect(evolution, stays(j), CPS_OUTCOME_SOLVED);
        view = cps_evolution_line_view(evolution, 0);
        for (int i = 0; i < 3 * (N + 1); i++) CHECK_NEAR(view.position[i], before[i], 0);
        CHECK_INT(view.grasp_count, 2);
        CHECK_INT(view.grasp[1].node, j);
        /* the balance of each node is certified to 1e-11 of the largest force */
        CHECK_VECTOR(view.grasp[1].force, borne, 1e-8);
        CHECK_NEAR(view.reaction[j], 0, 0);
        /* let go, the bed bears it again: with the weight of the node upwards */
        expect(evolution, let_go(j), CPS_OUTCOME_SOLVED);
        view = cps_evolution_line_view(evolution, 0);
        CHECK_NEAR(view.reaction[j], 10 * LENGTH / N, 1e-8);
        cps_evolution_destroy(evolution);
    }
}

static void a_node_drawn_along_carries_the_friction_of_both_sides(void **state) {
    (void)state;
    /* u along x: ahead the line goes slack, behind it stretches: T^2 = 2 mu w EA u; the weight of
     * the node itself is the holder's */
    const double mu = 0.3, weight = 10, ea = 1e4;
    const CpsObstacle plane = bed(mu);
    double open[2] = {0}, worked[2] = {0};
    for (int fine = 0; fine < 2; fine++) {
        CpsEvolution *evolution = rope(weight, ea, 1, 1, &plane);
        const int steps = fine ? 16 : 4;
        for (int k = 1; k <= steps; k++) {
            const double u = 0.0008 * k / steps;
            expect(evolution, held(N / 2, 0.5 * LENGTH + u, 0, 0), CPS_OUTCOME_SOLVED);
            const CpsLineView view = cps_evolution_line_view(evolution, 0);
            const double tension = sqrt(2 * mu * weight * ea * u);
            /* the half element beside the node is the holder's */
            CHECK_NEAR(view.tension[N / 2 - 1], tension, mu * weight * LENGTH / N);
            CHECK_NEAR(view.tension[N / 2], 0, mu * weight * LENGTH / N);
            CHECK_NEAR(view.grasp[0].force[0], view.tension[N / 2 - 1] - view.tension[N / 2], 1e-8);
            const CpsLedger ledger = cps_evolution_report(evolution).ledger;
            open[fine] += fabs(ledger.imbalance);
            worked[fine] += ledger.ends;
        }
        /* 2/3 T u, all of it on one side; the half element is a hundredth of it */
        CHECK_RELATIVE(worked[fine], 2.0 / 3 * sqrt(2 * mu * weight * ea * 0.0008) * 0.0008, 0.05);
        cps_evolution_destroy(evolution);
    }
    /* at first order with the steps */
    CHECK_LESS(open[1], 0.4 * open[0]);
}

static void beyond_its_reach_it_is_infeasible_and_the_state_stands(void **state) {
    (void)state;
    CpsEvolution *evolution = rope(10, INFINITY, 0.8, 0, NULL);
    CpsError err;
    expect(evolution, stays(N / 4), CPS_OUTCOME_SOLVED);
    double kept[3 * (N + 1)];
    memcpy(kept, cps_evolution_line_view(evolution, 0).position, sizeof kept);
    /* A quarter of the line is 1.5 m */
    expect(evolution, held(N / 4, 0, 0, 2), CPS_OUTCOME_INFEASIBLE);
    CpsLineReport report = cps_evolution_line_report(evolution, 0);
    CHECK_NEAR(report.proof_length, hypot(0.8 * LENGTH, 2) - 0.75 * LENGTH, 1e-12);
    expect(evolution, stays(N / 4), CPS_OUTCOME_SOLVED);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    for (int i = 0; i < 3 * (N + 1); i++) CHECK_NEAR(view.position[i], kept[i], 0);
    /* a span that is exactly straight, beside one that hangs */
    expect(evolution, held(N / 4, 0.25 * LENGTH, 0, 0), CPS_OUTCOME_TAUT);
    expect(evolution, held(N / 4, 0.24 * LENGTH, 0, 0), CPS_OUTCOME_SOLVED);
    /* what is refused */
    CHECK_INT((int)change(evolution, stays(0), &err), (int)CPS_ERR_ARGUMENT);
    CHECK_INT((int)change(evolution, stays(N), &err), (int)CPS_ERR_ARGUMENT);
    CHECK_INT((int)change(evolution, held(3, NAN, 0, 0), &err), (int)CPS_ERR_ARGUMENT);
    for (int k = 1; k < CPS_MAX_GRASPS; k++)
        expect(evolution, stays(N / 4 + 4 * k), CPS_OUTCOME_SOLVED);
    CHECK_INT((int)change(evolution, stays(2), &err), (int)CPS_ERR_LIMIT);
    expect(evolution, let_go(N / 4 + 4), CPS_OUTCOME_SOLVED);
    expect(evolution, stays(2), CPS_OUTCOME_SOLVED);
    CHECK_INT(cps_evolution_line_view(evolution, 0).grasp_count, CPS_MAX_GRASPS);
    cps_evolution_destroy(evolution);
}

/* ---- one line held at a node, and two lines ---- */

typedef struct Pair {
    double point[LINES][3 * (N + 1)], element[LINES][N];
    CpsLine line[LINES];
    CpsObstacle obstacle[2];
    CpsScene scene;
    int node;
    double place[3][3]; /* of end A, the node, and end B */
} Pair;

/* Line 0 is the whole, 1 and 2 its parts. */
static void draw(Pair *p, uint64_t *s) {
    const bool on_bed = splitmix(s, 0, 1) < 0.7, inextensible = splitmix(s, 0, 1) < 0.4;
    memset(p, 0, sizeof *p);
    p->node = (int)splitmix(s, 2, N - 1);
    const double height = on_bed ? 0 : 3, slack = splitmix(s, 0.7, 0.99);
    double length = 0;
    for (int e = 0; e < N; e++) length += p->element[0][e] = LENGTH / N * splitmix(s, 0.6, 1.4);
    for (int j = 1; j <= N; j++)
        p->point[0][3 * j] = p->point[0][3 * j - 3] + slack * p->element[0][j - 1];
    for (int j = 0; j <= N; j++) p->point[0][3 * j + 2] = height;
    const int from[] = {0, 0, p->node}, to[] = {N, p->node, N};
    const double weight = splitmix(s, 1, 20), stiffness = inextensible ? INFINITY : 3000;
    for (int k = 0; k < LINES; k++) {
        CpsLine *line = &p->line[k];
        if (k > 0) {
            memcpy(p->point[k], &p->point[0][3 * from[k]],
                   3 * (size_t)(to[k] - from[k] + 1) * sizeof(double));
            memcpy(p->element[k], &p->element[0][from[k]],
                   (size_t)(to[k] - from[k]) * sizeof(double));
        }
        *line = straight_rope(p->point[k], 0, to[k] - from[k], weight, stiffness);
        line->name = k == 0 ? "whole" : k == 1 ? "before" : "after";
        for (int e = 0; e < line->element_count; e++) line->length += p->element[k][e];
        line->element_length = p->element[k];
        line->start.kind = CPS_START_NODES;
        line->start.point_count = line->element_count + 1;
        for (int end = 0; end < 2; end++) {
            const double *x = &p->point[k][end ? 3 * line->element_count : 0];
            line->end[end] = (CpsEnd){CPS_END_KIND_HELD, {x[0], x[1], x[2]}};
        }
    }
    memcpy(p->place[0], p->line[0].end[0].value, sizeof p->place[0]);
    memcpy(p->place[1], p->line[1].end[1].value, sizeof p->place[1]);
    memcpy(p->place[2], p->line[0].end[1].value, sizeof p->place[2]);
    p->obstacle[0] = bed(splitmix(s, 0, 1));
    p->obstacle[1] = cps_obstacle_default();
    p->obstacle[1].name = "bollard";
    p->obstacle[1].kind = CPS_OBSTACLE_CYLINDER;
    p->obstacle[1].axis[1] = 0;
    p->obstacle[1].axis[2] = 1;
    p->obstacle[1].point[0] = 0.5 * LENGTH;
    p->obstacle[1].point[1] = 1.5;
    p->obstacle[1].radius = 0.5;
    p->obstacle[1].friction = 0.3;
    p->scene = cps_scene_default();
    p->scene.obstacle_count = on_bed ? 1 + (splitmix(s, 0, 1) < 0.5) : 0;
    p->scene.obstacle = p->obstacle;
    p->scene.line_count = LINES;
    p->scene.line = p->line;
}

static CpsStatus wander(Pair *p, CpsEvolution *evolution, uint64_t *s) {
    for (int i = 0; i < 3; i++) {
        p->place[i][0] += splitmix(s, -0.05, 0.05);
        p->place[i][1] += splitmix(s, -0.1, 0.15);
        p->place[i][2] = fmax(0, p->place[i][2] + splitmix(s, -0.1, 0.1));
    }
    CpsChange end[6];
    const int which[6][2] = {{0, 0}, {0, 2}, {1, 0}, {1, 1}, {2, 1}, {2, 2}};
    for (int i = 0; i < 6; i++) {
        end[i] = (CpsChange){.line = which[i][0], .end = i % 2, .to = {.kind = CPS_END_KIND_HELD}};
        memcpy(end[i].to.value, p->place[which[i][1]], sizeof end[i].to.value);
    }
    const CpsGraspChange grip = held(p->node, p->place[1][0], p->place[1][1], p->place[1][2]);
    CpsStage move = cps_stage_default();
    move.change_count = 6;
    move.change = end;
    move.grasp_change_count = 1;
    move.grasp_change = &grip;
    return cps_evolution_move(evolution, &move, NULL);
}

/* [m] and [-] The largest differences of positions and of tensions over the largest force. */
static void compare(const Pair *p, const CpsEvolution *evolution, double *apart, double *tension) {
    const CpsLineView whole = cps_evolution_line_view(evolution, 0);
    const double force = cps_evolution_report(evolution).certificate.largest_force;
    *apart = *tension = 0;
    for (int k = 1; k < LINES; k++) {
        const CpsLineView part = cps_evolution_line_view(evolution, k);
        const int from = k == 1 ? 0 : p->node;
        for (int i = 0; i < 3 * (part.element_count + 1); i++)
            *apart = fmax(*apart, fabs(part.position[i] - whole.position[3 * from + i]));
        for (int e = 0; e < part.element_count; e++)
            *tension = fmax(*tension, fabs(part.tension[e] - whole.tension[from + e]) / force);
    }
}

static void a_line_held_at_a_node_is_two_lines(void **state) {
    (void)state;
    int compared = 0, solved = 0, steps = 0;
    double apart = 0, tension = 0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        uint64_t s = seed;
        Pair p;
        draw(&p, &s);
        CpsEvolution *evolution = make(&p.scene);
        expect(evolution, stays(p.node), CPS_OUTCOME_SOLVED);
        bool same = true;
        for (int i = 0; i < 12; i++) {
            double a = 0, t = 0;
            if (wander(&p, evolution, &s) != CPS_OK) continue;
            const CpsStepReport report = cps_evolution_report(evolution);
            steps++;
            CHECK_INT((int)cps_evolution_line_report(evolution, 0).outcome,
                      (int)cps_outcome_worse(cps_evolution_line_report(evolution, 1).outcome,
                                             cps_evolution_line_report(evolution, 2).outcome));
            solved += cps_outcome_is_certified(report.outcome);
            /* the parts of a step are chosen line by line, and forces of an inextensible line at
             * rest need not be unique: then the path differs */
            same = same && cps_outcome_is_certified(report.outcome) && report.substep_count == 1;
            if (!same) break;
            compare(&p, evolution, &a, &t);
            apart = fmax(apart, a);
            if (p.line[0].stiffness < INFINITY) tension = fmax(tension, t);
            compared++;
        }
        cps_evolution_destroy(evolution);
    }
    print_message("%d of %d steps certified; %d compared: %.1e m, %.1e of the tension\n", solved,
                  steps, compared, apart, tension);
    CHECK_GREATER(compared, 250);
    /* positions are found to 1e-9 of the length; tensions to the root of a gap of 1e-13 and more */
    CHECK_LESS(apart, 1e-7);
    CHECK_LESS(tension, 1e-5);
}

/* ---- take back, save, a scene's history ---- */

static void moves_are_taken_back_and_go_on_from_a_saved_state(void **state) {
    (void)state;
    const CpsObstacle plane = bed(0.4);
    CpsEvolution *one = rope(10, 500, 0.9, 1, &plane), *other = rope(10, 500, 0.9, 1, &plane);
    const size_t size = cps_evolution_state_size(one);
    unsigned char *a = malloc(size), *b = malloc(size);
    for (int k = 1; k <= 6; k++) {
        const CpsGraspChange next =
            k == 4 ? let_go(20) : held(20, 0.1 * k + 1.8, 0.05 * k, 0.1 * (k % 3));
        expect(one, next, CPS_OUTCOME_SOLVED);
        /* the other tries another node first, and is copied to a third in between */
        expect(other, held(30 + k, 3, 1, 0.5), CPS_OUTCOME_SOLVED);
        assert_int_equal(cps_evolution_take_back(other, NULL), CPS_OK);
        cps_evolution_save(other, b);
        CpsEvolution *third = rope(10, 500, 0.9, 1, &plane);
        assert_int_equal(cps_evolution_load(third, b, size, NULL), CPS_OK);
        cps_evolution_destroy(other);
        other = third;
        expect(other, next, CPS_OUTCOME_SOLVED);
        const CpsLineView x = cps_evolution_line_view(one, 0),
                          y = cps_evolution_line_view(other, 0);
        assert_memory_equal(x.position, y.position, 3 * (N + 1) * sizeof(double));
        assert_memory_equal(x.tension, y.tension, N * sizeof(double));
        assert_memory_equal(x.grasp, y.grasp, (size_t)x.grasp_count * sizeof *x.grasp);
    }
    /* a state that says nonsense of a grasp is refused */
    cps_evolution_destroy(one);
    cps_evolution_destroy(other);
    free(a);
    free(b);
}

static void a_history_grasps_moves_and_lets_go(void **state) {
    (void)state;
    /* the same far from the origin */
    for (int far = 0; far < 2; far++) {
        const double x = far ? 4e6 : 0;
        double point[3 * (N + 1)] = {0};
        for (int j = 0; j <= N; j++) point[3 * j] = x + 0.9 * LENGTH * j / N;
        CpsLine line = straight_rope(point, LENGTH, N, 10, 500);
        line.start.kind = CPS_START_NODES;
        line.start.point_count = N + 1;
        line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {point[3 * N], 0, 0}};
        const CpsGraspChange grip[] = {held(N / 2, x + 2.7, 0, 1), pulled(N / 2, 0, 0, 0)};
        CpsStage stage[2] = {cps_stage_default(), cps_stage_default()};
        for (int k = 0; k < 2; k++) {
            stage[k].name = k == 0 ? "lift" : "let go";
            stage[k].step_count = 4;
            stage[k].grasp_change_count = 1;
            stage[k].grasp_change = &grip[k];
        }
        const CpsObstacle plane = bed(0.4);
        CpsScene scene = cps_scene_default();
        scene.obstacle_count = 1;
        scene.obstacle = &plane;
        scene.line_count = 1;
        scene.line = &line;
        scene.stage_count = 2;
        scene.stage = stage;
        CpsEvolution *evolution = make(&scene);
        double force = 0;
        for (int k = 1; k <= 8; k++) {
            assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
            assert_true(cps_outcome_is_certified(cps_evolution_report(evolution).outcome));
            const CpsLineView view = cps_evolution_line_view(evolution, 0);
            CHECK_INT(view.grasp_count, 1);
            if (k == 4) {
                force = view.grasp[0].force[2];
                CHECK_NEAR(view.position[3 * (N / 2) + 2], 1, 0);
                CHECK_NEAR(view.position[3 * (N / 2)] + view.origin[0], x + 2.7, 1e-9);
            }
            if (k > 4) CHECK_NEAR(view.grasp[0].force[2], force * (8 - k) / 4, 1e-12 * force);
        }
        CHECK_GREATER(force, 0.3 * 10 * LENGTH);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        for (int j = 0; j <= N; j++) CHECK_NEAR(view.position[3 * j + 2], 0, 1e-8);
        cps_evolution_destroy(evolution);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_string_with_a_load_in_its_middle),
        cmocka_unit_test(what_is_held_where_it_is_stays_and_bears_what_the_bed_did),
        cmocka_unit_test(a_node_drawn_along_carries_the_friction_of_both_sides),
        cmocka_unit_test(beyond_its_reach_it_is_infeasible_and_the_state_stands),
        cmocka_unit_test(a_line_held_at_a_node_is_two_lines),
        cmocka_unit_test(moves_are_taken_back_and_go_on_from_a_saved_state),
        cmocka_unit_test(a_history_grasps_moves_and_lets_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
