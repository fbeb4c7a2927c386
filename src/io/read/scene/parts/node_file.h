/* SPDX-License-Identifier: BSD-3-Clause */
/* A table of nodes beside the scene that names it: the initial configuration of a line, and the
 * forces in it. */
#ifndef CAPSTAN_SRC_IO_READ_SCENE_NODE_FILE_H
#define CAPSTAN_SRC_IO_READ_SCENE_NODE_FILE_H

#include "io/read/document.h"

/* The content of the file, one row per node from end A to end B; a missing column is NULL. The
 * value of an element is in the row of the node at its end. */
typedef struct CpsiNodeFile {
    int nodes;
    double *position;       /* (nodes, 3) [m] */
    double *arc_length;     /* (nodes) [m] natural, increasing from 0 */
    double *tension;        /* (nodes - 1) [N] */
    double *reaction;       /* (nodes) [N] */
    double *friction_bound; /* (nodes) [N] */
} CpsiNodeFile;

/* Read the CSV file `name` beside the document, which the text of `node` names (csv_table.h).
 *
 *   pool  memory of all arrays
 *
 * Returns CPS_OK, CPS_ERR_INPUT with line and column, CPS_ERR_IO, CPS_ERR_LIMIT or
 * CPS_ERR_MEMORY. */
CpsStatus cpsi_node_file_read(const CpsiDocument *d, const CpsiYaml *node, const char *name,
                              CpsiPool *pool, CpsiNodeFile *out);

#endif
