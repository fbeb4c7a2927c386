/* SPDX-License-Identifier: BSD-3-Clause */
/* Proofs of lines that meet at points, from a scene to the checker: the proof is accepted, is what
 * it has to be by hand, and copies of the file with a number changed are refused. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "checker.h"
#include "run_scene.h"
#include "sample.h"
#include "splitmix.h"

enum { CASES = 20 };

static void write_scene(const char *text) {
    FILE *out = fopen(scene_path, "w");
    assert_non_null(out);
    assert_true(fputs(text, out) >= 0);
    assert_int_equal(fclose(out), 0);
}

static int refuted(void) {
    CheckerReport report;
    (void)checker_file(scene_result, &report, getenv("SHOW") ? stdout : NULL);
    return report.refuted;
}

static void refuse(const char *variable, size_t index, double value, double right) {
    CHECK_INT(sample_poke(scene_result, variable, index, value), 0);
    if (refuted() == 0) fail_msg("%s[%zu] = %g is accepted", variable, index, value);
    CHECK_INT(sample_poke(scene_result, variable, index, right), 0);
}

/* A rope between anchors on the x axis, cut at a knot, with a tail of any kind: its forces are 1
 * along the axis, and what it lacks is the distance less both lengths. Far from the origin, with
 * the ends of lines exchanged. */
static void too_short_a_rope_is_told(void **state) {
    (void)state;
    uint64_t random = 5;
    for (int i = 0; i < CASES; i++) {
        char text[1200];
        const double size = pow(10, splitmix(&random, -2, 3)),
                     x = size * splitmix(&random, -20, 20), one = size * splitmix(&random, 0.2, 1),
                     two = size * splitmix(&random, 0.2, 1),
                     lacking = size * pow(10, splitmix(&random, -5, 0)),
                     z = size * splitmix(&random, -3, 3);
        const char *const tail = i % 2 ? "1e6" : ".inf";
        snprintf(text, sizeof text,
                 "capstan: 1\npoints:\n  west: {held: [%.17g, 0, %.17g]}\n  east: {held: [%.17g, "
                 "0, %.17g]}\n  knot: {free: [%.17g, 0, %.17g]}\n  foot: {free: [%.17g, 0, %.17g], "
                 "weight: 3}\nlines:\n"
                 "  a: {length: %.17g, elements: 3, weight: 2, stiffness: .inf, start: static, "
                 "ends: {A: {point: west}, B: {point: knot}}}\n"
                 "  b: {length: %.17g, elements: 2, weight: 1, stiffness: .inf, start: static, "
                 "ends: {A: {point: east}, B: {point: knot}}}\n"
                 "  c: {length: %.17g, elements: 2, weight: 1, stiffness: %s, start: static, "
                 "ends: {A: {point: knot}, B: {point: foot}}}\n",
                 x, z, x + one + two + lacking, z, x + one, z, x + one, z - size, one, two, size,
                 tail);
        write_scene(text);
        const CpsLineReport line = run_scene();
        CHECK_INT(strcmp(cps_outcome_name(line.outcome), "infeasible"), 0);
        CHECK_INT(refuted(), 0);
        /* forces along the axis, to the accuracy of the program; places have the rounding of x */
        CHECK_NEAR(line.proof[0], 1, 1e-6);
        CHECK_NEAR(hypot(line.proof[1], line.proof[2]), 0, 1e-6);
        CHECK_NEAR(line.proof_length / lacking, 1, 1e-6 + 1e-13 * size / lacking * 20);
        refuse("a_proof", 1, 0.5, line.proof[1]);
        refuse("a_proof", 0, 1 - 2 * lacking / (one + two), line.proof[0]);
        refuse("a_proof", 0, -1, line.proof[0]);
        refuse("c_proof", 2, -2, 0);
        refuse("a_proof_length", 0, 1.001 * lacking, line.proof_length);
        refuse("b_outcome", 0, 4, 5);
        refuse("c_outcome", 0, 0, 5);
        refuse("position_of_point", 3, x + one + two, x + one + two + lacking);
        refuse("state_of_point", 1, 1, 0);
        CHECK_INT(refuted(), 0);
    }
}

/* Two anchors, a body between them with two eyes at the ends of a diameter of any direction, begun
 * turned by any rotation, and a line from each eye: what they lack is the distance of the anchors
 * less both lengths and the diameter. */
static void too_short_a_line_with_a_body_is_told(void **state) {
    (void)state;
    uint64_t random = 11;
    for (int i = 0; i < CASES; i++) {
        char text[1500];
        const double size = pow(10, splitmix(&random, -2, 3)),
                     x = size * splitmix(&random, -20, 20), one = size * splitmix(&random, 0.2, 1),
                     two = size * splitmix(&random, 0.2, 1),
                     lacking = size * pow(10, splitmix(&random, -5, 0));
        double eye[3], turn[4];
        for (int a = 0; a < 3; a++) eye[a] = size * splitmix(&random, a < 2 ? -0.3 : 0.05, 0.3);
        const double across = 2 * sqrt(eye[0] * eye[0] + eye[1] * eye[1] + eye[2] * eye[2]);
        for (int k = 3; k >= 0; k--) turn[k] = splitmix(&random, k < 3 ? -1 : 0.1, 1);
        snprintf(
            text, sizeof text,
            "capstan: 1\nbodies: {buoy: {free: [%.17g, %.17g, 0], rotation: {quaternion: [%.17g, "
            "%.17g, %.17g, %.17g]}, fixed: [%s], weight: 3}}\npoints:\n"
            "  west: {held: [%.17g, 0, 0]}\n  east: {held: [%.17g, 0, 0]}\n"
            "  left: {body: buoy, at: [%.17g, %.17g, %.17g]}\n"
            "  right: {body: buoy, at: [%.17g, %.17g, %.17g]}\nlines:\n"
            "  a: {length: %.17g, elements: 3, weight: 2, stiffness: .inf, start: static, "
            "ends: {A: {point: west}, B: {point: left}}}\n"
            "  b: {length: %.17g, elements: 2, weight: 1, stiffness: .inf, start: static, "
            "ends: {A: {point: east}, B: {point: right}}}\n",
            x + one, size * splitmix(&random, -1, 1), turn[0], turn[1], turn[2], turn[3],
            i % 3 == 2 ? "rx" : "", x, x + one + two + across + lacking, eye[0], eye[1], eye[2],
            -eye[0], -eye[1], -eye[2], one, two);
        write_scene(text);
        const CpsLineReport line = run_scene();
        CHECK_INT(strcmp(cps_outcome_name(line.outcome), "infeasible"), 0);
        CHECK_INT(refuted(), 0);
        CHECK_NEAR(line.proof[0], 1, 1e-9);
        CHECK_NEAR(hypot(line.proof[1], line.proof[2]), 0, 1e-6);
        CHECK_NEAR(line.proof_length / lacking, 1, 1e-6 + 1e-13 * size / lacking * 20);
        refuse("a_proof", 1, 0.5, line.proof[1]);
        refuse("a_proof", 0, 1 - 2 * lacking / (one + two), line.proof[0]);
        refuse("a_proof", 0, -1, line.proof[0]);
        refuse("a_proof_length", 0, 1.001 * lacking, line.proof_length);
        refuse("b_outcome", 0, 4, 5);
        refuse("place_on_body_of_point", 6, 1.1 * eye[0] + 1.1 * lacking, eye[0]);
        refuse("position_of_point", 3, x + one + two + across, x + one + two + across + lacking);
        CHECK_INT(refuted(), 0);
    }
}

/* Two lines and three points that nothing holds, above a rough bed or on it, pulled along it by
 * more than friction holds, or lifted. */
static void what_nothing_holds_is_told(void **state) {
    (void)state;
    uint64_t random = 7;
    int fallen = 0, rested = 0;
    for (int i = 0; i < CASES; i++) {
        char text[1200];
        const double size = pow(10, splitmix(&random, -2, 3)), mu = splitmix(&random, 0.1, 1),
                     weight = pow(10, splitmix(&random, -1, 3)),
                     pull = splitmix(&random, 0.1, 2) * mu * (4 * weight), /* both lines, and 2 */
            x = size * splitmix(&random, -5, 5);
        const bool falls = pull > 4 * weight * mu;
        if (fabs(pull / (4 * weight * mu) - 1) < 0.01) continue;
        snprintf(
            text, sizeof text,
            "capstan: 1\nobstacles: {bed: {plane: {}, friction: %.17g}}\npoints:\n  west: "
            "{free: [%.17g, 0, 0]}\n  east: {free: [%.17g, 0, 0], weight: %.17g}\n  knot: "
            "{free: [%.17g, 0, 0], weight: %.17g}\nlines:\n"
            "  a: {length: %.17g, elements: 3, weight: %.17g, stiffness: %.17g, start: "
            "{straight: {from: [%.17g, 0, 0], to: [%.17g, 0, 0]}}, ends: {A: {point: west}, "
            "B: {point: knot}}}\n"
            "  b: {length: %.17g, elements: 2, weight: %.17g, stiffness: %.17g, start: "
            "{straight: {from: [%.17g, 0, 0], to: [%.17g, 0, 0]}}, ends: {A: {point: knot}, "
            "B: {point: east}}}\nhistory: [{name: pull, west.point: {force: [%.17g, 0, 0]}}]\n",
            mu, x, x + 2 * size, weight, x + size, weight, size, weight / size, 1e4 * weight, x,
            x + size, size, weight / size, 1e4 * weight, x + size, x + 2 * size, -pull);
        write_scene(text);
        const CpsLineReport line = run_scene();
        CHECK_INT(strcmp(cps_outcome_name(line.outcome), falls ? "unbounded" : "solved"), 0);
        CHECK_INT(refuted(), 0);
        fallen += falls;
        rested += !falls;
        if (!falls) continue;
        /* away from the bed at the friction angle: the projection of (pull, 4 weights down) */
        CHECK_NEAR(line.proof_force / ((pull - mu * 4 * weight) / hypot(1, mu)), 1, 1e-6);
        for (size_t k = 0; k < 3; k++) refuse("a_proof", k, line.proof[k] + 0.01, line.proof[k]);
        refuse("b_proof", 2, -line.proof[2], line.proof[2]);
        refuse("a_proof_force", 0, 1.001 * line.proof_force, line.proof_force);
        refuse("a_outcome", 0, 0, 4);
        refuse("state_of_point", 1, 0, 1);
        refuse("obstacle_friction_axial", 0, pull / (4 * weight), mu);
        CHECK_INT(refuted(), 0);
    }
    CHECK_INT(fallen > 5 && rested > 5, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(too_short_a_rope_is_told),
        cmocka_unit_test(too_short_a_line_with_a_body_is_told),
        cmocka_unit_test(what_nothing_holds_is_told),
    };
    return cmocka_run_group_tests(tests, make_scene_directory, remove_scene_directory);
}
