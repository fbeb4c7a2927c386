/* SPDX-License-Identifier: BSD-3-Clause */
/* A netCDF file that is being written: dimensions, variables, attributes and values. After the
 * first failure, which `status` keeps, all functions do nothing. */
#ifndef CAPSTAN_SRC_IO_RESULTS_NETCDF_NETCDF_FILE_H
#define CAPSTAN_SRC_IO_RESULTS_NETCDF_NETCDF_FILE_H

#include <stddef.h>

#include "io/results/netcdf/netcdf_library.h"

typedef struct CpsiNetcdfFile {
    CpsiNetcdfLibrary library;
    int id;
    int status; /* of the first call that failed */
} CpsiNetcdfFile;

/* Record a failure, unless there has been one. */
void cpsi_netcdf_keep(CpsiNetcdfFile *file, int status);

int cpsi_netcdf_dimension(CpsiNetcdfFile *file, const char *name, size_t size);
/* A variable "prefix_name", or "name" without a prefix; units NULL: none. */
int cpsi_netcdf_variable(CpsiNetcdfFile *file, const char *prefix, const char *name, nc_type type,
                         int rank, const int *shape, const char *long_name, const char *units);

/* Attributes. Flags are the names of the values of an enumeration, as CF prescribes; value NULL: 0,
 * 1, 2. */
void cpsi_netcdf_text(CpsiNetcdfFile *file, int variable, const char *name, const char *text);
void cpsi_netcdf_numbers(CpsiNetcdfFile *file, const char *name, size_t count, const double *value);
void cpsi_netcdf_flags(CpsiNetcdfFile *file, int variable, nc_type type, size_t count,
                       const int *value, const char *meanings);
/* Doubles that may be missing: they are NaN then, the _FillValue of the variable. */
void cpsi_netcdf_may_miss(CpsiNetcdfFile *file, int variable);

/* The first line of the file's history: when it was begun, and by what. */
void cpsi_netcdf_history(CpsiNetcdfFile *file, const char *source);

/* Values. */
void cpsi_netcdf_doubles(CpsiNetcdfFile *file, int variable, const size_t *start,
                         const size_t *count, const double *value);
void cpsi_netcdf_ints(CpsiNetcdfFile *file, int variable, const size_t *start, const size_t *count,
                      const int *value);
void cpsi_netcdf_bytes(CpsiNetcdfFile *file, int variable, const size_t *start, const size_t *count,
                       const unsigned char *value);
void cpsi_netcdf_int(CpsiNetcdfFile *file, int variable, const size_t *start, int value);

#endif
