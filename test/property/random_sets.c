/* SPDX-License-Identifier: BSD-3-Clause */
/* Seeded random set expressions, depth <= 4 in R^n with n <= 6, against the identities of convex analysis.
 *                                                                           usage: random_sets FIRST_SEED COUNT
 *
 * Each case makes one expression and asks one question whose answer is known in a second way:
 *   form       support by the calculus = support by the conic form of the whole expression
 *   sum        h of a sum = sum of the h's, by the conic form
 *   polar      C°° = C for C with 0, and the gauge of C° = h
 *   face       <w, x> = h(w) on the face (Fenchel-Young), its points lie in C
 *   facet      a face of a face attains both directions, one after the other
 *   meet       the maximum over A ∩ B lies in both, and is below h_A(u) + h_B(w - u) for every u
 *   moreau     p = P_K p + P_K° p, orthogonal, for a cone K
 *   preimage   L^-1(C) for invertible L = image of C by the inverse; of a polyhedron = the rows times L
 *   cone       w in the normal cone at x exactly where x lies on the face of w
 *
 * A case ends answered, refused for a reason of the fixed list (empty, unbounded, ...; fine where both ways say the
 * same), or undecided (CPS_SET_INACCURATE). At least 98 % must not be undecided, and none may be wrong. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/set.h"

enum { MAX = 6, MOST = 64 };

typedef enum Verdict { ANSWERED, REFUSED, UNDECIDED, WRONG } Verdict;

static uint64_t state;

/* splitmix64 */
static double uniform(double low, double high) {
    uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return low + (high - low) * ((double)(z >> 11) * 0x1p-53);
}
static int below(int bound) { return (int)uniform(0, bound); }
static void fill(int count, double size, double *out) {
    for (int i = 0; i < count; i++) out[i] = uniform(-size, size);
}
static double dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}
static double norm(int n, const double *a) { return sqrt(dot(n, a, a)); }

/* A call that must work. */
#define DO(call) done_((call), #call, __LINE__)
static CpsError err;
static void done_(CpsStatus status, const char *text, int line) {
    if (!status) return;
    fprintf(stderr, "line %d: %s: %s\n", line, text, err.message);
    exit(2);
}

/* ---- random expressions; each returns a set with one hold ---- */

static CpsSet *polyhedron(int n) {
    double rows[MOST * MAX], offsets[MOST];
    const int count = 2 * n + below(4);
    fill(count * n, 1, rows);
    for (int i = 0; i < 2 * n; i++)
        for (int j = 0; j < n; j++) rows[i * n + j] = (i / 2 == j) * (i & 1 ? -1 : 1) + 0.3 * rows[i * n + j];
    for (int i = 0; i < count; i++) offsets[i] = uniform(0.2, 2);
    CpsSet *set;
    DO(cps_set_inequalities(n, count, rows, offsets, &set, &err));
    return set;
}

static CpsSet *primitive(int n, bool bounded) {
    double a[MAX * MAX], b[MAX * MAX], points[8 * MAX];
    CpsSet *set;
    fill(n, 0.3, a);
    switch (below(bounded ? 7 : 11)) {
    case 0:
        DO(cps_set_ball(n, a, uniform(0.3, 2), &set, &err));
        return set;
    case 1: {
        double shape[MAX * MAX];
        fill(n * n, 1, b);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) shape[i * n + j] = dot(n, &b[i * n], &b[j * n]) + (i == j) * 0.2;
        DO(cps_set_ellipsoid(n, a, shape, &set, &err));
        return set;
    }
    case 2:
        for (int i = 0; i < n; i++) b[i] = a[i] + uniform(0, 1.5), a[i] -= uniform(0, 1.5);
        DO(cps_set_box(n, a, b, &set, &err));
        return set;
    case 3: {
        const int count = 1 + below(8);
        fill(count * n, 2, points);
        DO(cps_set_hull_of_points(n, count, points, &set, &err));
        return set;
    }
    case 4:
        fill(n, 2, b);
        DO(cps_set_segment(n, a, b, &set, &err));
        return set;
    case 5:
        return polyhedron(n);
    case 6:
        DO(cps_set_point(n, a, &set, &err));
        return set;
    case 7:
        DO(cps_set_half_space(n, (fill(n, 1, b), b), uniform(0.1, 1), &set, &err));
        return set;
    case 8:
        DO(cps_set_strip(n, (fill(n, 1, b), b), -uniform(0, 1), uniform(0, 1), &set, &err));
        return set;
    case 9:
        DO(cps_set_subspace(n, below(n + 1), (fill(n * n, 1, b), b), &set, &err));
        return set;
    default:
        DO(cps_set_cone_of_rays(n, below(n + 1), (fill(n * n, 1, b), b), &set, &err));
        return set;
    }
}

static CpsSet *expression(int n, int depth, bool bounded) {
    if (depth == 0 || below(5) == 0) return primitive(n, bounded);
    double map[MAX * MAX], shift[MAX];
    CpsSet *part[2] = {NULL, NULL}, *set = NULL;
    const CpsSet *const *parts = (const CpsSet *const *)part;
    const int m = 1 + below(MAX), kind = below(bounded ? 7 : 9);
    fill(MAX * MAX, 1, map);
    fill(MAX, 0.3, shift);
    switch (kind) {
    case 0:
        if (n == 1) return expression(n, depth - 1, bounded);
        part[0] = expression(n / 2, depth - 1, bounded), part[1] = expression(n - n / 2, depth - 1, bounded);
        DO(cps_set_product(2, parts, &set, &err));
        break;
    case 1:
        part[0] = expression(n, depth - 1, bounded), part[1] = expression(n, depth - 1, bounded);
        DO(cps_set_intersection(2, parts, &set, &err));
        break;
    case 2:
        part[0] = expression(n, depth - 1, bounded), part[1] = expression(n, depth - 1, bounded);
        DO(cps_set_sum(2, parts, &set, &err));
        break;
    case 3:
        part[0] = expression(m, depth - 1, bounded);
        DO(cps_set_image(n, map, part[0], &set, &err));
        break;
    case 4:
        part[0] = expression(n, depth - 1, bounded);
        DO(cps_set_translate(shift, part[0], &set, &err));
        break;
    case 5:
        part[0] = expression(n, depth - 1, bounded);
        DO(cps_set_scale(uniform(-2, 2), part[0], &set, &err));
        break;
    case 6:
        part[0] = expression(n, depth - 1, true), part[1] = expression(n, depth - 1, true);
        DO(cps_set_hull(2, parts, &set, &err));
        break;
    case 7:
        part[0] = expression(m, depth - 1, bounded);
        DO(cps_set_preimage(n, map, shift, part[0], &set, &err));
        break;
    default:
        part[0] = expression(n, depth - 1, bounded);
        DO(cps_set_polar(part[0], &set, &err));
        break;
    }
    cps_set_release(part[0]);
    cps_set_release(part[1]);
    return set;
}

/* The same set, asked through the conic form of the whole. */
static CpsSet *through_form(const CpsSet *set) {
    CpsSet *out;
    DO(cps_set_intersection(1, &set, &out, &err));
    return out;
}

/* A bounded expression with 0 well inside. */
static CpsSet *round_zero(int n, int depth) {
    CpsSet *part[2] = {expression(n, depth, true), NULL}, *set;
    DO(cps_set_ball(n, NULL, uniform(0.1, 0.5), &part[1], &err));
    DO(cps_set_sum(2, (const CpsSet *const *)part, &set, &err));
    CpsSetAnswer answer;
    const double zero[MAX] = {0};
    DO(cps_set_contains(set, zero, NULL, &answer, &err));
    cps_set_release(part[0]);
    if (answer.outcome != CPS_SET_ANSWERED || answer.value < 0.02) {
        cps_set_release(set);
        set = cps_set_retain(part[1]);
    }
    cps_set_release(part[1]);
    return set;
}

/* ---- comparing ---- */

static double worst[2]; /* largest difference seen: of values, of points */

/* What differences are measured by: the direction's and the set's size. */
static double scale_of(const CpsSet *set, const double *w) {
    const int n = cps_set_space(set);
    double size = 1, axis[MAX] = {0};
    for (int i = 0; i < n; i++) {
        CpsSetExtent extent;
        axis[i] = 1;
        DO(cps_set_extent(set, axis, &extent, &err));
        axis[i] = 0;
        if (isfinite(extent.low)) size = fmax(size, fabs(extent.low));
        if (isfinite(extent.high)) size = fmax(size, fabs(extent.high));
    }
    return size * (w ? norm(n, w) : 1);
}

static Verdict same(double a, double b, double scale) {
    const double off = fabs(a - b) / scale;
    if (a == b) return ANSWERED;
    if (off > worst[0]) worst[0] = off;
    return off <= 1e-8 ? ANSWERED : WRONG; /* two answers to 1e-9 each, the scale a rough one */
}

/* Two answers to one question. */
static Verdict compare(const CpsSetAnswer *a, const CpsSetAnswer *b, double scale) {
    if (a->outcome == CPS_SET_INACCURATE || b->outcome == CPS_SET_INACCURATE) return UNDECIDED;
    if (a->outcome != b->outcome) return WRONG;
    return a->outcome == CPS_SET_ANSWERED ? same(a->value, b->value, scale) : REFUSED;
}

static Verdict inside(const CpsSet *set, const double *x, double scale) {
    CpsSetAnswer answer;
    double nearest[MAX];
    DO(cps_set_project(set, x, NULL, nearest, &answer, &err));
    if (answer.outcome == CPS_SET_INACCURATE) return UNDECIDED;
    if (answer.outcome != CPS_SET_ANSWERED) return WRONG;
    if (answer.value / scale > worst[1]) worst[1] = answer.value / scale;
    return answer.value <= 1e-6 * scale ? ANSWERED : WRONG; /* points are known to the root of the gap */
}

/* ---- cases ---- */

static Verdict case_form(int n, const double *w) {
    CpsSet *set = expression(n, 1 + below(4), false), *form = through_form(set);
    CpsSetAnswer a, b;
    DO(cps_set_support(set, w, NULL, &a, &err));
    DO(cps_set_support(form, w, NULL, &b, &err));
    const Verdict verdict = compare(&a, &b, scale_of(set, w));
    cps_set_release(set), cps_set_release(form);
    return verdict;
}

static Verdict case_sum(int n, const double *w) {
    CpsSet *part[2] = {expression(n, below(3), false), expression(n, below(3), false)}, *set, *form;
    DO(cps_set_sum(2, (const CpsSet *const *)part, &set, &err));
    form = through_form(set);
    CpsSetAnswer a, b, c;
    DO(cps_set_support(part[0], w, NULL, &a, &err));
    DO(cps_set_support(part[1], w, NULL, &b, &err));
    DO(cps_set_support(form, w, NULL, &c, &err));
    Verdict verdict = REFUSED;
    if (a.outcome == CPS_SET_INACCURATE || b.outcome == CPS_SET_INACCURATE)
        verdict = UNDECIDED;
    else if (a.outcome == CPS_SET_ANSWERED && b.outcome == CPS_SET_ANSWERED) {
        a.value += b.value;
        verdict = compare(&a, &c, scale_of(set, w));
    }
    cps_set_release(part[0]), cps_set_release(part[1]), cps_set_release(set), cps_set_release(form);
    return verdict;
}

static Verdict case_polar(int n, const double *w) {
    CpsSet *set = round_zero(n, below(3)), *polar, *twice;
    DO(cps_set_polar(set, &polar, &err));
    DO(cps_set_polar(polar, &twice, &err));
    CpsSetAnswer a, b, gauge;
    DO(cps_set_support(set, w, NULL, &a, &err));
    DO(cps_set_support(twice, w, NULL, &b, &err));
    DO(cps_set_gauge(polar, w, &gauge, &err));
    const double scale = scale_of(set, w);
    Verdict verdict = compare(&a, &b, scale);
    if (verdict == ANSWERED) verdict = compare(&a, &gauge, scale);
    cps_set_release(set), cps_set_release(polar), cps_set_release(twice);
    return verdict;
}

/* The face of w, and the answers on it; NULL with the verdict where there is none. */
static CpsSet *face_at(const CpsSet *set, const double *w, CpsSetAnswer *answer, Verdict *verdict) {
    CpsSet *face = NULL;
    DO(cps_set_face(set, w, 0, &face, answer, &err));
    if (!face) *verdict = answer->outcome == CPS_SET_INACCURATE ? UNDECIDED : REFUSED;
    return face;
}

/* Does the centre of the face attain h(w) in the set? */
static Verdict attains(const CpsSet *set, const CpsSet *face, const double *w, double h, double scale, double *center) {
    CpsSetFacts facts;
    DO(cps_set_facts(face, 0, &facts, center, NULL, &err));
    if (facts.outcome == CPS_SET_INACCURATE) return UNDECIDED;
    if (facts.outcome != CPS_SET_ANSWERED) return WRONG;
    const double far = fmax(1, norm(cps_set_space(set), center)); /* unbounded faces have far centres */
    const Verdict verdict = same(dot(cps_set_space(set), w, center), h, scale * far);
    return verdict == ANSWERED ? inside(set, center, scale / norm(cps_set_space(set), w) * far) : verdict;
}

/* Directions along which edges lie too, half of the time. */
static void special(int n, double *w) {
    if (below(2)) return;
    memset(w, 0, (size_t)n * sizeof *w);
    w[below(n)] = below(2) ? 1 : -1;
}

static Verdict case_face(int n, double *w) {
    CpsSet *set = expression(n, 1 + below(4), false);
    CpsSetAnswer answer;
    Verdict verdict = WRONG;
    double center[MAX];
    special(n, w);
    CpsSet *face = face_at(set, w, &answer, &verdict);
    if (face) verdict = attains(set, face, w, answer.value, scale_of(set, w), center);
    cps_set_release(set), cps_set_release(face);
    return verdict;
}

static Verdict case_facet(int n, double *w) {
    CpsSet *set = expression(n, 1 + below(3), false), *second = NULL;
    CpsSetAnswer one, two;
    Verdict verdict = WRONG;
    double center[MAX], u[MAX];
    special(n, w);
    fill(n, 1, u);
    CpsSet *face = face_at(set, w, &one, &verdict);
    if (face) second = face_at(face, u, &two, &verdict);
    if (second) {
        verdict = attains(face, second, u, two.value, scale_of(set, u), center);
        if (verdict == ANSWERED)
            verdict = same(dot(n, w, center), one.value, scale_of(set, w) * fmax(1, norm(n, center)));
    }
    cps_set_release(set), cps_set_release(face), cps_set_release(second);
    return verdict;
}

static Verdict case_meet(int n, const double *w) {
    CpsSet *part[2] = {expression(n, below(3), false), expression(n, below(3), false)}, *set;
    DO(cps_set_intersection(2, (const CpsSet *const *)part, &set, &err));
    CpsSetAnswer h;
    double x[MAX], u[MAX], v[MAX];
    DO(cps_set_support(set, w, x, &h, &err));
    Verdict verdict = h.outcome == CPS_SET_INACCURATE ? UNDECIDED : h.outcome == CPS_SET_ANSWERED ? ANSWERED : REFUSED;
    if (verdict == ANSWERED) {
        const double scale = scale_of(set, w);
        for (int k = 0; k < 2 && verdict == ANSWERED; k++) verdict = inside(part[k], x, scale / norm(n, w));
        for (int k = 0; k < 8 && verdict == ANSWERED; k++) {
            CpsSetAnswer a, b;
            fill(n, k < 4 ? 1 : 0.1, u);
            if (k == 0) memcpy(u, w, (size_t)n * sizeof *u);
            for (int i = 0; i < n; i++) v[i] = k == 1 ? w[i] : w[i] - u[i], u[i] = k == 1 ? 0 : u[i];
            DO(cps_set_support(part[0], u, NULL, &a, &err));
            DO(cps_set_support(part[1], v, NULL, &b, &err));
            if (a.outcome != CPS_SET_ANSWERED || b.outcome != CPS_SET_ANSWERED) continue;
            if (h.value > a.value + b.value + 1e-8 * scale) verdict = WRONG;
        }
    }
    cps_set_release(part[0]), cps_set_release(part[1]), cps_set_release(set);
    return verdict;
}

static Verdict case_moreau(int n, const double *p) {
    double rays[MOST * MAX], x[MAX], y[MAX], sum[MAX];
    const int count = below(2 * n + 1);
    fill(count * n, 1, rays);
    CpsSet *cone, *polar;
    DO(cps_set_cone_of_rays(n, count, rays, &cone, &err));
    DO(cps_set_polar(cone, &polar, &err));
    CpsSetAnswer a, b;
    DO(cps_set_project(cone, p, NULL, x, &a, &err));
    DO(cps_set_project(polar, p, NULL, y, &b, &err));
    Verdict verdict = UNDECIDED;
    if (a.outcome == CPS_SET_ANSWERED && b.outcome == CPS_SET_ANSWERED) {
        for (int i = 0; i < n; i++) sum[i] = x[i] + y[i] - p[i];
        verdict = norm(n, sum) <= 1e-6 * norm(n, p) ? same(dot(n, x, y), 0, 1e2 * dot(n, p, p)) : WRONG;
        if (verdict == ANSWERED) verdict = same(a.value * a.value + b.value * b.value, dot(n, p, p), dot(n, p, p));
    } else if (a.outcome != CPS_SET_INACCURATE && b.outcome != CPS_SET_INACCURATE)
        verdict = WRONG;
    cps_set_release(cone), cps_set_release(polar);
    return verdict;
}

/* Gauss-Jordan on a diagonally dominant matrix. */
static void invert(int n, double *a, double *out) {
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) out[i * n + j] = i == j;
    for (int k = 0; k < n; k++) {
        const double d = a[k * n + k];
        for (int j = 0; j < n; j++) a[k * n + j] /= d, out[k * n + j] /= d;
        for (int i = 0; i < n; i++) {
            const double f = i == k ? 0 : a[i * n + k];
            for (int j = 0; j < n; j++) a[i * n + j] -= f * a[k * n + j], out[i * n + j] -= f * out[k * n + j];
        }
    }
}

static Verdict case_preimage(int n, const double *w) {
    double map[MAX * MAX], copy[MAX * MAX], inverse[MAX * MAX];
    fill(n * n, 0.8 / n, map);
    for (int i = 0; i < n; i++) map[i * n + i] += below(2) ? 1 : -1;
    memcpy(copy, map, sizeof map);
    invert(n, copy, inverse);
    CpsSet *set = expression(n, below(4), false), *pre, *image;
    DO(cps_set_preimage(n, map, NULL, set, &pre, &err));
    DO(cps_set_image(n, inverse, set, &image, &err));
    CpsSetAnswer a, b;
    DO(cps_set_support(pre, w, NULL, &a, &err));
    DO(cps_set_support(image, w, NULL, &b, &err));
    const Verdict verdict = compare(&a, &b, scale_of(set, w));
    cps_set_release(set), cps_set_release(pre), cps_set_release(image);
    return verdict;
}

static Verdict case_cone(int n, double *w) {
    CpsSet *set = expression(n, 1 + below(3), true), *cone = NULL;
    CpsSetAnswer h, at, in;
    double x[MAX], nearest[MAX];
    special(n, w);
    DO(cps_set_support(set, w, x, &h, &err));
    Verdict verdict = h.outcome == CPS_SET_INACCURATE ? UNDECIDED : REFUSED;
    if (h.outcome == CPS_SET_ANSWERED) {
        DO(cps_set_normal_cone(set, x, 1e-7, &cone, &at, &err));
        verdict = at.outcome == CPS_SET_INACCURATE ? UNDECIDED : at.outcome == CPS_SET_ANSWERED ? ANSWERED : WRONG;
    }
    if (verdict == ANSWERED) {
        DO(cps_set_project(cone, w, NULL, nearest, &in, &err));
        verdict = in.outcome == CPS_SET_INACCURATE ? UNDECIDED : in.outcome == CPS_SET_ANSWERED ? ANSWERED : WRONG;
        /* x is on the face to the root of the gap, so the cone's rays turn by as much */
        if (verdict == ANSWERED && in.value > 1e-4 * norm(n, w)) verdict = WRONG;
    }
    cps_set_release(set), cps_set_release(cone);
    return verdict;
}

int main(int argc, char **argv) {
    static const char *const NAME[] = {"form", "sum", "polar", "face", "facet", "meet", "moreau", "preimage", "cone"};
    enum { KINDS = sizeof NAME / sizeof *NAME };
    const unsigned long first = argc > 1 ? strtoul(argv[1], NULL, 10) : 1,
                        count = argc > 2 ? strtoul(argv[2], NULL, 10) : 1000;
    unsigned long tally[KINDS][4] = {{0}}, total[4] = {0};
    for (unsigned long seed = first; seed < first + count; seed++) {
        state = seed * 0x2545f4914f6cdd1du;
        const int kind = (int)(seed % KINDS), n = 1 + below(MAX);
        double w[MAX];
        fill(MAX, 1, w);
        Verdict verdict = WRONG;
        switch (kind) {
        case 0:
            verdict = case_form(n, w);
            break;
        case 1:
            verdict = case_sum(n, w);
            break;
        case 2:
            verdict = case_polar(n, w);
            break;
        case 3:
            verdict = case_face(n, w);
            break;
        case 4:
            verdict = case_facet(n, w);
            break;
        case 5:
            verdict = case_meet(n, w);
            break;
        case 6:
            verdict = case_moreau(n, w);
            break;
        case 7:
            verdict = case_preimage(n, w);
            break;
        default:
            verdict = case_cone(n, w);
            break;
        }
        tally[kind][verdict]++;
        total[verdict]++;
        if (verdict == WRONG) printf("wrong: seed %lu (%s)\n", seed, NAME[kind]);
        if (verdict == UNDECIDED && argc > 3) printf("undecided: seed %lu (%s)\n", seed, NAME[kind]);
    }
    printf("%10s %9s %9s %9s %9s\n", "case", "answered", "refused", "undecided", "wrong");
    for (int k = 0; k < KINDS; k++)
        printf("%10s %9lu %9lu %9lu %9lu\n", NAME[k], tally[k][0], tally[k][1], tally[k][2], tally[k][3]);
    const double share = 100 - 100 * (double)total[UNDECIDED] / (double)count;
    printf("%lu cases, %.2f %% decided, %lu wrong; largest difference of values %.1e, of points %.1e\n", count, share,
           total[WRONG], worst[0], worst[1]);
    return total[WRONG] == 0 && share >= 98 ? 0 : 1;
}
