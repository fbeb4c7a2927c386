/* SPDX-License-Identifier: BSD-3-Clause */
/* What is told of the set of an answer, of every kind: its dimension, its ends, corners, rays and
 * lines are those of the closed form. Each allocation of asking for them is refused once: the
 * question says so, and everything is given back. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "law/set_answer.h"
#include "refuse.h"

static CpsError err;

/* A set, and what is told of it; -1: what is not listed. */
typedef struct Case {
    const char *name;
    CpsSet *set;
    bool cone;
    int dimension, lineality, rays, vertices;
} Case;

enum { MOST = 16 };
static Case cases[MOST];
static int count;

static void add(const char *name, CpsSet *set, bool cone, int dimension, int lineality, int rays,
                int vertices) {
    assert_true(count < MOST);
    cases[count++] = (Case){name, set, cone, dimension, lineality, rays, vertices};
}

#define MADE(call) assert_int_equal(call, CPS_OK)

/* The product of a line, or of half a one, with a cone of dimension 3 that is not made of rays. */
static CpsSet *with_friction_cone(double low) {
    CpsSet *line, *cone, *both;
    MADE(cps_set_interval(low, INFINITY, &line, &err));
    MADE(cps_set_friction_cone(3, 0.5, &cone, &err));
    MADE(cps_set_product(2, (const CpsSet *const[]){line, cone}, &both, &err));
    cps_set_release(line);
    cps_set_release(cone);
    return both;
}

static int set_up(void **state) {
    (void)state;
    static const double RAYS[9] = {1, 0, 0, 0, 1, 0, 1, 1, 1}, EDGE[6] = {1, 0, 0, 1, -1, 0},
                        CORNER[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, UP[3] = {0, 0, 1};
    CpsSet *set;
    MADE(cps_set_point(2, RAYS, &set, &err));
    add("a point", set, false, 0, 0, -1, 1);
    MADE(cps_set_interval(-1, 2, &set, &err));
    add("a segment", set, false, 1, 0, -1, 2);
    MADE(cps_set_interval(-1, INFINITY, &set, &err));
    add("a half-line", set, false, 1, 0, -1, -1);
    MADE(cps_set_interval(-INFINITY, INFINITY, &set, &err));
    add("a line", set, false, 1, 0, -1, -1);
    MADE(cps_set_hull_of_points(3, 3, CORNER, &set, &err));
    add("a triangle in space", set, false, 2, 0, -1, 3);
    MADE(cps_set_hull_of_points(3, 4, CORNER, &set, &err));
    add("a tetrahedron", set, false, 3, 0, -1, 4);
    MADE(cps_set_cone_of_rays(3, 1, RAYS, &set, &err));
    add("a ray", set, true, 1, 0, 1, -1);
    MADE(cps_set_cone_of_rays(3, 2, RAYS, &set, &err));
    add("a sector", set, true, 2, 0, 2, -1);
    MADE(cps_set_cone_of_rays(3, 3, RAYS, &set, &err));
    add("a cone of three rays", set, true, 3, 0, 3, -1);
    MADE(cps_set_cone_of_rays(2, 3, EDGE, &set, &err));
    add("a half-plane", set, true, 2, 1, 3, -1);
    MADE(cps_set_half_space(3, UP, 0, &set, &err));
    add("a half-space", set, true, 3, 2, 5, -1);
    MADE(cps_set_subspace(3, 2, RAYS, &set, &err));
    add("a plane", set, true, 2, 2, 4, -1);
    MADE(cps_set_friction_cone(3, 0.5, &set, &err));
    add("a round cone", set, true, 3, 0, -1, -1);
    add("a line by a round cone", with_friction_cone(-INFINITY), true, 4, 1, -1, -1);
    add("half a line by a round cone", with_friction_cone(0), true, 4, 0, -1, -1);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    while (count > 0) cps_set_release(cases[--count].set);
    return 0;
}

static void expect_answer(const Case *c, const SetAnswer *a) {
    if (a->facts.outcome != CPS_SET_OUTCOME_ANSWERED || a->facts.dimension != c->dimension ||
        a->lineality != c->lineality || a->ray_count != c->rays || a->vertex_count != c->vertices)
        fail_msg("%s: outcome %d, dimension %d, lineality %d, %d rays, %d vertices", c->name,
                 (int)a->facts.outcome, a->facts.dimension, a->lineality, a->ray_count,
                 a->vertex_count);
    /* rays are unit vectors of the cone */
    for (int k = 0; k < a->ray_count; k++) {
        CpsSetAnswer inside;
        const double *ray = &a->ray[k * a->n];
        MADE(cps_set_contains(c->set, ray, NULL, &inside, &err));
        assert_true(inside.value >= -1e-7); /* up to the tolerance of the solver */
    }
}

static void each_is_told(void **state) {
    (void)state;
    long all = 0;
    for (int i = 0; i < count; i++) {
        SetAnswer answer;
        bool reached = true;
        for (long k = 0; reached; k++) {
            const long before = live;
            allowed = k;
            const CpsStatus status = law_answer_ask(cases[i].set, cases[i].cone, &answer, &err);
            reached = allowed < 0;
            allowed = -1;
            if (status != CPS_OK && !(reached && status == CPS_ERR_MEMORY))
                fail_msg("%s, allocation %ld: %s", cases[i].name, k, err.message);
            if (!reached) expect_answer(&cases[i], &answer);
            law_answer_free(&answer);
            if (live != before)
                fail_msg("%s, allocation %ld: %ld blocks lost", cases[i].name, k, live - before);
            all += reached;
        }
    }
    if (all == 0) skip(); /* built as shared libraries it cannot be reached */
    print_message("%d sets, %ld allocations, each refused once\n", count, all);
    assert_in_range(all, 100, 100000);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_is_told)};
    return cmocka_run_group_tests_name("answers without memory", tests, set_up, tear_down);
}
