/* SPDX-License-Identifier: BSD-3-Clause */
/* The last digits of a solution: Newton's method on the active constraints, as in dense_polish.c,
 * with a sparse factor.
 *
 * With G the gradients of active cones (active_cone.h), m their multipliers (z of tips, l of rays),
 * stationarity c - A'z - E'y = 0 and E x + h = 0, a step is
 *
 *     [ H  E'  G' ] [ dx]
 *     [ E  0   0  ] [-dy] = - values,     H = sum over rays of (l/|s1|) A1'(1 - n n')A1
 *     [ G  0   0  ] [-dm]
 *
 * which is regular where x, y and z are unique; a small number on the diagonals keeps the other
 * unknowns where they are. Refinement removes it from the others, as in sparse_system.c.
 *
 * For a cone that is hardly active, or whose force is far smaller than the others, the loop may end
 * with the wrong activity. Newton's steps then leave the cone; the side on which they do shows the
 * right activity, and the steps begin again with it. Or the steps do not converge; then the cone
 * whose force they reduce most is tried without force. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/larger.h"
#include "conic/active_cone.h"
#include "conic/sparse_program.h"
#include "linalg/dense.h"

/* The numbers added to the diagonals, in the order tried. Constraints that are weak beside others
 * need a small one. The factor's growth goes with its inverse square, so that on large programs the
 * first can lose all digits; the second loses half of them, which refinement restores. */
static const double EASE[] = {1e-10, 3e-8};
/* A step that leaves more than it is to remove is not one. One that leaves less than this share is
 * good; those between are taken where the other number does no better, since along weak constraints
 * Newton's next steps remove what refinement has left. */
static const double ROUGH = 1, GOOD = 1e-3;
enum { STEPS = 4, ROUNDS = 6 };
/* How often the active cones are chosen, and of a hasty polish. */
enum { TRIALS = 4, FEW_TRIALS = 2 };
/* Refinement ends at this relative residual, below which Newton's method does not converge faster.
 */
static const double REFINED = 1e-12;
/* Residuals of this many roundings of the largest unknown are as good as any. */
static const double ROUNDING = 1e-15;
/* Steps that stay inside their cones and come to this many of them have converged: rounding of the
 * products keeps the residual above the limit before on large programs. */
static const double CONVERGED = 1e-14;
/* Or the residual's own rounding is larger, as where |s1| of a ray is small: a good step does not
 * halve it although it is at most so many times the largest unknown. */
static const double ROUNDED = 1e-13;
/* Limit for the entries of the factor, as for the program itself. */
static const size_t MOST_ENTRIES = (size_t)500 << 20;

typedef struct Polish {
    CpsiSparseProgram *program;
    CpsiActive *active; /* (cones) */
    /* (cones) activity according to the side on which the steps have left the cone */
    CpsiActive *other;
    bool left_some;        /* whether the steps have left a cone */
    bool hasty;            /* then there are no more of them with these activities */
    bool rounded;          /* whether they have come to the rounding of the residual */
    double enough, best;   /* the residual that is good enough, and the smallest accepted so far */
    double unit;           /* 1 + the largest unknown */
    double unsolved;       /* share of the right-hand side that the last system's solution leaves */
    int multipliers, size; /* number of multipliers m; number of all unknowns (x, -y, -m) */
    size_t *start;         /* pattern of the matrix */
    int *index;
    size_t entries;
    double *value;
    double ease;  /* what is added to the diagonals of `value` */
    size_t tried; /* the one of EASE that did best; those before it are not tried again */
    signed char *sign;
    CpsiLdl *ldl;
    double *at, *step, *other_step, *left, *fix; /* (size) */
    double *s, *z;                               /* (rows) at `at` */
} Polish;

/* A loop over cones with their blocks. */
typedef struct ConeLoop {
    int block, x;    /* the block, and its first column */
    int cone, all;   /* index of the cone inside its block, and among all */
    int inside, row; /* its first row inside the block, and among all */
} ConeLoop;

static bool next(const CpsiSparseData *d, ConeLoop *w) {
    w->row += d->block[w->block].dim[w->cone];
    w->inside += d->block[w->block].dim[w->cone];
    w->all++;
    w->cone++;
    while (w->block < d->blocks && w->cone >= d->block[w->block].cones) {
        w->x += d->block[w->block].unknowns;
        w->block++;
        w->cone = 0;
        w->inside = 0;
    }
    return w->block < d->blocks;
}

static void release(Polish *p) {
    cpsi_ldl_free(p->ldl);
    free(p->start);
    free(p->index);
    free(p->value);
    free(p->sign);
    free(p->at);
    p->ldl = NULL;
    p->start = NULL;
    p->index = NULL;
    p->value = NULL;
    p->sign = NULL;
    p->at = NULL;
}

/* Allocate for the present activities, and set the initial point. */
static bool begin(Polish *p) {
    const CpsiSparseProgram *program = p->program;
    const CpsiSparseData *d = &program->data;
    const CpsiCones *cones = &program->core.cones;
    p->entries =
        program->free_place + (size_t)(d->unknowns + d->equations) + d->start[d->equations];
    p->multipliers = 0;
    p->left_some = false;
    p->tried = 0;
    memcpy(p->other, p->active, (size_t)cones->count * sizeof *p->other);
    ConeLoop w = {0};
    for (int k = 0; k < cones->count; k++) {
        const int rows = cpsi_active_count(p->active[k], cones->dim[k]);
        p->multipliers += rows;
        p->entries += (size_t)rows * ((size_t)d->block[w.block].unknowns + 1);
        next(d, &w);
    }
    p->size = d->unknowns + d->equations + p->multipliers;
    const size_t size = (size_t)p->size, rows = (size_t)cones->rows;
    p->start = malloc((size + 1) * sizeof *p->start);
    p->index = malloc((p->entries + 1) * sizeof *p->index);
    p->value = malloc((p->entries + 1) * sizeof *p->value);
    p->sign = malloc(size + 1);
    p->at = calloc(5 * size + 2 * rows + 1, sizeof *p->at);
    if (!p->start || !p->index || !p->value || !p->sign || !p->at) return false;
    p->step = p->at + size;
    p->other_step = p->step + size;
    p->left = p->other_step + size;
    p->fix = p->left + size;
    p->s = p->fix + size;
    p->z = p->s + rows;
    memcpy(p->at, program->core.base.u, (size_t)(d->unknowns + d->equations) * sizeof *p->at);
    double *m = p->at + d->unknowns + d->equations;
    CPSI_FOR_CONES(k, i, cones->count, cones->dim)
        for (int r = 0; r < cpsi_active_count(p->active[k], cones->dim[k]); r++)
            *m++ = cones->z[i + r];
    memset(p->sign, 1, (size_t)d->unknowns);
    memset(p->sign + d->unknowns, -1, size - (size_t)d->unknowns);
    return true;
}

/* s and z at `at`; false where one of them is outside its cone. Cones left by the first step are
 * recorded. */
static bool place(Polish *p) {
    const CpsiSparseData *d = &p->program->data;
    const double *m = p->at + d->unknowns + d->equations;
    bool all_in = true;
    ConeLoop w = {0};
    do {
        const CpsiBlock *block = &d->block[w.block];
        const CpsiActive kind = p->active[w.all];
        const int dim = block->dim[w.cone];
        double *s = &p->s[w.row], *z = &p->z[w.row];
        for (int r = 0; r < dim; r++)
            s[r] =
                block->b[w.inside + r] +
                cpsi_dot(block->unknowns,
                         &block->a[(size_t)(w.inside + r) * (size_t)block->unknowns], &p->at[w.x]);
        memset(z, 0, (size_t)dim * sizeof *z);
        for (int r = 0; r < cpsi_active_count(kind, dim); r++) z[r] = *m++;
        const bool in = cpsi_active_place(kind, s, z, dim);
        if (!in && !p->left_some) p->other[w.all] = cpsi_active_corrected(kind, z, dim);
        all_in &= in;
    } while (next(d, &w));
    p->left_some |= !all_in;
    return all_in;
}

/* left = - values of the equations. Returns the largest absolute value. */
static double values(Polish *p) {
    const CpsiSparseData *d = &p->program->data;
    const int n = d->unknowns, e = d->equations;
    double *left = p->left, *m = left + n + e, most = 0;
    for (int j = 0; j < n; j++) left[j] = -d->c[j];
    cpsi_sparse_add_transposed(d, 1, p->at + n, left);
    cpsi_sparse_blocks_add(p->program, false, 1, p->z, left);
    cpsi_sparse_multiply(d, p->at, left + n);
    for (int i = 0; i < e; i++) left[n + i] = -left[n + i] - d->h[i];
    const CpsiCones *cones = &p->program->core.cones;
    CPSI_FOR_CONES(k, i, cones->count, cones->dim)
        m += cpsi_active_values(p->active[k], &p->s[i], cones->dim[k], m);
    for (int i = 0; i < p->size; i++) most = cpsi_max_nan(most, fabs(left[i]));
    return most;
}

/* The rows of G of one cone, one after the other in `g`. Returns their number. */
static int rows_of(const Polish *p, const ConeLoop *w, double *g) {
    const CpsiBlock *block = &p->program->data.block[w->block];
    const int n = block->unknowns;
    return cpsi_active_gradients(p->active[w->all], n, &block->a[(size_t)w->inside * (size_t)n],
                                 &p->s[w->row], block->dim[w->cone], (size_t)n, g);
}

/* Add the curvature of a ray to its block's triangle. */
static void add_curvature(const Polish *p, const ConeLoop *w, const double *g, double *triangle) {
    const CpsiBlock *block = &p->program->data.block[w->block];
    const int dim = block->dim[w->cone], n = block->unknowns;
    const double *a = &block->a[(size_t)w->inside * (size_t)n];
    const double factor = p->z[w->row] / cpsi_norm(dim - 1, &p->s[w->row + 1]);
    /* n'A1 = a0 - g */
    for (int j = 0; j < n; j++)
        for (int i = 0; i <= j; i++) {
            double sum = -(a[i] - g[i]) * (a[j] - g[j]);
            for (int r = 1; r < dim; r++)
                sum += a[(size_t)r * (size_t)n + (size_t)i] * a[(size_t)r * (size_t)n + (size_t)j];
            *triangle++ += factor * sum;
        }
}

/* Append an entry to the column that is being written. */
static void add_entry(Polish *p, size_t *at, int row, double value) {
    p->index[*at] = row;
    p->value[(*at)++] = value;
}

/* The regularised matrix at the point, with its pattern. Returns false when memory does not
 * suffice. */
static bool write_matrix(Polish *p) {
    const CpsiSparseData *d = &p->program->data;
    size_t at = 0, largest = 1;
    int column = 0;
    for (int k = 0, first = 0; k < d->blocks; first += d->block[k++].unknowns) {
        const size_t size = (size_t)d->block[k].rows * (size_t)d->block[k].unknowns;
        if (size > largest) largest = size;
        for (int j = 0; j < d->block[k].unknowns; j++) {
            p->start[column++] = at;
            for (int i = 0; i <= j; i++) add_entry(p, &at, first + i, i == j ? p->ease : 0);
        }
    }
    for (; column < d->unknowns; column++) {
        p->start[column] = at;
        add_entry(p, &at, column, p->ease);
    }
    for (int i = 0; i < d->equations; i++, column++) {
        p->start[column] = at;
        for (size_t e = d->start[i]; e < d->start[i + 1]; e++)
            add_entry(p, &at, d->column[e], d->value[e]);
        add_entry(p, &at, column, -p->ease);
    }
    double *g = malloc(largest * sizeof *g);
    if (!g) return false;
    ConeLoop w = {0};
    do {
        const int rows = rows_of(p, &w, g), n = d->block[w.block].unknowns;
        if (p->active[w.all] == CPSI_RAY)
            add_curvature(p, &w, g, &p->value[p->program->place[w.block]]);
        for (int r = 0; r < rows; r++, column++) {
            p->start[column] = at;
            for (int j = 0; j < n; j++)
                add_entry(p, &at, w.x + j, g[(size_t)r * (size_t)n + (size_t)j]);
            add_entry(p, &at, column, -p->ease);
        }
    } while (next(d, &w));
    p->start[column] = at;
    free(g);
    return true;
}

/* out -= matrix x, without what eases it */
static void subtract_product(const Polish *p, const double *x, double *out) {
    for (int j = 0; j < p->size; j++)
        for (size_t e = p->start[j]; e < p->start[j + 1]; e++) {
            const int i = p->index[e];
            const double value = i == j ? p->value[e] - p->ease * p->sign[j] : p->value[e];
            out[i] -= value * x[j];
            if (i != j) out[j] -= value * x[i];
        }
}

/* The largest absolute value; NaN where one is. */
static double largest_of(int n, const double *x) {
    double most = 0;
    for (int i = 0; i < n; i++) most = cpsi_max_nan(most, fabs(x[i]));
    return most;
}

/* step = matrix^-1 left with the present factor and iterative refinement. Returns the relative
 * residual. */
static double refine(Polish *p) {
    const size_t size = (size_t)p->size;
    const double whole = largest_of(p->size, p->left);
    double unsolved = whole > 0 ? 1 : 0;
    memset(p->step, 0, size * sizeof *p->step);
    memcpy(p->fix, p->left, size * sizeof *p->fix);
    for (int round = 0; round < ROUNDS && !(unsolved <= REFINED); round++) {
        cpsi_ldl_solve(p->ldl, p->fix);
        for (int i = 0; i < p->size; i++) p->step[i] += p->fix[i];
        memcpy(p->fix, p->left, size * sizeof *p->fix);
        subtract_product(p, p->step, p->fix);
        unsolved = largest_of(p->size, p->fix) / whole;
    }
    return unsolved;
}

/* step = matrix^-1 left; false where no regularisation gives one, or when memory does not
 * suffice. */
static bool solve(Polish *p) {
    p->unsolved = INFINITY;
    for (size_t k = p->tried; k < sizeof EASE / sizeof *EASE && !(p->unsolved <= GOOD); k++) {
        p->ease = EASE[k];
        if (!write_matrix(p)) return false;
        if (!p->ldl) {
            const CpsiPattern pattern = {.n = p->size, .start = p->start, .index = p->index};
            size_t entries;
            p->ldl = cpsi_ldl_new(&pattern, MOST_ENTRIES, &p->program->arena.width, &entries);
        }
        if (!p->ldl) return false;
        if (!cpsi_ldl_factor(p->ldl, p->value, p->sign, 1e-3 * p->ease)) continue;
        memcpy(p->other_step, p->step, (size_t)p->size * sizeof *p->step);
        const double unsolved = refine(p);
        if (unsolved < p->unsolved) {
            p->unsolved = unsolved;
            p->tried = k;
        } else
            memcpy(p->step, p->other_step, (size_t)p->size * sizeof *p->step);
    }
    return p->unsolved <= ROUGH;
}

/* Newton's steps with the present activities. A point is accepted if it is admissible and its
 * residual is no worse than before and no worse than the loop's. Returns false when memory does not
 * suffice. */
static bool polish_steps(Polish *p) {
    CpsiSparseProgram *program = p->program;
    const CpsiSparseData *d = &program->data;
    double so_far = INFINITY, before = INFINITY;
    if (!begin(p)) return false;
    for (int k = 0; k <= STEPS; k++) {
        const bool in = place(p);
        const double now = values(p);
        if (in && now <= p->enough && now < p->best) {
            p->best = now;
            memcpy(program->core.base.u, p->at,
                   (size_t)(d->unknowns + d->equations) * sizeof *p->at);
            memcpy(program->core.cones.s, p->s, (size_t)program->core.cones.rows * sizeof *p->s);
            memcpy(program->core.cones.z, p->z, (size_t)program->core.cones.rows * sizeof *p->z);
        }
        if (in && now <= p->enough) so_far = fmin(so_far, now);
        const bool rounded =
            in && before <= ROUNDED * p->unit && p->unsolved <= GOOD && now > 0.5 * before;
        p->rounded |= rounded;
        before = in ? now : INFINITY;
        if ((p->hasty && !in) || rounded || (in && now <= ROUNDING * p->unit)) break;
        if (k == STEPS || !isfinite(now) || (k > 1 && now > so_far) || !solve(p)) break;
        for (int i = 0; i < p->size; i++) p->at[i] += i < d->unknowns ? p->step[i] : -p->step[i];
    }
    return true;
}

/* For steps that do not converge: assume no force for the cone whose multiplier has lost the
 * largest share, if any has. The program's own z are the initial ones of the steps, or better
 * ones. */
static void doubt(Polish *p) {
    const CpsiCones *cones = &p->program->core.cones;
    double least = 1;
    int which = -1;
    CPSI_FOR_CONES(k, i, cones->count, cones->dim) {
        if (p->active[k] == CPSI_FREE || !(p->z[i] < least * cones->z[i])) continue;
        least = p->z[i] / cones->z[i];
        which = k;
    }
    if (which < 0) return;
    p->other[which] = CPSI_FREE;
    p->left_some = true;
}

CpsiPolished cpsi_sparse_polish(CpsiSparseProgram *program, double merit, bool hasty) {
    const int trials = hasty ? FEW_TRIALS : TRIALS;
    const CpsiCones *cones = &program->core.cones;
    Polish p = {.program = program, .hasty = hasty, .best = INFINITY, .unit = 1};
    for (int j = 0; j < program->data.unknowns; j++)
        p.unit = fmax(p.unit, 1 + fabs(program->core.base.u[j]));
    p.enough = fmax(merit, ROUNDING * p.unit);
    p.active = cones->count > 0 ? malloc(2 * (size_t)cones->count * sizeof *p.active) : NULL;
    if (!p.active) return (CpsiPolished){.residual = INFINITY};
    p.other = p.active + cones->count;
    CPSI_FOR_CONES(k, i, cones->count, cones->dim)
        p.active[k] = cpsi_active(&cones->s[i], &cones->z[i], cones->dim[k]);
    for (int trial = 0; trial < trials; trial++) {
        const bool done = polish_steps(&p), converged = p.best <= ROUNDING * p.unit;
        if (done && !hasty && !p.left_some && !p.rounded && !(p.best <= CONVERGED * p.unit))
            doubt(&p);
        release(&p);
        if (!done || converged || !p.left_some) break;
        memcpy(p.active, p.other, (size_t)cones->count * sizeof *p.active);
    }
    free(p.active);
    return (CpsiPolished){.residual = p.best, .rounded = p.rounded};
}
