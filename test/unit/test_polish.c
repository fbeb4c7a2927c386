/* SPDX-License-Identifier: BSD-3-Clause */
/* The end of the interior-point loop by Newton's method: ropes on a floor with friction that
 * follows the reactions, drawn at random. What the method solves satisfies the equations of the
 * rope to rounding; where it has not ended, the program is what it was, bit for bit. */
#include <math.h>
#include <string.h>

#include "chain/chain_program.h"
#include "chain/polish.h"
#include "check.h"
#include "ipm/ipm.h"
#include "splitmix.h"

enum { MOST_NODES = 40, CASES = 200, ENOUGH = 8 };
static const double TARGET = 1e-11, GRAVITY = 1;

typedef struct Rope {
    int nodes;
    double compliance, friction, pull[3];
    bool coupled, field;
} Rope;

typedef struct Fixture {
    CpsiArena arena;
    CpsiChainProgram program;
    double stiffness[6 * MOST_NODES];
} Fixture;

/* What the loop and the method change. */
typedef struct Iterate {
    double u[3 * MOST_NODES], segment[2][4 * MOST_NODES], contact[2][MOST_NODES],
        disc[2][3 * MOST_NODES];
} Iterate;

static Rope draw(uint64_t *state) {
    Rope rope = {.nodes = (int)splitmix(state, 4, MOST_NODES)};
    rope.compliance = pow(10, splitmix(state, -5, -1));
    rope.friction = splitmix(state, 0, 2);
    rope.coupled = splitmix(state, 0, 1) < 0.7;
    rope.field = splitmix(state, 0, 1) < 0.2;
    const double turn = splitmix(state, 0, 6.283185307179586), size = splitmix(state, 0, 1);
    rope.pull[0] = size * cos(turn);
    rope.pull[1] = size * sin(turn);
    rope.pull[2] = splitmix(state, -0.2, 0.6);
    return rope;
}

/* Node 0 is held, and the last one is pulled. */
static void make(Fixture *fixture, const Rope *rope) {
    CpsiChainProgram *program = &fixture->program;
    const int n = rope->nodes, last = n - 1;
    fixture->arena = (CpsiArena){0};
    for (int pass = 0; pass < 2; pass++) {
        cpsi_chain_program_layout(program, &fixture->arena, n, 0, false, 0, NULL,
                                  &cpsi_linsys_chain);
        if (pass == 0) assert_true(cpsi_arena_allocate(&fixture->arena));
    }
    program->bounds_coupled = rope->coupled;
    program->segment.compliance = rope->compliance;
    program->held[0] = true;
    program->unilateral.count = program->disc.count = last;
    for (int j = 0; j < n; j++) {
        const double share = (j == 0 || j == last ? 0.5 : 1) / last;
        program->base.load[3 * j + 2] = -GRAVITY * share;
        if (j > 0) {
            program->segment.length[j] = 1.0 / last;
            program->segment.s[j][1] = 1;
            program->unilateral.node[j - 1] = program->disc.node[j - 1] = j;
            program->unilateral.weight[j - 1] = program->disc.weight[j - 1] = share;
            program->disc.unilateral[j - 1] = j - 1;
            program->disc.friction[j - 1] = rope->friction;
            program->disc.z[j - 1][0] = rope->friction * GRAVITY;
        }
        const double k[6] = {share, 0.1 * share, share, 0, 0, share};
        memcpy(&fixture->stiffness[6 * j], k, sizeof k);
    }
    if (rope->field) program->field = fixture->stiffness;
    for (int a = 0; a < 3; a++) program->base.load[3 * last + a] += rope->pull[a];
}

static CpsiIpmReport run(Fixture *fixture, double target, int refinements, bool goes_on) {
    const CpsiIpmOptions options = {.target = target,
                                    .scale = 1,
                                    .max_iterations = 100,
                                    .centering_steps = refinements > 0 ? 2 : 0,
                                    .sharpenings = refinements,
                                    .goes_on = goes_on};
    return cpsi_ipm_solve(&fixture->program.base, &options);
}

static Iterate read(const Fixture *fixture) {
    const CpsiChainProgram *program = &fixture->program;
    const size_t n = (size_t)program->n;
    Iterate out;
    memset(&out, 0, sizeof out);
    memcpy(out.u, program->base.u, 3 * n * sizeof *out.u);
    memcpy(&out.segment[0][4], program->segment.s[1], 4 * (n - 1) * sizeof(double));
    memcpy(&out.segment[1][4], program->segment.z[1], 4 * (n - 1) * sizeof(double));
    memcpy(out.contact[0], program->unilateral.s, (n - 1) * sizeof(double));
    memcpy(out.contact[1], program->unilateral.z, (n - 1) * sizeof(double));
    memcpy(out.disc[0], program->disc.s, 3 * (n - 1) * sizeof(double));
    memcpy(out.disc[1], program->disc.z, 3 * (n - 1) * sizeof(double));
    return out;
}

static CpsiIpmReport polish(Fixture *fixture, int most) {
    static double u[3 * MOST_NODES], e[3 * MOST_NODES], tension[MOST_NODES];
    const CpsiKept kept = {.u = u, .e = e, .tension = tension};
    return cpsi_chain_polish(&fixture->program, &kept, most);
}

/* The equations of the rope, from places, tensions, reactions and friction alone. */
static void check_equations(const Fixture *fixture, const Rope *rope) {
    const CpsiChainProgram *program = &fixture->program;
    const int n = rope->nodes, last = n - 1;
    const double length = 1.0 / last, *u = program->base.u, rounding = 2e-13 * n;
    double force[3 * MOST_NODES] = {0}, largest = 1;
    for (int i = 1; i < n; i++) {
        double e[3], size = 0;
        for (int a = 0; a < 3; a++) {
            e[a] = (a == 0) + (u[3 * i + a] - u[3 * (i - 1) + a]) / length;
            size += e[a] * e[a];
        }
        size = sqrt(size);
        const double tension = program->segment.z[i][0];
        assert_true(tension >= 0);
        if (tension > 0)
            CHECK_NEAR(size - 1, rope->compliance * tension, rounding);
        else
            CHECK_LESS(size - 1, rounding);
        largest = fmax(largest, tension);
        for (int a = 0; a < 3; a++) {
            force[3 * (i - 1) + a] += tension * e[a] / size;
            force[3 * i + a] -= tension * e[a] / size;
        }
    }
    for (int j = 1; j < n; j++) {
        const double *z = program->disc.z[j - 1], weight = program->disc.weight[j - 1],
                     reaction = program->unilateral.z[j - 1], height = u[3 * j + 2];
        const double bound = rope->coupled ? rope->friction * reaction : rope->friction * GRAVITY,
                     slip = hypot(u[3 * j], u[3 * j + 1]), friction = hypot(z[1], z[2]);
        CHECK_LESS(-1e-15, height);
        assert_true(reaction >= 0 && (reaction == 0 || fabs(height) < 1e-15));
        CHECK_LESS(friction, bound * (1 + 1e-12) + 1e-15);
        if (slip > 1e-9) {
            CHECK_NEAR(friction, bound, 1e-11 * largest / weight * length);
            CHECK_NEAR(z[1] * u[3 * j] + z[2] * u[3 * j + 1], -friction * slip,
                       1e-12 * friction * slip);
        }
        /* a slip is known to the rounding of places, and its direction to that over the slip */
        const double turned = slip > 1e-9 ? weight * bound * 1e-15 / slip : 0;
        const double contact[3] = {weight * z[1], weight * z[2], weight * reaction};
        const double *k = &fixture->stiffness[6 * j];
        for (int a = 0; a < 3; a++) {
            double sum = force[3 * j + a] + contact[a] + program->base.load[3 * j + a];
            if (rope->field && a < 2) sum -= k[a] * u[3 * j] + k[1 + a] * u[3 * j + 1];
            if (rope->field && a == 2) sum -= k[5] * height;
            CHECK_NEAR(sum, 0, 1e-11 * largest + turned);
        }
    }
}

/* Up to where the loop has reached its target. */
static void start(Fixture *fixture, const Rope *rope) {
    make(fixture, rope);
    assert_int_equal(run(fixture, TARGET, 0, false).outcome, CPSI_IPM_SOLVED);
}

static void solves_the_equations(void **unused) {
    (void)unused;
    uint64_t random = 20;
    int polished = 0;
    for (int i = 0; i < CASES; i++) {
        static Fixture fixture;
        const Rope rope = draw(&random);
        start(&fixture, &rope);
        if (polish(&fixture, ENOUGH).outcome == CPSI_IPM_SOLVED) {
            polished++;
            check_equations(&fixture, &rope);
        }
        cpsi_arena_free(&fixture.arena);
    }
    CHECK_GREATER(polished, CASES * 9 / 10);
}

/* Given up after no linear system, and after one, which does not suffice: the loop goes on as if
 * nothing had been tried. */
static void leaves_no_trace(void **unused) {
    (void)unused;
    uint64_t random = 21;
    int given_up[2] = {0};
    for (int i = 0; i < CASES; i++) {
        static Fixture tried, alone;
        const Rope rope = draw(&random);
        start(&tried, &rope);
        start(&alone, &rope);
        const Iterate before = read(&tried);
        bool gave_up = false;
        for (int most = 0; most < 2; most++) {
            const CpsiIpmReport report = polish(&tried, most);
            const Iterate after = read(&tried);
            CHECK_LESS(report.iterations, most + 1);
            gave_up = report.outcome != CPSI_IPM_SOLVED;
            if (!gave_up) break;
            assert_memory_equal(&after, &before, sizeof after);
            given_up[most]++;
        }
        if (gave_up) {
            const CpsiIpmReport on = run(&tried, 1e-13, 6, true),
                                other = run(&alone, 1e-13, 6, true);
            const Iterate here = read(&tried), there = read(&alone);
            CHECK_INT(on.iterations, other.iterations);
            assert_memory_equal(&here, &there, sizeof here);
        }
        cpsi_arena_free(&tried.arena);
        cpsi_arena_free(&alone.arena);
    }
    CHECK_INT(given_up[0], CASES);
    CHECK_GREATER(given_up[1], CASES / 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(solves_the_equations),
                                       cmocka_unit_test(leaves_no_trace)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
