/* SPDX-License-Identifier: BSD-3-Clause */
/* The boundary of an intersection (boundary_intersection.h).
 *
 * Seen from a point inside both sets, each boundary is met once in every direction, and the nearer
 * one is that of the intersection. Which piece is the nearer one changes only where a piece ends
 * and where two pieces cross. So between these places, in the order of their angles, one piece is
 * the boundary; where the normal turns from one to the next there is a corner. */
#include "cable/boundary_intersection.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cable/friction_boundary.h"

/* Places nearer to each other than this angle [rad] are the same; a turn by less is no corner. */
static const double SAME_ANGLE = 1e-13, NO_TURN = 1e-12;
/* A crossing counts as on a piece up to this share of its size beyond its ends. */
static const double BESIDE = 1e-12;
static const double TURN = 6.283185307179586;
enum { MOST_PLACES = 8 * CPSI_MOST_PIECES };

/* A place where the nearer piece may change, and its direction from inside. */
typedef struct BoundaryPlace {
    double angle, p[2];
} BoundaryPlace;

typedef struct BoundarySweep {
    const CpsiFrictionShape *shape[2];
    const double *inside;
    int count;
    bool failed;
    BoundaryPlace place[MOST_PLACES];
} BoundarySweep;

static double dot(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }
static double cross(const double a[2], const double b[2]) { return a[0] * b[1] - a[1] * b[0]; }

static bool is_corner(const CpsiShapePiece *piece) { return !piece->is_edge && piece->radius == 0; }

/* Is p, on the line or the circle of the piece, between its ends? */
static bool is_on(const CpsiShapePiece *piece, const double p[2]) {
    if (piece->is_edge) {
        const double along[2] = {piece->at[1][0] - piece->at[0][0],
                                 piece->at[1][1] - piece->at[0][1]},
                     from[2] = {p[0] - piece->at[0][0], p[1] - piece->at[0][1]};
        const double share = dot(along, from) / dot(along, along);
        return share >= -BESIDE && share <= 1 + BESIDE;
    }
    const double v[2] = {p[0] - piece->centre[0], p[1] - piece->centre[1]},
                 least = -BESIDE * piece->radius;
    return cross(piece->normal[0], v) >= least && cross(v, piece->normal[1]) >= least &&
           dot(piece->normal[0], v) + dot(piece->normal[1], v) >= 0;
}

static void note(BoundarySweep *sweep, const double p[2]) {
    if (sweep->count == MOST_PLACES) {
        sweep->failed = true;
        return;
    }
    sweep->place[sweep->count++] =
        (BoundaryPlace){.angle = atan2(p[1] - sweep->inside[1], p[0] - sweep->inside[0]),
                        .p = {p[0], p[1]}};
}

static void note_crossing(BoundarySweep *sweep, const CpsiShapePiece *a, const CpsiShapePiece *b,
                          const double p[2]) {
    if (is_on(a, p) && is_on(b, p)) note(sweep, p);
}

/* The line of an edge crosses that of another, or the circle of an arc. */
static void cross_edge(BoundarySweep *sweep, const CpsiShapePiece *edge,
                       const CpsiShapePiece *other) {
    const double *n = edge->normal[0], t[2] = {-n[1], n[0]}, far = dot(n, edge->at[0]);
    if (other->is_edge) {
        const double *m = other->normal[0], det = cross(n, m), beyond = dot(m, other->at[0]);
        if (det == 0) return;
        const double p[2] = {(far * m[1] - beyond * n[1]) / det,
                             (beyond * n[0] - far * m[0]) / det};
        note_crossing(sweep, edge, other, p);
        return;
    }
    const double off = far - dot(n, other->centre),
                 square = other->radius * other->radius - off * off;
    if (!(square > 0)) return;
    for (int side = -1; side <= 1; side += 2) {
        const double along = side * sqrt(square);
        const double p[2] = {other->centre[0] + off * n[0] + along * t[0],
                             other->centre[1] + off * n[1] + along * t[1]};
        note_crossing(sweep, edge, other, p);
    }
}

/* The circles of two arcs cross. */
static void cross_arcs(BoundarySweep *sweep, const CpsiShapePiece *a, const CpsiShapePiece *b) {
    const double d[2] = {b->centre[0] - a->centre[0], b->centre[1] - a->centre[1]},
                 square = dot(d, d);
    if (!(square > 0)) return;
    const double along = 0.5 * (1 + (a->radius - b->radius) * (a->radius + b->radius) / square),
                 rest = a->radius * a->radius / square - along * along;
    if (!(rest > 0)) return;
    for (int side = -1; side <= 1; side += 2) {
        const double aside = side * sqrt(rest);
        const double p[2] = {a->centre[0] + along * d[0] - aside * d[1],
                             a->centre[1] + along * d[1] + aside * d[0]};
        note_crossing(sweep, a, b, p);
    }
}

static void note_places(BoundarySweep *sweep) {
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < sweep->shape[s]->count; i++)
            note(sweep, sweep->shape[s]->piece[i].at[0]);
    for (int i = 0; i < sweep->shape[0]->count; i++)
        for (int j = 0; j < sweep->shape[1]->count; j++) {
            const CpsiShapePiece *a = &sweep->shape[0]->piece[i], *b = &sweep->shape[1]->piece[j];
            if (is_corner(a) || is_corner(b)) continue;
            if (a->is_edge)
                cross_edge(sweep, a, b);
            else if (b->is_edge)
                cross_edge(sweep, b, a);
            else
                cross_arcs(sweep, a, b);
        }
}

static int by_angle(const void *a, const void *b) {
    const double x = ((const BoundaryPlace *)a)->angle, y = ((const BoundaryPlace *)b)->angle;
    return (x > y) - (x < y);
}

/* How far the piece is from inside in the direction q; infinite where it is not met. */
static double distance(const BoundarySweep *sweep, const CpsiShapePiece *piece, const double q[2]) {
    const double *x = sweep->inside;
    double t;
    if (is_corner(piece)) return INFINITY;
    if (piece->is_edge) {
        const double *n = piece->normal[0], along = dot(n, q);
        if (!(along > 0)) return INFINITY;
        t = (dot(n, piece->at[0]) - dot(n, x)) / along;
    } else {
        const double v[2] = {x[0] - piece->centre[0], x[1] - piece->centre[1]}, side = cross(q, v),
                     square = piece->radius * piece->radius - side * side;
        if (!(square >= 0)) return INFINITY;
        t = sqrt(square) - dot(v, q);
    }
    const double hit[2] = {x[0] + t * q[0], x[1] + t * q[1]};
    return t > 0 && is_on(piece, hit) ? t : INFINITY;
}

/* The piece that is the boundary in the direction of an angle; NULL where none is met. */
static const CpsiShapePiece *nearest(const BoundarySweep *sweep, double angle) {
    const double q[2] = {cos(angle), sin(angle)};
    const CpsiShapePiece *found = NULL;
    double least = INFINITY;
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < sweep->shape[s]->count; i++) {
            const double t = distance(sweep, &sweep->shape[s]->piece[i], q);
            if (!(t < least)) continue;
            least = t;
            found = &sweep->shape[s]->piece[i];
        }
    return found;
}

static void append(CpsiFrictionShape *out, BoundarySweep *sweep, const CpsiShapePiece *piece) {
    if (out->count < CPSI_MOST_PIECES)
        out->piece[out->count++] = *piece;
    else
        sweep->failed = true;
}

/* The part of a piece between two points. */
static CpsiShapePiece part_of(const CpsiShapePiece *piece, const double from[2],
                              const double to[2]) {
    CpsiShapePiece part = *piece;
    memcpy(part.at[0], from, sizeof part.at[0]);
    memcpy(part.at[1], to, sizeof part.at[1]);
    if (piece->is_edge) return part;
    for (int end = 0; end < 2; end++)
        for (int a = 0; a < 2; a++)
            part.normal[end][a] = (part.at[end][a] - piece->centre[a]) / piece->radius;
    return part;
}

/* The corner where the normal turns from that of one part to that of the next. */
static void append_corner(CpsiFrictionShape *out, BoundarySweep *sweep,
                          const CpsiShapePiece *before, const CpsiShapePiece *after) {
    const double *from = before->normal[1], *to = after->normal[0];
    const double turn = cross(from, to);
    if (turn < -NO_TURN || (turn <= NO_TURN && dot(from, to) < 0)) sweep->failed = true;
    if (turn <= NO_TURN) return;
    CpsiShapePiece corner = {.is_edge = false};
    for (int end = 0; end < 2; end++) memcpy(corner.at[end], after->at[0], sizeof corner.at[end]);
    memcpy(corner.normal[0], from, sizeof corner.normal[0]);
    memcpy(corner.normal[1], to, sizeof corner.normal[1]);
    memcpy(corner.centre, after->at[0], sizeof corner.centre);
    append(out, sweep, &corner);
}

/* The pieces that are the boundary one after the other, and where each of them begins. */
typedef struct BoundaryRun {
    const CpsiShapePiece *piece;
    const double *from;
} BoundaryRun;

static int find_runs(BoundarySweep *sweep, BoundaryRun *run) {
    int runs = 0;
    for (int k = 0; k < sweep->count; k++) {
        const bool is_last = k + 1 == sweep->count;
        const BoundaryPlace *from = &sweep->place[k], *to = &sweep->place[is_last ? 0 : k + 1];
        const double angle = to->angle + (is_last ? TURN : 0);
        if (angle - from->angle <= SAME_ANGLE) continue;
        const CpsiShapePiece *piece = nearest(sweep, from->angle + 0.5 * (angle - from->angle));
        if (!piece) sweep->failed = true;
        if (runs > 0 && run[runs - 1].piece == piece) continue;
        run[runs++] = (BoundaryRun){piece, from->p};
    }
    if (runs > 1 && run[0].piece == run[runs - 1].piece) run[0].from = run[--runs].from;
    return runs;
}

void cpsi_boundary_intersect(const CpsiFrictionShape *one, const CpsiFrictionShape *other,
                             const double inside[2], CpsiFrictionShape *out) {
    BoundarySweep sweep = {.shape = {one, other}, .inside = inside};
    BoundaryRun run[MOST_PLACES];
    out->count = 0;
    out->reach = fmin(one->reach, other->reach);
    note_places(&sweep);
    qsort(sweep.place, (size_t)sweep.count, sizeof *sweep.place, by_angle);
    const int runs = find_runs(&sweep, run);
    for (int k = 0; k < runs && !sweep.failed; k++) {
        const BoundaryRun *next = &run[(k + 1) % runs], *last = &run[(k + 2) % runs];
        const CpsiShapePiece part = part_of(run[k].piece, run[k].from, next->from),
                             after = part_of(next->piece, next->from, last->from);
        append(out, &sweep, &part);
        append_corner(out, &sweep, &part, &after);
    }
    if (runs < 2 || sweep.failed) out->count = 0;
    cpsi_friction_boundary_finish(out);
}
