/* SPDX-License-Identifier: BSD-3-Clause */
/* What moved is brought to rest by a quasi-static step: where its energy goes. */
#ifndef CAPSTAN_CHECKER_SETTLING_H
#define CAPSTAN_CHECKER_SETTLING_H

#include "inertia.h"

/* Set `settles` and `kept` of the record; `before` is the step before it, or NULL. */
void settling_begin(Record *r, const Record *before);

/* What a quasi-static step contradicts, as inertia_check. */
void settling_check(const Source *source, const Record *r, const Record *before, InertiaFind *find,
                    void *user);

#endif
