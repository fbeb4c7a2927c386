/* SPDX-License-Identifier: BSD-3-Clause */
/* A bounded convex set of places given by an expression of set.h, prepared for steps: its conic
 * form, the constraint of a program that is made of it, and scratch memory, so that nothing of what
 * follows allocates. */
#ifndef CAPSTAN_SRC_CABLE_PLACE_FORM_H
#define CAPSTAN_SRC_CABLE_PLACE_FORM_H

#include "base/vec3.h"
#include "capstan/constraint.h"
#include "chain/elements.h"

typedef struct CpsiPlaceForm CpsiPlaceForm;

/* The set of a constraint of the kind CPS_CONSTRAINT_KIND_SET. What is wrong with it is said by a
 * predicate: "lies in R^2, expected R^3". The caller frees it. */
CpsStatus cpsi_place_form_make(const CpsConstraint *on, CpsiPlaceForm **out, CpsError *err);
void cpsi_place_form_free(CpsiPlaceForm *form);

const CpsiConicSet *cpsi_place_form_conic(const CpsiPlaceForm *form);
/* The constraint of a program: its solution stays until the next program. */
CpsiConicConstraint *cpsi_place_form_constraint(CpsiPlaceForm *form);
/* Fill it for a node of the program at `base` (3), with its axes (9) and a unit of length [m]. */
void cpsi_place_form_fill(CpsiPlaceForm *form, int node, Vec3 base, const double *axes,
                          double unit);
/* The place of the solution in the set, x in the program: where rounding leaves that outside, the
 * nearest one. */
Vec3 cpsi_place_form_place(CpsiPlaceForm *form, Vec3 x);

/* The nearest place of the set; NAN where that is not found. Writes to the scratch memory. */
Vec3 cpsi_place_form_nearest(CpsiPlaceForm *form, Vec3 x);
/* sup over y in the set of v.(y - x); NAN where that is not found. Writes to the scratch memory. */
double cpsi_place_form_gap(CpsiPlaceForm *form, Vec3 v, Vec3 x);

#endif
