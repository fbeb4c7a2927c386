/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points on obstacles that give: answers by hand, and what is refused. Lines are weightless
 * strings of one element, so that a point bears with its own area and the halves of its strings. */
#include <string.h>

#include "cases.h"

static const double STRING = 4, EA = 2e4, WEIGHT = 1500, BED = 9e3, WIDTH = 0.02, AREA = 0.7;

/* A clump between two strings to anchors; `area`: with which it bears in all. */
typedef struct Clump {
    CpsLine line[2];
    CpsPoint point[3];
    CpsObstacle bed;
    CpsPointChange change[3];
    CpsStage stage[3];
    double shape[6];
    CpsScene scene;
    double area;
} Clump;

/* The anchors are `span` from the middle, where the clump begins, and all at the height z. */
static void make(Clump *c, double span, double z) {
    static const char *const NAME[] = {"left", "right", "clump"}, *const LINE[] = {"one", "two"};
    *c = (Clump){.scene = cps_scene_default(),
                 .bed = cps_obstacle_default(),
                 .area = AREA + 2 * (WIDTH * STRING / 2)};
    c->bed.name = "bed";
    c->bed.stiffness = BED;
    for (int i = 0; i < 3; i++) {
        c->point[i] = cps_point_default();
        c->point[i].name = NAME[i];
        c->point[i].position[0] = (i == 0 ? -1 : i == 1 ? 1 : 0) * span;
        c->point[i].position[2] = z;
    }
    c->point[2].kind = CPS_POINT_KIND_FREE;
    c->point[2].weight = WEIGHT;
    c->point[2].bearing_area = AREA;
    for (int i = 0; i < 2; i++) {
        c->line[i] = cps_line_default();
        c->line[i].name = LINE[i];
        c->line[i].length = STRING;
        c->line[i].element_count = 1;
        c->line[i].stiffness = EA;
        c->line[i].bearing_width = WIDTH;
        c->line[i].start.kind = CPS_START_STATIC;
        for (int end = 0; end < 2; end++) {
            c->line[i].end[end].kind = CPS_END_KIND_POINT;
            c->line[i].end_point[end] = end == CPS_END_A ? i : 2;
        }
    }
    c->scene.line_count = 2;
    c->scene.line = c->line;
    c->scene.point_count = 3;
    c->scene.point = c->point;
    c->scene.obstacle_count = 1;
    c->scene.obstacle = &c->bed;
    c->scene.stage = c->stage;
}

/* A further stage, in one step, with a force on the clump. */
static void pull(Clump *c, double x, double y, double z) {
    const int k = c->scene.stage_count++;
    c->change[k] = (CpsPointChange){.point = c->scene.point_count - 1,
                                    .kind = CPS_POINT_KIND_FREE,
                                    .value = {x, y, z}};
    c->stage[k] = cps_stage_default();
    c->stage[k].name = "pull";
    c->stage[k].step_count = 1;
    c->stage[k].point_change_count = 1;
    c->stage[k].point_change = &c->change[k];
}

static CpsEvolution *evolve(const Clump *c) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&c->scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

static CpsPointReport step(CpsEvolution *evolution, int point) {
    CpsError err;
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    return cps_evolution_point_report(evolution, point);
}

/* Between slack strings the clump sinks by W/(k A). */
static void a_clump_sinks(void **unused) {
    (void)unused;
    Clump c;
    make(&c, 3, 0.3);
    CpsEvolution *evolution = evolve(&c);
    const CpsPointReport clump = step(evolution, 2);
    CHECK_NEAR(clump.position[2], -WEIGHT / (BED * c.area), 1e-10);
    CHECK_NEAR(clump.reaction, WEIGHT, 1e-6);
    assert_int_equal(clump.obstacle, 0);
    cps_evolution_destroy(evolution);
}

/* ... and without an area of its own by that of the halves of its strings alone. */
static void its_strings_bear_it(void **unused) {
    (void)unused;
    Clump c;
    make(&c, 2, 0.3);
    c.point[2].bearing_area = 0;
    c.point[2].weight = 60;
    CpsEvolution *evolution = evolve(&c);
    CHECK_NEAR(step(evolution, 2).position[2], -60 / (BED * WIDTH * STRING), 1e-10);
    cps_evolution_destroy(evolution);
}

/* One string only, straight and without tension from its anchor, along x on a bed that rises by an
 * angle against x, at the depth to which the clump sinks by its weight. */
static double tie(Clump *c, double angle, double mu, double along[3]) {
    const double area = AREA + WIDTH * STRING / 2, sunk = WEIGHT * cos(angle) / (BED * area);
    make(c, 0, 0);
    c->bed.friction = mu;
    c->bed.normal[0] = sin(angle);
    c->bed.normal[2] = cos(angle);
    along[0] = cos(angle);
    along[1] = 0;
    along[2] = -sin(angle);
    for (int a = 0; a < 3; a++) {
        c->point[0].position[a] = -sunk * c->bed.normal[a];
        c->point[2].position[a] = c->point[0].position[a] + STRING * along[a];
    }
    c->point[1] = c->point[2];
    c->line[0].end_point[CPS_END_B] = 1;
    memcpy(&c->shape[0], c->point[0].position, sizeof c->point[0].position);
    memcpy(&c->shape[3], c->point[1].position, sizeof c->point[1].position);
    c->line[0].start = (CpsStart){.kind = CPS_START_STRAIGHT,
                                  .point_count = 2,
                                  .point = c->shape,
                                  .axis = {0, 0, 1}};
    c->scene.line_count = 1;
    c->scene.point_count = 2;
    return sunk;
}

/* Pulled along the string by P the clump stays up to mu W cos a, less what its weight takes along
 * the slope; beyond that the string has the rest. Let go, it stays as long as the string has no
 * more than friction can hold besides, and then creeps back until it has that. All the while it is
 * as deep as its weight across the slope presses it. */
static void a_clump_is_dragged(void **unused) {
    (void)unused;
    static const double ANGLE[3] = {0, 0.3, -0.2}, MU = 0.4;
    for (int i = 0; i < 3; i++) {
        double along[3];
        Clump c;
        (void)tie(&c, ANGLE[i], MU, along);
        const double down = WEIGHT * sin(ANGLE[i]), pressed = WEIGHT * cos(ANGLE[i]),
                     hold = MU * pressed, load[3] = {0.9 * hold - down, 3 * hold - down, 0},
                     tension[3] = {0, 2 * hold, hold + down};
        for (int k = 0; k < 3; k++)
            pull(&c, load[k] * along[0], load[k] * along[1], load[k] * along[2]);
        CpsEvolution *evolution = evolve(&c);
        double before = 0;
        for (int k = 0; k < 3; k++) {
            const CpsPointReport clump = step(evolution, 1);
            const double far = STRING * tension[k] / EA;
            double at[3];
            for (int a = 0; a < 3; a++) at[a] = c.point[1].position[a] + far * along[a];
            CHECK_VECTOR(clump.position, at, 1e-9);
            /* the force along the normal that belongs to 1e-10 m of depth */
            CHECK_NEAR(clump.reaction, pressed, 1e-10 * BED * (AREA + WIDTH * STRING / 2));
            const double friction = tension[k] - load[k] - down;
            CHECK_NEAR(clump.friction[0] * along[0] + clump.friction[2] * along[2], friction, 1e-5);
            CHECK_NEAR(clump.dissipated, hold * fabs(far - before), 1e-6);
            assert_int_equal(clump.state, k == 0 ? CPS_POINT_STATE_STICK : CPS_POINT_STATE_SLIP);
            before = far;
        }
        cps_evolution_destroy(evolution);
    }
}

/* With anchors that are `span` apart from it and `high` above the bed: the depth at which
 * k A d + 2 EA (s/l - 1) (high + d)/s = W, s = hypot(span, high + d), by bisection; energy: of bed
 * and strings. */
static double depth_between(double span, double high, double weight, double *energy) {
    const double spring = BED * (AREA + WIDTH * STRING);
    double low = 0, far = 10;
    while (far - low > 1e-14) {
        const double d = 0.5 * (low + far), s = hypot(span, high + d);
        *(spring * d + 2 * EA * fmax(0, s / STRING - 1) * (high + d) / s < weight ? &low : &far) =
            d;
    }
    const double strain = fmax(0, hypot(span, high + low) / STRING - 1);
    *energy = 0.5 * spring * low * low + EA * STRING * strain * strain;
    return low;
}

/* Strings and bed share the weight; when the clump is pressed down and let go what both store is in
 * the ledger. */
static void strings_and_bed_share_a_weight(void **unused) {
    (void)unused;
    const double span = 3.9, high = 1.3;
    double energy[2];
    Clump c;
    make(&c, span, high);
    pull(&c, 0, 0, -2 * WEIGHT);
    pull(&c, 0, 0, 0);
    CpsEvolution *evolution = evolve(&c);
    for (int k = 0; k < 3; k++) {
        const double weight = k == 1 ? 3 * WEIGHT : WEIGHT,
                     deep = depth_between(span, high, weight, &energy[k % 2]);
        const CpsPointReport clump = step(evolution, 2);
        const double at[3] = {0, 0, -deep};
        CHECK_VECTOR(clump.position, at, 1e-9);
        CHECK_NEAR(clump.reaction, BED * c.area * deep, 1e-9 * BED * c.area);
        assert_true(clump.reaction > 0.2 * weight && clump.lines[2] > 0.2 * weight);
        if (k == 0) continue;
        const CpsLedger ledger = cps_evolution_report(evolution).ledger;
        CHECK_NEAR(ledger.elastic, energy[k % 2] - energy[(k + 1) % 2], 1e-6);
        CHECK_NEAR(ledger.ends + ledger.obstacles,
                   ledger.elastic + ledger.gravity + ledger.dissipated + ledger.imbalance, 1e-9);
    }
    cps_evolution_destroy(evolution);
}

/* The bed is lifted by 0.1 m and carries the clump along, which lies as deep as before: it has done
 * the work W x 0.1 m, and has stored no more. */
static void the_bed_lifts_a_clump(void **unused) {
    (void)unused;
    const CpsShift shift = {.obstacle = 0, .by = {0, 0, 0.1}};
    Clump c;
    make(&c, 3, 0.3);
    c.bed.moves = true;
    pull(&c, 0, 0, 0);
    c.stage[0].shift_count = 1;
    c.stage[0].shift = &shift;
    CpsEvolution *evolution = evolve(&c);
    (void)step(evolution, 2);
    CHECK_NEAR(step(evolution, 2).position[2], 0.1 - WEIGHT / (BED * c.area), 1e-10);
    const CpsLedger ledger = cps_evolution_report(evolution).ledger;
    CHECK_NEAR(ledger.obstacles, 0.1 * WEIGHT, 1e-6);
    CHECK_NEAR(ledger.elastic, 0, 1e-6);
    cps_evolution_destroy(evolution);
}

/* A clump that is held in the bed is held by what holds it; released to nothing but its weight it
 * comes to rest where that presses it, as one that was never held. */
static void a_held_clump_is_let_go(void **unused) {
    (void)unused;
    Clump c;
    make(&c, 3, 0.3);
    pull(&c, 0, 0, -0.05);
    c.change[0].kind = CPS_POINT_KIND_HELD;
    pull(&c, 0, 0, 0);
    CpsEvolution *evolution = evolve(&c);
    (void)step(evolution, 2);
    const CpsPointReport held = step(evolution, 2);
    CHECK_NEAR(held.position[2], -0.05, 0);
    CHECK_NEAR(held.reaction, 0, 0);
    CHECK_NEAR(held.support[2], 0, 1e-9); /* the strings are slack and without weight */
    CHECK_NEAR(step(evolution, 2).position[2], -WEIGHT / (BED * c.area), 1e-10);
    cps_evolution_destroy(evolution);
}

static void refuse(const Clump *c, const char *words) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    assert_int_equal(cps_evolution_create(&c->scene, &evolution, &err), CPS_ERR_ARGUMENT);
    assert_null(evolution);
    if (!strstr(err.message, words)) fail_msg("'%s' lacks '%s'", err.message, words);
}

static void what_bears_on_nothing_is_refused(void **unused) {
    (void)unused;
    static const double WRONG[] = {-1, NAN, INFINITY};
    static const char WORDS[] = "bearing_area is", HELD[] = "it is held throughout";
    Clump c;
    for (int i = 0; i < 3; i++) {
        make(&c, 3, 0.3);
        c.point[2].bearing_area = WRONG[i];
        refuse(&c, WORDS);
    }
    make(&c, 3, 0.3);
    c.bed.stiffness = 0;
    refuse(&c, "no obstacle gives");
    make(&c, 3, 0.3);
    c.point[2].kind = CPS_POINT_KIND_HELD;
    refuse(&c, HELD);
    pull(&c, 0, 0, 0); /* free at last */
    cps_evolution_destroy(evolve(&c));
    make(&c, 3, 0.3);
    c.point[2].constraint =
        (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_BALL, .point = {0, 0, 0.3}, .radius = 1};
    refuse(&c, "it is held to a set");
    make(&c, 3, 0.3);
    c.line[0].winch[CPS_END_A] = (CpsWinch){true, 0.1};
    refuse(&c, "a winch beside it holds its end at no point");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_clump_sinks),
        cmocka_unit_test(its_strings_bear_it),
        cmocka_unit_test(a_clump_is_dragged),
        cmocka_unit_test(strings_and_bed_share_a_weight),
        cmocka_unit_test(the_bed_lifts_a_clump),
        cmocka_unit_test(a_held_clump_is_let_go),
        cmocka_unit_test(what_bears_on_nothing_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
