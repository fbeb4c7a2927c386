/* SPDX-License-Identifier: BSD-3-Clause */
/* The matrix of points and bodies, dense and sparse, on random graphs: solutions chosen beforehand
 * are found again, of all blocks and of some of them; and how a factor of a net grows. */
#include "linalg/graph_matrix.h"

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "splitmix.h"

enum { MOST = 420, EDGES = 4 * MOST, CASES = 40 };

typedef struct Graph {
    int n, edges, edge[EDGES][2];
} Graph;

static int whole(uint64_t *state, int low, int high) {
    return (int)floor(splitmix(state, low, high + 1));
}

static void add(Graph *graph, int a, int b) {
    graph->edge[graph->edges][0] = a;
    graph->edge[graph->edges++][1] = b;
}

/* A tree with a few more edges, a net, or a net with a hub that has an edge to a third of all; some
 * edges twice, some to no block, some from a block to itself. */
static void make(Graph *graph, uint64_t *state) {
    const int kind = whole(state, 0, 2), side = whole(state, 2, 20);
    *graph = (Graph){.n = kind == 0 ? whole(state, 1, MOST - 1) : side * side};
    if (kind == 0) {
        for (int i = 1; i < graph->n; i++) add(graph, whole(state, 0, i - 1), i);
        for (int i = 0; i < graph->n / 4; i++) {
            const int to = whole(state, 0, graph->n - 1);
            add(graph, whole(state, 0, graph->n - 1), to);
        }
    } else {
        for (int i = 0; i < graph->n; i++) {
            if (i % side > 0) add(graph, i, i - 1);
            if (i >= side) add(graph, i - side, i);
        }
    }
    if (kind == 2) {
        for (int i = 0; i < graph->n; i += 3) add(graph, graph->n, i);
        graph->n++;
    }
    add(graph, -1, 0);
}

/* A value of a block: those on the diagonal outweigh the others of their row; the columns of the
 * third axis are up to `stiff` times as large, as of an obstacle's normal. */
static double value(uint64_t *state, bool diagonal, int a, int b, double stiff) {
    const double any = splitmix(state, -1, 1);
    if (!diagonal) return any / 10;
    return a != b ? any : a == 2 ? stiff : 1000 + any;
}

/* Set the blocks of the `used` (count) and their right-hand side for the solution x (count, 3). */
static void fill(CpsiGraphMatrix *matrix, const Graph *graph, int count, const int *used,
                 const double *x, double *right, uint64_t *state) {
    int number[MOST + 1];
    for (int i = 0; i < graph->n; i++) number[i] = -1;
    for (int k = 0; k < count; k++) number[used[k]] = k;
    memset(right, 0, 3 * (size_t)count * sizeof *right);
    cpsi_graph_matrix_clear(matrix);
    for (int e = 0; e < graph->edges + count; e++) {
        const bool own = e >= graph->edges;
        const int *edge = graph->edge[own ? 0 : e];
        if (!own && (edge[0] < 0 || edge[0] == edge[1])) continue;
        const int i = own ? e - graph->edges : number[edge[0]], j = own ? i : number[edge[1]];
        if (i < 0 || j < 0) continue;
        const double stiff = pow(10, splitmix(state, 3, 12));
        for (int turn = 0; turn < (own ? 1 : 2); turn++) {
            const int row = turn ? j : i, column = turn ? i : j;
            const CpsiGraphBlock block = cpsi_graph_matrix_block(matrix, row, column);
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++) {
                    const double v = value(state, own, a, b, stiff);
                    block.at[(size_t)a * block.stride + (size_t)b] += v;
                    right[3 * row + a] += v * x[3 * column + b];
                }
        }
    }
}

static void mix(int *number, int count, uint64_t *state) {
    for (int i = count - 1; i > 0; i--) {
        const int k = whole(state, 0, i), kept = number[i];
        number[i] = number[k];
        number[k] = kept;
    }
}

static void solutions_are_found_again(void **unused) {
    (void)unused;
    for (uint64_t seed = 0; seed < CASES; seed++) {
        static Graph graph;
        static double x[3 * MOST + 3], right[3 * MOST + 3];
        uint64_t state = seed;
        make(&graph, &state);
        CpsiGraphMatrix *matrix =
            cpsi_graph_matrix_new(graph.n, (size_t)graph.edges, (const int(*)[2])graph.edge);
        assert_non_null(matrix);
        /* all blocks, then some, in any order, then all once more */
        for (int pass = 0; pass < 3; pass++) {
            int used[MOST + 1], count = 0;
            for (int i = 0; i < graph.n; i++)
                if (pass != 1 || splitmix(&state, 0, 1) < 0.6) used[count++] = i;
            if (pass == 1) mix(used, count, &state);
            cpsi_graph_matrix_use(matrix, count, used);
            for (int i = 0; i < 3 * count; i++) x[i] = splitmix(&state, -1, 1);
            fill(matrix, &graph, count, used, x, right, &state);
            assert_true(cpsi_graph_matrix_factor(matrix));
            cpsi_graph_matrix_solve(matrix, right);
            /* rows outweigh their columns, so no more than a few hundred roundings meet; what the
             * stiffest column brings to a row of order 1000 is 1e-16 of 1e12 */
            for (int i = 0; i < 3 * count; i++) CHECK_NEAR(right[i], x[i], 1e-12);
        }
        cpsi_graph_matrix_free(matrix);
    }
}

/* Rows that are turned, fixed and added to by maps, against the same done on a full matrix. */
static void rows_are_changed_as_asked(void **unused) {
    (void)unused;
    for (int n = 99; n <= 102; n += 3) { /* dense, and sparse */
        int edge[101][2], used[102];
        for (int i = 0; i < n; i++) used[i] = i;
        for (int i = 0; i + 1 < n; i++) {
            edge[i][0] = i;
            edge[i][1] = i + 1;
        }
        CpsiGraphMatrix *matrix = cpsi_graph_matrix_new(n, (size_t)n - 1, (const int(*)[2])edge);
        assert_non_null(matrix);
        cpsi_graph_matrix_use(matrix, n, used);
        cpsi_graph_matrix_clear(matrix);
        /* a body of blocks 1 and 2 and a point of block 3; K = [1 2 3; 4 5 6; 7 8 9] */
        const double k[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
        const CpsiJointMap body = cpsi_joint_map_on_body(3, vec3(0, 0, 2)),
                           point = cpsi_joint_map_of_point(9);
        cpsi_graph_matrix_add(matrix, &body, &point, k, 3);
        /* about y the point 2 above moves along x by 2, about x along y by -2: rows 4 and 3 of the
         * body, the second and the first of block 2, are so many times rows 0 and 1 of K */
        const CpsiGraphBlock block = cpsi_graph_matrix_block(matrix, 2, 3);
        for (size_t b = 0; b < 3; b++) {
            CHECK_NEAR(block.at[block.stride + b], 2 * k[b], 0);
            CHECK_NEAR(block.at[b], -2 * k[3 + b], 0);
        }
        const double p[3][3] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
        cpsi_graph_matrix_turn(matrix, 2, p);
        for (size_t b = 0; b < 3; b++) CHECK_NEAR(block.at[b], 2 * k[b], 0);
        cpsi_graph_matrix_fix(matrix, 2, 0);
        for (size_t b = 0; b < 3; b++) CHECK_NEAR(block.at[b], 0, 0);
        const CpsiGraphBlock own = cpsi_graph_matrix_block(matrix, 2, 2);
        for (size_t b = 0; b < 3; b++) CHECK_NEAR(own.at[b], b == 0, 0);
        /* all other rows are empty */
        assert_false(cpsi_graph_matrix_factor(matrix));
        cpsi_graph_matrix_free(matrix);
    }
}

/* Pairs of blocks in the factor of a net of side x side. */
static double size_of_net(int side) {
    const int n = side * side;
    int(*edge)[2] = malloc(2 * (size_t)n * sizeof *edge), edges = 0;
    assert_non_null(edge);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < 2; k++) {
            if (k == 0 ? i % side == 0 : i < side) continue;
            edge[edges][0] = i;
            edge[edges++][1] = k == 0 ? i - 1 : i - side;
        }
    }
    CpsiBlockLu *lu = cpsi_block_lu_new(n, (size_t)edges, (const int(*)[2])edge, (size_t)-1);
    assert_non_null(lu);
    const double size = (double)cpsi_block_lu_size(lu);
    /* a limit below is kept */
    assert_null(cpsi_block_lu_new(n, (size_t)edges, (const int(*)[2])edge, (size_t)size - 1));
    cpsi_block_lu_free(lu);
    free(edge);
    return size;
}

/* No order does with less than a multiple of n log n (Hoffman, Martin and Rose 1973); nested
 * dissection takes 31/4 n log2 n and lower terms (George 1973). Minimum degree is to stay below
 * that. */
static void factors_of_nets_grow_as_n_log_n(void **unused) {
    (void)unused;
    for (int side = 25; side <= 200; side *= 2) {
        const double n = side * (double)side, size = size_of_net(side);
        print_message("net %d x %d: %.0f pairs of blocks, %.2f n log2 n\n", side, side, size,
                      size / (n * log2(n)));
        CHECK_LESS(size, 31.0 / 4 * n * log2(n));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solutions_are_found_again),
        cmocka_unit_test(rows_are_changed_as_asked),
        cmocka_unit_test(factors_of_nets_grow_as_n_log_n),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
