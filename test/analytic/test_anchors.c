/* SPDX-License-Identifier: BSD-3-Clause */
/* Anchors with a holding capacity: answers by hand, and what is refused. */
#include <math.h>
#include <string.h>

#include "cases.h"

/* An anchor at the origin, from which a weightless string of one element leads to a held end. */
static const double LENGTH = 10, EA = 2e4, CAPACITY = 500, LIMIT = 200;

enum { MOST_STAGES = 8 };

typedef struct Pull {
    CpsLine line;
    CpsPoint anchor;
    CpsObstacle bed;
    CpsChange change[MOST_STAGES];
    CpsStage stage[MOST_STAGES];
    CpsScene scene;
} Pull;

static void make(Pull *p, double x, double y, double z) {
    *p = (Pull){.scene = cps_scene_default(), .bed = cps_obstacle_default()};
    p->anchor = cps_point_default();
    p->anchor.name = "anchor";
    p->anchor.has_holding_capacity = true;
    p->anchor.holding_capacity = CAPACITY;
    p->anchor.drags = true;
    p->line = cps_line_default();
    p->line.name = "string";
    p->line.length = LENGTH;
    p->line.element_count = 1;
    p->line.stiffness = EA;
    p->line.start.kind = CPS_START_STATIC;
    p->line.end[CPS_END_A].kind = CPS_END_KIND_POINT;
    p->line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {x, y, z}};
    p->scene.line_count = 1;
    p->scene.line = &p->line;
    p->scene.point_count = 1;
    p->scene.point = &p->anchor;
    p->scene.stage = p->stage;
}

static void then(Pull *p, double x, double y, double z) {
    const int k = p->scene.stage_count++;
    p->change[k] = (CpsChange){.end = CPS_END_B, .to = {CPS_END_KIND_HELD, {x, y, z}}};
    p->stage[k] = cps_stage_default();
    p->stage[k].name = "pull";
    p->stage[k].change_count = 1;
    p->stage[k].change = &p->change[k];
}

static CpsEvolution *evolve(const Pull *p) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&p->scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

static CpsPointReport step(CpsEvolution *evolution) {
    CpsError err;
    if (cps_evolution_step(evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    return cps_evolution_point_report(evolution, 0);
}

static double size(const double v[3]) { return hypot(hypot(v[0], v[1]), v[2]); }

/* Where the string has the tension of the capacity, EA (d/l - 1) = C. */
static double reach(void) { return LENGTH * (1 + CAPACITY / EA); }

/* Pulled along the string it holds up to its capacity, then follows at the distance at which the
 * tension is that; let go, it stays, slack or taut; pulled the other way, it comes back. */
static void along_a_line(void **unused) {
    (void)unused;
    static const double END[] = {10.1, 10.2, 12, 11.9, 5, 12, 14, -20};
    enum { STEPS = sizeof END / sizeof *END };
    Pull p;
    make(&p, END[0], 0, 0);
    for (int k = 1; k < STEPS; k++) then(&p, END[k], 0, 0);
    CpsEvolution *evolution = evolve(&p);
    double at = 0, dragged = 0;
    for (int k = 0; k < STEPS; k++) {
        const CpsPointReport anchor = step(evolution);
        const double before = at;
        if (END[k] - at > reach()) at = END[k] - reach();
        if (at - END[k] > reach()) at = END[k] + reach();
        dragged += fabs(at - before);
        const double tension = EA * fmax(0, fabs(END[k] - at) / LENGTH - 1);
        CHECK_NEAR(anchor.position[0], at, 1e-9 * LENGTH);
        CHECK_NEAR(hypot(anchor.position[1], anchor.position[2]), 0, 1e-12);
        CHECK_NEAR(anchor.drag[0], at - before, 1e-9 * LENGTH);
        CHECK_NEAR(anchor.dragged, dragged, 1e-8 * LENGTH);
        CHECK_NEAR(anchor.capacity_used, tension / CAPACITY, 1e-8);
        CHECK_NEAR(anchor.dissipated, CAPACITY * fabs(at - before), 1e-6);
        CHECK_NEAR(anchor.uplift_used, 0, 0);
        assert_int_equal(anchor.state, CPS_POINT_STATE_HELD);
        /* it stays exactly */
        if (at == before) CHECK_NEAR(size(anchor.drag), 0, 0);
    }
    cps_evolution_destroy(evolution);
}

/* Pulled upwards at an angle it gives way until the horizontal part of the tension is its capacity;
 * across it holds what there is, and says what of its limit that is. */
static void at_an_angle(void **unused) {
    (void)unused;
    static const double X = 9, Y = 2, Z = 6;
    Pull p;
    make(&p, X, Y, Z);
    p.anchor.has_uplift_limit = true;
    p.anchor.uplift_limit = LIMIT;
    CpsEvolution *evolution = evolve(&p);
    const CpsPointReport anchor = step(evolution);
    const double x = X - anchor.position[0], y = Y - anchor.position[1], flat = hypot(x, y),
                 d = hypot(flat, Z), tension = EA * (d / LENGTH - 1);
    CHECK_NEAR(anchor.position[2], 0, 0);
    CHECK_NEAR(tension * flat / d, CAPACITY, 1e-5);
    CHECK_NEAR(x * Y - y * X, 0, 1e-7);
    CHECK_NEAR(anchor.capacity_used, 1, 1e-8);
    CHECK_NEAR(anchor.uplift_used, tension * Z / d / LIMIT, 1e-6);
    CHECK_NEAR(anchor.support[2], -tension * Z / d, 1e-5);
    assert_true(anchor.dragged > 0.1);
    cps_evolution_destroy(evolution);
}

/* On a bed it drags along the bed, also down a slope; what presses it is the bed's reaction. */
static void on_a_slope(void **unused) {
    (void)unused;
    static const double DOWN = 4, AWAY = 3; /* normal (3, 0, 4)/5 */
    Pull p;
    make(&p, 0.8 * 12, 0, -0.6 * 12);
    p.bed.name = "bed";
    p.bed.normal[0] = AWAY;
    p.bed.normal[2] = DOWN;
    p.bed.friction = 0.3;
    p.scene.obstacle_count = 1;
    p.scene.obstacle = &p.bed;
    CpsEvolution *evolution = evolve(&p);
    const CpsPointReport anchor = step(evolution);
    const double at = 12 - reach(), place[3] = {0.8 * at, 0, -0.6 * at};
    CHECK_VECTOR(anchor.position, place, 1e-8);
    CHECK_NEAR(anchor.capacity_used, 1, 1e-8);
    cps_evolution_destroy(evolution);
}

/* Without `drags` it holds, and says how much too much that is. */
static void without_drags(void **unused) {
    (void)unused;
    Pull p;
    make(&p, 12, 0, 5);
    p.anchor.drags = false;
    p.anchor.has_uplift_limit = true;
    p.anchor.uplift_limit = LIMIT;
    CpsEvolution *evolution = evolve(&p);
    const CpsPointReport anchor = step(evolution);
    const double tension = EA * (13.0 / LENGTH - 1);
    CHECK_NEAR(anchor.capacity_used, tension * 12 / 13 / CAPACITY, 1e-9);
    CHECK_NEAR(anchor.uplift_used, tension * 5 / 13 / LIMIT, 1e-9);
    CHECK_NEAR(size(anchor.position), 0, 0);
    CHECK_NEAR(anchor.dragged, 0, 0);
    cps_evolution_destroy(evolution);
}

/* An inextensible line whose end goes out of reach: the anchor is drawn after it until the line
 * hangs with the tension of its capacity C over the span l (1 - (w l/C)^2/24), the catenary to
 * second order, of which 8 elements leave 1/64. */
static void inextensible(void **unused) {
    (void)unused;
    Pull p;
    make(&p, 9, 0, 0);
    p.line.stiffness = INFINITY;
    p.line.weight = 1;
    p.line.element_count = 8;
    then(&p, 9.5, 0, 0);
    then(&p, 14, 0, 0);
    CpsEvolution *evolution = evolve(&p);
    CHECK_NEAR(step(evolution).dragged, 0, 0);
    CHECK_NEAR(step(evolution).dragged, 0, 0);
    const double sag = LENGTH * pow(p.line.weight * LENGTH / CAPACITY, 2) / 24;
    CHECK_NEAR(step(evolution).dragged, 14 - LENGTH + sag, 0.02 * sag);
    cps_evolution_destroy(evolution);
}

static void refused(const Pull *p, const char *expected) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    assert_int_equal(cps_evolution_create(&p->scene, &evolution, &err), CPS_ERR_ARGUMENT);
    if (!strstr(err.message, expected)) fail_msg("%s", err.message);
}

static void what_is_refused(void **unused) {
    (void)unused;
    Pull p;
    const double wrong[] = {0, -1, NAN, INFINITY};
    for (int k = 0; k < 4; k++) {
        make(&p, 9, 0, 0);
        p.anchor.holding_capacity = wrong[k];
        refused(&p, "point 'anchor': a holding capacity of");
        make(&p, 9, 0, 0);
        p.anchor.has_uplift_limit = true;
        p.anchor.uplift_limit = wrong[k];
        refused(&p, "point 'anchor': an uplift limit of");
    }
    make(&p, 9, 0, 0);
    p.anchor.has_holding_capacity = false;
    refused(&p, "point 'anchor': it drags, but has no holding capacity");
    make(&p, 9, 0, 0);
    p.anchor.kind = CPS_POINT_KIND_FREE;
    refused(&p, "point 'anchor': it has the limits of an anchor, but is not held");
    make(&p, 9, 0, 0);
    p.bed.name = "ball";
    p.bed.kind = CPS_OBSTACLE_SPHERE;
    p.bed.radius = 1;
    p.bed.point[2] = -1;
    p.scene.obstacle_count = 1;
    p.scene.obstacle = &p.bed;
    refused(&p, "it drags, but lies on obstacle 'ball', which is round");
}

/* Pulled with exactly its capacity an anchor balances wherever a slack line lets it go, in each of
 * many directions and sizes. It stays where it was, and most steps say that this is not the only
 * place; so does a clump that is pulled with exactly its friction limit. */
static void at_exactly_the_limit(void **unused) {
    (void)unused;
    static const double SLACK = 10;
    int told = 0;
    for (int k = 0; k < 24; k++) {
        const bool clump = k % 2 == 1;
        const double angle = 0.1 + 0.7 * k, scale = pow(10, k % 5 - 2), capacity = CAPACITY * scale;
        Pull p;
        make(&p, 0, 0, 0);
        p.line.stiffness *= scale;
        CpsLine line[2] = {p.line, p.line};
        p.scene.line = line;
        p.scene.line_count = 2;
        p.anchor.holding_capacity = capacity;
        if (clump) {
            p.anchor.drags = p.anchor.has_holding_capacity = false;
            p.anchor.kind = CPS_POINT_KIND_FREE;
            p.anchor.weight = 2 * capacity;
            p.bed.name = "bed";
            p.bed.friction = 0.5;
            p.scene.obstacle = &p.bed;
            p.scene.obstacle_count = 1;
        }
        const double pull[3] = {capacity * cos(angle), capacity * sin(angle), 0};
        CpsChange change[2];
        for (int i = 0; i < 2; i++) {
            change[i] = (CpsChange){.end = CPS_END_B, .to = {CPS_END_KIND_FREE, {0}}};
            for (int a = 0; a < 3; a++) change[i].to.value[a] = (i == 0 ? 1 : 0.999) * pull[a];
        }
        line[0].end[CPS_END_B] = change[0].to;
        /* statics knows no friction */
        if (clump) memset(line[0].end[CPS_END_B].value, 0, sizeof line[0].end[CPS_END_B].value);
        line[1].name = "slack";
        line[1].length = SLACK * LENGTH;
        line[1].end[CPS_END_B] =
            (CpsEnd){CPS_END_KIND_HELD, {-3 * LENGTH * cos(angle), -3 * LENGTH * sin(angle), 0}};
        for (int i = 0; i < 3; i++) {
            p.stage[i] = cps_stage_default();
            p.stage[i].name = "pull";
            p.stage[i].change_count = 1;
            p.stage[i].change = &change[i == 2];
        }
        p.scene.stage_count = 3;
        CpsEvolution *evolution = evolve(&p);
        for (int i = 0; i < 4; i++) {
            const CpsPointReport anchor = step(evolution);
            CHECK_NEAR(size(anchor.position), 0, 0);
            CHECK_NEAR(size(anchor.slip) + size(anchor.drag), 0, 0);
            CHECK_NEAR(anchor.dragged, 0, 0);
            if (!clump) CHECK_NEAR(anchor.capacity_used, i < 3 ? 1 : 0.999, 1e-8);
            told += cps_evolution_line_report(evolution, 1).places == CPS_PLACES_NEAREST;
        }
        cps_evolution_destroy(evolution);
    }
    /* not where the search begins at the nearest place, and sees no other */
    assert_true(told > 12);
}

/* A clump on a smooth bed between two taut strings, which balance each other: it has one place,
 * halfway, and the reports of the strings say so, in statics and after one of the ends has moved.
 */
static void taut_strings_hold(void **unused) {
    (void)unused;
    for (int k = 0; k < 16; k++) {
        const double angle = 0.4 * k, scale = pow(10, k % 4 - 1), far[] = {2.2, 2.4};
        const double along[3] = {cos(angle), sin(angle), 0};
        Pull p;
        make(&p, 0, 0, 0);
        p.anchor.drags = p.anchor.has_holding_capacity = false;
        p.anchor.kind = CPS_POINT_KIND_FREE;
        p.anchor.weight = EA * scale;
        for (int a = 0; a < 3; a++) p.anchor.position[a] = 0.3 * LENGTH * along[a];
        p.line.stiffness *= scale;
        p.bed.name = "bed";
        p.scene.obstacle = &p.bed;
        p.scene.obstacle_count = 1;
        CpsLine line[2] = {p.line, p.line};
        line[1].name = "other";
        p.scene.line = line;
        p.scene.line_count = 2;
        for (int a = 0; a < 3; a++) {
            line[0].end[CPS_END_B].value[a] = 0;
            line[1].end[CPS_END_B].value[a] = far[0] * LENGTH * along[a];
        }
        then(&p, far[1] * LENGTH * along[0], far[1] * LENGTH * along[1], 0);
        p.change[0].line = 1;
        CpsEvolution *evolution = evolve(&p);
        for (int i = 0; i < 2; i++) {
            const CpsPointReport clump = step(evolution);
            for (int a = 0; a < 3; a++)
                CHECK_NEAR(clump.position[a], 0.5 * far[i] * LENGTH * along[a], 1e-9 * LENGTH);
            for (int own = 0; own < 2; own++)
                CHECK_INT(cps_evolution_line_report(evolution, own).places, CPS_PLACES_UNIQUE);
        }
        cps_evolution_destroy(evolution);
    }
}

static void turn(double angle, const double from[3], double to[3]) {
    to[0] = cos(angle) * from[0] - sin(angle) * from[1];
    to[1] = sin(angle) * from[0] + cos(angle) * from[1];
    to[2] = from[2];
}

/* A mooring whose anchor drags in statics and in a step, turned about z by many angles: it is
 * solved at each, and everything turns with it. */
static void turned_about_z(void **unused) {
    (void)unused;
    enum { TURNS = 24, POINTS = 3, LINES = 3, STEPS = 2 };
    static const double PLACE[POINTS][3] = {{9.95, 1, 2.2}, {-9.8, -1.9, 1.15}, {-1.4, -0.9, 6}},
                        THEN[3] = {-8.9, -2.1, 1.15};
    static const double LONG[LINES] = {12, 9.8, 9.6}, HEAVY[LINES] = {300, 1000, 1000},
                        STIFF[LINES] = {1e9, 1e5, 1e5};
    static const char *const NAME[] = {"anchor", "fixed", "knot", "one", "two", "three"};
    double first[STEPS][POINTS][3];
    for (int t = 0; t < TURNS; t++) {
        const double angle = 0.27 * t;
        CpsPoint point[POINTS];
        CpsLine line[LINES];
        CpsScene scene = cps_scene_default();
        CpsPointChange change = {.point = 1, .kind = CPS_POINT_KIND_HELD};
        CpsStage stage = cps_stage_default();
        turn(angle, THEN, change.value);
        stage.name = "move";
        stage.point_change_count = 1;
        stage.point_change = &change;
        for (int k = 0; k < POINTS; k++) {
            point[k] = cps_point_default();
            point[k].name = NAME[k];
            point[k].kind = k == 2 ? CPS_POINT_KIND_FREE : CPS_POINT_KIND_HELD;
            turn(angle, PLACE[k], point[k].position);
        }
        point[0].has_holding_capacity = point[0].drags = true;
        point[0].holding_capacity = 1000;
        for (int k = 0; k < LINES; k++) {
            line[k] = cps_line_default();
            line[k].name = NAME[POINTS + k];
            line[k].length = LONG[k];
            line[k].element_count = k == 0 ? 1 : 2;
            line[k].weight = HEAVY[k];
            line[k].stiffness = STIFF[k];
            line[k].start.kind = CPS_START_STATIC;
            for (int end = 0; end < 2; end++) line[k].end[end].kind = CPS_END_KIND_POINT;
            line[k].end_point[CPS_END_A] = k == 0 ? 0 : 1;
            line[k].end_point[CPS_END_B] = 2;
        }
        scene.point = point;
        scene.point_count = POINTS;
        scene.line = line;
        scene.line_count = LINES;
        scene.stage = &stage;
        scene.stage_count = 1;
        Pull p = {.scene = scene};
        CpsEvolution *evolution = evolve(&p);
        for (int i = 0; i < STEPS; i++) {
            step(evolution);
            for (int k = 0; k < POINTS; k++) {
                const CpsPointReport at = cps_evolution_point_report(evolution, k);
                double back[3];
                turn(-angle, at.position, back);
                if (t == 0) memcpy(first[i][k], back, sizeof back);
                for (int a = 0; a < 3; a++) CHECK_NEAR(back[a], first[i][k][a], 1e-6 * LONG[0]);
            }
        }
        assert_true(cps_evolution_point_report(evolution, 0).dragged > 0.01);
        cps_evolution_destroy(evolution);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(along_a_line),         cmocka_unit_test(at_an_angle),
        cmocka_unit_test(on_a_slope),           cmocka_unit_test(without_drags),
        cmocka_unit_test(inextensible),         cmocka_unit_test(turned_about_z),
        cmocka_unit_test(at_exactly_the_limit), cmocka_unit_test(what_is_refused),
        cmocka_unit_test(taut_strings_hold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
