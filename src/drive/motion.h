/* SPDX-License-Identifier: BSD-3-Clause */
/* A motion inside, and its certificate. */
#ifndef CAPSTAN_SRC_DRIVE_MOTION_H
#define CAPSTAN_SRC_DRIVE_MOTION_H

#include "drive/kinematics.h"
#include "drive/system.h"
#include "drive/system_program.h"

/* A number in twice the digits: what `high` leaves out is in `low`. */
typedef struct CpsiSum {
    double high, low;
} CpsiSum;

struct CpsMotion {
    const CpsSystem *system;
    CpsMotionReport report;
    double *driving;   /* (m) W */
    double *velocity;  /* (n) V */
    double *direction; /* (n) along which the infimum is approached, where it is not attained */
    double *resistance, *constraint;  /* (m), (rows of C) G, lambda */
    double *law_velocity, *law_force; /* (components) U, F */
    double *piece_force;              /* the forces of all pieces, one after the other */
    size_t *piece_at;                 /* (pieces) where a piece's begins */
    CpsiSum *balance;                 /* (n) scratch */
    CpsMotionShare *share;            /* (laws) */
    bool possible; /* a motion was asked of the program: not blocked, the load can be balanced */
    double speed, force; /* sizes of velocities and forces */
    double driven; /* size of the least velocity that agrees with W: what a power is measured by, as
                      V may be far larger where nothing resists it */
};

/* A motion with its bounds, from checked arguments; not yet whether its infimum is attained. The
 * caller frees both. */
/* What tells options that began as the default. */
enum { CPSI_MOTION_COOKIE = 0x4d4f5449 };

CpsStatus cpsi_motion_find(const CpsSystem *system, const double *driving,
                           const CpsMotionOptions *options, CpsMotion **out,
                           CpsiKinematics **kinematics, CpsError *err);

/* U_k = B_k V of all laws. */
void cpsi_motion_carry(CpsMotion *motion);
/* Forces, G and lambda from a program's solution. */
void cpsi_motion_recover_forces(CpsMotion *motion, const CpsiDriveProgram *program);
/* Shares, residuals and bounds from V, F, G and lambda alone. `program` (NULL: none) only supplies
 * velocities of one-sided laws on the boundary of those that are allowed. */
CpsStatus cpsi_motion_certify(CpsMotion *motion, const CpsiDriveProgram *program, CpsError *err);

/* Makes the outcome CPS_MOTION_OUTCOME_NOT_ATTAINED where the infimum is (attainment.c); asked
 * where Proposition 1's condition does not hold. */
CpsStatus cpsi_motion_attained(CpsMotion *motion, CpsiKinematics *kinematics, CpsError *err);

/* Where the forces in the middle of all that balance lie in the laws' sets (composition.c). */
CpsStatus cpsi_motion_composition(const CpsSystem *system, double boundary,
                                  CpsComposition *composition, int *iterations, CpsError *err);

#endif
