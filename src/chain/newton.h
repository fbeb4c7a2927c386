/* SPDX-License-Identifier: BSD-3-Clause */
/* What the parts of Newton's method on the active set share (active_set.h): the state of one
 * solution, and what its contacts are like at the present iterate. */
#ifndef CAPSTAN_SRC_CHAIN_NEWTON_H
#define CAPSTAN_SRC_CHAIN_NEWTON_H

#include <math.h>

#include "chain/chain_program.h"
#include "chain/frame.h"

/* A slip shorter than this, per length of the line, has no direction (CPS_TOUCH). */
#define CPSI_LEAST_SLIP 1e-9

/* Bits of the status of a node, or of the point of an element: its contact is closed; friction may
 * act; friction sticks; the node has just landed, or stopped (one that slips against an edge of its
 * set: along that), and is not yet where that wants it; it was released and has not yet slipped in
 * the direction of its pull; both its contacts are closed, for good; its contact, which is open,
 * has friction of a kind that is not treated. */
enum {
    CPSI_CLOSED = 1,
    CPSI_HAS_FRICTION = 2,
    CPSI_STICKS = 4,
    CPSI_LANDS = 8,
    CPSI_STOPS = 16,
    CPSI_RELEASED = 32,
    CPSI_CORNER = 64,
    CPSI_BARRED = 128
};

/* A node whose two contacts are both closed: they, and the discs of their friction, -1: none; and
 * the sign of the friction along x where it slips. */
typedef struct CpsiCorner {
    int node, unilateral[2], disc[2], way;
} CpsiCorner;

/* Of one solution. The bytes lie in an array of the interior-point loop that is not used here. */
typedef struct CpsiNewton {
    CpsiChainProgram *program;
    unsigned char *status;   /* (2 n) of the nodes and of the points of their elements */
    unsigned char *held;     /* (n) the node cannot move in this set */
    unsigned char *taut;     /* (n) element i */
    unsigned char *anchored; /* (n) a field holds the node in all directions */
    int *piece;              /* (n) where the friction of a general set is on its boundary at a node
                                that slips */
    CpsiCorner *corner;      /* (most_corners) */
    int corner_count, most_corners;
    double *frame;      /* (n, 9) the axes of the nodes in the linear system, those
                           along an edge turned; NULL: as they are */
    double rounding;    /* of an elongation, and of a force per largest force */
    double noise;       /* the same of a force between nodes at rest */
    double force;       /* the largest force */
    double residual;    /* errors of the equations at the iterate before */
    bool polishes;      /* the guess is the solution but for its last digits */
    int most_released;  /* neighbours on either side of a node that are released with it */
    bool releases_more; /* ... were fewer than its force asked for */
    int slackened;      /* how often an element between nodes that move went slack */
    double strain_error, force_error; /* of the equations, at most */
    bool changed;                     /* the active set has changed */
    bool lost;                        /* there is something that this method does not treat */
    bool has_points;                  /* contacts of elements are closed, or have been */
} CpsiNewton;

static inline void cpsi_newton_to_common(const CpsiChainProgram *program, int j, double v[3]) {
    if (!program->frame) return;
    const double own[3] = {v[0], v[1], v[2]};
    cpsi_frame_from(v, &program->frame[9 * j], own);
}

/* Does element i lie between two nodes that cannot move? */
static inline bool cpsi_newton_is_fixed(const CpsiNewton *newton, int i) {
    return newton->held[i - 1] && newton->held[i];
}

/* Have the nodes of element i a place without its tension? */
static inline bool cpsi_newton_may_hang(const CpsiNewton *newton, int i) {
    return (newton->held[i - 1] || newton->anchored[i - 1]) &&
           (newton->held[i] || newton->anchored[i]);
}

static inline double cpsi_newton_size(const double v[2]) { return sqrt(v[0] * v[0] + v[1] * v[1]); }

/* Does the map of a disc turn the tangents of its node, as near a corner of two obstacles? */
static inline bool cpsi_newton_is_turned(const double *map) {
    return map && (map[1] != 0 || map[3] != 0);
}

/* The friction of a node in its tangent plane, for one disc: f = F/(w b), s = o + b u. Where the
 * tangents of the disc are turned from those of the node, s is in the axes of the node. */
typedef struct CpsiNodeFriction {
    double b[2], s[2], f[2];
    double bound; /* A */
} CpsiNodeFriction;

static inline CpsiNodeFriction cpsi_newton_friction(const CpsiChainProgram *program, int d) {
    const CpsiFrictionDisc *disc = &program->disc;
    const int j = disc->node[d];
    const double *u = &program->base.u[3 * j], *g = &program->base.residual[3 * j];
    CpsiNodeFriction out = {.b = {1, 1}};
    const double *map = disc->map ? disc->map[d] : NULL,
                 *offset = disc->offset ? disc->offset[d] : NULL;
    const bool is_turned = cpsi_newton_is_turned(map);
    for (int a = 0; a < 2; a++) {
        if (map && !is_turned) out.b[a] = map[4 * a];
        out.s[a] = out.b[a] * u[a];
        if (offset) out.s[a] += is_turned ? map[a] * offset[0] + map[3 + a] * offset[1] : offset[a];
        out.f[a] = -g[a] / (disc->weight[d] * out.b[a]);
    }
    out.bound = program->bounds_coupled
                    ? disc->friction[d] * program->unilateral.z[disc->unilateral[d]]
                    : disc->z[d][0];
    return out;
}

/* The boundary of the set of disc d; NULL: it is a disc. */
static inline const CpsiFrictionShape *cpsi_newton_shape(const CpsiChainProgram *program, int d) {
    return program->disc.shape ? program->disc.shape[d] : NULL;
}

/* By how much the force f exceeds the bound of disc d or, where that has a general set, its
 * distance from A times this; then also the piece of the boundary beside it, else -1. */
static inline double cpsi_newton_beyond(const CpsiChainProgram *program, int d, double bound,
                                        const double f[2], int *piece) {
    const CpsiFrictionShape *shape = cpsi_newton_shape(program, d);
    *piece = -1;
    if (!shape) return cpsi_newton_size(f) - bound;
    const double by = bound > 0 ? 1 / bound : 1e30, x[2] = {by * f[0], by * f[1]};
    return cpsi_friction_shape_beyond(shape, x, piece) / by;
}

/* The piece of the boundary at which disc d slips; NULL: the circle of the bound itself. */
static inline const CpsiShapePiece *cpsi_newton_piece(const CpsiNewton *newton, int d) {
    const CpsiFrictionShape *shape = cpsi_newton_shape(newton->program, d);
    return shape ? &shape->piece[newton->piece[newton->program->disc.node[d]]] : NULL;
}

static inline double cpsi_newton_dot(const double a[2], const double b[2]) {
    return a[0] * b[0] + a[1] * b[1];
}

/* The counterclockwise tangent of an edge. */
static inline void cpsi_newton_tangent(const CpsiShapePiece *edge, double t[2]) {
    t[0] = -edge->normal[0][1];
    t[1] = edge->normal[0][0];
}

/* Is this the second contact of its node? */
static inline bool cpsi_newton_is_other(const CpsiChainProgram *program, int k) {
    return k >= 0 && program->unilateral.normal && program->unilateral.second[k];
}

/* Cannot node j, or the point j of an element, move? */
static inline bool cpsi_newton_is_held(const CpsiNewton *newton, int j) {
    return j < newton->program->n && newton->held[j];
}

/* Is place j the point of an element? */
static inline bool cpsi_newton_is_point(const CpsiNewton *newton, int j) {
    return j >= newton->program->n;
}

/* Are both contacts of node j closed? */
static inline bool cpsi_newton_is_corner(const CpsiNewton *newton, int j) {
    return j < newton->program->n && (newton->status[j] & CPSI_CORNER);
}

/* May friction act on disc d, of a node with one contact? */
static inline bool cpsi_newton_has_friction(const CpsiNewton *newton, int d) {
    const CpsiChainProgram *program = newton->program;
    const int j = program->disc.node[d];
    if (cpsi_newton_is_other(program, program->disc.unilateral[d]) ||
        cpsi_newton_is_corner(newton, j))
        return false;
    return !program->bounds_coupled || (newton->status[j] & CPSI_CLOSED);
}

/* Does what contact k is with give, without friction? Its reaction is z = max(0, -gap/c) then, in
 * whatever set. */
static inline bool cpsi_newton_gives(const CpsiChainProgram *program, int k) {
    return program->unilateral.compliance && program->unilateral.compliance[k] > 0;
}

/* The gap of unilateral contact k. */
static inline double cpsi_newton_gap(const CpsiChainProgram *program, int k) {
    const CpsiUnilateral *unilateral = &program->unilateral;
    const int j = unilateral->node[k];
    if (j >= program->n) cpsi_chain_point_place(program, j - program->n, program->base.u);
    return unilateral->gap[k] + cpsi_unilateral_rise(unilateral, k, program->base.u);
}

/* active_move.c */

/* Move node j by (x, y, z) in its own axes. */
void cpsi_newton_move(CpsiNewton *newton, int j, double x, double y, double z);

/* active_point.c */

/* May the contact of the point j of an element be closed? Not where a third obstacle is met at the
 * end of the element, nor beside general sets. */
bool cpsi_newton_may_close_point(const CpsiNewton *newton, int j);

/* The contact of the point j is closed from here on; its force is what it was. */
void cpsi_newton_close_point(CpsiNewton *newton, int j);

/* Contact k, of a point, is closed in the guess. False where it may not. */
bool cpsi_newton_begin_point(CpsiNewton *newton, int k);

/* ... and has the friction of disc d. */
void cpsi_newton_begin_point_friction(CpsiNewton *newton, int d);

/* The points move with their elements, and their forces are added to those on the nodes. */
void cpsi_newton_measure_points(CpsiNewton *newton);

/* Before the linear system is solved, and after: the forces on the points change by what the
 * right-hand side has at them, less D x. */
void cpsi_newton_give_points(CpsiNewton *newton);
void cpsi_newton_take_points(CpsiNewton *newton);

/* active_corner.c */

/* The node of unilateral contacts `first` (-1: it has none) and `second` is in a corner in the
 * guess; it is moved to where that wants it. False where it is of a kind that is not treated. */
bool cpsi_corner_begin(CpsiNewton *newton, int first, int second);

/* Nodes that slip in corners and are pushed by their friction stop. */
void cpsi_corner_decide(CpsiNewton *newton);

/* The rows of the nodes that slip in corners, and the errors of their equations. */
void cpsi_corner_load(CpsiNewton *newton);

/* The pairs of the solution. False, and none is written, where a node at rest does not bear its
 * force. */
bool cpsi_corner_finish(const CpsiNewton *newton);

/* active_status.c */

/* The active set of the guess; nodes are moved to where it wants them. */
void cpsi_newton_begin(CpsiNewton *newton);

/* Change the active set where the present iterate violates it. */
void cpsi_newton_decide(CpsiNewton *newton);

/* active_system.c */

/* Set up the linear system of the present set, and find the errors of its equations. */
void cpsi_newton_assemble(CpsiNewton *newton);

/* u and T by the solution of the linear system. */
void cpsi_newton_advance(CpsiNewton *newton);

#endif
