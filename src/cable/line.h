/* SPDX-License-Identifier: BSD-3-Clause */
/* One line and its last step: the data that a step reads and the fields that it leaves. World axes, SI units. */
#ifndef CAPSTAN_SRC_CABLE_LINE_H
#define CAPSTAN_SRC_CABLE_LINE_H

#include <stdbool.h>

#include "base/arena.h"
#include "capstan/evolve.h"
#include "geometry/plane.h"

typedef struct CpsiLine {
    const char *name;
    int n;              /* nodes, elements + 1 */
    double length;      /* [m] natural */
    double compliance;  /* [1/N] 1/EA, 0: inextensible */
    double weight[3];   /* [N/m] per natural length */
    double friction;    /* [-] mu of the obstacle */
    bool has_obstacle;
    CpsiPlane plane;    /* its frame is used even without an obstacle */
    CpsEnd end[2];      /* imposed now */
    double *arc_length;      /* (n) [m] */
    double *element_length;  /* (n - 1) [m] element e joins nodes e and e + 1 */
    double *share;           /* (n) [m] natural length that a node stands for: half of its elements */
    /* the step */
    double *reference;      /* (n, 3) [m] */
    double *position;       /* (n, 3) [m] */
    double *load;           /* (n, 3) [N] */
    double *normal;         /* (n, 3) */
    double *gap;            /* (n) [m], INFINITY: no contact looked for */
    double *friction_bound; /* (n) [N] */
    double *friction_force; /* (n, 3) [N] */
    double *reaction;       /* (n) [N] */
    double *segment_force;  /* (n - 1, 3) [N] */
    double *tension;        /* (n - 1) [N] */
    unsigned char *state;   /* (n) CpsNodeState */
    CpsLineReport report;
} CpsiLine;

/* Place the arrays of a line of line->n nodes in the arena. */
void cpsi_line_layout(CpsiLine *line, CpsiArena *arena);

/* Fill arc length and shares from element_length. */
void cpsi_line_measure(CpsiLine *line);

/* The reaction at a start that is given as a shape: R = -(dT/da + w).n where it touches, T from its own strain (S90 section
 * 2 d 2). Sets reaction and state at `position`; `touch` [m] is how near counts as touching. */
void cpsi_line_start_reaction(CpsiLine *line, double touch);

#endif
