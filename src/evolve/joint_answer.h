/* SPDX-License-Identifier: BSD-3-Clause */
/* The step of a group as one program, where the search for the places of its points fails, or for
 * the poses of bodies on inextensible lines. */
#ifndef CAPSTAN_SRC_EVOLVE_JOINT_ANSWER_H
#define CAPSTAN_SRC_EVOLVE_JOINT_ANSWER_H

#include "evolve/trial.h"

/* Is the group one of those that have such a program: without forces of a bounded size, without
 * grasped nodes, and on curved obstacles without frozen friction? With free bodies it is solved in
 * rounds, from the poses of the trial on. */
bool cpsi_may_have_joint_answer(const CpsiBalance *balance);
/* Take places and forces of all lines and points from the program of the first guess, solved to its
 * end (docs/theory.md 6d). Returns whether every line is certified there and the points are
 * balanced; the trial is that of this answer then, and otherwise as before. */
bool cpsi_take_joint_answer(CpsiBalance *balance);

#endif
