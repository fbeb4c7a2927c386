/* SPDX-License-Identifier: BSD-3-Clause */
/* The interior-point loop on small programs whose answer is known, with both linear systems: a hanging pair of links, and the two
 * ways of having no answer. */
#include "ipm/chain_program.h"
#include "ipm/ipm.h"

#include "check.h"

enum { NODES = 3 };

typedef struct Fixture {
    CpsiArena arena;
    CpsiChainProgram program;
} Fixture;

/* Two equal elements of compliance c; nodes 0 and 2 held at (0,0,0) and (span,0,0) as `held` says, load (0,0,-1) on node 1. */
static void make(Fixture *fixture, const CpsiLinsysOps *ops, double c, double span, bool held) {
    CpsiChainProgram *program = &fixture->program;
    fixture->arena = (CpsiArena){0};
    cpsi_chain_program_layout(program, &fixture->arena, NODES, false, ops);
    assert_true(cpsi_arena_allocate(&fixture->arena));
    cpsi_chain_program_layout(program, &fixture->arena, NODES, false, ops);
    program->rub.count = program->stop.count = 0;
    program->held[0] = program->held[2] = held;
    program->base.load[3*1 + 2] = -1;
    program->stretch.compliance = c;
    for (int i = 1; i < NODES; i++) {
        program->stretch.length[i] = 0.5;
        program->stretch.s[i][1] = span; /* e = (span/2)/0.5 along x */
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
    for (int i = 1; i < NODES; i++) CHECK_NEAR(fixture.program.stretch.z[i][0], 0.625, 1e-6);
    cpsi_arena_free(&fixture.arena);
}

/* Ends 1.5 apart, two links of 0.5: no configuration. */
static void ends_too_far_apart_are_infeasible(void **ops) {
    Fixture fixture;
    make(&fixture, *ops, 0, 1.5, true);
    assert_int_equal(run(&fixture).outcome, CPSI_IPM_INFEASIBLE);
    cpsi_arena_free(&fixture.arena);
}

/* With compliance the same ends only stretch the line: T = 0.5/c along the ends, to first order in the load. */
static void compliance_makes_it_feasible(void **ops) {
    Fixture fixture;
    make(&fixture, *ops, 1e-3, 1.5, true);
    assert_int_equal(run(&fixture).outcome, CPSI_IPM_SOLVED);
    /* sag 1e-3: the tension rises by its square over two, 1e-6 of 500 */
    CHECK_RELATIVE(fixture.program.stretch.z[1][0], 500, 1e-5);
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
    fixture.program.base.load[3*1 + 2] = NAN;
    const CpsiIpmReport report = run(&fixture);
    assert_int_equal(report.outcome, CPSI_IPM_STALLED);
    for (int i = 0; i < 3*NODES; i++) CHECK_FINITE(fixture.program.base.u[i]);
    cpsi_arena_free(&fixture.arena);
}

int main(void) {
    void *chain = (void *)(uintptr_t)&cpsi_linsys_chain, *dense = (void *)(uintptr_t)&cpsi_linsys_dense;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(links_hang_in_a_triangle, chain),
        cmocka_unit_test_prestate(links_hang_in_a_triangle, dense),
        cmocka_unit_test_prestate(ends_too_far_apart_are_infeasible, chain),
        cmocka_unit_test_prestate(ends_too_far_apart_are_infeasible, dense),
        cmocka_unit_test_prestate(compliance_makes_it_feasible, chain),
        cmocka_unit_test_prestate(compliance_makes_it_feasible, dense),
        cmocka_unit_test_prestate(free_fall_is_unbounded, chain),
        cmocka_unit_test_prestate(free_fall_is_unbounded, dense),
        cmocka_unit_test_prestate(nan_does_not_leave, chain),
        cmocka_unit_test_prestate(nan_does_not_leave, dense),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
