/* SPDX-License-Identifier: BSD-3-Clause */
/* Constructors of the primitive sets: arguments are checked, copied, and reduced to a few kinds. */
#include <math.h>
#include <string.h>

#include "linalg/dense.h"
#include "set/set.h"

/* Segments and triangles are written by their points, as sets of low dimension in larger spaces. */
enum { LEAST_POINTS = 4, MOST_COMPONENTS = 64 };

static CpsStatus check_space(int n, CpsSet **out, CpsError *err) {
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL, expected a place for the set");
    if (n < 1 || n > CPS_SET_MAX_SPACE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "n is %d, expected 1 to %d", n, CPS_SET_MAX_SPACE);
    return CPS_OK;
}

/* n, count and an array of count x n finite numbers (rows may be NULL when there are none) */
static CpsStatus check_rows(const char *name, int n, int count, int least, const double *rows,
                            CpsSet **out, CpsError *err) {
    CpsStatus status = check_space(n, out, err);
    if (status) return status;
    if (count < least || count > CPS_SET_MAX_ITEMS ||
        (size_t)count > ((size_t)32 << 20) / (size_t)n)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "count is %d, expected %d to %d and count x n at most 2^25", count, least,
                         CPS_SET_MAX_ITEMS);
    if (!rows && count > 0) return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL", name);
    return rows ? cpsi_set_finite(name, (size_t)count * (size_t)n, rows, err) : CPS_OK;
}

CpsStatus cps_set_hull_of_points(int n, int count, const double *points, CpsSet **out,
                                 CpsError *err) {
    CpsStatus status = check_rows("points", n, count, 1, points, out, err);
    if (status) return status;
    const size_t size = (size_t)n * (size_t)count;
    status = cpsi_set_new(CPSI_SET_POINTS, n, count, NULL, size, out, err);
    if (status) return status;
    memcpy((*out)->a, points, size * sizeof *points);
    if (count < LEAST_POINTS || n > MOST_COMPONENTS) return CPS_OK;
    bool known;
    (*out)->hull = cpsi_hull_new(n, count, points, &known);
    if ((*out)->hull || !known) return CPS_OK;
    cps_set_release(*out);
    *out = NULL;
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the hull of points");
}

CpsStatus cps_set_point(int n, const double *point, CpsSet **out, CpsError *err) {
    const CpsStatus status = check_rows("point", n, 1, 1, point, out, err);
    return status ? status : cps_set_hull_of_points(n, 1, point, out, err);
}

CpsStatus cps_set_segment(int n, const double *from, const double *to, CpsSet **out,
                          CpsError *err) {
    CpsStatus status = check_rows("from", n, 1, 1, from, out, err);
    if (!status) status = check_rows("to", n, 1, 1, to, out, err);
    if (!status) status = cpsi_set_new(CPSI_SET_POINTS, n, 2, NULL, 2 * (size_t)n, out, err);
    if (status) return status;
    memcpy((*out)->a, from, (size_t)n * sizeof *from);
    memcpy((*out)->a + n, to, (size_t)n * sizeof *to);
    return CPS_OK;
}

CpsStatus cps_set_ball(int n, const double *centre, double radius, CpsSet **out, CpsError *err) {
    CpsStatus status = check_rows("centre", n, centre ? 1 : 0, 0, centre, out, err);
    if (status) return status;
    if (!(radius >= 0) || !isfinite(radius))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "radius is %g, expected a finite number >= 0",
                         radius);
    /* a ball without radius is a point */
    status =
        cpsi_set_new(radius > 0 ? CPSI_SET_BALL : CPSI_SET_POINTS, n, 1, NULL, (size_t)n, out, err);
    if (status) return status;
    if (centre) memcpy((*out)->a, centre, (size_t)n * sizeof *centre);
    (*out)->scalar = radius;
    return CPS_OK;
}

CpsStatus cps_set_ellipsoid(int n, const double *centre, const double *shape, CpsSet **out,
                            CpsError *err) {
    CpsStatus status = check_rows("centre", n, centre ? 1 : 0, 0, centre, out, err);
    if (!status) status = check_rows("shape", n, n, 1, shape, out, err);
    if (status) return status;
    const size_t w = (size_t)n;
    double most = 0;
    for (size_t i = 0; i < w * w; i++) most = fmax(most, fabs(shape[i]));
    for (size_t i = 0; i < w; i++)
        for (size_t j = 0; j < i; j++)
            if (fabs(shape[i * w + j] - shape[j * w + i]) > 1e-12 * most)
                return cpsi_fail(err, CPS_ERR_ARGUMENT,
                                 "shape is not symmetric: entries %zu, %zu are %.17g and %.17g", i,
                                 j, shape[i * w + j], shape[j * w + i]);
    CpsSet *set = NULL;
    status = cpsi_set_new(CPSI_SET_ELLIPSOID, n, 1, NULL, w + 3 * w * w, &set, err);
    if (status) return status;
    set->b = set->a + w;
    set->c = set->b + w * w;
    double *lower = set->c + w * w; /* scratch after the arrays that are kept */
    if (centre) memcpy(set->a, centre, w * sizeof *centre);
    memcpy(set->b, shape, w * w * sizeof *shape);
    if (!cpsi_cholesky(n, shape, lower)) {
        cps_set_release(set);
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "shape is not positive definite; for a flat ellipsoid take the image of a ball");
    }
    cpsi_lower_inverse(n, lower, set->c);
    *out = set;
    return CPS_OK;
}

CpsStatus cps_set_box(int n, const double *low, const double *high, CpsSet **out, CpsError *err) {
    CpsStatus status = check_space(n, out, err);
    if (status) return status;
    if (!low || !high) return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL", low ? "high" : "low");
    for (int i = 0; i < n; i++)
        if (!(low[i] <= high[i]) || low[i] == INFINITY || high[i] == -INFINITY)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "component %d runs from %g to %g, expected low <= high", i, low[i],
                             high[i]);
    status = cpsi_set_new(CPSI_SET_BOX, n, 1, NULL, 2 * (size_t)n, out, err);
    if (status) return status;
    (*out)->b = (*out)->a + n;
    memcpy((*out)->a, low, (size_t)n * sizeof *low);
    memcpy((*out)->b, high, (size_t)n * sizeof *high);
    return CPS_OK;
}

CpsStatus cps_set_interval(double low, double high, CpsSet **out, CpsError *err) {
    return cps_set_box(1, &low, &high, out, err);
}

/* a row of zeros would be no condition; it is reported as an error */
static CpsStatus check_normals(int n, int count, const double *rows, CpsError *err) {
    for (int k = 0; k < count; k++)
        if (cpsi_norm(n, &rows[(size_t)k * (size_t)n]) == 0)
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "row %d is 0, expected a normal", k);
    return CPS_OK;
}

CpsStatus cps_set_inequalities(int n, int count, const double *rows, const double *offsets,
                               CpsSet **out, CpsError *err) {
    CpsStatus status = check_rows("rows", n, count, 0, rows, out, err);
    if (!status && !offsets && count > 0)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT, "offsets is NULL");
    if (!status && count > 0) status = cpsi_set_finite("offsets", (size_t)count, offsets, err);
    if (!status) status = check_normals(n, count, rows, err);
    const size_t size = (size_t)n * (size_t)count;
    if (!status)
        status =
            cpsi_set_new(CPSI_SET_INEQUALITIES, n, count, NULL, size + (size_t)count, out, err);
    if (status) return status;
    (*out)->b = (*out)->a + size;
    if (count > 0) {
        memcpy((*out)->a, rows, size * sizeof *rows);
        memcpy((*out)->b, offsets, (size_t)count * sizeof *offsets);
    }
    return CPS_OK;
}

CpsStatus cps_set_half_space(int n, const double *normal, double offset, CpsSet **out,
                             CpsError *err) {
    const CpsStatus status = check_rows("normal", n, 1, 1, normal, out, err);
    return status ? status : cps_set_inequalities(n, 1, normal, &offset, out, err);
}

CpsStatus cps_set_strip(int n, const double *normal, double low, double high, CpsSet **out,
                        CpsError *err) {
    CpsStatus status = check_rows("normal", n, 1, 1, normal, out, err);
    if (!status) status = check_normals(n, 1, normal, err);
    if (status) return status;
    if (!(low <= high) || !isfinite(low) || !isfinite(high))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "from %g to %g, expected finite low <= high (a half space has one bound)",
                         low, high);
    const size_t w = (size_t)n;
    status = cpsi_set_new(CPSI_SET_INEQUALITIES, n, 2, NULL, 2 * w + 2, out, err);
    if (status) return status;
    CpsSet *set = *out;
    set->b = set->a + 2 * w;
    for (size_t i = 0; i < w; i++) {
        set->a[i] = normal[i];
        set->a[w + i] = -normal[i];
    }
    set->b[0] = high;
    set->b[1] = -low;
    return CPS_OK;
}

CpsStatus cps_set_subspace(int n, int count, const double *spanning, CpsSet **out, CpsError *err) {
    CpsStatus status = check_rows("spanning", n, count, 0, spanning, out, err);
    if (status) return status;
    const size_t w = (size_t)n, rows = count > n ? (size_t)count : w;
    status = cpsi_set_new(CPSI_SET_SUBSPACE, n, 0, NULL, rows * w, out, err);
    if (status) return status;
    CpsSet *set = *out;
    if (count > 0) memcpy(set->a, spanning, (size_t)count * w * sizeof *spanning);
    set->count = cpsi_orthonormal_rows(count, n, set->a, NULL, 1e-12);
    cpsi_complete_rows(set->count, n, set->a);
    return CPS_OK;
}

CpsStatus cps_set_cone_of_rays(int n, int count, const double *rays, CpsSet **out, CpsError *err) {
    CpsStatus status = check_rows("rays", n, count, 0, rays, out, err);
    if (!status) status = check_normals(n, count, rays, err);
    const size_t size = (size_t)n * (size_t)count;
    if (!status) status = cpsi_set_new(CPSI_SET_RAYS, n, count, NULL, size, out, err);
    if (!status && count > 0) memcpy((*out)->a, rays, size * sizeof *rays);
    return status;
}

CpsStatus cps_set_user(int n, CpsSetSupport *support, void *user, CpsSet **out, CpsError *err) {
    CpsStatus status = check_space(n, out, err);
    if (status) return status;
    if (!support) return cpsi_fail(err, CPS_ERR_ARGUMENT, "support is NULL, expected a function");
    status = cpsi_set_new(CPSI_SET_USER, n, 0, NULL, 0, out, err);
    if (status) return status;
    (*out)->support = support;
    (*out)->user = user;
    return CPS_OK;
}
