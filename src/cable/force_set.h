/* SPDX-License-Identifier: BSD-3-Clause */
/* All forces that hold an inextensible line in a place: a convex set, as a program over the
 * tensions of its elements.
 *
 * Places and slips are given. A tension T_i of an element that is taut may vary, T_i >= 0; so may
 * the reaction and the friction of each contact within what the law leaves of them. Balance at node
 * j then says that T_j t_j - T_j+1 t_j+1 - b_j is a sum of forces of its contacts: a condition on
 * two neighbouring tensions and, in a corner, on how the forces are shared between the contacts. So
 * the set is a chain of scalars (chain/scalar_program.h). Where a node leaves no choice its two
 * elements keep what they have; where it leaves one ratio (a line that runs straight through a free
 * node, or slides round a post) they are one scalar.
 *
 * Everything is measured from the forces that the line has, which are in balance. */
#ifndef CAPSTAN_SRC_CABLE_FORCE_SET_H
#define CAPSTAN_SRC_CABLE_FORCE_SET_H

#include "cable/line.h"
#include "chain/scalar_program.h"

/* Which law the forces obey, and which of them are asked for. */
typedef struct CpsiForceLaw {
    bool frozen; /* the bounds of friction are given, else mu R */
    bool frictionless;
    bool tight;      /* taut and stuck only where the places say so to rounding */
    bool directions; /* the directions in which the set has no end, in place of the set */
    bool shares;     /* the tensions stay; only how corners share their forces */
} CpsiForceLaw;

typedef struct CpsiForceSet {
    CpsiScalarProgram program;
    double force;    /* [N] unit of the program's forces */
    bool partial;    /* friction sets given as such, and contacts of elements: their forces stay as
                        they are */
    double *tangent; /* (n, 3) of element e */
    double *tension; /* (n) [N] p.t of element e, as it is */
    double *gain;    /* (n) of element e: its tension changes by gain y of its scalar */
    int *scalar;     /* (n) that of element e, -1: it keeps its tension */
    int *site;       /* (n) that of node j, -1: none */
    /* the fields as they were (cpsi_force_set_keep) */
    double *segment_force, *kept_tension, *reaction, *friction, *bound;
} CpsiForceSet;

/* Room for lines of at most n nodes. */
void cpsi_force_set_layout(CpsiForceSet *set, CpsiArena *arena, int n, int contacts);

/* The set for the line's fields; false where there is nothing in it to choose. */
bool cpsi_force_set_build(CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law);

/* The loop on the program; false where it did not come near enough to an answer. */
bool cpsi_force_set_solve(CpsiForceSet *set);

/* The solution into the line's fields. */
void cpsi_force_set_apply(CpsiForceSet *set, CpsiLine *line, const CpsiForceLaw *law);

/* By how much the reaction of contact c changes with each of the own unknowns of its site; returns
 * the site, -1: it has none. */
int cpsi_force_set_share(const CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law,
                         int c, double share[CPSI_SITE_OWN]);

void cpsi_force_set_keep(CpsiForceSet *set, const CpsiLine *line);
void cpsi_force_set_restore(const CpsiForceSet *set, CpsiLine *line);

#endif
