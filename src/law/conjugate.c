/* SPDX-License-Identifier: BSD-3-Clause */
/* The other side of resistance laws: phi*(-F), velocities, and how far a pair is from the law.
 *
 * phi* of a sum is the least sum of the terms' conjugates over all ways of sharing F among them. Closed forms:
 *
 *   one term h(g)     h*(gauge of C at F); V = -g w / h_C(w) for a normal w of C at F/gauge, g where h' reaches the
 * gauge dry + viscous     |F - P|^2/2 in the metric D^-1, P the projection of F on the dry set in that metric; V =
 * -D^-1 (F - P) */
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "law/resistance.h"

/* A force outside the dry set by less than this part of its length is on its boundary. */
static const double ON_BOUNDARY = 1e-12;

static CpsStatus out_of_memory(CpsError *err) { return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory"); }

static const CpsSetAnswer NO_VELOCITY = {.outcome = CPS_SET_OUTSIDE, .value = INFINITY};

/* ---- dry and viscous terms ---- */

/* the sum of the dry terms' sets ({0} without one), and of the viscous matrices (n x n, zeroed before) */
static CpsStatus gather(const CpsResistance *law, CpsSet **dry, double *matrix, bool *viscous, CpsError *err) {
    const size_t size = (size_t)law->n * (size_t)law->n;
    const CpsSet **set = malloc((size_t)law->count * sizeof *set);
    if (!set) return out_of_memory(err);
    int count = 0;
    *viscous = false;
    for (int i = 0; i < law->count; i++) {
        if (law->term[i].kind == CPSI_DRY) {
            set[count++] = law->term[i].set;
            continue;
        }
        for (size_t k = 0; k < size; k++) matrix[k] += law->term[i].data[k];
        *viscous = true;
    }
    CpsStatus status = CPS_OK;
    if (count == 0)
        status = cps_set_subspace(law->n, 0, NULL, dry, err);
    else if (count == 1)
        *dry = cps_set_retain(set[0]);
    else
        status = cps_set_sum(count, set, dry, err);
    free(set);
    return status;
}

/* metric = D^-1 = M'M, M the inverse of the lower Cholesky factor of D */
static void make_metric(int n, const double *m, double *metric) {
    const size_t w = (size_t)n;
    for (size_t i = 0; i < w; i++)
        for (size_t j = 0; j <= i; j++) {
            double sum = 0;
            for (size_t k = i; k < w; k++) sum += m[k * w + i] * m[k * w + j];
            metric[i * w + j] = metric[j * w + i] = sum;
        }
}

/* without viscosity: 0 on the set, infinite outside */
static CpsStatus dry_conjugate(const CpsSet *dry, int n, const double *force, double *velocity, CpsSetAnswer *answer,
                               CpsError *err) {
    CpsSetAnswer margin;
    const CpsStatus status = cps_set_contains(dry, force, NULL, &margin, err);
    if (status != CPS_OK) return status;
    *answer = margin;
    if (margin.outcome != CPS_SET_ANSWERED) return CPS_OK;
    answer->tolerance = ON_BOUNDARY * cpsi_norm(n, force);
    answer->value = answer->gap = 0;
    if (margin.value < -answer->tolerance)
        *answer = NO_VELOCITY;
    else if (velocity)
        memset(velocity, 0, (size_t)n * sizeof *velocity);
    return CPS_OK;
}

/* c of c I, 0 for every other matrix: the projection is then Euclidean, for which more sets have closed forms */
static double multiple_of_identity(int n, const double *matrix) {
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            if (matrix[(size_t)i * (size_t)n + (size_t)j] != (i == j ? matrix[0] : 0)) return 0;
    return matrix[0];
}

static CpsStatus isotropic_conjugate(const CpsSet *dry, int n, double viscosity, const double *force, double *velocity,
                                     double *excess, CpsSetAnswer *answer, CpsError *err) {
    const CpsStatus status = cps_set_project(dry, force, NULL, excess, answer, err);
    if (status != CPS_OK || answer->outcome != CPS_SET_ANSWERED) return status;
    for (int i = 0; i < n; i++) excess[i] = force[i] - excess[i];
    answer->gap *= (answer->value + 0.5 * answer->gap) / viscosity;
    answer->value = 0.5 * cpsi_dot(n, excess, excess) / viscosity;
    for (int i = 0; i < n && velocity; i++) velocity[i] = excess[i] == 0 ? 0 : -excess[i] / viscosity;
    return CPS_OK;
}

/* work (3n^2 + n): Cholesky factor of D, its inverse, D^-1; excess F - P */
static CpsStatus bingham_conjugate(const CpsSet *dry, int n, const double *matrix, const double *force,
                                   double *velocity, double *work, CpsSetAnswer *answer, CpsError *err) {
    const size_t size = (size_t)n * (size_t)n;
    double *factor = work, *inverse = work + size, *metric = work + 2 * size, *excess = work + 3 * size;
    const double viscosity = multiple_of_identity(n, matrix);
    if (viscosity > 0) return isotropic_conjugate(dry, n, viscosity, force, velocity, excess, answer, err);
    if (!cpsi_cholesky(n, matrix, factor)) {
        *answer = (CpsSetAnswer){.outcome = CPS_SET_INACCURATE};
        return CPS_OK;
    }
    cpsi_lower_inverse(n, factor, inverse);
    make_metric(n, inverse, metric);
    const CpsStatus status = cps_set_project(dry, force, metric, excess, answer, err);
    if (status != CPS_OK || answer->outcome != CPS_SET_ANSWERED) return status;
    for (int i = 0; i < n; i++) excess[i] = force[i] - excess[i];

    /* |F - P|^2/2 as a sum of squares; V = -D^-1 (F - P) */
    double square = 0;
    for (int i = 0; i < n; i++) {
        const double x = cpsi_dot(i + 1, inverse + (size_t)i * (size_t)n, excess);
        square += x * x;
    }
    answer->gap *= answer->value + 0.5 * answer->gap;
    answer->value = 0.5 * square;
    for (int i = 0; i < n && velocity; i++) {
        const double v = cpsi_dot(n, metric + (size_t)i * (size_t)n, excess);
        velocity[i] = v == 0 ? 0 : -v;
    }
    return CPS_OK;
}

static CpsStatus quadratic_conjugate(const CpsResistance *law, const double *force, double *velocity,
                                     CpsSetAnswer *answer, CpsError *err) {
    const size_t n = (size_t)law->n;
    double *matrix = calloc(4 * n * n + n, sizeof *matrix);
    if (!matrix) return out_of_memory(err);
    CpsSet *dry = NULL;
    bool viscous = false;
    CpsStatus status = gather(law, &dry, matrix, &viscous, err);
    if (status == CPS_OK && viscous)
        status = bingham_conjugate(dry, law->n, matrix, force, velocity, matrix + n * n, answer, err);
    else if (status == CPS_OK)
        status = dry_conjugate(dry, law->n, force, velocity, answer, err);
    cps_set_release(dry);
    free(matrix);
    return status;
}

/* ---- one term h(g) ---- */

/* V = -speed w / h_C(w) for a normal w of C at force/gauge; work (2n) */
static CpsStatus velocity_on_ray(const CpsSet *set, int n, const double *force, double gauge, double speed,
                                 double *work, double *velocity, CpsSetAnswer *answer, CpsError *err) {
    double *point = work, *normal = work + n;
    for (int i = 0; i < n; i++) point[i] = force[i] / gauge;
    CpsSet *cone = NULL;
    CpsSetAnswer touch, reach;
    CpsSetFacts facts;
    CpsStatus status = cps_set_normal_cone(set, point, 0, &cone, &touch, err);
    if (status == CPS_OK && !cone) answer->outcome = touch.outcome;
    if (status == CPS_OK && cone) status = cps_set_facts(cone, 0, &facts, normal, NULL, err);
    if (status == CPS_OK && cone) status = cps_set_support(set, normal, NULL, &reach, err);
    if (status == CPS_OK && cone) {
        if (reach.outcome == CPS_SET_ANSWERED && reach.value > 0)
            for (int i = 0; i < n; i++) velocity[i] = -speed / reach.value * normal[i];
        else
            answer->outcome = CPS_SET_INACCURATE;
    }
    cps_set_release(cone);
    return status;
}

static CpsStatus term_conjugate(const CpsResistance *law, const double *force, double *velocity, CpsSetAnswer *answer,
                                CpsError *err) {
    const CpsiTerm *term = &law->term[0];
    const int n = law->n;
    CpsSetAnswer gauge;
    CpsStatus status = cps_set_gauge(term->set, force, &gauge, err);
    if (status != CPS_OK) return status;
    *answer = gauge;
    if (gauge.outcome != CPS_SET_ANSWERED) return CPS_OK;

    double speed;
    answer->value = cpsi_term_conjugate(term, gauge.value, &speed);
    answer->gap = gauge.gap * speed;
    if (isinf(answer->value)) {
        *answer = NO_VELOCITY;
        return CPS_OK;
    }
    if (!velocity) return CPS_OK;
    memset(velocity, 0, (size_t)n * sizeof *velocity);
    if (!(speed > 0)) return CPS_OK;
    double *work = malloc(2 * (size_t)n * sizeof *work);
    if (!work) return out_of_memory(err);
    status = velocity_on_ray(term->set, n, force, gauge.value, speed, work, velocity, answer, err);
    free(work);
    return status;
}

CpsStatus cps_resistance_conjugate(const CpsResistance *law, const double *force, double *velocity,
                                   CpsSetAnswer *answer, CpsError *err) {
    if (!law || !answer) return cpsi_fail(err, CPS_ERR_ARGUMENT, "law or answer is NULL");
    const CpsStatus status = cpsi_law_check_vector("force", law->n, force, err);
    if (status != CPS_OK) return status;
    bool quadratic = true;
    for (int i = 0; i < law->count; i++)
        quadratic = quadratic && (law->term[i].kind == CPSI_DRY || law->term[i].kind == CPSI_VISCOUS);
    if (quadratic) return quadratic_conjugate(law, force, velocity, answer, err);
    if (law->count == 1) return term_conjugate(law, force, velocity, answer, err);
    *answer = (CpsSetAnswer){.outcome = CPS_SET_NOT_AVAILABLE, .value = NAN};
    return CPS_OK;
}

/* ---- a pair ---- */

CpsStatus cps_resistance_residual(const CpsResistance *law, const double *force, const double *velocity, double *gap,
                                  double *distance, CpsError *err) {
    if (!law || !gap || !distance) return cpsi_fail(err, CPS_ERR_ARGUMENT, "law, gap or distance is NULL");
    CpsResistanceValue value;
    CpsSetAnswer conjugate, answer, nearest;
    CpsSet *forces = NULL;
    CpsStatus status = cps_resistance_value(law, velocity, &value, NULL, err);
    if (status == CPS_OK) status = cps_resistance_conjugate(law, force, NULL, &conjugate, err);
    if (status == CPS_OK) status = cps_resistance_forces(law, velocity, 0, &forces, &answer, err);
    double *point = status == CPS_OK ? malloc((size_t)law->n * sizeof *point) : NULL;
    if (status == CPS_OK && !point) status = out_of_memory(err);
    double away = forces ? NAN : INFINITY;
    if (status == CPS_OK && forces) status = cps_set_project(forces, force, NULL, point, &nearest, err);
    if (status == CPS_OK && forces && nearest.outcome == CPS_SET_ANSWERED) away = nearest.value;
    free(point);
    cps_set_release(forces);
    if (status != CPS_OK) return status;
    const bool known = conjugate.outcome == CPS_SET_ANSWERED || conjugate.outcome == CPS_SET_OUTSIDE;
    *gap = known ? value.potential + conjugate.value + cpsi_dot(law->n, velocity, force) : NAN;
    *distance = away;
    return CPS_OK;
}
