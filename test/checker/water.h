/* SPDX-License-Identifier: BSD-3-Clause */
/* The surface of the water in a file, and what it does to points. */
#ifndef CAPSTAN_TEST_CHECKER_WATER_H
#define CAPSTAN_TEST_CHECKER_WATER_H

#include "record.h"

enum { WATER_NONE, WATER_SUBMERGED, WATER_FLOATING, WATER_ABOVE, WATER_STATES };

typedef struct Water {
    int state;
    double buoyancy, displaced; /* [N] */
    Vector direction;           /* by which the buoyancy is a force */
    double level;               /* [m] z of the surface */
    double waves;               /* [J] work of the surface as it rises, in time */
} Water;

/* Whether the file has a surface, and its z where places of the file are measured. */
bool water_surface(const Source *source, double *z);
/* [m] The heights of what floats, (points); 0 in files without a surface. */
int water_heights(const Source *source, double *height, FILE *log);
/* What the water does to all points, (points), after a step; nothing in files that do not say. */
int water_read(const Source *source, size_t step, Water *all, FILE *log);

#endif
