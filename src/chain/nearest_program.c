/* SPDX-License-Identifier: BSD-3-Clause */
/* The kind of element that the nearest point adds to a chain (nearest_program.h).
 *
 * Spring: the objective, a stiffness h/V at each node. An axis that is not free gets so large a
 * stiffness that no direction has a part along it, and its residual does not count. */
#include "chain/nearest_program.h"

#include <math.h>

#include "base/larger.h"

/* Stiffness of an axis that is not free, beside springs of order one and links of up to 1e16: the
 * remaining displacement along it is below the rounding of the others. */
static const double BLOCKED = 1e40;

static inline CpsiNearestProgram *nearest(CpsiProgram *base) { return (CpsiNearestProgram *)base; }

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    const CpsiNearestProgram *program = nearest(base);
    (void)alpha;
    for (int j = 0; j < program->chain.n; j++)
        for (int a = 0; a < 3; a++) {
            double *residual = &base->residual[3 * j + a];
            *residual = a < program->freedom[j]
                            ? *residual - program->weight[j] / program->size * base->u[3 * j + a]
                            : 0;
        }
    sums->bound +=
        1; /* a bounded dual, as friction has: the loop then takes its refinement steps */
}

static void scale(CpsiProgram *base) {
    static const int DIAGONAL[3] = {0, 2, 5};
    const CpsiNearestProgram *program = nearest(base);
    for (int j = 0; j < program->chain.n; j++)
        for (int a = 0; a < 3; a++)
            program->chain.matrix.diagonal[6 * j + DIAGONAL[a]] +=
                a < program->freedom[j] ? program->weight[j] / program->size : BLOCKED;
}

static const CpsiKind spring = {.measure = measure, .scale = scale};

void cpsi_nearest_program_layout(CpsiNearestProgram *program, CpsiArena *arena, int n, int halves,
                                 const CpsiLinsysOps *ops) {
    /* the spring comes last: it clears the residuals of axes that are not free */
    const CpsiKind *const *kinds = cpsi_chain_kinds(arena);
    program->kind[0] = kinds[CPSI_KIND_SEGMENT];
    program->kind[1] = kinds[CPSI_KIND_UNILATERAL];
    program->kind[2] = &spring;
    CpsiChainProgram *chain = &program->chain;
    *chain =
        (CpsiChainProgram){.base = {.kind = program->kind,
                                    .kind_count = sizeof program->kind / sizeof *program->kind}};
    CPSI_PLACE(arena, program->weight, n);
    CPSI_PLACE(arena, program->freedom, n);
    CPSI_PLACE(arena, chain->node_frames.frame, 9 * (size_t)n);
    CPSI_PLACE(arena, chain->node_frames.normal, halves);
    cpsi_chain_layout(chain, arena, n, halves, 0, false, false, ops);
    cpsi_chain_program_resize(chain, n, true);
}
