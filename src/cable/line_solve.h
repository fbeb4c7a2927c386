/* SPDX-License-Identifier: BSD-3-Clause */
/* One program of a step, from the place where the line is: its unit of force, its solution, and
 * whether that is an answer. */
#ifndef CAPSTAN_SRC_CABLE_LINE_SOLVE_H
#define CAPSTAN_SRC_CABLE_LINE_SOLVE_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "cable/step_program.h"
#include "ipm/ipm.h"

/* |distance - L| <= CPSI_TAUT L: an inextensible line is pulled straight, its tension has no upper
 * bound. */
#define CPSI_TAUT 1e-12
/* Consistent friction whose bounds do not agree with mu R to this, or whose loop stops short of it,
 * is solved again in rounds. */
#define CPSI_CLEAN 1e-11
/* The interior point is driven to this relative gap: what the arithmetic allows, well below any
 * tolerance asked. */
#define CPSI_TARGET 1e-13

/* What a step starts from: contact at the reference, and the loads: weight, half of each element to
 * each of its nodes, and the forces at free ends. */
void cpsi_line_set_reference(CpsiLine *line, const CpsiStepOptions *options);

bool cpsi_line_both_ends(const CpsiLine *line, CpsEndKind kind);
/* [m] */
double cpsi_line_end_distance(const CpsiLine *line);
bool cpsi_line_is_taut(const CpsiLine *line);
/* Is the line no farther away than a step can take it? */
bool cpsi_line_is_near(const CpsiLine *line);

/* The unit of force of a step [N], 0 where nothing asks for any. A line that was far tighter than
 * its loads and ends say is held by obstacles. Bounds that are tried can carry what they add up
 * to. */
double cpsi_line_unit_force(const CpsiLine *line, CpsiBounds bounds);

/* How one program of a step is posed and solved. */
typedef struct CpsiRound {
    CpsiBounds bounds;
    bool reaction_stiffness; /* reactions turn with their normals */
    bool centering;          /* the loop ends with steps to the centre */
    double drag;             /* [-] (step_program.h) */
    CpsiLeastMotion *least;  /* scratch memory of the rule of least motion, NULL: not applied */
} CpsiRound;

/* Solve once, from the base of the line, and move to the nearest of the places that go with the
 * forces. */
CpsiIpmReport cpsi_line_solve(CpsiLine *line, CpsiChainProgram *program,
                              const CpsiStepOptions *options, const CpsiRound *round);
bool cpsi_line_is_clean(const CpsiIpmReport *ipm);

/* What rounding leaves of the reaction of a node that is apart is none, nor is there friction,
 * whose axes nothing holds there, unless they are frozen. */
void cpsi_line_release_open_contacts(CpsiLine *line, const CpsiChainProgram *program);
/* The iterate of the loop as a certified answer, or what it is instead. */
CpsOutcome cpsi_line_outcome(const CpsiLine *line, const CpsiStepOptions *options,
                             const CpsiIpmReport *ipm);
/* Balance the forces, take the certificate, and judge what has been found. */
void cpsi_line_certify(CpsiLine *line, const CpsiStepOptions *options, const CpsiIpmReport *ipm);

#endif
