/* SPDX-License-Identifier: BSD-3-Clause */
/* A saved state with any of its bytes changed: it is refused with a reason and nothing of it stays,
 * or it is taken as it is. The state is that of a warm step; one line has sections, one is
 * inextensible, one goes round a post and one begins with its statics. */
#define _GNU_SOURCE /* memmem */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

#include "capstan/evolve.h"
#include "capstan/io.h"

static const char SCENE[] =
    "capstan: 1\n"
    "types: {chain: {weight: 1, stiffness: 100}, wire: {weight: 0.5, stiffness: 200}}\n"
    "obstacles: {bed: {plane: {}, friction: 0.5},\n"
    "  post: {cylinder: {point: [1, 1, 0], axis: [0, 0, 1], radius: 0.5}, friction: 0.1}}\n"
    "lines:\n"
    "  made: {sections: [{type: chain, length: 1, elements: 2}, {type: wire, length: 1,"
    " elements: 2}], point_weights: [{at: 1, weight: 0.5}],"
    " start: {straight: {from: [0, 0, 0], to: [2, 0, 0]}}, ends: {A: held, B: free}}\n"
    "  rod: {length: 1, elements: 2, weight: 1, stiffness: .inf,"
    " start: {straight: {from: [0, -1, 0], to: [1, -1, 0]}}, ends: {A: held, B: held}}\n"
    "  turn: {length: 1.6, elements: 6, weight: 0.1, stiffness: 1e3,"
    " start: {straight: {from: [0.2, 0.48, 0.5], to: [1.8, 0.48, 0.5]}},"
    " ends: {A: held, B: {force: [2, 1, 0]}}}\n"
    "  sag: {length: 2.2, elements: 3, weight: 1, stiffness: 1e3, start: static,"
    " ends: {A: {held: [0, -5, 0]}, B: {held: [2, -5, 1]}}}\n"
    "history: [{name: a, steps: 5, made.B: {force: [1, 0.5, 0]}, turn.B: {force: [3, 1.5, 0]},"
    " sag.B: {position: [2.1, -5, 1]}}]\n";

/* magic, size, fingerprint and the hashes of the history and of its past, which are compared */
enum { HEAD = 40, STEPS = 4 };

typedef struct Saved {
    CpsEvolution *evolution, *other; /* at STEPS, which is never changed, and the one that loads */
    size_t size;
    unsigned char *good, *changed, *kept, *now;
} Saved;

static CpsEvolution *evolution_at(int steps) {
    char path[] = "state_check_test_XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, SCENE, sizeof SCENE - 1), sizeof SCENE - 1);
    close(fd);
    CpsSceneFile *file = NULL;
    CpsEvolution *evolution = NULL;
    CpsError err = {0};
    CpsStatus status = cps_scene_read(path, NULL, &file, &err);
    unlink(path);
    if (!status) status = cps_evolution_create(cps_scene_file_scene(file), &evolution, &err);
    if (status) fail_msg("%d:%d: %s", err.line, err.column, err.message);
    cps_scene_file_destroy(file);
    while (steps-- > 0) CHECK_INT(cps_evolution_step(evolution, NULL), CPS_OK);
    return evolution;
}

static int set_up(void **state) {
    Saved *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->evolution = evolution_at(STEPS);
    s->other = evolution_at(1);
    s->size = cps_evolution_state_size(s->evolution);
    unsigned char **const buffer[] = {&s->good, &s->changed, &s->kept, &s->now};
    for (size_t i = 0; i < sizeof buffer / sizeof *buffer; i++) {
        *buffer[i] = malloc(s->size);
        assert_non_null(*buffer[i]);
    }
    cps_evolution_save(s->evolution, s->good);
    cps_evolution_save(s->other, s->kept);
    *state = s;
    return 0;
}

static int tear_down(void **state) {
    Saved *s = *state;
    cps_evolution_destroy(s->evolution);
    cps_evolution_destroy(s->other);
    free(s->good);
    free(s->changed);
    free(s->kept);
    free(s->now);
    free(s);
    return 0;
}

/* Loads the good state with `count` bytes at `at` replaced. The reason for which it is refused,
 * NULL where it is not. */
static const char *try_change(Saved *s, size_t at, const void *bytes, size_t count) {
    static CpsError err;
    memcpy(s->changed, s->good, s->size);
    memcpy(s->changed + at, bytes, count);
    const CpsStatus status = cps_evolution_load(s->other, s->changed, s->size, &err);
    cps_evolution_save(s->other, s->now);
    if (status != CPS_OK) {
        CHECK_INT(status, CPS_ERR_ARGUMENT);
        if (memcmp(s->now, s->kept, s->size) != 0) fail_msg("byte %zu: something stays", at);
        const char *reason = strstr(err.message, "the saved state is damaged: ");
        if (!reason) fail_msg("byte %zu: %s", at, err.message);
        return reason + strlen("the saved state is damaged: ");
    }
    /* any flag but 0 is read as 1 */
    for (size_t i = 0; i < s->size; i++)
        if (s->now[i] != s->changed[i] && !(s->now[i] == 1 && s->changed[i] != 0))
            fail_msg("byte %zu changed: byte %zu is not what was loaded", at, i);
    CHECK_INT(cps_evolution_load(s->other, s->kept, s->size, NULL), CPS_OK);
    return NULL;
}

static void the_state_is_that_of_a_warm_step(void **state) {
    const Saved *s = *state;
    for (int line = 0; line < 4; line++) {
        const CpsLineReport report = cps_evolution_line_report(s->evolution, line);
        assert_true(line == 1 || report.warm_count > 0);
    }
}

static const char *const REASON[] = {
    "it stands at a step that the history does not have",
    "its report is none of a step",
    "an end is let go that there is not, or in no way",
    "an end comes from nowhere",
    "an obstacle is at no place",
    "its time is none",
    "its gravity is not finite",
    "an end is neither held nor free, or at no place",
    "a node is grasped that cannot be, or at no place",
    "the report of a line is none",
    "a contact is with an obstacle that there is not, or in no state",
    "a number is not finite"};
enum { REASONS = sizeof REASON / sizeof *REASON };

static int reason_of(const char *text) {
    for (int i = 0; i < REASONS; i++)
        if (strcmp(text, REASON[i]) == 0) return i;
    fail_msg("an unknown reason: %s", text);
    return 0;
}

/* Numbers and counts that no run writes, at every byte. */
static void every_byte_is_checked(void **state) {
    static const int COUNT[] = {INT_MIN, -1, 7, 1000000, INT_MAX};
    static const double NUMBER[] = {NAN, INFINITY, -INFINITY, 1};
    static const unsigned char BYTE[] = {2, 0xff};
    Saved *s = *state;
    int refused[REASONS] = {0}, accepted = 0;
    for (size_t at = HEAD; at < s->size; at++) {
        for (size_t k = 0; k < 11; k++) {
            const void *bytes = k < 5   ? (const void *)&COUNT[k]
                                : k < 9 ? (const void *)&NUMBER[k - 5]
                                        : (const void *)&BYTE[k - 9];
            const size_t count = k < 5 ? sizeof *COUNT : k < 9 ? sizeof *NUMBER : 1;
            if (at + count > s->size) continue;
            const char *reason = try_change(s, at, bytes, count);
            if (reason)
                refused[reason_of(reason)]++;
            else
                accepted++;
        }
    }
    for (int i = 0; i < REASONS; i++) {
        print_message("%6d refused: %s\n", refused[i], REASON[i]);
        assert_true(refused[i] > 0);
    }
    print_message("%6d accepted\n", accepted);
}

static int arrays_tried;

static bool is_zero(const double *array, int count) {
    for (int i = 0; i < count; i++)
        if (array[i] != 0) return false;
    return true;
}

/* Every number of an array that the next step begins from. One of zeros could be found anywhere. */
static void expect_finite(Saved *s, const double *array, int count, const char *what) {
    if (is_zero(array, count)) return;
    static const double NOT_FINITE[] = {NAN, INFINITY, -INFINITY};
    const size_t bytes = (size_t)count * sizeof *array;
    const unsigned char *found = memmem(s->good, s->size, array, bytes);
    if (!found) fail_msg("%s: not in the state", what);
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            if (!try_change(s, (size_t)(found - s->good) + (size_t)i * sizeof *array,
                            &NOT_FINITE[k], sizeof *array))
                fail_msg("%s, number %d, %g: %g is accepted", what, i, array[i], NOT_FINITE[k]);
    arrays_tried++;
}

static void what_steps_begin_from_is_finite(void **state) {
    Saved *s = *state;
    for (int line = 0; line < cps_evolution_line_count(s->evolution); line++) {
        const CpsLineView view = cps_evolution_line_view(s->evolution, line);
        const int n = view.element_count + 1;
        expect_finite(s, view.position, 3 * n, "position");
        expect_finite(s, view.segment_force, 3 * (n - 1), "segment force");
        expect_finite(s, view.tension, n - 1, "tension");
        expect_finite(s, view.friction_bound, view.contact_count * n, "friction bound");
        expect_finite(s, view.friction_force, 3 * view.contact_count * n, "friction force");
        expect_finite(s, view.normal, 3 * view.contact_count * n, "normal");
        expect_finite(s, view.reaction, view.contact_count * n, "reaction");
        expect_finite(s, view.reference, 3 * n, "reference");
        expect_finite(s, view.load, 3 * n, "load");
    }
    assert_true(arrays_tried > 25); /* of four lines, 9 each */
}

static void what_is_no_state_is_refused(void **state) {
    Saved *s = *state;
    CpsError err;
    CHECK_INT(cps_evolution_load(NULL, s->good, s->size, &err), CPS_ERR_ARGUMENT);
    CHECK_INT(cps_evolution_load(s->other, NULL, s->size, &err), CPS_ERR_ARGUMENT);
    CHECK_INT(cps_evolution_load(s->other, s->good, HEAD - 1, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "cut short"));
    CHECK_INT(cps_evolution_load(s->other, s->good, s->size - 1, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "bytes, expected"));
    memcpy(s->changed, s->good, s->size);
    s->changed[8]++; /* the size that the state itself names */
    CHECK_INT(cps_evolution_load(s->other, s->changed, s->size, &err), CPS_ERR_ARGUMENT);
    memcpy(s->changed, s->good, s->size);
    s->changed[HEAD - 1] ^= 1; /* the stages that it has taken */
    CHECK_INT(cps_evolution_load(s->other, s->changed, s->size, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "other stages"));
    cps_evolution_save(s->other, s->now);
    assert_memory_equal(s->now, s->kept, s->size);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_state_is_that_of_a_warm_step),
                                       cmocka_unit_test(every_byte_is_checked),
                                       cmocka_unit_test(what_steps_begin_from_is_finite),
                                       cmocka_unit_test(what_is_no_state_is_refused)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
