/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid bodies (capstan/body.h): their data, their check, and what acts on them beside the lines.
 * The poses of free ones are found by balance.c. */
#ifndef CAPSTAN_SRC_EVOLVE_BODIES_H
#define CAPSTAN_SRC_EVOLVE_BODIES_H

#include "base/arena.h"
#include "base/rotation.h"
#include "cable/node_field.h"
#include "capstan/evolve.h"
#include "evolve/joint_inertia.h"
#include "evolve/radiation.h"

typedef struct CpsiPose {
    Vec3 place; /* [m] relative to the origin of the evolution */
    Rotation turn;
} CpsiPose;

/* A force and a moment about a body's reference point. */
typedef struct CpsiWrench {
    Vec3 force, moment;
} CpsiWrench;

/* A cylinder on which the water acts (members.h). */
typedef struct CpsiCylinder {
    Vec3 from, axis; /* [m], unit: in the axes of the body */
    double length;   /* [m] */
    double each;     /* [m] of a strip */
    double surface;  /* [m] z of that of the water at rest; infinite: none */
    int strips;
    CpsiFlow flow; /* about it, with its drag */
} CpsiCylinder;

typedef struct CpsiBody {
    const char *name;
    CpsBodyKind kind; /* now */
    CpsiPose pose;    /* now */
    CpsiPose begin;   /* of the scene, from which hydrostatics count */
    CpsiPose from;    /* when the stage under way began */
    CpsiWrench load;  /* given, while it is free */
    CpsiWrench load_from;
    CpsiWrench waves;         /* of the waves in the step (excitation.h) */
    int wave_count;           /* of those that act on it */
    const double *excitation; /* (wave_count, 12) */
    CpsiRadiation radiation;
    int member_count;
    const CpsiCylinder *member; /* (member_count) */
    CpsBody given;              /* with the name above */
    double mass, lift;          /* [kg] weight and buoyancy per gravity */
    double length;              /* [m] of the longest line at its points */
    double arm;                 /* [m] of its farthest point */
    CpsBodyReport report;       /* its position relative to the origin */
    CpsiBodyInertia inertia;
} CpsiBody;

typedef struct CpsiBodies {
    int count;
    CpsiBody *body; /* (count) */
} CpsiBodies;

/* A point of the body's axes: from the reference point, and its place. */
static inline Vec3 cpsi_pose_arm(const CpsiPose *pose, const double point[3]) {
    return rotation_apply(pose->turn, vec3_load(point));
}
static inline Vec3 cpsi_pose_place(const CpsiPose *pose, const double point[3]) {
    return vec3_add(pose->place, cpsi_pose_arm(pose, point));
}

CpsStatus cpsi_bodies_check(const CpsScene *scene, CpsError *err);
CpsStatus cpsi_body_changes_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                  CpsError *err);

/* The pose in which a body of the scene begins. */
CpsiPose cpsi_body_begin(const CpsBody *body);

void cpsi_bodies_layout(CpsiBodies *bodies, CpsiArena *arena, const CpsScene *scene);
/* Fill them but for names; positions are those of `local`, relative to the origin. */
void cpsi_bodies_fill(CpsiBodies *bodies, const CpsScene *scene, const CpsScene *local);

/* What acts on a body in a pose beside its lines and supports. */
CpsiWrench cpsi_body_load(const CpsiBody *body, const CpsiPose *pose, const double gravity[3]);

/* ... of that the water, by the energy of the hydrostatics; and this energy [J]. */
CpsiWrench cpsi_body_water(const CpsiBody *body, const CpsiPose *pose);
double cpsi_body_water_energy(const CpsiBody *body, const CpsiPose *pose);

/* Add to a stiffness (6, 6) that of a force which depends on the pose, by central differences. */
typedef CpsiWrench CpsiWrenchAt(const CpsiBody *body, const CpsiPose *pose);
void cpsi_body_add_stiffness_of(CpsiWrenchAt *force, const CpsiBody *body, const CpsiPose *pose,
                                double stiffness[36]);

/* Add its derivative by the pose, as a stiffness (6, 6): `lines` are the lines' part of what turns
 * with the fairleads, summed by the caller. */
void cpsi_body_stiffness(const CpsiBody *body, const CpsiPose *pose, const double gravity[3],
                         double stiffness[36]);

/* Add to a stiffness (6, 6) what the force f at the arm a, which turns with the body, brings:
 * (f.a) I - a f'. */
void cpsi_add_turning_force(Vec3 force, Vec3 arm, double stiffness[36]);

/* The pose at a share of the way from one to another. */
CpsiPose cpsi_pose_between(const CpsiPose *from, const CpsiPose *to, double share);

#endif
