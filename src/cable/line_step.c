/* SPDX-License-Identifier: BSD-3-Clause */
/* One step of one line (S90 problem P4.2, with A frozen from the reference or following the reaction), in four moves:
 *
 *   pose      reference x_R, friction bounds w = mu R_R where the reference touches, gaps, loads
 *   decide    is there an equilibrium at all?  An inextensible line shorter than the distance of its ends has none; a line
 *             with no end held needs friction and reactions that can carry its loads
 *   solve     write the step as a program (step_program.c), run ipm/
 *   conclude  back to world axes; balance the forces; classify nodes; certificate; report
 *
 * Consistent friction is solved in one go, the bound of each rub tied to the reaction beside it (ipm/rub.c). That problem is no
 * minimisation and may stall; then the bounds are found in rounds, each a convex step with the last round's mu R.
 *
 * On curved obstacles, or where friction follows the line's direction, each round is such a program on the tangent planes where the
 * last one ended: the inequalities are kept whole, normals and axes turn from round to round. Rounds come to rest where the equilibrium is
 * stable (docs/theory.md 2a); they look ahead (ahead.h), and where that does not settle they go slowly. What the last round leaves is in
 * the certificate, which is taken at the place reached, with its own normals. Frozen friction keeps the bounds and axes of the reference, as
 * S90 has it; strict contact beside it the planes of the reference too. */
#include "cable/line_step.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "cable/bend.h"
#include "cable/certificate.h"
#include "cable/contact.h"
#include "cable/line_report.h"
#include "cable/mesh_error.h"
#include "cable/rub_set.h"
#include "cable/side.h"
#include "cable/slides.h"
#include "cable/step_program.h"
#include "cable/tension_field.h"
#include "ipm/ipm.h"
#include "linsys/frame.h"

/* The interior point is driven to this relative gap: what the arithmetic allows, well below any tolerance asked. */
static const double TARGET = 1e-13;
/* Steps to the centre once there: what is left of a force's angle to its element is squared by each. */
static const int CENTRINGS = 2;
/* ... and towards smaller products where friction acts: each halves what a node at its limit creeps, and takes two digits off what the
 * force of one that slips lacks. */
static const int SHARPENINGS = 6;
/* Consistent friction whose bounds do not agree with mu R to this, or whose loop stops short of it, is solved again in rounds. */
static const double CLEAN = 1e-11;
/* |distance - L| <= TAUT L: an inextensible line is pulled straight, its tension has no upper bound. */
static const double TAUT = 1e-12;
/* No step takes a node this many lengths away: it was on its way to nowhere. */
static const double AFAR = 1e4;
/* A reference this much tighter than the loads and the ends explain. */
static const double HELD = 100;
/* ... and, where nothing else asks for any force, by more than this strain: less is what rounding leaves of |x'| <= 1. */
static const double LEAST_STRAIN = 1e-12;
/* A taut line's forces are those of a line longer by this share. */
static const double TAUT_SLACK = 1e-9;
/* Rounds on the tangent planes, and rounds with given bounds, before a step is given up. */
static const int ROUNDS = 12;
/* ... and of the slow way. */
static const int SLOW_ROUNDS = 100;
/* ... which end after so many that came no nearer, and ask their certificate as often: what has no tension may go on moving. */
static const int SLOW_PATIENCE = 20;
/* Rounds that close in, their axes turning by no more than CLOSING [rad] in one, may be as many as this. */
static const int MORE_ROUNDS = 60;
static const double CLOSING = 1e-2;
/* The rounds end when no touching node's axes turned by more than this [rad] in the last. */
static const double SETTLED = 1e-10;
/* A reaction below this share of the unit of force is rounding where the node is apart. */
static const double LEAST_REACTION = 1e-12;
/* From here on [rad] what a round leaves is linear in what it found. */
static const double NEAR = 0.1;
/* ... and bounds that were tried differ by no more than this share, in sum, from mu R. */
static const double MATCHED = 1e-11;

static bool both(const CpsiLine *line, CpsEndKind kind) {
    return line->end[CPS_END_A].kind == kind && line->end[CPS_END_B].kind == kind;
}

static double end_distance(const CpsiLine *line) {
    return vec3_norm(vec3_sub(vec3_load(line->end[CPS_END_B].value), vec3_load(line->end[CPS_END_A].value)));
}

/* pose ---------------------------------------------------------------------------------------------------------- */

/* Contact, and the loads: weight, half of each element to each of its nodes, and the forces at free ends. */
static void pose(CpsiLine *line, const CpsiStepOptions *options) {
    cpsi_contact_pose(line, options);
    for (int j = 0; j < line->n; j++)
        for (int a = 0; a < 3; a++) line->load[3*j + a] = cpsi_line_share(line, j)*line->weight[a];
    for (int end = 0; end < 2; end++)
        if (line->end[end].kind == CPS_END_FREE)
            for (int a = 0; a < 3; a++) line->load[3*(end == CPS_END_A ? 0 : line->n - 1) + a] += line->end[end].value[a];
}

/* decide -------------------------------------------------------------------------------------------------------- */

/* Ends farther apart than an inextensible line is long: a constant force along the ends is a proof. */
static bool too_short(CpsiLine *line) {
    if (line->compliance > 0 || !both(line, CPS_END_HELD)) return false;
    const Vec3 span = vec3_sub(vec3_load(line->end[CPS_END_B].value), vec3_load(line->end[CPS_END_A].value));
    const double distance = vec3_norm(span);
    if (!(distance > line->length*(1 + TAUT))) return false;
    line->report.outcome = CPS_INFEASIBLE;
    vec3_store(line->report.proof, vec3_scale(1/distance, span));
    line->report.proof_value = distance - line->length;
    return true;
}

/* No end held: a rigid translation v with B.v > sum w |v_T| lowers the energy for ever, B the sum of loads. The best v has
 * the part of B that friction cannot carry, and its normal part where the obstacle does not stop it. On one plane with isotropic
 * friction, or none; elsewhere the loop has to find out. */
static bool runs_away(CpsiLine *line, const CpsiStepOptions *options) {
    if (!both(line, CPS_END_FREE) || line->follows) return false;
    Vec3 sum = vec3(0, 0, 0);
    double friction = 0, steepest = 0, least = INFINITY, loads = 0;
    bool stopped = false;
    for (int j = 0; j < line->n; j++) {
        const Vec3 b = vec3_load(&line->load[3*j]);
        sum = vec3_add(sum, b);
        loads += vec3_norm(b);
        friction += line->friction_bound[j];
        const double coefficient = cpsi_rub_set(line, j).friction;
        steepest = fmax(steepest, coefficient), least = fmin(least, coefficient);
        stopped = stopped || isfinite(line->gap[j]);
    }
    const Vec3 n = vec3_load(&line->common[6]);
    const double normal = vec3_dot(sum, n), along = stopped && normal < 0 ? 0 : normal;
    const Vec3 tangent = vec3_axpy(-normal, n, sum);
    /* all reactions together balance B.n; at best they rest where friction is largest */
    if (options->friction == CPS_FRICTION_CONSISTENT && !options->frictionless) friction = steepest*fmax(0, -normal);
    const double pull = vec3_norm(tangent), beyond = pull > friction ? pull - friction : 0;
    const double fall = sqrt(beyond*beyond + along*along);
    if (!(fall > TAUT*loads)) return false;
    const Vec3 slide = pull > 0 ? vec3_scale(beyond/(pull*fall), tangent) : vec3(0, 0, 0);
    line->report.outcome = CPS_UNBOUNDED;
    vec3_store(line->report.proof, vec3_axpy(along/fall, n, slide));
    line->report.proof_value = fall;
    /* with bounds that follow the reactions these, which add up to what presses, would hold it wherever they are */
    const bool frozen = options->friction == CPS_FRICTION_FROZEN && !options->frictionless;
    if (frozen && along == 0 && pull <= least*-normal) line->report.coulomb = least*-normal;
    return true;
}

static bool is_taut(const CpsiLine *line) {
    return line->compliance == 0 && both(line, CPS_END_HELD) && end_distance(line) >= line->length*(1 - TAUT);
}

/* solve --------------------------------------------------------------------------------------------------------- */

/* A force of the size of the tension to come: the largest of the weight, the forces applied, and for two held ends the T
 * of a shallow line, c T - (W/T)^2/24 = distance/L - 1. 0 if nothing asks for any force. */
static double force_scale(const CpsiLine *line, double distance) {
    const double strain = distance/line->length - 1, c = line->compliance;
    double weight = line->length*vec3_norm(vec3_load(line->weight)), scale = weight;
    for (int j = 0; j < line->n; j++) scale = fmax(scale, vec3_norm(vec3_load(&line->load[3*j])));
    if (!both(line, CPS_END_HELD) || (scale == 0 && strain <= 0)) return scale;
    /* the left side grows with T: bracket by doubling, then halve */
    double low = scale > 0 ? scale : DBL_MIN, high = low;
    while (high < 1e300 && c*high - (weight/high)*(weight/high)/24 < strain) high *= 2;
    for (int i = 0; i < 60 && high > 1.001*low; i++) {
        const double middle = sqrt(low)*sqrt(high);
        if (c*middle - (weight/middle)*(weight/middle)/24 < strain) low = middle;
        else high = middle;
    }
    return high < 1e300 ? high : scale;
}

/* conclude ------------------------------------------------------------------------------------------------------ */

/* A taut line is straight, each element at its share of the span. */
static void straighten(CpsiLine *line) {
    const Vec3 a = vec3_load(line->end[CPS_END_A].value), b = vec3_load(line->end[CPS_END_B].value);
    for (int j = 1; j + 1 < line->n; j++)
        vec3_store(&line->position[3*j], vec3_axpy(line->arc_length[j]/line->length, vec3_sub(b, a), a));
}

/* Is the line no farther away than a step can take it? */
static bool is_near(const CpsiLine *line) {
    for (int j = 0; j < 3*line->n; j++)
        if (!(fabs(line->position[j] - line->reference[j]) <= AFAR*line->length)) return false;
    return true;
}

/* Is the line where the step can have taken it, and clear of the obstacles that keep it out?  Strict contact with frozen friction sees them
 * from the reference only, from where the line goes straight and passes none. */
static bool is_in_place(const CpsiLine *line, const CpsiStepOptions *options) {
    const bool consistent = line->follows && options->friction == CPS_FRICTION_CONSISTENT;
    if ((consistent || line->frozen) && !(cpsi_contact_depth(line) <= 0.1*CPSI_TOUCH*line->length)) return false;
    /* strict contact keeps out nodes that touched, and nothing else (S90 (35)) */
    if (line->gains && !(line->report.certificate.element_penetration <= 0.1*CPSI_TOUCH*line->length)) return false;
    const bool straight = line->follows && !consistent && !line->frozen && !options->frictionless;
    if (straight && cpsi_side_share(line, line->reference, line->position, 1) < 1) return false;
    if (consistent && !cpsi_law_holds(line, options->solver.tolerance)) return false;
    return is_near(line);
}

/* What the gap may hide where other forces are large. An element that pushes with P costs 2 P |e| l, of first order, and is held to the
 * tolerance of the largest force; one that is longer by x than its force makes it costs l x^2/(2c), of second order, and is held to the
 * tolerance's root. */
static bool is_a_line(const CpsCertificate *c, double tolerance) {
    return c->element_push <= tolerance*c->largest_force && c->elongation_residual <= sqrt(tolerance);
}

/* The iterate of the loop as a certified answer, or what it is instead. The loop's own residuals (tensions against
 * elongations, positions against distances) must be well below the tolerance too, but not below what rounding leaves. */
static CpsOutcome judge(const CpsiLine *line, const CpsiStepOptions *options, const CpsiIpmReport *ipm) {
    const CpsCertificate *c = &line->report.certificate;
    const double tolerance = options->solver.tolerance;
    const bool finite = isfinite(c->gap) && isfinite(c->scale) && isfinite(c->force_residual);
    const bool consistent = options->friction == CPS_FRICTION_FROZEN || c->friction_residual <= CLEAN*c->largest_force;
    if (finite && consistent && ipm->residual <= fmax(0.01*tolerance, CLEAN) && c->gap <= tolerance*c->scale &&
        c->stretch_residual <= tolerance && is_a_line(c, tolerance) && c->force_residual <= CLEAN*c->largest_force && is_in_place(line, options))
        return is_taut(line) ? CPS_TAUT : CPS_SOLVED;
    return ipm->outcome == CPSI_IPM_ITERATION_LIMIT ? CPS_ITERATION_LIMIT : CPS_STALLED;
}

/* What rounding leaves of the reaction of a node that is apart is none, nor is there friction, whose axes nothing holds there, unless they
 * are frozen. */
static void let_go(CpsiLine *line, const CpsiChainProgram *program) {
    const CpsiStop *stop = &program->stop;
    for (int k = 0; k < stop->count; k++) {
        if (!(stop->z[k] < stop->s[k] && stop->weight[k]*stop->z[k] < LEAST_REACTION)) continue;
        if (line->frozen) line->reaction[stop->contact[k]] = 0;
        else cpsi_contact_clear(line, stop->contact[k]);
    }
}

/* Balance the forces, and judge what has been found. */
static void certify(CpsiLine *line, const CpsiStepOptions *options, const CpsiIpmReport *ipm) {
    cpsi_balance_forces(line);
    line->report.certificate = cpsi_certificate(line, options->solver.tolerance);
    if (options->frictionless) line->report.certificate.friction_residual = 0;
    line->report.outcome = judge(line, options, ipm);
}

/* The tension of the reference by its own strain; 0 of an inextensible line. */
static double reference_tension(const CpsiLine *line) {
    double most = 0;
    for (int e = 0; e + 1 < line->n && line->compliance > 0; e++) {
        const Vec3 dx = vec3_sub(vec3_load(&line->reference[3*(e + 1)]), vec3_load(&line->reference[3*e]));
        most = fmax(most, (vec3_norm(dx)/line->element_length[e] - 1)/line->compliance);
    }
    return most;
}

/* The unit of force of a step, 0 where nothing asks for any. A line that was far tighter than its loads and ends say is held by
 * obstacles. Bounds that are tried can carry what they add up to. */
static double unit_force(const CpsiLine *line, CpsiBounds bounds) {
    double force = force_scale(line, end_distance(line)/(is_taut(line) ? 1 + TAUT_SLACK : 1)), all = 0;
    const double before = line->obstacle_count > 0 ? reference_tension(line) : 0;
    if (before > HELD*force && (force > 0 || before*line->compliance > LEAST_STRAIN)) force = before;
    for (int c = 0; c < cpsi_line_all_contacts(line) && bounds == CPSI_BOUNDS_TRIED; c++) all += line->friction_bound[c];
    return fmax(force, all);
}

static bool is_clean(const CpsiIpmReport *ipm) { return ipm->gap + fmax(ipm->residual, ipm->imbalance) <= CLEAN; }

/* A line that nothing loads: no force, no friction, no reaction, and the place of least motion. False where there is no such place: something
 * must hold it then. */
static bool rests_unloaded(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options, CpsiBounds bounds) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    memcpy(line->position, line->reference, 3*n*sizeof *line->position);
    for (int end = 0; end < 2; end++)
        if (line->end[end].kind == CPS_END_HELD)
            memcpy(&line->position[end == CPS_END_A ? 0 : 3*(n - 1)], line->end[end].value, sizeof line->end[end].value);
    memset(line->friction_force, 0, 3*contacts*sizeof *line->friction_force);
    memset(line->segment_force, 0, 3*n*sizeof *line->segment_force);
    memset(line->reaction, 0, contacts*sizeof *line->reaction);
    memset(line->tension, 0, n*sizeof *line->tension);
    if (bounds != CPSI_BOUNDS_GIVEN) memset(line->friction_bound, 0, contacts*sizeof *line->friction_bound);
    if (line->follows) memset(line->pressed, 0, contacts*sizeof *line->pressed);
    line->report.iterations += cpsi_least_motion(line, options->least, NULL, bounds, options->solver.max_iterations);
    if (line->report.places == CPS_PLACES_ANY) return false;
    cpsi_step_program_clear(line, program);
    return true;
}

/* Solve once, from the base of the line, and move to the nearest of the places that go with the forces. */
static CpsiIpmReport solve(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options, CpsiBounds bounds,
                           bool curved) {
    const bool taut = is_taut(line);
    const double force = unit_force(line, bounds);
    if (!(force > 0) && options->least && rests_unloaded(line, program, options, bounds))
        return (CpsiIpmReport){.outcome = CPSI_IPM_SOLVED};
    CpsiStepScale scale = {.force = force > 0 ? force : 1, .longer = taut ? 1 + TAUT_SLACK : 1, .bounds = bounds, .curved = curved};
    cpsi_step_program_fill(line, program, &scale);
    double loads = 0;
    for (int i = 0; i < 3*line->n; i++) loads += fabs(program->base.load[i]);
    const CpsiIpmOptions ipm_options = {
        .target = TARGET,
        .scale = loads > 0 ? loads : 1,
        .max_iterations = options->solver.max_iterations,
        .centrings = options->centrings,
        .sharpenings = options->centrings > 0 ? SHARPENINGS : 0};
    const CpsiIpmReport ipm = cpsi_ipm_solve(&program->base, &ipm_options);
    scale.force = force;
    cpsi_step_program_unpack(line, program, &scale);
    line->report.iterations += ipm.iterations;
    line->report.places = CPS_PLACES_UNIQUE;
    if (taut) straighten(line);
    else if (options->least && !curved && is_clean(&ipm))
        line->report.iterations += cpsi_least_motion(line, options->least, program, bounds, options->solver.max_iterations);
    return ipm;
}

/* Solve with bounds that follow the reactions or with the bounds of the line, on the planes of the pose. */
static CpsiIpmReport attempt(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options, bool follow) {
    const CpsiIpmReport ipm = solve(line, program, options, follow ? CPSI_BOUNDS_FOLLOW : CPSI_BOUNDS_GIVEN, false);
    cpsi_contact_slide(line);
    if (follow) let_go(line, program);
    certify(line, options, &ipm);
    return ipm;
}

/* The bounds mu R, and no friction beyond them. */
static void take_bounds(CpsiLine *line) {
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        const double *axes = cpsi_line_axes(line, c);
        const CpsiRubSet set = cpsi_rub_set(line, c);
        const double within = line->friction_bound[c];
        double f[3];
        line->friction_bound[c] = isfinite(line->gap[c]) ? set.friction*line->reaction[c] : 0;
        cpsi_frame_to(f, axes, &line->friction_force[3*c]);
        cpsi_rub_clip(&set, within, line->friction_bound[c], f);
        cpsi_frame_from(&line->friction_force[3*c], axes, f);
    }
}

/* Sum of |A - mu R| over that of mu R: how far given bounds are from following. */
static double mismatch(const CpsiLine *line) {
    double off = 0, all = 0;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (!isfinite(line->gap[c])) continue;
        const double follow = cpsi_rub_set(line, c).friction*line->reaction[c];
        off += fabs(line->friction_bound[c] - follow);
        all += follow;
    }
    return all > 0 ? off/all : 0;
}

/* The next round's bounds: mu R as Newton's method foresees it from the last solution, or simply mu R. */
static void next_bounds(CpsiLine *line, CpsiChainProgram *program, double force) {
    const bool newton = cpsi_chain_program_follow(program);
    for (int k = 0; k < program->stop.count; k++) {
        const int c = program->stop.contact[k];
        const double foreseen = program->stop.z[k] + program->stop.dz[k], now = program->stop.z[k];
        const double reaction = newton && isfinite(foreseen) ? fmax(0, foreseen) : now;
        line->friction_bound[c] = cpsi_rub_set(line, c).friction*reaction*force*program->stop.weight[k];
    }
}

/* Forces of touching nodes kept in their axes while these turn: from the axes of the solve to those at the place reached. False where the
 * line has not gone all its way. */
static bool look_again(CpsiLine *line, bool sides, double *turned) {
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        double f[3];
        cpsi_frame_to(f, cpsi_line_axes(line, c), &line->friction_force[3*c]);
        memcpy(&line->friction_force[3*c], f, sizeof f);
    }
    const bool shortened = cpsi_contact_shorten(line, sides) < 1;
    *turned = cpsi_contact_move(line, sides);
    if (shortened) *turned = INFINITY;
    cpsi_contact_look(line);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        double f[3];
        cpsi_frame_from(f, cpsi_line_axes(line, c), &line->friction_force[3*c]);
        memcpy(&line->friction_force[3*c], f, sizeof f);
    }
    return !shortened;
}

/* One round: solve where the line is, the reactions turning with their normals if that can be solved. */
static CpsiIpmReport solve_round(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options, CpsiBounds bounds, bool curved) {
    const CpsiIpmReport ipm = solve(line, program, options, bounds, curved);
    return is_clean(&ipm) || !curved ? ipm : solve(line, program, options, bounds, false);
}

/* The base of the next round: where the last one ended, or foreseen from several that close in. */
static void look_ahead(CpsiLine *line, bool sides, double turned) {
    if (turned > NEAR) {
        cpsi_ahead_start(&line->ahead, line->n, line->base);
        return;
    }
    memcpy(line->carries, line->reaction, (size_t)line->n*sizeof *line->carries);
    for (int e = 0; e + 1 < line->n && line->element_contacts > 0; e++)
        for (int j = e; j <= e + 1; j++) line->carries[j] += line->reaction[cpsi_line_contacts(line) + e];
    cpsi_ahead_foresee(&line->ahead, line->n, line->carries, line->base);
    if (sides && cpsi_side_share(line, line->position, line->base, 1) < 1)
        memcpy(line->base, line->position, 3*(size_t)line->n*sizeof *line->base);
}

/* The last round as an answer: is it one? */
static bool conclude(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options, CpsiBounds bounds,
                     const CpsiIpmReport *ipm) {
    if (bounds != CPSI_BOUNDS_GIVEN) take_bounds(line);
    if (bounds != CPSI_BOUNDS_GIVEN || line->frozen) let_go(line, program);
    certify(line, options, ipm);
    return cps_outcome_is_certified(line->report.outcome);
}

/* Rounds on tangent planes that move to where the nodes are. The bounds follow the reactions within each round; once the loop cannot
 * make them, they are tried: from no friction towards mu R. */
static void settle(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options, CpsiBounds bounds) {
    CpsiIpmReport ipm = {.outcome = CPSI_IPM_STALLED};
    double turned = line->follows ? INFINITY : 0, off = 0, best = INFINITY;
    const bool sides = !options->frictionless; /* statics comes from no side */
    bool arrived = true;
    int since = 0;
    for (int round = 0, most = options->slow ? SLOW_ROUNDS : ROUNDS; round < most; round++) {
        if (line->follows && bounds != CPSI_BOUNDS_TRIED && !options->slow) look_ahead(line, sides, turned);
        if (line->follows) cpsi_contact_meet(line, false), cpsi_contact_look(line);
        ipm = solve_round(line, program, options, bounds, options->turning);
        if (bounds == CPSI_BOUNDS_FOLLOW && !is_clean(&ipm)) {
            bounds = CPSI_BOUNDS_TRIED;
            for (int c = 0; c < cpsi_line_all_contacts(line); c++) line->friction_bound[c] = line->reaction[c] = 0;
            ipm = solve_round(line, program, options, bounds, options->turning);
        }
        if (bounds == CPSI_BOUNDS_TRIED) {
            off = mismatch(line);
            next_bounds(line, program, unit_force(line, bounds));
        }
        if (line->follows) arrived = look_again(line, sides, &turned);
        if (turned <= SETTLED && off <= MATCHED && is_clean(&ipm)) break;
        if (turned <= CLOSING && most < MORE_ROUNDS) most = MORE_ROUNDS;
        if (turned < 0.5*best) best = turned, since = round;
        if (options->slow && round >= since + SLOW_PATIENCE) break;
        if (options->slow && arrived && bounds != CPSI_BOUNDS_TRIED && (round + 1)%SLOW_PATIENCE == 0 &&
            conclude(line, program, options, bounds, &ipm))
            return;
    }
    if (conclude(line, program, options, bounds, &ipm) && !arrived) line->report.outcome = CPS_STALLED;
}

/* The step as it is posed, in one go or in rounds. */
static void solve_step(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options) {
    const bool consistent = options->friction == CPS_FRICTION_CONSISTENT;
    const bool follow = consistent && !options->frictionless && line->obstacle_count > 0;
    if (line->follows && (consistent || options->frictionless || line->frozen)) {
        settle(line, program, options, !follow ? CPSI_BOUNDS_GIVEN : options->trying ? CPSI_BOUNDS_TRIED : CPSI_BOUNDS_FOLLOW);
    } else {
        const CpsiIpmReport ipm = attempt(line, program, options, follow);
        if (follow && !is_clean(&ipm)) settle(line, program, options, CPSI_BOUNDS_TRIED);
    }
}

/* Is every number of the answer one? */
static bool is_finite(const CpsiLine *line) {
    const CpsCertificate *c = &line->report.certificate;
    return isfinite(c->primal) && isfinite(c->dual) && isfinite(c->gap) && isfinite(c->scale) && isfinite(c->force_residual);
}

/* Back to the reference, without forces: what is reported where arithmetic has broken down, or the line was on its way to nowhere. */
static void forget(CpsiLine *line, const CpsiStepOptions *options) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    const CpsiIpmReport none = {.outcome = CPSI_IPM_STALLED};
    memcpy(line->position, line->reference, 3*n*sizeof *line->position);
    memset(line->friction_force, 0, 3*contacts*sizeof *line->friction_force);
    memset(line->segment_force, 0, 3*n*sizeof *line->segment_force);
    memset(line->friction_bound, 0, contacts*sizeof *line->friction_bound);
    memset(line->reaction, 0, contacts*sizeof *line->reaction);
    memset(line->tension, 0, n*sizeof *line->tension);
    if (line->follows) {
        cpsi_contact_return(line);
        cpsi_contact_look(line);
    }
    certify(line, options, &none);
    line->report.outcome = CPS_STALLED;
}

/* Solve in one way or another: with places as they are found, should the rule of least motion be in the way; slowly, where a line without
 * tension has no place of its own to settle at; with reactions that turn with their normals late, and not in statics, because they have a
 * line stay on a crest that it would leave; then also without centrings: where hardly any force is left, the centre may lie farther from
 * the boundary than the tolerance lets it. Last with bounds that are tried: where what rests in a corner has many answers, the loop with
 * bounds that follow ends far from the boundary. */
static void try_ways(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options) {
    enum { QUICK, AS_FOUND, SLOW, TURNING, TRYING, WAYS };
    const int first = line->follows && options->frictionless ? SLOW : QUICK;
    for (int way = first; way < WAYS; way++) {
        if (way == AS_FOUND && !(options->least && options->least->chose)) continue; /* all places were as they were found */
        if (way == SLOW && !line->follows) continue; /* no rounds on one plane */
        if (way == TURNING && line->follows && options->frictionless) return;
        if (way == TRYING && (!line->follows || line->frozen)) return;
        CpsiStepOptions with = *options;
        with.slow = way == SLOW;
        if (way == AS_FOUND) with.least = NULL;
        if (options->least) options->least->chose = false;
        with.turning = way == TURNING;
        with.trying = way == TRYING;
        with.centrings = way == TURNING ? 0 : CENTRINGS;
        if (way > first) memset(line->reaction, 0, (size_t)cpsi_line_all_contacts(line)*sizeof *line->reaction);
        if (line->follows) cpsi_contact_return(line);
        solve_step(line, program, &with);
        if (cps_outcome_is_certified(line->report.outcome)) return;
    }
}

/* What the tensions of an inextensible line, and the reactions in corners, are to be near to. */
static void remember(CpsiLine *line) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    if (!line->forces) return;
    memcpy(line->tension_before, line->tension, (n - 1)*sizeof *line->tension);
    memcpy(line->reaction_before, line->reaction, contacts*sizeof *line->reaction);
    if (line->follows) memcpy(line->on_before, line->on, contacts*sizeof *line->on);
}

/* Free, stick and slip, and the sums that go with them. */
static void classify(CpsiLine *line, const CpsiChainProgram *program) {
    CpsLineReport *report = &line->report;
    report->grounded = report->slipping = report->slack = 0;
    cpsi_line_classify(line, program);
}

/* The forces of an inextensible line, where its place leaves a choice: those nearest to the forces before, if they can be certified. */
static void choose_forces(CpsiLine *line, const CpsiChainProgram *program, const CpsiStepOptions *options) {
    if (!line->forces || !cps_outcome_is_certified(line->report.outcome)) return;
    const CpsiIpmReport done = {.outcome = CPSI_IPM_SOLVED};
    const CpsCertificate before = line->report.certificate;
    const CpsOutcome outcome = line->report.outcome;
    cpsi_force_set_keep(line->forces, line);
    for (int tight = 0; tight < 2; tight++) {
        line->tight = tight;
        if (cpsi_line_tension_field(line, line->forces, options, tight)) {
            certify(line, options, &done);
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

/* Does nothing change that could move the line?  Held ends where they were, obstacles that do not turn, friction within its bounds. */
static bool nothing_moves(const CpsiLine *line, const CpsiStepOptions *options) {
    for (int end = 0; end < 2; end++) {
        const double *at = &line->reference[end == CPS_END_A ? 0 : 3*(line->n - 1)], *to = line->end[end].value;
        for (int a = 0; line->end[end].kind == CPS_END_HELD && a < 3; a++)
            if (at[a] != to[a]) return false;
    }
    for (int k = 0; k < line->obstacle_count; k++)
        if (line->turn[k] != 0) return false;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        double f[3], inside[3];
        const CpsiRubSet set = cpsi_rub_set(line, c);
        const double bound = line->friction_bound[c];
        cpsi_frame_to(f, cpsi_line_axes(line, c), &line->friction_force[3*c]);
        if (f[0] == 0 && f[1] == 0 && f[2] == 0) continue;
        /* a given set is not asked whether it holds F: the bound must be the one that held it, as one that follows is */
        if (set.given && !(bound > 0 && options->friction == CPS_FRICTION_CONSISTENT)) return false;
        memcpy(inside, f, sizeof f);
        cpsi_rub_clip(&set, bound, bound, inside);
        const double out = hypot(f[0] - inside[0], f[1] - inside[1]) + fabs(f[2]);
        if (!(out <= CLEAN*line->report.certificate.largest_force)) return false;
    }
    return true;
}

/* Is the line in equilibrium where it is, with the forces that it has?  Then it stays, and keeps them: no motion is less than none. What
 * has been told of the step before, in `before`, is true of this one too, but that nothing slips. */
static bool stays(CpsiLine *line, const CpsiStepOptions *options, const CpsLineReport *before) {
    static const CpsiIpmReport nothing_left = {.outcome = CPSI_IPM_SOLVED};
    if (!options->least || options->frictionless || !(before->share > 0)) return false;
    line->report.certificate = cpsi_certificate(line, options->solver.tolerance);
    if (!nothing_moves(line, options)) return false;
    const CpsCertificate *c = &line->report.certificate;
    line->report.outcome = judge(line, options, &nothing_left);
    if (!cps_outcome_is_certified(line->report.outcome) || !(c->gap <= fmax(before->certificate.gap, TARGET*c->scale))) return false;
    for (int i = 0; i < cpsi_line_all_contacts(line); i++)
        if (line->state[i] == CPS_NODE_SLIP) line->state[i] = CPS_NODE_STICK;
    line->report.slack = before->slack;
    line->report.places = before->places == CPS_PLACES_UNIQUE ? CPS_PLACES_UNIQUE : CPS_PLACES_NEAREST;
    return true;
}

/* Where a line's ends are before a step: where they stay if there is no equilibrium. */
static void keep_ends(CpsiLine *line) {
    line->report = (CpsLineReport){.pierced = -1};
    for (int end = 0; end < 2; end++) {
        memcpy(line->report.end[end].position, &line->position[end == CPS_END_A ? 0 : 3*(line->n - 1)], 3*sizeof(double));
        line->report.end[end].range = (CpsTensionRange){CPS_RANGE_NONE, NAN, NAN, NAN, NAN};
    }
}

bool cpsi_line_step_slides(CpsiLine *line, const CpsiStepOptions *options, double margin) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    if (options->friction != CPS_FRICTION_CONSISTENT || options->frictionless) return false;
    keep_ends(line);
    pose(line, options);
    if (!cpsi_line_slides(line, margin)) return false;
    line->report.outcome = CPS_SLIDES;
    memset(line->friction_force, 0, 3*contacts*sizeof *line->friction_force);
    memset(line->segment_force, 0, 3*n*sizeof *line->segment_force);
    memset(line->tension, 0, n*sizeof *line->tension);
    return true;
}

/* The bend at which the mesh changes the law of friction most; beyond all friction it is no answer. */
static void report_bend(CpsiLine *line) {
    line->report.bend = cpsi_line_bend(line);
    if (cps_outcome_is_certified(line->report.outcome) && cpsi_bend_locks(&line->report.bend))
        line->report.outcome = CPS_MESH_TOO_COARSE;
}

void cpsi_line_step(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options) {
    const CpsLineReport before = line->report;
    keep_ends(line);
    remember(line);
    pose(line, options);
    if (stays(line, options, &before)) {
        cpsi_line_pierces(line, &line->report.pierced);
        cpsi_line_report_ends(line);
        cpsi_line_report_lengths(line);
        line->report.tension_mesh = cpsi_mesh_error(line);
        report_bend(line);
        return;
    }
    line->report.certificate = (CpsCertificate){0};
    line->report.outcome = CPS_SOLVED;
    if (too_short(line) || runs_away(line, options)) return;
    try_ways(line, program, options);
    if (!is_finite(line) || !is_near(line)) forget(line, options);
    if (line->report.places == CPS_PLACES_NEAREST) cpsi_least_motion_restate(line, program);
    cpsi_line_pierces(line, &line->report.pierced);
    classify(line, program);
    choose_forces(line, program, options);
    /* contacts that are free may have come to other obstacles in the last round; the forces of the others are those that were certified */
    const bool looked = line->follows && (options->friction == CPS_FRICTION_CONSISTENT || options->frictionless);
    if ((looked || line->frozen) && line->contacts > 1) cpsi_contact_meet(line, true), cpsi_contact_look(line);
    if (looked) cpsi_contact_still(line);
    cpsi_line_report_ends(line);
    cpsi_line_report_lengths(line);
    line->report.tension_mesh = cpsi_mesh_error(line);
    report_bend(line);
}
