/* SPDX-License-Identifier: BSD-3-Clause */
/* Where a program's arrays lie: one function, run once to measure and once to place (base/arena.h). */
#include "ipm/program.h"

static void layout_stretch(CpsiStretch *st, CpsiArena *arena, int n) {
    st->length = CPSI_TAKE(arena, n, double);
    st->compliance = CPSI_TAKE(arena, n, double);
    st->s = cpsi_arena_take(arena, (size_t)n, sizeof *st->s);
    st->z = cpsi_arena_take(arena, (size_t)n, sizeof *st->z);
    st->w = cpsi_arena_take(arena, (size_t)n, sizeof *st->w);
    st->g = CPSI_TAKE(arena, n, double);
    st->q = cpsi_arena_take(arena, (size_t)n, sizeof *st->q);
    st->ds = cpsi_arena_take(arena, (size_t)n, sizeof *st->ds);
    st->dz = cpsi_arena_take(arena, (size_t)n, sizeof *st->dz);
}

static void layout_rub(CpsiRub *rub, CpsiArena *arena, int n) {
    rub->node = CPSI_TAKE(arena, n, int);
    rub->weight = CPSI_TAKE(arena, n, double);
    rub->s = cpsi_arena_take(arena, (size_t)n, sizeof *rub->s);
    rub->z = cpsi_arena_take(arena, (size_t)n, sizeof *rub->z);
    rub->w = cpsi_arena_take(arena, (size_t)n, sizeof *rub->w);
    rub->g = CPSI_TAKE(arena, n, double);
    rub->q = cpsi_arena_take(arena, (size_t)n, sizeof *rub->q);
    rub->ds = cpsi_arena_take(arena, (size_t)n, sizeof *rub->ds);
    rub->dz = cpsi_arena_take(arena, (size_t)n, sizeof *rub->dz);
}

static void layout_stop(CpsiStop *stop, CpsiArena *arena, int n) {
    stop->node = CPSI_TAKE(arena, n, int);
    stop->weight = CPSI_TAKE(arena, n, double);
    stop->gap = CPSI_TAKE(arena, n, double);
    stop->s = CPSI_TAKE(arena, n, double);
    stop->z = CPSI_TAKE(arena, n, double);
    stop->q = CPSI_TAKE(arena, n, double);
    stop->ds = CPSI_TAKE(arena, n, double);
    stop->dz = CPSI_TAKE(arena, n, double);
}

void cpsi_program_layout(CpsiProgram *program, CpsiArena *arena, int n, const CpsiLinsysOps *ops) {
    program->n = n;
    program->held = CPSI_TAKE(arena, n, unsigned char);
    program->load = CPSI_TAKE(arena, 3*(size_t)n, double);
    layout_stretch(&program->stretch, arena, n);
    layout_rub(&program->rub, arena, n);
    layout_stop(&program->stop, arena, n);
    program->u = CPSI_TAKE(arena, 3*(size_t)n, double);
    program->du = CPSI_TAKE(arena, 3*(size_t)n, double);
    program->dt = CPSI_TAKE(arena, n, double);
    program->residual = CPSI_TAKE(arena, 3*(size_t)n, double);
    program->matrix = (CpsiMatrix){
        .n = n,
        .held = program->held,
        .diagonal = CPSI_TAKE(arena, 6*(size_t)n, double),
        .stiffness = CPSI_TAKE(arena, n, double),
        .direction = CPSI_TAKE(arena, 3*(size_t)n, double),
        .compliance = CPSI_TAKE(arena, n, double),
    };
    program->ops = ops;
    program->linsys = ops->layout(arena, n);
}
