/* SPDX-License-Identifier: BSD-3-Clause */
/* What rounding of coordinates makes of a line that hardly bears anything. */
#ifndef CAPSTAN_CHECKER_ROUNDING_H
#define CAPSTAN_CHECKER_ROUNDING_H

#include "measure.h"
#include "record.h"

/* [J] of energy of strain, and [N] of tension. */
double strain_energy_of_rounding(const Record *r, const Measures *m);
/* [J] of the work of reactions on the gaps of their contacts. */
double contact_work_of_rounding(const Record *r, const Measures *m);
double tension_of_rounding(const Record *r, const Measures *m);

#endif
