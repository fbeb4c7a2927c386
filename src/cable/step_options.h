/* SPDX-License-Identifier: BSD-3-Clause */
/* What is asked of a step of a line, and the way in which it is tried. */
#ifndef CAPSTAN_SRC_CABLE_STEP_OPTIONS_H
#define CAPSTAN_SRC_CABLE_STEP_OPTIONS_H

#include "cable/least_motion.h"

typedef struct CpsiStepOptions {
    CpsSolverOptions solver;
    CpsFrictionPolicy friction;
    CpsContactPolicy contact;
    bool frictionless; /* a start laid by statics */
    /* scratch of the rule of least motion; NULL: places are as they are found */
    CpsiLeastMotion *least;
    /* set by the step itself */
    int centering_steps;
    bool slow;    /* many rounds, that do not look ahead */
    bool turning; /* reactions turn with their normals within a round */
    bool trying;  /* bounds that are tried, not bounds that follow */
    bool dragged; /* rounds that a drag may hold back */
    double drag;  /* what it is in a round (step_program.h) */
} CpsiStepOptions;

#endif
