/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines that pass an obstacle within a step with contact of the reference, with both policies of
 * friction: the outcome says so where they do, and nowhere else; the checker confirms it, and
 * refuses copies whose claim or obstacle is another one.
 *
 * A weightless elastic rope without contact stays straight. Its end A is held, and B goes straight
 * from above to below a cylinder or sphere, so the rope sweeps a triangle; every distance follows
 * from that. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "checker.h"
#include "run_scene.h"
#include "sample.h"
#include "splitmix.h"

enum { CASES = 80 };

/* Something round in or beside the way of a rope of length L from the origin to L (cos, 0, +-sin).
 */
typedef struct Passing {
    double length, angle, radius, x, y; /* [m], [rad]; the centre is at (x, y, 0) */
    bool is_sphere, follows;            /* friction follows the reactions */
    int elements, side;                 /* B begins above (1) or below (-1) */
    bool rests;                         /* nothing happens in a step before */
} Passing;

/* The scene of a way into its file; two obstacles, the first one far away. */
static void write_scene(const Passing *w) {
    const double c = w->length * cos(w->angle), s = w->length * sin(w->angle) * w->side,
                 far = 50 * w->length, more = 1.001;
    FILE *out = fopen(scene_path, "w");
    assert_non_null(out);
    fprintf(out,
            "capstan: 1\ncontact_policy: reference\nfriction_policy: %s\nsolver: {halvings: "
            "0}\nobstacles:\n"
            "  far: {sphere: {centre: [0, %.17g, 0], radius: %.17g}, friction: 0.2}\n",
            w->follows ? "consistent" : "frozen", far, w->radius);
    if (w->is_sphere)
        fprintf(out, "  near: {sphere: {centre: [%.17g, %.17g, 0]", w->x, w->y);
    else
        fprintf(out, "  near: {cylinder: {point: [%.17g, %.17g, 0], axis: [0, 1, 0]", w->x, w->y);
    fprintf(out,
            ", radius: %.17g}, friction: 0.3}\nlines:\n  rope: {length: %.17g, elements: %d, "
            "weight: 0, stiffness: 1000, start: {straight: {from: [0, 0, 0], to: [%.17g, 0, "
            "%.17g]}}, ends: {A: held, B: held}}\n"
            "history:\n%s  - {name: across, steps: 1, rope.B: {position: [%.17g, 0, %.17g]}}\n",
            w->radius, w->length, w->elements, c, s, w->rests ? "  - {name: rest}\n" : "", more * c,
            -more * s);
    assert_int_equal(fclose(out), 0);
}

/* The largest y at which a sphere is passed: half of its radius or of its distance before. */
static bool is_passed(const Passing *w) {
    const double reach = w->length * cos(w->angle);
    if (!w->is_sphere) return w->x < reach;
    const double before = hypot(w->y, w->x * sin(w->angle));
    return fabs(w->y) < 0.5 * fmin(w->radius, before);
}

/* A random way, clearly passing or clearly not, with clear ends. */
static Passing random_passing(uint64_t *state, bool passes, bool follows) {
    Passing w = {.follows = follows, .length = pow(10, splitmix(state, -2, 2))};
    w.angle = splitmix(state, 0.2, 0.6);
    w.is_sphere = splitmix(state, 0, 1) < 0.5;
    w.elements = (int)pow(10, splitmix(state, 0, 1.5));
    w.side = splitmix(state, 0, 1) < 0.5 ? 1 : -1;
    const double c = w.length * cos(w.angle);
    w.x = c * (passes || w.is_sphere ? splitmix(state, 0.4, 0.7) : splitmix(state, 1.5, 2));
    const double before = w.x * sin(w.angle);
    w.radius = splitmix(state, 0.05, 0.9) * fmin(before, fabs(c - w.x));
    if (w.is_sphere)
        w.y = w.radius * (passes ? splitmix(state, -0.45, 0.45) : splitmix(state, 0.55, 3));
    return w;
}

static int refused(const char *variable, size_t index, double value) {
    CheckerReport report;
    CHECK_INT(sample_poke(scene_result, variable, index, value), 0);
    (void)checker_file(scene_result, &report, NULL);
    return report.refuted;
}

static void what_passes_is_told(void **state) {
    (void)state;
    uint64_t random = 31;
    int passed = 0;
    for (int i = 0; i < CASES; i++) {
        const bool passes = i % 2 == 0;
        const Passing w = random_passing(&random, passes, i % 4 >= 2);
        CheckerReport report;
        CHECK_INT(is_passed(&w), passes);
        write_scene(&w);
        const CpsLineReport line = run_scene();
        CHECK_INT(strcmp(cps_outcome_name(line.outcome), passes ? "passes" : "solved"), 0);
        CHECK_INT(cps_outcome_is_certified(line.outcome), !passes);
        CHECK_INT(line.has_proof_obstacle, passes);
        if (passes) CHECK_INT(line.proof_obstacle, 1);
        (void)checker_file(scene_result, &report, stdout);
        CHECK_INT(report.refuted, 0);
        CHECK_INT(passes ? report.uncertified : report.certified, 1);
        passed += passes;
        if (!passes) { /* it did not pass */
            CHECK_INT(refused("rope_proof_obstacle", 0, 1) + refused("rope_outcome", 0, 8), 1);
            continue;
        }
        CHECK_INT(refused("rope_proof_obstacle", 0, 0), 1);  /* the other one is far away */
        CHECK_INT(refused("rope_proof_obstacle", 0, -1), 1); /* none */
        CHECK_INT(refused("rope_proof_obstacle", 0, 1), 0);
        CHECK_INT(refused("rope_outcome", 0, 0), 1); /* certified */
        CHECK_INT(refused("rope_outcome", 0, 8), 0);
        /* the step's own equations: energies, forces and places */
        const double primal = line.certificate.primal, tension = line.end[0].tension,
                     up = -1.001 * w.length * sin(w.angle) * w.side;
        const size_t last = 3 * (size_t)w.elements + 2;
        CHECK_INT(refused("rope_primal", 0, 1.01 * primal), 1);
        CHECK_INT(refused("rope_primal", 0, primal), 0);
        CHECK_INT(refused("rope_end_tension", 0, 1.01 * tension), 1);
        CHECK_INT(refused("rope_end_tension", 0, tension), 0);
        CHECK_INT(refused("rope_reaction", 1, -0.01 * tension), 1);
        CHECK_INT(refused("rope_reaction", 1, 0), 0);
        CHECK_INT(refused("rope_position", last, up + 1e-6 * w.length), 1);
        CHECK_INT(refused("rope_position", last, up), 0);
        /* moved out of the way */
        CHECK_INT(refused("obstacle_point", 3, 3 * w.length), 1);
    }
    CHECK_INT(passed, CASES / 2);
}

/* The work of the ends is that of the forces before and after, as in a solved step; the imbalance
 * follows it. */
static void its_work_is_checked(void **state) {
    (void)state;
    uint64_t random = 37;
    for (int i = 0; i < 4; i++) {
        Passing w = random_passing(&random, true, i % 2);
        w.rests = true;
        write_scene(&w);
        const CpsLineReport line = run_scene();
        const double ends = line.ledger.ends, imbalance = line.ledger.imbalance,
                     more = 0.01 * fabs(ends);
        CHECK_INT(strcmp(cps_outcome_name(line.outcome), "passes"), 0);
        CHECK_INT(line.substep_count, 1);
        CHECK_GREATER(more, 0);
        CHECK_INT(refused("rope_ledger_ends", 1, ends), 0);
        CHECK_INT(sample_poke(scene_result, "rope_ledger_ends", 1, ends + more), 0);
        CHECK_INT(refused("rope_ledger_imbalance", 1, imbalance + more), 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_passes_is_told),
                                       cmocka_unit_test(its_work_is_checked)};
    return cmocka_run_group_tests(tests, make_scene_directory, remove_scene_directory);
}
