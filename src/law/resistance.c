/* SPDX-License-Identifier: BSD-3-Clause */
/* Resistance laws: construction with its checks, potential, power and forces (M77 section 7, remark
 * 1; M70 section 7). */
#include "law/resistance.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"

/* Symmetric up to this share of the largest entry: decimal input of a symmetric matrix is exactly
 * symmetric, a computed matrix up to rounding. */
static const double SYMMETRY = 1e-12;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
}

/* ---- making ---- */

static size_t data_size(int n, const CpsiTerm *term) {
    if (term->kind == CPSI_VISCOUS) return (size_t)n * (size_t)n;
    return term->kind == CPSI_TABLE ? 2 * (size_t)term->count : 0;
}

/* a copy of the term with its own references and memory */
static bool copy_term(int n, const CpsiTerm *from, CpsiTerm *to) {
    const size_t size = data_size(n, from);
    *to = *from;
    to->data = size > 0 ? malloc(size * sizeof *to->data) : NULL;
    to->set = NULL;
    if (size > 0 && !to->data) return false;
    if (size > 0) memcpy(to->data, from->data, size * sizeof *to->data);
    if (from->set) to->set = cps_set_retain(from->set);
    return true;
}

CpsResistance *cps_resistance_retain(const CpsResistance *law) {
    /* constant except for its reference count */
    CpsResistance *held = (CpsResistance *)(uintptr_t)law;
    if (held) atomic_fetch_add(&held->refcount, 1);
    return held;
}

void cps_resistance_release(CpsResistance *law) {
    if (!law || atomic_fetch_sub(&law->refcount, 1) > 1) return;
    for (int i = 0; i < law->count; i++) {
        cps_set_release(law->term[i].set);
        free(law->term[i].data);
    }
    free(law);
}

/* an empty law with memory for `count` terms */
static CpsResistance *make(int n, size_t count) {
    CpsResistance *law = malloc(sizeof *law + count * sizeof law->term[0]);
    if (law) {
        atomic_init(&law->refcount, 1);
        law->n = n;
        law->count = 0;
    }
    return law;
}

static CpsStatus make_one(int n, const CpsiTerm *term, CpsResistance **out, CpsError *err) {
    CpsResistance *law = make(n, 1);
    if (!law) return out_of_memory(err);
    if (!copy_term(n, term, &law->term[law->count++])) {
        cps_resistance_release(law);
        return out_of_memory(err);
    }
    *out = law;
    return CPS_OK;
}

CpsStatus cps_resistance_dry(const CpsLaw *law, CpsResistance **out, CpsError *err) {
    if (!law || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "law or out is NULL");
    const CpsiTerm term = {.kind = CPSI_DRY, .set = law->set};
    return make_one(cps_law_space(law), &term, out, err);
}

static CpsStatus check_symmetric(int n, const double *matrix, CpsError *err) {
    const size_t w = (size_t)n;
    double largest = 0;
    for (size_t i = 0; i < w * w; i++) {
        if (!isfinite(matrix[i]))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "the viscous matrix holds %g, expected finite numbers", matrix[i]);
        largest = fmax(largest, fabs(matrix[i]));
    }
    for (size_t i = 0; i < w; i++)
        for (size_t j = 0; j < i; j++)
            if (fabs(matrix[i * w + j] - matrix[j * w + i]) > SYMMETRY * largest)
                return cpsi_fail(err, CPS_ERR_ARGUMENT,
                                 "the viscous matrix is not symmetric (%g in row %zu, column %zu, "
                                 "but %g across): its force is no subdifferential, so no potential "
                                 "gives it (Moreau 1970, section 7)",
                                 matrix[i * w + j], i + 1, j + 1, matrix[j * w + i]);
    return CPS_OK;
}

/* D = L L' with the largest pivot first, L (n, rank) in the first columns of rows of n. Returns
 * false where D has a negative eigenvalue. A remainder below SYMMETRY of D is rounding. */
static bool factor_semidefinite(int n, const double *matrix, double *l, int *rank) {
    const size_t w = (size_t)n;
    double largest = 0;
    for (size_t i = 0; i < w; i++) largest = fmax(largest, fabs(matrix[i * w + i]));
    if (cpsi_cholesky(n, matrix, l)) {
        double least = INFINITY;
        for (size_t i = 0; i < w; i++) least = fmin(least, l[i * w + i]);
        if (least * least > SYMMETRY * largest) {
            *rank = n;
            return true;
        }
    }
    memset(l, 0, w * w * sizeof *l);
    for (*rank = 0; *rank < n; ++*rank) {
        const size_t k = (size_t)*rank;
        double most = SYMMETRY * largest, left = 0;
        int pivot = -1;
        for (size_t i = 0; i < w; i++)
            for (size_t j = 0; j < w; j++) {
                const double rest = matrix[i * w + j] - cpsi_dot(*rank, &l[i * w], &l[j * w]);
                left = fmax(left, fabs(rest));
                if (i == j && rest > most) {
                    most = rest;
                    pivot = (int)i;
                }
            }
        if (pivot < 0) return left <= 10 * SYMMETRY * largest;
        for (size_t i = 0; i < w; i++)
            l[i * w + k] = (matrix[i * w + (size_t)pivot] -
                            cpsi_dot(*rank, &l[i * w], &l[(size_t)pivot * w])) /
                           sqrt(most);
    }
    return true;
}

/* g(V) = |L'V| of the flat ellipsoid L B, phi = g^2/2; with rank 0 there is no resistance. */
static CpsStatus make_flat(int n, int rank, const double *l, CpsResistance **out, CpsError *err) {
    CpsSet *ball = NULL, *flat = NULL;
    const size_t w = (size_t)n, r = (size_t)rank;
    double *map = malloc((w * r + 1) * sizeof *map);
    if (!map) return out_of_memory(err);
    for (size_t i = 0; i < w; i++)
        for (size_t k = 0; k < r; k++) map[i * r + k] = l[i * w + k];
    CpsStatus status = CPS_OK;
    if (rank == 0)
        status = cps_set_ball(n, NULL, 1, &flat, err);
    else {
        status = cps_set_ball(rank, NULL, 1, &ball, err);
        if (status == CPS_OK) status = cps_set_image(n, map, ball, &flat, err);
    }
    const CpsiTerm term = {.kind = CPSI_POWER,
                           .set = flat,
                           .degree = 2,
                           .factor = rank > 0 ? 1 : 0};
    if (status == CPS_OK) status = make_one(n, &term, out, err);
    cps_set_release(ball);
    cps_set_release(flat);
    free(map);
    return status;
}

CpsStatus cps_resistance_viscous(int n, const double *matrix, CpsResistance **out, CpsError *err) {
    if (!matrix || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "matrix or out is NULL");
    if (n < 1 || n > CPS_SET_MAX_SPACE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "n is %d, expected from 1 to %d", n,
                         CPS_SET_MAX_SPACE);
    CpsStatus status = check_symmetric(n, matrix, err);
    if (status != CPS_OK) return status;
    double *factor = calloc((size_t)n * (size_t)n, sizeof *factor);
    if (!factor) return out_of_memory(err);
    int rank = 0;
    const bool semidefinite = factor_semidefinite(n, matrix, factor, &rank);
    if (!semidefinite)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "the viscous matrix is not positive definite, nor semidefinite: for "
                           "some velocity its force gives power to the motion (phi < phi(0))");
    else if (rank < n)
        status = make_flat(n, rank, factor, out, err);
    else {
        /* make_one only copies the matrix */
        const CpsiTerm term = {.kind = CPSI_VISCOUS, .data = (double *)matrix};
        status = make_one(n, &term, out, err);
    }
    free(factor);
    return status;
}

CpsStatus cps_resistance_power(const CpsLaw *law, double degree, double factor, CpsResistance **out,
                               CpsError *err) {
    if (!law || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "law or out is NULL");
    if (degree < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "degree %g is below 1: friction would fall with speed, which is no "
                         "subdifferential of a convex potential (Moreau 1970, section 7)",
                         degree);
    if (!(degree > 1) || !isfinite(degree))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the degree is %g, expected more than 1; degree 1 is dry friction",
                         degree);
    if (factor < 0)
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "the factor is %g: phi < phi(0) would give power to the motion; it is at least 0",
            factor);
    if (!isfinite(factor))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the factor is %g, expected a number", factor);
    const CpsiTerm term = {.kind = CPSI_POWER, .set = law->set, .degree = degree, .factor = factor};
    return make_one(cps_law_space(law), &term, out, err);
}

static CpsStatus check_table(int count, const double *speed, const double *factor, CpsError *err) {
    for (int i = 0; i < count; i++) {
        if (!isfinite(speed[i]) || !isfinite(factor[i]))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "point %d of the table is (%g, %g), expected finite numbers", i + 1,
                             speed[i], factor[i]);
        if (factor[i] < 0)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "the factor at speed %g is %g: phi < phi(0) would give power to the "
                             "motion; it is at least 0",
                             speed[i], factor[i]);
        if (i == 0 ? speed[0] != 0 : !(speed[i] > speed[i - 1]))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "speed %d of the table is %g: speeds begin with 0 and increase", i + 1,
                             speed[i]);
        if (i > 0 && factor[i] < factor[i - 1])
            return cpsi_fail(
                err, CPS_ERR_ARGUMENT,
                "the factor falls from %g at speed %g to %g at speed %g: friction that falls with "
                "speed is no subdifferential of a convex potential (Moreau 1970, section 7)",
                factor[i - 1], speed[i - 1], factor[i], speed[i]);
    }
    return CPS_OK;
}

CpsStatus cps_resistance_table(const CpsLaw *law, int count, const double *speed,
                               const double *factor, CpsResistance **out, CpsError *err) {
    if (!law || !speed || !factor || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "law, table or out is NULL");
    if (count < 1 || count > CPS_SET_MAX_ITEMS)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the table has %d points, expected from 1 to %d",
                         count, CPS_SET_MAX_ITEMS);
    CpsStatus status = check_table(count, speed, factor, err);
    if (status != CPS_OK) return status;
    double *data = malloc(2 * (size_t)count * sizeof *data);
    if (!data) return out_of_memory(err);
    memcpy(data, speed, (size_t)count * sizeof *data);
    memcpy(data + count, factor, (size_t)count * sizeof *data);
    const CpsiTerm term = {.kind = CPSI_TABLE, .set = law->set, .count = count, .data = data};
    status = make_one(cps_law_space(law), &term, out, err);
    free(data);
    return status;
}

CpsStatus cps_resistance_function(const CpsLaw *law, CpsSpeedLaw *h, CpsSpeedConjugate *conjugate,
                                  void *user, CpsResistance **out, CpsError *err) {
    if (!law || !h || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "law, h or out is NULL");
    const CpsiTerm term = {
        .kind = CPSI_FUNCTION, .set = law->set, .h = h, .conjugate = conjugate, .user = user};
    const CpsStatus status = cpsi_function_check(&term, err);
    return status == CPS_OK ? make_one(cps_law_space(law), &term, out, err) : status;
}

CpsStatus cps_resistance_sum(int count, const CpsResistance *const *parts, CpsResistance **out,
                             CpsError *err) {
    if (!parts || !out || count < 1 || count > CPS_SET_MAX_ITEMS)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "parts or out is NULL, or %d parts are not from 1 to %d", count,
                         CPS_SET_MAX_ITEMS);
    size_t terms = 0;
    for (int i = 0; i < count; i++) {
        if (!parts[i]) return cpsi_fail(err, CPS_ERR_ARGUMENT, "part %d is NULL", i + 1);
        if (parts[i]->n != parts[0]->n)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "part %d has %d components, the first %d: all act on one velocity",
                             i + 1, parts[i]->n, parts[0]->n);
        terms += (size_t)parts[i]->count;
    }
    if (terms > CPS_SET_MAX_ITEMS)
        return cpsi_fail(err, CPS_ERR_LIMIT, "%zu terms, at most %d", terms, CPS_SET_MAX_ITEMS);
    CpsResistance *law = make(parts[0]->n, terms);
    if (!law) return out_of_memory(err);
    for (int i = 0; i < count; i++)
        for (int k = 0; k < parts[i]->count; k++)
            if (!copy_term(law->n, &parts[i]->term[k], &law->term[law->count++])) {
                cps_resistance_release(law);
                return out_of_memory(err);
            }
    *out = law;
    return CPS_OK;
}

int cps_resistance_space(const CpsResistance *law) { return law ? law->n : 0; }

int cps_resistance_term_count(const CpsResistance *law) { return law ? law->count : 0; }

/* ---- potential, power, forces ---- */

/* force (n) = -D V; returns <V, D V> */
static double viscous_force(int n, const double *matrix, const double *velocity, double *force) {
    for (int i = 0; i < n; i++) force[i] = -cpsi_dot(n, matrix + (size_t)i * (size_t)n, velocity);
    return -cpsi_dot(n, velocity, force);
}

/* potential and power of one term; work (n) */
static CpsStatus term_value(int n, const CpsiTerm *term, const double *velocity, double *work,
                            CpsResistanceValue *value, CpsError *err) {
    *value = (CpsResistanceValue){.outcome = CPS_SET_OUTCOME_ANSWERED};
    if (term->kind == CPSI_VISCOUS) {
        value->power = viscous_force(n, term->data, velocity, work);
        value->potential = 0.5 * value->power;
        return CPS_OK;
    }
    CpsSetAnswer g;
    CpsStatus status = cps_set_dissipation(term->set, velocity, NULL, &g, err);
    if (status != CPS_OK) return status;
    value->outcome = g.outcome;
    if (g.outcome != CPS_SET_OUTCOME_ANSWERED && g.outcome != CPS_SET_OUTCOME_NOT_ATTAINED) {
        value->potential = value->power = INFINITY;
        return CPS_OK;
    }
    const double speed = fmax(g.value, 0);
    double slope, above;
    status = cpsi_term_at(term, speed, &value->potential, &slope, err);
    value->power = speed * slope;
    if (status != CPS_OK || !(g.gap > 0)) return status;
    status = cpsi_term_at(term, speed + g.gap, &above, &slope, err);
    value->gap = (speed + g.gap) * slope - value->power;
    return status;
}

CpsStatus cps_resistance_value(const CpsResistance *law, const double *velocity,
                               CpsResistanceValue *whole, CpsResistanceValue *by_term,
                               CpsError *err) {
    if (!law || !whole) return cpsi_fail(err, CPS_ERR_ARGUMENT, "law or whole is NULL");
    CpsStatus status = cpsi_law_check_vector("velocity", law->n, velocity, err);
    if (status != CPS_OK) return status;
    double *work = malloc((size_t)law->n * sizeof *work);
    if (!work) return out_of_memory(err);
    CpsResistanceValue sum = {.outcome = CPS_SET_OUTCOME_ANSWERED};
    for (int i = 0; i < law->count && status == CPS_OK; i++) {
        CpsResistanceValue value;
        status = term_value(law->n, &law->term[i], velocity, work, &value, err);
        if (status != CPS_OK) break;
        if (sum.outcome == CPS_SET_OUTCOME_ANSWERED) sum.outcome = value.outcome;
        sum.potential += value.potential;
        sum.power += value.power;
        sum.gap += value.gap;
        if (by_term) by_term[i] = value;
    }
    free(work);
    if (status == CPS_OK) *whole = sum;
    return status;
}

/* The forces of one term: h'(g) times a face, or a point. *forces is NULL where there are none. */
static CpsStatus term_forces(int n, const CpsiTerm *term, const double *velocity, double tolerance,
                             CpsSet **forces, CpsSetAnswer *answer, CpsError *err) {
    if (term->kind == CPSI_VISCOUS) {
        double *force = malloc((size_t)n * sizeof *force);
        if (!force) return out_of_memory(err);
        const double power = viscous_force(n, term->data, velocity, force);
        *answer =
            (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true, .value = power};
        const CpsStatus status = cps_set_point(n, force, forces, err);
        free(force);
        return status;
    }
    CpsSet *face = NULL;
    CpsStatus status = cps_set_forces(term->set, velocity, tolerance, &face, answer, err);
    if (status == CPS_OK && face) {
        const double speed = fmax(answer->value, 0);
        double potential, slope;
        status = cpsi_term_at(term, speed, &potential, &slope, err);
        answer->value = speed * slope;
        if (status == CPS_OK && isinf(slope))
            answer->outcome = CPS_SET_OUTCOME_UNBOUNDED;
        else if (status == CPS_OK)
            status = cps_set_scale(slope, face, forces, err);
    }
    cps_set_release(face);
    return status;
}

CpsStatus cps_resistance_forces(const CpsResistance *law, const double *velocity, double tolerance,
                                CpsSet **forces, CpsSetAnswer *answer, CpsError *err) {
    if (!law || !forces || !answer)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "law, forces or answer is NULL");
    CpsStatus status = cpsi_law_check_vector("velocity", law->n, velocity, err);
    if (status != CPS_OK) return status;
    CpsSet **part = calloc((size_t)law->count, sizeof *part), *sum = NULL;
    if (!part) return out_of_memory(err);
    CpsSetAnswer all = {.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true};
    for (int i = 0; i < law->count && status == CPS_OK; i++) {
        CpsSetAnswer one;
        status = term_forces(law->n, &law->term[i], velocity, tolerance, &part[i], &one, err);
        if (status != CPS_OK) break;
        if (all.outcome == CPS_SET_OUTCOME_ANSWERED) all.outcome = one.outcome;
        all.exact &= one.exact;
        all.value += one.value;
        all.gap += one.gap;
        all.tolerance = fmax(all.tolerance, one.tolerance);
    }
    if (status == CPS_OK && all.outcome == CPS_SET_OUTCOME_ANSWERED && law->count > 1)
        status = cps_set_sum(law->count, (const CpsSet *const *)part, &sum, err);
    else if (status == CPS_OK && all.outcome == CPS_SET_OUTCOME_ANSWERED)
        sum = cps_set_retain(part[0]);
    for (int i = 0; i < law->count; i++) cps_set_release(part[i]);
    free(part);
    if (status == CPS_OK) {
        *forces = sum;
        *answer = all;
    }
    return status;
}
