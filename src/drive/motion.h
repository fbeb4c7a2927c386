/* SPDX-License-Identifier: BSD-3-Clause */
/* The content of a motion, and its certificate. */
#ifndef CAPSTAN_SRC_DRIVE_MOTION_H
#define CAPSTAN_SRC_DRIVE_MOTION_H

#include "drive/kinematics.h"
#include "drive/system.h"
#include "drive/system_program.h"

/* A number with twice the digits: `high` plus the remainder `low`. */
typedef struct CpsiSum {
    double high, low;
} CpsiSum;

struct CpsMotion {
    const CpsSystem *system;
    CpsMotionReport report;
    double *driving;  /* (m) W */
    double *velocity; /* (n) V */
    /* (n) direction along which the infimum is approached, where it is not attained */
    double *direction;
    double *resistance, *constraint;  /* (m), (rows of C) G, lambda */
    double *law_velocity, *law_force; /* (components) U, F */
    double *piece_force;              /* the forces of all pieces, one after the other */
    size_t *piece_at;                 /* (pieces) where the force of a piece begins */
    CpsiSum *balance;                 /* (n) scratch */
    CpsMotionShare *share;            /* (laws) */
    /* a motion was computed by the program: W is not blocked, and the load can be balanced */
    bool possible;
    double speed, force; /* sizes of velocities and forces */
    /* size of the least velocity that agrees with W. Powers are compared with it, since V may be
     * far larger where nothing resists it. */
    double driven;
};

/* A motion with its bounds, from checked arguments; whether its infimum is attained is not yet
 * known. The caller frees both. */
/* Marks options that were initialised by their default function. */
enum { CPSI_MOTION_COOKIE = 0x4d4f5449 };

CpsStatus cpsi_motion_find(const CpsSystem *system, const double *driving,
                           const CpsMotionOptions *options, CpsMotion **out,
                           CpsiKinematics **kinematics, CpsError *err);

/* U_k = B_k V of all laws. */
void cpsi_motion_carry(CpsMotion *motion);
/* Set forces, G and lambda from a program's solution. */
void cpsi_motion_recover_forces(CpsMotion *motion, const CpsiDriveProgram *program);
/* Shares, residuals and bounds from V, F, G and lambda alone. `program` (NULL: none) only supplies
 * velocities of one-sided laws on the boundary of the admissible ones. */
CpsStatus cpsi_motion_certify(CpsMotion *motion, const CpsiDriveProgram *program, CpsError *err);

/* Changes the outcome to CPS_MOTION_OUTCOME_NOT_ATTAINED where the infimum is not attained
 * (attainment.c); called where Proposition 1's condition does not hold. */
CpsStatus cpsi_motion_attained(CpsMotion *motion, CpsiKinematics *kinematics, CpsError *err);

/* Position in the laws' sets of the forces in the middle of all forces in equilibrium
 * (composition.c). */
CpsStatus cpsi_motion_composition(const CpsSystem *system, double boundary,
                                  CpsComposition *composition, int *iterations, CpsError *err);

#endif
