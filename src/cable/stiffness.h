/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of an end of a line after a step (capstan/stiffness.h; docs/theory.md 6c). */
#ifndef CAPSTAN_SRC_CABLE_STIFFNESS_H
#define CAPSTAN_SRC_CABLE_STIFFNESS_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "capstan/stiffness.h"
#include "chain/chain_program.h"

/* The stiffness of the ends of a line. */
typedef struct CpsiLineStiffness {
    CpsStiffnessOutcome outcome;
    /* (6, 6) [N/m] the forces on the line at its ends A and B by their places; all 0 unless found,
     * and in the rows and columns of an end that does not move */
    double matrix[36];
    bool has_smooth;
    double smooth[36];
} CpsiLineStiffness;

/* Of the ends that move; the other one stays, or keeps its force. `program`: scratch memory for the
 * line. */
CpsiLineStiffness cpsi_line_stiffness(const CpsiLine *line, CpsiChainProgram *program,
                                      const CpsiStepOptions *options, CpsStiffnessKind kind,
                                      const bool moves[2]);

/* A derivative of the forces on the line at its ends A and B by their places, (6, 6) [N/m], that of
 * the step where cpsi_line_stiffness would find it. Elsewhere what is not looked into there counts
 * as held, and so do loose nodes: for Newton's method on the places of the ends. All 0 where there
 * is none, and for a free end. */
void cpsi_line_tangent(const CpsiLine *line, CpsiChainProgram *program,
                       const CpsiStepOptions *options, double tangent[36]);

#endif
