/* SPDX-License-Identifier: BSD-3-Clause */
/* The contract of linsys.h, the same cases for every back end: the solution satisfies the equations
 * as written there, evaluated here from scratch, and the back ends agree. Stiffness contrasts up to
 * those of an inextensible line. */
#include "chain/chain_system.h"

#include <stdlib.h>
#include <string.h>

#include "check.h"

enum { NODES = 40, CASES = 200 };

static const CpsiLinsysOps *const back_ends[] = {&cpsi_linsys_chain, &cpsi_linsys_dense};
enum { BACK_ENDS = sizeof back_ends / sizeof *back_ends };

typedef struct Case {
    int n;
    unsigned char held[NODES];
    double diagonal[12 * NODES], skew[4 * NODES], stiffness[NODES], direction[3 * NODES],
        compliance[NODES];
    double f[6 * NODES], h[NODES];
    bool framed; /* nodes have their own axes */
    double frame[18 * NODES];
    bool pressed; /* some nodes have a second stiff direction */
    double column[3 * NODES], row[3 * NODES], second[NODES];
    bool pointed; /* some elements have a point; nodes have axes then */
    double share[NODES];
} Case;

static double uniform(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (double)(*state >> 11) * 0x1p-53;
}

static double sign(uint64_t *state) { return 2 * uniform(state) - 1; }

/* Random axes: a product of turns about x, y and z. */
static void random_frame(uint64_t *state, double q[9]) {
    double product[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int axis = 0; axis < 3; axis++) {
        const double angle = 3 * sign(state), c = cos(angle), s = sin(angle);
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (int col = 0; col < 3; col++) {
            const double u = product[3 * a + col], v = product[3 * b + col];
            product[3 * a + col] = c * u - s * v;
            product[3 * b + col] = s * u + c * v;
        }
    }
    memcpy(q, product, sizeof product);
}

/* A random line: contact stiff along z at every other node, compliances down to `least`. */
static Case random_case(uint64_t *state, double least) {
    Case c = {.n = 1 + (int)(uniform(state) * NODES)};
    c.held[0] = uniform(state) < 0.5;
    c.held[c.n - 1] |= uniform(state) < 0.5;
    for (int j = 0; j < c.n; j++) {
        const double r = 0.1 + uniform(state), contact = j % 2 ? pow(10, 12 * uniform(state)) : 0;
        double *d = &c.diagonal[6 * j], *m = &c.direction[3 * j];
        d[0] = r;
        d[2] = r;
        d[5] = r + contact;
        d[1] = 0.1 * r * sign(state);
        /* friction that follows the reaction: mu < 1 times the contact's stiffness */
        for (int a = 0; a < 2; a++) c.skew[2 * j + a] = 0.5 * contact * sign(state);
        c.stiffness[j] = 0.01 + uniform(state);
        c.compliance[j] = pow(least, uniform(state));
        double size = 0;
        for (int a = 0; a < 3; a++) {
            m[a] = sign(state);
            size += m[a] * m[a];
        }
        for (int a = 0; a < 3; a++) m[a] /= sqrt(size);
        for (int a = 0; a < 3; a++) c.f[3 * j + a] = sign(state);
        c.h[j] = 1e-3 * sign(state);
        random_frame(state, &c.frame[9 * j]);
        if (uniform(state) < 0.5) continue;
        /* against the normal z by 0.5 to 2.5 rad; with friction enough for both to hold, the two
         * would jam */
        const double lean = 0.5 + 2 * uniform(state), round = 3 * sign(state);
        const double normal[3] = {sin(lean) * cos(round), sin(lean) * sin(round), cos(lean)};
        for (int a = 0; a < 2; a++) c.skew[2 * j + a] *= 0.2;
        for (int a = 0; a < 3; a++) {
            c.row[3 * j + a] = normal[a];
            c.column[3 * j + a] = normal[a] + 0.1 * sign(state);
        }
        c.second[j] = pow(10, -12 * uniform(state));
    }
    c.framed = uniform(state) < 0.5;
    c.pressed = uniform(state) < 0.5;
    return c;
}

/* D turned into other axes than the point's; no friction that follows then. */
static void tilt(uint64_t *state, double d[6], double skew[2]) {
    static const int ROW[6] = {0, 0, 1, 0, 1, 2}, COLUMN[6] = {0, 1, 1, 2, 2, 2};
    const double m[3][3] = {{d[0], d[1], 0}, {d[1], d[2], 0}, {0, 0, d[5]}};
    double q[9];
    random_frame(state, q);
    for (int k = 0; k < 6; k++) {
        d[k] = 0;
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) d[k] += q[3 * ROW[k] + a] * m[a][b] * q[3 * COLUMN[k] + b];
    }
    skew[0] = skew[1] = 0;
}

/* The same with points at every second element on the average: their stiffness along the normal, in
 * one tangent or in both from nothing up to 1e12, and friction that follows the normal one. */
static Case random_points(uint64_t *state, double least) {
    Case c = random_case(state, least);
    c.pointed = c.framed = true;
    /* with friction enough for several to hold each other they would jam */
    for (int j = 0; j < 2 * c.n; j++) c.skew[j] *= 0.2;
    for (int i = 1; i < c.n; i++) {
        random_frame(state, &c.frame[9 * (c.n + i)]);
        if (uniform(state) < 0.5) continue;
        double *d = &c.diagonal[6 * (c.n + i)];
        const double normal = uniform(state) < 0.2 ? 0 : pow(10, 18 * uniform(state) - 6),
                     angle = 3 * sign(state);
        const double along = pow(10, 18 * uniform(state) - 6),
                     across = pow(10, 18 * uniform(state) - 6);
        const double x = cos(angle), y = sin(angle);
        c.share[i] = 0.02 + 0.96 * uniform(state);
        d[0] = along * x * x + across * y * y;
        d[1] = (along - across) * x * y;
        d[2] = along * y * y + across * x * x;
        d[5] = normal;
        if (uniform(state) < 0.2) d[0] = d[1] = d[2] = 0;
        for (int a = 0; a < 2; a++) c.skew[2 * (c.n + i) + a] = 0.1 * normal * sign(state);
        if (i % 4 == 3) tilt(state, d, &c.skew[2 * (c.n + i)]);
        for (int a = 0; a < 3; a++) c.f[3 * (c.n + i) + a] = sign(state);
    }
    return c;
}

static void solve(const Case *c, const CpsiLinsysOps *ops, double *x, double *t, double *f) {
    Case copy = *c;
    const CpsiMatrixSecond second = {copy.column, copy.row, copy.second};
    const CpsiMatrix matrix = {c->n,
                               copy.held,
                               copy.diagonal,
                               copy.skew,
                               copy.stiffness,
                               copy.direction,
                               copy.compliance,
                               copy.framed ? copy.frame : NULL,
                               copy.pressed ? &second : NULL,
                               copy.pointed ? copy.share : NULL};
    CpsiArena arena = {0};
    size_t scratch;
    ops->layout(&arena, c->n, true, c->pointed, &scratch);
    assert_true(cpsi_arena_allocate(&arena));
    CpsiLinsys *linsys = ops->layout(&arena, c->n, true, c->pointed, &scratch);
    /* what the memory of the factor served before does not matter: NaN here */
    memset(arena.base + scratch, 0xff, arena.used - scratch);
    assert_true(ops->factor(linsys, &matrix));
    memcpy(x, c->f, sizeof c->f);
    memcpy(t, c->h, sizeof c->h);
    ops->solve(linsys, &matrix, x, t, copy.pressed ? f : NULL);
    cpsi_arena_free(&arena);
}

static double matrix_entry(const Case *c, int j, int r, int col) {
    static const int place[3][3] = {{0, 1, 3}, {1, 2, 4}, {3, 4, 5}};
    return c->diagonal[6 * j + place[r][col]] + (col == 2 && r < 2 ? c->skew[2 * j + r] : 0);
}

/* Component a of node j's unknown in the common axes; and of a common vector in the node's axes. */
static double common(const Case *c, const double *x, int j, int a) {
    if (!c->framed) return x[3 * j + a];
    double sum = 0;
    for (int i = 0; i < 3; i++) sum += c->frame[9 * j + 3 * i + a] * x[3 * j + i];
    return sum;
}

static double own(const Case *c, const double v[3], int j, int a) {
    const double *q = &c->frame[9 * j + 3 * a];
    return c->framed ? q[0] * v[0] + q[1] * v[1] + q[2] * v[2] : v[a];
}

/* The pull of element i on its later node, in the common axes, and the size of its terms. */
static void element_force(const Case *c, const double *x, const double *t, int i, double force[3],
                          double *terms) {
    for (int a = 0; a < 3; a++) {
        const double far = common(c, x, i, a), near = common(c, x, i - 1, a),
                     m = c->direction[3 * i + a] * t[i];
        force[a] = c->stiffness[i] * (far - near) + m;
        *terms += c->stiffness[i] * (fabs(far) + fabs(near)) + fabs(m);
    }
}

/* What the points beside node j do to component a of its equation, in its own axes, and the size of
 * the terms. */
static double of_points(const Case *c, const double *x, int j, int a, double *terms) {
    double sum = 0;
    if (c->pointed)
        for (int i = j; i <= j + 1; i++) {
            if (i < 1 || i >= c->n || c->share[i] == 0) continue;
            const double share = i == j ? c->share[i] : 1 - c->share[i];
            const int p = c->n + i;
            double force[3], common[3];
            for (int r = 0; r < 3; r++) {
                force[r] = -c->f[3 * p + r];
                for (int b = 0; b < 3; b++) {
                    const double term = matrix_entry(c, p, r, b) * x[3 * p + b];
                    force[r] += term;
                    *terms += share * fabs(term);
                }
            }
            for (int k = 0; k < 3; k++) {
                common[k] = 0;
                for (int r = 0; r < 3; r++) common[k] += c->frame[9 * p + 3 * r + k] * force[r];
            }
            const double *q = &c->frame[9 * j + 3 * a];
            for (int k = 0; k < 3; k++) sum += share * q[k] * common[k];
            for (int r = 0; r < 3; r++) *terms += share * fabs(c->f[3 * p + r]);
        }
    return sum;
}

/* How far points are from where their nodes have them, per size of the nodes' places. */
static double astray(const Case *c, const double *x) {
    double worst = 0;
    if (c->pointed)
        for (int i = 1; i < c->n; i++) {
            double size = 0, off = 0;
            for (int a = 0; a < 3; a++) {
                const double far = common(c, x, i, a), near = common(c, x, i - 1, a);
                double at = 0;
                for (int r = 0; r < 3; r++)
                    at += c->frame[9 * (c->n + i) + 3 * r + a] * x[3 * (c->n + i) + r];
                size += fabs(far) + fabs(near);
                off = fmax(off,
                           fabs(at - (c->share[i] > 0 ? (1 - c->share[i]) * near + c->share[i] * far
                                                      : 0)));
            }
            worst = fmax(worst, off / (size > 0 ? size : 1));
        }
    return worst;
}

static bool has_second(const Case *c, int j) {
    return c->pressed && !c->held[j] && c->second[j] > 0;
}

/* Largest residual of the equations of linsys.h, relative to the sum of the terms of each. */
static double residual(const Case *c, const double *x, const double *t, const double *f) {
    double worst = 0;
    for (int j = 0; j < c->n; j++) {
        double before[3] = {0}, after[3] = {0}, pulls = 0;
        if (j > 0) element_force(c, x, t, j, before, &pulls);
        if (j + 1 < c->n) element_force(c, x, t, j + 1, after, &pulls);
        if (!c->held[j])
            for (int a = 0; a < 3; a++) {
                double sum = own(c, before, j, a) - own(c, after, j, a) - c->f[3 * j + a],
                       terms = fabs(c->f[3 * j + a]) + pulls;
                for (int b = 0; b < 3; b++) {
                    const double term = matrix_entry(c, j, a, b) * x[3 * j + b];
                    sum += term;
                    terms += fabs(term);
                }
                sum += of_points(c, x, j, a, &terms);
                const double pressed = has_second(c, j) ? c->column[3 * j + a] * f[j] : 0;
                sum += pressed;
                terms += fabs(pressed);
                worst = fmax(worst, fabs(sum) / terms);
            }
        if (c->held[j])
            for (int a = 0; a < 3; a++) assert_true(x[3 * j + a] == 0);
        if (has_second(c, j)) { /* f = r.x/a */
            double sum = -c->second[j] * f[j], terms = fabs(sum);
            for (int a = 0; a < 3; a++) {
                const double term = c->row[3 * j + a] * x[3 * j + a];
                sum += term;
                terms += fabs(term);
            }
            worst = fmax(worst, fabs(sum) / terms);
        }
        if (j == 0) continue;
        double sum = -c->h[j] - c->compliance[j] * t[j],
               terms = fabs(c->h[j]) + fabs(c->compliance[j] * t[j]);
        for (int a = 0; a < 3; a++) {
            const double far = common(c, x, j, a), near = common(c, x, j - 1, a),
                         m = c->direction[3 * j + a];
            sum += m * (far - near);
            terms += fabs(m) * (fabs(far) + fabs(near));
        }
        worst = fmax(worst, fabs(sum) / terms);
    }
    return worst;
}

static void equations_hold(void **state_) {
    const CpsiLinsysOps *ops = *state_;
    uint64_t state = 5;
    double worst[2] = {0, 0}; /* without and with second directions */
    for (int k = 0; k < CASES; k++) {
        double x[6 * NODES], t[NODES], f[NODES];
        const Case c = random_case(&state, k % 2 ? 1e-14 : 1e-3);
        solve(&c, ops, x, t, f);
        worst[c.pressed] = fmax(worst[c.pressed], residual(&c, x, t, f));
    }
    print_message("%s: largest relative residual %.2g, with second directions %.2g\n", ops->name,
                  worst[0], worst[1]);
    /* backward stable with a growth of a few hundred at most over 40 nodes */
    CHECK_LESS(worst[0], 1e3 * 2.3e-16);
    /* and a thousand where a second direction takes a compliance of up to 1/0.1 away */
    CHECK_LESS(worst[1], 1e6 * 2.3e-16);
}

static void points_hold(void **state_) {
    const CpsiLinsysOps *ops = *state_;
    uint64_t state = 8;
    double worst = 0, off = 0;
    int poor = 0;
    for (int k = 0; k < CASES; k++) {
        double x[6 * NODES], t[NODES], f[NODES];
        const Case c = random_points(&state, k % 2 ? 1e-14 : 1e-3);
        solve(&c, ops, x, t, f);
        const double here = residual(&c, x, t, f), away = astray(&c, x);
        worst = fmax(worst, here);
        off = fmax(off, away);
        poor += here > 1e6 * 2.3e-16 || away > 1e6 * 2.3e-16;
    }
    print_message("%s: with points, largest relative residual %.2g, points off their elements by "
                  "%.2g, %d of %d cases above 2e-10\n",
                  ops->name, worst, off, poor, CASES);
    /* where more stiff directions than three meet in a node and nearly agree, compliances of 1e-12
     * beside rounding tell what they share: up to ten digits less, which the correction gives
     * back */
    CHECK_INT(poor, 0);
    CHECK_LESS(worst, 1e3 * 2.3e-16);
    CHECK_LESS(off, 1e3 * 2.3e-16);
}

static void back_ends_agree(void **unused) {
    (void)unused;
    uint64_t state = 6;
    for (int k = 0; k < CASES; k++) {
        double x[BACK_ENDS][6 * NODES], t[BACK_ENDS][NODES], f[BACK_ENDS][NODES], size = 0;
        const Case c = k % 2 ? random_points(&state, 1e-3) : random_case(&state, 1e-3);
        for (int b = 0; b < BACK_ENDS; b++) solve(&c, back_ends[b], x[b], t[b], f[b]);
        for (int i = 0; i < 3 * c.n; i++) size = fmax(size, fabs(x[0][i]));
        /* condition about n^2/0.1 x 1e3, and a thousand for second directions: both solutions carry
         * it */
        const double tolerance = (c.pressed || c.pointed ? 1e-6 : 1e-9) * size;
        for (int i = 0; i < 3 * c.n; i++) CHECK_NEAR(x[1][i], x[0][i], tolerance);
    }
}

static void nan_is_refused(void **state_) {
    const CpsiLinsysOps *ops = *state_;
    uint64_t state = 7;
    Case c = random_case(&state, 1e-3);
    c.n = NODES / 2;
    c.diagonal[6] = NAN;
    c.held[1] = 0;
    const CpsiMatrix matrix = {c.n,         c.held,       c.diagonal, c.skew, c.stiffness,
                               c.direction, c.compliance, NULL,       NULL,   NULL};
    CpsiArena arena = {0};
    size_t scratch;
    ops->layout(&arena, c.n, true, true, &scratch);
    assert_true(cpsi_arena_allocate(&arena));
    CpsiLinsys *linsys = ops->layout(&arena, c.n, true, true, &scratch);
    assert_false(ops->factor(linsys, &matrix));
    /* in the block of a point */
    Case other = random_points(&state, 1e-3);
    while (other.n < 2 || other.share[1] == 0) other = random_points(&state, 1e-3);
    other.diagonal[6 * (other.n + 1)] = NAN;
    const CpsiMatrix pointed = {other.n,          other.held,      other.diagonal,
                                other.skew,       other.stiffness, other.direction,
                                other.compliance, other.frame,     NULL,
                                other.share};
    if (other.n <= c.n) assert_false(ops->factor(linsys, &pointed));
    cpsi_arena_free(&arena);
}

int main(void) {
    void *chain = (void *)(uintptr_t)&cpsi_linsys_chain,
         *dense = (void *)(uintptr_t)&cpsi_linsys_dense;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(equations_hold, chain),
        cmocka_unit_test_prestate(equations_hold, dense),
        cmocka_unit_test_prestate(points_hold, chain),
        cmocka_unit_test_prestate(points_hold, dense),
        cmocka_unit_test_prestate(nan_is_refused, chain),
        cmocka_unit_test_prestate(nan_is_refused, dense),
        cmocka_unit_test(back_ends_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
