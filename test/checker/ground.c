/* SPDX-License-Identifier: BSD-3-Clause */
/* Ground (ground.h), written from docs/theory.md 2.3: along x a cubic through two points of a row,
 * with the slopes there of the parabolas through a point and its neighbours (at an edge, through
 * the last three); then the same along y through what four rows give. */
#include "ground.h"

#include "mesh.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 20000 };

static double *read_variable(int nc, const char *name, const char *what, size_t rank,
                             const size_t *length) {
    char label[300];
    int id, found = 0, dimension[NC_MAX_VAR_DIMS];
    size_t count = 1;
    snprintf(label, sizeof label, "obstacle_%.200s_%s", name, what);
    if (nc_inq_varid(nc, label, &id) || nc_inq_varndims(nc, id, &found) || (size_t)found != rank ||
        nc_inq_vardimid(nc, id, dimension))
        return NULL;
    for (size_t k = 0; k < rank; k++) {
        size_t size = 0;
        if (nc_inq_dimlen(nc, dimension[k], &size) || size != length[k]) return NULL;
        count *= size;
    }
    double *value = malloc(count * sizeof *value);
    if (value && nc_get_var_double(nc, id, value)) {
        free(value);
        value = NULL;
    }
    for (size_t i = 0; value && i < count; i++)
        if (!isfinite(value[i])) {
            free(value);
            value = NULL;
        }
    return value;
}

static size_t length_of(int nc, const char *name, const char *what) {
    char label[300];
    int id;
    size_t size = 0;
    snprintf(label, sizeof label, "obstacle_%.200s_%s", name, what);
    return nc_inq_dimid(nc, label, &id) || nc_inq_dimlen(nc, id, &size) ? 0 : size;
}

static bool extends(int nc, const char *name) {
    char label[300], text[64] = "";
    int id;
    size_t size = 0;
    snprintf(label, sizeof label, "obstacle_%.200s_grid_z", name);
    return nc_inq_varid(nc, label, &id) == 0 &&
           nc_inq_attlen(nc, id, "beyond_its_edges", &size) == 0 && size < sizeof text &&
           nc_get_att_text(nc, id, "beyond_its_edges", text) == 0 && strcmp(text, "unknown") != 0;
}

static bool increase(const double *x, size_t count) {
    for (size_t i = 1; i < count; i++)
        if (!(x[i] > x[i - 1])) return false;
    return true;
}

Ground *ground_read(int nc, size_t k, FILE *log) {
    char name[201];
    name_of_obstacle(nc, k, name);
    Ground *ground = calloc(1, sizeof *ground);
    const size_t columns = length_of(nc, name, "grid_x"), rows = length_of(nc, name, "grid_y");
    const size_t flat[2] = {rows, columns};
    if (!ground) return NULL;
    if (columns >= 2 && columns <= MOST && rows >= 2 && rows <= MOST) {
        *ground = (Ground){.columns = columns, .rows = rows, .extends = extends(nc, name)};
        ground->x = read_variable(nc, name, "grid_x", 1, &columns);
        ground->y = read_variable(nc, name, "grid_y", 1, &rows);
        ground->z = read_variable(nc, name, "grid_z", 2, flat);
        ground->factor = read_variable(nc, name, "grid_friction_factor", 2, flat);
    }
    if (ground->x && ground->y && ground->z && increase(ground->x, columns) &&
        increase(ground->y, rows))
        return ground;
    if (log) fprintf(log, "no whole grid of obstacle '%s'\n", name);
    ground_free(ground);
    return NULL;
}

void ground_free(Ground *ground) {
    if (!ground) return;
    free(ground->x);
    free(ground->y);
    free(ground->z);
    free(ground->factor);
    free(ground);
}

/* The interval of a place: the last one that does not begin after it. */
static size_t interval(const double *at, size_t count, Real x) {
    size_t low = 0, high = count - 1;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (at[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Slope at point i of the parabola through three points, v given from point `base` on. */
static Real slope_of(const double *at, size_t count, const Real *v, size_t base, size_t i) {
    if (count == 2) return (v[1] - v[0]) / ((Real)at[1] - at[0]);
    const size_t m = i == 0 ? 1 : i + 1 == count ? count - 2 : i;
    const Real *p = v + (m - base), left = (Real)at[m] - at[m - 1], right = (Real)at[m + 1] - at[m],
               rise = (p[0] - p[-1]) / left, next = (p[1] - p[0]) / right;
    if (i == m) return (right * rise + left * next) / (left + right);
    const Real bend = (next - rise) / (left + right); /* half of the second derivative */
    return i < m ? rise - bend * left : next + bend * right;
}

/* Value and slope at x of the cubic in interval i; beyond the edges the tangent. */
static void cubic(const double *at, size_t count, const Real *v, size_t base, size_t i, Real x,
                  Real out[2]) {
    const Real first = at[0], last = at[count - 1],
               within = x < first  ? first
                        : x > last ? last
                                   : x;
    const Real h = (Real)at[i + 1] - at[i], t = within - at[i], a = v[i - base],
               m = slope_of(at, count, v, base, i), n = slope_of(at, count, v, base, i + 1),
               mean = (v[i + 1 - base] - a) / h, c = (3 * mean - 2 * m - n) / h,
               d = (m + n - 2 * mean) / (h * h);
    out[1] = m + t * (2 * c + 3 * d * t);
    out[0] = a + t * (m + t * (c + d * t)) + (x - within) * out[1];
}

Real ground_height(const Ground *g, Real x, Real y, Real slope[2]) {
    const size_t i = interval(g->x, g->columns, x), j = interval(g->y, g->rows, y),
                 left = i > 0 ? i - 1 : 0, low = j > 0 ? j - 1 : 0;
    Real height[4] = {0}, tilt[4] = {0}, row[4], both[2];
    for (size_t r = low; r < g->rows && r <= j + 2; r++) {
        for (size_t k = left; k < g->columns && k <= i + 2; k++)
            row[k - left] = g->z[r * g->columns + k];
        cubic(g->x, g->columns, row, left, i, x, both);
        height[r - low] = both[0];
        tilt[r - low] = both[1];
    }
    cubic(g->y, g->rows, tilt, low, j, y, both);
    slope[0] = both[0];
    cubic(g->y, g->rows, height, low, j, y, both);
    slope[1] = both[1];
    return both[0];
}

static Real part_of(const double *at, size_t count, size_t i, Real x) {
    const Real within = fmaxl(at[0], fminl(at[count - 1], x));
    return (within - at[i]) / ((Real)at[i + 1] - at[i]);
}

Real ground_factor(const Ground *g, Real x, Real y) {
    if (!g->factor) return 1;
    const size_t i = interval(g->x, g->columns, x), j = interval(g->y, g->rows, y);
    const Real s = part_of(g->x, g->columns, i, x), t = part_of(g->y, g->rows, j, y);
    const double *f = &g->factor[j * g->columns + i];
    const Real below = f[0] + s * ((Real)f[1] - f[0]),
               above = f[g->columns] + s * ((Real)f[g->columns + 1] - f[g->columns]);
    return below + t * (above - below);
}

double ground_range_of_factors(const Ground *g) {
    double low = INFINITY, high = 0;
    if (!g->factor) return 0;
    for (size_t i = 0; i < g->rows * g->columns; i++) {
        low = fmin(low, g->factor[i]);
        high = fmax(high, g->factor[i]);
    }
    return high > low ? high - low : 0;
}

Real ground_spacing(const Ground *g) {
    Real least = (Real)g->x[1] - g->x[0];
    for (size_t i = 2; i < g->columns; i++) least = fminl(least, (Real)g->x[i] - g->x[i - 1]);
    for (size_t j = 1; j < g->rows; j++) least = fminl(least, (Real)g->y[j] - g->y[j - 1]);
    return least;
}

double ground_factor_noise(const Ground *g, const double *position, const Real *point) {
    double reach = 0;
    for (int a = 0; a < 3; a++) reach = fmax(reach, fabs(position[a]) + fabs((double)point[a]));
    for (size_t i = 0; i < g->columns; i++) reach = fmax(reach, fabs(g->x[i]));
    for (size_t i = 0; i < g->rows; i++) reach = fmax(reach, fabs(g->y[i]));
    return 8 * 0x1p-53 * (ground_range_of_factors(g) * reach / (double)ground_spacing(g) + 2);
}
