/* SPDX-License-Identifier: BSD-3-Clause */
/* One step of one line (S90 problem P4.2, with A frozen from the reference or coupled to the
 * reaction):
 *
 *   1. Take the reference x_R, the friction bounds w = mu R_R where the reference touches, gaps and
 *      loads (cpsi_line_set_reference). A line in equilibrium there stays (standstill.c), and one
 *      that provably has no equilibrium is reported so (existence.c).
 *   2. Solve the step as a conic program (step_program.c, line_solve.c), or as a sequence of them
 *      on tangent planes (rounds.c), by the strategies of the table below.
 *   3. Choose among forces that the position does not determine (tension_field.c), classify the
 *      nodes and report.
 *
 * Consistent friction is solved in one program, the bound of each friction disc coupled to the
 * reaction beside it (chain/friction_disc.c). That problem is no minimisation, and the loop may
 * stall. Then the bounds are found in rounds, each a convex step with the mu R of the last round.
 *
 * On curved obstacles, or where friction has directions along the line, each round is such a
 * program on the tangent planes at the position where the last one ended: the inequalities are kept
 * whole, and normals and axes turn from round to round. The rounds converge where the equilibrium
 * is stable (docs/theory.md 2.4). They are accelerated (anderson.h); where that does not converge,
 * plain rounds or rounds with drag are tried. The remaining error of the last round shows in the
 * certificate, which is computed at the position reached, with its own normals. Frozen friction
 * keeps the bounds and axes of the reference, as in S90; with contact of the reference it keeps the
 * planes of the reference too. */
#include "cable/line_step.h"

#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "cable/bend.h"
#include "cable/caught.h"
#include "cable/certificate.h"
#include "cable/contact.h"
#include "cable/contact_detection.h"
#include "cable/end_set.h"
#include "cable/endless_slide.h"
#include "cable/existence.h"
#include "cable/field.h"
#include "cable/flow.h"
#include "cable/held.h"
#include "cable/line_solve.h"
#include "cable/mesh_error.h"
#include "cable/moving_flow.h"
#include "cable/potential.h"
#include "cable/report.h"
#include "cable/rounds.h"
#include "cable/shortfall.h"
#include "cable/soft.h"
#include "cable/standstill.h"
#include "cable/strategy.h"
#include "cable/tension_field.h"
#include "cable/turning_flow.h"
#include "cable/winch.h"
#include "ipm/ipm.h"

/* strategies ----------------------------------------------------------------------------------- */

/* What a step is like, and so which strategies are of use. */
enum {
    LOCAL_AXES = 1,    /* normals and axes change from place to place (line.h) */
    STATIC_ROUNDS = 2, /* ... and the initial configuration is computed by statics */
    FROZEN = 4,        /* ... and friction keeps the bounds and axes of the reference */
    ROUNDS = 8,        /* it is solved in rounds on tangent planes, not as one program */
    ISOTROPIC = 16,    /* ... and there is an obstacle whose friction has no directions */
    CHOSE = 32         /* the rule of least motion chose among places in the last attempt */
};

/* In the order tried, until one gives a certified answer. */
static const CpsiStrategy STRATEGY[] = {
    /* accelerated rounds, or one program where nothing turns */
    {.unless = STATIC_ROUNDS,
     .rounds = 12,
     .acceleration = true,
     .least_motion = true,
     .centering = true},
    /* places as they are found: the rule of least motion may prevent convergence */
    {.when = CHOSE, .unless = STATIC_ROUNDS, .rounds = 12, .acceleration = true, .centering = true},
    /* many plain rounds: a line without tension has no place of its own to converge to. Statics
     * starts here */
    {.when = LOCAL_AXES, .rounds = 100, .patience = 20, .least_motion = true, .centering = true},
    /* Newton's method for the rounds, and no steps to the centre: where hardly any force is left,
     * the centre may lie farther from the boundary than the tolerance allows. Not in statics, where
     * it finds equilibria on a crest that the line would leave (docs/theory.md 2.4) */
    {.unless = STATIC_ROUNDS,
     .rounds = 12,
     .acceleration = true,
     .least_motion = true,
     .reaction_stiffness = true},
    /* trial bounds: where what rests in a corner has many solutions, the loop with coupled bounds
     * ends far from the boundary */
    {.when = LOCAL_AXES,
     .unless = STATIC_ROUNDS | FROZEN,
     .rounds = 12,
     .acceleration = true,
     .least_motion = true,
     .centering = true,
     .trial_bounds = true},
    /* tangents that are kept: where a slack line may lie in many ways, its direction changes from
     * round to round, which isotropic friction need not follow. Then Newton's method with them */
    {.when = LOCAL_AXES | ISOTROPIC,
     .unless = STATIC_ROUNDS | FROZEN,
     .rounds = 12,
     .acceleration = true,
     .least_motion = true,
     .centering = true,
     .keeps_tangents = true},
    {.when = LOCAL_AXES | ISOTROPIC,
     .unless = STATIC_ROUNDS | FROZEN,
     .rounds = 12,
     .acceleration = true,
     .least_motion = true,
     .reaction_stiffness = true,
     .keeps_tangents = true},
    /* rounds with drag, for those that go to and fro or have far to go. The nearest place is not
     * the one on the way */
    {.when = ROUNDS,
     .rounds = 200,
     .patience = 10,
     .acceleration = true,
     .centering = true,
     .drag = true},
};

/* With contact of the reference, (35) keeps out of an obstacle only what touched it, and so its
 * solution may lie across one. */
static const CpsiStrategy ACROSS = {
    .rounds = 100, .patience = 20, .least_motion = true, .centering = true, .across = true};

static unsigned conditions(const CpsiLine *line, const CpsiStepOptions *options) {
    const bool consistent = options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT;
    unsigned found = options->least && options->least->chose ? CHOSE : 0;
    if (!line->has_local_axes) return found;
    found |= LOCAL_AXES;
    if (options->frictionless) found |= STATIC_ROUNDS;
    if (line->keeps_reference_axes) found |= FROZEN;
    if (consistent || options->frictionless || line->keeps_reference_axes) found |= ROUNDS;
    for (int k = 0; k < line->obstacle_count; k++)
        if (cpsi_obstacle_is_isotropic(&line->obstacle[k])) found |= ISOTROPIC;
    return found;
}

/* Solve one program on the planes of the reference. */
static CpsiIpmReport solve_program(CpsiLine *line, CpsiChainProgram *program,
                                   const CpsiStepOptions *options, const CpsiStrategy *strategy,
                                   bool coupled, bool may_be_rough) {
    const CpsiRound round = {.bounds = coupled ? CPSI_BOUNDS_COUPLED : CPSI_BOUNDS_FIXED,
                             .may_be_rough = may_be_rough,
                             .guess = strategy->guess,
                             .centering = strategy->centering,
                             .least = strategy->least_motion ? options->least : NULL};
    const CpsiIpmReport ipm = cpsi_line_solve(line, program, options, &round);
    cpsi_contact_plane_slip(line);
    if (coupled) cpsi_line_release_open_contacts(line, program);
    cpsi_line_certify(line, options, &ipm);
    return ipm;
}

/* Solve the step from its reference by one strategy, in rounds or as one program; `drag` is the
 * first one of rounds with drag. Returns whether the axes of the rounds were scattered
 * (rounds.h). */
static bool solve_once(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                       const CpsiStrategy *strategy, bool in_rounds, double drag) {
    const bool coupled = options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT &&
                         !options->frictionless && line->obstacle_count > 0;
    const CpsiBounds bounds = !coupled                 ? CPSI_BOUNDS_FIXED
                              : strategy->trial_bounds ? CPSI_BOUNDS_TRIAL
                                                       : CPSI_BOUNDS_COUPLED;
    if (strategy->drag) {
        cpsi_dragged_rounds(line, program, options, strategy, bounds, drag);
        return false;
    }
    if (in_rounds) return cpsi_tangent_plane_rounds(line, program, options, strategy, bounds);
    /* positions of inextensible lines are found to rounding, as are bounds on curved obstacles; and
     * what gives has no polish to refine them */
    const bool may_be_rough =
        !line->has_local_axes && line->compliance > 0 && !cpsi_line_has_soft(line);
    CpsiIpmReport ipm = solve_program(line, program, options, strategy, coupled, may_be_rough);
    if (line->is_rough && cps_outcome_is_certified(line->report.outcome)) return false;
    const bool rough = line->is_rough;
    const CpsCertificate *found = &line->report.certificate;
    line->newton.unpolished |= line->newton.polished && !(found->gap <= CPSI_TARGET * found->scale);
    if (rough || (line->newton.polished && line->newton.unpolished))
        ipm = solve_program(line, program, options, strategy, coupled, false);
    if (coupled && !cpsi_line_is_clean(&ipm))
        (void)cpsi_tangent_plane_rounds(line, program, options, strategy, CPSI_BOUNDS_TRIAL);
    return false;
}

enum { STRATEGIES = sizeof STRATEGY / sizeof *STRATEGY };

/* Rounds with kept tangents or with drag are tried next where the rounds before them scattered the
 * axes, or have cost so many iterations times nodes, a tenth of a second. The drag is then this one
 * at first, which is what lines take to which this happens. */
static const double DEAR_WORK = 2.5e5, NODES_BESIDE = 30, FIRST_DRAG = 16;

static bool is_for_scattered(const CpsiStrategy *strategy) {
    return strategy->drag || strategy->keeps_tangents;
}

/* The next strategy that is of use, in the order of the table from `first` on; where that is
 * `urged`, one for scattered axes. STRATEGIES: none is left. */
static int next_strategy(unsigned found, bool urged, int first, const bool tried[STRATEGIES]) {
    int next = STRATEGIES, for_scattered = STRATEGIES;
    for (int i = STRATEGIES; i-- > 0;) {
        const CpsiStrategy *strategy = &STRATEGY[i];
        if (tried[i] || (found & strategy->when) != strategy->when || (found & strategy->unless))
            continue;
        if (is_for_scattered(strategy)) for_scattered = i;
        if (i >= first) next = i;
    }
    return urged && for_scattered < STRATEGIES ? for_scattered : next;
}

/* Try the first strategy, its first program from a guess. */
static void solve_from(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                       CpsiGuess guess) {
    CpsiStrategy first = STRATEGY[0];
    first.guess = guess;
    if (options->least) options->least->chose = false;
    if (line->has_local_axes) cpsi_contact_reset(line);
    line->report.warm_count = 1;
    line->newton.failed = 0;
    (void)solve_once(line, program, options, &first, conditions(line, options) & ROUNDS, 0);
}

/* Was the attempt with Newton's method the first strategy itself? So it was where the method has
 * solved no program, and there are no rounds that it would have ended early. */
static bool was_first_strategy(const CpsiLine *line) {
    return line->newton.solved == 0 && !line->has_local_axes;
}

/* Try the first strategy with Newton's method. False where its answer is not certified, or less
 * accurate than that of the loop has to be, which the first strategy itself would be again. A line
 * that bends over a node and an element beside it has two equilibria, with the element before or
 * behind; which of them is on the way does not show where the last move leads, but in rounds from
 * the reference. */
static bool solve_warm(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                       CpsiGuess guess) {
    solve_from(line, program, options, guess);
    if (guess == CPSI_GUESS_EXTRAPOLATED && !line->inertia.is_moving &&
        cpsi_contact_holds_element(line))
        solve_from(line, program, options, CPSI_GUESS_REFERENCE);
    const CpsCertificate *found = &line->report.certificate;
    const bool good = cps_outcome_is_certified(line->report.outcome) &&
                      (was_first_strategy(line) || found->gap <= CPSI_TARGET * found->scale);
    cpsi_warm_step_note(line, good);
    return good;
}

/* Solve the step without keeping the line before obstacles. */
static void solve_across(CpsiLine *line, CpsiChainProgram *program,
                         const CpsiStepOptions *options) {
    if (line->has_local_axes) cpsi_contact_reset(line);
    if (options->least) options->least->chose = false;
    (void)solve_once(line, program, options, &ACROSS, true, 0);
}

/* Try the strategies that are of use, until one gives a certified answer; only one if the step is
 * known to fail. */
static void solve_with_fallbacks(CpsiLine *line, CpsiChainProgram *program,
                                 const CpsiStepOptions *options, CpsiGuess guess) {
    const size_t contacts = (size_t)cpsi_line_all_contacts(line);
    bool tried[STRATEGIES] = {false}, urged = false, again = false;
    int first = 0; /* after the last one of the others that was tried */
    line->newton.guessed = guess >= CPSI_GUESS_REFERENCE;
    line->strayed = false;
    if (line->newton.guessed) {
        if (solve_warm(line, program, options, guess)) return;
        line->newton.guessed = false;
        again = true;
        if (was_first_strategy(line)) first = 1;
        line->report.warm_count = 0;
        guess = CPSI_GUESS_NONE;
    }
    for (;; again = true) {
        const unsigned found = conditions(line, options);
        const int i = next_strategy(found, urged, first, tried);
        if (i == STRATEGIES) return;
        CpsiStrategy posed = STRATEGY[i];
        const CpsiStrategy *strategy = &posed;
        if (i == 0) posed.guess = guess;
        if (again) memset(line->reaction, 0, contacts * sizeof *line->reaction);
        if (options->least) options->least->chose = false;
        line->keeps_tangents = strategy->keeps_tangents;
        line->strayed = strategy->drag;
        if (line->has_local_axes) cpsi_contact_reset(line);
        const bool scattered =
            solve_once(line, program, options, strategy, found & ROUNDS, urged ? FIRST_DRAG : 0);
        const bool done = options->fails || cps_outcome_is_certified(line->report.outcome);
        if (!done && line->newton.polished && !line->newton.unpolished) {
            line->newton.unpolished = true; /* the same by the loop alone */
            continue;
        }
        urged = scattered || line->report.iteration_count * (line->n + NODES_BESIDE) > DEAR_WORK;
        tried[i] = true;
        if (!is_for_scattered(strategy)) first = i + 1;
        if (options->least && !strategy->least_motion) cpsi_places_as_found(line, program);
        if (done) return;
    }
}

/* Drag and potential follow the line to where it comes to be: the step is solved again with what
 * they are there, until that hardly changes. */
static void follow_loads(CpsiLine *line, CpsiChainProgram *program,
                         const CpsiStepOptions *options) {
    enum { MOST = 60 };
    const size_t contacts = (size_t)cpsi_line_all_contacts(line);
    for (int round = 0; round < MOST; round++) {
        const CpsCertificate *found = &line->report.certificate;
        if (!cps_outcome_is_certified(line->report.outcome) ||
            !(found->load_residual > CPSI_FOLLOWED * found->largest_force))
            break;
        if (line->field.flow) cpsi_line_approach_flow(line, round == 0);
        cpsi_potential_model(line, line->position);
        cpsi_line_set_loads(line);
        memset(line->reaction, 0, contacts * sizeof *line->reaction);
        if (line->has_local_axes) cpsi_contact_reset(line);
        solve_with_fallbacks(line, program, options, CPSI_GUESS_NONE);
    }
    if (!line->has_potential) return;
    const CpsiIpmReport done = {.outcome = CPSI_IPM_SOLVED};
    cpsi_potential_settle(line);
    cpsi_line_set_loads(line);
    if (cps_outcome_is_certified(line->report.outcome)) cpsi_line_certify(line, options, &done);
}

/* Take the line's part of a solution of the step together with other lines. */
static void take_joined(CpsiLine *line, const CpsiStepOptions *options) {
    const CpsiJoined *joined = line->joined;
    const CpsiChainProgram *program = joined->program;
    if (joined->base) {
        const size_t contacts = (size_t)cpsi_line_all_contacts(line);
        memcpy(line->base, joined->base, 3 * (size_t)line->n * sizeof *line->base);
        memcpy(line->obstacle_index, joined->obstacle_index,
               contacts * sizeof *line->obstacle_index);
        cpsi_contact_detect(line, false);
        cpsi_contact_update_geometry(line);
    }
    cpsi_step_program_unpack(line, program, &joined->scale);
    if (joined->scale.longer > 1) cpsi_line_straighten(line, joined->scale.longer - 1);
    for (int e = 0; e + 1 < line->n; e++) {
        if (cpsi_line_is_on_drum(line, e)) continue;
        for (int a = 0; a < 3; a++) line->segment_force[3 * e + a] += joined->shift[a];
    }
    line->report.iteration_count = joined->ipm.iterations;
    cpsi_places_as_found(line, program);
    if (joined->base) {
        cpsi_rounds_end(line, program, options, joined->scale.bounds, &joined->ipm);
        return;
    }
    cpsi_contact_plane_slip(line);
    if (joined->scale.bounds == CPSI_BOUNDS_COUPLED) cpsi_line_release_open_contacts(line, program);
    cpsi_line_certify(line, options, &joined->ipm);
}

/* The first answer of a step. */
static void solve_first(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                        CpsiGuess guess) {
    if (line->joined)
        take_joined(line, options);
    else if (options->across)
        solve_across(line, program, options);
    else
        solve_with_fallbacks(line, program, options, guess);
}

/* In time the forces of the flow are linear in each program, and follow the line and its velocity
 * from one to the next, so many times at most. */
enum { MOST_SWIMS = 60 };
static const CpsiIpmReport SWUM = {.outcome = CPSI_IPM_SOLVED};
/* A program after which another one is due is solved to this share of its errors. */
static const double ROUGHLY = 0.02;

/* Is the force that the loads of the line lack no more than is allowed, but for rounding in a flow?
 */
static bool is_within(const CpsiLine *line, double lack, double allowed) {
    return lack <= allowed ||
           (cpsi_line_swims(line) && lack <= allowed + cpsi_line_swim_rounding(line));
}

/* Has the flow, which is seen at the position, been that of the last program? */
static bool has_followed(const CpsiLine *line, double force, double *left) {
    double largest;
    *left = cpsi_line_swim_change(line, &largest);
    return is_within(line, *left, CPSI_FOLLOWED * fmax(force, largest));
}

/* Go on to the next program. */
static CpsiGuess approach(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                          double left) {
    cpsi_line_classify(line, program);
    cpsi_line_approach_swim(line, left);
    cpsi_line_set_loads(line);
    return cpsi_warm_step_go_on(line, program, options);
}

/* [N] The largest tension of the program's solution. */
static double largest_tension(const CpsiChainProgram *program, const CpsiStepScale *scale) {
    double most = 0;
    for (int i = 1; i < program->n; i++) most = cpsi_max_nan(most, program->segment.z[i][0]);
    return scale->force * most;
}

/* In the end the forces of the flow are given loads. */
static void end_swim(CpsiLine *line, double left) {
    cpsi_line_end_swim(line, left);
    cpsi_line_set_loads(line);
}

/* Solve the program that the flow has been seen for. */
static bool solve_turned(CpsiLine *line, CpsiChainProgram *program,
                         const CpsiStepOptions *options) {
    const size_t contacts = (size_t)cpsi_line_all_contacts(line);
    cpsi_line_set_loads(line);
    memset(line->reaction, 0, contacts * sizeof *line->reaction);
    if (line->has_local_axes) cpsi_contact_reset(line);
    solve_with_fallbacks(line, program, options, CPSI_GUESS_NONE);
    return cps_outcome_is_certified(line->report.outcome);
}

/* Newton's method for the places of the programs, from one of its starts. False: it finds none. */
static bool turn_from(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                      int start, double *left) {
    CpsiTurn turn = {.lack = INFINITY, .share = 1};
    cpsi_line_begin_turn(line, start);
    for (int round = 0; round < MOST_SWIMS; round++) {
        if (!solve_turned(line, program, options)) return false;
        if (has_followed(line, line->report.certificate.largest_force, left)) return true;
        if (!cpsi_line_turn_on(line, &turn)) return false;
    }
    return false;
}

/* Where the places of the programs do not converge by themselves. If none of the starts leads to a
 * solution, the line is left where the first program puts it. */
static void turn_swim(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                      double *left) {
    const int starts = cpsi_line_has_short_element(line) ? CPSI_TURN_STARTS : 1;
    for (int start = 0; start < starts; start++) {
        if (turn_from(line, program, options, start, left)) return;
        if (!cps_outcome_is_certified(line->report.outcome)) break;
    }
    cpsi_line_begin_turn(line, 0);
    (void)solve_turned(line, program, options);
    (void)has_followed(line, line->report.certificate.largest_force, left);
}

/* Do the loads of an answer lack no more of those of its place than the tolerance allows? */
static bool is_near(const CpsiLine *line, const CpsiStepOptions *options, double lack) {
    return is_within(line, lack,
                     options->solver.tolerance * line->report.certificate.largest_force);
}

/* Go on from the solution of the first program. */
static void follow_swim(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options) {
    const size_t contacts = (size_t)cpsi_line_all_contacts(line);
    double left;
    bool certified;
    int round = 0;
    for (;; round++) {
        certified = cps_outcome_is_certified(line->report.outcome);
        if (has_followed(line, line->report.certificate.largest_force, &left) || !certified ||
            round == MOST_SWIMS)
            break;
        const CpsiGuess guess = approach(line, program, options, left);
        if (guess == CPSI_GUESS_NONE) memset(line->reaction, 0, contacts * sizeof *line->reaction);
        if (line->has_local_axes) cpsi_contact_reset(line);
        solve_with_fallbacks(line, program, options, guess);
    }
    /* what the loads lack is within the tolerance: a start that leads nowhere would lack more */
    if (round > 0 && !(certified && is_near(line, options, left)))
        turn_swim(line, program, options, &left);
    const CpsOutcome outcome = line->report.outcome;
    end_swim(line, left);
    cpsi_line_certify(line, options, &SWUM);
    if (!cps_outcome_is_certified(outcome)) line->report.outcome = outcome;
}

/* Solve all programs by Newton's method in the planes of the reference, which are posed once, and
 * certify the last one alone. False where one is not solved so, or the answer is less accurate than
 * that of the loop has to be; it is posed again then. */
static bool swim(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                 CpsiGuess guess) {
    const bool coupled = options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT &&
                         !options->frictionless && line->obstacle_count > 0;
    const CpsiRound posed = {.bounds = coupled ? CPSI_BOUNDS_COUPLED : CPSI_BOUNDS_FIXED,
                             .share = ROUGHLY,
                             .guess = guess};
    CpsiStepScale scale;
    CpsiIpmReport newton = {.outcome = CPSI_IPM_STALLED};
    double left = 0;
    bool good = false;
    line->newton.guessed = true;
    line->strayed = false;
    line->report.warm_count = 1;
    line->newton.failed = 0;
    if (line->has_local_axes) cpsi_contact_reset(line);
    if (cpsi_line_pose_warm(line, program, &posed, &scale))
        newton = cpsi_line_solve_posed(line, program, options, &posed, &scale);
    for (int round = 0; newton.outcome == CPSI_IPM_SOLVED && round < MOST_SWIMS; round++) {
        good = has_followed(line, largest_tension(program, &scale), &left) &&
               newton.residual <= CPSI_CLEAN;
        if (good) break;
        cpsi_line_approach_swim(line, left);
        cpsi_step_program_fill_loads(line, program, &scale);
        newton = cpsi_line_solve_posed(line, program, options, &posed, &scale);
    }
    if (good) {
        cpsi_step_program_unpack(line, program, &scale);
        if (coupled) cpsi_line_release_open_contacts(line, program);
        end_swim(line, left);
        if (line->has_local_axes)
            cpsi_rounds_end(line, program, options, CPSI_BOUNDS_FIXED, &newton);
        else
            cpsi_line_certify(line, options, &SWUM);
        const CpsCertificate *found = &line->report.certificate;
        good = cps_outcome_is_certified(line->report.outcome) &&
               found->gap <= CPSI_TARGET * found->scale;
    }
    if (good) {
        cpsi_warm_step_note(line, true);
        return true;
    }
    line->newton.guessed = false;
    line->report.warm_count = 0;
    cpsi_line_begin_swim(line);
    cpsi_line_set_loads(line);
    return false;
}

/* A step in which the flow acts on the line as it moves. */
static void step_in_flow(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                         CpsiGuess guess) {
    /* on the planes of the reference to the end */
    const bool plain =
        !line->joined && !options->across && (!line->has_local_axes || cpsi_line_has_soft(line));
    cpsi_line_begin_swim(line);
    cpsi_line_set_loads(line);
    if (plain && guess >= CPSI_GUESS_REFERENCE) {
        if (swim(line, program, options, guess)) return;
        memset(line->reaction, 0, (size_t)cpsi_line_all_contacts(line) * sizeof *line->reaction);
        guess = CPSI_GUESS_NONE;
    }
    solve_first(line, program, options, guess);
    follow_swim(line, program, options);
}

/* Loads that are not those of the place are no answer. */
static void judge_loads(CpsiLine *line, const CpsiStepOptions *options) {
    if (cps_outcome_is_certified(line->report.outcome) &&
        !is_near(line, options, line->report.certificate.load_residual))
        line->report.outcome = CPS_OUTCOME_STALLED;
}

/* the step ------------------------------------------------------------------------------------- */

/* Are all numbers of the certificate finite? */
static bool is_finite(const CpsiLine *line) {
    const CpsCertificate *c = &line->report.certificate;
    return isfinite(c->primal) && isfinite(c->dual) && isfinite(c->gap) && isfinite(c->scale) &&
           isfinite(c->force_residual);
}

/* Reset the line to the reference, without forces: this is reported where arithmetic has broken
 * down or the solution is unbounded. */
static void reset_to_reference(CpsiLine *line, const CpsiStepOptions *options) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    const CpsiIpmReport none = {.outcome = CPSI_IPM_STALLED};
    memcpy(line->position, line->reference, 3 * n * sizeof *line->position);
    memset(line->friction_force, 0, 3 * contacts * sizeof *line->friction_force);
    memset(line->segment_force, 0, 3 * n * sizeof *line->segment_force);
    memset(line->friction_bound, 0, contacts * sizeof *line->friction_bound);
    memset(line->reaction, 0, contacts * sizeof *line->reaction);
    memset(line->tension, 0, n * sizeof *line->tension);
    cpsi_line_clear_set_reactions(line);
    if (cpsi_line_swims(line)) cpsi_line_settle_swim(line);
    cpsi_potential_model(line, line->position);
    cpsi_potential_settle(line);
    if (cpsi_line_swims(line) || line->has_potential) cpsi_line_set_loads(line);
    if (line->has_local_axes) {
        cpsi_contact_reset(line);
        cpsi_contact_update_geometry(line);
    }
    cpsi_line_certify(line, options, &none);
    line->report.outcome = CPS_OUTCOME_STALLED;
}

/* Rounds that end without an answer may leave held nodes on the way. What comes after the step
 * begins with them where they are held, as the points and bodies there do. */
static void put_held(CpsiLine *line, const CpsiStepOptions *options) {
    const CpsiIpmReport none = {.outcome = CPSI_IPM_STALLED};
    const CpsOutcome outcome = line->report.outcome;
    bool off = false;
    for (int j = cpsi_line_next_held(line, 0); j < line->n; j = cpsi_line_next_held(line, j + 1))
        off = off || !cpsi_vec3_is_zero(
                         vec3_sub(vec3_at(line->position, j), cpsi_line_held_place(line, j)));
    if (!off || (outcome != CPS_OUTCOME_STALLED && outcome != CPS_OUTCOME_ITERATION_LIMIT)) return;
    cpsi_line_put_held(line, line->position);
    cpsi_line_certify(line, options, &none);
    line->report.outcome = outcome;
}

/* Store the forces before the step, to which the tensions of an inextensible line and its reactions
 * in corners are to be nearest. */
static void store_forces_before(CpsiLine *line) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    if (!line->forces) return;
    memcpy(line->tension_before, line->tension, (n - 1) * sizeof *line->tension);
    memcpy(line->reaction_before, line->reaction, contacts * sizeof *line->reaction);
    if (line->has_local_axes)
        memcpy(line->obstacle_index_before, line->obstacle_index,
               contacts * sizeof *line->obstacle_index);
}

/* Free, stick and slip, and the sums that go with them. */
static void classify(CpsiLine *line, const CpsiChainProgram *program) {
    CpsLineReport *report = &line->report;
    report->slack = 0;
    cpsi_line_classify(line, program);
}

/* Where the position of an inextensible line does not determine its forces: choose those nearest to
 * the forces before the step, if they can be certified. On what gives the reactions follow from the
 * position, and the forces found are kept. */
static void choose_forces(CpsiLine *line, const CpsiChainProgram *program,
                          const CpsiStepOptions *options) {
    if (!line->forces || line->inertia.is_moving || cpsi_line_has_soft(line) ||
        cpsi_line_has_sets(line) || !cps_outcome_is_certified(line->report.outcome))
        return;
    const CpsiIpmReport done = {.outcome = CPSI_IPM_SOLVED};
    const CpsCertificate before = line->report.certificate;
    const CpsOutcome outcome = line->report.outcome;
    cpsi_force_set_keep(line->forces, line);
    for (int exact = 0; exact < 2; exact++) {
        line->exact = exact;
        if (cpsi_line_tension_field(line, line->forces, options, exact)) {
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

/* Report the ends of the line where they are before the step, which is where they stay if there is
 * no equilibrium. */
static void report_initial_ends(CpsiLine *line) {
    line->report = (CpsLineReport){.has_slipping = true};
    for (int end = 0; end < 2; end++) {
        memcpy(line->report.end[end].position,
               &line->position[end == CPS_END_A ? 0 : 3 * (line->n - 1)], 3 * sizeof(double));
    }
}

bool cpsi_line_step_slides_endlessly(CpsiLine *line, const CpsiStepOptions *options,
                                     double margin) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    if (options->friction_policy != CPS_FRICTION_POLICY_CONSISTENT || options->frictionless)
        return false;
    /* a field, or a load that belongs to a node, does not go along */
    if (line->has_field || line->has_node_loads) return false;
    report_initial_ends(line);
    cpsi_line_set_reference(line, options);
    if (!cpsi_line_slides_endlessly(line, margin)) return false;
    line->report.outcome = CPS_OUTCOME_SLIDES;
    memset(line->friction_force, 0, 3 * contacts * sizeof *line->friction_force);
    memset(line->segment_force, 0, 3 * n * sizeof *line->segment_force);
    memset(line->tension, 0, n * sizeof *line->tension);
    return true;
}

bool cpsi_line_step_outruns_bounds(CpsiLine *line, const CpsiStepOptions *options) {
    if (options->friction_policy != CPS_FRICTION_POLICY_FROZEN || options->frictionless)
        return false;
    report_initial_ends(line);
    cpsi_line_set_reference(line, options);
    return cpsi_line_outruns_frozen_bounds(line);
}

bool cpsi_line_step_is_caught(CpsiLine *line, const CpsiStepOptions *options) {
    CpsiCatch caught;
    if (!cpsi_line_is_caught(line, options, &caught)) return false;
    report_initial_ends(line);
    cpsi_line_set_reference(line, options);
    line->report.outcome = CPS_OUTCOME_INFEASIBLE;
    vec3_store(line->report.proof, caught.gate);
    line->report.proof_length = caught.missing;
    line->report.has_proof_obstacle = line->report.has_proof_plane = true;
    line->report.proof_obstacle = caught.ball;
    line->report.proof_plane = caught.plane;
    return true;
}

bool cpsi_line_step_falls_short(CpsiLine *line, const CpsiStepOptions *options) {
    CpsiShortfall shortfall;
    if (!cpsi_line_falls_short(line, options, &shortfall)) return false;
    report_initial_ends(line);
    cpsi_line_set_reference(line, options);
    line->report.outcome = CPS_OUTCOME_INFEASIBLE;
    vec3_store(line->report.proof, shortfall.leaves);
    line->report.proof_length = shortfall.missing;
    line->report.has_proof_obstacle = true;
    line->report.proof_obstacle = shortfall.obstacle;
    return true;
}

void cpsi_line_refuse_step(CpsiLine *line, const CpsiStepOptions *options, CpsOutcome outcome) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    report_initial_ends(line);
    cpsi_line_set_reference(line, options);
    line->report.outcome = outcome;
    line->report.substep_count = 1;
    line->report.share = 1;
    line->last_change.known = false;
    cpsi_line_clear_set_reactions(line);
    memset(line->friction_force, 0, 3 * contacts * sizeof *line->friction_force);
    memset(line->segment_force, 0, 3 * n * sizeof *line->segment_force);
    memset(line->tension, 0, n * sizeof *line->tension);
}

/* Report the bend at which the mesh changes the friction law most. If it holds any tension, the
 * step is not certified. */
static void report_bend(CpsiLine *line) {
    line->report.bend = cpsi_line_bend(line);
    if (cps_outcome_is_certified(line->report.outcome) && cpsi_bend_locks(&line->report.bend))
        line->report.outcome = CPS_OUTCOME_MESH_TOO_COARSE;
}

static void report_piercing(CpsiLine *line) {
    line->report.has_pierced_obstacle = cpsi_line_pierces(line, &line->report.pierced_obstacle) > 0;
}

/* The reference. What the water does to a line that moves is seen where the step in it begins. */
static void set_reference(CpsiLine *line, const CpsiStepOptions *options) {
    if (!cpsi_line_swims(line)) {
        cpsi_line_set_reference(line, options);
        return;
    }
    cpsi_contact_set_reference(line, options->contact_policy, options->friction_policy,
                               options->frictionless);
    cpsi_potential_model(line, line->position);
}

void cpsi_line_step(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options) {
    const CpsLineReport before = line->report;
    const CpsiGuess guess = cpsi_warm_step_guess(line, program, options);
    report_initial_ends(line);
    store_forces_before(line);
    set_reference(line, options);
    if (!line->joined && cpsi_line_stands_still(line, options, &before)) {
        cpsi_potential_settle(line);
        report_piercing(line);
        cpsi_line_report_ends(line);
        cpsi_line_report_lengths(line);
        line->report.has_tension_mesh = cpsi_mesh_error(line, &line->report.tension_mesh);
        report_bend(line);
        return;
    }
    line->report.certificate = (CpsCertificate){0};
    line->report.outcome = CPS_OUTCOME_SOLVED;
    if (!line->joined && cpsi_line_has_no_equilibrium(line, options)) return;
    if (cpsi_line_swims(line)) {
        step_in_flow(line, program, options, guess);
    } else {
        solve_first(line, program, options, guess);
        if (cpsi_line_loads_follow(line) && !line->joined) follow_loads(line, program, options);
    }
    judge_loads(line, options);
    if (!is_finite(line) || !cpsi_line_is_near(line) || cpsi_contact_bears_beyond(line))
        reset_to_reference(line, options);
    put_held(line, options);
    if (line->report.places == CPS_PLACES_NEAREST) cpsi_least_motion_restate(line, program);
    report_piercing(line);
    classify(line, line->joined ? line->joined->program : program);
    if (!line->joined) choose_forces(line, program, options);
    /* free contacts may be nearest to other obstacles after the last round; the other contacts keep
     * the forces that were certified */
    const bool looked =
        line->has_local_axes &&
        (options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT || options->frictionless);
    if ((looked || line->keeps_reference_axes) && line->contacts > 1) {
        cpsi_contact_detect(line, true);
        cpsi_contact_update_geometry(line);
    }
    if (looked) cpsi_contact_leave(line);
    if (looked) cpsi_contact_clear_undetermined_slip(line);
    cpsi_line_report_ends(line);
    cpsi_line_report_lengths(line);
    line->report.has_tension_mesh = cpsi_mesh_error(line, &line->report.tension_mesh);
    report_bend(line);
}
