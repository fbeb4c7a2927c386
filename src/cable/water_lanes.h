/* SPDX-License-Identifier: BSD-3-Clause */
/* The forces of the water on eight nodes of a line that moves, side by side in lanes (base/lanes.h,
 * moving_flow.h). */
#ifndef CAPSTAN_SRC_CABLE_WATER_LANES_H
#define CAPSTAN_SRC_CABLE_WATER_LANES_H

#include <stdbool.h>

#include "base/lanes.h"
#include "base/width.h"

/* Halves of elements: their direction, the water in the middle of the element, and the length. */
typedef struct CpsiHalfElements {
    CpsiLane t[3], velocity[3], acceleration[3], length;
} CpsiHalfElements;

/* Eight nodes: their velocities, and the halves before and behind them, of length 0 where there is
 * none. */
typedef struct CpsiNodesInWater {
    CpsiLane velocity[3];
    CpsiHalfElements half[2];
} CpsiNodesInWater;

/* Of an element per length: drag across and along, and water moved along across and along. */
typedef struct CpsiWaterShare {
    double across, along;             /* [kg/m2] */
    double moved_across, moved_along; /* [kg/m] */
    double displaced;                 /* [kg/m] */
    bool is_accelerated;              /* the water, as in waves */
} CpsiWaterShare;

/* What the water does to the nodes. */
typedef struct CpsiWaterForces {
    CpsiLane drag[3];  /* [N] */
    CpsiLane wave[3];  /* [N] of the water's own acceleration */
    CpsiLane slope[6]; /* [N s/m] C, what the drag loses with the velocity, as K of the field */
    CpsiLane mass[6];  /* [kg] A, of the water that is moved along */
} CpsiWaterForces;

typedef void CpsiWaterLoop(const CpsiNodesInWater *nodes, const CpsiWaterShare *share,
                           CpsiWaterForces *out);
extern CpsiWaterLoop cpsi_water_forces_128, cpsi_water_forces_256, cpsi_water_forces_512;
CpsiWaterLoop *cpsi_water_loop(CpsiWidth width);

#endif
