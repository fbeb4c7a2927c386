/* SPDX-License-Identifier: BSD-3-Clause */
/* B*f: the generalised force of a law's force on the velocity parameters, without the rounding of
 * terms that cancel. */
#ifndef CAPSTAN_SRC_DRIVE_ADJOINT_H
#define CAPSTAN_SRC_DRIVE_ADJOINT_H

#include "drive/system.h"

/* Scratch of one product, reused for every law. */
typedef struct CpsiAdjoint {
    /* (n) of the parameters that occur: the product, and the size of its terms; else 0 */
    double *sum, *terms;
    int *column; /* (count) the parameters that occur */
    int count;
} CpsiAdjoint;

/* CPS_ERR_MEMORY, or memory for the parameters of the system. */
CpsStatus cpsi_adjoint_new(const CpsSystem *system, CpsiAdjoint *out, CpsError *err);
void cpsi_adjoint_free(CpsiAdjoint *adjoint);

/* The largest absolute value of `count` numbers, with which the rounding of a form's vectors
 * scales. */
double cpsi_adjoint_size(size_t count, const double *a);

/* B*f of one piece for f_r = f[r*stride]: sum[column[i]] for i < count. Each f_r may have the
 * rounding error of numbers of the given `size`. An entry that may be only that error is set to
 * exactly 0. */
void cpsi_adjoint_apply(CpsiAdjoint *adjoint, const CpsSystem *system, const CpsiPiece *piece,
                        const double *f, size_t stride, double size);

#endif
