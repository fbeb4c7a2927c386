/* SPDX-License-Identifier: BSD-3-Clause */
/* Planar sets: their boundary followed once round the normal angle (outline.h), their corners, the
 * rays of a cone. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "linalg/dense.h"
#include "set/set.h"

#include "set/outline.h"

static const double TURN = 2 * CPSI_PI;
/* [rad] Corners with a smaller range of normal angles are not searched for: over such a range arcs
 * with radii below a thousandth of the size move by less than SAME. */
static const double LEAST_OPENING = 1e-6;
/* Points closer than this share of the size are the same; an arc is smooth to a tenth of it. */
static const double SAME = 1e-9;

static bool going(const CpsiWalk *walk) {
    return walk->status == CPS_OK && walk->outcome == CPS_SET_OUTCOME_ANSWERED;
}

double cpsi_walk_visit(CpsiWalk *walk, double theta, double x[2]) {
    const int n = walk->set->n;
    const double c = cos(theta), s = sin(theta), *turn = walk->turn, *centre = walk->centre,
                 *basis = walk->basis;
    double along = turn[0] * c + turn[2] * s, across = turn[1] * c + turn[3] * s, p[2] = {0, 0};
    CpsSetAnswer answer = {.outcome = CPS_SET_OUTCOME_INACCURATE};
    walk->looks++;
    const double stretch = hypot(along, across);
    along /= stretch;
    across /= stretch;
    for (int i = 0; i < n; i++) walk->w[i] = along * basis[i] + across * basis[n + i];
    if (going(walk))
        walk->status = cpsi_support(walk->set, walk->w, walk->point, &answer, walk->err);
    if (walk->status == CPS_OK && answer.outcome != CPS_SET_OUTCOME_ANSWERED)
        walk->outcome = answer.outcome;
    walk->exact &= answer.exact;
    walk->gap = fmax(walk->gap, answer.gap);
    for (int i = 0; i < n; i++) {
        p[0] += (walk->point[i] - centre[i]) * basis[i];
        p[1] += (walk->point[i] - centre[i]) * basis[n + i];
    }
    x[0] = turn[0] * p[0] + turn[1] * p[1];
    x[1] = turn[2] * p[0] + turn[3] * p[1];
    return c * x[0] + s * x[1];
}

static bool same(const CpsiWalk *walk, const double x[2], const double y[2]) {
    return hypot(y[0] - x[0], y[1] - x[1]) <= SAME * walk->size;
}

static void add_piece(CpsiWalk *walk, CpsiOutlinePiece piece) {
    if (walk->count == walk->capacity) {
        const int capacity = walk->capacity ? 2 * walk->capacity : 64;
        CpsiOutlinePiece *more = realloc(walk->piece, (size_t)capacity * sizeof *more);
        if (!more) {
            walk->status =
                cpsi_fail(walk->err, CPS_ERR_MEMORY, "no memory for the outline of a set");
            return;
        }
        walk->piece = more;
        walk->capacity = capacity;
    }
    walk->piece[walk->count++] = piece;
}

/* Add the corner x for a range of angles; at one end of the range the point found was `other`. */
static void add_corner(CpsiWalk *walk, double from, double to, const double *x,
                       const double *other) {
    CpsiOutlinePiece *last = walk->count > 0 ? &walk->piece[walk->count - 1] : NULL;
    const double drift = hypot(other[0] - x[0], other[1] - x[1]);
    /* extend the last piece where it is the same corner; arcs are not merged, since each was found
     * smooth by itself */
    if (last && last->kind == CPSI_PIECE_CORNER &&
        hypot(x[0] - last->x[0], x[1] - last->x[1]) <= 10 * SAME * walk->size) {
        last->drift += hypot(x[0] - last->y[0], x[1] - last->y[1]) + drift;
        last->to = to;
        memcpy(last->y, x, sizeof last->y);
        return;
    }
    add_piece(walk,
              (CpsiOutlinePiece){CPSI_PIECE_CORNER, from, to, {x[0], x[1]}, {x[0], x[1]}, drift});
}

/* The angle on this side of `limit` up to which the point is the corner x. It is x at `at`; on
 * return `last` is the point found there. */
static double corner_ends(CpsiWalk *walk, const double x[2], double at, double last[2],
                          double limit) {
    for (int k = 0; k < 60 && going(walk) && fabs(limit - at) > 1e-13; k++) {
        const double middle = 0.5 * (at + limit);
        double y[2];
        cpsi_walk_visit(walk, middle, y);
        if (same(walk, x, y)) {
            at = middle;
            memcpy(last, y, sizeof y);
        } else {
            limit = middle;
        }
    }
    return at;
}

/* Whether the polynomial through x at the nine points cos(k pi/8) of [a, b] predicts x at other
 * angles. The barycentric formula (Berrut and Trefethen 2004). After a corner or an edge x is
 * displaced, which no polynomial predicts. */
static bool smooth(CpsiWalk *walk, double a, const double x[2], double b, const double y[2]) {
    static const double NODE[] = {-1, -0.9238795325112867, -0.7071067811865475, -0.3826834323650898,
                                  0,  0.3826834323650898,  0.7071067811865475,  0.9238795325112867,
                                  1};
    static const double PROBE[] = {-0.83, -0.19, 0.57};
    double value[9][2], found[2];
    memcpy(value[0], x, sizeof value[0]);
    memcpy(value[8], y, sizeof value[8]);
    for (int k = 1; k < 8; k++)
        cpsi_walk_visit(walk, 0.5 * (a + b) + 0.5 * (b - a) * NODE[k], value[k]);
    for (int p = 0; p < 3; p++) {
        double sum[2] = {0, 0}, weights = 0;
        for (int k = 0; k < 9; k++) {
            const double weight = (k & 1 ? -1 : 1) * (k % 8 ? 1 : 0.5) / (PROBE[p] - NODE[k]);
            weights += weight;
            sum[0] += weight * value[k][0];
            sum[1] += weight * value[k][1];
        }
        cpsi_walk_visit(walk, 0.5 * (a + b) + 0.5 * (b - a) * PROBE[p], found);
        if (!(hypot(sum[0] / weights - found[0], sum[1] / weights - found[1]) <=
              0.1 * SAME * walk->size))
            return false;
    }
    return true;
}

/* The angle in [a, b] whose normal is that of the chord, and the point z there. */
static double at_chord(CpsiWalk *walk, double a, const double x[2], double b, const double y[2],
                       double z[2]) {
    double m = atan2(x[0] - y[0], y[1] - x[1]);
    while (m < a) m += TURN;
    while (m > b + 1e-9 && m > a) m -= TURN;
    m = fmin(b, fmax(a, m));
    cpsi_walk_visit(walk, m, z);
    return m;
}

/* The pieces from angle a with the point x to b with the point y. */
static void divide(CpsiWalk *walk, double a, const double x[2], double b, const double y[2]) {
    if (!going(walk)) return;
    if (same(walk, x, y)) {
        add_corner(walk, a, b, x, y);
        return;
    }
    double z[2], first[2], last[2];
    const double m = at_chord(walk, a, x, b, y, z);
    cpsi_walk_visit(walk, m - 0.5 * (m - a), first);
    cpsi_walk_visit(walk, m + 0.5 * (b - m), last);
    const double height =
        /* height of the boundary above the chord */
        (z[0] - x[0]) * cos(m) + (z[1] - x[1]) * sin(m);
    const bool edge = height <= 1e-13 * walk->size;
    if (edge && same(walk, x, first) && same(walk, y, last)) {
        add_corner(walk, a, m, x, first);
        add_corner(walk, m, b, y, last);
        return;
    }
    if (b - a <= walk->opening || walk->looks > CPSI_MOST_LOOKS) {
        add_piece(walk, (CpsiOutlinePiece){
                            CPSI_PIECE_SHORT, a, b, {x[0], x[1]}, {y[0], y[1]}, fmax(height, 0)});
        return;
    }
    /* another corner lies between, as on polygons */
    if (!edge && (same(walk, z, first) || same(walk, z, last))) {
        divide(walk, a, x, m, z);
        divide(walk, m, z, b, y);
        return;
    }
    /* extend a corner at one end as far as it goes */
    const double middle = 0.5 * (a + b);
    double end = middle;
    cpsi_walk_visit(walk, middle, z);
    if (same(walk, x, z)) {
        end = corner_ends(walk, x, middle, z, b);
        add_corner(walk, a, end, x, z);
        divide(walk, end, z, b, y);
    } else if (same(walk, y, z)) {
        end = corner_ends(walk, y, middle, z, a);
        divide(walk, a, x, end, z);
        add_corner(walk, end, b, y, z);
    } else if (smooth(walk, a, x, b, y)) {
        add_piece(walk, (CpsiOutlinePiece){CPSI_PIECE_ARC, a, b, {x[0], x[1]}, {y[0], y[1]}, 0});
    } else {
        divide(walk, a, x, middle, z);
        divide(walk, middle, z, b, y);
    }
}

/* Once round, beginning at an angle without special meaning. */
void cpsi_walk_round(CpsiWalk *walk) {
    enum { STARTS = 8 };
    double x[STARTS + 1][2];
    const double first = 0.1234567;
    for (int k = 0; k < STARTS; k++) cpsi_walk_visit(walk, first + k * TURN / (double)STARTS, x[k]);
    memcpy(x[STARTS], x[0], sizeof x[0]);
    for (int k = 0; k < STARTS; k++)
        divide(walk, first + k * TURN / (double)STARTS, x[k],
               first + (k + 1) * TURN / (double)STARTS, x[k + 1]);
}

/* ---- public functions ---- */

CpsStatus cpsi_walk_start(const CpsSet *set, double tolerance, CpsiWalk *walk, CpsSetFacts *facts,
                          double **scratch, CpsError *err) {
    const size_t n = (size_t)set->n;
    *walk = (CpsiWalk){.outcome = CPS_SET_OUTCOME_INACCURATE};
    *facts = (CpsSetFacts){.outcome = CPS_SET_OUTCOME_INACCURATE};
    *scratch = calloc(n * n + 3 * n, sizeof **scratch);
    if (!*scratch) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the outline of a set");
    double *centre = *scratch, *basis = centre + n;
    *walk = (CpsiWalk){.set = set,
                       .centre = centre,
                       .basis = basis,
                       .w = basis + n * n,
                       .point = basis + n * n + n,
                       .size = cpsi_set_size(set),
                       .turn = {1, 0, 0, 1},
                       .opening = tolerance > 0 ? tolerance : LEAST_OPENING,
                       .exact = true,
                       .err = err};
    const CpsStatus status = cps_set_facts(set, 0, facts, centre, basis, err);
    if (status) return status;
    if (facts->outcome == CPS_SET_OUTCOME_NOT_AVAILABLE && facts->has_dimension)
        facts->outcome = CPS_SET_OUTCOME_ANSWERED;
    if (facts->outcome == CPS_SET_OUTCOME_ANSWERED && !facts->bounded)
        facts->outcome = CPS_SET_OUTCOME_UNBOUNDED;
    walk->outcome = facts->outcome;
    /* in R^2 use the coordinate axes, so that corners are counterclockwise */
    if (set->n == 2 && facts->dimension == 2) {
        basis[0] = basis[3] = 1;
        basis[1] = basis[2] = 0;
    }
    return CPS_OK;
}

static void store_point(const CpsiWalk *walk, const double x[2], int capacity, double *points,
                        int *count) {
    const int n = walk->set->n;
    if (*count < capacity)
        for (int i = 0; i < n; i++)
            points[*count * n + i] =
                walk->centre[i] + x[0] * walk->basis[i] + (n > 1 ? x[1] * walk->basis[n + i] : 0);
    ++*count;
}

/* The two ends of a set of dimension 1. */
static void store_ends(CpsiWalk *walk, int capacity, double *points, int *count) {
    const int n = walk->set->n;
    for (int sign = -1; sign <= 1 && going(walk); sign += 2) {
        CpsSetAnswer answer = {.outcome = CPS_SET_OUTCOME_INACCURATE};
        for (int i = 0; i < n; i++) walk->w[i] = sign * walk->basis[i];
        walk->status = cpsi_support(walk->set, walk->w, walk->point, &answer, walk->err);
        if (walk->status == CPS_OK) walk->outcome = answer.outcome;
        walk->exact &= answer.exact;
        walk->gap = fmax(walk->gap, answer.gap);
        if (*count < capacity) memcpy(&points[*count * n], walk->point, (size_t)n * sizeof *points);
        ++*count;
    }
}

/* The vertices of a set of dimension 3 and more, where it was constructed from points. */
static bool store_known(const CpsSet *set, int capacity, double *points, int *count) {
    const int n = set->n;
    if (set->kind == CPSI_SET_POINTS) {
        *count = set->count;
        for (int k = 0; k < set->count && k < capacity; k++)
            memcpy(&points[k * n], &set->a[(size_t)k * (size_t)n], (size_t)n * sizeof *points);
        return true;
    }
    if (set->kind != CPSI_SET_BOX) return false;
    int open = 0;
    for (int i = 0; i < n; i++) open += set->a[i] < set->b[i];
    if (open > 16) return false;
    *count = 1 << open;
    for (int k = 0; k < *count && k < capacity; k++)
        for (int i = 0, bit = 0; i < n; i++) {
            points[k * n + i] = set->a[i] < set->b[i] && (k >> bit & 1) ? set->b[i] : set->a[i];
            bit += set->a[i] < set->b[i];
        }
    return true;
}

CpsStatus cps_set_vertices(const CpsSet *set, double tolerance, int capacity, double *points,
                           int *count, CpsSetAnswer *answer, CpsError *err) {
    if (!set || !count || !answer || (!points && capacity > 0) || capacity < 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "set, count, answer or points is NULL, or capacity is negative");
    if (!(tolerance >= 0) || tolerance > 0.5)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "tolerance is %g, expected an angle from 0 to 0.5",
                         tolerance);
    CpsiWalk walk;
    CpsSetFacts facts;
    double *scratch;
    *count = 0;
    CpsStatus status = cpsi_walk_start(set, tolerance, &walk, &facts, &scratch, err);
    if (!status && walk.outcome == CPS_SET_OUTCOME_ANSWERED) {
        if (facts.dimension == 0)
            store_point(&walk, (const double[]){0, 0}, capacity, points, count);
        else if (facts.dimension == 1)
            store_ends(&walk, capacity, points, count);
        else if (facts.dimension == 2) {
            cpsi_walk_round(&walk);
            for (int k = 0; k < walk.count && going(&walk); k++) {
                const CpsiOutlinePiece *piece = &walk.piece[k], *first = walk.piece;
                /* the first piece may be continued by the last one */
                const bool again =
                    k > 0 && k == walk.count - 1 && first->kind == CPSI_PIECE_CORNER &&
                    piece->kind == CPSI_PIECE_CORNER &&
                    hypot(piece->x[0] - first->x[0], piece->x[1] - first->x[1]) <= 1e-8 * walk.size;
                if (piece->kind == CPSI_PIECE_CORNER && !again &&
                    (k == 0 || piece->to - piece->from >= walk.opening))
                    store_point(&walk, piece->x, capacity, points, count);
            }
        } else if (!store_known(set, capacity, points, count))
            walk.outcome = CPS_SET_OUTCOME_NOT_PLANAR;
    }
    *answer = (CpsSetAnswer){.outcome = walk.outcome,
                             .exact = walk.exact,
                             .gap = walk.gap,
                             .value = *count,
                             .tolerance = walk.opening};
    if (!status) status = walk.status;
    free(walk.piece);
    free(scratch);
    return status;
}

/* ---- rays of a cone ---- */

/* A direction outside a cone by less than this share lies on its boundary: the accuracy of
 * projections, with a margin. */
static const double ON_CONE = 1e-8;

/* A cone of dimension one or two: a direction inside it, and the axes of its plane (2, n). */
typedef struct PlanarCone {
    const CpsSet *set;
    const double *basis;
    int dimension;
    double *d, *nearest; /* (n) */
} PlanarCone;

/* The unit vector at angle t, and its distance from the cone; `nearest` is the nearest point of the
 * cone. */
static CpsStatus probe(const PlanarCone *cone, double t, double *distance, CpsSetAnswer *answer,
                       CpsError *err) {
    const int n = cone->set->n;
    const double c = cos(t), s = cone->dimension > 1 ? sin(t) : 0;
    for (int i = 0; i < n; i++)
        cone->d[i] = c * cone->basis[i] + (cone->dimension > 1 ? s * cone->basis[n + i] : 0);
    CpsSetAnswer near;
    const CpsStatus status = cps_set_project(cone->set, cone->d, NULL, cone->nearest, &near, err);
    *distance = near.value;
    if (!status && near.outcome != CPS_SET_OUTCOME_ANSWERED) answer->outcome = near.outcome;
    return status;
}

static void store_ray(int n, const double *ray, int capacity, double *rays, int *count) {
    const double size = cpsi_norm(n, ray);
    if (*count < capacity)
        for (int i = 0; i < n; i++) rays[*count * n + i] = ray[i] / size;
    ++*count;
}

/* The bounding ray on one side of `middle`, an angle inside the cone. For directions up to a
 * quarter turn beyond the boundary, the nearest point of the cone lies on the bounding ray.
 * *turned: angle to the ray, PI where the cone extends that far. */
static CpsStatus bounding_ray(const PlanarCone *cone, double middle, int sign, double *turned,
                              double *ray, CpsSetAnswer *answer, CpsError *err) {
    enum { PROBES = 6 };
    const int n = cone->set->n;
    *turned = 0.5 * TURN;
    for (int k = 1; k <= PROBES; k++) {
        const double t = 0.5 * TURN * k / (double)PROBES;
        double distance = 0;
        const CpsStatus status = probe(cone, middle + sign * t, &distance, answer, err);
        if (status || answer->outcome != CPS_SET_OUTCOME_ANSWERED) return status;
        memcpy(ray, cone->d, (size_t)n * sizeof *ray);
        if (!(distance > ON_CONE)) continue;
        memcpy(ray, cone->nearest, (size_t)n * sizeof *ray);
        *turned = t - asin(fmin(1, distance));
        return CPS_OK;
    }
    return CPS_OK;
}

/* Generators of a cone of dimension two: its two bounding rays; for a half-plane two opposite ones
 * and one between; for a plane four. */
static CpsStatus planar_rays(const PlanarCone *cone, const double *centre, int capacity,
                             double *rays, int *count, CpsSetAnswer *answer, CpsError *err) {
    const int n = cone->set->n;
    const double middle =
        atan2(cpsi_dot(n, centre, cone->basis + n), cpsi_dot(n, centre, cone->basis));
    double turned[2] = {0}, opening = 0;
    double *ray = malloc(2 * (size_t)n * sizeof *ray);
    if (!ray) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the rays of a cone");
    CpsStatus status = CPS_OK;
    for (int side = 0; side < 2 && !status && answer->outcome == CPS_SET_OUTCOME_ANSWERED;
         side++, opening += turned[side - 1])
        status =
            bounding_ray(cone, middle, side ? 1 : -1, &turned[side], &ray[side * n], answer, err);
    if (!status && answer->outcome == CPS_SET_OUTCOME_ANSWERED &&
        opening > 0.75 * TURN) { /* the plane is the only convex cone with such an opening */
        for (int k = 0; k < 4; k++) {
            for (int i = 0; i < n; i++) ray[i] = (k % 2 ? -1 : 1) * cone->basis[k / 2 * n + i];
            store_ray(n, ray, capacity, rays, count);
        }
    } else if (!status && answer->outcome == CPS_SET_OUTCOME_ANSWERED) {
        store_ray(n, ray, capacity, rays, count);
        store_ray(n, ray + n, capacity, rays, count);
        if (opening > 0.5 * TURN - ON_CONE) store_ray(n, centre, capacity, rays, count);
    }
    free(ray);
    return status;
}

/* Generators of a cone of dimension one: a ray, or the two of a line. */
static CpsStatus line_rays(const PlanarCone *cone, int capacity, double *rays, int *count,
                           CpsSetAnswer *answer, CpsError *err) {
    for (int side = 0; side < 2; side++) {
        double distance = 0;
        const CpsStatus status = probe(cone, side ? 0.5 * TURN : 0, &distance, answer, err);
        if (status || answer->outcome != CPS_SET_OUTCOME_ANSWERED) return status;
        if (!(distance > ON_CONE)) store_ray(cone->set->n, cone->d, capacity, rays, count);
    }
    return CPS_OK;
}

CpsStatus cps_set_rays(const CpsSet *set, double tolerance, int capacity, double *rays, int *count,
                       CpsSetAnswer *answer, CpsError *err) {
    if (!set || !count || !answer || (!rays && capacity > 0) || capacity < 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "set, count, answer or rays is NULL, or capacity is negative");
    if (!(tolerance >= 0) || tolerance > 0.5)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "tolerance is %g, expected 0 to 0.5", tolerance);
    const size_t n = (size_t)set->n;
    *count = 0;
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true};
    if (set->kind == CPSI_SET_RAYS || set->kind == CPSI_SET_SUBSPACE) {
        const int sides = set->kind == CPSI_SET_RAYS ? 1 : 2;
        for (int k = 0; k < sides * set->count; k++, ++*count) {
            const double *ray = &set->a[(size_t)(k / sides) * n],
                         size = cpsi_norm(set->n, ray) * (sides == 2 && k % 2 ? -1 : 1);
            if (*count < capacity)
                for (size_t i = 0; i < n; i++) rays[(size_t)k * n + i] = ray[i] / size;
        }
        return CPS_OK;
    }
    if (set->kind == CPSI_SET_SCALE) { /* by a factor that is not 0 */
        const CpsStatus status =
            cps_set_rays(set->part[0], tolerance, capacity, rays, count, answer, err);
        if (set->scalar < 0)
            for (size_t i = 0; i < n * (size_t)(*count < capacity ? *count : capacity); i++)
                rays[i] = -rays[i];
        return status;
    }
    double *scratch = malloc((n * n + 3 * n) * sizeof *scratch);
    if (!scratch) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the rays of a cone");
    CpsSetFacts facts;
    CpsStatus status = cps_set_facts(set, 0, &facts, scratch, scratch + n, err);
    answer->outcome = facts.outcome;
    answer->exact = false;
    if (!status && facts.outcome == CPS_SET_OUTCOME_ANSWERED && facts.dimension > 0) {
        const PlanarCone cone = {set, scratch + n, facts.dimension, scratch + n + n * n,
                                 scratch + 2 * n + n * n};
        answer->tolerance = ON_CONE;
        if (facts.dimension > 2 || facts.bounded || !facts.has_zero)
            answer->outcome = CPS_SET_OUTCOME_NOT_PLANAR;
        else if (facts.dimension == 1)
            status = line_rays(&cone, capacity, rays, count, answer, err);
        else
            status = planar_rays(&cone, scratch, capacity, rays, count, answer, err);
    }
    free(scratch);
    return status;
}
