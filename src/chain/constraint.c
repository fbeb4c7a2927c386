/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes held to a closed convex set (capstan/constraint.h): rows v = A u + b of the node's
 * displacement lie in cones K, and the force on the node is A'z, z in the dual cones.
 *
 *     half-line, second-order cone    v in K, z in K, v.z = 0
 *     equation                        v = 0, z of any sign
 *
 * Linearised, with the scaling H of a cone (cone.h): dz = q - H ds, ds = A du + rho + e dz, e being
 * small. Without e the node's block gains A'H A, whose entries grow without bound as v and z come
 * to the boundary; rows are oblique to the axes of the node, and the block would lose its digits
 * across them. With e they stay below 1/e, an equation is the limit of a large H, and what e leaves
 * of the residual, e dz, vanishes with the steps. So
 *
 *     dz = M (H^-1 q - rho - A du),        M = (H^-1 + e)^-1,
 *
 * and M has the eigenvectors of W, in which nothing cancels. */
#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "chain/constraints.h"
#include "chain/elements.h"
#include "ipm/cone.h"

/* The cones of a constraint: k with its first row i; an equation has dimension 0 and one row. */
static inline int rows_of(int dim) { return dim > 0 ? dim : 1; }
#define FOR_CONES(k, i, of) for (int k = 0, i = 0; k < (of)->cones; i += rows_of((of)->dim[k]), k++)

static double value_of(const CpsiConstraint *of, int row, const double *u) {
    const double *x = &u[3 * of->node], *a = of->a[row];
    return of->b[row] + a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
}

static double change_of(const CpsiConstraint *of, int row, const double *du) {
    const double *x = &du[3 * of->node], *a = of->a[row];
    return a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
}

static void add_to_node(const CpsiConstraint *of, int row, double by, double *force) {
    for (int a = 0; a < 3; a++) force[3 * of->node + a] += by * of->a[row][a];
}

/* s at the iterate, or where that is nearer to the boundary than `margin`, beyond it. */
static void start_cone(CpsiConstraint *of, int i, int dim, double mu, double margin) {
    double *s = &of->s[i], *z = &of->z[i], size = 0;
    for (int r = 1; r < dim; r++) size += s[r] * s[r];
    s[0] = fmax(s[0], sqrt(size) + margin);
    if (dim == 1) {
        z[0] = mu / s[0];
        return;
    }
    const double inverse = mu / cpsi_soc_det(s, dim);
    z[0] = inverse * s[0];
    for (int r = 1; r < dim; r++) z[r] = -inverse * s[r];
}

static void start(CpsiProgram *base, double mu, double margin) {
    CpsiConstraints *all = &cpsi_chain(base)->constraints;
    for (int c = 0; c < all->count; c++) {
        CpsiConstraint *of = &all->item[c];
        FOR_CONES(k, i, of) {
            for (int r = i; r < i + of->dim[k]; r++) of->s[r] = value_of(of, r, base->u);
            if (of->dim[k] > 0)
                start_cone(of, i, of->dim[k], mu, margin);
            else
                of->s[i] = of->z[i] = 0;
        }
    }
}

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    CpsiConstraints *all = &cpsi_chain(base)->constraints;
    for (int c = 0; c < all->count; c++) {
        CpsiConstraint *of = &all->item[c];
        FOR_CONES(k, i, of) {
            const int rows = rows_of(of->dim[k]);
            if (alpha != 0)
                cpsi_cone_advance((size_t)rows, alpha, &of->s[i], &of->ds[i], &of->z[i],
                                  &of->dz[i]);
            for (int r = i; r < i + rows; r++) {
                const double at = value_of(of, r, base->u), rho = at - of->s[r];
                sums->sz += of->s[r] * of->z[r];
                sums->ray -= of->z[r] * at;
                sums->residual = cpsi_max_nan(sums->residual, fabs(rho));
                sums->largest = cpsi_max_nan(sums->largest, fabs(of->z[r]));
                add_to_node(of, r, of->z[r], base->residual);
            }
            if (of->dim[k] > 0) sums->weight += 1;
            if (of->dim[k] > 1) sums->scale += of->s[i] * of->z[i];
        }
    }
}

/* out = f(H^-1) x; of an equation H^-1 is 0. */
static void apply(const CpsiConstraint *of, int k, int i, CpsiConePower power, const double *x,
                  double *out) {
    if (of->dim[k] == 0)
        out[0] = cpsi_cone_power(0, power) * x[0];
    else
        cpsi_cone_power_apply(out, x, of->dim[k], &of->w[i], of->g[k], power);
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    static const int ROW[6] = {0, 0, 1, 0, 1, 2}, COLUMN[6] = {0, 1, 1, 2, 2, 2};
    for (int c = 0; c < program->constraints.count; c++) {
        CpsiConstraint *of = &program->constraints.item[c];
        double *diagonal = &program->matrix.diagonal[6 * of->node];
        FOR_CONES(k, i, of) {
            const int rows = rows_of(of->dim[k]);
            if (of->dim[k] > 0)
                of->g[k] = cpsi_cone_scale(&of->w[i], &of->s[i], &of->z[i], of->dim[k]);
            for (int a = 0; a < 3; a++) { /* M times column a of A, and A' times that */
                double column[CPSI_CONE_ROWS], of_m[CPSI_CONE_ROWS];
                for (int r = 0; r < rows; r++) column[r] = of->a[i + r][a];
                apply(of, k, i, CPSI_CONE_STIFFNESS, column, of_m);
                for (int e = 0; e < 6; e++)
                    for (int r = 0; r < rows && COLUMN[e] == a; r++)
                        diagonal[e] += of->a[i + r][ROW[e]] * of_m[r];
            }
        }
    }
}

/* q of an aim, of a corrector with the second-order term of the predictor in (ds, dz). */
static void set_aim(CpsiConstraint *of, int k, int i, const CpsiIpmAim *aim) {
    const int dim = of->dim[k];
    double scratch[4 * CPSI_CONE_ROWS], none[CPSI_CONE_ROWS] = {0};
    for (int r = i; r < i + rows_of(dim); r++)
        of->q[r] = aim->kind == CPSI_IPM_AIM_PREDICT ? -of->z[r] : 0;
    if (dim == 0) of->q[i] = 0;
    if (dim == 0 || aim->kind == CPSI_IPM_AIM_PREDICT || aim->kind == CPSI_IPM_AIM_GIVEN) return;
    const bool corrects = aim->kind == CPSI_IPM_AIM_CORRECT;
    const double target = dim > 1 ? cpsi_soc_aim(aim->target, &of->s[i], &of->z[i]) : aim->target;
    cpsi_cone_correct(&of->q[i], dim, &of->w[i], of->g[k], &of->s[i], &of->z[i],
                      corrects ? &of->ds[i] : none, corrects ? &of->dz[i] : none, target, scratch);
}

/* dz without the part that is linear in du. */
static void fixed_part(const CpsiConstraint *of, int k, int i, double keep, const double *u,
                       double *out) {
    double right[CPSI_CONE_ROWS];
    apply(of, k, i, CPSI_CONE_COMPLIANCE, &of->q[i], right);
    for (int r = 0; r < rows_of(of->dim[k]); r++)
        right[r] -= keep * (value_of(of, i + r, u) - of->s[i + r]);
    apply(of, k, i, CPSI_CONE_STIFFNESS, right, out);
}

static void load(CpsiProgram *base, const CpsiIpmAim *aim) {
    CpsiConstraints *all = &cpsi_chain(base)->constraints;
    for (int c = 0; c < all->count; c++) {
        CpsiConstraint *of = &all->item[c];
        FOR_CONES(k, i, of) {
            double fixed[CPSI_CONE_ROWS];
            set_aim(of, k, i, aim);
            fixed_part(of, k, i, aim->keep, base->u, fixed);
            for (int r = 0; r < rows_of(of->dim[k]); r++)
                add_to_node(of, i + r, fixed[r], base->du);
        }
    }
}

static void direct(CpsiProgram *base, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiConstraints *all = &cpsi_chain(base)->constraints;
    for (int c = 0; c < all->count; c++) {
        CpsiConstraint *of = &all->item[c];
        FOR_CONES(k, i, of) {
            const int dim = of->dim[k];
            double fixed[CPSI_CONE_ROWS], moved[CPSI_CONE_ROWS], by[CPSI_CONE_ROWS],
                scratch[2 * CPSI_CONE_ROWS];
            fixed_part(of, k, i, aim->keep, base->u, fixed);
            for (int r = 0; r < rows_of(dim); r++) moved[r] = change_of(of, i + r, base->du);
            apply(of, k, i, CPSI_CONE_STIFFNESS, moved, by);
            for (int r = 0; r < rows_of(dim); r++) {
                of->dz[i + r] = fixed[r] - by[r];
                of->ds[i + r] =
                    dim == 0
                        ? 0
                        : moved[r] + aim->keep * (value_of(of, i + r, base->u) - of->s[i + r]) +
                              CPSI_YIELD * of->dz[i + r];
            }
            if (dim > 0)
                sums->inverse_step =
                    cpsi_max_nan(sums->inverse_step,
                                 cpsi_cone_step(dim, &of->w[i], of->g[k], &of->s[i], &of->z[i],
                                                &of->ds[i], &of->dz[i], scratch));
        }
    }
}

const CpsiKind cpsi_constraint = {start, measure, scale, load, direct};
