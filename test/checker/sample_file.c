/* SPDX-License-Identifier: BSD-3-Clause */
/* Writer of the sample files: the layout of docs/results.md, reduced to what the checker reads. */
#include "sample_file.h"

#include <math.h>
#include <netcdf.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "sample.h"

static const double TOLERANCE = 1e-8;

/* ---- fields ---- */

double least_scale(double force, double length) { return 1e-12 / TOLERANCE * force * length; }

Field vectors(const char *name, size_t rows, const double *along_x, double z) {
    Field field = {name, rows, 3, {0}};
    for (size_t j = 0; j < rows; j++) {
        field.value[3 * j] = along_x ? along_x[j] : 0;
        field.value[3 * j + 2] = z;
    }
    return field;
}

Field constant(const char *name, size_t rows, double value, double at_ends) {
    Field field = {name, rows, 0, {0}};
    for (size_t j = 0; j < rows; j++) field.value[j] = j == 0 || j + 1 == rows ? at_ends : value;
    return field;
}

Field scalar(const char *name, double value) { return (Field){name, 0, 0, {value}}; }

size_t imposed(Field *field, const int kind[2], const double value[6]) {
    field[0] = (Field){"end_kind", 2, 0, {kind[0], kind[1]}};
    field[1] = (Field){"end_held_position", 2, 3, {0}};
    field[2] = (Field){"end_applied_force", 2, 3, {0}};
    for (int k = 0; k < 6; k++) {
        field[1 + kind[k / 3]].value[k] = value[k];
        field[2 - kind[k / 3]].value[k] = NAN;
    }
    return 3;
}

Field *of_nodes(Field *field, const char *name, const double *value) {
    *field = (Field){name, NODES, 3, {0}};
    if (value) memcpy(field->value, value, sizeof field->value);
    return field;
}

size_t no_elements(Field *field) {
    static const char *const NAME[] = {"element_normal", "element_friction_force", "element_slip"};
    static const struct {
        const char *name;
        double value;
    } OTHER[5] = {{"element_contact_gap", INFINITY},
                  {"element_friction_bound", 0},
                  {"element_reaction", 0},
                  {"element_obstacle", -1},
                  {"element_share", 0}};
    for (int k = 0; k < 3; k++) field[k] = (Field){NAME[k], ELEMENTS, 3, {0}};
    for (int k = 0; k < 5; k++) {
        field[3 + k] = (Field){OTHER[k].name, ELEMENTS, 0, {0}};
        for (int i = 0; i < ELEMENTS; i++) field[3 + k].value[i] = OTHER[k].value;
    }
    return 8;
}

/* ---- files ---- */

int write_line(int nc, const int dims[3], const char *line, const double *lengths,
               double compliance, const Field *first, const Field *second, size_t count) {
    char name[128];
    int node, element, id[MAX_FIELDS], length, soft, status = nc_redef(nc);
    (void)status; // a file just created is in define mode already
    snprintf(name, sizeof name, "%s_node", line);
    status = nc_def_dim(nc, name, NODES, &node);
    snprintf(name, sizeof name, "%s_element", line);
    if (!status) status = nc_def_dim(nc, name, ELEMENTS, &element);
    snprintf(name, sizeof name, "%s_element_length", line);
    if (!status) status = nc_def_var(nc, name, NC_DOUBLE, 1, &element, &length);
    snprintf(name, sizeof name, "%s_compliance", line);
    if (!status) status = nc_def_var(nc, name, NC_DOUBLE, 0, NULL, &soft);
    for (size_t k = 0; k < count && !status; k++) {
        size_t rows = first[k].rows;
        int row = rows == NODES ? node : rows == ELEMENTS ? element : rows == 2 ? dims[2] : dims[1];
        int dimension[3] = {dims[0], row, dims[1]}, rank = 1 + (rows > 0) + (first[k].columns > 0);
        snprintf(name, sizeof name, "%s_%s", line, first[k].name);
        status = nc_def_var(nc, name, NC_DOUBLE, rank, dimension, &id[k]);
    }
    if (!status) status = nc_enddef(nc);
    if (!status) status = nc_put_var_double(nc, length, lengths);
    if (!status) status = nc_put_var_double(nc, soft, &compliance);
    for (int again = 0; again < 2 && !status; again++) {
        const Field *field = again ? second : first;
        for (size_t k = 0; k < count && !status; k++) {
            size_t start[3] = {(size_t)again}, extent[3] = {1, field[k].rows, field[k].columns};
            status = nc_put_vara_double(nc, id[k], start, extent, field[k].value);
        }
    }
    return status;
}

/* {P v : (1, v) in the cone}, P = diag(half), with a row and an unknown more than it needs. */
static int write_set(int nc, int obstacle, const double half[2]) {
    const double none[2] = {0, 0}, map[6] = {half[0], 0, 0, 0, half[1], 0}, cone[4] = {3, 0, 0, 0};
    const double rows[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0}, offset[4] = {1, 0, 0, 0};
    const struct {
        const char *name;
        const double *value;
    } field[] = {{"obstacle_friction_set_origin", none},
                 {"obstacle_friction_set_map", map},
                 {"obstacle_friction_set_cone", cone},
                 {"obstacle_friction_set_rows", rows},
                 {"obstacle_friction_set_offset", offset}};
    int tangent, unknown, row, id[5], status = nc_redef(nc);
    if (!status) status = nc_def_dim(nc, "tangent", 2, &tangent);
    if (!status) status = nc_def_dim(nc, "set_unknown", 3, &unknown);
    if (!status) status = nc_def_dim(nc, "set_row", 4, &row);
    for (int k = 0; k < 5 && !status; k++) {
        const int shape[3] = {obstacle, k < 2 ? tangent : row, unknown};
        status = nc_def_var(nc, field[k].name, NC_DOUBLE, k == 1 || k == 3 ? 3 : 2, shape, &id[k]);
    }
    if (!status) status = nc_enddef(nc);
    for (int k = 0; k < 5 && !status; k++) status = nc_put_var_double(nc, id[k], field[k].value);
    return status;
}

int write_zones(int nc, const char *line, double middle, double length, const double factor[2]) {
    const double from[2] = {0, middle}, to[2] = {middle, length}, *value[3] = {from, to, factor};
    static const char *const NAME[] = {"from", "to", "factor"};
    char name[64];
    int zone, id[3], status = nc_redef(nc);
    snprintf(name, sizeof name, "%s_zone", line);
    if (!status) status = nc_def_dim(nc, name, 2, &zone);
    for (int k = 0; k < 3 && !status; k++) {
        snprintf(name, sizeof name, "%s_zone_%s", line, NAME[k]);
        status = nc_def_var(nc, name, NC_DOUBLE, 1, &zone, &id[k]);
    }
    if (!status) status = nc_enddef(nc);
    for (int k = 0; k < 3 && !status; k++) status = nc_put_var_double(nc, id[k], value[k]);
    return status;
}

static const char *const BED_NAME[] = {"kind",           "point",          "axis",
                                       "radius",         "friction_axial", "friction_lateral",
                                       "friction_shape", "friction_grain"};
enum { BED_NUMBERS = sizeof BED_NAME / sizeof *BED_NAME };

static int write_bed(int nc, const int id[BED_NUMBERS], int turn, size_t k, const Bed *bed) {
    const double none[3] = {0, 0, 0};
    const double *value[BED_NUMBERS] = {&bed->kind,  bed->point,    bed->axis,   &bed->radius,
                                        &bed->axial, &bed->lateral, &bed->shape, none};
    const size_t start[2] = {k, 0}, count[2] = {1, 3};
    int status = NC_NOERR;
    for (int i = 0; i < BED_NUMBERS && !status; i++)
        status = nc_put_vara_double(nc, id[i], start, count, value[i]);
    for (size_t step = 0; step < 2 && !status; step++)
        status = nc_put_var1_double(nc, turn, (size_t[]){step, k}, &bed->turn);
    return status;
}

int write_beds(int nc, const int dims[3], const Bed *bed, size_t count) {
    int obstacle, turn, id[BED_NUMBERS], status = nc_def_dim(nc, "obstacle", count, &obstacle);
    char name[64];
    const int shape[2] = {obstacle, dims[1]}, turned[2] = {dims[0], obstacle};
    for (int k = 0; k < BED_NUMBERS && !status; k++) {
        const bool vector = k == 1 || k == 2 || k == BED_NUMBERS - 1;
        snprintf(name, sizeof name, "obstacle_%s", BED_NAME[k]);
        status = nc_def_var(nc, name, NC_DOUBLE, 1 + vector, shape, &id[k]);
    }
    if (!status) status = nc_def_var(nc, "obstacle_turn", NC_DOUBLE, 2, turned, &turn);
    if (!status) status = nc_enddef(nc);
    for (size_t k = 0; k < count && !status; k++) status = write_bed(nc, id, turn, k, &bed[k]);
    return status || bed->shape != 2 ? status : write_set(nc, obstacle, bed->half);
}

int begin_file(const char *path, const char *names, const char *policy, int *nc, int dims[3]) {
    const double gravity[3] = {0, 0, -8};
    int status = nc_create(path, NC_CLOBBER | NC_64BIT_OFFSET, nc);
    if (status) return status;
    status = nc_def_dim(*nc, "step", NC_UNLIMITED, &dims[0]);
    if (!status) status = nc_def_dim(*nc, "xyz", 3, &dims[1]);
    if (!status) status = nc_def_dim(*nc, "end", 2, &dims[2]);
    if (!status) status = nc_put_att_text(*nc, NC_GLOBAL, "lines", strlen(names), names);
    if (!status)
        status = nc_put_att_text(*nc, NC_GLOBAL, "friction_policy", strlen(policy), policy);
    if (!status) status = nc_put_att_double(*nc, NC_GLOBAL, "tolerance", NC_DOUBLE, 1, &TOLERANCE);
    if (!status) status = nc_put_att_double(*nc, NC_GLOBAL, "gravity", NC_DOUBLE, 3, gravity);
    return status;
}

int write_alone(const char *path, const char *name, const Bed *bed, const double *length,
                double compliance, const Field *field, size_t count) {
    int nc, dims[3], status = begin_file(path, name, "consistent", &nc, dims);
    if (status) return status;
    status = write_beds(nc, dims, bed, 1);
    if (!status) status = write_line(nc, dims, name, length, compliance, field, field, count);
    int closed = nc_close(nc);
    return status ? status : closed;
}

int sample_poke(const char *path, const char *variable, size_t index, double value) {
    int nc, id, rank = 0, dimension[4], status = nc_open(path, NC_WRITE, &nc);
    if (status) return status;
    size_t at[4] = {0}, length[4] = {1, 1, 1, 1};
    status = nc_inq_varid(nc, variable, &id);
    if (status == NC_ENOTVAR) { /* a global attribute of numbers */
        size_t count = 0;
        double all[64];
        status = nc_inq_attlen(nc, NC_GLOBAL, variable, &count);
        if (!status && (count > 64 || index >= count)) status = NC_EINVAL;
        if (!status) status = nc_get_att_double(nc, NC_GLOBAL, variable, all);
        if (!status) {
            all[index] = value;
            status = nc_put_att_double(nc, NC_GLOBAL, variable, NC_DOUBLE, count, all);
        }
        const int shut = nc_close(nc);
        return status ? status : shut;
    }
    if (!status) status = nc_inq_varndims(nc, id, &rank);
    if (!status) status = nc_inq_vardimid(nc, id, dimension);
    for (int k = 0; k < rank && !status; k++) status = nc_inq_dimlen(nc, dimension[k], &length[k]);
    if (!status)
        for (int k = rank - 1; k >= 0; k--) {
            at[k] = index % length[k];
            index /= length[k];
        }
    if (!status) status = nc_put_var1_double(nc, id, at, &value);
    int closed = nc_close(nc);
    return status ? status : closed;
}
