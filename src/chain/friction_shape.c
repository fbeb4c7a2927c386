/* SPDX-License-Identifier: BSD-3-Clause */
/* The boundary of a planar friction set (friction_shape.h). */
#include "chain/friction_shape.h"

#include <math.h>

static double dot(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }
static double cross(const double a[2], const double b[2]) { return a[0] * b[1] - a[1] * b[0]; }

/* Is v between the normals of an arc, whose angle is less than pi? */
static bool is_between(const CpsiShapePiece *arc, const double v[2], double rounding) {
    return cross(arc->normal[0], v) >= -rounding && cross(v, arc->normal[1]) >= -rounding &&
           dot(arc->normal[0], v) + dot(arc->normal[1], v) >= 0;
}

/* The distance of x from a piece, where the nearest point of the set is on it; else 0. */
static double beyond_piece(const CpsiShapePiece *piece, const double x[2]) {
    if (piece->is_edge) {
        const double *n = piece->normal[0];
        const double from[2] = {x[0] - piece->at[0][0], x[1] - piece->at[0][1]},
                     to[2] = {x[0] - piece->at[1][0], x[1] - piece->at[1][1]};
        return cross(n, from) >= 0 && cross(n, to) <= 0 ? fmax(0, dot(n, from)) : 0;
    }
    const double v[2] = {x[0] - piece->centre[0], x[1] - piece->centre[1]};
    return is_between(piece, v, 0) ? fmax(0, sqrt(dot(v, v)) - piece->radius) : 0;
}

double cpsi_friction_shape_beyond(const CpsiFrictionShape *shape, const double x[2], int *piece) {
    *piece = -1;
    if (dot(x, x) < shape->inner * shape->inner) return 0;
    double most = 0;
    for (int i = 0; i < shape->count; i++) {
        const double beyond = beyond_piece(&shape->piece[i], x);
        if (!(beyond > most)) continue;
        most = beyond;
        *piece = i;
    }
    return most;
}

double cpsi_friction_shape_support(const CpsiFrictionShape *shape, const double n[2]) {
    double most = -INFINITY;
    for (int i = 0; i < shape->count; i++) {
        const CpsiShapePiece *piece = &shape->piece[i];
        most = fmax(most, dot(n, piece->at[0]));
        if (!piece->is_edge && piece->radius > 0 && is_between(piece, n, 0))
            most = fmax(most, dot(n, piece->centre) + piece->radius * sqrt(dot(n, n)));
    }
    return most;
}

int cpsi_friction_shape_turn(const CpsiFrictionShape *shape, int from, const double q[2],
                             double rounding) {
    const CpsiShapePiece *here = &shape->piece[from];
    if (is_between(here, q, rounding)) return from;
    const double middle[2] = {here->normal[0][0] + here->normal[1][0],
                              here->normal[0][1] + here->normal[1][1]};
    const int side = cross(middle, q) > 0 ? 1 : shape->count - 1;
    int to = from;
    for (int i = 0; i < shape->count; i++) {
        to = (to + side) % shape->count;
        if (shape->piece[to].is_edge || is_between(&shape->piece[to], q, rounding)) break;
    }
    return to;
}

double cpsi_friction_shape_reach(const CpsiFrictionShape *shape, const double x[2],
                                 const double q[2]) {
    double least = INFINITY;
    for (int i = 0; i < shape->count; i++) {
        const CpsiShapePiece *piece = &shape->piece[i];
        double t = INFINITY;
        if (piece->is_edge) { /* the set lies on one side of its line */
            const double *n = piece->normal[0], along = dot(n, q);
            const double inside[2] = {piece->at[0][0] - x[0], piece->at[0][1] - x[1]};
            if (along > 0) t = dot(n, inside) / along;
        } else { /* where the ray leaves the circle, if that is on the arc */
            const double v[2] = {x[0] - piece->centre[0], x[1] - piece->centre[1]};
            const double along = dot(v, q), across = cross(q, v),
                         rest = piece->radius * piece->radius - across * across;
            if (!(rest >= 0)) continue;
            t = sqrt(rest) - along;
            const double hit[2] = {v[0] + t * q[0], v[1] + t * q[1]};
            if (t < 0 || !is_between(piece, hit, 0)) continue;
        }
        least = fmin(least, t);
    }
    return isfinite(least) ? fmax(0, least) : 0;
}
