/* SPDX-License-Identifier: BSD-3-Clause */
/* A line between two points in a current, against integration of its equations
 *
 *     dx/ds = (1 + |p|/EA) p/|p|,    dp/ds = -(w + f(x, p/|p|)),
 *
 * f Morison's drag per unstretched length, from A with a force p that is found by Newton's method
 * so that the line ends at B (shooting); and springs to the ground against a beam of the same
 * stiffness on the same springs. */
#include <math.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"

enum { STEPS = 20000 };

typedef struct Current {
    const char *what;
    double length, weight, ea, to[3], diameter, normal, tangential;
    int rows;
    CpsCurrentRow row[3];
} Current;

static const Current CASES[] = {
    {"a riser in a sheared current",
     110,
     300,
     5e7,
     {20, 5, 100},
     0.2,
     1.1,
     0.05,
     3,
     {{0, {0.2, 0, 0}}, {60, {0.8, 0.3, 0}}, {100, {1.2, 0.5, 0}}}},
    {"a slack line across a current",
     140,
     40,
     1e6,
     {100, 0, 20},
     0.05,
     1.2,
     0,
     1,
     {{0, {0, 1.5, 0}}}},
    {"a current along the line, and upwards",
     100,
     60,
     2e5,
     {70, -30, 40},
     0.1,
     0.9,
     0.4,
     2,
     {{-10, {1, 0, 0.4}}, {50, {0.5, -1, 0}}}},
    {"a line lighter than its drag",
     100,
     1,
     1e5,
     {80, 0, 10},
     0.04,
     1.4,
     0.02,
     1,
     {{0, {0.3, 0.9, 0}}}},
};

enum { COUNT = sizeof CASES / sizeof *CASES };

/* The velocity at height z. */
static void velocity(const Current *c, double z, double u[3]) {
    int k = 0;
    while (k < c->rows && c->row[k].z < z) k++;
    const CpsCurrentRow *high = &c->row[k < c->rows ? k : c->rows - 1],
                        *low = k > 0 ? &c->row[k - 1] : high;
    const double share = high->z > low->z ? (z - low->z) / (high->z - low->z) : 0;
    for (int a = 0; a < 3; a++)
        u[a] = low->velocity[a] + share * (high->velocity[a] - low->velocity[a]);
}

/* d(x, p)/ds */
static void derivative(const Current *c, const double y[6], double d[6]) {
    const double pi = acos(-1), *p = &y[3], tension = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    double u[3], along = 0, speed = 0, across[3];
    velocity(c, y[2], u);
    for (int a = 0; a < 3; a++) along += u[a] * p[a] / tension;
    for (int a = 0; a < 3; a++) {
        across[a] = u[a] - along * p[a] / tension;
        speed += across[a] * across[a];
    }
    speed = sqrt(speed);
    for (int a = 0; a < 3; a++) {
        d[a] = (1 + tension / c->ea) * p[a] / tension;
        d[3 + a] = -0.5 * 1025 * c->diameter *
                   (c->normal * speed * across[a] +
                    pi * c->tangential * fabs(along) * along * p[a] / tension);
    }
    d[5] += c->weight;
}

/* Integrate from A with the force p; the middle of the line as well. */
static void shoot(const Current *c, const double p[3], double end[6], double middle[3]) {
    double y[6] = {0, 0, 0, p[0], p[1], p[2]}, k[4][6], at[6];
    const double h = c->length / STEPS;
    for (int i = 0; i < STEPS; i++) {
        derivative(c, y, k[0]);
        for (int j = 1; j < 4; j++) {
            for (int a = 0; a < 6; a++) at[a] = y[a] + (j == 3 ? h : 0.5 * h) * k[j - 1][a];
            derivative(c, at, k[j]);
        }
        for (int a = 0; a < 6; a++) y[a] += h / 6 * (k[0][a] + 2 * k[1][a] + 2 * k[2][a] + k[3][a]);
        if (2 * (i + 1) == STEPS) memcpy(middle, y, 3 * sizeof *middle);
    }
    memcpy(end, y, 6 * sizeof *end);
}

/* The force at A by Newton's method from a guess near it. */
static void solve(const Current *c, double p[3], double end[6], double middle[3]) {
    for (int round = 0; round < 40; round++) {
        double off[3], m[3][4], unused[3], to[6], most = 0;
        shoot(c, p, end, middle);
        for (int a = 0; a < 3; a++) {
            off[a] = c->to[a] - end[a];
            most = fmax(most, fabs(off[a]));
        }
        if (most < 1e-11 * c->length) return;
        const double by = 1e-6 * sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        for (int b = 0; b < 3; b++) {
            double moved[3] = {p[0], p[1], p[2]};
            moved[b] += by;
            shoot(c, moved, to, unused);
            for (int a = 0; a < 3; a++) m[a][b] = (to[a] - end[a]) / by;
        }
        for (int a = 0; a < 3; a++) m[a][3] = off[a];
        for (int i = 0; i < 3; i++) {
            int best = i;
            for (int j = i; j < 3; j++)
                if (fabs(m[j][i]) > fabs(m[best][i])) best = j;
            for (int k = 0; k < 4; k++) {
                const double t = m[i][k];
                m[i][k] = m[best][k];
                m[best][k] = t;
            }
            for (int j = 0; j < 3; j++) {
                const double by_row = j == i ? 0 : m[j][i] / m[i][i];
                for (int k = i; k < 4; k++) m[j][k] -= by_row * m[i][k];
            }
        }
        for (int a = 0; a < 3; a++) p[a] += m[a][3] / m[a][a];
    }
    fail_msg("%s: shooting has not converged", c->what);
}

typedef struct Answer {
    double force[2][3], middle[3];
} Answer;

static Answer answer(const Current *c, int n) {
    CpsScene scene = cps_scene_default();
    CpsLine line = cps_line_default();
    const CpsLineLoads loads = {.drag = {c->diameter, c->normal, c->tangential}};
    const CpsCurrent current = {.density = 1025, .row_count = c->rows, .row = c->row};
    line.name = "line";
    line.length = c->length;
    line.element_count = n;
    line.weight = c->weight;
    line.stiffness = c->ea;
    line.loads = &loads;
    line.start.kind = CPS_START_STATIC;
    line.end[0] = (CpsEnd){CPS_END_KIND_HELD, {0, 0, 0}};
    line.end[1] = (CpsEnd){CPS_END_KIND_HELD, {c->to[0], c->to[1], c->to[2]}};
    scene.line = &line;
    scene.line_count = 1;
    scene.current = &current;
    CpsError err;
    CpsEvolution *evolution = NULL;
    if (cps_evolution_create(&scene, &evolution, &err)) fail_msg("%s", err.message);
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    const CpsLineReport report = cps_evolution_line_report(evolution, 0);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    assert_int_equal(report.outcome, CPS_OUTCOME_SOLVED);
    assert_true(report.certificate.load_residual <= 1e-9 * report.certificate.largest_force);
    Answer out;
    for (int e = 0; e < 2; e++) memcpy(out.force[e], report.end[e].force, sizeof out.force[e]);
    memcpy(out.middle, &view.position[3 * (n / 2)], sizeof out.middle);
    cps_evolution_destroy(evolution);
    return out;
}

static double distance(const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < 3; i++) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum);
}

/* Errors of end forces and of the middle fall with the square of the elements' length. */
static void drag_between_two_points(void **state) {
    (void)state;
    enum { MESHES = 4 };
    static const int MESH[MESHES] = {50, 100, 200, 400};
    for (int k = 0; k < COUNT; k++) {
        const Current *c = &CASES[k];
        double error[MESHES][3], end[6], middle[3];
        const Answer fine = answer(c, 800);
        double p[3] = {-fine.force[0][0], -fine.force[0][1], -fine.force[0][2]};
        solve(c, p, end, middle);
        const double unit = distance(&end[3], (const double[3]){0, 0, 0});
        for (int i = 0; i < MESHES; i++) {
            const Answer found = answer(c, MESH[i]);
            const double at_a[3] = {-p[0], -p[1], -p[2]};
            error[i][0] = distance(found.force[0], at_a) / unit;
            error[i][1] = distance(found.force[1], &end[3]) / unit;
            error[i][2] = distance(found.middle, middle) / c->length;
        }
        for (int what = 0; what < 3; what++) {
            const double last = error[MESHES - 1][what],
                         order = log2(error[MESHES - 2][what] / last);
            print_message("%s, %s: %.2e %.2e %.2e %.2e, order %.2f\n", c->what,
                          what == 0   ? "force at A"
                          : what == 1 ? "force at B"
                                      : "middle",
                          error[0][what], error[1][what], error[2][what], last, order);
            /* the profile's corners fall between nodes, so orders scatter about 2 */
            CHECK_NEAR(order, 2, 0.3);
            assert_true(last < 1e-4);
        }
    }
}

/* A line on springs along z under its weight, between walls that hold it straight with the tension
 * T: (T/(1 + T/EA)) z'' = k z + w by the unstretched length s, so z = -w/k (1 - cosh((s -
 * L/2)/a)/cosh(L/(2 a))), a = sqrt(T/(1 + T/EA)/k). */
static void line_on_springs(void **state) {
    (void)state;
    const double length = 20, weight = 0.003, k = 1200, pull = 5e4, ea = 5e8;
    double error[3];
    for (int i = 0; i < 3; i++) {
        const int n = 40 << i;
        CpsScene scene = cps_scene_default();
        CpsLine line = cps_line_default();
        const CpsSpring spring = {0, length, {0, 0, k}, false, {0, 0, 0}, {0, 0, 0}};
        const CpsLineLoads loads = {.spring_count = 1, .spring = &spring};
        const double point[6] = {0, 0, 0, length * (1 + pull / ea), 0, 0};
        line.name = "line";
        line.length = length;
        line.element_count = n;
        line.weight = weight;
        line.stiffness = ea;
        line.loads = &loads;
        line.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = point};
        line.end[0].kind = line.end[1].kind = CPS_END_KIND_AT_START;
        scene.line = &line;
        scene.line_count = 1;
        CpsError err;
        CpsEvolution *evolution = NULL;
        if (cps_evolution_create(&scene, &evolution, &err)) fail_msg("%s", err.message);
        assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
        const CpsLineReport report = cps_evolution_line_report(evolution, 0);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        assert_int_equal(report.outcome, CPS_OUTCOME_SOLVED);
        const double a = sqrt(pull / (k * (1 + pull / ea))),
                     sag = -weight / k * (1 - 1 / cosh(0.5 * length / a));
        error[i] = fabs(view.position[3 * (n / 2) + 2] - sag) / fabs(sag);
        double stored = 0;
        for (int j = 0; j <= n; j++) {
            const double z = view.position[3 * j + 2], share = j == 0 || j == n ? 0.5 : 1;
            stored += 0.5 * k * share * length / n * z * z;
        }
        CHECK_RELATIVE(report.ledger.loads, -stored, 1e-9);
        cps_evolution_destroy(evolution);
    }
    print_message("sag on springs: %.2e %.2e %.2e\n", error[0], error[1], error[2]);
    CHECK_NEAR(log2(error[0] / error[1]), 2, 0.3);
    assert_true(error[2] < 1e-4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drag_between_two_points),
        cmocka_unit_test(line_on_springs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
