/* SPDX-License-Identifier: BSD-3-Clause */
/* Driven systems: what is refused and why, outcomes with their proofs, views; and the sparse factor
 * below them. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/drive.h"
#include "check.h"
#include "linalg/sparse_ldl.h"
#include "splitmix.h"

static CpsError err;

static void ok(CpsStatus status) {
    if (status != CPS_OK) print_error("%s\n", err.message);
    assert_int_equal(status, CPS_OK);
}

/* refused, with a message that says `what` */
static void refused(CpsStatus status, const char *what) {
    assert_int_equal(status, CPS_ERR_ARGUMENT);
    if (!strstr(err.message, what)) fail_msg("\"%s\" does not say \"%s\"", err.message, what);
}

static CpsLaw *disc(double radius) {
    CpsLaw *law = NULL;
    ok(cps_law_coulomb(1, radius, &law, &err));
    return law;
}

static CpsLaw *law_of(CpsSet *set) {
    CpsLaw *law = NULL;
    ok(cps_law_friction(set, &law, &err));
    cps_set_release(set);
    return law;
}

static CpsLaw *interval(double low, double high) {
    CpsSet *set = NULL;
    ok(cps_set_interval(low, high, &set, &err));
    return law_of(set);
}

static const CpsEntry PLANE[] = {{0, 0, 1}, {1, 1, 1}};

/* a block on a table, two parameters */
static CpsSystem *block(CpsLaw *law) {
    CpsSystem *system = NULL;
    ok(cps_system_create(2, &system, &err));
    ok(cps_system_add_friction(system, "table", law, 2, PLANE, &err));
    cps_law_release(law);
    return system;
}

static bool users_support(void *user, int n, const double *direction, double *value,
                          double *point) {
    (void)user;
    *value = 0;
    for (int i = 0; i < n; i++) {
        point[i] = direction[i] > 0 ? 1 : -1;
        *value += fabs(direction[i]);
    }
    return true;
}

static void building_is_checked(void **state) {
    (void)state;
    CpsSystem *system = NULL;
    refused(cps_system_create(0, &system, &err), "velocity parameters");
    assert_null(system);
    CpsLaw *law = disc(1);
    ok(cps_system_create(2, &system, &err));
    refused(cps_system_add_friction(system, "a", law, 1, (const CpsEntry[]){{2, 0, 1}}, &err),
            "row 2");
    refused(cps_system_add_friction(system, "a", law, 1, (const CpsEntry[]){{0, 2, 1}}, &err),
            "column 2");
    refused(cps_system_add_friction(system, "a", law, 1, (const CpsEntry[]){{0, 0, NAN}}, &err),
            "finite");
    refused(cps_system_add_constraints(system, -1, 0, NULL, &err), "rows");
    refused(cps_system_set_load(system, (const double[]){1, INFINITY}, &err), "load");
    CHECK_INT(cps_system_law_count(system), 0);

    /* a set that only answers its support has no conic form */
    CpsSet *user = NULL;
    ok(cps_set_user(2, users_support, NULL, &user, &err));
    CpsLaw *users = law_of(user);
    refused(cps_system_add_friction(system, "b", users, 2, PLANE, &err), "conic form");
    CpsResistance *cubic = NULL;
    ok(cps_resistance_power(law, 3, 1, &cubic, &err));
    refused(cps_system_add_resistance(system, "c", cubic, 2, PLANE, &err), "degree 3");

    /* names, spaces, and entries that add up */
    ok(cps_system_add_friction(system, NULL, law, 3,
                               (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}, {0, 0, 1}}, &err));
    assert_string_equal(cps_system_law_name(system, 0), "law 0");
    CHECK_INT(cps_system_law_space(system, 0), 2);
    assert_null(cps_system_law_name(system, 1));
    cps_resistance_release(cubic);
    cps_law_release(users);
    cps_law_release(law); /* the system has its own hold */
    ok(cps_system_set_drive(system, 2, 2, PLANE, &err));
    CpsMotion *motion = NULL;
    ok(cps_system_solve(system, (const double[]){1, 0}, NULL, &motion, &err));
    CHECK_NEAR(cps_motion_report(motion).value, 2, 1e-12); /* rounding and gap */
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_system_destroy(NULL);
    cps_motion_destroy(NULL);
}

static void solving_is_checked(void **state) {
    (void)state;
    CpsSystem *system = block(disc(1));
    CpsMotion *motion = NULL;
    ok(cps_system_set_drive(system, 1, 1, PLANE, &err));
    refused(cps_system_solve(system, NULL, NULL, &motion, &err), "NULL");
    refused(cps_system_solve(system, (const double[]){NAN}, NULL, &motion, &err),
            "driving velocity");
    const CpsMotionOptions zeros = {.tolerance = 1e-8, .boundary = 1e-6};
    refused(cps_system_solve(system, (const double[]){1}, &zeros, &motion, &err),
            "cps_motion_options_default");
    CpsMotionOptions options = cps_motion_options_default();
    options.tolerance = 0;
    refused(cps_system_solve(system, (const double[]){1}, &options, &motion, &err), "default");
    assert_null(motion);
    assert_string_equal(cps_motion_outcome_name(CPS_MOTION_OUTCOME_BLOCKED),
                        "CPS_MOTION_OUTCOME_BLOCKED");
    assert_non_null(cps_motion_outcome_text(CPS_MOTION_OUTCOME_SOLVED));
    cps_system_destroy(system);
}

static void elimination_is_checked(void **state) {
    (void)state;
    CpsSystem *system = block(disc(1));
    CpsLaw *law = NULL;
    refused(cps_system_eliminate(system, &law, NULL, NULL, &err), "no drive");
    ok(cps_system_set_drive(system, 2, 2, (const CpsEntry[]){{0, 0, 1}, {1, 0, 2}}, &err));
    refused(cps_system_eliminate(system, &law, NULL, NULL, &err), "depends");
    ok(cps_system_set_drive(system, 1, 1, PLANE, &err));
    ok(cps_system_set_load(system, (const double[]){0, 0.5}, &err));
    refused(cps_system_eliminate(system, &law, NULL, NULL, &err), "load");
    CpsResistance *viscous = NULL;
    ok(cps_resistance_viscous(2, (const double[]){1, 0, 0, 1}, &viscous, &err));
    ok(cps_system_add_resistance(system, "oil", viscous, 2, PLANE, &err));
    refused(cps_system_eliminate(system, NULL, NULL, NULL, &err), "oil");
    assert_null(law);
    cps_resistance_release(viscous);
    cps_system_destroy(system);
}

/* two drive rows on one parameter: with one velocity for both it moves, with two it cannot, and the
 * multipliers show it */
static void contradicting_drive_is_blocked(void **state) {
    (void)state;
    CpsSystem *system = block(disc(1));
    CpsMotion *motion = NULL;
    ok(cps_system_set_drive(system, 2, 2, (const CpsEntry[]){{0, 0, 1}, {1, 0, 2}}, &err));
    ok(cps_system_solve(system, (const double[]){1, 2}, NULL, &motion, &err));
    CHECK_INT(cps_motion_report(motion).outcome, CPS_MOTION_OUTCOME_SOLVED);
    CHECK_NEAR(cps_motion_report(motion).value, 1, 1e-10);
    cps_motion_destroy(motion);
    ok(cps_system_solve(system, (const double[]){1, 3}, NULL, &motion, &err));
    CHECK_INT(cps_motion_report(motion).outcome, CPS_MOTION_OUTCOME_BLOCKED);
    const double *g = cps_motion_resistance(motion);
    CHECK_NEAR(g[0] + 2 * g[1], 0, 1e-12);
    CHECK_LESS(g[0] + 3 * g[1], -1e-3);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
}

/* a strut that may not shorten stands in the way */
static void one_sided_law_blocks(void **state) {
    (void)state;
    CpsSystem *system = block(disc(1));
    CpsLaw *strut = interval(0, INFINITY); /* pushes: its velocity may not be negative */
    CpsMotion *motion = NULL;
    ok(cps_system_add_friction(system, "strut", strut, 1, PLANE, &err));
    ok(cps_system_set_drive(system, 1, 1, PLANE, &err));
    ok(cps_system_solve(system, (const double[]){1}, NULL, &motion, &err));
    CHECK_INT(cps_motion_report(motion).outcome, CPS_MOTION_OUTCOME_SOLVED);
    cps_motion_destroy(motion);
    ok(cps_system_solve(system, (const double[]){-1}, NULL, &motion, &err));
    CHECK_INT(cps_motion_report(motion).outcome, CPS_MOTION_OUTCOME_BLOCKED);
    CHECK_LESS(-cps_motion_resistance(motion)[0], -1e-3); /* W G < 0, borne by the strut alone */
    CHECK_NEAR(cps_motion_law_force(motion, 1)[0], cps_motion_resistance(motion)[0], 1e-6);
    CpsSolutionSet all;
    ok(cps_motion_velocities(motion, 0, &all, NULL, NULL, &err));
    CHECK_INT(all.outcome, CPS_SET_OUTCOME_NOT_AVAILABLE);
    cps_solution_set_clear(&all);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(strut);
}

/* what nothing resists cannot bear a load */
static void unresisted_load(void **state) {
    (void)state;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    CpsLaw *law = interval(-1, 1);
    ok(cps_system_create(2, &system, &err));
    ok(cps_system_add_friction(system, NULL, law, 1, PLANE, &err));
    ok(cps_system_set_load(system, (const double[]){0.5, 1e-3}, &err));
    ok(cps_system_solve(system, NULL, NULL, &motion, &err));
    CHECK_INT(cps_motion_report(motion).outcome, CPS_MOTION_OUTCOME_NO_BALANCE);
    CHECK_NEAR(cps_motion_report(motion).load_factor, 0, 1e-9);
    CHECK_GREATER(cps_motion_velocity(motion)[1], 0);
    cps_motion_destroy(motion);
    /* but a constraint can */
    ok(cps_system_add_constraints(system, 1, 1, (const CpsEntry[]){{0, 1, 1}}, &err));
    ok(cps_system_solve(system, NULL, NULL, &motion, &err));
    CHECK_INT(cps_motion_report(motion).outcome, CPS_MOTION_OUTCOME_SOLVED);
    CHECK_NEAR(cps_motion_constraint_forces(motion)[0], 1e-3, 1e-12);
    cps_motion_destroy(motion);
    cps_law_release(law);
    cps_system_destroy(system);
}

/* a subspace is the constraints of its complement; W = 0 is rest */
static void subspace_and_rest(void **state) {
    (void)state;
    CpsSystem *system = block(disc(2));
    CpsMotion *motion = NULL;
    ok(cps_system_add_subspace(system, 1, (const double[]){3, 4}, &err));
    ok(cps_system_set_drive(system, 1, 1, PLANE, &err));
    ok(cps_system_solve(system, (const double[]){0.6}, NULL, &motion, &err));
    CHECK_NEAR(cps_motion_velocity(motion)[1], 0.8, 1e-12);
    CHECK_NEAR(cps_motion_report(motion).value, 2, 1e-10);
    cps_motion_destroy(motion);
    ok(cps_system_solve(system, (const double[]){0}, NULL, &motion, &err));
    CHECK_INT(cps_motion_report(motion).outcome, CPS_MOTION_OUTCOME_SOLVED);
    CHECK_NEAR(cps_motion_report(motion).value, 0, 0);
    CHECK_NEAR(cps_motion_report(motion).lower, 0, 0);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
}

/* W-perp meets C only on the boundary of a disc: Proposition 1 goes one way only, and the infimum 0
 * is not attained */
static void interior_missed(void **state) {
    (void)state;
    CpsSet *ball = NULL;
    ok(cps_set_ball(2, (const double[]){1, 0}, 1, &ball, &err));
    CpsSystem *system = block(law_of(ball));
    CpsComposition composition;
    CpsLaw *law = NULL;
    CpsMotion *motion = NULL;
    CpsSetAnswer phi;
    ok(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 1, 1}}, &err));
    ok(cps_system_eliminate(system, &law, NULL, &composition, &err));
    CHECK_INT(composition, CPS_COMPOSITION_NOT_SATISFIED);
    ok(cps_set_dissipation(cps_law_set(law), (const double[]){1}, NULL, &phi, &err));
    CHECK_NEAR(
        phi.value, 0,
        1e-4); /* the set is one point, seen through a disc that touches: to the root of rounding */
    ok(cps_system_solve(system, (const double[]){1}, NULL, &motion, &err));
    const CpsMotionReport report = cps_motion_report(motion);
    CHECK_INT(report.composition, CPS_COMPOSITION_NOT_SATISFIED);
    CHECK_LESS(report.lower, 1e-8 * report.scale); /* V is large */
    CHECK_BETWEEN(report.upper, 0, 0.01);          /* phi falls like 1/(2 V_x) as V_x grows */
    cps_motion_destroy(motion);
    cps_law_release(law);
    cps_system_destroy(system);
}

/* ---- the sparse factor ---- */

typedef struct Sparse {
    int n;
    size_t *start;
    int *index;
    double *value;
    signed char *sign;
} Sparse;

/* quasi-definite with diagonals +-4 and 1 between j and other[j] < j (-1: none) */
static Sparse arrow(int n, const int *other) {
    const size_t w = (size_t)n;
    Sparse s = {n, calloc(w + 1, sizeof(size_t)), calloc(2 * w, sizeof(int)),
                calloc(2 * w, sizeof(double)), calloc(w, 1)};
    size_t at = 0;
    for (int j = 0; j < n; j++) {
        s.start[j] = at;
        if (other[j] >= 0) {
            s.index[at] = other[j];
            s.value[at++] = 1;
        }
        s.sign[j] = j % 3 ? 1 : -1;
        s.index[at] = j;
        s.value[at++] = 4 * s.sign[j];
    }
    s.start[n] = at;
    return s;
}

static void free_sparse(Sparse *s) {
    free(s->start);
    free(s->index);
    free(s->value);
    free(s->sign);
}

/* chains, stars and trees factorise without fill, and solve */
static void sparse_trees(void **state) {
    (void)state;
    enum { N = 20000 };
    int *other = calloc(N, sizeof *other);
    for (int shape = 0; shape < 3; shape++) {
        other[0] = -1;
        for (int j = 1; j < N; j++) other[j] = shape == 0 ? j - 1 : shape == 1 ? 0 : (j - 1) / 2;
        Sparse s = arrow(N, other);
        const CpsiPattern pattern = {N, s.start, s.index};
        size_t entries;
        CpsiLdl *ldl = cpsi_ldl_new(&pattern, 10 * N, &(int){0}, &entries);
        assert_non_null(ldl);
        CHECK_INT((long long)entries, N - 1);
        /* the star's centre outweighs its rays with their number */
        if (shape == 1) s.value[0] = -4.0 * N;
        assert_true(cpsi_ldl_factor(ldl, s.value, s.sign, 1e-12));
        double *x = calloc(N, sizeof *x), *b = calloc(N, sizeof *b), worst = 0;
        for (int j = 0; j < N; j++) x[j] = b[j] = (j % 7) - 3;
        cpsi_ldl_solve(ldl, x);
        for (int j = 0; j < N; j++)
            for (size_t e = s.start[j]; e < s.start[j + 1]; e++) {
                const int i = s.index[e];
                b[i] -= s.value[e] * x[j];
                if (i != j) b[j] -= s.value[e] * x[i];
            }
        for (int j = 0; j < N; j++) worst = fmax(worst, fabs(b[j]));
        CHECK_LESS(worst, 1e-10); /* rounding of sums of up to 2e4 terms of order one */
        free(x);
        free(b);
        cpsi_ldl_free(ldl);
        free_sparse(&s);
    }
    free(other);
}

/* a full matrix within and beyond the entries allowed; pivots of the wrong sign are replaced */
static void sparse_limits(void **state) {
    (void)state;
    enum { N = 30 };
    size_t start[N + 1], entries;
    int index[N * N];
    double value[N * N];
    signed char sign[N];
    size_t at = 0;
    for (int j = 0; j < N; j++) {
        start[j] = at;
        for (int i = 0; i <= j; i++) {
            index[at] = i;
            value[at++] = i == j ? 40 : 1;
        }
        sign[j] = 1;
    }
    start[N] = at;
    const CpsiPattern pattern = {N, start, index};
    assert_null(cpsi_ldl_new(&pattern, N * (N - 1) / 2 - 1, &(int){0}, &entries));
    CHECK_INT((long long)entries, N * (N - 1) / 2);
    CpsiLdl *ldl = cpsi_ldl_new(&pattern, N * N, &(int){0}, &entries);
    assert_non_null(ldl);
    assert_true(cpsi_ldl_factor(ldl, value, sign, 1e-12));
    double x[N];
    for (int i = 0; i < N; i++) x[i] = 40 + N - 1;
    cpsi_ldl_solve(ldl, x);
    for (int i = 0; i < N; i++) CHECK_NEAR(x[i], 1, 1e-13); /* rounding */
    memset(value, 0, sizeof value);
    assert_true(cpsi_ldl_factor(ldl, value, sign, 0.5));
    for (int i = 0; i < N; i++) x[i] = 1;
    cpsi_ldl_solve(ldl, x);
    for (int i = 0; i < N; i++) CHECK_NEAR(x[i], 2, 0);
    value[0] = NAN;
    assert_false(cpsi_ldl_factor(ldl, value, sign, 0.5));
    cpsi_ldl_free(ldl);
}

/* a head of rays that all act on an end without zeros, which is factorised as a dense matrix where
 * it is large, with pivots of both signs; b of x = 1, 2, 3, .. gives x. The sizes fill lanes and
 * panels of that matrix and leave them unfilled. */
static void sparse_dense_end(void **state) {
    (void)state;
    enum { RAYS = 37 };
    const int sizes[] = {1, 40, 63, 64, 65, 95, 96, 97, 104, 160, 191, 192, 193, 263, 300};
    uint64_t random = 1;
    for (size_t c = 0; c < sizeof sizes / sizeof *sizes; c++) {
        const int n = RAYS + sizes[c];
        const size_t w = (size_t)n;
        Sparse s = {n, calloc(w + 1, sizeof(size_t)), calloc(w * w, sizeof(int)),
                    calloc(w * w, sizeof(double)), calloc(w, 1)};
        double *b = calloc(w, sizeof *b);
        size_t at = 0;
        for (int j = 0; j < n; j++) {
            s.start[j] = at;
            s.sign[j] = j % 3 ? 1 : -1;
            for (int i = 0; i <= j; i++) {
                if (i < j && (j < RAYS || (i < RAYS && (i + j) % 4))) continue;
                const double value = i == j ? 2.0 * n * s.sign[j] : splitmix(&random, -1, 1);
                s.index[at] = i;
                s.value[at++] = value;
                b[i] += value * (j + 1);
                if (i != j) b[j] += value * (i + 1);
            }
        }
        s.start[n] = at;
        const CpsiPattern pattern = {n, s.start, s.index};
        size_t entries;
        CpsiLdl *ldl = cpsi_ldl_new(&pattern, w * w, &(int){0}, &entries);
        assert_non_null(ldl);
        for (int turn = 0; turn < 2; turn++) { /* the second factor does not depend on the first */
            double *x = calloc(w, sizeof *x);
            memcpy(x, b, w * sizeof *x);
            assert_true(cpsi_ldl_factor(ldl, s.value, s.sign, 1e-12));
            cpsi_ldl_solve(ldl, x);
            for (int j = 0; j < n; j++) CHECK_NEAR(x[j], j + 1, 1e-11); /* rounding of sums */
            x[turn] = INFINITY; /* what comes of that is no solution, and is not remembered */
            cpsi_ldl_solve(ldl, x);
            free(x);
        }
        s.value[at - 1] = NAN;
        assert_false(cpsi_ldl_factor(ldl, s.value, s.sign, 1e-12));
        cpsi_ldl_free(ldl);
        free(b);
        free_sparse(&s);
    }
}

/* the second pivot of 1e9 (1, 1/3)(1, 1/3)' is rounding: it is taken as large as that may be, in
 * either direction, so that the next column does not grow by its ratio to a smaller one */
static void sparse_rounded_pivot(void **state) {
    (void)state;
    const size_t start[] = {0, 1, 3};
    const int index[] = {0, 0, 1};
    const CpsiPattern pattern = {2, start, index};
    size_t entries;
    CpsiLdl *ldl = cpsi_ldl_new(&pattern, 4, &(int){0}, &entries);
    assert_non_null(ldl);
    for (int direction = -1; direction <= 1; direction += 2) {
        const double large = 1e9 * direction;
        const double value[] = {large, large / 3, large / 9};
        const signed char sign[] = {(signed char)direction, (signed char)direction};
        assert_true(cpsi_ldl_factor(ldl, value, sign, 1e-13));
        double x[] = {0, 1};
        cpsi_ldl_solve(ldl, x);
        /* 1/x[1] or, where the other unknown is eliminated last, 9 times that is the pivot */
        const double pivot = direction / x[1], rounding = 1e9 * DBL_EPSILON / 9;
        CHECK_BETWEEN(pivot, rounding, 100 * rounding);
    }
    cpsi_ldl_free(ldl);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(building_is_checked),    cmocka_unit_test(solving_is_checked),
        cmocka_unit_test(elimination_is_checked), cmocka_unit_test(contradicting_drive_is_blocked),
        cmocka_unit_test(one_sided_law_blocks),   cmocka_unit_test(unresisted_load),
        cmocka_unit_test(subspace_and_rest),      cmocka_unit_test(interior_missed),
        cmocka_unit_test(sparse_trees),           cmocka_unit_test(sparse_limits),
        cmocka_unit_test(sparse_rounded_pivot),   cmocka_unit_test(sparse_dense_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
