/* SPDX-License-Identifier: BSD-3-Clause */
/* Construction of a system. */
#include "drive/system.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "linalg/dense.h"
#include "set/set.h"

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a system");
}

CpsStatus cps_system_create(int parameters, CpsSystem **out, CpsError *err) {
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL");
    if (parameters < 1 || parameters > CPS_SYSTEM_MAX_PARAMETERS)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%d velocity parameters, expected from 1 to %d",
                         parameters, CPS_SYSTEM_MAX_PARAMETERS);
    CpsSystem *system = calloc(1, sizeof *system);
    if (!system) return out_of_memory(err);
    system->n = parameters;
    CpsStatus status = cpsi_rows_append(&system->map, "laws", parameters, 0, 0, NULL, err);
    if (status == CPS_OK)
        status = cpsi_rows_append(&system->constraint, "constraints", parameters, 0, 0, NULL, err);
    if (status == CPS_OK)
        status = cpsi_rows_append(&system->drive, "drive", parameters, 0, 0, NULL, err);
    if (status == CPS_OK)
        *out = system;
    else
        cps_system_destroy(system);
    return status;
}

static void clear_law(CpsiSystemLaw *law) {
    free(law->name);
    cps_law_release(law->friction_law);
    cps_resistance_release(law->resistance);
}

void cps_system_destroy(CpsSystem *system) {
    if (!system) return;
    for (int k = 0; k < system->laws; k++) clear_law(&system->law[k]);
    for (int k = 0; k < system->forms; k++) cpsi_conic_form_free(system->form[k]);
    free(system->law);
    free(system->piece);
    free(system->form);
    cpsi_rows_free(&system->map);
    cpsi_rows_free(&system->constraint);
    cpsi_rows_free(&system->drive);
    free(system->load);
    free(system);
}

int cps_system_parameter_count(const CpsSystem *system) { return system ? system->n : 0; }
int cps_system_law_count(const CpsSystem *system) { return system ? system->laws : 0; }
int cps_system_drive_space(const CpsSystem *system) { return system ? system->drive.rows : 0; }

static bool has_law(const CpsSystem *system, int k) { return system && k >= 0 && k < system->laws; }
const char *cps_system_law_name(const CpsSystem *system, int k) {
    return has_law(system, k) ? system->law[k].name : NULL;
}
int cps_system_law_space(const CpsSystem *system, int k) {
    return has_law(system, k) ? system->law[k].space : 0;
}

/* ---- laws ---- */

/* Memory for one more item, doubling. */
static bool grow(void **items, size_t *capacity, int count, size_t size) {
    if ((size_t)count < *capacity) return true;
    const size_t target = *capacity > 0 ? 2 * *capacity : 8;
    void *more = realloc(*items, target * size);
    if (!more) return false;
    *items = more;
    *capacity = target;
    return true;
}

static char *copy_name(const char *name, int k) {
    char own[32];
    snprintf(own, sizeof own, "law %d", k);
    const char *from = name ? name : own;
    const size_t length = strlen(from) + 1;
    char *copy = malloc(length);
    if (copy) memcpy(copy, from, length);
    return copy;
}

/* The form of a set, which is shared with the preceding piece (NULL: none) where that has the same
 * set. */
static CpsStatus form_of(CpsSystem *system, const CpsSet *set, const CpsiPiece *last, int *place,
                         CpsError *err) {
    if (last && !last->term && last->set == set) {
        *place = last->form;
        return CPS_OK;
    }
    if (!grow((void **)&system->form, &system->form_room, system->forms, sizeof(CpsiConicForm *)))
        return out_of_memory(err);
    const CpsStatus status = cpsi_conic_form_make(set, 1, &system->form[system->forms], err);
    if (status == CPS_OK) *place = system->forms++;
    return status;
}

static CpsStatus refuse_user(const char *name, const CpsSet *set, CpsError *err) {
    if (!set || !cpsi_set_has_user(set)) return CPS_OK;
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "%s: its set is known by its support function alone, but driving needs a "
                     "conic form: make the set of points, balls, inequalities and operations",
                     name);
}

/* Memory for a law with `pieces` pieces and its map; `law` is then at the end of the list, not yet
 * counted. */
static CpsStatus begin_law(CpsSystem *system, const char *name, int space, int pieces,
                           CpsiSystemLaw **law, CpsError *err) {
    bool done = grow((void **)&system->law, &system->law_room, system->laws, sizeof *system->law);
    while (done && (size_t)system->pieces + (size_t)pieces >= system->piece_room)
        done = grow((void **)&system->piece, &system->piece_room, (int)system->piece_room,
                    sizeof *system->piece);
    if (!done) return out_of_memory(err);
    *law = &system->law[system->laws];
    **law = (CpsiSystemLaw){.name = copy_name(name, system->laws),
                            .space = space,
                            .first = system->components,
                            .piece = system->pieces,
                            .pieces = pieces};
    return (*law)->name ? CPS_OK : out_of_memory(err);
}

/* Append the law's map, and count the law. */
static CpsStatus end_law(CpsSystem *system, CpsiSystemLaw *law, int count, const CpsEntry *map,
                         CpsError *err) {
    const CpsStatus status =
        cpsi_rows_append(&system->map, law->name, system->n, law->space, count, map, err);
    if (status != CPS_OK) return status;
    system->laws++;
    system->pieces += law->pieces;
    system->components += law->space;
    return CPS_OK;
}

CpsStatus cps_system_add_friction(CpsSystem *system, const char *name, const CpsLaw *law, int count,
                                  const CpsEntry *map, CpsError *err) {
    if (!system || !law) return cpsi_fail(err, CPS_ERR_ARGUMENT, "system or law is NULL");
    CpsiSystemLaw *own = NULL;
    CpsStatus status = begin_law(system, name, cps_law_space(law), law->factor_count, &own, err);
    if (status != CPS_OK) return status;
    status = refuse_user(own->name, cps_law_set(law), err);
    if (status == CPS_OK) own->friction_law = cps_law_retain(law);
    for (int i = 0, offset = 0; status == CPS_OK && i < law->factor_count; i++) {
        const int at = system->pieces + i;
        CpsiPiece piece = {.law = system->laws, .offset = offset, .set = law->factor[i]};
        piece.space = cps_set_space(piece.set);
        status =
            form_of(system, piece.set, at > 0 ? &system->piece[at - 1] : NULL, &piece.form, err);
        system->piece[at] = piece;
        offset += piece.space;
    }
    if (status == CPS_OK) status = end_law(system, own, count, map, err);
    if (status != CPS_OK) clear_law(own);
    return status;
}

/* Whether the term can be written as a second-order cone program. */
static CpsStatus check_term(const char *name, const CpsiTerm *term, CpsError *err) {
    if (term->kind == CPSI_POWER && term->degree != 2)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: a power term of degree %g is no second-order cone program; only "
                         "degree 2 is: write it as a table",
                         name, term->degree);
    if (term->kind != CPSI_DRY && term->kind != CPSI_VISCOUS && term->kind != CPSI_POWER &&
        term->kind != CPSI_TABLE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: a function of the speed that only a callback knows has no conic "
                         "form: write it as a table",
                         name);
    return refuse_user(name, term->set, err);
}

CpsStatus cps_system_add_resistance(CpsSystem *system, const char *name, const CpsResistance *law,
                                    int count, const CpsEntry *map, CpsError *err) {
    if (!system || !law) return cpsi_fail(err, CPS_ERR_ARGUMENT, "system or law is NULL");
    CpsiSystemLaw *own = NULL;
    CpsStatus status = begin_law(system, name, law->n, law->count, &own, err);
    if (status != CPS_OK) return status;
    for (int i = 0; i < law->count && status == CPS_OK; i++)
        status = check_term(own->name, &law->term[i], err);
    if (status == CPS_OK) {
        own->resistance = cps_resistance_retain(law);
        for (int i = 0; i < law->count; i++) {
            const CpsiTerm *term = &own->resistance->term[i];
            system->piece[system->pieces + i] =
                (CpsiPiece){.law = system->laws, .space = law->n, .set = term->set, .term = term};
        }
        status = end_law(system, own, count, map, err);
    }
    if (status != CPS_OK) clear_law(own);
    return status;
}

/* ---- constraints, drive, load ---- */

CpsStatus cps_system_add_constraints(CpsSystem *system, int rows, int count, const CpsEntry *map,
                                     CpsError *err) {
    if (!system) return cpsi_fail(err, CPS_ERR_ARGUMENT, "system is NULL");
    return cpsi_rows_append(&system->constraint, "constraints", system->n, rows, count, map, err);
}

/* Add the complement of the span as constraints. */
static CpsStatus add_complement(CpsSystem *system, int rank, const double *all, CpsError *err) {
    const int n = system->n;
    const size_t w = (size_t)n, rows = (size_t)(n - rank);
    CpsEntry *entry = malloc((rows * w + 1) * sizeof *entry);
    if (!entry) return out_of_memory(err);
    int count = 0;
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < w; j++) {
            const double value = all[((size_t)rank + i) * w + j];
            if (value != 0) entry[count++] = (CpsEntry){(int)i, (int)j, value};
        }
    const CpsStatus status = cps_system_add_constraints(system, (int)rows, count, entry, err);
    free(entry);
    return status;
}

CpsStatus cps_system_add_subspace(CpsSystem *system, int count, const double *spanning,
                                  CpsError *err) {
    if (!system || count < 0 || (count > 0 && !spanning))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "system or vectors are NULL, or %d vectors are fewer than 0", count);
    const int n = system->n;
    if (n > CPS_SET_MAX_SPACE || count > CPS_SET_MAX_ITEMS)
        return cpsi_fail(
            err, CPS_ERR_LIMIT,
            "a subspace of %d parameters by %d vectors, at most %d by %d: use constraints", n,
            count, CPS_SET_MAX_SPACE, CPS_SET_MAX_ITEMS);
    for (int i = 0; i < count; i++) {
        const CpsStatus status =
            cpsi_law_check_vector("spanning vector", n, &spanning[(size_t)i * (size_t)n], err);
        if (status != CPS_OK) return status;
    }
    const size_t high = (size_t)(count > n ? count : n);
    double *all = malloc(high * (size_t)n * sizeof *all);
    if (!all) return out_of_memory(err);
    if (count > 0) memcpy(all, spanning, (size_t)count * (size_t)n * sizeof *all);
    /* vectors count as dependent at the rounding of the given numbers */
    const int rank = cpsi_orthonormal_rows(count, n, all, NULL, 1e-12);
    cpsi_complete_rows(rank, n, all);
    const CpsStatus status = add_complement(system, rank, all, err);
    free(all);
    return status;
}

CpsStatus cps_system_set_drive(CpsSystem *system, int rows, int count, const CpsEntry *map,
                               CpsError *err) {
    if (!system) return cpsi_fail(err, CPS_ERR_ARGUMENT, "system is NULL");
    CpsiRows drive = {0};
    const CpsStatus status = cpsi_rows_append(&drive, "drive", system->n, rows, count, map, err);
    if (status != CPS_OK) {
        cpsi_rows_free(&drive);
        return status;
    }
    cpsi_rows_free(&system->drive);
    system->drive = drive;
    return CPS_OK;
}

CpsStatus cps_system_set_load(CpsSystem *system, const double *load, CpsError *err) {
    if (!system) return cpsi_fail(err, CPS_ERR_ARGUMENT, "system is NULL");
    CpsStatus status = cpsi_law_check_vector("load", system->n, load, err);
    if (status != CPS_OK) return status;
    double *copy = malloc((size_t)system->n * sizeof *copy);
    if (!copy) return out_of_memory(err);
    memcpy(copy, load, (size_t)system->n * sizeof *copy);
    free(system->load);
    system->load = copy;
    return CPS_OK;
}

bool cpsi_system_loaded(const CpsSystem *system) {
    if (system->load)
        for (int i = 0; i < system->n; i++)
            if (system->load[i] != 0) return true;
    return false;
}

CpsStatus cpsi_system_kernel(const CpsSystem *system, double *rhs, int *rank, double **all,
                             CpsError *err) {
    const size_t n = (size_t)system->n,
                 rows = (size_t)system->drive.rows + (size_t)system->constraint.rows;
    const size_t high = rows > n ? rows : n;
    if (system->n > CPS_SET_MAX_SPACE || rows > 4 * CPS_SET_MAX_SPACE)
        return cpsi_fail(err, CPS_ERR_LIMIT,
                         "%d parameters with %zu constraints are too many for the sets of all "
                         "solutions or the reduced law, which are dense: at most %d",
                         system->n, rows, CPS_SET_MAX_SPACE);
    double *q = calloc(high * n, sizeof *q);
    if (!q) return out_of_memory(err);
    for (size_t i = 0; i < rows; i++) {
        const bool drive = i < (size_t)system->drive.rows;
        if (drive)
            cpsi_rows_add(&system->drive, (int)i, 1, &q[i * n]);
        else
            cpsi_rows_add(&system->constraint, (int)i - system->drive.rows, 1, &q[i * n]);
    }
    /* rows count as dependent at the rounding of the given numbers */
    *rank = cpsi_orthonormal_rows((int)rows, system->n, q, rhs, 1e-11);
    cpsi_complete_rows(*rank, system->n, q);
    *all = q;
    return CPS_OK;
}
