/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's method on the active set (active_set.c): a node is put where its status wants it. */
#include "chain/newton.h"

void cpsi_newton_move(CpsiNewton *newton, int j, double x, double y, double z) {
    CpsiChainProgram *program = newton->program;
    CpsiSegment *st = &program->segment;
    double by[3] = {x, y, z};
    if (x == 0 && y == 0 && z == 0) return;
    for (int a = 0; a < 3; a++) program->base.u[3 * j + a] += by[a];
    cpsi_newton_to_common(program, j, by);
    for (int a = 0; a < 3; a++) {
        if (j > 0) st->s[j][1 + a] += by[a] / st->length[j];
        if (j + 1 < program->n) st->s[j + 1][1 + a] -= by[a] / st->length[j + 1];
    }
}
