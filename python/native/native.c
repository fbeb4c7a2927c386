/* SPDX-License-Identifier: BSD-3-Clause */
/* See native.h. This text is a part of the file that declare.py writes. */
#include <time.h>

#include "native.h"

/* [ns] time between two looks at Python's signals: short for a person, long for a step */
static const int64_t CAPSTAN_WATCH_PERIOD = 50000000;

static int64_t capstan_now(void) {
    struct timespec now = {0, 0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

void capstan_watch_begin(CapstanWatch *watch) {
    __atomic_store_n(&watch->asked_at, capstan_now(), __ATOMIC_RELAXED);
    __atomic_store_n(&watch->stopped, 0, __ATOMIC_RELAXED);
}

bool capstan_watch_asked(void *user) {
    CapstanWatch *watch = user;
    if (__atomic_load_n(&watch->stopped, __ATOMIC_RELAXED)) return true;
    const int64_t now = capstan_now();
    if (now - __atomic_load_n(&watch->asked_at, __ATOMIC_RELAXED) < CAPSTAN_WATCH_PERIOD)
        return false;
    __atomic_store_n(&watch->asked_at, now, __ATOMIC_RELAXED);
    if (capstan_python_asked(watch)) __atomic_store_n(&watch->stopped, 1, __ATOMIC_RELAXED);
    return __atomic_load_n(&watch->stopped, __ATOMIC_RELAXED) != 0;
}

CpsStatus capstan_watch_evolution(CapstanWatch *watch, CpsEvolution *evolution, CpsError *err) {
    return cps_evolution_interrupt(evolution, capstan_watch_asked, watch, err);
}

/* One loop for all questions: `ask` answers one of them. */
typedef CpsStatus CapstanQuestion(const CpsSet *set, const double *x, double *y,
                                  CpsSetAnswer *answer, CpsError *err);

static CpsStatus capstan_many(CapstanQuestion *ask, const CpsSet *set, int64_t count,
                              const double *x, double *y, double *value, double *gap, int *outcome,
                              CpsError *err) {
    const size_t n = (size_t)cps_set_space(set);
    for (int64_t i = 0; i < count; ++i) {
        CpsSetAnswer answer;
        const size_t at = n * (size_t)i;
        const CpsStatus status = ask(set, x + at, y ? y + at : NULL, &answer, err);
        if (status != CPS_OK) return status;
        value[i] = answer.value;
        gap[i] = answer.gap;
        outcome[i] = (int)answer.outcome;
    }
    return CPS_OK;
}

static CpsStatus capstan_project(const CpsSet *set, const double *x, double *y,
                                 CpsSetAnswer *answer, CpsError *err) {
    return cps_set_project(set, x, NULL, y, answer, err);
}

static CpsStatus capstan_gauge(const CpsSet *set, const double *x, double *y, CpsSetAnswer *answer,
                               CpsError *err) {
    (void)y;
    return cps_set_gauge(set, x, answer, err);
}

CpsStatus capstan_support_many(const CpsSet *set, int64_t count, const double *direction,
                               double *point, double *value, double *gap, int *outcome,
                               CpsError *err) {
    return capstan_many(cps_set_support, set, count, direction, point, value, gap, outcome, err);
}

CpsStatus capstan_project_many(const CpsSet *set, int64_t count, const double *from,
                               double *nearest, double *value, double *gap, int *outcome,
                               CpsError *err) {
    return capstan_many(capstan_project, set, count, from, nearest, value, gap, outcome, err);
}

CpsStatus capstan_contains_many(const CpsSet *set, int64_t count, const double *point,
                                double *separating, double *value, double *gap, int *outcome,
                                CpsError *err) {
    return capstan_many(cps_set_contains, set, count, point, separating, value, gap, outcome, err);
}

CpsStatus capstan_gauge_many(const CpsSet *set, int64_t count, const double *point, double *none,
                             double *value, double *gap, int *outcome, CpsError *err) {
    return capstan_many(capstan_gauge, set, count, point, none, value, gap, outcome, err);
}

CpsStatus capstan_dissipation_many(const CpsSet *set, int64_t count, const double *velocity,
                                   double *force, double *value, double *gap, int *outcome,
                                   CpsError *err) {
    return capstan_many(cps_set_dissipation, set, count, velocity, force, value, gap, outcome, err);
}
