/* SPDX-License-Identifier: BSD-3-Clause */
/* The normal cone N = {w : <w, x - p> <= 0 for every x of C} as a set of its own.
 *
 * With C = {origin + P v + Q'l : A v + b in K} and a point v of the fibre over p whose s = A v + b
 * is as far inside K as possible:
 *
 *     N = {w : Q w = 0,  P'w + A'z = 0,  z in K,  z.s = 0}
 *         (Rockafellar 1970, theorem 23.9 and its proof)
 *
 * where z.s = 0 holds cone by cone: for s inside, z = 0; for s on the boundary, z on the ray of Js;
 * for s = 0, z anywhere in the cone. For products, translates and scales the cones of the parts are
 * computed first (M77 §8). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ipm/cones.h"
#include "linalg/dense.h"
#include "set/set.h"

/* Equations that differ by less than this share are the same. A point with the error `tolerance`
 * has normals with the error tolerance/radius, for radii down to a hundredth of the set. */
static const double SAME_EQUATION = 1e-7, TURN = 100;

/* How each cone of the form is active at p. */
typedef enum Touch { FREE, RAY, TIP } Touch;

static Touch touch_of(const double *s, int d, double tolerance) {
    const double size = cpsi_norm(d - 1, s + 1);
    if (s[0] - size > tolerance) return FREE;
    return d > 1 && s[0] > tolerance ? RAY : TIP;
}

/* The fibre over p: v = v0 + (null space of P), with rows A v + b + tau e in K. The minimum of tau
 * places s as far inside as possible: tau = 0 for p on the boundary; where rounding has displaced p
 * from the boundary, the solution is still unique and well conditioned. tau >= -1 bounds the
 * problem for sets without boundary. Writes s (rows of the form). */
static CpsStatus fibre(const CpsiConicForm *form, const double *p, double *s,
                       CpsSetOutcome *outcome, CpsError *err) {
    const int n = form->n, u = form->unknowns;
    CpsiConicRows *conic = NULL;
    CpsiConicForm *reduced = NULL;
    const CpsiCount count = {.unknowns = (size_t)u + 1,
                             .equations = (size_t)n,
                             .rows = (size_t)form->rows + 1,
                             .cones = (size_t)form->cones + 1};
    CpsStatus status = cpsi_conic_rows_new(count, u + 1, &conic, err);
    if (status) return status;
    for (int i = 0; i < n; i++) {
        double *row = cpsi_conic_rows_equation(conic), gap = p[i] - form->origin[i];
        /* the components of p along the lines do not matter */
        for (int l = 0; l < form->lines; l++)
            for (int j = 0; j < n; j++)
                gap -= form->q[l * n + i] * form->q[l * n + j] * (p[j] - form->origin[j]);
        memcpy(row, &form->p[(size_t)i * (size_t)u], (size_t)u * sizeof *row);
        row[u + 1] = -gap;
        if (cpsi_norm(u, row) <= 1e-12 * form->size) {
            conic->equations--;
            memset(row, 0, ((size_t)u + 2) * sizeof *row);
        }
    }
    for (int k = 0, i = 0; k < form->cones; k++) {
        double *rows = cpsi_conic_rows_cone(conic, form->dim[k]);
        rows[u] = 1;
        for (int r = 0; r < form->dim[k]; r++, i++, rows += conic->width) {
            memcpy(rows, &form->a[(size_t)i * (size_t)u], (size_t)u * sizeof *rows);
            rows[u + 1] = form->b[i];
        }
    }
    double *last = cpsi_conic_rows_cone(conic, 1);
    last[u] = last[u + 1] = 1;
    double *map = calloc(((size_t)u + 1) * (size_t)conic->width, sizeof *map);
    if (!map) status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a normal cone");
    for (size_t j = 0; map && j <= (size_t)u; j++) map[j * (size_t)conic->width + j] = 1;
    if (!status)
        status = cpsi_conic_form_reduce(conic, u + 1, map, 0, NULL, SAME_EQUATION, &reduced, err);
    free(map);
    cpsi_conic_rows_free(conic);
    if (status) return status;

    /* v at the deepest point of the fibre */
    CpsiSolution solution = {.outcome = CPS_SET_OUTCOME_INACCURATE};
    double *c = calloc((size_t)u + 1, sizeof *c);
    if (!c)
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a normal cone");
    else {
        c[u] = 1;
        status = cpsi_conic_form_minimise(reduced, c, &solution, err);
    }
    *outcome = solution.outcome;
    if (!status && solution.outcome == CPS_SET_OUTCOME_ANSWERED)
        for (int i = 0; i < form->rows; i++)
            s[i] = cpsi_dot(u, &form->a[(size_t)i * (size_t)u], solution.x) + form->b[i];
    cpsi_solution_free(&solution);
    cpsi_conic_form_free(reduced);
    free(c);
    return status;
}

/* A simplicial cone given by half-lines is spanned by its rays: {P v : A v >= 0} = columns of P
 * A^-1. */
static CpsStatus as_rays(CpsiConicForm *form, CpsSet **out, CpsError *err) {
    const size_t n = (size_t)form->n, u = (size_t)form->unknowns, lines = (size_t)form->lines;
    bool simple = form->rows == form->unknowns && form->largest_cone <= 1;
    double *inverse = malloc((u * u + u + (u + 2 * lines) * n + 1) * sizeof *inverse),
           *column = inverse ? inverse + u * u : NULL;
    int *pivot = malloc((u + 1) * sizeof *pivot);
    CpsStatus status = CPS_OK;
    if (!inverse || !pivot) {
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a normal cone");
        simple = false;
    }
    if (simple) {
        memcpy(inverse, form->a, u * u * sizeof *inverse);
        simple = u == 0 || cpsi_lu_factor(form->unknowns, inverse, pivot);
    }
    if (simple) {
        double *rays = column + u;
        for (size_t k = 0; k < u; k++) {
            memset(column, 0, u * sizeof *column);
            column[k] = 1;
            cpsi_lu_solve(form->unknowns, inverse, pivot, column);
            double *ray = &rays[k * n];
            for (size_t i = 0; i < n; i++)
                ray[i] = cpsi_dot(form->unknowns, &form->p[i * u], column);
            const double size = cpsi_norm(form->n, ray);
            for (size_t i = 0; i < n; i++) ray[i] = size > 0 ? ray[i] / size : 0;
            /* a combination of the unknowns that lies in the null space of P */
            simple &= size > 0;
        }
        if (simple)
            for (size_t l = 0; l < lines; l++)
                for (size_t i = 0; i < n; i++) {
                    rays[(u + 2 * l) * n + i] = form->q[l * n + i];
                    rays[(u + 2 * l + 1) * n + i] = -form->q[l * n + i];
                }
        if (simple) status = cps_set_cone_of_rays(form->n, (int)(u + 2 * lines), rays, out, err);
    }
    free(inverse);
    free(pivot);
    if (!simple && !status) return cpsi_set_from_conic_form(form, out, err);
    cpsi_conic_form_free(form);
    return status;
}

/* The z of one cone as new unknowns: its contribution to P'w + A'z = 0, and the rows that keep it
 * in the cone. */
static void write_touch(CpsiConicRows *conic, const CpsiConicForm *form, const double *s, int i,
                        int d, Touch touch, double *equations) {
    const int u = form->unknowns;
    if (touch == FREE) return;
    const int count = touch == RAY || d == 1 ? 1 : d;
    double *rows = cpsi_conic_rows_cone(conic, count);
    const double size = cpsi_norm(d - 1, s + 1);
    for (int k = 0; k < count; k++, conic->next++) {
        rows[(size_t)k * (size_t)conic->width + (size_t)conic->next] = 1;
        for (int r = 0; r < d; r++) {
            const double z = count > 1 || d == 1 ? r == k : r ? -s[r] / size : 1;
            if (z != 0)
                for (int j = 0; j < u; j++)
                    equations[(size_t)j * (size_t)conic->width + (size_t)conic->next] +=
                        z * form->a[(size_t)(i + r) * (size_t)u + (size_t)j];
        }
    }
}

static CpsStatus build_cone(const CpsiConicForm *form, const double *s, double tolerance,
                            double same, CpsSet **out, CpsError *err) {
    const int n = form->n, u = form->unknowns;
    CpsiConicRows *conic = NULL;
    CpsiConicForm *reduced = NULL;
    CpsiCount count = {.unknowns = (size_t)(n + form->rows),
                       .equations = (size_t)(u + form->lines),
                       .rows = (size_t)form->rows,
                       .cones = (size_t)form->cones};
    CpsStatus status = cpsi_conic_rows_new(count, n, &conic, err);
    if (status) return status;
    /* P'w + A'z = 0, divided by the unit of length in P */
    double *equations = conic->equation;
    for (int j = 0; j < u; j++) {
        double *row = cpsi_conic_rows_equation(conic);
        for (int i = 0; i < n; i++)
            row[i] = form->p[(size_t)i * (size_t)u + (size_t)j] / form->size;
    }
    for (int l = 0; l < form->lines; l++)
        memcpy(cpsi_conic_rows_equation(conic), &form->q[l * n], (size_t)n * sizeof *form->q);
    CPSI_FOR_CONES(k, i, form->cones, form->dim)
        write_touch(conic, form, &s[i], i, form->dim[k], touch_of(&s[i], form->dim[k], tolerance),
                    equations);
    /* unknowns that were not used remain 0 */
    CpsiConicRows *whole = NULL;
    count = (CpsiCount){.unknowns = (size_t)conic->next,
                        .equations = (size_t)conic->equations,
                        .rows = (size_t)conic->rows,
                        .cones = (size_t)conic->cones};
    status = cpsi_conic_rows_new(count, conic->next, &whole, err);
    double *map = status ? NULL : calloc((size_t)n * (size_t)whole->width, sizeof *map);
    if (!status && !map) status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a normal cone");
    if (!status) {
        for (int i = 0; i < conic->equations; i++) {
            double *row = cpsi_conic_rows_equation(whole);
            memcpy(row, &conic->equation[(size_t)i * (size_t)conic->width],
                   (size_t)conic->next * sizeof *row);
            if (cpsi_norm(conic->next, row) <= 0.01 * same) {
                whole->equations--;
                memset(row, 0, (size_t)conic->next * sizeof *row);
            }
        }
        for (int k = 0, i = 0; k < conic->cones; k++) {
            double *rows = cpsi_conic_rows_cone(whole, conic->dim[k]);
            for (int r = 0; r < conic->dim[k]; r++, i++, rows += whole->width)
                memcpy(rows, &conic->row[(size_t)i * (size_t)conic->width],
                       (size_t)conic->next * sizeof *rows);
        }
        for (int i = 0; i < n; i++) map[(size_t)i * (size_t)whole->width + (size_t)i] = 1;
        status = cpsi_conic_form_reduce(whole, n, map, 0, NULL, same, &reduced, err);
    }
    free(map);
    cpsi_conic_rows_free(whole);
    cpsi_conic_rows_free(conic);
    return status ? status : as_rays(reduced, out, err);
}

static CpsStatus conic_cone(const CpsSet *set, const double *p, double tolerance, CpsSet **out,
                            CpsSetAnswer *answer, CpsError *err) {
    const CpsiConicForm *form;
    CpsiConicForm *made;
    CpsStatus status = cpsi_set_conic_form(set, &form, &made, err);
    if (status) return status;
    double *s = calloc((size_t)form->rows + 1, sizeof *s);
    if (!s)
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a normal cone");
    else
        status = fibre(form, p, s, &answer->outcome, err);
    if (!status && answer->outcome == CPS_SET_OUTCOME_ANSWERED)
        status = build_cone(form, s, tolerance, fmax(SAME_EQUATION, TURN * tolerance), out, err);
    free(s);
    cpsi_conic_form_free(made);
    return status;
}

static CpsStatus cone_at(const CpsSet *set, const double *p, double tolerance, CpsSet **out,
                         CpsSetAnswer *answer, CpsError *err);

static CpsStatus cone_of_product(const CpsSet *set, const double *p, double tolerance, CpsSet **out,
                                 CpsSetAnswer *answer, CpsError *err) {
    CpsSet **cone = calloc((size_t)set->count, sizeof(CpsSet *));
    if (!cone) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a normal cone");
    CpsStatus status = CPS_OK;
    for (int k = 0, at = 0;
         !status && answer->outcome == CPS_SET_OUTCOME_ANSWERED && k < set->count;
         at += set->part[k++]->n)
        status = cone_at(set->part[k], p + at, tolerance, &cone[k], answer, err);
    if (!status && answer->outcome == CPS_SET_OUTCOME_ANSWERED)
        status = cps_set_product(set->count, (const CpsSet *const *)cone, out, err);
    for (int k = 0; k < set->count; k++) cps_set_release(cone[k]);
    free(cone);
    return status;
}

static CpsStatus cone_of_moved(const CpsSet *set, const double *p, double tolerance, CpsSet **out,
                               CpsSetAnswer *answer, CpsError *err) {
    const int n = set->n;
    const bool shift = set->kind == CPSI_SET_TRANSLATE;
    double *y = malloc((size_t)n * sizeof *y);
    if (!y) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    for (int i = 0; i < n; i++) y[i] = shift ? p[i] - set->a[i] : p[i] / set->scalar;
    CpsSet *cone = NULL;
    CpsStatus status = cone_at(set->part[0], y, tolerance, &cone, answer, err);
    free(y);
    if (status || answer->outcome != CPS_SET_OUTCOME_ANSWERED) return status;
    if (shift || set->scalar > 0)
        *out = cone;
    else {
        status = cps_set_scale(-1, cone, out, err);
        cps_set_release(cone);
    }
    return status;
}

/* The rays of the facets that contain p, and the normals of the span in both directions. */
static CpsStatus cone_of_hull(const CpsSet *set, const double *p, double tolerance, CpsSet **out,
                              CpsError *err) {
    const CpsiHull *hull = set->hull;
    const size_t n = (size_t)set->n, lines = n - (size_t)hull->dimension;
    double *rays = malloc(((size_t)hull->rows + 2 * lines) * n * sizeof *rays);
    if (!rays) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a normal cone");
    const double near = tolerance * cpsi_set_size(set);
    size_t count = 0;
    for (int k = 0; k < hull->rows; k++) {
        const double *row = &hull->row[(size_t)k * n];
        if (hull->offset[k] - cpsi_dot(set->n, row, p) <= near)
            memcpy(&rays[count++ * n], row, n * sizeof *rays);
    }
    for (size_t l = 0; l < 2 * lines; l++, count++)
        for (size_t i = 0; i < n; i++)
            rays[count * n + i] = (l % 2 ? -1 : 1) * hull->normal[l / 2 * n + i];
    const CpsStatus status = cps_set_cone_of_rays(set->n, (int)count, rays, out, err);
    free(rays);
    return status;
}

static CpsStatus cone_at(const CpsSet *set, const double *p, double tolerance, CpsSet **out,
                         CpsSetAnswer *answer, CpsError *err) {
    if (set->hull) return cone_of_hull(set, p, tolerance, out, err);
    switch (set->kind) {
    case CPSI_SET_PRODUCT: return cone_of_product(set, p, tolerance, out, answer, err);
    case CPSI_SET_TRANSLATE:
    case CPSI_SET_SCALE: return cone_of_moved(set, p, tolerance, out, answer, err);
    default: return conic_cone(set, p, tolerance, out, answer, err);
    }
}

CpsStatus cps_set_normal_cone(const CpsSet *set, const double *point, double tolerance,
                              CpsSet **cone, CpsSetAnswer *answer, CpsError *err) {
    if (!set || !point || !cone || !answer)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL",
                         !set     ? "set"
                         : !point ? "point"
                                  : "an answer");
    CpsStatus status = cpsi_set_finite("point", (size_t)set->n, point, err);
    if (status) return status;
    if (!(tolerance >= 0) || tolerance > 0.1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "tolerance is %g, expected a share from 0 to 0.1",
                         tolerance);
    const double share = tolerance > 0 ? tolerance : 1e-9;
    *cone = NULL;
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE, .tolerance = share};
    if (cpsi_set_has_user(set)) return CPS_OK;
    bool known;
    status = cpsi_smooth_sum_cone(set, point, share, &known, cone, answer, err);
    if (status || known) return status;

    /* Distance of the point from the set. A cone has no size, so its unit of length is the length
     * of the point, unless the caller has given a tolerance. */
    double *nearest = malloc(2 * (size_t)set->n * sizeof *nearest),
           *asked = nearest ? nearest + set->n : NULL;
    if (!nearest) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    const double far = tolerance == 0 && cpsi_set_is_cone(set) ? cpsi_norm(set->n, point) : 1,
                 unit = far > 0 ? far : 1;
    for (int i = 0; i < set->n; i++) asked[i] = point[i] / unit;
    CpsSet *found = NULL;
    status = cps_set_project(set, asked, NULL, nearest, answer, err);
    const double distance = answer->value, size = cpsi_set_size(set);
    answer->tolerance = share;
    if (!status && answer->outcome == CPS_SET_OUTCOME_ANSWERED &&
        distance > fmax(share, 1e-9) * size)
        answer->outcome = CPS_SET_OUTCOME_OUTSIDE;
    const double *at = distance > answer->gap ? nearest : asked;
    if (!status && answer->outcome == CPS_SET_OUTCOME_ANSWERED)
        status = cone_at(set, at, share, &found, answer, err);
    free(nearest);
    answer->value = distance * unit;
    answer->exact = false;
    answer->closure = set->closure;
    if (!status && answer->outcome == CPS_SET_OUTCOME_ANSWERED)
        *cone = found;
    else
        cps_set_release(found);
    return status;
}
