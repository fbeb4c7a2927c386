/* SPDX-License-Identifier: BSD-3-Clause */
/* A step in which nothing moves. */
#ifndef CAPSTAN_SRC_CABLE_STANDSTILL_H
#define CAPSTAN_SRC_CABLE_STANDSTILL_H

#include "cable/line.h"
#include "cable/step_options.h"

/* At the reference: is the line in equilibrium where it is, with the forces that it has?  Then it
 * stays there and keeps them, for no motion is shorter than none. What `before` reports of the step
 * before holds for this one too, except that nothing slips. */
bool cpsi_line_stands_still(CpsiLine *line, const CpsiStepOptions *options,
                            const CpsLineReport *before);

#endif
