/* SPDX-License-Identifier: BSD-3-Clause */
/* Sections and point weights through the C interface: what is refused, with the place and the
 * reason, and what a line of them weighs and how it stretches. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check.h"

#include "capstan/evolve.h"

enum { ELEMENTS = 6, SECTIONS = 3, POINTS = 2 };

/* A line of 12 m with a node each 2 m, held at both ends; the parts are the caller's to change. */
typedef struct Parts {
    double point[6];
    CpsSection section[SECTIONS];
    CpsPointWeight weight[POINTS];
    CpsLine line;
    CpsScene scene;
} Parts;

static void make(Parts *p) {
    *p = (Parts){.point = {0, 0, 0, 12, 0, 0},
                 .section = {{.type = "a", .length = 4, .weight = 50, .stiffness = 1e5},
                             {.type = "b", .length = 2, .weight = 20, .stiffness = 4e5},
                             {.type = "c", .length = 6, .stiffness = 2e5}},
                 .weight = {{.arc_length = 2, .weight = 30}, {.arc_length = 8, .weight = -10}}};
    p->line = cps_line_default();
    p->line.name = "rope";
    p->line.length = 12;
    p->line.element_count = ELEMENTS;
    p->line.section_count = SECTIONS;
    p->line.section = p->section;
    p->line.point_weight_count = POINTS;
    p->line.point_weight = p->weight;
    p->line.start.point_count = 2;
    p->line.start.point = p->point;
    p->line.end[0].kind = p->line.end[1].kind = CPS_END_KIND_HELD;
    memcpy(p->line.end[1].value, p->point + 3, 3 * sizeof *p->point);
    p->scene = cps_scene_default();
    p->scene.line_count = 1;
    p->scene.line = &p->line;
}

static void refused(const Parts *p, const char *fragment) {
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    const CpsStatus status = cps_evolution_create(&p->scene, &evolution, &err);
    if (status != CPS_ERR_ARGUMENT || evolution || !strstr(err.message, fragment))
        fail_msg("expected a refusal with '%s', found status %d: %s", fragment, (int)status,
                 err.message);
}

static void wrong_breaking_loads_are_refused(void **state) {
    (void)state;
    static const double LOAD[] = {0, -1, NAN, INFINITY};
    Parts p;
    for (int i = 0; i < 4; i++) {
        make(&p);
        p.line.section_count = p.line.point_weight_count = 0;
        p.line.stiffness = 1e5;
        p.line.has_breaking_load = true;
        p.line.breaking_load = LOAD[i];
        refused(&p, "line 'rope': breaking_load is ");
    }
}

static void wrong_sections_are_refused(void **state) {
    (void)state;
    static const double LENGTH[] = {0, -2, NAN, INFINITY}, WEIGHT[] = {-1, NAN, INFINITY},
                        STIFFNESS[] = {0, -1, NAN, -INFINITY};
    Parts p;
    for (int k = 0; k < SECTIONS; k++) {
        char number[40];
        snprintf(number, sizeof number, "sections: number %d", k + 1);
        for (int i = 0; i < 4; i++) {
            make(&p);
            p.section[k].length = LENGTH[i];
            refused(&p, "m long, expected a positive finite number");
            refused(&p, number);
            make(&p);
            p.section[k].stiffness = STIFFNESS[i];
            refused(&p, "N, expected a positive number, or infinity");
            refused(&p, number);
        }
        for (int i = 0; i < 3; i++) {
            make(&p);
            p.section[k].weight = WEIGHT[i];
            refused(&p, "N/m, expected a finite number >= 0");
            refused(&p, number);
        }
        for (int i = 0; i < 4; i++) {
            make(&p);
            p.section[k].has_breaking_load = true;
            p.section[k].breaking_load = (double[]){0, -1, NAN, INFINITY}[i];
            refused(&p, "N, expected a positive number");
            refused(&p, number);
        }
        make(&p);
        p.section[k].stiffness = INFINITY;
        refused(&p, "is inextensible or elastic, those before it are not");
    }
    make(&p);
    p.section[0].length = 3; /* no node there */
    refused(&p, "sections: number 1 ends at 3 m, where no node is (the next one lies at 4 m)");
    make(&p);
    p.section[1].length = 1e-9; /* ends at the node at which it begins */
    refused(&p, "sections: number 2 ends at");
    make(&p);
    p.section[2].length = 8; /* beyond the end */
    refused(&p, "sections: number 3 ends at 14 m");
    make(&p);
    p.line.section_count = 2;
    refused(&p, "sections are 6 m long together, but length is 12 m");
    make(&p);
    p.line.section_count = -1;
    refused(&p, "sections are a negative number, or NULL");
    make(&p);
    p.line.section = NULL;
    refused(&p, "sections are a negative number, or NULL");
}

/* Tables of strain and tension, of a section and of a line of one make. */
static void wrong_tables_are_refused(void **state) {
    (void)state;
    static const struct {
        int count;
        CpsStiffnessRow row[4];
        const char *found;
    } WRONG[] = {
        {1, {{0, 0}}, "has 1 rows, expected 2 to 100"},
        {-1, {{0, 0}, {1, 1}}, "has -1 rows, expected 2 to 100"},
        {101, {{0, 0}, {1, 1}}, "has 101 rows, expected 2 to 100"},
        {2, {{0.1, 0}, {1, 1}}, "begins with 0.1, 0 N, expected 0, 0"},
        {2, {{0, 5}, {1, 9}}, "begins with 0, 5 N, expected 0, 0"},
        {3, {{0, 0}, {0.1, 1}, {0.1, 2}}, "in row 3, expected a larger strain and a larger"},
        {3, {{0, 0}, {0.1, 1}, {0.2, 1}}, "in row 3, expected a larger strain and a larger"},
        {3, {{0, 0}, {0.1, 1}, {0.05, 2}}, "in row 3, expected a larger strain and a larger"},
        {2, {{0, 0}, {-0.1, -1}}, "in row 2, expected a larger strain and a larger"},
        {2, {{0, 0}, {NAN, 1}}, "row 2 is nan, 1 N, expected finite numbers"},
        {2, {{0, 0}, {1, NAN}}, "expected finite numbers"},
        {2, {{0, 0}, {1, INFINITY}}, "expected finite numbers"},
        {2, {{0, 0}, {5e-324, 1e9}}, "too steeply for a number"},
        {3, {{0, 0}, {0.1, 10}, {0.2, 19.99999}}, "becomes softer at row 2, from 100 N to"},
        {4, {{0, 0}, {0.1, 1}, {0.2, 3}, {0.3, 4}}, "becomes softer at row 3, from 20 N to 10 N"}};
    Parts p;
    for (size_t i = 0; i < sizeof WRONG / sizeof *WRONG; i++) {
        make(&p);
        p.section[1].stiffness_row_count = WRONG[i].count;
        p.section[1].stiffness_row = WRONG[i].row;
        refused(&p, "sections: number 2 has a table that ");
        refused(&p, WRONG[i].found);
        make(&p);
        p.line.section_count = p.line.point_weight_count = 0;
        p.line.stiffness_row_count = WRONG[i].count;
        p.line.stiffness_row = WRONG[i].row;
        refused(&p, "line 'rope': stiffness as a table ");
        refused(&p, WRONG[i].found);
    }
    make(&p);
    p.section[0].stiffness_row_count = 2; /* and NULL */
    refused(&p, "has a table that has 0 rows");
    for (int k = 0; k < SECTIONS; k++) p.section[k].stiffness = INFINITY;
    static const CpsStiffnessRow SOUND[2] = {{0, 0}, {0.1, 5}};
    p.section[0].stiffness_row = SOUND;
    refused(&p, "sections: number 2 is inextensible or elastic, those before it are not");
}

/* A dynamic stiffness is one, of an elastic line, and nowhere softer than the static one. */
static void wrong_dynamic_stiffnesses_are_refused(void **state) {
    (void)state;
    static const CpsStiffnessRow SLOW[3] = {{0, 0}, {0.1, 1e4}, {0.2, 4e4}},
                                 SOFT[3] = {{0, 0}, {0.05, 1e4}, {0.25, 6e4}},
                                 LATE[2] = {{0, 0}, {0.1, 2e4}}, FINE[2] = {{0, 0}, {0.1, 3.2e4}};
    static const struct Wrong {
        CpsDynamicStiffness is;
        const char *found;
    } WRONG[] = {{{0, 0, NULL}, "is 0 N, expected a positive finite number"},
                 {{-2, 0, NULL}, "is -2 N, expected a positive finite number"},
                 {{INFINITY, 0, NULL}, "is inf N, expected a positive finite number"},
                 {{NAN, 0, NULL}, "is nan N, expected a positive finite number"},
                 {{1, 2, NULL}, "has 0 rows, expected 2 to 100"},
                 {{1, -1, FINE}, "has -1 rows, expected 2 to 100"},
                 {{9e4, 0, NULL},
                  "is softer than the static one at 10000 N, with the strain 0.111111"},
                 {{1.5e5, 0, NULL},
                  "is softer than the static one at 40000 N, with the strain 0.266667"},
                 {{1, 3, SOFT}, "is softer than the static one at 120000 N"},
                 {{1, 2, LATE}, "is softer than the static one at 80000 N"}};
    Parts p;
    for (size_t i = 0; i < sizeof WRONG / sizeof *WRONG; i++)
        for (int whole = 0; whole < 2; whole++) {
            make(&p);
            if (whole) {
                p.line.section_count = p.line.point_weight_count = 0;
                p.line.has_dynamic_stiffness = true;
                p.line.dynamic_stiffness = WRONG[i].is;
                p.line.stiffness_row_count = 3;
                p.line.stiffness_row = SLOW;
            } else {
                p.section[1].has_dynamic_stiffness = true;
                p.section[1].dynamic_stiffness = WRONG[i].is;
                p.section[1].stiffness_row_count = 3;
                p.section[1].stiffness_row = SLOW;
            }
            refused(&p, whole ? "line 'rope': dynamic_stiffness "
                              : "sections: number 2 has a dynamic stiffness that ");
            refused(&p, WRONG[i].found);
        }
    make(&p);
    for (int k = 0; k < SECTIONS; k++) p.section[k].stiffness = INFINITY;
    p.section[1].has_dynamic_stiffness = true;
    p.section[1].dynamic_stiffness.stiffness = 1e6;
    refused(&p, "stands beside an inextensible one");
}

static void wrong_point_weights_are_refused(void **state) {
    (void)state;
    static const double WEIGHT[] = {NAN, INFINITY, -INFINITY},
                        PLACE[] = {0, -2, 3, 12, 14, NAN, INFINITY};
    Parts p;
    for (int k = 0; k < POINTS; k++) {
        for (int i = 0; i < 3; i++) {
            make(&p);
            p.weight[k].weight = WEIGHT[i];
            refused(&p, "N, expected a finite number");
        }
        for (int i = 0; i < 7; i++) {
            make(&p);
            p.weight[k].arc_length = PLACE[i];
            refused(&p, "point_weights: number");
        }
    }
    make(&p);
    p.weight[0].arc_length = 8;
    p.weight[1].arc_length = 2;
    refused(&p, "give them in order from A to B");
    make(&p);
    p.line.point_weight_count = -1;
    refused(&p, "point_weights are a negative number, or NULL");
    make(&p);
    p.line.point_weight = NULL;
    refused(&p, "point_weights are a negative number, or NULL");
    make(&p);
    memset(p.scene.gravity, 0, sizeof p.scene.gravity);
    refused(&p, "gravity is zero and has no direction");
}

/* The weights of the nodes [N], half of their elements each and what hangs there, over the mean
 * weight; and the compliance of the elements [1/N]. */
static void expect_line(const Parts *p, double mean, const double weight[ELEMENTS + 1],
                        const double compliance[ELEMENTS]) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&p->scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    for (int j = 0; j <= ELEMENTS; j++)
        CHECK_NEAR(mean * view.weight_length[j], weight[j], 1e-12 * 200); /* rounding of sums */
    for (int e = 0; e < ELEMENTS; e++)
        CHECK_NEAR(view.compliance * view.compliance_factor[e], compliance[e], 1e-12 * 1e-5);
    assert_false(view.uniform);
    cps_evolution_destroy(evolution);
}

static void each_node_carries_its_own(void **state) {
    (void)state;
    Parts p;
    make(&p);
    /* elements of 100, 100, 40, 0, 0, 0 N; 30 N at node 1, -10 N at node 4 */
    expect_line(&p, (4 * 50 + 2 * 20 + 30 + 10) / 12.0, (double[]){50, 130, 70, 20, -10, 0, 0},
                (double[]){1e-5, 1e-5, 0.25e-5, 0.5e-5, 0.5e-5, 0.5e-5});
    p.line.point_weight_count = 0;
    expect_line(&p, (4 * 50 + 2 * 20) / 12.0, (double[]){50, 100, 70, 20, 0, 0, 0},
                (double[]){1e-5, 1e-5, 0.25e-5, 0.5e-5, 0.5e-5, 0.5e-5});
    /* weights on a line of one piece, with a weight of its own and without */
    make(&p);
    p.line.section_count = 0;
    p.line.stiffness = 1e5;
    static const double ALIKE[] = {1e-5, 1e-5, 1e-5, 1e-5, 1e-5, 1e-5};
    for (int own = 0; own < 2; own++) {
        const double w = p.line.weight = 5 * own;
        expect_line(&p, w + (30 + 10) / 12.0,
                    (double[]){w, 2 * w + 30, 2 * w, 2 * w, 2 * w - 10, 2 * w, w}, ALIKE);
    }
    /* nothing weighs anything; two weights at one node add up */
    p.weight[0].weight = p.weight[1].weight = 0;
    p.line.weight = 0;
    expect_line(&p, 0, (double[ELEMENTS + 1]){0}, ALIKE);
    p.weight[0] = (CpsPointWeight){.arc_length = 8, .weight = 7};
    p.weight[1] = (CpsPointWeight){.arc_length = 8, .weight = 4};
    expect_line(&p, (7 + 4) / 12.0, (double[]){0, 0, 0, 0, 11, 0, 0}, ALIKE);
    /* inextensible sections */
    make(&p);
    for (int k = 0; k < SECTIONS; k++) p.section[k].stiffness = INFINITY;
    expect_line(&p, (4 * 50 + 2 * 20 + 30 + 10) / 12.0, (double[]){50, 130, 70, 20, -10, 0, 0},
                (double[ELEMENTS]){0});
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(wrong_sections_are_refused),
                                       cmocka_unit_test(wrong_tables_are_refused),
                                       cmocka_unit_test(wrong_breaking_loads_are_refused),
                                       cmocka_unit_test(wrong_dynamic_stiffnesses_are_refused),
                                       cmocka_unit_test(wrong_point_weights_are_refused),
                                       cmocka_unit_test(each_node_carries_its_own)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
