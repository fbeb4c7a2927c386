/* SPDX-License-Identifier: BSD-3-Clause */
/* The linear system of a sparse program's directions.
 *
 * As in dense_program.c the scaled duals w = W dz/sqrt(g) stay unknowns, so that no rounding of H is seen. With A~ =
 * sqrt(g) W^-1 A, b~ alike, and -w, -dy for w and dy the system is symmetric but for dtau,
 *
 *     [ 0   E'  A~' ] [ dx]   [f_x]        [ c  ]
 *     [ E   0   0   ] [-dy] = [f_y] - dtau [ h  ]         K (dx, -dy, -w) = f - dtau p
 *     [ A~  0   -I  ] [-w ]   [f_w]        [ b~ ]
 *
 *     - c.dx - h.dy + b~.(-w) + kappa/tau dtau = f_tau
 *
 * With K regularised on both diagonals and factorised with w eliminated, K v = p and K t = f give dtau from the last
 * line, whose coefficient is then kappa/tau + delta |v_xy|^2 + |v_w|^2 by the skewness of the rest. That solves
 * nearly the system; refinement on the whole of it takes delta and most of the rounding out again, also where K
 * alone is singular. */
#include "conic/sparse_program.h"

#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "linalg/dense.h"

/* Pivots below this are rounding. */
static const double LEAST_PIVOT = 1e-13;
/* Refinement ends at this relative residual, when a round leaves more than the share SLOW of it, or after
 * MOST_ROUNDS: slow progress comes from directions in which the matrix is small beside its regularisation, and pays
 * late in the loop. */
static const double REFINED = 1e-15, SLOW = 0.9;
static const int MOST_ROUNDS = 30;

static size_t length(const CpsiSparseProgram *program) {
    return (size_t)(program->data.unknowns + program->data.equations + program->cones.rows) + 1;
}

/* left = f - (K, c, h, b~; ..) at */
static void residual_of(const CpsiSparseProgram *program, const CpsiTriple *f, const CpsiTriple *at,
                        const CpsiTriple *left) {
    const CpsiSparseData *d = &program->data;
    const int n = d->unknowns, m = d->equations, rows = program->cones.rows;
    const double tau = *at->tau;
    for (int j = 0; j < n; j++) left->x[j] = f->x[j] - d->c[j]*tau;
    cpsi_sparse_add_transposed(d, -1, at->y, left->x);
    cpsi_sparse_blocks_add(program, true, -1, at->w, left->x);
    cpsi_sparse_multiply(d, at->x, left->y);
    for (int i = 0; i < m; i++) left->y[i] = f->y[i] - left->y[i] - d->h[i]*tau;
    cpsi_sparse_blocks_multiply(program, true, at->x, left->w);
    for (int i = 0; i < rows; i++) left->w[i] = f->w[i] - left->w[i] + at->w[i] - program->b[i]*tau;
    *left->tau = *f->tau + cpsi_dot(n, d->c, at->x) - cpsi_dot(m, d->h, at->y) - cpsi_dot(rows, program->b, at->w) -
                 program->kappa/program->base.u[n + m]*tau;
}

/* out = K^-1 right for the regularised K (x, y, w parts) */
static void solve_symmetric(const CpsiSparseProgram *program, const CpsiTriple *right, const CpsiTriple *out) {
    const CpsiSparseData *d = &program->data;
    memcpy(out->x, right->x, (size_t)(d->unknowns + d->equations)*sizeof *out->x); /* y lies behind x */
    cpsi_sparse_blocks_add(program, true, 1, right->w, out->x);
    cpsi_ldl_solve(program->ldl, out->x);
    cpsi_sparse_blocks_multiply(program, true, out->x, out->w);
    for (int i = 0; i < program->cones.rows; i++) out->w[i] -= right->w[i];
}

/* fix = the solution of the regularised system for the right-hand side `left` */
static void solve_regularised(const CpsiSparseProgram *program, const CpsiTriple *left, const CpsiTriple *fix) {
    const CpsiSparseData *d = &program->data;
    const int n = d->unknowns, m = d->equations, rows = program->cones.rows;
    const size_t size = length(program) - 1;
    solve_symmetric(program, left, fix);
    *fix->tau = (*left->tau + cpsi_dot(n, d->c, fix->x) - cpsi_dot(m, d->h, fix->y) -
                 cpsi_dot(rows, program->b, fix->w))/program->below;
    for (size_t i = 0; i < size; i++) fix->x[i] -= program->turned.x[i]**fix->tau;
}

static double largest_of(const CpsiSparseProgram *program, const CpsiTriple *a) {
    double largest = 0;
    const size_t size = length(program);
    for (size_t i = 0; i < size; i++) largest = cpsi_max_nan(largest, fabs(a->x[i]));
    return largest;
}

/* The system solved for program->right into program->answer, refined while that helps. */
static void solve_refined(CpsiSparseProgram *program) {
    const size_t size = length(program);
    const CpsiTriple *f = &program->right, *out = &program->answer, *left = &program->left, *fix = &program->fix;
    double before = largest_of(program, f);
    const double goal = REFINED*before;
    memset(out->x, 0, size*sizeof *out->x);
    memcpy(left->x, f->x, size*sizeof *f->x);
    for (int round = 0; round < MOST_ROUNDS; round++) {
        solve_regularised(program, left, fix);
        for (size_t i = 0; i < size; i++) out->x[i] += fix->x[i];
        residual_of(program, f, out, left);
        const double now = largest_of(program, left);
        /* a round that made it worse is taken back, but for the first */
        for (size_t i = 0; round > 0 && now > before && i < size; i++) out->x[i] -= fix->x[i];
        if (!(now > goal) || (round > 0 && !(now < SLOW*before))) break;
        before = now;
    }
}

/* K^-1 p, once refined, and the coefficient of dtau */
static void prepare_tau(CpsiSparseProgram *program) {
    const CpsiSparseData *d = &program->data;
    const int n = d->unknowns, m = d->equations, rows = program->cones.rows;
    const CpsiTriple *v = &program->turned, *left = &program->left, *p = &program->right;
    memcpy(p->x, d->c, (size_t)n*sizeof *d->c);
    memcpy(p->y, d->h, (size_t)m*sizeof *d->h);
    memcpy(p->w, program->b, (size_t)rows*sizeof *program->b);
    *p->tau = *v->tau = 0;
    solve_symmetric(program, p, v);
    residual_of(program, p, v, left);
    for (int j = 0; j < n; j++) left->x[j] -= program->regular[j]*v->x[j];
    for (int i = 0; i < m; i++) left->y[i] += program->regular[n + i]*v->y[i];
    solve_symmetric(program, left, &program->fix);
    for (size_t i = 0; i < length(program) - 1; i++) v->x[i] += program->fix.x[i];
    program->below = program->kappa/program->base.u[n + m] + cpsi_dot(rows, v->w, v->w);
    for (int i = 0; i < n + m; i++) program->below += program->regular[i]*v->x[i]*v->x[i]; /* y lies behind x */
}

/* The condensed matrix [ A~'A~ + delta, E'; E, -delta ]: the blocks' triangles; E does not change. */
bool cpsi_sparse_factor(CpsiProgram *base) {
    CpsiSparseProgram *program = (CpsiSparseProgram *)base;
    const CpsiSparseData *d = &program->data;
    int first = 0;
    for (int k = 0; k < d->blocks; first += d->block[k++].unknowns) {
        const CpsiBlock *block = &d->block[k];
        const int n = block->unknowns;
        const double *a = &program->a[program->at[k]];
        double *to = &program->value[program->place[k]];
        for (int j = 0; j < n; j++)
            for (int i = 0; i <= j; i++, to++) {
                double sum = i == j ? program->regular[first + j] : 0;
                for (int r = 0; r < block->rows; r++)
                    sum += a[(size_t)r*(size_t)n + (size_t)i]*a[(size_t)r*(size_t)n + (size_t)j];
                *to = sum;
            }
    }
    if (!cpsi_ldl_factor(program->ldl, program->value, program->sign, LEAST_PIVOT)) return false;

    prepare_tau(program); /* serves both directions */
    return true;
}

void cpsi_sparse_solve(CpsiProgram *base) {
    CpsiSparseProgram *program = (CpsiSparseProgram *)base;
    const int n = program->data.unknowns, m = program->data.equations, rows = program->cones.rows;
    const CpsiTriple *right = &program->right, *answer = &program->answer;
    double *du = base->du;
    memcpy(right->x, du, (size_t)(n + m)*sizeof *du);
    memcpy(right->w, du + n + m + 1, (size_t)rows*sizeof *du);
    *right->tau = du[n + m];
    solve_refined(program);
    for (int j = 0; j < n; j++) du[j] = answer->x[j];
    for (int i = 0; i < m; i++) du[n + i] = -answer->y[i];
    for (int i = 0; i < rows; i++) du[n + m + 1 + i] = -answer->w[i];
    du[n + m] = *answer->tau;
}
