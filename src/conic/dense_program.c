/* SPDX-License-Identifier: BSD-3-Clause */
/* The operator of a small dense program (dense_program.h). With G = [A b] on u = (x, tau), the unit
 * vector e of tau, S u = (-c tau, c.x) and B = sqrt(g) W^-1 G, a direction (homogeneous.h) is
 *
 *     [ kappa/tau e e' - S   -B' ] [du]   [ keep residual + e q_tau             ]
 *     [ B                     I  ] [w ] = [ W q/sqrt(g) - keep sqrt(g) W^-1 rho ]
 *
 * and the matrix is factorised with pivoting. The unit entry in the column of w_i is as good a
 * pivot as any other if no entry of row i of B is larger. Such rows are eliminated by hand: B_i'B_i
 * is added to the first block. The matrix that remains has about the size of the active cones. */
#include "conic/dense_program.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "ipm/ipm.h"
#include "linalg/dense.h"

/* The loop stops at this merit; below it rounding dominates. */
static const double TARGET = 1e-14;
static const int MAX_ITERATIONS = 60;

/* f += factor (row i of G) */
static inline void add_row(const CpsiConicProgram *program, int i, double factor, double *f) {
    const int n = program->core.unknowns;
    const double *a = &program->data.a[(size_t)i * (size_t)n];
    for (int j = 0; j < n; j++) f[j] += factor * a[j];
    f[n] += factor * program->data.b[i];
}

static void multiply(const CpsiHomogeneous *core, const double *u, double factor, const double *v,
                     double *out) {
    const CpsiConicData *data = &((const CpsiConicProgram *)core)->data;
    const int n = core->unknowns;
    for (int i = 0; i < core->cones.rows; i++)
        out[i] =
            cpsi_dot(n, &data->a[(size_t)i * (size_t)n], u) + data->b[i] * u[n] + factor * v[i];
}

static void multiply_transposed(CpsiHomogeneous *core, double gain, double pull) {
    const CpsiConicProgram *program = (const CpsiConicProgram *)core;
    double *residual = core->base.residual;
    for (int i = 0; i < core->cones.rows; i++) add_row(program, i, core->cones.z[i], residual);
    residual[core->unknowns] = pull + (gain + core->kappa);
}

static double offset(const CpsiHomogeneous *core, const double *y, const double *z) {
    (void)y; /* there are no equations */
    return cpsi_dot(core->cones.rows, core->b, z);
}

/* The rows of B of one cone, written into the matrix. */
static void scale_cone(CpsiConicProgram *program, int k, int i) {
    const int d = program->data.dim[k], n = program->core.unknowns;
    const size_t width = (size_t)n + 1;
    const double *w = &program->core.cones.w[i], root = sqrt(program->core.cones.g[k]);
    double *first = &program->matrix[(size_t)(n + 1 + i) * width];
    /* W^-1: the first row is (Jw).G, the others G_r + w_r (-G_0 + w1.G1/(1 + w0)) */
    for (int r = 1; r < d; r++) add_row(program, i + r, w[r], first);
    for (int r = 1; r < d; r++) {
        double *row = first + (size_t)r * width;
        for (int j = 0; j <= n; j++) row[j] = root * w[r] / (1 + w[0]) * first[j];
        add_row(program, i, -root * w[r], row);
        add_row(program, i + r, root, row);
    }
    for (int j = 0; j <= n; j++) first[j] *= -root;
    add_row(program, i, root * w[0], first);
}

static void scale(CpsiHomogeneous *core) {
    CpsiConicProgram *program = (CpsiConicProgram *)core;
    const size_t n = (size_t)core->unknowns, width = n + 1;
    memset(program->matrix, 0, (size_t)core->base.size * width * sizeof *program->matrix);
    CPSI_FOR_CONES(k, i, core->cones.count, program->data.dim) scale_cone(program, k, i);
    for (size_t j = 0; j < n; j++) {
        program->matrix[j * width + n] += core->c[j];
        program->matrix[n * width + j] -= core->c[j];
    }
    program->matrix[n * width + n] += core->kappa / core->base.u[n];
}

static const double *row_of_b(const CpsiConicProgram *program, int i) {
    const int width = program->core.unknowns + 1;
    return &program->matrix[(size_t)(width + i) * (size_t)width];
}

static bool factor(CpsiProgram *base) {
    CpsiConicProgram *program = (CpsiConicProgram *)base;
    const int n = program->core.unknowns + 1;
    program->kept = 0;
    for (int i = 0; i < program->core.cones.rows; i++) {
        double largest = 0;
        for (int j = 0; j < n; j++) largest = cpsi_max_nan(largest, fabs(row_of_b(program, i)[j]));
        program->at[i] = largest <= 1 ? -1 : n + program->kept++;
    }
    const size_t width = (size_t)n + (size_t)program->kept;
    double *lu = program->lu;
    memset(lu, 0, width * width * sizeof *lu);
    for (int j = 0; j < n; j++)
        memcpy(&lu[(size_t)j * width], &program->matrix[(size_t)j * (size_t)n],
               (size_t)n * sizeof *lu);
    for (int i = 0; i < program->core.cones.rows; i++) {
        const double *b = row_of_b(program, i);
        const size_t at = (size_t)program->at[i];
        for (int j = 0; j < n && program->at[i] < 0; j++)
            for (int l = 0; l < n; l++) lu[(size_t)j * width + (size_t)l] += b[j] * b[l];
        for (int j = 0; j < n && program->at[i] >= 0; j++) {
            lu[at * width + (size_t)j] = b[j];
            lu[(size_t)j * width + at] = -b[j];
            lu[at * width + at] = 1;
        }
    }
    return cpsi_lu_factor((int)width, lu, program->pivot);
}

/* x = the inverse of the matrix times f, both of the form (u, y); `work` (size) is scratch. */
static void apply_inverse(const CpsiConicProgram *program, const double *f, double *x,
                          double *work) {
    const int n = program->core.unknowns + 1;
    memcpy(work, f, (size_t)n * sizeof *work);
    for (int i = 0; i < program->core.cones.rows; i++) {
        const double *b = row_of_b(program, i);
        if (program->at[i] >= 0) work[program->at[i]] = f[n + i];
        for (int j = 0; j < n && program->at[i] < 0; j++) work[j] += f[n + i] * b[j];
    }
    cpsi_lu_solve(n + program->kept, program->lu, program->pivot, work);
    memcpy(x, work, (size_t)n * sizeof *x);
    for (int i = 0; i < program->core.cones.rows; i++)
        x[n + i] = program->at[i] >= 0 ? work[program->at[i]]
                                       : f[n + i] - cpsi_dot(n, row_of_b(program, i), x);
}

/* left = f - the matrix times x */
static void find_left(const CpsiConicProgram *program, const double *f, const double *x,
                      double *left) {
    const int n = program->core.unknowns + 1;
    for (int j = 0; j < n; j++)
        left[j] = f[j] - cpsi_dot(n, &program->matrix[(size_t)j * (size_t)n], x);
    for (int i = 0; i < program->core.cones.rows; i++) {
        const double *b = row_of_b(program, i);
        for (int j = 0; j < n; j++) left[j] += b[j] * x[n + i];
        left[n + i] = f[n + i] - cpsi_dot(n, b, x) - x[n + i];
    }
}

/* Solve, with one step of iterative refinement. */
static void solve(CpsiProgram *base) {
    CpsiConicProgram *program = (CpsiConicProgram *)base;
    const int n = base->size;
    double *x = program->fix, *left = x + n, *work = left + n;
    apply_inverse(program, base->du, x, work);
    find_left(program, base->du, x, left);
    apply_inverse(program, left, base->du, work);
    for (int i = 0; i < n; i++) base->du[i] += x[i];
}

static const CpsiConicOperator DENSE = {multiply, multiply_transposed, offset, scale, factor, solve,
                                        true};

CpsiConicProgram *cpsi_conic_layout(CpsiArena *arena, int unknowns, int rows, int cones,
                                    int largest_cone) {
    CpsiConicProgram unplaced, *placed = cpsi_arena_take(arena, 1, sizeof *placed),
                               *program = placed ? placed : &unplaced;
    const size_t m = (size_t)rows, size = (size_t)unknowns + 1 + m;
    cpsi_homogeneous_layout(&program->core, arena, &DENSE, unknowns, 0, rows, cones, largest_cone);
    CPSI_PLACE(arena, program->matrix, size * size);
    CPSI_PLACE(arena, program->lu, size * size);
    CPSI_PLACE(arena, program->fix, 3 * size);
    CPSI_PLACE(arena, program->pivot, size);
    CPSI_PLACE(arena, program->at, m);
    CPSI_PLACE(arena, program->active, cones);
    return placed;
}

CpsiConicResult cpsi_conic_solve(CpsiConicProgram *program, double accept) {
    const CpsiIpmOptions options = {.target = TARGET,
                                    .scale = DBL_MIN,
                                    .max_iterations = MAX_ITERATIONS};
    CpsiHomogeneous *core = &program->core;
    core->c = program->data.c;
    core->b = program->data.b;
    core->cones.dim = program->data.dim;
    cpsi_homogeneous_begin(core);
    cpsi_ipm_solve(&core->base, &options);
    CpsiConicResult result = cpsi_homogeneous_result(core);
    double scale = 1;
    if (result.outcome == CPSI_CONIC_SOLVED) {
        result.gap = fabs(cpsi_dot(core->cones.rows, result.s, result.z));
        cpsi_conic_polish(program, &result);
        scale += fabs(cpsi_dot(core->unknowns, core->c, result.x));
    }
    if (!(result.residual <= accept && result.gap <= accept * scale))
        result.outcome = CPSI_CONIC_FAILED;
    return result;
}
