/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines of sections with clumps and buoys.
 *
 * The closed form is that of the elastic catenary, piece by piece: the horizontal force H is the
 * same everywhere, the vertical force V falls by w L over a piece and by P at a clump (a buoy has
 * P < 0). A piece with V at its upper and v at its lower end spans
 *     x = (H/w) [asinh(V/H) - asinh(v/H)] + H L/EA
 *     z = (H/w) [sqrt(1 + (V/H)^2) - sqrt(1 + (v/H)^2)] + (V + v) L/(2 EA)
 * and without weight x = H L/T + H L/EA, z = V L/T + V L/EA. H and V at end B are found by Newton's
 * method with differences. */
#include <stdio.h>

#include "cases.h"

enum { PIECES = 4 };

/* A piece, and the weight that hangs at its lower end. */
typedef struct Piece {
    double length, weight, stiffness, below;
} Piece;

/* Chain on the anchor's side, wire without weight, rope and chain; from B to A. */
static const Piece LINE[PIECES] = {{20, 300, 4e7, 500},
                                   {30, 40, 2e6, -2500},
                                   {25, 0, 8e6, 1500},
                                   {45, 250, 6e7, 0}};

static void span(double h, double v, const Piece *piece, double *x, double *z) {
    const double l = piece->length, w = piece->weight, lower = v - w * l;
    if (w > 0) {
        *x += h / w * (asinh(v / h) - asinh(lower / h));
        *z += h / w * (sqrt(1 + v * v / h / h) - sqrt(1 + lower * lower / h / h));
    } else {
        *x += h * l / hypot(h, v);
        *z += v * l / hypot(h, v);
    }
    *x += h * l / piece->stiffness;
    *z += (v + lower) * l / (2 * piece->stiffness);
}

/* What hangs below a piece, or lifts it, if these do. */
typedef struct Hung {
    bool clumps, buoy;
} Hung;

static double below(const Piece *piece, Hung hung) {
    return (piece->below > 0 ? hung.clumps : hung.buoy) ? piece->below : 0;
}

/* The span from A to B with the forces h, v at end B. */
static void whole(double h, double v, Hung hung, double out[2]) {
    out[0] = out[1] = 0;
    for (int k = 0; k < PIECES; k++) {
        span(h, v, &LINE[k], &out[0], &out[1]);
        v -= LINE[k].weight * LINE[k].length + below(&LINE[k], hung);
    }
}

static void closed_form(double x, double z, Hung hung, double *h, double *v) {
    *h = 8000;
    *v = 9000;
    double error = INFINITY;
    for (int i = 0; i < 200 && error > 1e-12; i++) {
        double at[2], by_h[2], by_v[2];
        const double dh = 1e-4, dv = 1e-4;
        whole(*h, *v, hung, at);
        whole(*h + dh, *v, hung, by_h);
        whole(*h, *v + dv, hung, by_v);
        const double a = (by_h[0] - at[0]) / dh, b = (by_v[0] - at[0]) / dv,
                     c = (by_h[1] - at[1]) / dh, d = (by_v[1] - at[1]) / dv, det = a * d - b * c;
        const double rx = x - at[0], rz = z - at[1];
        const double step = (d * rx - b * rz) / det, rise = (a * rz - c * rx) / det;
        *h = step < -0.5 * *h ? 0.5 * *h : *h + step;
        *v += rise;
        error = hypot(rx, rz);
    }
    CHECK_LESS(error, 1e-10);
}

/* The case's line with `each` elements a piece; its sections go from A to B. */
static void build(Case *c, int each, Hung hung, CpsSection *section, CpsPointWeight *point,
                  double *length) {
    double total = 0, arc = 0;
    for (int k = 0; k < PIECES; k++) total += LINE[k].length;
    case_begin(c, total, each * PIECES, 0, 1);
    for (int k = 0; k < PIECES; k++) {
        const Piece *piece = &LINE[PIECES - 1 - k];
        section[k] = (CpsSection){.length = piece->length,
                                  .weight = piece->weight,
                                  .stiffness = piece->stiffness};
        if (k > 0) point[k - 1] = (CpsPointWeight){.arc_length = arc, .weight = below(piece, hung)};
        arc += piece->length;
        for (int i = 0; i < each; i++) length[k * each + i] = piece->length / each;
    }
    c->line.section = section;
    c->line.section_count = PIECES;
    c->line.point_weight = point;
    c->line.point_weight_count = PIECES - 1;
    c->line.element_length = length;
}

static double force_error(int each, double x, double z, Hung hung, double h, double v) {
    static Case c;
    static double length[PIECES * 256];
    CpsSection section[PIECES];
    CpsPointWeight point[PIECES];
    build(&c, each, hung, section, point, length);
    case_laid(&c, x, z);
    Run run = case_open(&c);
    (void)case_step(&run);
    const CpsEndReport end = cps_evolution_line_report(run.evolution, 0).end[CPS_END_B];
    const double error = hypot(end.force[0] - h, end.force[2] - v);
    case_close(&run);
    return error;
}

/* Forces at the nodes are those of the pieces; the shape of an element is its chord. Order 2. */
static void catenary_of_sections(void **state) {
    (void)state;
    static const Hung HUNG[] = {{false, false}, {true, false}, {false, true}, {true, true}};
    for (int i = 0; i < 4; i++) {
        double h, v, error[4];
        closed_form(95, 30, HUNG[i], &h, &v);
        printf("sections%s%s: H %.6f N, V %.6f N at end B\n", HUNG[i].clumps ? ", clumps" : "",
               HUNG[i].buoy ? ", buoy" : "", h, v);
        for (int k = 0; k < 4; k++) {
            char figure[60];
            error[k] = force_error(8 << k, 95, 30, HUNG[i], h, v);
            snprintf(figure, sizeof figure, "force at B, %d elements a section, error [N]", 8 << k);
            show("catenary of sections", figure, 0, error[k]);
        }
        for (int k = 1; k < 3; k++) CHECK_NEAR(order(error[k], error[k + 1]), 2, 0.1);
        CHECK_LESS(error[3], 1e-4 * h);
    }
}

/* The same line as one and as its sections joined at points, which bear the clumps and the buoy:
 * one discrete problem, whose places are known to the root of its gap over scale, which is
 * rounding. */
static void sections_as_lines(void **state) {
    (void)state;
    enum { EACH = 32, N = EACH * PIECES };
    static Case c;
    static double length[N];
    static const Hung ALL = {true, true};
    static const char *const NAME[] = {"p0", "p1", "p2", "p3", "p4", "l0", "l1", "l2", "l3"};
    CpsSection section[PIECES];
    CpsPointWeight hung[PIECES];
    build(&c, EACH, ALL, section, hung, length);
    case_laid(&c, 95, 30);
    Run run = case_open(&c);
    const CpsLineView one = case_step(&run);
    CpsLine line[PIECES];
    CpsPoint point[PIECES + 1];
    for (int k = 0; k <= PIECES; k++) {
        const bool is_end = k == 0 || k == PIECES;
        point[k] = cps_point_default();
        point[k].name = NAME[k];
        point[k].kind = is_end ? CPS_POINT_KIND_HELD : CPS_POINT_KIND_FREE;
        point[k].position[0] = 95.0 * k / PIECES;
        point[k].position[2] = 30.0 * k / PIECES;
        if (!is_end) point[k].weight = hung[k - 1].weight;
    }
    for (int k = 0; k < PIECES; k++) {
        const bool turned = k % 2;
        line[k] = cps_line_default();
        line[k].name = NAME[PIECES + 1 + k];
        line[k].length = section[k].length;
        line[k].element_count = EACH;
        line[k].weight = section[k].weight;
        line[k].stiffness = section[k].stiffness;
        line[k].start.kind = CPS_START_STATIC;
        for (int e = 0; e < 2; e++) {
            line[k].end[e].kind = CPS_END_KIND_POINT;
            line[k].end_point[e] = (e == 0) != turned ? k : k + 1;
        }
    }
    CpsScene scene = c.scene;
    scene.obstacle_count = 0;
    scene.line_count = PIECES;
    scene.line = line;
    scene.point_count = PIECES + 1;
    scene.point = point;
    scene.stage_count = 0;
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    double off = 0, force = 0;
    for (int k = 0; k < PIECES; k++) {
        const CpsLineView piece = cps_evolution_line_view(evolution, k);
        for (int j = 0; j <= EACH; j++)
            for (int a = 0; a < 3; a++)
                off = fmax(off, fabs(piece.position[3 * (k % 2 ? EACH - j : j) + a] -
                                     one.position[3 * (k * EACH + j) + a]));
        for (int e = 0; e < EACH; e++)
            force = fmax(force,
                         fabs(piece.tension[k % 2 ? EACH - 1 - e : e] - one.tension[k * EACH + e]));
    }
    const double total = one.arc_length[N];
    show("sections as lines", "places apart, per length", 0, off / total);
    show("sections as lines", "tensions apart, per largest", 0, force / one.tension[N - 1]);
    CHECK_LESS(off / total, 1e-9);
    CHECK_LESS(force / one.tension[N - 1], 1e-9);
    cps_evolution_destroy(evolution);
    case_close(&run);
}

static CpsLineView last_step(Case *c, Run *run, double *position, double *tension, int n) {
    *run = case_open(c);
    CpsLineView view = {0};
    while (cps_evolution_remaining_count(run->evolution) > 0) view = case_step(run);
    for (int i = 0; i < 3 * (n + 1); i++) position[i] = view.position[i];
    for (int i = 0; i < n; i++) tension[i] = view.tension[i];
    return view;
}

/* A line on a rough bed, pulled out and aside, in one piece or in three alike with a clump and a
 * buoy of no weight. */
static void pulled(bool in_sections, double stiffness, double *position, double *tension) {
    enum { N = 60 };
    static Case c;
    const CpsSection section[3] = {
        {.type = "a", .length = 20, .weight = 50, .stiffness = stiffness},
        {.type = "b", .length = 35, .weight = 50, .stiffness = stiffness},
        {.type = "c", .length = 5, .weight = 50, .stiffness = stiffness}};
    const CpsPointWeight point[2] = {{.arc_length = 30}, {.arc_length = 31, .weight = -0.0}};
    Run run;
    case_begin(&c, 60, N, in_sections ? 7 : 50, in_sections ? 3 : stiffness);
    case_bed(&c, 0.6);
    case_straight(&c, 0, 60);
    case_force(&c, 5, 2000, 0, 500);
    case_force(&c, 5, 1000, 900, 300);
    if (in_sections) {
        c.line.section = section;
        c.line.section_count = 3;
        c.line.point_weight = point;
        c.line.point_weight_count = 2;
    }
    (void)last_step(&c, &run, position, tension, N);
    case_close(&run);
}

static void sections_alike(void **state) {
    (void)state;
    static const double STIFFNESS[] = {1e6, INFINITY};
    for (int k = 0; k < 2; k++) {
        double one[2][3 * 61], two[2][60];
        for (int variant = 0; variant < 2; variant++)
            pulled(variant > 0, STIFFNESS[k], one[variant], two[variant]);
        for (int i = 0; i < 3 * 61; i++) CHECK_NEAR(one[1][i], one[0][i], 60 * 1e-9);
        for (int i = 0; i < 60; i++) CHECK_NEAR(two[1][i], two[0][i], 2000 * 1e-7);
    }
}

/* What presses on the bed is all that weighs, clumps included, less what lifts. */
static void bed_bears_the_rest(void **state) {
    (void)state;
    static Case c;
    const CpsSection section[2] = {{.length = 30, .weight = 20, .stiffness = 1e6},
                                   {.length = 30, .weight = 90, .stiffness = 3e6}};
    const CpsPointWeight point[4] = {{.arc_length = 10, .weight = 700},
                                     {.arc_length = 40, .weight = -1200},
                                     {.arc_length = 40, .weight = 100},
                                     {.arc_length = 50}};
    Run run;
    case_begin(&c, 60, 120, 0, 1);
    case_bed(&c, 0.4);
    case_straight(&c, 0, 60);
    c.line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    c.line.section = section;
    c.line.section_count = 2;
    c.line.point_weight = point;
    c.line.point_weight_count = 4;
    case_force(&c, 1, 0, 0, 0);
    double position[3 * 121], tension[120], sum = 0;
    const CpsLineView view = last_step(&c, &run, position, tension, 120);
    for (int j = 0; j <= 120; j++) sum += view.reaction[j];
    show("clumps and buoys on a bed", "reaction [N]", 30 * 20 + 30 * 90 - 400, sum);
    CHECK_NEAR(sum, 30 * 20 + 30 * 90 - 400, 1e-6);
    CHECK_GREATER(position[3 * 80 + 2], 0.1); /* the buoy has left the bed */
    CHECK_NEAR(position[3 * 20 + 2], 0, 1e-9);
    case_close(&run);
}

/* With gravity all weights change in the same ratio, and the ledger closes at the order of the
 * steps. */
static void gravity_changes(void **state) {
    (void)state;
    double imbalance[2];
    for (int fine = 0; fine < 2; fine++) {
        static Case c;
        static double length[PIECES * 16];
        CpsSection section[PIECES];
        CpsPointWeight point[PIECES];
        build(&c, 16, (Hung){true, true}, section, point, length);
        case_laid(&c, 95, 30);
        case_move(&c, fine ? 20 : 10, 95, 0, 30);
        c.stage[0].gravity_changes = true;
        c.stage[0].gravity[2] = -4;
        Run run = case_open(&c);
        double sum = 0, turnover = 0;
        while (cps_evolution_remaining_count(run.evolution) > 0) {
            (void)case_step(&run);
            const CpsLedger ledger = cps_evolution_line_report(run.evolution, 0).ledger;
            sum += ledger.imbalance;
            turnover += fabs(ledger.gravity);
        }
        const CpsEndReport end = cps_evolution_line_report(run.evolution, 0).end[CPS_END_B];
        imbalance[fine] = fabs(sum) / turnover;
        printf("gravity 9.81 to 4: imbalance %.3g of the turnover, V %.6f N\n", imbalance[fine],
               end.force[2]);
        case_close(&run);
    }
    CHECK_LESS(imbalance[1], 0.3 * imbalance[0] + 1e-12);
}

/* The largest tension over the breaking load: of a hanging line of four sections, first by its
 * weakest section, then by the force at its upper end, half an element's weight above the force in
 * its last element. */
static void utilisation_is_of_the_weakest(void **state) {
    (void)state;
    static const double WEAK[2][PIECES] = {{0, 3e4, 0, 0}, {9e4, 0, 0, 7e4}};
    for (int k = 0; k < 2; k++) {
        static Case c;
        static double length[PIECES * 16];
        CpsSection section[PIECES];
        CpsPointWeight point[PIECES];
        build(&c, 16, (Hung){true, true}, section, point, length);
        for (int i = 0; i < PIECES; i++) {
            section[i].has_breaking_load = WEAK[k][i] > 0;
            section[i].breaking_load = WEAK[k][i];
        }
        case_laid(&c, 95, 30);
        Run run = case_open(&c);
        (void)case_step(&run);
        const CpsLineReport report = cps_evolution_line_report(run.evolution, 0);
        const CpsLineView view = cps_evolution_line_view(run.evolution, 0);
        double most = 0, at = 0, arc = 0;
        for (int e = 0; e < PIECES * 16; e++) {
            const double load = WEAK[k][e / 16], l = view.element_length[e];
            const double *p = &view.segment_force[3 * e];
            const double own = load > 0 ? sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / load : 0;
            CHECK_NEAR(view.breaking_load[e], load > 0 ? load : INFINITY, 0);
            if (own > most) at = arc + l / 2;
            most = fmax(most, own);
            arc += l;
        }
        const double end[2] = {k ? report.end[0].tension / 9e4 : 0,
                               k ? report.end[1].tension / 7e4 : 0};
        if (fmax(end[0], end[1]) > most) at = end[1] > end[0] ? arc : 0;
        most = fmax(most, fmax(end[0], end[1]));
        assert_true(report.has_utilisation && view.has_breaking_load && most > 0);
        printf("utilisation %.6f at %.3f m of %.3f m\n", report.utilisation,
               report.utilisation_arc_length, arc);
        CHECK_RELATIVE(report.utilisation, most, 1e-9);
        CHECK_NEAR(report.utilisation_arc_length, at, 1e-9 * arc);
        case_close(&run);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(catenary_of_sections), cmocka_unit_test(sections_as_lines),
        cmocka_unit_test(sections_alike),       cmocka_unit_test(bed_bears_the_rest),
        cmocka_unit_test(gravity_changes),      cmocka_unit_test(utilisation_is_of_the_weakest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
