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

#include "chain/conic_block.h"
#include "ipm/cones.h"

void cpsi_friction_conic_layout(CpsiFrictionConic *conic, CpsiArena *arena, int n, int most,
                                const CpsiConicSet *largest) {
    const size_t count = (size_t)most, blocks = (count + CPSI_LANES - 1) / CPSI_LANES + 1,
                 spread = (size_t)largest->spread, unknowns = (size_t)largest->unknowns;
    conic->blocks = blocks - 1;
    conic->stride = cpsi_conic_stride(largest);
    conic->index_stride = cpsi_conic_index_stride(largest);
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
    CPSI_PLACE(arena, conic->data, blocks * CPSI_LANES * conic->stride);
    CPSI_PLACE(arena, conic->index, blocks * CPSI_LANES * conic->index_stride);
    CPSI_PLACE(arena, conic->scratch, CPSI_LANES * (4 * spread + 2 * unknowns + spread * unknowns));
}

/* The block of element k; its lane is k % CPSI_LANES. */
static CpsiConicBlock block_of(const CpsiFrictionConic *conic, int k) {
    return cpsi_conic_block(conic, conic->form[k], (size_t)(k / CPSI_LANES));
}

void cpsi_friction_conic_force(const CpsiFrictionConic *conic, int k, double force[2]) {
    const CpsiConicSet *form = conic->form[k];
    const CpsiConicBlock block = block_of(conic, k);
    for (int a = 0; a < 2; a++) {
        double sum = 0;
        for (int j = 0; j < form->unknowns; j++)
            sum += form->p[a * form->unknowns + j] * block.v[j][k % CPSI_LANES];
        force[a] = form->origin[a] * conic->bound[k] + sum;
    }
}

double cpsi_friction_conic_slip(const CpsiChainProgram *program, int k) {
    const CpsiFrictionConic *conic = &program->conic;
    double u[2];
    cpsi_conic_tangential(conic, k, &program->base.u[3 * conic->node[k]], u);
    return hypot(u[0] + conic->offset[k][0], u[1] + conic->offset[k][1]);
}

double cpsi_friction_conic_margin(const CpsiFrictionConic *conic, int k) {
    const CpsiConicSet *form = conic->form[k];
    const CpsiConicBlock block = block_of(conic, k);
    const int l = k % CPSI_LANES;
    double least = INFINITY;
    CPSI_FOR_CONES(c, i, form->cones, form->dim) {
        double across = 0;
        for (int a = 1; a < form->dim[c]; a++) across += block.z[i + a][l] * block.z[i + a][l];
        least = fmin(least, block.z[i][l] - sqrt(across));
    }
    return least / conic->bound[k];
}

void cpsi_friction_conic_turn(const CpsiFrictionConic *conic, double *x) {
    for (int k = 0; k < conic->count; k++)
        cpsi_conic_turn_to(conic->turn[k], &x[3 * conic->node[k]]);
}

void cpsi_friction_conic_turn_back(CpsiFrictionConic *conic, double *du) {
    for (int k = 0; k < conic->count; k++) {
        double *x = &du[3 * conic->node[k]];
        const double back[2] = {conic->turn[k][0], -conic->turn[k][1]};
        cpsi_conic_tangential(conic, k, x, conic->du[k]);
        cpsi_conic_turn_to(back, x);
    }
}

void cpsi_friction_conic_predict_bounds(CpsiFrictionConic *conic,
                                        const CpsiUnilateral *unilateral) {
    for (int k = 0; k < conic->count; k++) {
        const CpsiConicBlock block = block_of(conic, k);
        for (int i = 0; i < block.form->rows; i++) block.q[i][k % CPSI_LANES] = 0;
        conic->shift[k] =
            conic->friction[k] * unilateral->z[conic->unilateral[k]] - conic->bound[k];
    }
}
