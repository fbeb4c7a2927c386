/* SPDX-License-Identifier: BSD-3-Clause */
/* The surface of the water in a file (water.h). */
#include "water.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

bool water_surface(const Source *source, double *z) {
    size_t count = 0;
    *z = 0;
    return nc_inq_attlen(source->nc, NC_GLOBAL, "water_surface", &count) == NC_NOERR &&
           count == 1 && nc_get_att_double(source->nc, NC_GLOBAL, "water_surface", z) == NC_NOERR &&
           isfinite(*z);
}

static int read_numbers(const Source *source, const char *name, size_t step, double *value,
                        FILE *log) {
    const size_t start[] = {step, 0}, count[] = {1, source->points};
    int variable;
    int status = nc_inq_varid(source->nc, name, &variable);
    if (status == NC_NOERR) status = nc_get_vara_double(source->nc, variable, start, count, value);
    for (size_t k = 0; k < source->points && status == NC_NOERR; k++)
        if (!isfinite(value[k])) status = NC_ERANGE;
    if (status != NC_NOERR && log) fprintf(log, "%s: %s\n", name, nc_strerror(status));
    return status == NC_NOERR ? 0 : -1;
}

int water_read(const Source *source, size_t step, Water *all, FILE *log) {
    int variable;
    memset(all, 0, source->points * sizeof *all);
    if (nc_inq_varid(source->nc, "water_of_point", &variable) != NC_NOERR) return 0;
    double *number = calloc(source->points * 3, sizeof *number);
    int bad = number ? 0 : -1;
    static const char *const NAME[] = {"water_of_point", "buoyancy_of_point", "displaced_of_point"};
    for (size_t i = 0; i < 3 && !bad; i++)
        bad = read_numbers(source, NAME[i], step, number + i * source->points, log);
    for (size_t k = 0; k < source->points && !bad; k++) {
        if (!(number[k] >= 0 && number[k] < WATER_STATES)) {
            if (log)
                fprintf(log, "unknown state in the water of point %s\n", source->point_name[k]);
            bad = -1;
            break;
        }
        all[k] =
            (Water){(int)number[k], number[source->points + k], number[2 * source->points + k]};
    }
    free(number);
    return bad;
}
