/* SPDX-License-Identifier: BSD-3-Clause */
/* One time step of a line that is not in equilibrium and whose nodes move against a viscous
 * drag. */
#ifndef CAPSTAN_SRC_CABLE_DAMPED_STEP_H
#define CAPSTAN_SRC_CABLE_DAMPED_STEP_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "chain/chain_program.h"

/* The result of a damped step. */
typedef struct CpsiDampedStep {
    bool solved;    /* else the line has not moved, and its forces have no meaning */
    bool shortened; /* the line, its held ends too, moved only a part of its displacement because of
                       an obstacle */
    double distance; /* [m] the largest displacement of a node */
} CpsiDampedStep;

/* Take line->position as the reference, and move from there under line->end with a `drag` in units
 * of force and displacement per length of the line (step_program.h). Each contact acts in the
 * tangent plane and the axes of the reference, with friction bounded by its own reaction, and at
 * the end of the step the nodes that touch are moved onto the surfaces. States, slides and ends are
 * reported as those of a step, but nothing is certified: the forces are in balance only together
 * with the drag. */
CpsiDampedStep cpsi_line_damped_step(CpsiLine *line, CpsiChainProgram *program,
                                     const CpsiStepOptions *options, double drag);

#endif
