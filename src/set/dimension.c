/* SPDX-License-Identifier: BSD-3-Clause */
/* Dimension, boundedness and position of 0, from the support function alone.
 *
 * Directions D in which the set extends are collected one by one. For a unit vector w normal to D
 * and to the directions found flat, the points x+, x- are computed where <w, .> is largest and
 * smallest. Where the width h(w) + h(-w) exceeds the tolerance, x+ - x- is added to D, else w is
 * flat. The mean of all points found (a ray counts as a step along it) lies in the relative
 * interior, because the hull of the points has the set's dimension. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linalg/dense.h"
#include "set/set.h"

/* The search: rows 0 .. dimension - 1 of basis are D, followed by `flat` flat directions and then
 * by candidates. */
typedef struct Search {
    const CpsSet *set;
    double width; /* a smaller width counts as flat */
    int dimension, flat;
    double *basis; /* (n, n) */
    double *sum;   /* (n) sum of the points found */
    int points;
    double *plus, *minus, *turned; /* (n) */
    bool bounded, exact;
} Search;

/* Make v normal to D and add it as the next row of D. Returns false where nothing of it remains. */
static bool join_direction(Search *search, const double *v) {
    const size_t n = (size_t)search->set->n;
    double *basis = search->basis, *row = search->turned;
    memcpy(row, v, n * sizeof *row);
    const double before = cpsi_norm((int)n, row);
    /* normal to the flat directions too, along which there is only rounding */
    for (int twice = 0; twice < 2; twice++)
        for (int k = 0; k < search->dimension + search->flat; k++) {
            const double along = cpsi_dot((int)n, row, &basis[(size_t)k * n]);
            for (size_t i = 0; i < n; i++) row[i] -= along * basis[(size_t)k * n + i];
        }
    const double size = cpsi_norm((int)n, row);
    if (!(size > 1e-14 * before)) return false;
    memmove(&basis[(size_t)(search->dimension + 1) * n], &basis[(size_t)search->dimension * n],
            (size_t)search->flat * n * sizeof *row);
    for (size_t i = 0; i < n; i++) basis[(size_t)search->dimension * n + i] = row[i] / size;
    search->dimension++;
    return true;
}

/* One candidate direction. */
static CpsStatus probe(Search *search, CpsSetOutcome *outcome, CpsError *err) {
    const CpsSet *set = search->set;
    const size_t n = (size_t)set->n;
    const int known = search->dimension + search->flat;
    double *w = &search->basis[(size_t)known * n];
    CpsSetAnswer high, low;
    CpsStatus status = cpsi_support(set, w, search->plus, &high, err);
    for (size_t i = 0; i < n; i++) search->turned[i] = -w[i];
    if (!status) status = cpsi_support(set, search->turned, search->minus, &low, err);
    if (status) return status;
    const CpsSetAnswer *both[] = {&high, &low};
    for (int k = 0; k < 2; k++) {
        search->exact &= both[k]->exact;
        if (both[k]->outcome > CPS_SET_OUTCOME_NOT_ATTAINED ||
            both[k]->outcome == CPS_SET_OUTCOME_EMPTY) {
            *outcome = both[k]->outcome;
            return CPS_OK;
        }
    }
    const bool up = high.outcome == CPS_SET_OUTCOME_UNBOUNDED,
               down = low.outcome == CPS_SET_OUTCOME_UNBOUNDED;
    const bool flat = !up && !down && !(high.value + low.value > search->width);
    /* a ray counts as a step of a typical length */
    const double step = cpsi_set_size(set), plus = up ? step / cpsi_norm((int)n, search->plus) : 1,
                 minus = down ? step / cpsi_norm((int)n, search->minus) : 1;
    for (size_t i = 0; i < n; i++) {
        search->plus[i] *= plus;
        search->minus[i] *= minus;
        search->sum[i] += (up ? 0 : search->plus[i]) + (down ? 0 : search->minus[i]);
    }
    search->points += !up + !down;
    if (flat) {
        search->flat++;
        return CPS_OK;
    }
    if (up || down || high.outcome == CPS_SET_OUTCOME_NOT_ATTAINED ||
        low.outcome == CPS_SET_OUTCOME_NOT_ATTAINED)
        search->bounded = false;
    for (size_t i = 0; i < n; i++)
        search->plus[i] = up     ? search->plus[i]
                          : down ? search->minus[i]
                                 : search->plus[i] - search->minus[i];
    if (!join_direction(search, search->plus)) search->flat++;
    return CPS_OK;
}

/* A point of the set, used where every direction tried gave rays. */
static CpsStatus any_point(const CpsSet *set, double *point, CpsError *err) {
    CpsSetAnswer answer;
    memset(point, 0, (size_t)set->n * sizeof *point);
    CpsStatus status = cpsi_support(set, point, point, &answer, err);
    return status;
}

/* The centre: the mean of the points, moved along the rays of each unbounded direction. */
static CpsStatus search_all(Search *search, double *rays, CpsSetOutcome *outcome, CpsError *err) {
    const size_t n = (size_t)search->set->n;
    CpsStatus status = CPS_OK;
    while (!status && *outcome == CPS_SET_OUTCOME_ANSWERED &&
           search->dimension + search->flat < (int)n) {
        const int before = search->dimension;
        const bool bounded = search->bounded;
        search->bounded = true;
        cpsi_next_row(search->dimension + search->flat, (int)n, search->basis);
        status = probe(search, outcome, err);
        const bool ray = !search->bounded;
        search->bounded = bounded && !ray;
        if (!status && ray && search->dimension > before)
            for (size_t i = 0; i < n; i++) rays[i] += search->plus[i];
    }
    return status;
}

/* Whether some coordinate is unbounded; where that is not answered, facts have no answer. */
static CpsStatus check_bounded(const CpsSet *set, double *w, CpsSetFacts *facts, CpsError *err) {
    CpsStatus status = CPS_OK;
    memset(w, 0, (size_t)set->n * sizeof *w);
    for (int i = 0; !status && facts->bounded && i < set->n; i++) {
        CpsSetAnswer answer = {.outcome = CPS_SET_OUTCOME_ANSWERED};
        for (int sign = -1; !status && sign <= 1; sign += 2) {
            w[i] = sign;
            status = cpsi_support(set, w, NULL, &answer, err);
            if (answer.outcome == CPS_SET_OUTCOME_UNBOUNDED ||
                answer.outcome == CPS_SET_OUTCOME_NOT_ATTAINED)
                facts->bounded = false;
            else if (answer.outcome != CPS_SET_OUTCOME_ANSWERED)
                facts->outcome = answer.outcome;
        }
        w[i] = 0;
    }
    if (facts->outcome != CPS_SET_OUTCOME_ANSWERED) {
        facts->has_dimension = false;
        facts->dimension = 0;
    }
    return status;
}

/* The position of 0. It is in the relative interior when the set extends from it both ways along
 * every direction of its basis. */
static CpsStatus place_zero(const CpsSet *set, const double *centre, const double *basis,
                            double *zero, double *work, CpsSetFacts *facts, CpsError *err) {
    const size_t n = (size_t)set->n;
    const double near = 1e-9 * cpsi_set_size(set), far = cpsi_norm(set->n, centre);
    CpsSetAnswer answer;
    CpsiZero known;
    double margin;
    CpsStatus status = cpsi_set_locate_zero(set, &known, err);
    if (status) return status;
    facts->has_zero = known != CPSI_ZERO_UNKNOWN;
    if (!facts->has_zero && far > near) {
        /* check whether the whole set lies on the centre's side of 0 */
        for (size_t i = 0; i < n; i++) work[i] = -centre[i] / far;
        status = cpsi_support(set, work, NULL, &answer, err);
        if (status ||
            (answer.outcome == CPS_SET_OUTCOME_ANSWERED && answer.value < -near - answer.gap))
            return status;
    }
    memset(zero, 0, n * sizeof *zero);
    if (!facts->has_zero) {
        status = cps_set_project(set, zero, NULL, work, &answer, err);
        if (status || answer.outcome != CPS_SET_OUTCOME_ANSWERED) {
            if (!status) facts->outcome = answer.outcome;
            return status;
        }
        facts->has_zero = answer.value <= near;
    }
    facts->zero_relative = facts->has_zero;
    if (known == CPSI_ZERO_RELATIVE || !facts->has_zero) {
        /* already decided */
    } else if (facts->dimension == set->n && cpsi_closed_margin(set, zero, NULL, &margin)) {
        facts->zero_relative = margin > facts->tolerance;
    } else {
        for (int k = 0; !status && facts->zero_relative && k < 2 * facts->dimension; k++) {
            for (size_t i = 0; i < n; i++)
                work[i] = (k & 1 ? -1 : 1) * basis[(size_t)(k / 2) * n + i];
            status = cpsi_reach(set, zero, work, &answer, err);
            const bool out =
                answer.outcome == CPS_SET_OUTCOME_ANSWERED && answer.value > facts->tolerance;
            if (!status && !out) facts->zero_relative = false;
        }
    }
    facts->zero_interior = facts->zero_relative && facts->dimension == set->n;
    return status;
}

/* The facts of the polar of a bounded set are known: 0 lies inside it, and it is bounded where 0
 * lies inside the set. A search along directions could not decide this: the polar of a ball through
 * 0 is a paraboloid, which is unbounded in directions that are not rays. */
static CpsStatus facts_of_polar(const CpsSet *set, CpsSetFacts *facts, double *centre,
                                double *basis, bool *known, CpsError *err) {
    const size_t n = (size_t)set->n;
    CpsSetFacts part;
    *known = false;
    if (set->kind != CPSI_SET_POLAR) return CPS_OK;
    const CpsStatus status = cps_set_facts(set->part[0], 0, &part, NULL, NULL, err);
    if (status != CPS_OK || part.outcome != CPS_SET_OUTCOME_ANSWERED || !part.bounded)
        return status;
    facts->exact = facts->has_dimension = *known = true;
    facts->dimension = set->n;
    facts->bounded = part.zero_interior;
    facts->has_zero = facts->zero_relative = facts->zero_interior = true;
    if (centre) memset(centre, 0, n * sizeof *centre);
    for (size_t i = 0; basis && i < n * n; i++) basis[i] = i % (n + 1) == 0;
    return CPS_OK;
}

CpsStatus cps_set_facts(const CpsSet *set, double tolerance, CpsSetFacts *facts, double *centre,
                        double *basis, CpsError *err) {
    if (!set || !facts)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL", set ? "facts" : "set");
    if (!(tolerance >= 0) || tolerance > 0.1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "tolerance is %g, expected a share from 0 to 0.1",
                         tolerance);
    const size_t n = (size_t)set->n;
    bool known = false;
    *facts = (CpsSetFacts){.outcome = CPS_SET_OUTCOME_ANSWERED,
                           .tolerance = (tolerance > 0 ? tolerance : 1e-7) * cpsi_set_size(set)};
    CpsStatus status = facts_of_polar(set, facts, centre, basis, &known, err);
    if (status != CPS_OK || known) return status;
    double *scratch = calloc(n * n + 6 * n, sizeof *scratch);
    if (!scratch) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the facts of a set");
    Search search = {.set = set,
                     .width = (tolerance > 0 ? tolerance : 1e-7) * cpsi_set_size(set),
                     .basis = scratch,
                     .sum = scratch + n * n,
                     .plus = scratch + n * n + n,
                     .minus = scratch + n * n + 2 * n,
                     .turned = scratch + n * n + 3 * n,
                     .bounded = true,
                     .exact = true};
    double *rays = scratch + n * n + 4 * n, *work = scratch + n * n + 5 * n;
    *facts = (CpsSetFacts){.outcome = CPS_SET_OUTCOME_ANSWERED,
                           .closure = set->closure,
                           .tolerance = search.width};
    status = search_all(&search, rays, &facts->outcome, err);
    if (!status && facts->outcome == CPS_SET_OUTCOME_ANSWERED) {
        facts->exact = search.exact;
        facts->has_dimension = true;
        facts->dimension = search.dimension;
        facts->bounded = search.bounded;
        if (facts->bounded) status = check_bounded(set, work, facts, err);
        if (!status && search.points == 0) {
            status = any_point(set, search.sum, err);
            search.points = 1;
        }
        for (size_t i = 0; i < n; i++) search.sum[i] = search.sum[i] / search.points + rays[i];
        if (centre) memcpy(centre, search.sum, n * sizeof *centre);
        if (basis) memcpy(basis, search.basis, n * n * sizeof *basis);
        if (!status && cpsi_set_has_user(set))
            facts->outcome = CPS_SET_OUTCOME_NOT_AVAILABLE;
        else if (!status && facts->outcome == CPS_SET_OUTCOME_ANSWERED)
            status = place_zero(set, search.sum, search.basis, work, search.plus, facts, err);
    }
    free(scratch);
    return status;
}
