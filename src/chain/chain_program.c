/* SPDX-License-Identifier: BSD-3-Clause */
/* A program over a chain: where its arrays lie (one function, run once to measure and once to
 * place), and its linear system. */
#include "chain/chain_program.h"

#include <math.h>
#include <string.h>

#include "base/lanes.h"
#include "base/larger.h"
#include "chain/frame.h"

static void layout_segment(CpsiSegment *st, CpsiArena *arena, int n) {
    CPSI_PLACE(arena, st->length, n);
    CPSI_PLACE(arena, st->s, n);
    CPSI_PLACE(arena, st->z, n);
    CPSI_PLACE(arena, st->w, n);
    CPSI_PLACE(arena, st->g, n);
    CPSI_PLACE(arena, st->inverse_w, n);
}

static void layout_disc(CpsiFrictionDisc *disc, CpsiArena *arena, int n) {
    CPSI_PLACE(arena, disc->node, n);
    CPSI_PLACE(arena, disc->contact, n);
    CPSI_PLACE(arena, disc->weight, n);
    CPSI_PLACE(arena, disc->s, n);
    CPSI_PLACE(arena, disc->z, n);
    CPSI_PLACE(arena, disc->w, n);
    CPSI_PLACE(arena, disc->unilateral, n);
    CPSI_PLACE(arena, disc->friction, n);
    CPSI_PLACE(arena, disc->g, n);
}

static void layout_unilateral(CpsiUnilateral *unilateral, CpsiArena *arena, int n) {
    CPSI_PLACE(arena, unilateral->node, n);
    CPSI_PLACE(arena, unilateral->contact, n);
    CPSI_PLACE(arena, unilateral->second, n);
    CPSI_PLACE(arena, unilateral->weight, n);
    CPSI_PLACE(arena, unilateral->gap, n);
    CPSI_PLACE(arena, unilateral->s, n);
    CPSI_PLACE(arena, unilateral->z, n);
    CPSI_PLACE(arena, unilateral->ds, n);
    CPSI_PLACE(arena, unilateral->dz, n);
}

/* The right-hand sides q, and what the nodes add to the matrix: at points it is read by `solve` as
 * well, elsewhere by `factor` alone, and q is not needed before that. */
static void layout_right_hand_sides(CpsiChainProgram *program, CpsiArena *arena, int n, int discs,
                                    int stops, bool points) {
    CpsiSegment *st = &program->segment;
    CpsiFrictionDisc *disc = &program->disc;
    const size_t places = (size_t)n * (points ? 2 : 1), begin = arena->used;
    CPSI_PLACE(arena, st->q, n);
    CPSI_PLACE(arena, disc->q, discs);
    CPSI_PLACE(arena, program->unilateral.q, stops);
    const size_t end = points ? arena->used : cpsi_arena_return(arena, begin);
    CPSI_PLACE(arena, program->matrix.diagonal, 6 * places);
    CPSI_PLACE(arena, program->matrix.skew, 2 * places);
    cpsi_arena_join(arena, end);
}

/* The factor, and the directions, which are written when it has been used. */
static void layout_factor(CpsiChainProgram *program, CpsiArena *arena, int n, int discs,
                          bool second, bool points) {
    CpsiSegment *st = &program->segment;
    CpsiFrictionDisc *disc = &program->disc;
    program->linsys = program->ops->layout(arena, n, second, points, &program->scratch);
    const size_t end = cpsi_arena_return(arena, program->scratch);
    CPSI_PLACE(arena, st->ds, n);
    CPSI_PLACE(arena, st->dz, n);
    CPSI_PLACE(arena, disc->ds, discs);
    CPSI_PLACE(arena, disc->dz, discs);
    cpsi_arena_join(arena, end);
}

static void clear(CpsiProgram *program) {
    CpsiMatrix *matrix = &cpsi_chain(program)->matrix;
    const size_t places = (size_t)matrix->n * (matrix->share ? 2 : 1);
    memset(matrix->diagonal, 0, 6 * places * sizeof *matrix->diagonal);
    memset(matrix->skew, 0, 2 * places * sizeof *matrix->skew);
    if (!matrix->second) return;
    memset(matrix->second->row, 0, 3 * (size_t)matrix->n * sizeof *matrix->second->row);
    memset(matrix->second->column, 0, 3 * (size_t)matrix->n * sizeof *matrix->second->column);
}

static bool factor(CpsiProgram *program) {
    CpsiChainProgram *chain = cpsi_chain(program);
    chain->matrix.frame = chain->conic.count > 0 ? chain->conic.frame : chain->frame;
    return chain->ops->factor(chain->linsys, &chain->matrix);
}

/* The right-hand sides of the tension rows are zero: the residuals of segments are eliminated
 * together with the segments' own unknowns. */
static void solve(CpsiProgram *program) {
    CpsiChainProgram *chain = cpsi_chain(program);
    memset(chain->dt, 0, (size_t)chain->n * sizeof *chain->dt);
    cpsi_friction_conic_turn(&chain->conic, program->du);
    chain->ops->solve(chain->linsys, &chain->matrix, program->du, chain->dt,
                      chain->matrix.second ? chain->node_frames.second_reaction_change : NULL);
    cpsi_friction_conic_turn_back(&chain->conic, program->du);
}

/* The share that node `node` has in the point of element i; 0 where there is none. */
static double share_of(const CpsiChainProgram *chain, int i, int node) {
    if (i < 1 || i >= chain->n || !cpsi_point_is_set(&chain->matrix, i)) return 0;
    return node == i ? chain->matrix.share[i] : 1 - chain->matrix.share[i];
}

/* The residual of node j, including the shares of the residuals at the points of its elements. */
static void node_residual(const CpsiChainProgram *chain, int j, double out[3]) {
    memcpy(out, &chain->base.residual[3 * j], 3 * sizeof *out);
    for (int i = j; i <= j + 1 && chain->matrix.share; i++) {
        const double share = share_of(chain, i, j);
        if (share == 0) continue;
        double common[3], here[3];
        cpsi_frame_from(common, &chain->frame[9 * (chain->n + i)],
                        &chain->base.residual[3 * (chain->n + i)]);
        cpsi_frame_to(here, &chain->frame[9 * j], common);
        for (int a = 0; a < 3; a++) out[a] += share * here[a];
    }
}

/* Without points: the largest residual in each run of nodes that are not held. */
static double plain_imbalance(const CpsiChainProgram *chain) {
    double largest = 0;
    for (int first = 0, j = 0; j <= chain->n; j++) {
        if (j < chain->n && !chain->held[j]) continue;
        const double *residual = &chain->base.residual[3 * first];
        largest = cpsi_max_nan(largest, cpsi_lanes_size(3 * (size_t)(j - first), residual));
        first = j + 1;
    }
    return largest;
}

static double imbalance(const CpsiProgram *program) {
    const CpsiChainProgram *chain = (const CpsiChainProgram *)program;
    double largest = 0;
    if (!chain->matrix.share) return plain_imbalance(chain);
    for (int j = 0; j < chain->n; j++) {
        double residual[3];
        if (chain->held[j]) continue;
        node_residual(chain, j, residual);
        for (int a = 0; a < 3; a++) largest = cpsi_max_nan(largest, fabs(residual[a]));
    }
    return largest;
}

void cpsi_chain_point_place(const CpsiChainProgram *program, int i, double *u) {
    const int p = program->n + i;
    double common[3] = {0}, own[3];
    for (int node = i - 1; node <= i; node++) {
        const double share =
            node == i ? program->node_frames.share[i] : 1 - program->node_frames.share[i];
        cpsi_frame_from(own, &program->frame[9 * node], &u[3 * node]);
        for (int a = 0; a < 3; a++) common[a] += share * own[a];
    }
    cpsi_frame_to(&u[3 * p], &program->frame[9 * p], common);
}

void cpsi_chain_program_use_points(CpsiChainProgram *program) {
    const int n = program->n;
    program->matrix.share = program->node_frames.share;
    program->base.size = 6 * n;
    memset(&program->base.load[3 * n], 0, 3 * (size_t)n * sizeof *program->base.load);
    memset(&program->base.u[3 * n], 0, 3 * (size_t)n * sizeof *program->base.u);
    for (int i = 1; i < n; i++)
        if (program->node_frames.share[i] > 0) cpsi_chain_point_place(program, i, program->base.u);
}

bool cpsi_chain_program_couple_bounds(CpsiChainProgram *program) {
    CpsiProgram *base = &program->base;
    CpsiFrictionDisc *disc = &program->disc;
    const CpsiIpmAim given = {CPSI_IPM_AIM_GIVEN, 0, 0};
    CpsiSums unused = {0};
    program->bounds_coupled = true;
    clear(base);
    for (int k = 0; k < base->kind_count; k++) base->kind[k]->scale(base);
    if (!factor(base)) return false;
    /* dA = friction dR + (friction R - A): the mismatch takes the place of q0 */
    memset(program->segment.q, 0, (size_t)program->n * sizeof *program->segment.q);
    memset(program->unilateral.q, 0,
           (size_t)program->unilateral.count * sizeof *program->unilateral.q);
    for (int k = 0; k < program->segment.springs.count; k++) program->segment.springs.q[k] = 0;
    memset(disc->q, 0, (size_t)disc->count * sizeof *disc->q);
    for (int k = 0; k < disc->count; k++)
        *cpsi_lanes_kept(3, disc->q[0], disc->count, k, 0) =
            disc->z[k][0] - disc->friction[k] * program->unilateral.z[disc->unilateral[k]];
    cpsi_friction_conic_predict_bounds(&program->conic, &program->unilateral);
    memset(base->du, 0, (size_t)base->size * sizeof *base->du);
    for (int k = 0; k < base->kind_count; k++)
        if (base->kind[k]->load) base->kind[k]->load(base, &given);
    solve(base);
    for (int k = 0; k < base->kind_count; k++)
        if (base->kind[k]->direct) base->kind[k]->direct(base, &given, &unused);
    return true;
}

static void layout_own(CpsiChainProgram *program, CpsiArena *arena, int nodes, int contacts,
                       bool points) {
    const size_t n = (size_t)nodes, stops = n * (size_t)(contacts + points),
                 second = contacts > 1 ? n : 0;
    CPSI_PLACE(arena, program->node_frames.frame, 9 * n * (points ? 2 : 1));
    if (points) CPSI_PLACE(arena, program->node_frames.share, n);
    CPSI_PLACE(arena, program->node_frames.offset, 2 * stops);
    CPSI_PLACE(arena, program->node_frames.map, 2 * stops);
    CPSI_PLACE(arena, program->node_frames.normal, stops);
    CPSI_PLACE(arena, program->node_frames.curvature, stops);
    CPSI_PLACE(arena, program->node_frames.second.column, 3 * second);
    CPSI_PLACE(arena, program->node_frames.second.row, 3 * second);
    CPSI_PLACE(arena, program->node_frames.second.compliance, second);
    CPSI_PLACE(arena, program->node_frames.second_reaction_change, second);
    program->node_frames.has_second_contacts = contacts > 1;
}

void cpsi_chain_program_resize(CpsiChainProgram *program, int n, bool own_axes) {
    program->n = program->matrix.n = n;
    program->base.size = 3 * n;
    program->field = NULL;
    program->constraints.count = program->constraints.conic_count = 0;
    program->frame = own_axes ? program->node_frames.frame : NULL;
    program->disc.offset = own_axes ? program->node_frames.offset : NULL;
    program->disc.map = own_axes ? program->node_frames.map : NULL;
    program->unilateral.normal = own_axes ? program->node_frames.normal : NULL;
    program->unilateral.curvature = own_axes ? program->node_frames.curvature : NULL;
    program->matrix.second =
        own_axes && program->node_frames.has_second_contacts ? &program->node_frames.second : NULL;
    program->matrix.share = NULL;
}

void cpsi_chain_layout(CpsiChainProgram *program, CpsiArena *arena, int n, int stops, int discs,
                       bool second, bool points, const CpsiLinsysOps *ops) {
    const size_t places = (size_t)n * (points ? 2 : 1);
    CpsiMatrix *matrix = &program->matrix;
    program->base.clear = clear;
    program->base.factor = factor;
    program->base.solve = solve;
    program->base.imbalance = imbalance;
    program->ops = ops;
    CPSI_PLACE(arena, program->base.load, 3 * places);
    CPSI_PLACE(arena, program->base.u, 3 * places);
    CPSI_PLACE(arena, program->base.du, 3 * places);
    CPSI_PLACE(arena, program->base.residual, 3 * places);
    layout_segment(&program->segment, arena, n);
    layout_disc(&program->disc, arena, discs);
    layout_unilateral(&program->unilateral, arena, stops);
    CPSI_PLACE(arena, program->held, n);
    CPSI_PLACE(arena, program->dt, n);
    matrix->held = program->held;
    CPSI_PLACE(arena, matrix->stiffness, n);
    CPSI_PLACE(arena, matrix->direction, 3 * (size_t)n);
    CPSI_PLACE(arena, matrix->compliance, n);
    layout_right_hand_sides(program, arena, n, discs, stops, points);
    layout_factor(program, arena, n, discs, second, points);
}

static int stops_of(int n, int contacts, bool points) {
    return (contacts > 1 ? contacts * n : n) + (points ? n : 0);
}

void cpsi_chain_program_layout_compliance(CpsiChainProgram *program, CpsiArena *arena, int n,
                                          int contacts, bool points) {
    CPSI_PLACE(arena, program->unilateral.compliance, stops_of(n, contacts, points));
}

void cpsi_chain_program_layout(CpsiChainProgram *program, CpsiArena *arena, int n, int contacts,
                               bool points, int springs, const CpsiConicSet *largest,
                               const CpsiLinsysOps *ops) {
    const int places = points ? 2 * n : n, stops = stops_of(n, contacts, points);
    *program = (CpsiChainProgram){
        .base = {.kind = cpsi_chain_kinds(arena),
                 .kind_count = largest ? CPSI_CHAIN_KINDS : CPSI_KIND_FRICTION_CONIC}};
    if (largest) cpsi_friction_conic_layout(&program->conic, arena, places, stops, largest);
    if (largest) CPSI_PLACE(arena, program->disc.shape, 2 * (size_t)stops);
    if (contacts > 0) layout_own(program, arena, n, contacts, points);
    cpsi_springs_layout(&program->segment.springs, arena, n, springs);
    cpsi_chain_layout(program, arena, n, stops, contacts > 0 ? 2 * stops : n, contacts > 1, points,
                      ops);
    cpsi_chain_program_resize(program, n, false);
}
