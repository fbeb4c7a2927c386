/* SPDX-License-Identifier: BSD-3-Clause */
/* Quickhull in space (Barber, Dobkin and Huhdanpaa 1996). Each point outside the hull is assigned
 * to one triangle that is visible from it. The farthest point of a triangle replaces all triangles
 * visible from it by the triangles between it and their common boundary, the horizon. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "set/hull.h"

/* Points nearer to a plane than this share of the size lie in it. */
static const double ON_PLANE = 1e-12;
/* The normal of a triangle flatter than this (area over the square of the size) is determined by
 * rounding. */
static const double NO_AREA = 1e-14;

typedef struct HullWork {
    int count;
    const double *c;
    double size;
    CpsiTriangle *triangle;
    int triangles, capacity;
    int *next;    /* (count) next point in the list of the same triangle */
    int *at;      /* (count) the new triangle whose edge begins there */
    int *stack;   /* visible triangles, in the order found */
    int *horizon; /* (3 each) triangle across the edge, its edge, unused */
    int stack_capacity;
} HullWork;

static double height(const HullWork *w, const CpsiTriangle *t, int p) {
    const double *x = &w->c[3 * p];
    return t->normal[0] * x[0] + t->normal[1] * x[1] + t->normal[2] * x[2] - t->offset;
}

/* Add a triangle; -1: no memory, -2: no area. */
static int add(HullWork *w, int a, int b, int c) {
    if (w->triangles == w->capacity) {
        const int capacity = 2 * w->capacity + 64;
        CpsiTriangle *more = realloc(w->triangle, (size_t)capacity * sizeof *more);
        if (!more) return -1;
        w->triangle = more;
        w->capacity = capacity;
    }
    CpsiTriangle *t = &w->triangle[w->triangles];
    *t =
        (CpsiTriangle){.corner = {a, b, c}, .neighbour = {-1, -1, -1}, .first = -1, .farthest = -1};
    const double *x = &w->c[3 * a], *y = &w->c[3 * b], *z = &w->c[3 * c];
    const double u[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]},
                 v[3] = {z[0] - x[0], z[1] - x[1], z[2] - x[2]};
    const double m[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                         u[0] * v[1] - u[1] * v[0]};
    const double area = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    if (!(area > NO_AREA * w->size * w->size)) return -2;
    for (int i = 0; i < 3; i++) t->normal[i] = m[i] / area;
    t->offset = t->normal[0] * x[0] + t->normal[1] * x[1] + t->normal[2] * x[2];
    return w->triangles++;
}

/* Assign a point to the triangle if it is outside it. */
static bool take(HullWork *w, int triangle, int p) {
    CpsiTriangle *t = &w->triangle[triangle];
    const double d = height(w, t, p);
    if (!(d > ON_PLANE * w->size)) return false;
    w->next[p] = t->first;
    t->first = p;
    if (d > t->distance) {
        t->distance = d;
        t->farthest = p;
    }
    return true;
}

static void link(HullWork *w, int one, int edge, int other) {
    const int a = w->triangle[one].corner[edge];
    w->triangle[one].neighbour[edge] = other;
    for (int k = 0; k < 3; k++)
        if (w->triangle[other].corner[(k + 1) % 3] == a &&
            w->triangle[other].corner[k] == w->triangle[one].corner[(edge + 1) % 3])
            w->triangle[other].neighbour[k] = one;
}

/* The four triangles of a tetrahedron, with all points assigned. */
static int begin(HullWork *w, const int start[4]) {
    static const int FACE[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    for (int f = 0; f < 4; f++) {
        int v[3] = {start[FACE[f][0]], start[FACE[f][1]], start[FACE[f][2]]};
        const int made = add(w, v[0], v[1], v[2]);
        if (made < 0) return made;
    }
    /* the opposite corner must be visible from none of them */
    int opposite = start[3];
    if (height(w, &w->triangle[0], opposite) > 0) {
        w->triangles = 0;
        for (int f = 0; f < 4; f++) add(w, start[FACE[f][0]], start[FACE[f][2]], start[FACE[f][1]]);
    }
    for (int f = 0; f < 4; f++)
        for (int e = 0; e < 3; e++)
            for (int g = 0; g < 4; g++)
                for (int k = 0; k < 3; k++)
                    if (w->triangle[g].corner[k] == w->triangle[f].corner[(e + 1) % 3] &&
                        w->triangle[g].corner[(k + 1) % 3] == w->triangle[f].corner[e])
                        w->triangle[f].neighbour[e] = g;
    for (int p = 0; p < w->count; p++)
        for (int f = 0; f < 4; f++)
            if (take(w, f, p)) break;
    return 0;
}

/* Allocate for all triangles on the stack and their edges. */
static bool grow(HullWork *w) {
    if (w->stack_capacity >= w->triangles) return true;
    const int capacity = 2 * w->triangles + 64;
    int *stack = realloc(w->stack, (size_t)capacity * sizeof *stack);
    if (stack) w->stack = stack;
    int *horizon = realloc(w->horizon, 6 * (size_t)capacity * sizeof *horizon);
    if (horizon) w->horizon = horizon;
    if (stack && horizon) w->stack_capacity = capacity;
    return stack && horizon;
}

/* The triangles visible from p, searched from one of them, and the edges between those and the
 * others. Returns the number of edges. */
static int look(HullWork *w, int from, int p, int *seen) {
    int edges = 0;
    *seen = 0;
    w->stack[(*seen)++] = from;
    w->triangle[from].visible = true;
    for (int i = 0; i < *seen; i++)
        for (int e = 0; e < 3; e++) {
            const int beyond = w->triangle[w->stack[i]].neighbour[e];
            CpsiTriangle *t = &w->triangle[beyond];
            if (t->visible) continue;
            if (height(w, t, p) > ON_PLANE * w->size) {
                t->visible = true;
                w->stack[(*seen)++] = beyond;
            } else {
                w->horizon[2 * edges] = w->stack[i];
                w->horizon[2 * edges + 1] = e;
                edges++;
            }
        }
    return edges;
}

/* Replace the triangles visible from p. Returns 0; -1: no memory; -2: determined by rounding. */
static int put(HullWork *w, int from, int p) {
    if (!grow(w)) return -1;
    int seen, edges = look(w, from, p, &seen);
    const int first = w->triangles;
    for (int k = 0; k < edges; k++) {
        const int inside = w->horizon[2 * k], e = w->horizon[2 * k + 1];
        const int a = w->triangle[inside].corner[e], b = w->triangle[inside].corner[(e + 1) % 3],
                  beyond = w->triangle[inside].neighbour[e];
        const int made = add(w, a, b, p);
        if (made < 0) return made;
        if (w->at[a] >= first) return -2; /* the horizon passes through a corner twice */
        w->at[a] = made;
        link(w, made, 0, beyond);
    }
    for (int t = first; t < w->triangles; t++) {
        const int after = w->at[w->triangle[t].corner[1]];
        if (after < first) return -2;
        w->triangle[t].neighbour[1] = after;
        w->triangle[after].neighbour[2] = t;
    }
    for (int i = 0; i < seen; i++) {
        CpsiTriangle *old = &w->triangle[w->stack[i]];
        old->gone = true;
        for (int q = old->first, next; q >= 0; q = next) {
            next = w->next[q];
            if (q != p)
                for (int t = first; t < w->triangles; t++)
                    if (take(w, t, q)) break;
        }
        old->first = -1;
    }
    return 0;
}

int cpsi_quickhull(int count, const double *c, double size, const int start[4],
                   CpsiTriangle **triangles) {
    HullWork w = {.count = count, .c = c, .size = size};
    w.next = malloc((size_t)count * sizeof *w.next);
    w.at = malloc((size_t)count * sizeof *w.at);
    int result = w.next && w.at ? 0 : -1;
    for (int i = 0; w.at && i < count; i++) w.at[i] = -1;
    if (result == 0) result = begin(&w, start);
    for (int t = 0; result == 0 && t < w.triangles; t++)
        if (!w.triangle[t].gone && w.triangle[t].first >= 0)
            result = put(&w, t, w.triangle[t].farthest);
    free(w.next);
    free(w.at);
    free(w.stack);
    free(w.horizon);
    if (result != 0) {
        free(w.triangle);
        return result == -1 ? 0 : -1;
    }
    *triangles = w.triangle;
    return w.triangles;
}
