/* SPDX-License-Identifier: BSD-3-Clause */
/* Springs beside the segments of a chain: elements whose stiffness grows with their strain
 * (base/element_law.h).
 *
 * With d the elongation of a segment and T its tension, spring k of the element carries the share
 * tau_k of T and is slack up to d = s_k:
 *
 *     d = c (T - sum tau_k),    sigma_k = s_k + c_k tau_k - d >= 0,    tau_k >= 0,    c_k = 1/K_k
 *
 * The pairs (sigma_k, tau_k) are half-lines of the program beside the segment's cone. Linearised,
 * dtau = q - h dsigma with h = tau/sigma, so
 *
 *     dtau_k = (q_k + h_k (dd - rho_k))/(1 + h_k c_k),   rho_k = s_k + c_k tau_k - d - sigma_k
 *
 * Put into the first equation they leave dd = c' dT + rho', one compliance and one residual of each
 * element: the segment's own passes go on with these (segment.c). So the springs add no unknown to
 * the linear system, and the program stays a convex conic one. */
#include <math.h>

#include "base/larger.h"
#include "chain/elements.h"
#include "ipm/cone.h"

void cpsi_springs_layout(CpsiSprings *springs, CpsiArena *arena, int n, int count) {
    if (count == 0) return;
    CPSI_PLACE(arena, springs->s, count);
    CPSI_PLACE(arena, springs->z, count);
    CPSI_PLACE(arena, springs->q, count);
    CPSI_PLACE(arena, springs->ds, count);
    CPSI_PLACE(arena, springs->dz, count);
    CPSI_PLACE(arena, springs->compliance, n);
    CPSI_PLACE(arena, springs->rest, n);
    CPSI_PLACE(arena, springs->stretch, n);
}

static double start_of(const CpsiSprings *springs, int k) {
    return springs->longer * springs->start[k];
}

static double compliance_of(const CpsiSprings *springs, int k) {
    return 1 / (springs->stiffer * springs->stiffness[k]);
}

/* rho of spring k of element i. */
static double residual_of(const CpsiSegment *segment, int i, int k) {
    const CpsiSprings *springs = &segment->springs;
    return start_of(springs, k) + compliance_of(springs, k) * springs->z[k] -
           (segment->s[i][0] - 1) - springs->s[k];
}

void cpsi_springs_start(CpsiSegment *segment, int n, double mu, double margin) {
    CpsiSprings *springs = &segment->springs;
    for (int i = 1; i < n; i++)
        for (int k = springs->at[i - 1]; k < springs->at[i]; k++) {
            springs->s[k] = fmax(margin, start_of(springs, k) - (segment->s[i][0] - 1));
            springs->z[k] = mu / springs->s[k];
        }
}

void cpsi_springs_measure(CpsiSegment *segment, int n, double alpha, CpsiSums *sums) {
    CpsiSprings *springs = &segment->springs;
    if (alpha != 0)
        cpsi_cone_advance((size_t)springs->count, alpha, springs->s, springs->ds, springs->z,
                          springs->dz);
    for (int i = 1; i < n; i++) {
        double carried = 0;
        for (int k = springs->at[i - 1]; k < springs->at[i]; k++) {
            const double l = segment->length[i], product = springs->s[k] * springs->z[k];
            carried += springs->z[k];
            sums->weight += l;
            sums->sz += l * product;
            sums->residual = cpsi_max_nan(sums->residual, fabs(residual_of(segment, i, k)));
        }
        springs->compliance[i] = cpsi_segment_compliance(segment, i);
        springs->rest[i] = -springs->compliance[i] * carried;
    }
}

void cpsi_springs_scale(CpsiSegment *segment, int n) {
    CpsiSprings *springs = &segment->springs;
    for (int i = 1; i < n; i++) {
        const double c = cpsi_segment_compliance(segment, i);
        double stiffness = 0;
        for (int k = springs->at[i - 1]; k < springs->at[i]; k++) {
            const double h = springs->z[k] / springs->s[k];
            stiffness += h / (1 + h * compliance_of(springs, k));
        }
        springs->compliance[i] = c / (1 + c * stiffness);
    }
}

/* dtau_k where dd = 0. */
static double fixed_part(const CpsiSegment *segment, int i, int k, double keep) {
    const CpsiSprings *springs = &segment->springs;
    const double h = springs->z[k] / springs->s[k];
    return (springs->q[k] - h * keep * residual_of(segment, i, k)) /
           (1 + h * compliance_of(springs, k));
}

/* rho' beside keep (1 + c' T - s0), which the segments add. */
void cpsi_springs_load(CpsiSegment *segment, int n, const CpsiIpmAim *aim) {
    CpsiSprings *springs = &segment->springs;
    const double keep = aim->keep;
    for (int k = 0; k < springs->count; k++)
        springs->q[k] = cpsi_cone_aim_half_line(aim, springs->s[k], springs->z[k], springs->q[k]);
    for (int i = 1; i < n; i++) {
        const double c = cpsi_segment_compliance(segment, i), now = springs->compliance[i],
                     tension = segment->z[i][0], s = segment->s[i][0];
        double carried = 0, change = 0;
        for (int k = springs->at[i - 1]; k < springs->at[i]; k++) {
            carried += springs->z[k];
            change += fixed_part(segment, i, k, keep);
        }
        const double rho = keep * (1 + c * (tension - carried) - s);
        springs->rest[i] = now / c * (rho - c * change) - keep * (1 + now * tension - s);
    }
}

void cpsi_springs_direct(CpsiSegment *segment, int n, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiSprings *springs = &segment->springs;
    const double keep = aim->keep;
    double inverse = sums->inverse_step;
    for (int i = 1; i < n; i++)
        for (int k = springs->at[i - 1]; k < springs->at[i]; k++) {
            const double h = springs->z[k] / springs->s[k], c = compliance_of(springs, k);
            const double dz =
                fixed_part(segment, i, k, keep) + h / (1 + h * c) * springs->stretch[i];
            const double ds = c * dz - springs->stretch[i] + keep * residual_of(segment, i, k);
            springs->ds[k] = ds;
            springs->dz[k] = dz;
            if (aim->kind == CPSI_IPM_AIM_PREDICT) springs->q[k] = ds * dz / springs->s[k];
            inverse = cpsi_max_nan(inverse, cpsi_max_nan(-ds / springs->s[k], -dz / springs->z[k]));
        }
    sums->inverse_step = inverse;
}
