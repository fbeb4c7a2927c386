/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out in questions about driven systems that the random systems do not come to: a
 * minimum that is not attained, forces under a load, motions that nothing holds. Each is refused
 * once at each place of the library that asks for memory: the question says so or answers as
 * before, and everything is given back. The answers are known in closed form. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "capstan/drive.h"
#include "refuse.h"

static CpsError err;

/* What a question makes, to be let go of in any case. */
typedef struct Made {
    CpsSet *set[2];
    CpsLaw *law[2];
    CpsResistance *resistance;
    CpsSystem *system;
    CpsMotion *motion;
} Made;

/* A question; *right: the answer is that of the closed form. */
typedef CpsStatus Question(Made *made, bool *right);

#define TRY(call)                              \
    do {                                       \
        const CpsStatus status_ = (call);      \
        if (status_ != CPS_OK) return status_; \
    } while (0)

static bool is_near(double x, double wanted, double tolerance) {
    return fabs(x - wanted) <= tolerance;
}

/* The law of [-bound, bound]. */
static CpsStatus interval(Made *made, int k, double bound) {
    TRY(cps_set_interval(-bound, bound, &made->set[k], &err));
    return cps_law_friction(made->set[k], &made->law[k], &err);
}

/* phi(a, b) = sqrt(a^2 + b^2) - b of a disc that touches 0 falls to 0 for ever. Beside it c, which
 * has friction, and d = c, which a viscous law damps: both are at rest. The load drives a with 3 N,
 * so that the least power at a = 2 is -6 W. */
static CpsStatus ask_not_attained(Made *made, bool *right) {
    TRY(cps_set_ball(2, (const double[]){0, 1}, 1, &made->set[0], &err));
    TRY(cps_law_friction(made->set[0], &made->law[0], &err));
    TRY(interval(made, 1, 1));
    TRY(cps_resistance_viscous(1, (const double[]){1}, &made->resistance, &err));
    TRY(cps_system_create(4, &made->system, &err));
    const CpsEntry own[] = {{0, 0, 1}, {1, 1, 1}}, equal[] = {{0, 2, 1}, {0, 3, -1}};
    TRY(cps_system_add_friction(made->system, "beside", made->law[0], 2, own, &err));
    TRY(cps_system_add_friction(made->system, "friction", made->law[1], 1, &(CpsEntry){0, 2, 1},
                                &err));
    TRY(cps_system_add_resistance(made->system, "oil", made->resistance, 1, &(CpsEntry){0, 3, 1},
                                  &err));
    TRY(cps_system_add_constraints(made->system, 1, 2, equal, &err));
    TRY(cps_system_set_drive(made->system, 1, 1, &(CpsEntry){0, 0, 1}, &err));
    TRY(cps_system_set_load(made->system, (const double[]){3, 0, 0, 0}, &err));
    TRY(cps_system_solve(made->system, (const double[]){2}, NULL, &made->motion, &err));
    const CpsMotionReport report = cps_motion_report(made->motion);
    const double *d = cps_motion_direction(made->motion);
    *right = report.outcome == CPS_MOTION_OUTCOME_NOT_ATTAINED && report.lower <= -6 + 1e-9 &&
             is_near(report.upper, -6, 1e-5) && /* the root of rounding, times 6 */
             is_near(d[1], 1, 1e-9) && is_near(d[0], 0, 1e-9) && is_near(d[2], 0, 1e-6);
    bool known, holds;
    TRY(cps_motion_continuous(made->motion, &known, &holds, &err));
    *right = *right && known && holds; /* discs and intervals are bounded */
    return CPS_OK;
}

/* Two brakes of 1 and 2 N on the driven parameter, and a load of 0.5 N: G is in [-2.5, 3.5]. */
static CpsStatus ask_loaded(Made *made, bool *right) {
    CpsSetExtent extent;
    CpsSet *forces = NULL;
    TRY(interval(made, 0, 1));
    TRY(interval(made, 1, 2));
    TRY(cps_system_create(1, &made->system, &err));
    for (int k = 0; k < 2; k++)
        TRY(cps_system_add_friction(made->system, NULL, made->law[k], 1, &(CpsEntry){0, 0, 1},
                                    &err));
    TRY(cps_system_set_drive(made->system, 1, 1, &(CpsEntry){0, 0, 1}, &err));
    TRY(cps_system_set_load(made->system, (const double[]){0.5}, &err));
    TRY(cps_system_eliminate(made->system, NULL, &forces, NULL, &err));
    const CpsStatus status = cps_set_extent(forces, (const double[]){1}, &extent, &err);
    cps_set_release(forces);
    *right = is_near(extent.low, -2.5, 1e-9) && is_near(extent.high, 3.5, 1e-9);
    return status;
}

/* A parameter that is not driven carries `load` on a brake of 1 N; nothing but 0.3 N acts on the
 * driven one. */
static CpsStatus ask_beside(Made *made, double load, bool *right) {
    CpsSetExtent extent;
    CpsSet *forces = NULL;
    TRY(interval(made, 0, 1));
    TRY(cps_system_create(2, &made->system, &err));
    TRY(cps_system_add_friction(made->system, NULL, made->law[0], 1, &(CpsEntry){0, 1, 1}, &err));
    TRY(cps_system_set_drive(made->system, 1, 1, &(CpsEntry){0, 0, 1}, &err));
    TRY(cps_system_set_load(made->system, (const double[]){0.3, load}, &err));
    TRY(cps_system_eliminate(made->system, NULL, &forces, NULL, &err));
    const CpsStatus status = cps_set_extent(forces, (const double[]){1}, &extent, &err);
    cps_set_release(forces);
    *right = fabs(load) > 1 ? extent.outcome == CPS_SET_OUTCOME_EMPTY
                            : is_near(extent.low, 0.3, 1e-12) && is_near(extent.high, 0.3, 1e-12);
    return status;
}
static CpsStatus ask_borne(Made *made, bool *right) { return ask_beside(made, 0.5, right); }
static CpsStatus ask_too_much(Made *made, bool *right) { return ask_beside(made, -1.5, right); }

/* No force of the laws moves either parameter: any velocity of the second is a motion. */
static CpsStatus ask_unheld(Made *made, bool *right) {
    double low[2], high[2];
    CpsSolutionSet all;
    TRY(interval(made, 0, 1));
    TRY(cps_system_create(2, &made->system, &err));
    TRY(cps_system_add_friction(made->system, "on nothing", made->law[0], 0, NULL, &err));
    TRY(cps_system_set_drive(made->system, 1, 1, &(CpsEntry){0, 0, 1}, &err));
    TRY(cps_system_solve(made->system, (const double[]){2}, NULL, &made->motion, &err));
    TRY(cps_motion_velocities(made->motion, 0, &all, low, high, &err));
    *right = all.outcome == CPS_SET_OUTCOME_ANSWERED && !all.bounded && !all.unique &&
             is_near(low[0], 2, 1e-9) && is_near(high[0], 2, 1e-9) && low[1] == -INFINITY &&
             high[1] == INFINITY;
    cps_solution_set_clear(&all);
    return CPS_OK;
}

static CpsStatus ask(Question *question, bool *right) {
    Made made = {.system = NULL};
    *right = false;
    const CpsStatus status = question(&made, right);
    cps_motion_destroy(made.motion);
    cps_system_destroy(made.system);
    cps_resistance_release(made.resistance);
    for (int k = 0; k < 2; k++) {
        cps_law_release(made.law[k]);
        cps_set_release(made.set[k]);
    }
    return status;
}

static long refused;

static void refuse_each(Question *question, const char *name) {
    bool right;
    long next = places;
    asked = 0;
    recording = true;
    const CpsStatus usual = ask(question, &right);
    recording = false;
    if (usual != CPS_OK) fail_msg("%s: %s", name, err.message);
    if (!right) fail_msg("%s: not the answer in closed form", name);
    while (next < places) {
        const long before = live;
        allowed = first[next++];
        const CpsStatus status = ask(question, &right);
        const bool reached = allowed < 0;
        allowed = -1;
        if (live != before) fail_msg("%s: %ld blocks lost", name, live - before);
        if (status == CPS_OK ? !right : !(reached && status == CPS_ERR_MEMORY))
            fail_msg("%s: %s: %s", name, cps_status_name(status),
                     status ? err.message : "another answer");
        refused += reached;
    }
}

static void every_place_may_fail(void **state) {
    (void)state;
    refuse_each(ask_not_attained, "not attained");
    refuse_each(ask_loaded, "forces under a load");
    refuse_each(ask_borne, "a load that is borne beside");
    refuse_each(ask_too_much, "a load that is too much");
    refuse_each(ask_unheld, "a parameter that nothing holds");
    if (refused == 0) skip(); /* built as shared libraries it cannot be reached */
    print_message("%ld places, each refused once\n", refused);
    assert_in_range(refused, 100, 100000);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_place_may_fail)};
    return cmocka_run_group_tests_name("motions without memory", tests, NULL, NULL);
}
