/* SPDX-License-Identifier: BSD-3-Clause */
/* A system written as a conic program, and its solution read back. */
#include "drive/system_program.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "drive/adjoint.h"
#include "linalg/dense.h"

/* Residual and gap above which the solver's outcome is no proof by itself. Motions are checked by
 * their bounds. */
static const double ACCEPT = 1e-7;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a driven system");
}

void cpsi_drive_program_clear(CpsiDriveProgram *p) {
    cpsi_sparse_program_free(p->program);
    if (p->own)
        for (int k = 0; k < p->system->pieces; k++) cpsi_conic_form_free(p->own[k]);
    void *part[] = {p->form, p->own, p->first, p->block, p->c};
    for (size_t k = 0; k < sizeof part / sizeof *part; k++) free(part[k]);
    cpsi_rows_free(&p->equation);
    *p = (CpsiDriveProgram){0};
}

/* The forms of all pieces, their first unknowns and rows, and the blocks. */
static CpsStatus gather_forms(CpsiDriveProgram *p, double speed, int *blocks, CpsError *err) {
    const CpsSystem *system = p->system;
    const size_t pieces = (size_t)system->pieces + 1;
    p->form = calloc(pieces, sizeof *p->form);
    p->own = calloc(pieces, sizeof *p->own);
    p->first = calloc(3 * pieces, sizeof *p->first);
    p->block = calloc(pieces, sizeof *p->block);
    if (!p->form || !p->own || !p->first || !p->block) return out_of_memory(err);
    p->line = p->first + pieces;
    p->row = p->line + pieces;
    size_t unknowns = 0, rows = 0, lines = 0;
    for (int k = 0; k < system->pieces; k++) {
        const CpsiPiece *piece = &system->piece[k];
        if (piece->term) {
            const CpsStatus status =
                cpsi_term_form(piece->space, piece->term, speed, &p->own[k], err);
            if (status != CPS_OK) return status;
        }
        const CpsiConicForm *form = p->form[k] =
            piece->term ? p->own[k] : system->form[piece->form];
        p->first[k] = (int)unknowns;
        p->row[k] = (int)rows;
        p->line[k] = (int)lines;
        unknowns += (size_t)form->unknowns;
        rows += (size_t)form->rows;
        lines += (size_t)form->lines;
        if (unknowns + rows + lines > INT_MAX / 8)
            return cpsi_fail(err, CPS_ERR_LIMIT, "the laws have more than %d unknowns",
                             INT_MAX / 8);
        if (form->unknowns > 0)
            p->block[(*blocks)++] =
                (CpsiBlock){form->unknowns, form->rows, form->cones, form->dim, form->a, form->b};
    }
    for (int k = 0; k < system->pieces; k++) p->line[k] += (int)unknowns;
    p->resistance = (int)(unknowns + lines);
    p->constraint = p->resistance + system->drive.rows;
    p->factor = p->constraint + system->constraint.rows;
    p->unknowns = p->factor;
    return CPS_OK;
}

/* ---- the equations: one per velocity parameter ---- */

/* A list of entries that grows. */
typedef struct List {
    CpsEntry *entry;
    size_t count, capacity;
} List;

static bool push(List *list, int row, int column, double value) {
    if (value == 0) return true;
    if (list->count >= list->capacity) {
        const size_t capacity = list->capacity > 0 ? 2 * list->capacity : 1024;
        CpsEntry *more = realloc(list->entry, capacity * sizeof *more);
        if (!more) return false;
        list->entry = more;
        list->capacity = capacity;
    }
    list->entry[list->count++] = (CpsEntry){row, column, value};
    return list->count < INT_MAX;
}

/* Append B* F of one piece: entries, and the constant to h. */
static bool push_piece(const CpsiDriveProgram *p, int k, CpsiAdjoint *adjoint, List *list) {
    const CpsSystem *system = p->system;
    const CpsiConicForm *form = p->form[k];
    const CpsiPiece *piece = &system->piece[k];
    const size_t space = (size_t)piece->space, unknowns = (size_t)form->unknowns;
    const double size = cpsi_adjoint_size(space * unknowns, form->p),
                 far = cpsi_adjoint_size(space, form->origin);
    bool done = true;
    cpsi_adjoint_apply(adjoint, system, piece, form->origin, 1, far);
    for (int i = 0; i < adjoint->count; i++)
        p->h[adjoint->column[i]] += adjoint->sum[adjoint->column[i]];
    for (int j = 0; done && j < form->unknowns; j++) {
        cpsi_adjoint_apply(adjoint, system, piece, &form->p[j], unknowns, size);
        for (int i = 0; done && i < adjoint->count; i++)
            done =
                push(list, adjoint->column[i], p->first[k] + j, adjoint->sum[adjoint->column[i]]);
    }
    for (int l = 0; done && l < form->lines; l++) {
        cpsi_adjoint_apply(adjoint, system, piece, &form->q[(size_t)l * (size_t)form->n], 1, 1);
        for (int i = 0; done && i < adjoint->count; i++)
            done = push(list, adjoint->column[i], p->line[k] + l, adjoint->sum[adjoint->column[i]]);
    }
    return done;
}

/* -D* G, -C* lambda */
static bool push_transposed(const CpsiRows *rows, int first, List *list) {
    bool done = true;
    for (int i = 0; i < rows->rows; i++)
        for (size_t e = rows->start[i]; done && e < rows->start[i + 1]; e++)
            done = push(list, rows->column[e], first + i, -rows->value[e]);
    return done;
}

static CpsStatus write_equations(CpsiDriveProgram *p, CpsiAim aim, CpsError *err) {
    const CpsSystem *system = p->system;
    List list = {0};
    CpsiAdjoint adjoint;
    CpsStatus status = cpsi_adjoint_new(system, &adjoint, err);
    if (status != CPS_OK) return status;
    bool done = true;
    for (int k = 0; done && k < system->pieces; k++) done = push_piece(p, k, &adjoint, &list);
    done = done && push_transposed(&system->drive, p->resistance, &list) &&
           push_transposed(&system->constraint, p->constraint, &list);
    if (system->load)
        for (int i = 0; done && i < system->n; i++) {
            if (aim == CPSI_AIM_FACTOR)
                done = push(&list, i, p->factor, system->load[i]);
            else
                p->h[i] += system->load[i];
        }
    if (!done) status = out_of_memory(err);
    if (status == CPS_OK)
        status = cpsi_rows_append(&p->equation, "equilibrium", p->unknowns, system->n,
                                  (int)list.count, list.entry, err);
    free(list.entry);
    cpsi_adjoint_free(&adjoint);
    return status;
}

/* A form without offsets is a cone, whose unknowns have no size of their own. */
static bool is_cone(const CpsiConicForm *form) {
    for (int i = 0; i < form->rows; i++)
        if (form->b[i] != 0) return false;
    return true;
}

/* Largest entry of each column; for the columns of a block, the largest of the block. */
static void measure_columns(const CpsiDriveProgram *p, double *largest) {
    const CpsiRows *e = &p->equation;
    for (int j = 0; j < p->unknowns; j++) largest[j] = 0;
    for (size_t k = 0; k < e->start[p->system->n]; k++)
        largest[e->column[k]] = fmax(largest[e->column[k]], fabs(e->value[k]));
    for (int k = 0; k < p->system->pieces; k++) {
        double most = 0, *of = &largest[p->first[k]];
        for (int j = 0; j < p->form[k]->unknowns; j++) most = fmax(most, of[j]);
        for (int j = 0; j < p->form[k]->unknowns; j++) of[j] = most;
    }
}

/* Columns are scaled first: the unknowns of cones by the sum of the forces of all bounded laws,
 * which bounds what cones may have to carry in a chain. Then each equation is divided by its
 * largest entry of a bounded law, and each free column by its largest entry. */
static void scale(CpsiDriveProgram *p, bool even) {
    CpsiRows *e = &p->equation;
    const int n = p->system->n, laws = p->resistance;
    /* used as scratch; the objective is written later */
    double *largest = p->c, total = 0, force = 0;
    measure_columns(p, largest);
    for (int i = 0; i < n; i++) force = fmax(force, fabs(p->h[i]));
    for (int k = 0; k < p->system->pieces; k++) {
        if (p->form[k]->unknowns == 0 || is_cone(p->form[k])) continue;
        total += largest[p->first[k]];
        force = fmax(force, largest[p->first[k]]);
    }
    total = fmax(total, force);
    for (int j = 0; j < p->unknowns; j++) p->column_scale[j] = 1;
    if (total > 0)
        for (int k = 0; k < p->system->pieces; k++)
            if (is_cone(p->form[k]))
                for (int j = p->first[k]; j < p->first[k] + p->form[k]->unknowns; j++)
                    if (largest[j] > 0) p->column_scale[j] = total / largest[j];
    for (int i = 0; i < n; i++) {
        double most = 0;
        for (size_t k = e->start[i]; k < e->start[i + 1]; k++) {
            if (e->column[k] < laws && p->column_scale[e->column[k]] == 1)
                most = fmax(most, fabs(e->value[k]));
            e->value[k] *= p->column_scale[e->column[k]];
        }
        if (most == 0 || even) most = force > 0 ? force : 1;
        p->row_scale[i] = 1 / most;
        p->h[i] /= most;
        for (size_t k = e->start[i]; k < e->start[i + 1]; k++) e->value[k] /= most;
    }
    measure_columns(p, largest);
    for (int j = laws; j < p->unknowns; j++)
        p->column_scale[j] = largest[j] > 0 ? 1 / largest[j] : 1;
    for (size_t k = 0; k < e->start[n]; k++)
        if (e->column[k] >= laws) e->value[k] *= p->column_scale[e->column[k]];
    for (int j = 0; j < p->unknowns; j++) p->c[j] = 0;
}

static void write_objective(CpsiDriveProgram *p, CpsiAim aim, const double *driving) {
    if (aim == CPSI_AIM_FACTOR) p->c[p->factor] = -1;
    if (aim == CPSI_AIM_MOTION) {
        for (int j = 0; j < p->system->drive.rows; j++) p->c[p->resistance + j] = driving[j];
        for (int k = 0; k < p->system->pieces; k++) {
            const CpsiConicForm *form = p->own[k];
            if (!form) continue;
            const size_t last = (size_t)form->n - 1, u = (size_t)form->unknowns;
            for (size_t j = 0; j < u; j++) p->c[(size_t)p->first[k] + j] = form->p[last * u + j];
            for (size_t l = 0; l < (size_t)form->lines; l++)
                p->c[(size_t)p->line[k] + l] = form->q[(l + 1) * (last + 1) - 1];
        }
    }
    p->power = 0;
    for (int j = 0; j < p->unknowns; j++)
        p->power = fmax(p->power, fabs(p->c[j] *= p->column_scale[j]));
    if (!(p->power > 0)) p->power = 1;
    for (int j = 0; j < p->unknowns; j++) p->c[j] /= p->power;
}

CpsStatus cpsi_drive_program_new(const CpsSystem *system, CpsiAim aim, const double *driving,
                                 double speed, bool even, CpsiDriveProgram *out, CpsError *err) {
    CpsiDriveProgram p = {.system = system};
    int blocks = 0;
    CpsStatus status = gather_forms(&p, aim == CPSI_AIM_MOTION ? speed : 0, &blocks, err);
    if (status == CPS_OK && aim == CPSI_AIM_FACTOR) p.unknowns++;
    if (status == CPS_OK) {
        const size_t u = (size_t)p.unknowns, n = (size_t)system->n;
        p.c = calloc(2 * u + 2 * n + 1, sizeof *p.c);
        if (!p.c) {
            status = out_of_memory(err);
        } else {
            p.h = p.c + u;
            p.row_scale = p.h + n;
            p.column_scale = p.row_scale + n;
        }
    }
    if (status == CPS_OK) status = write_equations(&p, aim, err);
    if (status == CPS_OK) {
        scale(&p, even);
        write_objective(&p, aim, driving);
        const CpsiSparseData data = {.unknowns = p.unknowns,
                                     .equations = system->n,
                                     .blocks = blocks,
                                     .block = p.block,
                                     .start = p.equation.start,
                                     .column = p.equation.column,
                                     .value = p.equation.value,
                                     .c = p.c,
                                     .h = p.h};
        status = cpsi_sparse_program_new(&data, &p.program, err);
    }
    if (status == CPS_OK)
        *out = p;
    else
        cpsi_drive_program_clear(&p);
    return status;
}

void cpsi_drive_program_solve(CpsiDriveProgram *p) {
    p->result = cpsi_sparse_program_solve(p->program, ACCEPT);
}

/* ---- reading the solution ---- */

void cpsi_drive_program_force(const CpsiDriveProgram *p, int piece, double *force) {
    const CpsiConicForm *form = p->form[piece];
    const double *x = p->result.x, *v = &x[p->first[piece]], *l = &x[p->line[piece]];
    const double *of_v = &p->column_scale[p->first[piece]],
                 *of_l = &p->column_scale[p->line[piece]];
    const bool ray = p->result.outcome == CPSI_CONIC_UNBOUNDED;
    for (int i = 0; i < p->system->piece[piece].space; i++) {
        force[i] = ray ? 0 : form->origin[i];
        for (int j = 0; j < form->unknowns; j++)
            force[i] += form->p[(size_t)i * (size_t)form->unknowns + (size_t)j] * of_v[j] * v[j];
        for (int k = 0; k < form->lines; k++)
            force[i] += form->q[(size_t)k * (size_t)form->n + (size_t)i] * of_l[k] * l[k];
    }
}

void cpsi_drive_program_velocity(const CpsiDriveProgram *p, double *velocity) {
    const double *y = p->result.y;
    for (int i = 0; i < p->system->n; i++) velocity[i] = -p->power * p->row_scale[i] * y[i];
}

void cpsi_drive_program_multipliers(const CpsiDriveProgram *p, double *resistance,
                                    double *constraint) {
    const double *x = p->result.x;
    for (int j = 0; j < p->system->drive.rows; j++)
        resistance[j] = x[p->resistance + j] * p->column_scale[p->resistance + j];
    for (int j = 0; j < p->system->constraint.rows; j++)
        constraint[j] = x[p->constraint + j] * p->column_scale[p->constraint + j];
}

double cpsi_drive_program_factor(const CpsiDriveProgram *p) {
    return p->result.x[p->factor] * p->column_scale[p->factor];
}
