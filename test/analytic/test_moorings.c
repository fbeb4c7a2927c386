/* SPDX-License-Identifier: BSD-3-Clause */
/* The OC3-Hywind line (902.2 m, 698.094 N/m, EA 384.243 MN, fairlead 250 m above the anchor) on a
 * bed with consistent friction.
 *
 * The elastic catenary with bed friction (Jonkman 2007) takes the line on the bed, L_B = L - V/w,
 * to slide all over towards the fairlead: the tension falls by mu w per length towards the anchor.
 * With mu < 0 it slides towards the anchor. A line laid nearer and pulled out slides like that if
 * its anchor's tension ends above the one it was laid with; paid back from a place where all of it
 * hung, it slides the other way. Else the anchor keeps what it was laid with. */
#include <stdio.h>

#include "rig.h"

static const double LENGTH = 902.2, WEIGHT = 698.094, STIFFNESS = 384.243e6, HEIGHT = 250,
                    MIDDLE = 848.67;

/* the closed form ------------------------------------------------------------------------------ */

/* x and z of the fairlead for its force (h, v), v < w L:
 *   x = L_B + (h/w) asinh(v/h) + h L/EA - mu w/(2 EA) [L_B^2 - max(L_B - h/(mu w), 0)^2],
 *       the bracket L_B^2 for mu <
 * 0 z = (h/w) (sqrt(1 + (v/h)^2) - 1) + v^2/(2 EA w) */
static void place(double mu, double h, double v, double *x, double *z) {
    const double on_bed = LENGTH - v / WEIGHT,
                 slack = mu > 0 ? fmax(on_bed - h / (mu * WEIGHT), 0) : 0;
    *x = on_bed + h / WEIGHT * asinh(v / h) + h * LENGTH / STIFFNESS -
         mu * WEIGHT / (2 * STIFFNESS) * (on_bed * on_bed - slack * slack);
    *z = h / WEIGHT * (sqrt(1 + v / h * (v / h)) - 1) + v * v / (2 * STIFFNESS * WEIGHT);
}

typedef struct Catenary {
    double h, v, anchor; /* [N] */
} Catenary;

/* Newton's method, slopes by differences. */
static Catenary solve(double mu, double x) {
    double h = 7e5, v = 5e5;
    for (int i = 0; i < 50; i++) {
        double at[2], by_h[2], by_v[2];
        const double step = 1;
        place(mu, h, v, &at[0], &at[1]);
        place(mu, h + step, v, &by_h[0], &by_h[1]);
        place(mu, h, v + step, &by_v[0], &by_v[1]);
        const double a = by_h[0] - at[0], b = by_v[0] - at[0], c = by_h[1] - at[1],
                     d = by_v[1] - at[1];
        const double rx = x - at[0], rz = HEIGHT - at[1], det = a * d - b * c;
        h += (d * rx - b * rz) / det;
        v += (a * rz - c * rx) / det;
    }
    return (Catenary){h, v, fmax(h - mu * WEIGHT * (LENGTH - v / WEIGHT), 0)};
}

/* the line ------------------------------------------------------------------------------------- */

static void mooring(Rig *rig, int elements, double mu, double laid) {
    rig_begin(rig, elements, WEIGHT, STIFFNESS);
    rig_obstacle(rig, CPS_OBSTACLE_PLANE, mu);
    rig->line.start.kind = CPS_START_STATIC;
    rig_length(rig, LENGTH);
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
    rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, laid, 0, HEIGHT);
}

static void move(Rig *rig, int steps, double x, double y) {
    rig_stage(rig, steps);
    rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, x, y, HEIGHT);
}

/* Lay at `from`, go over `by` to `to`; horizontal force and anchor tension against the closed form.
 * Touchdown falls between nodes: errors under C h^2, C = 1 for h = 1/N in units of H as for the
 * line without friction; 4 times that at the anchor, which is pulled over a part of the bed that is
 * longer or shorter by up to h/2 of friction near touchdown.
 */
static void against(const char *name, double mu, double sign, double from, double by, double to) {
    const Catenary exact = solve(sign * mu, to);
    for (int n = 100; n <= 400; n *= 2) {
        Rig rig;
        mooring(&rig, n, mu, from);
        move(&rig, 10, by, 0);
        if (by != to) move(&rig, 10, to, 0);
        RigRun run = rig_open(&rig);
        rig_step(&run);
        while (cps_evolution_remaining_count(run.evolution) > 0) rig_step(&run);
        char figure[48];
        snprintf(figure, sizeof figure, "horizontal force, N = %d [N]", n);
        const double h =
            rig_show(name, figure, exact.h, run.report.end[CPS_END_B].force[0]) / exact.h;
        snprintf(figure, sizeof figure, "anchor tension, N = %d [N]", n);
        const double a =
            rig_show(name, figure, exact.anchor, run.report.end[CPS_END_A].tension) / exact.h;
        snprintf(figure, sizeof figure, "grounded, N = %d [m]", n);
        const double on_bed = LENGTH - exact.v / WEIGHT,
                     ground = rig_show(name, figure, on_bed, run.report.grounded);
        /* as the vertical force is off, which is w times it, and no more than the last node's share
         * in any case */
        CHECK_LESS(fabs(ground) * WEIGHT / exact.v, 8.0 / n / n);
        CHECK_LESS(fabs(h), 1.0 / n / n);
        CHECK_LESS(fabs(a), 4.0 / n / n);
        rig_close(&run);
    }
}

/* own Newton against the published table, to its digits */
static void table(void **state) {
    (void)state;
    static const double ROW[][6] = {/* x, mu, H, V, H_A, L_B */
                                    {848.67, 0.5, 737157.41, 535798.50, 690146.45, 134.684},
                                    {848.67, 1.0, 737375.92, 535869.35, 643424.86, 134.582},
                                    {838.67, 1.0, 524541.67, 461692.99, 356414.25, 240.838}};
    for (int i = 0; i < 3; i++) {
        const Catenary c = solve(ROW[i][1], ROW[i][0]);
        CHECK_NEAR(c.h, ROW[i][2], 0.01);
        CHECK_NEAR(c.v, ROW[i][3], 0.01);
        CHECK_NEAR(c.anchor, ROW[i][4], 0.01);
        CHECK_NEAR(LENGTH - c.v / WEIGHT, ROW[i][5], 0.0005);
    }
}

static void pulled_out(void **state) {
    (void)state;
    against("OC3, pulled out, mu 0.5", 0.5, 1, 838.67, MIDDLE, MIDDLE);
    against("OC3, pulled out, mu 1", 1, 1, 838.67, MIDDLE, MIDDLE);
    against("OC3, pulled out, mu 1", 1, 1, 818.67, 838.67, 838.67);
}

static void paid_back(void **state) {
    (void)state;
    against("OC3, paid back, mu 1", 1, -1, 848.67, 858.67, MIDDLE);
    against("OC3, paid back, mu 0.5", 0.5, -1, 848.67, 858.67, MIDDLE);
}

/* Where the closed form does not hold. Laid 1 m nearer and pulled out, friction spends itself
 * before it reaches the anchor, which keeps what it was laid with; laid where it is, nothing slides
 * at all. */
static void not_all_sliding(void **state) {
    (void)state;
    static const double LAID[] = {847.67, 848.67};
    for (int i = 0; i < 2; i++) {
        Rig rig;
        mooring(&rig, 400, 1, LAID[i]);
        move(&rig, 10, MIDDLE, 0);
        RigRun run = rig_open(&rig);
        const CpsLineView laid = rig_step(&run);
        const double before = rig_tension(&laid, 0);
        rig_next(&run);
        char name[48];
        snprintf(name, sizeof name, "OC3, laid at %g m, mu 1", LAID[i]);
        const double after = rig_tension(&run.view, 0);
        rig_show(name, "anchor; all sliding: 643 425 [N]", before, after);
        CHECK_RELATIVE(after, before, 1e-8); /* the step's own tolerance */
        CHECK_RELATIVE(run.report.end[CPS_END_B].force[0], solve(0, MIDDLE).h, 1e-3);
        rig_close(&run);
    }
}

/* Held sway, 20 m, mu = 1: the lateral force of a line that keeps what friction gives, and goes on
 * keeping it. */
static void held_sway(void **state) {
    (void)state;
    for (int n = 50; n <= 200; n *= 2) {
        Rig rig;
        mooring(&rig, n, 1, MIDDLE);
        move(&rig, 10, MIDDLE, 20);
        move(&rig, 10, MIDDLE, 20);
        RigRun run = rig_open(&rig);
        rig_step(&run);
        rig_next(&run);
        const double force = run.report.end[CPS_END_B].force[1];
        char figure[48];
        snprintf(figure, sizeof figure, "lateral force, N = %d [N]", n);
        CHECK_BETWEEN(rig_show("OC3, held sway of 20 m", figure, 20250, force) + 20250, 20100,
                      20400);
        run.dissipated = 0;
        for (int k = 0; k < 10; k++) {
            rig_step(&run);
            /* nodes at their limit creep by the root of the sharpened products: 1e-8 of the
             * tension, 7 mN, in a step */
            CHECK_NEAR(run.report.end[CPS_END_B].force[1], force, 0.007);
            CHECK_INT(run.report.slipping > 0, 0);
        }
        rig_show("OC3, held sway of 20 m", "the same after 10 steps more [N]", force,
                 run.report.end[CPS_END_B].force[1]);
        rig_close(&run);
    }
}

/* loops ---------------------------------------------------------------------------------------- */

/* A closed cycle of the fairlead after a first one: force at the middle going out and coming back,
 * area, dissipated. */
typedef struct Loop {
    double out, back, area, lost;
} Loop;

/* Over x or y, by `swing` to both sides, in 4 times `steps` load steps; the force is that at the
 * fairlead, or the tension at the anchor for the two in the middle of a surge cycle. */
static Loop cycle(int elements, int steps, double swing, bool sway) {
    Rig rig;
    mooring(&rig, elements, 1, MIDDLE);
    const double at[] = {1, 0, -1, 0};
    for (int k = 0; k < 8; k++) {
        const double here = swing * at[k % 4];
        move(&rig, steps, sway ? MIDDLE : MIDDLE + here, sway ? here : 0);
    }
    RigRun run = rig_open(&rig);
    rig_step(&run);
    Loop loop = {0};
    const int axis = sway ? 1 : 0;
    for (int k = 0; k < 8; k++) {
        if (k == 4) run.dissipated = loop.area = 0;
        for (int i = 0; i < steps; i++) {
            const CpsEndReport before = run.report.end[CPS_END_B];
            rig_step(&run);
            const CpsEndReport *now = &run.report.end[CPS_END_B];
            loop.area += 0.5 * (before.force[axis] + now->force[axis]) *
                         (now->position[axis] - before.position[axis]);
        }
        const double found =
            sway ? run.report.end[CPS_END_B].force[1] : run.report.end[CPS_END_A].tension;
        if (k == 5) loop.back = found;
        if (k == 7) loop.out = found;
    }
    loop.lost = run.dissipated;
    rig_close(&run);
    return loop;
}

/* Surge of 10 m to both sides lifts all of the line once per cycle. On the way back all of it
 * slides to the anchor, as far as the inner end; on the way out friction is spent before it reaches
 * the anchor, which keeps the tension of the inner end. So the anchor's tension at the middle
 * differs by less than the full-slip estimate, which lets all slide both ways. */
static void surge_loop(void **state) {
    (void)state;
    const double estimate = solve(1, MIDDLE).anchor - solve(-1, MIDDLE).anchor;
    const double closed = solve(-1, MIDDLE - 10).anchor - solve(-1, MIDDLE).anchor;
    double coarse = 0;
    for (int steps = 10; steps <= 40; steps *= 2) {
        const Loop loop = cycle(200, steps, 10, false);
        char name[48];
        snprintf(name, sizeof name, "OC3, surge +-10 m, %d steps", 4 * steps);
        const double error =
            rig_show(name, "anchor, out less back [N]", closed, loop.out - loop.back);
        CHECK_LESS(fabs(error), 8 * 737375.0 / 200 / 200); /* C h^2 as above, of each */
        /* more steps creep no more: 1e-6 of the tension in all */
        if (steps == 10) coarse = loop.out - loop.back;
        CHECK_NEAR(loop.out - loop.back, coarse, 1.0);
        rig_show(name, "the same, all sliding both ways [N]", estimate, loop.out - loop.back);
        rig_show(name, "dissipated, of area [J]", loop.area, loop.lost);
    }
}

/* Sway of 20 m to both sides: what is dissipated is the area, to first order in the steps; out and
 * back are mirror images. */
static void sway_loop(void **state) {
    (void)state;
    double off[3], area[3];
    for (int k = 0; k < 3; k++) {
        const Loop loop = cycle(100, 10 << k, 20, true);
        char name[48];
        snprintf(name, sizeof name, "OC3, sway +-20 m, %d steps", 40 << k);
        rig_show(name, "force at the middle, out [N]", -loop.back, loop.out);
        off[k] = rig_show(name, "dissipated, of area [J]", loop.area, loop.lost);
        area[k] = loop.area;
        CHECK_NEAR(loop.out, -loop.back, 0.1); /* 1e-7 of the tension, as above */
    }
    for (int k = 0; k < 2; k++) CHECK_BETWEEN(off[k] / off[k + 1], 1.5, 2.5);
    /* the loop itself settles as well: its changes get smaller */
    CHECK_LESS(fabs(area[2] - area[1]), 0.75 * fabs(area[1] - area[0]));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table),     cmocka_unit_test(pulled_out),
        cmocka_unit_test(paid_back), cmocka_unit_test(not_all_sliding),
        cmocka_unit_test(held_sway), cmocka_unit_test(surge_loop),
        cmocka_unit_test(sway_loop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
