/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's method for the places about which the water is seen (moving_flow.h), with the
 * derivative of its forces by the directions of the elements. It is for the steps in which short
 * slack elements turn so fast that the places do not converge by themselves. */
#ifndef CAPSTAN_SRC_CABLE_TURNING_FLOW_H
#define CAPSTAN_SRC_CABLE_TURNING_FLOW_H

#include "cable/line.h"

/* The first start is where the nodes are expected, the second one where their inertia alone takes
 * them. Others have the chord of the shortest element in another direction and of another length.
 */
enum { CPSI_TURN_STARTS = 32 };

/* How far Newton's method is. */
typedef struct CpsiTurn {
    double lack; /* [N] of the last places from which a whole way began; INFINITY: there are none */
    double share; /* [-] of that way that is tried */
} CpsiTurn;

/* Is there an element whose ends are nearer to each other than half of its length? */
bool cpsi_line_has_short_element(const CpsiLine *line);

/* See the flow at the places of a start, 0 <= start < CPSI_TURN_STARTS, and write its forces about
 * them. */
void cpsi_line_begin_turn(CpsiLine *line, int start);
/* The program has been solved: choose the next places and do the same there. False: no share of the
 * way makes it better. */
bool cpsi_line_turn_on(CpsiLine *line, CpsiTurn *turn);

#endif
