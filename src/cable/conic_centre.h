/* SPDX-License-Identifier: BSD-3-Clause */
/* The analytic centre of the conic form of a set: the minimum of -sum log det(A v + b), the log of
 * the number itself for a half-line, where A'z^-1 = 0 for z = A v + b. */
#ifndef CAPSTAN_SRC_CABLE_CONIC_CENTRE_H
#define CAPSTAN_SRC_CABLE_CONIC_CENTRE_H

#include "set/conic_form.h"

/* Write v (unknowns >= 1); *found is false where the form has no interior or its centre is not
 * reached. */
CpsStatus cpsi_conic_centre(const CpsiConicForm *form, double *v, bool *found, CpsError *err);

#endif
