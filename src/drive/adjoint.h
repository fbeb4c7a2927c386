/* SPDX-License-Identifier: BSD-3-Clause */
/* B*f: what a force of a law does to the velocity parameters, without the rounding of terms that
 * cancel. */
#ifndef CAPSTAN_SRC_DRIVE_ADJOINT_H
#define CAPSTAN_SRC_DRIVE_ADJOINT_H

#include "drive/system.h"

/* Scratch of one product, reused from law to law. */
typedef struct CpsiAdjoint {
    double *sum, *terms; /* (n) of the parameters that occur: the product, and the size of what was
                            added up; else 0 */
    int *column;         /* (count) which parameters occur */
    int count;
} CpsiAdjoint;

/* CPS_ERR_MEMORY, or room for the parameters of the system. */
CpsStatus cpsi_adjoint_new(const CpsSystem *system, CpsiAdjoint *out, CpsError *err);
void cpsi_adjoint_free(CpsiAdjoint *adjoint);

/* The largest of `count` numbers by size: what the rounding of a form's vectors is relative to. */
double cpsi_adjoint_size(size_t count, const double *a);

/* B*f of one piece for f_r = f[r*stride]: sum[column[i]] for i < count. Each f_r may be off by the
 * rounding of numbers of the given `size`: an entry that may be no more than that is exactly 0. */
void cpsi_adjoint_apply(CpsiAdjoint *adjoint, const CpsSystem *system, const CpsiPiece *piece,
                        const double *f, size_t stride, double size);

#endif
