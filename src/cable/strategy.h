/* SPDX-License-Identifier: BSD-3-Clause */
/* A way of solving a step. Which are tried, when and in which order, is the table STRATEGY of
 * line_step.c. */
#ifndef CAPSTAN_SRC_CABLE_STRATEGY_H
#define CAPSTAN_SRC_CABLE_STRATEGY_H

#include <stdbool.h>

#include "cable/warm_step.h"

typedef struct CpsiStrategy {
    unsigned when;     /* conditions (line_step.c) that must all hold for it to be of use */
    unsigned unless;   /* conditions of which none may hold */
    int rounds;        /* rounds on tangent planes, at most */
    int patience;      /* rounds without progress after which plain rounds end, and rounds with drag
                          change it; 0: rounds are not watched */
    bool acceleration; /* rounds are accelerated (anderson.h) */
    bool least_motion; /* where the forces leave a choice of places, the nearest is taken */
    bool centering;    /* the loop ends with steps to the centre (line_solve.h) */
    bool reaction_stiffness; /* reactions turn with their normals within a round: Newton's method */
    bool trial_bounds;       /* friction bounds are found from round to round instead of coupled */
    CpsiGuess
        guess; /* of the first round; later ones start from the one before. None: all are cold */
    bool keeps_tangents; /* tangents of isotropic friction are those along the line at the
                            reference, instead of following it */
    bool across;         /* the moves of the rounds may pass obstacles */
    bool drag;           /* a drag may hold the nodes back from round to round */
} CpsiStrategy;

#endif
