/* SPDX-License-Identifier: BSD-3-Clause */
/* The energy ledger of a line's step: what went in, what is stored, what was dissipated. */
#ifndef CAPSTAN_SRC_EVOLVE_LEDGER_H
#define CAPSTAN_SRC_EVOLVE_LEDGER_H

#include "cable/line.h"

/* What must be remembered of the start of a step. */
typedef struct CpsiLedgerStart {
    double elastic, gravity; /* [J] */
    CpsEndReport end[2];
    bool known[2]; /* is the force at this end known? */
} CpsiLedgerStart;

/* Before a step, with the ends as they are imposed then: a free end's force is what it is given;
 * that of a held end is known where `known`, from the report of the equilibrium before. */
CpsiLedgerStart cpsi_ledger_start(const CpsiLine *line, const CpsEnd end[2], bool known);

/* After it; the work of each end goes into the report of that end. */
CpsLedger cpsi_ledger_close(CpsiLine *line, const CpsiLedgerStart *start);

/* [J] Dissipated plus positive work: that of the ends and of obstacles that turn, and what was
 * stored and is released, each where it is positive. */
double cpsi_ledger_exchanged(const CpsLedger *ledger);

/* sum += part */
void cpsi_ledger_add(CpsLedger *sum, const CpsLedger *part);

#endif
