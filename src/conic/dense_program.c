/* SPDX-License-Identifier: BSD-3-Clause */
/* Two kinds of elements make the homogeneous self-dual form (dense_program.h): the cones, each on its rows of G u, and
 * tau, a half-line with dual kappa that also brings the skew term. Their directions:
 *
 *     cones:  ds = G du + keep rho,   dz = q - H ds,   H = g W^-2      (soc.h; a half-line has W = 1, g = z/s)
 *     tau:    dkappa = q - (kappa/tau) dtau
 *     u:      (G'H G + kappa/tau e e' - S) du = keep residual + G'(q - H keep rho) + e q
 *
 * Near a solution G'H G holds numbers from 1/mu to mu, of which its rounding keeps the large ones only. So the scaled
 * dual directions y = W dz/sqrt(g) stay unknowns beside du, with B = sqrt(g) W^-1 G:
 *
 *     [ kappa/tau e e' - S   -B' ] [du]   [ keep residual + e q           ]
 *     [ B                     I  ] [y ] = [ W q/sqrt(g) - keep sqrt(g) W^-1 rho ]
 *
 * and the matrix is factorised with pivoting. The unit in the column of y_i is as good a pivot as any while no entry
 * of row i of B is larger: such rows are eliminated by hand, B_i'B_i joins the first block, and what is left to
 * factorise is about the cones that bind. */
#include "conic/dense_program.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "ipm/cone.h"
#include "linalg/dense.h"

/* Merit at which an iterate is good enough to stop; below it rounding rules. */
static const double TARGET = 1e-14;
static const int MAX_ITERATIONS = 60;

static inline CpsiConicProgram *conic(CpsiProgram *program) { return (CpsiConicProgram *)program; }

/* <row i of G, u> */
static inline double row_times(const CpsiConicProgram *program, int i, const double *u) {
    const int n = program->unknowns;
    return cpsi_dot(n, &program->a[(size_t)i*(size_t)n], u) + program->b[i]*u[n];
}

/* f += factor (row i of G) */
static inline void add_row(const CpsiConicProgram *program, int i, double factor, double *f) {
    const int n = program->unknowns;
    const double *a = &program->a[(size_t)i*(size_t)n];
    for (int j = 0; j < n; j++) f[j] += factor*a[j];
    f[n] += factor*program->b[i];
}

/* ---- cones ---- */

static void cones_start(CpsiProgram *base, double mu, double margin) {
    (void)margin;
    CpsiConicProgram *program = conic(base);
    memset(program->s, 0, (size_t)program->rows*sizeof *program->s);
    memset(program->z, 0, (size_t)program->rows*sizeof *program->z);
    for (int k = 0, i = 0; k < program->cones; i += program->dim[k++]) program->s[i] = 1, program->z[i] = mu;
}

static void cones_measure(CpsiProgram *base, CpsiSums *sums) {
    CpsiConicProgram *program = conic(base);
    sums->weight += program->cones;
    for (int i = 0; i < program->rows; i++) {
        program->rho[i] = row_times(program, i, base->u) - program->s[i];
        sums->residual = cpsi_max_nan(sums->residual, fabs(program->rho[i]));
        sums->sz += program->s[i]*program->z[i];
        add_row(program, i, program->z[i], base->residual);
    }
}

/* Scaling of one cone, and its rows of B written into the matrix. */
static void scale_cone(CpsiConicProgram *program, int k, int i) {
    const int d = program->dim[k], n = program->unknowns;
    const size_t width = (size_t)n + 1;
    double *w = &program->w[i], *first = &program->matrix[(size_t)(n + 1 + i)*width];
    program->g[k] = cpsi_cone_scale(w, &program->s[i], &program->z[i], d);
    const double root = sqrt(program->g[k]);
    /* W^-1: the first row is (Jw).G, the others G_r + w_r (-G_0 + w1.G1/(1 + w0)) */
    for (int r = 1; r < d; r++) add_row(program, i + r, w[r], first);
    for (int r = 1; r < d; r++) {
        double *row = first + (size_t)r*width;
        for (int j = 0; j <= n; j++) row[j] = root*w[r]/(1 + w[0])*first[j];
        add_row(program, i, -root*w[r], row);
        add_row(program, i + r, root, row);
    }
    for (int j = 0; j <= n; j++) first[j] *= -root;
    add_row(program, i, root*w[0], first);
}

static void cones_scale(CpsiProgram *base) {
    CpsiConicProgram *program = conic(base);
    for (int k = 0, i = 0; k < program->cones; i += program->dim[k++]) scale_cone(program, k, i);
    for (int i = 0; i < program->rows; i++) program->q[i] = -program->z[i];
}

static void cones_load(CpsiProgram *base, double keep) {
    CpsiConicProgram *program = conic(base);
    for (int k = 0, i = 0; k < program->cones; i += program->dim[k++]) {
        double *y = &base->du[program->unknowns + 1 + i], *shift = program->scratch;
        const double root = sqrt(program->g[k]);
        cpsi_cone_apply(y, &program->w[i], &program->q[i], 1, 1/root, program->dim[k]);
        cpsi_cone_apply(shift, &program->w[i], &program->rho[i], -1, keep*root, program->dim[k]);
        for (int r = 0; r < program->dim[k]; r++) y[r] -= shift[r];
    }
}

static void cones_direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    (void)predictor; /* the corrector forms the second-order term itself */
    CpsiConicProgram *program = conic(base);
    for (int k = 0, i = 0; k < program->cones; i += program->dim[k++]) {
        const int end = i + program->dim[k];
        cpsi_cone_apply(&program->dz[i], &program->w[i], &base->du[program->unknowns + 1 + i], -1, sqrt(program->g[k]),
                        program->dim[k]);
        for (int r = i; r < end; r++) {
            program->ds[r] = row_times(program, r, base->du) + keep*program->rho[r];
        }
        const double step = cpsi_cone_step(program->dim[k], &program->w[i], program->g[k], &program->s[i], &program->z[i],
                                           &program->ds[i], &program->dz[i], program->scratch);
        sums->inverse_step = cpsi_max_nan(sums->inverse_step, step);
    }
}

static void cones_correct(CpsiProgram *base, double target) {
    CpsiConicProgram *program = conic(base);
    for (int k = 0, i = 0; k < program->cones; i += program->dim[k++])
        cpsi_cone_correct(&program->q[i], program->dim[k], &program->w[i], program->g[k], &program->s[i], &program->z[i],
                          &program->ds[i], &program->dz[i], target, program->scratch);
}

static void cones_advance(CpsiProgram *base, double alpha) {
    CpsiConicProgram *program = conic(base);
    for (int i = 0; i < program->rows; i++) {
        program->s[i] += alpha*program->ds[i];
        program->z[i] += alpha*program->dz[i];
    }
}

/* ---- tau, kappa and the skew term ---- */

static void tau_start(CpsiProgram *base, double mu, double margin) {
    (void)margin;
    memset(base->u, 0, (size_t)base->size*sizeof *base->u);
    base->u[conic(base)->unknowns] = 1;
    conic(base)->kappa = mu;
    conic(base)->found = (CpsiConicResult){.outcome = CPSI_CONIC_FAILED, .gap = INFINITY, .residual = INFINITY};
}

/* Keep the iterate if it is the best so far. */
static void keep_best(CpsiConicProgram *program, CpsiConicOutcome outcome, double gap, double residual) {
    CpsiConicResult *found = &program->found;
    found->iterations++;
    if (!(gap + residual < found->gap + found->residual)) return;
    found->outcome = outcome, found->gap = gap, found->residual = residual;
    const size_t n = (size_t)program->unknowns + 1, m = (size_t)program->rows;
    memcpy(program->best, program->base.u, n*sizeof *program->best);
    memcpy(program->best + n, program->s, m*sizeof *program->best);
    memcpy(program->best + n + m, program->z, m*sizeof *program->best);
}

/* How near is the iterate to each of the three ends?  The nearest one's measure becomes the residual of the loop. */
static void judge(CpsiConicProgram *program, double gain, double pull, const double *force, CpsiSums *sums) {
    const int n = program->unknowns;
    const double *u = program->base.u, *c = program->c, tau = u[n], primal = sums->residual;
    double dual = 0, ray_dual = 0, ray_primal = 0;
    for (int j = 0; j < n; j++) {
        dual = cpsi_max_nan(dual, fabs(force[j] - c[j]*tau));
        ray_dual = cpsi_max_nan(ray_dual, fabs(force[j]));
    }
    for (int i = 0; i < program->rows; i++)
        ray_primal = cpsi_max_nan(ray_primal, fabs(program->rho[i] - program->b[i]*tau));
    const double value = fmin(fabs(gain), fabs(pull))/tau, sz = sums->sz + tau*program->kappa;
    double residual = cpsi_max_nan(primal, dual)/tau, scale = tau*tau*(1 + value);
    CpsiConicOutcome outcome = CPSI_CONIC_SOLVED;
    if (program->kappa > tau && pull < 0 && ray_dual/-pull < residual) {
        outcome = CPSI_CONIC_INFEASIBLE;
        residual = ray_dual/-pull;
    }
    if (program->kappa > tau && gain < 0 && ray_primal/-gain < residual) {
        outcome = CPSI_CONIC_UNBOUNDED;
        residual = ray_primal/-gain;
    }
    /* a ray is judged by its residual alone */
    if (outcome != CPSI_CONIC_SOLVED) scale = sz/residual;
    sums->residual = residual;
    sums->scale = scale;
    keep_best(program, outcome, sz/scale, residual);
}

static void tau_measure(CpsiProgram *base, CpsiSums *sums) {
    CpsiConicProgram *program = conic(base);
    const int n = program->unknowns;
    const double tau = base->u[n], gain = cpsi_dot(n, program->c, base->u), pull = base->residual[n];
    judge(program, gain, pull, base->residual, sums);
    sums->weight += 1;
    sums->sz += tau*program->kappa;
    for (int j = 0; j < n; j++) base->residual[j] -= program->c[j]*tau;
    base->residual[n] += gain + program->kappa;
}

static void tau_scale(CpsiProgram *base) {
    CpsiConicProgram *program = conic(base);
    const size_t n = (size_t)program->unknowns, width = n + 1;
    for (size_t j = 0; j < n; j++) {
        program->matrix[j*width + n] += program->c[j];
        program->matrix[n*width + j] -= program->c[j];
    }
    program->matrix[n*width + n] += program->kappa/base->u[n];
    program->q_tau = -program->kappa;
}

static void tau_load(CpsiProgram *base, double keep) {
    (void)keep;
    base->du[conic(base)->unknowns] += conic(base)->q_tau;
}

static void tau_direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    (void)predictor; /* the corrector forms the second-order term itself */
    (void)keep;
    CpsiConicProgram *program = conic(base);
    const double tau = base->u[program->unknowns], d_tau = base->du[program->unknowns];
    program->d_kappa = program->q_tau - program->kappa/tau*d_tau;
    sums->inverse_step = cpsi_max_nan(sums->inverse_step, cpsi_max_nan(-d_tau/tau, -program->d_kappa/program->kappa));
}

static void tau_correct(CpsiProgram *base, double target) {
    CpsiConicProgram *program = conic(base);
    const double tau = base->u[program->unknowns], d_tau = base->du[program->unknowns];
    program->q_tau = -program->kappa + (target - d_tau*program->d_kappa)/tau;
}

static void tau_advance(CpsiProgram *base, double alpha) { conic(base)->kappa += alpha*conic(base)->d_kappa; }

static const CpsiKind CONES = {cones_start, cones_measure, cones_scale, cones_load,
                               cones_direct, cones_correct, NULL, cones_advance};
static const CpsiKind TAU = {tau_start, tau_measure, tau_scale, tau_load, tau_direct, tau_correct, NULL, tau_advance};
static const CpsiKind *const KINDS[] = {&CONES, &TAU};

/* ---- the linear system ---- */

static void clear(CpsiProgram *base) {
    CpsiConicProgram *program = conic(base);
    memset(program->matrix, 0, (size_t)base->size*((size_t)program->unknowns + 1)*sizeof *program->matrix);
}

static const double *row_of_b(const CpsiConicProgram *program, int i) {
    const int width = program->unknowns + 1;
    return &program->matrix[(size_t)(width + i)*(size_t)width];
}

static bool factor(CpsiProgram *base) {
    CpsiConicProgram *program = conic(base);
    const int n = program->unknowns + 1;
    program->kept = 0;
    for (int i = 0; i < program->rows; i++) {
        double largest = 0;
        for (int j = 0; j < n; j++) largest = cpsi_max_nan(largest, fabs(row_of_b(program, i)[j]));
        program->at[i] = largest <= 1 ? -1 : n + program->kept++;
    }
    const size_t width = (size_t)(n + program->kept);
    double *lu = program->lu;
    memset(lu, 0, width*width*sizeof *lu);
    for (int j = 0; j < n; j++)
        memcpy(&lu[(size_t)j*width], &program->matrix[(size_t)j*(size_t)n], (size_t)n*sizeof *lu);
    for (int i = 0; i < program->rows; i++) {
        const double *b = row_of_b(program, i);
        const size_t at = (size_t)program->at[i];
        for (int j = 0; j < n && program->at[i] < 0; j++)
            for (int l = 0; l < n; l++) lu[(size_t)j*width + (size_t)l] += b[j]*b[l];
        for (int j = 0; j < n && program->at[i] >= 0; j++) {
            lu[at*width + (size_t)j] = b[j];
            lu[(size_t)j*width + at] = -b[j];
            lu[at*width + at] = 1;
        }
    }
    return cpsi_lu_factor((int)width, lu, program->pivot);
}

/* x = inverse of the matrix times f, both of (u, y); `work` (size) is scratch. */
static void apply_inverse(const CpsiConicProgram *program, const double *f, double *x, double *work) {
    const int n = program->unknowns + 1;
    memcpy(work, f, (size_t)n*sizeof *work);
    for (int i = 0; i < program->rows; i++) {
        const double *b = row_of_b(program, i);
        if (program->at[i] >= 0) work[program->at[i]] = f[n + i];
        for (int j = 0; j < n && program->at[i] < 0; j++) work[j] += f[n + i]*b[j];
    }
    cpsi_lu_solve(n + program->kept, program->lu, program->pivot, work);
    memcpy(x, work, (size_t)n*sizeof *x);
    for (int i = 0; i < program->rows; i++)
        x[n + i] = program->at[i] >= 0 ? work[program->at[i]] : f[n + i] - cpsi_dot(n, row_of_b(program, i), x);
}

/* left = f - the matrix times x */
static void find_left(const CpsiConicProgram *program, const double *f, const double *x, double *left) {
    const int n = program->unknowns + 1;
    for (int j = 0; j < n; j++) left[j] = f[j] - cpsi_dot(n, &program->matrix[(size_t)j*(size_t)n], x);
    for (int i = 0; i < program->rows; i++) {
        const double *b = row_of_b(program, i);
        for (int j = 0; j < n; j++) left[j] += b[j]*x[n + i];
        left[n + i] = f[n + i] - cpsi_dot(n, b, x) - x[n + i];
    }
}

/* Solve, and once more for what is left. */
static void solve(CpsiProgram *base) {
    CpsiConicProgram *program = conic(base);
    const int n = base->size;
    double *x = program->fix, *left = x + n, *work = left + n;
    apply_inverse(program, base->du, x, work);
    find_left(program, base->du, x, left);
    apply_inverse(program, left, base->du, work);
    for (int i = 0; i < n; i++) base->du[i] += x[i];
}

static double imbalance(const CpsiProgram *program) {
    (void)program; /* `judge` has counted it */
    return 0;
}

CpsiConicProgram *cpsi_conic_layout(CpsiArena *arena, int unknowns, int rows, int cones, int largest_cone) {
    const size_t n = (size_t)unknowns + 1, m = (size_t)rows, size = n + m;
    CpsiConicProgram *program = CPSI_TAKE(arena, 1, CpsiConicProgram);
    double *at = CPSI_TAKE(arena, 7*m + (size_t)cones + 4*(size_t)largest_cone + 8*size + m, double);
    double *matrices = CPSI_TAKE(arena, 2*size*size, double);
    int *pivot = CPSI_TAKE(arena, size + m, int);
    CpsiActive *active = CPSI_TAKE(arena, cones, CpsiActive);
    if (!program) return NULL;
    *program = (CpsiConicProgram){.unknowns = unknowns, .rows = rows, .cones = cones, .pivot = pivot,
                                  .at = pivot + size, .active = active, .matrix = matrices,
                                  .lu = matrices + size*size};
    double **of_rows[] = {&program->s, &program->z, &program->ds, &program->dz,
                          &program->q, &program->w, &program->rho};
    for (size_t k = 0; k < sizeof of_rows/sizeof *of_rows; k++, at += m) *of_rows[k] = at;
    program->g = at, at += cones;
    program->scratch = at, at += 4*(size_t)largest_cone;
    program->fix = at, at += 3*size;
    program->best = at, at += size + m;
    program->base = (CpsiProgram){.size = (int)size, .load = at, .u = at + size, .du = at + 2*size,
                                  .residual = at + 3*size, .kind_count = 2, .kind = KINDS, .clear = clear,
                                  .factor = factor, .solve = solve, .imbalance = imbalance};
    return program;
}

CpsiConicResult cpsi_conic_solve(CpsiConicProgram *program, double accept) {
    const CpsiIpmOptions options = {.target = TARGET, .scale = DBL_MIN, .max_iterations = MAX_ITERATIONS};
    cpsi_ipm_solve(&program->base, &options);
    CpsiConicResult result = program->found;
    const CpsiConicOutcome ending = result.outcome;

    /* the best iterate, divided by what normalises it: tau, the pull of the dual ray, the gain of the primal ray */
    const size_t n = (size_t)program->unknowns, m = (size_t)program->rows;
    const double *u = program->best, *s = u + n + 1, *z = s + m;
    double by = u[n], scale = 1;
    if (ending == CPSI_CONIC_INFEASIBLE) by = -cpsi_dot(program->rows, program->b, z);
    if (ending == CPSI_CONIC_UNBOUNDED) by = -cpsi_dot(program->unknowns, program->c, u);
    for (size_t j = 0; j < n; j++) program->base.u[j] = u[j]/by;
    for (size_t i = 0; i < m; i++) program->s[i] = s[i]/by, program->z[i] = z[i]/by;
    if (ending == CPSI_CONIC_SOLVED) {
        result.gap = fabs(cpsi_dot(program->rows, program->s, program->z));
        cpsi_conic_polish(program, &result);
        scale += fabs(cpsi_dot(program->unknowns, program->c, program->base.u));
    }
    if (!(result.residual <= accept && result.gap <= accept*scale)) result.outcome = CPSI_CONIC_FAILED;
    return result;
}
