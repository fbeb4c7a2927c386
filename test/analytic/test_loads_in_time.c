/* SPDX-License-Identifier: BSD-3-Clause */
/* Quasi-static lines with springs, loads, a potential and drag under a mass that moves in time: it
 * swings about the place, and with the frequency, of the springs that they are. Each figure is
 * printed. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"

static const double PI = 3.14159265358979323846;
static const double GRAVITY = 9.81, MASS = 5, PIECE = 3; /* m/s2, kg, m of each of two elements */
static const double SPRING = 2000, GROUND = 1500;        /* N/m of an element, of its middle node */
static const double RISE = 0.02, PERIODS = 2;            /* m; of the swing */

/* A line without weight, in two elements straight down from a held point, and a mass below it. */
typedef struct Rig {
    CpsScene scene;
    CpsLine line;
    CpsPoint point[2];
    CpsLineLoads loads;
    CpsSpring spring;
    CpsLineForce force;
    CpsCurrent current;
    CpsCurrentRow row;
    CpsStage stage;
    double node[9];
} Rig;

/* The line is as if the mass rested `low` below where no line is stretched. */
static void begin(Rig *rig, double middle, double low) {
    *rig = (Rig){.scene = cps_scene_default(), .line = cps_line_default()};
    rig->scene.gravity[2] = -GRAVITY;
    rig->scene.line = &rig->line;
    rig->scene.line_count = 1;
    rig->scene.point = rig->point;
    rig->scene.point_count = 2;
    rig->scene.stage = &rig->stage;
    rig->scene.stage_count = 1;
    rig->node[5] = -PIECE - middle;
    rig->node[8] = -2 * PIECE - low;
    rig->line.name = "line";
    rig->line.quasi_static = true;
    rig->line.length = 2 * PIECE;
    rig->line.element_count = 2;
    rig->line.stiffness = SPRING * PIECE;
    rig->line.loads = &rig->loads;
    rig->line.start = (CpsStart){.kind = CPS_START_NODES, .point = rig->node, .point_count = 3};
    for (int i = 0; i < 2; i++) {
        rig->point[i] = cps_point_default();
        rig->point[i].name = i ? "mass" : "top";
        rig->line.end[i].kind = CPS_END_KIND_POINT;
        rig->line.end_point[i] = i;
    }
    rig->point[1].kind = CPS_POINT_KIND_FREE;
    rig->point[1].weight = MASS * GRAVITY;
    rig->point[1].inertia = MASS;
    rig->point[1].position[2] = rig->node[8];
    rig->stage = cps_stage_default();
    rig->stage.name = "swing";
}

static double square(void *user, const double x[3], double gradient[3], double second[6]) {
    const double k = *(const double *)user, off = x[2] + PIECE;
    memset(gradient, 0, 3 * sizeof *gradient);
    memset(second, 0, 6 * sizeof *second);
    gradient[2] = k * off;
    second[5] = k;
    return 0.5 * k * off * off;
}

/* The largest difference from z(t) = z* + RISE sin(w t), over RISE. */
static double swing(Rig *rig, double frequency, int steps) {
    CpsEvolution *evolution;
    CpsError err;
    double worst = 0, imbalance = 0, turnover = 0;
    rig->point[1].velocity[2] = RISE * frequency;
    rig->stage.duration = PERIODS * 2 * PI / frequency;
    rig->stage.step_count = steps;
    if (cps_evolution_create(&rig->scene, &evolution, &err)) fail_msg("%s", err.message);
    for (int i = 0; i < steps; i++) {
        if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
        const CpsStepReport report = cps_evolution_report(evolution);
        assert_true(cps_outcome_is_certified(report.outcome));
        const double z = cps_evolution_point_report(evolution, 1).position[2],
                     t = cps_evolution_time(evolution);
        worst = fmax(worst, fabs(z - rig->node[8] - RISE * sin(frequency * t)));
        /* but for what the ledger of a line at rest leaves: its ends' work is that of mean forces
         */
        imbalance += fabs(report.ledger.imbalance -
                          cps_evolution_line_report(evolution, 0).ledger.imbalance);
        turnover += fabs(report.ledger.gravity) + fabs(report.ledger.elastic) +
                    fabs(cps_evolution_point_motion(evolution, 1).ledger.kinetic);
    }
    cps_evolution_destroy(evolution);
    CHECK_LESS(imbalance, 1e-10 * turnover);
    return worst / RISE;
}

/* Order 2 to the closed form. */
static void swing_finer(Rig *rig, double frequency, const char *name) {
    double error[3];
    for (int i = 0; i < 3; i++) error[i] = swing(rig, frequency, 200 << i);
    printf("%s: %.3e, %.3e, %.3e of the amplitude with 100, 200, 400 steps a period: order %.2f\n",
           name, error[0], error[1], error[2], log2(error[1] / error[2]));
    CHECK_NEAR(log2(error[1] / error[2]), 2, 0.1);
    CHECK_LESS(error[2], 5e-3);
}

/* k (low - middle) - k middle - ground middle + f l = 0 of the middle node; of the mass
 * m z'' = -m g - f l/2 + k (low - middle). */
static void springs_and_loads_are_those_at_rest(void **state) {
    (void)state;
    const double load = 40, pull = load * PIECE, both = 2 * SPRING + GROUND,
                 stiffness = SPRING - SPRING * SPRING / both,
                 low = (MASS * GRAVITY + pull / 2 + SPRING * pull / both) / stiffness,
                 middle = (SPRING * low + pull) / both;
    for (int k = 0; k < 2; k++) {
        Rig rig;
        double ground = GROUND / PIECE; /* the middle node stands for one piece */
        begin(&rig, middle, low);
        rig.force = (CpsLineForce){.to = 2 * PIECE, .force = {0, 0, -load}};
        rig.loads.force_count = 1;
        rig.loads.force = &rig.force;
        rig.spring = (CpsSpring){.from = PIECE,
                                 .to = PIECE,
                                 .stiffness = {0, 0, GROUND},
                                 .place = {0, 0, -PIECE}};
        if (k == 0) {
            rig.loads.spring_count = 1;
            rig.loads.spring = &rig.spring;
        } else {
            rig.loads.potential = (CpsPotential){.function = square,
                                                 .user = &ground,
                                                 .from = PIECE / 2,
                                                 .to = 3 * PIECE / 2};
        }
        swing_finer(&rig, sqrt(stiffness / MASS), k ? "a potential" : "a spring");
    }
}

/* The water flows down along the line. */
static void drag_is_that_at_rest(void **state) {
    (void)state;
    const double speed = 1.5, d = 0.1, tangential = 0.05, density = 1000,
                 pull = PIECE * density / 2 * d * PI * tangential * speed * speed,
                 stiffness = SPRING / 2, low = (MASS * GRAVITY + pull) / stiffness,
                 middle = (low + pull / SPRING) / 2;
    Rig rig;
    begin(&rig, middle, low);
    rig.row = (CpsCurrentRow){.velocity = {0, 0, -speed}};
    rig.current = (CpsCurrent){.density = density, .row_count = 1, .row = &rig.row};
    rig.loads.drag = (CpsDrag){.diameter = d, .normal = 1, .tangential = tangential};
    rig.scene.current = &rig.current;
    swing_finer(&rig, sqrt(stiffness / MASS), "drag");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(springs_and_loads_are_those_at_rest),
        cmocka_unit_test(drag_is_that_at_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
