/* SPDX-License-Identifier: BSD-3-Clause */
/* To what the forces at a point balance that follow from the places of the nodes alone: those at
 * points of graphs, buoys and anchors. */
#ifndef CAPSTAN_PROPERTY_BALANCE_AT_POINTS_H
#define CAPSTAN_PROPERTY_BALANCE_AT_POINTS_H

/* What is left of the forces on a point, per largest force; points balance to 1e-6. The
 * tension of what rests slack on the bed is known to the strain RESTING times EA, as random_joined
 * finds it of single lines too, and any to what the line's certificate says of its strains and
 * tensions, which are to be known to STRAIN and TENSION. */
static const double LEFT = 2e-6, RESTING = 3e-8, STRAIN = 1e-7, TENSION = 1e-4;

#endif
