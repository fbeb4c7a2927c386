/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether an element of an inextensible line is too long to go round an obstacle. */
#ifndef CAPSTAN_CHECKER_LONG_ELEMENT_H
#define CAPSTAN_CHECKER_LONG_ELEMENT_H

#include "record.h"

/* What contradicts the claim that an element stays inside obstacle record->proof_obstacle wherever
 * its nodes are, or NULL; then *deep is by how much [m], beyond what elements may. */
const char *long_element_contradiction(const Source *source, const Record *record, double *deep);

#endif
