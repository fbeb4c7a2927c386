/* SPDX-License-Identifier: BSD-3-Clause */
/* What the forms of grids share: words of a text with their places, and points that make a grid. */
#ifndef CAPSTAN_SRC_IO_READ_SHAPES_GROUND_GRID_PARTS_H
#define CAPSTAN_SRC_IO_READ_SHAPES_GROUND_GRID_PARTS_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/base.h"
#include "io/base/yaml/pool.h"

/* The points of a grid, x and y increasing; z as it is in the file. */
typedef struct CpsiGridFile {
    int x_count, y_count;
    double *x, *y;                         /* (x_count), (y_count) [m] */
    double *z;                             /* (y_count, x_count) */
    bool is_up, is_down, units_are_others; /* what a netCDF file says of z; not metres */
} CpsiGridFile;

/* A file that is read. */
typedef struct CpsiGridText {
    const char *path;
    const char *bytes; /* (size) and a zero byte */
    size_t size;
    CpsiPool *pool;
    CpsError *err;
    bool blanks_only; /* commas and semicolons do not separate words */
    /* of text: the word found, and where it begins */
    const char *at, *line_start;
    const char *word;
    size_t length;
    int line, column; /* from 1 */
} CpsiGridText;

/* The next word, between blanks, commas, semicolons and ends of lines, or between blanks and ends
 * of lines only; what follows # in a line is a comment. False: there is none. */
bool cpsi_grid_word(CpsiGridText *text);
/* Does the word differ from this one in capitals at most? */
bool cpsi_grid_is_word(const CpsiGridText *text, const char *word);
/* The number that the word is; false: it is none, or too large. */
bool cpsi_grid_is_number(const CpsiGridText *text, double *value);

/* The next word as a number, `what` in messages; as a count of 2 or more. */
CpsStatus cpsi_grid_number(CpsiGridText *text, const char *what, double *value);
CpsStatus cpsi_grid_count(CpsiGridText *text, const char *what, int *value);
/* `count` numbers that increase. */
CpsStatus cpsi_grid_axis(CpsiGridText *text, const char *what, int count, double *value);
/* Nothing may follow. */
CpsStatus cpsi_grid_end(CpsiGridText *text, const char *after);
/* A failure at the last word. */
CpsStatus cpsi_grid_fail(const CpsiGridText *text, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
CpsStatus cpsi_grid_no_memory(const CpsiGridText *text);

/* Memory for a grid of these counts, after the check that the file has bytes enough for as many
 * points, `least` each. */
CpsStatus cpsi_grid_allocate(const CpsiGridText *text, int x_count, int y_count, size_t least,
                             CpsiGridFile *out);

/* The index of a coordinate on an axis, -1: none. Coordinates that differ by less than 1e-9 of the
 * axis are one. */
int cpsi_grid_index(int count, const double *axis, double at);

CpsStatus cpsi_grid_read_esri(CpsiGridText *text, CpsiGridFile *out);
CpsStatus cpsi_grid_read_xyz(CpsiGridText *text, CpsiGridFile *out);
CpsStatus cpsi_grid_read_moordyn_c(CpsiGridText *text, CpsiGridFile *out);
CpsStatus cpsi_grid_read_moordyn_f(CpsiGridText *text, CpsiGridFile *out);
CpsStatus cpsi_grid_read_netcdf(CpsiGridText *text, const char *variable, CpsiGridFile *out);

#endif
