/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a grid of numbers over x and y from a file in one of several forms. */
#ifndef CAPSTAN_SRC_IO_READ_SHAPES_GROUND_GRID_FILE_H
#define CAPSTAN_SRC_IO_READ_SHAPES_GROUND_GRID_FILE_H

#include "io/read/shapes/ground/grid_parts.h"

typedef enum CpsiGridForm {
    CPSI_GRID_ESRI,      /* ESRI ASCII grid: header, rows from the north */
    CPSI_GRID_XYZ,       /* rows x y z, in any order, of all points of a grid */
    CPSI_GRID_NETCDF,    /* classic netCDF: a variable over y and x, which are variables as well */
    CPSI_GRID_MOORDYN_C, /* numbers of x and y, lists of both, rows x y z */
    CPSI_GRID_MOORDYN_F  /* nGridX, nGridY, list of x, rows of y with the depths there */
} CpsiGridForm;

/* Read the file at `path`; the arrays are in the pool. A message of an error has the path, and of a
 * file of text the line and column.
 *
 *   variable   its name in a netCDF file
 *   max_bytes  a larger file is refused
 *
 * Returns CPS_OK, CPS_ERR_INPUT, CPS_ERR_IO, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CpsStatus cpsi_grid_file_read(const char *path, CpsiGridForm form, const char *variable,
                              size_t max_bytes, CpsiPool *pool, CpsiGridFile *out, CpsError *err);

#endif
