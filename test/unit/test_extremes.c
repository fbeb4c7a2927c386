/* SPDX-License-Identifier: BSD-3-Clause */
/* Extremes of a history: random reports, added one by one, against a search over all of them. */
#include "capstan/evolve.h"
#include "check.h"
#include "splitmix.h"

enum { STEPS = 40 };

/* A coarse number, so that values repeat; of any sign. */
static double coarse(uint64_t *state) { return floor(splitmix(state, -5, 5)); }

static CpsLineReport random_report(uint64_t *state) {
    CpsLineReport report = {.outcome = splitmix(state, 0, 1) < 0.2   ? CPS_OUTCOME_STALLED
                                       : splitmix(state, 0, 1) < 0.2 ? CPS_OUTCOME_TAUT
                                                                     : CPS_OUTCOME_SOLVED};
    report.grounded = coarse(state);
    report.slipping = coarse(state);
    report.slack = coarse(state);
    report.sweep = coarse(state);
    report.has_slipping = splitmix(state, 0, 1) < 0.7;
    report.has_touchdown = splitmix(state, 0, 1) < 0.6;
    report.has_utilisation = splitmix(state, 0, 1) < 0.5;
    report.utilisation = coarse(state);
    for (int e = 0; e < 2; e++) {
        report.end[e].tension = coarse(state);
        report.end[e].uplift = coarse(state);
        report.end[e].angle = coarse(state);
        report.end[e].suspended = coarse(state);
        for (int a = 0; a < 3; a++) report.end[e].touchdown[a] = coarse(state);
    }
    return report;
}

/* The extremes of values of which some do not count. */
static void expect(const CpsExtreme *found, const double *value, const bool *counts) {
    int least = -1, greatest = -1;
    for (int i = STEPS - 1; i >= 0; i--) {
        if (!counts[i]) continue;
        if (least < 0 || value[i] <= value[least]) least = i;
        if (greatest < 0 || value[i] >= value[greatest]) greatest = i;
    }
    CHECK_INT(found->has_values, least >= 0);
    if (least < 0) return;
    CHECK_NEAR(found->least, value[least], 0);
    CHECK_NEAR(found->greatest, value[greatest], 0);
    CHECK_INT(found->least_step, 100 + least);
    CHECK_INT(found->greatest_step, 100 + greatest);
}

#define EXPECT(extreme, member, flag)                                          \
    do {                                                                       \
        for (int i = 0; i < STEPS; i++) {                                      \
            value[i] = report[i].member;                                       \
            counts[i] = cps_outcome_is_certified(report[i].outcome) && (flag); \
        }                                                                      \
        expect(&(extreme), value, counts);                                     \
    } while (0)

static void random_histories(void **unused) {
    (void)unused;
    uint64_t state = 5;
    for (int k = 0; k < 200; k++) {
        CpsLineReport report[STEPS];
        CpsExtremes found = {0};
        double value[STEPS];
        bool counts[STEPS];
        for (int i = 0; i < STEPS; i++) {
            report[i] = random_report(&state);
            cps_extremes_add(&found, &report[i], 100 + i);
        }
        for (int e = 0; e < 2; e++) {
            EXPECT(found.tension[e], end[e].tension, true);
            EXPECT(found.uplift[e], end[e].uplift, true);
            EXPECT(found.angle[e], end[e].angle, true);
            EXPECT(found.suspended[e], end[e].suspended, true);
            for (int a = 0; a < 3; a++)
                EXPECT(found.touchdown[e][a], end[e].touchdown[a], report[i].has_touchdown);
        }
        EXPECT(found.grounded, grounded, true);
        EXPECT(found.slipping, slipping, report[i].has_slipping);
        EXPECT(found.slack, slack, true);
        EXPECT(found.sweep, sweep, true);
        EXPECT(found.utilisation, utilisation, report[i].has_utilisation);
    }
}

static void nothing_to_add(void **unused) {
    (void)unused;
    CpsExtremes found = {0};
    const CpsLineReport stalled = {.outcome = CPS_OUTCOME_STALLED};
    cps_extremes_add(&found, &stalled, 0);
    cps_extremes_add(&found, NULL, 0);
    cps_extremes_add(NULL, &stalled, 0);
    CHECK_INT(found.grounded.has_values || found.tension[0].has_values, false);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_histories),
        cmocka_unit_test(nothing_to_add),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
