/* SPDX-License-Identifier: BSD-3-Clause */
/* One step of a history that is computed by the regularised method alone (see
 * cps_regularized_next).
 *
 * On a plane psi is linear: psi at the last solution is the gap of the exact reference plus n times
 * the difference between the two configurations. It may be negative by the penetration that the
 * penalty allows. It is used unchanged, as in (16), and not replaced by 0, as in (35); otherwise
 * the line would sink deeper in every step. */
#include <math.h>

#include "base/status.h"
#include "regularized/band_blocks.h"
#include "regularized/handle.h"

/* [N] reaction of the obstacle on a place of the last solution: the penalty's force, or for a held
 * end that of its half element */
static double push_of(const CpsRegularized *previous, int j, double height) {
    const CpsiCells *own = &previous->cells;
    if (j == own->cells && previous->step.held) return cpsi_end_push(previous, CPS_END_B);
    return previous->f.parameters.penalty * own->share[j] * fmax(0, -height);
}

/* reference, gap and bound of a node from the last solution */
static void continue_node(CpsiCells *own, const CpsRegularized *previous, double friction, int j) {
    const Vec3 from = vec3_at(own->reference, j), now = vec3_at(previous->f.place, j),
               n = vec3_at(own->normal, j);
    vec3_store(own->reference + 3 * (size_t)j, now);
    own->bound[j] = 0;
    if (!isfinite(own->gap[j])) return;
    own->gap[j] += vec3_dot(n, vec3_sub(now, from));
    own->bound[j] = friction * own->factor[j] * push_of(previous, j, own->gap[j]);
}

CpsStatus cps_regularized_next(const CpsLineView *step, double friction,
                               const CpsRegularized *previous, CpsRegularized **out,
                               CpsError *err) {
    if (!step || !previous || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "step, previous or out is NULL");
    *out = NULL;
    if (!(friction >= 0 && isfinite(friction)))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "friction: found %g, expected a finite number >= 0",
                         friction);
    if (previous->asked != 0 || previous->cells.cells != step->element_count)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "previous was not solved last on the elements of this line (cells = 0)");
    const CpsStatus status = cps_regularized_create(step, out, err);
    if (status != CPS_OK) return status;
    CpsiCells *own = &(*out)->step.own;
    for (int j = 0; j <= own->cells; ++j) continue_node(own, previous, friction, j);
    own->bound[0] = 0;
    if ((*out)->step.held) own->bound[own->cells] = 0;
    return CPS_OK;
}
