/* SPDX-License-Identifier: BSD-3-Clause */
/* Projection onto D V = W, C V = 0 by one sparse factor and rounds of iterative refinement. */
#include "drive/kinematics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "drive/adjoint.h"
#include "linalg/dense.h"
#include "linalg/sparse_ldl.h"

/* Regularisation of dependent rows. It is above rounding; rows that are nearly dependent need more
 * rounds of refinement. */
static const double REGULAR = 1e-12;
static const int MOST_ROUNDS = 12;
/* Limit for the entries of the factor. */
static const size_t MOST_ENTRIES = (size_t)500 << 20;

struct CpsiKinematics {
    const CpsSystem *system;
    CpsiRows rows;    /* R */
    double *size;     /* (rows) norm of each row before scaling */
    double *x, *left; /* (n + rows) */
    CpsiLdl *ldl;
};

void cpsi_kinematics_free(CpsiKinematics *k) {
    if (!k) return;
    cpsi_rows_free(&k->rows);
    cpsi_ldl_free(k->ldl);
    free(k->size);
    free(k->x);
    free(k);
}

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the kinematics");
}

/* Number of entries of R. */
static size_t count_entries(const CpsSystem *system, int *rows) {
    size_t count =
        system->drive.start[system->drive.rows] + system->constraint.start[system->constraint.rows];
    *rows = system->drive.rows + system->constraint.rows;
    for (int k = 0; k < system->pieces; k++) {
        const CpsiPiece *piece = &system->piece[k];
        const int lines = piece->term ? 0 : system->form[piece->form]->lines;
        const int base = system->law[piece->law].first + piece->offset;
        *rows += lines;
        count += (size_t)lines * (system->map.start[base + piece->space] - system->map.start[base]);
    }
    return count;
}

static void list_rows(const CpsiRows *rows, int first, CpsEntry **to) {
    for (int i = 0; i < rows->rows; i++)
        for (size_t e = rows->start[i]; e < rows->start[i + 1]; e++)
            *(*to)++ = (CpsEntry){first + i, rows->column[e], rows->value[e]};
}

static void list_lines(const CpsSystem *system, int first, CpsiAdjoint *adjoint, CpsEntry **to) {
    for (int k = 0; k < system->pieces; k++) {
        const CpsiPiece *piece = &system->piece[k];
        const CpsiConicForm *form = piece->term ? NULL : system->form[piece->form];
        if (form)
            for (int l = 0; l < form->lines; l++, first++) {
                cpsi_adjoint_apply(adjoint, system, piece, &form->q[(size_t)l * (size_t)form->n], 1,
                                   1);
                for (int i = 0; i < adjoint->count; i++)
                    *(*to)++ =
                        (CpsEntry){first, adjoint->column[i], adjoint->sum[adjoint->column[i]]};
            }
    }
}

static CpsStatus write_rows(CpsiKinematics *k, CpsError *err) {
    const CpsSystem *system = k->system;
    int rows;
    const size_t count = count_entries(system, &rows);
    if (count > MOST_ENTRIES)
        return cpsi_fail(err, CPS_ERR_LIMIT, "the constraints have %zu entries", count);
    CpsiAdjoint adjoint;
    CpsStatus status = cpsi_adjoint_new(system, &adjoint, err);
    if (status != CPS_OK) return status;
    CpsEntry *list = malloc((count + 1) * sizeof *list), *at = list;
    if (!list) {
        cpsi_adjoint_free(&adjoint);
        return out_of_memory(err);
    }
    list_rows(&system->drive, 0, &at);
    list_rows(&system->constraint, system->drive.rows, &at);
    list_lines(system, system->drive.rows + system->constraint.rows, &adjoint, &at);
    cpsi_adjoint_free(&adjoint);
    status =
        cpsi_rows_append(&k->rows, "constraints", system->n, rows, (int)(at - list), list, err);
    free(list);
    k->size = malloc(((size_t)rows + 1) * sizeof *k->size);
    k->x = calloc(2 * ((size_t)system->n + (size_t)rows), sizeof *k->x);
    if (status == CPS_OK && (!k->size || !k->x)) status = out_of_memory(err);
    if (status != CPS_OK) return status;
    k->left = k->x + system->n + rows;
    for (int i = 0; i < rows; i++) {
        const size_t begin = k->rows.start[i], end = k->rows.start[i + 1];
        const double size = cpsi_norm((int)(end - begin), &k->rows.value[begin]);
        k->size[i] = size > 0 ? size : 1;
        for (size_t e = begin; e < end; e++) k->rows.value[e] /= k->size[i];
    }
    return CPS_OK;
}

static CpsStatus factorise(CpsiKinematics *k, CpsError *err) {
    const size_t n = (size_t)k->system->n, rows = (size_t)k->rows.rows, all = n + rows;
    const size_t entries = all + k->rows.start[rows];
    size_t *start = malloc((all + 1) * sizeof *start), at = 0, found = 0;
    int *index = malloc(entries * sizeof *index);
    double *value = malloc(entries * sizeof *value);
    signed char *sign = malloc(all);
    bool done = start && index && value && sign;
    if (done) {
        for (size_t j = 0; j < n; j++) {
            start[j] = at;
            sign[j] = 1;
            index[at] = (int)j;
            value[at++] = 1;
        }
        for (size_t i = 0; i < rows; i++) {
            start[n + i] = at;
            sign[n + i] = -1;
            for (size_t e = k->rows.start[i]; e < k->rows.start[i + 1]; e++) {
                index[at] = k->rows.column[e];
                value[at++] = k->rows.value[e];
            }
            index[at] = (int)(n + i);
            value[at++] = -REGULAR;
        }
        start[all] = at;
        const CpsiPattern pattern = {.n = (int)all, .start = start, .index = index};
        int width = 0;
        k->ldl = cpsi_ldl_new(&pattern, MOST_ENTRIES, &width, &found);
        done = k->ldl && cpsi_ldl_factor(k->ldl, value, sign, 0.1 * REGULAR);
    }
    free(start);
    free(index);
    free(value);
    free(sign);
    return done ? CPS_OK : out_of_memory(err);
}

CpsStatus cpsi_kinematics_new(const CpsSystem *system, CpsiKinematics **out, CpsError *err) {
    CpsiKinematics *k = calloc(1, sizeof *k);
    if (!k) return out_of_memory(err);
    k->system = system;
    CpsStatus status = write_rows(k, err);
    if (status == CPS_OK) status = factorise(k, err);
    if (status == CPS_OK)
        *out = k;
    else
        cpsi_kinematics_free(k);
    return status;
}

/* left (rows) = (W, 0, 0)/size - R V. Returns the largest absolute value. */
static double miss(const CpsiKinematics *k, const double *driving, const double *velocity,
                   double *left) {
    double largest = 0;
    for (int i = 0; i < k->rows.rows; i++) {
        left[i] = (i < k->system->drive.rows ? driving[i] / k->size[i] : 0) -
                  cpsi_rows_times(&k->rows, i, velocity);
        largest = fmax(largest, fabs(left[i]));
    }
    return largest;
}

void cpsi_kinematics_project(CpsiKinematics *k, const double *driving, double *velocity) {
    const int n = k->system->n;
    double before = INFINITY;
    for (int round = 0; round < MOST_ROUNDS; round++) {
        const double now = miss(k, driving, velocity, k->x + n);
        if (!(now > 0) || !(now < 0.5 * before)) return;
        before = now;
        memset(k->x, 0, (size_t)n * sizeof *k->x);
        cpsi_ldl_solve(k->ldl, k->x);
        for (int i = 0; i < n; i++) {
            k->left[i] = velocity[i];
            velocity[i] += k->x[i];
        }
        /* the last round may only have added rounding; it is undone then */
        if (miss(k, driving, velocity, k->left + n) > now)
            memcpy(velocity, k->left, (size_t)n * sizeof *velocity);
    }
}

double cpsi_kinematics_contradiction(const CpsiKinematics *k, const double *driving,
                                     const double *velocity, double *drive, double *constraint) {
    const int m = k->system->drive.rows, c = k->system->constraint.rows;
    double *left = k->left + k->system->n, size = 0;
    const double largest = miss(k, driving, velocity, left);
    for (int i = 0; i < m; i++) size = fmax(size, fabs(driving[i] / k->size[i]));
    for (int i = 0; drive && i < m; i++) drive[i] = -left[i] / k->size[i];
    for (int i = 0; constraint && i < c; i++) constraint[i] = -left[m + i] / k->size[m + i];
    return size > 0 ? largest / size : largest;
}
