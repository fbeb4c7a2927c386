/* SPDX-License-Identifier: BSD-3-Clause */
/* A cone of the plane as a range of directions (see planar_cone.h). */
#include "io/draw/law/planar_cone.h"

#include <math.h>

#include "base/math.h"

/* Unit directions at most this far from the cone lie in it: far below a pixel, above the error of
 * directions of normals. */
static const double NEAR = 1e-6;

/* Number of halvings of an angle, to the same accuracy. */
enum { HALVINGS = 22 };

static CpsStatus holds(const CpsSet *cone, double angle, bool *in, CpsError *err) {
    double nearest[2];
    CpsSetAnswer answer;
    const CpsStatus status =
        cps_set_project(cone, (double[]){cos(angle), sin(angle)}, NULL, nearest, &answer, err);
    *in = answer.outcome == CPS_SET_OUTCOME_ANSWERED && answer.value <= NEAR;
    return status;
}

/* Angle to which the cone extends from `middle`, a direction inside it, to one side. */
static CpsStatus reach(const CpsSet *cone, double middle, int side, double *angle, CpsError *err) {
    double low = 0, high = CPSI_PI;
    CpsStatus status = CPS_OK;
    for (int k = 0; status == CPS_OK && k < HALVINGS; k++) {
        const double half = 0.5 * (low + high);
        bool in = false;
        status = holds(cone, middle + side * half, &in, err);
        if (in)
            low = half;
        else
            high = half;
    }
    *angle = low;
    return status;
}

CpsStatus cpsi_planar_cone(const CpsSet *cone, CpsiPlanarCone *out, CpsError *err) {
    CpsSetFacts facts;
    double centre[2], basis[4];
    *out = (CpsiPlanarCone){0};
    CpsStatus status = cps_set_facts(cone, 0, &facts, centre, basis, err);
    if (status != CPS_OK || facts.outcome != CPS_SET_OUTCOME_ANSWERED) return status;
    out->dimension = facts.dimension;
    if (facts.dimension == 0) return CPS_OK;
    const double middle =
        facts.dimension == 1 ? atan2(basis[1], basis[0]) : atan2(centre[1], centre[0]);
    bool ahead = false, back = false;
    status = holds(cone, middle, &ahead, err);
    if (status == CPS_OK) status = holds(cone, middle + CPSI_PI, &back, err);
    if (status != CPS_OK) return status;
    out->start = ahead ? middle : middle + CPSI_PI;
    if (facts.dimension == 1) {
        out->line = ahead && back;
        return CPS_OK;
    }
    /* if the opposite of a direction inside lies in the cone too, nothing else is missing */
    if (back) {
        out->turn = 2 * CPSI_PI;
        return CPS_OK;
    }
    double left = 0, right = 0;
    status = reach(cone, middle, 1, &left, err);
    if (status == CPS_OK) status = reach(cone, middle, -1, &right, err);
    out->start = middle - right;
    out->turn = left + right;
    return status;
}
