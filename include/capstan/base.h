/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/base.h: status codes, the error record and the version.
 *
 * Rules that hold for the whole interface:
 *   - All quantities are in SI units. Vectors are x, y, z in right-handed axes; the scene gives the
 *     direction of gravity.
 *   - Every call that can fail returns a CpsStatus and takes a CpsError as its last argument, which
 *     may be NULL. The status says whether the call worked. What the mathematics found is an
 *     outcome (step.h, set.h, drive.h).
 *   - The library copies what it needs. Every create has one destroy and every retain one release;
 *     destroy and release accept NULL. Structs that are given to the library begin as
 *     cps_.._default(), except rows of an array and what a writer of results.h is given.
 *   - A call with a status returns CPS_ERR_ARGUMENT for a handle or an array that is NULL where its
 *     description does not allow it, for a count or a size below the stated range, and for a number
 *     outside an enumeration; CPS_ERR_LIMIT for what is too large. A refused call changes nothing.
 *     A call without a status returns 0, NULL or false in these cases, and for an index that does
 *     not exist; or a struct whose numbers are 0, whose names are "" or NULL, and whose outcome is
 *     none of success.
 *   - In a struct or the name of a call the number of things, entries of an array or steps taken,
 *     ends in `_count`; that of the largest number allowed begins with `max_`.
 *   - Where a value may be missing, a flag `has_..` or an enumeration says so, and the value is 0;
 *     only residuals of laws (law.h) are NaN instead. An array of indices needs an entry for
 *     `none` beside 0, so as to stay one array; it has a name, CPS_NO_OBSTACLE (step.h), which is
 *     negative.
 *   - A returned `const double *` is a view that the handle owns. It is valid until the next
 *     non-const call on that handle.
 *   - The library never prints, exits or aborts, and has no mutable global state: different handles
 *     may be used by different threads at the same time. This holds for capstan's own code.
 *     capstan-io also uses libfyaml to read files and libnetcdf to write result.nc; these may end
 *     the process when they get no memory. */
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

/* Where and why a call failed. `file` is empty when no input file is concerned; line and column are
 * 0 then, and where a file cannot be opened; otherwise they count from 1. `where` is the place in
 * what was given, by the names that a scene file uses: "lines.cable.length", "history[2].cable.B",
 * entries counted from 1; empty when no part of it is meant. */
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
