/* SPDX-License-Identifier: BSD-3-Clause */
/* Products with the equations and the blocks of a sparse program (see sparse_program.h). */
#include "conic/sparse_program.h"
#include "linalg/dense.h"

void cpsi_sparse_multiply(const CpsiSparseData *d, const double *x, double *out) {
    for (int i = 0; i < d->equations; i++) {
        double sum = 0;
        for (size_t e = d->start[i]; e < d->start[i + 1]; e++) sum += d->value[e] * x[d->column[e]];
        out[i] = sum;
    }
}

void cpsi_sparse_add_transposed(const CpsiSparseData *d, double factor, const double *y,
                                double *out) {
    for (int i = 0; i < d->equations; i++)
        for (size_t e = d->start[i]; e < d->start[i + 1]; e++)
            out[d->column[e]] += factor * d->value[e] * y[i];
}

/* out = A x for the blocks' unscaled matrices, or A~ x where `scaled` */
void cpsi_sparse_blocks_multiply(const CpsiSparseProgram *program, bool scaled, const double *x,
                                 double *out) {
    for (int k = 0; k < program->data.blocks; k++) {
        const CpsiBlock *block = &program->data.block[k];
        const double *a = scaled ? &program->scaled_a[program->at[k]] : block->a;
        for (int r = 0; r < block->rows; r++, a += block->unknowns)
            *out++ = cpsi_dot(block->unknowns, a, x);
        x += block->unknowns;
    }
}

/* out += factor A'z, or A~'z */
void cpsi_sparse_blocks_add(const CpsiSparseProgram *program, bool scaled, double factor,
                            const double *z, double *out) {
    for (int k = 0; k < program->data.blocks; k++) {
        const CpsiBlock *block = &program->data.block[k];
        const double *a = scaled ? &program->scaled_a[program->at[k]] : block->a;
        for (int r = 0; r < block->rows; r++, a += block->unknowns, z++)
            for (int j = 0; j < block->unknowns; j++) out[j] += factor * *z * a[j];
        out += block->unknowns;
    }
}
