/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/winch.h: winches, which pay out a line and haul it in. A winch is where a held end of a
 * line is, also one at a point or on a body (scene.h). `length` and elements of such a line are
 * those of the whole of it; what is `stored` on the drum is not there yet. A stage or a move pays
 * out.
 *
 *     line.length = 120;                                     the whole line
 *     line.winch[CPS_END_B] = (CpsWinch){.is_there = true, .stored = 20};
 *
 *     CpsPayOut in = {.line = 0, .end = CPS_END_B, .length = -5};       hauls in 5 m
 *     CpsStage move = cps_stage_default();
 *     move.pay_out_count = 1;
 *     move.pay_out = &in;
 *
 * Nodes are points of the line. The mesh is a function of what is on the drums alone, so that line
 * paid out and hauled in again has the same mesh, bit for bit where the lengths are the same. Nodes
 * on a drum are where the end is; the elements between them carry nothing and weigh nothing. An
 * element that leaves a drum is as long as what is off it; one shorter than a thousandth of the
 * next is part of the next. What lies on an obstacle keeps its place and its friction; what comes
 * off a drum begins to slip where it leaves it (docs/theory.md). These are plain structs like those
 * of scene.h. */
#ifndef CAPSTAN_WINCH_H
#define CAPSTAN_WINCH_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A winch at an end of a line, which is held and stays so: it is neither let go nor loaded. The
 * line has no break_at, no start from nodes, and none of its nodes is grasped. */
typedef struct CpsWinch {
    bool is_there; /* default false */
    /* [m] natural length on the drum when the history begins, >= 0; default 0. At least a tenth of
     * the line's shortest element is off the drums at any time. */
    double stored;
} CpsWinch;

/* What a stage pays out at an end, evenly over its steps. */
typedef struct CpsPayOut {
    int line;      /* index in the scene */
    int end;       /* CPS_END_A or CPS_END_B, with a winch */
    double length; /* [m] natural length; negative: it hauls in */
} CpsPayOut;

/* A winch after the last step. */
typedef struct CpsWinchReport {
    double stored; /* [m] natural length on the drum */
    double paid;   /* [m] natural length of the line that is off its drums */
    bool is_there; /* otherwise all else is 0 */
    int node;      /* at which the line leaves the drum: those beyond are on it */
    /* [N] what the winch does work with: the pull of the line on the drum, T (1 + T/(2 EA)) of an
     * elastic one, at the drum */
    double pull;
    /* (element_count) [m] natural lengths of the elements of the whole line; else NULL. The array
     * belongs to the evolution */
    const double *length;
} CpsWinchReport;

struct CpsEvolution;
/* The winch of an end; of what is no winch a report of zeros. */
CPS_API CpsWinchReport cps_evolution_winch_report(const struct CpsEvolution *evolution, int line,
                                                  int end);

#ifdef __cplusplus
}
#endif
#endif
