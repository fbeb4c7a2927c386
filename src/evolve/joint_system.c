/* SPDX-License-Identifier: BSD-3-Clause */
/* The matrix of points and bodies (joint_system.h). */
#include "evolve/joint_system.h"

#include <stdlib.h>

/* The blocks of what a point follows: its own, or the two of its body. Returns how many. */
static int blocks_of(const CpsiPoints *points, int point, int out[2]) {
    if (point == CPSI_NO_POINT) return 0;
    const CpsPoint *given = &points->given[point];
    if (given->kind != CPS_POINT_KIND_ON_BODY) {
        out[0] = point;
        return 1;
    }
    out[0] = points->count + 2 * given->body;
    out[1] = out[0] + 1;
    return 2;
}

CpsiGraphMatrix *cpsi_joint_system(const CpsiPoints *points, const CpsiBodies *bodies, int lines) {
    const size_t most = 4 * (size_t)lines + (size_t)bodies->count;
    int(*edge)[2] = malloc((most + 1) * sizeof *edge);
    if (!edge) return NULL;
    size_t edges = 0;
    for (int i = 0; i < bodies->count; i++, edges++) {
        edge[edges][0] = points->count + 2 * i;
        edge[edges][1] = points->count + 2 * i + 1;
    }
    for (int i = 0; i < lines; i++) {
        int from[2], to[2];
        const int a = blocks_of(points, points->tie[2 * i], from),
                  b = blocks_of(points, points->tie[2 * i + 1], to);
        for (int k = 0; k < a * b; k++, edges++) {
            edge[edges][0] = from[k / b];
            edge[edges][1] = to[k % b];
        }
    }
    CpsiGraphMatrix *matrix =
        cpsi_graph_matrix_new(points->count + 2 * bodies->count, edges, (const int(*)[2])edge);
    free(edge);
    return matrix;
}
