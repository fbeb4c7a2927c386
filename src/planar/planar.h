/* SPDX-License-Identifier: BSD-3-Clause */
/* A body on patches, as the files of this folder use it. */
#ifndef CAPSTAN_SRC_PLANAR_PLANAR_H
#define CAPSTAN_SRC_PLANAR_PLANAR_H

#include "capstan/planar.h"
#include "law/law.h"

/* A checked patch. For polygons the position is the centroid, and corners are in body axes relative
 * to it. */
typedef struct CpsiPatch {
    CpsPatchKind kind;
    double position[2];
    double axis[2];  /* unit vector along the first axis */
    double strength; /* [N] friction x load */
    /* half length, radius; polygon: radius of the circle round the centroid that contains it */
    double size;
    double strip;   /* [N] wheel: brake torque/radius */
    double tilt[2]; /* rod: along it; others: in body axes */
    double area;    /* polygon */
    int corner_count;
    const double *corner; /* (corner_count, 2), in the body's block */
    CpsSet *set;          /* a point's law, else NULL */
} CpsiPatch;

struct CpsPlanar {
    int count;
    double reach; /* [m] > 0: length that converts rotations to translations */
    double *corner;
    CpsiPatch patch[]; /* (count) */
};

/* Power and friction wrench of a patch about its position, in body axes: power = -(force . velocity
 * + torque w). */
typedef struct CpsiPatchDissipation {
    CpsSetOutcome outcome;
    bool exact;
    double power, gap;
    double force[2], torque;
} CpsiPatchDissipation;

/* Closed form for a patch whose position moves with `velocity` while it turns with w. */
CpsStatus cpsi_patch_dissipation_rate(const CpsiPatch *patch, const double velocity[2], double w,
                                      CpsiPatchDissipation *out, CpsError *err);

/* M77 section 11 for a wheel whose centre moves with `velocity` (body axes). */
CpsWheelMotion cpsi_wheel_motion(const CpsiPatch *patch, const double velocity[2]);

/* Velocity of a patch's position. */
static inline void cpsi_patch_velocity(const CpsiPatch *patch, const double twist[3],
                                       double velocity[2]) {
    velocity[0] = twist[0] - twist[2] * patch->position[1];
    velocity[1] = twist[1] + twist[2] * patch->position[0];
}

static inline bool cpsi_patch_is_area(const CpsiPatch *patch) {
    return patch->kind != CPS_PATCH_POINT && patch->kind != CPS_PATCH_WHEEL;
}

/* phi and a wrench of the law at a twist. Unchecked. */
CpsStatus cpsi_planar_dissipation_rate(const CpsPlanar *body, const double twist[3],
                                       double wrench[3], double *by_patch, CpsSetAnswer *answer,
                                       CpsError *err);

#endif
