/* SPDX-License-Identifier: BSD-3-Clause */
/* Copies of a result file and scenes that do not belong together (falsified.h). */
#include "falsified.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/io.h"
#include "check.h"
#include "checker.h"
#include "given.h"
#include "run_scene.h"
#include "sample.h"

enum { MOST_TEXT = 8192 };

static const Falsified *all;
static char copy[80];
static CpsSceneFile *scene;

static void write_text(const char *path, const char *text) {
    FILE *out = fopen(path, "w");
    assert_true(out && fputs(text, out) >= 0 && fclose(out) == 0);
}

static void write_scene(const char *text) { write_text(scene_path, text); }

static void write_beside(const DataFile *file) {
    char path[160];
    const int folder = (int)(strrchr(scene_path, '/') - scene_path);
    snprintf(path, sizeof path, "%.*s/%s", folder, scene_path, file->name);
    write_text(path, file->text);
}

static int begin(void **state) {
    CpsError err;
    if (strlen(all->scene) + 1 > MOST_TEXT || make_scene_directory(state) != 0) return -1;
    for (size_t i = 0; i < all->files; i++) write_beside(&all->file[i]);
    write_scene(all->scene);
    run_scene();
    snprintf(copy, sizeof copy, "%s-copy", scene_result);
    return cps_scene_read(scene_path, NULL, &scene, &err) != CPS_OK;
}

static int end(void **state) {
    cps_scene_file_destroy(scene);
    return remove_scene_directory(state);
}

static void sound_file_is_the_scenes(void **state) {
    (void)state;
    CheckerReport report;
    CHECK_INT(checker_file(scene_result, &report, stdout), 0);
    CHECK_INT(report.certified, all->records);
    CHECK_INT(given_file(scene_result, cps_scene_file_scene(scene), stdout), 0);
}

static void copy_result(void) {
    FILE *from = fopen(scene_result, "rb"), *to = fopen(copy, "wb");
    assert_true(from && to);
    for (int c; (c = getc(from)) != EOF;) putc(c, to);
    fclose(from);
    assert_int_equal(fclose(to), 0);
}

static void check_number(const FalseNumber *number) {
    copy_result();
    CHECK_INT(sample_poke(copy, number->variable, number->index, number->value), 0);
    char *text = NULL;
    size_t size = 0;
    FILE *log = open_memstream(&text, &size);
    const int found = checker_file(copy, NULL, log),
              given = given_file(copy, cps_scene_file_scene(scene), NULL);
    fclose(log);
    const bool is_refused =
        number->finding ? found != 0 && strstr(text, number->finding) : given >= 1;
    if (!is_refused)
        fail_msg("%s[%zu] = %g: expected \"%s\", got %d and %d:\n%s", number->variable,
                 number->index, number->value,
                 number->finding ? number->finding : "not the scene's", found, given, text);
    free(text);
}

static void falsified_copies_are_refused(void **state) {
    (void)state;
    for (size_t i = 0; i < all->numbers; i++) check_number(&all->number[i]);
    remove(copy);
}

/* The text of the scene with every `from` replaced; returns how many there were. */
static int replace(const char *from, const char *to, char out[2 * MOST_TEXT]) {
    const char *rest = all->scene;
    size_t size = 0;
    int count = 0;
    for (const char *at; (at = strstr(rest, from)) != NULL; rest = at + strlen(from), count++) {
        assert_true(size + (size_t)(at - rest) + strlen(to) < MOST_TEXT);
        size += (size_t)sprintf(&out[size], "%.*s%s", (int)(at - rest), rest, to);
    }
    snprintf(&out[size], 2 * MOST_TEXT - size, "%s", rest);
    return count;
}

static void check_scene(const OtherScene *other) {
    char text[2 * MOST_TEXT];
    CpsSceneFile *file = NULL;
    CpsError err = {0};
    if (replace(other->from, other->to, text) == 0)
        fail_msg("'%s' is not in the scene", other->from);
    write_scene(text);
    if (cps_scene_read(scene_path, NULL, &file, &err) != CPS_OK) fail_msg("%s", err.message);
    if (given_file(scene_result, cps_scene_file_scene(file), NULL) < 1)
        fail_msg("'%s' is accepted in place of '%s'", other->to, other->from);
    cps_scene_file_destroy(file);
}

static void other_scenes_are_refused(void **state) {
    (void)state;
    if (all->others == 0) skip();
    for (size_t i = 0; i < all->others; i++) check_scene(&all->other[i]);
}

int falsified_main(const Falsified *given) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sound_file_is_the_scenes),
                                       cmocka_unit_test(falsified_copies_are_refused),
                                       cmocka_unit_test(other_scenes_are_refused)};
    all = given;
    return cmocka_run_group_tests(tests, begin, end);
}
