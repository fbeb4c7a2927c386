/* SPDX-License-Identifier: BSD-3-Clause */
/* Area and perimeter of planar sets.
 *
 * Closed forms: a translate, scale or similar image has those of its part, times the factor;
 * polygons given by their points; a disc, also cut by parallel lines; an ellipse of half axes
 * a >= b, whose perimeter is 4 a E(k), k^2 = 1 - (b/a)^2 (elliptic.h). For all other sets the
 * outline is followed once round (outline.h), after an affine map that makes thin sets round.
 * Corners and edges are a polygon. An arc from x at angle a to y at b has, with the origin inside,
 * h its support function and h' = <w', x> (Cauchy; Santalo 1976, I.1),
 *
 *     sector = 1/2 integral of (h^2 - h'^2) + 1/2 [h h'],      length = integral of h + [h'],
 *
 * by Gauss-Legendre quadrature with halving. An interval too short to be distinguished from a
 * corner counts as its chord. Its boundary lies in the triangle of its chord and tangents, which
 * bounds the error. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "linalg/dense.h"
#include "linalg/elliptic.h"
#include "linalg/gauss.h"
#include "set/outline.h"

static bool going(const CpsiWalk *walk) {
    return walk->status == CPS_OK && walk->outcome == CPS_SET_OUTCOME_ANSWERED;
}

static double cross(const double x[2], const double y[2]) { return x[0] * y[1] - x[1] * y[0]; }

static bool exactly(CpsSetMeasure *measure, double area, double perimeter) {
    *measure = (CpsSetMeasure){.outcome = CPS_SET_OUTCOME_ANSWERED,
                               .exact = true,
                               .area = area,
                               .perimeter = perimeter};
    return true;
}

/* ---- closed forms ---- */

static bool ellipse(const CpsSet *set, CpsSetMeasure *measure) {
    /* The inverse of S's lower Cholesky factor has 1/sqrt(det S) on its diagonal. A product of
     * entries overflows only where the axes do. */
    const double *s = set->b, half = 0.5 * s[0] + 0.5 * s[3],
                 off = hypot(0.5 * s[0] - 0.5 * s[3], s[1]);
    const double a = sqrt(half + off), b = 1 / set->c[0] / a / set->c[3];
    if (!(b > 0)) return false;
    const double ratio = fmin(b / a, 1);
    return exactly(measure, CPSI_PI * a * b,
                   4 * a * cpsi_elliptic(sqrt((1 - ratio) * (1 + ratio)), ratio).e);
}

/* A disc of radius r between the lines at low and high from its centre. */
static bool cut_disc(double r, double low, double high, CpsSetMeasure *measure) {
    const double from = fmax(-1, low / r), to = fmin(1, high / r);
    if (!(r > 0) || !(from < to)) return false;
    const double c = sqrt((1 - from) * (1 + from)), d = sqrt((1 - to) * (1 + to));
    const double turn = atan2(to, d) - atan2(from, c);
    return exactly(measure, r * r * (turn + to * d - from * c), 2 * r * (turn + c + d));
}

/* a disc and a half-plane or strip, in either order */
static bool wheel(const CpsSet *set, CpsSetMeasure *measure) {
    if (set->count != 2) return false;
    const bool first = set->part[0]->kind == CPSI_SET_BALL;
    const CpsSet *disc = set->part[!first], *strip = set->part[first];
    if (disc->kind != CPSI_SET_BALL || strip->kind != CPSI_SET_INEQUALITIES || strip->count > 2)
        return false;
    const double *a = strip->a;
    if (strip->count == 2 && (a[0] != -a[2] || a[1] != -a[3])) return false;
    const double size = hypot(a[0], a[1]), at = cpsi_dot(2, a, disc->a);
    const double low = strip->count == 2 ? (-strip->b[1] - at) / size : -INFINITY;
    return cut_disc(disc->scalar, low, (strip->b[0] - at) / size, measure);
}

static int by_place(const void *one, const void *other) {
    const double *x = one, *y = other;
    if (x[0] != y[0]) return x[0] < y[0] ? -1 : 1;
    return (x[1] > y[1]) - (x[1] < y[1]);
}

/* Length and area of one side of the hull of sorted points, traversed with `step`: the monotone
 * chain (Andrew 1979). */
static void chain(int count, const double *point, int step, double *hull, CpsSetMeasure *measure) {
    int top = 0;
    for (int k = 0; k < count; k++) {
        const double *next = &point[2 * (step > 0 ? k : count - 1 - k)];
        for (; top >= 2; top--) {
            const double *p = &hull[2 * (top - 2)], u[2] = {p[2] - p[0], p[3] - p[1]},
                         v[2] = {next[0] - p[0], next[1] - p[1]};
            if (cross(u, v) > 0) break;
        }
        memcpy(&hull[2 * top++], next, 2 * sizeof *hull);
    }
    for (int k = 1; k < top; k++) {
        const double *p = &hull[2 * (k - 1)], u[2] = {p[0] - point[0], p[1] - point[1]},
                     v[2] = {p[2] - point[0], p[3] - point[1]};
        measure->perimeter += hypot(p[2] - p[0], p[3] - p[1]);
        measure->area += 0.5 * cross(u, v);
    }
}

static CpsStatus polygon(const CpsSet *set, CpsSetMeasure *measure, CpsError *err) {
    const size_t count = (size_t)set->count;
    double *point = malloc(4 * count * sizeof *point);
    if (!point) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the outline of a set");
    memcpy(point, set->a, 2 * count * sizeof *point);
    qsort(point, count, 2 * sizeof *point, by_place);
    exactly(measure, 0, 0);
    chain(set->count, point, 1, point + 2 * count, measure);
    chain(set->count, point, -1, point + 2 * count, measure);
    measure->area = fmax(measure->area, 0);
    free(point);
    return CPS_OK;
}

static bool closed(const CpsSet *set, CpsSetMeasure *measure) {
    switch (set->kind) {
    case CPSI_SET_BALL:
        return exactly(measure, CPSI_PI * set->scalar * set->scalar, 2 * CPSI_PI * set->scalar);
    case CPSI_SET_ELLIPSOID: return ellipse(set, measure);
    case CPSI_SET_BOX: {
        const double a = set->b[0] - set->a[0], b = set->b[1] - set->a[1];
        return isfinite(a) && isfinite(b) && exactly(measure, a * b, 2 * (a + b));
    }
    case CPSI_SET_INTERSECTION: return wheel(set, measure);
    default: return false;
    }
}

/* The factor between a set and its one part where the two are similar; 0 where they are not. */
static double likeness(const CpsSet *set) {
    const double *m = set->a;
    double rows, product, columns;
    switch (set->kind) {
    case CPSI_SET_TRANSLATE: return 1;
    case CPSI_SET_SCALE: return fabs(set->scalar);
    case CPSI_SET_IMAGE:
    case CPSI_SET_PREIMAGE:
        if (set->n != 2 || set->part[0]->n != 2) return 0;
        /* rows of one length and normal to each other, up to rounding */
        rows = hypot(m[0], m[1]);
        columns = hypot(m[2], m[3]);
        product = m[0] / rows * (m[2] / columns) + m[1] / rows * (m[3] / columns);
        if (!(rows > 0) || !(fabs(rows - columns) <= 1e-15 * rows) || !(fabs(product) <= 1e-15))
            return 0;
        return set->kind == CPSI_SET_IMAGE ? rows : 1 / rows;
    default: return 0;
    }
}

/* ---- along the outline ---- */

/* Choose the map so that the image of the set is as wide as it is high: the longest chord found and
 * its normal become the axes. This is repeated in the new axes until no two widths differ much. */
static void make_round(CpsiWalk *walk) {
    enum { LOOKS = 8, ROUNDS = 12 };
    const double size = walk->size;
    for (int round = 0; round < ROUNDS && going(walk); round++) {
        double most = 0, least = INFINITY, chord[2] = {1, 0}, x[2], y[2], width[2];
        for (int k = 0; k < LOOKS; k++) {
            const double theta = k * CPSI_PI / (double)LOOKS,
                         across = cpsi_walk_visit(walk, theta, x) +
                                  cpsi_walk_visit(walk, theta + CPSI_PI, y);
            least = fmin(least, across);
            if (across > most) {
                most = across;
                chord[0] = x[0] - y[0];
                chord[1] = x[1] - y[1];
            }
        }
        if (!going(walk) || (round > 0 && most < 4 * least)) break;
        const double theta = atan2(chord[1], chord[0]), c = cos(theta), s = sin(theta);
        for (int k = 0; k < 2; k++)
            width[k] = cpsi_walk_visit(walk, theta + 0.5 * k * CPSI_PI, x) +
                       cpsi_walk_visit(walk, theta + (0.5 * k + 1) * CPSI_PI, y);
        if (!(width[0] > 0 && width[1] > 0)) break;
        const double turn[4] = {walk->turn[0], walk->turn[1], walk->turn[2], walk->turn[3]};
        for (int j = 0; j < 2; j++) {
            walk->turn[j] = 2 / width[0] * (c * turn[j] + s * turn[2 + j]);
            walk->turn[2 + j] = 2 / width[1] * (c * turn[2 + j] - s * turn[j]);
        }
    }
    /* Features smaller than the rounding of the data, or than the error of a conic solution, are
     * not features of the set. */
    const double *t = walk->turn, grown = hypot(hypot(t[0], t[1]), hypot(t[2], t[3])) * size;
    walk->size = fmax(1, (walk->exact ? 1e-6 : 1e-4) * grown);
}

/* Properties of the map. */
typedef struct Seen {
    double determinant, back[4]; /* of the map; entries of its inverse */
    double longest, shortest;    /* largest and smallest factor by which the inverse stretches */
} Seen;

static Seen see(const CpsiWalk *walk) {
    const double *t = walk->turn, d = t[0] * t[3] - t[1] * t[2];
    Seen seen = {d, {t[3] / d, -t[1] / d, -t[2] / d, t[0] / d}, 0, 0};
    const double *b = seen.back;
    seen.longest = 0.5 * (hypot(b[0] + b[3], b[2] - b[1]) +
                          hypot(b[0] - b[3], b[2] + b[1])); /* singular values */
    seen.shortest = 1 / d / seen.longest;
    return seen;
}

static double length_back(const Seen *seen, const double x[2], const double y[2]) {
    const double d[2] = {y[0] - x[0], y[1] - x[1]};
    return hypot(seen->back[0] * d[0] + seen->back[1] * d[1],
                 seen->back[2] * d[0] + seen->back[3] * d[1]);
}

/* The integrand over the normal angle of the mapped set. */
static double integrand(CpsiWalk *walk, bool area, double theta) {
    double x[2];
    const double h = cpsi_walk_visit(walk, theta, x), slope = cos(theta) * x[1] - sin(theta) * x[0];
    return area ? 0.5 * (h * h - slope * slope) : h;
}

/* Gauss-Legendre with eight points from a to b. */
static double gauss(CpsiWalk *walk, bool area, double a, double b) {
    double sum = 0;
    for (int k = 0; k < CPSI_GAUSS; k++) {
        /* from the middle outwards, right and left in turn */
        const int i = CPSI_GAUSS / 2 + (k & 1 ? -1 - k / 2 : k / 2);
        sum += 0.5 * (b - a) * CPSI_GAUSS_WEIGHT[i] *
               integrand(walk, area, 0.5 * (a + b) + 0.5 * (b - a) * CPSI_GAUSS_NODE[i]);
    }
    return sum;
}

/* Adaptive halving; `unit` is the size that the error is relative to, for a whole turn. */
static double integrate(CpsiWalk *walk, bool area, double a, double b, double whole, double unit,
                        int depth, double *gap) {
    if (!going(walk)) return 0;
    const double m = 0.5 * (a + b), left = gauss(walk, area, a, m), right = gauss(walk, area, m, b),
                 off = fabs(left + right - whole);
    if (depth > 0 && off > 1e-13 * unit * (b - a) + 1e-15 * unit &&
        walk->looks < 2 * CPSI_MOST_LOOKS)
        return integrate(walk, area, a, m, left, unit, depth - 1, gap) +
               integrate(walk, area, m, b, right, unit, depth - 1, gap);
    *gap += off;
    return left + right;
}

/* An arc: its sector in the image, and its length in the original plane, from one true normal angle
 * to the other. */
static void along_arc(CpsiWalk *walk, const Seen *seen, const CpsiOutlinePiece *piece,
                      CpsSetMeasure *measure) {
    enum { DEPTH = 40 };
    double turn[4], w[2][2], angle[2], slope[2];
    const double size = walk->size, *t = walk->turn, *back = seen->back;
    for (int end = 0; end < 2; end++) {
        const double theta = end ? piece->to : piece->from, *x = end ? piece->y : piece->x;
        const double c = cos(theta), s = sin(theta),
                     p[2] = {back[0] * x[0] + back[1] * x[1], back[2] * x[0] + back[3] * x[1]};
        w[end][0] = t[0] * c + t[2] * s;
        w[end][1] = t[1] * c + t[3] * s;
        angle[end] = atan2(w[end][1], w[end][0]);
        slope[end] = cross(w[end], p) / hypot(w[end][0], w[end][1]);
        measure->area += (end ? 0.5 : -0.5) * (c * x[0] + s * x[1]) * (c * x[1] - s * x[0]);
    }
    if (angle[1] < angle[0]) angle[1] += 2 * CPSI_PI;
    measure->area +=
        integrate(walk, true, piece->from, piece->to, gauss(walk, true, piece->from, piece->to),
                  size * size, DEPTH, &measure->area_gap);
    memcpy(turn, t, sizeof turn);
    memcpy(walk->turn, (const double[]){1, 0, 0, 1}, sizeof turn);
    measure->perimeter +=
        slope[1] - slope[0] +
        integrate(walk, false, angle[0], angle[1], gauss(walk, false, angle[0], angle[1]),
                  seen->longest * size, DEPTH, &measure->perimeter_gap);
    memcpy(walk->turn, turn, sizeof turn);
}

static void along_piece(CpsiWalk *walk, const Seen *seen, const CpsiOutlinePiece *piece,
                        CpsSetMeasure *measure) {
    const double *x = piece->x, *y = piece->y, a = piece->from, b = piece->to;
    if (piece->kind == CPSI_PIECE_ARC ||
        (piece->kind == CPSI_PIECE_SHORT && b - a > walk->opening)) {
        along_arc(walk, seen, piece, measure);
        return;
    }
    const double chord = length_back(seen, x, y);
    measure->perimeter += chord;
    measure->area += 0.5 * cross(x, y);
    if (piece->kind == CPSI_PIECE_CORNER) {
        /* a path that turns by at most an eighth of a circle between two of its points is at most a
         * tenth longer than its chord */
        measure->perimeter_gap += (1.1 * seen->longest - seen->shortest) * piece->drift;
        measure->area_gap += piece->drift * piece->drift;
        return;
    }
    /* The intersection of the tangents bounds the length; the distance from the chord is also at
     * most the drift. */
    const double d[2] = {y[0] - x[0], y[1] - x[1]},
                 along = (cos(b) * d[0] + sin(b) * d[1]) / sin(b - a);
    const double meet[2] = {x[0] - along * sin(a), x[1] + along * cos(a)},
                 e[2] = {meet[0] - x[0], meet[1] - x[1]};
    const double excess = fmax(0, length_back(seen, x, meet) + length_back(seen, meet, y) - chord);
    measure->perimeter_gap += fmin(excess, 2 * seen->longest * piece->drift);
    measure->area_gap += fmin(fabs(0.5 * cross(e, d)), piece->drift * hypot(d[0], d[1]));
}

static void along_outline(CpsiWalk *walk, CpsSetMeasure *measure) {
    make_round(walk);
    cpsi_walk_round(walk);
    const Seen seen = see(walk);
    bool polygonal = true;
    for (int k = 0; k < walk->count && going(walk); k++) {
        const CpsiOutlinePiece *piece = &walk->piece[k],
                               *next = &walk->piece[(k + 1) % walk->count];
        /* a corner that is not exactly one point is a small arc */
        polygonal =
            polygonal && piece->kind == CPSI_PIECE_CORNER && piece->drift <= 1e-13 * walk->size;
        along_piece(walk, &seen, piece, measure);
        measure->perimeter += length_back(&seen, piece->y, next->x);
        measure->area += 0.5 * cross(piece->y, next->x);
    }
    measure->area /= seen.determinant;
    measure->area_gap /= seen.determinant;
    measure->exact = walk->exact && polygonal;
    if (measure->exact) measure->area_gap = measure->perimeter_gap = 0;
    measure->perimeter_gap += 2 * CPSI_PI * walk->gap;
    measure->area_gap += walk->gap * measure->perimeter;
}

/* A flat set. The contribution of its width is bounded by the rectangle along its basis that
 * contains it. */
static void flat(CpsiWalk *walk, CpsSetMeasure *measure) {
    double x[2], width[2];
    for (int k = 0; k < 2; k++)
        width[k] = fmax(0, cpsi_walk_visit(walk, 0.5 * k * CPSI_PI, x) +
                               cpsi_walk_visit(walk, (0.5 * k + 1) * CPSI_PI, x));
    measure->perimeter = 2 * width[0];
    measure->perimeter_gap = 2 * width[1] + 8 * walk->gap;
    measure->area_gap = (width[0] + 2 * walk->gap) * (width[1] + 2 * walk->gap);
    measure->exact = walk->exact && width[1] == 0;
}

CpsStatus cps_set_measure(const CpsSet *set, CpsSetMeasure *measure, CpsError *err) {
    if (!set || !measure)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL", set ? "measure" : "set");
    *measure = (CpsSetMeasure){.outcome = CPS_SET_OUTCOME_NOT_PLANAR};
    if (set->n != 2) return CPS_OK;
    const double factor = likeness(set);
    if (factor > 0) {
        const CpsStatus status = cps_set_measure(set->part[0], measure, err);
        measure->perimeter *= factor;
        measure->perimeter_gap *= factor;
        measure->area *= factor * factor;
        measure->area_gap *= factor * factor;
        return status;
    }
    if (set->kind == CPSI_SET_POINTS) return polygon(set, measure, err);
    if (closed(set, measure)) return CPS_OK;
    CpsiWalk walk;
    CpsSetFacts facts;
    double *scratch;
    *measure = (CpsSetMeasure){.outcome = CPS_SET_OUTCOME_ANSWERED};
    CpsStatus status = cpsi_walk_start(set, 0, &walk, &facts, &scratch, err);
    if (!status && going(&walk)) {
        if (facts.dimension == 2)
            along_outline(&walk, measure);
        else
            flat(&walk, measure);
    }
    if (walk.outcome != CPS_SET_OUTCOME_ANSWERED)
        *measure = (CpsSetMeasure){.outcome = walk.outcome};
    if (!status) status = walk.status;
    free(walk.piece);
    free(scratch);
    return status;
}
