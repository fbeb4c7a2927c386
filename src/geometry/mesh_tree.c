/* SPDX-License-Identifier: BSD-3-Clause */
/* The tree of a mesh, and the nearest point of its triangles (mesh.h).
 *
 * The triangles are halved by the median of their middles along the longest side of these, again
 * and again, until a leaf has at most four. Node i of the tree has the halves 2 i + 1 and 2 i + 2,
 * and its range of triangles follows from the halving, so the tree is one array of boxes. A search
 * goes into the nearer half first and leaves out boxes that are farther than the best point so far:
 * O(log n) for a point near the surface. It allocates nothing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/mesh.h"

enum { LEAF = 4, DEEPEST = 32 };

/* [rad] Two faces that turn by less are one plane: the direction from their edge to a point near by
 * is rounding. */
static const double FLAT = 1e-7;
/* [-] Rounding of the length of a mean of unit normals. */
static const double ROUNDING = 1e-14;

/* ---- building ---- */

typedef struct TriangleMiddle {
    double at[3];
    int triangle;
} TriangleMiddle;

int cpsi_mesh_depth(int triangle_count) {
    int depth = 0;
    while (((triangle_count - 1) >> depth) + 1 > LEAF) depth++;
    return depth;
}

Vec3 cpsi_mesh_corner(const CpsMesh *mesh, int triangle, int corner) {
    return vec3_at(mesh->vertex, mesh->triangle[3 * (size_t)triangle + (size_t)corner]);
}

static void add_to_box(CpsiBox *box, const double x[3]) {
    for (int k = 0; k < 3; k++) {
        box->low[k] = fmin(box->low[k], x[k]);
        box->high[k] = fmax(box->high[k], x[k]);
    }
}

static CpsiBox empty_box(void) {
    return (CpsiBox){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static void swap(TriangleMiddle *a, TriangleMiddle *b) {
    const TriangleMiddle kept = *a;
    *a = *b;
    *b = kept;
}

/* Order middle[0..count) so that none before `place` is beyond it along the axis, and none after it
 * before it (Hoare's selection). */
static void select_place(TriangleMiddle *middle, int count, int place, int axis) {
    int low = 0, high = count - 1;
    while (low < high) {
        const double pivot = middle[low + (high - low) / 2].at[axis];
        int i = low, j = high;
        while (i <= j) {
            while (middle[i].at[axis] < pivot) i++;
            while (middle[j].at[axis] > pivot) j--;
            if (i <= j) swap(&middle[i++], &middle[j--]);
        }
        if (place <= j)
            high = j;
        else if (place >= i)
            low = i;
        else
            return;
    }
}

/* Halve the triangles first..first + count, the range of a node at a depth. */
static void halve(TriangleMiddle *middle, int first, int count, int depth) {
    if (depth == 0 || count < 2) return;
    CpsiBox box = empty_box();
    for (int i = first; i < first + count; i++) add_to_box(&box, middle[i].at);
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
    const int half = count / 2;
    select_place(&middle[first], count, half, axis);
    halve(middle, first, half, depth - 1);
    halve(middle, first + half, count - half, depth - 1);
}

/* The box of a node, from those of its halves or the corners of a leaf's triangles. */
static void fill_boxes(CpsMesh *mesh, int node, int first, int count, int depth) {
    CpsiBox box = empty_box();
    if (depth == 0) {
        for (int t = first; t < first + count; t++)
            for (int i = 0; i < 3; i++)
                add_to_box(&box,
                           &mesh->vertex[3 * (size_t)mesh->triangle[3 * (size_t)t + (size_t)i]]);
    } else {
        const int half = count / 2;
        for (int k = 0; k < 2; k++) {
            const int child = 2 * node + 1 + k;
            fill_boxes(mesh, child, k ? first + half : first, k ? count - half : half, depth - 1);
            add_to_box(&box, mesh->box[child].low);
            add_to_box(&box, mesh->box[child].high);
        }
    }
    mesh->box[node] = box;
}

bool cpsi_mesh_plant(CpsMesh *mesh) {
    const size_t n = (size_t)mesh->triangle_count;
    TriangleMiddle *middle = malloc(n * sizeof *middle);
    int *ordered = malloc(3 * n * sizeof *ordered);
    if (middle && ordered) {
        for (int t = 0; t < mesh->triangle_count; t++) {
            const Vec3 sum =
                vec3_add(vec3_add(cpsi_mesh_corner(mesh, t, 0), cpsi_mesh_corner(mesh, t, 1)),
                         cpsi_mesh_corner(mesh, t, 2));
            vec3_store(middle[t].at, sum);
            middle[t].triangle = t;
        }
        halve(middle, 0, mesh->triangle_count, mesh->depth);
        for (size_t t = 0; t < n; t++)
            memcpy(&ordered[3 * t], &mesh->triangle[3 * (size_t)middle[t].triangle],
                   3 * sizeof *ordered);
        memcpy(mesh->triangle, ordered, 3 * n * sizeof *ordered);
        fill_boxes(mesh, 0, 0, mesh->triangle_count, mesh->depth);
    }
    const bool done = middle && ordered;
    free(middle);
    free(ordered);
    return done;
}

/* ---- nearest point ---- */

Vec3 cpsi_mesh_normal(const CpsMesh *mesh, int t) {
    const Vec3 a = cpsi_mesh_corner(mesh, t, 0);
    const Vec3 n = vec3_cross(vec3_sub(cpsi_mesh_corner(mesh, t, 1), a),
                              vec3_sub(cpsi_mesh_corner(mesh, t, 2), a));
    return vec3_scale(1 / vec3_norm(n), n);
}

static double square_to_box(const CpsiBox *box, const double x[3]) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double out = fmax(0, fmax(box->low[k] - x[k], x[k] - box->high[k]));
        sum += out * out;
    }
    return sum;
}

/* The point of the straight line from a to b that is nearest to x: its share of the way, clipped to
 * 0..1. */
static double share_of(Vec3 a, Vec3 b, Vec3 x) {
    const Vec3 along = vec3_sub(b, a);
    return fmin(1, fmax(0, vec3_dot(vec3_sub(x, a), along) / vec3_dot(along, along)));
}

/* The nearest point of a triangle, and which part it is on: of the face, if x is above that: on the
 * inner side of all three edges; else the nearest of the edges'. */
static double nearest_of(const CpsMesh *mesh, int t, Vec3 x, CpsiMeshFoot *out) {
    const Vec3 p[3] = {cpsi_mesh_corner(mesh, t, 0), cpsi_mesh_corner(mesh, t, 1),
                       cpsi_mesh_corner(mesh, t, 2)};
    const Vec3 n = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    double least = INFINITY;
    bool above = true;
    for (int i = 0; i < 3; i++) {
        const Vec3 a = p[i], b = p[(i + 1) % 3];
        if (vec3_dot(vec3_cross(n, vec3_sub(b, a)), vec3_sub(x, a)) >= 0) continue;
        above = false;
        const double share = share_of(a, b, x);
        const Vec3 at = share < 1 ? vec3_axpy(share, vec3_sub(b, a), a) : b, arm = vec3_sub(x, at);
        const double square = vec3_dot(arm, arm);
        if (!(square < least)) continue;
        least = square;
        out->foot = at;
        out->part = share <= 0   ? CPSI_MESH_CORNER + i
                    : share >= 1 ? CPSI_MESH_CORNER + (i + 1) % 3
                                 : CPSI_MESH_EDGE + i;
    }
    out->triangle = t;
    if (!above) return least;
    const double size = vec3_norm(n), height = vec3_dot(vec3_sub(x, p[0]), n) / size;
    out->foot = vec3_axpy(-height / size, n, x);
    out->part = CPSI_MESH_FACE;
    return height * height;
}

typedef struct Visit {
    int node, first, count, depth;
    double square; /* of the distance from its box */
} Visit;

static void search_leaf(const CpsMesh *mesh, const Visit *at, Vec3 x, double *least,
                        CpsiMeshFoot *best) {
    for (int t = at->first; t < at->first + at->count; t++) {
        CpsiMeshFoot found;
        const double square = nearest_of(mesh, t, x, &found);
        if (!(square < *least)) continue;
        *least = square;
        *best = found;
    }
}

static double search(const CpsMesh *mesh, Vec3 x, CpsiMeshFoot *best) {
    const double at[3] = {x.x, x.y, x.z};
    Visit open[DEEPEST + 2];
    int count = 0;
    double least = INFINITY;
    open[count++] = (Visit){0, 0, mesh->triangle_count, mesh->depth, 0};
    while (count > 0) {
        const Visit now = open[--count];
        if (!(now.square < least)) continue;
        if (now.depth == 0) {
            search_leaf(mesh, &now, x, &least, best);
            continue;
        }
        const int half = now.count / 2, child = 2 * now.node + 1;
        Visit low = {child, now.first, half, now.depth - 1, square_to_box(&mesh->box[child], at)},
              high = {child + 1, now.first + half, now.count - half, now.depth - 1,
                      square_to_box(&mesh->box[child + 1], at)};
        const bool low_first = low.square <= high.square;
        open[count++] = low_first ? high : low; /* the nearer one is taken next */
        open[count++] = low_first ? low : high;
    }
    return least;
}

/* The normal on whose side a point is free whose foot is on this part; 0 at a rim, where all are.
 * By Baerentzen and Aanaes (2005) the sign of a distance follows from the sum of the normals of the
 * faces that meet in the foot, weighted by their angles there. */
static Vec3 side_of(const CpsMesh *mesh, const CpsiMeshFoot *at) {
    const Vec3 n = cpsi_mesh_normal(mesh, at->triangle);
    if (at->part == CPSI_MESH_FACE) return n;
    if (at->part >= CPSI_MESH_CORNER)
        return vec3_at(
            mesh->normal,
            mesh->triangle[3 * (size_t)at->triangle + (size_t)(at->part - CPSI_MESH_CORNER)]);
    const int beyond =
        mesh->neighbour[3 * (size_t)at->triangle + (size_t)(at->part - CPSI_MESH_EDGE)];
    return beyond < 0 ? vec3(0, 0, 0) : vec3_add(n, cpsi_mesh_normal(mesh, beyond));
}

/* A foot on an edge or corner between faces of one plane is on the face. */
static void join_flat(const CpsMesh *mesh, CpsiMeshFoot *at) {
    if (at->part == CPSI_MESH_FACE) return;
    const Vec3 n = cpsi_mesh_normal(mesh, at->triangle), side = side_of(mesh, at);
    const double size = vec3_norm(side);
    if (at->part >= CPSI_MESH_CORNER ? size >= 1 - ROUNDING : vec3_dot(n, side) >= 2 - FLAT * FLAT)
        at->part = CPSI_MESH_FACE;
}

void cpsi_mesh_orient(const CpsMesh *mesh, Vec3 x, CpsiMeshFoot *at) {
    const double distance = at->distance;
    join_flat(mesh, at);
    const Vec3 side = side_of(mesh, at), arm = vec3_sub(x, at->foot);
    const bool below = !mesh->two_sided && vec3_dot(arm, side) < 0;
    if (at->part == CPSI_MESH_FACE) {
        const double height = vec3_dot(vec3_sub(x, cpsi_mesh_corner(mesh, at->triangle, 0)), side);
        at->distance = mesh->two_sided ? fabs(height) : height;
        at->normal = mesh->two_sided && height < 0 ? vec3_scale(-1, side) : side;
        return;
    }
    const double size = vec3_norm(side);
    at->distance = below ? -distance : distance;
    if (distance > 0)
        at->normal = vec3_scale(1 / at->distance, arm);
    else if (size > 0)
        at->normal = vec3_scale(1 / size, side);
    else
        at->normal = cpsi_mesh_normal(mesh, at->triangle);
}

CpsiMeshFoot cpsi_mesh_nearest(const CpsMesh *mesh, Vec3 x) {
    CpsiMeshFoot out = {.foot = x, .normal = vec3(0, 0, 1)};
    out.distance = sqrt(search(mesh, x, &out));
    if (isfinite(out.distance))
        cpsi_mesh_orient(mesh, x, &out);
    else /* no place: as if deep inside, so that nothing here is certified */
        out.distance =
            -vec3_norm(vec3_sub(vec3_load(mesh->report.high), vec3_load(mesh->report.low)));
    return out;
}

CpsiMeshFoot cpsi_mesh_nearest_of(const CpsMesh *mesh, int t, Vec3 x) {
    CpsiMeshFoot out = {0};
    out.distance = sqrt(nearest_of(mesh, t, x, &out));
    return out;
}

void cpsi_mesh_each_within(const CpsMesh *mesh, Vec3 x, double within,
                           void (*take)(void *into, const CpsiMeshFoot *foot), void *into) {
    const double at[3] = {x.x, x.y, x.z};
    Visit open[DEEPEST + 2];
    int count = 0;
    open[count++] =
        (Visit){0, 0, mesh->triangle_count, mesh->depth, square_to_box(&mesh->box[0], at)};
    while (count > 0) {
        const Visit now = open[--count];
        if (!(now.square <= within * within)) continue;
        if (now.depth > 0) {
            const int half = now.count / 2, child = 2 * now.node + 1;
            open[count++] = (Visit){child + 1, now.first + half, now.count - half, now.depth - 1,
                                    square_to_box(&mesh->box[child + 1], at)};
            open[count++] = (Visit){child, now.first, half, now.depth - 1,
                                    square_to_box(&mesh->box[child], at)};
            continue;
        }
        for (int t = now.first; t < now.first + now.count; t++) {
            const CpsiMeshFoot found = cpsi_mesh_nearest_of(mesh, t, x);
            if (found.distance <= within) take(into, &found);
        }
    }
}

double cps_mesh_distance(const CpsMesh *mesh, const double x[3], double foot[3]) {
    const CpsiMeshFoot at = cpsi_mesh_nearest(mesh, vec3_load(x));
    if (foot) vec3_store(foot, at.foot);
    return at.distance;
}
