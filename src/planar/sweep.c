/* SPDX-License-Identifier: BSD-3-Clause */
/* Sweeping process of a block on a spring (Moreau's catching-up scheme).
 *
 * Friction F = k (u - X) must lie in C, so u remains in X + C/k, and where it moves -du is a normal
 * of that set: the moving set pushes u. One step: u' = the point of X' + C/k nearest to u, that is
 * F' = the point of C nearest to k (u - X').
 *
 * Ledger: the spring's energy changes by (S + S')/2 . (dX - du) exactly, S = -F. With work (S +
 * S')/2 . dX and dissipation S'. du the imbalance of a step is (S - S'). du/2, of second order;
 * with one component it vanishes where the block slides throughout the step. */
#include <math.h>

#include "base/status.h"
#include "planar/planar.h"

enum { MOST = 3, SWEEP_COOKIE = 0x5eeb1a5e };

CpsSweep cps_sweep_default(void) { return (CpsSweep){.cookie = SWEEP_COOKIE}; }

CpsStatus cps_sweep_step(const CpsLaw *law, CpsSweep *sweep, const double *end, CpsSweepStep *step,
                         CpsError *err) {
    if (!law || !sweep || !step)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "law, sweep or step is NULL");
    if (sweep->cookie != SWEEP_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the sweep was not made by cps_sweep_default()");
    const int n = cps_law_space(law);
    if (n > MOST)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the law has %d components, expected at most %d", n,
                         MOST);
    CpsStatus status = cpsi_law_check_vector("end", n, end, err);
    if (status == CPS_OK) status = cpsi_law_check_vector("position", n, sweep->position, err);
    if (status == CPS_OK) status = cpsi_law_check_vector("last end", n, sweep->end, err);
    if (status != CPS_OK) return status;
    const double k = sweep->stiffness;
    if (!(k > 0) || !isfinite(k))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the stiffness is %g N/m, expected more than 0", k);

    double trial[MOST];
    CpsSweepStep out = {.outcome = CPS_SET_OUTCOME_ANSWERED};
    CpsSetAnswer answer;
    for (int i = 0; i < n; i++) trial[i] = k * (sweep->position[i] - end[i]);
    status = cps_set_project(cps_law_set(law), trial, NULL, out.force, &answer, err);
    if (status != CPS_OK) return status;
    out.outcome = answer.outcome;
    if (answer.outcome != CPS_SET_OUTCOME_ANSWERED) {
        *step = (CpsSweepStep){.outcome = answer.outcome};
        return CPS_OK;
    }

    for (int i = 0; i < n; i++) {
        const double before = k * (sweep->end[i] - sweep->position[i]), after = -out.force[i];
        out.slid[i] = (out.force[i] - trial[i]) / k;
        out.work += 0.5 * (before + after) * (end[i] - sweep->end[i]);
        out.dissipated += after * out.slid[i];
        out.stored += 0.5 * after * after / k;
    }
    for (int i = 0; i < n; i++) {
        sweep->position[i] += out.slid[i];
        sweep->end[i] = end[i];
    }
    sweep->work += out.work;
    sweep->dissipated += out.dissipated;
    *step = out;
    return CPS_OK;
}
