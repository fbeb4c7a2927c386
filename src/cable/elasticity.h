/* SPDX-License-Identifier: BSD-3-Clause */
/* The elasticity of a line with a static and a dynamic stiffness (two_stiffnesses.h). */
#ifndef CAPSTAN_SRC_CABLE_ELASTICITY_H
#define CAPSTAN_SRC_CABLE_ELASTICITY_H

#include <stdbool.h>

/* How elements stretch, per natural length; springs as in line.h. */
typedef struct CpsiElasticity {
    double *compliance_factor; /* (n - 1) of the line's compliance as given */
    int spring_count;          /* 0: the arrays of springs are not read */
    int *spring_at, *spring_element;
    double *spring_start, *spring_stiffness;
} CpsiElasticity;

enum { CPSI_STATIC, CPSI_DYNAMIC };

/* While a stage lasts, the stiffness in force is that of a line whose elements have the length at
 * rest, l (1 + r): the arrays element_length, compliance_factor and spring_.. of the line. */
typedef struct CpsiTwoStiffnesses {
    bool exists;                  /* otherwise nothing else is read */
    bool is_dynamic;              /* which one is in force */
    bool has_jumped;              /* the forces before the step under way are those of the other */
    double *rest_strain;          /* (n - 1) r >= 0 [-]; 0 of the static one */
    CpsiElasticity elasticity[2]; /* static, dynamic */
} CpsiTwoStiffnesses;

#endif
