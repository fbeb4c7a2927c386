/* SPDX-License-Identifier: BSD-3-Clause */
/* The conic program of a shared force (inf_convolution.h).
 *
 * Unknowns y: for each share the v of its set's form and the part of t in each piece; the last one
 * is r, an upper bound of the quadratic costs.
 *
 *     A_i v_i + b_i t_i in K_i        0 <= part <= width
 *         (r + 1/2, r - 1/2, sqrt(curvature) part, ..) in K
 *     E y = sum over i of (origin_i t_i + P_i v_i) = F
 *
 * The equations are restricted to the space that the sets span beside their lines, and eliminated;
 * their multipliers are minus the velocity. Forces are divided by |F|, v_i by the share's unit,
 * parts by their width, costs by `energy`. */
#include "law/inf_convolution.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/status.h"
#include "conic/dense_program.h"
#include "linalg/dense.h"

/* Directions that differ by less are the same: the forms are accurate to 1e-11. */
static const double SAME = 1e-10;
/* A force is not in the space of the sets where its distance from it, relative to its length, is
 * larger than this. */
static const double BESIDE = 1e-9;
/* The caller checks the result by closed forms. Results with larger residuals are rejected, since
 * they cannot be distinguished from failures. */
static const double ACCEPT = 1e-9;
/* Limits for the unknowns and for the numbers in one matrix of a dense solver; the same as for a
 * set's form. */
static const size_t MOST_UNKNOWNS = 2000, MOST_NUMBERS = 32u << 20;

typedef struct Program {
    int n, unknowns, rows, cones, largest, lines, rank, left;
    double force_unit, energy;
    /* (unknowns + lines, n): rows of lines, then of the space that the sets span */
    double *space;
    double *column;         /* (n, unknowns + 1): E, and the remainder to F */
    double *equation, *rhs; /* (rank, unknowns) E in the basis of the space */
    double *basis;  /* (unknowns, unknowns): the equations orthonormalised, then their null space */
    double *normal; /* (3 n n + 2 n) scratch of the normal equations */
    double *start;  /* (unknowns) */
    double *row, *offset;     /* (rows, unknowns) */
    double *cost;             /* (unknowns) */
    double *row_left, *b, *c; /* the same restricted to the null space */
    double *y, *w;            /* (unknowns) */
    int *dim;
} Program;

static double width_of(const CpsiShare *share, int piece) {
    const double width = share->node[piece + 1] - share->node[piece];
    return isinf(width) ? share->unit : width;
}

/* curvature x width^2/energy: twice the quadratic part of the cost of a full piece */
static double bend(const CpsiShare *share, int piece, double energy) {
    if (isinf(share->node[piece + 1])) return 0;
    return fmax(share->before[piece] - share->after[piece], 0) * width_of(share, piece) / energy;
}

static void count_up(Program *p, int count, const CpsiShare *share) {
    int quadratic = 2;
    p->unknowns = 1;
    for (int i = 0; i < count; i++) {
        const CpsiConicForm *form = share[i].form;
        p->unknowns += form->unknowns + share[i].pieces;
        p->rows += form->rows;
        p->cones += form->cones;
        p->lines += form->lines;
        if (form->largest_cone > p->largest) p->largest = form->largest_cone;
        for (int k = 0; k < share[i].pieces; k++) {
            const int bounds = isinf(share[i].node[k + 1]) ? 1 : 2;
            p->rows += bounds;
            p->cones += bounds;
            quadratic += bend(&share[i], k, p->energy) > 0;
        }
    }
    p->rows += quadratic;
    p->cones++;
    if (quadratic > p->largest) p->largest = quadratic;
}

static void layout(CpsiArena *arena, Program *p) {
    const size_t u = (size_t)p->unknowns, n = (size_t)p->n, m = (size_t)p->rows;
    CPSI_PLACE(arena, p->space, (u + (size_t)p->lines + 1) * n);
    CPSI_PLACE(arena, p->column, n * (u + 1));
    CPSI_PLACE(arena, p->equation, n * u);
    CPSI_PLACE(arena, p->rhs, n);
    CPSI_PLACE(arena, p->basis, u * u);
    CPSI_PLACE(arena, p->normal, 3 * n * n + 2 * n);
    CPSI_PLACE(arena, p->start, u);
    CPSI_PLACE(arena, p->row, m * u);
    CPSI_PLACE(arena, p->row_left, m * u);
    CPSI_PLACE(arena, p->offset, m);
    CPSI_PLACE(arena, p->b, m);
    CPSI_PLACE(arena, p->cost, u);
    CPSI_PLACE(arena, p->c, u);
    CPSI_PLACE(arena, p->y, u);
    CPSI_PLACE(arena, p->w, u);
    CPSI_PLACE(arena, p->dim, p->cones);
}

/* ---- writing ---- */

/* E, and F less the forces at y = 0 */
static void write_columns(Program *p, int count, const CpsiShare *share, const double *force) {
    const size_t u = (size_t)p->unknowns, n = (size_t)p->n;
    for (size_t a = 0; a < n; a++) {
        double *row = &p->column[a * (u + 1)];
        size_t at = 0;
        row[u] = force[a] / p->force_unit;
        for (int i = 0; i < count; i++) {
            const CpsiConicForm *form = share[i].form;
            const double unit = share[i].unit / p->force_unit,
                         origin = form->origin[a] / p->force_unit;
            for (int j = 0; j < form->unknowns; j++)
                row[at++] = form->p[a * (size_t)form->unknowns + (size_t)j] * unit;
            for (int k = 0; k < share[i].pieces; k++) row[at++] = origin * width_of(&share[i], k);
            row[u] -= origin * share[i].node[0];
        }
    }
}

/* the next cone, of `dim` rows; returns the index of its first row */
static size_t next_cone(int dim, int *rows, int *cones, int *dims) {
    const int first = *rows;
    dims[(*cones)++] = dim;
    *rows += dim;
    return (size_t)first;
}

static void write_rows(Program *p, int count, const CpsiShare *share) {
    const size_t u = (size_t)p->unknowns;
    int rows = 0, cones = 0, quadratic = 2;
    size_t at = 0;
    for (int i = 0; i < count; at += (size_t)(share[i].form->unknowns + share[i].pieces), i++) {
        const CpsiConicForm *form = share[i].form;
        const size_t v = (size_t)form->unknowns;
        for (int k = 0, r = 0; k < form->cones; k++) {
            const size_t first = next_cone(form->dim[k], &rows, &cones, p->dim);
            for (size_t d = 0; d < (size_t)form->dim[k]; d++, r++) {
                double *row = &p->row[(first + d) * u + at];
                memcpy(row, &form->a[(size_t)r * v], v * sizeof *row);
                for (int j = 0; j < share[i].pieces; j++)
                    row[v + (size_t)j] = form->b[r] * width_of(&share[i], j) / share[i].unit;
                p->offset[first + d] = form->b[r] * share[i].node[0] / share[i].unit;
            }
        }
        for (int k = 0; k < share[i].pieces; k++) {
            p->row[next_cone(1, &rows, &cones, p->dim) * u + at + v + (size_t)k] = 1;
            p->cost[at + v + (size_t)k] = share[i].after[k] * width_of(&share[i], k) / p->energy;
            if (isinf(share[i].node[k + 1])) continue;
            const size_t bound = next_cone(1, &rows, &cones, p->dim);
            p->row[bound * u + at + v + (size_t)k] = -1;
            p->offset[bound] = 1;
        }
    }
    const size_t first = (size_t)rows;
    p->row[first * u + u - 1] = p->row[(first + 1) * u + u - 1] = 1;
    p->offset[first] = 0.5;
    p->offset[first + 1] = -0.5;
    p->cost[u - 1] = 1;
    at = 0;
    for (int i = 0; i < count; at += (size_t)share[i].pieces, i++) {
        at += (size_t)share[i].form->unknowns;
        for (int k = 0; k < share[i].pieces; k++) {
            const double b = bend(&share[i], k, p->energy);
            if (b > 0) p->row[(first + (size_t)quadratic++) * u + at + (size_t)k] = sqrt(b);
        }
    }
    p->dim[cones] = quadratic;
}

/* ---- the equations ---- */

/* The equations in an orthonormal basis of the spanned space beside lines. Returns false where F is
 * not in it. */
static bool write_equations(Program *p, int count, const CpsiShare *share) {
    const size_t u = (size_t)p->unknowns, n = (size_t)p->n;
    int lines = 0;
    for (int i = 0; i < count; i++) {
        memcpy(&p->space[(size_t)lines * n], share[i].form->q,
               (size_t)share[i].form->lines * n * sizeof *p->space);
        lines += share[i].form->lines;
    }
    lines = cpsi_orthonormal_rows(lines, p->n, p->space, NULL, SAME);
    double *reached = &p->space[(size_t)lines * n];
    for (size_t j = 0; j < u; j++)
        for (size_t a = 0; a < n; a++) reached[j * n + a] = p->column[a * (u + 1) + j];
    for (size_t j = 0; j < u; j++)
        for (int l = 0; l < lines; l++) {
            const double along = cpsi_dot(p->n, &reached[j * n], &p->space[(size_t)l * n]);
            for (size_t a = 0; a < n; a++)
                reached[j * n + a] -= along * p->space[(size_t)l * n + a];
        }
    p->rank = cpsi_orthonormal_rows(p->unknowns, p->n, reached, NULL, SAME);

    double square = 0, within = 0;
    for (size_t a = 0; a < n; a++)
        square += p->column[a * (u + 1) + u] * p->column[a * (u + 1) + u];
    for (size_t k = 0; k < (size_t)lines + (size_t)p->rank; k++) {
        double sum = 0;
        for (size_t a = 0; a < n; a++) sum += p->space[k * n + a] * p->column[a * (u + 1) + u];
        within += sum * sum;
        if (k < (size_t)lines) continue;
        const size_t e = k - (size_t)lines;
        p->rhs[e] = sum;
        for (size_t j = 0; j < u; j++)
            for (size_t a = 0; a < n; a++)
                p->equation[e * u + j] += p->space[k * n + a] * p->column[a * (u + 1) + j];
    }
    p->lines = lines;
    return square - within <= BESIDE * fmax(square, BESIDE);
}

/* Eliminate: y = start + sum over k of v_k basis_(rank + k). */
static void eliminate(Program *p) {
    const size_t u = (size_t)p->unknowns;
    double *rhs = p->normal;
    memcpy(p->basis, p->equation, (size_t)p->rank * u * sizeof *p->basis);
    memcpy(rhs, p->rhs, (size_t)p->rank * sizeof *rhs);
    const int rank = cpsi_orthonormal_rows(p->rank, p->unknowns, p->basis, rhs, 0);
    for (size_t k = 0; k < (size_t)rank; k++)
        for (size_t j = 0; j < u; j++) p->start[j] += rhs[k] * p->basis[k * u + j];
    cpsi_complete_rows(rank, p->unknowns, p->basis);
    p->left = p->unknowns - rank;
    const double *free_part = &p->basis[(size_t)rank * u];
    for (size_t i = 0; i < (size_t)p->rows; i++) {
        const double *row = &p->row[i * u];
        for (size_t j = 0; j < (size_t)p->left; j++)
            p->row_left[i * (size_t)p->left + j] = cpsi_dot(p->unknowns, row, &free_part[j * u]);
        p->b[i] = p->offset[i] + cpsi_dot(p->unknowns, row, p->start);
    }
    for (size_t j = 0; j < (size_t)p->left; j++)
        p->c[j] = cpsi_dot(p->unknowns, p->cost, &free_part[j * u]);
}

/* ---- reading ---- */

static void read_forces(const Program *p, int count, CpsiShare *share) {
    const size_t u = (size_t)p->unknowns, n = (size_t)p->n;
    size_t at = 0;
    for (int i = 0; i < count; i++) {
        const CpsiConicForm *form = share[i].form;
        const size_t v = (size_t)form->unknowns;
        share[i].t = share[i].node[0];
        for (int k = 0; k < share[i].pieces; k++)
            share[i].t += p->y[at + v + (size_t)k] * width_of(&share[i], k);
        for (size_t a = 0; a < n; a++)
            share[i].force[a] =
                p->force_unit * cpsi_dot(form->unknowns, &p->column[a * (u + 1) + at], &p->y[at]) +
                form->origin[a] * share[i].t;
        at += v + (size_t)share[i].pieces;
    }
}

/* The multipliers of the equations from the residual of the stationarity: E E' lambda = E (c -
 * A'z). */
static bool read_velocity(const Program *p, const double *z, double scale, double *velocity) {
    const size_t u = (size_t)p->unknowns, k = (size_t)p->rank;
    double *square = p->normal, *factor = square + k * k, *inverse = factor + k * k,
           *pull = inverse + k * k;
    double *lambda = pull + k;
    memcpy(p->w, p->cost, u * sizeof *p->w);
    for (size_t i = 0; i < (size_t)p->rows; i++)
        for (size_t j = 0; j < u; j++) p->w[j] -= scale * z[i] * p->row[i * u + j];
    for (size_t i = 0; i < k; i++) {
        pull[i] = cpsi_dot(p->unknowns, &p->equation[i * u], p->w);
        for (size_t j = 0; j < k; j++)
            square[i * k + j] = cpsi_dot(p->unknowns, &p->equation[i * u], &p->equation[j * u]);
    }
    if (!cpsi_cholesky(p->rank, square, factor)) return false;
    cpsi_lower_inverse(p->rank, factor, inverse);
    memset(velocity, 0, (size_t)p->n * sizeof *velocity);
    for (size_t i = 0; i < k; i++) lambda[i] = cpsi_dot((int)i + 1, &inverse[i * k], pull);
    for (size_t i = 0; i < k; i++) {
        double sum = 0;
        for (size_t j = i; j < k; j++) sum += inverse[j * k + i] * lambda[j];
        for (size_t a = 0; a < (size_t)p->n; a++)
            velocity[a] -= sum * p->energy / p->force_unit *
                           p->space[((size_t)p->lines + i) * (size_t)p->n + a];
    }
    for (int a = 0; a < p->n; a++)
        if (!isfinite(velocity[a])) return false;
    return true;
}

static CpsSetOutcome solve(Program *p, CpsiConicProgram *conic, int count, CpsiShare *share,
                           double *velocity) {
    const double size = cpsi_norm(p->left, p->c), scale = size > 0 ? size : 1;
    for (int j = 0; j < p->left; j++) p->c[j] /= scale;
    conic->data = (CpsiConicData){.dim = p->dim, .a = p->row_left, .b = p->b, .c = p->c};
    const CpsiConicResult result = cpsi_conic_solve(conic, ACCEPT);
    if (result.outcome == CPSI_CONIC_INFEASIBLE) return CPS_SET_OUTCOME_OUTSIDE;
    if (result.outcome == CPSI_CONIC_UNBOUNDED) return CPS_SET_OUTCOME_INACCURATE;
    memcpy(p->y, p->start, (size_t)p->unknowns * sizeof *p->y);
    const double *free_part = &p->basis[(size_t)p->rank * (size_t)p->unknowns];
    for (int j = 0; j < p->left; j++)
        for (int i = 0; i < p->unknowns; i++)
            p->y[i] += result.x[j] * free_part[(size_t)j * (size_t)p->unknowns + (size_t)i];
    for (int i = 0; i < p->unknowns; i++)
        if (!isfinite(p->y[i])) return CPS_SET_OUTCOME_INACCURATE;
    read_forces(p, count, share);
    return read_velocity(p, result.z, scale, velocity) ? CPS_SET_OUTCOME_ANSWERED
                                                       : CPS_SET_OUTCOME_INACCURATE;
}

CpsStatus cpsi_inf_convolution(int n, int count, CpsiShare *share, const double *force,
                               double energy, double *velocity, CpsSetOutcome *outcome,
                               CpsError *err) {
    CpsiArena arena = {0};
    Program p = {.n = n, .force_unit = cpsi_norm(n, force), .energy = energy};
    count_up(&p, count, share);
    const size_t unknowns = (size_t)p.unknowns, rows = (size_t)p.rows;
    if (unknowns > MOST_UNKNOWNS || rows > MOST_NUMBERS / unknowns)
        return cpsi_fail(err, CPS_ERR_LIMIT,
                         "sharing the force has %zu unknowns and %zu rows; at most %zu unknowns "
                         "and %zu numbers are solved for: use fewer terms or simpler sets",
                         unknowns, rows, MOST_UNKNOWNS, MOST_NUMBERS);
    layout(&arena, &p);
    if (!cpsi_arena_allocate(&arena))
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory to share a force");
    layout(&arena, &p);
    write_columns(&p, count, share, force);
    write_rows(&p, count, share);
    *outcome = CPS_SET_OUTCOME_OUTSIDE;
    CpsStatus status = CPS_OK;
    if (write_equations(&p, count, share)) {
        eliminate(&p);
        CpsiArena memory = {0};
        (void)cpsi_conic_layout(&memory, p.left, p.rows, p.cones, p.largest);
        if (cpsi_arena_allocate(&memory))
            *outcome = solve(&p, cpsi_conic_layout(&memory, p.left, p.rows, p.cones, p.largest),
                             count, share, velocity);
        else
            status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory to share a force");
        cpsi_arena_free(&memory);
    }
    cpsi_arena_free(&arena);
    return status;
}
