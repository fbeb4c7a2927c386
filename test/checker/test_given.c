/* SPDX-License-Identifier: BSD-3-Clause */
/* Copies of a valid file that are valid records of another scene: the checker accepts them by
 * themselves, and refuses them together with their scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "capstan/io.h"
#include "capstan/results.h"
#include "check.h"
#include "checker.h"
#include "given.h"
#include "sample.h"

/* Ends held, moved, pulled, let go and grabbed; zones, a graded mesh, a set of friction forces,
 * something that turns. */
static const char SCENE[] =
    "capstan: 1\n"
    "gravity: [0, 0, -10]\n"
    "types: {stiff: {weight: 9, stiffness: 3000, breaking_load: 50}, soft: {weight: 6, stiffness: "
    "1000}, rope: {weight: 7, stiffness: {strain: [0, 0.002, 0.02], tension: [0, 1, 40]}}}\n"
    "obstacles:\n"
    "  bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.5}\n"
    "  drum: {cylinder: {point: [0, 30, 1], axis: [0, 1, 0], radius: 1}, friction: {axial: 0.3, "
    "lateral: 0.2}}\n"
    "  mat: {plane: {point: [0, 0, -9], normal: [0, 0, 1]}, friction: {set: {ellipse: [0.4, "
    "0.2]}}}\n"
    "lines:\n"
    "  rope:\n"
    "    length: 4\n"
    "    elements: [1, 1, 0.5, 1.5]\n"
    "    weight: 8\n"
    "    stiffness: 1000\n"
    "    friction_zones: [{from: 1, to: 2, factor: 2}]\n"
    "    start: {straight: {from: [0, 0, 0], to: [4, 0, 0]}}\n"
    "    ends: {A: held, B: free}\n"
    "  wire:\n"
    "    length: 4\n"
    "    elements: 4\n"
    "    weight: 8\n"
    "    stiffness: .inf\n"
    "    breaking_load: 90\n"
    "    start: {straight: {from: [0, 5, 0], to: [4, 5, 0]}}\n"
    "    ends: {A: held, B: free}\n"
    "  made:\n"
    "    sections: [{type: stiff, length: 2, elements: 2}, {type: soft, length: 2, elements: 2}]\n"
    "    point_weights: [{at: 1, mass: 0.3}, {at: 3, weight: -1}]\n"
    "    start: {straight: {from: [0, 10, 0], to: [4, 10, 0]}}\n"
    "    ends: {A: held, B: free}\n"
    "  soft:\n"
    "    sections: [{type: stiff, length: 1, elements: 1}, {type: rope, length: 3, elements: 3}]\n"
    "    start: {straight: {from: [0, 15, 0], to: [4, 15, 0]}}\n"
    "    ends: {A: held, B: free}\n"
    "history:\n"
    "  - {name: pull, steps: 2, rope.B: {force: [30, 0, 0]}, wire.B: {force: [30, 0, 0]}, soft.B: "
    "{force: [30, 0, 0]}}\n"
    "  - {name: turn, steps: 1, drum.turn: 0.5}\n"
    "  - {name: grab, steps: 2, rope.B: {position: [4, 1, 0.5]}}\n"
    "  - {name: slack, steps: 1, rope.B: {force: [0, 0, 0]}}\n";

static char directory[] = "capstan-given-XXXXXX", result[64], copy[64];
static CpsSceneFile *scene;

/* A scene file into results in `where`. `parts`: of its first step, if not NULL. */
static CpsStatus run(const char *text, const char *where, CpsSceneFile **read, int *parts) {
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    CpsResults *results = NULL;
    char yaml[80];
    snprintf(yaml, sizeof yaml, "%s/scene.yaml", where);
    FILE *out = fopen(yaml, "w");
    if (!out || fputs(text, out) < 0 || fclose(out) != 0) return CPS_ERR_IO;
    CpsStatus status = cps_scene_read(yaml, NULL, read, &err);
    if (!status) status = cps_evolution_create(cps_scene_file_scene(*read), &evolution, &err);
    if (!status)
        status = cps_results_prepare(where, CPS_RESULTS_KIND_RUN, 0, true,
                                     &err); /* the scene lies there */
    if (!status)
        status =
            cps_results_open(where, cps_scene_file_scene(*read), evolution, NULL, &results, &err);
    for (bool first = true; !status && cps_evolution_remaining_count(evolution) > 0;
         first = false) {
        status = cps_evolution_step(evolution, &err);
        if (!status) status = cps_results_append(results, evolution, &err);
        if (!status && parts && first)
            *parts = cps_evolution_line_report(evolution, 0).substep_count;
    }
    if (!status) status = cps_results_finish(results, 0, &err);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    if (status) print_error("%s\n", err.message);
    return status;
}

static int solve(void **state) {
    (void)state;
    if (!mkdtemp(directory)) return -1;
    snprintf(result, sizeof result, "%s/result.nc", directory);
    snprintf(copy, sizeof copy, "%s/copy.nc", directory);
    return run(SCENE, directory, &scene, NULL) != CPS_OK;
}

static int clean(void **state) {
    (void)state;
    char command[160];
    cps_scene_file_destroy(scene);
    snprintf(command, sizeof command, "rm -r '%s'", directory);
    return system(command);
}

static void copy_result(void) {
    FILE *from = fopen(result, "rb"), *to = fopen(copy, "wb");
    assert_true(from && to);
    for (int c; (c = getc(from)) != EOF;) putc(c, to);
    fclose(from);
    assert_int_equal(fclose(to), 0);
}

static void sound_file_is_the_scenes(void **state) {
    (void)state;
    CHECK_INT(checker_file(result, NULL, stdout), 0);
    CHECK_INT(given_file(result, cps_scene_file_scene(scene), stdout), 0);
}

enum { POKES = 4 };
typedef struct Falsified {
    const char *finding;
    bool alone; /* nothing is wrong with the copy by itself */
    struct {
        const char *variable;
        size_t index;
        double value;
    } poke[POKES];
} Falsified;

/* the steps are 0, 1: pull; 2: turn; 3, 4: grab; 5: slack; what is imposed has 6 numbers in a step
 */
static const Falsified FALSIFIED[] = {
    {"end_applied_force of rope, end B, step 1", false, {{"rope_end_applied_force", 6 + 3, 31}}},
    {"end_applied_force of rope, end B, step 1", false, {{"rope_end_applied_force", 6 + 4, 1}}},
    {"end_applied_force of rope, end B, step 1",
     true,
     {{"rope_end_applied_force", 6 + 5, 1e-8}, {"rope_end_force", 6 + 5, 1e-8}}},
    {"end_applied_force of wire, end B, step 2",
     true,
     {{"wire_end_applied_force", 12 + 4, 1e-8}, {"wire_end_force", 12 + 4, 1e-8}}},
    {"end_held_position of rope, end B, step 3", false, {{"rope_end_held_position", 18 + 4, 0.6}}},
    {"end_held_position of rope, end A, step 5", true, {{"rope_end_held_position", 30, 1e-13}}},
    {"end_held_position of wire, end A, step 0", true, {{"wire_end_held_position", 2, 1e-13}}},
    {"end_kind of rope, end B, step 0", false, {{"rope_end_kind", 1, 0}}},
    {"end_kind of wire, end A, step 4", false, {{"wire_end_kind", 8, 1}}},
    {"load of rope at node 2, step 0", false, {{"rope_load", 8, -6.1}}},
    {"load of rope at node 2, step 0", true, {{"rope_load", 6, 1e-12}}},
    {"element_length of rope", false, {{"rope_element_length", 1, 1.1}}},
    {"compliance of rope", false, {{"rope_compliance", 0, 0.0011}}},
    {"compliance of rope", true, {{"rope_compliance", 0, 0.001 * (1 + 1e-10)}}},
    {"compliance of made", true, {{"made_compliance", 0, 7.5e-4}}},
    {"compliance of made",
     true,
     {{"made_compliance_factor", 0, 0.6}, {"made_compliance_factor", 1, 0.4}}},
    {"tension of soft in element 1 at the strain 0.002",
     false,
     {{"soft_spring_strain", 0, 0.0019}}},
    {"tension of soft in element 2 at the strain 0.02",
     false,
     {{"soft_spring_stiffness", 1, 1666.7}}},
    {"springs of soft in element 0", false, {{"soft_spring_element", 0, 0}}},
    {"weight_length of made at node 1", false, {{"made_weight_length", 1, 1.4}}},
    {"weight_length of made at node 2", true, {{"made_weight_length", 2, 0.8}}},
    {"load of made at node 3, step 4", false, {{"made_load", 4 * 15 + 11, -6}}},
    {"breaking_load of wire", false, {{"wire_breaking_load", 0, 1}}},
    {"breaking_load of wire", false, {{"wire_breaking_load", 3, 1e9}}},
    /* so large that forces which are rounding alone are 0 beside it */
    {"breaking_load of made", true, {{"made_breaking_load", 3, 1e308}}},
    {"friction_zones of rope", false, {{"rope_zone_factor", 0, 1.9}}},
    {"friction_zones of rope", false, {{"rope_zone_to", 0, 2.1}}},
    {"point of bed", true, {{"obstacle_point", 0, 1}}},
    {"axis of drum", false, {{"obstacle_axis", 3, 0.1}}},
    {"radius of drum", false, {{"obstacle_radius", 1, 1.5}}},
    {"kind of drum", false, {{"obstacle_kind", 1, 2}}},
    {"axial coefficient of bed", false, {{"obstacle_friction_axial", 0, 0.6}}},
    {"lateral coefficient of drum", true, {{"obstacle_friction_lateral", 1, 0.3}}},
    {"grain of drum", true, {{"obstacle_friction_grain", 3, 1}}},
    {"shape of friction of drum", true, {{"obstacle_friction_shape", 1, 1}}},
    {"friction set of mat", true, {{"obstacle_friction_set_origin", 4, 0.01}}},
    {"obstacle_turn of drum, step 2", false, {{"obstacle_turn", 6 + 1, 0.4}}},
    {"obstacle_turn of mat, step 3", true, {{"obstacle_turn", 9 + 2, 0.4}}},
};

static void falsified_copies_are_refused(void **state) {
    (void)state;
    int alone = 0;
    for (size_t i = 0; i < sizeof FALSIFIED / sizeof *FALSIFIED; i++) {
        const Falsified *f = &FALSIFIED[i];
        copy_result();
        for (int k = 0; k < POKES && f->poke[k].variable; k++)
            CHECK_INT(sample_poke(copy, f->poke[k].variable, f->poke[k].index, f->poke[k].value),
                      0);
        const int by_itself = checker_file(copy, NULL, NULL);
        alone += by_itself == 0;
        char *text = NULL;
        size_t size = 0;
        FILE *log = open_memstream(&text, &size);
        const int found = given_file(copy, cps_scene_file_scene(scene), log);
        fclose(log);
        if (found <= 0 || !strstr(text, f->finding) || (by_itself == 0) != f->alone) {
            print_error("%s[%zu]: by itself %d, beside the scene %d, expected \"%s\", got:\n%s",
                        f->poke[0].variable, f->poke[0].index, by_itself, found, f->finding, text);
            fail();
        }
        free(text);
    }
    printf("%zu falsified copies refused; %d of them are sound by themselves\n",
           sizeof FALSIFIED / sizeof *FALSIFIED, alone);
}

/* What the file says of breaking loads is recomputed from it alone. */
static void false_utilisation_is_refused(void **state) {
    (void)state;
    static const struct {
        const char *variable;
        size_t index;
        double value;
    } POKE[] = {{"wire_utilisation", 4, 0.1},    {"made_utilisation", 0, 0.5},
                {"wire_utilisation_at", 4, 0.5}, {"soft_utilisation_at", 1, 2.5},
                {"wire_breaking_load", 3, 30},   {"made_breaking_load", 0, 0}};
    for (size_t i = 0; i < sizeof POKE / sizeof *POKE; i++) {
        copy_result();
        CHECK_INT(sample_poke(copy, POKE[i].variable, POKE[i].index, POKE[i].value), 0);
        if (checker_file(copy, NULL, NULL) == 0)
            fail_msg("%s[%zu] = %g is accepted", POKE[i].variable, POKE[i].index, POKE[i].value);
    }
}

/* A tolerance, a mode or a gravity of another scene. */
static void other_scenes_are_refused(void **state) {
    (void)state;
    CpsScene other = *cps_scene_file_scene(scene);
    other.solver.tolerance = 1e-6;
    CHECK_INT(given_file(result, &other, NULL), 1);
    other = *cps_scene_file_scene(scene);
    other.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    CHECK_INT(given_file(result, &other, NULL), 1);
    other = *cps_scene_file_scene(scene);
    other.contact_policy = CPS_CONTACT_POLICY_REFERENCE;
    CHECK_INT(given_file(result, &other, NULL), 1);
    other = *cps_scene_file_scene(scene);
    other.gravity[2] = -9;
    CHECK_INT(given_file(result, &other, NULL), 1);
    other = *cps_scene_file_scene(scene);
    other.stage_count = 1;
    CHECK_INT(given_file(result, &other, NULL), 1); /* more steps than in the history */
    other = *cps_scene_file_scene(scene);
    other.line_count = 1;
    CHECK_INT(given_file(result, &other, NULL), 1);
    other = *cps_scene_file_scene(scene);
    other.obstacle_count = 1;
    CHECK_GREATER(given_file(result, &other, NULL), 0);
    CHECK_INT(given_file("no-such-file.nc", cps_scene_file_scene(scene), NULL), -1);
}

/* An end that is grabbed, or moved, in the first step starts from where the start shape puts it,
 * also where the step is taken in parts and the record's reference is that of the last of them; far
 * from the origin of the coordinates as well. */
static void first_step_in_parts(void **state) {
    (void)state;
    for (int k = 0; k < 12; k++) {
        const double x = k % 2 ? 5e5 : 0;
        char start[160], text[1200], where[] = "capstan-first-XXXXXX", path[64];
        if (k / 2 % 3 == 0)
            snprintf(start, sizeof start, "straight: {from: [%.9g, 0, 0], to: [%.9g, 0, 0]}", x,
                     x + 4);
        if (k / 2 % 3 == 1)
            snprintf(start, sizeof start, "polyline: [[%.9g, 0, 0], [%.9g, 1, 0], [%.9g, 2, 0]]", x,
                     x + 1.75, x + 3.5);
        if (k / 2 % 3 == 2)
            snprintf(start, sizeof start,
                     "arc: {from: [%.9g, 0, 0], centre: [%.9g, 0.5, 3], axis: [0, 0, -2]}", x,
                     x + 1);
        snprintf(
            text, sizeof text,
            "capstan: 1\ngravity: [0, 0, -10]\nsolver: {path_tolerance: 1e-3, halvings: 4}\n"
            "obstacles:\n  bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.5}\n"
            "lines:\n  rope:\n    length: 4\n    elements: 8\n    weight: 8\n    stiffness: 1000\n"
            "    start: {%s}\n    ends: {A: %s, B: %s}\n"
            "history:\n  - {name: grab, steps: 2, rope.B: {position: [%.9g, 1.5, 0.7]}}\n",
            start, k < 6 ? "held" : "free", k < 6 ? "free" : "held", x + 3);
        assert_non_null(mkdtemp(where));
        CpsSceneFile *file = NULL;
        int parts = 0;
        CHECK_INT(run(text, where, &file, &parts), CPS_OK);
        CHECK_GREATER(parts, 1);
        snprintf(path, sizeof path, "%s/result.nc", where);
        CHECK_INT(given_file(path, cps_scene_file_scene(file), stdout), 0);
        CHECK_INT(sample_poke(path, "rope_end_held_position", 4, 1.25),
                  0); /* y of end B half way */
        CHECK_GREATER(given_file(path, cps_scene_file_scene(file), NULL), 0);
        cps_scene_file_destroy(file);
        snprintf(path, sizeof path, "rm -r '%s'", where);
        CHECK_INT(system(path), 0);
    }
}

/* The first step of a start from nodes begins at them, with their bounds. */
static void first_step_of_nodes(void **state) {
    (void)state;
    static const char text[] =
        "capstan: 1\ngravity: [0, 0, -10]\nfriction_policy: frozen\n"
        "obstacles:\n  bed: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.5}\n"
        "lines:\n  rope:\n    length: 4\n    weight: 8\n    stiffness: 1000\n"
        "    start: {nodes: nodes.csv}\n    ends: {A: held, B: free}\n"
        "history:\n  - {name: pull, rope.B: {force: [5, 5, 0]}}\n";
    char where[] = "capstan-nodes-XXXXXX", path[64];
    assert_non_null(mkdtemp(where));
    snprintf(path, sizeof path, "%s/nodes.csv", where);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs("x,y,z,reaction\n0,0,0,4\n1,0,0,8\n1.5,0.5,0,6\n2,1,0,8\n3,1,0,4\n", out);
    assert_int_equal(fclose(out), 0);
    CpsSceneFile *file = NULL;
    CHECK_INT(run(text, where, &file, NULL), CPS_OK);
    snprintf(path, sizeof path, "%s/result.nc", where);
    CHECK_INT(given_file(path, cps_scene_file_scene(file), stdout), 0);
    CHECK_INT(sample_poke(path, "rope_friction_bound", 2, 2.9), 0); /* mu R = 3 */
    CHECK_INT(given_file(path, cps_scene_file_scene(file), NULL), 1);
    CHECK_INT(sample_poke(path, "rope_friction_bound", 2, 3), 0);
    CHECK_INT(sample_poke(path, "rope_reference", 4, 0.01), 0); /* y of node 1 */
    CHECK_INT(given_file(path, cps_scene_file_scene(file), NULL), 1);
    cps_scene_file_destroy(file);
    snprintf(path, sizeof path, "rm -r '%s'", where);
    CHECK_INT(system(path), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_file_is_the_scenes),
        cmocka_unit_test(falsified_copies_are_refused),
        cmocka_unit_test(false_utilisation_is_refused),
        cmocka_unit_test(other_scenes_are_refused),
        cmocka_unit_test(first_step_in_parts),
        cmocka_unit_test(first_step_of_nodes),
    };
    return cmocka_run_group_tests(tests, solve, clean);
}
