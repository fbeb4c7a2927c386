/* SPDX-License-Identifier: BSD-3-Clause */
/* Failing with a message. */
#ifndef CAPSTAN_SRC_BASE_STATUS_H
#define CAPSTAN_SRC_BASE_STATUS_H

#include "capstan/base.h"

/* Fill err (may be NULL) with a printf-style message and return status. Exported: capstan-io fails
 * the same way. */
CPS_API __attribute__((format(printf, 3, 4))) CpsStatus cpsi_fail(CpsError *err, CpsStatus status,
                                                                  const char *format, ...);

/* What has failed lies inside the place given: "lines.cable" in front of "length". Nothing where
 * status is CPS_OK or err is NULL. Returns status. */
CPS_API __attribute__((format(printf, 3, 4))) CpsStatus
cpsi_fail_inside(CpsError *err, CpsStatus status, const char *format, ...);

#endif
