/* SPDX-License-Identifier: BSD-3-Clause */
/* The options of a step of a line. */
#ifndef CAPSTAN_SRC_CABLE_STEP_OPTIONS_H
#define CAPSTAN_SRC_CABLE_STEP_OPTIONS_H

#include "cable/least_motion.h"

typedef struct CpsiStepOptions {
    CpsSolverOptions solver;
    CpsFrictionPolicy friction_policy;
    CpsContactPolicy contact_policy;
    bool frictionless; /* an initial configuration is computed by statics */
    bool fails;        /* the step is known to fail: one strategy shows where */
    /* contact of the reference and friction that follows it: solve the step's own equations, even
     * if the answer lies across an obstacle that the line did not touch */
    bool across;
    /* scratch memory of the rule of least motion; NULL: the rule is not applied */
    CpsiLeastMotion *least;
} CpsiStepOptions;

#endif
