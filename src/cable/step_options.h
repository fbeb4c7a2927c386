/* SPDX-License-Identifier: BSD-3-Clause */
/* What is asked of a step of a line. */
#ifndef CAPSTAN_SRC_CABLE_STEP_OPTIONS_H
#define CAPSTAN_SRC_CABLE_STEP_OPTIONS_H

#include "cable/least_motion.h"

typedef struct CpsiStepOptions {
    CpsSolverOptions solver;
    CpsFrictionPolicy friction;
    CpsContactPolicy contact;
    bool frictionless; /* an initial configuration is computed by statics */
    /* scratch memory of the rule of least motion; NULL: places are as they are found */
    CpsiLeastMotion *least;
} CpsiStepOptions;

#endif
