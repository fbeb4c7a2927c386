/* SPDX-License-Identifier: BSD-3-Clause */
/* Values of a record that cannot be. */
#ifndef CAPSTAN_CHECKER_MISSING_H
#define CAPSTAN_CHECKER_MISSING_H

#include "record.h"

/* The first variable with one (NaN, infinite, negative), or NULL. */
const char *missing_variable(const Record *r);

#endif
