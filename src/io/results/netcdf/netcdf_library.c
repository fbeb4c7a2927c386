/* SPDX-License-Identifier: BSD-3-Clause */
/* libnetcdf, opened by its name as the dynamic linker would find it (see netcdf_library.h). */
#define _GNU_SOURCE /* RTLD_NODELETE, which is not part of POSIX */
#include "io/results/netcdf/netcdf_library.h"

#include <dlfcn.h>
#include <stddef.h>
#include <string.h>

#include "base/status.h"

#define CALL(name) {"nc_" #name, offsetof(CpsiNetcdfLibrary, name)},
static const struct {
    const char *name;
    size_t at; /* of its pointer */
} FUNCTION[] = {CPSI_NETCDF_CALLS(CALL)};
#undef CALL

/* A function pointer of POSIX is as wide as a pointer to data. */
static bool find_all(CpsiNetcdfLibrary *library) {
    for (size_t i = 0; i < sizeof FUNCTION / sizeof *FUNCTION; i++) {
        void *const found = dlsym(library->handle, FUNCTION[i].name);
        if (!found) return false;
        memcpy((char *)library + FUNCTION[i].at, &found, sizeof found);
    }
    return true;
}

CpsStatus cpsi_netcdf_library(CpsiNetcdfLibrary *out, CpsError *err) {
    *out = (CpsiNetcdfLibrary){.handle =
                                   dlopen(CAPSTAN_NETCDF, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)};
    if (out->handle && find_all(out)) return CPS_OK;
    const char *why = dlerror();
    cpsi_netcdf_library_close(out);
    return cpsi_fail(err, CPS_ERR_IO, "cannot write result.nc without %s: %s", CAPSTAN_NETCDF,
                     why ? why : "it lacks a function");
}

void cpsi_netcdf_library_close(CpsiNetcdfLibrary *library) {
    if (library->handle) dlclose(library->handle);
    *library = (CpsiNetcdfLibrary){0};
}
