/* SPDX-License-Identifier: BSD-3-Clause */
/* Moves in time that a function of a program decides (capstan/follow.h). */
#include "capstan/follow.h"

#include <math.h>

#include "base/status.h"
#include "capstan/motion.h"

CpsStatus cps_evolution_follow(CpsEvolution *evolution, double duration, int step_count,
                               CpsFollowFunction *function, void *user, CpsError *err) {
    if (!evolution || !function)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "evolution and function are both needed");
    if (!(duration > 0 && isfinite(duration)))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "duration is %g s, expected a positive number",
                         duration);
    if (step_count < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "step_count is %d, expected 1 or more", step_count);
    const double begin = cps_evolution_time(evolution), length = duration / step_count;
    for (int k = 0; k < step_count; k++) {
        CpsStage step = cps_stage_default();
        if (!function(user, begin + (k + 1) * length, evolution, &step)) return CPS_OK;
        step.duration = length;
        step.step_count = 1;
        const CpsStatus status = cps_evolution_move(evolution, &step, err);
        if (status != CPS_OK) return status;
        if (cps_outcome_is_final(cps_evolution_report(evolution).outcome)) return CPS_OK;
    }
    return CPS_OK;
}
