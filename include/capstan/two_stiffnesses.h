/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/two_stiffnesses.h: lines with a static and a dynamic stiffness (elasticity.h), as they
 * are now. */
#ifndef CAPSTAN_TWO_STIFFNESSES_H
#define CAPSTAN_TWO_STIFFNESSES_H

#include "capstan/evolve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How elements stretch, per natural length: T = d/(c f) + sum K (d - s)^+, with c the `compliance`
 * of the view and f the factor. */
typedef struct CpsElasticity {
    const double *compliance_factor; /* (element_count) [-] */
    int spring_count;
    const int *spring_element;                      /* (spring_count) not falling */
    const double *spring_strain, *spring_stiffness; /* (spring_count) s [-], K [N] */
} CpsElasticity;

/* Of a line where one of its sections has a dynamic stiffness; elements of the others stretch alike
 * by both. The law in force is T(d - rest_strain), d = |x'| - 1 per natural length. In the view of
 * such a line, element_length is the length at rest, natural length times 1 + rest_strain, and its
 * compliance and springs are those per that length. */
typedef struct CpsTwoStiffnesses {
    bool exists;                  /* otherwise all else is 0 */
    bool is_dynamic;              /* the dynamic stiffness is in force */
    const double *element_length; /* (element_count) [m] natural */
    const double *rest_strain;    /* (element_count) [-] >= 0; 0 where the static one is in force */
    CpsElasticity at_static, at_dynamic;
} CpsTwoStiffnesses;

/* The stiffnesses of a line, until the next step; a line that does not exist has none. */
CPS_API CpsTwoStiffnesses cps_evolution_two_stiffnesses(const CpsEvolution *evolution, int line);

#ifdef __cplusplus
}
#endif
#endif
