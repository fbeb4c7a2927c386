/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's method on the active set (active_set.h; docs/theory.md 6b).
 *
 * Unknowns are the displacements u and the tensions T; reactions and friction are what balances the
 * nodes. With p = T e/|e| the force in an element, g = load - p_i + p_i+1 the force on a node
 * without that of its contact, the equations are
 *
 *     taut element        |e| = 1 + phi(T)           slack        T = 0
 *     open contact        g = 0                      closed       gap + u_z = 0, R = -g_z
 *     friction sticks     s = 0, F = -g_xy           slips        F = A tau/|tau|, tau = F - rho s
 *     contact that gives  R = max(0, -(gap + u_z)/c), without friction
 *
 * with phi(T) = c T, or of a law with springs (base/element_law.h), A = mu R where bounds are
 * coupled, s the slip and F = -g_xy (Alart and Curnier 1991; Hueber, Stadler and Wohlmuth 2008).
 * Which of each pair holds is read from the signs of what the other one leaves free: T < 0 or |e| >
 * 1, R < 0 or penetration, |F| > A, F.s > 0. Newton's method for the equations of the present set
 * is one linear system of the chain (active_status.c, active_system.c). */
#include "chain/active_set.h"

#include <float.h>
#include <string.h>

#include "base/lanes.h"
#include "chain/newton.h"

/* More linear systems than this take longer than the interior-point loop. */
enum { MOST_STEPS = 30 };
/* Nor do steps without progress pay, so many in which the residual has not fallen to this share of
 * the least one. */
enum { PATIENCE = 12 };
static const double PROGRESS = 0.9;
/* The same where a solution is polished, which from an error of the equations beyond FAR hardly
 * succeeds. A residual of the second is solved if no more progress is made: the slip of a node that
 * hardly moves may take its direction from one step to the next without end. */
enum { MOST_POLISHING = 8, POLISHING_PATIENCE = 1 };
static const double FAR = 1e-2, POLISHED = 1e-12;
/* Rounding in units of the last place: of an elongation or a balance, by a few operations; and of a
 * force between nodes at rest, by their coordinates and those of the reference. */
static const double ROUNDINGS = 16, COORDINATE_ROUNDINGS = 64;
/* ... which is at most this per largest force: the certificate asks for it (CPSI_CLEAN). Where one
 * unit in the last place of a coordinate is more, the method cannot end. */
static const double MOST_NOISE = 1e-11;

static inline void to_node(const CpsiChainProgram *program, int j, double v[3]) {
    if (!program->frame) return;
    const double common[3] = {v[0], v[1], v[2]};
    cpsi_frame_to(v, &program->frame[9 * j], common);
}

/* The reactions of what gives, and their part of the forces on the nodes; returns the largest. */
static double press(CpsiChainProgram *program) {
    const CpsiUnilateral *unilateral = &program->unilateral;
    double most = 0;
    for (int k = 0; k < unilateral->count; k++) {
        if (!cpsi_newton_gives(program, k)) continue;
        unilateral->z[k] = fmax(0, -cpsi_newton_gap(program, k) / unilateral->compliance[k]);
        const double force = unilateral->weight[k] * unilateral->z[k];
        program->base.residual[3 * unilateral->node[k] + 2] += force;
        most = fmax(most, force);
    }
    return most;
}

/* The largest |v|; NaN if any is. */
static inline double largest_of(const double v[3]) {
    return cpsi_max_nan(cpsi_max_nan(fabs(v[0]), fabs(v[1])), fabs(v[2]));
}

/* The force of each element, the error of its law, |e| - 1 - phi(T), and the force g on each node.
 */
static void measure(CpsiNewton *newton) {
    CpsiChainProgram *program = newton->program;
    CpsiSegment *st = &program->segment;
    double *g = program->base.residual, before[3] = {0}, most = 0;
    memcpy(g, program->base.load, 3 * (size_t)program->n * sizeof *g);
    for (int i = 1; i <= program->n; i++) {
        double after[3] = {0};
        if (i < program->n) {
            const double *s = st->s[i], tension = st->z[i][0];
            const double size = sqrt(s[1] * s[1] + s[2] * s[2] + s[3] * s[3]), over = 1 / size;
            st->inverse_w[i] = over;
            const CpsiElementLaw law = cpsi_segment_law(st, i);
            st->g[i] = size - 1 - cpsi_law_strain(&law, tension);
            for (int a = 0; a < 3; a++) after[a] = tension * over * s[1 + a];
            if (tension > most) most = tension;
        }
        double pull[3] = {after[0] - before[0], after[1] - before[1], after[2] - before[2]};
        to_node(program, i - 1, pull);
        for (int a = 0; a < 3; a++) {
            g[3 * (i - 1) + a] += pull[a];
            before[a] = after[a];
        }
    }
    for (int j = 0; program->field && j < program->n; j++) {
        double pull[3];
        cpsi_field_pull(program, j, pull);
        for (int a = 0; a < 3; a++) g[3 * j + a] -= pull[a];
        most = cpsi_max_nan(most, largest_of(pull));
    }
    if (program->unilateral.compliance) most = cpsi_max_nan(most, press(program));
    if (newton->has_points) cpsi_newton_measure_points(newton);
    newton->force = most > 1 ? most : 1;
}

static void set_rounding(CpsiNewton *newton) {
    const CpsiChainProgram *program = newton->program;
    const double *factor = program->segment.compliance_factor;
    double shortest = 1, least = 1;
    for (int i = 1; i < program->n; i++) {
        if (program->segment.length[i] < shortest) shortest = program->segment.length[i];
        if (factor && factor[i - 1] < least) least = factor[i - 1];
    }
    const double farthest = cpsi_lanes_size(3 * (size_t)program->n, program->base.u);
    newton->rounding = ROUNDINGS * DBL_EPSILON * (1 + farthest / shortest);
    newton->noise = COORDINATE_ROUNDINGS * DBL_EPSILON * (1 + 1 / shortest);
    /* ... and an elongation as a force */
    const double stiffest = program->segment.compliance * least;
    newton->noise = fmax(newton->noise, fmin(newton->rounding / stiffest, MOST_NOISE));
}

/* Decide the active set at the present iterate, and set up its linear system. Returns the error of
 * its equations, elongations and forces per largest force. */
static double prepare(CpsiNewton *newton, bool first) {
    newton->changed = false;
    measure(newton);
    if (!first) {
        cpsi_newton_decide(newton);
        if (newton->changed) measure(newton);
    }
    cpsi_newton_assemble(newton);
    return cpsi_max_nan(newton->strain_error, newton->force_error / newton->force);
}

/* Friction at which disc d slips, on its piece of the boundary of its set. */
static void finish_on_piece(const CpsiShapePiece *piece, const CpsiNodeFriction *now, double f[2]) {
    const double slip = cpsi_newton_size(now->s);
    if (piece->is_edge) {
        double t[2];
        cpsi_newton_tangent(piece, t);
        const double from = cpsi_newton_dot(piece->at[0], t), to = cpsi_newton_dot(piece->at[1], t);
        const double along =
            fmin(now->bound * to, fmax(now->bound * from, cpsi_newton_dot(now->f, t)));
        const double *n = piece->normal[0], out = now->bound * cpsi_newton_dot(piece->at[0], n);
        for (int a = 0; a < 2; a++) f[a] = out * n[a] + along * t[a];
    } else if (piece->radius == 0 || slip > CPSI_LEAST_SLIP) {
        for (int a = 0; a < 2; a++)
            f[a] =
                now->bound * (piece->centre[a] - (slip > 0 ? piece->radius * now->s[a] / slip : 0));
    }
}

/* The pair of disc d with a general set: A is a number that |F| reaches where it slips. */
static void finish_shaped(const CpsiNewton *newton, int d) {
    const CpsiChainProgram *program = newton->program;
    const CpsiFrictionDisc *disc = &program->disc;
    const CpsiNodeFriction now = cpsi_newton_friction(program, d);
    const bool slips = !(newton->status[disc->node[d]] & CPSI_STICKS);
    double *s = disc->s[d], *z = disc->z[d], f[2] = {now.f[0], now.f[1]};
    const double size = cpsi_newton_size(f);
    s[0] = slips ? cpsi_newton_size(now.s) : 0;
    if (slips) finish_on_piece(cpsi_newton_piece(newton, d), &now, f);
    if (!slips && size > 0) {
        const double none[2] = {0, 0}, q[2] = {f[0] / size, f[1] / size};
        z[0] = now.bound * cpsi_friction_shape_reach(disc->shape[d], none, q);
        const double keep = size > z[0] ? (1 - 4 * DBL_EPSILON) * z[0] / size : 1;
        for (int a = 0; a < 2; a++) f[a] *= keep;
    } else {
        z[0] = slips ? cpsi_newton_size(f) : now.bound;
    }
    for (int a = 0; a < 2; a++) {
        s[1 + a] = slips ? now.s[a] : 0;
        z[1 + a] = f[a];
    }
}

static void turn(const double map[6], double v[2]) {
    const double x = v[0], y = v[1];
    v[0] = map[0] * x + map[1] * y;
    v[1] = map[3] * x + map[4] * y;
}

/* The pair (s, z) of disc d. */
static void finish_friction(const CpsiNewton *newton, int d) {
    const CpsiChainProgram *program = newton->program;
    const CpsiFrictionDisc *disc = &program->disc;
    double *s = disc->s[d], *z = disc->z[d];
    if (cpsi_newton_is_corner(newton, disc->node[d])) return;
    if (!cpsi_newton_has_friction(newton, d)) {
        memset(s, 0, sizeof disc->s[d]);
        if (program->bounds_coupled) memset(z, 0, sizeof disc->z[d]);
        return;
    }
    if (cpsi_newton_shape(program, d)) {
        finish_shaped(newton, d);
        return;
    }
    const CpsiNodeFriction now = cpsi_newton_friction(program, d);
    const bool slips = !(newton->status[disc->node[d]] & CPSI_STICKS);
    /* a force inside its bound is one that sticks (cable/report.c) */
    const double slip = cpsi_newton_size(now.s), size = cpsi_newton_size(now.f),
                 most = slips ? now.bound : (1 - 4 * DBL_EPSILON) * now.bound;
    const double keep = size > most ? most / size : 1;
    z[0] = now.bound;
    s[0] = slips ? slip : 0;
    for (int a = 0; a < 2; a++) {
        s[1 + a] = slips ? now.s[a] : 0;
        z[1 + a] = slips && slip > CPSI_LEAST_SLIP ? -now.bound * now.s[a] / slip : keep * now.f[a];
    }
    if (disc->map && cpsi_newton_is_turned(disc->map[d])) {
        turn(disc->map[d], &s[1]);
        turn(disc->map[d], &z[1]);
    }
}

/* The pairs (s, z) of the solution. */
static void finish(const CpsiNewton *newton) {
    const CpsiChainProgram *program = newton->program;
    const CpsiSegment *st = &program->segment;
    const CpsiUnilateral *unilateral = &program->unilateral;
    for (int i = 1; i < program->n; i++) {
        const CpsiElementLaw law = cpsi_segment_law(st, i);
        st->s[i][0] = 1 + cpsi_law_strain(&law, st->z[i][0]);
        for (int a = 1; a < 4; a++) st->z[i][a] = -st->z[i][0] * st->inverse_w[i] * st->s[i][a];
    }
    for (int k = 0; k < unilateral->count; k++) {
        const int j = unilateral->node[k];
        if (cpsi_newton_is_corner(newton, j)) continue;
        if (cpsi_newton_gives(program, k)) {
            unilateral->s[k] = fmax(0, cpsi_newton_gap(program, k));
            continue;
        }
        const bool closed = !cpsi_newton_is_other(program, k) && (newton->status[j] & CPSI_CLOSED);
        unilateral->s[k] = closed ? 0 : cpsi_newton_gap(program, k);
        if (!closed) unilateral->z[k] = 0;
    }
    for (int d = 0; d < program->disc.count; d++) finish_friction(newton, d);
}

/* At most so many steps from the guess, with the matrix prepared for them, to rounding or to what
 * may be left of the errors of the guess. */
static CpsiIpmReport iterate(CpsiNewton *newton, int most, double left) {
    const int patience = newton->polishes ? POLISHING_PATIENCE : PATIENCE;
    CpsiChainProgram *program = newton->program;
    CpsiIpmReport report = {.outcome = CPSI_IPM_STALLED};
    double least = INFINITY, first = 0;
    int waited = 0;
    for (int step = 0; step <= most; step++) {
        report.residual = prepare(newton, step == 0);
        newton->residual = report.residual;
        if (newton->lost || !isfinite(report.residual)) break;
        if (newton->polishes && step == 0 && report.residual > FAR) break;
        const double rounding = fmin(newton->rounding, MOST_NOISE);
        if (step == 0) first = report.residual;
        if (step > 0 && !newton->changed && report.residual <= fmax(rounding, left * first)) {
            report.outcome = CPSI_IPM_SOLVED;
            break;
        }
        if (report.residual < PROGRESS * least) {
            least = report.residual;
            waited = 0;
        } else if (++waited > patience) {
            if (newton->polishes && !newton->changed && report.residual <= POLISHED)
                report.outcome = CPSI_IPM_SOLVED;
            break;
        }
        if (step == most || cpsi_interrupt_seen(program->base.interrupt)) break;
        program->matrix.share = newton->has_points ? program->node_frames.share : NULL;
        if (newton->has_points) cpsi_newton_give_points(newton);
        if (!program->ops->factor(program->linsys, &program->matrix)) break;
        program->ops->solve(program->linsys, &program->matrix, program->base.du, program->dt,
                            program->matrix.second ? program->node_frames.second_reaction_change
                                                   : NULL);
        report.iterations++;
        if (newton->has_points) cpsi_newton_take_points(newton);
        cpsi_newton_advance(newton);
    }
    return report;
}

CpsiIpmReport cpsi_chain_active_set(CpsiChainProgram *program, int max_iterations, bool polishes,
                                    double left) {
    const size_t n = (size_t)program->n;
    CpsiMatrix *matrix = &program->matrix;
    const CpsiMatrixSecond *second = matrix->second;
    const double *share = matrix->share;
    unsigned char *bytes = (unsigned char *)program->segment.w; /* 32 n */
    CpsiNewton newton = {.program = program,
                         .polishes = polishes,
                         .piece = (int *)bytes,
                         .status = bytes + 4 * n,
                         .held = bytes + 6 * n,
                         .taut = bytes + 7 * n,
                         .corner = (CpsiCorner *)(bytes + 8 * n),
                         .most_corners = (int)(23 * n / sizeof(CpsiCorner)),
                         .anchored = bytes + 31 * n,
                         .frame = program->disc.shape ? program->conic.frame : NULL};
    set_rounding(&newton);
    const bool is_drowned = newton.rounding > ROUNDINGS * MOST_NOISE;
    if (!is_drowned) cpsi_newton_begin(&newton);
    if (is_drowned || newton.lost) return (CpsiIpmReport){.outcome = CPSI_IPM_STALLED};
    matrix->held = newton.held;
    matrix->frame = newton.frame ? newton.frame : program->frame;
    matrix->second = NULL;
    const int most = polishes ? MOST_POLISHING : MOST_STEPS;
    CpsiIpmReport report = iterate(&newton, max_iterations < most ? max_iterations : most, left);
    matrix->held = program->held;
    matrix->second = second;
    matrix->share = share;
    if (report.outcome != CPSI_IPM_SOLVED) return report;
    if (cpsi_corner_finish(&newton))
        finish(&newton);
    else
        report.outcome = CPSI_IPM_STALLED;
    return report;
}
