/* SPDX-License-Identifier: BSD-3-Clause */
/* A step of Newton's method for the places of free points and bodies (balance.h). */
#ifndef CAPSTAN_SRC_EVOLVE_NEWTON_STEP_H
#define CAPSTAN_SRC_EVOLVE_NEWTON_STEP_H

#include "evolve/trial.h"

/* A body whose pose is not stable is held back by a share of its own stiffness, from this one on.
 */
#define CPSI_LEAST_HELD 1e-3
/* What places found to 1e-10 leave of a stiffness of 0, per largest entry. */
#define CPSI_NEUTRAL 3e-10

/* How a point follows from the unknowns of the group. */
CpsiJointMap cpsi_joint_map(const CpsiBalance *balance, int point);
/* The stiffness of the lines and bodies at the unknowns, in balance->matrix; and the block of body
 * k in it. */
void cpsi_fill_matrix(CpsiBalance *balance);
void cpsi_body_block(const CpsiBalance *balance, int k, double out[36]);
/* Is the symmetric part of a stiffness positive definite in the directions that are not fixed? */
bool cpsi_is_definite(const double stiffness[36], const bool fixed[6], double arm);
/* Is it by more than rounding? A body that may drift or turn freely is not stable. */
bool cpsi_is_stable(const double stiffness[36], const bool fixed[6], double arm);

/* The step of all points and bodies, in balance->step. Where a body in its pose is not stable it
 * might lead up the energy; then the body is held back. False where there is none. */
bool cpsi_find_step(CpsiBalance *balance);
/* The step of the points towards where they were in the directions in which nothing is stiff: by
 * forces of the stiffness that is added to the matrix (CPSI_REGULAR). */
bool cpsi_find_least_step(CpsiBalance *balance);
/* Instead: every point along the force that is left on it. */
void cpsi_follow_forces(CpsiBalance *balance);
/* Shorten the parts of the step that are too long; a vector to a length. */
void cpsi_limit_step(CpsiBalance *balance);
void cpsi_limit(double step[3], double most);
/* [J] The work along the step of the forces that are left. */
double cpsi_work_along(const CpsiBalance *balance);

/* The place of a point after a share of the step: out of every obstacle, and on that on which it is
 * to lie; exactly where it was where it is to stick. The pose of body k after a share of the step:
 * its rotation since the step began, as one vector, has no component about a fixed axis. */
Vec3 cpsi_place_after(const CpsiBalance *balance, const CpsiFree *from, const double step[3],
                      double share);
CpsiPose cpsi_pose_after(const CpsiBalance *balance, int k, const CpsiPose *from,
                         const double step[6], double share);

#endif
