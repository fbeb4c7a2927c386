/* SPDX-License-Identifier: BSD-3-Clause */
/* A step's data copied from a view, and sampled on cells with one slope x' each.
 *
 * Cells are either the step's own elements or those of the external approximation S90 (47)-(48):
 * slopes u_1..u_N on (a_i - h/2, a_i + h/2), a_i = i h, and u = 0 before h/2, so that the first
 * cell begins at h/2 and the last is half as long. Positions belong to the ends of cells. The
 * step's loads and friction bounds per length are constant or linear between its nodes, and are
 * lumped again at the ends of the cells. */
#ifndef CAPSTAN_SRC_REGULARIZED_STEP_DATA_H
#define CAPSTAN_SRC_REGULARIZED_STEP_DATA_H

#include "base/arena.h"
#include "capstan/step.h"

/* Quantities lumped at m + 1 places, and of the m cells between them. */
typedef struct CpsiCells {
    int cells;         /* m */
    double *width;     /* (m) [m] */
    double *bend;      /* (m) [1/m] weight of |u_i - u_(i-1)|^2 in |x''|^2, u_0 = 0 */
    double *arc;       /* (m + 1) [m] */
    double *share;     /* (m + 1) [m] length of line lumped at the place */
    double *reference; /* (m + 1, 3) [m] */
    double *normal;    /* (m + 1, 3) */
    double *gap;       /* (m + 1) [m], INFINITY: no contact */
    double *bound;     /* (m + 1) [N] friction */
    double *factor;    /* (m + 1) [-] factor of the coefficient of friction, by zones */
    double *load;      /* (m + 1, 3) [N] */
    double *tension;   /* (m) [N] of the step's solution, at the middle of the cell */
    double *position;  /* (m + 1, 3) [m] of the step's solution */
} CpsiCells;

typedef struct CpsiStep {
    CpsiArena arena;
    CpsiCells own;       /* on the step's elements */
    double length;       /* [m] */
    double compliance;   /* [1/N] > 0 */
    double end_force[3]; /* [N] on end B where it is free */
    bool held;           /* end B is held, at the position reached */
    double energy;       /* [J] J** + j of the step's solution */
    /* [N] unit of force for tolerances: the largest of the tensions and the sums of loads */
    double force;
} CpsiStep;

/* Copy a view. Returns CPS_OK, CPS_ERR_ARGUMENT or CPS_ERR_MEMORY; the step is freed with
 * cpsi_arena_free(&step->arena). */
CpsStatus cpsi_step_copy(const CpsLineView *view, CpsiStep *step, CpsError *err);

/* Cells: the step's own elements, with arrays of the step, when cells is 0; else the external
 * approximation with that number, placed in an arena. As arena.h says it is called twice, and the
 * second call fills them. */
void cpsi_cells_place(CpsiCells *out, const CpsiStep *step, int cells, CpsiArena *arena);

/* [-] The friction factor of a place over that of its neighbour; 0 where that of the neighbour is
 * 0. */
double cpsi_zone_ratio(const CpsiCells *cells, int place, int next);

/* Value at abscissa `at` of a quantity given at the middles of cells with ends arc (cells + 1);
 * linear between the middles, constant beyond the outer ones. */
double cpsi_between_middles(int cells, const double *arc, const double *value, double at);

#endif
