/* SPDX-License-Identifier: BSD-3-Clause */
/* One program of a step, from the base of the line: its unit of force, its solution, and the check
 * of the result. */
#ifndef CAPSTAN_SRC_CABLE_LINE_SOLVE_H
#define CAPSTAN_SRC_CABLE_LINE_SOLVE_H

#include "cable/held.h"
#include "cable/line.h"
#include "cable/step_options.h"
#include "cable/step_program.h"
#include "cable/warm_step.h"
#include "ipm/ipm.h"

/* Accuracy at which a program counts as solved, and bounds as equal to mu R; otherwise consistent
 * friction is solved again in rounds. */
#define CPSI_CLEAN 1e-11
/* The interior point is driven to this relative gap: the limit of the arithmetic, well below any
 * admissible tolerance. */
#define CPSI_TARGET 1e-13
/* Steps to the centre once the target is reached: each squares what is left of the angle between
 * the force of an element and the element. Steps after these towards smaller complementarity
 * products: each halves the spurious slip of a node at its limit, and takes two digits off what the
 * force of a slipping node lacks. */
enum { CPSI_CENTERING_STEPS = 2, CPSI_REFINEMENT_STEPS = 6 };
/* Up to this tolerance every program is solved to CPSI_TARGET and refined, so that nodes that stick
 * are told from nodes that slip: the default tolerance. */
#define CPSI_RESOLVING 1e-8

/* Set the data of a step: contacts at the reference, and the loads: weight, half of each element to
 * each of its nodes, and the forces at free ends. */
void cpsi_line_set_reference(CpsiLine *line, const CpsiStepOptions *options);
/* The loads of the nodes: weight, what is given, and the drag that was found last. */
void cpsi_line_set_loads(CpsiLine *line);

bool cpsi_line_both_ends(const CpsiLine *line, CpsEndKind kind);
/* Is a span between two held nodes taut? */
bool cpsi_line_is_taut(const CpsiLine *line);
/* Has no node moved farther than MAX_DISPLACEMENT line lengths? */
bool cpsi_line_is_near(const CpsiLine *line);

/* The unit of force of a step [N], 0 where no load and no end causes a force. Where the reference
 * tension is far above what loads and ends explain, obstacles hold the line and that tension is the
 * unit. The unit is at least the sum of trial bounds, which may balance as large a force. */
double cpsi_line_unit_force(const CpsiLine *line, CpsiBounds bounds);

/* The solution of a step together with other lines (network.h): the line's part of the program, its
 * units, and how it was solved. */
typedef struct CpsiJoined {
    const CpsiChainProgram *program;
    CpsiStepScale scale;
    CpsiIpmReport ipm;
    double shift[3]; /* [N] to be added to the force of every element */
    /* of a line with local axes: (n, 3) [m] the base on whose tangent planes the program is, and
     * (contacts) the obstacles there; else NULL */
    const double *base;
    const int *obstacle_index;
} CpsiJoined;

/* How one program of a step is posed and solved. */
typedef struct CpsiRound {
    CpsiBounds bounds;
    bool reaction_stiffness; /* reactions turn with their normals */
    bool centering;          /* the loop ends with steps to the centre */
    double drag;             /* [-] (step_program.h) */
    bool may_be_rough;       /* the loop may stop at a hundredth of the tolerance */
    double share;            /* [-] of its errors that Newton's method may leave (active_set.h) */
    CpsiGuess guess;         /* from which Newton's method starts before the interior point */
    CpsiLeastMotion *least;  /* scratch memory of the rule of least motion, NULL: not applied */
} CpsiRound;

/* Solve one program from the base of the line and, by the rule of least motion, move to the nearest
 * configuration that is compatible with its forces. */
CpsiIpmReport cpsi_line_solve(CpsiLine *line, CpsiChainProgram *program,
                              const CpsiStepOptions *options, const CpsiRound *round);
/* The program of a round that is solved from its guess by Newton's method and by nothing else: pose
 * it, false where that is not tried; and solve it as it is now, but for the share of the round. The
 * line takes its places alone. Where other forces of the flow are written into it then
 * (step_program.h), it is solved again from where it is. */
bool cpsi_line_pose_warm(CpsiLine *line, CpsiChainProgram *program, const CpsiRound *round,
                         CpsiStepScale *scale);
CpsiIpmReport cpsi_line_solve_posed(CpsiLine *line, CpsiChainProgram *program,
                                    const CpsiStepOptions *options, const CpsiRound *round,
                                    const CpsiStepScale *scale);
/* Place the nodes of inextensible spans on the straight lines between their ends, where these are
 * as far apart as the span is long, but for this share. */
void cpsi_line_straighten(CpsiLine *line, double share);
bool cpsi_line_is_clean(const CpsiIpmReport *ipm);

/* Set reactions of open contacts, which are rounding, to zero, and their friction too, unless
 * friction is frozen. */
void cpsi_line_release_open_contacts(CpsiLine *line, const CpsiChainProgram *program);
/* The outcome for the final iterate: certified, or why not. */
CpsOutcome cpsi_line_outcome(const CpsiLine *line, const CpsiStepOptions *options,
                             const CpsiIpmReport *ipm);
/* Balance the forces, compute the certificate, and set the outcome. */
void cpsi_line_certify(CpsiLine *line, const CpsiStepOptions *options, const CpsiIpmReport *ipm);

#endif
