/* SPDX-License-Identifier: BSD-3-Clause */
/* Writer of the sample file: the layout of docs/formats.md, reduced to what the checker reads. */
#include "sample.h"

#include <math.h>
#include <netcdf.h>
#include <stdio.h>
#include <string.h>

enum { NODES = 5, ELEMENTS = 4, MAX_FIELDS = 64 };

/* all lines have four elements of 1 m, weigh 8 N/m and lie along x on a bed with mu = 1/2 */
typedef struct SampleLine {
    const char *name;
    int outcome, end_kind[2];
    double compliance;
    double move[NODES], load[NODES], friction[NODES], segment[ELEMENTS], tension[ELEMENTS]; /* components along x */
    double end_b, proof, proof_value;
    double claim[12];
} SampleLine;

static const double C = 1.0 / 1024;

/* Drag by H = 10 N: bounds 4 N inside and 2 N at the tip take the tension from 8 N to 4 N to 0 over two elements,
 * which stretch by c T = 4 C and 8 C. Energies by hand; the second member is the largest load, sqrt(10^2 + 4^2). */
static void drag_claims(double *claim) {
    double tip = hypot(10, 4), primal = 40 * C + 40 * C - 10 * (4 + 12 * C);
    double scale = 12 + 80 * C + 40 * C + 8 + 16 + 8 * (3 + 4 * C) + tip * (4 + 12 * C);
    double values[12] = {primal, primal, 0, scale, 0, 0, 0, tip, 0, 0, 0, 0};
    memcpy(claim, values, sizeof values);
}

static void fill(SampleLine line[4]) {
    line[0] = (SampleLine){.name = "drag",
                           .end_kind = {0, 1},
                           .compliance = C,
                           .move = {0, 0, 0, 4 * C, 12 * C},
                           .load = {0, 0, 0, 0, 10},
                           .friction = {0, 0, -4, -4, -2},
                           .segment = {0, 0, 4, 8},
                           .tension = {0, 0, 4, 8},
                           .end_b = 10};
    drag_claims(line[0].claim);
    line[1] = (SampleLine){.name = "tight", .outcome = 1, .end_b = 4};
    line[2] = (SampleLine){.name = "far", .outcome = 5, .end_b = 4.5, .proof = 1, .proof_value = 0.5};
    line[3] = (SampleLine){.name = "loose",
                           .outcome = 4,
                           .end_kind = {1, 1},
                           .load = {0, 0, 0, 0, 17},
                           .proof = 1,
                           .proof_value = 1,
                           .end_b = 17};
}

/* variables of one line: name, rank 1 or 2 within the step, values */
typedef struct Field {
    const char *name;
    size_t rows, columns;
    double value[3 * NODES];
} Field;

static Field vectors(const char *name, size_t rows, const double *along_x, double z) {
    Field field = {name, rows, 3, {0}};
    for (size_t j = 0; j < rows; j++) field.value[3 * j] = along_x ? along_x[j] : 0, field.value[3 * j + 2] = z;
    return field;
}

static Field constant(const char *name, size_t rows, double value, double at_ends) {
    Field field = {name, rows, 0, {0}};
    for (size_t j = 0; j < rows; j++) field.value[j] = j == 0 || j + 1 == rows ? at_ends : value;
    return field;
}

static Field scalar(const char *name, double value) { return (Field){name, 0, 0, {value}}; }

/* the second step repeats the first from where that ended: nothing moves, friction stays and does no work */
static size_t describe(const SampleLine *line, int again, Field *field) {
    size_t n = 0;
    const double work = line->compliance > 0 ? 40 * C : 0;
    double reference[NODES], position[NODES], weight[NODES] = {-4, -8, -8, -8, -4};
    for (int j = 0; j < NODES; j++) position[j] = j + line->move[j], reference[j] = again ? position[j] : j;
    field[n++] = vectors("reference", NODES, reference, 0);
    field[n++] = vectors("position", NODES, position, 0);
    field[n] = vectors("load", NODES, line->load, 0);
    for (int j = 0; j < NODES; j++) field[n].value[3 * j + 2] = weight[j];
    n++;
    field[n++] = vectors("normal", NODES, NULL, 1);
    field[n++] = vectors("friction", NODES, line->friction, 0);
    field[n++] = vectors("segment_force", ELEMENTS, line->segment, 0);
    field[n++] = constant("contact_gap", NODES, 0, 0);
    field[n++] = constant("friction_bound", NODES, 4, 2);
    field[n++] = constant("reaction", NODES, 8, 4);
    field[n - 1].value[0] = line->end_kind[0] == 0 ? 0 : 4; // a held end needs no bed
    field[n - 1].value[NODES - 1] = line->end_kind[1] == 0 ? 0 : 4;
    field[n] = constant("tension", ELEMENTS, 0, 0);
    memcpy(field[n++].value, line->tension, sizeof line->tension);
    field[n++] = scalar("outcome", line->outcome);
    field[n++] = scalar("iterations", 1);
    field[n++] = (Field){"end_kind", 2, 0, {line->end_kind[0], line->end_kind[1]}};
    field[n++] = (Field){"end_value", 2, 3, {0, 0, 0, line->end_b, 0, 0}};
    field[n++] = scalar("dissipated", again ? 0 : work);
    field[n++] = (Field){"proof", 3, 0, {line->proof, 0, 0}};
    field[n++] = scalar("proof_value", line->proof_value);
    static const char *const CLAIM[] = {
        "primal",           "dual",           "gap",           "scale",        "tension_bound",
        "tension_estimate", "force_residual", "largest_force", "law_residual", "contact_residual",
        "stretch_residual", "penetration"};
    for (int k = 0; k < 12; k++) {
        int follows = k == 0 || k == 1 || k == 3; // primal, dual and scale
        field[n++] = scalar(CLAIM[k], line->claim[k] - (again && follows ? work : 0));
    }
    return n;
}

static int write_line(int nc, int step, int xyz, int end, const SampleLine *line) {
    Field field[MAX_FIELDS];
    size_t count = describe(line, 0, field);
    char name[128];
    int node, element, id[MAX_FIELDS], length, compliance, status = nc_redef(nc);
    (void)status; // a file just created is in define mode already
    snprintf(name, sizeof name, "%s_node", line->name);
    status = nc_def_dim(nc, name, NODES, &node);
    snprintf(name, sizeof name, "%s_element", line->name);
    if (!status) status = nc_def_dim(nc, name, ELEMENTS, &element);
    snprintf(name, sizeof name, "%s_element_length", line->name);
    if (!status) status = nc_def_var(nc, name, NC_DOUBLE, 1, &element, &length);
    snprintf(name, sizeof name, "%s_compliance", line->name);
    if (!status) status = nc_def_var(nc, name, NC_DOUBLE, 0, NULL, &compliance);
    for (size_t k = 0; k < count && !status; k++) {
        size_t rows = field[k].rows;
        int row = rows == NODES ? node : rows == ELEMENTS ? element : rows == 2 ? end : xyz;
        int dimension[3] = {step, row, xyz}, rank = 1 + (rows > 0) + (field[k].columns > 0);
        snprintf(name, sizeof name, "%s_%s", line->name, field[k].name);
        status = nc_def_var(nc, name, NC_DOUBLE, rank, dimension, &id[k]);
    }
    if (!status) status = nc_enddef(nc);
    const double ones[ELEMENTS] = {1, 1, 1, 1};
    if (!status) status = nc_put_var_double(nc, length, ones);
    if (!status) status = nc_put_var_double(nc, compliance, &line->compliance);
    for (int again = 0; again < 2 && !status; again++) {
        describe(line, again, field);
        for (size_t k = 0; k < count && !status; k++) {
            size_t start[3] = {(size_t)again}, extent[3] = {1, field[k].rows, field[k].columns};
            status = nc_put_vara_double(nc, id[k], start, extent, field[k].value);
        }
    }
    return status;
}

int sample_write(const char *path) {
    SampleLine line[4];
    fill(line);
    const char *names = "drag tight far loose";
    const double tolerance = 1e-8;
    int nc, step, xyz, end, status = nc_create(path, NC_CLOBBER | NC_64BIT_OFFSET, &nc);
    if (status) return status;
    status = nc_def_dim(nc, "step", NC_UNLIMITED, &step);
    if (!status) status = nc_def_dim(nc, "xyz", 3, &xyz);
    if (!status) status = nc_def_dim(nc, "end", 2, &end);
    if (!status) status = nc_put_att_text(nc, NC_GLOBAL, "lines", strlen(names), names);
    if (!status) status = nc_put_att_double(nc, NC_GLOBAL, "tolerance", NC_DOUBLE, 1, &tolerance);
    for (int i = 0; i < 4 && !status; i++) status = write_line(nc, step, xyz, end, &line[i]);
    int closed = nc_close(nc);
    return status ? status : closed;
}

int sample_poke(const char *path, const char *variable, size_t index, double value) {
    int nc, id, rank = 0, dimension[3], status = nc_open(path, NC_WRITE, &nc);
    if (status) return status;
    size_t at[3] = {0}, length[3] = {1, 1, 1};
    status = nc_inq_varid(nc, variable, &id);
    if (!status) status = nc_inq_varndims(nc, id, &rank);
    if (!status) status = nc_inq_vardimid(nc, id, dimension);
    for (int k = 0; k < rank && !status; k++) status = nc_inq_dimlen(nc, dimension[k], &length[k]);
    for (int k = rank - 1; k >= 0 && !status; k--) at[k] = index % length[k], index /= length[k];
    if (!status) status = nc_put_var1_double(nc, id, at, &value);
    int closed = nc_close(nc);
    return status ? status : closed;
}
