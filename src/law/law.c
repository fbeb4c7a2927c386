/* SPDX-License-Identifier: BSD-3-Clause */
/* Friction laws: a set that contains 0, and the constructions of M77 sections 7, 8 and 10 that
 * preserve this.
 *
 * Only cps_law_friction has to check for 0: products, preimages and sums of images of sets that
 * contain 0 contain it. */
#include "law/law.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"

/* Relative tolerance for the side of a boundary on which a point lies (composition rule). */
static const double BOUNDARY_TOLERANCE = 1e-9;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
}

CpsStatus cpsi_law_check_vector(const char *what, int n, const double *a, CpsError *err) {
    if (!a) return cpsi_fail(err, CPS_ERR_ARGUMENT, "the %s is NULL", what);
    for (int i = 0; i < n; i++)
        if (!isfinite(a[i]))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "component %d of the %s is %g, expected a finite number", i + 1, what,
                             a[i]);
    return CPS_OK;
}

/* A law for a set, whose reference it takes over in every case. factors NULL: the set itself is the
 * one factor. */
static CpsStatus make_law(CpsSet *set, int factor_count, CpsSet *const *factor, CpsLaw **out,
                          CpsError *err) {
    const int count = factor ? factor_count : 1;
    CpsLaw *law = malloc(sizeof *law + (size_t)count * sizeof law->factor[0]);
    if (!law) {
        cps_set_release(set);
        return out_of_memory(err);
    }
    atomic_init(&law->refcount, 1);
    law->set = set;
    law->factor_count = count;
    for (int i = 0; i < count; i++) law->factor[i] = cps_set_retain(factor ? factor[i] : set);
    *out = law;
    return CPS_OK;
}

CpsLaw *cps_law_retain(const CpsLaw *law) {
    CpsLaw *held = (CpsLaw *)(uintptr_t)law; /* a law is constant except for its reference count */
    if (held) atomic_fetch_add(&held->refcount, 1);
    return held;
}

void cps_law_release(CpsLaw *law) {
    if (!law || atomic_fetch_sub(&law->refcount, 1) > 1) return;
    for (int i = 0; i < law->factor_count; i++) cps_set_release(law->factor[i]);
    cps_set_release(law->set);
    free(law);
}

int cps_law_space(const CpsLaw *law) { return law ? cps_set_space(law->set) : 0; }

const CpsSet *cps_law_set(const CpsLaw *law) { return law ? law->set : NULL; }

/* ---- sets as laws ---- */

CpsStatus cps_law_friction(const CpsSet *set, CpsLaw **out, CpsError *err) {
    if (!set || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "set or out is NULL");
    CpsSetFacts facts;
    const CpsStatus status = cps_set_facts(set, 0, &facts, NULL, NULL, err);
    if (status != CPS_OK) return status;
    if (facts.outcome == CPS_SET_OUTCOME_EMPTY)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the set of forces is empty: no force goes with any velocity; a friction "
                         "law contains 0");

    /* of a user's set only the support is known, so its statement that it contains 0 is accepted */
    const bool known = facts.outcome == CPS_SET_OUTCOME_ANSWERED;
    if (!known && facts.outcome != CPS_SET_OUTCOME_NOT_AVAILABLE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "cannot tell whether the set of forces contains 0: %s",
                         cps_set_outcome_text(facts.outcome));
    if (known && !facts.has_zero)
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "the set of forces does not contain 0, so the law could give power to the motion: a "
            "friction law contains 0; a constant load is added to one as a load");
    return make_law(cps_set_retain(set), 0, NULL, out, err);
}

CpsStatus cps_law_coulomb(double friction, double load, CpsLaw **out, CpsError *err) {
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL");
    if (!(friction >= 0) || !isfinite(friction))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the friction coefficient is %g, expected at least 0", friction);
    if (!(load >= 0) || !isfinite(load))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the normal load is %g N, expected at least 0 (pressing)", load);
    CpsSet *disc = NULL;
    const CpsStatus status = cps_set_ball(2, NULL, friction * load, &disc, err);
    return status == CPS_OK ? make_law(disc, 0, NULL, out, err) : status;
}

CpsStatus cps_law_unit_load(const CpsSet *unit, double load, CpsLaw **out, CpsError *err) {
    if (!unit || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "unit or out is NULL");
    if (!(load >= 0) || !isfinite(load))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the normal load is %g N, expected at least 0 (pressing)", load);
    CpsLaw *law = NULL;
    CpsSet *set = NULL;
    CpsStatus status = cps_law_friction(unit, &law, err);
    if (status == CPS_OK) status = cps_set_scale(load, unit, &set, err);
    cps_law_release(law);
    return status == CPS_OK ? make_law(set, 0, NULL, out, err) : status;
}

/* ---- products and sums ---- */

static CpsStatus check_laws(int count, const CpsLaw *const *law, const void *out, CpsError *err) {
    if (!law || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "laws or out is NULL");
    if (count < 1 || count > CPS_SET_MAX_ITEMS)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%d laws given, expected from 1 to %d", count,
                         CPS_SET_MAX_ITEMS);
    for (int i = 0; i < count; i++)
        if (!law[i]) return cpsi_fail(err, CPS_ERR_ARGUMENT, "law %d is NULL", i + 1);
    return CPS_OK;
}

CpsStatus cps_law_product(int count, const CpsLaw *const *parts, CpsLaw **out, CpsError *err) {
    CpsStatus status = check_laws(count, parts, out, err);
    if (status != CPS_OK) return status;

    /* a product of products is one product of all their factors */
    size_t factor_count = 0;
    for (int i = 0; i < count; i++) factor_count += (size_t)parts[i]->factor_count;
    if (factor_count > CPS_SET_MAX_ITEMS)
        return cpsi_fail(err, CPS_ERR_LIMIT, "%zu factors in a product, at most %d", factor_count,
                         CPS_SET_MAX_ITEMS);
    CpsSet **factor = malloc(factor_count * sizeof *factor), *set = NULL;
    if (!factor) return out_of_memory(err);
    size_t n = 0;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < parts[i]->factor_count; k++) factor[n++] = parts[i]->factor[k];
    status = cps_set_product((int)factor_count, (const CpsSet *const *)factor, &set, err);
    if (status == CPS_OK) status = make_law(set, (int)factor_count, factor, out, err);
    free(factor);
    return status;
}

/* B* C for a map B of velocities (rows x n) */
static CpsStatus image_of_contact(int n, const double *map, const CpsSet *set, CpsSet **out,
                                  CpsError *err) {
    const size_t rows = (size_t)cps_set_space(set), columns = (size_t)n;
    double *transpose = malloc(rows * columns * sizeof *transpose);
    if (!transpose) return out_of_memory(err);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++) transpose[j * rows + i] = map[i * columns + j];
    const CpsStatus status = cps_set_image(n, transpose, set, out, err);
    free(transpose);
    return status;
}

CpsStatus cps_law_contacts(int n, int count, const CpsLaw *const *contact, const double *const *map,
                           CpsLaw **out, CpsError *err) {
    CpsStatus status = check_laws(count, contact, out, err);
    if (status != CPS_OK) return status;
    if (!map || n < 1 || n > CPS_SET_MAX_SPACE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the maps are NULL, or n = %d is not from 1 to %d",
                         n, CPS_SET_MAX_SPACE);
    for (int i = 0; i < count; i++) {
        const int rows = cps_law_space(contact[i]);
        const bool finite = map[i] && cpsi_all_finite(rows * n, map[i]);
        if (!finite)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "map %d is NULL or holds a number that is not finite", i + 1);
    }

    CpsSet **image = calloc((unsigned)count, sizeof *image), *sum = NULL;
    if (!image) return out_of_memory(err);
    for (int i = 0; i < count && status == CPS_OK; i++)
        status = image_of_contact(n, map[i], contact[i]->set, &image[i], err);
    if (status == CPS_OK) status = cps_set_sum(count, (const CpsSet *const *)image, &sum, err);
    for (int i = 0; i < count; i++) cps_set_release(image[i]);
    free(image);
    return status == CPS_OK ? make_law(sum, 0, NULL, out, err) : status;
}

/* ---- the composition rule ---- */

const char *cps_composition_name(CpsComposition composition) {
    static const char *const NAME[] = {"interior", "relative interior", "polyhedral parts",
                                       "not satisfied"};
    return (unsigned)composition < 4 ? NAME[composition] : "?";
}

const char *cps_composition_text(CpsComposition composition) {
    static const char *const SENTENCE[] = {
        "the forces that the map admits meet the interior of the parts' set: the reduced law is "
        "exact",
        "the forces that the map admits meet the relative interior of the parts' set: the reduced "
        "law is exact",
        "the forces that the map admits meet some factors only on the boundary, and those are "
        "polyhedral: the reduced law is exact",
        "the forces that the map admits meet a curved part only on its boundary: the reduced law "
        "may admit velocities that no motion of the parts has"};
    return (unsigned)composition < 4 ? SENTENCE[composition] : "?";
}

/* The position of the point in one factor: interior, relative interior, or boundary. It follows
 * from the dimension of the normal cone, which on the relative interior, and only there, equals
 * that of the complement of the affine hull. */
static CpsStatus place_in_factor(const CpsSet *factor, const double *point, CpsComposition *place,
                                 CpsError *err) {
    CpsSetFacts facts, cone_facts;
    CpsSetAnswer answer;
    CpsSet *cone = NULL;
    *place = CPS_COMPOSITION_NOT_SATISFIED;
    CpsStatus status = cps_set_facts(factor, 0, &facts, NULL, NULL, err);
    if (status == CPS_OK && facts.outcome == CPS_SET_OUTCOME_ANSWERED)
        status = cps_set_normal_cone(factor, point, BOUNDARY_TOLERANCE, &cone, &answer, err);
    if (status == CPS_OK && cone) status = cps_set_facts(cone, 0, &cone_facts, NULL, NULL, err);
    if (status == CPS_OK && cone && cone_facts.outcome == CPS_SET_OUTCOME_ANSWERED) {
        if (cone_facts.dimension == 0)
            *place = CPS_COMPOSITION_INTERIOR;
        else if (cone_facts.dimension == cps_set_space(factor) - facts.dimension)
            *place = CPS_COMPOSITION_RELATIVE_INTERIOR;
        else if (cpsi_law_polyhedral(factor))
            *place = CPS_COMPOSITION_POLYHEDRAL;
    }
    cps_set_release(cone);
    return status;
}

/* The worst position in the factors of L x, for x in the relative interior of L^-1(C): if any force
 * of range(L) lies in the relative interiors of the factors that require it, so does this one
 * (Rockafellar 6.1 and 6.7). */
static CpsStatus find_composition(int n, const double *map, const CpsLaw *law,
                                  const CpsSet *reduced, CpsComposition *composition,
                                  CpsError *err) {
    const int rows = cps_law_space(law);
    double *centre = malloc(((size_t)n + (size_t)rows) * sizeof *centre);
    if (!centre) return out_of_memory(err);
    double *force = centre + n;
    CpsSetFacts facts;
    CpsStatus status = cps_set_facts(reduced, 0, &facts, centre, NULL, err);
    *composition = CPS_COMPOSITION_INTERIOR;
    if (status == CPS_OK && facts.outcome != CPS_SET_OUTCOME_ANSWERED)
        *composition = CPS_COMPOSITION_NOT_SATISFIED;
    if (status == CPS_OK && facts.outcome == CPS_SET_OUTCOME_ANSWERED) {
        for (int i = 0; i < rows; i++) force[i] = cpsi_dot(n, map + (size_t)i * (size_t)n, centre);
        for (int i = 0, at = 0; i < law->factor_count && status == CPS_OK; i++) {
            CpsComposition place;
            status = place_in_factor(law->factor[i], force + at, &place, err);
            if (place > *composition) *composition = place;
            at += cps_set_space(law->factor[i]);
        }
    }
    free(centre);
    return status;
}

CpsStatus cps_law_preimage(int n, const double *map, const CpsLaw *law, CpsComposition *composition,
                           CpsLaw **out, CpsError *err) {
    if (!map || !law || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "map, law or out is NULL");
    CpsSet *reduced = NULL;
    CpsStatus status = cps_set_preimage(n, map, NULL, law->set, &reduced, err);
    CpsComposition found = CPS_COMPOSITION_NOT_SATISFIED;
    if (status == CPS_OK && composition)
        status = find_composition(n, map, law, reduced, &found, err);
    if (status != CPS_OK) {
        cps_set_release(reduced);
        return status;
    }
    status = make_law(reduced, 0, NULL, out, err);
    if (status == CPS_OK && composition) *composition = found;
    return status;
}

/* ---- loaded laws ---- */

struct CpsLoadedLaw {
    atomic_int refcount;
    CpsSet *set;
    double load[];
};

CpsStatus cps_law_load(const CpsLaw *law, const double *load, CpsLoadedLaw **out, CpsError *err) {
    if (!law || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "law or out is NULL");
    const int n = cps_law_space(law);
    CpsStatus status = cpsi_law_check_vector("load", n, load, err);
    if (status != CPS_OK) return status;
    CpsLoadedLaw *loaded = malloc(sizeof *loaded + (size_t)n * sizeof loaded->load[0]);
    if (!loaded) return out_of_memory(err);
    status = cps_set_translate(load, law->set, &loaded->set, err);
    if (status != CPS_OK) {
        free(loaded);
        return status;
    }
    atomic_init(&loaded->refcount, 1);
    memcpy(loaded->load, load, (size_t)n * sizeof *load);
    *out = loaded;
    return CPS_OK;
}

CpsLoadedLaw *cps_loaded_law_retain(const CpsLoadedLaw *law) {
    /* constant except for its reference count */
    CpsLoadedLaw *held = (CpsLoadedLaw *)(uintptr_t)law;
    if (held) atomic_fetch_add(&held->refcount, 1);
    return held;
}

void cps_loaded_law_release(CpsLoadedLaw *law) {
    if (!law || atomic_fetch_sub(&law->refcount, 1) > 1) return;
    cps_set_release(law->set);
    free(law);
}

int cps_loaded_law_space(const CpsLoadedLaw *law) { return law ? cps_set_space(law->set) : 0; }

const CpsSet *cps_loaded_law_set(const CpsLoadedLaw *law) { return law ? law->set : NULL; }

const double *cps_loaded_law_load(const CpsLoadedLaw *law) { return law ? law->load : NULL; }
