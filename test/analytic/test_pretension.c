/* SPDX-License-Identifier: BSD-3-Clause */
/* Lengths for a wanted tension (capstan/pretension.h).
 *
 * The closed form runs the other way: with the horizontal force H, the vertical force V at end B
 * and the pieces of the line, from B to A, the elastic catenary (test_sections.c) gives the place
 * of A explicitly. So the answer is known, and the line is asked for it with another length. The
 * chain of elements has an error of order 2 in their number; it is extrapolated. */
#include "capstan/pretension.h"

#include <stdio.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"
#include "splitmix.h"

enum { PIECES = 3, MOST = 600 };

typedef struct Piece {
    double length, weight, stiffness, below; /* below: clump at its lower end */
} Piece;

typedef struct Mooring {
    int pieces;
    Piece piece[PIECES]; /* from B to A */
    double h, v, x, z;
} Mooring;

/* A line with the lengths of the mooring, or others, in arrays of its own. */
typedef struct Subject {
    CpsScene scene;
    CpsLine line;
    CpsObstacle bed;
    CpsPoint point[2];
    double element[MOST];
    CpsSection section[PIECES];
    CpsPointWeight weight[PIECES];
    CpsFrictionZone zone[1];
} Subject;

static void add_span(const Piece *p, double h, double v, double *x, double *z) {
    const double lower = v - p->weight * p->length;
    *x += h / p->weight * (asinh(v / h) - asinh(lower / h)) + h * p->length / p->stiffness;
    *z += h / p->weight * (hypot(1, v / h) - hypot(1, lower / h)) +
          (v + lower) * p->length / (2 * p->stiffness);
}

static Mooring random_mooring(uint64_t *seed) {
    Mooring m = {.pieces = 1 + (int)splitmix(seed, 0, PIECES)};
    m.h = pow(10, splitmix(seed, 3, 5));
    double v = m.v = m.h * splitmix(seed, -0.5, 2);
    for (int k = 0; k < m.pieces; k++) {
        const double length = splitmix(seed, 20, 60),
                     weight = m.h / length * splitmix(seed, 0.1, 3),
                     stiffness = m.h * pow(10, splitmix(seed, 1.5, 4));
        m.piece[k] = (Piece){.length = length, .weight = weight, .stiffness = stiffness};
        if (k + 1 < m.pieces) m.piece[k].below = m.h * splitmix(seed, -0.2, 0.4);
        add_span(&m.piece[k], m.h, v, &m.x, &m.z);
        v -= m.piece[k].weight * length + m.piece[k].below;
    }
    return m;
}

/* The line from A at 0 0 0 to B, each piece in `each` elements and `by` times as long. */
static void build(Subject *s, const Mooring *m, int each, const double by[PIECES]) {
    *s = (Subject){.scene = cps_scene_default(), .line = cps_line_default()};
    s->scene.line = &s->line;
    s->scene.line_count = 1;
    s->line.name = "line";
    s->line.start.kind = CPS_START_STATIC;
    s->line.end[0] = (CpsEnd){.kind = CPS_END_KIND_HELD};
    s->line.end[1] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {m->x, 0, m->z}};
    s->line.element_count = each * m->pieces;
    s->line.element_length = s->element;
    s->line.section = s->section;
    s->line.section_count = m->pieces;
    s->line.point_weight = s->weight;
    s->line.point_weight_count = m->pieces - 1;
    for (int k = 0; k < m->pieces; k++) {
        const Piece *p = &m->piece[m->pieces - 1 - k];
        const double length = p->length * by[k];
        if (k > 0)
            s->weight[k - 1] = (CpsPointWeight){.arc_length = s->line.length, .weight = p->below};
        s->section[k] =
            (CpsSection){.length = length, .weight = p->weight, .stiffness = p->stiffness};
        for (int i = 0; i < each; i++) s->element[k * each + i] = length / each;
        s->line.length += length;
    }
}

static CpsLineArrays arrays_of(Subject *s) {
    return (CpsLineArrays){s->element, s->section, s->weight, s->zone};
}

/* [N] The pull at an end of the static start. */
static double pull_at(const CpsScene *scene, int end, CpsPull pull) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(scene, &evolution, &err) != CPS_OK) {
        print_error("%s\n", err.message);
        fail();
    }
    CHECK_INT(cps_evolution_step(evolution, &err), CPS_OK);
    const CpsLineReport report = cps_evolution_line_report(evolution, 0);
    CHECK_INT(report.outcome, CPS_OUTCOME_SOLVED);
    const double *f = report.end[end].force;
    const double out = pull == CPS_PULL_HORIZONTAL ? hypot(f[0], f[1]) : report.end[end].tension;
    cps_evolution_destroy(evolution);
    return out;
}

static double find(const CpsScene *scene, int section, int end, CpsPull pull, double wanted) {
    CpsError err;
    double length = NAN;
    if (cps_scene_length_for(scene, 0, section, end, pull, wanted, &length, &err) != CPS_OK) {
        print_error("%s\n", err.message);
        fail();
    }
    return length;
}

/* Random lines of one to three pieces with clumps and buoys, asked for the length of the line or of
 * a section by the tension or its horizontal part at either end, from lengths up to a third off. A
 * tension on the slack side of the least one gives the shorter length with the same tension. */
static void catenaries(void **state) {
    (void)state;
    uint64_t seed = 1603;
    double worst = 0, order = 0;
    int slack = 0;
    enum { CASES = 40 };
    for (int i = 0; i < CASES; i++) {
        const Mooring m = random_mooring(&seed);
        const int end = splitmix(&seed, 0, 1) < 0.5 ? CPS_END_A : CPS_END_B;
        const CpsPull pull = splitmix(&seed, 0, 1) < 0.5 ? CPS_PULL_HORIZONTAL : CPS_PULL_TENSION;
        const bool whole = m.pieces == 1 && splitmix(&seed, 0, 1) < 0.5;
        const int section = whole ? CPS_WHOLE_LINE : (int)splitmix(&seed, 0, m.pieces);
        const int mine = whole ? 0 : section;
        double by[PIECES] = {1, 1, 1}, v = m.v, length[2],
               known = m.piece[m.pieces - 1 - mine].length;
        by[mine] = splitmix(&seed, 0.7, 1.4);
        if (end == CPS_END_A)
            for (int k = 0; k < m.pieces; k++)
                v -= m.piece[k].weight * m.piece[k].length + m.piece[k].below;
        const double wanted = pull == CPS_PULL_HORIZONTAL ? m.h : hypot(m.h, v);
        double found[2];
        for (int fine = 0; fine < 2; fine++) {
            static Subject s;
            build(&s, &m, 60 << fine, by);
            length[fine] = find(&s.scene, section, end, pull, wanted);
            const CpsLineArrays own = arrays_of(&s);
            cps_line_resize(&s.line, section, length[fine], &own);
            found[fine] = pull_at(&s.scene, end, pull);
            /* what 1e-12 in the length leaves of the tension in the stiffest of them, 1e4 */
            CHECK_RELATIVE(found[fine], wanted, 1e-8);
            /* it is the taut one: longer is looser */
            cps_line_resize(&s.line, section, length[fine] * (1 + 1e-5), &own);
            CHECK_LESS(pull_at(&s.scene, end, pull), wanted);
        }
        const double limit = length[1] + (length[1] - length[0]) / 3, error = limit / known - 1;
        if (pull == CPS_PULL_TENSION && error < -1e-3) {
            slack++;
            continue;
        }
        worst = fmax(worst, fabs(error));
        order = fmax(order, fabs(length[1] / known - 1));
        CHECK_NEAR(error, 0, 1e-7); /* what is left is of order 4; 5e-8 is seen */
    }
    printf("lengths for a tension: %d of %d lines on the slack side; else the worst error is %.2e "
           "with 120 elements a piece, %.2e extrapolated\n",
           slack, CASES, order, worst);
    CHECK_BETWEEN(slack, 1, CASES / 2);
}

/* A line on a bed: what lies there has the force H, what hangs is a catenary with V = 0 at its
 * foot. On 100, 200, .. elements the error is below C h^2 of the length. */
static void grounded(void **state) {
    (void)state;
    const double h = 2e4, w = 300, ea = 1e7, hangs = 120, lies = 80, length = hangs + lies;
    Mooring m = {.pieces = 1, .piece = {{length, w, ea, 0}}};
    const Piece up = {hangs, w, ea, 0};
    add_span(&up, h, w * hangs, &m.x, &m.z);
    m.x += lies * (1 + h / ea);
    for (int n = 100; n <= 400; n *= 2) {
        static Subject s;
        const double by[PIECES] = {1.05};
        build(&s, &m, n, by);
        s.bed = cps_obstacle_default();
        s.bed.name = "bed";
        s.bed.friction = 0.7; /* the static start has none */
        s.scene.obstacle = &s.bed;
        s.scene.obstacle_count = 1;
        const double found =
            find(&s.scene, CPS_WHOLE_LINE, CPS_END_B, CPS_PULL_TENSION, hypot(h, w * hangs));
        printf("grounded line, %d elements: length %.6f m, known %.6f m\n", n, found, length);
        CHECK_NEAR(found, length, length * 0.2 / (n * n)); /* 0.11 / n^2 is seen */
    }
}

/* Ends at points, held and free, are held where the points begin; the answer is that of held ends,
 * also where a line of another kind shares the point. */
static void points_stay(void **state) {
    (void)state;
    uint64_t seed = 5;
    Mooring m = random_mooring(&seed);
    static Subject s, alone;
    static CpsLine line[2];
    const double by[PIECES] = {1.1, 1, 1};
    build(&alone, &m, 20, by);
    build(&s, &m, 20, by);
    for (int k = 0; k < 2; k++) {
        s.point[k] = cps_point_default();
        s.point[k].name = k ? "buoy" : "anchor";
        s.point[k].kind = k ? CPS_POINT_KIND_FREE : CPS_POINT_KIND_HELD;
        memcpy(s.point[k].position, s.line.end[k].value, sizeof s.point[k].position);
    }
    for (int k = 0; k < 2; k++) {
        line[k] = s.line;
        line[k].name = k ? "line" : "other";
        for (int e = 0; e < 2; e++) {
            line[k].end[e].kind = CPS_END_KIND_POINT;
            line[k].end_point[e] = e;
        }
    }
    s.scene.line = line;
    s.scene.line_count = 2;
    s.scene.point = s.point;
    s.scene.point_count = 2;
    CpsError err;
    double length = NAN;
    CHECK_INT(cps_scene_length_for(&s.scene, 1, 0, CPS_END_B, CPS_PULL_HORIZONTAL, m.h, &length,
                                   &err),
              CPS_OK);
    CHECK_NEAR(length, find(&alone.scene, 0, CPS_END_B, CPS_PULL_HORIZONTAL, m.h), 0);
}

/* What moves with a section: its elements, clumps and zones in proportion, the rest along. */
static void resize(void **state) {
    (void)state;
    static Subject s;
    const Mooring m = {.pieces = 3, .piece = {{30, 1, 1, 0}, {20, 1, 1, 5}, {10, 1, 1, -5}}};
    const double by[PIECES] = {1, 1, 1};
    build(&s, &m, 2, by); /* 10 from A, 20, 30 */
    s.line.zone = s.zone;
    s.line.zone_count = 1;
    s.zone[0] = (CpsFrictionZone){15, 45, 2};
    const CpsLineArrays own = arrays_of(&s);
    cps_line_resize(&s.line, 1, 40, &own);
    static const double ELEMENT[6] = {5, 5, 20, 20, 15, 15};
    for (int e = 0; e < 6; e++) CHECK_NEAR(s.line.element_length[e], ELEMENT[e], 1e-13);
    CHECK_NEAR(s.line.length, 80, 1e-13);
    CHECK_NEAR(s.line.section[1].length, 40, 0);
    CHECK_NEAR(s.line.point_weight[0].arc_length, 10, 1e-13);
    CHECK_NEAR(s.line.point_weight[1].arc_length, 50, 1e-13);
    CHECK_NEAR(s.line.zone[0].from, 20, 1e-13);
    CHECK_NEAR(s.line.zone[0].to, 65, 1e-13);
    cps_line_resize(&s.line, CPS_WHOLE_LINE, 40, &own);
    for (int e = 0; e < 6; e++) CHECK_NEAR(s.line.element_length[e], ELEMENT[e] / 2, 1e-13);
    CHECK_NEAR(s.line.section[2].length, 15, 1e-13);
    CHECK_NEAR(s.line.zone[0].to, 32.5, 1e-13);
    CHECK_NEAR(s.line.length, 40, 0);
}

/* Tensions that a static start has at a known length are found again from another one: an adjusting
 * section that is short beside the rest, a line that stands upright with the pull at its lower end,
 * ends at one place, and lines that are stretched to several times their length. The length found
 * is no longer, and has that tension. */
static void seldom_lines(void **state) {
    (void)state;
    enum { KINDS = 4, EACH = 12, SHORT = 0, UPRIGHT = 1, CLOSED = 2, SOFT = 3 };
    uint64_t seed = 11;
    for (int k = 0; k < KINDS * EACH; k++) {
        static Subject s;
        const int kind = k % KINDS;
        const double size = pow(10, splitmix(&seed, -1, 3)), w = pow(10, splitmix(&seed, -1, 3)),
                     ea = w * size * pow(10, splitmix(&seed, 1.5, 4));
        Mooring m = {.pieces = kind == SHORT ? 2 : 1,
                     .piece = {{size, w, ea, 0}, {size, w, ea, 0}},
                     .x = 0.9 * size,
                     .z = 0.3 * size};
        const double by[PIECES] = {1, 1, 1};
        if (kind == SHORT) {
            const double share = pow(10, splitmix(&seed, -4.5, -2));
            m.piece[0].length = share * size;
            m.x = size * (1 + share) * splitmix(&seed, 0.99, 1.0003);
            m.z = 0.1 * size * splitmix(&seed, -1, 1);
            m.x = sqrt(m.x * m.x - m.z * m.z);
        } else if (kind == UPRIGHT) {
            m.x = 0;
            m.z = size * splitmix(&seed, 1.001, 1.02) * (1 + 0.5 * w * size / ea);
        } else if (kind == CLOSED) {
            m.x = m.z = 0;
        } else {
            m.piece[0].stiffness = w * size * pow(10, splitmix(&seed, 0, 1.5));
            m.x = size * splitmix(&seed, 2, 300);
        }
        build(&s, &m, 8, by);
        const int end = kind == UPRIGHT ? CPS_END_A : k / KINDS % 2;
        const double wanted = pull_at(&s.scene, end, CPS_PULL_TENSION);
        const double known = kind == SHORT ? s.section[1].length : s.line.length;
        const CpsLineArrays arrays = arrays_of(&s);
        const int section = kind == SHORT ? 1 : CPS_WHOLE_LINE;
        cps_line_resize(&s.line, section, known * pow(10, splitmix(&seed, -1, 1)), &arrays);
        const double found = find(&s.scene, section, end, CPS_PULL_TENSION, wanted);
        assert_true(found <= known * (1 + 1e-6));
        cps_line_resize(&s.line, section, found, &arrays);
        /* a length jumps past a pull by no more than OFF of pretension.c */
        CHECK_NEAR(pull_at(&s.scene, end, CPS_PULL_TENSION) / wanted, 1, 1e-6);
    }
}

static void refused(const CpsScene *scene, int section, int end, CpsPull pull, double wanted,
                    const char *message) {
    CpsError err;
    double length = 7;
    CHECK_INT(cps_scene_length_for(scene, 0, section, end, pull, wanted, &length, &err),
              CPS_ERR_ARGUMENT);
    if (!strstr(err.message, message)) print_error("%s\n", err.message);
    assert_non_null(strstr(err.message, message));
    CHECK_NEAR(length, 7, 0);
}

static void refuses(void **state) {
    (void)state;
    static Subject s;
    const Mooring m = {.pieces = 2,
                       .piece = {{60, 100, 1e6, 0}, {60, 100, 1e6, 0}},
                       .x = 90,
                       .z = 40};
    const double by[PIECES] = {1, 1, 1};
    build(&s, &m, 10, by);
    /* the least tension at B is 7.6 kN; 120 m of line weigh 12 kN */
    refused(&s.scene, 0, CPS_END_B, CPS_PULL_TENSION, 1000, "found no length with 1000 N at end B");
    /* the other section alone is longer than that */
    refused(&s.scene, 0, CPS_END_B, CPS_PULL_TENSION, 1e8, "found no length with 1e+08 N");
    refused(&s.scene, 2, CPS_END_B, CPS_PULL_TENSION, 1e4, "found section 3, it has 2");
    refused(&s.scene, -2, CPS_END_B, CPS_PULL_TENSION, 1e4, "found section -1, it has 2");
    refused(&s.scene, 0, 2, CPS_PULL_TENSION, 1e4, "end 2 or pull 0");
    refused(&s.scene, 0, CPS_END_A, (CpsPull)2, 1e4, "end 0 or pull 2");
    static const double WRONG[] = {0, -1, NAN, INFINITY};
    for (int k = 0; k < 4; k++)
        refused(&s.scene, 0, CPS_END_A, CPS_PULL_TENSION, WRONG[k], "expected a positive finite");
    s.line.end[0].kind = CPS_END_KIND_FREE;
    refused(&s.scene, 0, CPS_END_B, CPS_PULL_TENSION, 1e4, "end A is free");
    CpsError err;
    double length;
    CHECK_INT(cps_scene_length_for(NULL, 0, 0, 0, CPS_PULL_TENSION, 1, &length, &err),
              CPS_ERR_ARGUMENT);
    CHECK_INT(cps_scene_length_for(&s.scene, 0, 0, 0, CPS_PULL_TENSION, 1, NULL, &err),
              CPS_ERR_ARGUMENT);
    CHECK_INT(cps_scene_length_for(&s.scene, 1, 0, 0, CPS_PULL_TENSION, 1, &length, &err),
              CPS_ERR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(catenaries),   cmocka_unit_test(grounded), cmocka_unit_test(points_stay),
        cmocka_unit_test(seldom_lines), cmocka_unit_test(resize),   cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
