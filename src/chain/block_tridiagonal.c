/* SPDX-License-Identifier: BSD-3-Clause */
/* The chain back end: block tridiagonal elimination, one node at a time, each node before the
 * tension of the element before it.
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
 * Where there is a second direction, Y = (X + c r^T/a)^-1 and f = r.x/a come from the inverse of [X
 * c; r^T -a].
 *
 * Where the element before node j has a point, its three force components are unknowns beside t_j
 * (chain_point.h).
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

#include "chain/chain_point.h"
#include "chain/chain_system.h"
#include "chain/frame.h"
#include "chain/point.h"
#include "chain/residual.h"

/* The factor of one node: two cache lines that every pass reads together. */
typedef struct ChainBlock {
    double c[9];  /* C_j, row by row */
    double y[3];  /* y/beta */
    double yt[3]; /* y'/beta */
    double tt;    /* 1/beta */
} ChainBlock;

/* Of a second direction: f = w.(force on the node - v t) + corner g, and x gains column g, where
 * r.x - a f = g. */
typedef struct ChainSecond {
    double w[3], v[3], column[3], corner;
    double pull; /* v'.column */
} ChainSecond;

typedef struct Chain {
    ChainBlock *block;       /* (n) */
    ChainSecond *second;     /* (n) or NULL */
    CpsiChainPoint *point;   /* (n) or NULL */
    CpsiUnknowns scratch[2]; /* of a solve with points */
} Chain;

static CpsiLinsys *chain_layout(CpsiArena *arena, int n, bool second, bool points,
                                size_t *scratch) {
    Chain measured, *placed = cpsi_arena_take(arena, 1, sizeof *placed),
                    *chain = placed ? placed : &measured;
    *scratch = arena->used;
    CPSI_PLACE(arena, chain->block, n);
    if (second) CPSI_PLACE(arena, chain->second, n);
    if (points) CPSI_PLACE(arena, chain->point, n);
    for (int k = 0; k < 2; k++) chain->scratch[k] = cpsi_unknowns_layout(arena, points ? n : 0);
    return (CpsiLinsys *)placed;
}

static inline double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* out = A x and out = A^T x for A (3, 3). */
static inline void apply(double out[3], const double a[9], const double x[3]) {
    for (int i = 0; i < 3; i++) out[i] = dot(&a[3 * i], x);
}

static inline void apply_transposed(double out[3], const double a[9], const double x[3]) {
    for (int i = 0; i < 3; i++) out[i] = a[i] * x[0] + a[3 + i] * x[1] + a[6 + i] * x[2];
}

/* out = A^-1: z is eliminated first, as it is along the obstacle's normal, the stiffest direction
 * where there is contact; then the remaining 2 x 2 block of x and y is inverted by its determinant.
 * Pivots below the rounding level are replaced by it. */
static inline void inverse(double out[9], const double a[9]) {
    const double tiny = 4 * DBL_EPSILON, least = DBL_MIN / DBL_EPSILON;
    const double iz = 1 / (a[8] > least ? a[8] : least), lx = a[2] * iz, ly = a[5] * iz;
    const double xx = a[0] - lx * a[6], xy = a[1] - lx * a[7], yx = a[3] - ly * a[6],
                 yy = a[4] - ly * a[7];
    const double product = xx * yy, det = product - xy * yx, floor = tiny * fabs(product) + least;
    const double inverse_det = 1 / (fabs(det) > floor ? det : floor);
    out[0] = yy * inverse_det;
    out[1] = -xy * inverse_det;
    out[3] = -yx * inverse_det;
    out[4] = xx * inverse_det;
    /* back to z */
    out[2] = -out[0] * lx - out[1] * ly;
    out[5] = -out[3] * lx - out[4] * ly;
    out[6] = -iz * (a[6] * out[0] + a[7] * out[3]);
    out[7] = -iz * (a[6] * out[1] + a[7] * out[4]);
    out[8] = iz - iz * (a[6] * out[2] + a[7] * out[5]);
}

/* The inverse of [X c; r^T -a]: its first three rows and columns, w of its last row, r.x/a = w.f of
 * the x that f gives, and its last column. With row exchanges: the entries of X may be nearly zero
 * (a slack line), huge (an obstacle) or both. */
static void inverse_with_second(double out[9], ChainSecond *second, const double x[9],
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

static inline bool is_set(const CpsiMatrixSecond *second, int j) {
    return cpsi_second_is_set(second, j);
}

/* X of node j without its second direction: its own block and the stiffness of its elements, less
 * the Schur complement of the chain before it. */
static inline void node_block(double x[9], const CpsiMatrix *a, int j, double k,
                              const double c[9]) {
    const double *d = &a->diagonal[6 * j], *skew = &a->skew[2 * j],
                 next = j + 1 < a->n ? a->stiffness[j + 1] : 0;
    const double own[9] = {d[0],           d[1], d[3] + skew[0], d[1], d[2],
                           d[4] + skew[1], d[3], d[4],           d[5]};
    for (int i = 0; i < 9; i++) x[i] = own[i] - k * k * c[i];
    x[0] += k + next;
    x[4] += k + next;
    x[8] += k + next;
}

/* Rotate C of the node before, and m_j, to the axes of node j. */
static inline void turn_to_node(const CpsiMatrix *a, int j, double c[9], double m[3]) {
    double relative[9], other_c[9], other_m[3];
    for (int i = 0; i < 9; i++) other_c[i] = c[i];
    for (int i = 0; i < 3; i++) other_m[i] = m[i];
    cpsi_frame_relative(relative, &a->frame[9 * j], &a->frame[9 * (j - 1)]);
    cpsi_frame_turn(c, relative, other_c);
    cpsi_frame_to(m, &a->frame[9 * j], other_m);
}

static bool chain_factor(CpsiLinsys *self, const CpsiMatrix *a) {
    static const ChainBlock nothing = {{0}, {0}, {0}, 0};
    ChainBlock *block = ((Chain *)self)->block;
    const double *before = nothing.c;
    double check = 0;
    for (int j = 0; j < a->n; before = block[j].c, j++) {
        const double k = j > 0 ? a->stiffness[j] : 0;
        const double *c = before, *m = &a->direction[3 * j];
        double turned_c[9], turned_m[3];
        if (a->frame && j > 0) {
            memcpy(turned_c, c, sizeof turned_c);
            memcpy(turned_m, m, sizeof turned_m);
            turn_to_node(a, j, turned_c, turned_m);
            c = turned_c;
            m = turned_m;
        }
        if (j > 0 && cpsi_point_is_set(a, j)) {
            double x[9];
            node_block(x, a, j, k, c);
            CpsiChainPoint *point = &((Chain *)self)->point[j];
            if (!cpsi_chain_point_factor(point, a, j, x, c, m)) return false;
            block[j] = nothing;
            cpsi_chain_point_compliance(point, block[j].c);
            check += block[j].c[0] + block[j].c[4] + block[j].c[8];
            continue;
        }
        double v[3] = {0, 0, 0}, vt[3] = {0, 0, 0}, beta = 1;
        if (j > 0) {
            double cm[3], ctm[3];
            apply(cm, c, m);
            apply_transposed(ctm, c, m);
            for (int i = 0; i < 3; i++) {
                v[i] = m[i] - k * cm[i];
                vt[i] = m[i] - k * ctm[i];
            }
            beta = a->compliance[j] + dot(m, cm);
        }
        if (a->held[j]) {
            block[j] = nothing;
            block[j].tt = 1 / beta;
        } else {
            double x[9], y[3], yt[3], ix[9];
            node_block(x, a, j, k, c);
            if (is_set(a->second, j)) {
                ChainSecond *second = &((Chain *)self)->second[j];
                memcpy(second->v, v, sizeof v);
                inverse_with_second(ix, second, x, &a->second->column[3 * j],
                                    &a->second->row[3 * j], a->second->compliance[j]);
                second->pull = dot(vt, second->column);
            } else {
                inverse(ix, x);
            }
            apply(y, ix, v);
            apply_transposed(yt, ix, vt);
            const double ib = 1 / (beta + dot(vt, y));
            block[j].tt = ib;
            for (int i = 0; i < 3; i++) {
                block[j].y[i] = y[i] * ib;
                block[j].yt[i] = yt[i] * ib;
                for (int l = 0; l < 3; l++)
                    block[j].c[3 * i + l] = ix[3 * i + l] - y[i] * (yt[l] * ib);
            }
        }
        check += block[j].tt + block[j].c[0] + block[j].c[4] + block[j].c[8];
    }
    return isfinite(check);
}

/* A vector of node `from` in the axes of node `to`. */
static inline void change_axes(const CpsiMatrix *a, int to, int from, double v[3]) {
    if (!a->frame) return;
    double common[3];
    cpsi_frame_from(common, &a->frame[9 * from], v);
    cpsi_frame_to(v, &a->frame[9 * to], common);
}

/* m_i in the axes of node j. */
static inline void direction_at(const CpsiMatrix *a, int i, int j, double m[3]) {
    if (a->frame)
        cpsi_frame_to(m, &a->frame[9 * j], &a->direction[3 * i]);
    else
        memcpy(m, &a->direction[3 * i], 3 * sizeof *m);
}

/* The change of f of a node's second direction for a change of the force on the node and of the
 * tension before it. */
static inline double second_force(const ChainSecond *second, const double force[3],
                                  double tension) {
    return dot(second->w, force) - dot(second->w, second->v) * tension;
}

/* Forward elimination and back substitution. */
static void pass(const CpsiLinsys *self, const CpsiMatrix *a, const CpsiUnknowns *of) {
    const ChainBlock *block = ((const Chain *)self)->block;
    const ChainSecond *second = ((const Chain *)self)->second;
    const CpsiChainPoint *point = ((const Chain *)self)->point;
    const int n = a->n;
    double *x = of->x, *t = of->t, *second_f = of->f;
    /* forward: x_j, t_j of the chain that ends with node j */
    double before[3] = {0, 0, 0};
    for (int j = 0; j < n; j++) {
        double m[3], k = 0, h = 0;
        if (j > 0) {
            change_axes(a, j, j - 1, before);
            direction_at(a, j, j, m);
            k = a->stiffness[j];
            h = t[j] + dot(m, before);
        }
        double *xj = &x[3 * j], f[3];
        for (int i = 0; i < 3; i++) f[i] = a->held[j] ? 0 : xj[i] + k * before[i];
        if (j > 0 && cpsi_point_is_set(a, j)) {
            double f_here = second_f ? second_f[j] : 0;
            cpsi_chain_point_solve(&point[j], a, j, f, h, before, xj, &t[j], &x[3 * (n + j)],
                                   &f_here);
            memcpy(before, xj, sizeof before);
            if (second_f) second_f[j] = f_here;
            continue;
        }
        apply(xj, block[j].c, f);
        for (int i = 0; i < 3; i++) before[i] = xj[i] += block[j].y[i] * h;
        t[j] = j > 0 ? dot(block[j].yt, f) - block[j].tt * h : 0;
        if (!second_f) continue;
        const double g = second_f[j];
        const bool has = is_set(a->second, j) && !a->held[j];
        if (has && g != 0) {
            const ChainSecond *own = &second[j];
            t[j] += own->pull * block[j].tt * g;
            for (int i = 0; i < 3; i++)
                before[i] = xj[i] += (own->column[i] - block[j].y[i] * own->pull) * g;
        }
        second_f[j] = has ? second_force(&second[j], f, t[j]) + second[j].corner * g : 0;
    }
    /* backward: the rest of the chain acts on node j with the force k_{j+1} x_{j+1} + m_{j+1}
     * t_{j+1} */
    for (int j = n - 2; j >= 0; j--) {
        const double k = a->stiffness[j + 1], tension = t[j + 1];
        double *xj = &x[3 * j], m[3], pull[3], dx[3];
        memcpy(pull, &x[3 * (j + 1)], sizeof pull);
        change_axes(a, j, j + 1, pull);
        direction_at(a, j + 1, j, m);
        for (int i = 0; i < 3; i++) pull[i] = k * pull[i] + m[i] * tension;
        if (cpsi_point_is_set(a, j + 1)) cpsi_chain_point_pull(a, j, &x[3 * (n + j + 1)], pull);
        if (j > 0 && cpsi_point_is_set(a, j)) {
            double more[CPSI_CHAIN_POINT];
            cpsi_chain_point_add(&point[j], pull, more);
            for (int i = 0; i < 3; i++) {
                xj[i] += more[i];
                x[3 * (n + j) + i] += more[4 + i];
            }
            t[j] += more[3];
            if (second_f) second_f[j] += more[7];
            continue;
        }
        apply(dx, block[j].c, pull);
        for (int i = 0; i < 3; i++) xj[i] += dx[i];
        const double more = j > 0 ? dot(block[j].yt, pull) : 0;
        t[j] += more;
        if (second_f && is_set(a->second, j) && !a->held[j])
            second_f[j] += second_force(&second[j], pull, more);
    }
}

static void chain_solve(const CpsiLinsys *self, const CpsiMatrix *a, double *x, double *t,
                        double *second_f) {
    const CpsiUnknowns found = {x, t, second_f};
    if (second_f) memset(second_f, 0, (size_t)a->n * sizeof *second_f);
    if (a->share)
        cpsi_linsys_solve_points(self, a, pass, &found, ((const Chain *)self)->scratch);
    else
        pass(self, a, &found);
}

const CpsiLinsysOps cpsi_linsys_chain = {"chain", chain_layout, chain_factor, chain_solve};
