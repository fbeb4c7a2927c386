/* SPDX-License-Identifier: BSD-3-Clause */
/* A line that slides over a drum without end: beyond the capstan limit there is no equilibrium, and
 * the step reports this with its proof.
 *
 * A weightless line lies round a cylinder with n nodes that turn it by d each, pulled by F_A and
 * F_B along straight leads. It can be in equilibrium for k^-n <= F_B/F_A <= k^n, k = (1 + mu
 * tan(d/2))/(1 - mu tan(d/2)). Beyond this limit there is a velocity that keeps the length of every
 * element and leaves the drum as fast as friction requires, mu per speed along it; it decreases by
 * k from node to node. With speed 1 in the lead that follows it is k^-n in the lead that pulls, so
 * the loads have the power F_B k^-n - F_A. The fastest node is the one of the lead that lies on the
 * drum before the line turns: it leaves the chord by d/2 and moves at sqrt(1 + mu^2)/(cos(d/2) - mu
 * sin(d/2)). Farther along its path the trailing force helps: e^(-mu a)(cos a + mu sin a) decreases
 * with the angle a. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "rig.h"
#include "splitmix.h"

static const double PI = 3.14159265358979323846;

typedef struct Case {
    double mu, theta, radius, force; /* force of A [N] */
    int nodes;
} Case;

static double limit_of(const Case *c) {
    const double t = c->mu * tan(c->theta / c->nodes / 2);
    return pow((1 + t) / (1 - t), c->nodes);
}

/* Elements in a lead, each as long as the chords: on its way the line then has nodes where others
 * were. */
static int lead_of(const Case *c) { return (int)ceil(1 / (2 * sin(c->theta / c->nodes / 2))); }

/* The line round the drum with its leads, which are a little longer than the radius. */
static void lay_round(Rig *rig, const Case *c) {
    const double d = c->theta / c->nodes, R = c->radius;
    const int lead = lead_of(c), last = c->nodes - 1;
    rig_begin(rig, last + 2 * lead, 0, 1e6 * c->force);
    rig_obstacle(rig, CPS_OBSTACLE_CYLINDER, c->mu)->radius = R;
    for (int k = -lead; k <= last + lead; k++) {
        const int on = k < 0      ? 0
                       : k > last ? last
                                  : k,
                  next = k < 0 ? -1 : last + 1, by = abs(k - on);
        const double x = cos(on * d), z = -sin(on * d);
        rig_point(rig, R * (x + by * (cos(next * d) - x)), 0, R * (z + by * (-sin(next * d) - z)));
    }
    rig_length(rig, R * 2 * sin(d / 2) * (last + 2 * lead));
}

/* A force of size `force` along the lead of an end, outwards. */
static void pull(const Rig *rig, int end, double force, double out[3]) {
    const int n = rig->line.element_count;
    const double *tip = &rig->point[end == CPS_END_A ? 0 : 3 * n],
                 *next = &rig->point[end == CPS_END_A ? 3 : 3 * (n - 1)];
    const double size = hypot(tip[0] - next[0], tip[2] - next[2]);
    for (int a = 0; a < 3; a++) out[a] = force * (tip[a] - next[a]) / size;
}

static void pull_both(Rig *rig, const Case *c, double ratio) {
    double a[3], b[3];
    pull(rig, CPS_END_A, c->force, a);
    rig_end(rig, CPS_END_A, CPS_END_KIND_FREE, a[0], a[1], a[2]);
    pull(rig, CPS_END_B, c->force, b);
    rig_end(rig, CPS_END_B, CPS_END_KIND_FREE, b[0], b[1], b[2]);
    rig_stage(rig, 1);
    pull(rig, CPS_END_B, ratio * c->force, b);
    rig_change(rig, CPS_END_B, CPS_END_KIND_FREE, b[0], b[1], b[2]);
}

/* The outcome where F_B/F_A goes from 1 to `ratio`; of a slide its proof. */
static CpsOutcome outcome(const Case *c, double ratio, double *power) {
    Rig rig;
    lay_round(&rig, c);
    pull_both(&rig, c, ratio);
    RigRun run = rig_open(&rig);
    const CpsOutcome found = rig_try(&run);
    *power = run.report.proof_force;
    if (found == CPS_OUTCOME_SLIDES) {
        double fastest = 0; /* it stays where it was, and nothing follows */
        for (int j = 0; j <= run.view.element_count; j++) {
            const double *v = &run.view.motion[3 * j];
            fastest = fmax(fastest, sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
        }
        CHECK_NEAR(fastest, 1, 1e-14);
        CHECK_INT(cps_evolution_remaining_count(run.evolution), 0);
    }
    rig_close(&run);
    return found;
}

static void beyond_the_limit(void **state) {
    (void)state;
    enum { CASES = 24 };
    double worst = 0;
    for (int i = 0; i < CASES; i++) {
        uint64_t seed = 1000 + (uint64_t)i;
        Case c = {.mu = splitmix(&seed, 0.03, 0.8)};
        c.theta = splitmix(&seed, 0.4, 1.8 * PI);
        c.nodes = 8 + (int)(40 * splitmix(&seed, 0, 1));
        c.radius = pow(10, splitmix(&seed, -2, 2));
        c.force = pow(10, splitmix(&seed, -2, 4));
        const double k = limit_of(&c), d = c.theta / c.nodes,
                     fastest = sqrt(1 + c.mu * c.mu) / (cos(d / 2) - c.mu * sin(d / 2));
        const double over = 1 + pow(10, splitmix(&seed, -2, 0));
        double power;
        printf("seed %d: mu %.3g, theta %.3g, %d nodes, limit %.4g, beyond by %.3g\n", 1000 + i,
               c.mu, c.theta, c.nodes, k, over);
        CHECK_INT(outcome(&c, over * k, &power), CPS_OUTCOME_SLIDES);
        /* elongations of 1e-6 times the ratio of forces turn the polygon by as much */
        const double expected = c.force * (over - 1) / fastest, slack = 1e-5 * over * k * c.force;
        worst = fmax(worst, fabs(power - expected) / slack);
        CHECK_INT(outcome(&c, 1 / (over * k), &power), CPS_OUTCOME_SLIDES);
        worst = fmax(worst, fabs(power - c.force * (1 / k - 1 / (over * k)) / fastest) / slack);
        CHECK_INT(outcome(&c, 0.99 * k, &power), CPS_OUTCOME_SOLVED);
        CHECK_INT(outcome(&c, 1 / (0.99 * k), &power), CPS_OUTCOME_SOLVED);
    }
    CHECK_LESS(worst, 1);
}

/* What stops it: an end that is held, and a plane that its straight way on leads to. Frozen
 * friction has no limit in the tension. */
static void what_does_not_slide(void **state) {
    (void)state;
    const Case c = {.mu = 0.3, .theta = PI, .radius = 1, .force = 1, .nodes = 20};
    for (int kind = 0; kind < 3; kind++) {
        Rig rig;
        lay_round(&rig, &c);
        if (kind == 0) {
            CpsObstacle *ceiling =
                rig_obstacle(&rig, CPS_OBSTACLE_PLANE, 0.5); /* the leads go up to 1.1 */
            ceiling->normal[0] = 0;
            ceiling->normal[1] = 0;
            ceiling->normal[2] = -1;
            ceiling->point[2] = 2.5;
        }
        pull_both(&rig, &c, 1.5 * limit_of(&c));
        if (kind == 1) rig_end(&rig, CPS_END_A, CPS_END_KIND_AT_START, 0, 0, 0);
        if (kind == 2) rig.scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
        RigRun run = rig_open(&rig);
        CpsError err; /* not rig_try: its audit is of consistent friction */
        CHECK_INT(cps_evolution_step(run.evolution, &err), CPS_OK);
        const CpsOutcome found = cps_evolution_report(run.evolution).outcome;
        printf("%s: %s\n",
               kind == 0   ? "a ceiling in its way"
               : kind == 1 ? "end A held"
                           : "frozen friction",
               cps_outcome_name(found));
        assert_true(found != CPS_OUTCOME_SLIDES);
        if (kind == 1) CHECK_INT(found, CPS_OUTCOME_SOLVED);
        rig_close(&run);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beyond_the_limit),
        cmocka_unit_test(what_does_not_slide),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
