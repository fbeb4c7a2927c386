/* SPDX-License-Identifier: BSD-3-Clause */
/* The last digits of a solution: Newton's method on the active constraints.
 *
 * The interior-point loop gives s and z of a second-order cone only to the square root of rounding,
 * but with certainty how each cone is active (active_cone.h).
 *
 * Stationarity c - A'z = 0 and the equations of active cones, with s = A x + b, have the
 * Jacobian
 *
 *     [ H  -G' ]    G: rows A of tips, a0 - n'A1 of rays
 *     [ G   0  ]    H: sum over rays of (l/|s1|) A1'(1 - n n')A1
 *
 * which is regular where solution and duals are unique; EASE on its diagonal keeps the other
 * unknowns where they are. A step is accepted when the residual has become smaller and s, z are
 * still in their cones, so that the result has the same certificate as before. */
#include <math.h>
#include <string.h>

#include "conic/dense_program.h"
#include "linalg/dense.h"

/* Added to the diagonal for data of order one: far above rounding, and far below what affects the
 * convergence. */
static const double EASE = 1e-11;
/* At a residual of rounding size the steps end. One below GOOD, which may be rounding where s is
 * long, is as good as the loop's residual, which does not measure the distance of s and z from
 * their faces. */
static const double ROUNDING = 1e-16, GOOD = 1e-12;
/* The initial point is accurate to at least 1e-7, so two steps are enough; further steps correct
 * the effect of EASE. */
enum { STEPS = 5 };
/* Number of times the assumed activity of a cone that is hardly active may be corrected. */
enum { TRIALS = 4 };

/* s from x, and z from the multipliers. Returns the first cone that one of them is outside of, -1
 * where there is none. */
static int place(CpsiConicProgram *program) {
    const CpsiCones *cones = &program->core.cones;
    const int n = program->core.unknowns;
    int left = -1;
    for (int i = 0; i < cones->rows; i++)
        cones->s[i] = cpsi_dot(n, &program->data.a[(size_t)i * (size_t)n], program->core.base.u) +
                      program->data.b[i];
    CPSI_FOR_CONES(k, i, cones->count, cones->dim) {
        const CpsiActive kind = program->active[k];
        bool in = cpsi_active_place(kind, &cones->s[i], &cones->z[i], cones->dim[k]);
        in = in && (kind != CPSI_RAY || cones->z[i] > 0);
        if (!in && left < 0) left = k;
    }
    return left;
}

/* Change the activity of a cone according to the side on which it was left. */
static void correct(CpsiConicProgram *program, int k) {
    const CpsiCones *cones = &program->core.cones;
    int i = 0;
    for (int l = 0; l < k; l++) i += cones->dim[l];
    program->active[k] = cpsi_active_corrected(program->active[k], &cones->z[i], cones->dim[k]);
}

/* Minus the equations' values, in du. Returns the largest absolute value. */
static double residual(CpsiConicProgram *program) {
    const CpsiCones *cones = &program->core.cones;
    const int n = program->core.unknowns;
    double *left = program->core.base.du, most = 0;
    for (int j = 0; j < n; j++) left[j] = -program->data.c[j];
    for (int i = 0; i < cones->rows; i++)
        for (int j = 0; j < n; j++)
            left[j] += cones->z[i] * program->data.a[(size_t)i * (size_t)n + (size_t)j];
    int count = n;
    CPSI_FOR_CONES(k, i, cones->count, cones->dim)
        count += cpsi_active_values(program->active[k], &cones->s[i], cones->dim[k], &left[count]);
    for (int j = 0; j < count; j++) most = fmax(most, fabs(left[j]));
    return most;
}

/* Add to H the curvature of a ray whose gradient is g. */
static void curve(CpsiConicProgram *program, int i, int d, size_t size, const double *g) {
    const size_t n = (size_t)program->core.unknowns;
    const double *a = &program->data.a[(size_t)i * n];
    const double bend = program->core.cones.z[i] / cpsi_norm(d - 1, &program->core.cones.s[i + 1]);
    for (size_t l = 0; l < n; l++) {
        double *row = &program->matrix[l * size];
        for (size_t j = 0; j < n; j++)
            row[j] -= bend * (a[l] - g[l]) * (a[j] - g[j]); /* n'A1 = a0 - g */
        for (int r = 1; r < d; r++)
            for (size_t j = 0; j < n; j++)
                row[j] += bend * a[(size_t)r * n + l] * a[(size_t)r * n + j];
    }
}

/* The Jacobian, of size `size`. */
static void differentiate(CpsiConicProgram *program, size_t size) {
    const CpsiCones *cones = &program->core.cones;
    const size_t n = (size_t)program->core.unknowns;
    double *matrix = program->matrix, *next = &matrix[n * size];
    memset(matrix, 0, size * size * sizeof *matrix);
    CPSI_FOR_CONES(k, i, cones->count, cones->dim) {
        const int d = cones->dim[k], count = cpsi_active_gradients(program->active[k], (int)n,
                                                                   &program->data.a[(size_t)i * n],
                                                                   &cones->s[i], d, size, next);
        if (program->active[k] == CPSI_RAY) curve(program, i, d, size, next);
        next += (size_t)count * size;
    }
    for (size_t i = 0; i < size; i++) matrix[i * size + i] += EASE;
    for (size_t i = n; i < size; i++)
        for (size_t j = 0; j < n; j++) matrix[j * size + i] = -matrix[i * size + j];
}

/* Move x and the multipliers by du. */
static void move(CpsiConicProgram *program) {
    const CpsiCones *cones = &program->core.cones;
    const double *step = program->core.base.du;
    for (int j = 0; j < program->core.unknowns; j++) program->core.base.u[j] += *step++;
    CPSI_FOR_CONES(k, i, cones->count, cones->dim)
        for (int r = 0; r < cpsi_active_count(program->active[k], cones->dim[k]); r++)
            cones->z[i + r] += *step++;
}

/* Copy x, s, z to the stored point (sign 1) or back from it (sign -1). */
static void keep(CpsiConicProgram *program, int sign) {
    CpsiHomogeneous *core = &program->core;
    const size_t n = (size_t)core->unknowns, m = (size_t)core->cones.rows;
    double *own[] = {core->base.u, core->cones.s, core->cones.z}, *kept = core->best;
    const size_t count[] = {n, m, m};
    for (int k = 0; k < 3; kept += count[k++]) {
        if (sign > 0)
            memcpy(kept, own[k], count[k] * sizeof *kept);
        else
            memcpy(own[k], kept, count[k] * sizeof *kept);
    }
}

/* Newton's steps from the stored point. Returns the cone that they leave, -1 where they end for
 * another reason. */
static int steps(CpsiConicProgram *program, CpsiConicResult *found) {
    const CpsiCones *cones = &program->core.cones;
    size_t size = (size_t)program->core.unknowns;
    for (int k = 0; k < cones->count; k++)
        size += (size_t)cpsi_active_count(program->active[k], cones->dim[k]);
    double best = INFINITY;
    for (int k = 0; k <= STEPS; k++) {
        const int left = place(program);
        if (left >= 0) return left;
        const double now = residual(program), gap = fabs(cpsi_dot(cones->rows, cones->s, cones->z));
        /* the first pass only sets s and z to their active faces */
        if (!(now < best)) break;
        best = now;
        if (now + gap <= fmax(found->residual + found->gap, GOOD)) {
            keep(program, 1);
            found->residual = now;
            found->gap = gap;
        }
        if (now <= ROUNDING || k == STEPS) break;
        differentiate(program, size);
        if (!cpsi_lu_factor((int)size, program->matrix, program->pivot)) break;
        cpsi_lu_solve((int)size, program->matrix, program->pivot, program->core.base.du);
        move(program);
    }
    return -1;
}

void cpsi_conic_polish(CpsiConicProgram *program, CpsiConicResult *found) {
    const CpsiCones *cones = &program->core.cones;
    CPSI_FOR_CONES(k, i, cones->count, cones->dim)
        program->active[k] = cpsi_active(&cones->s[i], &cones->z[i], cones->dim[k]);
    keep(program, 1);
    for (int k = 0; k < TRIALS; k++) {
        const int left = steps(program, found);
        if (left >= 0) correct(program, left);
        keep(program, -1);
        if (left < 0) break;
    }
}
