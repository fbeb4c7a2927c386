/* SPDX-License-Identifier: BSD-3-Clause */
/* A line that stays where it is (standstill.h). */
#include "cable/standstill.h"

#include <math.h>
#include <string.h>

#include "cable/certificate.h"
#include "cable/contact.h"
#include "cable/flow.h"
#include "cable/friction_law.h"
#include "cable/line_solve.h"
#include "chain/frame.h"

/* A line stays where it is if its gap is at most a digit worse than that of the step before:
 * without slip, and with forces balanced anew, the same forces add up to slightly more or less. */
static const double GAP_GROWTH = 10;

/* Are held nodes where they were, and do obstacles and winches not turn? */
static bool supports_rest(const CpsiLine *line) {
    if (line->drums.moved) return false;
    for (int end = 0; end < 2; end++) {
        const double *at = &line->reference[end == CPS_END_A ? 0 : 3 * (line->n - 1)],
                     *to = line->end[end].value;
        if (line->end[end].kind == CPS_END_KIND_HELD)
            for (int a = 0; a < 3; a++)
                if (at[a] != to[a]) return false;
    }
    for (int k = 0; k < line->grasp_count; k++) {
        const CpsGrasp *grasp = &line->grasp[k];
        const double *at = &line->reference[3 * grasp->node], *to = grasp->imposed.value;
        if (grasp->imposed.kind == CPS_END_KIND_HELD)
            for (int a = 0; a < 3; a++)
                if (at[a] != to[a]) return false;
    }
    for (int k = 0; k < line->obstacle_count; k++)
        if (line->turn[k] != 0 || cpsi_line_is_shifted(line, k)) return false;
    return true;
}

/* Is friction within its bounds? */
static bool friction_holds(const CpsiLine *line, const CpsiStepOptions *options) {
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        double f[3], inside[3];
        const CpsiFrictionLaw *law = &line->friction_law[c];
        const double bound = line->friction_bound[c];
        cpsi_frame_to(f, cpsi_line_axes(line, c), &line->friction_force[3 * c]);
        if (f[0] == 0 && f[1] == 0 && f[2] == 0) continue;
        /* whether F lies in a given set is not computed: its bound must be the one under which F
         * was found, as a bound coupled to the reaction is */
        if (law->given &&
            !(bound > 0 && options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT))
            return false;
        memcpy(inside, f, sizeof f);
        cpsi_friction_law_clip(law, bound, bound, inside);
        const double out = hypot(f[0] - inside[0], f[1] - inside[1]) + fabs(f[2]);
        if (!(out <= CPSI_CLEAN * line->report.certificate.largest_force)) return false;
    }
    return true;
}

bool cpsi_line_stands_still(CpsiLine *line, const CpsiStepOptions *options,
                            const CpsLineReport *before) {
    static const CpsiIpmReport nothing_left = {.outcome = CPSI_IPM_SOLVED};
    if (!options->least || options->frictionless || !(before->share > 0) || !supports_rest(line))
        return false;
    line->report.certificate = cpsi_certificate(line, options->solver.tolerance);
    const double left =
        line->report.certificate.force_residual / line->report.certificate.largest_force;
    /* the loads are the same, but normals turned when the last round moved the line onto the
     * surfaces */
    if (left > CPSI_CLEAN && left <= CPSI_TOUCH) {
        cpsi_balance_forces(line, options->friction_policy);
        line->report.certificate = cpsi_certificate(line, options->solver.tolerance);
    }
    if (!friction_holds(line, options)) return false;
    const CpsCertificate *c = &line->report.certificate;
    line->report.outcome = cpsi_line_outcome(line, options, &nothing_left);
    if (!cps_outcome_is_certified(line->report.outcome) ||
        !(c->load_residual <= CPSI_FOLLOWED * c->largest_force) ||
        !(c->gap <= fmax(GAP_GROWTH * before->certificate.gap, CPSI_TARGET * c->scale)))
        return false;
    for (int i = 0; i < cpsi_line_all_contacts(line); i++)
        if (line->state[i] != CPS_NODE_STATE_FREE) line->state[i] = CPS_NODE_STATE_STICK;
    line->report.slack = before->slack;
    line->report.places =
        before->places == CPS_PLACES_UNIQUE ? CPS_PLACES_UNIQUE : CPS_PLACES_NEAREST;
    return true;
}
