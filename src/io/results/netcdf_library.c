/* SPDX-License-Identifier: BSD-3-Clause */
/* libnetcdf, opened by its name as the dynamic linker would find it (see netcdf_library.h). */
#define _GNU_SOURCE /* RTLD_NODELETE, which is not part of POSIX */
#include "io/results/netcdf_library.h"

#include <dlfcn.h>
#include <string.h>

#include "base/status.h"

/* A function pointer of POSIX is as wide as a pointer to data. */
static bool find(void *handle, const char *name, void *to) {
    void *const found = dlsym(handle, name);
    memcpy(to, &found, sizeof found);
    return found != NULL;
}

CpsStatus cpsi_netcdf_library(CpsiNetcdfLibrary *out, CpsError *err) {
    *out = (CpsiNetcdfLibrary){.handle =
                                   dlopen(CAPSTAN_NETCDF, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)};
    bool whole = out->handle != NULL;
#define FIND(name) whole = whole && find(out->handle, "nc_" #name, &out->name);
    CPSI_NETCDF_CALLS(FIND)
#undef FIND
    if (whole) return CPS_OK;
    const char *why = dlerror();
    cpsi_netcdf_library_close(out);
    return cpsi_fail(err, CPS_ERR_IO, "cannot write result.nc without %s: %s", CAPSTAN_NETCDF,
                     why ? why : "it lacks a function");
}

void cpsi_netcdf_library_close(CpsiNetcdfLibrary *library) {
    if (library->handle) dlclose(library->handle);
    *library = (CpsiNetcdfLibrary){0};
}
