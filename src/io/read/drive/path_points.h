/* SPDX-License-Identifier: BSD-3-Clause */
/* Paths of driven systems as points. */
#ifndef CAPSTAN_SRC_IO_READ_DRIVE_PATH_POINTS_H
#define CAPSTAN_SRC_IO_READ_DRIVE_PATH_POINTS_H

#include "io/read/document.h"
#include "io/schema/tables/drive_keys.h"

/* The points of an arc of `sides` equal chords round a centre: x (sides + 1, 2). */
void cpsi_arc_points(const double start[2], const double centre[2], double degrees, int sides,
                     double *x);

/* A path that begins at `start`: a list of points, or (in the plane) {arc: {centre: .., angle:
 * ..}}, on which `steps` equal steps are taken exactly. */
CpsStatus cpsi_build_path(const CpsiDocument *d, const CpsiPathValues *values, int space,
                          const double *start, int steps, int *points, const double **path);

#endif
