/* SPDX-License-Identifier: BSD-3-Clause */
/* Comparison of what a file says of an obstacle with its scene (compare.h). */
#include "compare.h"

#include <math.h>

/* Two sets with the same support in DIRECTIONS directions, to what small programs leave of it. */
static void compare_sets(Compare *compare, const CpsObstacle *o, const Surface *s) {
    enum { DIRECTIONS = 48 };
    for (int i = 0; i < DIRECTIONS; i++) {
        const double angle = 6.283185307179586 * i / DIRECTIONS, d[2] = {cos(angle), sin(angle)};
        CpsSetAnswer answer;
        if (cps_set_support(o->friction_set, d, NULL, &answer, NULL) != CPS_OK ||
            answer.outcome != CPS_SET_OUTCOME_ANSWERED)
            return;
        const double file = (double)conic_support(s->set, (Real[]){d[0], d[1]});
        if (fabs(file - answer.value) <= answer.gap + 1e-9 * (double)s->set->reach) continue;
        find(compare, "friction set of %s reaches %.17g along (%.3g, %.3g), in the scene %.17g",
             o->name, file, d[0], d[1], answer.value);
        return;
    }
}

static void compare_ground(Compare *compare, const CpsObstacle *o, const Ground *ground) {
    const CpsGroundGrid grid = cps_ground_grid(o->ground);
    if (ground->columns != (size_t)grid.x_count || ground->rows != (size_t)grid.y_count ||
        ground->extends != grid.extends || !ground->factor != !grid.friction_factor) {
        find(compare, "grid of %s: another than that of the scene", o->name);
        return;
    }
    const size_t points = ground->columns * ground->rows;
    same(compare, "grid, x", o->name, ground->x, grid.x, ground->columns, COPIED);
    same(compare, "grid, y", o->name, ground->y, grid.y, ground->rows, COPIED);
    same(compare, "grid, z", o->name, ground->z, grid.z, points, COPIED);
    if (ground->factor)
        same(compare, "grid, factor of friction", o->name, ground->factor, grid.friction_factor,
             points, COPIED);
}

/* The first and the third row of a rotation by a quaternion, its images of x and z. */
static void box_axes(const double q[4], double first[3], double third[3]) {
    const double whole = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], w = q[0], x = q[1],
                 y = q[2], z = q[3];
    const double a[3] = {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
                 c[3] = {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
    for (int k = 0; k < 3; k++) {
        first[k] = a[k] / whole;
        third[k] = c[k] / whole;
    }
}

static void compare_shape(Compare *compare, const CpsObstacle *o, const Surface *s,
                          const double first[3]) {
    double extent[3], side[3];
    for (int k = 0; k < 3; k++) {
        extent[k] = (double)s->size[k];
        side[k] = (double)s->side[k];
    }
    same_number(compare, "inside", o->name, s->inside, o->shape.inside);
    if (o->kind == CPS_OBSTACLE_CAPSULE)
        same_number(compare, "length", o->name, (double)s->length, o->shape.length);
    if (o->kind == CPS_OBSTACLE_TORUS)
        same_number(compare, "main radius", o->name, (double)s->main_radius, o->shape.main_radius);
    if (o->kind == CPS_OBSTACLE_CONE)
        same_number(compare, "angle", o->name, (double)s->angle, o->shape.angle);
    if (o->kind != CPS_OBSTACLE_BOX) return;
    same(compare, "size", o->name, extent, o->shape.size, 3, COPIED);
    same(compare, "side", o->name, side, first, 3, COMPUTED);
}

static void compare_mesh(Compare *compare, const CpsObstacle *o, const Mesh *mesh) {
    const CpsMeshTriangles of = cps_mesh_triangles(o->mesh);
    if (mesh->vertices != (size_t)of.vertex_count || mesh->triangles != (size_t)of.triangle_count ||
        mesh->two_sided != of.two_sided) {
        find(compare, "mesh of %s: another than that of the scene", o->name);
        return;
    }
    same(compare, "mesh, vertices", o->name, mesh->vertex, of.vertex, 3 * mesh->vertices, COPIED);
    for (size_t i = 0; i < 3 * mesh->triangles; i++)
        if (mesh->corner[i] != of.triangle[i]) {
            find(compare, "mesh of %s: triangle %zu is another", o->name, i / 3);
            return;
        }
}

void compare_obstacle(Compare *compare, const CpsObstacle *o, const Surface *s) {
    const bool plane = o->kind == CPS_OBSTACLE_PLANE, box = o->kind == CPS_OBSTACLE_BOX,
               flat = o->kind == CPS_OBSTACLE_GROUND || o->kind == CPS_OBSTACLE_SURFACE;
    double third[3] = {0, 0, 1}, first[3] = {0, 0, 0};
    if (box) box_axes(o->shape.rotation, first, third);
    const bool turns = !flat && !box && o->kind != CPS_OBSTACLE_MESH;
    const double *given = plane ? o->normal : turns ? o->axis : third, length = size(given);
    double axis[3], point[3], there[3], grain[3], unit[3];
    for (int k = 0; k < 3; k++) {
        there[k] = o->point[k] - compare->source.origin[k];
        axis[k] = (double)s->axis[k];
        point[k] = (double)s->point[k];
        grain[k] = (double)s->grain[k];
        unit[k] = given[k] / length;
    }
    same_number(compare, "kind", o->name, s->kind, o->kind);
    same(compare, "point", o->name, point, there, 3, COPIED);
    same(compare, "axis", o->name, axis, unit, 3, COMPUTED);
    same_number(compare, "radius", o->name, (double)s->radius, plane || flat ? 0 : o->radius);
    same_number(compare, "stiffness", o->name, (double)s->gives, o->stiffness);
    same_number(compare, "damping", o->name, (double)s->damps, o->damping);
    compare_shape(compare, o, s, first);
    if (o->kind == CPS_OBSTACLE_GROUND && s->ground) compare_ground(compare, o, s->ground);
    if (o->kind == CPS_OBSTACLE_MESH && s->mesh) compare_mesh(compare, o, s->mesh);
    if ((s->set != NULL) != (o->friction_set != NULL))
        find(compare, "friction set of %s: one of the two has none", o->name);
    if (s->set && o->friction_set) compare_sets(compare, o, s);
    same(compare, "grain", o->name, grain, o->grain, 3, COPIED);
    if (s->set || o->friction_set) return;
    same_number(compare, "axial coefficient", o->name, (double)s->mu[0], o->friction);
    same_number(compare, "lateral coefficient", o->name, (double)s->mu[1],
                o->has_friction_lateral ? o->friction_lateral : o->friction);
    same_number(compare, "shape of friction", o->name, s->box,
                o->friction_shape == CPS_FRICTION_SHAPE_BOX);
}
