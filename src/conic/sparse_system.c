/* SPDX-License-Identifier: BSD-3-Clause */
/* The operator of a sparse program: its maps, and the linear system of its directions.
 *
 * The scaled duals w = W dz/sqrt(g) remain unknowns (homogeneous.c). With A~ = sqrt(g) W^-1 A, b~
 * alike, and with -w, -dy instead of w and dy, the system is symmetric except for dtau,
 *
 *     [ 0   E'  A~' ] [ dx]   [f_x]        [ c  ]
 *     [ E   0   0   ] [-dy] = [f_y] - dtau [ h  ]         K (dx, -dy, -w) = f - dtau p
 *     [ A~  0   -I  ] [-w ]   [f_w]        [ b~ ]
 *
 *     - c.dx - h.dy + b~.(-w) + kappa/tau dtau = f_tau
 *
 * With K regularised on both diagonals and factorised after eliminating w, K v = p and K t = f give
 * dtau from the last line, whose coefficient is then kappa/tau + delta |v_xy|^2 + |v_w|^2 by the
 * skewness of the rest. This solves the system approximately; iterative refinement of the whole
 * system removes delta and most of the rounding, also where K alone is singular. */
#include "conic/sparse_program.h"

#include <math.h>
#include <string.h>

#include "base/lanes.h"
#include "linalg/dense.h"

/* Smaller pivots are rounding. */
static const double LEAST_PIVOT = 1e-13;
/* Refinement ends at this relative residual, when a round leaves more than the share SLOW of it, or
 * after MOST_ROUNDS. A direction that is less exact removes its share of residuals and gap as well;
 * the last digits are those of the polished answer. Slow progress comes from directions in which
 * the matrix is small beside its regularisation. */
static const double REFINED = 1e-11, SLOW = 0.5;
static const int MOST_ROUNDS = 30;

/* ---- maps ---- */

static const CpsiSparseProgram *sparse(const CpsiHomogeneous *core) {
    return (const CpsiSparseProgram *)core;
}

static void multiply(const CpsiHomogeneous *core, const double *u, double factor, const double *v,
                     double *out) {
    const double tau = u[cpsi_homogeneous_tau(core)];
    cpsi_sparse_blocks_multiply(sparse(core), false, u, out);
    for (int i = 0; i < core->cones.rows; i++) out[i] += core->b[i] * tau + factor * v[i];
}

static void multiply_transposed(CpsiHomogeneous *core, double gain, double pull) {
    const CpsiSparseData *d = &sparse(core)->data;
    double *residual = core->base.residual;
    cpsi_sparse_blocks_add(sparse(core), false, 1, core->cones.z, residual);
    cpsi_sparse_add_transposed(d, 1, core->base.u + d->unknowns, residual);
    cpsi_sparse_multiply(d, core->base.u, residual + d->unknowns);
    residual[cpsi_homogeneous_tau(core)] = pull + gain + core->kappa;
}

static double offset(const CpsiHomogeneous *core, const double *y, const double *z) {
    const CpsiSparseData *d = &sparse(core)->data;
    double sum = 0;
    for (int k = 0; k < d->blocks; z += d->block[k++].rows)
        sum += cpsi_dot(d->block[k].rows, d->block[k].b, z);
    return sum + cpsi_dot(d->equations, d->h, y);
}

/* A~ and b~ of one block, whose first cone and row are `cone` and `row` */
static void scale_block(CpsiSparseProgram *program, int k, int cone, int row) {
    const CpsiBlock *block = &program->data.block[k];
    const CpsiCones *cones = &program->core.cones;
    const int n = block->unknowns;
    double *out = &program->scaled_a[program->at[k]];
    CPSI_FOR_CONES(c, i, block->cones, block->dim) {
        const int d = block->dim[c];
        const double *w = &cones->w[row + i], root = sqrt(cones->g[cone + c]);
        /* W^-1: the first row is (Jw).A, the others A_r + w_r (-A_0 + w1.A1/(1 + w0)) */
        for (int j = 0; j <= n; j++) {
            const double *a = j < n ? &block->a[(size_t)i * (size_t)n + (size_t)j] : &block->b[i];
            double *to = j < n ? &out[(size_t)i * (size_t)n + (size_t)j]
                               : &program->scaled_b[row + i],
                   along = 0;
            const size_t step = j < n ? (size_t)n : 1;
            if (d == 1) {
                to[0] = root * a[0];
                continue;
            }
            for (int r = 1; r < d; r++) along += w[r] * a[(size_t)r * step];
            to[0] = root * (w[0] * a[0] - along);
            const double rest = along / (1 + w[0]) - a[0];
            for (int r = 1; r < d; r++)
                to[(size_t)r * step] = root * (a[(size_t)r * step] + w[r] * rest);
        }
    }
}

static void scale(CpsiHomogeneous *core) {
    CpsiSparseProgram *program = (CpsiSparseProgram *)core;
    for (int k = 0, cone = 0, row = 0; k < program->data.blocks; k++) {
        scale_block(program, k, cone, row);
        cone += program->data.block[k].cones;
        row += program->data.block[k].rows;
    }
}

/* ---- the linear system ---- */

static size_t length(const CpsiSparseProgram *program) {
    return (size_t)(program->data.unknowns + program->data.equations + program->core.cones.rows) +
           1;
}

/* left = f - the system's matrix times `at` */
static void residual_of(const CpsiSparseProgram *program, const CpsiTriple *f, const CpsiTriple *at,
                        const CpsiTriple *left) {
    const CpsiSparseData *d = &program->data;
    const int n = d->unknowns, m = d->equations, rows = program->core.cones.rows;
    const double tau = *at->tau;
    for (int j = 0; j < n; j++) left->x[j] = f->x[j] - d->c[j] * tau;
    cpsi_sparse_add_transposed(d, -1, at->y, left->x);
    cpsi_sparse_blocks_add(program, true, -1, at->w, left->x);
    cpsi_sparse_multiply(d, at->x, left->y);
    for (int i = 0; i < m; i++) left->y[i] = f->y[i] - left->y[i] - d->h[i] * tau;
    cpsi_sparse_blocks_multiply(program, true, at->x, left->w);
    for (int i = 0; i < rows; i++)
        left->w[i] = f->w[i] - left->w[i] + at->w[i] - program->scaled_b[i] * tau;
    *left->tau = *f->tau + cpsi_dot(n, d->c, at->x) - cpsi_dot(m, d->h, at->y) -
                 cpsi_dot(rows, program->scaled_b, at->w) -
                 program->core.kappa / program->core.base.u[n + m] * tau;
}

/* out = K^-1 right for the regularised K (x, y, w parts) */
static void solve_symmetric(const CpsiSparseProgram *program, const CpsiTriple *right,
                            const CpsiTriple *out) {
    const CpsiSparseData *d = &program->data;
    memcpy(out->x, right->x,
           (size_t)(d->unknowns + d->equations) * sizeof *out->x); /* y is stored after x */
    cpsi_sparse_blocks_add(program, true, 1, right->w, out->x);
    cpsi_ldl_solve(program->ldl, out->x);
    cpsi_sparse_blocks_multiply(program, true, out->x, out->w);
    for (int i = 0; i < program->core.cones.rows; i++) out->w[i] -= right->w[i];
}

/* fix = the solution of the regularised system for the right-hand side `left` */
static void solve_regularised(const CpsiSparseProgram *program, const CpsiTriple *left,
                              const CpsiTriple *fix) {
    const CpsiSparseData *d = &program->data;
    const int n = d->unknowns, m = d->equations, rows = program->core.cones.rows;
    const size_t size = length(program) - 1;
    solve_symmetric(program, left, fix);
    *fix->tau = (*left->tau + cpsi_dot(n, d->c, fix->x) - cpsi_dot(m, d->h, fix->y) -
                 cpsi_dot(rows, program->scaled_b, fix->w)) /
                program->below;
    for (size_t i = 0; i < size; i++) fix->x[i] -= program->turned.x[i] * *fix->tau;
}

static double largest_of(const CpsiSparseProgram *program, const CpsiTriple *a) {
    return cpsi_lanes_size(length(program), a->x);
}

/* Solve the system for program->right into program->answer, refined as long as that helps. */
static void solve_refined(CpsiSparseProgram *program) {
    const size_t size = length(program);
    const CpsiTriple *f = &program->right, *out = &program->answer, *left = &program->left,
                     *fix = &program->fix;
    double before = largest_of(program, f);
    const double goal = REFINED * before;
    memset(out->x, 0, size * sizeof *out->x);
    memcpy(left->x, f->x, size * sizeof *f->x);
    for (int round = 0; round < MOST_ROUNDS; round++) {
        solve_regularised(program, left, fix);
        for (size_t i = 0; i < size; i++) out->x[i] += fix->x[i];
        residual_of(program, f, out, left);
        const double now = largest_of(program, left);
        /* undo a round that increased the residual, except the first */
        if (round > 0 && now > before)
            for (size_t i = 0; i < size; i++) out->x[i] -= fix->x[i];
        if (!(now > goal) || (round > 0 && !(now < SLOW * before))) break;
        before = now;
    }
}

/* K^-1 p, refined once, and the coefficient of dtau */
static void prepare_tau(CpsiSparseProgram *program) {
    const CpsiSparseData *d = &program->data;
    const int n = d->unknowns, m = d->equations, rows = program->core.cones.rows;
    const CpsiTriple *v = &program->turned, *left = &program->left, *p = &program->right;
    memcpy(p->x, d->c, (size_t)n * sizeof *d->c);
    memcpy(p->y, d->h, (size_t)m * sizeof *d->h);
    memcpy(p->w, program->scaled_b, (size_t)rows * sizeof *program->scaled_b);
    *p->tau = *v->tau = 0;
    solve_symmetric(program, p, v);
    residual_of(program, p, v, left);
    for (int j = 0; j < n; j++) left->x[j] -= program->regular[j] * v->x[j];
    for (int i = 0; i < m; i++) left->y[i] += program->regular[n + i] * v->y[i];
    solve_symmetric(program, left, &program->fix);
    for (size_t i = 0; i < length(program) - 1; i++) v->x[i] += program->fix.x[i];
    program->below = program->core.kappa / program->core.base.u[n + m] + cpsi_dot(rows, v->w, v->w);
    for (int i = 0; i < n + m; i++)
        program->below += program->regular[i] * v->x[i] * v->x[i]; /* y is stored after x */
}

/* The condensed matrix [ A~'A~ + delta, E'; E, -delta ]: writes the blocks' triangles, since E does
 * not change. */
static bool factor(CpsiProgram *base) {
    CpsiSparseProgram *program = (CpsiSparseProgram *)base;
    const CpsiSparseData *d = &program->data;
    int first = 0;
    for (int k = 0; k < d->blocks; first += d->block[k++].unknowns) {
        const CpsiBlock *block = &d->block[k];
        const int n = block->unknowns;
        const double *a = &program->scaled_a[program->at[k]];
        double *to = &program->value[program->place[k]];
        for (int j = 0; j < n; j++)
            for (int i = 0; i <= j; i++, to++) {
                double sum = i == j ? program->regular[first + j] : 0;
                for (int r = 0; r < block->rows; r++)
                    sum +=
                        a[(size_t)r * (size_t)n + (size_t)i] * a[(size_t)r * (size_t)n + (size_t)j];
                *to = sum;
            }
    }
    if (!cpsi_ldl_factor(program->ldl, program->value, program->sign, LEAST_PIVOT)) return false;

    prepare_tau(program); /* used by both directions */
    return true;
}

static void solve(CpsiProgram *base) {
    CpsiSparseProgram *program = (CpsiSparseProgram *)base;
    const int n = program->data.unknowns, m = program->data.equations,
              rows = program->core.cones.rows;
    const CpsiTriple *right = &program->right, *answer = &program->answer;
    double *du = base->du;
    memcpy(right->x, du, (size_t)(n + m) * sizeof *du);
    memcpy(right->w, du + n + m + 1, (size_t)rows * sizeof *du);
    *right->tau = du[n + m];
    solve_refined(program);
    for (int j = 0; j < n; j++) du[j] = answer->x[j];
    for (int i = 0; i < m; i++) du[n + i] = -answer->y[i];
    for (int i = 0; i < rows; i++) du[n + m + 1 + i] = -answer->w[i];
    du[n + m] = *answer->tau;
}

const CpsiConicOperator cpsi_sparse_operator = {multiply, multiply_transposed,
                                                offset,   scale,
                                                factor,   solve,
                                                false};
