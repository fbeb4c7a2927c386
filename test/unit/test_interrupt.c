/* SPDX-License-Identifier: BSD-3-Clause */
/* A load step that is interrupted has no effect: whenever that happens, the evolution is in the
 * state before the step, and continues from there with the same bits as without the
 * interruption. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "capstan/evolve.h"
#include "capstan/io.h"
#include "check.h"

/* How often a step asks, and when it is told to end. */
typedef struct Asked {
    int count, ends_at; /* ends_at < 0: never */
} Asked;

static bool asked(void *user) {
    Asked *of = user;
    return of->count++ == of->ends_at;
}

/* Statics, several lines, a drum that turns; */
static const char WINCH[] =
    "capstan: 1\n"
    "obstacles: {drum: {cylinder: {point: [0, 0, 2], axis: [0, 1, 0], radius: 0.25}, friction: "
    "0.4}, bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}}\n"
    "lines:\n"
    "  rope: {length: 1.5, elements: 24, mass: 0.2, stiffness: 1e5, start: {arc: {from: [-0.25, 0, "
    "2], centre: [0, 0, 2], axis: [0, 1, 0]}},\n"
    "    ends: {A: {force: [0, 0, -60]}, B: {force: [0, 0, -150]}}}\n"
    "  line: {length: 3, elements: 16, weight: 2, stiffness: 1e4, start: static, ends: {A: {held: "
    "[3, 0, 0]}, B: {held: [5, 0, 1.5]}}}\n"
    "friction_policy: consistent\n"
    "history: [{name: load}, {name: lift, steps: 2, drum.turn: -20, line.B: {position: [5, 1, "
    "1.5]}}]\n";

/* an inextensible line that jumps on a grooved slope, which is gone as overdamped motion and in
 * many parts. */
static const char JUMPS[] =
    "capstan: 1\n"
    "gravity: [-2.66, 2.76, 9.03]\n"
    "obstacles: {bed: {plane: {point: [4.3675, -5.0367, -6.6718], normal: [0.271165, -0.28125, "
    "-0.920526]}, friction: {axial: 0.5886, lateral: 0}}}\n"
    "lines: {a: {length: 0.9049163, elements: 8, weight: 1.105, stiffness: .inf, start: {polyline: "
    "[[4.3675, -5.0367, -6.6718], [4.46767, -4.79575, -6.71597],\n"
    "  [4.88336, -4.62269, -6.64639], [4.96346, -4.77373, -6.57665]]}, ends: {A: held, B: "
    "free}}}\n"
    "history: [{name: s0, a.B: {force: [-0.238, 0.349, -0.177]}}]\n"
    "friction_policy: consistent\n";

static CpsSceneFile *read_text(const char *text) {
    char path[] = "/tmp/capstan-interrupt-XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0 && write(fd, text, strlen(text)) == (ssize_t)strlen(text));
    close(fd);
    CpsSceneFile *file = NULL;
    CpsError err;
    if (cps_scene_read(path, NULL, &file, &err) != CPS_OK)
        print_error("%d:%d: %s\n", err.line, err.column, err.message);
    unlink(path);
    assert_non_null(file);
    return file;
}

static CpsEvolution *begin(CpsSceneFile *file, Asked *by) {
    CpsEvolution *evolution = NULL;
    assert_int_equal(cps_evolution_create(cps_scene_file_scene(file), &evolution, NULL), CPS_OK);
    if (by) assert_int_equal(cps_evolution_interrupt(evolution, asked, by, NULL), CPS_OK);
    return evolution;
}

static void *saved(const CpsEvolution *evolution) {
    void *state = malloc(cps_evolution_state_size(evolution));
    assert_non_null(state);
    cps_evolution_save(evolution, state);
    return state;
}

static void same_numbers(const double *a, const double *b, int count) {
    assert_memory_equal(a, b, (size_t)count * sizeof *a);
}

/* Places, forces and figures of the last step, bit by bit. */
static void expect_same(const CpsEvolution *a, const CpsEvolution *b) {
    for (int i = 0; i < cps_evolution_line_count(a); i++) {
        const CpsLineView x = cps_evolution_line_view(a, i), y = cps_evolution_line_view(b, i);
        const CpsLineReport p = cps_evolution_line_report(a, i),
                            q = cps_evolution_line_report(b, i);
        const int n = x.element_count + 1;
        same_numbers(x.position, y.position, 3 * n);
        same_numbers(x.reference, y.reference, 3 * n);
        same_numbers(x.segment_force, y.segment_force, 3 * x.element_count);
        same_numbers(x.tension, y.tension, x.element_count);
        same_numbers(x.friction_force, y.friction_force, 3 * x.contact_count * n);
        same_numbers(x.reaction, y.reaction, x.contact_count * n);
        assert_memory_equal(x.state, y.state, (size_t)(x.contact_count * n));
        CHECK_INT((int)p.outcome, (int)q.outcome);
        CHECK_INT(p.iteration_count, q.iteration_count);
        CHECK_INT(p.substep_count, q.substep_count);
        same_numbers(&p.dissipated, &q.dissipated, 1);
        same_numbers(&p.certificate.gap, &q.certificate.gap, 1);
        same_numbers(&p.ledger.imbalance, &q.ledger.imbalance, 1);
    }
}

/* Steps that are asked and never end early have the bits of those that are not; how often each
 * asks. */
static int count_asks(CpsSceneFile *file, int count[], int most) {
    Asked by = {.ends_at = -1};
    CpsEvolution *plain = begin(file, NULL), *watched = begin(file, &by);
    int steps = 0;
    for (; cps_evolution_remaining_count(plain) > 0; steps++) {
        assert_true(steps < most);
        by.count = 0;
        assert_int_equal(cps_evolution_step(plain, NULL), CPS_OK);
        assert_int_equal(cps_evolution_step(watched, NULL), CPS_OK);
        expect_same(plain, watched);
        count[steps] = by.count;
    }
    cps_evolution_destroy(plain);
    cps_evolution_destroy(watched);
    return steps;
}

/* Each step that iterates is interrupted at its first ask, at its last and at some between these,
 * and then taken. */
static void interrupt_all(const char *text, int tries, int least_asks) {
    enum { MOST = 8 };
    int count[MOST], all = 0;
    CpsSceneFile *file = read_text(text);
    const int steps = count_asks(file, count, MOST);
    Asked by;
    CpsEvolution *plain = begin(file, NULL), *evolution = begin(file, &by);
    for (int step = 0; step < steps; step++) {
        void *before = saved(evolution);
        all += count[step];
        if (count[step] > 0)
            for (int k = 0; k <= tries; k++) {
                by = (Asked){.ends_at = (int)((long)(count[step] - 1) * k / tries)};
                CpsError err;
                assert_int_equal(cps_evolution_step(evolution, &err), CPS_ERR_INTERRUPTED);
                assert_true(err.message[0] != 0);
                CHECK_INT(by.count, by.ends_at + 1); /* it asks no more */
                void *after = saved(evolution);
                assert_memory_equal(before, after, cps_evolution_state_size(evolution));
                free(after);
                CHECK_INT(cps_evolution_remaining_count(evolution), steps - step);
            }
        by = (Asked){.ends_at = -1};
        assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
        assert_int_equal(cps_evolution_step(plain, NULL), CPS_OK);
        expect_same(plain, evolution);
        free(before);
    }
    CHECK_GREATER(all, least_asks);
    cps_evolution_destroy(plain);
    cps_evolution_destroy(evolution);
    cps_scene_file_destroy(file);
}

static void winch(void **state) {
    (void)state;
    interrupt_all(WINCH, 40, 100);
}

/* More iterations than a step without a jump takes: it is interrupted within the jump as well. */
static void jumps(void **state) {
    (void)state;
    interrupt_all(JUMPS, 2, 10000);
}

static void asked_no_more(void **state) {
    (void)state;
    Asked by = {.ends_at = 0};
    CpsSceneFile *file = read_text(WINCH);
    CpsEvolution *evolution = begin(file, &by);
    assert_int_equal(cps_evolution_step(evolution, NULL), CPS_ERR_INTERRUPTED);
    assert_int_equal(cps_evolution_interrupt(evolution, NULL, NULL, NULL), CPS_OK);
    by = (Asked){.ends_at = 0};
    assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
    CHECK_INT(by.count, 0);
    assert_int_equal(cps_evolution_interrupt(NULL, asked, &by, NULL), CPS_ERR_ARGUMENT);
    cps_evolution_destroy(evolution);
    cps_scene_file_destroy(file);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(winch), cmocka_unit_test(jumps),
                                       cmocka_unit_test(asked_no_more)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
