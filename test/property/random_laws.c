/* SPDX-License-Identifier: BSD-3-Clause */
/* Random friction laws: what must hold of every one.
 *     usage: random_laws [--cases N | --seed S]
 *
 * A law is a random expression of discs, ellipsoids, boxes, polytopes and strips around 0, in
 * products, intersections, preimages, contacts and unit loads, of depth <= 4 in up to 6 components.
 * For each, some velocities and forces:
 *
 *   - the dissipation is not negative, and positively homogeneous of degree 1
 *   - Fenchel-Young: phi(V) + <V, F> = 0 at the middle and the ends of the set of forces at V
 *   - the five forms agree there, and at a force inside (power forms to rounding, distance by the
 *       square-root bound)
 *   - V is among the velocities of each such force
 *   - phi of a product is the sum of its parts' (M77 section 8)
 *
 * At least 98 % of the questions must be answered. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/law.h"
#include "random_expression.h"

/* Relative to the power's scale: what the conic solver promises. */
static const double POWER_TOLERANCE = 1e-9;

/* Two ways to the same number: rounding, where everything is a closed form; else the solver's
 * promise. */
static const double ROUNDING = 1e-12;

/* [W] Rounding of sums of tens of products of order 10, where the force asked about is 0 and so is
 * the power's scale.
 */
static const double TINY = 1e-12;

/* Distance of V from the cone of velocities, relative to |V|. A force off by d, 1e-9 of the set,
 * turns the normal of a curved part by d/radius; preimages and sums make radii down to 1e-5 of the
 * set. A wrong cone is off by order 1. */
static const double TURN_TOLERANCE = 1e-4;

static int failures, questions, open;
static uint64_t seed;

static void fault(const CpsSet *set, const char *what, double got, double bound) {
    char text[500];
    cps_set_text(set, text, sizeof text);
    fprintf(stderr, "seed %llu: %s: %.3g, allowed %.3g\n  %s\n", (unsigned long long)seed, what,
            got, bound, text);
    failures++;
}

/* written so that NaN is a fault */
static void check(const CpsSet *set, const char *what, double got, double bound) {
    if (!(got <= bound)) fault(set, what, got, bound);
}

/* ---- random laws ---- */

static CpsSet *random_shape(int n) {
    double a[MAX_SPACE * MAX_SPACE], b[MAX_SPACE], shape[MAX_SPACE * MAX_SPACE] = {0};
    CpsSet *set = NULL;
    for (int i = 0; i < n; i++) b[i] = uniform(0.2, 3);
    switch (below(5)) {
    case 0: DO(cps_set_ball(n, NULL, b[0], &set, &err)); break;
    case 1: /* A A' + 0.1 I */
        for (int i = 0; i < n * n; i++) a[i] = uniform(-1, 1);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                shape[i * n + j] = i == j ? 0.1 : 0;
                for (int k = 0; k < n; k++) shape[i * n + j] += a[i * n + k] * a[j * n + k];
            }
        DO(cps_set_ellipsoid(n, NULL, shape, &set, &err));
        break;
    case 2:
        for (int i = 0; i < n; i++) a[i] = -uniform(0.2, 3);
        DO(cps_set_box(n, a, b, &set, &err));
        break;
    case 3: /* 0 on the boundary of a flat one, or of a ball beside 0 */
        for (int i = 0; i < n; i++) a[i] = 0;
        a[below(n)] = b[0];
        DO(cps_set_ball(n, a, b[0], &set, &err));
        break;
    default: { /* points and their opposites */
        double points[2 * (MAX_SPACE + 1) * MAX_SPACE];
        const int count = n + 1;
        for (int i = 0; i < count * n; i++) {
            points[i] = uniform(-2, 2);
            points[count * n + i] = -points[i];
        }
        DO(cps_set_hull_of_points(n, 2 * count, points, &set, &err));
    }
    }
    return set;
}

static CpsLaw *law_of(CpsSet *set) {
    CpsLaw *law = NULL;
    DO(cps_law_friction(set, &law, &err));
    cps_set_release(set);
    return law;
}

static CpsLaw *random_law(int n, int depth);

static CpsLaw *random_product(int n, int depth) {
    const int first = 1 + below(n - 1);
    CpsLaw *part[2] = {random_law(first, depth - 1)}, *law = NULL;
    part[1] = random_law(n - first, depth - 1);
    DO(cps_law_product(2, (const CpsLaw *const *)part, &law, &err));
    double velocity[MAX_SPACE];
    CpsSetAnswer whole, one, two;
    fill(n, 1, velocity);
    DO(cps_set_dissipation(cps_law_set(law), velocity, NULL, &whole, &err));
    DO(cps_set_dissipation(cps_law_set(part[0]), velocity, NULL, &one, &err));
    DO(cps_set_dissipation(cps_law_set(part[1]), velocity + first, NULL, &two, &err));
    check(cps_law_set(law), "phi of a product less the sum",
          fabs(whole.value - one.value - two.value), POWER_TOLERANCE * (1 + whole.value));
    for (int i = 0; i < 2; i++) cps_law_release(part[i]);
    return law;
}

static CpsLaw *random_preimage(int n, int depth) {
    const int m = 1 + below(MAX_SPACE);
    double map[MAX_SPACE * MAX_SPACE];
    CpsComposition composition;
    CpsLaw *of = random_law(m, depth - 1), *law = NULL;
    CpsSet *part[2] = {NULL}, *bounded = NULL;
    fill(m * n, 1, map);
    DO(cps_law_preimage(n, map, of, &composition, &law, &err));
    cps_law_release(of);
    if (m >= n) return law;

    /* a wide map leaves directions free: cut them off */
    part[0] = cps_set_retain(cps_law_set(law));
    cps_law_release(law);
    DO(cps_set_ball(n, NULL, 4, &part[1], &err));
    DO(cps_set_intersection(2, (const CpsSet *const *)part, &bounded, &err));
    for (int i = 0; i < 2; i++) cps_set_release(part[i]);
    return law_of(bounded);
}

static CpsLaw *random_contacts(int n, int depth) {
    const int count = 1 + below(3);
    double map[3][MAX_SPACE * MAX_SPACE];
    const double *maps[3] = {NULL};
    CpsLaw *contact[3] = {NULL}, *law = NULL;
    for (int i = 0; i < count; i++) {
        const int m = 1 + below(3);
        contact[i] = random_law(m, depth - 1);
        fill(m * n, 1, map[i]);
        maps[i] = map[i];
    }
    DO(cps_law_contacts(n, count, (const CpsLaw *const *)contact, maps, &law, &err));
    for (int i = 0; i < count; i++) cps_law_release(contact[i]);
    return law;
}

static CpsLaw *random_strip(int n, int depth) {
    double normal[MAX_SPACE];
    CpsLaw *of = random_law(n, depth - 1);
    CpsSet *part[2] = {cps_set_retain(cps_law_set(of)), NULL}, *cut = NULL;
    cps_law_release(of);
    fill(n, 1, normal);
    const double half = uniform(0.1, 1);
    DO(cps_set_strip(n, normal, -half, half, &part[1], &err));
    DO(cps_set_intersection(2, (const CpsSet *const *)part, &cut, &err));
    for (int i = 0; i < 2; i++) cps_set_release(part[i]);
    return law_of(cut);
}

static CpsLaw *random_law(int n, int depth) {
    const int kind = depth > 0 ? below(6) : 0;
    if (kind == 1 && n > 1) return random_product(n, depth);
    if (kind == 2) return random_preimage(n, depth);
    if (kind == 3) return random_contacts(n, depth);
    if (kind == 4) return random_strip(n, depth);
    CpsSet *shape = random_shape(n);
    if (kind != 5) return law_of(shape);
    CpsLaw *law = NULL;
    DO(cps_law_unit_load(shape, uniform(0, 5), &law, &err));
    cps_set_release(shape);
    return law;
}

/* ---- what must hold ---- */

static bool is_answered(CpsSetOutcome outcome) {
    questions++;
    open += outcome != CPS_SET_OUTCOME_ANSWERED;
    return outcome == CPS_SET_OUTCOME_ANSWERED;
}

/* the five forms at any force of C */
static void check_forms(const CpsSet *set, const double *force, const double *velocity,
                        bool exact) {
    CpsSetResidual r;
    DO(cps_set_residual(set, force, velocity, 0, &r, &err));
    const bool projected = !isnan(r.normal_cone) && !isnan(r.outside);
    if (!is_answered(projected ? r.outcome : CPS_SET_OUTCOME_INACCURATE)) return;
    const double equal = (exact ? ROUNDING : POWER_TOLERANCE) * r.scale + r.gap;
    check(set, "variational form", fabs(r.variational - r.dissipation), equal);
    check(set, "maximum dissipation form", fabs(r.maximum_dissipation - r.dissipation), equal);
    check(set, "power form below 0", -r.dissipation, POWER_TOLERANCE * r.scale + TINY);
    check(set, "dissipated power above phi", r.power - (r.dissipation + r.power),
          POWER_TOLERANCE * r.scale + TINY);
    const double root = sqrt(r.step * fmax(r.dissipation, 0));
    check(set, "square-root bound", r.normal_cone,
          2 * r.outside + root + sqrt(r.step * POWER_TOLERANCE * r.scale) + POWER_TOLERANCE);
}

/* V among the velocities of F */
static void check_velocities(const CpsSet *set, const double *force, const double *velocity) {
    const int n = cps_set_space(set);
    double nearest[MAX_SPACE];
    CpsSet *velocities = NULL;
    CpsSetAnswer answer;
    DO(cps_set_velocities(set, force, 1e-7, &velocities, &answer, &err));
    if (is_answered(answer.outcome)) {
        DO(cps_set_project(velocities, velocity, NULL, nearest, &answer, &err));
        if (is_answered(answer.outcome))
            check(set, "V from the velocities of its force", answer.value,
                  TURN_TOLERANCE * norm(n, velocity));
    }
    cps_set_release(velocities);
}

static void check_velocity(const CpsSet *set, const double *velocity) {
    const int n = cps_set_space(set);
    double centre[MAX_SPACE], end[MAX_SPACE], basis[MAX_SPACE * MAX_SPACE], twice[MAX_SPACE];
    CpsSet *forces = NULL;
    CpsSetAnswer phi, face, at;
    CpsSetFacts facts;
    for (int i = 0; i < n; i++) twice[i] = 2 * velocity[i];
    DO(cps_set_dissipation(set, velocity, NULL, &phi, &err));
    if (!is_answered(phi.outcome)) return;
    DO(cps_set_dissipation(set, twice, NULL, &at, &err));
    const double size = norm(n, velocity) * 10;
    check(set, "dissipation below 0", -phi.value, POWER_TOLERANCE * size);
    check(set, "phi(2V) less 2 phi(V)", fabs(at.value - 2 * phi.value),
          POWER_TOLERANCE * (size + phi.value));

    DO(cps_set_forces(set, velocity, 0, &forces, &face, &err));
    if (is_answered(face.outcome)) {
        DO(cps_set_facts(forces, 0, &facts, centre, basis, &err));
        if (is_answered(facts.outcome)) {
            check_forms(set, centre, velocity, phi.exact);
            CpsSetResidual r;
            DO(cps_set_residual(set, centre, velocity, 0, &r, &err));
            check(set, "Fenchel-Young on the set of forces", r.dissipation,
                  POWER_TOLERANCE * (r.scale + size));
            check_velocities(set, centre, velocity);
        }
        /* the ends of the set of forces along its first direction */
        if (facts.outcome == CPS_SET_OUTCOME_ANSWERED && facts.dimension > 0)
            for (int side = -1; side <= 1; side += 2) {
                for (int i = 0; i < n; i++) twice[i] = side * basis[i];
                DO(cps_set_support(forces, twice, end, &at, &err));
                if (!is_answered(at.outcome)) continue;
                double gap = phi.value;
                for (int i = 0; i < n; i++) gap += velocity[i] * end[i];
                check(set, "Fenchel-Young at an end", fabs(gap),
                      POWER_TOLERANCE * (size + norm(n, velocity) * norm(n, end)));
            }
    }
    cps_set_release(forces);
}

static void check_law(uint64_t number) {
    seed = number;
    random_seed(number);
    const int n = 1 + below(MAX_SPACE);
    CpsLaw *law = random_law(n, below(MAX_DEPTH + 1));
    const CpsSet *set = cps_law_set(law);
    double velocity[MAX_SPACE], force[MAX_SPACE];
    CpsSetAnswer answer;
    for (int k = 0; k < 3; k++) {
        /* the last along an axis: edges and corners of boxes */
        fill(n, 1, velocity);
        if (k == 2)
            for (int i = 0, axis = below(n); i < n; i++) velocity[i] = i == axis ? 1 : 0;
        check_velocity(set, velocity);

        /* a force inside: part of one on the boundary */
        DO(cps_set_dissipation(set, velocity, force, &answer, &err));
        if (!is_answered(answer.outcome)) continue;
        const double part = uniform(0, 1);
        for (int i = 0; i < n; i++) force[i] *= part;
        fill(n, 1, velocity);
        check_forms(set, force, velocity, answer.exact);
    }
    cps_law_release(law);
}

int main(int argc, char **argv) {
    uint64_t first = 1, count = 500;
    if (!random_cases(argc, argv, &first, &count)) {
        fprintf(stderr, "usage: random_laws [--cases N | --seed S]\n");
        return 2;
    }
    for (uint64_t number = first; number < first + count; number++) check_law(number);
    const double share = 100.0 * (questions - open) / (questions > 0 ? questions : 1);
    printf("%llu laws, %d questions, %.3f %% answered, %d faults\n", (unsigned long long)count,
           questions, share, failures);
    return failures > 0 || !(share >= 98);
}
