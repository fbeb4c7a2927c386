/* SPDX-License-Identifier: BSD-3-Clause */
/* The elastic catenary in closed form, solved for its end force by Newton's method.
 *
 * Ends at (0, 0) and (x, z), natural length L, weight w per length, H and V the force at the upper
 * end. Hanging freely (V >= w L), with V_A = V - w L:
 *   x = (H/w) [asinh(V/H) - asinh(V_A/H)] + H L/EA
 *   z = (H/w) [sqrt(1 + (V/H)^2) - sqrt(1 + (V_A/H)^2)] + (V L - w L^2/2)/EA
 * with a part on a frictionless bed at the level of the lower end (V < w L), L_B = L - V/w:
 *   x = L_B + (H/w) asinh(V/H) + H L/EA
 *   z = (H/w) [sqrt(1 + (V/H)^2) - 1] + V^2/(2 EA w) */
#ifndef CAPSTAN_TEST_CATENARY_H
#define CAPSTAN_TEST_CATENARY_H

#include <stdbool.h>

typedef struct Catenary {
    double length, weight, stiffness; /* INFINITY: inextensible */
    bool bed;                         /* may lie on the level of its lower end */
    double h, v;                      /* [N] force at the upper end: out */
} Catenary;

/* Find h and v for the ends (x, z) from the values in the struct; false if Newton does not settle
 * at 1e-13 of x + z. */
bool catenary_solve(Catenary *c, double x, double z);

/* position of the point at natural abscissa s of a freely hanging catenary */
void catenary_point(const Catenary *c, double s, double *x, double *z);

#endif
