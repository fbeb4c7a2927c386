/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets and laws are given by functions of a user's program, which fail: each call of them in turn
 * says that there is no answer, or gives a number that is none. A question to a law that has called
 * them is then refused, one to a set has no answer; asked again it is answered as before. A set
 * that has answered otherwise once makes no error. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "capstan/drive.h"

enum { N = 2, MOST_CASES = 60 };
/* The last one is no failure that a law or a set can notice by itself: a lower value. */
typedef enum Failure { NO_ANSWER, NO_NUMBER, LESS, FAILURES } Failure;

static long called, fails_at; /* calls so far; the one that fails, from 0, negative: none */
static Failure how;
static CpsError err;

static bool fails(void) { return called++ == fails_at; }

/* The disc of radius 2 about (1, 0). */
static bool disc(void *user, int n, const double *w, double *value, double *point) {
    (void)user;
    const double size = hypot(w[0], w[1]);
    const bool failing = fails();
    if (failing && how == NO_ANSWER) return false;
    *value = failing && how == NO_NUMBER ? NAN : w[0] + 2 * size - (failing ? 20 : 0);
    for (int i = 0; i < n; i++) point[i] = (i == 0) + (size > 0 ? 2 * w[i] / size : 0);
    return true;
}

/* h = g^2/(1 + g), whose slope tends to 1; and one with a corner at 2, from slope 1 to 3. */
static bool soft(void *user, double g, double *value, double *slope) {
    (void)user;
    const bool failing = fails();
    *value = failing ? NAN : g * g / (1 + g);
    *slope = g * (2 + g) / ((1 + g) * (1 + g));
    return !failing || how != NO_ANSWER;
}
static bool corner(void *user, double g, double *value, double *slope) {
    (void)user;
    const bool failing = fails();
    *value = g <= 2 ? g : 2 + 3 * (g - 2);
    *slope = failing ? NAN : g <= 2 ? 1 : 3;
    return !failing || how != NO_ANSWER;
}
/* the conjugate of `soft` */
static bool soft_dual(void *user, double s, double *value, double *g) {
    (void)user;
    const bool failing = fails();
    *g = failing ? -1 : s < 1 ? 1 / sqrt(1 - s) - 1 : INFINITY;
    *value = s < 1 ? (1 - sqrt(1 - s)) * (1 - sqrt(1 - s)) : INFINITY;
    return !failing || how != NO_ANSWER;
}

static void ok(CpsStatus status) {
    if (status != CPS_OK) fail_msg("%s", err.message);
}

/* What is asked; whatever it makes is released by the question itself. */
typedef CpsStatus Question(const void *of, CpsSetOutcome *outcome);

static void sweep(const char *name, Question *ask, const void *of, bool of_set) {
    CpsSetOutcome whole, found;
    fails_at = -1;
    called = 0;
    if (ask(of, &whole) != CPS_OK) fail_msg("%s: %s", name, err.message);
    const long all = called, stride = all / MOST_CASES + 1;
    for (long k = 0; k < all; k += stride)
        for (how = NO_ANSWER; how < (of_set ? FAILURES : LESS); how++) {
            fails_at = k;
            called = 0;
            const CpsStatus status = ask(of, &found);
            const bool refused =
                of_set ? status == CPS_OK && (how == LESS || found != CPS_SET_OUTCOME_ANSWERED)
                       : status == CPS_ERR_ARGUMENT;
            if (called > k && !refused)
                fail_msg("%s, call %ld of %ld, failure %d: %s", name, k, all, (int)how,
                         status ? err.message : "is answered");
        }
    fails_at = -1;
    ok(ask(of, &found));
    assert_int_equal(found, whole);
}

/* ---- sets ---- */

static const double W[N] = {0.6, 0.8}, P[N] = {2, 1}, FAR[N] = {9, 9};

static CpsStatus ask_support(const void *set, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    double point[N];
    const CpsStatus status = cps_set_support(set, W, point, &answer, &err);
    *outcome = answer.outcome;
    return status;
}
static CpsStatus ask_extent(const void *set, CpsSetOutcome *outcome) {
    CpsSetExtent extent;
    const CpsStatus status = cps_set_extent(set, W, &extent, &err);
    *outcome = extent.outcome;
    return status;
}
static CpsStatus ask_face(const void *set, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    CpsSet *face = NULL;
    const CpsStatus status = cps_set_face(set, W, 0, &face, &answer, &err);
    *outcome = answer.outcome;
    cps_set_release(face);
    return status;
}
static CpsStatus ask_facts(const void *set, CpsSetOutcome *outcome) {
    CpsSetFacts facts;
    double centre[N], basis[N * N];
    const CpsStatus status = cps_set_facts(set, 0, &facts, centre, basis, &err);
    *outcome = facts.outcome;
    return status;
}
static CpsStatus ask_contains(const void *set, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    double separating[N];
    const CpsStatus status = cps_set_contains(set, P, separating, &answer, &err);
    *outcome = answer.outcome;
    return status;
}
static CpsStatus ask_project(const void *set, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    double nearest[N];
    const CpsStatus status = cps_set_project(set, FAR, NULL, nearest, &answer, &err);
    *outcome = answer.outcome;
    return status;
}
static CpsStatus ask_gauge(const void *set, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    const CpsStatus status = cps_set_gauge(set, P, &answer, &err);
    *outcome = answer.outcome;
    return status;
}
static CpsStatus ask_normals(const void *set, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    CpsSet *cone = NULL;
    const CpsStatus status = cps_set_normal_cone(set, P, 0, &cone, &answer, &err);
    *outcome = answer.outcome;
    cps_set_release(cone);
    return status;
}
static CpsStatus ask_vertices(const void *set, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    double points[8 * N];
    int count;
    const CpsStatus status = cps_set_vertices(set, 0, 8, points, &count, &answer, &err);
    *outcome = answer.outcome;
    return status;
}
static CpsStatus ask_rays(const void *set, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    double rays[8 * N];
    int count;
    const CpsStatus status = cps_set_rays(set, 0, 8, rays, &count, &answer, &err);
    *outcome = answer.outcome;
    return status;
}
static CpsStatus ask_measure(const void *set, CpsSetOutcome *outcome) {
    CpsSetMeasure measure;
    const CpsStatus status = cps_set_measure(set, &measure, &err);
    *outcome = measure.outcome;
    return status;
}
static CpsStatus ask_forces(const void *set, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    CpsSet *forces = NULL;
    const CpsStatus status = cps_set_forces(set, W, 0, &forces, &answer, &err);
    *outcome = answer.outcome;
    cps_set_release(forces);
    return status;
}
static CpsStatus ask_velocities(const void *set, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    CpsSet *velocities = NULL;
    const CpsStatus status = cps_set_velocities(set, P, 0, &velocities, &answer, &err);
    *outcome = answer.outcome;
    cps_set_release(velocities);
    return status;
}

static void ask_all(const char *name, CpsSet *set) {
    static Question *const ASK[] = {ask_support,   ask_extent,  ask_face,    ask_facts,
                                    ask_contains,  ask_project, ask_gauge,   ask_normals,
                                    ask_vertices,  ask_rays,    ask_measure, ask_forces,
                                    ask_velocities};
    char text[80];
    for (size_t i = 0; i < sizeof ASK / sizeof *ASK; i++) {
        snprintf(text, sizeof text, "%s, question %zu", name, i);
        sweep(text, ASK[i], set, true);
    }
    cps_set_release(set);
}

static void sets(void **state) {
    (void)state;
    static const double SHEAR[4] = {1, 0.5, 0, 1}, SHIFT[N] = {0.1, 0.2}, LOW[N] = {-1, -1},
                        HIGH[N] = {1, 2};
    CpsSet *own, *box, *made;
    fails_at = -1;
    ok(cps_set_user(N, disc, NULL, &own, &err));
    ok(cps_set_box(N, LOW, HIGH, &box, &err));
    const CpsSet *both[] = {own, box}, *reverse[] = {box, own};
    ok(cps_set_sum(2, both, &made, &err));
    ask_all("a sum", made);
    ok(cps_set_sum(2, reverse, &made, &err));
    ask_all("a sum, the other first", made);
    ok(cps_set_hull(2, both, &made, &err));
    ask_all("a hull", made);
    ok(cps_set_hull(2, reverse, &made, &err));
    ask_all("a hull, the other first", made);
    ok(cps_set_image(N, SHEAR, own, &made, &err));
    ask_all("an image", made);
    ok(cps_set_translate(SHIFT, own, &made, &err));
    ask_all("translated", made);
    ok(cps_set_scale(-2, own, &made, &err));
    ask_all("scaled", made);
    ask_all("alone", own);
    cps_set_release(box);
}

/* ---- resistance laws ---- */

static CpsStatus ask_value(const void *law, CpsSetOutcome *outcome) {
    CpsResistanceValue whole;
    const CpsStatus status = cps_resistance_value(law, W, &whole, NULL, &err);
    *outcome = whole.outcome;
    return status;
}
static CpsStatus ask_law_forces(const void *law, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    CpsSet *forces = NULL;
    const CpsStatus status = cps_resistance_forces(law, W, 0, &forces, &answer, &err);
    *outcome = answer.outcome;
    cps_set_release(forces);
    return status;
}
static CpsStatus conjugate(const void *law, double size, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    double velocity[N];
    const double force[N] = {size * W[0], size * W[1]};
    const CpsStatus status = cps_resistance_conjugate(law, force, velocity, &answer, &err);
    *outcome = answer.outcome;
    return status;
}
static CpsStatus ask_conjugate(const void *law, CpsSetOutcome *outcome) {
    return conjugate(law, 0.7, outcome);
}
static CpsStatus ask_large(const void *law, CpsSetOutcome *outcome) {
    return conjugate(law, 2.5, outcome);
}
static CpsStatus law_velocities(const void *law, double size, CpsSetOutcome *outcome) {
    CpsSetAnswer answer;
    CpsSet *velocities = NULL;
    const double force[N] = {size * W[0], size * W[1]};
    const CpsStatus status = cps_resistance_velocities(law, force, &velocities, &answer, &err);
    *outcome = answer.outcome;
    cps_set_release(velocities);
    return status;
}
static CpsStatus ask_law_velocities(const void *law, CpsSetOutcome *outcome) {
    return law_velocities(law, 0.7, outcome);
}
static CpsStatus ask_at_jump(const void *law, CpsSetOutcome *outcome) {
    return law_velocities(law, 2, outcome);
}
static CpsStatus ask_residual(const void *law, CpsSetOutcome *outcome) {
    double gap, distance;
    *outcome = CPS_SET_OUTCOME_ANSWERED;
    return cps_resistance_residual(law, P, W, &gap, &distance, &err);
}

static void ask_law(const char *name, CpsResistance *law) {
    static Question *const ASK[] = {ask_value,          ask_law_forces, ask_conjugate, ask_large,
                                    ask_law_velocities, ask_at_jump,    ask_residual};
    char text[80];
    for (size_t i = 0; i < sizeof ASK / sizeof *ASK; i++) {
        snprintf(text, sizeof text, "%s, question %zu", name, i);
        sweep(text, ASK[i], law, false);
    }
}

static void laws(void **state) {
    (void)state;
    fails_at = -1;
    CpsLaw *coulomb;
    CpsSet *oval_set;
    CpsLaw *oval;
    static const double SHAPE[N * N] = {1, 0, 0, 4}, DAMPING[N * N] = {1, 0, 0, 2};
    ok(cps_law_coulomb(1, 1, &coulomb, &err));
    ok(cps_set_ellipsoid(N, NULL, SHAPE, &oval_set, &err));
    ok(cps_law_friction(oval_set, &oval, &err));
    CpsResistance *one[5], *sum;
    ok(cps_resistance_function(coulomb, soft, NULL, NULL, &one[0], &err));
    ok(cps_resistance_function(coulomb, soft, soft_dual, NULL, &one[1], &err));
    ok(cps_resistance_function(oval, corner, NULL, NULL, &one[2], &err));
    ok(cps_resistance_viscous(N, DAMPING, &one[3], &err));
    ok(cps_resistance_dry(oval, &one[4], &err));
    static const char *const NAME[] = {"soft", "soft with its conjugate", "corner"};
    for (int i = 0; i < 3; i++) ask_law(NAME[i], one[i]);
    for (int i = 0; i < 5; i++)
        for (int j = i; j < 5; j++) {
            char name[40];
            if (i > 2) continue; /* no function of the user's in it */
            snprintf(name, sizeof name, "sum of %d and %d", i, j);
            ok(cps_resistance_sum(2, (const CpsResistance *[]){one[i], one[j]}, &sum, &err));
            ask_law(name, sum);
            cps_resistance_release(sum);
        }
    ok(cps_resistance_sum(3, (const CpsResistance *[]){one[0], one[2], one[4]}, &sum, &err));
    ask_law("sum of three", sum);
    cps_resistance_release(sum);
    for (int i = 0; i < 5; i++) cps_resistance_release(one[i]);
    cps_law_release(coulomb);
    cps_law_release(oval);
    cps_set_release(oval_set);
}

/* A function that fails when a law is made of it: no law is made. */
static void no_law(void **state) {
    (void)state;
    CpsLaw *coulomb;
    fails_at = -1;
    ok(cps_law_coulomb(1, 1, &coulomb, &err));
    for (fails_at = 0;; fails_at++) {
        CpsResistance *made = NULL;
        called = 0;
        how = fails_at % 2 ? NO_ANSWER : NO_NUMBER;
        const CpsStatus status = cps_resistance_function(coulomb, soft, NULL, NULL, &made, &err);
        if (called <= fails_at) {
            ok(status);
            cps_resistance_release(made);
            break;
        }
        assert_int_equal(status, CPS_ERR_ARGUMENT);
        assert_null(made);
    }
    assert_in_range(fails_at, 100, 1000); /* speeds from 2^-40 to 2^40, each twice */
    fails_at = -1;
    cps_law_release(coulomb);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sets), cmocka_unit_test(laws),
                                       cmocka_unit_test(no_law)};
    return cmocka_run_group_tests_name("functions that fail", tests, NULL, NULL);
}
