/* SPDX-License-Identifier: BSD-3-Clause */
/* The first quasi-static step after steps in time: the line is brought to rest, and its ledger says
 * what that takes. The loss is compared with energies that are taken anew from the positions before
 * and after. Each figure is printed. */
#include <stdio.h>

#include "splitmix.h"
#include "time_rig.h"

static uint64_t dice;

static double uniform(double low, double high) { return splitmix(&dice, low, high); }

/* ---- energies of the positions ---- */

typedef struct Energies {
    double kinetic, elastic, gravity; /* [J] */
} Energies;

/* `elongation`: of the elements of a damped line, else NULL; `up`: against gravity, the unit vector
 * times its share of that of the scene. */
static Energies energies(const TimeRun *run, const double *elongation, const double up[3]) {
    const CpsLineView *v = &run->view;
    const CpsLineMotion *m = &run->motion;
    const CpsLine *line = &run->rig->line;
    const double l = line->length / v->element_count;
    Energies sum = {0};
    for (int j = 0; j <= v->element_count; j++) {
        for (int a = 0; a < 3; a++)
            sum.kinetic += 0.5 * m->mass[j] * pow(m->velocity[3 * j + a], 2);
        const double part = j > 0 && j < v->element_count ? l : l / 2;
        for (int a = 0; a < 3; a++)
            sum.gravity += part * line->weight * up[a] * v->position[3 * j + a];
        if (j == 0) continue;
        double square = 0;
        for (int a = 0; a < 3; a++)
            square += pow(v->position[3 * j + a] - v->position[3 * (j - 1) + a], 2);
        double strain = fmax(0, sqrt(square) / l - 1);
        if (elongation) strain = elongation[j - 1];
        if (isfinite(line->stiffness)) sum.elastic += 0.5 * l * line->stiffness * strain * strain;
    }
    return sum;
}

/* ---- random lines ---- */

typedef struct Kind {
    const char *name;
    bool plane, damped, water, free, stiff, moved, tilted;
} Kind;

/* A line that begins aside, with a velocity, moves for a while, and is then at rest. */
static void throw_line(TimeRig *rig, const Kind *kind) {
    const int elements = 4 + (int)uniform(0, 12);
    const double length = pow(10, uniform(-0.5, 2.5)), mass = pow(10, uniform(-1, 2)),
                 weight = mass * 9.81;
    /* the audit of a plane does not know the origin of the views */
    const double away = kind->plane ? 0 : 1e3;
    double far[3];
    for (int a = 0; a < 3; a++) far[a] = uniform(-away, away);
    time_begin(rig, length, elements, mass,
               kind->stiff ? INFINITY : weight * length * pow(10, uniform(1, 4)));
    if (kind->damped) rig->line.damping = rig->line.stiffness * uniform(0.01, 0.3);
    if (kind->plane) {
        const double friction = uniform(0, 1);
        time_plane(rig, far[2] - uniform(0.02, 0.3) * length, friction);
    }
    const double east = uniform(-1, 1), north = uniform(-1, 1), flow[3] = {east, north, 0};
    if (kind->water)
        time_water(rig, 1025, flow,
                   (CpsDrag){.diameter = 0.02 * length, .normal = 1.2, .tangential = 0.1});
    const double span = uniform(0.5, 0.95) * length, turn = uniform(0, 6.28);
    for (int j = 0; j <= elements; j++) {
        const double s = (double)j / elements;
        time_node(rig, j, far[0] + s * span * cos(turn), far[1] + s * span * sin(turn),
                  far[2] + (kind->free ? 0 : uniform(-0.02, 0.02)) * length * s * (1 - s));
    }
    rig->line.end[CPS_END_B].kind = CPS_END_KIND_AT_START;
    if (kind->free)
        rig->line.end[CPS_END_B] =
            (CpsEnd){.kind = CPS_END_KIND_FREE,
                     .value = {0.2 * weight * length, 0, -0.1 * weight * length}};
    for (int a = 0; a < 3; a++) rig->line.velocity[a] = uniform(-1, 1) * sqrt(9.81 * length);
}

/* In the stage that brings the line to rest, gravity is another or end B goes elsewhere. */
static void change_rest(TimeRig *rig, const Kind *kind, double up[3]) {
    CpsStage *rest = time_stage(rig, 0, 1);
    const double l = 0.05 * rig->line.length, *b = &rig->point[3 * rig->line.element_count];
    if (kind->moved) {
        const double z = b[2] + uniform(0, l), y = b[1] + uniform(-l, l), x = b[0] + uniform(-l, l);
        time_change(rig, CPS_END_KIND_HELD, x, y, z);
    }
    rest->gravity_changes = kind->tilted;
    for (int a = 0; a < 3; a++) {
        if (kind->tilted) up[a] = a == 2 ? uniform(0.5, 1.5) : uniform(-0.5, 0.5);
        rest->gravity[a] = -rig->gravity * up[a];
    }
}

/* The ledger of the step by which it came to rest, beside energies of before and after. */
static double audit_rest(const TimeRun *run, const Energies *before, const Energies *after,
                         const double from[3]) {
    const CpsLedger *ledger = &run->report.ledger;
    const CpsMotionLedger *motion = &run->motion.ledger;
    const int last = run->view.element_count;
    double ends = 0;
    for (int a = 0; a < 3; a++)
        ends += run->report.end[CPS_END_B].force[a] * (run->view.position[3 * last + a] - from[a]);
    const double lost = before->kinetic + before->elastic + before->gravity - after->elastic -
                        after->gravity + ends + ledger->loads - ledger->dissipated;
    const double size = before->kinetic + before->elastic + fabs(after->gravity - before->gravity) +
                        fabs(ends) + fabs(ledger->loads);
    /* a step that is certified to a gap leaves an energy of that order, and places their rounding
     */
    const double noise = 10 * run->report.certificate.gap + 1e-9 * size;
    CHECK_NEAR(motion->kinetic, -before->kinetic, 1e-12 * before->kinetic);
    CHECK_NEAR(ledger->ends, ends, 1e-9 * size);
    CHECK_NEAR(motion->settling, lost, noise);
    CHECK_LESS(before->kinetic - motion->settling, noise + 1e-300);
    CHECK_NEAR(ledger->imbalance, 0, noise);
    CHECK_NEAR(motion->kinetic + motion->settling + ledger->elastic + ledger->gravity +
                   ledger->dissipated + ledger->imbalance - ledger->ends - ledger->loads,
               0, 1e-12 * size);
    return fabs(ledger->imbalance) / (size + 1e-300);
}

/* It moves, is brought to rest, and in a next step stays there. */
static double comes_to_rest(const Kind *kind) {
    TimeRig rig;
    double elongation[TIME_POINTS], from[3], up[3] = {0, 0, 1};
    throw_line(&rig, kind);
    const int steps = 3 + (int)uniform(0, 40), last = rig.line.element_count;
    time_stage(&rig, uniform(0.2, 3) * sqrt(rig.line.length / 9.81), steps);
    change_rest(&rig, kind, up);
    time_stage(&rig, 0, 1);
    TimeRun run = time_open(&rig);
    time_steps(&run, steps);
    if (kind->damped)
        for (int e = 0; e < last; e++) elongation[e] = run.motion.elongation[e];
    for (int a = 0; a < 3; a++) from[a] = run.view.position[3 * last + a];
    const Energies before = energies(&run, kind->damped ? elongation : NULL, up);
    time_step(&run);
    const Energies after = energies(&run, NULL, up);
    CHECK_INT(run.report.substep_count, 1);
    const double found = audit_rest(&run, &before, &after, from);
    printf("%-24s lost %-12.6g of kinetic %-12.6g imbalance %.1e of it\n", kind->name,
           run.motion.ledger.settling, before.kinetic, found);
    time_step(&run);
    CHECK_NEAR(run.motion.ledger.kinetic, 0, 0);
    CHECK_NEAR(run.motion.ledger.settling, 0, 0);
    time_close(&run, kind->name);
    return found;
}

static void what_comes_to_rest_says_what_that_takes(void **state) {
    (void)state;
    static const Kind kind[] = {{"hangs", .plane = false},
                                {"is pulled", .free = true},
                                {"on a plane", .plane = true},
                                {"pulled on a plane", .plane = true, .free = true},
                                {"damped", .damped = true},
                                {"damped, on a plane", .damped = true, .plane = true},
                                {"in a current", .water = true},
                                {"inextensible", .stiff = true},
                                {"its end moves", .moved = true},
                                {"its end moves, on a plane", .moved = true, .plane = true},
                                {"gravity turns", .tilted = true, .damped = true}};
    double worst = 0;
    for (uint64_t seed = 1; seed <= 12; seed++)
        for (size_t k = 0; k < sizeof kind / sizeof *kind; k++) {
            dice = 100 * seed + k;
            worst = fmax(worst, comes_to_rest(&kind[k]));
        }
    time_report("coming to rest", "largest imbalance, of what there was", 0, worst);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_comes_to_rest_says_what_that_takes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
