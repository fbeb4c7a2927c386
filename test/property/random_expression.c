/* SPDX-License-Identifier: BSD-3-Clause */
/* Random set expressions with a known point (random_expression.h). */
#include "random_expression.h"
#include "splitmix.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- random numbers ---- */

static uint64_t state;

void random_seed(uint64_t number) { state = number * 0x2545f4914f6cdd1du + 1; }

double uniform(double low, double high) { return splitmix(&state, low, high); }

int below(int bound) { return (int)uniform(0, bound); }

void fill(int count, double size, double *out) {
    for (int i = 0; i < count; i++) out[i] = uniform(-size, size);
}

/* ---- vectors ---- */

double dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

double norm(int n, const double *a) { return sqrt(dot(n, a, a)); }

void times(int rows, int columns, const double *map, int sign, const double *x, double *out) {
    for (int i = 0; i < (sign > 0 ? rows : columns); i++) {
        out[i] = 0;
        for (int j = 0; j < (sign > 0 ? columns : rows); j++)
            out[i] += x[j] * (sign > 0 ? map[i * columns + j] : map[j * columns + i]);
    }
}

bool invert(int n, const double *matrix, double least, double *out) {
    double a[MAX_SPACE * MAX_SPACE];
    memcpy(a, matrix, (size_t)(n * n) * sizeof *a);
    const double size = norm(n * n, a);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) out[i * n + j] = i == j;
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(a[i * n + k]) > fabs(a[best * n + k])) best = i;
        for (int j = 0; j < n; j++) {
            const double keep = a[k * n + j], kept = out[k * n + j];
            a[k * n + j] = a[best * n + j];
            a[best * n + j] = keep;
            out[k * n + j] = out[best * n + j];
            out[best * n + j] = kept;
        }
        const double d = a[k * n + k];
        if (!(fabs(d) > least * size)) return false;
        for (int j = 0; j < n; j++) {
            a[k * n + j] /= d;
            out[k * n + j] /= d;
        }
        for (int i = 0; i < n; i++) {
            const double f = i == k ? 0 : a[i * n + k];
            for (int j = 0; j < n; j++) {
                a[i * n + j] -= f * a[k * n + j];
                out[i * n + j] -= f * out[k * n + j];
            }
        }
    }
    return true;
}

CpsError err;

void done_(CpsStatus status, const char *text, const char *file, int line) {
    if (!status) return;
    fprintf(stderr, "%s:%d: %s: %s\n", file, line, text, err.message);
    exit(2);
}

/* ---- primitives ---- */

/* 0 inside: a skew box and some more rows */
static CpsSet *polyhedron(int n) {
    double rows[(2 * MAX_SPACE + 3) * MAX_SPACE], offsets[2 * MAX_SPACE + 3];
    const int count = 2 * n + below(4);
    fill(count * n, 1, rows);
    for (int i = 0; i < 2 * n; i++)
        for (int j = 0; j < n; j++)
            rows[i * n + j] = (i / 2 == j) * (i & 1 ? -1 : 1) + 0.3 * rows[i * n + j];
    for (int i = 0; i < count; i++) offsets[i] = uniform(0.2, 2);
    CpsSet *set;
    DO(cps_set_inequalities(n, count, rows, offsets, &set, &err));
    return set;
}

/* the mean of points lies in the relative interior of their hull */
static CpsSet *polytope(int n, int count, double *inside) {
    double points[8 * MAX_SPACE];
    CpsSet *set;
    fill(count * n, 2, points);
    for (int i = 0; i < n; i++) {
        inside[i] = 0;
        for (int k = 0; k < count; k++) inside[i] += points[k * n + i] / count;
    }
    DO(cps_set_hull_of_points(n, count, points, &set, &err));
    return set;
}

static CpsSet *ellipsoid(int n, const double *centre) {
    double factor[MAX_SPACE * MAX_SPACE], shape[MAX_SPACE * MAX_SPACE];
    CpsSet *set;
    fill(n * n, 1, factor);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            shape[i * n + j] = dot(n, &factor[i * n], &factor[j * n]) + (i == j) * 0.2;
    DO(cps_set_ellipsoid(n, centre, shape, &set, &err));
    return set;
}

Sample random_primitive(int n, bool bounded) {
    double a[MAX_SPACE], b[MAX_SPACE * MAX_SPACE];
    Sample sample;
    double *inside = sample.inside;
    const int kind = below(bounded ? 7 : 11), count = below(n + 1);
    fill(n, 0.3, inside);
    fill(n * n, 1, b);
    switch (kind) {
    case 0: DO(cps_set_ball(n, inside, uniform(0.3, 2), &sample.set, &err)); break;
    case 1: sample.set = ellipsoid(n, inside); break;
    case 2: /* one side in ten is flat */
        for (int i = 0; i < n; i++) {
            const double half = below(10) ? uniform(0.1, 1) : 0;
            a[i] = inside[i] - half;
            b[i] = inside[i] + half;
        }
        DO(cps_set_box(n, a, b, &sample.set, &err));
        break;
    case 3: sample.set = polytope(n, 1 + below(8), inside); break;
    case 4: sample.set = polytope(n, 2, inside); break;
    case 5:
        memset(inside, 0, (size_t)n * sizeof *inside);
        sample.set = polyhedron(n);
        break;
    case 6: DO(cps_set_point(n, inside, &sample.set, &err)); break;
    case 7:
        DO(cps_set_half_space(n, b, dot(n, b, inside) + uniform(0.1, 1), &sample.set, &err));
        break;
    case 8: {
        const double most = dot(n, b, inside) + uniform(0.1, 1),
                     least = dot(n, b, inside) - uniform(0.1, 1);
        DO(cps_set_strip(n, b, least, most, &sample.set, &err));
        break;
    }
    default: /* the sum of its rays lies inside a cone */
        memset(inside, 0, (size_t)n * sizeof *inside);
        if (kind == 9)
            DO(cps_set_subspace(n, count, b, &sample.set, &err));
        else
            DO(cps_set_cone_of_rays(n, count, b, &sample.set, &err));
        for (int i = 0; i < count * n; i++) inside[i % n] += b[i];
        break;
    }
    return sample;
}

/* ---- operations ---- */

static void move_to(const double *to, Sample *part) {
    const int n = cps_set_space(part->set);
    double shift[MAX_SPACE];
    CpsSet *moved;
    for (int i = 0; i < n; i++) shift[i] = to[i] - part->inside[i];
    DO(cps_set_translate(shift, part->set, &moved, &err));
    cps_set_release(part->set);
    part->set = moved;
    memcpy(part->inside, to, (size_t)n * sizeof *to);
}

static Sample cut_with_ball(int n, Sample part) {
    Sample out = part;
    CpsSet *both[2] = {part.set, NULL};
    DO(cps_set_ball(n, part.inside, 3, &both[1], &err));
    DO(cps_set_intersection(2, (const CpsSet *const *)both, &out.set, &err));
    for (int k = 0; k < 2; k++) cps_set_release(both[k]);
    return out;
}

static Sample random_product(int n, int depth, bool bounded) {
    const int first = 1 + below(n - 1);
    const Sample one = random_expression(first, depth - 1, bounded),
                 two = random_expression(n - first, depth - 1, bounded);
    Sample out;
    DO(cps_set_product(2, (const CpsSet *[]){one.set, two.set}, &out.set, &err));
    for (int i = 0; i < n; i++) out.inside[i] = i < first ? one.inside[i] : two.inside[i - first];
    cps_set_release(one.set);
    cps_set_release(two.set);
    return out;
}

typedef CpsStatus Join(int count, const CpsSet *const *parts, CpsSet **out, CpsError *error);

static Sample random_join(Join *join, int n, int depth, bool bounded) {
    const bool closed = join == cps_set_hull; /* of unbounded sets only the closure is one */
    const int count = 2 + (below(4) == 0);
    Sample part[3], out = {.inside = {0}};
    CpsSet *parts[3];
    for (int k = 0; k < count; k++) {
        part[k] = random_expression(n, depth - 1, bounded || closed);
        if (join == cps_set_intersection && k > 0) move_to(part[0].inside, &part[k]);
        parts[k] = part[k].set;
        for (int i = 0; i < n; i++)
            out.inside[i] += part[k].inside[i] / (join == cps_set_sum ? 1 : count);
    }
    DO(join(count, (const CpsSet *const *)parts, &out.set, &err));
    for (int k = 0; k < count; k++) cps_set_release(parts[k]);
    return out;
}

static Sample random_map(int n, int depth, bool bounded, bool back) {
    const int m = 1 + below(MAX_SPACE);
    double map[MAX_SPACE * MAX_SPACE], shift[MAX_SPACE];
    const Sample part = random_expression(m, depth - 1, bounded);
    Sample out;
    fill(n * m, 1, map);
    if (back) { /* L inside + shift is the point of the part */
        fill(n, 0.3, out.inside);
        times(m, n, map, 1, out.inside, shift);
        for (int i = 0; i < m; i++) shift[i] = part.inside[i] - shift[i];
        DO(cps_set_preimage(n, map, shift, part.set, &out.set, &err));
    } else {
        times(n, m, map, 1, part.inside, out.inside);
        DO(cps_set_image(n, map, part.set, &out.set, &err));
    }
    cps_set_release(part.set);
    return back && bounded ? cut_with_ball(n, out) : out;
}

/* 0 is inside the polar of a bounded set */
static Sample random_polar(int n, int depth, bool bounded) {
    const Sample part = random_expression(n, depth - 1, true);
    Sample out = {.inside = {0}};
    DO(cps_set_polar(part.set, &out.set, &err));
    cps_set_release(part.set);
    return bounded ? cut_with_ball(n, out) : out;
}

Sample random_expression(int n, int depth, bool bounded) {
    if (depth == 0 || below(5) == 0) return random_primitive(n, bounded);
    double shift[MAX_SPACE];
    Sample out;
    CpsSet *part;
    switch (below(9)) {
    case 0:
        if (n > 1) return random_product(n, depth, bounded);
        return random_expression(n, depth - 1, bounded);
    case 1: return random_join(cps_set_intersection, n, depth, bounded);
    case 2: return random_join(cps_set_sum, n, depth, bounded);
    case 3: return random_join(cps_set_hull, n, depth, bounded);
    case 4: return random_map(n, depth, bounded, false);
    case 5: return random_map(n, depth, bounded, true);
    case 6: return random_polar(n, depth, bounded);
    case 7:
        out = random_expression(n, depth - 1, bounded);
        fill(n, 0.5, shift);
        for (int i = 0; i < n; i++) shift[i] += out.inside[i];
        move_to(shift, &out);
        return out;
    default: {
        out = random_expression(n, depth - 1, bounded);
        const double size = uniform(0.3, 2), factor = below(2) ? size : -size;
        part = out.set;
        DO(cps_set_scale(factor, part, &out.set, &err));
        cps_set_release(part);
        for (int i = 0; i < n; i++) out.inside[i] *= factor;
        return out;
    }
    }
}

CpsSet *random_round_zero(int n, int depth) {
    const double zero[MAX_SPACE] = {0};
    Sample part = random_expression(n, depth, true);
    move_to(zero, &part);
    CpsSet *ball, *sum;
    DO(cps_set_ball(n, NULL, uniform(0.1, 0.5), &ball, &err));
    DO(cps_set_sum(2, (const CpsSet *[]){part.set, ball}, &sum, &err));
    cps_set_release(part.set);
    cps_set_release(ball);
    return sum;
}

bool random_cases(int argc, char **argv, uint64_t *first, uint64_t *count) {
    if (argc != 3) return argc == 1;
    const unsigned long long number = strtoull(argv[2], NULL, 10);
    const bool one = strcmp(argv[1], "--seed") == 0;
    *first = one ? number : 1;
    *count = one ? 1 : number;
    return number > 0 && (one || strcmp(argv[1], "--cases") == 0);
}
