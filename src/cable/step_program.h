/* SPDX-License-Identifier: BSD-3-Clause */
/* One step of a line as a program over a chain, and back: dimensionless, in the axes of the nodes,
 * measured from their base. */
#ifndef CAPSTAN_SRC_CABLE_STEP_PROGRAM_H
#define CAPSTAN_SRC_CABLE_STEP_PROGRAM_H

#include <stdbool.h>

#include "cable/line.h"
#include "chain/chain_program.h"

/* The friction bounds of a step. */
typedef enum CpsiBounds {
    CPSI_BOUNDS_FIXED,   /* those of the line stay */
    CPSI_BOUNDS_COUPLED, /* they follow the reactions: part of the program */
    CPSI_BOUNDS_TRIAL    /* as given, but wherever contact is possible: a round towards bounds that
                            follow */
} CpsiBounds;

typedef struct CpsiStepScale {
    double force;  /* [N] */
    double longer; /* the elements are this much longer than they are */
    CpsiBounds bounds;
    bool reaction_stiffness; /* the reactions turn with the normals */
    double drag; /* [-] times force and displacement, both per length of the line: what holds back a
                    line on its way */
} CpsiStepScale;

/* Write the step into the program. */
void cpsi_step_program_fill(const CpsiLine *line, CpsiChainProgram *program,
                            const CpsiStepScale *scale);

/* The pairs of a line on which no force acts, as if they had been solved for. */
void cpsi_step_program_clear(const CpsiLine *line, CpsiChainProgram *program);

/* Positions and forces of the solution in world axes and SI units. */
void cpsi_step_program_unpack(CpsiLine *line, const CpsiChainProgram *program,
                              const CpsiStepScale *scale);

#endif
