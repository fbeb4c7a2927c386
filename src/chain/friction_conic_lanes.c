/* SPDX-License-Identifier: BSD-3-Clause */
/* The passes of the interior-point loop over friction conics (friction_conic.c), eight side by side
 * in lanes. Compiled once per width (base/width.h). */
#include <string.h>

#include "base/larger.h"
#include "base/width.h"
#include "chain/cone_lanes.h"
#include "chain/conic_block.h"
#include "chain/qr_lanes.h"
#include "ipm/cones.h"

/* The element whose numbers stand in lane l; lanes beside the run repeat one of it. */
static inline int element_at(const CpsiConicBlock *block, int l) {
    const int last = block->to - 1, in = l < block->from ? block->from : l;
    return block->first + (in > last ? last : in);
}

static CpsiLanesQr qr_of(const CpsiConicBlock *e) {
    return (CpsiLanesQr){e->form->spread, e->form->unknowns, e->from, e->to,
                         e->qr,           e->beta,           e->row,  e->column};
}

/* ---- small products ---- */

/* out = P'u */
CPSI_LANES_FUNCTION void multiply_p_transposed(const CpsiConicSet *form, CpsiLane *restrict u,
                                               CpsiLane *restrict out) {
    const int n = form->unknowns;
    for (int j = 0; j < n; j++) {
        const double p = form->p[j], q = form->p[n + j];
        CPSI_FOR_LANES(l) out[j][l] = p * u[0][l] + q * u[1][l];
    }
}

/* out -= A's */
CPSI_LANES_FUNCTION void subtract_a_transposed(const CpsiConicSet *form, CpsiLane *restrict s,
                                               CpsiLane *restrict out) {
    const int n = form->unknowns;
    for (int i = 0; i < form->rows; i++)
        for (int j = 0; j < n; j++) {
            const double a = form->a[i * n + j];
            CPSI_FOR_LANES(l) out[j][l] -= a * s[i][l];
        }
}

/* out = A v + b a */
CPSI_LANES_FUNCTION void multiply_a(const CpsiConicSet *form, CpsiLane *restrict v,
                                    const double *restrict bound, CpsiLane *restrict out) {
    const int n = form->unknowns;
    for (int i = 0; i < form->rows; i++) {
        const double b = form->b[i];
        CpsiLane sum = {0};
        for (int j = 0; j < n; j++) {
            const double a = form->a[i * n + j];
            CPSI_FOR_LANES(l) sum[l] += a * v[j][l];
        }
        CPSI_FOR_LANES(l) out[i][l] = sum[l] + b * bound[l];
    }
}

/* out = origin a + P v */
CPSI_LANES_FUNCTION void force_of(const CpsiConicSet *form, const double *restrict bound,
                                  CpsiLane *restrict v, CpsiLane *restrict out) {
    const int n = form->unknowns;
    for (int i = 0; i < 2; i++) {
        const double origin = form->origin[i];
        CpsiLane sum = {0};
        for (int j = 0; j < n; j++) {
            const double p = form->p[i * n + j];
            CPSI_FOR_LANES(l) sum[l] += p * v[j][l];
        }
        CPSI_FOR_LANES(l) out[i][l] = origin * bound[l] + sum[l];
    }
}

/* sum of x_i y_i */
CPSI_LANES_FUNCTION void product(int n, CpsiLane *restrict x, CpsiLane *restrict y,
                                 double *restrict out) {
    CpsiLane sum = {0};
    for (int i = 0; i < n; i++) CPSI_FOR_LANES(l) sum[l] += x[i][l] * y[i][l];
    CPSI_FOR_LANES(l) out[l] = sum[l];
}

/* Rows of B for a cone of dimension d. */
static inline int spread_of(int d) { return d == 1 ? 1 : d + 1; }

/* One cone of `spread`: along (1, n), (1, -n) and across. */
CPSI_LANES_FUNCTION void spread_cone(int d, const double *restrict root, CpsiLane *restrict axis,
                                     CpsiLane *restrict x, CpsiLane *restrict out) {
    const double half = sqrt(0.5);
    CpsiLane along = {0};
    for (int a = 1; a < d; a++) CPSI_FOR_LANES(l) along[l] += axis[a][l] * x[a][l];
    CPSI_FOR_LANES(l) {
        const double by = root[l], large = axis[0][l];
        out[0][l] = by * half * large * (x[0][l] + along[l]);
        out[1][l] = by * half / large * (x[0][l] - along[l]);
    }
    for (int a = 1; a < d; a++)
        CPSI_FOR_LANES(l) out[1 + a][l] = root[l] * (x[a][l] - axis[a][l] * along[l]);
}

/* ... and of its transpose. */
CPSI_LANES_FUNCTION void gather_cone(int d, const double *restrict root, CpsiLane *restrict axis,
                                     CpsiLane *restrict y, CpsiLane *restrict out) {
    const double half = sqrt(0.5);
    CpsiLane along = {0}, rest;
    for (int a = 1; a < d; a++) CPSI_FOR_LANES(l) along[l] += axis[a][l] * y[1 + a][l];
    CPSI_FOR_LANES(l) {
        const double large = axis[0][l], first = half * large * y[0][l],
                     second = half / large * y[1][l];
        out[0][l] = root[l] * (first + second);
        rest[l] = first - second - along[l];
    }
    for (int a = 1; a < d; a++)
        CPSI_FOR_LANES(l) out[a][l] = root[l] * (y[1 + a][l] + axis[a][l] * rest[l]);
}

CPSI_LANES_FUNCTION void multiply(const double *restrict by, const double *restrict x,
                                  double *restrict out) {
    CPSI_FOR_LANES(l) out[l] = by[l] * x[l];
}

/* out = H^-1/2 x in the axes of W */
static void spread(const CpsiConicBlock *e, CpsiLane *x, CpsiLane *out) {
    for (int k = 0, i = 0, o = 0; k < e->form->cones;
         i += e->form->dim[k], o += spread_of(e->form->dim[k]), k++) {
        const int d = e->form->dim[k];
        if (d == 1)
            multiply(e->root[k], x[i], out[o]);
        else
            spread_cone(d, e->root[k], &e->axis[i], &x[i], &out[o]);
    }
}

/* The transpose of `spread`. */
static void spread_transposed(const CpsiConicBlock *e, CpsiLane *y, CpsiLane *out) {
    for (int k = 0, i = 0, o = 0; k < e->form->cones;
         i += e->form->dim[k], o += spread_of(e->form->dim[k]), k++) {
        const int d = e->form->dim[k];
        if (d == 1)
            multiply(e->root[k], y[o], out[i]);
        else
            gather_cone(d, e->root[k], &e->axis[i], &y[o], &out[i]);
    }
}

/* ---- the passes ---- */

static CpsiLane *scratch_of(const CpsiFrictionConic *conic) { return (CpsiLane *)conic->scratch; }

/* Add the force f on the tangents of friction conic k to its node, by its weight. */
static void add_to_node(const CpsiFrictionConic *conic, int k, double x, double y, double *force) {
    const double *t = conic->tangent[k], f[2] = {conic->weight[k] * x, conic->weight[k] * y};
    for (int a = 0; a < 3; a++) force[3 * conic->node[k] + a] += t[a] * f[0] + t[3 + a] * f[1];
}

/* The start of element k in lane l: the analytic centre of its set. */
static void start_element(const CpsiConicBlock *e, int l, double bound, double mu,
                          double *scratch) {
    const CpsiConicSet *form = e->form;
    const int n = form->unknowns;
    for (int j = 0; j < n; j++) e->v[j][l] = bound * form->centre[j];
    for (int i = 0; i < form->rows; i++) {
        double sum = 0;
        for (int j = 0; j < n; j++) sum += form->a[i * n + j] * form->centre[j];
        e->z[i][l] = bound * (sum + form->b[i]);
    }
    CPSI_FOR_CONES(c, i, form->cones, form->dim) {
        const int d = form->dim[c];
        cpsi_lanes_take(d, &e->z[i], l, scratch);
        const double inverse =
            d == 1 ? mu / (scratch[0] * scratch[0]) : mu / cpsi_soc_det(scratch, d);
        e->s[i][l] = inverse * scratch[0];
        for (int r = 1; r < d; r++) e->s[i + r][l] = -inverse * scratch[r];
    }
}

static void start(CpsiProgram *base, double mu, double margin) {
    CpsiChainProgram *program = cpsi_chain(base);
    (void)margin; /* mu and the bound fix the pair */
    CpsiFrictionConic *conic = &program->conic;
    for (int k = 0; k < conic->count;) {
        const CpsiConicBlock e = cpsi_conic_open(conic, k);
        for (; k < e.first + e.to; k++) {
            if (program->bounds_coupled)
                conic->bound[k] = conic->friction[k] * program->unilateral.z[conic->unilateral[k]];
            start_element(&e, k - e.first, conic->bound[k], mu, conic->scratch);
        }
        cpsi_conic_close(conic, &e);
    }
}

/* x += alpha dx */
CPSI_LANES_FUNCTION void add_scaled(int n, double alpha, CpsiLane *restrict dx,
                                    CpsiLane *restrict x) {
    for (int i = 0; i < n; i++) CPSI_FOR_LANES(l) x[i][l] += alpha * dx[i][l];
}

static void advance(CpsiFrictionConic *conic, const CpsiConicBlock *e, double alpha) {
    add_scaled(e->form->unknowns, alpha, e->dv, e->v);
    add_scaled(e->form->rows, alpha, e->ds, e->s);
    add_scaled(e->form->rows, alpha, e->dz, e->z);
    for (int k = e->first + e->from; k < e->first + e->to; k++)
        conic->bound[k] += alpha * conic->d_bound[k];
}

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    CpsiFrictionConic *conic = &cpsi_chain(base)->conic;
    for (int k = 0; k < conic->count;) {
        const CpsiConicBlock e = cpsi_conic_open(conic, k);
        const CpsiConicSet *form = e.form;
        CpsiLane u[2], force[2], bound, sz;
        if (alpha != 0) advance(conic, &e, alpha);
        CPSI_FOR_LANES(l) {
            const int at = element_at(&e, l);
            double x[2];
            cpsi_conic_tangential(conic, at, &base->u[3 * conic->node[at]], x);
            for (int a = 0; a < 2; a++) u[a][l] = x[a] + conic->offset[at][a];
            bound[l] = conic->bound[at];
        }
        multiply_p_transposed(form, u, e.r);
        subtract_a_transposed(form, e.s, e.r);
        product(form->rows, e.s, e.z, sz);
        force_of(form, bound, e.v, force);
        for (; k < e.first + e.to; k++) {
            const int l = k - e.first;
            const double weight = conic->weight[k];
            double phi = 0;
            for (int j = 0; j < form->unknowns; j++)
                sums->residual = cpsi_max_nan(sums->residual, fabs(e.r[j][l]));
            for (int i = 0; i < form->rows; i++) phi += e.s[i][l] * form->b[i];
            phi -= u[0][l] * form->origin[0] + u[1][l] * form->origin[1];
            sums->weight += weight * form->cones;
            sums->sz += weight * sz[l];
            sums->scale += weight * bound[l] * fabs(phi);
            sums->bound += weight * bound[l] * form->reach;
            add_to_node(conic, k, force[0][l], force[1][l], base->residual);
        }
        cpsi_conic_close(conic, &e);
    }
}

/* The same n numbers in every lane. */
static void fill_lanes(int n, const double *x, int stride, CpsiLane *out) {
    for (int i = 0; i < n; i++) {
        const double number = x[i * stride];
        CPSI_FOR_LANES(l) out[i][l] = number;
    }
}

/* B = Q R */
static void factor(CpsiConicBlock *e, bool singular[CPSI_LANES], CpsiLane *scratch) {
    const CpsiConicSet *form = e->form;
    CpsiLane *column = scratch, *image = column + form->rows;
    for (int j = 0; j < form->unknowns; j++) {
        fill_lanes(form->rows, &form->a[j], form->unknowns, column);
        spread(e, column, image);
        for (int i = 0; i < form->spread; i++)
            memcpy(e->qr[i * form->unknowns + j], image[i], sizeof *image);
    }
    CpsiLanesQr qr = qr_of(e);
    cpsi_lanes_qr_factor(&qr, singular, scratch);
}

/* out (spread) = Q'H^-1/2 x; scratch (spread) */
static void project(const CpsiConicBlock *e, CpsiLane *x, CpsiLane *out, CpsiLane *scratch) {
    const CpsiLanesQr qr = qr_of(e);
    spread(e, x, scratch);
    cpsi_lanes_permute(&qr, qr.m, qr.row, scratch, out);
    cpsi_lanes_qr_to(&qr, out);
}

/* Rotate the columns of G so that they are orthogonal, where they are not (one-sided Jacobi
 * rotation); m is G'G. */
CPSI_LANES_FUNCTION void rotate(int n, const double *restrict m, CpsiLane *restrict one,
                                CpsiLane *restrict two, double *restrict cosine,
                                double *restrict sine) {
    CPSI_FOR_LANES(l) {
        const double xx = m[l], xy = m[CPSI_LANES + l], yy = m[2 * CPSI_LANES + l];
        const double zeta = (yy - xx) / (2 * xy), side = zeta < 0 ? -1.0 : 1.0,
                     tangent = side / (fabs(zeta) + sqrt(1 + zeta * zeta)),
                     by = 1 / sqrt(1 + tangent * tangent);
        const double least = DBL_EPSILON * sqrt(xx) * sqrt(yy);
        const bool turns = fabs(xy) > least;
        cosine[l] = turns ? by : 1;
        sine[l] = turns ? tangent * by : 0;
    }
    for (int i = 0; i < n; i++) CPSI_FOR_LANES(l) {
            const double x = one[i][l], y = two[i][l];
            one[i][l] = cosine[l] * x - sine[l] * y;
            two[i][l] = cosine[l] * y + sine[l] * x;
        }
}

/* G'G as xx, xy, yy. */
CPSI_LANES_FUNCTION void square(int n, CpsiLane *restrict one, CpsiLane *restrict two,
                                CpsiLane *restrict m) {
    CpsiLane xx = {0}, xy = {0}, yy = {0};
    for (int i = 0; i < n; i++) CPSI_FOR_LANES(l) {
            xx[l] += one[i][l] * one[i][l];
            xy[l] += one[i][l] * two[i][l];
            yy[l] += two[i][l] * two[i][l];
        }
    CPSI_FOR_LANES(l) {
        m[0][l] = xx[l];
        m[1][l] = xy[l];
        m[2][l] = yy[l];
    }
}

/* Make the columns of G orthogonal by a rotation of the tangents, which keeps the relative accuracy
 * of each column; not those of second contacts. */
static void orthogonalise(const CpsiFrictionConic *conic, const CpsiConicBlock *e) {
    for (int sweep = 0; sweep < 4; sweep++) {
        CpsiLane m[3], cosine, sine;
        bool all = true;
        square(e->form->unknowns, e->pull[0], e->pull[1], m);
        for (int l = e->from; l < e->to; l++) {
            const bool second = conic->second[e->first + l];
            if (second) m[1][l] = 0;
            all = all && !(fabs(m[1][l]) > DBL_EPSILON * sqrt(m[0][l]) * sqrt(m[2][l]));
        }
        if (all) return;
        rotate(e->form->unknowns, m[0], e->pull[0], e->pull[1], cosine, sine);
        for (int l = e->from; l < e->to; l++) {
            const double by[2] = {cosine[l], sine[l]};
            cpsi_conic_turn_to(by, conic->turn[e->first + l]);
        }
    }
}

/* Rotate the node's block, second direction and axes to the rotated tangents. */
static void turn_node(CpsiMatrix *matrix, int node, const double turn[2], double *frame) {
    double *diagonal = &matrix->diagonal[6 * node];
    const double c = turn[0], s = turn[1], xx = diagonal[0], xy = diagonal[1], yy = diagonal[2];
    diagonal[0] = c * c * xx - 2 * c * s * xy + s * s * yy;
    diagonal[1] = c * s * (xx - yy) + (c * c - s * s) * xy;
    diagonal[2] = s * s * xx + 2 * c * s * xy + c * c * yy;
    cpsi_conic_turn_to(turn, &diagonal[3]);
    if (matrix->second && node < matrix->n) {
        cpsi_conic_turn_to(turn, &matrix->second->row[3 * node]);
        cpsi_conic_turn_to(turn, &matrix->second->column[3 * node]);
    }
    for (int a = 0; a < 3; a++) {
        double pair[2] = {frame[a], frame[3 + a]};
        cpsi_conic_turn_to(turn, pair);
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
    cpsi_conic_turn_to(conic->turn[k - 1], &t[0]);
    cpsi_conic_turn_to(conic->turn[k - 1], &t[3]);
}

/* c = origin - P N^-1 A'H^-1 b, in the tangents of the nodes; scratch (2 spread + unknowns) */
static void coupling(const CpsiConicBlock *e, CpsiLane c[2], CpsiLane *scratch) {
    const CpsiConicSet *form = e->form;
    const int n = form->unknowns;
    const CpsiLanesQr qr = qr_of(e);
    CpsiLane *image = scratch, *rest = image + form->spread, *v = rest + form->spread, none = {0};
    fill_lanes(form->rows, form->b, 1, image);
    project(e, image, v, rest);
    cpsi_lanes_qr_solve(n, e->qr, v);
    cpsi_lanes_permute_back(&qr, n, qr.column, v, rest);
    force_of(form, none, rest, c);
    for (int a = 0; a < 2; a++)
        for (int l = 0; l < CPSI_LANES; l++) c[a][l] = form->origin[a] - c[a][l];
}

/* The scaling of all cones, and B = Q R. */
static void scale_block(CpsiConicBlock *e, bool singular[CPSI_LANES], CpsiLane *scratch) {
    const CpsiConicSet *form = e->form;
    CPSI_FOR_CONES(c, i, form->cones, form->dim) {
        scale_cone(e, cone_of(e, c, i), form->dim[c], scratch[0]);
        axes_of(form->dim[c], &e->w[i], e->g[c], &e->axis[i], e->root[c]);
    }
    for (int i = 0; i < form->rows; i++) CPSI_FOR_LANES(l) e->q[i][l] = -e->z[i][l];
    factor(e, singular, scratch);
}

/* Add friction conic k, in lane l, to the matrix. */
static void add_to_matrix(CpsiChainProgram *program, int k, const double m[3], double cx,
                          double cy) {
    const CpsiFrictionConic *conic = &program->conic;
    const double weight = conic->weight[k];
    double t[6], c[2] = {cx, cy}, here[3];
    system_tangents(conic, k, t);
    cpsi_add_mapped(&program->matrix.diagonal[6 * conic->node[k]], weight, t, m);
    if (!program->bounds_coupled) return;
    cpsi_conic_turn_to(conic->turn[k], c);
    for (int a = 0; a < 3; a++) here[a] = t[a] * c[0] + t[3 + a] * c[1];
    cpsi_unilateral_couple_bound(program, conic->unilateral[k], weight, conic->friction[k], here);
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiFrictionConic *conic = &program->conic;
    CpsiLane *scratch = scratch_of(conic);
    const size_t places = (size_t)program->n * (program->matrix.share ? 2 : 1);
    if (conic->count > 0) memcpy(conic->frame, program->frame, 9 * places * sizeof *conic->frame);
    for (int k = 0; k < conic->count;) {
        CpsiConicBlock e = cpsi_conic_open(conic, k);
        const CpsiConicSet *form = e.form;
        const CpsiLanesQr qr = qr_of(&e);
        bool singular[CPSI_LANES];
        CpsiLane m[3], c[2] = {{0}};
        scale_block(&e, singular, scratch);
        for (int a = 0; a < 2; a++) {
            fill_lanes(form->unknowns, form->p + a * form->unknowns, 1, scratch);
            cpsi_lanes_permute(&qr, form->unknowns, qr.column, scratch, e.pull[a]);
            cpsi_lanes_qr_solve_transposed(form->unknowns, e.qr, e.pull[a]);
        }
        for (int l = e.from; l < e.to; l++) {
            conic->shift[e.first + l] = 0;
            conic->turn[e.first + l][0] = 1;
            conic->turn[e.first + l][1] = 0;
        }
        orthogonalise(conic, &e);
        square(form->unknowns, e.pull[0], e.pull[1], m);
        if (program->bounds_coupled) coupling(&e, c, scratch);
        for (; k < e.first + e.to; k++) {
            const int l = k - e.first, node = conic->node[k];
            const double here[3] = {m[0][l], m[1][l], m[2][l]};
            if (singular[l]) {
                program->matrix.diagonal[6 * node] = NAN; /* the factorisation then fails */
                continue;
            }
            if (!conic->second[k])
                turn_node(&program->matrix, node, conic->turn[k], &conic->frame[9 * node]);
            add_to_matrix(program, k, here, c[0][l], c[1][l]);
        }
        cpsi_conic_close(conic, &e);
    }
}

/* t = q - b da */
CPSI_LANES_FUNCTION void right_hand_side(const CpsiConicSet *form, CpsiLane *restrict q,
                                         const double *restrict da, CpsiLane *restrict t) {
    for (int i = 0; i < form->rows; i++) {
        const double b = form->b[i];
        CPSI_FOR_LANES(l) t[i][l] = q[i][l] - b * da[l];
    }
}

/* t = keep t + G du, y = image - t, image = t */
CPSI_LANES_FUNCTION void split(int n, double keep, CpsiLane *restrict one, CpsiLane *restrict two,
                               CpsiLane *restrict du, CpsiLane *restrict t,
                               CpsiLane *restrict image, CpsiLane *restrict y) {
    for (int i = 0; i < n; i++) CPSI_FOR_LANES(l) {
            const double x = keep * t[i][l] + (one[i][l] * du[0][l] + two[i][l] * du[1][l]);
            y[i][l] = image[i][l] - x;
            image[i][l] = x;
        }
}

/* dv, and Q' sqrt(H) ds in `image` (spread), for the residual keep r and du in the rotated
 * tangents. scratch (2 spread) */
static void direction(const CpsiConicBlock *e, CpsiLane da, double keep, CpsiLane *du,
                      CpsiLane *image, CpsiLane *scratch) {
    const int n = e->form->unknowns;
    const CpsiLanesQr qr = qr_of(e);
    CpsiLane *y = scratch, *t = scratch + e->form->spread;
    right_hand_side(e->form, e->q, da, t);
    project(e, t, image, y);
    cpsi_lanes_permute(&qr, n, qr.column, e->r, t);
    cpsi_lanes_qr_solve_transposed(n, e->qr, t);
    split(n, keep, e->pull[0], e->pull[1], du, t, image, y);
    cpsi_lanes_qr_solve(n, e->qr, y);
    cpsi_lanes_permute_back(&qr, n, qr.column, y, e->dv);
}

/* The direction of the bound in each lane. */
static void bound_directions(const CpsiChainProgram *program, const CpsiConicBlock *e,
                             CpsiLane da) {
    const CpsiFrictionConic *conic = &program->conic;
    CPSI_FOR_LANES(l) {
        const int at = element_at(e, l);
        da[l] = conic->shift[at];
        if (program->bounds_coupled)
            da[l] += conic->friction[at] * program->unilateral.dz[conic->unilateral[at]];
    }
}

/* q of the aim; `scale` has computed that of the predictor. */
static void aim_block(const CpsiConicBlock *e, const CpsiIpmAim *aim, double *scratch) {
    const CpsiConicSet *form = e->form;
    if (aim->kind == CPSI_IPM_AIM_PREDICT || aim->kind == CPSI_IPM_AIM_GIVEN) return;
    if (aim->kind == CPSI_IPM_AIM_CENTRE)
        for (int i = 0; i < form->rows; i++) CPSI_FOR_LANES(l) e->ds[i][l] = e->dz[i][l] = 0;
    CPSI_FOR_CONES(c, i, form->cones, form->dim)
        correct_cone(e, cone_of(e, c, i), form->dim[c], aim->target, scratch);
}

static void load(CpsiProgram *base, const CpsiIpmAim *aim) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiFrictionConic *conic = &program->conic;
    for (int k = 0; k < conic->count;) {
        const CpsiConicBlock e = cpsi_conic_open(conic, k);
        CpsiLane da, none[2] = {{0}}, force[2], *image = scratch_of(conic);
        aim_block(&e, aim, conic->scratch);
        bound_directions(program, &e, da);
        direction(&e, da, aim->keep, none, image, image + e.form->spread);
        force_of(e.form, da, e.dv, force);
        for (; k < e.first + e.to; k++)
            add_to_node(conic, k, force[0][k - e.first], force[1][k - e.first], base->du);
        cpsi_conic_close(conic, &e);
    }
}

static void direct(CpsiProgram *base, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiFrictionConic *conic = &program->conic;
    for (int k = 0; k < conic->count;) {
        const CpsiConicBlock e = cpsi_conic_open(conic, k);
        const CpsiConicSet *form = e.form;
        const CpsiLanesQr qr = qr_of(&e);
        CpsiLane da, du[2], inverse = {0}, *image = scratch_of(conic), *y = image + form->spread;
        bound_directions(program, &e, da);
        CPSI_FOR_LANES(l)
        for (int a = 0; a < 2; a++) du[a][l] = conic->du[element_at(&e, l)][a];
        direction(&e, da, aim->keep, du, image, y);
        cpsi_lanes_qr_from(&qr, image);
        cpsi_lanes_permute_back(&qr, form->spread, qr.row, image, y);
        spread_transposed(&e, y, e.ds);
        multiply_a(form, e.dv, da, e.dz);
        CPSI_FOR_CONES(c, i, form->cones, form->dim)
            step_cone(&e, cone_of(&e, c, i), form->dim[c], inverse, image[0]);
        for (; k < e.first + e.to; k++) {
            conic->d_bound[k] = da[k - e.first];
            sums->inverse_step = cpsi_max_nan(sums->inverse_step, inverse[k - e.first]);
        }
        cpsi_conic_close(conic, &e);
    }
}

const CpsiKind CPSI_WIDE(cpsi_friction_conic) = {start, measure, scale, load, direct};
