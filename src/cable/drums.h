/* SPDX-License-Identifier: BSD-3-Clause */
/* What winches have of a line on their drums (winch.h). Zeros: a line without winches. */
#ifndef CAPSTAN_SRC_CABLE_DRUMS_H
#define CAPSTAN_SRC_CABLE_DRUMS_H

#include <stdbool.h>

typedef struct CpsiDrums {
    bool on[2];       /* there is a winch at end A, B */
    double stored[2]; /* [m] natural length on its drum */
    double due[2];    /* [m] what is to be there at the end of this substep */
    int nodes[2];     /* nodes on it, without the one at which the line leaves it */
    double weight[2]; /* [m] natural length of the line's weight on it, with that of point masses */
    bool moved;       /* it winds in this substep */
    /* of a line with a winch, else NULL: the whole line, as if nothing were on a drum */
    double *length; /* (n - 1) [m] of the elements */
    double *place;  /* (n) [m] natural arc length of the nodes from the very beginning */
    double *hung;   /* (n) [m] length of the line's weight in point masses */
} CpsiDrums;

#endif
