/* SPDX-License-Identifier: BSD-3-Clause */
/* The conjugate of any sum of terms, with a certificate.
 *
 *     phi*(-F) = min  sum of h_i*(gauge_i(F_i))
 *         over all ways F_1 + F_2 + .. = F of sharing the force
 *              = max  - <V, F> - sum of h_i(g_i(V))   over all velocities
 *
 * Any shares give an upper bound and any velocity gives a lower one, both from the terms' closed
 * forms; their difference is the gap. To find good ones, each h* is replaced by a function whose
 * slope is piecewise linear. For it the shares are a conic program (inf_convolution.h), which also
 * gives the velocity. The nodes of the next pass are placed at two points of each curve h': at the
 * gauge of the share found, and where the velocity found meets the curve. The solution lies between
 * them up to the error of the chord, so that their distance is squared from pass to pass, as in
 * Newton's method. A chord of any length is convex, so the first pieces may be long. */
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "law/inf_convolution.h"
#include "law/resistance.h"
#include "set/set.h"

/* Gaps relative to phi + phi*: at which the passes end at once (rounding), at which they end when a
 * pass brings no progress, and which is promised. The error of a velocity is the square root of its
 * gap, so that the last pass is worth its time. */
static const double TARGET = 1e-15, ENOUGH = 1e-11, PROMISE = 1e-9;
/* A force outside by less than this share of its length is on the boundary: the accuracy of the
 * conic program. */
static const double ON_BOUNDARY = 1e-9;
/* Rounding of the gauge of a force that was scaled to its limit. */
static const double ROUNDING = 1e-14;
/* Largest number of passes, and of passes without progress. */
enum { PASSES = 40, IDLE = 10 };
/* A bracket is widened by the first share of its width on both sides, but at least by the second
 * share of t, over which chord and curve are equal. */
static const double WIDEN = 0.3, NARROWEST = 1e-8;
/* Ranges beyond this many times the typical one count as infinite. */
static const double WITHOUT_END = 1e9;
/* The range of a term ends where the term alone costs this many times the best split found, a
 * margin for better splits. */
static const double RANGE_MARGIN = 4;
/* The speed at which the slope counts as its limit. SHORT keeps rounding from reaching a limit that
 * is only approached. */
static const double FAST = 1e100, SHORT = 1e-12;
/* A bracket whose speeds have a larger ratio is divided. */
static const double WIDE = 2;
/* Slopes of h* on the two sides of a point that differ by more than this are a jump. */
static const double JUMP = 1e-9;

/* One term of the sum. */
typedef struct SumTerm {
    CpsiTerm term; /* a term of the law, or all viscous terms together */
    CpsSet *set;   /* retained */
    CpsiConicForm *made;
    const CpsiConicForm *form;
    double limit; /* h' at the highest speeds, an upper bound of the gauge */
    /* range of the gauge to consider: beyond it the term alone costs more than the best split */
    double range;
    double t, g; /* gauge of its share; g(V) */
} SumTerm;

/* Bounds from shares and a velocity: lower <= phi* <= upper, up to the errors of the terms' own
 * answers. */
typedef struct Bounds {
    double *velocity; /* (n) */
    double upper, lower, potential, error;
} Bounds;

typedef struct TermSum {
    int n, count;
    const double *force;
    SumTerm *part;    /* (count) */
    CpsiShare *share; /* (count) */
    double *block;    /* memory of all arrays below */
    Bounds now, best;
    double *cost; /* (count) */
    double *work; /* (2n) */
    double *kept; /* (count, n) the shares of the best upper bound */
    /* (count) index of the term in the law; that of the first for the viscous terms */
    int *place;
    CpsSetOutcome outcome;
} TermSum;

/* ---- making ---- */

static CpsStatus add_part(TermSum *sum, const CpsiTerm *term, CpsSet *set, CpsError *err) {
    SumTerm *part = &sum->part[sum->count++];
    *part = (SumTerm){.term = *term, .set = set, .limit = INFINITY};
    if (cpsi_set_has_user(set)) {
        sum->outcome = CPS_SET_OUTCOME_NOT_AVAILABLE;
        return CPS_OK;
    }
    double h;
    CpsStatus status = CPS_OK;
    if (term->kind == CPSI_DRY || term->kind == CPSI_TABLE || term->kind == CPSI_FUNCTION)
        status = cpsi_term_at(term, FAST, &h, &part->limit, err);
    if (term->kind == CPSI_FUNCTION) part->limit *= 1 - SHORT;
    return status == CPS_OK ? cpsi_set_conic_form(set, &part->form, &part->made, err) : status;
}

/* all viscous terms together are one: the ellipsoid of their matrix, h = g^2/2 */
static CpsStatus add_viscous(TermSum *sum, const CpsResistance *law, CpsError *err) {
    const size_t size = (size_t)law->n * (size_t)law->n;
    double *matrix = calloc(size, sizeof *matrix);
    if (!matrix) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    bool any = false;
    for (int i = 0; i < law->count; i++) {
        if (law->term[i].kind != CPSI_VISCOUS) continue;
        any = true;
        for (size_t k = 0; k < size; k++) matrix[k] += law->term[i].data[k];
    }
    CpsSet *set = NULL;
    CpsStatus status = any ? cps_set_ellipsoid(law->n, NULL, matrix, &set, err) : CPS_OK;
    free(matrix);
    const CpsiTerm term = {.kind = CPSI_VISCOUS};
    return set ? add_part(sum, &term, set, err) : status;
}

static void sum_free(TermSum *sum) {
    for (int i = 0; i < sum->count; i++) {
        cpsi_conic_form_free(sum->part[i].made);
        cps_set_release(sum->part[i].set);
    }
    free(sum->part);
    free(sum->share);
    free(sum->block);
    free(sum->place);
}

static CpsStatus sum_make(const CpsResistance *law, const double *force, TermSum *sum,
                          CpsError *err) {
    const size_t n = (size_t)law->n, count = (size_t)law->count;
    *sum = (TermSum){.n = law->n, .force = force, .outcome = CPS_SET_OUTCOME_ANSWERED};
    sum->part = calloc(count, sizeof *sum->part);
    sum->share = calloc(count, sizeof *sum->share);
    sum->block = calloc((2 * count + 4) * n + count, sizeof *sum->block);
    sum->place = calloc(count, sizeof *sum->place);
    if (!sum->part || !sum->share || !sum->block || !sum->place)
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    double *at = sum->block + count * n; /* stored after the shares */
    sum->now = (Bounds){.velocity = at};
    sum->best = (Bounds){.velocity = at + n, .upper = INFINITY, .lower = -INFINITY};
    sum->work = at + 2 * n;
    sum->cost = at + 4 * n;
    sum->kept = sum->cost + count;
    CpsStatus status = add_viscous(sum, law, err);
    for (int i = 0; i < law->count && status == CPS_OK; i++) {
        const CpsiTerm *term = &law->term[i];
        if (term->kind == CPSI_VISCOUS || !cpsi_term_resists(term)) continue;
        sum->place[sum->count] = i;
        status = add_part(sum, term, cps_set_retain(term->set), err);
    }
    for (int i = 0; i < sum->count; i++) {
        sum->share[i].form = sum->part[i].form;
        sum->share[i].force = sum->block + (size_t)i * n;
    }
    return status;
}

/* ---- bounds ---- */

/* h*(gauge) of one share, its gauge and the error of the gauge; a gauge beyond the limit by less
 * than the share `slack` is on the limit */
static CpsStatus cost_of_share(const SumTerm *part, const double *force, double slack, double *t,
                               double *cost, double *error, CpsError *err) {
    CpsSetAnswer gauge;
    CpsiTermDual dual;
    CpsStatus status = cpsi_gauge(part->set, force, &gauge, err);
    *t = *cost = INFINITY;
    *error = 0;
    if (status != CPS_OK || gauge.outcome != CPS_SET_OUTCOME_ANSWERED) return status;
    *t = gauge.value > part->limit && gauge.value <= part->limit * (1 + slack) ? part->limit
                                                                               : gauge.value;
    status = cpsi_term_dual(&part->term, *t, &dual, err);
    *cost = dual.value;
    if (gauge.gap > 0) *error = gauge.gap * dual.low;
    return status;
}

/* the part that can bear work (n) in addition to its share at the least extra cost; -1: none */
static CpsStatus choose_bearer(TermSum *sum, double slack, const double *cost, int *bearer,
                               double *more, CpsError *err) {
    const size_t n = (size_t)sum->n;
    double *trial = sum->work + n, t, with, error;
    *bearer = -1;
    *more = INFINITY;
    for (int i = 0; i < sum->count; i++) {
        for (size_t a = 0; a < n; a++) trial[a] = sum->share[i].force[a] + sum->work[a];
        const CpsStatus status = cost_of_share(&sum->part[i], trial, slack, &t, &with, &error, err);
        if (status != CPS_OK) return status;
        if (with - cost[i] < *more) {
            *more = with - cost[i];
            *bearer = i;
        }
    }
    return CPS_OK;
}

/* The shares have the error of the conic program. Each is brought within its limit, and the
 * difference to F is given to the part that bears it at the least cost. Where that is possible only
 * up to rounding, F is on the boundary. */
static CpsStatus bound_above(TermSum *sum, CpsError *err) {
    const size_t n = (size_t)sum->n;
    double *lack = sum->work, more, *cost = sum->cost;
    memcpy(lack, sum->force, n * sizeof *lack);
    sum->now.upper = sum->now.error = 0;
    for (int i = 0; i < sum->count; i++) {
        double *share = sum->share[i].force, error;
        SumTerm *part = &sum->part[i];
        CpsStatus status = cost_of_share(part, share, 0, &part->t, &cost[i], &error, err);
        if (status == CPS_OK && part->t > part->limit &&
            part->t <= part->limit * (1 + ON_BOUNDARY)) {
            for (size_t a = 0; a < n; a++) share[a] *= part->limit / part->t;
            status = cost_of_share(part, share, ROUNDING, &part->t, &cost[i], &error, err);
        }
        if (status != CPS_OK) return status;
        if (isinf(
                /* rounding displaced it from a cone or a flat set: use the vector that all sets
                 * contain */
                cost[i])) {
            memset(share, 0, n * sizeof *share);
            cost[i] = part->t = 0;
        }
        for (size_t a = 0; a < n; a++) lack[a] -= share[a];
        sum->now.upper += cost[i];
        sum->now.error += error;
    }
    int bearer;
    CpsStatus status = choose_bearer(sum, ROUNDING, cost, &bearer, &more, err);
    if (status == CPS_OK && bearer < 0)
        status = choose_bearer(sum, ON_BOUNDARY, cost, &bearer, &more, err);
    if (bearer >= 0)
        for (size_t a = 0; a < n; a++) sum->share[bearer].force[a] += lack[a];
    sum->now.upper += more;
    return status;
}

static CpsStatus bound_below(TermSum *sum, CpsError *err) {
    const int n = sum->n;
    double *turned = sum->work, *velocity = sum->now.velocity;
    /* a component that is only rounding would be excluded by a set unbounded on that side */
    const double least = ROUNDING * cpsi_norm(n, velocity);
    for (int a = 0; a < n; a++) {
        if (!(fabs(velocity[a]) > least)) velocity[a] = 0;
        turned[a] = velocity[a] == 0 ? 0 : -velocity[a];
    }
    sum->now.potential = 0;
    for (int i = 0; i < sum->count; i++) {
        CpsSetAnswer g;
        double h, slope;
        CpsStatus status = cpsi_support(sum->part[i].set, turned, NULL, &g, err);
        sum->part[i].g =
            g.outcome == CPS_SET_OUTCOME_ANSWERED || g.outcome == CPS_SET_OUTCOME_NOT_ATTAINED
                ? fmax(g.value, 0)
                : INFINITY;
        if (status == CPS_OK && isfinite(sum->part[i].g)) {
            status = cpsi_term_at(&sum->part[i].term, sum->part[i].g, &h, &slope, err);
            sum->now.potential += h;
            if (g.gap > 0) sum->now.error += g.gap * slope;
        } else {
            sum->now.potential = INFINITY;
        }
        if (status != CPS_OK) return status;
    }
    sum->now.lower = cpsi_dot(n, turned, sum->force) - sum->now.potential;
    return CPS_OK;
}

/* Keep the better of each kind. Returns true where that reduces their difference by more than
 * rounding. */
static bool keep_best(TermSum *sum) {
    const Bounds *now = &sum->now;
    Bounds *best = &sum->best;
    const double before = best->upper - best->lower;
    if (now->upper < best->upper || now->lower > best->lower) best->error = now->error;
    if (now->upper < best->upper) {
        best->upper = now->upper;
        memcpy(sum->kept, sum->block, (size_t)sum->count * (size_t)sum->n * sizeof *sum->kept);
    }
    if (now->lower > best->lower) {
        best->lower = now->lower;
        best->potential = now->potential;
        memcpy(best->velocity, now->velocity, (size_t)sum->n * sizeof *best->velocity);
    }
    return !(best->upper - best->lower > 0.9 * before);
}

static double gap_of(const TermSum *sum) { return fmax(sum->best.upper - sum->best.lower, 0); }
static double scale_of(const TermSum *sum) { return sum->best.potential + sum->best.upper; }

/* ---- pieces ---- */

/* The first split: no cost up to h'(0), and beyond it the same cost for all terms, for a force as
 * long as F. */
static CpsStatus first_pieces(TermSum *sum, CpsError *err) {
    const double length = cpsi_norm(sum->n, sum->force);
    for (int i = 0; i < sum->count; i++) {
        SumTerm *part = &sum->part[i];
        CpsiShare *share = &sum->share[i];
        double h, rest;
        const CpsStatus status = cpsi_term_at(&part->term, 0, &h, &rest, err);
        if (status != CPS_OK) return status;
        const double unit = length / cpsi_set_size(part->set);
        share->unit = fmin(unit, part->limit);
        if (!(share->unit > 0)) share->unit = unit;
        const double end = part->limit > WITHOUT_END * unit ? INFINITY : part->limit;
        share->pieces = 0;
        share->node[0] = 0;
        if (rest > 0) share->node[++share->pieces] = fmin(rest, end);
        if (rest < end) share->node[++share->pieces] = end;
        if (share->pieces == 0) share->node[++share->pieces] = end;
        for (int k = 0; k < share->pieces; k++)
            share->after[k] = share->before[k] = share->node[k] >= rest ? 1 / unit : 0;
    }
    return CPS_OK;
}

/* The range of a term: h' where speed x h' - h = h*(h') reaches `energy`, with the speed accurate
 * to a factor 2^(1/4). */
static CpsStatus find_range(SumTerm *part, double energy, CpsError *err) {
    double g = 1, h, slope, factor = 2;
    CpsStatus status = cpsi_term_at(&part->term, g, &h, &slope, err);
    bool above = !(g * slope - h < energy);
    for (int turns = 0; turns < 3 && status == CPS_OK && g < 1e150 && g > 1e-150;) {
        g = above ? g / factor : g * factor;
        status = cpsi_term_at(&part->term, g, &h, &slope, err);
        const bool now = !(g * slope - h < energy);
        if (now != above) {
            above = now;
            turns++;
            factor = sqrt(factor);
        }
    }
    while (status == CPS_OK && g * slope - h < energy && g < 1e150) {
        g *= factor;
        status = cpsi_term_at(&part->term, g, &h, &slope, err);
    }
    while (status == CPS_OK && isinf(slope) && g > 1e-150) { /* beyond the domain of h */
        g /= factor;
        status = cpsi_term_at(&part->term, g, &h, &slope, err);
    }
    part->range = fmin(slope, part->limit);
    if (!(part->range > part->t)) part->range = fmin(2 * part->t, part->limit);
    return status;
}

/* slopes of the pieces between nodes 0 .. pieces of the share */
static CpsStatus slopes(SumTerm *part, CpsiShare *share, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int k = 0; k <= share->pieces && status == CPS_OK; k++) {
        CpsiTermDual dual;
        status = cpsi_term_dual(&part->term, share->node[k], &dual, err);
        if (k < share->pieces) share->after[k] = dual.high;
        if (k > 0) share->before[k - 1] = dual.low;
    }
    return status;
}

/* add a node, unless the piece would be too narrow */
static void add_node(CpsiShare *share, double t) {
    if (!(t > share->node[share->pieces] + 0.1 * NARROWEST * t)) return;
    share->node[++share->pieces] = t;
}

/* A node inside a bracket: where the slope of h* jumps at its end `other`; in a wide bracket at the
 * geometric mean of the speeds of its ends; else 0. */
static CpsStatus middle_node(const SumTerm *part, double other, double low, double high,
                             double *middle, CpsError *err) {
    CpsiTermDual at = {0}, slow = {0}, fast = {0};
    double h;
    *middle = 0;
    CpsStatus status = cpsi_term_dual(&part->term, other, &at, err);
    if (status == CPS_OK && at.high > at.low + JUMP * at.high) *middle = other;
    if (status != CPS_OK || *middle > 0) return status;
    status = cpsi_term_dual(&part->term, low, &slow, err);
    if (status == CPS_OK) status = cpsi_term_dual(&part->term, high, &fast, err);
    if (status == CPS_OK && slow.high > 0 && fast.low > WIDE * slow.high)
        status = cpsi_term_at(&part->term, sqrt(slow.high * fast.low), &h, middle, err);
    return status;
}

/* Nodes at 0, on both sides of the two points of the curve that the last split gave, and at the end
 * of the range. */
static CpsStatus nodes(SumTerm *part, CpsiShare *share, bool first, CpsError *err) {
    if (first) {
        add_node(share, part->t);
        add_node(share, part->range);
        return CPS_OK;
    }
    double h, other, middle = 0;
    CpsStatus status = cpsi_term_at(&part->term, part->g, &h, &other, err);
    other = fmin(other, part->range);
    const double low = fmin(part->t, other), high = fmax(part->t, other);
    if (status == CPS_OK) status = middle_node(part, other, low, high, &middle, err);
    const double margin = fmax(WIDEN * (high - low), NARROWEST * high);
    add_node(share, fmax(low - margin, 0.5 * low));
    add_node(share, middle);
    add_node(share, fmin(high + margin, part->range));
    add_node(share, part->range);
    return status;
}

static CpsStatus next_pieces(TermSum *sum, bool first, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int i = 0; i < sum->count && status == CPS_OK; i++) {
        SumTerm *part = &sum->part[i];
        CpsiShare *share = &sum->share[i];
        status = find_range(part, RANGE_MARGIN * sum->best.upper, err);
        if (status != CPS_OK) break;
        share->unit = part->range > 0 ? part->range : 1;
        share->pieces = 0;
        share->node[0] = 0;
        const bool straight = part->term.kind == CPSI_DRY || part->term.kind == CPSI_VISCOUS;
        if (!straight) status = nodes(part, share, first, err);
        if (share->pieces == 0) share->node[++share->pieces] = share->unit;
        if (status == CPS_OK) status = slopes(part, share, err);
    }
    return status;
}

/* ---- the conjugate ---- */

/* Cost of the first split beyond h'(0), relative to |F|: 0 where F can be borne at rest. */
static double beyond_rest(const TermSum *sum) {
    double cost = 0;
    for (int i = 0; i < sum->count; i++) {
        const CpsiShare *share = &sum->share[i];
        const int last = share->pieces - 1;
        if (share->after[last] > 0)
            cost += fmax(share->t - share->node[last], 0) * share->after[last];
    }
    return cost;
}

static CpsStatus refine(TermSum *sum, CpsError *err) {
    CpsStatus status = CPS_OK;
    int idle = 0;
    for (int pass = 0; pass < PASSES && idle < IDLE && status == CPS_OK; pass++) {
        CpsSetOutcome outcome = CPS_SET_OUTCOME_ANSWERED;
        status = next_pieces(sum, pass == 0, err);
        if (status == CPS_OK)
            status = cpsi_inf_convolution(sum->n, sum->count, sum->share, sum->force,
                                          sum->best.upper, sum->now.velocity, &outcome, err);
        if (status != CPS_OK || outcome != CPS_SET_OUTCOME_ANSWERED) break;
        status = bound_above(sum, err);
        if (status == CPS_OK) status = bound_below(sum, err);
        idle = keep_best(sum) ? 0 : idle + 1;
        if (gap_of(sum) <= (idle > 0 ? ENOUGH : TARGET) * scale_of(sum)) break;
    }
    return status;
}

static CpsStatus conjugate(TermSum *sum, double *velocity, CpsSetAnswer *answer, CpsError *err) {
    const size_t n = (size_t)sum->n;
    CpsSetOutcome outcome;
    CpsStatus status = first_pieces(sum, err);
    if (status == CPS_OK)
        status = cpsi_inf_convolution(sum->n, sum->count, sum->share, sum->force, 1,
                                      sum->now.velocity, &outcome, err);
    if (status != CPS_OK) return status;
    const double length = cpsi_norm(sum->n, sum->force);
    *answer = (CpsSetAnswer){.outcome = outcome, .value = INFINITY};
    if (outcome != CPS_SET_OUTCOME_ANSWERED) return CPS_OK;
    *answer =
        (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .tolerance = ON_BOUNDARY * length};
    if (velocity) memset(velocity, 0, n * sizeof *velocity);
    memcpy(sum->kept, sum->block, (size_t)sum->count * n * sizeof *sum->kept);
    if (beyond_rest(sum) <= ON_BOUNDARY) return CPS_OK;

    /* these shares and the velocity 0 are the first bounds */
    memset(sum->now.velocity, 0, n * sizeof *sum->now.velocity);
    status = bound_above(sum, err);
    if (status == CPS_OK) keep_best(sum);
    if (status == CPS_OK && isfinite(sum->best.upper)) status = refine(sum, err);
    if (status != CPS_OK) return status;
    answer->value = sum->best.upper;
    answer->gap = gap_of(sum) + sum->best.error;
    if (!(answer->gap <= PROMISE * scale_of(sum)) || isinf(answer->gap))
        answer->outcome = CPS_SET_OUTCOME_INACCURATE;
    if (velocity) memcpy(velocity, sum->best.velocity, n * sizeof *velocity);
    return CPS_OK;
}

CpsStatus cpsi_conjugate_sum(const CpsResistance *law, const double *force, double *velocity,
                             double *share, CpsSetAnswer *answer, CpsError *err) {
    TermSum sum;
    CpsStatus status = sum_make(law, force, &sum, err);
    if (status == CPS_OK && sum.outcome != CPS_SET_OUTCOME_ANSWERED) {
        *answer = (CpsSetAnswer){.outcome = sum.outcome, .value = NAN};
    } else if (status == CPS_OK && cpsi_norm(law->n, force) == 0) {
        *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true};
        if (velocity) memset(velocity, 0, (size_t)law->n * sizeof *velocity);
    } else if (status == CPS_OK) {
        status = conjugate(&sum, velocity, answer, err);
    }
    const size_t n = (size_t)law->n;
    if (status == CPS_OK)
        for (int i = 0; share && i < sum.count; i++)
            memcpy(&share[(size_t)sum.place[i] * n], &sum.kept[(size_t)i * n], n * sizeof *share);
    sum_free(&sum);
    return status;
}
