/* SPDX-License-Identifier: BSD-3-Clause */
/* All velocities for a force: the subgradients of phi* at -F.
 *
 * For shares F_1 + F_2 + .. = F of least cost, V is a velocity for F exactly when it is one for
 * every term at its share (the gaps of the terms add up to that of the sum). For a term h(g), at
 * the gauge s of its share, the velocities are
 *
 *     -V normal to C at F_i/s,      low <= g(V) = -<V, F_i/s> <= high,
 *         [low, high] the speeds where h' is s,
 *
 * the whole normal cone where C is dry and F_i on its boundary, and those with g(V) = 0 where s is
 * below h'(0). Shares and gauges are known up to a tolerance, so each term's set is moved to
 * contain the one velocity that is known. */
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "law/resistance.h"

/* Relative error of the shares of a sum, and of the gauge of one term. */
static const double SHARED = 1e-6, ALONE = 1e-9;
/* A set does not belong to the force where its distance from the velocity exceeds this share of the
 * velocity, or [m/s] at rest. */
static const double MOST_MOVED = 1e-3, REST = 1e-12;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
}

/* The speeds of a term at the gauge s, which has the error `tolerance`: the whole interval where h'
 * is constant. */
static CpsStatus speeds(const CpsiTerm *term, double s, double tolerance, double *low, double *high,
                        CpsError *err) {
    CpsiTermDual below = {0}, above = {0};
    /* the slopes of a table are exact */
    if (term->kind == CPSI_TABLE)
        for (int i = 0; i < term->count; i++) {
            const double slope = term->data[term->count + i];
            if (fabs(s - slope) <= tolerance * slope) {
                s = slope;
                tolerance = 0;
            }
        }
    CpsStatus status = cpsi_term_dual(term, s * (1 - tolerance), &below, err);
    if (status == CPS_OK) status = cpsi_term_dual(term, s * (1 + tolerance), &above, err);
    *low = below.low;
    *high = above.high;
    /* where the slope increases there is one speed, though s has an error */
    if (status == CPS_OK && isfinite(above.high) &&
        above.high - below.low <= 1e3 * tolerance * above.high)
        *low = *high = 0.5 * (below.low + above.high);
    return status;
}

CpsStatus cpsi_term_velocities(int n, const CpsiTerm *term, const double *force, double tolerance,
                               CpsSet **out, CpsError *err) {
    CpsSetAnswer gauge, answer;
    CpsSet *cone = NULL, *strip = NULL;
    double low = 0, high = 0, *point = calloc((size_t)n, sizeof *point);
    *out = NULL;
    if (!point) return out_of_memory(err);
    CpsStatus status = cps_set_gauge(term->set, force, &gauge, err);
    const bool known =
        status == CPS_OK && gauge.outcome == CPS_SET_OUTCOME_ANSWERED && isfinite(gauge.value);
    if (known) status = speeds(term, gauge.value, tolerance, &low, &high, err);
    const bool moves = high > 0 && gauge.value > tolerance;
    if (known && moves)
        for (int i = 0; i < n; i++) point[i] = force[i] / gauge.value;
    if (status == CPS_OK && known && isfinite(low))
        status = cps_set_velocities(term->set, point, tolerance, &cone, &answer, err);
    if (status == CPS_OK && cone && moves && isfinite(high))
        status = cps_set_strip(n, point, -high, -low, &strip, err);
    else if (status == CPS_OK && cone && moves && low > 0)
        status = cps_set_half_space(n, point, -low, &strip, err);
    if (status == CPS_OK && strip)
        status = cps_set_intersection(2, (const CpsSet *const[]){cone, strip}, out, err);
    else if (status == CPS_OK && cone)
        *out = cps_set_retain(cone);
    cps_set_release(cone);
    cps_set_release(strip);
    free(point);
    return status;
}

/* `set` moved so that it contains x; *out is NULL where it is too far away. */
static CpsStatus move_to(const CpsSet *set, const double *x, CpsSet **out, CpsError *err) {
    const int n = cps_set_space(set);
    CpsSetAnswer near;
    double *shift = malloc((size_t)n * sizeof *shift);
    if (!shift) return out_of_memory(err);
    CpsStatus status = cps_set_project(set, x, NULL, shift, &near, err);
    const bool there = near.outcome == CPS_SET_OUTCOME_ANSWERED &&
                       near.value <= MOST_MOVED * cpsi_norm(n, x) + REST;
    for (int i = 0; i < n; i++) shift[i] = x[i] - shift[i];
    if (status == CPS_OK && there && near.value > 0)
        status = cps_set_translate(shift, set, out, err);
    else if (status == CPS_OK && there)
        *out = cps_set_retain(set);
    free(shift);
    return status;
}

/* The intersection of the terms' sets at their shares. */
static CpsStatus meet(const CpsResistance *law, const double *share, const double *velocity,
                      CpsSet **out, CpsSetAnswer *answer, CpsError *err) {
    CpsSet **part = calloc((size_t)law->count, sizeof *part);
    if (!part) return out_of_memory(err);
    CpsStatus status = CPS_OK;
    int parts = 0;
    const double tolerance = law->count > 1 ? SHARED : ALONE;
    for (int i = 0;
         i < law->count && status == CPS_OK && answer->outcome == CPS_SET_OUTCOME_ANSWERED; i++) {
        CpsSet *own = NULL;
        if (!cpsi_term_resists(&law->term[i])) continue;
        status = cpsi_term_velocities(law->n, &law->term[i], &share[(size_t)i * (size_t)law->n],
                                      tolerance, &own, err);
        if (status == CPS_OK && own) status = move_to(own, velocity, &part[parts], err);
        if (status == CPS_OK && !part[parts])
            answer->outcome = CPS_SET_OUTCOME_INACCURATE;
        else
            parts++;
        cps_set_release(own);
    }
    if (status == CPS_OK && answer->outcome == CPS_SET_OUTCOME_ANSWERED && parts == 1)
        *out = cps_set_retain(part[0]);
    else if (status == CPS_OK && answer->outcome == CPS_SET_OUTCOME_ANSWERED && parts > 0)
        status = cps_set_intersection(parts, (const CpsSet *const *)part, out, err);
    else if (status == CPS_OK && answer->outcome == CPS_SET_OUTCOME_ANSWERED)
        status = cps_set_inequalities(law->n, 0, NULL, NULL, out, err); /* there is no resistance */
    for (int i = 0; i < parts; i++) cps_set_release(part[i]);
    free(part);
    return status;
}

/* A point where the set is one point, up to the tolerance of cps_set_facts. */
static CpsStatus simplest(CpsSet *set, int n, const double *velocity, CpsSet **out,
                          CpsSetAnswer *answer, CpsError *err) {
    CpsSetFacts facts;
    CpsStatus status = cps_set_facts(set, 0, &facts, NULL, NULL, err);
    if (status == CPS_OK && facts.outcome == CPS_SET_OUTCOME_ANSWERED && facts.dimension > 0)
        *out = cps_set_retain(set);
    else if (status == CPS_OK && facts.outcome == CPS_SET_OUTCOME_ANSWERED)
        status = cps_set_point(n, velocity, out, err);
    else if (status == CPS_OK)
        answer->outcome = facts.outcome;
    return status;
}

bool cps_resistance_is_dry(const CpsResistance *law) {
    if (law)
        for (int i = 0; i < law->count; i++)
            if (law->term[i].kind != CPSI_DRY) return false;
    return law != NULL;
}

CpsStatus cps_resistance_velocities(const CpsResistance *law, const double *force,
                                    CpsSet **velocities, CpsSetAnswer *answer, CpsError *err) {
    if (!law || !velocities || !answer)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "law, velocities or answer is NULL");
    *velocities = NULL;
    const size_t n = (size_t)law->n;
    const bool dry = cps_resistance_is_dry(law);
    bool viscous = false;
    for (int i = 0; i < law->count; i++) viscous |= law->term[i].kind == CPSI_VISCOUS;
    double *velocity = calloc(n * ((size_t)law->count + 1), sizeof *velocity);
    if (!velocity) return out_of_memory(err);
    double *share = velocity + n;
    CpsSet *set = NULL;
    CpsStatus status = cps_resistance_conjugate(law, force, velocity, answer, err);
    if (status == CPS_OK && answer->outcome == CPS_SET_OUTCOME_ANSWERED && dry) {
        CpsSet *sum = NULL;
        CpsSetAnswer cone;
        status = cpsi_dry_sum(law, &sum, err);
        if (status == CPS_OK) status = cps_set_velocities(sum, force, 0, &set, &cone, err);
        if (status == CPS_OK && !set) answer->outcome = cone.outcome;
        cps_set_release(sum);
    } else if (status == CPS_OK && answer->outcome == CPS_SET_OUTCOME_ANSWERED && !viscous) {
        CpsSetAnswer shared = {.outcome = CPS_SET_OUTCOME_ANSWERED};
        if (law->count == 1)
            memcpy(share, force, n * sizeof *share);
        else
            status = cpsi_conjugate_sum(law, force, NULL, share, &shared, err);
        if (status == CPS_OK && shared.outcome != CPS_SET_OUTCOME_ANSWERED)
            answer->outcome = shared.outcome;
        else if (status == CPS_OK)
            status = meet(law, share, velocity, &set, answer, err);
    }
    if (status == CPS_OK && set)
        status = simplest(set, law->n, velocity, velocities, answer, err);
    else if (status == CPS_OK && answer->outcome == CPS_SET_OUTCOME_ANSWERED)
        status = cps_set_point(law->n, velocity, velocities, err);
    cps_set_release(set);
    free(velocity);
    return status;
}
