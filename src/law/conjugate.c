/* SPDX-License-Identifier: BSD-3-Clause */
/* The conjugate side of resistance laws: phi*(-F), velocities, and the residual of a pair.
 *
 * phi* of a sum is the minimum of the sum of the terms' conjugates over all ways to share F among
 * them (conjugate_sum.c). Closed forms:
 *
 *    one term h(g)               h*(gauge of C at F)
 *    viscous                     <F, D^-1 F>/2, V = -D^-1 F
 *    dry                         0 in the sum of the sets, infinite outside
 *    dry, and viscous c |V|^2/2  |F - P|^2/2c, P the projection of F on that sum,
 *                                V = -(F - P)/c; where P is closed */
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "law/resistance.h"

/* A force outside the dry set by less than this share of its length is on its boundary. */
static const double ON_BOUNDARY = 1e-12;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
}

static const CpsSetAnswer NO_VELOCITY = {.outcome = CPS_SET_OUTCOME_OUTSIDE,
                                         .exact = true,
                                         .value = INFINITY};

/* ---- dry and viscous terms ---- */

CpsStatus cpsi_dry_sum(const CpsResistance *law, CpsSet **dry, CpsError *err) {
    const CpsSet **set = malloc((size_t)law->count * sizeof *set);
    if (!set) return out_of_memory(err);
    int count = 0;
    for (int i = 0; i < law->count; i++)
        if (law->term[i].kind == CPSI_DRY) set[count++] = law->term[i].set;
    CpsStatus status = CPS_OK;
    if (count == 1)
        *dry = cps_set_retain(set[0]);
    else
        status = cps_set_sum(count, set, dry, err);
    free(set);
    return status;
}

/* the sum of c over the viscous terms' matrices c I; -1 where one is not a multiple of the
 * identity */
static double viscosity_of(const CpsResistance *law) {
    const size_t n = (size_t)law->n;
    double sum = 0;
    for (int t = 0; t < law->count; t++) {
        if (law->term[t].kind != CPSI_VISCOUS) continue;
        const double *matrix = law->term[t].data;
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                if (matrix[i * n + j] != (i == j ? matrix[0] : 0)) return -1;
        sum += matrix[0];
    }
    return sum;
}

/* viscosity 0: no viscous term; excess (n). The result is meaningless where the answer is not
 * exact. */
static CpsStatus closed_conjugate(const CpsSet *dry, int n, double viscosity, const double *force,
                                  double *velocity, double *excess, CpsSetAnswer *answer,
                                  CpsError *err) {
    const CpsStatus status = cps_set_project(dry, force, NULL, excess, answer, err);
    if (status != CPS_OK || answer->outcome != CPS_SET_OUTCOME_ANSWERED || !answer->exact)
        return status;
    for (int i = 0; i < n; i++) excess[i] = force[i] - excess[i];
    answer->tolerance = ON_BOUNDARY * cpsi_norm(n, force);
    const bool inside = cpsi_norm(n, excess) <= answer->tolerance;
    if (!inside && viscosity == 0) {
        *answer = NO_VELOCITY;
        return CPS_OK;
    }
    answer->value = inside ? 0 : 0.5 * cpsi_dot(n, excess, excess) / viscosity;
    for (int i = 0; i < n && velocity; i++)
        velocity[i] = inside || excess[i] == 0 ? 0 : -excess[i] / viscosity;
    return CPS_OK;
}

/* viscous terms only: D = L L', |L^-1 F|^2/2 */
static CpsStatus viscous_conjugate(const CpsResistance *law, const double *force, double *velocity,
                                   bool *closed, CpsSetAnswer *answer, CpsError *err) {
    const size_t n = (size_t)law->n, size = n * n;
    double *matrix = calloc(3 * size + n, sizeof *matrix);
    if (!matrix) return out_of_memory(err);
    double *factor = matrix + size, *inverse = factor + size, *half = inverse + size;
    for (int i = 0; i < law->count; i++)
        for (size_t k = 0; k < size; k++) matrix[k] += law->term[i].data[k];
    *closed = cpsi_cholesky(law->n, matrix, factor);
    if (*closed) {
        cpsi_lower_inverse(law->n, factor, inverse);
        for (size_t i = 0; i < n; i++) half[i] = cpsi_dot((int)i + 1, &inverse[i * n], force);
        *answer = (CpsSetAnswer){.exact = true, .value = 0.5 * cpsi_dot(law->n, half, half)};
        for (size_t j = 0; j < n && velocity; j++) {
            velocity[j] = 0;
            for (size_t i = j; i < n; i++) velocity[j] -= inverse[i * n + j] * half[i];
        }
    }
    free(matrix);
    return CPS_OK;
}

/* *closed: whether there is a closed form; if not, the answer is meaningless. */
static CpsStatus quadratic_conjugate(const CpsResistance *law, const double *force,
                                     double *velocity, bool *closed, CpsSetAnswer *answer,
                                     CpsError *err) {
    const double viscosity = viscosity_of(law);
    *closed = false;
    if (viscosity < 0) return CPS_OK;
    double *excess = malloc((size_t)law->n * sizeof *excess);
    if (!excess) return out_of_memory(err);
    CpsSet *dry = NULL;
    CpsStatus status = cpsi_dry_sum(law, &dry, err);
    if (status == CPS_OK)
        status = closed_conjugate(dry, law->n, viscosity, force, velocity, excess, answer, err);
    *closed = status == CPS_OK && answer->exact;
    cps_set_release(dry);
    free(excess);
    return status;
}

/* ---- one term h(g) ---- */

static CpsStatus term_conjugate(const CpsResistance *law, const double *force, double *velocity,
                                CpsSetAnswer *answer, CpsError *err) {
    const CpsiTerm *term = &law->term[0];
    CpsSetAnswer gauge;
    CpsStatus status = cps_set_gauge(term->set, force, &gauge, err);
    if (status != CPS_OK) return status;
    *answer = gauge;
    if (gauge.outcome != CPS_SET_OUTCOME_ANSWERED) return CPS_OK;

    CpsiTermDual dual;
    status = cpsi_term_dual(term, gauge.value, &dual, err);
    /* a force beyond the largest slope by rounding only is on it */
    if (status == CPS_OK && isinf(dual.value)) {
        status = cpsi_term_dual(term, gauge.value * (1 - ON_BOUNDARY), &dual, err);
        answer->tolerance = ON_BOUNDARY * cpsi_norm(law->n, force);
    }
    if (status != CPS_OK) return status;
    answer->value = dual.value;
    answer->gap = gauge.gap * dual.low;
    if (isinf(dual.value)) {
        *answer = NO_VELOCITY;
        return CPS_OK;
    }
    if (!velocity) return CPS_OK;
    CpsSetAnswer split;
    status = cpsi_conjugate_sum(law, force, velocity, NULL, &split, err);
    if (status == CPS_OK) answer->outcome = split.outcome;
    return status;
}

CpsStatus cps_resistance_conjugate(const CpsResistance *law, const double *force, double *velocity,
                                   CpsSetAnswer *answer, CpsError *err) {
    if (!law || !answer) return cpsi_fail(err, CPS_ERR_ARGUMENT, "law or answer is NULL");
    CpsStatus status = cpsi_law_check_vector("force", law->n, force, err);
    if (status != CPS_OK) return status;
    int dry = 0, viscous = 0;
    bool closed = false;
    for (int i = 0; i < law->count; i++) {
        dry += law->term[i].kind == CPSI_DRY;
        viscous += law->term[i].kind == CPSI_VISCOUS;
    }
    const bool quadratic = dry + viscous == law->count;
    if (viscous == law->count)
        status = viscous_conjugate(law, force, velocity, &closed, answer, err);
    else if (quadratic)
        status = quadratic_conjugate(law, force, velocity, &closed, answer, err);
    if (status != CPS_OK || closed) return status;
    if (law->count == 1 && !quadratic) return term_conjugate(law, force, velocity, answer, err);
    return cpsi_conjugate_sum(law, force, velocity, NULL, answer, err);
}

/* ---- residual of a pair ---- */

CpsStatus cps_resistance_residual(const CpsResistance *law, const double *force,
                                  const double *velocity, double *gap, double *distance,
                                  CpsError *err) {
    if (!law || !gap || !distance)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "law, gap or distance is NULL");
    CpsResistanceValue value;
    CpsSetAnswer conjugate, answer, nearest;
    CpsSet *forces = NULL;
    CpsStatus status = cps_resistance_value(law, velocity, &value, NULL, err);
    if (status == CPS_OK) status = cps_resistance_conjugate(law, force, NULL, &conjugate, err);
    if (status == CPS_OK) status = cps_resistance_forces(law, velocity, 0, &forces, &answer, err);
    double *point = status == CPS_OK ? malloc((size_t)law->n * sizeof *point) : NULL;
    if (status == CPS_OK && !point) status = out_of_memory(err);
    double away = forces ? NAN : INFINITY;
    if (status == CPS_OK && forces)
        status = cps_set_project(forces, force, NULL, point, &nearest, err);
    if (status == CPS_OK && forces && nearest.outcome == CPS_SET_OUTCOME_ANSWERED)
        away = nearest.value;
    free(point);
    cps_set_release(forces);
    if (status != CPS_OK) return status;
    const bool known = conjugate.outcome == CPS_SET_OUTCOME_ANSWERED ||
                       conjugate.outcome == CPS_SET_OUTCOME_OUTSIDE;
    *gap = known ? value.potential + conjugate.value + cpsi_dot(law->n, velocity, force) : NAN;
    *distance = away;
    return CPS_OK;
}
