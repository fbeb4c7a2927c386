/* SPDX-License-Identifier: BSD-3-Clause */
/* The chain back end: block tridiagonal elimination from both ends towards the middle node, one
 * node at a time, each node before the tension of the element before it.
 *
 * Take the unknowns as blocks (x_j, t_j). Eliminating blocks 0..j-1 leaves on block j the 4 x 4
 * matrix
 *
 *     S_j = [ X   v ; v'^T  -b ],   X = D_j + (k_j + k_{j+1}) I - k_j^2 C,   v = m_j - k_j C m_j,
 *         v' = m_j - k_j C^T m_j,
 *                                   b = a_j + m_j.C m_j,
 *
 * where C = (S_{j-1}^-1)_xx is the compliance at node j-1 of all that lies before it (0 where it is
 * held); it is symmetric where there is no skew. With Y = X^-1, y = Y v, y' = Y^T v', beta = b +
 * v'.y:
 *
 *     (S_j^-1)_xx = Y - y y'^T/beta = C_j,     (S_j^-1)_xt = y/beta,     (S_j^-1)_tx = y'^T/beta,
 *         (S_j^-1)_tt = -1/beta.
 *
 * From the last node on it is the same with the element behind the node in place of that before it,
 * and -m in place of m: d and m change their signs together. The two halves do not depend on each
 * other, so they are eliminated side by side (halves.h), and neither waits for its own divisions
 * alone. At the middle node M the other half adds -k^2 C to X, and the tension of the element
 * between, whose row and column are v' and v of that half, is the last unknown.
 *
 * Where there is a second direction, Y = (X + c r^T/a)^-1 and f = r.x/a come from the inverse of [X
 * c; r^T -a].
 *
 * Where the element before node j has a point, its three force components are unknowns beside t_j
 * (chain_point.h). Then the last node takes the place of the middle one, and all are eliminated
 * from the first on.
 *
 * C and m are in the axes of node j; where nodes have axes of their own, they are rotated from node
 * to node.
 *
 * The factorisation stores a few small quantities per node, and a solve is two passes of 3 x 3
 * products. Compliances in series add without cancellation. That is why the tension is kept as an
 * unknown: the axial stiffness 1/a_j of an element is never added to k_j. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "chain/chain_factor.h"
#include "chain/frame.h"

static CpsiLinsys *chain_layout(CpsiArena *arena, int n, bool second, bool points,
                                size_t *scratch) {
    CpsiChainFactor measured, *placed = cpsi_arena_take(arena, 1, sizeof *placed),
                              *chain = placed ? placed : &measured;
    *scratch = arena->used;
    CPSI_PLACE(arena, chain->block, points ? n : n / 2 + 1);
    if (second) CPSI_PLACE(arena, chain->second, n);
    if (points) CPSI_PLACE(arena, chain->point, n);
    for (int k = 0; k < 2; k++) chain->scratch[k] = cpsi_unknowns_layout(arena, points ? n : 0);
    return (CpsiLinsys *)placed;
}

/* The inverse: z is eliminated first, as it is along the obstacle's normal, the stiffest direction
 * where there is contact; then the remaining 2 x 2 block of x and y is inverted by its determinant.
 * Pivots below the rounding level are replaced by it. What needs neither quotient is computed while
 * the divisions last, and choices are made between quotients. */
CPSI_HALVES_FUNCTION void inverse(CpsiHalves out[9], const CpsiHalves a[9]) {
    const double least = DBL_MIN / DBL_EPSILON;
    const CpsiHalves most = cpsi_halves(1 / least, 1 / least);
    /* [a c; r z] = [1 l; 0 1] [block 0; 0 z] [1 0; m 1] */
    const CpsiHalves iz = cpsi_halves_choose(a[8] > least, 1 / a[8], most);
    const CpsiHalves lx = a[2] * iz, ly = a[5] * iz, mx = a[6] * iz, my = a[7] * iz;
    const CpsiHalves xx = a[0] - lx * a[6], xy = a[1] - lx * a[7], yx = a[3] - ly * a[6],
                     yy = a[4] - ly * a[7];
    const CpsiHalves product = xx * yy, det = product - xy * yx,
                     floor = 4 * DBL_EPSILON * cpsi_halves_abs(product) + least;
    /* the adjugate of the block, and its products with l and m */
    const CpsiHalves ax = yy * lx - xy * ly, ay = xx * ly - yx * lx;
    const CpsiHalves bx = mx * yy - my * yx, by = my * xx - mx * xy, ab = mx * ax + my * ay;
    const CpsiHalves inverse_det =
        cpsi_halves_choose(cpsi_halves_abs(det) > floor, 1 / det, 1 / floor);
    out[0] = yy * inverse_det;
    out[1] = -xy * inverse_det;
    out[2] = -ax * inverse_det;
    out[3] = -yx * inverse_det;
    out[4] = xx * inverse_det;
    out[5] = -ay * inverse_det;
    out[6] = -bx * inverse_det;
    out[7] = -by * inverse_det;
    out[8] = iz + ab * inverse_det;
}

/* The inverse of [X c; r^T -a]: its first three rows and columns, w of its last row, r.x/a = w.f of
 * the x that f gives, and its last column. With row exchanges: the entries of X may be nearly zero
 * (a slack line), huge (an obstacle) or both. */
static void inverse_with_second(double out[9], CpsiChainSecond *second, const double x[9],
                                const double c[3], const double r[3], double a) {
    double m[4][8] = {{x[0], x[1], x[2], c[0], 1, 0, 0, 0},
                      {x[3], x[4], x[5], c[1], 0, 1, 0, 0},
                      {x[6], x[7], x[8], c[2], 0, 0, 1, 0},
                      {r[0], r[1], r[2], -a, 0, 0, 0, 1}};
    for (int k = 0; k < 4; k++) {
        int best = k;
        for (int i = k + 1; i < 4; i++)
            if (fabs(m[i][k]) > fabs(m[best][k])) best = i;
        if (best != k)
            for (int l = 0; l < 8; l++) {
                const double swap = m[k][l];
                m[k][l] = m[best][l];
                m[best][l] = swap;
            }
        if (fabs(m[k][k]) < DBL_MIN) m[k][k] = DBL_MIN;
        for (int i = k + 1; i < 4; i++) {
            const double by = m[i][k] / m[k][k];
            for (int l = k + 1; l < 8; l++) m[i][l] -= by * m[k][l];
        }
    }
    for (int l = 4; l < 8; l++) {
        double z[4];
        for (int k = 3; k >= 0; k--) {
            z[k] = m[k][l];
            for (int i = k + 1; i < 4; i++) z[k] -= m[k][i] * z[i];
            z[k] /= m[k][k];
        }
        for (int i = 0; i < 3; i++) *(l < 7 ? &out[3 * i + l - 4] : &second->column[i]) = z[i];
        *(l < 7 ? &second->w[l - 4] : &second->corner) = z[3];
    }
}

/* What the elimination of the nodes before leaves to a node, in that node's axes: C of the node
 * before, and of the element between k, m, v, v' and b. */
typedef struct NodeBorder {
    CpsiHalves k, c[9], m[3], v[3], vt[3], b;
} NodeBorder;

static const NodeBorder NO_BORDER = {.b = {1, 1}};

/* Rotate C of the node before, and m, to the axes of the node. */
static inline void turn_to_node(NodeBorder *border, const CpsiMatrix *a, const CpsiPlaces *at) {
    CPSI_FOR_HALVES(l) {
        const double *frame = &a->frame[9 * at->node[l]];
        double relative[9], c[9], m[3], turned_c[9], turned_m[3];
        for (int i = 0; i < 9; i++) c[i] = border->c[i][l];
        for (int i = 0; i < 3; i++) m[i] = border->m[i][l];
        cpsi_frame_relative(relative, frame, &a->frame[9 * at->before[l]]);
        cpsi_frame_turn(turned_c, relative, c);
        cpsi_frame_to(turned_m, frame, m);
        for (int i = 0; i < 9; i++) border->c[i][l] = turned_c[i];
        for (int i = 0; i < 3; i++) border->m[i][l] = turned_m[i];
    }
}

CPSI_HALVES_FUNCTION void fill_border(NodeBorder *border, const CpsiChainFactor *chain,
                                      const CpsiMatrix *a, const CpsiPlaces *at, const bool plain) {
    const CpsiHalves *before = chain->block[at->passed - 1].c;
    CpsiHalves cm[3], ctm[3];
    const CpsiHalves k = border->k = cpsi_halves_get(a->stiffness, at->element, 1, 0);
    for (int i = 0; i < 9; i++)
        border->c[i] = cpsi_halves(before[i][at->half[0]], before[i][at->half[1]]);
    for (int i = 0; i < 3; i++)
        border->m[i] = at->sign * cpsi_halves_get(a->direction, at->element, 3, i);
    if (!plain && a->frame) turn_to_node(border, a, at);
    cpsi_halves_apply(cm, border->c, border->m);
    cpsi_halves_apply_transposed(ctm, border->c, border->m);
    for (int i = 0; i < 3; i++) {
        border->v[i] = border->m[i] - k * cm[i];
        border->vt[i] = border->m[i] - k * ctm[i];
    }
    border->b = cpsi_halves_get(a->compliance, at->element, 1, 0) + cpsi_halves_dot(border->m, cm);
}

/* Subtract the Schur complement of the nodes before. */
CPSI_HALVES_FUNCTION void subtract_border(CpsiHalves x[9], const NodeBorder *border) {
    const CpsiHalves k = border->k;
    for (int i = 0; i < 9; i++) x[i] -= k * k * border->c[i];
}

/* X before any elimination, without second directions: a node's own block and the stiffness of its
 * elements. */
CPSI_HALVES_FUNCTION void node_block(CpsiHalves x[9], const CpsiMatrix *a, const CpsiPlaces *at) {
    CpsiHalves d[6], skew[2], stiffness;
    for (int i = 0; i < 6; i++) d[i] = cpsi_halves_get(a->diagonal, at->node, 6, i);
    for (int i = 0; i < 2; i++) skew[i] = cpsi_halves_get(a->skew, at->node, 2, i);
    CPSI_FOR_HALVES(l) {
        const int j = at->node[l];
        stiffness[l] = (j > 0 ? a->stiffness[j] : 0) + (j + 1 < a->n ? a->stiffness[j + 1] : 0);
    }
    x[0] = d[0] + stiffness;
    x[1] = x[3] = d[1];
    x[4] = d[2] + stiffness;
    x[2] = d[3] + skew[0];
    x[5] = d[4] + skew[1];
    x[6] = d[3];
    x[7] = d[4];
    x[8] = d[5] + stiffness;
}

/* Replace the inverses of X where nodes have a second direction. */
static inline void invert_second(CpsiHalves ix[9], CpsiChainFactor *chain, const CpsiMatrix *a,
                                 const CpsiPlaces *at, const CpsiHalves x[9],
                                 const NodeBorder *border) {
    CPSI_FOR_HALVES(l) {
        const int j = at->node[l];
        if (!cpsi_chain_has_second(a, j)) continue;
        CpsiChainSecond *second = &chain->second[j];
        double own[9], inverted[9];
        for (int i = 0; i < 9; i++) own[i] = x[i][l];
        inverse_with_second(inverted, second, own, &a->second->column[3 * j],
                            &a->second->row[3 * j], a->second->compliance[j]);
        for (int i = 0; i < 9; i++) ix[i][l] = inverted[i];
        second->pull = 0;
        for (int i = 0; i < 3; i++) {
            second->v[i] = border->v[i][l];
            second->pull += border->vt[i][l] * second->column[i];
        }
    }
}

/* The block of a node whose element has a point; both places are the same. */
static bool factor_point(CpsiChainFactor *chain, const CpsiMatrix *a, const CpsiPlaces *at,
                         const CpsiHalves x[9], const NodeBorder *border) {
    const int j = at->node[0];
    double own[9], c[9], m[3];
    for (int i = 0; i < 9; i++) own[i] = x[i][0];
    for (int i = 0; i < 9; i++) c[i] = border->c[i][0];
    for (int i = 0; i < 3; i++) m[i] = border->m[i][0];
    if (!cpsi_chain_point_factor(&chain->point[j], a, j, own, c, m)) return false;
    cpsi_chain_point_compliance(&chain->point[j], c);
    CpsiChainBlock *block = &chain->block[at->passed];
    *block = (CpsiChainBlock){.tt = {0, 0}}; /* c alone is used */
    for (int i = 0; i < 9; i++) block->c[i] = cpsi_halves(c[i], c[i]);
    return true;
}

/* Eliminate two nodes. `joint`: at the middle node, what the last half leaves to it; else NULL. */
CPSI_HALVES_FUNCTION bool factor_nodes(CpsiChainFactor *chain, const CpsiMatrix *a,
                                       const CpsiPlaces *at, const NodeBorder *joint,
                                       const bool plain) {
    CpsiChainBlock *block = &chain->block[at->passed];
    NodeBorder border = NO_BORDER;
    CpsiHalves x[9], ix[9], y[3], yt[3];
    if (at->passed > 0) fill_border(&border, chain, a, at, plain);
    node_block(x, a, at);
    subtract_border(x, &border);
    if (joint) subtract_border(x, joint);
    if (!plain && at->passed > 0 && cpsi_point_is_set(a, at->node[0]))
        return factor_point(chain, a, at, x, &border);
    inverse(ix, x);
    if (!plain && a->second) invert_second(ix, chain, a, at, x, &border);
    CPSI_FOR_HALVES(l)
    if (a->held[at->node[l]])
        for (int i = 0; i < 9; i++) ix[i][l] = 0;
    cpsi_halves_apply(y, ix, border.v);
    cpsi_halves_apply_transposed(yt, ix, border.vt);
    const CpsiHalves ib = block->tt = 1 / (border.b + cpsi_halves_dot(border.vt, y));
    for (int i = 0; i < 3; i++) {
        block->y[i] = y[i] * ib;
        block->yt[i] = yt[i] * ib;
        for (int l = 0; l < 3; l++) block->c[3 * i + l] = ix[3 * i + l] - y[i] * (yt[l] * ib);
    }
    return true;
}

/* A number that is finite where the factors of a block are. */
CPSI_HALVES_FUNCTION CpsiHalves check_of(const CpsiChainBlock *block) {
    return block->tt + block->c[0] + block->c[4] + block->c[8];
}

/* The joint, when the middle node is eliminated: its v, v' and 1/beta. */
static double factor_joint(CpsiChainFactor *chain, const CpsiMatrix *a, const NodeBorder *border) {
    const CpsiHalves *c = chain->block[cpsi_chain_middle(a)].c;
    CpsiHalves cv[3];
    cpsi_halves_apply(cv, c, border->v);
    const CpsiHalves ib = 1 / (border->b + cpsi_halves_dot(border->vt, cv));
    for (int i = 0; i < 3; i++) {
        chain->joint.v[i] = border->v[i][0];
        chain->joint.vt[i] = border->vt[i][0];
    }
    return chain->joint.tt = ib[0];
}

CPSI_HALVES_FUNCTION bool factor(CpsiChainFactor *chain, const CpsiMatrix *a, const bool plain) {
    const int both = cpsi_chain_behind(a), middle = cpsi_chain_middle(a);
    CpsiHalves check = {0, 0};
    NodeBorder joint;
    for (int j = 0; j < both; j++) {
        const CpsiPlaces at = cpsi_chain_next(a, j, true);
        factor_nodes(chain, a, &at, NULL, plain);
        check += check_of(&chain->block[j]);
    }
    if (both > 0) {
        const CpsiPlaces at = cpsi_chain_joint_places(a);
        fill_border(&joint, chain, a, &at, plain);
    }
    for (int j = both; j <= middle; j++) {
        const CpsiPlaces at = cpsi_chain_next(a, j, false);
        if (!factor_nodes(chain, a, &at, j == middle && both > 0 ? &joint : NULL, plain))
            return false;
        check += check_of(&chain->block[j]);
    }
    if (both > 0) check[0] += factor_joint(chain, a, &joint);
    return isfinite(check[0]) && isfinite(check[1]);
}

static bool chain_factor(CpsiLinsys *self, const CpsiMatrix *a) {
    CpsiChainFactor *chain = (CpsiChainFactor *)self;
    return cpsi_chain_is_plain(a) ? factor(chain, a, true) : factor(chain, a, false);
}

static void chain_solve(const CpsiLinsys *self, const CpsiMatrix *a, double *x, double *t,
                        double *second_f) {
    const CpsiUnknowns found = {x, t, second_f};
    if (second_f) memset(second_f, 0, (size_t)a->n * sizeof *second_f);
    if (a->share)
        cpsi_linsys_solve_points(self, a, cpsi_chain_pass, &found,
                                 ((const CpsiChainFactor *)self)->scratch);
    else
        cpsi_chain_pass(self, a, &found);
}

const CpsiLinsysOps cpsi_linsys_chain = {"chain", chain_layout, chain_factor, chain_solve};
