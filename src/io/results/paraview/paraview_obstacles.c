/* SPDX-License-Identifier: BSD-3-Clause */
/* The obstacles as quadrilaterals for ParaView, in text: obstacles.vtp, and step-N-obstacles.vtp
 * for each step in which an obstacle turns or moves. Balls are complete; planes and cylinders,
 * which have no ends, extend a little farther than the lines. Cells carry the number of their
 * sector of the obstacle, which makes a turn visible. Ground has the points of its grid, of a large
 * one every second, third, ..; a cone ends beyond the lines; surfaces given as functions have no
 * quadrilaterals. */
#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "base/status.h"
#include "base/vec3.h"
#include "io/results/writers.h"

enum { AROUND = 96, ALONG = 48 }; /* quadrilaterals round a circle, and from pole to pole */
enum { SECTORS = 8 };
enum { MOST_CELLS = 400 }; /* of ground, along either axis */

/* Extent beyond that of the lines, relative to it. */
static const double MARGIN = 0.15;

/* A patch of (rows + 1) x (columns + 1) points. */
typedef struct Patch {
    const CpsObstacle *obstacle;
    int rows, columns;
    Vec3 centre,
        axis[3]; /* the third is the plane's normal or the axis of rotation of a cylinder or ball */
    double reach[2]
                [2]; /* plane: along the first two axes; cylinder: along the third, in reach[0] */
    CpsGroundGrid grid; /* of ground */
    double end;         /* [m] of a cone, along its axis */
    CpsObstacle now;    /* of a capsule .. box: where it is */
    double turned;      /* [rad] about the third axis, which is right-handed with the others */
} Patch;

static Vec3 unit(Vec3 a) { return vec3_scale(1 / vec3_norm(a), a); }

/* Range of the lines along a direction, from a centre, over all snapshots of the pictures. */
static void reach_along(const CpsResults *results, Vec3 centre, Vec3 direction, double range[2]) {
    range[0] = INFINITY;
    range[1] = -INFINITY;
    double extent = 0;
    for (int s = 0; s < results->snapshot_count; ++s)
        for (int l = 0; l < results->line_count; ++l) {
            const CpsiShape *shape = &results->snapshot[s].shape[l];
            for (size_t i = 0; i < (size_t)shape->points; ++i) {
                const Vec3 from = vec3_sub(vec3_load(shape->position + 3 * i), centre);
                const double x = vec3_dot(from, direction);
                range[0] = fmin(range[0], x);
                range[1] = fmax(range[1], x);
            }
            extent = fmax(extent, results->line_length[l]);
        }
    range[0] -= MARGIN * extent;
    range[1] += MARGIN * extent;
}

static int cells_of(int points) {
    const int stride = (points - 2) / MOST_CELLS + 1;
    return (points - 2) / stride + 1;
}

/* Point i of an axis of ground that is written, the last one at the edge. */
static int index_of(int points, int i) {
    const int stride = (points - 2) / MOST_CELLS + 1;
    return i * stride < points - 1 ? i * stride : points - 1;
}

static Patch patch_of_ground(const CpsObstacle *obstacle) {
    Patch patch = {.obstacle = obstacle, .centre = vec3_load(obstacle->point)};
    if (obstacle->kind != CPS_OBSTACLE_GROUND) return patch;
    patch.grid = cps_ground_grid(obstacle->ground);
    patch.rows = cells_of(patch.grid.y_count);
    patch.columns = cells_of(patch.grid.x_count);
    return patch;
}

/* Of a capsule, torus, cone or box. */
static Patch patch_of_shape(const CpsResults *results, int k, const CpsObstacle *now) {
    Patch patch = {.obstacle = &results->obstacle[k], .now = *now};
    double range[2];
    cpsi_shape_grid(now, &patch.rows, &patch.columns);
    reach_along(results, vec3_load(now->point), unit(vec3_load(now->axis)), range);
    patch.end = range[1];
    return patch;
}

/* after a step; before the first one, step is -1 */
static Patch patch_of(const CpsResults *results, int step, int k) {
    const CpsObstacle now = cpsi_results_obstacle(results, step, k), *obstacle = &now;
    if (obstacle->kind == CPS_OBSTACLE_GROUND || obstacle->kind == CPS_OBSTACLE_SURFACE)
        return patch_of_ground(&results->obstacle[k]);
    int rows, columns;
    cpsi_shape_grid(obstacle, &rows, &columns);
    if (rows > 0) return patch_of_shape(results, k, obstacle);
    const bool plane = obstacle->kind == CPS_OBSTACLE_PLANE,
               ball = obstacle->kind == CPS_OBSTACLE_SPHERE;
    Patch patch = {.obstacle = &results->obstacle[k],
                   .rows = ball ? ALONG : 1,
                   .columns = plane ? 1 : AROUND};
    const Vec3 axis = unit(vec3_load(plane ? obstacle->normal : obstacle->axis));
    const Vec3 seed = fabs(axis.x) <= 0.75 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    patch.centre = vec3_load(obstacle->point);
    patch.axis[0] = unit(vec3_reject(seed, axis));
    patch.axis[1] = vec3_cross(axis, patch.axis[0]);
    patch.axis[2] = axis;
    reach_along(results, patch.centre, patch.axis[plane ? 0 : 2], patch.reach[0]);
    reach_along(results, patch.centre, patch.axis[1], patch.reach[1]);
    return patch;
}

static Vec3 point_of_ground(const Patch *patch, int row, int column) {
    const CpsGroundGrid *grid = &patch->grid;
    if (patch->rows == 0) return patch->centre;
    const int j = index_of(grid->y_count, row), i = index_of(grid->x_count, column);
    return vec3_add(patch->centre, vec3(grid->x[i], grid->y[j],
                                        grid->z[(size_t)j * (size_t)grid->x_count + (size_t)i]));
}

static Vec3 point_of(const Patch *patch, int row, int column) {
    if (patch->obstacle->kind == CPS_OBSTACLE_GROUND ||
        patch->obstacle->kind == CPS_OBSTACLE_SURFACE)
        return point_of_ground(patch, row, column);
    if (patch->now.radius > 0)
        return cpsi_shape_point(&patch->now, patch->end, patch->turned, row, column);
    const double r = patch->obstacle->radius, angle = patch->turned + 2 * CPSI_PI * column / AROUND,
                 polar = CPSI_PI * row / ALONG;
    double x[3];
    switch (patch->obstacle->kind) {
    case CPS_OBSTACLE_PLANE:
        x[0] = patch->reach[0][row];
        x[1] = patch->reach[1][column];
        x[2] = 0;
        break;
    case CPS_OBSTACLE_CYLINDER:
        x[0] = r * cos(angle);
        x[1] = r * sin(angle);
        x[2] = patch->reach[0][row];
        break;
    default:
        x[0] = r * sin(polar) * cos(angle);
        x[1] = r * sin(polar) * sin(angle);
        x[2] = r * cos(polar);
    }
    Vec3 place = patch->centre;
    for (int k = 0; k < 3; ++k) place = vec3_axpy(x[k], patch->axis[k], place);
    return place;
}

static void write_points(int patches, const Patch *patch, FILE *out) {
    for (const Patch *p = patch; p < patch + patches; ++p)
        for (int row = 0; row <= p->rows; ++row)
            for (int column = 0; column <= p->columns; ++column) {
                const Vec3 x = point_of(p, row, column);
                fprintf(out, "%.12g %.12g %.12g\n", x.x, x.y, x.z);
            }
}

typedef enum CellData { CONNECTIVITY, OFFSETS, OBSTACLE_ID, SECTOR } CellData;

/* one row of text per quadrilateral */
static void write_cells(int patches, const Patch *patch, CellData what, FILE *out) {
    int first = 0, cells = 0;
    for (int k = 0; k < patches; ++k) {
        const int columns = patch[k].columns, width = columns + 1;
        for (int cell = 0; cell < patch[k].rows * columns; ++cell) {
            const int at = first + cell / columns * width + cell % columns;
            if (what == CONNECTIVITY)
                fprintf(out, "%d %d %d %d\n", at, at + 1, at + 1 + width, at + width);
            if (what == OFFSETS) fprintf(out, "%d\n", 4 * ++cells);
            if (what == OBSTACLE_ID) fprintf(out, "%d\n", k);
            if (what == SECTOR) fprintf(out, "%d\n", cell % columns * SECTORS / columns);
        }
        first += (patch[k].rows + 1) * width;
    }
}

static void write_array(int patches, const Patch *patch, const char *type, const char *name,
                        CellData what, FILE *out) {
    fprintf(out, "        <DataArray type=\"%s\" Name=\"%s\" format=\"ascii\">\n", type, name);
    write_cells(patches, patch, what, out);
    fputs("        </DataArray>\n", out);
}

static void write_obstacles(int patches, const Patch *patch, FILE *out) {
    int points = 0, cells = 0;
    for (int k = 0; k < patches; ++k) {
        points += (patch[k].rows + 1) * (patch[k].columns + 1);
        cells += patch[k].rows * patch[k].columns;
    }
    fprintf(out,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
            "byte_order=\"LittleEndian\">\n"
            "  <PolyData>\n    <Piece NumberOfPoints=\"%d\" NumberOfVerts=\"0\" "
            "NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"%d\">\n      <Points>\n"
            "        <DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
            "format=\"ascii\">\n",
            points, cells);
    write_points(patches, patch, out);
    fputs("        </DataArray>\n      </Points>\n      <Polys>\n", out);
    write_array(patches, patch, "Int64", "connectivity", CONNECTIVITY, out);
    write_array(patches, patch, "Int64", "offsets", OFFSETS, out);
    fputs("      </Polys>\n      <CellData Scalars=\"obstacle_id\">\n", out);
    write_array(patches, patch, "Int32", "obstacle_id", OBSTACLE_ID, out);
    write_array(patches, patch, "Int32", "sector", SECTOR, out);
    fputs("      </CellData>\n    </Piece>\n  </PolyData>\n</VTKFile>\n", out);
}

void cpsi_paraview_obstacles_name(int step, char name[32]) {
    if (step < 0)
        snprintf(name, 32, "obstacles.vtp");
    else
        snprintf(name, 32, "step-%05d-obstacles.vtp", step);
}

bool cpsi_paraview_obstacles_move(const CpsResults *results, int step) {
    bool moves = false;
    for (int k = 0; k < results->obstacle_count; ++k)
        moves =
            moves || cpsi_results_turns(results, step, k) || cpsi_results_moves(results, step, k);
    return moves;
}

/* after a step; before the first one, step is -1 */
static CpsStatus write_file(CpsResults *results, int step, Patch *patch, CpsError *err) {
    char name[32];
    FILE *out = NULL;
    cpsi_paraview_obstacles_name(step, name);
    const CpsStatus status = cpsi_directory_create(results->directory, name, &out, err);
    if (status) return status;
    for (int k = 0; k < results->obstacle_count; ++k) {
        if (step < 0 || results->obstacle[k].moves) patch[k] = patch_of(results, step, k);
        patch[k].turned = cpsi_results_turned(results, step, k);
    }
    write_obstacles(results->obstacle_count, patch, out);
    return cpsi_directory_close_file(results->directory, out, err);
}

CpsStatus cpsi_paraview_obstacles(CpsResults *results, CpsError *err) {
    if (results->obstacle_count == 0 || results->snapshot_count == 0) return CPS_OK;
    Patch *patch = calloc((size_t)results->obstacle_count, sizeof *patch);
    if (!patch) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the surfaces of obstacles");
    CpsStatus status = write_file(results, -1, patch, err);
    for (int step = 0; step < results->row_count && !status; ++step)
        if (cpsi_paraview_obstacles_move(results, step))
            status = write_file(results, step, patch, err);
    free(patch);
    return status;
}
