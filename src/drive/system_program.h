/* SPDX-License-Identifier: BSD-3-Clause */
/* A driven system as one conic program over forces (conic/sparse_program.h):
 *
 *     min  <W, G> + sum of costs    s.t.  sum of B_k* F_k + load - D* G - C* lambda = 0,
 *                                          F_k = o + P v + Q'l,  A v + b in K
 *                                              the conic form of each piece
 *
 * whose multipliers are -V. The cost of a piece is phi*(-F): 0 for friction, an unknown of an
 * epigraph for a term of a resistance. Equations are divided by the size of the forces in them, the
 * free unknowns scaled so that their largest entry is one. */
#ifndef CAPSTAN_SRC_DRIVE_SYSTEM_PROGRAM_H
#define CAPSTAN_SRC_DRIVE_SYSTEM_PROGRAM_H

#include "conic/sparse_program.h"
#include "drive/system.h"

/* The objective. */
typedef enum CpsiAim {
    CPSI_AIM_MOTION, /* the one above */
    CPSI_AIM_FACTOR, /* max mu with mu load instead of load */
    CPSI_AIM_MIDDLE  /* none: forces in the middle of all forces in equilibrium */
} CpsiAim;

typedef struct CpsiDriveProgram {
    const CpsSystem *system;
    const CpsiConicForm **form; /* (pieces) of each piece */
    CpsiConicForm **own;        /* (pieces) forms constructed here, for terms; else NULL */
    int *first, *line, *row;    /* (pieces) first unknown v, first unknown l, first row */
    /* number of unknowns; first unknowns of G, lambda, mu */
    int unknowns, resistance, constraint, factor;
    CpsiBlock *block;
    CpsiRows equation;
    double *c, *h;                    /* (unknowns), (n) */
    double *row_scale, *column_scale; /* (n), (unknowns) */
    double power;                     /* unit of the objective */
    CpsiSparseProgram *program;
    CpsiConicResult result;
} CpsiDriveProgram;

/* Write the program and prepare its solution. For a motion `driving` (m) is W and `speed` > 0 the
 * size of velocities, for terms. even: all equations are divided by one force instead of each by
 * the largest in it. */
CpsStatus cpsi_drive_program_new(const CpsSystem *system, CpsiAim aim, const double *driving,
                                 double speed, bool even, CpsiDriveProgram *out, CpsError *err);
void cpsi_drive_program_clear(CpsiDriveProgram *p);
void cpsi_drive_program_solve(CpsiDriveProgram *p);

/* The force of a piece (its space), or its part of the ray where the outcome is a ray. */
void cpsi_drive_program_force(const CpsiDriveProgram *p, int piece, double *force);
/* V (n), G (m), lambda. */
void cpsi_drive_program_velocity(const CpsiDriveProgram *p, double *velocity);
void cpsi_drive_program_multipliers(const CpsiDriveProgram *p, double *resistance,
                                    double *constraint);
double cpsi_drive_program_factor(const CpsiDriveProgram *p);

/* The epigraph {(F, e) : phi*(-F) <= e} of a term in conic form; speed is the size of velocities.
 * For speed 0 it is {F : phi*(-F) finite} x {0}. */
CpsStatus cpsi_term_form(int n, const CpsiTerm *term, double speed, CpsiConicForm **out,
                         CpsError *err);

#endif
