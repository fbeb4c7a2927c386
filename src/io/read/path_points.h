/* SPDX-License-Identifier: BSD-3-Clause */
/* Paths of driven systems as points. */
#ifndef CAPSTAN_SRC_IO_READ_PATH_POINTS_H
#define CAPSTAN_SRC_IO_READ_PATH_POINTS_H

#include "io/read/document.h"
#include "io/schema/drive_keys.h"

/* A path from `start` on: a list of points, or (in the plane) {arc: {centre: .., angle: ..}}, which
 * `steps` equal steps then follow on the arc itself. */
CpsStatus cpsi_build_path(const CpsiDocument *d, const CpsiPathValues *values, int space,
                          const double *start, int steps, int *points, const double **path);

#endif
