/* SPDX-License-Identifier: BSD-3-Clause */
/* Inextensible lines with one long element between held ends, beside a cylinder or a sphere that is
 * in its way: the outcome says that it cannot go round where that is so, and nowhere else; the
 * checker confirms it, and refuses copies with another obstacle, depth, end or element.
 *
 * The line stands on end at A, and B is brought to the side. The depth of the obstacle is set so
 * that the bound of docs/theory.md 5 holds or fails by a small part. Places of the element are
 * tried at random as well: where one is clear of the obstacle there is a configuration. Whether
 * such a step is solved is not asked, so the loop gets two iterations. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "checker.h"
#include "run_scene.h"
#include "sample.h"
#include "splitmix.h"

enum { CASES = 100, SHARES = 2000, TRIES = 3000 };

/* End A at the origin, B at (span, 0, 0); the axis or centre at (x, 0, -below). */
typedef struct Barrier {
    double span, radius, x, below, lean; /* the axis is (lean, 1, 0) */
    double before, length, after;        /* [m] of the elements before, the long one, and after */
    int before_count, after_count;
    bool is_sphere, elastic;
} Barrier;

static double kept(const Barrier *b) {
    return b->radius - fmin(b->length * b->length / (4 * b->radius), b->radius / 4);
}

/* From the axis or centre to x. */
static void spoke(const Barrier *b, const double *x, double *out) {
    const double d[3] = {x[0] - b->x, x[1], x[2] + b->below}, square = b->lean * b->lean + 1,
                 along = b->is_sphere ? 0 : (b->lean * d[0] + d[1]) / square;
    out[0] = d[0] - along * b->lean;
    out[1] = d[1] - along;
    out[2] = d[2];
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The distance of the straight element between two points from the axis or centre. */
static double element_distance(const Barrier *b, const double *from, const double *to) {
    double a[3], d[3], x[3];
    spoke(b, from, a);
    spoke(b, to, d);
    for (int k = 0; k < 3; k++) d[k] -= a[k];
    const double share = fmin(1, fmax(0, -dot(a, d) / dot(d, d)));
    for (int k = 0; k < 3; k++) x[k] = a[k] + share * d[k];
    return sqrt(dot(x, x));
}

/* The bound: the least over the shares of the greatest distance that a point may have. */
static double bound(const Barrier *b) {
    double least = INFINITY;
    for (int i = 0; i <= SHARES; i++) {
        const double share = (double)i / SHARES;
        double x[3];
        spoke(b, (double[3]){share * b->span, 0, 0}, x);
        least = fmin(least, sqrt(dot(x, x)) + (1 - share) * b->before + share * b->after);
    }
    return least;
}

/* Is one of many places of the element clear of the obstacle? Its nodes are where the rest of the
 * line reaches, most of them away from the obstacle. */
static bool goes_round(const Barrier *b, uint64_t *state) {
    for (int i = 0; i < TRIES; i++) {
        double node[2][3] = {{0, 0, 0}, {b->span, 0, 0}}, square = 0;
        const double most = i % 2 ? 1 : 0.1;
        for (int e = 0; e < 2; e++) {
            const double x = splitmix(state, -most, most), y = splitmix(state, -most, most),
                         v[3] = {x, y, 1}, size = sqrt(v[0] * v[0] + v[1] * v[1] + 1);
            for (int k = 0; k < 3; k++) node[e][k] += (e ? b->after : b->before) * v[k] / size;
        }
        for (int k = 0; k < 3; k++) square += pow(node[1][k] - node[0][k], 2);
        if (sqrt(square) <= b->length &&
            element_distance(b, node[0], node[1]) >= kept(b) * (1 + 1e-9))
            return true;
    }
    return false;
}

/* A random barrier whose bound is `kept` times 1 + margin. */
static Barrier random_barrier(uint64_t *state, double margin) {
    for (;;) {
        Barrier b = {.span = pow(10, splitmix(state, -2, 2))};
        b.is_sphere = splitmix(state, 0, 1) < 0.5;
        b.elastic = splitmix(state, 0, 1) < 0.05;
        b.radius = b.span * splitmix(state, 0.05, 0.22);
        b.x = b.span * splitmix(state, 0.35, 0.65);
        b.lean = splitmix(state, -0.3, 0.3);
        b.before_count = (int)splitmix(state, 0, 4);
        b.after_count = (int)splitmix(state, 0, 4);
        b.before = b.before_count ? b.radius * splitmix(state, 0.01, 0.5) : 0;
        b.after = b.after_count ? b.radius * splitmix(state, 0.01, 0.5) : 0;
        b.length = b.span * splitmix(state, 1.0001, 1.3);
        double low = 0, high = b.radius;
        for (int i = 0; i < 60; i++) {
            b.below = (low + high) / 2;
            if (bound(&b) < kept(&b) * (1 + margin))
                low = b.below;
            else
                high = b.below;
        }
        if (low > 0 && high < b.radius) return b;
    }
}

static void write_scene(const Barrier *b) {
    const double length = b->before + b->length + b->after;
    FILE *out = fopen(scene_path, "w");
    assert_non_null(out);
    fprintf(out, "capstan: 1\nsolver: {halvings: 0, max_iterations: 2}\nobstacles:\n"
                 "  far: {plane: {point: [0, 0, -1000], normal: [0, 0, 1]}, friction: 0.2}\n");
    if (b->is_sphere)
        fprintf(out, "  near: {sphere: {centre: [%.17g, 0, %.17g]", b->x, -b->below);
    else
        fprintf(out, "  near: {cylinder: {point: [%.17g, 0, %.17g], axis: [%.17g, 1, 0]", b->x,
                -b->below, b->lean);
    fprintf(out, ", radius: %.17g}, friction: 0.3}\nlines:\n  rope: {length: %.17g, elements: [",
            b->radius, length);
    for (int i = 0; i < b->before_count; i++) fprintf(out, "%.17g, ", b->before / b->before_count);
    fprintf(out, "%.17g", b->length);
    for (int i = 0; i < b->after_count; i++) fprintf(out, ", %.17g", b->after / b->after_count);
    fprintf(out,
            "], weight: 1, stiffness: %s, start: {straight: {from: [0, 0, 0], to: [0, 0, "
            "%.17g]}}, ends: {A: held, B: held}}\n"
            "history:\n  - {name: aside, steps: 1, rope.B: {position: [%.17g, 0, 0]}}\n",
            b->elastic ? "1e6" : ".inf", length, b->span);
    assert_int_equal(fclose(out), 0);
}

static int refused(const char *variable, size_t index, double value) {
    CheckerReport report;
    CHECK_INT(sample_poke(scene_result, variable, index, value), 0);
    (void)checker_file(scene_result, &report, NULL);
    return report.refuted;
}

static void what_cannot_go_round_is_told(void **state) {
    (void)state;
    uint64_t random = 17;
    int found_round = 0, proved = 0, too_short = 0;
    for (int i = 0; i < CASES; i++) {
        const bool blocked = i % 2 == 0;
        const double margin = pow(10, splitmix(&random, -4, -0.7)) * (blocked ? -1 : 1);
        const Barrier b = random_barrier(&random, margin);
        const bool round = goes_round(&b, &random);
        CheckerReport report;
        CHECK_INT(blocked && round, false);
        found_round += round;
        write_scene(&b);
        const CpsLineReport line = run_scene();
        const bool infeasible = line.outcome == CPS_OUTCOME_INFEASIBLE,
                   by_element =
                       infeasible && line.proof[0] == 0 && line.proof[1] == 0 && line.proof[2] == 0;
        if (infeasible != (blocked && !b.elastic) && (round || blocked || by_element))
            print_error("case %d: margin %g, %s, yet %s\n", i, margin, round ? "round" : "",
                        cps_outcome_name(line.outcome));
        if (round || b.elastic) CHECK_INT(infeasible, false);
        if (blocked && !b.elastic) CHECK_INT(infeasible, true);
        if (!blocked) CHECK_INT(by_element, false);
        (void)checker_file(scene_result, &report, stdout);
        CHECK_INT(report.refuted, 0);
        too_short += infeasible && !by_element;
        proved += by_element;
        if (!by_element) continue;
        CHECK_INT(line.proof_obstacle, 1);
        CHECK_LESS(fabs(line.proof_length / (kept(&b) - bound(&b)) - 1), 0.2);
        CHECK_INT(report.certified, 1);
        CHECK_INT(refused("rope_proof_obstacle", 0, 0), 1);
        CHECK_INT(refused("rope_proof_obstacle", 0, -1), 1);
        CHECK_INT(refused("rope_proof_obstacle", 0, 1), 0);
        CHECK_INT(refused("rope_proof_length", 0, 1.01 * line.proof_length), 1);
        CHECK_INT(refused("rope_proof_length", 0, line.proof_length), 0);
        CHECK_INT(refused("rope_proof", 0, 1), 1);
        CHECK_INT(refused("rope_proof", 0, 0), 0);
        CHECK_INT(refused("rope_compliance", 0, 1e-9), 1);
        CHECK_INT(refused("rope_compliance", 0, 0), 0);
        CHECK_INT(refused("rope_end_held_position", 5, b.radius), 1);
        CHECK_INT(refused("rope_end_held_position", 5, 0), 0);
        CHECK_INT(refused("obstacle_radius", 1, 0.7 * b.radius), 1);
    }
    printf("%d infeasible by an element, %d by the path, %d with a place found\n", proved,
           too_short, found_round);
    CHECK_GREATER(proved, CASES / 3);
    CHECK_GREATER(found_round, CASES / 3);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_cannot_go_round_is_told)};
    return cmocka_run_group_tests(tests, make_scene_directory, remove_scene_directory);
}
