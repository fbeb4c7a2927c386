/* SPDX-License-Identifier: BSD-3-Clause */
/* Factor and solutions of a large dense matrix (dense_ldl.h), compiled once per width
 * (base/width.h).
 *
 * Each panel is first subtracted what the panels before it contribute, as products of eight rows
 * and some columns that stay in registers. What is left is eliminated within the panel, eight
 * columns at a time: in the rows of the panel's own columns, which gives pivots, then in the rows
 * below, eight of them after eight, which stay in the nearest cache meanwhile.
 *
 * L's entries are quotients of those of U' = L D, from which the next columns are subtracted: so
 * none waits for a division. */
#include <math.h>

#include "base/lanes.h"
#include "base/width.h"
#include "linalg/dense_ldl.h"

enum { LANES = CPSI_LANES, PANEL = CPSI_DENSE_PANEL };
/* One register, and how many of them hold eight rows. Of so many columns eight rows fit into
 * registers, beside what they are computed from. */
typedef double Register __attribute__((vector_size(CPSI_WIDTH / 8), aligned(8), may_alias));
enum { PER = CPSI_WIDTH / 64, PARTS = LANES / PER, COLUMNS = PER };
static inline const Register *part_in(const double *rows, int p) {
    return (const Register *)rows + p;
}
static inline Register *part_of(double *rows, int p) { return (Register *)rows + p; }

/* out -= the product of eight rows and eight columns, l and y, over `width` columns between. */
CPSI_LANES_FUNCTION void subtract(int width, const double *restrict l, const double *restrict y,
                                  double *restrict out) {
    const double *end = l + width * LANES;
    for (int first = 0; first < LANES; first += COLUMNS) {
        Register sum[COLUMNS][PARTS] = {{{0}}};
        const double *at = y + first;
        for (const double *rows = l; rows < end; rows += LANES, at += LANES)
            for (int c = 0; c < COLUMNS; c++)
                for (int p = 0; p < PARTS; p++) sum[c][p] += *part_in(rows, p) * at[c];
        for (int c = 0; c < COLUMNS; c++)
            for (int p = 0; p < PARTS; p++) *part_of(&out[(first + c) * LANES], p) -= sum[c][p];
    }
}

/* y = L D of eight rows over `width` columns, and what these add to the terms of the rows'
 * diagonal entries. */
CPSI_LANES_FUNCTION void weigh(int width, const double *restrict l, const double *restrict pivot,
                               double *restrict y, double *restrict terms) {
    for (int k = 0; k < width; k++) CPSI_FOR_LANES(r) {
            y[k * LANES + r] = l[k * LANES + r] * pivot[k];
            terms[r] += fabs(l[k * LANES + r] * y[k * LANES + r]);
        }
}

/* Eliminate the eight columns of a block of rows below theirs; `own`: their L in their own rows. */
CPSI_LANES_FUNCTION void eliminate(const double *restrict own, const double *restrict pivot,
                                   double *restrict block) {
    for (int p = 0; p < PARTS; p++) {
        Register u[LANES];
        for (int b = 0; b < LANES; b++) u[b] = *part_of(&block[b * LANES], p);
        for (int b = 0; b < LANES; b++) {
            for (int c = b + 1; c < LANES; c++) u[c] -= u[b] * own[b * LANES + c];
            *part_of(&block[b * LANES], p) = u[b] / pivot[b];
        }
    }
}

/* Factorise the eight columns from `j` on in their own rows, `block`. L there gets zeros on its
 * diagonal and above. */
static bool factor_block(const CpsiDenseLdl *ldl, int j, double least, double share,
                         double *block) {
    for (int b = 0; b < LANES; b++) {
        double *own = &block[b * LANES], *terms = &ldl->terms[j];
        const double s = ldl->sign[j + b], smallest = fmax(least, share * terms[b]), found = own[b];
        if (!isfinite(found)) return false;
        const double pivot = ldl->pivot[j + b] = found * s >= smallest ? found : s * smallest;
        double u[LANES];
        for (int r = 0; r < LANES; r++) {
            u[r] = own[r];
            own[r] = r > b ? u[r] / pivot : 0;
            terms[r] += fabs(own[r] * u[r]);
        }
        for (int c = b + 1; c < LANES; c++)
            for (int r = c; r < LANES; r++) block[c * LANES + r] -= u[r] * own[c];
    }
    return true;
}

/* A panel. */
typedef struct DensePanel {
    int first, width; /* its columns */
    double *rows;     /* from its own on, eight after eight */
} DensePanel;

static DensePanel panel_at(const CpsiDenseLdl *ldl, int first) {
    return (DensePanel){first, cpsi_dense_width(ldl, first), cpsi_dense_panel(ldl, first)};
}

/* The panel's first `count` columns in eight rows behind theirs. y: D L' of the columns' own rows.
 */
static void eliminate_rows(const CpsiDenseLdl *ldl, const DensePanel *panel, int count,
                           const double *y, double *rows) {
    for (int c = 0; c < count; c += LANES) {
        subtract(c, rows, &y[c * PANEL], &rows[c * LANES]);
        eliminate(&panel->rows[c * panel->width + c * LANES], &ldl->pivot[panel->first + c],
                  &rows[c * LANES]);
    }
}

/* Subtract from a panel what the one before it that begins with column `before` contributes. */
static void subtract_panel(const CpsiDenseLdl *ldl, int before, const DensePanel *panel) {
    double *y = ldl->scratch, *out = panel->rows;
    const double *l = cpsi_dense_panel(ldl, before) + (size_t)(panel->first - before) * PANEL;
    for (int c = 0; c < panel->width; c += LANES)
        weigh(PANEL, &l[c * PANEL], &ldl->pivot[before], &y[c * PANEL],
              &ldl->terms[panel->first + c]);
    for (int i = panel->first; i < ldl->n; i += LANES) {
        for (int c = 0; c < panel->width && panel->first + c <= i; c += LANES)
            subtract(PANEL, l, &y[c * PANEL], &out[c * LANES]);
        l += LANES * PANEL;
        out += LANES * panel->width;
    }
}

static bool factor_panel(const CpsiDenseLdl *ldl, const DensePanel *panel, double least,
                         double share) {
    double *y = ldl->scratch, *rows = panel->rows;
    const int first = panel->first, width = panel->width;
    for (int c = 0; c < width; c += LANES, rows += LANES * width) {
        eliminate_rows(ldl, panel, c, y, rows);
        weigh(c, rows, &ldl->pivot[first], &y[c * PANEL], &ldl->terms[first + c]);
        subtract(c, rows, &y[c * PANEL], &rows[c * LANES]);
        if (!factor_block(ldl, first + c, least, share, &rows[c * LANES])) return false;
    }
    for (int i = first + width; i < ldl->n; i += LANES, rows += LANES * width)
        eliminate_rows(ldl, panel, width, y, rows);
    return true;
}

static bool factor(const CpsiDenseLdl *ldl, double least, double share) {
    for (int first = 0; first < ldl->n; first += PANEL) {
        const DensePanel panel = panel_at(ldl, first);
        for (int before = 0; before < first; before += PANEL) subtract_panel(ldl, before, &panel);
        if (!factor_panel(ldl, &panel, least, share)) return false;
    }
    return true;
}

/* out -= l x of eight rows over `width` columns, an even number. */
CPSI_LANES_FUNCTION void subtract_rows(int width, const double *restrict l,
                                       const double *restrict x, double *restrict out) {
    Register even[PARTS] = {{0}}, odd[PARTS] = {{0}};
    for (const double *end = x + width; x < end; x += 2, l += 2 * LANES)
        for (int p = 0; p < PARTS; p++) {
            even[p] += *part_in(l, p) * x[0];
            odd[p] += *part_in(l + LANES, p) * x[1];
        }
    for (int p = 0; p < PARTS; p++) *part_of(out, p) -= even[p] + odd[p];
}

/* sum += the products of l of eight rows over `width` columns with x of the rows, each in its lane.
 */
CPSI_LANES_FUNCTION void add_columns(int width, const double *restrict l, const double *restrict x,
                                     double *restrict sum) {
    Register rows[PARTS];
    for (int p = 0; p < PARTS; p++) rows[p] = *part_in(x, p);
    for (const double *end = sum + width * LANES; sum < end; sum += LANES, l += LANES)
        for (int p = 0; p < PARTS; p++) *part_of(sum, p) += *part_in(l, p) * rows[p];
}

static void forward(const CpsiDenseLdl *ldl, double *x) {
    for (int first = 0; first < ldl->n; first += PANEL) {
        const DensePanel panel = panel_at(ldl, first);
        const double *rows = panel.rows;
        double *own = &x[first];
        for (int i = 0; i < ldl->n - first; i += LANES, rows += LANES * panel.width) {
            const int count = i < panel.width ? i : panel.width;
            subtract_rows(count, rows, own, &own[i]);
            if (i >= panel.width) continue;
            for (int b = 0; b < LANES; b++)
                CPSI_FOR_LANES(r) own[i + r] -= rows[(i + b) * LANES + r] * own[i + b];
        }
    }
}

static void backward(const CpsiDenseLdl *ldl, double *x) {
    for (int j = 0; j < ldl->n; j++) x[j] /= ldl->pivot[j];
    for (int first = (ldl->n - 1) / PANEL * PANEL; first >= 0; first -= PANEL) {
        const DensePanel panel = panel_at(ldl, first);
        const int width = panel.width;
        double *sum = ldl->scratch, *own = &x[first];
        for (int k = 0; k < width * LANES; k++) sum[k] = 0;
        const double *rows = &panel.rows[width * width];
        for (int i = width; i < ldl->n - first; i += LANES, rows += LANES * width)
            add_columns(width, rows, &own[i], sum);
        for (int c = width - LANES; c >= 0; c -= LANES) {
            rows = &panel.rows[c * width];
            for (int b = LANES - 1; b >= 0; b--) {
                const double *l = &rows[(c + b) * LANES];
                CPSI_FOR_LANES(r) own[c + b] -= sum[(c + b) * LANES + r] + l[r] * own[c + r];
            }
            add_columns(c, rows, &own[c], sum);
        }
    }
}

const CpsiDenseLoops CPSI_WIDE(cpsi_dense_loops) = {factor, forward, backward};
