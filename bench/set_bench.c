/* SPDX-License-Identifier: BSD-3-Clause */
/* Time of one support function: closed form of a ball in R^3, conic form of the braked wheel's set
 * and of many ellipses.
 *     usage: set_bench [--check]
 *
 * With --check the exit status tells whether they stay under 50 ns and 20 microseconds. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "capstan/set.h"

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Seconds per call over directions that turn, the best of five runs. */
static double time_of(const CpsSet *set, int calls) {
    double best = 1e9, sum = 0;
    for (int run = 0; run < 5; run++) {
        const double start = now();
        for (int k = 0; k < calls; k++) {
            const double w[3] = {1, (k & 31) / 16.0 - 1, 0.5};
            double point[3];
            CpsSetAnswer answer;
            if (cps_set_support(set, w, point, &answer, NULL)) return -1;
            sum += answer.value;
        }
        const double each = (now() - start) / calls;
        if (each < best) best = each;
    }
    return sum > 0 ? best : -1;
}

/* N ellipses about one centre, turned by pi/N from one to the next; NULL: no memory. */
static CpsSet *rosette(void) {
    enum { N = 45 };
    CpsSet *part[N] = {NULL}, *set = NULL;
    bool good = true;
    for (int k = 0; k < N && good; k++) {
        const double t = 3.14159265358979323846 * k / N, c = cos(t), s = sin(t);
        good = !cps_set_ellipsoid(2, NULL,
                                  (const double[]){9 * c * c + s * s, 8 * c * s, 8 * c * s,
                                                   9 * s * s + c * c},
                                  &part[k], NULL);
    }
    if (good) cps_set_intersection(N, (const CpsSet *const *)part, &set, NULL);
    for (int k = 0; k < N; k++) cps_set_release(part[k]);
    return set;
}

int main(int argc, char **argv) {
    static const double AXIS[2] = {0, 1}, MAP[6] = {0, -0.3, 1, 0, 0, 1};
    CpsSet *ball = NULL, *part[2] = {NULL, NULL}, *strip = NULL, *wheel = NULL, *product = NULL,
           *preimage = NULL;
    if (cps_set_ball(3, NULL, 2, &ball, NULL) || cps_set_ball(2, NULL, 500, &part[1], NULL) ||
        cps_set_strip(2, AXIS, -200, 200, &strip, NULL) ||
        cps_set_intersection(2, (const CpsSet *[]){part[1], strip}, &wheel, NULL) ||
        cps_set_interval(-60, 60, &part[0], NULL) ||
        cps_set_product(2, (const CpsSet *const *)part, &product, NULL) ||
        cps_set_preimage(2, MAP, NULL, product, &preimage, NULL))
        return 2;
    const double closed = time_of(ball, 1000000), meet = time_of(wheel, 20000),
                 back = time_of(preimage, 20000);
    printf("closed form, ball in R^3:          %8.1f ns\n", 1e9 * closed);
    printf("conic form, disc and strip:        %8.2f us\n", 1e6 * meet);
    printf("conic form, preimage of product:   %8.2f us\n", 1e6 * back);
    CpsSet *many = rosette();
    if (!many) return 2;
    printf("conic form, 45 ellipses:           %8.2f us\n", 1e6 * time_of(many, 20));
    CpsSet *all[] = {ball, part[0], part[1], strip, wheel, product, preimage, many};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) cps_set_release(all[k]);
    const bool good =
        closed > 0 && closed < 50e-9 && meet > 0 && meet < 20e-6 && back > 0 && back < 20e-6;
    return argc > 1 && !strcmp(argv[1], "--check") && !good;
}
