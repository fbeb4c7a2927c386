/* SPDX-License-Identifier: BSD-3-Clause */
/* The analytic centre of a conic form (conic_centre.h): Newton's method, damped while its decrement
 * is large (Nesterov and Nemirovskii 1994), from the point with the largest margin, which a small
 * conic program finds. */
#include "cable/conic_centre.h"

#include <string.h>

#include "base/arena.h"
#include "base/status.h"
#include "conic/dense_program.h"
#include "ipm/cones.h"
#include "ipm/soc.h"
#include "linalg/dense.h"

/* Accuracy that the margin must have to be used, relative to data of order one. */
static const double ACCEPT = 1e-9;
/* A conic form whose largest margin is below this, its rows being of size one, counts as having no
 * interior. */
static const double LEAST_MARGIN = 1e-9;
enum { MAX_CENTERING = 200 };

/* Scratch memory of the search for the centre. */
typedef struct Work {
    CpsiConicProgram *program;
    double *a, *b, *c; /* of the program for the margin */
    int *dim;
    double *z, *gradient, *step; /* (rows), (unknowns), (unknowns) */
    double *hessian, *factor;    /* (unknowns, unknowns) */
} Work;

static void layout_work(CpsiArena *arena, Work *work, const CpsiConicForm *form) {
    const size_t n = (size_t)form->unknowns, m = (size_t)form->rows;
    work->program = cpsi_conic_layout(arena, form->unknowns + 1, form->rows + 1, form->cones + 1,
                                      form->largest_cone);
    CPSI_PLACE(arena, work->a, (m + 1) * (n + 1));
    CPSI_PLACE(arena, work->b, m + 1);
    CPSI_PLACE(arena, work->c, n + 1);
    CPSI_PLACE(arena, work->dim, form->cones + 1);
    CPSI_PLACE(arena, work->z, m);
    CPSI_PLACE(arena, work->gradient, n);
    CPSI_PLACE(arena, work->step, n);
    CPSI_PLACE(arena, work->hessian, n * n);
    CPSI_PLACE(arena, work->factor, n * n);
}

/* The largest t <= 1 with A v + b - t e in K, and v. */
static double find_margin(const CpsiConicForm *form, const Work *work, double *v) {
    const size_t n = (size_t)form->unknowns, m = (size_t)form->rows, width = n + 1;
    for (size_t i = 0; i < m; i++)
        memcpy(&work->a[i * width], &form->a[i * n], n * sizeof *work->a);
    memcpy(work->b, form->b, m * sizeof *work->b);
    memcpy(work->dim, form->dim, (size_t)form->cones * sizeof *work->dim);
    CPSI_FOR_CONES(k, i, form->cones, form->dim) work->a[(size_t)i * width + n] = -1;
    work->a[m * width + n] = -1;
    work->b[m] = 1;
    work->dim[form->cones] = 1;
    work->c[n] = -1;
    work->program->data =
        (CpsiConicData){.dim = work->dim, .a = work->a, .b = work->b, .c = work->c};
    const CpsiConicResult result = cpsi_conic_solve(work->program, ACCEPT);
    if (result.outcome != CPSI_CONIC_SOLVED) return 0;
    memcpy(v, result.x, n * sizeof *v);
    return result.x[n];
}

/* z = A v + b, its gradient A'z^-1 and the Hessian A'(2 (Jz)(Jz)'/det^2 - J/det) A of the barrier.
 * False: z is not inside. */
static bool differentiate(const CpsiConicForm *form, const Work *work, const double *v) {
    const size_t n = (size_t)form->unknowns;
    memset(work->gradient, 0, n * sizeof *work->gradient);
    memset(work->hessian, 0, n * n * sizeof *work->hessian);
    for (int i = 0; i < form->rows; i++)
        work->z[i] = cpsi_dot(form->unknowns, &form->a[(size_t)i * n], v) + form->b[i];
    CPSI_FOR_CONES(k, i, form->cones, form->dim) {
        const int d = form->dim[k];
        const double *z = &work->z[i], *a = &form->a[(size_t)i * n];
        if (!(z[0] > (d == 1 ? 0 : cpsi_norm(d - 1, z + 1)))) return false;
        const double det = d == 1 ? z[0] * z[0] : cpsi_soc_det(z, d);
        for (size_t j = 0; j < n;
             j++) { /* the column a'Jz, then products; a half-line's (1/z)^2 comes out the same */
            double jz = z[0] * a[j];
            for (size_t r = 1; r < (size_t)d; r++) jz -= z[r] * a[r * n + j];
            work->step[j] = jz / det;
            work->gradient[j] += jz / det;
        }
        for (size_t j = 0; j < n; j++)
            for (size_t l = 0; l < n; l++) {
                double inner = a[j] * a[l];
                for (size_t r = 1; r < (size_t)d; r++) inner -= a[r * n + j] * a[r * n + l];
                work->hessian[j * n + l] += 2 * work->step[j] * work->step[l] - inner / det;
            }
    }
    return true;
}

/* From a point inside to the analytic centre; false where it is not reached. */
static bool centre(const CpsiConicForm *form, const Work *work, double *v) {
    const int n = form->unknowns;
    for (int round = 0; round < MAX_CENTERING; round++) {
        if (!differentiate(form, work, v) || !cpsi_cholesky(n, work->hessian, work->factor))
            return false;
        /* step = (L L')^-1 gradient, decrement = |L^-1 gradient| */
        double *x = work->step;
        for (int i = 0; i < n; i++)
            x[i] = (work->gradient[i] - cpsi_dot(i, &work->factor[i * n], x)) /
                   work->factor[i * n + i];
        const double decrement = cpsi_norm(n, x);
        for (int i = n - 1; i >= 0; i--) {
            for (int j = i + 1; j < n; j++) x[i] -= work->factor[j * n + i] * x[j];
            x[i] /= work->factor[i * n + i];
        }
        const double by = decrement > 0.25 ? 1 / (1 + decrement) : 1;
        for (int i = 0; i < n; i++) v[i] += by * x[i];
        if (decrement <= 1e-8)
            return true; /* the last step squares the decrement, which is then rounding */
    }
    return false;
}

CpsStatus cpsi_conic_centre(const CpsiConicForm *form, double *out, bool *found, CpsError *err) {
    CpsiArena arena = {0};
    Work work;
    layout_work(&arena, &work, form);
    if (!cpsi_arena_allocate(&arena)) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a set");
    layout_work(&arena, &work, form);
    *found = find_margin(form, &work, out) > LEAST_MARGIN && centre(form, &work, out);
    cpsi_arena_free(&arena);
    return CPS_OK;
}
