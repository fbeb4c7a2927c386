/* SPDX-License-Identifier: BSD-3-Clause */
/* Warm steps: in a history a step resembles the one before. Its program is first solved by Newton's
 * method on the active set (chain/active_set.h), from the configuration extrapolated by the ratio
 * of the loads' increments; the interior-point loop is used where that does not converge, or its
 * answer is not certified (docs/theory.md 6b). */
#ifndef CAPSTAN_SRC_CABLE_WARM_STEP_H
#define CAPSTAN_SRC_CABLE_WARM_STEP_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "cable/step_program.h"
#include "ipm/ipm.h"

/* The guess from which a program is solved. */
typedef enum CpsiGuess {
    CPSI_GUESS_NONE,         /* the interior-point loop, from its own start */
    CPSI_GUESS_LATER,        /* the same; what follows starts from its solution */
    CPSI_GUESS_REFERENCE,    /* at rest at the reference */
    CPSI_GUESS_EXTRAPOLATED, /* the last move, from the reference */
    CPSI_GUESS_PREDICTED,    /* the same, where the base has been moved there */
    CPSI_GUESS_BASE          /* the solution of the last round, where the base is */
} CpsiGuess;

/* Does the method treat contact c, which has an obstacle? Not with boxes, and sets whose boundary
 * is not known; of elements not third contacts of nodes, those beside general sets, and those with
 * friction in the planes of the reference. */
bool cpsi_warm_step_treats(const CpsiLine *line, int c);

/* Before the step, whose loads and reference are still those of the last one: extrapolate the last
 * move to the new loads. The guess is kept in scratch memory of the program until it is solved.
 * The reference is the guess where they do not go on as they went. */
CpsiGuess cpsi_warm_step_guess(CpsiLine *line, CpsiChainProgram *program,
                               const CpsiStepOptions *options);

/* Within a step, whose last program the line holds: the next one from where the line is, with the
 * tensions that it has. The guess is kept likewise. */
CpsiGuess cpsi_warm_step_go_on(const CpsiLine *line, CpsiChainProgram *program,
                               const CpsiStepOptions *options);

/* Move the line to its extrapolated configuration, as if a round had ended there: the next one is
 * posed on the tangent planes at this place. */
void cpsi_warm_step_predict(CpsiLine *line, const CpsiChainProgram *program);

/* After a round: note where friction slips in its solution, for the guess of the next round. Of
 * slip and of what the force lacks of its bound, both without dimension, the larger one is not
 * zero. */
void cpsi_warm_step_note_round(CpsiLine *line, const CpsiChainProgram *program);

/* Let Newton's method (chain/active_set.h) start from a guess in the program of a round, which has
 * been written. */
void cpsi_warm_step_start(CpsiLine *line, CpsiChainProgram *program, const CpsiStepScale *scale,
                          CpsiGuess guess);

/* After a step that was solved from a guess: where Newton's method was of no use several times in a
 * row, the next 2, 6 or 14 steps begin without it, or 2 and 6 where it has been of use in the
 * history. It was of use if the step is certified and its first program was solved from the guess.
 */
void cpsi_warm_step_note(CpsiLine *line, bool certified);

#endif
