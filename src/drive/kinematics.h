/* SPDX-License-Identifier: BSD-3-Clause */
/* Velocities that agree with drive and constraints: the nearest one, by the sparse system
 *
 *     [ I   R' ] [ dV]   [ 0 ]
 *     [ R  -e  ] [ p ] = [ t ]         R = [D; C; lines of the laws' sets], rows of size one, e
 *         small
 *
 * with iterative refinement until R dV = t, also where rows depend on each other. */
#ifndef CAPSTAN_SRC_DRIVE_KINEMATICS_H
#define CAPSTAN_SRC_DRIVE_KINEMATICS_H

#include "drive/system.h"

typedef struct CpsiKinematics CpsiKinematics;

CpsStatus cpsi_kinematics_new(const CpsSystem *system, CpsiKinematics **out, CpsError *err);
void cpsi_kinematics_free(CpsiKinematics *kinematics);

/* Move V (n) to the nearest velocity with D V = driving, C V = 0 and no component along lines of
 * forces. */
void cpsi_kinematics_project(CpsiKinematics *kinematics, const double *driving, double *velocity);

/* Where rows contradict W, the residual p of [D; C; lines] V = (W, 0, 0) satisfies R'p = 0. Its
 * parts for D and C (NULL where not wanted), relative to |W|. Returns the largest absolute
 * value. */
double cpsi_kinematics_contradiction(const CpsiKinematics *kinematics, const double *driving,
                                     const double *velocity, double *drive, double *constraint);

#endif
