/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/elasticity.h: how the tension of a line follows from its strain, by tables, and by two
 * stiffnesses of fibre rope.
 *
 * Ropes of polyester and other fibres have a static stiffness, which they show under a load that
 * changes slowly, and a larger dynamic one about the state reached so, which they show to storms
 * and tows (the static-dynamic model of mooring practice). With T_s and T_d the tensions by the two
 * tables, an element that the static stiffness has brought to the strain e_0 has
 *
 *     T(e) = T_d(e - r),    r = e_0 - phi_d(T_s(e_0)),    phi_d the inverse of T_d
 *
 * from then on: r is its rest strain, at which its tension would be 0. A line starts by the static
 * stiffness; stages of the history use the dynamic one about what was reached before them, unless
 * they say otherwise (CpsStage). */
#ifndef CAPSTAN_ELASTICITY_H
#define CAPSTAN_ELASTICITY_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A row of a table of strain and tension; a table has 2 to CPS_MAX_STIFFNESS_ROWS of them. The
 * first is 0, 0; strains and tensions rise, with slopes that do not fall. Beyond the last row its
 * slope goes on. */
enum { CPS_MAX_STIFFNESS_ROWS = 100 };
typedef struct CpsStiffnessRow {
    double strain;  /* [-] */
    double tension; /* [N] */
} CpsStiffnessRow;

/* A stiffness, as a number or a table. A dynamic one is nowhere softer than the static one: at no
 * tension has it the larger strain. */
typedef struct CpsDynamicStiffness {
    double stiffness; /* [N] EA > 0, finite; not read where there are rows */
    int row_count;    /* 0: none */
    const CpsStiffnessRow *row;
} CpsDynamicStiffness;

#ifdef __cplusplus
}
#endif
#endif
