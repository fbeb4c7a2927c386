/* SPDX-License-Identifier: BSD-3-Clause */
/* What a scene gives of a body for steps in time. */
#ifndef CAPSTAN_SRC_EVOLVE_BODY_MOTION_CHECK_H
#define CAPSTAN_SRC_EVOLVE_BODY_MOTION_CHECK_H

#include "capstan/scene.h"

/* Check mass, inertia, added mass, damping and velocity; `in_time`: a step has a duration. Returns
 * CPS_OK or CPS_ERR_ARGUMENT. */
CpsStatus cpsi_body_motion_check(const CpsBody *body, bool in_time, CpsError *err);

/* Does a damping (6, 6) of finite numbers take energy, or none, in every motion, but for rounding?
 */
bool cpsi_takes_energy(const double m[36]);

#endif
