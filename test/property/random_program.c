/* SPDX-License-Identifier: BSD-3-Clause */
/* Random conic programs (random_program.h). */
#include "random_program.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../splitmix.h"

enum { MOST_UNKNOWNS = 4, MOST_ROWS = MOST_UNKNOWNS + 2, PER_EQUATION = 4 };

static void *need(void *memory) {
    if (memory) return memory;
    fprintf(stderr, "random_program: no memory\n");
    exit(1);
}

/* Blocks of the first unknowns. */
static void make_blocks(RandomProgram *made, int unknowns, uint64_t *state) {
    double *a = made->a;
    int *dim = made->dim, blocks = 0;
    for (int at = 0; at < unknowns; blocks++) {
        int n = 1 + (int)splitmix(state, 0, MOST_UNKNOWNS);
        if (n > unknowns - at) n = unknowns - at;
        const int cones = 1 + (splitmix(state, 0, 1) < 0.5), rows = n + cones;
        dim[0] = n + 1;
        if (cones > 1) dim[1] = 1;
        for (int i = 0; i < rows * n; i++) a[i] = splitmix(state, -1, 1);
        made->block[blocks] = (CpsiBlock){
            .unknowns = n, .rows = rows, .cones = cones, .dim = dim, .a = a, .b = made->b};
        made->b += rows; /* set back by the caller */
        made->rows += rows;
        a += rows * n;
        dim += cones;
        at += n;
    }
    made->b -= made->rows;
    made->data.blocks = blocks;
}

/* Equations of distinct columns; the last ones repeat those before them. */
static void make_equations(RandomProgram *made, const RandomProgramKind *kind, int equations,
                           uint64_t *state) {
    const int near = RANDOM_PROGRAM_LEAST, width = kind->banded ? near : kind->unknowns;
    for (int i = 0; i < equations; i++) {
        const int first = kind->banded ? (int)((long)i * (kind->unknowns - near) / equations) : 0;
        made->start[i] = (size_t)i * PER_EQUATION;
        if (i >= equations - kind->repeated) {
            const size_t to = made->start[i], from = made->start[i - kind->repeated];
            memcpy(&made->column[to], &made->column[from], PER_EQUATION * sizeof *made->column);
            memcpy(&made->value[to], &made->value[from], PER_EQUATION * sizeof *made->value);
            continue;
        }
        for (int k = 0; k < PER_EQUATION; k++) {
            int *column = &made->column[made->start[i]], fresh;
            do {
                column[k] = first + (int)splitmix(state, 0, width);
                fresh = 1;
                for (int j = 0; j < k; j++) fresh = fresh && column[j] != column[k];
            } while (!fresh);
            made->value[made->start[i] + (size_t)k] = splitmix(state, -1, 1);
        }
    }
    made->start[equations] = (size_t)equations * PER_EQUATION;
}

/* A point inside a cone of this dimension. */
static void inside(int dim, uint64_t *state, double *out) {
    double square = 0;
    for (int r = 1; r < dim; r++) {
        out[r] = splitmix(state, -1, 1);
        square += out[r] * out[r];
    }
    out[0] = sqrt(square) + splitmix(state, 0.1, 1);
}

/* b, c and h such that random interior points are feasible. */
static void make_vectors(RandomProgram *made, uint64_t *state) {
    const CpsiSparseData *d = &made->data;
    double *x = need(calloc((size_t)d->unknowns, sizeof *x)), s[MOST_ROWS], z[MOST_ROWS];
    for (int j = 0; j < d->unknowns; j++) x[j] = splitmix(state, -1, 1);
    double *b = made->b, *xk = x, *c = made->c;
    for (int k = 0; k < d->blocks; k++) {
        const CpsiBlock *block = &made->block[k];
        for (int i = 0, cone = 0; cone < block->cones; i += block->dim[cone++]) {
            inside(block->dim[cone], state, &s[i]);
            inside(block->dim[cone], state, &z[i]);
        }
        for (int r = 0; r < block->rows; r++) {
            b[r] = s[r];
            for (int j = 0; j < block->unknowns; j++) {
                const double a = block->a[r * block->unknowns + j];
                b[r] -= a * xk[j];
                c[j] += a * z[r];
            }
        }
        b += block->rows;
        xk += block->unknowns;
        c += block->unknowns;
    }
    for (int i = 0; i < d->equations; i++) {
        const double y = splitmix(state, -1, 1);
        for (size_t e = d->start[i]; e < d->start[i + 1]; e++) {
            made->h[i] -= d->value[e] * x[d->column[e]];
            made->c[d->column[e]] += d->value[e] * y;
        }
    }
    free(x);
}

RandomProgram random_program_new(const RandomProgramKind *kind, uint64_t seed) {
    RandomProgram made = {0};
    const size_t n = (size_t)kind->unknowns, equations = n / 2, entries = equations * PER_EQUATION;
    made.block = need(calloc(n + 1, sizeof *made.block));
    made.dim = need(calloc(2 * n + 1, sizeof *made.dim));
    made.a = need(calloc(n * MOST_ROWS + 1, sizeof *made.a));
    made.b = need(calloc(3 * n + 1, sizeof *made.b));
    made.c = need(calloc(n + 1, sizeof *made.c));
    made.h = need(calloc(equations + 1, sizeof *made.h));
    made.start = need(calloc(equations + 1, sizeof *made.start));
    made.column = need(calloc(entries + 1, sizeof *made.column));
    made.value = need(calloc(entries + 1, sizeof *made.value));
    uint64_t state = seed;
    make_blocks(&made, kind->unknowns - kind->loose, &state);
    make_equations(&made, kind, (int)equations, &state);
    made.data = (CpsiSparseData){.unknowns = kind->unknowns,
                                 .equations = (int)equations,
                                 .blocks = made.data.blocks,
                                 .block = made.block,
                                 .start = made.start,
                                 .column = made.column,
                                 .value = made.value,
                                 .c = made.c,
                                 .h = made.h};
    make_vectors(&made, &state);
    return made;
}

void random_program_free(RandomProgram *made) {
    void *part[] = {made->block, made->dim,   made->a,      made->b,    made->c,
                    made->h,     made->start, made->column, made->value};
    for (size_t k = 0; k < sizeof part / sizeof *part; k++) free(part[k]);
}

/* How far x0 >= |x1| is missed. */
static double outside(int dim, const double *x) {
    double square = 0;
    for (int r = 1; r < dim; r++) square += x[r] * x[r];
    return fmax(0, sqrt(square) - x[0]);
}

double random_program_error(const RandomProgram *made, const CpsiConicResult *found) {
    const CpsiSparseData *d = &made->data;
    double *left = need(calloc((size_t)d->unknowns, sizeof *left)), s[MOST_ROWS];
    double cost = 0, sum = 0, worst = 0;
    for (int j = 0; j < d->unknowns; j++) {
        left[j] = d->c[j];
        cost += d->c[j] * found->x[j];
    }
    for (int i = 0; i < d->equations; i++) {
        double at = d->h[i];
        for (size_t e = d->start[i]; e < d->start[i + 1]; e++) {
            at += d->value[e] * found->x[d->column[e]];
            left[d->column[e]] -= d->value[e] * found->y[i];
        }
        worst = fmax(worst, fabs(at));
        sum += d->h[i] * found->y[i];
    }
    const double *x = found->x, *z = found->z;
    double *to = left;
    for (int k = 0; k < d->blocks; k++) {
        const CpsiBlock *block = &d->block[k];
        for (int r = 0; r < block->rows; r++) {
            s[r] = block->b[r];
            sum += block->b[r] * z[r];
            for (int j = 0; j < block->unknowns; j++) {
                s[r] += block->a[r * block->unknowns + j] * x[j];
                to[j] -= block->a[r * block->unknowns + j] * z[r];
            }
        }
        for (int i = 0, cone = 0; cone < block->cones; i += block->dim[cone++])
            worst = fmax(worst,
                         fmax(outside(block->dim[cone], &s[i]), outside(block->dim[cone], &z[i])));
        x += block->unknowns;
        z += block->rows;
        to += block->unknowns;
    }
    double all = fabs(cost + sum) / (1 + fabs(cost)) + worst;
    for (int j = 0; j < d->unknowns; j++) {
        worst = fmax(worst, fabs(left[j]));
        all += fabs(left[j]) + fabs(found->x[j]);
    }
    free(left);
    if (!isfinite(all)) return INFINITY; /* fmax would pass over NaN */
    return fmax(worst, fabs(cost + sum) / (1 + fabs(cost)));
}
