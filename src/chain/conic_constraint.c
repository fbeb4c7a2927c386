/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes held to a closed convex set in its conic form (constraints.h),
 *
 *     x = origin + P v,     s = A v + b in K,     z in K*,     s o z = 0,     P'f = A'z,
 *
 * x the place of the node and f the force of the set on it: -f is in the normal cone at x, since
 * for any other y = origin + P w of the set f.(y - x) = z.(A w + b) - z.s >= 0. Linearised, with g
 * = H^-1 q - rho and M = (H^-1 + e)^-1 as in constraint.c, and the same e in the equation of the
 * place,
 *
 *     dz = M (g - A dv)
 *     A'M A dv = A'M g + r - P'df                         r = A'z - P'f
 *     F du + r_x - P dv + e df = 0                        r_x = x(u) - origin - P v
 *
 * A'M A is never formed, since the entries of M range from 1/e to that of cones which are far from
 * closed: with M^1/2 A = Q R and T = R^-T P', R dv = y - T df, y = Q'M^1/2 g + R^-T r, so that
 *
 *     (T'T + e) df = T'y - r_x - F du.
 *
 * and dz = M^1/2 ((1 - QQ') M^1/2 g + Q (T df - R^-T r)), which keeps A'dz = P'df - r to rounding;
 * M (g - A dv) would lose it where M is large. The columns of T are made orthogonal by rotations
 * (one-sided Jacobi), so that each eigenvalue of T'T keeps its relative accuracy. */
#include <string.h>

#include "chain/constraints.h"
#include "chain/elements.h"
#include "ipm/cone.h"
#include "ipm/cones.h"
#include "linalg/dense.h"

/* Rotations of the three columns end where they are orthogonal to rounding. */
enum { SWEEPS = 30 };
static const double ORTHOGONAL = 1e-15;

/* Added to the normal equations of the first force, per trace. */
static const double FLAT = 1e-12;

void cpsi_conic_constraint_layout(CpsiConicConstraint *of, CpsiArena *arena,
                                  const CpsiConicSet *set) {
    const size_t n = (size_t)set->unknowns, m = (size_t)set->rows;
    of->set = set;
    CPSI_PLACE(arena, of->begin, n);
    CPSI_PLACE(arena, of->v, n);
    CPSI_PLACE(arena, of->dv, n);
    double **const rows[] = {&of->s, &of->z, &of->ds, &of->dz, &of->q, &of->w, &of->rest};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) CPSI_PLACE(arena, *rows[i], m);
    CPSI_PLACE(arena, of->g, set->cones);
    CPSI_PLACE(arena, of->basis, m * n);
    CPSI_PLACE(arena, of->factor, n * n);
    CPSI_PLACE(arena, of->reach, 3 * n);
    CPSI_PLACE(arena, of->along, n);
    CPSI_PLACE(arena, of->missing, n);
    CPSI_PLACE(arena, of->scratch, 4 * m);
}

#define FOR_CONES(k, i, of) CPSI_FOR_CONES(k, i, (of)->set->cones, (of)->set->dim)

static const double *row_of(const CpsiConicConstraint *of, int i) {
    return &of->set->a[(size_t)i * (size_t)of->set->unknowns];
}

/* A v + b in row i, and A dv. */
static double value_of(const CpsiConicConstraint *of, int i) {
    return of->set->b[i] + cpsi_dot(of->set->unknowns, row_of(of, i), of->v);
}
static double change_of(const CpsiConicConstraint *of, int i) {
    return cpsi_dot(of->set->unknowns, row_of(of, i), of->dv);
}

/* Entry of P along the common axis `a`, in lengths of the program. */
static double map_of(const CpsiConicConstraint *of, int a, int j) {
    return of->set->p[(size_t)a * (size_t)of->set->unknowns + (size_t)j] / of->unit;
}

/* r_x along the common axis `a`. */
static double off_of(const CpsiConicConstraint *of, int a, const double *u) {
    const double *x = &u[3 * of->node], *e = of->frame[a];
    double off = of->at[a] + e[0] * x[0] + e[1] * x[1] + e[2] * x[2];
    for (int j = 0; j < of->set->unknowns; j++) off -= map_of(of, a, j) * of->v[j];
    return off;
}

/* r of unknown j. */
static double imbalance_of(const CpsiConicConstraint *of, int j) {
    double sum = 0;
    for (int i = 0; i < of->set->rows; i++) sum += row_of(of, i)[j] * of->z[i];
    for (int a = 0; a < 3; a++) sum -= map_of(of, a, j) * of->force[a];
    return sum;
}

static void add_to_node(const CpsiConicConstraint *of, const double force[3], double *to) {
    for (int a = 0; a < 3; a++)
        for (int c = 0; c < 3; c++) to[3 * of->node + c] += force[a] * of->frame[a][c];
}

/* s at the iterate, or where that is nearer to the boundary than `margin`, beyond it. */
static void start_cone(CpsiConicConstraint *of, int i, int dim, double mu, double margin) {
    double *s = &of->s[i], *z = &of->z[i];
    const double size = cpsi_norm(dim - 1, s + 1);
    s[0] = fmax(s[0], size + margin);
    const double inverse = dim == 1 ? mu / (s[0] * s[0]) : mu / cpsi_soc_det(s, dim);
    z[0] = inverse * s[0];
    for (int r = 1; r < dim; r++) z[r] = -inverse * s[r];
}

/* The force that balances z best, in the least squares of P'f = A'z; none along axes in which the
 * set is flat. */
static void start_force(CpsiConicConstraint *of) {
    const int n = of->set->unknowns;
    double normal[9] = {0}, factor[9], *f = of->force, size = 0;
    memset(f, 0, sizeof of->force);
    for (int j = 0; j < n; j++) {
        const double pull = imbalance_of(of, j);
        for (int a = 0; a < 3; a++) of->d_force[a] = map_of(of, a, j);
        for (int a = 0; a < 3; a++) {
            of->fixed[a] = (j > 0 ? of->fixed[a] : 0) + of->d_force[a] * pull;
            for (int b = 0; b < 3; b++) normal[3 * a + b] += of->d_force[a] * of->d_force[b];
        }
    }
    for (int a = 0; a < 3; a++) size += normal[4 * a];
    for (int a = 0; a < 3; a++) normal[4 * a] += FLAT * size;
    if (!(size > 0) || !cpsi_cholesky(3, normal, factor)) return;
    for (int a = 0; a < 3; a++)
        f[a] = (of->fixed[a] - cpsi_dot(a, &factor[3 * a], f)) / factor[4 * a];
    for (int a = 2; a >= 0; a--) {
        for (int b = a + 1; b < 3; b++) f[a] -= factor[3 * b + a] * f[b];
        f[a] /= factor[4 * a];
    }
}

static void start(CpsiProgram *base, double mu, double margin) {
    CpsiConstraints *all = &cpsi_chain(base)->constraints;
    for (int c = 0; c < all->conic_count; c++) {
        CpsiConicConstraint *of = all->conic[c];
        memcpy(of->v, of->begin, (size_t)of->set->unknowns * sizeof *of->v);
        for (int i = 0; i < of->set->rows; i++) of->s[i] = value_of(of, i);
        FOR_CONES(k, i, of) start_cone(of, i, of->set->dim[k], mu, margin * of->rows_per_unit);
        start_force(of);
    }
}

static void advance(CpsiConicConstraint *of, double alpha) {
    cpsi_cone_advance((size_t)of->set->rows, alpha, of->s, of->ds, of->z, of->dz);
    for (int j = 0; j < of->set->unknowns; j++) of->v[j] += alpha * of->dv[j];
    for (int a = 0; a < 3; a++) of->force[a] += alpha * of->d_force[a];
}

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    CpsiConstraints *all = &cpsi_chain(base)->constraints;
    for (int c = 0; c < all->conic_count; c++) {
        CpsiConicConstraint *of = all->conic[c];
        if (alpha != 0) advance(of, alpha);
        const double size = fmax(1, cpsi_norm(3, of->force));
        for (int i = 0; i < of->set->rows; i++) {
            const double at = value_of(of, i);
            sums->sz += of->s[i] * of->z[i];
            sums->ray -= of->z[i] * at;
            sums->residual = cpsi_max_nan(sums->residual, fabs(at - of->s[i]));
        }
        for (int a = 0; a < 3; a++) {
            const double off = off_of(of, a, base->u);
            sums->ray -= of->force[a] * off;
            sums->residual = cpsi_max_nan(sums->residual, fabs(off));
            sums->largest = cpsi_max_nan(sums->largest, fabs(of->force[a]));
        }
        for (int j = 0; j < of->set->unknowns; j++)
            sums->residual = cpsi_max_nan(sums->residual, fabs(imbalance_of(of, j)) / size);
        FOR_CONES(k, i, of) {
            sums->weight += 1;
            if (of->set->dim[k] > 1) sums->scale += of->s[i] * of->z[i];
        }
        add_to_node(of, of->force, base->residual);
    }
}

/* Q and R of M^1/2 A, by Gram and Schmidt. */
static void factorise(CpsiConicConstraint *of) {
    const int n = of->set->unknowns, m = of->set->rows;
    double *q = of->basis, *column = of->scratch, *turned = of->scratch + m;
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < m; i++) column[i] = row_of(of, i)[j];
        FOR_CONES(k, i, of)
        cpsi_cone_power_apply(&turned[i], &column[i], of->set->dim[k], &of->w[i], of->g[k],
                              CPSI_CONE_STIFFNESS_ROOT);
        for (int i = 0; i < m; i++) q[i * n + j] = turned[i];
    }
    for (int j = 0; j < n; j++) {
        for (int l = 0; l < j; l++) of->factor[l * n + j] = 0;
        for (int l = 0; l < 2 * j; l++) { /* twice, which leaves no more than rounding */
            const int by = l % j;
            double common = 0;
            for (int i = 0; i < m; i++) common += q[i * n + by] * q[i * n + j];
            for (int i = 0; i < m; i++) q[i * n + j] -= common * q[i * n + by];
            of->factor[by * n + j] += common;
        }
        double size = 0;
        for (int i = 0; i < m; i++) size += q[i * n + j] * q[i * n + j];
        size = of->factor[j * n + j] = sqrt(size);
        for (int i = 0; i < m; i++) q[i * n + j] /= size;
    }
}

/* x = R^-T x; and x = R^-1 x, both with `width` numbers each. */
static void solve_transposed(const CpsiConicConstraint *of, double *x, int width) {
    const int n = of->set->unknowns;
    for (int j = 0; j < n; j++)
        for (int a = 0; a < width; a++) {
            for (int i = 0; i < j; i++)
                x[j * width + a] -= of->factor[i * n + j] * x[i * width + a];
            x[j * width + a] /= of->factor[j * n + j];
        }
}
static void solve_upper(const CpsiConicConstraint *of, double *x) {
    const int n = of->set->unknowns;
    for (int j = n - 1; j >= 0; j--) {
        for (int i = j + 1; i < n; i++) x[j] -= of->factor[j * n + i] * x[i];
        x[j] /= of->factor[j * n + j];
    }
}

/* Rotate two columns of a matrix (rows, 3). */
static void rotate(double *x, int rows, int a, int b, double cosine, double sine) {
    for (int i = 0; i < rows; i++) {
        const double one = x[3 * i + a], two = x[3 * i + b];
        x[3 * i + a] = cosine * one - sine * two;
        x[3 * i + b] = sine * one + cosine * two;
    }
}

/* The eigenvectors and eigenvalues of T'T + e. */
static void find_compliance(CpsiConicConstraint *of) {
    const int n = of->set->unknowns;
    double *t = of->reach, sum[3][3], axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    bool rotated = true;
    for (int sweep = 0; sweep < SWEEPS && rotated; sweep++) {
        rotated = false;
        for (int a = 0; a < 2; a++)
            for (int b = a + 1; b < 3; b++) {
                memset(sum, 0, sizeof sum);
                for (int j = 0; j < n; j++) {
                    sum[a][a] += t[3 * j + a] * t[3 * j + a];
                    sum[b][b] += t[3 * j + b] * t[3 * j + b];
                    sum[a][b] += t[3 * j + a] * t[3 * j + b];
                }
                if (!(fabs(sum[a][b]) > ORTHOGONAL * sqrt(sum[a][a]) * sqrt(sum[b][b]))) continue;
                const double half = (sum[b][b] - sum[a][a]) / (2 * sum[a][b]),
                             tangent = copysign(1, half) / (fabs(half) + hypot(1, half)),
                             cosine = 1 / hypot(1, tangent);
                rotate(t, n, a, b, cosine, cosine * tangent);
                rotate(axes, 3, a, b, cosine, cosine * tangent);
                rotated = true;
            }
    }
    for (int e = 0; e < 3; e++) {
        of->compliance[e] = CPSI_YIELD;
        for (int j = 0; j < n; j++) of->compliance[e] += t[3 * j + e] * t[3 * j + e];
        for (int a = 0; a < 3; a++) of->turn[3 * e + a] = axes[3 * a + e];
    }
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    static const int ROW[6] = {0, 0, 1, 0, 1, 2}, COLUMN[6] = {0, 1, 1, 2, 2, 2};
    for (int c = 0; c < program->constraints.conic_count; c++) {
        CpsiConicConstraint *of = program->constraints.conic[c];
        double *diagonal = &program->matrix.diagonal[6 * of->node];
        FOR_CONES(k, i, of)
        of->g[k] = cpsi_cone_scale(&of->w[i], &of->s[i], &of->z[i], of->set->dim[k]);
        factorise(of);
        for (int j = 0; j < of->set->unknowns; j++)
            for (int a = 0; a < 3; a++) of->reach[3 * j + a] = map_of(of, a, j);
        solve_transposed(of, of->reach, 3);
        find_compliance(of);
        for (int e = 0; e < 3; e++) {
            double own[3] = {0};
            for (int a = 0; a < 3; a++)
                for (int x = 0; x < 3; x++) own[x] += of->turn[3 * e + a] * of->frame[a][x];
            for (int i = 0; i < 6; i++)
                diagonal[i] += own[ROW[i]] * own[COLUMN[i]] / of->compliance[e];
        }
    }
}

/* q of an aim, of a corrector with the second-order term of the predictor in (ds, dz). */
static void set_aim(CpsiConicConstraint *of, const CpsiIpmAim *aim) {
    FOR_CONES(k, i, of) {
        const int dim = of->set->dim[k];
        double *q = &of->q[i], *s = &of->s[i], *z = &of->z[i];
        if (aim->kind == CPSI_IPM_AIM_PREDICT || aim->kind == CPSI_IPM_AIM_GIVEN) {
            for (int r = 0; r < dim; r++) q[r] = aim->kind == CPSI_IPM_AIM_PREDICT ? -z[r] : 0;
            continue;
        }
        const double target = dim > 1 ? cpsi_soc_aim(aim->target, s, z) : aim->target;
        double *ds = &of->ds[i], *dz = &of->dz[i];
        if (aim->kind != CPSI_IPM_AIM_CORRECT) {
            memset(ds, 0, (size_t)dim * sizeof *ds);
            memset(dz, 0, (size_t)dim * sizeof *dz);
        }
        cpsi_cone_correct(q, dim, &of->w[i], of->g[k], s, z, ds, dz, target, of->scratch);
    }
}

/* What does not depend on du of y and of dz. */
static void set_right(CpsiConicConstraint *of, double keep) {
    const int n = of->set->unknowns, m = of->set->rows;
    double *g = of->scratch, *rest = of->rest;
    for (int j = 0; j < n; j++) of->missing[j] = keep * imbalance_of(of, j);
    solve_transposed(of, of->missing, 1);
    memcpy(of->along, of->missing, (size_t)n * sizeof *of->along);
    FOR_CONES(k, i, of) {
        const int dim = of->set->dim[k];
        cpsi_cone_power_apply(&g[i], &of->q[i], dim, &of->w[i], of->g[k], CPSI_CONE_COMPLIANCE);
        for (int r = i; r < i + dim; r++) g[r] -= keep * (value_of(of, r) - of->s[r]);
        cpsi_cone_power_apply(&rest[i], &g[i], dim, &of->w[i], of->g[k], CPSI_CONE_STIFFNESS_ROOT);
    }
    for (int l = 0; l < 2 * n; l++) { /* twice, as Q was made */
        const int j = l % n;
        double common = 0;
        for (int i = 0; i < m; i++) common += of->basis[i * n + j] * rest[i];
        for (int i = 0; i < m; i++) rest[i] -= common * of->basis[i * n + j];
        of->along[j] += common;
    }
}

/* The force on the node of these parts along the eigenvectors. */
static void turn_back(const CpsiConicConstraint *of, const double own[3], double force[3]) {
    for (int a = 0; a < 3; a++) force[a] = 0;
    for (int e = 0; e < 3; e++)
        for (int a = 0; a < 3; a++) force[a] += of->turn[3 * e + a] * own[e];
}

static void load(CpsiProgram *base, const CpsiIpmAim *aim) {
    CpsiConstraints *all = &cpsi_chain(base)->constraints;
    for (int c = 0; c < all->conic_count; c++) {
        CpsiConicConstraint *of = all->conic[c];
        double force[3];
        set_aim(of, aim);
        set_right(of, aim->keep);
        for (int e = 0; e < 3; e++) {
            double right = 0;
            for (int j = 0; j < of->set->unknowns; j++)
                right += of->reach[3 * j + e] * of->along[j];
            for (int a = 0; a < 3; a++)
                right -= of->turn[3 * e + a] * aim->keep * off_of(of, a, base->u);
            of->fixed[e] = right / of->compliance[e];
        }
        turn_back(of, of->fixed, force);
        add_to_node(of, force, base->du);
    }
}

/* df, then dv and dz, from du. Along an eigenvector in which the set gives way T is large, and dv
 * takes the part of df as it was found there: from df itself, rounding of the parts in which the
 * set is flat, of the size 1/e, would move the place. */
static void follow(CpsiConicConstraint *of, const double *du) {
    double moved[3] = {0}, own[3];
    for (int a = 0; a < 3; a++) {
        double along = 0;
        for (int x = 0; x < 3; x++) along += of->frame[a][x] * du[3 * of->node + x];
        for (int e = 0; e < 3; e++) moved[e] += of->turn[3 * e + a] * along;
    }
    for (int e = 0; e < 3; e++) own[e] = of->fixed[e] - moved[e] / of->compliance[e];
    turn_back(of, own, of->d_force);
    const int n = of->set->unknowns;
    double *turned = of->scratch;
    memcpy(turned, of->rest, (size_t)of->set->rows * sizeof *turned);
    for (int j = 0; j < n; j++) {
        double pull = 0;
        for (int e = 0; e < 3; e++) pull += of->reach[3 * j + e] * own[e];
        of->dv[j] = of->along[j] - pull;
        for (int i = 0; i < of->set->rows; i++)
            turned[i] += of->basis[i * n + j] * (pull - of->missing[j]);
    }
    solve_upper(of, of->dv);
    FOR_CONES(k, i, of)
    cpsi_cone_power_apply(&of->dz[i], &turned[i], of->set->dim[k], &of->w[i], of->g[k],
                          CPSI_CONE_STIFFNESS_ROOT);
}

static void direct(CpsiProgram *base, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiConstraints *all = &cpsi_chain(base)->constraints;
    for (int c = 0; c < all->conic_count; c++) {
        CpsiConicConstraint *of = all->conic[c];
        follow(of, base->du);
        FOR_CONES(k, i, of) {
            const int dim = of->set->dim[k];
            for (int r = i; r < i + dim; r++)
                of->ds[r] = change_of(of, r) + aim->keep * (value_of(of, r) - of->s[r]) +
                            CPSI_YIELD * of->dz[r];
            sums->inverse_step =
                cpsi_max_nan(sums->inverse_step,
                             cpsi_cone_step(dim, &of->w[i], of->g[k], &of->s[i], &of->z[i],
                                            &of->ds[i], &of->dz[i], of->scratch));
        }
    }
}

const CpsiKind cpsi_conic_constraint = {start, measure, scale, load, direct};
