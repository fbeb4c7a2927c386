/* SPDX-License-Identifier: BSD-3-Clause */
/* Drag: a force -d w u on every node, w the share of the line that the node stands for. It is the
 * proximal term (d/2) sum w |u|^2 in the energy, and needs no cone. */
#include "chain/elements.h"

static double weight(const CpsiChainProgram *program, int j) {
    const double before = j > 0 ? program->segment.length[j] : 0,
                 after = j + 1 < program->n ? program->segment.length[j + 1] : 0;
    return 0.5 * program->drag * (before + after);
}

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    const CpsiChainProgram *program = cpsi_chain(base);
    (void)alpha;
    (void)sums;
    if (program->drag > 0)
        for (int j = 0; j < program->n; j++)
            for (int a = 0; a < 3; a++)
                base->residual[3 * j + a] -= weight(program, j) * base->u[3 * j + a];
}

static void scale(CpsiProgram *base) {
    static const int XX = 0, YY = 2, ZZ = 5;
    CpsiChainProgram *program = cpsi_chain(base);
    if (program->drag > 0)
        for (int j = 0; j < program->n; j++) {
            double *block = &program->matrix.diagonal[6 * j];
            const double d = weight(program, j);
            block[XX] += d;
            block[YY] += d;
            block[ZZ] += d;
        }
}

/* The other passes have nothing to do: the term acts through the linear system alone. */
const CpsiKind cpsi_drag = {.measure = measure, .scale = scale};
