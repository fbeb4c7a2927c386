/* SPDX-License-Identifier: BSD-3-Clause */
/* The quadratic energy of nodes (cable/field.h): a node on a spring by hand, and random lines
 * against Newton's method on the energy
 *
 *     sum (EA l/2) ((|x_i - x_i-1|/l - 1)^+)^2 + sum (x_j - a_j)'K_j (x_j - a_j)/2 - sum b_j.x_j,
 *
 * all unknowns in one dense matrix, which shares nothing with the program over a chain. */
#include "cable/field.h"

#include <string.h>

#include "cable/line_solve.h"
#include "cable/line_step.h"
#include "check.h"
#include "splitmix.h"

enum { CASES = 400, NODES = 12, UNKNOWNS = 3 * NODES };

typedef struct Fixture {
    CpsiArena arena;
    CpsiLine line;
    CpsiChainProgram program;
    CpsiLeastMotion least;
    CpsiObstacle bed;
    double ea;
} Fixture;

static void lay_out(Fixture *f) {
    cpsi_line_layout(&f->line, &f->arena);
    cpsi_chain_program_layout(&f->program, &f->arena, f->line.n, 0, false, 0, NULL,
                              &cpsi_linsys_chain);
    cpsi_least_motion_layout(&f->least, &f->arena, f->line.n, 1, &f->program);
}

/* A line of n nodes of this length and stiffness, straight along x, on a bed z = 0 or in the air;
 * held at A and B or free there. */
static void begin(Fixture *f, int n, double length, double ea, bool lies, const bool held[2]) {
    *f = (Fixture){.ea = ea};
    CpsiLine *line = &f->line;
    CpsObstacle bed = cps_obstacle_default();
    bed.friction = 0.3;
    f->bed = cpsi_obstacle(&bed);
    line->n = n;
    line->contacts = 1;
    line->compliance = 1 / ea;
    line->obstacle = &f->bed;
    line->obstacle_count = lies;
    line->has_field = line->has_node_loads = true;
    lay_out(f);
    assert_true(cpsi_arena_allocate(&f->arena));
    lay_out(f);
    line->length = length;
    for (int e = 0; e + 1 < n; e++) line->element_length[e] = length / (n - 1);
    cpsi_line_set_arc_length(line);
    for (int a = 0; a < 3; a++) line->common_axes[4 * a] = 1;
    for (int j = 0; j < n; j++) line->position[3 * j] = line->arc_length[j];
    for (int end = 0; end < 2; end++)
        line->end[end].kind = held[end] ? CPS_END_KIND_HELD : CPS_END_KIND_FREE;
}

/* Move the whole line, as it stands, and its held ends. */
static void move(CpsiLine *line, const double by[3]) {
    for (int i = 0; i < 3 * line->n; i++) line->position[i] += by[i % 3];
    for (int end = 0; end < 2; end++)
        if (line->end[end].kind == CPS_END_KIND_HELD)
            memcpy(line->end[end].value, &line->position[end == CPS_END_A ? 0 : 3 * (line->n - 1)],
                   3 * sizeof(double));
}

static void step(Fixture *f) {
    CpsiStepOptions options = {.solver = cps_scene_default().solver, .least = &f->least};
    options.friction_policy = CPS_FRICTION_POLICY_CONSISTENT;
    options.contact_policy = CPS_CONTACT_POLICY_REACHED;
    cpsi_line_step(&f->line, &f->program, &options);
}

/* a random K >= 0 of this rank and size */
static void random_stiffness(uint64_t *seed, int rank, double size, double k[6]) {
    static const int ROW[6] = {0, 0, 1, 0, 1, 2}, COLUMN[6] = {0, 1, 1, 2, 2, 2};
    memset(k, 0, 6 * sizeof *k);
    for (int i = 0; i < rank; i++) {
        double v[3];
        for (int a = 0; a < 3; a++) v[a] = splitmix(seed, -1, 1);
        for (int b = 0; b < 6; b++) k[b] += size * v[ROW[b]] * v[COLUMN[b]];
    }
    if (rank == 3)
        for (int b = 0; b < 6; b++)
            if (ROW[b] == COLUMN[b]) k[b] += 0.1 * size;
}

/* dense Newton --------------------------------------------------------------------------------- */

typedef struct Dense {
    const CpsiLine *line;
    double ea, x[UNKNOWNS], gradient[UNKNOWNS], hessian[UNKNOWNS][UNKNOWNS];
    double given[UNKNOWNS]; /* loads of the nodes */
    double stiffness[6 * NODES], place[UNKNOWNS];
} Dense;

static bool is_given(const Dense *d, int i) { return cpsi_line_is_held(d->line, i / 3); }

static double evaluate(Dense *d, const double *x) {
    static const int AT[9] = {0, 1, 3, 1, 2, 4, 3, 4, 5};
    double energy = 0;
    memset(d->gradient, 0, sizeof d->gradient);
    memset(d->hessian, 0, sizeof d->hessian);
    for (int j = 0; j < d->line->n; j++)
        for (int a = 0; a < 3; a++) {
            energy -= d->given[3 * j + a] * (x[3 * j + a] - d->place[3 * j + a]);
            d->gradient[3 * j + a] -= d->given[3 * j + a];
            for (int b = 0; b < 3; b++) {
                const double k = d->stiffness[6 * j + AT[3 * a + b]],
                             off = x[3 * j + b] - d->place[3 * j + b];
                energy += 0.5 * (x[3 * j + a] - d->place[3 * j + a]) * k * off;
                d->gradient[3 * j + a] += k * off;
                d->hessian[3 * j + a][3 * j + b] += k;
            }
        }
    for (int i = 1; i < d->line->n; i++) {
        const double l = d->line->element_length[i - 1];
        double t[3], size = 0;
        for (int a = 0; a < 3; a++) {
            t[a] = x[3 * i + a] - x[3 * i - 3 + a];
            size += t[a] * t[a];
        }
        size = sqrt(size);
        const double over = size / l - 1;
        if (!(over > 0)) continue;
        energy += 0.5 * d->ea * l * over * over;
        for (int a = 0; a < 3; a++) t[a] /= size;
        for (int a = 0; a < 3; a++) {
            d->gradient[3 * i + a] += d->ea * over * t[a];
            d->gradient[3 * i - 3 + a] -= d->ea * over * t[a];
            for (int b = 0; b < 3; b++) {
                const double k =
                    d->ea / l * t[a] * t[b] + d->ea * over / size * ((a == b) - t[a] * t[b]);
                d->hessian[3 * i + a][3 * i + b] += k;
                d->hessian[3 * i - 3 + a][3 * i - 3 + b] += k;
                d->hessian[3 * i + a][3 * i - 3 + b] -= k;
                d->hessian[3 * i - 3 + a][3 * i + b] -= k;
            }
        }
    }
    return energy;
}

/* The direction of Newton's method by Cholesky's factors; a small share of the diagonal is added so
 * that there is one where a slack line leaves the Hessian singular. */
static void direction(Dense *d, double v[UNKNOWNS]) {
    const int m = 3 * d->line->n;
    for (int i = 0; i < m; i++) {
        v[i] = is_given(d, i) ? 0 : -d->gradient[i];
        for (int j = 0; j < m; j++)
            if (is_given(d, i) || is_given(d, j)) d->hessian[i][j] = i == j;
        d->hessian[i][i] += 1e-10 * d->ea / d->line->length;
    }
    for (int i = 0; i < m; i++)
        for (int j = 0; j <= i; j++) {
            double sum = d->hessian[i][j];
            for (int k = 0; k < j; k++) sum -= d->hessian[i][k] * d->hessian[j][k];
            d->hessian[i][j] = i == j ? sqrt(sum) : sum / d->hessian[j][j];
        }
    for (int i = 0; i < m; i++) {
        for (int k = 0; k < i; k++) v[i] -= d->hessian[i][k] * v[k];
        v[i] /= d->hessian[i][i];
    }
    for (int i = m - 1; i >= 0; i--) {
        for (int k = i + 1; k < m; k++) v[i] -= d->hessian[k][i] * v[k];
        v[i] /= d->hessian[i][i];
    }
}

/* Newton's method with halved steps; returns the least energy. */
static double minimise(Dense *d) {
    const int m = 3 * d->line->n;
    double v[UNKNOWNS], to[UNKNOWNS], energy = 0;
    for (int k = 0; k < 500; k++) {
        energy = evaluate(d, d->x);
        direction(d, v);
        double share = 1, moved = 0, falls = 0;
        for (int i = 0; i < m; i++) {
            moved = fmax(moved, fabs(v[i]));
            falls += v[i] * d->gradient[i];
        }
        if (moved < 1e-13 * d->line->length) break;
        for (; share > 1e-12; share *= 0.5) {
            for (int i = 0; i < m; i++) to[i] = d->x[i] + share * v[i];
            if (evaluate(d, to) <= energy + 1e-4 * share * falls) break;
        }
        if (share <= 1e-12) break; /* what is left is rounding */
        memcpy(d->x, to, sizeof to);
    }
    return energy;
}

/* cases ---------------------------------------------------------------------------------------- */

/* Two nodes held by springs alone: the element is slack, each node is where its load takes it, and
 * what is reported balances. */
static void line_held_by_springs(void **state) {
    (void)state;
    const bool held[2] = {false, false};
    Fixture f;
    begin(&f, 2, 2, 1e3, false, held);
    cpsi_line_field_clear(&f.line);
    const double k[6] = {50, 0, 40, 0, 0, 20};
    cpsi_line_field_add(&f.line, 0, k, vec3(0, 0, 0));
    cpsi_line_field_add(&f.line, 1, k, vec3(1, 0, 0));
    f.line.field.load[3 + 2] = -10;
    step(&f);
    assert_int_equal(f.line.report.outcome, CPS_OUTCOME_SOLVED);
    assert_int_equal(f.line.report.places, CPS_PLACES_UNIQUE);
    CHECK_NEAR(f.line.position[0], 0, 1e-10);
    CHECK_NEAR(f.line.position[3], 1, 1e-10);
    CHECK_NEAR(f.line.position[5], -0.5, 1e-10);
    CHECK_NEAR(f.line.report.certificate.primal, -2.5, 1e-9); /* 20/2 0.25 - 10 0.5 */
    CHECK_NEAR(f.line.report.certificate.dual, -2.5, 1e-9);
    cpsi_arena_free(&f.arena);
}

/* Springs across gravity alone leave a line without a hold to fall; with a stiffness along it they
 * do not. */
static void line_falls_past_springs(void **state) {
    (void)state;
    const bool held[2] = {false, false};
    for (int along = 0; along < 2; along++) {
        Fixture f;
        begin(&f, 3, 2, 1e3, false, held);
        f.line.weight[2] = f.line.weight_before[2] = -5;
        cpsi_line_field_clear(&f.line);
        const double k[6] = {50, 0, 40, 0, 0, 20.0 * along};
        cpsi_line_field_add(&f.line, 1, k, vec3_at(f.line.position, 1));
        step(&f);
        assert_int_equal(f.line.report.outcome, along ? CPS_OUTCOME_SOLVED : CPS_OUTCOME_UNBOUNDED);
        if (along) CHECK_NEAR(f.line.position[5], -0.5, 1e-8); /* 10 N on 20 N/m */
        if (!along) {
            CHECK_NEAR(f.line.report.proof[2], -1, 1e-12);
            CHECK_NEAR(f.line.report.proof_force, 10, 1e-9);
        }
        cpsi_arena_free(&f.arena);
    }
}

/* Held nodes and springs cannot both have their way: an inextensible line that is too short is so
 * with springs as well. */
static void short_line_is_short(void **state) {
    (void)state;
    const bool held[2] = {true, true};
    Fixture f;
    begin(&f, 5, 2, INFINITY, false, held);
    const double none[3] = {0, 0, 0}, k[6] = {50, 0, 40, 0, 0, 20};
    move(&f.line, none);
    f.line.end[CPS_END_B].value[0] = 2.5;
    cpsi_line_field_clear(&f.line);
    cpsi_line_field_add(&f.line, 2, k, vec3(0, 0, 5));
    step(&f);
    assert_int_equal(f.line.report.outcome, CPS_OUTCOME_INFEASIBLE);
    CHECK_NEAR(f.line.report.proof_length, 0.5, 1e-12);
    cpsi_arena_free(&f.arena);
}

/* A block on the bed that a spring pulls along it: it sticks up to mu N, and then slips until the
 * spring has mu N left. */
static void spring_against_friction(void **state) {
    (void)state;
    const bool held[2] = {false, false};
    for (int i = 0; i < 2; i++) {
        const double far = i == 0 ? 0.1 : 0.5, k[6] = {20, 0, 20, 0, 0, 0};
        Fixture f;
        begin(&f, 2, 1, 1e4, true, held);
        f.line.weight[2] = f.line.weight_before[2] = -20; /* mu N = 6 in all, 3 a node */
        cpsi_line_field_clear(&f.line);
        for (int j = 0; j < 2; j++) {
            cpsi_line_field_add(&f.line, j, k, vec3(f.line.position[3 * j], far, 0));
            f.line.reaction[j] = 10;
            f.line.state[j] = CPS_NODE_STATE_STICK;
        }
        step(&f);
        assert_int_equal(f.line.report.outcome, CPS_OUTCOME_SOLVED);
        for (int j = 0; j < 2; j++)
            CHECK_NEAR(f.line.position[3 * j + 1], fmax(0, far - 3.0 / 20), 1e-9);
        CHECK_NEAR(f.line.report.dissipated, 2 * 3 * fmax(0, far - 3.0 / 20), 1e-8);
        cpsi_arena_free(&f.arena);
    }
}

typedef struct Worst {
    double place, energy, gap;
} Worst;

static void random_case(uint64_t *seed, Worst *worst) {
    const int n = 2 + (int)splitmix(seed, 0, NODES - 1);
    const double length = pow(10, splitmix(seed, -2, 3)), force = pow(10, splitmix(seed, -2, 4)),
                 ea = force * pow(10, splitmix(seed, 0, 4));
    bool held[2];
    for (int end = 0; end < 2; end++) held[end] = splitmix(seed, 0, 1) < (end ? 0.3 : 0.5);
    const bool anchored = splitmix(seed, 0, 1) < 0.7 || !(held[0] && held[1]);
    /* a stiff field is that of a mass in a short time step: the line goes nearly where it wants */
    const double stiff = pow(10, splitmix(seed, -2, 8)), size = force / length * stiff,
                 reach = length * fmin(0.3, 1e4 / stiff);
    double far[3] = {0, 0, 0};
    for (int a = 0; a < 2; a++) far[a] = length * splitmix(seed, -100, 100);
    Fixture f;
    Dense d = {.line = &f.line, .ea = ea};
    begin(&f, n, length, ea, false, held);
    move(&f.line, far);
    for (int end = 0; end < 2; end++)
        if (held[end])
            for (int a = 0; a < 3; a++)
                f.line.end[end].value[a] += splitmix(seed, -0.2, 0.2) * length;
    cpsi_line_field_clear(&f.line);
    for (int j = 0; j < n; j++) {
        /* of two terms, whose sum is theirs */
        for (int term = 0; term < 2; term++) {
            double k[6], place[3];
            const int rank = anchored && term == 0 ? 3 : (int)splitmix(seed, 0, 4);
            random_stiffness(seed, rank, size, k);
            for (int a = 0; a < 3; a++)
                place[a] = f.line.position[3 * j + a] + reach * splitmix(seed, -1, 1);
            cpsi_line_field_add(&f.line, j, k, vec3_load(place));
            /* K1 + K2 and K1 a1 + K2 a2, the latter kept as a load about the place of the line */
            const Vec3 off = vec3_sub(vec3_load(place), vec3_at(f.line.position, j));
            for (int b = 0; b < 6; b++) d.stiffness[6 * j + b] += k[b];
            d.given[3 * j] += k[0] * off.x + k[1] * off.y + k[3] * off.z;
            d.given[3 * j + 1] += k[1] * off.x + k[2] * off.y + k[4] * off.z;
            d.given[3 * j + 2] += k[3] * off.x + k[4] * off.y + k[5] * off.z;
        }
        for (int a = 0; a < 3; a++) {
            const double load = force * splitmix(seed, -1, 1) / n;
            f.line.field.load[3 * j + a] = load;
            d.given[3 * j + a] += load;
            d.place[3 * j + a] = f.line.position[3 * j + a];
        }
    }
    memcpy(d.x, f.line.position, 3 * (size_t)n * sizeof *d.x);
    for (int end = 0; end < 2; end++)
        if (held[end]) memcpy(&d.x[end ? 3 * (n - 1) : 0], f.line.end[end].value, 3 * sizeof *d.x);
    step(&f);
    if (!cps_outcome_is_certified(f.line.report.outcome))
        fail_msg("%s: n %d, EA/F %g, K L/F %g", cps_outcome_name(f.line.report.outcome), n,
                 ea / force, size * length / force);
    const double least = minimise(&d), here = evaluate(&d, f.line.position),
                 scale = f.line.report.certificate.scale;
    double off = 0;
    if (anchored)
        for (int i = 0; i < 3 * n; i++) off = fmax(off, fabs(f.line.position[i] - d.x[i]) / length);
    worst->place = fmax(worst->place, off);
    worst->energy = fmax(worst->energy, fabs(here - least) / scale);
    worst->gap = fmax(worst->gap, f.line.report.certificate.gap / scale);
    CHECK_NEAR(f.line.report.certificate.primal - f.line.report.certificate.dual,
               f.line.report.certificate.gap,
               1e-9 * (scale + fabs(f.line.report.certificate.primal)));
    cpsi_arena_free(&f.arena);
}

static void random_lines(void **state) {
    (void)state;
    uint64_t seed = 20261125;
    Worst worst = {0};
    for (int i = 0; i < CASES; i++) random_case(&seed, &worst);
    print_message(
        "seed 20261125, %d lines: places to %.1e of the length, energies to %.1e, gap %.1e\n",
        CASES, worst.place, worst.energy, worst.gap);
    assert_true(worst.place < 1e-6);
    assert_true(worst.energy < 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(line_held_by_springs), cmocka_unit_test(line_falls_past_springs),
        cmocka_unit_test(short_line_is_short),  cmocka_unit_test(spring_against_friction),
        cmocka_unit_test(random_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
