/* SPDX-License-Identifier: BSD-3-Clause */
/* A program over a chain: where its arrays lie (one function, run once to measure and once to
 * place), and its linear system. */
#include "ipm/chain_program.h"

#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "linsys/frame.h"

static void layout_stretch(CpsiStretch *st, CpsiArena *arena, int n) {
    st->length = CPSI_TAKE(arena, n, double);
    st->s = cpsi_arena_take(arena, (size_t)n, sizeof *st->s);
    st->z = cpsi_arena_take(arena, (size_t)n, sizeof *st->z);
    st->w = cpsi_arena_take(arena, (size_t)n, sizeof *st->w);
    st->g = CPSI_TAKE(arena, n, double);
    st->inverse_w = CPSI_TAKE(arena, n, double);
    st->q = cpsi_arena_take(arena, (size_t)n, sizeof *st->q);
    st->ds = cpsi_arena_take(arena, (size_t)n, sizeof *st->ds);
    st->dz = cpsi_arena_take(arena, (size_t)n, sizeof *st->dz);
}

static void layout_rub(CpsiRub *rub, CpsiArena *arena, int n) {
    rub->node = CPSI_TAKE(arena, n, int);
    rub->contact = CPSI_TAKE(arena, n, int);
    rub->weight = CPSI_TAKE(arena, n, double);
    rub->s = cpsi_arena_take(arena, (size_t)n, sizeof *rub->s);
    rub->z = cpsi_arena_take(arena, (size_t)n, sizeof *rub->z);
    rub->w = cpsi_arena_take(arena, (size_t)n, sizeof *rub->w);
    rub->stop = CPSI_TAKE(arena, n, int);
    rub->friction = CPSI_TAKE(arena, n, double);
    rub->g = CPSI_TAKE(arena, n, double);
    rub->q = cpsi_arena_take(arena, (size_t)n, sizeof *rub->q);
    rub->ds = cpsi_arena_take(arena, (size_t)n, sizeof *rub->ds);
    rub->dz = cpsi_arena_take(arena, (size_t)n, sizeof *rub->dz);
}

static void layout_stop(CpsiStop *stop, CpsiArena *arena, int n) {
    stop->node = CPSI_TAKE(arena, n, int);
    stop->contact = CPSI_TAKE(arena, n, int);
    stop->second = CPSI_TAKE(arena, n, bool);
    stop->weight = CPSI_TAKE(arena, n, double);
    stop->gap = CPSI_TAKE(arena, n, double);
    stop->s = CPSI_TAKE(arena, n, double);
    stop->z = CPSI_TAKE(arena, n, double);
    stop->q = CPSI_TAKE(arena, n, double);
    stop->ds = CPSI_TAKE(arena, n, double);
    stop->dz = CPSI_TAKE(arena, n, double);
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
    chain->matrix.frame = chain->shape.count > 0 ? chain->shape.frame : chain->frame;
    return chain->ops->factor(chain->linsys, &chain->matrix);
}

/* The rows of the tensions have nothing on their right: residuals of elements are condensed with
 * their privates. */
static void solve(CpsiProgram *program) {
    CpsiChainProgram *chain = cpsi_chain(program);
    memset(chain->dt, 0, (size_t)chain->n * sizeof *chain->dt);
    cpsi_shape_turn(&chain->shape, program->du);
    chain->ops->solve(chain->linsys, &chain->matrix, program->du, chain->dt,
                      chain->matrix.second ? chain->own.press : NULL);
    cpsi_shape_turn_back(&chain->shape, program->du);
}

/* The share that node `node` has in the point of element i; 0 where there is none. */
static double share_of(const CpsiChainProgram *chain, int i, int node) {
    if (i < 1 || i >= chain->n || !cpsi_point_is_set(&chain->matrix, i)) return 0;
    return node == i ? chain->matrix.share[i] : 1 - chain->matrix.share[i];
}

/* The residual of node j, with what the points of its elements leave to it. */
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

static double imbalance(const CpsiProgram *program) {
    const CpsiChainProgram *chain = (const CpsiChainProgram *)program;
    double largest = 0;
    for (int j = 0; j < chain->n; j++) {
        double residual[3];
        if (chain->held[j]) continue;
        node_residual(chain, j, residual);
        for (int a = 0; a < 3; a++) largest = cpsi_larger(largest, fabs(residual[a]));
    }
    return largest;
}

void cpsi_chain_point_place(const CpsiChainProgram *program, int i, double *u) {
    const int p = program->n + i;
    double common[3] = {0}, own[3];
    for (int node = i - 1; node <= i; node++) {
        const double share = node == i ? program->own.share[i] : 1 - program->own.share[i];
        cpsi_frame_from(own, &program->frame[9 * node], &u[3 * node]);
        for (int a = 0; a < 3; a++) common[a] += share * own[a];
    }
    cpsi_frame_to(&u[3 * p], &program->frame[9 * p], common);
}

void cpsi_chain_program_use_points(CpsiChainProgram *program) {
    const int n = program->n;
    program->matrix.share = program->own.share;
    program->base.size = 6 * n;
    memset(&program->base.load[3 * n], 0, 3 * (size_t)n * sizeof *program->base.load);
    memset(&program->base.u[3 * n], 0, 3 * (size_t)n * sizeof *program->base.u);
    for (int i = 1; i < n; i++)
        if (program->own.share[i] > 0) cpsi_chain_point_place(program, i, program->base.u);
}

bool cpsi_chain_program_follow(CpsiChainProgram *program) {
    CpsiProgram *base = &program->base;
    CpsiRub *rub = &program->rub;
    CpsiSums unused = {0};
    rub->follow = true;
    clear(base);
    for (int k = 0; k < base->kind_count; k++) base->kind[k]->scale(base);
    /* dA = friction dR + (friction R - A): the mismatch stands where q0 stands */
    memset(program->stretch.q, 0, (size_t)program->n * sizeof *program->stretch.q);
    memset(program->stop.q, 0, (size_t)program->stop.count * sizeof *program->stop.q);
    for (int k = 0; k < rub->count; k++) {
        rub->q[k][0] = rub->z[k][0] - rub->friction[k] * program->stop.z[rub->stop[k]];
        rub->q[k][1] = rub->q[k][2] = 0;
    }
    cpsi_shape_foresee(&program->shape, &program->stop);
    if (!factor(base)) return false;
    memset(base->du, 0, (size_t)base->size * sizeof *base->du);
    for (int k = 0; k < base->kind_count; k++) base->kind[k]->load(base, 0);
    solve(base);
    for (int k = 0; k < base->kind_count; k++) base->kind[k]->direct(base, 0, false, &unused);
    return true;
}

static void layout_own(CpsiChainProgram *program, CpsiArena *arena, int nodes, int contacts,
                       bool points) {
    const size_t n = (size_t)nodes, stops = n * (size_t)(contacts + points),
                 second = contacts > 1 ? n : 0;
    program->own.frame = CPSI_TAKE(arena, 9 * n * (points ? 2 : 1), double);
    program->own.share = points ? CPSI_TAKE(arena, n, double) : NULL;
    program->own.offset = cpsi_arena_take(arena, 2 * stops, sizeof *program->own.offset);
    program->own.map = cpsi_arena_take(arena, 2 * stops, sizeof *program->own.map);
    program->own.normal = cpsi_arena_take(arena, stops, sizeof *program->own.normal);
    program->own.curvature = cpsi_arena_take(arena, stops, sizeof *program->own.curvature);
    program->own.second = (CpsiMatrixSecond){.column = CPSI_TAKE(arena, 3 * second, double),
                                             .row = CPSI_TAKE(arena, 3 * second, double),
                                             .compliance = CPSI_TAKE(arena, second, double)};
    program->own.press = CPSI_TAKE(arena, second, double);
    program->own.two = contacts > 1;
}

void cpsi_chain_program_resize(CpsiChainProgram *program, int n, bool own_axes) {
    program->n = program->matrix.n = n;
    program->base.size = 3 * n;
    program->frame = own_axes ? program->own.frame : NULL;
    program->rub.offset = own_axes ? program->own.offset : NULL;
    program->rub.map = own_axes ? program->own.map : NULL;
    program->stop.normal = own_axes ? program->own.normal : NULL;
    program->stop.curvature = own_axes ? program->own.curvature : NULL;
    program->matrix.second = own_axes && program->own.two ? &program->own.second : NULL;
    program->matrix.share = NULL;
}

void cpsi_chain_program_layout(CpsiChainProgram *program, CpsiArena *arena, int n, int contacts,
                               bool points, const CpsiShapeForm *largest,
                               const CpsiLinsysOps *ops) {
    static const CpsiKind *const kinds[] = {&cpsi_stretch, &cpsi_drag, &cpsi_stop, &cpsi_rub,
                                            &cpsi_shape};
    const int all = sizeof kinds / sizeof *kinds;
    const size_t places = (size_t)n * (points ? 2 : 1), size = 3 * places;
    const int stops = (contacts > 1 ? contacts * n : n) + (points ? n : 0);
    program->base = (CpsiProgram){
        .load = CPSI_TAKE(arena, size, double),
        .u = CPSI_TAKE(arena, size, double),
        .du = CPSI_TAKE(arena, size, double),
        .residual = CPSI_TAKE(arena, size, double),
        .kind_count = largest ? all : all - 1,
        .kind = kinds,
        .clear = clear,
        .factor = factor,
        .solve = solve,
        .imbalance = imbalance,
    };
    layout_stretch(&program->stretch, arena, n);
    program->drag = 0;
    layout_rub(&program->rub, arena, contacts > 0 ? 2 * stops : n);
    layout_stop(&program->stop, arena, stops);
    program->shape = (CpsiShape){0};
    if (largest) cpsi_shape_layout(&program->shape, arena, (int)places, stops, largest);
    memset(&program->own, 0, sizeof program->own);
    if (contacts > 0) layout_own(program, arena, n, contacts, points);
    program->held = CPSI_TAKE(arena, n, unsigned char);
    program->dt = CPSI_TAKE(arena, n, double);
    program->matrix = (CpsiMatrix){
        .held = program->held,
        .diagonal = CPSI_TAKE(arena, 6 * places, double),
        .skew = CPSI_TAKE(arena, 2 * places, double),
        .stiffness = CPSI_TAKE(arena, n, double),
        .direction = CPSI_TAKE(arena, 3 * (size_t)n, double),
        .compliance = CPSI_TAKE(arena, n, double),
    };
    program->ops = ops;
    program->linsys = ops->layout(arena, n, contacts > 1, points);
    cpsi_chain_program_resize(program, n, false);
}
