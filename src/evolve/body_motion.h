/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies in time (capstan/motion.h, docs/theory.md 9).
 *
 * By the scheme of the nodes of lines (time_step.h) for the places of reference point and centre of
 * gravity, and, in the chart of the rotation Q_n, for the rotation vector t of Q Q_n':
 *
 *     w = (I + (1 - cos |t|)/|t|^2 [t] + (|t| - sin |t|)/|t|^3 [t]^2) (t - t*)/k
 *
 * t* = 0, or -back t_{n-1} with t_{n-1} that of Q_{n-1} Q_n'. With the momenta P = m v and L = Q J
 * Q' w about the centre of gravity, force and moment there are (P - P*)/k and (L - L*)/k. The
 * water's momenta are (p, l) = A (u, w) about the reference point, with the moment l' + u x p
 * (Kirchhoff).
 */
#ifndef CAPSTAN_SRC_EVOLVE_BODY_MOTION_H
#define CAPSTAN_SRC_EVOLVE_BODY_MOTION_H

#include "evolve/state.h"

/* The memory of radiation of all bodies, which have been filled. */
void cpsi_body_motion_layout(CpsEvolution *evolution, CpsiArena *arena, const CpsScene *scene);
void cpsi_body_motion_fill(CpsEvolution *evolution);
void cpsi_body_motion_start(CpsEvolution *evolution);
/* The scheme of the step that begins. */
void cpsi_body_motion_predict(CpsEvolution *evolution);
/* Where a body is after the step if nothing acts on it. */
CpsiPose cpsi_body_motion_guess(const CpsiBody *body);

/* Inertia and damping in a pose, force and moment about the reference point; and minus the
 * derivative of these and of the loads on members by the pose, added to a stiffness (6, 6). */
CpsiWrench cpsi_body_inertia(const CpsiBody *body, const CpsiPose *pose);
CpsiWrench cpsi_body_damping(const CpsiBody *body, const CpsiPose *pose);
void cpsi_body_motion_stiffness(const CpsiBody *body, const CpsiPose *pose, double stiffness[36]);

/* What acts on a body in a pose beside lines, supports, inertia and damping, that on its members in
 * the step with it; and, added, its stiffness (cpsi_body_stiffness), without what in a step in time
 * comes of its velocities there. */
CpsiWrench cpsi_body_whole_load(const CpsEvolution *evolution, const CpsiBody *body,
                                const CpsiPose *pose);
void cpsi_body_whole_stiffness(const CpsEvolution *evolution, const CpsiBody *body,
                               const CpsiPose *pose, double stiffness[36]);

/* The step has been taken, and the bodies are reported on. */
void cpsi_body_motion_advance(CpsEvolution *evolution);
/* A quasi-static step has been taken: all are at rest. */
void cpsi_body_motion_stop(CpsEvolution *evolution);

#endif
