/* SPDX-License-Identifier: BSD-3-Clause */
/* The active set of Newton's method (active_set.c): which of each pair holds, read from the sign of
 * what the other one leaves free. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "chain/newton.h"
#include "chain/slack.h"

/* An element that may not go slack has this share of the largest force. */
static const double LEAST_TENSION = 1e-3;
/* While the equations have errors, a force that exceeds its bound by less than this share of them
 * may be at it: nodes at rest with such forces are not released yet. */
static const double SIGNIFICANT = 1e-4;
/* Of the neighbours on either side of a node, so many are released with it. Where a whole piece is
 * at its bounds, as after it has slipped, what exceeds them at an iterate may be an error of that
 * iterate. */
enum { LEAST_RELEASED = 30 };

/* elements ------------------------------------------------------------------------------------- */

/* Has node j a place without the tensions of its elements: is it held, at rest or about to be, or
 * held by a field? */
static bool has_place(const CpsiNewton *newton, int j) {
    const unsigned char rests = CPSI_CLOSED | CPSI_STICKS;
    return newton->held[j] || newton->anchored[j] || (newton->status[j] & rests) == rests;
}

/* Is element i as long as without tension, between a node at rest and one that the taut element
 * behind it holds, as where that node has just begun to slip? */
static bool is_at_front(const CpsiNewton *newton, int i) {
    const CpsiSegment *st = &newton->program->segment;
    const bool before = has_place(newton, i - 1), after = has_place(newton, i);
    const int other = before ? i + 1 : i - 1;
    return before != after && other > 0 && other < newton->program->n && newton->taut[other] &&
           st->z[other][0] > 0 && fabs(1 / st->inverse_w[i] - 1) <= newton->rounding;
}

/* Has node j a place without the tension of element i beside it, since the one on its other side is
 * taut? */
static bool is_carried(const CpsiNewton *newton, int j, int i) {
    const int other = j < i ? i - 1 : i + 1;
    return has_place(newton, j) ||
           (other > 0 && other < newton->program->n && newton->taut[other] &&
            newton->program->segment.z[other][0] > 0);
}

/* May element i be slack in a solution that is only to be polished? */
static bool may_lie(const CpsiNewton *newton, int i) {
    return newton->polishes && !is_at_front(newton, i) && is_carried(newton, i - 1, i) &&
           is_carried(newton, i, i);
}

/* Elements that are slack in a solution that is only to be polished have no tension at first, where
 * their nodes have places without it. At a front the solution of the loop may leave several in a
 * row that can be told neither way; these keep what tension they have. */
static void begin_slack(CpsiNewton *newton) {
    CpsiSegment *st = &newton->program->segment;
    for (int i = 1; i < newton->program->n; i++) {
        if (newton->taut[i]) continue;
        const bool slack = cpsi_newton_is_fixed(newton, i) || cpsi_newton_may_hang(newton, i) ||
                           (is_carried(newton, i - 1, i) && is_carried(newton, i, i));
        newton->taut[i] = !slack && st->z[i][0] > 0;
        if (slack) st->z[i][0] = 0;
    }
}

/* Element i would be slack between nodes that move: it keeps a little tension, so that they are
 * held; none where it is at a front of a solution that is only to be polished. Where that goes on
 * there is no equilibrium with tension in it. */
static void keep_taut(CpsiNewton *newton, int i) {
    enum { MOST = 40 };
    const bool none = newton->polishes && is_at_front(newton, i);
    newton->taut[i] = true;
    newton->program->segment.z[i][0] = none ? 0 : LEAST_TENSION * newton->force;
    newton->changed = true;
    if (++newton->slackened > MOST) newton->lost = true;
}

/* Which elements are taut. */
static void decide_elements(CpsiNewton *newton) {
    CpsiSegment *st = &newton->program->segment;
    for (int i = 1; i < newton->program->n; i++) {
        const bool before = newton->taut[i], fixed = cpsi_newton_is_fixed(newton, i);
        bool now = before;
        if (before && st->z[i][0] < 0) now = false;
        if (!before && st->g[i] > newton->rounding) now = true;
        if (now != before) newton->changed = true;
        newton->taut[i] = now;
        if (!now) st->z[i][0] = 0;
        if (!now && !fixed && !cpsi_newton_may_hang(newton, i) && !may_lie(newton, i))
            keep_taut(newton, i);
        if (now && fixed && st->compliance == 0) newton->lost = true;
    }
}

/* contacts ------------------------------------------------------------------------------------- */

/* Move the node of unilateral contact k onto its surface. */
static void close_contact(CpsiNewton *newton, int k) {
    const CpsiUnilateral *unilateral = &newton->program->unilateral;
    const int j = unilateral->node[k];
    newton->status[j] |= CPSI_CLOSED;
    cpsi_newton_move(newton, j, 0, 0, -unilateral->gap[k] - newton->program->base.u[3 * j + 2]);
}

/* Move the node of disc d back to where it has not slipped; a point of an element is pulled. */
static void stick(CpsiNewton *newton, int d) {
    const int j = newton->program->disc.node[d];
    if (cpsi_newton_is_point(newton, j)) {
        newton->status[j] |= CPSI_STICKS | CPSI_STOPS;
        return;
    }
    const CpsiNodeFriction now = cpsi_newton_friction(newton->program, d);
    newton->status[j] |= CPSI_STICKS;
    cpsi_newton_move(newton, j, -now.s[0] / now.b[0], -now.s[1] / now.b[1], 0);
}

/* Move the node of disc d back to where it has not slipped along an edge of its set. */
static void stop_along(CpsiNewton *newton, int d, const CpsiShapePiece *edge) {
    const CpsiNodeFriction now = cpsi_newton_friction(newton->program, d);
    double t[2];
    cpsi_newton_tangent(edge, t);
    const double by = -cpsi_newton_dot(now.s, t);
    cpsi_newton_move(newton, newton->program->disc.node[d], by * t[0], by * t[1], 0);
}

/* Does a map turn the tangents of the node, and nothing else? */
static bool is_rotation(const double b[6]) {
    static const double ROUNDED = 1e-12;
    return fabs(b[0] * b[0] + b[1] * b[1] - 1) <= ROUNDED && fabs(b[0] - b[4]) <= ROUNDED &&
           fabs(b[1] + b[3]) <= ROUNDED && b[2] == 0 && b[5] == 0;
}

/* Is the map of disc d diagonal and regular, or a rotation, and the disc the only one of its
 * contact? */
static bool is_plain(const CpsiChainProgram *program, int d) {
    const CpsiFrictionDisc *disc = &program->disc;
    if (d > 0 && disc->node[d - 1] == disc->node[d]) return false;
    if (!disc->map) return true;
    const double *b = disc->map[d];
    if (cpsi_newton_is_turned(b)) return is_rotation(b) && !cpsi_newton_shape(program, d);
    if (cpsi_newton_shape(program, d) && (b[0] != 1 || b[4] != 1)) return false;
    return b[0] > 0 && b[4] > 0 && b[1] == 0 && b[2] == 0 && b[3] == 0 && b[5] == 0;
}

/* Which nodes cannot move. */
static void note_held(CpsiNewton *newton) {
    for (int j = 0; j < newton->program->n; j++) {
        const unsigned char all = CPSI_CLOSED | CPSI_STICKS | CPSI_LANDS | CPSI_STOPS,
                            rests = CPSI_CLOSED | CPSI_STICKS;
        newton->held[j] = newton->program->held[j] || (newton->status[j] & all) == rests;
    }
}

/* Which nodes the field holds by itself: its K - e I is positive definite. */
static void note_anchored(CpsiNewton *newton) {
    static const double LEAST = 1e-6; /* e */
    const CpsiChainProgram *program = newton->program;
    memset(newton->anchored, 0, (size_t)program->n);
    for (int j = 0; program->field && j < program->n; j++) {
        const double *k = &program->field[6 * j], first = k[0] - LEAST,
                     second = k[2] - LEAST - k[1] * k[1] / first,
                     mixed = k[4] - k[1] * k[3] / first,
                     third = k[5] - LEAST - k[3] * k[3] / first - mixed * mixed / second;
        newton->anchored[j] = first > 0 && second > 0 && third > 0;
    }
}

/* The piece of the boundary of its set at which disc d slips: that of the point nearest to the
 * force f, per bound, with a long pull against the slip; -1 where there is none. */
static int piece_of_slip(const CpsiNewton *newton, int d, const double f[2]) {
    static const double FAR = 100;
    const CpsiFrictionShape *shape = newton->program->disc.shape[d];
    const CpsiNodeFriction now = cpsi_newton_friction(newton->program, d);
    const double slip = cpsi_newton_size(now.s), pull = slip > 0 ? FAR * shape->reach / slip : 0;
    const double x[2] = {f[0] - pull * now.s[0], f[1] - pull * now.s[1]};
    int piece;
    (void)cpsi_friction_shape_beyond(shape, x, &piece);
    return piece;
}

/* Disc d slips on a piece of the boundary of its set. */
static void put_on_piece(CpsiNewton *newton, int d, int piece) {
    const CpsiFrictionDisc *disc = &newton->program->disc;
    newton->piece[disc->node[d]] = piece;
    for (int a = 0; a < 2; a++) disc->w[d][1 + a] = disc->shape[d]->piece[piece].normal[0][a];
}

/* ... in the guess; it sticks where there is none. */
static void begin_piece(CpsiNewton *newton, int d) {
    const CpsiFrictionDisc *disc = &newton->program->disc;
    const int piece = piece_of_slip(newton, d, &disc->z[d][1]);
    if (piece < 0) {
        stick(newton, d);
        return;
    }
    put_on_piece(newton, d, piece);
    if (disc->shape[d]->piece[piece].is_edge) stop_along(newton, d, &disc->shape[d]->piece[piece]);
}

/* The status of friction that the guess gives. False where it is of a kind that is not treated. */
static bool begin_friction(CpsiNewton *newton, int d) {
    const CpsiChainProgram *program = newton->program;
    const CpsiFrictionDisc *disc = &program->disc;
    if (cpsi_newton_is_other(program, disc->unilateral[d]) ||
        cpsi_newton_is_corner(newton, disc->node[d]))
        return program->bounds_coupled;
    if (!is_plain(program, d)) {
        newton->status[disc->node[d]] |= CPSI_BARRED;
        return program->bounds_coupled && !(newton->status[disc->node[d]] & CPSI_CLOSED);
    }
    newton->status[disc->node[d]] |= CPSI_HAS_FRICTION;
    if (!cpsi_newton_has_friction(newton, d)) return true;
    if (cpsi_newton_is_point(newton, disc->node[d])) cpsi_newton_begin_point_friction(newton, d);
    if (!(disc->s[d][0] > 0))
        stick(newton, d);
    else if (cpsi_newton_shape(program, d))
        begin_piece(newton, d);
    return true;
}

void cpsi_newton_begin(CpsiNewton *newton) {
    CpsiChainProgram *program = newton->program;
    const CpsiUnilateral *unilateral = &program->unilateral;
    const CpsiFrictionDisc *disc = &program->disc;
    newton->lost =
        program->conic.count > 0 || program->drag > 0 || (program->field && program->disc.shape);
    newton->most_released = LEAST_RELEASED;
    newton->releases_more = false;
    note_anchored(newton);
    memset(newton->status, 0, 2 * (size_t)program->n);
    memset(newton->piece, 0, (size_t)program->n * sizeof *newton->piece);
    memset(disc->w, 0, (size_t)disc->count * sizeof *disc->w);
    for (int i = 1; i < program->n; i++)
        newton->taut[i] = program->segment.z[i][0] > 0 &&
                          !(newton->polishes && cpsi_segment_is_slack(&program->segment, i));
    for (int k = 0; k < unilateral->count && !newton->lost; k++) {
        if (!(unilateral->z[k] > 0) || cpsi_newton_gives(program, k)) continue;
        if (cpsi_newton_is_other(program, k))
            newton->lost = !cpsi_corner_begin(newton, k - 1, k);
        else if (cpsi_newton_is_point(newton, unilateral->node[k]))
            newton->lost = !cpsi_newton_begin_point(newton, k);
        else
            close_contact(newton, k);
    }
    for (int d = 0; d < disc->count && !newton->lost; d++)
        newton->lost = !begin_friction(newton, d);
    note_held(newton);
    if (newton->polishes) begin_slack(newton);
    if (program->segment.compliance > 0) return;
    for (int i = 1; i < program->n && !newton->lost; i++)
        newton->lost = newton->taut[i] && cpsi_newton_is_fixed(newton, i);
}

/* The force on contact k pulls its node off by `pull`: an edge at which a line leaves what bears it
 * should lie farther back, where the reactions up to it sum to that. Those nodes are open too. */
static void open_neighbours(CpsiNewton *newton, int k, double pull) {
    const CpsiChainProgram *program = newton->program;
    const CpsiUnilateral *unilateral = &program->unilateral;
    for (int side = -1; side <= 1; side += 2) {
        double left = pull;
        for (int e = k + side; e >= 0 && e < unilateral->count; e += side) {
            const int j = unilateral->node[e];
            if (j != unilateral->node[e - side] + side || !(newton->status[j] & CPSI_CLOSED) ||
                cpsi_newton_is_corner(newton, j) || cpsi_newton_is_point(newton, j))
                break;
            left -= fmax(0, -program->base.residual[3 * j + 2]);
            if (left <= 0) break;
            newton->status[j] &= CPSI_HAS_FRICTION;
        }
    }
}

/* Which contacts are closed; R of those. */
static void decide_contacts(CpsiNewton *newton) {
    const CpsiChainProgram *program = newton->program;
    const CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < unilateral->count; k++) {
        const int j = unilateral->node[k];
        if (cpsi_newton_is_corner(newton, j) || cpsi_newton_gives(program, k)) continue;
        const double gap = cpsi_newton_gap(program, k);
        if (cpsi_newton_is_other(program, k)) {
            newton->lost = newton->lost || gap < -newton->rounding;
            continue;
        }
        const double force = -program->base.residual[3 * j + 2];
        unsigned char *status = &newton->status[j];
        const bool is_point = cpsi_newton_is_point(newton, j);
        if ((*status & CPSI_CLOSED) && (*status & CPSI_LANDS) && !is_point) {
            *status &= (unsigned char)~CPSI_LANDS;
            close_contact(newton, k);
            newton->changed = true;
        }
        if (*status & CPSI_CLOSED) {
            unilateral->z[k] = force > 0 ? force / unilateral->weight[k] : 0;
            if (force >= -newton->noise * newton->force) continue;
            *status &= CPSI_HAS_FRICTION;
            newton->changed = true;
            if (!is_point) open_neighbours(newton, k, -force);
        } else if (gap < -newton->rounding) {
            newton->lost |=
                (*status & CPSI_BARRED) || (is_point && !cpsi_newton_may_close_point(newton, j));
            if (newton->lost) continue;
            if (is_point) cpsi_newton_close_point(newton, j);
            *status |= CPSI_CLOSED | CPSI_LANDS;
            unilateral->z[k] = force > 0 ? force / unilateral->weight[k] : 0;
            newton->changed = true;
        }
    }
}

/* Let disc d slip in the direction of -f, or where f is nearest to its set. */
static void release(CpsiNewton *newton, int d, const double f[2]) {
    const CpsiChainProgram *program = newton->program;
    const CpsiFrictionDisc *disc = &program->disc;
    const double size = cpsi_newton_size(f);
    const int j = disc->node[d];
    unsigned char *status = &newton->status[j];
    if (cpsi_newton_shape(program, d)) {
        int piece;
        const CpsiNodeFriction now = cpsi_newton_friction(program, d);
        if (!(cpsi_newton_beyond(program, d, now.bound, f, &piece) > 0)) return;
        newton->piece[j] = piece;
    }
    *status = (*status & (unsigned char)~(CPSI_STICKS | CPSI_STOPS)) | CPSI_RELEASED;
    for (int a = 0; a < 2; a++) disc->w[d][1 + a] = f[a] / size;
    newton->changed = true;
}

/* The largest l with f + l q inside the bound of disc e. */
static double room_of(const CpsiNewton *newton, int e, const CpsiNodeFriction *now,
                      const double q[2]) {
    const CpsiFrictionShape *shape = cpsi_newton_shape(newton->program, e);
    if (shape) {
        const double by = now->bound > 0 ? 1 / now->bound : 0;
        const double x[2] = {by * now->f[0], by * now->f[1]};
        return now->bound * cpsi_friction_shape_reach(shape, x, q);
    }
    const double along = cpsi_newton_dot(now->f, q), across = now->f[1] * q[0] - now->f[0] * q[1];
    return sqrt(fmax(0, now->bound * now->bound - across * across)) - along;
}

/* The force on disc d, which sticks, exceeds its bound by `excess`, nearest to a piece of its set:
 * the excess will be carried by what its neighbours can still take in its direction q, at most l
 * with f + l q in A C, and those that cannot take it slip too. */
static void release_neighbours(CpsiNewton *newton, int d, const CpsiNodeFriction *now,
                               double excess, int piece) {
    const CpsiChainProgram *program = newton->program;
    const CpsiFrictionDisc *disc = &program->disc;
    double q[2] = {now->f[0], now->f[1]};
    if (piece >= 0) {
        const CpsiShapePiece *at = &disc->shape[d]->piece[piece];
        for (int a = 0; a < 2; a++)
            q[a] = at->is_edge ? at->normal[0][a] : now->f[a] - now->bound * at->centre[a];
    }
    const double size = cpsi_newton_size(q);
    for (int a = 0; a < 2; a++) q[a] /= size;
    for (int side = -1; side <= 1; side += 2) {
        double left = disc->weight[d] * excess;
        int released = 0;
        for (int e = d + side; e >= 0 && e < disc->count; e += side) {
            if (released++ == newton->most_released) {
                newton->releases_more = true;
                break;
            }
            const int j = disc->node[e];
            if (j != disc->node[e - side] + side || !(newton->status[j] & CPSI_STICKS) ||
                cpsi_newton_is_corner(newton, j))
                break;
            const CpsiNodeFriction next = cpsi_newton_friction(program, e);
            const double most = room_of(newton, e, &next, q);
            left -= disc->weight[e] * most;
            if (left <= 0) break;
            const double far = piece >= 0 ? most + left / disc->weight[e] : most;
            const double to[2] = {next.f[0] + far * q[0], next.f[1] + far * q[1]};
            release(newton, e, cpsi_newton_size(to) > 0 ? to : now->f);
        }
    }
}

/* F.s of disc d, or n.s at an edge with normal n: what slips is pushed by its friction where this
 * is positive. A slip that is rounding, as that of a node just released, has no direction: 0. */
static double push(const CpsiNewton *newton, int d) {
    const CpsiNodeFriction now = cpsi_newton_friction(newton->program, d);
    const CpsiShapePiece *piece = cpsi_newton_piece(newton, d);
    const double *along = piece && piece->is_edge ? piece->normal[0] : now.f,
                 by = cpsi_newton_dot(now.s, along),
                 least = DBL_EPSILON * DBL_EPSILON * cpsi_newton_dot(along, along);
    return by * by > least ? by : 0;
}

/* Does disc d slip, on a node beside that of disc e? */
static bool slips_beside(const CpsiNewton *newton, int d, int e) {
    const CpsiFrictionDisc *disc = &newton->program->disc;
    return d >= 0 && d < disc->count && abs(disc->node[d] - disc->node[e]) == 1 &&
           cpsi_newton_has_friction(newton, d) && !(newton->status[disc->node[d]] & CPSI_STICKS);
}

static void stop(CpsiNewton *newton, int d) {
    unsigned char *status = &newton->status[newton->program->disc.node[d]];
    *status = (*status & (unsigned char)~CPSI_RELEASED) | CPSI_STICKS | CPSI_STOPS;
    newton->changed = true;
}

/* The discs `first` to `last`, on nodes side by side, slip and are pushed by their friction. They
 * stop; but if they have just been released beside a piece that slips, it was too many of them, and
 * the half beside it goes on. */
static void stop_run(CpsiNewton *newton, int first, int last) {
    const CpsiFrictionDisc *disc = &newton->program->disc;
    int released = 0;
    for (int d = first; d <= last; d++)
        released += (newton->status[disc->node[d]] & CPSI_RELEASED) != 0;
    const bool before = slips_beside(newton, first - 1, first),
               after = slips_beside(newton, last + 1, last);
    int from = first, to = last;
    if (released > 1 && before != after) {
        if (after) to = first + (released - 1) / 2;
        if (before) from = last - (released - 1) / 2;
    }
    if (released > 0) newton->most_released = LEAST_RELEASED;
    for (int d = from; d <= to; d++) stop(newton, d);
}

/* Discs that slip and are pushed by their friction stop. */
static void stop_friction(CpsiNewton *newton) {
    const CpsiFrictionDisc *disc = &newton->program->disc;
    for (int d = 0, next; d < disc->count; d = next) {
        next = d + 1;
        if (!cpsi_newton_has_friction(newton, d) ||
            (newton->status[disc->node[d]] & (CPSI_STICKS | CPSI_LANDS)))
            continue;
        const double pushed = push(newton, d);
        if (pushed < 0) newton->status[disc->node[d]] &= (unsigned char)~CPSI_RELEASED;
        if (!(pushed > 0)) continue;
        while (slips_beside(newton, next, next - 1) && push(newton, next) > 0) next++;
        stop_run(newton, d, next - 1);
    }
}

/* The piece of the boundary of its set at which disc d slips: from an edge to what is beside it,
 * where the force has gone past its end; from an arc or a corner to where the slip points. */
static void decide_piece(CpsiNewton *newton, int d) {
    const CpsiFrictionDisc *disc = &newton->program->disc;
    const CpsiFrictionShape *shape = disc->shape[d];
    const int j = disc->node[d], from = newton->piece[j];
    const CpsiShapePiece *here = &shape->piece[from];
    const CpsiNodeFriction now = cpsi_newton_friction(newton->program, d);
    int to = from;
    if (newton->status[j] & CPSI_LANDS) {
        static const double NONE[2] = {0, 0};
        const int lands = piece_of_slip(newton, d, NONE);
        to = lands < 0 ? from : lands;
    } else if (here->is_edge) {
        double t[2];
        cpsi_newton_tangent(here, t);
        if (newton->status[j] & CPSI_STOPS) {
            newton->status[j] &= (unsigned char)~CPSI_STOPS;
            stop_along(newton, d, here);
            newton->changed = true;
        }
        const double along = cpsi_newton_dot(now.f, t),
                     past = newton->noise * newton->force / disc->weight[d];
        if (along < now.bound * cpsi_newton_dot(here->at[0], t) - past)
            to = from > 0 ? from - 1 : shape->count - 1;
        else if (along > now.bound * cpsi_newton_dot(here->at[1], t) + past)
            to = from + 1 < shape->count ? from + 1 : 0;
    } else {
        const double slip = cpsi_newton_size(now.s), q[2] = {-now.s[0] / slip, -now.s[1] / slip};
        if (slip > CPSI_LEAST_SLIP)
            to = cpsi_friction_shape_turn(shape, from, q, newton->rounding / slip);
    }
    if (to == from) return;
    put_on_piece(newton, d, to);
    newton->changed = true;
    if (shape->piece[to].is_edge) newton->status[j] |= CPSI_STOPS;
}

/* Where friction sticks. A node that lands slips at first. */
static void decide_friction(CpsiNewton *newton) {
    const CpsiChainProgram *program = newton->program;
    const CpsiFrictionDisc *disc = &program->disc;
    if (newton->releases_more) newton->most_released *= 2;
    newton->releases_more = false;
    for (int d = 0; d < disc->count; d++) {
        if (!cpsi_newton_has_friction(newton, d)) continue;
        unsigned char *status = &newton->status[disc->node[d]];
        if (!(*status & CPSI_STICKS)) {
            if (cpsi_newton_shape(program, d)) decide_piece(newton, d);
            continue;
        }
        const CpsiNodeFriction now = cpsi_newton_friction(program, d);
        if ((*status & CPSI_STOPS) && !cpsi_newton_is_point(newton, disc->node[d])) {
            *status &= (unsigned char)~CPSI_STOPS;
            stick(newton, d);
            newton->changed = true;
        }
        int piece;
        const double excess = cpsi_newton_beyond(program, d, now.bound, now.f, &piece);
        if (disc->weight[d] * excess <=
            fmax(newton->noise, SIGNIFICANT * newton->residual) * newton->force)
            continue;
        release(newton, d, now.f);
        release_neighbours(newton, d, &now, excess, piece);
    }
    stop_friction(newton);
}

void cpsi_newton_decide(CpsiNewton *newton) {
    decide_contacts(newton);
    decide_friction(newton);
    cpsi_corner_decide(newton);
    note_held(newton);
    decide_elements(newton);
}
