/* SPDX-License-Identifier: BSD-3-Clause */
/* As test_misuse.c, for the library that reads and writes files. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/io.h"
#include "capstan/results.h"
#include "misuse.h"

static const double ONE[9] = {1};
static CpsError err;
static volatile int i; /* of loops, which a crash must not disturb, as what follows */
static const CpsDriveFile *volatile given;

static void scenes(void **state) {
    (void)state;
    CpsSceneFile *file = NULL;
    const CpsReadLimits none = {0}, negative = {.cookie = cps_read_limits_default().cookie,
                                                .max_bytes = 1000,
                                                .max_depth = -1,
                                                .max_elements = -1,
                                                .max_steps = -1};
    REFUSED(cps_scene_read(NULL, NULL, &file, &err));
    REFUSED(cps_scene_read("", NULL, NULL, &err));
    REFUSED(cps_scene_read_text(NULL, "", NULL, &file, &err));
    REFUSED(cps_scene_read_text("", NULL, NULL, &file, &err));
    REFUSED(cps_scene_read_text("", "", NULL, NULL, &err));
    GIVES(cps_scene_read_text("", "a text", NULL, &file, &err) == CPS_ERR_INPUT && file == NULL &&
          strcmp(err.file, "a text") == 0);
    GIVES(cps_scene_read("/nowhere/at/all.yaml", &none, &file, &err) != CPS_OK && file == NULL &&
          err.message[0]);
    GIVES(cps_scene_read(THIS_FILE, &none, &file, &err) != CPS_OK && file == NULL &&
          err.message[0]);
    GIVES(cps_scene_read(THIS_FILE, &negative, &file, &err) != CPS_OK && file == NULL &&
          err.message[0]);
    const CpsReadLimits sound = cps_read_limits_default();
    for (i = 0; i < 5; ++i) {
        CpsReadLimits limits = sound;
        if (i == 0) limits.max_bytes = 0;
        if (i == 1) limits.max_depth = 0;
        if (i == 2) limits.max_elements = 0;
        if (i == 3) limits.max_pairs = 0;
        if (i == 4) limits.max_steps = 0;
        REFUSED(cps_scene_read(THIS_FILE, &limits, &file, &err));
    }
    RUNS(cps_scene_file_destroy(NULL));
    GIVES(cps_scene_file_scene(NULL) == NULL);
    REFUSED(cps_scene_write_schema(NULL, &err));
    double value;
    const char *rest;
    CpsSuggestion suggestion = {0};
    GIVES(cps_row_read(NULL, ",", 1, &value, &rest) == 0);
    GIVES(cps_row_read("1", NULL, 1, &value, &rest) == 0);
    GIVES(cps_row_read("1", ",", 1, NULL, &rest) == 0);
    GIVES(cps_row_read("1", ",", 1, &value, NULL) == 0);
    RUNS(cps_suggest(NULL, "word"));
    RUNS(cps_suggest(&suggestion, "word"));
    suggestion.word = "word";
    RUNS(cps_suggest(&suggestion, NULL));
    GIVES(suggestion.best == NULL);
}

static void results(void **state) {
    (void)state;
    CpsResults *opened = NULL;
    CpsJournal *journal = NULL;
    bool found;
    const CpsResultsOptions zeros = {0};
    CpsResultsOptions options = cps_results_options_default();
    GIVES(cps_results_check_options(&options, &err) == CPS_OK);
    options.fields = "no such field";
    REFUSED(cps_results_check_options(&zeros, &err)); /* not begun as the default */
    const CpsScene scene = cps_scene_default();
    REFUSED(cps_results_open(NULL, &scene, NULL, NULL, &opened, &err));
    REFUSED(cps_results_open("results-misuse-io", NULL, NULL, NULL, &opened, &err));
    REFUSED(cps_results_open("results-misuse-io", &scene, NULL, NULL, &opened, &err));
    REFUSED(cps_results_open("results-misuse-io", &scene, NULL, &options, NULL, &err));
    REFUSED(cps_results_check_options(&options, &err));
    GIVES(cps_results_check_options(NULL, &err) == CPS_OK);
    REFUSED(cps_results_prepare(NULL, CPS_RESULTS_KIND_RUN, 0, false, &err));
    REFUSED(cps_results_prepare("", CPS_RESULTS_KIND_RUN, 0, true, &err));
    REFUSED(cps_results_prepare("results-misuse-io", (CpsResultsKind)-1, 0, false, &err));
    REFUSED(cps_results_prepare("results-misuse-io", (CpsResultsKind)6, 0, false, &err));
    REFUSED(
        cps_results_prepare("results-misuse-io", CPS_RESULTS_KIND_REGULARIZED, -1, false, &err));
    REFUSED(cps_results_append(NULL, NULL, &err));
    REFUSED(cps_results_finish(NULL, 0, &err));
    RUNS(cps_results_destroy(NULL));
    REFUSED(cps_results_write_summary(NULL, 0, stdout, &err));
    REFUSED(cps_journal_open(NULL, NULL, CPS_JOURNAL_NEW, &journal, &err));
    REFUSED(cps_journal_open("results-misuse-io", NULL, CPS_JOURNAL_NEW, &journal, &err));
    REFUSED(cps_journal_open("results-misuse-io", NULL, CPS_JOURNAL_NEW, NULL, &err));
    REFUSED(cps_journal_next(NULL, NULL, &found, &err));
    REFUSED(cps_journal_append(NULL, NULL, &err));
    REFUSED(cps_journal_sync(NULL, &err));
    RUNS(cps_journal_sync_late(NULL));
    REFUSED(cps_journal_remove(NULL, &err));
    RUNS(cps_journal_destroy(NULL));
}

static void studies(void **state) {
    (void)state;
    const CpsStudyFiles files = {.cookie = cps_study_files_default().cookie,
                                 .title = "nothing of it"};
    const CpsMethodHistory method = {"one", ONE}, empty = {NULL, NULL};
    const char *const names[2] = {"a", NULL}, *const unnamed[1] = {NULL};
    const CpsLineView nothing = {0};
    const CpsCompletedLine line = {.cookie = cps_completed_line_default().cookie,
                                   .title = "nothing of it",
                                   .view = &nothing};
    CpsRegularizedRun run = {.cookie = cps_regularized_run_default().cookie,
                             .title = "nothing of it",
                             .step_count = 1,
                             .line_count = 1,
                             .step_name = names};
    const CpsRegularizedLine bare = {.name = NULL};
    REFUSED(cps_study_write(NULL, &files, &err));
    REFUSED(cps_study_write("results-misuse-io", NULL, &err));
    REFUSED(cps_study_write("results-misuse-io", &files, &err));
    REFUSED(cps_methods_write(NULL, "", 1, &method, 1, 2, names, &err));
    REFUSED(cps_methods_write("results-misuse-io", NULL, 1, &method, 1, 2, names, &err));
    REFUSED(cps_methods_write("results-misuse-io", "", 1, NULL, 1, 2, names, &err));
    REFUSED(cps_methods_write("results-misuse-io", "", 1, &empty, 1, 2, names, &err));
    REFUSED(cps_methods_write("results-misuse-io", "", 1, &method, 1, 2, NULL, &err));
    REFUSED(cps_methods_write("results-misuse-io", "", 1, &method, 1, 2, unnamed, &err));
    REFUSED(cps_methods_write("results-misuse-io", "", 0, &method, 1, 2, names, &err));
    REFUSED(cps_methods_write("results-misuse-io", "", 5, &method, 1, 2, names, &err));
    REFUSED(cps_methods_write("results-misuse-io", "", 1, &method, 0, 2, names, &err));
    REFUSED(cps_methods_write("results-misuse-io", "", 1, &method, 1, 1, names, &err));
    REFUSED(cps_completed_write(NULL, &line, &err));
    REFUSED(cps_completed_write("results-misuse-io", NULL, &err));
    REFUSED(cps_completed_write("results-misuse-io", &line, &err));
    REFUSED(cps_regularized_write(NULL, &run, &err));
    REFUSED(cps_regularized_write("results-misuse-io", NULL, &err));
    REFUSED(cps_regularized_write("results-misuse-io", &run, &err));
    run.line = &bare;
    REFUSED(cps_regularized_write("results-misuse-io", &run, &err));
    REFUSED(cps_regularized_summary(NULL, stdout, &err));
    REFUSED(cps_regularized_summary(&run, NULL, &err));
}

/* `call` without one member of what it is given, which has all the others. */
#define WITHOUT(type, whole, member, call)               \
    do {                                                 \
        type given_ = whole;                             \
        memset(&given_.member, 0, sizeof given_.member); \
        REFUSED(call);                                   \
    } while (0)

/* Each thing that a writer needs is missing in turn. None of them gets as far as a file. */
static void one_thing_missing(void **state) {
    (void)state;
    static const char DIRECTORY[] = "results-misuse-io";
    const char *const names[1] = {"a"}, *const unnamed[1] = {NULL};
    const CpsRegularizedParameters parameters = {0};
    const CpsRegularizedReport report = {0};
    const CpsRegularizedLine line = {.name = "a",
                                     .point_count = 2,
                                     .position = ONE,
                                     .parameters = &parameters,
                                     .report = &report};
    const CpsRegularizedRun run = {.cookie = cps_regularized_run_default().cookie,
                                   .title = "",
                                   .step_count = 1,
                                   .line_count = 1,
                                   .step_name = names,
                                   .line = &line};
    WITHOUT(CpsRegularizedRun, run, cookie, cps_regularized_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsRegularizedRun, run, title, cps_regularized_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsRegularizedRun, run, step_count, cps_regularized_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsRegularizedRun, run, line_count, cps_regularized_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsRegularizedRun, run, step_name, cps_regularized_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsRegularizedRun, run, line, cps_regularized_write(DIRECTORY, &given_, &err));
    REFUSED(cps_regularized_write(NULL, &run, &err));
    REFUSED(cps_regularized_summary(&run, NULL, &err));
    CpsRegularizedRun other = run;
    other.step_name = unnamed;
    REFUSED(cps_regularized_write(DIRECTORY, &other, &err));
    other = run;
#define WITHOUT_OF_LINE(member)                                  \
    do {                                                         \
        CpsRegularizedLine part_ = line;                         \
        memset(&part_.member, 0, sizeof part_.member);           \
        other.line = &part_;                                     \
        REFUSED(cps_regularized_write(DIRECTORY, &other, &err)); \
    } while (0)
    WITHOUT_OF_LINE(name);
    WITHOUT_OF_LINE(point_count);
    WITHOUT_OF_LINE(position);
    WITHOUT_OF_LINE(parameters);
    WITHOUT_OF_LINE(report);

    /* pointers that are refused or handed on, and never looked into */
    const CpsLineView view = {0};
    const CpsCompletedLine completed = {.cookie = cps_completed_line_default().cookie,
                                        .title = "",
                                        .view = &view,
                                        .position = {ONE, ONE, ONE},
                                        .chosen = 0};
    WITHOUT(CpsCompletedLine, completed, cookie, cps_completed_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsCompletedLine, completed, title, cps_completed_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsCompletedLine, completed, view, cps_completed_write(DIRECTORY, &given_, &err));
    for (i = 0; i < CPS_COMPLETION_COUNT; i++)
        WITHOUT(CpsCompletedLine, completed, position[i],
                cps_completed_write(DIRECTORY, &given_, &err));
    CpsCompletedLine unchosen = completed;
    unchosen.chosen = CPS_COMPLETION_COUNT;
    REFUSED(cps_completed_write(DIRECTORY, &unchosen, &err));
    const CpsMethodHistory placeless = {"one", NULL}, nameless = {NULL, ONE}, whole = {"one", ONE};
    REFUSED(cps_methods_write(DIRECTORY, "", 1, &placeless, 1, 2, names, &err));
    REFUSED(cps_methods_write(DIRECTORY, "", 1, &nameless, 1, 2, names, &err));
    REFUSED(cps_methods_write(DIRECTORY, "", 1, &whole, 1, 2, unnamed, &err));
    const CpsStudyFiles files = {.cookie = cps_study_files_default().cookie,
                                 .title = "",
                                 .regularized = (const void *)ONE,
                                 .study = (const void *)ONE,
                                 .first_order = (const void *)ONE};
    WITHOUT(CpsStudyFiles, files, cookie, cps_study_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsStudyFiles, files, title, cps_study_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsStudyFiles, files, regularized, cps_study_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsStudyFiles, files, study, cps_study_write(DIRECTORY, &given_, &err));
    WITHOUT(CpsStudyFiles, files, first_order, cps_study_write(DIRECTORY, &given_, &err));
}

static void laws(void **state) {
    (void)state;
    CpsLawFile *file = NULL;
    CpsComposition composition;
    int line;
    enum { AXES = 5 };
    static const int AXIS[AXES][2] = {{0, 7}, {7, 0}, {-1, 0}, {0, -1}, {1, 1}};
    CpsLawPicture axes = cps_law_picture_default();
    CpsLawPicture picture = axes, missing = axes, forces = axes;
    const CpsLawPicture untitled = axes;
    picture.title = missing.title = "";
    missing.velocity_count = missing.force_count = forces.force_count = 2;
    CpsSet *disc = NULL;
    CpsLaw *law = NULL;
    CpsResistance *resistance = NULL;
    SOUND(cps_set_ball(2, NULL, 1, &disc, &err));
    SOUND(cps_law_friction(disc, &law, &err));
    SOUND(cps_resistance_dry(law, &resistance, &err));
    FILE *out = tmpfile();
    assert_non_null(out);
    REFUSED(cps_law_read(NULL, NULL, &file, &err));
    REFUSED(cps_law_read("", NULL, NULL, &err));
    REFUSED(cps_law_read_text(NULL, "", NULL, &file, &err));
    REFUSED(cps_law_read_text("", NULL, NULL, &file, &err));
    REFUSED(cps_law_read_text("", "", NULL, NULL, &err));
    RUNS(cps_law_file_destroy(NULL));
    GIVES(strcmp(cps_law_file_title(NULL), "") == 0 && cps_law_file_space(NULL) == 0 &&
          cps_law_file_set(NULL) == NULL);
    GIVES(cps_law_file_loaded(NULL) == NULL && cps_law_file_resistance(NULL) == NULL);
    GIVES(!cps_law_file_composition(NULL, &composition, &line));
    REFUSED(cps_law_write_schema(NULL, &err));
    const CpsLawPicture bare = {.title = "", .axis = {0, 1}};
    REFUSED(cps_law_draw(disc, &bare, out, &err));
    REFUSED(cps_law_draw(NULL, &picture, out, &err));
    REFUSED(cps_law_draw(disc, NULL, out, &err));
    REFUSED(cps_law_draw(disc, &picture, NULL, &err));
    REFUSED(cps_resistance_draw(NULL, &picture, out, &err));
    REFUSED(cps_resistance_draw(resistance, NULL, out, &err));
    REFUSED(cps_resistance_draw(resistance, &picture, NULL, &err));
    for (i = 0; i < AXES; ++i) {
        memcpy(axes.axis, AXIS[i], sizeof axes.axis);
        REFUSED(cps_law_draw(disc, &axes, out, &err));
        REFUSED(cps_resistance_draw(resistance, &axes, out, &err));
    }
    CpsLawPicture negative = cps_law_picture_default();
    negative.axis[1] = 1;
    negative.velocity_count = -1;
    REFUSED(cps_law_draw(disc, &negative, out, &err));
    negative.velocity_count = 0;
    negative.force_count = INT_MIN;
    REFUSED(cps_resistance_draw(resistance, &negative, out, &err));
    REFUSED(cps_law_draw(disc, &missing, out, &err));
    REFUSED(cps_law_draw(disc, &forces, out, &err));
    REFUSED(cps_resistance_draw(resistance, &missing, out, &err));
    REFUSED(cps_resistance_draw(resistance, &forces, out, &err));
    GIVES(cps_law_draw(disc, &untitled, out, &err) == CPS_OK || err.message[0]);
    GIVES(cps_resistance_draw(resistance, &untitled, out, &err) == CPS_OK || err.message[0]);
    fclose(out);
    cps_resistance_release(resistance);
    cps_law_release(law);
    cps_set_release(disc);
}

static void drives(void **state) {
    (void)state;
    static const CpsDriveKind KIND[] = {CPS_DRIVE_SYSTEM, CPS_DRIVE_BODY,  CPS_DRIVE_PLANIMETER,
                                        CPS_DRIVE_ROPE,   CPS_DRIVE_SWEEP, (CpsDriveKind)77};
    CpsDriveFile *file = NULL, empty = {.title = ""};
    const CpsPlanimeterReading reading = {0};
    double walked[4];
    FILE *out = tmpfile();
    assert_non_null(out);
    REFUSED(cps_drive_read(NULL, NULL, &file, &err));
    REFUSED(cps_drive_read("", NULL, NULL, &err));
    REFUSED(cps_drive_read_text(NULL, "", NULL, &file, &err));
    REFUSED(cps_drive_read_text("", NULL, NULL, &file, &err));
    REFUSED(cps_drive_read_text("", "", NULL, NULL, &err));
    RUNS(cps_drive_file_destroy(NULL));
    REFUSED(cps_drive_write_schema(NULL, &err));
    RUNS(cps_drive_walk(2, 2, NULL, 2, walked));
    RUNS(cps_drive_walk(2, 2, ONE, 2, NULL));
    RUNS(cps_drive_walk(2, 0, ONE, 2, walked));
    RUNS(cps_drive_walk(2, 1, ONE, 2, walked));
    RUNS(cps_drive_walk(2, 2, ONE, -1, walked));
    RUNS(cps_drive_walk(-1, 2, ONE, 2, walked));
    RUNS(cps_drive_walk(2, INT_MIN, ONE, INT_MIN, walked));
    /* a file that is not there, of another kind, or with nothing in it */
    for (i = -1; i < 6; ++i) {
        if (i >= 0) empty.kind = KIND[i];
        given = i < 0 ? NULL : &empty;
        REFUSED(cps_drive_draw_system(given, NULL, NULL, out, &err));
        REFUSED(cps_drive_draw_body(given, 0, NULL, NULL, out, &err));
        REFUSED(cps_drive_draw_planimeter(given, &reading, out, &err));
        REFUSED(cps_drive_draw_planimeter(given, NULL, out, &err));
        REFUSED(cps_drive_draw_rope(given, NULL, 0, NULL, out, &err));
        REFUSED(cps_drive_draw_sweep(given, 2, ONE, ONE, ONE, out, &err));
        REFUSED(cps_drive_draw_sweep(given, 2, NULL, NULL, NULL, out, &err));
    }
    fclose(out);
}

static void clear(void **state) {
    (void)state;
    all_were_refused();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes),  cmocka_unit_test(results),
        cmocka_unit_test(studies), cmocka_unit_test(one_thing_missing),
        cmocka_unit_test(laws),    cmocka_unit_test(drives),
        cmocka_unit_test(clear),
    };
    return cmocka_run_group_tests_name("misuse of files", tests, NULL, NULL);
}
