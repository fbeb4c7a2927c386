/* SPDX-License-Identifier: BSD-3-Clause */
/* libnetcdf, opened when a result.nc is to be written: loading it and its dependencies takes longer
 * than everything else at the start of a command. */
#ifndef CAPSTAN_SRC_IO_RESULTS_NETCDF_NETCDF_LIBRARY_H
#define CAPSTAN_SRC_IO_RESULTS_NETCDF_NETCDF_LIBRARY_H

#include <netcdf.h>

#include <stdbool.h>

#include "capstan/base.h"

/* The functions used, nc_NAME of netcdf.h. */
#define CPSI_NETCDF_CALLS(X) \
    X(create)                \
    X(set_fill)              \
    X(def_dim)               \
    X(def_var)               \
    X(_enddef)               \
    X(sync)                  \
    X(close)                 \
    X(strerror)              \
    X(put_att_text)          \
    X(put_att_int)           \
    X(put_att_double)        \
    X(put_var_double)        \
    X(put_var1_int)          \
    X(put_vara_text)         \
    X(put_vara_int)          \
    X(put_vara_uchar)        \
    X(put_vara_double)

typedef struct CpsiNetcdfLibrary {
    void *handle;
#define CPSI_NETCDF_CALL(name) __typeof__(nc_##name) *name;
    CPSI_NETCDF_CALLS(CPSI_NETCDF_CALL)
#undef CPSI_NETCDF_CALL
} CpsiNetcdfLibrary;

/* Open it. Returns CPS_OK, or CPS_ERR_IO with the message of the system. It remains loaded until
 * the process ends. */
CpsStatus cpsi_netcdf_library(CpsiNetcdfLibrary *out, CpsError *err);
void cpsi_netcdf_library_close(CpsiNetcdfLibrary *library);

#endif
