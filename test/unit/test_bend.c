/* SPDX-License-Identifier: BSD-3-Clause */
/* Which of two bends is the sharper one, down to turns of which the difference between the mesh's
 * ratio and Coulomb's is far below the rounding of either: against the integral of the derivative
 * of that difference, mu (1 + mu^2) t^2/(1 - mu^2 t^2) with t = tan(d/2), by many points. */
#include "cable/bend.h"
#include "check.h"
#include "splitmix.h"

enum { POINTS = 400, PAIRS = 2000 };

/* Both sides far from 1: the midpoint rule is exact to some 1e-6 here. */
static const double CLOSE = 1e-4;

static double excess(const CpsBend *bend) {
    const double m = bend->friction * bend->friction;
    double sum = 0;
    for (int k = 0; k < POINTS; k++) {
        const double t = tan(0.5 * bend->turn * (k + 0.5) / POINTS);
        sum += bend->friction * (1 + m) * t * t / (1 - m * t * t);
    }
    return sum * bend->turn / POINTS;
}

static CpsBend random_bend(uint64_t *state) {
    CpsBend bend = {.friction = splitmix(state, 0.01, 1.5)};
    do bend.turn = pow(10, splitmix(state, -10, 0));
    while (cpsi_bend_locks(&bend));
    return bend;
}

static void of_any_turn(void **unused) {
    (void)unused;
    uint64_t state = 3;
    int compared = 0;
    for (int i = 0; i < PAIRS; i++) {
        const CpsBend a = random_bend(&state);
        CpsBend b = random_bend(&state);
        if (i % 2)
            b = (CpsBend){.friction = a.friction, .turn = a.turn * splitmix(&state, 0.9, 1.1)};
        const double p = excess(&a), q = excess(&b);
        if (cpsi_bend_locks(&b) || fabs(p - q) <= CLOSE * (p + q)) continue;
        compared++;
        if (cpsi_bend_is_sharper(&a, &b) != (p > q) || cpsi_bend_is_sharper(&b, &a) != (q > p))
            fail_msg("turns %.17g and %.17g, friction %g and %g", a.turn, b.turn, a.friction,
                     b.friction);
    }
    CHECK_GREATER(compared, PAIRS / 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(of_any_turn)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
