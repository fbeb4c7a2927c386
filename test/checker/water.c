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

int water_heights(const Source *source, double *height, FILE *log) {
    size_t count = 0;
    double z;
    for (size_t k = 0; k < source->points; k++) height[k] = 0;
    if (!water_surface(source, &z)) return 0;
    bool bad = nc_inq_attlen(source->nc, NC_GLOBAL, "height_of_point", &count) ||
               count != source->points ||
               nc_get_att_double(source->nc, NC_GLOBAL, "height_of_point", height);
    for (size_t k = 0; k < source->points && !bad; k++)
        bad = !(height[k] >= 0 && isfinite(height[k]));
    if (bad && log) fprintf(log, "missing or senseless height_of_point\n");
    return bad ? -1 : 0;
}

/* What a file with a surface has besides: `number` has room for 5 numbers of each point. */
static int read_surface(const Source *source, size_t step, Water *all, double *number, FILE *log) {
    const size_t n = source->points, start[] = {step, 0, 0}, count[] = {1, n, 3};
    double z, *level = number + 3 * n, *waves = number + 4 * n;
    int variable, time;
    if (!water_surface(source, &z)) return 0;
    if (nc_inq_varid(source->nc, "water_direction_of_point", &variable) ||
        nc_get_vara_double(source->nc, variable, start, count, number)) {
        if (log) fprintf(log, "missing water_direction_of_point\n");
        return -1;
    }
    for (size_t k = 0; k < n; k++) waves[k] = 0;
    if (read_numbers(source, "water_level_of_point", step, level, log)) return -1;
    if (nc_inq_varid(source->nc, "time", &time) == NC_NOERR &&
        read_numbers(source, "ledger_waves_of_point", step, waves, log))
        return -1;
    for (size_t k = 0; k < n; k++) {
        memcpy(all[k].direction, number + 3 * k, sizeof all[k].direction);
        all[k].level = level[k];
        all[k].waves = waves[k];
    }
    return 0;
}

int water_read(const Source *source, size_t step, Water *all, FILE *log) {
    int variable;
    memset(all, 0, source->points * sizeof *all);
    if (nc_inq_varid(source->nc, "water_of_point", &variable) != NC_NOERR) return 0;
    double *number = calloc(source->points * 5, sizeof *number);
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
        all[k] = (Water){.state = (int)number[k],
                         .buoyancy = number[source->points + k],
                         .displaced = number[2 * source->points + k]};
    }
    if (!bad) bad = read_surface(source, step, all, number, log);
    free(number);
    return bad;
}
