/* SPDX-License-Identifier: BSD-3-Clause */
/* Overdamped motion of one element, held at A: its time step against the balance of forces by hand,
 * and where it comes to rest.
 *
 * Node B stands for half of the element, l/2 of the line of length l. With the unit of force F0 and
 * the drag d a displacement u takes the force F0 d u/(2 l), so along the element, of stiffness EA,
 * under a load P along it and friction mu N that it slides against,
 *
 *     EA ((x + u)/l - 1) + F0 d u/(2 l) + mu N = P,
 *         u = (P - mu N - EA (x/l - 1))/(EA/l + F0 d/(2 l)) or 0. */
#include "evolve/relaxation.h"

#include <string.h>

#include "check.h"
#include "splitmix.h"

enum { CASES = 300 };

typedef struct Fixture {
    CpsiArena arena;
    CpsiLine line;
    CpsiChainProgram program;
    CpsiObstacle bed;
    double start[6];
} Fixture;

static void lay_out(Fixture *f) {
    cpsi_line_layout(&f->line, &f->arena);
    cpsi_chain_program_layout(&f->program, &f->arena, 2, 0, false, 0, NULL, &cpsi_linsys_chain);
}

/* An element of this length and stiffness, weight [N/m] along -z, from 0 to `to`; on the plane z =
 * 0 with friction mu, or in the air. */
static void begin(Fixture *f, double length, double stiffness, double weight, bool lies, double mu,
                  const double to[3], const double force[3]) {
    *f = (Fixture){0};
    CpsiLine *line = &f->line;
    CpsObstacle bed = cps_obstacle_default();
    bed.friction = mu;
    f->bed = cpsi_obstacle(&bed);
    line->n = 2;
    line->contacts = 1;
    line->compliance = 1 / stiffness;
    line->obstacle = &f->bed;
    line->obstacle_count = lies;
    lay_out(f);
    assert_true(cpsi_arena_allocate(&f->arena));
    lay_out(f);
    line->length = length;
    line->weight[2] = -weight;
    line->weight_before[2] = -weight;
    line->element_length[0] = length;
    cpsi_line_set_arc_length(line);
    cpsi_chain_program_resize(&f->program, 2, false);
    for (int a = 0; a < 3; a++) line->common_axes[4 * a] = 1;
    memcpy(&line->position[3], to, 3 * sizeof *to);
    line->end[CPS_END_A] = (CpsEnd){CPS_END_KIND_HELD, {0, 0, 0}};
    line->end[CPS_END_B] = (CpsEnd){CPS_END_KIND_FREE, {force[0], force[1], force[2]}};
}

static CpsiStepOptions step_options(void) {
    CpsiStepOptions options = {.solver = cps_scene_default().solver};
    options.friction_policy = CPS_FRICTION_POLICY_CONSISTENT;
    options.contact_policy = CPS_CONTACT_POLICY_REACHED;
    return options;
}

static double decades(uint64_t *seed, double low, double high) {
    return pow(10, splitmix(seed, low, high));
}

/* A hanging element: P is half its weight and what pulls at B. */
static void hangs(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < CASES; i++) {
        const double l = decades(&seed, -2, 3), weight = decades(&seed, -3, 3),
                     pull = splitmix(&seed, 0, 2) * weight * l;
        const double stiffness = weight * l * decades(&seed, 0, 4), drag = decades(&seed, -3, 3);
        const double x = l * (1 + splitmix(&seed, 0, 2) * weight * l / stiffness),
                     load = 0.5 * weight * l + pull;
        const double to[3] = {0, 0, -x}, force[3] = {0, 0, -pull}, unit = fmax(load, weight * l);
        Fixture f;
        begin(&f, l, stiffness, weight, false, 0, to, force);
        const CpsiStepOptions options = step_options();
        const CpsiDampedStep step = cpsi_line_damped_step(&f.line, &f.program, &options, drag);
        const double u = (load - stiffness * (x / l - 1)) / (stiffness / l + unit * drag / (2 * l));
        assert_true(step.solved && !step.shortened);
        CHECK_NEAR((f.line.position[5] + x + u) / l, 0, 1e-9);
        CHECK_NEAR((step.distance - fabs(u)) / l, 0, 1e-9);
        cpsi_arena_free(&f.arena);
    }
}

/* An element that lies on the ground and is pulled along x: N is half its weight. */
static void slides(void **state) {
    (void)state;
    uint64_t seed = 6;
    int stuck = 0, slid = 0;
    for (int i = 0; i < CASES; i++) {
        const double l = decades(&seed, -2, 3), weight = decades(&seed, -3, 3),
                     mu = splitmix(&seed, 0.05, 1.5);
        const double stiffness = weight * l * decades(&seed, 0, 4), drag = decades(&seed, -3, 3),
                     pull = splitmix(&seed, 0.1, 2) * weight * l;
        const double x = l * (1 + splitmix(&seed, 0, 0.5) * weight * l / stiffness),
                     normal = 0.5 * weight * l;
        const double to[3] = {x, 0, 0}, force[3] = {pull, 0, 0},
                     rest = pull - stiffness * (x / l - 1);
        const double unit = fmax(weight * l, hypot(pull, normal)),
                     stiff = stiffness / l + unit * drag / (2 * l);
        const double u =
            fabs(rest) > mu * normal ? (rest - copysign(mu * normal, rest)) / stiff : 0;
        Fixture f;
        begin(&f, l, stiffness, weight, true, mu, to, force);
        const CpsiStepOptions options = step_options();
        const CpsiDampedStep step = cpsi_line_damped_step(&f.line, &f.program, &options, drag);
        assert_true(step.solved);
        CHECK_NEAR((f.line.position[3] - x - u) / l, 0, 1e-9);
        CHECK_NEAR(f.line.position[5] / l, 0, 1e-12);
        CHECK_NEAR(f.line.report.dissipated / (unit * l), mu * normal * fabs(u) / (unit * l), 1e-9);
        stuck += u == 0;
        slid += u != 0;
        cpsi_arena_free(&f.arena);
    }
    CHECK_GREATER(stuck, CASES / 10);
    CHECK_GREATER(slid, CASES / 10);
}

/* Let go from anywhere within its length, the element comes to rest below A; what the weight gives
 * and the element does not keep is lost. */
static void rests(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int i = 0; i < CASES / 10; i++) {
        const double l = decades(&seed, -2, 3), weight = decades(&seed, -3, 3),
                     stiffness = weight * l * decades(&seed, 1, 4);
        const double along = l * splitmix(&seed, 0.2, 1), angle = splitmix(&seed, -1.5, 1.5),
                     turn = splitmix(&seed, -3, 3);
        const double to[3] = {along * sin(angle) * cos(turn), along * sin(angle) * sin(turn),
                              -along * cos(angle)},
                     none[3] = {0, 0, 0};
        const double load = 0.5 * weight * l, down = l * (1 + load / stiffness);
        Fixture f;
        begin(&f, l, stiffness, weight, false, 0, to, none);
        const CpsiStepOptions options = step_options();
        CpsiRelaxation done;
        assert_true(cpsi_line_relax(&f.line, &f.program, &options, f.line.end, false, &done));
        /* at rest drag times motion is 1e-7 of the loads, which a pendulum answers with as much of
         * its length, a line with less */
        CHECK_NEAR(f.line.position[3] / l, 0, 1e-5);
        CHECK_NEAR(f.line.position[4] / l, 0, 1e-5);
        CHECK_NEAR((f.line.position[5] + down) / l, 0, 1e-5);
        const double fallen = load * (down - along * cos(angle)), kept = 0.5 * load * (down - l);
        CHECK_NEAR(done.ledger.imbalance / (load * l), (fallen - kept) / (load * l), 1e-5);
        CHECK_NEAR(done.dissipated, 0, 0);
        cpsi_arena_free(&f.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(hangs), cmocka_unit_test(slides),
                                       cmocka_unit_test(rests)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
