/* SPDX-License-Identifier: BSD-3-Clause */
/* A system along a path W(t): one motion per interval, and the ledger of its work.
 *
 * The power of the balance (drive.h) with V is -<W, G> + <load, V> = - sum <U_k, F_k>: the laws
 * dissipate what the device and the load supply. */
#include <math.h>

#include "base/status.h"
#include "capstan/drive.h"

static CpsStatus check(const CpsSystem *system, int count, const double *duration,
                       const double *driving, CpsError *err) {
    if (count < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "path: %d intervals, expected at least 1", count);
    const int m = cps_system_drive_space(system);
    for (int i = 0; i < count; i++) {
        if (!(duration[i] > 0) || !isfinite(duration[i]))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "path: interval %d lasts %g s, expected a positive finite time", i + 1,
                             duration[i]);
        for (int k = 0; k < m; k++)
            if (!isfinite(driving[(size_t)i * (size_t)m + (size_t)k]))
                return cpsi_fail(
                    err, CPS_ERR_ARGUMENT,
                    "path: interval %d: component %d of W is %g, expected a finite number", i + 1,
                    k + 1, driving[(size_t)i * (size_t)m + (size_t)k]);
    }
    return CPS_OK;
}

/* The ledger of one interval. */
static CpsPathStep account(const CpsMotion *motion, const double *w, int m, double duration) {
    const CpsMotionReport report = cps_motion_report(motion);
    const double *g = cps_motion_resistance(motion);
    CpsPathStep step = {.outcome = report.outcome};
    for (int k = 0; k < m; k++) step.driven -= duration * w[k] * g[k];
    step.load = duration * report.load_power;
    step.dissipated = duration * report.dissipated;
    step.imbalance = step.driven + step.load - step.dissipated;
    step.lower = duration * report.lower;
    step.upper = duration * report.upper;
    return step;
}

static bool has_motion(CpsMotionOutcome outcome) {
    return outcome != CPS_MOTION_OUTCOME_NO_BALANCE && outcome != CPS_MOTION_OUTCOME_BLOCKED &&
           outcome != CPS_MOTION_OUTCOME_NOT_ATTAINED;
}

CpsStatus cps_system_drive_path(const CpsSystem *system, int count, const double *duration,
                                const double *driving, const CpsMotionOptions *options,
                                CpsPathStep *step, double *travel, int *done, CpsError *err) {
    if (!system || !duration || !driving || !step || !done)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "path: system, duration, driving, step and done are all needed");
    *done = 0;
    CpsStatus status = check(system, count, duration, driving, err);
    const int n = cps_system_parameter_count(system), m = cps_system_drive_space(system);
    for (int i = 0; i < count && status == CPS_OK; i++) {
        CpsMotion *motion = NULL;
        const double *w = &driving[(size_t)i * (size_t)m];
        status = cps_system_solve(system, w, options, &motion, err);
        if (status != CPS_OK) break;
        const CpsMotionOutcome outcome = cps_motion_report(motion).outcome;
        step[i] = (CpsPathStep){.outcome = outcome};
        *done = i + 1;
        if (has_motion(outcome)) {
            step[i] = account(motion, w, m, duration[i]);
            const double *v = cps_motion_velocity(motion);
            for (int k = 0; travel && k < n; k++)
                travel[(size_t)i * (size_t)n + (size_t)k] =
                    (i > 0 ? travel[(size_t)(i - 1) * (size_t)n + (size_t)k] : 0) +
                    duration[i] * v[k];
        }
        cps_motion_destroy(motion);
        if (!has_motion(outcome)) break;
    }
    return status;
}
