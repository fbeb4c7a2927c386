/* SPDX-License-Identifier: BSD-3-Clause */
/* A netCDF file that is being written (see netcdf_file.h). */
#include "io/results/netcdf/netcdf_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

void cpsi_netcdf_keep(CpsiNetcdfFile *file, int status) {
    if (file->status == NC_NOERR) file->status = status;
}

/* Call a function of the library on the file, unless a call has failed. */
#define CALL(file, name, ...)                                               \
    do {                                                                    \
        if ((file)->status == NC_NOERR)                                     \
            (file)->status = (file)->library.name((file)->id, __VA_ARGS__); \
    } while (0)

int cpsi_netcdf_dimension(CpsiNetcdfFile *file, const char *name, size_t size) {
    int id = -1;
    CALL(file, def_dim, name, size, &id);
    return id;
}

int cpsi_netcdf_variable(CpsiNetcdfFile *file, const char *prefix, const char *name, nc_type type,
                         int rank, const int *shape, const char *long_name, const char *units) {
    char full[NC_MAX_NAME + 1];
    int id = -1;
    const int length = snprintf(full, sizeof full, "%s%s%s", prefix, *prefix ? "_" : "", name);
    if ((size_t)length >= sizeof full) cpsi_netcdf_keep(file, NC_EMAXNAME);
    CALL(file, def_var, full, type, rank, shape, &id);
    cpsi_netcdf_text(file, id, "long_name", long_name);
    if (units) cpsi_netcdf_text(file, id, "units", units);
    return id;
}

void cpsi_netcdf_text(CpsiNetcdfFile *file, int variable, const char *name, const char *text) {
    CALL(file, put_att_text, variable, name, strlen(text), text);
}

void cpsi_netcdf_numbers(CpsiNetcdfFile *file, const char *name, size_t count,
                         const double *value) {
    CALL(file, put_att_double, NC_GLOBAL, name, NC_DOUBLE, count, value);
}

void cpsi_netcdf_flags(CpsiNetcdfFile *file, int variable, nc_type type, size_t count,
                       const int *value, const char *meanings) {
    static const int FLAG[] = {0, 1, 2, 3, 4, 5, 6};
    CALL(file, put_att_int, variable, "flag_values", type, count, value ? value : FLAG);
    cpsi_netcdf_text(file, variable, "flag_meanings", meanings);
}

void cpsi_netcdf_may_miss(CpsiNetcdfFile *file, int variable) {
    const double none = NAN;
    CALL(file, put_att_double, variable, "_FillValue", NC_DOUBLE, 1, &none);
}

void cpsi_netcdf_doubles(CpsiNetcdfFile *file, int variable, const size_t *start,
                         const size_t *count, const double *value) {
    CALL(file, put_vara_double, variable, start, count, value);
}

void cpsi_netcdf_ints(CpsiNetcdfFile *file, int variable, const size_t *start, const size_t *count,
                      const int *value) {
    CALL(file, put_vara_int, variable, start, count, value);
}

void cpsi_netcdf_bytes(CpsiNetcdfFile *file, int variable, const size_t *start, const size_t *count,
                       const unsigned char *value) {
    CALL(file, put_vara_uchar, variable, start, count, value);
}

void cpsi_netcdf_int(CpsiNetcdfFile *file, int variable, const size_t *start, int value) {
    CALL(file, put_var1_int, variable, start, &value);
}

/* When the file was begun and by what, as CF wants the first line of a file's history. Where the
 * clock cannot be read, or shows no year, by what alone. */
void cpsi_netcdf_history(CpsiNetcdfFile *file, const char *source) {
    char history[96];
    struct timespec now;
    struct tm utc;
    size_t length = 0;
    if (timespec_get(&now, TIME_UTC) == TIME_UTC && gmtime_r(&now.tv_sec, &utc))
        length = strftime(history, sizeof history, "%Y-%m-%dT%H:%M:%SZ: ", &utc);
    snprintf(history + length, sizeof history - length, "written by %s", source);
    cpsi_netcdf_text(file, NC_GLOBAL, "history", history);
}
