/* SPDX-License-Identifier: BSD-3-Clause */
/* Triangle meshes (mesh.h), written from docs/theory.md 2.3.
 *
 * The nearest point is the least over all triangles, each the least of its plane's foot, where that
 * is inside, and of its three edges. Which side x is on follows from the first face that a straight
 * way from x meets which goes into the middle of a face next to the foot: a way so short that only
 * the faces at the foot can be in it. */
#include "mesh.h"

#include <math.h>
#include <netcdf.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 100000000 };
/* [-] How far the way goes towards the middle of a face. */
static const Real INTO = 1e-3L;

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const Real *a, const Real *b, Real *out) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* ---- reading ---- */

void name_of_obstacle(int nc, size_t k, char name[201]) {
    size_t size = 0;
    name[0] = '\0';
    if (nc_inq_attlen(nc, NC_GLOBAL, "obstacles", &size) || size > 1 << 20) return;
    char *text = calloc(size + 1, 1);
    if (text && nc_get_att_text(nc, NC_GLOBAL, "obstacles", text) == 0) {
        const char *word = text;
        while (k > 0 && (word = strchr(word, ' '))) {
            word++;
            k--;
        }
        if (word) snprintf(name, 201, "%.*s", (int)strcspn(word, " "), word);
    }
    free(text);
}

size_t mesh_contacts(int nc, const char *line, size_t obstacles) {
    char name[300];
    int id;
    snprintf(name, sizeof name, "%.200s_obstacle_second", line);
    return obstacles > 1 || nc_inq_varid(nc, name, &id) == NC_NOERR ? 2 : 1;
}

bool mesh_is_index(double index, size_t obstacles, bool second) {
    return index >= (second && obstacles == 1 ? -1 : 0) && index < (double)obstacles;
}

/* Has any line contacts of elements? */
static bool has_elements(int nc) {
    static const char LAST[] = "_element_obstacle";
    int count = 0;
    char name[NC_MAX_NAME + 1];
    if (nc_inq_nvars(nc, &count)) return false;
    for (int id = 0; id < count; id++) {
        if (nc_inq_varname(nc, id, name)) return false;
        const size_t size = strlen(name);
        if (size >= sizeof LAST && strcmp(&name[size - sizeof LAST + 1], LAST) == 0) return true;
    }
    return false;
}

/* The rows of a variable with three columns; its dimension has its name. */
static int find_rows(int nc, const char *name, const char *what, size_t *rows) {
    char label[300];
    int id, rank = 0, dimension[NC_MAX_VAR_DIMS];
    size_t columns = 0;
    snprintf(label, sizeof label, "obstacle_%.200s_%s", name, what);
    if (nc_inq_varid(nc, label, &id) || nc_inq_varndims(nc, id, &rank) || rank != 2 ||
        nc_inq_vardimid(nc, id, dimension) || nc_inq_dimlen(nc, dimension[0], rows) ||
        nc_inq_dimlen(nc, dimension[1], &columns) || columns != 3 || *rows < 1 || *rows > MOST)
        return -1;
    return id;
}

static bool is_two_sided(int nc, int id) {
    char text[64] = "";
    size_t size = 0;
    return nc_inq_attlen(nc, id, "free_sides", &size) == 0 && size < sizeof text &&
           nc_get_att_text(nc, id, "free_sides", text) == 0 && strcmp(text, "both") == 0;
}

typedef struct Edge {
    int low, high;
    size_t place;
} Edge;

static int compare_edges(const void *a, const void *b) {
    const Edge *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    return (p->high > q->high) - (p->high < q->high);
}

/* Mark the edges that belong to one triangle alone. */
static bool find_rim(Mesh *mesh) {
    const size_t edges = 3 * mesh->triangles;
    Edge *edge = malloc(edges * sizeof *edge);
    if (!edge) return false;
    for (size_t h = 0; h < edges; h++) {
        const int *c = &mesh->corner[h - h % 3], a = c[h % 3], b = c[(h + 1) % 3];
        edge[h] = (Edge){a < b ? a : b, a < b ? b : a, h};
    }
    qsort(edge, edges, sizeof *edge, compare_edges);
    for (size_t h = 0; h < edges; h++)
        mesh->rim[edge[h].place] = (h == 0 || compare_edges(&edge[h - 1], &edge[h]) != 0) &&
                                   (h + 1 == edges || compare_edges(&edge[h], &edge[h + 1]) != 0);
    free(edge);
    return true;
}

static void corners(const Mesh *mesh, size_t t, Real out[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out[i][k] = mesh->vertex[3 * (size_t)mesh->corner[3 * t + (size_t)i] + (size_t)k];
}

static void make_balls(Mesh *mesh) {
    for (size_t t = 0; t < mesh->triangles; t++) {
        Real p[3][3], reach = 0;
        double *ball = &mesh->ball[4 * t];
        corners(mesh, t, p);
        for (int k = 0; k < 3; k++) ball[k] = (double)((p[0][k] + p[1][k] + p[2][k]) / 3);
        for (int i = 0; i < 3; i++)
            reach = fmaxl(reach,
                          hypotl(hypotl(p[i][0] - ball[0], p[i][1] - ball[1]), p[i][2] - ball[2]));
        ball[3] = (double)reach * (1 + 1e-14);
    }
}

static bool is_whole(const Mesh *mesh) {
    for (size_t v = 0; v < 3 * mesh->vertices; v++)
        if (!isfinite(mesh->vertex[v])) return false;
    for (size_t t = 0; t < mesh->triangles; t++)
        for (size_t i = 0; i < 3; i++) {
            const int c = mesh->corner[3 * t + i];
            if (c < 0 || (size_t)c >= mesh->vertices || c == mesh->corner[3 * t + (i + 1) % 3])
                return false;
        }
    return true;
}

Mesh *mesh_read(int nc, size_t k, FILE *log) {
    char name[201];
    name_of_obstacle(nc, k, name);
    Mesh *mesh = calloc(1, sizeof *mesh);
    if (!mesh) return NULL;
    const int vertex = find_rows(nc, name, "mesh_vertex", &mesh->vertices),
              corner = find_rows(nc, name, "mesh_triangle", &mesh->triangles);
    bool good = vertex >= 0 && corner >= 0;
    if (good) {
        mesh->vertex = malloc(3 * mesh->vertices * sizeof *mesh->vertex);
        mesh->corner = malloc(3 * mesh->triangles * sizeof *mesh->corner);
        mesh->rim = malloc(3 * mesh->triangles * sizeof *mesh->rim);
        mesh->ball = malloc(4 * mesh->triangles * sizeof *mesh->ball);
        mesh->near = malloc(mesh->triangles * sizeof *mesh->near);
        mesh->two_sided = is_two_sided(nc, corner);
        mesh->has_elements = has_elements(nc);
        good = mesh->vertex && mesh->corner && mesh->rim && mesh->ball && mesh->near &&
               nc_get_var_double(nc, vertex, mesh->vertex) == NC_NOERR &&
               nc_get_var_int(nc, corner, mesh->corner) == NC_NOERR && is_whole(mesh) &&
               find_rim(mesh);
    }
    if (good) {
        make_balls(mesh);
        return mesh;
    }
    if (log) fprintf(log, "no whole mesh of obstacle '%s'\n", name);
    mesh_free(mesh);
    return NULL;
}

void mesh_free(Mesh *mesh) {
    if (!mesh) return;
    free(mesh->vertex);
    free(mesh->corner);
    free(mesh->rim);
    free(mesh->ball);
    free(mesh->near);
    free(mesh);
}

/* ---- nearest point ---- */

static void normal_of(Real p[3][3], Real *n) {
    Real a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = p[1][k] - p[0][k];
        b[k] = p[2][k] - p[0][k];
    }
    cross(a, b, n);
    const Real length = sqrtl(dot(n, n));
    for (int k = 0; k < 3; k++) n[k] /= length;
}

/* Is the point y of the triangle's plane inside it? */
static bool holds(Real p[3][3], const Real *n, const Real *y) {
    for (int i = 0; i < 3; i++) {
        Real side[3], arm[3], turned[3];
        for (int k = 0; k < 3; k++) {
            side[k] = p[(i + 1) % 3][k] - p[i][k];
            arm[k] = y[k] - p[i][k];
        }
        cross(side, arm, turned);
        if (dot(turned, n) < 0) return false;
    }
    return true;
}

static void keep_nearer(const Real *x, const MeshNear *other, MeshNear *best) {
    MeshNear now = *other;
    now.square = 0;
    for (int k = 0; k < 3; k++) now.square += (x[k] - now.foot[k]) * (x[k] - now.foot[k]);
    if (now.square < best->square) *best = now;
}

static void look_at(const Mesh *mesh, size_t t, const Real *x, MeshNear *best) {
    Real p[3][3], n[3], arm[3];
    MeshNear now = {.triangle = t, .edge = -1};
    corners(mesh, t, p);
    normal_of(p, n);
    for (int k = 0; k < 3; k++) arm[k] = x[k] - p[0][k];
    const Real height = dot(arm, n);
    for (int k = 0; k < 3; k++) now.foot[k] = x[k] - height * n[k];
    if (holds(p, n, now.foot)) {
        keep_nearer(x, &now, best);
        return;
    }
    for (now.edge = 0; now.edge < 3; now.edge++) {
        const Real *a = p[now.edge], *b = p[(now.edge + 1) % 3];
        Real along[3], from[3];
        for (int k = 0; k < 3; k++) {
            along[k] = b[k] - a[k];
            from[k] = x[k] - a[k];
        }
        now.share = fminl(1, fmaxl(0, dot(from, along) / dot(along, along)));
        for (int k = 0; k < 3; k++) now.foot[k] = a[k] + now.share * along[k];
        keep_nearer(x, &now, best);
    }
}

static MeshNear nearest(const Mesh *mesh, const Real *x) {
    MeshNear best = {.square = INFINITY};
    Real reach = INFINITY;
    for (size_t t = 0; t < mesh->triangles; t++) {
        const double *ball = &mesh->ball[4 * t];
        const double a = (double)x[0] - ball[0], b = (double)x[1] - ball[1],
                     c = (double)x[2] - ball[2], within = (double)reach * (1 + 1e-12) + ball[3];
        if (a * a + b * b + c * c > within * within * (1 + 1e-12)) continue;
        look_at(mesh, t, x, &best);
        reach = sqrtl(best.square);
    }
    return best;
}

/* ---- side ---- */

/* The corners of the foot's part: one or two vertices. */
static int part_of(const Mesh *mesh, const MeshNear *at, int vertex[2]) {
    const int *c = &mesh->corner[3 * at->triangle];
    const int a = c[at->edge], b = c[(at->edge + 1) % 3];
    vertex[0] = at->share < 1 ? a : b;
    vertex[1] = b;
    return at->share > 0 && at->share < 1 ? 2 : 1;
}

static bool has_vertex(const Mesh *mesh, size_t t, int v) {
    const int *c = &mesh->corner[3 * t];
    return c[0] == v || c[1] == v || c[2] == v;
}

/* Where along the way from x to `to` the plane of face t is met inside the face, seen as a cone
 * from the foot; INFINITY: nowhere. *into: does the way go against the face's normal there? */
static Real meets(const Mesh *mesh, size_t t, const Real *x, const Real *to, bool *into) {
    Real p[3][3], n[3], y[3], before = 0, after = 0;
    corners(mesh, t, p);
    normal_of(p, n);
    for (int k = 0; k < 3; k++) {
        before += (x[k] - p[0][k]) * n[k];
        after += (to[k] - p[0][k]) * n[k];
    }
    if (before == after) return INFINITY;
    const Real share = before / (before - after);
    if (!(share >= 0 && share <= 1 + 1e-9L)) return INFINITY;
    for (int k = 0; k < 3; k++) y[k] = x[k] + share * (to[k] - x[k]);
    if (!holds(p, n, y)) return INFINITY;
    *into = before > after;
    return share;
}

/* Is x, whose foot is on an edge or a vertex, on the free side? Beyond a rim it is. */
static bool is_free(const Mesh *mesh, const Real *x, const MeshNear *at) {
    int vertex[2];
    const int count = part_of(mesh, at, vertex);
    Real p[3][3], to[3], first = INFINITY;
    bool free_side = true;
    corners(mesh, at->triangle, p);
    for (int k = 0; k < 3; k++)
        to[k] = at->foot[k] + INTO * ((p[0][k] + p[1][k] + p[2][k]) / 3 - at->foot[k]);
    for (size_t t = 0; t < mesh->triangles; t++) {
        if (!has_vertex(mesh, t, vertex[0]) || (count == 2 && !has_vertex(mesh, t, vertex[1])))
            continue;
        for (size_t i = 0; i < 3; i++) { /* a rim that the foot is on */
            const int a = mesh->corner[3 * t + i], b = mesh->corner[3 * t + (i + 1) % 3];
            const bool on = count == 2 ? (a == vertex[0] || a == vertex[1]) &&
                                             (b == vertex[0] || b == vertex[1])
                                       : a == vertex[0] || b == vertex[0];
            if (on && mesh->rim[3 * t + i]) return true;
        }
        bool into = true;
        const Real share = meets(mesh, t, x, to, &into);
        if (!(share < first)) continue;
        first = share;
        free_side = into;
    }
    return free_side;
}

/* The distance from the nearest point of a triangle, or of several, and the normal there. */
static Real look_from(const Mesh *mesh, const Real *x, const MeshNear *at, Real *normal) {
    Real p[3][3], n[3], arm[3], distance = sqrtl(at->square);
    corners(mesh, at->triangle, p);
    normal_of(p, n);
    for (int k = 0; k < 3; k++) arm[k] = x[k] - at->foot[k];
    const bool flat = at->edge < 0;
    const bool below = flat ? dot(arm, n) < 0 : !mesh->two_sided && !is_free(mesh, x, at);
    const Real sign = below ? -1 : 1;
    if (!mesh->two_sided) distance *= sign;
    for (int k = 0; k < 3; k++)
        normal[k] = flat             ? (mesh->two_sided ? sign : 1) * n[k]
                    : at->square > 0 ? arm[k] / distance
                                     : n[k];
    return distance;
}

static MeshAnswer ask(const Mesh *mesh, const Real *x) {
    MeshAnswer out = {.is_there = true};
    const MeshNear at = nearest(mesh, x);
    memcpy(out.x, x, sizeof out.x);
    out.distance = look_from(mesh, x, &at, out.normal);
    return out;
}

/* ---- all that are the nearest of those around them ---- */

/* Is no point of a triangle that has the foot's edge or corner nearer? Such a triangle is among
 * those that are looked at, as near as the foot. */
static bool is_least(const Mesh *mesh, const MeshNear *at, size_t count) {
    int vertex[2];
    if (at->edge < 0) return true;
    const int corners_of_it = part_of(mesh, at, vertex);
    for (size_t i = 0; i < count; i++) {
        const MeshNear *other = &mesh->near[i];
        if (other->square < at->square * (1 - 1e-11L) &&
            has_vertex(mesh, other->triangle, vertex[0]) &&
            (corners_of_it == 1 || has_vertex(mesh, other->triangle, vertex[1])))
            return false;
    }
    return true;
}

/* Are two normals those of one point, which belongs to several triangles? */
static bool are_one(const Real *n, const Real *m) {
    const Real d[3] = {n[0] - m[0], n[1] - m[1], n[2] - m[2]};
    return dot(d, d) < 1e-14L;
}

size_t mesh_feet(Mesh *mesh, const Real *x, Real within, MeshFoot out[MESH_FEET]) {
    size_t count = 0, feet = 1;
    out[0].distance = mesh_distance(mesh, x, out[0].normal);
    if (!(out[0].distance > 0 && out[0].distance <= within)) return 1;
    for (size_t t = 0; t < mesh->triangles; t++) {
        const double *ball = &mesh->ball[4 * t];
        const Real a = x[0] - ball[0], b = x[1] - ball[1], c = x[2] - ball[2];
        MeshNear *at = &mesh->near[count];
        if (a * a + b * b + c * c > (within + ball[3]) * (within + ball[3])) continue;
        at->square = INFINITY;
        look_at(mesh, t, x, at);
        count += at->square <= within * within;
    }
    for (size_t i = 0; i < count && feet < MESH_FEET; i++) {
        MeshFoot *foot = &out[feet];
        if (!is_least(mesh, &mesh->near[i], count)) continue;
        foot->distance = look_from(mesh, x, &mesh->near[i], foot->normal);
        bool is_new = foot->distance > 0;
        for (size_t k = 0; k < feet; k++) is_new &= !are_one(out[k].normal, foot->normal);
        feet += is_new;
    }
    return feet;
}

Real mesh_distance(Mesh *mesh, const Real *x, Real *normal) {
    const double sum = (double)(x[0] * 1.7L + x[1] * 2.3L + x[2] * 3.1L);
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    MeshAnswer *kept = &mesh->kept[(bits ^ bits >> 17 ^ bits >> 34) % MESH_KEPT];
    if (!kept->is_there || kept->x[0] != x[0] || kept->x[1] != x[1] || kept->x[2] != x[2])
        *kept = ask(mesh, x);
    memcpy(normal, kept->normal, sizeof kept->normal);
    return kept->distance;
}
