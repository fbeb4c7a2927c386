/* SPDX-License-Identifier: BSD-3-Clause */
/* One step of one line (S90 problem P4.2, with A frozen from the reference or following the reaction), in four moves:
 *
 *   pose      reference x_R, friction bounds w = mu R_R where the reference touches, gaps, loads
 *   decide    is there an equilibrium at all?  An inextensible line shorter than the distance of its ends has none; a line
 *             with no end held needs friction and reactions that can carry its loads
 *   solve     scale to lengths of one and forces of one, turn the obstacle's normal into the third axis, run ipm/
 *   conclude  back to world axes; balance the forces; classify nodes; certificate; report
 *
 * Consistent friction is solved in one go, the bound of each rub tied to the reaction beside it (ipm/rub.c). That problem is no
 * minimisation and may stall; then the bounds are found in rounds, each a convex step with the last round's mu R.
 *
 * Lengths are divided by the line's length L, forces by a force F0 of the size of the tension to come. */
#include "cable/line_step.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "cable/certificate.h"
#include "ipm/ipm.h"

/* The interior point is driven to this relative gap: what the arithmetic allows, well below any tolerance asked. */
static const double TARGET = 1e-13;
/* Consistent friction whose bounds do not agree with mu R to this, or whose loop stops short of it, is solved again in rounds. */
static const double CLEAN = 1e-11;
/* |distance - L| <= TAUT L: an inextensible line is pulled straight, its tension has no upper bound. */
static const double TAUT = 1e-12;
/* A taut line's forces are those of a line longer by this share. */
static const double TAUT_SLACK = 1e-9;
/* A node this near to the obstacle, per length of the line, touches it. */
static const double TOUCH = 1e-9;
/* Friction below this share of the force scale is none: it could not be told from rounding. */
static const double LEAST_FRICTION = 1e-14;
/* Rounds with given bounds before consistent friction is given up. */
static const int ROUNDS = 12;

static bool is_held(const CpsiLine *line, int j) {
    return (j == 0 && line->end[CPS_END_A].kind == CPS_END_HELD) ||
           (j == line->n - 1 && line->end[CPS_END_B].kind == CPS_END_HELD);
}

static bool both(const CpsiLine *line, CpsEndKind kind) {
    return line->end[CPS_END_A].kind == kind && line->end[CPS_END_B].kind == kind;
}

static double end_distance(const CpsiLine *line) {
    return vec3_norm(vec3_sub(vec3_load(line->end[CPS_END_B].value), vec3_load(line->end[CPS_END_A].value)));
}

/* pose ---------------------------------------------------------------------------------------------------------- */

static void pose(CpsiLine *line, const CpsiStepOptions *options) {
    const int n = line->n;
    memcpy(line->reference, line->position, 3*(size_t)n*sizeof *line->reference);
    for (int j = 0; j < n; j++) {
        const double *x = &line->reference[3*j];
        const bool touches = line->has_obstacle && line->state[j] != CPS_NODE_FREE, held = is_held(line, j);
        /* the friction bound is that of the reference; for consistent friction it is a first guess */
        line->friction_bound[j] = touches && !held && !options->frictionless ? line->friction*line->reaction[j] : 0;
        /* contact: everywhere, or only where the reference touches (S90 (35)) */
        const double gap = line->has_obstacle ? cpsi_plane_gap(&line->plane, x) : 0;
        const bool watched = line->has_obstacle && !held &&
                             (options->contact == CPS_CONTACT_GAINED || touches || gap <= TOUCH*line->length);
        line->gap[j] = !watched ? INFINITY : gap > 0 ? gap : 0;
        /* weight, half of each element to each of its nodes, and the forces at free ends */
        for (int a = 0; a < 3; a++) line->load[3*j + a] = line->share[j]*line->weight[a];
        if (line->has_obstacle) vec3_store(&line->normal[3*j], line->plane.axis[2]);
    }
    for (int end = 0; end < 2; end++)
        if (line->end[end].kind == CPS_END_FREE)
            for (int a = 0; a < 3; a++) line->load[3*(end == CPS_END_A ? 0 : n - 1) + a] += line->end[end].value[a];
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
 * the part of B that friction cannot carry, and its normal part where the obstacle does not stop it. */
static bool runs_away(CpsiLine *line, const CpsiStepOptions *options) {
    if (!both(line, CPS_END_FREE)) return false;
    Vec3 sum = vec3(0, 0, 0);
    double friction = 0, loads = 0;
    bool stopped = false;
    for (int j = 0; j < line->n; j++) {
        const Vec3 b = vec3_load(&line->load[3*j]);
        sum = vec3_add(sum, b);
        loads += vec3_norm(b);
        friction += line->friction_bound[j];
        stopped = stopped || isfinite(line->gap[j]);
    }
    const Vec3 n = line->plane.axis[2];
    const double normal = vec3_dot(sum, n), along = stopped && normal < 0 ? 0 : normal;
    const Vec3 tangent = vec3_axpy(-normal, n, sum);
    /* all reactions together balance B.n */
    if (options->friction == CPS_FRICTION_CONSISTENT && !options->frictionless) friction = line->friction*fmax(0, -normal);
    const double pull = vec3_norm(tangent), beyond = pull > friction ? pull - friction : 0;
    const double fall = sqrt(beyond*beyond + along*along);
    if (!(fall > TAUT*loads)) return false;
    const Vec3 slide = pull > 0 ? vec3_scale(beyond/(pull*fall), tangent) : vec3(0, 0, 0);
    line->report.outcome = CPS_UNBOUNDED;
    vec3_store(line->report.proof, vec3_axpy(along/fall, n, slide));
    line->report.proof_value = fall;
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

/* The first guess: the reference, its ends moved to where they are held, the rest along in proportion. */
static void guess(const CpsiLine *line, CpsiChainProgram *program) {
    double shift[2][3] = {{0}};
    const int last = line->n - 1;
    for (int end = 0; end < 2; end++) {
        if (line->end[end].kind != CPS_END_HELD) continue;
        double move[3];
        for (int a = 0; a < 3; a++) move[a] = line->end[end].value[a] - line->reference[3*(end ? last : 0) + a];
        cpsi_plane_to_frame(&line->plane, shift[end], move);
    }
    for (int j = 0; j < line->n; j++) {
        const double b = line->arc_length[j]/line->length;
        for (int a = 0; a < 3; a++) {
            const double value = j == 0 ? shift[0][a] : j == last ? shift[1][a] : (1 - b)*shift[0][a] + b*shift[1][a];
            program->base.u[3*j + a] = value/line->length;
        }
    }
}

/* `follow`: friction bounds follow the reactions; else they are those of the line. */
static void fill_nodes(const CpsiLine *line, CpsiChainProgram *program, double force, bool follow) {
    CpsiRub *rub = &program->rub;
    CpsiStop *stop = &program->stop;
    rub->count = stop->count = 0;
    for (int j = 0; j < line->n; j++) {
        const double share = line->share[j]/line->length;
        program->held[j] = is_held(line, j);
        cpsi_plane_to_frame(&line->plane, &program->base.load[3*j], &line->load[3*j]);
        for (int a = 0; a < 3; a++) program->base.load[3*j + a] /= force;
        const bool watched = isfinite(line->gap[j]);
        if (watched) {
            stop->node[stop->count] = j;
            stop->weight[stop->count] = share;
            stop->gap[stop->count++] = line->gap[j]/line->length;
        }
        if (follow ? !watched : line->friction_bound[j] < LEAST_FRICTION*force) continue;
        rub->node[rub->count] = j;
        rub->weight[rub->count] = share;
        rub->stop[rub->count] = follow ? stop->count - 1 : -1;
        rub->friction[rub->count] = line->friction;
        rub->z[rub->count++][0] = line->friction_bound[j]/(force*share);
    }
}

static void fill_elements(const CpsiLine *line, CpsiChainProgram *program, double force, double longer) {
    CpsiStretch *st = &program->stretch;
    for (int i = 1; i < line->n; i++) {
        const double l = line->element_length[i - 1]*longer;
        double dx[3], frame[3];
        for (int a = 0; a < 3; a++) dx[a] = (line->reference[3*i + a] - line->reference[3*(i - 1) + a])/l;
        cpsi_plane_to_frame(&line->plane, frame, dx);
        st->length[i] = l/line->length;
        st->compliance[i] = line->compliance*force;
        for (int a = 0; a < 3; a++)
            st->s[i][1 + a] = frame[a] + (program->base.u[3*i + a] - program->base.u[3*(i - 1) + a])/st->length[i];
    }
}

/* conclude ------------------------------------------------------------------------------------------------------ */

/* Positions and forces in world axes. */
static void unpack(CpsiLine *line, const CpsiChainProgram *program, double force, bool follow) {
    for (int j = 0; j < line->n; j++) {
        double u[3], shift[3];
        for (int a = 0; a < 3; a++) u[a] = line->length*program->base.u[3*j + a];
        if (isfinite(line->gap[j]) && u[2] < -line->gap[j]) u[2] = -line->gap[j];
        cpsi_plane_from_frame(&line->plane, shift, u);
        for (int a = 0; a < 3; a++) line->position[3*j + a] = line->reference[3*j + a] + shift[a];
        line->reaction[j] = 0;
        for (int a = 0; a < 3; a++) line->friction_force[3*j + a] = 0;
    }
    for (int end = 0; end < 2; end++)
        if (line->end[end].kind == CPS_END_HELD)
            memcpy(&line->position[3*(end == CPS_END_A ? 0 : line->n - 1)], line->end[end].value, sizeof line->end[end].value);
    for (int k = 0; k < program->stop.count; k++)
        line->reaction[program->stop.node[k]] = force*program->stop.weight[k]*program->stop.z[k];
    for (int j = 0; j < line->n; j++)
        if (follow || line->friction_bound[j] < LEAST_FRICTION*force) line->friction_bound[j] = 0;
    for (int k = 0; k < program->rub.count; k++) {
        const int j = program->rub.node[k];
        const double *z = program->rub.z[k], scale = force*program->rub.weight[k], size = scale*sqrt(z[1]*z[1] + z[2]*z[2]);
        if (follow) line->friction_bound[j] = line->friction*line->reaction[j];
        const double keep = size > line->friction_bound[j] ? line->friction_bound[j]/size : 1;
        cpsi_plane_from_frame(&line->plane, &line->friction_force[3*j],
                              (double[3]){keep*scale*z[1], keep*scale*z[2], 0});
    }
    for (int i = 1; i < line->n; i++) {
        const double *z = program->stretch.z[i];
        cpsi_plane_from_frame(&line->plane, &line->segment_force[3*(i - 1)],
                              (double[3]){-force*z[1], -force*z[2], -force*z[3]});
        line->tension[i - 1] = force*z[0];
    }
}

/* A taut line is straight, each element at its share of the span. */
static void straighten(CpsiLine *line) {
    const Vec3 a = vec3_load(line->end[CPS_END_A].value), b = vec3_load(line->end[CPS_END_B].value);
    for (int j = 1; j + 1 < line->n; j++)
        vec3_store(&line->position[3*j], vec3_axpy(line->arc_length[j]/line->length, vec3_sub(b, a), a));
}

/* Free, stick or slip, and slack: of two complementary quantities, the one that is larger at its own scale is the one that is
 * not zero. */
static void classify(CpsiLine *line, const CpsiChainProgram *program) {
    const double weight = vec3_norm(vec3_load(line->weight));
    const double density = weight > 0 ? weight : line->report.certificate.largest_force/line->length;
    CpsLineReport *report = &line->report;
    memset(line->state, CPS_NODE_FREE, (size_t)line->n);
    for (int k = 0; k < program->stop.count; k++) {
        const int j = program->stop.node[k];
        if (line->reaction[j] <= density*line->share[j]*program->stop.s[k]) continue;
        line->state[j] = CPS_NODE_STICK;
        report->grounded += line->share[j];
    }
    for (int k = 0; k < program->rub.count; k++) {
        const int j = program->rub.node[k];
        const double *z = program->rub.z[k], *s = program->rub.s[k], slide = sqrt(s[1]*s[1] + s[2]*s[2]);
        report->dissipated += line->friction_bound[j]*slide*line->length;
        if (line->state[j] == CPS_NODE_FREE || slide*z[0] <= z[0] - sqrt(z[1]*z[1] + z[2]*z[2])) continue;
        line->state[j] = CPS_NODE_SLIP;
        report->slipping += line->share[j];
    }
    for (int i = 1; i < line->n; i++) {
        const double *s = program->stretch.s[i], *z = program->stretch.z[i];
        if (z[0] < s[0] - sqrt(s[1]*s[1] + s[2]*s[2] + s[3]*s[3])) report->slack += line->element_length[i - 1];
    }
}

static void report_ends(CpsiLine *line) {
    for (int end = 0; end < 2; end++) {
        const int j = end == CPS_END_A ? 0 : line->n - 1, e = end == CPS_END_A ? 0 : line->n - 2;
        CpsEndReport *out = &line->report.end[end];
        memcpy(out->position, &line->position[3*j], sizeof out->position);
        Vec3 force = vec3_load(line->end[end].value);
        if (line->end[end].kind == CPS_END_HELD) {
            /* what the support does: the opposite of the element's pull and the node's own weight */
            const Vec3 pull = vec3_scale(end == CPS_END_A ? 1 : -1, vec3_load(&line->segment_force[3*e]));
            force = vec3_scale(-1, vec3_add(pull, vec3_load(&line->load[3*j])));
            /* an end that lies on the obstacle is carried by it */
            const Vec3 n = line->plane.axis[2];
            const double up = vec3_dot(force, n);
            if (line->has_obstacle && up > 0 && cpsi_plane_gap(&line->plane, out->position) <= TOUCH*line->length) {
                line->reaction[j] = up;
                line->state[j] = CPS_NODE_STICK; /* let go in the next step, it starts with its friction */
                force = vec3_axpy(-up, n, force);
            }
        }
        vec3_store(out->force, force);
        out->tension = vec3_norm(force);
    }
}

/* The iterate of the loop as a certified answer, or what it is instead. The loop's own residuals (tensions against
 * elongations, positions against distances) must be well below the tolerance too, but not below what rounding leaves. */
static CpsOutcome judge(const CpsiLine *line, const CpsiStepOptions *options, const CpsiIpmReport *ipm) {
    const CpsCertificate *c = &line->report.certificate;
    const double tolerance = options->solver.tolerance;
    const bool finite = isfinite(c->gap) && isfinite(c->scale) && isfinite(c->force_residual);
    const bool consistent = options->friction == CPS_FRICTION_FROZEN || c->friction_residual <= CLEAN*c->largest_force;
    if (finite && consistent && ipm->residual <= fmax(0.01*tolerance, CLEAN) && c->gap <= tolerance*c->scale &&
        c->stretch_residual <= tolerance)
        return is_taut(line) ? CPS_TAUT : CPS_SOLVED;
    return ipm->outcome == CPSI_IPM_ITERATION_LIMIT ? CPS_ITERATION_LIMIT : CPS_STALLED;
}

/* Balance the forces, and judge what has been found. */
static void certify(CpsiLine *line, const CpsiStepOptions *options, const CpsiIpmReport *ipm) {
    cpsi_balance_forces(line);
    line->report.certificate = cpsi_certificate(line);
    if (options->frictionless) line->report.certificate.friction_residual = 0;
    line->report.outcome = judge(line, options, ipm);
}

/* Solve once, with bounds that follow the reactions or with the bounds of the line. */
static CpsiIpmReport attempt(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options, bool follow) {
    const bool taut = is_taut(line);
    const double longer = taut ? 1 + TAUT_SLACK : 1;
    const double force = force_scale(line, end_distance(line)/longer), unit = force > 0 ? force : 1;
    cpsi_chain_program_resize(program, line->n);
    guess(line, program);
    fill_nodes(line, program, unit, follow);
    fill_elements(line, program, unit, longer);
    double scale = 0;
    for (int i = 0; i < 3*line->n; i++) scale += fabs(program->base.load[i]);
    const CpsiIpmOptions ipm_options = {
        .target = TARGET, .scale = scale > 0 ? scale : 1, .max_iterations = options->solver.max_iterations};
    const CpsiIpmReport ipm = cpsi_ipm_solve(&program->base, &ipm_options);

    unpack(line, program, force, follow);
    if (taut) straighten(line);
    certify(line, options, &ipm);
    line->report.iterations += ipm.iterations;
    return ipm;
}

/* The bounds mu R, and no friction beyond them. */
static void take_bounds(CpsiLine *line) {
    for (int j = 0; j < line->n; j++) {
        const double bound = isfinite(line->gap[j]) ? line->friction*line->reaction[j] : 0;
        double *f = &line->friction_force[3*j];
        const double size = vec3_norm(vec3_load(f));
        if (size > bound) vec3_store(f, vec3_scale(bound/size, vec3_load(f)));
        line->friction_bound[j] = bound;
    }
}

/* Rounds of convex steps, each with the bounds mu R of the one before; what the last round leaves between A and mu R goes
 * into the gap. */
static void find_bounds(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options) {
    CpsiIpmReport ipm = {.outcome = CPSI_IPM_STALLED};
    for (int round = 0; round < ROUNDS; round++) {
        take_bounds(line);
        ipm = attempt(line, program, options, false);
        if (line->report.outcome <= CPS_TAUT) break;
    }
    take_bounds(line);
    certify(line, options, &ipm);
}

void cpsi_line_step(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options) {
    line->report = (CpsLineReport){0};
    for (int end = 0; end < 2; end++) /* where they stay if there is no equilibrium */
        memcpy(line->report.end[end].position, &line->position[end == CPS_END_A ? 0 : 3*(line->n - 1)], 3*sizeof(double));
    pose(line, options);
    if (too_short(line) || runs_away(line, options)) return;
    const bool follow = options->friction == CPS_FRICTION_CONSISTENT && !options->frictionless && line->friction > 0;
    const CpsiIpmReport ipm = attempt(line, program, options, follow);
    if (follow && !(ipm.gap + ipm.residual <= CLEAN)) find_bounds(line, program, options);
    classify(line, program);
    report_ends(line);
}
