/* SPDX-License-Identifier: BSD-3-Clause */
/* Anchors in a file (anchors.h). */
#include "anchors.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

/* `width` numbers of each point, of a step or (rank 1) of the file. */
static int read_all(const Source *source, const char *name, size_t step, size_t rank, size_t width,
                    double *value, FILE *log) {
    const size_t start[] = {step, 0, 0}, count[] = {1, source->points, width};
    const size_t skip = rank == 1 ? 1 : 0;
    int variable;
    int status = nc_inq_varid(source->nc, name, &variable);
    if (status == NC_NOERR)
        status = nc_get_vara_double(source->nc, variable, start + skip, count + skip, value);
    for (size_t k = 0; k < source->points * width && status == NC_NOERR; k++)
        if (!isfinite(value[k])) status = NC_ERANGE;
    if (status != NC_NOERR && log) fprintf(log, "%s: %s\n", name, nc_strerror(status));
    return status == NC_NOERR ? 0 : -1;
}

static bool has(const Source *source) {
    int variable;
    return nc_inq_varid(source->nc, "holding_capacity_of_point", &variable) == NC_NOERR;
}

int anchors_open(const Source *source, Anchor *all, FILE *log) {
    memset(all, 0, source->points * sizeof *all);
    if (!has(source)) return 0;
    const size_t n = source->points;
    double *value = calloc(3 * n, sizeof *value);
    int bad = value ? 0 : -1;
    static const char *const NAME[] = {"holding_capacity_of_point", "uplift_limit_of_point",
                                       "drags_of_point"};
    for (size_t i = 0; i < 3 && !bad; i++)
        bad = read_all(source, NAME[i], 0, 1, 1, value + i * n, log);
    if (bad) {
        free(value);
        return -1;
    }
    for (size_t k = 0; k < n; k++)
        all[k] =
            (Anchor){.capacity = value[k], .limit = value[n + k], .drags = value[2 * n + k] != 0};
    free(value);
    return 0;
}

int anchors_read(const Source *source, size_t step, Anchor *all, FILE *log) {
    if (!has(source)) return 0;
    const size_t n = source->points;
    double *value = calloc(6 * n, sizeof *value);
    int bad = value ? 0 : -1;
    static const char *const NAME[] = {"capacity_used_of_point", "uplift_used_of_point",
                                       "dragged_of_point"};
    for (size_t i = 0; i < 3 && !bad; i++)
        bad = read_all(source, NAME[i], step, 2, 1, value + i * n, log);
    if (!bad) bad = read_all(source, "drag_of_point", step, 3, 3, value + 3 * n, log);
    if (bad) {
        free(value);
        return -1;
    }
    for (size_t k = 0; k < n; k++) {
        all[k].capacity_used = value[k];
        all[k].uplift_used = value[n + k];
        all[k].dragged = value[2 * n + k];
        memcpy(all[k].drag, value + 3 * n + 3 * k, sizeof all[k].drag);
    }
    free(value);
    return 0;
}
