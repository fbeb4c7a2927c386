/* SPDX-License-Identifier: BSD-3-Clause */
/* Microslip with consistent friction: a straight elastic line on a rough bed whose end is pulled to
 * and fro.
 *
 * With A = mu w the friction per length, a change D of the end force slides the line over D/(2 A)
 * once it has slid the other way (Masing: the first pull D slides D/A), and moves the end by D^2/(4
 * A EA). A closed loop of +-F about a pretension T0 >= F loses 2 F^3/(3 EA A), a slack rope taken
 * between 0 and F loses F^3/(12 EA A). Only the element where sliding ends differs between a lumped
 * line and these: order 2 in h, whatever the number of load steps. There is no time in it: a
 * history told in other words gives the same numbers. The same on an isotropic bed, on one with two
 * coefficients, and along the crest of a cylinder. */
#include <stdio.h>

#include "rig.h"

static const double LENGTH = 128, WEIGHT = 10, FRICTION = 0.5, STIFFNESS = 2048;

typedef enum Bed { BED_PLAIN, BED_TWO, BED_CREST } Bed;
static const char *const BED[] = {"plain bed", "bed with two coefficients", "crest of a cylinder"};

/* The line under a pretension, its end B free; stages are added by the caller. */
static void lay(Rig *rig, Bed bed, int elements, double pretension) {
    rig_begin(rig, elements, WEIGHT, STIFFNESS);
    CpsObstacle *o =
        rig_obstacle(rig, bed == BED_CREST ? CPS_OBSTACLE_CYLINDER : CPS_OBSTACLE_PLANE, FRICTION);
    if (bed == BED_TWO) rig_lateral(o, 0.8);
    if (bed == BED_CREST) {
        o->axis[0] = 1;
        o->axis[1] = 0;
        o->radius = 5;
        o->point[2] = -5;
    }
    rig_point(rig, 0, 0, 0);
    rig_point(rig, LENGTH * (1 + pretension / STIFFNESS), 0, 0);
    rig_length(rig, LENGTH);
    rig_end(rig, CPS_END_A, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_end(rig, CPS_END_B, CPS_END_KIND_FREE, pretension, 0, 0);
}

static void pull(Rig *rig, int steps, double force) {
    rig_stage(rig, steps);
    rig_change(rig, CPS_END_B, CPS_END_KIND_FREE, force, 0, 0);
}

static double tip(const CpsLineView *view) { return view->position[3 * view->element_count]; }

/* A closed loop from high to low and back, after a first pull to high: its loss and the swing of
 * the end. */
static double loop(Bed bed, int elements, int steps, double pretension, double high, double low,
                   double *swing, double *motion) {
    Rig rig;
    lay(&rig, bed, elements, pretension);
    pull(&rig, 1, pretension);
    pull(&rig, steps, high);
    pull(&rig, steps, low);
    pull(&rig, steps, high);
    RigRun run = rig_open(&rig);
    rig_next(&run);
    CpsLineView view = rig_next(&run);
    const double upper = tip(&view);
    run.dissipated = run.motion = 0;
    view = rig_next(&run);
    *swing = upper - tip(&view);
    view = rig_next(&run);
    *motion = run.motion;
    CHECK_NEAR(tip(&view), upper, run.motion); /* the loop closes */
    const double loss = run.dissipated;
    rig_close(&run);
    return loss;
}

/* h/s of the sliding length s = D/(2 A): the element where sliding ends is exact only to (h/s)^2/4
 * of the whole, on the way there and on the way back: under C h^2, though not smoothly, and with
 * the same C for any number of steps. */
static void loops(const char *name, double pretension, double high, double low, double loss) {
    const double change = high - low, friction = FRICTION * WEIGHT,
                 exact = change * change / (4 * friction * STIFFNESS);
    for (Bed bed = BED_PLAIN; bed <= BED_CREST; bed++) {
        for (int steps = 1; steps <= 25; steps *= 5) {
            double swing, motion;
            for (int k = 0; k < 3; k++) {
                const int n = 80 << k;
                char figure[64];
                const double found = loop(bed, n, steps, pretension, high, low, &swing, &motion);
                snprintf(figure, sizeof figure, "loss, N = %d, %d steps [J]", n, steps);
                if (bed == BED_PLAIN) rig_show(name, figure, loss, found);
                const double part = LENGTH / n * 2 * friction / change;
                /* besides, the motion that the certificates leave possible, and its friction out
                 * and back */
                CHECK_LESS(fabs(found - loss),
                           part * part / 2 * loss + 2 * friction * LENGTH * motion);
                CHECK_LESS(fabs(swing - exact), part * part / 2 * exact + motion);
            }
        }
    }
}

static void pretensioned(void **state) {
    (void)state;
    const double force = 213;
    loops("loop, pretension", 300, 300 + force, 300 - force,
          2 * pow(force, 3) / (3 * STIFFNESS * FRICTION * WEIGHT));
}

static void slack(void **state) {
    (void)state;
    const double force = 213;
    loops("loop, slack rope", 0, force, 0, pow(force, 3) / (12 * STIFFNESS * FRICTION * WEIGHT));
}

/* Masing: unloading by D goes twice as far as the first loading by D/2, at every D; and reloading
 * like unloading. */
static void masing(void **state) {
    (void)state;
    enum { STEPS = 8, N = 320 };
    const double force = 213, pretension = 300;
    for (Bed bed = BED_PLAIN; bed <= BED_CREST; bed++) {
        Rig rig;
        lay(&rig, bed, N, pretension);
        pull(&rig, 1, pretension);
        pull(&rig, STEPS, pretension + force);
        pull(&rig, STEPS, pretension - force);
        pull(&rig, STEPS, pretension + force);
        RigRun run = rig_open(&rig);
        CpsLineView view = rig_next(&run);
        double at = tip(&view), displacement[3][STEPS], worst = 0;
        for (int branch = 0; branch < 3; branch++) {
            for (int k = 0; k < STEPS; k++) {
                view = rig_step(&run);
                displacement[branch][k] = fabs(tip(&view) - at);
            }
            at = tip(&view);
        }
        for (int k = 0; k < STEPS; k++) {
            worst = fmax(worst, fabs(displacement[1][k] - 2 * displacement[0][k]) /
                                    displacement[0][STEPS - 1]);
            worst = fmax(worst, fabs(displacement[2][k] - displacement[1][k]) /
                                    displacement[0][STEPS - 1]);
        }
        /* the ends of sliding fall differently in their elements: h^2/(4 s^2) each, s = F/A */
        const double part = LENGTH / N * FRICTION * WEIGHT / force;
        CHECK_LESS(rig_show(BED[bed], "Masing, worst share off", 0, worst),
                   part * part + 2 * run.motion / displacement[0][STEPS - 1]);
        rig_close(&run);
    }
}

/* The same forces as one stage, as several, under other names: the same bits. (The forces of all
 * steps are exact in binary, so that stages cut otherwise impose the same numbers.) */
static void no_time(void **state) {
    (void)state;
    for (Bed bed = BED_PLAIN; bed <= BED_CREST; bed++) {
        double found[2][2];
        for (int displacement = 0; displacement < 2; displacement++) {
            Rig rig;
            lay(&rig, bed, 64, 256);
            pull(&rig, 1, 256);
            if (displacement == 0) {
                pull(&rig, 8, 512);
                pull(&rig, 16, 0);
            }
            if (displacement == 1) {
                pull(&rig, 2, 320);
                pull(&rig, 6, 512);
                pull(&rig, 8, 256);
                pull(&rig, 4, 128);
                pull(&rig, 4, 0);
            }
            if (displacement == 1)
                for (int s = 0; s < rig.scene.stage_count; s++) rig.stage[s].name = "slowly";
            RigRun run = rig_open(&rig);
            CpsLineView view = {0};
            while (cps_evolution_remaining_count(run.evolution) > 0) view = rig_step(&run);
            found[displacement][0] = tip(&view);
            found[displacement][1] = run.dissipated;
            rig_close(&run);
        }
        CHECK_NEAR(found[1][0], found[0][0], 0);
        CHECK_NEAR(found[1][1], found[0][1], 0);
        rig_show(BED[bed], "end, history told otherwise [m]", found[0][0], found[1][0]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pretensioned),
        cmocka_unit_test(slack),
        cmocka_unit_test(masing),
        cmocka_unit_test(no_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
