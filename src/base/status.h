/* SPDX-License-Identifier: BSD-3-Clause */
/* Returning an error with its message. */
#ifndef CAPSTAN_SRC_BASE_STATUS_H
#define CAPSTAN_SRC_BASE_STATUS_H

#include "capstan/base.h"

/* Fill err (may be NULL) with a printf-style message and return status. It is exported because
 * capstan-io reports errors with it too. */
CPS_API __attribute__((format(printf, 3, 4))) CpsStatus cpsi_fail(CpsError *err, CpsStatus status,
                                                                  const char *format, ...);

/* Put the given place, for instance "lines.cable", in front of the place of an error: "length"
 * becomes "lines.cable.length". Does nothing where status is CPS_OK or err is NULL. Returns
 * status. */
CPS_API __attribute__((format(printf, 3, 4))) CpsStatus
cpsi_fail_inside(CpsError *err, CpsStatus status, const char *format, ...);

/* Fail at a key of the object that is being checked; arguments as for cpsi_fail. */
#define CPSI_FAIL_AT(key, err, ...) cpsi_fail_inside(err, cpsi_fail(err, __VA_ARGS__), "%s", key)

#endif
