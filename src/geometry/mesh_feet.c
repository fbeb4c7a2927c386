/* SPDX-License-Identifier: BSD-3-Clause */
/* The feet of a point on a mesh with concave edges (mesh.h; docs/theory.md 2.3).
 *
 * A point y of the triangles is a foot of x if it is the nearest of those around it: if no triangle
 * that it belongs to has a nearer point, for triangles are convex. Beside a concave edge there is
 * one on each face. A foot is followed as x moves by going to nearer points of neighbouring faces.
 * It is not followed over a concave edge: the free space there is the wedge between the two planes,
 * and the plane of the face goes on to be one of them. */
#include <math.h>

#include "geometry/mesh.h"

/* [rad] Faces that turn by less are one plane. */
static const double FLAT = 1e-7;
/* [-] Two normals whose product is this near to 1 are those of one foot. */
static const double ALIKE = 1e-14;
/* [-] Rounding of distances. */
static const double ROUNDING = 1e-12;
/* Faces over which a foot is followed at most. */
enum { FOLLOWED = 10000 };

/* ---- faces round a foot ---- */

static int vertex_of(const CpsMesh *mesh, int t, int i) {
    return mesh->triangle[3 * (size_t)t + (size_t)(i % 3)];
}

static int beyond_edge(const CpsMesh *mesh, int t, int i) {
    return mesh->neighbour[3 * (size_t)t + (size_t)i];
}

/* [-] By how much triangle s, beyond edge i of triangle t, rises above the plane of t: the sine of
 * an angle. */
static double rise(const CpsMesh *mesh, int t, int i, int s) {
    const int a = vertex_of(mesh, t, i), b = vertex_of(mesh, t, i + 1);
    int far_corner = 0;
    for (int k = 0; k < 3; k++)
        if (vertex_of(mesh, s, k) != a && vertex_of(mesh, s, k) != b) far_corner = k;
    const Vec3 arm = vec3_sub(cpsi_mesh_corner(mesh, s, far_corner), cpsi_mesh_corner(mesh, t, i));
    return vec3_dot(arm, cpsi_mesh_normal(mesh, t)) / vec3_norm(arm);
}

/* [m] Of x above the plane of a triangle. */
static double height_of(const CpsMesh *mesh, int t, Vec3 x) {
    return vec3_dot(vec3_sub(x, cpsi_mesh_corner(mesh, t, 0)), cpsi_mesh_normal(mesh, t));
}

/* Does triangle s, beyond edge i of triangle t, rise from t towards x? */
static bool is_fold(const CpsMesh *mesh, int t, int i, int s, Vec3 x) {
    const double up = rise(mesh, t, i, s);
    return mesh->two_sided && height_of(mesh, t, x) < 0 ? -up > FLAT : up > FLAT;
}

static bool has_fold(const CpsMesh *mesh) {
    for (int t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            const int s = beyond_edge(mesh, t, i);
            const double up = s < 0 ? 0 : rise(mesh, t, i, s);
            if (mesh->two_sided ? fabs(up) > FLAT : up > FLAT) return true;
        }
    return false;
}

/* Do all triangles hang together across edges? */
static bool is_one_piece(const CpsMesh *mesh, int *scratch) {
    int *reached = scratch, *is_reached = &scratch[mesh->triangle_count], count = 1;
    for (int t = 0; t < mesh->triangle_count; t++) is_reached[t] = t == 0;
    reached[0] = 0;
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 3; i++) {
            const int s = beyond_edge(mesh, reached[k], i);
            if (s < 0 || is_reached[s]) continue;
            is_reached[s] = 1;
            reached[count++] = s;
        }
    return count == mesh->triangle_count;
}

void cpsi_mesh_find_folds(CpsMesh *mesh, int *scratch) {
    mesh->has_folds = has_fold(mesh) || !is_one_piece(mesh, scratch);
}

/* A way over the faces round a corner, one way and, where a rim or a fold ends that, the other; or
 * over the one edge of a foot. */
typedef struct Turn {
    int face, edge;   /* which is crossed next */
    int vertex;       /* about which it turns, -1: over an edge alone */
    int first, other; /* the face with which it begins, and its other edge at the corner, or -1 */
} Turn;

/* The way over the faces round a foot that is on no face. */
static Turn turn_about(const CpsMesh *mesh, const CpsiMeshFoot *at) {
    const bool corner = at->part >= CPSI_MESH_CORNER;
    const int i = at->part - (corner ? CPSI_MESH_CORNER : CPSI_MESH_EDGE), t = at->triangle;
    return (Turn){t, i, corner ? vertex_of(mesh, t, i) : -1, t, corner ? (i + 2) % 3 : -1};
}

/* Go over the next edge; false at a rim or, with `stays`, at a fold. */
static bool cross(const CpsMesh *mesh, Turn *turn, Vec3 x, bool stays) {
    const int t = turn->face, s = beyond_edge(mesh, t, turn->edge);
    if (s < 0 || (stays && is_fold(mesh, t, turn->edge, s, x))) return false;
    const int a = vertex_of(mesh, t, turn->edge), b = vertex_of(mesh, t, turn->edge + 1),
              other = a == turn->vertex ? b : a;
    turn->face = s;
    for (int k = 0; k < 3; k++) { /* the edge of s at the vertex that was not crossed */
        const int p = vertex_of(mesh, s, k), q = vertex_of(mesh, s, k + 1);
        if ((p == turn->vertex && q != other) || (q == turn->vertex && p != other)) turn->edge = k;
    }
    return true;
}

/* Go to the next face; false where there is no other. */
static bool go_on(const CpsMesh *mesh, Turn *turn, Vec3 x, bool stays) {
    if (turn->vertex < 0 && turn->face != turn->first) return false;
    if (cross(mesh, turn, x, stays)) return turn->face != turn->first;
    if (turn->other < 0) return false;
    turn->face = turn->first;
    turn->edge = turn->other;
    turn->other = -1;
    return cross(mesh, turn, x, stays);
}

/* Is there a nearer point on the faces round a foot? Then *at is the nearest of them. With `stays`
 * no fold is crossed on the way to it. */
static bool descend(const CpsMesh *mesh, Vec3 x, bool stays, CpsiMeshFoot *at) {
    if (at->part == CPSI_MESH_FACE) return false;
    Turn turn = turn_about(mesh, at);
    CpsiMeshFoot best = *at;
    while (go_on(mesh, &turn, x, stays)) {
        const CpsiMeshFoot there = cpsi_mesh_nearest_of(mesh, turn.face, x);
        if (there.distance < best.distance * (1 - ROUNDING)) best = there;
    }
    if (best.triangle == at->triangle) return false;
    *at = best;
    return true;
}

/* The foot of x on the plane of triangle t. */
static CpsiMeshFoot plane_foot(const CpsMesh *mesh, int t, Vec3 x) {
    const Vec3 n = cpsi_mesh_normal(mesh, t);
    const double height = height_of(mesh, t, x);
    const bool turned = mesh->two_sided && height < 0;
    return (CpsiMeshFoot){.triangle = t,
                          .part = CPSI_MESH_FACE,
                          .distance = turned ? -height : height,
                          .foot = vec3_axpy(-height, n, x),
                          .normal = turned ? vec3_scale(-1, n) : n};
}

CpsiMeshFoot cpsi_mesh_foot_from(const CpsMesh *mesh, int face, Vec3 x, bool *beyond) {
    CpsiMeshFoot at = cpsi_mesh_nearest_of(mesh, face, x);
    int faces = 0;
    while (faces < FOLLOWED && descend(mesh, x, true, &at)) faces++;
    CpsiMeshFoot next = at;
    *beyond = descend(mesh, x, false, &next);
    if (*beyond) return plane_foot(mesh, at.triangle, x);
    cpsi_mesh_orient(mesh, x, &at);
    return at;
}

/* ---- all feet ---- */

typedef struct Feet {
    const CpsMesh *mesh;
    Vec3 x;
    CpsiMeshFoot *out;
    int count, most;
} Feet;

/* Insert a foot in the order of distance, unless there is one with its normal. */
static void insert(Feet *feet, const CpsiMeshFoot *at) {
    int place = feet->count;
    for (int i = 0; i < feet->count; i++)
        if (vec3_dot(feet->out[i].normal, at->normal) > 1 - ALIKE) return;
    while (place > 0 && at->distance < feet->out[place - 1].distance) place--;
    if (place >= feet->most) return;
    if (feet->count < feet->most) feet->count++;
    for (int i = feet->count - 1; i > place; i--) feet->out[i] = feet->out[i - 1];
    feet->out[place] = *at;
}

static void consider(void *into, const CpsiMeshFoot *foot) {
    Feet *feet = into;
    CpsiMeshFoot at = *foot;
    if (descend(feet->mesh, feet->x, false, &at)) return;
    cpsi_mesh_orient(feet->mesh, feet->x, &at);
    if (at.distance > 0) insert(feet, &at); /* not what is seen from behind */
}

/* The planes of the faces round the first foot, which lies on an edge or corner. */
static void insert_planes(Feet *feet, const CpsiMeshFoot *at) {
    Turn turn = turn_about(feet->mesh, at);
    do {
        const CpsiMeshFoot plane = plane_foot(feet->mesh, turn.face, feet->x);
        insert(feet, &plane);
    } while (go_on(feet->mesh, &turn, feet->x, false));
}

int cpsi_mesh_feet(const CpsMesh *mesh, Vec3 x, double within, int most, CpsiMeshFoot out[],
                   bool *beyond) {
    const CpsiMeshFoot first = cpsi_mesh_nearest(mesh, x);
    Feet feet = {.mesh = mesh, .x = x, .out = out, .most = most};
    *beyond = !mesh->two_sided && first.distance < 0 && first.part != CPSI_MESH_FACE;
    if (*beyond) {
        insert_planes(&feet, &first);
        return feet.count;
    }
    out[feet.count++] = first;
    if (first.distance > 0 && first.distance <= within)
        cpsi_mesh_each_within(mesh, x, within, consider, &feet);
    return feet.count;
}
