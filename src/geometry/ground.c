/* SPDX-License-Identifier: BSD-3-Clause */
/* The surface through the points of a grid (ground.h).
 *
 * Along each axis the surface is a piecewise cubic: through two neighbouring points with slopes
 * there, each the slope of the parabola through a point and its two neighbours, at an edge that of
 * the parabola through the last three points. Its value is a sum of up to four points with weights
 * that depend on the coordinate alone, and the surface is the product of both axes: 16 points and
 * two times four weights. Slopes are continuous; second derivatives are not. Parabolas and planes
 * are reproduced. */
#include "geometry/ground.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"

enum { COOKIE = 0x67726e64 };
/* Numbers beyond this are not places; squares and cubes of them stay finite. */
static const double FARTHEST = 1e100;
/* Spacings that differ by less are equal: an index is then computed. */
enum { STENCIL = 4 };

struct CpsGround {
    CpsGroundGrid grid; /* of its own arrays */
    double spacing;
    atomic_int refcount;
};

/* The points that a place on one axis depends on, with their weights in value, slope and second
 * derivative. */
typedef struct Axis {
    int first, count;
    double w[STENCIL], d[STENCIL], dd[STENCIL];
} Axis;

CpsGroundGrid cps_ground_grid_default(void) { return (CpsGroundGrid){.cookie = COOKIE}; }

/* ---- making ---- */

static CpsStatus check_axis(const char *name, int count, const double *x, CpsError *err) {
    if (count < 2 || count > CPS_MAX_GROUND_COUNT)
        return cpsi_fail(err, count < 2 ? CPS_ERR_ARGUMENT : CPS_ERR_LIMIT,
                         "ground: %d points along %s, expected 2 to %d", count, name,
                         CPS_MAX_GROUND_COUNT);
    if (!x) return cpsi_fail(err, CPS_ERR_ARGUMENT, "ground: the %s of its points are NULL", name);
    for (int i = 0; i < count; i++) {
        if (!(fabs(x[i]) <= FARTHEST))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "ground: %s[%d] is %g m, expected a finite number of at most %g", name,
                             i, x[i], FARTHEST);
        if (i > 0 && !(x[i] > x[i - 1]))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "ground: %s[%d] is %.10g m after %.10g m, expected increasing numbers",
                             name, i, x[i], x[i - 1]);
    }
    return CPS_OK;
}

static CpsStatus check_grid(const CpsGroundGrid *grid, CpsError *err) {
    if (grid->cookie != COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "ground: the grid was not made by cps_ground_grid_default()");
    CpsStatus status = check_axis("x", grid->x_count, grid->x, err);
    if (status == CPS_OK) status = check_axis("y", grid->y_count, grid->y, err);
    if (status != CPS_OK) return status;
    const double points = (double)grid->x_count * grid->y_count;
    if (points > CPS_MAX_GROUND_POINTS)
        return cpsi_fail(err, CPS_ERR_LIMIT, "ground: %g points, the limit is %d", points,
                         CPS_MAX_GROUND_POINTS);
    if (!grid->z)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "ground: the heights of its points are NULL");
    for (int j = 0; j < grid->y_count; j++)
        for (int i = 0; i < grid->x_count; i++) {
            const size_t at = (size_t)j * (size_t)grid->x_count + (size_t)i;
            if (!(fabs(grid->z[at]) <= FARTHEST))
                return cpsi_fail(err, CPS_ERR_ARGUMENT,
                                 "ground: the height at (%g, %g) m is %g m, expected a finite "
                                 "number of at most %g",
                                 grid->x[i], grid->y[j], grid->z[at], FARTHEST);
            const double *factor = grid->friction_factor;
            if (factor && !(factor[at] >= 0 && factor[at] <= FARTHEST))
                return cpsi_fail(err, CPS_ERR_ARGUMENT,
                                 "ground: the factor of friction at (%g, %g) m is %g, expected a "
                                 "finite number >= 0",
                                 grid->x[i], grid->y[j], factor[at]);
        }
    return CPS_OK;
}

static double least_spacing(int count, const double *x) {
    double least = INFINITY;
    for (int i = 1; i < count; i++) least = fmin(least, x[i] - x[i - 1]);
    return least;
}

static double *copy(double **next, const double *from, size_t count) {
    double *to = *next;
    memcpy(to, from, count * sizeof *to);
    *next += count;
    return to;
}

CpsStatus cps_ground_create(const CpsGroundGrid *grid, CpsGround **out, CpsError *err) {
    if (!out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL, expected a place for the handle");
    *out = NULL;
    if (!grid) return cpsi_fail(err, CPS_ERR_ARGUMENT, "grid is NULL");
    const CpsStatus status = check_grid(grid, err);
    if (status != CPS_OK) return status;
    const size_t columns = (size_t)grid->x_count, rows = (size_t)grid->y_count,
                 points = rows * columns;
    CpsGround *ground = malloc(sizeof *ground);
    double *block =
        malloc((columns + rows + (grid->friction_factor ? 2 : 1) * points) * sizeof *block);
    if (!ground || !block) {
        free(ground);
        free(block);
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for %zu points of a ground", points);
    }
    double *next = block;
    ground->grid = *grid;
    ground->grid.x = copy(&next, grid->x, columns);
    ground->grid.y = copy(&next, grid->y, rows);
    ground->grid.z = copy(&next, grid->z, points);
    if (grid->friction_factor)
        ground->grid.friction_factor = copy(&next, grid->friction_factor, points);
    ground->spacing =
        fmin(least_spacing(grid->x_count, grid->x), least_spacing(grid->y_count, grid->y));
    atomic_init(&ground->refcount, 1);
    *out = ground;
    return CPS_OK;
}

CpsGround *cps_ground_retain(const CpsGround *ground) {
    CpsGround *held = (CpsGround *)ground;
    if (held) atomic_fetch_add(&held->refcount, 1);
    return held;
}

void cps_ground_release(CpsGround *ground) {
    if (!ground || atomic_fetch_sub(&ground->refcount, 1) > 1) return;
    free((void *)ground->grid.x); /* the first of the block */
    free(ground);
}

CpsGroundGrid cps_ground_grid(const CpsGround *ground) { return ground->grid; }

/* ---- asking ---- */

/* The cell i of x, between points i and i + 1: a guess as if all were equally wide, and from there
 * cell by cell. */
static int cell_of(int count, const double *x, double at) {
    const double guess = (at - x[0]) / (x[count - 1] - x[0]) * (count - 1);
    int i = guess > 0 ? guess < count - 2 ? (int)guess : count - 2 : 0;
    while (i > 0 && at < x[i]) i--;
    while (i < count - 2 && at >= x[i + 1]) i++;
    return i;
}

/* Add `by` times the slope at point `at` of the stencil, that of a parabola through the points
 * p..p + 2, or of the straight line where there are only two. */
static void add_slope(const double *x, int count, int p, int at, double by, double w[STENCIL]) {
    if (count == 2) {
        w[0] -= by / (x[1] - x[0]);
        w[1] += by / (x[1] - x[0]);
        return;
    }
    const double a = x[p], b = x[p + 1], c = x[p + 2], s = x[at];
    w[p] += by * (2 * s - b - c) / ((a - b) * (a - c));
    w[p + 1] += by * (2 * s - a - c) / ((b - a) * (b - c));
    w[p + 2] += by * (2 * s - a - b) / ((c - a) * (c - b));
}

/* The weights w of a cubic in the cell of the stencil's points i and i + 1, of which v0, v1 belong
 * to the values there and s0, s1 to the slopes. */
static void add_cubic(const double *x, int count, int i, double v0, double v1, double s0, double s1,
                      double w[STENCIL]) {
    w[i] += v0;
    w[i + 1] += v1;
    add_slope(x, count, i > 0 ? i - 1 : 0, i, s0, w);
    add_slope(x, count, i + 2 < count ? i : i > 0 ? i - 1 : 0, i + 1, s1, w);
}

static Axis axis_at(int count, const double *x, double at) {
    const double within = fmin(x[count - 1], fmax(x[0], at)), beyond = at - within;
    const int cell = cell_of(count, x, within), first = cell > 0 ? cell - 1 : 0;
    Axis out = {.first = first, .count = count - first < STENCIL ? count - first : STENCIL};
    const double *p = &x[first];
    const int i = cell - first;
    const double h = p[i + 1] - p[i], t = (within - p[i]) / h, u = 1 - t;
    add_cubic(p, out.count, i, u * u * (1 + 2 * t), t * t * (1 + 2 * u), h * t * u * u,
              -h * t * t * u, out.w);
    add_cubic(p, out.count, i, -6 * t * u / h, 6 * t * u / h, u * (1 - 3 * t), t * (3 * t - 2),
              out.d);
    if (beyond == 0)
        add_cubic(p, out.count, i, (12 * t - 6) / (h * h), (6 - 12 * t) / (h * h), (6 * t - 4) / h,
                  (6 * t - 2) / h, out.dd);
    else
        for (int k = 0; k < out.count; k++) out.w[k] += beyond * out.d[k];
    return out;
}

CpsiHeight cpsi_ground_height(const CpsGround *ground, double x, double y) {
    const CpsGroundGrid *grid = &ground->grid;
    const Axis a = axis_at(grid->x_count, grid->x, x), b = axis_at(grid->y_count, grid->y, y);
    CpsiHeight out = {0};
    for (int j = 0; j < b.count; j++) {
        const double *row =
            &grid->z[(size_t)(b.first + j) * (size_t)grid->x_count + (size_t)a.first];
        double z = 0, d = 0, dd = 0;
        for (int i = 0; i < a.count; i++) {
            z += a.w[i] * row[i];
            d += a.d[i] * row[i];
            dd += a.dd[i] * row[i];
        }
        out.z += b.w[j] * z;
        out.x += b.w[j] * d;
        out.xx += b.w[j] * dd;
        out.y += b.d[j] * z;
        out.xy += b.d[j] * d;
        out.yy += b.dd[j] * z;
    }
    return out;
}

double cps_ground_height(const CpsGround *ground, double x, double y, double slope[2]) {
    const CpsiHeight at = cpsi_ground_height(ground, x, y);
    if (slope) {
        slope[0] = at.x;
        slope[1] = at.y;
    }
    return at.z;
}

double cpsi_ground_friction_factor(const CpsGround *ground, double x, double y) {
    const CpsGroundGrid *grid = &ground->grid;
    if (!grid->friction_factor) return 1;
    const int i = cell_of(grid->x_count, grid->x, x), j = cell_of(grid->y_count, grid->y, y);
    const double s = fmin(1, fmax(0, (x - grid->x[i]) / (grid->x[i + 1] - grid->x[i]))),
                 t = fmin(1, fmax(0, (y - grid->y[j]) / (grid->y[j + 1] - grid->y[j])));
    const double *low = &grid->friction_factor[(size_t)j * (size_t)grid->x_count + (size_t)i],
                 *high = low + grid->x_count;
    return (1 - t) * ((1 - s) * low[0] + s * low[1]) + t * ((1 - s) * high[0] + s * high[1]);
}

bool cpsi_ground_covers(const CpsGround *ground, double x, double y, double rounding) {
    const CpsGroundGrid *grid = &ground->grid;
    return grid->extends ||
           (x >= grid->x[0] - rounding && x <= grid->x[grid->x_count - 1] + rounding &&
            y >= grid->y[0] - rounding && y <= grid->y[grid->y_count - 1] + rounding);
}

double cpsi_ground_spacing(const CpsGround *ground) { return ground->spacing; }
