/* SPDX-License-Identifier: BSD-3-Clause */
/* The loads of the water on the members of bodies (capstan/body.h, docs/theory.md 9). */
#ifndef CAPSTAN_SRC_EVOLVE_MEMBERS_H
#define CAPSTAN_SRC_EVOLVE_MEMBERS_H

#include "evolve/state.h"

/* Check those of all bodies; they, the current and the waves have been checked. */
CpsStatus cpsi_members_check(const CpsScene *scene, CpsError *err);

/* Of all bodies, which have been filled; their added mass is increased by that of their members. */
void cpsi_members_layout(CpsEvolution *evolution, CpsiArena *arena, const CpsScene *scene);
void cpsi_members_fill(CpsEvolution *evolution, const CpsScene *local);

/* Force and moment about the reference point: by the velocity of the water past the strips, and by
 * its acceleration. */
typedef struct CpsiMemberLoad {
    CpsiWrench drag, waves;
} CpsiMemberLoad;

/* On a body in a pose. `phase`: its velocities there in a step in time; NULL: at rest in a
 * quasi-static one, in which there are no waves. */
CpsiMemberLoad cpsi_members_load(const CpsiBody *body, const CpsiPose *pose,
                                 const CpsiBodyPhase *phase);

/* Add to a stiffness (6, 6) that of a body at rest. */
void cpsi_members_stiffness(const CpsiBody *body, const CpsiPose *pose, double stiffness[36]);

#endif
