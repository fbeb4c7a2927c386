/* SPDX-License-Identifier: BSD-3-Clause */
/* One time step of a line that is not in equilibrium and whose nodes a viscous drag holds back. */
#ifndef CAPSTAN_SRC_CABLE_DAMPED_STEP_H
#define CAPSTAN_SRC_CABLE_DAMPED_STEP_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "chain/chain_program.h"

/* What a damped step did. */
typedef struct CpsiDampedStep {
    bool solved;     /* else the line is where it was, and the forces mean nothing */
    bool shortened;  /* an obstacle was in the way: the line, its held ends too, went only a part of
                        its way */
    double distance; /* [m] the longest that a node went */
} CpsiDampedStep;

/* Take line->position as the reference, and go from there under line->end with a
 * `drag` in units of force and displacement per length of the line (step_program.h). Each contact
 * acts in the tangent plane and the axes of the reference, with friction bounded by its own
 * reaction, and the line is laid onto the surfaces at the end of the step. States, slides and ends
 * are reported as those of a step, but nothing is certified: the forces balance together with the
 * drag. */
CpsiDampedStep cpsi_line_damped_step(CpsiLine *line, CpsiChainProgram *program,
                                     const CpsiStepOptions *options, double drag);

#endif
