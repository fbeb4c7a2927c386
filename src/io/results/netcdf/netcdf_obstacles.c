/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles, the water and motion in time in result.nc (see netcdf_obstacles.h). */
#include "io/results/netcdf/netcdf_obstacles.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/rotation.h"
#include "io/history.h"

enum { XYZ = 3, TANGENTS = 2 };

/* Numbers of an obstacle. Their names differ from the names of all fields of a line, whatever its
 * name. */
typedef enum ObstacleField {
    OBSTACLE_KIND,
    OBSTACLE_POINT,
    OBSTACLE_AXIS,
    OBSTACLE_RADIUS,
    OBSTACLE_AXIAL,
    OBSTACLE_LATERAL,
    OBSTACLE_SHAPE,
    OBSTACLE_GRAIN
} ObstacleField;

static const struct {
    const char *name, *long_name, *units;
    bool vector;
} OBSTACLE[CPSI_OBSTACLE_FIELDS] = {
    {"obstacle_kind", "kind of surface", "1", false},
    {"obstacle_point",
     "point of the plane or of the cylinder's axis, centre of the sphere, capsule, torus and box, "
     "tip of the cone, origin of ground and mesh",
     "m", true},
    {"obstacle_axis",
     "normal of the plane, axis of cylinder, sphere, capsule, torus and cone, of any length, third "
     "axis of the box; z of the others",
     "1", true},
    {"obstacle_radius",
     "radius, of the tube of a torus, the tip of a cone, the edges of a box or mesh; 0 "
     "of planes, ground and surfaces",
     "m", false},
    {"obstacle_friction_axial", "friction coefficient along the line or the grain", "1", false},
    {"obstacle_friction_lateral", "friction coefficient across it", "1", false},
    {"obstacle_friction_shape", "how the two make a set of forces, or that a set is given instead",
     "1", false},
    {"obstacle_friction_grain", "axial direction, 0: that of the line", "1", true},
};

/* Of shapes. */
static const struct {
    const char *name, *long_name, *units;
    bool vector;
} SHAPE[CPSI_SHAPE_FIELDS] = {
    {"obstacle_inside", "lines are inside of it", "1", false},
    {"obstacle_length", "of a capsule, between the centres of its round ends", "m", false},
    {"obstacle_main_radius", "of a torus, of the circle that its tube follows", "m", false},
    {"obstacle_angle", "of a cone, between axis and side", "rad", false},
    {"obstacle_size", "of a box, from face to face along its axes", "m", true},
    {"obstacle_side", "first axis of a box, of length 1", "1", true},
};

/* Of each step, where an obstacle moves. */
typedef enum ObstacleMove {
    OBSTACLE_PLACE,
    OBSTACLE_DIRECTION,
    OBSTACLE_SHIFT,
    OBSTACLE_SHIFT_TURN,
    OBSTACLE_SHIFT_ABOUT
} ObstacleMove;

static const struct {
    const char *name, *long_name, *units;
} MOVE[CPSI_OBSTACLE_MOVES] = {
    {"obstacle_place", "where obstacle_point is after the step", "m"},
    {"obstacle_direction", "normal or axis after the step, of length 1", "1"},
    {"obstacle_shift", "translation in the step", "m"},
    {"obstacle_shift_turn", "rotation in the step, its angle along its axis", "rad"},
    {"obstacle_shift_about", "point that the rotation turns about, before the translation", "m"},
};

/* Friction sets {origin + P v : A v + b in K}, padded with zeros to the largest. */
typedef enum SetField { SET_ORIGIN, SET_MAP, SET_CONE, SET_ROWS, SET_OFFSET } SetField;

static const struct {
    const char *name, *long_name;
} SET[CPSI_SET_FIELDS] = {
    {"obstacle_friction_set_origin", "friction set: {origin + P v : A v + b in K}"},
    {"obstacle_friction_set_map", "P"},
    {"obstacle_friction_set_cone",
     "rows of the cone of K that begins in this row, 1: half-line, 0: none begins"},
    {"obstacle_friction_set_rows", "A"},
    {"obstacle_friction_set_offset", "b"},
};

/* The conic form of the friction sets; false when there is none. */
static bool form_sets(CpsiNetcdfFile *file, CpsiNetcdfObstacles *o, const CpsScene *scene) {
    bool found = false;
    o->set = calloc((size_t)scene->obstacle_count + 1, sizeof *o->set);
    if (!o->set) cpsi_netcdf_keep(file, NC_ENOMEM);
    for (int k = 0; k < scene->obstacle_count && file->status == NC_NOERR; ++k) {
        if (!scene->obstacle[k].friction_set) continue;
        found = true;
        if (cps_set_conic(scene->obstacle[k].friction_set, &o->set[k], NULL) != CPS_OK)
            cpsi_netcdf_keep(file, NC_ENOMEM);
    }
    return found && file->status == NC_NOERR;
}

static void define_sets(CpsiNetcdfFile *file, CpsiNetcdfObstacles *o, const CpsScene *scene) {
    if (!form_sets(file, o, scene)) return;
    o->set_unknowns = o->set_rows = 1; /* a dimension of no length would be an unlimited one */
    for (int k = 0; k < scene->obstacle_count; ++k) {
        const size_t unknowns = (size_t)o->set[k].unknown_count, rows = (size_t)o->set[k].row_count;
        if (unknowns > o->set_unknowns) o->set_unknowns = unknowns;
        if (rows > o->set_rows) o->set_rows = rows;
    }
    const int tangent = cpsi_netcdf_dimension(file, "tangent", TANGENTS);
    const int unknown = cpsi_netcdf_dimension(file, "set_unknown", o->set_unknowns);
    const int row = cpsi_netcdf_dimension(file, "set_row", o->set_rows);
    const int shape[CPSI_SET_FIELDS][3] = {{o->dimension, tangent},
                                           {o->dimension, tangent, unknown},
                                           {o->dimension, row},
                                           {o->dimension, row, unknown},
                                           {o->dimension, row}};
    for (int f = 0; f < CPSI_SET_FIELDS; ++f)
        o->set_field[f] = cpsi_netcdf_variable(file, "", SET[f].name, NC_DOUBLE,
                                               2 + (f == SET_MAP || f == SET_ROWS), shape[f],
                                               SET[f].long_name, "1");
}

/* ---- meshes: obstacle_NAME_mesh_vertex, _triangle ---- */

static void define_mesh(CpsiNetcdfFile *file, CpsiNetcdfGround *ids, const CpsObstacle *o,
                        int xyz) {
    const CpsMeshTriangles of = cps_mesh_triangles(o->mesh);
    char prefix[128], label[160];
    int shape[2] = {0, xyz};
    snprintf(prefix, sizeof prefix, "obstacle_%.100s", o->name);
    snprintf(label, sizeof label, "%s_mesh_vertex", prefix);
    shape[0] = cpsi_netcdf_dimension(file, label, (size_t)of.vertex_count);
    ids->mesh[0] = cpsi_netcdf_variable(file, prefix, "mesh_vertex", NC_DOUBLE, 2, shape,
                                        "corners of the triangles, relative to obstacle_point, "
                                        "before the first step",
                                        "m");
    snprintf(label, sizeof label, "%s_mesh_triangle", prefix);
    shape[0] = cpsi_netcdf_dimension(file, label, (size_t)of.triangle_count);
    snprintf(label, sizeof label, "%s_mesh_corner", prefix);
    shape[1] = cpsi_netcdf_dimension(file, label, 3);
    ids->mesh[1] = cpsi_netcdf_variable(file, prefix, "mesh_triangle", NC_INT, 2, shape,
                                        "indices of the corners, from 0", "1");
    cpsi_netcdf_text(file, ids->mesh[1], "free_sides",
                     of.two_sided ? "both" : "that from which corners are seen counter-clockwise");
}

static void write_mesh(CpsiNetcdfFile *file, const CpsiNetcdfGround *ids, const CpsObstacle *o) {
    const CpsMeshTriangles of = cps_mesh_triangles(o->mesh);
    const size_t start[] = {0, 0}, vertices[] = {(size_t)of.vertex_count, XYZ},
                 triangles[] = {(size_t)of.triangle_count, 3};
    cpsi_netcdf_doubles(file, ids->mesh[0], start, vertices, of.vertex);
    cpsi_netcdf_ints(file, ids->mesh[1], start, triangles, of.triangle);
}

/* ---- ground: obstacle_NAME_grid_x, _y, _z, and the factor of friction where there is one ---- */

typedef enum GroundField { GRID_X, GRID_Y, GRID_Z, GRID_FACTOR } GroundField;

static const struct {
    const char *name, *long_name, *units;
    bool flat; /* over y and x */
} GRID[CPSI_GROUND_FIELDS] = {
    {"grid_x", "x of the points of the ground, relative to obstacle_point", "m", false},
    {"grid_y", "y of the points of the ground, relative to obstacle_point", "m", false},
    {"grid_z", "height of the points of the ground, relative to obstacle_point", "m", true},
    {"grid_friction_factor", "by which friction is multiplied, bilinear between the points", "1",
     true},
};

static void define_one(CpsiNetcdfFile *file, CpsiNetcdfGround *ground, const char *name,
                       const CpsGroundGrid *grid) {
    char prefix[128], label[160];
    int shape[2];
    snprintf(prefix, sizeof prefix, "obstacle_%.100s", name);
    snprintf(label, sizeof label, "%s_grid_y", prefix);
    shape[0] = cpsi_netcdf_dimension(file, label, (size_t)grid->y_count);
    snprintf(label, sizeof label, "%s_grid_x", prefix);
    shape[1] = cpsi_netcdf_dimension(file, label, (size_t)grid->x_count);
    for (int f = 0; f < CPSI_GROUND_FIELDS; ++f) {
        if (f == GRID_FACTOR && !grid->friction_factor) continue;
        const int *on = f == GRID_X ? &shape[1] : shape;
        ground->field[f] =
            cpsi_netcdf_variable(file, prefix, GRID[f].name, NC_DOUBLE, GRID[f].flat ? 2 : 1, on,
                                 GRID[f].long_name, GRID[f].units);
    }
    cpsi_netcdf_text(file, ground->field[GRID_Z], "beyond_its_edges",
                     grid->extends ? "goes on with the slope of the edge" : "unknown");
}

static void define_ground(CpsiNetcdfFile *file, CpsiNetcdfGround *ground, const CpsScene *scene,
                          int xyz) {
    for (int k = 0; k < scene->obstacle_count; ++k) {
        if (scene->obstacle[k].kind == CPS_OBSTACLE_MESH)
            define_mesh(file, &ground[k], &scene->obstacle[k], xyz);
        for (int f = 0; f < CPSI_GROUND_FIELDS; ++f) ground[k].field[f] = -1;
        if (scene->obstacle[k].kind != CPS_OBSTACLE_GROUND) continue;
        const CpsGroundGrid grid = cps_ground_grid(scene->obstacle[k].ground);
        define_one(file, &ground[k], scene->obstacle[k].name, &grid);
    }
}

static void write_ground(CpsiNetcdfFile *file, const CpsiNetcdfGround *ground,
                         const CpsScene *scene) {
    for (int k = 0; k < scene->obstacle_count; ++k) {
        if (scene->obstacle[k].kind == CPS_OBSTACLE_MESH)
            write_mesh(file, &ground[k], &scene->obstacle[k]);
        if (scene->obstacle[k].kind != CPS_OBSTACLE_GROUND) continue;
        const CpsGroundGrid grid = cps_ground_grid(scene->obstacle[k].ground);
        const double *value[] = {grid.x, grid.y, grid.z, grid.friction_factor};
        const size_t start[] = {0, 0}, columns = (size_t)grid.x_count, rows = (size_t)grid.y_count;
        for (int f = 0; f < CPSI_GROUND_FIELDS; ++f) {
            const size_t count[] = {f == GRID_X ? columns : rows, columns};
            if (value[f]) cpsi_netcdf_doubles(file, ground[k].field[f], start, count, value[f]);
        }
    }
}

/* ---- shapes ---- */

static bool is_shape(const CpsObstacle *o) {
    return o->shape.inside || o->kind == CPS_OBSTACLE_CAPSULE || o->kind == CPS_OBSTACLE_TORUS ||
           o->kind == CPS_OBSTACLE_CONE || o->kind == CPS_OBSTACLE_BOX;
}

static bool has_axis(const CpsObstacle *o) {
    return o->kind != CPS_OBSTACLE_BOX &&
           (is_shape(o) || o->kind == CPS_OBSTACLE_CYLINDER || o->kind == CPS_OBSTACLE_SPHERE);
}

/* Axis i of a box. */
static void box_axis(const CpsObstacle *o, int i, double out[XYZ]) {
    const Vec3 e = vec3(i == 0 ? 1 : 0, i == 1 ? 1 : 0, i == 2 ? 1 : 0);
    vec3_store(out, rotation_apply(rotation_load(o->shape.rotation), e));
}

static void write_shape(CpsiNetcdfFile *file, const CpsiNetcdfObstacles *obstacles,
                        const CpsObstacle *o, size_t k) {
    const bool box = o->kind == CPS_OBSTACLE_BOX;
    static const double NONE[XYZ] = {0, 0, 0};
    double side[XYZ] = {0, 0, 0};
    if (box) box_axis(o, 0, side);
    const double inside = o->shape.inside,
                 length = o->kind == CPS_OBSTACLE_CAPSULE ? o->shape.length : 0,
                 main_radius = o->kind == CPS_OBSTACLE_TORUS ? o->shape.main_radius : 0,
                 angle = o->kind == CPS_OBSTACLE_CONE ? o->shape.angle : 0;
    const double *value[CPSI_SHAPE_FIELDS] = {
        &inside, &length, &main_radius, &angle, box ? o->shape.size : NONE, side};
    const size_t start[] = {k, 0}, count[] = {1, XYZ};
    for (int f = 0; f < CPSI_SHAPE_FIELDS; ++f)
        cpsi_netcdf_doubles(file, obstacles->shape_field[f], start, count, value[f]);
}

/* ---- all ---- */

/* Obstacles: their names as an attribute like those of the lines, their numbers as variables. */
void cpsi_netcdf_define_obstacles(CpsiNetcdfFile *file, CpsiNetcdfObstacles *o,
                                  const CpsScene *scene, int step, int xyz) {
    size_t size = 1;
    for (int k = 0; k < scene->obstacle_count; ++k) size += strlen(scene->obstacle[k].name) + 1;
    char *names = calloc(size, 1), *next = names;
    if (!names) cpsi_netcdf_keep(file, NC_ENOMEM);
    if (names)
        for (int k = 0; k < scene->obstacle_count; ++k)
            next += snprintf(next, size - (size_t)(next - names), "%s%s", k ? " " : "",
                             scene->obstacle[k].name);
    cpsi_netcdf_text(file, NC_GLOBAL, "obstacles", names ? names : "");
    free(names);
    o->count = scene->obstacle_count;
    if (scene->obstacle_count == 0) return; /* a dimension of no length would be an unlimited one */
    o->dimension = cpsi_netcdf_dimension(file, "obstacle", (size_t)scene->obstacle_count);
    const int shape[] = {o->dimension, xyz}, turned[] = {step, o->dimension};
    for (int f = 0; f < CPSI_OBSTACLE_FIELDS; ++f)
        o->field[f] =
            cpsi_netcdf_variable(file, "", OBSTACLE[f].name, NC_DOUBLE, 1 + OBSTACLE[f].vector,
                                 shape, OBSTACLE[f].long_name, OBSTACLE[f].units);
    cpsi_netcdf_flags(file, o->field[OBSTACLE_KIND], NC_DOUBLE, 10,
                      (const int[]){0, 1, 2, 3, 4, 5, 6, 7, 8, 9},
                      "plane cylinder sphere ground surface capsule torus cone box mesh");
    for (int k = 0; k < scene->obstacle_count; ++k)
        o->has_shapes = o->has_shapes || is_shape(&scene->obstacle[k]);
    for (int f = 0; f < (o->has_shapes ? CPSI_SHAPE_FIELDS : 0); ++f)
        o->shape_field[f] =
            cpsi_netcdf_variable(file, "", SHAPE[f].name, NC_DOUBLE, 1 + SHAPE[f].vector, shape,
                                 SHAPE[f].long_name, SHAPE[f].units);
    cpsi_netcdf_flags(file, o->field[OBSTACLE_SHAPE], NC_DOUBLE, 3, NULL, "ellipse box set");
    o->turn = cpsi_netcdf_variable(file, "", "obstacle_turn", NC_DOUBLE, 2, turned,
                                   "angle turned about its axis in the step", "rad");
    for (int k = 0; k < scene->obstacle_count; ++k) o->moves = o->moves || scene->obstacle[k].moves;
    const int moved[] = {step, o->dimension, xyz};
    if (o->moves)
        for (int f = 0; f < CPSI_OBSTACLE_MOVES; ++f)
            o->move[f] = cpsi_netcdf_variable(file, "", MOVE[f].name, NC_DOUBLE, 3, moved,
                                              MOVE[f].long_name, MOVE[f].units);
    define_sets(file, o, scene);
    o->ground = calloc((size_t)scene->obstacle_count, sizeof *o->ground);
    if (!o->ground) cpsi_netcdf_keep(file, NC_ENOMEM);
    if (o->ground) define_ground(file, o->ground, scene, xyz);
}

void cpsi_netcdf_free_sets(CpsiNetcdfObstacles *o) {
    for (int k = 0; o->set && k < o->count; ++k) cps_set_conic_clear(&o->set[k]);
    free(o->set);
    o->set = NULL;
    free(o->ground);
    o->ground = NULL;
}

static void write_fields(CpsiNetcdfFile *file, const CpsiNetcdfObstacles *obstacles,
                         const CpsScene *scene, const double origin[XYZ]) {
    for (size_t k = 0; k < (size_t)scene->obstacle_count; ++k) {
        const CpsObstacle *o = &scene->obstacle[k];
        const bool plane = o->kind == CPS_OBSTACLE_PLANE, box = o->kind == CPS_OBSTACLE_BOX;
        double third[XYZ] = {0, 0, 1};
        if (box) box_axis(o, 2, third);
        const double kind = o->kind,
                     radius = has_axis(o) || box || o->kind == CPS_OBSTACLE_MESH ? o->radius : 0,
                     shape = o->friction_set ? 2 : o->friction_shape;
        const double lateral = o->has_friction_lateral ? o->friction_lateral : o->friction;
        const double point[XYZ] = {o->point[0] - origin[0], o->point[1] - origin[1],
                                   o->point[2] - origin[2]};
        const double *value[CPSI_OBSTACLE_FIELDS] = {
            &kind,   point,        plane ? o->normal : has_axis(o) ? o->axis : third,
            &radius, &o->friction, &lateral,
            &shape,  o->grain};
        const size_t start[] = {k, 0}, count[] = {1, XYZ};
        for (int f = 0; f < CPSI_OBSTACLE_FIELDS; ++f)
            cpsi_netcdf_doubles(file, obstacles->field[f], start, count, value[f]);
        if (obstacles->has_shapes) write_shape(file, obstacles, o, k);
    }
}

/* A matrix of obstacle k, padded with zeros; columns 0: a vector. */
static void write_padded(CpsiNetcdfFile *file, int variable, size_t k, const size_t padded[2],
                         int rows, int columns, const double *value) {
    const size_t start[] = {k, 0, 0}, count[] = {1, padded[0], padded[1]};
    const size_t width = padded[1], each = columns > 0 ? (size_t)columns : 1;
    double *all = calloc(padded[0] * width, sizeof *all);
    if (!all) cpsi_netcdf_keep(file, NC_ENOMEM);
    for (size_t i = 0; all && i < (size_t)rows; ++i)
        memcpy(&all[i * width], &value[i * each], each * sizeof *all);
    if (all) cpsi_netcdf_doubles(file, variable, start, count, all);
    free(all);
}

static void write_sets(CpsiNetcdfFile *file, const CpsiNetcdfObstacles *o) {
    const size_t rows = o->set_rows, unknowns = o->set_unknowns;
    if (rows == 0) return;
    for (size_t k = 0; k < (size_t)o->count && file->status == NC_NOERR; ++k) {
        const CpsSetConic *set = &o->set[k];
        double *cone = calloc(rows, sizeof *cone), *next = cone;
        if (!cone) cpsi_netcdf_keep(file, NC_ENOMEM);
        if (cone)
            for (int c = 0; c < set->cone_count; next += set->dim[c++]) *next = set->dim[c];
        write_padded(file, o->set_field[SET_ORIGIN], k, (size_t[]){TANGENTS, 1}, set->space, 0,
                     set->origin);
        write_padded(file, o->set_field[SET_MAP], k, (size_t[]){TANGENTS, unknowns}, set->space,
                     set->unknown_count, set->p);
        if (cone)
            write_padded(file, o->set_field[SET_CONE], k, (size_t[]){rows, 1}, set->row_count, 0,
                         cone);
        write_padded(file, o->set_field[SET_ROWS], k, (size_t[]){rows, unknowns}, set->row_count,
                     set->unknown_count, set->a);
        write_padded(file, o->set_field[SET_OFFSET], k, (size_t[]){rows, 1}, set->row_count, 0,
                     set->b);
        free(cone);
    }
}

void cpsi_netcdf_append_obstacles(CpsiNetcdfFile *file, const CpsiNetcdfObstacles *obstacles,
                                  size_t step, const CpsEvolution *evolution) {
    for (size_t k = 0; k < (size_t)obstacles->count; ++k) {
        const CpsObstacleReport now = cps_evolution_obstacle_view(evolution, (int)k);
        const size_t start[] = {step, k, 0}, count[] = {1, 1, XYZ};
        const double *value[CPSI_OBSTACLE_MOVES] = {[OBSTACLE_PLACE] = now.point,
                                                    [OBSTACLE_DIRECTION] = now.axis,
                                                    [OBSTACLE_SHIFT] = now.by,
                                                    [OBSTACLE_SHIFT_TURN] = now.turn,
                                                    [OBSTACLE_SHIFT_ABOUT] = now.about};
        cpsi_netcdf_doubles(file, obstacles->turn, start, count, &now.turned);
        if (!obstacles->moves) continue;
        for (int f = 0; f < CPSI_OBSTACLE_MOVES; ++f)
            cpsi_netcdf_doubles(file, obstacles->move[f], start, count, value[f]);
    }
}

void cpsi_netcdf_write_obstacles(CpsiNetcdfFile *file, const CpsiNetcdfObstacles *obstacles,
                                 const CpsScene *scene, const double origin[XYZ]) {
    write_fields(file, obstacles, scene, origin);
    write_sets(file, obstacles);
    if (obstacles->ground) write_ground(file, obstacles->ground, scene);
}

static void define_bearing_areas(CpsiNetcdfFile *file, const CpsScene *scene) {
    const size_t count = (size_t)scene->point_count;
    double *area = calloc(count + 1, sizeof *area);
    if (!area) cpsi_netcdf_keep(file, NC_ENOMEM);
    for (size_t k = 0; area && k < count; ++k) area[k] = scene->point[k].bearing_area;
    if (area && count > 0) cpsi_netcdf_numbers(file, "bearing_area_of_point", count, area);
    free(area);
}

void cpsi_netcdf_define_soft(CpsiNetcdfFile *file, const CpsScene *scene) {
    const size_t count = (size_t)scene->obstacle_count;
    double *stiffness = calloc(count + 1, sizeof *stiffness), most = 0;
    if (!stiffness) cpsi_netcdf_keep(file, NC_ENOMEM);
    for (size_t k = 0; stiffness && k < count; ++k) {
        stiffness[k] = scene->obstacle[k].stiffness;
        if (stiffness[k] > most) most = stiffness[k];
    }
    if (most > 0) cpsi_netcdf_numbers(file, "obstacle_stiffness", count, stiffness);
    bool damps = false;
    for (size_t k = 0; stiffness && k < count; ++k) {
        stiffness[k] = scene->obstacle[k].damping;
        damps = damps || stiffness[k] > 0;
    }
    if (damps) cpsi_netcdf_numbers(file, "obstacle_damping", count, stiffness);
    free(stiffness);
    const int lines = most > 0 ? scene->line_count : 0;
    for (int i = 0; i < lines; ++i) {
        char name[NC_MAX_NAME + 1];
        snprintf(name, sizeof name, "%.200s_bearing_width", scene->line[i].name);
        cpsi_netcdf_numbers(file, name, 1, &scene->line[i].bearing_width);
    }
    if (most > 0) define_bearing_areas(file, scene);
}

enum { OF_WAVE = 4 };

static void define_waves(CpsiNetcdfFile *file, const CpsScene *scene) {
    const CpsWaves *waves = scene->current->waves;
    double *number = malloc(OF_WAVE * (size_t)waves->wave_count * sizeof *number);
    if (!number) cpsi_netcdf_keep(file, NC_ENOMEM);
    for (int k = 0; number && k < waves->wave_count; ++k) {
        const CpsWave *wave = &waves->wave[k];
        const double of[OF_WAVE] = {wave->amplitude, wave->period, wave->direction, wave->phase};
        memcpy(&number[OF_WAVE * k], of, sizeof of);
    }
    if (number) cpsi_netcdf_numbers(file, "waves", OF_WAVE * (size_t)waves->wave_count, number);
    free(number);
    if (isfinite(waves->depth)) cpsi_netcdf_numbers(file, "wave_depth", 1, &waves->depth);
    cpsi_netcdf_numbers(file, "wave_ramp", 1, &waves->ramp);
}

void cpsi_netcdf_define_current(CpsiNetcdfFile *file, const CpsScene *scene, double origin_z) {
    const CpsCurrent *current = scene->current;
    if (!current) return;
    double *rows = malloc(4 * (size_t)current->row_count * sizeof *rows);
    if (!rows) cpsi_netcdf_keep(file, NC_ENOMEM);
    for (int k = 0; rows && k < current->row_count; ++k) {
        rows[4 * k] = current->row[k].z - origin_z;
        memcpy(&rows[4 * k + 1], current->row[k].velocity, 3 * sizeof *rows);
    }
    cpsi_netcdf_numbers(file, "water_density", 1, &current->density);
    if (rows) cpsi_netcdf_numbers(file, "current", 4 * (size_t)current->row_count, rows);
    free(rows);
    if (current->waves) define_waves(file, scene);
    for (int i = 0; i < scene->line_count; ++i) {
        const CpsLineLoads *loads = scene->line[i].loads;
        if (!loads || !(loads->drag.diameter > 0)) continue;
        const double given[] = {loads->drag.diameter, loads->drag.normal, loads->drag.tangential};
        char name[NC_MAX_NAME + 1];
        snprintf(name, sizeof name, "%.200s_drag", scene->line[i].name);
        cpsi_netcdf_numbers(file, name, 3, given);
        const double added[] = {loads->drag.added_normal, loads->drag.added_tangential};
        snprintf(name, sizeof name, "%.200s_added_mass", scene->line[i].name);
        if (added[0] > 0 || added[1] > 0) cpsi_netcdf_numbers(file, name, 2, added);
    }
}

/* ---- motion in time ---- */

void cpsi_netcdf_define_time(CpsiNetcdfFile *file, CpsiNetcdfTime *ids, const CpsScene *scene,
                             int step) {
    ids->is_there = cpsi_has_duration(scene);
    if (!ids->is_there) return;
    ids->time = cpsi_netcdf_variable(file, "", "time", NC_DOUBLE, 1, &step,
                                     "time since the history began", "s");
    ids->length = cpsi_netcdf_variable(file, "", "time_step", NC_DOUBLE, 1, &step,
                                       "length of the step; 0: it is quasi-static", "s");
    ids->error = cpsi_netcdf_variable(file, "", "step_error", NC_DOUBLE, 1, &step,
                                      "largest error of places that the step makes, by its own "
                                      "estimate, where an error is asked for",
                                      "m");
    ids->rejected = cpsi_netcdf_variable(file, "", "steps_rejected", NC_INT, 1, &step,
                                         "tries of the step that were taken back", "1");
    cpsi_netcdf_text(file, NC_GLOBAL, "time_scheme",
                     scene->time_scheme == CPS_TIME_SCHEME_EULER ? "euler" : "bdf2");
}

void cpsi_netcdf_append_time(CpsiNetcdfFile *file, const CpsiNetcdfTime *ids, size_t step,
                             const CpsEvolution *evolution) {
    const size_t one = 1;
    const double time = cps_evolution_time(evolution);
    const CpsPace pace = cps_evolution_pace(evolution);
    if (!ids->is_there) return;
    cpsi_netcdf_doubles(file, ids->time, &step, &one, &time);
    cpsi_netcdf_doubles(file, ids->length, &step, &one, &pace.length);
    cpsi_netcdf_doubles(file, ids->error, &step, &one, &pace.error);
    cpsi_netcdf_int(file, ids->rejected, &step, pace.rejected);
}

void cpsi_netcdf_define_motion(CpsiNetcdfFile *file, const CpsiNetcdfTime *time,
                               CpsiNetcdfMotion *ids, const CpsLine *given,
                               const int dimension[4]) {
    static const struct {
        const char *name, *long_name, *units;
    } ENTRY[CPSI_MOTION_NUMBERS] = {
        {"kinetic", "kinetic energy", "J"},
        {"ledger_kinetic", "growth of the kinetic energy", "J"},
        {"ledger_impact", "energy lost where nodes land", "J"},
        {"ledger_scheme", "energy lost by the scheme in time", "J"},
        {"ledger_settling", "energy lost where a quasi-static step brings it to rest", "J"},
        {"ledger_damping", "energy lost by internal damping", "J"},
        {"ledger_drag", "work done on the water against its drag", "J"},
        {"ledger_added", "work done on the water that is moved along", "J"},
        {"ledger_waves", "work of the water's own acceleration in waves", "J"},
        {"ledger_turnover", "sum of the sizes of all entries of the ledger", "J"},
        {"position_bound", "guaranteed rms error of the positions, by mass", "m"},
        {"landed", "contacts of nodes that began to bear", "1"},
        {"changed", "contacts that went from rest to sliding or back", "1"},
        {"snatched", "elements that went from slack to taut", "1"},
        {"velocity_given", "ends with a given velocity: 1 A, 2 B, 3 both, 0 none", "1"}};
    const char *line = given->name;
    const int nodes[] = {dimension[0], dimension[1], dimension[2]},
              elements[] = {dimension[0], dimension[3]};
    ids->is_there = time->is_there && !given->quasi_static;
    if (!ids->is_there) return;
    ids->has_damping = given->damping > 0;
    if (ids->has_damping) {
        char name[NC_MAX_NAME + 1];
        snprintf(name, sizeof name, "%.200s_damping", line);
        cpsi_netcdf_numbers(file, name, 1, &given->damping);
        ids->elongation = cpsi_netcdf_variable(file, line, "elongation", NC_DOUBLE, 2, elements,
                                               "elongation by which internal damping goes", "1");
        ids->rest = cpsi_netcdf_variable(file, line, "elongation_rest", NC_DOUBLE, 2, elements,
                                         "elongation at which the tension of the step begins", "1");
    }
    ids->mass = cpsi_netcdf_variable(file, line, "node_mass", NC_DOUBLE, 1, &dimension[1],
                                     "mass that moves with the node", "kg");
    ids->velocity = cpsi_netcdf_variable(file, line, "velocity", NC_DOUBLE, 3, nodes,
                                         "velocity after the step", "m s-1");
    ids->rest_velocity = cpsi_netcdf_variable(
        file, line, "rest_velocity", NC_DOUBLE, 3, nodes,
        "v* of the scheme: the acceleration is (v - v*)/k with v = (position - reference)/k",
        "m s-1");
    ids->span = cpsi_netcdf_variable(file, line, "span", NC_DOUBLE, 2, nodes,
                                     "k of the scheme, 0: a quasi-static step", "s");
    for (int i = 0; i < CPSI_MOTION_NUMBERS; ++i)
        ids->number[i] = cpsi_netcdf_variable(file, line, ENTRY[i].name, NC_DOUBLE, 1, nodes,
                                              ENTRY[i].long_name, ENTRY[i].units);
}

void cpsi_netcdf_write_motion(CpsiNetcdfFile *file, const CpsiNetcdfMotion *ids,
                              const CpsEvolution *evolution, int line) {
    const size_t first = 0,
                 nodes = (size_t)cps_evolution_line_view(evolution, line).element_count + 1;
    if (ids->is_there)
        cpsi_netcdf_doubles(file, ids->mass, &first, &nodes,
                            cps_evolution_line_motion(evolution, line).mass);
}

void cpsi_netcdf_append_motion(CpsiNetcdfFile *file, const CpsiNetcdfMotion *ids, size_t step,
                               const CpsEvolution *evolution, int line) {
    if (!ids->is_there) return;
    const CpsLineMotion motion = cps_evolution_line_motion(evolution, line);
    const size_t nodes = (size_t)cps_evolution_line_view(evolution, line).element_count + 1;
    const size_t start[] = {step, 0, 0}, count[] = {1, nodes, XYZ};
    const double number[CPSI_MOTION_NUMBERS] = {motion.kinetic,
                                                motion.ledger.kinetic,
                                                motion.ledger.impact,
                                                motion.ledger.scheme,
                                                motion.ledger.settling,
                                                motion.ledger.damping,
                                                motion.ledger.drag,
                                                motion.ledger.added,
                                                motion.ledger.waves,
                                                motion.ledger.turnover,
                                                motion.position_bound,
                                                (double)motion.landed,
                                                (double)motion.changed,
                                                (double)motion.snatched,
                                                motion.velocity_given[CPS_END_A] +
                                                    2.0 * motion.velocity_given[CPS_END_B]};
    cpsi_netcdf_doubles(file, ids->velocity, start, count, motion.velocity);
    cpsi_netcdf_doubles(file, ids->rest_velocity, start, count, motion.rest_velocity);
    cpsi_netcdf_doubles(file, ids->span, start, count, motion.span);
    if (ids->has_damping) {
        const size_t elements[] = {1, nodes - 1};
        cpsi_netcdf_doubles(file, ids->elongation, start, elements, motion.elongation);
        cpsi_netcdf_doubles(file, ids->rest, start, elements, motion.rest);
    }
    for (int i = 0; i < CPSI_MOTION_NUMBERS; ++i)
        cpsi_netcdf_doubles(file, ids->number[i], start, count, &number[i]);
}

/* ---- sets of ends and of points ---- */

enum { QUATERNION = 4 };

/* The conic form {origin + P v : A v + b in K} of a set given by an expression, as attributes;
 * without unknowns it is the origin alone. */
static void define_form(CpsiNetcdfFile *file, const char *prefix, const CpsConstraint *on,
                        const double origin[3]) {
    CpsSetConic form;
    CpsSetFacts facts;
    CpsSet *moved = NULL;
    double middle[3] = {0}, back[3];
    /* about a place of the set, so that its numbers are of its own size */
    bool made = cps_set_facts(on->set, 0, &facts, middle, NULL, NULL) == CPS_OK;
    for (int a = 0; a < 3; ++a) back[a] = -middle[a];
    made = made && cps_set_translate(back, on->set, &moved, NULL) == CPS_OK &&
           cps_set_conic(moved, &form, NULL) == CPS_OK;
    cps_set_release(moved);
    if (!made) {
        cpsi_netcdf_keep(file, NC_ENOMEM);
        return;
    }
    const size_t n = (size_t)form.unknown_count, m = (size_t)form.row_count;
    double at[3], *cone = calloc(m + 1, sizeof *cone);
    if (!cone) {
        cpsi_netcdf_keep(file, NC_ENOMEM);
        cps_set_conic_clear(&form);
        return;
    }
    for (int a = 0; a < 3; ++a) at[a] = form.origin[a] + (middle[a] + (on->point[a] - origin[a]));
    for (int k = 0, i = 0; k < form.cone_count; i += form.dim[k], ++k) cone[i] = form.dim[k];
    const struct {
        const char *what;
        size_t count;
        const double *value;
    } part[] = {{"origin", 3, at},
                {"map", 3 * n, form.p},
                {"cone", m, cone},
                {"rows", m * n, form.a},
                {"offset", m, form.b}};
    for (size_t i = 0; i < sizeof part / sizeof *part; ++i) {
        char name[NC_MAX_NAME + 1];
        snprintf(name, sizeof name, "%.200s_%s", prefix, part[i].what);
        if (n > 0 || i == 0) cpsi_netcdf_numbers(file, name, part[i].count, part[i].value);
    }
    free(cone);
    cps_set_conic_clear(&form);
}

/* A variable of the sets: of the ends of line `of`, or where that is empty of points. The
 * dimensions are of what is held, and `more` if that is not negative. */
static int define_set(CpsiNetcdfFile *file, const char *of, const char *what, int type, int owner,
                      int more, const char *long_name, const char *units) {
    const int shape[] = {owner, more};
    char name[64];
    snprintf(name, sizeof name, "set_%s%s", what, of[0] ? "" : "_of_point");
    return cpsi_netcdf_variable(file, of, name, type, more < 0 ? 1 : 2, shape, long_name, units);
}

static void define_set_variables(CpsiNetcdfFile *file, CpsiNetcdfSets *ids, const char *of,
                                 int owner, int xyz) {
    char four[256];
    snprintf(four, sizeof four, "%.200s_set_quaternion", of[0] ? of : "point");
    ids->is_there = true;
    ids->kind = define_set(file, of, "kind", NC_BYTE, owner, -1,
                           of[0] ? "set that the free end is held to"
                                 : "set that the free point is held to",
                           "1");
    cpsi_netcdf_flags(file, ids->kind, NC_BYTE, 7, NULL, "none rail half_space ball disc box set");
    ids->point = define_set(file, of, "point", NC_DOUBLE, owner, xyz,
                            "beginning or middle of the set, or a point of its plane", "m");
    ids->axis = define_set(file, of, "axis", NC_DOUBLE, owner, xyz,
                           "direction of a rail, inward normal of a half-space, normal of a "
                           "disc",
                           "1");
    ids->length = define_set(file, of, "length", NC_DOUBLE, owner, -1,
                             "length of a rail, infinite without ends", "m");
    ids->radius =
        define_set(file, of, "radius", NC_DOUBLE, owner, -1, "radius of a ball or disc", "m");
    ids->size = define_set(file, of, "size", NC_DOUBLE, owner, xyz,
                           "size of a box along its own axes", "m");
    ids->rotation = define_set(file, of, "rotation", NC_DOUBLE, owner,
                               cpsi_netcdf_dimension(file, four, QUATERNION),
                               "rotation of a box, quaternion w x y z; 0 0 0 0: none", "1");
}

void cpsi_netcdf_define_sets(CpsiNetcdfFile *file, CpsiNetcdfSets *ids, const CpsLine *line,
                             const int dimension[3], const double origin[3]) {
    char prefix[NC_MAX_NAME + 1];
    ids->is_there = cpsi_has_set(line);
    if (!ids->is_there) return;
    for (int e = 0; e < 2; ++e) {
        snprintf(prefix, sizeof prefix, "%.200s_set_%c", line->name, e == CPS_END_A ? 'A' : 'B');
        if (line->constraint[e].kind == CPS_CONSTRAINT_KIND_SET)
            define_form(file, prefix, &line->constraint[e], origin);
    }
    define_set_variables(file, ids, line->name, dimension[1], dimension[2]);
    ids->reaction = cpsi_netcdf_variable(file, line->name, "set_reaction", NC_DOUBLE, 3, dimension,
                                         "reaction of the set on the end", "N");
}

void cpsi_netcdf_define_point_sets(CpsiNetcdfFile *file, CpsiNetcdfSets *ids, const CpsScene *scene,
                                   const int dimension[3], const double origin[3]) {
    char prefix[NC_MAX_NAME + 1];
    ids->is_there = cpsi_has_point_set(scene);
    if (!ids->is_there) return;
    for (int k = 0; k < scene->point_count; ++k) {
        snprintf(prefix, sizeof prefix, "%.200s_set", scene->point[k].name);
        if (scene->point[k].constraint.kind == CPS_CONSTRAINT_KIND_SET)
            define_form(file, prefix, &scene->point[k].constraint, origin);
    }
    define_set_variables(file, ids, "", dimension[1], dimension[2]);
    ids->reaction = cpsi_netcdf_variable(file, "", "set_reaction_of_point", NC_DOUBLE, 3, dimension,
                                         "reaction of the set on the point", "N");
}

void cpsi_netcdf_write_set(CpsiNetcdfFile *file, const CpsiNetcdfSets *ids, size_t owner,
                           const CpsConstraint *on, const double origin[3]) {
    const size_t start[] = {owner, 0}, one[] = {1}, three[] = {1, 3}, four[] = {1, QUATERNION};
    const unsigned char kind = (unsigned char)on->kind;
    double point[3];
    if (!ids->is_there) return;
    for (int a = 0; a < 3; ++a) point[a] = on->point[a] - origin[a];
    cpsi_netcdf_bytes(file, ids->kind, start, one, &kind);
    cpsi_netcdf_doubles(file, ids->point, start, three, point);
    cpsi_netcdf_doubles(file, ids->axis, start, three, on->axis);
    cpsi_netcdf_doubles(file, ids->length, start, one, &on->length);
    cpsi_netcdf_doubles(file, ids->radius, start, one, &on->radius);
    cpsi_netcdf_doubles(file, ids->size, start, three, on->size);
    cpsi_netcdf_doubles(file, ids->rotation, start, four, on->rotation);
}

void cpsi_netcdf_append_sets(CpsiNetcdfFile *file, const CpsiNetcdfSets *ids, size_t step,
                             const CpsEvolution *evolution, int line) {
    const size_t start[] = {step, 0, 0}, count[] = {1, 2, 3};
    double reaction[2][3];
    if (!ids->is_there) return;
    for (int end = 0; end < 2; ++end) {
        const CpsConstraintReport report = cps_evolution_constraint_report(evolution, line, end);
        memcpy(reaction[end], report.reaction, sizeof reaction[end]);
    }
    cpsi_netcdf_doubles(file, ids->reaction, start, count, reaction[0]);
}

void cpsi_netcdf_define_potential(CpsiNetcdfFile *file, CpsiNetcdfPotential *ids,
                                  const CpsLine *line, const int dimension[3]) {
    ids->is_there = line->loads && line->loads->potential.function;
    if (!ids->is_there) return;
    ids->energy = cpsi_netcdf_variable(file, line->name, "potential_energy", NC_DOUBLE, 2,
                                       dimension, "energy in the potential of the program", "J");
    ids->force = cpsi_netcdf_variable(file, line->name, "potential_force", NC_DOUBLE, 3, dimension,
                                      "its force, part of node_load", "N");
}

void cpsi_netcdf_append_potential(CpsiNetcdfFile *file, const CpsiNetcdfPotential *ids, size_t step,
                                  const CpsEvolution *evolution, int line) {
    if (!ids->is_there) return;
    const CpsPotentialView view = cps_evolution_potential(evolution, line);
    const size_t start[] = {step, 0, 0}, count[] = {1, (size_t)view.node_count, 3};
    cpsi_netcdf_doubles(file, ids->energy, start, count, view.energy);
    cpsi_netcdf_doubles(file, ids->force, start, count, view.force);
}

void cpsi_netcdf_define_water(CpsiNetcdfFile *file, CpsiNetcdfWater *ids, const CpsScene *scene,
                              int line, const int dimension[3]) {
    const CpsLineLoads *loads = scene->line[line].loads;
    ids->is_there = scene->current && scene->current->function && loads && loads->drag.diameter > 0;
    if (!ids->is_there) return;
    const char *name = scene->line[line].name;
    ids->velocity = cpsi_netcdf_variable(file, name, "water_velocity", NC_DOUBLE, 3, dimension,
                                         "of the water in the middle of the element", "m s-1");
    ids->acceleration = cpsi_netcdf_variable(file, name, "water_acceleration", NC_DOUBLE, 3,
                                             dimension, "likewise, in a fixed place", "m s-2");
}

void cpsi_netcdf_append_water(CpsiNetcdfFile *file, const CpsiNetcdfWater *ids, size_t step,
                              const CpsEvolution *evolution, int line) {
    if (!ids->is_there) return;
    const size_t elements = (size_t)cps_evolution_line_view(evolution, line).element_count,
                 start[] = {step, 0, 0}, count[] = {1, elements, 3};
    double *water = calloc(6 * elements, sizeof *water);
    if (!water) {
        cpsi_netcdf_keep(file, NC_ENOMEM);
        return;
    }
    cps_evolution_water(evolution, line, water, &water[3 * elements]);
    cpsi_netcdf_doubles(file, ids->velocity, start, count, water);
    cpsi_netcdf_doubles(file, ids->acceleration, start, count, &water[3 * elements]);
    free(water);
}
