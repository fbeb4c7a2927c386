/* SPDX-License-Identifier: BSD-3-Clause */
/* The dense back end: the same matrix in full, L U with row exchanges.
 *
 * The unknowns are x_0, ..., x_{n-1} (3 each), then t_1, ..., t_{n-1}, then f of second directions,
 * then the forces of points. The cost is 2 (4n)^3/3. It is for small lines, and serves as an
 * independent check of the chain back end. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "chain/chain_system.h"
#include "chain/frame.h"
#include "chain/point.h"
#include "chain/residual.h"

typedef struct Dense {
    double *lu; /* (size, size) row by row, L below its unit diagonal; t_0 is kept as an idle
                   unknown, and f where a node has none */
    int *row;   /* (size) row i of the factors is row[i] of the matrix */
    double *b;  /* (size) scratch of a solve */
    CpsiUnknowns scratch[2]; /* of a solve with points */
} Dense;

static size_t unknowns(const CpsiMatrix *a) {
    return (size_t)(4 + (a->second ? 1 : 0) + (a->share ? 3 : 0)) * (size_t)a->n;
}

/* Where the force of element j's point begins. */
static size_t point_at(const CpsiMatrix *a, size_t j) {
    return (size_t)(a->second ? 5 : 4) * (size_t)a->n + 3 * j;
}

static CpsiLinsys *dense_layout(CpsiArena *arena, int n, bool second, bool points,
                                size_t *scratch) {
    Dense measured, *placed = cpsi_arena_take(arena, 1, sizeof *placed),
                    *dense = placed ? placed : &measured;
    *scratch = arena->used;
    const size_t size = (size_t)(4 + (second ? 1 : 0) + (points ? 3 : 0)) * (size_t)n;
    CPSI_PLACE(arena, dense->lu, size * size);
    CPSI_PLACE(arena, dense->b, size);
    CPSI_PLACE(arena, dense->row, size);
    for (int k = 0; k < 2; k++) dense->scratch[k] = cpsi_unknowns_layout(arena, points ? n : 0);
    return (CpsiLinsys *)placed;
}

/* Entry (r, c) of D_j. */
static double node_entry(const CpsiMatrix *a, int j, int r, int c) {
    static const int place[3][3] = {{0, 1, 3}, {1, 2, 4}, {3, 4, 5}};
    return a->diagonal[6 * j + place[r][c]] + (c == 2 && r < 2 ? a->skew[2 * j + r] : 0);
}

/* r.x_j - a f_j = 0 and c f_j on the node; f_j = 0 where there is none. */
static void fill_second(double *m, const CpsiMatrix *a) {
    const size_t n = (size_t)a->n, size = unknowns(a);
    if (a->second)
        for (size_t j = 0; j < n; j++) {
            const double *r = &a->second->row[3 * j], *c = &a->second->column[3 * j];
            const size_t f = 4 * n + j;
            const bool set = !a->held[j] && (r[0] != 0 || r[1] != 0 || r[2] != 0);
            m[f * size + f] = set ? -a->second->compliance[j] : 1;
            if (set)
                for (size_t i = 0; i < 3; i++) {
                    m[f * size + 3 * j + i] = r[i];
                    m[(3 * j + i) * size + f] = c[i];
                }
        }
}

/* The equations of a point's force, and that force on the nodes by their shares; the identity where
 * there is no point. */
static void fill_points(double *m, const CpsiMatrix *a) {
    const size_t n = (size_t)a->n, size = unknowns(a);
    for (size_t j = 0; a->share && j < n; j++) {
        const size_t at = point_at(a, j);
        const bool set = cpsi_point_is_set(a, (int)j);
        const CpsiPointLaw law =
            set ? cpsi_point_law(a, (int)j) : (CpsiPointLaw){.size = {1, 1, 1}};
        for (size_t i = 0; i < 3; i++) {
            m[(at + i) * size + at + i] -= 1 / law.size[i];
            if (i < 2) m[(at + i) * size + at + 2] += law.c[i] / law.size[i];
        }
        if (set)
            for (size_t node = j - 1; node <= j; node++) {
                const double share = node == j ? a->share[j] : 1 - a->share[j];
                double turn[9];
                if (a->held[node]) continue;
                cpsi_point_turn(a, (int)node, law.axes, turn);
                for (size_t i = 0; i < 3; i++)
                    for (size_t l = 0; l < 3; l++) {
                        m[(3 * node + l) * size + at + i] = share * turn[3 * l + i];
                        m[(at + i) * size + 3 * node + l] =
                            law.e[i] / law.size[i] * share * turn[3 * l + i];
                    }
            }
    }
}

static void dense_fill(Dense *dense, const CpsiMatrix *a) {
    const size_t n = (size_t)a->n, size = unknowns(a);
    double *m = dense->lu;
    memset(m, 0, size * size * sizeof *m);
    fill_second(m, a);
    fill_points(m, a);
    for (int node = 0; node < a->n; node++) {
        const size_t j = (size_t)node, xj = 3 * j, tj = 3 * n + j;
        const double k = j > 0 ? a->stiffness[j] : 0,
                     both = k + (j + 1 < n ? a->stiffness[j + 1] : 0);
        /* the node's own block, or x_j = 0 */
        for (size_t r = 0; r < 3; r++)
            for (size_t c = 0; c < 3; c++)
                m[(xj + r) * size + xj + c] =
                    a->held[j] ? (r == c)
                               : node_entry(a, node, (int)r, (int)c) + (r == c ? both : 0);
        m[tj * size + tj] = j > 0 ? -a->compliance[j] : 1;
        if (j == 0) continue;
        /* the element before it: stiffness between the nodes, and the tension's row and column;
         * held nodes, x_j = 0, are left out */
        double turn[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, here[3], there[3];
        for (size_t i = 0; i < 3; i++) here[i] = there[i] = a->direction[3 * j + i];
        if (a->frame) {
            cpsi_frame_relative(turn, &a->frame[9 * j], &a->frame[9 * (j - 1)]);
            cpsi_frame_to(here, &a->frame[9 * j], &a->direction[3 * j]);
            cpsi_frame_to(there, &a->frame[9 * (j - 1)], &a->direction[3 * j]);
        }
        for (size_t i = 0; i < 3; i++) {
            if (!a->held[j]) m[tj * size + xj + i] = m[(xj + i) * size + tj] = here[i];
            if (!a->held[j - 1])
                m[tj * size + xj - 3 + i] = m[(xj - 3 + i) * size + tj] = -there[i];
            if (!a->held[j] && !a->held[j - 1])
                for (size_t l = 0; l < 3; l++)
                    m[(xj + i) * size + xj - 3 + l] = m[(xj - 3 + l) * size + xj + i] =
                        -k * turn[3 * i + l];
        }
    }
}

/* Bring the largest entry of column k to the diagonal; its size is the pivot's. */
static void exchange_rows(Dense *dense, size_t size, size_t k) {
    size_t best = k;
    for (size_t i = k + 1; i < size; i++)
        if (fabs(dense->lu[i * size + k]) > fabs(dense->lu[best * size + k])) best = i;
    if (best == k) return;
    for (size_t c = 0; c < size; c++) {
        const double swap = dense->lu[k * size + c];
        dense->lu[k * size + c] = dense->lu[best * size + c];
        dense->lu[best * size + c] = swap;
    }
    const int swap = dense->row[k];
    dense->row[k] = dense->row[best];
    dense->row[best] = swap;
}

static bool dense_factor(CpsiLinsys *self, const CpsiMatrix *matrix) {
    Dense *dense = (Dense *)self;
    const size_t size = unknowns(matrix);
    double *lu = dense->lu, largest = 0;
    dense_fill(dense, matrix);
    for (size_t i = 0; i < size; i++) dense->row[i] = (int)i;
    for (size_t i = 0; i < size * size; i++) largest = fmax(largest, fabs(lu[i]));
    for (size_t k = 0; k < size; k++) {
        exchange_rows(dense, size, k);
        /* pivots below the rounding level are replaced by it */
        const double least = DBL_EPSILON * DBL_EPSILON * largest;
        if (fabs(lu[k * size + k]) < least) lu[k * size + k] = least;
        if (!isfinite(lu[k * size + k]) || lu[k * size + k] == 0) return false;
        for (size_t i = k + 1; i < size; i++) {
            const double l = lu[i * size + k] /= lu[k * size + k];
            if (l != 0)
                for (size_t c = k + 1; c < size; c++) lu[i * size + c] -= l * lu[k * size + c];
        }
    }
    return true;
}

/* The entry of the right-hand sides that belongs to an unknown; those of held nodes and of t_0 are
 * zero. */
static double *entry(const CpsiMatrix *a, const CpsiUnknowns *of, size_t i) {
    const size_t n = (size_t)a->n, points = point_at(a, 0);
    if (i < 3 * n) return a->held[i / 3] ? NULL : &of->x[i];
    if (i < 4 * n) return i > 3 * n ? &of->t[i - 3 * n] : NULL;
    if (i < points) return of->f ? &of->f[i - 4 * n] : NULL;
    return &of->x[3 * n + i - points];
}

/* L U y = P b, in place. */
static void pass(const CpsiLinsys *self, const CpsiMatrix *a, const CpsiUnknowns *of) {
    const Dense *dense = (const Dense *)self;
    const size_t size = unknowns(a);
    const double *lu = dense->lu;
    double *b = dense->b;
    for (size_t i = 0; i < size; i++) {
        const double *right = entry(a, of, (size_t)dense->row[i]);
        b[i] = right ? *right : 0;
        for (size_t j = 0; j < i; j++) b[i] -= lu[i * size + j] * b[j];
    }
    for (size_t i = size; i-- > 0;) {
        for (size_t j = i + 1; j < size; j++) b[i] -= lu[i * size + j] * b[j];
        b[i] /= lu[i * size + i];
    }
    memcpy(of->x, b, 3 * (size_t)a->n * sizeof *b);
    memcpy(of->t, b + 3 * (size_t)a->n, (size_t)a->n * sizeof *b);
    for (size_t i = 4 * (size_t)a->n; i < size; i++) {
        double *out = entry(a, of, i);
        if (out) *out = b[i];
    }
}

static void dense_solve(const CpsiLinsys *self, const CpsiMatrix *a, double *x, double *t,
                        double *f) {
    const CpsiUnknowns found = {x, t, f};
    if (f) memset(f, 0, (size_t)a->n * sizeof *f);
    if (a->share)
        cpsi_linsys_solve_points(self, a, pass, &found, ((const Dense *)self)->scratch);
    else
        pass(self, a, &found);
}

const CpsiLinsysOps cpsi_linsys_dense = {"dense", dense_layout, dense_factor, dense_solve};
