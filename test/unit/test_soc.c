/* SPDX-License-Identifier: BSD-3-Clause */
/* Second-order cone: the identities that define the Nesterov-Todd scaling and the step to the
 * boundary, on seeded random interior points that come as near to the boundary as an interior-point
 * iterate does. */
#include "ipm/soc.h"

#include <stdbool.h>

#include "check.h"

enum { CASES = 20000 };

/* xorshift64: uniform in [0, 1) */
static double uniform(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (double)(*state >> 11) * 0x1p-53;
}

/* A point with |x1| = (1 - margin) x0. */
static void interior(double *x, int n, double margin, uint64_t *state) {
    double r = 0;
    for (int i = 1; i < n; i++) {
        x[i] = 2 * uniform(state) - 1;
        r += x[i] * x[i];
    }
    x[0] = pow(10, 4 * uniform(state) - 2);
    for (int i = 1; i < n; i++) x[i] *= (1 - margin) * x[0] / sqrt(r);
}

static double size(const double *x, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += x[i] * x[i];
    return sqrt(sum);
}

static void scaling_maps_the_pair_together(void **unused) {
    (void)unused;
    uint64_t state = 1;
    for (int k = 0; k < CASES; k++) {
        const int n = 3 + k % 2;
        const double margin = pow(10, -8 * uniform(&state));
        double s[4], z[4], a[4], b[4];
        interior(s, n, margin, &state);
        interior(z, n, margin, &state);
        const CpsiSocScaling w = cpsi_soc_scaling(s, z, n);
        cpsi_soc_apply(a, w.w, z, 1, n);
        cpsi_soc_apply(b, w.w, s, -1, n);
        /* W z = g W^-1 s; both determinants lose eps/margin, and W has norm up to 1/margin */
        for (int i = 0; i < n; i++)
            CHECK_NEAR(a[i], w.g * b[i], 64 * DBL_EPSILON / (margin * margin) * size(a, n));
    }
}

static void apply_and_its_inverse_cancel(void **unused) {
    (void)unused;
    uint64_t state = 2;
    for (int k = 0; k < CASES; k++) {
        const int n = 3 + k % 2;
        double s[4], z[4], x[4], y[4], back[4];
        interior(s, n, 0.01, &state);
        interior(z, n, 0.01, &state);
        for (int i = 0; i < n; i++) x[i] = 2 * uniform(&state) - 1;
        const CpsiSocScaling w = cpsi_soc_scaling(s, z, n);
        cpsi_soc_apply(y, w.w, x, 1, n);
        cpsi_soc_apply(back, w.w, y, -1, n);
        /* condition of W is (w0 + |w1|)^2 <= 4 w0^2 */
        for (int i = 0; i < n; i++)
            CHECK_NEAR(back[i], x[i], 32 * DBL_EPSILON * 4 * w.w[0] * w.w[0] * size(x, n));
    }
}

static void divide_undoes_product(void **unused) {
    (void)unused;
    uint64_t state = 3;
    for (int k = 0; k < CASES; k++) {
        const int n = 3 + k % 2;
        double x[4], y[4], product[4], back[4];
        interior(x, n, 0.01, &state);
        for (int i = 0; i < n; i++) y[i] = 2 * uniform(&state) - 1;
        cpsi_soc_product(product, x, y, n);
        cpsi_soc_divide(back, x, product, n);
        /* the arrow matrix of x has condition 2/margin = 200 */
        for (int i = 0; i < n; i++) CHECK_NEAR(back[i], y[i], 64 * 200 * DBL_EPSILON * size(y, n));
    }
}

static bool inside(const double *x, const double *d, double alpha, int n) {
    double r = 0, first = x[0] + alpha * d[0];
    for (int i = 1; i < n; i++) r += (x[i] + alpha * d[i]) * (x[i] + alpha * d[i]);
    return first >= 0 && r <= first * first;
}

static void step_ends_on_the_boundary(void **unused) {
    (void)unused;
    uint64_t state = 4;
    int bounded = 0;
    for (int k = 0; k < CASES; k++) {
        const int n = 3 + k % 2;
        double x[4], d[4];
        interior(x, n, 0.1, &state);
        for (int i = 0; i < n; i++) d[i] = x[0] * (4 * uniform(&state) - 2);
        const double inverse = cpsi_soc_inverse_step(x, d, n);
        if (inverse > 0) {
            bounded++;
            /* a millionth before the boundary is inside, a millionth beyond it is not: far above
             * rounding */
            assert_true(inside(x, d, (1 - 1e-6) / inverse, n));
            assert_false(inside(x, d, (1 + 1e-6) / inverse, n));
        } else {
            assert_true(inside(x, d, 1e6, n));
        }
    }
    CHECK_BETWEEN(bounded, CASES / 2, CASES - CASES / 100); /* both answers are met */
}

static void nan_comes_out_as_nan(void **unused) {
    (void)unused;
    const double x[3] = {1, 0, 0}, d[3] = {0, NAN, 0}, far[3] = {INFINITY, 0, 0};
    assert_true(isnan(cpsi_soc_inverse_step(x, d, 3)));
    assert_true(isnan(cpsi_soc_inverse_step(d, x, 3)));
    assert_true(isnan(cpsi_soc_inverse_step(x, far, 3)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scaling_maps_the_pair_together),
        cmocka_unit_test(apply_and_its_inverse_cancel),
        cmocka_unit_test(divide_undoes_product),
        cmocka_unit_test(step_ends_on_the_boundary),
        cmocka_unit_test(nan_comes_out_as_nan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
