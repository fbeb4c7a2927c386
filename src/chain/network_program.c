/* SPDX-License-Identifier: BSD-3-Clause */
/* Chains that meet at joints (network_program.h). Every pass goes through the chains, and then
 * gathers at the joints what has come to their nodes. */
#include "chain/network_program.h"

#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "chain/frame.h"

static CpsiNetworkProgram *network_of(CpsiProgram *program) {
    return (CpsiNetworkProgram *)program;
}

/* A node at a joint, the one next to it, the element between, and the sign of its direction; the
 * nodes that move with the joint. */
typedef struct Tie {
    int joint, node, next, element;
    double sign;
    int first, last;
} Tie;

/* The tie of an end node of chain k; false where there is none. */
static bool tie_of(const CpsiNetworkProgram *network, int k, int end, Tie *out) {
    const int n = network->chain[k].n;
    if (network->joint[k][end] == CPSI_NO_JOINT || (n == 1 && end == CPSI_LAST_NODE)) return false;
    const int joint = network->joint[k][end], beyond = network->beyond[k][end], m = n - 1 - beyond;
    *out = end == CPSI_FIRST_NODE ? (Tie){joint, beyond, beyond + 1, beyond + 1, -1, 0, beyond}
                                  : (Tie){joint, m, m - 1, m, 1, m, n - 1};
    return true;
}

static size_t numbers(const CpsiChainProgram *chain) { return (size_t)chain->base.size; }

/* v in the axes of node j, and in the common axes. */
static void to_node(const CpsiChainProgram *chain, int j, const double v[3], double out[3]) {
    if (chain->frame)
        cpsi_frame_to(out, &chain->frame[9 * j], v);
    else
        memcpy(out, v, 3 * sizeof *out);
}
static void from_node(const CpsiChainProgram *chain, int j, const double v[3], double out[3]) {
    if (chain->frame)
        cpsi_frame_from(out, &chain->frame[9 * j], v);
    else
        memcpy(out, v, 3 * sizeof *out);
}

/* The displacement of a joint for an array of the unknowns. */
static void at_joint(const CpsiNetworkProgram *network, int joint, const double *unknowns,
                     double out[3]) {
    const CpsiJointMap *map = &network->map[joint];
    for (int a = 0; a < 3; a++) {
        out[a] = 0;
        for (int i = 0; i < map->width; i++) out[a] += map->by[a][i] * unknowns[map->first + i];
    }
}

/* Add `by` times a force at a joint to an array of the unknowns. */
static void add_to_joint(const CpsiNetworkProgram *network, int joint, double by,
                         const double force[3], double *unknowns) {
    const CpsiJointMap *map = &network->map[joint];
    for (int i = 0; i < map->width; i++)
        for (int a = 0; a < 3; a++) unknowns[map->first + i] += by * map->by[a][i] * force[a];
}

/* Move what an array of chain k holds at its ties to that of the joints. */
static void gather(const CpsiNetworkProgram *network, int k, double *from, double *joints) {
    Tie tie;
    for (int end = 0; end < CPSI_END_NODES; end++) {
        if (!tie_of(network, k, end, &tie)) continue;
        for (int j = tie.first; j <= tie.last; j++) {
            double own[3];
            from_node(&network->chain[k], j, &from[3 * j], own);
            add_to_joint(network, tie.joint, 1, own, joints);
            for (int a = 0; a < 3; a++) from[3 * j + a] = 0;
        }
    }
}

/* ... and set an array of chain k at its ties to that of the joints. */
static void scatter(const CpsiNetworkProgram *network, int k, const double *joints, double *to) {
    Tie tie;
    for (int end = 0; end < CPSI_END_NODES; end++) {
        if (!tie_of(network, k, end, &tie)) continue;
        double own[3];
        at_joint(network, tie.joint, joints, own);
        for (int j = tie.first; j <= tie.last; j++) to_node(&network->chain[k], j, own, &to[3 * j]);
    }
}

/* passes --------------------------------------------------------------------------------------- */

static void start(CpsiProgram *program, double mu, double margin) {
    CpsiNetworkProgram *network = network_of(program);
    for (int k = 0; k < network->count; k++) {
        CpsiChainProgram *chain = &network->chain[k];
        for (int i = 0; i < chain->base.kind_count; i++)
            if (chain->base.kind[i]->start) chain->base.kind[i]->start(&chain->base, mu, margin);
    }
}

static void measure(CpsiProgram *program, double alpha, CpsiSums *sums) {
    CpsiNetworkProgram *network = network_of(program);
    for (int k = 0; k < network->count; k++) {
        CpsiProgram *chain = &network->chain[k].base;
        memcpy(chain->residual, chain->load, numbers(&network->chain[k]) * sizeof(double));
        if (alpha != 0)
            for (int i = 0; i < chain->size; i++) chain->u[i] += alpha * chain->du[i];
        for (int i = 0; i < chain->kind_count; i++) chain->kind[i]->measure(chain, alpha, sums);
        gather(network, k, chain->residual, program->residual);
    }
    for (int k = 0; k < network->bodies; k++) {
        const int first = network->body_first[k];
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 6; j++)
                program->residual[first + i] -=
                    network->stiffness[k][6 * i + j] * program->u[first + j];
    }
}

static void scale(CpsiProgram *program) {
    CpsiNetworkProgram *network = network_of(program);
    for (int k = 0; k < network->count; k++) {
        CpsiProgram *chain = &network->chain[k].base;
        chain->clear(chain);
        for (int i = 0; i < chain->kind_count; i++) chain->kind[i]->scale(chain);
    }
}

static void load(CpsiProgram *program, const CpsiIpmAim *aim) {
    CpsiNetworkProgram *network = network_of(program);
    for (int k = 0; k < network->count; k++) {
        CpsiProgram *chain = &network->chain[k].base;
        for (int i = 0; i < chain->size; i++) chain->du[i] = aim->keep * chain->residual[i];
        for (int i = 0; i < chain->kind_count; i++)
            if (chain->kind[i]->load) chain->kind[i]->load(chain, aim);
        gather(network, k, chain->du, program->du);
    }
}

static void direct(CpsiProgram *program, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiNetworkProgram *network = network_of(program);
    for (int k = 0; k < network->count; k++) {
        CpsiProgram *chain = &network->chain[k].base;
        for (int i = 0; i < chain->kind_count; i++)
            if (chain->kind[i]->direct) chain->kind[i]->direct(chain, aim, sums);
    }
}

static const CpsiKind NETWORK = {start, measure, scale, load, direct};
static const CpsiKind *const KINDS[] = {&NETWORK, &cpsi_hinge};

/* the linear system ---------------------------------------------------------------------------- */

/* Solve chain k for the right-hand side in its du and dt, the nodes at joints held. */
static void solve_chain(CpsiChainProgram *chain) {
    if (chain->n == 1) return;
    cpsi_friction_conic_turn(&chain->conic, chain->base.du);
    chain->ops->solve(chain->linsys, &chain->matrix, chain->base.du, chain->dt,
                      chain->matrix.second ? chain->node_frames.second_reaction_change : NULL);
    cpsi_friction_conic_turn_back(&chain->conic, chain->base.du);
}

/* Add to the right-hand side of chain k what a displacement x of its tie does to the equations of
 * the node and the element beside it. */
static void move_tie(CpsiChainProgram *chain, const Tie *tie, const double x[3]) {
    if (chain->n == 1) return;
    const CpsiMatrix *matrix = &chain->matrix;
    const double *m = &matrix->direction[3 * tie->element];
    double pull[3], own[3];
    for (int a = 0; a < 3; a++) pull[a] = matrix->stiffness[tie->element] * x[a];
    to_node(chain, tie->next, pull, own);
    for (int a = 0; a < 3 && !chain->held[tie->next]; a++)
        chain->base.du[3 * tie->next + a] += own[a];
    chain->dt[tie->element] -= tie->sign * (m[0] * x[0] + m[1] * x[1] + m[2] * x[2]);
}

/* The force of the solved chain on its tie, which moves by x. `other` is the displacement of the
 * next node where that is held. */
static void force_on_tie(const CpsiChainProgram *chain, const Tie *tie, const double x[3],
                         const double other[3], double out[3]) {
    if (chain->n == 1) return;
    const CpsiMatrix *matrix = &chain->matrix;
    const double *m = &matrix->direction[3 * tie->element];
    double next[3];
    if (chain->held[tie->next])
        memcpy(next, other, sizeof next);
    else
        from_node(chain, tie->next, &chain->base.du[3 * tie->next], next);
    for (int a = 0; a < 3; a++)
        out[a] = matrix->stiffness[tie->element] * (x[a] - next[a]) +
                 tie->sign * m[a] * chain->dt[tie->element];
}

/* Add A' K B for a block K of the forces at one joint by the displacements of another. */
static void add_block(CpsiNetworkProgram *network, int to, int from, const double block[9]) {
    cpsi_graph_matrix_add(network->matrix, &network->map[to], &network->map[from], block, 3);
}

/* Add the block of a chain of one node, in the common axes. */
static void add_node(CpsiNetworkProgram *network, const CpsiChainProgram *chain, int joint) {
    const CpsiMatrix *matrix = &chain->matrix;
    const double *d = matrix->diagonal, *s = matrix->skew;
    double block[9] = {d[0], d[1], d[3] + s[0], d[1], d[2], d[4] + s[1], d[3], d[4], d[5]};
    if (cpsi_second_is_set(matrix->second, 0))
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                block[3 * a + b] += matrix->second->column[a] * matrix->second->row[b] /
                                    matrix->second->compliance[0];
    if (chain->frame) {
        double own[9];
        for (int i = 0; i < 9; i++) own[i] = chain->frame[3 * (i % 3) + i / 3];
        cpsi_frame_turn(block, own, block);
    }
    add_block(network, joint, joint, block);
}

/* The forces on the ties of chain k by a unit displacement of each. */
static void find_blocks(CpsiNetworkProgram *network, int k) {
    static const double zero[3] = {0, 0, 0};
    CpsiChainProgram *chain = &network->chain[k];
    Tie from, to;
    for (int end = 0; end < CPSI_END_NODES; end++) {
        if (!tie_of(network, k, end, &from)) continue;
        for (int a = 0; a < 3; a++) {
            const double unit[3] = {a == 0, a == 1, a == 2};
            memset(chain->base.du, 0, numbers(chain) * sizeof(double));
            memset(chain->dt, 0, (size_t)chain->n * sizeof(double));
            move_tie(chain, &from, unit);
            solve_chain(chain);
            for (int other = 0; other < CPSI_END_NODES; other++) {
                if (!tie_of(network, k, other, &to)) continue;
                double force[3];
                force_on_tie(chain, &to, other == end ? unit : zero, other == end ? zero : unit,
                             force);
                for (int b = 0; b < 3; b++) network->block[k][end][other][3 * b + a] = force[b];
            }
        }
    }
}

/* Add them to the matrix of the joints. */
static void add_chain(CpsiNetworkProgram *network, int k) {
    Tie from, to;
    for (int end = 0; end < CPSI_END_NODES; end++) {
        if (!tie_of(network, k, end, &from)) continue;
        for (int other = 0; other < CPSI_END_NODES; other++)
            if (tie_of(network, k, other, &to))
                add_block(network, to.joint, from.joint, network->block[k][end][other]);
    }
}

static void clear(CpsiProgram *program) { (void)program; /* `scale` clears the chains */ }

/* Chains are handed to threads so many at a time that these have at least GRAIN nodes. */
enum { GRAIN = 256 };
static int chains_of_item(const CpsiNetworkProgram *network) {
    long nodes = 0;
    for (int k = 0; k < network->count; k++) nodes += network->chain[k].n;
    return 1 + (int)(GRAIN * (long)network->count / (nodes + 1));
}

/* What a thread does of a pass over the chains: those of one item. */
typedef struct Pass {
    CpsiNetworkProgram *network;
    int chains; /* of an item */
    void (*of_chain)(CpsiNetworkProgram *network, double *kept, int k);
} Pass;

static void pass_over_item(void *data, int worker, int item) {
    const Pass *pass = data;
    CpsiNetworkProgram *network = pass->network;
    const int first = item * pass->chains, past = first + pass->chains;
    double *kept = &network->kept[(size_t)worker * (size_t)network->longest];
    for (int k = first; k < past && k < network->count; k++) pass->of_chain(network, kept, k);
}

static void for_each_chain(CpsiNetworkProgram *network,
                           void (*of_chain)(CpsiNetworkProgram *, double *, int)) {
    Pass pass = {network, chains_of_item(network), of_chain};
    const int items = (network->count + pass.chains - 1) / pass.chains;
    cpsi_workers_run(items > 1 ? network->workers : NULL, pass_over_item, &pass, items);
}

static void factor_chain(CpsiNetworkProgram *network, double *kept, int k) {
    CpsiChainProgram *chain = &network->chain[k];
    (void)kept;
    network->factored[k] = chain->n == 1 || chain->base.factor(&chain->base);
    if (chain->n > 1 && network->factored[k]) find_blocks(network, k);
}

static bool factor(CpsiProgram *program) {
    CpsiNetworkProgram *network = network_of(program);
    for_each_chain(network, factor_chain);
    cpsi_graph_matrix_clear(network->matrix);
    for (int k = 0; k < network->bodies; k++)
        cpsi_graph_matrix_add_body(network->matrix, network->body_first[k], network->stiffness[k]);
    for (int k = 0; k < network->count; k++) {
        if (!network->factored[k]) return false;
        if (network->chain[k].n == 1)
            add_node(network, &network->chain[k], network->joint[k][CPSI_FIRST_NODE]);
        else
            add_chain(network, k);
    }
    cpsi_hinges_add(&network->hinges, network->matrix);
    return cpsi_graph_matrix_factor(network->matrix);
}

/* The forces of chain k on its ties, which are held. */
static void solve_held(CpsiNetworkProgram *network, double *kept, int k) {
    static const double zero[3] = {0, 0, 0};
    CpsiChainProgram *chain = &network->chain[k];
    Tie tie;
    if (chain->n == 1) return;
    memset(chain->dt, 0, (size_t)chain->n * sizeof(double));
    memcpy(kept, chain->base.du, numbers(chain) * sizeof(double));
    solve_chain(chain);
    for (int end = 0; end < CPSI_END_NODES; end++)
        if (tie_of(network, k, end, &tie))
            force_on_tie(chain, &tie, zero, zero, network->force[k][end]);
    memcpy(chain->base.du, kept, numbers(chain) * sizeof(double));
}

/* Chain k with its ties displaced as the joints are. */
static void solve_displaced(CpsiNetworkProgram *network, double *kept, int k) {
    CpsiChainProgram *chain = &network->chain[k];
    Tie tie;
    (void)kept;
    memset(chain->dt, 0, (size_t)chain->n * sizeof(double));
    for (int end = 0; end < CPSI_END_NODES; end++)
        if (tie_of(network, k, end, &tie)) {
            double move[3];
            at_joint(network, tie.joint, network->base.du, move);
            move_tie(chain, &tie, move);
        }
    solve_chain(chain);
    scatter(network, k, network->base.du, chain->base.du);
}

/* Each chain with its ties held gives the forces on the joints; these give the displacements of the
 * joints; with them each chain is solved again. */
static void solve(CpsiProgram *program) {
    CpsiNetworkProgram *network = network_of(program);
    Tie tie;
    for_each_chain(network, solve_held);
    for (int k = 0; k < network->count; k++)
        for (int end = 0; end < CPSI_END_NODES && network->chain[k].n > 1; end++)
            if (tie_of(network, k, end, &tie))
                add_to_joint(network, tie.joint, -1, network->force[k][end], program->du);
    cpsi_graph_matrix_solve(network->matrix, program->du);
    for_each_chain(network, solve_displaced);
}

static double imbalance(const CpsiProgram *program) {
    const CpsiNetworkProgram *network = (const CpsiNetworkProgram *)program;
    double largest = 0;
    for (int i = 0; i < program->size; i++)
        largest = cpsi_max_nan(largest, fabs(program->residual[i]));
    for (int k = 0; k < network->count; k++)
        largest = cpsi_max_nan(largest, network->chain[k].base.imbalance(&network->chain[k].base));
    return largest;
}

void cpsi_network_layout(CpsiNetworkProgram *network, CpsiArena *arena, int chains, int n,
                         int joints, int bodies, const CpsiNetworkTools *tools) {
    const size_t unknowns = 3 * (size_t)joints + 6 * (size_t)bodies;
    *network = (CpsiNetworkProgram){.base = {.size = (int)unknowns,
                                             .kind = KINDS,
                                             .kind_count = 2,
                                             .clear = clear,
                                             .factor = factor,
                                             .solve = solve,
                                             .imbalance = imbalance},
                                    .count = chains,
                                    .joints = joints,
                                    .matrix = tools->matrix,
                                    .workers = tools->workers,
                                    .longest = 3 * n,
                                    .bodies = bodies};
    CPSI_PLACE(arena, network->base.load, unknowns);
    CPSI_PLACE(arena, network->base.u, unknowns);
    CPSI_PLACE(arena, network->base.du, unknowns);
    CPSI_PLACE(arena, network->base.residual, unknowns);
    CPSI_PLACE(arena, network->chain, chains);
    CPSI_PLACE(arena, network->joint, chains);
    CPSI_PLACE(arena, network->beyond, chains);
    CPSI_PLACE(arena, network->map, joints);
    CPSI_PLACE(arena, network->body_first, bodies);
    CPSI_PLACE(arena, network->stiffness, bodies);
    cpsi_hinges_layout(&network->hinges, arena, 3 * joints);
    CPSI_PLACE(arena, network->kept, (size_t)tools->count * 3 * (size_t)n);
    CPSI_PLACE(arena, network->factored, chains);
    CPSI_PLACE(arena, network->block, chains);
    CPSI_PLACE(arena, network->force, chains);
}
