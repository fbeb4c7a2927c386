/* SPDX-License-Identifier: BSD-3-Clause */
/* The smooth stiffness of an end, in which touchdown moves along the elements: the three lines of
 * OC3-Hywind with one mesh, and random lines on a bed or a slope, whose smooth stiffness is that of
 * a mesh 16 times as fine up to the square of the element length, while the matrix of the discrete
 * line jumps. Prints both. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "capstan/evolve.h"
#include "check.h"
#include "splitmix.h"

static CpsEvolution *evolution_of(const CpsScene *scene) {
    CpsEvolution *out = NULL;
    CpsError err = {0};
    if (cps_evolution_create(scene, &out, &err) != CPS_OK) fail_msg("%s", err.message);
    return out;
}

/* OC3-Hywind's lines (Jonkman 2010) as a body held in its pose at rest, against elastic catenaries:
 * surge 41 181.2 N/m, heave 11 941.5 N/m, yaw 1.156668e7 N m/rad. */
static void oc3_by_one_mesh(void **unused) {
    (void)unused;
    static const char *const LINE[3] = {"a", "b", "c"}, *const POINT[6] = {"a1", "a2", "a3",
                                                                           "f1", "f2", "f3"};
    /* with 1601, an open node 0.1 mm above the bed has a state that says it touches */
    static const int MESH[] = {389, 393, 397, 401, 405, 409, 413, 1601};
    for (size_t i = 0; i < sizeof MESH / sizeof MESH[0]; i++) {
        const int elements = MESH[i];
        CpsObstacle bed = cps_obstacle_default();
        bed.name = "bed";
        bed.point[2] = -320;
        CpsBody body = cps_body_default();
        body.name = "spar";
        CpsLine line[3];
        CpsPoint point[6];
        for (int k = 0; k < 3; k++) {
            const double x = cos(2 * acos(-1) * k / 3), y = sin(2 * acos(-1) * k / 3);
            const double at[2][3] = {{853.87 * x, 853.87 * y, -320}, {5.2 * x, 5.2 * y, -70}};
            line[k] = cps_line_default();
            line[k].name = LINE[k];
            line[k].length = 902.2;
            line[k].element_count = elements;
            line[k].weight = 698.094;
            line[k].stiffness = 384.243e6;
            line[k].start.kind = CPS_START_STATIC;
            for (int end = 0; end < 2; end++) {
                line[k].end[end].kind = CPS_END_KIND_POINT;
                line[k].end_point[end] = 3 * end + k;
                point[3 * end + k] = cps_point_default();
                point[3 * end + k].name = POINT[3 * end + k];
                if (end == 1) point[3 + k].kind = CPS_POINT_KIND_ON_BODY;
                memcpy(point[3 * end + k].position, at[end], sizeof at[end]);
            }
        }
        CpsScene scene = cps_scene_default();
        scene.obstacle_count = scene.body_count = 1;
        scene.obstacle = &bed;
        scene.body = &body;
        scene.line_count = 3;
        scene.line = line;
        scene.point_count = 6;
        scene.point = point;
        CpsEvolution *evolution = evolution_of(&scene);
        assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
        CpsBodyStiffness found;
        assert_int_equal(cps_evolution_body_stiffness(evolution, 0, CPS_STIFFNESS_STEP, &found,
                                                      NULL),
                         CPS_OK);
        assert_int_equal(found.outcome, CPS_STIFFNESS_OUTCOME_FOUND);
        printf("%d elements: surge %.2f (discrete %.2f), heave %.2f (%.2f), yaw %.6g\n", elements,
               found.smooth[0], found.matrix[0], found.smooth[14], found.matrix[14],
               found.smooth[35]);
        /* 400 elements of 2.3 m: the square of the element length over that of the suspended part,
         * 7e-5, bounds what is left */
        CHECK_RELATIVE(found.smooth[0], 41181.2, 1e-4);
        CHECK_RELATIVE(found.smooth[14], 11941.5, 1e-4);
        CHECK_RELATIVE(found.smooth[35], 1.156668e7, 1e-4);
        cps_evolution_destroy(evolution);
    }
}

static uint64_t seeded;
static double uniform(double low, double high) { return splitmix(&seeded, low, high); }

/* A line of 100 m over a bed or slope, of one make or of two sections with a clump where they meet,
 * from an anchor or between two ends that are above the ground, and where its end is moved to. */
typedef struct Mooring {
    CpsObstacle bed;
    CpsLine line;
    CpsSection section[2];
    CpsPointWeight clump;
    CpsScene scene;
    double to[2][3];
} Mooring;

static void make_mooring(Mooring *m) {
    *m = (Mooring){.bed = cps_obstacle_default(),
                   .line = cps_line_default(),
                   .scene = cps_scene_default()};
    m->bed.name = "bed";
    m->bed.friction = uniform(0, 1) < 0.3 ? 0 : uniform(0.1, 1);
    if (uniform(0, 1) < 0.4) m->bed.normal[0] = uniform(-0.05, 0.1);
    CpsLine *line = &m->line;
    line->name = "mooring";
    line->length = 100;
    line->weight = uniform(50, 500);
    line->stiffness = line->weight * line->length * pow(10, uniform(1, 4));
    if (uniform(0, 1) < 0.4) {
        const double first = 100 * floor(uniform(0.2, 0.8) * 20) / 20;
        for (int k = 0; k < 2; k++)
            m->section[k] = (CpsSection){.length = k ? 100 - first : first,
                                         .weight = line->weight * uniform(0.3, 2),
                                         .stiffness = line->stiffness};
        line->section_count = 2;
        line->section = m->section;
        m->clump = (CpsPointWeight){.arc_length = first, .weight = line->weight * uniform(1, 20)};
        line->point_weight_count = uniform(0, 1) < 0.5;
        line->point_weight = &m->clump;
    }
    line->start.kind = CPS_START_STATIC;
    const bool both = uniform(0, 1) < 0.3;
    const double depth = uniform(10, 30), reach = uniform(0.85, 0.97) * sqrt(1e4 - depth * depth);
    line->end[CPS_END_A] = (CpsEnd){CPS_END_KIND_HELD, {0, 0, both ? 12 : 0}};
    line->end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {reach, 0, depth}};
    for (int k = 0; k < 2; k++) {
        memcpy(m->to[k], k ? m->to[0] : line->end[CPS_END_B].value, sizeof m->to[k]);
        for (int a = 0; a < 3; a++) m->to[k][a] += uniform(-1, 1);
    }
    m->scene.obstacle_count = m->scene.line_count = 1;
    m->scene.obstacle = &m->bed;
    m->scene.line = line;
}

/* Both stiffnesses by a mesh; false where there is none or the line does not touch. */
static bool find(Mooring *m, int elements, CpsStiffness out[2]) {
    m->line.element_count = elements;
    CpsEvolution *evolution = evolution_of(&m->scene);
    bool found = cps_evolution_step(evolution, NULL) == CPS_OK;
    for (int k = 0; k < 2; k++) {
        CpsChange change = {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {0}}};
        CpsStage move = cps_stage_default();
        memcpy(change.to.value, m->to[k], sizeof m->to[k]);
        move.change_count = 1;
        move.change = &change;
        found = found && cps_evolution_move(evolution, &move, NULL) == CPS_OK &&
                cps_evolution_report(evolution).outcome == CPS_OUTCOME_SOLVED;
    }
    for (int kind = 0; found && kind < 2; kind++) {
        assert_int_equal(cps_evolution_stiffness(evolution, 0, CPS_END_B, (CpsStiffnessKind)kind,
                                                 &out[kind], NULL),
                         CPS_OK);
        found = out[kind].has_smooth;
    }
    found = found && cps_evolution_line_report(evolution, 0).grounded > 0;
    cps_evolution_destroy(evolution);
    return found;
}

static double difference(const double a[9], const double b[9]) {
    double sum = 0, size = 0;
    for (int i = 0; i < 9; i++) {
        sum += (a[i] - b[i]) * (a[i] - b[i]);
        size += b[i] * b[i];
    }
    return sqrt(sum / size);
}

/* The largest differences of four meshes beside each other from the fine one. */
enum { COARSE = 100, FINE = 400, FINEST = 1600, MESHES = 4, STEP = 20 };

static bool differ(Mooring *m, int elements, const CpsStiffness finest[2], double smooth[2],
                   double discrete[2]) {
    for (int k = 0; k < MESHES; k++) {
        CpsStiffness found[2];
        if (!find(m, elements + STEP * k, found)) return false;
        for (int kind = 0; kind < 2; kind++) {
            const double *exact = finest[kind].smooth;
            smooth[kind] = fmax(smooth[kind], difference(found[kind].smooth, exact));
            discrete[kind] = fmax(discrete[kind], difference(found[kind].matrix, exact));
        }
    }
    return true;
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Print and return the medians of differences. */
static void medians(const char *what, int count, double *error[3], double out[3]) {
    for (int i = 0; i < 3; i++) {
        qsort(error[i], (size_t)count, sizeof *error[i], compare);
        out[i] = error[i][count / 2];
    }
    printf("%s, %d lines: smooth, median %.1e at %d elements and %.1e at %d, largest %.1e and "
           "%.1e; discrete, median %.1e at %d\n",
           what, count, out[0], COARSE, out[1], FINE, error[0][count - 1], error[1][count - 1],
           out[2], FINE);
}

/* From 100 elements to 400 an error of second order falls to a sixteenth; the median, over lines of
 * which each has its own phases of touchdown, to no more than an eighth. A stiffness that is given
 * with 100 elements has jumps of at most a fifth there, and of a twentieth with 400, and what
 * interpolation leaves is of the square of that. Jumps below 1e-4 are those of lines that hang. In
 * K_step with friction the front between what rests and what slides goes on from node to node: that
 * it is nearer to the line than the discrete matrix is asked of the median alone. */
static void of_second_order(void **unused) {
    (void)unused;
    enum { CASES = 100, CLASSES = 2 };
    static const double LARGEST = 0.05 * 0.05, HANGING = 1e-4;
    static double error[CLASSES][3][2 * CASES];
    int count[CLASSES] = {0};
    for (uint64_t seed = 1; seed <= CASES; seed++) {
        Mooring m;
        CpsStiffness finest[2];
        double coarse[2] = {0}, fine[2] = {0}, at_coarse[2] = {0}, jump[2] = {0};
        seeded = seed;
        make_mooring(&m);
        if (!find(&m, FINEST, finest) || !differ(&m, COARSE, finest, coarse, at_coarse) ||
            !differ(&m, FINE, finest, fine, jump))
            continue;
        for (int kind = 0; kind < 2; kind++) {
            const int rubs = kind == CPS_STIFFNESS_STEP && m.bed.friction > 0, i = count[rubs]++;
            error[rubs][0][i] = coarse[kind];
            error[rubs][1][i] = fine[kind];
            error[rubs][2][i] = jump[kind];
            if (rubs) continue;
            CHECK_LESS(fine[kind], LARGEST);
            if (jump[kind] > HANGING) CHECK_LESS(fine[kind], 0.5 * jump[kind]);
        }
    }
    double median[CLASSES][3];
    for (int k = 0; k < CLASSES; k++) {
        double *of[3] = {error[k][0], error[k][1], error[k][2]};
        CHECK_GREATER(count[k], CASES / 4);
        medians(k ? "step with friction" : "stick, and step without", count[k], of, median[k]);
    }
    CHECK_LESS(median[0][1], median[0][0] / 8);
    CHECK_LESS(median[1][1], median[1][2] / 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(oc3_by_one_mesh),
                                       cmocka_unit_test(of_second_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
