/* SPDX-License-Identifier: BSD-3-Clause */
/* A table of nodes as CSV (see node_file.h). */
#include "io/read/scene/parts/node_file.h"

#include "base/status.h"

enum { X, Y, Z, ARC_LENGTH, TENSION, REACTION, FRICTION_BOUND, COLUMNS };

static const CpsiCsvColumn COLUMN[COLUMNS] = {
    [X] = {"x", "m", CPSI_CSV_REQUIRED},
    [Y] = {"y", "m", CPSI_CSV_REQUIRED},
    [Z] = {"z", "m", CPSI_CSV_REQUIRED},
    [ARC_LENGTH] = {"arc_length", "m", CPSI_CSV_OPTIONAL},
    [TENSION] = {"tension", "N", CPSI_CSV_NOT_FIRST}, /* no element ends at end A */
    [REACTION] = {"reaction", "N", CPSI_CSV_OPTIONAL},
    [FRICTION_BOUND] = {"friction_bound", "N", CPSI_CSV_OPTIONAL}};

/* Check what the table has as a whole; abscissae begin with 0 and increase. */
static CpsStatus check(const CpsiCsvTable *t, const char *path, CpsError *err) {
    if (t->rows < 2)
        return cpsi_fail_at(err, CPS_ERR_INPUT, path, 0, 0,
                            "found %d nodes, expected at least 2 below the line of names", t->rows);
    if (t->has[REACTION] && t->has[FRICTION_BOUND])
        return cpsi_fail_at(err, CPS_ERR_INPUT, path, t->names, 1,
                            "found reaction and friction_bound, expected one of them: A = mu R");
    for (int j = 0; j < t->rows && t->has[ARC_LENGTH]; j++) {
        const double *a = &t->value[COLUMNS * j + ARC_LENGTH];
        if (j == 0 ? *a != 0 : !(*a > a[-COLUMNS]))
            return cpsi_fail_at(err, CPS_ERR_INPUT, path, t->line[j], 1,
                                "arc_length of node %d is %.9g m, expected %s", j, *a,
                                j == 0 ? "0" : "more than that of the node before");
    }
    return CPS_OK;
}

/* Column `c` from row `first` on; NULL if the file has none. `*memory` is where it goes. */
static double *take(const CpsiCsvTable *t, int c, int first, double **memory) {
    if (!t->has[c]) return NULL;
    double *value = *memory;
    *memory += t->rows - first;
    for (int j = first; j < t->rows; j++) value[j - first] = t->value[COLUMNS * j + c];
    return value;
}

CpsStatus cpsi_node_file_read(const CpsiDocument *d, const CpsiYaml *node, const char *name,
                              CpsiPool *pool, CpsiNodeFile *out) {
    CpsiCsvTable t;
    const char *path;
    CpsStatus status = cpsi_document_table(d, node, name, COLUMN, COLUMNS, pool, &t, &path);
    if (status == CPS_OK) status = check(&t, path, d->err);
    if (status != CPS_OK) return status;
    double *memory = CPSI_POOL_TAKE(pool, COLUMNS * (size_t)t.rows, double);
    if (!memory) return cpsi_document_no_memory(d);
    out->nodes = t.rows;
    out->position = memory;
    for (int j = 0; j < t.rows; j++)
        for (int a = 0; a < 3; a++) *memory++ = t.value[COLUMNS * j + X + a];
    out->arc_length = take(&t, ARC_LENGTH, 0, &memory);
    out->tension = take(&t, TENSION, 1, &memory);
    out->reaction = take(&t, REACTION, 0, &memory);
    out->friction_bound = take(&t, FRICTION_BOUND, 0, &memory);
    return CPS_OK;
}
