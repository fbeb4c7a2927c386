/* SPDX-License-Identifier: BSD-3-Clause */
/* Drums that give, in time: a rope that a clump draws through one, a step that is too long for the
 * way of a node round the axis, and a clump that lands on a stiff one. Each figure is printed. */
#include <string.h>

#include "time_rig.h"

static const double G = 9.81;

/* A drum about the y axis, and a clump at the end of a rope that is held at x = `anchor`. */
typedef struct Drum {
    double radius, stiffness, friction;
    double mass, start[3], velocity[3], bearing_area;
    double anchor, height, length, line_mass, line_stiffness, width;
    int elements;
    bool thrown; /* the clump, on a string without weight; else it is let go from equilibrium */
    double duration;
    int steps;
} Drum;

/* A run, and what is true of its steps. */
typedef struct Run {
    CpsEvolution *evolution;
    int steps, certified, landed, most_trials;
    double apart;          /* [m] the end of the rope from the clump, its place and its reference */
    double left;           /* [N] that nothing balances at the clump */
    double open, turnover; /* [J] of the ledger, of certified steps */
    double off;            /* [N] of the reaction at the clump from k A d */
} Run;

static CpsObstacle obstacle_of(const Drum *drum) {
    CpsObstacle out = cps_obstacle_default();
    out.name = "drum";
    out.kind = CPS_OBSTACLE_CYLINDER;
    out.radius = drum->radius;
    memcpy(out.axis, (const double[]){0, 1, 0}, sizeof out.axis);
    out.stiffness = drum->stiffness;
    out.friction = drum->friction;
    return out;
}

static CpsPoint clump_of(const Drum *drum) {
    CpsPoint out = cps_point_default();
    out.name = "clump";
    out.kind = drum->thrown ? CPS_POINT_KIND_FREE : CPS_POINT_KIND_HELD;
    memcpy(out.position, drum->start, sizeof drum->start);
    memcpy(out.velocity, drum->velocity, sizeof drum->velocity);
    out.weight = drum->mass * G;
    out.inertia = drum->mass;
    out.bearing_area = drum->bearing_area;
    return out;
}

static Run open_run(const Drum *drum) {
    CpsScene scene = cps_scene_default();
    CpsLine line = cps_line_default();
    CpsStage stage = cps_stage_default();
    CpsObstacle obstacle = obstacle_of(drum);
    CpsPoint clump = clump_of(drum);
    CpsPointChange let_go = {.point = 0, .kind = CPS_POINT_KIND_FREE};
    Run run = {.steps = 0};
    CpsError err;
    const double shape[6] = {drum->anchor,  0, drum->height, drum->start[0], drum->start[1],
                             drum->start[2]};
    line.name = "rope";
    line.length = drum->length;
    line.element_count = drum->elements;
    line.weight = drum->line_mass * G;
    line.inertia = drum->line_mass;
    line.quasi_static = drum->thrown;
    line.stiffness = drum->line_stiffness;
    line.bearing_width = drum->width;
    line.start = (CpsStart){.kind = drum->thrown ? CPS_START_STRAIGHT : CPS_START_STATIC,
                            .point_count = 2,
                            .point = shape,
                            .axis = {0, 0, 1}};
    memcpy(line.end[CPS_END_A].value, shape, sizeof line.end[CPS_END_A].value);
    line.end[CPS_END_A].kind = CPS_END_KIND_HELD;
    line.end[CPS_END_B].kind = CPS_END_KIND_POINT;
    line.end_point[CPS_END_B] = 0;
    stage.name = "fall";
    stage.duration = drum->duration;
    stage.step_count = drum->steps;
    stage.point_change_count = !drum->thrown;
    stage.point_change = &let_go;
    scene.time_scheme = CPS_TIME_SCHEME_EULER;
    scene.line_count = scene.point_count = scene.obstacle_count = scene.stage_count = 1;
    scene.line = &line;
    scene.point = &clump;
    scene.obstacle = &obstacle;
    scene.stage = &stage;
    if (cps_evolution_create(&scene, &run.evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    if (drum->thrown) return run;
    if (cps_evolution_step(run.evolution, &err) != CPS_OK)
        fail_msg("%s", err.message); /* statics */
    return run;
}

static double distance(const double *a, const double *b) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

static void step(Run *run, const Drum *drum) {
    CpsError err;
    if (cps_evolution_step(run->evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    const CpsStepReport report = cps_evolution_report(run->evolution);
    const CpsPointReport clump = cps_evolution_point_report(run->evolution, 0);
    const CpsPointMotion motion = cps_evolution_point_motion(run->evolution, 0);
    const CpsLineView view = cps_evolution_line_view(run->evolution, 0);
    const size_t end = 3 * (size_t)drum->elements;
    const double deep = drum->radius - hypot(clump.position[0], clump.position[2]),
                 area = drum->bearing_area + drum->width * drum->length / drum->elements / 2,
                 wanted = drum->stiffness * area * fmax(0, deep);
    run->apart = fmax(run->apart, distance(&view.position[end], clump.position));
    if (!drum->thrown)
        run->apart = fmax(run->apart, distance(&view.reference[end], motion.reference));
    run->left = fmax(run->left, distance(clump.residual, (const double[]){0, 0, 0}));
    if (drum->thrown) run->off = fmax(run->off, fabs(clump.reaction - wanted));
    run->landed += motion.landed;
    if (clump.trial_count > run->most_trials) run->most_trials = clump.trial_count;
    run->steps++;
    if (!cps_outcome_is_certified(report.outcome)) return;
    run->certified++;
    run->open = fmax(run->open, fabs(report.ledger.imbalance));
    run->turnover += cps_evolution_motion(run->evolution).ledger.turnover;
}

static void close_run(Run *run, const char *name) {
    time_report(name, "steps certified", run->steps, run->certified);
    time_report(name, "end of the rope off the clump [m]", 0, run->apart);
    time_report(name, "left at the clump [N]", 0, run->left);
    time_report(name, "remainder of the ledger, of its turnover", 0, run->open / run->turnover);
    time_report(name, "trials for a step, at most", 0, run->most_trials);
    CHECK_LESS(run->apart, 1e-12);
    CHECK_LESS(run->left, 1e-6);
    CHECK_LESS(run->open, 1e-10 * run->turnover);
    cps_evolution_destroy(run->evolution);
}

/* Of a rope between a held end and a clump that falls only the nodes bear, and no element keeps it
 * on one side of the axis: the drum is below it first, and above it at last. */
static void a_rope_goes_through_it(void **unused) {
    (void)unused;
    const Drum drum = {.radius = 0.35,
                       .stiffness = 150000.0,
                       .friction = 0.5,
                       .mass = 30,
                       .start = {0.54, 0, 0.42},
                       .anchor = -1,
                       .height = 0.02,
                       .length = 1.75,
                       .line_mass = 3,
                       .line_stiffness = 5000.0,
                       .width = 0.0065,
                       .elements = 2,
                       .duration = 1,
                       .steps = 100};
    Run run = open_run(&drum);
    for (int k = 0; k < drum.steps; k++) step(&run, &drum);
    const CpsLineView view = cps_evolution_line_view(run.evolution, 0);
    double highest = -INFINITY;
    for (int j = 1; j <= drum.elements; j++) highest = fmax(highest, view.position[3 * j + 2]);
    time_report("through", "height of the rope at last [m]", 0, highest);
    CHECK_LESS(highest, 0);
    close_run(&run, "through");
    assert_int_equal(run.certified, run.steps);
}

/* In one step a node goes by more than a quarter round the axis. That step is not certified, and
 * what comes after it begins with a clump and a rope that are together, and with a ledger that
 * closes. */
static void what_follows_a_step_that_is_too_long(void **unused) {
    (void)unused;
    const Drum drum = {.radius = 0.25379899093132097,
                       .stiffness = 315948.06993444974,
                       .friction = 0.9,
                       .mass = 18.116407222217752,
                       .start = {0.2570401411701471, 0, 0.26586247511843386},
                       .anchor = -1,
                       .height = 0.10072851936386656,
                       .length = 1.6370240697391658,
                       .line_mass = 4.146566235057877,
                       .line_stiffness = 15509.3162959083,
                       .width = 0.0065,
                       .elements = 5,
                       .duration = 1,
                       .steps = 121};
    Run run = open_run(&drum);
    for (int k = 0; k < drum.steps; k++) step(&run, &drum);
    close_run(&run, "too long");
    assert_int_equal(run.certified, run.steps - 1);
}

/* Thrown on a drum that hardly gives the clump goes along it by a good part of the radius in a
 * step, in which it sinks by hardly anything. */
static void a_clump_lands_on_a_stiff_one(void **unused) {
    (void)unused;
    const Drum drum = {.radius = 1,
                       .stiffness = 1e9,
                       .friction = 0.6,
                       .mass = 150,
                       .start = {-0.9, 0, 1.2},
                       .velocity = {6, 0, -3},
                       .bearing_area = 1,
                       .anchor = -1.9,
                       .height = 1.2,
                       .length = 1,
                       .line_mass = 0,
                       .line_stiffness = 1e-10,
                       .width = 0.01,
                       .elements = 1,
                       .thrown = true,
                       .duration = 0.6,
                       .steps = 10};
    Run run = open_run(&drum);
    for (int k = 0; k < drum.steps; k++) step(&run, &drum);
    assert_int_equal(run.certified, run.steps);
    assert_true(run.landed > 0);
    time_report("lands", "reaction off k A d [N]", 0, run.off);
    CHECK_LESS(run.off, 1e-6);
    CHECK_LESS(run.most_trials, 40);
    close_run(&run, "lands");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_rope_goes_through_it),
                                       cmocka_unit_test(what_follows_a_step_that_is_too_long),
                                       cmocka_unit_test(a_clump_lands_on_a_stiff_one)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
