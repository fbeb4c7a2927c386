/* SPDX-License-Identifier: BSD-3-Clause */
/* What a step of a file is of a stage of its scene. */
#ifndef CAPSTAN_CHECKER_PART_H
#define CAPSTAN_CHECKER_PART_H

/* What a step is of a stage: of equal steps by its number, else by the times of the file. */
typedef struct Part {
    int stage, number; /* number: from 1 on */
    double from, to;   /* [-] shares of the stage before and after it; 1 after the last */
    double end;        /* [s] since the stage began */
    double noise;      /* [-] to which the shares are known; of equal steps 0 */
} Part;

#endif
