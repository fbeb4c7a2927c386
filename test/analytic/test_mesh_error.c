/* SPDX-License-Identifier: BSD-3-Clause */
/* The mesh estimate of the tension against what a mesh 16 times as fine finds: random hanging
 * lines, and moorings on a bed without and with friction, laid, and drawn out or paid back
 * afterwards. Within a factor of 3 it is honest. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "rig.h"

static uint64_t state = 7;
static double draw(double low, double high) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) * 0x1p-53;
}

typedef struct Mooring {
    double length, weight, stiffness, height, span, mu,
        shift;         /* shift: what the upper end is moved by after laying, or 0 */
    double grading[2]; /* ends of the line against each other, 1: even */
    bool bed;
} Mooring;

/* depth over length 0.1 to 0.6, between hardly and nearly taut; strains from 1e-5 to 1e-2 */
static Mooring make(bool bed, bool friction) {
    Mooring m = {.weight = pow(10, draw(1, 4)), .bed = bed};
    m.length = pow(10, draw(1, 3));
    m.height = m.length * draw(0.1, 0.6);
    m.stiffness = m.weight * m.length * pow(10, draw(2, 5));
    const double taut = sqrt(m.length * m.length - m.height * m.height),
                 loose = m.length - m.height;
    m.span = bed ? loose + draw(0.3, 0.9) * (taut - loose) : taut * draw(0.5, 0.98);
    m.mu = friction ? draw(0.2, 1) : 0;
    m.shift = friction ? draw(-0.005, 0.005) * m.length : 0;
    m.grading[0] = m.grading[1] = 1;
    if (draw(0, 1) < 0.5) {
        const bool end = draw(0, 1) < 0.5;
        m.grading[end] = draw(1, 3);
    }
    return m;
}

/* Tensions at both ends, and the estimate. */
static double solve(const Mooring *m, int elements, double tension[2]) {
    static Rig rig;
    rig_begin(&rig, elements, m->weight, m->stiffness);
    double sum = 0;
    for (int e = 0; e < elements; e++) {
        const double at = (e + 0.5) / elements;
        sum += rig.element_length[e] = m->grading[0] + at * (m->grading[1] - m->grading[0]);
    }
    for (int e = 0; e < elements; e++) rig.element_length[e] *= m->length / sum;
    rig_graded(&rig);
    if (m->bed) rig_obstacle(&rig, CPS_OBSTACLE_PLANE, m->mu);
    rig.line.start.kind = CPS_START_STATIC;
    rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_HELD, m->span, 0, m->height);
    if (m->shift != 0) {
        rig_stage(&rig, 10);
        rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, m->span + m->shift, 0, m->height);
    }
    RigRun run = rig_open(&rig);
    rig_step(&run);
    if (m->shift != 0) rig_next(&run);
    for (int e = 0; e < 2; e++) tension[e] = run.report.end[e].tension;
    const double estimate = run.report.has_tension_mesh ? run.report.tension_mesh : NAN;
    rig_close(&run);
    return estimate;
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Ratios of error to estimate; at most `allowed` of the cases are off by more than a factor of
 * 3. */
static void compare(const char *name, bool bed, bool friction, int allowed) {
    enum { CASES = 40 };
    double ratio[CASES];
    int beyond = 0;
    for (int i = 0; i < CASES; i++) {
        const Mooring m = make(bed, friction);
        const int n = (int)draw(15, 90);
        double coarse[2], fine[2], error = 0;
        const double estimate = solve(&m, n, coarse);
        solve(&m, 16 * n, fine);
        for (int e = 0; e < 2; e++) error = fmax(error, fabs(coarse[e] - fine[e]));
        const double step = m.weight * m.length / n / fmin(fine[0], fine[1]);
        CHECK_INT(isfinite(estimate) || step > 0.5,
                  1); /* no estimate only where elements weigh about as much as they are tight */
        ratio[i] = isfinite(estimate) ? error / estimate : 1;
        beyond += ratio[i] > 3 || ratio[i] < 1 / 3.0;
    }
    qsort(ratio, CASES, sizeof *ratio, by_size);
    printf(
        "%-24s error over estimate: least %.2f, 5 %% %.2f, median %.2f, 95 %% %.2f, largest %.2f; "
        "%d of %d within a factor of 3\n",
        name, ratio[0], ratio[2], ratio[CASES / 2], ratio[CASES - 3], ratio[CASES - 1],
        CASES - beyond, CASES);
    CHECK_BETWEEN(beyond, 0, allowed);
}

static void hanging(void **unused) {
    (void)unused;
    compare("hanging", false, false, 0);
}

static void laid(void **unused) {
    (void)unused;
    compare("laid on a bed", true, false, 0);
}

static void with_friction(void **unused) {
    (void)unused;
    /* it is of the step: what earlier steps have left in the friction of another mesh is not in
     * it */
    compare("moved with friction", true, true, 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hanging),
        cmocka_unit_test(laid),
        cmocka_unit_test(with_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
