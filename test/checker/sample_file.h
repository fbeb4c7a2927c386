/* SPDX-License-Identifier: BSD-3-Clause */
/* The parts of which sample files are made: fields of a line, obstacles, and their writers. */
#ifndef CAPSTAN_CHECKER_SAMPLE_FILE_H
#define CAPSTAN_CHECKER_SAMPLE_FILE_H

#include <stddef.h>

enum { NODES = 5, ELEMENTS = 4, MAX_FIELDS = 80 };

/* The compliance of elastic lines, exact in binary. */
static const double C = 1.0 / 1024;

static const double ONES[ELEMENTS] = {1, 1, 1, 1};

/* A variable of one line: name, rank 1 or 2 within the step, values. */
typedef struct Field {
    const char *name;
    size_t rows, columns;
    double value[3 * NODES];
} Field;

/* An obstacle: kind, point, axis, radius, axial and lateral coefficients, and by how much it turns
 * in each step. */
typedef struct Bed {
    double kind, point[3], axis[3], radius, axial, lateral, turn;
    double shape, half[2]; /* shape 2: an ellipse of these half-axes, given as a set */
} Bed;

/* ---- fields ---- */

/* The least part of the scale that a line's loads and its largest force have, by its length. */
double least_scale(double force, double length);

/* Vectors along x (NULL: 0) with the same z. */
Field vectors(const char *name, size_t rows, const double *along_x, double z);

/* The same value in all rows but the first and the last. */
Field constant(const char *name, size_t rows, double value, double at_ends);

Field scalar(const char *name, double value);

/* A vector at each node (NULL: 0). Returns `field`. */
Field *of_nodes(Field *field, const char *name, const double *value);

/* What is imposed on the ends: 0 a position, 1 a force; the other of the two is missing. Returns
 * how many fields it has filled. */
size_t imposed(Field *field, const int kind[2], const double value[6]);
static const int HELD_FREE[2] = {0, 1};

/* Contacts of elements, none of which touches anything. Returns how many fields it has filled. */
size_t no_elements(Field *field);

/* ---- files; the results are 0 or a netCDF error ---- */

/* dims: step, xyz, end */
int begin_file(const char *path, const char *names, const char *policy, int *nc, int dims[3]);

/* A set is written of one bed alone. */
int write_beds(int nc, const int dims[3], const Bed *bed, size_t count);

/* Friction zones of a line: the part up to `middle` and the rest. */
int write_zones(int nc, const char *line, double middle, double length, const double factor[2]);

/* A line of four elements from its fields in two steps, first[] and second[]. */
int write_line(int nc, const int dims[3], const char *line, const double *lengths,
               double compliance, const Field *first, const Field *second, size_t count);

/* Two equal steps of one line with consistent friction on one obstacle. */
int write_alone(const char *path, const char *name, const Bed *bed, const double *length,
                double compliance, const Field *field, size_t count);

#endif
