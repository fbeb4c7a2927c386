/* SPDX-License-Identifier: BSD-3-Clause */
/* Set-up and solution of a sparse program (sparse_program.h). */
#include "conic/sparse_program.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "ipm/ipm.h"
#include "linalg/dense.h"

/* The loop stops at this merit; below it rounding dominates. */
static const double TARGET = 1e-16;
/* At this merit the active cones mostly show, and Newton's method on them is tried, which doubles
 * the digits with each factor where the loop adds one or two. Where it does not reach rounding, the
 * loop goes on. */
static const double EARLY = 1e-8;
static const int MAX_ITERATIONS = 100;
/* The regularisation added to the diagonals, in the order tried. Blocks and equations: small
 * against data of order one, but with a square above rounding, so that an order in which it is a
 * pivot by itself loses no more than refinement recovers; equations that are weak beside others
 * need a smaller one. Free unknowns: long chains of constraints need a small one (the square of
 * their smallest singular value is (pi/n)^2, 1e-9 for 1e5 elements), constraints that depend on
 * each other a larger one. The first value alone leaves 1 to 2 of 5000 random systems
 * inaccurate. */
typedef struct Regular {
    double held, loose; /* blocks and equations; free unknowns */
} Regular;
static const Regular REGULAR[] = {{3e-8, 1e-9}, {3e-8, 1e-7}, {1e-10, 1e-9}, {1e-10, 1e-12}};
/* The next regularisation is tried while gap plus residual of the run's best iterate and of the
 * polished answer are both above this, in units of 1 + the largest unknown, to whose rounding a
 * successful run comes. The residual of an answer whose polish came to its rounding does not count.
 */
static const double SOUND = 1e-14;
/* Limit for the entries of the factor: 6 GB. */
static const size_t MOST_ENTRIES = (size_t)500 << 20;

/* Sizes of the whole program. */
typedef struct Sizes {
    size_t rows, cones, largest, squares, triangles;
} Sizes;

static Sizes measure_blocks(const CpsiSparseData *d) {
    Sizes sizes = {0};
    for (int k = 0; k < d->blocks; k++) {
        const CpsiBlock *block = &d->block[k];
        const size_t n = (size_t)block->unknowns;
        sizes.rows += (size_t)block->rows;
        sizes.cones += (size_t)block->cones;
        sizes.squares += (size_t)block->rows * n;
        sizes.triangles += n * (n + 1) / 2;
        for (int c = 0; c < block->cones; c++)
            if ((size_t)block->dim[c] > sizes.largest) sizes.largest = (size_t)block->dim[c];
    }
    return sizes;
}

static void lay(CpsiArena *arena, CpsiSparseProgram *program, const Sizes *sizes, size_t entries) {
    const CpsiSparseData *d = &program->data;
    const size_t size = (size_t)d->unknowns + (size_t)d->equations, rows = sizes->rows,
                 all = size + rows;
    cpsi_homogeneous_layout(&program->core, arena, &cpsi_sparse_operator, d->unknowns, d->equations,
                            (int)rows, (int)sizes->cones, (int)sizes->largest);
    CPSI_PLACE(arena, program->dim, sizes->cones);
    CPSI_PLACE(arena, program->b, rows);
    CPSI_PLACE(arena, program->scaled_a, sizes->squares);
    CPSI_PLACE(arena, program->scaled_b, rows);
    CPSI_PLACE(arena, program->at, 2 * (size_t)d->blocks);
    CPSI_PLACE(arena, program->value, entries);
    CPSI_PLACE(arena, program->regular, size);
    CPSI_PLACE(arena, program->sign, size);
    double *vectors = cpsi_arena_take(arena, 5 * (all + 1), sizeof *vectors);
    if (!vectors) return;
    program->place = program->at + d->blocks;
    CpsiTriple *const vector[] = {&program->right, &program->left, &program->fix, &program->turned,
                                  &program->answer};
    for (int k = 0; k < 5; k++, vectors += all + 1)
        *vector[k] = (CpsiTriple){vectors, vectors + d->unknowns, vectors + size, vectors + all};
    program->core.c = d->c;
    program->core.h = d->h;
    program->core.b = program->b;
    program->core.cones.dim = program->dim;
}

/* Set what does not change between solves: dimensions, b, positions, signs, and the entries of
 * E. */
static void fill(CpsiSparseProgram *program) {
    const CpsiSparseData *d = &program->data;
    int *dim = program->dim;
    double *b = program->b;
    size_t at = 0, place = 0;
    for (int k = 0; k < d->blocks; k++) {
        const CpsiBlock *block = &d->block[k];
        memcpy(dim, block->dim, (size_t)block->cones * sizeof *dim);
        dim += block->cones;
        memcpy(b, block->b, (size_t)block->rows * sizeof *b);
        b += block->rows;
        program->at[k] = at;
        program->place[k] = place;
        at += (size_t)block->rows * (size_t)block->unknowns;
        place += (size_t)block->unknowns * ((size_t)block->unknowns + 1) / 2;
    }
    int first = 0;
    for (int k = 0; k < d->blocks; k++) first += d->block[k].unknowns;
    program->free_place = place;
    place += (size_t)(d->unknowns - first);
    for (int i = 0; i < d->equations; i++, place++)
        for (size_t e = d->start[i]; e < d->start[i + 1]; e++)
            program->value[place++] = d->value[e];
    memset(program->sign, 1, (size_t)d->unknowns);
    memset(program->sign + d->unknowns, -1, (size_t)d->equations);
}

/* The upper triangle of the condensed matrix by columns. */
static void write_pattern(const CpsiSparseData *d, size_t *start, int *index) {
    size_t at = 0;
    int column = 0;
    for (int k = 0, first = 0; k < d->blocks; first += d->block[k++].unknowns)
        for (int j = 0; j < d->block[k].unknowns; j++) {
            start[column++] = at;
            for (int i = 0; i <= j; i++) index[at++] = first + i;
        }
    for (; column < d->unknowns; column++) {
        start[column] = at;
        index[at++] = column;
    }
    for (int i = 0; i < d->equations; i++, column++) {
        start[column] = at;
        for (size_t e = d->start[i]; e < d->start[i + 1]; e++) index[at++] = d->column[e];
        index[at++] = column;
    }
    start[column] = at;
}

static CpsStatus analyse(CpsiSparseProgram *program, size_t entries, CpsError *err) {
    const CpsiSparseData *d = &program->data;
    const int size = d->unknowns + d->equations;
    size_t *start = malloc(((size_t)size + 1) * sizeof *start), factor_entries = 0;
    int *index = malloc((entries + 1) * sizeof *index);
    if (start && index) {
        write_pattern(d, start, index);
        const CpsiPattern pattern = {.n = size, .start = start, .index = index};
        program->ldl = cpsi_ldl_new(&pattern, MOST_ENTRIES, &program->arena.width, &factor_entries);
    }
    free(start);
    free(index);
    if (program->ldl) return CPS_OK;
    if (factor_entries > MOST_ENTRIES)
        return cpsi_fail(err, CPS_ERR_LIMIT,
                         "the system's factor would have %zu entries, at most %zu: the laws or "
                         "constraints tie too many "
                         "parameters to each other",
                         factor_entries, MOST_ENTRIES);
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a system of %d unknowns", size);
}

CpsStatus cpsi_sparse_program_new(const CpsiSparseData *data, CpsiSparseProgram **out,
                                  CpsError *err) {
    const Sizes sizes = measure_blocks(data);
    const size_t all = (size_t)data->unknowns + (size_t)data->equations + sizes.rows;
    size_t entries = sizes.triangles + data->start[data->equations] + (size_t)data->equations;
    int first = 0;
    for (int k = 0; k < data->blocks; k++) first += data->block[k].unknowns;
    entries += (size_t)(data->unknowns - first);
    if (all > INT_MAX / 4 || entries > MOST_ENTRIES)
        return cpsi_fail(err, CPS_ERR_LIMIT,
                         "the program has %zu unknowns and %zu entries, more than fits", all,
                         entries);
    CpsiSparseProgram *program = calloc(1, sizeof *program);
    if (!program) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a program");
    program->data = *data;
    lay(&program->arena, program, &sizes, entries);
    CpsStatus status =
        cpsi_arena_allocate(&program->arena)
            ? CPS_OK
            : cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a program of %zu unknowns", all);
    if (status == CPS_OK) {
        lay(&program->arena, program, &sizes, entries);
        fill(program);
        status = analyse(program, entries, err);
    }
    if (status == CPS_OK)
        *out = program;
    else
        cpsi_sparse_program_free(program);
    return status;
}

void cpsi_sparse_program_free(CpsiSparseProgram *program) {
    if (!program) return;
    cpsi_ldl_free(program->ldl);
    cpsi_arena_free(&program->arena);
    free(program);
}

/* Set the regularisation. */
static void regularise(CpsiSparseProgram *program, const Regular *with) {
    const CpsiSparseData *d = &program->data;
    int first = 0;
    for (int k = 0; k < d->blocks; k++) first += d->block[k].unknowns;
    double *value = &program->value[program->free_place];
    for (int j = 0; j < d->unknowns + d->equations; j++)
        program->regular[j] = j >= first && j < d->unknowns ? with->loose : with->held;
    for (int j = first; j < d->unknowns; j++) *value++ = with->loose;
    for (int i = 0; i < d->equations; i++, value++) {
        value += d->start[i + 1] - d->start[i];
        *value = -with->held;
    }
}

/* Replace a solution by the polished one, where there is one. Returns whether its residual is
 * rounding. */
static bool polish(CpsiSparseProgram *program, CpsiConicResult *result, bool hasty) {
    if (result->outcome != CPSI_CONIC_SOLVED) return false;
    const CpsiPolished polished =
        cpsi_sparse_polish(program, result->gap + result->residual, hasty);
    if (!isfinite(polished.residual)) return false;
    const CpsiHomogeneous *core = &program->core;
    result->residual = polished.residual;
    result->gap = fabs(cpsi_dot(core->cones.rows, result->s, result->z)) /
                  (1 + fabs(cpsi_dot(core->unknowns, core->c, result->x)));
    return polished.rounded;
}

/* Residual and gap to whose rounding a successful run comes. */
static double sound_residual(const CpsiConicResult *result, int unknowns) {
    double largest = 0;
    for (int j = 0; j < unknowns; j++) largest = fmax(largest, fabs(result->x[j]));
    return SOUND * (1 + largest);
}

/* Whether the solution, polished or not, is as good as rounding allows. */
static bool is_sound(const CpsiConicResult *result, double enough, bool rounded) {
    return result->gap + (rounded ? 0 : result->residual) <= enough;
}

static bool is_within(const CpsiConicResult *result, double limit) {
    return result->residual <= limit && result->gap <= limit;
}

static CpsiIpmOutcome run(CpsiSparseProgram *program, double target, bool goes_on) {
    const CpsiIpmOptions options = {.target = target,
                                    .scale = DBL_MIN,
                                    .max_iterations = MAX_ITERATIONS,
                                    .goes_on = goes_on};
    return cpsi_ipm_solve(&program->core.base, &options).outcome; /* keeps the best iterate */
}

/* Run the loop as far as the active cones show, and polish; true where that gives the last digits.
 * Otherwise the loop goes on to its end. */
static bool solve_early(CpsiSparseProgram *program, CpsiConicResult *result) {
    CpsiHomogeneous *core = &program->core;
    if (run(program, EARLY, false) != CPSI_IPM_SOLVED) return false; /* it has ended before */
    *result = cpsi_homogeneous_result(core);
    const double enough = sound_residual(result, core->unknowns);
    const bool rounded = polish(program, result, true);
    if (result->outcome == CPSI_CONIC_SOLVED && is_sound(result, enough, rounded)) return true;
    cpsi_homogeneous_return(core);
    run(program, TARGET, true);
    return false;
}

CpsiConicResult cpsi_sparse_program_solve(CpsiSparseProgram *program, double accept) {
    CpsiHomogeneous *core = &program->core;
    CpsiConicResult result;
    bool accepted = false, sound = false;
    cpsi_homogeneous_begin(core);
    for (size_t k = 0; k < sizeof REGULAR / sizeof *REGULAR && !sound; k++) {
        regularise(program, &REGULAR[k]);
        if (k == 0 && solve_early(program, &result)) {
            accepted = is_within(&result, accept);
            break;
        }
        if (k > 0) run(program, TARGET, false);
        result = cpsi_homogeneous_result(core);
        const double enough = sound_residual(&result, core->unknowns);
        sound = is_sound(&result, enough, false);
        accepted = is_within(&result, accept);
        const bool rounded = polish(program, &result, false);
        sound |= is_sound(&result, enough, rounded);
        accepted = accepted || is_within(&result, accept);
    }
    if (!accepted) result.outcome = CPSI_CONIC_FAILED;
    return result;
}
