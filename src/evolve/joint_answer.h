/* SPDX-License-Identifier: BSD-3-Clause */
/* The step of a group as one program, where the search for the places of its points fails. */
#ifndef CAPSTAN_SRC_EVOLVE_JOINT_ANSWER_H
#define CAPSTAN_SRC_EVOLVE_JOINT_ANSWER_H

#include "evolve/trial.h"

/* Take places and forces of all lines and points from the program of the first guess, solved to its
 * end (docs/theory.md 6d). Returns whether every line is certified there and the points are
 * balanced; the trial is that of this answer then, and otherwise as before. For groups without free
 * bodies whose lines have axes of their own nowhere: no obstacle, or one plane. */
bool cpsi_take_joint_answer(CpsiBalance *balance);

#endif
