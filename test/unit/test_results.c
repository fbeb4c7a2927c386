/* SPDX-License-Identifier: BSD-3-Clause */
/* Results of small runs: text that stays text, files with the numbers of the evolution, calls in
 * the wrong order. The files are left in the working directory, where results_files.py reads them
 * with independent readers. */
#include <limits.h>
#include <locale.h>
#include <math.h>
#include <netcdf.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "capstan/results.h"
#include "io/base/text/escape.h"

/* every kind of character that some format takes for its own */
#define HOSTILE "=1+1 </title><script>\"'&\\ \x01\x1b[31m \xC2\x9B \xFF\xC3 \xE2\x98\xA0"

enum { ELEMENTS = 30, LINES = 2, CYCLE = 4 };

/* A rope on a bed pulled by its tip, and a mooring whose upper end goes back and forth. */
typedef struct Fixture {
    CpsObstacle bed;
    CpsLine line[LINES];
    CpsChange change[5];
    CpsStage stage[4];
    CpsScene scene;
} Fixture;

static const double ROPE[6] = {0, 0, 0, 6, 0, 0};

static void make_scene(Fixture *f) {
    f->bed = cps_obstacle_default();
    f->bed.name = "bed";
    f->bed.friction = 0.3;
    for (int i = 0; i < LINES; i++) {
        f->line[i] = cps_line_default();
        f->line[i].element_count = ELEMENTS;
        f->line[i].weight = 10;
        f->line[i].stiffness = 1e4;
    }
    f->line[0].name = "rope";
    f->line[0].length = 6;
    f->line[0].start =
        (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = ROPE, .axis = {0, 0, 1}};
    f->line[1].name = "mooring-2";
    f->line[1].length = 12;
    f->line[1].start.kind = CPS_START_STATIC;
    f->line[1].end[CPS_END_A] = (CpsEnd){CPS_END_KIND_HELD, {0, 4, 0}};
    f->line[1].end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {9, 4, 5}};

    f->change[0] = (CpsChange){.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_FREE, {4, 6, 5}}};
    f->change[1] = (CpsChange){.line = 1, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {9.5, 4, 5}}};
    f->change[2] = (CpsChange){.line = 1, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {8.5, 4, 5}}};
    f->change[3] = (CpsChange){.line = 1, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {9, 4, 5}}};
    f->stage[0] = (CpsStage){.cookie = cps_stage_default().cookie,
                             .name = HOSTILE,
                             .step_count = 1,
                             .change_count = 1,
                             .change = &f->change[0]};
    f->stage[1] = (CpsStage){.cookie = cps_stage_default().cookie,
                             .name = "surge out",
                             .step_count = CYCLE,
                             .change_count = 1,
                             .change = &f->change[1]};
    f->stage[2] = (CpsStage){.cookie = cps_stage_default().cookie,
                             .name = "surge in",
                             .step_count = 2 * CYCLE,
                             .change_count = 1,
                             .change = &f->change[2]};
    f->stage[3] = (CpsStage){.cookie = cps_stage_default().cookie,
                             .name = "surge home",
                             .step_count = CYCLE,
                             .change_count = 1,
                             .change = &f->change[3]};
    f->scene = cps_scene_default();
    f->scene.title = HOSTILE;
    f->scene.obstacle_count = 1;
    f->scene.obstacle = &f->bed;
    f->scene.line_count = LINES;
    f->scene.line = f->line;
    f->scene.stage_count = 4;
    f->scene.stage = f->stage;
}

static void must(CpsStatus status, const CpsError *err) {
    if (status != CPS_OK) fail_msg("%s: %s", cps_status_name(status), err->message);
}

static CpsEvolution *evolution_of(const CpsScene *scene) {
    CpsError err;
    CpsEvolution *evolution = NULL;
    must(cps_evolution_create(scene, &evolution, &err), &err);
    return evolution;
}

/* all steps into `directory`; the evolution is at its last step afterwards */
static CpsEvolution *run_into(const char *directory, const CpsScene *scene) {
    CpsError err;
    CpsResults *results = NULL;
    CpsEvolution *evolution = evolution_of(scene);
    must(cps_results_prepare(directory, CPS_RESULTS_KIND_RUN, 0, true, &err),
         &err); /* of an earlier run of this test, of whatever version */
    must(cps_results_open(directory, scene, evolution, NULL, &results, &err), &err);
    while (cps_evolution_remaining_count(evolution) > 0) {
        must(cps_evolution_step(evolution, &err), &err);
        must(cps_results_append(results, evolution, &err), &err);
    }
    must(cps_results_finish(results, 1.25, &err), &err);
    cps_results_destroy(results);
    return evolution;
}

/* what a writer prints, as a string */
#define PRINTED(call)                                       \
    {                                                       \
        printed[0] = 0; /* stays when nothing is written */ \
        FILE *out = fmemopen(printed, sizeof printed, "w"); \
        assert_non_null(out);                               \
        call;                                               \
        fclose(out);                                        \
    }

static void text_is_escaped(void **state) {
    (void)state;
    char printed[256];
    PRINTED(cpsi_write_json_string(out, "a\"\\\n\x7F\xC2\x85\xFF\xE2\x98\xA0"));
    assert_string_equal(printed, "\"a\\\"\\\\\\u000a\\u007f\\u0085\\ufffd\xE2\x98\xA0\"");
    PRINTED(cpsi_write_xml(out, "<&>\"'\x01\xED\xA0\x80z"));
    assert_string_equal(
        printed, "&lt;&amp;&gt;&quot;&#39;\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBDz");
    PRINTED(cpsi_write_csv(out, "=a,\"b\"\n"));
    assert_string_equal(printed, "\"'=a,\"\"b\"\"\xEF\xBF\xBD\"");
    PRINTED(cpsi_write_csv(out, "plain"));
    assert_string_equal(printed, "\"plain\"");
    PRINTED(cpsi_write_json_number(out, NAN));
    assert_string_equal(printed, "null");
    PRINTED(cpsi_write_csv_number(out, -INFINITY));
    assert_string_equal(printed, "");
}

/* overlong forms, surrogates, beyond U+10FFFF, cut characters; and the borders of what is
 * allowed */
static void utf8_is_judged(void **state) {
    (void)state;
    static const char *const BAD[] = {"\xC0\x80",
                                      "\xE0\x9F\xBF",
                                      "\xED\xA0\x80",
                                      "\xF0\x8F\xBF\xBF",
                                      "\xF4\x90\x80\x80",
                                      "\xF5\x80\x80\x80",
                                      "\xC3",
                                      "\xE2\x98",
                                      "\x80",
                                      "\xFF",
                                      ""};
    for (size_t i = 0; i < sizeof BAD / sizeof *BAD; i++)
        assert_int_equal(cpsi_utf8_length(BAD[i]), 0);
    assert_int_equal(cpsi_utf8_length("\x7F"), 1);
    assert_int_equal(cpsi_utf8_length("\xC2\x80"), 2);
    assert_int_equal(cpsi_utf8_length("\xEF\xBF\xBF"), 3);
    assert_int_equal(cpsi_utf8_length("\xF4\x8F\xBF\xBF"), 4);
    assert_int_equal(cpsi_utf8_cut("ab\xE2\x98\xA0", 4), 2);
    assert_int_equal(cpsi_utf8_cut("ab\xE2\x98\xA0", 5), 5);
}

static void numbers_read_back(void **state) {
    (void)state;
    char text[CPSI_NUMBER_SIZE];
    assert_string_equal(cpsi_number(text, 0.1), "0.1");
    assert_string_equal(cpsi_number(text, -0.0), "-0");
    /* bit patterns from a linear congruential generator: every exponent, denormals too */
    uint64_t bits = 1;
    for (int i = 0; i < 20000; i++) {
        bits = bits * 6364136223846793005u + 1442695040888963407u;
        double x, back;
        memcpy(&x, &bits, sizeof x);
        if (!isfinite(x)) continue;
        back = strtod(cpsi_number(text, x), NULL);
        assert_memory_equal(&x, &back, sizeof x);
    }
}

/* variable <line>_<name> of one step against `expected`, bit for bit: NaN and infinity too */
static void same_in_file(int file, const char *line, const char *name, size_t step, size_t count,
                         const double *expected) {
    char full[128];
    int id, rank, shape[3];
    size_t start[3] = {step}, length[3] = {1}, total = 1;
    snprintf(full, sizeof full, "%s_%s", line, name);
    assert_int_equal(nc_inq_varid(file, full, &id), NC_NOERR);
    assert_int_equal(nc_inq_varndims(file, id, &rank), NC_NOERR);
    assert_in_range(rank, 1, 3);
    assert_int_equal(nc_inq_vardimid(file, id, shape), NC_NOERR);
    for (int k = 1; k < rank; k++) {
        assert_int_equal(nc_inq_dimlen(file, shape[k], &length[k]), NC_NOERR);
        total *= length[k];
    }
    assert_int_equal(total, count);
    double *found = calloc(count, sizeof *found);
    assert_non_null(found);
    assert_int_equal(nc_get_vara_double(file, id, start, length, found), NC_NOERR);
    for (size_t i = 0; i < count; i++)
        if (memcmp(&found[i], &expected[i], sizeof *found) != 0)
            fail_msg("%s[%zu] is %.17g, expected %.17g", full, i, found[i], expected[i]);
    free(found);
}

static void netcdf_holds_the_last_step(void **state) {
    (void)state;
    Fixture f;
    make_scene(&f);
    CpsEvolution *evolution = run_into("results-out", &f.scene);
    int file, dimension;
    size_t steps = 0;
    assert_int_equal(nc_open("results-out/result.nc", NC_NOWRITE, &file), NC_NOERR);
    assert_int_equal(nc_inq_dimid(file, "step", &dimension), NC_NOERR);
    assert_int_equal(nc_inq_dimlen(file, dimension, &steps), NC_NOERR);
    assert_int_equal(steps, cps_evolution_step_count(evolution));
    for (int i = 0; i < LINES; i++) {
        const CpsLineView v = cps_evolution_line_view(evolution, i);
        const CpsLineReport r = cps_evolution_line_report(evolution, i);
        const size_t n = ELEMENTS + 1;
        same_in_file(file, v.name, "reference", steps - 1, 3 * n, v.reference);
        same_in_file(file, v.name, "position", steps - 1, 3 * n, v.position);
        same_in_file(file, v.name, "load", steps - 1, 3 * n, v.load);
        same_in_file(file, v.name, "normal", steps - 1, 3 * n, v.normal);
        same_in_file(file, v.name, "contact_gap", steps - 1, n, v.gap);
        same_in_file(file, v.name, "friction_bound", steps - 1, n, v.friction_bound);
        same_in_file(file, v.name, "friction_force", steps - 1, 3 * n, v.friction_force);
        same_in_file(file, v.name, "reaction", steps - 1, n, v.reaction);
        same_in_file(file, v.name, "segment_force", steps - 1, 3 * n - 3, v.segment_force);
        same_in_file(file, v.name, "tension", steps - 1, n - 1, v.tension);
        double slide[3 * (ELEMENTS + 1)] = {
            0}; /* on the bed z = 0: the horizontal displacement, its vertical part +0 */
        for (size_t k = 0; k < 3 * n; k++)
            slide[k] = k % 3 < 2 ? v.position[k] - v.reference[k] : 0;
        assert_memory_equal(v.slip, slide, sizeof slide);
        same_in_file(file, v.name, "slip", steps - 1, 3 * n, slide);
        same_in_file(file, v.name, "gap", steps - 1, 1, &r.certificate.gap);
        same_in_file(file, v.name, "tension_bound", steps - 1, 1, &r.certificate.tension_bound);
        same_in_file(file, v.name, "dissipated", steps - 1, 1, &r.dissipated);
    }
    assert_int_equal(nc_close(file), NC_NOERR);
    cps_evolution_destroy(evolution);
}

/* all numbers of a variable that does not change */
static void whole_in_file(int file, const char *name, size_t count, const double *expected) {
    double found[16];
    int id;
    assert_in_range(count, 1, 16);
    assert_int_equal(nc_inq_varid(file, name, &id), NC_NOERR);
    assert_int_equal(nc_get_var_double(file, id, found), NC_NOERR);
    assert_memory_equal(found, expected, count * sizeof *found);
}

/* obstacles of other kinds, what they turned in each step, and the way slid where the view has
 * one */
static void obstacles_are_written(void **state) {
    (void)state;
    Fixture f;
    make_scene(&f);
    CpsObstacle obstacle[2] = {f.bed, cps_obstacle_default()};
    obstacle[0].has_friction_lateral = true;
    obstacle[0].friction_lateral = 0.5;
    obstacle[0].friction_shape = CPS_FRICTION_SHAPE_BOX;
    obstacle[1].name = "drum";
    obstacle[1].kind = CPS_OBSTACLE_CYLINDER;
    obstacle[1].point[2] = 30;
    obstacle[1].radius = 2;
    obstacle[1].friction = 0.2;
    const CpsTurn turn = {1, -3};
    f.stage[1].turn = &turn;
    f.stage[1].turn_count = 1;
    f.scene.obstacle_count = 2;
    f.scene.obstacle = obstacle;
    CpsEvolution *evolution = run_into("results-obstacles", &f.scene);
    int file;
    assert_int_equal(nc_open("results-obstacles/result.nc", NC_NOWRITE, &file), NC_NOERR);
    whole_in_file(file, "obstacle_kind", 2, (double[]){0, 1});
    whole_in_file(file, "obstacle_point", 6, (double[]){0, 0, 0, 0, 0, 30});
    whole_in_file(file, "obstacle_axis", 6, (double[]){0, 0, 1, 0, 1, 0});
    whole_in_file(file, "obstacle_radius", 2, (double[]){0, 2});
    whole_in_file(file, "obstacle_friction_axial", 2, (double[]){0.3, 0.2});
    whole_in_file(file, "obstacle_friction_lateral", 2, (double[]){0.5, 0.2});
    whole_in_file(file, "obstacle_friction_shape", 2, (double[]){1, 0});
    /* the static start, the first stage, four steps of the second and twelve more */
    for (size_t step = 0; step < 18; step++)
        same_in_file(file, "obstacle", "turn", step, 2,
                     (double[]){0, step >= 2 && step < 6 ? -0.75 : 0});
    for (int i = 0; i < LINES; i++) {
        const CpsLineView v = cps_evolution_line_view(evolution, i);
        assert_non_null(v.slip);
        same_in_file(file, v.name, "slip", 17, 3 * (size_t)(ELEMENTS + 1), v.slip);
    }
    assert_int_equal(nc_close(file), NC_NOERR);
    cps_evolution_destroy(evolution);
}

/* what a variable of a .vtp begins with: its raw data, `size` bytes */
static void block_of(const char *path, const char *name, void *out, size_t size) {
    static char text[65536];
    char key[64];
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    const size_t length = fread(text, 1, sizeof text - 1, in);
    assert_int_equal(fclose(in), 0);
    snprintf(key, sizeof key, "Name=\"%s\"", name);
    const char *found = strstr(text, key), *begin = strstr(text, "encoding=\"raw\">");
    assert_true(found && begin);
    const size_t offset = strtoul(strstr(found, "offset=\"") + 8, NULL, 10);
    const char *data = strchr(begin, '_') + 1 + offset + sizeof(uint64_t);
    assert_true(data + size <= text + length);
    memcpy(out, data, size);
}

/* A rope that leans on a wall beside its bed: both contacts of its nodes in result.nc, and together
 * in the .vtp. */
static void both_contacts_are_written(void **state) {
    (void)state;
    enum { N = ELEMENTS + 1 };
    Fixture f;
    make_scene(&f);
    CpsObstacle obstacle[2] = {f.bed, f.bed};
    obstacle[1].name = "wall";
    obstacle[1].normal[1] = -1;
    obstacle[1].normal[2] = 0;
    f.scene.gravity[1] = 5;
    f.scene.obstacle_count = 2;
    f.scene.obstacle = obstacle;
    f.scene.line_count = f.scene.stage_count = 1;
    CpsEvolution *evolution = run_into("results-contacts", &f.scene);
    const CpsLineView v = cps_evolution_line_view(evolution, 0);
    double on[2 * N], force[3 * N] = {0}, in_file[3 * N];
    unsigned char rest[N];
    int file, both = 0;
    assert_int_equal(v.contact_count, 2);
    for (int c = 0; c < 2 * N; c++) {
        on[c] = v.obstacle[c];
        for (int a = 0; a < 3; a++)
            force[3 * (c % N) + a] +=
                v.reaction[c] * v.normal[3 * c + a] + v.friction_force[3 * c + a];
        both += c >= N && v.reaction[c] > 1 && v.reaction[c - N] > 1;
    }
    assert_in_range(both, ELEMENTS / 2,
                    N); /* a node weighs 2 N, of which the wall bears about 0.9 N */
    assert_int_equal(nc_open("results-contacts/result.nc", NC_NOWRITE, &file), NC_NOERR);
    same_in_file(file, "rope", "obstacle", 0, N, on);
    same_in_file(file, "rope", "obstacle_second", 0, N, on + N);
    const struct {
        const char *name;
        size_t count;
        const double *value;
    } field[] = {{"normal", 3 * N, v.normal},
                 {"contact_gap", N, v.gap},
                 {"friction_bound", N, v.friction_bound},
                 {"friction_force", 3 * N, v.friction_force},
                 {"slip", 3 * N, v.slip},
                 {"reaction", N, v.reaction}};
    for (size_t k = 0; k < sizeof field / sizeof *field; k++) {
        char name[64];
        snprintf(name, sizeof name, "%s_second", field[k].name);
        same_in_file(file, "rope", field[k].name, 0, field[k].count, field[k].value);
        same_in_file(file, "rope", name, 0, field[k].count, field[k].value + field[k].count);
    }
    assert_int_equal(nc_close(file), NC_NOERR);
    block_of("results-contacts/step-00000.vtp", "contact_force_N", in_file, sizeof in_file);
    block_of("results-contacts/step-00000.vtp", "friction_state", rest, sizeof rest);
    for (int j = 0; j < N; j++) {
        assert_int_equal(rest[j], v.state[j] > v.state[j + N] ? v.state[j] : v.state[j + N]);
        for (int a = 0; a < 3; a++)
            assert_true(fabs(in_file[3 * j + a] - force[3 * j + a]) < 1e-12); /* rounding */
    }
    /* with one obstacle nothing is added */
    int id;
    assert_int_equal(nc_open("results-out/result.nc", NC_NOWRITE, &file), NC_NOERR);
    assert_int_equal(nc_inq_varid(file, "rope_obstacle", &id), NC_ENOTVAR);
    assert_int_equal(nc_inq_varid(file, "rope_reaction_second", &id), NC_ENOTVAR);
    assert_int_equal(nc_close(file), NC_NOERR);
    cps_evolution_destroy(evolution);
}

/* a shorter run into the same place leaves nothing of the longer one, and nothing that is not ours
 * is touched */
static void earlier_files_are_displaced(void **state) {
    (void)state;
    Fixture f;
    make_scene(&f);
    cps_evolution_destroy(run_into("results-shorter", &f.scene));
    assert_int_equal(access("results-shorter/step-00016.vtp", F_OK), 0);
    assert_int_equal(access("results-shorter/loop-surge.svg", F_OK), 0);
    FILE *mine = fopen("results-shorter/step-by-step.txt", "w");
    assert_non_null(mine);
    fclose(mine);
    f.scene.stage_count = 1;
    cps_evolution_destroy(run_into("results-shorter", &f.scene));
    assert_int_equal(access("results-shorter/step-00001.vtp", F_OK), 0);
    assert_int_not_equal(access("results-shorter/step-00002.vtp", F_OK), 0);
    assert_int_not_equal(access("results-shorter/step-00016-plan.svg", F_OK), 0);
    assert_int_not_equal(access("results-shorter/loop-surge.svg", F_OK), 0);
    assert_int_equal(access("results-shorter/step-by-step.txt", F_OK), 0);
}

/* no solution: the results say so, with their proof, and are complete */
static void no_solution_is_written(void **state) {
    (void)state;
    Fixture f;
    make_scene(&f);
    f.line[1].stiffness = INFINITY;
    f.change[1].to.value[0] = 100;
    CpsEvolution *evolution = run_into("results-infeasible", &f.scene);
    assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_INFEASIBLE);
    cps_evolution_destroy(evolution);
}

/* handles that are NULL, lines that there are not, an evolution of another scene, a journal out of
 * turn */
static void what_is_not_there_is_refused(void **state) {
    (void)state;
    Fixture f;
    make_scene(&f);
    CpsError err;
    CpsEvolution *evolution = evolution_of(&f.scene), *other;
    CpsScene smaller = f.scene;
    smaller.line_count = 1;
    smaller.stage_count = 0;
    other = evolution_of(&smaller);
    assert_int_equal(cps_evolution_line_count(NULL), 0);
    assert_int_equal(cps_evolution_step_count(NULL), 0);
    assert_int_equal(cps_evolution_remaining_count(NULL), 0);
    assert_int_equal(cps_evolution_report(NULL).step_count, 0);
    assert_int_equal(cps_evolution_state_size(NULL), 0);
    cps_evolution_save(NULL, NULL);
    const int absent[] = {-1, LINES, INT_MAX, INT_MIN};
    for (size_t i = 0; i < sizeof absent / sizeof *absent; i++) {
        const CpsLineView view = cps_evolution_line_view(evolution, absent[i]);
        assert_int_equal(view.element_count, 0);
        assert_null(view.position);
        assert_int_equal(cps_evolution_line_report(evolution, absent[i]).outcome,
                         CPS_OUTCOME_STALLED);
        assert_null(cps_evolution_line_view(NULL, absent[i]).position);
    }
    CpsResults *results = NULL;
    must(cps_results_prepare("results-misuse", CPS_RESULTS_KIND_RUN, 0, true, &err), &err);
    must(cps_results_open("results-misuse", &f.scene, evolution, NULL, &results, &err), &err);
    must(cps_evolution_step(other, &err), &err);
    assert_int_equal(cps_results_append(results, other, &err), CPS_ERR_ARGUMENT);
    char missing[CPS_RESULT_NAME] = "before";
    assert_int_equal(cps_results_missing(NULL, missing, &err), CPS_ERR_ARGUMENT);
    assert_string_equal(missing, "");
    assert_int_equal(cps_results_missing("", missing, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_results_missing("results-misuse", NULL, &err), CPS_ERR_ARGUMENT);
    must(cps_results_missing("results-nowhere", missing, &err), &err);
    assert_string_equal(missing, "");
    assert_int_equal(cps_results_prepare("", CPS_RESULTS_KIND_RUN, 0, false, &err),
                     CPS_ERR_ARGUMENT);

    CpsJournal *journal = NULL;
    bool found;
    assert_int_equal(cps_journal_open("results-misuse", other, CPS_JOURNAL_NEW, &journal, &err),
                     CPS_ERR_ARGUMENT); /* has taken a step */
    must(cps_journal_open("results-misuse", evolution, CPS_JOURNAL_NEW, &journal, &err), &err);
    assert_int_equal(cps_journal_append(journal, evolution, &err),
                     CPS_ERR_ARGUMENT); /* no step yet */
    assert_int_equal(cps_journal_append(journal, other, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_journal_next(journal, other, &found, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_journal_sync(NULL, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_journal_remove(NULL, NULL), CPS_ERR_ARGUMENT);
    CpsJournal *none = NULL;
    assert_int_equal(cps_journal_open("results-misuse", evolution, (CpsJournalMode)7, &none, &err),
                     CPS_ERR_ARGUMENT);
    assert_null(none);
    cps_journal_sync_late(NULL);
    cps_journal_destroy(NULL);
    cps_journal_destroy(journal);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    cps_evolution_destroy(other);
    struct stat gone;
    assert_int_not_equal(stat("results-misuse", &gone), 0);
}

static void misuse_is_refused(void **state) {
    (void)state;
    Fixture f;
    make_scene(&f);
    CpsError err;
    CpsResults *results = NULL, *second = NULL;
    CpsEvolution *evolution = evolution_of(&f.scene);
    assert_int_equal(cps_results_open(NULL, &f.scene, evolution, NULL, &results, &err),
                     CPS_ERR_ARGUMENT);
    assert_int_equal(cps_results_open("x", &f.scene, evolution, NULL, NULL, &err),
                     CPS_ERR_ARGUMENT);
    must(cps_results_open("results-misuse", &f.scene, evolution, NULL, &results, &err), &err);
    assert_int_equal(cps_results_append(results, evolution, &err),
                     CPS_ERR_ARGUMENT); /* before the first step */
    must(cps_evolution_step(evolution, &err), &err);
    must(cps_results_append(results, evolution, &err), &err);
    assert_int_equal(cps_results_append(results, evolution, &err),
                     CPS_ERR_ARGUMENT); /* twice the same step */

    /* two writers in one place; then none of them leaves anything without a finish */
    assert_int_equal(cps_results_open("results-misuse", &f.scene, evolution, NULL, &second, &err),
                     CPS_ERR_IO);
    assert_null(second);
    cps_results_destroy(results);
    struct stat found;
    assert_int_not_equal(stat("results-misuse", &found), 0);

    assert_int_equal(cps_results_finish(NULL, 0, &err), CPS_ERR_ARGUMENT);
    cps_results_destroy(NULL);
    cps_evolution_destroy(evolution);
}

/* what is missing, of another run, or comes after the end */
static void wrong_calls_are_refused(void **state) {
    (void)state;
    Fixture f;
    make_scene(&f);
    CpsError err;
    CpsResults *results = NULL;
    CpsEvolution *evolution = evolution_of(&f.scene);
    const CpsResultsOptions zeros = {0};
    static const char DIRECTORY[] = "results-wrong";
    assert_int_equal(cps_results_open("", &f.scene, evolution, NULL, &results, &err),
                     CPS_ERR_ARGUMENT);
    assert_int_equal(cps_results_open(DIRECTORY, NULL, evolution, NULL, &results, &err),
                     CPS_ERR_ARGUMENT);
    assert_int_equal(cps_results_open(DIRECTORY, &f.scene, NULL, NULL, &results, &err),
                     CPS_ERR_ARGUMENT);
    assert_int_equal(cps_results_open(DIRECTORY, &f.scene, evolution, &zeros, &results, &err),
                     CPS_ERR_ARGUMENT);
    must(cps_results_prepare(DIRECTORY, CPS_RESULTS_KIND_RUN, 0, true, &err), &err);
    must(cps_results_open(DIRECTORY, &f.scene, evolution, NULL, &results, &err), &err);
    must(cps_evolution_step(evolution, &err), &err);
    assert_int_equal(cps_results_append(results, NULL, &err), CPS_ERR_ARGUMENT);

    /* the same number of lines, of other elements */
    Fixture g;
    make_scene(&g);
    g.line[1].element_count++;
    CpsEvolution *other = evolution_of(&g.scene);
    must(cps_evolution_step(other, &err), &err);
    assert_int_equal(cps_results_append(results, other, &err), CPS_ERR_ARGUMENT);
    cps_evolution_destroy(other);

    must(cps_results_append(results, evolution, &err), &err);
    assert_int_equal(cps_results_write_summary(results, 0, NULL, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_results_write_summary(NULL, 0, stdout, &err), CPS_ERR_ARGUMENT);
    FILE *full = fopen("/dev/full", "w");
    if (full) {
        assert_int_equal(cps_results_write_summary(results, 0, full, &err), CPS_ERR_IO);
        fclose(full);
    }
    FILE *failed = fopen("failed-before.json", "w"); /* the reason has been forgotten */
    assert_true(failed && fgetc(failed) == EOF);
    assert_int_equal(cps_results_write_summary(results, 0, failed, &err), CPS_ERR_IO);
    fclose(failed);
    remove("failed-before.json");
    must(cps_results_finish(results, 1, &err), &err);
    assert_int_equal(cps_results_finish(results, 1, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_results_append(results, evolution, &err), CPS_ERR_ARGUMENT);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
}

/* a program that lives in a country of decimal commas */
static void locale_does_not_matter(void **state) {
    (void)state;
    if (!setlocale(LC_ALL, "de_DE.UTF-8") && !setlocale(LC_ALL, "fr_FR.UTF-8")) {
        print_message("no locale with decimal commas is installed: skipped\n");
        skip();
    }
    Fixture f;
    make_scene(&f);
    cps_evolution_destroy(run_into("results-locale", &f.scene));
    setlocale(LC_ALL, "C");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_escaped),
        cmocka_unit_test(utf8_is_judged),
        cmocka_unit_test(numbers_read_back),
        cmocka_unit_test(netcdf_holds_the_last_step),
        cmocka_unit_test(obstacles_are_written),
        cmocka_unit_test(both_contacts_are_written),
        cmocka_unit_test(earlier_files_are_displaced),
        cmocka_unit_test(no_solution_is_written),
        cmocka_unit_test(what_is_not_there_is_refused),
        cmocka_unit_test(misuse_is_refused),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(locale_does_not_matter),
    };
    return cmocka_run_group_tests_name("results", tests, NULL, NULL);
}
