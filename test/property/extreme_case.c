/* SPDX-License-Identifier: BSD-3-Clause */
/* Reports of failures, and parts that several classes share. */
#include "extreme_case.h"

#include <math.h>
#include <stdio.h>

int failures, failed[CLASSES], class_of_case;

void fail(const char *what, double got, double expected) {
    fprintf(stderr, "seed %llu, class %d: %s: %.15g, expected %.15g\n", (unsigned long long)seed,
            class_of_case, what, got, expected);
    failed[class_of_case] = 1;
}

void near(const char *what, double got, double expected, double allowed) {
    if (!(fabs(got - expected) <= allowed)) fail(what, got, expected);
}

void same(const char *what, long long got, long long expected) {
    if (got != expected) fail(what, (double)got, (double)expected);
}

double dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* Distance of d from the cone, for unit d. */
static double away(const CpsSet *cone, int n, const double *d) {
    double nearest[MOST];
    CpsSetAnswer answer;
    need(cps_set_project(cone, d, NULL, nearest, &answer, &err), "project");
    (void)n;
    return answer.outcome == CPS_SET_OUTCOME_ANSWERED ? answer.value : INFINITY;
}

void compare_cone(const CpsSet *law, int n, const double *force, int count, const double *normals,
                  int dimension, const double *outside) {
    CpsSet *cone = NULL;
    CpsSetAnswer answer;
    CpsSetFacts facts;
    need(cps_set_velocities(law, force, 0, &cone, &answer, &err), "velocities");
    same("outcome of velocities", answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    if (!cone) return;
    need(cps_set_facts(cone, 0, &facts, NULL, NULL, &err), "facts");
    same("dimension of the cone", facts.dimension, dimension);
    for (int k = 0; k < count; k++) {
        double d[MOST], size = sqrt(dot(n, &normals[k * n], &normals[k * n]));
        for (int i = 0; i < n; i++) d[i] = -normals[k * n + i] / size;
        near("a velocity left out", away(cone, n, d), 0, CLOSE);
    }
    if (outside && !(away(cone, n, outside) > 10 * CLOSE))
        fail("a velocity too many", away(cone, n, outside), 1);
    cps_set_release(cone);
}

void unit_vector(int n, double *u) {
    static const double TWO[][2] = {{1, 0},        {0.6, 0.8},     {-0.8, 0.6},
                                    {0.28, -0.96}, {-0.96, -0.28}, {5.0 / 13, 12.0 / 13}};
    const double *a = TWO[below(6)], *b = TWO[below(6)];
    u[0] = a[0];
    u[1] = a[1];
    if (n == 3) {
        u[0] = a[0];
        u[1] = a[1] * b[0];
        u[2] = a[1] * b[1];
    }
}

CpsLaw *law_of(CpsSet *set) {
    CpsLaw *law = NULL;
    need(cps_law_friction(set, &law, &err), "law");
    cps_set_release(set);
    return law;
}
