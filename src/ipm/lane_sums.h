/* SPDX-License-Identifier: BSD-3-Clause */
/* The sums of a pass over elements (program.h), kept apart for each lane until the pass ends: eight
 * sums grow side by side, whatever the width of the registers. */
#ifndef CAPSTAN_SRC_IPM_LANE_SUMS_H
#define CAPSTAN_SRC_IPM_LANE_SUMS_H

#include "base/lanes.h"
#include "ipm/program.h"

/* As in CpsiSums; a pass leaves at 0 what it has none of. */
typedef struct CpsiLaneSums {
    CpsiLane weight, sz, residual, scale, bound, largest, ray, ray_cost;
} CpsiLaneSums;

static inline double cpsi_lanes_sum(const CpsiLane x) {
    double sum = 0;
    CPSI_FOR_LANES(l) sum += x[l];
    return sum;
}

static inline void cpsi_lane_sums_add(CpsiSums *sums, const CpsiLaneSums *lanes) {
    sums->weight += cpsi_lanes_sum(lanes->weight);
    sums->sz += cpsi_lanes_sum(lanes->sz);
    sums->scale += cpsi_lanes_sum(lanes->scale);
    sums->bound += cpsi_lanes_sum(lanes->bound);
    sums->ray += cpsi_lanes_sum(lanes->ray);
    sums->ray_cost += cpsi_lanes_sum(lanes->ray_cost);
    sums->residual = cpsi_lanes_largest(sums->residual, lanes->residual);
    CPSI_FOR_LANES(l)
    if (lanes->largest[l] > sums->largest) sums->largest = lanes->largest[l];
}

#endif
