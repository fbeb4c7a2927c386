/* SPDX-License-Identifier: BSD-3-Clause */
/* Where a line touches down, and how far what lies on the bed has been swept.
 *
 * An elastic line on a smooth level bed from an anchor to a lifted end has the tension H on the
 * bed. With c = 1/EA the part of natural length s that hangs spans
 *     X(s) = H/w asinh(w s/H) + c H s,   Z(s) = H/w (sqrt(1 + (w s/H)^2) - 1) + c w s^2/2,
 * and the rest lies straight with the stretch 1 + c H (Irvine, Cable Structures, 1981, 1.4). */
#include <stdio.h>
#include <stdlib.h>

#include "rig.h"
#include "splitmix.h"

/* The smooth bed z = at[2], anchor A at `at`; B is first on the bed and then at span and height
 * from A, in the direction of the angle. */
typedef struct Mooring {
    double length, weight, compliance, span, height, angle, at[3];
} Mooring;

static void along(const Mooring *m, double distance, double height, double out[3]) {
    out[0] = m->at[0] + cos(m->angle) * distance;
    out[1] = m->at[1] + sin(m->angle) * distance;
    out[2] = m->at[2] + height;
}

static double hanging_span(const Mooring *m, double pull, double s) {
    return pull / m->weight * asinh(m->weight * s / pull) + m->compliance * pull * s;
}

/* [m] The length that hangs up to the height of B, at the tension `pull` on the bed. */
static double hanging_length(const Mooring *m, double pull) {
    double low = 0, high = m->length;
    for (int i = 0; i < 200; i++) {
        const double s = 0.5 * (low + high), a = pull / m->weight;
        const double z =
            s * s / (a * (sqrt(1 + s * s / (a * a)) + 1)) + 0.5 * m->compliance * m->weight * s * s;
        *(z < m->height ? &low : &high) = s;
    }
    return low;
}

/* [m] How far from A the line touches down, and *length, the natural length that lies there. The
 * span that a pull reaches grows with it. */
static double touchdown(const Mooring *m, double *length) {
    double low = 1e-9 * m->weight * m->length, high = 1e9 * m->weight * m->length;
    for (int i = 0; i < 300; i++) {
        const double pull = sqrt(low * high), s = hanging_length(m, pull),
                     reach =
                         (m->length - s) * (1 + m->compliance * pull) + hanging_span(m, pull, s);
        *(reach < m->span ? &low : &high) = pull;
    }
    *length = m->length - hanging_length(m, low);
    return *length * (1 + m->compliance * low);
}

static RigRun moor(Rig *rig, const Mooring *m, int elements) {
    double b[3], flat[3];
    along(m, m->span, m->height, b);
    along(m, m->length, 0, flat);
    rig_begin(rig, elements, m->weight, 1 / m->compliance);
    rig_length(rig, m->length);
    rig_obstacle(rig, CPS_OBSTACLE_PLANE, 0)->point[2] = m->at[2];
    rig_point(rig, m->at[0], m->at[1], m->at[2]);
    rig_point(rig, flat[0], flat[1], flat[2]);
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, m->at[0], m->at[1], m->at[2]);
    rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, flat[0], flat[1], flat[2]);
    rig_stage(rig, 8);
    rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, b[0], b[1], b[2]);
    RigRun run = rig_open(rig);
    rig_next(&run);
    return run;
}

static Mooring random_mooring(uint64_t *state) {
    const double length = pow(10, splitmix(state, -1, 3)), weight = pow(10, splitmix(state, 0, 4)),
                 height = splitmix(state, 0.05, 0.25) * length;
    /* between slack on the bed and just lifted off at the anchor */
    const double least = length - height, most = sqrt(length * length - height * height);
    Mooring m = {.length = length, .weight = weight, .height = height};
    m.compliance = 1 / (weight * length * pow(10, splitmix(state, 1.5, 5)));
    m.span = least + splitmix(state, 0.1, 0.6) * (most - least);
    m.angle = splitmix(state, 0, 6.28);
    for (int a = 0; a < 2; a++) m.at[a] = splitmix(state, -1, 1) * length;
    return m;
}

/* Both the place and the length are of second order in the elements. The place lies on the chord of
 * an element whose slope is at most w h/(2 H), so it is above the bed by at most w h^2/(16 H). */
static void against_the_catenary(void **unused) {
    (void)unused;
    static Rig rig;
    uint64_t state = 21;
    double worst[4] = {0};
    for (int i = 0; i < 12; i++) {
        const Mooring m = random_mooring(&state);
        double lying;
        const double far = touchdown(&m, &lying);
        for (int k = 0; k < 4; k++) {
            const int elements = 50 << k;
            RigRun run = moor(&rig, &m, elements);
            const CpsEndReport *a = &run.report.end[CPS_END_A], *b = &run.report.end[CPS_END_B];
            double expected[3];
            along(&m, far, 0, expected);
            CHECK_INT(run.report.has_touchdown, 1);
            const double above = b->touchdown[2] - m.at[2], h = m.length / elements,
                         aside =
                             hypot(b->touchdown[0] - expected[0], b->touchdown[1] - expected[1]);
            CHECK_BETWEEN(above, -1e-9 * m.length,
                          m.weight * h * h / (16 * a->tension) + 1e-8 * m.length);
            const double error = fmax(aside, fabs(m.length - b->suspended - lying)) / m.length;
            worst[k] = fmax(worst[k], error);
            for (int c = 0; c < 3; c++) CHECK_NEAR(a->touchdown[c], a->position[c], 0);
            rig_close(&run);
        }
    }
    for (int k = 0; k < 4; k++)
        printf("%d elements: touchdown to %.3g of the length, %.3g h^2\n", 50 << k, worst[k],
               worst[k] * pow(50 << k, 2));
    /* eight times the elements: 64 of second order, 8 of first */
    CHECK_LESS(worst[3], worst[0] / 30);
}

/* [m] How far the touching nodes are from the straight line on which they were, in plan. */
static double sideways(const RigRun *run, double angle, const double at[3]) {
    double most = 0;
    for (int j = 0; j <= run->view.element_count; j++)
        if (run->view.state[j] != CPS_NODE_STATE_FREE) {
            const double *x = &run->view.position[3 * j];
            most = fmax(most, fabs(cos(angle) * (x[1] - at[1]) - sin(angle) * (x[0] - at[0])));
        }
    return most;
}

/* A line on a rough bed whose end B is lifted, pulled along and then aside and back. */
static void swept_over_the_bed(void **unused) {
    (void)unused;
    static Rig rig;
    uint64_t state = 22;
    int swept = 0;
    for (int i = 0; i < 20; i++) {
        const Mooring m = random_mooring(&state);
        const double aside = splitmix(&state, 0.1, 0.5) * m.length, high = 0.3 * m.height;
        double to[3];
        along(&m, m.length, 0, to);
        rig_begin(&rig, 40, m.weight, 1 / m.compliance);
        rig_length(&rig, m.length);
        rig_obstacle(&rig, CPS_OBSTACLE_PLANE, splitmix(&state, 0, 0.8))->point[2] = m.at[2];
        rig_point(&rig, m.at[0], m.at[1], m.at[2]);
        rig_point(&rig, to[0], to[1], to[2]);
        rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, m.at[0], m.at[1], m.at[2]);
        rig_end(&rig, CPS_END_B, CPS_END_KIND_HELD, to[0], to[1], to[2]);
        for (int k = 0; k < 3; k++) {
            along(&m, 0.8 * m.length, high, to);
            to[0] -= k == 1 ? sin(m.angle) * aside : 0;
            to[1] += k == 1 ? cos(m.angle) * aside : 0;
            rig_stage(&rig, 3);
            rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, to[0], to[1], to[2]);
        }
        RigRun run = rig_open(&rig), again = rig_open(&rig);
        char *saved = malloc(cps_evolution_state_size(run.evolution));
        for (int step = 0; step < 9; step++) {
            rig_step(&run);
            const double expected = sideways(&run, m.angle, m.at);
            /* the start is known to 1e-7 of the length; what is less than 1e-6 is none */
            CHECK_NEAR(run.report.sweep, expected,
                       (expected > 2e-6 * m.length ? 3e-7 : 2e-6) * m.length);
            if (step < 3) CHECK_LESS(run.report.sweep, 1e-6 * m.length); /* slides, but along */
            swept += expected > 0.01 * m.length;
            /* what is saved knows where the history began */
            cps_evolution_save(run.evolution, saved);
            CHECK_INT(cps_evolution_load(again.evolution, saved,
                                         cps_evolution_state_size(run.evolution), NULL),
                      CPS_OK);
            CHECK_NEAR(cps_evolution_line_report(again.evolution, 0).sweep, run.report.sweep, 0);
            if (step == 4) {
                rig_step(&run);
                CHECK_INT(cps_evolution_step(again.evolution, NULL), CPS_OK);
                CHECK_NEAR(cps_evolution_line_report(again.evolution, 0).sweep, run.report.sweep,
                           0);
                step++;
            }
        }
        free(saved);
        rig_close(&again);
        rig_close(&run);
    }
    CHECK_GREATER(swept, 40); /* of 180 steps */
}

/* Statics place the line, and the history begins there; a line that hung upright is swept as far as
 * it goes. A line off the bed has neither. */
static void where_the_history_begins(void **unused) {
    (void)unused;
    static Rig rig;
    const double far = 7e5; /* more than 512 lengths: positions are measured from a local origin */
    rig_begin(&rig, 30, 5, 1e6);
    rig_length(&rig, 12);
    rig_obstacle(&rig, CPS_OBSTACLE_PLANE, 0.4);
    rig.line.start.kind = CPS_START_STATIC;
    rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, far, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_HELD, far + 10, 0, 4);
    rig_stage(&rig, 2);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, far + 10, 2, 4);
    rig_stage(&rig, 4);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, far, 0, 30);
    RigRun run = rig_open(&rig);
    rig_step(&run);
    CHECK_NEAR(run.report.sweep, 0, 0);
    CHECK_BETWEEN(run.report.end[CPS_END_B].touchdown[0], far + 1, far + 9);
    rig_next(&run);
    const double origin[3] = {far - run.view.origin[0], 0, 0};
    CHECK_NEAR(run.report.sweep, sideways(&run, 0, origin), 3e-7 * 12);
    CHECK_GREATER(run.report.sweep, 0);
    cps_evolution_step(run.evolution, NULL);
    CHECK_INT(cps_outcome_is_certified(cps_evolution_report(run.evolution).outcome), 1);
    rig_close(&run);

    rig_begin(&rig, 10, 5, 1e6); /* upright above the bed, then lowered aside */
    rig_length(&rig, 2);
    rig_obstacle(&rig, CPS_OBSTACLE_PLANE, 0)->point[2] = -3;
    rig_point(&rig, 0, 0, 0);
    rig_point(&rig, 0, 0, -2);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
    rig_stage(&rig, 1);
    rig_stage(&rig, 3);
    rig_change(&rig, CPS_END_A, CPS_END_KIND_HELD, 3, 4, -1.5);
    run = rig_open(&rig);
    rig_step(&run);
    CHECK_INT(run.report.has_touchdown, 0);
    CHECK_NEAR(run.report.sweep, 0, 0);
    rig_next(&run);
    CHECK_INT(run.report.has_touchdown, 1);
    double most = 0;
    for (int j = 0; j <= 10; j++)
        if (run.view.state[j] != CPS_NODE_STATE_FREE)
            most = fmax(most, hypot(run.view.position[3 * j], run.view.position[3 * j + 1]));
    CHECK_GREATER(most, 1);
    CHECK_NEAR(run.report.sweep, most, 1e-6);
    rig_close(&run);
}

/* A line pulled up from the bed by a force at its end has the tension H on the bed, and touches
 * down where its weight from there on is the vertical force V, at x elements from the node where it
 * lifts off. Its elements have the vertical forces of the closed form at their middles, so its
 * height is Z(s) = int_0^s g(w t) dt,   g(v) = v/sqrt(H^2 + v^2) + c v, by the midpoint rule, begun
 * at that node: with g = (1/H + c) v + O(v^3) below and g' above it differs by (w h^2/H)(1/24 -
 * x^2/2) - c w x^2 h^2/2 - w h^2 H^2/(24 (H^2 + V^2)^(3/2)), and the next term is of fourth order.
 * No series in h has it, since x jumps as meshes do. */
static void height_by_touchdown(void **unused) {
    (void)unused;
    static Rig rig;
    double largest = 0, least = 0, worst = 0;
    for (int i = 0; i < 24; i++) {
        const int elements = 200 << (i % 2);
        const double length = 40, w = 30, h = length / elements, pull = i % 3 ? 60 : 25,
                     c = i % 4 ? 1e-7 : 2e-5, x = (i + 0.5) / 24 - 0.5, lies = 15 * 0.2 + x * h,
                     s = length - lies, v = w * s;
        rig_begin(&rig, elements, w, 1 / c);
        rig_length(&rig, length);
        rig_obstacle(&rig, CPS_OBSTACLE_PLANE, 0);
        rig_point(&rig, 0, 0, 0);
        rig_point(&rig, length, 0, 0);
        rig_end(&rig, CPS_END_B, CPS_END_KIND_HELD, length, 0, 0);
        rig_stage(&rig, 1);
        rig_change(&rig, CPS_END_B, CPS_END_KIND_FREE, pull, 0, v);
        RigRun run = rig_open(&rig);
        rig_next(&run);
        const double z = pull / w * (sqrt(1 + pow(v / pull, 2)) - 1) + c * w * s * s / 2,
                     unit = w * h * h / pull, off = run.report.end[CPS_END_B].position[2] - z;
        const double expected = unit * (1 / 24.0 - x * x / 2) - c * w * x * x * h * h / 2 -
                                w * h * h / 24 * pull * pull / pow(hypot(pull, v), 3);
        worst = fmax(worst, fabs(off - expected) / (unit * pow(w * h / pull, 2)));
        largest = fmax(largest, off / unit);
        least = fmin(least, off / unit);
        rig_close(&run);
    }
    rig_show("height", "largest and least difference [w h^2/H]", largest, least);
    rig_show("height", "left of it [w h^2/H (w h/H)^2]", 0, worst);
    CHECK_LESS(worst, 0.02);
    CHECK_GREATER(largest, 0.04); /* of 1/24, at x = 0 */
    CHECK_LESS(least, -0.07);     /* of -1/12, at x = 1/2 */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_the_catenary),
        cmocka_unit_test(height_by_touchdown),
        cmocka_unit_test(swept_over_the_bed),
        cmocka_unit_test(where_the_history_begins),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
