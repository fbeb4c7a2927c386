/* SPDX-License-Identifier: BSD-3-Clause */
/* Defaults of the scene structs, and the check of a scene before anything is solved. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "base/vec3.h"
#include "cable/friction_set.h"
#include "capstan/scene.h"
#include "evolve/bodies.h"
#include "evolve/constraints.h"
#include "evolve/excitation.h"
#include "evolve/loads.h"
#include "evolve/members.h"
#include "evolve/names.h"
#include "evolve/node_start.h"
#include "evolve/origin.h"
#include "evolve/path_check.h"
#include "evolve/places.h"
#include "evolve/points.h"
#include "evolve/ranges.h"
#include "evolve/sections.h"
#include "evolve/shape_check.h"
#include "evolve/soft_check.h"
#include "evolve/stage_check.h"
#include "evolve/start.h"
#include "evolve/time_check.h"
#include "evolve/water_check.h"
#include "evolve/waves.h"
#include "evolve/winches.h"
#include "geometry/obstacle.h"

enum { SCENE_COOKIE = 0x5ce9e501, LINE_COOKIE = 0x11e00e02, OBSTACLE_COOKIE = 0x0b57ac03 };

/* A start shape must be as long as the line to this relative accuracy: lengths written with 9
 * digits pass. */
static const double LENGTH_TOLERANCE = 1e-8;
/* An elastic line may start stretched, but not beyond this strain, which is taken for an error of
 * input. */
static const double MAX_START_STRAIN = 1.0;
/* Permitted relative difference between the sum of the elements' lengths and the line's length:
 * lengths written with 10 digits pass. */
static const double SUM_TOLERANCE = 1e-9;
/* Limits given by the memory of a large machine (1 kB per element) and by the size of results. */
enum { MAX_ELEMENTS = 10000000, MAX_STEPS = 1000000, MAX_LINES = 200000, MAX_OBSTACLES = 1000 };

CpsScene cps_scene_default(void) {
    return (CpsScene){
        .cookie = SCENE_COOKIE,
        .gravity = {0, 0, -9.81},
        .friction_policy = CPS_FRICTION_POLICY_CONSISTENT,
        .solver = {.tolerance = 1e-8,
                   .max_iterations = 60,
                   .linear_system = CPS_LINEAR_SYSTEM_CHAIN,
                   .max_halvings = 10,
                   .thread_count = 1},
    };
}

CpsLine cps_line_default(void) {
    return (CpsLine){
        .cookie = LINE_COOKIE,
        .element_count = 100,
        .stiffness = INFINITY,
        .start = {.axis = {0, 0, 1}},
        .end = {{.kind = CPS_END_KIND_AT_START}, {.kind = CPS_END_KIND_FREE}},
    };
}

CpsObstacle cps_obstacle_default(void) {
    return (CpsObstacle){
        .cookie = OBSTACLE_COOKIE,
        .kind = CPS_OBSTACLE_PLANE,
        .normal = {0, 0, 1},
        .axis = {0, 1, 0},
        .shape.rotation = {1, 0, 0, 0},
    };
}

/* ---- the check ----
 *
 * A message begins with the object and its key. The error also contains the path of the key as
 * data: a check names the key, and its caller the enclosing object: "length" in "lines.cable". */

/* Ground, or a surface given as a function: both stay in their place. */
static CpsStatus check_smooth(const CpsObstacle *o, CpsError *err) {
    const bool ground = o->kind == CPS_OBSTACLE_GROUND;
    const char *what = ground ? "ground" : "surface";
    if (!cpsi_are_usable(o->point))
        return CPSI_FAIL_AT(ground ? "ground.point" : "point", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': %s point is (%g, %g, %g) m, expected finite numbers",
                            o->name, what, o->point[0], o->point[1], o->point[2]);
    if (ground && !o->ground)
        return CPSI_FAIL_AT("ground", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': its ground is NULL: make one with cps_ground_create",
                            o->name);
    if (!ground && (!o->surface.function || !cpsi_is_positive(o->surface.size)))
        return CPSI_FAIL_AT("surface", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': a surface needs a function and a positive size, found "
                            "%s and %g m",
                            o->name, o->surface.function ? "one" : "none", o->surface.size);
    if (o->moves)
        return CPSI_FAIL_AT("moves", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': it moves, but a %s stays in its place", o->name, what);
    return CPS_OK;
}

/* [-] Of the extent of a mesh: a radius below this loses the direction of normals to rounding. */
static const double LEAST_ROUNDING = 1e-6;

static CpsStatus check_mesh(const CpsObstacle *o, CpsError *err) {
    if (!cpsi_are_usable(o->point))
        return CPSI_FAIL_AT("mesh.point", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': mesh point is (%g, %g, %g) m, expected finite numbers",
                            o->name, o->point[0], o->point[1], o->point[2]);
    if (!o->mesh)
        return CPSI_FAIL_AT("mesh", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': its mesh is NULL: make one with cps_mesh_create",
                            o->name);
    const CpsMeshReport of = cps_mesh_report(o->mesh);
    double extent = 0;
    for (int k = 0; k < 3; k++) extent = fmax(extent, of.high[k] - of.low[k]);
    if (!cpsi_is_positive(o->radius) || o->radius < LEAST_ROUNDING * extent)
        return CPSI_FAIL_AT("mesh.radius", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': radius is %g m, expected a finite number of at least "
                            "%g m, which is %g of the mesh's extent",
                            o->name, o->radius, LEAST_ROUNDING * extent, LEAST_ROUNDING);
    return CPS_OK;
}

static CpsStatus check_surface(const CpsObstacle *o, CpsError *err) {
    if (o->shape.inside && !cpsi_obstacle_kind_has_radius(o->kind))
        return CPSI_FAIL_AT("inside", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': lines can be inside of a cylinder, sphere, capsule, "
                            "torus, cone or box alone",
                            o->name);
    if (o->kind < CPS_OBSTACLE_PLANE || o->kind > CPS_OBSTACLE_MESH)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "obstacle '%s': unknown kind %d", o->name,
                         (int)o->kind);
    if (o->kind == CPS_OBSTACLE_GROUND || o->kind == CPS_OBSTACLE_SURFACE)
        return check_smooth(o, err);
    if (o->kind == CPS_OBSTACLE_MESH) return check_mesh(o, err);
    if (o->kind != CPS_OBSTACLE_PLANE) return cpsi_shape_check(o, err);
    const double *d = o->normal;
    if (!cpsi_are_usable(o->point))
        return CPSI_FAIL_AT("plane.point", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': plane point is (%g, %g, %g) m, expected finite numbers",
                            o->name, o->point[0], o->point[1], o->point[2]);
    if (!cpsi_is_direction(d))
        return CPSI_FAIL_AT("plane.normal", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': plane normal is (%g, %g, %g), expected a direction: "
                            "finite numbers, not all 0",
                            o->name, d[0], d[1], d[2]);
    return CPS_OK;
}

static CpsStatus check_friction_keys(const CpsObstacle *o, CpsError *err) {
    if (!cpsi_is_not_negative(o->friction))
        return CPSI_FAIL_AT("friction", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': friction is %g, expected a finite number >= 0", o->name,
                            o->friction);
    if (o->has_friction_lateral && !cpsi_is_not_negative(o->friction_lateral))
        return CPSI_FAIL_AT("friction.lateral", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': friction: lateral is %g, expected a finite number >= 0",
                            o->name, o->friction_lateral);
    if (!o->has_friction_lateral && o->friction_lateral != 0)
        return CPSI_FAIL_AT(
            "friction.lateral", err, CPS_ERR_ARGUMENT,
            "obstacle '%s': friction: lateral is %g, but has_friction_lateral is false", o->name,
            o->friction_lateral);
    if (o->friction_shape != CPS_FRICTION_SHAPE_ELLIPSE &&
        o->friction_shape != CPS_FRICTION_SHAPE_BOX)
        return CPSI_FAIL_AT("friction.shape", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': friction: unknown shape %d", o->name,
                            (int)o->friction_shape);
    const double *g = o->grain;
    if (!cpsi_are_usable(g) || ((g[0] != 0 || g[1] != 0 || g[2] != 0) && !cpsi_is_direction(g)))
        return CPSI_FAIL_AT("friction.grain", err, CPS_ERR_ARGUMENT,
                            "obstacle '%s': friction: grain is (%g, %g, %g), expected a direction: "
                            "finite numbers, or all 0 for the line's own",
                            o->name, g[0], g[1], g[2]);
    if (!o->friction_set) return CPS_OK;
    return cpsi_fail_inside(err, cpsi_friction_set_check(o->friction_set, o->name, err),
                            "friction.set");
}

/* With frozen friction, or contact of the reference, a step is about the places of the reference.
 */
static CpsStatus check_moves(const CpsScene *scene, const CpsObstacle *o, CpsError *err) {
    if (!o->moves || (scene->friction_policy == CPS_FRICTION_POLICY_CONSISTENT &&
                      scene->contact_policy == CPS_CONTACT_POLICY_REACHED))
        return CPS_OK;
    return CPSI_FAIL_AT("moves", err, CPS_ERR_ARGUMENT,
                        "obstacle '%s' moves: this needs consistent friction, and contact that is "
                        "reached",
                        o->name);
}

static CpsStatus check_obstacles(const CpsScene *scene, CpsError *err) {
    if (scene->obstacle_count < 0 || scene->obstacle_count > MAX_OBSTACLES)
        return CPSI_FAIL_AT("obstacles", err, CPS_ERR_ARGUMENT,
                            "obstacles: found %d, expected 0 to %d", scene->obstacle_count,
                            (int)MAX_OBSTACLES);
    for (int k = 0; k < scene->obstacle_count; k++) {
        const CpsObstacle *o = scene->obstacle ? &scene->obstacle[k] : NULL;
        if (!o || o->cookie != OBSTACLE_COOKIE)
            return CPSI_FAIL_AT("obstacles", err, CPS_ERR_ARGUMENT,
                                "obstacle %d: not made by cps_obstacle_default()", k + 1);
        CpsStatus status = cpsi_name_check("obstacle", k, o->name, err);
        if (status != CPS_OK) return cpsi_fail_inside(err, status, "obstacles[%d]", k + 1);
        for (int i = 0; i < k && status == CPS_OK; i++)
            if (strcmp(scene->obstacle[i].name, o->name) == 0)
                status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                                   "obstacle '%s': obstacles %d and %d have the same name", o->name,
                                   i + 1, k + 1);
        if (status == CPS_OK) status = check_surface(o, err);
        if (status == CPS_OK) status = check_friction_keys(o, err);
        if (status == CPS_OK) status = check_moves(scene, o, err);
        if (status == CPS_OK) status = cpsi_soft_obstacle_check(scene, o, err);
        if (status != CPS_OK) return cpsi_fail_inside(err, status, "obstacles.%s", o->name);
    }
    return CPS_OK;
}

/* So many nodes are held against an obstacle together: it is prepared for them once. */
enum { NODES_AT_ONCE = 256 };

static CpsStatus check_elements(const CpsLine *line, CpsError *err) {
    if (line->element_count < 1)
        return CPSI_FAIL_AT("elements", err, CPS_ERR_ARGUMENT,
                            "line '%s': elements is %d, expected at least 1", line->name,
                            line->element_count);
    if (!line->element_length) return CPS_OK;
    double sum = 0;
    for (int i = 0; i < line->element_count; i++) {
        if (!cpsi_is_positive(line->element_length[i]))
            return CPSI_FAIL_AT(
                "elements", err, CPS_ERR_ARGUMENT,
                "line '%s': elements: number %d is %g m long, expected a positive finite number",
                line->name, i + 1, line->element_length[i]);
        sum += line->element_length[i];
    }
    if (!(fabs(sum - line->length) <= SUM_TOLERANCE * line->length))
        return CPSI_FAIL_AT(
            "elements", err, CPS_ERR_ARGUMENT,
            "line '%s': elements are %.12g m long together, but length is %.12g m: make "
            "them agree to 9 digits",
            line->name, sum, line->length);
    return CPS_OK;
}

static CpsStatus check_zones(const CpsLine *line, CpsError *err) {
    if (line->zone_count < 0 || (line->zone_count > 0 && !line->zone))
        return CPSI_FAIL_AT("friction_zones", err, CPS_ERR_ARGUMENT,
                            "line '%s': friction zones: found %d, expected 0 or more", line->name,
                            line->zone ? line->zone_count : 0);
    double behind = 0;
    for (int k = 0; k < line->zone_count; k++) {
        const CpsFrictionZone *zone = &line->zone[k];
        char place[32];
        snprintf(place, sizeof place, "friction_zones[%d]", k + 1);
        if (!(zone->from >= behind && zone->from < zone->to && zone->to <= line->length))
            return CPSI_FAIL_AT(
                place, err, CPS_ERR_ARGUMENT,
                "line '%s': friction zones: number %d goes from %g m to %g m, expected one that "
                "begins at %g m or after and ends within the line's length %g m",
                line->name, k + 1, zone->from, zone->to, behind, line->length);
        if (!cpsi_is_not_negative(zone->factor))
            return CPSI_FAIL_AT(
                place, err, CPS_ERR_ARGUMENT,
                "line '%s': friction zones: number %d has the factor %g, expected a "
                "finite number >= 0",
                line->name, k + 1, zone->factor);
        behind = zone->to;
    }
    return CPS_OK;
}

static CpsStatus check_numbers(const CpsScene *scene, const CpsLine *line, CpsError *err) {
    if (!cpsi_is_positive(line->length))
        return CPSI_FAIL_AT("length", err, CPS_ERR_ARGUMENT,
                            "line '%s': length is %g m, expected a positive finite number",
                            line->name, line->length);
    CpsStatus status = check_elements(line, err);
    if (status == CPS_OK) status = cpsi_sections_check(scene, line, err);
    if (status == CPS_OK) status = cpsi_line_loads_check(scene, line, err);
    return status ? status : check_zones(line, err);
}

/* Check the points of the start, and for an arc that its radius suits the elements. */
static CpsStatus check_start_data(const CpsLine *line, CpsError *err) {
    const CpsStart *start = &line->start;
    if (start->kind < CPS_START_STRAIGHT || start->kind > CPS_START_NODES)
        return CPSI_FAIL_AT("start", err, CPS_ERR_ARGUMENT,
                            "line '%s': start has the unknown kind %d", line->name,
                            (int)start->kind);
    if (start->kind == CPS_START_STATIC || start->kind == CPS_START_NODES) return CPS_OK;
    const bool polyline = start->kind == CPS_START_POLYLINE;
    if (!start->point || (polyline ? start->point_count < 2 : start->point_count != 2))
        return CPSI_FAIL_AT("start", err, CPS_ERR_ARGUMENT,
                            "line '%s': start has %d points, expected %s", line->name,
                            start->point ? start->point_count : 0, polyline ? "at least 2" : "2");
    for (int i = 0; i < start->point_count; i++)
        if (!cpsi_are_usable(&start->point[3 * i]))
            return CPSI_FAIL_AT(
                "start", err, CPS_ERR_ARGUMENT,
                "line '%s': start: point %d is (%g, %g, %g) m, expected finite numbers", line->name,
                i + 1, start->point[3 * i], start->point[3 * i + 1], start->point[3 * i + 2]);
    if (start->kind != CPS_START_ARC) return CPS_OK;
    if (!cpsi_is_direction(start->axis))
        return CPSI_FAIL_AT(
            "start.arc.axis", err, CPS_ERR_ARGUMENT,
            "line '%s': start: arc axis is (%g, %g, %g), expected a direction: finite "
            "numbers, not all 0",
            line->name, start->axis[0], start->axis[1], start->axis[2]);
    const double radius = cpsi_start_arc(line).radius;
    if (!cpsi_is_positive(radius))
        return CPSI_FAIL_AT("start", err, CPS_ERR_ARGUMENT,
                            "line '%s': start: the arc's first point lies on its axis", line->name);
    for (int i = 0; i < line->element_count; i++) {
        const double l =
            line->element_length ? line->element_length[i] : line->length / line->element_count;
        if (l > 2 * radius)
            return CPSI_FAIL_AT("start", err, CPS_ERR_ARGUMENT,
                                "line '%s': start: an element is %g m long, longer than the arc's "
                                "diameter %g m: use more elements",
                                line->name, l, 2 * radius);
    }
    return CPS_OK;
}

static CpsStatus check_start_length(const CpsLine *line, CpsError *err) {
    if (line->start.kind == CPS_START_NODES) return CPS_OK; /* may be slack */
    const double shape = cpsi_start_length(line), length = cpsi_length_off_drums(line);
    const bool elastic = cpsi_is_elastic(line);
    const Vec3 first = line->start.point_count > 0 ? vec3_load(line->start.point) : vec3(0, 0, 0);
    const double tolerance = LENGTH_TOLERANCE + line->start.point_count *
                                                    cpsi_place_rounding(line->length, first) /
                                                    length;
    if (!(shape >= length * (1 - tolerance)))
        return CPSI_FAIL_AT(
            "start", err, CPS_ERR_ARGUMENT,
            "line '%s': start is %.10g m long, shorter than the line's length %.10g m: "
            "lengthen the shape, or use 'static'",
            line->name, shape, length);
    if (!elastic && !(shape <= length * (1 + tolerance)))
        return CPSI_FAIL_AT("start", err, CPS_ERR_ARGUMENT,
                            "line '%s': start is %.10g m long, longer than the inextensible line's "
                            "length %.10g m: shorten it",
                            line->name, shape, length);
    if (elastic && !(shape <= length * (1 + MAX_START_STRAIN)))
        return CPSI_FAIL_AT(
            "start", err, CPS_ERR_ARGUMENT,
            "line '%s': start is %.10g m long, more than twice the line's length %.10g "
            "m: shorten it",
            line->name, shape, length);
    return CPS_OK;
}

/* The first of some nodes that lies below an obstacle; `count`: none. */
static int first_below(const CpsScene *scene, const CpsLine *line, int count, const Vec3 *x) {
    double least[NODES_AT_ONCE];
    int first = count;
    for (int i = 0; i < count; i++) least[i] = -cpsi_place_tolerance(line, x[i]);
    for (int k = 0; k < scene->obstacle_count; k++) {
        const CpsiObstacle obstacle = cpsi_obstacle(&scene->obstacle[k]);
        if (obstacle.stiffness > 0) continue;
        for (int i = 0; i < first; i++)
            if (!(cpsi_obstacle_gap(&obstacle, x[i]) >= least[i])) first = i;
    }
    return first;
}

/* The first of some nodes that lies beyond a grid, and whose; `count`: none. */
static int first_beyond(const CpsScene *scene, const CpsLine *line, int count, const Vec3 *x,
                        const char **name) {
    for (int k = 0; k < scene->obstacle_count; k++) {
        if (!scene->obstacle[k].ground) continue;
        const CpsiObstacle obstacle = cpsi_obstacle(&scene->obstacle[k]);
        *name = scene->obstacle[k].name;
        for (int i = 0; i < count; i++)
            if (!cpsi_obstacle_covers(&obstacle, x[i], CPS_TOUCH * line->length)) return i;
    }
    return count;
}

/* No node of the initial shape may lie below the obstacle; statics places a line above it by
 * itself. With contact of the reference given nodes may lie below it. */
static CpsStatus check_start_height(const CpsScene *scene, const CpsLine *line, CpsError *err) {
    const bool through = line->start.kind == CPS_START_NODES &&
                         scene->contact_policy == CPS_CONTACT_POLICY_REFERENCE;
    if (scene->obstacle_count == 0 || line->start.kind == CPS_START_STATIC || through)
        return CPS_OK;
    CpsiStartWalk walk = cpsi_start_walk(line);
    for (int first = 0; first <= line->element_count; first += NODES_AT_ONCE) {
        Vec3 x[NODES_AT_ONCE];
        const int left = line->element_count + 1 - first;
        const int count = left < NODES_AT_ONCE ? left : NODES_AT_ONCE;
        for (int i = 0; i < count; i++) x[i] = cpsi_start_next(&walk);
        const char *name = "";
        const int off = first_beyond(scene, line, count, x, &name);
        if (off < count)
            return CPSI_FAIL_AT("start", err, CPS_ERR_ARGUMENT,
                                "line '%s': start: node %d at (%g, %g) m lies beyond the grid of "
                                "ground '%s': take a larger grid, or say that it extends",
                                line->name, first + off, x[off].x, x[off].y, name);
        const int low = first_below(scene, line, count, x);
        if (low == count) continue;
        const double above = cpsi_scene_height(scene, x[low], true, &name);
        return CPSI_FAIL_AT(
            "start", err, CPS_ERR_ARGUMENT,
            "line '%s': start: node %d lies %g m below obstacle '%s': lift the shape, "
            "or turn the normal",
            line->name, first + low, -above, name);
    }
    return CPS_OK;
}

static CpsStatus check_end(const CpsScene *scene, const CpsLine *line, int end, CpsError *err) {
    const CpsEnd *e = &line->end[end];
    const char *letter = cpsi_end_letter(end), *place = end == CPS_END_A ? "ends.A" : "ends.B";
    const double *v = e->value;
    if (e->kind < CPS_END_KIND_HELD || e->kind > CPS_END_KIND_AT_START)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': ends: end %s has the unknown kind %d", line->name, letter,
                            (int)e->kind);
    if (e->kind == CPS_END_KIND_FREE) {
        if (cpsi_are_usable(v)) return CPS_OK;
        return CPSI_FAIL_AT(
            place, err, CPS_ERR_ARGUMENT,
            "line '%s': ends: the force on end %s is (%g, %g, %g) N, expected finite numbers",
            line->name, letter, v[0], v[1], v[2]);
    }
    const bool is_static = line->start.kind == CPS_START_STATIC;
    if (e->kind == CPS_END_KIND_AT_START) {
        if (v[0] != 0 || v[1] != 0 || v[2] != 0)
            return CPSI_FAIL_AT(
                place, err, CPS_ERR_ARGUMENT,
                "line '%s': ends: end %s is held where the start puts it, but has a "
                "position: its kind is then CPS_END_KIND_HELD",
                line->name, letter);
        if (!is_static) return CPS_OK;
        return CPSI_FAIL_AT(
            place, err, CPS_ERR_ARGUMENT,
            "line '%s': ends: end %s has no position, and a static start gives none: fix "
            "it at [x, y, z]",
            line->name, letter);
    }
    if (!cpsi_are_usable(v))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': ends: end %s is at (%g, %g, %g) m, expected finite numbers",
                            line->name, letter, v[0], v[1], v[2]);
    const char *name = "";
    const double above = cpsi_scene_height(scene, vec3_load(v), true, &name);
    if (!(above >= -cpsi_place_tolerance(line, vec3_load(v))))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': ends: end %s is %g m below obstacle '%s'", line->name,
                            letter, -above, name);
    if (is_static) return CPS_OK;

    /* the end of the initial shape: compute it as if no position were given */
    CpsLine open = *line;
    open.end[end].kind = CPS_END_KIND_AT_START;
    double start[3];
    cpsi_start_end(&open, end, start);
    const double off = vec3_norm(vec3_sub(vec3_load(start), vec3_load(v)));
    if (!(off <= cpsi_place_tolerance(line, vec3_load(v))))
        return CPSI_FAIL_AT(
            place, err, CPS_ERR_ARGUMENT,
            "line '%s': ends: end %s is held at (%.10g, %.10g, %.10g) m, but the start puts it at "
            "(%.10g, %.10g, %.10g) m, %g m away: make them agree, or give no position",
            line->name, letter, v[0], v[1], v[2], start[0], start[1], start[2], off);
    return CPS_OK;
}

static CpsStatus check_line(const CpsScene *scene, int index, CpsError *err) {
    const CpsLine *line = &scene->line[index];
    if (line->cookie != LINE_COOKIE)
        return CPSI_FAIL_AT("lines", err, CPS_ERR_ARGUMENT,
                            "line %d: not made by cps_line_default()", index + 1);
    CpsStatus status = cpsi_name_check("line", index, line->name, err);
    if (status != CPS_OK) return cpsi_fail_inside(err, status, "lines[%d]", index + 1);
    for (int i = 0; i < index && status == CPS_OK; i++)
        if (strcmp(scene->line[i].name, line->name) == 0)
            status =
                cpsi_fail(err, CPS_ERR_ARGUMENT, "line '%s': lines %d and %d have the same name",
                          line->name, i + 1, index + 1);
    if (status == CPS_OK) status = check_numbers(scene, line, err);
    if (status == CPS_OK) status = cpsi_winches_check(line, err);
    if (status == CPS_OK) status = cpsi_soft_line_check(scene, line, err);
    if (status == CPS_OK) status = check_start_data(line, err);
    if (status == CPS_OK && line->start.kind == CPS_START_NODES)
        status = cpsi_fail_inside(err, cpsi_node_start_check(scene, line, err), "start");
    if (status == CPS_OK) status = check_start_length(line, err);
    if (status == CPS_OK) status = check_start_height(scene, line, err);
    for (int end = 0; end < 2 && status == CPS_OK; end++) status = check_end(scene, line, end, err);
    if (status == CPS_OK) status = cpsi_constraints_check(line, err);
    if (status == CPS_OK && line->start.kind == CPS_START_STATIC &&
        line->end[0].kind == CPS_END_KIND_FREE && line->end[1].kind == CPS_END_KIND_FREE)
        status = CPSI_FAIL_AT("ends", err, CPS_ERR_ARGUMENT,
                              "line '%s': ends: both are free, but a static start needs a held one",
                              line->name);
    return cpsi_fail_inside(err, status, "lines.%s", line->name);
}

static CpsStatus check_history(const CpsScene *scene, CpsError *err) {
    if (scene->stage_count < 0 || (scene->stage_count > 0 && !scene->stage))
        return CPSI_FAIL_AT("history", err, CPS_ERR_ARGUMENT,
                            "history: found %d stages, expected 0 or more", scene->stage_count);
    int64_t steps = 0;
    for (int k = 0; k < scene->stage_count; k++) {
        const CpsStage *stage = &scene->stage[k];
        char what[32];
        snprintf(what, sizeof what, "stage %d", k + 1);
        CpsStatus status = cpsi_stage_check(scene, stage, what, err);
        steps += stage->step_count;
        if (status == CPS_OK && (!stage->name || !stage->name[0]))
            status = cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: it has no name", what);
        if (status == CPS_OK && steps > MAX_STEPS)
            status = CPSI_FAIL_AT("steps", err, CPS_ERR_LIMIT,
                                  "%s: steps of the history exceed %lld in all, the limit", what,
                                  (long long)MAX_STEPS);
        if (status != CPS_OK) return cpsi_fail_inside(err, status, "history[%d]", k + 1);
    }
    return cpsi_pay_outs_check_history(scene, err);
}

static CpsStatus check_options(const CpsScene *scene, CpsError *err) {
    const CpsSolverOptions *solver = &scene->solver;
    if (!(solver->tolerance >= 1e-14 && solver->tolerance <= 1e-2))
        return CPSI_FAIL_AT("solver.tolerance", err, CPS_ERR_ARGUMENT,
                            "solver: tolerance is %g, expected 1e-14 to 1e-2", solver->tolerance);
    if (solver->max_iterations < 1 || solver->max_iterations > 1000)
        return CPSI_FAIL_AT("solver.max_iterations", err, CPS_ERR_ARGUMENT,
                            "solver: max_iterations is %d, expected 1 to 1000",
                            solver->max_iterations);
    if (!(solver->path_tolerance == 0 ||
          (solver->path_tolerance >= 1e-9 && solver->path_tolerance <= 1)))
        return CPSI_FAIL_AT("solver.path_tolerance", err, CPS_ERR_ARGUMENT,
                            "solver: path_tolerance is %g, expected 0 or 1e-9 to 1",
                            solver->path_tolerance);
    if (solver->max_halvings < 0 || solver->max_halvings > 30)
        return CPSI_FAIL_AT("solver.halvings", err, CPS_ERR_ARGUMENT,
                            "solver: halvings is %d, expected 0 to 30", solver->max_halvings);
    if (solver->thread_count < 1 || solver->thread_count > CPS_MAX_THREADS)
        return CPSI_FAIL_AT("solver.thread_count", err, CPS_ERR_ARGUMENT,
                            "solver: thread_count is %d, expected 1 to %d", solver->thread_count,
                            (int)CPS_MAX_THREADS);
    if (solver->linear_system != CPS_LINEAR_SYSTEM_CHAIN &&
        solver->linear_system != CPS_LINEAR_SYSTEM_DENSE)
        return CPSI_FAIL_AT("solver.linear_system", err, CPS_ERR_ARGUMENT,
                            "solver: linear_system has the unknown value %d",
                            (int)solver->linear_system);
    if (scene->friction_policy != CPS_FRICTION_POLICY_FROZEN &&
        scene->friction_policy != CPS_FRICTION_POLICY_CONSISTENT)
        return CPSI_FAIL_AT("friction_policy", err, CPS_ERR_ARGUMENT,
                            "friction_policy: unknown value %d", (int)scene->friction_policy);
    if (scene->contact_policy != CPS_CONTACT_POLICY_REACHED &&
        scene->contact_policy != CPS_CONTACT_POLICY_REFERENCE)
        return CPSI_FAIL_AT("contact_policy", err, CPS_ERR_ARGUMENT,
                            "contact_policy: unknown value %d", (int)scene->contact_policy);
    if (!cpsi_are_usable(scene->gravity))
        return CPSI_FAIL_AT("gravity", err, CPS_ERR_ARGUMENT,
                            "gravity: is (%g, %g, %g) m/s2, expected finite numbers",
                            scene->gravity[0], scene->gravity[1], scene->gravity[2]);
    if (scene->has_water_surface && !cpsi_is_usable(scene->water_surface))
        return CPSI_FAIL_AT("water_surface", err, CPS_ERR_ARGUMENT,
                            "water_surface: is %g m, expected a finite number",
                            scene->water_surface);
    return cpsi_water_check(scene, scene->gravity, "gravity", err);
}

CpsStatus cps_scene_check(const CpsScene *scene, CpsError *err) {
    if (!scene || scene->cookie != SCENE_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the scene was not made by cps_scene_default()");
    CpsStatus status = check_options(scene, err);
    if (status == CPS_OK) status = check_obstacles(scene, err);
    if (status != CPS_OK) return status;
    if (scene->line_count < 1 || !scene->line)
        return CPSI_FAIL_AT("lines", err, CPS_ERR_ARGUMENT,
                            "lines: found %d, expected at least one", scene->line_count);
    if (scene->line_count > MAX_LINES)
        return CPSI_FAIL_AT("lines", err, CPS_ERR_LIMIT, "lines: found %d, the limit is %d",
                            scene->line_count, (int)MAX_LINES);
    int64_t elements = 0;
    for (int i = 0; i < scene->line_count; i++) {
        elements += scene->line[i].element_count > 0 ? scene->line[i].element_count : 0;
        if (elements > MAX_ELEMENTS)
            return CPSI_FAIL_AT("lines", err, CPS_ERR_LIMIT,
                                "lines: %lld elements or more together, the limit is %lld",
                                (long long)elements, (long long)MAX_ELEMENTS);
    }
    status = cpsi_current_check(scene, err);
    if (status == CPS_OK) status = cpsi_bodies_check(scene, err);
    if (status == CPS_OK) status = cpsi_points_check(scene, err);
    if (status == CPS_OK) status = cpsi_potential_ends_check(scene, err);
    if (status == CPS_OK) status = cpsi_constraints_check_points(scene, err);
    if (status != CPS_OK) return status;
    CpsiHeldScene held;
    status = cpsi_held_scene(scene, &held, err);
    for (int i = 0; i < scene->line_count && status == CPS_OK; i++)
        status = check_line(&held.scene, i, err);
    if (status == CPS_OK) status = check_history(scene, err);
    if (status == CPS_OK) status = cpsi_time_check(scene, err);
    if (status == CPS_OK) status = cpsi_waves_check(scene, err);
    if (status == CPS_OK) status = cpsi_excitation_check(scene, err);
    if (status == CPS_OK) status = cpsi_members_check(scene, err);
    if (status == CPS_OK) status = cpsi_path_check(&held.scene, err);
    if (status == CPS_OK) status = cpsi_path_check_points(scene, err);
    free(held.block);
    return status;
}
