/* SPDX-License-Identifier: BSD-3-Clause */
/* The linear system of Newton's method on the active set (active_set.c), for the equations of the
 * present set. Nodes that stick are held, the normal of a closed contact is stiff, and friction
 * that follows its reaction is the part without symmetry. */
#include <string.h>

#include "base/larger.h"
#include "chain/newton.h"

/* An element between nodes that move keeps at least this share of its tension in a step. */
static const double LEAST_TENSION = 0.1;
/* The stiffness of a direction in which a node is held: its inverse vanishes beside any
 * compliance. */
static const double RIGID = 1e30;
/* The stiffness that moves a node to where its new status wants it: far beyond those of elements,
 * and such that its product with a displacement keeps digits of the force. */
static const double PULLING = 1e12;
/* rho, per stiffness of the line across itself at the node: of the order of one. Beyond a hundred
 * it decides by slips that are still far from the solution, below one the direction of a slip
 * follows forces that are. */
static const double SLIP_STIFFNESS = 10;
/* The direction of a slip is held no more stiffly than that of one of this length: what a stiffness
 * across it leaves of those along it is known to rounding only. */
static const double NO_SLIP = 1e-12;

static void load_elements(CpsiNewton *newton) {
    CpsiChainProgram *program = newton->program;
    const CpsiSegment *st = &program->segment;
    CpsiMatrix *matrix = &program->matrix;
    for (int i = 1; i < program->n; i++) {
        const double l = st->length[i], over = st->inverse_w[i], tension = st->z[i][0];
        const CpsiElementLaw law = cpsi_segment_law(st, i);
        const double c = cpsi_law_compliance(&law, tension), share = 1 - c * tension * over;
        for (int a = 0; a < 3; a++) matrix->direction[3 * i + a] = st->s[i][1 + a] * over;
        if (newton->taut[i]) {
            if (!(share > 0)) newton->lost = true;
            matrix->stiffness[i] = tension * over / l;
            matrix->compliance[i] = c * l / share;
            program->dt[i] = fabs(st->g[i]) <= newton->rounding && cpsi_newton_is_fixed(newton, i)
                                 ? 0
                                 : -st->g[i] * l / share;
            /* kept without tension at a front, it may as well be slack */
            if (!(newton->polishes && tension == 0 && st->g[i] < 0))
                newton->strain_error = cpsi_max_nan(newton->strain_error, fabs(st->g[i]));
        } else {
            matrix->stiffness[i] = 0;
            matrix->compliance[i] = RIGID;
            program->dt[i] = 0;
        }
    }
}

/* The direction of friction on disc d, and what the linear system needs of it. */
typedef struct Direction {
    double q[2];   /* tau/|tau|, or opposite to the slip */
    double across; /* stiffness across it */
    double by;     /* factor of the error across it */
} Direction;

/* tau = f - rho s, with rho the stiffness of the line across itself. Where tau lies within the
 * bound, the direction is that of the slip, or that in which the node was released. */
static Direction direction_of(const CpsiNewton *newton, int d, const CpsiNodeFriction *now) {
    const CpsiChainProgram *program = newton->program;
    const double *stiffness = program->matrix.stiffness, *last = &program->disc.w[d][1];
    const int j = program->disc.node[d];
    const bool is_point = cpsi_newton_is_point(newton, j);
    const double before = is_point ? stiffness[j - program->n]
                          : j > 0  ? stiffness[j]
                                   : 0,
                 after = is_point             ? before
                         : j + 1 < program->n ? stiffness[j + 1]
                                              : 0,
                 rho = SLIP_STIFFNESS * (before + after) / program->disc.weight[d];
    const double tau[2] = {now->f[0] - rho * now->s[0], now->f[1] - rho * now->s[1]};
    const double size = cpsi_newton_size(tau), slip = cpsi_newton_size(now->s),
                 beyond = size - now->bound;
    Direction out = {.q = {last[0], last[1]}, .by = 1};
    /* a node just released goes where it was released to, though its force may be at the bound on
     * the other side */
    const bool is_released = (newton->status[j] & CPSI_RELEASED) && slip < CPSI_LEAST_SLIP;
    if (beyond > now->bound * rho / RIGID && !is_released) {
        const double certain = fmax(beyond, rho * NO_SLIP);
        for (int a = 0; a < 2; a++) out.q[a] = tau[a] / size;
        out.across = now->bound * rho / certain;
        out.by = size / certain;
        return out;
    }
    const bool is_first = last[0] == 0 && last[1] == 0;
    if (is_first && slip < CPSI_LEAST_SLIP && size > 0)
        for (int a = 0; a < 2; a++) out.q[a] = tau[a] / size;
    else if (slip > 0 && now->s[0] * last[0] + now->s[1] * last[1] <= 0 && !is_released)
        for (int a = 0; a < 2; a++) out.q[a] = -now->s[a] / slip;
    out.across = now->bound / fmax(slip, NO_SLIP);
    return out;
}

/* The rows of a node that slips against an edge with normal n of the set of its friction, in axes
 * along n and the edge: along n the force is what the edge allows, along the edge nothing slips. */
static void load_edge(CpsiNewton *newton, int d, const CpsiShapePiece *edge) {
    CpsiChainProgram *program = newton->program;
    const CpsiFrictionDisc *disc = &program->disc;
    const int j = disc->node[d];
    const CpsiNodeFriction now = cpsi_newton_friction(program, d);
    const double *n = edge->normal[0], most = cpsi_newton_dot(edge->at[0], n);
    const double error = cpsi_newton_dot(now.f, n) - now.bound * most;
    const bool stops = newton->status[j] & CPSI_STOPS;
    double t[2], own[6], *diagonal = &program->matrix.diagonal[6 * j],
                         *f = &program->base.du[3 * j];
    double *axes = &newton->frame[9 * j];
    cpsi_newton_tangent(edge, t);
    memcpy(own, axes, sizeof own);
    for (int a = 0; a < 3; a++) {
        axes[a] = n[0] * own[a] + n[1] * own[3 + a];
        axes[3 + a] = t[0] * own[a] + t[1] * own[3 + a];
    }
    diagonal[2] = stops ? PULLING : RIGID;
    f[0] = -disc->weight[d] * error;
    f[1] = stops ? -PULLING * cpsi_newton_dot(now.s, t) : 0;
    if (program->bounds_coupled)
        program->matrix.skew[2 * j] = most * disc->friction[d] * diagonal[5];
    newton->force_error = cpsi_max_nan(newton->force_error, disc->weight[d] * fabs(error));
    for (int a = 0; a < 2; a++) disc->w[d][1 + a] = n[a];
}

/* The rows of a node whose friction slips: f - A (c + r q) = 0 on an arc of its set, with centre 0
 * and radius 1 of a disc. Along q it is A r, which may follow the reaction; across, a change of the
 * slip turns q. */
static void load_slip(CpsiNewton *newton, int d) {
    CpsiChainProgram *program = newton->program;
    const CpsiFrictionDisc *disc = &program->disc;
    const int j = disc->node[d];
    const double weight = disc->weight[d];
    const CpsiShapePiece *piece = cpsi_newton_piece(newton, d);
    CpsiNodeFriction now = cpsi_newton_friction(program, d);
    double centre[2] = {0, 0}, radius = 1;
    if (piece) {
        memcpy(centre, piece->centre, sizeof centre);
        radius = piece->radius;
    }
    for (int a = 0; a < 2; a++) now.f[a] -= now.bound * centre[a];
    now.bound *= radius;
    const Direction to = direction_of(newton, d, &now);
    const double *q = to.q, *b = now.b, along = now.f[0] * q[0] + now.f[1] * q[1],
                 aside = now.f[1] * q[0] - now.f[0] * q[1];
    const double slip = cpsi_newton_size(now.s),
                 certain = radius > 0 ? slip / (slip + CPSI_LEAST_SLIP) : 1;
    const double stiffness = weight * to.across;
    double *diagonal = &program->matrix.diagonal[6 * j], *f = &program->base.du[3 * j];
    diagonal[0] += stiffness * b[0] * b[0] * q[1] * q[1];
    diagonal[1] += -stiffness * b[0] * b[1] * q[0] * q[1];
    diagonal[2] += stiffness * b[1] * b[1] * q[0] * q[0];
    for (int a = 0; a < 2; a++) {
        const double rest = aside * (a ? q[0] : -q[1]), error = (along - now.bound) * q[a];
        f[a] = -weight * b[a] * (error + to.by * rest);
        newton->force_error =
            cpsi_max_nan(newton->force_error, weight * b[a] * fabs(error + certain * rest));
        if (program->bounds_coupled)
            program->matrix.skew[2 * j + a] =
                b[a] * (centre[a] + radius * q[a]) * disc->friction[d] * diagonal[5];
        disc->w[d][1 + a] = q[a];
    }
}

/* The rows of all nodes and points without what friction adds; the errors of those where none acts.
 */
static void load_places(CpsiNewton *newton) {
    CpsiChainProgram *program = newton->program;
    const int n = program->n, last = newton->has_points ? 2 * n : n;
    double error = 0;
    for (int j = 0; j < last; j++) {
        if (j >= n && !(j > n && program->node_frames.share[j - n] > 0)) continue;
        double *diagonal = &program->matrix.diagonal[6 * j], *f = &program->base.du[3 * j];
        const double *g = &program->base.residual[3 * j];
        const double *field = program->field && j < n ? &program->field[6 * j] : NULL;
        const int status = newton->status[j];
        const bool has_friction =
            (status & CPSI_HAS_FRICTION) && (!program->bounds_coupled || (status & CPSI_CLOSED));
        for (int a = 0; a < 6; a++) diagonal[a] = field ? field[a] : 0;
        for (int a = 0; a < 2; a++) program->matrix.skew[2 * j + a] = 0;
        for (int a = 0; a < 3; a++) f[a] = g[a];
        if (cpsi_newton_is_held(newton, j)) continue;
        if (status & CPSI_CLOSED) {
            diagonal[5] = status & CPSI_LANDS ? PULLING : RIGID;
            f[2] = 0;
        }
        if (status & CPSI_STICKS) diagonal[0] = diagonal[2] = status & CPSI_STOPS ? PULLING : RIGID;
        if (has_friction) f[0] = f[1] = 0;
        if (status & CPSI_CORNER) continue;
        error = cpsi_max_nan(error, cpsi_max_nan(cpsi_max_nan(fabs(f[0]), fabs(f[1])), fabs(f[2])));
    }
    newton->force_error = error;
}

/* How far a point is from where its status wants it is an error of the equations. */
static void note_way(CpsiNewton *newton, double way) {
    newton->strain_error = cpsi_max_nan(newton->strain_error, fabs(way));
}

/* What friction, landing nodes and what gives add to the rows of their nodes. */
static void load_contacts(CpsiNewton *newton) {
    CpsiChainProgram *program = newton->program;
    const CpsiFrictionDisc *disc = &program->disc;
    const CpsiUnilateral *unilateral = &program->unilateral;
    double *f = program->base.du;
    for (int d = 0; d < disc->count; d++) {
        const int j = disc->node[d];
        if (cpsi_newton_is_held(newton, j) || !cpsi_newton_has_friction(newton, d)) continue;
        const CpsiShapePiece *piece = cpsi_newton_piece(newton, d);
        if (!(newton->status[j] & CPSI_STICKS)) {
            if (piece && piece->is_edge)
                load_edge(newton, d, piece);
            else
                load_slip(newton, d);
        } else if (newton->status[j] & CPSI_STOPS) {
            const CpsiNodeFriction now = cpsi_newton_friction(program, d);
            for (int a = 0; a < 2; a++) f[3 * j + a] = -PULLING * now.s[a] / now.b[a];
            if (cpsi_newton_is_point(newton, j)) note_way(newton, cpsi_newton_size(now.s));
        }
    }
    for (int k = 0; k < unilateral->count; k++) {
        const int j = unilateral->node[k];
        if (cpsi_newton_gives(program, k) && unilateral->z[k] > 0)
            program->matrix.diagonal[6 * j + 5] +=
                unilateral->weight[k] / unilateral->compliance[k];
        if (cpsi_newton_is_other(program, k) || !(newton->status[j] & CPSI_LANDS)) continue;
        const double to = -unilateral->gap[k] - program->base.u[3 * j + 2];
        f[3 * j + 2] = PULLING * to;
        for (int a = 0; a < 2; a++) f[3 * j + a] += program->matrix.skew[2 * j + a] * to;
        if (cpsi_newton_is_point(newton, j)) note_way(newton, to);
    }
}

void cpsi_newton_assemble(CpsiNewton *newton) {
    const CpsiChainProgram *program = newton->program;
    newton->strain_error = 0;
    if (newton->frame)
        memcpy(newton->frame, program->frame, 9 * (size_t)program->n * sizeof *newton->frame);
    load_elements(newton);
    load_places(newton);
    load_contacts(newton);
    cpsi_corner_load(newton);
}

/* Turn the direction of a node that slips against an edge to its own axes. */
static void turn_back(const CpsiNewton *newton, int d) {
    const CpsiChainProgram *program = newton->program;
    const int j = program->disc.node[d];
    if (!cpsi_newton_has_friction(newton, d) || newton->held[j] ||
        (newton->status[j] & CPSI_STICKS))
        return;
    const CpsiShapePiece *piece = cpsi_newton_piece(newton, d);
    if (!piece || !piece->is_edge) return;
    double t[2], *x = &program->base.du[3 * j];
    const double *n = piece->normal[0], out = x[0], along = x[1];
    cpsi_newton_tangent(piece, t);
    for (int a = 0; a < 2; a++) x[a] = out * n[a] + along * t[a];
}

void cpsi_newton_advance(CpsiNewton *newton) {
    CpsiChainProgram *program = newton->program;
    CpsiSegment *st = &program->segment;
    double before[3] = {0};
    for (int d = 0; newton->frame && d < program->disc.count; d++) turn_back(newton, d);
    for (int j = 0; j < program->n; j++) {
        double *x = &program->base.du[3 * j], v[3] = {x[0], x[1], x[2]};
        for (int a = 0; a < 3; a++) program->base.u[3 * j + a] += x[a];
        cpsi_newton_to_common(program, j, v);
        if (j > 0) {
            const double *m = &program->matrix.direction[3 * j];
            double along = 0;
            for (int a = 0; a < 3; a++) {
                const double d = v[a] - before[a];
                st->s[j][1 + a] += d / st->length[j];
                along += m[a] * d;
            }
            if (newton->taut[j]) {
                const double least =
                    cpsi_newton_may_hang(newton, j) ? -1 : LEAST_TENSION * st->z[j][0];
                const double now =
                    st->z[j][0] + program->dt[j] + program->matrix.stiffness[j] * along;
                st->z[j][0] = now > least ? now : least;
            }
        }
        for (int a = 0; a < 3; a++) before[a] = v[a];
    }
}
