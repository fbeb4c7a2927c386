/* SPDX-License-Identifier: BSD-3-Clause */
/* A planar set of friction forces per unit normal force, any of set.h that is bounded and contains
 * 0, made ready for steps: its conic form, the centre of that, and room to ask for its support
 * without taking memory. */
#ifndef CAPSTAN_SRC_CABLE_FRICTION_SET_H
#define CAPSTAN_SRC_CABLE_FRICTION_SET_H

#include "capstan/set.h"
#include "chain/elements.h"

typedef struct CpsiFrictionSet CpsiFrictionSet;

/* Can the set be one of friction forces?  `name` is that of its obstacle. */
CpsStatus cpsi_friction_set_check(const CpsSet *set, const char *name, CpsError *err);

/* A set that passes the check; NULL for {0}, which is no friction. Its owner frees it. */
CpsStatus cpsi_friction_set_make(const CpsSet *set, const char *name, CpsiFrictionSet **out,
                                 CpsError *err);
void cpsi_friction_set_free(CpsiFrictionSet *set);

const CpsiConicSet *cpsi_friction_set_conic(const CpsiFrictionSet *set);

/* phi(u) = max -<u, F> over the set; to about 1e-13 of reach |u|, NaN where the small program
 * failed. Not for two threads at once. */
double cpsi_friction_set_phi(const CpsiFrictionSet *set, const double u[2]);

#endif
