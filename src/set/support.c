/* SPDX-License-Identifier: BSD-3-Clause */
/* Support, extent, projection and gauge: the closed form where there is one, else a small conic
 * program.
 *
 * The support function is computed recursively from the expression (M77 §8 and §10):
 *     h of a product, of a sum = the sum of the parts' h      h of L C (w) = h_C(L'w)
 *     h of C + g = h_C + <w, g>     h of f C (w) = |f| h_C(sign(f) w)
 *         h of a hull = the largest of the parts' h
 * Intersections, preimages and polars use the conic form that they carry. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linalg/dense.h"
#include "set/set.h"

/* The gap, relative to value and size, up to which a value that is attained only at a far point is
 * finite. Its certificate loses accuracy with the distance of the point; where the value is
 * unbounded the gap is of order 1. */
static const double ASYMPTOTIC = 3e-2;
/* Rounding of terms that cancel, relative to the largest term. */
static const double CANCELLED = 4e-16;

CpsStatus cpsi_set_conic_form(const CpsSet *set, const CpsiConicForm **form, CpsiConicForm **made,
                              CpsError *err) {
    *made = NULL;
    *form = set->form;
    if (*form) return CPS_OK;
    const CpsStatus status = cpsi_conic_form_make(set, 1, made, err);
    *form = *made;
    return status;
}

/* ---- support ---- */

void cpsi_check_attained(const CpsiConicForm *form, const double *c, CpsiSolution *solution) {
    const CpsSetOutcome outcome = solution->outcome;
    if ((outcome != CPS_SET_OUTCOME_ANSWERED && outcome != CPS_SET_OUTCOME_INACCURATE) ||
        !solution->s)
        return;
    double far = 0;
    for (int i = 0; i < form->n; i++) far = hypot(far, solution->x[i] - form->origin[i]);
    const double size = fabs(solution->value) + form->size * cpsi_norm(form->n, c);
    if (far <= CPSI_SET_FAR * form->size || solution->gap > ASYMPTOTIC * size) return;
    solution->outcome = CPS_SET_OUTCOME_NOT_ATTAINED;
    /* as a hyperbola is from its asymptote at such a point */
    solution->gap = fmax(solution->gap, size / CPSI_SET_FAR);
}

static CpsStatus conic_support(const CpsSet *set, const double *w, double *point,
                               CpsSetAnswer *answer, CpsError *err) {
    const int n = set->n;
    const CpsiConicForm *form;
    CpsiConicForm *made;
    CpsiSolution solution;
    CpsiScratch scratch;
    double *c = cpsi_scratch_take(&scratch, (size_t)n);
    if (!c) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a direction");
    for (int i = 0; i < n; i++) c[i] = -w[i];
    CpsStatus status = cpsi_set_conic_form(set, &form, &made, err);
    if (!status) status = cpsi_conic_form_minimise(form, c, &solution, err);
    if (!status) {
        cpsi_check_attained(form, c, &solution);
        *answer = (CpsSetAnswer){.outcome = solution.outcome,
                                 .value = -solution.value,
                                 .gap = solution.gap};
        if (solution.outcome == CPS_SET_OUTCOME_EMPTY) answer->value = -INFINITY;
        if (solution.outcome == CPS_SET_OUTCOME_UNBOUNDED) answer->value = INFINITY;
        if (point) memcpy(point, solution.x, (size_t)n * sizeof *point);
        cpsi_solution_free(&solution);
    }
    cpsi_conic_form_free(made);
    cpsi_scratch_give(&scratch);
    return status;
}

/* Combine with the answer for one more part: "empty" takes precedence over refusals, and these over
 * "unbounded". */
static void join(CpsSetAnswer *whole, const CpsSetAnswer *part) {
    static const int RANK[] = {
        [CPS_SET_OUTCOME_ANSWERED] = 0,      [CPS_SET_OUTCOME_NOT_ATTAINED] = 1,
        [CPS_SET_OUTCOME_UNBOUNDED] = 2,     [CPS_SET_OUTCOME_INACCURATE] = 3,
        [CPS_SET_OUTCOME_NOT_AVAILABLE] = 4, [CPS_SET_OUTCOME_EMPTY] = 5};
    if (RANK[part->outcome] > RANK[whole->outcome]) whole->outcome = part->outcome;
    whole->exact &= part->exact;
    whole->value += part->value;
    whole->gap += part->gap;
}

/* Product and sum. Where one part is unbounded the point is its ray, with 0 from the other
 * parts. */
static CpsStatus support_parts(const CpsSet *set, const double *w, double *point,
                               CpsSetAnswer *answer, CpsError *err) {
    const bool product = set->kind == CPSI_SET_PRODUCT;
    const int n = set->n;
    CpsiScratch scratch;
    double *piece = cpsi_scratch_take(&scratch, (size_t)n);
    if (!piece) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    *answer = (CpsSetAnswer){.exact = true};
    if (point) memset(point, 0, (size_t)n * sizeof *point);
    CpsStatus status = CPS_OK;
    for (int k = 0, at = 0; !status && k < set->count; k++) {
        const CpsSet *part = set->part[k];
        const bool bounded = answer->outcome != CPS_SET_OUTCOME_UNBOUNDED;
        CpsSetAnswer one;
        status = cpsi_support(part, w + at, point ? piece : NULL, &one, err);
        if (status) break;
        const bool ray = one.outcome == CPS_SET_OUTCOME_UNBOUNDED;
        if (point && ray && bounded) memset(point, 0, (size_t)n * sizeof *point);
        if (bounded || ray)
            for (int i = 0; point && i < part->n; i++) point[at + i] += piece[i];
        join(answer, &one);
        if (product) at += part->n;
    }
    if (answer->outcome == CPS_SET_OUTCOME_UNBOUNDED) answer->value = INFINITY;
    if (answer->outcome == CPS_SET_OUTCOME_EMPTY) answer->value = -INFINITY;
    cpsi_scratch_give(&scratch);
    return status;
}

void cpsi_pull_back(const CpsSet *image, const double *w, double *back) {
    const int n = image->n, m = image->part[0]->n;
    double most = 0;
    memset(back, 0, (size_t)m * sizeof *back);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < m; j++) {
            back[j] += image->a[i * m + j] * w[i];
            most = fmax(most, fabs(image->a[i * m + j] * w[i]));
        }
    for (int j = 0; j < m; j++)
        if (fabs(back[j]) < CANCELLED * most) back[j] = 0;
}

static CpsStatus support_image(const CpsSet *set, const double *w, double *point,
                               CpsSetAnswer *answer, CpsError *err) {
    const CpsSet *part = set->part[0];
    const int n = set->n, m = part->n;
    CpsiScratch scratch;
    double *back = cpsi_scratch_take(&scratch, 2 * (size_t)m), *piece = back ? back + m : NULL;
    if (!back) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a direction");
    cpsi_pull_back(set, w, back);
    const CpsStatus status = cpsi_support(part, back, point ? piece : NULL, answer, err);
    if (!status)
        for (int i = 0; point && i < n; i++) point[i] = cpsi_dot(m, &set->a[i * m], piece);
    cpsi_scratch_give(&scratch);
    return status;
}

/* Translate and scale: x = g + f y. */
static CpsStatus support_moved(const CpsSet *set, const double *w, double *point,
                               CpsSetAnswer *answer, CpsError *err) {
    const int n = set->n;
    const bool shift = set->kind == CPSI_SET_TRANSLATE;
    CpsiScratch scratch;
    double *turned = cpsi_scratch_take(&scratch, (size_t)n);
    if (!turned) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a direction");
    for (int i = 0; i < n; i++) turned[i] = shift ? w[i] : w[i] * set->scalar;
    const CpsStatus status = cpsi_support(set->part[0], turned, point, answer, err);
    if (!status) {
        const bool ray = answer->outcome == CPS_SET_OUTCOME_UNBOUNDED;
        for (int i = 0; point && i < n; i++)
            point[i] = shift ? point[i] + (ray ? 0 : set->a[i]) : point[i] * set->scalar;
        if (shift) answer->value += cpsi_dot(n, w, set->a);
    }
    cpsi_scratch_give(&scratch);
    return status;
}

static CpsStatus support_hull(const CpsSet *set, const double *w, double *point,
                              CpsSetAnswer *answer, CpsError *err) {
    const int n = set->n;
    CpsiScratch scratch;
    double *piece = cpsi_scratch_take(&scratch, (size_t)n);
    if (!piece) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_EMPTY, .exact = true, .value = -INFINITY};
    CpsStatus status = CPS_OK;
    for (int k = 0; !status && k < set->count; k++) {
        CpsSetAnswer one;
        status = cpsi_support(set->part[k], w, point ? piece : NULL, &one, err);
        if (status || one.outcome == CPS_SET_OUTCOME_EMPTY) continue; /* no contribution */
        const bool refused = one.outcome == CPS_SET_OUTCOME_INACCURATE ||
                             one.outcome == CPS_SET_OUTCOME_NOT_AVAILABLE;
        const bool exact = answer->exact && one.exact,
                   better = one.value > answer->value || refused;
        const double gap = fmax(answer->gap, one.gap);
        if (better) {
            *answer = one;
            if (point) memcpy(point, piece, (size_t)n * sizeof *point);
        }
        answer->exact = exact;
        answer->gap = gap;
        if (refused) break;
    }
    cpsi_scratch_give(&scratch);
    return status;
}

static CpsStatus support_user(const CpsSet *set, const double *w, double *point,
                              CpsSetAnswer *answer, CpsError *err) {
    CpsiScratch scratch;
    double *place = cpsi_scratch_take(&scratch, (size_t)set->n);
    if (!place) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE, .exact = true};
    double value = 0;
    bool good = set->support(set->user, set->n, w, &value, place) && isfinite(value);
    for (int i = 0; good && i < set->n; i++) good = isfinite(place[i]);
    if (good) {
        answer->outcome = CPS_SET_OUTCOME_ANSWERED;
        answer->value = value;
    }
    if (good && point) memcpy(point, place, (size_t)set->n * sizeof *point);
    cpsi_scratch_give(&scratch);
    return CPS_OK;
}

/* Points of the parts that are far away may have a near sum or image, which then belongs to the
 * closure. */
static CpsStatus in_closure(const CpsSet *set, const double *w, double *point, CpsSetAnswer *answer,
                            CpsError *err) {
    if (answer->outcome != CPS_SET_OUTCOME_NOT_ATTAINED) return CPS_OK;
    if (point) {
        if (cpsi_norm(set->n, point) <= CPSI_SET_FAR * cpsi_set_size(set))
            answer->outcome = CPS_SET_OUTCOME_ANSWERED;
        return CPS_OK;
    }
    CpsiScratch scratch;
    double *place = cpsi_scratch_take(&scratch, (size_t)set->n);
    if (!place) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    const CpsStatus status = cpsi_support(set, w, place, answer, err);
    cpsi_scratch_give(&scratch);
    return status;
}

bool cpsi_support_is_closed(const CpsSet *set) {
    enum { ON_STACK = 32 }; /* components for which CpsiScratch allocates nothing */
    if (set->n > ON_STACK) return false;
    switch (set->kind) {
    case CPSI_SET_POINTS:
    case CPSI_SET_BALL:
    case CPSI_SET_ELLIPSOID:
    case CPSI_SET_BOX: return true;
    case CPSI_SET_PRODUCT:
    case CPSI_SET_SUM:
    case CPSI_SET_IMAGE:
    case CPSI_SET_TRANSLATE:
    case CPSI_SET_SCALE:
    case CPSI_SET_HULL: break;
    default: return false;
    }
    for (int k = 0; k < set->count; k++)
        if (!cpsi_support_is_closed(set->part[k])) return false;
    return true;
}

CpsStatus cpsi_support(const CpsSet *set, const double *w, double *point, CpsSetAnswer *answer,
                       CpsError *err) {
    double value;
    if (cpsi_closed_support(set, w, point, &value)) {
        *answer = (CpsSetAnswer){.outcome = isinf(value) ? CPS_SET_OUTCOME_UNBOUNDED
                                                         : CPS_SET_OUTCOME_ANSWERED,
                                 .exact = true,
                                 .value = value};
        return CPS_OK;
    }
    switch (set->kind) {
    case CPSI_SET_USER: return support_user(set, w, point, answer, err);
    case CPSI_SET_PRODUCT: return support_parts(set, w, point, answer, err);
    case CPSI_SET_SUM:
    case CPSI_SET_IMAGE: {
        const bool sum = set->kind == CPSI_SET_SUM;
        const CpsStatus status = (sum ? support_parts : support_image)(set, w, point, answer, err);
        return status ? status : in_closure(set, w, point, answer, err);
    }
    case CPSI_SET_TRANSLATE:
    case CPSI_SET_SCALE: return support_moved(set, w, point, answer, err);
    case CPSI_SET_HULL: return support_hull(set, w, point, answer, err);
    default: break;
    }
    if (cpsi_set_has_user(set)) {
        *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
        return CPS_OK;
    }
    return conic_support(set, w, point, answer, err);
}

/* ---- programs with additional unknowns ---- */

/* Rows of one set after `own` unknowns of the query; x (n, width) and t (width) are zero, and the
 * caller fills them. */
typedef struct Query {
    CpsiConicRows *conic;
    double *x, *t;
} Query;

static CpsStatus query_new(const CpsSet *set, CpsiCount own, Query *query, CpsError *err) {
    const int used = (int)own.unknowns;
    *query = (Query){0};
    cpsi_conic_rows_count(set, &own);
    CpsStatus status = cpsi_conic_rows_new(own, used, &query->conic, err);
    if (status) return status;
    const size_t w = (size_t)query->conic->width, n = (size_t)set->n;
    query->x = calloc((n + 1) * w, sizeof *query->x);
    if (!query->x) {
        cpsi_conic_rows_free(query->conic);
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a question about a set");
    }
    query->t = query->x + n * w;
    return CPS_OK;
}

/* Write the set's rows and minimise sum c_i u_i over the first `outputs` unknowns u. */
static CpsStatus query_solve(Query *query, const CpsSet *set, int outputs, const double *c,
                             CpsiSolution *solution, CpsError *err) {
    CpsiConicForm *form = NULL;
    const size_t w = (size_t)query->conic->width;
    double *first = calloc((size_t)outputs * w, sizeof *first);
    CpsStatus status = CPS_OK;
    for (size_t i = 0; first && i < (size_t)outputs; i++) first[i * w + i] = 1;
    if (!first || !cpsi_conic_rows_write(query->conic, set, query->x, query->t))
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a question about a set");
    if (!status)
        status = cpsi_conic_form_reduce(query->conic, outputs, first, 0, NULL, 1e-11, &form, err);
    if (!status) status = cpsi_conic_form_minimise(form, c, solution, err);
    cpsi_conic_form_free(form);
    free(first);
    free(query->x);
    cpsi_conic_rows_free(query->conic);
    return status;
}

/* Minimise c times the one unknown. INFINITY where the program has the outcome `infinite`. */
static CpsStatus query_number(Query *query, const CpsSet *set, double c, CpsSetOutcome infinite,
                              CpsSetAnswer *answer, CpsError *err) {
    CpsiSolution solution;
    const CpsStatus status = query_solve(query, set, 1, &c, &solution, err);
    if (status) return status;
    *answer = (CpsSetAnswer){.outcome = solution.outcome,
                             .value = c * solution.value,
                             .gap = solution.gap};
    if (solution.outcome == infinite) {
        answer->outcome = CPS_SET_OUTCOME_ANSWERED;
        answer->value = INFINITY;
    }
    cpsi_solution_free(&solution);
    return CPS_OK;
}

CpsStatus cpsi_reach(const CpsSet *set, const double *p, const double *d, CpsSetAnswer *answer,
                     CpsError *err) {
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    if (cpsi_set_has_user(set)) return CPS_OK;
    Query query;
    CpsStatus status =
        query_new(set, (CpsiCount){.unknowns = 1, .rows = 1, .cones = 1}, &query, err);
    if (status) return status;
    const size_t w = (size_t)query.conic->width;
    for (size_t i = 0; i < (size_t)set->n; i++) {
        query.x[i * w] = d[i];
        query.x[i * w + w - 1] = p[i];
    }
    query.t[w - 1] = 1;
    return query_number(&query, set, -1, CPS_SET_OUTCOME_UNBOUNDED, answer, err);
}

CpsStatus cpsi_gauge(const CpsSet *set, const double *p, CpsSetAnswer *answer, CpsError *err) {
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true};
    if (cpsi_closed_gauge(set, p, &answer->value)) return CPS_OK;
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    if (cpsi_set_has_user(set)) return CPS_OK;
    /* min t with p in t C */
    Query query;
    CpsStatus status =
        query_new(set, (CpsiCount){.unknowns = 1, .rows = 1, .cones = 1}, &query, err);
    if (status) return status;
    const size_t w = (size_t)query.conic->width;
    for (size_t i = 0; i < (size_t)set->n; i++) query.x[i * w + w - 1] = p[i];
    query.t[0] = 1;
    cpsi_conic_rows_cone(query.conic, 1)[0] = 1;
    return query_number(&query, set, 1, CPS_SET_OUTCOME_EMPTY, answer, err);
}

/* min r with |R (x - p)| <= r, x in C; R upper triangular with M = R'R, or NULL */
static CpsStatus conic_project(const CpsSet *set, const double *p, const double *lower,
                               double *nearest, CpsSetAnswer *answer, CpsError *err) {
    const int n = set->n;
    CpsiScratch scratch;
    double *c = cpsi_scratch_take(&scratch, (size_t)n + 1);
    if (!c) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a projection");
    for (int i = 0; i <= n; i++) c[i] = i == n;
    Query query;
    CpsStatus status =
        query_new(set, (CpsiCount){.unknowns = (size_t)n + 1, .rows = (size_t)n + 1, .cones = 1},
                  &query, err);
    if (status) {
        cpsi_scratch_give(&scratch);
        return status;
    }
    const size_t w = (size_t)query.conic->width;
    double *rows = cpsi_conic_rows_cone(query.conic, n + 1);
    rows[n] = 1; /* the unknown r follows x */
    for (int i = 0; i < n; i++) {
        double *row = &rows[(size_t)(i + 1) * w];
        for (int j = i; j < (lower ? n : i + 1); j++) {
            const double factor = lower ? lower[j * n + i] : 1;
            row[j] = factor;
            row[w - 1] -= factor * p[j];
        }
        query.x[(size_t)i * w + (size_t)i] = 1;
    }
    query.t[w - 1] = 1;
    CpsiSolution solution = {.outcome = CPS_SET_OUTCOME_INACCURATE};
    status = query_solve(&query, set, n + 1, c, &solution, err);
    if (!status) {
        *answer = (CpsSetAnswer){.outcome = solution.outcome,
                                 .value = fmax(solution.value, 0),
                                 .gap = solution.gap};
        if (solution.x) memcpy(nearest, solution.x, (size_t)n * sizeof *nearest);
        cpsi_solution_free(&solution);
    }
    cpsi_scratch_give(&scratch);
    return status;
}

/* ---- public ---- */

CpsStatus cpsi_set_check(const CpsSet *set, const char *name, const double *numbers,
                         const void *answer, CpsError *err) {
    if (!set) return cpsi_fail(err, CPS_ERR_ARGUMENT, "set is NULL, expected a set");
    if (!numbers || !answer)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL", numbers ? "the answer" : name);
    return cpsi_set_finite(name, (size_t)set->n, numbers, err);
}

CpsStatus cps_set_support(const CpsSet *set, const double *direction, double *point,
                          CpsSetAnswer *answer, CpsError *err) {
    CpsStatus status = cpsi_set_check(set, "direction", direction, answer, err);
    if (!status) status = cpsi_support(set, direction, point, answer, err);
    if (!status) answer->closure = set->closure;
    return status;
}

CpsStatus cps_set_extent(const CpsSet *set, const double *direction, CpsSetExtent *extent,
                         CpsError *err) {
    CpsStatus status = cpsi_set_check(set, "direction", direction, extent, err);
    if (status) return status;
    CpsiScratch scratch;
    double *turned = cpsi_scratch_take(&scratch, (size_t)set->n);
    if (!turned) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a direction");
    for (int i = 0; i < set->n; i++) turned[i] = -direction[i];
    CpsSetAnswer high, low;
    status = cpsi_support(set, direction, NULL, &high, err);
    if (!status) status = cpsi_support(set, turned, NULL, &low, err);
    cpsi_scratch_give(&scratch);
    if (status) return status;
    *extent = (CpsSetExtent){.exact = high.exact && low.exact,
                             .closure = set->closure,
                             .low = -low.value,
                             .high = high.value,
                             .low_attained = low.outcome == CPS_SET_OUTCOME_ANSWERED,
                             .high_attained = high.outcome == CPS_SET_OUTCOME_ANSWERED,
                             .gap = fmax(high.gap, low.gap)};
    const CpsSetAnswer *both[] = {&high, &low};
    for (int k = 0; k < 2; k++)
        if (both[k]->outcome > CPS_SET_OUTCOME_NOT_ATTAINED ||
            both[k]->outcome == CPS_SET_OUTCOME_EMPTY)
            extent->outcome = both[k]->outcome;
    return CPS_OK;
}

CpsStatus cps_set_project(const CpsSet *set, const double *point, const double *metric,
                          double *nearest, CpsSetAnswer *answer, CpsError *err) {
    CpsStatus status = cpsi_set_check(set, "point", point, answer, err);
    if (!status && !nearest) status = cpsi_fail(err, CPS_ERR_ARGUMENT, "nearest is NULL");
    const size_t n = set ? (size_t)set->n : 0;
    if (!status && metric) status = cpsi_set_finite("metric", n * n, metric, err);
    if (status) return status;
    *answer =
        (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true, .closure = set->closure};
    if (!metric && cpsi_closed_project(set, point, nearest)) {
        for (size_t i = 0; i < n; i++) answer->value = hypot(answer->value, point[i] - nearest[i]);
        return CPS_OK;
    }
    double *lower = NULL;
    if (metric) {
        lower = malloc(n * n * sizeof *lower);
        if (!lower) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a metric");
        bool good = cpsi_cholesky(set->n, metric, lower);
        for (size_t i = 0; good && i < n; i++)
            for (size_t j = 0; j < i; j++) {
                const double off = fabs(metric[i * n + j] - metric[j * n + i]);
                good &= off <= 1e-12 * (metric[i * n + i] + metric[j * n + j]);
            }
        if (!good)
            status = cpsi_fail(err, CPS_ERR_ARGUMENT, "metric is not symmetric positive definite");
    }
    if (!status && cpsi_set_has_user(set))
        *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    else if (!status)
        status = conic_project(set, point, lower, nearest, answer, err);
    answer->closure = set->closure;
    free(lower);
    return status;
}

CpsStatus cps_set_gauge(const CpsSet *set, const double *point, CpsSetAnswer *answer,
                        CpsError *err) {
    CpsStatus status = cpsi_set_check(set, "point", point, answer, err);
    if (status) return status;
    CpsiScratch scratch;
    double *zero = cpsi_scratch_take(&scratch, 2 * (size_t)set->n),
           *nearest = zero ? zero + set->n : NULL;
    if (!zero) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    memset(zero, 0, (size_t)set->n * sizeof *zero);
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true};
    CpsiZero known;
    status = cpsi_set_locate_zero(set, &known, err);
    if (!status && known == CPSI_ZERO_UNKNOWN)
        status = cps_set_project(set, zero, NULL, nearest, answer, err);
    cpsi_scratch_give(&scratch);
    if (status || answer->outcome != CPS_SET_OUTCOME_ANSWERED) return status;
    if (answer->value > 1e-9 * cpsi_set_size(set)) {
        *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_NO_ZERO};
        return CPS_OK;
    }
    status = cpsi_gauge(set, point, answer, err);
    answer->closure = set->closure;
    return status;
}
