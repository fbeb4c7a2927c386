/* SPDX-License-Identifier: BSD-3-Clause */
/* A CSV file of named columns of numbers (csv_table.h). */
#include "io/base/file/csv_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "io/base/file/text_rows.h"
#include "io/base/yaml/yaml.h"

typedef struct TableReader {
    const char *path;
    CpsError *err;
    const CpsiCsvColumn *column;
    int count;
    int columns, meaning[CPSI_CSV_COLUMNS]; /* found, and what each is */
    int line;
    CpsiCsvTable table;
} TableReader;

/* Divide `text` at commas into at most `capacity` cells without blanks around them, which are
 * terminated in place. Returns their number, capacity + 1 if there are more. */
static int cut(char *text, char **cell, int capacity) {
    int count = 0;
    for (char *next = text; next;) {
        char *begin = next + strspn(next, " \t");
        next = strchr(begin, ',');
        char *end = next ? next : begin + strlen(begin);
        if (next) next++;
        while (end > begin && strchr(" \t\r", end[-1])) end--;
        *end = '\0';
        if (count == capacity) return capacity + 1;
        cell[count++] = begin;
    }
    return count;
}

/* "time, x, y (optional)"; of many the first ones and the last one. */
static void list_names(const TableReader *r, char *out, size_t size) {
    enum { MANY = 12, FIRST = 3 };
    size_t at = 0;
    for (int k = 0; k < r->count && at < size; k++) {
        const bool skips = r->count > MANY && k == FIRST;
        if (skips) k = r->count - 1;
        at += (size_t)snprintf(out + at, size - at, "%s%s%s",
                               skips   ? " .. "
                               : k > 0 ? ", "
                                       : "",
                               r->column[k].name,
                               r->column[k].need == CPSI_CSV_REQUIRED ? "" : " (optional)");
    }
}

static CpsStatus read_names(TableReader *r, char *text) {
    char *cell[CPSI_CSV_COLUMNS], names[400];
    bool *has = r->table.has;
    list_names(r, names, sizeof names);
    const int found = cut(text, cell, CPSI_CSV_COLUMNS),
              most = found < CPSI_CSV_COLUMNS ? found : CPSI_CSV_COLUMNS;
    for (int k = 0; k < most; k++) {
        int c = 0;
        while (c < r->count && strcmp(r->column[c].name, cell[k]) != 0) c++;
        const int place = (int)(cell[k] - text) + 1;
        if (c == r->count)
            return cpsi_fail_at(r->err, CPS_ERR_INPUT, r->path, r->line, place,
                                "found the column '%.40s', expected a line of names: %s", cell[k],
                                names);
        if (has[c])
            return cpsi_fail_at(r->err, CPS_ERR_INPUT, r->path, r->line, place,
                                "the column '%s' is given twice", cell[k]);
        has[c] = true;
        r->meaning[k] = c;
    }
    r->columns = found;
    r->table.names = r->line;
    for (int c = 0; c < r->count; c++)
        if (r->column[c].need == CPSI_CSV_REQUIRED && !has[c])
            return cpsi_fail_at(r->err, CPS_ERR_INPUT, r->path, r->line, 1,
                                "the column '%s' is missing, expected a line of names: %s",
                                r->column[c].name, names);
    return CPS_OK;
}

/* "deg" and "degree" are one unit, which tables of results have in both ways. */
static bool is_unit(const char *text, const char *unit) {
    static const char DEGREE[] = "deg";
    if (strncmp(unit, DEGREE, strlen(DEGREE)) != 0) return strcmp(text, unit) == 0;
    return strcmp(text, DEGREE) == 0 || strcmp(text, "degree") == 0 || strcmp(text, "degrees") == 0;
}

/* Words below the names are units, and then those of the columns. */
static CpsStatus read_units(const TableReader *r, char *const *cell, int count, const char *text,
                            bool *units) {
    double x;
    *units = count == r->columns;
    for (int k = 0; k < count && *units; k++)
        *units = *cell[k] != '\0' && !cpsi_yaml_number(cell[k], &x);
    for (int k = 0; k < count && *units; k++) {
        const CpsiCsvColumn *column = &r->column[r->meaning[k]];
        if (!is_unit(cell[k], column->unit))
            return cpsi_fail_at(r->err, CPS_ERR_INPUT, r->path, r->line, (int)(cell[k] - text) + 1,
                                "the unit of %s: found '%.40s', expected %s, or numbers",
                                column->name, cell[k], column->unit);
    }
    return CPS_OK;
}

static CpsStatus read_row(TableReader *r, char *text) {
    char *cell[CPSI_CSV_COLUMNS];
    const int count = cut(text, cell, r->columns), row = r->table.rows;
    bool units = false;
    const CpsStatus status = row == 0 ? read_units(r, cell, count, text, &units) : CPS_OK;
    if (status || units) return status;
    if (count != r->columns)
        return cpsi_fail_at(r->err, CPS_ERR_INPUT, r->path, r->line, 1,
                            "found %s%d cells, expected %d as in the line of names",
                            count > r->columns ? "more than " : "",
                            count > r->columns ? r->columns : count, r->columns);
    for (int k = 0; k < count; k++) {
        const CpsiCsvColumn *column = &r->column[r->meaning[k]];
        double x = 0;
        if (column->need == CPSI_CSV_NOT_FIRST && row == 0) {
            if (*cell[k] == '\0') continue;
            return cpsi_fail_at(r->err, CPS_ERR_INPUT, r->path, r->line, (int)(cell[k] - text) + 1,
                                "%s: found '%.40s', expected nothing in the first row",
                                column->name, cell[k]);
        }
        if (!cpsi_yaml_number(cell[k], &x) || !(fabs(x) <= 1e100))
            return cpsi_fail_at(r->err, CPS_ERR_INPUT, r->path, r->line, (int)(cell[k] - text) + 1,
                                "%s: found '%.40s', expected a number in %s", column->name, cell[k],
                                column->unit);
        r->table.value[(size_t)row * (size_t)r->count + (size_t)r->meaning[k]] = x;
    }
    r->table.line[r->table.rows++] = r->line;
    return CPS_OK;
}

CpsStatus cpsi_csv_read(const char *path, size_t max_bytes, const CpsiCsvColumn *column, int count,
                        CpsiPool *pool, CpsiCsvTable *out, CpsError *err) {
    TableReader r = {.path = path, .err = err, .column = column, .count = count};
    CpsiTextRows rows;
    CpsStatus status = cpsi_text_rows_open(&rows, path, max_bytes, err);
    if (status == CPS_OK) {
        r.table.value = CPSI_POOL_TAKE(pool, rows.lines * (size_t)count, double);
        r.table.line = CPSI_POOL_TAKE(pool, rows.lines, int);
        if (!r.table.value || !r.table.line)
            status = cpsi_fail_at(err, CPS_ERR_MEMORY, path, 0, 0, "out of memory for its rows");
    }
    bool named = false;
    for (char *text; status == CPS_OK && (text = cpsi_text_rows_next(&rows));) {
        r.line = rows.line;
        status = named ? read_row(&r, text) : read_names(&r, text);
        named = true;
    }
    free(rows.bytes);
    if (status == CPS_OK && r.table.rows < 1)
        status = cpsi_fail_at(err, CPS_ERR_INPUT, path, 0, 0,
                              "found no row of numbers, expected some below a line of names");
    *out = r.table;
    return status;
}
