/* SPDX-License-Identifier: BSD-3-Clause */
/* Free decay in surge of the OC3-Hywind spar on its three lines, which follow it quasi-statically
 * (Souza de Cursi 1990, figure 1): the period of small motion against the stiffness of the lines,
 * large motion without friction against an integration of the force of elastic catenaries, and with
 * friction against an integration of the force that the same lines oppose to a body that is led
 * through the same places at rest. */
#include <math.h>
#include <stdio.h>

#include "capstan/evolve.h"
#include "catenary.h"
#include "check.h"

static const double TURN = 6.283185307179586;
/* [kg] of the spar with its turbine, and of the water that goes along in surge; [N/m] stiffness of
 * the lines in surge at rest, by elastic catenaries. */
static const double MASS = 8066048, ADDED = 7.99e6, SURGE = 41181.2;
/* [m] radius and depth of anchors and fairleads, length of a line; [N/m] its weight; [N] EA */
static const double ANCHORS[2] = {853.87, -320}, FAIRLEADS[2] = {5.2, -70}, LENGTH = 902.2,
                    WEIGHT = 698.094, STIFFNESS = 384.243e6;

enum { LINES = 3 };

typedef struct Spar {
    CpsScene scene;
    CpsLine line[LINES];
    CpsPoint point[2 * LINES];
    CpsBody body;
    CpsObstacle bed;
    CpsStage stage[3];
    CpsBodyChange change[2];
} Spar;

static void place(CpsPoint *point, const char *name, int line, const double at[2]) {
    const double angle = TURN * line / LINES;
    *point = cps_point_default();
    point->name = name;
    point->position[0] = at[0] * cos(angle);
    point->position[1] = at[0] * sin(angle);
    point->position[2] = at[1];
}

/* The spar at rest, which moves in surge alone: its weight and the water do nothing to that. */
static void begin(Spar *spar, int elements, double friction) {
    static const char *const NAME[] = {"one", "two", "three", "a1", "a2", "a3", "f1", "f2", "f3"};
    *spar = (Spar){.scene = cps_scene_default(),
                   .body = cps_body_default(),
                   .bed = cps_obstacle_default()};
    spar->bed.name = "bed";
    spar->bed.point[2] = ANCHORS[1];
    spar->bed.friction = friction;
    spar->body.name = "spar";
    spar->body.kind = CPS_BODY_KIND_FREE;
    spar->body.mass = MASS;
    spar->body.added_mass[0] = ADDED;
    for (int i = 1; i < CPS_BODY_DIRECTIONS; i++) spar->body.fixed[i] = true;
    for (int i = 0; i < LINES; i++) {
        CpsLine *line = &spar->line[i];
        *line = cps_line_default();
        line->name = NAME[i];
        line->length = LENGTH;
        line->element_count = elements;
        line->weight = WEIGHT;
        line->stiffness = STIFFNESS;
        line->quasi_static = true;
        line->start.kind = CPS_START_STATIC;
        for (int end = 0; end < 2; end++) {
            line->end[end].kind = CPS_END_KIND_POINT;
            line->end_point[end] = LINES * end + i;
        }
        place(&spar->point[i], NAME[3 + i], i, ANCHORS);
        place(&spar->point[LINES + i], NAME[6 + i], i, FAIRLEADS);
        spar->point[LINES + i].kind = CPS_POINT_KIND_ON_BODY;
    }
    CpsScene *scene = &spar->scene;
    scene->line_count = LINES;
    scene->line = spar->line;
    scene->point_count = 2 * LINES;
    scene->point = spar->point;
    scene->body_count = scene->obstacle_count = 1;
    scene->body = &spar->body;
    scene->obstacle = &spar->bed;
}

/* It is led aside at rest, and let go in the first step in time. */
static void let_go(Spar *spar, double aside, double h, int steps) {
    static const char *const NAME[] = {"aside", "let go", "decay"};
    spar->change[0] = (CpsBodyChange){.kind = CPS_BODY_KIND_HELD,
                                      .position = {aside, 0, 0},
                                      .rotation = {1, 0, 0, 0}};
    spar->change[1] = (CpsBodyChange){.kind = CPS_BODY_KIND_FREE};
    for (int i = 0; i < 3; i++) {
        CpsStage *stage = &spar->stage[i];
        *stage = cps_stage_default();
        stage->name = NAME[i];
        stage->step_count = i == 0 ? 10 : i == 1 ? 1 : steps - 1;
        stage->duration = i == 0 ? 0 : h * stage->step_count;
        if (i < 2) {
            stage->body_change_count = 1;
            stage->body_change = &spar->change[i];
        }
    }
    spar->scene.stage_count = 3;
    spar->scene.stage = spar->stage;
}

static CpsEvolution *open(const CpsScene *scene) {
    CpsEvolution *evolution;
    CpsError err;
    if (cps_evolution_create(scene, &evolution, &err)) fail_msg("%s", err.message);
    return evolution;
}

static void require_certified(const CpsEvolution *evolution) {
    const CpsStepReport report = cps_evolution_report(evolution);
    if (!cps_outcome_is_certified(report.outcome))
        fail_msg("step %d is not certified: outcome %d", report.step_count, (int)report.outcome);
}

static void step(CpsEvolution *evolution) {
    CpsError err;
    if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
    require_certified(evolution);
}

/* The places x_0 .. x_steps; returns what friction has dissipated in time. */
static double decay(int elements, double friction, double aside, double h, int steps, double *x) {
    Spar spar;
    double dissipated = 0;
    begin(&spar, elements, friction);
    let_go(&spar, aside, h, steps);
    CpsEvolution *evolution = open(&spar.scene);
    x[0] = aside;
    for (int i = 0; i < 11; i++) step(evolution); /* the start, and aside */
    for (int i = 1; i <= steps; i++) {
        step(evolution);
        x[i] = cps_evolution_body_report(evolution, 0).position[0];
        dissipated += cps_evolution_report(evolution).ledger.dissipated;
    }
    cps_evolution_destroy(evolution);
    return dissipated;
}

/* The time of crossing number `count` of the rest, downwards and upwards in turn, by the parabola
 * through three places about it. */
static double crossing(const double *x, int steps, double h, int count) {
    for (int i = 1; i < steps; i++) {
        if (x[i] * x[i + 1] > 0 || --count > 0) continue;
        const double b = 0.5 * (x[i + 1] - x[i - 1]), a = 0.5 * (x[i + 1] + x[i - 1]) - x[i];
        double s = -x[i] / b;
        for (int k = 0; k < 20; k++) s = -x[i] / (b + a * s);
        return (i + s) * h;
    }
    fail_msg("the motion does not cross its rest");
    return 0;
}

static void small_motion(void **state) {
    (void)state;
    enum { STEPS = 800 };
    static double x[STEPS + 1];
    const double h = 0.5, exact = TURN * sqrt((MASS + ADDED) / SURGE);
    (void)decay(200, 0, 0.5, h, STEPS, x);
    const double period = (crossing(x, STEPS, h, 6) - crossing(x, STEPS, h, 2)) / 2;
    printf("surge of OC3-Hywind from 0.5 m, added mass %.3g kg, no friction: period %.3f s, by the "
           "stiffness of elastic catenaries %.3f s, %.3f %% off\n",
           ADDED, period, exact, 100 * (period / exact - 1));
    CHECK_LESS(fabs(period / exact - 1), 2e-3);
}

/* [N] on the spar at x, of elastic catenaries that lie on a bed without friction */
static double catenaries(double x) {
    static Catenary c[LINES];
    double force = 0;
    for (int i = 0; i < LINES; i++) {
        const double angle = TURN * i / LINES,
                     out[2] = {(ANCHORS[0] - FAIRLEADS[0]) * cos(angle) - x,
                               (ANCHORS[0] - FAIRLEADS[0]) * sin(angle)};
        const double away = hypot(out[0], out[1]);
        if (!(c[i].h > 0))
            c[i] = (Catenary){LENGTH, WEIGHT, STIFFNESS, true, 736938.3235, 535727.45};
        if (!catenary_solve(&c[i], away, FAIRLEADS[1] - ANCHORS[1]))
            fail_msg("no catenary at %g m", x);
        force += c[i].h * out[0] / away;
    }
    return force;
}

/* Central differences of m x'' = F(x) from rest, with `fine` steps to each of the motion. */
static void integrate(double aside, double h, int fine, int steps, double *x) {
    const double dt = h / fine, by = dt * dt / (MASS + ADDED);
    double before = aside, now = aside + 0.5 * by * catenaries(aside);
    x[0] = aside;
    for (int i = 1; i <= steps * fine; i++) {
        if (i % fine == 0) x[i / fine] = now;
        const double next = 2 * now - before + by * catenaries(now);
        before = now;
        now = next;
    }
}

static double largest_difference(const double *x, const double *y, int steps, int stride) {
    double most = 0;
    for (int i = 0; i <= steps; i++) most = fmax(most, fabs(x[i * stride] - y[i]));
    return most;
}

/* The steps in time lose amplitude and lag, both at second order; what is left is the mesh. */
static void large_motion(void **state) {
    (void)state;
    enum { STEPS = 250 };
    static double x[3][4 * STEPS + 1], exact[STEPS + 1];
    const double aside = 10, h = 1;
    double off[3];
    integrate(aside, h, 20, STEPS, exact);
    for (int k = 0; k < 3; k++) {
        (void)decay(100, 0, aside, h / (1 << k), STEPS << k, x[k]);
        off[k] = largest_difference(x[k], exact, STEPS, 1 << k);
    }
    const double ratio = (off[0] - off[1]) / (off[1] - off[2]);
    printf("surge of OC3-Hywind from 10 m, two periods, no friction: %.4f, %.4f, %.4f m off an "
           "integration of catenaries with steps of 1, 0.5, 0.25 s and 100 elements; differences "
           "in the ratio %.2f\n",
           off[0], off[1], off[2], ratio);
    CHECK_LESS(fabs(ratio - 4), 0.2);
    CHECK_LESS(off[2], 1e-3 * aside);
    (void)decay(400, 0, aside, h / 4, STEPS << 2, x[2]);
    const double fine = largest_difference(x[2], exact, STEPS, 4);
    printf(".. with 400 elements and steps of 0.25 s %.4f m\n", fine);
    CHECK_LESS(fine, 1e-3 * aside);
}

/* The body is led from place to place at rest, and at each the force of its lines gives the next
 * one by central differences; returns what friction dissipates from where it is let go. */
static double integrate_led(int elements, double friction, double aside, double h, int steps,
                            double *x) {
    Spar spar;
    CpsError err;
    double dissipated = 0;
    begin(&spar, elements, friction);
    CpsEvolution *evolution = open(&spar.scene);
    step(evolution);
    CpsBodyChange change = {.kind = CPS_BODY_KIND_HELD, .rotation = {1, 0, 0, 0}};
    CpsStage move = cps_stage_default();
    move.body_change_count = 1;
    move.body_change = &change;
    const double by = h * h / (MASS + ADDED);
    for (int i = 1 - 10; i <= steps; i++) { /* ten steps aside, as the motion has */
        change.position[0] = i <= 0 ? aside * (i + 10) / 10 : x[i];
        if (cps_evolution_move(evolution, &move, &err)) fail_msg("%s", err.message);
        require_certified(evolution);
        if (i > 0) dissipated += cps_evolution_report(evolution).ledger.dissipated;
        if (i < 0 || i == steps) continue;
        const double force = cps_evolution_body_report(evolution, 0).lines[0];
        if (i == 0) x[0] = aside;
        x[i + 1] = i == 0 ? aside + 0.5 * by * force : 2 * x[i] - x[i - 1] + by * force;
    }
    cps_evolution_destroy(evolution);
    return dissipated;
}

/* The energy of the spar and its lines without friction, at rest at x: minus the integral of their
 * force, by Simpson's rule. */
static double stored(double x) {
    enum { PARTS = 200 };
    double sum = 0;
    for (int i = 0; i <= PARTS; i++)
        sum += (i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2) * catenaries(x * i / PARTS);
    return -sum * x / (3 * PARTS);
}

static void rough_motion(void **state) {
    (void)state;
    enum { STEPS = 250, ELEMENTS = 100 };
    static double x[2][2 * STEPS + 1], led[2 * STEPS + 1];
    const double aside = 10, h = 1;
    double off[2], dissipated = 0;
    const double reference = integrate_led(ELEMENTS, 0.5, aside, h / 2, 2 * STEPS, led);
    for (int k = 0; k < 2; k++) {
        dissipated = decay(ELEMENTS, 0.5, aside, h / (1 << k), STEPS << k, x[k]);
        off[k] = 0;
        for (int i = 0; i <= STEPS; i++) off[k] = fmax(off[k], fabs(x[k][i << k] - led[2 * i]));
    }
    double least = 0, most = 0;
    for (int i = 0; i <= 2 * STEPS; i++) {
        least = fmin(least, x[1][i]);
        if (i > STEPS) most = fmax(most, x[1][i]);
    }
    const double share = dissipated / stored(aside);
    printf("surge of OC3-Hywind from 10 m, two periods, mu = 0.5: %.4f, %.4f m off an integration "
           "at rest with steps of 1, 0.5 s; turns at %.4f and %.4f m; friction takes %.3f kJ, "
           "in the integration %.3f kJ, %.2f %% of the energy at 10 m\n",
           off[0], off[1], least, most, dissipated / 1000, reference / 1000, 100 * share);
    CHECK_LESS(off[1], 5e-3 * aside);
    CHECK_LESS(3.2 * off[1], off[0]);
    CHECK_NEAR(dissipated, reference, 0.02 * reference);
    CHECK_GREATER(share, 0.01);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(small_motion),
                                       cmocka_unit_test(large_motion),
                                       cmocka_unit_test(rough_motion)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
