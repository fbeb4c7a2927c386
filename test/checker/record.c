/* SPDX-License-Identifier: BSD-3-Clause */
/* Reader of result.nc for the checker, on the C interface of netCDF. Every variable's shape is
 * compared with the dimensions before a byte of it is read, and every size is bounded before
 * anything is allocated. */
#include "record.h"
#include "damping.h"
#include "elongation.h"
#include "failure.h"
#include "grasps.h"
#include "inertia.h"
#include "loads.h"
#include "places.h"
#include "sets.h"
#include "shape.h"
#include "soft.h"
#include "winches.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

const char *const RANGE_NAME[RANGES] = {"end_tension_least", "end_tension_least_bound",
                                        "end_tension_greatest", "end_tension_greatest_bound"};
const char *const CLAIM_NAME[CLAIMS] = {"primal",
                                        "dual",
                                        "gap",
                                        "scale",
                                        "tension_bound",
                                        "tension_estimate",
                                        "force_residual",
                                        "largest_force",
                                        "law_residual",
                                        "contact_residual",
                                        "friction_residual",
                                        "stretch_residual",
                                        "penetration",
                                        "element_penetration",
                                        "element_push",
                                        "elongation_residual"};

/* more than any result of this project holds; keeps sizes far from overflow */
enum {
    MAX_NODES = 20000000,
    MAX_LINES = 100000,
    MAX_SURFACES = 100000,
    MAX_SET = 1000,
    MAX_NAME = 256,
    MAX_RANK = 3
};

static int complain(FILE *log, const char *what, const char *name, int status) {
    if (log) {
        fprintf(log, "%s '%s'%s%s\n", what, name, status ? ": " : "",
                status ? nc_strerror(status) : "");
    }
    return -1;
}

/* Split the global attribute `what` at its blanks. */
static int split_names(char *text, const char *what, char ***names, size_t *found, FILE *log) {
    size_t count = 0;
    for (const char *c = text; *c; c++) count += *c != ' ' && (c == text || c[-1] == ' ');
    if (count == 0 || count > MAX_LINES)
        return complain(log, "no names, or too many, in attribute", what, 0);
    *names = calloc(count, sizeof **names);
    if (!*names) return complain(log, "out of memory for", what, 0);
    char *rest = NULL;
    for (char *name = strtok_r(text, " ", &rest); name; name = strtok_r(NULL, " ", &rest)) {
        if (strlen(name) > MAX_NAME) return complain(log, "too long a name:", name, 0);
        char *copy = malloc(strlen(name) + 1);
        if (!copy) return complain(log, "out of memory for", name, 0);
        strcpy(copy, name);
        (*names)[(*found)++] = copy;
    }
    return 0;
}

/* The names in a global attribute. */
static int read_names(const Source *source, const char *what, char ***names, size_t *found,
                      FILE *log) {
    size_t bytes;
    int status = nc_inq_attlen(source->nc, NC_GLOBAL, what, &bytes);
    if (status || bytes == 0 || bytes > (size_t)MAX_LINES * MAX_NAME)
        return complain(log, "cannot read attribute", what, status);
    char *text = calloc(bytes + 1, 1);
    if (!text) return complain(log, "out of memory for", what, 0);
    status = nc_get_att_text(source->nc, NC_GLOBAL, what, text);
    const int result = status ? complain(log, "cannot read attribute", what, status)
                              : split_names(text, what, names, found, log);
    free(text);
    return result;
}

/* Is a global attribute this word? */
static bool attribute_is(const Source *source, const char *name, const char *word) {
    char text[32] = "";
    size_t length = 0;
    if (nc_inq_attlen(source->nc, NC_GLOBAL, name, &length) == NC_NOERR && length < sizeof text)
        nc_get_att_text(source->nc, NC_GLOBAL, name, text);
    return strcmp(text, word) == 0;
}

static bool first_step_is_static(const Source *source) {
    char name[7] = "";
    int id, rank = 0;
    const size_t start[2] = {0}, count[2] = {1, sizeof name};
    if (source->steps == 0 || nc_inq_varid(source->nc, "step_name", &id) != NC_NOERR) return false;
    if (nc_inq_varndims(source->nc, id, &rank) != NC_NOERR || rank != 2) return false;
    return nc_get_vara_text(source->nc, id, start, count, name) == NC_NOERR &&
           memcmp(name, "static", 7) == 0;
}

/* numbers of one variable of the obstacles, `columns` for each, into surface by surface */
static int read_surface_numbers(const Source *source, const char *name, size_t columns, size_t k,
                                double *value, FILE *log) {
    int id, rank = 0, dimension[2];
    size_t length[2] = {0, 0}, start[2] = {k, 0}, count[2] = {1, columns};
    int status = nc_inq_varid(source->nc, name, &id);
    if (!status) status = nc_inq_varndims(source->nc, id, &rank);
    if (status || rank != 1 + (columns > 1))
        return complain(log, "missing or misshapen variable", name, status);
    status = nc_inq_vardimid(source->nc, id, dimension);
    for (int d = 0; d < rank && !status; d++)
        status = nc_inq_dimlen(source->nc, dimension[d], &length[d]);
    if (status || length[0] != source->surfaces || (rank == 2 && length[1] != columns))
        return complain(log, "wrong shape of variable", name, status);
    status = nc_get_vara_double(source->nc, id, start, count, value);
    for (size_t i = 0; i < columns; i++) status = isfinite(value[i]) ? status : NC_ERANGE;
    return status ? complain(log, "cannot read variable", name, status) : 0;
}

/* A dimension without a line's name. */
static int read_length(const Source *source, const char *name, size_t *length, FILE *log) {
    int id, status = nc_inq_dimid(source->nc, name, &id);
    if (!status) status = nc_inq_dimlen(source->nc, id, length);
    if (status || *length == 0 || *length > MAX_SET)
        return complain(log, "missing or senseless dimension", name, status);
    return 0;
}

/* A variable (obstacle, rows, columns) of obstacle k, columns 0: (obstacle, rows). */
static int read_matrix(const Source *source, const char *name, size_t k, size_t rows,
                       size_t columns, double *value, FILE *log) {
    int id, rank = 0, dimension[3];
    size_t length[3] = {0}, start[3] = {k, 0, 0}, count[3] = {1, rows, columns};
    int status = nc_inq_varid(source->nc, name, &id);
    if (!status) status = nc_inq_varndims(source->nc, id, &rank);
    if (status || rank != 2 + (columns > 0))
        return complain(log, "missing or misshapen variable", name, status);
    status = nc_inq_vardimid(source->nc, id, dimension);
    for (int d = 0; d < rank && !status; d++)
        status = nc_inq_dimlen(source->nc, dimension[d], &length[d]);
    if (status || length[0] != source->surfaces || length[1] != rows || length[2] != columns)
        return complain(log, "wrong shape of variable", name, status);
    status = nc_get_vara_double(source->nc, id, start, count, value);
    for (size_t i = 0; i < rows * (columns ? columns : 1); i++)
        status = isfinite(value[i]) ? status : NC_ERANGE;
    return status ? complain(log, "cannot read variable", name, status) : 0;
}

/* The size of a set on file, padded with zeros: rows that cones take, and columns in use. */
static bool set_size(size_t rows, size_t unknowns, const double *cone, const double *a, size_t *m,
                     size_t *n) {
    for (*m = 0; *m < rows && cone[*m] > 0; *m += (size_t)cone[*m])
        if (!(cone[*m] == floor(cone[*m]) && cone[*m] <= (double)(rows - *m))) return false;
    for (size_t i = 0; i < rows; i++) {
        if (i >= *m && cone[i] != 0) return false;
        for (size_t j = 0; j < unknowns; j++)
            if (a[i * unknowns + j] != 0 && j >= *n) *n = j + 1;
    }
    return true;
}

static int fill_set(size_t rows, size_t unknowns, const double *all, const double origin[2],
                    Conic **out) {
    const double *cone = all, *b = all + rows, *a = b + rows, *map = a + rows * unknowns;
    size_t m = 0, n = 0;
    if (!set_size(rows, unknowns, cone, a, &m, &n)) return -1;
    Conic *set = *out = conic_create(2, n, m);
    if (!set) return -1;
    for (size_t i = 0; i < m; i += (size_t)cone[i]) set->cone[i] = (size_t)cone[i];
    for (size_t i = 0; i < m; i++) {
        set->b[i] = b[i];
        for (size_t j = 0; j < n; j++) set->a[i * n + j] = a[i * unknowns + j];
    }
    for (size_t k = 0; k < 2; k++) {
        set->origin[k] = origin[k];
        for (size_t j = 0; j < n; j++) set->map[k * n + j] = map[k * unknowns + j];
    }
    return conic_prepare(set) ? 0 : -1;
}

/* The friction set of obstacle k. */
static int read_set(const Source *source, size_t k, Conic **out, FILE *log) {
    size_t rows, unknowns;
    double origin[2];
    if (read_length(source, "set_row", &rows, log) ||
        read_length(source, "set_unknown", &unknowns, log))
        return -1;
    double *all = calloc((rows + 2) * (unknowns + 2), sizeof *all);
    if (!all) return complain(log, "out of memory for", "obstacle_friction_set_rows", 0);
    int bad = read_matrix(source, "obstacle_friction_set_origin", k, 2, 0, origin, log);
    bad |= read_matrix(source, "obstacle_friction_set_cone", k, rows, 0, all, log);
    bad |= read_matrix(source, "obstacle_friction_set_offset", k, rows, 0, all + rows, log);
    bad |=
        read_matrix(source, "obstacle_friction_set_rows", k, rows, unknowns, all + 2 * rows, log);
    bad |= read_matrix(source, "obstacle_friction_set_map", k, 2, unknowns,
                       all + (2 + unknowns) * rows, log);
    if (!bad && fill_set(rows, unknowns, all, origin, out))
        bad = complain(log, "no bounded set with points inside its cones in",
                       "obstacle_friction_set_rows and the like", 0);
    free(all);
    return bad;
}

static int read_surface(const Source *source, size_t k, Surface *out, FILE *log) {
    double kind, shape, radius, mu[2], point[3], axis[3], grain[3];
    int bad = read_surface_numbers(source, "obstacle_kind", 1, k, &kind, log) |
              read_surface_numbers(source, "obstacle_point", 3, k, point, log);
    bad |= read_surface_numbers(source, "obstacle_axis", 3, k, axis, log);
    bad |= read_surface_numbers(source, "obstacle_radius", 1, k, &radius, log);
    bad |= read_surface_numbers(source, "obstacle_friction_axial", 1, k, &mu[0], log);
    bad |= read_surface_numbers(source, "obstacle_friction_lateral", 1, k, &mu[1], log);
    bad |= read_surface_numbers(source, "obstacle_friction_shape", 1, k, &shape, log);
    if (bad | read_surface_numbers(source, "obstacle_friction_grain", 3, k, grain, log)) return -1;
    Real length = hypotl(hypotl(axis[0], axis[1]), axis[2]);
    if (!(kind >= 0 && kind < SURFACE_KINDS) || !(shape == 0 || shape == 1 || shape == 2) ||
        !(mu[0] >= 0 && mu[1] >= 0) || !(length > 0) || kind == SURFACE_FUNCTION ||
        (kind != SURFACE_PLANE && kind != SURFACE_GROUND && !(radius > 0)))
        return complain(log, "senseless obstacle in", "obstacle_kind and the like", 0);
    *out = (Surface){.kind = (int)kind, .box = shape == 1, .radius = radius, .mu = {mu[0], mu[1]}};
    for (int i = 0; i < 3; i++) {
        out->point[i] = point[i];
        out->axis[i] = axis[i] / length;
        out->grain[i] = grain[i];
    }
    if (shape_read(source->nc, k, out, log) || soft_read(source, k, out, log)) return -1;
    out->grained = grain[0] != 0 || grain[1] != 0 || grain[2] != 0;
    if (kind == SURFACE_MESH) out->side[0] = 1; /* until it is shifted */
    if (kind == SURFACE_MESH && !(out->mesh = mesh_read(source->nc, k, log))) return -1;
    if (kind == SURFACE_GROUND && !(out->ground = ground_read(source->nc, k, log))) return -1;
    return shape == 2 ? read_set(source, k, &out->set, log) : 0;
}

/* The obstacles; a file without the dimension has none. */
static int read_surfaces(Source *source, FILE *log) {
    int dimension;
    if (nc_inq_dimid(source->nc, "obstacle", &dimension) != NC_NOERR) return 0;
    int status = nc_inq_dimlen(source->nc, dimension, &source->surfaces);
    if (status || source->surfaces > MAX_SURFACES)
        return complain(log, "senseless dimension", "obstacle", status);
    source->surface = calloc(source->surfaces + 1, sizeof *source->surface);
    if (!source->surface) return complain(log, "out of memory for", "obstacle", 0);
    for (size_t k = 0; k < source->surfaces; k++)
        if (read_surface(source, k, &source->surface[k], log)) return -1;
    source->follows =
        source->surfaces > 1 || (source->surfaces == 1 && surface_follows(source->surface));
    return 0;
}

static int read_static(const Source *source, const char *line, const char *what, size_t length,
                       double *value, FILE *log);

/* The points; a file without the dimension has none. */
static int read_points(Source *source, FILE *log) {
    int dimension;
    size_t points;
    if (nc_inq_dimid(source->nc, "point", &dimension) != NC_NOERR) return 0;
    const int status = nc_inq_dimlen(source->nc, dimension, &points);
    if (status) return complain(log, "senseless dimension", "point", status);
    if (read_names(source, "points", &source->point_name, &source->points, log)) return -1;
    if (source->points != points)
        return complain(log, "as many names as the dimension says are not in", "points", 0);
    double *kind = calloc(points, sizeof *kind);
    source->point_weight = calloc(points, sizeof *source->point_weight);
    source->point_kind = calloc(points, sizeof *source->point_kind);
    int bad =
        !kind || !source->point_weight || !source->point_kind
            ? complain(log, "out of memory for", "points", 0)
            : read_static(source, "kind", "of_point", points, kind, log) ||
                  read_static(source, "weight", "of_point", points, source->point_weight, log);
    for (size_t k = 0; k < points && !bad; k++) {
        if ((kind[k] != POINT_HELD && kind[k] != POINT_FREE && kind[k] != POINT_KIND_ON_BODY) ||
            !isfinite(source->point_weight[k]))
            bad = complain(log, "senseless kind or weight of point", source->point_name[k], 0);
        else
            source->point_kind[k] = (int)kind[k];
    }
    free(kind);
    return bad ? -1 : 0;
}

int source_open(const char *path, Source *source, FILE *log) {
    *source = (Source){.nc = -1};
    int status = nc_open(path, NC_NOWRITE, &source->nc), dimension;
    if (status) {
        source->nc = -1;
        return complain(log, "cannot open", path, status);
    }
    status = nc_inq_dimid(source->nc, "step", &dimension);
    if (!status) status = nc_inq_dimlen(source->nc, dimension, &source->steps);
    if (status) return complain(log, "cannot read dimension", "step", status);
    status = nc_get_att_double(source->nc, NC_GLOBAL, "tolerance", &source->tolerance);
    if (status) return complain(log, "cannot read attribute", "tolerance", status);
    size_t numbers = 0;
    if (nc_inq_attlen(source->nc, NC_GLOBAL, "friction_policy", &numbers) != NC_NOERR &&
        nc_inq_attlen(source->nc, NC_GLOBAL, "friction", &numbers) == NC_NOERR)
        return complain(log, "names of an earlier version of capstan, run it again:", path, 0);
    status = nc_inq_attlen(source->nc, NC_GLOBAL, "gravity", &numbers);
    if (!status && numbers != 3) status = NC_EBADDIM;
    if (!status) status = nc_get_att_double(source->nc, NC_GLOBAL, "gravity", source->gravity);
    if (status) return complain(log, "cannot read attribute", "gravity", status);
    memset(source->origin, 0, sizeof source->origin);
    status = nc_inq_attlen(source->nc, NC_GLOBAL, "origin", &numbers);
    if (!status && numbers != 3) status = NC_EBADDIM;
    if (!status) status = nc_get_att_double(source->nc, NC_GLOBAL, "origin", source->origin);
    if (status && status != NC_ENOTATT)
        return complain(log, "cannot read attribute", "origin", status);
    source->consistent = attribute_is(source, "friction_policy", "consistent");
    source->touching_only = attribute_is(source, "contact_policy", "reference");
    source->has_static = first_step_is_static(source);
    if (read_surfaces(source, log) || places_open(source, log)) return -1;

    if (read_names(source, "lines", &source->line_name, &source->lines, log)) return -1;
    if (failures_open(source, log)) return -1;
    return read_points(source, log);
}

void source_close(Source *source) {
    for (size_t i = 0; i < source->lines; i++) free(source->line_name[i]);
    for (size_t i = 0; i < source->points; i++) free(source->point_name[i]);
    free(source->point_name);
    free(source->point_weight);
    free(source->point_kind);
    failures_close(source);
    free(source->line_name);
    if (source->surface)
        for (size_t k = 0; k < source->surfaces; k++) surface_free(&source->surface[k]);
    free(source->surface);
    places_close(source);
    if (source->line_name || source->nc >= 0) nc_close(source->nc);
    *source = (Source){.nc = -1};
}

/* Find variable <line>_<what> and compare its shape with `length` (rank entries, slowest first). */
static int find(const Source *source, const char *line, const char *what, size_t rank,
                const size_t *length, int *id, FILE *log) {
    char name[2 * MAX_NAME];
    snprintf(name, sizeof name, "%s_%s", line, what);
    int status = nc_inq_varid(source->nc, name, id), found_rank, dimension[MAX_RANK];
    if (status) return complain(log, "missing variable", name, status);
    status = nc_inq_varndims(source->nc, *id, &found_rank);
    if (status || (size_t)found_rank != rank)
        return complain(log, "wrong number of dimensions of", name, status);
    status = nc_inq_vardimid(source->nc, *id, dimension);
    if (status) return complain(log, "cannot read the dimensions of", name, status);
    for (size_t k = 0; k < rank; k++) {
        size_t found;
        status = nc_inq_dimlen(source->nc, dimension[k], &found);
        if (status || found != length[k])
            return complain(log, "wrong length of a dimension of", name, status);
    }
    return 0;
}

static int read_static(const Source *source, const char *line, const char *what, size_t length,
                       double *value, FILE *log) {
    int id;
    if (find(source, line, what, length ? 1 : 0, &length, &id, log)) return -1;
    int status = nc_get_var_double(source->nc, id, value);
    return status ? complain(log, "cannot read variable", what, status) : 0;
}

/* one step of a variable (step, rows, columns); rows or columns 0: that dimension is absent */
static int read_step(const Source *source, const char *line, const char *what, size_t step,
                     size_t rows, size_t columns, double *value, FILE *log) {
    size_t shape[MAX_RANK] = {source->steps}, start[MAX_RANK] = {step}, count[MAX_RANK] = {1},
           rank = 1;
    if (rows) {
        shape[rank] = count[rank] = rows;
        rank++;
    }
    if (columns) {
        shape[rank] = count[rank] = columns;
        rank++;
    }
    int id;
    if (find(source, line, what, rank, shape, &id, log)) return -1;
    int status = nc_get_vara_double(source->nc, id, start, count, value);
    return status ? complain(log, "cannot read variable", what, status) : 0;
}

static int read_dimension(const Source *source, const char *line, const char *what, size_t *length,
                          FILE *log) {
    char name[2 * MAX_NAME];
    snprintf(name, sizeof name, "%s_%s", line, what);
    int id, status = nc_inq_dimid(source->nc, name, &id);
    if (!status) status = nc_inq_dimlen(source->nc, id, length);
    if (status || *length == 0 || *length > MAX_NODES)
        return complain(log, "missing or senseless dimension", name, status);
    return 0;
}

/* The mean factor of the friction zones over half of each element beside a node, 1 outside of
 * them. */
static void mean_factors(Record *record, size_t zones, const double *from, const double *to,
                         const double *factor) {
    Real at = 0, length = 0;
    for (size_t i = 0; i < record->elements; i++) length += record->element_length[i];
    for (size_t j = 0; j < record->nodes; j++) {
        Real before = j > 0 ? record->element_length[j - 1] : 0,
             after = j < record->elements ? record->element_length[j] : 0;
        at += before;
        Real low = at - before / 2, high = at + after / 2, sum = high - low, most = 1;
        for (size_t k = 0; k < zones; k++) {
            Real common = fminl(high, to[k]) - fmaxl(low, from[k]);
            if (common > 0) {
                sum += (factor[k] - 1) * common;
                most = fmaxl(most, factor[k]);
            }
        }
        record->factor[j] = (double)(sum / (high - low));
        // abscissas are doubles up to the length; a handful of them make the mean
        record->factor_noise[j] = (double)(8 * 0x1p-53L * most * length / (high - low));
    }
}

static int read_zones(const Source *source, const char *line, Record *record, FILE *log) {
    char name[2 * MAX_NAME];
    size_t zones = 0;
    int id;
    snprintf(name, sizeof name, "%s_zone", line);
    if (nc_inq_dimid(source->nc, name, &id) != NC_NOERR) return 0;
    if (read_dimension(source, line, "zone", &zones, log)) return -1;
    double *all = calloc(3 * zones, sizeof *all), *from = all, *to = all + zones,
           *factor = all + 2 * zones;
    record->factor = calloc(record->nodes, sizeof(double));
    record->factor_noise = calloc(record->nodes, sizeof(double));
    if (!all || !record->factor || !record->factor_noise) {
        free(all);
        return complain(log, "out of memory for line", line, 0);
    }
    int bad = read_static(source, line, "zone_from", zones, from, log);
    bad |= read_static(source, line, "zone_to", zones, to, log);
    bad |= read_static(source, line, "zone_factor", zones, factor, log);
    for (size_t k = 0; k < zones && !bad; k++) {
        bool ordered = from[k] >= (k > 0 ? to[k - 1] : 0) && to[k] > from[k] && isfinite(to[k]);
        if (!ordered || !(factor[k] >= 0) || !isfinite(factor[k]))
            bad = complain(log, "senseless friction zones of line", line, 0);
    }
    if (!bad) mean_factors(record, zones, from, to, factor);
    free(all);
    return bad;
}

/* What differs along a line of sections, or with weights at its nodes. The mean compliance is that
 * of the elements, and what the nodes carry of mean weights is the line's length, but for what
 * lifts: a point weight p counts as |p| in the mean. */
static int read_sections(const Source *source, const char *line, Record *record, FILE *log) {
    char name[2 * MAX_NAME];
    int id;
    for (size_t i = 0; i < record->elements; i++)
        record->element_compliance[i] = record->compliance;
    record->least_compliance = record->largest_compliance = record->compliance;
    snprintf(name, sizeof name, "%s_node_weight_length", line);
    const bool winds = nc_inq_varid(source->nc, name, &id) == NC_NOERR;
    snprintf(name, sizeof name, "%s_weight_length", line);
    if (!winds && nc_inq_varid(source->nc, name, &id) != NC_NOERR) return 0;
    record->weight_length = calloc(record->nodes, sizeof(double));
    if (!record->weight_length) return complain(log, "out of memory for line", line, 0);
    if ((!winds &&
         read_static(source, line, "weight_length", record->nodes, record->weight_length, log)) ||
        read_static(source, line, "compliance_factor", record->elements, record->element_compliance,
                    log))
        return -1;
    double mean = 0, length = 0, carried = 0;
    for (size_t i = 0; i < record->elements; i++) {
        double *c = &record->element_compliance[i];
        if (!(*c > 0) || !isfinite(*c)) return complain(log, "senseless compliance of", line, 0);
        mean += record->element_length[i] * *c;
        length += record->element_length[i];
        *c *= record->compliance;
        if (i == 0 || *c < record->least_compliance) record->least_compliance = *c;
        if (i == 0 || *c > record->largest_compliance) record->largest_compliance = *c;
    }
    for (size_t j = 0; j < record->nodes; j++) carried += record->weight_length[j];
    if (!(fabs(mean - length) <= 1e-9 * length))
        return complain(log, "compliance_factor has another mean than 1 in line", line, 0);
    if (!(fabs(carried) <= length * (1 + 1e-9)))
        return complain(log, "weight_length is more than the length of line", line, 0);
    return 0;
}

/* The points at which the ends are; a file without points does not say. */
static int read_end_points(const Source *source, const char *line, Record *record, FILE *log) {
    double point[2] = {-1, -1};
    if (source->points > 0 && read_static(source, line, "end_point", 2, point, log)) return -1;
    for (int e = 0; e < 2; e++) {
        if (!(point[e] >= -1 && point[e] < (double)source->points))
            return complain(log, "unknown point at an end of line", line, 0);
        record->end_point[e] = record->given_point[e] = (int)point[e];
    }
    return 0;
}

int record_create(const Source *source, const char *line, Record *record, FILE *log) {
    *record = (Record){0};
    if (read_dimension(source, line, "node", &record->nodes, log)) return -1;
    if (read_dimension(source, line, "element", &record->elements, log)) return -1;
    if (record->nodes != record->elements + 1)
        return complain(log, "nodes are not elements + 1 in line", line, 0);

    record->contacts = mesh_contacts(source->nc, line, source->surfaces);
    size_t n = record->contacts * record->nodes + record->elements;
    Vector **vectors[] = {&record->reference,     &record->position, &record->load,
                          &record->normal,        &record->friction, &record->slip,
                          &record->segment_force, &record->motion};
    double **scalars[] = {&record->element_length, &record->gap,      &record->friction_bound,
                          &record->reaction,       &record->tension,  &record->mu,
                          &record->obstacle,       &record->share_of, &record->element_compliance};
    int missing = (record->turn = calloc(source->surfaces + 1, sizeof(double))) == NULL;
    for (size_t k = 0; k < sizeof vectors / sizeof *vectors; k++) {
        missing |= (*vectors[k] = calloc(n, sizeof(Vector))) == NULL;
    }
    for (size_t k = 0; k < sizeof scalars / sizeof *scalars; k++) {
        missing |= (*scalars[k] = calloc(n, sizeof(double))) == NULL;
    }
    if (missing) return complain(log, "out of memory for line", line, 0);
    if (read_static(source, line, "element_length", record->elements, record->element_length, log))
        return -1;
    if (read_static(source, line, "compliance", 0, &record->compliance, log)) return -1;
    static int (*const CREATE[])(const Source *, const char *, Record *,
                                 FILE *) = {read_sections,  elongation_read, read_end_points,
                                            failure_create, inertia_create,  damping_create,
                                            loads_create,   read_zones,      winches_create,
                                            soft_create,    sets_create};
    for (size_t k = 0; k < sizeof CREATE / sizeof *CREATE; k++)
        if (CREATE[k](source, line, record, log)) return -1;
    return 0;
}

void record_destroy(Record *record) {
    winches_destroy(record);
    sets_free(record);
    free(record->reference);
    free(record->position);
    free(record->load);
    free(record->normal);
    free(record->friction);
    free(record->segment_force);
    free(record->element_length);
    free(record->weight_length);
    free(record->breaking_load);
    free(record->break_at);
    elongation_free(record);
    damping_free(record);
    inertia_free(record);
    loads_free(record);
    free(record->gap);
    free(record->friction_bound);
    free(record->reaction);
    free(record->tension);
    free(record->slip);
    free(record->motion);
    free(record->share_of);
    free(record->turn);
    free(record->mu);
    free(record->obstacle);
    free(record->factor);
    free(record->factor_noise);
    *record = (Record){0};
}

/* numbers that stand alone in a step */
static int read_scalars(const Source *source, const char *line, size_t step, Record *record,
                        FILE *log) {
    double outcome, iterations, parts, kind[2];
    int bad = read_step(source, line, "outcome", step, 0, 0, &outcome, log);
    bad |= read_step(source, line, "iterations", step, 0, 0, &iterations, log);
    bad |= read_step(source, line, "substeps", step, 0, 0, &parts, log);
    bad |= read_step(source, line, "share", step, 0, 0, &record->share, log);
    if (record->breaking_load) {
        bad |= read_step(source, line, "utilisation", step, 0, 0, &record->utilisation, log);
        bad |= read_step(source, line, "utilisation_at", step, 0, 0, &record->utilisation_at, log);
    }
    bad |= read_step(source, line, "end_kind", step, 2, 0, kind, log);
    bad |= read_step(source, line, "end_held_position", step, 2, 3, record->held_position[0], log);
    bad |= read_step(source, line, "end_applied_force", step, 2, 3, record->applied_force[0], log);
    bad |= read_step(source, line, "end_force", step, 2, 3, record->end_force[0], log);
    bad |= read_step(source, line, "end_friction_force", step, 2, 3, record->end_friction_force[0],
                     log);
    bad |= read_step(source, line, "end_tension", step, 2, 0, record->end_tension, log);
    bad |= read_step(source, line, "dissipated", step, 0, 0, &record->dissipated, log);
    bad |= read_step(source, line, "unaccounted", step, 0, 0, &record->unaccounted, log);
    bad |= read_step(source, line, "proof", step, 3, 0, record->proof, log);
    bad |= read_step(source, line, "proof_length", step, 0, 0, &record->proof_length, log);
    bad |= read_step(source, line, "proof_force", step, 0, 0, &record->proof_force, log);
    bad |= read_step(source, line, "bend_turn", step, 0, 0, &record->bend_turn, log);
    bad |= read_step(source, line, "bend_friction", step, 0, 0, &record->bend_friction, log);
    bad |= read_step(source, line, "bend_at", step, 0, 0, &record->bend_at, log);
    static const char *const ENTRY[LEDGER_ENTRIES] = {"ledger_ends", "ledger_obstacles",
                                                      "ledger_elastic", "ledger_gravity",
                                                      "ledger_imbalance"};
    for (int k = 0; k < LEDGER_ENTRIES; k++)
        bad |= read_step(source, line, ENTRY[k], step, 0, 0, &record->ledger[k], log);
    for (int k = 0; k < RANGES; k++)
        bad |= read_step(source, line, RANGE_NAME[k], step, 2, 0, record->end_range[k], log);
    for (int k = 0; k < CLAIMS; k++)
        bad |= read_step(source, line, CLAIM_NAME[k], step, 0, 0, &record->claim[k], log);
    if (bad) return -1;

    if (!(outcome >= 0 && outcome < OUTCOMES))
        return complain(log, "unknown outcome in line", line, 0);
    if (!(parts >= 1 && parts < 1e9))
        return complain(log, "senseless number of substeps in line", line, 0);
    if (!(record->share > 0 && record->share <= 1))
        return complain(log, "senseless share of a step in line", line, 0);
    if (!(fabs(iterations) < 1e9))
        return complain(log, "senseless number of iterations in line", line, 0);
    for (int e = 0; e < 2; e++) {
        if (kind[e] != END_HELD && kind[e] != END_FREE)
            return complain(log, "unknown kind of end in line", line, 0);
        record->end_kind[e] = (int)kind[e];
    }
    record->outcome = (int)outcome;
    record->iterations = (int)iterations;
    record->substeps = (int)parts;
    return 0;
}

/* what belongs to the first contact of each node, or to the second */
static int read_contact(const Source *source, const char *line, size_t step, bool second,
                        Record *record, FILE *log) {
    static const char *const NAME[2][7] = {{"normal", "friction_force", "slip", "contact_gap",
                                            "friction_bound", "reaction", "obstacle"},
                                           {"normal_second", "friction_force_second", "slip_second",
                                            "contact_gap_second", "friction_bound_second",
                                            "reaction_second", "obstacle_second"}};
    size_t n = record->nodes, from = second ? n : 0, known = record->contacts > 1 ? 7 : 6;
    double *to[7] = {record->normal[from],   record->friction[from],        record->slip[from],
                     record->gap + from,     record->friction_bound + from, record->reaction + from,
                     record->obstacle + from};
    int bad = 0;
    for (size_t k = 0; k < known; k++)
        bad |= read_step(source, line, NAME[second][k], step, n, k < 3 ? 3 : 0, to[k], log);
    for (size_t c = from; c < from + n && !bad; c++)
        if (record->contacts > 1 && !mesh_is_index(record->obstacle[c], source->surfaces, second))
            bad = complain(log, "unknown obstacle in", NAME[second][6], 0);
    return bad;
}

/* contacts of elements: where an obstacle is round, or there are three, and all are reached */
static int read_elements(const Source *source, const char *line, size_t step, Record *record,
                         FILE *log) {
    static const char *const NAME[8] = {"element_normal",         "element_friction_force",
                                        "element_slip",           "element_contact_gap",
                                        "element_friction_bound", "element_reaction",
                                        "element_obstacle",       "element_share"};
    const size_t n = record->elements, from = record->contacts * record->nodes;
    double *to[8] = {record->normal[from],
                     record->friction[from],
                     record->slip[from],
                     record->gap + from,
                     record->friction_bound + from,
                     record->reaction + from,
                     record->obstacle + from,
                     record->share_of};
    int bad = 0;
    for (size_t k = 0; k < source->surfaces; k++)
        record->has_elements |=
            (surface_has_elements(&source->surface[k]) || source->surfaces > 2) &&
            !source->touching_only;
    if (record->has_elements)
        for (size_t k = 0; k < 8; k++)
            bad |= read_step(source, line, NAME[k], step, n, k < 3 ? 3 : 0, to[k], log);
    for (size_t i = from; i < from + n && !bad; i++) {
        const double obstacle = record->obstacle[i];
        if (!record->has_elements)
            record->obstacle[i] = -1;
        else if (!(obstacle >= -1 && obstacle < (double)source->surfaces &&
                   obstacle == floor(obstacle)))
            bad = complain(log, "unknown obstacle in", NAME[6], 0);
    }
    return bad;
}

/* Files from before there was such a proof have none. */
static int read_proof_obstacle(const Source *source, const char *line, const char *which,
                               size_t step, int *obstacle, FILE *log) {
    char name[512];
    double value;
    int id;
    *obstacle = -1;
    snprintf(name, sizeof name, "%s_%s", line, which);
    if (nc_inq_varid(source->nc, name, &id) != NC_NOERR) return 0;
    if (read_step(source, line, which, step, 0, 0, &value, log)) return -1;
    if (!(value >= -1 && value < (double)source->surfaces))
        return complain(log, "unknown obstacle of the proof in line", line, 0);
    *obstacle = (int)value;
    return 0;
}

static int read_motion(const Source *source, const char *line, size_t step, Record *record,
                       FILE *log) {
    char name[2 * MAX_NAME];
    int id;
    snprintf(name, sizeof name, "%s_motion", line);
    if (nc_inq_varid(source->nc, name, &id) != NC_NOERR) return 0;
    return read_step(source, line, "motion", step, record->nodes, 3, record->motion[0], log);
}

/* Files from before gravity could change have none. */
static int read_weight_before(const Source *source, const char *line, size_t step, Record *record,
                              FILE *log) {
    char name[2 * MAX_NAME];
    int id;
    snprintf(name, sizeof name, "%s_weight_before", line);
    record->has_weight_before = nc_inq_varid(source->nc, name, &id) == NC_NOERR;
    return record->has_weight_before
               ? read_step(source, line, "weight_before", step, 3, 0, record->weight_before, log)
               : 0;
}

int record_read(const Source *source, const char *line, size_t step, Record *record, FILE *log) {
    winches_whole(record);
    size_t n = record->nodes, elements = record->elements;
    if (places_at(source, step, log)) return -1;
    int bad = read_step(source, line, "reference", step, n, 3, record->reference[0], log);
    bad |= read_step(source, line, "position", step, n, 3, record->position[0], log);
    bad |= read_step(source, line, "load", step, n, 3, record->load[0], log);
    for (size_t k = 0; k < record->contacts; k++)
        bad |= read_contact(source, line, step, k > 0, record, log);
    bad |= read_elements(source, line, step, record, log);
    if (source->surfaces > 0)
        bad |= read_step(source, "obstacle", "turn", step, source->surfaces, 0, record->turn, log);
    bad |=
        read_step(source, line, "segment_force", step, elements, 3, record->segment_force[0], log);
    bad |= read_step(source, line, "tension", step, elements, 0, record->tension, log);
    bad |= read_motion(source, line, step, record, log);
    bad |= read_proof_obstacle(source, line, "proof_obstacle", step, &record->proof_obstacle, log);
    bad |= read_proof_obstacle(source, line, "proof_plane", step, &record->proof_plane, log);
    bad |= read_weight_before(source, line, step, record, log);
    bad |= grasps_read(source, line, step, record, log);
    bad |= failure_read(source, line, step, record, log);
    bad |= loads_read(source, line, step, record, log);
    bad |= elongation_read_step(source, line, step, record, log);
    bad |= sets_read(source, line, step, record, log);
    bad |= inertia_read(source, line, step, record, log);
    bad |= damping_read(source, line, step, record, log);
    if (bad || read_scalars(source, line, step, record, log)) return -1;
    return winches_read(source, line, step, record, log);
}

/* `columns` numbers of each point; 0: one. */
static int read_of_points(const Source *source, const char *what, size_t step, size_t columns,
                          double *value, FILE *log) {
    const size_t count = source->points * (columns ? columns : 1);
    int bad = read_step(source, what, "of_point", step, source->points, columns, value, log);
    for (size_t i = 0; i < count && !bad; i++)
        if (!isfinite(value[i]))
            bad = complain(log, "a value that cannot be (NaN, infinite), of points:", what, 0);
    return bad;
}

int junctions_read(const Source *source, size_t step, Junction *all, FILE *log) {
    enum { VECTORS = 8, NUMBERS = 5 };
    static const char *const VECTOR[VECTORS] = {"position", "lines",    "load", "support",
                                                "normal",   "friction", "slip", "residual"};
    static const char *const NUMBER[NUMBERS] = {"reaction", "dissipated", "state", "obstacle",
                                                "has_place"};
    const size_t n = source->points;
    Vector *vector = calloc(n * VECTORS, sizeof *vector);
    double *number = calloc(n * NUMBERS, sizeof *number);
    int bad = vector && number ? 0 : complain(log, "out of memory for", "points", 0);
    for (size_t i = 0; i < VECTORS && !bad; i++)
        bad = read_of_points(source, VECTOR[i], step, 3, vector[i * n], log);
    for (size_t i = 0; i < NUMBERS && !bad; i++)
        bad = read_of_points(source, NUMBER[i], step, 0, number + i * n, log);
    for (size_t k = 0; k < n && !bad; k++) {
        Junction *at = &all[k];
        double *to[VECTORS] = {at->position, at->lines,    at->load, at->support,
                               at->normal,   at->friction, at->slip, at->residual};
        for (size_t i = 0; i < VECTORS; i++) memcpy(to[i], vector[i * n + k], sizeof(Vector));
        const double state = number[2 * n + k], obstacle = number[3 * n + k];
        if (!(state >= 0 && state < POINT_STATES) ||
            !(obstacle >= -1 && obstacle < (double)source->surfaces))
            bad = complain(log, "unknown state or obstacle of point", source->point_name[k], 0);
        at->reaction = number[k];
        at->dissipated = number[n + k];
        at->has_place = number[4 * n + k] != 0;
        if (bad) break;
        at->state = (int)state;
        at->obstacle = (int)obstacle;
    }
    free(vector);
    free(number);
    return bad;
}
