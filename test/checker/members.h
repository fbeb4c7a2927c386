/* SPDX-License-Identifier: BSD-3-Clause */
/* The water on the members of a scene's bodies, from its definition (body.h). */
#ifndef CAPSTAN_CHECKER_MEMBERS_H
#define CAPSTAN_CHECKER_MEMBERS_H

#include "capstan/scene.h"
#include "joint_motion.h"

/* Where a body is, and how it moves: all about the origin of the scene. */
typedef struct MemberBody {
    Real position[3];
    const double *rotation; /* quaternion */
    const double *velocity, *rate;
    double time; /* [s] after the step; negative: a quasi-static step, without waves */
} MemberBody;

/* Force and moment by velocities and by the water's acceleration, and the sizes of their terms: of
 * forces, then of moments. */
typedef struct MemberLoad {
    Real drag[SIX], waves[SIX];
    double sizes[2];
} MemberLoad;

MemberLoad members_load(const CpsScene *scene, int body, const MemberBody *at);

/* (6, 6) The added mass of a body with that of its members. */
void members_added(const CpsScene *scene, int body, double added[SIX * SIX]);

#endif
