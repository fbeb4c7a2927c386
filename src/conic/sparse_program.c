/* SPDX-License-Identifier: BSD-3-Clause */
/* The elements of the homogeneous form: cones on blocks of x, and tau with the skew term; u = (x, y, tau).
 *
 *     blocks:  ds = A dx + b dtau + keep rho,   dz = q - H ds,   H = g W^-2 (cones.h)
 *     tau:     dkappa = q_tau - (kappa/tau) dtau */
#include "conic/sparse_program.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/larger.h"
#include "base/status.h"
#include "ipm/ipm.h"
#include "linalg/dense.h"

/* Merit at which an iterate is good enough to stop; below it rounding rules. */
static const double TARGET = 1e-16;
static const int MAX_ITERATIONS = 100;
/* What is added to the diagonals, in the order tried. Blocks and equations: small against data of order one, but its
 * square is above rounding, so that an order in which it is a pivot of its own loses no more than refinement brings
 * back; equations that are weak beside others want less. Free unknowns: long chains of constraints need little
 * (their least singular value squared is (pi/n)^2, 1e-9 for 1e5 elements), constraints that depend on each other
 * more. The first alone leaves 1 to 2 of 5000 random systems inaccurate. */
typedef struct Regular {
    double held, loose; /* blocks and equations; free unknowns */
} Regular;
static const Regular REGULAR[] = {{3e-8, 1e-9}, {3e-8, 1e-7}, {1e-10, 1e-9}, {1e-10, 1e-12}};
/* Merit above which the next one is tried, in units of 1 + the largest unknown: sound runs end at its rounding. */
static const double SOUND = 1e-14;
/* Entries of the factor: 6 GB. */
static const size_t MOST_ENTRIES = (size_t)500 << 20;

static inline CpsiSparseProgram *sparse(CpsiProgram *base) { return (CpsiSparseProgram *)base; }

/* <b, z> over all blocks */
static double blocks_offset(const CpsiSparseData *d, const double *z) {
    double sum = 0;
    for (int k = 0; k < d->blocks; z += d->block[k++].rows) sum += cpsi_dot(d->block[k].rows, d->block[k].b, z);
    return sum;
}

/* ---- cones ---- */

static void cones_start(CpsiProgram *base, double mu, double margin) {
    (void)margin;
    cpsi_cones_start(&sparse(base)->cones, mu);
}

static void cones_measure(CpsiProgram *base, CpsiSums *sums) {
    CpsiSparseProgram *program = sparse(base);
    CpsiCones *cones = &program->cones;
    const double tau = base->u[program->data.unknowns + program->data.equations];
    double *rho = cones->rho;
    cpsi_sparse_blocks_multiply(program, false, base->u, rho);
    for (int k = 0, i = 0; k < program->data.blocks; k++)
        for (int r = 0; r < program->data.block[k].rows; r++, i++) {
            rho[i] += program->data.block[k].b[r]*tau - cones->s[i];
            sums->residual = cpsi_max_nan(sums->residual, fabs(rho[i]));
            sums->sz += cones->s[i]*cones->z[i];
        }
    cpsi_sparse_blocks_add(program, false, 1, cones->z, base->residual);
    sums->weight += cones->count;
}

/* A~ and b~ of one block; `cone` and `row` are its first */
static void scale_block(CpsiSparseProgram *program, int k, int cone, int row) {
    const CpsiBlock *block = &program->data.block[k];
    const CpsiCones *cones = &program->cones;
    const int n = block->unknowns;
    double *out = &program->a[program->at[k]];
    for (int c = 0, i = 0; c < block->cones; i += block->dim[c++]) {
        const int d = block->dim[c];
        const double *w = &cones->w[row + i], root = sqrt(cones->g[cone + c]);
        /* W^-1: the first row is (Jw).A, the others A_r + w_r (-A_0 + w1.A1/(1 + w0)) */
        for (int j = 0; j <= n; j++) {
            const double *a = j < n ? &block->a[(size_t)i*(size_t)n + (size_t)j] : &block->b[i];
            double *to = j < n ? &out[(size_t)i*(size_t)n + (size_t)j] : &program->b[row + i], along = 0;
            const size_t step = j < n ? (size_t)n : 1;
            if (d == 1) {
                to[0] = root*a[0];
                continue;
            }
            for (int r = 1; r < d; r++) along += w[r]*a[(size_t)r*step];
            to[0] = root*(w[0]*a[0] - along);
            const double rest = along/(1 + w[0]) - a[0];
            for (int r = 1; r < d; r++) to[(size_t)r*step] = root*(a[(size_t)r*step] + w[r]*rest);
        }
    }
}

static void cones_scale(CpsiProgram *base) {
    CpsiSparseProgram *program = sparse(base);
    cpsi_cones_scale(&program->cones);
    for (int k = 0, cone = 0, row = 0; k < program->data.blocks; k++) {
        scale_block(program, k, cone, row);
        cone += program->data.block[k].cones, row += program->data.block[k].rows;
    }
}

static void cones_load(CpsiProgram *base, double keep) {
    CpsiSparseProgram *program = sparse(base);
    CpsiCones *cones = &program->cones;
    double *y = &base->du[program->data.unknowns + program->data.equations + 1];
    for (int k = 0, i = 0; k < cones->count; i += cones->dim[k++]) {
        const double root = sqrt(cones->g[k]);
        cpsi_cones_apply(cones, k, i, 1, 1/root, &cones->q[i], &y[i]);
        cpsi_cones_apply(cones, k, i, -1, keep*root, &cones->rho[i], cones->scratch);
        for (int r = 0; r < cones->dim[k]; r++) y[i + r] -= cones->scratch[r];
    }
}

static void cones_direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    (void)predictor; /* the corrector forms the second-order term itself */
    CpsiSparseProgram *program = sparse(base);
    CpsiCones *cones = &program->cones;
    const int first = program->data.unknowns + program->data.equations;
    const double d_tau = base->du[first];
    cpsi_sparse_blocks_multiply(program, false, base->du, cones->ds);
    for (int k = 0, i = 0; k < program->data.blocks; k++)
        for (int r = 0; r < program->data.block[k].rows; r++, i++)
            cones->ds[i] += program->data.block[k].b[r]*d_tau + keep*cones->rho[i];
    for (int k = 0, i = 0; k < cones->count; i += cones->dim[k++])
        cpsi_cones_apply(cones, k, i, -1, sqrt(cones->g[k]), &base->du[first + 1 + i], &cones->dz[i]);
    sums->inverse_step = cpsi_max_nan(sums->inverse_step, cpsi_cones_step(cones));
}

static void cones_correct(CpsiProgram *base, double target) { cpsi_cones_correct(&sparse(base)->cones, target); }
static void cones_advance(CpsiProgram *base, double alpha) { cpsi_cones_advance(&sparse(base)->cones, alpha); }

/* ---- tau, kappa and the skew term ---- */

static void tau_start(CpsiProgram *base, double mu, double margin) {
    (void)margin;
    CpsiSparseProgram *program = sparse(base);
    memset(base->u, 0, (size_t)base->size*sizeof *base->u);
    base->u[program->data.unknowns + program->data.equations] = 1;
    program->kappa = mu;
}

static void keep_best(CpsiSparseProgram *program, CpsiConicOutcome outcome, double gap, double residual) {
    CpsiConicResult *found = &program->found;
    found->iterations++;
    if (!(gap >= 0) || !(gap + residual < found->gap + found->residual)) return;
    found->outcome = outcome, found->gap = gap, found->residual = residual;
    const size_t n = (size_t)(program->data.unknowns + program->data.equations + 1), m = (size_t)program->cones.rows;
    memcpy(program->best, program->base.u, n*sizeof *program->best);
    memcpy(program->best + n, program->cones.s, m*sizeof *program->best);
    memcpy(program->best + n + m, program->cones.z, m*sizeof *program->best);
}

/* How near is the iterate to each of the three ends?  base->residual holds A'z + E'y and E x in their places. */
static void judge(CpsiSparseProgram *program, double gain, double pull, CpsiSums *sums) {
    const CpsiSparseData *d = &program->data;
    const double tau = program->base.u[d->unknowns + d->equations], *force = program->base.residual;
    double dual = 0, ray_dual = 0, ray_primal = 0, equation = 0;
    for (int j = 0; j < d->unknowns; j++) {
        dual = cpsi_max_nan(dual, fabs(force[j] - d->c[j]*tau));
        ray_dual = cpsi_max_nan(ray_dual, fabs(force[j]));
    }
    for (int i = 0; i < d->equations; i++) {
        equation = cpsi_max_nan(equation, fabs(force[d->unknowns + i] + d->h[i]*tau));
        ray_primal = cpsi_max_nan(ray_primal, fabs(force[d->unknowns + i]));
    }
    for (int k = 0, i = 0; k < d->blocks; k++)
        for (int r = 0; r < d->block[k].rows; r++, i++)
            ray_primal = cpsi_max_nan(ray_primal, fabs(program->cones.rho[i] - d->block[k].b[r]*tau));
    const double value = fmin(fabs(gain), fabs(pull))/tau, sz = sums->sz + tau*program->kappa;
    double residual = cpsi_max_nan(cpsi_max_nan(sums->residual, equation), dual)/tau, scale = tau*tau*(1 + value);
    CpsiConicOutcome outcome = CPSI_CONIC_SOLVED;
    if (program->kappa > tau && pull < 0 && ray_dual/-pull < residual) {
        outcome = CPSI_CONIC_INFEASIBLE;
        residual = ray_dual/-pull;
    }
    if (program->kappa > tau && gain < 0 && ray_primal/-gain < residual) {
        outcome = CPSI_CONIC_UNBOUNDED;
        residual = ray_primal/-gain;
    }
    /* a ray is judged by its residual alone */
    if (outcome != CPSI_CONIC_SOLVED) scale = sz/residual;
    sums->residual = residual;
    sums->scale = scale;
    keep_best(program, outcome, sz/scale, residual);
}

static void tau_measure(CpsiProgram *base, CpsiSums *sums) {
    CpsiSparseProgram *program = sparse(base);
    const CpsiSparseData *d = &program->data;
    const int n = d->unknowns, m = d->equations;
    const double *y = base->u + n, tau = base->u[n + m];
    double *residual = base->residual;
    cpsi_sparse_add_transposed(d, 1, y, residual);
    cpsi_sparse_multiply(d, base->u, residual + n);
    const double gain = cpsi_dot(n, d->c, base->u);
    const double pull = blocks_offset(d, program->cones.z) + cpsi_dot(m, d->h, y);
    judge(program, gain, pull, sums);
    sums->weight += 1;
    sums->sz += tau*program->kappa;
    /* the three residuals: of x, of y, of tau */
    for (int j = 0; j < n; j++) residual[j] -= d->c[j]*tau;
    for (int i = 0; i < m; i++) residual[n + i] = -residual[n + i] - d->h[i]*tau;
    residual[n + m] = pull + gain + program->kappa;
}

static void tau_scale(CpsiProgram *base) { sparse(base)->q_tau = -sparse(base)->kappa; }

static void tau_load(CpsiProgram *base, double keep) {
    (void)keep;
    const CpsiSparseProgram *program = sparse(base);
    base->du[program->data.unknowns + program->data.equations] += program->q_tau;
}

static void tau_direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    (void)predictor; /* the corrector forms the second-order term itself */
    (void)keep;
    CpsiSparseProgram *program = sparse(base);
    const int at = program->data.unknowns + program->data.equations;
    const double tau = base->u[at], d_tau = base->du[at];
    program->d_kappa = program->q_tau - program->kappa/tau*d_tau;
    sums->inverse_step = cpsi_max_nan(sums->inverse_step, cpsi_max_nan(-d_tau/tau, -program->d_kappa/program->kappa));
}

static void tau_correct(CpsiProgram *base, double target) {
    CpsiSparseProgram *program = sparse(base);
    const int at = program->data.unknowns + program->data.equations;
    program->q_tau = -program->kappa + (target - base->du[at]*program->d_kappa)/base->u[at];
}

static void tau_advance(CpsiProgram *base, double alpha) { sparse(base)->kappa += alpha*sparse(base)->d_kappa; }

static const CpsiKind CONES = {cones_start, cones_measure, cones_scale, cones_load,
                               cones_direct, cones_correct, NULL, cones_advance};
static const CpsiKind TAU = {tau_start, tau_measure, tau_scale, tau_load, tau_direct, tau_correct, NULL, tau_advance};
static const CpsiKind *const KINDS[] = {&CONES, &TAU};

/* ---- set-up ---- */

static void clear(CpsiProgram *base) { (void)base; /* `factor` writes every entry */ }

static double imbalance(const CpsiProgram *program) {
    (void)program; /* `judge` has counted it */
    return 0;
}

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
        sizes.squares += (size_t)block->rows*n;
        sizes.triangles += n*(n + 1)/2;
        for (int c = 0; c < block->cones; c++)
            if ((size_t)block->dim[c] > sizes.largest) sizes.largest = (size_t)block->dim[c];
    }
    return sizes;
}

static void lay(CpsiArena *arena, CpsiSparseProgram *program, const Sizes *sizes, size_t entries) {
    const CpsiSparseData *d = &program->data;
    const size_t size = (size_t)d->unknowns + (size_t)d->equations, rows = sizes->rows, all = size + rows;
    cpsi_cones_layout(arena, &program->cones, (int)rows, (int)sizes->cones, (int)sizes->largest);
    program->dim = CPSI_TAKE(arena, sizes->cones, int);
    program->a = CPSI_TAKE(arena, sizes->squares, double);
    program->b = CPSI_TAKE(arena, rows, double);
    program->at = CPSI_TAKE(arena, 2*(size_t)d->blocks, size_t);
    program->value = CPSI_TAKE(arena, entries, double);
    program->regular = CPSI_TAKE(arena, size, double);
    program->sign = CPSI_TAKE(arena, size, signed char);
    double *vectors = CPSI_TAKE(arena, 5*(all + 1), double);
    double *loop = CPSI_TAKE(arena, 4*(all + 1), double);
    program->best = CPSI_TAKE(arena, all + 1 + rows, double);
    if (!loop) return;
    program->place = program->at + d->blocks;
    CpsiTriple *const vector[] = {&program->right, &program->left, &program->fix, &program->turned, &program->answer};
    for (int k = 0; k < 5; k++, vectors += all + 1)
        *vector[k] = (CpsiTriple){vectors, vectors + d->unknowns, vectors + size, vectors + all};
    program->base = (CpsiProgram){.size = (int)all + 1, .load = loop, .u = loop + all + 1, .du = loop + 2*(all + 1),
                                  .residual = loop + 3*(all + 1), .kind_count = 2, .kind = KINDS, .clear = clear,
                                  .factor = cpsi_sparse_factor, .solve = cpsi_sparse_solve, .imbalance = imbalance};
    program->cones.dim = program->dim;
}

/* Fill what does not change: dims, places, signs, and the entries of E. */
static void fill(CpsiSparseProgram *program) {
    const CpsiSparseData *d = &program->data;
    int *dim = program->dim;
    size_t at = 0, place = 0;
    for (int k = 0; k < d->blocks; k++) {
        const CpsiBlock *block = &d->block[k];
        memcpy(dim, block->dim, (size_t)block->cones*sizeof *dim);
        dim += block->cones;
        program->at[k] = at, program->place[k] = place;
        at += (size_t)block->rows*(size_t)block->unknowns;
        place += (size_t)block->unknowns*((size_t)block->unknowns + 1)/2;
    }
    int first = 0;
    for (int k = 0; k < d->blocks; k++) first += d->block[k].unknowns;
    program->free_place = place;
    place += (size_t)(d->unknowns - first);
    for (int i = 0; i < d->equations; i++, place++)
        for (size_t e = d->start[i]; e < d->start[i + 1]; e++) program->value[place++] = d->value[e];
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
    for (; column < d->unknowns; column++) start[column] = at, index[at++] = column;
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
    size_t *start = malloc(((size_t)size + 1)*sizeof *start), factor_entries = 0;
    int *index = malloc((entries + 1)*sizeof *index);
    if (start && index) {
        write_pattern(d, start, index);
        const CpsiPattern pattern = {.n = size, .start = start, .index = index};
        program->ldl = cpsi_ldl_new(&pattern, MOST_ENTRIES, &factor_entries);
    }
    free(start);
    free(index);
    if (program->ldl) return CPS_OK;
    if (factor_entries > MOST_ENTRIES)
        return cpsi_fail(
            err, CPS_ERR_LIMIT,
            "the system's factor would have %zu entries, at most %zu: the laws or constraints tie too many "
            "parameters to each other",
            factor_entries, MOST_ENTRIES);
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a system of %d unknowns", size);
}

CpsStatus cpsi_sparse_program_new(const CpsiSparseData *data, CpsiSparseProgram **out, CpsError *err) {
    const Sizes sizes = measure_blocks(data);
    const size_t all = (size_t)data->unknowns + (size_t)data->equations + sizes.rows;
    size_t entries = sizes.triangles + data->start[data->equations] + (size_t)data->equations;
    int first = 0;
    for (int k = 0; k < data->blocks; k++) first += data->block[k].unknowns;
    entries += (size_t)(data->unknowns - first);
    if (all > INT_MAX/4 || entries > MOST_ENTRIES)
        return cpsi_fail(err, CPS_ERR_LIMIT, "the program has %zu unknowns and %zu entries, more than fits", all,
                         entries);
    CpsiSparseProgram *program = calloc(1, sizeof *program);
    if (!program) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a program");
    program->data = *data;
    lay(&program->arena, program, &sizes, entries);
    CpsStatus status = cpsi_arena_allocate(&program->arena)
                           ? CPS_OK
                           : cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a program of %zu unknowns", all);
    if (status == CPS_OK) {
        lay(&program->arena, program, &sizes, entries);
        fill(program);
        status = analyse(program, entries, err);
    }
    if (status == CPS_OK) *out = program;
    else cpsi_sparse_program_free(program);
    return status;
}

void cpsi_sparse_program_free(CpsiSparseProgram *program) {
    if (!program) return;
    cpsi_ldl_free(program->ldl);
    cpsi_arena_free(&program->arena);
    free(program);
}

/* Choose the regularisation. */
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

CpsiConicResult cpsi_sparse_program_solve(CpsiSparseProgram *program, double accept) {
    const CpsiSparseData *d = &program->data;
    const CpsiIpmOptions options = {.target = TARGET, .scale = DBL_MIN, .max_iterations = MAX_ITERATIONS};
    program->found = (CpsiConicResult){.outcome = CPSI_CONIC_FAILED, .gap = INFINITY, .residual = INFINITY};
    for (size_t k = 0; k < sizeof REGULAR/sizeof *REGULAR; k++) {
        regularise(program, &REGULAR[k]);
        cpsi_ipm_solve(&program->base, &options); /* keeps the best iterate of all */
        double largest = 0;
        for (int j = 0; j < d->unknowns; j++) largest = fmax(largest, fabs(program->best[j]));
        largest /= program->best[d->unknowns + d->equations];
        if (program->found.gap + program->found.residual <= SOUND*(1 + largest)) break;
    }
    CpsiConicResult result = program->found;
    const CpsiConicOutcome ending = result.outcome;
    if (!(result.residual <= accept && result.gap <= accept)) result.outcome = CPSI_CONIC_FAILED;

    /* the best iterate, divided by what normalises it: tau, the pull of the dual ray, the gain of the primal ray */
    const int n = d->unknowns, m = d->equations, rows = program->cones.rows;
    const double *u = program->best, *s = u + n + m + 1, *z = s + rows;
    double by = u[n + m];
    if (ending == CPSI_CONIC_INFEASIBLE) by = -blocks_offset(d, z) - cpsi_dot(m, d->h, u + n);
    if (ending == CPSI_CONIC_UNBOUNDED) by = -cpsi_dot(n, d->c, u);
    for (int j = 0; j < n + m; j++) program->base.u[j] = u[j]/by;
    for (int i = 0; i < rows; i++) program->cones.s[i] = s[i]/by, program->cones.z[i] = z[i]/by;
    if (ending == CPSI_CONIC_SOLVED) {
        cpsi_sparse_polish(program, result.residual);
        result.gap = fabs(cpsi_dot(rows, program->cones.s, program->cones.z));
    }
    return result;
}

const double *cpsi_sparse_program_x(const CpsiSparseProgram *program) { return program->base.u; }
const double *cpsi_sparse_program_y(const CpsiSparseProgram *program) {
    return program->base.u + program->data.unknowns;
}
const double *cpsi_sparse_program_s(const CpsiSparseProgram *program) { return program->cones.s; }
const double *cpsi_sparse_program_z(const CpsiSparseProgram *program) { return program->cones.z; }
