/* SPDX-License-Identifier: BSD-3-Clause */
/* The last digits of a solution: Newton's method on the constraints that are active.
 *
 * The interior-point loop ends when s.z is rounding; s and z of a second-order cone are then known to its root only.
 * But how each cone is active is certain by then. With the eigenvalues x0 -+ |x1| of s and z, small with large in
 * pairs:
 *
 *     free   z is the smaller of both pairs      z = 0
 *     tip    s is the smaller of both pairs      s = 0,  z unknown
 *     ray    each is the smaller of one pair     s0 = |s1|,  z = l (1, -n),  n = s1/|s1|,  l unknown
 *
 * Stationarity c - A'z = 0 and these equations, with s = A v + b, have the Jacobian
 *
 *     [ H  -G' ]    G: rows A of tips, a0 - n'A1 of rays
 *     [ G   0  ]    H: sum over rays of (l/|s1|) A1'(1 - n n')A1
 *
 * which is regular where solution and duals are unique; EASE on its diagonal leaves the others where they are. A step
 * counts when the residual has become smaller and s, z are still in their cones, so that what comes out is certified
 * as it was. */
#include <math.h>
#include <string.h>

#include "conic/dense_program.h"
#include "linalg/dense.h"

/* Beside data of order one: far above rounding, far below what decides the convergence. */
static const double EASE = 1e-11;
/* A residual that is rounding ends the steps. One that may be, where s is long, is as good as the loop's own, which
 * does not measure how far s and z are from their faces. */
static const double ROUNDING = 1e-16, GOOD = 1e-12;
/* The start is right to 1e-7 at least, so two steps are enough; further ones mend what EASE has held back. */
enum { STEPS = 5 };
/* How often a cone that is hardly active may turn out to be taken for the wrong kind. */
enum { TRIALS = 4 };

static CpsiActive active(const double *s, const double *z, int d) {
    const double s1 = cpsi_norm(d - 1, s + 1), z1 = cpsi_norm(d - 1, z + 1);
    if (z[0] + z1 < s[0] - s1) return CPSI_FREE;
    return d > 1 && s[0] + s1 > z[0] - z1 ? CPSI_RAY : CPSI_TIP;
}

/* s of v and z of the multipliers. Returns the first cone that one of them has left, -1 where there is none. */
static int place(CpsiConicProgram *program) {
    const int n = program->unknowns;
    int left = -1;
    for (int i = 0; i < program->rows; i++)
        program->s[i] = cpsi_dot(n, &program->a[(size_t)i*(size_t)n], program->base.u) + program->b[i];
    for (int k = 0, i = 0; k < program->cones; i += program->dim[k++]) {
        const int d = program->dim[k];
        double *s = &program->s[i], *z = &program->z[i];
        const double size = cpsi_norm(d - 1, s + 1);
        bool in = true;
        if (program->active[k] == CPSI_FREE) {
            memset(z, 0, (size_t)d*sizeof *z);
            in = s[0] >= size;
        } else if (program->active[k] == CPSI_TIP) {
            in = z[0] >= cpsi_norm(d - 1, z + 1);
        } else {
            in = size > 0 && z[0] > 0;
            for (int r = 1; size > 0 && r < d; r++) z[r] = -z[0]*s[r]/size;
        }
        if (!in && left < 0) left = k;
    }
    return left;
}

/* A cone that was left is taken for what the side tells on which it was left. */
static void correct(CpsiConicProgram *program, int k) {
    int i = 0;
    for (int l = 0; l < k; l++) i += program->dim[l];
    const int d = program->dim[k];
    const bool curved = d > 1, pressed = program->z[i] + cpsi_norm(d - 1, &program->z[i + 1]) > 0;
    if (program->active[k] == CPSI_FREE) program->active[k] = curved ? CPSI_RAY : CPSI_TIP;
    else program->active[k] = curved && pressed ? (program->active[k] == CPSI_TIP ? CPSI_RAY : CPSI_TIP) : CPSI_FREE;
}

/* Minus the equations' values, in du. Returns the largest. */
static double residual(CpsiConicProgram *program) {
    const int n = program->unknowns;
    double *left = program->base.du, most = 0;
    for (int j = 0; j < n; j++) left[j] = -program->c[j];
    for (int i = 0; i < program->rows; i++)
        for (int j = 0; j < n; j++) left[j] += program->z[i]*program->a[(size_t)i*(size_t)n + (size_t)j];
    int count = n;
    for (int k = 0, i = 0; k < program->cones; i += program->dim[k++]) {
        const int d = program->dim[k];
        const double *s = &program->s[i];
        if (program->active[k] == CPSI_RAY) left[count++] = cpsi_norm(d - 1, s + 1) - s[0];
        for (int r = 0; program->active[k] == CPSI_TIP && r < d; r++) left[count++] = -s[r];
    }
    for (int j = 0; j < count; j++) most = fmax(most, fabs(left[j]));
    return most;
}

/* The rows of one ray: g = a0 - n'A1, and H grows. */
static void curve(CpsiConicProgram *program, int i, int d, size_t size, double *g) {
    const size_t n = (size_t)program->unknowns;
    const double *a = &program->a[(size_t)i*n], *s = &program->s[i], length = cpsi_norm(d - 1, s + 1);
    const double bend = program->z[i]/length;
    memcpy(g, a, n*sizeof *g);
    for (int r = 1; r < d; r++)
        for (size_t j = 0; j < n; j++) g[j] -= s[r]/length*a[(size_t)r*n + j];
    for (size_t l = 0; l < n; l++) {
        double *row = &program->matrix[l*size];
        for (size_t j = 0; j < n; j++) row[j] -= bend*(a[l] - g[l])*(a[j] - g[j]); /* n'A1 = a0 - g */
        for (int r = 1; r < d; r++)
            for (size_t j = 0; j < n; j++) row[j] += bend*a[(size_t)r*n + l]*a[(size_t)r*n + j];
    }
}

/* The Jacobian, `size` wide. */
static void differentiate(CpsiConicProgram *program, size_t size) {
    const size_t n = (size_t)program->unknowns;
    double *matrix = program->matrix, *next = &matrix[n*size];
    memset(matrix, 0, size*size*sizeof *matrix);
    for (int k = 0, i = 0; k < program->cones; i += program->dim[k++]) {
        const int d = program->dim[k];
        if (program->active[k] == CPSI_RAY) curve(program, i, d, size, next), next += size;
        for (int r = 0; program->active[k] == CPSI_TIP && r < d; r++, next += size)
            memcpy(next, &program->a[(size_t)(i + r)*n], n*sizeof *next);
    }
    for (size_t i = 0; i < size; i++) {
        matrix[i*size + i] += EASE;
        for (size_t j = 0; i >= n && j < n; j++) matrix[j*size + i] = -matrix[i*size + j];
    }
}

/* Move v and the multipliers by du. */
static void move(CpsiConicProgram *program) {
    const double *step = program->base.du;
    for (int j = 0; j < program->unknowns; j++) program->base.u[j] += *step++;
    for (int k = 0, i = 0; k < program->cones; i += program->dim[k++]) {
        if (program->active[k] == CPSI_RAY) program->z[i] += *step++;
        for (int r = 0; program->active[k] == CPSI_TIP && r < program->dim[k]; r++) program->z[i + r] += *step++;
    }
}

/* v, s, z to (sign 1) or from (sign -1) what is kept. */
static void keep(CpsiConicProgram *program, int sign) {
    const size_t n = (size_t)program->unknowns, m = (size_t)program->rows;
    double *own[] = {program->base.u, program->s, program->z}, *kept = program->best;
    const size_t count[] = {n, m, m};
    for (int k = 0; k < 3; kept += count[k++]) {
        if (sign > 0) memcpy(kept, own[k], count[k]*sizeof *kept);
        else memcpy(own[k], kept, count[k]*sizeof *kept);
    }
}

/* Newton's steps from what is kept. Returns the cone that they leave, -1 where they end by themselves. */
static int steps(CpsiConicProgram *program, CpsiConicResult *found) {
    size_t size = (size_t)program->unknowns;
    for (int k = 0; k < program->cones; k++)
        if (program->active[k] != CPSI_FREE) size += program->active[k] == CPSI_RAY ? 1 : (size_t)program->dim[k];
    double best = INFINITY;
    for (int k = 0; k <= STEPS; k++) {
        const int left = place(program);
        if (left >= 0) return left;
        const double now = residual(program), gap = fabs(cpsi_dot(program->rows, program->s, program->z));
        /* the first look only snaps to what is active */
        if (!(now < best)) break;
        best = now;
        if (now + gap <= fmax(found->residual + found->gap, GOOD)) {
            keep(program, 1);
            found->residual = now, found->gap = gap;
        }
        if (now <= ROUNDING || k == STEPS) break;
        differentiate(program, size);
        if (!cpsi_lu_factor((int)size, program->matrix, program->pivot)) break;
        cpsi_lu_solve((int)size, program->matrix, program->pivot, program->base.du);
        move(program);
    }
    return -1;
}

void cpsi_conic_polish(CpsiConicProgram *program, CpsiConicResult *found) {
    for (int k = 0, i = 0; k < program->cones; i += program->dim[k++])
        program->active[k] = active(&program->s[i], &program->z[i], program->dim[k]);
    keep(program, 1);
    for (int k = 0; k < TRIALS; k++) {
        const int left = steps(program, found);
        if (left >= 0) correct(program, left);
        keep(program, -1);
        if (left < 0) break;
    }
}
