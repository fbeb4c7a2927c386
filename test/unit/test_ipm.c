/* SPDX-License-Identifier: BSD-3-Clause */
/* The interior-point loop on small programs whose answer is known, with both linear systems: a
 * hanging pair of links, and the two ways of having no answer. */
#include "chain/chain_program.h"
#include "chain/qr_lanes.h"
#include "ipm/ipm.h"
#include "linalg/dense.h"

#include "check.h"

enum { NODES = 3 };

typedef struct Fixture {
    CpsiArena arena;
    CpsiChainProgram program;
} Fixture;

/* Two equal elements of compliance c; nodes 0 and 2 held at (0,0,0) and (span,0,0) as `held` says,
 * load (0,0,-1) on node 1. */
static void make(Fixture *fixture, const CpsiLinsysOps *ops, double c, double span, bool held) {
    CpsiChainProgram *program = &fixture->program;
    fixture->arena = (CpsiArena){0};
    cpsi_chain_program_layout(program, &fixture->arena, NODES, 0, false, 0, NULL, ops);
    assert_true(cpsi_arena_allocate(&fixture->arena));
    cpsi_chain_program_layout(program, &fixture->arena, NODES, 0, false, 0, NULL, ops);
    program->disc.count = program->unilateral.count = 0;
    program->held[0] = program->held[2] = held;
    program->base.load[3 * 1 + 2] = -1;
    program->segment.compliance = c;
    for (int i = 1; i < NODES; i++) {
        program->segment.length[i] = 0.5;
        program->segment.s[i][1] = span; /* e = (span/2)/0.5 along x */
    }
}

static CpsiIpmReport run(Fixture *fixture) {
    const CpsiIpmOptions options = {.target = 1e-12, .scale = 1, .max_iterations = 60};
    return cpsi_ipm_solve(&fixture->program.base, &options);
}

/* Inextensible, ends 0.6 apart: a 3-4-5 triangle, sag 0.4, 2 T (0.4/0.5) = 1. */
static void links_hang_in_a_triangle(void **ops) {
    Fixture fixture;
    make(&fixture, *ops, 0, 0.6, true);
    const CpsiIpmReport report = run(&fixture);
    assert_int_equal(report.outcome, CPSI_IPM_SOLVED);
    /* a gap of 1e-12 bounds errors by its square root */
    CHECK_NEAR(fixture.program.base.u[3 + 2], -0.4, 1e-6);
    for (int i = 1; i < NODES; i++) CHECK_NEAR(fixture.program.segment.z[i][0], 0.625, 1e-6);
    cpsi_arena_free(&fixture.arena);
}

/* Ends 1.5 apart, two links of 0.5: no configuration. */
static void ends_too_far_apart_are_infeasible(void **ops) {
    Fixture fixture;
    make(&fixture, *ops, 0, 1.5, true);
    assert_int_equal(run(&fixture).outcome, CPSI_IPM_INFEASIBLE);
    cpsi_arena_free(&fixture.arena);
}

/* With compliance the same ends only stretch the line: T = 0.5/c along the ends, to first order in
 * the load. */
static void compliance_makes_it_feasible(void **ops) {
    Fixture fixture;
    make(&fixture, *ops, 1e-3, 1.5, true);
    assert_int_equal(run(&fixture).outcome, CPSI_IPM_SOLVED);
    /* sag 1e-3: the tension rises by its square over two, 1e-6 of 500 */
    CHECK_RELATIVE(fixture.program.segment.z[1][0], 500, 1e-5);
    cpsi_arena_free(&fixture.arena);
}

/* Ends that nearly meet, so that the links are slack: drag alone bears the load on the middle node,
 * which stands for half of the line. A small one lets them go taut, at the sag v = (0.5^2 -
 * 0.1^2)^(1/2): 2 T v/0.5 = 1 - d v/2. */
static void drag_holds_back(void **ops) {
    Fixture fixture;
    make(&fixture, *ops, 0, 0.2, true);
    fixture.program.drag = 100;
    assert_int_equal(run(&fixture).outcome, CPSI_IPM_SOLVED);
    CHECK_NEAR(fixture.program.base.u[3 + 2], -1 / (100 * 0.5), 1e-6);
    CHECK_NEAR(fixture.program.segment.z[1][0], 0, 1e-6);
    cpsi_arena_free(&fixture.arena);
    make(&fixture, *ops, 0, 0.2, true);
    fixture.program.drag = 0.5;
    const double sag = sqrt(0.5 * 0.5 - 0.1 * 0.1);
    assert_int_equal(run(&fixture).outcome, CPSI_IPM_SOLVED);
    CHECK_NEAR(fixture.program.base.u[3 + 2], -sag, 1e-6);
    CHECK_NEAR(fixture.program.segment.z[1][0], (1 - 0.5 * 0.5 * sag) * 0.5 / (2 * sag), 1e-6);
    cpsi_arena_free(&fixture.arena);
}

/* Nothing holds the links: they fall for ever. */
static void free_fall_is_unbounded(void **ops) {
    Fixture fixture;
    make(&fixture, *ops, 0, 0.6, false);
    assert_int_equal(run(&fixture).outcome, CPSI_IPM_UNBOUNDED);
    cpsi_arena_free(&fixture.arena);
}

static void nan_does_not_leave(void **ops) {
    Fixture fixture;
    make(&fixture, *ops, 0, 0.6, true);
    fixture.program.base.load[3 * 1 + 2] = NAN;
    const CpsiIpmReport report = run(&fixture);
    assert_int_equal(report.outcome, CPSI_IPM_STALLED);
    for (int i = 0; i < 3 * NODES; i++) CHECK_FINITE(fixture.program.base.u[i]);
    cpsi_arena_free(&fixture.arena);
}

/* Rows from 1e8 to 1e-8, in each lane in another order: with sorted rows each keeps its own digits.
 * Against the inverse of a square case in closed form: A = D L, D the sizes, L unit lower
 * triangular, so that A x = y has the solution of L x = D^-1 y. */
static void graded_rows_keep_their_digits(void **unused) {
    (void)unused;
    enum { N = 3, FROM = 1, TO = 7 };
    static const double size[CPSI_LANES][N] = {{1, 1, 1},      {1e-8, 1e8, 1}, {1, 1e-8, 1e8},
                                               {1e8, 1, 1e-8}, {1e8, 1e-8, 1}, {1e-8, 1, 1e8},
                                               {1, 1e8, 1e-8}, {1, 1, 1}};
    static const double lower[N][N] = {{1, 0, 0}, {0.5, 1, 0}, {-2, 3, 1}}, x[N] = {1.25, -3, 7};
    CpsiLane a[N * N], y[N], beta[N], t[N], found[N], back[N], scratch[N * N + N];
    CpsiIndexLane row[N], column[N];
    CpsiLanesQr qr = {N, N, FROM, TO, a, beta, row, column};
    bool singular[CPSI_LANES];
    CPSI_FOR_LANES(l)
    for (int i = 0; i < N; i++) {
        y[i][l] = 0;
        for (int j = 0; j < N; j++) {
            a[N * i + j][l] = size[l][i] * lower[i][j];
            y[i][l] += size[l][i] * (lower[i][j] * x[j]);
        }
    }
    cpsi_lanes_qr_factor(&qr, singular, scratch);
    cpsi_lanes_permute(&qr, N, row, y, t);
    cpsi_lanes_qr_to(&qr, t);
    memcpy(back, t, sizeof t);
    cpsi_lanes_qr_solve(N, a, t);
    cpsi_lanes_permute_back(&qr, N, column, t, found);
    cpsi_lanes_qr_from(&qr, back);
    cpsi_lanes_permute_back(&qr, N, row, back, t);
    for (int l = FROM; l < TO; l++) {
        assert_false(singular[l]);
        /* rounding of each row, times the condition of L, about 20 */
        for (int i = 0; i < N; i++) CHECK_RELATIVE(found[i][l], x[i], 1e-13);
        for (int i = 0; i < N; i++) CHECK_NEAR(t[i][l], y[i][l], 1e-13 * 1e8 * fabs(x[1]));
    }
    /* R^-T takes the rows of A to those of Q, which are unit vectors; of the smallest nothing is
     * lost to the others' rounding */
    CPSI_FOR_LANES(l)
    for (int j = 0; j < N; j++) back[j][l] = size[l][0] * lower[0][j];
    cpsi_lanes_permute(&qr, N, column, back, t);
    cpsi_lanes_qr_solve_transposed(N, a, t);
    for (int l = FROM; l < TO; l++) {
        const double unit[N] = {t[0][l], t[1][l], t[2][l]};
        CHECK_RELATIVE(cpsi_norm(N, unit), 1, 1e-13);
    }
    CPSI_FOR_LANES(l)
    for (int i = 0; i < N; i++) {
        a[N * i][l] = 0;
        a[N * i + 1][l] = a[N * i + 2][l] = size[l][i];
    }
    a[4][FROM] = NAN;
    cpsi_lanes_qr_factor(&qr, singular, scratch);
    for (int l = FROM; l < TO; l++) assert_true(singular[l]); /* no rank, or no number */
}

int main(void) {
    void *chain = (void *)(uintptr_t)&cpsi_linsys_chain,
         *dense = (void *)(uintptr_t)&cpsi_linsys_dense;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(graded_rows_keep_their_digits),
        cmocka_unit_test_prestate(links_hang_in_a_triangle, chain),
        cmocka_unit_test_prestate(links_hang_in_a_triangle, dense),
        cmocka_unit_test_prestate(ends_too_far_apart_are_infeasible, chain),
        cmocka_unit_test_prestate(ends_too_far_apart_are_infeasible, dense),
        cmocka_unit_test_prestate(compliance_makes_it_feasible, chain),
        cmocka_unit_test_prestate(compliance_makes_it_feasible, dense),
        cmocka_unit_test_prestate(drag_holds_back, chain),
        cmocka_unit_test_prestate(free_fall_is_unbounded, chain),
        cmocka_unit_test_prestate(drag_holds_back, dense),
        cmocka_unit_test_prestate(free_fall_is_unbounded, dense),
        cmocka_unit_test_prestate(nan_does_not_leave, chain),
        cmocka_unit_test_prestate(nan_does_not_leave, dense),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
