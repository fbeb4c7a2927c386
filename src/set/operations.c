/* SPDX-License-Identifier: BSD-3-Clause */
/* Constructors of the operations. They check dimensions and retain the parts. Where every query
 * will need the conic form (intersection, preimage and polar have no closed support function in
 * general) they compute it at once. */
#include <math.h>
#include <string.h>

#include "set/set.h"

/* Check that the parts exist, that their number is allowed, and that all have the same dimension
 * unless the operation is a product. */
static CpsStatus check_parts(bool product, int count, const CpsSet *const *parts, int *n,
                             CpsSet **out, CpsError *err) {
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL, expected a place for the set");
    if (count < 1 || count > CPS_SET_MAX_ITEMS || !parts)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%d parts, expected 1 to %d", count,
                         CPS_SET_MAX_ITEMS);
    *n = 0;
    for (int k = 0; k < count; k++) {
        if (!parts[k])
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "part %d is NULL, expected a set", k);
        if (!product && parts[k]->n != parts[0]->n)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "part %d lies in R^%d and part 0 in R^%d, expected one space", k,
                             parts[k]->n, parts[0]->n);
        *n = product ? *n + parts[k]->n : parts[k]->n;
        if (*n > CPS_SET_MAX_SPACE)
            return cpsi_fail(err, CPS_ERR_LIMIT, "the product has more than %d components",
                             CPS_SET_MAX_SPACE);
    }
    return CPS_OK;
}

/* Compute the form of the node, or free the node on failure. Nodes with users' sets have no
 * form. */
static CpsStatus finish(CpsSet *set, CpsSet **out, CpsError *err) {
    CpsStatus status = CPS_OK;
    if (!cpsi_set_has_user(set)) {
        if (set->kind == CPSI_SET_POLAR)
            status = cpsi_conic_form_make(set->part[0], 1, &set->dual, err);
        if (!status) status = cpsi_conic_form_make(set, 1, &set->form, err);
        if (!status) status = cpsi_conic_form_reduce_to_face(&set->form, &set->touching, err);
    }
    if (status)
        cps_set_release(set);
    else
        *out = set;
    return status;
}

/* ---- closedness ---- */

bool cpsi_set_known_bounded(const CpsSet *set) {
    int bounded = 0;
    switch (set->kind) {
    case CPSI_SET_POINTS:
    case CPSI_SET_BALL:
    case CPSI_SET_ELLIPSOID:
    case CPSI_SET_USER: return true;
    case CPSI_SET_BOX:
        for (int i = 0; i < set->n; i++) bounded += isfinite(set->a[i]) && isfinite(set->b[i]);
        return bounded == set->n;
    case CPSI_SET_CONIC: return set->bounded;
    case CPSI_SET_INEQUALITIES:
    case CPSI_SET_PREIMAGE:
    case CPSI_SET_POLAR: return false;
    case CPSI_SET_SUBSPACE:
    case CPSI_SET_RAYS: return set->count == 0;
    default: break;
    }
    for (int k = 0; k < set->count; k++) bounded += cpsi_set_known_bounded(set->part[k]);
    return set->kind == CPSI_SET_INTERSECTION ? bounded > 0 : bounded == set->count;
}

/* Whether the set is known to be a polyhedron from its expression. */
static bool known_polyhedral(const CpsSet *set) {
    switch (set->kind) {
    case CPSI_SET_POINTS:
    case CPSI_SET_BOX:
    case CPSI_SET_INEQUALITIES:
    case CPSI_SET_SUBSPACE:
    case CPSI_SET_RAYS: return true;
    case CPSI_SET_BALL:
    case CPSI_SET_ELLIPSOID: return set->n == 1;
    case CPSI_SET_USER: return false;
    case CPSI_SET_CONIC: return set->form->largest_cone <= 1;
    default: break;
    }
    for (int k = 0; k < set->count; k++)
        if (!known_polyhedral(set->part[k])) return false;
    return true;
}

/* Whether the expression may describe a set that is not closed. A sum is closed when all parts but
 * one are bounded, or when the unbounded ones are polyhedra (Rockafellar 1970, theorem 19.3 and
 * corollary 9.1.2); an image of a bounded set or a polyhedron is closed; the hull of bounded sets
 * is closed (theorem 17.2). */
static bool need_not_be_closed(const CpsSet *set) {
    int unbounded = 0, curved = 0;
    for (int k = 0; k < set->count; k++) {
        if (cpsi_set_known_bounded(set->part[k])) continue;
        unbounded++;
        curved += !known_polyhedral(set->part[k]);
    }
    if (set->kind == CPSI_SET_HULL) return unbounded > 0 && set->count > 1;
    return curved > 0 && (set->kind == CPSI_SET_IMAGE || unbounded > 1);
}

CpsStatus cps_set_product(int count, const CpsSet *const *parts, CpsSet **out, CpsError *err) {
    int n;
    const CpsStatus status = check_parts(true, count, parts, &n, out, err);
    return status ? status : cpsi_set_new(CPSI_SET_PRODUCT, n, count, parts, 0, out, err);
}

CpsStatus cps_set_intersection(int count, const CpsSet *const *parts, CpsSet **out, CpsError *err) {
    int n;
    CpsSet *set = NULL;
    CpsStatus status = check_parts(false, count, parts, &n, out, err);
    if (!status) status = cpsi_set_new(CPSI_SET_INTERSECTION, n, count, parts, 0, &set, err);
    return status ? status : finish(set, out, err);
}

CpsStatus cps_set_sum(int count, const CpsSet *const *parts, CpsSet **out, CpsError *err) {
    int n;
    CpsStatus status = check_parts(false, count, parts, &n, out, err);
    if (!status) status = cpsi_set_new(CPSI_SET_SUM, n, count, parts, 0, out, err);
    if (!status) (*out)->closure = (*out)->closure || need_not_be_closed(*out);
    return status;
}

CpsStatus cps_set_hull(int count, const CpsSet *const *parts, CpsSet **out, CpsError *err) {
    int n;
    CpsStatus status = check_parts(false, count, parts, &n, out, err);
    if (!status) status = cpsi_set_new(CPSI_SET_HULL, n, count, parts, 0, out, err);
    if (!status) (*out)->closure = (*out)->closure || need_not_be_closed(*out);
    return status;
}

/* Check one part and an array of `count` finite numbers. */
static CpsStatus check_one(const char *name, const CpsSet *set, size_t count, const double *numbers,
                           CpsSet **out, CpsError *err) {
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL, expected a place for the set");
    if (!set) return cpsi_fail(err, CPS_ERR_ARGUMENT, "set is NULL, expected a set");
    if (!numbers) return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL", name);
    return cpsi_set_finite(name, count, numbers, err);
}

static CpsStatus check_map(int rows, const double *map, const CpsSet *set, CpsSet **out,
                           CpsError *err) {
    if (rows < 1 || rows > CPS_SET_MAX_SPACE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the space's dimension is %d, expected 1 to %d",
                         rows, CPS_SET_MAX_SPACE);
    return check_one("map", set, set ? (size_t)rows * (size_t)set->n : 0, map, out, err);
}

CpsStatus cps_set_preimage(int n, const double *map, const double *shift, const CpsSet *part,
                           CpsSet **out, CpsError *err) {
    CpsStatus status = check_map(n, map, part, out, err);
    if (!status && shift) status = cpsi_set_finite("shift", (size_t)part->n, shift, err);
    if (status) return status;
    const size_t size = (size_t)n * (size_t)part->n;
    CpsSet *set = NULL;
    status = cpsi_set_new(CPSI_SET_PREIMAGE, n, 1, &part, size + (size_t)part->n, &set, err);
    if (status) return status;
    set->b = set->a + size;
    memcpy(set->a, map, size * sizeof *map);
    if (shift) memcpy(set->b, shift, (size_t)part->n * sizeof *shift);
    return finish(set, out, err);
}

CpsStatus cps_set_image(int m, const double *map, const CpsSet *part, CpsSet **out, CpsError *err) {
    CpsStatus status = check_map(m, map, part, out, err);
    if (status) return status;
    const size_t size = (size_t)m * (size_t)part->n;
    status = cpsi_set_new(CPSI_SET_IMAGE, m, 1, &part, size, out, err);
    if (!status) memcpy((*out)->a, map, size * sizeof *map);
    if (!status) (*out)->closure = (*out)->closure || need_not_be_closed(*out);
    return status;
}

CpsStatus cps_set_translate(const double *shift, const CpsSet *part, CpsSet **out, CpsError *err) {
    CpsStatus status = check_one("shift", part, part ? (size_t)part->n : 0, shift, out, err);
    if (!status)
        status = cpsi_set_new(CPSI_SET_TRANSLATE, part->n, 1, &part, (size_t)part->n, out, err);
    if (!status) memcpy((*out)->a, shift, (size_t)part->n * sizeof *shift);
    return status;
}

CpsStatus cps_set_scale(double factor, const CpsSet *part, CpsSet **out, CpsError *err) {
    CpsStatus status = check_one("factor", part, 1, &factor, out, err);
    if (status) return status;
    if (factor == 0) { /* a point, whatever the set */
        status = cpsi_set_new(CPSI_SET_POINTS, part->n, 1, NULL, (size_t)part->n, out, err);
        return status;
    }
    status = cpsi_set_new(CPSI_SET_SCALE, part->n, 1, &part, 0, out, err);
    if (!status) (*out)->scalar = factor;
    return status;
}

CpsStatus cps_set_polar(const CpsSet *part, CpsSet **out, CpsError *err) {
    const double none = 0;
    CpsSet *set = NULL;
    CpsStatus status = check_one("set", part, 1, &none, out, err);
    if (!status) status = cpsi_set_new(CPSI_SET_POLAR, part->n, 1, &part, 0, &set, err);
    return status ? status : finish(set, out, err);
}
