/* SPDX-License-Identifier: BSD-3-Clause */
/* One step of one line (S90 problem P4.2, with A frozen from the reference or following the
 * reaction), in four moves:
 *
 *   pose      reference x_R, friction bounds w = mu R_R where the reference touches, gaps, loads
 *   decide    is there an equilibrium at all?  (existence.h)
 *   solve     write the step as a program (step_program.c), run ipm/
 *   conclude  back to world axes; balance the forces; classify nodes; certificate; report
 *
 * Consistent friction is solved in one go, the bound of each rub tied to the reaction beside it
 * (chain/friction_disc.c). That problem is no minimisation and may stall; then the bounds are found
 * in rounds, each a convex step with the last round's mu R.
 *
 * On curved obstacles, or where friction follows the line's direction, each round is such a program
 * on the tangent planes where the last one ended: the inequalities are kept whole, normals and axes
 * turn from round to round. Rounds come to rest where the equilibrium is stable (docs/theory.md
 * 2.4); they look ahead (anderson.h), and where that does not settle they go slowly, or with a
 * drag. What the last round leaves is in the certificate, which is taken at the place reached, with
 * its own normals. Frozen friction keeps the bounds and axes of the reference, as S90 has it;
 * strict contact beside it the planes of the reference too. */
#include "cable/line_step.h"

#include <math.h>
#include <string.h>

#include "cable/bend.h"
#include "cable/certificate.h"
#include "cable/contact.h"
#include "cable/endless_slide.h"
#include "cable/existence.h"
#include "cable/friction_law.h"
#include "cable/line_solve.h"
#include "cable/mesh_error.h"
#include "cable/report.h"
#include "cable/rounds.h"
#include "cable/shortfall.h"
#include "cable/tension_field.h"
#include "chain/frame.h"
#include "ipm/ipm.h"

/* Steps to the centre once there: what is left of a force's angle to its element is squared by
 * each. */
static const int CENTERING_STEPS = 2;
/* A line stays where it is if its gap is at most a digit worse than that of the step before:
 * without slip, and balanced anew, the same forces add up to a little more or less. */
static const double AS_GOOD = 10;

/* solve ---------------------------------------------------------------------------------------- */

/* Solve with bounds that follow the reactions or with the bounds of the line, on the planes of the
 * pose. */
static CpsiIpmReport attempt(CpsiLine *line, CpsiChainProgram *program,
                             const CpsiStepOptions *options, bool follow) {
    const CpsiIpmReport ipm =
        cpsi_line_solve(line, program, options, follow ? CPSI_BOUNDS_COUPLED : CPSI_BOUNDS_FIXED,
                        false);
    cpsi_contact_plane_slip(line);
    if (follow) cpsi_line_release_open_contacts(line, program);
    cpsi_line_certify(line, options, &ipm);
    return ipm;
}

/* The step as it is posed, in one go or in rounds. */
static void solve_once(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options) {
    const bool consistent = options->friction == CPS_FRICTION_CONSISTENT;
    const bool follow = consistent && !options->frictionless && line->obstacle_count > 0;
    if (options->dragged) {
        cpsi_dragged_rounds(line, program, options,
                            follow ? CPSI_BOUNDS_COUPLED : CPSI_BOUNDS_FIXED);
    } else if (line->has_local_axes && (consistent || options->frictionless || line->frozen)) {
        cpsi_tangent_plane_rounds(line, program, options,
                                  !follow           ? CPSI_BOUNDS_FIXED
                                  : options->trying ? CPSI_BOUNDS_TRIAL
                                                    : CPSI_BOUNDS_COUPLED);
    } else {
        const CpsiIpmReport ipm = attempt(line, program, options, follow);
        if (follow && !cpsi_line_is_clean(&ipm))
            cpsi_tangent_plane_rounds(line, program, options, CPSI_BOUNDS_TRIAL);
    }
}

/* Is every number of the answer one? */
static bool is_finite(const CpsiLine *line) {
    const CpsCertificate *c = &line->report.certificate;
    return isfinite(c->primal) && isfinite(c->dual) && isfinite(c->gap) && isfinite(c->scale) &&
           isfinite(c->force_residual);
}

/* Back to the reference, without forces: what is reported where arithmetic has broken down, or the
 * line was on its way to nowhere. */
static void reset_to_reference(CpsiLine *line, const CpsiStepOptions *options) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    const CpsiIpmReport none = {.outcome = CPSI_IPM_STALLED};
    memcpy(line->position, line->reference, 3 * n * sizeof *line->position);
    memset(line->friction_force, 0, 3 * contacts * sizeof *line->friction_force);
    memset(line->segment_force, 0, 3 * n * sizeof *line->segment_force);
    memset(line->friction_bound, 0, contacts * sizeof *line->friction_bound);
    memset(line->reaction, 0, contacts * sizeof *line->reaction);
    memset(line->tension, 0, n * sizeof *line->tension);
    if (line->has_local_axes) {
        cpsi_contact_reset(line);
        cpsi_contact_update_geometry(line);
    }
    cpsi_line_certify(line, options, &none);
    line->report.outcome = CPS_OUTCOME_STALLED;
}

/* Solve in one way or another: with places as they are found, should the rule of least motion be in
 * the way; slowly, where a line without tension has no place of its own to settle at; with
 * reactions that turn with their normals late, and not in statics, because they have a line stay on
 * a crest that it would leave; then also without centrings: where hardly any force is left, the
 * centre may lie farther from the boundary than the tolerance lets it; with bounds that are tried:
 * where what rests in a corner has many answers, the loop with bounds that follow ends far from the
 * boundary. Last in rounds that a drag may hold back, where the others go to and fro or have far to
 * go. */
static void solve_with_fallbacks(CpsiLine *line, CpsiChainProgram *program,
                                 const CpsiStepOptions *options) {
    enum { QUICK, AS_FOUND, SLOW, TURNING, TRYING, DRAGGED, STRATEGIES };
    const int first = line->has_local_axes && options->frictionless ? SLOW : QUICK;
    for (int way = first; way < STRATEGIES; way++) {
        if (way == AS_FOUND && !(options->least && options->least->chose))
            continue;                                       /* all places were as they were found */
        if (way == SLOW && !line->has_local_axes) continue; /* no rounds on one plane */
        if (way == TURNING && line->has_local_axes && options->frictionless) continue;
        if (way == TRYING && (!line->has_local_axes || line->frozen || options->frictionless))
            continue;
        const bool rounds = line->has_local_axes && (options->friction == CPS_FRICTION_CONSISTENT ||
                                                     options->frictionless || line->frozen);
        if (way == DRAGGED && !rounds) return;
        CpsiStepOptions with = *options;
        with.slow = way == SLOW;
        if (way == AS_FOUND) with.least = NULL;
        if (options->least) options->least->chose = false;
        with.turning = way == TURNING;
        with.dragged = way == DRAGGED;
        with.trying = way == TRYING;
        with.centering_steps = way == TURNING ? 0 : CENTERING_STEPS;
        if (way > first)
            memset(line->reaction, 0,
                   (size_t)cpsi_line_all_contacts(line) * sizeof *line->reaction);
        if (line->has_local_axes) cpsi_contact_reset(line);
        solve_once(line, program, &with);
        if (options->least && (way == AS_FOUND || way == DRAGGED))
            cpsi_places_as_found(line, program);
        if (cps_outcome_is_certified(line->report.outcome)) return;
    }
}

/* conclude ------------------------------------------------------------------------------------- */

/* What the tensions of an inextensible line, and the reactions in corners, are to be near to. */
static void remember(CpsiLine *line) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    if (!line->forces) return;
    memcpy(line->tension_before, line->tension, (n - 1) * sizeof *line->tension);
    memcpy(line->reaction_before, line->reaction, contacts * sizeof *line->reaction);
    if (line->has_local_axes) memcpy(line->on_before, line->on, contacts * sizeof *line->on);
}

/* Free, stick and slip, and the sums that go with them. */
static void classify(CpsiLine *line, const CpsiChainProgram *program) {
    CpsLineReport *report = &line->report;
    report->grounded = report->slipping = report->slack = 0;
    cpsi_line_classify(line, program);
}

/* The forces of an inextensible line, where its place leaves a choice: those nearest to the forces
 * before, if they can be certified. */
static void choose_forces(CpsiLine *line, const CpsiChainProgram *program,
                          const CpsiStepOptions *options) {
    if (!line->forces || !cps_outcome_is_certified(line->report.outcome)) return;
    const CpsiIpmReport done = {.outcome = CPSI_IPM_SOLVED};
    const CpsCertificate before = line->report.certificate;
    const CpsOutcome outcome = line->report.outcome;
    cpsi_force_set_keep(line->forces, line);
    for (int tight = 0; tight < 2; tight++) {
        line->tight = tight;
        if (cpsi_line_tension_field(line, line->forces, options, tight)) {
            cpsi_line_certify(line, options, &done);
            if (cps_outcome_is_certified(line->report.outcome)) {
                classify(line, program);
                return;
            }
        }
        cpsi_force_set_restore(line->forces, line);
        line->report.certificate = before;
        line->report.outcome = outcome;
    }
}

/* Does nothing change that could move the line?  Held ends where they were, obstacles that do not
 * turn, friction within its bounds. */
static bool nothing_moves(const CpsiLine *line, const CpsiStepOptions *options) {
    for (int end = 0; end < 2; end++) {
        const double *at = &line->reference[end == CPS_END_A ? 0 : 3 * (line->n - 1)],
                     *to = line->end[end].value;
        if (line->end[end].kind == CPS_END_HELD)
            for (int a = 0; a < 3; a++)
                if (at[a] != to[a]) return false;
    }
    for (int k = 0; k < line->obstacle_count; k++)
        if (line->turn[k] != 0) return false;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        double f[3], inside[3];
        const CpsiFrictionLaw set = cpsi_friction_law(line, c);
        const double bound = line->friction_bound[c];
        cpsi_frame_to(f, cpsi_line_axes(line, c), &line->friction_force[3 * c]);
        if (f[0] == 0 && f[1] == 0 && f[2] == 0) continue;
        /* a given set is not asked whether it holds F: the bound must be the one that held it, as
         * one that follows is */
        if (set.given && !(bound > 0 && options->friction == CPS_FRICTION_CONSISTENT)) return false;
        memcpy(inside, f, sizeof f);
        cpsi_friction_law_clip(&set, bound, bound, inside);
        const double out = hypot(f[0] - inside[0], f[1] - inside[1]) + fabs(f[2]);
        if (!(out <= CPSI_CLEAN * line->report.certificate.largest_force)) return false;
    }
    return true;
}

/* Is the line in equilibrium where it is, with the forces that it has?  Then it stays, and keeps
 * them: no motion is less than none. What has been told of the step before, in `before`, is true of
 * this one too, but that nothing slips. */
static bool stays(CpsiLine *line, const CpsiStepOptions *options, const CpsLineReport *before) {
    static const CpsiIpmReport nothing_left = {.outcome = CPSI_IPM_SOLVED};
    if (!options->least || options->frictionless || !(before->share > 0)) return false;
    line->report.certificate = cpsi_certificate(line, options->solver.tolerance);
    const double left =
        line->report.certificate.force_residual / line->report.certificate.largest_force;
    if (left > CPSI_CLEAN &&
        left <= CPSI_TOUCH) { /* the same loads, but normals turned when the line was laid on */
        cpsi_balance_forces(line);
        line->report.certificate = cpsi_certificate(line, options->solver.tolerance);
    }
    if (!nothing_moves(line, options)) return false;
    const CpsCertificate *c = &line->report.certificate;
    line->report.outcome = cpsi_line_outcome(line, options, &nothing_left);
    if (!cps_outcome_is_certified(line->report.outcome) ||
        !(c->gap <= fmax(AS_GOOD * before->certificate.gap, CPSI_TARGET * c->scale)))
        return false;
    for (int i = 0; i < cpsi_line_all_contacts(line); i++)
        if (line->state[i] == CPS_NODE_SLIP) line->state[i] = CPS_NODE_STICK;
    line->report.slack = before->slack;
    line->report.places =
        before->places == CPS_PLACES_UNIQUE ? CPS_PLACES_UNIQUE : CPS_PLACES_NEAREST;
    return true;
}

/* Where a line's ends are before a step: where they stay if there is no equilibrium. */
static void keep_ends(CpsiLine *line) {
    line->report = (CpsLineReport){.pierced = -1, .proof_obstacle = -1};
    for (int end = 0; end < 2; end++) {
        memcpy(line->report.end[end].position,
               &line->position[end == CPS_END_A ? 0 : 3 * (line->n - 1)], 3 * sizeof(double));
        line->report.end[end].range = (CpsTensionRange){CPS_RANGE_NONE, NAN, NAN, NAN, NAN};
    }
}

bool cpsi_line_step_slides_endlessly(CpsiLine *line, const CpsiStepOptions *options,
                                     double margin) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    if (options->friction != CPS_FRICTION_CONSISTENT || options->frictionless) return false;
    keep_ends(line);
    cpsi_line_set_reference(line, options);
    if (!cpsi_line_slides_endlessly(line, margin)) return false;
    line->report.outcome = CPS_OUTCOME_SLIDES;
    memset(line->friction_force, 0, 3 * contacts * sizeof *line->friction_force);
    memset(line->segment_force, 0, 3 * n * sizeof *line->segment_force);
    memset(line->tension, 0, n * sizeof *line->tension);
    return true;
}

bool cpsi_line_step_falls_short(CpsiLine *line, const CpsiStepOptions *options) {
    CpsiShortfall shortfall;
    if (!cpsi_line_falls_short(line, options, &shortfall)) return false;
    keep_ends(line);
    cpsi_line_set_reference(line, options);
    line->report.outcome = CPS_OUTCOME_INFEASIBLE;
    vec3_store(line->report.proof, shortfall.leaves);
    line->report.proof_value = shortfall.missing;
    line->report.proof_obstacle = shortfall.obstacle;
    return true;
}

/* The bend at which the mesh changes the law of friction most; beyond all friction it is no
 * answer. */
static void report_bend(CpsiLine *line) {
    line->report.bend = cpsi_line_bend(line);
    if (cps_outcome_is_certified(line->report.outcome) && cpsi_bend_locks(&line->report.bend))
        line->report.outcome = CPS_OUTCOME_MESH_TOO_COARSE;
}

void cpsi_line_step(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options) {
    const CpsLineReport before = line->report;
    keep_ends(line);
    remember(line);
    cpsi_line_set_reference(line, options);
    if (stays(line, options, &before)) {
        cpsi_line_pierces(line, &line->report.pierced);
        cpsi_line_report_ends(line);
        cpsi_line_report_lengths(line);
        line->report.tension_mesh = cpsi_mesh_error(line);
        report_bend(line);
        return;
    }
    line->report.certificate = (CpsCertificate){0};
    line->report.outcome = CPS_OUTCOME_SOLVED;
    if (cpsi_line_has_no_equilibrium(line, options)) return;
    solve_with_fallbacks(line, program, options);
    if (!is_finite(line) || !cpsi_line_is_near(line)) reset_to_reference(line, options);
    if (line->report.places == CPS_PLACES_NEAREST) cpsi_least_motion_restate(line, program);
    cpsi_line_pierces(line, &line->report.pierced);
    classify(line, program);
    choose_forces(line, program, options);
    /* contacts that are free may have come to other obstacles in the last round; the forces of the
     * others are those that were certified */
    const bool looked = line->has_local_axes &&
                        (options->friction == CPS_FRICTION_CONSISTENT || options->frictionless);
    if ((looked || line->frozen) && line->contacts > 1) {
        cpsi_contact_detect(line, true);
        cpsi_contact_update_geometry(line);
    }
    if (looked) cpsi_contact_clear_undetermined_slip(line);
    cpsi_line_report_ends(line);
    cpsi_line_report_lengths(line);
    line->report.tension_mesh = cpsi_mesh_error(line);
    report_bend(line);
}
