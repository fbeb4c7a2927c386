/* SPDX-License-Identifier: BSD-3-Clause */
/* The tension field of an inextensible line (tension_field.h).
 *
 * Positions do not determine the tensions of an inextensible line at rest, because friction may
 * balance them in different ways. Of all forces that hold the line where it is (force_set.h), those
 * are reported whose tensions are nearest to the tensions before the step,
 *
 *     min  sum l_i (T_i - T_R,i)^2,
 *
 * which is also the limit of a very stiff line: its energy in terms of forces is sum l c (T -
 * T_R)^2/2. */
#include "cable/tension_field.h"

#include <math.h>

/* Scalars nearer than this to their unconstrained optimum, in units of the largest force, are moved
 * to it if that is feasible: about ten times the root of the loop's target. */
static const double OPTIMUM_RANGE = 1e-5;
/* Feasible means violating no cone by more than this: forces that were at a limit before are at it
 * again up to the change of positions. */
static const double FEASIBLE_TOL = 1e-9;

CpsiForceLaw cpsi_force_law(const CpsiStepOptions *options, bool exact) {
    return (CpsiForceLaw){.frozen = options->friction_policy == CPS_FRICTION_POLICY_FROZEN,
                          .frictionless = options->frictionless,
                          .exact = exact};
}

/* Weight of the forces in corners relative to tensions, which makes the minimum unique where a line
 * is jammed. */
static const double SHARE = 1e-8;

static void weigh_shares(CpsiForceSet *set) {
    for (int k = 0; k < set->program.sites; k++)
        for (int a = 0; a < set->program.site[k].own; a++)
            set->program.site[k].weight[(CPSI_SITE_OWN + 1) * a] += SHARE;
}

/* l/L (T_i - T_R,i)^2/2 in units of the program. */
static void weigh_tensions(CpsiForceSet *set, const CpsiLine *line) {
    CpsiScalarProgram *program = &set->program;
    for (int e = 0; e + 1 < line->n; e++) {
        const int g = set->scalar[e];
        if (g < 0) continue;
        const double l = line->element_length[e] / line->length, gain = set->gain[e];
        program->weight[g] += l * gain * gain;
        program->base.load[g] +=
            l * gain * (line->tension_before[e] - set->tension[e]) / set->force;
    }
}

/* Where T_R itself is feasible the minimum is 0, and the loop approaches it only to the root of its
 * gap. So move scalars that are near their unconstrained optimum to it, and move those back that
 * violate a cone there. */
static void use_unconstrained_optimum(CpsiForceSet *set) {
    CpsiScalarProgram *program = &set->program;
    double *y = program->base.u, *found = program->base.du, *best = program->base.residual;
    for (int g = 0; g < program->scalars; g++) {
        const double least = program->base.load[g] / program->weight[g];
        found[g] = y[g];
        best[g] = fabs(y[g] - least) <= OPTIMUM_RANGE ? least : y[g];
        y[g] = best[g];
    }
    for (bool again = true; again;) {
        again = false;
        for (int k = 0; k < program->sites; k++) {
            const CpsiSite *site = &program->site[k];
            if (cpsi_scalar_program_margin(program, k) >= -FEASIBLE_TOL) continue;
            for (int a = 0; a < 2; a++) {
                const int g = site->scalar[a];
                if (g < 0 || y[g] == found[g]) continue;
                y[g] = found[g];
                again = true;
            }
        }
    }
}

/* [N] The reaction before the step of the obstacle that contact c touches. */
static double reaction_before(const CpsiLine *line, int c) {
    const int j = cpsi_line_node(line, c);
    if (line->has_folds && line->obstacle_index_before[c] == line->obstacle_index[c])
        return line->reaction_before[c]; /* the other one may be with the same obstacle */
    for (int b = j; b < cpsi_line_contacts(line); b += line->n)
        if (!line->has_local_axes || line->obstacle_index_before[b] == line->obstacle_index[c])
            return line->reaction_before[b];
    return 0;
}

/* (R - R_R)^2/2 of the contacts of corners. */
static void weigh_reactions(CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law) {
    for (int c = 0; c < cpsi_line_contacts(line); c++) {
        double share[CPSI_SITE_OWN];
        const int k = cpsi_force_set_share(set, line, law, c, share);
        if (k < 0) continue;
        CpsiSite *site = &set->program.site[k];
        const double off = (reaction_before(line, c) - line->reaction[c]) / set->force;
        for (int a = 0; a < site->own; a++) {
            for (int b = 0; b < site->own; b++)
                site->weight[CPSI_SITE_OWN * a + b] += share[a] * share[b];
            set->program.base.load[site->at + a] += share[a] * off;
        }
    }
}

bool cpsi_line_tension_field(CpsiLine *line, CpsiForceSet *set, const CpsiStepOptions *options,
                             bool exact) {
    CpsiForceLaw law = cpsi_force_law(options, exact);
    bool chosen = false;
    if (cpsi_force_set_build(set, line, &law)) {
        weigh_tensions(set, line);
        weigh_shares(set);
        if (!cpsi_force_set_solve(set)) return false;
        use_unconstrained_optimum(set);
        cpsi_force_set_apply(set, line, &law);
        chosen = true;
    }
    law.shares = true;
    if (line->contacts > 1 && cpsi_force_set_build(set, line, &law)) {
        weigh_reactions(set, line, &law);
        weigh_shares(set);
        if (!cpsi_force_set_solve(set)) return chosen;
        cpsi_force_set_apply(set, line, &law);
        chosen = true;
    }
    return chosen;
}
