/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies on 20 to 300 contacts, each with a disc of friction.     usage: random_contacts [--cases
 * N] [--seed S]
 *
 * In the plane with turning, or with two components: at the point of the law's boundary that a
 * velocity selects, found here contact by contact, this velocity goes with the force and no other;
 * with half of the force only rest; 1.5 times the force lies outside. So where sizes go from 1e-6
 * to 1e6. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/law.h"
#include "random_case.h"

enum { FEWEST = 20, MOST = 300 };

/* Normals are promised to 1e-7. */
static const double CLOSE = 1e-6;

static int failures;

static void fail(const char *what, double got) {
    fprintf(stderr, "seed %llu: %s: %.15g\n", (unsigned long long)seed, what, got);
    failures++;
}

/* Distance of the unit vector along d from the cone. */
static double away(const CpsSet *cone, int n, const double *d) {
    double unit[3], nearest[3], size = 0;
    CpsSetAnswer answer;
    for (int i = 0; i < n; i++) size = hypot(size, d[i]);
    for (int i = 0; i < n; i++) unit[i] = d[i] / size;
    need(cps_set_project(cone, unit, NULL, nearest, &answer, &err), "project");
    return answer.outcome == CPS_SET_OUTCOME_ANSWERED ? answer.value : INFINITY;
}

/* A law of contacts and the force that it has at the velocity -w. */
static CpsSet *draw_law(int n, int count, const double *w, double *force) {
    CpsSet *part[MOST] = {NULL}, *sum = NULL;
    const double size = pow(10, digit(6));
    for (int k = 0; k < count; k++) {
        const double x = digit(9) + 0.375, y = digit(9) - 0.25, radius = size * (1 + below(9));
        const double body[6] = {1, 0, 0, 1, -y, x}, plane[4] = {x, 1, 0.5, y};
        const double *map = n == 3 ? body : plane;
        double back[2] = {0, 0};
        for (int i = 0; i < n; i++)
            for (int j = 0; j < 2; j++) back[j] += map[2 * i + j] * w[i];
        for (int i = 0; i < n; i++)
            force[i] += radius * (map[2 * i] * back[0] + map[2 * i + 1] * back[1]) /
                        hypot(back[0], back[1]);
        CpsSet *disc = NULL;
        need(cps_set_ball(2, NULL, radius, &disc, &err), "disc");
        need(cps_set_image(n, map, disc, &part[k], &err), "image");
        cps_set_release(disc);
    }
    need(cps_set_sum(count, (const CpsSet *const *)part, &sum, &err), "sum");
    for (int k = 0; k < count; k++) cps_set_release(part[k]);
    return sum;
}

static void try_one(int most) {
    const int n = 2 + below(2), count = FEWEST + below(most - FEWEST + 1);
    double w[3] = {0}, back[3], force[3] = {0};
    for (int i = 0; i < n; i++) w[i] = digit(5) + 0.125;
    CpsSet *sum = draw_law(n, count, w, force);
    static const double SHARE[] = {1, 0.5, 1.5};
    for (int k = 0; k < 3; k++) {
        double asked[3];
        CpsSet *cone = NULL;
        CpsSetAnswer answer;
        CpsSetFacts facts;
        for (int i = 0; i < n; i++) asked[i] = SHARE[k] * force[i];
        need(cps_set_velocities(sum, asked, 0, &cone, &answer, &err), "velocities");
        if (answer.outcome != (k < 2 ? CPS_SET_OUTCOME_ANSWERED : CPS_SET_OUTCOME_OUTSIDE))
            fail("outcome of velocities", answer.outcome);
        if (cone) {
            need(cps_set_facts(cone, 0, &facts, NULL, NULL, &err), "facts");
            for (int i = 0; i < n; i++) back[i] = -w[i];
            if (facts.dimension != (k == 0)) fail("dimension of the velocities", facts.dimension);
            if (k == 0 && !(away(cone, n, back) <= CLOSE))
                fail("the velocity is left out", away(cone, n, back));
            if (k == 0 && !(away(cone, n, w) > 0.9)) fail("a velocity too many", away(cone, n, w));
        }
        cps_set_release(cone);
    }
    cps_set_release(sum);
}

int main(int argc, char **argv) {
    long cases = 100, first = 1;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--cases")) cases = atol(argv[i + 1]);
        if (!strcmp(argv[i], "--seed")) first = atol(argv[i + 1]);
    }
    for (long i = 0; i < cases; i++) {
        seed = (uint64_t)(first + i);
        state = seed * 0x9e3779b97f4a7c15u;
        try_one(i % 10 == 0 ? MOST : 2 * FEWEST);
    }
    printf("%ld bodies on many contacts, %d faults\n", cases, failures);
    return failures > 0;
}
