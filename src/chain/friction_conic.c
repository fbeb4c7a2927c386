/* SPDX-License-Identifier: BSD-3-Clause */
/* Friction conic: dry friction with any planar convex set of forces, a C, C = { origin + P v : A v
 * + b in K }, K half-lines and second-order cones.
 *
 * With the variables scaled by the bound a, the force F = origin a + P v lies in a C where z = A v
 * + b a is in K, and it is the force of maximal dissipation for the slip u = o + v_xy of its node
 * when
 *
 *     A's = P'u,    s in K,    s o z = 0          s.z = a phi(u) + <u, F>,
 *         phi(u) = s.b - <u, origin>
 *
 * (the dual of max -<u, F>). Linearised, dz + H ds = q with H = g W^-2, dz = A dv + b da, A'ds =
 * P'du + r, r = P'u - A's:
 *
 *     N dv = A'H^-1 (q - b da) - P'du - r,      N = A'H^-1 A
 *     dF = c da + P N^-1 (A'H^-1 q - r) - M du,     M = P N^-1 P',     c = origin - P N^-1 A'H^-1 b
 *
 * M goes to the node's block and c, where a = friction R is coupled to the reaction of its
 * unilateral contact, to its column z as in friction_disc.c. Near a solution the entries of H^-1
 * range from mu to 1/mu. Therefore N is never formed: with B = H^-1/2 A = Q R, its rows turned to
 * the axes of W so that each has one size, dv is a least-squares solution and sqrt(H) ds its
 * residual,
 *
 *     dv = R^-1 (Q1'y - t),   sqrt(H) ds = Q (t, Q2'y),   y = H^-1/2 (q - b da),
 *         t = R^-T (P'du + r),
 *
 * which keeps A'ds = P'du + r to rounding. M = G'G with G = R^-T P' is large along a face of C and
 * of order one across while a node slides on that face. Therefore the linear system uses tangents
 * of the node that are rotated so that the columns of G are orthogonal (Jacobi), and du in these
 * axes is kept for R^-T P'du = G du: after rotating back, the small component along the face would
 * be lost in the large one. The second friction conic of a node, on another obstacle, has general
 * axes in this frame.
 *
 * The start is the analytic centre of C, where A'z^-1 = 0; there s = mu z^-1 has the residual r =
 * P'u. */
#include <string.h>

#include "base/larger.h"
#include "chain/elements.h"
#include "ipm/cone.h"
#include "ipm/cones.h"
#include "linalg/dense.h"

/* The arrays of one element inside its share of `data` and `index`. */
typedef struct Element {
    const CpsiConicSet *form;
    double *v, *dv, *r, *beta;       /* (unknowns) */
    double *pull[2];                 /* (unknowns) the columns of G in the rotated tangents */
    double *s, *z, *w, *q, *ds, *dz; /* (rows) */
    double *g;                       /* (cones) */
    double *qr;                      /* (spread, unknowns) */
    int *row, *column;               /* (spread), (unknowns) */
    int spread;                      /* rows of B */
} Element;

static Element element(const CpsiFrictionConic *conic, int k) {
    const CpsiConicSet *form = conic->form[k];
    Element e = {.form = form, .spread = form->spread};
    double *at = &conic->data[(size_t)k * conic->stride];
    double **of_unknowns[] = {&e.v, &e.dv, &e.r, &e.beta, &e.pull[0], &e.pull[1]},
           **of_rows[] = {&e.s, &e.z, &e.w, &e.q, &e.ds, &e.dz};
    for (int i = 0; i < 6; i++, at += form->unknowns) *of_unknowns[i] = at;
    for (int i = 0; i < 6; i++, at += form->rows) *of_rows[i] = at;
    e.g = at;
    e.qr = at + form->cones;
    e.row = &conic->index[(size_t)k * conic->index_stride];
    e.column = e.row + e.spread;
    return e;
}

void cpsi_friction_conic_layout(CpsiFrictionConic *conic, CpsiArena *arena, int n, int most,
                                const CpsiConicSet *largest) {
    const size_t count = (size_t)most, unknowns = (size_t)largest->unknowns,
                 rows = (size_t)largest->rows;
    const size_t spread = (size_t)largest->spread;
    conic->stride = 6 * unknowns + 6 * rows + (size_t)largest->cones + spread * unknowns;
    conic->index_stride = spread + unknowns;
    CPSI_PLACE(arena, conic->node, count);
    CPSI_PLACE(arena, conic->contact, count);
    CPSI_PLACE(arena, conic->second, count);
    CPSI_PLACE(arena, conic->unilateral, count);
    CPSI_PLACE(arena, conic->form, count);
    double **const scalars[] = {&conic->weight, &conic->friction, &conic->bound, &conic->d_bound,
                                &conic->shift};
    for (size_t i = 0; i < sizeof scalars / sizeof *scalars; i++)
        CPSI_PLACE(arena, *scalars[i], count);
    CPSI_PLACE(arena, conic->offset, count);
    CPSI_PLACE(arena, conic->tangent, count);
    CPSI_PLACE(arena, conic->turn, count);
    CPSI_PLACE(arena, conic->du, count);
    CPSI_PLACE(arena, conic->frame, 9 * (size_t)n);
    CPSI_PLACE(arena, conic->data, count * conic->stride);
    CPSI_PLACE(arena, conic->index, count * conic->index_stride);
    CPSI_PLACE(arena, conic->scratch, 4 * spread + 2 * unknowns);
}

/* ---- small products ---- */

/* Rows of B for a cone of dimension d. */
static int spread_of(int d) { return d == 1 ? 1 : d + 1; }

/* out = H^-1/2 x in the axes of W: of a second-order cone its components along (1, n), (1, -n) and
 * across, n = w1/|w1|. */
static void spread(const Element *e, const double *x, double *out) {
    for (int k = 0, i = 0, o = 0; k < e->form->cones;
         i += e->form->dim[k], o += spread_of(e->form->dim[k]), k++) {
        const int d = e->form->dim[k];
        const double by = 1 / sqrt(e->g[k]), *w = &e->w[i];
        out[o] = by * x[i];
        if (d == 1) continue;
        const double size = cpsi_norm(d - 1, w + 1), large = w[0] + size, half = sqrt(0.5);
        double along = 0;
        for (int a = 1; a < d; a++) along += (size > 0 ? w[a] / size : a == 1) * x[i + a];
        out[o] = by * half * large * (x[i] + along);
        out[o + 1] = by * half / large * (x[i] - along);
        for (int a = 1; a < d; a++)
            out[o + 1 + a] = by * (x[i + a] - (size > 0 ? w[a] / size : a == 1) * along);
    }
}

/* The transpose of `spread`. */
static void spread_transposed(const Element *e, const double *y, double *out) {
    for (int k = 0, i = 0, o = 0; k < e->form->cones;
         i += e->form->dim[k], o += spread_of(e->form->dim[k]), k++) {
        const int d = e->form->dim[k];
        const double by = 1 / sqrt(e->g[k]), *w = &e->w[i];
        out[i] = by * y[o];
        if (d == 1) continue;
        const double size = cpsi_norm(d - 1, w + 1), large = w[0] + size, half = sqrt(0.5);
        const double first = half * large * y[o], second = half / large * y[o + 1];
        double along = 0;
        for (int a = 1; a < d; a++) along += (size > 0 ? w[a] / size : a == 1) * y[o + 1 + a];
        out[i] = by * (first + second);
        for (int a = 1; a < d; a++)
            out[i + a] =
                by * (y[o + 1 + a] + (size > 0 ? w[a] / size : a == 1) * (first - second - along));
    }
}

/* out = P'u */
static void multiply_p_transposed(const CpsiConicSet *form, const double u[2], double *out) {
    for (int j = 0; j < form->unknowns; j++)
        out[j] = form->p[j] * u[0] + form->p[form->unknowns + j] * u[1];
}

/* T u, the components of u along the tangents of friction conic k. */
static void tangential(const CpsiFrictionConic *conic, int k, const double u[3], double out[2]) {
    const double *t = conic->tangent[k];
    for (int a = 0; a < 2; a++)
        out[a] = t[3 * a] * u[0] + t[3 * a + 1] * u[1] + t[3 * a + 2] * u[2];
}

/* T^T f */
static void spatial(const double t[6], const double f[2], double out[3]) {
    for (int a = 0; a < 3; a++) out[a] = t[a] * f[0] + t[3 + a] * f[1];
}

/* out += factor (origin a + P v) */
static void add_force(const CpsiConicSet *form, double factor, double a, const double *v,
                      double out[2]) {
    for (int i = 0; i < 2; i++)
        out[i] += factor *
                  (form->origin[i] * a + cpsi_dot(form->unknowns, &form->p[i * form->unknowns], v));
}

void cpsi_friction_conic_force(const CpsiFrictionConic *conic, int k, double force[2]) {
    force[0] = force[1] = 0;
    add_force(conic->form[k], 1, conic->bound[k], element(conic, k).v, force);
}

double cpsi_friction_conic_slip(const CpsiChainProgram *program, int k) {
    const CpsiFrictionConic *conic = &program->conic;
    double u[2];
    tangential(conic, k, &program->base.u[3 * conic->node[k]], u);
    return hypot(u[0] + conic->offset[k][0], u[1] + conic->offset[k][1]);
}

/* Add weight (origin a + P v) of friction conic k to its node's force. */
static void add_to_node(const CpsiFrictionConic *conic, int k, double a, const double *v,
                        double *force) {
    double f[2] = {0, 0}, here[3];
    add_force(conic->form[k], conic->weight[k], a, v, f);
    spatial(conic->tangent[k], f, here);
    for (int i = 0; i < 3; i++) force[3 * conic->node[k] + i] += here[i];
}

double cpsi_friction_conic_margin(const CpsiFrictionConic *conic, int k) {
    const Element e = element(conic, k);
    double least = INFINITY;
    CPSI_FOR_CONES(c, i, e.form->cones, e.form->dim)
        least = fmin(least, e.z[i] - cpsi_norm(e.form->dim[c] - 1, &e.z[i + 1]));
    return least / conic->bound[k];
}

/* ---- the kind ---- */

static void start(CpsiProgram *base, double mu, double margin) {
    CpsiChainProgram *program = cpsi_chain(base);
    (void)margin; /* mu and the bound fix the pair */
    CpsiFrictionConic *conic = &program->conic;
    for (int k = 0; k < conic->count; k++) {
        const Element e = element(conic, k);
        const CpsiConicSet *form = e.form;
        if (program->bounds_coupled)
            conic->bound[k] = conic->friction[k] * program->unilateral.z[conic->unilateral[k]];
        const double a = conic->bound[k];
        for (int j = 0; j < form->unknowns; j++) e.v[j] = a * form->centre[j];
        for (int i = 0; i < form->rows; i++)
            e.z[i] = a * (cpsi_dot(form->unknowns, &form->a[i * form->unknowns], form->centre) +
                          form->b[i]);
        CPSI_FOR_CONES(c, i, form->cones, form->dim) {
            const int d = form->dim[c];
            const double inverse = d == 1 ? mu / (e.z[i] * e.z[i]) : mu / cpsi_soc_det(&e.z[i], d);
            e.s[i] = inverse * e.z[i];
            for (int r = 1; r < d; r++) e.s[i + r] = -inverse * e.z[i + r];
        }
    }
}

static void measure(CpsiProgram *base, CpsiSums *sums) {
    CpsiFrictionConic *conic = &cpsi_chain(base)->conic;
    for (int k = 0; k < conic->count; k++) {
        const Element e = element(conic, k);
        const CpsiConicSet *form = e.form;
        const double weight = conic->weight[k], *x = &base->u[3 * conic->node[k]];
        double u[2];
        tangential(conic, k, x, u);
        for (int a = 0; a < 2; a++) u[a] += conic->offset[k][a];
        multiply_p_transposed(form, u, e.r);
        for (int i = 0; i < form->rows; i++)
            for (int j = 0; j < form->unknowns; j++)
                e.r[j] -= form->a[i * form->unknowns + j] * e.s[i];
        for (int j = 0; j < form->unknowns; j++)
            sums->residual = cpsi_max_nan(sums->residual, fabs(e.r[j]));
        const double phi = cpsi_dot(form->rows, e.s, form->b) - cpsi_dot(2, u, form->origin);
        sums->weight += weight * form->cones;
        sums->sz += weight * cpsi_dot(form->rows, e.s, e.z);
        sums->scale += weight * conic->bound[k] * fabs(phi);
        sums->bound += weight * conic->bound[k] * form->reach;
        add_to_node(conic, k, conic->bound[k], e.v, base->residual);
    }
}

/* B = Q R; false where B is rank-deficient to rounding. */
static bool factor(const Element *e, double *scratch) {
    const CpsiConicSet *form = e->form;
    double *column = scratch, *image = column + form->rows;
    for (int j = 0; j < form->unknowns; j++) {
        for (int i = 0; i < form->rows; i++) column[i] = form->a[i * form->unknowns + j];
        spread(e, column, image);
        for (int i = 0; i < e->spread; i++) e->qr[i * form->unknowns + j] = image[i];
    }
    return cpsi_qr_factor(e->spread, form->unknowns, e->qr, e->beta, e->row, e->column);
}

/* out (spread) = Q'H^-1/2 x */
static void project(const Element *e, const double *x, double *out, double *scratch) {
    spread(e, x, scratch);
    cpsi_qr_to(e->spread, e->form->unknowns, e->qr, e->beta, e->row, scratch, out);
}

/* Two components from the node's tangents to the rotated ones, and back. */
static void turn_to(const double turn[2], double *x) {
    const double a = x[0], b = x[1];
    x[0] = turn[0] * a - turn[1] * b;
    x[1] = turn[1] * a + turn[0] * b;
}
static void turn_from(const double turn[2], double *x) {
    turn_to((const double[2]){turn[0], -turn[1]}, x);
}

/* G in the node's own tangents. */
static void pull(const Element *e, double turn[2]) {
    const int n = e->form->unknowns;
    for (int a = 0; a < 2; a++)
        cpsi_qr_solve_transposed(n, e->qr, e->column, e->form->p + a * n, e->pull[a]);
    turn[0] = 1;
    turn[1] = 0;
}

/* Make the columns of G orthogonal by a rotation of the tangents: one-sided Jacobi rotations, which
 * keep the relative accuracy of each column. */
static void orthogonalise(const Element *e, double turn[2]) {
    const int n = e->form->unknowns;
    for (int sweep = 0; sweep < 4; sweep++) {
        const double one = cpsi_dot(n, e->pull[0], e->pull[0]),
                     second = cpsi_dot(n, e->pull[1], e->pull[1]);
        const double both = cpsi_dot(n, e->pull[0], e->pull[1]);
        if (!(fabs(both) > DBL_EPSILON * sqrt(one) * sqrt(second))) return;
        const double zeta = (second - one) / (2 * both),
                     tangent = (zeta < 0 ? -1 : 1) / (fabs(zeta) + hypot(1, zeta));
        const double by[2] = {1 / hypot(1, tangent), tangent / hypot(1, tangent)};
        for (int i = 0; i < n; i++) {
            double pair[2] = {e->pull[0][i], e->pull[1][i]};
            turn_to(by, pair);
            e->pull[0][i] = pair[0];
            e->pull[1][i] = pair[1];
        }
        turn_to(by, turn);
    }
}

/* Rotate the node's block, second direction and axes to the rotated tangents. */
static void turn_node(CpsiMatrix *matrix, int node, const double turn[2], double *frame) {
    double *diagonal = &matrix->diagonal[6 * node];
    const double c = turn[0], s = turn[1], xx = diagonal[0], xy = diagonal[1], yy = diagonal[2];
    diagonal[0] = c * c * xx - 2 * c * s * xy + s * s * yy;
    diagonal[1] = c * s * (xx - yy) + (c * c - s * s) * xy;
    diagonal[2] = s * s * xx + 2 * c * s * xy + c * c * yy;
    turn_to(turn, &diagonal[3]);
    if (matrix->second && node < matrix->n) {
        turn_to(turn, &matrix->second->row[3 * node]);
        turn_to(turn, &matrix->second->column[3 * node]);
    }
    for (int a = 0; a < 3; a++) {
        double pair[2] = {frame[a], frame[3 + a]};
        turn_to(turn, pair);
        frame[a] = pair[0];
        frame[3 + a] = pair[1];
    }
}

/* The tangents of friction conic k in the axes of the linear system. Those of a node's first conic
 * are these axes; its second conic stands directly behind the first one and uses the first one's
 * rotation. */
static void system_tangents(const CpsiFrictionConic *conic, int k, double t[6]) {
    memcpy(t, conic->tangent[k], sizeof conic->tangent[k]);
    if (!conic->second[k] || k == 0 || conic->node[k - 1] != conic->node[k]) return;
    turn_to(conic->turn[k - 1], &t[0]);
    turn_to(conic->turn[k - 1], &t[3]);
}

void cpsi_friction_conic_turn(const CpsiFrictionConic *conic, double *x) {
    for (int k = 0; k < conic->count; k++) turn_to(conic->turn[k], &x[3 * conic->node[k]]);
}

void cpsi_friction_conic_turn_back(CpsiFrictionConic *conic, double *du) {
    for (int k = 0; k < conic->count; k++) {
        double *x = &du[3 * conic->node[k]];
        tangential(conic, k, x, conic->du[k]);
        turn_from(conic->turn[k], x);
    }
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiFrictionConic *conic = &program->conic;
    double *scratch = conic->scratch;
    const size_t places = (size_t)program->n * (program->matrix.share ? 2 : 1);
    if (conic->count > 0) memcpy(conic->frame, program->frame, 9 * places * sizeof *conic->frame);
    for (int k = 0; k < conic->count; k++) {
        const Element e = element(conic, k);
        const CpsiConicSet *form = e.form;
        const int n = form->unknowns, node = conic->node[k], unilateral = conic->unilateral[k];
        const double weight = conic->weight[k];
        CPSI_FOR_CONES(c, i, form->cones, form->dim)
            e.g[c] = cpsi_cone_scale(&e.w[i], &e.s[i], &e.z[i], form->dim[c]);
        for (int i = 0; i < form->rows; i++) e.q[i] = -e.z[i];
        conic->shift[k] = 0;
        double *diagonal = &program->matrix.diagonal[6 * node], *turn = conic->turn[k], t[6];
        if (!factor(&e, scratch)) {
            diagonal[0] = NAN; /* the factorisation then fails */
            continue;
        }
        pull(&e, turn);
        if (!conic->second[k]) {
            orthogonalise(&e, turn);
            turn_node(&program->matrix, node, turn, &conic->frame[9 * node]);
        }
        system_tangents(conic, k, t);
        const double m[3] = {cpsi_dot(n, e.pull[0], e.pull[0]), cpsi_dot(n, e.pull[0], e.pull[1]),
                             cpsi_dot(n, e.pull[1], e.pull[1])};
        cpsi_add_mapped(diagonal, weight, t, m);
        if (!program->bounds_coupled) continue;
        double *image = scratch + e.spread, *v = image + e.spread,
               c[2] = {form->origin[0], form->origin[1]}, here[3];
        project(&e, form->b, image, scratch);
        cpsi_qr_solve(n, e.qr, e.column, image, v);
        add_force(form, -1, 0, v, c);
        turn_to(turn, c);
        spatial(t, c, here);
        cpsi_unilateral_couple_bound(program, unilateral, weight, conic->friction[k], here);
    }
}

/* dv, and Q' sqrt(H) ds in `image` (spread), for the residual keep r and du in the rotated tangents
 * (NULL: 0). scratch (2 spread) */
static void direction(const Element *e, double da, double keep, const double *du, double *image,
                      double *scratch) {
    const CpsiConicSet *form = e->form;
    const int n = form->unknowns;
    double *y = scratch, *t = scratch + e->spread;
    for (int i = 0; i < form->rows; i++) t[i] = e->q[i] - form->b[i] * da;
    project(e, t, image, y);
    cpsi_qr_solve_transposed(n, e->qr, e->column, e->r, t);
    for (int i = 0; i < n; i++) {
        t[i] *= keep;
        if (du) t[i] += e->pull[0][i] * du[0] + e->pull[1][i] * du[1];
        y[i] = image[i] - t[i];
        image[i] = t[i];
    }
    cpsi_qr_solve(n, e->qr, e->column, y, e->dv);
}

static void load(CpsiProgram *base, double keep) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiFrictionConic *conic = &program->conic;
    const CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < conic->count; k++) {
        const Element e = element(conic, k);
        const int i = conic->unilateral[k];
        double da = conic->shift[k], *image = conic->scratch, *rest = image + e.spread;
        if (program->bounds_coupled) da += conic->friction[k] * unilateral->dz[i];
        direction(&e, da, keep, NULL, image, rest);
        add_to_node(conic, k, da, e.dv, base->du);
    }
}

static void direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    (void)predictor; /* the corrector forms the second-order term itself */
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiFrictionConic *conic = &program->conic;
    for (int k = 0; k < conic->count; k++) {
        const Element e = element(conic, k);
        const CpsiConicSet *form = e.form;
        const int n = form->unknowns;
        double *image = conic->scratch, *rest = image + e.spread, *y = rest;
        const double da = conic->shift[k] +
                          (program->bounds_coupled
                               ? conic->friction[k] * program->unilateral.dz[conic->unilateral[k]]
                               : 0);
        direction(&e, da, keep, conic->du[k], image, rest);
        cpsi_qr_from(e.spread, n, e.qr, e.beta, e.row, image, y);
        spread_transposed(&e, y, e.ds);
        for (int i = 0; i < form->rows; i++)
            e.dz[i] = cpsi_dot(n, &form->a[i * n], e.dv) + form->b[i] * da;
        conic->d_bound[k] = da;
        CPSI_FOR_CONES(c, i, form->cones, form->dim) {
            const double step = cpsi_cone_step(form->dim[c], &e.w[i], e.g[c], &e.s[i], &e.z[i],
                                               &e.ds[i], &e.dz[i], conic->scratch);
            sums->inverse_step = cpsi_max_nan(sums->inverse_step, step);
        }
    }
}

static void aim(CpsiProgram *base, double target, bool second_order) {
    CpsiFrictionConic *conic = &cpsi_chain(base)->conic;
    for (int k = 0; k < conic->count; k++) {
        const Element e = element(conic, k);
        if (!second_order)
            for (int i = 0; i < e.form->rows; i++) e.ds[i] = e.dz[i] = 0;
        CPSI_FOR_CONES(c, i, e.form->cones, e.form->dim) {
            const int d = e.form->dim[c];
            cpsi_cone_correct(&e.q[i], d, &e.w[i], e.g[c], &e.s[i], &e.z[i], &e.ds[i], &e.dz[i],
                              d > 1 ? cpsi_soc_aim(target, &e.s[i], &e.z[i]) : target,
                              conic->scratch);
        }
    }
}

static void advance(CpsiProgram *base, double alpha) {
    CpsiFrictionConic *conic = &cpsi_chain(base)->conic;
    for (int k = 0; k < conic->count; k++) {
        const Element e = element(conic, k);
        conic->bound[k] += alpha * conic->d_bound[k];
        for (int j = 0; j < e.form->unknowns; j++) e.v[j] += alpha * e.dv[j];
        cpsi_cone_advance((size_t)e.form->rows, alpha, e.s, e.ds, e.z, e.dz);
    }
}

void cpsi_friction_conic_predict_bounds(CpsiFrictionConic *conic,
                                        const CpsiUnilateral *unilateral) {
    for (int k = 0; k < conic->count; k++) {
        const Element e = element(conic, k);
        memset(e.q, 0, (size_t)e.form->rows * sizeof *e.q);
        conic->shift[k] =
            conic->friction[k] * unilateral->z[conic->unilateral[k]] - conic->bound[k];
    }
}

const CpsiKind cpsi_friction_conic = {start, measure, scale, NULL, load, direct, aim, advance};
