/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/base.h: status codes, the error record and the version.
 *
 * Rules that hold for the whole interface:
 *   - SI units everywhere; vectors are x, y, z; axes are right-handed, gravity is given by the
 *       scene.
 *   - Every call that can fail returns a CpsStatus and takes an optional CpsError last (NULL is
 *       accepted).
 *     The status says whether the call worked. What the mathematics said is an outcome (evolve.h).
 *   - The library copies what it needs. Each create has one destroy, and destroy accepts NULL.
 *   - A call with a status refuses, with CPS_ERR_ARGUMENT, a handle or array that is NULL where the
 *       call does not say that it
 *     may be, a count or size below what it says, and a number outside an enumeration;
 *         CPS_ERR_LIMIT what is too large.
 *     A call without a status gives nothing there, and for an index that there is not: 0, NULL,
 *         false, a struct of zeros, or
 *     NaN where 0 would be an answer. No handle is changed by a call that is refused.
 *   - The name of a number of things, entries of an array or steps taken, ends in `_count`; that of
 *       the largest number allowed begins with `max_`.
 *   - A returned `const double *` is a view owned by the handle, valid until the next non-const
 *       call on it.
 *   - The library never prints, exits or aborts, and has no mutable global state: different handles
 *       may be
 *     used from different threads at the same time. That is promised of capstan's own code:
 *         libfyaml, which reads
 *     files, and libnetcdf, which writes result.nc, may end the process where they get no memory
 *         (capstan-io only). */
#ifndef CAPSTAN_BASE_H
#define CAPSTAN_BASE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define CPS_API __attribute__((visibility("default")))
#else
#define CPS_API
#endif

#define CPS_VERSION_MAJOR 0
#define CPS_VERSION_MINOR 1
#define CPS_VERSION_PATCH 0

/* One list: name, fixed number, sentence. Numbers are never reused. */
#define CPS_STATUS_LIST(X)                                                 \
    X(CPS_OK, 0, "success")                                                \
    X(CPS_ERR_ARGUMENT, 1, "an argument is outside what the call accepts") \
    X(CPS_ERR_MEMORY, 2, "out of memory")                                  \
    X(CPS_ERR_INPUT, 3, "the input file is not valid")                     \
    X(CPS_ERR_IO, 4, "a file could not be read or written")                \
    X(CPS_ERR_LIMIT, 5, "a size limit was exceeded")                       \
    X(CPS_ERR_INTERRUPTED, 6, "the caller interrupted it")

typedef enum CpsStatus {
#define CPS_STATUS_ENUM(name, number, sentence) name = number,
    CPS_STATUS_LIST(CPS_STATUS_ENUM)
#undef CPS_STATUS_ENUM
} CpsStatus;

/* Where and why a call failed. `file` is empty and line, column are 0 when no input file is
 * concerned; otherwise lines and columns count from 1. `where` is the place in what was given, by
 * the names that a scene file uses: "lines.cable.length", "history[2].cable.B", entries counted
 * from 1; empty when no part of it is meant. */
typedef struct CpsError {
    CpsStatus status;
    int line, column;
    char file[512];
    char where[160];
    char message[1024]; /* what was found, what was expected, what to do */
} CpsError;

/* The name of a status ("CPS_ERR_INPUT") and its sentence; never NULL. */
CPS_API const char *cps_status_name(CpsStatus status);
CPS_API const char *cps_status_text(CpsStatus status);

/* The library's version, "0.1.0". */
CPS_API const char *cps_version(void);

#ifdef __cplusplus
}
#endif
#endif
