/* SPDX-License-Identifier: BSD-3-Clause */
/* Rounds of a step (rounds.h). */
#include "cable/rounds.h"

#include <math.h>
#include <string.h>

#include "cable/contact.h"
#include "cable/contact_detection.h"
#include "cable/friction_law.h"
#include "cable/line_solve.h"
#include "cable/obstacle_side.h"
#include "chain/frame.h"

/* Rounds that converge, their axes turning by no more than AXES_CONVERGING [rad] in one, may be as
 * many as this. */
static const int MAX_CONVERGING_ROUNDS = 60;
static const double AXES_CONVERGING = 1e-2;
/* Newton's method is given up in a step after so many failures in a row. */
enum { GIVEN_UP = 2 };
/* The rounds end when no touching node's axes turned by more than this [rad] in the last. */
static const double AXES_TOL = 1e-10;
/* ... or, without having halved it, by no more than this: solutions of programs that differ by less
 * differ by what the loop leaves. */
static const double AXES_ROUNDING = 2e-9;
/* Below this angle [rad] the error after a round is linear in the error before it. */
static const double AXES_LINEAR = 0.1;
/* Rounds in which the axes turn by more than this [rad] find no direction for a line that nothing
 * holds across itself. */
static const double AXES_SCATTERED = 0.5;
/* Rounds with drag that no longer turn the axes by more than this [rad] are asked for their
 * certificate before the drag is changed. */
static const double AXES_SETTLED = 1e-5;
/* ... and trial bounds differ by no more than this share, in sum, from mu R. */
static const double BOUND_TOL = 1e-11;
/* Trial bounds that have not come nearer to mu R by this share in so many rounds that hardly turn
 * the axes any more do not: of a node that is jammed there may be none. */
static const double BOUND_NEARER = 0.9;
enum { BOUND_PATIENCE = 6 };
/* [-] The drag changes by factors of 4. The least value has an effect on a line with a tension of
 * order one over its length; with the largest the line hardly moves in all these rounds. */
static const double LEAST_DRAG = 0.25, MOST_DRAG = 1e4;

void cpsi_rounds_couple_bounds(CpsiLine *line) {
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        const double *axes = cpsi_line_axes(line, c);
        const CpsiFrictionLaw *law = &line->friction_law[c];
        const double within = line->friction_bound[c];
        double f[3];
        line->friction_bound[c] = isfinite(line->gap[c]) ? law->friction * line->reaction[c] : 0;
        cpsi_frame_to(f, axes, &line->friction_force[3 * c]);
        cpsi_friction_law_clip(law, within, line->friction_bound[c], f);
        cpsi_frame_from(&line->friction_force[3 * c], axes, f);
    }
}

/* Sum of |A - mu R| over the sum of mu R: the error of trial bounds. */
static double bound_mismatch(const CpsiLine *line) {
    double off = 0, all = 0;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (!isfinite(line->gap[c])) continue;
        const double follow = line->friction_law[c].friction * line->reaction[c];
        off += fabs(line->friction_bound[c] - follow);
        all += follow;
    }
    return all > 0 ? off / all : 0;
}

/* The bounds of the next round: mu R after one step of Newton's method from the last solution or,
 * if that fails, mu R. */
static void next_bounds(CpsiLine *line, CpsiChainProgram *program, double force) {
    const bool newton = cpsi_chain_program_couple_bounds(program);
    for (int k = 0; k < program->unilateral.count; k++) {
        const int c = program->unilateral.contact[k];
        const double foreseen = program->unilateral.z[k] + program->unilateral.dz[k],
                     now = program->unilateral.z[k];
        const double reaction = newton && isfinite(foreseen) ? fmax(0, foreseen) : now;
        line->friction_bound[c] =
            line->friction_law[c].friction * reaction * force * program->unilateral.weight[k];
    }
}

bool cpsi_rounds_refresh_axes(CpsiLine *line, bool sides, double *turned) {
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        double f[3];
        cpsi_frame_to(f, cpsi_line_axes(line, c), &line->friction_force[3 * c]);
        memcpy(&line->friction_force[3 * c], f, sizeof f);
    }
    const bool shortened = cpsi_contact_shorten(line, sides) < 1;
    *turned = cpsi_contact_move_base(line, sides);
    if (shortened) *turned = INFINITY;
    cpsi_contact_update_geometry(line);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        double f[3];
        cpsi_frame_from(f, cpsi_line_axes(line, c), &line->friction_force[3 * c]);
        memcpy(&line->friction_force[3 * c], f, sizeof f);
    }
    return !shortened;
}

/* One round: solve on the tangent planes at the base, without the stiffness of the reactions if the
 * program with it cannot be solved. */
static CpsiIpmReport solve_round(CpsiLine *line, CpsiChainProgram *program,
                                 const CpsiStepOptions *options, const CpsiRound *round) {
    const CpsiIpmReport ipm = cpsi_line_solve(line, program, options, round);
    if (cpsi_line_is_clean(&ipm) || !round->reaction_stiffness) return ipm;
    CpsiRound without = *round;
    without.reaction_stiffness = false;
    return cpsi_line_solve(line, program, options, &without);
}

/* A round as a strategy poses it. */
static CpsiRound first_round(const CpsiStepOptions *options, const CpsiStrategy *strategy,
                             CpsiBounds bounds) {
    return (CpsiRound){.bounds = bounds,
                       .guess = strategy->guess,
                       .reaction_stiffness = strategy->reaction_stiffness,
                       .centering = strategy->centering,
                       .least = strategy->least_motion ? options->least : NULL};
}

/* The base of the next round: where the last one ended, or extrapolated from several rounds that
 * converge. */
static void accelerate(CpsiLine *line, bool sides, double turned) {
    if (turned > AXES_LINEAR) {
        cpsi_anderson_start(&line->anderson, line->n, line->base);
        return;
    }
    memcpy(line->node_reaction, line->reaction, (size_t)line->n * sizeof *line->node_reaction);
    if (line->element_contacts > 0)
        for (int e = 0; e + 1 < line->n; e++)
            for (int j = e; j <= e + 1; j++)
                line->node_reaction[j] += line->reaction[cpsi_line_contacts(line) + e];
    cpsi_anderson_accelerate(&line->anderson, line->n, line->node_reaction, line->base);
    if (sides && cpsi_obstacle_side_share(line, line->position, line->base, 1) < 1)
        memcpy(line->base, line->position, 3 * (size_t)line->n * sizeof *line->base);
}

/* Rounds with trial bounds whose axes rest. */
typedef struct BoundWatch {
    double best; /* least error of the bounds */
    int waited;  /* rounds since it came down */
} BoundWatch;

/* Do the bounds no longer come nearer to mu R? */
static bool is_stuck(BoundWatch *watch, double off, double turned) {
    if (off <= BOUND_TOL || turned > AXES_SETTLED || off < BOUND_NEARER * watch->best) {
        watch->best = fmin(watch->best, off);
        watch->waited = 0;
        return false;
    }
    return ++watch->waited >= BOUND_PATIENCE;
}

/* Compute the certificate of the last round; is it certified? */
static bool certify_last_round(CpsiLine *line, const CpsiChainProgram *program,
                               const CpsiStepOptions *options, CpsiBounds bounds,
                               const CpsiIpmReport *ipm) {
    if (bounds != CPSI_BOUNDS_FIXED) cpsi_rounds_couple_bounds(line);
    /* not of frozen friction, which may act on what is open */
    const bool smooth = options->frictionless && line->has_local_axes;
    if (bounds != CPSI_BOUNDS_FIXED || line->keeps_reference_axes || smooth)
        cpsi_line_release_open_contacts(line, program);
    cpsi_line_certify(line, options, ipm);
    if (cps_outcome_is_certified(line->report.outcome) && cpsi_contact_bears_beyond(line))
        line->report.outcome = CPS_OUTCOME_STALLED;
    return cps_outcome_is_certified(line->report.outcome);
}

void cpsi_rounds_end(CpsiLine *line, const CpsiChainProgram *program,
                     const CpsiStepOptions *options, CpsiBounds bounds, const CpsiIpmReport *ipm) {
    double turned;
    const bool arrived = cpsi_rounds_refresh_axes(line, !options->frictionless, &turned);
    if (certify_last_round(line, program, options, bounds, ipm) && !arrived)
        line->report.outcome = CPS_OUTCOME_STALLED;
}

/* The guess of the round after the one that was posed so. */
static CpsiGuess next_guess(const CpsiLine *line, const CpsiRound *posed,
                            const CpsiIpmReport *ipm) {
    const CpsiNewtonRecord *newton = &line->newton;
    const bool given_up = posed->guess == CPSI_GUESS_NONE || newton->failed >= GIVEN_UP;
    return given_up || !cpsi_line_is_clean(ipm) ? CPSI_GUESS_NONE : CPSI_GUESS_BASE;
}

/* Begin where the last move leads, as if a round had ended there. */
static CpsiGuess predict_base(CpsiLine *line, const CpsiChainProgram *program, bool sides) {
    double turned;
    cpsi_warm_step_predict(line, program);
    (void)cpsi_rounds_refresh_axes(line, sides, &turned);
    return CPSI_GUESS_PREDICTED;
}

bool cpsi_tangent_plane_rounds(CpsiLine *line, CpsiChainProgram *program,
                               const CpsiStepOptions *options, const CpsiStrategy *strategy,
                               CpsiBounds bounds) {
    const bool watched = strategy->patience > 0;
    CpsiRound posed = first_round(options, strategy, bounds);
    CpsiIpmReport ipm = {.outcome = CPSI_IPM_STALLED};
    double turned = line->has_local_axes ? INFINITY : 0, off = 0, best = INFINITY;
    /* a line placed by statics may pass obstacles */
    const bool sides = !options->frictionless && !strategy->across;
    /* in statics the loop alone finds a place, and Newton's method what is left of it once the axes
     * rest: in a groove, where nothing but tension holds a node along it, the loop's gap is the
     * square of an error of the place */
    const bool placed = options->frictionless && line->has_local_axes;
    bool arrived = true, scattered = line->has_local_axes, was_still = false;
    BoundWatch bounds_watch = {.best = INFINITY};
    int since = 0;
    if (posed.guess == CPSI_GUESS_EXTRAPOLATED && line->has_local_axes &&
        !line->keeps_reference_axes)
        posed.guess = predict_base(line, program, sides);
    for (int round = 0, most = strategy->rounds; round < most; round++) {
        if (line->has_local_axes && posed.bounds != CPSI_BOUNDS_TRIAL && strategy->acceleration)
            accelerate(line, sides, turned);
        if (line->has_local_axes) {
            cpsi_contact_detect(line, false);
            cpsi_contact_update_geometry(line);
        }
        const bool is_last = !placed || turned <= AXES_SETTLED;
        if (placed) posed.guess = is_last ? CPSI_GUESS_LATER : CPSI_GUESS_NONE;
        ipm = solve_round(line, program, options, &posed);
        posed.guess = next_guess(line, &posed, &ipm);
        if (posed.bounds == CPSI_BOUNDS_COUPLED && !cpsi_line_is_clean(&ipm)) {
            posed.bounds = CPSI_BOUNDS_TRIAL;
            for (int c = 0; c < cpsi_line_all_contacts(line); c++)
                line->friction_bound[c] = line->reaction[c] = 0;
            ipm = solve_round(line, program, options, &posed);
        }
        if (posed.bounds == CPSI_BOUNDS_TRIAL) {
            off = bound_mismatch(line);
            next_bounds(line, program, cpsi_line_unit_force(line, posed.bounds));
        }
        if (posed.guess == CPSI_GUESS_BASE && line->has_local_axes)
            cpsi_warm_step_note_round(line, program);
        if (line->has_local_axes) arrived = cpsi_rounds_refresh_axes(line, sides, &turned);
        scattered &= turned > AXES_SCATTERED && isfinite(turned);
        if (cpsi_interrupt_seen(program->base.interrupt)) break;
        /* a program that cannot be solved to the last digits is not solved better again: the
         * certificate decides */
        const bool still = turned <= AXES_TOL && off <= BOUND_TOL;
        if (still && (was_still || (is_last && cpsi_line_is_clean(&ipm)))) break;
        was_still = still;
        if (posed.bounds == CPSI_BOUNDS_TRIAL && is_stuck(&bounds_watch, off, turned)) break;
        /* a guess that led nowhere: the step is taken again without it */
        if (strategy->guess >= CPSI_GUESS_REFERENCE && line->newton.failed >= GIVEN_UP &&
            turned > AXES_CONVERGING)
            break;
        if (turned <= AXES_CONVERGING && most < MAX_CONVERGING_ROUNDS &&
            (strategy->guess < CPSI_GUESS_REFERENCE || line->newton.failed == 0))
            most = MAX_CONVERGING_ROUNDS;
        const bool is_halved = turned < 0.5 * best;
        if (is_halved) {
            best = turned;
            since = round;
        }
        /* what is left is rounding: ask for the certificate */
        if (!is_halved && turned <= AXES_ROUNDING && off <= BOUND_TOL && cpsi_line_is_clean(&ipm) &&
            arrived && certify_last_round(line, program, options, posed.bounds, &ipm))
            return false;
        if (!watched) continue;
        if (round >= since + strategy->patience) break;
        if (arrived && posed.bounds != CPSI_BOUNDS_TRIAL && (round + 1) % strategy->patience == 0 &&
            certify_last_round(line, program, options, posed.bounds, &ipm))
            return false;
    }
    if (certify_last_round(line, program, options, posed.bounds, &ipm) && !arrived)
        line->report.outcome = CPS_OUTCOME_STALLED;
    return scattered;
}

/* Has a line with drag come to rest, as nearly as its certificate asks? */
static bool has_settled(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                        CpsiBounds bounds, const CpsiIpmReport *ipm, double turned) {
    return turned <= AXES_SETTLED && cpsi_line_is_clean(ipm) &&
           certify_last_round(line, program, options, bounds, ipm);
}

/* The progress of rounds with drag since the drag was changed. */
typedef struct Watch {
    double *from, *before; /* (n, 3) [m] bases when the drag was changed, and at the start of the
                              last round */
    double path;           /* [m] */
    double best;           /* least turn of axes [rad] */
    int waited;            /* rounds since it was last halved */
} Watch;

/* [m] Root mean square displacement of the nodes between two configurations (n, 3). */
static double rms_displacement(int n, const double *from, const double *to) {
    double sum = 0;
    for (int i = 0; i < 3 * n; i++) sum += (to[i] - from[i]) * (to[i] - from[i]);
    return sqrt(sum / n);
}

static void begin_watch(const CpsiLine *line, Watch *watch) {
    memcpy(watch->from, line->base, 3 * (size_t)line->n * sizeof *watch->from);
    watch->path = 0;
    watch->best = INFINITY;
    watch->waited = 0;
}

/* The next drag, after rounds that did not halve their turn: less where the line advances, more
 * where it goes to and fro. */
static double next_drag(const CpsiLine *line, const Watch *watch, double drag) {
    const bool is_advancing =
        rms_displacement(line->n, watch->from, line->base) > 0.5 * watch->path;
    if (is_advancing) return drag > LEAST_DRAG ? 0.25 * drag : 0;
    return fmax(4 * drag, LEAST_DRAG);
}

void cpsi_dragged_rounds(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                         const CpsiStrategy *strategy, CpsiBounds bounds, double drag) {
    CpsiRound posed = first_round(options, strategy, bounds);
    posed.drag = drag;
    CpsiIpmReport ipm = {.outcome = CPSI_IPM_STALLED};
    Watch watch = {.from = line->watched, .before = &line->watched[3 * line->n]};
    double turned = INFINITY;
    const bool sides = !options->frictionless; /* a line placed by statics may pass obstacles */
    bool arrived = true;
    begin_watch(line, &watch);
    for (int round = 0; round < strategy->rounds; round++) {
        accelerate(line, sides, watch.waited > 0 ? turned : INFINITY);
        memcpy(watch.before, line->base, 3 * (size_t)line->n * sizeof *watch.before);
        cpsi_contact_detect(line, false);
        cpsi_contact_update_geometry(line);
        ipm = cpsi_line_solve(line, program, options, &posed);
        arrived = cpsi_rounds_refresh_axes(line, sides, &turned);
        if (cpsi_interrupt_seen(program->base.interrupt)) break;
        if (turned <= AXES_TOL && cpsi_line_is_clean(&ipm)) break;
        watch.path += rms_displacement(line->n, watch.before, line->base);
        if (turned < 0.5 * watch.best) {
            watch.best = turned;
            watch.waited = 0;
        }
        if (++watch.waited <= strategy->patience) continue;
        if (arrived && has_settled(line, program, options, bounds, &ipm, turned)) return;
        if (posed.drag > MOST_DRAG) break;
        posed.drag = next_drag(line, &watch, posed.drag);
        begin_watch(line, &watch);
    }
    if (certify_last_round(line, program, options, bounds, &ipm) && !arrived)
        line->report.outcome = CPS_OUTCOME_STALLED;
}
