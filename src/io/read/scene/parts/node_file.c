/* SPDX-License-Identifier: BSD-3-Clause */
/* A table of nodes as CSV (see node_file.h). Cells are terminated in place, so that messages can
 * give their columns. */
#include "io/read/scene/parts/node_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "io/base/file/csv_table.h"
#include "io/base/file/text_rows.h"
#include "io/base/yaml/yaml.h"

enum { ARC_LENGTH, X, Y, Z, TENSION, REACTION, FRICTION_BOUND, COLUMNS };

static const struct {
    const char *name, *unit;
} COLUMN[COLUMNS] = {[ARC_LENGTH] = {"arc_length", "m"},
                     [X] = {"x", "m"},
                     [Y] = {"y", "m"},
                     [Z] = {"z", "m"},
                     [TENSION] = {"tension", "N"},
                     [REACTION] = {"reaction", "N"},
                     [FRICTION_BOUND] = {"friction_bound", "N"}};

static const char NAMES[] =
    "x, y, z and, where they are known, arc_length, tension, reaction or friction_bound";

typedef struct Table {
    const char *path;
    CpsError *err;
    int line;            /* number of the line in the file, from 1 */
    int columns;         /* number of columns found */
    int column[COLUMNS]; /* meaning of the k-th column */
    bool has[COLUMNS];
    int rows;
    double *value[COLUMNS]; /* (rows) each, NULL: there is no such column */
} Table;

static CpsStatus no_memory(const Table *t) {
    return cpsi_fail_at(t->err, CPS_ERR_MEMORY, t->path, 0, 0,
                        "out of memory while reading the nodes");
}

/* ---- cells ---- */

static CpsStatus read_names(Table *t, char *text) {
    char *cell[COLUMNS];
    const int count = cpsi_csv_cut(text, cell, COLUMNS);
    for (int k = 0; k < (count < COLUMNS ? count : COLUMNS); k++) {
        int c = 0;
        while (c < COLUMNS && strcmp(COLUMN[c].name, cell[k]) != 0) c++;
        const int place = (int)(cell[k] - text) + 1;
        if (c == COLUMNS)
            return cpsi_fail_at(t->err, CPS_ERR_INPUT, t->path, t->line, place,
                                "found the column '%.40s', expected a line of names: %s", cell[k],
                                NAMES);
        if (t->has[c])
            return cpsi_fail_at(t->err, CPS_ERR_INPUT, t->path, t->line, place,
                                "the column '%s' is given twice", cell[k]);
        t->has[c] = true;
        t->column[k] = c;
    }
    t->columns = count;
    if (count > COLUMNS || !t->has[X] || !t->has[Y] || !t->has[Z])
        return cpsi_fail_at(t->err, CPS_ERR_INPUT, t->path, t->line, 1,
                            "found other columns than expected: %s", NAMES);
    if (!t->has[REACTION] || !t->has[FRICTION_BOUND]) return CPS_OK;
    return cpsi_fail_at(t->err, CPS_ERR_INPUT, t->path, t->line, 1,
                        "found reaction and friction_bound, expected one of them: A = mu R");
}

static bool are_units(const Table *t, char *const *cell, int count) {
    bool units = count == t->columns;
    for (int k = 0; k < count && units; k++)
        units = strcmp(cell[k], COLUMN[t->column[k]].unit) == 0;
    return units;
}

static CpsStatus read_row(Table *t, char *text) {
    char *cell[COLUMNS];
    const int count = cpsi_csv_cut(text, cell, t->columns);
    if (t->rows == 0 && are_units(t, cell, count)) return CPS_OK;
    if (count != t->columns)
        return cpsi_fail_at(t->err, CPS_ERR_INPUT, t->path, t->line, 1,
                            "found %s%d cells, expected %d as in the line of names",
                            count > t->columns ? "more than " : "",
                            count > t->columns ? t->columns : count, t->columns);
    for (int k = 0; k < count; k++) {
        const int c = t->column[k];
        const bool none = c == TENSION && t->rows == 0; /* no element ends at end A */
        double x = 0;
        if (none ? *cell[k] != '\0' : !cpsi_yaml_number(cell[k], &x) || !(fabs(x) <= 1e100))
            return cpsi_fail_at(t->err, CPS_ERR_INPUT, t->path, t->line, (int)(cell[k] - text) + 1,
                                "%s: found '%.40s', expected %s%s", COLUMN[c].name, cell[k],
                                none ? "nothing: no element ends at the first node"
                                     : "a number in ",
                                none ? "" : COLUMN[c].unit);
        t->value[c][t->rows] = x;
    }
    t->rows++;
    return CPS_OK;
}

/* ---- the whole table ---- */

static CpsStatus read_lines(Table *t, CpsiTextRows *rows, CpsiPool *pool) {
    bool named = false;
    CpsStatus status = CPS_OK;
    for (char *text; status == CPS_OK && (text = cpsi_text_rows_next(rows));) {
        t->line = rows->line;
        status = named ? read_row(t, text) : read_names(t, text);
        if (named || status != CPS_OK) continue;
        named = true;
        for (int c = 0; c < COLUMNS && status == CPS_OK; c++) {
            if (t->has[c]) t->value[c] = CPSI_POOL_TAKE(pool, rows->lines, double);
            if (t->has[c] && !t->value[c]) status = no_memory(t);
        }
    }
    if (status == CPS_OK && t->rows < 2)
        status = cpsi_fail_at(t->err, CPS_ERR_INPUT, t->path, 0, 0,
                              "found %d nodes, expected at least 2 below a line of names: %s",
                              t->rows, NAMES);
    return status;
}

/* Check that abscissae begin with 0 and increase. */
static CpsStatus check_arc_length(const Table *t) {
    const double *a = t->value[ARC_LENGTH];
    if (!a) return CPS_OK;
    for (int j = 0; j < t->rows; j++)
        if (j == 0 ? a[0] != 0 : !(a[j] > a[j - 1]))
            return cpsi_fail_at(t->err, CPS_ERR_INPUT, t->path, 0, 0,
                                "arc_length of node %d is %.9g m, expected %s", j, a[j],
                                j == 0 ? "0" : "more than that of the node before");
    return CPS_OK;
}

CpsStatus cpsi_node_file_read(const char *path, size_t max_bytes, CpsiPool *pool, CpsiNodeFile *out,
                              CpsError *err) {
    Table t = {.path = path, .err = err};
    CpsiTextRows rows;
    CpsStatus status = cpsi_text_rows_open(&rows, path, max_bytes, err);
    if (status == CPS_OK) status = read_lines(&t, &rows, pool);
    free(rows.bytes);
    if (status == CPS_OK) status = check_arc_length(&t);
    if (status != CPS_OK) return status;
    double *x = CPSI_POOL_TAKE(pool, 3 * (size_t)t.rows, double);
    if (!x) return no_memory(&t);
    for (int j = 0; j < t.rows; j++)
        for (int a = 0; a < 3; a++) x[3 * j + a] = t.value[X + a][j];
    *out = (CpsiNodeFile){.nodes = t.rows,
                          .position = x,
                          .arc_length = t.value[ARC_LENGTH],
                          .tension = t.has[TENSION] ? t.value[TENSION] + 1 : NULL,
                          .reaction = t.value[REACTION],
                          .friction_bound = t.value[FRICTION_BOUND]};
    return CPS_OK;
}
