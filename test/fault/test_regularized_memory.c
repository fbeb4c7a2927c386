/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out at the k-th allocation of the 1990 method, of a study and of P10.1, for every k:
 * the call says so, and everything allocated is given back. Allocations are counted by wrapping
 * them at link time. */
#include <stdlib.h>

#include "capstan/evolve.h"
#include "capstan/regularized.h"
#include "check.h"
#include "refuse.h"
#include "straight_rope.h"

/* everything about one step; the first failure ends it */
static CpsStatus questions(const CpsLineView *view) {
    CpsRegularized *regularized = NULL, *next = NULL;
    CpsStudy *study = NULL;
    CpsFirstOrder *first_order = NULL;
    CpsRegularizedReport report;
    CpsStatus status = cps_regularized_create(view, &regularized, NULL);
    if (status == CPS_OK) {
        CpsStudyOptions options = cps_study_options_default(regularized);
        for (int s = 0; s < CPS_STUDY_STAGE_COUNT; s++) options.value_count[s] = 2;
        status = cps_study_run(regularized, &options, NULL, NULL, &study, NULL);
    }
    if (status == CPS_OK)
        status = cps_first_order_solve(regularized, CPS_FIRST_ORDER_CONTACT_REFERENCE, &first_order,
                                       NULL);
    if (status == CPS_OK) status = cps_regularized_next(view, 0.3, regularized, &next, NULL);
    if (status == CPS_OK) {
        const CpsRegularizedParameters coarse = cps_regularized_coarse(next);
        status = cps_regularized_solve(next, &coarse, 100, &report, NULL);
    }
    cps_first_order_destroy(first_order);
    cps_study_destroy(study);
    cps_regularized_destroy(next);
    cps_regularized_destroy(regularized);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    const double point[] = {0, 0, 0, 1, 0, 0};
    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    bed.friction = 0.3;
    const CpsLine line = straight_rope(point, 1, 8, 1, 1);
    const CpsChange change = {.end = CPS_END_B,
                              .to = {.kind = CPS_END_KIND_FREE, .value = {0.5, 0, 0}}};
    const CpsStage stage = {.cookie = cps_stage_default().cookie,
                            .name = "pull",
                            .step_count = 1,
                            .change_count = 1,
                            .change = &change};
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = 1;
    scene.obstacle = &bed;
    scene.line_count = 1;
    scene.line = &line;
    scene.stage_count = 1;
    scene.stage = &stage;
    CpsEvolution *evolution;
    CpsError err;
    assert_int_equal(cps_evolution_create(&scene, &evolution, &err), CPS_OK);
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);

    const long before = live;
    long k = 0;
    for (;; k++) {
        allowed = k;
        const CpsStatus status = questions(&view);
        const bool failed = allowed < 0; /* the k-th allocation was asked for */
        allowed = -1;
        assert_int_equal(live, before);
        if (!failed) {
            assert_int_equal(status, CPS_OK);
            break;
        }
        assert_int_equal(status, CPS_ERR_MEMORY);
    }
    /* the handles, their cells for three meshes, the study with its rows and four fields kept,
     * P10.1 */
    assert_true(k > 12);
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
