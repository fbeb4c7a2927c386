/* SPDX-License-Identifier: BSD-3-Clause */
/* Conversion between one step of a line and a program over a chain: dimensionless, in the axes of
 * the nodes, displacements measured from the base. */
#ifndef CAPSTAN_SRC_CABLE_STEP_PROGRAM_H
#define CAPSTAN_SRC_CABLE_STEP_PROGRAM_H

#include <stdbool.h>

#include "cable/line.h"
#include "chain/chain_program.h"

/* The friction bounds of a step. */
typedef enum CpsiBounds {
    CPSI_BOUNDS_FIXED,   /* the bounds of the line, constant */
    CPSI_BOUNDS_COUPLED, /* mu R within the program */
    CPSI_BOUNDS_TRIAL    /* constant as FIXED, but at all possible contacts: a round towards coupled
                            bounds */
} CpsiBounds;

typedef struct CpsiStepScale {
    double length; /* [m] */
    double force;  /* [N] */
    double longer; /* factor of the elements' lengths */
    CpsiBounds bounds;
    bool reaction_stiffness; /* the reactions turn with the normals */
    double drag;             /* [-] viscous drag, in units of force and displacement per `length` */
    bool by_newton;          /* general sets are discs with a shape, where that is known */
} CpsiStepScale;

/* Write the step into the program. */
void cpsi_step_program_fill(const CpsiLine *line, CpsiChainProgram *program,
                            const CpsiStepScale *scale);

/* ... of which loads and field alone have changed. */
void cpsi_step_program_fill_loads(const CpsiLine *line, CpsiChainProgram *program,
                                  const CpsiStepScale *scale);

/* Set the pairs of the program to those of a line without forces. */
void cpsi_step_program_clear(const CpsiLine *line, CpsiChainProgram *program);

/* Write positions and forces of the solution to the line, in world axes and SI units. */
void cpsi_step_program_unpack(CpsiLine *line, const CpsiChainProgram *program,
                              const CpsiStepScale *scale);
/* ... positions alone. */
void cpsi_step_program_unpack_positions(CpsiLine *line, const CpsiChainProgram *program,
                                        const CpsiStepScale *scale);

#endif
