/* SPDX-License-Identifier: BSD-3-Clause */
/* The answer for a driving velocity: the motion, the position of its forces in their sets, and
 * whether its infimum is attained. */
#include <float.h>
#include <math.h>

#include "base/status.h"
#include "drive/motion.h"

/* Forces that touch a curved set at only one point are known along its boundary to the square root
 * of rounding, and so is the power that they bound. */
static void widen(CpsMotionReport *report, double power) {
    report->lower -= sqrt(16 * DBL_EPSILON) * power;
    report->minimum = report->upper - report->lower;
}

static CpsStatus check(const CpsSystem *system, const double *driving,
                       const CpsMotionOptions *options, CpsMotion **out, CpsError *err) {
    if (!system || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "system or out is NULL");
    if (system->drive.rows > 0 && !driving)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the driving velocity is NULL, expected %d components",
                         system->drive.rows);
    for (int j = 0; j < system->drive.rows; j++)
        if (!isfinite(driving[j]))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "component %d of the driving velocity is %g, expected a number", j + 1,
                             driving[j]);
    if (options->cookie != CPSI_MOTION_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the options were not made by cps_motion_options_default()");
    if (!(options->tolerance > 0) || !(options->boundary > 0) || !(options->boundary < 1))
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "tolerance %g or boundary %g of the options is not positive; start from the default",
            options->tolerance, options->boundary);
    return CPS_OK;
}

CpsStatus cps_system_solve(const CpsSystem *system, const double *driving,
                           const CpsMotionOptions *options, CpsMotion **out, CpsError *err) {
    const CpsMotionOptions chosen = options ? *options : cps_motion_options_default();
    CpsMotion *motion = NULL;
    CpsiKinematics *kinematics = NULL;
    CpsStatus status = check(system, driving, &chosen, out, err);
    if (status == CPS_OK)
        status = cpsi_motion_find(system, driving, &chosen, &motion, &kinematics, err);
    if (status != CPS_OK) return status;
    CpsMotionReport *report = &motion->report;
    if (motion->possible && chosen.composition) {
        status = cpsi_motion_composition(system, chosen.boundary, &report->composition,
                                         &report->iteration_count, err);
        if (status == CPS_OK && report->composition == CPS_COMPOSITION_NOT_SATISFIED &&
            report->outcome != CPS_MOTION_OUTCOME_BLOCKED)
            status = cpsi_motion_attained(motion, kinematics, err);
        if (report->outcome == CPS_MOTION_OUTCOME_NOT_ATTAINED)
            widen(report, motion->force * motion->driven);
    }
    cpsi_kinematics_free(kinematics);
    if (status == CPS_OK)
        *out = motion;
    else
        cps_motion_destroy(motion);
    return status;
}
