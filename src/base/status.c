/* SPDX-License-Identifier: BSD-3-Clause */
/* Names and texts of the status codes, from the list in base.h; returning an error with its
 * message. */
#include "base/status.h"
#include "base/words.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#define STRING(x)                    #x
#define VERSION(major, minor, patch) STRING(major) "." STRING(minor) "." STRING(patch)

const char *cps_version(void) {
    return VERSION(CPS_VERSION_MAJOR, CPS_VERSION_MINOR, CPS_VERSION_PATCH);
}

static const CpsiWords STATUS[] = {CPS_STATUS_LIST(CPSI_WORDS_WITH_NAME)};

const char *cps_status_name(CpsStatus status) { return CPSI_WORDS(STATUS, status).name; }

const char *cps_status_text(CpsStatus status) { return CPSI_WORDS(STATUS, status).text; }

CpsStatus cpsi_fail(CpsError *err, CpsStatus status, const char *format, ...) {
    if (err) {
        memset(err, 0, sizeof *err);
        err->status = status;
        va_list args;
        va_start(args, format);
        vsnprintf(err->message, sizeof err->message, format, args);
        va_end(args);
    }
    return status;
}

CpsStatus cpsi_fail_inside(CpsError *err, CpsStatus status, const char *format, ...) {
    char rest[sizeof err->where];
    if (!err || status == CPS_OK) return status;
    memcpy(rest, err->where, sizeof rest);
    va_list args;
    va_start(args, format);
    vsnprintf(err->where, sizeof err->where, format, args);
    va_end(args);
    const size_t used = strlen(err->where);
    snprintf(err->where + used, sizeof err->where - used, "%s%s",
             rest[0] && rest[0] != '[' ? "." : "", rest);
    return status;
}
