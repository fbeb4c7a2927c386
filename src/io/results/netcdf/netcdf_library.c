/* SPDX-License-Identifier: BSD-3-Clause */
/* libnetcdf, opened by its name as the dynamic linker would find it (see netcdf_library.h), or as
 * the environment says: a Python package brings it along under another name. */
#define _GNU_SOURCE /* RTLD_NODELETE and secure_getenv, which are not part of POSIX */
#include "io/results/netcdf/netcdf_library.h"

#include <dlfcn.h>
#include <stddef.h>
#include <stdlib.h>
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

/* The environment is not asked by a program that has more rights than who starts it. */
static const char *library_name(void) {
#ifdef __GLIBC__
    const char *given = secure_getenv("CAPSTAN_NETCDF");
#else
    const char *given = getenv("CAPSTAN_NETCDF");
#endif
    return given && given[0] ? given : CAPSTAN_NETCDF;
}

CpsStatus cpsi_netcdf_library(CpsiNetcdfLibrary *out, CpsError *err) {
    const char *const name = library_name();
    *out = (CpsiNetcdfLibrary){.handle = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)};
    if (out->handle && find_all(out)) return CPS_OK;
    const char *why = dlerror();
    cpsi_netcdf_library_close(out);
    return cpsi_fail(err, CPS_ERR_IO, "cannot write result.nc without %s: %s", name,
                     why ? why : "it lacks a function");
}

void cpsi_netcdf_library_close(CpsiNetcdfLibrary *library) {
    if (library->handle) dlclose(library->handle);
    *library = (CpsiNetcdfLibrary){0};
}
