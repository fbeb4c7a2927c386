/* SPDX-License-Identifier: BSD-3-Clause */
/* A quadratic field: a force -K u on every node, K symmetric >= 0 and of each node its own. It is
 * the term u'K u/2 in the energy, and needs no cone; what the force is at u = 0 is a load. */
#include "base/larger.h"
#include "chain/elements.h"

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    const CpsiChainProgram *program = cpsi_chain(base);
    (void)alpha;
    if (!program->field) return;
    for (int j = 0; j < program->n; j++) {
        double pull[3];
        cpsi_field_pull(program, j, pull);
        for (int a = 0; a < 3; a++) {
            base->residual[3 * j + a] -= pull[a];
            sums->curved += base->u[3 * j + a] * pull[a];
            sums->pulled += fabs(pull[a]);
            sums->largest = cpsi_max_nan(sums->largest, fabs(pull[a]));
        }
    }
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    if (program->field)
        for (int i = 0; i < 6 * program->n; i++) program->matrix.diagonal[i] += program->field[i];
}

/* The other passes have nothing to do: the term acts through the linear system alone. */
const CpsiKind cpsi_node_field = {.measure = measure, .scale = scale};
