/* SPDX-License-Identifier: BSD-3-Clause */
/* A time step with drag (damped_step.h): the implicit Euler step of w x' = f/d with f the sum of
 * all forces on a node, w the share of the line that it stands for and d the drag. */
#include "cable/damped_step.h"

#include <math.h>
#include <string.h>

#include "cable/certificate.h"
#include "cable/contact.h"
#include "cable/contact_detection.h"
#include "cable/line_solve.h"
#include "cable/report.h"
#include "cable/rounds.h"

static bool is_finite(const CpsiLine *line) {
    for (int i = 0; i < 3 * line->n; i++)
        if (!isfinite(line->position[i])) return false;
    for (int e = 0; e + 1 < line->n; e++)
        if (!isfinite(line->tension[e])) return false;
    return cpsi_line_is_near(line);
}

/* Solve with coupled bounds or, if that fails, with the bounds of the reference, which the next
 * step corrects. */
static bool solve(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                  double drag) {
    if (options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT && !options->frictionless) {
        const CpsiRound coupled = {.bounds = CPSI_BOUNDS_COUPLED, .centering = true, .drag = drag};
        const CpsiIpmReport ipm = cpsi_line_solve(line, program, options, &coupled);
        if (cpsi_line_is_clean(&ipm) && is_finite(line)) return true;
    }
    const CpsiRound fixed = {.bounds = CPSI_BOUNDS_FIXED, .centering = true, .drag = drag};
    const CpsiIpmReport ipm = cpsi_line_solve(line, program, options, &fixed);
    return ipm.gap + ipm.residual <= options->solver.tolerance && is_finite(line);
}

CpsiDampedStep cpsi_line_damped_step(CpsiLine *line, CpsiChainProgram *program,
                                     const CpsiStepOptions *options, double drag) {
    CpsiDampedStep step = {0};
    double turned;
    cpsi_line_set_reference(line, options);
    step.solved = solve(line, program, options, drag);
    if (!step.solved) {
        memcpy(line->position, line->reference, 3 * (size_t)line->n * sizeof *line->position);
        return step;
    }
    if (line->has_local_axes)
        step.shortened = !cpsi_rounds_refresh_axes(line, !options->frictionless, &turned);
    else
        cpsi_contact_plane_slip(line);
    if (line->has_local_axes && line->contacts > 1) {
        cpsi_contact_detect(line, true);
        cpsi_contact_update_geometry(line);
    }
    if (options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT) cpsi_rounds_couple_bounds(line);
    cpsi_line_release_open_contacts(line, program);
    cpsi_line_classify(line, program);
    cpsi_line_report_ends(line);
    step.distance = cpsi_line_largest_displacement(line, line->reference);
    return step;
}
