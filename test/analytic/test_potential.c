/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines in a potential that the program gives as a function (capstan/loads.h, S90 annexes, U).
 * Along a line at rest without friction T + T^2/(2 EA) - U is the same everywhere, whatever U, for
 * it balances the force along the line. Results are read by the independent checker beside the
 * scene, whose function it calls. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "capstan/results.h"
#include "check.h"
#include "checker.h"
#include "given.h"
#include "sample.h"
#include "splitmix.h"

enum { STAGES = 4, TERMS = 3 };

/* U = sum of c sqrt(1 + |x - p|^2/l^2) + k.x^2/2: convex */
typedef struct Field {
    double size[TERMS], length[TERMS], centre[TERMS][3], stiffness[3];
} Field;

static double evaluate(void *user, const double x[3], double gradient[3], double second[6]) {
    static const int ROW[6] = {0, 0, 1, 0, 1, 2}, COLUMN[6] = {0, 1, 1, 2, 2, 2};
    const Field *field = user;
    double energy = 0;
    memset(gradient, 0, 3 * sizeof *gradient);
    memset(second, 0, 6 * sizeof *second);
    for (int a = 0; a < 3; a++) {
        energy += field->stiffness[a] * x[a] * x[a] / 2;
        gradient[a] += field->stiffness[a] * x[a];
        second[a == 0 ? 0 : a == 1 ? 2 : 5] += field->stiffness[a];
    }
    for (int i = 0; i < TERMS; i++) {
        const double c = field->size[i], l = field->length[i];
        double d[3], root = 1;
        if (c == 0) continue;
        for (int a = 0; a < 3; a++) {
            d[a] = (x[a] - field->centre[i][a]) / l;
            root += d[a] * d[a];
        }
        root = sqrt(root);
        energy += c * root;
        for (int a = 0; a < 3; a++) gradient[a] += c * d[a] / (root * l);
        for (int k = 0; k < 6; k++)
            second[k] += c / (l * l * root) *
                         ((ROW[k] == COLUMN[k]) - d[ROW[k]] * d[COLUMN[k]] / (root * root));
    }
    return energy;
}

typedef struct Case {
    CpsScene scene;
    CpsLine line;
    CpsObstacle bed;
    CpsStage stage[STAGES];
    CpsChange change[STAGES];
    CpsLineLoads loads;
    Field field;
} Case;

/* A line between two held ends, which its moves then draw about. */
static void begin(Case *c, int elements, double length, double weight, double stiffness) {
    memset(c, 0, sizeof *c);
    c->scene = cps_scene_default();
    c->line = cps_line_default();
    c->bed = cps_obstacle_default();
    c->line.name = "line";
    c->line.length = length;
    c->line.element_count = elements;
    c->line.weight = weight;
    c->line.stiffness = stiffness;
    c->line.start.kind = CPS_START_STATIC;
    c->line.loads = &c->loads;
    c->loads.potential = (CpsPotential){evaluate, &c->field, 0, length};
    c->bed.name = "bed";
    c->scene.line = &c->line;
    c->scene.line_count = 1;
    c->scene.obstacle = &c->bed;
    c->scene.stage = c->stage;
}

static void hold(Case *c, int end, double x, double y, double z) {
    c->line.end[end] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {x, y, z}};
}

static void stage(Case *c, double x, double y, double z) {
    const int k = c->scene.stage_count++;
    c->stage[k] = cps_stage_default();
    c->stage[k].name = "move";
    c->stage[k].step_count = 2;
    c->stage[k].change = &c->change[k];
    c->stage[k].change_count = 1;
    c->change[k] =
        (CpsChange){.end = CPS_END_B, .to = {.kind = CPS_END_KIND_HELD, .value = {x, y, z}}};
}

static CpsEvolution *made(const Case *c) {
    CpsError err;
    CpsEvolution *evolution = NULL;
    if (cps_evolution_create(&c->scene, &evolution, &err)) fail_msg("%s", err.message);
    return evolution;
}

static CpsOutcome step(CpsEvolution *evolution) {
    CpsError err;
    if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
    return cps_evolution_line_report(evolution, 0).outcome;
}

/* Numbers of the last step, each of which the checker refuses once it is changed. */
static void refuse_changes(const Case *c, const CpsEvolution *evolution, int steps,
                           const char *path) {
    const CpsPotentialView view = cps_evolution_potential(evolution, 0);
    const CpsLineView line = cps_evolution_line_view(evolution, 0);
    const int j = view.node_count / 2;
    const size_t node = (size_t)((steps - 1) * view.node_count + j);
    const struct {
        const char *variable;
        size_t index;
        double value;
    } change[] = {{"line_potential_energy", node, 1.001 * view.energy[j]},
                  {"line_potential_energy", node, NAN},
                  {"line_potential_force", 3 * node, 1.001 * view.force[3 * j]},
                  {"line_potential_force", 3 * node + 2, INFINITY},
                  {"line_node_load", 3 * node + 2, 1.001 * line.node_load[3 * j + 2]},
                  {"line_node_load", 3 * node, line.node_load[3 * j] - view.force[3 * j]},
                  {"line_load_residual", (size_t)(steps - 1), 1}};
    char command[160], copy[80];
    snprintf(copy, sizeof copy, "%s-copy", path);
    for (size_t k = 0; k < sizeof change / sizeof *change; k++) {
        snprintf(command, sizeof command, "cp '%s' '%s'", path, copy);
        assert_int_equal(system(command), 0);
        assert_int_equal(sample_poke(copy, change[k].variable, change[k].index, change[k].value),
                         0);
        if (checker_file(copy, NULL, NULL) == 0 && given_file(copy, &c->scene, NULL) == 0)
            fail_msg("%s = %g is accepted", change[k].variable, change[k].value);
    }
}

/* All steps, written and read by the checker; returns how many are certified. */
static int checked(const Case *c, int *steps, bool changes) {
    char folder[] = "capstan-potential-XXXXXX", path[64], command[80];
    CpsEvolution *evolution = made(c);
    CpsResults *results = NULL;
    CpsError err;
    int certified = 0;
    assert_non_null(mkdtemp(folder));
    if (cps_results_prepare(folder, CPS_RESULTS_KIND_RUN, 0, true, &err) ||
        cps_results_open(folder, &c->scene, evolution, NULL, &results, &err))
        fail_msg("%s", err.message);
    for (*steps = 0; cps_evolution_remaining_count(evolution) > 0; ++*steps) {
        certified += cps_outcome_is_certified(step(evolution));
        assert_int_equal(cps_results_append(results, evolution, &err), CPS_OK);
    }
    assert_int_equal(cps_results_finish(results, 0, &err), CPS_OK);
    snprintf(path, sizeof path, "%s/result.nc", folder);
    CheckerReport report;
    CHECK_INT(checker_file(path, &report, stdout), 0);
    CHECK_INT(report.certified, certified);
    CHECK_INT(given_file(path, &c->scene, stdout), 0);
    if (changes) refuse_changes(c, evolution, *steps, path);
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    assert_int_equal(system(command), 0);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    return certified;
}

/* By how much T + T^2/(2 EA) - U differs along the line, per its largest tension. */
static double unevenness(int elements, double stiffness) {
    Case c;
    begin(&c, elements, 12, 0, stiffness);
    hold(&c, CPS_END_A, -4, 1, 2);
    hold(&c, CPS_END_B, 5, -1, 3);
    c.field = (Field){.size = {40, 25}, .length = {1.5, 0.7}, .centre = {{0, 3, -2}, {4, -3, 0}}};
    CpsEvolution *evolution = made(&c);
    CHECK_INT(step(evolution), CPS_OUTCOME_SOLVED);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    double low = INFINITY, high = -INFINITY, largest = 0;
    for (int e = 0; e < elements; e++) {
        double x[3], gradient[3], second[6];
        for (int a = 0; a < 3; a++)
            x[a] = (view.position[3 * e + a] + view.position[3 * e + 3 + a]) / 2;
        const double T = view.tension[e],
                     value = T + (isfinite(stiffness) ? T * T / (2 * stiffness) : 0) -
                             evaluate(&c.field, x, gradient, second);
        low = fmin(low, value);
        high = fmax(high, value);
        largest = fmax(largest, T);
    }
    cps_evolution_destroy(evolution);
    return (high - low) / largest;
}

static void tension_follows_the_potential(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        const double stiffness = k == 0 ? 2000 : INFINITY;
        double before = 0;
        for (int n = 40; n <= 320; n *= 2) {
            const double now = unevenness(n, stiffness);
            print_message("EA %g, %d elements: uneven by %.2e of the tension\n", stiffness, n, now);
            if (n > 40) CHECK_BETWEEN(log2(before / now), 1.8, 2.2);
            before = now;
        }
        CHECK_LESS(before, 2e-4);
    }
}

/* A line of 10 m that hangs onto the bed, and is moved over it. */
static void begin_on_the_bed(Case *c, int elements, double weight, double friction) {
    begin(c, elements, 10, weight, 5000);
    c->scene.obstacle_count = 1;
    c->bed.friction = friction;
    hold(c, CPS_END_A, 0, 0, 0.3);
    hold(c, CPS_END_B, 8, 0, 0.5);
    stage(c, 8.5, 1.5, 0.4);
    stage(c, 7, 0.5, 0.6);
}

/* A quadratic function is springs. */
static void quadratic_function_is_springs(void **state) {
    (void)state;
    Case c;
    begin_on_the_bed(&c, 60, 20, 0.3);
    c.field = (Field){.stiffness = {3, 60, 8}};
    CpsSpring spring = {.from = 2, .to = 7, .stiffness = {3, 60, 8}};
    const CpsLineLoads springs = {.spring_count = 1, .spring = &spring};
    c.loads.potential.from = spring.from;
    c.loads.potential.to = spring.to;
    CpsEvolution *one = made(&c);
    c.line.loads = &springs;
    CpsEvolution *other = made(&c);
    double off = 0;
    while (cps_evolution_remaining_count(one) > 0) {
        CHECK_INT(step(one), CPS_OUTCOME_SOLVED);
        CHECK_INT(step(other), CPS_OUTCOME_SOLVED);
        const CpsLineView a = cps_evolution_line_view(one, 0),
                          b = cps_evolution_line_view(other, 0);
        for (int i = 0; i < 3 * 61; i++) off = fmax(off, fabs(a.position[i] - b.position[i]));
        const CpsLedger mine = cps_evolution_line_report(one, 0).ledger,
                        its = cps_evolution_line_report(other, 0).ledger;
        /* two ways to the same solution, each as good as its certificate */
        CHECK_NEAR(mine.loads, its.loads, 1e-7 * fabs(its.loads));
        CHECK_NEAR(mine.dissipated, its.dissipated, 1e-7 * fabs(its.loads));
    }
    print_message("places differ by %.1e m\n", off);
    CHECK_LESS(off, 1e-7 * c.line.length);
    cps_evolution_destroy(one);
    cps_evolution_destroy(other);
}

/* Fields and lines at random, on a rough bed or not, far from the origin or not. */
static void random_fields_are_certified(void **state) {
    (void)state;
    int steps = 0, certified = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        uint64_t dice = seed;
        Case c;
        const double size = pow(10, splitmix(&dice, -1, 2)),
                     weight = splitmix(&dice, 0, 1) < 0.2 ? 0 : pow(10, splitmix(&dice, -1, 2)),
                     load = fmax(1, weight), far = splitmix(&dice, 0, 1) < 0.2 ? 1e4 : 0,
                     EA = splitmix(&dice, 0, 1) < 0.3
                              ? INFINITY
                              : load * size * pow(10, splitmix(&dice, 2, 5));
        begin(&c, 20 + (int)splitmix(&dice, 0, 60), size, weight, EA);
        for (int i = 0; i < TERMS; i++) {
            c.field.length[i] = size * pow(10, splitmix(&dice, -1, 0.5));
            c.field.size[i] = load * c.field.length[i] * pow(10, splitmix(&dice, -1.5, 0.5));
            for (int a = 0; a < 3; a++)
                c.field.centre[i][a] = size * (splitmix(&dice, -1, 1) + (a == 0 ? far : 0));
        }
        c.scene.obstacle_count = splitmix(&dice, 0, 1) < 0.6 ? 1 : 0;
        c.bed.friction = splitmix(&dice, 0, 1);
        c.bed.point[2] = -0.1 * size;
        const double x = far * size;
        hold(&c, CPS_END_A, x - 0.4 * size, 0, 0);
        hold(&c, CPS_END_B, x + 0.4 * size, 0, 0.1 * size);
        for (int k = 0; k < STAGES; k++) {
            const double up = splitmix(&dice, 0, 0.2) * size,
                         across = splitmix(&dice, -0.2, 0.2) * size,
                         along = splitmix(&dice, 0.2, 0.5) * size;
            stage(&c, x + along, across, up);
        }
        if (splitmix(&dice, 0, 1) < 0.3) c.loads.potential.to = 0.6 * size;
        const CpsCurrentRow row[2] = {{-size, {0.1, 0.3, 0}}, {size, {0.2, -0.1, 0}}};
        const CpsCurrent current = {.density = load, .row_count = 2, .row = row};
        const CpsSpring spring = {.to = size / 2, .stiffness = {0, load / size, 0}};
        const CpsLineForce force = {.to = size, .force = {0, 0.2 * load, 0.1 * load}};
        if (splitmix(&dice, 0, 1) < 0.3) {
            c.scene.current = &current;
            c.loads.drag = (CpsDrag){.diameter = 1, .normal = 1.2, .tangential = 0.1};
        }
        if (splitmix(&dice, 0, 1) < 0.3) {
            c.loads.spring = &spring;
            c.loads.spring_count = 1;
        }
        if (splitmix(&dice, 0, 1) < 0.3) {
            c.loads.force = &force;
            c.loads.force_count = 1;
        }
        if (splitmix(&dice, 0, 1) < 0.2) c.scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
        int own;
        const int good = checked(&c, &own, seed == 4);
        if (good < own) print_message("seed %d: %d of %d steps certified\n", (int)seed, good, own);
        steps += own;
        certified += good;
    }
    print_message("%d of %d steps certified\n", certified, steps);
    CHECK_GREATER(certified, 0.99 * steps - 1);
}

static double concave(void *user, const double x[3], double gradient[3], double second[6]) {
    memset(gradient, 0, 3 * sizeof *gradient);
    memset(second, 0, 6 * sizeof *second);
    gradient[2] = -10 * x[2];
    second[5] = -10;
    return *(const double *)user - 5 * x[2] * x[2];
}

static double undefined(void *user, const double x[3], double gradient[3], double second[6]) {
    (void)user;
    const double energy = sqrt(-1 - x[0] * x[0]);
    for (int a = 0; a < 3; a++) gradient[a] = energy;
    for (int k = 0; k < 6; k++) second[k] = energy;
    return energy;
}

/* What is concave or not finite is not certified, and nothing that is not finite comes out. */
static void senseless_functions_are_not_certified(void **state) {
    (void)state;
    CpsPotentialFunction *const function[] = {concave, undefined};
    double base = 1;
    for (int k = 0; k < 2; k++) {
        Case c;
        begin(&c, 20, 10, 3, 5000);
        hold(&c, CPS_END_A, 0, 0, 0);
        hold(&c, CPS_END_B, 9, 0, 1);
        c.loads.potential.function = function[k];
        c.loads.potential.user = &base;
        CpsEvolution *evolution = made(&c);
        assert_false(cps_outcome_is_certified(step(evolution)));
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        for (int i = 0; i < 3 * 21; i++) CHECK_FINITE(view.position[i]);
        CHECK_FINITE(cps_evolution_line_report(evolution, 0).certificate.load_residual);
        CHECK_FINITE(cps_evolution_potential(evolution, 0).total);
        cps_evolution_destroy(evolution);
    }
}

static void state_goes_on_with_the_same_bits(void **state) {
    (void)state;
    Case c;
    begin_on_the_bed(&c, 40, 5, 0.4);
    c.field = (Field){.size = {10}, .length = {2}, .centre = {{4, 3, 0}}};
    CpsEvolution *one = made(&c), *other = made(&c);
    CpsError err;
    for (int k = 0; k < 2; k++) step(one);
    void *data = NULL;
    size_t size = cps_evolution_state_size(one);
    data = malloc(size);
    assert_non_null(data);
    cps_evolution_save(one, data);
    assert_int_equal(cps_evolution_load(other, data, size, &err), CPS_OK);
    while (cps_evolution_remaining_count(one) > 0) {
        step(one);
        step(other);
        const CpsLineView a = cps_evolution_line_view(one, 0),
                          b = cps_evolution_line_view(other, 0);
        assert_memory_equal(a.position, b.position, 3 * 41 * sizeof(double));
        assert_memory_equal(a.tension, b.tension, 40 * sizeof(double));
        const CpsPotentialView p = cps_evolution_potential(one, 0),
                               q = cps_evolution_potential(other, 0);
        assert_memory_equal(p.force, q.force, 3 * 41 * sizeof(double));
        assert_memory_equal(p.energy, q.energy, 41 * sizeof(double));
    }
    /* another function is another scene */
    c.field.size[0] = 11;
    CpsEvolution *third = made(&c);
    assert_int_not_equal(cps_evolution_load(third, data, size, &err), CPS_OK);
    free(data);
    cps_evolution_destroy(one);
    cps_evolution_destroy(other);
    cps_evolution_destroy(third);
}

static void misplaced_ones_are_refused(void **state) {
    (void)state;
    Case c;
    CpsEvolution *evolution = NULL;
    CpsError err;
    const double piece[][2] = {{-1, 5}, {5, 5}, {2, 11}, {0, NAN}};
    begin(&c, 20, 10, 3, 5000);
    hold(&c, CPS_END_A, 0, 0, 0);
    hold(&c, CPS_END_B, 9, 0, 1);
    for (int k = 0; k < 4; k++) {
        c.loads.potential.from = piece[k][0];
        c.loads.potential.to = piece[k][1];
        assert_int_equal(cps_evolution_create(&c.scene, &evolution, &err), CPS_ERR_ARGUMENT);
        assert_non_null(strstr(err.message, "line 'line': potential: it goes from"));
    }
    c.loads.potential.from = 0;
    c.loads.potential.to = 10;
    stage(&c, 8, 0, 1);
    c.stage[0].duration = 1;
    assert_int_equal(cps_evolution_create(&c.scene, &evolution, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "a potential is that of lines at rest"));
    CpsPoint knot = cps_point_default();
    knot.name = "knot";
    knot.kind = CPS_POINT_KIND_FREE;
    knot.position[0] = 9;
    c.scene.stage_count = 0;
    c.scene.point = &knot;
    c.scene.point_count = 1;
    c.line.end[CPS_END_B].kind = CPS_END_KIND_POINT;
    c.line.stiffness = INFINITY;
    assert_int_equal(cps_evolution_create(&c.scene, &evolution, &err), CPS_ERR_ARGUMENT);
    if (!strstr(err.message, "end B is at a point, and the line is inextensible"))
        fail_msg("%s", err.message);
}

/* A line cut in two at a node, where a free point joins the pieces: in the scene that has the
 * pieces, of which each has its part of the potential. */
typedef struct Pieces {
    CpsScene scene;
    CpsLine line[2];
    CpsLineLoads loads[2];
    CpsPoint knot;
    CpsChange change[STAGES];
    CpsStage stage[STAGES];
} Pieces;

static void cut(const Case *c, int node, Pieces *out) {
    const double element = c->line.length / c->line.element_count, at = element * node;
    const CpsPotential *whole = &c->loads.potential;
    out->scene = c->scene;
    out->knot = cps_point_default();
    out->knot.name = "knot";
    out->knot.kind = CPS_POINT_KIND_FREE;
    for (int a = 0; a < 3; a++)
        out->knot.position[a] =
            c->line.end[0].value[a] +
            at / c->line.length * (c->line.end[1].value[a] - c->line.end[0].value[a]);
    for (int i = 0; i < 2; i++) {
        CpsLine *piece = &out->line[i];
        CpsPotential *part = &out->loads[i].potential;
        *piece = c->line;
        piece->name = i == 0 ? "one" : "two";
        piece->element_count = i == 0 ? node : c->line.element_count - node;
        piece->length = element * piece->element_count;
        piece->end[1 - i] = (CpsEnd){.kind = CPS_END_KIND_POINT};
        piece->end_point[1 - i] = 0;
        out->loads[i] = c->loads;
        part->from = fmin(fmax(whole->from - i * at, 0), piece->length);
        part->to = fmin(fmax(whole->to - i * at, 0), piece->length);
        if (!(part->from < part->to)) part->function = NULL;
        piece->loads = &out->loads[i];
    }
    for (int k = 0; k < c->scene.stage_count; k++) {
        out->change[k] = c->change[k];
        out->change[k].line = 1;
        out->stage[k] = c->stage[k];
        out->stage[k].change = &out->change[k];
    }
    out->scene.line = out->line;
    out->scene.line_count = 2;
    out->scene.point = &out->knot;
    out->scene.point_count = 1;
    out->scene.stage = out->stage;
}

/* [-] How far the pieces are from the line, per its length; the force on the point per the largest.
 */
static double apart_in_steps(const Case *c, int node, int *steps) {
    static Pieces pieces;
    cut(c, node, &pieces);
    CpsError err;
    CpsEvolution *whole = made(c), *parts = NULL;
    if (cps_evolution_create(&pieces.scene, &parts, &err)) fail_msg("%s", err.message);
    double off = 0;
    while (cps_evolution_remaining_count(whole) > 0) {
        const CpsOutcome one = step(whole), other = step(parts);
        if (!cps_outcome_is_certified(one) || !cps_outcome_is_certified(other)) {
            print_message("step %d: outcomes %d and %d\n", *steps, one, other);
            break;
        }
        const CpsLineView a = cps_evolution_line_view(whole, 0);
        for (int i = 0; i < 2; i++) {
            const CpsLineView b = cps_evolution_line_view(parts, i);
            const double *from = &a.position[i == 0 ? 0 : 3 * node];
            for (int k = 0; k < 3 * (pieces.line[i].element_count + 1); k++)
                off = fmax(off, fabs(from[k] - b.position[k] + a.origin[k % 3] - b.origin[k % 3]) /
                                    c->line.length);
        }
        const CpsPointReport knot = cps_evolution_point_report(parts, 0);
        const double largest = cps_evolution_line_report(whole, 0).certificate.largest_force;
        assert_true(knot.has_place);
        for (int k = 0; k < 3; k++) CHECK_LESS(fabs(knot.residual[k]), 1e-6 * largest);
        ++*steps;
    }
    cps_evolution_destroy(whole);
    cps_evolution_destroy(parts);
    return off;
}

/* A point between two pieces of a line in a potential is where the node of the line is; all steps
 * are certified, also on a rough bed. Places are compared where they are unique: without friction,
 * and in the potential all along where the line may lie on the bed. */
static void pieces_at_a_point_are_the_line(void **state) {
    (void)state;
    double off = 0;
    int steps = 0, due = 0, compared = 0;
    for (uint64_t seed = 1; seed <= 100; seed++) {
        uint64_t dice = seed;
        Case c;
        const double size = pow(10, splitmix(&dice, -1, 2)), load = pow(10, splitmix(&dice, -1, 2)),
                     far = splitmix(&dice, 0, 1) < 0.2 ? 1e3 : 0;
        const int elements = 8 + (int)splitmix(&dice, 0, 30);
        const double EA = load * size * pow(10, splitmix(&dice, 1.5, 4)),
                     weight = splitmix(&dice, 0, 1) < 0.2 ? 0 : load;
        begin(&c, elements, size, weight, EA);
        for (int i = 0; i < TERMS; i++) {
            c.field.length[i] = size * pow(10, splitmix(&dice, -0.5, 0.5));
            c.field.size[i] = load * c.field.length[i] * pow(10, splitmix(&dice, -1, 0.3));
            for (int a = 0; a < 3; a++)
                c.field.centre[i][a] = size * (splitmix(&dice, -1, 1) + (a == 0 ? far : 0));
        }
        c.scene.obstacle_count = splitmix(&dice, 0, 1) < 0.4 ? 1 : 0;
        c.bed.point[2] = -0.1 * size;
        c.bed.friction = splitmix(&dice, 0, 1) < 0.5 ? splitmix(&dice, 0, 0.5) : 0;
        const double x = far * size;
        hold(&c, CPS_END_A, x - 0.4 * size, 0, 0);
        hold(&c, CPS_END_B, x + 0.4 * size, 0, 0.1 * size);
        for (int k = 0; k < 2; k++) {
            const double up = splitmix(&dice, 0, 0.2) * size,
                         across = splitmix(&dice, -0.2, 0.2) * size,
                         along = splitmix(&dice, 0.2, 0.5) * size;
            stage(&c, x + along, across, up);
        }
        if (splitmix(&dice, 0, 1) < 0.4) c.loads.potential.to = splitmix(&dice, 0.1, 1) * size;
        if (splitmix(&dice, 0, 1) < 0.3) c.loads.potential.from = 0.09 * size;
        const int before = steps, node = 1 + (int)splitmix(&dice, 0, elements - 2);
        const double now = apart_in_steps(&c, node, &steps);
        const bool whole = c.loads.potential.from == 0 && c.loads.potential.to == size,
                   unique = c.scene.obstacle_count == 0 || (c.bed.friction == 0 && whole);
        due += 5;
        compared += unique ? steps - before : 0;
        if (steps < before + 5 || (unique && now > 1e-7))
            print_message("seed %d: %d steps, %.1e apart\n", (int)seed, steps - before, now);
        if (unique) off = fmax(off, now);
    }
    print_message("pieces at a point: %d of %d steps certified; in %d at most %.1e of the length "
                  "apart\n",
                  steps, due, compared, off);
    CHECK_LESS(off, 1e-7);
    CHECK_GREATER(compared, 200);
    CHECK_GREATER(steps, 0.99 * due - 1);
}

/* The stiffness of an end in a quadratic function is that in its springs, end node included. */
static void stiffness_has_the_second_derivatives(void **state) {
    (void)state;
    Case c;
    begin(&c, 30, 10, 20, 5000);
    hold(&c, CPS_END_A, 0, 0, 0.3);
    hold(&c, CPS_END_B, 8, 0, 0.5);
    c.field = (Field){.stiffness = {3, 60, 8}};
    CpsSpring spring = {.to = 10, .stiffness = {3, 60, 8}};
    const CpsLineLoads springs = {.spring_count = 1, .spring = &spring};
    CpsEvolution *one = made(&c);
    c.line.loads = &springs;
    CpsEvolution *other = made(&c);
    CHECK_INT(step(one), CPS_OUTCOME_SOLVED);
    CHECK_INT(step(other), CPS_OUTCOME_SOLVED);
    CpsError err;
    CpsStiffness mine, its;
    assert_int_equal(cps_evolution_stiffness(one, 0, CPS_END_B, CPS_STIFFNESS_STEP, &mine, &err),
                     CPS_OK);
    assert_int_equal(cps_evolution_stiffness(other, 0, CPS_END_B, CPS_STIFFNESS_STEP, &its, &err),
                     CPS_OK);
    CHECK_INT(mine.outcome, CPS_STIFFNESS_OUTCOME_FOUND);
    CHECK_INT(its.outcome, CPS_STIFFNESS_OUTCOME_FOUND);
    for (int i = 0; i < 9; i++) CHECK_NEAR(mine.matrix[i], its.matrix[i], 1e-6 * its.matrix[0]);
    cps_evolution_destroy(one);
    cps_evolution_destroy(other);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(tension_follows_the_potential),
                                       cmocka_unit_test(quadratic_function_is_springs),
                                       cmocka_unit_test(random_fields_are_certified),
                                       cmocka_unit_test(senseless_functions_are_not_certified),
                                       cmocka_unit_test(state_goes_on_with_the_same_bits),
                                       cmocka_unit_test(misplaced_ones_are_refused),
                                       cmocka_unit_test(pieces_at_a_point_are_the_line),
                                       cmocka_unit_test(stiffness_has_the_second_derivatives)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
