/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points that move in time on obstacles that give, by known answers: a clump that heaves in
 * the bed, that is dropped on it, that slides and is dragged, a line that is cut in two by a point,
 * and moves that a program takes, takes back and saves. Each figure is printed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "splitmix.h"
#include "time_rig.h"

static const double AREA = 0.7, WIDTH = 0.02, STRING = 4, G = 9.81;
/* A string so soft that it pulls with no more than 1e-12 of the weight. */
static const double NO_STIFFNESS = 1e-10;

/* A clump at the end of a string without weight or inertia, which leads along x to an anchor. */
typedef struct Clump {
    CpsLine line;
    CpsPoint point[2];
    CpsObstacle bed;
    CpsPointChange change;
    CpsStage stage;
    double shape[6], mass, area; /* area: with which it bears, its string's half included */
    CpsScene scene;
} Clump;

static void make(Clump *c, double height, double mass, double stiffness, double damping) {
    *c = (Clump){.scene = cps_scene_default(),
                 .bed = cps_obstacle_default(),
                 .line = cps_line_default(),
                 .stage = cps_stage_default(),
                 .shape = {-STRING, 0, height, 0, 0, height},
                 .mass = mass,
                 .area = AREA + WIDTH * STRING / 2};
    c->bed.name = "bed";
    c->bed.stiffness = stiffness;
    c->bed.damping = damping;
    for (int i = 0; i < 2; i++) {
        c->point[i] = cps_point_default();
        c->point[i].name = i ? "clump" : "anchor";
        memcpy(c->point[i].position, &c->shape[3 * i], sizeof c->point[i].position);
    }
    c->point[1].kind = CPS_POINT_KIND_FREE;
    c->point[1].weight = mass * G;
    c->point[1].inertia = mass;
    c->point[1].bearing_area = AREA;
    CpsLine *line = &c->line;
    line->name = "string";
    line->length = STRING;
    line->element_count = 1;
    line->stiffness = NO_STIFFNESS;
    line->bearing_width = WIDTH;
    line->quasi_static = true;
    line->start = (CpsStart){.kind = CPS_START_STRAIGHT,
                             .point_count = 2,
                             .point = c->shape,
                             .axis = {0, 0, 1}};
    for (int end = 0; end < 2; end++) {
        line->end[end].kind = CPS_END_KIND_POINT;
        line->end_point[end] = end;
    }
    c->scene.line_count = 1;
    c->scene.line = line;
    c->scene.point_count = 2;
    c->scene.point = c->point;
    c->scene.obstacle_count = 1;
    c->scene.obstacle = &c->bed;
}

/* A stage in time, with a force on the clump. */
static void history(Clump *c, double duration, int steps, double x, double y, double z) {
    c->change = (CpsPointChange){.point = 1, .kind = CPS_POINT_KIND_FREE, .value = {x, y, z}};
    c->stage.name = "time";
    c->stage.duration = duration;
    c->stage.step_count = steps;
    c->stage.point_change_count = 1;
    c->stage.point_change = &c->change;
    c->scene.stage_count = 1;
    c->scene.stage = &c->stage;
}

/* A run, and what is true of every step. */
typedef struct Motion {
    const Clump *clump;
    CpsEvolution *evolution;
    CpsPointReport report;
    CpsPointMotion motion;
    double place[3];           /* [m] before the step */
    double off, loss;          /* [N] of the law of the bed; [J] of its ledger */
    double open, turnover;     /* [J] of the ledger of the step */
    double damped, dissipated; /* [J] sums */
    int steps;
} Motion;

static Motion start(const Clump *c) {
    Motion m = {.clump = c};
    CpsError err;
    if (cps_evolution_create(&c->scene, &m.evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    memcpy(m.place, c->point[1].position, sizeof m.place);
    return m;
}

/* [J] What the bed has stored at a height. */
static double stored_at(const Clump *c, double z) {
    return z < 0 ? 0.5 * c->bed.stiffness * c->area * z * z : 0;
}

/* The next step. R is that of spring and damping, by the places and the reference; what the bed
 * stores and what it loses are theirs. */
static void step(Motion *m) {
    const Clump *c = m->clump;
    CpsError err;
    if (cps_evolution_step(m->evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    const CpsStepReport step = cps_evolution_report(m->evolution);
    assert_int_equal(step.outcome, CPS_OUTCOME_SOLVED);
    m->report = cps_evolution_point_report(m->evolution, 1);
    m->motion = cps_evolution_point_motion(m->evolution, 1);
    const double z = m->report.position[2], deep = fmax(0, -z), was = fmax(0, -m->place[2]),
                 past = fmax(0, -m->motion.reference[2]), k = c->bed.stiffness * c->area,
                 rate = (deep - past) / m->motion.span,
                 wanted = deep > 0 ? fmax(0, k * deep + c->bed.damping * c->area * rate) : 0,
                 damped = c->bed.damping > 0 && deep > 0
                              ? (m->report.reaction - k * deep) * (deep - was)
                              : 0,
                 stored = stored_at(c, z) - stored_at(c, m->place[2]);
    m->off = fmax(m->off, fabs(m->report.reaction - wanted) / (1 + wanted));
    const double size = 1 + k * fmax(deep * deep, was * was); /* [J] */
    m->loss = fmax(m->loss, fabs(m->motion.ledger.damping - damped) / size);
    m->loss = fmax(m->loss, fabs(step.ledger.elastic - stored) / size);
    m->open += fabs(step.ledger.imbalance);
    m->turnover += m->motion.ledger.turnover + fabs(step.ledger.ends);
    m->damped += damped;
    m->dissipated += m->report.dissipated;
    memcpy(m->place, m->report.position, sizeof m->place);
    m->steps++;
}

static void finish(Motion *m, const char *name) {
    time_report(name, "reaction off that of spring and damping", 0, m->off);
    time_report(name, "energy and loss of the bed, off", 0, m->loss);
    if (m->turnover > 0)
        time_report(name, "remainder of the ledger, of its turnover", 0, m->open / m->turnover);
    CHECK_LESS(m->off, 1e-10);
    CHECK_LESS(m->loss, 1e-10);
    CHECK_NEAR(m->open, 0, 1e-10 * m->turnover);
    cps_evolution_destroy(m->evolution);
}

/* ---- it heaves ---- */

/* m z'' + c A z' + k A z = -m g, never out of the bed: sqrt(k A/m) without damping. Returns the
 * error of z. */
static double heave(CpsTimeScheme scheme, int steps, double damping) {
    const double mass = 150, bed = 9e3, deep = -0.3, time = 1.1;
    Clump c;
    make(&c, deep, mass, bed, damping);
    c.scene.time_scheme = scheme;
    history(&c, time, steps, 0, 0, 0);
    Motion m = start(&c);
    for (int k = 0; k < steps; k++) step(&m);
    const double k = c.area * bed / mass, decay = c.area * damping / mass / 2,
                 rate = sqrt(k - decay * decay), rest = -G / k,
                 exact = rest + (deep - rest) * exp(-decay * time) *
                                    (cos(rate * time) + decay / rate * sin(rate * time));
    char name[48];
    snprintf(name, sizeof name, "heave, %s, %d steps", scheme ? "Euler" : "BDF2", steps);
    const double error = time_report(name, "place after 1.1 s [m]", exact, m.place[2]);
    if (damping > 0) CHECK_GREATER(m.damped, 0);
    finish(&m, name);
    return error;
}

static void a_clump_heaves_in_the_bed(void **unused) {
    (void)unused;
    for (int scheme = 0; scheme < 2; scheme++)
        for (int damped = 0; damped < 2; damped++) {
            double error[4];
            for (int k = 0; k < 4; k++)
                error[k] =
                    heave((CpsTimeScheme)scheme, (scheme ? 800 : 100) << k, damped ? 400.0 : 0.0);
            const double order = log2(error[2] / error[3]);
            time_report(scheme ? "heave, Euler" : "heave, BDF2", "order", scheme ? 1 : 2, order);
            CHECK_NEAR(order, scheme ? 1 : 2, 0.1);
        }
}

/* Damped, it comes to rest at W/(k A). */
static void it_comes_to_rest(void **unused) {
    (void)unused;
    Clump c;
    make(&c, 0.4, 150, 9e3, 1500);
    history(&c, 40, 800, 0, 0, 0);
    Motion m = start(&c);
    for (int k = 0; k < 800; k++) step(&m);
    const double rest = -c.mass * G / (c.bed.stiffness * c.area);
    CHECK_NEAR(time_report("rest", "depth [m]", rest, m.place[2]), 0, 1e-9);
    CHECK_NEAR(m.motion.velocity[2], 0, 1e-9);
    finish(&m, "rest");
}

/* ---- it is dropped ---- */

/* The clump falls on the bed, and rises again. `grown`: by how much its energy, with that of the
 * bed, has ever been above what it was at first, over all of it; by Euler's method, has grown in a
 * step. Returns how high it rises, of the height. */
static double drop(double height, double stiffness, double damping, CpsTimeScheme scheme, int steps,
                   double *grown) {
    const double mass = 150, fall = sqrt(2 * height / G);
    Clump c;
    make(&c, height, mass, stiffness, damping);
    c.scene.time_scheme = scheme;
    const double k = stiffness * c.area / mass;
    history(&c, 2.2 * fall + 6.28318530717959 / sqrt(k), steps, 0, 0, 0);
    Motion m = start(&c);
    double top = -INFINITY, all = 0, before = 0;
    bool landed = false;
    for (int i = 0; i < steps; i++) {
        step(&m);
        const double z = m.place[2], energy = m.motion.kinetic + mass * G * z + stored_at(&c, z);
        if (i == 0)
            all = before = energy;
        else if (!((energy - before) / all <= *grown))
            *grown = (energy - before) / all;
        if (scheme == CPS_TIME_SCHEME_EULER) before = energy;
        landed = landed || m.motion.landed;
        if (landed && z > top) top = z;
        CHECK_NEAR(m.motion.ledger.impact, 0, 0);
    }
    CHECK_LESS(m.off, 1e-9);
    CHECK_LESS(m.loss, 1e-9);
    CHECK_LESS(m.open, 1e-10 * m.turnover);
    cps_evolution_destroy(m.evolution);
    return top / height;
}

static void its_energy_never_grows(void **unused) {
    (void)unused;
    uint64_t random = 20261129;
    double grown = -INFINITY, top = -INFINITY;
    for (int k = 0; k < 200; k++) {
        const double height = pow(10, splitmix(&random, -2, 0.5)),
                     stiffness = pow(10, splitmix(&random, 2.5, 9)),
                     damping = k % 2 ? 0 : stiffness * pow(10, splitmix(&random, -4, 0));
        for (int steps = 100; steps <= 300; steps += 200) {
            const double found =
                drop(height, stiffness, damping,
                     k % 4 == 3 ? CPS_TIME_SCHEME_EULER : CPS_TIME_SCHEME_BDF2, steps, &grown);
            if (found > top) top = found;
        }
    }
    time_report("400 drops", "growth of the energy", 0, grown);
    time_report("400 drops", "rises to, of the height, at most", 1, top);
    CHECK_LESS(grown, 1e-12);
    CHECK_LESS(top, 1 + 1e-12);
}

/* ---- it slides ---- */

/* Thrown along the bed it stops after v^2/(2 mu g), and rests for good. */
static void it_slides_and_rests(void **unused) {
    (void)unused;
    double found[2];
    for (int k = 0; k < 2; k++) {
        const double mu = 0.4, speed = 2.5, bed = 4e4;
        Clump c;
        make(&c, 0, 150, bed, 100);
        c.shape[2] = c.shape[5] = c.point[0].position[2] = c.point[1].position[2] =
            -c.mass * G / (c.area * bed);
        c.bed.friction = mu;
        c.point[1].velocity[1] = speed;
        history(&c, 1.2, 100 << k, 0, 0, 0);
        Motion m = start(&c);
        double before = 0;
        for (int i = 0; i < 100 << k; i++) {
            before = m.place[1];
            step(&m);
        }
        const double exact = speed * speed / (2 * mu * G);
        found[k] = time_report("slide", "distance [m]", exact, m.place[1]) / exact;
        CHECK_NEAR(m.place[1], before, 0);
        CHECK_NEAR(m.motion.velocity[1], 0, 0);
        CHECK_RELATIVE(m.dissipated, 0.5 * c.mass * speed * speed, 0.03);
        finish(&m, "slide");
    }
    CHECK_NEAR(found[0], 0, 0.03);
    CHECK_NEAR(found[1], 0, 0.015);
}

/* Pulled along by P it stays for good below mu W, and above goes with (P - mu W)/m. */
static void it_is_dragged(void **unused) {
    (void)unused;
    for (int k = 0; k < 2; k++) {
        const double mu = 0.4, bed = 4e4, time = 2, hold = mu * 150 * G,
                     pull = (k ? 1.5 : 0.99) * hold;
        const int steps = 400;
        Clump c;
        make(&c, 0, 150, bed, 100);
        c.shape[2] = c.shape[5] = c.point[0].position[2] = c.point[1].position[2] =
            -c.mass * G / (c.area * bed);
        c.bed.friction = mu;
        history(&c, time, steps, 0, 0, 0);
        const CpsSway all = {.of = CPS_SWAY_OF_POINT,
                             .owner = 1,
                             .row_count = 2,
                             .row = (const double[]){0, 0.6 * pull, 0.8 * pull, 0, 0, 0, 0, time,
                                                     0.6 * pull, 0.8 * pull, 0, 0, 0, 0}};
        c.stage.sway_count = 1; /* from the first step on, and not growing */
        c.stage.sway = &all;
        Motion m = start(&c);
        for (int i = 0; i < steps; i++) step(&m);
        const double far = hypot(m.place[0], m.place[1]),
                     exact = k ? 0.5 * (pull - hold) / c.mass * time * time : 0;
        time_report("drag", "distance [m]", exact, far);
        /* the first step, by Euler's method, goes twice as far as it should: a h^2/2 */
        CHECK_NEAR(far, exact, k ? 2 * exact / steps : 0);
        if (k) CHECK_NEAR(m.place[0] / far, 0.6, 1e-9);
        finish(&m, "drag");
    }
}

/* ---- a line that is cut ---- */

/* A rope, thrown on the bed at an angle, in one piece or in two that meet at a free point: nodes
 * are at the same places. It begins slack by a fiftieth, so that no rounding decides whether an
 * element is taut. */
enum { NODES = 9, CUT = 3 };
static const double LONGER = 1.02;

static void throw_rope(int pieces, CpsTimeScheme scheme, double place[3 * NODES]) {
    CpsScene scene = cps_scene_default();
    CpsLine line[2] = {cps_line_default(), cps_line_default()};
    CpsObstacle bed = cps_obstacle_default();
    CpsPoint point = cps_point_default();
    CpsStage stage = cps_stage_default();
    double shape[3 * NODES];
    for (int j = 0; j < NODES; j++) {
        shape[3 * j] = 0.5 * j;
        shape[3 * j + 1] = 0;
        shape[3 * j + 2] = 0.05 * j + 0.02;
    }
    bed.name = "bed";
    bed.stiffness = 2e4;
    bed.damping = 1e3;
    bed.friction = 0.4;
    point.name = "knot";
    point.kind = CPS_POINT_KIND_FREE;
    memcpy(point.position, &shape[3 * CUT], sizeof point.position);
    point.velocity[1] = 2;
    for (int i = 0; i < pieces; i++) {
        const int from = i ? CUT : 0, to = pieces == 2 && i == 0 ? CUT : NODES - 1;
        line[i].name = i ? "two" : "one";
        line[i].length = LONGER * (to - from) * hypot(0.5, 0.05);
        line[i].element_count = to - from;
        line[i].weight = 3 * G;
        line[i].inertia = 3;
        line[i].stiffness = 1e5;
        line[i].bearing_width = 0.2;
        line[i].velocity[1] = 2;
        line[i].start = (CpsStart){.kind = CPS_START_NODES,
                                   .point_count = to - from + 1,
                                   .point = &shape[3 * from],
                                   .axis = {0, 0, 1}};
        for (int end = 0; end < 2; end++) {
            line[i].end[end].kind = CPS_END_KIND_FREE;
            if (pieces == 1 || end == i) continue;
            line[i].end[end].kind = CPS_END_KIND_POINT;
            line[i].end_point[end] = 0;
        }
    }
    stage.name = "fall";
    stage.duration = 1.5;
    stage.step_count = 150;
    scene.time_scheme = scheme;
    scene.line_count = pieces;
    scene.line = line;
    scene.point_count = pieces - 1;
    scene.point = &point;
    scene.obstacle_count = 1;
    scene.obstacle = &bed;
    scene.stage_count = 1;
    scene.stage = &stage;
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    while (cps_evolution_remaining_count(evolution) > 0) {
        if (cps_evolution_step(evolution, &err) != CPS_OK) fail_msg("%s", err.message);
        assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    }
    for (int i = 0; i < pieces; i++) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        memcpy(&place[i ? 3 * CUT : 0], view.position,
               3 * ((size_t)line[i].element_count + 1) * sizeof *place);
    }
    cps_evolution_destroy(evolution);
}

static void a_line_that_is_cut_bears_as_before(void **unused) {
    (void)unused;
    for (int scheme = 0; scheme < 2; scheme++) {
        double whole[3 * NODES], cut[3 * NODES], off = 0;
        throw_rope(1, (CpsTimeScheme)scheme, whole);
        throw_rope(2, (CpsTimeScheme)scheme, cut);
        for (int i = 0; i < 3 * NODES; i++) off = fmax(off, fabs(whole[i] - cut[i]));
        time_report("cut in two", "nodes off those of the whole [m]", 0, off);
        CHECK_LESS(off, 1e-8);
    }
}

/* ---- moves and states ---- */

/* A move with a duration on a bed that gives; a point that is held before may be let go by it. */
static void a_program_moves_it(void **unused) {
    (void)unused;
    Clump c;
    CpsError err;
    make(&c, 0.3, 150, 9e3, 300);
    c.bed.friction = 0.3;
    c.scene.in_time = true;
    c.point[1].kind = CPS_POINT_KIND_HELD;
    c.point[1].bearing_area = 0;
    CpsEvolution *evolution = NULL, *other = NULL;
    if (cps_evolution_create(&c.scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    if (cps_evolution_create(&c.scene, &other, &err) != CPS_OK) fail_msg("%s", err.message);
    const size_t size = cps_evolution_state_size(evolution);
    void *state = malloc(size);
    assert_non_null(state);
    CpsPointChange change = {.point = 1, .kind = CPS_POINT_KIND_FREE, .value = {90, 30, 0}};
    CpsStage move = cps_stage_default();
    move.point_change = &change;
    move.duration = 0.02;
    int deep = 0;
    for (int k = 0; k < 80; k++) {
        move.point_change_count = k == 0;
        if (k % 7 == 3) { /* another one is tried, and taken back */
            const CpsPointChange lift = {.point = 1,
                                         .kind = CPS_POINT_KIND_FREE,
                                         .value = {0, 0, 3000}};
            CpsStage tried = move;
            tried.point_change = &lift;
            tried.point_change_count = 1;
            assert_int_equal(cps_evolution_move(evolution, &tried, &err), CPS_OK);
            assert_int_equal(cps_evolution_take_back(evolution, &err), CPS_OK);
        }
        if (cps_evolution_move(evolution, &move, &err) != CPS_OK) fail_msg("%s", err.message);
        assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
        if (k % 13 == 5) { /* the other goes on from the saved state */
            cps_evolution_save(evolution, state);
            assert_int_equal(cps_evolution_load(other, state, size, &err), CPS_OK);
        } else if (k > 5) {
            if (cps_evolution_move(other, &move, &err) != CPS_OK) fail_msg("%s", err.message);
        }
        if (k < 5) continue;
        const CpsPointReport one = cps_evolution_point_report(evolution, 1),
                             two = cps_evolution_point_report(other, 1);
        assert_memory_equal(one.position, two.position, sizeof one.position);
        assert_memory_equal(one.friction, two.friction, sizeof one.friction);
        deep += one.reaction > 0;
    }
    CHECK_BETWEEN(deep, 20, 74);
    free(state);
    cps_evolution_destroy(evolution);
    cps_evolution_destroy(other);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_clump_heaves_in_the_bed),
        cmocka_unit_test(it_comes_to_rest),
        cmocka_unit_test(its_energy_never_grows),
        cmocka_unit_test(it_slides_and_rests),
        cmocka_unit_test(it_is_dragged),
        cmocka_unit_test(a_line_that_is_cut_bears_as_before),
        cmocka_unit_test(a_program_moves_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
