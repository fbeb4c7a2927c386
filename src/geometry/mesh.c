/* SPDX-License-Identifier: BSD-3-Clause */
/* Making a mesh (capstan/mesh.h): its triangles are checked, vertices of one place joined, faces
 * linked across their edges, and the normals at vertices summed. Equal items are found by a table
 * of hashes, in time proportional to their number. */
#include "geometry/mesh.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"

enum { COOKIE = 0x6d657368 };
/* Numbers beyond this are not places; fourth powers of them stay finite. */
static const double FARTHEST = 1e60;
/* [-] A triangle whose height is less than this part of its longest side lies on one line: float
 * coordinates of files are rounded to 6e-8. */
static const double SLENDER = 1e-9;

/* [-] Below this cosine of the angle between their normals two faces have nothing between them. */
static const double FOLDED = -1 + 1e-12;

CpsMeshTriangles cps_mesh_triangles_default(void) { return (CpsMeshTriangles){.cookie = COOKIE}; }

/* ---- equal items ---- */

/* A table of the items seen so far; `key` gives the bytes by which item i is compared. */
typedef struct ItemTable {
    size_t mask; /* number of slots less one, a power of two less one */
    int *slot;   /* -1: empty */
    void (*key)(const void *of, int i, int64_t out[3]);
    const void *of;
} ItemTable;

static bool table_begin(ItemTable *table, size_t items) {
    table->mask = 15;
    while (table->mask < 2 * items) table->mask = 2 * table->mask + 1;
    table->slot = malloc((table->mask + 1) * sizeof *table->slot);
    if (table->slot) memset(table->slot, 0xff, (table->mask + 1) * sizeof *table->slot);
    return table->slot != NULL;
}

/* The first item equal to item i, which is i itself if it is the first. */
static int first_like(ItemTable *table, int i) {
    int64_t mine[3], other[3];
    table->key(table->of, i, mine);
    uint64_t hash = 1469598103934665603u;
    for (int k = 0; k < 3; k++) {
        hash = (hash ^ (uint64_t)mine[k]) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    for (size_t at = (size_t)hash & table->mask;; at = (at + 1) & table->mask) {
        if (table->slot[at] < 0) return table->slot[at] = i;
        table->key(table->of, table->slot[at], other);
        if (memcmp(mine, other, sizeof mine) == 0) return table->slot[at];
    }
}

/* A vertex: its coordinates, with one zero. */
static void place_key(const void *of, int i, int64_t out[3]) {
    for (int k = 0; k < 3; k++) {
        const double x = ((const double *)of)[3 * (size_t)i + (size_t)k] + 0.0;
        memcpy(&out[k], &x, sizeof x);
    }
}

static const int *corners_of(const int *triangle, int t) { return &triangle[3 * (size_t)t]; }

/* A triangle: its corners, the smallest first, in their order; for two sides in rising order. */
static void turned_key(const void *of, int i, int64_t out[3]) {
    const int *c = corners_of(of, i);
    const int first = c[0] < c[1] ? (c[0] < c[2] ? 0 : 2) : (c[1] < c[2] ? 1 : 2);
    for (int k = 0; k < 3; k++) out[k] = c[(first + k) % 3];
}

static void sorted_key(const void *of, int i, int64_t out[3]) {
    turned_key(of, i, out);
    if (out[1] < out[2]) return;
    const int64_t kept = out[1];
    out[1] = out[2];
    out[2] = kept;
}

/* Edge h = 3 t + i of triangle t, from corner i to the next: its ends in rising order. */
static void edge_key(const void *of, int h, int64_t out[3]) {
    const int *c = corners_of(of, h / 3), a = c[h % 3], b = c[(h + 1) % 3];
    out[0] = a < b ? a : b;
    out[1] = a < b ? b : a;
    out[2] = 0;
}

/* ---- checks ---- */

static CpsStatus check(const CpsMeshTriangles *given, CpsError *err) {
    if (given->cookie != COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "mesh: the triangles were not made by cps_mesh_triangles_default()");
    const int vertices = given->vertex_count, triangles = given->triangle_count;
    if (vertices < 3 || vertices > CPS_MAX_MESH_VERTICES)
        return cpsi_fail(err, vertices < 3 ? CPS_ERR_ARGUMENT : CPS_ERR_LIMIT,
                         "mesh: %d vertices, expected 3 to %d", vertices, CPS_MAX_MESH_VERTICES);
    if (triangles < 1 || triangles > CPS_MAX_MESH_TRIANGLES)
        return cpsi_fail(err, triangles < 1 ? CPS_ERR_ARGUMENT : CPS_ERR_LIMIT,
                         "mesh: %d triangles, expected 1 to %d", triangles, CPS_MAX_MESH_TRIANGLES);
    if (!given->vertex || !given->triangle)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "mesh: its %s are NULL",
                         given->vertex ? "triangles" : "vertices");
    for (int v = 0; v < vertices; v++)
        for (int k = 0; k < 3; k++) {
            const double x = given->vertex[3 * (size_t)v + (size_t)k];
            if (!(fabs(x) <= FARTHEST))
                return cpsi_fail(err, CPS_ERR_ARGUMENT,
                                 "mesh: vertex %d has the coordinate %g m, expected a finite "
                                 "number of at most %g",
                                 v, x, FARTHEST);
        }
    for (int t = 0; t < triangles; t++)
        for (int i = 0; i < 3; i++) {
            const int v = corners_of(given->triangle, t)[i];
            if (v < 0 || v >= vertices)
                return cpsi_fail(err, CPS_ERR_ARGUMENT,
                                 "mesh: triangle %d has vertex %d, expected one of 0 to %d", t, v,
                                 vertices - 1);
        }
    return CPS_OK;
}

/* ---- joining ---- */

/* Number the different vertices; index[v] is the number of vertex v. */
static bool join_vertices(CpsMesh *mesh, const CpsMeshTriangles *given, int *index) {
    ItemTable table = {.key = place_key, .of = given->vertex};
    if (!table_begin(&table, (size_t)given->vertex_count)) return false;
    mesh->vertex_count = 0;
    for (int v = 0; v < given->vertex_count; v++) {
        const int first = first_like(&table, v);
        if (first < v) {
            index[v] = index[first];
            continue;
        }
        index[v] = mesh->vertex_count++;
        memcpy(&mesh->vertex[3 * (size_t)index[v]], &given->vertex[3 * (size_t)v],
               3 * sizeof *mesh->vertex);
    }
    free(table.slot);
    return true;
}

/* Are the corners on one line? */
static bool is_slender(const CpsMesh *mesh, int t) {
    const Vec3 a = cpsi_mesh_corner(mesh, t, 0), b = cpsi_mesh_corner(mesh, t, 1),
               c = cpsi_mesh_corner(mesh, t, 2);
    const Vec3 ab = vec3_sub(b, a), ac = vec3_sub(c, a), bc = vec3_sub(c, b);
    const double longest = fmax(vec3_dot(ab, ab), fmax(vec3_dot(ac, ac), vec3_dot(bc, bc)));
    return !(vec3_norm(vec3_cross(ab, ac)) > SLENDER * longest);
}

/* Take the triangles over with the numbers of their vertices, without those that have two corners
 * in one place or are there already. */
static CpsStatus take_triangles(CpsMesh *mesh, const CpsMeshTriangles *given, const int *index,
                                CpsError *err) {
    ItemTable table = {.key = given->two_sided ? sorted_key : turned_key, .of = mesh->triangle};
    if (!table_begin(&table, (size_t)given->triangle_count))
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for %d triangles", given->triangle_count);
    CpsStatus status = CPS_OK;
    int count = 0;
    for (int t = 0; t < given->triangle_count && status == CPS_OK; t++) {
        int *c = &mesh->triangle[3 * (size_t)count];
        for (int i = 0; i < 3; i++) c[i] = index[corners_of(given->triangle, t)[i]];
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
        if (is_slender(mesh, count))
            status =
                cpsi_fail(err, CPS_ERR_ARGUMENT,
                          "mesh: the corners of triangle %d lie on one line, beside (%g, %g, "
                          "%g) m: remove it, or join it with its neighbours",
                          t, mesh->vertex[3 * (size_t)c[0]], mesh->vertex[3 * (size_t)c[0] + 1],
                          mesh->vertex[3 * (size_t)c[0] + 2]);
        else if (first_like(&table, count) == count)
            count++;
    }
    free(table.slot);
    mesh->triangle_count = count;
    mesh->report.left_out_count = given->triangle_count - count;
    if (status == CPS_OK && count == 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "mesh: each of its %d triangles has two corners in one place",
                         given->triangle_count);
    return status;
}

static CpsStatus fail_edge(const CpsMesh *mesh, int h, const char *what, CpsError *err) {
    const int *c = corners_of(mesh->triangle, h / 3);
    const double *a = &mesh->vertex[3 * (size_t)c[h % 3]],
                 *b = &mesh->vertex[3 * (size_t)c[(h + 1) % 3]];
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "mesh: %s the edge from (%g, %g, %g) to (%g, %g, %g) m, so its free side is "
                     "not known: mend it, or give it two sides",
                     what, a[0], a[1], a[2], b[0], b[1], b[2]);
}

/* Do the faces lie on each other, back to back? */
static bool are_folded(const CpsMesh *mesh, int t, int s) {
    return vec3_dot(cpsi_mesh_normal(mesh, t), cpsi_mesh_normal(mesh, s)) < FOLDED;
}

/* Link the faces across their edges. */
static CpsStatus link_faces(CpsMesh *mesh, CpsError *err) {
    const int edges = 3 * mesh->triangle_count;
    ItemTable table = {.key = edge_key, .of = mesh->triangle};
    if (!table_begin(&table, (size_t)edges))
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for %d edges", edges);
    for (int h = 0; h < edges; h++) mesh->neighbour[h] = -1;
    CpsStatus status = CPS_OK;
    int rim = 0;
    for (int h = 0; h < edges && status == CPS_OK; h++) {
        const int g = first_like(&table, h);
        if (g == h) {
            rim++;
            continue;
        }
        const bool third = mesh->neighbour[g] >= 0,
                   alike = corners_of(mesh->triangle, g / 3)[g % 3] !=
                           corners_of(mesh->triangle, h / 3)[h % 3];
        if (!mesh->two_sided && third)
            status = fail_edge(mesh, h, "more than two triangles meet at", err);
        else if (!mesh->two_sided && !alike)
            status = fail_edge(mesh, h, "two triangles are turned against each other at", err);
        if (third) continue;
        mesh->neighbour[g] = h / 3;
        mesh->neighbour[h] = g / 3;
        rim--;
        if (!mesh->two_sided && status == CPS_OK && are_folded(mesh, g / 3, h / 3))
            status = fail_edge(mesh, h, "two triangles lie on each other at", err);
    }
    free(table.slot);
    mesh->report.rim_count = rim;
    return status;
}

/* ---- normals and ranges ---- */

/* The angle of a triangle at a corner. */
static double angle_at(const CpsMesh *mesh, int t, int i) {
    const Vec3 p = cpsi_mesh_corner(mesh, t, i);
    const Vec3 a = vec3_sub(cpsi_mesh_corner(mesh, t, (i + 1) % 3), p),
               b = vec3_sub(cpsi_mesh_corner(mesh, t, (i + 2) % 3), p);
    return atan2(vec3_norm(vec3_cross(a, b)), vec3_dot(a, b));
}

/* The means of the normals at the vertices; `angle` is memory for the sums of the angles. */
static void sum_normals(CpsMesh *mesh, double *angle) {
    memset(mesh->normal, 0, 3 * (size_t)mesh->vertex_count * sizeof *mesh->normal);
    memset(angle, 0, (size_t)mesh->vertex_count * sizeof *angle);
    for (int t = 0; t < mesh->triangle_count; t++) {
        const Vec3 n = cpsi_mesh_normal(mesh, t);
        for (int i = 0; i < 3; i++) {
            const int v = corners_of(mesh->triangle, t)[i];
            const double at = angle_at(mesh, t, i);
            double *sum = &mesh->normal[3 * (size_t)v];
            vec3_store(sum, vec3_axpy(at, n, vec3_load(sum)));
            angle[v] += at;
        }
    }
    for (int v = 0; v < mesh->vertex_count; v++)
        for (int k = 0; k < 3; k++)
            if (angle[v] > 0) mesh->normal[3 * (size_t)v + (size_t)k] /= angle[v];
    for (int h = 0; h < 3 * mesh->triangle_count; h++)
        for (int end = 0; end < 2 && mesh->neighbour[h] < 0; end++) { /* a rim */
            const int v = corners_of(mesh->triangle, h / 3)[(h + end) % 3];
            memset(&mesh->normal[3 * (size_t)v], 0, 3 * sizeof *mesh->normal);
        }
}

static Vec3 middle_of(const CpsMesh *mesh, int t) {
    const Vec3 sum = vec3_add(vec3_add(cpsi_mesh_corner(mesh, t, 0), cpsi_mesh_corner(mesh, t, 1)),
                              cpsi_mesh_corner(mesh, t, 2));
    return vec3_scale(1.0 / 3, sum);
}

/* The distance from the middle of a face to that of its neighbour over the angle between them, the
 * least of three: of triangles on a ball about its radius. */
static void find_ranges(CpsMesh *mesh) {
    for (int t = 0; t < mesh->triangle_count; t++) {
        const Vec3 n = cpsi_mesh_normal(mesh, t), from = middle_of(mesh, t);
        mesh->range[t] = INFINITY;
        for (int i = 0; i < 3; i++) {
            const int beyond = mesh->neighbour[3 * (size_t)t + (size_t)i];
            if (beyond < 0) continue;
            const Vec3 m = cpsi_mesh_normal(mesh, beyond);
            const double turn = atan2(vec3_norm(vec3_cross(n, m)), vec3_dot(n, m));
            mesh->range[t] =
                fmin(mesh->range[t], vec3_norm(vec3_sub(middle_of(mesh, beyond), from)) / turn);
        }
    }
}

static void measure(CpsMesh *mesh) {
    CpsMeshReport *report = &mesh->report;
    memcpy(report->low, mesh->box[0].low, sizeof report->low);
    memcpy(report->high, mesh->box[0].high, sizeof report->high);
    if (report->rim_count > 0) return;
    const Vec3 origin = vec3_load(report->low);
    for (int t = 0; t < mesh->triangle_count; t++) {
        const Vec3 a = vec3_sub(cpsi_mesh_corner(mesh, t, 0), origin),
                   b = vec3_sub(cpsi_mesh_corner(mesh, t, 1), origin),
                   c = vec3_sub(cpsi_mesh_corner(mesh, t, 2), origin);
        report->volume += vec3_dot(a, vec3_cross(b, c)) / 6;
    }
}

/* ---- all ---- */

static void discard(CpsMesh *mesh) {
    if (!mesh) return;
    free(mesh->vertex);
    free(mesh->triangle);
    free(mesh->neighbour);
    free(mesh->normal);
    free(mesh->range);
    free(mesh->box);
    free(mesh);
}

/* Memory for what was given; false: there is none. */
static bool allocate(CpsMesh *mesh, const CpsMeshTriangles *given) {
    const size_t vertices = (size_t)given->vertex_count, triangles = (size_t)given->triangle_count;
    mesh->vertex = malloc(3 * vertices * sizeof *mesh->vertex);
    mesh->triangle = malloc(3 * triangles * sizeof *mesh->triangle);
    mesh->neighbour = malloc(3 * triangles * sizeof *mesh->neighbour);
    mesh->range = malloc(triangles * sizeof *mesh->range);
    return mesh->vertex && mesh->triangle && mesh->neighbour && mesh->range;
}

/* Give back what joined vertices do not need; then make normals and boxes. */
static bool complete(CpsMesh *mesh) {
    const size_t vertices = (size_t)mesh->vertex_count, triangles = (size_t)mesh->triangle_count,
                 boxes = ((size_t)2 << mesh->depth) - 1;
    double *fewer = realloc(mesh->vertex, 3 * vertices * sizeof *fewer);
    if (fewer) mesh->vertex = fewer;
    mesh->normal = malloc(3 * vertices * sizeof *mesh->normal);
    mesh->box = malloc(boxes * sizeof *mesh->box);
    mesh->report.bytes = sizeof *mesh + 6 * vertices * sizeof(double) +
                         triangles * (6 * sizeof(int) + sizeof(double)) + boxes * sizeof(CpsiBox);
    return mesh->normal && mesh->box;
}

static CpsStatus make(CpsMesh *mesh, const CpsMeshTriangles *given, CpsError *err) {
    int *index = malloc((size_t)given->vertex_count * sizeof *index);
    CpsStatus status = index && allocate(mesh, given) && join_vertices(mesh, given, index)
                           ? take_triangles(mesh, given, index, err)
                           : cpsi_fail(err, CPS_ERR_MEMORY, "no memory for %d triangles of a mesh",
                                       given->triangle_count);
    free(index);
    if (status != CPS_OK) return status;
    mesh->depth = cpsi_mesh_depth(mesh->triangle_count);
    double *angle = malloc((size_t)mesh->vertex_count * sizeof *angle);
    int *piece = malloc(2 * (size_t)mesh->triangle_count * sizeof *piece);
    if (!angle || !piece || !complete(mesh) || !cpsi_mesh_plant(mesh))
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for %d triangles of a mesh",
                           mesh->triangle_count);
    if (status == CPS_OK) status = link_faces(mesh, err);
    if (status == CPS_OK) {
        sum_normals(mesh, angle);
        find_ranges(mesh);
        cpsi_mesh_find_folds(mesh, piece);
        measure(mesh);
    }
    free(angle);
    free(piece);
    return status;
}

CpsStatus cps_mesh_create(const CpsMeshTriangles *triangles, CpsMesh **out, CpsError *err) {
    if (!out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL, expected a place for the handle");
    *out = NULL;
    if (!triangles) return cpsi_fail(err, CPS_ERR_ARGUMENT, "triangles is NULL");
    CpsStatus status = check(triangles, err);
    if (status != CPS_OK) return status;
    CpsMesh *mesh = calloc(1, sizeof *mesh);
    if (!mesh) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a mesh");
    mesh->two_sided = triangles->two_sided;
    status = make(mesh, triangles, err);
    if (status != CPS_OK) {
        discard(mesh);
        return status;
    }
    atomic_init(&mesh->refcount, 1);
    *out = mesh;
    return CPS_OK;
}

CpsMesh *cps_mesh_retain(const CpsMesh *mesh) {
    CpsMesh *held = (CpsMesh *)mesh;
    if (held) atomic_fetch_add(&held->refcount, 1);
    return held;
}

void cps_mesh_release(CpsMesh *mesh) {
    if (mesh && atomic_fetch_sub(&mesh->refcount, 1) == 1) discard(mesh);
}

CpsMeshTriangles cps_mesh_triangles(const CpsMesh *mesh) {
    return (CpsMeshTriangles){.cookie = COOKIE,
                              .vertex_count = mesh->vertex_count,
                              .vertex = mesh->vertex,
                              .triangle_count = mesh->triangle_count,
                              .triangle = mesh->triangle,
                              .two_sided = mesh->two_sided};
}

CpsMeshReport cps_mesh_report(const CpsMesh *mesh) { return mesh->report; }
