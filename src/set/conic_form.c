/* SPDX-License-Identifier: BSD-3-Clause */
/* From rows to the reduced form (conic_form.h): the equations are eliminated by an orthonormal
 * basis of their null space, the unknowns that appear in no cone become lines of the set or vanish,
 * and the remaining rows are scaled to size one. */
#include "set/conic_form.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/status.h"
#include "ipm/cones.h"
#include "linalg/dense.h"

/* Limits for the number of unknowns and of entries of one matrix in the dense solver. */
static const size_t MOST_UNKNOWNS = 2000, MOST_NUMBERS = 32u << 20;
/* Equations contradict each other where their residual exceeds this share of the size of the
 * data. */
static const double CONTRADICTION = 1e-9;
/* Rounding of constants that cancel each other, some tens of them, relative to the largest. */
static const double ROUNDING = 1e-14;
/* Numbers below this share of their size before an elimination are rounding. */
static const double NOISE = 1e-11;

CpsStatus cpsi_conic_rows_new(CpsiCount count, int used, CpsiConicRows **out, CpsError *err) {
    const size_t width = count.unknowns + 1, high = count.equations + count.rows + 1;
    if (count.unknowns > MOST_UNKNOWNS || high > MOST_NUMBERS / width)
        return cpsi_fail(err, CPS_ERR_LIMIT,
                         "the set's conic form has %zu unknowns and %zu rows; at most %zu unknowns "
                         "and %zu numbers are solved for: use fewer parts or points",
                         count.unknowns, high, MOST_UNKNOWNS, MOST_NUMBERS);
    CpsiConicRows *conic = calloc(1, sizeof *conic);
    if (!conic) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a set's conic form");
    *conic = (CpsiConicRows){.unknowns = (int)count.unknowns,
                             .width = (int)width,
                             .next = used,
                             .max_equations = (int)count.equations,
                             .max_rows = (int)count.rows,
                             .max_cones = (int)count.cones};
    conic->equation = calloc(count.equations * width + 1, sizeof(double));
    conic->row = calloc(count.rows * width + 1, sizeof(double));
    conic->dim = calloc(count.cones + 1, sizeof(int));
    if (!conic->equation || !conic->row || !conic->dim) {
        cpsi_conic_rows_free(conic);
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a set's conic form");
    }
    *out = conic;
    return CPS_OK;
}

void cpsi_conic_rows_free(CpsiConicRows *conic) {
    if (!conic) return;
    free(conic->equation);
    free(conic->row);
    free(conic->dim);
    free(conic);
}

double *cpsi_conic_rows_equation(CpsiConicRows *conic) {
    return &conic->equation[(size_t)conic->equations++ * (size_t)conic->width];
}

double *cpsi_conic_rows_cone(CpsiConicRows *conic, int dim) {
    double *rows = &conic->row[(size_t)conic->rows * (size_t)conic->width];
    conic->dim[conic->cones++] = dim;
    conic->rows += dim;
    return rows;
}

/* ---- reduction ---- */

/* Scratch of a reduction. */
typedef struct RowReduction {
    /* the equations, made orthonormal and completed to a basis (unknowns, unknowns) */
    double *equation, *rhs;
    double *start; /* (unknowns) a solution of the equations */
    /* rows and x over the remaining unknowns, affine: (rows, left + 1), (n, left + 1) */
    double *rows, *map;
    double *span;  /* orthonormal basis of the row space, completed */
    double *lines; /* (lines + left, n) */
    double *reach; /* (n) previous size of the rows of x */
    double length; /* largest constant of a row of size one */
} RowReduction;

static void layout_work(CpsiArena *arena, RowReduction *work, const CpsiConicRows *conic, int n,
                        int lines) {
    const size_t u = (size_t)conic->unknowns, w = u + 1;
    const size_t equations = conic->equations > conic->unknowns ? (size_t)conic->equations : u;
    const size_t rows = conic->rows > conic->unknowns ? (size_t)conic->rows : u;
    CPSI_PLACE(arena, work->equation, equations * u);
    CPSI_PLACE(arena, work->rhs, equations);
    CPSI_PLACE(arena, work->start, u);
    CPSI_PLACE(arena, work->rows, (size_t)conic->rows * w);
    CPSI_PLACE(arena, work->map, (size_t)n * w);
    CPSI_PLACE(arena, work->reach, n);
    CPSI_PLACE(arena, work->span, rows * u);
    CPSI_PLACE(arena, work->lines, ((size_t)lines + u) * (size_t)n);
}

/* Express rows (count, from + 1) over v as rows over t, v = start + basis' t, basis (to, from);
 * basis NULL is the identity. */
static void substitute(int count, int from, int to, const double *start, const double *basis,
                       const double *in, double *out) {
    for (int i = 0; i < count; i++) {
        const double *row = &in[(size_t)i * ((size_t)from + 1)];
        double *image = &out[(size_t)i * ((size_t)to + 1)];
        const double constant = row[from] + (start ? cpsi_dot(from, row, start) : 0);
        for (int j = 0; j < to; j++)
            image[j] = basis ? cpsi_dot(from, row, &basis[(size_t)j * (size_t)from]) : row[j];
        image[to] = constant;
    }
}

/* Solve the equations: `start`, and a basis of their null space in the rows of work->equation after
 * the first `rank`. Returns the rank, or -1. */
static int eliminate(const CpsiConicRows *conic, RowReduction *work, double tolerance) {
    const int u = conic->unknowns;
    double largest = 0, noise = 0;
    for (int i = 0; i < conic->equations; i++) {
        const double *row = &conic->equation[(size_t)i * (size_t)conic->width];
        memcpy(&work->equation[(size_t)i * (size_t)u], row, (size_t)u * sizeof *row);
        work->rhs[i] = -row[u];
        const double size = cpsi_norm(u, row);
        noise = fmax(noise, ROUNDING * conic->constant / (size > 0 ? size : 1));
        if (size > 0)
            largest = fmax(largest, fabs(row[u]) / size);
        else if (fabs(row[u]) > noise)
            return -1;
    }
    for (int k = 0, i = 0; k < conic->cones; k++) {
        double size = 0, constant = 0;
        for (int r = 0; r < conic->dim[k]; r++, i++) {
            const double *row = &conic->row[(size_t)i * (size_t)conic->width];
            size = fmax(size, cpsi_norm(u, row));
            constant = fmax(constant, fabs(row[u]));
        }
        if (size > 0) largest = fmax(largest, constant / size);
    }
    work->length = largest;
    const int rank =
        cpsi_orthonormal_rows(conic->equations, u, work->equation, work->rhs, tolerance);
    for (int i = rank; i < conic->equations; i++)
        if (fabs(work->rhs[i]) > CONTRADICTION * largest + noise) return -1;
    memset(work->start, 0, (size_t)u * sizeof *work->start);
    for (int k = 0; k < rank; k++)
        for (int j = 0; j < u; j++)
            work->start[j] += work->rhs[k] * work->equation[(size_t)k * (size_t)u + (size_t)j];
    if (rank > 0) cpsi_complete_rows(rank, u, work->equation);
    return rank;
}

CpsiConicForm *cpsi_conic_form_new(int n, int unknowns, int lines, int rows, int cones) {
    CpsiConicForm *form = calloc(1, sizeof *form);
    if (!form) return NULL;
    const size_t nn = (size_t)n, u = (size_t)unknowns, m = (size_t)rows;
    *form = (CpsiConicForm){.n = n, .unknowns = unknowns, .lines = lines, .size = 1};
    form->dim = calloc((size_t)cones + 1, sizeof(int));
    form->origin = calloc(nn + nn * u + nn * (size_t)lines + m * u + m + 1, sizeof(double));
    if (!form->dim || !form->origin) {
        cpsi_conic_form_free(form);
        return NULL;
    }
    form->p = form->origin + n;
    form->q = form->p + nn * u;
    form->a = form->q + nn * (size_t)lines;
    form->b = form->a + m * u;
    return form;
}

void cpsi_conic_form_free(CpsiConicForm *form) {
    if (!form) return;
    free(form->dim);
    free(form->origin);
    free(form);
}

/* Whether rows (dim, left + 1) without unknowns lie in their cone, up to `slack`. */
static bool constant_holds(const double *rows, int dim, int left, double slack) {
    const size_t w = (size_t)left + 1;
    double r = 0;
    for (int i = 1; i < dim; i++) r = hypot(r, rows[(size_t)i * w + (size_t)left]);
    return rows[left] - r >= -slack;
}

/* Copy the cones that contain an unknown, each scaled to size one, and determine the unit of v. */
static void collect_cones(const CpsiConicRows *conic, int left, const double *rows, double length,
                          CpsiConicForm *form) {
    const size_t w = (size_t)left + 1;
    double size = 0;
    CPSI_FOR_CONES(k, i, conic->cones, conic->dim) {
        const int d = conic->dim[k];
        double most = 0, shift = 0, before = 0;
        for (int r = i; r < i + d; r++) {
            before = fmax(before, cpsi_norm(conic->unknowns,
                                            &conic->row[(size_t)r * (size_t)conic->width]));
            most = fmax(most, cpsi_norm(left, &rows[(size_t)r * w]));
            shift = fmax(shift, fabs(rows[(size_t)r * w + (size_t)left]));
        }
        /* a row whose elimination leaves less than this share is rounding */
        if (!(most > NOISE * before)) {
            if (!constant_holds(&rows[(size_t)i * w], d, left, CONTRADICTION * before * length))
                form->empty = true;
            continue;
        }
        form->dim[form->cones++] = d;
        if (d > form->largest_cone) form->largest_cone = d;
        size = fmax(size, shift / most);
        for (int r = i; r < i + d; r++, form->rows++) {
            for (int j = 0; j < left; j++)
                form->a[form->rows * left + j] = rows[(size_t)r * w + (size_t)j] / most;
            form->b[form->rows] = rows[(size_t)r * w + (size_t)left] / most;
        }
    }
    form->size = size > 0 ? size : 1;
    for (int i = 0; i < form->rows; i++) form->b[i] /= form->size;
}

/* The form over the remaining unknowns t, in which rows and map are affine. */
static CpsiConicForm *assemble(const CpsiConicRows *conic, int n, int left, int lines,
                               const double *rows, const double *map, const double *q,
                               double length) {
    CpsiConicForm *form = cpsi_conic_form_new(n, left, lines, conic->rows, conic->cones);
    if (!form) return NULL;
    collect_cones(conic, left, rows, length, form);
    memcpy(form->q, q, (size_t)lines * (size_t)n * sizeof *q);
    for (int i = 0; i < n; i++) {
        form->origin[i] = map[(size_t)i * ((size_t)left + 1) + (size_t)left];
        if (fabs(form->origin[i]) < ROUNDING * conic->constant) form->origin[i] = 0;
        for (int j = 0; j < left; j++)
            form->p[(size_t)i * (size_t)left + (size_t)j] =
                map[(size_t)i * ((size_t)left + 1) + (size_t)j] * form->size;
    }
    /* remove the components along the lines, which are represented already */
    for (int l = 0; l < lines; l++)
        for (int j = -1; j < left; j++) {
            double *column = j < 0 ? form->origin : &form->p[j], along = 0;
            const size_t step = j < 0 ? 1 : (size_t)left;
            for (int i = 0; i < n; i++) along += q[l * n + i] * column[(size_t)i * step];
            for (int i = 0; i < n; i++) column[(size_t)i * step] -= along * q[l * n + i];
        }
    return form;
}

/* An orthonormal basis in work->span of the row space, and the lines of x that the other unknowns
 * generate. Returns the dimension of the row space; *lines increases. */
static int split(const CpsiConicRows *conic, int n, int left, RowReduction *work, int *lines) {
    const size_t l = (size_t)left, w = l + 1;
    for (int i = 0; i < n; i++) {
        double *row = &work->map[(size_t)i * w];
        if (!(cpsi_norm(left, row) > NOISE * work->reach[i])) memset(row, 0, l * sizeof *row);
    }
    for (int i = 0; i < conic->rows; i++) {
        double *row = &work->rows[(size_t)i * w];
        const double before =
            cpsi_norm(conic->unknowns, &conic->row[(size_t)i * (size_t)conic->width]);
        if (!(cpsi_norm(left, row) > NOISE * before)) memset(row, 0, l * sizeof *row);
        /* whether a remaining row is rounding is decided by its size before */
        for (size_t j = 0; j < l; j++)
            work->span[(size_t)i * l + j] = before > 0 ? row[j] / before : 0;
    }
    const int seen = cpsi_orthonormal_span(conic->rows, left, work->span, NULL, NOISE);
    if (seen == left) return seen;
    cpsi_complete_rows(seen, left, work->span);
    for (int k = seen; k < left; k++) {
        double *line = &work->lines[(size_t)*lines * (size_t)n];
        double most = 0;
        for (int i = 0; i < n; i++) {
            const double *map = &work->map[(size_t)i * w];
            line[i] = cpsi_dot(left, map, &work->span[(size_t)k * l]);
            most = fmax(most, cpsi_norm(left, map));
        }
        if (cpsi_norm(n, line) > NOISE * most) ++*lines;
    }
    *lines = cpsi_orthonormal_rows(*lines, n, work->lines, NULL, NOISE);
    return seen;
}

CpsStatus cpsi_conic_form_reduce(const CpsiConicRows *conic, int n, const double *x, int lines,
                                 const double *q, double tolerance, CpsiConicForm **out,
                                 CpsError *err) {
    CpsiArena arena = {0};
    RowReduction work;
    layout_work(&arena, &work, conic, n, lines);
    if (!cpsi_arena_allocate(&arena))
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a set's conic form");
    layout_work(&arena, &work, conic, n, lines);

    CpsiConicForm *form;
    if (lines > 0) memcpy(work.lines, q, (size_t)lines * (size_t)n * sizeof *q);
    const int u = conic->unknowns, rank = eliminate(conic, &work, tolerance);
    if (rank < 0) {
        form = cpsi_conic_form_new(n, 0, 0, 0, 0);
        if (form) form->empty = true;
    } else {
        /* restrict to the null space of the equations, then to the part of it that the cones depend
         * on */
        const int left = u - rank;
        const double *basis = rank > 0 ? &work.equation[(size_t)rank * (size_t)u] : NULL;
        substitute(conic->rows, u, left, work.start, basis, conic->row, work.rows);
        substitute(n, u, left, work.start, basis, x, work.map);
        for (int i = 0; i < n; i++)
            work.reach[i] = cpsi_norm(u, &x[(size_t)i * (size_t)conic->width]);
        const int seen = split(conic, n, left, &work, &lines);
        /* the narrower rows are written before the rows that are still to be read */
        if (seen < left) {
            double *scratch = work.start;
            for (int part = 0; part < 2; part++) {
                double *rows = part ? work.map : work.rows;
                for (int i = 0; i < (part ? n : conic->rows); i++) {
                    substitute(1, left, seen, NULL, work.span,
                               &rows[(size_t)i * ((size_t)left + 1)], scratch);
                    memcpy(&rows[(size_t)i * ((size_t)seen + 1)], scratch,
                           ((size_t)seen + 1) * sizeof *rows);
                }
            }
        }
        form = assemble(conic, n, seen, lines, work.rows, work.map, work.lines, work.length);
    }
    cpsi_arena_free(&arena);
    if (!form) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a set's conic form");
    *out = form;
    return CPS_OK;
}
