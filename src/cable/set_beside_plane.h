/* SPDX-License-Identifier: BSD-3-Clause */
/* An end in a set of which a plane leaves a part only. */
#ifndef CAPSTAN_SRC_CABLE_SET_BESIDE_PLANE_H
#define CAPSTAN_SRC_CABLE_SET_BESIDE_PLANE_H

#include "cable/line.h"

/* A set that is farther from what holds the line next than this is long, on the free side of a
 * rigid plane. */
typedef struct CpsiBesidePlane {
    int plane;      /* index of the obstacle */
    Vec3 apart;     /* unit vector from what holds the line to the set */
    double missing; /* [m] */
} CpsiBesidePlane;

/* Is there an end whose set, where it is on the free side of a plane that stays where it is, an
 * inextensible line cannot reach? By more than `share` of the line's length; *found has the worst.
 */
bool cpsi_line_misses_beside_plane(const CpsiLine *line, double share, CpsiBesidePlane *found);

#endif
