/* SPDX-License-Identifier: BSD-3-Clause */
/* Load steps in substeps, the energy ledger and jumps, on cases with known answers. */
#include <math.h>
#include <stdlib.h>

#include "cases.h"
#include "check.h"

/* Work, energies and dissipation summed over a history. */
typedef struct Sum {
    CpsLedger ledger;
    double exchanged; /* [J] sum of |work of the ends| */
    int parts, snaps;
    double jump;
} Sum;

static Sum run_all(const CpsScene *scene) {
    CpsError err;
    CpsEvolution *evolution = NULL;
    assert_int_equal(cps_evolution_create(scene, &evolution, &err), CPS_OK);
    Sum sum = {0};
    while (cps_evolution_remaining_count(evolution) > 0) {
        assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
        const CpsStepReport report = cps_evolution_report(evolution);
        assert_int_equal(report.outcome, CPS_OUTCOME_SOLVED);
        const CpsLedger *l = &report.ledger;
        /* the ledger closes by its own definition, and friction only takes */
        CHECK_NEAR(l->ends + l->obstacles, l->elastic + l->gravity + l->dissipated + l->imbalance,
                   1e-12 * (fabs(l->ends) + fabs(l->elastic) + fabs(l->gravity) + l->dissipated));
        assert_true(l->dissipated >= 0);
        sum.ledger.ends += l->ends;
        sum.ledger.elastic += l->elastic;
        sum.ledger.gravity += l->gravity;
        sum.ledger.dissipated += l->dissipated;
        sum.ledger.imbalance += l->imbalance;
        sum.exchanged += fabs(l->ends);
        sum.parts += report.substep_count;
        sum.snaps += report.jump_count;
        sum.jump = fmax(sum.jump, report.jump);
    }
    cps_evolution_destroy(evolution);
    return sum;
}

/* A straight elastic line without weight, pulled along itself: force and displacement are linear,
 * so the ledger closes to rounding: F L/EA = 2 x 3/100, work F u/2. */
static void linear_path_closes(void **state) {
    (void)state;
    Case c;
    case_begin(&c, 3, 30, 0, 100);
    case_straight(&c, 0, 3);
    case_force(&c, 8, 2, 0, 0);
    const Sum sum = run_all(&c.scene);
    CHECK_NEAR(sum.ledger.ends, 0.5 * 2 * 0.06, 1e-8 * 0.06);
    CHECK_NEAR(sum.ledger.elastic, 0.5 * 2 * 0.06, 1e-8 * 0.06);
    /* rounding of energies and the solver's gap, 1e-13 of its scale */
    CHECK_NEAR(sum.ledger.imbalance, 0, 1e-8 * sum.exchanged);
    assert_int_equal(sum.parts, 8);
}

/* The same beside a line that is laid: it takes the step of statics under the force that it has,
 * with a ledger of its own. No force is known before, so the work of the end is F u and the
 * imbalance half of it; the line laid has no ledger. */
static void lines_beside_one_laid(void **state) {
    (void)state;
    Case laid, c;
    CpsError err;
    case_begin(&laid, 10, 20, 5, 1e4);
    case_laid(&laid, 8, 1);
    case_begin(&c, 3, 30, 0, 100);
    case_straight(&c, 0, 3);
    c.line.end[CPS_END_B].value[0] = 2;
    CpsLine lines[2] = {laid.line, c.line};
    lines[1].name = "other";
    c.scene.line = lines;
    c.scene.line_count = 2;
    CpsEvolution *evolution = NULL;
    assert_int_equal(cps_evolution_create(&c.scene, &evolution, &err), CPS_OK);
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    const CpsLineReport other = cps_evolution_line_report(evolution, 1);
    assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    CHECK_NEAR(other.ledger.ends, 2 * 0.06, 1e-8 * 0.06);
    CHECK_NEAR(other.ledger.elastic, 0.5 * 2 * 0.06, 1e-8 * 0.06);
    CHECK_NEAR(other.ledger.imbalance, 0.5 * 2 * 0.06, 1e-8 * 0.06);
    const CpsLedger none = cps_evolution_line_report(evolution, 0).ledger;
    assert_true(none.ends == 0 && none.elastic == 0 && none.gravity == 0 && none.imbalance == 0);
    CHECK_NEAR(cps_evolution_report(evolution).ledger.ends, 2 * 0.06, 1e-8 * 0.06);
    cps_evolution_destroy(evolution);
}

/* Straight drag on a bed (dissipation on loading P^3/(6 A K)), in more and more load steps. */
static double drag(int steps, Sum *sum) {
    Case c;
    case_begin(&c, 6.28, 200, 9.81, 10);
    case_bed(&c, 0.25 / 9.81);
    case_straight(&c, 0, 6.28);
    case_force(&c, steps, 0.5, 0, 0);
    *sum = run_all(&c.scene);
    return fabs(sum->ledger.imbalance) / sum->exchanged;
}

static void ledger_closes_with_the_steps(void **state) {
    (void)state;
    Sum sum;
    const double coarse = drag(4, &sum), middle = drag(16, &sum), fine = drag(200, &sum);
    print_message("imbalance/exchanged: %.2e %.2e %.2e at 4, 16, 200 steps\n", coarse, middle,
                  fine);
    /* first order would be 1/4 and 1/12.5; here the trapezium rule makes it the second */
    CHECK_LESS(middle, coarse / 8);
    CHECK_LESS(fine, middle / 60);
    CHECK_LESS(fine, 1e-3);
    /* dissipated on loading P^3/(6 A K) (0.5, 0.25, 10): 1/120 J, to first order in the load step,
     * 1/200 */
    CHECK_NEAR(sum.ledger.dissipated, 1.0 / 120, 1e-2 / 120);
}

/* A line on a bed, its end taken sideways: how far it comes to lie, and what it costs, depend on
 * the path. */
static double sideways(int steps, double path_tolerance, Sum *sum) {
    Case c;
    case_begin(&c, 6.28, 60, 9.81, 1e3);
    case_bed(&c, 0.5);
    case_straight(&c, 0, 6.28);
    case_move(&c, steps, 4, 4, 0);
    c.scene.solver.path_tolerance = path_tolerance;
    *sum = run_all(&c.scene);
    return sum->ledger.dissipated;
}

/* One step asked for, a path tolerance given: the step is cut, and the dissipation is that of small
 * steps. */
static void path_tolerance_cuts(void **state) {
    (void)state;
    Sum one, cut, fine;
    const double whole = sideways(1, 0, &one), halved = sideways(1, 1e-3, &cut),
                 reference = sideways(256, 0, &fine);
    print_message("dissipated %.6f in one step, %.6f in %d parts, %.6f in 256 steps\n", whole,
                  halved, cut.parts, reference);
    assert_int_equal(one.parts, 1);
    assert_true(cut.parts > 8);
    assert_int_equal(cut.snaps, 0);
    CHECK_LESS(fabs(halved - reference), 0.1 * fabs(whole - reference));
}

/* Nothing is cut that need not be: proportional loading of a straight line leads to the same place
 * in one step or in many. */
static void easy_steps_stay_whole(void **state) {
    (void)state;
    Case c;
    case_begin(&c, 6.28, 200, 9.81, 10);
    case_bed(&c, 0.25 / 9.81);
    case_straight(&c, 0, 6.28);
    case_force(&c, 1, 0.5, 0, 0);
    c.scene.solver.path_tolerance = 1e-6;
    assert_int_equal(run_all(&c.scene).parts, 2); /* the two halves that were compared */
}

/* A block on a string: one element on a bed, its end B pulled towards A by a force that grows. It
 * rests up to mu w L/2, the friction of the half of the line that lies at B; nothing but friction
 * holds it then, and it slides at once, a finite way however small the growth, past A until the
 * string is taut on the other side: from +L to -(L + (f - mu w L/2) L/EA). */
typedef struct Block {
    double limit, length, stiffness; /* [N], [m], [N] */
    double last;                     /* [N] force of the last step */
} Block;

static const Block BLOCK = {.limit = 0.5, .length = 1, .stiffness = 1e3, .last = 0.93};

static void block(Case *c, int steps) {
    case_begin(c, BLOCK.length, 1, 2, BLOCK.stiffness);
    case_bed(c, 0.5);
    case_straight(c, 0, BLOCK.length);
    case_force(c, steps, -BLOCK.last, 0, 0);
}

/* Every step of it against this; returns how far the ledger of the one with the slide is open [J].
 * The loop ends at a relative gap of 1e-13, of the second order in places and forces: 3e-7 of 1 m
 * and of 1 N, and 1e-6 is allowed. */
static double slide_off(int steps) {
    static const double NEAR = 1e-6;
    Case c;
    block(&c, steps);
    Run run = case_open(&c);
    double open = 0, before = 0;
    for (int k = 1; k <= steps; k++) {
        const CpsLineView view = case_step(&run);
        const CpsLedger l = cps_evolution_report(run.evolution).ledger;
        const double force = BLOCK.last * k / steps, over = (force - BLOCK.limit) / BLOCK.stiffness;
        if (force < BLOCK.limit) {
            CHECK_NEAR(view.position[3], BLOCK.length, NEAR);
            CHECK_NEAR(l.dissipated, 0, NEAR);
        } else {
            CHECK_NEAR(view.position[3], -(BLOCK.length + over), NEAR);
            CHECK_NEAR(view.tension[0], force - BLOCK.limit, NEAR);
        }
        if (force >= BLOCK.limit && before < BLOCK.limit) {
            const double displacement = 2 * BLOCK.length + over;
            CHECK_NEAR(l.dissipated, BLOCK.limit * displacement, NEAR);
            CHECK_NEAR(l.ends, 0.5 * (before + force) * displacement, NEAR);
            CHECK_NEAR(l.elastic, 0.5 * BLOCK.stiffness * over * over, NEAR);
            open = l.imbalance;
        }
        before = force;
    }
    case_close(&run);
    return open;
}

static void block_slides_off(void **state) {
    (void)state;
    for (int steps = 10; steps <= 1000; steps *= 10) {
        const double open = slide_off(steps);
        show("block on a string", "ledger of the slide, open by [J]", 0, open);
        /* the mean of the forces before and after is at most half a load step off the limit; 1 %
         * for the string */
        CHECK_LESS(fabs(open), 1.01 * BLOCK.length * BLOCK.last / steps);
    }
}

/* With a path tolerance the slide is an event of its step and of no other: one jump, found to a
 * part of 2^-10 of the step, so that the ledger is open by at most L df/1024 there; 1 % for the
 * string. */
static void slide_is_a_snap(void **state) {
    (void)state;
    enum { STEPS = 10 };
    Case c;
    block(&c, STEPS);
    c.scene.solver.path_tolerance = 1e-3;
    Run run = case_open(&c);
    double before = 0;
    for (int k = 1; k <= STEPS; k++) {
        case_step(&run);
        const CpsStepReport report = cps_evolution_report(run.evolution);
        const double force = BLOCK.last * k / STEPS;
        const bool slides = force >= BLOCK.limit && before < BLOCK.limit;
        CHECK_INT(report.jump_count, slides);
        /* it lands where the force of its part, between limit and `force`, strains the string */
        if (slides)
            CHECK_NEAR(report.jump, 2 * BLOCK.length,
                       (force - BLOCK.limit) / BLOCK.stiffness + 1e-6);
        if (slides)
            CHECK_LESS(fabs(report.ledger.imbalance),
                       1.01 * BLOCK.length * BLOCK.last / STEPS / 1024);
        before = force;
    }
    case_close(&run);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_path_closes),
        cmocka_unit_test(lines_beside_one_laid),
        cmocka_unit_test(ledger_closes_with_the_steps),
        cmocka_unit_test(path_tolerance_cuts),
        cmocka_unit_test(easy_steps_stay_whole),
        cmocka_unit_test(block_slides_off),
        cmocka_unit_test(slide_is_a_snap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
