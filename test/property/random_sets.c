/* SPDX-License-Identifier: BSD-3-Clause */
/* Random set expressions of depth <= 4 in R^n, n <= 6, against the identities of convex analysis.
 *                                                                 usage: random_sets [--cases N |
 *                                                                     --seed S]
 *
 * Each case asks one question whose answer is known in a second way:
 *   form       support by the calculus = support by the conic form of the whole expression
 *   sum        h of a sum = sum of the h's, by the conic form
 *   polar      C°° = C for C with 0, and the gauge of C° = h
 *   face       <w, x> = h(w) (Fenchel-Young) at the middle and the ends of the face; its points lie
 *              in C
 *   facet      a face of a face attains both directions, one after the other
 *   meet       h of an intersection = inf-convolution: h(w) = h_A(u) + h_B(w - u) at a splitting
 *              read off the normal
 * cones split      the same for balls, ellipsoids, boxes, half-spaces and strips, all in code of
 *                  its own (split.c)
 *   moreau     p = P_K p + P_K° p, orthogonal, for cones of rays and for normal cones K
 *   project    p - P_C p is normal to C at P_C p: <p - P p, P p> = h(p - P p)
 *   preimage   L^-1(C) = image of C by the (pseudo-)inverse, and endless along the kernel; of a
 *              polyhedron: rows times
 * L cone       w is in the normal cone at x where x attains h(w), and what is in that cone exposes
 *              x degenerate points,
 * segments, flat sets, empty intersections, unbounded sets: the outcome is known beforehand
 *
 * At least 98 % must be answered, no matter how rare a refusal for a good reason is, and none may
 * be wrong. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "random_expression.h"
#include "split.h"

/* Values, relative to the size of the data: the solver's promise; two answers add up. */
static const double VALUE = 2e-9;
/* Distances of points from where they should be. */
static const double POINT = 1e-8;
/* A normal turns by its point's error over the radius; radii go down to a hundredth and less of the
 * set. */
static const double TURN = 1e-5;

/* ---- comparing ---- */

static double worst[2]; /* largest difference seen: of values, of points */

static Result same(double a, double b, double scale) {
    if (a == b) return ANSWERED;
    const double off = fabs(a - b) / scale;
    if (!(off <= worst[0])) worst[0] = off;
    return off <= VALUE ? ANSWERED : WRONG;
}

static Result result_of(CpsSetOutcome outcome) {
    return outcome == CPS_SET_OUTCOME_ANSWERED     ? ANSWERED
           : outcome == CPS_SET_OUTCOME_INACCURATE ? OPEN
                                                   : REFUSED;
}

/* Where an answer is due, a refusal is wrong. */
static Result due(CpsSetOutcome outcome) {
    const Result result = result_of(outcome);
    return result == REFUSED ? WRONG : result;
}

static Result both(Result a, Result b) { return a > b ? a : b; }

/* Two answers to one question. */
static Result compare(const CpsSetAnswer *a, const CpsSetAnswer *b, double scale) {
    if (a->outcome == CPS_SET_OUTCOME_INACCURATE || b->outcome == CPS_SET_OUTCOME_INACCURATE)
        return OPEN;
    if (a->outcome != b->outcome) return WRONG;
    if (a->outcome != CPS_SET_OUTCOME_ANSWERED) return REFUSED;
    /* the gaps must explain the difference, but for rounding of sums of some hundred products */
    if (fabs(a->value - b->value) > a->gap + b->gap + 1e-12 * scale) return WRONG;
    return same(a->value, b->value, scale);
}

static Result inside(const CpsSet *set, const double *x, double scale) {
    CpsSetAnswer answer;
    double nearest[2 * MAX_SPACE];
    DO(cps_set_project(set, x, NULL, nearest, &answer, &err));
    const Result result = due(answer.outcome);
    if (result != ANSWERED) return result;
    if (!(answer.value / scale <= worst[1])) worst[1] = answer.value / scale;
    return answer.value <= POINT * scale ? ANSWERED : WRONG;
}

/* ---- directions ---- */

/* A direction in which the set is bounded: any, half of the time an axis; where that is unbounded
 * one that leads from the set to a point outside. h, and x that attains it. False: refused. */
static bool direction(const Sample *sample, double *w, double *x, CpsSetAnswer *h) {
    const int n = cps_set_space(sample->set);
    fill(n, 1, w);
    if (below(2)) {
        memset(w, 0, (size_t)n * sizeof *w);
        const int sign = below(2) ? 1 : -1;
        w[below(n)] = sign;
    }
    DO(cps_set_support(sample->set, w, x, h, &err));
    if (h->outcome != CPS_SET_OUTCOME_UNBOUNDED) return true;
    double p[MAX_SPACE], nearest[MAX_SPACE];
    for (int k = 0; k < 20; k++) {
        CpsSetAnswer answer;
        fill(n, 10, p);
        for (int i = 0; i < n; i++) p[i] += sample->inside[i];
        DO(cps_set_project(sample->set, p, NULL, nearest, &answer, &err));
        if (answer.outcome != CPS_SET_OUTCOME_ANSWERED || answer.value < 0.1) continue;
        for (int i = 0; i < n; i++) w[i] = (p[i] - nearest[i]) / answer.value;
        DO(cps_set_support(sample->set, w, x, h, &err));
        return h->outcome != CPS_SET_OUTCOME_UNBOUNDED;
    }
    return false;
}

/* What differences are measured by: |w| times the set's size along w and at x. */
static double scale_of(const CpsSet *set, const double *w, const double *x) {
    const int n = cps_set_space(set);
    CpsSetExtent extent;
    DO(cps_set_extent(set, w, &extent, &err));
    double scale = norm(n, w) * fmax(1, x ? norm(n, x) : 0);
    if (isfinite(extent.low)) scale = fmax(scale, fabs(extent.low));
    if (isfinite(extent.high)) scale = fmax(scale, fabs(extent.high));
    return scale;
}

/* The same set, asked through the conic form of the whole. */
static CpsSet *through_form(const CpsSet *set) {
    CpsSet *out;
    DO(cps_set_intersection(1, &set, &out, &err));
    return out;
}

/* ---- support ---- */

static Result case_form(int n) {
    const bool bounded = below(2);
    const Sample sample = random_expression(n, 1 + below(MAX_DEPTH), bounded);
    CpsSet *form = through_form(sample.set);
    CpsSetAnswer a, b;
    double w[MAX_SPACE], x[MAX_SPACE];
    Result result = REFUSED;
    if (direction(&sample, w, x, &a)) {
        DO(cps_set_support(form, w, NULL, &b, &err));
        const double scale = scale_of(sample.set, w, x);
        result = compare(&a, &b, scale);
        if (result == ANSWERED) result = inside(form, x, scale / norm(n, w));
    }
    cps_set_release(sample.set);
    cps_set_release(form);
    return result;
}

static Result case_sum(int n) {
    const bool bounded = below(2);
    const Sample one = random_expression(n, below(MAX_DEPTH), bounded),
                 two = random_expression(n, below(MAX_DEPTH), true);
    CpsSet *set, *form;
    CpsSetAnswer a, b, c;
    double w[MAX_SPACE], x[MAX_SPACE];
    DO(cps_set_sum(2, (const CpsSet *[]){one.set, two.set}, &set, &err));
    form = through_form(set);
    Result result = REFUSED;
    if (direction(&one, w, x, &a)) {
        DO(cps_set_support(two.set, w, NULL, &b, &err));
        DO(cps_set_support(form, w, NULL, &c, &err));
        result = both(result_of(a.outcome), result_of(b.outcome));
        a.value += b.value;
        a.gap += b.gap;
        if (result == ANSWERED) result = compare(&a, &c, scale_of(set, w, x));
    }
    cps_set_release(one.set);
    cps_set_release(two.set);
    cps_set_release(set);
    cps_set_release(form);
    return result;
}

static Result case_polar(int n) {
    CpsSet *set = random_round_zero(n, below(MAX_DEPTH - 1)), *polar, *twice;
    double w[MAX_SPACE], x[MAX_SPACE];
    CpsSetAnswer a, b, gauge;
    fill(n, 1, w);
    DO(cps_set_polar(set, &polar, &err));
    DO(cps_set_polar(polar, &twice, &err));
    DO(cps_set_support(set, w, x, &a, &err));
    DO(cps_set_support(twice, w, NULL, &b, &err));
    DO(cps_set_gauge(polar, w, &gauge, &err));
    const double scale = scale_of(set, w, x);
    Result result = both(compare(&a, &b, scale), compare(&a, &gauge, scale));
    if (result == ANSWERED) result = inside(twice, x, scale / norm(n, w));
    cps_set_release(set);
    cps_set_release(polar);
    cps_set_release(twice);
    return result;
}

/* ---- faces ---- */

/* Does the face attain h(w) in the set, at its middle and at its ends along the first direction
 * that it has? */
static Result attains(const CpsSet *set, const CpsSet *face, const double *w, double h,
                      double scale, double *centre) {
    const int n = cps_set_space(set);
    double basis[MAX_SPACE * MAX_SPACE], end[MAX_SPACE];
    CpsSetFacts facts;
    CpsSetAnswer answer;
    DO(cps_set_facts(face, 0, &facts, centre, basis, &err));
    Result result = due(facts.outcome);
    for (int side = 0; result == ANSWERED && side <= (facts.dimension > 0 ? 2 : 0); side++) {
        if (side > 0) {
            for (int i = 0; i < n; i++) basis[i] = -basis[i];
            DO(cps_set_support(face, basis, end, &answer, &err));
            if (answer.outcome == CPS_SET_OUTCOME_UNBOUNDED) continue;
            result = due(answer.outcome);
        } else
            memcpy(end, centre, (size_t)n * sizeof *end);
        const double far = fmax(1, norm(n, end)); /* unbounded faces have far middles */
        if (result == ANSWERED) result = same(dot(n, w, end), h, scale * far);
        if (result == ANSWERED) result = inside(set, end, scale / norm(n, w) * far);
    }
    return result;
}

static Result case_face(int n) {
    const bool bounded = below(4) > 0;
    const Sample sample = random_expression(n, 1 + below(MAX_DEPTH), bounded);
    CpsSet *face = NULL;
    CpsSetAnswer h, answer;
    double w[MAX_SPACE], x[MAX_SPACE];
    Result result = REFUSED;
    if (direction(&sample, w, x, &h)) {
        DO(cps_set_face(sample.set, w, 0, &face, &answer, &err));
        result = due(answer.outcome);
        if (face)
            result = attains(sample.set, face, w, answer.value, scale_of(sample.set, w, x), x);
    }
    cps_set_release(sample.set);
    cps_set_release(face);
    return result;
}

static Result case_facet(int n) {
    const bool bounded = below(4) > 0;
    const Sample sample = random_expression(n, 1 + below(MAX_DEPTH), bounded);
    CpsSet *face = NULL, *second = NULL;
    CpsSetAnswer h, one, two;
    double w[MAX_SPACE], u[MAX_SPACE], x[MAX_SPACE];
    Result result = REFUSED;
    fill(n, 1, u);
    if (direction(&sample, w, x, &h)) {
        DO(cps_set_face(sample.set, w, 0, &face, &one, &err));
        result = due(one.outcome);
    }
    if (face) {
        DO(cps_set_face(face, u, 0, &second, &two, &err));
        result = result_of(two.outcome);
    }
    if (second) {
        result = attains(face, second, u, two.value, scale_of(sample.set, u, x), x);
        if (result == ANSWERED) result = same(dot(n, w, x), one.value, scale_of(sample.set, w, x));
    }
    cps_set_release(sample.set);
    cps_set_release(face);
    cps_set_release(second);
    return result;
}

/* ---- intersections ---- */

/* u in N_A(x) with w - u in N_B(x): the point of {u : (u, w - u) in N_A x N_B} next to w/2. */
static Result split_by_cones(int n, const CpsSet *const *part, const double *x, const double *w,
                             double *u) {
    double map[2 * MAX_SPACE * MAX_SPACE] = {0}, shift[2 * MAX_SPACE] = {0}, middle[MAX_SPACE];
    CpsSet *cone[2] = {NULL, NULL}, *product, *pairs;
    Result result = ANSWERED;
    CpsSetAnswer answer;
    for (int k = 0; k < 2; k++) {
        DO(cps_set_normal_cone(part[k], x, 1e-8, &cone[k], &answer, &err));
        result = both(result, due(answer.outcome));
    }
    for (int i = 0; i < n; i++) {
        map[i * n + i] = 1;
        map[(n + i) * n + i] = -1;
        shift[n + i] = w[i];
        middle[i] = w[i] / 2;
    }
    if (result == ANSWERED) {
        DO(cps_set_product(2, (const CpsSet *const *)cone, &product, &err));
        DO(cps_set_preimage(n, map, shift, product, &pairs, &err));
        DO(cps_set_project(pairs, middle, NULL, u, &answer, &err));
        /* rounding may keep the two cones from meeting */
        result = answer.outcome == CPS_SET_OUTCOME_EMPTY ? OPEN : due(answer.outcome);
        cps_set_release(product);
        cps_set_release(pairs);
    }
    cps_set_release(cone[0]);
    cps_set_release(cone[1]);
    return result;
}

static Result case_meet(int n) {
    Sample one = random_expression(n, below(MAX_DEPTH), true),
           two = random_expression(n, below(MAX_DEPTH), true);
    double w[MAX_SPACE], x[MAX_SPACE], u[MAX_SPACE], v[MAX_SPACE];
    for (int i = 0; i < n; i++) v[i] = one.inside[i] - two.inside[i];
    CpsSet *moved, *set;
    DO(cps_set_translate(v, two.set, &moved, &err));
    const CpsSet *part[2] = {one.set, moved};
    DO(cps_set_intersection(2, part, &set, &err));
    CpsSetAnswer h, a, b;
    Result result = REFUSED;
    if (direction(&(Sample){.set = set}, w, x, &h)) result = due(h.outcome);
    /* below: x is in both; above: a splitting */
    const double scale = scale_of(set, w, x);
    for (int k = 0; result == ANSWERED && k < 2; k++)
        result = inside(part[k], x, scale / norm(n, w));
    if (result == ANSWERED) result = split_by_cones(n, part, x, w, u);
    if (result == ANSWERED) {
        for (int i = 0; i < n; i++) v[i] = w[i] - u[i];
        DO(cps_set_support(one.set, u, NULL, &a, &err));
        DO(cps_set_support(moved, v, NULL, &b, &err));
        result = both(due(a.outcome), due(b.outcome));
        if (result == ANSWERED)
            result =
                same(h.value, a.value + b.value, scale_of(one.set, u, x) + scale_of(moved, v, x));
    }
    cps_set_release(one.set);
    cps_set_release(two.set);
    cps_set_release(moved);
    cps_set_release(set);
    return result;
}

/* The library finds the maximum, split.c proves it. */
static Result case_split(int n) {
    SplitPart part[SPLIT_PARTS];
    CpsSet *sets[SPLIT_PARTS], *set;
    const int count = split_random(n, part);
    for (int k = 0; k < count; k++) sets[k] = split_set(n, &part[k]);
    DO(cps_set_intersection(count, (const CpsSet *const *)sets, &set, &err));
    CpsSetAnswer h;
    double w[MAX_SPACE], x[MAX_SPACE];
    fill(n, 1, w);
    DO(cps_set_support(set, w, x, &h, &err));
    Result result = due(h.outcome);
    if (result == ANSWERED) {
        const SplitBounds bounds = split_bounds(n, count, part, w, x);
        const double scale = norm(n, w) * fmax(1, norm(n, x));
        result = both(same(h.value, bounds.lower, scale), same(h.value, bounds.upper, scale));
        if (!(bounds.outside <= POINT * scale)) result = WRONG;
        if (!(bounds.upper - h.value <= h.gap + 1e-10 * scale)) result = WRONG;
    }
    for (int k = 0; k < count; k++) cps_set_release(sets[k]);
    cps_set_release(set);
    return result;
}

/* ---- cones and projections ---- */

static Result case_moreau(int n) {
    double rays[2 * MAX_SPACE * MAX_SPACE], p[MAX_SPACE], x[MAX_SPACE], y[MAX_SPACE],
        sum[MAX_SPACE];
    const int count = below(2 * n + 1);
    CpsSet *cone = NULL, *polar;
    CpsSetAnswer a, b;
    Result result = ANSWERED;
    fill(n, 1, p);
    if (below(2)) {
        fill(count * n, 1, rays);
        DO(cps_set_cone_of_rays(n, count, rays, &cone, &err));
    } else { /* the normal cone where some direction is attained */
        const Sample sample = random_expression(n, below(MAX_DEPTH), true);
        if (direction(&sample, y, x, &a)) result = due(a.outcome);
        if (result == ANSWERED) DO(cps_set_normal_cone(sample.set, x, 0, &cone, &a, &err));
        if (result == ANSWERED) result = due(a.outcome);
        cps_set_release(sample.set);
    }
    if (result != ANSWERED) return result;
    DO(cps_set_polar(cone, &polar, &err));
    DO(cps_set_project(cone, p, NULL, x, &a, &err));
    DO(cps_set_project(polar, p, NULL, y, &b, &err));
    result = both(due(a.outcome), due(b.outcome));
    if (result == ANSWERED) {
        /* a distance off by d moves the nearest point by the root of 2 d times the distance */
        const double square = dot(n, p, p), off = sqrt(2 * a.gap * (a.value + a.gap)) +
                                                  sqrt(2 * b.gap * (b.value + b.gap));
        for (int i = 0; i < n; i++) sum[i] = x[i] + y[i] - p[i];
        result = both(same(dot(n, x, y), 0, square),
                      same(a.value * a.value + b.value * b.value, square, square));
        if (!(norm(n, sum) <= off + POINT * norm(n, p))) result = WRONG;
    }
    cps_set_release(cone);
    cps_set_release(polar);
    return result;
}

static Result case_project(int n) {
    const bool bounded = below(2);
    const Sample sample = random_expression(n, below(MAX_DEPTH + 1), bounded);
    double p[MAX_SPACE], nearest[MAX_SPACE], w[MAX_SPACE];
    CpsSetAnswer answer, h;
    fill(n, 4, p);
    DO(cps_set_project(sample.set, p, NULL, nearest, &answer, &err));
    Result result = due(answer.outcome);
    for (int i = 0; i < n; i++) w[i] = p[i] - nearest[i];
    const double far = fmax(1, norm(n, nearest));
    if (result == ANSWERED) result = same(answer.value, norm(n, w), far);
    if (result == ANSWERED && answer.value > 1e-3) {
        DO(cps_set_support(sample.set, w, NULL, &h, &err));
        /* w is known to rounding: a set that is unbounded across it may say so */
        result = result_of(h.outcome);
        if (result == ANSWERED) result = same(h.value, dot(n, w, nearest), norm(n, w) * far);
        if (h.outcome == CPS_SET_OUTCOME_EMPTY) result = WRONG;
    }
    cps_set_release(sample.set);
    return result;
}

static Result case_cone(int n) {
    const bool bounded = below(4) > 0;
    const Sample sample = random_expression(n, 1 + below(MAX_DEPTH), bounded);
    CpsSet *cone = NULL;
    CpsSetAnswer h, answer;
    CpsSetFacts facts;
    double w[MAX_SPACE], x[MAX_SPACE], y[MAX_SPACE];
    Result result = REFUSED;
    if (direction(&sample, w, x, &h)) result = due(h.outcome);
    if (result == ANSWERED) {
        DO(cps_set_normal_cone(sample.set, x, 1e-8, &cone, &answer, &err));
        result = due(answer.outcome);
    }
    if (result == ANSWERED) {
        DO(cps_set_project(cone, w, NULL, y, &answer, &err));
        result = due(answer.outcome);
        if (result == ANSWERED && !(answer.value <= TURN * norm(n, w))) result = WRONG;
    }
    if (result == ANSWERED) { /* what is inside the cone exposes x */
        DO(cps_set_facts(cone, 0, &facts, w, NULL, &err));
        result = due(facts.outcome);
    }
    if (result == ANSWERED && norm(n, w) > 0) {
        DO(cps_set_support(sample.set, w, NULL, &h, &err));
        result = result_of(h.outcome); /* an unbounded set and a direction off by rounding */
        if (result == ANSWERED)
            result = same(h.value, dot(n, w, x), TURN / VALUE * scale_of(sample.set, w, x));
    }
    cps_set_release(sample.set);
    cps_set_release(cone);
    return result;
}

/* ---- preimages ---- */

/* What L^-1(C) is beside the kernel of a square or wide L of full rank: L+ (C - shift), L+ = L'(L
 * L')^-1 */
static CpsSet *eliminated(int n, int m, const double *map, const double *shift, const CpsSet *set) {
    double square[MAX_SPACE * MAX_SPACE], inverse[MAX_SPACE * MAX_SPACE],
        plus[MAX_SPACE * MAX_SPACE], back[MAX_SPACE];
    CpsSet *moved, *image;
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) square[i * m + j] = dot(n, &map[i * n], &map[j * n]);
    if (!invert(m, square, 1e-4, inverse)) return NULL;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < m; j++) {
            plus[i * m + j] = 0;
            for (int k = 0; k < m; k++) plus[i * m + j] += map[k * n + i] * inverse[k * m + j];
        }
    for (int k = 0; k < m; k++) back[k] = -shift[k];
    DO(cps_set_translate(back, set, &moved, &err));
    DO(cps_set_image(n, plus, moved, &image, &err));
    cps_set_release(moved);
    return image;
}

/* {x : rows (L x + shift) <= offsets} */
static CpsSet *rows_times_map(int n, int m, const double *map, const double *shift, CpsSet **of) {
    double rows[3 * MAX_SPACE * MAX_SPACE], offsets[3 * MAX_SPACE],
        through[3 * MAX_SPACE * MAX_SPACE], left[3 * MAX_SPACE];
    const int count = 3 * m;
    CpsSet *set;
    fill(count * m, 1, rows);
    for (int k = 0; k < count; k++) {
        offsets[k] = uniform(0.2, 2) + dot(m, &rows[k * m], shift);
        times(m, n, map, -1, &rows[k * m], &through[k * n]);
        left[k] = offsets[k] - dot(m, &rows[k * m], shift);
    }
    DO(cps_set_inequalities(m, count, rows, offsets, of, &err));
    DO(cps_set_inequalities(n, count, through, left, &set, &err));
    return set;
}

static Result case_preimage(int n) {
    const bool rows = below(2);
    const int m = rows ? 1 + below(MAX_SPACE) : 1 + below(n);
    double map[MAX_SPACE * MAX_SPACE], shift[MAX_SPACE], u[MAX_SPACE], w[MAX_SPACE], x[MAX_SPACE];
    Sample part = {.inside = {0}};
    CpsSet *second, *pre;
    CpsSetAnswer a, b;
    fill(m * n, 1, map);
    fill(m, 0.3, shift);
    for (int k = 0; k < m && k < n; k++) map[k * n + k] += map[k * n + k] > 0 ? 1 : -1;
    if (rows)
        second = rows_times_map(n, m, map, shift, &part.set);
    else {
        const bool bounded = below(2);
        part = random_expression(m, below(MAX_DEPTH), bounded);
        second = eliminated(n, m, map, shift, part.set);
    }
    /* w = L'u is bounded where u is */
    Result result = REFUSED;
    if (second && direction(&part, u, x, &a)) {
        DO(cps_set_preimage(n, map, shift, part.set, &pre, &err));
        times(m, n, map, -1, u, w);
        DO(cps_set_support(pre, w, x, &a, &err));
        DO(cps_set_support(second, w, u, &b, &err));
        /* endless along what only rounding of L+ has left of w? */
        const bool rounding = b.outcome == CPS_SET_OUTCOME_UNBOUNDED &&
                              dot(n, w, u) < 1e-12 * norm(n, w) * norm(n, u);
        result = rounding
                     ? REFUSED
                     : compare(&a, &b,
                               scale_of(pre, w, a.outcome == CPS_SET_OUTCOME_ANSWERED ? x : NULL));
        if (m < n && result == ANSWERED) { /* but other directions are not */
            fill(n, 1, w);
            DO(cps_set_support(pre, w, x, &a, &err));
            if (a.outcome != CPS_SET_OUTCOME_UNBOUNDED || !(dot(n, w, x) > 0)) result = WRONG;
        }
        cps_set_release(pre);
    }
    cps_set_release(part.set);
    cps_set_release(second);
    return result;
}

/* ---- degenerate sets ---- */

/* Does every question about nothing say so? */
static Result check_empty(int n, const CpsSet *set) {
    CpsSetAnswer support, face, nearest;
    CpsSetFacts facts;
    double w[MAX_SPACE], x[MAX_SPACE];
    CpsSet *out = NULL;
    fill(n, 1, w);
    DO(cps_set_support(set, w, x, &support, &err));
    DO(cps_set_face(set, w, 0, &out, &face, &err));
    DO(cps_set_project(set, w, NULL, x, &nearest, &err));
    DO(cps_set_facts(set, 0, &facts, NULL, NULL, &err));
    const CpsSetOutcome all[] = {support.outcome, face.outcome, nearest.outcome, facts.outcome};
    Result result = ANSWERED;
    for (int k = 0; k < 4; k++)
        if (all[k] != CPS_SET_OUTCOME_EMPTY)
            result = both(result, all[k] == CPS_SET_OUTCOME_INACCURATE ? OPEN : WRONG);
    if (result == ANSWERED && (support.value != -INFINITY || facts.has_dimension || out))
        result = WRONG;
    return result;
}

/* A ∩ (A + d), d longer along u than A is wide */
static Result case_empty(int n, const Sample *sample) {
    double u[MAX_SPACE], x[MAX_SPACE];
    CpsSetExtent extent;
    CpsSetAnswer h;
    if (!direction(sample, u, x, &h)) return REFUSED;
    DO(cps_set_extent(sample->set, u, &extent, &err));
    if (!extent.low_attained || !extent.high_attained)
        return result_of(extent.outcome) == OPEN ? OPEN : REFUSED;
    const double far = (extent.high - extent.low + uniform(0.01, 1)) / dot(n, u, u);
    for (int i = 0; i < n; i++) u[i] *= far;
    CpsSet *moved, *none;
    DO(cps_set_translate(u, sample->set, &moved, &err));
    DO(cps_set_intersection(2, (const CpsSet *[]){sample->set, moved}, &none, &err));
    const Result result = check_empty(n, none);
    cps_set_release(moved);
    cps_set_release(none);
    return result;
}

/* A cut by a hyperplane through its point, or an image in a subspace: flat, and support as ever. */
static Result case_flat(int n, const Sample *sample) {
    double u[MAX_SPACE], centre[MAX_SPACE];
    CpsSet *plane, *flat;
    CpsSetFacts facts;
    fill(n, 1, u);
    const double at = dot(n, u, sample->inside);
    DO(cps_set_strip(n, u, at, at, &plane, &err));
    DO(cps_set_intersection(2, (const CpsSet *[]){sample->set, plane}, &flat, &err));
    DO(cps_set_facts(flat, 0, &facts, centre, NULL, &err));
    Result result = due(facts.outcome);
    if (result == ANSWERED && (!facts.has_dimension || facts.dimension >= n || facts.zero_interior))
        result = WRONG;
    if (result == ANSWERED)
        result = same(dot(n, u, centre), at, norm(n, u) * fmax(1, norm(n, centre)));
    if (result == ANSWERED) result = inside(sample->set, centre, fmax(1, norm(n, centre)));
    cps_set_release(plane);
    cps_set_release(flat);
    return result;
}

/* A + cone of one ray: endless along it, and a ray is given; the other way as A. */
static Result case_unbounded(int n, const Sample *sample) {
    double ray[MAX_SPACE], back[MAX_SPACE], x[MAX_SPACE];
    CpsSet *cone, *set, *form, *face = NULL;
    CpsSetAnswer up, down, of;
    fill(n, 1, ray);
    for (int i = 0; i < n; i++) back[i] = -ray[i];
    DO(cps_set_cone_of_rays(n, 1, ray, &cone, &err));
    DO(cps_set_sum(2, (const CpsSet *[]){sample->set, cone}, &set, &err));
    form = through_form(set);
    DO(cps_set_support(form, ray, x, &up, &err));
    DO(cps_set_face(form, ray, 0, &face, &of, &err));
    Result result = up.outcome == CPS_SET_OUTCOME_INACCURATE ? OPEN : ANSWERED;
    if (result == ANSWERED &&
        (up.outcome != CPS_SET_OUTCOME_UNBOUNDED || up.value != INFINITY || face))
        result = WRONG;
    if (result == ANSWERED && !(dot(n, x, ray) > 0.999 * norm(n, x) * norm(n, ray))) result = WRONG;
    DO(cps_set_support(form, back, NULL, &down, &err));
    DO(cps_set_support(sample->set, back, x, &of, &err));
    if (result == ANSWERED) result = compare(&down, &of, scale_of(sample->set, back, x));
    cps_set_release(cone);
    cps_set_release(set);
    cps_set_release(form);
    cps_set_release(face);
    return result;
}

/* A point or a segment, mapped and moved: its dimension, its ends. */
static Result case_thin(int n) {
    const int m = 1 + below(MAX_SPACE), count = 1 + below(2);
    double ends[2 * MAX_SPACE], mapped[2 * MAX_SPACE], map[MAX_SPACE * MAX_SPACE], w[MAX_SPACE],
        centre[MAX_SPACE];
    CpsSet *segment, *image, *form;
    CpsSetFacts facts;
    CpsSetAnswer h;
    fill(2 * m, 2, ends);
    fill(n * m, 1, map);
    fill(n, 1, w);
    for (int k = 0; k < 2; k++) times(n, m, map, 1, &ends[k * m], &mapped[k * n]);
    DO(cps_set_hull_of_points(m, count, ends, &segment, &err));
    DO(cps_set_image(n, map, segment, &image, &err));
    form = through_form(image);
    DO(cps_set_facts(form, 0, &facts, centre, NULL, &err));
    DO(cps_set_support(form, w, NULL, &h, &err));
    const double one = dot(n, w, mapped), two = count > 1 ? dot(n, w, mapped + n) : one;
    Result result = both(due(facts.outcome), due(h.outcome));
    if (result == ANSWERED) result = same(h.value, fmax(one, two), 4 * norm(n, w));
    if (result == ANSWERED && (facts.dimension != count - 1 || !facts.bounded)) result = WRONG;
    for (int i = 0; result == ANSWERED && i < n; i++)
        result = same(centre[i], 0.5 * (mapped[i] + mapped[(count - 1) * n + i]), 4);
    cps_set_release(segment);
    cps_set_release(image);
    cps_set_release(form);
    return result;
}

static Result case_degenerate(int n) {
    const int kind = below(4);
    if (kind == 3) return case_thin(n);
    const Sample sample = random_expression(n, 1 + below(MAX_DEPTH - 1), true);
    const Result result = kind == 0   ? case_empty(n, &sample)
                          : kind == 1 ? case_flat(n, &sample)
                                      : case_unbounded(n, &sample);
    cps_set_release(sample.set);
    return result;
}

int main(int argc, char **argv) {
    static const struct {
        const char *name;
        Result (*ask)(int n);
    } CASE[] = {{"form", case_form},         {"sum", case_sum},
                {"polar", case_polar},       {"face", case_face},
                {"facet", case_facet},       {"meet", case_meet},
                {"split", case_split},       {"moreau", case_moreau},
                {"project", case_project},   {"cone", case_cone},
                {"preimage", case_preimage}, {"degenerate", case_degenerate}};
    enum { KINDS = sizeof CASE / sizeof *CASE };
    uint64_t first = 1, count = 1000, tally[KINDS][4] = {{0}}, total[4] = {0};
    if (!random_cases(argc, argv, &first, &count)) {
        fprintf(stderr, "usage: random_sets [--cases N | --seed S]\n");
        return 2;
    }
    for (uint64_t seed = first; seed < first + count; seed++) {
        random_seed(seed);
        const int kind = (int)(seed % KINDS);
        const Result result = CASE[kind].ask(1 + below(MAX_SPACE));
        tally[kind][result]++;
        total[result]++;
        if (result == WRONG)
            printf("wrong: seed %llu (%s)\n", (unsigned long long)seed, CASE[kind].name);
        if (count == 1 && (result == OPEN || result == REFUSED))
            printf("%s\n", result == OPEN ? "open" : "refused");
    }
    printf("%10s %9s %9s %9s %9s\n", "case", "answered", "refused", "open", "wrong");
    for (int k = 0; k < KINDS; k++) {
        printf("%10s", CASE[k].name);
        for (int v = 0; v < 4; v++) printf(" %9llu", (unsigned long long)tally[k][v]);
        printf("\n");
    }
    const double share = 100 * (double)total[ANSWERED] / (double)count;
    printf("%llu cases, %.2f %% answered, %llu wrong; largest difference of values %.1e, of points "
           "%.1e\n",
           (unsigned long long)count, share, (unsigned long long)total[WRONG], worst[0], worst[1]);
    return total[WRONG] == 0 && (count == 1 || share >= 98) ? 0 : 1;
}
