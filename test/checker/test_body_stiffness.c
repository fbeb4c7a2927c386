/* SPDX-License-Identifier: BSD-3-Clause */
/* Both stiffnesses of a free body against those that the checker derives from the file of the run:
 * lines that hang, slide on the bed, rest on it, and go back and forth on it; and of small cycles
 * on a bed with friction along its grain, or across it, alone. */
#include "body_stiffness.h"

#include <math.h>
#include <stdlib.h>

#include "capstan/evolve.h"
#include "capstan/io.h"
#include "check.h"
#include "run_scene.h"

/* %s: the friction of the bed, which is to have one coefficient under a free body; is the body free
 * or held; and what takes it away and back */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\n"
    "obstacles: {bed: {plane: {point: [0, 0, -30], normal: [0.02, 0, 1]}, friction: %s}}\n"
    "bodies:\n"
    "  float: {%s, rotation: {roll_pitch_yaw: [0, 10, 0]}, weight: 4000,"
    " centre_of_gravity: [0.1, 0, -1], buoyancy: 9000, centre_of_buoyancy: [0, 0, 0.3],"
    " hydrostatics: [[10, 0, 0, 0, 5, 0], [0, 12, 0, 0, 0, 0], [0, 0, 900, 0, 0, 0],"
    " [0, 0, 0, 3000, 0, 0], [5, 0, 0, 0, 3100, 0], [0, 0, 0, 0, 0, 40]]}\n"
    "points:\n"
    "  east: {body: float, at: [1.5, 0, -1]}\n"
    "  north: {body: float, at: [-1, 1, -1]}\n"
    "  south: {body: float, at: [-1, -1, -1]}\n"
    "types:\n"
    "  chain: {weight: 50, stiffness: 2e5}\n"
    "  rope: {weight: 5, stiffness: {strain: [0, 0.004, 0.02], tension: [0, 200, 3000]}}\n"
    "lines:\n"
    "  a: {sections: [{type: chain, length: 50, elements: 25}, {type: rope, length: 36, elements:"
    " 9}], start: static, ends: {A: {held: [75, 0, -30.4]}, B: {point: east}}}\n"
    "  b: {length: 90, elements: 40, weight: 40, stiffness: 1e5, start: static,"
    " ends: {A: {point: north}, B: {held: [-45, 68, -28]}}}\n"
    "  c: {length: 90, elements: 40, weight: 40, stiffness: 1e5, start: static,"
    " ends: {A: {held: [-45, -68, -28]}, B: {point: south}}}\n"
    "  d: {length: 8, elements: 8, weight: 60, stiffness: .inf, start: static,"
    " ends: {A: {held: [3, 9, 2]}, B: {point: east}}}\n"
    "history:\n"
    "  - {name: push, steps: 4, float.body: {%s}}\n"
    "  - {name: lighter, steps: 2, gravity: [0.3, 0, -9]}\n"
    "  - {name: back, steps: 4, float.body: {%s}}\n";
enum { STEPS = 11, LINES = 4, SAID = 1 };

/* Per largest entry, lengths in arms of the body: both come from places to 1e-16, whose strains
 * stiff lines magnify. */
static const double SAME = 1e-9, ARM = 2;

/* The places of the two kinds that were compared. */
typedef struct Seen {
    int compared[2], slid, rested;
} Seen;

/* What of the bed the lines see. */
static void look(const Record *r, Seen *seen) {
    for (size_t j = 1; j + 1 < r->nodes; j++) {
        const double *s = r->slip[j];
        if (!(r->friction_bound[j] > 0)) continue;
        if (hypot(hypot(s[0], s[1]), s[2]) > 1e-6)
            seen->slid++;
        else
            seen->rested++;
    }
}

static void compare(const StiffnessStep *of, const CpsEvolution *evolution, const BodyState *at,
                    Seen *seen) {
    CpsError err;
    CpsBodyStiffness said;
    Real own[SIX * SIX];
    const CpsStiffnessKind kind = of->sticks ? CPS_STIFFNESS_STICK : CPS_STIFFNESS_STEP;
    assert_int_equal(cps_evolution_body_stiffness(evolution, 0, kind, &said, &err), CPS_OK);
    if (said.outcome != CPS_STIFFNESS_OUTCOME_FOUND || !body_stiffness(of, 0, at, ARM, own)) return;
    double most = 0, worst = 0;
    for (int i = 0; i < SIX * SIX; i++) {
        const double unit = (i / SIX < 3 ? 1 : ARM) * (i % SIX < 3 ? 1 : ARM);
        most = fmax(most, fabs((double)own[i]) / unit);
        worst = fmax(worst, fabs((double)own[i] - said.matrix[i]) / unit);
    }
    if (!(worst <= SAME * most))
        fail_msg("%s: off by %g N/m of %g N/m", cps_stiffness_name(kind), worst, most);
    seen->compared[of->sticks]++;
}

typedef struct Run {
    const char *friction, *body, *away, *back;
} Run;

/* The steps of a run that are compared. */
static Seen compare_run(const Run *run) {
    FILE *out = fopen(scene_path, "w");
    assert_true(out && fprintf(out, SCENE, run->friction, run->body, run->away, run->back) >= 0 &&
                fclose(out) == 0);
    run_scene();
    CpsError err;
    CpsSceneFile *scene = NULL;
    CpsEvolution *evolution = NULL;
    Source source;
    Bodies bodies;
    Record line[LINES] = {{0}};
    BodyState at;
    Seen seen = {{0}, 0, 0};
    assert_int_equal(cps_scene_read(scene_path, NULL, &scene, &err), CPS_OK);
    assert_int_equal(cps_evolution_create(cps_scene_file_scene(scene), &evolution, &err), CPS_OK);
    assert_int_equal(source_open(scene_result, &source, stdout), 0);
    assert_int_equal(bodies_open(&source, &bodies, stdout), 0);
    assert_int_equal(source.lines, LINES);
    for (int i = 0; i < LINES; i++)
        assert_int_equal(record_create(&source, source.line_name[i], &line[i], stdout), 0);
    for (size_t step = 0; step < STEPS; step++) {
        const double share = step < 5 ? 0 : fmin(1, (double)(step - 4) / 2),
                     per[3] = {0.03 * share, 0, -1 + 0.1 * share};
        assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
        assert_int_equal(bodies_read(&source, &bodies, step, &at, stdout), 0);
        for (int i = 0; i < LINES; i++) {
            assert_int_equal(record_read(&source, source.line_name[i], step, &line[i], stdout), 0);
            look(&line[i], &seen);
        }
        for (int sticks = 0; sticks < 2; sticks++)
            compare(&(StiffnessStep){&source, &bodies, line, per, step, sticks}, evolution, &at,
                    &seen);
    }
    printf("compared %d of the step, %d of a small cycle; nodes that slid %d, that rested %d\n",
           seen.compared[0], seen.compared[1], seen.slid, seen.rested);
    for (int i = 0; i < LINES; i++) record_destroy(&line[i]);
    bodies_close(&bodies);
    source_close(&source);
    cps_evolution_destroy(evolution);
    cps_scene_file_destroy(scene);
    return seen;
}

static void both_stiffnesses_are_those_of_the_file(void **state) {
    (void)state;
    const Seen seen =
        compare_run(&(Run){"0.6", "free: [0, 0, 0]", "force: [900, 300, 0], arm: [0, 0, 2]",
                           "force: [-200, 100, 0]"});
    assert_true(seen.compared[0] >= STEPS - SAID && seen.compared[1] >= STEPS - SAID);
    assert_true(seen.slid > 20 && seen.rested > 20);
}

static void small_cycles_go_where_no_friction_is(void **state) {
    (void)state;
    static const char *const FRICTION[] = {
        "{axial: 0, lateral: 0.6, grain: [2, 1, 0]}", "{axial: 0.6, lateral: 0, grain: [1, -3, 0]}",
        "{axial: 0.3, lateral: 0.6, grain: [0, 1, 0]}",
        "{axial: 0.6, lateral: 0.2, shape: box, grain: [1, 1, 0]}"};
    for (int i = 0; i < 4; i++) {
        const Seen seen =
            compare_run(&(Run){FRICTION[i], "held: [0, 3, 0.5]", "position: [1.5, 3.5, 0.7]",
                               "position: [0.3, 2.6, 0.2]"});
        assert_true(seen.compared[1] >= STEPS - SAID);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(both_stiffnesses_are_those_of_the_file),
                                       cmocka_unit_test(small_cycles_go_where_no_friction_is)};
    return cmocka_run_group_tests(tests, make_scene_directory, remove_scene_directory);
}
