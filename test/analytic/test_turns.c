/* SPDX-License-Identifier: BSD-3-Clause */
/* Drums and balls that turn by large angles in one load step.
 *
 * A weightless line that slides everywhere along a circle, n nodes at equal angles d, keeps T'/T =
 * k = (1 + mu tan(d/2))/(1 - mu tan(d/2)) at each node however far the circle turns under it, so
 * k^n between its ends, whatever the angle, its sign and the number of load steps. A step in which
 * an obstacle turns by more than a quarter turn is divided into equal substeps of at most a quarter
 * turn. It must be equal, to the last bit, to those substeps given as load steps. */
#include <stdio.h>
#include <stdlib.h>

#include "rig.h"
#include "splitmix.h"

static const double PI = 3.14159265358979323846;

/* random numbers */
static uint64_t seed = 20;

static double uniform(double low, double high) { return splitmix(&seed, low, high); }

static double per_node(double mu, double d) {
    return (1 + mu * tan(d / 2)) / (1 - mu * tan(d / 2));
}

/* A line round a cylinder or ball: n nodes at equal angles over theta, a straight lead of `lead` at
 * each end. */
typedef struct Wrap {
    CpsObstacleKind kind;
    double mu, theta, radius, stiffness, pull; /* pull: force on end A */
    int n;
    double centre[3], frame[3][3]; /* of the scene's x, y, z; the circle lies across y */
} Wrap;

static Wrap plain(CpsObstacleKind kind, double mu, double theta, int n) {
    return (Wrap){kind, mu, theta, 1, INFINITY, 1, n, {0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

static void place(const Wrap *wrap, double x, double z, double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = wrap->centre[k] + wrap->radius * (x * wrap->frame[0][k] + z * wrap->frame[2][k]);
}

static void build(Rig *rig, const Wrap *wrap) {
    const int n = wrap->n;
    const double d = wrap->theta / n, chord = 2 * sin(d / 2), lead = 1, size = wrap->radius;
    rig_begin(rig, n + 1, 0, wrap->stiffness);
    CpsObstacle *drum = rig_obstacle(rig, wrap->kind, wrap->mu);
    drum->radius = size;
    for (int k = 0; k < 3; k++) {
        drum->point[k] = wrap->centre[k];
        drum->axis[k] = 2 * wrap->frame[1][k];
    }
    for (int k = -1; k <= n; k++) {
        const int on = k < 0 ? 0 : k >= n ? n - 1 : k, next = k < 0 ? -1 : n;
        const double by = k == on ? 0 : lead / chord, x = cos(on * d), z = -sin(on * d);
        double at[3];
        place(wrap, x + by * (cos(next * d) - x), z + by * (-sin(next * d) - z), at);
        rig_point(rig, at[0], at[1], at[2]);
    }
    for (int e = 0; e <= n; e++) rig->element_length[e] = size * (e == 0 || e == n ? lead : chord);
    rig_graded(rig);
    const double *a = rig->point, *b = &rig->point[3], by = wrap->pull / (size * lead);
    rig_end(rig, CPS_END_A, CPS_END_KIND_FREE, by * (a[0] - b[0]), by * (a[1] - b[1]),
            by * (a[2] - b[2]));
    rig_end(rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
}

/* The ratio of the tensions at the ends after the turn, over k^n or k^-n; the parts of the last
 * step. */
static double off(const Wrap *wrap, double angle, int steps, int *parts) {
    Rig rig;
    build(&rig, wrap);
    rig_stage(&rig, steps);
    rig_turn(&rig, 0, angle);
    RigRun run = rig_open(&rig);
    const CpsLineView view = rig_next(&run);
    const double ratio = rig_tension(&view, wrap->n) / rig_tension(&view, 0);
    const double exact =
        pow(per_node(wrap->mu, wrap->theta / wrap->n), angle < 0 ? wrap->n : -wrap->n);
    *parts = run.report.substep_count;
    rig_close(&run);
    return ratio / exact - 1;
}

/* Quarters in an angle, rounded up. */
static int quarters(double degrees) {
    int count = 1;
    while (count * 90.0 < degrees) count++;
    return count;
}

/* The law holds to rounding of the forces; 1e-8 is what is asked for. */
static const double EXACT = 1e-8;

/* Half a drum, mu 0.3, in 1 step and in 19: the tension at the held end over 10 N. */
static void whatever_the_angle(void **state) {
    (void)state;
    static const double DEGREES[] = {89,  90,  91,  179, 180, 181, 190,
                                     270, 359, 360, 361, 540, 720, 3600};
    double worst = 0;
    for (int i = 0; i < (int)(sizeof DEGREES / sizeof *DEGREES); i++) {
        for (int variant = 0; variant < 8; variant++) {
            const CpsObstacleKind kind = variant & 1 ? CPS_OBSTACLE_SPHERE : CPS_OBSTACLE_CYLINDER;
            const double angle = (variant & 2 ? PI : -PI) * DEGREES[i] / 180;
            const int steps = variant & 4 ? 19 : 1;
            Wrap wrap = plain(kind, 0.3, PI, 40);
            wrap.pull = 10;
            int parts;
            worst = fmax(worst, fabs(off(&wrap, angle, steps, &parts)));
            CHECK_INT(parts, quarters(DEGREES[i] / steps));
        }
    }
    CHECK_LESS(rig_show("half a drum, any angle", "worst difference of the ratio", 0, worst),
               EXACT);
}

/* Anywhere, of any size, about any axis, over any angle. */
static void at_random(void **state) {
    (void)state;
    double worst = 0;
    for (int i = 0; i < 150; i++) {
        const int n = (int)uniform(10, 50);
        const double theta = uniform(0.4, 1.8) * PI, mu = uniform(0.05, 0.6);
        Wrap wrap = plain(i % 2 ? CPS_OBSTACLE_SPHERE : CPS_OBSTACLE_CYLINDER, mu, theta, n);
        wrap.radius = pow(10, uniform(-2, 2));
        wrap.pull = pow(10, uniform(-2, 4));
        double *x = wrap.frame[0], *y = wrap.frame[1], *z = wrap.frame[2], size = 0, along = 0;
        for (int k = 0; k < 3; k++) {
            wrap.centre[k] = wrap.radius * uniform(-3, 3);
            y[k] = uniform(-1, 1);
            size += y[k] * y[k];
        }
        for (int k = 0; k < 3; k++) {
            y[k] /= sqrt(size);
            x[k] = uniform(-1, 1);
            along += x[k] * y[k];
        }
        size = 0;
        for (int k = 0; k < 3; k++) {
            x[k] -= along * y[k];
            size += x[k] * x[k];
        }
        for (int k = 0; k < 3; k++) x[k] /= sqrt(size);
        for (int k = 0; k < 3; k++)
            z[k] = x[(k + 1) % 3] * y[(k + 2) % 3] - x[(k + 2) % 3] * y[(k + 1) % 3];
        int parts;
        const double angle = (i % 4 < 2 ? 1 : -1) * PI * pow(10, uniform(-0.7, 1.2));
        const double found = fabs(off(&wrap, angle, 1 + i % 3, &parts));
        if (!(found < EXACT)) printf("case %d: angle %.3f, off by %.2e\n", i, angle, found);
        worst = fmax(worst, found);
    }
    CHECK_LESS(rig_show("150 turns at random", "worst difference of the ratio", 0, worst), EXACT);
}

/* A stage in one step against the same in `steps`, each a quarter of a turn: the same bits. */
static void parts_are_steps(void **state) {
    (void)state;
    for (int variant = 0; variant < 4; variant++) {
        const int steps = 4;
        double end[2][3], tension[2];
        for (int whole = 0; whole < 2; whole++) {
            Rig rig;
            Wrap wrap =
                plain(variant & 1 ? CPS_OBSTACLE_SPHERE : CPS_OBSTACLE_CYLINDER, 0.4, 0.7 * PI, 20);
            wrap.stiffness = 1e3;
            build(&rig, &wrap);
            rig.scene.friction_policy =
                variant & 2 ? CPS_FRICTION_POLICY_FROZEN : CPS_FRICTION_POLICY_CONSISTENT;
            rig_stage(&rig, whole ? 1 : steps);
            rig_turn(&rig, 0, -2 * PI);
            CpsError err;
            CpsEvolution *evolution = NULL;
            CHECK_INT(cps_evolution_create(&rig.scene, &evolution, &err), CPS_OK);
            for (int k = 0; k < (whole ? 1 : steps); k++) {
                CHECK_INT(cps_evolution_step(evolution, &err), CPS_OK);
                CHECK_INT(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
                CHECK_INT(cps_evolution_report(evolution).substep_count, whole ? steps : 1);
            }
            const CpsLineReport report = cps_evolution_line_report(evolution, 0);
            for (int k = 0; k < 3; k++) end[whole][k] = report.end[CPS_END_A].position[k];
            tension[whole] = report.end[CPS_END_B].tension;
            cps_evolution_destroy(evolution);
        }
        for (int k = 0; k < 3; k++) CHECK_NEAR(end[1][k], end[0][k], 0);
        CHECK_NEAR(tension[1], tension[0], 0);
    }
}

/* A hoist as in test_capstan, but the drum turns by more than half a turn in one step: what sticks
 * to it goes round by that, which no part of a step does by more than a quarter. */
static void carried(void **state) {
    (void)state;
    enum { N = 40, LEAD = 70 };
    const double d = PI / N, chord = 2 * sin(d / 2), load = 2, angle = 4;
    for (int sign = -1; sign <= 1; sign += 2) {
        Rig rig;
        rig_begin(&rig, N + 2 * LEAD, 0, 1e5);
        rig_obstacle(&rig, CPS_OBSTACLE_CYLINDER, 0.3);
        for (int k = -LEAD; k <= N + LEAD; k++) {
            const int on = k < 0 ? 0 : k > N ? N : k;
            rig_point(&rig, -cos(on * d), 0, sin(on * d) - chord * abs(k - on));
        }
        rig_length(&rig, chord * (N + 2 * LEAD));
        rig_end(&rig, CPS_END_A, CPS_END_KIND_FREE, 0, 0, sign > 0 ? -load : -1);
        rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 0, 0, sign > 0 ? -1 : -load);
        rig_stage(&rig, 1);
        rig_stage(&rig, 1);
        rig_turn(&rig, 0, sign * angle);
        RigRun run = rig_open(&rig);
        const int up = sign > 0 ? 0 : N + 2 * LEAD;
        const double before = rig_next(&run).position[3 * up + 2],
                     after = rig_next(&run).position[3 * up + 2];
        CHECK_LESS(fabs(rig_show("hoist, 4 rad in one step", "rise of the load [m]", angle,
                                 after - before)),
                   angle * d * d);
        CHECK_GREATER(run.report.substep_count, 2);
        CHECK_LESS(fabs(rig_show("hoist, 4 rad in one step", "work of the drum [J]", angle,
                                 run.report.ledger.obstacles)),
                   2 * angle * d * d);
        rig_close(&run);
    }
}

/* A line drawn over half a drum at rest by its held end, 2.5 m in one step where a quarter of a
 * turn is 1.57 m: no part may be longer. Where none may be cut the answer is not certified. */
static void drawn(void **state) {
    (void)state;
    enum { N = 40, LEAD = 70 };
    const double d = PI / N, chord = 2 * sin(d / 2), displacement = 2.5, mu = 0.3;
    for (int halvings = 0; halvings <= 10; halvings += 10) {
        Rig rig;
        rig_begin(&rig, N + 2 * LEAD, 0, INFINITY);
        rig_obstacle(&rig, CPS_OBSTACLE_CYLINDER, mu);
        for (int k = -LEAD; k <= N + LEAD; k++) {
            const int on = k < 0 ? 0 : k > N ? N : k;
            rig_point(&rig, -cos(on * d), 0, sin(on * d) - chord * abs(k - on));
        }
        rig_length(&rig, chord * (N + 2 * LEAD));
        rig_end(&rig, CPS_END_A, CPS_END_KIND_FREE, 0, 0, -1);
        rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
        rig_stage(&rig, 1);
        rig_stage(&rig, 1);
        rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, 1, 0, -chord * LEAD - displacement);
        rig.scene.solver.max_halvings = halvings;
        RigRun run = rig_open(&rig);
        rig_next(&run);
        const CpsOutcome outcome = rig_try(&run);
        if (halvings == 0) {
            CHECK_INT(outcome, CPS_OUTCOME_STALLED);
        } else {
            CHECK_INT(outcome, CPS_OUTCOME_SOLVED);
            CHECK_GREATER(run.report.substep_count, 1);
            /* N - 1 to N + 1 nodes turn it, by angles of order d: the law's error is of order
             * d^2 */
            const double ratio =
                rig_tension(&run.view, N + 2 * LEAD - 1) / rig_tension(&run.view, 0);
            CHECK_LESS(fabs(rig_show("drawn over half a drum", "ratio, exp(0.3 pi)", exp(mu * PI),
                                     ratio)),
                       2 * d * d);
        }
        rig_close(&run);
    }
}

/* Two lines on one drum that turns, one of them pulled over it by a held end at the same time: a
 * stage in one step, or in so many. The tension of either line at its held end. */
static void two_lines(int steps, double tension[2], int *parts) {
    static Rig first, second;
    const Wrap one = plain(CPS_OBSTACLE_CYLINDER, 0.3, PI, 30),
               other = plain(CPS_OBSTACLE_CYLINDER, 0.3, 0.6 * PI, 24);
    build(&first, &one);
    build(&second, &other);
    CpsLine lines[2] = {first.line, second.line};
    lines[1].name = "other";
    first.scene.line = lines;
    first.scene.line_count = 2;
    rig_stage(&first, steps);
    rig_turn(&first, 0, -7);
    /* end B of the other goes out along its lead by 0.3 */
    const double *tip = &second.point[3 * (other.n + 1)], *foot = tip - 3;
    rig_change(&first, CPS_END_B, CPS_END_KIND_HELD, tip[0] + 0.3 * (tip[0] - foot[0]), 0,
               tip[2] + 0.3 * (tip[2] - foot[2]));
    first.change[0][0].line = 1;
    CpsError err;
    CpsEvolution *evolution = NULL;
    CHECK_INT(cps_evolution_create(&first.scene, &evolution, &err), CPS_OK);
    for (int k = 0; k < steps; k++) {
        CHECK_INT(cps_evolution_step(evolution, &err), CPS_OK);
        CHECK_INT(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
        *parts = cps_evolution_report(evolution).substep_count;
    }
    for (int i = 0; i < 2; i++)
        tension[i] = cps_evolution_line_report(evolution, i).end[CPS_END_B].tension;
    cps_evolution_destroy(evolution);
}

static void several_lines(void **state) {
    (void)state;
    double whole[2], cut[2];
    int parts;
    two_lines(5, cut, &parts);
    CHECK_INT(parts, 1);
    two_lines(1, whole, &parts);
    CHECK_INT(parts, 5);
    CHECK_LESS(fabs(whole[0] / pow(per_node(0.3, PI / 30), 30) - 1), EXACT);
    /* shares of the angle differ by rounding */
    for (int i = 0; i < 2; i++) CHECK_RELATIVE(whole[i], cut[i], 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whatever_the_angle),
        cmocka_unit_test(at_random),
        cmocka_unit_test(parts_are_steps),
        cmocka_unit_test(carried),
        cmocka_unit_test(drawn),
        cmocka_unit_test(several_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
