/* SPDX-License-Identifier: BSD-3-Clause */
/* The boundary of a friction set (friction_boundary.h).
 *
 * Over an interval of angles of the normal n the point of the boundary with this normal, p(n), is
 * that of an arc, c + r n, or of a corner, r = 0, if it is so at both ends and between them. An
 * interval where it is not is halved, until all points beyond the line between its ends are
 * as near to it as rounding: then that line is an edge. Of the arcs found, those on one circle are
 * joined. */
#include "cable/friction_boundary.h"

#include <math.h>
#include <string.h>

/* Points that differ by less than this, per reach, are the same: a few roundings. */
static const double SAME = 1e-14;
/* Shorter edges and smaller radii, per reach, are none. */
static const double NOTHING = 1e-12;
/* [rad] Normals of a joined arc turn by no more. */
static const double MOST_TURN = 3;
/* [rad] Where the intervals begin: no angle that a set is likely to have. */
static const double FIRST_ANGLE = 0.321750554396642;
enum { INTERVALS = 8, MOST_ARCS = 4096 };

/* The normal of an angle, and the point of the boundary there. */
typedef struct Sample {
    double angle, n[2], p[2];
} Sample;

/* A piece between two samples. */
typedef struct Arc {
    Sample end[2];
    double centre[2], radius;
    bool is_edge;
} Arc;

typedef struct BoundarySearch {
    const CpsSet *set;
    double same, nothing; /* SAME and NOTHING in units of the set */
    Arc arc[CPSI_MOST_PIECES];
    int count;
    bool failed;
} BoundarySearch;

static Sample sample(BoundarySearch *search, double angle) {
    Sample at = {.angle = angle, .n = {cos(angle), sin(angle)}};
    CpsSetAnswer answer;
    if (cpsi_support(search->set, at.n, at.p, &answer, NULL) ||
        answer.outcome != CPS_SET_OUTCOME_ANSWERED)
        search->failed = true;
    return at;
}

/* Is the sample on the circle of the arc? */
static bool is_on(const BoundarySearch *search, const Arc *arc, const Sample *at) {
    double off = 0;
    for (int a = 0; a < 2; a++)
        off = fmax(off, fabs(arc->centre[a] + arc->radius * at->n[a] - at->p[a]));
    return off <= search->same;
}

/* The circle through two samples with their normals. */
static Arc circle(const Sample *from, const Sample *to) {
    Arc out = {.end = {*from, *to}};
    const double turn = to->angle - from->angle, middle = from->angle + 0.5 * turn;
    out.radius = ((to->p[1] - from->p[1]) * cos(middle) - (to->p[0] - from->p[0]) * sin(middle)) /
                 (2 * sin(0.5 * turn));
    for (int a = 0; a < 2; a++) out.centre[a] = from->p[a] - out.radius * from->n[a];
    return out;
}

/* Join an arc to the last one, if one of the two circles, that with the larger angle, passes
 * through both. */
static bool join(BoundarySearch *search, const Arc *next) {
    if (search->count == 0) return false;
    Arc *last = &search->arc[search->count - 1];
    if (last->is_edge || next->is_edge || next->end[1].angle - last->end[0].angle > MOST_TURN)
        return false;
    const bool longer =
        next->end[1].angle - next->end[0].angle > last->end[1].angle - last->end[0].angle;
    Arc both = longer ? *next : *last;
    if (!is_on(search, &both, &last->end[0]) || !is_on(search, &both, &last->end[1]) ||
        !is_on(search, &both, &next->end[1]))
        return false;
    both.end[0] = last->end[0];
    both.end[1] = next->end[1];
    *last = both;
    return true;
}

static void add(BoundarySearch *search, const Arc *next) {
    Arc piece = *next;
    while (join(search, &piece)) piece = search->arc[--search->count];
    if (search->count < CPSI_MOST_PIECES)
        search->arc[search->count++] = piece;
    else
        search->failed = true;
}

/* All pieces between two samples. */
static void divide(BoundarySearch *search, Sample from, Sample to) {
    enum { DEEPEST = 64 };
    Sample waiting[DEEPEST];
    int depth = 0, budget = MOST_ARCS;
    waiting[depth++] = to;
    while (depth > 0 && !search->failed) {
        to = waiting[depth - 1];
        const double angle = from.angle + 0.5 * (to.angle - from.angle);
        const Sample middle = sample(search, angle);
        Arc arc = circle(&from, &to);
        const double chord = hypot(to.p[0] - from.p[0], to.p[1] - from.p[1]);
        if (is_on(search, &arc, &to) && is_on(search, &arc, &middle)) {
            add(search, &arc);
        } else if (chord * (to.angle - from.angle) <= search->same) {
            arc.is_edge = true;
            if (chord > search->nothing) add(search, &arc);
        } else if (depth < DEEPEST && budget-- > 0) {
            waiting[depth++] = middle;
            continue;
        } else {
            search->failed = true;
        }
        from = to;
        depth--;
    }
}

static void store(const BoundarySearch *search, const Arc *arc, CpsiShapePiece *piece) {
    *piece = (CpsiShapePiece){.is_edge = arc->is_edge};
    for (int end = 0; end < 2; end++) {
        memcpy(piece->at[end], arc->end[end].p, sizeof piece->at[end]);
        memcpy(piece->normal[end], arc->end[end].n, sizeof piece->normal[end]);
    }
    if (arc->is_edge) {
        const double x = piece->at[1][0] - piece->at[0][0], y = piece->at[1][1] - piece->at[0][1],
                     over = 1 / hypot(x, y);
        for (int end = 0; end < 2; end++) {
            piece->normal[end][0] = over * y;
            piece->normal[end][1] = -over * x;
        }
        return;
    }
    const bool is_corner = arc->radius <= search->nothing;
    piece->radius = is_corner ? 0 : arc->radius;
    memcpy(piece->centre, is_corner ? piece->at[0] : arc->centre, sizeof piece->centre);
}

void cpsi_friction_boundary_finish(CpsiFrictionShape *shape) {
    shape->inner = INFINITY;
    for (int i = 0; i < shape->count; i++) {
        CpsiShapePiece *here = &shape->piece[i], *next = &shape->piece[(i + 1) % shape->count];
        if (next->is_edge && !here->is_edge)
            memcpy(here->normal[1], next->normal[0], sizeof here->normal[1]);
        if (here->is_edge && !next->is_edge)
            memcpy(next->normal[0], here->normal[0], sizeof next->normal[0]);
        for (int end = 0; end < 2; end++) {
            const double *n = here->normal[end], *p = here->at[end];
            shape->inner = fmin(shape->inner, n[0] * p[0] + n[1] * p[1]);
        }
        if (here->is_edge) continue;
        shape->inner = fmin(shape->inner, here->radius - hypot(here->centre[0], here->centre[1]));
    }
    if (!(shape->inner > 0)) shape->inner = 0;
}

void cpsi_friction_boundary_find(const CpsSet *closed, double reach, CpsiFrictionShape *shape) {
    BoundarySearch search = {.set = closed, .same = SAME * reach, .nothing = NOTHING * reach};
    const double turn = 6.283185307179586 / INTERVALS;
    *shape = (CpsiFrictionShape){.reach = reach};
    const Sample first = sample(&search, FIRST_ANGLE);
    Sample from = first;
    for (int i = 1; i <= INTERVALS && !search.failed; i++) {
        Sample to = sample(&search, FIRST_ANGLE + i * turn);
        if (i == INTERVALS) {
            memcpy(to.n, first.n, sizeof to.n);
            memcpy(to.p, first.p, sizeof to.p);
        }
        divide(&search, from, to);
        from = to;
    }
    if (search.failed) return;
    for (int i = 0; i < search.count; i++) store(&search, &search.arc[i], &shape->piece[i]);
    shape->count = search.count;
    cpsi_friction_boundary_finish(shape);
}
