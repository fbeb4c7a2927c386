/* SPDX-License-Identifier: BSD-3-Clause */
/* A table of nodes beside the scene that names it: where a line starts, and the forces that go with
 * that. */
#ifndef CAPSTAN_SRC_IO_READ_NODE_FILE_H
#define CAPSTAN_SRC_IO_READ_NODE_FILE_H

#include "capstan/base.h"
#include "io/base/pool.h"

/* What the file has, one row per node from end A to end B; a column that it does not have is NULL.
 * What belongs to an element stands in the row of the node that it ends at. */
typedef struct CpsiNodeFile {
    int nodes;
    double *position;       /* (nodes, 3) [m] */
    double *arc_length;     /* (nodes) [m] natural, rising from 0 */
    double *tension;        /* (nodes - 1) [N] */
    double *reaction;       /* (nodes) [N] */
    double *friction_bound; /* (nodes) [N] */
} CpsiNodeFile;

/* Read the CSV file at `path`: a line of names, one of units if there is one, then the rows; empty
 * lines and those that begin with # are passed over. The calling thread's locale must have a
 * decimal point.
 *
 *   max_bytes  a larger file is refused
 *   pool       all arrays live there
 *
 * Returns CPS_OK, CPS_ERR_INPUT with line and column, CPS_ERR_IO, CPS_ERR_LIMIT or CPS_ERR_MEMORY.
 */
CpsStatus cpsi_node_file_read(const char *path, size_t max_bytes, CpsiPool *pool, CpsiNodeFile *out,
                              CpsError *err);

#endif
