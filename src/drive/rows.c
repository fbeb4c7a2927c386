/* SPDX-License-Identifier: BSD-3-Clause */
/* Entries are checked, sorted by row and column, and added where they have the same place; arrays
 * double as they grow. */
#include "drive/rows.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"

static CpsStatus check(const char *what, int n, int more, int count, const CpsEntry *entry,
                       CpsError *err) {
    if (more < 0 || count < 0 || (count > 0 && !entry))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: %d rows with %d entries, expected at least 0 and a list", what, more,
                         count);
    for (int e = 0; e < count; e++) {
        if (entry[e].row < 0 || entry[e].row >= more)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s: entry %d is in row %d, expected from 0 to %d", what, e,
                             entry[e].row, more - 1);
        if (entry[e].column < 0 || entry[e].column >= n)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s: entry %d is in column %d, expected from 0 to %d", what, e,
                             entry[e].column, n - 1);
        if (!isfinite(entry[e].value))
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: entry %d is %g, expected a finite number",
                             what, e, entry[e].value);
    }
    return CPS_OK;
}

/* Memory for `need` items of `size` bytes, doubling. */
static bool grow(void **items, size_t *capacity, size_t need, size_t size) {
    if (need <= *capacity) return true;
    const size_t target = need > 2 * *capacity ? need : 2 * *capacity;
    if (target > SIZE_MAX / 2 / size) return false;
    void *more = realloc(*items, target * size);
    if (!more) return false;
    *items = more;
    *capacity = target;
    return true;
}

static bool ensure_capacity(CpsiRows *rows, size_t more, size_t count) {
    const size_t used = rows->rows > 0 ? rows->start[rows->rows] : 0, need = used + count;
    size_t capacity = rows->capacity;
    const bool fresh = !rows->start;
    bool done = grow((void **)&rows->start, &rows->row_capacity, (size_t)rows->rows + more + 1,
                     sizeof *rows->start);
    if (done && fresh) rows->start[0] = 0;
    if (done) done = grow((void **)&rows->column, &capacity, need, sizeof *rows->column);
    capacity = rows->capacity;
    if (done) done = grow((void **)&rows->value, &capacity, need, sizeof *rows->value);
    if (done) rows->capacity = capacity;
    return done;
}

static int by_place(const void *a, const void *b) {
    const CpsEntry *x = a, *y = b;
    if (x->row != y->row) return x->row < y->row ? -1 : 1;
    return (x->column > y->column) - (x->column < y->column);
}

CpsStatus cpsi_rows_append(CpsiRows *rows, const char *what, int n, int more, int count,
                           const CpsEntry *entry, CpsError *err) {
    const CpsStatus status = check(what, n, more, count, entry, err);
    if (status != CPS_OK) return status;
    if (more > INT_MAX / 4 - rows->rows)
        return cpsi_fail(err, CPS_ERR_LIMIT, "%s: more than %d rows", what, INT_MAX / 4);
    CpsEntry *sorted = malloc(((size_t)count + 1) * sizeof *sorted);
    if (!sorted || !ensure_capacity(rows, (size_t)more, (size_t)count)) {
        free(sorted);
        return cpsi_fail(err, CPS_ERR_MEMORY, "%s: no memory for %d entries", what, count);
    }
    if (count > 0) {
        memcpy(sorted, entry, (size_t)count * sizeof *sorted);
        qsort(sorted, (size_t)count, sizeof *sorted, by_place);
    }
    size_t at = rows->start[rows->rows];
    for (int r = 0, e = 0; r < more; r++) {
        const size_t begin = at;
        for (; e < count && sorted[e].row == r; e++) {
            if (at > begin && rows->column[at - 1] == sorted[e].column) {
                rows->value[at - 1] += sorted[e].value;
            } else {
                rows->column[at] = sorted[e].column;
                rows->value[at++] = sorted[e].value;
            }
        }
        rows->start[++rows->rows] = at;
    }
    free(sorted);
    return CPS_OK;
}

void cpsi_rows_free(CpsiRows *rows) {
    free(rows->start);
    free(rows->column);
    free(rows->value);
    *rows = (CpsiRows){0};
}

double cpsi_rows_times(const CpsiRows *rows, int i, const double *x) {
    double sum = 0;
    for (size_t e = rows->start[i]; e < rows->start[i + 1]; e++)
        sum += rows->value[e] * x[rows->column[e]];
    return sum;
}

void cpsi_rows_add(const CpsiRows *rows, int i, double factor, double *out) {
    for (size_t e = rows->start[i]; e < rows->start[i + 1]; e++)
        out[rows->column[e]] += factor * rows->value[e];
}
