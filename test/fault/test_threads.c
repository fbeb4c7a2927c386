/* SPDX-License-Identifier: BSD-3-Clause */
/* An evolution of several lines on several threads, one of which has a friction set: each
 * allocation, each thread and the mask of signals are refused in turn. The evolution is then
 * refused with a sentence, and memory and threads are given back; with everything granted the bits
 * are those of one thread. */
#define _GNU_SOURCE
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "capstan/evolve.h"
#include "refuse.h"
#include "straight_rope.h"

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*begin)(void *), void *data);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*begin)(void *), void *data);
int __real_pthread_join(pthread_t thread, void **result);
int __wrap_pthread_join(pthread_t thread, void **result);
int __real_pthread_sigmask(int how, const sigset_t *set, sigset_t *before);
int __wrap_pthread_sigmask(int how, const sigset_t *set, sigset_t *before);

enum { LINES = 4, THREADS = 3, ELEMENTS = 20 };

static long threads_allowed = -1, threads_asked, running; /* as `allowed` of allocations */
static bool mask_refused;

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*begin)(void *), void *data) {
    threads_asked++;
    if (threads_allowed >= 0 && threads_allowed-- == 0) return 11; /* EAGAIN */
    running++;
    return __real_pthread_create(thread, attributes, begin, data);
}
int __wrap_pthread_join(pthread_t thread, void **result) {
    running--;
    return __real_pthread_join(thread, result);
}
int __wrap_pthread_sigmask(int how, const sigset_t *set, sigset_t *before) {
    return mask_refused ? 22 : __real_pthread_sigmask(how, set, before);
}

typedef struct Scene {
    double point[LINES][6];
    CpsLine line[LINES];
    CpsObstacle obstacle[2];
    CpsChange change[LINES];
    CpsStage stage;
    CpsScene scene;
} Scene;

static Scene *make_scene(CpsSet *set) {
    static Scene s;
    static char name[LINES][2] = {"a", "b", "c", "d"};
    for (int k = 0; k < LINES; k++) {
        const double y = 3 * k;
        memcpy(s.point[k], (const double[]){0, y, 0, 6, y, 0}, sizeof s.point[k]);
        s.line[k] = straight_rope(s.point[k], 6, ELEMENTS, 10 + k, 1e4);
        s.line[k].name = name[k];
        s.change[k] = (CpsChange){.line = k,
                                  .end = CPS_END_B,
                                  .to = {CPS_END_KIND_HELD, {5.9, y + 0.1 * k, 0}}};
    }
    for (int k = 0; k < 2; k++) s.obstacle[k] = cps_obstacle_default();
    s.obstacle[0].name = "bed";
    s.obstacle[0].friction = 0.3;
    s.obstacle[1].name = "wall";
    s.obstacle[1].point[1] = -1;
    s.obstacle[1].normal[1] = 1;
    s.obstacle[1].normal[2] = 0;
    s.obstacle[1].friction_set = set;
    s.stage = cps_stage_default();
    s.stage.name = "move";
    s.stage.step_count = 3;
    s.stage.change_count = LINES;
    s.stage.change = s.change;
    s.scene = cps_scene_default();
    s.scene.obstacle_count = 2;
    s.scene.obstacle = s.obstacle;
    s.scene.line_count = LINES;
    s.scene.line = s.line;
    s.scene.stage_count = 1;
    s.scene.stage = &s.stage;
    s.scene.solver.thread_count = THREADS;
    return &s;
}

/* Made and let go of; the sentence of a refusal is in *err. */
static CpsStatus create(const Scene *s, CpsError *err) {
    const long before = live;
    CpsEvolution *evolution = NULL;
    *err = (CpsError){0};
    const CpsStatus status = cps_evolution_create(&s->scene, &evolution, err);
    assert_true((status == CPS_OK) == (evolution != NULL));
    assert_true(status == CPS_OK || (err->status == status && err->message[0]));
    cps_evolution_destroy(evolution);
    if (running != 0) fail_msg("%ld threads are left", running);
    if (live != before) fail_msg("%ld blocks are lost", live - before);
    return status;
}

static void each_allocation(void **state) {
    CpsError err;
    long tried = 0;
    for (;; tried++) {
        allowed = tried;
        const CpsStatus status = create(*state, &err);
        const bool reached = allowed < 0;
        allowed = -1;
        if (!reached) {
            assert_int_equal(status, CPS_OK);
            break;
        }
        if (status != CPS_ERR_MEMORY)
            fail_msg("allocation %ld: %s: %s", tried, cps_status_name(status), err.message);
    }
    if (tried == 0) skip();
    print_message("%ld allocations, each refused\n", tried);
    assert_in_range(tried, 10, 10000);
}

static void each_thread(void **state) {
    CpsError err;
    threads_asked = 0;
    assert_int_equal(create(*state, &err), CPS_OK);
    if (threads_asked == 0) skip();
    assert_int_equal(threads_asked, THREADS - 1);
    for (long k = 0; k < THREADS - 1; k++) {
        threads_allowed = k;
        assert_int_equal(create(*state, &err), CPS_ERR_MEMORY);
        assert_true(threads_allowed < 0);
        assert_non_null(strstr(err.message, "the system does not give 3 threads"));
    }
    mask_refused = true;
    assert_int_equal(create(*state, &err), CPS_ERR_MEMORY);
    mask_refused = false;
    /* signals are delivered as before */
    sigset_t mask;
    assert_int_equal(pthread_sigmask(SIG_SETMASK, NULL, &mask), 0);
    assert_int_equal(sigismember(&mask, SIGINT), 0);
    assert_int_equal(create(*state, &err), CPS_OK);
}

static void same_bits(void **state) {
    Scene *s = *state;
    CpsEvolution *evolution[2] = {NULL};
    for (int k = 0; k < 2; k++) {
        s->scene.solver.thread_count = k ? THREADS : 1;
        assert_int_equal(cps_evolution_create(&s->scene, &evolution[k], NULL), CPS_OK);
    }
    while (cps_evolution_remaining_count(evolution[0]) > 0) {
        for (int k = 0; k < 2; k++)
            assert_int_equal(cps_evolution_step(evolution[k], NULL), CPS_OK);
        for (int l = 0; l < LINES; l++) {
            const CpsLineView one = cps_evolution_line_view(evolution[0], l),
                              many = cps_evolution_line_view(evolution[1], l);
            assert_memory_equal(one.position, many.position,
                                3 * (ELEMENTS + 1) * sizeof *one.position);
            assert_memory_equal(one.segment_force, many.segment_force,
                                3 * ELEMENTS * sizeof *one.segment_force);
        }
    }
    for (int k = 0; k < 2; k++) cps_evolution_destroy(evolution[k]);
    assert_int_equal(running, 0);
}

static int set_up(void **state) {
    CpsSet *set = NULL;
    if (cps_set_ball(2, NULL, 0.4, &set, NULL) != CPS_OK) return -1;
    *state = make_scene(set);
    return 0;
}

static int tear_down(void **state) {
    Scene *s = *state;
    cps_set_release((CpsSet *)(uintptr_t)s->obstacle[1].friction_set);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_allocation),
                                       cmocka_unit_test(each_thread), cmocka_unit_test(same_bits)};
    return cmocka_run_group_tests_name("threads", tests, set_up, tear_down);
}
