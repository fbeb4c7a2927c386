/* SPDX-License-Identifier: BSD-3-Clause */
/* Friction conics (friction_conic.c) in blocks of eight, whose numbers stand side by side in lanes:
 * number i of element k is data[(k/8 stride + i) 8 + k%8]. Elements of one block may have different
 * sets; each run of elements with one set is then worked on in the last block, which belongs to no
 * element, and copied back. */
#ifndef CAPSTAN_SRC_CHAIN_CONIC_BLOCK_H
#define CAPSTAN_SRC_CHAIN_CONIC_BLOCK_H

#include <string.h>

#include "base/lanes.h"
#include "chain/elements.h"

/* The arrays of the elements first + from .. first + to - 1. */
typedef struct CpsiConicBlock {
    const CpsiConicSet *form;
    int first, from, to;
    CpsiLane *v, *dv, *r;              /* (unknowns) */
    CpsiLane *pull[2];                 /* (unknowns) the columns of G in the rotated tangents */
    CpsiLane *s, *z, *w, *q, *ds, *dz; /* (rows) */
    CpsiLane *axis;                    /* (rows) the axes of W: of each second-order cone w0 + |w1|,
                                          w1/|w1| */
    CpsiLane *g, *root;                /* (cones) factor of the scaling, 1/sqrt(g) */
    CpsiLane *qr, *beta;               /* (spread, unknowns), (unknowns) B = Q R (qr_lanes.h) */
    CpsiIndexLane *row, *column;       /* (spread), (unknowns) */
} CpsiConicBlock;

/* Numbers, and indices, of an element with this set. */
static inline size_t cpsi_conic_stride(const CpsiConicSet *form) {
    const size_t unknowns = (size_t)form->unknowns;
    return (6 + (size_t)form->spread) * unknowns + 7 * (size_t)form->rows + 2 * (size_t)form->cones;
}
static inline size_t cpsi_conic_index_stride(const CpsiConicSet *form) {
    return (size_t)form->spread + (size_t)form->unknowns;
}

/* Block b, read as elements of one form. */
static inline CpsiConicBlock cpsi_conic_block(const CpsiFrictionConic *conic,
                                              const CpsiConicSet *form, size_t b) {
    CpsiConicBlock out = {.form = form};
    CpsiLane *at = (CpsiLane *)conic->data + b * conic->stride;
    CpsiIndexLane *index = (CpsiIndexLane *)conic->index + b * conic->index_stride;
    CpsiLane **const of_unknowns[] = {&out.v,       &out.dv,      &out.r,
                                      &out.pull[0], &out.pull[1], &out.beta},
                     **const of_rows[] = {&out.s,  &out.z,  &out.w,   &out.q,
                                          &out.ds, &out.dz, &out.axis};
    for (int i = 0; i < 6; i++, at += form->unknowns) *of_unknowns[i] = at;
    for (int i = 0; i < 7; i++, at += form->rows) *of_rows[i] = at;
    out.g = at;
    out.root = out.g + form->cones;
    out.qr = out.root + form->cones;
    out.row = index;
    out.column = index + form->spread;
    return out;
}

/* The run of elements from k on that is worked on together, at most to the end of its block. */
static inline CpsiConicBlock cpsi_conic_open(const CpsiFrictionConic *conic, int k) {
    const int lanes = CPSI_LANES, first = k / lanes * lanes,
              last = first + cpsi_lanes_count(conic->count - first);
    int to = k + 1;
    while (to < last && conic->form[to] == conic->form[k]) to++;
    const size_t own = (size_t)(first / lanes), spare = conic->blocks;
    const bool whole = k == first && to == last;
    CpsiConicBlock out = cpsi_conic_block(conic, conic->form[k], whole ? own : spare);
    out.first = first;
    out.from = k - first;
    out.to = to - first;
    if (whole) return out;
    const size_t size = conic->stride * CPSI_LANES, indices = conic->index_stride * CPSI_LANES;
    memcpy(&conic->data[spare * size], &conic->data[own * size], size * sizeof *conic->data);
    memcpy(&conic->index[spare * indices], &conic->index[own * indices],
           indices * sizeof *conic->index);
    return out;
}

/* Keep what has been computed. */
static inline void cpsi_conic_close(const CpsiFrictionConic *conic, const CpsiConicBlock *block) {
    const size_t own = (size_t)(block->first / CPSI_LANES), spare = conic->blocks;
    CpsiLane *data = (CpsiLane *)conic->data;
    CpsiIndexLane *index = (CpsiIndexLane *)conic->index;
    if (block->v == data + own * conic->stride) return;
    for (int l = block->from; l < block->to; l++) {
        for (size_t i = 0; i < conic->stride; i++)
            data[own * conic->stride + i][l] = data[spare * conic->stride + i][l];
        for (size_t i = 0; i < conic->index_stride; i++)
            index[own * conic->index_stride + i][l] = index[spare * conic->index_stride + i][l];
    }
}

/* T u, the components of u along the tangents of friction conic k. */
static inline void cpsi_conic_tangential(const CpsiFrictionConic *conic, int k, const double u[3],
                                         double out[2]) {
    const double *t = conic->tangent[k];
    for (int a = 0; a < 2; a++)
        out[a] = t[3 * a] * u[0] + t[3 * a + 1] * u[1] + t[3 * a + 2] * u[2];
}

/* Two components from the node's tangents to the rotated ones. */
static inline void cpsi_conic_turn_to(const double turn[2], double *x) {
    const double a = x[0], b = x[1];
    x[0] = turn[0] * a - turn[1] * b;
    x[1] = turn[1] * a + turn[0] * b;
}

#endif
