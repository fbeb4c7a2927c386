/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points that follow a body (body_points.h).
 *
 * The lines change the forces on the points by g = -(K y + B u), y the moves of the points and u of
 * the body. The load on a point is what it was, so that g vanishes where nothing holds it. On a
 * plane it keeps to the condition of a node there (body_stiffness.c), m g + q y = 0, hence
 *
 *     (m K - q) y = -m B u,
 *
 * and force and moment on the body lose C y beside what they lose by u, C = B' where no end is
 * moved by more than one of both. */
#include "body_points.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 60 };

/* As of nodes: a reaction per force there, a slip per length, and a friction per bound. */
static const Real NOTHING = 1e-7L, CLOSED = 1e-3L, MOVED = 1e-9L, RESTS = 1e-13L;
/* A pivot so small per the largest entry: nothing holds a point along some way. */
static const Real SINGULAR = 1e-12L;

static Real size3(const double *v) { return hypotl(hypotl(v[0], v[1]), v[2]); }

/* ---- which points ---- */

/* Do a step's numbers of a point vanish, or are there none in the file? */
static bool is_without(const StiffnessStep *step, const char *name, size_t point, size_t width) {
    int id;
    double value[3] = {0, 0, 0};
    const size_t start[3] = {step->step, point, 0}, count[3] = {1, 1, width};
    if (nc_inq_varid(step->source->nc, name, &id)) return true;
    return nc_get_vara_double(step->source->nc, id, start, count, value) == NC_NOERR &&
           value[0] == 0 && value[1] == 0 && value[2] == 0;
}

static bool is_free(const BodyPoints *points, int point) {
    const int state = point < 0 ? POINT_HELD : points->now[point].state;
    return state == POINT_FREE || state == POINT_STICK || state == POINT_SLIP;
}

/* Is nothing at the point but lines, load and an obstacle? */
static bool is_plain(const StiffnessStep *step, size_t point) {
    int id;
    return is_without(step, "displaced_of_point", point, 1) &&
           nc_inq_varid(step->source->nc, "set_kind_of_point", &id) != NC_NOERR;
}

static void follow(BodyPoints *points, int point) {
    if (!is_free(points, point) || points->number[point] != STAYS) return;
    points->number[point] = (int)points->count;
    points->point[points->count++] = (size_t)point;
}

/* Those at the far ends of lines from the body, and from those, until there are no more. */
static void find_all(const StiffnessStep *step, size_t k, BodyPoints *points) {
    size_t before;
    do {
        before = points->count;
        for (size_t i = 0; i < step->source->lines; i++)
            for (int e = 0; e < 2; e++) {
                const int from = step->line[i].end_point[e], to = step->line[i].end_point[!e];
                if (from >= 0 && to >= 0 &&
                    (step->bodies->of_point[from] == (int)k || points->number[from] != STAYS))
                    follow(points, to);
            }
    } while (points->count > before);
}

bool body_points_open(const StiffnessStep *step, size_t k, BodyPoints *points) {
    const size_t all = step->source->points;
    *points = (BodyPoints){.number = calloc(all + 1, sizeof *points->number),
                           .point = calloc(all + 1, sizeof *points->point),
                           .now = calloc(all + 1, sizeof *points->now),
                           .length = calloc(all + 1, sizeof *points->length)};
    if (!points->number || !points->point || !points->now || !points->length) return false;
    for (size_t i = 0; i < all; i++) points->number[i] = STAYS;
    if (junctions_read(step->source, step->step, points->now, NULL)) return false;
    for (size_t i = 0; i < all; i++) /* an anchor that gives way would follow */
        if (!is_without(step, "drag_of_point", i, 3)) return false;
    for (size_t i = 0; i < step->source->lines; i++) {
        const Record *r = &step->line[i];
        Real length = 0;
        for (size_t j = 0; j < r->elements; j++) length += r->element_length[j];
        for (int e = 0; e < 2; e++)
            if (r->end_point[e] >= 0)
                points->length[r->end_point[e]] = fmaxl(points->length[r->end_point[e]], length);
    }
    find_all(step, k, points);
    if (points->count > MOST_POINTS) return false;
    for (size_t i = 0; i < points->count; i++)
        if (!is_plain(step, points->point[i])) return false;
    const size_t n = 3 * points->count;
    points->lost = calloc(n * (n + SIX) + 1, sizeof *points->lost);
    points->feedback = calloc(SIX * n + 1, sizeof *points->feedback);
    return points->lost && points->feedback;
}

void body_points_close(BodyPoints *points) {
    free(points->number);
    free(points->point);
    free(points->now);
    free(points->length);
    free(points->lost);
    free(points->feedback);
    *points = (BodyPoints){0};
}

/* ---- sums ---- */

/* How component a of the place of an end follows from the body. */
static Real moved_by(const MovedEnd *end, int a, int i) { return end->is_on ? end->map[a][i] : 0; }
/* ... and from the force there that on the body which is asked for. */
static Real counted(const MovedEnd *end, int a, int i) { return end->counts ? end->map[a][i] : 0; }

void body_points_add(BodyPoints *points, Real ends[SIX][SIX], const MovedEnd end[2],
                     Real stiffness[SIX * SIX]) {
    const size_t n = 3 * points->count, width = n + SIX;
    for (int row = 0; row < SIX; row++)
        for (int column = 0; column < SIX; column++) {
            const MovedEnd *to = &end[row / 3], *from = &end[column / 3];
            const int a = row % 3, b = column % 3;
            const Real k = ends[row][column];
            for (int i = 0; i < SIX; i++)
                for (int j = 0; j < SIX; j++)
                    stiffness[SIX * i + j] += counted(to, a, i) * k * moved_by(from, b, j);
            if (to->follower != STAYS) {
                Real *lost = &points->lost[width * (size_t)(3 * to->follower + a)];
                if (from->follower != STAYS) lost[3 * from->follower + b] += k;
                for (int j = 0; j < SIX; j++) lost[n + (size_t)j] += k * moved_by(from, b, j);
            }
            if (from->follower != STAYS)
                for (int i = 0; i < SIX; i++)
                    points->feedback[n * (size_t)i + (size_t)(3 * from->follower + b)] +=
                        counted(to, a, i) * k;
        }
}

/* ---- what holds a point ---- */

static void set_identity(Real m[3][3], Real by) {
    for (int a = 0; a < 3; a++) m[a][a] = by;
}

/* m g + q y = 0 of a point on a plane. False where its state is not known. */
static bool set_on_plane(const StiffnessStep *step, const Junction *at, Real length, Real stiff,
                         Real m[3][3], Real q[3][3]) {
    const Source *source = step->source;
    if ((size_t)at->obstacle >= source->surfaces || !source->consistent) return false;
    const Surface *on = &source->surface[at->obstacle];
    if (on->kind != SURFACE_PLANE || on->gives > 0 || on->set || on->box || on->mu[0] != on->mu[1])
        return false;
    Real x[3];
    for (int a = 0; a < 3; a++) x[a] = at->position[a];
    const bool is_laid = source->has_static && step->step == 0 && !step->sticks;
    const Real mu = is_laid ? 0 : surface_factor(on, x) * on->mu[0], bound = mu * at->reaction,
               slid = size3(at->slip), used = mu > 0 ? size3(at->friction) / bound : 0;
    if (!(at->reaction > NOTHING * (size3(at->lines) + size3(at->load)))) return false;
    const bool rests = mu > 0 && (step->sticks || slid <= RESTS * length ||
                                  (slid <= MOVED * length && used < 1 - CLOSED));
    if (rests) {
        set_identity(q, stiff);
        return true;
    }
    if (mu > 0 && !(slid > MOVED * length && used > 1 - CLOSED)) return false;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const Real normal = (Real)at->normal[a] * at->normal[b], plane = (a == b) - normal,
                       along = mu > 0 ? at->slip[a] / slid : 0,
                       other = mu > 0 ? at->slip[b] / slid : 0;
            m[a][b] = plane + mu * along * at->normal[b];
            q[a][b] = stiff * normal - (mu > 0 ? bound / slid * (plane - along * other) : 0);
        }
    return true;
}

/* Turn the rows of point i of what the lines lose into m K - q, m B. */
static bool set_point(const StiffnessStep *step, BodyPoints *points, size_t i) {
    const size_t n = 3 * points->count, width = n + SIX;
    const Junction *at = &points->now[points->point[i]];
    Real m[3][3] = {{0}}, q[3][3] = {{0}}, stiff = 0, *row = &points->lost[width * 3 * i];
    if (!at->has_place) return false;
    for (size_t a = 0; a < 3; a++) stiff += fabsl(row[width * a + 3 * i + a]);
    if (at->obstacle < 0) {
        set_identity(m, 1);
        if (size3(at->friction) > 0) return false;
    } else if (!set_on_plane(step, at, points->length[points->point[i]], stiff, m, q)) {
        return false;
    }
    for (size_t c = 0; c < width; c++) {
        const Real old[3] = {row[c], row[width + c], row[2 * width + c]};
        for (size_t a = 0; a < 3; a++)
            row[width * a + c] = m[a][0] * old[0] + m[a][1] * old[1] + m[a][2] * old[2];
    }
    for (size_t a = 0; a < 3; a++)
        for (size_t b = 0; b < 3; b++) row[width * a + 3 * i + b] -= q[a][b];
    return true;
}

/* Gauss and Jordan, rows exchanged for the largest pivot: the last columns become the solution. */
static bool eliminate(Real *rows, size_t n) {
    const size_t width = n + SIX;
    Real most = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) most = fmaxl(most, fabsl(rows[width * i + j]));
    for (size_t p = 0; p < n; p++) {
        size_t best = p;
        for (size_t i = p + 1; i < n; i++)
            if (fabsl(rows[width * i + p]) > fabsl(rows[width * best + p])) best = i;
        if (!(fabsl(rows[width * best + p]) > SINGULAR * most)) return false;
        for (size_t j = 0; j < width; j++) {
            const Real swap = rows[width * p + j];
            rows[width * p + j] = rows[width * best + j];
            rows[width * best + j] = swap;
        }
        for (size_t i = 0; i < n; i++) {
            if (i == p) continue;
            const Real by = rows[width * i + p] / rows[width * p + p];
            for (size_t j = p; j < width; j++) rows[width * i + j] -= by * rows[width * p + j];
        }
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = n; j < width; j++) rows[width * i + j] /= rows[width * i + i];
    return true;
}

bool body_points_finish(const StiffnessStep *step, BodyPoints *points, Real stiffness[SIX * SIX]) {
    const size_t n = 3 * points->count, width = n + SIX;
    for (size_t i = 0; i < points->count; i++)
        if (!set_point(step, points, i)) return false;
    if (!eliminate(points->lost, n)) return false;
    for (size_t i = 0; i < SIX; i++)
        for (size_t j = 0; j < SIX; j++)
            for (size_t k = 0; k < n; k++)
                stiffness[SIX * i + j] -=
                    points->feedback[n * i + k] * points->lost[width * k + n + j];
    return true;
}
