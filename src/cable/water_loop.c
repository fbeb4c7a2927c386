/* SPDX-License-Identifier: BSD-3-Clause */
/* The loop over nodes in water for each width of the processor's registers (water_lanes.h). */
#include "cable/water_lanes.h"

CpsiWaterLoop *cpsi_water_loop(CpsiWidth width) {
#ifdef CPSI_HAS_WIDTHS
    static CpsiWaterLoop *const loop[CPSI_WIDTHS] = {[CPSI_WIDTH_128] = cpsi_water_forces_128,
                                                     [CPSI_WIDTH_256] = cpsi_water_forces_256,
                                                     [CPSI_WIDTH_512] = cpsi_water_forces_512};
    return loop[width];
#else
    (void)width;
    return cpsi_water_forces_128;
#endif
}
