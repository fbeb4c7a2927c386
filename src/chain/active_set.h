/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's method on the active set of a program over a chain: which elements are taut, which
 * contacts are closed, and where friction sticks or slips. From a guess near the solution, as there
 * is one in a history, it takes a few linear systems where the interior-point loop takes some
 * twenty (docs/theory.md 6b). */
#ifndef CAPSTAN_SRC_CHAIN_ACTIVE_SET_H
#define CAPSTAN_SRC_CHAIN_ACTIVE_SET_H

#include "chain/elements.h"
#include "ipm/ipm.h"

/* Solve the program from the guess that it holds:
 *
 *     base.u                  displacements; those of held nodes are given
 *     segment.s[i][1..3]      e at base.u
 *     segment.z[i][0]         tension; 0: the element is slack
 *     unilateral.z[k]         reaction; 0: the contact is open
 *     disc.s[k][0]            0: friction sticks
 *     disc.z[k][1..2]         friction per bound, of a general set; at a node with two closed
 *                             contacts, and of an element, friction per weight
 *
 * Where it returns CPSI_IPM_SOLVED, u and all pairs (s, z) are the solution, with complementary
 * parts that are exactly 0, and forces that balance to rounding. Otherwise the program holds
 * nothing of use and has to be written again: the method has not converged within a few steps, or
 * the program has something that it does not treat (friction conics, drag, contacts of elements
 * beside general sets or as third ones of nodes, second contacts alone or of general sets, elements
 * without tension that are free to move).
 * `left`: [-] the share that it may leave of the errors that it begins with; its
 * report has what it left. 0: it solves to rounding. Allocates nothing. */
CpsiIpmReport cpsi_chain_active_set(CpsiChainProgram *program, int max_iterations, bool polishes,
                                    double left);

#endif
