/* SPDX-License-Identifier: BSD-3-Clause */
/* Water that a function of the program moves, and loads along a line by a function of time
 * (capstan/loads.h): the waves of a scene given as a function are those of the scene; a constant
 * load is that of the scene; a rope without weight under a load that oscillates moves by its closed
 * form. Results are read by the independent checker beside the scene, whose functions it calls.
 * Each figure is printed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/results.h"
#include "checker.h"
#include "given.h"
#include "sample.h"
#include "time_rig.h"

/* ---- water ---- */

typedef struct Sea {
    TimeRig rig;
    CpsWave wave[2];
    CpsWaves waves;
    const CpsScene *scene; /* whose waves the function has */
} Sea;

static void waves_of(void *user, double time, const double x[3], double velocity[3],
                     double acceleration[3]) {
    const CpsWaterMotion water = cps_waves_at(((Sea *)user)->scene, time, x);
    memcpy(velocity, water.velocity, sizeof water.velocity);
    memcpy(acceleration, water.acceleration, sizeof water.acceleration);
}

/* A rope that hangs in a current and two waves, `far` metres from the origin. */
static void hang(Sea *sea, double far) {
    TimeRig *rig = &sea->rig;
    time_begin(rig, 3, 10, 2, 1e5);
    for (int j = 0; j <= 10; j++) time_node(rig, j, far, 0, -0.3 * j);
    time_water(rig, 1025, (const double[]){0.2, 0.1, 0},
               (CpsDrag){.diameter = 0.03, .normal = 1.2, .tangential = 0.02, .added_normal = 1});
    sea->wave[0] = (CpsWave){.amplitude = 0.3, .period = 3};
    sea->wave[1] = (CpsWave){.amplitude = 0.1, .period = 2, .direction = 1, .phase = 2};
    sea->waves = (CpsWaves){.depth = 20, .wave_count = 2, .wave = sea->wave};
    rig->scene.has_water_surface = true;
    rig->scene.water_surface = 1;
    time_stage(rig, 2, 100);
}

static void own(Sea *sea, const Sea *other) {
    sea->scene = &other->rig.scene;
    sea->rig.current.function = waves_of;
    sea->rig.current.user = sea;
}

static void waves_by_a_function_are_those_of_the_scene(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        const double far = k ? 5e3 : 0;
        static Sea given, function;
        hang(&given, far);
        given.rig.current.waves = &given.waves;
        hang(&function, far);
        own(&function, &given);
        TimeRun one = time_open(&given.rig), other = time_open(&function.rig);
        time_steps(&one, 0);
        time_steps(&other, 0);
        double off = 0, most = 0;
        for (int i = 0; i < 33; i++) {
            off = fmax(off, fabs(one.view.position[i] - other.view.position[i]));
            most = fmax(most, fabs(one.view.position[i] + one.view.origin[i % 3] -
                                   function.rig.point[i]));
        }
        const char *name = k ? "water, 5 km away" : "water";
        CHECK_LESS(0.05, most); /* [m] it is moved */
        /* the phases are known to 2e-11 */
        CHECK_LESS(time_report(name, "largest difference [m]", 0, off), 1e-11);
        CHECK_NEAR(one.waves, other.waves, 1e-10 * fabs(one.waves));
        time_close(&one, name);
        time_close(&other, name);
    }
}

/* A hull with two members under water, on the end of the rope that hangs. */
typedef struct Hull {
    Sea sea;
    CpsBody body;
    CpsPoint eye;
    CpsMember member[2];
} Hull;

static void hang_hull(Hull *hull, double far) {
    Sea *sea = &hull->sea;
    hang(sea, far);
    hull->member[0] = (CpsMember){.from = {-1, 0, -0.6},
                                  .to = {1, 0.3, -0.4},
                                  .diameter = 0.2,
                                  .normal = 1.1,
                                  .tangential = 0.1,
                                  .added_normal = 0.9};
    hull->member[1] = (CpsMember){.from = {0.2, -0.5, -0.3},
                                  .to = {0.2, 0.5, -0.9},
                                  .diameter = 0.1,
                                  .normal = 0.7};
    hull->body = cps_body_default();
    hull->body.name = "hull";
    hull->body.kind = CPS_BODY_KIND_FREE;
    hull->body.mass = 100;
    hull->body.buoyancy = 900;
    for (int i = 0; i < 3; i++) hull->body.inertia[i] = 20 + 5 * i;
    hull->body.position[0] = far;
    hull->body.position[2] = -3;
    hull->body.member = hull->member;
    hull->body.member_count = 2;
    hull->eye = cps_point_default();
    hull->eye.name = "eye";
    hull->eye.kind = CPS_POINT_KIND_ON_BODY;
    sea->rig.line.end[CPS_END_B].kind = CPS_END_KIND_POINT;
    sea->rig.scene.body = &hull->body;
    sea->rig.scene.point = &hull->eye;
    sea->rig.scene.body_count = sea->rig.scene.point_count = 1;
}

static CpsEvolution *evolve(const CpsScene *scene) {
    CpsEvolution *evolution;
    CpsError err;
    if (cps_evolution_create(scene, &evolution, &err)) fail_msg("%s", err.message);
    while (cps_evolution_remaining_count(evolution) > 0)
        if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
    assert_true(cps_outcome_is_certified(cps_evolution_line_report(evolution, 0).outcome));
    return evolution;
}

static void members_in_water_of_a_function_are_in_waves(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        const double far = k ? 5e3 : 0;
        static Hull given, function, calm;
        hang_hull(&given, far);
        given.sea.rig.current.waves = &given.sea.waves;
        hang_hull(&function, far);
        own(&function.sea, &given.sea);
        hang_hull(&calm, far);
        const Hull *hull[3] = {&given, &function, &calm};
        CpsBodyReport report[3];
        for (int i = 0; i < 3; i++) {
            CpsEvolution *evolution = evolve(&hull[i]->sea.rig.scene);
            report[i] = cps_evolution_body_report(evolution, 0);
            cps_evolution_destroy(evolution);
        }
        double off = 0, moved = 0, turned = 0;
        for (int i = 0; i < 3; i++) {
            off = fmax(off, fabs(report[0].position[i] - report[1].position[i]));
            moved = fmax(moved, fabs(report[2].position[i] - report[1].position[i]));
        }
        for (int i = 0; i < 4; i++)
            turned = fmax(turned, fabs(report[0].rotation[i] - report[1].rotation[i]));
        const char *name = k ? "members, 5 km away" : "members";
        CHECK_LESS(0.02, moved); /* [m] by the waves */
        CHECK_LESS(time_report(name, "largest difference [m]", 0, off), 1e-10);
        CHECK_LESS(time_report(name, "largest difference [-]", 0, turned), 1e-10);
    }
}

/* ---- loads ---- */

typedef struct Load {
    double size[3], rate; /* [N/m], [rad/s] 0: constant */
} Load;

static void load_at(void *user, double time, double s, double force[3]) {
    const Load *load = user;
    (void)s;
    for (int a = 0; a < 3; a++)
        force[a] = load->size[a] * (load->rate > 0 ? sin(load->rate * time) : 1);
}

static void load_near(void *user, double time, double s, double force[3]) {
    load_at(user, time, s, force);
    if (s > 1.6) force[0] = force[1] = force[2] = 0;
}

/* A free rope without weight. */
static void drift(TimeRig *rig, int steps) {
    time_begin(rig, 2, 8, 3, 1e4);
    rig->scene.gravity[2] = rig->line.weight = 0;
    rig->line.end[CPS_END_A] = rig->line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    for (int j = 0; j <= 8; j++) time_node(rig, j, 0.25 * j, 0, 0);
    rig->line.loads = &rig->loads;
    time_stage(rig, 1.5, steps);
}

/* x = f/m (t/w - sin(w t)/w^2) of all of it. */
static void a_load_that_oscillates_moves_a_rope(void **state) {
    (void)state;
    Load load = {.size = {0, 4, 1}, .rate = 5};
    double error[3];
    for (int k = 0; k < 3; k++) {
        TimeRig rig;
        drift(&rig, 100 << k);
        rig.loads.force_function = load_at;
        rig.loads.force_user = &load;
        TimeRun run = time_open(&rig);
        time_steps(&run, 0);
        const double exact =
            4.0 / 3 * (1.5 / load.rate - sin(1.5 * load.rate) / (load.rate * load.rate));
        error[k] =
            time_report("load in time", "place after 1.5 s [m]", exact, run.view.position[1]);
        for (int j = 1; j <= 8; j++)
            CHECK_NEAR(run.view.position[3 * j + 1], run.view.position[1], 1e-9);
        time_close(&run, "load in time");
    }
    CHECK_NEAR(log2(error[1] / error[2]), 2, 0.1);
}

/* On a piece of the line, whose end is between nodes: 1.6 of 2 m in elements of 0.25 m; a function
 * is that at the nodes, 0 to 1.5, and stands for 0 to 1.625. */
static void a_constant_load_is_that_of_the_scene(void **state) {
    (void)state;
    Load load = {.size = {0.5, 4, 1}};
    CpsLineForce force = {.from = 0, .to = 1.625, .force = {0.5, 4, 1}};
    TimeRig rig[2];
    TimeRun run[2];
    for (int k = 0; k < 2; k++) {
        drift(&rig[k], 60);
        if (k == 0) {
            rig[k].loads.force_count = 1;
            rig[k].loads.force = &force;
        } else {
            rig[k].loads.force_function = load_near;
            rig[k].loads.force_user = &load;
        }
        time_stage(&rig[k], 0.2, 4);
        run[k] = time_open(&rig[k]);
        time_steps(&run[k], 0);
    }
    double off = 0;
    for (int i = 0; i < 27; i++)
        off = fmax(off, fabs(run[0].view.position[i] - run[1].view.position[i]));
    CHECK_LESS(time_report("constant load", "largest difference [m]", 0, off), 1e-11);
    for (int k = 0; k < 2; k++) time_close(&run[k], "constant load");
}

/* ---- results ---- */

/* Of the scene, whether the checker accepts them; or not with a number changed. */
static void expect(const CpsScene *scene, const char *path, const char *variable, size_t index,
                   double value) {
    char command[200], copy[80];
    snprintf(copy, sizeof copy, "%s-copy", path);
    snprintf(command, sizeof command, "cp '%s' '%s'", path, copy);
    assert_int_equal(system(command), 0);
    if (variable) assert_int_equal(sample_poke(copy, variable, index, value), 0);
    const bool accepted = checker_file(copy, NULL, variable ? NULL : stdout) == 0 &&
                          given_file(copy, scene, variable ? NULL : stdout) == 0;
    if (accepted != !variable) fail_msg("%s", variable ? variable : "the file is refused");
}

static void results_are_checked(void **state) {
    (void)state;
    static Sea given;
    static Hull hull;
    Sea *sea = &hull.sea;
    Load load = {.size = {0, 40, 0}, .rate = 3};
    char folder[] = "capstan-water-XXXXXX", path[64], command[80];
    CpsEvolution *evolution;
    CpsResults *results = NULL;
    CpsError err;
    hang(&given, 700);
    given.rig.current.waves = &given.waves;
    hang_hull(&hull, 700);
    own(sea, &given);
    sea->rig.loads.force_function = load_near;
    sea->rig.loads.force_user = &load;
    CpsStage *rest = time_stage(&sea->rig, 0, 1);
    rest->name = "rest";
    assert_non_null(mkdtemp(folder));
    if (cps_evolution_create(&sea->rig.scene, &evolution, &err) ||
        cps_results_prepare(folder, CPS_RESULTS_KIND_RUN, 0, true, &err) ||
        cps_results_open(folder, &sea->rig.scene, evolution, NULL, &results, &err))
        fail_msg("%s", err.message);
    for (int k = 0; k < 101; k++)
        if (cps_evolution_step(evolution, &err) || cps_results_append(results, evolution, &err))
            fail_msg("%s", err.message);
    assert_int_equal(cps_results_finish(results, 0, &err), CPS_OK);
    snprintf(path, sizeof path, "%s/result.nc", folder);
    const CpsScene *scene = &sea->rig.scene;
    expect(scene, path, NULL, 0, 0);
    expect(scene, path, "line_water_velocity", 3 * (40 * 10 + 4), 0.77);
    expect(scene, path, "line_water_acceleration", 3 * (40 * 10 + 4) + 2, 0.5);
    expect(scene, path, "line_node_load", 3 * (40 * 11 + 4) + 1, 3);
    expect(scene, path, "load_of_body", 3 * 40, 30);
    expect(scene, path, "ledger_waves_of_body", 40, 2);
    load.size[1] = 41; /* another scene */
    assert_true(given_file(path, scene, NULL) != 0);
    load.size[1] = 40;
    given.wave[0].amplitude = 0.31;
    assert_true(given_file(path, scene, NULL) != 0);
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    assert_int_equal(system(command), 0);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
}

/* ---- what is refused ---- */

static void wrong_scenes_are_refused(void **state) {
    (void)state;
    static Sea given, sea;
    CpsEvolution *evolution;
    CpsError err;
    double water[60];
    hang(&given, 0);
    hang(&sea, 0);
    own(&sea, &given);
    sea.rig.stage[0].duration = 0;
    CHECK_INT(cps_evolution_create(&sea.rig.scene, &evolution, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "a function moves the water in time"));
    sea.rig.stage[0].duration = 2;
    if (cps_evolution_create(&sea.rig.scene, &evolution, &err)) fail_msg("%s", err.message);
    water[0] = 7;
    cps_evolution_water(NULL, 0, water, &water[30]);
    cps_evolution_water(evolution, 1, water, &water[30]);
    cps_evolution_water(evolution, 0, NULL, &water[30]);
    CHECK_NEAR(water[0], 7, 0);
    cps_evolution_water(evolution, 0, water, &water[30]); /* at rest there is none */
    CHECK_NEAR(water[0], 0, 0);
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_by_a_function_are_those_of_the_scene),
        cmocka_unit_test(members_in_water_of_a_function_are_in_waves),
        cmocka_unit_test(a_load_that_oscillates_moves_a_rope),
        cmocka_unit_test(a_constant_load_is_that_of_the_scene),
        cmocka_unit_test(results_are_checked),
        cmocka_unit_test(wrong_scenes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
