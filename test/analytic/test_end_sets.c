/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends held to convex sets (S90 remark 2.3: x in C2, a perfect constraint). What is known
 * beforehand:
 *
 *   - on a rail without friction the pull of a hanging line has no part along the rail: with the
 *     catenary in closed form the place follows by bisection, and the step finds it at order 2;
 *   - remark 2.3.4: an end in a set is in the place, and has the force, of an end held there; the
 *     force is in the normal cone of a ball, a half-space, a disc, an edge and a corner of a box;
 *   - a set that does not bear, or is far larger than the line: the answer of a free end;
 *   - any bounded set of set.h: a kind of set, written as an expression, has the answer of the
 * kind; hulls, sums, intersections and images, whose conic form has unknowns of its own, have that
 * of an end which is held there, with the force in the normal cone;
 *   - the load of an end on a face does as much work as it moves along it, and the reaction none;
 *   - a set farther away than an inextensible line is long, or a load along a rail without ends
 * that nothing else bears: no equilibrium, with its proof. */
#include <math.h>
#include <string.h>

#include "capstan/evolve.h"
#include "catenary.h"
#include "check.h"
#include "splitmix.h"

/* [m] An interior point leaves a place that far inside a boundary that bears tens of newtons. */
static const double INSIDE = 1e-10;

static CpsLine hung(double length, int elements, double stiffness) {
    CpsLine line = cps_line_default();
    line.name = "line";
    line.length = length;
    line.element_count = elements;
    line.weight = 10;
    line.stiffness = stiffness;
    line.start.kind = CPS_START_STATIC;
    line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_HELD};
    line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    return line;
}

static CpsEvolution *solve(const CpsLine *line, CpsOutcome outcome) {
    CpsScene scene = cps_scene_default();
    scene.line_count = 1;
    scene.line = line;
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    if (cps_evolution_step(evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    CHECK_INT((int)cps_evolution_line_report(evolution, 0).outcome, (int)outcome);
    return evolution;
}

/* The pull of the line at (x, z) along the rail; the end goes down it while that is positive. */
static double pull_along(double s, double slope, double stiffness, double *h, double *v) {
    const double x = 6 + s * cos(slope), z = -s * sin(slope);
    Catenary c = {.length = 10, .weight = 10, .stiffness = stiffness, .h = 30, .v = 60};
    if (!catenary_solve(&c, x, z)) fail_msg("no catenary at %g, %g", x, z);
    *h = c.h;
    *v = c.v;
    return c.v * sin(slope) - c.h * cos(slope);
}

static double rail_error(int elements, double slope, double stiffness, double turn) {
    CpsLine line = hung(10, elements, stiffness);
    double low = -3.5, high = 3.5, h, v;
    for (int i = 0; i < 80; i++) {
        const double s = 0.5 * (low + high);
        if (pull_along(s, slope, stiffness, &h, &v) > 0)
            low = s;
        else
            high = s;
    }
    line.constraint[CPS_END_B] =
        (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_RAIL,
                        .point = {6 * cos(turn), 6 * sin(turn), 0},
                        .axis = {3 * cos(slope) * cos(turn), 3 * cos(slope) * sin(turn),
                                 -3 * sin(slope)},
                        .length = INFINITY};
    assert_true(low > -3.4 && low < 3.4);
    CpsEvolution *evolution = solve(&line, CPS_OUTCOME_SOLVED);
    const CpsLineReport report = cps_evolution_line_report(evolution, 0);
    const CpsConstraintReport on = cps_evolution_constraint_report(evolution, 0, CPS_END_B);
    const double *x = report.end[CPS_END_B].position,
                 off = hypot(hypot(x[0] - (6 + low * cos(slope)) * cos(turn),
                                   x[1] - (6 + low * cos(slope)) * sin(turn)),
                             x[2] + low * sin(slope)),
                 wanted[3] = {h * cos(turn), h * sin(turn), v};
    CHECK_LESS(on.residual, 1e-14);
    assert_true(on.is_there && on.is_active);
    for (int a = 0; a < 3; a++) {
        CHECK_NEAR(on.reaction[a], report.end[CPS_END_B].force[a], 1e-12);
        CHECK_NEAR(on.reaction[a], wanted[a], 30 * off + 1e-6 * hypot(h, v));
    }
    const double *u = line.constraint[CPS_END_B].axis;
    CHECK_NEAR(on.reaction[0] * u[0] + on.reaction[1] * u[1] + on.reaction[2] * u[2], 0,
               1e-12 * hypot(h, v));
    cps_evolution_destroy(evolution);
    return off;
}

static void a_rail_is_normal_to_the_pull(void **state) {
    (void)state;
    static const double STIFFNESS[] = {INFINITY, 2e3}, SLOPE[] = {0.3, 0.5, 0.7};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) {
            const double coarse = rail_error(40, SLOPE[k], STIFFNESS[i], 0.3 * k),
                         fine = rail_error(160, SLOPE[k], STIFFNESS[i], 0.3 * k);
            /* order 2: a quarter of the element length has a sixteenth of the error */
            CHECK_LESS(coarse, 1e-2);
            CHECK_LESS(fine, coarse / 12);
        }
}

/* Both ends on rails without ends that lie across each other: no direction is free for both, so the
 * line is drawn along them by a load only until it is taut between them. */
static void rails_across_each_other(void **state) {
    (void)state;
    static const double ANGLE[] = {1, 0.3, 0.1, 0.03};
    for (int k = 0; k < 8; k++) {
        const double c = cos(ANGLE[k / 2]), s = sin(ANGLE[k / 2]);
        CpsLine line = hung(4, 12, k % 2 ? 3e4 : INFINITY);
        static const double ACROSS[] = {0, 0, 0, 0, -4, 0};
        line.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = ACROSS};
        line.end[CPS_END_A].kind = CPS_END_KIND_FREE;
        line.end[CPS_END_B].value[0] = 5;
        for (int end = 0; end < 2; end++)
            line.constraint[end] = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_RAIL,
                                                   .point = {0, end ? -4 : 0, 0},
                                                   .axis = {c, end ? -s : s, 0},
                                                   .length = INFINITY};
        CpsEvolution *evolution = solve(&line, CPS_OUTCOME_SOLVED);
        for (int end = 0; end < 2; end++) {
            const CpsConstraintReport on = cps_evolution_constraint_report(evolution, 0, end);
            const double *u = line.constraint[end].axis;
            assert_true(on.is_active);
            CHECK_NEAR(on.reaction[0] * u[0] + on.reaction[1] * u[1], 0, 1e-9);
        }
        cps_evolution_destroy(evolution);
    }
}

/* Hold the end where the set has it: the same configuration and force. */
static CpsConstraintReport is_as_held(const CpsLine *line, CpsLineReport *report) {
    /* what small programs leave of the nearest place and of the support, docs/sets.md */
    const double leaves = line->constraint[CPS_END_B].kind == CPS_CONSTRAINT_KIND_SET ? 1e-11 : 0;
    CpsEvolution *in_set = solve(line, CPS_OUTCOME_SOLVED);
    const CpsConstraintReport on = cps_evolution_constraint_report(in_set, 0, CPS_END_B);
    CpsLine other = *line;
    *report = cps_evolution_line_report(in_set, 0);
    other.constraint[CPS_END_B].kind = CPS_CONSTRAINT_KIND_NONE;
    other.end[CPS_END_B].kind = CPS_END_KIND_HELD;
    memcpy(other.end[CPS_END_B].value, report->end[CPS_END_B].position, 3 * sizeof(double));
    CpsEvolution *held = solve(&other, CPS_OUTCOME_SOLVED);
    const CpsLineReport as = cps_evolution_line_report(held, 0);
    const CpsLineView view = cps_evolution_line_view(in_set, 0),
                      seen = cps_evolution_line_view(held, 0);
    CHECK_VECTOR(report->end[CPS_END_B].force, as.end[CPS_END_B].force,
                 1e-6 * as.certificate.largest_force);
    for (int j = 0; j < 3 * (line->element_count + 1); j++)
        CHECK_NEAR(view.position[j], seen.position[j], 1e-8 * line->length);
    CHECK_LESS(on.residual, 1e-14 + leaves);
    CHECK_LESS(on.gap, 1e-9 + leaves * as.certificate.largest_force);
    cps_evolution_destroy(in_set);
    cps_evolution_destroy(held);
    return on;
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void an_end_in_a_set_is_as_one_that_is_held(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        CpsLineReport report;
        CpsLine line = hung(10, 60, i ? INFINITY : 5e3);
        CpsConstraint *on = &line.constraint[CPS_END_B];
        *on = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_BALL, .point = {5, 2, 1}, .radius = 1.5};
        CpsConstraintReport found = is_as_held(&line, &report);
        double size = sqrt(dot(found.reaction, found.reaction));
        for (int a = 0; a < 3; a++) /* towards the centre, from the surface */
            CHECK_NEAR(report.end[CPS_END_B].position[a] - on->point[a],
                       -1.5 * found.reaction[a] / size, 1e-7);
        *on = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_HALF_SPACE,
                              .point = {0, 0, -4},
                              .axis = {-1, 0, 2}};
        found = is_as_held(&line, &report);
        CHECK_NEAR(found.reaction[0] * 2 + found.reaction[2], 0,
                   1e-12 * report.certificate.largest_force);
        CHECK_GREATER(found.reaction[2], 1);
        *on = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_DISC,
                              .point = {5, 0, 0},
                              .axis = {0, 0, 1},
                              .radius = 1};
        found =
            is_as_held(&line, &report); /* at its rim, the normal cone of which is a half-plane */
        CHECK_NEAR(report.end[CPS_END_B].position[0], 4, 1e-7);
        CHECK_GREATER(found.reaction[0], 1);
        /* an edge, a corner: outward parts along the axes whose faces are reached, none along
         * others */
        *on =
            (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_BOX, .point = {5, 3, 1}, .size = {2, 2, 2}};
        found = is_as_held(&line, &report);
        CHECK_VECTOR(report.end[CPS_END_B].position, ((double[]){4, 2, 0}), INSIDE);
        for (int a = 0; a < 3; a++) CHECK_GREATER(found.reaction[a], 1);
        on->point[1] = 0;
        found = is_as_held(&line, &report);
        CHECK_NEAR(report.end[CPS_END_B].position[1], 0, 1e-9);
        CHECK_NEAR(found.reaction[1], 0, 1e-9 * report.certificate.largest_force);
        /* an end of a rail bears along it */
        *on = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_RAIL,
                              .point = {5, 0, 0},
                              .axis = {1, 0, 0},
                              .length = 2};
        found = is_as_held(&line, &report);
        CHECK_VECTOR(report.end[CPS_END_B].position, on->point, INSIDE);
        CHECK_GREATER(found.reaction[0], 1);
    }
}

/* The set `of` moved by x, which takes its place. */
static void move(CpsSet **of, double x, double y, double z) {
    CpsSet *moved = NULL;
    assert_int_equal(cps_set_translate((const double[3]){x, y, z}, *of, &moved, NULL), CPS_OK);
    cps_set_release(*of);
    *of = moved;
}

/* The same place and force for a kind of set and for its expression. */
static void a_kind_of_set_is_an_expression(void **state) {
    (void)state;
    static const double FLAT[6] = {1, 0, 0, 1, 0, 0},
                        TURN[9] = {0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1};
    const CpsConstraint kind[] = {
        {.kind = CPS_CONSTRAINT_KIND_BALL, .point = {5, 2, 1}, .radius = 1.5},
        {.kind = CPS_CONSTRAINT_KIND_BOX,
         .point = {5, 3, 1},
         .size = {2, 2, 2},
         .rotation = {2, 0, 0, 1}},
        {.kind = CPS_CONSTRAINT_KIND_DISC, .point = {5, 0, 1}, .axis = {0, 0, 1}, .radius = 1},
        {.kind = CPS_CONSTRAINT_KIND_RAIL, .point = {5, -2, 0}, .axis = {1, 4, 0}, .length = 3}};
    CpsSet *set[4] = {NULL}, *part;
    assert_int_equal(cps_set_ball(3, NULL, 1.5, &set[0], NULL), CPS_OK);
    move(&set[0], 5, 2, 1);
    assert_int_equal(cps_set_box(3, (double[3]){-1, -1, -1}, (double[3]){1, 1, 1}, &part, NULL),
                     CPS_OK);
    assert_int_equal(cps_set_image(3, TURN, part, &set[1], NULL), CPS_OK);
    cps_set_release(part);
    move(&set[1], 5, 3, 1);
    assert_int_equal(cps_set_ball(2, NULL, 1, &part, NULL), CPS_OK);
    assert_int_equal(cps_set_image(3, FLAT, part, &set[2], NULL), CPS_OK);
    cps_set_release(part);
    move(&set[2], 5, 0, 1);
    const double to[3] = {5 + 3 / sqrt(17), -2 + 12 / sqrt(17), 0};
    assert_int_equal(cps_set_segment(3, kind[3].point, to, &set[3], NULL), CPS_OK);
    for (int k = 0; k < 8; k++) {
        CpsLine line = hung(10, 60, k % 2 ? INFINITY : 5e3);
        CpsConstraintReport found[2];
        CpsLineReport report;
        for (int i = 0; i < 2; i++) {
            line.constraint[CPS_END_B] = kind[k / 2];
            /* as an expression about another place */
            if (i)
                line.constraint[CPS_END_B] =
                    (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_SET, .set = set[k / 2]};
            found[i] = is_as_held(&line, &report);
        }
        assert_true(found[0].is_active && found[1].is_active);
        CHECK_VECTOR(found[1].reaction, found[0].reaction, 1e-6 * report.certificate.largest_force);
        /* `point` moves it */
        CpsConstraint *on = &line.constraint[CPS_END_B];
        CpsSet *back = cps_set_retain(set[k / 2]);
        move(&back, 0.3, -7, 100);
        *on =
            (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_SET, .set = back, .point = {-0.3, 7, -100}};
        found[1] = is_as_held(&line, &report);
        CHECK_VECTOR(found[1].reaction, found[0].reaction, 1e-6 * report.certificate.largest_force);
        cps_set_release(back);
    }
    for (int k = 0; k < 4; k++) cps_set_release(set[k]);
}

/* The force is in the normal cone of any set: sup of -r.y over it is -r.x. */
static void any_set_bears_along_its_normals(void **state) {
    (void)state;
    static const double LOW[3] = {-0.4, -0.2, -0.3}, HIGH[3] = {0.1, 0.6, 0.2},
                        THIN[9] = {1, 0.2, 0, -0.3, 0.9, 0.1, 0.7, 0.2, 1e-3},
                        CORNER[15] = {0, 0, 0, 1, 0, 0, 0, 1.5, 0, 0, 0, 0.7, 0.4, 0.5, -0.9};
    CpsSet *ball, *box, *corners, *side, *thin, *set[7];
    assert_int_equal(cps_set_ball(3, NULL, 0.8, &ball, NULL), CPS_OK);
    assert_int_equal(cps_set_box(3, LOW, HIGH, &box, NULL), CPS_OK);
    assert_int_equal(cps_set_hull_of_points(3, 5, CORNER, &corners, NULL), CPS_OK);
    assert_int_equal(cps_set_half_space(3, (double[3]){-1, 0.3, -0.2}, 0.1, &side, NULL), CPS_OK);
    assert_int_equal(cps_set_image(3, THIN, box, &thin, NULL), CPS_OK);
    const CpsSet *const pair[][2] = {{ball, corners}, {ball, box}, {ball, side}, {thin, ball}};
    assert_int_equal(cps_set_hull(2, pair[0], &set[0], NULL), CPS_OK);
    assert_int_equal(cps_set_sum(2, pair[1], &set[1], NULL), CPS_OK);
    assert_int_equal(cps_set_intersection(2, pair[2], &set[2], NULL), CPS_OK);
    assert_int_equal(cps_set_intersection(2, pair[3], &set[3], NULL), CPS_OK);
    assert_int_equal(cps_set_polar(box, &set[4], NULL), CPS_OK);
    assert_int_equal(cps_set_hull_of_points(3, 1, (double[3]){0.2, 0.1, -0.1}, &set[5], NULL),
                     CPS_OK);
    assert_int_equal(cps_set_hull_of_points(3, 3, CORNER, &set[6], NULL), CPS_OK);
    for (int k = 0; k < 14; k++) {
        CpsLine line = hung(10, 60, k % 2 ? INFINITY : 5e3);
        CpsConstraint *on = &line.constraint[CPS_END_B];
        CpsLineReport report;
        *on = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_SET,
                              .set = set[k / 2],
                              .point = {6, -1, 1}};
        if (k / 2 == 4) on->point[0] = 9; /* it reaches 10 m to one side */
        memcpy(line.end[CPS_END_B].value, (double[]){-30, 20, 10}, 3 * sizeof(double));
        const CpsConstraintReport found = is_as_held(&line, &report);
        const double *r = found.reaction, *x = report.end[CPS_END_B].position,
                     size = sqrt(dot(r, r));
        double against[3], own[3], distance[3];
        CpsSetAnswer answer;
        for (int a = 0; a < 3; a++) {
            against[a] = -r[a] / size;
            own[a] = x[a] - on->point[a];
        }
        CHECK_GREATER(size, 1);
        assert_int_equal(cps_set_support(on->set, against, NULL, &answer, NULL), CPS_OK);
        CHECK_NEAR(answer.value, dot(against, own), 1e-9);
        assert_int_equal(cps_set_contains(on->set, own, distance, &answer, NULL), CPS_OK);
        CHECK_GREATER(answer.value, -1e-11);
    }
    for (int k = 0; k < 7; k++) cps_set_release(set[k]);
    CpsSet *const part[] = {ball, box, corners, side, thin};
    for (int k = 0; k < 5; k++) cps_set_release(part[k]);
}

static void a_set_that_does_not_bear_changes_nothing(void **state) {
    (void)state;
    static const CpsConstraint LOOSE[] = {
        {.kind = CPS_CONSTRAINT_KIND_BALL, .radius = 40},
        {.kind = CPS_CONSTRAINT_KIND_HALF_SPACE, .point = {0, 0, -40}, .axis = {0, 1, 3}},
        {.kind = CPS_CONSTRAINT_KIND_BOX, .size = {50, 60, 70}, .rotation = {1, 0.3, 0.2, 0.1}}};
    for (size_t k = 0; k < 2 * sizeof LOOSE / sizeof *LOOSE; k++) {
        CpsLine line = hung(10, 50, k % 2 ? INFINITY : 3e3);
        memcpy(line.end[CPS_END_B].value, (double[]){40, -20, 30}, 3 * sizeof(double));
        CpsEvolution *is_free = solve(&line, CPS_OUTCOME_SOLVED);
        line.constraint[CPS_END_B] = LOOSE[k / 2];
        CpsEvolution *in_set = solve(&line, CPS_OUTCOME_SOLVED);
        const CpsConstraintReport on = cps_evolution_constraint_report(in_set, 0, CPS_END_B);
        const CpsLineView a = cps_evolution_line_view(is_free, 0),
                          b = cps_evolution_line_view(in_set, 0);
        for (int j = 0; j < 3 * 51; j++) CHECK_NEAR(a.position[j], b.position[j], 1e-9);
        for (int e = 0; e < 50; e++) CHECK_NEAR(a.tension[e], b.tension[e], 1e-8 * 60);
        assert_true(on.is_there && !on.is_active);
        CHECK_LESS(sqrt(dot(on.reaction, on.reaction)), 1e-8);
        cps_evolution_destroy(is_free);
        cps_evolution_destroy(in_set);
    }
}

/* A slack line whose end is loaded along a level rail: the load moves it, the reaction does
 * nothing.
 */
static void a_reaction_does_no_work(void **state) {
    (void)state;
    enum { STEPS = 400 };
    CpsLine line = hung(10, 40, 4e3);
    line.constraint[CPS_END_B] = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_RAIL,
                                                 .point = {4, 0, 0},
                                                 .axis = {1, 0.2, -0.3},
                                                 .length = INFINITY};
    CpsEvolution *evolution = solve(&line, CPS_OUTCOME_SOLVED);
    const CpsChange change = {.end = CPS_END_B, .to = {CPS_END_KIND_FREE, {150, 0, 20}}};
    CpsStage move = cps_stage_default();
    CpsError err;
    double ends = 0, stored = 0, before[3], force[3] = {0, 0, 0}, by_hand = 0;
    memcpy(before, cps_evolution_line_report(evolution, 0).end[CPS_END_B].position, sizeof before);
    move.change_count = 1;
    for (int k = 1; k <= STEPS; k++) {
        CpsChange part = change;
        for (int a = 0; a < 3; a++) part.to.value[a] *= (double)k / STEPS;
        move.change = &part;
        if (cps_evolution_move(evolution, &move, &err) != CPS_OK) fail_msg("%s", err.message);
        const CpsLineReport report = cps_evolution_line_report(evolution, 0);
        CHECK_INT((int)report.outcome, CPS_OUTCOME_SOLVED);
        ends += report.ledger.ends;
        stored += report.ledger.elastic + report.ledger.gravity;
        for (int a = 0; a < 3; a++) {
            by_hand += 0.5 * (force[a] + part.to.value[a]) *
                       (report.end[CPS_END_B].position[a] - before[a]);
            force[a] = part.to.value[a];
            before[a] = report.end[CPS_END_B].position[a];
        }
    }
    CHECK_GREATER(ends, 50);
    CHECK_NEAR(ends, by_hand, 1e-9 * ends);
    CHECK_NEAR(ends, stored, 1e-4 * ends); /* the trapezium rule, at order 2 of 400 steps */
    cps_evolution_destroy(evolution);
}

/* A set of this kind whose place nearest to the origin is y, along the unit vector u from it. Of an
 * expression *made is released by the caller: the hull of a ball and places farther on. */
static CpsConstraint set_about(int kind, const double *u, const double *y, uint64_t *random,
                               CpsSet **made) {
    CpsConstraint on = {.kind = (CpsConstraintKind)kind};
    const double r = splitmix(random, 0.2, 5);
    double across[3], size = 0, along;
    for (int a = 0; a < 3; a++) across[a] = splitmix(random, -1, 1);
    along = dot(across, u);
    for (int a = 0; a < 3; a++) size += pow(across[a] -= along * u[a], 2);
    for (int a = 0; a < 3; a++) {
        across[a] /= sqrt(size);
        on.point[a] = y[a];
        on.axis[a] = u[a];
    }
    *made = NULL;
    if (kind == CPS_CONSTRAINT_KIND_RAIL) { /* across, to both sides */
        for (int a = 0; a < 3; a++) {
            on.axis[a] = across[a];
            on.point[a] -= r / 3 * across[a];
        }
        on.length = r;
    }
    if (kind == CPS_CONSTRAINT_KIND_DISC) /* across the way to it */
        for (int a = 0; a < 3; a++) on.point[a] += 0.4 * r * across[a];
    if (kind == CPS_CONSTRAINT_KIND_BALL || kind == CPS_CONSTRAINT_KIND_SET)
        for (int a = 0; a < 3; a++) on.point[a] += r * u[a];
    on.radius = r;
    if (kind == CPS_CONSTRAINT_KIND_SET) {
        CpsSet *ball, *far;
        double corner[9];
        for (int i = 0; i < 9; i++)
            corner[i] = r * (splitmix(random, 0.5, 2) * u[i % 3] + (i / 3 - 1) * across[i % 3]);
        assert_int_equal(cps_set_ball(3, NULL, r, &ball, NULL), CPS_OK);
        assert_int_equal(cps_set_hull_of_points(3, 3, corner, &far, NULL), CPS_OK);
        assert_int_equal(cps_set_hull(2, (const CpsSet *[]){ball, far}, made, NULL), CPS_OK);
        cps_set_release(ball);
        cps_set_release(far);
        on.set = *made;
    }
    return on;
}

/* Sets of any kind in reach of an inextensible line that is held at the origin, by a share of its
 * length, and out of reach: the proof is the unit vector to the nearest place, and what is missing.
 * An elastic line reaches all of them. */
static void reach(void **state) {
    (void)state;
    static const int KIND[] = {CPS_CONSTRAINT_KIND_RAIL, CPS_CONSTRAINT_KIND_HALF_SPACE,
                               CPS_CONSTRAINT_KIND_BALL, CPS_CONSTRAINT_KIND_DISC,
                               CPS_CONSTRAINT_KIND_SET};
    static const double SHARE[] = {-1e-3, -1e-6, 1e-9, 1e-6, 1e-3, 1, 30};
    uint64_t random = 17;
    for (int i = 0; i < 5 * 7 * 8; i++) {
        const double share = SHARE[i / 5 % 7], length = pow(10, splitmix(&random, -1, 3));
        double u[3], y[3], size = 0;
        for (int a = 0; a < 3; a++) size += pow(u[a] = splitmix(&random, -1, 1), 2);
        for (int a = 0; a < 3; a++) y[a] = length * (1 + share) * (u[a] /= sqrt(size));
        CpsLine line = hung(length, 12, INFINITY);
        CpsSet *made;
        line.constraint[CPS_END_B] = set_about(KIND[i % 5], u, y, &random, &made);
        CpsEvolution *evolution =
            solve(&line, share > 0 ? CPS_OUTCOME_INFEASIBLE : CPS_OUTCOME_SOLVED);
        CpsLineReport report = cps_evolution_line_report(evolution, 0);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        if (share > 0) { /* what small programs leave, docs/sets.md, along the way and, by its root,
                            across */
            const double leaves = 2e-12 * (length * (1 + share) + 10);
            CHECK_NEAR(report.proof_length, length * share, leaves);
            CHECK_VECTOR(report.proof, u, 1e-5);
            for (int e = 0; e < 12; e++) assert_true(view.tension[e] == 0);
        } else {
            CHECK_LESS(cps_evolution_constraint_report(evolution, 0, CPS_END_B).residual,
                       1e-11 * length);
        }
        cps_evolution_destroy(evolution);
        line.stiffness = 1e3 * length;
        evolution = solve(&line, CPS_OUTCOME_SOLVED);
        report = cps_evolution_line_report(evolution, 0);
        /* the tension is that of the strain and the weight, and no more */
        CHECK_LESS(report.end[CPS_END_B].tension,
                   line.stiffness * fmax(share, 0) * 1.01 + 30 * line.weight * length);
        cps_evolution_destroy(evolution);
        cps_set_release(made);
    }
}

static void no_equilibrium(void **state) {
    (void)state;
    CpsLine line = hung(10, 20, INFINITY);
    line.constraint[CPS_END_B] =
        (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_BALL, .point = {0, 14, 0}, .radius = 3};
    CpsEvolution *evolution = solve(&line, CPS_OUTCOME_INFEASIBLE);
    CpsLineReport report = cps_evolution_line_report(evolution, 0);
    CHECK_VECTOR(report.proof, ((double[]){0, 1, 0}), 1e-15);
    CHECK_NEAR(report.proof_length, 1, 1e-13);
    cps_evolution_destroy(evolution);
    /* elastic, it reaches the ball */
    line.stiffness = 1e3;
    evolution = solve(&line, CPS_OUTCOME_SOLVED);
    cps_evolution_destroy(evolution);
    /* both ends in sets: a rail and a half-space */
    line.stiffness = INFINITY;
    line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    const double straight[6] = {0, 0, 0, 10, 0, 0};
    line.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = straight};
    line.constraint[CPS_END_A] =
        (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_RAIL, .axis = {0, 1, 0}, .length = INFINITY};
    line.constraint[CPS_END_B] = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_RAIL,
                                                 .point = {10, 0, 0},
                                                 .axis = {0, 2, 0},
                                                 .length = INFINITY};
    memcpy(line.end[CPS_END_B].value, (double[]){0, 7, 0}, 3 * sizeof(double));
    evolution = solve(&line, CPS_OUTCOME_UNBOUNDED);
    report = cps_evolution_line_report(evolution, 0);
    CHECK_VECTOR(report.proof, ((double[]){0, 1, 0}), 1e-15);
    CHECK_NEAR(report.proof_force, 7, 1e-13);
    cps_evolution_destroy(evolution);
    /* one rail with ends is enough to stop it */
    line.stiffness = 1e4;
    line.constraint[CPS_END_A].length = 4;
    evolution = solve(&line, CPS_OUTCOME_SOLVED);
    report = cps_evolution_line_report(evolution, 0);
    CHECK_NEAR(report.end[CPS_END_A].position[1], 4, INSIDE);
    CHECK_NEAR(cps_evolution_constraint_report(evolution, 0, CPS_END_A).reaction[1], -7, 1e-9);
    cps_evolution_destroy(evolution);
}

/* S90 remark 2.3.3: C = C1 and C2, r = r1 + r2: a line on a rough bed (C1) whose end is on a rail
 * (C2). The rail bears what the bed does not, and both are in one certificate. */
static void both_constraints_of_the_remark(void **state) {
    (void)state;
    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    bed.friction = 0.2;
    const double straight[6] = {0, 0, 0, 10, 0, 0};
    CpsLine line = hung(10, 50, 2e3);
    line.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = straight};
    line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_AT_START};
    memcpy(line.end[CPS_END_B].value, (double[]){8, 60, 0}, 3 * sizeof(double));
    line.constraint[CPS_END_B] = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_RAIL,
                                                 .point = {10, 0, 0},
                                                 .axis = {-1, 2, 1},
                                                 .length = 1.5};
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = scene.line_count = 1;
    scene.obstacle = &bed;
    scene.line = &line;
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    if (cps_evolution_step(evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    const CpsLineReport report = cps_evolution_line_report(evolution, 0);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    const CpsConstraintReport on = cps_evolution_constraint_report(evolution, 0, CPS_END_B);
    CHECK_INT((int)report.outcome, CPS_OUTCOME_SOLVED);
    double sum[3] = {0, 0, 0};
    for (int j = 0; j <= 50; j++)
        for (int a = 0; a < 3; a++)
            sum[a] += view.load[3 * j + a] + view.friction_force[3 * j + a] +
                      view.reaction[j] * view.normal[3 * j + a];
    for (int a = 0; a < 3; a++)
        sum[a] += on.reaction[a] + report.end[CPS_END_A].force[a] +
                  report.end[CPS_END_A].friction_force[a];
    CHECK_GREATER(report.end[CPS_END_B].position[1], 0.1);
    CHECK_GREATER(sqrt(dot(on.reaction, on.reaction)), 1);
    /* end A, which is held, bears the weight of its half element, through its own reaction */
    CHECK_NEAR(sum[0], 0, 1e-9);
    CHECK_NEAR(sum[1], 0, 1e-9);
    cps_evolution_destroy(evolution);
}

/* Two weightless lines of length l and stiffness EA go from (-a, 0, 0) and (a, 0, 0) to a point
 * that is loaded by (0, Y, -Z). In a set that bears Z and lets it go along y it is at (0, y, 0)
 * with 2 EA (r/l - 1) y/r = Y, r = hypot(a, y), and the reaction is (0, 0, Z): found by bisection.
 * In one that keeps it within |y| <= b, b < y, it is at b, and bears the rest of Y as well. */
static void a_point_in_a_set(void **state) {
    (void)state;
    static const double A = 3, L = 2.9, STIFFNESS = 4e3, Y = 700, Z = 500, FAR[2] = {0, 2e4};
    double low = 0, high = 3;
    for (int i = 0; i < 80; i++) {
        const double y = 0.5 * (low + high), r = hypot(A, y);
        *(2 * STIFFNESS * (r / L - 1) * y / r < Y ? &low : &high) = y;
    }
    const double y = low, b = 0.4 * y, r = hypot(A, b),
                 rest = Y - 2 * STIFFNESS * (r / L - 1) * b / r;
    const struct {
        CpsConstraint on;
        double y, reaction;
    } with[] = {
        {{.kind = CPS_CONSTRAINT_KIND_RAIL, .axis = {0, 2, 0}, .length = INFINITY}, y, 0},
        {{.kind = CPS_CONSTRAINT_KIND_RAIL, .axis = {0, -2, 0}, .length = 9, .point = {0, 8, 0}},
         y,
         0},
        {{.kind = CPS_CONSTRAINT_KIND_HALF_SPACE, .axis = {0, 0, 3}}, y, 0},
        {{.kind = CPS_CONSTRAINT_KIND_DISC, .axis = {0, 0, 1}, .radius = 5}, y, 0},
        {{.kind = CPS_CONSTRAINT_KIND_BOX, .point = {0, 0, 3}, .size = {4, 8, 6}}, y, 0},
        {{.kind = CPS_CONSTRAINT_KIND_RAIL, .axis = {0, 1, 0}, .length = b}, b, -1},
        {{.kind = CPS_CONSTRAINT_KIND_DISC, .axis = {0, 0, 1}, .radius = b}, b, -1},
        {{.kind = CPS_CONSTRAINT_KIND_BOX, .point = {0, 0, 1}, .size = {1, 2 * b, 2}}, b, -1}};
    for (int k = 0; k < 16; k++) {
        CpsScene scene = cps_scene_default();
        CpsPoint point = cps_point_default();
        CpsLine line[2];
        const double far = FAR[k % 2];
        point.name = "ring";
        point.kind = CPS_POINT_KIND_FREE;
        point.constraint = with[k / 2].on;
        for (int a = 0; a < 3; a++) {
            point.position[a] = far;
            point.constraint.point[a] += far;
            point.force[a] = (const double[3]){0, Y, -Z}[a];
        }
        for (int i = 0; i < 2; i++) {
            line[i] = hung(L, 1 + 4 * i, STIFFNESS);
            line[i].name = i ? "right" : "left";
            line[i].weight = 0;
            line[i].end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_POINT};
            line[i].end[CPS_END_B] =
                (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {far + (i ? A : -A), far, far}};
        }
        scene.point = &point;
        scene.point_count = 1;
        scene.line = line;
        scene.line_count = 2;
        CpsEvolution *evolution = NULL;
        CpsError err;
        if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
        if (cps_evolution_step(evolution, &err) != CPS_OK) fail_msg("%s", err.message);
        CHECK_INT((int)cps_evolution_report(evolution).outcome, (int)CPS_OUTCOME_SOLVED);
        const CpsPointReport at = cps_evolution_point_view(evolution, 0);
        const CpsConstraintReport on = cps_evolution_point_constraint_report(evolution, 0);
        const double *origin = cps_evolution_line_view(evolution, 0).origin;
        const double wanted[3] = {far - origin[0], far - origin[1] + with[k / 2].y,
                                  far - origin[2]};
        /* the forces balance to 1e-11 of the largest, and lines of 1e3 N/m hold the place; far away
         * places have the digits that their origin leaves */
        CHECK_VECTOR(at.position, wanted, 1e-9 + 1e-15 * far);
        CHECK_VECTOR(on.reaction, ((double[]){0, with[k / 2].reaction * rest, Z}), 1e-6);
        CHECK_VECTOR(at.set_reaction, on.reaction, 0);
        assert_true(on.is_there && on.is_active);
        CHECK_LESS(on.residual, 1e-11);
        /* of the place, times the reaction */
        CHECK_LESS(on.gap, (1e-9 + 1e-15 * far) * hypot(Y, Z));
        assert_false(cps_evolution_point_constraint_report(evolution, 1).is_there);
        assert_false(cps_evolution_point_constraint_report(evolution, -1).is_there);
        assert_false(cps_evolution_point_constraint_report(NULL, 0).is_there);
        cps_evolution_destroy(evolution);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_in_a_set),
        cmocka_unit_test(a_rail_is_normal_to_the_pull),
        cmocka_unit_test(an_end_in_a_set_is_as_one_that_is_held),
        cmocka_unit_test(a_kind_of_set_is_an_expression),
        cmocka_unit_test(any_set_bears_along_its_normals),
        cmocka_unit_test(a_set_that_does_not_bear_changes_nothing),
        cmocka_unit_test(a_reaction_does_no_work),
        cmocka_unit_test(reach),
        cmocka_unit_test(no_equilibrium),
        cmocka_unit_test(rails_across_each_other),
        cmocka_unit_test(both_constraints_of_the_remark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
