/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out at the k-th allocation of a series of queries of sets, for every k: the call
 * reports it, and all memory is freed. Allocations are counted by wrapping them at link time. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "capstan/set.h"
#include "refuse.h"

/* (disc ∩ strip) + box, its hull with a point, an image of its polar; every question; the first
 * failure ends it. */
static CpsStatus questions(void) {
    static const double AXIS[2] = {0, 1}, LOW[2] = {-1, -1}, HIGH[2] = {1, 1}, FAR[2] = {7, 2},
                        MAP[4] = {1, 1, 0, 2};
    CpsSet *set[12] = {NULL};
    CpsSetAnswer answer;
    CpsSetFacts facts;
    CpsSetMeasure measure;
    double x[16];
    int count;
    CpsStatus status = cps_set_ball(2, NULL, 5, &set[0], NULL);
    if (!status) status = cps_set_strip(2, AXIS, -2, 2, &set[1], NULL);
    if (!status) status = cps_set_intersection(2, (const CpsSet *const *)set, &set[2], NULL);
    if (!status) status = cps_set_box(2, LOW, HIGH, &set[3], NULL);
    if (!status) status = cps_set_sum(2, (const CpsSet *const *)&set[2], &set[4], NULL);
    if (!status) status = cps_set_point(2, FAR, &set[5], NULL);
    if (!status) status = cps_set_hull(2, (const CpsSet *const *)&set[4], &set[6], NULL);
    if (!status) status = cps_set_polar(set[6], &set[7], NULL);
    if (!status) status = cps_set_image(2, MAP, set[7], &set[8], NULL);
    for (int k = 2; !status && k <= 8; k += 3) {
        CpsSet *face = NULL, *cone = NULL;
        status = cps_set_support(set[k], AXIS, x, &answer, NULL);
        if (!status) status = cps_set_face(set[k], AXIS, 0, &face, &answer, NULL);
        if (!status) status = cps_set_normal_cone(set[k], x, 0, &cone, &answer, NULL);
        if (!status && cone) status = cps_set_rays(cone, 0, 4, x, &count, &answer, NULL);
        if (!status) status = cps_set_contains(set[k], FAR, NULL, &answer, NULL);
        if (!status) status = cps_set_gauge(set[k], FAR, &answer, NULL);
        if (!status) status = cps_set_facts(set[k], 0, &facts, x, NULL, NULL);
        if (!status && k == 2) status = cps_set_vertices(set[k], 0.5, 8, x, &count, &answer, NULL);
        if (!status && k == 2) status = cps_set_measure(set[3], &measure, NULL);
        cps_set_release(face);
        cps_set_release(cone);
    }
    for (int k = 0; k < 12; k++) cps_set_release(set[k]);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    long k = 0;
    for (;; k++) {
        const long before = live;
        allowed = k;
        const CpsStatus status = questions();
        const int reached = allowed < 0;
        allowed = -1;
        if (live != before) fail_msg("allocation %ld: %ld blocks lost", k, live - before);
        /* a closed form without memory for its scratch hands over to the solver, so a failure may
         * be made good */
        if (status != CPS_OK && status != CPS_ERR_MEMORY)
            fail_msg("allocation %ld: %s", k, cps_status_name(status));
        if (!reached) {
            assert_int_equal(status, CPS_OK);
            break;
        }
    }
    if (k == 0) skip();
    print_message("%ld allocations, each refused once\n", k);
    assert_in_range(k, 100, 1000000);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail)};
    return cmocka_run_group_tests_name("sets without memory", tests, NULL, NULL);
}
