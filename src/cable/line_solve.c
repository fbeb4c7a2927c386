/* SPDX-License-Identifier: BSD-3-Clause */
/* One program of a step and the check of its result (line_solve.h). */
#include "cable/line_solve.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "cable/certificate.h"
#include "cable/contact.h"
#include "cable/end_set.h"
#include "cable/field.h"
#include "cable/flow.h"
#include "cable/friction_set.h"
#include "cable/held.h"
#include "cable/moving_flow.h"
#include "cable/obstacle_side.h"
#include "cable/potential.h"
#include "cable/soft.h"
#include "chain/active_set.h"
#include "chain/frame.h"
#include "chain/polish.h"

/* A solution with a node farther away than this many line lengths is treated as unbounded. */
static const double MAX_DISPLACEMENT = 1e4;
/* Reference tensions above this multiple of the load scale count as prestress and set the force
 * scale. */
static const double PRESTRESS_FACTOR = 100;
/* ... if, where there are no other forces, their strain is above this: a smaller one is the
 * rounding error of |x'| <= 1. */
static const double LEAST_STRAIN = 1e-12;
/* Accuracy of positions relative to the length, and largest elongation of an inextensible
 * element. */
static const double POSITION_TOL = CPSI_TOUCH;
/* A rough solution is found to this share of the tolerance. */
static const double ROUGH = 0.01;
/* A reaction of an open contact below this share of the unit of force is rounding. */
static const double LEAST_REACTION = 1e-12;
/* On a plane Newton's method goes on from this gap; in rounds, whose first solutions are degenerate
 * more often, from that of the loop. */
static const double NEARLY = 1e-11;
/* ... or, with many nodes n, from this over n squared. A node that slips where it should rest, and
 * by as much as its neighbour, adds a force and a slip to the gap that both are a share 1/n of all,
 * and the set is found where the gap is less. */
static const double NEARLY_OF_NODES = 0.1;

void cpsi_line_set_loads(CpsiLine *line) {
    const CpsiNodeField *field = &line->field;
    for (int j = 0; j < line->n; j++) {
        const double length = cpsi_line_weight_length(line, j);
        for (int i = 3 * j; i < 3 * j + 3; i++) {
            line->load[i] = length * line->weight[i - 3 * j];
            if (!line->has_node_loads) continue;
            double all = field->load[i] + field->drag[i];
            if (line->has_potential) all += field->pull[i];
            if (line->has_inertia) all += field->added[i] + field->wave[i];
            field->all[i] = all;
            line->load[i] += all;
        }
    }
    for (int end = 0; end < 2; end++)
        if (line->end[end].kind == CPS_END_KIND_FREE)
            for (int a = 0; a < 3; a++)
                line->load[3 * (end == CPS_END_A ? 0 : line->n - 1) + a] += line->end[end].value[a];
    for (int k = 0; k < line->grasp_count; k++)
        if (line->grasp[k].imposed.kind == CPS_END_KIND_FREE)
            for (int a = 0; a < 3; a++)
                line->load[3 * line->grasp[k].node + a] += line->grasp[k].imposed.value[a];
}

void cpsi_line_set_reference(CpsiLine *line, const CpsiStepOptions *options) {
    cpsi_contact_set_reference(line, options->contact_policy, options->friction_policy,
                               options->frictionless);
    if (cpsi_line_swims(line))
        cpsi_line_settle_swim(line);
    else if (line->has_node_loads)
        cpsi_line_follow_flow(line, line->position);
    cpsi_potential_model(line, line->position);
    cpsi_line_set_loads(line);
}

bool cpsi_line_both_ends(const CpsiLine *line, CpsEndKind kind) {
    return line->end[CPS_END_A].kind == kind && line->end[CPS_END_B].kind == kind;
}

bool cpsi_line_is_taut(const CpsiLine *line) {
    bool taut = false;
    CpsiSpan span = {.to = 0};
    while (!taut && cpsi_line_next_span(line, span.to, &span))
        taut = cpsi_line_is_span_taut(line, &span);
    return taut;
}

/* The strain of the whole line at the tension T. */
static double mean_strain(const CpsiLine *line, double tension) {
    if (line->spring_count == 0 && !line->two.exists) return line->compliance * tension;
    double sum = 0;
    for (int e = 0; e + 1 < line->n; e++) {
        const CpsiElementLaw law = cpsi_line_law(line, e);
        sum += line->element_length[e] * cpsi_law_strain(&law, tension);
    }
    return sum / line->length;
}

/* The length at rest of the whole line over its natural length. */
static double rest_stretch(const CpsiLine *line) {
    if (!line->two.exists) return 1;
    double sum = 0;
    for (int e = 0; e + 1 < line->n; e++) sum += line->element_length[e];
    return sum / line->length;
}

/* The size of the forces of the field; where there are no others, and none at the reference, what
 * it would oppose to the moves of the held nodes. */
static double field_scale(const CpsiLine *line, double others) {
    double size = cpsi_line_field_size(line), stiffness = 0, most = 0;
    if (size > 0 || others > 0) return size;
    for (int j = 0; j < line->n; j++) {
        const double *k = &line->field.stiffness[6 * j];
        stiffness = fmax(stiffness, k[0] + k[2] + k[5]);
        if (cpsi_line_is_held(line, j))
            most = fmax(most, vec3_norm(vec3_sub(cpsi_line_held_place(line, j),
                                                 vec3_at(line->reference, j))));
    }
    return stiffness * most;
}

/* A force of the size of the tension to come: the largest of the weight, the forces applied, and
 * for a span between held nodes the T of a shallow line, phi(T) - (W/T)^2/24 = distance/L - 1, with
 * the largest strain of a span, its length being longer by a factor. 0 if there is no force at
 * all. */
static double force_scale(const CpsiLine *line, double longer) {
    double weight = line->length * vec3_norm(vec3_load(line->weight)), scale = weight, strain = -1;
    CpsiSpan span = {.to = 0};
    bool spans = false;
    longer *= rest_stretch(line);
    for (int j = 0; j < line->n; j++)
        scale = cpsi_max_nan(scale, vec3_norm(vec3_load(&line->load[3 * j])));
    if (cpsi_line_has_field(line)) scale = fmax(scale, field_scale(line, scale));
    for (; cpsi_line_next_span(line, span.to, &span); spans = true)
        strain = fmax(strain, span.distance / longer / span.length - 1);
    double distance, between;
    Vec3 apart;
    if (cpsi_line_has_sets(line) && cpsi_line_set_distance(line, &distance, &between, &apart)) {
        strain = fmax(strain, distance / longer / between - 1);
        spans = true;
    }
    if (!spans || (scale == 0 && strain <= 0)) return scale;
    /* the left side grows with T: bracket the root by doubling, then bisect */
    double low = scale > 0 ? scale : DBL_MIN, high = low;
    while (high < 1e300 &&
           mean_strain(line, high) - (weight / high) * (weight / high) / 24 < strain)
        high *= 2;
    for (int i = 0; i < 60 && high > 1.001 * low; i++) {
        const double middle = sqrt(low) * sqrt(high);
        if (mean_strain(line, middle) - (weight / middle) * (weight / middle) / 24 < strain)
            low = middle;
        else
            high = middle;
    }
    return high < 1e300 ? high : scale;
}

void cpsi_line_straighten(CpsiLine *line, double share) {
    CpsiSpan span = {.to = 0};
    while (cpsi_line_next_span(line, span.to, &span)) {
        if (line->compliance > 0 || span.distance < span.length * (1 - share)) continue;
        const Vec3 a = cpsi_line_held_place(line, span.from),
                   b = cpsi_line_held_place(line, span.to);
        for (int j = span.from + 1; j < span.to; j++) {
            const double along = (line->arc_length[j] - line->arc_length[span.from]) / span.length;
            vec3_store(&line->position[3 * j], vec3_axpy(along, vec3_sub(b, a), a));
        }
    }
}

bool cpsi_line_is_near(const CpsiLine *line) {
    for (int j = 0; j < 3 * line->n; j++)
        if (!(fabs(line->position[j] - line->reference[j]) <= MAX_DISPLACEMENT * line->length))
            return false;
    return true;
}

/* Contact of the reference knows the contacts of the reference only; there the straight path from
 * the reference must not pass an obstacle. */
static bool goes_straight(const CpsiLine *line, const CpsiStepOptions *options) {
    return line->has_local_axes && options->contact_policy == CPS_CONTACT_POLICY_REFERENCE &&
           !options->frictionless;
}

/* Can the step have moved the line so far, and does the line not penetrate obstacles? */
static bool is_in_place(const CpsiLine *line, const CpsiStepOptions *options) {
    const bool consistent =
        line->has_local_axes && options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT;
    /* an end is put into its set, which may be into an obstacle */
    const bool moved =
        cpsi_line_has_sets(line) && options->contact_policy == CPS_CONTACT_POLICY_REACHED;
    if ((consistent || moved || line->keeps_reference_axes) &&
        !(cpsi_contact_depth(line) <= 0.1 * CPSI_TOUCH * line->length))
        return false;
    /* contact of the reference restricts nodes that touched, and nothing else (S90 (35)) */
    if (line->contact_everywhere &&
        !(line->report.certificate.element_penetration <= 0.1 * CPSI_TOUCH * line->length))
        return false;
    if (consistent && !cpsi_friction_law_is_satisfied(line, options->solver.tolerance))
        return false;
    return cpsi_line_is_near(line);
}

/* Are the segments accurate even where other forces are large, so that the gap may hide their
 * errors? An element that pushes with P costs 2 P |e| l, of first order, and is held to the
 * tolerance of the largest force; one that is longer by x than its force makes it costs l x^2/(2c),
 * of second order, and is held to the tolerance's root. */
static bool segments_are_consistent(const CpsCertificate *c, double tolerance) {
    return c->element_push <= tolerance * c->largest_force &&
           c->elongation_residual <= sqrt(tolerance);
}

/* The loop's own residuals (tensions against elongations, positions against distances) must be well
 * below the tolerance too, but need not be below rounding. */
CpsOutcome cpsi_line_outcome(const CpsiLine *line, const CpsiStepOptions *options,
                             const CpsiIpmReport *ipm) {
    const CpsCertificate *c = &line->report.certificate;
    const double tolerance = options->solver.tolerance;
    const bool finite = isfinite(c->gap) && isfinite(c->scale) && isfinite(c->force_residual);
    const bool consistent = options->friction_policy == CPS_FRICTION_POLICY_FROZEN ||
                            c->friction_residual <= CPSI_CLEAN * c->largest_force;
    if (finite && consistent && ipm->residual <= fmax(0.01 * tolerance, CPSI_CLEAN) &&
        c->gap <= tolerance * c->scale && c->stretch_residual <= fmin(tolerance, POSITION_TOL) &&
        segments_are_consistent(c, tolerance) &&
        c->force_residual <= CPSI_CLEAN * c->largest_force && is_in_place(line, options)) {
        const bool taut = cpsi_line_is_taut(line);
        if (!goes_straight(line, options) ||
            !(cpsi_obstacle_side_share(line, line->reference, line->position, 1) < 1))
            return taut ? CPS_OUTCOME_TAUT : CPS_OUTCOME_SOLVED;
        if (!taut && cpsi_obstacle_passed(line, line->reference, line->position) >= 0)
            return CPS_OUTCOME_PASSES;
    }
    return ipm->outcome == CPSI_IPM_ITERATION_LIMIT ? CPS_OUTCOME_ITERATION_LIMIT
                                                    : CPS_OUTCOME_STALLED;
}

void cpsi_line_release_open_contacts(CpsiLine *line, const CpsiChainProgram *program) {
    const CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < unilateral->count; k++) {
        if (!(unilateral->z[k] < unilateral->s[k] &&
              unilateral->weight[k] * unilateral->z[k] < LEAST_REACTION))
            continue;
        if (line->keeps_reference_axes)
            line->reaction[unilateral->contact[k]] = 0;
        else
            cpsi_contact_clear(line, unilateral->contact[k]);
    }
}

void cpsi_line_certify(CpsiLine *line, const CpsiStepOptions *options, const CpsiIpmReport *ipm) {
    cpsi_balance_forces(line, options->friction_policy);
    line->report.certificate = cpsi_certificate(line, options->solver.tolerance);
    if (options->frictionless) line->report.certificate.friction_residual = 0;
    line->report.outcome = cpsi_line_outcome(line, options, ipm);
    line->report.has_proof_obstacle = line->report.outcome == CPS_OUTCOME_PASSES;
    if (line->report.has_proof_obstacle)
        line->report.proof_obstacle = cpsi_obstacle_passed(line, line->reference, line->position);
}

/* The tension of the reference by its own strain; 0 of an inextensible line. */
static double reference_tension(const CpsiLine *line) {
    double most = 0;
    if (line->compliance > 0)
        for (int e = 0; e + 1 < line->n; e++) {
            const Vec3 dx = vec3_sub(vec3_load(&line->reference[3 * (e + 1)]),
                                     vec3_load(&line->reference[3 * e]));
            const CpsiElementLaw law = cpsi_line_law(line, e);
            const double strain = vec3_norm(dx) / line->element_length[e] - 1;
            most = cpsi_max_nan(most, law.count > 0 ? cpsi_law_tension(&law, strain)
                                                    : strain / law.compliance);
        }
    return most;
}

double cpsi_line_unit_force(const CpsiLine *line, CpsiBounds bounds) {
    double force = force_scale(line, cpsi_line_is_taut(line) ? 1 + CPSI_TAUT_SLACK : 1), all = 0;
    const double before = line->obstacle_count > 0 ? reference_tension(line) : 0;
    if (before > PRESTRESS_FACTOR * force &&
        (force > 0 || before * line->compliance > LEAST_STRAIN))
        force = before;
    if (bounds == CPSI_BOUNDS_TRIAL)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++) all += line->friction_bound[c];
    return fmax(force, all);
}

bool cpsi_line_is_clean(const CpsiIpmReport *ipm) {
    return ipm->gap + fmax(ipm->residual, ipm->imbalance) <= CPSI_CLEAN;
}

/* The limit of iterations is for lines of up to FINE elements. On finer meshes the loop needs more
 * where a line rests slack by friction: on example 5.7 of S90, let down, 34 with 800 elements, 47
 * with 6400, 66 with 50 000 and 81 with 100 000. */
static int most_iterations(const CpsiLine *line, const CpsiStepOptions *options) {
    static const double FINE = 12800, PER_DOUBLING = 20;
    const double doublings = log2(line->n / FINE);
    return options->solver.max_iterations + (doublings > 0 ? (int)(PER_DOUBLING * doublings) : 0);
}

/* A line without loads: no force, no friction, no reaction, and the position of least motion. False
 * where there is no such position: then forces must hold the line. */
static bool rests_unloaded(CpsiLine *line, CpsiChainProgram *program,
                           const CpsiStepOptions *options, const CpsiRound *round) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    memcpy(line->position, line->reference, 3 * n * sizeof *line->position);
    cpsi_line_put_held(line, line->position);
    memset(line->friction_force, 0, 3 * contacts * sizeof *line->friction_force);
    memset(line->segment_force, 0, 3 * n * sizeof *line->segment_force);
    memset(line->reaction, 0, contacts * sizeof *line->reaction);
    memset(line->tension, 0, n * sizeof *line->tension);
    if (round->bounds != CPSI_BOUNDS_FIXED)
        memset(line->friction_bound, 0, contacts * sizeof *line->friction_bound);
    if (line->has_local_axes) memset(line->active, 0, contacts * sizeof *line->active);
    line->report.iteration_count +=
        cpsi_least_motion(line, round->least, NULL, round->bounds, most_iterations(line, options));
    if (line->report.places == CPS_PLACES_ANY) return false;
    cpsi_step_program_clear(line, program);
    return true;
}

/* [N] The largest force in the line or on it. */
static double largest_force(const CpsiLine *line) {
    double most = 0;
    for (int e = 0; e + 1 < line->n; e++)
        most = fmax(most, vec3_norm(vec3_load(&line->segment_force[3 * e])));
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) most = fmax(most, line->reaction[c]);
    for (int j = 0; cpsi_line_has_field(line) && j < line->n; j++)
        most = fmax(most, vec3_norm(cpsi_line_field_force(line, j, vec3_at(line->position, j))));
    return most;
}

/* Are the places that the solution of the program leaves unique? With tension in every element and
 * an end held they are. */
static bool is_unique(CpsiLine *line, const CpsiChainProgram *program, const CpsiRound *round) {
    if (line->inertia.is_moving) {
        line->report.places = CPS_PLACES_UNIQUE;
        return true;
    }
    cpsi_places_as_found(line, program);
    if (line->report.places == CPS_PLACES_UNIQUE && !cpsi_line_is_loose(line)) return true;
    if (!round->least) return false;
    const bool chose = round->least->chose;
    cpsi_least_motion(line, round->least, program, round->bounds, 0);
    round->least->chose = chose;
    return line->report.places == CPS_PLACES_UNIQUE;
}

/* Solve the program by Newton's method on the active set, where the places are unique. */
static CpsiIpmReport solve_by_newton(CpsiLine *line, CpsiChainProgram *program,
                                     const CpsiStepScale *scale, const CpsiRound *round,
                                     CpsiGuess guess, int max_iterations) {
    CpsiStepScale by_newton = *scale;
    by_newton.by_newton = true;
    cpsi_step_program_fill(line, program, &by_newton);
    cpsi_warm_step_start(line, program, scale, guess);
    CpsiIpmReport newton = cpsi_chain_active_set(program, max_iterations, false, 0);
    line->report.iteration_count += newton.iterations;
    if (newton.outcome != CPSI_IPM_SOLVED) return newton;
    cpsi_step_program_unpack(line, program, scale);
    if (!is_unique(line, program, round)) newton.outcome = CPSI_IPM_STALLED;
    return newton;
}

/* Note whether the method has solved a program. */
static void record(CpsiLine *line, bool solved) {
    CpsiNewtonRecord *of = &line->newton;
    of->tried++;
    of->solved += solved;
    of->began |= solved && of->tried == 1;
    of->failed = solved ? 0 : of->failed + 1;
}

/* ... from the guess of the round. */
static CpsiIpmReport solve_warm(CpsiLine *line, CpsiChainProgram *program,
                                const CpsiStepScale *scale, const CpsiRound *round,
                                int max_iterations) {
    const CpsiIpmReport newton =
        solve_by_newton(line, program, scale, round, round->guess, max_iterations);
    record(line, newton.outcome == CPSI_IPM_SOLVED);
    return newton;
}

/* May the last digits of the program be left to Newton's method: with tension everywhere, no
 * friction in the planes of the reference, and no contacts that it leaves out? The line holds the
 * solution of the loop. */
static bool can_polish(CpsiLine *line, const CpsiChainProgram *program, const CpsiRound *round) {
    const CpsiUnilateral *unilateral = &program->unilateral;
    if (line->keeps_reference_axes && program->disc.count + program->conic.count > 0) return false;
    for (int k = 0; k < unilateral->count; k++)
        if (unilateral->z[k] > unilateral->s[k] &&
            !cpsi_warm_step_treats(line, unilateral->contact[k]))
            return false;
    return is_unique(line, program, round);
}

/* Go on by Newton's method from the solution of the loop. The memory is that of what is read from
 * the program afterwards. */
static CpsiIpmReport polish(CpsiLine *line, CpsiChainProgram *program, const CpsiStepScale *scale,
                            int max_iterations) {
    const CpsiKept kept = {.u = line->position,
                           .points = line->friction_force,
                           .e = line->segment_force,
                           .tension = line->tension};
    for (int k = 0; k < program->conic.count; k++)
        program->disc.shape[program->disc.count + k] =
            cpsi_friction_set_shape(line->friction_law[program->conic.contact[k]].given);
    const CpsiIpmReport newton = cpsi_chain_polish(program, &kept, max_iterations);
    line->report.iteration_count += newton.iterations;
    line->newton.polished = newton.outcome == CPSI_IPM_SOLVED;
    if (line->newton.polished) cpsi_step_program_unpack(line, program, scale);
    return newton;
}

/* The sum of the loads of the program. */
static double sum_of_loads(const CpsiLine *line, const CpsiChainProgram *program) {
    double sum = 0;
    for (int i = 0; i < 3 * line->n; i++) sum += fabs(program->base.load[i]);
    return sum;
}

/* The sum of the loads in the unit of force, which energies are compared with: without what a stiff
 * field has at the reference, far above what it has at the solution, unless there is no other. */
static double given_loads(const CpsiLine *line, double loads, double unit) {
    double sum = 0;
    if (!cpsi_line_has_field(line)) return loads;
    for (int i = 0; i < 3 * line->n; i++) sum += fabs(line->load[i]);
    return sum > 0 ? sum / unit : loads;
}

/* Run the loop on the program, which has been written, or go on with it to refine its solution. */
static CpsiIpmReport run_loop(CpsiLine *line, CpsiChainProgram *program,
                              const CpsiStepOptions *options, const CpsiStepScale *scale,
                              double target, bool refined, bool goes_on) {
    const double unit = scale->force > 0 ? scale->force : 1,
                 loads = given_loads(line, sum_of_loads(line, program), unit);
    const CpsiIpmOptions ipm_options = {.target = target,
                                        .scale = loads > 0 ? loads : 1,
                                        .max_iterations = most_iterations(line, options),
                                        .centering_steps = refined ? CPSI_CENTERING_STEPS : 0,
                                        .sharpenings = refined ? CPSI_REFINEMENT_STEPS : 0,
                                        .goes_on = goes_on};
    const CpsiIpmReport ipm = cpsi_ipm_solve(&program->base, &ipm_options);
    cpsi_step_program_unpack(line, program, scale);
    line->report.iteration_count += ipm.iterations;
    return ipm;
}

/* Does Newton's method take the place of the loop's refinements, where it can? */
static bool is_polished(const CpsiLine *line, const CpsiStepOptions *options,
                        const CpsiRound *round) {
    return round->centering && !line->is_rough && !options->frictionless &&
           round->bounds != CPSI_BOUNDS_TRIAL && !round->reaction_stiffness && !(round->drag > 0) &&
           !cpsi_line_has_sets(line) && !cpsi_line_has_soft(line) && !line->newton.unpolished;
}

/* The gap from which Newton's method goes on with so many nodes. */
static double nearly(int nodes) {
    const double n = nodes;
    return fmax(CPSI_TARGET, fmin(NEARLY, NEARLY_OF_NODES / (n * n)));
}

bool cpsi_line_pose_warm(CpsiLine *line, CpsiChainProgram *program, const CpsiRound *round,
                         CpsiStepScale *scale) {
    const double force = cpsi_line_unit_force(line, round->bounds);
    if (!(force > 0) || cpsi_line_is_taut(line)) return false;
    line->is_rough = line->newton.polished = false;
    cpsi_line_clear_set_reactions(line);
    *scale = (CpsiStepScale){.length = line->length,
                             .force = force,
                             .longer = 1,
                             .bounds = round->bounds,
                             .by_newton = true};
    cpsi_step_program_fill(line, program, scale);
    cpsi_warm_step_start(line, program, scale, round->guess);
    return true;
}

CpsiIpmReport cpsi_line_solve_posed(CpsiLine *line, CpsiChainProgram *program,
                                    const CpsiStepOptions *options, const CpsiRound *round,
                                    const CpsiStepScale *scale) {
    const CpsiIpmReport newton =
        cpsi_chain_active_set(program, most_iterations(line, options), false, round->share);
    line->report.iteration_count += newton.iterations;
    record(line, newton.outcome == CPSI_IPM_SOLVED);
    if (newton.outcome != CPSI_IPM_SOLVED) return newton;
    cpsi_step_program_unpack_positions(line, program, scale);
    line->report.places = CPS_PLACES_UNIQUE;
    return newton;
}

CpsiIpmReport cpsi_line_solve(CpsiLine *line, CpsiChainProgram *program,
                              const CpsiStepOptions *options, const CpsiRound *round) {
    const bool taut = cpsi_line_is_taut(line);
    const double force = cpsi_line_unit_force(line, round->bounds);
    line->is_rough = line->newton.polished = false;
    cpsi_line_clear_set_reactions(line);
    if (!(force > 0) && round->least && rests_unloaded(line, program, options, round))
        return (CpsiIpmReport){.outcome = CPSI_IPM_SOLVED};
    CpsiStepScale scale = {.length = line->length,
                           .force = force > 0 ? force : 1,
                           .longer = taut ? 1 + CPSI_TAUT_SLACK : 1,
                           .bounds = round->bounds,
                           .reaction_stiffness = round->reaction_stiffness,
                           .drag = round->drag};
    const bool by_newton = round->guess != CPSI_GUESS_NONE && round->bounds != CPSI_BOUNDS_TRIAL &&
                           !round->reaction_stiffness && force > 0 && !taut;
    if (by_newton && round->guess != CPSI_GUESS_LATER) {
        const CpsiIpmReport newton =
            solve_warm(line, program, &scale, round, most_iterations(line, options));
        if (newton.outcome == CPSI_IPM_SOLVED) return newton;
    }
    line->report.warm_count = 0; /* the step is not warm */
    line->is_rough = round->may_be_rough && options->solver.tolerance > CPSI_RESOLVING;
    const bool refined = round->centering && !line->is_rough,
               polished = force > 0 && !taut && is_polished(line, options, round);
    const double target = line->is_rough                      ? ROUGH * options->solver.tolerance
                          : polished && !line->has_local_axes ? nearly(line->n)
                                                              : CPSI_TARGET;
    cpsi_step_program_fill(line, program, &scale);
    scale.force = force;
    CpsiIpmReport ipm =
        run_loop(line, program, options, &scale, target, refined && !polished, false);
    if (polished && ipm.outcome == CPSI_IPM_SOLVED) {
        if (can_polish(line, program, round)) {
            const CpsiIpmReport newton =
                polish(line, program, &scale, most_iterations(line, options));
            if (line->newton.polished && is_unique(line, program, round)) return newton;
        }
        if (line->newton.polished) {
            CpsiRound cold = *round;
            cold.guess = CPSI_GUESS_NONE;
            line->newton.unpolished = true;
            return cpsi_line_solve(line, program, options, &cold);
        }
        ipm = run_loop(line, program, options, &scale, CPSI_TARGET, refined, true);
    }
    line->report.places = CPS_PLACES_UNIQUE;
    if (!(sum_of_loads(line, program) > 0) && round->least &&
        largest_force(line) <= CPSI_CLEAN * force && rests_unloaded(line, program, options, round))
        return (CpsiIpmReport){.outcome = CPSI_IPM_SOLVED};
    if (taut)
        cpsi_line_straighten(line, CPSI_TAUT);
    else if (round->least && !round->reaction_stiffness && !(round->drag > 0) &&
             (line->is_rough || cpsi_line_is_clean(&ipm)))
        line->report.iteration_count +=
            cpsi_least_motion(line, round->least, program, round->bounds,
                              most_iterations(line, options));
    return ipm;
}
