/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends that are let go and lines that part, from a scene to the checker: the file is sound and the
 * scene's, and copies with a number changed are refused, by themselves or beside their scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/io.h"
#include "check.h"
#include "checker.h"
#include "given.h"
#include "run_scene.h"
#include "sample.h"

/* Three legs on a bed hold a buoy. It is pulled until the first leg parts, and then, in the same
 * stage, while a drum turns aside, on; the second leg is let go by the history, and its end taken
 * hold of again. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\nobstacles:\n"
    "  bed: {plane: {point: [0, 0, -9]}, friction: 0.2}\n"
    "  drum: {cylinder: {point: [0, 0, 90], axis: [0, 1, 0], radius: 2}, friction: 0.3}\n"
    "points:\n"
    "  buoy: {free: [0, 0, 0], weight: -400}\n"
    "lines:\n"
    "  a: {length: 16, elements: 8, weight: 10, stiffness: 1e5, break_at: 600, start: static, "
    "ends: "
    "{A: {held: [12, 0, -9]}, B: {point: buoy}}}\n"
    "  b: {length: 16, elements: 8, weight: 10, stiffness: 1e5, break_at: 3000, start: static, "
    "ends: "
    "{B: {held: [-6, 10, -9]}, A: {point: buoy}}}\n"
    "  c: {length: 16, elements: 8, weight: 10, stiffness: 1e5, start: static, ends: {A: {held: "
    "[-6, "
    "-10, -9]}, B: {point: buoy}}}\n"
    "history:\n"
    "  - {name: pull, steps: 3, buoy.point: {force: [-900, 0, 0]}, drum.turn: 30, gravity: [0, 0, "
    "-10.5]}\n"
    "  - {name: let go, steps: 2, b.A: {release: true}}\n"
    "  - {name: take, steps: 2, b.A: {position: [2, 3, -6]}}\n"
    "  - {name: last, a.A: {move: [1, 0, 0]}}\n";
enum { STEPS = 10, BREAK = 3, A = 0, B = 1 };

static char copy[80];
static CpsSceneFile *scene;

static int solve(void **state) {
    CpsError err;
    if (make_scene_directory(state) != 0) return -1;
    FILE *out = fopen(scene_path, "w");
    if (!out || fputs(SCENE, out) < 0 || fclose(out) != 0) return -1;
    run_scene();
    snprintf(copy, sizeof copy, "%s-copy", scene_result);
    return cps_scene_read(scene_path, NULL, &scene, &err) != CPS_OK;
}

static int clean(void **state) {
    cps_scene_file_destroy(scene);
    return remove_scene_directory(state);
}

static void copy_result(void) {
    FILE *from = fopen(scene_result, "rb"), *to = fopen(copy, "wb");
    assert_true(from && to);
    for (int c; (c = getc(from)) != EOF;) putc(c, to);
    fclose(from);
    assert_int_equal(fclose(to), 0);
}

static void sound_file_is_the_scenes(void **state) {
    (void)state;
    CheckerReport report;
    CHECK_INT(checker_file(scene_result, &report, stdout), 0);
    CHECK_INT(report.steps, STEPS);
    CHECK_INT(report.certified, 3 * STEPS);
    CHECK_INT(given_file(scene_result, cps_scene_file_scene(scene), stdout), 0);
}

/* Ends A and B of a line in a step. */
#define END(step, end) (2 * (step) + (end))

static const struct {
    const char *variable;
    size_t index;
    double value;
    const char *finding; /* of the file by itself; NULL: it is sound, but not the scene's */
} FALSE[] = {
    {"break_line", BREAK, -1, "no line, end or tension"},
    {"break_line", BREAK, 1, "line b: it parts, but was at"},
    {"break_line", BREAK, 3, "no line, end or tension"},
    {"break_line", BREAK - 1, 0, "no line, end or tension"},
    {"break_end", BREAK, 0, "line a: end B has parted, but the step is no break of it"},
    {"break_end", BREAK, 2, "no line, end or tension"},
    {"break_tension", BREAK, 599, "line a: it parts at end B with 599 N, which is not where"},
    {"a_end_release", END(BREAK, B), 0, "end of line a is free"},
    {"a_end_release", END(BREAK, B), 1, "line a: it parts, but end_release"},
    {"a_end_release", END(BREAK + 1, B), 0, "line a: end B was let go, and is again as if"},
    {"a_end_release", END(BREAK + 1, B), 1, "line a: end B has parted, but the step is no break"},
    {"a_end_release", END(STEPS - 1, B), 1, NULL},
    {"a_end_release", END(BREAK - 1, B), 2, "line a: end B was let go, but something acts on it"},
    {"a_end_release", END(BREAK, A), 1, "line a: end A was let go, but something acts on it"},
    {"a_end_release", END(BREAK, B), 4, "unknown way of letting go"},
    {"b_end_release", END(6, A), 2, "line b: end A has parted, but the step is no break of it"},
    {"b_end_release", END(6, A), 0, "end of line b is free"},
    {"b_end_release", END(8, A), 0, "line b: end A was let go, and is again as if"},
    {"b_end_release", END(8, A), 1, "line b: end A was let go, but something acts on it"},
    {"a_break_at", 7, 3000, "line a: it parts at end B with"},
    {"b_break_at", 0, 300, "line b: it was at"},
    {"a_break_at", 3, 601, NULL},
    {"b_break_at", 3, -1, "senseless tension"},
    {"obstacle_turn", 2 * BREAK + 1, 0.1, "an obstacle turns in a step in which a line parts"},
    {"c_end_held_position", 6 * BREAK, -6.5, "line c: end A changes in a step in which a line"},
};

static void falsified_copies_are_refused(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof FALSE / sizeof *FALSE; i++) {
        copy_result();
        CHECK_INT(sample_poke(copy, FALSE[i].variable, FALSE[i].index, FALSE[i].value), 0);
        char *text = NULL;
        size_t size = 0;
        FILE *log = open_memstream(&text, &size);
        const int found = checker_file(copy, NULL, log);
        fclose(log);
        const bool is_refused =
            FALSE[i].finding ? found != 0 && strstr(text, FALSE[i].finding) : found == 0;
        if (!is_refused)
            fail_msg("%s[%zu] = %g: expected \"%s\", got %d:\n%s", FALSE[i].variable,
                     FALSE[i].index, FALSE[i].value, FALSE[i].finding ? FALSE[i].finding : "sound",
                     found, text);
        free(text);
        if (!FALSE[i].finding) CHECK_INT(given_file(copy, cps_scene_file_scene(scene), NULL), 1);
    }
    remove(copy);
}

/* Scenes in which something else parts or is let go. */
static void other_scenes_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *from, *to;
    } CHANGE[] = {
        {"break_at: 600", "break_at: 601"},
        {", break_at: 3000", ""},
        {"b.A: {release: true}", "b.A: {release: true}, b.B: {release: true}"},
        {"b.A: {release: true}", "b.A: {release: true}, c.B: {release: true}"},
        {"b.A: {position: [2, 3, -6]}", "b.A: {position: [2, 3, -6.00001]}"},
        {"b.A: {position: [2, 3, -6]}", "b.A: {release: true}"},
        {"steps: 3, buoy.point", "steps: 4, buoy.point"},
        {"force: [-900, 0, 0]", "force: [-900, 0, 1e-6]"},
        {"drum.turn: 30", "drum.turn: 30.0001"},
        {"-10.5", "-10.5001"},
        {"  - {name: last, a.A: {move: [1, 0, 0]}}\n", ""},
    };
    for (size_t i = 0; i < sizeof CHANGE / sizeof *CHANGE; i++) {
        char text[sizeof SCENE + 200];
        CpsSceneFile *other = NULL;
        CpsError err = {0};
        const char *at = strstr(SCENE, CHANGE[i].from);
        assert_non_null(at);
        snprintf(text, sizeof text, "%.*s%s%s", (int)(at - SCENE), SCENE, CHANGE[i].to,
                 at + strlen(CHANGE[i].from));
        FILE *out = fopen(scene_path, "w");
        assert_true(out && fputs(text, out) >= 0 && fclose(out) == 0);
        if (cps_scene_read(scene_path, NULL, &other, &err) != CPS_OK) fail_msg("%s", err.message);
        if (given_file(scene_result, cps_scene_file_scene(other), NULL) < 1)
            fail_msg("%s is accepted in place of %s", CHANGE[i].to, CHANGE[i].from);
        cps_scene_file_destroy(other);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sound_file_is_the_scenes),
                                       cmocka_unit_test(falsified_copies_are_refused),
                                       cmocka_unit_test(other_scenes_are_refused)};
    return cmocka_run_group_tests(tests, solve, clean);
}
