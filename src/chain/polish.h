/* SPDX-License-Identifier: BSD-3-Clause */
/* The last digits of a solution: from where the interior-point loop has reached its target,
 * Newton's method on the active set (active_set.h) goes on, in place of the loop's own refinements.
 */
#ifndef CAPSTAN_SRC_CHAIN_POLISH_H
#define CAPSTAN_SRC_CHAIN_POLISH_H

#include "chain/elements.h"
#include "ipm/ipm.h"

/* Memory for what the method writes before it has ended. */
typedef struct CpsiKept {
    double *u;       /* (n, 3) */
    double *points;  /* (n, 3) u of the points of elements; read only where there are some */
    double *e;       /* (n - 1, 3) */
    double *tension; /* (n - 1) */
} CpsiKept;

/* Does friction of disc d, or of friction conic k, slip in the solution of the loop? Of the slip,
 * times the stiffness of the elements beside it, and of what the force lacks of its bound, both
 * without dimension, the larger one is not zero. */
bool cpsi_chain_disc_slips(const CpsiChainProgram *program, int d);
bool cpsi_chain_conic_slips(const CpsiChainProgram *program, int k);

/* Solve the program from the solution of the loop that it holds, with a few linear systems.
 * disc.shape[disc.count + k] is the set of friction conic k, NULL: it is not known.
 *
 * Where it returns CPSI_IPM_SOLVED, the program holds what cpsi_chain_active_set leaves, with discs
 * in place of friction conics; else it is as it was, bit for bit, and the loop may go on. */
CpsiIpmReport cpsi_chain_polish(CpsiChainProgram *program, const CpsiKept *kept,
                                int max_iterations);

#endif
