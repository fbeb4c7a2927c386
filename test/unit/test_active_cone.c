/* SPDX-License-Identifier: BSD-3-Clause */
/* What is assumed of a cone that Newton's steps on the active cones have left: that it is active
 * where the nearest admissible force is. Random cones of dimension 1 to 5, of any size and
 * direction, with forces of any size beside that. */
#include "conic/active_cone.h"

#include <string.h>

#include "check.h"
#include "splitmix.h"

enum { CASES = 20000, MOST = 5 };

static double decades(uint64_t *state, double low, double high) {
    return pow(10, splitmix(state, low, high));
}

/* x1 of any direction, so long. */
static void set_rest(double *x, int d, double length, uint64_t *state) {
    double square = 0;
    for (int r = 1; r < d; r++) {
        x[r] = splitmix(state, -1, 1);
        square += x[r] * x[r];
    }
    for (int r = 1; r < d; r++) x[r] *= length / sqrt(square);
}

/* a ray that would pull has no force, however its numbers are rounded; one without a direction has
 * come to the tip */
static void rays(void **unused) {
    (void)unused;
    uint64_t state = 1;
    for (int k = 0; k < CASES; k++) {
        const int d = 2 + (int)splitmix(&state, 0, MOST - 1);
        double s[MOST], z[MOST] = {0};
        s[0] = decades(&state, -9, 6);
        set_rest(s, d, s[0], &state);
        z[0] = -decades(&state, -12, 9);
        assert_false(cpsi_active_place(CPSI_RAY, s, z, d));
        CHECK_INT(cpsi_active_corrected(CPSI_RAY, z, d), CPSI_FREE);

        memset(s, 0, sizeof s);
        memset(z, 0, sizeof z);
        z[0] = decades(&state, -12, 9);
        assert_false(cpsi_active_place(CPSI_RAY, s, z, d));
        CHECK_INT(cpsi_active_corrected(CPSI_RAY, z, d), CPSI_TIP);
    }
}

/* the force of a tip: outside its cone, the nearest one in it is on a ray, or there is none where
 * it is opposite to the cone */
static void tips(void **unused) {
    (void)unused;
    uint64_t state = 2;
    for (int k = 0; k < CASES; k++) {
        const int d = 1 + (int)splitmix(&state, 0, MOST);
        double s[MOST] = {0}, z[MOST];
        const double size = decades(&state, -9, 6);
        const bool opposite = d == 1 || splitmix(&state, 0, 1) < 0.5;
        z[0] = opposite ? -size : size * splitmix(&state, -0.99, 0.99);
        set_rest(z, d, size * (opposite ? splitmix(&state, 0, 0.99) : 1), &state);
        assert_false(cpsi_active_place(CPSI_TIP, s, z, d));
        CHECK_INT(cpsi_active_corrected(CPSI_TIP, z, d), opposite ? CPSI_FREE : CPSI_RAY);
    }
}

/* a place outside the cone: the force is that of its boundary, which a half-line has at its end */
static void places(void **unused) {
    (void)unused;
    uint64_t state = 3;
    for (int k = 0; k < CASES; k++) {
        const int d = 1 + (int)splitmix(&state, 0, MOST);
        double s[MOST], z[MOST];
        const double size = decades(&state, -9, 6);
        s[0] = d == 1 ? -size : size * splitmix(&state, -2, 0.99);
        set_rest(s, d, size, &state);
        assert_false(cpsi_active_place(CPSI_FREE, s, z, d));
        CHECK_INT(cpsi_active_corrected(CPSI_FREE, z, d), d == 1 ? CPSI_TIP : CPSI_RAY);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(rays), cmocka_unit_test(tips),
                                       cmocka_unit_test(places)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
