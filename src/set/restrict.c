/* SPDX-License-Identifier: BSD-3-Clause */
/* A conic form restricted to a face of its cones. The interior-point solution (v, s, z) of a
 * program on the form lies in the relative interior of the optimal set, so z determines the face
 * cone by cone:
 *
 *     z = 0                    the cone's rows remain as they are
 *     z on the boundary        s lies on the ray of Jz: its other components are equations, and
 *                              s along the ray >= 0
 *     z inside (or z > 0)      s = 0
 *
 * written relative to the solution found, dv = v - v*, so that rounding cannot make the face
 * empty. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "ipm/cones.h"
#include "linalg/dense.h"
#include "set/conic_form.h"

/* Coefficients of rows of size one below this are rounding. */
static const double NOISE = 1e-9;

/* Affine row over dv: a'(A dv) + constant, with a over d rows of the form beginning with i. */
static void combine(const CpsiConicForm *form, int i, int d, const double *a, double constant,
                    double *row) {
    const int u = form->unknowns;
    for (int r = 0; r < d; r++)
        for (int j = 0; j < u; j++)
            row[j] += a[r] * form->a[(size_t)(i + r) * (size_t)u + (size_t)j];
    row[u] += constant;
}

/* An equation; rows that are only rounding are left out. */
static void equation(CpsiConicRows *conic, const CpsiConicForm *form, int i, int d,
                     const double *a) {
    double *row = cpsi_conic_rows_equation(conic);
    combine(form, i, d, a, 0, row);
    if (cpsi_norm(form->unknowns, row) > NOISE) return;
    memset(row, 0, (size_t)conic->width * sizeof *row);
    conic->equations--;
}

/* The rows of one cone on the face. a (d) is scratch. */
static void cone_on_face(CpsiConicRows *conic, const CpsiConicForm *form, const CpsiSolution *at,
                         int i, int d, double angle, double *a) {
    const double *s = &at->s[i], *z = &at->z[i];
    double *rows, size = cpsi_norm(d - 1, z + 1);
    if (z[0] <= angle) { /* inactive */
        rows = cpsi_conic_rows_cone(conic, d);
        for (int r = 0; r < d; r++)
            combine(form, i + r, 1, (const double[]){1}, s[r],
                    &rows[(size_t)r * (size_t)conic->width]);
        return;
    }
    if (d == 1 || z[0] - size > angle) { /* at the tip */
        for (int r = 0; r < d; r++) equation(conic, form, i + r, 1, (const double[]){1});
        return;
    }
    /* on the ray (1, -z1/|z1|)/sqrt 2 */
    for (int k = 0; k < d; k++) {
        /* component k less its part along the ray */
        const double along = k ? -z[k] / size : 1;
        for (int r = 0; r < d; r++) a[r] = (r == k) - 0.5 * along * (r ? -z[r] / size : 1);
        equation(conic, form, i, d, a);
    }
    double pull = s[0];
    for (int r = 0; r < d; r++) {
        a[r] = r ? -z[r] / size : 1;
        pull += r ? a[r] * s[r] : 0;
    }
    combine(form, i, d, a, pull, cpsi_conic_rows_cone(conic, 1));
}

CpsStatus cpsi_conic_form_restrict(const CpsiConicForm *form, const CpsiSolution *at, double angle,
                                   CpsiConicForm **out, CpsError *err) {
    const int n = form->n, u = form->unknowns;
    CpsiConicRows *conic = NULL;
    const CpsiCount count = {.unknowns = (size_t)u,
                             .equations = (size_t)form->rows + 1,
                             .rows = (size_t)form->rows,
                             .cones = (size_t)form->cones};
    CpsStatus status = cpsi_conic_rows_new(count, u, &conic, err);
    if (status) return status;
    double *map =
        calloc((size_t)n * (size_t)conic->width + (size_t)form->largest_cone + 1, sizeof *map);
    if (!map)
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a face");
    else {
        CPSI_FOR_CONES(k, i, form->cones, form->dim)
            cone_on_face(conic, form, at, i, form->dim[k], angle,
                         &map[(size_t)n * (size_t)conic->width]);
        for (int i = 0; i < n; i++) {
            memcpy(&map[(size_t)i * (size_t)conic->width], &form->p[(size_t)i * (size_t)u],
                   (size_t)u * sizeof *map);
            map[(size_t)i * (size_t)conic->width + (size_t)u] = at->x[i];
        }
        status = cpsi_conic_form_reduce(conic, n, map, form->lines, form->q, CPSI_SAME_EQUATION,
                                        out, err);
        if (!status) (*out)->size *= form->size; /* the rows above are in the unit of `form` */
    }
    free(map);
    cpsi_conic_rows_free(conic);
    return status;
}
