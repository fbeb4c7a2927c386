/* SPDX-License-Identifier: BSD-3-Clause */
/* The forces that hold an inextensible line in a given configuration: a convex set, as a program
 * over the tensions of its elements.
 *
 * Positions and slips are given. The tension T_i of a taut element may vary, T_i >= 0, and so may
 * the reaction and the friction of each contact as far as the friction law permits. Balance at node
 * j then says that T_j t_j - T_j+1 t_j+1 - b_j is a sum of forces of its contacts: a condition on
 * two neighbouring tensions and, in a corner, on how the forces are shared between the contacts. So
 * the set is a chain of scalars (chain/scalar_program.h). Where balance at a node leaves no choice,
 * its two elements keep their tensions; where it fixes their ratio (a line that runs straight
 * through a free node, or slides round a post), both are one scalar.
 *
 * All unknowns are changes of the present forces of the line, which are in balance. */
#ifndef CAPSTAN_SRC_CABLE_FORCE_SET_H
#define CAPSTAN_SRC_CABLE_FORCE_SET_H

#include "cable/line.h"
#include "chain/scalar_program.h"

/* The law that the forces obey, and which of them may vary. */
typedef struct CpsiForceLaw {
    bool frozen; /* the bounds of friction are fixed, else mu R */
    bool frictionless;
    bool exact; /* segments are taut and contacts stick only where positions show it to rounding */
    bool directions; /* the recession cone of the set (its unbounded directions) in place of the set
                      */
    bool shares;     /* the tensions stay; only the forces of contacts in corners vary */
} CpsiForceLaw;

typedef struct CpsiForceSet {
    CpsiScalarProgram program;
    double force; /* [N] unit of the program's forces */
    bool partial; /* some forces stay as they are: those of general friction sets, of sets that hold
                     ends and of contacts of elements */
    double *tangent; /* (n, 3) of element e */
    double *tension; /* (n) [N] present p.t of element e */
    double *gain;    /* (n) of element e: its tension changes by gain y of its scalar */
    int *scalar;     /* (n) scalar of element e, -1: it keeps its tension */
    int *site;       /* (n) site of node j, -1: none */
    /* copies of the line's fields (cpsi_force_set_keep) */
    double *segment_force, *kept_tension, *reaction, *friction_force, *bound;
} CpsiForceSet;

/* Place the arrays for lines of at most n nodes. */
void cpsi_force_set_layout(CpsiForceSet *set, CpsiArena *arena, int n, int contacts);

/* Build the set for the line's fields; false where it has only one member. */
bool cpsi_force_set_build(CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law);

/* Solve the program; false where the loop does not converge. */
bool cpsi_force_set_solve(CpsiForceSet *set);

/* Write the solution to the line's fields. */
void cpsi_force_set_apply(CpsiForceSet *set, CpsiLine *line, const CpsiForceLaw *law);

/* The derivatives of the reaction of contact c by the own unknowns of its site; returns the site,
 * -1: it has none. */
int cpsi_force_set_share(const CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law,
                         int c, double share[CPSI_SITE_OWN]);

void cpsi_force_set_keep(CpsiForceSet *set, const CpsiLine *line);
void cpsi_force_set_restore(const CpsiForceSet *set, CpsiLine *line);

#endif
