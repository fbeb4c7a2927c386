/* SPDX-License-Identifier: BSD-3-Clause */
/* Every public function of the library that has a handle, an index or an array as argument is
 * called with NULL or with an invalid one: it refuses with a status and a message, or returns
 * nothing. A crash is reported with its line, and the other calls are still made. (Those of
 * evolve.h: test_results.c.) */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "capstan/evolve.h"
#include "capstan/planar.h"
#include "capstan/regularized.h"
#include "misuse.h"

static const double ZERO[9] = {0}, ONE[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
static const int ABSENT[] = {-1, 99, INT_MAX, INT_MIN};
enum { ABSENCES = sizeof ABSENT / sizeof *ABSENT, NEVER = -77 };

static CpsError err;

/* What the calls below are made with, each of them sound. */
static CpsSet *disc, *set;
static CpsLaw *law, *made;
static CpsResistance *viscous, *resistance;
static CpsSetAnswer answer;
static double number[64];
static int count;
static volatile int i, k, n; /* of loops, which a crash must not disturb */

static void make(void **state) {
    (void)state;
    SOUND(cps_set_ball(2, NULL, 1, &disc, &err));
    SOUND(cps_law_friction(disc, &law, &err));
    SOUND(cps_resistance_viscous(2, (double[]){1, 0, 0, 1}, &viscous, &err));
}

static void names_of_nothing(void **state) {
    (void)state;
    GIVES(cps_status_name((CpsStatus)NEVER) != NULL && cps_status_text((CpsStatus)NEVER) != NULL);
    GIVES(cps_set_outcome_name((CpsSetOutcome)NEVER) != NULL &&
          cps_set_outcome_text((CpsSetOutcome)NEVER) != NULL);
    GIVES(cps_composition_name((CpsComposition)NEVER) != NULL &&
          cps_composition_text((CpsComposition)NEVER) != NULL);
    GIVES(cps_motion_outcome_name((CpsMotionOutcome)NEVER) != NULL &&
          cps_motion_outcome_text((CpsMotionOutcome)NEVER) != NULL);
    GIVES(cps_outcome_name((CpsOutcome)NEVER) != NULL &&
          cps_outcome_text((CpsOutcome)NEVER) != NULL);
    GIVES(cps_range_name((CpsRange)NEVER) != NULL);
    GIVES(cps_range_text((CpsRange)NEVER) != NULL);
    GIVES(!cps_outcome_is_certified((CpsOutcome)NEVER) && !cps_outcome_is_final((CpsOutcome)NEVER));
    GIVES(cps_judgement_name((CpsJudgement)NEVER) != NULL &&
          cps_judgement_text((CpsJudgement)NEVER) != NULL);
    GIVES(cps_completion_name((CpsCompletion)NEVER) != NULL &&
          cps_completion_text((CpsCompletion)NEVER) != NULL);
    GIVES(cps_study_stage_name((CpsStudyStage)NEVER) != NULL);
    GIVES(cps_first_order_outcome_name((CpsFirstOrderOutcome)NEVER) != NULL &&
          cps_first_order_outcome_text((CpsFirstOrderOutcome)NEVER) != NULL);
}

static void sets(void **state) {
    (void)state;
    const CpsSet *const none[2] = {NULL, NULL}, *const half[2] = {disc, NULL};
    GIVES(cps_set_retain(NULL) == NULL);
    RUNS(cps_set_release(NULL));
    GIVES(cps_set_space(NULL) == 0);
    GIVES(cps_set_text(NULL, NULL, 0) == 0 && cps_set_text(disc, NULL, 0) > 0);
    for (i = 0; i < ABSENCES; ++i) {
        n = ABSENT[i] == 99 ? 0 : ABSENT[i];
        REFUSED(cps_set_point(n, ONE, &set, &err));
        REFUSED(cps_set_ball(n, NULL, 1, &set, &err));
        REFUSED(cps_set_ellipsoid(n, NULL, ONE, &set, &err));
        REFUSED(cps_set_box(n, ZERO, ONE, &set, &err));
        REFUSED(cps_set_half_space(n, ONE, 1, &set, &err));
        REFUSED(cps_set_strip(n, ONE, 0, 1, &set, &err));
        REFUSED(cps_set_hull_of_points(n, 1, ONE, &set, &err));
        REFUSED(cps_set_hull_of_points(2, n, ONE, &set, &err));
        REFUSED(cps_set_inequalities(n, 1, ONE, ONE, &set, &err));
        REFUSED(cps_set_inequalities(2, n == 0 ? -1 : n, ONE, ONE, &set, &err));
        REFUSED(cps_set_subspace(n, 1, ONE, &set, &err));
        REFUSED(cps_set_subspace(2, n == 0 ? -1 : n, ONE, &set, &err));
        REFUSED(cps_set_cone_of_rays(n, 1, ONE, &set, &err));
        REFUSED(cps_set_cone_of_rays(2, n == 0 ? -1 : n, ONE, &set, &err));
        REFUSED(cps_set_friction_cone(n, 1, &set, &err));
        REFUSED(cps_set_segment(n, ZERO, ONE, &set, &err));
        REFUSED(cps_set_product(n, half, &set, &err));
        REFUSED(cps_set_intersection(n, half, &set, &err));
        REFUSED(cps_set_sum(n, half, &set, &err));
        REFUSED(cps_set_hull(n, half, &set, &err));
        REFUSED(cps_set_preimage(n, ONE, NULL, disc, &set, &err));
        REFUSED(cps_set_image(n, ONE, disc, &set, &err));
    }
    REFUSED(cps_set_point(2, NULL, &set, &err));
    REFUSED(cps_set_point(2, ONE, NULL, &err));
    REFUSED(cps_set_ball(2, NULL, 1, NULL, &err));
    REFUSED(cps_set_ellipsoid(2, NULL, NULL, &set, &err));
    REFUSED(cps_set_ellipsoid(2, NULL, ONE, NULL, &err));
    REFUSED(cps_set_interval(0, 1, NULL, &err));
    REFUSED(cps_set_box(2, NULL, ONE, &set, &err));
    REFUSED(cps_set_box(2, ZERO, NULL, &set, &err));
    REFUSED(cps_set_box(2, ZERO, ONE, NULL, &err));
    REFUSED(cps_set_half_space(2, NULL, 1, &set, &err));
    REFUSED(cps_set_half_space(2, ONE, 1, NULL, &err));
    REFUSED(cps_set_strip(2, NULL, 0, 1, &set, &err));
    REFUSED(cps_set_strip(2, ONE, 0, 1, NULL, &err));
    REFUSED(cps_set_hull_of_points(2, 1, NULL, &set, &err));
    REFUSED(cps_set_hull_of_points(2, 1, ONE, NULL, &err));
    REFUSED(cps_set_inequalities(2, 1, NULL, ONE, &set, &err));
    REFUSED(cps_set_inequalities(2, 1, ONE, NULL, &set, &err));
    REFUSED(cps_set_inequalities(2, 1, ONE, ONE, NULL, &err));
    REFUSED(cps_set_subspace(2, 1, NULL, &set, &err));
    REFUSED(cps_set_subspace(2, 1, ONE, NULL, &err));
    REFUSED(cps_set_cone_of_rays(2, 1, NULL, &set, &err));
    REFUSED(cps_set_cone_of_rays(2, 1, ONE, NULL, &err));
    REFUSED(cps_set_friction_cone(2, 1, NULL, &err));
    REFUSED(cps_set_segment(2, NULL, ONE, &set, &err));
    REFUSED(cps_set_segment(2, ZERO, NULL, &set, &err));
    REFUSED(cps_set_segment(2, ZERO, ONE, NULL, &err));
    REFUSED(cps_set_user(2, NULL, NULL, &set, &err));
    REFUSED(cps_set_product(2, NULL, &set, &err));
    REFUSED(cps_set_product(2, none, &set, &err));
    REFUSED(cps_set_product(2, half, &set, &err));
    REFUSED(cps_set_product(1, half, NULL, &err));
    REFUSED(cps_set_intersection(2, NULL, &set, &err));
    REFUSED(cps_set_intersection(2, half, &set, &err));
    REFUSED(cps_set_intersection(1, half, NULL, &err));
    REFUSED(cps_set_sum(2, NULL, &set, &err));
    REFUSED(cps_set_sum(2, half, &set, &err));
    REFUSED(cps_set_sum(1, half, NULL, &err));
    REFUSED(cps_set_hull(2, NULL, &set, &err));
    REFUSED(cps_set_hull(2, half, &set, &err));
    REFUSED(cps_set_hull(1, half, NULL, &err));
    REFUSED(cps_set_preimage(2, NULL, NULL, disc, &set, &err));
    REFUSED(cps_set_preimage(2, ONE, NULL, NULL, &set, &err));
    REFUSED(cps_set_preimage(2, ONE, NULL, disc, NULL, &err));
    REFUSED(cps_set_image(2, NULL, disc, &set, &err));
    REFUSED(cps_set_image(2, ONE, NULL, &set, &err));
    REFUSED(cps_set_image(2, ONE, disc, NULL, &err));
    REFUSED(cps_set_translate(NULL, disc, &set, &err));
    REFUSED(cps_set_translate(ONE, NULL, &set, &err));
    REFUSED(cps_set_translate(ONE, disc, NULL, &err));
    REFUSED(cps_set_scale(2, NULL, &set, &err));
    REFUSED(cps_set_scale(2, disc, NULL, &err));
    REFUSED(cps_set_polar(NULL, &set, &err));
    REFUSED(cps_set_polar(disc, NULL, &err));
}

static void questions_to_sets(void **state) {
    (void)state;
    CpsSetExtent extent;
    CpsSetFacts facts;
    CpsSetMeasure measure;
    CpsSetConic conic;
    REFUSED(cps_set_support(NULL, ONE, number, &answer, &err));
    REFUSED(cps_set_support(disc, NULL, number, &answer, &err));
    REFUSED(cps_set_support(disc, ONE, number, NULL, &err));
    REFUSED(cps_set_extent(NULL, ONE, &extent, &err));
    REFUSED(cps_set_extent(disc, NULL, &extent, &err));
    REFUSED(cps_set_extent(disc, ONE, NULL, &err));
    REFUSED(cps_set_contains(NULL, ONE, NULL, &answer, &err));
    REFUSED(cps_set_contains(disc, NULL, NULL, &answer, &err));
    REFUSED(cps_set_contains(disc, ONE, NULL, NULL, &err));
    REFUSED(cps_set_project(NULL, ONE, NULL, number, &answer, &err));
    REFUSED(cps_set_project(disc, NULL, NULL, number, &answer, &err));
    REFUSED(cps_set_project(disc, ONE, NULL, NULL, &answer, &err));
    REFUSED(cps_set_project(disc, ONE, NULL, number, NULL, &err));
    REFUSED(cps_set_gauge(NULL, ONE, &answer, &err));
    REFUSED(cps_set_gauge(disc, NULL, &answer, &err));
    REFUSED(cps_set_gauge(disc, ONE, NULL, &err));
    REFUSED(cps_set_face(NULL, ONE, 0, &set, &answer, &err));
    REFUSED(cps_set_face(disc, NULL, 0, &set, &answer, &err));
    REFUSED(cps_set_face(disc, ONE, 0, NULL, &answer, &err));
    REFUSED(cps_set_face(disc, ONE, 0, &set, NULL, &err));
    REFUSED(cps_set_face(disc, ONE, -1, &set, &answer, &err));
    REFUSED(cps_set_face(disc, ONE, NAN, &set, &answer, &err));
    REFUSED(cps_set_normal_cone(NULL, ONE, 0, &set, &answer, &err));
    REFUSED(cps_set_normal_cone(disc, NULL, 0, &set, &answer, &err));
    REFUSED(cps_set_normal_cone(disc, ONE, 0, NULL, &answer, &err));
    REFUSED(cps_set_normal_cone(disc, ONE, 0, &set, NULL, &err));
    REFUSED(cps_set_normal_cone(disc, ONE, NAN, &set, &answer, &err));
    REFUSED(cps_set_facts(NULL, 0, &facts, NULL, NULL, &err));
    REFUSED(cps_set_facts(disc, 0, NULL, NULL, NULL, &err));
    REFUSED(cps_set_facts(disc, NAN, &facts, NULL, NULL, &err));
    REFUSED(cps_set_vertices(NULL, 0, 4, number, &count, &answer, &err));
    REFUSED(cps_set_vertices(disc, 0, 4, NULL, &count, &answer, &err));
    REFUSED(cps_set_vertices(disc, 0, -1, number, &count, &answer, &err));
    REFUSED(cps_set_vertices(disc, 0, 4, number, NULL, &answer, &err));
    REFUSED(cps_set_vertices(disc, 0, 4, number, &count, NULL, &err));
    REFUSED(cps_set_rays(NULL, 0, 4, number, &count, &answer, &err));
    REFUSED(cps_set_rays(disc, 0, 4, NULL, &count, &answer, &err));
    REFUSED(cps_set_rays(disc, 0, -1, number, &count, &answer, &err));
    REFUSED(cps_set_rays(disc, 0, 4, number, NULL, &answer, &err));
    REFUSED(cps_set_rays(disc, 0, 4, number, &count, NULL, &err));
    REFUSED(cps_set_measure(NULL, &measure, &err));
    REFUSED(cps_set_measure(disc, NULL, &err));
    REFUSED(cps_set_conic(NULL, &conic, &err));
    REFUSED(cps_set_conic(disc, NULL, &err));
    RUNS(cps_set_conic_clear(NULL));
}

static void laws(void **state) {
    (void)state;
    const CpsLaw *const half[2] = {law, NULL};
    const double *const maps[2] = {ONE, NULL};
    CpsLoadedLaw *loaded = NULL;
    CpsSetResidual residual;
    REFUSED(cps_law_friction(NULL, &made, &err));
    REFUSED(cps_law_friction(disc, NULL, &err));
    REFUSED(cps_law_coulomb(1, 1, NULL, &err));
    REFUSED(cps_law_unit_load(NULL, 1, &made, &err));
    REFUSED(cps_law_unit_load(disc, 1, NULL, &err));
    REFUSED(cps_law_product(2, NULL, &made, &err));
    REFUSED(cps_law_product(2, half, &made, &err));
    REFUSED(cps_law_product(1, half, NULL, &err));
    for (i = 0; i < ABSENCES; ++i) {
        n = ABSENT[i] == 99 ? 0 : ABSENT[i];
        REFUSED(cps_law_product(n, half, &made, &err));
        REFUSED(cps_law_preimage(n, ONE, law, NULL, &made, &err));
        REFUSED(cps_law_contacts(n, 1, half, maps, &made, &err));
        REFUSED(cps_law_contacts(2, n, half, maps, &made, &err));
        REFUSED(cps_resistance_viscous(n, ONE, &resistance, &err));
        REFUSED(cps_resistance_table(law, n, ZERO, ONE, &resistance, &err));
        REFUSED(cps_resistance_sum(n, (const CpsResistance *const[]){viscous}, &resistance, &err));
    }
    REFUSED(cps_law_preimage(2, NULL, law, NULL, &made, &err));
    REFUSED(cps_law_preimage(2, ONE, NULL, NULL, &made, &err));
    REFUSED(cps_law_preimage(2, ONE, law, NULL, NULL, &err));
    REFUSED(cps_law_contacts(2, 1, NULL, maps, &made, &err));
    REFUSED(cps_law_contacts(2, 1, half, NULL, &made, &err));
    REFUSED(cps_law_contacts(2, 2, half, maps, &made, &err));
    REFUSED(cps_law_contacts(2, 1, half, maps, NULL, &err));
    RUNS(cps_law_release(NULL));
    GIVES(cps_law_space(NULL) == 0);
    GIVES(cps_law_set(NULL) == NULL);
    REFUSED(cps_law_load(NULL, ONE, &loaded, &err));
    REFUSED(cps_law_load(law, NULL, &loaded, &err));
    REFUSED(cps_law_load(law, ONE, NULL, &err));
    RUNS(cps_loaded_law_release(NULL));
    GIVES(cps_loaded_law_space(NULL) == 0);
    GIVES(cps_loaded_law_set(NULL) == NULL);
    GIVES(cps_loaded_law_load(NULL) == NULL);
    REFUSED(cps_set_dissipation(NULL, ONE, NULL, &answer, &err));
    REFUSED(cps_set_dissipation(disc, NULL, NULL, &answer, &err));
    REFUSED(cps_set_dissipation(disc, ONE, NULL, NULL, &err));
    REFUSED(cps_set_forces(NULL, ONE, 0, &set, &answer, &err));
    REFUSED(cps_set_forces(disc, NULL, 0, &set, &answer, &err));
    REFUSED(cps_set_forces(disc, ONE, 0, NULL, &answer, &err));
    REFUSED(cps_set_forces(disc, ONE, 0, &set, NULL, &err));
    REFUSED(cps_set_velocities(NULL, ONE, 0, &set, &answer, &err));
    REFUSED(cps_set_velocities(disc, NULL, 0, &set, &answer, &err));
    REFUSED(cps_set_velocities(disc, ONE, 0, NULL, &answer, &err));
    REFUSED(cps_set_velocities(disc, ONE, 0, &set, NULL, &err));
    REFUSED(cps_set_residual(NULL, ONE, ONE, 0, &residual, &err));
    REFUSED(cps_set_residual(disc, NULL, ONE, 0, &residual, &err));
    REFUSED(cps_set_residual(disc, ONE, NULL, 0, &residual, &err));
    REFUSED(cps_set_residual(disc, ONE, ONE, 0, NULL, &err));
    REFUSED(cps_set_residual(disc, ONE, ONE, NAN, &residual, &err));
}

static void resistances(void **state) {
    (void)state;
    CpsResistanceValue value;
    const CpsResistance *const half[2] = {viscous, NULL};
    double gap, distance;
    REFUSED(cps_resistance_dry(NULL, &resistance, &err));
    REFUSED(cps_resistance_dry(law, NULL, &err));
    REFUSED(cps_resistance_viscous(2, NULL, &resistance, &err));
    REFUSED(cps_resistance_viscous(1, ONE, NULL, &err));
    REFUSED(cps_resistance_power(NULL, 2, 1, &resistance, &err));
    REFUSED(cps_resistance_power(law, 2, 1, NULL, &err));
    REFUSED(cps_resistance_power(law, NAN, 1, &resistance, &err));
    REFUSED(cps_resistance_table(NULL, 1, ZERO, ONE, &resistance, &err));
    REFUSED(cps_resistance_table(law, 1, NULL, ONE, &resistance, &err));
    REFUSED(cps_resistance_table(law, 1, ZERO, NULL, &resistance, &err));
    REFUSED(cps_resistance_table(law, 1, ZERO, ONE, NULL, &err));
    REFUSED(cps_resistance_function(law, NULL, NULL, NULL, &resistance, &err));
    REFUSED(cps_resistance_sum(2, NULL, &resistance, &err));
    REFUSED(cps_resistance_sum(2, half, &resistance, &err));
    REFUSED(cps_resistance_sum(1, half, NULL, &err));
    RUNS(cps_resistance_release(NULL));
    GIVES(cps_resistance_space(NULL) == 0 && cps_resistance_term_count(NULL) == 0 &&
          !cps_resistance_is_dry(NULL));
    REFUSED(cps_resistance_value(NULL, ONE, &value, NULL, &err));
    REFUSED(cps_resistance_value(viscous, NULL, &value, NULL, &err));
    REFUSED(cps_resistance_value(viscous, ONE, NULL, NULL, &err));
    REFUSED(cps_resistance_forces(NULL, ONE, 0, &set, &answer, &err));
    REFUSED(cps_resistance_forces(viscous, NULL, 0, &set, &answer, &err));
    REFUSED(cps_resistance_forces(viscous, ONE, 0, NULL, &answer, &err));
    REFUSED(cps_resistance_forces(viscous, ONE, 0, &set, NULL, &err));
    REFUSED(cps_resistance_conjugate(NULL, ONE, NULL, &answer, &err));
    REFUSED(cps_resistance_conjugate(viscous, NULL, NULL, &answer, &err));
    REFUSED(cps_resistance_conjugate(viscous, ONE, NULL, NULL, &err));
    REFUSED(cps_resistance_velocities(NULL, ONE, &set, &answer, &err));
    REFUSED(cps_resistance_velocities(viscous, NULL, &set, &answer, &err));
    REFUSED(cps_resistance_velocities(viscous, ONE, NULL, &answer, &err));
    REFUSED(cps_resistance_velocities(viscous, ONE, &set, NULL, &err));
    REFUSED(cps_resistance_residual(NULL, ONE, ONE, &gap, &distance, &err));
    REFUSED(cps_resistance_residual(viscous, NULL, ONE, &gap, &distance, &err));
    REFUSED(cps_resistance_residual(viscous, ONE, NULL, &gap, &distance, &err));
    REFUSED(cps_resistance_residual(viscous, ONE, ONE, NULL, &distance, &err));
    REFUSED(cps_resistance_residual(viscous, ONE, ONE, &gap, NULL, &err));
}

static void systems(void **state) {
    (void)state;
    CpsSystem *system = NULL, *other = NULL;
    CpsMotion *motion = NULL;
    CpsPathStep step[2];
    const CpsEntry first = {0, 0, 1}, map[2] = {{0, 0, 1}, {1, 1, 1}};
    SOUND(cps_system_create(2, &system, &err));
    SOUND(cps_system_add_friction(system, NULL, law, 2, map, &err));
    SOUND(cps_system_set_drive(system, 1, 1, &first, &err));
    REFUSED(cps_system_create(2, NULL, &err));
    RUNS(cps_system_destroy(NULL));
    GIVES(cps_system_parameter_count(NULL) == 0 && cps_system_law_count(NULL) == 0 &&
          cps_system_drive_space(NULL) == 0);
    REFUSED(cps_system_add_friction(NULL, NULL, law, 2, map, &err));
    REFUSED(cps_system_add_friction(system, NULL, NULL, 2, map, &err));
    REFUSED(cps_system_add_friction(system, NULL, law, 2, NULL, &err));
    REFUSED(cps_system_add_resistance(NULL, NULL, viscous, 2, map, &err));
    REFUSED(cps_system_add_resistance(system, NULL, NULL, 2, map, &err));
    REFUSED(cps_system_add_resistance(system, NULL, viscous, 2, NULL, &err));
    REFUSED(cps_system_add_constraints(NULL, 1, 1, map, &err));
    REFUSED(cps_system_add_constraints(system, 1, 1, NULL, &err));
    REFUSED(cps_system_add_subspace(NULL, 1, ONE, &err));
    REFUSED(cps_system_add_subspace(system, 1, NULL, &err));
    REFUSED(cps_system_set_drive(NULL, 1, 1, map, &err));
    REFUSED(cps_system_set_drive(system, 1, 1, NULL, &err));
    REFUSED(cps_system_set_load(NULL, ONE, &err));
    REFUSED(cps_system_set_load(system, NULL, &err));
    for (i = 0; i < ABSENCES; ++i) {
        k = ABSENT[i];
        n = k == 99 ? -99 : k;
        const CpsEntry row = {k, 0, 1}, column = {0, k, 1};
        REFUSED(cps_system_create(k == 99 ? 0 : k, &other, &err));
        GIVES(cps_system_law_name(system, k) == NULL && cps_system_law_space(system, k) == 0);
        GIVES(cps_system_law_name(NULL, k) == NULL && cps_system_law_space(NULL, k) == 0);
        REFUSED(cps_system_add_friction(system, NULL, law, 1, &row, &err));
        REFUSED(cps_system_add_friction(system, NULL, law, 1, &column, &err));
        REFUSED(cps_system_add_friction(system, NULL, law, k < 0 ? k : -1, &first, &err));
        REFUSED(cps_system_add_resistance(system, NULL, viscous, 1, &row, &err));
        REFUSED(cps_system_add_resistance(system, NULL, viscous, 1, &column, &err));
        REFUSED(cps_system_add_constraints(system, 1, 1, &row, &err));
        REFUSED(cps_system_add_constraints(system, 1, 1, &column, &err));
        REFUSED(cps_system_add_constraints(system, n, 1, &first, &err));
        REFUSED(cps_system_set_drive(system, 1, 1, &row, &err));
        REFUSED(cps_system_set_drive(system, 1, 1, &column, &err));
        REFUSED(cps_system_set_drive(system, n, 1, &first, &err));
    }
    GIVES(cps_system_law_count(system) == 1 && cps_system_drive_space(system) == 1);
    REFUSED(cps_system_eliminate(NULL, &made, NULL, NULL, &err));
    REFUSED(cps_system_solve(NULL, ONE, NULL, &motion, &err));
    REFUSED(cps_system_solve(system, NULL, NULL, &motion, &err));
    REFUSED(cps_system_solve(system, ONE, NULL, NULL, &err));
    REFUSED(cps_system_drive_path(NULL, 1, ONE, ONE, NULL, step, NULL, &count, &err));
    REFUSED(cps_system_drive_path(system, 0, ONE, ONE, NULL, step, NULL, &count, &err));
    REFUSED(cps_system_drive_path(system, -1, ONE, ONE, NULL, step, NULL, &count, &err));
    REFUSED(cps_system_drive_path(system, 1, NULL, ONE, NULL, step, NULL, &count, &err));
    REFUSED(cps_system_drive_path(system, 1, ONE, NULL, NULL, step, NULL, &count, &err));
    REFUSED(cps_system_drive_path(system, 1, ONE, ONE, NULL, NULL, NULL, &count, &err));
    REFUSED(cps_system_drive_path(system, 1, ONE, ONE, NULL, step, NULL, NULL, &err));
    cps_system_destroy(system);
}

static void motions(void **state) {
    (void)state;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    CpsSolutionSet all;
    bool known, holds;
    const CpsEntry map[2] = {{0, 0, 1}, {1, 1, 1}};
    SOUND(cps_system_create(2, &system, &err));
    SOUND(cps_system_add_friction(system, NULL, law, 2, map, &err));
    SOUND(cps_system_set_drive(system, 1, 1, map, &err));
    SOUND(cps_system_solve(system, ONE, NULL, &motion, &err));
    for (i = 0; i < ABSENCES; ++i) {
        k = ABSENT[i];
        GIVES(cps_motion_law_velocity(motion, k) == NULL &&
              cps_motion_law_force(motion, k) == NULL &&
              cps_motion_law_share(motion, k).potential == 0);
        GIVES(cps_motion_law_velocity(NULL, k) == NULL && cps_motion_law_force(NULL, k) == NULL &&
              cps_motion_law_share(NULL, k).potential == 0);
    }
    RUNS(cps_motion_destroy(NULL));
    GIVES(cps_motion_report(NULL).outcome == CPS_MOTION_OUTCOME_INACCURATE &&
          cps_motion_velocity(NULL) == NULL && cps_motion_direction(NULL) == NULL);
    GIVES(cps_motion_resistance(NULL) == NULL && cps_motion_constraint_forces(NULL) == NULL &&
          cps_motion_constraint_count(NULL) == 0);
    REFUSED(cps_motion_continuous(NULL, &known, &holds, &err));
    REFUSED(cps_motion_continuous(motion, NULL, &holds, &err));
    REFUSED(cps_motion_continuous(motion, &known, NULL, &err));
    REFUSED(cps_motion_velocities(NULL, 0, &all, NULL, NULL, &err));
    REFUSED(cps_motion_velocities(motion, 0, NULL, NULL, NULL, &err));
    REFUSED(cps_motion_velocities(motion, NAN, &all, NULL, NULL, &err));
    REFUSED(cps_motion_forces(NULL, 0, &all, NULL, NULL, &err));
    REFUSED(cps_motion_forces(motion, 0, NULL, NULL, NULL, &err));
    REFUSED(cps_motion_resistances(NULL, 0, &all, NULL, NULL, &err));
    REFUSED(cps_motion_resistances(motion, 0, NULL, NULL, NULL, &err));
    RUNS(cps_solution_set_clear(NULL));
    cps_motion_destroy(motion);
    cps_system_destroy(system);
}

static void bodies(void **state) {
    (void)state;
    const CpsPatch patch[2] = {{.cookie = cps_patch_default().cookie,
                                .kind = CPS_PATCH_DISC,
                                .friction = 0.5,
                                .load = 1,
                                .size = 1},
                               {.cookie = cps_patch_default().cookie,
                                .kind = CPS_PATCH_WHEEL,
                                .friction = 0.5,
                                .load = 1,
                                .size = 1}};
    CpsPatch bad = patch[0];
    CpsPlanar *body = NULL, *other = NULL;
    CpsSystem *system = NULL;
    CpsPlanarBounds bounds;
    CpsPlanarMotion motion;
    CpsWheelMotion wheel;
    CpsTow tow = {.cookie = cps_tow_default().cookie, .rope = 0};
    CpsTowStep step;
    SOUND(cps_planar_create(2, patch, &body, &err));
    REFUSED(cps_planar_create(0, patch, &other, &err));
    REFUSED(cps_planar_create(-1, patch, &other, &err));
    REFUSED(cps_planar_create(1, NULL, &other, &err));
    REFUSED(cps_planar_create(1, patch, NULL, &err));
    bad.kind = (CpsPatchKind)NEVER;
    REFUSED(cps_planar_create(1, &bad, &other, &err));
    bad = (CpsPatch){.cookie = cps_patch_default().cookie,
                     .kind = CPS_PATCH_POLYGON,
                     .friction = 1,
                     .load = 1,
                     .corner_count = 3};
    REFUSED(cps_planar_create(1, &bad, &other, &err));
    RUNS(cps_planar_destroy(NULL));
    GIVES(cps_planar_patch_count(NULL) == 0);
    REFUSED(cps_planar_dissipation(NULL, ONE, NULL, NULL, &answer, &err));
    REFUSED(cps_planar_dissipation(body, NULL, NULL, NULL, &answer, &err));
    REFUSED(cps_planar_dissipation(body, ONE, NULL, NULL, NULL, &err));
    REFUSED(cps_planar_bounds(NULL, ONE, 0, &bounds, &err));
    REFUSED(cps_planar_bounds(body, NULL, 0, &bounds, &err));
    REFUSED(cps_planar_bounds(body, ONE, 0, NULL, &err));
    REFUSED(cps_planar_bounds(body, ONE, NAN, &bounds, &err));
    REFUSED(cps_planar_law(NULL, CPS_PLANAR_INNER, 4, &made, &err));
    REFUSED(cps_planar_law(body, CPS_PLANAR_INNER, 4, NULL, &err));
    REFUSED(cps_planar_law(body, (CpsPlanarSide)NEVER, 4, &made, &err));
    REFUSED(cps_planar_system(NULL, CPS_PLANAR_INNER, 4, &system, &err));
    REFUSED(cps_planar_system(body, CPS_PLANAR_INNER, 4, NULL, &err));
    REFUSED(cps_planar_system(body, (CpsPlanarSide)NEVER, 4, &system, &err));
    for (i = 0; i < ABSENCES; ++i) {
        k = ABSENT[i];
        n = k == 99 ? 0 : k;
        REFUSED(cps_planar_law(body, CPS_PLANAR_INNER, n, &made, &err));
        REFUSED(cps_planar_system(body, CPS_PLANAR_INNER, n, &system, &err));
        REFUSED(cps_planar_wheel(body, k, ONE, &wheel, &err));
        REFUSED(cps_planar_drive(body, n, ONE, ONE, &motion, &err));
        REFUSED(cps_planar_motions(body, n, ONE, ONE, 0, number, number + 3, &err));
    }
    REFUSED(cps_planar_wheel(body, 0, ONE, &wheel, &err)); /* a disc */
    REFUSED(cps_planar_wheel(NULL, 1, ONE, &wheel, &err));
    REFUSED(cps_planar_wheel(body, 1, NULL, &wheel, &err));
    REFUSED(cps_planar_wheel(body, 1, ONE, NULL, &err));
    REFUSED(cps_planar_drive(NULL, 1, ONE, ONE, &motion, &err));
    REFUSED(cps_planar_drive(body, 1, NULL, ONE, &motion, &err));
    REFUSED(cps_planar_drive(body, 1, ONE, NULL, &motion, &err));
    REFUSED(cps_planar_drive(body, 1, ONE, ONE, NULL, &err));
    REFUSED(cps_planar_motions(NULL, 1, ONE, ONE, 0, number, number + 3, &err));
    REFUSED(cps_planar_motions(body, 1, NULL, ONE, 0, number, number + 3, &err));
    REFUSED(cps_planar_motions(body, 1, ONE, NULL, 0, number, number + 3, &err));
    REFUSED(cps_planar_motions(body, 1, ONE, ONE, 0, NULL, number + 3, &err));
    REFUSED(cps_planar_motions(body, 1, ONE, ONE, 0, number, NULL, &err));
    RUNS(cps_planar_move(NULL, ONE));
    RUNS(cps_planar_move(number, NULL));
    REFUSED(cps_planar_tow(NULL, &tow, ONE, &step, &err));
    REFUSED(cps_planar_tow(body, NULL, ONE, &step, &err));
    REFUSED(cps_planar_tow(body, &tow, NULL, &step, &err));
    REFUSED(cps_planar_tow(body, &tow, ONE, NULL, &err));
    cps_planar_destroy(body);
}

static void ropes_and_sweeps(void **state) {
    (void)state;
    CpsSystem *system = NULL;
    CpsRope rope = {.cookie = cps_rope_default().cookie, .node_count = 2};
    CpsSweep sweep = {.cookie = cps_sweep_default().cookie, .stiffness = 1};
    CpsSweepStep step;
    const CpsPlanimeter meter = {.cookie = cps_planimeter_default().cookie,
                                 .pole_arm = 1,
                                 .tracer_arm = 1,
                                 .wheel = 0.5,
                                 .friction = 0.1,
                                 .load = 1};
    const double triangle[6] = {1, 0, 1.1, 0, 1, 0.1};
    CpsPlanimeterReading reading;
    REFUSED(cps_rope_check(NULL, &err));
    REFUSED(cps_patch_check(NULL, &err));
    REFUSED(cps_rope_system(NULL, &system, &err));
    REFUSED(cps_rope_system(&rope, &system, &err)); /* without nodes */
    REFUSED(cps_rope_system(&rope, NULL, &err));
    REFUSED(cps_sweep_step(NULL, &sweep, ONE, &step, &err));
    REFUSED(cps_sweep_step(law, NULL, ONE, &step, &err));
    REFUSED(cps_sweep_step(law, &sweep, NULL, &step, &err));
    REFUSED(cps_sweep_step(law, &sweep, ONE, NULL, &err));
    REFUSED(cps_planimeter_trace(NULL, 3, triangle, 1, &reading, &err));
    REFUSED(cps_planimeter_trace(&meter, 3, NULL, 1, &reading, &err));
    REFUSED(cps_planimeter_check(NULL, 3, triangle, &err));
    REFUSED(cps_planimeter_check(&meter, 3, NULL, &err));
    REFUSED(cps_planimeter_check(&meter, -1, triangle, &err));
    REFUSED(cps_planimeter_trace(&meter, 3, triangle, 1, NULL, &err));
    for (i = 0; i < ABSENCES; ++i) {
        n = ABSENT[i] == 99 || ABSENT[i] == INT_MAX ? 0 : ABSENT[i];
        REFUSED(cps_planimeter_trace(&meter, n, triangle, 1, &reading, &err));
        REFUSED(cps_planimeter_trace(&meter, 3, triangle, n, &reading, &err));
    }
}

static void studies(void **state) {
    (void)state;
    CpsRegularized *regularized = NULL;
    CpsStudy *study = NULL;
    CpsFirstOrder *first_order = NULL;
    CpsRegularizedParameters parameters = {0};
    CpsStudyOptions options = {0};
    CpsRegularizedReport report;
    CpsJudgementReport judged;
    CpsSlackPart part[2];
    const CpsLineView nothing = {
        0}; /* as cps_evolution_line_view gives of a line that there is not */
    const CpsLineView *const view[] = {NULL, &nothing};
    for (i = 0; i < 2; ++i) {
        REFUSED(cps_regularized_create(view[i], &regularized, &err));
        REFUSED(cps_regularized_next(view[i], 0.5, NULL, &regularized, &err));
        REFUSED(cps_solution_judge(view[i], ONE, 1e-8, &judged, &err));
        GIVES(cps_solution_slack(view[i], 2, part) == 0);
        REFUSED(cps_solution_complete(view[i], CPS_COMPLETION_MEANDER, number, NULL, &err));
    }
    RUNS(cps_regularized_destroy(NULL));
    GIVES(cps_regularized_step(NULL).element_count == 0 &&
          cps_regularized_step(NULL).position == NULL);
    GIVES(cps_regularized_coarse(NULL).penalty == 0 && cps_regularized_fine(NULL).penalty == 0);
    REFUSED(cps_regularized_solve(NULL, &parameters, 10, &report, &err));
    GIVES(cps_regularized_view(NULL).cell_count == 0 &&
          cps_regularized_view(NULL).position == NULL);
    for (i = 0; i < ABSENCES; ++i) {
        GIVES(cps_study_row(NULL, ABSENT[i]).parameters.penalty == 0);
        GIVES(cps_study_stage_end(NULL, (CpsStudyStage)ABSENT[i]).cell_count == 0);
    }
    GIVES(cps_study_options_default(NULL).max_iterations == 0);
    GIVES(cps_study_options_to(NULL, NULL).max_iterations == 0);
    REFUSED(cps_study_run(NULL, &options, NULL, NULL, &study, &err));
    RUNS(cps_study_destroy(NULL));
    GIVES(cps_study_row_count(NULL) == 0);
    REFUSED(cps_first_order_solve(NULL, CPS_FIRST_ORDER_CONTACT_REFERENCE, &first_order, &err));
    RUNS(cps_first_order_destroy(NULL));
    GIVES(cps_first_order_report(NULL).outcome == CPS_FIRST_ORDER_OUTCOME_UNDECIDED);
    GIVES(cps_first_order_view(NULL).element_count == 0 &&
          cps_first_order_view(NULL).strain == NULL);
    REFUSED(cps_scene_check(NULL, &err));
}

/* What a caller fills is refused without the cookie of its default, with the name of that. */
#define WITHOUT_COOKIE(thing, call)                       \
    do {                                                  \
        (thing).cookie = 0;                               \
        REFUSED(call);                                    \
        GIVES(strstr(err.message, "_default()") != NULL); \
    } while (0)

static void without_cookies(void **state) {
    (void)state;
    const double node[4] = {0, 0, 1, 0}, triangle[6] = {1, 0, 1.1, 0, 1, 0.1};
    CpsPatch patch = cps_patch_default();
    CpsTow tow = cps_tow_default();
    CpsSweep sweep = cps_sweep_default();
    CpsPlanimeter meter = cps_planimeter_default();
    CpsRope rope = cps_rope_default();
    CpsMotionOptions options = cps_motion_options_default();
    CpsPlanar *body = NULL, *other = NULL;
    CpsSystem *system = NULL, *roped = NULL;
    CpsMotion *motion = NULL;
    CpsTowStep towed;
    CpsSweepStep swept;
    CpsPlanimeterReading reading;
    patch.friction = patch.load = 1;
    sweep.stiffness = 1;
    meter.pole_arm = meter.tracer_arm = meter.friction = meter.load = 1;
    rope.node_count = 2;
    rope.node = node;
    SOUND(cps_planar_create(1, &patch, &body, &err));
    SOUND(cps_patch_check(&patch, &err));
    SOUND(cps_planar_tow(body, &tow, ZERO, &towed, &err));
    SOUND(cps_sweep_step(law, &sweep, ONE, &swept, &err));
    SOUND(cps_planimeter_check(&meter, 3, triangle, &err));
    SOUND(cps_rope_check(&rope, &err));
    SOUND(cps_system_create(2, &system, &err));
    WITHOUT_COOKIE(patch, cps_planar_create(1, &patch, &other, &err));
    REFUSED(cps_patch_check(&patch, &err));
    WITHOUT_COOKIE(tow, cps_planar_tow(body, &tow, ZERO, &towed, &err));
    WITHOUT_COOKIE(sweep, cps_sweep_step(law, &sweep, ONE, &swept, &err));
    WITHOUT_COOKIE(meter, cps_planimeter_trace(&meter, 3, triangle, 1, &reading, &err));
    REFUSED(cps_planimeter_check(&meter, 3, triangle, &err));
    WITHOUT_COOKIE(rope, cps_rope_system(&rope, &roped, &err));
    REFUSED(cps_rope_check(&rope, &err));
    WITHOUT_COOKIE(options, cps_system_solve(system, NULL, &options, &motion, &err));
    cps_system_destroy(system);
    cps_planar_destroy(body);
}

static void clear(void **state) {
    (void)state;
    cps_set_release(disc);
    cps_law_release(law);
    cps_resistance_release(viscous);
    all_were_refused();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(make),    cmocka_unit_test(names_of_nothing),
        cmocka_unit_test(sets),    cmocka_unit_test(questions_to_sets),
        cmocka_unit_test(laws),    cmocka_unit_test(resistances),
        cmocka_unit_test(systems), cmocka_unit_test(motions),
        cmocka_unit_test(bodies),  cmocka_unit_test(ropes_and_sweeps),
        cmocka_unit_test(studies), cmocka_unit_test(without_cookies),
        cmocka_unit_test(clear),
    };
    return cmocka_run_group_tests_name("misuse", tests, NULL, NULL);
}
