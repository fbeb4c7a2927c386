/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out in every question to random sets, laws and resistances, once at each place of the
 * library that asks for it: the call says so or answers by another way, and everything allocated is
 * given back. Allocations are counted by wrapping them at link time, and so are small arrays, which
 * are on the stack where they are as small as here. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "../property/random_expression.h"
#include "capstan/law.h"
#include "refuse.h"
#include "set/set.h"

double *__real_cpsi_scratch_take(CpsiScratch *scratch, size_t count);
double *__wrap_cpsi_scratch_take(CpsiScratch *scratch, size_t count);
double *__wrap_cpsi_scratch_take(CpsiScratch *scratch, size_t count) {
    scratch->many = NULL;
    return refuse() ? NULL : __real_cpsi_scratch_take(scratch, count);
}

/* What is asked: two sets, a law and a resistance made of the first, a direction and points inside
 * and anywhere. */
typedef struct Case {
    int n;
    CpsSet *set, *other;
    CpsLaw *law;
    CpsResistance *resistance;
    double direction[MAX_SPACE], inside[MAX_SPACE], point[MAX_SPACE], map[MAX_SPACE * MAX_SPACE];
} Case;

enum { ROOM = 64, QUESTIONS = 26, RESISTANCES = 5 };

/* Let go of what an operation gave. */
static CpsStatus made(CpsStatus status, CpsSet **set) {
    if (status == CPS_OK) cps_set_release(*set);
    return status;
}

static CpsStatus operate(const Case *c, int question) {
    const CpsSet *both[] = {c->set, c->other};
    CpsSet *out = NULL;
    switch (question) {
    case 0: return made(cps_set_sum(2, both, &out, &err), &out);
    case 1: return made(cps_set_hull(2, both, &out, &err), &out);
    case 2: return made(cps_set_intersection(2, both, &out, &err), &out);
    case 3: return made(cps_set_product(2, both, &out, &err), &out);
    case 4: return made(cps_set_polar(c->set, &out, &err), &out);
    case 5: return made(cps_set_image(c->n, c->map, c->set, &out, &err), &out);
    case 6: return made(cps_set_preimage(c->n, c->map, c->point, c->set, &out, &err), &out);
    case 7: return made(cps_set_translate(c->point, c->set, &out, &err), &out);
    default: return made(cps_set_scale(-2, c->set, &out, &err), &out);
    }
}

static CpsStatus ask_set(const Case *c, int question) {
    double x[ROOM * MAX_SPACE];
    int count;
    CpsSetAnswer answer;
    CpsSetExtent extent;
    CpsSetFacts facts;
    CpsSetMeasure measure;
    CpsSetResidual residual;
    CpsSetConic conic = {0};
    CpsSet *out = NULL;
    CpsStatus status = CPS_OK;
    switch (question) {
    case 9: return cps_set_support(c->set, c->direction, x, &answer, &err);
    case 10: return cps_set_extent(c->set, c->direction, &extent, &err);
    case 11: return cps_set_contains(c->set, c->point, x, &answer, &err);
    case 12: return cps_set_project(c->set, c->point, NULL, x, &answer, &err);
    case 13: return cps_set_gauge(c->set, c->point, &answer, &err);
    case 14: return made(cps_set_face(c->set, c->direction, 0, &out, &answer, &err), &out);
    case 15:
        status = cps_set_support(c->set, c->direction, x, &answer, &err);
        return status ? status : made(cps_set_normal_cone(c->set, x, 0, &out, &answer, &err), &out);
    case 16: return cps_set_facts(c->set, 0, &facts, x, x + MAX_SPACE, &err);
    case 17: return cps_set_vertices(c->set, 0.1, ROOM, x, &count, &answer, &err);
    case 18: return cps_set_rays(c->set, 0, ROOM, x, &count, &answer, &err);
    case 19: return cps_set_measure(c->set, &measure, &err);
    case 20:
        status = cps_set_conic(c->set, &conic, &err);
        cps_set_conic_clear(&conic);
        return status;
    case 21: return cps_set_dissipation(c->set, c->direction, x, &answer, &err);
    case 22: return made(cps_set_forces(c->set, c->direction, 0, &out, &answer, &err), &out);
    case 23: return made(cps_set_velocities(c->set, c->inside, 0, &out, &answer, &err), &out);
    case 24: return cps_set_residual(c->set, c->point, c->direction, 1, &residual, &err);
    default: return cps_set_residual(c->set, c->inside, c->direction, 1, &residual, &err);
    }
}

static CpsStatus ask_resistance(const Case *c, int question) {
    double velocity[MAX_SPACE], gap, distance;
    CpsResistanceValue value;
    CpsSetAnswer answer;
    CpsSet *out = NULL;
    switch (question) {
    case 0: return cps_resistance_value(c->resistance, c->direction, &value, NULL, &err);
    case 1:
        return made(cps_resistance_forces(c->resistance, c->direction, 0, &out, &answer, &err),
                    &out);
    case 2: return cps_resistance_conjugate(c->resistance, c->point, velocity, &answer, &err);
    case 3:
        return made(cps_resistance_velocities(c->resistance, c->point, &out, &answer, &err), &out);
    default:
        return cps_resistance_residual(c->resistance, c->point, c->direction, &gap, &distance,
                                       &err);
    }
}

static CpsStatus ask(const Case *c, int question) {
    if (question < 9) return operate(c, question);
    if (question < QUESTIONS) return ask_set(c, question);
    return ask_resistance(c, question - QUESTIONS);
}

static long refused;

static void refuse_each(const Case *c, int question) {
    long next = places;
    asked = 0;
    recording = true;
    const CpsStatus usual = ask(c, question);
    recording = false;
    while (next < places) {
        const long before = live;
        allowed = first[next++];
        const CpsStatus status = ask(c, question);
        const bool reached = allowed < 0;
        allowed = -1;
        if (live != before) fail_msg("question %d: %ld blocks lost", question, live - before);
        if (status != usual && !(reached && status == CPS_ERR_MEMORY))
            fail_msg("question %d: %s: %s", question, cps_status_name(status), err.message);
        refused += reached;
    }
}

/* A sum of terms of every kind, on laws of a set round 0. */
static CpsResistance *random_resistance(int n, const CpsLaw *law) {
    static const double SPEED[] = {0, 1, 3}, FACTOR[] = {0.5, 1, 4};
    double matrix[MAX_SPACE * MAX_SPACE] = {0};
    for (int i = 0; i < n; i++) matrix[i * n + i] = i < n - below(2) ? uniform(0.5, 2) : 0;
    CpsResistance *term[4] = {NULL}, *sum = NULL;
    int count = 0;
    if (below(2)) DO(cps_resistance_dry(law, &term[count++], &err));
    if (below(2)) DO(cps_resistance_viscous(n, matrix, &term[count++], &err));
    if (below(2)) DO(cps_resistance_power(law, uniform(1.2, 3), 2, &term[count++], &err));
    if (count == 0 || below(2))
        DO(cps_resistance_table(law, 3, SPEED, FACTOR, &term[count++], &err));
    DO(cps_resistance_sum(count, (const CpsResistance *const *)term, &sum, &err));
    for (int i = 0; i < count; i++) cps_resistance_release(term[i]);
    return sum;
}

static Case random_case(uint64_t seed) {
    random_seed(seed);
    Case c = {.n = 1 + below(3)};
    const bool round = below(2);
    if (round) {
        c.set = random_round_zero(c.n, 1 + below(2));
    } else {
        const bool bounded = below(2);
        const Sample sample = random_expression(c.n, below(3), bounded);
        c.set = sample.set;
        for (int i = 0; i < c.n; i++) c.inside[i] = sample.inside[i];
    }
    c.other = random_expression(c.n, 1, true).set;
    fill(c.n, 1, c.direction);
    fill(c.n, 3, c.point);
    fill(c.n * c.n, 1, c.map);
    CpsSet *own = round ? cps_set_retain(c.set) : random_round_zero(c.n, 1);
    DO(cps_law_friction(own, &c.law, &err));
    c.resistance = random_resistance(c.n, c.law);
    cps_set_release(own);
    return c;
}

enum { CASES = 60 };

static void every_place_may_fail(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= CASES; seed++) {
        Case c = random_case(seed);
        for (int k = 0; k < QUESTIONS + RESISTANCES; k++) refuse_each(&c, k);
        cps_set_release(c.set);
        cps_set_release(c.other);
        cps_law_release(c.law);
        cps_resistance_release(c.resistance);
    }
    if (refused == 0) skip();
    print_message("%ld places, each refused once\n", refused);
    assert_in_range(refused, 300, 1000000); /* more than one for each question and kind of set */
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_place_may_fail)};
    return cmocka_run_group_tests_name("questions without memory", tests, NULL, NULL);
}
