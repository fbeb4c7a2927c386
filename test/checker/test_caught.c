/* SPDX-License-Identifier: BSD-3-Clause */
/* Inextensible lines on a bed, laid half round a ball that dips into the bed, whose end B is drawn
 * away: the outcome says that the line is caught where it is too short for the way that remains to
 * it, and nowhere else; the checker confirms it, and refuses copies with another ball, bed, line,
 * end, or half-line.
 *
 * On the bed the ball is a disc, and the shortest way round it consists of two tangents and an arc.
 * A line longer than that way can lie there, so it is not caught; one that is shorter by much is;
 * and by no more than it is shorter. Lines that do not lie round the ball, elastic lines, and balls
 * that stand clear of the bed are tried as well. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "checker.h"
#include "run_scene.h"
#include "sample.h"
#include "splitmix.h"

enum { CASES = 14, CORNERS = 8, POINTS = CORNERS + 2 };

/* A ball of radius `size`, its centre above the origin. The line goes along y = -off from x =
 * -before to 0, half round the origin and back along y = off to x = -after; then B is drawn back by
 * `drawn` along the same line. All turned by `heading`. */
typedef struct Boulder {
    double size, height, off, before, after, drawn, heading, friction, missing;
    double point[POINTS][2], length;
    int elements;
    enum { CAUGHT, LONG, BESIDE, ELASTIC, CLEAR, KINDS } kind;
} Boulder;

static const char *const KIND[KINDS] = {"caught", "long enough", "beside", "elastic", "clear"};

static double tangent_and_arc(double x, double y, double r, double *angle) {
    const double far = hypot(x, y);
    *angle = acos(r / far);
    return sqrt(far * far - r * r);
}

/* What the line lacks for the shortest way round the disc that the ball is on the bed. */
static double lacking(const Boulder *b) {
    const double r = sqrt(b->size * b->size - b->height * b->height), back = b->after + b->drawn;
    double bare[2];
    const double straight = tangent_and_arc(b->before, b->off, r, &bare[0]) +
                            tangent_and_arc(back, b->off, r, &bare[1]),
                 turn = 2 * acos(-1) - atan2(b->off, b->before) - atan2(b->off, back);
    return straight + r * (turn - bare[0] - bare[1]) - b->length;
}

static Boulder random_boulder(uint64_t *state, int kind) {
    Boulder b = {.size = pow(10, splitmix(state, -2, 2)), .kind = kind};
    const double R = b.size, pi = acos(-1);
    b.height = R * splitmix(state, 0.16, 0.3);
    b.off = R * splitmix(state, 1.03, 1.08);
    b.before = R * splitmix(state, 1.5, 3);
    b.after = R * splitmix(state, 1.5, 3);
    b.heading = splitmix(state, 0, 2 * pi);
    b.friction = splitmix(state, 0, 0.5);
    b.elements = (int)splitmix(state, 32, 44);
    const double corner = b.off / cos(pi / 2 / CORNERS);
    for (int i = 0; i < POINTS; i++) {
        const double angle = pi * ((i - 0.5) / CORNERS - 0.5);
        const bool last = i == POINTS - 1;
        b.point[i][0] = i == 0 ? -b.before : last ? -b.after : corner * cos(angle);
        b.point[i][1] = i == 0 ? -b.off : last ? b.off : corner * sin(angle);
        if (i > 0)
            b.length += hypot(b.point[i][0] - b.point[i - 1][0], b.point[i][1] - b.point[i - 1][1]);
    }
    b.missing = R * (kind == LONG ? splitmix(state, -0.05, -0.02) : splitmix(state, 0.25, 0.5));
    double low = 0, high = 4 * R;
    for (int i = 0; i < 60; i++) {
        b.drawn = (low + high) / 2;
        if (lacking(&b) < b.missing)
            low = b.drawn;
        else
            high = b.drawn;
    }
    if (kind == CLEAR) b.height = 1.01 * R;
    return b;
}

static void print_point(FILE *out, const Boulder *b, double x, double y) {
    fprintf(out, "[%.17g, %.17g, 0]", cos(b->heading) * x - sin(b->heading) * y,
            sin(b->heading) * x + cos(b->heading) * y);
}

static void write_scene(const Boulder *b) {
    FILE *out = fopen(scene_path, "w");
    assert_non_null(out);
    // the line beside: the ball is on the other side of it
    const double x = b->kind == BESIDE ? 5 * b->size : 0;
    fprintf(out, "capstan: 1\nsolver: {halvings: 6}\nobstacles:\n"
                 "  bed: {plane: {}, friction: 0.3}\n  ball: {sphere: {centre: ");
    fprintf(out, "[%.17g, %.17g, %.17g], radius: %.17g}, friction: %.17g}\n", cos(b->heading) * x,
            sin(b->heading) * x, b->height, b->size, b->friction);
    fprintf(
        out,
        "lines:\n  rope: {length: %.17g, elements: %d, weight: 1, stiffness: %s, ends: {A: held, "
        "B: held}, start: {polyline: [",
        b->length, b->elements, b->kind == ELASTIC ? "10" : ".inf");
    for (int i = 0; i < POINTS; i++) {
        if (i > 0) fputs(", ", out);
        print_point(out, b, b->point[i][0], b->point[i][1]);
    }
    fputs("]}}\nhistory:\n  - {name: back, rope.B: {position: ", out);
    print_point(out, b, -b->after - b->drawn, b->off);
    fputs("}}\n", out);
    assert_int_equal(fclose(out), 0);
}

static int refused(const char *variable, size_t index, double value) {
    CheckerReport report;
    CHECK_INT(sample_poke(scene_result, variable, index, value), 0);
    (void)checker_file(scene_result, &report, NULL);
    return report.refuted;
}

static void refuse(const char *variable, size_t index, double wrong, double right) {
    const int count = refused(variable, index, wrong);
    if (count != 1) print_error("%s[%zu] = %g is accepted\n", variable, index, wrong);
    CHECK_INT(count, 1);
    CHECK_INT(refused(variable, index, right), 0);
}

/* Copies with one number changed each. */
static void look_at_copies(const Boulder *b, const CpsLineReport *line) {
    const double R = b->size, *e = line->proof, back = -b->after - b->drawn,
                 held[2] = {cos(b->heading) * back - sin(b->heading) * b->off,
                            sin(b->heading) * back + cos(b->heading) * b->off};
    refuse("rope_proof_length", 0, 1.01 * line->proof_length, line->proof_length);
    CHECK_INT(refused("rope_proof_plane", 0, -1), 1);
    refuse("rope_proof_plane", 0, 1, 0);
    CHECK_INT(refused("rope_proof_obstacle", 0, 0), 1);
    refuse("rope_proof_obstacle", 0, -1, 1);
    refuse("rope_compliance", 0, 1e-9, 0);
    refuse("rope_end_kind", 1, 1, 0);
    refuse("rope_outcome", 0, 0, 5);
    /* the half-line on the other side of the ball */
    for (int k = 0; k < 2; k++)
        CHECK_INT(sample_poke(scene_result, "rope_proof", (size_t)k, -e[k]), 0);
    CHECK_INT(refused("rope_proof", 2, -e[2]), 1);
    for (size_t k = 0; k < 3; k++) CHECK_INT(sample_poke(scene_result, "rope_proof", k, e[k]), 0);
    /* longer than 1 */
    refuse("rope_proof", 2, e[2] + 0.1, e[2]);
    /* end B not drawn back */
    CHECK_INT(sample_poke(scene_result, "rope_end_held_position", 3, held[0] * 0.7), 0);
    CHECK_INT(refused("rope_end_held_position", 4, held[1] * 0.7), 1);
    CHECK_INT(sample_poke(scene_result, "rope_end_held_position", 3, held[0]), 0);
    CHECK_INT(refused("rope_end_held_position", 4, held[1]), 0);
    /* a longer element, a node inside the ball, a smaller ball, one clear of the bed, a bed below
     */
    refuse("rope_element_length", 3, R, b->length / b->elements);
    refuse("obstacle_radius", 1, 0.8 * R, R);
    refuse("obstacle_radius", 1, 1.1 * R, R);
    refuse("obstacle_point", 5, R, b->height);
    CHECK_INT(refused("obstacle_point", 2, -R), 1);
}

static void what_is_caught_is_told(void **state) {
    (void)state;
    uint64_t random = 23;
    int caught = 0, tried[KINDS] = {0};
    for (int i = 0; i < CASES; i++) {
        const Boulder b = random_boulder(&random, i % 2 ? CAUGHT : i / 2 % KINDS);
        CheckerReport report;
        write_scene(&b);
        const CpsLineReport line = run_scene();
        const bool is_caught = line.outcome == CPS_OUTCOME_INFEASIBLE && line.has_proof_plane;
        printf("%s: %s, lacks %.3g R, proved %.3g R, height %.3g R, %d parts\n", KIND[b.kind],
               cps_outcome_name(line.outcome), b.missing / b.size, line.proof_length / b.size,
               b.height / b.size, line.substep_count);
        CHECK_INT(is_caught, b.kind == CAUGHT);
        (void)checker_file(scene_result, &report, stdout);
        CHECK_INT(report.refuted, 0);
        tried[b.kind]++;
        if (b.kind == LONG) CHECK_INT(cps_outcome_is_certified(line.outcome), true);
        if (!is_caught) continue;
        caught++;
        CHECK_INT(line.proof_obstacle, 1);
        CHECK_INT(line.proof_plane, 0);
        CHECK_LESS(line.proof_length, lacking(&b));
        CHECK_INT(report.certified, 1);
        look_at_copies(&b, &line);
    }
    for (int k = 0; k < KINDS; k++) CHECK_INT(tried[k] >= 1, true);
    CHECK_GREATER(caught, CASES / 2 - 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_caught_is_told)};
    return cmocka_run_group_tests(tests, make_scene_directory, remove_scene_directory);
}
