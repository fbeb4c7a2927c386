/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether inextensible lines that meet at joints are too short to be laid between what holds them.
 *
 * A self-stress is a force p_k in each inextensible line, the same all along it, in balance at
 * every joint. Wherever the joints are, the sum of p_k.(X_B - X_A) over the lines is that of the
 * held ends alone, and a line of length l allows p.(X_B - X_A) <= |p| l. So
 *
 *     sum over held ends of p.X  -  sum |p_k| l_k  >  0
 *
 * proves that there are no places for the joints, with obstacles or without. */
#ifndef CAPSTAN_SRC_CABLE_SELF_STRESS_H
#define CAPSTAN_SRC_CABLE_SELF_STRESS_H

#include "cable/network.h"

/* Is there such a proof? Then out->pull[6 k + 3] (3) is the force of line k on what is at its end
 * B against the direction to it, of which the largest is 1, that at its end A the opposite, and
 * *missing [m] what the expression above says. Elastic lines, and those at free bodies, have none.
 * node[k] is the block of the matrix that joint k has; it is overwritten, and the matrix is left
 * with other blocks. The ends of lines are set as for a guess, whose program is overwritten. */
bool cpsi_network_is_too_short(CpsiNetwork *network, const CpsiLine *line,
                               const CpsiNetworkPart *part, int *node, const CpsiNetworkMove *out,
                               double *missing);

#endif
