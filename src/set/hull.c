/* SPDX-License-Identifier: BSD-3-Clause */
/* The hull of points: its affine span, then its facets in coordinates of the span (hull.h);
 * projection, margin and gauge from these. */
#include "set/hull.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linalg/dense.h"

/* A point nearer than this share of the size to the span of the others lies in it. */
static const double FLAT = 1e-12;
/* A corner nearer than this share of the size to the line through its neighbours is rounding and is
 * dropped. */
static const double STRAIGHT = 4e-15;
/* Triangles belong to one facet when their corners lie in each other's planes up to this share of
 * the size. */
static const double ONE_FACET = 1e-11;
/* An offset below this share of the size is 0. */
static const double THROUGH_ZERO = 1e-14;

void cpsi_hull_free(CpsiHull *hull) { free(hull); }

/* ---- the polygon ---- */

typedef struct Sorted {
    double x, y;
    int place;
} Sorted;

static int by_place(const void *one, const void *other) {
    const Sorted *a = one, *b = other;
    if (a->x != b->x) return a->x < b->x ? -1 : 1;
    return (a->y > b->y) - (a->y < b->y);
}

static int chain(int count, const double *c, const int *order, int step, double size, int *corner) {
    int top = 0;
    for (int k = 0; k < count; k++) {
        const int next = order[step > 0 ? k : count - 1 - k];
        for (; top >= 2; top--) {
            const double *p = &c[2 * corner[top - 2]], *q = &c[2 * corner[top - 1]],
                         *r = &c[2 * next];
            const double u[2] = {q[0] - p[0], q[1] - p[1]}, v[2] = {r[0] - p[0], r[1] - p[1]};
            if (u[0] * v[1] - u[1] * v[0] > STRAIGHT * size * hypot(v[0], v[1])) break;
        }
        corner[top++] = next;
    }
    return top - 1; /* the last point is the first one of the other chain */
}

int cpsi_polygon(int count, const double *c, double size, int *order, int *corner) {
    Sorted *sorted = malloc((size_t)count * sizeof *sorted);
    if (!sorted) return 0;
    for (int i = 0; i < count; i++) sorted[i] = (Sorted){c[2 * i], c[2 * i + 1], i};
    qsort(sorted, (size_t)count, sizeof *sorted, by_place);
    for (int i = 0; i < count; i++) order[i] = sorted[i].place;
    free(sorted);
    const int lower = chain(count, c, order, 1, size, corner);
    return lower + chain(count, c, order, -1, size, corner + lower);
}

/* ---- the span ---- */

/* Orthonormal rows of the span of the points, each in the direction of the farthest remaining
 * point; these points in `start`. Returns the dimension, 4 if it is more than 3. */
static int span(int n, int count, const double *points, double *basis, int start[4], double *size) {
    double *away = &basis[3 * (size_t)n];
    start[0] = 0;
    *size = 0;
    for (int d = 0; d < 4; d++) {
        double most = 0;
        int farthest = -1;
        for (int k = 0; k < count; k++) {
            for (int i = 0; i < n; i++)
                away[i] = points[(size_t)k * (size_t)n + (size_t)i] - points[i];
            for (int twice = 0; twice < 2; twice++)
                for (int j = 0; j < d; j++) {
                    const double along = cpsi_dot(n, away, &basis[(size_t)j * (size_t)n]);
                    for (int i = 0; i < n; i++)
                        away[i] -= along * basis[(size_t)j * (size_t)n + (size_t)i];
                }
            const double distance = cpsi_norm(n, away);
            if (!(distance > most)) continue;
            most = distance;
            farthest = k;
            if (d < 3)
                for (int i = 0; i < n; i++) basis[(size_t)d * (size_t)n + (size_t)i] = away[i];
        }
        if (d == 0) *size = most;
        if (farthest < 0 || !(most > FLAT * *size)) return d;
        if (d == 3) return 4;
        for (int i = 0; i < n; i++) basis[(size_t)d * (size_t)n + (size_t)i] /= most;
        start[d + 1] = farthest;
    }
    return 4;
}

/* ---- facets ---- */

static CpsiHull *hull_new(int n, int dimension, int rows, int pieces) {
    const size_t w = (size_t)n, d = (size_t)dimension, m = (size_t)rows, normals = w - d;
    CpsiHull *hull =
        calloc(1, sizeof *hull +
                      (m * w + m + normals + w * w + w + (size_t)pieces * d * d) * sizeof(double));
    if (!hull) return NULL;
    *hull = (CpsiHull){.n = n, .dimension = dimension, .rows = rows, .pieces = pieces};
    hull->row = (double *)(void *)(hull + 1);
    hull->offset = hull->row + m * w;
    hull->level = hull->offset + m;
    hull->basis = hull->level + normals; /* the normals complete the basis */
    hull->normal = hull->basis + d * w;
    hull->origin = hull->basis + w * w;
    hull->piece = hull->origin + w;
    return hull;
}

/* Set basis, normals and levels of the span. */
static void place_span(CpsiHull *hull, const double *points, const double *basis) {
    const size_t n = (size_t)hull->n, d = (size_t)hull->dimension;
    memcpy(hull->basis, basis, d * n * sizeof *basis);
    memcpy(hull->origin, points, n * sizeof *points);
    /* a hull of full dimension keeps the coordinate axes */
    if (d == n) {
        memset(hull->basis, 0, n * n * sizeof *basis);
        for (size_t i = 0; i < n; i++) hull->basis[i * n + i] = 1;
    }
    cpsi_complete_rows(hull->dimension, hull->n, hull->basis);
    for (size_t i = 0; i < n - d; i++)
        hull->level[i] = cpsi_dot(hull->n, &hull->normal[i * n], points);
}

/* Row k from a unit normal in coordinates of the span and the largest height of its corners. */
static void place_row(CpsiHull *hull, int k, const double *normal, double height) {
    const size_t n = (size_t)hull->n;
    double *row = &hull->row[(size_t)k * n];
    for (size_t i = 0; i < n; i++) {
        row[i] = 0;
        for (int j = 0; j < hull->dimension; j++)
            row[i] += normal[j] * hull->basis[(size_t)j * n + i];
    }
    hull->offset[k] = height + cpsi_dot(hull->n, row, hull->origin);
}

static CpsiHull *segment(int n, int count, const double *points, const double *basis) {
    CpsiHull *hull = hull_new(n, 1, 2, 2);
    if (!hull) return NULL;
    place_span(hull, points, basis);
    double low = 0, high = 0;
    for (int k = 0; k < count; k++) {
        double along = 0;
        for (int i = 0; i < n; i++)
            along += hull->basis[i] * (points[(size_t)k * (size_t)n + (size_t)i] - points[i]);
        low = fmin(low, along);
        high = fmax(high, along);
    }
    hull->piece[0] = low;
    hull->piece[1] = high;
    place_row(hull, 0, (double[]){-1}, -low);
    place_row(hull, 1, (double[]){1}, high);
    return hull;
}

/* The hull of a polygon, edge by edge. */
static CpsiHull *polygon(int n, int count, const double *points, const double *basis,
                         const double *c, double size) {
    int *order = malloc(3 * (size_t)count * sizeof *order + 2 * sizeof *order),
        *corner = order ? order + count : NULL;
    const int corners = order ? cpsi_polygon(count, c, size, order, corner) : 0;
    CpsiHull *hull = corners > 0 ? hull_new(n, 2, corners, corners) : NULL;
    if (hull) place_span(hull, points, basis);
    if (hull)
        for (int k = 0; k < corners; k++) {
            const double *p = &c[2 * corner[k]], *q = &c[2 * corner[(k + 1) % corners]],
                         length = hypot(q[0] - p[0], q[1] - p[1]);
            const double normal[2] = {(q[1] - p[1]) / length, (p[0] - q[0]) / length};
            memcpy(&hull->piece[4 * k], p, 2 * sizeof *p);
            memcpy(&hull->piece[4 * k + 2], q, 2 * sizeof *q);
            place_row(hull, k, normal,
                      fmax(normal[0] * p[0] + normal[1] * p[1],
                           normal[0] * q[0] + normal[1] * q[1]));
        }
    free(order);
    return hull;
}

static int root_of(int *root, int t) {
    while (root[t] != t) t = root[t] = root[root[t]];
    return t;
}

static double over(const CpsiTriangle *t, const double *x) {
    return t->normal[0] * x[0] + t->normal[1] * x[1] + t->normal[2] * x[2] - t->offset;
}

static double area_of(const CpsiTriangle *t, const double *c) {
    const double *x = &c[3 * t->corner[0]], *y = &c[3 * t->corner[1]], *z = &c[3 * t->corner[2]];
    const double u[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]},
                 v[3] = {z[0] - x[0], z[1] - x[1], z[2] - x[2]};
    return hypot(hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]),
                 u[0] * v[1] - u[1] * v[0]);
}

/* Determine which triangles form one facet; a facet is represented by its largest triangle. */
static void join_facets(int triangles, const CpsiTriangle *triangle, const double *c, double size,
                        int *root) {
    for (int t = 0; t < triangles; t++) root[t] = t;
    for (int t = 0; t < triangles; t++)
        for (int e = 0; !triangle[t].gone && e < 3; e++) {
            const CpsiTriangle *one = &triangle[t], *other = &triangle[one->neighbour[e]];
            double off = 0;
            for (int k = 0; k < 3; k++)
                off = fmax(off, fmax(fabs(over(one, &c[3 * other->corner[k]])),
                                     fabs(over(other, &c[3 * one->corner[k]]))));
            const int a = root_of(root, t), b = root_of(root, one->neighbour[e]);
            if (off > ONE_FACET * size || a == b) continue;
            if (area_of(&triangle[a], c) >= area_of(&triangle[b], c))
                root[b] = a;
            else
                root[a] = b;
        }
}

static CpsiHull *polyhedron(int n, const double *points, const double *basis, const double *c,
                            double size, int triangles, const CpsiTriangle *triangle) {
    int *root = malloc((size_t)triangles * sizeof *root), rows = 0, pieces = 0;
    if (!root) return NULL;
    join_facets(triangles, triangle, c, size, root);
    for (int t = 0; t < triangles; t++)
        if (!triangle[t].gone) {
            pieces++;
            rows += root_of(root, t) == t;
        }
    CpsiHull *hull = hull_new(n, 3, rows, pieces);
    if (hull) place_span(hull, points, basis);
    if (hull)
        for (int t = 0, piece = 0, row = 0; t < triangles; t++) {
            if (triangle[t].gone) continue;
            for (int k = 0; k < 3; k++)
                memcpy(&hull->piece[9 * piece + 3 * k], &c[3 * triangle[t].corner[k]],
                       3 * sizeof *c);
            piece++;
            if (root_of(root, t) == t)
                place_row(hull, row++, triangle[t].normal, triangle[t].offset);
        }
    free(root);
    return hull;
}

CpsiHull *cpsi_hull_new(int n, int count, const double *points, bool *known) {
    const size_t w = (size_t)n;
    double *basis = malloc((4 * w + 3 * (size_t)count) * sizeof *basis),
           *c = basis ? basis + 4 * w : NULL, size = 0;
    int start[4];
    CpsiHull *hull = NULL;
    *known = true;
    if (!basis) return NULL;
    const int d = span(n, count, points, basis, start, &size);
    *known = d >= 1 && d <= 3;
    if (*known)
        for (int k = 0; k < count; k++)
            for (int j = 0; j < d; j++) {
                double along = 0;
                for (size_t i = 0; i < w; i++)
                    along += (d == n ? (double)(i == (size_t)j) : basis[(size_t)j * w + i]) *
                             (points[(size_t)k * w + i] - points[i]);
                c[k * d + j] = along;
            }
    CpsiTriangle *triangle = NULL;
    if (d == 1) hull = segment(n, count, points, basis);
    if (d == 2) hull = polygon(n, count, points, basis, c, size);
    if (d == 3) {
        const int triangles = cpsi_quickhull(count, c, size, start, &triangle);
        *known = triangles >= 0;
        if (triangles > 0) hull = polyhedron(n, points, basis, c, size, triangles, triangle);
    }
    if (hull) hull->size = size;
    free(triangle);
    free(basis);
    return hull;
}

/* ---- projection, margin, gauge ---- */

double cpsi_hull_margin(const CpsiHull *hull, const double *p) {
    double least = INFINITY;
    for (int k = 0; k < hull->rows; k++)
        least = fmin(least, hull->offset[k] -
                                cpsi_dot(hull->n, &hull->row[(size_t)k * (size_t)hull->n], p));
    return least;
}

double cpsi_hull_gauge(const CpsiHull *hull, const double *p) {
    const size_t n = (size_t)hull->n;
    const double nothing = THROUGH_ZERO * cpsi_norm(hull->n, p);
    double value = 0;
    for (size_t i = 0; i < n - (size_t)hull->dimension; i++)
        if (fabs(cpsi_dot(hull->n, &hull->normal[i * n], p)) > 1e4 * nothing) return INFINITY;
    for (int k = 0; k < hull->rows; k++) {
        const double along = cpsi_dot(hull->n, &hull->row[(size_t)k * n], p);
        const double end = hull->offset[k] > THROUGH_ZERO * hull->size ? hull->offset[k] : 0;
        if (along > nothing) value = fmax(value, along / end);
    }
    return value;
}

void cpsi_nearest_on_segment(int n, const double *from, const double *to, const double *p,
                             double *nearest) {
    double along = 0, square = 0;
    for (int i = 0; i < n; i++) {
        along += (p[i] - from[i]) * (to[i] - from[i]);
        square += (to[i] - from[i]) * (to[i] - from[i]);
    }
    const double t = square > 0 ? fmin(1, fmax(0, along / square)) : 0;
    for (int i = 0; i < n; i++)
        nearest[i] =
            t < 0.5 ? from[i] + t * (to[i] - from[i]) : to[i] - (1 - t) * (to[i] - from[i]);
}

/* The nearest point of a triangle: the foot of the perpendicular where that lies inside, else a
 * point of an edge. */
static void nearest_on_triangle(const double *corner, const double *p, double *nearest) {
    const double *a = corner, *b = corner + 3, *c = corner + 6;
    double u[3], v[3], w[3], best = INFINITY, uu = 0, uv = 0, vv = 0, uw = 0, vw = 0;
    for (int i = 0; i < 3; i++) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
        w[i] = p[i] - a[i];
        uu += u[i] * u[i];
        uv += u[i] * v[i];
        vv += v[i] * v[i];
        uw += u[i] * w[i];
        vw += v[i] * w[i];
    }
    const double det = uu * vv - uv * uv, s = (vv * uw - uv * vw) / det,
                 t = (uu * vw - uv * uw) / det;
    if (det > 0 && s >= 0 && t >= 0 && s + t <= 1) {
        for (int i = 0; i < 3; i++) nearest[i] = a[i] + s * u[i] + t * v[i];
        return;
    }
    for (int e = 0; e < 3; e++) {
        double x[3], square = 0;
        cpsi_nearest_on_segment(3, &corner[3 * e], &corner[3 * ((e + 1) % 3)], p, x);
        for (int i = 0; i < 3; i++) square += (p[i] - x[i]) * (p[i] - x[i]);
        if (square < best) {
            best = square;
            memcpy(nearest, x, sizeof x);
        }
    }
}

void cpsi_hull_project(const CpsiHull *hull, const double *p, double *nearest) {
    const size_t n = (size_t)hull->n;
    const int d = hull->dimension;
    double c[3] = {0}, best[3] = {0}, x[3], least = INFINITY;
    for (int j = 0; j < d; j++)
        for (size_t i = 0; i < n; i++)
            c[j] += hull->basis[(size_t)j * n + i] * (p[i] - hull->origin[i]);
    bool inside = cpsi_hull_margin(hull, p) >= 0;
    if (inside && d == hull->n) {
        memcpy(nearest, p, n * sizeof *p);
        return;
    }
    if (inside) memcpy(best, c, sizeof best);
    if (d == 1 && !inside) best[0] = fmin(hull->piece[1], fmax(hull->piece[0], c[0]));
    if (d > 1 && !inside)
        for (int k = 0; k < hull->pieces; k++) {
            if (d == 2)
                cpsi_nearest_on_segment(2, &hull->piece[4 * k], &hull->piece[4 * k + 2], c, x);
            else
                nearest_on_triangle(&hull->piece[9 * k], c, x);
            double square = 0;
            for (int i = 0; i < d; i++) square += (c[i] - x[i]) * (c[i] - x[i]);
            if (square < least) {
                least = square;
                memcpy(best, x, sizeof best);
            }
        }
    for (size_t i = 0; i < n; i++) {
        nearest[i] = hull->origin[i];
        for (int j = 0; j < d; j++) nearest[i] += best[j] * hull->basis[(size_t)j * n + i];
    }
}
