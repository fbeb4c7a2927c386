/* SPDX-License-Identifier: BSD-3-Clause */
/* Every public function of the library that takes a number with a range is called with numbers
 * outside of it, with infinite ones and with none: it refuses with a status and a sentence. Counts
 * beyond what is promised are refused as well. */
#include <math.h>
#include <string.h>

#include "capstan/evolve.h"
#include "capstan/planar.h"
#include "capstan/regularized.h"
#include "misuse.h"
#include "straight_rope.h"

static const double ZERO[9] = {0}, ONE[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
/* No friction, load, radius or tolerance; the first three are no lengths of a vector either. */
static const double NONE[] = {NAN, INFINITY, -INFINITY, -1};
enum { NOT_FINITE = 3, NONES = sizeof NONE / sizeof *NONE };

static CpsError err;
static CpsSet *disc, *set;
static CpsLaw *law, *made;
static CpsResistance *viscous, *resistance;
static CpsSetAnswer answer;
static double number[64], bad;
static int count;
static volatile int i, k, most; /* of loops, which a crash must not disturb */

static void make(void **state) {
    (void)state;
    SOUND(cps_set_ball(2, NULL, 1, &disc, &err));
    SOUND(cps_law_friction(disc, &law, &err));
    SOUND(cps_resistance_viscous(2, (double[]){1, 0, 0, 1}, &viscous, &err));
}

static void sets(void **state) {
    (void)state;
    double x[9];
    for (i = 0; i < NONES; ++i) {
        bad = NONE[i];
        REFUSED(cps_set_ball(2, NULL, bad, &set, &err));
        REFUSED(cps_set_friction_cone(2, bad, &set, &err));
        REFUSED(cps_set_vertices(disc, bad, 4, number, &count, &answer, &err));
        REFUSED(cps_set_rays(disc, bad, 4, number, &count, &answer, &err));
        REFUSED(cps_set_normal_cone(disc, ONE, bad, &set, &answer, &err));
    }
    REFUSED(cps_set_vertices(disc, 0.6, 4, number, &count, &answer, &err));
    REFUSED(cps_set_rays(disc, 0.6, 4, number, &count, &answer, &err));
    for (i = 0; i < NOT_FINITE; ++i) {
        bad = NONE[i];
        for (k = 0; k < 2; ++k) {
            memcpy(x, ONE, sizeof x);
            x[k] = bad;
            REFUSED(cps_set_point(2, x, &set, &err));
            REFUSED(cps_set_ball(2, x, 1, &set, &err));
            REFUSED(cps_set_half_space(2, x, 1, &set, &err));
            REFUSED(cps_set_hull_of_points(2, 1, x, &set, &err));
            REFUSED(cps_set_subspace(2, 1, x, &set, &err));
            REFUSED(cps_set_cone_of_rays(2, 1, x, &set, &err));
            REFUSED(cps_set_translate(x, disc, &set, &err));
            REFUSED(cps_set_support(disc, x, number, &answer, &err));
            REFUSED(cps_set_contains(disc, x, NULL, &answer, &err));
            REFUSED(cps_set_forces(disc, x, 0, &set, &answer, &err));
            REFUSED(cps_set_velocities(disc, x, 0, &set, &answer, &err));
        }
        REFUSED(cps_set_scale(bad, disc, &set, &err));
        REFUSED(cps_set_strip(2, ONE, bad, 1, &set, &err));
        REFUSED(cps_set_strip(2, ONE, 0, bad, &set, &err));
    }
    REFUSED(cps_set_strip(2, ONE, 1, 0, &set, &err));
    REFUSED(cps_set_half_space(2, ZERO, 1, &set, &err));
    REFUSED(cps_set_interval(1, 0, &set, &err));
    REFUSED(cps_set_interval(NAN, 0, &set, &err));
    REFUSED(cps_set_interval(0, NAN, &set, &err));
    REFUSED(cps_set_interval(INFINITY, INFINITY, &set, &err));
    REFUSED(cps_set_interval(-INFINITY, -INFINITY, &set, &err));
    REFUSED(cps_set_ellipsoid(2, NULL, (double[]){1, 2, 2, 1}, &set, &err));   /* not definite */
    REFUSED(cps_set_ellipsoid(2, NULL, (double[]){1, 0.5, 0, 1}, &set, &err)); /* not symmetric */
    REFUSED(cps_set_product(CPS_SET_MAX_ITEMS + 1, (const CpsSet *const *)&disc, &set, &err));
}

static void laws(void **state) {
    (void)state;
    const CpsLaw *const one[] = {law};
    double map[4];
    for (i = 0; i < NONES; ++i) {
        bad = NONE[i];
        REFUSED(cps_law_coulomb(bad, 1, &made, &err));
        REFUSED(cps_law_coulomb(1, bad, &made, &err));
        REFUSED(cps_law_unit_load(disc, bad, &made, &err));
        REFUSED(cps_set_residual(disc, ONE, ONE, bad, &(CpsSetResidual){0}, &err));
        REFUSED(cps_resistance_power(law, bad, 1, &resistance, &err));
        REFUSED(cps_resistance_power(law, 2, bad, &resistance, &err));
        REFUSED(cps_resistance_table(law, 2, (double[]){0, bad}, ONE, &resistance, &err));
        REFUSED(
            cps_resistance_table(law, 2, (double[]){0, 1}, (double[]){1, bad}, &resistance, &err));
    }
    REFUSED(cps_resistance_power(law, 1, 1, &resistance, &err));
    REFUSED(cps_resistance_power(law, 0.5, 1, &resistance, &err));
    for (i = 0; i < NOT_FINITE; ++i) {
        for (k = 0; k < 4; ++k) {
            memcpy(map, (double[]){1, 0, 0, 1}, sizeof map);
            map[k] = NONE[i];
            REFUSED(cps_law_preimage(2, map, law, NULL, &made, &err));
            REFUSED(cps_law_contacts(2, 1, one, (const double *const[]){map}, &made, &err));
            REFUSED(cps_resistance_viscous(2, map, &resistance, &err));
        }
    }
    REFUSED(cps_law_contacts(2, 1, one, (const double *const[]){NULL}, &made, &err));
    REFUSED(cps_resistance_viscous(2, (double[]){1, 0.5, 0, 1}, &resistance, &err));
    REFUSED(cps_resistance_viscous(2, (double[]){1, 2, 2, 1}, &resistance, &err));
    REFUSED(cps_resistance_function(law, NULL, NULL, NULL, &resistance, &err));
}

/* A set of the user's has no conic form. */
static bool unit_disc(void *user, int n, const double *w, double *value, double *x) {
    (void)user;
    *value = hypot(w[0], w[1]);
    for (int a = 0; a < n; a++) x[a] = *value > 0 ? w[a] / *value : 0;
    return true;
}

static void limits(void **state) {
    (void)state;
    static const CpsLaw *many_laws[CPS_SET_MAX_ITEMS + 1];
    static const CpsResistance *many[CPS_SET_MAX_ITEMS + 1];
    CpsSystem *system = NULL, *large = NULL;
    CpsSetConic conic = {0};
    CpsSet *own = NULL;
    CpsLaw *of_user = NULL;
    CpsLoadedLaw *loaded = NULL;
    const CpsEntry map[2] = {{0, 0, 1}, {1, 1, 1}};
    for (i = 0; i <= CPS_SET_MAX_ITEMS; ++i) {
        many_laws[i] = law;
        many[i] = viscous;
    }
    REFUSED(cps_law_product(CPS_SET_MAX_ITEMS + 1, many_laws, &made, &err));
    REFUSED(cps_resistance_sum(CPS_SET_MAX_ITEMS + 1, many, &resistance, &err));
    SOUND(cps_set_user(2, unit_disc, NULL, &own, &err));
    SOUND(cps_set_conic(own, &conic, &err));
    GIVES(conic.outcome == CPS_SET_OUTCOME_NOT_AVAILABLE);
    SOUND(cps_law_friction(own, &of_user, &err));
    SOUND(cps_system_create(2, &system, &err));
    REFUSED(cps_system_add_friction(system, NULL, of_user, 2, map, &err));
    SOUND(cps_system_set_drive(system, 1, 1, map, &err));
    REFUSED(cps_system_eliminate(system, &made, NULL, NULL, &err)); /* nothing resists */
    SOUND(cps_system_create(CPS_SET_MAX_SPACE + 1, &large, &err));
    REFUSED(cps_system_add_subspace(large, 0, ZERO, &err));
    SOUND(cps_law_load(law, (double[]){0.1, 0}, &loaded, &err));
    GIVES(cps_loaded_law_space(loaded) == 2);
    cps_loaded_law_release(loaded);
    cps_system_destroy(large);
    cps_system_destroy(system);
    cps_law_release(of_user);
    cps_set_release(own);
}

static void systems(void **state) {
    (void)state;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    CpsMotionOptions options;
    CpsPathStep step[2];
    const CpsEntry map[2] = {{0, 0, 1}, {1, 1, 1}};
    SOUND(cps_system_create(2, &system, &err));
    SOUND(cps_system_add_friction(system, NULL, law, 2, map, &err));
    SOUND(cps_system_set_drive(system, 1, 1, map, &err));
    for (i = 0; i < NONES; ++i) {
        options = cps_motion_options_default();
        options.tolerance = NONE[i] > 0 ? 0 : NONE[i]; /* an infinite one asks for nothing */
        REFUSED(cps_system_solve(system, ONE, &options, &motion, &err));
        options = cps_motion_options_default();
        options.boundary = NONE[i];
        REFUSED(cps_system_solve(system, ONE, &options, &motion, &err));
        REFUSED(cps_system_drive_path(system, 1, &NONE[i], ONE, NULL, step, NULL, &count, &err));
    }
    options = cps_motion_options_default();
    options.boundary = 0;
    REFUSED(cps_system_solve(system, ONE, &options, &motion, &err));
    REFUSED(cps_system_drive_path(system, 1, ZERO, ONE, NULL, step, NULL, &count, &err));
    for (i = 0; i < NOT_FINITE; ++i) {
        bad = NONE[i];
        REFUSED(cps_system_solve(system, &bad, NULL, &motion, &err));
        REFUSED(cps_system_set_load(system, (double[]){0, bad}, &err));
        REFUSED(cps_system_add_friction(system, NULL, law, 1, &(CpsEntry){0, 0, bad}, &err));
        REFUSED(cps_system_add_constraints(system, 1, 1, &(CpsEntry){0, 0, bad}, &err));
        REFUSED(cps_system_add_subspace(system, 1, (double[]){1, bad}, &err));
        REFUSED(cps_system_drive_path(system, 2, ONE + 4, (double[]){1, bad}, NULL, step, NULL,
                                      &count, &err));
    }
    cps_system_destroy(system);
}

static void bodies(void **state) {
    (void)state;
    const CpsPatch sound = {.cookie = cps_patch_default().cookie,
                            .kind = CPS_PATCH_DISC,
                            .friction = 0.5,
                            .load = 1,
                            .size = 1};
    CpsPlanar *body = NULL;
    CpsPlanarBounds bounds;
    SOUND(cps_planar_create(1, &sound, &body, &err));
    GIVES(cps_planar_patch_count(body) == 1);
    for (i = 0; i < NONES; ++i) {
        double *place[5];
        for (k = 0; k < 3; ++k) {
            CpsPatch patch = sound;
            place[0] = &patch.friction;
            place[1] = &patch.load;
            place[2] = &patch.size;
            *place[k] = NONE[i];
            REFUSED(cps_patch_check(&patch, &err));
        }
        most = i < NOT_FINITE ? 5 : 0;
        for (k = 0; k < most; ++k) {
            CpsPatch patch = sound;
            memcpy(place,
                   (double *[]){&patch.position[0], &patch.position[1], &patch.angle,
                                &patch.tilt[0], &patch.tilt[1]},
                   sizeof place);
            *place[k] = NONE[i];
            REFUSED(cps_patch_check(&patch, &err));
        }
        double corner[6] = {0, 0, 1, 0, 0, 1};
        CpsPatch polygon = sound;
        polygon.kind = CPS_PATCH_POLYGON;
        polygon.corner_count = 3;
        polygon.corner = corner;
        SOUND(cps_patch_check(&polygon, &err));
        corner[2] = i < NOT_FINITE ? NONE[i] : 0; /* or equal to its neighbour */
        REFUSED(cps_patch_check(&polygon, &err));
        REFUSED(cps_planar_bounds(body, ONE, NONE[i], &bounds, &err));
        REFUSED(cps_planar_motions(body, 1, ONE, ONE, NONE[i], number, number + 3, &err));
    }
    cps_planar_destroy(body);
}

static void ropes_and_sweeps(void **state) {
    (void)state;
    const double node[4] = {0, 0, 1, 0}, triangle[6] = {1, 0, 1.1, 0, 1, 0.1};
    CpsSweepStep step;
    for (i = 0; i < NONES; ++i) {
        CpsRope rope = cps_rope_default();
        rope.node_count = 2;
        rope.node = node;
        rope.resistance = 1;
        SOUND(cps_rope_check(&rope, &err));
        rope.resistance = NONE[i];
        REFUSED(cps_rope_check(&rope, &err));
        double other[4] = {0, 0, NONE[i], 0};
        rope.resistance = 1;
        rope.node = other;
        if (i < NOT_FINITE) REFUSED(cps_rope_check(&rope, &err));
        CpsSweep sweep = cps_sweep_default();
        sweep.stiffness = NONE[i];
        REFUSED(cps_sweep_step(law, &sweep, ONE, &step, &err));
        for (k = 0; k < 2; ++k) {
            CpsPlanimeter meter = {.cookie = cps_planimeter_default().cookie,
                                   .pole_arm = 1,
                                   .tracer_arm = 1,
                                   .wheel = 0.5,
                                   .friction = 0.1,
                                   .load = 1};
            SOUND(cps_planimeter_check(&meter, 3, triangle, &err));
            *(k ? &meter.tracer_arm : &meter.pole_arm) = NONE[i];
            REFUSED(cps_planimeter_check(&meter, 3, triangle, &err));
            double moved[6];
            memcpy(moved, triangle, sizeof moved);
            moved[2 + k] = NONE[i];
            meter.pole_arm = meter.tracer_arm = 1;
            if (i < NOT_FINITE) REFUSED(cps_planimeter_check(&meter, 3, moved, &err));
        }
    }
    CpsSweep sweep = cps_sweep_default();
    sweep.stiffness = 0;
    REFUSED(cps_sweep_step(law, &sweep, ONE, &step, &err));
    const double same[4] = {1, 1, 1, 1};
    CpsRope rope = cps_rope_default();
    rope.node_count = 2;
    rope.node = same;
    rope.resistance = 1;
    REFUSED(cps_rope_check(&rope, &err));
}

/* The method of 1990 on a rope that has been pulled. */
static void studies(void **state) {
    (void)state;
    const double point[6] = {0, 0, 0, 10, 0, 0};
    CpsLine line = straight_rope(point, 10, 8, 5, 1e4);
    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    bed.friction = 0.5;
    CpsChange change = {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {10.02, 0.1, 0}}};
    CpsStage stage = cps_stage_default();
    stage.name = "pull";
    stage.step_count = 2;
    stage.change_count = 1;
    stage.change = &change;
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = scene.line_count = scene.stage_count = 1;
    scene.obstacle = &bed;
    scene.line = &line;
    scene.stage = &stage;
    CpsEvolution *evolution = NULL;
    CpsRegularized *classic = NULL, *next = NULL;
    CpsRegularizedReport report;
    CpsStudy *study = NULL;
    CpsJudgementReport judged;
    SOUND(cps_evolution_create(&scene, &evolution, &err));
    SOUND(cps_evolution_step(evolution, &err));
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    SOUND(cps_regularized_create(&view, &classic, &err));
    const CpsRegularizedParameters sound = cps_regularized_coarse(classic);
    REFUSED(cps_regularized_solve(classic, NULL, 10, &report, &err));
    REFUSED(cps_regularized_solve(classic, &sound, 10, NULL, &err));
    for (i = 0; i < NONES; ++i) {
        bad = NONE[i];
        CpsRegularizedParameters parameters = sound;
        parameters.stiffness = bad;
        REFUSED(cps_regularized_solve(classic, &parameters, 10, &report, &err));
        parameters = sound;
        parameters.penalty = bad;
        REFUSED(cps_regularized_solve(classic, &parameters, 10, &report, &err));
        REFUSED(cps_regularized_next(&view, bad, classic, &next, &err));
        REFUSED(cps_solution_judge(&view, view.position, bad, &judged, &err));
        for (k = 0; k < CPS_STUDY_STAGE_COUNT; ++k) {
            CpsStudyOptions options = cps_study_options_default(classic);
            options.factor[k] = bad;
            REFUSED(cps_study_run(classic, &options, NULL, NULL, &study, &err));
            options = cps_study_options_default(classic);
            options.value_count[k] = i < 2 ? 0 : 1000000;
            REFUSED(cps_study_run(classic, &options, NULL, NULL, &study, &err));
        }
    }
    REFUSED(cps_regularized_next(NULL, 0.5, classic, &next, &err));
    REFUSED(cps_regularized_next(&view, 0.5, NULL, &next, &err));
    REFUSED(cps_regularized_next(&view, 0.5, classic, NULL, &err));
    CpsStudyOptions options = cps_study_options_default(classic);
    REFUSED(cps_study_run(classic, NULL, NULL, NULL, &study, &err));
    REFUSED(cps_study_run(classic, &options, NULL, NULL, NULL, &err));
    options.from.cell_count = 1;
    REFUSED(cps_study_run(classic, &options, NULL, NULL, &study, &err));
    options = cps_study_options_default(classic);
    options.factor[CPS_STUDY_STAGE_H] = 3;
    REFUSED(cps_study_run(classic, &options, NULL, NULL, &study, &err));
    REFUSED(cps_solution_judge(&view, NULL, 1e-8, &judged, &err));
    REFUSED(cps_solution_judge(&view, view.position, 1e-8, NULL, &err));
    REFUSED(cps_evolution_create(&scene, NULL, &err));
    REFUSED(cps_evolution_step(NULL, &err));
    GIVES(cps_solution_slack(&view, 2, NULL) == 0);
    REFUSED(cps_solution_complete(&view, CPS_COMPLETION_MEANDER, NULL, NULL, &err));
    SOUND(cps_evolution_step(evolution, &err));
    REFUSED(cps_evolution_step(evolution, &err)); /* the history is over */
    cps_regularized_destroy(classic);
    cps_evolution_destroy(evolution);
}

static void release(void **state) {
    (void)state;
    all_were_refused();
    cps_resistance_release(viscous);
    cps_law_release(law);
    cps_set_release(disc);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(make),
        cmocka_unit_test(sets),
        cmocka_unit_test(laws),
        cmocka_unit_test(limits),
        cmocka_unit_test(systems),
        cmocka_unit_test(bodies),
        cmocka_unit_test(ropes_and_sweeps),
        cmocka_unit_test(studies),
        cmocka_unit_test(release),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
