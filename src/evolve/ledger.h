/* SPDX-License-Identifier: BSD-3-Clause */
/* The energy ledger of a line's step: energy supplied, stored and dissipated. */
#ifndef CAPSTAN_SRC_EVOLVE_LEDGER_H
#define CAPSTAN_SRC_EVOLVE_LEDGER_H

#include "cable/line.h"

/* The state at the start of a step that the ledger needs. */
typedef struct CpsiLedgerStart {
    double elastic, gravity; /* [J] */
    CpsEndReport end[2];
    bool all_known;
    bool settles;  /* the line moved (settling.h): forces do their work at their values after */
    double pushed; /* [J] work that the reactions at the start do as obstacles are shifted */
    bool known[2]; /* is the force at this end known? */
    CpsEndReport grasp[CPS_MAX_GRASPS];
    double pull[2];             /* [N] of the line on the drum of a winch (cable/winch.h) */
    double stored[2], hangs[2]; /* [m] on the drum: natural length, and that of the weight */
} CpsiLedgerStart;

/* Before a step, with the ends imposed then. The force of a free end is given; that of a held end
 * is known if `known`, from the report of the preceding equilibrium. Neither counts where the line
 * moved. */
CpsiLedgerStart cpsi_ledger_start(const CpsiLine *line, const CpsEnd end[2], bool known);

/* After the step; the work of each end is written to the report of that end, and what a line that
 * moved loses beside its kinetic energy to its inertia. */
CpsLedger cpsi_ledger_close(CpsiLine *line, const CpsiLedgerStart *start);

/* [J] Dissipated plus positive work: the work of the ends, of winches and of obstacles that turn,
 * and stored energy released, each where it is positive. */
double cpsi_ledger_exchanged(const CpsLedger *ledger);

/* sum += part */
void cpsi_ledger_add(CpsLedger *sum, const CpsLedger *part);

#endif
