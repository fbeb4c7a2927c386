/* SPDX-License-Identifier: BSD-3-Clause */
/* The forces of the water on eight nodes (water_lanes.h), by the formulas of moving_flow.c,
 * compiled for each width of registers (base/width.h). */
#include "cable/water_lanes.h"

#include <string.h>

/* Slower than this [m/s] across, drag is none. */
static const double STILL = 1e-150;

/* m += a (I - q) + b q + c s s', q = t t'. */
CPSI_LANES_PART void add_directed(CpsiLane *m, int l, double a, double b, const double t[3],
                                  double c, const double s[3]) {
    const double x = (b - a) * t[0], y = (b - a) * t[1], z = (b - a) * t[2];
    const double u = c * s[0], v = c * s[1], w = c * s[2];
    m[0][l] += a + x * t[0] + u * s[0];
    m[1][l] += x * t[1] + u * s[1];
    m[2][l] += a + y * t[1] + v * s[1];
    m[3][l] += x * t[2] + u * s[2];
    m[4][l] += y * t[2] + v * s[2];
    m[5][l] += a + z * t[2] + w * s[2];
}

/* Drag of halves of elements, and the water that they move along. */
CPSI_LANES_FUNCTION void add_drag(const CpsiLane *restrict velocity,
                                  const CpsiHalfElements *restrict half,
                                  const CpsiWaterShare *restrict share,
                                  CpsiWaterForces *restrict out) {
    CPSI_FOR_LANES(l) {
        const double t[3] = {half->t[0][l], half->t[1][l], half->t[2][l]};
        double w[3], across[3];
        for (int a = 0; a < 3; a++) w[a] = half->velocity[a][l] - velocity[a][l];
        const double way = w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
        for (int a = 0; a < 3; a++) across[a] = w[a] - way * t[a];
        const double fast =
            sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
        const double length = half->length[l], normal = length * share->across * fast,
                     tangential = length * share->along * fabs(way);
        const double moves = fast > STILL ? fast : STILL;
        for (int a = 0; a < 3; a++) out->drag[a][l] += tangential * way * t[a] + normal * across[a];
        add_directed(out->slope, l, normal, 2 * tangential, t, length * share->across / moves,
                     across);
        add_directed(out->mass, l, length * share->moved_across, length * share->moved_along, t, 0,
                     across);
    }
}

/* The force of the water's own acceleration b, (M + A) b of each half. */
CPSI_LANES_FUNCTION void add_waves(const CpsiHalfElements *restrict half,
                                   const CpsiWaterShare *restrict share,
                                   CpsiWaterForces *restrict out) {
    const double across = share->displaced + share->moved_across,
                 more = share->moved_along - share->moved_across;
    CPSI_FOR_LANES(l) {
        const double along = half->t[0][l] * half->acceleration[0][l] +
                             half->t[1][l] * half->acceleration[1][l] +
                             half->t[2][l] * half->acceleration[2][l];
        for (int a = 0; a < 3; a++)
            out->wave[a][l] += half->length[l] *
                               (across * half->acceleration[a][l] + more * along * half->t[a][l]);
    }
}

void CPSI_WIDE(cpsi_water_forces)(const CpsiNodesInWater *nodes, const CpsiWaterShare *share,
                                  CpsiWaterForces *out) {
    memset(out, 0, sizeof *out);
    for (int side = 0; side < 2; side++) {
        add_drag(nodes->velocity, &nodes->half[side], share, out);
        if (share->is_accelerated) add_waves(&nodes->half[side], share, out);
    }
}
