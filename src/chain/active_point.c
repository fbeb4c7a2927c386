/* SPDX-License-Identifier: BSD-3-Clause */
/* Contacts of elements in Newton's method on the active set (active_set.c).
 *
 * The point of element i between its nodes is place n + i of the program. Its status, its slip and
 * the rows of its contact are those of a node, but it moves with its element: nothing but the nodes
 * moves it, so it is pulled to where its status wants it. The force P = (F, R) that its contact has
 * on it is an unknown of the linear system (chain_system.h). -P takes the place of the force g on a
 * node, and P acts on the nodes by their shares. */
#include <string.h>

#include "chain/newton.h"

/* The point of element i, 0: it has none. */
static int point_of(const CpsiChainProgram *program, int i) {
    return program->node_frames.share[i] > 0 ? program->n + i : 0;
}

bool cpsi_newton_may_close_point(const CpsiNewton *newton, int j) {
    const CpsiChainProgram *program = newton->program;
    return !newton->frame && program->node_frames.share[j - program->n] < 1;
}

void cpsi_newton_close_point(CpsiNewton *newton, int j) {
    CpsiChainProgram *program = newton->program;
    const size_t n = (size_t)program->n;
    if (!newton->has_points) memset(&program->base.residual[3 * n], 0, 3 * n * sizeof(double));
    newton->has_points = true;
    newton->status[j] |= CPSI_CLOSED | CPSI_LANDS;
}

bool cpsi_newton_begin_point(CpsiNewton *newton, int k) {
    const CpsiUnilateral *unilateral = &newton->program->unilateral;
    const int j = unilateral->node[k];
    if (!cpsi_newton_may_close_point(newton, j)) return false;
    cpsi_newton_close_point(newton, j);
    newton->program->base.residual[3 * j + 2] = -unilateral->weight[k] * unilateral->z[k];
    return true;
}

void cpsi_newton_begin_point_friction(CpsiNewton *newton, int d) {
    const CpsiFrictionDisc *disc = &newton->program->disc;
    double *g = &newton->program->base.residual[3 * disc->node[d]];
    for (int a = 0; a < 2; a++) g[a] = -disc->weight[d] * disc->z[d][1 + a];
}

void cpsi_newton_measure_points(CpsiNewton *newton) {
    CpsiChainProgram *program = newton->program;
    double *g = program->base.residual;
    for (int i = 1; i < program->n; i++) {
        const int point = point_of(program, i);
        if (point == 0) continue;
        const double share = program->node_frames.share[i];
        double common[3], own[3];
        cpsi_chain_point_place(program, i, program->base.u);
        cpsi_frame_from(common, &program->frame[9 * point], &g[3 * point]);
        for (int j = i - 1; j <= i; j++) {
            cpsi_frame_to(own, &program->frame[9 * j], common);
            for (int a = 0; a < 3; a++) g[3 * j + a] -= (j == i ? share : 1 - share) * own[a];
        }
    }
}

void cpsi_newton_give_points(CpsiNewton *newton) {
    CpsiChainProgram *program = newton->program;
    const double *f = program->base.du;
    double *g = program->base.residual;
    for (int i = 1; i < program->n; i++)
        for (int a = 0, point = point_of(program, i); a < 3 && point > 0; a++)
            g[3 * point + a] -= f[3 * point + a];
}

void cpsi_newton_take_points(CpsiNewton *newton) {
    CpsiChainProgram *program = newton->program;
    for (int i = 1; i < program->n; i++) {
        const int point = point_of(program, i);
        if (point == 0) continue;
        const double *d = &program->matrix.diagonal[6 * point],
                     *skew = &program->matrix.skew[2 * point], *x = &program->base.du[3 * point];
        double *g = &program->base.residual[3 * point];
        g[0] += d[0] * x[0] + d[1] * x[1] + skew[0] * x[2];
        g[1] += d[1] * x[0] + d[2] * x[1] + skew[1] * x[2];
        g[2] += d[5] * x[2];
    }
}
